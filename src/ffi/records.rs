//! Records that go out: the foot point and its flags, the same layout as the engine's own.

use super::Failure;
use super::memory;
use crate::closest::{FootPoint, flag};
use std::mem::{align_of, offset_of, size_of};

/// The answer to one query: 64 bytes, frozen.
///
/// A query that was not reached when should_stop ended the call has NaN in u, v, point and distance,
/// lower_bound 0 and FPT_FOOT_NOT_PROVEN. A bad query point (NaN, infinite or beyond 1e100) has
/// FPT_FOOT_BAD_QUERY.
#[repr(C)]
pub struct fpt_foot_point {
    /// First parameter, in the domain.
    pub u: f64,
    /// Second parameter, in the domain; 0 on a curve.
    pub v: f64,
    /// The shape at (u,v), bit for bit what _evaluate returns there.
    pub point: [f64; 3],
    /// |query - point|.
    pub distance: f64,
    /// Proven: nothing on the shape (in the restricted domain) is nearer to the query than this. At
    /// most distance; 0 in local scope.
    pub lower_bound: f64,
    /// Sum of fpt_foot_flag values.
    pub flags: u32,
    /// Evaluations of the shape spent on this query.
    pub iterations: u32,
}

/// The bits of fpt_foot_point.flags.
#[repr(C)]
pub enum fpt_foot_flag {
    /// distance - lower_bound is more than the accuracy and the rounding floor of this shape and query; the grain of
    /// the parameters (at most 1e-9 of the box diagonal) counts as rounding too.
    FPT_FOOT_NOT_PROVEN = 1,
    /// One parameter is bit-equal to an end of the domain; on a curve: the foot is an end.
    FPT_FOOT_EDGE = 2,
    /// Both parameters are bit-equal to ends of the domain.
    FPT_FOOT_CORNER = 4,
    /// The foot lies on the seam of a closed direction.
    FPT_FOOT_SEAM = 8,
    /// The foot lies on an edge that is a single point.
    FPT_FOOT_COLLAPSED = 16,
    /// Another foot point lies within the accuracy of the least distance, or could not be excluded within the budget. One
    /// point with several parameters is one foot (see fpt_surface_preimage); places nearer to one another than
    /// 8 x sqrt(distance x accuracy) are one foot. Where the answer itself is not proven, its absence proves nothing.
    FPT_FOOT_TIE = 32,
    /// The feet form an arc or region, equally near up to rounding; comes with FPT_FOOT_TIE. In a set: all parameters of
    /// the member's intervals; an arc that is a collapsed edge has FPT_FOOT_COLLAPSED instead.
    FPT_FOOT_CONTINUUM = 64,
    /// invert: lower_bound is more than the tolerance. With FPT_FOOT_NOT_PROVEN as well the distance is
    /// more than the tolerance but the bound is not.
    FPT_FOOT_NOT_ON_SHAPE = 128,
    /// The query point has a NaN, an infinity or a coordinate beyond 1e100.
    FPT_FOOT_BAD_QUERY = 256,
    /// A hint was given and the search began there.
    FPT_FOOT_HINT_USED = 512,
    /// The budget ran out before the proof was complete.
    FPT_FOOT_BUDGET = 1024,
    /// The foot lies on a geometric break of the tangent.
    FPT_FOOT_CREASE = 2048,
}
use fpt_foot_flag::*;

// The engine writes its own records straight into the caller's array: the layouts must agree.
const _: () = {
    assert!(size_of::<fpt_foot_point>() == 64 && size_of::<FootPoint>() == 64);
    assert!(align_of::<fpt_foot_point>() == align_of::<FootPoint>());
    assert!(offset_of!(fpt_foot_point, u) == offset_of!(FootPoint, u));
    assert!(offset_of!(fpt_foot_point, v) == offset_of!(FootPoint, v));
    assert!(offset_of!(fpt_foot_point, point) == offset_of!(FootPoint, point));
    assert!(offset_of!(fpt_foot_point, distance) == offset_of!(FootPoint, distance));
    assert!(offset_of!(fpt_foot_point, lower_bound) == offset_of!(FootPoint, lower_bound));
    assert!(offset_of!(fpt_foot_point, flags) == offset_of!(FootPoint, flags));
    assert!(offset_of!(fpt_foot_point, iterations) == offset_of!(FootPoint, iterations));
    assert!(FPT_FOOT_NOT_PROVEN as u32 == flag::NOT_PROVEN);
    assert!(FPT_FOOT_EDGE as u32 == flag::EDGE);
    assert!(FPT_FOOT_CORNER as u32 == flag::CORNER);
    assert!(FPT_FOOT_SEAM as u32 == flag::SEAM);
    assert!(FPT_FOOT_COLLAPSED as u32 == flag::COLLAPSED);
    assert!(FPT_FOOT_TIE as u32 == flag::TIE);
    assert!(FPT_FOOT_CONTINUUM as u32 == flag::CONTINUUM);
    assert!(FPT_FOOT_NOT_ON_SHAPE as u32 == flag::NOT_ON_SHAPE);
    assert!(FPT_FOOT_BAD_QUERY as u32 == flag::BAD_QUERY);
    assert!(FPT_FOOT_HINT_USED as u32 == flag::HINT_USED);
    assert!(FPT_FOOT_BUDGET as u32 == flag::BUDGET);
    assert!(FPT_FOOT_CREASE as u32 == flag::CREASE);
};

/// The caller's records as the engine's.
///
/// # Safety
/// As [`memory::output`].
pub(super) unsafe fn feet<'a>(
    out: *mut fpt_foot_point,
    count: usize,
) -> Result<&'a mut [FootPoint], Failure> {
    // SAFETY: the layouts agree (above), every bit pattern is a record; the caller vouches for the rest.
    unsafe { memory::output("out", out.cast::<FootPoint>(), count) }
}
