//! The certified search on one Bezier segment: a piece of a curve, or an edge of a patch.
//!
//! ```text
//!   box -> all N > (target^2 + e) C ?         nothing nearer than the target here
//!       -> h strictly monotone ?              only an end can be nearest: look at it, if it is a border
//!       -> h convex, first-order bound ?      the minimum is where the iteration says
//!       -> otherwise halve; every few halvings the coefficients are rebuilt from the poles
//! ```

use super::certificate::{
    free_slope, nearness, plane_separates, slope_error, squared_error, underflows, value_at,
};
use super::net::{Cut, CutFree};
use super::proof::{Proof, Site};
use super::settle::settled_on_curve;
use crate::bezier::Bidegree;
use crate::bounds::{HALF_ULP, Vector, dot, norm};
use crate::coefficients::{Differences, Grid};
use crate::index::{CurveReach, product_steps};
use crate::jet::{BezierSegment, Jet1, Lane};
use crate::knots::MAX_DEGREE;
use crate::refine::{Method, foot_on_curve};

/// Most boxes waiting on one segment: each halving leaves one, and boxes narrower than `LEAST_WIDTH` are given up.
const MAX_WAITING: usize = 64;
/// Narrowest box: below it the parameters have no digits left to tell points apart.
const LEAST_WIDTH: f64 = 1e-14;
/// Evaluations after which an iteration may have ended at its step limit.
const LONG: u32 = 40;
/// Halvings after which coefficients are rebuilt from the poles, to shed their rounding.
const FRESH: u32 = 8;
/// The same where the rounding is more than what is to be told from it.
const BLURRED: u32 = 3;

/// A segment in the search, with what the proof must know about it.
pub struct Line<'a> {
    /// Its poles.
    pub segment: BezierSegment<'a>,
    /// The query in the segment's coordinates.
    pub query: Vector,
    /// How far `r / W` computed may be off.
    pub position: f64,
    /// Part of the segment that is searched.
    pub range: [f64; 2],
    /// Whether a foot with a gradient may sit on the ends of `range`.
    pub border: [bool; 2],
    /// The local parameters of a place on the line, for the record.
    pub site: &'a dyn Fn(f64) -> Site,
    /// The coefficient arrays.
    pub grid: &'a Grid,
    /// Local iteration.
    pub method: Method,
    /// How far vectors across may be followed, where a foot may settle the search.
    pub reach: Option<&'a CurveReach>,
}

#[derive(Clone, Copy, Debug, Default)]
struct Interval {
    low: f64,
    high: f64,
    error: f64,
    radius: f64,
    age: u32,
    /// In a walk for ties: whether it holds one foot at most.
    small: bool,
}

/// Memory of the search on lines.
#[derive(Clone, Debug, Default)]
pub struct LineMemory {
    waiting: Vec<Interval>,
    coefficients: Vec<f64>,
    net: Vec<f64>,
    lanes: Vec<Lane>,
    h: Vec<f64>,
}

impl LineMemory {
    fn reserve(&mut self, grid: &Grid) {
        if self.h.len() < grid.stride {
            // As if rational, so that shapes with and without weights take turns without growing.
            self.coefficients.resize(2 * grid.stride * MAX_WAITING, 0.0);
            self.waiting.reserve(MAX_WAITING);
            self.net.resize(4 * (MAX_DEGREE + 1), 0.0);
            self.lanes.resize(MAX_DEGREE + 1, [0.0; 4]);
            self.h.resize(grid.stride, 0.0);
        }
    }
}

/// Coefficients of `N` and, when rational, of `C` on the whole range, as the caller has them.
pub enum Source<'a> {
    /// Not there: they are formed from the poles.
    Poles,
    /// The tensors of the piece (see [`Grid::multiply`]).
    Tensors(&'a [f64]),
    /// The coefficients themselves; those of C are empty when polynomial.
    Products(&'a [f64], &'a [f64]),
}

/// A [`Source`] with its rounding (see [`squared_error`]) and the radius that this was made with.
pub struct Given<'a> {
    /// Where the coefficients come from.
    pub source: Source<'a>,
    /// Their rounding; not for [`Source::Poles`].
    pub error: f64,
    /// See `error`.
    pub radius: f64,
    /// The best foot so far, when it lies on the line, and the jet there.
    pub foot: Option<(f64, Jet1)>,
}

/// Searches the line. On return every point of it is at least `proof.target` away, or given up in `proof.lower`,
/// or cannot be the nearest point of the whole shape.
pub fn search_line(line: &Line, given: &Given, memory: &mut LineMemory, proof: &mut Proof) {
    Walk::new(line, memory, proof).run(given);
}

struct Walk<'a, 'b, 't> {
    line: &'a Line<'b>,
    memory: &'a mut LineMemory,
    proof: &'a mut Proof<'t>,
    slot: usize,
    /// Where the last iteration ended, here or before.
    last: Option<(f64, Jet1)>,
}

/// What became of an interval.
enum Verdict {
    Closed,
    Halve,
    GiveUp,
}

impl<'a, 'b, 't> Walk<'a, 'b, 't> {
    fn new(line: &'a Line<'b>, memory: &'a mut LineMemory, proof: &'a mut Proof<'t>) -> Self {
        memory.reserve(line.grid);
        memory.waiting.clear();
        Self { line, memory, proof, slot: line.grid.slot(), last: None }
    }

    /// Coefficients of the whole range into slot 0; true when a plane already separates the query.
    fn open(&mut self, given: &Given, first: &mut Interval) -> bool {
        let grid = self.line.grid;
        let slot = &mut self.memory.coefficients[..self.slot];
        match given.source {
            Source::Poles => return self.load(first, 0),
            Source::Tensors(tensors) => {
                let p = self.line.query;
                grid.multiply(tensors, p, dot(p, p), slot);
            }
            Source::Products(n, c) => grid.fill(n, c, slot),
        }
        let lost = underflows(self.c(0));
        first.error = if lost { f64::INFINITY } else { given.error };
        first.radius = given.radius;
        false
    }

    fn run(&mut self, given: &Given) {
        let [low, high] = self.line.range;
        self.last = given.foot;
        let mut first = Interval { low, high, ..Interval::default() };
        if self.open(given, &mut first) {
            return;
        }
        self.memory.waiting.push(first);
        while let Some(mut interval) = self.memory.waiting.pop() {
            if self.proof.is_trivial() || self.proof.has_news() {
                return;
            }
            let at = self.memory.waiting.len();
            match self.judge(&mut interval, at) {
                Verdict::Closed => {}
                Verdict::GiveUp => {
                    let bound = self.bound(&interval, at);
                    self.proof.give_up(bound);
                }
                Verdict::Halve => self.halve(interval, at),
            }
        }
    }

    fn slot(&self, at: usize) -> &[f64] {
        &self.memory.coefficients[at * self.slot..(at + 1) * self.slot]
    }

    fn c(&self, at: usize) -> &[f64] {
        self.line.grid.c(self.slot(at))
    }

    /// Least ratio N / C of the coefficients, its index, and the greatest C: a bound of the squared distance but for
    /// rounding.
    fn least_ratio(&self, at: usize) -> (f64, usize, f64) {
        self.line.grid.least_ratio(self.slot(at))
    }

    fn bound(&self, interval: &Interval, at: usize) -> f64 {
        (self.least_ratio(at).0 - interval.error).max(0.0).sqrt() * (1.0 - 4.0 * HALF_ULP)
    }

    fn judge(&mut self, interval: &mut Interval, at: usize) -> Verdict {
        if self.is_beyond(interval, at) {
            return Verdict::Closed;
        }
        let (mut least, mut place, mut weight) = self.least_ratio(at);
        if self.proof.best == f64::INFINITY {
            let start = self.vertex(interval, at, place);
            self.iterate(start, self.line.range);
            if self.proof.settled.is_some() {
                return Verdict::Closed;
            }
            interval.error += 8.0 * HALF_ULP * self.proof.target_squared;
        }
        if !self.proof.spend() || interval.high - interval.low < LEAST_WIDTH {
            return Verdict::GiveUp;
        }
        let close = least > self.proof.level_squared() && interval.age > 0;
        let blurred = interval.error > self.proof.level_squared() && interval.age >= BLURRED;
        if interval.age >= FRESH || close || blurred || self.proof.tying {
            if self.load(interval, at) || self.is_beyond(interval, at) {
                return Verdict::Closed;
            }
            (least, place, weight) = self.least_ratio(at);
        }
        let slopes = self.slopes(interval, at, least);
        if let Some(end) = monotone(slopes.t, 2.0 * interval.error * weight) {
            if self.is_border(interval, end) {
                self.look_at_end(interval, end);
            }
            return Verdict::Closed;
        }
        if self.convex(interval, at, place, weight, &slopes) {
            return Verdict::Closed;
        }
        if interval.small {
            // What no test can tell here is below rounding.
            let start = self.vertex(interval, at, place);
            self.iterate(start, [interval.low, interval.high]);
            return Verdict::Closed;
        }
        self.probe(interval, at, place);
        Verdict::Halve
    }

    /// Whether nothing in the interval is nearer than the target (in a walk for ties: than their reach).
    fn is_beyond(&mut self, interval: &Interval, at: usize) -> bool {
        let (level, ties) = (self.proof.level_squared(), self.proof.tie_squared());
        let mu = [level + interval.error, ties + interval.error];
        let [beyond, beyond_ties] = self.line.grid.all_beyond(self.slot(at), mu);
        if beyond && !beyond_ties && !self.proof.tying {
            self.proof.loosen(self.proof.target);
        }
        beyond
    }

    fn is_border(&self, interval: &Interval, end: usize) -> bool {
        let inner = if end == 0 { interval.low } else { interval.high };
        self.line.border[end] && inner == self.line.range[end]
    }

    fn look_at_end(&mut self, interval: &Interval, end: usize) {
        let s = if end == 0 { interval.low } else { interval.high };
        let jet = self.line.segment.jet(s, self.line.query);
        self.proof.evaluations += 1;
        self.proof.offer((self.line.site)(s), jet.d, || None);
        self.proof.rival((self.line.site)(s), jet.d);
    }

    /// Differences of `N - mu C`.
    fn differences(&mut self, at: usize, mu: f64) -> Differences {
        let slot = &self.memory.coefficients[at * self.slot..(at + 1) * self.slot];
        self.line.grid.differences(slot, mu, &mut self.memory.h)
    }

    /// Differences of `h` over every squared distance that a nearest point in this interval can have: first ones of both
    /// ends, second ones of the greatest.
    fn slopes(&mut self, interval: &Interval, at: usize, least: f64) -> Differences {
        let [first, last] = self.proof.counted(least - interval.error);
        let mut slopes = self.differences(at, last);
        if self.line.segment.rational {
            slopes.include_first(&self.differences(at, first));
        }
        slopes
    }

    /// Runs the local iteration in a range.
    fn iterate(&mut self, start: f64, [low, high]: [f64; 2]) -> (f64, Jet1) {
        let curve = (self.line.segment, self.line.query);
        let mut found = match &mut self.proof.trace {
            None => foot_on_curve(&curve, start, [low, high], self.line.method, None),
            Some(watch) => {
                let mut tell =
                    |step: u32, s: f64, _: f64, d: f64| watch(step, (self.line.site)(s), d);
                foot_on_curve(&curve, start, [low, high], self.line.method, Some(&mut tell))
            }
        };
        if self.line.method == Method::Maf {
            // The certificate needs the digits that a method of first order leaves.
            let taken = found.2;
            found = foot_on_curve(&curve, found.0, [low, high], Method::Auto, None);
            found.2 += taken;
        }
        let (s, jet, taken) = found;
        self.proof.iterated(taken);
        let along = || {
            let (a, b) = ((self.line.site)(0.0).at, (self.line.site)(1.0).at);
            jet.is_flat().then_some([b[0] - a[0], b[1] - a[1]])
        };
        let site = (self.line.site)(s);
        self.proof.offer(site, jet.d, along);
        self.proof.rival(site, jet.d);
        let (position, degree) = (self.line.position, self.line.segment.degree);
        let (reach, gap) = (self.line.reach, self.proof.gap);
        let bound = || settled_on_curve(reach, site, &jet, position, degree, gap);
        self.proof.settle(site, bound);
        let [first, last] = self.line.range;
        if (s == low && low != first) || (s == high && high != last) || taken >= LONG {
            self.proof.cut_off((self.line.site)(s));
        }
        self.last = Some((s, jet));
        (s, jet)
    }

    /// Where the distance is likely least, when coefficient `place` of slot `at` has the least ratio.
    fn vertex(&self, interval: &Interval, at: usize, place: usize) -> f64 {
        let [_, share] = self.line.grid.vertex(self.slot(at), place);
        interval.low + share * (interval.high - interval.low)
    }

    /// Looks at one point of an interval that is not closed yet, and iterates from it when it is nearer than the
    /// best: a target far too high makes `h` concave (by its term in C), and no test could ever close.
    fn probe(&mut self, interval: &Interval, at: usize, place: usize) {
        let s = self.vertex(interval, at, place);
        let jet = self.line.segment.jet(s, self.line.query);
        self.proof.evaluations += 1;
        if self.proof.attracts(jet.d) {
            self.iterate(s, self.line.range);
        }
    }

    /// Whether convexity and the first-order conditions at the iteration's result prove the target; in a walk for ties,
    /// whether convexity proves that there is one foot only. `slopes`: of `h` for the greatest distance that counts.
    fn convex(
        &mut self,
        interval: &Interval,
        at: usize,
        place: usize,
        weight: f64,
        slopes: &Differences,
    ) -> bool {
        let allowance = 4.0 * interval.error * weight;
        let rational = self.line.segment.rational;
        // `h` is linear in the squared distance: convex for the least and the greatest that count, all feet are least
        // points of the interval, and there is one.
        let one_foot = !rational || self.second_derivative(slopes, allowance) > 0.0;
        let tying = self.proof.tying;
        if tying && !one_foot {
            return false;
        }
        let mu = self.proof.least_counted();
        let mut m = self.curvature(at, mu, allowance, slopes);
        if m <= 0.0 {
            return false;
        }
        let here = |s: f64| (interval.low..=interval.high).contains(&s);
        let known = self.last.filter(|(s, _)| !tying && here(*s));
        if known.is_some_and(|(s, jet)| self.first_order(interval, s, &jet, m)) {
            // The iteration that ended there need not be repeated to see that it is the least here.
            if !one_foot {
                self.proof.loosen(self.proof.target);
            }
            return true;
        }
        let start = self.vertex(interval, at, place);
        let (s, jet) = self.iterate(start, [interval.low, interval.high]);
        if tying {
            return true;
        }
        if rational && self.proof.least_counted() != mu {
            m = self.curvature(at, self.proof.least_counted(), allowance, slopes);
        }
        let proven = m > 0.0 && self.first_order(interval, s, &jet, m);
        if proven && !one_foot {
            self.proof.loosen(self.proof.target);
        }
        proven
    }

    /// A lower bound of the second derivative of `h` for the squared distance `mu`, in the interval's own unit parameter.
    fn curvature(&mut self, at: usize, mu: f64, allowance: f64, slopes: &Differences) -> f64 {
        if self.line.segment.rational {
            let differences = self.differences(at, mu);
            self.second_derivative(&differences, allowance)
        } else {
            self.second_derivative(slopes, allowance)
        }
    }

    fn second_derivative(&self, differences: &Differences, allowance: f64) -> f64 {
        let n = self.line.grid.degree.t as f64;
        n * (n - 1.0) * (differences.tt - allowance)
    }

    /// `h >= h(s) - g^2 / (2 m)` on the interval; with `g` the slope that can lower h and `m` the curvature.
    fn first_order(&self, interval: &Interval, s: f64, jet: &Jet1, m: f64) -> bool {
        let position = self.line.position;
        let value = value_at(norm(jet.d), jet.w[0], position, self.proof);
        let slack =
            slope_error(norm(jet.d), norm(jet.s), jet.w[0], position, self.line.segment.degree);
        let width = interval.high - interval.low;
        let excess = dot(jet.d, jet.d) - self.proof.target_squared;
        let g = 2.0 * jet.w[0] * (jet.w[1] * excess + jet.w[0] * jet.gradient());
        let g = free_slope(g * width, slack * width, s <= interval.low, s >= interval.high);
        value > 0.0 && g * g <= 2.0 * m * value * (1.0 - 1e-12)
    }

    /// Rebuilds the coefficients of slot `at` from the poles; true when a plane already separates the query.
    fn load(&mut self, interval: &mut Interval, at: usize) -> bool {
        let segment = &self.line.segment;
        let (p, size) = (segment.degree, segment.degree + 1);
        let net = &mut self.memory.net[..4 * size];
        let Cut { radius, .. } = segment.level.run(CutFree {
            poles: segment.lanes,
            degree: Bidegree { s: 0, t: p },
            rational: segment.rational,
            s: [0.0, 1.0],
            t: [interval.low, interval.high],
            query: self.line.query,
            lower: None,
            lanes: &mut self.memory.lanes[..size],
            net,
        });
        if self.proof.best.is_finite() && plane_separates(net, size, self.proof, self.line.position)
        {
            return true;
        }
        if self.proof.tying {
            let near = nearness(net, size, self.proof);
            interval.small = near.small;
            if near.around_foot {
                return true;
            }
        }
        let slot = &mut self.memory.coefficients[at * self.slot..(at + 1) * self.slot];
        self.line.grid.square(&mut self.memory.lanes[..size], slot);
        let mu = if self.proof.best.is_finite() { self.proof.target_squared } else { 0.0 };
        let error = squared_error(self.line.position, radius, product_steps(3 * size));
        let lost = self.line.segment.rational && underflows(self.c(at));
        let error = if lost { f64::INFINITY } else { error + 8.0 * HALF_ULP * mu };
        *interval = Interval { error, radius, age: 0, ..*interval };
        false
    }

    fn halve(&mut self, interval: Interval, at: usize) {
        if at + 2 > MAX_WAITING {
            let bound = self.bound(&interval, at);
            self.proof.give_up(bound);
            return;
        }
        let (low, high) =
            self.memory.coefficients[at * self.slot..(at + 2) * self.slot].split_at_mut(self.slot);
        let [least, least_high] = self.line.grid.halve(1, low, high);
        let middle = 0.5 * (interval.low + interval.high);
        let n = self.line.grid.degree.t as f64;
        let growth = 2.0 * HALF_ULP * n * interval.radius * interval.radius;
        let child = Interval { error: interval.error + growth, age: interval.age + 1, ..interval };
        let mut pair = [Interval { high: middle, ..child }, Interval { low: middle, ..child }];
        // Inside a restriction the middle may be rounded; then the halves are not those of the coefficients.
        if middle - interval.low != interval.high - middle {
            for part in &mut pair {
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

/// The end at which `h` is least, when its differences along t show it to be strictly monotone.
fn monotone([low, high]: [f64; 2], allowance: f64) -> Option<usize> {
    if low > allowance {
        return Some(0);
    }
    (high < -allowance).then_some(1)
}
