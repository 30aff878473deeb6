//! A local iteration that stops at no break: smooth cell by smooth cell.
//!
//! Seams and knot lines of full multiplicity divide the domain into cells. In one cell an iteration is safe; where it ends on
//! a side, it goes on in the cells that touch there, as long as one of them leads nearer.

use super::ground::Ground;
use crate::bounds::{Vector, norm, sub};
use crate::knots::Knots;

/// Most rounds over the cells that touch.
const ROUNDS: usize = 12;

/// A distance must fall by more than this share to go on.
const GAIN: f64 = 1e-14;

/// A place in a cell.
#[derive(Clone, Copy)]
struct Start {
    at: f64,
    cell: [f64; 2],
}

/// Whether the whole domain is one cell without seams.
pub fn is_plain(ground: &impl Ground) -> bool {
    let (ends, closed) = (ground.ends(), ground.closed());
    (0..2).all(|k| {
        let broken = ground.knots(k).is_some_and(|knots| {
            knots.spans().any(|span| {
                let end = knots.values()[span + 1];
                end < ends[k][1] && is_break(knots, end)
            })
        });
        !broken && !closed[k]
    })
}

fn is_break(knots: &Knots, x: f64) -> bool {
    knots.breaks_at(x)
}

/// The place that the iteration from `start` leads to, and its distance.
pub fn descend(ground: &impl Ground, query: Vector, start: [f64; 2]) -> ([f64; 2], f64) {
    let mut best = (start, norm(sub(ground.point(start), query)));
    for _ in 0..ROUNDS {
        let [u, v] = [0, 1].map(|k| starts(ground, k, best.0[k]));
        let mut found = best;
        for u in u.into_iter().flatten() {
            for v in v.into_iter().flatten() {
                let cell = [u.cell[0], u.cell[1], v.cell[0], v.cell[1]];
                let (at, distance) = ground.local_in(query, [u.at, v.at], cell);
                if distance < found.1 {
                    found = (at, distance);
                }
            }
        }
        let done = found.1.is_nan() || found.1 >= best.1 * (1.0 - GAIN);
        best = if found.1 < best.1 { found } else { best };
        if done {
            break;
        }
    }
    best
}

/// The cells that touch at `x`, one or two.
fn starts(ground: &impl Ground, k: usize, x: f64) -> [Option<Start>; 2] {
    let [low, high] = ground.ends()[k];
    let Some(knots) = ground.knots(k) else {
        return [Some(Start { at: x, cell: [low, high] }), None];
    };
    let below = |x: f64| Start { at: x, cell: [break_below(knots, x, low), x] };
    let above = |x: f64| Start { at: x, cell: [x, break_above(knots, x, high)] };
    if x == low || x == high {
        let closed = ground.closed()[k];
        return if closed {
            [Some(below(high)), Some(above(low))]
        } else if x == low {
            [Some(above(low)), None]
        } else {
            [Some(below(high)), None]
        };
    }
    if is_break(knots, x) {
        return [Some(below(x)), Some(above(x))];
    }
    let cell = [break_below(knots, x, low), break_above(knots, x, high)];
    [Some(Start { at: x, cell }), None]
}

/// The last break before `x`.
fn break_below(knots: &Knots, x: f64, low: f64) -> f64 {
    let values = knots.values();
    let before = &values[..values.partition_point(|&knot| knot < x)];
    let found = before.iter().rev().find(|&&knot| knot <= low || is_break(knots, knot));
    found.map_or(low, |knot| knot.max(low))
}

/// The first break after `x`.
fn break_above(knots: &Knots, x: f64, high: f64) -> f64 {
    let values = knots.values();
    let after = &values[values.partition_point(|&knot| knot <= x)..];
    let found = after.iter().find(|&&knot| knot >= high || is_break(knots, knot));
    found.map_or(high, |knot| knot.min(high))
}
