//! What does not change a shape does not change its answers: insertion, splitting, reversal, other domains, motions,
//! scalings. Scaling by a power of two changes not a bit.

mod shapes;

use footpoint::closest::{FootPoint, QueryOptions, Scope, flag};
use footpoint::curve::Curve;
use footpoint::index::{IndexedCurve, IndexedSurface};
use footpoint::knots::Knots;
use footpoint::surface::Surface;
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use shapes::asked::{Shape, apart, bits};
use shapes::{FAMILIES, Family, Knotting, Random, Vector, dot};

fn config() -> ProptestConfig {
    ProptestConfig {
        failure_persistence: None,
        rng_seed: RngSeed::Fixed(0x6d61_7070),
        max_shrink_iters: 0,
        ..ProptestConfig::with_cases(400)
    }
}

/// Families of size 1 near the origin.
fn moderate() -> impl Strategy<Value = usize> {
    (0..FAMILIES.len()).prop_filter("size 1", |&k| {
        let family: &Family = &FAMILIES[k];
        family.sizes == 0.0 && family.offset == 0.0
    })
}

/// The shape with knots and poles mapped.
fn mapped(shape: &Shape, knot: impl Fn(f64) -> f64, pole: impl Fn(Vector) -> Vector) -> Shape {
    let knots = |knots: &Knots| knots.values().iter().map(|u| knot(*u)).collect::<Vec<_>>();
    let poles = |poles: &[Vector]| poles.iter().map(|p| pole(*p)).collect::<Vec<_>>();
    match shape {
        Shape::Curve(curve) => {
            let curve = curve.curve();
            let (knots, poles) = (knots(curve.knots()), poles(curve.poles()));
            let curve = Curve::new(&knots, curve.degree(), &poles, curve.weights());
            Shape::Curve(IndexedCurve::new(curve.expect("a curve")))
        }
        Shape::Surface(surface) => {
            let surface = surface.surface();
            let (ku, kv) = (surface.knots_u(), surface.knots_v());
            let ([u, v], poles) = ([knots(ku), knots(kv)], poles(surface.poles()));
            let (p, q) = (ku.degree(), kv.degree());
            let (nu, nv) = (ku.pole_count(), kv.pole_count());
            let surface = Surface::new(&u, &v, p, q, &poles, nu, nv, surface.weights());
            Shape::Surface(IndexedSurface::new(surface.expect("a surface")))
        }
    }
}

/// The shape run through backwards in u.
fn reversed(shape: &Shape) -> Shape {
    let backwards = |knots: &Knots| {
        let (first, last) = knots.domain();
        knots.values().iter().rev().map(|u| first + (last - u)).collect::<Vec<_>>()
    };
    match shape {
        Shape::Curve(curve) => {
            let curve = curve.curve();
            let poles: Vec<Vector> = curve.poles().iter().rev().copied().collect();
            let weights = curve.weights().map(|w| w.iter().rev().copied().collect::<Vec<_>>());
            let knots = backwards(curve.knots());
            let curve = Curve::new(&knots, curve.degree(), &poles, weights.as_deref());
            Shape::Curve(IndexedCurve::new(curve.expect("a curve")))
        }
        Shape::Surface(surface) => {
            let surface = surface.surface();
            let (ku, kv) = (surface.knots_u(), surface.knots_v());
            let (nu, nv) = (ku.pole_count(), kv.pole_count());
            let order = || (0..nu).rev().flat_map(|i| (0..nv).map(move |j| i * nv + j));
            let poles: Vec<Vector> = order().map(|k| surface.poles()[k]).collect();
            let weights = surface.weights().map(|w| order().map(|k| w[k]).collect::<Vec<_>>());
            let (u, v, weights) = (backwards(ku), kv.values(), weights.as_deref());
            let made = Surface::new(&u, v, ku.degree(), kv.degree(), &poles, nu, nv, weights);
            Shape::Surface(IndexedSurface::new(made.expect("a surface")))
        }
    }
}

/// A rotation about a random axis and a shift.
fn motion(r: &mut Random, shift: f64) -> impl Fn(Vector) -> Vector + use<> {
    let (axis, angle) = (r.direction(), r.between(-3.0, 3.0));
    let shift = r.direction().map(|x| x * shift);
    let (sine, cosine) = angle.sin_cos();
    move |p| {
        let turned = shapes::cross(axis, p);
        let height = dot(axis, p) * (1.0 - cosine);
        [0, 1, 2].map(|k| cosine * p[k] + sine * turned[k] + height * axis[k] + shift[k])
    }
}

/// Both proven: the same distance; and the place found on the other shape is as near on this one.
fn same(
    shape: &Shape,
    query: Vector,
    foot: &FootPoint,
    other: &FootPoint,
    place: [f64; 2],
) -> Result<(), TestCaseError> {
    let proven = |foot: &FootPoint| foot.flags & flag::NOT_PROVEN == 0;
    if proven(foot) && proven(other) {
        let gap = shape.gap(query, foot.distance) + shape.grain(foot);
        prop_assert!((foot.distance - other.distance).abs() <= gap, "{foot:?} {other:?}");
        let [u0, u1, v0, v1] = shape.domain();
        let there = shape.evaluate([place[0].clamp(u0, u1), place[1].clamp(v0, v1)]);
        prop_assert!(apart(query, there) <= foot.distance + gap, "{place:?} {foot:?} {other:?}");
    }
    Ok(())
}

/// Families whose knots may be rounded without a visible change of the shape.
fn with_even_knots() -> impl Strategy<Value = usize> {
    (0..FAMILIES.len()).prop_filter("knots of even steps, no spikes", |k| {
        let Family { knotting, weights, .. } = FAMILIES[*k];
        weights <= 3.0
            && !matches!(knotting, Knotting::Wild | Knotting::ZeroSpans | Knotting::Narrow)
    })
}

fn ask(shape: &Shape, query: Vector) -> FootPoint {
    shape.ask(query, None, &QueryOptions::default())
}

/// Pieces of the shape that fill it, from cutting it at `at`, together with it after insertion there.
fn cut(shape: &Shape, at: [f64; 2], in_v: bool) -> Option<(Shape, [Shape; 2])> {
    let curve = |curve: Curve| Shape::Curve(IndexedCurve::new(curve));
    let surface = |surface: Surface| Shape::Surface(IndexedSurface::new(surface));
    match shape {
        Shape::Curve(shape) => {
            let shape = shape.curve();
            let (a, b) = shape.split(at[0]).ok()?;
            let times = shape.degree().saturating_sub(shape.knots().multiplicity(at[0]));
            Some((curve(shape.insert_knot(at[0], times.min(2)).ok()?), [curve(a), curve(b)]))
        }
        Shape::Surface(shape) => {
            let shape = shape.surface();
            let k = usize::from(in_v);
            let (a, b) = if in_v { shape.split_v(at[k]) } else { shape.split_u(at[k]) }.ok()?;
            let knots = if in_v { shape.knots_v() } else { shape.knots_u() };
            let times = knots.degree().saturating_sub(knots.multiplicity(at[k])).min(2);
            let finer = if in_v {
                shape.insert_knot_v(at[k], times)
            } else {
                shape.insert_knot_u(at[k], times)
            };
            Some((surface(finer.ok()?), [surface(a), surface(b)]))
        }
    }
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn scaling_space_by_a_power_of_two_changes_no_bit(
        family in 0..FAMILIES.len(), seed in any::<u64>(), power in -60..60i32,
    ) {
        let (shape, r) = (Shape::new(family, seed), &mut Random(!seed));
        let factor = 2f64.powi(power);
        let scale = |p: Vector| p.map(|x| x * factor);
        let scaled = mapped(&shape, |u| u, scale);
        for _ in 0..3 {
            let query = shape.query(r);
            let (foot, mut other) = (ask(&shape, query), ask(&scaled, scale(query)));
            other.point = other.point.map(|x| x / factor);
            other.distance /= factor;
            other.lower_bound /= factor;
            prop_assert_eq!(bits(&foot), bits(&other), "{:?} {:?}", foot, other);
        }
    }

    /// As far as coordinates (1e100) and the squares of distances (1e-150 and more) allow.
    #[test]
    fn scaling_from_2_to_the_minus_300_to_2_to_the_300_changes_no_bit(
        family in moderate(), seed in any::<u64>(), power in -300..=300i32, local in any::<bool>(),
    ) {
        let (shape, r) = (Shape::new(family, seed), &mut Random(!seed));
        let factor = 2f64.powi(power);
        let scale = |p: Vector| p.map(|x| x * factor);
        let scaled = mapped(&shape, |u| u, scale);
        let scope = if local { Scope::Local } else { Scope::Global };
        let options = QueryOptions { scope, ..QueryOptions::default() };
        for _ in 0..3 {
            let (query, hint) = (shape.query(r), local.then(|| shape.place(r)));
            let foot = shape.ask(query, hint, &options);
            let mut other = scaled.ask(scale(query), hint, &options);
            other.point = other.point.map(|x| x / factor);
            other.distance /= factor;
            other.lower_bound /= factor;
            prop_assert_eq!(bits(&foot), bits(&other), "{:?} {:?}", foot, other);
        }
    }

    #[test]
    fn scaling_the_domain_by_a_power_of_two_changes_no_bit(
        family in 0..FAMILIES.len(), seed in any::<u64>(), power in -60..60i32,
    ) {
        let (shape, r) = (Shape::new(family, seed), &mut Random(!seed));
        let factor = 2f64.powi(power);
        let scaled = mapped(&shape, |u| u * factor, |p| p);
        for _ in 0..3 {
            let query = shape.query(r);
            let (foot, mut other) = (ask(&shape, query), ask(&scaled, query));
            (other.u, other.v) = (other.u / factor, other.v / factor);
            prop_assert_eq!(bits(&foot), bits(&other), "{:?} {:?}", foot, other);
        }
    }

    #[test]
    fn another_domain_leaves_the_answer(
        family in with_even_knots(), seed in any::<u64>(), scale in 0.01..100.0f64, shift in -10.0..10.0f64,
    ) {
        let (shape, r) = (Shape::new(family, seed), &mut Random(!seed));
        let [u0, u1, v0, v1] = shape.domain();
        let shift = shift * (u1 - u0).min(if v1 > v0 { v1 - v0 } else { u1 - u0 });
        let other = mapped(&shape, |u| scale * (u + shift), |p| p);
        for _ in 0..3 {
            let query = shape.query(r);
            let (foot, moved) = (ask(&shape, query), ask(&other, query));
            let place = [moved.u / scale - shift, moved.v / scale - shift];
            same(&shape, query, &foot, &moved, place)?;
        }
    }

    #[test]
    fn running_through_it_backwards_leaves_the_answer(family in with_even_knots(), seed in any::<u64>()) {
        let (shape, r) = (Shape::new(family, seed), &mut Random(!seed));
        let (other, [u0, u1, ..]) = (reversed(&shape), shape.domain());
        for _ in 0..3 {
            let query = shape.query(r);
            let (foot, back) = (ask(&shape, query), ask(&other, query));
            same(&shape, query, &foot, &back, [u0 + (u1 - back.u), back.v])?;
        }
    }

    #[test]
    fn a_rigid_motion_of_shape_and_query_leaves_the_answer(
        family in 0..FAMILIES.len(), seed in any::<u64>(),
    ) {
        let (shape, r) = (Shape::new(family, seed), &mut Random(!seed));
        let shift = shape.diagonal() * r.between(0.0, 3.0);
        let motion = motion(r, shift);
        let other = mapped(&shape, |u| u, &motion);
        for _ in 0..3 {
            let query = shape.query(r);
            let (foot, moved) = (ask(&shape, query), ask(&other, motion(query)));
            same(&shape, query, &foot, &moved, [moved.u, moved.v])?;
        }
    }

    #[test]
    fn inserting_knots_leaves_the_answer_and_the_nearer_of_two_parts_has_it(
        family in with_even_knots(), seed in any::<u64>(), in_v in any::<bool>(),
    ) {
        let (shape, r) = (Shape::new(family, seed), &mut Random(!seed));
        let Some((finer, [left, right])) = cut(&shape, shape.place(r), in_v) else { return Ok(()) };
        for _ in 0..3 {
            let query = shape.query(r);
            let (foot, other) = (ask(&shape, query), ask(&finer, query));
            same(&shape, query, &foot, &other, [other.u, other.v])?;
            let parts = [ask(&left, query), ask(&right, query)];
            let nearer = parts[usize::from(parts[1].distance < parts[0].distance)];
            same(&shape, query, &foot, &nearer, [nearer.u, nearer.v])?;
        }
    }
}
