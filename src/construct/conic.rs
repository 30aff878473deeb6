//! Lines, circles, ellipses, parabolas, hyperbolas and their arcs.
//!
//! ```text
//!   form            poles of a quarter / half / full turn     degree
//!   Quadratic(..)   3 / 4, 5 / 7, 9, ...                       2      pieces of equal angle, or half turns of 4 poles
//!   Cubic           4 / 4 / -                                  3      one piece up to a third of a turn less than a full one
//!   Quintic         - / - / 6                                  5      a full turn in one piece
//! ```
//!
//! An arc of the angle 2h about the direction m is `(1, P0), (cos h, m), (1, P2)` in homogeneous coordinates, whatever h is; one degree
//! more makes its middle weights `(1 + 2 cos h) / 3`, positive up to h = 2 pi / 3.
//!
//! Reference: Piegl, Tiller, *The NURBS Book*, 2nd ed., sections 7.3 to 7.6; Chou, *Higher order Bézier circles*, Computer-Aided
//! Design 27, 1995.

use std::f64::consts::{PI, TAU};

use super::{check_interval, check_number, check_positive, check_vector, gap, invalid};
use crate::bounds::{Vector, add, cross, dot, norm, scaled, sub};
use crate::curve::Curve;
use crate::elementary::{Axes, CircleForm, quadrant_exact};
use crate::error::Error;
use crate::portable::SameDigits;
use crate::weights::conic::weight_of_rho;

/// How an arc of a circle or an ellipse is written as a spline. All run from 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ArcForm {
    /// Degree 2: equal arcs of 3 poles that share their ends, or half turns of 4 poles.
    Quadratic(CircleForm),
    /// Degree 3, four poles, for sweeps less than 4 pi / 3.
    Cubic,
    /// Degree 5, six poles, for full turns.
    Quintic,
}

/// Sweeps up to this have a cubic form whose weights are not too small to be of use.
const LARGEST_CUBIC: f64 = 4.0;

/// Poles (x, y, weight) of a unit arc, its knots and degree.
pub(super) struct Arc {
    pub poles: Vec<[f64; 3]>,
    pub knots: Vec<f64>,
    pub degree: usize,
}

impl ArcForm {
    /// Quadratic pieces of at most a quarter turn: what most systems write.
    pub fn usual(sweep: f64) -> Self {
        Self::Quadratic(CircleForm::quarters(sweep))
    }

    /// The unit arc from `start` to `end`.
    pub(super) fn unit(self, [start, end]: [f64; 2]) -> Result<Arc, Error> {
        check_interval("angles", [start, end])?;
        let sweep = end - start;
        if sweep > TAU * (1.0 + 4.0 * f64::EPSILON) {
            return invalid(format!("angles: {sweep} radians are more than a turn"));
        }
        match self {
            Self::Quadratic(form) => {
                let net = form.net(start, end)?;
                Ok(Arc { poles: net.poles, knots: net.knots, degree: 2 })
            }
            Self::Cubic => {
                if sweep > LARGEST_CUBIC {
                    return invalid(format!(
                        "form: the cubic cannot make a sweep of {sweep} radians"
                    ));
                }
                let [a, b] = [quadrant_exact(start), quadrant_exact(end)];
                let m = quadrant_exact(0.5 * (start + end));
                let w = (1.0 + 2.0 * quadrant_exact(0.5 * sweep)[0]) / 3.0;
                let inner = |e: [f64; 2]| [0, 1].map(|k| (e[k] + 2.0 * m[k]) / 3.0 / w);
                let pole = |p: [f64; 2], w: f64| [p[0], p[1], w];
                let poles = vec![pole(a, 1.0), pole(inner(a), w), pole(inner(b), w), pole(b, 1.0)];
                Ok(Arc { poles, knots: bezier_knots(3), degree: 3 })
            }
            Self::Quintic => {
                if (sweep - TAU).abs() > 8.0 * f64::EPSILON * TAU {
                    return invalid(format!(
                        "form: the quintic makes full turns, not {sweep} radians"
                    ));
                }
                let [c, s] = quadrant_exact(start);
                let turned = |[x, y]: [f64; 2], w: f64| [c * x - s * y, s * x + c * y, w];
                let places =
                    [[1.0, 0.0], [1.0, 4.0], [-3.0, 2.0], [-3.0, -2.0], [1.0, -4.0], [1.0, 0.0]];
                let weights = [1.0, 0.2, 0.2, 0.2, 0.2, 1.0];
                let poles = places.iter().zip(weights).map(|(p, w)| turned(*p, w)).collect();
                Ok(Arc { poles, knots: bezier_knots(5), degree: 5 })
            }
        }
    }
}

pub(super) fn bezier_knots(degree: usize) -> Vec<f64> {
    let ends = |u| std::iter::repeat_n(u, degree + 1);
    ends(0.0).chain(ends(1.0)).collect()
}

/// The segment from `a` to `b`, by its length from 0 on.
///
/// # Errors
/// Points that are not finite or the same.
pub fn line(a: Vector, b: Vector) -> Result<Curve, Error> {
    check_vector("start", a)?;
    check_vector("end", b)?;
    let length = gap(a, b);
    if length == 0.0 {
        return invalid("end: is the start".into());
    }
    Curve::new(&[0.0, 0.0, length, length], 1, &[a, b], None)
}

/// The place of `(x, y)` in the plane of x and y.
fn place(axes: &Axes, x: f64, y: f64) -> Vector {
    let flat: Vector = std::array::from_fn(|k| x * axes.x[k] + y * axes.y[k]);
    add(axes.origin, flat)
}

/// The arc of the ellipse `origin + a cos t X + b sin t Y` between two angles t (radians, the second greater, at most a turn).
///
/// # Errors
/// Numbers that are not allowed, by name; a form that cannot make the sweep.
pub fn ellipse(
    axes: &Axes,
    [a, b]: [f64; 2],
    angles: [f64; 2],
    form: ArcForm,
) -> Result<Curve, Error> {
    let axes = axes.checked()?;
    check_positive("radius_x", a)?;
    check_positive("radius_y", b)?;
    let arc = form.unit(angles)?;
    let poles: Vec<Vector> = arc.poles.iter().map(|p| place(&axes, a * p[0], b * p[1])).collect();
    let weights: Vec<f64> = arc.poles.iter().map(|p| p[2]).collect();
    Curve::new(&arc.knots, arc.degree, &poles, Some(&weights))
}

/// The arc of a circle between two angles from the x axis.
///
/// # Errors
/// As [`ellipse`].
pub fn arc(axes: &Axes, radius: f64, angles: [f64; 2], form: ArcForm) -> Result<Curve, Error> {
    check_positive("radius", radius)?;
    ellipse(axes, [radius; 2], angles, form)
}

/// A full circle from the x axis on.
///
/// # Errors
/// As [`ellipse`].
pub fn circle(axes: &Axes, radius: f64, form: ArcForm) -> Result<Curve, Error> {
    arc(axes, radius, [0.0, TAU], form)
}

/// The arc of the circle through three points, from the first over the second to the third, in quadratic pieces of at most a quarter turn.
///
/// # Errors
/// Points that are not finite, or on a line.
pub fn arc_through(points: [Vector; 3]) -> Result<Curve, Error> {
    points.iter().try_for_each(|p| check_vector("points", *p))?;
    let [a, b, c] = points;
    let (ab, ac) = (sub(b, a), sub(c, a));
    let axis = cross(ab, ac);
    let square = dot(axis, axis);
    if square.is_nan() || square <= 1e-24 * dot(ab, ab) * dot(ac, ac) {
        return invalid("points: they lie on a line".into());
    }
    // The centre from a: in the plane, equally far from all.
    let to_center: Vector = {
        let (p, q) = (scaled(cross(axis, ab), dot(ac, ac)), scaled(cross(ac, axis), dot(ab, ab)));
        add(p, q).map(|x| x / (2.0 * square))
    };
    let center = add(a, to_center);
    let radius = norm(to_center);
    let axes = Axes::around(center, axis, scaled(to_center, -1.0))?;
    let end = sub(ac, to_center);
    let mut sweep = dot(end, axes.y).arctangent_over(dot(end, axes.x));
    if sweep <= 0.0 {
        sweep += TAU;
    }
    let curve = arc(&axes, radius, [0.0, sweep], ArcForm::usual(sweep))?;
    // The given ends, without the rounding of angles.
    let mut poles = curve.poles().to_vec();
    let last = poles.len() - 1;
    (poles[0], poles[last]) = (a, c);
    Curve::new(curve.knots().values(), 2, &poles, curve.weights())
}

/// The conic of shape factor `rho` (0 to 1: ellipse below 1/2, parabola at 1/2, hyperbola above) over a triangle: from the
/// first pole to the third, along the sides at both.
///
/// # Errors
/// Points that are not finite; a factor that is not between 0 and 1.
pub fn conic_arc(poles: [Vector; 3], rho: f64) -> Result<Curve, Error> {
    let weight = weight_of_rho(rho)?;
    Curve::new(&bezier_knots(2), 2, &poles, Some(&[1.0, weight, 1.0]))
}

/// The arc of the parabola `origin + t^2 / (4 focal) X + t Y` between two t, which are its parameters.
///
/// # Errors
/// Numbers that are not allowed, by name.
pub fn parabola(axes: &Axes, focal: f64, [start, end]: [f64; 2]) -> Result<Curve, Error> {
    let axes = axes.checked()?;
    check_positive("focal", focal)?;
    check_interval("range", [start, end])?;
    let at = |s: f64, t: f64| place(&axes, s * t / (4.0 * focal), 0.5 * (s + t));
    let poles = [at(start, start), at(start, end), at(end, end)];
    Curve::new(&[start, start, start, end, end, end], 2, &poles, None)
}

/// The arc of the hyperbola `origin + a cosh t X + b sinh t Y` between two t; its parameter runs from 0 to 1.
///
/// # Errors
/// Numbers that are not allowed, by name; t so far apart or large that the weights or poles leave the doubles.
pub fn hyperbola(axes: &Axes, [a, b]: [f64; 2], [start, end]: [f64; 2]) -> Result<Curve, Error> {
    let axes = axes.checked()?;
    check_positive("radius_x", a)?;
    check_positive("radius_y", b)?;
    check_interval("range", [start, end])?;
    let weight = (0.5 * (end - start)).hyperbolic_cosine();
    let middle = 0.5 * (start + end);
    check_number("range", weight)?;
    let at = |t: f64, w: f64| {
        place(&axes, a * (t.hyperbolic_cosine() / w), b * (t.hyperbolic_sine() / w))
    };
    let poles = [at(start, 1.0), at(middle, weight), at(end, 1.0)];
    Curve::new(&bezier_knots(2), 2, &poles, Some(&[1.0, weight, 1.0]))
}

/// A half turn is where a single quadratic piece ends.
const _: () = assert!(LARGEST_CUBIC > PI && LARGEST_CUBIC < 4.0 * PI / 3.0);
