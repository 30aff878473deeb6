//! The published network: wished distances for some poles, a range of distances for the others.
//!
//! A layer of random inputs `x` and a layer with one output a pole, trained anew in each call:
//!
//! ```text
//!   y_i = sum mu_ij x_j + v_i,   w_i = f(y_i),   lambda_i = 1 / (w_i + 1),   l_i = lambda_i L_i
//!   loss = sum over wishes (w_i - wanted_i)^2 / 2  +  sum over the others (w_i beyond its range)^2 / 2
//! ```
//!
//! `f(y) = y + sqrt(y^2 + 1)` is positive, rises, has f(0) = 1 and needs no exponential, so that training has the same bits
//! everywhere. Back-propagation with the step normalised by `f'(y)^2 (|x|^2 + 1)` takes a handful of rounds. A weight is
//! within its range when its distance `l_i` by formula (3) is within that of the caller. Whatever is not trained when the steps run
//! out is set to the nearest weight that is as wished, and marked ([`flag::UNTRAINED`]).

use super::net::Net;
use super::report::{Report, flag};
use super::start::{Random, first, guess};
use super::{COINCIDENT, Options, Wish, check_distance, chord, invalid, wished};
use crate::curve::Curve;
use crate::error::Error;

/// Most rounds of training by default.
pub const DEFAULT_STEPS: u32 = 1_000;

/// Random inputs.
const INPUTS: usize = 8;

/// Relative error of a wished weight at which its output is trained.
const TRAINED: f64 = 1e-14;

/// One output: its synapses, and the least and greatest weight that it may have. A wish makes both equal.
struct Output {
    mu: [f64; INPUTS],
    v: f64,
    wanted: [f64; 2],
}

/// Weights for wished distances of some poles while those of all others, by formula (3), stay within `[distances[0],
/// distances[1]]`. Equal ends are a wish for all; wishes lie in the range. The range of a pole that is not farther than
/// `distances[0]` from its chord holds no weight: it has the least ([`flag::LIMITED`]).
///
/// # Errors
/// A wish, range or option that is not allowed, by name and index.
pub fn network(
    curve: &Curve,
    wishes: &[Wish],
    distances: [f64; 2],
    options: &Options,
) -> Result<Report, Error> {
    let (net, range) = (Net::Curve(curve), options.range()?);
    let diagonal = net.diagonal();
    let tolerance = options.tolerance(diagonal)?;
    check_distance("min_distance", distances[0])?;
    check_distance("max_distance", distances[1])?;
    if distances[0] > distances[1] {
        let [least, most] = distances;
        return invalid(format!("min_distance: {least} is more than max_distance {most}"));
    }
    let wished = wished(&net, wishes)?;
    let outside = |wish: &&Wish| wish.distance < distances[0] || wish.distance > distances[1];
    if let Some(wish) = wishes.iter().find(outside) {
        let text =
            format!("wish_distances: {} of pole {} is not in the range", wish.distance, wish.pole);
        return invalid(text);
    }
    let on_chord = COINCIDENT * diagonal;
    let lengths = chord::distances(curve);
    let each = wished.iter().zip(&lengths);
    let mut poles: Vec<_> =
        each.map(|(wish, length)| first(*wish, *length, on_chord, range)).collect();
    let mut outputs = Vec::new();
    let mut random = Random::new(options.seed);
    let input: [f64; INPUTS] = std::array::from_fn(|_| random.signed());
    for (pole, length) in poles.iter_mut().zip(&lengths) {
        let wanted = if pole.wish.is_nan() {
            let ends = distances.map(|l| guess(l, *length, on_chord, range));
            // Only where even the greatest distance is not less than the chord's there is no weight.
            pole.flags |= ends[0].1 & flag::ON_CHORD;
            if *length > on_chord && length / distances[0] - 1.0 < range[0]
                || length / distances[1] - 1.0 > range[1]
            {
                pole.flags |= flag::LIMITED;
            }
            [ends[1].0, ends[0].0]
        } else {
            [pole.first_guess; 2]
        };
        let mu = std::array::from_fn(|_| random.signed());
        outputs.push(Output { mu, v: random.signed(), wanted });
    }
    let (steps, weights) = train(&mut outputs, &input, options.steps);
    for ((pole, output), weight) in poles.iter_mut().zip(&outputs).zip(&weights) {
        if !output.is_trained(*weight) {
            pole.flags |= flag::UNTRAINED;
        }
    }
    let each = outputs.iter().zip(&weights);
    let weights: Vec<f64> = each.map(|(o, w)| w.clamp(o.wanted[0], o.wanted[1])).collect();
    let mut report = Report::measured(&net, &weights, poles, tolerance, range)?;
    report.iterations = u64::from(steps);
    Ok(report)
}

/// Trains until every output is as wished or the steps run out; the steps taken and the weights.
fn train(outputs: &mut [Output], input: &[f64; INPUTS], steps: u32) -> (u32, Vec<f64>) {
    let most = if steps > 0 { steps } else { DEFAULT_STEPS };
    let inputs = 1.0 + input.iter().map(|x| x * x).sum::<f64>();
    for step in 0..most {
        let weights: Vec<f64> = outputs.iter().map(|output| output.weight(input).0).collect();
        if outputs.iter().zip(&weights).all(|(output, w)| output.is_trained(*w)) {
            return (step, weights);
        }
        for output in outputs.iter_mut() {
            output.propagate_back(input, inputs);
        }
    }
    (most, outputs.iter().map(|output| output.weight(input).0).collect())
}

impl Output {
    /// `f(y)` and `f'(y)`.
    fn weight(&self, input: &[f64; INPUTS]) -> (f64, f64) {
        let y = self.mu.iter().zip(input).map(|(mu, x)| mu * x).sum::<f64>() + self.v;
        let root = (y * y + 1.0).sqrt();
        // Without cancellation on the negative side.
        let f = if y < 0.0 { 1.0 / (root - y) } else { y + root };
        (f, f / root)
    }

    /// How far a weight is beyond what is wanted.
    fn excess(&self, weight: f64) -> f64 {
        weight - weight.clamp(self.wanted[0], self.wanted[1])
    }

    fn is_trained(&self, weight: f64) -> bool {
        self.excess(weight).abs() <= TRAINED * weight
    }

    /// The gradient of the loss, `excess f'(y)` times the input, with a normalised step.
    fn propagate_back(&mut self, input: &[f64; INPUTS], inputs: f64) {
        let (weight, slope) = self.weight(input);
        let step = self.excess(weight) / (slope * inputs);
        for (mu, x) in self.mu.iter_mut().zip(input) {
            *mu -= step * x;
        }
        self.v -= step;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_output_reaches_any_weight_of_the_range_within_a_few_rounds() {
        let input = [0.3, -0.2, 0.9, 0.5, -0.7, 0.1, 0.8, -0.4];
        for wanted in [1e-12, 0.01, 0.5, 1.0, 7.0, 1e3, 1e12] {
            let output = Output { mu: [0.5; INPUTS], v: -0.3, wanted: [wanted; 2] };
            let mut outputs = [output];
            let (steps, weights) = train(&mut outputs, &input, 0);
            assert!(steps < 100, "{wanted}: {steps} steps");
            assert!((weights[0] / wanted - 1.0).abs() < 1e-13, "{wanted}: {}", weights[0]);
        }
    }
}
