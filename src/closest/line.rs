//! The certified search on one Bezier segment: a piece of a curve, or an edge of a patch.
//!
//! ```text
//!   box -> all N > (target^2 + e) C ?         nothing nearer than the target here
//!       -> h strictly monotone ?              only an end can be nearest: look at it, if it is a border
//!       -> h convex, first-order bound ?      the minimum is where the iteration says
//!       -> otherwise halve; every few halvings the coefficients are rebuilt from the poles
//! ```

use super::certificate::{
    free_slope, nearness, plane_separates, slope_error, square, squared_error, subtract_query,
    underflows, value_at,
};
use super::proof::{Proof, Site};
use crate::bezier::{Bidegree, cut, halve_t};
use crate::bounds::{HALF_ULP, Vector, dot, extent, norm};
use crate::index::product_steps;
use crate::jet::{BezierSegment, Jet1};
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
    /// Local iteration.
    pub method: Method,
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
    h: Vec<f64>,
}

impl LineMemory {
    fn reserve(&mut self, degree: usize) {
        let slot = 2 * (2 * degree + 1);
        if self.coefficients.len() < slot * MAX_WAITING {
            self.coefficients.resize(slot * MAX_WAITING, 0.0);
            self.waiting.reserve(MAX_WAITING);
            self.net.resize(4 * (MAX_DEGREE + 1), 0.0);
            self.h.resize(2 * (2 * MAX_DEGREE + 1), 0.0);
        }
    }
}

/// Coefficients handed over by the caller: those of `N` and, when rational, of `C` on the whole range.
pub struct Given<'a> {
    /// Coefficients of N.
    pub n: &'a [f64],
    /// Coefficients of C, empty when polynomial.
    pub c: &'a [f64],
    /// Their rounding (see [`squared_error`]) and the radius it was made with.
    pub error: f64,
    /// See `error`.
    pub radius: f64,
}

/// Searches the line. On return every point of it is at least `proof.target` away, or given up in `proof.lower`,
/// or cannot be the nearest point of the whole shape.
pub fn search_line(line: &Line, given: Option<Given>, memory: &mut LineMemory, proof: &mut Proof) {
    Walk::new(line, memory, proof).run(given);
}

struct Walk<'a, 'b, 't> {
    line: &'a Line<'b>,
    memory: &'a mut LineMemory,
    proof: &'a mut Proof<'t>,
    /// Coefficients of one polynomial.
    count: usize,
    slot: usize,
}

/// What became of an interval.
enum Verdict {
    Closed,
    Halve,
    GiveUp,
}

impl<'a, 'b, 't> Walk<'a, 'b, 't> {
    fn new(line: &'a Line<'b>, memory: &'a mut LineMemory, proof: &'a mut Proof<'t>) -> Self {
        memory.reserve(line.segment.degree);
        memory.waiting.clear();
        let count = 2 * line.segment.degree + 1;
        Self {
            line,
            memory,
            proof,
            count,
            slot: if line.segment.rational { 2 * count } else { count },
        }
    }

    fn run(&mut self, given: Option<Given>) {
        let [low, high] = self.line.range;
        let mut first = Interval { low, high, ..Interval::default() };
        match given {
            Some(given) => {
                self.memory.coefficients[..self.count].copy_from_slice(given.n);
                if self.line.segment.rational {
                    self.memory.coefficients[self.count..self.slot].copy_from_slice(given.c);
                }
                let lost = underflows(given.c);
                first.error = if lost { f64::INFINITY } else { given.error };
                first.radius = given.radius;
            }
            None => {
                if self.load(&mut first, 0) {
                    return;
                }
            }
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

    fn n(&self, at: usize) -> &[f64] {
        &self.memory.coefficients[at * self.slot..at * self.slot + self.count]
    }

    fn c(&self, at: usize) -> &[f64] {
        &self.memory.coefficients[at * self.slot + self.count..(at + 1) * self.slot]
    }

    /// Least ratio N / C of the coefficients and its index: a bound of the squared distance but for rounding.
    fn least_ratio(&self, at: usize) -> (f64, usize) {
        let mut least = (f64::INFINITY, 0);
        for (k, &n) in self.n(at).iter().enumerate() {
            let ratio = if self.line.segment.rational { n / self.c(at)[k] } else { n };
            if ratio < least.0 {
                least = (ratio, k);
            }
        }
        least
    }

    fn bound(&self, interval: &Interval, at: usize) -> f64 {
        (self.least_ratio(at).0 - interval.error).max(0.0).sqrt() * (1.0 - 4.0 * HALF_ULP)
    }

    fn judge(&mut self, interval: &mut Interval, at: usize) -> Verdict {
        let (mut least, mut place) = self.least_ratio(at);
        if self.is_beyond(interval, least) {
            return Verdict::Closed;
        }
        if self.proof.best == f64::INFINITY {
            self.iterate(interval, place, self.line.range);
            interval.error += 8.0 * HALF_ULP * self.proof.target_squared;
        }
        if !self.proof.spend() || interval.high - interval.low < LEAST_WIDTH {
            return Verdict::GiveUp;
        }
        let close = least > self.proof.level_squared() && interval.age > 0;
        if interval.age >= FRESH || close || self.proof.tying {
            if self.load(interval, at) {
                return Verdict::Closed;
            }
            (least, place) = self.least_ratio(at);
            if self.is_beyond(interval, least) {
                return Verdict::Closed;
            }
        }
        if let Some(end) = self.monotone(interval, at, least) {
            if self.is_border(interval, end) {
                self.look_at_end(interval, end);
            }
            return Verdict::Closed;
        }
        if self.convex(interval, at, place) {
            return Verdict::Closed;
        }
        if interval.small {
            // What no test can tell here is below rounding.
            self.iterate(interval, place, [interval.low, interval.high]);
            return Verdict::Closed;
        }
        self.probe(interval, place);
        Verdict::Halve
    }

    /// Whether nothing in the interval is nearer than the target (in a walk for ties: than their reach).
    fn is_beyond(&mut self, interval: &Interval, least: f64) -> bool {
        if least.is_nan() || least <= self.proof.level_squared() + interval.error {
            return false;
        }
        if least <= self.proof.tie_squared() + interval.error {
            self.proof.loosen(self.proof.target);
        }
        true
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

    /// Coefficients of `N - mu C` into half `part` of the scratch memory.
    fn form(&mut self, at: usize, part: usize, mu: f64) {
        for k in 0..self.count {
            let n = self.n(at)[k];
            let c = if self.line.segment.rational { self.c(at)[k] } else { 1.0 };
            self.memory.h[part * self.count + k] = n - mu * c;
        }
    }

    fn greatest_weight(&self, at: usize) -> f64 {
        if self.line.segment.rational { extent(self.c(at)).1 } else { 1.0 }
    }

    /// The end at which `h` is least, when it is strictly monotone for every squared distance that a nearest
    /// point in this interval can have.
    fn monotone(&mut self, interval: &Interval, at: usize, least: f64) -> Option<usize> {
        let [first, last] = self.proof.counted(least - interval.error);
        self.form(at, 0, first);
        self.form(at, 1, last);
        let allowance = 2.0 * interval.error * self.greatest_weight(at);
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for h in self.memory.h[..2 * self.count].chunks_exact(self.count) {
            for pair in h.windows(2) {
                low = low.min(pair[1] - pair[0]);
                high = high.max(pair[1] - pair[0]);
            }
        }
        if low > allowance {
            return Some(0);
        }
        (high < -allowance).then_some(1)
    }

    /// Runs the local iteration in a range from the Greville abscissa of coefficient `place`.
    fn iterate(&mut self, interval: &Interval, place: usize, [low, high]: [f64; 2]) -> (f64, Jet1) {
        let curve = (self.line.segment, self.line.query);
        let start = self.abscissa(interval, place);
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
        self.proof.evaluations += taken;
        let along = || {
            let (a, b) = ((self.line.site)(0.0).at, (self.line.site)(1.0).at);
            jet.is_flat().then_some([b[0] - a[0], b[1] - a[1]])
        };
        self.proof.offer((self.line.site)(s), jet.d, along);
        self.proof.rival((self.line.site)(s), jet.d);
        let [first, last] = self.line.range;
        if (s == low && low != first) || (s == high && high != last) || taken >= LONG {
            self.proof.cut_off((self.line.site)(s));
        }
        (s, jet)
    }

    /// The Greville abscissa of coefficient `place`.
    fn abscissa(&self, interval: &Interval, place: usize) -> f64 {
        let share = place as f64 / (self.count - 1) as f64;
        interval.low + share * (interval.high - interval.low)
    }

    /// Looks at one point of an interval that is not closed yet, and iterates from it when it is nearer than the
    /// best: a target far too high makes `h` concave (by its term in C), and no test could ever close.
    fn probe(&mut self, interval: &Interval, place: usize) {
        let jet = self.line.segment.jet(self.abscissa(interval, place), self.line.query);
        self.proof.evaluations += 1;
        if self.proof.attracts(jet.d) {
            self.iterate(interval, place, self.line.range);
        }
    }

    /// Whether convexity and the first-order conditions at the iteration's result prove the target; in a walk for ties,
    /// whether convexity proves that there is one foot only.
    fn convex(&mut self, interval: &Interval, at: usize, place: usize) -> bool {
        let weight = self.greatest_weight(at);
        let mu = self.proof.level_squared();
        if self.curvature(interval, at, weight, mu) <= 0.0 {
            return false;
        }
        if self.proof.tying && !self.has_one_foot(interval, at, weight) {
            return false;
        }
        let (s, jet) = self.iterate(interval, place, [interval.low, interval.high]);
        if self.proof.tying {
            return true;
        }
        let curvature = self.curvature(interval, at, weight, self.proof.target_squared);
        if curvature <= 0.0 || !self.first_order(interval, s, &jet, curvature) {
            return false;
        }
        if self.line.segment.rational && !self.has_one_foot(interval, at, weight) {
            self.proof.loosen(self.proof.target);
        }
        true
    }

    /// Whether `h`, convex at the level, is so for every squared distance of a foot that counts (it is linear in that, so
    /// the other end of them decides): then all feet
    /// are least points of the interval, and there is one.
    fn has_one_foot(&mut self, interval: &Interval, at: usize, weight: f64) -> bool {
        let target = self.proof.target;
        let [first, last] = self.proof.counted(target * target);
        let other = if self.proof.tying { first } else { last };
        self.curvature(interval, at, weight, other) > 0.0
    }

    /// A lower bound of the second derivative of `h` for the squared distance `mu`, in the interval's own unit parameter.
    fn curvature(&mut self, interval: &Interval, at: usize, weight: f64, mu: f64) -> f64 {
        self.form(at, 0, mu);
        let n = (self.count - 1) as f64;
        let h = &self.memory.h[..self.count];
        let least =
            h.windows(3).map(|w| (w[2] - w[1]) - (w[1] - w[0])).fold(f64::INFINITY, f64::min);
        n * (n - 1.0) * (least - 4.0 * interval.error * weight)
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
        let p = self.line.segment.degree;
        let size = p + 1;
        let components = if self.line.segment.rational { 4 } else { 3 };
        let net = &mut self.memory.net[..4 * size];
        net[..components * size].copy_from_slice(self.line.segment.poles);
        net[components * size..].fill(1.0);
        for component in net[..components * size].chunks_exact_mut(size) {
            cut(component, p, 1, 1, interval.low, interval.high);
        }
        let radius = subtract_query(net, size, self.line.query);
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
        square(net, Bidegree { s: 0, t: p }, slot);
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
        let degree = Bidegree { s: 0, t: self.count - 1 };
        let (low, high) =
            self.memory.coefficients[at * self.slot..(at + 2) * self.slot].split_at_mut(self.slot);
        for (a, b) in low.chunks_exact_mut(self.count).zip(high.chunks_exact_mut(self.count)) {
            halve_t(a, b, degree);
        }
        let middle = 0.5 * (interval.low + interval.high);
        let growth = 2.0 * HALF_ULP * (self.count - 1) as f64 * interval.radius * interval.radius;
        let child = Interval { error: interval.error + growth, age: interval.age + 1, ..interval };
        let mut pair = [Interval { high: middle, ..child }, Interval { low: middle, ..child }];
        // Inside a restriction the middle may be rounded; then the halves are not those of the coefficients.
        if middle - interval.low != interval.high - middle {
            for part in &mut pair {
                (part.error, part.age) = (f64::INFINITY, FRESH);
            }
        }
        if self.least_ratio(at).0 < self.least_ratio(at + 1).0 {
            // The more promising half goes on top.
            let (low, high) = self.memory.coefficients[at * self.slot..(at + 2) * self.slot]
                .split_at_mut(self.slot);
            low.swap_with_slice(high);
            pair.swap(0, 1);
        }
        self.memory.waiting.extend(pair);
    }
}
