//! Surfaces: a grid of poles over two knot vectors, checked once and never changed.
//!
//! ```text
//!   v  ^  P(0,n) ... P(m,n)      pole (i, j) is stored at i * pole_count_v + j,
//!      |    :           :        so a row of constant i is contiguous
//!      |  P(0,0) ... P(m,0)
//!      +--------------------> u
//! ```
//!
//! Points are computed as a reference pole plus the mean of differences, like those of a curve.
//!
//! Reference: Piegl, Tiller, *The NURBS Book*, 2nd ed., algorithms A3.5, A3.6, A4.3, A4.4.
//! Limit: weights outside 1e-100 .. 1e100 are refused, their products would leave the doubles.

use crate::basis;
use crate::curve::{add_scaled, box_of, check_poles, check_weights, differ, largest};
use crate::error::Error;
use crate::knots::{Knots, MAX_DEGREE, copied};

mod edges;
mod insertion;
mod lockstep;
mod partials;

pub use edges::COLLAPSED_TOLERANCE;

const ORDER: usize = MAX_DEGREE + 1;

/// A tensor-product B-spline or NURBS surface in space. Immutable.
#[derive(Clone, Debug, PartialEq)]
pub struct Surface {
    knots_u: Knots,
    knots_v: Knots,
    poles: Box<[[f64; 3]]>,
    weights: Option<Box<[f64]>>,
    rational: bool,
}

impl Surface {
    /// A surface with full knot vectors; pole (i, j) is `poles[i * pole_count_v + j]`, and so are the weights.
    ///
    /// # Errors
    /// The first value that is not allowed, by name and index; or memory that could not be had.
    pub fn new(
        knots_u: &[f64],
        knots_v: &[f64],
        degree_u: usize,
        degree_v: usize,
        poles: &[[f64; 3]],
        pole_count_u: usize,
        pole_count_v: usize,
        weights: Option<&[f64]>,
    ) -> Result<Self, Error> {
        let knots_u =
            Knots::new(knots_u, degree_u, pole_count_u).map_err(|error| error.named("_u"))?;
        let knots_v =
            Knots::new(knots_v, degree_v, pole_count_v).map_err(|error| error.named("_v"))?;
        check_pole_count(poles.len(), pole_count_u, pole_count_v)?;
        let name = |i: usize| format!("({}, {})", i / pole_count_v, i % pole_count_v);
        check_poles(poles, name)?;
        check_weights(weights, poles.len(), name)?;
        let weights = weights.map(copied).transpose()?;
        Ok(Self::from_parts(knots_u, knots_v, copied(poles)?, weights))
    }

    /// A surface of parts that have been checked.
    pub(crate) fn from_parts(
        knots_u: Knots,
        knots_v: Knots,
        poles: Box<[[f64; 3]]>,
        weights: Option<Box<[f64]>>,
    ) -> Self {
        let rational = differ(weights.as_deref());
        Self { knots_u, knots_v, poles, weights, rational }
    }

    /// The knot vector of u.
    pub fn knots_u(&self) -> &Knots {
        &self.knots_u
    }

    /// The knot vector of v.
    pub fn knots_v(&self) -> &Knots {
        &self.knots_v
    }

    /// The poles, not multiplied by the weights; v runs fastest.
    pub fn poles(&self) -> &[[f64; 3]] {
        &self.poles
    }

    /// The weights as they were given; v runs fastest.
    pub fn weights(&self) -> Option<&[f64]> {
        self.weights.as_deref()
    }

    /// First and last u, first and last v.
    pub fn domain(&self) -> [f64; 4] {
        let ((u0, u1), (v0, v1)) = (self.knots_u.domain(), self.knots_v.domain());
        [u0, u1, v0, v1]
    }

    /// Bytes of the arrays.
    pub(crate) fn heap_memory(&self) -> usize {
        let knots = size_of_val(self.knots_u.values()) + size_of_val(self.knots_v.values());
        knots + size_of_val(self.poles()) + self.weights().map_or(0, size_of_val)
    }

    /// True when there are weights and they are not all equal.
    pub fn is_rational(&self) -> bool {
        self.rational
    }

    /// Smallest box of the poles that matter; the surface lies inside up to rounding.
    pub fn bounding_box(&self) -> ([f64; 3], [f64; 3]) {
        let (across, along) = (self.knots_u.active_poles(), self.knots_v.active_poles());
        let stride = self.knots_v.pole_count();
        box_of(across.flat_map(|i| &self.poles[i * stride + along.start..i * stride + along.end]))
    }

    /// The point at (u, v) in the domain: right-sided at a knot, left-sided at the domain's end.
    pub fn evaluate(&self, u: f64, v: f64) -> [f64; 3] {
        let (reference, sum) = self.sum(u, v);
        self.position(reference, sum)
    }

    /// `evaluate(u, v) - query`, without the rounding of the point to its coordinates.
    pub fn vector_from(&self, query: [f64; 3], u: f64, v: f64) -> [f64; 3] {
        let (reference, sum) = self.sum(u, v);
        self.position(std::array::from_fn(|axis| reference[axis] - query[axis]), sum)
    }

    /// A pole near (u, v), and the sum of what is recentred there: coordinates times weights, weights.
    fn sum(&self, u: f64, v: f64) -> ([f64; 3], [f64; 4]) {
        debug_assert!(self.knots_u.contains(u), "u = {u} is outside the domain");
        debug_assert!(self.knots_v.contains(v), "v = {v} is outside the domain");
        let spans = [self.knots_u.span(u), self.knots_v.span(v)];
        let (mut basis_u, mut basis_v) = ([0.0; ORDER], [0.0; ORDER]);
        let basis_u = &mut basis_u[..self.knots_u.degree() + 1];
        let basis_v = &mut basis_v[..self.knots_v.degree() + 1];
        basis::values(&self.knots_u, spans[0], u, basis_u);
        basis::values(&self.knots_v, spans[1], v, basis_v);
        let reference = self.reference(spans, basis_u, basis_v);
        let mut sum = [0.0; 4];
        for (i, n) in basis_u.iter().enumerate() {
            let row = self.row_sum(self.row_start(spans, i), basis_v, reference);
            for axis in 0..4 {
                sum[axis] += n * row[axis];
            }
        }
        (reference, sum)
    }

    /// The pole of the largest product of basis functions.
    fn reference(&self, spans: [usize; 2], basis_u: &[f64], basis_v: &[f64]) -> [f64; 3] {
        self.poles[self.row_start(spans, largest(basis_u)) + largest(basis_v)]
    }

    /// Where the poles of the local net with local row `i` begin.
    fn row_start(&self, spans: [usize; 2], i: usize) -> usize {
        let [first_u, first_v] =
            [spans[0] - self.knots_u.degree(), spans[1] - self.knots_v.degree()];
        (first_u + i) * self.knots_v.pole_count() + first_v
    }

    /// `sum N_j w_j (P_j - reference)` and `sum N_j w_j` over a row of the local net.
    #[inline]
    fn row_sum(&self, start: usize, basis: &[f64], reference: [f64; 3]) -> [f64; 4] {
        let poles = &self.poles[start..start + basis.len()];
        let mut sum = [0.0; 4];
        match &self.weights {
            Some(weights) if self.rational => {
                for ((n, pole), weight) in basis.iter().zip(poles).zip(&weights[start..]) {
                    add_scaled(&mut sum, n * weight, pole, reference);
                }
            }
            _ => {
                for (n, pole) in basis.iter().zip(poles) {
                    add_scaled(&mut sum, *n, pole, reference);
                }
            }
        }
        sum
    }

    fn position(&self, reference: [f64; 3], sum: [f64; 4]) -> [f64; 3] {
        let divisor = if self.rational { sum[3] } else { 1.0 };
        std::array::from_fn(|axis| sum[axis] / divisor + reference[axis])
    }
}

fn check_pole_count(found: usize, count_u: usize, count_v: usize) -> Result<(), Error> {
    match count_u.checked_mul(count_v) {
        Some(expected) if expected == found => Ok(()),
        Some(expected) => {
            Err(Error::InvalidArgument(format!("poles: {found} given, {expected} expected")))
        }
        None => Err(Error::InvalidArgument("pole_count_u: times pole_count_v overflows".into())),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LINE: [f64; 4] = [0., 0., 1., 1.];

    fn refused(
        v: &[f64],
        poles: &[[f64; 3]],
        counts: [usize; 2],
        weights: Option<&[f64]>,
    ) -> String {
        let made = Surface::new(&LINE, v, 1, 1, poles, counts[0], counts[1], weights);
        made.unwrap_err().to_string()
    }

    #[test]
    fn a_refusal_names_direction_and_both_indices() {
        let (v, mut poles) = ([0., 0., 1., 2., 2.], [[1.0; 3]; 6]);
        assert_eq!(
            refused(&[0., 0., 1., 0., 2.], &poles, [2, 3], None),
            "knots_v: knot 3 is less than knot 2"
        );
        assert_eq!(refused(&v, &poles, [1, 3], None), "pole_count_u: 1 given, at least 2 needed");
        assert_eq!(refused(&v, &poles, [3, 3], None), "knots_u: 4 given, 5 expected");
        assert_eq!(refused(&v, &poles[..5], [2, 3], None), "poles: 5 given, 6 expected");
        let weights = [1., 1., 1., 1., -1., 1.];
        assert_eq!(
            refused(&v, &poles, [2, 3], Some(&weights)),
            "weights: weight (1, 1) is not positive"
        );
        poles[5][2] = f64::NAN;
        assert_eq!(refused(&v, &poles, [2, 3], None), "poles: pole (1, 2) is not finite");
    }

    #[test]
    fn counts_that_overflow_are_refused_before_any_work() {
        let most = usize::MAX;
        assert!(Surface::new(&LINE, &LINE, 1, 1, &[[0.0; 3]; 4], most, 2, None).is_err());
        assert!(check_pole_count(4, most, 3).unwrap_err().to_string().contains("pole_count_u"));
    }
}
