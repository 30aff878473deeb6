//! Operations on surfaces: each makes a new surface, or a curve on it.

use super::curve::fpt_curve;
use super::form::SurfaceForm;
use super::memory::{array, output, place, write};
use super::operate_curve::{self, fpt_difference, matrix_of};
use super::surface::{fpt_surface, plain};
use super::{Failure, fpt_status, guard};
use crate::index::IndexedSurface;
use crate::operate::{Bounded, Direction, compatible_surfaces, join_surfaces};
use crate::surface::Surface;
use std::sync::Arc;

/// A parameter direction of a surface.
#[repr(C)]
pub enum fpt_direction {
    /// The first parameter.
    FPT_DIRECTION_U = 0,
    /// The second parameter.
    FPT_DIRECTION_V = 1,
}

pub(super) fn read_direction(direction: u32) -> Result<Direction, Failure> {
    use fpt_direction::*;
    match direction {
        d if d == FPT_DIRECTION_U as u32 => Ok(Direction::U),
        d if d == FPT_DIRECTION_V as u32 => Ok(Direction::V),
        d => Err(Failure::invalid(format!("direction: {d} is not an FPT_DIRECTION_ value"))),
    }
}

fn handle(surface: Surface) -> *mut fpt_surface {
    fpt_surface::handle(SurfaceForm::Spline(Arc::new(IndexedSurface::new(surface))))
}

pub(super) fn hand_over(surface: Surface, out: &mut *mut fpt_surface) -> Result<(), Failure> {
    *out = handle(surface);
    Ok(())
}

/// Writes the error, where it is wanted, and the handle.
///
/// # Safety
/// `out_error` is NULL or has room for a number.
unsafe fn bounded(
    found: Bounded<Surface>,
    out_error: *mut f64,
    out: &mut *mut fpt_surface,
) -> Result<(), Failure> {
    if !out_error.is_null() {
        // SAFETY: the caller vouches for it.
        unsafe { write("out_error", found.error, out_error)? };
    }
    hand_over(found.shape, out)
}

/// Four numbers of the caller.
///
/// # Safety
/// NULL or an array of four numbers.
pub(super) unsafe fn four(name: &'static str, numbers: *const f64) -> Result<[f64; 4], Failure> {
    // SAFETY: the caller vouches for it.
    let numbers = unsafe { array(name, numbers, 4) }?;
    Ok([numbers[0], numbers[1], numbers[2], numbers[3]])
}

/// The surfaces behind an array of handles, copied.
///
/// # Safety
/// NULL or an array of `count` live handles.
unsafe fn all(surfaces: *const *const fpt_surface, count: usize) -> Result<Vec<Surface>, Failure> {
    // SAFETY: the caller vouches for the array and the handles in it.
    let handles = unsafe { array("surfaces", surfaces, count) }?;
    handles.iter().map(|&surface| Ok(unsafe { plain(surface) }?.clone())).collect()
}

/// The same surface with more knots in a direction. Exact.
///
/// @param direction  FPT_DIRECTION_U or FPT_DIRECTION_V
/// @param values  as in fpt_curve_refine
/// @param out  the new surface; release it with fpt_surface_free
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_refine(
    surface: *const fpt_surface,
    direction: u32,
    values: *const f64,
    value_count: usize,
    out: *mut *mut fpt_surface,
) -> fpt_status {
    // SAFETY: the header asks for live handles, arrays and room for what comes out.
    guard(|| unsafe {
        let (surface, direction) = (plain(surface)?, read_direction(direction)?);
        let out = place("out", out)?;
        hand_over(surface.refine(direction, array("values", values, value_count)?)?, out)
    })
}

/// The surface without some copies of a knot.
///
/// @param direction  FPT_DIRECTION_U or FPT_DIRECTION_V
/// @param value  a knot inside the domain
/// @param times  at most how often it is a knot
/// @param out_error  the proven error, a length; NULL: not wanted
/// @param out  the new surface; release it with fpt_surface_free
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_remove_knot(
    surface: *const fpt_surface,
    direction: u32,
    value: f64,
    times: usize,
    out_error: *mut f64,
    out: *mut *mut fpt_surface,
) -> fpt_status {
    // SAFETY: the header asks for live handles and room for what comes out.
    guard(|| unsafe {
        let (surface, direction) = (plain(surface)?, read_direction(direction)?);
        let out = place("out", out)?;
        bounded(surface.remove_knot(direction, value, times)?, out_error, out)
    })
}

/// The surface without the knots that are not needed to stay within a tolerance, first along u, then along v.
///
/// @param tolerance  length, finite, >= 0; the error is at most that
/// @param out_error  the proven error, a length; NULL: not wanted
/// @param out  the new surface; release it with fpt_surface_free
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_simplify(
    surface: *const fpt_surface,
    tolerance: f64,
    out_error: *mut f64,
    out: *mut *mut fpt_surface,
) -> fpt_status {
    // SAFETY: the header asks for live handles and room for what comes out.
    guard(|| unsafe {
        let surface = plain(surface)?;
        let out = place("out", out)?;
        bounded(surface.simplify(tolerance)?, out_error, out)
    })
}

/// The part of the surface over a rectangle of the domain, clamped, with its parameters. Exact.
///
/// @param domain  u0, u1, v0, v1 in the domain, u0 < u1, v0 < v1
/// @param out  the new surface; release it with fpt_surface_free
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_part(
    surface: *const fpt_surface,
    domain: *const f64,
    out: *mut *mut fpt_surface,
) -> fpt_status {
    // SAFETY: the header asks for live handles, arrays and room for what comes out.
    guard(|| unsafe {
        let surface = plain(surface)?;
        let out = place("out", out)?;
        hand_over(surface.part(four("domain", domain)?)?, out)
    })
}

/// The same surface with clamped ends: its borders are rows and columns of poles. Exact. Also the way back from fpt_surface_periodic.
///
/// @param out  the new surface; release it with fpt_surface_free
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_clamp(
    surface: *const fpt_surface,
    out: *mut *mut fpt_surface,
) -> fpt_status {
    // SAFETY: the header asks for live handles and room for what comes out.
    guard(|| unsafe {
        let surface = plain(surface)?;
        let out = place("out", out)?;
        hand_over(surface.clamp()?, out)
    })
}

/// The same surface with unclamped ends in a direction, as fpt_curve_unclamp.
///
/// @param direction  FPT_DIRECTION_U or FPT_DIRECTION_V
/// @param out_error  the proven error, a length; NULL: not wanted
/// @param out  the new surface; release it with fpt_surface_free
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_unclamp(
    surface: *const fpt_surface,
    direction: u32,
    out_error: *mut f64,
    out: *mut *mut fpt_surface,
) -> fpt_status {
    // SAFETY: the header asks for live handles and room for what comes out.
    guard(|| unsafe {
        let (surface, direction) = (plain(surface)?, read_direction(direction)?);
        let out = place("out", out)?;
        bounded(surface.unclamp(direction)?, out_error, out)
    })
}

/// The periodic form of a surface that is closed in a direction, as fpt_curve_periodic.
///
/// @param direction  FPT_DIRECTION_U or FPT_DIRECTION_V
/// @param tolerance  length, finite, >= 0
/// @return FPT_INVALID_ARGUMENT when the surface is not closed within the tolerance
/// @param out_error  the proven error, a length; NULL: not wanted
/// @param out  the new surface; release it with fpt_surface_free
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_periodic(
    surface: *const fpt_surface,
    direction: u32,
    tolerance: f64,
    out_error: *mut f64,
    out: *mut *mut fpt_surface,
) -> fpt_status {
    // SAFETY: the header asks for live handles and room for what comes out.
    guard(|| unsafe {
        let (surface, direction) = (plain(surface)?, read_direction(direction)?);
        let out = place("out", out)?;
        bounded(surface.periodic(direction, tolerance)?, out_error, out)
    })
}

/// The same surface with a higher degree in a direction. Exact.
///
/// @param direction  FPT_DIRECTION_U or FPT_DIRECTION_V
/// @param by  how many degrees more; the degree is at most 31
/// @param out  the new surface; release it with fpt_surface_free
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_elevate(
    surface: *const fpt_surface,
    direction: u32,
    by: usize,
    out: *mut *mut fpt_surface,
) -> fpt_status {
    // SAFETY: the header asks for live handles and room for what comes out.
    guard(|| unsafe {
        let (surface, direction) = (plain(surface)?, read_direction(direction)?);
        let out = place("out", out)?;
        hand_over(surface.elevate(direction, by)?, out)
    })
}

/// The clamped surface of a degree lower by one in a direction that is nearest in its poles.
///
/// @param direction  FPT_DIRECTION_U or FPT_DIRECTION_V
/// @param out_error  the proven error, a length; NULL: not wanted
/// @param out  the new surface; release it with fpt_surface_free
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_reduce(
    surface: *const fpt_surface,
    direction: u32,
    out_error: *mut f64,
    out: *mut *mut fpt_surface,
) -> fpt_status {
    // SAFETY: the header asks for live handles and room for what comes out.
    guard(|| unsafe {
        let (surface, direction) = (plain(surface)?, read_direction(direction)?);
        let out = place("out", out)?;
        bounded(surface.reduce(direction)?, out_error, out)
    })
}

/// The same surface with a direction run through backwards, over the same domain. Exact.
///
/// @param direction  FPT_DIRECTION_U or FPT_DIRECTION_V
/// @param out  the new surface; release it with fpt_surface_free
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_reverse(
    surface: *const fpt_surface,
    direction: u32,
    out: *mut *mut fpt_surface,
) -> fpt_status {
    // SAFETY: the header asks for live handles and room for what comes out.
    guard(|| unsafe {
        let (surface, direction) = (plain(surface)?, read_direction(direction)?);
        let out = place("out", out)?;
        hand_over(surface.reverse(direction)?, out)
    })
}

/// The same surface with its directions exchanged: new (v, u) is old (u, v). Exact.
///
/// @param out  the new surface; release it with fpt_surface_free
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_swap(
    surface: *const fpt_surface,
    out: *mut *mut fpt_surface,
) -> fpt_status {
    // SAFETY: the header asks for live handles and room for what comes out.
    guard(|| unsafe {
        let surface = plain(surface)?;
        let out = place("out", out)?;
        hand_over(surface.swap()?, out)
    })
}

/// The same surface over another domain, by affine changes of both parameters. Exact.
///
/// @param domain  u0, u1, v0, v1, finite, u0 < u1, v0 < v1
/// @param out  the new surface; release it with fpt_surface_free
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_with_domain(
    surface: *const fpt_surface,
    domain: *const f64,
    out: *mut *mut fpt_surface,
) -> fpt_status {
    // SAFETY: the header asks for live handles, arrays and room for what comes out.
    guard(|| unsafe {
        let surface = plain(surface)?;
        let out = place("out", out)?;
        hand_over(surface.with_domain(four("domain", domain)?)?, out)
    })
}

/// The same surface, clamped, in a parameter that is a Moebius function of the old one, as fpt_curve_reparametrise. Exact.
///
/// @param direction  FPT_DIRECTION_U or FPT_DIRECTION_V
/// @param speed  finite, > 0
/// @param out  the new surface; release it with fpt_surface_free
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_reparametrise(
    surface: *const fpt_surface,
    direction: u32,
    speed: f64,
    out: *mut *mut fpt_surface,
) -> fpt_status {
    // SAFETY: the header asks for live handles and room for what comes out.
    guard(|| unsafe {
        let (surface, direction) = (plain(surface)?, read_direction(direction)?);
        let out = place("out", out)?;
        hand_over(surface.reparametrise(direction, speed)?, out)
    })
}

/// The surface of the points A (x, y, z, 1). Exact.
///
/// @param matrix  12 finite numbers, 3 rows of 4; may be singular
/// @param out  the new surface; release it with fpt_surface_free
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_affine(
    surface: *const fpt_surface,
    matrix: *const f64,
    out: *mut *mut fpt_surface,
) -> fpt_status {
    // SAFETY: the header asks for live handles, arrays and room for what comes out.
    guard(|| unsafe {
        let surface = plain(surface)?;
        let out = place("out", out)?;
        hand_over(surface.affine(matrix_of::<3>("matrix", matrix)?)?, out)
    })
}

/// The surface of the points (x', y', z') / w', as fpt_curve_projective. Exact.
///
/// @param matrix  16 finite numbers, 4 rows of 4
/// @return FPT_UNSUPPORTED when poles lie on both sides of the plane that goes to infinity, or on it
/// @param out  the new surface; release it with fpt_surface_free
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_projective(
    surface: *const fpt_surface,
    matrix: *const f64,
    out: *mut *mut fpt_surface,
) -> fpt_status {
    // SAFETY: the header asks for live handles, arrays and room for what comes out.
    guard(|| unsafe {
        let surface = plain(surface)?;
        let out = place("out", out)?;
        hand_over(surface.projective(matrix_of::<4>("matrix", matrix)?)?, out)
    })
}

/// The derivative in a direction as a surface: of one degree less in it (at least 1), or of twice the degrees if the surface is rational
/// (degrees up to 15). Exact.
///
/// @param direction  FPT_DIRECTION_U or FPT_DIRECTION_V
/// @return FPT_UNSUPPORTED when the derivative jumps at a knot, which is named
/// @param out  the new surface; release it with fpt_surface_free
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_derivative(
    surface: *const fpt_surface,
    direction: u32,
    out: *mut *mut fpt_surface,
) -> fpt_status {
    // SAFETY: the header asks for live handles and room for what comes out.
    guard(|| unsafe {
        let (surface, direction) = (plain(surface)?, read_direction(direction)?);
        let out = place("out", out)?;
        hand_over(surface.derivative(direction)?, out)
    })
}

/// The same surface with knots of full multiplicity: patch (i, j) has the poles from (i * degree_u, j * degree_v) on. Exact.
///
/// @param out  the new surface; release it with fpt_surface_free
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_bezier_form(
    surface: *const fpt_surface,
    out: *mut *mut fpt_surface,
) -> fpt_status {
    // SAFETY: the header asks for live handles and room for what comes out.
    guard(|| unsafe {
        let surface = plain(surface)?;
        let out = place("out", out)?;
        hand_over(surface.bezier_form()?, out)
    })
}

/// The parts of the surface before and behind an isocurve. Exact.
///
/// @param direction  FPT_DIRECTION_U or FPT_DIRECTION_V
/// @param at  inside the domain
/// @param out_before  the first part; release it with fpt_surface_free
/// @param out_behind  the second part; release it with fpt_surface_free
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_split(
    surface: *const fpt_surface,
    direction: u32,
    at: f64,
    out_before: *mut *mut fpt_surface,
    out_behind: *mut *mut fpt_surface,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for two.
    guard(|| unsafe {
        let (surface, direction) = (plain(surface)?, read_direction(direction)?);
        let (before, behind) = (place("out_before", out_before)?, place("out_behind", out_behind)?);
        let parts = match direction {
            Direction::U => surface.split_u(at)?,
            Direction::V => surface.split_v(at)?,
        };
        (*before, *behind) = (handle(parts.0), handle(parts.1));
        Ok(())
    })
}

/// The curve on the surface with one parameter fixed. Exact.
///
/// @param direction  of the parameter that is fixed: FPT_DIRECTION_U or FPT_DIRECTION_V
/// @param at   in the domain
/// @param out  the curve, over the other parameter; release it with fpt_curve_free
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_isocurve(
    surface: *const fpt_surface,
    direction: u32,
    at: f64,
    out: *mut *mut fpt_curve,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for one.
    guard(|| unsafe {
        let (surface, direction) = (plain(surface)?, read_direction(direction)?);
        let out = place("out", out)?;
        if !surface.knots(direction).contains(at) {
            return Err(Failure::invalid(format!("at: {at} is outside the domain")));
        }
        let curve = match direction {
            Direction::U => surface.isocurve_u(at),
            Direction::V => surface.isocurve_v(at),
        };
        operate_curve::hand_over(curve, out)
    })
}

/// The surfaces as one along a direction, each beginning where the one before ends, as fpt_curve_join. In the other direction all get the domain of
/// the first.
///
/// @param surfaces   live handles
/// @param direction  FPT_DIRECTION_U or FPT_DIRECTION_V
/// @param tolerance  length, finite, >= 0
/// @param out_error  how far points move, proven; NULL: not wanted
/// @param out        the new surface; release it with fpt_surface_free
/// @return FPT_UNSUPPORTED when weights do not agree where two meet
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_join(
    surfaces: *const *const fpt_surface,
    count: usize,
    direction: u32,
    tolerance: f64,
    out_error: *mut f64,
    out: *mut *mut fpt_surface,
) -> fpt_status {
    // SAFETY: the header asks for an array of live handles and room for what comes out.
    guard(|| unsafe {
        let (surfaces, direction) = (all(surfaces, count)?, read_direction(direction)?);
        let out = place("out", out)?;
        bounded(join_surfaces(&surfaces, direction, tolerance)?, out_error, out)
    })
}

/// The same surfaces, clamped, with the same degrees, knot vectors and domain, as fpt_curve_make_compatible. Exact.
///
/// @param surfaces  live handles, at least one
/// @param out       room for count handles; release each with fpt_surface_free
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_make_compatible(
    surfaces: *const *const fpt_surface,
    count: usize,
    out: *mut *mut fpt_surface,
) -> fpt_status {
    // SAFETY: the header asks for an array of live handles and room for as many.
    guard(|| unsafe {
        let surfaces = all(surfaces, count)?;
        let out = output("out", out, count)?;
        for (surface, out) in compatible_surfaces(&surfaces)?.into_iter().zip(out) {
            *out = handle(surface);
        }
        Ok(())
    })
}

/// How far two surfaces over the same domain are apart at equal parameters; degrees and knots may differ.
///
/// @param surface  a spline
/// @param other    a spline over the same domain
/// @param out      as in fpt_curve_difference
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_difference(
    surface: *const fpt_surface,
    other: *const fpt_surface,
    out: *mut fpt_difference,
) -> fpt_status {
    // SAFETY: the header asks for two live handles and room for a record.
    guard(|| unsafe { write("out", plain(surface)?.difference(plain(other)?)?.into(), out) })
}
