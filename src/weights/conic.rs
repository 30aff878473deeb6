//! Shape factors of conics: the curve of degree 2 over three poles.
//!
//! ```text
//!            P1             S the point at the middle, M the middle of the chord P0 P2
//!            |              rho = MS / MP1 = w / (1 + w)  with  w = w1 / sqrt(w0 w2)
//!         .--S--.           w < 1 ellipse, w = 1 parabola, w > 1 hyperbola
//!       P0---M---P2         rho < 1/2          1/2             > 1/2
//! ```
//!
//! With barycentric coordinates a, b, c of the triangle the conic is `b^2 = 4 w^2 a c`; its quadratic part is a symmetric matrix of
//! trace T and determinant D, and the eccentricity e follows from their ratio: `D / T^2 = (1 - e^2) / (2 - e^2)^2`.
//!
//! Reference: Farin, *NURBS: from projective geometry to practical use*, 2nd ed., chapters 6 and 8 (conics, shape factors).

use super::invalid;
use crate::bounds::{Vector, cross, dot, norm, sub};
use crate::error::Error;

/// What three weights over a triangle make.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Conic {
    /// The middle weight when both ends have weight 1.
    pub weight: f64,
    /// The share of the way from the chord's middle to the pole.
    pub rho: f64,
    /// Eccentricity: 0 circle, less than 1 ellipse, 1 parabola, more hyperbola. The square root of rounding near a circle.
    pub eccentricity: f64,
}

/// The standard middle weight of a shape factor between 0 and 1.
///
/// # Errors
/// A factor that is not between 0 and 1.
pub fn weight_of_rho(rho: f64) -> Result<f64, Error> {
    if rho > 0.0 && rho < 1.0 {
        return Ok(rho / (1.0 - rho));
    }
    invalid(format!("rho: {rho} is not between 0 and 1"))
}

/// The conic of three poles and weights.
///
/// # Errors
/// Numbers that are not finite, weights that are not positive, poles in one line; by name and index.
pub fn conic(poles: [Vector; 3], weights: [f64; 3]) -> Result<Conic, Error> {
    if let Some(i) = weights.iter().position(|w| !(w.is_finite() && *w > 0.0)) {
        return invalid(format!("weights: weight {i} is not positive and finite"));
    }
    let weight = weights[1] / (weights[0].sqrt() * weights[2].sqrt());
    let family = Family::new(poles)?;
    let rho = weight / (1.0 + weight);
    Ok(Conic { weight, rho, eccentricity: family.eccentricity(weight * weight) })
}

/// The standard middle weights with which the arc over three poles has an eccentricity: none, one or two, in rising order. Up to the
/// rounding of the poles: a circle over legs of equal length is found, over legs that differ there is none.
///
/// # Errors
/// As [`conic`]; an eccentricity that is negative or not finite.
pub fn weights_of_eccentricity(poles: [Vector; 3], eccentricity: f64) -> Result<Vec<f64>, Error> {
    if !eccentricity.is_finite() || eccentricity < 0.0 {
        return invalid(format!(
            "eccentricity: {eccentricity} is not a finite number of at least 0"
        ));
    }
    let family = Family::new(poles)?;
    let square = eccentricity * eccentricity;
    // D (2 - e^2)^2 = (1 - e^2) T^2, divided by w^2 where it can be: a parabola has D = 0.
    let (p, q) = ((2.0 - square) * (2.0 - square), 1.0 - square);
    let [a, b, c] = [
        p * family.d2 - q * family.t1 * family.t1,
        p * family.d1 - 2.0 * q * family.t0 * family.t1,
        -q * family.t0 * family.t0,
    ];
    let mut found: Vec<f64> = roots(a, b, c).into_iter().filter(|x| *x > 0.0).collect();
    // The equation forgets on which side of a hyperbola's asymptotes the curve is: only true ones stay.
    let near =
        |x: &f64| (family.eccentricity(*x) - eccentricity).abs() <= 1e-6 * (1.0 + eccentricity);
    found.retain(near);
    found.sort_by(f64::total_cmp);
    found.dedup_by(|x, y| (*x - *y).abs() <= 1e-12 * *y);
    Ok(found.into_iter().map(f64::sqrt).collect())
}

/// The conics over a triangle: trace and determinant of the quadratic part as functions of `x = w^2`, `T = t0 + t1 x`,
/// `D = d1 x + d2 x^2`.
struct Family {
    t0: f64,
    t1: f64,
    d1: f64,
    d2: f64,
}

impl Family {
    fn new(poles: [Vector; 3]) -> Result<Self, Error> {
        for (i, pole) in poles.iter().enumerate() {
            if pole.iter().any(|x| !x.is_finite() || x.abs() > 1e100) {
                return invalid(format!("poles: pole {i} is not finite or beyond 1e100"));
            }
        }
        // In units of the longer leg, so that nothing overflows.
        let (left, right) = (sub(poles[0], poles[1]), sub(poles[2], poles[1]));
        let unit = norm(left).max(norm(right));
        let [left, right] = [left, right].map(|leg| leg.map(|x| x / unit));
        let area = norm(cross(left, right));
        if area.is_nan() || area <= 1e-12 {
            return invalid("poles: poles 0, 1 and 2 are in one line".into());
        }
        // Gradients of a and c in the plane: dual to the legs; b = 1 - a - c.
        let (ll, lr, rr) = (dot(left, left), dot(left, right), dot(right, right));
        let square = area * area;
        // Products of the gradients: aa = |grad a|^2 = rr / area^2 and so on.
        let (aa, ac, cc) = (rr / square, -lr / square, ll / square);
        let bb = aa + 2.0 * ac + cc;
        // M = grad b grad b^T - 2 x (grad a grad c^T + grad c grad a^T), in the basis of the gradients; det [a c] = 1 / area.
        Ok(Self { t0: bb, t1: -4.0 * ac, d1: 4.0 / square, d2: -4.0 / square })
    }

    fn eccentricity(&self, x: f64) -> f64 {
        let (t, d) = (self.t0 + self.t1 * x, (self.d1 + self.d2 * x) * x);
        let root = (t * t - 4.0 * d).max(0.0).sqrt();
        // The eigenvalues. In the centre `b^2 - 4 x a c` is x / (x - 1): it has the sign of the lesser eigenvalue's term on the conic
        // whether that is an ellipse or a hyperbola, so that the foci lie on its axis.
        let (high, low) = (0.5 * (t + root), 0.5 * (t - root));
        let square = 1.0 - low / high;
        square.max(0.0).sqrt()
    }
}

/// Real roots of `a x^2 + b x + c`; a discriminant within rounding of 0 is 0.
fn roots(a: f64, b: f64, c: f64) -> Vec<f64> {
    let scale = a.abs().max(b.abs()).max(c.abs());
    if a.abs() <= 1e-15 * scale {
        return if b == 0.0 { Vec::new() } else { vec![-c / b] };
    }
    let mut inside = b * b - 4.0 * a * c;
    if inside.abs() <= 1e-14 * (b * b).max((4.0 * a * c).abs()) {
        inside = 0.0;
    }
    if inside < 0.0 {
        return Vec::new();
    }
    let sum = -0.5 * (b + inside.sqrt().copysign(b));
    if sum == 0.0 { vec![0.0] } else { vec![sum / a, c / sum] }
}
