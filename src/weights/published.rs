//! The published formulas: general, and linear interpolation.
//!
//! Both take formula (3) pole by pole and measure what came of it. What the text leaves open is settled so: a pole on its chord
//! has weight 1 ([`flag::ON_CHORD`](super::flag::ON_CHORD), the ends of a clamped curve among them); a distance that is not less
//! than that of the chord, or a weight outside the range, takes the nearest weight of the range
//! ([`flag::LIMITED`](super::flag::LIMITED)); a run may rise, fall or stay.

use super::net::Net;
use super::report::Report;
use super::start::first;
use super::{COINCIDENT, Options, check_apart, check_distance, chord, invalid};
use crate::curve::Curve;
use crate::error::Error;

/// Weights `1/lambda - 1` for the relative distances `lambda` of all poles, each between 0 and 1; those of poles on their chord do
/// not count, but are checked.
///
/// # Errors
/// A count or number that is not allowed, by name and index; poles that coincide with a neighbour.
pub fn general(curve: &Curve, lambdas: &[f64], options: &Options) -> Result<Report, Error> {
    let count = curve.poles().len();
    if lambdas.len() != count {
        return invalid(format!("lambdas: {} given, {count} expected", lambdas.len()));
    }
    if let Some(i) = lambdas.iter().position(|x| !(x.is_finite() && *x > 0.0 && *x < 1.0)) {
        return invalid(format!("lambdas: lambda {i} = {} is not between 0 and 1", lambdas[i]));
    }
    let lengths = chord::distances(curve);
    let wishes = lambdas.iter().zip(&lengths).map(|(lambda, length)| lambda * length);
    by_formula(curve, &wishes.collect::<Vec<_>>(), &lengths, options)
}

/// Weights for distances that run evenly, in the order of the poles, from `first` to `last`.
///
/// # Errors
/// As [`general`].
pub fn interpolated(curve: &Curve, ends: [f64; 2], options: &Options) -> Result<Report, Error> {
    check_distance("first_distance", ends[0])?;
    check_distance("last_distance", ends[1])?;
    let last = (curve.poles().len() - 1) as f64;
    let distance = |k: usize| ends[0] + (ends[1] - ends[0]) * (k as f64 / last);
    let wishes: Vec<f64> = (0..curve.poles().len()).map(distance).collect();
    by_formula(curve, &wishes, &chord::distances(curve), options)
}

fn by_formula(
    curve: &Curve,
    wishes: &[f64],
    lengths: &[f64],
    options: &Options,
) -> Result<Report, Error> {
    let (net, range) = (Net::Curve(curve), options.range()?);
    let diagonal = net.diagonal();
    let tolerance = options.tolerance(diagonal)?;
    for k in 0..wishes.len() {
        check_apart(&net, k)?;
    }
    let on_chord = COINCIDENT * diagonal;
    let each = wishes.iter().zip(lengths);
    // A pole on its chord has nothing to wish for.
    let report = |(wish, length): (&f64, &f64)| {
        let mut pole = first(Some(*wish), *length, on_chord, range);
        if *length <= on_chord {
            pole.wish = f64::NAN;
        }
        pole
    };
    let poles: Vec<_> = each.map(report).collect();
    let weights: Vec<f64> = poles.iter().map(|pole| pole.first_guess).collect();
    Report::measured(&net, &weights, poles, tolerance, range)
}
