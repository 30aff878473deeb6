//! B-spline basis functions and their derivatives on one span.
//!
//! On the span `[u_i, u_{i+1})` exactly `p + 1` basis functions of degree `p` are not zero,
//! `N_{i-p} .. N_i`. They grow out of the constant 1 in a triangle, one degree a row:
//!
//! ```text
//!   degree 0                 1
//!   degree 1             N0      N1            a row is made in place from the row above it
//!   degree 2         N0      N1      N2
//! ```
//!
//! The derivative of order `k` starts at the row of degree `p - k` and climbs to degree `p` by
//! `N' = p (N_left / (u_{i+p} - u_i) - N_right / (u_{i+p+1} - u_{i+1}))`, `k` times.
//!
//! Reference: Piegl, Tiller, *The NURBS Book*, 2nd ed., algorithm A2.2 and equation (2.7).
//! Limit: a derivative that leaves the range of doubles (spans shorter than 1e-150) is not finite.

use crate::knots::Knots;
use crate::simd::Lanes;

/// Knot differences are stretched by this power of two before they divide, so that the reciprocal of
/// the least positive double is finite. It drops out again without rounding.
const STRETCH: f64 = 18_446_744_073_709_551_616.0;

/// Writes the `degree + 1` basis functions that are not zero on `span`, at `u`, to `out`.
///
/// The values are not negative and sum to 1 up to rounding; at a knot of multiplicity >= degree one
/// of them is the only one that is not zero.
pub fn values(knots: &Knots, span: usize, u: f64, out: &mut [f64]) {
    let degree = knots.degree();
    let around = &knots.values()[span + 1 - degree..span + 1 + degree];
    match degree {
        1 => grow::<1>(around, u, out),
        2 => grow::<2>(around, u, out),
        3 => grow::<3>(around, u, out),
        4 => grow::<4>(around, u, out),
        5 => grow::<5>(around, u, out),
        _ => values_around(around, degree, u, out),
    }
}

/// The same for knots `u_{i+1-p} .. u_{i+p}` and a parameter lane by lane, bit for bit.
#[inline(always)]
pub fn values_around<V: Lanes<N>, const N: usize>(
    around: &[V],
    degree: usize,
    u: V,
    out: &mut [V],
) {
    out[0] = V::splat(1.0);
    for grown in 1..=degree {
        raise(around, degree, grown, u, out);
    }
}

/// The whole triangle for a degree that the compiler knows: the same steps without loops.
#[inline(always)]
fn grow<const DEGREE: usize>(around: &[f64], u: f64, out: &mut [f64]) {
    let (around, out) = (&around[..2 * DEGREE], &mut out[..DEGREE + 1]);
    out[0] = 1.0;
    for grown in 1..=DEGREE {
        raise(around, DEGREE, grown, u, out);
    }
}

/// Writes the basis functions and their derivatives to order `count`, at `u`, to `out`.
///
/// The derivative of order `k` of function `j` goes to `out[k * (degree + 1) + j]`; row 0 has the
/// same bits as [`values`]. Rows above the degree are zero.
pub fn derivatives(knots: &Knots, span: usize, u: f64, count: usize, out: &mut [f64]) {
    let degree = knots.degree();
    let around = &knots.values()[span + 1 - degree..span + 1 + degree];
    let width = degree + 1;
    let (row, higher) = out[..(count + 1) * width].split_at_mut(width);
    row[0] = 1.0;
    for grown in 0..=degree {
        if grown > 0 {
            raise(around, degree, grown, u, row);
        }
        let order = degree - grown;
        if (1..=count).contains(&order) {
            higher[(order - 1) * width..][..=grown].copy_from_slice(&row[..=grown]);
        }
    }
    for (index, row) in higher.chunks_exact_mut(width).enumerate() {
        let order = index + 1;
        if order > degree {
            row.fill(0.0);
            continue;
        }
        for grown in degree - order + 1..=degree {
            differentiate(around, degree, grown, row);
        }
    }
}

/// Replaces the row of degree `grown - 1` by the row of degree `grown`. `around` holds the knots
/// `u_{i+1-p} .. u_{i+p}`, so that `u_{i+1+r}` is `around[p + r]`.
#[inline(always)]
fn raise<V: Lanes<N>, const N: usize>(
    around: &[V],
    degree: usize,
    grown: usize,
    u: V,
    row: &mut [V],
) {
    let ends = &around[degree..degree + grown];
    let starts = &around[degree - grown..degree];
    let mut saved = V::splat(0.0);
    for ((value, end), start) in row.iter_mut().zip(ends).zip(starts) {
        let right = (*end - u) * V::splat(STRETCH);
        let left = (u - *start) * V::splat(STRETCH);
        let share = *value / (right + left);
        *value = saved + right * share;
        saved = left * share;
    }
    row[grown] = saved;
}

/// Replaces the row of degree `grown - 1` by the derivatives of the row of degree `grown`.
#[inline]
fn differentiate(around: &[f64], degree: usize, grown: usize, row: &mut [f64]) {
    let ends = &around[degree..degree + grown];
    let starts = &around[degree - grown..degree];
    let mut saved = 0.0;
    for ((value, end), start) in row.iter_mut().zip(ends).zip(starts) {
        let slope = grown as f64 * *value / (end - start);
        *value = saved - slope;
        saved = slope;
    }
    row[grown] = saved;
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_cubic_bernstein_polynomials_and_their_derivatives_come_out() {
        let knots = Knots::new(&[0., 0., 0., 0., 1., 1., 1., 1.], 3, 4).unwrap();
        let mut out = [f64::NAN; 20];
        derivatives(&knots, 3, 0.5, 4, &mut out);
        let expected = [
            [0.125, 0.375, 0.375, 0.125],
            [-0.75, -0.75, 0.75, 0.75],
            [3.0, -3.0, -3.0, 3.0],
            [-6.0, 18.0, -18.0, 6.0],
            [0.0; 4],
        ];
        assert_eq!(out.as_slice(), expected.as_flattened());
    }

    #[test]
    fn knots_at_both_ends_of_the_range_of_doubles_give_finite_values() {
        for step in [5e-324, 1e-310, 1e99] {
            let knots = Knots::new(&[-step, 0., 0., step, step, 2.0 * step], 2, 3).unwrap();
            for u in [0.0, step * 0.5, step] {
                let mut out = [0.0; 3];
                values(&knots, knots.span(u), u, &mut out);
                assert!((out.iter().sum::<f64>() - 1.0).abs() < 1e-15, "{step}: {out:?}");
            }
        }
    }
}
