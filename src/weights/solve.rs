//! The search for weights: equations met first, then weights without a wish as near 1 as they can be.
//!
//! A step `x` of the logarithms makes the linearised equations hold and changes as little as possible, measured with a
//! diagonal metric `H`; `g` is the gradient of what is to become small:
//!
//! ```text
//!   min g.x + x.Hx/2   with   J x = -f        (J H^-1 J^T) y = J H^-1 g - f,   x = H^-1 (J^T y - g)
//! ```
//!
//! Variables that would leave the range stop at its end, and the rest is solved again. A step counts when the squares of `f` get
//! smaller; it is halved otherwise. A least distance has a kink where its foot jumps to another branch, and a search
//! may get stuck there: then `refine` starts another.
//!
//! Reference: Nocedal, Wright, *Numerical Optimization*, 2nd ed., sections 10.3 and 18.1.

use super::linear;
use super::rows::{Equations, Problem, Tools, factor, height};
use crate::error::Error;

/// Most steps of one search for weights that meet the equations.
const MOST_STEPS: usize = 200;

/// Longest step of a logarithm: a factor of about five.
const LONGEST: f64 = 1.5;

/// Share of the metric of variables that have a wish of their own: they move first.
const WISHED: f64 = 1e-3;

/// A search is given up when the squares have not fallen to this share within so many steps.
const PROGRESS: f64 = 0.3;
/// Near a solution, where weights at the ends of the range may leave a narrow valley, slower progress will do.
const NEAR: f64 = 1e-3;
const CRAWL: f64 = 0.9;
const PACE: usize = 8;

/// A search that gets stuck at a kink takes a whole step over it, at most so many times.
const MOST_LEAPS: usize = 6;

/// Greatest residual from which that is not worth while: there it is rounding that is in the way.
const LEAP_FROM: f64 = 1e-12;

/// Ridge, relative to the mean of the diagonal: equations that say the same twice share the work.
const RIDGE: f64 = 1e-14;

/// Residuals below this many units of rounding are not made smaller.
const ROUNDING: f64 = 2.0 * f64::EPSILON;

/// Range and preferences of the variables.
pub struct Bounds {
    /// Least and greatest weight.
    pub range: [f64; 2],
    /// Where a variable should be, if it is not to move for a wish of its own.
    pub targets: Vec<Option<f64>>,
}

/// Weights and how well they meet the equations.
#[derive(Clone)]
pub struct Place {
    pub weights: Vec<f64>,
    pub equations: Equations,
}

impl Place {
    pub fn new(problem: &Problem, weights: Vec<f64>, tools: &mut Tools) -> Result<Self, Error> {
        let equations = problem.equations(&weights, tools)?;
        Ok(Self { weights, equations })
    }

    /// The sum of the squared residuals.
    pub fn squares(&self) -> f64 {
        self.equations.squares()
    }
}

impl Bounds {
    /// Metric and gradient of the preferences at some weights.
    fn preferences(&self, weights: &[f64]) -> (Vec<f64>, Vec<f64>) {
        let each = self.targets.iter().zip(weights);
        each.map(|(target, w)| target.map_or((WISHED, 0.0), |t| (1.0, height(w / t)))).unzip()
    }

    /// The squared distance from the preferences.
    pub fn cost(&self, weights: &[f64]) -> f64 {
        let each = self.targets.iter().zip(weights);
        each.filter_map(|(target, w)| target.map(|t| height(w / t))).map(|x| x * x).sum()
    }

    /// The same in a range that is half as wide in logarithms: extreme weights are where searches get stuck.
    pub fn moderate(&self) -> Self {
        let [low, high] = self.range;
        let (middle, half) = (low.sqrt() * high.sqrt(), (high / low).sqrt().sqrt());
        let range = [(middle / half).max(low), (middle * half).min(high)];
        Self { range, targets: self.targets.clone() }
    }

    /// How far a variable may go in one direction.
    fn room(&self, weight: f64, step: f64) -> f64 {
        height(if step > 0.0 { self.range[1] } else { self.range[0] } / weight)
    }

    fn moved(&self, weights: &[f64], step: &[f64], share: f64) -> Vec<f64> {
        let [low, high] = self.range;
        let each = weights.iter().zip(step);
        each.map(|(w, x)| (w * factor(share * x)).clamp(low, high)).collect()
    }

    /// The step from a place; `tending`: towards the preferences too. None when the equations say nothing.
    fn step(&self, place: &Place, tending: bool) -> Option<Vec<f64>> {
        let n = place.weights.len();
        let (metric, mut gradient) = self.preferences(&place.weights);
        if !tending {
            gradient.fill(0.0);
        }
        let mut fixed: Vec<Option<f64>> = vec![None; n];
        for _ in 0..=n.min(12) {
            let step = solved(&place.equations, &metric, &gradient, &fixed)?;
            let mut outside = false;
            for j in 0..n {
                let room = self.room(place.weights[j], step[j]);
                if fixed[j].is_none() && step[j].abs() > room.abs() {
                    fixed[j] = Some(room);
                    outside = true;
                }
            }
            if !outside {
                return Some(step);
            }
        }
        solved(&place.equations, &metric, &gradient, &fixed)
    }

    /// Weights that meet the equations to the limit of rounding, or as well as this search can.
    pub fn meet(
        &self,
        problem: &Problem,
        mut place: Place,
        most: usize,
        tools: &mut Tools,
    ) -> Result<Place, Error> {
        let (mut best, mut leaps) = (None::<Place>, 0);
        let mut mark = f64::INFINITY;
        for number in 0..most.min(MOST_STEPS) {
            if place.equations.worst() <= ROUNDING {
                break;
            }
            if number % PACE == 0 {
                let near = place.equations.worst() < NEAR;
                if place.squares() > if near { CRAWL } else { PROGRESS } * mark {
                    break;
                }
                mark = place.squares();
            }
            let Some(step) = self.step(&place, false) else { break };
            if let Some(better) = self.shorter(problem, &place, &step, tools)? {
                place = better;
                continue;
            }
            if leaps == MOST_LEAPS || place.equations.worst() <= LEAP_FROM || most < MOST_STEPS {
                break;
            }
            leaps += 1;
            let moved = self.moved(&place.weights, &step, share_of(&step));
            let beyond = Place::new(problem, moved, tools)?;
            let before = std::mem::replace(&mut place, beyond);
            if best.as_ref().is_none_or(|best| before.squares() < best.squares()) {
                best = Some(before);
            }
        }
        Ok(best.filter(|best| best.squares() < place.squares()).unwrap_or(place))
    }

    /// The first share of a step that makes the squares smaller.
    fn shorter(
        &self,
        problem: &Problem,
        place: &Place,
        step: &[f64],
        tools: &mut Tools,
    ) -> Result<Option<Place>, Error> {
        let (mut share, before) = (share_of(step), place.squares());
        for _ in 0..6 {
            let next = Place::new(problem, self.moved(&place.weights, step, share), tools)?;
            if next.squares() < before * (1.0 - 1e-3 * share) {
                return Ok(Some(next));
            }
            share *= 0.3;
        }
        Ok(None)
    }

    /// From weights that meet the equations to within `limit` to such that are nearer to the preferences, until that pays no more.
    pub fn settle(
        &self,
        problem: &Problem,
        mut place: Place,
        limit: f64,
        tools: &mut Tools,
    ) -> Result<Place, Error> {
        let mut share = 1.0;
        for _ in 0..MOST_STEPS {
            let cost = self.cost(&place.weights);
            let Some(step) = self.step(&place, true) else { break };
            let longest = step.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
            if cost < 1e-30 || longest < 1e-13 || share < 1e-3 {
                break;
            }
            let share_now = share * share_of(&step);
            let moved = self.moved(&place.weights, &step, share_now);
            let next = Place::new(problem, moved, tools)?;
            let next = self.meet(problem, next, 6, tools)?;
            let gain = cost - self.cost(&next.weights);
            if next.equations.worst() <= limit && gain > 0.0 {
                place = next;
                if gain < 1e-12 * cost {
                    break;
                }
                share = (2.0 * share).min(1.0);
            } else {
                share *= 0.3;
            }
        }
        Ok(place)
    }
}

/// The share of a step that is not too long.
fn share_of(step: &[f64]) -> f64 {
    let longest = step.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    (LONGEST / longest).min(1.0)
}

/// The step with some variables fixed.
fn solved(
    equations: &Equations,
    metric: &[f64],
    gradient: &[f64],
    fixed: &[Option<f64>],
) -> Option<Vec<f64>> {
    let (m, n) = (equations.f.len(), metric.len());
    let row = |i: usize| &equations.rows[i * n..(i + 1) * n];
    // H^-1 of what is free.
    let free: Vec<f64> =
        (0..n).map(|j| if fixed[j].is_some() { 0.0 } else { 1.0 / metric[j] }).collect();
    let mut y: Vec<f64> = (0..m)
        .map(|i| {
            let each = row(i).iter().enumerate();
            let moved = each.map(|(j, x)| x * (free[j] * gradient[j] - fixed[j].unwrap_or(0.0)));
            moved.sum::<f64>() - equations.f[i]
        })
        .collect();
    let mut product = vec![0.0; m * m];
    for i in 0..m {
        for k in 0..=i {
            let each = row(i).iter().zip(row(k)).zip(&free);
            let sum: f64 = each.map(|((a, b), h)| a * b * h).sum();
            product[i * m + k] = sum;
            product[k * m + i] = sum;
        }
    }
    if !linear::solve(&mut product, &mut y, RIDGE) && m > 0 {
        return None;
    }
    let mut step: Vec<f64> = (0..n).map(|j| -free[j] * gradient[j]).collect();
    for i in 0..m {
        for (j, x) in row(i).iter().enumerate() {
            step[j] += free[j] * x * y[i];
        }
    }
    for (x, fixed) in step.iter_mut().zip(fixed) {
        *x = fixed.unwrap_or(*x);
    }
    Some(step)
}
