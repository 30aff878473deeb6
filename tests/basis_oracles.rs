//! The basis functions against three definitions that share nothing with the code, and the uniform cubic in closed form.
//!
//! ```text
//!   de Boor, Cox       N_{i,p} from N_{i,p-1} and N_{i+1,p-1}, top down
//!   Curry, Schoenberg  (t_{i+p+1} - t_i) [t_i .. t_{i+p+1}] (t - u)_+^p, divided differences of truncated powers
//!   Clark              the box convolved with itself p times (uniform knots): repeated means of moving windows, exact on polynomials
//! ```
//!
//! References: de Boor, *A Practical Guide to Splines*, chapters IX, X; Schoenberg, *Contributions to the problem of approximation*, 1946.

#[path = "../benches/stress/double.rs"]
mod double;
mod strategies;

use double::Double;
use footpoint::basis;
use footpoint::knots::Knots;
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use strategies::{knots, parameter};

/// The value of basis function `i` from the code.
fn value(knots: &Knots, i: usize, u: f64) -> f64 {
    let (span, p) = (knots.span(u), knots.degree());
    let mut row = vec![0.0; p + 1];
    basis::values(knots, span, u, &mut row);
    i.checked_sub(span - p).and_then(|j| row.get(j)).copied().unwrap_or(0.0)
}

/// The recurrence of de Boor and Cox, top down, 0/0 = 0.
fn cox(t: &[f64], i: usize, p: usize, span: usize, u: f64) -> Double {
    if p == 0 {
        return Double::of(if i == span { 1.0 } else { 0.0 });
    }
    if i > span || i + p < span {
        return Double::ZERO;
    }
    let part = |number: Double, low: f64, high: f64, lower: Double| {
        if low == high { Double::ZERO } else { number.times(lower).over(Double::sum(high, -low)) }
    };
    let rising = part(Double::sum(u, -t[i]), t[i], t[i + p], cox(t, i, p - 1, span, u));
    let falling =
        part(Double::sum(t[i + p + 1], -u), t[i + 1], t[i + p + 1], cox(t, i + 1, p - 1, span, u));
    rising.plus(falling)
}

/// The derivative of order `k` of `(t - u)_+^p` by t, over k!.
fn truncated_power(t: f64, u: f64, p: usize, k: usize) -> Double {
    if t <= u {
        return Double::ZERO;
    }
    let difference = Double::sum(t, -u);
    let mut out = Double::of(1.0);
    for _ in 0..p - k {
        out = out.times(difference);
    }
    for j in 0..k {
        out = out.times(Double::of((p - j) as f64)).over(Double::of((j + 1) as f64));
    }
    out
}

/// The divided difference of `(t - u)_+^p` at the knots, confluent where they are repeated.
fn divided_difference(t: &[f64], u: f64, p: usize) -> Double {
    let count = t.len();
    let mut column: Vec<Double> = t.iter().map(|&x| truncated_power(x, u, p, 0)).collect();
    for order in 1..count {
        for i in 0..count - order {
            let (low, high) = (t[i], t[i + order]);
            column[i] = if low == high {
                truncated_power(low, u, p, order)
            } else {
                column[i + 1].minus(column[i]).over(Double::sum(high, -low))
            };
        }
    }
    column[0]
}

fn config() -> ProptestConfig {
    ProptestConfig {
        failure_persistence: None,
        rng_seed: RngSeed::Fixed(0x666f_6f74),
        ..ProptestConfig::with_cases(300)
    }
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn the_recurrence_of_de_boor_and_cox_gives_the_basis(
        knots in knots(1..=7usize), share in 0.0..1.0f64,
    ) {
        let u = parameter(&knots, share);
        for i in 0..knots.pole_count() {
            let exact = cox(knots.values(), i, knots.degree(), knots.span(u), u).value();
            let found = value(&knots, i, u);
            // Relative: the code never subtracts but knots.
            prop_assert!((found - exact).abs() <= 1e-14 * exact.abs(), "{found} {exact}");
        }
    }

    #[test]
    fn divided_differences_of_truncated_powers_give_the_basis(
        knots in knots(1..=5usize), share in 0.0..1.0f64,
    ) {
        let (p, t) = (knots.degree(), knots.values());
        let (_, end) = knots.domain();
        let u = parameter(&knots, share);
        // The truncated power is right-sided in u; the domain's end is left-sided. Where u is a knot the p-th derivative is one-sided too.
        prop_assume!(u < end && knots.multiplicity(u) == 0);
        let steps = t.windows(2).map(|w| w[1] - w[0]).filter(|step| *step > 0.0);
        let shortest = steps.fold(f64::INFINITY, f64::min);
        for i in 0..knots.pole_count() {
            let local = &t[i..=i + p + 1];
            let length = local[p + 1] - local[0];
            let exact = divided_difference(local, u, p).times(Double::of(length)).value();
            // Differences of powers lose digits where steps are unlike, in doubled precision too.
            let allowed = 1e-14 + 1e-30 * (length / shortest).powi(p as i32 + 1);
            prop_assume!(allowed < 1e-10);
            prop_assert!((value(&knots, i, u) - exact).abs() <= allowed, "{} {exact}", value(&knots, i, u));
        }
    }
}

/// Piecewise polynomials on [k, k + 1) for k = 0 .., coefficients in powers of u - k.
type Pieces = Vec<Vec<f64>>;

/// `u -> integral of f over [u - 1, u]`: the convolution with the unit box.
fn smoothed(f: &Pieces) -> Pieces {
    let integral = |piece: &[f64]| -> Vec<f64> {
        let mut out = vec![0.0];
        out.extend(piece.iter().enumerate().map(|(k, a)| a / (k + 1) as f64));
        out
    };
    let none = vec![0.0; f[0].len()];
    let at = |k: usize| f.get(k).unwrap_or(&none);
    (0..=f.len())
        .map(|k| {
            // On [k, k + 1): all of this piece to u, and the piece before from u - 1 on.
            let mut out = integral(at(k));
            if k > 0 {
                let before = integral(at(k - 1));
                let whole: f64 = before.iter().sum();
                out.iter_mut().zip(&before).for_each(|(a, b)| *a -= b);
                out[0] += whole;
            }
            out
        })
        .collect()
}

#[test]
fn repeated_convolution_of_the_box_gives_the_uniform_basis() {
    let mut pieces: Pieces = vec![vec![1.0]];
    for p in 1..=8 {
        pieces = smoothed(&pieces);
        assert_eq!(pieces.len(), p + 1);
        // Enough knots that function p is whole inside the domain.
        let t: Vec<f64> = (0..4 * p + 2).map(|k| k as f64).collect();
        let knots = Knots::new(&t, p, 3 * p + 1).unwrap();
        for step in 0..(p + 1) * 16 {
            let x = step as f64 / 16.0;
            let piece = &pieces[x as usize];
            let exact = piece.iter().rev().fold(0.0, |sum, a| sum * (x - x.floor()) + a);
            let found = value(&knots, p, p as f64 + x);
            assert!((found - exact).abs() < 1e-13, "degree {p} at {x}: {found} {exact}");
        }
    }
}

#[test]
fn the_uniform_cubic_has_its_closed_form() {
    let t: Vec<f64> = (0..12).map(|k| 0.5 * k as f64).collect();
    let knots = Knots::new(&t, 3, 8).unwrap();
    for step in 0..=64 {
        let x = step as f64 / 64.0;
        let u = 2.0 + 0.5 * x;
        let mut row = [0.0; 12];
        let span = if step == 64 { 4 } else { knots.span(u) };
        basis::derivatives(&knots, span, u, 2, &mut row);
        let exact = [
            [
                (1.0 - x).powi(3),
                3.0 * x.powi(3) - 6.0 * x * x + 4.0,
                -3.0 * x.powi(3) + 3.0 * x * x + 3.0 * x + 1.0,
                x.powi(3),
            ]
            .map(|n| n / 6.0),
            [-(1.0 - x).powi(2), 3.0 * x * x - 4.0 * x, -3.0 * x * x + 2.0 * x + 1.0, x * x],
            [1.0 - x, 3.0 * x - 2.0, -3.0 * x + 1.0, x].map(|n| n * 4.0),
        ];
        for (found, exact) in row.iter().zip(exact.as_flattened()) {
            assert!((found - exact).abs() < 1e-15 * 8.0, "{x}: {found} {exact}");
        }
    }
}
