//! Curvatures of surfaces that are elementary ones: closed forms.
//!
//! ```text
//!   plane 0, 0     cylinder 1/r, 0     sphere 1/r, 1/r     cone cos a / rho, 0     torus 1/r, (rho - R) / (r rho)
//! ```
//!
//! with rho, the distance from the axis, a quotient of polynomials on each piece. A piece that is not singular bends by as much
//! more or less as its distance from the carrier allows: with f that distance, |f| <= e, Markov's inequality bounds
//! the derivatives of f, and the second forms differ by no more than
//!
//! ```text
//!   (|f''| + |f'| |S''| / sqrt(least metric)) / least metric
//! ```
//!
//! four times that, because f is known as a multiple of an implicit form, whose factor changes. Metric and weight are bounded on
//! parts of the piece, as many as are needed. Beside a collapsed edge that is no bound. What is said of the carrier is true of a
//! shape that no point has left by more than e; e must be rounding there, and is reported.

use super::cell::{Forms, Known, Piece, Shape};
use super::interval::Interval;
use super::polynomial::Polynomial;
use super::request::{Quantity, known, patch_piece};
use super::search::{FLOOR, Field, Start};
use super::slope::Slope;
use crate::analytic::{Carrier, Kind};
use crate::bounds::{HALF_ULP, Vector, dot, sub};
use crate::index::SurfaceIndex;

/// Greatest distance from the carrier that counts as rounding, for a box diagonal of 1 to 2.
const ROUNDING: f64 = 2e-13;

/// Coordinates across the axis and weight of a piece, and on which side of the surface its normal is.
struct Across {
    x: Polynomial,
    y: Polynomial,
    weight: Option<Polynomial>,
    sign: f64,
}

/// An elementary surface.
pub(super) struct Elementary<'a> {
    index: &'a SurfaceIndex,
    carrier: Carrier,
    quantity: Quantity,
    pieces: Vec<Option<Across>>,
    /// How much more or less the shape itself bends.
    slack: f64,
    work: Vec<f64>,
    /// How far the shape may be from one of which the closed forms hold; 0: they hold of itself.
    pub moved: f64,
}

impl<'a> Elementary<'a> {
    /// None when the surface is no elementary one, or not near enough to one for curvatures to be alike; loose: unless it is one up
    /// to rounding, which is then reported as `moved`.
    pub fn new(
        index: &'a SurfaceIndex,
        quantity: Quantity,
        starts: &[Start],
        relative: f64,
        is_loose: bool,
    ) -> Option<Self> {
        let carrier = index.analytic.as_ref()?.carrier;
        if matches!(carrier.kind, Kind::Line | Kind::Circle { .. }) {
            return None;
        }
        let (mut moved, mut slack) = (0.0f64, 0.0f64);
        let most = 0.2 * relative * FLOOR.max(least_value(carrier.kind, quantity));
        for &(k, ..) in starts {
            if is_loose || index.patches[k].has_collapsed() {
                moved = moved.max(carrier.deviation + index.patches[k].spread);
            } else {
                slack = slack.max(difference(index, k, &carrier, most)?);
            }
        }
        if moved > ROUNDING || slack.is_nan() || slack > most {
            return None;
        }
        let pieces = (0..index.patches.len()).map(|_| None).collect();
        Some(Self { index, carrier, quantity, pieces, slack, work: Vec::new(), moved })
    }
}

/// What a quantity nowhere falls below on a carrier, as far as that is plain.
fn least_value(kind: Kind, quantity: Quantity) -> f64 {
    match (quantity, kind) {
        (Quantity::Sharpest, Kind::Torus { minor, .. }) => 1.0 / minor,
        (Quantity::Sharpest, Kind::Cylinder { radius } | Kind::Sphere { radius }) => 1.0 / radius,
        _ => 0.0,
    }
}

/// Into how many parts a piece is cut, in either direction, until its least metric and its weights are known well enough.
const CUTS: [usize; 3] = [1, 2, 4];

/// How much the curvature of a piece that nowhere is farther than its deviation from a carrier differs from that of the carrier;
/// as sharp as it must be to be below `enough`, if it can.
fn difference(index: &SurfaceIndex, k: usize, carrier: &Carrier, enough: f64) -> Option<f64> {
    let piece = patch_piece(index, k);
    let (forms, count) = (Forms::new(&piece), piece.degree.count());
    let weights = if piece.rational { &piece.poles[3 * count..] } else { &[1.0] };
    let heavy = weights.iter().fold(0.0, |most: f64, w| most.max(*w));
    let degree = index.degree.s.max(index.degree.t) as f64;
    let mut least = None;
    for cuts in CUTS {
        let found = extremes(&forms, cuts).map(|(metric, weight)| {
            let piece = Bent { degree, order: order(carrier.kind), heavy: heavy / weight };
            4.0 * carrier.deviation * piece.difference(index.patches[k].radius, metric)
        });
        least = found.or(least);
        if least.is_some_and(|x| x <= enough) {
            break;
        }
    }
    least
}

/// Bounds below the least eigenvalue of the metric and below the weight; none when they are not positive.
fn extremes(forms: &Forms, cuts: usize) -> Option<(f64, f64)> {
    let mut work = Vec::new();
    let mut least = [f64::INFINITY; 2];
    let part = |i: usize| [i as f64 / cuts as f64, (i + 1) as f64 / cuts as f64];
    for i in 0..cuts * cuts {
        let (s, t) = (part(i / cuts), part(i % cuts));
        let mut at = |f: &Polynomial| f.on(s, t, &mut work).range;
        let (area, first, last) = (at(&forms.area), at(&forms.metric[0]), at(&forms.metric[2]));
        let weight = forms.weight.as_ref().map_or(Interval::point(1.0), &mut at);
        if area.low <= 0.0 || weight.low <= 0.0 {
            return None;
        }
        // W^6 D over W^4 (E + G).
        let metric = area.low / ((first.high + last.high) * weight.high * weight.high);
        least = [least[0].min(metric), least[1].min(weight.low)];
    }
    Some((least[0], least[1]))
}

/// How many coordinates are multiplied in the implicit form of a carrier.
fn order(kind: Kind) -> f64 {
    match kind {
        Kind::Torus { .. } => 4.0,
        Kind::Plane => 1.0,
        _ => 2.0,
    }
}

/// What the derivatives of a piece are bounded by.
struct Bent {
    degree: f64,
    order: f64,
    /// Greatest weight of a pole over the least value of the weight.
    heavy: f64,
}

impl Bent {
    /// `(|f''| + |f'| |S''| / sqrt(m)) / m` for `|f| <= 1`: f = N / D has a numerator of degree `n = q p` in either parameter and
    /// the denominator `W^q`.
    ///
    /// ```text
    ///   Markov      |N_s| <= 2 n^2 |N|      |N_ss| <= 4 n^2 (n^2 - 1) / 3 |N|      |N_st| <= (2 n^2)^2 |N|
    ///   poles       |W_s| <= p h W      |W_ss|, |W_st| <= 2 p^2 h W      |S_ss|, |S_st| <= 6 p^2 (h + h^2) radius
    /// ```
    fn difference(&self, radius: f64, metric: f64) -> f64 {
        let &Self { degree: p, order: q, heavy: h } = self;
        let n = q * p;
        let (once, twice) = (2.0 * n * n, 4.0 * n * n * (n * n - 1.0) / 3.0);
        let steep = h.powi(q as i32);
        // Derivatives of the denominator over it.
        let (slope, bend) = (q * p * h, 2.0 * q * p * p * h + q * (q - 1.0) * (p * h) * (p * h));
        let first = once * steep + slope;
        // Sum of a row of the matrix of second derivatives: above their norm.
        let second = steep * (twice + once * once) + 2.0 * (2.0 * first * slope + bend);
        let shape = 12.0 * p * p * (h + h * h) * radius;
        (second + std::f64::consts::SQRT_2 * first * shape / metric.sqrt()) / metric
    }
}

impl Across {
    fn new(index: &SurfaceIndex, carrier: &Carrier, k: usize) -> Self {
        let piece = patch_piece(index, k);
        let count = piece.degree.count();
        let centre = sub(index.patches[k].center, carrier.origin);
        let Piece { poles, degree, rational, error, .. } = piece;
        let weights = rational.then(|| &poles[3 * count..]);
        let heavy = weights.map_or(1.0, |w| w.iter().fold(0.0f64, |m, x| m.max(*x)));
        let rounding = 32.0 * HALF_ULP * (2.0 + carrier.size);
        let along = |axis: Vector| {
            let at = |i: usize| [poles[i], poles[count + i], poles[2 * count + i]];
            let weight = |i: usize| weights.map_or(1.0, |w| w[i]);
            let values: Vec<f64> =
                (0..count).map(|i| dot(at(i), axis) + weight(i) * dot(centre, axis)).collect();
            Polynomial::new(&values, degree, (2.0 * error + rounding) * heavy)
        };
        let weight = weights.map(|w| Polynomial::new(w, degree, piece.steps * heavy));
        let (x, y) = (along(carrier.axes[0]), along(carrier.axes[1]));
        Self { x, y, weight, sign: side(index, carrier, k) }
    }

    /// The distance from the axis.
    fn rho(&self, s: [f64; 2], t: [f64; 2], work: &mut Vec<f64>) -> Slope<2> {
        let mut at = |f: &Polynomial| f.on(s, t, work);
        let square = at(&self.x).squared() + at(&self.y).squared();
        match &self.weight {
            None => square.sqrt(),
            Some(weight) => square.sqrt() / at(weight),
        }
    }
}

/// 1 when the normal of a piece points to where its carrier bends, -1 otherwise.
fn side(index: &SurfaceIndex, carrier: &Carrier, k: usize) -> f64 {
    let patch = &index.patches[k];
    let forms = Forms::new(&patch_piece(index, k));
    // Away from the sides, which may be collapsed.
    let (place, mut work) = ([0.5; 2], Vec::new());
    let normal = forms.normal_on(place, place, &mut work).map(Interval::middle);
    let net = index.net(k);
    let count = index.degree.count();
    let piece = Polynomial::new(&net.poles[..count], index.degree, 0.0);
    let mut value = |c: usize| {
        let f = Polynomial::new(&net.poles[c * count..(c + 1) * count], piece.degree, 0.0);
        f.on(place, place, &mut work).middle.middle()
    };
    let weight = if index.rational { value(3) } else { 1.0 };
    let point = [0, 1, 2].map(|c| value(c) / weight + patch.center[c]);
    let local = carrier.local(point);
    let [x, y, _] = local;
    let axes = carrier.axes;
    let inward = match carrier.kind {
        Kind::Torus { major, .. } => {
            let rho = (x * x + y * y).sqrt();
            let to_ring = [major * x / rho - x, major * y / rho - y, -local[2]];
            let part = |c: usize| (0..3).map(|i| to_ring[i] * axes[i][c]).sum();
            [0, 1, 2].map(part)
        }
        Kind::Sphere { .. } => sub(carrier.origin, point),
        _ => [0, 1, 2].map(|c| -(x * axes[0][c] + y * axes[1][c])),
    };
    if dot(normal, inward) < 0.0 { -1.0 } else { 1.0 }
}

impl Field for Elementary<'_> {
    fn on(&mut self, (k, s, t): Start) -> Known {
        let carrier = &self.carrier;
        let piece = self.pieces[k].get_or_insert_with(|| Across::new(self.index, carrier, k));
        // A length is known as well as the points are.
        let loose = |x: f64| x.abs() * (8.0 * carrier.deviation * x.abs() + 1e-14) + self.slack;
        let constant = |x: f64| {
            let range = Interval::around(piece.sign * x, loose(x));
            Slope { middle: range, range, gradient: [Interval::point(0.0); 2] }
        };
        let slack = Interval::around(0.0, self.slack);
        let widened = |slope: Slope<2>| Slope {
            middle: slope.middle + slack,
            range: slope.range + slack,
            ..slope
        };
        let (a, d) = match carrier.kind {
            Kind::Cylinder { radius } => (constant(1.0 / radius), constant(0.0)),
            Kind::Sphere { radius } => (constant(1.0 / radius), constant(1.0 / radius)),
            Kind::Cone { cos, .. } => {
                let one = Interval::point(piece.sign * cos);
                let cos = Slope { middle: one, range: one, gradient: [Interval::point(0.0); 2] };
                (widened(cos / piece.rho(s, t, &mut self.work)), constant(0.0))
            }
            Kind::Torus { major, minor } => {
                let number = |x: f64| {
                    let x = Interval::around(x, x * 1e-15 + 2.0 * carrier.deviation);
                    Slope { middle: x, range: x, gradient: [Interval::point(0.0); 2] }
                };
                let rho = piece.rho(s, t, &mut self.work);
                let around = number(1.0) - number(major) / rho;
                let around = (around / number(minor)).times(piece.sign);
                (constant(1.0 / minor), widened(around))
            }
            _ => (constant(0.0), constant(0.0)),
        };
        let b = Slope { middle: slack, range: slack, gradient: [Interval::point(0.0); 2] };
        known(&Shape { a, b, d }, self.quantity)
    }

    fn across(&self, (k, s, t): Start) -> Option<usize> {
        super::request::collapsed_side(self.index, k, s, t)
    }
}
