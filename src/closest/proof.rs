//! The state of one query: the best foot so far, what is proven, what was given up.

use crate::bounds::{HALF_ULP, Vector, dot, norm, scaled, sub};

/// Feet remembered for ties; more of them say no more.
const RIVALS: usize = 6;

/// Boxes searched for ties; a query on a continuum would have them all.
const RIVAL_SEARCHES: usize = 8;

/// Where the best foot lies: a piece and its local parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Site {
    /// Segment or patch.
    pub piece: usize,
    /// Local parameters, each in [0, 1].
    pub at: [f64; 2],
}

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
    /// Local parameter direction in which the best foot is stationary to second order, if there is one.
    pub flat: Option<[f64; 2]>,
    rivals: [Vector; RIVALS],
    rival_count: usize,
    rival_searches: usize,
    /// What must be proven everywhere: `best - gap`, at least zero.
    pub target: f64,
    /// An upper bound of the target's square.
    pub target_squared: f64,
    /// Least bound of all boxes that were given up.
    pub lower: f64,
    /// Greatest displacement of the nets visited (collapsed edges made exact).
    pub spread: f64,
    /// Boxes looked at, of `budget`.
    pub spent: u64,
    /// Most boxes.
    pub budget: u64,
    /// Evaluations of the shape.
    pub evaluations: u32,
    /// Whether the budget ran out.
    pub exhausted: bool,
    /// Told of each iteration: step, place, distance.
    pub trace: Option<Watch<'t>>,
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
            flat: None,
            rivals: [[0.0; 3]; RIVALS],
            rival_count: 0,
            rival_searches: 0,
            target: f64::INFINITY,
            target_squared: f64::INFINITY,
            lower: f64::INFINITY,
            spread: 0.0,
            spent: 0,
            budget,
            evaluations: 0,
            exhausted: false,
            trace,
        }
    }

    /// Takes the point at `site`, `d` away from the query, if it is nearer than the best; `flat` tells the direction in
    /// which the distance is stationary to second order there.
    pub fn offer(&mut self, site: Site, d: Vector, flat: impl FnOnce() -> Option<[f64; 2]>) {
        let distance = norm(d);
        if distance.is_nan() || distance >= self.best {
            return;
        }
        let old = scaled(self.direction, self.best);
        self.best = distance;
        self.direction = scaled(d, 1.0 / distance);
        if self.site.is_some() {
            self.rival(old);
        }
        self.flat = flat();
        self.site = Some(site);
        self.target = (distance - self.gap).max(0.0);
        self.target_squared = self.target * self.target * (1.0 + 8.0 * HALF_ULP);
    }

    /// Remembers a foot that may tie with the best one; the best itself, met again, is none.
    pub fn rival(&mut self, d: Vector) {
        let near = norm(d) <= self.best + self.window();
        if near && self.rival_count < RIVALS && self.is_elsewhere(d) {
            self.rivals[self.rival_count] = d;
            self.rival_count += 1;
        }
    }

    /// Whether it is worth looking for a foot in a box that is closed but for ties. Counts the calls.
    pub fn seeks_rivals(&mut self) -> bool {
        self.rival_searches += 1;
        self.rival_count < RIVALS && self.rival_searches <= RIVAL_SEARCHES
    }

    /// Square of the greatest distance that ties.
    pub fn tie_squared(&self) -> f64 {
        let reach = self.best + self.window();
        reach * reach
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

    /// Whether a remembered foot lies elsewhere, and as near as the best.
    pub fn is_tied(&self) -> bool {
        let near = |d: Vector| norm(d) <= self.best + self.window();
        self.rivals[..self.rival_count].iter().any(|&d| near(d) && self.is_elsewhere(d))
    }

    /// Points around one foot are within the window up to `sqrt(2 window best / (1 - best k))` from it, so a foot
    /// counts as another from several times that on.
    fn is_elsewhere(&self, d: Vector) -> bool {
        let move_ = sub(d, scaled(self.direction, self.best));
        dot(move_, move_) > 64.0 * self.window() * (self.best + self.window())
    }

    /// Whether nothing is left to prove: every shape is at least zero away.
    pub fn is_trivial(&self) -> bool {
        self.target == 0.0
    }

    /// Gives up a part of the shape whose distance is at least `bound`.
    pub fn give_up(&mut self, bound: f64) {
        self.lower = self.lower.min(bound);
    }

    /// Counts one box; false when the budget is gone.
    pub fn spend(&mut self) -> bool {
        self.spent += 1;
        self.exhausted |= self.spent > self.budget;
        !self.exhausted
    }

    /// The bound proven by a walk that ended.
    pub fn proven(&self) -> f64 {
        (self.target.min(self.lower) - self.spread).max(0.0)
    }
}
