//! Arc length by Gauss' quadrature, halved until it settles.

use super::cells::Functional;
use super::rows::{curve_rows, gauss, quadrature};
use crate::bounds::{Vector, add, norm, scaled};
use crate::curve::Curve;
use crate::curve::insertion::{append, filled};
use crate::error::Error;
use crate::knots::Side;

/// Halvings of a span at most.
const DEEPEST: usize = 12;

/// The arc length of a curve: each span by Gauss' rule with eight points, halved until both agree to `relative` of the span.
///
/// Not a proven value; errors are of the size of `relative` unless the curve has cusps.
pub fn arc_length(curve: &Curve, relative: f64) -> f64 {
    let rule = gauss(8);
    let t = curve.knots().values();
    let spans = curve.knots().spans();
    spans.map(|i| part(curve, [t[i], t[i + 1]], &rule, relative, DEEPEST, None)).sum()
}

fn part(
    curve: &Curve,
    [a, b]: [f64; 2],
    rule: &[[f64; 2]],
    relative: f64,
    depth: usize,
    whole: Option<f64>,
) -> f64 {
    let quadrature = |a: f64, b: f64| -> f64 {
        let speed = |x: f64| {
            let mut out = [[0.0; 3]; 2];
            curve.derivatives_on(a + x * (b - a), Side::Above, 1, &mut out);
            norm(out[1])
        };
        rule.iter().map(|[x, w]| w * (b - a) * speed(*x)).sum()
    };
    let whole = whole.unwrap_or_else(|| quadrature(a, b));
    let middle = 0.5 * (a + b);
    let halves = [quadrature(a, middle), quadrature(middle, b)];
    let sum = halves[0] + halves[1];
    if depth == 0 || (sum - whole).abs() <= relative * sum || middle <= a || middle >= b {
        return sum;
    }
    part(curve, [a, middle], rule, relative, depth - 1, Some(halves[0]))
        + part(curve, [middle, b], rule, relative, depth - 1, Some(halves[1]))
}

/// The arc length as a function of the poles, by quadrature, and the range that it must stay in.
pub struct LengthLimit {
    /// Least and greatest length.
    pub range: [f64; 2],
    /// Rows of the first derivative, and the weights of the places.
    places: Functional,
    weights: Vec<f64>,
}

impl LengthLimit {
    /// For the knots and weights of `curve`.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn new(curve: &Curve, range: [f64; 2]) -> Result<Self, Error> {
        let p = curve.degree();
        let (mut places, mut weights) = (Functional::default(), Vec::new());
        for [u, weight] in quadrature(curve.knots(), true).flatten() {
            let (first, rows) = curve_rows(curve, u, Side::Above, 1);
            places.push(first..first + p + 1, &rows[p + 1..])?;
            append(&mut weights, weight)?;
        }
        Ok(Self { range, places, weights })
    }

    /// The length and its gradient.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn with_gradient(&self, poles: &[Vector]) -> Result<(f64, Vec<Vector>), Error> {
        let (mut length, mut gradient) = (0.0, filled(poles.len(), [0.0; 3])?);
        for (cell, weight) in self.places.cells().zip(&self.weights) {
            let way = cell.apply(cell.rows, poles);
            let speed = norm(way);
            length += weight * speed;
            if speed > 0.0 {
                for (x, &i) in cell.rows.iter().zip(cell.poles) {
                    gradient[i] = add(gradient[i], scaled(way, weight * x / speed));
                }
            }
        }
        Ok((length, gradient))
    }
}
