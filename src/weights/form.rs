//! Weights changed as a whole: without moving the shape, or by as little as a bound of their spread asks.
//!
//! A change of the parameter `u(s)` by a linear fraction with denominator `d(s)` leaves a curve where it is. Its poles stay, the
//! knots are mapped, and each weight is multiplied by `d` at its knots:
//!
//! ```text
//!   w_i -> w_i d(s_{i+1}) ... d(s_{i+p}),    d(s) = 1 + (r - 1) s,   r^p = w_0 / w_n,    s = x / (r - (r - 1) x)
//! ```
//!
//! for the domain [0, 1]. With this r both end weights are equal, and 1 after division.
//!
//! Reference: Lee, Lucian, *Möbius reparametrizations of rational B-splines*, Computer Aided Geometric Design 8, 1991.

use super::invalid;
use crate::curve::Curve;
use crate::error::Error;

/// What is 1 afterwards.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unit {
    /// The first weight.
    First,
    /// The greatest weight.
    Greatest,
    /// The product of least and greatest weight.
    Middle,
}

fn checked(weights: &[f64]) -> Result<[f64; 2], Error> {
    if weights.is_empty() {
        return invalid("weights: there is none".into());
    }
    crate::curve::check_weights(Some(weights), weights.len(), |i| i.to_string())?;
    let ends = |[low, high]: [f64; 2], w: &f64| [low.min(*w), high.max(*w)];
    Ok(weights.iter().fold([f64::INFINITY, 0.0], ends))
}

/// Weights divided by one number: the same shape.
///
/// # Errors
/// Weights that a shape would refuse, by index, before or after.
pub fn normalised(weights: &[f64], unit: Unit) -> Result<Vec<f64>, Error> {
    let [low, high] = checked(weights)?;
    let divisor = match unit {
        Unit::First => weights[0],
        Unit::Greatest => high,
        Unit::Middle => (low * high).sqrt(),
    };
    let out: Vec<f64> = weights.iter().map(|w| w / divisor).collect();
    checked(&out)?;
    Ok(out)
}

/// Weights whose greatest is at most `ratio` times the least, each changed by the least factor that is enough for all: those outside
/// are moved to the ends of a range whose middle is that of the given ones.
///
/// # Errors
/// As [`normalised`]; a ratio below 1.
pub fn bounded(weights: &[f64], ratio: f64) -> Result<Vec<f64>, Error> {
    let [low, high] = checked(weights)?;
    if ratio.is_nan() || ratio < 1.0 {
        return invalid(format!("ratio: {ratio} is less than 1"));
    }
    if high <= low * ratio {
        return Ok(weights.to_vec());
    }
    // Towards the middle by an ulp or two, so that the quotient holds after rounding.
    let least = (low * high / ratio).sqrt();
    let greatest = (least * ratio * (1.0 - 2.0 * f64::EPSILON)).max(least);
    Ok(weights.iter().map(|w| w.clamp(least, greatest)).collect())
}

/// The same curve with both end weights 1, by a change of the parameter: same poles, same domain, other inner knots.
///
/// # Errors
/// [`Error::Unsupported`] for a curve that does not end in its end poles (knots of full multiplicity at both ends are needed).
pub fn standard(curve: &Curve) -> Result<Curve, Error> {
    let (knots, p) = (curve.knots().values(), curve.degree());
    let (first, last) = curve.domain();
    let count = curve.poles().len();
    if knots[1] != first || knots[count + p - 1] != last {
        let text = "curve: its ends are not clamped, so that no pole has the weight of an end";
        return Err(Error::Unsupported(text.into()));
    }
    let Some(weights) = curve.weights() else { return Ok(curve.clone()) };
    let r = root(weights[0] / weights[count - 1], p);
    let old = |x: f64| (x - first) / (last - first);
    // From the nearer end, so that a knot near it keeps its digits.
    let place = |x: f64| {
        let t = old(x);
        if x <= first {
            0.0
        } else if x >= last {
            1.0
        } else {
            t / (t + r * (1.0 - t))
        }
    };
    let places: Vec<f64> = knots.iter().map(|x| place(*x)).collect();
    let denominator = |s: &f64| (1.0 - s) + r * s;
    let scaled = |i: usize| {
        let factors = places[i + 1..=i + p].iter().map(denominator);
        factors.fold(weights[i] / weights[0], |product, d| product * d)
    };
    let mut new_weights: Vec<f64> = (0..count).map(scaled).collect();
    (new_weights[0], new_weights[count - 1]) = (1.0, 1.0);
    let inside = |s: &f64| {
        if *s <= 0.0 {
            first
        } else if *s >= 1.0 {
            last
        } else {
            first + (last - first) * s
        }
    };
    let new_knots: Vec<f64> = places.iter().map(inside).collect();
    Curve::new(&new_knots, p, curve.poles(), Some(&new_weights))
}

/// The positive p-th root, by Newton's method from above.
fn root(x: f64, p: usize) -> f64 {
    let power = |y: f64| (1..p).fold(1.0, |product, _| product * y);
    // Powers of two near the root, then above it.
    let mut y = 1.0_f64;
    while power(y) * y < x {
        y *= 2.0;
    }
    while y > 0.0 && power(0.5 * y) * 0.5 * y >= x {
        y *= 0.5;
    }
    for _ in 0..100 {
        let next = y - (y - x / power(y)) / p as f64;
        if next >= y {
            break;
        }
        y = next;
    }
    y
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_root_is_one() {
        for (x, p) in [(8.0, 3), (2.0, 2), (1e-60, 5), (1e100, 31), (1.0, 7), (3.0, 1)] {
            let y = root(x, p);
            let power = (0..p).fold(1.0, |product, _| product * y);
            assert!((power / x - 1.0).abs() < 1e-14 * p as f64, "{x} {p}: {y}");
        }
    }

    #[test]
    fn a_bounded_spread_changes_the_ends_alike() {
        let out = bounded(&[1.0, 100.0, 10.0, 7.0], 4.0).unwrap();
        assert!((out[0] - 5.0).abs() < 1e-14 && (out[1] - 20.0).abs() < 1e-13);
        assert_eq!(out[2..], [10.0, 7.0]);
        assert!(out[1] <= 4.0 * out[0]);
        assert_eq!(bounded(&[1.0, 3.0], 4.0).unwrap(), [1.0, 3.0]);
        assert_eq!(bounded(&[1.0, 3.0], 1.0).unwrap()[0], bounded(&[1.0, 3.0], 1.0).unwrap()[1]);
    }

    #[test]
    fn a_unit_is_one() {
        assert_eq!(normalised(&[2.0, 8.0], Unit::First).unwrap(), [1.0, 4.0]);
        assert_eq!(normalised(&[2.0, 8.0], Unit::Greatest).unwrap(), [0.25, 1.0]);
        assert_eq!(normalised(&[2.0, 8.0], Unit::Middle).unwrap(), [0.5, 2.0]);
        let refused = |w: &[f64]| normalised(w, Unit::First).unwrap_err().to_string();
        assert_eq!(refused(&[1.0, -1.0]), "weights: weight 1 is not positive");
        assert_eq!(refused(&[]), "weights: there is none");
    }
}
