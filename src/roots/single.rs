//! Zeros of one polynomial in one parameter.

use super::{Found, LEAST_WIDTH, Zero, push_root, spend};
use crate::bezier::{Bidegree, halve_t};
use crate::bounds::{HALF_ULP, extent};

/// Values below this many allowances are rounding: halving does not tell more about them.
const NOISE: f64 = 4.0;

struct Interval {
    low: f64,
    high: f64,
    error: f64,
}

/// Appends all zeros on [0, 1] of the polynomial with these coefficients to `out`.
///
/// `error` bounds how far the coefficients may be off. `is_flat(low, high, size, is_noise)` is asked whether values of at
/// most `size` on an interval are none (`is_noise`: rounding is as large as they are); then the interval is closed as a whole. Flat intervals that touch come out as one.
pub fn zeros_of(
    coefficients: &[f64],
    error: f64,
    is_flat: &dyn Fn(f64, f64, f64, bool) -> bool,
    budget: &mut u64,
    out: &mut Vec<Zero<1>>,
) {
    let (n, count) = (coefficients.len() - 1, coefficients.len());
    let growth = 2.0 * HALF_ULP * n as f64 * magnitude(coefficients);
    let first = out.len();
    let mut memory = coefficients.to_vec();
    let mut waiting = vec![Interval { low: 0.0, high: 1.0, error }];
    while let Some(interval) = waiting.pop() {
        let at = waiting.len() * count;
        let g = &memory[at..at + count];
        let (least, most) = extent(g);
        if least > interval.error || most < -interval.error {
            continue;
        }
        let (low, high, width) = (interval.low, interval.high, interval.high - interval.low);
        let size = least.abs().max(most.abs());
        if is_monotone(g, 2.0 * interval.error) {
            let (x, slope) = root(g);
            let radius = 4.0 * (interval.error / slope + 4.0 * HALF_ULP) * width + 4.0 * HALF_ULP;
            push_root(out, first, Zero::root([low + x * width], radius));
        } else if is_flat(low, high, size, size <= NOISE * interval.error) {
            push_flat(out, first, low, high);
        } else if width < LEAST_WIDTH || !spend(budget) {
            out.push(Zero::area(Found::Undecided, [low], [high]));
        } else {
            memory.resize(memory.len().max(at + 2 * count), 0.0);
            let (a, b) = memory[at..at + 2 * count].split_at_mut(count);
            halve_t(a, b, Bidegree { s: 0, t: n });
            // The right half is taken first, so that zeros come out from right to left.
            let (middle, error) = (0.5 * (low + high), interval.error + growth);
            waiting.push(Interval { low, high: middle, error });
            waiting.push(Interval { low: middle, high, error });
        }
    }
    out[first..].reverse();
}

fn magnitude(coefficients: &[f64]) -> f64 {
    let (low, high) = extent(coefficients);
    low.abs().max(high.abs())
}

/// Grows the last interval, which lies to the right, when it touches.
fn push_flat(out: &mut Vec<Zero<1>>, first: usize, low: f64, high: f64) {
    if let Some(last) = out[first..].last_mut()
        && last.found == Found::Flat
        && last.low[0] == high
    {
        *last = Zero::area(Found::Flat, [low], last.high);
        return;
    }
    out.push(Zero::area(Found::Flat, [low], [high]));
}

fn is_monotone(g: &[f64], allowance: f64) -> bool {
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    for pair in g.windows(2) {
        let d = pair[1] - pair[0];
        (low, high) = (low.min(d), high.max(d));
    }
    low > allowance || high < -allowance
}

/// The zero of a strictly monotone polynomial, moved into [0, 1], and the size of the slope there.
fn root(g: &[f64]) -> (f64, f64) {
    let rising = g[g.len() - 1] > g[0];
    let (mut low, mut high) = (0.0, 1.0);
    let share = (g[0] / (g[0] - g[g.len() - 1])).clamp(0.0, 1.0);
    let mut x = if share.is_finite() { share } else { 0.5 };
    let mut slope = 0.0;
    for _ in 0..100 {
        let (value, derivative) = value_and_slope(g, x);
        slope = derivative;
        if value == 0.0 {
            break;
        }
        if (value > 0.0) == rising {
            high = x
        } else {
            low = x
        }
        let newton = x - value / derivative;
        let inside = newton > low && newton < high;
        let next = if inside { newton } else { 0.5 * (low + high) };
        if (next - x).abs() <= 2.0 * HALF_ULP {
            x = next;
            break;
        }
        x = next;
    }
    (x, slope.abs().max(f64::MIN_POSITIVE))
}

fn value_and_slope(g: &[f64], x: f64) -> (f64, f64) {
    let n = g.len() - 1;
    let mut work = [0.0; crate::bezier::MAX_TRIPLE];
    let work = &mut work[..=n];
    work.copy_from_slice(g);
    let mut slope = 0.0;
    for level in (0..n).rev() {
        if level == 0 {
            slope = n as f64 * (work[1] - work[0]);
        }
        for k in 0..=level {
            work[k] = (1.0 - x) * work[k] + x * work[k + 1];
        }
    }
    (work[0], slope)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(g: &[f64]) -> Vec<Zero<1>> {
        let mut out = Vec::new();
        zeros_of(g, 1e-15, &|a, b, size, _| size * (b - a) < 1e-12, &mut 10_000, &mut out);
        out
    }

    #[test]
    fn simple_zeros_come_out_once_and_in_order() {
        // (x - 1/4)(x - 1/2)(x - 1): Bernstein coefficients by blossoming.
        let f = |a: f64, b: f64, c: f64| {
            let e = (a + b + c) / 3.0;
            let pair = (a * b + a * c + b * c) / 3.0;
            a * b * c - 1.75 * pair + 0.875 * e - 0.125
        };
        let g = [f(0., 0., 0.), f(0., 0., 1.), f(0., 1., 1.), f(1., 1., 1.)];
        let zeros = found(&g);
        assert_eq!(zeros.len(), 3, "{zeros:?}");
        for (zero, x) in zeros.iter().zip([0.25, 0.5, 1.0]) {
            assert_eq!(zero.found, Found::Root);
            assert!((zero.at[0] - x).abs() < 1e-14, "{zero:?}");
        }
    }

    #[test]
    fn a_zero_in_a_steep_middle_between_flat_ends_is_found() {
        // Newton from either end leaves the interval.
        let g = [-1.0, -0.9999, -0.9998, -0.9997, 0.9, 0.999, 0.9999, 1.0];
        let zeros = found(&g);
        assert_eq!(zeros.len(), 1, "{zeros:?}");
        let (value, _) = value_and_slope(&g, zeros[0].at[0]);
        assert!(value.abs() < 1e-15, "{value}");
    }

    #[test]
    fn a_polynomial_that_is_zero_is_one_flat_interval() {
        let zeros = found(&[0.0, 1e-16, -1e-16, 0.0]);
        assert_eq!(zeros.len(), 1);
        assert_eq!((zeros[0].found, zeros[0].low, zeros[0].high), (Found::Flat, [0.0], [1.0]));
    }

    #[test]
    fn a_double_zero_is_a_small_flat_interval_and_none_is_none() {
        // (x - 1/3)^2.
        let zeros = found(&[1.0 / 9.0, -2.0 / 9.0, 4.0 / 9.0]);
        assert_eq!(zeros.len(), 1, "{zeros:?}");
        assert_eq!(zeros[0].found, Found::Flat);
        assert!((zeros[0].at[0] - 1.0 / 3.0).abs() < 1e-3);
        assert!(found(&[1.0, 0.2, 1.0]).is_empty());
    }
}
