//! Where a branch has a corner, in space or in one of the domains: there a fit begins anew.
//!
//! ```text
//!   transversal   tangents (x, y, z, u, v, s, t)' a little before and behind a point, by the null vector of the derivatives: exact, so that a
//!                 corner is told from a tight turn
//!   touching      no null vector: tangents of the parabolas through the point and the two before it, or behind it
//! ```

use super::MarchPoint;
use super::system::tangent;
use crate::bounds::{Vector, add, cross, dot, norm, scaled, sub};
use crate::surface::Surface;

/// How far before and behind a point tangents are taken, as a share of the chord.
const ASIDE: f64 = 1e-6;

/// Tangents that differ by more than this make a corner: those that are exact, and those of parabolas.
const EXACT: f64 = 1e-3;
const BY_POINTS: f64 = 0.3;

/// Points nearer than this share of the length are one.
const CLOSE: f64 = 1e-6;

/// A sine of the angle of the normals below this is none.
const PARALLEL: f64 = 1e-6;

/// A tangent of seven coordinates, of length one in space.
type Tangent = [f64; 7];

/// Indices of the points inside a list at which it has a corner.
pub fn corners(a: &Surface, b: &Surface, points: &[MarchPoint]) -> Vec<usize> {
    // Points that are one but for rounding have no direction.
    let apart = |i: usize, k: usize| norm(sub(points[i].point, points[k].point));
    let near = CLOSE * (1..points.len()).map(|i| apart(i, i - 1)).sum::<f64>();
    let mut kept: Vec<usize> = vec![0];
    for i in 1..points.len() {
        if apart(i, kept[kept.len() - 1]) > near {
            kept.push(i);
        }
    }
    let list: Vec<MarchPoint> = kept.iter().map(|&i| points[i]).collect();
    let inside = 1..list.len().saturating_sub(1);
    inside.filter(|&i| is_corner([a, b], &list, i)).map(|i| kept[i]).collect()
}

fn is_corner(surfaces: [&Surface; 2], points: &[MarchPoint], i: usize) -> bool {
    let aside = |to: usize| {
        let (p, q) = (parameters(&points[i]), parameters(&points[to]));
        [0, 1, 2, 3].map(|k| p[k] + ASIDE * (q[k] - p[k]))
    };
    let along = sub(points[i + 1].point, points[i - 1].point);
    let exact = [i - 1, i + 1].map(|to| exact(surfaces, aside(to), along));
    if let [Some(before), Some(behind)] = exact {
        return differs(surfaces, &points[i], before, behind, EXACT);
    }
    let before = by_points(points, i, i.checked_sub(2).map_or([i - 1; 2], |k| [i - 1, k]));
    let two = if i + 2 < points.len() { i + 2 } else { i + 1 };
    let behind = by_points(points, i, [i + 1, two]).map(|x| -x);
    differs(surfaces, &points[i], before, behind, BY_POINTS)
}

fn parameters(p: &MarchPoint) -> [f64; 4] {
    [p.uv[0], p.uv[1], p.st[0], p.st[1]]
}

/// Whether two tangents at a place differ, with parameters as the lengths that they move.
fn differs(surfaces: [&Surface; 2], at: &MarchPoint, x: Tangent, y: Tangent, most: f64) -> bool {
    let mut by = [1.0; 7];
    for (half, surface) in surfaces.iter().enumerate() {
        let [u, v] = if half == 0 { at.uv } else { at.st };
        let mut d = [[0.0; 3]; 3];
        surface.partials(u, v, 1, &mut d);
        (by[3 + 2 * half], by[4 + 2 * half]) = (norm(d[1]), norm(d[2]));
    }
    let square = |x: f64| x * x;
    (0..7).map(|k| square(by[k] * (x[k] - y[k]))).sum::<f64>() > square(most)
}

/// The tangent of a transversal intersection at a place, along `along`.
fn exact([a, b]: [&Surface; 2], at: [f64; 4], along: Vector) -> Option<Tangent> {
    let (mut p, mut q) = ([[0.0; 3]; 3], [[0.0; 3]; 3]);
    a.partials(at[0], at[1], 1, &mut p);
    b.partials(at[2], at[3], 1, &mut q);
    let (n, m) = (cross(p[1], p[2]), cross(q[1], q[2]));
    let sine = norm(cross(n, m)) / (norm(n) * norm(m));
    if sine.is_nan() || sine < PARALLEL {
        return None;
    }
    let t = tangent(&[p[1], p[2], scaled(q[1], -1.0), scaled(q[2], -1.0)]);
    let x = add(scaled(p[1], t[0]), scaled(p[2], t[1]));
    let over = dot(x, along).signum() / norm(x);
    let all = [x[0], x[1], x[2], t[0], t[1], t[2], t[3]].map(|x| x * over);
    all.iter().all(|x| x.is_finite()).then_some(all)
}

/// The tangent at point `i` of the parabola through it and two others on one side, towards point `i`; of the chord where both are one.
fn by_points(points: &[MarchPoint], i: usize, [near, far]: [usize; 2]) -> Tangent {
    let seven = |p: &MarchPoint| -> Tangent {
        let ([x, y, z], [u, v], [s, t]) = (p.point, p.uv, p.st);
        [x, y, z, u, v, s, t]
    };
    let [p, q, r] = [i, near, far].map(|k| seven(&points[k]));
    let length = |x: &Tangent, y: &Tangent| norm([x[0] - y[0], x[1] - y[1], x[2] - y[2]]);
    let (h, k) = (length(&p, &q), length(&q, &r));
    let first: Tangent = std::array::from_fn(|c| (p[c] - q[c]) / h);
    let turn: Tangent = std::array::from_fn(|c| first[c] - (q[c] - r[c]) / k);
    // No parabola through the two nearest and one behind a corner at the second.
    let slope = if k > 0.0 && norm([turn[0], turn[1], turn[2]]) <= BY_POINTS {
        std::array::from_fn(|c| first[c] + turn[c] * h / (h + k))
    } else {
        first
    };
    let size = norm([slope[0], slope[1], slope[2]]);
    slope.map(|x| x / size)
}
