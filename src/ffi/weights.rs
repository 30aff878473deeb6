//! Weights from wishes: the methods.

use super::curve::{self, fpt_curve};
use super::memory::{array, place};
use super::surface::{self, fpt_surface};
use super::weights_records::{
    fpt_weights_constraint, fpt_weights_constraint_kind, fpt_weights_options,
};
use super::weights_report::{fpt_weights_report, hand_over};
use super::{Failure, fpt_status, guard};
use crate::error::Error;
use crate::weights::network::network;
use crate::weights::published::{general, interpolated};
use crate::weights::refine::refine;
use crate::weights::{Constraint, Net, Wish};

/// The wishes of the caller.
///
/// # Safety
/// NULL or arrays of `count` elements.
unsafe fn wishes(
    poles: *const usize,
    distances: *const f64,
    count: usize,
) -> Result<Vec<Wish>, Failure> {
    // SAFETY: the caller vouches for both arrays.
    let (poles, distances) =
        unsafe { (array("wish_poles", poles, count)?, array("wish_distances", distances, count)?) };
    let mut out = Vec::new();
    out.try_reserve_exact(count).map_err(|_| Error::OutOfMemory)?;
    let each = poles.iter().zip(distances);
    out.extend(each.map(|(&pole, &distance)| Wish { pole, distance }));
    Ok(out)
}

/// The constraints of the caller.
///
/// # Safety
/// NULL or an array of `count` elements.
unsafe fn constraints(
    list: *const fpt_weights_constraint,
    count: usize,
) -> Result<Vec<Constraint>, Failure> {
    // SAFETY: the caller vouches for the array.
    let list = unsafe { array("constraints", list, count) }?;
    let mut out = Vec::new();
    out.try_reserve_exact(count).map_err(|_| Error::OutOfMemory)?;
    for (i, c) in list.iter().enumerate() {
        if c.reserved != 0 {
            let text = format!("constraints: constraint {i}: reserved {} must be 0", c.reserved);
            return Err(Failure::invalid(text));
        }
        use fpt_weights_constraint_kind::*;
        out.push(match c.kind {
            kind if kind == FPT_CONSTRAINT_POINT_AT as u32 => {
                Constraint::PointAt([c.u, c.v], c.vector)
            }
            kind if kind == FPT_CONSTRAINT_POINT as u32 => Constraint::Point(c.vector),
            kind if kind == FPT_CONSTRAINT_TANGENT_AT as u32 => {
                Constraint::TangentAt(c.u, c.vector)
            }
            kind if kind == FPT_CONSTRAINT_TANGENT_KEPT as u32 => Constraint::TangentKept(c.u),
            kind => {
                let text =
                    format!("constraints: constraint {i}: {kind} is not an FPT_CONSTRAINT_ value");
                return Err(Failure::invalid(text));
            }
        });
    }
    Ok(out)
}

/// The general formula: each pole's weight is 1/lambda - 1 for the relative distance lambda of the curve from it.
///
/// lambda is distance over chord distance, the chord being the segment between the two points of the curve where the pole's basis
/// function begins and ends (of one span: from the first to the last point; of a closed curve of one span: that point). A pole on
/// its chord, like the ends of a clamped curve, has weight 1 and no wish. The wish in the report is lambda x the chord distance; a formula
/// does not meet it exactly.
///
/// @param lambdas       one a pole, each between 0 and 1, both excluded; the error names the first that is not
/// @param lambda_count  the number of poles
/// @param options       range of the weights and tolerance count; NULL: the defaults
/// @param out           the report; release it with fpt_weights_report_free
/// @return FPT_INVALID_ARGUMENT also for a pole that coincides with its neighbour, FPT_UNSUPPORTED for a curve from a callback
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_weights_general(
    curve: *const fpt_curve,
    lambdas: *const f64,
    lambda_count: usize,
    options: *const fpt_weights_options,
    out: *mut *mut fpt_weights_report,
) -> fpt_status {
    // SAFETY: the header asks for a live handle, an array, options and room for a handle.
    guard(|| unsafe {
        let curve = curve::indexed(curve)?.curve();
        let lambdas = array("lambdas", lambdas, lambda_count)?;
        let (options, _) = fpt_weights_options::read(options)?;
        let out = place("out", out)?;
        hand_over(general(curve, lambdas, &options)?, out)
    })
}

/// Linear interpolation: distances run evenly, in the order of the poles, from first_distance to last_distance; weights as
/// fpt_weights_general. The run may rise, fall or stay. A distance that is not less than that of the chord, or whose weight is outside
/// the range, takes the nearest weight of the range (FPT_WEIGHT_LIMITED).
///
/// @param first_distance  of the first pole, finite, >= 0
/// @param last_distance   of the last pole, finite, >= 0
/// @param options         range of the weights and tolerance count; NULL: the defaults
/// @param out             the report; release it with fpt_weights_report_free
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_weights_interpolated(
    curve: *const fpt_curve,
    first_distance: f64,
    last_distance: f64,
    options: *const fpt_weights_options,
    out: *mut *mut fpt_weights_report,
) -> fpt_status {
    // SAFETY: the header asks for a live handle, options and room for a handle.
    guard(|| unsafe {
        let curve = curve::indexed(curve)?.curve();
        let (options, _) = fpt_weights_options::read(options)?;
        let out = place("out", out)?;
        hand_over(interpolated(curve, [first_distance, last_distance], &options)?, out)
    })
}

/// The embedded network: wished distances for some poles; the distances of all others, by the formula, stay within a range. It is
/// trained inside the call, in at most `steps` steps, and has the same bits for the same inputs and seed.
///
/// Without wishes all weights are random within the range; with a wish for each pole, or with equal ends of the range, they are those of
/// the formula. A pole whose chord distance is not more than min_distance has no weight in the range: it gets the least weight
/// (FPT_WEIGHT_LIMITED).
///
/// @param wish_poles      `wish_count` numbers of poles, none twice
/// @param wish_distances  `wish_count` distances within the range
/// @param wish_count      0: no wishes, both arrays may be NULL
/// @param min_distance    finite, >= 0
/// @param max_distance    finite, at least min_distance
/// @param options         range of the weights, tolerance, seed and steps count; NULL: the defaults
/// @param out             the report; release it with fpt_weights_report_free
/// @return FPT_INVALID_ARGUMENT names the wish; also for one at a pole that coincides with its neighbour
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_weights_network(
    curve: *const fpt_curve,
    wish_poles: *const usize,
    wish_distances: *const f64,
    wish_count: usize,
    min_distance: f64,
    max_distance: f64,
    options: *const fpt_weights_options,
    out: *mut *mut fpt_weights_report,
) -> fpt_status {
    // SAFETY: the header asks for a live handle, arrays, options and room for a handle.
    guard(|| unsafe {
        let curve = curve::indexed(curve)?.curve();
        let wishes = wishes(wish_poles, wish_distances, wish_count)?;
        let (options, _) = fpt_weights_options::read(options)?;
        let out = place("out", out)?;
        hand_over(network(curve, &wishes, [min_distance, max_distance], &options)?, out)
    })
}

/// Weights whose curve really has the wished distances from its poles and meets the constraints, measured and bounded by
/// fpt_curve_closest; the weights of poles without a wish are as near 1 as they can be (all, when each pole has one).
///
/// A wish that is not met, or proven impossible for all weights of the range, is reported, with the best weights found. The given weights of
/// the curve only matter for FPT_CONSTRAINT_TANGENT_KEPT, and as one start. About a millisecond for 10 poles; wishes that
/// cannot be met take up to `starts` searches.
///
/// @param wish_poles        `wish_count` numbers of poles, none twice
/// @param wish_distances    `wish_count` distances, finite, >= 0
/// @param wish_count        0: no wishes, both arrays may be NULL
/// @param constraints       `constraint_count` constraints
/// @param constraint_count  0: none, the array may be NULL
/// @param options           NULL: the defaults
/// @param out               the report; release it with fpt_weights_report_free
/// @return FPT_INVALID_ARGUMENT names the wish or constraint; also for a wish at a pole that coincides with its neighbour
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_weights_refine_curve(
    curve: *const fpt_curve,
    wish_poles: *const usize,
    wish_distances: *const f64,
    wish_count: usize,
    constraints: *const fpt_weights_constraint,
    constraint_count: usize,
    options: *const fpt_weights_options,
    out: *mut *mut fpt_weights_report,
) -> fpt_status {
    // SAFETY: the header asks for a live handle, arrays, options and room for a handle.
    guard(|| unsafe {
        let net = Net::Curve(curve::indexed(curve)?.curve());
        let wishes = wishes(wish_poles, wish_distances, wish_count)?;
        let constraints = self::constraints(constraints, constraint_count)?;
        let (options, callbacks) = fpt_weights_options::read(options)?;
        let out = place("out", out)?;
        hand_over(refine(net, &wishes, &constraints, &options, &mut || callbacks.poll(0, 1))?, out)
    })
}

/// As fpt_weights_refine_curve, for the weights of a surface; pole (i,j) is number i*pole_count_v + j. Tangent constraints are
/// FPT_UNSUPPORTED.
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_weights_refine_surface(
    surface: *const fpt_surface,
    wish_poles: *const usize,
    wish_distances: *const f64,
    wish_count: usize,
    constraints: *const fpt_weights_constraint,
    constraint_count: usize,
    options: *const fpt_weights_options,
    out: *mut *mut fpt_weights_report,
) -> fpt_status {
    // SAFETY: the header asks for a live handle, arrays, options and room for a handle.
    guard(|| unsafe {
        let net = Net::Surface(surface::form(surface)?.spline()?.surface());
        let wishes = wishes(wish_poles, wish_distances, wish_count)?;
        let constraints = self::constraints(constraints, constraint_count)?;
        let (options, callbacks) = fpt_weights_options::read(options)?;
        let out = place("out", out)?;
        hand_over(refine(net, &wishes, &constraints, &options, &mut || callbacks.poll(0, 1))?, out)
    })
}
