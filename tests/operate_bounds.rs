//! Operations that approximate keep their proven error; those that undo another come back within rounding.

mod strategies;

use footpoint::curve::Curve;
use footpoint::operate::{Bounded, Direction, join_curves, join_surfaces};
use footpoint::surface::Surface;
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use strategies::{curves, parameter, surfaces};

fn config(cases: u32) -> ProptestConfig {
    ProptestConfig {
        failure_persistence: None,
        rng_seed: RngSeed::Fixed(0x666f_6f74),
        ..ProptestConfig::with_cases(cases)
    }
}

fn gap(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|x| (a[x] - b[x]).powi(2)).sum::<f64>().sqrt()
}

fn size(poles: &[[f64; 3]]) -> f64 {
    poles.iter().flatten().fold(0.0, |size: f64, x| size.max(x.abs()))
}

/// Parameters all over [start, end], denser than any test's knots.
fn places(start: f64, end: f64) -> impl Iterator<Item = f64> {
    (0..=200).map(move |i| (start + (end - start) * (i as f64 / 200.0)).clamp(start, end))
}

/// The greatest of the sampled differences.
fn sampled(a: &Curve, b: &Curve) -> f64 {
    let (start, end) = a.domain();
    places(start, end).map(|u| gap(a.evaluate(u), b.evaluate(u))).fold(0.0, f64::max)
}

fn sampled_surface(a: &Surface, b: &Surface) -> f64 {
    let [u0, u1, v0, v1] = a.domain();
    let degree = a.knots_u().degree() + a.knots_v().degree();
    let rounding = evaluation(degree, a.poles()) + evaluation(degree, b.poles());
    let mut most = -rounding;
    for u in places(u0, u1).step_by(9) {
        for v in places(v0, v1).step_by(9) {
            most = most.max(gap(a.evaluate(u, v), b.evaluate(u, v)) - rounding);
        }
    }
    most
}

/// What two evaluations may be off.
fn evaluation(degree: usize, poles: &[[f64; 3]]) -> f64 {
    4.0 * (degree + 2) as f64 * f64::EPSILON * size(poles)
}

/// Samples keep below the proven error, and it is not far above what they reach.
fn holds(old: &Curve, new: &Bounded<Curve>) -> Result<(), TestCaseError> {
    prop_assert_eq!(old.domain(), new.shape.domain());
    let found = sampled(old, &new.shape)
        - evaluation(old.degree(), old.poles())
        - evaluation(old.degree(), new.shape.poles());
    prop_assert!(found <= new.error, "{found:e} > {:e}", new.error);
    Ok(())
}

proptest! {
    #![proptest_config(config(100))]

    #[test]
    fn a_knot_that_was_inserted_goes_again_within_rounding(
        curve in curves(), share in 0.05..0.95f64,
    ) {
        let (start, end) = curve.domain();
        let u = start + share * (end - start);
        prop_assume!(curve.knots().multiplicity(u) == 0);
        let finer = curve.insert_knot(u, 1).unwrap();
        let back = finer.remove_knot(u, 1).unwrap();
        holds(&finer, &back)?;
        prop_assert_eq!(back.shape.knots(), curve.knots());
        // Weights from 1e-3 to 1e3 hide digits of each other.
        let floor = if curve.is_rational() { 1e-10 } else { 1e-13 * (curve.degree() + 1) as f64 };
        prop_assert!(back.error <= floor * size(curve.poles()), "{:e}", back.error);
    }

    #[test]
    fn the_error_of_a_removed_knot_holds_and_is_tight(curve in curves(), share in 0.0..1.0f64) {
        let u = curve.knots().values()[curve.knots().span(parameter(curve.knots(), share))];
        let (start, end) = curve.domain();
        prop_assume!(start < u && u < end);
        // A weight that would turn negative is refused.
        let Ok(coarse) = curve.remove_knot(u, 1) else { return Ok(()) };
        holds(&curve, &coarse)?;
        // Samples see the greatest difference only where no span is short, and no weight is extreme.
        let steps = curve.knots().spans().map(|i| curve.knots().values()[i + 1] - curve.knots().values()[i]);
        if !curve.is_rational() && steps.fold(f64::INFINITY, f64::min) > 0.03 * (end - start) {
            let found = sampled(&curve, &coarse.shape);
            prop_assert!(coarse.error <= 1.5 * found + 1e-11 * size(curve.poles()), "{:e} {found:e}", coarse.error);
        }
    }

    #[test]
    fn simplifying_stays_within_the_tolerance_and_finds_what_is_not_needed(
        curve in curves(), shares in prop::collection::vec(0.05..0.95f64, 1..8), digits in -9.0..0.0f64,
    ) {
        let (start, end) = curve.domain();
        let added: Vec<f64> = shares.iter().map(|share| start + share * (end - start)).collect();
        prop_assume!(added.iter().all(|&u| curve.knots().multiplicity(u) == 0));
        let finer = curve.refine(&added).unwrap();
        let tolerance = size(curve.poles()) * 10f64.powf(digits);
        let coarse = finer.simplify(tolerance).unwrap();
        prop_assert!(coarse.error <= tolerance);
        holds(&finer, &coarse)?;
        // A step of a removal may double the rounding of a pole: high degrees lose the digits that tell.
        if !curve.is_rational() && curve.degree() <= 5 {
            let floor = 1e-11 * (curve.degree() + 1) as f64 * size(curve.poles());
            let coarse = finer.simplify(floor).unwrap();
            prop_assert!(coarse.shape.poles().len() <= curve.poles().len(), "{added:?}");
        }
    }

    #[test]
    fn a_reduced_degree_keeps_its_error_and_undoes_an_elevation(curve in curves()) {
        prop_assume!(curve.degree() < 12);
        let raised = curve.elevate(1).unwrap();
        let back = raised.reduce().unwrap();
        holds(&raised, &back)?;
        let p = curve.degree() as f64;
        prop_assert!(back.error <= 2e-13 * (p + 1.0) * size(curve.poles()) || curve.is_rational(), "{:e}", back.error);
        if curve.degree() > 1 && let Ok(lower) = curve.reduce() {
            prop_assert_eq!(lower.shape.degree(), curve.degree() - 1);
            holds(&curve, &lower)?;
        }
    }

    #[test]
    fn unclamped_and_periodic_forms_keep_their_error(curve in curves()) {
        if let Ok(open) = curve.unclamp() {
            holds(&curve, &open)?;
            let knots = open.shape.knots();
            prop_assert!(knots.values()[0] < knots.domain().0);
        }
        // Closed by hand: the seam is a mere join at least.
        let clamped = curve.clamp().unwrap();
        let mut poles = clamped.poles().to_vec();
        let last = poles.len() - 1;
        poles[last] = poles[0];
        let closed = Curve::new(clamped.knots().values(), clamped.degree(), &poles, clamped.weights()).unwrap();
        let tolerance = 1e-6 * size(&poles);
        if let Ok(periodic) = closed.periodic(tolerance) {
            prop_assert!(periodic.error <= tolerance);
            holds(&closed, &periodic)?;
        } else {
            // Only weights that do not agree at the seam stand in the way.
            prop_assert!(closed.is_rational());
        }
    }

    #[test]
    fn parts_that_are_joined_are_the_curve(curve in curves(), shares in [0.1..0.5f64, 0.5..0.9f64]) {
        let (start, end) = curve.domain();
        let [a, b] = shares.map(|share| start + share * (end - start));
        let parts = [
            curve.part(start, a).unwrap(), curve.part(a, b).unwrap(), curve.part(b, end).unwrap(),
        ];
        let Ok(joined) = join_curves(&parts, 1e-9 * size(curve.poles())) else { return Ok(()) };
        prop_assert!(joined.error <= 1e-11 * size(curve.poles()), "{:e}", joined.error);
        for (part, shift) in parts.iter().zip([0.0; 3]) {
            let (a, b) = part.domain();
            for u in places(a, b).step_by(20) {
                let u = (u + shift).clamp(joined.shape.domain().0, joined.shape.domain().1);
                let far = curve.knots().values().iter().fold(0.0, |far: f64, u| far.max(u.abs()));
                let mut d = [[0.0; 3]; 2];
                curve.derivatives(u.clamp(start, end), 1, &mut d);
                let speed = (0..3).map(|x| d[1][x] * d[1][x]).sum::<f64>().sqrt();
                let error = gap(joined.shape.evaluate(u), curve.evaluate(u.clamp(start, end)));
                prop_assert!(error <= 1e-11 * size(curve.poles()) + 1e-13 * far * speed, "{error:e}");
            }
        }
    }
}

proptest! {
    #![proptest_config(config(25))]

    #[test]
    fn surfaces_keep_their_errors_too(surface in surfaces(), digits in -6.0..-1.0f64) {
        let tolerance = size(surface.poles()) * 10f64.powf(digits);
        let thin = surface.simplify(tolerance).unwrap();
        prop_assert!(thin.error <= tolerance && sampled_surface(&surface, &thin.shape) <= thin.error);
        for direction in [Direction::U, Direction::V] {
            if let Ok(open) = surface.unclamp(direction) {
                prop_assert!(sampled_surface(&surface, &open.shape) <= open.error);
            }
            let raised = surface.elevate(direction, 1).unwrap();
            if let Ok(back) = raised.reduce(direction) {
                prop_assert!(sampled_surface(&raised, &back.shape) <= back.error);
            }
            let knots = surface.knots(direction);
            let (start, end) = knots.domain();
            let middle = start + 0.4 * (end - start);
            let (a, b) = match direction {
                Direction::U => surface.split_u(middle).unwrap(),
                Direction::V => surface.split_v(middle).unwrap(),
            };
            let parts = [a.clamp().unwrap(), b.clamp().unwrap()];
            if let Ok(joined) = join_surfaces(&parts, direction, 1e-9 * size(surface.poles())) {
                prop_assert!(joined.error <= 1e-10 * size(surface.poles()), "{:e}", joined.error);
            }
        }
    }
}

/// A closed cubic with a C2 seam: periodic knots and wrapped poles.
fn ring() -> Curve {
    let corners: Vec<[f64; 3]> = (0..7)
        .map(|i| {
            let angle = i as f64 * std::f64::consts::TAU / 7.0;
            [angle.cos() * (2.0 + 0.3 * (i % 3) as f64), angle.sin(), 0.2 * (i % 2) as f64]
        })
        .collect();
    let poles: Vec<[f64; 3]> = (0..10).map(|i| corners[i % 7]).collect();
    let steps = [0.5, 1.0, 0.7, 1.3, 0.9, 1.1, 0.6];
    let knot = |k: i32| {
        let turns = k.div_euclid(7);
        let inside: f64 = steps[..k.rem_euclid(7) as usize].iter().sum();
        turns as f64 * steps.iter().sum::<f64>() + inside
    };
    let knots: Vec<f64> = (-3..=10).map(knot).collect();
    Curve::new(&knots, 3, &poles, None).unwrap()
}

#[test]
fn a_periodic_curve_comes_back_from_its_clamped_form() {
    let ring = ring();
    let clamped = ring.clamp().unwrap();
    let back = clamped.periodic(1e-9).unwrap();
    assert!(back.error < 1e-12, "{:e}", back.error);
    let pairs = back.shape.knots().values().iter().zip(ring.knots().values());
    pairs.for_each(|(a, b)| assert!((a - b).abs() < 1e-14, "{a} {b}"));
    assert_eq!(back.shape.poles().len(), ring.poles().len());
    for (a, b) in back.shape.poles().iter().zip(ring.poles()) {
        assert!(gap(*a, *b) < 1e-12);
    }
    assert_eq!(back.shape.poles()[..3], back.shape.poles()[7..]);
    assert!(clamped.part(0.0, 3.0).unwrap().periodic(1e-9).is_err());
}

#[test]
fn a_circle_of_quadrants_is_periodic_with_double_knots() {
    let h = 0.5f64.sqrt();
    let poles = [
        [1., 0., 0.],
        [1., 1., 0.],
        [0., 1., 0.],
        [-1., 1., 0.],
        [-1., 0., 0.],
        [-1., -1., 0.],
        [0., -1., 0.],
        [1., -1., 0.],
        [1., 0., 0.],
    ];
    let knots = [0., 0., 0., 1., 1., 2., 2., 3., 3., 4., 4., 4.];
    let circle = Curve::new(&knots, 2, &poles, Some(&[1., h, 1., h, 1., h, 1., h, 1.])).unwrap();
    let periodic = circle.periodic(1e-12).unwrap();
    assert_eq!(
        periodic.shape.knots().values(),
        [-1., -1., 0., 0., 1., 1., 2., 2., 3., 3., 4., 4.][1..]
            .iter()
            .copied()
            .chain([5.0])
            .collect::<Vec<_>>()
    );
    assert!(periodic.error < 1e-13, "{:e}", periodic.error);
}

#[test]
fn what_cannot_be_done_is_refused_by_name() {
    let ring = ring();
    let text = |error: footpoint::error::Error| error.to_string();
    assert!(text(ring.remove_knot(0.3, 1).unwrap_err()).starts_with("u: 0.3 is not a knot"));
    assert!(text(ring.remove_knot(0.5, 2).unwrap_err()).starts_with("times: 2 given"));
    assert!(text(ring.simplify(f64::NAN).unwrap_err()).starts_with("tolerance:"));
    assert!(text(ring.refine(&[0.1, 99.0]).unwrap_err()).starts_with("values: values[1] = 99"));
    assert!(text(ring.elevate(40).unwrap_err()).starts_with("degree: 43"));
    assert!(text(ring.elevate(usize::MAX).unwrap_err()).starts_with("degree:"));
    assert!(text(ring.part(2.0, 1.0).unwrap_err()).starts_with("end: 1 is not beyond"));
    assert!(text(ring.with_domain(1.0, 1.0).unwrap_err()).starts_with("domain:"));
    assert!(text(ring.reparametrise(-1.0).unwrap_err()).starts_with("speed:"));
    assert!(text(join_curves(&[], 1.0).unwrap_err()).starts_with("curves: none"));
    let apart = [ring.part(0.0, 1.0).unwrap(), ring.part(2.0, 3.0).unwrap()];
    assert!(text(join_curves(&apart, 1e-3).unwrap_err()).starts_with("curves: 1 begins"));
    let line = Curve::new(&[0., 0., 1., 1.], 1, &[[0.0; 3], [1.0; 3]], None).unwrap();
    assert!(text(line.reduce().unwrap_err()).starts_with("degree: 1"));
}
