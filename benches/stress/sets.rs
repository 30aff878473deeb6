//! Sets of feet against places that are known: preimages must hold every place within the tolerance, extrema every
//! minimum that the search found; each member must be what it says.

use std::time::Instant;

use footpoint::closest::flag;
use footpoint::error::Error;
use footpoint::extrema::ExtremaOptions;
use footpoint::set::{FootSet, Member};

use super::asks::Ask;
use super::judge::{Fault, Judge, Judged};
use super::pieces::Place;
use super::search::{Found, Scratch, square};
use super::shapes::asked::Shape;
use super::shapes::{Vector, dot, sub};

/// Share of the diagonal within which points lie in a preimage here.
const TOLERANCE: f64 = 1e-7;

/// A set that was asked for.
struct Asked<'a> {
    judge: &'a Judge<'a>,
    query: Vector,
    set: FootSet,
}

fn holds(area: [f64; 4], [u, v]: [f64; 2], slack: [f64; 2]) -> bool {
    let [u0, u1, v0, v1] = area;
    (u0 - slack[0]..=u1 + slack[0]).contains(&u) && (v0 - slack[1]..=v1 + slack[1]).contains(&v)
}

fn area(member: &Member) -> [f64; 4] {
    [member.u[0], member.u[1], member.v[0], member.v[1]]
}

impl Asked<'_> {
    fn diagonal(&self) -> f64 {
        self.judge.extent.0
    }

    /// The rounding of parameters, generously.
    fn slack(&self) -> [f64; 2] {
        let [u0, u1, v0, v1] = self.judge.exact.area;
        [u0.abs().max(u1.abs()), v0.abs().max(v1.abs())].map(|x| 8.0 * f64::EPSILON * x)
    }

    fn is_undecided(&self, at: [f64; 2]) -> bool {
        self.set.undecided.iter().any(|area| holds(*area, at, self.slack()))
    }

    fn is_in_a_member(&self, at: [f64; 2]) -> bool {
        self.set.members.iter().any(|member| holds(area(member), at, self.slack()))
    }

    /// The record's point is the shape's, its place in the intervals, its distance the distance.
    fn is_true(&self, member: &Member) -> bool {
        let foot = &member.foot;
        let at = [foot.u, foot.v];
        let away = square(sub(foot.point, self.query)).sqrt();
        holds(area(member), at, [0.0; 2])
            && holds(self.judge.exact.area, at, [0.0; 2])
            && self.judge.shape.evaluate(at) == foot.point
            && (foot.distance - away).abs() <= 8.0 * f64::EPSILON * away
    }

    /// The first place that is missing, if any.
    fn judged(
        &self,
        ask: &Ask,
        time: f64,
        lost: Option<([f64; 2], f64)>,
        mut faults: Vec<Fault>,
    ) -> Judged {
        let mut foot = footpoint::closest::FootPoint::unreached();
        if let Some(first) = self.set.members.first() {
            foot = first.foot;
        }
        foot.flags = if self.set.is_complete() { 0 } else { flag::NOT_PROVEN };
        faults.extend(lost.map(|_| Fault::Lost));
        let found = lost.unwrap_or(([f64::NAN; 2], f64::NAN));
        Judged { time, faults, found, ..Judged::new(foot, ask) }
    }
}

fn measured(call: impl FnOnce() -> Result<FootSet, Error>) -> (FootSet, f64) {
    let start = Instant::now();
    let set = call().unwrap_or_default();
    (set, start.elapsed().as_secs_f64() * 1e9)
}

/// Every place within the tolerance, known from the samples, the search and the making of the query.
pub fn preimage(judge: &Judge, ask: &Ask, scratch: &mut Scratch) -> Judged {
    let (query, tolerance) = (ask.query, TOLERANCE * judge.extent.0);
    let (set, time) = measured(|| match judge.shape {
        Shape::Curve(curve) => curve.preimage(query, tolerance, &judge.options, &mut || false),
        Shape::Surface(surface) => {
            surface.preimage(query, tolerance, &judge.options, &mut || false)
        }
    });
    let asked = Asked { judge, query, set };
    let within = 0.9 * tolerance - judge.rounding(ask);
    let near = |place: &Place| square(judge.pieces.point(place, query)).sqrt() <= within;
    let mut known: Vec<Place> = ask.places.iter().copied().filter(near).collect();
    let descents = judge.search.descents(query, &ask.places, scratch);
    known.extend(descents.iter().map(|found| found.place).filter(near));
    known.extend((0..judge.search.count()).map(|k| judge.search.sample_place(k)).filter(near));
    let parameters = known.iter().map(|place| judge.pieces.parameters(place));
    let lost = parameters.into_iter().find(|at| {
        // Rounded parameters may lie elsewhere on a steep shape: only what the shape itself says counts.
        let there = square(sub(judge.shape.evaluate(*at), query)).sqrt();
        there <= within && !asked.is_in_a_member(*at) && !asked.is_undecided(*at)
    });
    let slack = tolerance + judge.rounding(ask) + 1e-12 * judge.extent.0;
    let is_near = |m: &Member| m.foot.distance <= slack || m.foot.flags & flag::NOT_PROVEN != 0;
    let is_true = asked.set.members.iter().all(|m| asked.is_true(m) && is_near(m));
    let lost = lost.map(|at| (at, square(sub(judge.shape.evaluate(at), query)).sqrt()));
    asked.judged(ask, time, lost, if is_true { vec![] } else { vec![Fault::Mismatch] })
}

/// Every minimum that the search found and that stands clear, and the nearest place of all.
pub fn extrema(judge: &Judge, ask: &Ask, nearest: f64, scratch: &mut Scratch) -> Judged {
    let query = ask.query;
    let options = ExtremaOptions { domain: judge.options.domain, ..ExtremaOptions::default() };
    let (set, time) = measured(|| match judge.shape {
        Shape::Curve(curve) => curve.extrema(query, &options, &mut || false),
        Shape::Surface(surface) => surface.extrema(query, &options, &mut || false),
    });
    let asked = Asked { judge, query, set };
    let limit = 1e-8 * asked.diagonal() + judge.rounding(ask);
    let descents = judge.search.descents(query, &ask.places, scratch);
    let lost = descents.iter().filter(|found| is_clear(judge, found, query)).find(|found| {
        let at = judge.pieces.parameters(&found.place);
        let (distance, point) = (found.square.sqrt(), judge.pieces.point(&found.place, [0.0; 3]));
        let is_it = |m: &&Member| {
            let apart = square(sub(m.foot.point, point)).sqrt();
            let differ = (m.foot.distance - distance).abs();
            let is_here = apart <= 1e-4 * asked.diagonal() || holds(area(m), at, asked.slack());
            // Near a focal point the search ends anywhere along a stretch on which the distance does not change.
            let accuracy = 1e-10 * asked.diagonal() + judge.rounding(ask);
            let is_along = apart <= 1e-2 * asked.diagonal() && differ <= accuracy;
            is_along || (is_here && differ <= limit)
        };
        !asked.set.members.iter().any(|m| is_it(&m)) && !asked.is_undecided(at)
    });
    let lost = lost.map(|found| (judge.pieces.parameters(&found.place), found.square.sqrt()));
    let least = asked.set.members.iter().map(|m| m.foot.distance).fold(f64::INFINITY, f64::min);
    let has_nearest = least <= nearest + limit || !asked.set.is_complete();
    let is_true = asked.set.members.iter().all(|m| asked.is_true(m));
    let mut faults = if is_true { vec![] } else { vec![Fault::Mismatch] };
    faults.extend((!has_nearest).then_some(Fault::Wrong));
    asked.judged(ask, time, lost, faults)
}

/// Whether the other end of a direction is the same place: there the shape goes on.
fn is_seam(judge: &Judge, direction: usize, at: [f64; 2]) -> bool {
    let ends = [0, 1].map(|end| {
        let mut there = at;
        there[direction] = judge.exact.area[2 * direction + end];
        judge.shape.evaluate(there)
    });
    square(sub(ends[0], ends[1])).sqrt() <= 1e-6 * judge.extent.0
}

/// A minimum inside a piece or on the border of the area, whose second derivatives and slopes leave no doubt.
fn is_clear(judge: &Judge, found: &Found, query: Vector) -> bool {
    let (place, jet) = (&found.place, judge.pieces.jet(&found.place, query));
    let at = judge.pieces.parameters(place);
    let (area, diagonal) = (judge.exact.area, judge.extent.0);
    let speeds = [square(jet.s).sqrt(), square(jet.t).sqrt()];
    let g = [dot(jet.d, jet.s), dot(jet.d, jet.t)];
    let mut free = [true; 2];
    for k in 0..2 {
        if k == 1 && judge.pieces.degrees[1] == 0 {
            free[k] = false;
            continue;
        }
        let is_steep =
            speeds[k] > 0.0 && g[k].abs() > 1e-6 * speeds[k] * (diagonal + found.square.sqrt());
        let is_end =
            (at[k] == area[2 * k] && g[k] > 0.0) || (at[k] == area[2 * k + 1] && g[k] < 0.0);
        free[k] = !is_end;
        let is_inside = place.at[k] > 1e-6 && place.at[k] < 1.0 - 1e-6;
        let [_, length] = judge.pieces.interval(k, place.piece[k]);
        let grain = speeds[k] / length * f64::EPSILON * (at[k].abs() + length);
        if is_end && is_seam(judge, k, at) {
            return false;
        }
        if (is_end && !is_steep)
            || (free[k] && !is_inside)
            || grain > 1e-11 * diagonal
            || speeds[k] < 1e-6 * diagonal
        {
            return false;
        }
    }
    let h = [
        dot(jet.s, jet.s) + dot(jet.d, jet.ss),
        dot(jet.s, jet.t) + dot(jet.d, jet.st),
        dot(jet.t, jet.t) + dot(jet.d, jet.tt),
    ];
    let clear = |h: f64, speed: f64| h > 1e-3 * speed * speed;
    // Another Newton step must not lead away: a small gradient alone says little where the distance hardly bends, and a
    // descent that its last step left on the way to distance zero is off by as much as the step.
    let still = |step: f64, speed: f64| step.abs() <= 1e-6 && step.abs() * speed <= 5e-9 * diagonal;
    let [s, t] = speeds;
    match free {
        [false, false] => true,
        [true, false] => clear(h[0], s) && still(g[0] / h[0], s),
        [false, true] => clear(h[2], t) && still(g[1] / h[2], t),
        _ => {
            let det = h[0] * h[2] - h[1] * h[1];
            let step = [(h[1] * g[1] - h[2] * g[0]) / det, (h[1] * g[0] - h[0] * g[1]) / det];
            let bends = clear(h[0], s) && clear(h[2], t) && det > 1e-3 * h[0] * h[2];
            bends && still(step[0], s) && still(step[1], t)
        }
    }
}
