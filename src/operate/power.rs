//! Power form: the coefficients of the powers of a local parameter, and back.
//!
//! ```text
//!   a_k = C(p,k) sum_i (-1)^(k-i) C(k,i) b_i,     b_k = sum_{i<=k} C(k,i) / C(p,i) a_i
//! ```
//!
//! in homogeneous coordinates, with the local parameter t from 0 to 1 over the piece.
//!
//! Limit: the power form loses digits as the degree grows, up to a factor of 3^p; it is for exchange and for closed forms, not for computing.

use super::Surface;
use super::reparametrisation::{rational, rational_surface};
use crate::bezier::binomial;
use crate::curve::Curve;
use crate::curve::insertion::{Weighted, checked};
use crate::error::Error;
use crate::knots::{KnotError, MAX_DEGREE, MAX_MAGNITUDE};

/// A homogeneous coefficient: `(w x, w y, w z, w)`.
pub type Coefficient = [f64; 4];

/// A polynomial or rational piece of a curve in powers of a local parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct PowerCurve {
    /// First and last parameter; t = 0 at the first and 1 at the last.
    pub domain: [f64; 2],
    /// The coefficient of t^k at k: degree + 1 of them. Polynomial: the last coordinate is 1, then 0.
    pub coefficients: Vec<Coefficient>,
}

/// A polynomial or rational patch in powers of two local parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct PowerSurface {
    /// u0, u1, v0, v1; s = 0 at u0 and 1 at u1, t = 0 at v0 and 1 at v1.
    pub domain: [f64; 4],
    /// Degrees in s and t.
    pub degree: [usize; 2],
    /// The coefficient of s^k t^l at `k * (degree[1] + 1) + l`.
    pub coefficients: Vec<Coefficient>,
}

impl Curve {
    /// The power form of each Bezier piece, in order.
    ///
    /// # Errors
    /// Memory that could not be had.
    pub fn power_pieces(&self) -> Result<Vec<PowerCurve>, Error> {
        let piece = |piece: Self| -> Result<PowerCurve, Error> {
            let (start, end) = piece.domain();
            let mut coefficients = raised(&piece.strand()?, self.is_rational());
            to_power(&mut coefficients, [self.degree(), 0]);
            Ok(PowerCurve { domain: [start, end], coefficients })
        };
        self.bezier_pieces()?.into_iter().map(piece).collect()
    }

    /// The Bezier piece of a power form. Its weights have to be positive; where only a part of it has positive ones, give that part.
    ///
    /// # Errors
    /// A count of coefficients that is not 2 to 32, a coefficient that is not finite, an empty domain, by name; poles with weights that are not positive.
    pub fn from_power(power: &PowerCurve) -> Result<Self, Error> {
        let degree = power.coefficients.len().wrapping_sub(1);
        check(&power.coefficients, &[("degree", degree)])?;
        let [start, end] = power.domain;
        let mut net = power.coefficients.clone();
        from_power(&mut net, [degree, 0]);
        let knots = knots(degree, start, end)?;
        let curve = rational(checked(&knots, degree)?, &lowered(&net)?)?;
        if curve.is_rational() {
            return Ok(curve);
        }
        Self::new(&knots, degree, curve.poles(), None)
    }
}

impl Surface {
    /// The power form of each Bezier patch, in the order of [`Surface::bezier_pieces`], and the numbers of patches.
    ///
    /// # Errors
    /// Memory that could not be had.
    pub fn power_pieces(&self) -> Result<(Vec<PowerSurface>, [usize; 2]), Error> {
        let (pieces, counts) = self.bezier_pieces()?;
        let degree = [self.knots_u().degree(), self.knots_v().degree()];
        let piece = |piece: Self| -> Result<PowerSurface, Error> {
            let mut coefficients = raised(&piece.rows()?, self.is_rational());
            to_power(&mut coefficients, degree);
            Ok(PowerSurface { domain: piece.domain(), degree, coefficients })
        };
        Ok((pieces.into_iter().map(piece).collect::<Result<_, _>>()?, counts))
    }

    /// The Bezier patch of a power form, as [`Curve::from_power`].
    ///
    /// # Errors
    /// As for curves.
    pub fn from_power(power: &PowerSurface) -> Result<Self, Error> {
        let [p, q] = power.degree;
        check(&power.coefficients, &[("degree_u", p), ("degree_v", q)])?;
        let [u0, u1, v0, v1] = power.domain;
        let mut net = power.coefficients.clone();
        from_power(&mut net, [p, q]);
        let (u, v) = (knots(p, u0, u1)?, knots(q, v0, v1)?);
        let surface = rational_surface(&checked(&u, p)?, &checked(&v, q)?, &lowered(&net)?)?;
        if surface.is_rational() {
            return Ok(surface);
        }
        Self::new(&u, &v, p, q, surface.poles(), p + 1, q + 1, None)
    }
}

fn check(coefficients: &[Coefficient], degrees: &[(&str, usize)]) -> Result<(), Error> {
    let mut expected = 1;
    for &(name, degree) in degrees {
        if !(1..=MAX_DEGREE).contains(&degree) {
            return Err(KnotError::Degree { found: degree }.named(&name["degree".len()..]));
        }
        expected *= degree + 1;
    }
    if coefficients.len() != expected {
        let found = coefficients.len();
        let text = format!("coefficients: {found} given, {expected} expected");
        return Err(Error::InvalidArgument(text));
    }
    let bad = |a: &Coefficient| !a.iter().all(|x| x.abs() <= MAX_MAGNITUDE);
    match coefficients.iter().position(bad) {
        Some(i) => Err(Error::InvalidArgument(format!(
            "coefficients: coefficient {i} is not finite or beyond 1e100"
        ))),
        None => Ok(()),
    }
}

fn knots(degree: usize, start: f64, end: f64) -> Result<Vec<f64>, Error> {
    if !(start < end && start.abs() <= MAX_MAGNITUDE && end.abs() <= MAX_MAGNITUDE) {
        let text = format!("domain: [{start}, {end}] is empty or not finite");
        return Err(Error::InvalidArgument(text));
    }
    let mut values = vec![start; degree + 1];
    values.resize(2 * degree + 2, end);
    Ok(values)
}

fn raised(net: &[Weighted], is_rational: bool) -> Vec<Coefficient> {
    let raise = |point: &Weighted| {
        let (w, [x, y, z]) = (if is_rational { point.weight } else { 1.0 }, point.pole);
        [w * x, w * y, w * z, w]
    };
    net.iter().map(raise).collect()
}

fn lowered(net: &[Coefficient]) -> Result<Vec<Weighted>, Error> {
    if let Some(i) = net.iter().position(|h| h[3] <= 0.0) {
        let text = format!("coefficients: the Bezier weight {i} is not positive");
        return Err(Error::Unsupported(text));
    }
    let lower = |h: &Coefficient| Weighted { pole: [0, 1, 2].map(|x| h[x] / h[3]), weight: h[3] };
    Ok(net.iter().map(lower).collect())
}

/// Runs over the strands of a net in both directions; `step(strand)` changes one.
fn strands(net: &mut [Coefficient], [p, q]: [usize; 2], step: impl Fn(&mut [Coefficient])) {
    let width = q + 1;
    for row in net.chunks_exact_mut(width) {
        step(row);
    }
    for column in 0..width {
        let mut strand: Vec<Coefficient> = (0..=p).map(|i| net[i * width + column]).collect();
        step(&mut strand);
        for (i, h) in strand.into_iter().enumerate() {
            net[i * width + column] = h;
        }
    }
}

/// Forward differences, times binomials.
fn to_power(net: &mut [Coefficient], degree: [usize; 2]) {
    strands(net, degree, |strand| {
        let p = strand.len() - 1;
        for level in 1..=p {
            for k in (level..=p).rev() {
                strand[k] = std::array::from_fn(|x| strand[k][x] - strand[k - 1][x]);
            }
        }
        for (k, h) in strand.iter_mut().enumerate() {
            *h = h.map(|x| x * binomial(p, k));
        }
    });
}

/// The reverse of [`to_power`].
fn from_power(net: &mut [Coefficient], degree: [usize; 2]) {
    strands(net, degree, |strand| {
        let p = strand.len() - 1;
        for (k, h) in strand.iter_mut().enumerate() {
            *h = h.map(|x| x / binomial(p, k));
        }
        for level in (1..=p).rev() {
            for k in level..=p {
                strand[k] = std::array::from_fn(|x| strand[k][x] + strand[k - 1][x]);
            }
        }
    });
}
