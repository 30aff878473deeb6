//! Three equations in four unknowns: `A(u, v) - B(s, t) = 0`, its columns, and the direction of its solutions.

use super::pieces::Pieces;
use crate::bounds::{Vector, cross, dot, norm, scaled, sub};

/// The three parameters that are not `k`.
pub fn others(k: usize) -> [usize; 3] {
    match k {
        0 => [1, 2, 3],
        1 => [0, 2, 3],
        2 => [0, 1, 3],
        _ => [0, 1, 2],
    }
}

fn det(a: Vector, b: Vector, c: Vector) -> f64 {
    dot(a, cross(b, c))
}

/// The null vector of three equations in four unknowns, by minors: the direction of the curve.
pub fn tangent(columns: &[Vector; 4]) -> [f64; 4] {
    let [a, b, c, d] = *columns;
    [det(b, c, d), -det(a, c, d), det(a, b, d), -det(a, b, c)]
}

/// Rows of the inverse of the matrix with these columns.
pub fn inverse([a, b, c]: [Vector; 3]) -> Option<[Vector; 3]> {
    let rows = [cross(b, c), cross(c, a), cross(a, b)];
    let d = dot(a, rows[0]);
    let size = norm(a) * norm(b) * norm(c);
    (d.abs() > 1e-15 * size).then(|| rows.map(|r| scaled(r, 1.0 / d)))
}

/// `A - B` and its four columns at unit parameters of two patches.
pub fn system(a: &Pieces, b: &Pieces, patches: [u32; 2], z: [f64; 4]) -> (Vector, [Vector; 4]) {
    let [p, pu, pv] = a.jet(patches[0], [z[0], z[1]]);
    let [q, qs, qt] = b.jet(patches[1], [z[2], z[3]]);
    (sub(p, q), [pu, pv, scaled(qs, -1.0), scaled(qt, -1.0)])
}
