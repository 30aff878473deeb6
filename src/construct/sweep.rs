//! Surfaces of one moving curve, exact: ruled, extruded, revolved, translational.
//!
//! ```text
//!   ruled          lines between points of two curves at equal parameters
//!   extruded       C(u) + v D
//!   revolved       C(v) turned by an angle about an axis
//!   translational  C(u) + T(v) - T(v0): weights are products, poles sums
//! ```

use super::{check_interval, check_vector, invalid};
use crate::bounds::{Vector, add, norm, scaled, sub};
use crate::curve::Curve;
use crate::curve::insertion::spare;
use crate::elementary::{CircleForm, Elementary, ElementarySurface};
use crate::error::Error;
use crate::operate::compatible_curves;
use crate::surface::Surface;

/// The surface of the lines between points of equal parameters (after an affine change to the domain of the first): u along the curves,
/// v from 0 on the first to 1 on the second.
///
/// # Errors
/// Memory that could not be had.
pub fn ruled(first: &Curve, second: &Curve) -> Result<Surface, Error> {
    spare(first.poles().len() + second.poles().len(), 64)?;
    let pair = compatible_curves(&[first.clone(), second.clone()])?;
    across(&pair, &[0.0, 0.0, 1.0, 1.0], 1)
}

/// The surface whose columns of poles are those of compatible curves.
pub(super) fn across(curves: &[Curve], knots_v: &[f64], degree_v: usize) -> Result<Surface, Error> {
    let (count, knots) = (curves[0].poles().len(), curves[0].knots());
    // Lists that grow by doubling.
    spare(count * curves.len(), 3 * (size_of::<Vector>() + size_of::<f64>()))?;
    let net = |i: usize| curves.iter().map(move |curve| curve.poles()[i]);
    let poles: Vec<Vector> = (0..count).flat_map(net).collect();
    let rational = curves.iter().any(|curve| curve.weights().is_some());
    let weight = |i: usize| curves.iter().map(move |c| c.weights().map_or(1.0, |w| w[i]));
    let weights: Vec<f64> = (0..count).flat_map(weight).collect();
    Surface::new(
        knots.values(),
        knots_v,
        knots.degree(),
        degree_v,
        &poles,
        count,
        curves.len(),
        rational.then_some(&weights[..]),
    )
}

/// The surface `C(u) + v D`, v from 0 to 1.
///
/// # Errors
/// A direction that is not finite or 0.
pub fn extruded(curve: &Curve, direction: Vector) -> Result<Surface, Error> {
    check_vector("direction", direction)?;
    if norm(direction) == 0.0 {
        return invalid("direction: is 0".into());
    }
    spare(curve.poles().len(), 160)?;
    let moved: Vec<Vector> = curve.poles().iter().map(|p| add(*p, direction)).collect();
    let end = Curve::new(curve.knots().values(), curve.degree(), &moved, curve.weights())?;
    across(&[curve.clone(), end], &[0.0, 0.0, 1.0, 1.0], 1)
}

/// The curve turned about an axis between two angles (radians, right-handed, at most a turn): u the angle in a circle form, from 0 to 1
/// (quarters when none is given), v the curve's parameter.
///
/// # Errors
/// Numbers that are not allowed, by name; a form that cannot make the sweep.
pub fn revolved(
    curve: &Curve,
    origin: Vector,
    axis: Vector,
    angles: [f64; 2],
    form: Option<CircleForm>,
) -> Result<Surface, Error> {
    check_vector("origin", origin)?;
    check_vector("axis", axis)?;
    check_interval("angles", angles)?;
    let length = norm(axis);
    if length == 0.0 {
        return invalid("axis: is 0".into());
    }
    let axis = scaled(axis, 1.0 / length);
    let (v0, v1) = curve.domain();
    let kind = Elementary::Revolution { origin, axis, meridian: curve.clone() };
    let surface = ElementarySurface::new(kind, [angles[0], angles[1], v0, v1])?;
    let [usual, other] = surface.usual_forms();
    surface.nurbs([form.unwrap_or(usual), other])
}

/// The curve carried along the spine without turning: `C(u) + T(v) - T(v0)`.
///
/// # Errors
/// Memory that could not be had.
pub fn translational(curve: &Curve, spine: &Curve) -> Result<Surface, Error> {
    let start = spine.evaluate(spine.domain().0);
    let (mut poles, mut weights) = (Vec::new(), Vec::new());
    let weight = |curve: &Curve, i: usize| curve.weights().map_or(1.0, |w| w[i]);
    for (i, p) in curve.poles().iter().enumerate() {
        for (j, q) in spine.poles().iter().enumerate() {
            poles.push(add(*p, sub(*q, start)));
            weights.push(weight(curve, i) * weight(spine, j));
        }
    }
    let rational = curve.is_rational() || spine.is_rational();
    Surface::new(
        curve.knots().values(),
        spine.knots().values(),
        curve.degree(),
        spine.degree(),
        &poles,
        curve.poles().len(),
        spine.poles().len(),
        rational.then_some(&weights[..]),
    )
}
