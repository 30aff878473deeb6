//! Is an answer right? What was found against it, and what all answers of a family came to.

use std::time::Instant;

use footpoint::closest::{FootPoint, QueryOptions, Workspace, flag};

use super::asks::Ask;
use super::exact::Exact;
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
    /// The record contradicts itself or the shape.
    Mismatch,
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
}

impl Judge<'_> {
    fn limits(&self, ask: &Ask, distance: f64) -> Limits {
        let largest = ask.query.iter().fold(self.extent.1, |m, x| m.max(x.abs()));
        let rounding = 4e-15 * (largest + distance);
        Limits {
            distance: 1e-9 * self.extent.0 + rounding,
            bound: 1e-12 * self.extent.0 + rounding,
            rounding,
        }
    }

    fn answer(&self, ask: &Ask, workspace: &mut Workspace) -> (FootPoint, f64) {
        let options = QueryOptions { method: ask.method, ..self.options };
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
        let mut faults = Vec::new();
        if self.contradicts(&foot, ask) {
            faults.push(Fault::Mismatch);
            return Judged {
                foot,
                time,
                faults,
                found: ([f64::NAN; 2], f64::NAN),
                examined: false,
            };
        }
        let own = self.pieces.place([foot.u, foot.v]);
        let mut starts = ask.places.clone();
        starts.push(own);
        let quick = self.search.nearest(ask.query, &starts, memory.1);
        let mut found = (self.pieces.parameters(&quick.place), quick.square.sqrt());
        let limits = self.limits(ask, found.1);
        let is_suspect = foot.distance > found.1 + 0.5 * limits.distance
            || foot.lower_bound > found.1 + 0.3 * limits.bound;
        if is_suspect || examine {
            let verdicts = [
                self.exact.refine(&quick.place, ask.query),
                self.exact.refine_parameters([foot.u, foot.v], ask.query),
            ];
            let best = verdicts.into_iter().min_by(|a, b| a.distance.total_cmp(&b.distance));
            if let Some(best) = best {
                found = (best.at.map(|x| x.value()), best.distance);
            }
            self.convict(&foot, ask, found.1, &mut faults);
        }
        Judged { foot, time, faults, found, examined: is_suspect || examine }
    }

    fn convict(&self, foot: &FootPoint, ask: &Ask, truth: f64, faults: &mut Vec<Fault>) {
        let limits = self.limits(ask, truth);
        if foot.lower_bound > truth + limits.bound {
            faults.push(Fault::Unsound);
        }
        if foot.distance > truth + limits.distance {
            let is_marked = foot.flags & flag::NOT_PROVEN != 0;
            faults.push(if is_marked { Fault::MarkedWorse } else { Fault::Wrong });
        }
        let exact = self.exact.point([foot.u, foot.v], ask.query);
        let evaluated = sub(foot.point, ask.query);
        if square(sub(exact, evaluated)).sqrt() > limits.bound + limits.rounding {
            faults.push(Fault::Mismatch);
        }
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
        !is_distance || gap.is_nan() || gap < 0.0 || (gap > 3.0 * limits.distance && !is_marked)
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
    pub faults: [u64; 4],
    pub open: u64,
    pub worst: f64,
    pub evaluations: u32,
    times: [u64; 256],
}

impl Default for Tally {
    fn default() -> Self {
        Self {
            queries: 0,
            examined: 0,
            faults: [0; 4],
            open: 0,
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
        self.open += u64::from(judged.foot.flags & flag::NOT_PROVEN != 0);
        self.worst = self.worst.max(judged.time);
        self.evaluations = self.evaluations.max(judged.foot.iterations);
        let step = (judged.time.max(1.0).log2() * STEPS) as usize;
        self.times[step.min(255)] += 1;
    }

    pub fn add(&mut self, other: &Self) {
        self.queries += other.queries;
        self.examined += other.examined;
        self.open += other.open;
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
        [Fault::Wrong, Fault::Unsound, Fault::Mismatch].iter().all(|fault| self.of(*fault) == 0)
    }
}
