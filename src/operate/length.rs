//! Arc length with a proven error, and the parameter of a length.
//!
//! On a Bezier piece the speed is `|N| / w^2` with N of degree n. Gauss quadrature of m points on an interval is off by at most
//!
//! ```text
//!   64/15 M rho^(-2 (m-1)) / (1 - rho^-2) half the interval,   |speed| <= M on the ellipse with foci at the ends and sum of half axes rho
//! ```
//!
//! On that ellipse `|t| + |1 - t| = a = (rho + 1/rho) / 2`, so a Bernstein form differs from any value c by at most
//! `max_i |N_i - c| a^n` there. Where this is less than `(sqrt 2 - 1) |c|` the square of N has no zero on the ellipse and the speed is analytic. Pieces are halved
//! until their bounds sum to the tolerance. Beside a cusp, where no ellipse is free of zeros, the length lies between chord and polygon.
//!
//! References: Trefethen, *Approximation Theory and Approximation Practice*, theorem 19.3 (the error of Gauss); Farin, *Curves and
//! Surfaces for CAGD* (polygons of rational pieces with positive weights are longer than the curve).

use super::check_tolerance;
use super::difference::halve;
use super::pieces::{Cut, breaks};
use crate::bezier::binomial;
use crate::bounds::{Aabb, HALF_ULP, Vector, norm, scaled, sub};
use crate::curve::Curve;
use crate::curve::insertion::{Weighted, spare};
use crate::error::Error;
use crate::portable::SameDigits;

/// Points of the quadrature: on an ellipse of 2 the error is 2^-38 of the length, on one of 3 beyond the doubles.
const POINTS: usize = 20;

/// Sums of half axes that are tried, the widest first.
const ELLIPSES: [f64; 5] = [5.0, 3.5, 2.5, 2.0, 1.6];

/// Most halvings of a span.
const MOST_HALVINGS: usize = 48;

/// A tolerance of 0 stands for this share of the length of the polygon.
const DEFAULT_TOLERANCE: f64 = 1e-12;

/// A number and how far it may be from the true one. Proven.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// The number.
    pub value: f64,
    /// The true one is not farther from it than this.
    pub error: f64,
}

/// The arc length of a curve as a function of its parameter, ready for many questions.
#[derive(Clone, Debug)]
pub struct ArcLength {
    nodes: Vec<[f64; 2]>,
    pieces: Vec<Piece>,
    domain: (f64, f64),
}

#[derive(Clone, Debug)]
struct Piece {
    /// The span that it is a part of, and which part: binary fractions, exact.
    span: [f64; 2],
    range: [f64; 2],
    speed: Speed,
    /// Length before it, and its own.
    before: Estimate,
    own: Estimate,
}

impl Curve {
    /// The arc length to a proven error of at most `tolerance` in total, or what rounding allows; 0: 1e-12 of the length.
    ///
    /// # Errors
    /// A tolerance that is negative or not finite; memory that could not be had.
    pub fn arc_length(&self, tolerance: f64) -> Result<ArcLength, Error> {
        check_tolerance(tolerance)?;
        let (cut, p) = (Cut::new(self.knots(), breaks(self.knots())?)?, self.degree());
        let mut strand = self.strand()?;
        let centre = strand[strand.len() / 2].pole;
        strand.iter_mut().for_each(|point| point.pole = sub(point.pole, centre));
        let net = cut.map.apply(&strand)?;
        let allowed = match tolerance {
            0.0 => DEFAULT_TOLERANCE * polygon(&net),
            _ => tolerance,
        };
        let (start, end) = self.domain();
        let mut length =
            ArcLength { nodes: gauss(POINTS), pieces: Vec::new(), domain: (start, end) };
        // Pieces grow by doubling, and each has lists of its own.
        spare(cut.count(), 3 * size_of::<Piece>() + 128 * (p + 1))?;
        for (i, ends) in cut.breaks.windows(2).enumerate() {
            let share = (ends[1] - ends[0]) / (end - start);
            let part = Part::new(&net[i * p..=i * p + p], ends, self.is_rational());
            length.include(part, 0.5 * allowed * share);
        }
        Ok(length)
    }
}

impl ArcLength {
    /// The length of the whole curve.
    pub fn total(&self) -> Estimate {
        self.pieces
            .last()
            .map_or(Estimate { value: 0.0, error: 0.0 }, |piece| sum(piece.before, piece.own))
    }

    /// The length from the start to the parameter `u`.
    ///
    /// # Errors
    /// `u` is outside the domain.
    pub fn at(&self, u: f64) -> Result<Estimate, Error> {
        if !(self.domain.0 <= u && u <= self.domain.1) {
            return Err(Error::InvalidArgument(format!("u: {u} is outside the domain")));
        }
        let share = |piece: &Piece| (u - piece.span[0]) / (piece.span[1] - piece.span[0]);
        let begins = |piece: &Piece| piece.span[0] < u && piece.range[0] <= share(piece);
        let i = self.pieces.partition_point(begins).max(1) - 1;
        let piece = &self.pieces[i];
        let [a, b] = piece.range;
        let local = ((share(piece) - a) / (b - a)).clamp(0.0, 1.0);
        let mut own = piece.to(local, &self.nodes);
        // The share is known to two roundings of the span.
        own.error += 4.0 * HALF_ULP * piece.speed.most / (b - a);
        Ok(sum(piece.before, own))
    }

    /// A parameter to which the length is `length`; the error is a length: how far the true length to there may be from what
    /// was asked for.
    ///
    /// # Errors
    /// A length that is negative or beyond the curve's.
    pub fn parameter(&self, length: f64) -> Result<Estimate, Error> {
        let total = self.total();
        if !(length >= 0.0 && length <= total.value + total.error) {
            let text = format!("length: {length} is not between 0 and {}", total.value);
            return Err(Error::InvalidArgument(text));
        }
        let i = self.pieces.partition_point(|piece| piece.before.value <= length).max(1) - 1;
        let piece = &self.pieces[i];
        let wanted = length - piece.before.value;
        let [a, b] = piece.range;
        let share = a + (b - a) * piece.share(wanted, &self.nodes);
        let [start, end] = piece.span;
        let u = (start + (end - start) * share).clamp(start, end);
        let found = self.at(u)?;
        let error = (found.value - length).abs() + found.error;
        Ok(Estimate { value: u, error: error * (1.0 + 4.0 * HALF_ULP) })
    }

    /// Measures a part, in halves where that is needed.
    fn include(&mut self, mut part: Part, allowed: f64) {
        let speed = Speed::new(&part);
        let own = speed.integral(1.0, &self.nodes);
        let is_fine = own.error <= allowed + 4.0 * speed.rounding;
        if is_fine || part.halvings >= MOST_HALVINGS {
            let before = self.total();
            self.pieces.push(Piece { span: part.span, range: part.range, speed, before, own });
            return;
        }
        let mut behind = part.clone();
        let p = part.net.len() - 1;
        halve(&mut part.net, &mut behind.net, [p, 0], 0);
        let middle = 0.5 * (part.range[0] + part.range[1]);
        (part.range[1], behind.range[0]) = (middle, middle);
        for mut half in [part, behind] {
            half.halvings += 1;
            half.recentre();
            let diagonal = half.diagonal();
            half.rounding =
                0.5 * half.rounding + 24.0 * (p * p) as f64 * HALF_ULP * diagonal * half.ratio();
            self.include(half, 0.5 * allowed);
        }
    }
}

fn sum(a: Estimate, b: Estimate) -> Estimate {
    let value = a.value + b.value;
    Estimate { value, error: (a.error + b.error + HALF_ULP * value) * (1.0 + 2.0 * HALF_ULP) }
}

/// A part of a span as a Bezier piece.
#[derive(Clone)]
struct Part {
    net: Vec<Weighted>,
    span: [f64; 2],
    range: [f64; 2],
    halvings: usize,
    is_rational: bool,
    /// What rounding of the poles may do to the length.
    rounding: f64,
}

impl Part {
    /// A span. Its poles are off by `(18 p + 25) d + 2 m` half ulps (see [`super::difference`]), d the diagonal of its net and m the
    /// largest coordinate; a change of e changes the speed by at most 2 p e times the ratio of the weights. A halving adds
    /// at most `12 p d` half ulps around a pole of its own.
    fn new(net: &[Weighted], ends: &[f64], is_rational: bool) -> Self {
        let far = net.iter().flat_map(|point| point.pole).fold(0.0, |far: f64, x| far.max(x.abs()));
        let (net, p) = (net.to_vec(), (net.len() - 1) as f64);
        let (span, range) = ([ends[0], ends[1]], [0.0, 1.0]);
        let mut part = Self { net, span, range, halvings: 0, is_rational, rounding: 0.0 };
        let pole = HALF_ULP * ((18.0 * p + 27.0) * part.diagonal() + 2.0 * far);
        part.rounding = 2.0 * p * pole * part.ratio();
        part.recentre();
        part
    }

    fn recentre(&mut self) {
        let centre = self.net[0].pole;
        self.net.iter_mut().for_each(|point| point.pole = sub(point.pole, centre));
    }

    fn diagonal(&self) -> f64 {
        let mut bounds = Aabb::EMPTY;
        self.net.iter().for_each(|point| bounds.include(point.pole));
        bounds.diagonal()
    }

    /// Greatest weight over least.
    fn ratio(&self) -> f64 {
        if !self.is_rational {
            return 1.0;
        }
        let weights = self.net.iter().map(|point| point.weight);
        let (low, high) =
            weights.fold((f64::INFINITY, 0.0_f64), |(low, high), w| (low.min(w), high.max(w)));
        high / low
    }
}

/// The speed on a piece over [0, 1], and what is known of it.
#[derive(Clone, Debug)]
struct Speed {
    /// Bernstein coefficients of N.
    vectors: Vec<Vector>,
    /// Bernstein coefficients of w; one of them is enough for a constant.
    weights: Vec<f64>,
    /// Error of the quadrature over the whole piece; infinite when nothing is proven.
    quadrature: f64,
    /// What rounding may do to the length.
    rounding: f64,
    chord: f64,
    polygon: f64,
    /// A bound of the speed.
    most: f64,
}

impl Speed {
    fn new(part: &Part) -> Self {
        let (vectors, weights) = derivative(&part.net, part.is_rational);
        let (net, p) = (&part.net, part.net.len() - 1);
        let chord = norm(sub(net[p].pole, net[0].pole));
        let polygon = polygon(net);
        // Weights within (20 + 5 halvings) p half ulps of themselves, products and sums within 16 (p + 2).
        let steps = (100 + 20 * part.halvings) as f64 * (p + 2) as f64;
        let rounding = part.rounding + HALF_ULP * steps * polygon * part.ratio();
        let quadrature = quadrature_error(&vectors, &weights);
        let longest = vectors.iter().fold(0.0, |most: f64, v| most.max(norm(*v)));
        let least = weights.iter().fold(f64::INFINITY, |least: f64, w| least.min(*w));
        let most = longest / (least * least);
        Self { vectors, weights, quadrature, rounding, chord, polygon, most }
    }

    fn at(&self, t: f64) -> f64 {
        let vector = [0, 1, 2].map(|axis| horner(&self.vectors, t, |v| v[axis]));
        let w = if let [w] = self.weights[..] { w } else { horner(&self.weights, t, |w| *w) };
        norm(vector) / (w * w)
    }

    /// The length over [0, share].
    fn integral(&self, share: f64, nodes: &[[f64; 2]]) -> Estimate {
        if self.quadrature <= 0.5 * (self.polygon - self.chord) {
            let terms = nodes.iter().map(|[x, weight]| weight * self.at(0.5 * share * (1.0 + x)));
            let value = 0.5 * share * terms.sum::<f64>();
            return Estimate { value, error: self.quadrature * share + self.rounding };
        }
        let middle = 0.5 * (self.polygon + self.chord);
        let half = 0.5 * (self.polygon - self.chord).max(0.0) + self.rounding;
        if share >= 1.0 {
            return Estimate { value: middle, error: half };
        }
        // Somewhere on a short piece.
        Estimate { value: share * middle, error: self.polygon + self.rounding }
    }
}

impl Piece {
    fn to(&self, share: f64, nodes: &[[f64; 2]]) -> Estimate {
        if share >= 1.0 { self.own } else { self.speed.integral(share, nodes) }
    }

    /// The share of the piece with a length: safeguarded Newton.
    fn share(&self, wanted: f64, nodes: &[[f64; 2]]) -> f64 {
        if wanted <= 0.0 {
            return 0.0;
        }
        if wanted >= self.own.value {
            return 1.0;
        }
        let (mut low, mut high, mut t) = (0.0, 1.0, wanted / self.own.value);
        for _ in 0..60 {
            let excess = self.speed.integral(t, nodes).value - wanted;
            if excess > 0.0 {
                high = t
            } else {
                low = t
            }
            let mut next = t - excess / self.speed.at(t);
            if !(next > low && next < high) {
                next = 0.5 * (low + high);
            }
            if next == t || next == low && low == high {
                break;
            }
            let step = (next - t).abs();
            t = next;
            if step <= 2.0 * HALF_ULP {
                break;
            }
        }
        t
    }
}

fn polygon(net: &[Weighted]) -> f64 {
    net.windows(2).map(|pair| norm(sub(pair[1].pole, pair[0].pole))).sum()
}

/// N and w of a piece over [0, 1]: `sum_ij w_i w_j (P_i - P_j) B_i' B_j`, and the weights.
fn derivative(net: &[Weighted], is_rational: bool) -> (Vec<Vector>, Vec<f64>) {
    let p = net.len() - 1;
    if !is_rational {
        let step = |pair: &[Weighted]| scaled(sub(pair[1].pole, pair[0].pole), p as f64);
        return (net.windows(2).map(step).collect(), vec![1.0]);
    }
    let top = net.iter().fold(0.0, |top: f64, point| top.max(point.weight));
    let weights: Vec<f64> = net.iter().map(|point| point.weight / top).collect();
    let mut vectors = vec![[0.0; 3]; 2 * p];
    for i in 0..p {
        for j in 0..=p {
            let share = binomial(p - 1, i) * binomial(p, j) / binomial(2 * p - 1, i + j);
            let factor = p as f64 * share * weights[j];
            for axis in 0..3 {
                let from = |k: usize| weights[k] * (net[k].pole[axis] - net[j].pole[axis]);
                vectors[i + j][axis] += factor * (from(i + 1) - from(i));
            }
        }
    }
    (vectors, weights)
}

/// The least of the bounds of the head of this file.
fn quadrature_error(vectors: &[Vector], weights: &[f64]) -> f64 {
    let n = vectors.len() - 1;
    let middle = [0, 1, 2].map(|axis| horner(vectors, 0.5, |v| v[axis]));
    let spread = vectors.iter().fold(0.0, |most: f64, v| most.max(norm(sub(*v, middle))));
    let w = if let [w] = *weights { w } else { horner(weights, 0.5, |w| *w) };
    let spread_w = weights.iter().fold(0.0, |most: f64, x| most.max((x - w).abs()));
    let bound = |rho: f64| {
        let a = 0.5 * (rho + 1.0 / rho) * (1.0 + 1e-15);
        let e = spread * a.powi(n as i32) * (1.0 + 1e-12);
        let least_w = w - spread_w * a.powi(weights.len() as i32 - 1) * (1.0 + 1e-12);
        if e >= 0.414 * norm(middle) || least_w <= 0.0 {
            return f64::INFINITY;
        }
        let most = (norm(middle) + e) / (least_w * least_w);
        let decay = rho.powi(-2 * (POINTS as i32 - 1)) / (1.0 - rho.powi(-2));
        0.5 * 64.0 / 15.0 * most * decay * (1.0 + 1e-12)
    };
    ELLIPSES.iter().map(|rho| bound(*rho)).fold(f64::INFINITY, f64::min)
}

/// A Bernstein form at `t`, from the powers of the smaller of t and 1 - t.
fn horner<T>(coefficients: &[T], t: f64, of: impl Fn(&T) -> f64) -> f64 {
    let n = coefficients.len() - 1;
    let (up, down) = (t, 1.0 - t);
    let is_low = t < 0.5;
    let ratio = if is_low { up / down } else { down / up };
    let mut sum = 0.0;
    for k in (0..=n).rev() {
        let place = if is_low { k } else { n - k };
        sum = sum * ratio + binomial(n, k) * of(&coefficients[place]);
    }
    sum * if is_low { down.powi(n as i32) } else { up.powi(n as i32) }
}

/// Nodes and weights of Gauss quadrature on [-1, 1], from the zeros of the Legendre polynomial.
fn gauss(count: usize) -> Vec<[f64; 2]> {
    let legendre = |x: f64| {
        let (mut before, mut value) = (1.0, x);
        for k in 1..count {
            let k = k as f64;
            (before, value) = (value, ((2.0 * k + 1.0) * x * value - k * before) / (k + 1.0));
        }
        let slope = count as f64 * (x * value - before) / (x * x - 1.0);
        (value, slope)
    };
    let node = |i: usize| {
        let mut x = (std::f64::consts::PI * (i as f64 + 0.75) / (count as f64 + 0.5)).cosine();
        for _ in 0..8 {
            let (value, slope) = legendre(x);
            x -= value / slope;
        }
        let slope = legendre(x).1;
        [x, 2.0 / ((1.0 - x * x) * slope * slope)]
    };
    (0..count).map(node).collect()
}
