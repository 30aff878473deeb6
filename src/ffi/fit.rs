//! Curves and surfaces through and near points.

use super::curve::fpt_curve;
use super::form::{CurveForm, SurfaceForm};
use super::memory::{array, optional_array, output, place};
use super::options::{SelfSized, check_length, sized};
use super::query::Callbacks;
use super::surface::fpt_surface;
use super::{Failure, fpt_status, guard};
use crate::curve::Curve;
use crate::curve::insertion::copy_of;
use crate::error::Error;
use crate::fit::{
    Certificate, Condition, Ends, Fit, Grid, GridOptions, NearOptions, Spacing, adaptive_grid,
    certify, curve_near, grid_parameters, interpolate, interpolate_grid, interpolate_periodic,
    interpolate_with, least_squares, parameters, plane_parameters, surface_near,
};
use crate::index::{IndexedCurve, IndexedSurface};
use crate::surface::Surface;
use std::ffi::{c_int, c_void};
use std::mem::{offset_of, size_of};
use std::sync::Arc;

/// Parameters for points in order, for fpt_fit_options.spacing.
#[repr(C)]
#[derive(Clone, Copy)]
pub enum fpt_spacing {
    /// Steps as the distances of the points.
    FPT_SPACING_CHORDAL = 0,
    /// Steps as the square roots of the distances.
    FPT_SPACING_CENTRIPETAL = 1,
    /// Equal steps.
    FPT_SPACING_UNIFORM = 2,
}

/// What the ends of an interpolating curve do, for fpt_fit_options.condition.
#[repr(C)]
#[derive(Clone, Copy)]
pub enum fpt_fit_condition {
    /// Nothing: as many poles as points.
    FPT_FIT_FREE = 0,
    /// First derivatives are fpt_fit_options.tangents. Degree 2 or more.
    FPT_FIT_TANGENTS = 1,
    /// The natural spline of an odd degree p: derivatives of order (p+1)/2 to p-1 vanish.
    FPT_FIT_NATURAL = 2,
    /// The curve is closed, smoothly; the first point is not repeated at the end.
    FPT_FIT_PERIODIC = 3,
}

/// How to fit. Fill it with fpt_fit_options_init, then change what matters. All zero after struct_size is the default of everything
/// but the tolerance, which fits need. Grows at the end only.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct fpt_fit_options {
    /// sizeof(fpt_fit_options), set by fpt_fit_options_init.
    pub struct_size: usize,
    /// Length, more than 0 for fits: knots are added until no point is farther away. Not looked at by interpolation.
    pub tolerance: f64,
    /// Degree of curves, and of surfaces in u, 1 to 31; 0: 3.
    pub degree_u: u32,
    /// Degree of surfaces in v, 1 to 31; 0: 3.
    pub degree_v: u32,
    /// A value of fpt_spacing: parameters when none are given.
    pub spacing: u32,
    /// A value of fpt_fit_condition; for fpt_curve_interpolate.
    pub condition: u32,
    /// With FPT_FIT_TANGENTS: x,y,z of the derivative at the first point, then at the last; NaN in x: none there. Borrowed during the call.
    pub tangents: *const f64,
    /// Most poles, of a grid in either direction; 0: 10,000, of a grid 4,096.
    pub max_poles: usize,
    /// 1: parameters stay as they are; 0: each point is fitted at its foot. For fpt_curve_fit and fpt_surface_fit.
    pub keep_parameters: u32,
    /// 1: fpt_surface_fit_grid finds how far the points are from their feet and proves how far the worst is; 0: distances are those at the
    /// parameters.
    pub certify: u32,
    /// 0: all cores, 1: the calling thread only. Results are the same bits for any number.
    pub threads: u32,
    /// Must be 0.
    pub reserved: u32,
    /// Asked on the calling thread now and then; non-zero ends the call with FPT_CANCELLED. NULL: never.
    pub should_stop: Option<unsafe extern "C" fn(user: *mut c_void) -> c_int>,
    /// Handed to should_stop as it is.
    pub user: *mut c_void,
}

/// How far the data points are from a fitted shape: 40 bytes, frozen.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fpt_fit_result {
    /// No data point is farther from the shape than this.
    pub worst: f64,
    /// Proven: some data point is at least that far away. `worst` exceeds it by 1e-10 of the shape's box at most, unless points are
    /// `unproven`. 0 when feet were not asked for.
    pub at_least: f64,
    /// Root of the mean of the squared distances from the places that were found.
    pub rms: f64,
    /// The data point with the distance `worst`.
    pub worst_index: u64,
    /// Data points that may be farther away than `at_least`: no nearer place was found, and none excluded.
    pub unproven: u64,
}

impl Default for fpt_fit_options {
    fn default() -> Self {
        Self {
            struct_size: size_of::<Self>(),
            tolerance: 0.0,
            degree_u: 0,
            degree_v: 0,
            spacing: 0,
            condition: 0,
            tangents: std::ptr::null(),
            max_poles: 0,
            keep_parameters: 0,
            certify: 0,
            threads: 0,
            reserved: 0,
            should_stop: None,
            user: std::ptr::null_mut(),
        }
    }
}

// SAFETY: repr(C), begins with struct_size; numbers, raw pointers and a nullable function pointer.
unsafe impl SelfSized for fpt_fit_options {
    const SHORTER: &'static [usize] = &[
        offset_of!(Self, tolerance),
        offset_of!(Self, degree_u),
        offset_of!(Self, degree_v),
        offset_of!(Self, spacing),
        offset_of!(Self, condition),
        offset_of!(Self, tangents),
        offset_of!(Self, max_poles),
        offset_of!(Self, keep_parameters),
        offset_of!(Self, certify),
        offset_of!(Self, threads),
        offset_of!(Self, reserved),
        offset_of!(Self, should_stop),
        offset_of!(Self, user),
    ];

    fn defaults() -> Self {
        Self::default()
    }
}

/// The meaning of a number among the values of an enum.
pub(super) fn chosen<T: Copy>(
    name: &str,
    prefix: &str,
    number: u32,
    values: &[(u32, T)],
) -> Result<T, Failure> {
    let found = values.iter().find(|(code, _)| *code == number);
    let unknown = || Failure::invalid(format!("{name}: {number} is not an {prefix} value"));
    found.map(|&(_, value)| value).ok_or_else(unknown)
}

fn spacing(number: u32) -> Result<Spacing, Failure> {
    use fpt_spacing::*;
    let values = [
        (FPT_SPACING_CHORDAL as u32, Spacing::Chordal),
        (FPT_SPACING_CENTRIPETAL as u32, Spacing::Centripetal),
        (FPT_SPACING_UNIFORM as u32, Spacing::Uniform),
    ];
    chosen("spacing", "FPT_SPACING_", number, &values)
}

fn condition(number: u32) -> Result<fpt_fit_condition, Failure> {
    use fpt_fit_condition::*;
    let values = [FPT_FIT_FREE, FPT_FIT_TANGENTS, FPT_FIT_NATURAL, FPT_FIT_PERIODIC];
    chosen("condition", "FPT_FIT_", number, &values.map(|value| (value as u32, value)))
}

fn flag(name: &str, value: u32) -> Result<bool, Failure> {
    if value > 1 {
        return Err(Failure::invalid(format!("{name}: {value} is not 0 or 1")));
    }
    Ok(value == 1)
}

/// Options that have been looked at.
struct Given {
    options: fpt_fit_options,
    degrees: [usize; 2],
    spacing: Spacing,
    condition: fpt_fit_condition,
    keep_parameters: bool,
    certify: bool,
    callbacks: Callbacks,
}

impl Given {
    /// # Safety
    /// As [`sized`].
    unsafe fn read(options: *const fpt_fit_options) -> Result<Self, Failure> {
        let options = if options.is_null() {
            fpt_fit_options::default()
        } else {
            // SAFETY: the caller vouches for it.
            unsafe { sized("options", options) }?
        };
        check_length("tolerance", options.tolerance)?;
        if options.reserved != 0 {
            return Err(Failure::invalid(format!("reserved: {} must be 0", options.reserved)));
        }
        let degree = |given: u32| if given == 0 { 3 } else { given as usize };
        Ok(Self {
            degrees: [degree(options.degree_u), degree(options.degree_v)],
            spacing: spacing(options.spacing)?,
            condition: condition(options.condition)?,
            keep_parameters: flag("keep_parameters", options.keep_parameters)?,
            certify: flag("certify", options.certify)?,
            callbacks: Callbacks::stopping(options.should_stop, options.user),
            options,
        })
    }

    fn near(&self) -> NearOptions {
        let defaults = NearOptions::default();
        let or = |given: usize, otherwise| if given == 0 { otherwise } else { given };
        NearOptions {
            degrees: self.degrees,
            tolerance: self.options.tolerance,
            max_poles: or(self.options.max_poles, defaults.max_poles),
            corrections: if self.keep_parameters { 0 } else { defaults.corrections },
            threads: self.options.threads as usize,
        }
    }
}

impl From<Certificate> for fpt_fit_result {
    fn from(all: Certificate) -> Self {
        Self {
            worst: all.worst,
            at_least: all.at_least,
            rms: all.rms,
            worst_index: all.worst_index as u64,
            unproven: all.unproven as u64,
        }
    }
}

/// Room for a result that may not be wanted.
///
/// # Safety
/// NULL or room for one.
unsafe fn wanted<'a>(out: *mut fpt_fit_result) -> Result<Option<&'a mut fpt_fit_result>, Failure> {
    if out.is_null() {
        return Ok(None);
    }
    // SAFETY: the caller vouches for it.
    unsafe { place("result", out) }.map(Some)
}

pub(super) fn curve_handle(curve: Curve) -> *mut fpt_curve {
    fpt_curve::handle(CurveForm::Spline(Arc::new(IndexedCurve::new(curve))))
}

pub(super) fn surface_handle(surface: Surface) -> *mut fpt_surface {
    fpt_surface::handle(SurfaceForm::Spline(Arc::new(IndexedSurface::new(surface))))
}

/// Points of the caller.
///
/// # Safety
/// NULL or 3 * count numbers.
unsafe fn points_of<'a>(points: *const f64, count: usize) -> Result<&'a [[f64; 3]], Failure> {
    // SAFETY: the caller vouches for it.
    unsafe { array("points", points.cast::<[f64; 3]>(), count) }
}

/// Fills `options` with the defaults. Touches exactly struct_size bytes: pass sizeof *options.
/// Does nothing when `options` is NULL or struct_size is smaller than a size_t.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_fit_options_init(options: *mut fpt_fit_options, struct_size: usize) {
    if options.is_null() || struct_size < size_of::<usize>() {
        return;
    }
    let known = struct_size.min(size_of::<fpt_fit_options>());
    let defaults = fpt_fit_options { struct_size, ..Default::default() };
    let source = (&raw const defaults).cast::<u8>();
    let target = options.cast::<u8>();
    // SAFETY: the caller's struct has `struct_size` bytes; `defaults` has no padding before `known`.
    unsafe {
        source.copy_to_nonoverlapping(target, known);
        target.add(known).write_bytes(0, struct_size - known);
    }
}

/// Parameters from 0 to 1 for points in order.
///
/// @param points   x,y,z of `count` points, at least 2, not all the same
/// @param spacing  a value of fpt_spacing
/// @param out      `count` numbers
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_fit_parameters(
    points: *const f64,
    count: usize,
    spacing: u32,
    out: *mut f64,
) -> fpt_status {
    // SAFETY: the header asks for arrays of these lengths.
    guard(|| unsafe {
        let points = points_of(points, count)?;
        let out = output("out", out, count)?;
        out.copy_from_slice(&parameters(self::spacing(spacing)?, points)?);
        Ok(())
    })
}

/// The curve through points in order.
///
/// @param points      x,y,z of `count` points, at least degree + 1 (fewer with conditions at the ends)
/// @param parameters  one a point, strictly increasing; a periodic curve has one more, the end of the turn. NULL: options->spacing
/// @param options     degree_u, spacing, condition and tangents count; NULL: a cubic at chordal parameters
/// @param out         the handle; release it with fpt_curve_free. A periodic curve comes unrolled
/// @return FPT_INVALID_ARGUMENT names the first bad number, also for points that determine no such curve in doubles
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_curve_interpolate(
    points: *const f64,
    count: usize,
    parameters: *const f64,
    options: *const fpt_fit_options,
    out: *mut *mut fpt_curve,
) -> fpt_status {
    // SAFETY: the header asks for arrays of these lengths, options and room for a handle.
    guard(|| unsafe {
        let points = points_of(points, count)?;
        let given = Given::read(options)?;
        let periodic = matches!(given.condition, fpt_fit_condition::FPT_FIT_PERIODIC);
        let list = optional_array("parameters", parameters, count + usize::from(periodic))?;
        let own = match list {
            Some(list) => copy_of(list)?,
            None if periodic && count > 0 => {
                let turn = [points, &points[..1]].concat();
                crate::fit::parameters(given.spacing, &turn)?
            }
            None => crate::fit::parameters(given.spacing, points)?,
        };
        let out = place("out", out)?;
        let degree = given.degrees[0];
        let fit: Fit<3> = match given.condition {
            fpt_fit_condition::FPT_FIT_TANGENTS => {
                let both = array("tangents", given.options.tangents.cast::<[f64; 3]>(), 2)?;
                let tangents = [0, 1].map(|k| Some(both[k]).filter(|t| !t[0].is_nan()));
                interpolate_with(degree, &own, points, &Condition::Tangents(tangents))?
            }
            fpt_fit_condition::FPT_FIT_NATURAL => {
                interpolate_with(degree, &own, points, &Condition::Natural)?
            }
            fpt_fit_condition::FPT_FIT_PERIODIC => interpolate_periodic(degree, &own, points)?,
            fpt_fit_condition::FPT_FIT_FREE => interpolate(degree, &own, points)?,
        };
        *out = curve_handle(fit.spline.curve()?);
        Ok(())
    })
}

/// The curve on given knots that is nearest to points in the sense of least squares.
///
/// @param points      x,y,z of `count` points
/// @param parameters  one a point, not decreasing, in the domain of the knots
/// @param degree      1 to 31
/// @param knots       repeats written out; every pole must see enough of the points
/// @param knot_count  number of poles + degree + 1
/// @param free_ends   0: the curve begins in the first point and ends in the last (clamped knots; their parameters are the ends of the
///                    domain); 1: ends are like other points
/// @param out         the handle; release it with fpt_curve_free
/// @param result      distances at the parameters (at_least is 0, unproven is count); NULL: not wanted
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_curve_least_squares(
    points: *const f64,
    count: usize,
    parameters: *const f64,
    degree: usize,
    knots: *const f64,
    knot_count: usize,
    free_ends: u32,
    out: *mut *mut fpt_curve,
    result: *mut fpt_fit_result,
) -> fpt_status {
    // SAFETY: the header asks for arrays of these lengths and room for the outputs.
    guard(|| unsafe {
        let points = points_of(points, count)?;
        let parameters = array("parameters", parameters, count)?;
        let knots = array("knots", knots, knot_count)?;
        let ends = if flag("free_ends", free_ends)? { Ends::Free } else { Ends::Interpolated };
        let (out, result) = (place("out", out)?, wanted(result)?);
        let fit = least_squares(degree, knots, parameters, points, ends)?;
        *out = curve_handle(fit.spline.curve()?);
        if let Some(result) = result {
            let at = parameters.iter().position(|&t| t == fit.worst_at).unwrap_or(0);
            *result = fpt_fit_result {
                worst: fit.worst,
                at_least: 0.0,
                rms: fit.rms,
                worst_index: at as u64,
                unproven: count as u64,
            };
        }
        Ok(())
    })
}

/// A curve near points in order, from the first to the last: knots are added until no point is farther from the curve than the
/// tolerance. Parameters are corrected to the feet of the points. Where the tolerance is not reached, with max_poles or with points that
/// contradict each other, result->worst is above it and the best curve comes all the same: look.
///
/// @param points      x,y,z of `count` points
/// @param parameters  where the search begins, not decreasing; NULL: options->spacing
/// @param options     must not be NULL: tolerance; degree_u, spacing, max_poles, keep_parameters, threads and should_stop count
/// @param out         the handle; release it with fpt_curve_free
/// @param result      distances of the points from the curve, with proof; NULL: not wanted
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_curve_fit(
    points: *const f64,
    count: usize,
    parameters: *const f64,
    options: *const fpt_fit_options,
    out: *mut *mut fpt_curve,
    result: *mut fpt_fit_result,
) -> fpt_status {
    // SAFETY: the header asks for arrays of these lengths, options and room for the outputs.
    guard(|| unsafe {
        let points = points_of(points, count)?;
        let given = Given::read(options)?;
        let own = match optional_array("parameters", parameters, count)? {
            Some(list) => copy_of(list)?,
            None => crate::fit::parameters(given.spacing, points)?,
        };
        let (out, result) = (place("out", out)?, wanted(result)?);
        let poll = &mut || given.callbacks.poll(0, 1);
        let near = curve_near(points, &own, &given.near(), poll)?;
        *out = curve_handle(near.shape);
        if let Some(result) = result {
            *result = near.certificate.into();
        }
        Ok(())
    })
}

/// The surface through a grid of points.
///
/// @param points   x,y,z of point (i,j) at 3*(i*count_v + j)
/// @param count_u  at least degree_u + 1
/// @param count_v  at least degree_v + 1
/// @param options  degrees and spacing count (parameters are means over all rows); NULL: bicubic, chordal
/// @param out      the handle; release it with fpt_surface_free
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_interpolate(
    points: *const f64,
    count_u: usize,
    count_v: usize,
    options: *const fpt_fit_options,
    out: *mut *mut fpt_surface,
) -> fpt_status {
    // SAFETY: the header asks for an array of this length, options and room for a handle.
    guard(|| unsafe {
        let total = super::memory::product("points", count_u, count_v)?;
        let grid = Grid::new(points_of(points, total)?, count_u, count_v)?;
        let given = Given::read(options)?;
        let out = place("out", out)?;
        let [u, v] = grid_parameters(given.spacing, &grid)?;
        *out = surface_handle(interpolate_grid(given.degrees, [&u, &v], &grid)?.surface);
        Ok(())
    })
}

/// A surface near a grid of points: knots are added in both directions until no point is farther than the tolerance from the surface at
/// the point's parameters, an upper bound of its distance. Corners are met. Where the tolerance is not reached result->worst is above it.
/// Cost: about 15 ms for 100,000 points; certified, 35 ms.
///
/// @param points   x,y,z of point (i,j) at 3*(i*count_v + j)
/// @param options  must not be NULL: tolerance; degrees, spacing, max_poles, certify, threads and should_stop count
/// @param out      the handle; release it with fpt_surface_free
/// @param result   distances; without `certify` at the parameters (at_least is 0, unproven is the number of points). NULL: not wanted
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_fit_grid(
    points: *const f64,
    count_u: usize,
    count_v: usize,
    options: *const fpt_fit_options,
    out: *mut *mut fpt_surface,
    result: *mut fpt_fit_result,
) -> fpt_status {
    // SAFETY: the header asks for an array of this length, options and room for the outputs.
    guard(|| unsafe {
        let total = super::memory::product("points", count_u, count_v)?;
        let points = points_of(points, total)?;
        let grid = Grid::new(points, count_u, count_v)?;
        let given = Given::read(options)?;
        let (out, result) = (place("out", out)?, wanted(result)?);
        let [u, v] = grid_parameters(given.spacing, &grid)?;
        let defaults = GridOptions::default();
        let most = given.options.max_poles;
        let options = GridOptions {
            degrees: given.degrees,
            tolerance: given.options.tolerance,
            max_poles: if most == 0 { defaults.max_poles } else { most },
            ..defaults
        };
        let fit = adaptive_grid([&u, &v], &grid, &options)?;
        let mut all = fpt_fit_result {
            worst: fit.worst,
            at_least: 0.0,
            rms: fit.rms,
            worst_index: {
                let place = |list: &[f64], at: f64| list.iter().position(|&t| t == at).unwrap_or(0);
                (place(&u, fit.worst_at[0]) * count_v + place(&v, fit.worst_at[1])) as u64
            },
            unproven: total as u64,
        };
        let shape = IndexedSurface::new(fit.surface);
        if given.certify {
            let mut hints = Vec::new();
            hints.try_reserve_exact(total).map_err(|_| Error::OutOfMemory)?;
            hints.extend(u.iter().flat_map(|&u| v.iter().map(move |&v| [u, v])));
            let threads = given.options.threads as usize;
            let poll = &mut || given.callbacks.poll(0, 1);
            all = certify(&shape, points, Some(&hints), threads, poll)?.1.into();
        }
        *out = fpt_surface::handle(SurfaceForm::Spline(Arc::new(shape)));
        if let Some(result) = result {
            *result = all;
        }
        Ok(())
    })
}

/// A surface near points in any order: knots are added until no point is farther from the surface than the tolerance. Parameters are
/// corrected to the feet of the points. Where there are no points the surface runs smoothly on. Where the tolerance is not reached
/// result->worst is above it and the best surface comes all the same: look.
///
/// @param points      x,y,z of `count` points
/// @param parameters  u,v of each point, where the search begins, for example feet on a surface that is roughly there; their box is
///                    the domain. NULL: in the plane nearest to the points
/// @param options     must not be NULL: tolerance; degrees, max_poles, keep_parameters, threads and should_stop count
/// @param out         the handle; release it with fpt_surface_free
/// @param result      distances of the points from the surface, with proof; NULL: not wanted
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_fit(
    points: *const f64,
    count: usize,
    parameters: *const f64,
    options: *const fpt_fit_options,
    out: *mut *mut fpt_surface,
    result: *mut fpt_fit_result,
) -> fpt_status {
    // SAFETY: the header asks for arrays of these lengths, options and room for the outputs.
    guard(|| unsafe {
        let points = points_of(points, count)?;
        let given = Given::read(options)?;
        let list = optional_array("parameters", parameters.cast::<[f64; 2]>(), count)?;
        let own = match list {
            Some(list) => copy_of(list)?,
            None => plane_parameters(points)?,
        };
        let (out, result) = (place("out", out)?, wanted(result)?);
        let poll = &mut || given.callbacks.poll(0, 1);
        let near = surface_near(points, &own, &given.near(), poll)?;
        *out = surface_handle(near.shape);
        if let Some(result) = result {
            *result = near.certificate.into();
        }
        Ok(())
    })
}
