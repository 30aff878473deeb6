//! One weight at a time: cross ratios solved for the weight.
//!
//! ```text
//!   B --------- N ------ P      all on one line; N = B + R (P - B) with the share R = N_k w_k / sum N w of the pole at the parameter,
//!                               so that w is proportional to R / (1 - R) = BN / NP
//! ```
//!
//! Reference: Piegl, *Modifying the shape of rational B-splines, part 1: curves*, Computer-Aided Design 21(8), 1989.

use super::{COINCIDENT, Net, check_distance, invalid};
use crate::bounds::{Vector, dot, norm, scaled, sub};
use crate::closest::{FootPoint, QueryOptions, Workspace};
use crate::curve::Curve;
use crate::error::Error;
use crate::index::IndexedCurve;
use crate::knots::MAX_MAGNITUDE;
use crate::preimage::Line;

/// A weight and the place of the curve that it was made for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Edit {
    /// The pole's new weight; the others keep theirs.
    pub weight: f64,
    /// The nearest point of the curve with that weight to the point asked for, with its bound.
    pub foot: FootPoint,
}

/// The share of pole `k` at `u`: the part of the way from B to P that the point has gone.
fn share(curve: &Curve, k: usize, u: f64) -> Result<f64, Error> {
    let (first, last) = curve.domain();
    if !curve.knots().contains(u) {
        return invalid(format!("u: {u} is outside the domain [{first}, {last}]"));
    }
    let mut shares = Vec::new();
    Net::Curve(curve).shares([u, 0.0], &mut shares);
    let weight = |j: usize| curve.weights().map_or(1.0, |weights| weights[j]);
    let sum: f64 = shares.iter().map(|&(j, n)| n * weight(j)).sum();
    let own = shares.iter().find(|(j, _)| *j == k).map_or(0.0, |(j, n)| n * weight(*j));
    let share = own / sum;
    if share > 0.0 && share < 1.0 {
        return Ok(share);
    }
    let text = "its point does not move with that weight";
    invalid(format!("u: {u} is where the curve cannot be moved towards pole {k}: {text}"))
}

fn check_pole(curve: &Curve, k: usize) -> Result<(), Error> {
    let count = curve.poles().len();
    if k < count { Ok(()) } else { invalid(format!("pole: {k} is not below the count of {count}")) }
}

/// The weight times a factor, if the library takes it.
fn multiplied(curve: &Curve, k: usize, factor: f64) -> Result<f64, Error> {
    let weight = curve.weights().map_or(1.0, |weights| weights[k]) * factor;
    if (1.0 / MAX_MAGNITUDE..=MAX_MAGNITUDE).contains(&weight) {
        return Ok(weight);
    }
    invalid(format!(
        "pole: the weight {weight:e} that pole {k} would need is not within 1e-100 .. 1e100"
    ))
}

/// The weight of pole `k` that moves the point at `u` towards it by `distance` (away from it: negative).
///
/// # Errors
/// A point that does not move with the pole, or cannot move that far: not beyond the pole, nor to where it is without the pole.
pub fn move_point(curve: &Curve, u: f64, k: usize, distance: f64) -> Result<f64, Error> {
    check_pole(curve, k)?;
    if !distance.is_finite() {
        return invalid(format!("distance: {distance} is not finite"));
    }
    let share = share(curve, k, u)?;
    let left = norm(sub(curve.poles()[k], curve.evaluate(u)));
    // |NP| and |BN|.
    let gone = left * share / (1.0 - share);
    if distance >= left || -distance >= gone {
        return invalid(format!("distance: {distance} is not between -{gone} and {left}"));
    }
    multiplied(curve, k, (1.0 + distance / gone) / (1.0 - distance / left))
}

/// The weight of pole `k` with which the curve passes through `point`, which lies on a line from the pole through the curve
/// between the pole and the curve's place for weight 0. Of several such lines' crossings the least change of the weight counts.
/// The foot tells how near the curve comes.
///
/// # Errors
/// A point that no weight of this pole reaches within `tolerance` (0: 1e-7 of the diagonal of the curve's box).
pub fn through_point(
    curve: &Curve,
    k: usize,
    point: Vector,
    tolerance: f64,
) -> Result<Edit, Error> {
    check_pole(curve, k)?;
    check_distance("tolerance", tolerance)?;
    if let Some(i) = point.iter().position(|x| !x.is_finite() || x.abs() > MAX_MAGNITUDE) {
        return invalid(format!("point: entry {i} is not finite or beyond 1e100"));
    }
    let (pole, diagonal) = (curve.poles()[k], Net::Curve(curve).diagonal());
    let tolerance = if tolerance > 0.0 { tolerance } else { 1e-7 * diagonal };
    let way = sub(point, pole);
    let length = norm(way);
    if length <= COINCIDENT * diagonal {
        return invalid(format!("point: is pole {k}, where no finite weight takes the curve"));
    }
    let line = Line { origin: pole, direction: way, reach: [0.0, f64::INFINITY] };
    let indexed = IndexedCurve::new(curve.clone());
    let crossings =
        indexed.on_line(&line, tolerance, &QueryOptions::default(), &mut || false)?.members;
    let mut best: Option<(f64, Edit)> = None;
    for u in crossings.iter().map(|crossing| crossing.foot.u) {
        let Ok(weight) = reaching(curve, k, u, point) else { continue };
        let foot = measured(curve, k, weight, point)?;
        let now = curve.weights().map_or(1.0, |weights| weights[k]);
        let change = (weight / now).max(now / weight);
        if foot.distance <= tolerance && best.as_ref().is_none_or(|(least, _)| change < *least) {
            best = Some((change, Edit { weight, foot }));
        }
    }
    best.map(|(_, edit)| edit)
        .map_or_else(|| invalid(format!("point: no weight of pole {k} takes the curve there")), Ok)
}

/// The weight that brings the point at `u` nearest to `point` on its line through the pole.
fn reaching(curve: &Curve, k: usize, u: f64, point: Vector) -> Result<f64, Error> {
    let share = share(curve, k, u)?;
    let (pole, place) = (curve.poles()[k], curve.evaluate(u));
    let way = sub(place, pole);
    let left = norm(way);
    // Distances from the pole: of the point asked for along the line, and of B.
    let wanted = dot(sub(point, pole), scaled(way, 1.0 / left));
    let whole = left / (1.0 - share);
    if wanted <= 0.0 || wanted >= whole {
        return invalid("point: is not between the pole and the curve without it".into());
    }
    let ratio = (whole / wanted - 1.0) * (1.0 - share) / share;
    multiplied(curve, k, ratio)
}

fn measured(curve: &Curve, k: usize, weight: f64, point: Vector) -> Result<FootPoint, Error> {
    let mut weights =
        curve.weights().map_or_else(|| vec![1.0; curve.poles().len()], <[f64]>::to_vec);
    weights[k] = weight;
    let fitted = Net::Curve(curve).curve_with(&weights)?;
    let options = QueryOptions::default();
    let mut workspace = Workspace::default();
    Ok(IndexedCurve::new(fitted).closest(point, None, &options, &mut workspace, None))
}
