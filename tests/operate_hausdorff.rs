//! Errors that operations prove, beside the certified Hausdorff distance, which knows nothing of how the shapes were made; and the laws
//! on closed curves with periodic knots.

mod strategies;

use footpoint::curve::Curve;
use footpoint::index::{IndexedCurve, IndexedSurface};
use footpoint::inspect::{HausdorffOptions, Shape, hausdorff};
use footpoint::operate::{Bounded, Direction, join_curves};
use footpoint::surface::Surface;
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use strategies::{curves, surfaces};

fn config(cases: u32) -> ProptestConfig {
    ProptestConfig {
        failure_persistence: None,
        rng_seed: RngSeed::Fixed(0x666f_6f74),
        ..ProptestConfig::with_cases(cases)
    }
}

fn size(poles: &[[f64; 3]]) -> f64 {
    poles.iter().flatten().fold(0.0, |size: f64, x| size.max(x.abs()))
}

fn gap(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|x| (a[x] - b[x]).powi(2)).sum::<f64>().sqrt()
}

/// Some point is proven to be `lower` away from the other shape: an error that is less would be wrong. Where the search was
/// finished, no point is farther than the error and the gap that it was allowed.
fn certified(
    [first, second]: [Shape; 2],
    error: f64,
    accuracy: f64,
    budget: u64,
) -> Result<(), TestCaseError> {
    let options = HausdorffOptions { accuracy, budget };
    let found = hausdorff(first, second, &options, &mut || false).unwrap();
    let [lower, upper] = found.bounds();
    prop_assert!(lower <= error, "{lower:e} > {error:e}");
    if found.forward.proven && found.backward.proven {
        prop_assert!(upper <= error + 1.001 * accuracy, "{upper:e} {error:e} {accuracy:e}");
    }
    Ok(())
}

fn curve_keeps(old: &Curve, new: &Bounded<Curve>) -> Result<(), TestCaseError> {
    let (a, b) = (IndexedCurve::new(old.clone()), IndexedCurve::new(new.shape.clone()));
    let accuracy = 0.02 * size(old.poles()).max(new.error);
    certified([Shape::Curve(&a), Shape::Curve(&b)], new.error, accuracy, 400)
}

fn surface_keeps(old: &Surface, new: &Bounded<Surface>) -> Result<(), TestCaseError> {
    let (a, b) = (IndexedSurface::new(old.clone()), IndexedSurface::new(new.shape.clone()));
    let accuracy = 0.1 * size(old.poles()).max(new.error);
    certified([Shape::Surface(&a), Shape::Surface(&b)], new.error, accuracy, 60)
}

/// A closed curve with periodic knots and wrapped poles, of degrees 1 to 9, rational or not.
fn rings() -> impl Strategy<Value = Curve> {
    (1..=9usize, 1..6usize, any::<bool>()).prop_flat_map(|(degree, more, rational)| {
        let count = degree + more + 1;
        let poles = prop::collection::vec([-9.0..9.0f64, -9.0..9.0, -9.0..9.0], count);
        let steps = prop::collection::vec(0.1..1.0f64, count);
        let weights = prop::collection::vec(0.3..3.0f64, count);
        (poles, steps, weights).prop_map(move |(poles, steps, weights)| {
            let turn: f64 = steps.iter().sum();
            let knot = |k: i64| {
                let (turns, k) = (k.div_euclid(count as i64), k.rem_euclid(count as i64));
                turns as f64 * turn + steps[..k as usize].iter().sum::<f64>()
            };
            let first = -(degree as i64);
            let knots: Vec<f64> = (first..=(count + degree) as i64).map(knot).collect();
            let wrapped: Vec<[f64; 3]> = (0..count + degree).map(|i| poles[i % count]).collect();
            let w: Vec<f64> = (0..count + degree).map(|i| weights[i % count]).collect();
            Curve::new(&knots, degree, &wrapped, rational.then_some(&w[..])).unwrap()
        })
    })
}

proptest! {
    #![proptest_config(config(24))]

    #[test]
    fn what_is_proven_for_curves_is_certified(curve in curves(), digits in -4.0..-0.5f64) {
        let thin = curve.simplify(size(curve.poles()) * 10f64.powf(digits)).unwrap();
        curve_keeps(&curve, &thin)?;
        if let Ok(lower) = curve.reduce() {
            curve_keeps(&curve, &lower)?;
        }
        if let Ok(open) = curve.unclamp() {
            curve_keeps(&curve, &open)?;
        }
        let inner = curve.knots().values().iter().find(|u| {
            let (start, end) = curve.domain();
            start < **u && **u < end
        });
        if let Some(&u) = inner && let Ok(fewer) = curve.remove_knot(u, 1) {
            curve_keeps(&curve, &fewer)?;
        }
        let (start, end) = curve.domain();
        let middle = start + 0.4 * (end - start);
        let parts = [curve.part(start, middle).unwrap(), curve.part(middle, end).unwrap()];
        if let Ok(joined) = join_curves(&parts, 1e-9 * size(curve.poles())) {
            let error = joined.error + 1e-11 * size(curve.poles());
            curve_keeps(&curve, &Bounded { shape: joined.shape, error })?;
        }
    }

    #[test]
    fn operations_leave_closed_curves_with_periodic_knots(ring in rings(), share in 0.05..0.95f64) {
        let allowed = 1e-13 * size(ring.poles());
        let (start, end) = ring.domain();
        let middle = start + share * (end - start);
        prop_assert!(gap(ring.evaluate(start), ring.evaluate(end)) <= allowed);
        let clamped = ring.clamp().unwrap();
        let same = [
            clamped.clone(), ring.refine(&[middle]).unwrap(), ring.elevate(2).unwrap(),
            ring.bezier_form().unwrap(),
        ];
        for i in 0..=60 {
            let u = (start + (end - start) * (i as f64 / 60.0)).clamp(start, end);
            for other in &same {
                prop_assert!(gap(ring.evaluate(u), other.evaluate(u)) <= allowed);
            }
            let back = ring.reverse().unwrap();
            let turned = back.evaluate((start + (end - u)).clamp(start, end));
            prop_assert!(gap(ring.evaluate(u), turned) <= 1e3 * allowed);
        }
        // There and back: the same knots, and as many poles.
        let tolerance = 1e-9 * size(ring.poles());
        let back = clamped.periodic(tolerance).unwrap();
        prop_assert_eq!(back.shape.poles().len(), ring.poles().len());
        // Spans of unequal length amplify rounding where knots are taken apart; what is proven is what was asked for.
        prop_assert!(back.error <= tolerance, "{:e}", back.error);
        curve_keeps(&ring, &back)?;
        let elevated = clamped.elevate(1).unwrap().periodic(tolerance).unwrap();
        prop_assert!(elevated.error <= tolerance, "{:e}", elevated.error);
    }
}

proptest! {
    #![proptest_config(config(4))]

    #[test]
    fn what_is_proven_for_surfaces_is_certified(surface in surfaces(), digits in -3.0..-0.5f64) {
        let thin = surface.simplify(size(surface.poles()) * 10f64.powf(digits)).unwrap();
        surface_keeps(&surface, &thin)?;
        for direction in [Direction::U, Direction::V] {
            if let Ok(lower) = surface.reduce(direction) {
                surface_keeps(&surface, &lower)?;
            }
        }
    }
}
