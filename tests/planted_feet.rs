//! Planted feet: a query set off from a place of the shape, along a normal there and by less than the reach, has
//! that place as its foot.
//!
//! ```text
//!   P on the shape, S0 the place, n the direction, q = S0 + h n:
//!   |P - q| > h   <=>   h < |P - S0|^2 / (2 (P - S0).n)        (Federer's reach at S0 in direction n)
//! ```
//!
//! The reach is taken over a dense sample with a ring of close neighbours (there the bound is the radius of
//! curvature), and only a third of it is used. Away from the place every sample must be farther than h by more than
//! the steps to its neighbours, so that what lies between samples does not matter.

mod shapes;

use footpoint::closest::{FootPoint, QueryOptions, flag};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use shapes::asked::{Shape, apart};
use shapes::{FAMILIES, Random, Vector, along, cross, dot, norm, sub};

fn config() -> ProptestConfig {
    ProptestConfig {
        failure_persistence: None,
        rng_seed: RngSeed::Fixed(0x706c_616e),
        max_shrink_iters: 0,
        max_global_rejects: 100_000,
        ..ProptestConfig::with_cases(150)
    }
}

/// Families without spikes, where a dense sample sees everything.
fn smooth() -> impl Strategy<Value = usize> {
    (0..FAMILIES.len()).prop_filter("no spikes, no tiny spans", |k| {
        let family = FAMILIES[*k];
        family.weights <= 1.0 && !["zero spans", "wild knots"].contains(&family.name)
    })
}

/// First derivatives; of a curve the second one is zero.
fn tangents(shape: &Shape, [u, v]: [f64; 2]) -> [Vector; 2] {
    match shape {
        Shape::Curve(curve) => {
            let mut out = [[0.0; 3]; 2];
            curve.curve().derivatives(u, 1, &mut out);
            [out[1], [0.0; 3]]
        }
        Shape::Surface(surface) => {
            let mut out = [[0.0; 3]; 3];
            surface.surface().partials(u, v, 1, &mut out);
            [out[1], out[2]]
        }
    }
}

/// How far a query may go from `at` along the unit vector `n`, by the samples and a ring around `at`.
fn reach(shape: &Shape, at: [f64; 2], n: Vector) -> f64 {
    let (start, [u0, u1, v0, v1]) = (shape.evaluate(at), shape.domain());
    let ring = (0..60).map(|k| {
        let (step, angle) = (0.1 * 0.5f64.powi(k / 12), f64::from(k % 12) * 0.524);
        let u = (at[0] + step * angle.cos() * (u1 - u0)).clamp(u0, u1);
        [u, (at[1] + step * angle.sin() * (v1 - v0)).clamp(v0, v1)]
    });
    let limit = |place: [f64; 2]| {
        let chord = sub(shape.evaluate(place), start);
        let (square, height) = (dot(chord, chord), dot(chord, n));
        if height <= 0.0 { f64::INFINITY } else { square / (2.0 * height) }
    };
    let all = shape.samples_of(if matches!(shape, Shape::Curve(_)) { 120 } else { 30 });
    all.into_iter()
        .chain(ring)
        .filter(|place| *place != at)
        .map(limit)
        .fold(f64::INFINITY, f64::min)
}

/// Whether every sample away from `at` is farther from `query` than `h` by more than it is from its neighbours.
fn is_alone(shape: &Shape, at: [f64; 2], query: Vector, h: f64) -> bool {
    let (places, [u0, u1, v0, v1]) = (shape.samples_of(40), shape.domain());
    let row = places.iter().take_while(|place| place[0] == places[0][0]).count();
    let points: Vec<Vector> = places.iter().map(|place| shape.evaluate(*place)).collect();
    let step = |k: usize, next: usize| points.get(next).map_or(0.0, |p| apart(*p, points[k]));
    (0..places.len()).all(|k| {
        let [u, v] = places[k];
        let is_near = (u - at[0]).abs() < 0.1 * (u1 - u0) && (v - at[1]).abs() <= 0.1 * (v1 - v0);
        let across = if (k + 1) % row == 0 { 0.0 } else { step(k, k + 1) };
        is_near || apart(query, points[k]) > h + step(k, k + row) + across
    })
}

/// A place of the shape, a unit vector normal to it there, and a safe distance along it. `at_end` says which
/// parameters shall be ends of the domain.
fn plant(shape: &Shape, at_end: [bool; 2], r: &mut Random) -> Option<([f64; 2], Vector, f64)> {
    let domain = shape.domain();
    let mut inward = [0.0; 2];
    let at = [0, 1].map(|k| {
        let (a, b) = (domain[2 * k], domain[2 * k + 1]);
        match (at_end[k], r.unit() < 0.5) {
            (false, _) => r.between(a + 0.02 * (b - a), b - 0.02 * (b - a)),
            (true, true) => (inward[k] = 1.0, a).1,
            (true, false) => (inward[k] = -1.0, b).1,
        }
    });
    let n = normal(tangents(shape, at), inward, r)?;
    let (reach, diagonal) = (reach(shape, at, n), shape.diagonal());
    let h = r.unit() * (reach / 3.0).min(3.0 * diagonal);
    let query = along(shape.evaluate(at), n, h);
    (reach > 0.03 * diagonal && is_alone(shape, at, query, h)).then_some((at, n, h))
}

/// A unit vector along which nothing gets nearer to first order: normal to the tangents, and at an end away from the
/// inside. `None` where the tangents are no good.
fn normal(tangents: [Vector; 2], inward: [f64; 2], r: &mut Random) -> Option<Vector> {
    let [su, sv] = tangents;
    let (length, width) = (norm(su), norm(sv));
    let is_curve = width == 0.0;
    if length == 0.0 || (!is_curve && norm(cross(su, sv)) < 0.1 * length * width) {
        return None;
    }
    let mut n = r.direction();
    if !is_curve && inward == [0.0; 2] {
        n = cross(su, sv);
    } else {
        // Take out the tangents along which the foot is free; the others must lead away.
        for (k, t) in [su, sv].into_iter().enumerate().filter(|(k, _)| *k == 0 || !is_curve) {
            if inward[k] == 0.0 {
                n = along(n, t, -dot(n, t) / dot(t, t));
            }
        }
        let leads_away = |k: usize, t: Vector| {
            inward[k] == 0.0 || inward[k] * dot(n, t) < -0.2 * norm(n) * norm(t)
        };
        if !leads_away(0, su) || !(is_curve || leads_away(1, sv)) {
            return None;
        }
    }
    let size = norm(n);
    (size > 0.0).then(|| n.map(|x| x / size))
}

/// The answer is the planted foot, proven.
fn is_planted(
    shape: &Shape,
    at: [f64; 2],
    query: Vector,
    h: f64,
) -> Result<FootPoint, TestCaseError> {
    let foot = shape.ask(query, None, &QueryOptions::default());
    let limit = 20.0 * shape.rounding(query, h) + 2.0 * shape.grain(&foot);
    prop_assert!(foot.flags & flag::NOT_PROVEN == 0, "{at:?} {query:?} {h:e} {foot:?}");
    prop_assert!((foot.distance - h).abs() <= limit, "{at:?} {query:?} {h:e} {foot:?}");
    prop_assert!(apart(foot.point, shape.evaluate(at)) <= limit, "{at:?} {query:?} {h:e} {foot:?}");
    let speeds = tangents(shape, at).map(norm);
    for (k, x) in [foot.u, foot.v].into_iter().enumerate() {
        let off = (x - at[k]).abs() * speeds[k];
        prop_assert!(off <= 20.0 * limit, "parameter {k}: {at:?} {query:?} {h:e} {foot:?}");
    }
    Ok(foot)
}

/// Closed directions have two ends for one place; borders are planted on the others.
fn is_closed(shape: &Shape) -> [bool; 2] {
    match shape {
        Shape::Curve(curve) => [curve.curve().is_closed(), false],
        Shape::Surface(surface) => {
            [surface.surface().is_closed_u(), surface.surface().is_closed_v()]
        }
    }
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn a_query_on_the_normal_within_the_reach_gives_back_its_parameters(
        family in smooth(), seed in any::<u64>(),
    ) {
        let (shape, r) = (Shape::new(family, seed), &mut Random(!seed));
        let planted: Vec<_> = (0..4).filter_map(|_| plant(&shape, [false; 2], r)).collect();
        prop_assume!(!planted.is_empty());
        for (at, n, h) in planted {
            let query = along(shape.evaluate(at), n, h);
            let foot = is_planted(&shape, at, query, h)?;
            prop_assert_eq!(foot.flags & (flag::EDGE | flag::CORNER), 0);
        }
    }

    #[test]
    fn a_query_outside_a_border_within_the_reach_has_its_foot_on_the_border(
        family in smooth(), seed in any::<u64>(), in_v in any::<bool>(),
    ) {
        let (shape, r) = (Shape::new(family, seed), &mut Random(!seed));
        let in_v = in_v && matches!(shape, Shape::Surface(_));
        prop_assume!(!is_closed(&shape)[usize::from(in_v)]);
        let planted: Vec<_> = (0..12).filter_map(|_| plant(&shape, [!in_v, in_v], r)).collect();
        prop_assume!(!planted.is_empty());
        for (at, n, h) in planted {
            let query = along(shape.evaluate(at), n, h);
            let foot = is_planted(&shape, at, query, h)?;
            prop_assert!(h < 1e-9 * shape.diagonal() || foot.flags & flag::EDGE != 0, "{at:?} {foot:?}");
        }
    }

    #[test]
    fn a_query_beyond_a_corner_within_the_reach_has_its_foot_in_the_corner(
        family in smooth(), seed in any::<u64>(),
    ) {
        let (shape, r) = (Shape::new(family, seed | 1), &mut Random(!seed));
        prop_assume!(is_closed(&shape) == [false; 2]);
        let planted: Vec<_> = (0..30).filter_map(|_| plant(&shape, [true; 2], r)).collect();
        prop_assume!(!planted.is_empty());
        for (at, n, h) in planted {
            let query = along(shape.evaluate(at), n, h);
            let foot = is_planted(&shape, at, query, h)?;
            prop_assert!(h < 1e-9 * shape.diagonal() || foot.flags & flag::CORNER != 0, "{at:?} {foot:?}");
        }
    }

    #[test]
    fn a_point_of_the_shape_is_inverted_to_rounding(family in 0..FAMILIES.len(), seed in any::<u64>()) {
        prop_assume!(FAMILIES[family].weights <= 1.0);
        let (shape, r) = (Shape::new(family, seed), &mut Random(!seed));
        for _ in 0..6 {
            let at = shape.place(r);
            let query = shape.evaluate(at);
            let foot = shape.ask(query, None, &QueryOptions::default());
            let limit = 10.0 * shape.rounding(query, 0.0) + 2.0 * shape.grain(&foot);
            prop_assert!(foot.distance <= limit, "{at:?} {foot:?}");
        }
    }
}
