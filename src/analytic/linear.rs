//! Small dense systems: what a fit needs, and no more.
//!
//! Nothing here is proven; a bad solution is a bad fit, which the deviation shows.

use crate::bounds::{Vector, cross, dot, norm, scaled, sub};

/// Share of the trace added to the diagonal: what a few points leave undetermined (a cylinder moves along its axis)
/// then stays where it is.
const SHIFT: f64 = 1e-14;

/// The solution of `m x = b` for a symmetric matrix without negative eigenvalues, its diagonal enlarged by [`SHIFT`].
pub fn solved<const N: usize>(m: &[[f64; N]; N], b: [f64; N]) -> Option<[f64; N]> {
    let shift = SHIFT * (0..N).map(|k| m[k][k]).sum::<f64>();
    // Cholesky, row by row.
    let mut l = [[0.0; N]; N];
    for i in 0..N {
        for j in 0..=i {
            let rest: f64 = (0..j).map(|k| l[i][k] * l[j][k]).sum();
            if i == j {
                let d = m[i][i] + shift - rest;
                if d.is_nan() || d <= 0.0 {
                    return None;
                }
                l[i][i] = d.sqrt();
            } else {
                l[i][j] = (m[i][j] - rest) / l[j][j];
            }
        }
    }
    let mut x = b;
    for i in 0..N {
        let rest: f64 = (0..i).map(|k| l[i][k] * x[k]).sum();
        x[i] = (x[i] - rest) / l[i][i];
    }
    for i in (0..N).rev() {
        let rest: f64 = (i + 1..N).map(|k| l[k][i] * x[k]).sum();
        x[i] = (x[i] - rest) / l[i][i];
    }
    x.iter().all(|x| x.is_finite()).then_some(x)
}

/// Adds `row row^T` to a matrix.
pub fn add_square<const N: usize>(m: &mut [[f64; N]; N], row: &[f64; N]) {
    for i in 0..N {
        for j in 0..N {
            m[i][j] += row[i] * row[j];
        }
    }
}

/// Steps of the inverse iteration: with the shift, each gains many digits where the least eigenvalue stands apart.
const INVERSE_STEPS: usize = 6;

/// A vector of length 1 near the eigenvector of the least eigenvalue.
pub fn least_direction<const N: usize>(m: &[[f64; N]; N]) -> Option<[f64; N]> {
    // Any start will do that is not perpendicular to the answer.
    let mut x: [f64; N] = std::array::from_fn(|k| 1.0 - 0.13 * k as f64);
    for _ in 0..INVERSE_STEPS {
        x = solved(m, x)?;
        let size = x.iter().map(|x| x * x).sum::<f64>().sqrt();
        x = x.map(|x| x / size);
    }
    x.iter().all(|x| x.is_finite()).then_some(x)
}

/// The least squares solution of `rows x = values`.
pub fn fitted<const N: usize>(rows: impl Iterator<Item = ([f64; N], f64)>) -> Option<[f64; N]> {
    let (mut m, mut b) = ([[0.0; N]; N], [0.0; N]);
    for (row, value) in rows {
        add_square(&mut m, &row);
        (0..N).for_each(|k| b[k] += row[k] * value);
    }
    solved(&m, b)
}

/// `a` with length 1.
pub fn unit(a: Vector) -> Vector {
    scaled(a, 1.0 / norm(a))
}

/// Three perpendicular vectors of length 1, the third along `axis`, the first as near to `first` as that allows. Each is
/// within 8 half ulps of an exact frame.
pub fn frame(axis: Vector, first: Vector) -> [Vector; 3] {
    let a = unit(axis);
    let across = |x: Vector| unit(sub(x, scaled(a, dot(x, a))));
    // The second time takes off what rounding left of the first.
    let e = across(across(first));
    [e, cross(a, e), a]
}

/// Three perpendicular vectors, the third along `axis`.
pub fn any_frame(axis: Vector) -> [Vector; 3] {
    let [x, y, z] = axis.map(f64::abs);
    let first = if x <= y && x <= z {
        [1.0, 0.0, 0.0]
    } else if y <= z {
        [0.0, 1.0, 0.0]
    } else {
        [0.0, 0.0, 1.0]
    };
    frame(axis, first)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_least_direction_of_a_flat_cloud_is_its_normal() {
        let n = unit([1.0, 2.0, -0.5]);
        let [e, f, _] = any_frame(n);
        let mut m = [[0.0; 3]; 3];
        for k in 0..7 {
            let (x, y) = (k as f64 - 3.0, (k * k % 5) as f64 - 1.0);
            add_square(&mut m, &[0, 1, 2].map(|c| x * e[c] + y * f[c]));
        }
        let found = least_direction(&m).unwrap();
        assert!(norm(cross(found, n)) < 1e-7, "{found:?}");
    }

    #[test]
    fn frames_are_perpendicular() {
        for axis in [[1e-3, 0.2, 9.0], [0.0, 0.0, -2.0], [1.0, 1.0, 1.0]] {
            let f = any_frame(axis);
            for i in 0..3 {
                for j in 0..3 {
                    let expected = if i == j { 1.0 } else { 0.0 };
                    assert!((dot(f[i], f[j]) - expected).abs() < 1e-15);
                }
            }
            assert!(dot(f[2], axis) > 0.0 && dot(cross(f[0], f[1]), f[2]) > 0.9);
        }
    }

    #[test]
    fn a_system_that_leaves_one_direction_open_is_solved_in_the_others() {
        let m = [[2.0, 0.0], [0.0, 0.0]];
        let x = solved(&m, [4.0, 0.0]).unwrap();
        assert!((x[0] - 2.0).abs() < 1e-12 && x[1] == 0.0);
    }
}
