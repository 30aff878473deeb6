//! Where the extremes of a curvature are thought to be: samples, the best of them led uphill.
//!
//! Nothing is proven here. Good places make the search short: boxes are compared with the best value that is known.

use super::request::{Quantity, Side};
use super::search::Start;
use super::umbilic::curvatures;
use crate::index::Span;
use crate::knots;
use crate::surface::Surface;

/// Samples that are led uphill for each extreme.
const CLIMBS: usize = 3;

/// Least step of a climb in a piece's parameters.
const LEAST_STEP: f64 = 1e-5;

/// Pieces at most that are sampled.
const MOST_PIECES: usize = 1_000;

/// Samples a direction and piece.
fn density(pieces: usize) -> usize {
    match pieces {
        0..=16 => 5,
        17..=100 => 3,
        101..=400 => 2,
        _ => 1,
    }
}

/// Places where the greatest and the least value may be, as boxes without extent.
pub(super) fn places(
    surface: &Surface,
    spans: &dyn Fn(usize) -> [Span; 2],
    starts: &[Start],
    quantity: Quantity,
    side: Side,
) -> Vec<Start> {
    let value = |k: usize, at: [f64; 2]| {
        let [u, v] = spans(k);
        let one = |x: f64| if x > 0.5 { knots::Side::Below } else { knots::Side::Above };
        let found = curvatures(surface, [u.global(at[0]), v.global(at[1])], at.map(one))?;
        let [greater, less] = found.principal;
        Some(match quantity {
            Quantity::Greater => greater,
            Quantity::Less => less,
            Quantity::Mean => found.mean,
            Quantity::Gaussian => found.gaussian,
            Quantity::Sharpest => greater.abs().max(less.abs()),
        })
    };
    let count = density(starts.len());
    let mut samples: Vec<(f64, usize, [f64; 2])> = Vec::with_capacity(starts.len());
    // The best two samples of each piece: the least and the greatest.
    let stride = starts.len().div_ceil(MOST_PIECES).max(1);
    for (n, &(k, s, t)) in starts.iter().enumerate().step_by(stride) {
        for i in 0..count {
            for j in 0..count {
                let on = |[a, b]: [f64; 2], i: usize| a + (b - a) * (i as f64 + 0.5) / count as f64;
                let at = [on(s, i), on(t, j)];
                if let Some(x) = value(k, at).filter(|x| x.is_finite()) {
                    samples.push((x, n, at));
                }
            }
        }
    }
    let mut found = Vec::new();
    for sign in [1.0, -1.0] {
        if (sign > 0.0 && side == Side::Least) || (sign < 0.0 && side == Side::Greatest) {
            continue;
        }
        samples.sort_by(|a, b| (sign * b.0).total_cmp(&(sign * a.0)));
        let mut taken: Vec<usize> = Vec::new();
        for &(x, n, at) in &samples {
            if taken.len() == CLIMBS {
                break;
            }
            if taken.contains(&n) {
                continue;
            }
            taken.push(n);
            let (k, s, t) = starts[n];
            let at = climbed(&|at| value(k, at).map(|x| sign * x), [s, t], at, sign * x);
            found.push((k, [at[0]; 2], [at[1]; 2]));
        }
    }
    found
}

/// The best of the eight neighbours, again and again, with shorter steps when none is better.
fn climbed(
    value: &dyn Fn([f64; 2]) -> Option<f64>,
    [s, t]: [[f64; 2]; 2],
    start: [f64; 2],
    height: f64,
) -> [f64; 2] {
    let (mut at, mut best, mut step) = (start, height, 0.125);
    let widths = [s[1] - s[0], t[1] - t[0]];
    let mut moves = 0;
    while step > LEAST_STEP && moves < 200 {
        moves += 1;
        let mut next = at;
        for i in [-1.0, 0.0, 1.0] {
            for j in [-1.0, 0.0, 1.0] {
                let place = [
                    (at[0] + i * step * widths[0]).clamp(s[0], s[1]),
                    (at[1] + j * step * widths[1]).clamp(t[0], t[1]),
                ];
                if place == at {
                    continue;
                }
                if let Some(x) = value(place).filter(|x| *x > best) {
                    (best, next) = (x, place);
                }
            }
        }
        if next == at {
            step *= 0.25;
        } else {
            at = next;
        }
    }
    at
}
