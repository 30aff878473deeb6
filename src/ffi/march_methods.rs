//! Methods of intersection by name that begin at a start: correctors, marching, bisection.

use super::march::{fpt_surface_intersection, handed_out};
use super::march_records::{fpt_intersect_surfaces_options, fpt_intersection_point};
use super::memory::{array, place};
use super::options::check_length;
use super::surface::{self, fpt_surface};
use super::{Failure, fpt_status, guard};
use crate::march::correct::correct;
use crate::march::named;

/// Share of the size of what is met within which a corrector ends by default.
const CLOSE: f64 = 1e-12;

/// Places u, v, s, t that are numbers.
///
/// # Safety
/// NULL or an array of this length.
unsafe fn places<'a>(uvst: *const f64, count: usize) -> Result<&'a [[f64; 4]], Failure> {
    // SAFETY: the caller vouches for it.
    let given = unsafe { array("uvst", uvst.cast::<[f64; 4]>(), count) }?;
    match given.iter().position(|at| at.iter().any(|x| !x.is_finite())) {
        Some(k) => Err(Failure::invalid(format!("uvst: place {k} is not finite"))),
        None => Ok(given),
    }
}

fn missed(what: &str) -> Failure {
    Failure::Budget(format!("uvst: {what}"))
}

/// Moves a place near two surfaces onto both by one corrector alone (fpt_corrector), without proof: Newton with three or four parameters,
/// or the moving affine frame.
///
/// Parameters outside the domains are moved into them. The iteration ends when the distance between the two surface points is within
/// the tolerance and falls no more; each step is told to options.trace.
///
/// @param a, b       surfaces, also given by functions
/// @param uvst       4 numbers: u, v of A, u, v of B
/// @param options    tolerance (0: 1e-12 x the size of the smaller surface), corrector, trace and user count; NULL: the defaults
/// @param out        the place on both surfaces
/// @param out_gap    distance between its two surface points
/// @param out_steps  number of steps
/// @return FPT_BUDGET_EXHAUSTED when it does not get there within 50 steps, or a step does not exist: an isoline that is held may miss the
///         other surface. Nothing is written then
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_intersect_correct(
    a: *const fpt_surface,
    b: *const fpt_surface,
    uvst: *const f64,
    options: *const fpt_intersect_surfaces_options,
    out: *mut fpt_intersection_point,
    out_gap: *mut f64,
    out_steps: *mut u32,
) -> fpt_status {
    // SAFETY: the header asks for live handles, four numbers, options and room for the outputs; trace takes what it is documented to.
    guard(|| unsafe {
        let (a, b) = (surface::support_as("a", a)?, surface::support_as("b", b)?);
        let start = places(uvst, 1)?[0];
        let options = fpt_intersect_surfaces_options::read(options)?;
        let corrector = options.corrector()?;
        let (out, gap, steps) =
            (place("out", out)?, place("out_gap", out_gap)?, place("out_steps", out_steps)?);
        let tolerance = match options.tolerance > 0.0 {
            true => options.tolerance,
            false => CLOSE * named::smaller(&a, &b),
        };
        let mut tell = |step: u32, at: [f64; 4], gap: f64| {
            if let Some(trace) = options.trace {
                trace(options.user, step, at.as_ptr(), gap);
            }
        };
        let Some(found) = correct(&a, &b, start, corrector, tolerance, Some(&mut tell)) else {
            return Err(missed("the corrector does not get onto both surfaces from there"));
        };
        let point = named::on_both(&a, &b, found.at);
        *out = fpt_intersection_point { point: point.point, uv: point.uv, st: point.st };
        (*gap, *steps) = (found.gap, found.steps);
        Ok(())
    })
}

/// The branch through a place near two surfaces, walked both ways by marching alone, without proof: steps along n_A x n_B by the chord tolerance,
/// corrected; it ends where it began, at borders (with three parameters), and where the tangent planes are parallel.
///
/// The result has one branch, of which nothing is proven, and one undecided box that is all of both domains. A walk ends at seams.
///
/// @param a, b     surfaces, also given by functions
/// @param uvst     4 numbers: u, v of A, u, v of B
/// @param step     length, finite, >= 0: the first step; 0: a 256th of the size of the smaller surface
/// @param options  chord, corrector, should_stop, progress and user count; NULL: the defaults
/// @param out      the result; release it with fpt_surface_intersection_free
/// @return FPT_BUDGET_EXHAUSTED without a result when the place leads to no branch; FPT_CANCELLED with what was walked by then
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_intersect_march(
    a: *const fpt_surface,
    b: *const fpt_surface,
    uvst: *const f64,
    step: f64,
    options: *const fpt_intersect_surfaces_options,
    out: *mut *mut fpt_surface_intersection,
) -> fpt_status {
    // SAFETY: the header asks for live handles, four numbers, options and room for a handle.
    guard(|| unsafe {
        let (a, b) = (surface::support_as("a", a)?, surface::support_as("b", b)?);
        let start = places(uvst, 1)?[0];
        check_length("step", step)?;
        let options = fpt_intersect_surfaces_options::read(options)?;
        let (corrector, callbacks) = (options.corrector()?, options.callbacks());
        let out = place("out", out)?;
        let mut poll = |done: u64, left: u64| callbacks.poll(done as usize, (done + left) as usize);
        let found =
            named::by_marching(&a, &b, start, corrector, step, &options.march(), &mut poll)?;
        handed_out(found.ok_or_else(|| missed("no branch goes on from there"))?, out)
    })
}

/// The branch through given places in order, with as many between them as the chord tolerance asks for, by bisection alone, without proof:
/// midpoints of the parameters are corrected.
///
/// The result has one branch, of which nothing is proven, and one undecided box that is all of both domains. It is closed when the last place
/// is the first one.
///
/// @param a, b     surfaces, also given by functions
/// @param uvst     4 numbers each: u, v of A, u, v of B; they are kept as they are
/// @param count    number of places, at least 2
/// @param options  chord, corrector, should_stop, progress and user count; NULL: the defaults
/// @param out      the result; release it with fpt_surface_intersection_free
/// @return FPT_BUDGET_EXHAUSTED without a result when a midpoint cannot be corrected, or lands elsewhere than between its two places;
///         FPT_CANCELLED with what was put between by then
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_intersect_bisect(
    a: *const fpt_surface,
    b: *const fpt_surface,
    uvst: *const f64,
    count: usize,
    options: *const fpt_intersect_surfaces_options,
    out: *mut *mut fpt_surface_intersection,
) -> fpt_status {
    // SAFETY: the header asks for live handles, an array of this length, options and room for a handle.
    guard(|| unsafe {
        let (a, b) = (surface::support_as("a", a)?, surface::support_as("b", b)?);
        let places = places(uvst, count)?;
        let options = fpt_intersect_surfaces_options::read(options)?;
        let (corrector, callbacks) = (options.corrector()?, options.callbacks());
        let out = place("out", out)?;
        let mut poll = |done: u64, left: u64| callbacks.poll(done as usize, (done + left) as usize);
        let found = named::by_bisection(&a, &b, places, corrector, &options.march(), &mut poll)?;
        handed_out(found.ok_or_else(|| missed("no branch runs through the places"))?, out)
    })
}
