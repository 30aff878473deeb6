//! Laws of the operations: exact ones leave every point within 1e-13 of the size of the shape, approximate ones keep their proven error.

mod strategies;

use footpoint::curve::Curve;
use footpoint::knots::Knots;
use footpoint::operate::{Direction, compatible_curves, compatible_surfaces};
use footpoint::surface::Surface;
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use strategies::{curves, parameter, surfaces};

const EXACT: f64 = 1e-13;

const DIRECTIONS: [Direction; 2] = [Direction::U, Direction::V];

fn config() -> ProptestConfig {
    // Domains too short for the knots of another curve are thrown away.
    ProptestConfig {
        failure_persistence: None,
        rng_seed: RngSeed::Fixed(0x666f_6f74),
        max_global_rejects: 10_000,
        ..ProptestConfig::with_cases(120)
    }
}

fn gap(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|x| (a[x] - b[x]).powi(2)).sum::<f64>().sqrt()
}

/// Largest coordinate of a net: what rounding is relative to.
fn size(poles: &[[f64; 3]]) -> f64 {
    poles.iter().flatten().fold(0.0, |size: f64, x| size.max(x.abs()))
}

/// What the rounding of a parameter and of the knots may move, as a share of the size of the shape.
fn moved_by_parameters(knots: &Knots, weights: Option<&[f64]>) -> f64 {
    let values = knots.values();
    let far = values.iter().fold(0.0, |far: f64, u| far.max(u.abs()));
    let steps = values.windows(2).map(|w| w[1] - w[0]).filter(|step| *step > 0.0);
    let p = knots.degree() as f64;
    let [least, most] = weights
        .into_iter()
        .flatten()
        .fold([1.0, 1.0], |[least, most]: [f64; 2], &w| [least.min(w), most.max(w)]);
    32.0 * f64::EPSILON * p * p * far / steps.fold(f64::INFINITY, f64::min) * (most / least)
}

fn moved_on_curve(curve: &Curve) -> f64 {
    moved_by_parameters(curve.knots(), curve.weights())
}

fn moved_on_surface(surface: &Surface) -> f64 {
    let weights = surface.weights();
    moved_by_parameters(surface.knots_u(), weights)
        + moved_by_parameters(surface.knots_v(), weights)
}

/// Parameters all over the domain, knots and ends among them.
fn samples(knots: &Knots) -> Vec<f64> {
    let (start, end) = knots.domain();
    let inside = |i: usize| (start + (end - start) * (i as f64 / 23.0)).clamp(start, end);
    let at_knots = knots.values().iter().copied().filter(|&u| knots.contains(u));
    (0..=23).map(inside).chain(at_knots).collect()
}

fn same_curve(a: &Curve, b: &Curve, allowed: f64) -> Result<(), TestCaseError> {
    prop_assert_eq!(a.domain(), b.domain());
    for u in samples(a.knots()) {
        let error = gap(a.evaluate(u), b.evaluate(u)) / size(a.poles());
        prop_assert!(error <= allowed, "{error:e} at {u}");
    }
    Ok(())
}

fn same_surface(a: &Surface, b: &Surface, allowed: f64) -> Result<(), TestCaseError> {
    prop_assert_eq!(a.domain(), b.domain());
    let [all_u, all_v] = [samples(a.knots_u()), samples(a.knots_v())];
    for (i, &u) in all_u.iter().enumerate() {
        for &v in all_v.iter().skip(i % 5).step_by(5) {
            let error = gap(a.evaluate(u, v), b.evaluate(u, v)) / size(a.poles());
            prop_assert!(error <= allowed, "{error:e} at {u}, {v}");
        }
    }
    Ok(())
}

/// Knots that may be added: some inside, one of them twice where it can be.
fn addable(knots: &Knots, shares: &[f64]) -> Vec<f64> {
    let mut out: Vec<f64> = Vec::new();
    for &share in shares {
        let u = parameter(knots, share);
        let (start, end) = knots.domain();
        let most = knots.degree() + usize::from(u == start || u == end);
        let there = knots.multiplicity(u) + out.iter().filter(|&&x| x == u).count();
        out.extend(std::iter::repeat_n(u, 2.min(most - there)));
    }
    out
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn refining_leaves_a_curve(
        curve in curves(), shares in prop::collection::vec(0.0..1.0f64, 0..6),
    ) {
        let added = addable(curve.knots(), &shares);
        let finer = curve.refine(&added).unwrap();
        prop_assert_eq!(finer.poles().len(), curve.poles().len() + added.len());
        same_curve(&curve, &finer, EXACT)?;
        let mut one_by_one = curve.clone();
        for u in added {
            one_by_one = one_by_one.insert_knot(u, 1).unwrap();
        }
        prop_assert_eq!(one_by_one.knots(), finer.knots());
        let active = finer.knots().active_poles();
        for i in active {
            prop_assert!(gap(one_by_one.poles()[i], finer.poles()[i]) <= EXACT * size(curve.poles()));
        }
    }

    #[test]
    fn clamping_and_elevating_leave_a_curve(curve in curves(), by in 0..4usize) {
        let clamped = curve.clamp().unwrap();
        same_curve(&curve, &clamped, EXACT)?;
        prop_assert_eq!(clamped.poles()[0], clamped.evaluate(clamped.domain().0));
        let by = by.min(31 - curve.degree());
        let raised = curve.elevate(by).unwrap();
        prop_assert_eq!(raised.degree(), curve.degree() + by);
        same_curve(&curve, &raised, EXACT)?;
        for u in samples(curve.knots()) {
            let (start, end) = curve.domain();
            if start < u && u < end && curve.knots().multiplicity(u) > 0 {
                prop_assert_eq!(
                    raised.knots().multiplicity(u),
                    curve.knots().multiplicity(u) + by
                );
            }
        }
    }

    #[test]
    fn a_part_and_the_pieces_are_the_curve_there(curve in curves(), ends in [0.0..1.0f64, 0.0..1.0f64]) {
        let [a, b] = ends.map(|share| parameter(curve.knots(), share));
        prop_assume!(a != b);
        let (a, b) = (a.min(b), a.max(b));
        let mut parts = vec![curve.part(a, b).unwrap()];
        prop_assert_eq!(parts[0].domain(), (a, b));
        parts.extend(curve.bezier_pieces().unwrap());
        prop_assert_eq!(parts.len(), 1 + curve.knots().spans().count());
        for part in parts {
            for u in samples(part.knots()) {
                let error = gap(part.evaluate(u), curve.evaluate(u)) / size(curve.poles());
                prop_assert!(error <= EXACT, "{error:e}");
            }
        }
    }

    #[test]
    fn surfaces_stay_under_refining_elevating_swapping_and_cutting(
        surface in surfaces(), shares in prop::collection::vec(0.0..1.0f64, 0..4),
        ends in [0.0..0.5f64, 0.5..1.0f64],
    ) {
        same_surface(&surface, &surface.clamp().unwrap(), EXACT)?;
        for direction in DIRECTIONS {
            let knots = surface.knots(direction);
            let added = addable(knots, &shares);
            same_surface(&surface, &surface.refine(direction, &added).unwrap(), EXACT)?;
            same_surface(&surface, &surface.elevate(direction, 2).unwrap(), EXACT)?;
            let [a, b] = ends.map(|share| parameter(knots, share));
            prop_assume!(a < b);
            let part = surface.part_along(direction, a, b).unwrap();
            let [u0, u1, v0, v1] = part.domain();
            for (u, v) in [(u0, v0), (u1, v1), (0.5 * u0 + 0.5 * u1, 0.5 * v0 + 0.5 * v1)] {
                let error = gap(part.evaluate(u, v), surface.evaluate(u, v));
                prop_assert!(error <= EXACT * size(surface.poles()), "{error:e}");
            }
        }
        let swapped = surface.swap().unwrap();
        prop_assert_eq!(&swapped.swap().unwrap(), &surface);
        let (pieces, [count_u, count_v]) = surface.bezier_pieces().unwrap();
        prop_assert_eq!(pieces.len(), count_u * count_v);
        for piece in pieces {
            let [u0, u1, v0, v1] = piece.domain();
            let (u, v) = (0.7 * u0 + 0.3 * u1, 0.2 * v0 + 0.8 * v1);
            let error = gap(piece.evaluate(u, v), surface.evaluate(u, v));
            prop_assert!(error <= EXACT * size(surface.poles()), "{error:e}");
        }
    }

    #[test]
    fn other_parameters_give_the_same_points(
        curve in curves(), domain in (-5.0..5.0f64, 0.1..9.0f64), speed in 0.2..5.0f64,
    ) {
        let (start, end) = curve.domain();
        let allowed = EXACT + moved_on_curve(&curve) + moved_on_curve(&curve.with_domain(domain.0, domain.0 + domain.1).unwrap());
        prop_assume!(allowed < 1e-9);
        let near = |a: [f64; 3], b: [f64; 3]| {
            let error = gap(a, b) / size(curve.poles());
            prop_assert!(error <= allowed, "{error:e} > {allowed:e}");
            Ok(())
        };
        let affine = curve.with_domain(domain.0, domain.0 + domain.1).unwrap();
        let reversed = curve.reverse().unwrap();
        let moebius = curve.reparametrise(speed).unwrap();
        prop_assert!(moebius.domain() == curve.domain() && reversed.domain() == curve.domain());
        let (first, last) = affine.domain();
        for i in 0..=20 {
            let share = i as f64 / 20.0;
            let u = (start + share * (end - start)).clamp(start, end);
            near(affine.evaluate((first + share * (last - first)).clamp(first, last)), curve.evaluate(u))?;
            near(reversed.evaluate((start + (end - u)).clamp(start, end)), curve.evaluate(u))?;
            near(moebius.evaluate(curve.reparametrised(speed, u)), curve.evaluate(u))?;
        }
    }

    #[test]
    fn compatible_curves_share_degree_and_knots_and_stay(all in prop::collection::vec(curves(), 1..4)) {
        let allowed = all.iter().map(moved_on_curve).fold(EXACT, f64::max);
        let (start, end) = all[0].domain();
        prop_assume!(all.iter().all(|curve| curve.clamp().unwrap().with_domain(start, end).is_ok()));
        let shared = compatible_curves(&all).unwrap();
        for (old, new) in all.iter().zip(&shared) {
            prop_assert_eq!(new.knots(), shared[0].knots());
            prop_assert_eq!(new.weights().is_some(), all.iter().any(|c| c.weights().is_some()));
            let ((a, b), (c, d)) = (old.domain(), new.domain());
            let allowed = allowed + moved_on_curve(&shared[0]);
            prop_assume!(allowed < 1e-7);
            for i in 0..=20 {
                let at = |start: f64, end: f64| (start + i as f64 / 20.0 * (end - start)).clamp(start, end);
                let error = gap(old.evaluate(at(a, b)), new.evaluate(at(c, d))) / size(old.poles());
                prop_assert!(error <= allowed, "{error:e} > {allowed:e}");
            }
        }
    }

    #[test]
    fn the_difference_of_a_curve_and_its_other_forms_is_rounding(curve in curves(), by in 0..3usize) {
        let by = by.min(31 - curve.degree());
        let other = curve.elevate(by).unwrap();
        let found = curve.difference(&other).unwrap();
        let floor = 3e-14 * ((1 + by) * (1 + other.degree())) as f64;
        prop_assert!(found.bound <= floor * size(curve.poles()), "{found:?}");
    }

    #[test]
    fn no_sample_is_farther_apart_than_the_bound_and_the_reached_one_is(
        pair in curves().prop_flat_map(|a| (Just(a), curves())),
    ) {
        let (a, b) = pair;
        let (start, end) = a.domain();
        // A domain far from 0 may be too short to keep the knots apart.
        let Ok(b) = b.with_domain(start, end) else { return Err(TestCaseError::reject("domain")) };
        let found = a.difference(&b).unwrap();
        let most = samples(a.knots()).into_iter().chain(samples(b.knots()))
            .map(|u| gap(a.evaluate(u), b.evaluate(u))).fold(0.0, f64::max);
        prop_assert!(most <= found.bound, "{most} {found:?}");
        let there = gap(a.evaluate(found.at[0]), b.evaluate(found.at[0]));
        let moved = moved_on_curve(&a) * size(a.poles())
            + moved_on_curve(&b) * size(b.poles());
        prop_assert!(there + moved >= found.reached, "{there} {found:?}");
        prop_assert!(found.bound <= found.reached * 1.002, "{found:?}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, rng_seed: RngSeed::Fixed(0x666f_6f74), ..ProptestConfig::with_cases(40) })]

    #[test]
    fn the_difference_of_surfaces_holds_and_compatible_ones_share_their_knots(
        a in surfaces(), b in surfaces(),
    ) {
        let Ok(b) = b.with_domain(a.domain()) else { return Err(TestCaseError::reject("domain")) };
        let same = a.difference(&a.elevate(Direction::U, 1).unwrap()).unwrap();
        prop_assert!(same.bound <= 1e-12 * size(a.poles()), "{same:?}");
        let found = a.difference(&b).unwrap();
        let all_v = samples(a.knots_v());
        for u in samples(a.knots_u()) {
            for &v in &all_v {
                prop_assert!(gap(a.evaluate(u, v), b.evaluate(u, v)) <= found.bound);
            }
        }
        let [u, v] = found.at;
        let allowed = [&a, &b].map(moved_on_surface);
        let moved = allowed[0] * size(a.poles()) + allowed[1] * size(b.poles());
        prop_assert!(gap(a.evaluate(u, v), b.evaluate(u, v)) + moved >= found.reached);
        let shared = compatible_surfaces(&[a.clone(), b.clone()]).unwrap();
        prop_assert_eq!(shared[0].knots_u(), shared[1].knots_u());
        prop_assert_eq!(shared[0].knots_v(), shared[1].knots_v());
        same_surface(&a, &shared[0], EXACT + allowed[0] + allowed[1])?;
        same_surface(&b, &shared[1], EXACT + allowed[0] + allowed[1])?;
    }
}
