//! The state of one query: the best foot so far, what is proven, what was given up.

use crate::bounds::{HALF_ULP, Vector, dot, norm, scaled, sub};
use crate::jet::Jet2;

/// Places remembered for ties; more of them say no more.
const RIVALS: usize = 8;

/// Share of the budget that the search for ties may take, iterations from places met in it, and evaluations that count as
/// a box there.
const TIE_SHARE: u64 = 16;
const TIE_STARTS: usize = 16;
const EVALUATIONS: u32 = 32;

/// Share of the window within which distances along a continuum are the same.
pub const LEVEL: f64 = 0.015625;

/// Where the best foot lies: a piece and its local parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Site {
    /// Segment or patch.
    pub piece: usize,
    /// Local parameters, each in [0, 1].
    pub at: [f64; 2],
}

/// A place that may hold another foot as near as the best.
#[derive(Clone, Copy, Debug)]
pub struct Rival {
    /// Where.
    pub site: Site,
    /// Vector from the query.
    pub d: Vector,
    /// Whether it has been looked at.
    pub seen: bool,
}

const NOWHERE: Rival =
    Rival { site: Site { piece: 0, at: [0.0; 2] }, d: [f64::INFINITY; 3], seen: false };

/// The certificate under construction. Lengths are in the index's coordinates.
///
/// Everything that is pruned has a distance of at least the target of its time; the target only falls, so at the
/// end nothing is nearer than `min(target, lower)`.
pub struct Proof<'t> {
    /// Asked-for gap between the distance and its bound.
    pub gap: f64,
    /// Least distance found.
    pub best: f64,
    /// Where.
    pub site: Option<Site>,
    /// Unit vector from the query to the best foot.
    pub direction: Vector,
    /// The jet there, when the iteration that found it kept it (surfaces).
    jet: Option<Jet2>,
    /// Whether the iteration to the best foot ended at the side of a box, or at its step limit: it is to be continued.
    pub is_cut_off: bool,
    /// Local parameter direction in which the best foot is stationary to second order, if there is one.
    pub flat: Option<[f64; 2]>,
    rivals: [Rival; RIVALS],
    rival_count: usize,
    /// Whether a place found no room among the rivals.
    pub crowded: bool,
    /// Whether the walk is one for ties: everything is at least the target away, and boxes are closed when they hold no
    /// foot within the window but the best.
    pub tying: bool,
    tie_starts: usize,
    /// Least distance in what was closed for the target but not for ties, since the caller set it to infinity.
    pub loose: f64,
    /// What must be proven everywhere: `best - gap`, at least zero.
    pub target: f64,
    /// An upper bound of the target's square.
    pub target_squared: f64,
    /// Least bound of all boxes that were given up.
    pub lower: f64,
    /// A bound of everything that the best foot itself gave (see [`settled`](super::settle::settled)): there is no other foot within the window.
    pub settled: Option<f64>,
    /// Greatest displacement of the nets visited (collapsed edges made exact).
    pub spread: f64,
    /// Boxes looked at, of `budget`.
    pub spent: u64,
    /// Valleys tried, and areas closed by them.
    pub valleys: (u64, u64),
    /// Tilted planes tried, and boxes closed by them.
    pub tilts: (u64, u64),
    /// Nets cut out in a walk for ties, and boxes closed by them.
    pub tie_cuts: (u64, u64),
    /// Most boxes.
    pub budget: u64,
    /// Evaluations of the shape.
    pub evaluations: u32,
    /// Whether the budget ran out.
    pub exhausted: bool,
    /// Told of each iteration: step, place, distance.
    pub trace: Option<Watch<'t>>,
}

/// What a proof has come to.
#[derive(Clone, Copy, Debug, Default)]
pub struct Certificate {
    /// Evaluations of the shape.
    pub evaluations: u32,
    /// Whether the budget ran out.
    pub exhausted: bool,
    /// The bound, in the index's lengths.
    pub proven: f64,
}

/// Called with (step, place, distance) for each step of each local iteration.
pub type Watch<'t> = &'t mut dyn FnMut(u32, Site, f64);

impl<'t> Proof<'t> {
    /// Nothing found, nothing proven.
    pub fn new(gap: f64, budget: u64, trace: Option<Watch<'t>>) -> Self {
        Self {
            gap,
            best: f64::INFINITY,
            site: None,
            direction: [0.0; 3],
            jet: None,
            is_cut_off: false,
            flat: None,
            rivals: [NOWHERE; RIVALS],
            rival_count: 0,
            crowded: false,
            tying: false,
            tie_starts: TIE_STARTS,
            loose: f64::INFINITY,
            target: f64::INFINITY,
            target_squared: f64::INFINITY,
            lower: f64::INFINITY,
            settled: None,
            spread: 0.0,
            spent: 0,
            valleys: (0, 0),
            tilts: (0, 0),
            tie_cuts: (0, 0),
            budget,
            evaluations: 0,
            exhausted: false,
            trace,
        }
    }

    /// Takes the point at `site`, `d` away from the query, if it is nearer than the best (a walk for ties keeps the best
    /// as it is); `flat` tells the direction in
    /// which the distance is stationary to second order there.
    pub fn offer(&mut self, site: Site, d: Vector, flat: impl FnOnce() -> Option<[f64; 2]>) {
        let distance = norm(d);
        if distance.is_nan() || distance >= self.best || self.tying {
            return;
        }
        let old = self.site.map(|site| (site, scaled(self.direction, self.best)));
        self.best = distance;
        self.direction = scaled(d, 1.0 / distance);
        if let Some((site, d)) = old {
            self.rival(site, d);
        }
        self.flat = flat();
        self.jet = None;
        self.is_cut_off = false;
        self.site = Some(site);
        self.aim();
    }

    /// Begins with a foot of another shape, `direction` (a unit vector) and `distance` from the query: only what is
    /// nearer counts here.
    pub fn begin_within(&mut self, distance: f64, direction: Vector) {
        (self.best, self.direction) = (distance, direction);
        self.aim();
    }

    fn aim(&mut self) {
        self.target = (self.best - self.gap).max(0.0);
        self.target_squared = self.target * self.target * (1.0 + 8.0 * HALF_ULP);
    }

    /// Keeps the jet of the place just offered, if that is the best.
    pub fn keep(&mut self, site: Site, jet: &Jet2) {
        if self.site == Some(site) {
            self.jet = Some(*jet);
        }
    }

    /// Notes what the place just offered, if that is the best, shows of the whole shape; a bound that there was holds on.
    pub fn settle(&mut self, site: Site, bound: impl FnOnce() -> Option<f64>) {
        if self.site == Some(site) {
            self.settled = bound().or(self.settled);
        }
    }

    /// The jet at `site`, if that is the best foot and its jet was kept.
    pub fn jet_at(&self, site: Site) -> Option<Jet2> {
        self.jet.filter(|_| self.site == Some(site))
    }

    /// Notes of the place just offered that the iteration did not end of itself there.
    pub fn cut_off(&mut self, site: Site) {
        self.is_cut_off |= self.site == Some(site);
    }

    /// Remembers a place that may be a foot and tie with the best one; the best itself, met again, is none.
    pub fn rival(&mut self, site: Site, d: Vector) {
        if !self.is_rival(d) {
            return;
        }
        let new = Rival { site, d, seen: false };
        let known = (0..self.rival_count).find(|&k| !self.is_apart(d, self.rivals[k].d));
        match known {
            Some(k) if norm(d) < norm(self.rivals[k].d) - 0.0625 * self.window() => {
                self.rivals[k] = new;
            }
            Some(_) => {}
            None if self.rival_count < RIVALS => {
                self.rivals[self.rival_count] = new;
                self.rival_count += 1;
            }
            None => match (0..RIVALS).find(|&k| !self.is_rival(self.rivals[k].d)) {
                Some(k) => self.rivals[k] = new,
                None => self.crowded = true,
            },
        }
    }

    /// Whether any place is remembered.
    pub fn has_rivals(&self) -> bool {
        self.rival_count > 0
    }

    /// The next place that has not been looked at.
    pub fn next_rival(&mut self) -> Option<Rival> {
        let next = self.rivals[..self.rival_count].iter_mut().find(|rival| !rival.seen)?;
        next.seen = true;
        Some(*next)
    }

    /// Whether a place lies as near as the best foot, and elsewhere.
    pub fn is_rival(&self, d: Vector) -> bool {
        norm(d) <= self.reach() && self.is_apart(d, scaled(self.direction, self.best))
    }

    /// Notes that what was closed, at least `bound` away, may hold a foot that ties.
    pub fn loosen(&mut self, bound: f64) {
        self.loose = self.loose.min(bound);
    }

    /// Whether a walk for ties stops for a new rival: the caller looks at it first.
    pub fn has_news(&self) -> bool {
        self.tying && self.rivals[..self.rival_count].iter().any(|rival| !rival.seen)
    }

    /// Whether it is worth iterating from a place in a box that is not closed.
    pub fn attracts(&mut self, d: Vector) -> bool {
        if !self.tying {
            return norm(d) < self.target;
        }
        let known = &self.rivals[..self.rival_count];
        let new = self.is_rival(d) && known.iter().all(|rival| self.is_apart(d, rival.d));
        if new && self.tie_starts > 0 {
            self.tie_starts -= 1;
            return true;
        }
        false
    }

    /// Starts the search for ties; it may take a share of the budget.
    pub fn seek_ties(&mut self) {
        self.tying = true;
        self.spent = 0;
        self.budget = (self.budget / TIE_SHARE).max(1);
    }

    /// Greatest distance that is the same as the least one, rounding apart, in a continuum.
    pub fn level(&self) -> f64 {
        self.best + LEVEL * self.window()
    }

    /// Greatest distance that ties.
    pub fn reach(&self) -> f64 {
        self.best + self.window()
    }

    /// Square of the greatest distance that ties.
    pub fn tie_squared(&self) -> f64 {
        self.reach() * self.reach()
    }

    /// Square of the distance up to which nothing may be left in a box that is closed.
    pub fn level_squared(&self) -> f64 {
        if self.tying { self.tie_squared() } else { self.target_squared }
    }

    /// The squared distances that feet may have which count, when their box is at least `sqrt(bound)` away.
    pub fn counted(&self, bound: f64) -> [f64; 2] {
        let least = if self.tying { bound.max(self.target * self.target) } else { bound };
        [least.max(0.0), self.tie_squared()]
    }

    /// The least squared distance that counts in a box whose own bound is not known.
    pub fn least_counted(&self) -> f64 {
        if self.tying { self.target * self.target } else { self.target_squared }
    }

    /// Forgets what was given up, for another walk with the same best foot and half the budget.
    pub fn restart(&mut self) {
        self.lower = f64::INFINITY;
        self.spent = self.budget / 2;
        self.exhausted = false;
    }

    /// How much farther a foot may be and still tie: the accuracy.
    pub fn window(&self) -> f64 {
        2.0 * self.gap
    }

    /// Square of the distance from which on two places count as different feet.
    ///
    /// Points around one foot are within the window up to `sqrt(2 window best / (1 - best k))` from it; the planes that
    /// close boxes leave `sqrt(3 window best)`. So places are told apart from several times that on.
    pub fn apart_squared(&self) -> f64 {
        64.0 * self.window() * self.reach()
    }

    fn is_apart(&self, a: Vector, b: Vector) -> bool {
        let move_ = sub(a, b);
        dot(move_, move_) > self.apart_squared()
    }

    /// Whether nothing is left to prove: every shape is at least zero away, or the foot has shown itself alone.
    pub fn is_trivial(&self) -> bool {
        self.target == 0.0 || self.settled.is_some()
    }

    /// Gives up a part of the shape whose distance is at least `bound`.
    pub fn give_up(&mut self, bound: f64) {
        self.loosen(bound);
        if !self.tying {
            self.lower = self.lower.min(bound);
        }
    }

    /// Counts the evaluations of an iteration; in a walk for ties, which may follow a continuum slowly, they take of the budget.
    pub fn iterated(&mut self, evaluations: u32) {
        self.evaluations += evaluations;
        if self.tying {
            self.spent += u64::from(evaluations / EVALUATIONS);
        }
    }

    /// Counts one box; false when the budget is gone.
    pub fn spend(&mut self) -> bool {
        self.spent += 1;
        self.exhausted |= self.spent > self.budget;
        !self.exhausted
    }

    /// What is proven now, in short.
    pub fn certificate(&self) -> Certificate {
        let Self { evaluations, exhausted, .. } = *self;
        Certificate { evaluations, exhausted, proven: self.proven() }
    }

    /// The bound proven by a walk that ended.
    pub fn proven(&self) -> f64 {
        let bound = self.settled.unwrap_or(self.target.min(self.lower));
        (bound - self.spread).max(0.0)
    }
}

/// Notes piece `k` when its search closed something for the target only.
pub fn note_loose(k: usize, loose: &mut Vec<(f64, usize)>, proof: &mut Proof) {
    if proof.loose < f64::INFINITY {
        loose.push((proof.loose, k));
        proof.loose = f64::INFINITY;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn iterations_take_of_the_budget_of_a_walk_for_ties_alone() {
        let mut proof = Proof::new(1e-9, 10 * TIE_SHARE, None);
        proof.iterated(1_000_000);
        assert!(proof.spend());
        proof.seek_ties();
        for _ in 0..5 {
            proof.iterated(EVALUATIONS);
            assert!(proof.spend());
        }
        assert!(!proof.spend() && proof.exhausted);
        assert_eq!(proof.evaluations, 1_000_000 + 5 * EVALUATIONS);
    }
}
