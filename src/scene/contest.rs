//! What the members of a scene have said about one query: the nearest foot, the bound of all, ties.
//!
//! A member answers with a foot or with a bound. The scene's bound is the least of all bounds. It is proven when every
//! member's bound, with the gap that this member is allowed, reaches the least distance; a member whose own answer is
//! proven does so by itself.
//!
//! Feet of different members tie as feet of one shape do: within the window of the least distance, and apart in space.
//! Where faces meet, each of them has the same point as its foot, and that is one foot.

use super::{NO_MEMBER, SceneFoot};
use crate::bounds::{HALF_ULP, Vector, dot, norm, sub};
use crate::closest::{FootPoint, flag};

/// Feet remembered for ties; more places than that, all apart, are a tie in any case.
const RIVALS: usize = 8;

/// A member's foot, placed.
#[derive(Clone, Copy, Debug)]
pub struct Entry {
    /// The member.
    pub member: u32,
    /// Its record; `point` and `distance` are those in space.
    pub foot: FootPoint,
    /// From the query to the foot.
    pub d: Vector,
    /// How much farther a foot may be and still tie.
    pub window: f64,
}

/// The answers so far.
#[derive(Clone, Debug)]
pub struct Contest {
    accuracy: f64,
    best: Option<Entry>,
    rivals: [Option<Entry>; RIVALS],
    is_crowded: bool,
    /// Least bound of all members asked.
    lower: f64,
    /// Least `bound + allowed` of the members that are not proven by themselves.
    holds: f64,
    /// The same of those whose budget ran out, and their least bound.
    spent: f64,
    undecided: f64,
    evaluations: u32,
}

impl Contest {
    /// Nobody has been asked.
    pub fn new(accuracy: f64) -> Self {
        let most = f64::INFINITY;
        Self {
            accuracy,
            best: None,
            rivals: [None; RIVALS],
            is_crowded: false,
            lower: most,
            holds: most,
            spent: most,
            undecided: most,
            evaluations: 0,
        }
    }

    /// The nearest foot.
    pub fn best(&self) -> Option<&Entry> {
        self.best.as_ref()
    }

    /// Distance up to which a member may matter: for the foot, or for a tie with it.
    pub fn reach(&self) -> f64 {
        self.best
            .map_or(f64::INFINITY, |best| best.foot.distance + 2.0 * self.accuracy.max(best.window))
    }

    /// Takes a member's answer: its record in space, the bound that holds there, and the gap allowed to it.
    pub fn take(&mut self, entry: Entry, bound: f64, allowed: f64) {
        let foot = &entry.foot;
        self.evaluations = self.evaluations.saturating_add(foot.iterations);
        self.lower = self.lower.min(bound);
        let found = !foot.u.is_nan();
        let proven = found && foot.flags & flag::NOT_PROVEN == 0;
        if !proven {
            self.holds = self.holds.min(bound + allowed);
        }
        if foot.flags & flag::BUDGET != 0 {
            self.undecided = self.undecided.min(bound);
            if !proven {
                self.spent = self.spent.min(bound + allowed);
            }
        }
        if !found {
            return;
        }
        let ahead =
            |best: &Entry| (best.foot.distance, best.member) > (foot.distance, entry.member);
        match self.best {
            Some(best) if !ahead(&best) => self.remember(entry),
            old => {
                self.best = Some(entry);
                if let Some(old) = old {
                    self.remember(old);
                }
            }
        }
    }

    fn window(&self, a: &Entry, b: &Entry) -> f64 {
        self.accuracy.max(a.window).max(b.window)
    }

    fn is_in_reach(&self, entry: &Entry) -> bool {
        self.best.is_some_and(|best| {
            entry.foot.distance <= best.foot.distance + self.window(&best, entry)
        })
    }

    /// Whether two feet count as two: as for one shape, beyond eight times the root of distance times window.
    fn are_apart(&self, a: &Entry, b: &Entry, share: f64) -> bool {
        let (way, window) = (sub(a.d, b.d), self.window(a, b));
        dot(way, way) > share * 64.0 * window * (a.foot.distance.min(b.foot.distance) + window)
    }

    /// Keeps a foot that may tie with the best one.
    fn remember(&mut self, entry: Entry) {
        if !self.is_in_reach(&entry) {
            return;
        }
        let same = |known: &Entry| !self.are_apart(known, &entry, 0.015625);
        let place = self.rivals.iter().position(|rival| rival.as_ref().is_some_and(same));
        if let Some(known) = place.and_then(|k| self.rivals[k].as_mut()) {
            // One place: the nearer record, and the ties of both.
            let flags = (known.foot.flags | entry.foot.flags) & flag::TIE;
            if entry.foot.distance < known.foot.distance {
                *known = entry;
            }
            known.foot.flags |= flags;
            return;
        }
        let free =
            |rival: &Option<Entry>| rival.as_ref().is_none_or(|rival| !self.is_in_reach(rival));
        match self.rivals.iter().position(free) {
            Some(k) => self.rivals[k] = Some(entry),
            None => self.is_crowded = true,
        }
    }

    /// Whether another foot ties with the best one, or could not be excluded.
    fn is_tie(&self, best: &Entry) -> bool {
        if best.foot.distance <= 0.5 * self.accuracy.max(best.window) {
            return false;
        }
        let ties = |rival: &Entry| {
            self.is_in_reach(rival)
                && (rival.foot.flags & flag::TIE != 0 || self.are_apart(rival, best, 1.0))
        };
        let own = best.foot.flags & flag::BUDGET != 0;
        self.is_crowded
            || self.rivals.iter().flatten().any(ties)
            || (!own && self.undecided <= best.foot.distance + self.accuracy.max(best.window))
    }

    /// The scene's answer; `None` when no member has a foot.
    pub fn outcome(&self) -> Option<SceneFoot> {
        let best = self.best.as_ref()?;
        let mut foot = best.foot;
        foot.lower_bound = self.lower.min(foot.distance).max(0.0);
        foot.iterations = self.evaluations;
        foot.flags &= !(flag::NOT_PROVEN | flag::HINT_USED);
        if self.holds < foot.distance {
            foot.flags |= flag::NOT_PROVEN;
        }
        if self.spent < foot.distance {
            foot.flags |= flag::BUDGET;
        }
        if self.is_tie(best) {
            foot.flags |= flag::TIE;
        }
        Some(SceneFoot { foot, member: best.member })
    }
}

impl SceneFoot {
    /// The answer of a query that has none.
    pub(super) fn without_member(foot: FootPoint) -> Self {
        Self { foot, member: NO_MEMBER }
    }
}

/// The unit vector of `d`; zero when there is none.
pub fn direction(d: Vector) -> Vector {
    let size = norm(d);
    if size > 0.0 && size.is_finite() { d.map(|x| x * (1.0 / size)) } else { [0.0; 3] }
}

/// Squared distance beyond which a box of the scene's tree need not be opened, in the frame of the scene.
pub fn tree_limit(reach: f64, slack: f64) -> f64 {
    let reach = reach + slack;
    reach * reach * (1.0 + 32.0 * HALF_ULP)
}
