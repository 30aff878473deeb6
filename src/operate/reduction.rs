//! Degree reduction: the nearest spline of the next lower degree, and how near is proven.
//!
//! Every knot loses one copy but keeps one. The old shape is refined to where the elevated new one can lie (inner knots at least twice), and
//! the poles are those whose elevated form is nearest by least squares, with both ends kept. Where the
//! shape is of the lower degree the result is exact up to rounding. Rational shapes are reduced in homogeneous form; the error is
//! Euclidean, by the hull of the difference.

use super::least_squares::nearest;
use super::map::{Map, raised_knots};
use super::{Bounded, Direction, Surface};
use crate::curve::Curve;
use crate::curve::insertion::{Weighted, checked};
use crate::error::Error;
use crate::knots::Knots;

impl Curve {
    /// The clamped curve of a degree lower by one that is nearest, and the proven error. Take it again for more degrees.
    ///
    /// # Errors
    /// Degree 1; weights that would not stay positive; memory that could not be had.
    pub fn reduce(&self) -> Result<Bounded<Self>, Error> {
        let clamped = self.clamp()?;
        let (knots, strand) = lower(clamped.knots(), "", clamped.strand()?)?;
        let shape = clamped.like(knots, &strand)?;
        let error = self.difference(&shape)?.bound;
        Ok(Bounded { shape, error })
    }
}

impl Surface {
    /// The clamped surface of a degree lower by one in a direction that is nearest, and the proven error.
    ///
    /// # Errors
    /// As for curves.
    pub fn reduce(&self, direction: Direction) -> Result<Bounded<Self>, Error> {
        let clamped = self.clamp()?;
        let (knots, strands) = (clamped.knots(direction), clamped.strands(direction)?);
        let (knots, strands) = lower(knots, direction.suffix(), strands)?;
        let shape = clamped.with_strands(direction, knots, &strands)?;
        let error = self.difference(&shape)?.bound;
        Ok(Bounded { shape, error })
    }
}

fn lower(
    knots: &Knots,
    suffix: &str,
    strands: Vec<Weighted>,
) -> Result<(Knots, Vec<Weighted>), Error> {
    let p = knots.degree();
    if p == 1 {
        return Err(Error::InvalidArgument(format!("degree{suffix}: 1 cannot be reduced")));
    }
    let coarse = checked(&lowered(knots.values()), p - 1)?;
    let elevation = Map::elevation(&coarse)?;
    let fine = Map::to(knots, &raised_knots(&coarse)?)?.apply(&strands)?;
    match nearest(&elevation, &fine)? {
        Some(strands) => Ok((coarse, strands)),
        None => Err(Error::Unsupported("weights: the reduced ones are not all positive".into())),
    }
}

/// Every knot once less, but at least once.
fn lowered(values: &[f64]) -> Vec<f64> {
    let is_only = |i: usize| {
        (i == 0 || values[i - 1] < values[i]) && values.get(i + 1).is_none_or(|u| *u > values[i])
    };
    let is_kept = |&i: &usize| (i > 0 && values[i - 1] == values[i]) || is_only(i);
    (0..values.len()).filter(is_kept).map(|i| values[i]).collect()
}
