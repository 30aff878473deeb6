//! Other parameters for the same points: affine, reversed, and rational linear (Moebius).
//!
//! The Moebius maps of an interval onto itself are one family. With `x` the share of the domain that lies before the
//! parameter and `c > 0` the speed of the new parameter at the start,
//!
//! ```text
//!   y = c x / (1 + (c - 1) x),     x = y / (c (1 - y) + y),     w_i' = w_i prod_{j=1..p} d(u_{i+j}),   d(x) = c / (1 + (c - 1) x)
//! ```
//!
//! Poles stay, knots move like parameters. A polynomial curve becomes rational. `c = (w_n / w_0)^(1/p)` makes the end weights of a
//! Bezier piece equal: the standard form of conics.
//!
//! Reference: Lee, Lucian, *Moebius reparametrizations of rational B-splines*, 1991; Piegl, Tiller, section 6.4.

use super::{Direction, Surface};
use crate::curve::Curve;
use crate::curve::insertion::{Weighted, checked, transposed};
use crate::error::Error;
use crate::knots::{Knots, MAX_MAGNITUDE};

impl Curve {
    /// The same curve over another domain: `new(start + x (end - start)) = old(u0 + x (u1 - u0))`. Exact.
    ///
    /// # Errors
    /// A new domain that is empty, not finite, or too short to keep its knots apart; memory that could not be had.
    pub fn with_domain(&self, start: f64, end: f64) -> Result<Self, Error> {
        let knots = affine(self.knots(), start, end).map_err(|error| named(error, ""))?;
        self.like(knots, &self.strand()?)
    }

    /// The same curve run through from its end to its start, over the same domain: `new(u) = old(u0 + u1 - u)`. Exact.
    ///
    /// # Errors
    /// Knots that rounding makes equal too often; memory that could not be had.
    pub fn reverse(&self) -> Result<Self, Error> {
        let mut strand = self.strand()?;
        strand.reverse();
        self.like(reversed(self.knots())?, &strand)
    }

    /// The same curve in a parameter that is a Moebius function of the old one, over the same domain; `speed` is the derivative of the new
    /// parameter by the old one at the start. The curve is clamped first. Exact.
    ///
    /// # Errors
    /// A speed that is not positive and finite, or that moves weights beyond 1e-100 .. 1e100.
    pub fn reparametrise(&self, speed: f64) -> Result<Self, Error> {
        let clamped = self.clamp()?;
        let (knots, strand) = moebius(clamped.knots(), speed, clamped.strand()?)?;
        rational(knots, &strand)
    }

    /// The parameter after [`Curve::reparametrise`] of the point at `u`.
    pub fn reparametrised(&self, speed: f64, u: f64) -> f64 {
        moved(self.domain(), speed, u)
    }
}

impl Surface {
    /// The same surface over another domain, as [`Curve::with_domain`]. Exact.
    ///
    /// # Errors
    /// As for curves.
    pub fn with_domain(&self, [u0, u1, v0, v1]: [f64; 4]) -> Result<Self, Error> {
        let knots_u = affine(self.knots_u(), u0, u1).map_err(|error| named(error, "_u"))?;
        let knots_v = affine(self.knots_v(), v0, v1).map_err(|error| named(error, "_v"))?;
        self.like(knots_u, knots_v, &self.rows()?)
    }

    /// The same surface with one direction run through backwards, over the same domain. Exact.
    ///
    /// # Errors
    /// As for curves.
    pub fn reverse(&self, direction: Direction) -> Result<Self, Error> {
        let (knots, mut strands) = (reversed(self.knots(direction))?, self.strands(direction)?);
        strands.chunks_exact_mut(knots.pole_count()).for_each(<[Weighted]>::reverse);
        self.with_strands(direction, knots, &strands)
    }

    /// The same surface in a parameter that is a Moebius function of the old one in a direction, as [`Curve::reparametrise`]. Exact.
    ///
    /// # Errors
    /// As for curves.
    pub fn reparametrise(&self, direction: Direction, speed: f64) -> Result<Self, Error> {
        let clamped = self.clamp()?;
        let strands = clamped.strands(direction)?;
        let (knots, strands) = moebius(clamped.knots(direction), speed, strands)?;
        let (u, v) = (clamped.knots_u().clone(), clamped.knots_v().clone());
        match direction {
            Direction::U => {
                rational_surface(&knots, &v, &transposed(&strands, knots.pole_count())?)
            }
            Direction::V => rational_surface(&u, &knots, &strands),
        }
    }
}

fn named(error: Error, suffix: &str) -> Error {
    match error {
        Error::InvalidArgument(text) if text.starts_with("domain:") => {
            Error::InvalidArgument(text.replacen("domain", &format!("domain{suffix}"), 1))
        }
        Error::InvalidArgument(text) => {
            Error::InvalidArgument(text.replacen("knots", &format!("knots{suffix}"), 1))
        }
        other => other,
    }
}

/// The knots over another domain; the ends are met bit for bit.
fn affine(knots: &Knots, start: f64, end: f64) -> Result<Knots, Error> {
    let (u0, u1) = knots.domain();
    if !(start < end && start.abs() <= MAX_MAGNITUDE && end.abs() <= MAX_MAGNITUDE) {
        let text = format!("domain: [{start}, {end}] is empty or not finite");
        return Err(Error::InvalidArgument(text));
    }
    if (u0, u1) == (start, end) {
        return Ok(knots.clone());
    }
    let scale = (end - start) / (u1 - u0);
    let map = |&u: &f64| {
        let moved = start + (u - u0) * scale;
        // Rounding is monotone, but must not carry a knot over the ends.
        if u >= u1 { (end + (u - u1) * scale).max(end) } else { moved.min(end) }
    };
    let values: Vec<f64> = knots.values().iter().map(map).collect();
    checked(&values, knots.degree())
}

fn reversed(knots: &Knots) -> Result<Knots, Error> {
    let (u0, u1) = knots.domain();
    let mirror = |&u: &f64| {
        let moved = u0 + (u1 - u);
        if u <= u0 { (u1 + (u0 - u)).max(u1) } else { moved.min(u1) }
    };
    let values: Vec<f64> = knots.values().iter().rev().map(mirror).collect();
    checked(&values, knots.degree())
}

/// Where a parameter of the domain goes.
fn moved((u0, u1): (f64, f64), c: f64, u: f64) -> f64 {
    if u >= u1 {
        return u1;
    }
    let (before, behind) = ((u - u0) / (u1 - u0), (u1 - u) / (u1 - u0));
    (u0 + (u1 - u0) * (c * before / (behind + c * before))).clamp(u0, u1)
}

/// Knots and strands of a clamped vector in the new parameter.
fn moebius(
    knots: &Knots,
    c: f64,
    mut strands: Vec<Weighted>,
) -> Result<(Knots, Vec<Weighted>), Error> {
    if !(c > 0.0 && c.is_finite()) {
        return Err(Error::InvalidArgument(format!("speed: {c} is not positive and finite")));
    }
    let ((u0, u1), p) = (knots.domain(), knots.degree());
    let factor = |u: f64| c * (u1 - u0) / ((u1 - u) + c * (u - u0));
    let values: Vec<f64> = knots.values().iter().map(|&u| moved((u0, u1), c, u)).collect();
    for strand in strands.chunks_exact_mut(knots.pole_count()) {
        for (i, point) in strand.iter_mut().enumerate() {
            let inner = &knots.values()[i + 1..=i + p];
            point.weight = inner.iter().fold(point.weight, |w, &u| w * factor(u));
        }
    }
    Ok((checked(&values, p)?, strands))
}

/// A curve of weighted poles, checked.
pub(super) fn rational(knots: Knots, strand: &[Weighted]) -> Result<Curve, Error> {
    let (poles, weights): (Vec<_>, Vec<_>) =
        strand.iter().map(|point| (point.pole, point.weight)).unzip();
    Curve::new(knots.values(), knots.degree(), &poles, Some(&weights))
}

/// A surface of weighted poles with v running fastest, checked.
pub(super) fn rational_surface(u: &Knots, v: &Knots, net: &[Weighted]) -> Result<Surface, Error> {
    let (poles, weights): (Vec<_>, Vec<_>) =
        net.iter().map(|point| (point.pole, point.weight)).unzip();
    let (counts, degrees) = ([u.pole_count(), v.pole_count()], [u.degree(), v.degree()]);
    Surface::new(
        u.values(),
        v.values(),
        degrees[0],
        degrees[1],
        &poles,
        counts[0],
        counts[1],
        Some(&weights),
    )
}
