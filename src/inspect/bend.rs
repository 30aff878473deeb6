//! How a curve bends: comb, extrema of the curvature, inflections, monotone pieces.
//!
//! The squared curvature of a segment is a quotient of polynomials, and its derivative's numerator is one polynomial
//!
//! ```text
//!   k^2 = m W^6 / a^3      zero of   m' a W + 6 m W' a - 3 m W a'
//! ```
//!
//! whose zeros [`crate::roots`] isolates: none is missing. Between two of them, and at knots where the slope of the
//! curvature jumps, the curvature is monotone.
//!
//! Limit: degrees up to 17, rational ones up to 9: beyond, the products are longer than 94 coefficients.

use super::cell::Bending;
use super::polynomial::Polynomial;
use super::request::segment_piece;
use crate::bezier::{Bidegree, MAX_TRIPLE};
use crate::bounds::{Vector, cross, dot, norm, scaled, sub};
use crate::curve::Curve;
use crate::error::Error;
use crate::index::{IndexedCurve, Span};
use crate::knots::Side;
use crate::roots::{Found, Zero, zeros_of};

/// Values below this share of their terms are as good as zero on a short interval.
const FLAT: f64 = 1e-11;

/// Curvatures that differ by less than this share are the same on both sides of a knot.
const SAME: f64 = 1e-6;

/// Boxes a segment may take.
const BUDGET: u64 = 20_000;

/// A tooth of a curvature comb.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tooth {
    /// Parameter.
    pub u: f64,
    /// The point.
    pub point: Vector,
    /// Unit tangent; zero where the derivative vanishes.
    pub tangent: Vector,
    /// Curvature vector: curvature times the unit normal; towards the centre of curvature.
    pub bend: Vector,
    /// Curvature, 1 / length, at least 0.
    pub curvature: f64,
    /// Torsion, 1 / length; 0 where the curvature vanishes.
    pub torsion: f64,
}

/// The curvature at one parameter, of the piece on one side of a knot.
pub fn tooth(curve: &Curve, u: f64, side: Side) -> Tooth {
    let mut d = [[0.0; 3]; 4];
    curve.derivatives_on(u, side, 3, &mut d);
    let speed = norm(d[1]);
    let zero =
        Tooth { u, point: d[0], tangent: [0.0; 3], bend: [0.0; 3], curvature: 0.0, torsion: 0.0 };
    if speed == 0.0 || !speed.is_finite() {
        return zero;
    }
    let tangent = scaled(d[1], 1.0 / speed);
    let across = cross(tangent, d[2]);
    let bend = scaled(cross(across, tangent), 1.0 / (speed * speed));
    let curvature = norm(bend);
    let square = dot(across, across);
    let torsion = if square > 0.0 { dot(across, d[3]) / (square * speed) } else { 0.0 };
    Tooth { tangent, bend, curvature, torsion, ..zero }
}

/// A comb with `count` teeth a span, the ends of the spans included: at a knot both sides, where they differ or not.
pub fn comb(curve: &Curve, count: usize) -> Vec<Tooth> {
    let t = curve.knots().values();
    let steps = count.max(2) - 1;
    let span = |i: usize| {
        let at = move |k: usize| match k {
            0 => (t[i], Side::Above),
            k if k == steps => (t[i + 1], Side::Below),
            k => (t[i] + (t[i + 1] - t[i]) * (k as f64 / steps as f64), Side::Above),
        };
        (0..=steps).map(at).map(|(u, side)| tooth(curve, u, side))
    };
    curve.knots().spans().flat_map(span).collect()
}

/// How the curvature runs on a piece.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Trend {
    /// It grows with the parameter.
    Rising,
    /// It falls.
    Falling,
    /// It is the same up to rounding.
    Constant,
    /// Neither could be shown.
    Unknown,
}

/// A piece of a curve on which the curvature is monotone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Monotone {
    /// First and last parameter.
    pub u: [f64; 2],
    /// How the curvature runs.
    pub trend: Trend,
    /// Curvature at the beginning and at the end, of the piece itself.
    pub curvature: [f64; 2],
}

/// A place where the curve is straight to second order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inflection {
    /// Parameter; the middle when a whole interval is straight.
    pub u: f64,
    /// The interval that holds it.
    pub interval: [f64; 2],
    /// Whether the bend has different sides just before and just behind (evaluated).
    pub changes: bool,
}

/// The direction across the plane that the poles are nearest to, at least about: the longest of the triangles' normals.
pub fn plane_normal(curve: &Curve) -> Vector {
    let poles = &curve.poles()[curve.knots().active_poles()];
    let origin = poles[0];
    let far = |from: Vector| {
        move |a: &&Vector, b: &&Vector| norm(sub(**a, from)).total_cmp(&norm(sub(**b, from)))
    };
    let along = poles.iter().max_by(far(origin)).map_or([0.0; 3], |p| sub(*p, origin));
    let normal = |p: &Vector| cross(along, sub(*p, origin));
    let best = poles.iter().map(normal).max_by(|a, b| norm(*a).total_cmp(&norm(*b)));
    match best {
        Some(n) if norm(n) > 0.0 => scaled(n, 1.0 / norm(n)),
        _ => [0.0, 0.0, 1.0],
    }
}

fn check_degree(curve: &Curve) -> Result<(), Error> {
    let p = curve.degree();
    let (longest, most) =
        if curve.is_rational() { (11 * p - 8, 9) } else { ((6 * p).saturating_sub(8), 17) };
    if longest <= MAX_TRIPLE {
        return Ok(());
    }
    Err(Error::Unsupported(format!("degree: {p}, monotone pieces are found up to degree {most}")))
}

/// Numerator of the derivative of the squared curvature, and the size of its terms.
fn slope_numerator(bending: &Bending) -> (Polynomial, f64) {
    let (m, a) = (&bending.bending, &bending.speed);
    let (m1, a1) = (m.derivative(1), a.derivative(1));
    let size = |terms: &[&Polynomial]| terms.iter().map(|f| f.size()).product::<f64>();
    match &bending.weight {
        None => {
            let slope = m1.times(a).plus(-3.0, &m.times(&a1));
            (slope, size(&[&m1, a]) + 3.0 * size(&[m, &a1]))
        }
        Some(w) => {
            let w1 = w.derivative(1);
            let first = m1.times(&a.times(w));
            let second = m.times(&a.times(&w1));
            let third = m.times(&a1.times(w));
            let terms = size(&[&m1, a, w]) + 6.0 * size(&[m, a, &w1]) + 3.0 * size(&[m, &a1, w]);
            (first.plus(6.0, &second).plus(-3.0, &third), terms)
        }
    }
}

/// Zeros of one polynomial of a segment, on [0, 1].
fn zeros(f: &Polynomial, size: f64) -> Vec<Zero<1>> {
    let mut out = Vec::new();
    let is_flat = |low: f64, high: f64, value: f64, is_noise: bool| {
        is_noise
            || (value <= FLAT * size && high - low < 1e-3)
            || value * (high - low) <= 1e-3 * FLAT * size
    };
    zeros_of(&f.coefficients, f.error, &is_flat, &mut BUDGET.clone(), &mut out);
    out
}

fn value(f: &Polynomial, x: f64) -> f64 {
    f.on([0.0, 1.0], [x, x], &mut Vec::new()).middle.middle()
}

/// The pieces of the curve on which the curvature is monotone, in order, and complete: between two neighbours there is an
/// extremum of the curvature, or it jumps.
///
/// # Errors
/// The degree is too high; memory that could not be had.
pub fn monotone_pieces(curve: &IndexedCurve) -> Result<Vec<Monotone>, Error> {
    check_degree(curve.curve())?;
    let index = curve.index(&mut || false)?;
    let mut pieces: Vec<Monotone> = Vec::new();
    for k in 0..index.segments.len() {
        let span = index.segments[k].u;
        let (slope, size) = slope_numerator(&Bending::new(&segment_piece(index, k)));
        for (part, trend) in trends(&slope, size) {
            let u = part.map(|x| span.global(x));
            if u[0] < u[1] {
                push_piece(&mut pieces, curve.curve(), u, trend);
            }
        }
    }
    Ok(pieces)
}

/// Parts of [0, 1] with the trend on each.
fn trends(slope: &Polynomial, size: f64) -> Vec<([f64; 2], Trend)> {
    let mut parts = Vec::new();
    let mut from = 0.0;
    let sign = |a: f64, b: f64| {
        if b <= a {
            return None;
        }
        let value = value(slope, 0.5 * (a + b));
        Some(if value > 0.0 { Trend::Rising } else { Trend::Falling })
    };
    for zero in zeros(slope, size) {
        let ends = match zero.found {
            Found::Root => [zero.at[0]; 2],
            _ => [zero.low[0], zero.high[0]],
        };
        if let Some(trend) = sign(from, ends[0]) {
            parts.push(([from, ends[0]], trend));
        }
        if zero.found != Found::Root && ends[1] > ends[0] {
            let is_known = zero.found == Found::Flat;
            parts.push((ends, if is_known { Trend::Constant } else { Trend::Unknown }));
        }
        from = from.max(ends[1]);
    }
    if let Some(trend) = sign(from, 1.0) {
        parts.push(([from, 1.0], trend));
    }
    parts
}

/// Adds a piece, or lengthens the last one when the curvature goes on.
fn push_piece(pieces: &mut Vec<Monotone>, curve: &Curve, u: [f64; 2], trend: Trend) {
    let start = tooth(curve, u[0], Side::Above).curvature;
    let end = tooth(curve, u[1], Side::Below).curvature;
    // A very short flat interval is a multiple zero: an extremum or a saddle, not a piece.
    let (first, last) = curve.domain();
    let is_short = u[1] - u[0] < 1e-4 * (last - first);
    if let (Trend::Constant, true, Some(piece)) = (trend, is_short, pieces.last_mut()) {
        piece.u[1] = u[1];
        piece.curvature[1] = end;
        return;
    }
    if let Some(piece) = pieces.last_mut() {
        let jump = (piece.curvature[1] - start).abs();
        if piece.trend == trend && jump <= SAME * start.max(piece.curvature[1]).max(1e-300) {
            piece.u[1] = u[1];
            piece.curvature[1] = end;
            return;
        }
    }
    pieces.push(Monotone { u, trend, curvature: [start, end] });
}

/// The places where the curve, seen along `normal`, changes the side to which it bends or is straight: none is missing.
///
/// # Errors
/// The degree is too high; memory that could not be had.
pub fn inflections(curve: &IndexedCurve, normal: Vector) -> Result<Vec<Inflection>, Error> {
    if !(norm(normal) > 0.0 && norm(normal).is_finite()) {
        return Err(Error::InvalidArgument("normal: is zero or not finite".into()));
    }
    check_degree(curve.curve())?;
    let index = curve.index(&mut || false)?;
    let normal = scaled(normal, 1.0 / norm(normal));
    let mut found = Vec::new();
    let mut before: Option<f64> = None;
    for k in 0..index.segments.len() {
        let bending = Bending::new(&segment_piece(index, k));
        let side = seen_along(&bending, normal);
        let size = bending.bending.size().sqrt();
        let span = index.segments[k].u;
        let at_start = value(&side, 0.0);
        if before.is_some_and(|before| before * at_start < 0.0) {
            let u = span.global(0.0);
            found.push(Inflection { u, interval: [u, u], changes: true });
        }
        before = push_zeros(&side, size, span, &mut found);
    }
    // At a knot both segments have their say.
    let (start, end) = curve.curve().domain();
    for place in found.iter_mut().filter(|place| place.changes) {
        let bend = |u: f64, side: Side| {
            let mut d = [[0.0; 3]; 3];
            curve.curve().derivatives_on(u.clamp(start, end), side, 2, &mut d);
            dot(cross(d[1], d[2]), normal)
        };
        let step = 2e-6 * (end - start);
        let [low, high] = [place.interval[0] - step, place.interval[1] + step];
        let inside = low > start && high < end;
        place.changes = inside && bend(low, Side::Below) * bend(high, Side::Above) < 0.0;
    }
    Ok(found)
}

/// The part of W^3 C' x C'' along a direction.
fn seen_along(bending: &Bending, normal: Vector) -> Polynomial {
    let [x, y, z] = &bending.binormal;
    let degree: Bidegree = x.degree;
    let zero = Polynomial::new(&vec![0.0; degree.count()], degree, 0.0);
    zero.plus(normal[0], x).plus(normal[1], y).plus(normal[2], z)
}

/// Adds the zeros of one segment; gives its last value, when that is not zero.
fn push_zeros(
    side: &Polynomial,
    size: f64,
    span: Span,
    found: &mut Vec<Inflection>,
) -> Option<f64> {
    let mut last = Some(value(side, 1.0)).filter(|x| *x != 0.0);
    for zero in zeros(side, size) {
        let interval = [span.global(zero.low[0]), span.global(zero.high[0])];
        let changes = zero.found == Found::Root && {
            let around = |x: f64| value(side, x.clamp(0.0, 1.0));
            let radius = 1e-6;
            zero.at[0] <= radius
                || zero.at[0] >= 1.0 - radius
                || around(zero.at[0] - radius) * around(zero.at[0] + radius) < 0.0
        };
        if zero.high[0] >= 1.0 - 1e-12 {
            last = None;
        }
        let u = span.global(zero.at[0]);
        // A zero at a knot is seen from both segments.
        let known = |old: &Inflection| interval[0] <= old.interval[1] || u == old.u;
        match found.last_mut() {
            Some(old) if known(old) => old.interval[1] = old.interval[1].max(interval[1]),
            _ => found.push(Inflection { u, interval, changes }),
        }
    }
    last
}

/// How often the curve, seen along `normal`, changes the side to which it bends: what a designer counts.
///
/// # Errors
/// As [`inflections`].
pub fn turn_count(curve: &IndexedCurve, normal: Vector) -> Result<usize, Error> {
    Ok(inflections(curve, normal)?.iter().filter(|place| place.changes).count())
}
