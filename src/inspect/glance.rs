//! What the hulls of its derivatives tell about the curvatures of a patch: little, at little cost.

use super::cell::{Piece, Shape};
use super::interval::Interval;
use super::slope::Slope;
use crate::bounds::{HALF_ULP, Vector, add, cross, dot, norm, scaled, sub};

/// A function of which only the range is known.
fn ranging(range: Interval) -> Slope<2> {
    let entire = Interval::ENTIRE;
    Slope { middle: entire, range, gradient: [entire; 2] }
}

/// Sums of the differences of a net of vectors in one direction, as a net.
fn differences(net: &[Vector], width: usize, along_s: bool) -> Vec<Vector> {
    if along_s {
        return net.iter().zip(&net[width..]).map(|(a, b)| sub(*b, *a)).collect();
    }
    let rows = net.chunks_exact(width);
    rows.flat_map(|row| row.windows(2).map(|pair| sub(pair[1], pair[0]))).collect()
}

/// The shape operator over a whole polynomial patch; none when the hulls do not exclude a singularity, for rational patches and
/// degrees below 2.
pub(super) fn glance(piece: &Piece) -> Option<Shape> {
    let (p, q) = (piece.degree.s, piece.degree.t);
    if piece.rational || p < 2 || q < 2 {
        return None;
    }
    let count = piece.degree.count();
    let at = |c: usize, k: usize| piece.poles[c * count + k];
    let net: Vec<Vector> = (0..count).map(|k| [at(0, k), at(1, k), at(2, k)]).collect();
    let size = net.iter().map(|x| norm(*x)).fold(0.0, f64::max);
    let by_s = differences(&net, q + 1, true);
    let by_t = differences(&net, q + 1, false);
    let seconds = [
        differences(&by_s, q + 1, true),
        differences(&by_s, q + 1, false),
        differences(&by_t, q, false),
    ];
    let sum = |net: &[Vector]| net.iter().fold([0.0; 3], |sum, x| add(sum, *x));
    let (along, side) = (sum(&by_s), sum(&by_t));
    let up = cross(along, side);
    let unit = |a: Vector| Some(scaled(a, 1.0 / norm(a))).filter(|a| norm(*a) > 0.5);
    let (first, third) = (unit(along)?, unit(up)?);
    let axes = [first, cross(third, first), third];
    let error = piece.error + 32.0 * HALF_ULP * size;
    let range = |net: &[Vector], factor: usize, differences: f64| {
        let factor = factor as f64;
        axes.map(|axis| {
            let nothing = (f64::INFINITY, f64::NEG_INFINITY);
            let (low, high) = net.iter().map(|x| dot(*x, axis)).fold(nothing, |(low, high), x| {
                (if x < low { x } else { low }, if x > high { x } else { high })
            });
            let error = differences * error;
            Interval { low: factor * (low - error), high: factor * (high + error) }
        })
    };
    let (s, t) = (range(&by_s, p, 4.0), range(&by_t, q, 4.0));
    let product = |a: [Interval; 3], b: [Interval; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let square = |a: [Interval; 3]| a[0].squared() + a[1].squared() + a[2].squared();
    let minor = |i: usize, j: usize| s[i] * t[j] - s[j] * t[i];
    let normal = [minor(1, 2), minor(2, 0), minor(0, 1)];
    let (e, f, area) = (square(s), product(s, t), square(normal));
    if e.low <= 0.0 || area.low <= 0.0 {
        return None;
    }
    let bent = |net: &[Vector], factor: usize| product(normal, range(net, factor, 8.0));
    let l = bent(&seconds[0], p * (p - 1));
    let m = bent(&seconds[1], p * q);
    let n = bent(&seconds[2], q * (q - 1));
    let (root, ratio) = (area.sqrt(), f / e);
    let sheared = m - ratio * l;
    Some(Shape {
        a: ranging(l / (root * e)),
        b: ranging(sheared / area),
        d: ranging(e * (n - ratio * (m + sheared)) / (area * root)),
    })
}
