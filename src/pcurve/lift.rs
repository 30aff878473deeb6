//! Lift: from a pcurve to its image in space.
//!
//! ```text
//!   isoline              the isocurve, its part                              exact
//!   lines, low degrees   S(p(t)) composed, one span for each span crossed    exact: degree d (p + q)
//!   otherwise            a spline near the composed curve                    deviation proven
//! ```
//!
//! The image has the parameter of the pcurve. An arc is lifted in its NURBS form, over the same angles: the same places, the
//! angle of the pcurve at the ends of its quarter turns only.
//!
//! Limit: exact means up to the rounding of the poles; how much that is, is measured like every deviation.

use super::compose::{Composer, Piece};
use super::deviation::{Deviation, deviation};
use super::{Direction, EllipseArc, Isoline, Pcurve, between, reversed_curve};
use crate::bounds::{add, scaled};
use crate::curve::Curve;
use crate::elementary::{angle, part};
use crate::error::Error;
use crate::fit::{Adaptive, of_function};
use crate::knots::MAX_DEGREE;
use crate::portable::SameDigits;
use crate::surface::Surface;

/// Highest degree of an exact image that is not an isocurve, by default: the composition of a line with a bicubic.
pub const EXACT_DEGREE: usize = 6;

/// Degree of fitted images.
const FITTED_DEGREE: usize = 5;

/// The share of the tolerance that a fit gets first, what is left of it after each refusal, and how often.
const FIRST_SHARE: f64 = 0.3;
const NEXT_SHARE: f64 = 0.1;
const ATTEMPTS: usize = 4;

/// What is asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LiftOptions {
    /// Greatest deviation of a fitted image. 0: 1e-7 of the surface's box diagonal.
    pub tolerance: f64,
    /// Exact images may have at most this degree; isocurves always are exact. 0: all images but isocurves are fitted.
    pub exact_degree: usize,
}

impl Default for LiftOptions {
    fn default() -> Self {
        Self { tolerance: 0.0, exact_degree: EXACT_DEGREE }
    }
}

/// The image of a pcurve.
#[derive(Clone, Debug, PartialEq)]
pub struct Lifted {
    /// The curve in space.
    pub curve: Curve,
    /// Proven: how far it is from the image at equal parameters.
    pub deviation: Deviation,
    /// Whether it is the image, up to rounding.
    pub exact: bool,
}

impl Lifted {
    /// Whether the deviation is proven to be within the tolerance asked for.
    pub fn is_within(&self, surface: &Surface, options: &LiftOptions) -> bool {
        self.deviation.bound <= options.tolerance_on(surface)
    }
}

impl LiftOptions {
    fn tolerance_on(&self, surface: &Surface) -> f64 {
        let (low, high) = surface.bounding_box();
        let diagonal = crate::bounds::norm(crate::bounds::sub(high, low));
        if self.tolerance > 0.0 { self.tolerance } else { 1e-7 * diagonal }
    }
}

impl Pcurve {
    /// The curve as a spline (u, v, 0) over the same domain. An arc becomes a NURBS of quarter turns, whose parameter is the angle at
    /// the ends of the quarters only.
    ///
    /// # Errors
    /// Memory that could not be had.
    pub fn as_spline(&self) -> Result<Curve, Error> {
        match self {
            Self::Isoline(_) => {
                let (a, b) = self.domain();
                Curve::new(&[a, a, b, b], 1, &[flat(self.start()), flat(self.end())], None)
            }
            Self::Polyline(line) => {
                let poles: Vec<[f64; 3]> = line.points().iter().map(|p| flat(*p)).collect();
                let (first, last) = self.domain();
                let middle = line.parameters().iter().copied();
                let knots: Vec<f64> = std::iter::once(first).chain(middle).chain([last]).collect();
                Curve::new(&knots, 1, &poles, None)
            }
            Self::Spline(curve) => Ok(curve.clone()),
            Self::Arc(arc) => quarters(self, arc),
        }
    }
}

impl Pcurve {
    /// The curve as a spline (u, v, 0) with the same parameter, and how far u and v of it may be off: an arc becomes a polynomial spline
    /// of its angle, everything else is as [`Self::as_spline`] has it.
    ///
    /// # Errors
    /// Memory that could not be had.
    pub fn as_spline_in_parameter(&self) -> Result<(Curve, [f64; 2]), Error> {
        let Self::Arc(arc) = self else { return Ok((self.as_spline()?, [0.0; 2])) };
        let (places, knots) = angle::spline(arc.angles);
        let place = |c: f64, s: f64, k: usize| arc.center[k] + c * arc.first[k] + s * arc.second[k];
        let poles: Vec<[f64; 3]> =
            places.iter().map(|&[c, s]| [place(c, s, 0), place(c, s, 1), 0.0]).collect();
        let off = [0, 1].map(|k| {
            let size = arc.first[k].abs() + arc.second[k].abs();
            angle::error(arc.angles) * size + 4.0 * f64::EPSILON * (size + arc.center[k].abs())
        });
        Ok((Curve::new(&knots, angle::DEGREE, &poles, None)?, off))
    }
}

fn flat([u, v]: [f64; 2]) -> [f64; 3] {
    [u, v, 0.0]
}

/// An arc in pieces of at most a quarter turn; the middle pole of each is where its end tangents meet.
fn quarters(curve: &Pcurve, arc: &EllipseArc) -> Result<Curve, Error> {
    let [a, b] = arc.angles;
    let count = ((b - a) / std::f64::consts::FRAC_PI_2 - 1e-9).ceil().max(1.0);
    let half = 0.5 * (b - a) / count;
    let mut knots = vec![a; 3];
    let (mut poles, mut weights) = (vec![flat(curve.start())], vec![1.0]);
    for k in 0..count as usize {
        let [from, to] = [k, k + 1].map(|k| between(a, b, k as f64 / count));
        let middle = 0.5 * (from + to);
        let reach = 1.0 / half.cosine();
        let (c, s) = (middle.cosine() * reach, middle.sine() * reach);
        poles.push(flat([0, 1].map(|i| arc.center[i] + c * arc.first[i] + s * arc.second[i])));
        poles.push(flat(curve.evaluate(to)));
        weights.extend([half.cosine(), 1.0]);
        knots.extend([to; 2]);
    }
    knots.push(b);
    Curve::new(&knots, 2, &poles, Some(&weights))
}

/// The image of a pcurve on a surface.
///
/// # Errors
/// [`Error::InvalidArgument`] for a pcurve that leaves the domain or a tolerance that is no length; [`Error::OutOfMemory`].
pub fn lift(surface: &Surface, pcurve: &Pcurve, options: &LiftOptions) -> Result<Lifted, Error> {
    if !(options.tolerance >= 0.0 && options.tolerance.is_finite()) {
        let text = format!("tolerance: {} is not a length", options.tolerance);
        return Err(Error::InvalidArgument(text));
    }
    lift_spline(&mut Composer::new(surface), &pcurve.as_spline()?, options)
}

/// As [`lift`], for a spline of the domain.
pub(crate) fn lift_spline(
    composer: &mut Composer,
    spline: &Curve,
    options: &LiftOptions,
) -> Result<Lifted, Error> {
    let surface = composer.surface();
    let range = [spline.domain().0, spline.domain().1];
    if let Some(line) = isoline(spline) {
        composer.check_inside(spline)?;
        let curve = over(&isocurve(surface, &line)?, range)?;
        let deviation = deviation(composer, spline, &curve, range, 0.0)?;
        return Ok(Lifted { curve, deviation, exact: true });
    }
    let degree = spline.degree() * (surface.knots_u().degree() + surface.knots_v().degree());
    if degree <= options.exact_degree.min(MAX_DEGREE) {
        let pieces = composer.compose(spline, range)?;
        let curve = joined(&pieces, surface.is_rational() || spline.is_rational())?;
        let deviation = deviation(composer, spline, &curve, range, 0.0)?;
        return Ok(Lifted { curve, deviation, exact: true });
    }
    composer.check_inside(spline)?;
    fitted(composer, spline, options)
}

/// The isoline that a line of the domain is.
fn isoline(spline: &Curve) -> Option<Isoline> {
    let [a, b] = spline.poles() else { return None };
    let fixed = match [a[0] == b[0], a[1] == b[1]] {
        [true, false] => Direction::U,
        [false, true] => Direction::V,
        _ => return None,
    };
    let along = fixed.other().index();
    let is_even = spline.degree() == 1
        && !spline.is_rational()
        && spline.knots().multiplicity(spline.domain().0) == 2;
    is_even.then(|| Isoline { fixed, at: a[fixed.index()], from: a[along], to: b[along] })
}

/// The same curve over another domain.
pub(crate) fn over(curve: &Curve, [start, end]: [f64; 2]) -> Result<Curve, Error> {
    let (a, b) = curve.domain();
    if (a, b) == (start, end) {
        return Ok(curve.clone());
    }
    let knots: Vec<f64> =
        curve.knots().values().iter().map(|t| between(start, end, (t - a) / (b - a))).collect();
    Curve::new(&knots, curve.degree(), curve.poles(), curve.weights())
}

fn isocurve(surface: &Surface, line: &Isoline) -> Result<Curve, Error> {
    let [u0, u1, v0, v1] = surface.domain();
    let (whole, [low, high]) = match line.fixed {
        Direction::U => (surface.isocurve_u(line.at.clamp(u0, u1)), [v0, v1]),
        Direction::V => (surface.isocurve_v(line.at.clamp(v0, v1)), [u0, u1]),
    };
    let ends = [line.from.min(line.to).max(low), line.from.max(line.to).min(high)];
    let curve = part(&whole, ends)?;
    Ok(if line.from < line.to { curve } else { reversed_curve(&curve) })
}

/// One curve from composed pieces: weights are scaled so that they go on from piece to piece.
fn joined(pieces: &[Piece], rational: bool) -> Result<Curve, Error> {
    let degree = pieces.first().map_or(1, |piece| piece.weights.len() - 1);
    let (mut knots, mut poles, mut weights) = (Vec::new(), Vec::new(), Vec::new());
    let mut last = 1.0;
    for (k, piece) in pieces.iter().enumerate() {
        let factor = last / piece.weights[0];
        knots.extend(std::iter::repeat_n(piece.range[0], if k == 0 { degree + 1 } else { degree }));
        let skipped = usize::from(k > 0);
        for (n, w) in piece.numerator.iter().zip(&piece.weights).skip(skipped) {
            poles.push(add(piece.center, scaled(*n, 1.0 / w)));
            weights.push(factor * w);
        }
        last = factor * piece.weights[degree];
    }
    let end = pieces.last().map_or(1.0, |piece| piece.range[1]);
    knots.extend(std::iter::repeat_n(end, degree + 1));
    Curve::new(&knots, degree, &poles, rational.then_some(&weights[..]))
}

/// A spline near the image.
fn fitted(composer: &mut Composer, spline: &Curve, options: &LiftOptions) -> Result<Lifted, Error> {
    let surface = composer.surface();
    let tolerance = options.tolerance_on(surface);
    let range = [spline.domain().0, spline.domain().1];
    let [u0, u1, v0, v1] = surface.domain();
    let image = |t: f64| {
        let [u, v, _] = spline.evaluate(t);
        Some(surface.evaluate(u.clamp(u0, u1), v.clamp(v0, v1)))
    };
    let breaks = corners(spline);
    let (mut share, mut best) = (FIRST_SHARE, None::<Lifted>);
    for _ in 0..ATTEMPTS {
        let asked = Adaptive {
            degree: FITTED_DEGREE,
            tolerance: share * tolerance,
            breaks: &breaks,
            ..Adaptive::default()
        };
        let curve = of_function(image, range, &asked)?.spline.curve()?;
        let found = deviation(composer, spline, &curve, range, FIRST_SHARE * tolerance)?;
        if best.as_ref().is_none_or(|best| found.bound < best.deviation.bound) {
            best = Some(Lifted { curve, deviation: found, exact: false });
        }
        if found.bound <= tolerance {
            break;
        }
        share *= NEXT_SHARE;
    }
    best.ok_or(Error::OutOfMemory)
}

/// Where the pcurve may have a corner, with the multiplicity of a knot of a fit there.
fn corners(spline: &Curve) -> Vec<(f64, usize)> {
    let (knots, (a, b)) = (spline.knots(), spline.domain());
    let inner = knots.spans().map(|span| knots.values()[span]).filter(|&t| a < t && t < b);
    let smooth = |t: f64| spline.degree().saturating_sub(knots.multiplicity(t));
    let corner = |t: f64| (t, FITTED_DEGREE.saturating_sub(smooth(t)).max(1));
    inner.map(corner).collect()
}
