//! Closed directions unrolled, and polylines of points inverted as paths.

use super::curve::{self, fpt_curve};
use super::memory::{array, optional_output, write};
use super::options::fpt_query_options;
use super::query::{Batch, Together};
use super::records::fpt_foot_point;
use super::surface::{self, fpt_surface};
use super::{Failure, fpt_status, guard};
use crate::index::{IndexedCurve, IndexedSurface};
use crate::unwrap::{PathOutput, change};

/// The bits of the changes along a path.
#[repr(C)]
pub enum fpt_path_change {
    /// The foot is on another branch of the shape: it does not follow from the one before while the query moves
    /// straight from point to point, or it rushes ahead more than 16 times as far as the query on the way.
    FPT_PATH_JUMP = 1,
    /// The number of turns changed in a closed direction.
    FPT_PATH_SEAM_CROSSED = 2,
    /// The foot is on a collapsed edge, or the step leads over one.
    FPT_PATH_THROUGH_COLLAPSED = 4,
    /// Another foot is as near within the accuracy; the one that continues the path was taken.
    FPT_PATH_TIE = 8,
}
use fpt_path_change::*;

const _: () = {
    assert!(FPT_PATH_JUMP as u32 == change::JUMP);
    assert!(FPT_PATH_SEAM_CROSSED as u32 == change::SEAM_CROSSED);
    assert!(FPT_PATH_THROUGH_COLLAPSED as u32 == change::THROUGH_COLLAPSED);
    assert!(FPT_PATH_TIE as u32 == change::TIE);
};

/// The parameter that continues a path on a closed curve: u plus the whole number of turns (lengths of the domain) that
/// brings it nearest to the previous one; of two as near the lesser. On an open curve u itself.
///
/// @param previous  the unwrapped parameter before; finite, at most 1e9 turns away
/// @param u         in the domain, else FPT_INVALID_ARGUMENT
/// @param out_u     the unwrapped parameter
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_curve_unwrap(
    curve: *const fpt_curve,
    previous: f64,
    u: f64,
    out_u: *mut f64,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for the value.
    guard(|| unsafe { write("out_u", curve::indexed(curve)?.unwrap(previous, u)?, out_u) })
}

/// The parameters that continue a path on a surface: in a closed direction plus the whole number of turns that brings the
/// parameter nearest to the previous one (of two as near the lesser), in an open one as they are.
///
/// @param previous  2 numbers: the unwrapped parameters before; finite, at most 1e9 turns away
/// @param uv        2 numbers in the domain, else FPT_INVALID_ARGUMENT
/// @param out_uv    2 numbers: the unwrapped parameters
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_unwrap(
    surface: *const fpt_surface,
    previous: *const f64,
    uv: *const f64,
    out_uv: *mut f64,
) -> fpt_status {
    // SAFETY: the header asks for a live handle, two pairs and room for a pair.
    guard(|| unsafe {
        let surface = surface::indexed(surface)?;
        let pair = |name, pointer| {
            array(name, pointer, 2).map(|pair: &[f64]| -> [f64; 2] { [pair[0], pair[1]] })
        };
        let (previous, uv) = (pair("previous", previous)?, pair("uv", uv)?);
        write("out_uv", surface.unwrap(previous, uv)?, out_uv.cast())
    })
}

/// The parameters of a polyline of points along the curve, as a path: each answer is that of fpt_curve_invert for the point
/// alone, with the same distance, but where another foot is as near within the accuracy the one that continues the
/// path is taken. A bad point is stepped over.
///
/// @param points        as for fpt_curve_closest, in the order of the path
/// @param count         as for fpt_curve_closest
/// @param options       NULL: the defaults
/// @param out           as for fpt_curve_closest
/// @param out_unwrapped `count` numbers or NULL: u with whole turns of a closed curve, consecutive along the path; NaN
///                      for a bad point
/// @param out_changes   `count` numbers or NULL: sums of fpt_path_change values, about the step to each point
/// @return after FPT_CANCELLED `out` is as fpt_curve_closest leaves it, perhaps not yet joined; the other arrays have
///         no defined contents
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_curve_path(
    curve: *const fpt_curve,
    points: *const f64,
    count: usize,
    options: *const fpt_query_options,
    out: *mut fpt_foot_point,
    out_unwrapped: *mut f64,
    out_changes: *mut u32,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and arrays of these lengths that do not overlap.
    guard(|| unsafe {
        let curve = curve::indexed(curve)?;
        let mut batch: Batch<IndexedCurve, 1> = Batch::read(curve, points, count, options, out)?;
        let output = path_output(out_unwrapped.cast(), out_changes, count)?;
        let together = Some(IndexedCurve::invert_together as Together<_, _, 1>);
        batch.answer(|c, q, h, o, w, t| c.invert(q, h.map(|[u]| u), o, w, t), together)?;
        let Batch { shape, points, options, callbacks, out, .. } = batch;
        let mut poll = || callbacks.poll(count, count);
        Ok(shape.join(&|i| points.row(i), out, &options, output, &mut poll)?)
    })
}

/// The parameters of a polyline of points along the surface, as a path: as fpt_curve_path, and on a collapsed edge the
/// parameter along it stays what it was before.
///
/// @param points        as for fpt_surface_closest, in the order of the path
/// @param count         as for fpt_surface_closest
/// @param options       NULL: the defaults
/// @param out           as for fpt_surface_closest
/// @param out_unwrapped 2*count numbers or NULL: u, v with whole turns in closed directions, consecutive along the path;
///                      NaN for a bad point
/// @param out_changes   `count` numbers or NULL: sums of fpt_path_change values, about the step to each point
/// @return as fpt_curve_path
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_path(
    surface: *const fpt_surface,
    points: *const f64,
    count: usize,
    options: *const fpt_query_options,
    out: *mut fpt_foot_point,
    out_unwrapped: *mut f64,
    out_changes: *mut u32,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and arrays of these lengths that do not overlap.
    guard(|| unsafe {
        let surface = surface::indexed(surface)?;
        let mut batch: Batch<IndexedSurface, 2> =
            Batch::read(surface, points, count, options, out)?;
        let output = path_output(out_unwrapped.cast(), out_changes, count)?;
        batch.answer(IndexedSurface::invert, Some(IndexedSurface::invert_together))?;
        let Batch { shape, points, options, callbacks, out, .. } = batch;
        let mut poll = || callbacks.poll(count, count);
        Ok(shape.join(&|i| points.row(i), out, &options, output, &mut poll)?)
    })
}

/// The further arrays of a path.
///
/// # Safety
/// As [`optional_output`].
unsafe fn path_output<'a, const N: usize>(
    unwrapped: *mut [f64; N],
    changes: *mut u32,
    count: usize,
) -> Result<PathOutput<'a, N>, Failure> {
    // SAFETY: the caller vouches for it.
    unsafe {
        Ok(PathOutput {
            unwrapped: optional_output("out_unwrapped", unwrapped, count)?,
            changes: optional_output("out_changes", changes, count)?,
        })
    }
}
