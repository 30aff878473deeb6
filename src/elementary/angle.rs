//! Cosine and sine as a spline of the angle itself: Taylor polynomials of degree 9 about the middles of short pieces.
//!
//! NURBS circles are exact points at other parameters than the angle. Where two curves are compared at equal parameters the angle must
//! stay what it is; this spline misses the circle by less than doubles can tell. On a piece of half width `a <= pi / 32`
//!
//! ```text
//!   |cos(m + x) - (cos m C(x) - sin m S(x))| <= a^10 / 10! + a^11 / 11! < 3e-17        C to x^8, S to x^9
//! ```
//!
//! Every polynomial is written in Bernstein form from powers of x / a, whose coefficients fall as fast as the terms do.

use std::f64::consts::PI;

use super::{check_vector, invalid, quadrant_exact};
use crate::bounds::Vector;
use crate::curve::Curve;
use crate::error::Error;

/// Degree of the pieces.
pub(crate) const DEGREE: usize = 9;

/// Widest piece.
const WIDEST: f64 = PI / 16.0;

/// How far cosine and sine of the spline may be off: the remainder, the rounding of its poles and of their sums.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// Cosines and sines: poles and clamped knots over the angles from `start` to `end`, each piece of full multiplicity.
pub(crate) fn spline([start, end]: [f64; 2]) -> (Vec<[f64; 2]>, Vec<f64>) {
    let count = ((end - start) / WIDEST).ceil().max(1.0) as usize;
    let at =
        |k: usize| if k == count { end } else { start + (end - start) * (k as f64 / count as f64) };
    let powers = bernstein_powers();
    let mut poles = vec![quadrant_exact(start)];
    let mut knots = vec![start; DEGREE + 1];
    for k in 0..count {
        let (from, to) = (at(k), at(k + 1));
        let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
        let [c, s] = quadrant_exact(middle);
        // The terms of both series at x = half.
        let mut terms = [1.0; DEGREE + 1];
        for n in 1..=DEGREE {
            terms[n] = terms[n - 1] * half / n as f64;
        }
        for j in 1..=DEGREE {
            // Even powers to x^8, odd ones to x^9; the last term first, which is the least.
            let sum = |first: usize| -> f64 {
                let orders = (first..DEGREE + 1).step_by(2).rev();
                let sign = |n: usize| if (n / 2).is_multiple_of(2) { 1.0 } else { -1.0 };
                orders.map(|n| sign(n) * terms[n] * powers[n][j]).sum()
            };
            let (even, odd) = (sum(0), sum(1));
            poles.push([c * even - s * odd, s * even + c * odd]);
        }
        let last = poles.len() - 1;
        poles[last] = quadrant_exact(to);
        knots.extend([to; DEGREE]);
    }
    knots.push(end);
    (poles, knots)
}

/// How far the cosine and the sine of the spline over some angles may be from those of an angle.
pub(crate) fn error([start, end]: [f64; 2]) -> f64 {
    ROUNDING * (1.0 + start.abs().max(end.abs()))
}

/// The arc `center + cos t first + sin t second` for t from `angles[0]` to `angles[1]`, at most a full turn, as a polynomial spline of t: off
/// by some roundings. A full turn ends at the point of its start.
///
/// # Errors
/// Numbers that are not finite; angles that do not increase or span more than a turn; both half diameters 0.
pub fn arc_by_angle(
    center: Vector,
    first: Vector,
    second: Vector,
    angles: [f64; 2],
) -> Result<Curve, Error> {
    for (name, vector) in [("center", center), ("first", first), ("second", second)] {
        check_vector(name, vector)?;
    }
    check_vector("angles", [angles[0], angles[1], 0.0])?;
    if angles[0] >= angles[1] {
        return invalid("angles: entry 0 is not less than entry 1".into());
    }
    if angles[1] - angles[0] > 2.0 * PI * (1.0 + 1e-12) {
        return invalid("angles: more than a full turn".into());
    }
    if first == [0.0; 3] && second == [0.0; 3] {
        return invalid("first: both half diameters are 0".into());
    }
    let (places, knots) = spline(angles);
    let pole = |&[c, s]: &[f64; 2]| [0, 1, 2].map(|k| center[k] + c * first[k] + s * second[k]);
    let mut poles: Vec<Vector> = places.iter().map(pole).collect();
    let last = poles.len() - 1;
    if (angles[1] - angles[0] - 2.0 * PI).abs() <= 1e-14 * angles[1].abs().max(1.0) {
        poles[last] = poles[0];
    }
    Curve::new(&knots, DEGREE, &poles, None)
}

/// Bernstein coefficients on [0, 1] of the powers of `y = 2 t - 1`: `powers[n][j]` of `y^n`.
fn bernstein_powers() -> [[f64; DEGREE + 1]; DEGREE + 1] {
    let binomial = |n: usize, k: usize| -> f64 {
        (0..k).fold(1.0, |product, i| product * (n - i) as f64 / (i + 1) as f64).round()
    };
    let mut powers = [[0.0; DEGREE + 1]; DEGREE + 1];
    for (n, row) in powers.iter_mut().enumerate() {
        for (j, entry) in row.iter_mut().enumerate() {
            // y^n = (t - (1 - t))^n (t + (1 - t))^(D - n)
            let terms = (0..=n.min(j)).filter(|i| j - i <= DEGREE - n).map(|i| {
                let sign = if (n - i) % 2 == 0 { 1.0 } else { -1.0 };
                sign * binomial(n, i) * binomial(DEGREE - n, j - i)
            });
            *entry = terms.sum::<f64>() / binomial(DEGREE, j);
        }
    }
    powers
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    #[test]
    fn an_arc_by_its_angle_is_closed_after_a_turn_and_refuses_what_is_none() {
        let arc = |angles| arc_by_angle([1.0, 2.0, 3.0], [2.0, 0.0, 0.0], [0.0, 0.0, 1.0], angles);
        let whole = arc([0.4, 0.4 + TAU]).unwrap();
        assert_eq!(whole.evaluate(0.4), whole.evaluate(0.4 + TAU));
        let [x, y, z] = whole.evaluate(2.0);
        let off = (x - 1.0 - 2.0 * 2f64.cos()).hypot(z - 3.0 - 2f64.sin());
        assert!(off < 4e-15 && y == 2.0, "{off:e}");
        let text = |angles| arc(angles).unwrap_err().to_string();
        assert_eq!(text([1.0, 1.0]), "angles: entry 0 is not less than entry 1");
        assert_eq!(text([0.0, 7.0]), "angles: more than a full turn");
        assert!(text([0.0, f64::NAN]).starts_with("angles: entry 1 is not finite"));
    }

    #[test]
    fn the_spline_is_the_circle_at_equal_angles_to_rounding() {
        for range in [[0.0, TAU], [-0.3, 0.9], [2.0, 2.05], [-40.0, -35.0], [0.5, 0.5 + PI]] {
            let (poles, knots) = spline(range);
            let poles: Vec<[f64; 3]> = poles.iter().map(|[c, s]| [*c, *s, 0.0]).collect();
            let curve = Curve::new(&knots, DEGREE, &poles, None).unwrap();
            let mut most: f64 = 0.0;
            for k in 0..=20_000 {
                let t = (range[0] + (range[1] - range[0]) * f64::from(k) / 20_000.0).min(range[1]);
                let ([x, y, _], [c, s]) = (curve.evaluate(t), quadrant_exact(t));
                most = most.max((x - c).abs()).max((y - s).abs());
            }
            assert!(most <= error(range), "{range:?} {most:e} {:e}", error(range));
            // The grain of the angle itself moves points as well.
            let grain = 0.5 * f64::EPSILON * range[0].abs().max(range[1].abs());
            assert!(most <= 2e-15 + grain, "{range:?} {most:e}");
            assert_eq!(poles[0][..2], quadrant_exact(range[0]));
            assert_eq!(poles[poles.len() - 1][..2], quadrant_exact(range[1]));
        }
    }
}
