//! The certified search on one Bezier patch. The steps are those of `line`, in two parameters; where `h` is
//! monotone in one of them and the side is a border, the search goes on along that side.
//!
//! At a collapsed side the derivative along it vanishes for every shape: the collapsed point is looked at once,
//! and off that side the sign of the derivative of the distance itself is used (see [`Walk::turning`]).

mod area;
mod basin;
mod degrees;
mod sides;
mod tips;
mod valley;

use self::area::Area;
use super::certificate::{LEAST_C, foot_plane_separates, squared_error, underflows};
use super::line::LineMemory;
use super::proof::{Proof, Site};
use crate::bezier::Bidegree;
use crate::bounds::{HALF_ULP, Vector, dot, norm, scaled, sub};
use crate::coefficients::{Differences, Grid, Ladder, Rung};
use crate::index::{Patch, Reach, product_steps};
use crate::jet::{BezierPatch, Jet2};
use crate::knots::MAX_DEGREE;
use crate::refine::{Method, foot_on_surface};

const MAX_WAITING: usize = 128;
const LEAST_WIDTH: f64 = 1e-14;
/// Evaluations after which an iteration may have ended at its step limit.
const LONG: u32 = 40;
/// Halvings after which coefficients are rebuilt from the poles, to shed their rounding, where the gap is so many errors.
const FRESH: u32 = 12;
const BLUR: f64 = 4096.0;
/// Boxes after which a patch is hard: there planes, tried at every second halving, close what squares do not.
const HARD: u64 = 32;
const TILT_EVERY: u32 = 2;
/// Halvings of a patch in each direction before lower degrees are thought of.
const WHOLE: [u32; 2] = [2; 2];
/// Tilted planes that a query tries before one in 16 must have closed its box.
const TILT_TRIES: u64 = 16;
/// In a walk for ties: cuts of larger areas before one in 8 must have closed its area.
const TIE_TRIES: u64 = 8;

/// A patch in the search.
pub struct Sheet<'a> {
    /// Its poles.
    pub net: BezierPatch<'a>,
    /// Its borders and collapsed sides.
    pub patch: &'a Patch,
    /// Its number.
    pub piece: usize,
    /// Tensors A, -2 B, C, when they are kept and the whole patch is searched.
    pub tensors: Option<&'a [f64]>,
    /// The query in the patch's coordinates.
    pub query: Vector,
    /// How far `r / W` computed may be off.
    pub position: f64,
    /// Part that is searched: s low, s high, t low, t high.
    pub range: [f64; 4],
    /// Whether a foot with a gradient may sit on the four sides of `range`.
    pub border: [bool; 4],
    /// The coefficient arrays of all degrees.
    pub ladder: &'a Ladder,
    /// Those of edges along s and along t.
    pub edge_grids: &'a [Grid; 2],
    /// Local iteration.
    pub method: Method,
    /// How far normals may be followed, where a foot may settle the search.
    pub reach: Option<&'a Reach>,
    /// Boxes after which the patch is put off.
    pub patience: u64,
}

impl Sheet<'_> {
    fn far(&self) -> Far<'_> {
        let (net, tensors, radius) = (self.net, self.tensors, self.patch.radius);
        let (query, position, grid) = (self.query, self.position, self.ladder.whole());
        Far { net, tensors, radius, query, position, grid }
    }
}

/// A patch before anything is set up for its search.
pub struct Far<'a> {
    /// As of [`Sheet`].
    pub net: BezierPatch<'a>,
    /// As of [`Sheet`].
    pub tensors: Option<&'a [f64]>,
    /// Greatest distance of a pole from the origin of the patch.
    pub radius: f64,
    /// As of [`Sheet`].
    pub query: Vector,
    /// As of [`Sheet`].
    pub position: f64,
    /// As of [`Sheet`].
    pub grid: &'a Grid,
}

impl Far<'_> {
    /// Whether a plane shows that nothing is nearer than the target, or the coefficients that nothing is within the reach of
    /// ties: most patches go here, and leave no trace.
    pub fn decides(&self, proof: &Proof) -> bool {
        if !proof.best.is_finite() {
            return false;
        }
        let (net, count) = (&self.net, self.net.degree.count());
        let (p, position) = (self.query, self.position);
        if foot_plane_separates(net.poles, count, net.rational, p, proof, position) {
            return true;
        }
        self.tensors.is_some_and(|tensors| {
            let square = dot(p, p);
            let radius = self.radius + square.sqrt();
            let error = squared_error(position, radius, product_steps(count));
            let far = proof.level_squared().max(proof.tie_squared());
            let mu = far + error + 8.0 * HALF_ULP * far;
            self.grid.product_beyond(tensors, p, square, mu, LEAST_C)
        })
    }
}

/// Memory of the search on patches.
#[derive(Clone, Debug, Default)]
pub struct PatchMemory {
    waiting: Vec<Area>,
    coefficients: Vec<f64>,
    net: Vec<f64>,
    lanes: Vec<[f64; 4]>,
    h: Vec<f64>,
    edge: Vec<f64>,
    turning: Vec<f64>,
    valley: Vec<f64>,
    weights: Vec<f64>,
    line: LineMemory,
}

impl PatchMemory {
    fn reserve(&mut self, degree: Bidegree, grid: &Grid) {
        if self.h.len() < grid.stride {
            // As if rational, so that shapes with and without weights take turns without growing.
            self.coefficients.resize(2 * grid.stride * MAX_WAITING, 0.0);
            self.h.resize(grid.stride, 0.0);
            self.waiting.reserve(MAX_WAITING);
            self.edge.resize(4 * (MAX_DEGREE + 1) + 4 * (2 * MAX_DEGREE + 1), 0.0);
        }
        if self.net.len() < 4 * degree.count() {
            self.net.resize(4 * degree.count(), 0.0);
            self.lanes.resize(degree.count(), [0.0; 4]);
        }
    }
}

/// Searches the patch; see [`search_line`] for what holds on return. False when patience ran out: then nothing holds
/// but the best foot, and the patch is to be searched again.
pub fn search_patch(sheet: &Sheet, memory: &mut PatchMemory, proof: &mut Proof) -> bool {
    memory.reserve(sheet.net.degree, sheet.ladder.whole());
    memory.waiting.clear();
    let (slot, start) = (sheet.ladder.whole().slot(), proof.spent);
    let speed = if proof.tying { sheet.net.speed() } else { [0.0; 2] };
    Walk { sheet, memory, proof, slot, start, speed }.run()
}

struct Walk<'a, 'b, 't> {
    sheet: &'a Sheet<'b>,
    memory: &'a mut PatchMemory,
    proof: &'a mut Proof<'t>,
    /// Doubles of a slot.
    slot: usize,
    /// Boxes that were spent before this patch.
    start: u64,
    /// In a walk for ties: how fast points move at most with each parameter, weights apart.
    speed: [f64; 2],
}

enum Verdict {
    Closed,
    HalveS,
    HalveT,
    GiveUp,
}

impl Walk<'_, '_, '_> {
    /// Whether the patch has taken many boxes, and tilted planes close enough of them.
    fn hard(&self) -> bool {
        let (tries, hits) = self.proof.tilts;
        self.proof.spent - self.start > HARD && (tries < TILT_TRIES || 16 * hits > tries)
    }

    /// Whether the poles of an area close it. They tell more than its coefficients on hard patches, by tilted planes; and whether
    /// an area holds one foot at most, or the best foot alone, when it is small.
    fn is_closed_by_poles(&mut self, area: &mut Area) -> bool {
        if self.hard() && area.age.is_multiple_of(TILT_EVERY) {
            return self.cut_free(area).is_none();
        }
        if !self.proof.tying {
            return false;
        }
        if self.may_be_one_foot(area) {
            return self.cut_free(area).is_none();
        }
        let (tries, hits) = self.proof.tie_cuts;
        if tries >= TIE_TRIES && 8 * hits <= tries {
            return false;
        }
        let closed = self.cut_free(area).is_none();
        self.proof.tie_cuts = (tries + 1, hits + u64::from(closed));
        closed
    }

    /// Whether an area may be so small that it holds one foot at most, or so near to the best foot that it holds no other: then
    /// its middle is.
    fn may_be_one_foot(&mut self, area: &Area) -> bool {
        let apart = self.proof.apart_squared();
        let [s, t] = [area.s, area.t].map(|[a, b]| b - a);
        let size = self.speed[0] * s + self.speed[1] * t;
        if size * size <= apart {
            return true;
        }
        let [s, t] = area.place([0.5; 2]);
        let d = self.sheet.net.vector(s, t, self.sheet.query);
        self.proof.evaluations += 1;
        let away = sub(d, scaled(self.proof.direction, self.proof.best));
        dot(away, away) <= apart
    }

    fn run(&mut self) -> bool {
        let [s0, s1, t0, t1] = self.sheet.range;
        let mut first = Area { s: [s0, s1], t: [t0, t1], growth: [1.0; 2], ..Area::default() };
        first.patience = WHOLE;
        self.proof.spread = self.proof.spread.max(self.sheet.patch.spread);
        self.look_at_collapsed_sides();
        if self.sheet.patch.has_collapsed() && self.sheet.far().decides(self.proof)
            || self.open(&mut first)
        {
            return true;
        }
        self.memory.waiting.push(first);
        while let Some(mut area) = self.memory.waiting.pop() {
            if self.proof.is_trivial() || self.proof.has_news() {
                return true;
            }
            if self.proof.spent - self.start > self.sheet.patience {
                return false;
            }
            let at = self.memory.waiting.len();
            match self.judge(&mut area, at) {
                Verdict::Closed => {}
                Verdict::HalveS if at + 2 <= MAX_WAITING => self.halve(area, at, 0),
                Verdict::HalveT if at + 2 <= MAX_WAITING => self.halve(area, at, 1),
                _ => {
                    let bound = self.bound(&area, at);
                    self.proof.give_up(bound);
                }
            }
        }
        true
    }

    /// The coefficients of the whole range in slot 0; true when a plane already separates the query.
    fn open(&mut self, first: &mut Area) -> bool {
        match self.sheet.tensors {
            Some(tensors) => {
                self.multiply(tensors, first);
                false
            }
            None => self.load(first, 0),
        }
    }

    /// Slot 0 from the tensors.
    fn multiply(&mut self, tensors: &[f64], area: &mut Area) {
        let p = self.sheet.query;
        let square = dot(p, p);
        let slot = &mut self.memory.coefficients[..self.slot];
        self.sheet.ladder.whole().multiply(tensors, p, square, slot);
        let radius = self.sheet.patch.radius + square.sqrt();
        let (position, terms) = (self.sheet.position, self.sheet.net.degree.count());
        self.set_error(area, 0, radius, position, terms);
    }

    fn set_error(&self, area: &mut Area, at: usize, radius: f64, position: f64, terms: usize) {
        let mu = if self.proof.target.is_finite() { self.proof.target_squared } else { 0.0 };
        area.error = squared_error(position, radius, product_steps(terms)) + 8.0 * HALF_ULP * mu;
        if self.sheet.net.rational && underflows(self.c(area, at)) {
            area.error = f64::INFINITY;
        }
        area.radius = radius;
        area.age = 0;
    }

    fn slot(&self, at: usize) -> &[f64] {
        &self.memory.coefficients[at * self.slot..(at + 1) * self.slot]
    }

    fn grid(&self, area: &Area) -> &Grid {
        self.sheet.ladder.grid(area.rung)
    }

    fn n(&self, area: &Area, at: usize) -> &[f64] {
        self.grid(area).n(self.slot(at))
    }

    fn c(&self, area: &Area, at: usize) -> &[f64] {
        self.grid(area).c(self.slot(at))
    }

    /// Whether nothing in the area is nearer than the target (in a walk for ties: than their reach).
    fn is_beyond(&mut self, area: &Area, at: usize) -> bool {
        let (level, ties) = (self.proof.level_squared(), self.proof.tie_squared());
        let mu = [level + area.error, ties + area.error];
        let [beyond, beyond_ties] = self.grid(area).all_beyond(self.slot(at), mu);
        if beyond && !beyond_ties && !self.proof.tying {
            self.proof.loosen(self.proof.target);
        }
        beyond
    }

    /// Least ratio N / C of the coefficients, its index, and the greatest C.
    fn least_ratio(&self, area: &Area, at: usize) -> (f64, usize, f64) {
        self.grid(area).least_ratio(self.slot(at))
    }

    fn bound(&self, area: &Area, at: usize) -> f64 {
        (self.least_ratio(area, at).0 - area.error).max(0.0).sqrt() * (1.0 - 4.0 * HALF_ULP)
    }

    fn judge(&mut self, area: &mut Area, at: usize) -> Verdict {
        if std::mem::take(&mut area.unformed) && self.load(area, at) {
            return Verdict::Closed;
        }
        if self.is_beyond(area, at) {
            return Verdict::Closed;
        }
        if self.proof.best == f64::INFINITY {
            let start = self.start(area, at, self.least_ratio(area, at).1);
            self.iterate(self.sheet.range, start);
            area.error += 8.0 * HALF_ULP * self.proof.target_squared;
            if self.proof.is_trivial() {
                return Verdict::Closed;
            }
        }
        let can = [area.s, area.t].map(|[a, b]| b - a >= LEAST_WIDTH);
        if !self.proof.spend() || can == [false; 2] {
            return Verdict::GiveUp;
        }
        let (mut bound, mut place, mut weight) = self.least_ratio(area, at);
        let close = bound > self.proof.level_squared() && area.age > 0;
        let blurred = self.proof.level_squared() - bound <= BLUR * area.error;
        if area.age >= FRESH && blurred || close {
            if self.load(area, at) || self.is_beyond(area, at) {
                return Verdict::Closed;
            }
            (bound, place, weight) = self.least_ratio(area, at);
        } else if self.is_closed_by_poles(area) {
            return Verdict::Closed;
        }
        let slopes = self.slopes(area, at, bound);
        for (k, [low, high]) in [slopes.s, slopes.t].into_iter().enumerate() {
            let allowance = 2.0 * area.error * area.growth[k].sqrt() * weight;
            if low > allowance || high < -allowance {
                self.follow_side(area, at, if low > allowance { 2 * k } else { 2 * k + 1 });
                return Verdict::Closed;
            }
        }
        if self.turning(area, at, weight)
            || self.convex(area, at, place, weight, &slopes)
            || self.valley(area, at, weight, &slopes)
        {
            return Verdict::Closed;
        }
        if area.small {
            // What no test can tell here is below rounding.
            let start = self.start(area, at, place);
            self.iterate([area.s[0], area.s[1], area.t[0], area.t[1]], start);
            return Verdict::Closed;
        }
        self.probe(area, at, place);
        let [along_s, along_t] = slopes.steepest(self.grid(area).degree);
        self.lower(area, at);
        // A direction narrower than the grain of doubles cannot be halved: its middle would be one of its ends.
        if can[0] && (along_s >= along_t || !can[1]) { Verdict::HalveS } else { Verdict::HalveT }
    }

    /// Differences of `N - mu C`.
    fn differences(&mut self, area: &Area, at: usize, mu: f64) -> Differences {
        let slot = &self.memory.coefficients[at * self.slot..(at + 1) * self.slot];
        self.sheet.ladder.grid(area.rung).differences(slot, mu, &mut self.memory.h)
    }

    /// Differences of `h` over every squared distance that a nearest point in this area can have: first ones of both
    /// ends, second ones of the greatest.
    fn slopes(&mut self, area: &Area, at: usize, bound: f64) -> Differences {
        let [first, last] = self.proof.counted(bound - area.error);
        let mut slopes = self.differences(area, at, last);
        if self.sheet.net.rational {
            slopes.include_first(&self.differences(area, at, first));
        }
        slopes
    }

    /// Where the distance is likely least, when coefficient `place` of slot `at` has the least ratio: as a share of the area.
    fn share(&self, area: &Area, at: usize, place: usize) -> [f64; 2] {
        self.grid(area).vertex(self.slot(at), place)
    }

    /// The best foot when it is inside, the vertex at coefficient `place` otherwise.
    fn start(&self, area: &Area, at: usize, place: usize) -> [f64; 2] {
        let inside = |at: [f64; 2]| {
            (area.s[0]..=area.s[1]).contains(&at[0]) && (area.t[0]..=area.t[1]).contains(&at[1])
        };
        match self.proof.site {
            Some(site) if site.piece == self.sheet.piece && inside(site.at) => site.at,
            _ => area.place(self.share(area, at, place)),
        }
    }

    /// Looks at one point of an area that is not closed yet, and iterates from it (over the whole patch: a foot on the border of
    /// an area would be none) when it is nearer than the target: a target far too high makes `h` concave (by its term in C).
    fn probe(&mut self, area: &Area, at: usize, place: usize) {
        let share = self.share(area, at, place);
        let enough = self.proof.level_squared() + area.error;
        // What low degrees tell of the place is less work than its point.
        let is_low = area.rung != Rung::default();
        if is_low && self.grid(area).ratio_at(self.slot(at), share) > enough {
            return;
        }
        let at = area.place(share);
        let d = self.sheet.net.vector(at[0], at[1], self.sheet.query);
        self.proof.evaluations += 1;
        if self.proof.attracts(d) {
            self.iterate(self.sheet.range, at);
        }
    }

    fn iterate(&mut self, range: [f64; 4], start: [f64; 2]) -> ([f64; 2], Jet2) {
        let surface = (self.sheet.net, self.sheet.query);
        let piece = self.sheet.piece;
        let mut found = match &mut self.proof.trace {
            None => foot_on_surface(&surface, start, range, self.sheet.method, None),
            Some(watch) => {
                let mut tell =
                    |step: u32, s: f64, t: f64, d: f64| watch(step, Site { piece, at: [s, t] }, d);
                foot_on_surface(&surface, start, range, self.sheet.method, Some(&mut tell))
            }
        };
        if self.sheet.method == Method::Maf {
            // The certificate needs the digits that a method of first order leaves.
            let taken = found.2;
            found = foot_on_surface(&surface, found.0, range, Method::Auto, None);
            found.2 += taken;
        }
        self.note(range, found, true)
    }

    /// Takes what an iteration in a range has found; `ended`: whether of itself.
    fn note(
        &mut self,
        range: [f64; 4],
        (at, jet, taken): ([f64; 2], Jet2, u32),
        ended: bool,
    ) -> ([f64; 2], Jet2) {
        let (piece, before) = (self.sheet.piece, self.proof.best);
        self.proof.iterated(taken);
        self.proof.offer(Site { piece, at }, jet.d, || jet.flat_direction());
        self.proof.rival(Site { piece, at }, jet.d);
        let inner = |k: usize| range[k] != self.sheet.range[k] && at[k / 2] == range[k];
        if !ended || (0..4).any(inner) || taken >= LONG {
            self.proof.cut_off(Site { piece, at });
        }
        self.proof.keep(Site { piece, at }, &jet);
        if self.proof.best < before {
            self.settle(Site { piece, at }, &jet);
        }
        (at, jet)
    }

    /// Whether convexity and the first-order conditions at the iteration's result prove the target; in a walk for ties,
    /// whether convexity proves that there is one foot only. `slopes`: of `h` for the greatest distance that counts.
    fn convex(
        &mut self,
        area: &Area,
        at: usize,
        place: usize,
        weight: f64,
        slopes: &Differences,
    ) -> bool {
        let [along_s, along_t] = area.growth;
        let allowance = [along_s, (along_s * along_t).sqrt(), along_t]
            .map(|growth| 4.0 * area.error * growth * weight);
        let degree = self.grid(area).degree;
        let rational = self.sheet.net.rational;
        // `h` is linear in the squared distance: convex for the least and the greatest that count, all feet are least
        // points of the area, and there is one.
        let one_foot = !rational || slopes.convexity(degree, allowance).is_some();
        let tying = self.proof.tying;
        if tying && !one_foot {
            return false;
        }
        let mu = self.proof.least_counted();
        let Some(mut m) = self.curvature(area, at, mu, allowance, slopes) else { return false };
        let start = self.start(area, at, place);
        let known = self.proof.jet_at(Site { piece: self.sheet.piece, at: start });
        if let Some(jet) = known.filter(|_| !tying) {
            // The best foot: the iteration that ended there need not be repeated to see that it is the least here.
            if self.first_order(area, start, &jet, m) {
                if !one_foot {
                    self.proof.loosen(self.proof.target);
                }
                return true;
            }
        }
        let (found, jet) = self.descend([area.s[0], area.s[1], area.t[0], area.t[1]], start);
        if tying {
            return true;
        }
        if rational && self.proof.least_counted() != mu {
            let nearer = self.proof.least_counted();
            match self.curvature(area, at, nearer, allowance, slopes) {
                Some(curvature) => m = curvature,
                None => return false,
            }
        }
        let proven = self.first_order(area, found, &jet, m);
        if proven && !one_foot {
            self.proof.loosen(self.proof.target);
        }
        proven
    }

    /// Bounds of the second derivatives of `h` for the squared distance `mu` (see [`Differences::convexity`]).
    fn curvature(
        &mut self,
        area: &Area,
        at: usize,
        mu: f64,
        allowance: [f64; 3],
        slopes: &Differences,
    ) -> Option<[f64; 3]> {
        let degree = self.grid(area).degree;
        if self.sheet.net.rational {
            self.differences(area, at, mu).convexity(degree, allowance)
        } else {
            slopes.convexity(degree, allowance)
        }
    }

    fn halve(&mut self, area: Area, at: usize, direction: usize) {
        if let Some(middle) = self.beyond_tip(&area, direction) {
            return self.cut(area, at, direction, middle);
        }
        let (low, high) =
            self.memory.coefficients[at * self.slot..(at + 2) * self.slot].split_at_mut(self.slot);
        let grid = self.sheet.ladder.grid(area.rung);
        let [least, least_high] = grid.halve(direction, low, high);
        let n = if direction == 0 { grid.degree.s } else { grid.degree.t };
        let growth = 2.0 * HALF_ULP * n as f64 * area.radius * area.radius;
        let mut child = Area { error: area.error + growth, age: area.age + 1, ..area };
        child.patience[direction] = area.patience[direction].saturating_sub(1);
        let mut pair = [child; 2];
        let [a, b] = if direction == 0 { area.s } else { area.t };
        let middle = 0.5 * (a + b);
        for (part, ends) in pair.iter_mut().zip([[a, middle], [middle, b]]) {
            *(if direction == 0 { &mut part.s } else { &mut part.t }) = ends;
            // Inside a restriction the middle may be rounded; then the halves are not those of the coefficients.
            if middle - a != b - middle {
                (part.error, part.age) = (f64::INFINITY, FRESH);
            }
        }
        if least < least_high {
            // The more promising half goes on top.
            let (low, high) = self.memory.coefficients[at * self.slot..(at + 2) * self.slot]
                .split_at_mut(self.slot);
            low.swap_with_slice(high);
            pair.swap(0, 1);
        }
        self.memory.waiting.extend(pair);
    }
}
