//! The certified search on one Bezier patch. The steps are those of `line`, in two parameters; where `h` is
//! monotone in one of them and the side is a border, the search goes on along that side.
//!
//! At a collapsed side the derivative along it vanishes for every shape: the collapsed point is looked at once,
//! and off that side the sign of the derivative of the distance itself is used (see [`Walk::turning`]).

mod basin;
mod sides;
mod tips;
mod valley;

use super::certificate::{
    LEAST_C, foot_plane_separates, least_height, nearness, plane_separates, squared_error,
    tilted_height, underflows,
};
use super::line::LineMemory;
use super::net::CutFree;
use super::proof::{Proof, Site};
use crate::bezier::Bidegree;
use crate::bounds::{HALF_ULP, Vector, dot, norm};
use crate::coefficients::{Differences, Grid};
use crate::index::{Patch, Reach, product_steps};
use crate::jet::{BezierPatch, Jet2};
use crate::knots::MAX_DEGREE;
use crate::refine::{Method, foot_on_surface};

const MAX_WAITING: usize = 128;
const LEAST_WIDTH: f64 = 1e-14;
/// Evaluations after which an iteration may have ended at its step limit.
const LONG: u32 = 40;
/// Halvings after which coefficients are rebuilt from the poles, to shed their rounding.
const FRESH: u32 = 12;
/// Boxes after which a patch is hard: there planes, tried at every second halving, close what squares do not.
const HARD: u64 = 32;
const TILT_EVERY: u32 = 2;
/// Tilted planes that are tried before one in 16 must have closed its box.
const TILT_TRIES: u64 = 32;

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
    /// The coefficient arrays, and those of edges along s and along t.
    pub grid: &'a Grid,
    /// See `grid`.
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
        let (query, position, grid) = (self.query, self.position, self.grid);
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

#[derive(Clone, Copy, Debug, Default)]
struct Area {
    s: [f64; 2],
    t: [f64; 2],
    error: f64,
    radius: f64,
    age: u32,
    /// In a walk for ties: whether it holds one foot at most.
    small: bool,
    /// Whether its slot holds nothing yet: its coefficients are formed from the poles when its turn comes.
    unformed: bool,
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
    memory.reserve(sheet.net.degree, sheet.grid);
    memory.waiting.clear();
    let (degree, slot, start) = (sheet.grid.degree, sheet.grid.slot(), proof.spent);
    Walk { sheet, memory, proof, degree, slot, start, tilts: (0, 0) }.run()
}

struct Walk<'a, 'b, 't> {
    sheet: &'a Sheet<'b>,
    memory: &'a mut PatchMemory,
    proof: &'a mut Proof<'t>,
    /// Bidegree of the product coefficients.
    degree: Bidegree,
    slot: usize,
    /// Boxes that were spent before this patch.
    start: u64,
    /// Tilted planes tried, and boxes closed by them.
    tilts: (u64, u64),
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
        let (tries, hits) = self.tilts;
        self.proof.spent - self.start > HARD && (tries < TILT_TRIES || 16 * hits > tries)
    }

    fn run(&mut self) -> bool {
        let [s0, s1, t0, t1] = self.sheet.range;
        let mut first = Area { s: [s0, s1], t: [t0, t1], ..Area::default() };
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
        self.sheet.grid.multiply(tensors, p, square, slot);
        let radius = self.sheet.patch.radius + square.sqrt();
        self.set_error(area, 0, radius, self.sheet.net.degree.count());
    }

    fn set_error(&self, area: &mut Area, at: usize, radius: f64, terms: usize) {
        let mu = if self.proof.target.is_finite() { self.proof.target_squared } else { 0.0 };
        area.error =
            squared_error(self.sheet.position, radius, product_steps(terms)) + 8.0 * HALF_ULP * mu;
        if self.sheet.net.rational && underflows(self.c(at)) {
            area.error = f64::INFINITY;
        }
        area.radius = radius;
        area.age = 0;
    }

    fn slot(&self, at: usize) -> &[f64] {
        &self.memory.coefficients[at * self.slot..(at + 1) * self.slot]
    }

    fn n(&self, at: usize) -> &[f64] {
        self.sheet.grid.n(self.slot(at))
    }

    fn c(&self, at: usize) -> &[f64] {
        self.sheet.grid.c(self.slot(at))
    }

    /// Whether nothing in the area is nearer than the target (in a walk for ties: than their reach).
    fn is_beyond(&mut self, area: &Area, at: usize) -> bool {
        let (level, ties) = (self.proof.level_squared(), self.proof.tie_squared());
        let mu = [level + area.error, ties + area.error];
        let [beyond, beyond_ties] = self.sheet.grid.all_beyond(self.slot(at), mu);
        if beyond && !beyond_ties && !self.proof.tying {
            self.proof.loosen(self.proof.target);
        }
        beyond
    }

    /// Least ratio N / C of the coefficients, its index, and the greatest C.
    fn least_ratio(&self, at: usize) -> (f64, usize, f64) {
        self.sheet.grid.least_ratio(self.slot(at))
    }

    fn bound(&self, area: &Area, at: usize) -> f64 {
        (self.least_ratio(at).0 - area.error).max(0.0).sqrt() * (1.0 - 4.0 * HALF_ULP)
    }

    fn judge(&mut self, area: &mut Area, at: usize) -> Verdict {
        if std::mem::take(&mut area.unformed) && self.load(area, at) {
            return Verdict::Closed;
        }
        if self.is_beyond(area, at) {
            return Verdict::Closed;
        }
        if self.proof.best == f64::INFINITY {
            let start = self.start(area, at, self.least_ratio(at).1);
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
        let (mut bound, mut place, mut weight) = self.least_ratio(at);
        let close = bound > self.proof.level_squared() && area.age > 0;
        if area.age >= FRESH || close {
            if self.load(area, at) || self.is_beyond(area, at) {
                return Verdict::Closed;
            }
            (bound, place, weight) = self.least_ratio(at);
        } else if (self.proof.tying || self.hard() && area.age.is_multiple_of(TILT_EVERY))
            && self.cut_free(area).is_none()
        {
            return Verdict::Closed;
        }
        let allowance = 2.0 * area.error * weight;
        let slopes = self.slopes(area, at, bound);
        for (k, [low, high]) in [slopes.s, slopes.t].into_iter().enumerate() {
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
        let [along_s, along_t] = slopes.steepest(self.degree);
        // A direction narrower than the grain of doubles cannot be halved: its middle would be one of its ends.
        if can[0] && (along_s >= along_t || !can[1]) { Verdict::HalveS } else { Verdict::HalveT }
    }

    /// Differences of `N - mu C`.
    fn differences(&mut self, at: usize, mu: f64) -> Differences {
        let slot = &self.memory.coefficients[at * self.slot..(at + 1) * self.slot];
        self.sheet.grid.differences(slot, mu, &mut self.memory.h)
    }

    /// Differences of `h` over every squared distance that a nearest point in this area can have: first ones of both
    /// ends, second ones of the greatest.
    fn slopes(&mut self, area: &Area, at: usize, bound: f64) -> Differences {
        let [first, last] = self.proof.counted(bound - area.error);
        let mut slopes = self.differences(at, last);
        if self.sheet.net.rational {
            slopes.include_first(&self.differences(at, first));
        }
        slopes
    }

    /// Where the distance is likely least, when coefficient `place` of slot `at` has the least ratio.
    fn vertex(&self, area: &Area, at: usize, place: usize) -> [f64; 2] {
        let [s, t] = self.sheet.grid.vertex(self.slot(at), place);
        [area.s[0] + s * (area.s[1] - area.s[0]), area.t[0] + t * (area.t[1] - area.t[0])]
    }

    /// The best foot when it is inside, the vertex at coefficient `place` otherwise.
    fn start(&self, area: &Area, at: usize, place: usize) -> [f64; 2] {
        let inside = |at: [f64; 2]| {
            (area.s[0]..=area.s[1]).contains(&at[0]) && (area.t[0]..=area.t[1]).contains(&at[1])
        };
        match self.proof.site {
            Some(site) if site.piece == self.sheet.piece && inside(site.at) => site.at,
            _ => self.vertex(area, at, place),
        }
    }

    /// Looks at one point of an area that is not closed yet, and iterates from it (over the whole patch: a foot on
    /// the border of an area would be none) when it is nearer than the target: a target far too high makes `h` concave (by its term in C), and no test could ever close.
    fn probe(&mut self, area: &Area, at: usize, place: usize) {
        let at = self.vertex(area, at, place);
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
        self.proof.evaluations += taken;
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
        let allowance = 4.0 * area.error * weight;
        let rational = self.sheet.net.rational;
        // `h` is linear in the squared distance: convex for the least and the greatest that count, all feet are least
        // points of the area, and there is one.
        let one_foot = !rational || slopes.convexity(self.degree, allowance).is_some();
        let tying = self.proof.tying;
        if tying && !one_foot {
            return false;
        }
        let mu = self.proof.least_counted();
        let Some(mut m) = self.curvature(at, mu, allowance, slopes) else { return false };
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
            match self.curvature(at, nearer, allowance, slopes) {
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
        at: usize,
        mu: f64,
        allowance: f64,
        slopes: &Differences,
    ) -> Option<[f64; 3]> {
        if self.sheet.net.rational {
            self.differences(at, mu).convexity(self.degree, allowance)
        } else {
            slopes.convexity(self.degree, allowance)
        }
    }

    /// Whether a plane that fits the net in the scratch memory separates it from the query.
    fn is_under_a_tilted_plane(&mut self) -> bool {
        let degree = self.sheet.net.degree;
        let (count, position) = (degree.count(), self.sheet.position);
        let corners = [0, degree.t, degree.s * (degree.t + 1), count - 1];
        let height = tilted_height(&self.memory.net[..4 * count], count, corners, self.proof);
        let beyond_ties = height > least_height(self.proof.reach(), position);
        let hit = if self.proof.tying {
            beyond_ties
        } else {
            height > least_height(self.proof.target, position)
        };
        self.tilts = (self.tilts.0 + 1, self.tilts.1 + u64::from(hit));
        if hit && !beyond_ties {
            self.proof.loosen(self.proof.target);
        }
        hit
    }

    /// The poles of an area into the scratch memory, as `r` and `W`, and their radius; `None` when a plane separates
    /// them from the query.
    fn cut_free(&mut self, area: &mut Area) -> Option<f64> {
        let patch = &self.sheet.net;
        let count = patch.degree.count();
        let net = &mut self.memory.net[..4 * count];
        let lanes = &mut self.memory.lanes[..count];
        let query = self.sheet.query;
        let (degree, rational, poles) = (patch.degree, patch.rational, patch.lanes);
        let (s, t) = (area.s, area.t);
        let cut = CutFree { poles, degree, rational, s, t, query, lanes, net };
        let radius = patch.level.run(cut);
        let known = self.proof.best.is_finite();
        if known && plane_separates(net, count, self.proof, self.sheet.position) {
            return None;
        }
        if known && self.hard() && self.is_under_a_tilted_plane() {
            return None;
        }
        if self.proof.tying {
            let near = nearness(&self.memory.net[..4 * count], count, self.proof);
            area.small = near.small;
            if near.around_foot {
                return None;
            }
        }
        Some(radius)
    }

    /// Rebuilds the coefficients of slot `at` from the poles; true when a plane already separates the query.
    fn load(&mut self, area: &mut Area, at: usize) -> bool {
        let Some(radius) = self.cut_free(area) else { return true };
        let count = self.sheet.net.degree.count();
        let slot = &mut self.memory.coefficients[at * self.slot..(at + 1) * self.slot];
        self.sheet.grid.square(&mut self.memory.lanes[..count], slot);
        self.set_error(area, at, radius, 3 * count);
        false
    }

    fn halve(&mut self, area: Area, at: usize, direction: usize) {
        if let Some(middle) = self.beyond_tip(&area, direction) {
            return self.cut(area, direction, middle);
        }
        let (low, high) =
            self.memory.coefficients[at * self.slot..(at + 2) * self.slot].split_at_mut(self.slot);
        let [least, least_high] = self.sheet.grid.halve(direction, low, high);
        let n = if direction == 0 { self.degree.s } else { self.degree.t };
        let growth = 2.0 * HALF_ULP * n as f64 * area.radius * area.radius;
        let child = Area { error: area.error + growth, age: area.age + 1, ..area };
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
