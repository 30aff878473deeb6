//! Weights whose shape really has the wished distances.
//!
//! ```text
//!   wishes -> proven impossible?  that pole's weight is only drawn to the end of the range that comes nearest
//!          -> starts: formula (3), then cross ratios, the given weights, ones, random ones
//!          -> `solve`: meet the rest of the wishes and the constraints
//!          -> `solve`: weights without a wish as near 1 as they can be
//!          -> measured by the nearest point with its bound: met, not met, impossible
//! ```
//!
//! "Near 1" is the sum of the squares of `(w - 1) / sqrt(w)` over the poles without a wish; over all poles when each has
//! one; there may be several solutions, and the least of a few starts is taken. When no start meets everything, the one with the least sum of squared misses is the best found.
//! Cost: a 10-pole curve takes about a millisecond; wishes that are not met, up to [`DEFAULT_STARTS`] times that.

use super::net::Net;
use super::reach::Reach;
use super::report::{PoleReport, Report, State};
use super::rows::{Problem, Target, Tools};
use super::solve::{Bounds, Place};
use super::start::{Random, first};
use super::{COINCIDENT, Constraint, Options, Wish, chord, invalid, wished};
use crate::bounds::{Vector, norm, scaled, sub};
use crate::error::Error;
use crate::index::Poll;
use crate::knots::MAX_MAGNITUDE;

/// Most starts by default.
pub const DEFAULT_STARTS: u32 = 2_000;

/// Weights without a wish that are all 1 but for some ten per cent are near enough; otherwise a few more starts look for better ones.
const NEAR_ENOUGH: f64 = 0.02;
const EXTRA_STARTS: u32 = 6;

/// Most starts when not all can be met: it is only the best that is looked for.
const STARTS_WITHOUT_HOPE: u32 = 60;

/// So many starts from anywhere that all end as well as the best one, within [`SAME`] of its squared misses, end the search.
const ENOUGH: u32 = 30;
const SAME: f64 = 0.02;

/// Share of the tolerance within which a search must end: the rest is for the proof.
const INNER: f64 = 0.25;

/// Most numbers in the matrices of one step: 512 MiB.
const MOST_ENTRIES: usize = 1 << 26;

/// Steps by cross ratios before a start.
const RATIO_STEPS: usize = 12;

/// Weights for wishes and constraints. The given weights of the shape only matter for [`Constraint::TangentKept`] and as one start.
///
/// # Errors
/// A wish, constraint or option that is not allowed, by name and index; [`Error::Cancelled`] when `poll` said so.
pub fn refine(
    net: Net,
    wishes: &[Wish],
    constraints: &[Constraint],
    options: &Options,
    poll: Poll,
) -> Result<Report, Error> {
    let diagonal = net.diagonal();
    let range = options.range()?;
    let tolerance = options.tolerance(diagonal)?;
    let wished = wished(&net, wishes)?;
    let targets = settled(&net, constraints)?;
    if diagonal <= 0.0 {
        return invalid("poles: all of them coincide".into());
    }
    let lengths = chord::lengths(&net);
    let each = wished.iter().zip(&lengths);
    let mut poles: Vec<PoleReport> =
        each.map(|(wish, length)| first(*wish, *length, COINCIDENT * diagonal, range)).collect();
    let ends = judge(&net, &mut poles, range, tolerance);
    let hopeless = contradict(&net, &mut poles, tolerance);
    let mut options = *options;
    if hopeless {
        let starts = if options.starts > 0 { options.starts } else { DEFAULT_STARTS };
        options.starts = starts.min(STARTS_WITHOUT_HOPE);
    }
    let (problem, bounds) =
        posed(net, &poles, &ends, &targets, range, tolerance, options.symmetric);
    check_size(&problem)?;
    let mut search =
        Search { problem: &problem, bounds: &bounds, tools: Tools::default(), tolerance };
    let (weights, starts) = search.run(&poles, &options, poll)?;
    let shapes = search.tools.shapes;
    let weights = problem.spread(&weights);
    let mut report = Report::measured(&net, &weights, poles, tolerance, range)?;
    report.check(&net, &targets)?;
    (report.iterations, report.starts) = (shapes, starts);
    Ok(report)
}

/// The constraints with directions settled.
fn settled(net: &Net, constraints: &[Constraint]) -> Result<Vec<(Constraint, Target)>, Error> {
    let name = |i: usize| format!("constraints: constraint {i}");
    let inside = |i: usize, at: [f64; 2]| {
        if at.iter().all(|x| x.is_finite()) && net.contains(at) {
            return Ok(());
        }
        invalid(format!("{}: {at:?} is outside the domain", name(i)))
    };
    let finite = |i: usize, vector: Vector| match vector
        .iter()
        .position(|x| !x.is_finite() || x.abs() > MAX_MAGNITUDE)
    {
        Some(k) => invalid(format!("{}: entry {k} is not finite or beyond 1e100", name(i))),
        None => Ok(()),
    };
    let direction = |i: usize, vector: Vector| {
        let length = norm(vector);
        if length > 0.0 && length.is_finite() {
            return Ok(scaled(vector, 1.0 / length));
        }
        invalid(format!("{}: has no direction", name(i)))
    };
    let mut out = Vec::new();
    for (i, constraint) in constraints.iter().enumerate() {
        let target = match *constraint {
            Constraint::PointAt(at, point) => {
                let at = if let Net::Curve(_) = net { [at[0], 0.0] } else { at };
                inside(i, at)?;
                finite(i, point)?;
                Target::At(at, point)
            }
            Constraint::Point(point) => {
                finite(i, point)?;
                Target::Anywhere(point)
            }
            Constraint::TangentAt(u, _) | Constraint::TangentKept(u) => {
                let Net::Curve(curve) = net else {
                    let text = format!("{}: a surface has no tangent of its own", name(i));
                    return Err(Error::Unsupported(text));
                };
                inside(i, [u, 0.0])?;
                let mut now = [[0.0; 3]; 2];
                curve.derivatives(u, 1, &mut now);
                let wanted = match constraint {
                    Constraint::TangentAt(_, wanted) => *wanted,
                    _ => now[1],
                };
                finite(i, wanted)?;
                Target::Tangent(u, direction(i, wanted)?)
            }
        };
        out.push((*constraint, target));
    }
    Ok(out)
}

/// Marks wishes that no weights can meet, and tells to which end of the range their weights are drawn: the distance from a pole
/// always falls while its weight grows.
fn judge(net: &Net, poles: &mut [PoleReport], range: [f64; 2], tolerance: f64) -> Vec<Option<f64>> {
    let mut ends = vec![None; poles.len()];
    if poles.iter().all(|pole| pole.wish.is_nan()) {
        return ends;
    }
    let reach = Reach::new(*net, range);
    for (k, pole) in poles.iter_mut().enumerate().filter(|(_, pole)| !pole.wish.is_nan()) {
        if pole.wish - tolerance > reach.greatest(k) {
            ends[k] = Some(range[0]);
        } else if pole.wish + tolerance < reach.least(k) {
            ends[k] = Some(range[1]);
        } else {
            continue;
        }
        pole.state = State::Impossible as u32;
    }
    ends
}

/// Marks wishes that contradict each other: the distances of two poles from anything differ by no more than the poles are apart.
/// True when there are any. They stay in the search, whose best then lies between them.
fn contradict(net: &Net, poles: &mut [PoleReport], tolerance: f64) -> bool {
    let is_open =
        |k: &usize| !poles[*k].wish.is_nan() && poles[*k].state != State::Impossible as u32;
    let wishes: Vec<usize> = (0..poles.len()).filter(is_open).collect();
    let mut any = false;
    for (i, &a) in wishes.iter().enumerate() {
        for &b in &wishes[..i] {
            let apart = norm(sub(net.poles()[a], net.poles()[b]));
            if (poles[a].wish - poles[b].wish).abs() > apart * (1.0 + 1e-14) + 2.0 * tolerance {
                poles[a].state = State::Impossible as u32;
                poles[b].state = State::Impossible as u32;
                any = true;
            }
        }
    }
    any
}

/// The equations, and where the variables should be.
fn posed<'a>(
    net: Net<'a>,
    poles: &[PoleReport],
    ends: &[Option<f64>],
    targets: &[(Constraint, Target)],
    range: [f64; 2],
    tolerance: f64,
    symmetric: bool,
) -> (Problem<'a>, Bounds) {
    let count = poles.len();
    let stands_for = |k: usize| if symmetric { net.representative(k) } else { k };
    let mut number = vec![usize::MAX; count];
    let mut variables = 0;
    for k in (0..count).filter(|&k| stands_for(k) == k) {
        number[k] = variables;
        variables += 1;
    }
    let variable_of: Vec<usize> = (0..count).map(|k| number[stands_for(k)]).collect();
    let one = 1.0_f64.clamp(range[0], range[1]);
    let mut wanted = vec![Some(one); variables];
    let mut wishes = Vec::new();
    for (k, pole) in poles.iter().enumerate().filter(|(_, pole)| !pole.wish.is_nan()) {
        wanted[variable_of[k]] = ends[k];
        if ends[k].is_none() {
            wishes.push((k, pole.wish));
        }
    }
    if wanted.iter().all(Option::is_none) {
        wanted = vec![Some(one); variables];
    }
    let targets = targets.iter().map(|(_, target)| *target).collect();
    let (diagonal, accuracy) = (net.diagonal(), tolerance / 16.0);
    let problem = Problem { net, diagonal, wishes, targets, variable_of, variables, accuracy };
    (problem, Bounds { range, targets: wanted })
}

/// Refuses more equations than dense matrices are for.
fn check_size(problem: &Problem) -> Result<(), Error> {
    let rows = problem.wishes.len() + 3 * problem.targets.len();
    if rows.saturating_mul(rows + problem.variables) <= MOST_ENTRIES {
        return Ok(());
    }
    let text =
        format!("wish_count: {rows} equations for {} weights are too many", problem.variables);
    Err(Error::Unsupported(text))
}

/// The starts and what came of them.
struct Search<'a> {
    problem: &'a Problem<'a>,
    bounds: &'a Bounds,
    tools: Tools,
    tolerance: f64,
}

impl Search<'_> {
    /// The weights of the variables, and how many starts were taken.
    fn run(
        &mut self,
        poles: &[PoleReport],
        options: &Options,
        poll: Poll,
    ) -> Result<(Vec<f64>, u32), Error> {
        let limit = INNER * self.tolerance / self.problem.diagonal;
        let most = if options.starts > 0 { options.starts } else { DEFAULT_STARTS };
        let (mut best, mut hits) = (None::<Place>, 0);
        let (mut solved, mut last) = (None::<Place>, most);
        let mut random = Random::new(options.seed);
        let moderate = self.bounds.moderate();
        for number in 0..most {
            if poll() {
                return Err(Error::Cancelled);
            }
            let weights = self.start(number, poles, best.as_ref(), &mut random)?;
            let place = Place::new(self.problem, weights, &mut self.tools)?;
            let bounds = if is_moderate(number) { &moderate } else { self.bounds };
            let place = bounds.meet(self.problem, place, usize::MAX, &mut self.tools)?;
            if place.equations.worst() <= limit {
                let place = self.bounds.settle(self.problem, place, limit, &mut self.tools)?;
                let cost = |place: &Place| self.bounds.cost(&place.weights);
                if solved.is_none() {
                    last = most.min(number + 1 + EXTRA_STARTS);
                }
                if solved.as_ref().is_none_or(|solved| cost(&place) < cost(solved)) {
                    solved = Some(place);
                }
            } else if solved.is_none() {
                let before = best.as_ref().map_or(f64::INFINITY, Place::squares);
                if place.squares() < before * (1.0 - SAME) {
                    hits = 0;
                } else if place.squares() < before * (1.0 + SAME) && !is_around(number) {
                    hits += 1;
                }
                if best.is_none() || place.squares() < before {
                    best = Some(place);
                }
            }
            let good = |place: &Place| self.bounds.cost(&place.weights) <= NEAR_ENOUGH;
            if hits >= ENOUGH || number + 1 >= last || solved.as_ref().is_some_and(good) {
                last = number + 1;
                break;
            }
        }
        Ok((solved.or(best).map_or_else(Vec::new, |place| place.weights), last))
    }

    /// The weights of start `number`.
    fn start(
        &mut self,
        number: u32,
        poles: &[PoleReport],
        best: Option<&Place>,
        random: &mut Random,
    ) -> Result<Vec<f64>, Error> {
        let [low, high] = self.bounds.range;
        let collect = |weight: &dyn Fn(usize) -> f64| {
            let mut out = vec![1.0; self.problem.variables];
            for (k, &v) in self.problem.variable_of.iter().enumerate() {
                out[v] = weight(k).clamp(low, high);
            }
            out
        };
        let guess = collect(&|k| poles[k].first_guess);
        let given = self.problem.net.weights();
        match (number, given, best) {
            (0, ..) => Ok(guess),
            (1, ..) => self.by_ratios(guess),
            (2, Some(given), _) => {
                let ends =
                    given.iter().fold([f64::MAX, 0.0_f64], |[a, b], w| [a.min(*w), b.max(*w)]);
                let middle = ends[0].sqrt() * ends[1].sqrt();
                Ok(collect(&|k| given[k] / middle))
            }
            (2, None, _) => Ok(collect(&|_| 1.0)),
            // Half of the others begin at the best so far with a few weights changed much, half anywhere.
            (_, _, Some(best)) if is_around(number) => {
                let mut weights = best.weights.clone();
                for _ in 0..1 + number % 3 {
                    let chosen = random.below(weights.len());
                    weights[chosen] =
                        (weights[chosen] * factor_within(random, 10.0)).clamp(low, high);
                }
                let jittered = |w: &f64| (w * factor_within(random, 1.1)).clamp(low, high);
                Ok(weights.iter().map(jittered).collect())
            }
            _ => {
                let span = if is_moderate(number) {
                    (high / low).sqrt().sqrt()
                } else {
                    (high / low).sqrt()
                };
                let middle = low.sqrt() * high.sqrt();
                let anywhere = |_| (middle * factor_within(random, span)).clamp(low, high);
                let weights = (0..self.problem.variables).map(anywhere).collect();
                if number % 8 < 4 { self.by_ratios(weights) } else { Ok(weights) }
            }
        }
    }

    /// Some steps of cross ratios from some weights: each weight moves the present foot of its pole to the wished distance.
    fn by_ratios(&mut self, mut weights: Vec<f64>) -> Result<Vec<f64>, Error> {
        let [low, high] = self.bounds.range;
        let problem = self.problem;
        let mut shares = Vec::new();
        for _ in 0..RATIO_STEPS {
            let spread = problem.spread(&weights);
            let shape = problem.net.with(&spread)?;
            self.tools.shapes += 1;
            for &(k, wish) in &problem.wishes {
                let pole = problem.net.poles()[k];
                let foot = shape.closest(pole, problem.accuracy, &mut self.tools.workspace);
                problem.net.shares([foot.u, foot.v], &mut shares);
                let sum: f64 = shares.iter().map(|&(j, n)| n * spread[j]).sum();
                let own = shares.iter().find(|(j, _)| *j == k).map_or(0.0, |(_, n)| n * spread[k]);
                // |PB| of the line through the foot; half of the way in ratios.
                let length = foot.distance / (1.0 - own / sum);
                if own > 0.0 && foot.distance > 0.0 && wish > 0.0 && wish < length {
                    let ratio = (length / wish - 1.0) / (length / foot.distance - 1.0);
                    let v = problem.variable_of[k];
                    weights[v] = (weights[v] * ratio.sqrt()).clamp(low, high);
                }
            }
        }
        Ok(weights)
    }
}

/// Whether a start begins around the best weights so far: every other one behind the first.
fn is_around(number: u32) -> bool {
    number > 2 && number.is_multiple_of(2)
}

/// Whether a search stays in the moderate range.
fn is_moderate(number: u32) -> bool {
    number > 2 && number % 4 >= 2
}

/// A random factor, mostly within 1 / `span` to `span`.
fn factor_within(random: &mut Random, span: f64) -> f64 {
    let x = random.signed() * (1.0 - 1.0 / span);
    (1.0 + x) / (1.0 - x)
}
