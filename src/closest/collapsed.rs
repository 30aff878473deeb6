//! Collapsed sides: the derivative of the distance along them, with the zero that every such shape has there left out.
//!
//! On the collapsed side `X = W P`, so the squared distance `f = N / C` does not depend on the parameter along it.
//! The sign of that derivative elsewhere is that of
//!
//! ```text
//!   W^3 f_s = W N_s - 2 N W_s          (polynomial: N_s)
//! ```
//!
//! whose Bernstein coefficients on the side vanish; if all others keep one sign, the distance changes strictly along
//! the side everywhere off it.

use crate::bezier::{Bidegree, convolve, scale_down_2d, scale_up_2d};
use crate::index::side;

/// The direction along side `k`: 0 for s, 1 for t.
pub fn along(k: usize) -> usize {
    usize::from(k < side::T0)
}

/// Extent of the coefficients of N_s off side `k`.
pub fn slope_extent(n: &[f64], degree: Bidegree, k: usize, memory: &mut Vec<f64>) -> (f64, f64) {
    memory.clear();
    derivative(n, degree, along(k), memory);
    extent_off_side(memory, lowered(degree, along(k)), k)
}

/// Extent of the coefficients of `W N_s - 2 N W_s` off side `k`; `w` has the bidegree `net`, `n` twice that.
pub fn rational_slope_extent(
    n: &[f64],
    w: &[f64],
    net: Bidegree,
    k: usize,
    memory: &mut Vec<f64>,
) -> (f64, f64) {
    let (degree, direction) = (net.times(net), along(k));
    let (slope_degree, net_slope_degree) = (lowered(degree, direction), lowered(net, direction));
    let total = slope_degree.times(net);
    memory.clear();
    memory.resize(total.count(), 0.0);
    derivative(n, degree, direction, memory);
    derivative(w, net, direction, memory);
    memory.extend_from_slice(n);
    memory.extend_from_slice(w);
    let (product, rest) = memory.split_at_mut(total.count());
    let (slope_n, rest) = rest.split_at_mut(slope_degree.count());
    let (slope_w, rest) = rest.split_at_mut(net_slope_degree.count());
    let (n, w) = rest.split_at_mut(degree.count());
    scale_up_2d(slope_n, slope_degree);
    scale_up_2d(slope_w, net_slope_degree);
    scale_up_2d(n, degree);
    scale_up_2d(w, net);
    convolve(slope_n, slope_degree, w, net, 1.0, product);
    convolve(n, degree, slope_w, net_slope_degree, -2.0, product);
    scale_down_2d(product, total);
    extent_off_side(product, total, k)
}

fn lowered(degree: Bidegree, direction: usize) -> Bidegree {
    if direction == 0 {
        Bidegree { s: degree.s - 1, ..degree }
    } else {
        Bidegree { t: degree.t - 1, ..degree }
    }
}

/// Appends the Bernstein coefficients of a partial derivative to `out`.
fn derivative(f: &[f64], degree: Bidegree, direction: usize, out: &mut Vec<f64>) {
    let width = degree.t + 1;
    if direction == 0 {
        out.extend(f.iter().zip(&f[width..]).map(|(a, b)| degree.s as f64 * (b - a)));
        return;
    }
    for row in f.chunks_exact(width) {
        out.extend(row.windows(2).map(|pair| degree.t as f64 * (pair[1] - pair[0])));
    }
}

/// Least and greatest coefficient that does not belong to side `k`.
fn extent_off_side(f: &[f64], degree: Bidegree, k: usize) -> (f64, f64) {
    let width = degree.t + 1;
    let on_side = |i: usize, j: usize| [i == 0, i == degree.s, j == 0, j == degree.t][k];
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    for (index, &x) in f.iter().enumerate() {
        if !on_side(index / width, index % width) {
            (low, high) = (low.min(x), high.max(x));
        }
    }
    (low, high)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_distance_turns_around_a_cone_and_the_collapsed_row_is_left_out() {
        // Apex at t = 0, base a segment of degree 1 from (1,0) to (0,1): N for the query (3, 0).
        let net = Bidegree { s: 1, t: 1 };
        let (x, y): ([f64; 4], [f64; 4]) = ([-3.0, -2.0, -3.0, -3.0], [0.0, 0.0, 0.0, 1.0]);
        let degree = net.times(net);
        let mut n = vec![0.0; degree.count()];
        for f in [x, y] {
            let mut scaled = f;
            scale_up_2d(&mut scaled, net);
            convolve(&scaled, net, &scaled, net, 1.0, &mut n);
        }
        scale_down_2d(&mut n, degree);
        let mut memory = Vec::new();
        let (low, _) = slope_extent(&n, degree, side::T0, &mut memory);
        assert!(low > 0.0);
        let (low, _) = rational_slope_extent(&n, &[1.0; 4], net, side::T0, &mut memory);
        assert!(low > 0.0);
    }
}
