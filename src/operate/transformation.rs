//! Affine and projective maps of shapes: exact on poles and weights.
//!
//! A projective map `(x, y, z, 1) -> (x', y', z', w')` of a NURBS shape is a NURBS shape over the same knots:
//!
//! ```text
//!   w_i' = w_i (m_3 . (P_i, 1)),     P_i' = (m_0..2 . (P_i, 1)) / (m_3 . (P_i, 1))
//! ```
//!
//! Limit: every pole has to lie on the side of the vanishing plane where `m_3 . (P, 1)` is positive (or every one on the other).
//! Where only poles leave it, not the shape, refine it first.

use super::Surface;
use super::reparametrisation::{rational, rational_surface};
use crate::curve::Curve;
use crate::curve::insertion::Weighted;
use crate::error::Error;

impl Curve {
    /// The curve of the points `matrix * (x, y, z, 1)`; rows of the matrix are `[a, b, c, t]`. Exact, also for singular matrices.
    ///
    /// # Errors
    /// A matrix or poles that are not finite or beyond 1e100.
    pub fn affine(&self, matrix: &[[f64; 4]; 3]) -> Result<Self, Error> {
        let poles = moved(self.poles(), matrix)?;
        Self::new(self.knots().values(), self.degree(), &poles, self.weights())
    }

    /// The curve of the points `(x', y', z') / w'` with `(x', y', z', w') = matrix * (x, y, z, 1)`. Exact.
    ///
    /// # Errors
    /// A matrix that is not finite; poles on both sides of the vanishing plane, by index; weights beyond 1e-100 .. 1e100.
    pub fn projective(&self, matrix: &[[f64; 4]; 4]) -> Result<Self, Error> {
        rational(self.knots().clone(), &projected(&self.strand()?, matrix)?)
    }
}

impl Surface {
    /// The surface of the points `matrix * (x, y, z, 1)`, as [`Curve::affine`].
    ///
    /// # Errors
    /// As for curves.
    pub fn affine(&self, matrix: &[[f64; 4]; 3]) -> Result<Self, Error> {
        let poles = moved(self.poles(), matrix)?;
        let (u, v) = (self.knots_u(), self.knots_v());
        Self::new(
            u.values(),
            v.values(),
            u.degree(),
            v.degree(),
            &poles,
            u.pole_count(),
            v.pole_count(),
            self.weights(),
        )
    }

    /// The surface of the points `(x', y', z') / w'`, as [`Curve::projective`].
    ///
    /// # Errors
    /// As for curves.
    pub fn projective(&self, matrix: &[[f64; 4]; 4]) -> Result<Self, Error> {
        let net = projected(&self.rows()?, matrix)?;
        rational_surface(self.knots_u(), self.knots_v(), &net)
    }
}

fn row(row: &[f64; 4], [x, y, z]: [f64; 3]) -> f64 {
    row[0] * x + row[1] * y + row[2] * z + row[3]
}

fn check(matrix: &[[f64; 4]]) -> Result<(), Error> {
    for (i, row) in matrix.iter().enumerate() {
        if let Some(k) = row.iter().position(|x| !x.is_finite()) {
            return Err(Error::InvalidArgument(format!("matrix: entry ({i}, {k}) is not finite")));
        }
    }
    Ok(())
}

fn moved(poles: &[[f64; 3]], matrix: &[[f64; 4]; 3]) -> Result<Vec<[f64; 3]>, Error> {
    check(matrix)?;
    Ok(poles.iter().map(|&pole| [0, 1, 2].map(|axis| row(&matrix[axis], pole))).collect())
}

fn projected(net: &[Weighted], matrix: &[[f64; 4]; 4]) -> Result<Vec<Weighted>, Error> {
    check(matrix)?;
    let depth = |point: &Weighted| row(&matrix[3], point.pole);
    let sign = depth(&net[0]).signum();
    if let Some(i) = net.iter().position(|point| sign * depth(point) <= 0.0) {
        let text =
            format!("matrix: pole {i} is not on the same side of the vanishing plane as pole 0");
        return Err(Error::Unsupported(text));
    }
    let map = |point: &Weighted| {
        let w = depth(point);
        let pole = [0, 1, 2].map(|axis| row(&matrix[axis], point.pole) / w);
        Weighted { pole, weight: point.weight * w.abs() }
    };
    Ok(net.iter().map(map).collect())
}
