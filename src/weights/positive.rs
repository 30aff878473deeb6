//! Homogeneous data with weights that are zero or negative, as curves with positive ones.
//!
//! Shapes refuse such weights. The curve may be finite all the same: where its denominator `W(u) = sum N_i w_i` has one sign, it has
//! a form with positive weights, found by inserting knots, since the coefficients of ever smaller pieces tend to the values:
//!
//! ```text
//!   every weight negative?           all signs changed
//!   a weight of the other sign?      knots in the middle of the spans where it acts, again and again
//!   W of the other sign or 0 at a knot?   the curve goes to infinity there: no form exists
//! ```
//!
//! Reference: Piegl, Tiller, *The NURBS Book*, 2nd ed., sections 4.2 and 5.2.
//! Limits: a denominator that comes within rounding of 0 is not decided after 30 halvings; pairs of zeros of numerator and
//! denominator are not divided out.

use super::invalid;
use crate::curve::Curve;
use crate::error::Error;
use crate::knots::{Knots, MAX_MAGNITUDE};

/// Halvings of a span: 2^-30 of it is beyond what a denominator that is not 0 for its rounding needs.
const MOST_ROUNDS: usize = 30;

/// Most poles of a form.
const MOST_POLES: usize = 20_000;

/// Units of the greatest weight within which a value of the denominator is not told from 0.
const ROUNDING: f64 = 1e-13;

/// A pole times its weight, and the weight.
type Homogeneous = [f64; 4];

/// A curve with positive weights that is the one given by `poles`, `(w x, w y, w z, w)` each, over the knots.
///
/// # Errors
/// Knots or numbers that are not allowed, by name and index; [`Error::Unsupported`] with the parameter when the denominator vanishes,
/// or comes so near to 0 that it cannot be told.
pub fn positive(knots: &[f64], degree: usize, poles: &[Homogeneous]) -> Result<Curve, Error> {
    let mut all = Knots::new(knots, degree, poles.len()).map_err(|error| error.named(""))?;
    let bad = |pole: &Homogeneous| pole.iter().any(|x| !x.is_finite() || x.abs() > MAX_MAGNITUDE);
    if let Some(i) = poles.iter().position(bad) {
        return invalid(format!("poles: pole {i} is not finite or beyond 1e100"));
    }
    let greatest = poles.iter().fold(0.0, |most: f64, pole| most.max(pole[3].abs()));
    if greatest == 0.0 {
        return Err(Error::Unsupported("poles: every weight is 0".into()));
    }
    let negative = poles.iter().map(|pole| pole[3]).sum::<f64>() < 0.0;
    let sign = if negative { -1.0 } else { 1.0 };
    let mut points: Vec<Homogeneous> = poles.iter().map(|pole| pole.map(|x| sign * x)).collect();
    let least = ROUNDING * greatest;
    for _ in 0..=MOST_ROUNDS {
        check_values(&all, &points, least)?;
        let Some(cuts) = cuts(&all, &points, least) else { return finished(&all, &points) };
        if points.len() + cuts.len() > MOST_POLES {
            break;
        }
        for u in cuts {
            (all, points) = inserted(&all, &points, u)?;
        }
    }
    undecided(&all, &points, least)
}

fn undecided(knots: &Knots, points: &[Homogeneous], least: f64) -> Result<Curve, Error> {
    let i = points.iter().position(|point| point[3] <= least).unwrap_or(0);
    let at = knots.values()[(i + 1).min(knots.values().len() - 1)];
    let text = format!("poles: the denominator comes too near to 0 at u = {at} to be told from it");
    Err(Error::Unsupported(text))
}

/// The denominator at all knots of the domain.
fn check_values(knots: &Knots, points: &[Homogeneous], least: f64) -> Result<(), Error> {
    let (first, last) = knots.domain();
    let inside = knots.values().iter().filter(|u| (first..=last).contains(*u));
    for &u in inside {
        let span = knots.span(u);
        let mut basis = vec![0.0; knots.degree() + 1];
        crate::basis::values(knots, span, u, &mut basis);
        let local = &points[span - knots.degree()..=span];
        let value: f64 = basis.iter().zip(local).map(|(n, point)| n * point[3]).sum();
        if value <= least {
            let text =
                format!("poles: the denominator is 0 or changes its sign at or beside u = {u}");
            return Err(Error::Unsupported(text));
        }
    }
    Ok(())
}

/// The middles of the spans on which a weight acts that is not positive; none when there is no such weight.
fn cuts(knots: &Knots, points: &[Homogeneous], least: f64) -> Option<Vec<f64>> {
    let p = knots.degree();
    let is_bad = |span: usize| points[span - p..=span].iter().any(|point| point[3] <= least);
    let middle = |span: usize| 0.5 * knots.values()[span] + 0.5 * knots.values()[span + 1];
    let cuts: Vec<f64> = knots.spans().filter(|span| is_bad(*span)).map(middle).collect();
    if !cuts.is_empty() {
        return Some(cuts);
    }
    // Poles of an unclamped vector that act nowhere in the domain have any weight.
    None
}

/// Boehm's insertion of `u`, inside a span.
fn inserted(
    knots: &Knots,
    points: &[Homogeneous],
    u: f64,
) -> Result<(Knots, Vec<Homogeneous>), Error> {
    let (p, t, k) = (knots.degree(), knots.values(), knots.span(u));
    let mut values = t.to_vec();
    values.insert(k + 1, u);
    let mut out = Vec::new();
    out.try_reserve_exact(points.len() + 1).map_err(|_| Error::OutOfMemory)?;
    out.extend_from_slice(&points[..=k - p]);
    for i in k - p + 1..=k {
        let share = (u - t[i]) / (t[i + p] - t[i]);
        let (before, here) = (points[i - 1], points[i]);
        out.push(std::array::from_fn(|axis| (1.0 - share) * before[axis] + share * here[axis]));
    }
    out.extend_from_slice(&points[k..]);
    let knots = Knots::new(&values, p, out.len()).map_err(|error| error.named(""))?;
    Ok((knots, out))
}

/// The curve, when every weight is positive.
fn finished(knots: &Knots, points: &[Homogeneous]) -> Result<Curve, Error> {
    let active = knots.active_poles();
    let point = |(i, point): (usize, &Homogeneous)| {
        // A pole outside the domain that acts nowhere may have any weight.
        let w = if active.contains(&i) || point[3] > 0.0 { point[3] } else { 1.0 };
        ([point[0] / w, point[1] / w, point[2] / w], w)
    };
    let (poles, weights): (Vec<[f64; 3]>, Vec<f64>) = points.iter().enumerate().map(point).unzip();
    Curve::new(knots.values(), knots.degree(), &poles, Some(&weights))
}
