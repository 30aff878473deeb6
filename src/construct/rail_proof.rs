//! How far a motion is from the rotation minimising one, proven.
//!
//! The exact motion turns the profile by M(v), with M(v0) = 1 and
//!
//! ```text
//!   M' = [W] M,     W = C' x C'' / |C'|^2 + (turn / L) C',     [W] x = W x x
//! ```
//!
//! W has no part along the tangent but the wished turn: that is what "rotation minimising" says. [W] turns and does not stretch, so for
//! any continuous R
//!
//! ```text
//!   |R(v) - M(v)| <= |R(v0) - 1| + integral |R' - [W] R|
//! ```
//!
//! With C = A / w and D = A' w - A w' = w^2 C' on a Bezier piece W is D x D' / D.D + (turn / L) D / w^2: the integrand is a polynomial over
//! w^2 D.D, bounded by Bernstein coefficients. Integrals of absolute values add up what oscillates; so R is not the fit itself but a much
//! closer reference of higher degree, and the fit's difference from that is bounded by its hull.

use super::gap;
use super::poly::{Poly, Polys, homogeneous, product};
use crate::bezier::{Bidegree, MAX_TRIPLE};
use crate::bounds::Vector;
use crate::curve::Curve;
use crate::error::Error;

/// Most halvings of a piece whose speed varies.
const DEPTH: usize = 12;

fn zero() -> Poly {
    Poly { degree: Bidegree { s: 0, t: 0 }, c: vec![0.0], slack: 0.0 }
}

fn is_constant(poly: &Poly) -> bool {
    poly.degree.s == 0
}

/// The sum of polynomials of any degrees, with factors.
fn sum(parts: &[(f64, Poly)]) -> Poly {
    let s = parts.iter().map(|(_, poly)| poly.degree.s).max().unwrap_or(0);
    let degree = Bidegree { s, t: 0 };
    let none = Poly { degree, c: vec![0.0; degree.count()], slack: 0.0 };
    parts.iter().fold(none, |sum, (factor, poly)| sum.plus(*factor, &poly.raised(degree)))
}

fn derived(polys: &Polys) -> Polys {
    [0, 1, 2].map(|k| if is_constant(&polys[k]) { zero() } else { polys[k].derived(0) })
}

fn cross(a: &Polys, b: &Polys) -> Polys {
    [(1, 2), (2, 0), (0, 1)]
        .map(|(i, j)| sum(&[(1.0, a[i].times(&b[j])), (-1.0, a[j].times(&b[i]))]))
}

/// The residual R' - [W] R of all columns on one piece, over `divisor`.
struct Residual {
    parts: Vec<Poly>,
    divisor: Poly,
}

impl Residual {
    /// Nothing when degrees are too high.
    fn new(spine: &Curve, columns: [&Curve; 3], rate: f64) -> Option<Self> {
        let degree = Bidegree { s: spine.degree(), t: 0 };
        if spine.poles().len() != spine.degree() + 1 {
            return None;
        }
        let (a, w) = homogeneous(spine.poles(), spine.weights(), spine.poles()[0], degree);
        let slope = derived(&a);
        let d: Polys = if is_constant(&w) {
            slope
        } else {
            let w_slope = w.derived(0);
            [0, 1, 2].map(|k| sum(&[(1.0, slope[k].times(&w)), (-1.0, a[k].times(&w_slope))]))
        };
        let highest = 3 * d[0].degree.s + 2 * w.degree.s + columns[0].degree();
        if highest >= MAX_TRIPLE {
            return None;
        }
        let (q, square) = (product(&d, &d), w.times(&w));
        let bend = cross(&d, &derived(&d));
        let divisor = q.times(&square);
        let mut parts = Vec::with_capacity(9);
        for column in columns {
            let degree = Bidegree { s: column.degree(), t: 0 };
            let (r, _) = homogeneous(column.poles(), None, [0.0; 3], degree);
            let (change, turned, spun) = (derived(&r), cross(&bend, &r), cross(&d, &r));
            for k in 0..3 {
                parts.push(sum(&[
                    (1.0, divisor.times(&change[k])),
                    (-1.0, square.times(&turned[k])),
                    (-rate, q.times(&spun[k])),
                ]));
            }
        }
        Some(Self { parts, divisor })
    }

    /// The integral over the piece, in its local parameter from 0 to 1; infinite when there is no bound.
    fn integral(&self, depth: usize) -> f64 {
        let least = self.divisor.least();
        let even = least > 0.5 * self.divisor.most();
        if !even && depth > 0 {
            return self.halved().iter().map(|half| 0.5 * half.integral(depth - 1)).sum();
        }
        if least.is_nan() || least <= 0.0 {
            return f64::INFINITY;
        }
        let square: f64 = self.parts.iter().map(|part| part.most() * part.most()).sum();
        square.sqrt() / least * (1.0 + 32.0 * f64::EPSILON)
    }

    fn halved(&self) -> [Self; 2] {
        let [low, high] = self.divisor.halved(0);
        let (mut first, mut second) = (Vec::new(), Vec::new());
        for part in &self.parts {
            let [low, high] = part.halved(0);
            first.push(low);
            second.push(high);
        }
        [Self { parts: first, divisor: low }, Self { parts: second, divisor: high }]
    }
}

/// How far the columns of R are from those of `scale` times the exact motion along `spine`, at most, in Frobenius' norm: infinite where
/// nothing is proven. `rate` is the turn over the length. The knots of R are to be those of the spine, and more.
pub(super) fn motion_error(
    spine: &Curve,
    columns: &[Curve],
    scale: f64,
    rate: f64,
) -> Result<f64, Error> {
    let clamped = spine.clamp()?;
    let unit = |k: usize| -> Vector { std::array::from_fn(|x| if x == k { scale } else { 0.0 }) };
    let start: f64 = (0..3).map(|k| gap(columns[k].poles()[0], unit(k)).powi(2)).sum();
    let mut all = start.sqrt() * (1.0 + 8.0 * f64::EPSILON);
    let pieces =
        [columns[0].bezier_pieces()?, columns[1].bezier_pieces()?, columns[2].bezier_pieces()?];
    for (i, first) in pieces[0].iter().enumerate() {
        let (a, b) = first.domain();
        let part = clamped.part(a, b)?;
        let residual = Residual::new(&part, [first, &pieces[1][i], &pieces[2][i]], rate);
        all += residual.map_or(f64::INFINITY, |residual| residual.integral(DEPTH));
        if all.is_infinite() {
            break;
        }
    }
    Ok(all * (1.0 + 1e-12))
}
