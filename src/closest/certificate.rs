//! The tests that lines and patches share, as inequalities with their rounding: planes, first-order bounds, products.
//!
//! Every function here errs on one side only; `docs/rounding.md` derives the counts.

use super::proof::Proof;
use crate::bounds::{HALF_ULP, Vector, cross, dot, norm, scaled, sub};
use crate::simd::Lanes;

/// Rounding of the coefficients of `N = |r|^2` relative to those of `C = W^2`, as a squared length.
///
/// `position` is how far `r / W` may be off, `radius` bounds its length, `steps` counts half ulps of the products.
pub fn squared_error(position: f64, radius: f64, steps: f64) -> f64 {
    (2.0 * radius + position) * position + steps * radius * radius
}

/// Coefficients of `C = W^2` below this may have lost digits to underflow: then no test of the box counts. Happens where
/// weights of one piece differ by more than 1e130.
pub const LEAST_C: f64 = 1e-270;

/// Whether there is such a coefficient.
pub fn underflows(c: &[f64]) -> bool {
    c.iter().any(|&x| x < LEAST_C)
}

/// `X - W p` in place of `X`; returns the greatest `|r| / W`.
pub fn subtract_query(net: &mut [f64], count: usize, query: Vector) -> f64 {
    let (xyz, w) = net.split_at_mut(3 * count);
    let mut greatest: f64 = 0.0;
    for k in 0..count {
        let mut sum = 0.0;
        for c in 0..3 {
            let r = xyz[c * count + k] - w[k] * query[c];
            xyz[c * count + k] = r;
            sum += r * r;
        }
        greatest = greatest.max(sum / (w[k] * w[k]));
    }
    greatest.sqrt() * (1.0 + 8.0 * HALF_ULP)
}

/// Whether a plane at the proof's target from the query has all of a net on its other side. `net` holds `r` and `W`.
///
/// Two normals are tried: that to the best foot, and that of the summed net. The linear form has no squares, so it
/// works down to rounding; on the convex side of a shape it closes whole pieces at once. What lies behind the first plane
/// ties nowhere but around the best foot; the second one stands at the reach of ties.
pub fn plane_separates(net: &[f64], count: usize, proof: &Proof, position: f64) -> bool {
    let (xyz, w) = net.split_at(3 * count);
    let beyond = |n: Vector, least: f64| {
        (0..count).all(|k| {
            n[0] * xyz[k] + n[1] * xyz[count + k] + n[2] * xyz[2 * count + k] > least * w[k]
        })
    };
    if beyond(proof.direction, least_height(proof.target, position)) {
        return true;
    }
    let n = [0, 1, 2].map(|c| xyz[c * count..(c + 1) * count].iter().sum::<f64>());
    let size = norm(n);
    size > 0.0
        && size.is_finite()
        && beyond(n.map(|x| x / size), least_height(proof.reach(), position))
}

/// The height of a net over planes through the query that fit nets longer than they are thick, whose corners are given.
///
/// Three normals are tried: that of the plane through the corners, those away from the query and to the best foot; all
/// made perpendicular to the longest diagonal, twice, so that what is left along it is rounding of 1 and not of the
/// net's thickness. The net is that far away, less `2 position` and 32 half ulps.
pub fn tilted_height(net: &[f64], count: usize, corners: [usize; 4], proof: &Proof) -> f64 {
    let (xyz, w) = net.split_at(3 * count);
    let pole = |k: usize| [0, 1, 2].map(|c| xyz[c * count + k] / w[k]);
    let [a, b, c, d] = corners.map(pole);
    let (first, second) = (sub(d, a), sub(c, b));
    let longest = if dot(first, first) >= dot(second, second) { first } else { second };
    let along = scaled(longest, 1.0 / norm(longest));
    let middle = [0, 1, 2].map(|k| 0.25 * ((a[k] + d[k]) + (b[k] + c[k])));
    let unit = |n: Vector| scaled(n, 1.0 / norm(n));
    let across = |n: Vector| unit(sub(n, scaled(along, dot(n, along))));
    let height = |n: Vector| {
        let n = across(across(unit(n)));
        let n = if dot(n, middle) < 0.0 { scaled(n, -1.0) } else { n };
        if !n.iter().all(|x| x.is_finite()) {
            return f64::NEG_INFINITY;
        }
        let over = |k: usize| n[0] * xyz[k] + n[1] * xyz[count + k] + n[2] * xyz[2 * count + k];
        (0..count).map(|k| over(k) / w[k]).fold(f64::INFINITY, f64::min)
    };
    height(cross(first, second)).max(height(middle)).max(height(proof.direction))
}

/// The height that a net must have over a plane to be farther than `level`.
pub fn least_height(level: f64, position: f64) -> f64 {
    (level + 2.0 * position) * (1.0 + 32.0 * HALF_ULP)
}

/// How a net (`r` and `W`) lies to what counts as one foot.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Nearness {
    /// All of it is so near to the best foot that nothing in it counts as another one.
    pub around_foot: bool,
    /// It is so small that it holds one foot at most.
    pub small: bool,
}

/// See [`Nearness`].
pub fn nearness(net: &[f64], count: usize, proof: &Proof) -> Nearness {
    let home = proof.direction.map(|x| x * proof.best);
    let (xyz, w) = net.split_at(3 * count);
    let pole = |k: usize| [0, 1, 2].map(|c| xyz[c * count + k] / w[k]);
    let (first, apart) = (pole(0), proof.apart_squared());
    let within = |from: Vector, most: f64| {
        (0..count).map(pole).all(|x| {
            let move_ = sub(x, from);
            dot(move_, move_) <= most
        })
    };
    Nearness { around_foot: within(home, apart), small: within(first, apart / 64.0) }
}

/// As [`plane_separates`] with the normal to the best foot, for poles `X` (and `W` when rational).
pub fn foot_plane_separates(
    poles: &[f64],
    count: usize,
    rational: bool,
    query: Vector,
    proof: &Proof,
    position: f64,
) -> bool {
    let n = proof.direction;
    let least = least_height(proof.target, position) + dot(n, query);
    let height = |k: usize| n[0] * poles[k] + n[1] * poles[count + k] + n[2] * poles[2 * count + k];
    if rational {
        (0..count).all(|k| height(k) > least * poles[3 * count + k])
    } else {
        (0..count).all(|k| height(k) > least)
    }
}

/// A lower bound of `h = W^2 (d^2 - target^2)` where the distance is `d` and the weight `w`, both rounded.
pub fn value_at(d: f64, w: f64, position: f64, proof: &Proof) -> f64 {
    let d = d - position;
    if d <= proof.target {
        0.0
    } else {
        w * w * ((d - proof.target) * (d + proof.target)) * (1.0 - 1e-12)
    }
}

/// How far the computed slope `2 w (w' (d^2 - target^2) + w d.d')` of `h` may be off.
///
/// With `position` the error of the point, that of the derivative is at most `12 degree position / w` (weights are
/// at most 2 after normalisation, and the quotient rule has three terms); `w'` is at most `4 degree`.
#[inline(always)]
pub fn slope_error<V: Lanes<N>, const N: usize>(
    d: V,
    speed: V,
    w: V,
    position: V,
    degree: usize,
) -> V {
    let p = degree as f64;
    let derivative = V::splat(12.0 * p) * position / w.min(V::splat(1.0));
    let rounding = V::splat(16.0 * HALF_ULP) * d * speed;
    let product = position * (speed + derivative) + d * derivative + rounding;
    let weighted = V::splat(16.0) * w * V::splat(p) * d * (position + V::splat(1e-14) * d);
    V::splat(4.0) * w * w * product + weighted
}

/// The part of a slope that can lower `h`: at the low end only a negative one, at the high end only a positive one.
pub fn free_slope(g: f64, slack: f64, at_low: bool, at_high: bool) -> f64 {
    if at_low && at_high {
        0.0
    } else if at_low {
        (slack - g).max(0.0)
    } else if at_high {
        (slack + g).max(0.0)
    } else {
        g.abs() + slack
    }
}
