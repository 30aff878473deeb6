//! Where a member stands: a rotation and a translation.
//!
//! ```text
//!   place   x -> R x + t           q -> R^T (q - t)   enter
//! ```
//!
//! A rotation in doubles is orthogonal up to rounding only. The placed shape is *defined* with the stored numbers, as
//! `{ R x + t }` in exact arithmetic; how far `R^T` is from the inverse of `R` is measured once (`defect`, a bound of
//! `|R^T R - 1|`) and taken off every bound. `docs/rounding.md`, section 17, has the counts.
//!
//! Reference: Higham, *Computing the polar decomposition with applications*, 1986 (the iteration that makes a matrix
//! orthogonal).

use crate::bounds::{HALF_ULP, Vector, dot, norm, sub};
use crate::closest::GREATEST_COORDINATE;

/// Greatest entry of `R^T R - 1` of a matrix that is taken for a rotation: files print nine digits and more.
pub const RIGID_TOLERANCE: f64 = 1e-9;

/// Below this the entries of `R^T R - 1` are rounding, and the matrix is kept bit for bit.
const ROUNDED: f64 = 16.0 * HALF_ULP;

/// Steps of the iteration at most; the first one leaves the square of the tolerance.
const POLISHING: usize = 4;

type Matrix = [Vector; 3];

const UNIT: Matrix = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// A rotation followed by a translation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placement {
    rows: Matrix,
    shift: Vector,
    is_identity: bool,
    defect: f64,
}

impl Placement {
    /// Where the shape is as it is.
    pub const IDENTITY: Self = Self { rows: UNIT, shift: [0.0; 3], is_identity: true, defect: 0.0 };

    /// From three rows of rotation and translation. The nearest rotation is taken.
    ///
    /// # Errors
    /// A text that names the number or says that the matrix is not rigid.
    pub fn new(given: [[f64; 4]; 3]) -> Result<Self, String> {
        for (i, x) in given.as_flattened().iter().enumerate() {
            if !x.is_finite() {
                return Err(format!("placement[{i}] is not finite"));
            }
            if x.abs() > GREATEST_COORDINATE {
                return Err(format!("placement[{i}] is beyond 1e100"));
            }
        }
        let rows = rotation(given.map(|[x, y, z, _]| [x, y, z]))?;
        let shift = given.map(|row| row[3]);
        let is_identity = rows == UNIT && shift == [0.0; 3];
        Ok(Self { rows, shift, is_identity, defect: defect(&rows) })
    }

    /// Three rows of rotation and translation, as they are used.
    pub fn matrix(&self) -> [[f64; 4]; 3] {
        let row = |k: usize| [self.rows[k][0], self.rows[k][1], self.rows[k][2], self.shift[k]];
        [row(0), row(1), row(2)]
    }

    /// Whether points keep their bits.
    pub fn is_identity(&self) -> bool {
        self.is_identity
    }

    /// The place of a point of the shape: always these operations in this order.
    pub fn place(&self, point: Vector) -> Vector {
        if self.is_identity {
            return point;
        }
        let turned = self.turn(point);
        [0, 1, 2].map(|k| turned[k] + self.shift[k])
    }

    /// A direction or derivative of the shape, turned with it.
    pub fn turn(&self, direction: Vector) -> Vector {
        if self.is_identity { direction } else { self.rows.map(|row| dot(row, direction)) }
    }

    /// A direction in space, seen from the shape.
    pub fn turn_back(&self, direction: Vector) -> Vector {
        if self.is_identity {
            return direction;
        }
        let [a, b, c] = self.rows;
        [0, 1, 2].map(|k| (a[k] * direction[0] + b[k] * direction[1]) + c[k] * direction[2])
    }

    /// A point in space, seen from the shape.
    pub fn enter(&self, query: Vector) -> Vector {
        if self.is_identity { query } else { self.turn_back(sub(query, self.shift)) }
    }

    /// How far [`Self::enter`] may be from the exact inverse: 6.3 half ulps of `|q - t|` from its operations, and what
    /// the transpose is off.
    pub fn offset(&self, query: Vector) -> f64 {
        if self.is_identity {
            return 0.0;
        }
        (8.0 * HALF_ULP + 1.5 * self.defect) * norm(sub(query, self.shift))
    }

    /// What is proven in space when nothing on the shape is nearer than `bound` to the entered query, which may be
    /// `offset` off: the placement shortens by a factor `1 - defect` at most; 4 half ulps are for these operations.
    pub fn bound(&self, bound: f64, offset: f64) -> f64 {
        if self.is_identity {
            return bound;
        }
        ((bound - offset) * (1.0 - (2.0 * self.defect + 4.0 * HALF_ULP))).max(0.0)
    }

    /// How far a coordinate that [`Self::place`] computes may be off, for points whose coordinates are at most
    /// `greatest`: a sum of three products and a translation, 4 half ulps of `sqrt(3) greatest + |t|`.
    pub fn rounding(&self, greatest: f64) -> f64 {
        let shift = self.shift.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
        if self.is_identity { 0.0 } else { 8.0 * HALF_ULP * (greatest + shift) }
    }
}

/// `R^T R - 1`.
fn gram(rows: &Matrix) -> Matrix {
    let entry = |i: usize, j: usize| {
        let product = (rows[0][i] * rows[0][j] + rows[1][i] * rows[1][j]) + rows[2][i] * rows[2][j];
        product - UNIT[i][j]
    };
    [0, 1, 2].map(|i| [0, 1, 2].map(|j| entry(i, j)))
}

fn greatest(matrix: &Matrix) -> f64 {
    // Not `max`, which would lose a NaN.
    matrix.as_flattened().iter().fold(0.0, |m: f64, x| if x.abs() <= m { m } else { x.abs() })
}

/// The nearest rotation: `R <- R (3 - R^T R) / 2` until only rounding is left.
fn rotation(mut rows: Matrix) -> Result<Matrix, String> {
    let off = greatest(&gram(&rows));
    if off.is_nan() || off > RIGID_TOLERANCE {
        return Err(format!(
            "placement is not rigid: R^T R differs from the identity by {off:.1e}, more than 1e-9"
        ));
    }
    let [a, b, c] = rows;
    if dot(a, crate::bounds::cross(b, c)) < 0.0 {
        return Err("placement mirrors: its determinant is -1".into());
    }
    for _ in 0..POLISHING {
        let gram = gram(&rows);
        if greatest(&gram) <= ROUNDED {
            break;
        }
        rows = rows.map(|row| {
            [0, 1, 2].map(|j| {
                row[j] - 0.5 * ((row[0] * gram[0][j] + row[1] * gram[1][j]) + row[2] * gram[2][j])
            })
        });
    }
    Ok(rows)
}

/// A bound of `|R^T R - 1|`: the Frobenius norm of what is computed, and of its rounding, 3 units for each of nine
/// entries. Turns by right angles are exact.
fn defect(rows: &Matrix) -> f64 {
    if rows.as_flattened().iter().all(|x| *x == 0.0 || x.abs() == 1.0) {
        return 0.0;
    }
    let [a, b, c] = gram(rows);
    (dot(a, a) + dot(b, b) + dot(c, c)).sqrt() * (1.0 + 8.0 * HALF_ULP) + 12.0 * HALF_ULP
}

#[cfg(test)]
mod tests {
    use super::*;

    fn turned(angle: f64, shift: Vector) -> [[f64; 4]; 3] {
        let (s, c) = angle.sin_cos();
        [[c, -s, 0.0, shift[0]], [s, c, 0.0, shift[1]], [0.0, 0.0, 1.0, shift[2]]]
    }

    #[test]
    fn a_rotation_up_to_rounding_is_kept_bit_for_bit_and_a_rough_one_is_polished() {
        for k in 0..100 {
            let given = turned(0.1 * f64::from(k), [1.0, -2.0, 3e5]);
            assert_eq!(Placement::new(given).unwrap().matrix(), given);
            let mut rough = given;
            rough[0][0] += 4e-10;
            rough[2][1] -= 3e-10;
            let placement = Placement::new(rough).unwrap();
            assert!(placement.defect < 64.0 * HALF_ULP);
            for (x, y) in rough.as_flattened().iter().zip(placement.matrix().as_flattened()) {
                assert!((x - y).abs() < 1e-9);
            }
            assert_eq!(Placement::new(placement.matrix()).unwrap(), placement);
        }
    }

    #[test]
    fn what_is_not_rigid_is_refused_with_its_reason() {
        let refused = |change: fn(&mut [[f64; 4]; 3])| {
            let mut given = turned(0.3, [1.0; 3]);
            change(&mut given);
            Placement::new(given).unwrap_err()
        };
        assert_eq!(refused(|m| m[1][3] = f64::NAN), "placement[7] is not finite");
        assert_eq!(refused(|m| m[0][3] = -1e101), "placement[3] is beyond 1e100");
        assert!(refused(|m| m[0][0] *= 1.0 + 1e-8).contains("not rigid"));
        assert!(refused(|m| *m = [[0.0; 4]; 3]).contains("not rigid"));
        assert!(refused(|m| m[2] = [1e90; 4]).contains("not rigid"));
        assert!(refused(|m| m[2] = m[2].map(|x| -x)).contains("mirrors"));
    }

    #[test]
    fn a_point_placed_and_entered_comes_back_within_the_offset() {
        for k in 0..200 {
            let angle = 0.37 * f64::from(k);
            let placement = Placement::new(turned(angle, [1e3, -7.0, angle])).unwrap();
            let point = [angle.cos(), 3.0 * angle, 1.0 / (1.0 + angle)];
            let there = placement.place(point);
            let back = placement.enter(there);
            let most = placement.offset(there) + 4.0 * placement.rounding(600.0);
            assert!(norm(sub(back, point)) <= most, "{k}");
        }
        let quarter = Placement::new([[0., -1., 0., 0.], [1., 0., 0., 0.], [0., 0., 1., 0.]]);
        assert_eq!(quarter.unwrap().defect, 0.0);
        let same = Placement::new([[1., 0., 0., 0.], [0., 1., 0., 0.], [0., 0., 1., 0.]]).unwrap();
        assert!(same.is_identity() && same.place([-0.0; 3])[0].is_sign_negative());
    }
}
