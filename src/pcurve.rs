//! Curves in the parameter plane of a surface.
//!
//! ```text
//!   isoline    one parameter fixed, the other one runs          t is the running parameter, negated where it falls
//!   polyline   points (u, v) joined by lines                    t is given per point
//!   spline     a B-spline or NURBS curve with poles (u, v, 0)   t is its own parameter
//!   arc        M + cos t A + sin t B                            t is an angle; A and B are conjugate half diameters
//! ```
//!
//! Two maps are exact on each kind and keep the kind: affine maps of the plane (an isoline under a map that turns it becomes a
//! polyline of two points), and reversal. The reversed curve is `t -> C(-t)` on the negated domain, so that reversing twice gives
//! the same bits.

use std::f64::consts::PI;

use crate::curve::{Curve, box_of};
use crate::elementary::quadrant_exact;
use crate::error::Error;
use crate::knots::{Knots, MAX_MAGNITUDE};
use crate::portable::SameDigits;
use crate::transform::between;

pub use crate::operate::Direction;

/// A place in the parameter plane.
pub type Parameters = [f64; 2];

impl Direction {
    /// The other one.
    pub fn other(self) -> Self {
        match self {
            Self::U => Self::V,
            Self::V => Self::U,
        }
    }
}

/// A line on which one parameter is fixed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Isoline {
    /// Which parameter is fixed.
    pub fixed: Direction,
    /// Its value.
    pub at: f64,
    /// Where the other one begins.
    pub from: f64,
    /// Where the other one ends.
    pub to: f64,
}

/// Points joined by lines.
#[derive(Clone, Debug, PartialEq)]
pub struct Polyline {
    parameters: Box<[f64]>,
    points: Box<[Parameters]>,
}

/// An arc of an ellipse, `center + cos t first + sin t second` for t from `angles[0]` to `angles[1]`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EllipseArc {
    /// The centre.
    pub center: Parameters,
    /// The half diameter of t = 0.
    pub first: Parameters,
    /// The half diameter of a quarter turn; conjugate to the first.
    pub second: Parameters,
    /// First and last t, in radians.
    pub angles: [f64; 2],
}

/// A curve in the parameter plane. Immutable.
#[derive(Clone, Debug, PartialEq)]
pub enum Pcurve {
    /// One parameter is fixed.
    Isoline(Isoline),
    /// Points joined by lines.
    Polyline(Polyline),
    /// A spline with z = 0.
    Spline(Curve),
    /// An arc of a circle or an ellipse.
    Arc(EllipseArc),
}

/// The map `x -> matrix x + offset` of the parameter plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Affine {
    /// Rows of the matrix.
    pub matrix: [[f64; 2]; 2],
    /// What is added.
    pub offset: Parameters,
}

impl Affine {
    /// The image of a place.
    pub fn point(&self, p: Parameters) -> Parameters {
        let moved = self.vector(p);
        [moved[0] + self.offset[0], moved[1] + self.offset[1]]
    }

    /// The image of a difference of two places.
    pub fn vector(&self, d: Parameters) -> Parameters {
        // A zero times a number leaves no trace: axis-parallel maps are exact in what they keep.
        self.matrix.map(|row| match row {
            [a, 0.0] => a * d[0],
            [0.0, b] => b * d[1],
            [a, b] => a * d[0] + b * d[1],
        })
    }
}

impl Polyline {
    /// The points.
    pub fn points(&self) -> &[Parameters] {
        &self.points
    }

    /// The parameter of each point, increasing.
    pub fn parameters(&self) -> &[f64] {
        &self.parameters
    }

    fn piece(&self, t: f64) -> usize {
        let last = self.points.len() - 2;
        self.parameters.partition_point(|&x| x <= t).saturating_sub(1).min(last)
    }

    fn evaluate(&self, t: f64) -> Parameters {
        let k = self.piece(t);
        let ([a, b], [p, q]) =
            ([self.parameters[k], self.parameters[k + 1]], [self.points[k], self.points[k + 1]]);
        if t >= b {
            return q;
        }
        let share = ((t - a) / (b - a)).max(0.0);
        [0, 1].map(|k| p[k] + share * (q[k] - p[k]))
    }
}

impl Pcurve {
    /// The isoline with `fixed` at `at`, the other parameter running from `from` to `to`.
    ///
    /// # Errors
    /// Numbers that are not finite; ends that are equal.
    pub fn isoline(fixed: Direction, at: f64, from: f64, to: f64) -> Result<Self, Error> {
        for (name, x) in [("at", at), ("from", from), ("to", to)] {
            check_number(name, x)?;
        }
        if from == to {
            return invalid(format!("to: equals from, {from}"));
        }
        Ok(Self::Isoline(Isoline { fixed, at, from, to }))
    }

    /// The polyline through points, with the parameters 0, 1, 2, ...
    ///
    /// # Errors
    /// Fewer than two points; numbers that are not finite, by index.
    pub fn polyline(points: &[Parameters]) -> Result<Self, Error> {
        let parameters: Vec<f64> = (0..points.len()).map(|k| k as f64).collect();
        Self::polyline_at(&parameters, points)
    }

    /// The polyline through points at given, increasing parameters.
    ///
    /// # Errors
    /// Fewer than two points; another number of parameters; numbers that are not finite or not increasing, by index.
    pub fn polyline_at(parameters: &[f64], points: &[Parameters]) -> Result<Self, Error> {
        if points.len() < 2 {
            return invalid(format!("points: {} given, at least 2 needed", points.len()));
        }
        if parameters.len() != points.len() {
            let (found, expected) = (parameters.len(), points.len());
            return invalid(format!("parameters: {found} given, {expected} expected"));
        }
        for (k, point) in points.iter().enumerate() {
            check_place("points", k, *point)?;
        }
        for (k, t) in parameters.iter().enumerate() {
            check_number(&format!("parameters: entry {k}"), *t)?;
            if k > 0 && parameters[k - 1] >= *t {
                return invalid(format!("parameters: entry {k} is not more than entry {}", k - 1));
            }
        }
        Ok(Self::Polyline(Polyline { parameters: parameters.into(), points: points.into() }))
    }

    /// A spline whose poles are (u, v, 0).
    ///
    /// # Errors
    /// A pole with z that is not 0, by index.
    pub fn spline(curve: Curve) -> Result<Self, Error> {
        match curve.poles().iter().position(|pole| pole[2] != 0.0) {
            Some(k) => invalid(format!("poles: pole {k} has z = {}, not 0", curve.poles()[k][2])),
            None => Ok(Self::Spline(curve)),
        }
    }

    /// The arc `center + cos t first + sin t second`, t from `angles[0]` to `angles[1]`; at most a full turn.
    ///
    /// # Errors
    /// Numbers that are not finite; angles that do not increase or span more than a turn; both half diameters 0.
    pub fn arc(
        center: Parameters,
        first: Parameters,
        second: Parameters,
        angles: [f64; 2],
    ) -> Result<Self, Error> {
        for (name, place) in [("center", center), ("first", first), ("second", second)] {
            check_place(name, 0, place)?;
        }
        check_number("angles: entry 0", angles[0])?;
        check_number("angles: entry 1", angles[1])?;
        if angles[0] >= angles[1] {
            return invalid("angles: entry 0 is not less than entry 1".into());
        }
        if angles[1] - angles[0] > 2.0 * PI * (1.0 + 1e-12) {
            return invalid("angles: more than a full turn".into());
        }
        if first == [0.0; 2] && second == [0.0; 2] {
            return invalid("first: both half diameters are 0".into());
        }
        Ok(Self::Arc(EllipseArc { center, first, second, angles }))
    }

    /// First and last parameter.
    pub fn domain(&self) -> (f64, f64) {
        match self {
            Self::Isoline(line) if line.from < line.to => (line.from, line.to),
            Self::Isoline(line) => (-line.from, -line.to),
            Self::Polyline(line) => (line.parameters[0], line.parameters[line.points.len() - 1]),
            Self::Spline(curve) => curve.domain(),
            Self::Arc(arc) => (arc.angles[0], arc.angles[1]),
        }
    }

    /// The parameter at a share, 0 to 1, of the way through the domain; the ends are exact.
    pub fn parameter_at(&self, share: f64) -> f64 {
        let (a, b) = self.domain();
        between(a, b, share)
    }

    /// The place at `t`; parameters outside the domain are moved to its ends.
    pub fn evaluate(&self, t: f64) -> Parameters {
        let (a, b) = self.domain();
        let t = t.max(a).min(b);
        match self {
            Self::Isoline(line) => {
                let along = if line.from < line.to { t } else { -t };
                match line.fixed {
                    Direction::U => [line.at, along],
                    Direction::V => [along, line.at],
                }
            }
            Self::Polyline(line) => line.evaluate(t),
            Self::Spline(curve) => {
                let [u, v, _] = curve.evaluate(t);
                [u, v]
            }
            Self::Arc(arc) => {
                let [c, s] = quadrant_exact(t);
                [0, 1].map(|k| arc.center[k] + c * arc.first[k] + s * arc.second[k])
            }
        }
    }

    /// Place and derivatives of order 0 to `count` (at most 31) at `t`, right-sided where they jump, into `out[0..=count]`.
    pub fn derivatives(&self, t: f64, count: usize, out: &mut [Parameters]) {
        let (a, b) = self.domain();
        let t = t.max(a).min(b);
        out[..=count].fill([0.0; 2]);
        out[0] = self.evaluate(t);
        match self {
            Self::Isoline(line) if count > 0 => {
                let slope = if line.from < line.to { 1.0 } else { -1.0 };
                out[1][line.fixed.other().index()] = slope;
            }
            Self::Polyline(line) if count > 0 => {
                let k = line.piece(t);
                let length = line.parameters[k + 1] - line.parameters[k];
                out[1] =
                    [0, 1].map(|axis| (line.points[k + 1][axis] - line.points[k][axis]) / length);
            }
            Self::Spline(curve) => {
                let mut rows = [[0.0; 3]; crate::knots::MAX_DEGREE + 1];
                curve.derivatives(t, count, &mut rows);
                for k in 1..=count {
                    out[k] = [rows[k][0], rows[k][1]];
                }
            }
            Self::Arc(arc) => {
                let [c, s] = quadrant_exact(t);
                for k in 1..=count {
                    let (c, s) = match k % 4 {
                        0 => (c, s),
                        1 => (-s, c),
                        2 => (-c, -s),
                        _ => (s, -c),
                    };
                    out[k] = [0, 1].map(|axis| c * arc.first[axis] + s * arc.second[axis]);
                }
            }
            _ => {}
        }
    }

    /// Where the curve begins.
    pub fn start(&self) -> Parameters {
        self.evaluate(self.domain().0)
    }

    /// Where the curve ends.
    pub fn end(&self) -> Parameters {
        self.evaluate(self.domain().1)
    }

    /// A box u0, u1, v0, v1 that holds the curve, up to rounding; the least one but for splines.
    pub fn bounds(&self) -> [f64; 4] {
        let of = |points: &[Parameters]| {
            let spatial: Vec<[f64; 3]> = points.iter().map(|p| [p[0], p[1], 0.0]).collect();
            let (low, high) = box_of(&spatial);
            [low[0], high[0], low[1], high[1]]
        };
        match self {
            Self::Isoline(_) => of(&[self.start(), self.end()]),
            Self::Polyline(line) => of(&line.points),
            Self::Spline(curve) => {
                let (low, high) = curve.bounding_box();
                [low[0], high[0], low[1], high[1]]
            }
            Self::Arc(arc) => {
                let mut points = vec![self.start(), self.end()];
                for axis in 0..2 {
                    let top = arc.second[axis].arctangent_over(arc.first[axis]);
                    let first = ((arc.angles[0] - top) / PI).floor() as i64;
                    for k in first..first + 4 {
                        let t = top + k as f64 * PI;
                        if arc.angles[0] < t && t < arc.angles[1] {
                            points.push(self.evaluate(t));
                        }
                    }
                }
                of(&points)
            }
        }
    }

    /// The parameters at which the curve may have a corner, in order; the ends are not among them.
    pub fn breaks(&self) -> Vec<f64> {
        match self {
            Self::Isoline(_) | Self::Arc(_) => Vec::new(),
            Self::Polyline(line) => line.parameters[1..line.points.len() - 1].into(),
            Self::Spline(curve) => {
                let (a, b) = curve.domain();
                let knots = curve.knots();
                let mut found: Vec<f64> = knots.values().to_vec();
                found.retain(|&t| a < t && t < b && knots.multiplicity(t) >= curve.degree());
                found.dedup();
                found
            }
        }
    }

    /// The part between two parameters of the domain.
    ///
    /// # Errors
    /// Parameters that are not in the domain or do not increase; memory that could not be had.
    pub fn part(&self, from: f64, to: f64) -> Result<Self, Error> {
        let (a, b) = self.domain();
        if !(a <= from && from < to && to <= b) {
            return invalid(format!("from: {from} to {to} is no interval of [{a}, {b}]"));
        }
        match self {
            Self::Isoline(line) => {
                let sign = if line.from < line.to { 1.0 } else { -1.0 };
                Self::isoline(line.fixed, line.at, sign * from, sign * to)
            }
            Self::Polyline(line) => {
                let inside = |k: &usize| from < line.parameters[*k] && line.parameters[*k] < to;
                let kept: Vec<usize> = (0..line.points.len()).filter(inside).collect();
                let middle = kept.iter().map(|&k| line.points[k]);
                let points: Vec<Parameters> = std::iter::once(line.evaluate(from))
                    .chain(middle)
                    .chain([line.evaluate(to)])
                    .collect();
                let middle = kept.iter().map(|&k| line.parameters[k]);
                let parameters: Vec<f64> =
                    std::iter::once(from).chain(middle).chain([to]).collect();
                Self::polyline_at(&parameters, &points)
            }
            Self::Spline(curve) => {
                let mut part = curve.clone();
                if to < b {
                    part = part.split(to)?.0;
                }
                if from > a {
                    part = part.split(from)?.1;
                }
                Ok(Self::Spline(part))
            }
            Self::Arc(arc) => Self::arc(arc.center, arc.first, arc.second, [from, to]),
        }
    }

    /// The same places in the opposite order: `t -> C(-t)` on the negated domain. Exact; twice gives the same bits.
    pub fn reversed(&self) -> Self {
        match self {
            Self::Isoline(line) => Self::Isoline(Isoline { from: line.to, to: line.from, ..*line }),
            Self::Polyline(line) => Self::Polyline(Polyline {
                parameters: line.parameters.iter().rev().map(|t| -t).collect(),
                points: line.points.iter().rev().copied().collect(),
            }),
            Self::Spline(curve) => Self::Spline(reversed_curve(curve)),
            Self::Arc(arc) => Self::Arc(EllipseArc {
                second: arc.second.map(|x| -x),
                angles: [-arc.angles[1], -arc.angles[0]],
                ..*arc
            }),
        }
    }

    /// The image under an affine map, of the same kind and with the same share of the domain at each place; an isoline that the map
    /// turns becomes a polyline of two points. Exact but for the rounding of the products.
    ///
    /// # Errors
    /// An image that is not finite, beyond 1e100, or a single place where it was none.
    pub fn mapped(&self, map: &Affine) -> Result<Self, Error> {
        self.mapped_by(&|p| map.point(p), &|d| map.vector(d))
    }

    /// As [`Self::mapped`], with the map given by what it does to places and to their differences.
    pub(crate) fn mapped_by(
        &self,
        point: &dyn Fn(Parameters) -> Parameters,
        vector: &dyn Fn(Parameters) -> Parameters,
    ) -> Result<Self, Error> {
        match self {
            Self::Isoline(line) => {
                let (a, b) = (point(self.start()), point(self.end()));
                // The image of a unit step along the line has one coordinate 0 when the line is not turned.
                let mut step = [0.0; 2];
                step[line.fixed.other().index()] = 1.0;
                match vector(step) {
                    [0.0, _] => Self::isoline(Direction::U, a[0], a[1], b[1]),
                    [_, 0.0] => Self::isoline(Direction::V, a[1], a[0], b[0]),
                    _ => Self::polyline(&[a, b]),
                }
            }
            Self::Polyline(line) => {
                let points: Vec<Parameters> = line.points.iter().map(|p| point(*p)).collect();
                Self::polyline_at(&line.parameters, &points)
            }
            Self::Spline(curve) => {
                let image = |p: &[f64; 3]| {
                    let [u, v] = point([p[0], p[1]]);
                    [u, v, 0.0]
                };
                let poles: Vec<[f64; 3]> = curve.poles().iter().map(image).collect();
                let knots = curve.knots().values();
                Self::spline(Curve::new(knots, curve.degree(), &poles, curve.weights())?)
            }
            Self::Arc(arc) => {
                Self::arc(point(arc.center), vector(arc.first), vector(arc.second), arc.angles)
            }
        }
    }
}

/// `t -> C(-t)`.
pub(crate) fn reversed_curve(curve: &Curve) -> Curve {
    let values: Vec<f64> = curve.knots().values().iter().rev().map(|t| -t).collect();
    let knots = Knots::new(&values, curve.degree(), curve.poles().len());
    let poles = curve.poles().iter().rev().copied().collect();
    let weights = curve.weights().map(|weights| weights.iter().rev().copied().collect());
    // The rules for knots are symmetric; memory for a few doubles is the only thing that may be missing.
    Curve::from_parts(knots.expect("the mirror image of a knot vector"), poles, weights)
}

fn check_number(name: &str, x: f64) -> Result<(), Error> {
    if !x.is_finite() || x.abs() > MAX_MAGNITUDE {
        return invalid(format!("{name}: is not finite or beyond 1e100"));
    }
    Ok(())
}

fn check_place(name: &str, index: usize, place: Parameters) -> Result<(), Error> {
    if place.iter().any(|x| !x.is_finite() || x.abs() > MAX_MAGNITUDE) {
        return invalid(format!("{name}: entry {index} is not finite or beyond 1e100"));
    }
    Ok(())
}

fn invalid<T>(text: String) -> Result<T, Error> {
    Err(Error::InvalidArgument(text))
}

#[cfg(test)]
mod tests;
