//! Curves and surfaces given by functions, against closed forms.

use footpoint::callback::{CallbackCurve, CallbackSurface, CurveBounds, SurfaceBounds};
use footpoint::closest::{FootPoint, QueryOptions, flag};
use footpoint::set::{FootSet, Kind, Nature};
use std::f64::consts::{PI, TAU};

type Vector = [f64; 3];

/// Radii of the torus: of its axis and of its tube.
const RADII: [f64; 2] = [3.0, 1.25];

/// The torus about the z axis, the offset by a quarter of the one with tube radius 1; `orders` are delivered.
fn torus(orders: usize, bounds: SurfaceBounds) -> CallbackSurface {
    let [big, small] = RADII;
    let function = move |u: f64, v: f64, order: usize, out: &mut [Vector; 6]| {
        let ((su, cu), (sv, cv)) = (u.sin_cos(), v.sin_cos());
        let (w, wv) = (big + small * cv, -small * sv);
        out[0] = [w * cu, w * su, small * sv];
        if order.min(orders) >= 1 {
            out[1] = [-w * su, w * cu, 0.0];
            out[2] = [wv * cu, wv * su, small * cv];
        }
        if order.min(orders) >= 2 {
            out[3] = [-w * cu, -w * su, 0.0];
            out[4] = [-wv * su, wv * cu, 0.0];
            out[5] = [-small * cv * cu, -small * cv * su, -small * sv];
        }
        Some(orders)
    };
    CallbackSurface::new([0.0, TAU, 0.0, TAU], bounds, function).unwrap()
}

fn torus_bounds() -> SurfaceBounds {
    let [big, small] = RADII;
    SurfaceBounds { speed: Some([big + small, small]), second: Some([big + small, small, small]) }
}

fn torus_distance(q: Vector) -> f64 {
    let [big, small] = RADII;
    (((q[0] * q[0] + q[1] * q[1]).sqrt() - big).hypot(q[2]) - small).abs()
}

/// Numbers in [0, 1) of a fixed sequence.
fn random(state: &mut u64) -> f64 {
    *state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    (*state >> 11) as f64 / 9_007_199_254_740_992.0
}

fn points(count: usize, size: f64) -> Vec<Vector> {
    let mut state = 77;
    (0..count).map(|_| [(); 3].map(|()| size * (2.0 * random(&mut state) - 1.0))).collect()
}

/// No bound above the truth, no distance below it.
fn check_sound(foot: &FootPoint, truth: f64) {
    assert!(foot.distance >= truth - 1e-12, "{foot:?} against {truth}");
    assert!(foot.lower_bound <= truth + 1e-12, "{foot:?} against {truth}");
}

fn print_set(set: &FootSet) {
    for m in &set.members {
        println!(
            "  {:?} {:?} u {:?} v {:?} d {} flags {}",
            m.kind, m.nature, m.u, m.v, m.foot.distance, m.foot.flags
        );
    }
    println!(
        "  undecided {:?} evals {:?}",
        set.undecided,
        set.members.first().map(|m| m.foot.iterations)
    );
}

#[test]
fn explore() {
    let options = QueryOptions::default();
    for (name, orders, bounds) in [
        ("second, 1 order", 1, torus_bounds()),
        ("second only", 2, SurfaceBounds { speed: None, ..torus_bounds() }),
        ("second, points", 0, torus_bounds()),
        ("speed", 2, SurfaceBounds { second: None, ..torus_bounds() }),
        ("none", 2, SurfaceBounds::default()),
        ("none, points", 0, SurfaceBounds::default()),
    ] {
        let shape = torus(orders, bounds);
        let queries = points(200, 5.0);
        let start = std::time::Instant::now();
        let (mut evals, mut unproven, mut wrong, mut gap) = (0u64, 0, 0, 0.0f64);
        for q in &queries {
            let foot = shape.closest(*q, None, &options, None);
            check_sound(&foot, torus_distance(*q));
            evals += u64::from(foot.iterations);
            unproven += usize::from(foot.flags & flag::NOT_PROVEN != 0);
            wrong += usize::from(foot.distance > torus_distance(*q) + 1e-9);
            gap = gap.max(foot.distance - foot.lower_bound);
        }
        println!(
            "{name}: {:?} per query, {} evaluations, {unproven} not proven, {wrong} wrong, gap {gap:e}",
            start.elapsed() / 200,
            evals / 200
        );
        let start = std::time::Instant::now();
        let (mut evals, mut unproven) = (0u64, 0);
        for q in &queries {
            let p = shape.evaluate((q[0] + 5.0) * 0.6, (q[1] + 5.0) * 0.6).unwrap();
            let foot = shape.invert(p, None, &options, None);
            evals += u64::from(foot.iterations);
            unproven += usize::from(foot.flags & flag::NOT_PROVEN != 0);
        }
        println!(
            "   on it: {:?} per query, {} evaluations, {unproven} not proven",
            start.elapsed() / 200,
            evals / 200
        );
        let p = shape.evaluate(1.0, 2.0).unwrap();
        let start = std::time::Instant::now();
        let set = shape.preimage(p, 0.0, &options);
        println!("preimage {:?}", start.elapsed());
        print_set(&set);
        let start = std::time::Instant::now();
        let set = shape.extrema([4.0, 1.0, 2.0], &options);
        println!("extrema {:?}", start.elapsed());
        print_set(&set);
    }
}
