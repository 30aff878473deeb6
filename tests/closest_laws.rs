//! Laws of the nearest point, on random shapes of every difficult family.
//!
//! Every property takes a family and a seed; the proptest seed is fixed, so a run is the same everywhere, and a
//! failure names the family and the seed that make the shape again.

mod shapes;

use std::sync::Mutex;

use footpoint::batch;
use footpoint::closest::{FootPoint, QueryOptions, Workspace, flag};
use footpoint::index::{IndexedCurve, IndexedSurface};
use footpoint::refine::Method;
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use shapes::{EPS, FAMILIES, Random, Vector, norm, sub};

/// The shape under test with what the laws need of it.
enum Shape {
    Curve(IndexedCurve),
    Surface(IndexedSurface),
}

impl Shape {
    fn new(family: usize, seed: u64) -> Self {
        let family = &FAMILIES[family];
        if seed % 2 == 0 {
            Self::Curve(IndexedCurve::new(shapes::curve(family, seed)))
        } else {
            Self::Surface(IndexedSurface::new(shapes::surface(family, seed)))
        }
    }

    fn evaluate(&self, [u, v]: [f64; 2]) -> Vector {
        match self {
            Self::Curve(curve) => curve.curve().evaluate(u),
            Self::Surface(surface) => surface.surface().evaluate(u, v),
        }
    }

    /// u0, u1, v0, v1; curves: v is 0.
    fn domain(&self) -> [f64; 4] {
        match self {
            Self::Curve(curve) => {
                let (u0, u1) = curve.curve().domain();
                [u0, u1, 0.0, 0.0]
            }
            Self::Surface(surface) => surface.surface().domain(),
        }
    }

    fn bounding_box(&self) -> (Vector, Vector) {
        match self {
            Self::Curve(curve) => curve.curve().bounding_box(),
            Self::Surface(surface) => surface.surface().bounding_box(),
        }
    }

    fn diagonal(&self) -> f64 {
        shapes::extent(self.bounding_box()).0
    }

    fn degrees(&self) -> usize {
        match self {
            Self::Curve(curve) => curve.curve().degree(),
            Self::Surface(surface) => {
                surface.surface().knots_u().degree() + surface.surface().knots_v().degree()
            }
        }
    }

    /// A grid over the spans, all knots in it.
    fn samples(&self) -> Vec<[f64; 2]> {
        match self {
            Self::Curve(curve) => {
                shapes::samples(curve.curve().knots(), 40).into_iter().map(|u| [u, 0.0]).collect()
            }
            Self::Surface(surface) => {
                let vs = shapes::samples(surface.surface().knots_v(), 12);
                let us = shapes::samples(surface.surface().knots_u(), 12);
                us.into_iter().flat_map(|u| vs.iter().map(move |v| [u, *v])).collect()
            }
        }
    }

    fn ask(&self, query: Vector, hint: Option<[f64; 2]>, options: &QueryOptions) -> FootPoint {
        self.ask_with(query, hint, options, &mut Workspace::default())
    }

    fn ask_with(
        &self,
        query: Vector,
        hint: Option<[f64; 2]>,
        options: &QueryOptions,
        workspace: &mut Workspace,
    ) -> FootPoint {
        match self {
            Self::Curve(curve) => {
                curve.closest(query, hint.map(|h| h[0]), options, workspace, None)
            }
            Self::Surface(surface) => surface.closest(query, hint, options, workspace, None),
        }
    }

    /// A parameter pair anywhere; often an end.
    fn place(&self, r: &mut Random) -> [f64; 2] {
        let [u0, u1, v0, v1] = self.domain();
        let mut pick = |a: f64, b: f64| match r.whole(0, 9) {
            0 => a,
            1 => b,
            _ => r.between(a, b).clamp(a, b),
        };
        [pick(u0, u1), pick(v0, v1)]
    }

    fn query(&self, r: &mut Random) -> Vector {
        let on = self.evaluate(self.place(r));
        shapes::query(self.bounding_box(), on, r)
    }

    /// What evaluation and the norm may be off by.
    fn rounding(&self, query: Vector, distance: f64) -> f64 {
        let (diagonal, magnitude) = shapes::extent(self.bounding_box());
        let largest = query.iter().fold(magnitude, |m, x| m.max(x.abs()));
        EPS * ((self.degrees() + 4) as f64 * diagonal + 4.0 * (largest + distance))
    }

    /// What two certified answers may differ by.
    fn gap(&self, query: Vector, distance: f64) -> f64 {
        1e-10 * self.diagonal() + 100.0 * self.rounding(query, distance)
    }
}

fn apart(query: Vector, point: Vector) -> f64 {
    norm(sub(query, point))
}

fn config(cases: u32) -> ProptestConfig {
    ProptestConfig {
        failure_persistence: None,
        rng_seed: RngSeed::Fixed(0x666f_6f74),
        max_shrink_iters: 0,
        ..ProptestConfig::with_cases(cases)
    }
}

fn bits(foot: &FootPoint) -> [u64; 9] {
    let [x, y, z] = foot.point.map(f64::to_bits);
    let [u, v] = [foot.u, foot.v].map(f64::to_bits);
    let [distance, bound] = [foot.distance, foot.lower_bound].map(f64::to_bits);
    [u, v, x, y, z, distance, bound, foot.flags.into(), foot.iterations.into()]
}

/// Not proven and all answers of each family, for the report of the first law.
static SHARES: Mutex<[[usize; 4]; FAMILIES.len()]> = Mutex::new([[0; 4]; FAMILIES.len()]);

fn count(family: usize, shape: &Shape, foot: &FootPoint) {
    let mut shares = SHARES.lock().expect("the counts");
    let base = if matches!(shape, Shape::Curve(_)) { 0 } else { 2 };
    shares[family][base] += usize::from(foot.flags & flag::NOT_PROVEN != 0);
    shares[family][base + 1] += 1;
}

/// The bound is below every sample, the foot is the nearest up to the limit of the cases, and within the asked-for
/// accuracy when it is proven.
fn least_of_samples(
    shape: &Shape,
    query: Vector,
    foot: &FootPoint,
    samples: &[[f64; 2]],
) -> Result<(), TestCaseError> {
    let slack = shape.rounding(query, foot.distance);
    let proven = foot.flags & flag::NOT_PROVEN == 0;
    let accuracy = if proven { shape.gap(query, foot.distance) } else { 1e-9 * shape.diagonal() };
    for at in samples {
        let there = apart(query, shape.evaluate(*at));
        prop_assert!(
            foot.lower_bound <= there + slack,
            "{at:?} is at {there:e}: {query:?} {foot:?}"
        );
        prop_assert!(
            foot.distance <= there + slack + accuracy,
            "{at:?} {there:e}: {query:?} {foot:?}"
        );
    }
    Ok(())
}

/// Nothing around the foot is nearer: it is polished, not only proven.
fn least_of_neighbours(
    shape: &Shape,
    query: Vector,
    foot: &FootPoint,
) -> Result<(), TestCaseError> {
    let slack = shape.rounding(query, foot.distance);
    let [u0, u1, v0, v1] = shape.domain();
    for k in 0..64 {
        let (step, angle) = (1e-3 * 0.3f64.powi(k / 4), f64::from(k % 4) * 1.6 + 0.3);
        let u = (foot.u + step * angle.cos() * (u1 - u0)).clamp(u0, u1);
        let at = [u, (foot.v + step * angle.sin() * (v1 - v0)).clamp(v0, v1)];
        let there = apart(query, shape.evaluate(at));
        prop_assert!(foot.distance <= there + slack, "{at:?} is at {there:e}: {query:?} {foot:?}");
    }
    Ok(())
}

proptest! {
    #![proptest_config(config(800))]

    #[test]
    fn no_sample_is_nearer_than_the_bound_nor_nearer_than_the_foot(
        family in 0..FAMILIES.len(), seed in any::<u64>(),
    ) {
        let (shape, r) = (Shape::new(family, seed), &mut Random(!seed));
        let samples = shape.samples();
        for _ in 0..6 {
            let query = shape.query(r);
            let foot = shape.ask(query, None, &QueryOptions::default());
            count(family, &shape, &foot);
            prop_assert_eq!(shape.evaluate([foot.u, foot.v]), foot.point);
            prop_assert!(foot.lower_bound <= foot.distance);
            least_of_samples(&shape, query, &foot, &samples)?;
            least_of_neighbours(&shape, query, &foot)?;
        }
    }

    #[test]
    fn a_hint_changes_neither_the_distance_nor_whether_it_is_proven(
        family in 0..FAMILIES.len(), seed in any::<u64>(),
    ) {
        let (shape, r) = (Shape::new(family, seed), &mut Random(!seed));
        let options = QueryOptions::default();
        for _ in 0..4 {
            let query = shape.query(r);
            let plain = shape.ask(query, None, &options);
            prop_assert_eq!(plain.flags & flag::HINT_USED, 0);
            for hint in [[plain.u, plain.v], shape.place(r), [f64::MAX, -f64::MAX]] {
                let hinted = shape.ask(query, Some(hint), &options);
                let gap = shape.gap(query, plain.distance);
                prop_assert!((hinted.distance - plain.distance).abs() <= gap, "{plain:?} {hinted:?}");
                let open = |foot: &FootPoint| foot.flags & flag::NOT_PROVEN;
                prop_assert_eq!(open(&hinted), open(&plain), "{:?} {:?} {:?}", hint, plain, hinted);
            }
        }
    }

    #[test]
    fn every_method_gives_the_same_certified_distance(
        family in 0..FAMILIES.len(), seed in any::<u64>(),
    ) {
        let (shape, r) = (Shape::new(family, seed), &mut Random(!seed));
        for _ in 0..3 {
            let query = shape.query(r);
            let ask = |method| shape.ask(query, None, &QueryOptions { method, ..QueryOptions::default() });
            let auto = ask(Method::Auto);
            for method in [Method::Maf, Method::Newton, Method::Osculating] {
                let foot = ask(method);
                let gap = shape.gap(query, auto.distance);
                prop_assert!((foot.distance - auto.distance).abs() <= gap, "{method:?}: {foot:?} {auto:?}");
                let open = |foot: &FootPoint| foot.flags & flag::NOT_PROVEN;
                prop_assert_eq!(open(&foot), open(&auto), "{:?}: {:?} {:?}", method, foot, auto);
            }
        }
    }

    #[test]
    fn an_answer_in_a_box_lies_in_it_and_is_the_least_of_it(
        family in 0..FAMILIES.len(), seed in any::<u64>(),
    ) {
        let (shape, r) = (Shape::new(family, seed), &mut Random(!seed));
        let ([a, b], [c, d]) = (shape.place(r), shape.place(r));
        prop_assume!(a != c && (b != d || matches!(shape, Shape::Curve(_))));
        let range = [a.min(c), a.max(c), b.min(d), b.max(d)];
        let inside = |at: &[f64; 2]| {
            (range[0]..=range[1]).contains(&at[0]) && (range[2]..=range[3]).contains(&at[1])
        };
        let mut samples: Vec<[f64; 2]> = shape.samples().into_iter().filter(inside).collect();
        samples.extend((0..200).map(|k| {
            let (x, y) = (f64::from(k % 15) / 14.0, f64::from(k / 15) / 13.0);
            let mix = |a: f64, b: f64, x: f64| (a + (b - a) * x).clamp(a, b);
            [mix(range[0], range[1], x), mix(range[2], range[3], y)]
        }));
        let options = QueryOptions { domain: Some(range), ..QueryOptions::default() };
        for _ in 0..3 {
            let query = shape.query(r);
            let foot = shape.ask(query, None, &options);
            prop_assert!(inside(&[foot.u, foot.v]), "{range:?} {foot:?}");
            let slack = shape.rounding(query, foot.distance);
            for at in &samples {
                let there = apart(query, shape.evaluate(*at));
                prop_assert!(foot.distance <= there + slack, "{range:?} {at:?} {there:e} {query:?} {foot:?}");
                prop_assert!(foot.lower_bound <= there + slack, "{range:?} {at:?} {there:e} {foot:?}");
            }
            let whole = shape.ask(query, None, &QueryOptions::default());
            prop_assert!(whole.lower_bound <= foot.distance + slack);
        }
    }

    #[test]
    fn the_box_of_the_whole_domain_changes_no_bit(family in 0..FAMILIES.len(), seed in any::<u64>()) {
        let (shape, r) = (Shape::new(family, seed), &mut Random(!seed));
        let options = QueryOptions { domain: Some(shape.domain()), ..QueryOptions::default() };
        let query = shape.query(r);
        let (whole, boxed) =
            (shape.ask(query, None, &QueryOptions::default()), shape.ask(query, None, &options));
        prop_assert_eq!(bits(&whole), bits(&boxed));
    }
}

proptest! {
    #![proptest_config(config(60))]

    #[test]
    fn answers_have_the_same_bits_for_any_batch_order_and_number_of_threads(
        family in 0..FAMILIES.len(), seed in any::<u64>(), count in 1..500usize,
    ) {
        let (shape, r) = (Shape::new(family, seed), &mut Random(!seed));
        let queries: Vec<Vector> = (0..count).map(|_| shape.query(r)).collect();
        let options = QueryOptions::default();
        let run = |threads: usize, order: &(dyn Fn(usize) -> usize + Sync)| {
            let mut out = vec![FootPoint::unreached(); count];
            let work = |i: usize, workspace: &mut Workspace| {
                shape.ask_with(queries[order(i)], None, &options, workspace)
            };
            batch::run(&mut out, threads, &work, &mut |_| false).expect("a batch");
            out
        };
        let single: Vec<_> = queries.iter().map(|q| bits(&shape.ask(*q, None, &options))).collect();
        for threads in [1, 2, 3, 0] {
            let forth: Vec<_> = run(threads, &|i| i).iter().map(bits).collect();
            prop_assert_eq!(&forth, &single);
            let back: Vec<_> = run(threads, &|i| count - 1 - i).iter().rev().map(bits).collect();
            prop_assert_eq!(&back, &single);
        }
    }

    #[test]
    fn a_query_that_is_not_finite_or_too_large_is_refused_alone(
        family in 0..FAMILIES.len(), seed in any::<u64>(), axis in 0..3usize,
    ) {
        let (shape, r) = (Shape::new(family, seed), &mut Random(!seed));
        let (good, options, workspace) =
            (shape.query(r), QueryOptions::default(), &mut Workspace::default());
        let before = shape.ask_with(good, None, &options, workspace);
        for bad in [f64::NAN, f64::INFINITY, -f64::INFINITY, 1e101, -1e101, f64::MAX] {
            let mut query = good;
            query[axis] = bad;
            let foot = shape.ask_with(query, None, &options, workspace);
            prop_assert_eq!(foot.flags, flag::BAD_QUERY | flag::NOT_PROVEN);
            prop_assert!(foot.u.is_nan() && foot.distance.is_nan() && foot.lower_bound == 0.0);
            let after = shape.ask_with(good, None, &options, workspace);
            prop_assert_eq!(bits(&before), bits(&after));
        }
        let mut query = good;
        query[axis] = 1e100;
        let foot = shape.ask_with(query, None, &options, workspace);
        prop_assert!(foot.flags & flag::BAD_QUERY == 0 && (foot.distance / 1e100 - 1.0).abs() < 1e-9);
        prop_assert!(foot.lower_bound <= foot.distance);
    }

    #[test]
    fn an_inversion_says_when_the_query_is_not_on_the_shape(
        family in 0..FAMILIES.len(), seed in any::<u64>(), tolerance in -9..-2i32,
    ) {
        let (shape, r) = (Shape::new(family, seed), &mut Random(!seed));
        let tolerance = shape.diagonal() * 10f64.powi(tolerance);
        let options = QueryOptions { tolerance, ..QueryOptions::default() };
        for _ in 0..4 {
            let (query, workspace) = (shape.query(r), &mut Workspace::default());
            let foot = match &shape {
                Shape::Curve(curve) => curve.invert(query, None, &options, workspace, None),
                Shape::Surface(surface) => surface.invert(query, None, &options, workspace, None),
            };
            prop_assert_eq!(foot.flags & flag::NOT_ON_SHAPE != 0, foot.lower_bound > tolerance);
            if foot.distance > tolerance && foot.lower_bound <= tolerance {
                prop_assert!(foot.flags & flag::NOT_PROVEN != 0);
            }
            let closest = shape.ask(query, None, &options);
            prop_assert_eq!([foot.u, foot.v, foot.distance], [closest.u, closest.v, closest.distance]);
        }
    }
}

#[test]
fn most_answers_of_every_family_are_proven() {
    for (family, kind) in FAMILIES.iter().enumerate() {
        for seed in 0..60 {
            let (shape, r) = (Shape::new(family, seed), &mut Random(seed));
            for _ in 0..25 {
                let foot = shape.ask(shape.query(r), None, &QueryOptions::default());
                count(family, &shape, &foot);
            }
        }
        let [curves, of_curves, surfaces, of_surfaces] = SHARES.lock().expect("the counts")[family];
        println!(
            "{:<24} not proven: curves {curves} of {of_curves}, surfaces {surfaces} of {of_surfaces}",
            kind.name
        );
        assert!(curves <= of_curves / 100 && surfaces <= of_surfaces / 100, "{}", kind.name);
    }
}
