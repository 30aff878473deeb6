//! Is an answer right? What was found against it, and what all answers of a family came to.

use std::time::Instant;

use footpoint::closest::{FootPoint, QueryOptions, Workspace, flag};

use super::asks::Ask;
use super::double::Double;
use super::exact::{Exact, Verdict};
use super::pieces::Pieces;
use super::search::{Scratch, Search, square};
use super::shapes::asked::Shape;
use super::shapes::sub;

/// What an answer may be found guilty of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fault {
    /// Farther than a place that was found, and not marked.
    Wrong,
    /// A bound above the distance of a place that was found.
    Unsound,
    /// Farther, but marked as not proven.
    MarkedWorse,
    /// Marked, and no doubles as parameters are nearer: spans or weights for which doubles are too coarse.
    Grain,
    /// The record contradicts itself or the shape.
    Mismatch,
    /// A set leaves out a place that is known to belong to it.
    Lost,
}

/// Everything one shape is judged with.
pub struct Judge<'a> {
    pub shape: &'a Shape,
    pub pieces: &'a Pieces,
    pub search: &'a Search<'a>,
    pub exact: Exact<'a>,
    pub options: QueryOptions,
    /// Diagonal of the poles and their largest coordinate.
    pub extent: (f64, f64),
}

/// The limits of a query: what a distance and what a bound may be above the truth.
struct Limits {
    distance: f64,
    bound: f64,
    rounding: f64,
}

/// A judged answer.
pub struct Judged {
    pub foot: FootPoint,
    pub time: f64,
    pub faults: Vec<Fault>,
    /// Parameters and distance of the nearest place found.
    pub found: ([f64; 2], f64),
    pub examined: bool,
    /// The search alone, without the answer, found only a farther place.
    pub is_missed: bool,
    /// Two feet at one distance are known, and the answer does not say so.
    pub is_untied: bool,
    /// Budget or accuracy were not the default.
    pub is_special: bool,
}

/// What no answer may be.
const GRAVE: [Fault; 4] = [Fault::Wrong, Fault::Unsound, Fault::Mismatch, Fault::Lost];

impl Judged {
    /// Nothing found yet.
    pub fn new(foot: FootPoint, ask: &Ask) -> Self {
        let (found, is_special) = (([f64::NAN; 2], f64::NAN), ask.is_special());
        Self {
            is_special,
            is_untied: false,
            foot,
            time: 0.0,
            faults: Vec::new(),
            found,
            examined: false,
            is_missed: false,
        }
    }

    /// Not proven, though asked as most are.
    pub fn is_open(&self) -> bool {
        self.foot.flags & flag::NOT_PROVEN != 0 && !self.is_special
    }

    /// What no answer may be.
    pub fn is_grave(&self) -> bool {
        self.faults.iter().any(|fault| GRAVE.contains(fault))
    }
}

impl Judge<'_> {
    /// What rounding of the query and the shape may make of a distance, at least.
    pub fn rounding(&self, ask: &Ask) -> f64 {
        self.limits(ask, 0.0).rounding
    }

    fn limits(&self, ask: &Ask, distance: f64) -> Limits {
        let largest = ask.query.iter().fold(self.extent.1, |m, x| m.max(x.abs()));
        let rounding = 4e-15 * (largest + distance);
        // The default accuracy is part of the limit; a larger one comes on top.
        let accuracy = ask.accuracy.map_or(0.0, |share| share * self.extent.0);
        Limits {
            distance: 1e-9 * self.extent.0 + accuracy + rounding,
            bound: 1e-12 * self.extent.0 + rounding,
            rounding,
        }
    }

    fn answer(&self, ask: &Ask, workspace: &mut Workspace) -> (FootPoint, f64) {
        let accuracy = ask.accuracy.map_or(0.0, |share| share * self.extent.0);
        let budget = ask.budget.unwrap_or(0);
        let options = QueryOptions { method: ask.method, accuracy, budget, ..self.options };
        let start = Instant::now();
        let foot = self.shape.ask_with(ask.query, ask.hint, &options, workspace);
        (foot, start.elapsed().as_secs_f64() * 1e9)
    }

    /// Asks and judges. `worst` is the longest time so far: a longer one is measured again, the least counts.
    pub fn judge(
        &self,
        ask: &Ask,
        examine: bool,
        worst: f64,
        memory: (&mut Workspace, &mut Scratch),
    ) -> Judged {
        let (foot, mut time) = self.answer(ask, memory.0);
        for _ in 0..4 {
            if time > worst {
                time = time.min(self.answer(ask, memory.0).1);
            }
        }
        Judged { time, ..self.verdict(ask, foot, examine, memory.1) }
    }

    /// Judges an answer, in doubled precision when it is suspect or `examine` says so.
    pub fn verdict(
        &self,
        ask: &Ask,
        foot: FootPoint,
        examine: bool,
        scratch: &mut Scratch,
    ) -> Judged {
        let mut judged = Judged::new(foot, ask);
        if self.contradicts(&foot, ask) {
            judged.faults.push(Fault::Mismatch);
            return judged;
        }
        let mut quick = self.search.nearest(ask.query, &ask.places, scratch);
        let limits = self.limits(ask, foot.distance);
        judged.is_missed = quick.square.sqrt() > foot.distance + limits.distance;
        if quick.square > foot.distance * foot.distance {
            let own = self.search.descend(self.pieces.place([foot.u, foot.v]), ask.query);
            quick = if own.square < quick.square { own } else { quick };
        }
        judged.found = (self.pieces.parameters(&quick.place), quick.square.sqrt());
        judged.is_untied = self.is_untied(&foot, ask);
        let is_suspect = foot.distance > judged.found.1 + 0.5 * limits.distance
            || foot.lower_bound > judged.found.1 + 0.3 * limits.bound;
        judged.examined = is_suspect || examine;
        if judged.examined {
            let own = self.exact.refine_parameters([foot.u, foot.v], ask.query);
            let other = self.exact.refine(&quick.place, ask.query);
            let best = if own.distance < other.distance { own } else { other };
            judged.found = (best.at.map(Double::value), best.distance);
            self.convict(ask, &best, &mut judged);
        }
        judged
    }

    fn convict(&self, ask: &Ask, best: &Verdict, judged: &mut Judged) {
        let (foot, faults) = (&judged.foot, &mut judged.faults);
        let truth = best.distance;
        let limits = self.limits(ask, truth);
        if foot.lower_bound > truth + limits.bound {
            faults.push(Fault::Unsound);
        }
        if foot.distance > truth + limits.distance {
            let is_marked = foot.flags & flag::NOT_PROVEN != 0;
            let is_grain = is_marked && foot.distance <= self.rounded(best, ask) + limits.distance;
            faults.extend(match (is_marked, is_grain) {
                // With a small budget nothing better is promised.
                (true, _) if ask.is_special() => None,
                (false, _) => Some(Fault::Wrong),
                (true, false) => Some(Fault::MarkedWorse),
                (true, true) => Some(Fault::Grain),
            });
        }
        let exact = self.exact.point([foot.u, foot.v], ask.query);
        let evaluated = sub(foot.point, ask.query);
        if square(sub(exact, evaluated)).sqrt() > limits.bound + limits.rounding {
            faults.push(Fault::Mismatch);
        }
    }

    /// Whether a place that the query was made from is a foot at the same distance elsewhere, and TIE is not set.
    fn is_untied(&self, foot: &FootPoint, ask: &Ask) -> bool {
        let (accuracy, limits) = (1e-10 * self.extent.0, self.limits(ask, foot.distance));
        let is_due = ask.kind == "medial" && !ask.is_special() && limits.rounding < 0.1 * accuracy;
        if !is_due || foot.flags & (flag::TIE | flag::NOT_PROVEN) != 0 {
            return false;
        }
        ask.places.iter().any(|place| {
            let other = self.search.descend(*place, ask.query);
            let apart = sub(self.pieces.point(&other.place, [0.0; 3]), foot.point);
            other.square.sqrt() <= foot.distance + 0.3 * accuracy
                && square(apart).sqrt() > 1e-3 * self.extent.0
        })
    }

    /// The least distance at the doubles around a place: what parameters can say.
    fn rounded(&self, best: &Verdict, ask: &Ask) -> f64 {
        let area = self.exact.area;
        let around = [0, 1].map(|k| {
            let x = best.at[k].value();
            [x.next_down(), x, x.next_up()].map(|x| x.clamp(area[2 * k], area[2 * k + 1]))
        });
        let pairs = around[0].into_iter().flat_map(|u| around[1].map(|v| [u, v]));
        let away = |at| square(self.exact.point(at, ask.query)).sqrt();
        pairs.map(away).fold(f64::INFINITY, f64::min)
    }

    /// Outside the area, not the bits of the evaluation, a distance that is none, or a gap without a mark.
    fn contradicts(&self, foot: &FootPoint, ask: &Ask) -> bool {
        let [u0, u1, v0, v1] = self.exact.area;
        let is_inside = (u0..=u1).contains(&foot.u) && (v0..=v1).contains(&foot.v);
        if !is_inside || self.shape.evaluate([foot.u, foot.v]) != foot.point {
            return true;
        }
        let away = square(sub(foot.point, ask.query)).sqrt();
        let limits = self.limits(ask, away);
        let is_marked = foot.flags & flag::NOT_PROVEN != 0;
        let gap = foot.distance - foot.lower_bound;
        // Squares of distances below 1e-154 underflow here, though not in the library.
        let is_distance =
            (foot.distance - away).abs() <= 4.0 * f64::EPSILON * away || away < 1e-150;
        !is_distance || gap.is_nan() || gap < 0.0 || (gap > 20.0 * limits.distance && !is_marked)
    }
}

/// Steps of the histogram of times in an octave.
const STEPS: f64 = 8.0;

/// The sum of what a family's answers were.
#[derive(Clone, Debug)]
pub struct Tally {
    pub queries: u64,
    pub examined: u64,
    /// In the order of [`Fault`].
    pub faults: [u64; 6],
    pub open: u64,
    pub missed: u64,
    pub untied: u64,
    pub worst: f64,
    pub evaluations: u32,
    times: [u64; 256],
}

impl Default for Tally {
    fn default() -> Self {
        Self {
            queries: 0,
            examined: 0,
            faults: [0; 6],
            open: 0,
            missed: 0,
            untied: 0,
            worst: 0.0,
            evaluations: 0,
            times: [0; 256],
        }
    }
}

impl Tally {
    /// Empty; times up to `worst` are no news.
    pub fn beyond(worst: f64) -> Self {
        Self { worst, ..Self::default() }
    }

    pub fn enter(&mut self, judged: &Judged) {
        self.queries += 1;
        self.examined += u64::from(judged.examined);
        for fault in &judged.faults {
            self.faults[*fault as usize] += 1;
        }
        self.open += u64::from(judged.is_open());
        self.missed += u64::from(judged.is_missed);
        self.untied += u64::from(judged.is_untied);
        self.worst = self.worst.max(judged.time);
        self.evaluations = self.evaluations.max(judged.foot.iterations);
        let step = (judged.time.max(1.0).log2() * STEPS) as usize;
        self.times[step.min(255)] += 1;
    }

    pub fn add(&mut self, other: &Self) {
        self.queries += other.queries;
        self.examined += other.examined;
        self.open += other.open;
        self.missed += other.missed;
        self.untied += other.untied;
        self.worst = self.worst.max(other.worst);
        self.evaluations = self.evaluations.max(other.evaluations);
        self.faults.iter_mut().zip(&other.faults).for_each(|(a, b)| *a += b);
        self.times.iter_mut().zip(&other.times).for_each(|(a, b)| *a += b);
    }

    /// Half of the answers took at most this long, in nanoseconds, to a twelfth.
    pub fn median(&self) -> f64 {
        let mut left = self.queries.div_ceil(2);
        for (step, count) in self.times.iter().enumerate() {
            if left <= *count {
                return 2f64.powf((step as f64 + 0.5) / STEPS);
            }
            left -= count;
        }
        0.0
    }

    pub fn of(&self, fault: Fault) -> u64 {
        self.faults[fault as usize]
    }

    /// No answer that is wrong, no bound, no record.
    pub fn is_clean(&self) -> bool {
        GRAVE.iter().all(|fault| self.of(*fault) == 0)
    }
}
