//! Random knots, curves and surfaces for property tests: repeats, wild steps, clamped or not, rational or not.

#![allow(dead_code, reason = "each test file uses its own part")]

use footpoint::curve::Curve;
use footpoint::knots::{Knots, MAX_DEGREE};
use footpoint::surface::Surface;
use proptest::prelude::*;

pub fn degrees() -> impl Strategy<Value = usize> {
    prop_oneof![8 => 1..=5usize, 2 => 6..=MAX_DEGREE]
}

/// A knot vector with repeats, wild steps and any start; sometimes clamped.
pub fn knots(degrees: impl Strategy<Value = usize>) -> impl Strategy<Value = Knots> {
    (degrees, 1..7usize).prop_flat_map(|(degree, extra)| {
        let count = 2 * degree + extra + 1;
        let step = prop_oneof![3 => Just(0.0), 5 => 0.01..1.0f64, 1 => Just(1e-7), 1 => Just(1e4)];
        let start = prop_oneof![Just(0.0), -1e3..1e3f64];
        (start, prop::collection::vec(step, count - 1), any::<bool>()).prop_filter_map(
            "a knot vector that would be refused",
            move |(start, steps, clamped)| {
                let mut values = vec![start];
                values.extend(steps.iter().scan(start, |u, step| {
                    *u += step;
                    Some(*u)
                }));
                if clamped {
                    let (first, last) = (values[degree], values[count - 1 - degree]);
                    values[..degree].fill(first);
                    values[count - degree..].fill(last);
                }
                Knots::new(&values, degree, count - degree - 1).ok()
            },
        )
    })
}

pub fn net_of(count: usize) -> impl Strategy<Value = (Vec<[f64; 3]>, Option<Vec<f64>>)> {
    let coordinate = || -10.0..10.0f64;
    let poles = prop::collection::vec((coordinate(), coordinate(), coordinate()), count);
    let poles = poles.prop_map(|poles| poles.into_iter().map(|(x, y, z)| [x, y, z]).collect());
    let weights = prop::collection::vec((-3.0..3.0f64).prop_map(|x| 10f64.powf(x)), count);
    (poles, prop::option::of(weights))
}

pub fn curves() -> impl Strategy<Value = Curve> {
    knots(degrees()).prop_flat_map(|knots| {
        net_of(knots.pole_count()).prop_map(move |(poles, weights)| {
            Curve::new(knots.values(), knots.degree(), &poles, weights.as_deref()).unwrap()
        })
    })
}

pub fn surfaces() -> impl Strategy<Value = Surface> {
    let small = || prop_oneof![9 => 1..=5usize, 1 => 6..12usize];
    (knots(small()), knots(small())).prop_flat_map(|(ku, kv)| {
        net_of(ku.pole_count() * kv.pole_count()).prop_map(move |(poles, weights)| {
            let (counts, weights) = ([ku.pole_count(), kv.pole_count()], weights.as_deref());
            let (p, q) = (ku.degree(), kv.degree());
            Surface::new(ku.values(), kv.values(), p, q, &poles, counts[0], counts[1], weights)
                .unwrap()
        })
    })
}

/// A parameter of the domain; the ends and the knots come up often.
pub fn parameter(knots: &Knots, share: f64) -> f64 {
    let (start, end) = knots.domain();
    match share {
        s if s < 0.05 => start,
        s if s > 0.95 => end,
        s if s > 0.7 => knots.values()[knots.span(start + s * (end - start))],
        s => (start + s / 0.7 * (end - start)).clamp(start, end),
    }
}
