//! What segments and patches share: the frame of a shape, the tensors, the rounding of a piece.

use crate::bezier::{Bidegree, convolve, convolve_square, scale_down_2d, scale_up_2d};
use crate::bounds::{Aabb, HALF_ULP, Vector, add, norm, scaled, sub};
use crate::coefficients::padded;
use crate::error::Error;

/// Most memory that tensors may take for one shape; beyond it, products are formed per query.
pub const MAX_TENSOR_BYTES: usize = 64 << 20;

/// The map from the caller's coordinates to the index's: subtract `center`, multiply by `scale` (a power of two).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// A pole near the middle of the shape's box.
    pub center: Vector,
    /// Power of two that brings the box diagonal into [1, 2).
    pub scale: f64,
    /// Diagonal of the box in the caller's coordinates.
    pub diagonal: f64,
    /// Greatest absolute coordinate of the box in the caller's coordinates.
    pub magnitude: f64,
}

impl Frame {
    /// The frame of a shape with the given poles and pole box.
    pub fn new(poles: &[Vector], bounds: (Vector, Vector)) -> Self {
        let bounds = Aabb { low: bounds.0, high: bounds.1 };
        let diagonal = bounds.diagonal();
        let middle = add(scaled(bounds.low, 0.5), scaled(bounds.high, 0.5));
        let apart = |p: &Vector| norm(sub(*p, middle));
        let center = poles.iter().copied().min_by(|a, b| apart(a).total_cmp(&apart(b)));
        let magnitude = bounds.low.iter().chain(&bounds.high).fold(0.0, |m: f64, x| m.max(x.abs()));
        let scale = power_of_two_over(diagonal);
        Self { center: center.unwrap_or(middle), scale, diagonal, magnitude }
    }

    /// A point of the caller in the index's coordinates. Relative rounding: one half ulp per coordinate.
    pub fn enter(&self, point: Vector) -> Vector {
        scaled(sub(point, self.center), self.scale)
    }
}

/// `2^-e` with `2^e <= x < 2^(e+1)`; one when that cannot be held.
pub fn power_of_two_over(x: f64) -> f64 {
    if !(1e-290..1e290).contains(&x) {
        return 1.0;
    }
    1.0 / f64::from_bits(x.to_bits() & 0x7ff0_0000_0000_0000)
}

/// Rounding of a piece's net, one cut and one evaluation, relative to `|X/W| + |p|`; `degrees` is the summed degree.
///
/// Numerator and weight are rounded apart and both count: extraction and recentring `2 (6 d + 3)`, a cut with both ends
/// `2 x 7 d`, the vector `r` 2; in all `26 d + 8`, rounded up to `28 d + 32` (`docs/rounding.md`).
pub fn position_steps(degrees: usize) -> f64 {
    (28 * degrees + 32) as f64 * HALF_ULP
}

/// How far `r / W` computed in a piece may be from the exact vector: `steps` from [`position_steps`], the piece's
/// radius, |p| in the piece's frame and |q| in the shape's.
///
/// Where the weights are rounded (rational) they multiply the query too. The last term is the rounding of the frame:
/// once for the poles (at most 2 away from the centre), once for the query, once more for each in the piece.
pub fn position_error(steps: f64, rational: bool, radius: f64, p: f64, q: f64) -> f64 {
    let weighted = if rational { radius + p } else { radius };
    steps * weighted + 8.0 * HALF_ULP * (2.0 + p + q)
}

/// Rounding of a product coefficient relative to the sum of its absolute terms, of which there are `terms`.
pub fn product_steps(terms: usize) -> f64 {
    (2 * terms + 24) as f64 * HALF_ULP
}

/// The parameters of a piece and its balance: local parameter x in [0, 1] stands for
/// `u0 + (u1 - u0) a x / (1 - x + a x)`.
///
/// Weights that grow by a factor along a piece crowd its points at one end. The linear fractional map with the
/// `a` that makes the ends' weights alike multiplies homogeneous pole `i` by `a^i`: a power of two, so that the poles
/// keep their bits. Reference: Patterson, *Projective transformations of the parameter of a Bernstein-Bezier
/// curve*, 1985.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Span {
    /// Parameters of the two ends.
    pub ends: [f64; 2],
    /// The factor `a`; 1 but for weights that differ much.
    pub balance: f64,
}

impl Span {
    /// The caller's parameter of a local one; the ends come out exactly.
    pub fn global(&self, x: f64) -> f64 {
        let [u0, u1] = self.ends;
        if x == 0.0 {
            return u0;
        }
        if x == 1.0 {
            return u1;
        }
        let s =
            if self.balance == 1.0 { x } else { self.balance * x / ((1.0 - x) + self.balance * x) };
        (u0 + s * (u1 - u0)).clamp(u0, u1)
    }

    /// Whether a parameter of the caller is inside, apart from the ends.
    pub fn holds(&self, u: f64) -> bool {
        self.ends[0] < u && u < self.ends[1]
    }

    /// The local parameter of the caller's one, moved into [0, 1].
    pub fn local(&self, u: f64) -> f64 {
        self.local_and_rest(u)[0]
    }

    /// The local parameter x and 1 - x, both to a few half ulps of themselves: each is formed from the distance to its
    /// own end, so that neither loses digits to the other under a strong balance.
    fn local_and_rest(&self, u: f64) -> [f64; 2] {
        let [u0, u1] = self.ends;
        if u <= u0 {
            return [0.0, 1.0];
        }
        if u >= u1 {
            return [1.0, 0.0];
        }
        let (s, r) = ((u - u0) / (u1 - u0), (u1 - u) / (u1 - u0));
        if self.balance == 1.0 {
            return [s, r];
        }
        let sum = self.balance * r + s;
        [s / sum, self.balance * r / sum]
    }
}

impl Span {
    /// The least local interval that holds the part of `[low, high]` inside the piece, rounding included. Empty
    /// (`[x, x]`) when nothing is inside.
    ///
    /// Six roundings of relative size 2^-53 lie on the way to x and to 1 - x; eight are allowed, outward.
    pub fn cover(&self, [low, high]: [f64; 2]) -> [f64; 2] {
        if high <= self.ends[0] || low >= self.ends[1] {
            return [self.local(low); 2];
        }
        if low <= self.ends[0] && high >= self.ends[1] {
            return [0.0, 1.0];
        }
        let margin = 8.0 * HALF_ULP;
        // The nearer end decides: below one half x itself is the sharper number, above it its rest.
        let moved = |[x, rest]: [f64; 2], outward: f64| {
            if x < 0.5 { x * (1.0 + outward) } else { 1.0 - rest * (1.0 - outward) }
        };
        let least = moved(self.local_and_rest(low), -margin);
        let most = moved(self.local_and_rest(high), margin);
        [least.next_down().max(0.0), most.next_up().min(1.0)]
    }
}

/// Weights that differ by less than this factor within a piece are left as they are: halving in the search copes.
const CALM: f64 = 64.0;

/// Into how many equal parts a span is cut before the search, for weights that differ by `ratio` along it.
///
/// Coefficients of products of weights far apart say little about the shape between them; parts, balanced, do.
pub fn parts_for(ratio: f64) -> usize {
    if ratio <= CALM { 1 } else { 8 }
}

/// The power of two that balances weights whose ends differ by `ratio` (last over first) in degree `degree`.
///
/// The nearest one: weights of 1 and 0.98 are balanced as they are.
pub fn balance_for(ratio: f64, degree: usize) -> f64 {
    let exponent = |x: f64| ((x.to_bits() >> 52) & 0x7ff) as i64 - 1023;
    let steps = exponent(ratio * std::f64::consts::SQRT_2).clamp(-600, 600);
    let each = (steps.abs() + degree as i64 / 2) / degree as i64;
    let each = (each.min(900 / degree as i64) as i32) * steps.signum() as i32;
    // The map's factor undoes the growth.
    2.0f64.powi(-each)
}

/// The B-spline poles that shape one piece, recentred and weighted, component by component.
pub struct LocalNet {
    /// x, y, z and, when rational, w.
    pub components: [Vec<f64>; 4],
    /// The recentring, in the index's coordinates.
    pub center: Vector,
    /// Greatest Euclidean pole distance from `center`.
    pub radius: f64,
}

impl LocalNet {
    /// Recentres on the pole in the middle and scales the greatest weight into [1, 2).
    pub fn new(poles: &[(Vector, f64)]) -> Self {
        let center = poles[poles.len() / 2].0;
        let factor = power_of_two_over(poles.iter().fold(0.0, |m: f64, p| m.max(p.1)));
        let mut net = Self { components: Default::default(), center, radius: 0.0 };
        for &(pole, weight) in poles {
            let (x, w) = (sub(pole, center), weight * factor);
            net.radius = net.radius.max(norm(x));
            for c in 0..3 {
                net.components[c].push(w * x[c]);
            }
            net.components[3].push(w);
        }
        net
    }
}

/// Number of values in the tensors of one piece.
pub fn tensor_len(degree: Bidegree, rational: bool) -> usize {
    padded(degree.times(degree).count()) * if rational { 5 } else { 4 }
}

/// Appends the tensors A, -2 B (three) and, when rational, C of a net (component by component) to `out`, each [`padded`].
pub fn push_tensors(net: &[f64], degree: Bidegree, rational: bool, out: &mut Vec<f64>) {
    let (count, twice) = (degree.count(), degree.times(degree));
    let mut scaled_net = net.to_vec();
    if !rational {
        scaled_net.resize(4 * count, 1.0);
    }
    for component in scaled_net.chunks_exact_mut(count) {
        scale_up_2d(component, degree);
    }
    let start = out.len();
    out.resize(start + tensor_len(degree, rational), 0.0);
    let weights = &scaled_net[3 * count..];
    for (k, tensor) in out[start..].chunks_exact_mut(padded(twice.count())).enumerate() {
        let tensor = &mut tensor[..twice.count()];
        match k {
            0 => (0..3).for_each(|c| {
                convolve_square(&scaled_net[c * count..(c + 1) * count], degree, 1.0, tensor);
            }),
            4 => convolve_square(weights, degree, 1.0, tensor),
            _ => {
                let component = &scaled_net[(k - 1) * count..k * count];
                convolve(component, degree, weights, degree, -2.0, tensor);
            }
        }
        scale_down_2d(tensor, twice);
    }
}

/// An empty list with room for `count` values.
///
/// # Errors
/// [`Error::OutOfMemory`].
pub fn reserved<T>(count: usize) -> Result<Vec<T>, Error> {
    let mut list = Vec::new();
    list.try_reserve_exact(count).map_err(|_| Error::OutOfMemory)?;
    Ok(list)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_scale_is_a_power_of_two_and_brings_the_diagonal_to_one() {
        for x in [1e-9, 0.3, 1.0, 1.5, 7e8, 1e99] {
            let s = power_of_two_over(x);
            assert!((1.0..2.0).contains(&(x * s)), "{x}");
            assert_eq!(s.to_bits() & 0x000f_ffff_ffff_ffff, 0);
        }
        assert_eq!(power_of_two_over(0.0), 1.0);
    }

    #[test]
    fn weights_are_balanced_by_the_nearest_power_of_two() {
        for degree in 1..=5 {
            for ratio in [1.0, 0.98, 1.02, 0.75, 1.3] {
                assert_eq!(balance_for(ratio, degree), 1.0, "{ratio} {degree}");
            }
            for steps in [-6, -1, 1, 8] {
                let ratio = 2.0f64.powi(steps * degree as i32);
                for near in [0.9 * ratio, ratio, 1.1 * ratio] {
                    assert_eq!(balance_for(near, degree), 2.0f64.powi(-steps), "{near} {degree}");
                }
            }
        }
    }

    #[test]
    fn tensors_of_a_segment_give_the_squared_distance() {
        let degree = Bidegree { s: 0, t: 1 };
        let net = [0.0, 2.0, 1.0, 1.0, 0.0, 0.0];
        let mut out = Vec::new();
        push_tensors(&net, degree, false, &mut out);
        // |(2t, 1, 0)|^2 = 4 t^2 + 1: Bernstein 1, 1, 5. -2 x: 0, -2, -4.
        assert_eq!(out[..3], [1.0, 1.0, 5.0]);
        let next = padded(3);
        assert_eq!(out[next..next + 3], [0.0, -2.0, -4.0]);
    }
}
