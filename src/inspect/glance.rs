//! What the hulls of its derivatives tell about the curvatures of a patch: little, at little cost.

use super::cell::Piece;
use super::interval::Interval;
use crate::bounds::{HALF_ULP, Vector, add, cross, dot, norm, scaled, sub};

/// Hulls of the derivatives by s, t, ss, st and tt, without the degrees' factors.
struct Hulls([[Interval; 3]; 5]);

/// The least box that holds all vectors of a family.
fn hull(vectors: impl Iterator<Item = Vector>, error: f64) -> [Interval; 3] {
    let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    for x in vectors {
        for c in 0..3 {
            low[c] = if x[c] < low[c] { x[c] } else { low[c] };
            high[c] = if x[c] > high[c] { x[c] } else { high[c] };
        }
    }
    [0, 1, 2].map(|c| Interval { low: low[c] - error, high: high[c] + error })
}

impl Hulls {
    /// Of a net with `width` columns, each coordinate off by at most `error`.
    fn new(net: &[Vector], width: usize, error: f64) -> Self {
        let (below, rows) = (&net[width..], || net.chunks_exact(width));
        let first = |a: &Vector, b: &Vector| sub(*b, *a);
        let second = |a: &Vector, b: &Vector, c: &Vector| sub(sub(*c, *b), sub(*b, *a));
        let by_s = net.iter().zip(below).map(|(a, b)| first(a, b));
        let by_t = rows().flat_map(|row| row.windows(2).map(|x| first(&x[0], &x[1])));
        let by_ss = net.iter().zip(below).zip(&net[2 * width..]).map(|((a, b), c)| second(a, b, c));
        let pairs = rows().zip(below.chunks_exact(width));
        let by_st = pairs.flat_map(|(a, b)| {
            a.windows(2).zip(b.windows(2)).map(|(a, b)| sub(sub(b[1], b[0]), sub(a[1], a[0])))
        });
        let by_tt = rows().flat_map(|row| row.windows(3).map(|x| second(&x[0], &x[1], &x[2])));
        Self([
            hull(by_s, 4.0 * error),
            hull(by_t, 4.0 * error),
            hull(by_ss, 8.0 * error),
            hull(by_st, 8.0 * error),
            hull(by_tt, 8.0 * error),
        ])
    }
}

/// The entries a, b, d of the shape operator over a whole polynomial patch; none when the hulls do not exclude a singularity, for
/// rational patches and degrees below 2. `net` is scratch memory.
pub(super) fn glance(piece: &Piece, net: &mut Vec<Vector>) -> Option<[Interval; 3]> {
    let (p, q) = (piece.degree.s, piece.degree.t);
    if piece.rational || p < 2 || q < 2 {
        return None;
    }
    let count = piece.degree.count();
    let at = |c: usize, k: usize| piece.poles[c * count + k];
    net.clear();
    net.extend((0..count).map(|k| [at(0, k), at(1, k), at(2, k)]));
    let size = net.iter().map(|x| dot(*x, *x)).fold(0.0, f64::max).sqrt();
    let sum = |points: &mut dyn Iterator<Item = &Vector>| points.fold([0.0; 3], |a, x| add(a, *x));
    let (width, last) = (q + 1, count - q - 1);
    let along = sub(sum(&mut net[last..].iter()), sum(&mut net[..width].iter()));
    let ends = [q, 0].map(|k| sum(&mut net[k..].iter().step_by(width)));
    let up = cross(along, sub(ends[0], ends[1]));
    let unit = |a: Vector| Some(scaled(a, 1.0 / norm(a))).filter(|a| norm(*a) > 0.5);
    let (first, third) = (unit(along)?, unit(up)?);
    let axes = [first, cross(third, first), third];
    net.iter_mut().for_each(|x| *x = axes.map(|axis| dot(*x, axis)));
    let Hulls(hulls) = Hulls::new(net, width, piece.error + 32.0 * HALF_ULP * size);
    let times = |k: usize, factor: usize| hulls[k].map(|x| x.times(factor as f64));
    let (s, t) = (times(0, p), times(1, q));
    let product = |a: [Interval; 3], b: [Interval; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let square = |a: [Interval; 3]| a[0].squared() + a[1].squared() + a[2].squared();
    let minor = |i: usize, j: usize| s[i] * t[j] - s[j] * t[i];
    let normal = [minor(1, 2), minor(2, 0), minor(0, 1)];
    let (e, f, area) = (square(s), product(s, t), square(normal));
    if e.low <= 0.0 || area.low <= 0.0 {
        return None;
    }
    let l = product(normal, times(2, p * (p - 1)));
    let m = product(normal, times(3, p * q));
    let n = product(normal, times(4, q * (q - 1)));
    let (root, ratio) = (area.sqrt(), f / e);
    let sheared = m - ratio * l;
    let d = e * (n - ratio * (m + sheared)) / (area * root);
    Some([l / (root * e), sheared / area, d])
}
