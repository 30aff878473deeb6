//! Curves: poles, weights and a knot vector, checked once and never changed.
//!
//! A point is the mean of `p + 1` neighbouring poles with the weights `N_j w_j`. It is computed as a
//! reference pole `R` (the one with the largest basis function) plus the mean of the differences:
//!
//! ```text
//!   C(u) = R + sum N_j w_j (P_j - R) / sum N_j w_j
//! ```
//!
//! The rounding error then is a few eps of the size of the local net, wherever the origin is, and a
//! clamped end is its pole bit for bit. Derivatives of rational curves use the same differences as
//! homogeneous coordinates and the quotient recursion.
//!
//! Reference: Piegl, Tiller, *The NURBS Book*, 2nd ed., algorithms A3.1, A3.2, A4.2 and section 5.2.
//! Limit: weights outside 1e-100 .. 1e100 are refused, their products would leave the doubles.

use crate::basis;
use crate::error::Error;
use crate::knots::{Knots, MAX_DEGREE, MAX_MAGNITUDE, Side, copied};

pub(crate) mod insertion;
mod lockstep;

pub(crate) use lockstep::{add_lanes, lane_basis, lane_points, lane_poles};

/// Ends nearer than this, relative to the diagonal of the box, are the same point: a closed shape.
pub const CLOSED_TOLERANCE: f64 = 1e-9;

/// Equal points of a shape far from the origin differ by the rounding of their coordinates. This many
/// units of the largest coordinate are allowed on top of a relative tolerance.
const COORDINATE_ROUNDING: f64 = 4.0 * f64::EPSILON;

const ORDER: usize = MAX_DEGREE + 1;

/// A B-spline or NURBS curve in space. Immutable.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    knots: Knots,
    poles: Box<[[f64; 3]]>,
    weights: Option<Box<[f64]>>,
    rational: bool,
}

impl Curve {
    /// A curve of `degree` with the full knot vector `knots`, one weight a pole or none.
    ///
    /// # Errors
    /// The first value that is not allowed, by name and index; or memory that could not be had.
    pub fn new(
        knots: &[f64],
        degree: usize,
        poles: &[[f64; 3]],
        weights: Option<&[f64]>,
    ) -> Result<Self, Error> {
        let knots = Knots::new(knots, degree, poles.len()).map_err(|error| error.named(""))?;
        check_poles(poles, |i| i.to_string())?;
        check_weights(weights, poles.len(), |i| i.to_string())?;
        let weights = weights.map(copied).transpose()?;
        Ok(Self::from_parts(knots, copied(poles)?, weights))
    }

    /// A curve of parts that have been checked.
    pub(crate) fn from_parts(
        knots: Knots,
        poles: Box<[[f64; 3]]>,
        weights: Option<Box<[f64]>>,
    ) -> Self {
        let rational = differ(weights.as_deref());
        Self { knots, poles, weights, rational }
    }

    /// The knot vector.
    pub fn knots(&self) -> &Knots {
        &self.knots
    }

    /// The poles, not multiplied by the weights.
    pub fn poles(&self) -> &[[f64; 3]] {
        &self.poles
    }

    /// The weights as they were given.
    pub fn weights(&self) -> Option<&[f64]> {
        self.weights.as_deref()
    }

    /// The degree.
    pub fn degree(&self) -> usize {
        self.knots.degree()
    }

    /// First and last parameter.
    pub fn domain(&self) -> (f64, f64) {
        self.knots.domain()
    }

    /// Bytes of the arrays.
    pub(crate) fn heap_memory(&self) -> usize {
        let knots = size_of_val(self.knots.values());
        knots + size_of_val(self.poles()) + self.weights().map_or(0, size_of_val)
    }

    /// True when there are weights and they are not all equal.
    pub fn is_rational(&self) -> bool {
        self.rational
    }

    /// Smallest box of the poles that matter; the curve lies inside up to rounding.
    pub fn bounding_box(&self) -> ([f64; 3], [f64; 3]) {
        box_of(&self.poles[self.knots.active_poles()])
    }

    /// The point at `u` in the domain: right-sided at a knot, left-sided at the domain's end.
    pub fn evaluate(&self, u: f64) -> [f64; 3] {
        debug_assert!(self.knots.contains(u), "u = {u} is outside the domain");
        let span = self.knots.span(u);
        let mut basis = [0.0; ORDER];
        let basis = &mut basis[..self.degree() + 1];
        basis::values(&self.knots, span, u, basis);
        let reference = self.reference(span, basis);
        self.position(reference, self.sum(span, basis, reference))
    }

    /// `evaluate(u) - query`, without the rounding of the point to its coordinates.
    pub fn vector_from(&self, query: [f64; 3], u: f64) -> [f64; 3] {
        let span = self.knots.span(u);
        let mut basis = [0.0; ORDER];
        let basis = &mut basis[..self.degree() + 1];
        basis::values(&self.knots, span, u, basis);
        let reference = self.reference(span, basis);
        let apart = std::array::from_fn(|axis| reference[axis] - query[axis]);
        self.position(apart, self.sum(span, basis, reference))
    }

    /// The derivatives of order 0 to `count` at `u`, sided like [`Curve::evaluate`], into `out[0..=count]`.
    ///
    /// `out[0]` has the same bits as `evaluate(u)`, whatever `count` is; `count` is at most [`MAX_DEGREE`].
    pub fn derivatives(&self, u: f64, count: usize, out: &mut [[f64; 3]]) {
        self.derivatives_on(u, Side::Above, count, out);
    }

    /// As [`Curve::derivatives`], of the piece on one side of a knot. Below a knot the point may differ from that of
    /// [`Curve::evaluate`] by rounding.
    pub fn derivatives_on(&self, u: f64, side: Side, count: usize, out: &mut [[f64; 3]]) {
        debug_assert!(self.knots.contains(u), "u = {u} is outside the domain");
        let (span, rows) = (self.knots.span_on(u, side), count.min(self.degree()) + 1);
        if rows * (self.degree() + 1) <= 32 {
            self.derive(span, u, count, &mut [0.0; 32], out);
        } else {
            self.derive(span, u, count, &mut [0.0; ORDER * ORDER], out);
        }
    }

    /// The work of [`Curve::derivatives_on`], with room for the basis functions in `basis`.
    fn derive(&self, span: usize, u: f64, count: usize, basis: &mut [f64], out: &mut [[f64; 3]]) {
        let degree = self.degree();
        let highest = count.min(degree);
        basis::derivatives(&self.knots, span, u, highest, basis);
        let reference = self.reference(span, &basis[..=degree]);
        let mut weights = [0.0; ORDER];
        out[..=count].fill([0.0; 3]);
        for (k, row) in basis.chunks_exact(degree + 1).take(highest + 1).enumerate() {
            let [x, y, z, w] = self.sum(span, row, reference);
            out[k] = [x, y, z];
            weights[k] = w;
        }
        let [x, y, z] = out[0];
        if self.rational {
            divide_out(&weights[..=highest], &mut out[..=count]);
        }
        out[0] = self.position(reference, [x, y, z, weights[0]]);
    }

    /// The pole of the largest basis function.
    fn reference(&self, span: usize, basis: &[f64]) -> [f64; 3] {
        self.poles[span - self.degree() + largest(basis)]
    }

    /// `sum N_j w_j (P_j - reference)` and `sum N_j w_j`.
    fn sum(&self, span: usize, basis: &[f64], reference: [f64; 3]) -> [f64; 4] {
        let active = span - self.degree()..span + 1;
        let poles = &self.poles[active.clone()];
        let mut sum = [0.0; 4];
        match &self.weights {
            Some(weights) if self.rational => {
                for ((n, pole), weight) in basis.iter().zip(poles).zip(&weights[active]) {
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

    /// True when both ends of the curve are the same point, within [`CLOSED_TOLERANCE`] of the diagonal
    /// of the box (and the rounding of its coordinates). Knots play no part.
    pub fn is_closed(&self) -> bool {
        let (start, end) = self.domain();
        let gap = distance(self.evaluate(start), self.evaluate(end));
        gap <= length_tolerance(self.bounding_box(), CLOSED_TOLERANCE)
    }
}

/// Turns derivatives of the numerator into derivatives of the quotient, in place.
///
/// `A = w C` gives `C^(k) = (A^(k) - sum_{i=1..k} (k over i) w^(i) C^(k-i)) / w`.
fn divide_out(weights: &[f64], out: &mut [[f64; 3]]) {
    for k in 0..out.len() {
        let mut value = out[k];
        for i in 1..=k.min(weights.len() - 1) {
            let factor = binomial(k, i) * weights[i];
            for axis in 0..3 {
                value[axis] -= factor * out[k - i][axis];
            }
        }
        out[k] = value.map(|x| x / weights[0]);
    }
}

#[inline]
pub(crate) fn add_scaled(sum: &mut [f64; 4], factor: f64, pole: &[f64; 3], reference: [f64; 3]) {
    for axis in 0..3 {
        sum[axis] += factor * (pole[axis] - reference[axis]);
    }
    sum[3] += factor;
}

/// Index of the largest value, the first of equals.
#[inline]
pub(crate) fn largest(values: &[f64]) -> usize {
    let (mut best, mut greatest) = (0, values[0]);
    for (index, &value) in values.iter().enumerate() {
        // Two selections, no branch: which one is greatest cannot be foretold.
        let is_greater = value > greatest;
        best = if is_greater { index } else { best };
        greatest = if is_greater { value } else { greatest };
    }
    best
}

/// The binomial coefficient "n over k" for n <= [`MAX_DEGREE`], from Pascal's triangle; exact.
pub(crate) fn binomial(n: usize, k: usize) -> f64 {
    BINOMIALS[n][k]
}

static BINOMIALS: [[f64; ORDER]; ORDER] = pascal();

const fn pascal() -> [[f64; ORDER]; ORDER] {
    let mut rows = [[0.0; ORDER]; ORDER];
    let mut n = 0;
    while n < ORDER {
        rows[n][0] = 1.0;
        let mut k = 1;
        while k <= n {
            rows[n][k] = rows[n - 1][k - 1] + rows[n - 1][k];
            k += 1;
        }
        n += 1;
    }
    rows
}

/// Refuses poles that are not finite or beyond [`MAX_MAGNITUDE`]; `name` writes an index.
pub(crate) fn check_poles(poles: &[[f64; 3]], name: impl Fn(usize) -> String) -> Result<(), Error> {
    if let Some(i) = poles.iter().position(|pole| pole.iter().any(|x| !x.is_finite())) {
        return Err(Error::InvalidArgument(format!("poles: pole {} is not finite", name(i))));
    }
    match poles.iter().position(|pole| pole.iter().any(|x| x.abs() > MAX_MAGNITUDE)) {
        Some(i) => Err(Error::InvalidArgument(format!("poles: pole {} is beyond 1e100", name(i)))),
        None => Ok(()),
    }
}

/// Refuses weights that are not finite, not positive, or not within 1e-100 .. 1e100.
pub(crate) fn check_weights(
    weights: Option<&[f64]>,
    expected: usize,
    name: impl Fn(usize) -> String,
) -> Result<(), Error> {
    let Some(weights) = weights else { return Ok(()) };
    let found = weights.len();
    if found != expected {
        return Err(Error::InvalidArgument(format!("weights: {found} given, {expected} expected")));
    }
    let defect = |w: f64| match w {
        w if !w.is_finite() => Some("is not finite"),
        w if w <= 0.0 => Some("is not positive"),
        w if w > MAX_MAGNITUDE => Some("is beyond 1e100"),
        w if w < 1.0 / MAX_MAGNITUDE => Some("is below 1e-100"),
        _ => None,
    };
    match weights.iter().enumerate().find_map(|(i, &w)| defect(w).map(|why| (i, why))) {
        Some((i, why)) => Err(Error::InvalidArgument(format!("weights: weight {} {why}", name(i)))),
        None => Ok(()),
    }
}

/// Do these weights make the shape rational?
pub(crate) fn differ(weights: Option<&[f64]>) -> bool {
    weights.is_some_and(|weights| weights.iter().any(|w| *w != weights[0]))
}

/// Smallest box of some points, at least one.
pub(crate) fn box_of<'a>(points: impl IntoIterator<Item = &'a [f64; 3]>) -> ([f64; 3], [f64; 3]) {
    let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    for point in points {
        for axis in 0..3 {
            low[axis] = low[axis].min(point[axis]);
            high[axis] = high[axis].max(point[axis]);
        }
    }
    (low, high)
}

pub(crate) fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    let [x, y, z] = [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
    (x * x + y * y + z * z).sqrt()
}

/// `relative` times the diagonal of a box, plus the rounding of its coordinates.
pub(crate) fn length_tolerance((low, high): ([f64; 3], [f64; 3]), relative: f64) -> f64 {
    let largest = low.iter().chain(&high).fold(0.0, |most: f64, x| most.max(x.abs()));
    relative * distance(low, high) + COORDINATE_ROUNDING * largest
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refused(
        knots: &[f64],
        degree: usize,
        poles: &[[f64; 3]],
        weights: Option<&[f64]>,
    ) -> String {
        Curve::new(knots, degree, poles, weights).unwrap_err().to_string()
    }

    #[test]
    fn a_refusal_names_parameter_and_index() {
        let (line, poles) = ([0., 0., 1., 1.], [[0.0; 3], [1.0, 2.0, 3.0]]);
        let knots = |knots: [f64; 4]| refused(&knots, 1, &poles, None);
        assert_eq!(knots([0., 0., f64::NAN, 1.]), "knots: knot 2 is not finite");
        assert_eq!(knots([0., 0., 1., 2e100]), "knots: knot 3 is beyond 1e100");
        assert_eq!(knots([0., 0., 1., 0.5]), "knots: knot 3 is less than knot 2");
        assert_eq!(knots([0., 1., 1., 2.]), "knots: the domain is empty");
        assert_eq!(refused(&line, 0, &poles, None), "degree: 0 given, 1 to 31 accepted");
        assert_eq!(refused(&line, 32, &poles, None), "degree: 32 given, 1 to 31 accepted");
        assert_eq!(refused(&line, 2, &poles, None), "pole_count: 2 given, at least 3 needed");
        assert_eq!(refused(&line[1..], 1, &poles, None), "knots: 3 given, 4 expected");
        let bad = [poles[0], [0.0, f64::INFINITY, 0.0]];
        assert_eq!(refused(&line, 1, &bad, None), "poles: pole 1 is not finite");
        let bad = [[0.0, -2e100, 0.0], poles[1]];
        assert_eq!(refused(&line, 1, &bad, None), "poles: pole 0 is beyond 1e100");
    }

    #[test]
    fn a_refused_weight_is_named() {
        let weights =
            |weights: &[f64]| refused(&[0., 0., 1., 1.], 1, &[[0.0; 3]; 2], Some(weights));
        assert_eq!(weights(&[1.0]), "weights: 1 given, 2 expected");
        assert_eq!(weights(&[1.0, f64::NAN]), "weights: weight 1 is not finite");
        assert_eq!(weights(&[1.0, 0.0]), "weights: weight 1 is not positive");
        assert_eq!(weights(&[-1.0, 0.0]), "weights: weight 0 is not positive");
        assert_eq!(weights(&[1.0, 1e101]), "weights: weight 1 is beyond 1e100");
        assert_eq!(weights(&[1.0, 1e-101]), "weights: weight 1 is below 1e-100");
    }

    #[test]
    fn equal_weights_are_kept_but_make_no_rational_curve() {
        let curve =
            Curve::new(&[0., 0., 1., 1.], 1, &[[0.0; 3], [1.0; 3]], Some(&[3.0; 2])).unwrap();
        assert!(!curve.is_rational());
        let finer = curve.insert_knot(0.3, 1).unwrap();
        assert_eq!(finer.weights(), Some(&[3.0; 3][..]));
    }

    #[test]
    fn binomials_follow_from_their_neighbours_and_are_symmetric() {
        assert_eq!(binomial(31, 15), 300_540_195.0);
        for n in 0..=MAX_DEGREE {
            assert!((0..=n).all(|k| binomial(n, k) == binomial(n, n - k)));
        }
    }
}
