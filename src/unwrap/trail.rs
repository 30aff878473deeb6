//! One step along a path: from the foot before to the foot of the next query.
//!
//! ```text
//!   plausible?   the foot moved about as far as its query, and its parameters as far as the metric says     -> goes on
//!   tied?        as when not plausible, but never a jump
//!   followed     the foot before is iterated to the next query, at once or in 32 steps of the query;
//!                where that ends as near as the nearest foot, it is the one that goes on                    -> goes on
//!   otherwise    the nearest foot lies on another branch                                                    -> JUMP
//! ```

use super::cells::{descend, is_plain};
use super::ground::Ground;
use super::{change, turned, turns};
use crate::bounds::{Vector, add, dot, norm, scaled, sub};
use crate::closest::{FootPoint, flag};

/// How much farther than its query a foot may move, and how much longer its way by the metric may be than straight.
const MOST_STRETCH: f64 = 4.0;
const MOST_DETOUR: f64 = 2.0;

/// Steps of the query when a foot is followed closely, and how much farther than the query it may move in one of them.
const CLOSE_STEPS: usize = 32;
const MOST_RUSH: f64 = 16.0;

/// Feet nearer to each other than this share of the diagonal, by the metric, are the same.
const SAME: f64 = 1e-6;

/// A step passes a collapsed edge when its middle part comes nearer to it than this share of the step.
const PASSING: f64 = 0.25;

/// The flags that belong to the place of a foot.
const PLACE: u32 = flag::EDGE | flag::CORNER | flag::SEAM | flag::COLLAPSED | flag::CREASE;

/// A foot on the path, with its query.
#[derive(Clone, Copy)]
pub struct Stand {
    /// The query.
    pub query: Vector,
    /// Its foot.
    pub foot: FootPoint,
    /// Its parameters, unrolled.
    pub unwrapped: [f64; 2],
}

/// A walk over one shape.
pub struct Trail<'a, G: Ground> {
    /// The shape.
    pub ground: &'a mut G,
}

impl<G: Ground> Trail<'_, G> {
    /// The first foot of a path.
    pub fn begin(&self, query: Vector, foot: FootPoint) -> (Stand, u32) {
        (Stand { query, foot, unwrapped: [foot.u, foot.v] }, self.marks(&foot))
    }

    /// The next foot: the nearest one, or one as near that goes on from the one before.
    pub fn advance(&mut self, before: &Stand, query: Vector, foot: FootPoint) -> (Stand, u32) {
        let asked = foot;
        let foot = self.with_free_parameters(before, query, asked);
        let kept = (foot.u, foot.v) != (asked.u, asked.v);
        let (mut next, mut marks) = (self.stand(before, query, foot), 0);
        let passed = self.passes_tip(before, &next);
        let plausible = passed || self.is_plausible(before, &next);
        let tied = foot.flags & flag::TIE != 0 && !kept;
        if !plausible || tied && !passed {
            match self.follow(before, &next) {
                Some(followed) => {
                    if followed.foot.u != foot.u || followed.foot.v != foot.v {
                        marks |= change::TIE;
                    }
                    next = followed;
                }
                None if plausible => {}
                None => marks |= change::JUMP,
            }
        }
        if passed {
            marks |= change::THROUGH_COLLAPSED;
        }
        let (ends, closed) = (self.ground.ends(), self.ground.closed());
        let lap = |stand: &Stand, k: usize| {
            let canonical = [stand.foot.u, stand.foot.v][k];
            ((stand.unwrapped[k] - canonical) / (ends[k][1] - ends[k][0])).round()
        };
        if (0..2).any(|k| closed[k] && lap(before, k) != lap(&next, k)) {
            marks |= change::SEAM_CROSSED;
        }
        (next, marks | self.marks(&next.foot))
    }

    fn marks(&self, foot: &FootPoint) -> u32 {
        let of = |bit: u32, mark: u32| if foot.flags & bit != 0 { mark } else { 0 };
        of(flag::TIE, change::TIE) | of(flag::COLLAPSED, change::THROUGH_COLLAPSED)
    }

    /// A foot with its parameters unrolled next to those before.
    fn stand(&self, before: &Stand, query: Vector, foot: FootPoint) -> Stand {
        let (ends, closed) = (self.ground.ends(), self.ground.closed());
        let at = [foot.u, foot.v];
        let unwrapped = [0, 1].map(|k| {
            let whole = if closed[k] { turns(before.unwrapped[k], at[k], ends[k]) } else { 0.0 };
            turned(at[k], whole, ends[k])
        });
        Stand { query, foot, unwrapped }
    }

    /// The collapsed edge that a foot lies on.
    fn edge_of(&self, foot: &FootPoint) -> Option<usize> {
        let (ends, tips) = (self.ground.ends(), self.ground.tips());
        let at = [foot.u, foot.v];
        (0..4).find(|&edge| tips[edge].is_some() && at[edge / 2] == ends[edge / 2][edge % 2])
    }

    /// On a collapsed edge the parameter along it is free, in a continuum of feet sometimes one or both: they stay what they
    /// were.
    fn with_free_parameters(&self, before: &Stand, query: Vector, foot: FootPoint) -> FootPoint {
        let (old, new) = ([before.foot.u, before.foot.v], [foot.u, foot.v]);
        let kept = match self.edge_of(&foot) {
            Some(edge) if edge < 2 => [Some([new[0], old[1]]), None, None],
            Some(_) => [Some([old[0], new[1]]), None, None],
            None if foot.flags & flag::CONTINUUM != 0 => {
                [Some(old), Some([old[0], new[1]]), Some([new[0], old[1]])]
            }
            None => return foot,
        };
        let mut placed = kept.into_iter().flatten().map(|at| self.placed(at, query, &foot));
        placed.find(|kept| self.is_as_near(kept, &foot, query)).unwrap_or(foot)
    }

    /// The record of the nearest foot at other parameters.
    fn placed(&self, at: [f64; 2], query: Vector, nearest: &FootPoint) -> FootPoint {
        let point = self.ground.point(at);
        let distance = norm(sub(query, point));
        let (ends, closed) = (self.ground.ends(), self.ground.closed());
        let on = [0, 1].map(|k| at[k] == ends[k][0] || at[k] == ends[k][1]);
        let mut flags = nearest.flags & !(PLACE ^ flag::CREASE);
        for (is, bit) in [
            (on[0] || on[1], flag::EDGE),
            (on[0] && on[1], flag::CORNER),
            (on[0] && closed[0] || on[1] && closed[1], flag::SEAM),
        ] {
            flags |= if is { bit } else { 0 };
        }
        let lower_bound = nearest.lower_bound.min(distance);
        let mut foot =
            FootPoint { u: at[0], v: at[1], point, distance, lower_bound, flags, ..*nearest };
        if self.edge_of(&foot).is_some() {
            foot.flags |= flag::COLLAPSED;
        }
        foot
    }

    /// Whether a foot is as near as the nearest one can be told to be.
    fn is_as_near(&self, foot: &FootPoint, nearest: &FootPoint, query: Vector) -> bool {
        let allowed = self.ground.allowed(query);
        foot.distance <= nearest.distance
            || foot.distance - nearest.lower_bound <= allowed
            || nearest.flags & flag::NOT_PROVEN != 0 && foot.distance <= nearest.distance + allowed
    }

    /// Lengths of the parameter step by the metric at both ends; free parameters of collapsed edges do not count.
    fn lengths(&self, a: &Stand, b: &Stand) -> [f64; 2] {
        let mut step = [0, 1].map(|k| b.unwrapped[k] - a.unwrapped[k]);
        for edge in [a, b].into_iter().filter_map(|stand| self.edge_of(&stand.foot)) {
            step[1 - edge / 2] = 0.0;
        }
        [a, b].map(|stand| {
            let [s, t] = self.ground.frame([stand.foot.u, stand.foot.v]);
            norm(add(scaled(s, step[0]), scaled(t, step[1])))
        })
    }

    /// Whether the step from foot to foot looks like the image of the step from query to query.
    fn is_plausible(&self, a: &Stand, b: &Stand) -> bool {
        let grain = SAME * self.ground.diagonal();
        let straight = norm(sub(b.foot.point, a.foot.point));
        let asked = norm(sub(b.query, a.query));
        let [first, second] = self.lengths(a, b);
        straight <= MOST_STRETCH * asked + grain
            && first.max(second) <= MOST_DETOUR * straight + grain
    }

    /// Whether two feet of one query are the same place.
    fn is_same(&self, a: &Stand, b: &Stand) -> bool {
        let grain = SAME * self.ground.diagonal();
        let [first, second] = self.lengths(a, b);
        norm(sub(b.foot.point, a.foot.point)) <= grain && first.max(second) <= grain
    }

    /// Whether the step leads over the point of a collapsed edge, or ends there: the feet lie on either side of it, and
    /// their parameters lead there and back.
    fn passes_tip(&self, a: &Stand, b: &Stand) -> bool {
        let step = sub(b.foot.point, a.foot.point);
        let (straight, asked) = (norm(step), norm(sub(b.query, a.query)));
        let (ends, grain) = (self.ground.ends(), SAME * self.ground.diagonal());
        if straight > MOST_STRETCH * asked + grain {
            return false;
        }
        self.ground.tips().iter().enumerate().any(|(edge, tip)| {
            let Some(tip) = tip else { return false };
            let (k, end) = (edge / 2, ends[edge / 2][edge % 2]);
            let far = |stand: &Stand| {
                let across = self.ground.frame([stand.foot.u, stand.foot.v])[k];
                norm(across) * (end - [stand.foot.u, stand.foot.v][k]).abs()
            };
            let (from_a, from_b) = (sub(*tip, a.foot.point), sub(*tip, b.foot.point));
            let direct = far(a) <= MOST_DETOUR * norm(from_a) + grain
                && far(b) <= MOST_DETOUR * norm(from_b) + grain;
            if self.edge_of(&a.foot) == Some(edge) || self.edge_of(&b.foot) == Some(edge) {
                return direct;
            }
            let share = dot(from_a, step) / (straight * straight);
            let beside = norm(sub(from_a, scaled(step, share)));
            direct && share > 0.0 && share < 1.0 && beside <= PASSING * straight
        })
    }

    /// The foot that follows from the one before, when it is as near as the nearest one.
    fn follow(&mut self, before: &Stand, nearest: &Stand) -> Option<Stand> {
        let at_once = self.iterate(before, nearest.query);
        let asked = norm(sub(nearest.query, before.query));
        let grain = SAME * self.ground.diagonal();
        let moved = norm(sub(at_once.foot.point, before.foot.point));
        if moved <= MOST_STRETCH * asked + grain
            && let Some(found) = self.settled(before, &at_once, nearest)
        {
            return Some(found);
        }
        let mut here = *before;
        for step in 1..=CLOSE_STEPS {
            let share = step as f64 / CLOSE_STEPS as f64;
            let on_the_way = add(before.query, scaled(sub(nearest.query, before.query), share));
            let query = if step == CLOSE_STEPS { nearest.query } else { on_the_way };
            let next = self.iterate(&here, query);
            let moved = norm(sub(next.foot.point, here.foot.point));
            if moved > MOST_RUSH * norm(sub(query, here.query)) + grain {
                return None;
            }
            here = next;
        }
        self.settled(before, &here, nearest)
    }

    /// The nearest foot itself when `found` is the same place, else `found` with the nearest one's certificate when it is
    /// as near.
    fn settled(&self, before: &Stand, found: &Stand, nearest: &Stand) -> Option<Stand> {
        let query = nearest.query;
        let found = self.stand(before, query, found.foot);
        if self.is_same(&found, nearest) {
            return Some(*nearest);
        }
        if !self.is_as_near(&found.foot, &nearest.foot, query) {
            return None;
        }
        let flags = found.foot.flags & PLACE | nearest.foot.flags & !PLACE | flag::TIE;
        let foot = FootPoint {
            lower_bound: nearest.foot.lower_bound.min(found.foot.distance),
            flags,
            iterations: nearest.foot.iterations.saturating_add(found.foot.iterations),
            ..found.foot
        };
        Some(Stand { foot, ..found })
    }

    /// The end of a closed direction as its start.
    fn canonical(&self, at: [f64; 2]) -> [f64; 2] {
        let (ends, closed) = (self.ground.ends(), self.ground.closed());
        let moves = |k: usize| closed[k] && !self.ground.is_restricted() && at[k] == ends[k][1];
        [0, 1].map(|k| if moves(k) { ends[k][0] } else { at[k] })
    }

    /// The local iteration from a foot, across seams and breaks.
    fn iterate(&mut self, from: &Stand, query: Vector) -> Stand {
        let start = [from.foot.u, from.foot.v];
        let foot = self.ground.local(query, start);
        if is_plain(self.ground) {
            return self.stand(from, query, foot);
        }
        let (at, distance) = descend(self.ground, query, start);
        let at = self.canonical(at);
        // Once more as a whole, for the record of the place.
        let whole = self.ground.local(query, at);
        let near = norm(sub(whole.point, self.ground.point(at))) <= SAME * self.ground.diagonal();
        let foot =
            if near && whole.distance <= distance { whole } else { self.placed(at, query, &whole) };
        self.stand(from, query, foot)
    }
}
