//! Offsets of curves and surfaces.

use super::construct::{numbers, wanted};
use super::curve::{self, fpt_curve};
use super::fit::{curve_handle, surface_handle};
use super::form::{CurveForm, SurfaceForm};
use super::memory::place;
use super::surface::{self, fpt_surface};
use super::{fpt_status, guard};
use crate::callback::{CurveBounds, SurfaceBounds};
use crate::construct::{offset_curve, offset_curve_fit, offset_surface, offset_surface_fit};
use std::sync::Arc;

/// The exact offset of a spline curve in a plane, as a curve from a function (with derivatives to order 2, without bounds).
///
/// @param distance      to the right of the curve's direction, seen from the tip of the normal; negative: to the left
/// @param plane_normal  x,y,z, any length
/// @param out           the handle; release it with fpt_curve_free
/// @return FPT_UNSUPPORTED for a curve from a callback
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_curve_offset(
    curve: *const fpt_curve,
    distance: f64,
    plane_normal: *const f64,
    out: *mut *mut fpt_curve,
) -> fpt_status {
    // SAFETY: the header asks for a live handle, a vector and room for a handle.
    guard(|| unsafe {
        let base = curve::indexed(curve)?.curve();
        let normal = numbers("plane_normal", plane_normal)?;
        let out = place("out", out)?;
        let offset = offset_curve(base, distance, normal, CurveBounds::default())?;
        *out = fpt_curve::handle(CurveForm::Function(Arc::new(offset)));
        Ok(())
    })
}

/// The offset of fpt_curve_offset as a spline over the same domain.
///
/// @param degree     of the spline, 1 to 31
/// @param tolerance  wished greatest distance from the exact offset at equal parameters, more than 0
/// @param out        the handle; release it with fpt_curve_free
/// @param measured   that distance, at dense samples; NULL: not wanted
/// @param proven     no point is farther from the exact offset; above the tolerance: not reached or not proven (infinity). NULL: not wanted
/// @return FPT_UNSUPPORTED where the tangent jumps or is missing
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_curve_offset_fit(
    curve: *const fpt_curve,
    distance: f64,
    plane_normal: *const f64,
    degree: usize,
    tolerance: f64,
    out: *mut *mut fpt_curve,
    measured: *mut f64,
    proven: *mut f64,
) -> fpt_status {
    // SAFETY: the header asks for a live handle, a vector and room for the outputs.
    guard(|| unsafe {
        let base = curve::indexed(curve)?.curve();
        let normal = numbers("plane_normal", plane_normal)?;
        let out = place("out", out)?;
        let errors = [wanted("measured", measured)?, wanted("proven", proven)?];
        let fit = offset_curve_fit(base, distance, normal, degree, tolerance)?;
        *out = curve_handle(fit.shape);
        for (place, value) in errors.into_iter().zip([fit.measured, fit.proven]) {
            place.into_iter().for_each(|place| *place = value);
        }
        Ok(())
    })
}

/// The exact offset of a spline surface along its normal, as a surface from a function (with derivatives to order 2, without bounds).
///
/// @param distance  along S_u x S_v; negative: against it
/// @param out       the handle; release it with fpt_surface_free
/// @return FPT_UNSUPPORTED for a surface from a callback
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_offset(
    surface: *const fpt_surface,
    distance: f64,
    out: *mut *mut fpt_surface,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for one.
    guard(|| unsafe {
        let base = surface::indexed(surface)?.surface();
        let out = place("out", out)?;
        let offset = offset_surface(base, distance, SurfaceBounds::default())?;
        *out = fpt_surface::handle(SurfaceForm::Function(Arc::new(offset)));
        Ok(())
    })
}

/// The offset of a surface as a spline over the same domain. At collapsed edges the normal is its limit.
///
/// @param distance   along S_u x S_v; negative: against it
/// @param degree_u   of the spline, 1 to 31
/// @param degree_v   of the spline, 1 to 31
/// @param tolerance  wished greatest distance from the exact offset at equal parameters, more than 0
/// @param out        the handle; release it with fpt_surface_free
/// @param measured   that distance, at dense samples; NULL: not wanted
/// @param proven     no point is farther from the exact offset; above the tolerance: not reached or not proven (infinity: always so at
///                   collapsed edges). NULL: not wanted
/// @return FPT_UNSUPPORTED where the normal jumps or is missing
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_offset_fit(
    surface: *const fpt_surface,
    distance: f64,
    degree_u: usize,
    degree_v: usize,
    tolerance: f64,
    out: *mut *mut fpt_surface,
    measured: *mut f64,
    proven: *mut f64,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for the outputs.
    guard(|| unsafe {
        let base = surface::indexed(surface)?.surface();
        let out = place("out", out)?;
        let errors = [wanted("measured", measured)?, wanted("proven", proven)?];
        let fit = offset_surface_fit(base, distance, [degree_u, degree_v], tolerance)?;
        *out = surface_handle(fit.shape);
        for (place, value) in errors.into_iter().zip([fit.measured, fit.proven]) {
            place.into_iter().for_each(|place| *place = value);
        }
        Ok(())
    })
}
