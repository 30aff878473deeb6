//! Weights changed one by one or as a whole; conics.

use super::curve::{self, fpt_curve};
use super::form::CurveForm;
use super::limits::check_degree;
use super::memory::{array, output, place, write};
use super::records::fpt_foot_point;
use super::sets::point;
use super::{Failure, fpt_status, guard};
use crate::closest::FootPoint;
use crate::curve::Curve;
use crate::index::IndexedCurve;
use crate::weights::conic::{conic, weight_of_rho, weights_of_eccentricity};
use crate::weights::edit::{move_point, through_point};
use crate::weights::form::{Unit, bounded, normalised, standard};
use crate::weights::positive::positive;
use std::sync::Arc;

/// What is 1 after fpt_weights_normalise.
#[repr(C)]
pub enum fpt_weights_unit {
    /// The first weight.
    FPT_UNIT_FIRST = 0,
    /// The greatest weight.
    FPT_UNIT_GREATEST = 1,
    /// The product of least and greatest weight.
    FPT_UNIT_MIDDLE = 2,
}

/// A conic over three poles: 24 bytes, frozen.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fpt_weights_conic_shape {
    /// The middle weight when both end weights are 1.
    pub weight: f64,
    /// The share of the way from the middle of the chord to the middle pole that the curve goes: weight / (1 + weight).
    pub rho: f64,
    /// 0 circle, less than 1 ellipse, 1 parabola, more hyperbola; near 0 good to about 1e-8.
    pub eccentricity: f64,
}

/// The weight of a pole that moves one point of the curve towards it; the other weights stay.
///
/// @param u           parameter of the point, in the domain; the pole's basis function must not be 0 or the only one there
/// @param pole        below the number of poles
/// @param distance    by how much, less than the distance from the pole; negative: away from it, less than to where the point is
///                    without the pole
/// @param out_weight  the new weight of the pole
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_weights_move_point(
    curve: *const fpt_curve,
    u: f64,
    pole: usize,
    distance: f64,
    out_weight: *mut f64,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for a number.
    guard(|| unsafe {
        let curve = curve::indexed(curve)?.curve();
        write("out_weight", move_point(curve, u, pole, distance)?, out_weight)
    })
}

/// The weight of a pole with which the curve passes through a point; the other weights stay. The line from the pole through the point
/// must cross the curve, and the point lie on it between the pole and the curve for weight 0; of several weights the one that
/// changes least is taken.
///
/// @param pole        below the number of poles
/// @param point       3 finite numbers
/// @param tolerance   length, finite, >= 0: how far the curve may pass. 0: 1e-7 x the diagonal of the poles' box
/// @param out_weight  the new weight of the pole
/// @param out_foot    the nearest point of the curve with that weight to the point, with its bound; NULL: not wanted
/// @return FPT_INVALID_ARGUMENT when no weight of that pole takes the curve there
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_weights_through_point(
    curve: *const fpt_curve,
    pole: usize,
    point: *const f64,
    tolerance: f64,
    out_weight: *mut f64,
    out_foot: *mut fpt_foot_point,
) -> fpt_status {
    // SAFETY: the header asks for a live handle, three numbers and room for what comes out; feet have one layout (records.rs).
    guard(|| unsafe {
        let curve = curve::indexed(curve)?.curve();
        let point = self::point("point", point)?;
        let out_weight = place("out_weight", out_weight)?;
        let edit = through_point(curve, pole, point, tolerance)?;
        if !out_foot.is_null() {
            *place("out_foot", out_foot.cast::<FootPoint>())? = edit.foot;
        }
        *out_weight = edit.weight;
        Ok(())
    })
}

/// The shape of the conic over three poles.
///
/// @param poles    9 finite numbers, x,y,z each; not in one line
/// @param weights  3 positive numbers
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_weights_conic(
    poles: *const f64,
    weights: *const f64,
    out: *mut fpt_weights_conic_shape,
) -> fpt_status {
    // SAFETY: the header asks for nine and three numbers and room for a record.
    guard(|| unsafe {
        let weights = array("weights", weights, 3)?;
        let found = conic(triangle(poles)?, [weights[0], weights[1], weights[2]])?;
        let (weight, rho, eccentricity) = (found.weight, found.rho, found.eccentricity);
        write("out", fpt_weights_conic_shape { weight, rho, eccentricity }, out)
    })
}

/// Three poles.
///
/// # Safety
/// NULL or nine numbers.
unsafe fn triangle(poles: *const f64) -> Result<[[f64; 3]; 3], Failure> {
    // SAFETY: the caller vouches for it.
    let poles = unsafe { array("poles", poles.cast::<[f64; 3]>(), 3) }?;
    Ok([poles[0], poles[1], poles[2]])
}

/// The middle weight of a conic with end weights 1 for a shape factor rho, between 0 and 1: rho / (1 - rho).
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_weights_of_rho(rho: f64, out_weight: *mut f64) -> fpt_status {
    // SAFETY: the header asks for room for a number.
    guard(|| unsafe { write("out_weight", weight_of_rho(rho)?, out_weight) })
}

/// The middle weights with which the conic over three poles, end weights 1, has an eccentricity.
///
/// @param poles         9 finite numbers, x,y,z each; not in one line
/// @param eccentricity  finite, >= 0
/// @param out_weights   room for 2 numbers, in rising order; what is not found is NaN
/// @param out_count     0, 1 or 2: how many there are. A circle needs legs of equal length
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_weights_of_eccentricity(
    poles: *const f64,
    eccentricity: f64,
    out_weights: *mut f64,
    out_count: *mut usize,
) -> fpt_status {
    // SAFETY: the header asks for nine numbers, room for two and for a count.
    guard(|| unsafe {
        let out_count = place("out_count", out_count)?;
        let out = output("out_weights", out_weights, 2)?;
        let found = weights_of_eccentricity(triangle(poles)?, eccentricity)?;
        let count = found.len().min(2);
        out.fill(f64::NAN);
        out[..count].copy_from_slice(&found[..count]);
        *out_count = count;
        Ok(())
    })
}

/// Weights divided by one number: the same shape.
///
/// @param weights      `count` numbers, 1e-100 to 1e100
/// @param count        at least 1
/// @param unit         a value of fpt_weights_unit
/// @param out_weights  room for `count` numbers; must not overlap `weights`
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_weights_normalise(
    weights: *const f64,
    count: usize,
    unit: u32,
    out_weights: *mut f64,
) -> fpt_status {
    // SAFETY: the header asks for both arrays.
    guard(|| unsafe {
        let weights = array("weights", weights, count)?;
        let unit = match unit {
            unit if unit == fpt_weights_unit::FPT_UNIT_FIRST as u32 => Unit::First,
            unit if unit == fpt_weights_unit::FPT_UNIT_GREATEST as u32 => Unit::Greatest,
            unit if unit == fpt_weights_unit::FPT_UNIT_MIDDLE as u32 => Unit::Middle,
            _ => return Err(Failure::invalid(format!("unit: {unit} is not an FPT_UNIT_ value"))),
        };
        output("out_weights", out_weights, count)?.copy_from_slice(&normalised(weights, unit)?);
        Ok(())
    })
}

/// Weights whose greatest is at most `ratio` times the least: those outside a range in the middle of the given ones move to its ends.
/// The shape changes. fpt_weights_standard_form may lessen the spread without that.
///
/// @param weights      `count` numbers, 1e-100 to 1e100
/// @param count        at least 1
/// @param ratio        at least 1
/// @param out_weights  room for `count` numbers; must not overlap `weights`
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_weights_bound(
    weights: *const f64,
    count: usize,
    ratio: f64,
    out_weights: *mut f64,
) -> fpt_status {
    // SAFETY: the header asks for both arrays.
    guard(|| unsafe {
        let weights = array("weights", weights, count)?;
        output("out_weights", out_weights, count)?.copy_from_slice(&bounded(weights, ratio)?);
        Ok(())
    })
}

/// A new handle.
///
/// # Safety
/// As [`place`].
unsafe fn made(curve: Curve, out: *mut *mut fpt_curve) -> Result<(), Failure> {
    let form = CurveForm::Spline(Arc::new(IndexedCurve::new(curve)));
    // SAFETY: the caller vouches for it.
    *unsafe { place("out", out) }? = fpt_curve::handle(form);
    Ok(())
}

/// The same curve with both end weights 1: a rational change of the parameter, same poles and domain, other weights and inner knots.
///
/// @param out  the curve; release it with fpt_curve_free
/// @return FPT_UNSUPPORTED for a curve whose ends are not clamped
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_weights_standard_form(
    curve: *const fpt_curve,
    out: *mut *mut fpt_curve,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for a handle.
    guard(|| unsafe { made(standard(curve::indexed(curve)?.curve())?, out) })
}

/// A curve with positive weights from homogeneous data whose weights may be zero or negative: the same curve, with more poles where
/// that is needed. It exists when the denominator does not vanish in the domain.
///
/// @param degree      1 to 31
/// @param pole_count  at least degree + 1
/// @param knots       pole_count + degree + 1 numbers, as fpt_curve_data.knots
/// @param poles       wx,wy,wz,w of pole i at 4*i: coordinates multiplied by the weight
/// @param out         the curve; release it with fpt_curve_free
/// @return FPT_UNSUPPORTED when the denominator vanishes (an end weight of 0 is such a case) or comes too near to 0 to tell; the text
///         has the parameter
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_weights_positive_form(
    degree: usize,
    pole_count: usize,
    knots: *const f64,
    poles: *const f64,
    out: *mut *mut fpt_curve,
) -> fpt_status {
    // SAFETY: the header asks for arrays of these lengths and room for a handle; the degree is small and the pole count no larger
    // than an address space holds, so the lengths do not overflow.
    guard(|| unsafe {
        check_degree("degree", degree, pole_count)?;
        let knots = array("knots", knots, pole_count + degree + 1)?;
        let poles = array("poles", poles.cast::<[f64; 4]>(), pole_count)?;
        made(positive(knots, degree, poles)?, out)
    })
}
