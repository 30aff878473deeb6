//! The certified search on one Bezier patch. The steps are those of `line`, in two parameters; where `h` is
//! monotone in one of them and the side is a border, the search goes on along that side.
//!
//! At a collapsed side the derivative along it vanishes for every shape: the collapsed point is looked at once,
//! and off that side the sign of the derivative of the distance itself is used (see [`Walk::turning`]).

use super::certificate::{
    foot_plane_separates, free_slope, plane_separates, slope_error, square, squared_error,
    subtract_query, underflows, value_at,
};
use super::collapsed::{along, rational_slope_extent, slope_extent};
use super::differences::{Slopes, convexity};
use super::line::{Given, Line, LineMemory, search_line};
use super::proof::{Proof, Site};
use crate::bezier::{Bidegree, cut_2d, halve_s, halve_t, isocurve};
use crate::bounds::{HALF_ULP, Vector, dot, extent, least, norm};
use crate::index::{Patch, product_steps, side};
use crate::jet::{BezierPatch, BezierSegment, Jet2};
use crate::knots::MAX_DEGREE;
use crate::refine::{Method, foot_on_surface};

const MAX_WAITING: usize = 128;
const LEAST_WIDTH: f64 = 1e-14;
/// Halvings after which coefficients are rebuilt from the poles, to shed their rounding.
const FRESH: u32 = 12;

/// A patch in the search.
pub struct Sheet<'a> {
    /// Its poles.
    pub net: BezierPatch<'a>,
    /// Its borders and collapsed sides.
    pub patch: &'a Patch,
    /// Its number.
    pub piece: usize,
    /// Tensors A, -2 B, C, when they are kept.
    pub tensors: Option<&'a [f64]>,
    /// The query in the patch's coordinates.
    pub query: Vector,
    /// How far `r / W` computed may be off.
    pub position: f64,
    /// Part that is searched: s low, s high, t low, t high.
    pub range: [f64; 4],
    /// Whether a foot with a gradient may sit on the four sides of `range`.
    pub border: [bool; 4],
    /// Local iteration.
    pub method: Method,
    /// Boxes after which the patch is put off.
    pub patience: u64,
}

#[derive(Clone, Copy, Debug, Default)]
struct Area {
    s: [f64; 2],
    t: [f64; 2],
    error: f64,
    radius: f64,
    age: u32,
}

/// Memory of the search on patches.
#[derive(Clone, Debug, Default)]
pub struct PatchMemory {
    waiting: Vec<Area>,
    coefficients: Vec<f64>,
    net: Vec<f64>,
    h: Vec<f64>,
    edge: Vec<f64>,
    turning: Vec<f64>,
    weights: Vec<f64>,
    line: LineMemory,
}

impl PatchMemory {
    fn reserve(&mut self, degree: Bidegree) {
        let count = degree.times(degree).count();
        if self.h.len() < 2 * count {
            self.coefficients.resize(2 * count * MAX_WAITING, 0.0);
            self.h.resize(2 * count, 0.0);
            self.waiting.reserve(MAX_WAITING);
            self.edge.resize(4 * (MAX_DEGREE + 1) + 4 * (2 * MAX_DEGREE + 1), 0.0);
        }
        if self.net.len() < 4 * degree.count() {
            self.net.resize(4 * degree.count(), 0.0);
        }
    }
}

/// Searches the patch; see [`search_line`] for what holds on return. False when patience ran out: then nothing holds
/// but the best foot, and the patch is to be searched again.
pub fn search_patch(sheet: &Sheet, memory: &mut PatchMemory, proof: &mut Proof) -> bool {
    memory.reserve(sheet.net.degree);
    memory.waiting.clear();
    let degree = sheet.net.degree.times(sheet.net.degree);
    let count = degree.count();
    let slot = if sheet.net.rational { 2 * count } else { count };
    Walk { sheet, memory, proof, degree, count, slot }.run()
}

struct Walk<'a, 'b, 't> {
    sheet: &'a Sheet<'b>,
    memory: &'a mut PatchMemory,
    proof: &'a mut Proof<'t>,
    /// Bidegree and number of the product coefficients.
    degree: Bidegree,
    count: usize,
    slot: usize,
}

enum Verdict {
    Closed,
    HalveS,
    HalveT,
    GiveUp,
}

impl Walk<'_, '_, '_> {
    fn run(&mut self) -> bool {
        let start = self.proof.spent;
        let [s0, s1, t0, t1] = self.sheet.range;
        let mut first = Area { s: [s0, s1], t: [t0, t1], ..Area::default() };
        self.proof.spread = self.proof.spread.max(self.sheet.patch.spread);
        self.look_at_collapsed_sides();
        if self.open(&mut first) {
            return true;
        }
        self.memory.waiting.push(first);
        while let Some(mut area) = self.memory.waiting.pop() {
            if self.proof.is_trivial() {
                return true;
            }
            if self.proof.spent - start > self.sheet.patience {
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
        let (net, query, position) = (&self.sheet.net, self.sheet.query, self.sheet.position);
        let count = net.degree.count();
        let known = self.proof.best.is_finite();
        if known
            && foot_plane_separates(net.poles, count, net.rational, query, self.proof, position)
        {
            return true;
        }
        match self.sheet.tensors {
            Some(tensors) if self.sheet.range == [0.0, 1.0, 0.0, 1.0] => {
                self.multiply(tensors, first);
                false
            }
            _ => self.load(first, 0),
        }
    }

    /// The collapsed points are candidates of their own.
    fn look_at_collapsed_sides(&mut self) {
        let corner: [[f64; 2]; 4] = [[0.0, 0.0], [1.0, 0.0], [0.0, 0.0], [0.0, 1.0]];
        for k in 0..4 {
            let inner = self.sheet.range[k] == [0.0, 1.0, 0.0, 1.0][k];
            if self.sheet.patch.collapsed[k] && inner {
                let at = [0, 1].map(|c| {
                    corner[k][c].clamp(self.sheet.range[2 * c], self.sheet.range[2 * c + 1])
                });
                self.look_at(at);
            }
        }
    }

    fn look_at(&mut self, at: [f64; 2]) -> Jet2 {
        let jet = self.sheet.net.jet(at[0], at[1], self.sheet.query);
        self.proof.evaluations += 1;
        self.proof.offer(Site { piece: self.sheet.piece, at }, jet.d, || None);
        jet
    }

    /// Slot 0 from the tensors: `N = A - 2 p.B + |p|^2 C`.
    fn multiply(&mut self, tensors: &[f64], area: &mut Area) {
        let (count, p) = (self.count, self.sheet.query);
        let square = dot(p, p);
        let (a, rest) = tensors.split_at(count);
        let (x, rest) = rest.split_at(count);
        let (y, rest) = rest.split_at(count);
        let (z, c) = rest.split_at(count);
        let slot = &mut self.memory.coefficients[..self.slot];
        if self.sheet.net.rational {
            let (n, weights) = slot.split_at_mut(count);
            weights.copy_from_slice(c);
            for k in 0..count {
                n[k] = a[k] + (p[0] * x[k] + p[1] * y[k]) + (p[2] * z[k] + square * c[k]);
            }
        } else {
            for (k, n) in slot.iter_mut().enumerate() {
                *n = a[k] + (p[0] * x[k] + p[1] * y[k]) + (p[2] * z[k] + square);
            }
        }
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

    fn n(&self, at: usize) -> &[f64] {
        &self.memory.coefficients[at * self.slot..at * self.slot + self.count]
    }

    fn c(&self, at: usize) -> &[f64] {
        &self.memory.coefficients[at * self.slot + self.count..(at + 1) * self.slot]
    }

    /// Whether all coefficients of `N - mu C` are positive.
    fn all_beyond(&self, at: usize, mu: f64) -> bool {
        if self.sheet.net.rational {
            // No early exit: the loop is short and runs in vectors.
            self.n(at).iter().zip(self.c(at)).fold(true, |all, (n, c)| all & (*n > mu * c))
        } else {
            least(self.n(at)) > mu
        }
    }

    /// Whether nothing in the area is nearer than the target; a foot that ties is looked for on the way.
    fn is_beyond(&mut self, area: &Area, at: usize) -> bool {
        if !self.all_beyond(at, self.proof.target_squared + area.error) {
            return false;
        }
        if !self.all_beyond(at, self.proof.tie_squared()) && self.proof.seeks_rivals() {
            let start = self.start(area, self.least_ratio(at).1);
            self.iterate([area.s[0], area.s[1], area.t[0], area.t[1]], start);
        }
        true
    }

    /// Least ratio N / C of the coefficients and its index.
    fn least_ratio(&self, at: usize) -> (f64, usize) {
        let mut found = (f64::INFINITY, 0);
        for (k, &n) in self.n(at).iter().enumerate() {
            let ratio = if self.sheet.net.rational { n / self.c(at)[k] } else { n };
            if ratio < found.0 {
                found = (ratio, k);
            }
        }
        found
    }

    fn bound(&self, area: &Area, at: usize) -> f64 {
        (self.least_ratio(at).0 - area.error).max(0.0).sqrt() * (1.0 - 4.0 * HALF_ULP)
    }

    fn judge(&mut self, area: &mut Area, at: usize) -> Verdict {
        if self.is_beyond(area, at) {
            return Verdict::Closed;
        }
        if self.proof.best == f64::INFINITY {
            let start = self.start(area, self.least_ratio(at).1);
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
        let (mut bound, mut place) = self.least_ratio(at);
        if area.age >= FRESH || (bound > self.proof.target_squared && area.age > 0) {
            if self.load(area, at) || self.is_beyond(area, at) {
                return Verdict::Closed;
            }
            (bound, place) = self.least_ratio(at);
        }
        let weight = if self.sheet.net.rational { extent(self.c(at)).1 } else { 1.0 };
        let slopes = self.slopes(area, at, bound);
        let allowance = 2.0 * area.error * weight;
        for (k, (low, high)) in [slopes.s, slopes.t].into_iter().enumerate() {
            if low > allowance || high < -allowance {
                self.follow_side(area, at, if low > allowance { 2 * k } else { 2 * k + 1 });
                return Verdict::Closed;
            }
        }
        if self.turning(area, at, weight) || self.convex(area, at, place, weight) {
            return Verdict::Closed;
        }
        self.probe(area, place);
        let [along_s, along_t] = slopes.steepest(self.degree);
        // A direction narrower than the grain of doubles cannot be halved: its middle would be one of its ends.
        if can[0] && (along_s >= along_t || !can[1]) { Verdict::HalveS } else { Verdict::HalveT }
    }

    /// Coefficients of `N - mu C` into half `part` of the scratch memory.
    fn form(&mut self, at: usize, part: usize, mu: f64) {
        let slot = &self.memory.coefficients[at * self.slot..(at + 1) * self.slot];
        let (n, c) = slot.split_at(self.count);
        let h = &mut self.memory.h[part * self.count..(part + 1) * self.count];
        if c.is_empty() {
            h.copy_from_slice(n);
        } else {
            for ((h, n), c) in h.iter_mut().zip(n).zip(c) {
                *h = n - mu * c;
            }
        }
    }

    /// First differences of `h` over every squared distance that a nearest point in this area can have.
    fn slopes(&mut self, area: &Area, at: usize, bound: f64) -> Slopes {
        let reach = self.proof.best + self.proof.gap;
        self.form(at, 0, (bound - area.error).max(0.0));
        let parts = if self.sheet.net.rational { 2 } else { 1 };
        if parts == 2 {
            self.form(at, 1, reach * reach);
        }
        let mut slopes = Slopes::NONE;
        for h in self.memory.h[..parts * self.count].chunks_exact(self.count) {
            slopes.include(h, self.degree);
        }
        slopes
    }

    /// Goes on along side `k` of the area, if that can hold the nearest point at all.
    fn follow_side(&mut self, area: &Area, at: usize, k: usize) {
        let ends = [area.s[0], area.s[1], area.t[0], area.t[1]];
        let outer = ends[k] == self.sheet.range[k];
        let collapsed = self.sheet.patch.collapsed[k] && ends[k] == [0.0, 1.0, 0.0, 1.0][k];
        if !outer || !self.sheet.border[k] || collapsed {
            return;
        }
        let along_s = k == side::T0 || k == side::T1;
        let (range, first) = if along_s { (area.s, side::S0) } else { (area.t, side::T0) };
        let border =
            [0, 1].map(|e| self.sheet.border[first + e] && range[e] == self.sheet.range[first + e]);
        let mut memory = std::mem::take(&mut self.memory.edge);
        let p = self.edge_net(k, ends[k], &mut memory);
        let components = if self.sheet.net.rational { 4 } else { 3 };
        let (net, product) = memory.split_at_mut(4 * (MAX_DEGREE + 1));
        let (n, c) = product.split_at_mut(2 * MAX_DEGREE + 1);
        let (n, c) = (&mut n[..=2 * p], &mut c[..=2 * p]);
        let rational = self.sheet.net.rational;
        for i in 0..=2 * p {
            let place = self.place_on_side(k, i);
            n[i] = self.n(at)[place];
            if rational {
                c[i] = self.c(at)[place];
            }
        }
        let (piece, fixed) = (self.sheet.piece, ends[k]);
        let site = |x: f64| Site { piece, at: if along_s { [x, fixed] } else { [fixed, x] } };
        let line = Line {
            segment: BezierSegment { degree: p, rational, poles: &net[..components * (p + 1)] },
            query: self.sheet.query,
            position: self.sheet.position,
            range,
            border,
            site: &site,
            method: self.sheet.method,
        };
        let c = if rational { &c[..] } else { &[] };
        let given = Given { n, c, error: area.error, radius: area.radius };
        search_line(&line, Some(given), &mut self.memory.line, self.proof);
        self.memory.edge = memory;
    }

    /// Index of product coefficient `i` along side `k`.
    fn place_on_side(&self, k: usize, i: usize) -> usize {
        let width = self.degree.t + 1;
        match k {
            side::S0 => i,
            side::S1 => self.degree.s * width + i,
            side::T0 => i * width,
            _ => i * width + self.degree.t,
        }
    }

    /// The poles of the isocurve on side `k` at parameter `x`, into `out`; returns its degree.
    fn edge_net(&mut self, k: usize, x: f64, out: &mut [f64]) -> usize {
        let degree = self.sheet.net.degree;
        let (rows, columns) = (degree.s + 1, degree.t + 1);
        let across_s = k == side::S0 || k == side::S1;
        let size = if across_s { columns } else { rows };
        for (component, edge) in
            self.sheet.net.poles.chunks_exact(rows * columns).zip(out.chunks_exact_mut(size))
        {
            let work = &mut self.memory.net[..rows * columns];
            work.copy_from_slice(component);
            isocurve(work, degree, across_s, x, edge);
        }
        size - 1
    }

    /// The Greville abscissae of coefficient `place`.
    fn abscissa(&self, area: &Area, place: usize) -> [f64; 2] {
        let width = self.degree.t + 1;
        let s = (place / width) as f64 / self.degree.s as f64;
        let t = (place % width) as f64 / self.degree.t as f64;
        [area.s[0] + s * (area.s[1] - area.s[0]), area.t[0] + t * (area.t[1] - area.t[0])]
    }

    /// The best foot when it is inside, the Greville abscissae of coefficient `place` otherwise.
    fn start(&self, area: &Area, place: usize) -> [f64; 2] {
        let inside = |at: [f64; 2]| {
            (area.s[0]..=area.s[1]).contains(&at[0]) && (area.t[0]..=area.t[1]).contains(&at[1])
        };
        match self.proof.site {
            Some(site) if site.piece == self.sheet.piece && inside(site.at) => site.at,
            _ => self.abscissa(area, place),
        }
    }

    /// Looks at one point of an area that is not closed yet, and iterates from it (over the whole patch: a foot on
    /// the border of an area would be none) when it is nearer than the target: a target far too high makes `h` concave (by its term in C), and no test could ever close.
    fn probe(&mut self, area: &Area, place: usize) {
        let at = self.abscissa(area, place);
        let jet = self.sheet.net.jet(at[0], at[1], self.sheet.query);
        self.proof.evaluations += 1;
        if norm(jet.d) < self.proof.target {
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
        let (at, jet, taken) = found;
        self.proof.evaluations += taken;
        let inner = |k: usize| {
            let [low, high] = [range[2 * k], range[2 * k + 1]];
            (at[k] > low || low == self.sheet.range[2 * k])
                && (at[k] < high || high == self.sheet.range[2 * k + 1])
        };
        if inner(0) && inner(1) {
            self.proof.rival(jet.d);
        }
        self.proof.offer(Site { piece, at }, jet.d, || jet.flat_direction());
        (at, jet)
    }

    /// Whether convexity and the first-order conditions at the iteration's result prove the target.
    fn convex(&mut self, area: &Area, at: usize, place: usize, weight: f64) -> bool {
        if self.curvature(area, at, weight).is_none() {
            return false;
        }
        let start = self.start(area, place);
        let (found, jet) = self.iterate([area.s[0], area.s[1], area.t[0], area.t[1]], start);
        match self.curvature(area, at, weight) {
            Some(m) => self.first_order(area, found, &jet, m),
            None => false,
        }
    }

    /// Bounds of the second derivatives of `h` at the target (see [`convexity`]).
    fn curvature(&mut self, area: &Area, at: usize, weight: f64) -> Option<[f64; 3]> {
        self.form(at, 0, self.proof.target_squared);
        convexity(&self.memory.h[..self.count], self.degree, 4.0 * area.error * weight)
    }

    /// `h >= h(u) - g.M^-1.g / 2` on the area, with `M = [[a, -b], [-b, c]]` the worst Hessian for the slope's signs.
    fn first_order(&self, area: &Area, at: [f64; 2], jet: &Jet2, [a, b, c]: [f64; 3]) -> bool {
        let (d, w, position) = (norm(jet.d), jet.w[0], self.sheet.position);
        let value = value_at(d, w, position, self.proof);
        let excess = dot(jet.d, jet.d) - self.proof.target_squared;
        let gradient = jet.gradient();
        let degrees = [self.sheet.net.degree.s, self.sheet.net.degree.t];
        let slope = |k: usize, box_: [f64; 2], speed: f64| {
            let width = box_[1] - box_[0];
            let g = 2.0 * w * (jet.w[k + 1] * excess + w * gradient[k]) * width;
            let slack = slope_error(d, speed, w, position, degrees[k]) * width;
            free_slope(g, slack, at[k] <= box_[0], at[k] >= box_[1])
        };
        let x = slope(0, area.s, norm(jet.s));
        let y = slope(1, area.t, norm(jet.t));
        let loss = (c * x * x + 2.0 * b * x * y + a * y * y) / (a * c - b * b);
        value > 0.0 && loss <= 2.0 * value * (1.0 - 1e-10)
    }

    /// At a collapsed side: whether the distance changes strictly along the side everywhere off it (see
    /// `collapsed`). Then only the collapsed point or a border can be nearest.
    fn turning(&mut self, area: &Area, at: usize, weight: f64) -> bool {
        let ends = [area.s[0], area.s[1], area.t[0], area.t[1]];
        let touched =
            (0..4).find(|&k| self.sheet.patch.collapsed[k] && ends[k] == [0.0, 1.0, 0.0, 1.0][k]);
        let Some(k) = touched else { return false };
        let ((low, high), allowance) = self.turning_extent(area, at, k, weight);
        if low > allowance || high < -allowance {
            self.follow_side(area, at, 2 * along(k) + usize::from(high < 0.0));
            return true;
        }
        false
    }

    /// Extent of the slope along side `k` off that side, and its rounding.
    fn turning_extent(
        &mut self,
        area: &Area,
        at: usize,
        k: usize,
        weight: f64,
    ) -> ((f64, f64), f64) {
        let mut memory = std::mem::take(&mut self.memory.turning);
        let n_degree = [self.degree.s, self.degree.t][along(k)] as f64;
        let found = if self.sheet.net.rational {
            let net = self.sheet.net.degree;
            let w = &mut self.memory.weights;
            w.clear();
            w.extend_from_slice(&self.sheet.net.poles[3 * net.count()..]);
            cut_2d(w, net, area.s, area.t);
            let n = &self.memory.coefficients[at * self.slot..at * self.slot + self.count];
            let found = rational_slope_extent(n, w, net, k, &mut memory);
            let size = product_steps(2 * net.count()) * area.radius * area.radius;
            (found, 8.0 * n_degree * extent(w).1 * weight * (area.error + size))
        } else {
            (slope_extent(self.n(at), self.degree, k, &mut memory), 2.0 * n_degree * area.error)
        };
        self.memory.turning = memory;
        found
    }

    /// Rebuilds the coefficients of slot `at` from the poles; true when a plane already separates the query.
    fn load(&mut self, area: &mut Area, at: usize) -> bool {
        let degree = self.sheet.net.degree;
        let count = degree.count();
        let components = if self.sheet.net.rational { 4 } else { 3 };
        let net = &mut self.memory.net[..4 * count];
        net[..components * count].copy_from_slice(self.sheet.net.poles);
        net[components * count..].fill(1.0);
        for component in net[..components * count].chunks_exact_mut(count) {
            cut_2d(component, degree, area.s, area.t);
        }
        let radius = subtract_query(net, count, self.sheet.query);
        if self.proof.best.is_finite()
            && plane_separates(net, count, self.proof, self.sheet.position)
        {
            return true;
        }
        square(net, degree, &mut self.memory.coefficients[at * self.slot..(at + 1) * self.slot]);
        self.set_error(area, at, radius, 3 * count);
        false
    }

    fn halve(&mut self, area: Area, at: usize, direction: usize) {
        let (low, high) =
            self.memory.coefficients[at * self.slot..(at + 2) * self.slot].split_at_mut(self.slot);
        for (a, b) in low.chunks_exact_mut(self.count).zip(high.chunks_exact_mut(self.count)) {
            if direction == 0 { halve_s(a, b, self.degree) } else { halve_t(a, b, self.degree) }
        }
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
