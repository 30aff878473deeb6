//! Batches of queries: closest and invert, on curves and surfaces.
//!
//! All four functions are one path: read and check everything ([`Batch::read`]), build the index, let
//! the batch layer answer into the caller's records. Callbacks run on the calling thread only.

use super::curve::{self, fpt_curve};
use super::form::{CurveForm, SurfaceForm};
use super::memory::{Points, Strided};
use super::options::fpt_query_options;
use super::records::{feet, fpt_foot_point};
use super::surface::{self, fpt_surface};
use super::{Failure, fpt_status, guard};
use crate::batch::{self, Memory, Work};
use crate::closest::{FootPoint, QueryOptions, Trace};
use crate::error::Error;
use crate::index::{IndexedCurve, IndexedSurface};
use std::ffi::{c_int, c_void};

/// The nearest point of the curve for each query point, with a proven lower bound of the distance.
///
/// @param points   `count` query points x,y,z, options->point_stride bytes apart. A bad point (NaN,
///                 infinite, beyond 1e100) marks its own record with FPT_FOOT_BAD_QUERY
/// @param count    may be 0, then `points` and `out` may be NULL
/// @param options  NULL: the defaults
/// @param out      `count` records, packed; must not overlap `points` or the hints
/// @return FPT_CANCELLED when should_stop said so; then the records not reached have NaN in u, v, point
///         and distance, lower_bound 0 and FPT_FOOT_NOT_PROVEN. After FPT_INTERNAL the records have no
///         defined contents
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_curve_closest(
    curve: *const fpt_curve,
    points: *const f64,
    count: usize,
    options: *const fpt_query_options,
    out: *mut fpt_foot_point,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and arrays of these lengths that do not overlap.
    guard(|| unsafe {
        let curve = curve::form(curve)?;
        Batch::read(curve, points, count, options, out)?
            .run_together(CurveForm::closest, CurveForm::closest_together)
    })
}

/// The parameters of points that lie on the curve: as fpt_curve_closest, and points proven to be
/// farther than options->tolerance are marked with FPT_FOOT_NOT_ON_SHAPE.
///
/// @param points   as for fpt_curve_closest
/// @param count    as for fpt_curve_closest
/// @param options  NULL: the defaults
/// @param out      as for fpt_curve_closest
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_curve_invert(
    curve: *const fpt_curve,
    points: *const f64,
    count: usize,
    options: *const fpt_query_options,
    out: *mut fpt_foot_point,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and arrays of these lengths that do not overlap.
    guard(|| unsafe {
        let curve = curve::form(curve)?;
        Batch::read(curve, points, count, options, out)?
            .run_together(CurveForm::invert, CurveForm::invert_together)
    })
}

/// The nearest point of the surface for each query point, with a proven lower bound of the distance.
///
/// @param points   `count` query points x,y,z, options->point_stride bytes apart. A bad point (NaN,
///                 infinite, beyond 1e100) marks its own record with FPT_FOOT_BAD_QUERY
/// @param count    may be 0, then `points` and `out` may be NULL
/// @param options  NULL: the defaults
/// @param out      `count` records, packed; must not overlap `points` or the hints
/// @return FPT_CANCELLED when should_stop said so; then the records not reached have NaN in u, v, point
///         and distance, lower_bound 0 and FPT_FOOT_NOT_PROVEN. After FPT_INTERNAL the records have no
///         defined contents
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_closest(
    surface: *const fpt_surface,
    points: *const f64,
    count: usize,
    options: *const fpt_query_options,
    out: *mut fpt_foot_point,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and arrays of these lengths that do not overlap.
    guard(|| unsafe {
        let surface = surface::form(surface)?;
        Batch::read(surface, points, count, options, out)?
            .run_together(SurfaceForm::closest, SurfaceForm::closest_together)
    })
}

/// The parameters of points that lie on the surface: as fpt_surface_closest, and points proven to be
/// farther than options->tolerance are marked with FPT_FOOT_NOT_ON_SHAPE.
///
/// @param points   as for fpt_surface_closest
/// @param count    as for fpt_surface_closest
/// @param options  NULL: the defaults
/// @param out      as for fpt_surface_closest
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_invert(
    surface: *const fpt_surface,
    points: *const f64,
    count: usize,
    options: *const fpt_query_options,
    out: *mut fpt_foot_point,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and arrays of these lengths that do not overlap.
    guard(|| unsafe {
        let surface = surface::form(surface)?;
        Batch::read(surface, points, count, options, out)?
            .run_together(SurfaceForm::invert, SurfaceForm::invert_together)
    })
}

/// Bytes of a shape or scene with its indexes from which on a batch puts its queries in order: half a second-level cache.
pub(super) const LARGE: usize = 512 << 10;

/// What a batch needs of a shape with `N` parameters.
pub(super) trait Shape<const N: usize>: Sync {
    /// Start and end of each parameter.
    fn ends(&self) -> [[f64; 2]; N];
    fn check_restriction(&self, domain: [f64; 4]) -> Result<(), Error>;
    fn build(&self, poll: &mut dyn FnMut() -> bool) -> Result<(), Error>;
    /// Whether it is larger than the caches of a core, so that the order of queries counts.
    fn is_large(&self) -> bool;
}

impl Shape<1> for CurveForm {
    fn ends(&self) -> [[f64; 2]; 1] {
        let (start, end) = self.domain();
        [[start, end]]
    }

    fn check_restriction(&self, domain: [f64; 4]) -> Result<(), Error> {
        self.check_domain(domain)
    }

    fn build(&self, poll: &mut dyn FnMut() -> bool) -> Result<(), Error> {
        self.prepare(poll)
    }

    fn is_large(&self) -> bool {
        self.memory() > LARGE
    }
}

impl Shape<2> for SurfaceForm {
    fn ends(&self) -> [[f64; 2]; 2] {
        let [u0, u1, v0, v1] = self.domain();
        [[u0, u1], [v0, v1]]
    }

    fn check_restriction(&self, domain: [f64; 4]) -> Result<(), Error> {
        self.check_domain(domain)
    }

    fn build(&self, poll: &mut dyn FnMut() -> bool) -> Result<(), Error> {
        self.prepare(poll)
    }

    fn is_large(&self) -> bool {
        self.memory() > LARGE
    }
}

impl Shape<1> for IndexedCurve {
    fn ends(&self) -> [[f64; 2]; 1] {
        let (start, end) = self.curve().domain();
        [[start, end]]
    }

    fn check_restriction(&self, domain: [f64; 4]) -> Result<(), Error> {
        self.check_domain(domain)
    }

    fn build(&self, poll: &mut dyn FnMut() -> bool) -> Result<(), Error> {
        self.prepare(poll)
    }

    fn is_large(&self) -> bool {
        self.memory() > LARGE
    }
}

impl Shape<2> for IndexedSurface {
    fn ends(&self) -> [[f64; 2]; 2] {
        let [u0, u1, v0, v1] = self.surface().domain();
        [[u0, u1], [v0, v1]]
    }

    fn check_restriction(&self, domain: [f64; 4]) -> Result<(), Error> {
        self.check_domain(domain)
    }

    fn build(&self, poll: &mut dyn FnMut() -> bool) -> Result<(), Error> {
        self.prepare(poll)
    }

    fn is_large(&self) -> bool {
        self.memory() > LARGE
    }
}

/// One operation on one query point.
pub(super) trait Ask<S, W, const N: usize>:
    Fn(&S, [f64; 3], Option<[f64; N]>, &QueryOptions, &mut W, Option<Trace<'_>>) -> FootPoint + Sync
{
}

impl<S, W, F, const N: usize> Ask<S, W, N> for F where
    F: Fn(&S, [f64; 3], Option<[f64; N]>, &QueryOptions, &mut W, Option<Trace<'_>>) -> FootPoint
        + Sync
{
}

/// The same operation on many query points, bit for bit: told a point and its hint by number.
pub(super) type Together<S, W, const N: usize> =
    fn(&S, &dyn Fn(usize) -> ([f64; 3], Option<[f64; N]>), &QueryOptions, &mut W, &mut [FootPoint]);

/// One operation on many query points, one by one or, if there is a way to, together.
struct Asking<'a, S, F, W, const N: usize> {
    shape: &'a S,
    points: &'a Strided<'a, 3>,
    hints: Option<&'a Strided<'a, N>>,
    ends: [[f64; 2]; N],
    options: &'a QueryOptions,
    callbacks: &'a Callbacks,
    ask: F,
    together: Option<Together<S, W, N>>,
}

impl<S, F, W, const N: usize> Asking<'_, S, F, W, N> {
    fn query(&self, i: usize) -> ([f64; 3], Option<[f64; N]>) {
        let hint = self.hints.and_then(|hints| hint(hints.row(i), self.ends));
        (self.points.row(i), hint)
    }
}

impl<S: Shape<N>, F: Ask<S, W, N>, W, const N: usize> Work<W> for Asking<'_, S, F, W, N> {
    fn one(&self, i: usize, workspace: &mut W) -> FootPoint {
        let (point, hint) = self.query(i);
        let mut told = |step, u, v, residual| self.callbacks.trace(i, step, [u, v], residual);
        let trace: Option<Trace<'_>> =
            if self.callbacks.trace.is_some() { Some(&mut told) } else { None };
        (self.ask)(self.shape, point, hint, self.options, workspace, trace)
    }

    fn group(&self, numbers: &[usize], workspace: &mut W, out: &mut [FootPoint]) {
        match self.together.filter(|_| numbers.len() > 1 && self.callbacks.trace.is_none()) {
            Some(together) => {
                let asked = |k: usize| self.query(numbers[k]);
                together(self.shape, &asked, self.options, workspace, out);
            }
            None => {
                for (record, &number) in out.iter_mut().zip(numbers) {
                    *record = self.one(number, workspace);
                }
            }
        }
    }
}

/// The checked arguments of one call.
pub(super) struct Batch<'a, S, const N: usize> {
    pub(super) shape: &'a S,
    pub(super) points: Strided<'a, 3>,
    hints: Option<Strided<'a, N>>,
    /// Start and end of each parameter, restricted: where hints are moved to.
    ends: [[f64; 2]; N],
    pub(super) options: QueryOptions,
    threads: usize,
    pub(super) callbacks: Callbacks,
    pub(super) out: &'a mut [FootPoint],
}

impl<'a, S: Shape<N>, const N: usize> Batch<'a, S, N> {
    /// Reads every argument; nothing is written yet.
    ///
    /// # Safety
    /// Pointers that are not NULL point to what the header asks for, for as long as the call lasts.
    pub(super) unsafe fn read(
        shape: &'a S,
        points: impl Into<Points>,
        count: usize,
        options: *const fpt_query_options,
        out: *mut fpt_foot_point,
    ) -> Result<Self, Failure> {
        // SAFETY: the caller vouches for the pointers.
        unsafe {
            let given = fpt_query_options::read(options)?;
            let options = given.checked(2 * N)?;
            let ends = restricted(shape, options.domain)?;
            let points =
                Strided::new(("points", points), count, ("point_stride", given.point_stride))?;
            let hints = if given.hints.is_null() {
                None
            } else {
                let stride = ("hint_stride", given.hint_stride);
                Some(Strided::new(("hints", given.hints), count, stride)?)
            };
            hints.as_ref().map_or(Ok(()), check_hints)?;
            let out = feet(out, count)?;
            let (threads, callbacks) = (given.thread_count(), Callbacks::of(&given));
            Ok(Self { shape, points, hints, ends, options, threads, callbacks, out })
        }
    }

    /// Asks `ask`, one operation on one query point, for every record; `W` is what a thread works with.
    pub(super) fn run<W: Memory>(self, ask: impl Ask<S, W, N>) -> Result<(), Failure> {
        self.run_all(ask, None)
    }

    /// The same with a way to ask for many at once.
    pub(super) fn run_together<W: Memory>(
        self,
        ask: impl Ask<S, W, N>,
        together: Together<S, W, N>,
    ) -> Result<(), Failure> {
        self.run_all(ask, Some(together))
    }

    fn run_all<W: Memory>(
        mut self,
        ask: impl Ask<S, W, N>,
        together: Option<Together<S, W, N>>,
    ) -> Result<(), Failure> {
        self.answer(ask, together)?;
        let total = self.out.len();
        if total > 0 {
            self.callbacks.report(total, total);
        }
        Ok(())
    }

    /// As [`Self::run`], without the last report: more is to be done.
    pub(super) fn answer<W: Memory>(
        &mut self,
        ask: impl Ask<S, W, N>,
        together: Option<Together<S, W, N>>,
    ) -> Result<(), Failure> {
        let Self { shape, points, hints, ends, options, threads, callbacks, out } = self;
        let total = out.len();
        if total == 0 {
            return Ok(());
        }
        let built = shape.build(&mut || callbacks.poll(0, total));
        if built == Err(Error::Cancelled) {
            out.fill(FootPoint::unreached());
        }
        built?;
        let (shape, ends) = (*shape, *ends);
        let (hints, options, callbacks) = (hints.as_ref(), &*options, &*callbacks);
        let work = Asking { shape, points, hints, ends, options, callbacks, ask, together };
        let at = |i: usize| points.row(i);
        let sorts = total > batch::GROUP && shape.is_large();
        let place: Option<batch::Place> = if sorts { Some(&at) } else { None };
        Ok(batch::run(out, *threads, place, &work, &mut |done| callbacks.poll(done, total))?)
    }
}

/// Refuses a restriction that does not lie in the domain.
pub(super) fn check_restriction<S: Shape<N>, const N: usize>(
    shape: &S,
    domain: Option<[f64; 4]>,
) -> Result<(), Failure> {
    restricted(shape, domain).map(|_| ())
}

/// The domain that answers come from.
fn restricted<S: Shape<N>, const N: usize>(
    shape: &S,
    domain: Option<[f64; 4]>,
) -> Result<[[f64; 2]; N], Failure> {
    let Some(domain) = domain else {
        return Ok(shape.ends());
    };
    shape.check_restriction(domain)?;
    Ok(std::array::from_fn(|k| [domain[2 * k], domain[2 * k + 1]]))
}

pub(super) fn check_hints<const N: usize>(hints: &Strided<'_, N>) -> Result<(), Failure> {
    match (0..hints.len()).find(|&i| hints.row(i).iter().any(|x| x.is_infinite())) {
        Some(i) => Err(Failure::invalid(format!("hints: hint {i} is infinite"))),
        None => Ok(()),
    }
}

/// A hint moved to the domain; `None` when a number in it is NaN.
fn hint<const N: usize>(row: [f64; N], ends: [[f64; 2]; N]) -> Option<[f64; N]> {
    let moved = std::array::from_fn(|k| row[k].max(ends[k][0]).min(ends[k][1]));
    if row.iter().any(|x| x.is_nan()) { None } else { Some(moved) }
}

pub(super) type ShouldStop = unsafe extern "C" fn(*mut c_void) -> c_int;
pub(super) type Progress = unsafe extern "C" fn(*mut c_void, usize, usize);
type TraceStep = unsafe extern "C" fn(*mut c_void, usize, u32, f64, f64, f64);

/// The caller's functions and what they are handed.
pub(super) struct Callbacks {
    should_stop: Option<ShouldStop>,
    progress: Option<Progress>,
    trace: Option<TraceStep>,
    user: *mut c_void,
}

// SAFETY: the functions are called on the calling thread only: `poll` and `report` by the batch layer's
// contract, `trace` because a trace makes the batch run on that thread alone.
unsafe impl Sync for Callbacks {}

impl Callbacks {
    pub(super) fn of(options: &fpt_query_options) -> Self {
        let fpt_query_options { should_stop, progress, trace, user, .. } = *options;
        Self { should_stop, progress, trace, user }
    }

    /// Only the question whether to stop.
    pub(super) fn stopping(should_stop: Option<ShouldStop>, user: *mut c_void) -> Self {
        Self { should_stop, progress: None, trace: None, user }
    }

    /// What is told and asked by a call without a trace.
    pub(super) fn telling(
        should_stop: Option<ShouldStop>,
        progress: Option<Progress>,
        user: *mut c_void,
    ) -> Self {
        Self { should_stop, progress, trace: None, user }
    }

    /// Tells how far the call is and asks whether to stop.
    pub(super) fn poll(&self, done: usize, total: usize) -> bool {
        self.report(done, total);
        // SAFETY: the header asks for functions that take this `user` and do not unwind.
        self.should_stop.is_some_and(|should_stop| unsafe { should_stop(self.user) } != 0)
    }

    pub(super) fn report(&self, done: usize, total: usize) {
        if let Some(progress) = self.progress {
            // SAFETY: as in `poll`.
            unsafe { progress(self.user, done, total) }
        }
    }

    fn trace(&self, query: usize, step: u32, [u, v]: [f64; 2], residual: f64) {
        if let Some(trace) = self.trace {
            // SAFETY: as in `poll`.
            unsafe { trace(self.user, query, step, u, v, residual) }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::hint;

    #[test]
    fn a_hint_is_moved_to_the_domain_and_nan_is_none() {
        let ends = [[0.0, 1.0], [-2.0, 3.0]];
        assert_eq!(hint([0.5, 0.5], ends), Some([0.5, 0.5]));
        assert_eq!(hint([-9.0, 9.0], ends), Some([0.0, 3.0]));
        assert_eq!(hint([0.5, f64::NAN], ends), None);
        assert_eq!(hint([f64::NAN], [[0.0, 1.0]]), None);
    }
}
