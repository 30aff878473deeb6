//! Bounds of derivatives: how fast points of supports and pcurves move.
//!
//! On a Bezier piece over an interval of length h with poles `P_i`, weights `w_i` and a reference point R let
//! `A = w (C - R)`. Differences of coefficients bound derivatives:
//!
//! ```text
//!   |A'| <= p max |d A_i| / h      |A''| <= p (p - 1) max |d2 A_i| / h^2      the same for w
//!   C' = (A' - w' (C - R)) / w     C'' = (A'' - 2 w' C' - w'' (C - R)) / w    |C - R| <= max |P_i - R|
//! ```
//!
//! All bounds are loosened by a part in 1e9, far above their rounding.

use super::{ElementarySupport, Support};
use crate::bezier::extraction;
use crate::bounds::{Vector, dot, norm, scaled, sub};
use crate::curve::Curve;
use crate::elementary::Elementary;
use crate::error::Error;
use crate::knots::Knots;
use crate::pcurve::Pcurve;
use crate::portable::SameDigits;
use crate::surface::Surface;

/// Cuts of each span for bounds of a support: speeds vary inside a span.
const CUTS: usize = 4;

/// Above the rounding of every bound.
const LOOSE: f64 = 1.0 + 1e-9;

/// Bounds of |x'| and |x''| of both coordinates of a curve in the domain.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Motion {
    pub first: [f64; 2],
    pub second: [f64; 2],
}

/// Greatest values of first and second derivative from homogeneous coefficients; `A` and `w` in rows.
fn quotient<const N: usize>(rows: &[([f64; N], f64)], reach: f64, h: f64) -> [f64; 2] {
    let p = rows.len() - 1;
    let length = |v: [f64; N]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
    let (mut a, mut w) = ([0.0f64; 2], [0.0f64; 2]);
    let difference = |i: usize, k: usize| {
        let (p, q) = (rows[i], rows[i + 1]);
        let r = if k == 2 { rows[i + 2] } else { ([0.0; N], 0.0) };
        let mix = |p: f64, q: f64, r: f64| if k == 1 { q - p } else { r - 2.0 * q + p };
        let vector = std::array::from_fn(|c| mix(p.0[c], q.0[c], r.0[c]));
        (length(vector), mix(p.1, q.1, r.1).abs())
    };
    for k in 1..=2.min(p) {
        for i in 0..=p - k {
            let (da, dw) = difference(i, k);
            (a[k - 1], w[k - 1]) = (a[k - 1].max(da), w[k - 1].max(dw));
        }
    }
    let least = rows.iter().fold(f64::INFINITY, |m, row| m.min(row.1));
    let p = p as f64;
    let (scale_1, scale_2) = (p / h, p * (p - 1.0) / (h * h));
    let (a, w) = ([a[0] * scale_1, a[1] * scale_2], [w[0] * scale_1, w[1] * scale_2]);
    let first = (a[0] + w[0] * reach) / least;
    [first, (a[1] + 2.0 * w[0] * first + w[1] * reach) / least]
}

/// The Bezier coefficients of the part [a, b] of a span, `count` numbers a pole.
fn bezier<const N: usize>(
    knots: &Knots,
    span: usize,
    range: [f64; 2],
    pole: impl Fn(usize) -> [f64; N],
) -> Vec<[f64; N]> {
    let p = knots.degree();
    let mut matrix = vec![0.0; (p + 1) * (p + 1)];
    extraction(knots, span, range, &mut matrix);
    let row = |i: usize| {
        let mut sum = [0.0; N];
        for j in 0..=p {
            let pole = pole(span - p + j);
            (0..N).for_each(|c| sum[c] += matrix[i * (p + 1) + j] * pole[c]);
        }
        sum
    };
    (0..=p).map(row).collect()
}

/// Bounds for a spline curve in the domain on [a, b].
fn spline_motion(curve: &Curve, [a, b]: [f64; 2]) -> Motion {
    let knots = curve.knots();
    let weight = |i: usize| curve.weights().map_or(1.0, |w| w[i]);
    let mut most = Motion::default();
    for span in knots.spans() {
        let (from, to) = (knots.values()[span].max(a), knots.values()[span + 1].min(b));
        if from >= to {
            continue;
        }
        let reference = curve.poles()[span];
        let rows = bezier(knots, span, [from, to], |i| {
            let (p, w) = (curve.poles()[i], weight(i));
            [w * (p[0] - reference[0]), w * (p[1] - reference[1]), w]
        });
        for axis in 0..2 {
            let reach = rows.iter().map(|r| (r[axis] / r[2]).abs()).fold(0.0, f64::max);
            let list: Vec<([f64; 1], f64)> = rows.iter().map(|r| ([r[axis]], r[2])).collect();
            let [first, second] = quotient(&list, reach, to - from);
            most.first[axis] = most.first[axis].max(first * LOOSE);
            most.second[axis] = most.second[axis].max(second * LOOSE);
        }
    }
    most
}

/// Bounds of the derivatives of a pcurve on a part [a, b] of its domain without corners inside.
pub(crate) fn motion(pcurve: &Pcurve, [a, b]: [f64; 2]) -> Motion {
    match pcurve {
        Pcurve::Isoline(line) => {
            let mut motion = Motion::default();
            motion.first[line.fixed.other().index()] = 1.0;
            motion
        }
        Pcurve::Polyline(_) => {
            let mut out = [[0.0; 2]; 2];
            pcurve.derivatives(a + 0.5 * (b - a), 1, &mut out);
            Motion { first: out[1].map(|x| x.abs() * LOOSE), second: [0.0; 2] }
        }
        Pcurve::Spline(curve) => spline_motion(curve, [a, b]),
        Pcurve::Arc(arc) => {
            let most = [0, 1].map(|k| arc.first[k].hypotenuse(arc.second[k]) * LOOSE);
            Motion { first: most, second: most }
        }
    }
}

/// Bounds of |Su| and |Sv| over the domain; none for a function.
///
/// # Errors
/// Memory that could not be had.
pub(crate) fn speeds(support: &Support) -> Result<Option<[f64; 2]>, Error> {
    match support {
        Support::Spline(spline) => Ok(Some(spline_speeds(spline.surface()))),
        Support::Elementary(elementary) => elementary_speeds(elementary).map(Some),
        Support::Callback(_) => Ok(None),
    }
}

fn elementary_speeds(support: &ElementarySupport) -> Result<[f64; 2], Error> {
    let surface = support.surface();
    let [_, _, v0, v1] = surface.domain();
    let speeds = match surface.kind() {
        Elementary::Plane { .. } => [1.0, 1.0],
        Elementary::Cylinder { radius, .. } => [*radius, 1.0],
        Elementary::Cone { radius, half_angle, .. } => {
            let at = |v: f64| (radius + v * half_angle.sine()).abs();
            [at(v0).max(at(v1)), 1.0]
        }
        Elementary::Sphere { radius, .. } => [*radius, *radius],
        Elementary::Torus { major, minor, .. } => [major + minor, *minor],
        Elementary::Revolution { origin, axis, meridian } => {
            let out = |p: &Vector| {
                let from = sub(*p, *origin);
                norm(sub(from, scaled(*axis, dot(from, *axis))))
            };
            let reach = meridian.poles().iter().map(out).fold(0.0, f64::max);
            [reach, curve_speed(meridian)]
        }
        Elementary::Extrusion { curve, direction } => [curve_speed(curve), norm(*direction)],
    };
    Ok(speeds.map(|x| x * LOOSE))
}

/// A bound of the speed of a curve in space.
pub(crate) fn curve_speed(curve: &Curve) -> f64 {
    let knots = curve.knots();
    let weight = |i: usize| curve.weights().map_or(1.0, |w| w[i]);
    let mut most: f64 = 0.0;
    for span in knots.spans() {
        let reference = curve.poles()[span];
        for range in cuts(knots, span) {
            let rows = bezier(knots, span, range, |i| {
                let (p, w) = (sub(curve.poles()[i], reference), weight(i));
                [w * p[0], w * p[1], w * p[2], w]
            });
            most = most.max(first_order(&[rows], range[1] - range[0]));
        }
    }
    most * LOOSE
}

fn cuts(knots: &Knots, span: usize) -> impl Iterator<Item = [f64; 2]> {
    let [a, b] = [knots.values()[span], knots.values()[span + 1]];
    let at = move |k: usize| {
        if k == CUTS { b } else { a + (b - a) * k as f64 / CUTS as f64 }
    };
    (0..CUTS).map(move |k| [at(k), at(k + 1)]).filter(|[a, b]| a < b)
}

/// A bound of the first derivative along the rows of homogeneous coefficients, for any mean of the rows.
fn first_order(rows: &[Vec<[f64; 4]>], h: f64) -> f64 {
    let all = || rows.iter().flatten();
    let least = all().fold(f64::INFINITY, |m, r| m.min(r[3]));
    let place = |r: &[f64; 4]| norm([r[0] / r[3], r[1] / r[3], r[2] / r[3]]);
    let reach = all().map(place).fold(0.0, f64::max);
    let (mut a, mut w) = (0.0f64, 0.0f64);
    for pair in rows.iter().flat_map(|row| row.windows(2)) {
        let d: [f64; 4] = std::array::from_fn(|c| pair[1][c] - pair[0][c]);
        (a, w) = (a.max(norm([d[0], d[1], d[2]])), w.max(d[3].abs()));
    }
    let p = (rows[0].len() - 1) as f64;
    p / h * (a + w * reach) / least
}

fn spline_speeds(surface: &Surface) -> [f64; 2] {
    let (knots_u, knots_v) = (surface.knots_u(), surface.knots_v());
    let stride = knots_v.pole_count();
    let weight = |k: usize| surface.weights().map_or(1.0, |w| w[k]);
    let mut most = [0.0f64; 2];
    for span_u in knots_u.spans() {
        for span_v in knots_v.spans() {
            let reference = surface.poles()[span_u * stride + span_v];
            let pole = |i: usize, j: usize| {
                let k = i * stride + j;
                let (p, w) = (sub(surface.poles()[k], reference), weight(k));
                [w * p[0], w * p[1], w * p[2], w]
            };
            for u in cuts(knots_u, span_u) {
                // Along u first, for each pole along v that counts.
                let strips: Vec<Vec<[f64; 4]>> = (span_v - knots_v.degree()..=span_v)
                    .map(|j| bezier(knots_u, span_u, u, |i| pole(i, j)))
                    .collect();
                for v in cuts(knots_v, span_v) {
                    let along_v: Vec<Vec<[f64; 4]>> = (0..=knots_u.degree())
                        .map(|i| {
                            let first = span_v - knots_v.degree();
                            bezier(knots_v, span_v, v, |j| strips[j - first][i])
                        })
                        .collect();
                    let along_u: Vec<Vec<[f64; 4]>> = (0..=knots_v.degree())
                        .map(|j| along_v.iter().map(|row| row[j]).collect())
                        .collect();
                    most[0] = most[0].max(first_order(&along_u, u[1] - u[0]));
                    most[1] = most[1].max(first_order(&along_v, v[1] - v[0]));
                }
            }
        }
    }
    most.map(|x| x * LOOSE)
}
