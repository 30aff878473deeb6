//! Lines: crossings as sets, projection along a direction as batches.

use super::curve::{self, fpt_curve};
use super::memory::{array, place};
use super::options::{check_length, fpt_query_options};
use super::query::{Batch, Callbacks, check_restriction};
use super::records::fpt_foot_point;
use super::sets::{fpt_foot_set, hand_over, point};
use super::surface::{self, fpt_surface};
use super::{Failure, fpt_status, guard};
use crate::preimage::{Line, ProjectMemory};

/// A line from its numbers.
///
/// # Safety
/// NULL or arrays of three, three and two numbers; `reach` may be NULL.
unsafe fn line(
    origin: *const f64,
    direction: *const f64,
    reach: *const f64,
) -> Result<Line, Failure> {
    // SAFETY: the caller vouches for it.
    unsafe {
        let (origin, direction) = (point("origin", origin)?, point("direction", direction)?);
        let reach = match reach.is_null() {
            true => [f64::NEG_INFINITY, f64::INFINITY],
            false => {
                let ends = array("reach", reach, 2)?;
                [ends[0], ends[1]]
            }
        };
        let line = Line { origin, direction, reach };
        line.check()?;
        Ok(line)
    }
}

/// All parameters of a curve whose point lies within a tolerance of a line, or of a part of it (a ray), with proof that
/// none is missing, in the order along the line. The distance of a member is that from the line.
///
/// @param origin     3 finite numbers: a point of the line
/// @param direction  3 finite numbers, not all 0; its length does not matter
/// @param reach      2 numbers: least and greatest length along the direction from the origin, infinities allowed (a ray: 0
///                   and infinity); NULL: the whole line
/// @param tolerance  length, finite, >= 0; 0: 1e-7 x the diagonal of the curve's box
/// @param options    as for fpt_curve_preimage
/// @param out        the set; release it with fpt_foot_set_free
/// @return as fpt_curve_preimage
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_curve_on_line(
    curve: *const fpt_curve,
    origin: *const f64,
    direction: *const f64,
    reach: *const f64,
    tolerance: f64,
    options: *const fpt_query_options,
    out: *mut *mut fpt_foot_set,
) -> fpt_status {
    // SAFETY: the header asks for a live handle, arrays of these lengths, options and room for a handle.
    guard(|| unsafe {
        let curve = curve::indexed(curve)?;
        let line = self::line(origin, direction, reach)?;
        check_length("tolerance", tolerance)?;
        let given = fpt_query_options::read(options)?;
        let options = given.checked(2)?;
        check_restriction(curve, options.domain)?;
        let out = place("out", out)?;
        let callbacks = Callbacks::of(&given);
        let set = curve.on_line(&line, tolerance, &options, &mut || callbacks.poll(0, 1))?;
        hand_over(set, out)
    })
}

/// All parameters of a surface whose point lies within a tolerance of a line, or of a part of it (a ray), with proof
/// that none is missing, in the order along the line. The distance of a member is that from the line.
///
/// Crossings and touching points are members of kind point; where the line runs in the surface along a parameter
/// line the member is an arc.
///
/// @param origin     3 finite numbers: a point of the line
/// @param direction  3 finite numbers, not all 0; its length does not matter
/// @param reach      2 numbers: least and greatest length along the direction from the origin, infinities allowed (a ray: 0
///                   and infinity); NULL: the whole line
/// @param tolerance  length, finite, >= 0; 0: 1e-7 x the diagonal of the surface's box
/// @param options    as for fpt_surface_preimage
/// @param out        the set; release it with fpt_foot_set_free
/// @return as fpt_surface_preimage
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_on_line(
    surface: *const fpt_surface,
    origin: *const f64,
    direction: *const f64,
    reach: *const f64,
    tolerance: f64,
    options: *const fpt_query_options,
    out: *mut *mut fpt_foot_set,
) -> fpt_status {
    // SAFETY: the header asks for a live handle, arrays of these lengths, options and room for a handle.
    guard(|| unsafe {
        let surface = surface::indexed(surface)?;
        let line = self::line(origin, direction, reach)?;
        check_length("tolerance", tolerance)?;
        let given = fpt_query_options::read(options)?;
        let options = given.checked(4)?;
        check_restriction(surface, options.domain)?;
        let out = place("out", out)?;
        let callbacks = Callbacks::of(&given);
        let set = surface.on_line(&line, tolerance, &options, &mut || callbacks.poll(0, 1))?;
        hand_over(set, out)
    })
}

/// The point of a curve on the line through each query point along a direction, to either side, that is nearest to the
/// query point.
///
/// A record has distance = |query - point|, and lower_bound: nothing of the curve within the tolerance of the line
/// is nearer. Where the line misses the curve the record has FPT_FOOT_NOT_ON_SHAPE, NaN in u, v and point, and an infinite
/// distance. FPT_FOOT_NOT_PROVEN with FPT_FOOT_BUDGET: parts of the curve were not decided.
///
/// @param points     as for fpt_curve_closest
/// @param count      as for fpt_curve_closest
/// @param direction  3 finite numbers, not all 0; its length does not matter
/// @param options    tolerance: how far from the line counts as on it (0: 1e-7 x the diagonal of the curve's box);
///                   hints, method, scope and trace are not used; NULL: the defaults
/// @param out        as for fpt_curve_closest
/// @return as fpt_curve_closest
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_curve_project(
    curve: *const fpt_curve,
    points: *const f64,
    count: usize,
    direction: *const f64,
    options: *const fpt_query_options,
    out: *mut fpt_foot_point,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and arrays of these lengths that do not overlap.
    guard(|| unsafe {
        let curve = curve::indexed(curve)?;
        let line = self::line([0.0; 3].as_ptr(), direction, std::ptr::null())?;
        Batch::read(curve, points, count, options, out)?
            .run(|c, q, _, o, w: &mut ProjectMemory, _| c.project(q, line.direction, o, w))
    })
}

/// The point of a surface on the line through each query point along a direction, to either side, that is nearest to the
/// query point: as fpt_curve_project.
///
/// @param points     as for fpt_surface_closest
/// @param count      as for fpt_surface_closest
/// @param direction  3 finite numbers, not all 0; its length does not matter
/// @param options    as for fpt_curve_project
/// @param out        as for fpt_surface_closest
/// @return as fpt_surface_closest
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_project(
    surface: *const fpt_surface,
    points: *const f64,
    count: usize,
    direction: *const f64,
    options: *const fpt_query_options,
    out: *mut fpt_foot_point,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and arrays of these lengths that do not overlap.
    guard(|| unsafe {
        let surface = surface::indexed(surface)?;
        let line = self::line([0.0; 3].as_ptr(), direction, std::ptr::null())?;
        Batch::read(surface, points, count, options, out)?
            .run(|s, q, _, o, w: &mut ProjectMemory, _| s.project(q, line.direction, o, w))
    })
}
