//! Parameters for points in order, and knots for parameters.

use crate::curve::insertion::spare;
use crate::error::Error;
use crate::portable::SameDigits;

/// How the steps between the parameters of neighbouring points follow the distances `d` of the points.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Spacing {
    /// All steps are equal.
    Uniform,
    /// Steps as `d`: the curve runs at nearly constant speed.
    #[default]
    Chordal,
    /// Steps as the square root of `d`: calmer where distances change abruptly (Lee 1989).
    Centripetal,
}

pub(super) fn distance<const N: usize>(a: &[f64; N], b: &[f64; N]) -> f64 {
    a.iter().zip(b).fold(0.0, |length: f64, (x, y)| length.hypotenuse(x - y))
}

/// Parameters from 0 to 1 for points in order, at least two.
///
/// # Errors
/// `points`: fewer than two, not finite, or all the same.
pub fn parameters<const N: usize>(
    spacing: Spacing,
    points: &[[f64; N]],
) -> Result<Vec<f64>, Error> {
    check_points(points, 2)?;
    // A list that grows by doubling.
    spare(points.len(), 3 * size_of::<f64>())?;
    let step = |pair: &[[f64; N]]| match spacing {
        Spacing::Uniform => 1.0,
        Spacing::Chordal => distance(&pair[0], &pair[1]),
        Spacing::Centripetal => distance(&pair[0], &pair[1]).sqrt(),
    };
    let sums = points.windows(2).map(step).scan(0.0, |sum, step| {
        *sum += step;
        Some(*sum)
    });
    let mut list: Vec<f64> = std::iter::once(0.0).chain(sums).collect();
    let length = list[list.len() - 1];
    if length == 0.0 {
        return Err(Error::InvalidArgument("points: all are the same point".into()));
    }
    list.iter_mut().for_each(|t| *t /= length);
    Ok(list)
}

/// Refuses lists that are too short or hold what is not finite.
pub(super) fn check_points<const N: usize>(
    points: &[[f64; N]],
    needed: usize,
) -> Result<(), Error> {
    let found = points.len();
    if found < needed {
        let text = format!("points: {found} given, at least {needed} needed");
        return Err(Error::InvalidArgument(text));
    }
    match points.iter().position(|p| p.iter().any(|x| !x.is_finite() || x.abs() > 1e100)) {
        Some(i) => {
            Err(Error::InvalidArgument(format!("points: point {i} is not finite or beyond 1e100")))
        }
        None => Ok(()),
    }
}

/// Refuses parameters that are not finite, decrease, or are not as many as the points.
pub(super) fn check_parameters(parameters: &[f64], points: usize) -> Result<(), Error> {
    let found = parameters.len();
    let text = if found != points {
        format!("parameters: {found} given, {points} expected")
    } else if let Some(i) = parameters.iter().position(|t| !t.is_finite()) {
        format!("parameters: parameter {i} is not finite")
    } else if let Some(i) = parameters.windows(2).position(|w| w[1] < w[0]) {
        format!("parameters: parameter {} is less than parameter {i}", i + 1)
    } else {
        return Ok(());
    };
    Err(Error::InvalidArgument(text))
}

/// Full knots, clamped, on which points at increasing parameters, at least `degree + 1`, can be interpolated: each inner
/// knot is the mean of `degree` parameters in a row.
///
/// Reference: Piegl, Tiller, *The NURBS Book*, 2nd ed., equation (9.8).
pub fn averaged_knots(degree: usize, parameters: &[f64]) -> Vec<f64> {
    let count = parameters.len();
    debug_assert!(degree >= 1 && count > degree);
    let mut knots = vec![parameters[0]; degree + 1];
    let mean = |w: &[f64]| w.iter().map(|t| (t - w[0]) / degree as f64).sum::<f64>() + w[0];
    knots.extend(parameters[1..count - 1].windows(degree).map(mean));
    knots.extend(std::iter::repeat_n(parameters[count - 1], degree + 1));
    knots
}

/// Full knots, clamped, for `pole_count` poles fitted to points at increasing parameters: every span gets nearly
/// the same number of them.
///
/// Reference: Piegl, Tiller, *The NURBS Book*, 2nd ed., equations (9.68) and (9.69).
pub fn spread_knots(degree: usize, pole_count: usize, parameters: &[f64]) -> Vec<f64> {
    let count = parameters.len();
    debug_assert!(degree >= 1 && pole_count > degree && count >= pole_count);
    let mut knots = vec![parameters[0]; degree + 1];
    let spans = pole_count - degree;
    for j in 1..spans {
        let place = (j * count) as f64 / spans as f64;
        let i = place as usize;
        let share = place - i as f64;
        knots.push((1.0 - share) * parameters[i - 1] + share * parameters[i]);
    }
    knots.extend(std::iter::repeat_n(parameters[count - 1], degree + 1));
    knots
}
