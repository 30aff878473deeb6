//! Algorithm 1: a face under another parametrisation of its surface.
//!
//! ```text
//!   isoline                         its ends are mapped: an isoline
//!   polyline                        its vertices are mapped; more are set where a mapped line bends
//!   spline or arc, linear map       poles, or centre and half diameters, are mapped: the same kind
//!   spline or arc, any other map    a polyline or a fitted spline within the tolerance on the surface
//!   a map that turns directions     then every pcurve and every loop is reversed, and the sense of edges and face with them
//! ```
//!
//! The deviation is the distance in space of the old and the new image at the same parameter of the pcurve. There are three ways to it:
//!
//! ```text
//!   derivatives    E, the difference of the mapped curve and its replacement over an interval of length h:
//!                  |E| <= max(|E(a)|, |E(b)|) + h^2 / 8 max |E''|,   |(f(c))''| <= |f''| |c'|^2 + |f'| |c''|,
//!                  |dS| <= |Su| |E_u| + |Sv| |E_v|                      cheap; as good as the bounds are
//!   images         both images as Bernstein polynomials (`imager`)      sharp, whatever the transform is
//!   samples        where a surface is given by a function               not proven, and the result says so
//! ```
//!
//! Polylines take the first way where its bounds are good, and the second where they would cost vertices.
//!
//! Reference: Yang, Yong, *Parameter transformation of trimmed surfaces*, Algorithm 1. Beyond it: mapped lines of polylines are
//! checked, splines may be fitted, deviations are proven.

use super::compare::{Apart, compare};
use super::imager::{Drawn, Imager};
use super::speed::{Motion, motion, speeds};
use super::{Coedge, Loop, Support, TrimmedSurface, invalid};
use crate::bounds::{norm, sub};
use crate::error::Error;
use crate::fit::{Adaptive, of_function};
use crate::pcurve::{Parameters, Pcurve};
use crate::transform::{Relation, Transform};

/// Default tolerance as a share of the diagonal of the surface's box.
pub const DEFAULT_TOLERANCE: f64 = 1e-7;

/// Most vertices of a polyline.
pub const MOST_VERTICES: usize = 1 << 20;

/// Where deviations are only measured: samples in an interval, and how far beyond them it may be.
const SAMPLES: usize = 5;
const SAFETY: f64 = 1.5;

/// Halvings after which bounds of derivatives are no longer made tighter.
const LEVELS: usize = 6;

/// Times that a fit is made tighter until its error is proven.
const ATTEMPTS: usize = 8;

/// A bound from derivatives this many times the tolerance costs twice the vertices: images are compared instead.
const WORTH: f64 = 4.0;

/// What becomes of free-form curves under maps that are not linear.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Replacement {
    /// A polyline.
    #[default]
    Polyline,
    /// A cubic spline.
    Spline,
    /// A polyline; the vertices of polylines are mapped and none is added: they stand for themselves.
    Vertices,
}

/// How a face is changed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ChangeOptions {
    /// Largest deviation in space. 0: [`DEFAULT_TOLERANCE`] of the surface's box diagonal.
    pub tolerance: f64,
    /// What becomes of free-form curves.
    pub replacement: Replacement,
}

/// A changed face.
#[derive(Clone, Debug)]
pub struct Changed {
    /// The face.
    pub face: TrimmedSurface,
    /// Largest distance on the new surface of a pcurve's image from the mapped one, at the same parameter. Where vertices stand for
    /// themselves they count alone.
    pub deviation: f64,
    /// Whether the deviation is proven, or the largest one at samples.
    pub proven: bool,
    /// Largest distance of the old and the new surface at places that belong together.
    pub surface_deviation: f64,
    /// Whether that is proven, or the largest one at [`PLACES`] squared places.
    ///
    /// [`PLACES`]: super::PLACES
    pub surface_proven: bool,
}

impl TrimmedSurface {
    /// The face on `support`, which is this face's surface in the parameters `transform(u, v)`. Edges stay; the face keeps its
    /// normal.
    ///
    /// # Errors
    /// A transform that does not map one domain to the other; a surface that differs from this one by more than the tolerance, with
    /// the place; a curve that would take more than [`MOST_VERTICES`].
    pub fn changed(
        &self,
        transform: &Transform,
        support: Support,
        options: &ChangeOptions,
    ) -> Result<Changed, Error> {
        self.changed_known(transform, support, options, None)
    }

    /// As [`Self::changed`], where a bound of the distance of the surfaces may be known.
    pub(super) fn changed_known(
        &self,
        transform: &Transform,
        support: Support,
        options: &ChangeOptions,
        known: Option<f64>,
    ) -> Result<Changed, Error> {
        check_domains(transform, self.support(), &support)?;
        let diagonal = support.bounding_box()?.diagonal();
        let tolerance = match options.tolerance {
            0.0 => DEFAULT_TOLERANCE * diagonal,
            t if t > 0.0 && t.is_finite() => t,
            t => return invalid(format!("tolerance: {t} is not a positive length")),
        };
        let apart = match known.filter(|bound| *bound <= tolerance) {
            Some(distance) => Apart { distance, proven: true },
            None => compare(transform, self.support(), &support, tolerance)?,
        };
        let mut mapper = Mapper {
            from: self.support(),
            to: &support,
            imagers: Imager::of(self.support())?.zip(Imager::of(&support)?),
            transform,
            speeds: speeds(&support)?,
            bounds: [&transform.u, &transform.v].map(Relation::derivative_bounds),
            kinks: [&transform.u, &transform.v].map(Relation::kinks),
            tolerance,
            replacement: options.replacement,
        };
        let (mut deviation, mut proven) = (0.0f64, true);
        let mut loops = Vec::new();
        for chain in self.loops() {
            let mut coedges = Vec::new();
            for coedge in &chain.coedges {
                let image = mapper.image(&coedge.pcurve)?;
                deviation = deviation.max(image.deviation);
                proven &= image.proven;
                let same_parameter = coedge.same_parameter && image.same_parameter;
                coedges.push(Coedge { pcurve: image.pcurve, same_parameter, ..*coedge });
            }
            loops.push(Loop { kind: chain.kind, coedges });
        }
        let turned = !transform.keeps_direction();
        if turned {
            loops.iter_mut().for_each(reverse);
        }
        let flipped = self.is_flipped() != turned;
        drop(mapper);
        let face = Self::new(support, self.edges().to_vec(), loops, flipped)?;
        let Apart { distance: surface_deviation, proven: surface_proven } = apart;
        Ok(Changed { face, deviation, proven, surface_deviation, surface_proven })
    }
}

/// The loop run through backwards.
pub(super) fn reverse(chain: &mut Loop) {
    chain.coedges.reverse();
    for coedge in &mut chain.coedges {
        coedge.pcurve = coedge.pcurve.reversed();
        coedge.reversed = coedge.edge.is_some() && !coedge.reversed;
    }
}

fn check_domains(transform: &Transform, from: &Support, to: &Support) -> Result<(), Error> {
    for (name, given, expected) in
        [("domain", transform.domain(), from.domain()), ("image", transform.image(), to.domain())]
    {
        for k in 0..4 {
            let length = expected[k / 2 * 2 + 1] - expected[k / 2 * 2];
            if (given[k] - expected[k]).abs() > 1e-9 * length {
                return invalid(format!(
                    "transform: entry {k} of its {name} is {}, that of the surface is {}",
                    given[k], expected[k]
                ));
            }
        }
    }
    Ok(())
}

/// A mapped curve.
struct Image {
    pcurve: Pcurve,
    deviation: f64,
    proven: bool,
    same_parameter: bool,
}

struct Mapper<'a> {
    from: &'a Support,
    to: &'a Support,
    /// For images on both; none where one is a function.
    imagers: Option<(Imager<'a>, Imager<'a>)>,
    transform: &'a Transform,
    /// Bounds of |Ss| and |St| of the new surface.
    speeds: Option<[f64; 2]>,
    /// Bounds of the derivatives of both relations, and where they have kinks.
    bounds: [Option<[f64; 2]>; 2],
    kinks: [Vec<f64>; 2],
    tolerance: f64,
    replacement: Replacement,
}

impl Mapper<'_> {
    fn image(&mut self, pcurve: &Pcurve) -> Result<Image, Error> {
        let exact = |pcurve: Pcurve, same_parameter: bool| Image {
            pcurve,
            deviation: 0.0,
            proven: true,
            same_parameter,
        };
        let transform = self.transform;
        let point = |p: Parameters| transform.apply(p);
        match pcurve {
            Pcurve::Isoline(line) => {
                // Which way the image of the running parameter goes is all that the vector tells.
                let exchanged =
                    |[du, dv]: Parameters| if transform.swap { [dv, du] } else { [du, dv] };
                let running = [&transform.u, &transform.v][line.fixed.other().index()];
                Ok(exact(pcurve.mapped_by(&point, &exchanged)?, running.is_linear()))
            }
            _ if transform.is_linear() => {
                let vector = |d: Parameters| transform.linear_part(d).unwrap_or(d);
                Ok(exact(pcurve.mapped_by(&point, &vector)?, true))
            }
            Pcurve::Polyline(_) if self.replacement == Replacement::Vertices => {
                Ok(exact(pcurve.mapped_by(&point, &|d| d)?, true))
            }
            _ if self.replacement == Replacement::Spline => self.fitted(pcurve),
            _ => self.polyline(pcurve),
        }
    }

    fn place(&self, pcurve: &Pcurve, t: f64) -> Parameters {
        self.transform.apply(self.from.clamped(pcurve.evaluate(t)))
    }

    /// Bounds of the derivatives of the mapped curve on a part without corners where the curve itself moves as `old`, and whether no
    /// kink of the transform lies inside. None where a function is in the way.
    fn mapped_motion(
        &self,
        pcurve: &Pcurve,
        old: &Motion,
        range: [f64; 2],
    ) -> Option<(Motion, bool)> {
        let mut new = Motion::default();
        let mut smooth = true;
        for k in 0..2 {
            let [f1, f2] = self.bounds[k]?;
            new.first[k] = f1 * old.first[k];
            new.second[k] = f2 * old.first[k] * old.first[k] + f1 * old.second[k];
            if !self.kinks[k].is_empty() {
                let middle = pcurve.evaluate(range[0] + 0.5 * (range[1] - range[0]))[k];
                let reach = 0.5 * (range[1] - range[0]) * old.first[k] * (1.0 + 1e-9);
                smooth &= !self.kinks[k].iter().any(|x| (x - middle).abs() <= reach);
            }
        }
        if self.transform.swap {
            new.first.swap(0, 1);
            new.second.swap(0, 1);
        }
        Some((new, smooth))
    }

    /// A bound in space of the difference of the mapped curve and a replacement, which miss each other at the ends of the range by
    /// `off`; `moves` has the motions of the curve itself and of the replacement.
    fn bound(
        &self,
        pcurve: &Pcurve,
        range: [f64; 2],
        moves: [&Motion; 2],
        off: [f64; 2],
    ) -> Option<f64> {
        let speeds = self.speeds?;
        let (own, smooth) = self.mapped_motion(pcurve, moves[0], range)?;
        let (h, other) = (range[1] - range[0], moves[1]);
        let bound = |k: usize| {
            let between = if smooth {
                h * h / 8.0 * (own.second[k] + other.second[k])
            } else {
                // Both move by the straight line's share from each end.
                h / 2.0 * (own.first[k] + own.first[k].max(other.first[k]))
            };
            speeds[k] * (off[k] + between)
        };
        Some(bound(0) + bound(1))
    }

    /// The largest deviation at samples inside a range, and a margin.
    fn measured(&self, pcurve: &Pcurve, range: [f64; 2], new: impl Fn(f64) -> Parameters) -> f64 {
        let mut most: f64 = 0.0;
        for k in 1..=SAMPLES {
            let t = range[0] + (range[1] - range[0]) * k as f64 / (SAMPLES + 1) as f64;
            let there = self.from.evaluate(pcurve.evaluate(t));
            let off = norm(sub(there, self.to.evaluate(new(t))));
            most = if off.is_nan() { f64::INFINITY } else { most.max(off) };
        }
        most * SAFETY
    }

    /// Whether bounds from derivatives exist at all for this curve.
    fn is_provable(&self, pcurve: &Pcurve) -> bool {
        let (a, b) = pcurve.domain();
        let none = Motion::default();
        self.speeds.is_some() && self.mapped_motion(pcurve, &none, [a, b]).is_some()
    }

    /// The curve ready for the comparison of images.
    fn drawn(&self, pcurve: &Pcurve) -> Result<Option<Drawn>, Error> {
        self.imagers.as_ref().map(|(from, _)| from.drawn(pcurve)).transpose()
    }

    /// A bound of the distance of the old image and that of a replacement over a range; none where it cannot be had.
    fn compared(
        &mut self,
        old: &Option<Drawn>,
        new: &Pcurve,
        range: [f64; 2],
    ) -> Result<Option<f64>, Error> {
        let (Some(old), Some((from, to))) = (old, &mut self.imagers) else { return Ok(None) };
        let new = to.drawn(new)?;
        Ok(from.apart(old, to, &new, range, self.tolerance))
    }

    /// The intervals between the corners of a curve, in order, the last one first.
    fn ranges(pcurve: &Pcurve) -> Vec<[f64; 2]> {
        let (a, b) = pcurve.domain();
        let places = [vec![a], pcurve.breaks(), vec![b]].concat();
        places.windows(2).rev().map(|w| [w[0], w[1]]).collect()
    }

    /// How far the line between the images of the ends of a range may be off, and whether that is proven; infinite where more vertices
    /// are the better way.
    fn off_line(
        &mut self,
        pcurve: &Pcurve,
        drawn: &Option<Drawn>,
        own: &Motion,
        range: [f64; 2],
        ends: [Parameters; 2],
    ) -> Result<(f64, bool), Error> {
        let [p, q] = ends;
        let bound = self.bound(pcurve, range, [own, &Motion::default()], [0.0; 2]);
        if let Some(bound) = bound.filter(|b| *b <= WORTH * self.tolerance || drawn.is_none()) {
            return Ok((bound, true));
        }
        let samples = self.measured(pcurve, range, |t| {
            let share = (t - range[0]) / (range[1] - range[0]);
            [0, 1].map(|k| p[k] + share * (q[k] - p[k]))
        });
        if samples > SAFETY * self.tolerance {
            return Ok((f64::INFINITY, true));
        }
        let line = Pcurve::polyline_at(&range, &[p, q])?;
        match self.compared(drawn, &line, range)? {
            Some(sharp) => Ok((sharp, true)),
            None => Ok(bound.map_or((samples, false), |bound| (bound, true))),
        }
    }

    fn polyline(&mut self, pcurve: &Pcurve) -> Result<Image, Error> {
        let drawn = self.drawn(pcurve)?;
        let mut waiting: Vec<([f64; 2], usize, Motion)> =
            Self::ranges(pcurve).into_iter().map(|range| (range, 0, Motion::default())).collect();
        let (a, _) = pcurve.domain();
        let (mut parameters, mut points) = (vec![a], vec![self.place(pcurve, a)]);
        let (mut deviation, mut proven) = (0.0f64, true);
        while let Some((range, depth, above)) = waiting.pop() {
            let ends = range.map(|t| self.place(pcurve, t));
            let own = if depth < LEVELS { motion(pcurve, range) } else { above };
            let (off, is_bound) = self.off_line(pcurve, &drawn, &own, range, ends)?;
            // Enough pieces before samples may decide.
            let early = !is_bound && depth < 3 && !matches!(pcurve, Pcurve::Polyline(_));
            if off <= self.tolerance && !early {
                deviation = deviation.max(off);
                proven &= is_bound;
                parameters.push(range[1]);
                points.push(ends[1]);
                continue;
            }
            let middle = range[0] + 0.5 * (range[1] - range[0]);
            if points.len() + waiting.len() >= MOST_VERTICES
                || !(range[0] < middle && middle < range[1])
            {
                return Err(Error::Unsupported(format!(
                    "tolerance: {} needs more than {MOST_VERTICES} vertices for one curve",
                    self.tolerance
                )));
            }
            waiting.push(([middle, range[1]], depth + 1, own));
            waiting.push(([range[0], middle], depth + 1, own));
        }
        let pcurve = Pcurve::polyline_at(&parameters, &points)?;
        Ok(Image { pcurve, deviation, proven, same_parameter: true })
    }

    fn fitted(&mut self, pcurve: &Pcurve) -> Result<Image, Error> {
        let drawn = self.drawn(pcurve)?;
        let (a, b) = pcurve.domain();
        let breaks: Vec<(f64, usize)> = pcurve.breaks().into_iter().map(|t| (t, 3)).collect();
        let speed = self.speeds.map_or(self.to.bounding_box()?.diagonal(), |s| s[0].max(s[1]));
        let mut wish = self.tolerance / (4.0 * speed);
        for _ in 0..ATTEMPTS {
            let options =
                Adaptive { degree: 3, tolerance: wish, breaks: &breaks, ..Adaptive::default() };
            let fit = of_function(|t| Some(self.place(pcurve, t)), [a, b], &options)?;
            if fit.worst <= wish {
                let new = Pcurve::spline(fit.spline.curve()?)?;
                let sharp = self.compared(&drawn, &new, [a, b])?;
                let (found, proven) = match sharp {
                    Some(bound) => (Some(bound).filter(|b| *b <= self.tolerance), true),
                    None => (self.checked(pcurve, &new), self.is_provable(pcurve)),
                };
                if let Some(deviation) = found {
                    return Ok(Image { pcurve: new, deviation, proven, same_parameter: true });
                }
            }
            wish *= 0.25;
        }
        Err(Error::Unsupported(format!(
            "tolerance: {} could not be reached by a fitted spline",
            self.tolerance
        )))
    }

    /// The deviation of a replacement when it is within the tolerance.
    fn checked(&self, pcurve: &Pcurve, new: &Pcurve) -> Option<f64> {
        let (a, b) = pcurve.domain();
        let mut places = [vec![a, b], pcurve.breaks()].concat();
        if let Pcurve::Spline(curve) = new {
            places.extend(curve.knots().values());
        }
        places.sort_by(f64::total_cmp);
        places.dedup();
        let mut waiting: Vec<([f64; 2], [Motion; 2])> = places
            .windows(2)
            .map(|w| [w[0], w[1]])
            .map(|range| (range, [motion(pcurve, range), motion(new, range)]))
            .collect();
        let (mut deviation, mut count) = (0.0f64, 0);
        while let Some((range, moves)) = waiting.pop() {
            let mut off = [0.0f64; 2];
            for t in range {
                let (p, q) = (self.place(pcurve, t), new.evaluate(t));
                (0..2).for_each(|k| off[k] = off[k].max((p[k] - q[k]).abs()));
            }
            let bound = self
                .bound(pcurve, range, [&moves[0], &moves[1]], off)
                .unwrap_or_else(|| self.measured(pcurve, range, |t| new.evaluate(t)));
            let at_ends = self.speeds.map_or(0.0, |s| s[0] * off[0] + s[1] * off[1]);
            count += 1;
            if bound <= self.tolerance {
                deviation = deviation.max(bound);
                continue;
            }
            if at_ends > self.tolerance || self.speeds.is_none() || count > MOST_VERTICES {
                return None;
            }
            let middle = range[0] + 0.5 * (range[1] - range[0]);
            if !(range[0] < middle && middle < range[1]) {
                return None;
            }
            waiting.extend([([range[0], middle], moves), ([middle, range[1]], moves)]);
        }
        Some(deviation)
    }
}
