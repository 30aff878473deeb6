//! The nearest point: boxes of parameters, nearest bound first.
//!
//! ```text
//!   seeds: the best samples and the hint, iterated to feet           -> a distance to beat
//!   box:   bound beyond the target (best distance - gap)?            closed
//!          a slope keeps its sign?                                   closed, or only its side on the border is left
//!          convex, and the foot in it as near as the bound allows?   closed
//!          else                                                      halved; both halves wait by their bounds
//! ```
//!
//! What is closed by value is no nearer than the target of its time, what is closed by slope holds no nearest point, so
//! at the end nothing is nearer than the least bound that closed a box or was still waiting.
//! A box where the function fails is halved a few times more and then left out; the answer is not proven then.
//! Limit: memory grows with the budget, about 100 bytes a box.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use super::cell::{Probe, View, halves};
use super::foot::{Place, is_bad, nearer};
use super::source::Shape;
use super::{DEFAULT_BUDGET, DEFAULT_BUDGET_UNPROVEN};
use crate::bounds::Vector;
use crate::closest::{FootPoint, QueryOptions, Scope, Trace, flag};
use crate::refine::Method;

/// Samples from which the iteration starts.
const SEEDS: usize = 3;

/// Feet remembered for ties.
const RIVALS: usize = 8;

/// Steps, as shares of the range, at which a continuum of feet must still be one.
const CONTINUUM_STEPS: [f64; 2] = [1.0 / 32.0, 1.0 / 16.0];

/// A box that waits for its turn.
struct Waiting {
    bound: f64,
    number: u64,
    range: [f64; 4],
    longer: usize,
}

impl PartialEq for Waiting {
    fn eq(&self, other: &Self) -> bool {
        self.number == other.number
    }
}

impl Eq for Waiting {}

impl PartialOrd for Waiting {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Waiting {
    /// The nearest is the greatest, as the heap wants it; then the oldest.
    fn cmp(&self, other: &Self) -> Ordering {
        other.bound.total_cmp(&self.bound).then(other.number.cmp(&self.number))
    }
}

/// The state of one query.
struct Search<'a> {
    probe: &'a Probe<'a>,
    range: [f64; 4],
    method: Method,
    gap: f64,
    budget: u64,
    boxes: u64,
    heap: BinaryHeap<Waiting>,
    best: Option<Place>,
    rivals: Vec<Place>,
    /// Least bound of all boxes that were closed by value or given up.
    floor: f64,
    exhausted: bool,
}

/// The nearest point of a shape.
pub fn closest(
    shape: &Shape,
    query: Vector,
    hint: Option<[f64; 2]>,
    options: &QueryOptions,
    mut trace: Option<Trace>,
) -> FootPoint {
    if is_bad(query) {
        return FootPoint::bad_query();
    }
    let probe = Probe::new(shape, query);
    let hint = hint.filter(|at| at.iter().all(|x| x.is_finite()));
    let range = shape.range(options.domain);
    let allowed = shape.accuracy(options.accuracy).max(4.0 * shape.rounding(query));
    let mut search = Search::new(&probe, range, 0.5 * allowed, options);
    search.seed(hint, &mut trace);
    if options.scope == Scope::Global {
        search.run();
    }
    let mut foot = search.answer(allowed, options.scope == Scope::Global);
    if hint.is_some() {
        foot.flags |= flag::HINT_USED;
    }
    foot
}

/// As [`closest`], for a query that should lie on the shape.
pub fn invert(
    shape: &Shape,
    query: Vector,
    hint: Option<[f64; 2]>,
    options: &QueryOptions,
    trace: Option<Trace>,
) -> FootPoint {
    let mut foot = closest(shape, query, hint, options, trace);
    let tolerance = shape.tolerance(options.tolerance);
    if foot.lower_bound > tolerance {
        foot.flags |= flag::NOT_ON_SHAPE;
    } else if foot.distance > tolerance {
        foot.flags |= flag::NOT_PROVEN;
    }
    foot
}

/// Boxes that a query may look at; `usual`: with bounds, when the options leave it open.
pub fn budget(asked: u64, trusted: bool, usual: u64) -> u64 {
    match (asked, trusted) {
        (0, true) => usual,
        (0, false) => DEFAULT_BUDGET_UNPROVEN,
        (budget, _) => budget,
    }
}

/// The nearest samples inside `range`, nearest first, each better than its two neighbours in the list of samples.
fn seeds(probe: &Probe, range: [f64; 4]) -> Vec<[f64; 2]> {
    let squared = |point: Vector| {
        let d = crate::bounds::sub(point, probe.query);
        crate::bounds::dot(d, d)
    };
    let inside = |at: &[f64; 2]| (0..2).all(|k| range[2 * k] <= at[k] && at[k] <= range[2 * k + 1]);
    let all: Vec<(f64, [f64; 2])> =
        probe.shape.survey.seeds.iter().map(|(at, point)| (squared(*point), *at)).collect();
    let is_low = |i: usize| {
        (i == 0 || all[i].0 <= all[i - 1].0) && (i + 1 == all.len() || all[i].0 <= all[i + 1].0)
    };
    let mut low: Vec<_> =
        (0..all.len()).filter(|&i| inside(&all[i].1) && is_low(i)).map(|i| all[i]).collect();
    low.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut found: Vec<[f64; 2]> = low.into_iter().map(|(_, at)| at).take(SEEDS).collect();
    if found.is_empty() {
        found.push([0, 1].map(|k| 0.5 * range[2 * k] + 0.5 * range[2 * k + 1]));
    }
    found
}

impl<'a> Search<'a> {
    fn new(probe: &'a Probe<'a>, range: [f64; 4], gap: f64, options: &QueryOptions) -> Self {
        Self {
            probe,
            range,
            method: options.method,
            gap,
            budget: budget(options.budget, probe.trusted, DEFAULT_BUDGET),
            boxes: 0,
            heap: BinaryHeap::new(),
            best: None,
            rivals: Vec::new(),
            floor: f64::INFINITY,
            exhausted: false,
        }
    }

    /// First feet: from the hint, or from the best samples.
    fn seed(&mut self, hint: Option<[f64; 2]>, trace: &mut Option<Trace>) {
        let starts = hint.map_or_else(|| seeds(self.probe, self.range), |at| vec![at]);
        for start in starts {
            let told = trace.as_mut().map(|trace| &mut **trace as Trace);
            let found = self.probe.refined(start, self.range, self.method, told);
            self.meet(found);
        }
    }

    /// Takes a foot into account.
    fn meet(&mut self, found: Option<Place>) {
        let Some(place) = found else { return };
        let best = self.best.map_or(f64::INFINITY, |best| best.distance);
        if place.distance <= best + 2.0 * self.gap {
            let window = place.distance.min(best) + 2.0 * self.gap;
            self.rivals.retain(|rival| rival.distance <= window);
            let is_new = self.rivals.iter().all(|rival| self.probe.apart(rival.point, place.point));
            if is_new && self.rivals.len() < RIVALS {
                self.rivals.push(place);
            }
        }
        self.best = nearer(self.best, Some(place));
    }

    /// Bounds from here on close a box.
    fn target(&self) -> f64 {
        self.best.map_or(f64::INFINITY, |best| best.distance - self.gap)
    }

    /// Walks the boxes until nothing can be nearer than the target, or the budget is spent.
    fn run(&mut self) {
        self.examine(self.range, 0.0);
        while let Some(next) = self.heap.pop() {
            if self.best.is_some() && next.bound >= self.target() {
                self.floor = self.floor.min(next.bound);
                return;
            }
            if self.boxes >= self.budget {
                self.exhausted = true;
                self.floor = self.floor.min(next.bound);
                return;
            }
            match halves(next.range, next.longer) {
                Some(parts) => {
                    for part in parts {
                        self.examine(part, next.bound);
                    }
                }
                None => self.floor = self.floor.min(next.bound),
            }
        }
    }

    /// Looks at one box: closes it or lets it wait.
    fn examine(&mut self, range: [f64; 4], bound: f64) {
        self.boxes += 1;
        let Some(view) = View::new(self.probe, range) else {
            for part in self.probe.coarse_halves(range).into_iter().flatten() {
                self.examine(part, bound);
            }
            return;
        };
        if self.best.is_none_or(|best| view.distance < best.distance) {
            let found = self.probe.refined(view.centre, self.range, self.method, None);
            self.meet(found);
        }
        let mut bound = bound.max(view.lower());
        if bound >= self.target() {
            self.floor = self.floor.min(bound);
            return;
        }
        if let Some(side) = self.pressed(&view, range) {
            if let Some(face) = side {
                self.examine(face, bound);
            }
            return;
        }
        if let Some(curvature) = view.convexity() {
            bound = bound.max(self.valley(&view, range, curvature));
            if bound >= self.target() {
                self.floor = self.floor.min(bound);
                return;
            }
        }
        self.wait(bound, range, view.longer());
    }

    fn wait(&mut self, bound: f64, range: [f64; 4], longer: usize) {
        let number = self.boxes;
        self.heap.push(Waiting { bound, number, range, longer });
    }

    /// When a slope keeps its sign: the side of the box on the border that it presses against, if there is one. `None`:
    /// no slope is known to keep its sign.
    fn pressed(&self, view: &View, range: [f64; 4]) -> Option<Option<[f64; 4]>> {
        for k in (0..2).filter(|&k| view.half[k] > 0.0) {
            let (slope, vary) = view.slope(k)?;
            if slope.abs() > vary {
                let end = if slope > 0.0 { 2 * k } else { 2 * k + 1 };
                let mut face = range;
                (face[2 * k], face[2 * k + 1]) = (range[end], range[end]);
                return Some((range[end] == self.range[end]).then_some(face));
            }
        }
        None
    }

    /// Lower bound on a box where the squared distance is convex, from the foot in it.
    fn valley(&mut self, view: &View, range: [f64; 4], curvature: f64) -> f64 {
        let inside =
            |at: [f64; 2]| (0..2).all(|k| range[2 * k] <= at[k] && at[k] <= range[2 * k + 1]);
        let mut place = self.best.filter(|best| inside(best.at));
        if place.is_none() {
            place = self.probe.refined(view.centre, range, self.method, None);
            self.meet(place);
        }
        let Some(place) = place else { return 0.0 };
        let point = [place.at[0], place.at[0], place.at[1], place.at[1]];
        let Some(there) = View::new(self.probe, point) else { return 0.0 };
        let (mut fall, mut squares) = (0.0, 0.0);
        for k in (0..2).filter(|&k| view.half[k] > 0.0) {
            let (slope, error) = there.slope(k).unwrap_or((f64::INFINITY, 0.0));
            let [low, high] = [range[2 * k], range[2 * k + 1]];
            // The minimum of the tangent plane of f lies down the slope; held at a side that it presses against.
            let down = (slope + error).max(0.0) * (place.at[k] - low);
            let up = (error - slope).max(0.0) * (high - place.at[k]);
            fall += down.max(up);
            let held =
                (place.at[k] == low && slope >= error) || (place.at[k] == high && -slope >= error);
            squares += if held { 0.0 } else { (slope.abs() + error) * (slope.abs() + error) };
        }
        let slack = fall.min(squares / (2.0 * curvature)) * (1.0 + 16.0 * f64::EPSILON);
        let d = (there.distance - there.error).max(0.0);
        (d * d - 2.0 * slack).max(0.0).sqrt() * (1.0 - 4.0 * f64::EPSILON)
    }

    /// The record of the best foot with its certificate.
    fn answer(&mut self, allowed: f64, global: bool) -> FootPoint {
        let Some(place) = self.best else {
            return FootPoint { iterations: self.probe.taken(), ..FootPoint::unreached() };
        };
        let flat = self.is_continuum(place, allowed);
        let mut foot = self.probe.record(place, self.range, true);
        let proven = global && self.probe.trusted && !self.probe.has_failed();
        if proven {
            foot.lower_bound = self.floor.min(foot.distance).max(0.0);
        }
        if !proven || foot.distance - foot.lower_bound > allowed {
            foot.flags |= flag::NOT_PROVEN;
        }
        if self.exhausted {
            foot.flags |= flag::BUDGET;
        }
        let tied = |rival: &Place| {
            rival.distance <= place.distance + allowed && self.probe.apart(rival.point, place.point)
        };
        if flat || self.rivals.iter().any(tied) {
            foot.flags |= flag::TIE;
        }
        if flat {
            foot.flags |= flag::CONTINUUM;
        }
        foot.iterations = self.probe.taken();
        foot
    }

    /// Whether the feet go on to one side of the best: stationary to second order, and equally near some steps away.
    fn is_continuum(&self, place: Place, allowed: f64) -> bool {
        let Some(jet) = self.probe.jet_at(place.at) else { return false };
        let direction = if self.probe.shape.source.dims == 1 {
            jet.along(0).is_flat().then_some([1.0, 0.0])
        } else {
            jet.flat_direction()
        };
        let Some(direction) = direction else { return false };
        let widths = [0, 1].map(|k| self.range[2 * k + 1] - self.range[2 * k]);
        let equal = |share: f64| {
            let at = [0, 1].map(|k| {
                let to = place.at[k] + share * direction[k] * widths[k];
                to.clamp(self.range[2 * k], self.range[2 * k + 1])
            });
            let moved = at != place.at;
            moved && self.probe.reach(at).is_some_and(|(_, d)| d <= place.distance + allowed)
        };
        [1.0, -1.0].iter().any(|sign| CONTINUUM_STEPS.iter().all(|step| equal(sign * step)))
    }
}
