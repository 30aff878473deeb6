//! Arc length by Gauss' quadrature, halved until it settles.

use super::rows::{Cell, curve_rows, gauss, quadrature};
use crate::bounds::{Vector, add, norm, scaled};
use crate::curve::Curve;
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
    /// Rows of the first derivative, with the weight of the place.
    places: Vec<(Cell, f64)>,
}

impl LengthLimit {
    pub fn new(curve: &Curve, range: [f64; 2]) -> Self {
        let p = curve.degree();
        let place = |&[u, weight]: &[f64; 2]| {
            let (first, rows) = curve_rows(curve, u, Side::Above, 1);
            (Cell { poles: (first..=first + p).collect(), rows: rows[p + 1..].to_vec() }, weight)
        };
        let places = quadrature(curve.knots(), true).iter().flatten().map(place).collect();
        Self { range, places }
    }

    /// The length and its gradient.
    pub fn with_gradient(&self, poles: &[Vector]) -> (f64, Vec<Vector>) {
        let (mut length, mut gradient) = (0.0, vec![[0.0; 3]; poles.len()]);
        for (cell, weight) in &self.places {
            let way = cell.apply(&cell.rows, poles);
            let speed = norm(way);
            length += weight * speed;
            if speed > 0.0 {
                for (x, &i) in cell.rows.iter().zip(&cell.poles) {
                    gradient[i] = add(gradient[i], scaled(way, weight * x / speed));
                }
            }
        }
        (length, gradient)
    }
}
