//! Batches of queries in single precision: scans and meshes come in floats.
//!
//! A float is a double; nothing is rounded. Each function is the one of the same name without `_f32`, with another reader.

use super::curve::{self, fpt_curve};
use super::form::{CurveForm, SurfaceForm};
use super::options::fpt_query_options;
use super::query::Batch;
use super::records::fpt_foot_point;
use super::surface::{self, fpt_surface};
use super::{fpt_status, guard};

/// As fpt_curve_closest, for query points in single precision. The answers are those of the same numbers in double
/// precision, bit for bit.
///
/// @param points   `count` query points x,y,z, options->point_stride bytes apart, without alignment. A bad point (NaN,
///                 infinite) marks its own record with FPT_FOOT_BAD_QUERY
/// @param count    may be 0, then `points` and `out` may be NULL
/// @param options  NULL: the defaults; hints are doubles
/// @param out      `count` records, packed; must not overlap `points` or the hints
/// @return as fpt_curve_closest
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_curve_closest_f32(
    curve: *const fpt_curve,
    points: *const f32,
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

/// As fpt_curve_invert, for query points in single precision. A float is off by up to 6e-8 of its coordinates: the
/// tolerance has to allow for that.
///
/// @param points   `count` query points x,y,z, options->point_stride bytes apart, without alignment. A bad point (NaN,
///                 infinite) marks its own record with FPT_FOOT_BAD_QUERY
/// @param count    may be 0, then `points` and `out` may be NULL
/// @param options  NULL: the defaults; hints are doubles
/// @param out      `count` records, packed; must not overlap `points` or the hints
/// @return as fpt_curve_invert
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_curve_invert_f32(
    curve: *const fpt_curve,
    points: *const f32,
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

/// As fpt_surface_closest, for query points in single precision. The answers are those of the same numbers in double
/// precision, bit for bit.
///
/// @param points   `count` query points x,y,z, options->point_stride bytes apart, without alignment. A bad point (NaN,
///                 infinite) marks its own record with FPT_FOOT_BAD_QUERY
/// @param count    may be 0, then `points` and `out` may be NULL
/// @param options  NULL: the defaults; hints are doubles
/// @param out      `count` records, packed; must not overlap `points` or the hints
/// @return as fpt_surface_closest
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_closest_f32(
    surface: *const fpt_surface,
    points: *const f32,
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

/// As fpt_surface_invert, for query points in single precision. A float is off by up to 6e-8 of its coordinates: the
/// tolerance has to allow for that.
///
/// @param points   `count` query points x,y,z, options->point_stride bytes apart, without alignment. A bad point (NaN,
///                 infinite) marks its own record with FPT_FOOT_BAD_QUERY
/// @param count    may be 0, then `points` and `out` may be NULL
/// @param options  NULL: the defaults; hints are doubles
/// @param out      `count` records, packed; must not overlap `points` or the hints
/// @return as fpt_surface_invert
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_invert_f32(
    surface: *const fpt_surface,
    points: *const f32,
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
