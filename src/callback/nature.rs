//! What a stationary place is, and the iteration that leads to one of any nature.
//!
//! Parameters are taken in widths of the domain here, so that both weigh alike. The iteration is Newton's for the zero
//! of the slopes, with the inverse restricted to directions in which the slopes change: on a continuum it steps
//! across and not along.
//!
//! Limit: second derivatives that come from differences decide signs down to [`LEAST_CURVATURE`] only.

use super::cell::Probe;
use super::foot::Place;
use crate::bounds::{dot, norm, sub};
use crate::jet::Jet2;
use crate::set::Nature;

/// First derivatives count as zero below this cosine between distance and tangent.
pub const LEAST_COSINE: f64 = 1e-7;

/// Second derivatives count as zero below this share of the metric.
pub const LEAST_CURVATURE: f64 = 1e-5;

/// Steps of the iteration.
const STEPS: usize = 30;

/// A step below this share of the domain is the last one.
const LAST_STEP: f64 = 1e-9;

impl Probe<'_> {
    /// What the distance does at a place, among the points of `range` around it.
    pub fn nature(&self, place: Place, range: [f64; 4]) -> Nature {
        let Some(jet) = self.jet_at(place.at) else { return Nature::Flat };
        let (tangents, slopes) = ([jet.s, jet.t], jet.gradient());
        let (mut signs, mut free) = (Vec::with_capacity(3), [false; 2]);
        for k in 0..self.shape.source.dims {
            let inward =
                f64::from(place.at[k] == range[2 * k]) - f64::from(place.at[k] == range[2 * k + 1]);
            let least = norm(tangents[k])
                * (LEAST_COSINE * norm(jet.d) + 4.0 * self.shape.rounding(place.point));
            if inward != 0.0 && slopes[k].abs() > least {
                signs.push(inward * slopes[k]);
            } else {
                free[k] = true;
            }
        }
        signs.extend(curvatures(&jet, free));
        verdict(&signs)
    }

    /// Newton's iteration for a place where the slopes of the free parameters vanish, inside `range`.
    pub fn stationary(&self, start: [f64; 2], range: [f64; 4], free: [bool; 2]) -> Option<Place> {
        let widths = [0, 1].map(|k| self.shape.source.width(k));
        let mut at = start;
        for _ in 0..STEPS {
            let jet = self.jet_at(at)?;
            let step = pseudo_newton(&jet, widths, free);
            let size = step[0].abs().max(step[1].abs());
            // Far from a zero the model is not believed for more than a twentieth of the domain.
            let share = if size > 0.05 { 0.05 / size } else { 1.0 };
            at = [0, 1].map(|k| {
                let to = at[k] + share * step[k] * widths[k];
                to.clamp(range[2 * k], range[2 * k + 1])
            });
            if size <= LAST_STEP {
                return self.place(at).filter(|place| self.is_stationary(*place, free));
            }
        }
        self.place(at).filter(|place| self.is_stationary(*place, free))
    }

    /// Whether the slopes of the free parameters vanish at a place but for rounding.
    fn is_stationary(&self, place: Place, free: [bool; 2]) -> bool {
        let Some((values, _)) = self.values(place.at, 1) else { return false };
        let r = sub(place.point, self.query);
        (0..2).all(|k| {
            let tangent = values[1 + k];
            let least = LEAST_COSINE * norm(r) + 16.0 * self.shape.rounding(place.point);
            !free[k] || dot(r, tangent).abs() <= least * norm(tangent)
        })
    }
}

/// Second derivatives of the squared distance over the free parameters, relative to the metric; 0 where they vanish.
fn curvatures(jet: &Jet2, free: [bool; 2]) -> Vec<f64> {
    let ([a, b, c], [e, f, g]) = (jet.hessian(), jet.metric());
    let cleaned = |x: f64| if x.abs() <= LEAST_CURVATURE { 0.0 } else { x };
    let one = |h: f64, m: f64| vec![if m > 0.0 { cleaned(h / m) } else { 0.0 }];
    match free {
        [false, false] => Vec::new(),
        [true, false] => one(a, e),
        [false, true] => one(c, g),
        [true, true] => {
            let area = e * g - f * f;
            if area <= 1e-12 * e * g {
                return vec![0.0];
            }
            // Roots of det(H - x M): x^2 - 2 m x + d = 0.
            let m = 0.5 * (a * g - 2.0 * b * f + c * e) / area;
            let d = (a * c - b * b) / area;
            let spread = (m * m - d).max(0.0).sqrt();
            vec![cleaned(m - spread), cleaned(m + spread)]
        }
    }
}

/// The nature from signs of derivatives into the domain.
pub fn verdict(signs: &[f64]) -> Nature {
    let up = signs.iter().any(|&x| x > 0.0);
    let down = signs.iter().any(|&x| x < 0.0);
    let zero = signs.contains(&0.0);
    match (up, down) {
        (true, true) => Nature::Saddle,
        _ if zero => Nature::Flat,
        (true, false) => Nature::Minimum,
        (false, true) => Nature::Maximum,
        (false, false) => Nature::Flat,
    }
}

/// The step to the zero of the linear model of the slopes, in widths of the domain; across directions in which the model
/// does not change only.
fn pseudo_newton(jet: &Jet2, [u, v]: [f64; 2], free: [bool; 2]) -> [f64; 2] {
    let ([x, y], [a, b, c]) = (jet.gradient(), jet.hessian());
    let ([x, y], [a, b, c]) = ([x * u, y * v], [a * u * u, b * u * v, c * v * v]);
    let one = |slope: f64, curvature: f64| if curvature == 0.0 { 0.0 } else { -slope / curvature };
    match free {
        [false, false] => [0.0; 2],
        [true, false] => [one(x, a), 0.0],
        [false, true] => [0.0, one(y, c)],
        [true, true] => {
            let (mean, half) = (0.5 * (a + c), 0.5 * (a - c));
            let spread = (half * half + b * b).sqrt();
            let (first, second) = (mean + spread, mean - spread);
            let cut = 1e-5 * first.abs().max(second.abs());
            // The eigenvector of the first eigenvalue.
            let raw = if half >= 0.0 { [half + spread, b] } else { [b, spread - half] };
            let size = (raw[0] * raw[0] + raw[1] * raw[1]).sqrt();
            let [p, q] = if size > 0.0 { raw.map(|z| z / size) } else { [1.0, 0.0] };
            let along =
                |value: f64, slope: f64| if value.abs() > cut { -slope / value } else { 0.0 };
            let (s, t) = (along(first, p * x + q * y), along(second, p * y - q * x));
            [p * s - q * t, q * s + p * t]
        }
    }
}
