//! How a Bezier part bends: boxes of its second derivatives over its reach, by the part's own parameters, which run over [-1, 1].
//!
//! Polynomial: second differences of the net on the reach. Rational: `A_uv = (P_uv - A_u w_v - A_v w_u - A w_uv) / w`, by ranges.

use crate::bounds::{HALF_ULP, Vector, norm};

/// A homogeneous pole.
pub type Pole = [f64; 4];

/// How far the reach of a part goes beyond it on each side, as a share of its width.
const BEYOND: f64 = 0.25;

/// Half the width of the reach of a part, in half widths of the part.
pub const REACH: f64 = 1.0 + 2.0 * BEYOND;

/// Second derivatives over the reach of a part, by its own parameters: along uu, uv, vv, each in a box.
pub struct Bends {
    /// Middles of the boxes.
    pub middle: [Vector; 3],
    /// Half their sides, with what rounding adds.
    pub spread: [Vector; 3],
    /// Greatest lengths.
    pub size: [f64; 3],
}

/// The bends of a net on the unit square, given around its middle, where the weight is one; the net is changed. `radius`: its size,
/// which rounding goes by. `None` where a weight is not clearly positive.
pub fn bends(net: &mut [Pole], degree: [usize; 2], rational: bool, radius: f64) -> Option<Bends> {
    // The usual degrees are literals, so that loops have fixed lengths.
    match degree {
        [3, 3] => bends_of(net, [3, 3], rational, radius),
        [2, 2] => bends_of(net, [2, 2], rational, radius),
        [1, 1] => bends_of(net, [1, 1], rational, radius),
        _ => bends_of(net, degree, rational, radius),
    }
}

#[inline(always)]
fn bends_of(net: &mut [Pole], degree: [usize; 2], rational: bool, radius: f64) -> Option<Bends> {
    stretch(net, degree);
    let second =
        [differences(net, degree, 0), differences(net, degree, 1), differences(net, degree, 2)];
    let boxes = if rational { quotient(net, degree, second)? } else { second.map(ranges) };
    let [p, q] = degree.map(|p| p as f64);
    let second_order = (p * (p - 1.0)).max(q * (q - 1.0)).max(p * q) / (4.0 * REACH * REACH);
    let units = (24.0 * (p + q) + 12.0) * second_order * if rational { 8.0 } else { 1.0 };
    let growth = 2.1f64.powi((degree[0] + degree[1]) as i32) * units * HALF_ULP * radius;
    let middle = boxes.map(|range| range.map(|[low, high]| 0.5 * (low + high)));
    let spread = boxes.map(|range| range.map(|[low, high]| 0.5 * (high - low) + growth));
    let size = [0, 1, 2].map(|n| norm(middle[n]) + norm(spread[n]));
    size.iter().all(|x| x.is_finite()).then_some(Bends { middle, spread, size })
}

/// Least and greatest value of each coordinate.
type Box4 = [[f64; 2]; 4];

fn ranges([x, y, z, _]: Box4) -> [[f64; 2]; 3] {
    [x, y, z]
}

#[inline(always)]
fn include(all: &mut Box4, p: Pole) {
    for k in 0..4 {
        // Not `min` and `max`: what is not a number may be lost here, sizes are looked at in the end.
        if p[k] < all[k][0] {
            all[k][0] = p[k];
        }
        if p[k] > all[k][1] {
            all[k][1] = p[k];
        }
    }
}

const NOTHING: Box4 = [[f64::INFINITY, f64::NEG_INFINITY]; 4];

/// Box of the derivatives along uu, uv, vv (n = 0, 1, 2) of a net over the reach, by half widths of the part.
#[inline(always)]
fn differences(net: &[Pole], [p, q]: [usize; 2], n: usize) -> Box4 {
    let width = q + 1;
    let per = |n: usize| n as f64 / (2.0 * REACH);
    let (degrees, factor) = match n {
        0 => ([2, 0], per(p) * per(p.saturating_sub(1))),
        1 => ([1, 1], per(p) * per(q)),
        _ => ([0, 2], per(q) * per(q.saturating_sub(1))),
    };
    if p < degrees[0] || q < degrees[1] {
        return [[0.0; 2]; 4];
    }
    let mut all = NOTHING;
    for i in 0..=p - degrees[0] {
        for j in 0..=q - degrees[1] {
            let at = i * width + j;
            let step = if n == 0 { width } else { 1 };
            let d = if n == 1 {
                let (a, b, c, d) = (net[at], net[at + 1], net[at + width], net[at + width + 1]);
                difference(difference(d, c), difference(b, a))
            } else {
                let (a, b, c) = (net[at], net[at + step], net[at + 2 * step]);
                difference(difference(c, b), difference(b, a))
            };
            include(&mut all, d);
        }
    }
    times_all(all, factor)
}

/// Box of the first derivative along a direction.
#[inline(always)]
fn first_differences(net: &[Pole], degree: [usize; 2], direction: usize) -> Box4 {
    let width = degree[1] + 1;
    let step = if direction == 0 { width } else { 1 };
    let factor = degree[direction] as f64 / (2.0 * REACH);
    let mut all = NOTHING;
    for at in 0..net.len() - step {
        if direction == 0 || at % width + 1 < width {
            include(&mut all, difference(net[at + step], net[at]));
        }
    }
    times_all(all, factor)
}

#[inline(always)]
fn difference(a: Pole, b: Pole) -> Pole {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2], a[3] - b[3]]
}

/// By a factor that is not negative.
fn times_all(mut all: Box4, factor: f64) -> Box4 {
    all.iter_mut().flatten().for_each(|x| *x *= factor);
    all
}

type Range = [f64; 2];

fn times(a: Range, b: Range) -> Range {
    let x = [a[0] * b[0], a[0] * b[1], a[1] * b[0], a[1] * b[1]];
    [x[0].min(x[1]).min(x[2].min(x[3])), x[0].max(x[1]).max(x[2].max(x[3]))]
}

fn minus(a: Range, b: Range) -> Range {
    [a[0] - b[1], a[1] - b[0]]
}

/// By a weight, which is positive.
fn over(a: Range, w: Range) -> Range {
    [
        if a[0] < 0.0 { a[0] / w[0] } else { a[0] / w[1] },
        if a[1] > 0.0 { a[1] / w[0] } else { a[1] / w[1] },
    ]
}

/// Second derivatives of numerator over weight: `A_uv = (P_uv - A_u w_v - A_v w_u - A w_uv) / w`. `None` where the weight is not
/// clearly positive.
#[inline(always)]
fn quotient(net: &[Pole], degree: [usize; 2], second: [Box4; 3]) -> Option<[[Range; 3]; 3]> {
    let mut points = NOTHING;
    for q in net {
        if q[3] <= 0.05 {
            return None;
        }
        include(&mut points, [q[0] / q[3], q[1] / q[3], q[2] / q[3], q[3]]);
    }
    let w = points[3];
    let first = [first_differences(net, degree, 0), first_differences(net, degree, 1)];
    let slope = |d: usize, k: usize| over(minus(first[d][k], times(points[k], first[d][3])), w);
    Some([0, 1, 2].map(|n| {
        let (d, e) = [(0, 0), (0, 1), (1, 1)][n];
        [0, 1, 2].map(|k| {
            let rest = minus(second[n][k], times(slope(d, k), first[e][3]));
            let rest = minus(rest, times(slope(e, k), first[d][3]));
            over(minus(rest, times(points[k], second[n][3])), w)
        })
    }))
}

/// Replaces a net on [0, 1]^2 by that on the reach.
#[inline(always)]
fn stretch(net: &mut [Pole], degree: [usize; 2]) {
    let width = degree[1] + 1;
    let (end, start) = (1.0 + BEYOND, -BEYOND / (1.0 + BEYOND));
    for direction in 0..2 {
        let n = degree[direction];
        let lines = if direction == 0 { width } else { degree[0] + 1 };
        for line in 0..lines {
            let at = |k: usize| if direction == 0 { line + k * width } else { line * width + k };
            for level in 1..=n {
                for k in (level..=n).rev() {
                    for c in 0..4 {
                        net[at(k)][c] = (1.0 - end) * net[at(k - 1)][c] + end * net[at(k)][c];
                    }
                }
            }
            for level in 1..=n {
                for k in 0..=n - level {
                    for c in 0..4 {
                        net[at(k)][c] = (1.0 - start) * net[at(k)][c] + start * net[at(k + 1)][c];
                    }
                }
            }
        }
    }
}
