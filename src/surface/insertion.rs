//! Knot insertion and splitting of surfaces: every row, or every column, is a strand of a curve.

use super::Surface;
use crate::curve::insertion::{Weighted, insert, split, transposed, unweighted, weighted};
use crate::error::Error;
use crate::knots::Knots;

impl Surface {
    /// The same surface with `u` as a knot `times` more times in the first direction. The ends of
    /// the domain may be inserted too, up to `degree + 1` of them; other knots up to `degree`.
    ///
    /// # Errors
    /// `u` is outside the domain, or repeated too often; memory that could not be had.
    pub fn insert_knot_u(&self, u: f64, times: usize) -> Result<Self, Error> {
        let (knots, points) = insert(&self.knots_u, "u", u, times, self.columns()?)?;
        self.like_columns(knots, &points)
    }

    /// The same surface with `v` as a knot `times` more times in the second direction. The ends of
    /// the domain may be inserted too, up to `degree + 1` of them; other knots up to `degree`.
    ///
    /// # Errors
    /// `v` is outside the domain, or repeated too often; memory that could not be had.
    pub fn insert_knot_v(&self, v: f64, times: usize) -> Result<Self, Error> {
        let (knots, points) = insert(&self.knots_v, "v", v, times, self.rows()?)?;
        self.like(self.knots_u.clone(), knots, &points)
    }

    /// The parts of the surface before and behind `u`.
    ///
    /// # Errors
    /// `u` is not inside the domain; memory that could not be had.
    pub fn split_u(&self, u: f64) -> Result<(Self, Self), Error> {
        let [(left, before), (right, behind)] = split(&self.knots_u, "u", u, self.columns()?)?;
        Ok((self.like_columns(left, &before)?, self.like_columns(right, &behind)?))
    }

    /// The parts of the surface before and behind `v`.
    ///
    /// # Errors
    /// `v` is not inside the domain; memory that could not be had.
    pub fn split_v(&self, v: f64) -> Result<(Self, Self), Error> {
        let [(left, before), (right, behind)] = split(&self.knots_v, "v", v, self.rows()?)?;
        Ok((
            self.like(self.knots_u.clone(), left, &before)?,
            self.like(self.knots_u.clone(), right, &behind)?,
        ))
    }

    /// The net with v running fastest, as it is stored.
    pub(crate) fn rows(&self) -> Result<Vec<Weighted>, Error> {
        weighted(&self.poles, self.weights.as_deref())
    }

    /// The net with u running fastest.
    pub(crate) fn columns(&self) -> Result<Vec<Weighted>, Error> {
        transposed(&self.rows()?, self.knots_v.pole_count())
    }

    /// A surface with other knots in the first direction; `points` with u running fastest.
    pub(crate) fn like_columns(&self, knots_u: Knots, points: &[Weighted]) -> Result<Self, Error> {
        let rows = transposed(points, knots_u.pole_count())?;
        self.like(knots_u, self.knots_v.clone(), &rows)
    }

    /// A surface with other knots and poles; weights only if this one has them.
    pub(crate) fn like(
        &self,
        knots_u: Knots,
        knots_v: Knots,
        rows: &[Weighted],
    ) -> Result<Self, Error> {
        let (poles, weights) = unweighted(rows, self.weights.as_deref(), self.rational)?;
        Ok(Self::from_parts(knots_u, knots_v, poles, weights))
    }
}
