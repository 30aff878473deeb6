//! A pcurve for one stretch: a line if that will do, else a spline whose knots are added where the proof fails.

use super::cut::Stretch;
use super::feet::Sample;
use super::{PulledPiece, Puller, pulled};
use crate::bounds::{dot, sub};
use crate::curve::Curve;
use crate::elementary::part;
use crate::error::Error;
use crate::fit::{Ends, least_squares};
use crate::pcurve::deviation::{Deviation, deviation, deviation_at};
use crate::portable::SameDigits;

/// Samples that a span has beyond its degree.
const MORE_SAMPLES: usize = 3;

/// Bounds below this share of the tolerance are not made sharper.
const ENOUGH: f64 = 0.3;

/// An oblique line that is so nearly an isoline, in the tolerance, is made one.
const NEARLY: f64 = 0.3;

/// Share of the tolerance from which on the edge's own distance counts, and how much more than that the bound of a fit may be.
const OWN: f64 = 0.5;
const OFF: f64 = 1.002;

/// Most parts into which a span is divided at once, and most rounds.
const MOST_PARTS: f64 = 16.0;
const ROUNDS: usize = 40;

/// Spans are not made shorter than this share of the stretch.
const SHORTEST: f64 = 1e-12;

/// A knot of the fit and how often it stands there.
#[derive(Clone, Copy, Debug)]
struct Knot {
    t: f64,
    times: usize,
}

impl Puller<'_> {
    /// The pcurve of one stretch.
    pub fn approximate(
        &mut self,
        stretch: &Stretch,
        poll: &mut dyn FnMut() -> bool,
    ) -> Result<PulledPiece, Error> {
        self.samples.clone_from(&stretch.samples);
        let tolerance = self.tolerance;
        let mut flags = stretch.flags();
        if stretch.samples.iter().any(|sample| sample.lower_bound > tolerance) {
            flags |= pulled::NOT_ON_SURFACE;
        }
        let (curve, deviation) = match self.line(stretch)? {
            Some(found) => found,
            None => match self.planar(stretch)? {
                Some(found) => found,
                None => self.spline(stretch, poll)?,
            },
        };
        if deviation.bound > tolerance {
            flags |= pulled::NOT_PROVEN;
        }
        Ok(PulledPiece { curve, deviation, flags })
    }

    /// What a fit must reach: the tolerance; for an edge that is off the surface, its own distance and the tolerance.
    fn goal(&self) -> f64 {
        let own = self.samples.iter().fold(0.0, |most: f64, sample| most.max(sample.distance));
        if own > OWN * self.tolerance { OFF * own + self.tolerance } else { self.tolerance }
    }

    /// Parameters of a sample on a stretch.
    fn place(&self, stretch: &Stretch, sample: &Sample) -> [f64; 2] {
        [0, 1].map(|k| {
            let x = sample.at[k] - stretch.lap[k] * self.period(k);
            stretch.along[k].unwrap_or(x.clamp(self.ends[k][0], self.ends[k][1]))
        })
    }

    /// Where a stretch begins or ends.
    fn end_place(&mut self, stretch: &Stretch, last: bool) -> [f64; 2] {
        let fixed = stretch.ends[usize::from(last)];
        let t = stretch.range[usize::from(last)];
        if let Some(edge) = fixed.collapsed {
            let mut at = self.limit(stretch, t);
            at[edge / 2] = self.ends[edge / 2][edge % 2];
            return at;
        }
        let sample = self.sample_at(t);
        let mut at = self.place(stretch, &sample);
        for k in (0..2).filter(|&k| fixed.seam[k] && stretch.along[k].is_none()) {
            let seam = ((sample.at[k] - self.ends[k][0]) / self.period(k)).round();
            at[k] = if seam > stretch.lap[k] { self.ends[k][1] } else { self.ends[k][0] };
        }
        at
    }

    /// The limit of the parameters at an end on a collapsed edge: a parabola through the nearest three samples.
    fn limit(&mut self, stretch: &Stretch, t: f64) -> [f64; 2] {
        let width = stretch.range[1] - stretch.range[0];
        let far = |s: &&Sample| (s.t - t).abs() > 1e-7 * width;
        let mut near: Vec<Sample> = self.samples.iter().filter(far).copied().collect();
        near.sort_by(|a, b| (a.t - t).abs().total_cmp(&(b.t - t).abs()));
        near.truncate(3);
        let places: Vec<[f64; 2]> = near.iter().map(|s| self.place(stretch, s)).collect();
        let weight = |i: usize| -> f64 {
            let others = (0..near.len()).filter(|&j| j != i);
            others.map(|j| (t - near[j].t) / (near[i].t - near[j].t)).product()
        };
        [0, 1].map(|k| {
            let sum: f64 = (0..near.len()).map(|i| weight(i) * places[i][k]).sum();
            stretch.along[k].unwrap_or(sum.clamp(self.ends[k][0], self.ends[k][1]))
        })
    }

    /// A line that is within the goal.
    fn line(&mut self, stretch: &Stretch) -> Result<Option<(Curve, Deviation)>, Error> {
        let (a, b) = (self.end_place(stretch, false), self.end_place(stretch, true));
        let [from, to] = stretch.range;
        let goal = self.goal();
        let mut tried = vec![self.snapped(stretch, a, b)];
        for (k, end) in stretch.ends.iter().enumerate() {
            // Along an isoline to a collapsed edge the other parameter stays.
            if let Some(edge) = end.collapsed {
                let (mut from, mut to, free) = (a, b, 1 - edge / 2);
                if k == 0 {
                    from[free] = b[free]
                } else {
                    to[free] = a[free]
                }
                tried.push(self.snapped(stretch, from, to));
            }
        }
        tried.push((a, b));
        let mut best: Option<(Curve, Deviation)> = None;
        for (a, b) in tried {
            let poles = [[a[0], a[1], 0.0], [b[0], b[1], 0.0]];
            let line = Curve::new(&[from, from, to, to], 1, &poles, None)?;
            // The distance at one place refuses most lines at once.
            let at = from + 0.382 * (to - from);
            if deviation_at(&self.composer, &line, self.edge, at) > goal {
                continue;
            }
            let found = deviation(&mut self.composer, &line, self.edge, stretch.range, 0.0)?;
            if found.bound <= goal && best.as_ref().is_none_or(|best| found.bound < best.1.bound) {
                best = Some((line, found));
            }
        }
        Ok(best)
    }

    /// The ends of a line moved to what they nearly are: a value that does not change along it, the ends of the domain, knots, the
    /// edge's own parameter.
    fn snapped(&self, stretch: &Stretch, a: [f64; 2], b: [f64; 2]) -> ([f64; 2], [f64; 2]) {
        let (mut a, mut b) = (a, b);
        let speeds = self.speeds([0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])]);
        let surface = self.shape.surface();
        for k in 0..2 {
            let near = |x: f64, y: f64| (x - y).abs() * speeds[k] <= NEARLY * self.tolerance;
            let knots = [surface.knots_u(), surface.knots_v()][k];
            let moved = |x: f64, own: f64| {
                let place = knots.values().partition_point(|&knot| knot < x);
                let around = [place.checked_sub(1), Some(place)].into_iter().flatten();
                let beside = around.filter_map(|i| knots.values().get(i).copied());
                let inside = beside.chain([own]).filter(|y| knots.contains(*y));
                let nearest = inside.min_by(|y, z| (x - y).abs().total_cmp(&(x - z).abs()));
                nearest.filter(|&y| near(x, y)).unwrap_or(x)
            };
            if near(a[k], b[k]) {
                let middle = 0.5 * (a[k] + b[k]);
                let seam = |end: usize| stretch.ends[end].seam[k];
                let value = if seam(1) {
                    b[k]
                } else if seam(0) {
                    a[k]
                } else {
                    moved(middle, f64::NAN)
                };
                (a[k], b[k]) = (value, value);
            } else {
                (a[k], b[k]) = (moved(a[k], stretch.range[0]), moved(b[k], stretch.range[1]));
            }
        }
        (a, b)
    }

    /// On a parallelogram the pcurve is the edge in its coordinates, pole by pole.
    fn planar(&mut self, stretch: &Stretch) -> Result<Option<(Curve, Deviation)>, Error> {
        let surface = self.shape.surface();
        let [origin, along_v, along_u, _] = surface.poles() else { return Ok(None) };
        if surface.is_rational() {
            return Ok(None);
        }
        let (a, b) = (sub(*along_u, *origin), sub(*along_v, *origin));
        let (aa, ab, bb) = (dot(a, a), dot(a, b), dot(b, b));
        let det = aa * bb - ab * ab;
        let edge = part(self.edge, stretch.range)?;
        let place = |pole: &[f64; 3]| {
            let x = sub(*pole, *origin);
            let (ax, bx) = (dot(a, x), dot(b, x));
            let shares = [(bb * ax - ab * bx) / det, (aa * bx - ab * ax) / det];
            let [u, v] = [0, 1].map(|k| self.ends[k][0] + shares[k] * self.period(k));
            [u, v, 0.0]
        };
        let poles: Vec<[f64; 3]> = edge.poles().iter().map(place).collect();
        let Ok(curve) = Curve::new(edge.knots().values(), edge.degree(), &poles, edge.weights())
        else {
            return Ok(None);
        };
        let goal = self.goal();
        // An edge that leaves the domain by more than rounding has no such pcurve.
        let found = deviation(&mut self.composer, &curve, self.edge, stretch.range, ENOUGH * goal);
        Ok(found.ok().filter(|found| found.bound <= goal).map(|found| (curve, found)))
    }

    /// A spline, as near as its poles allow.
    fn spline(
        &mut self,
        stretch: &Stretch,
        poll: &mut dyn FnMut() -> bool,
    ) -> Result<(Curve, Deviation), Error> {
        let mut knots = self.first_knots(stretch);
        let shortest = SHORTEST * (stretch.range[1] - stretch.range[0]);
        let mut best: Option<(Curve, Deviation)> = None;
        for _ in 0..ROUNDS {
            if poll() {
                return Err(Error::Cancelled);
            }
            let curve = self.fitted(stretch, &knots)?;
            let (goal, mut whole) = (self.goal(), Deviation::none());
            let (mut next, mut failed) = (vec![knots[0]], false);
            for pair in knots.windows(2) {
                let range = [pair[0].t, pair[1].t];
                let found = deviation(&mut self.composer, &curve, self.edge, range, ENOUGH * goal)?;
                whole = whole.max(found);
                if found.bound > goal && range[1] - range[0] > shortest {
                    failed = true;
                    let share = 1.1 * (found.bound / goal).power(1.0 / (self.degree + 1) as f64);
                    let parts = share.ceil().clamp(2.0, MOST_PARTS);
                    let at = |k: usize| range[0] + (range[1] - range[0]) * (k as f64 / parts);
                    next.extend((1..parts as usize).map(|k| Knot { t: at(k), times: 1 }));
                }
                next.push(pair[1]);
            }
            if best.as_ref().is_none_or(|best| whole.bound < best.1.bound) {
                best = Some((curve, whole));
            }
            if !failed || next.iter().map(|knot| knot.times).sum::<usize>() > self.most_poles {
                break;
            }
            knots = next;
        }
        best.ok_or(Error::OutOfMemory)
    }

    /// The ends, and the places where the edge is not smooth.
    fn first_knots(&self, stretch: &Stretch) -> Vec<Knot> {
        let [from, to] = stretch.range;
        let given = self.edge.knots();
        let mut knots = vec![Knot { t: from, times: 0 }];
        for span in given.spans() {
            let t = given.values()[span];
            if from < t && t < to && given.multiplicity(t) + 1 >= given.degree() {
                let smooth = given.degree().saturating_sub(given.multiplicity(t));
                knots.push(Knot { t, times: self.degree.saturating_sub(smooth).max(1) });
            }
        }
        knots.push(Knot { t: to, times: self.degree + 1 });
        knots
    }

    /// Least squares on knots, with the poles moved into the domain.
    fn fitted(&mut self, stretch: &Stretch, knots: &[Knot]) -> Result<Curve, Error> {
        let degree = self.degree;
        let each = degree + MORE_SAMPLES;
        let mut parameters = Vec::with_capacity(knots.len() * each);
        for pair in knots.windows(2) {
            let at = |k: usize| pair[0].t + (pair[1].t - pair[0].t) * (k as f64 / each as f64);
            parameters.extend((0..each).map(at));
        }
        parameters.push(stretch.range[1]);
        let inside = |t: &f64| stretch.range[0] < *t && *t < stretch.range[1];
        for t in parameters.iter().filter(|t| inside(t)) {
            self.sample_at(*t);
        }
        let last = parameters.len() - 1;
        let mut points = Vec::with_capacity(parameters.len());
        for (i, &t) in parameters.iter().enumerate() {
            points.push(if i == 0 || i == last {
                self.end_place(stretch, i == last)
            } else {
                let sample = self.sample_at(t);
                self.place(stretch, &sample)
            });
        }
        let mut values = vec![stretch.range[0]; degree + 1];
        for knot in &knots[1..] {
            values.extend(std::iter::repeat_n(knot.t, knot.times));
        }
        let fit = least_squares::<2>(degree, &values, &parameters, &points, Ends::Interpolated)?;
        let inside = |pole: &[f64; 2]| {
            let [u, v] = [0, 1].map(|k| pole[k].clamp(self.ends[k][0], self.ends[k][1]));
            [u, v, 0.0]
        };
        let poles: Vec<[f64; 3]> = fit.spline.poles().iter().map(inside).collect();
        Curve::new(&values, degree, &poles, None)
    }
}
