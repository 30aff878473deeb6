//! Differences of Bernstein coefficients in two directions: signs of derivatives over a whole area at once.
//!
//! A derivative is a convex combination of the differences of the coefficients, times the degree; so least and greatest
//! difference bound it. Plain loops without branches, which compilers turn into vector minima; the values are finite.

use crate::bezier::Bidegree;

/// Least and greatest first difference along s and along t.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slopes {
    /// Along s.
    pub s: (f64, f64),
    /// Along t.
    pub t: (f64, f64),
}

const NOTHING: (f64, f64) = (f64::INFINITY, f64::NEG_INFINITY);

impl Slopes {
    /// Of no coefficients at all.
    pub const NONE: Self = Self { s: NOTHING, t: NOTHING };

    /// Takes in the differences of one coefficient array.
    pub fn include(&mut self, h: &[f64], degree: Bidegree) {
        let width = degree.t + 1;
        self.s = merged(self.s, differences(h, width));
        for row in h.chunks_exact(width) {
            self.t = merged(self.t, differences(row, 1));
        }
    }
}

fn merged(a: (f64, f64), b: (f64, f64)) -> (f64, f64) {
    (a.0.min(b.0), a.1.max(b.1))
}

/// Least and greatest of `h[k + step] - h[k]`.
fn differences(h: &[f64], step: usize) -> (f64, f64) {
    let (mut low, mut high) = NOTHING;
    for (a, b) in h.iter().zip(&h[step..]) {
        let d = b - a;
        low = if d < low { d } else { low };
        high = if d > high { d } else { high };
    }
    (low, high)
}

/// Lower bounds `a`, `c` of the two pure second derivatives and an upper bound `b` of the mixed one, in unit
/// parameters, when `a c > b^2`: then the polynomial is convex. Every second difference may be off by `allowance`.
pub fn convexity(h: &[f64], degree: Bidegree, allowance: f64) -> Option<[f64; 3]> {
    let (n, m) = (degree.s as f64, degree.t as f64);
    let width = degree.t + 1;
    let a = n * (n - 1.0) * (least_second_s(h, width) - allowance);
    if a.is_nan() || a <= 0.0 {
        return None;
    }
    let c = m * (m - 1.0) * (least_second_t(h, width) - allowance);
    if c.is_nan() || c <= 0.0 {
        return None;
    }
    let b = n * m * (greatest_mixed(h, width) + allowance);
    // The determinant must keep enough digits for the first-order bound that divides by it.
    (a * c * (1.0 - 1e-5) > b * b).then_some([a, b, c])
}

fn least_second_s(h: &[f64], width: usize) -> f64 {
    let mut least = f64::INFINITY;
    for ((x, y), z) in h.iter().zip(&h[width..]).zip(&h[2 * width..]) {
        let d = (z - y) - (y - x);
        least = if d < least { d } else { least };
    }
    least
}

fn least_second_t(h: &[f64], width: usize) -> f64 {
    let mut least = f64::INFINITY;
    for row in h.chunks_exact(width) {
        for w in row.windows(3) {
            let d = (w[2] - w[1]) - (w[1] - w[0]);
            least = if d < least { d } else { least };
        }
    }
    least
}

fn greatest_mixed(h: &[f64], width: usize) -> f64 {
    let mut greatest = 0.0;
    for (low, high) in h.chunks_exact(width).zip(h[width..].chunks_exact(width)) {
        for (x, y) in low.windows(2).zip(high.windows(2)) {
            let d = ((y[1] - y[0]) - (x[1] - x[0])).abs();
            greatest = if d > greatest { d } else { greatest };
        }
    }
    greatest
}

#[cfg(test)]
mod tests {
    use super::*;

    const BIQUADRATIC: Bidegree = Bidegree { s: 2, t: 2 };

    #[test]
    fn a_bowl_is_convex_and_a_saddle_is_not() {
        // s^2 + t^2 and s^2 - t^2, Bernstein coefficients of degree 2.
        let bowl = [0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 1.0, 1.0, 2.0];
        let saddle = [0.0, 0.0, -1.0, 0.0, 0.0, -1.0, 1.0, 1.0, 0.0];
        assert_eq!(convexity(&bowl, BIQUADRATIC, 0.0), Some([2.0, 0.0, 2.0]));
        assert_eq!(convexity(&saddle, BIQUADRATIC, 0.0), None);
        assert_eq!(convexity(&bowl, BIQUADRATIC, 1.0), None);
    }

    #[test]
    fn a_twisted_sheet_with_two_minima_is_not_convex() {
        // |(s, t, 4 s t)|^2 around the query (0.5, 0.5, -1): the mixed difference decides.
        let mixed = [0.5, 0.0, 0.5, 0.0, 2.0, 0.0, 0.5, 0.0, 0.5];
        assert_eq!(convexity(&mixed, BIQUADRATIC, 0.0), None);
    }

    #[test]
    fn slopes_see_both_directions() {
        let mut slopes = Slopes::NONE;
        slopes.include(&[0.0, 1.0, 3.0, 1.0, 2.0, 4.0, 2.0, 3.0, 5.0], BIQUADRATIC);
        assert_eq!(slopes, Slopes { s: (1.0, 1.0), t: (1.0, 2.0) });
    }
}
