//! How far the image of a pcurve is from a curve in space, with proof.
//!
//! ```text
//!   S(p(t)) - C(t) = (N w - A W) / (W w)      Bernstein polynomials on every piece: cancellation happens in coefficients
//!   greatest of |coefficient| / weight >= |S(p(t)) - C(t)|      the convex hull property
//!   halved where that says too little, until it agrees with the value at an end
//! ```
//!
//! The same for two images, `S(p(t)) - R(q(t))`, of curves in the domains of two surfaces. In all of them both have the same parameter:
//! what is measured is the distance at equal parameters, which is at least the distance between the two as point sets.

use super::compose::{Arc, Composer, Piece, arc, lowered, product, raised};
use crate::bezier::{Bidegree, halve_t};
use crate::bounds::{HALF_ULP, Vector, norm, sub};
use crate::curve::Curve;
use crate::error::Error;

/// A bound is sharp enough when it exceeds a value that is taken by less than this share.
const SHARP: f64 = 1e-3;

/// Most halvings of one request.
const MOST_HALVINGS: usize = 4_000;

/// Cuts of cuts: pieces of two images begin at knot lines, which are known to a few ulps.
const MOST_CUTS: usize = 4;

/// The greatest distance at equal parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Deviation {
    /// Proven: nowhere more than this, rounding included.
    pub bound: f64,
    /// The greatest distance found, at the parameter `at`, up to rounding.
    pub reached: f64,
    /// Where.
    pub at: f64,
}

impl Deviation {
    /// Of nothing.
    pub fn none() -> Self {
        Self { bound: 0.0, reached: 0.0, at: f64::NAN }
    }

    /// The greater of two.
    pub fn max(self, other: Self) -> Self {
        let bound = self.bound.max(other.bound);
        if other.reached > self.reached || self.at.is_nan() {
            Self { bound, ..other }
        } else {
            Self { bound, ..self }
        }
    }
}

/// The difference of two curves on an interval.
struct Gap {
    range: [f64; 2],
    /// x, y, z, weight.
    coefficients: [Vec<f64>; 4],
    error: f64,
    /// The greatest of coefficient over weight.
    most: f64,
    bound: f64,
}

impl Gap {
    fn new(range: [f64; 2], coefficients: [Vec<f64>; 4], error: f64) -> Self {
        let [x, y, z, w] = &coefficients;
        let share = |k: usize| norm([x[k], y[k], z[k]]) / w[k];
        // A quotient that is no number bounds nothing.
        let worse = |most: f64, x: f64| if x.is_nan() { f64::INFINITY } else { most.max(x) };
        let most = (0..w.len()).map(share).fold(0.0, worse);
        let bound = most * (1.0 + 1e-12) + error;
        let bound = if bound.is_nan() { f64::INFINITY } else { bound };
        Self { range, coefficients, error, most, bound }
    }

    fn between(piece: &Piece, curve: &Arc) -> Self {
        let column = |n: &[Vector], c: usize| raised(n.iter().map(|n| n[c]).collect());
        let image = [0, 1, 2].map(|c| column(&piece.numerator, c));
        let target = [0, 1, 2].map(|c| column(&curve.numerator, c));
        let weights = [raised(piece.weights.clone()), raised(curve.weights.clone())];
        let difference = [0, 1, 2].map(|c| {
            let (mut ours, theirs) =
                (product(&image[c], &weights[1]), product(&target[c], &weights[0]));
            ours.iter_mut().zip(theirs).for_each(|(a, b)| *a -= b);
            lowered(ours)
        });
        let [x, y, z] = difference;
        let w = lowered(product(&weights[0], &weights[1]));
        // Extraction of the curve 14 c + 16, two products and their binomials, the halvings that follow.
        let (c, n) = (curve.weights.len() - 1, w.len() - 1);
        let steps = (22 * c + 4 * n + 64) as f64 * HALF_ULP;
        let error = piece.error + 2.0 * steps * (piece.radius + curve.radius);
        Self::new(piece.range, [x, y, z, w], error)
    }

    /// Of two images over the same interval.
    fn apart(first: &Piece, second: &Piece) -> Self {
        let shift = sub(second.center, first.center);
        let numerator = second.numerator.iter().zip(&second.weights);
        let moved = numerator.map(|(n, w)| [0, 1, 2].map(|c| n[c] + w * shift[c]));
        let (distance, size) = (norm(shift), norm(first.center).max(norm(second.center)));
        let arc = Arc {
            numerator: moved.collect(),
            weights: second.weights.clone(),
            radius: second.radius + distance,
        };
        let mut gap = Self::between(first, &arc);
        let rounding = 4.0 * HALF_ULP * (size + second.radius + distance);
        gap.error += second.error + rounding;
        gap.bound += second.error + rounding;
        gap
    }

    /// The distance at an end.
    fn value(&self, last: bool) -> f64 {
        let [x, y, z, w] = &self.coefficients;
        let k = if last { w.len() - 1 } else { 0 };
        norm([x[k], y[k], z[k]]) / w[k]
    }

    fn halved(self) -> [Self; 2] {
        let degree = Bidegree { s: 0, t: self.coefficients[0].len() - 1 };
        let middle = self.range[0] + 0.5 * (self.range[1] - self.range[0]);
        // Each level of the halving rounds once, numerator and weight.
        let error = self.error + (2 * degree.t + 2) as f64 * HALF_ULP * self.most;
        let mut low = self.coefficients;
        let mut high = low.clone();
        low.iter_mut().zip(&mut high).for_each(|(low, high)| halve_t(low, high, degree));
        [
            Self::new([self.range[0], middle], low, error),
            Self::new([middle, self.range[1]], high, error),
        ]
    }
}

/// The greatest distance between `S(p(t))` and `C(t)` on `range`, which lies in both domains. Bounds below `enough` are
/// not made sharper. Cost: some microseconds a piece.
///
/// # Errors
/// As [`Composer::compose`].
pub fn deviation(
    composer: &mut Composer,
    pcurve: &Curve,
    curve: &Curve,
    range: [f64; 2],
    enough: f64,
) -> Result<Deviation, Error> {
    let mut gaps = Vec::new();
    for span in curve.knots().spans() {
        let ends = [curve.knots().values()[span], curve.knots().values()[span + 1]];
        let part = [ends[0].max(range[0]), ends[1].min(range[1])];
        if part[0] >= part[1] {
            continue;
        }
        for piece in composer.compose(pcurve, part)? {
            let arc = arc(curve, span, piece.range, piece.center);
            gaps.push(Gap::between(&piece, &arc));
        }
    }
    Ok(sharpened(gaps, enough))
}

/// The greatest distance between `S(p(t))` and `R(q(t))` on `range`, as [`deviation`].
///
/// # Errors
/// As [`Composer::compose`]; [`Error::Unsupported`] where the pieces of both do not come to begin at common places.
pub fn between_images(
    first: (&mut Composer, &Curve),
    second: (&mut Composer, &Curve),
    range: [f64; 2],
    enough: f64,
) -> Result<Deviation, Error> {
    let ((ours, p), (theirs, q)) = (first, second);
    let mut gaps = Vec::new();
    let mut waiting = vec![(range, 0)];
    while let Some((range, cuts)) = waiting.pop() {
        let (a, b) = (ours.compose(p, range)?, theirs.compose(q, range)?);
        if let ([a], [b]) = (&a[..], &b[..]) {
            gaps.push(Gap::apart(a, b));
            continue;
        }
        if cuts == MOST_CUTS {
            let text = format!("pcurve: knot lines of both surfaces are crossed at {:?}", range[0]);
            return Err(Error::Unsupported(text));
        }
        let mut places: Vec<f64> = a.iter().chain(&b).flat_map(|piece| piece.range).collect();
        places.sort_by(f64::total_cmp);
        places.dedup();
        waiting.extend(places.windows(2).map(|pair| ([pair[0], pair[1]], cuts + 1)));
    }
    Ok(sharpened(gaps, enough))
}

/// Halves the gap with the greatest bound until that is sharp.
fn sharpened(mut gaps: Vec<Gap>, enough: f64) -> Deviation {
    let mut found = Deviation::none();
    let take = |gap: &Gap, found: &mut Deviation| {
        for last in [false, true] {
            let value = gap.value(last);
            if value > found.reached || found.at.is_nan() {
                *found = Deviation { reached: value, at: gap.range[usize::from(last)], ..*found };
            }
        }
    };
    gaps.iter().for_each(|gap| take(gap, &mut found));
    for round in 0.. {
        let Some(worst) = (0..gaps.len()).max_by(|&a, &b| gaps[a].bound.total_cmp(&gaps[b].bound))
        else {
            break;
        };
        let gap = &gaps[worst];
        found.bound = gap.bound;
        let sharp = gap.bound <= found.reached * (1.0 + SHARP) + 2.0 * gap.error;
        if sharp || gap.bound <= enough || round == MOST_HALVINGS {
            break;
        }
        let halves = gaps.swap_remove(worst).halved();
        halves.iter().for_each(|gap| take(gap, &mut found));
        gaps.extend(halves);
    }
    found
}

/// The distance at one parameter, by evaluation.
pub fn deviation_at(composer: &Composer, pcurve: &Curve, curve: &Curve, t: f64) -> f64 {
    let [u0, u1, v0, v1] = composer.surface().domain();
    let [u, v, _] = pcurve.evaluate(t);
    norm(sub(composer.surface().evaluate(u.clamp(u0, u1), v.clamp(v0, v1)), curve.evaluate(t)))
}
