//! What fairing keeps: borders to every order, points, tangents, lengths, weights, and all but the places that were chosen.

mod shapes;

use footpoint::curve::Curve;
use footpoint::fair::{
    CurveFairing, Faired, Method, SurfaceFairing, arc_length, fair_curve, fair_surface,
};
use footpoint::index::{IndexedCurve, IndexedSurface};
use footpoint::inspect::{Continuity, HausdorffOptions, Shape, continuity, hausdorff};
use footpoint::surface::Surface;
use shapes::{Random, Vector, norm, sub};

/// A clamped cubic over uniform knots, a shallow bow with noise on its inner poles; weights near 1.
fn noisy_bow(rational: bool) -> Curve {
    let n = 30;
    let mut random = Random(17);
    let inner = (1..n - 3).map(|k| k as f64 / (n - 3) as f64);
    let knots: Vec<f64> = [0.0; 4].into_iter().chain(inner).chain([1.0; 4]).collect();
    let pole = |i: usize| {
        let x = i as f64 / (n - 1) as f64;
        let shift = if (2..n - 2).contains(&i) { 1e-3 * random.between(-1.0, 1.0) } else { 0.0 };
        [x, 0.8 * x * (1.0 - x) + shift, 0.1 * x * x]
    };
    let poles: Vec<Vector> = (0..n).map(pole).collect();
    let mut random = Random(5);
    let weights: Vec<f64> = (0..n).map(|_| random.between(0.9, 1.1)).collect();
    Curve::new(&knots, 3, &poles, rational.then_some(&weights[..])).unwrap()
}

fn assert_near(before: &Curve, faired: &Faired<Curve>, deviation: f64) {
    assert!(faired.deviation <= deviation, "{}", faired.deviation);
    assert!(faired.energies.windows(2).all(|pair| pair[1] < pair[0]), "{:?}", faired.energies);
    assert_eq!(before.weights(), faired.shape.weights());
    let (a, b) = (IndexedCurve::new(before.clone()), IndexedCurve::new(faired.shape.clone()));
    let options = HausdorffOptions { accuracy: 1e-2 * deviation, ..HausdorffOptions::default() };
    let found =
        hausdorff(Shape::Curve(&a), Shape::Curve(&b), &options, &mut || false).unwrap().bounds();
    // The shapes are no farther apart than the points of the same parameters.
    assert!(found[0] <= faired.deviation, "{found:?} {}", faired.deviation);
    assert!(found[1] <= deviation * 1.02, "{found:?}");
}

#[test]
fn curves_keep_what_is_asked_with_every_energy() {
    for rational in [false, true] {
        let curve = noisy_bow(rational);
        let length = arc_length(&curve, 1e-10);
        let plain = CurveFairing {
            strain: 0.0,
            ends: [2, 3],
            fixed: vec![9],
            through: vec![0.45, 0.7],
            length: Some([0.999 * length, length]),
            ..CurveFairing::new(2e-3)
        };
        let kinds = [
            ("strain", CurveFairing { strain: 1.0, ..plain.clone() }),
            ("jerk", CurveFairing { jerk: 1.0, ..plain.clone() }),
            ("slope", CurveFairing { slope: 1.0, ..plain.clone() }),
            ("mixed", CurveFairing { strain: 1.0, slope: 1e-2, distance: 1.0, ..plain }),
        ];
        for (name, fairing) in kinds {
            let faired = fair_curve(&curve, &fairing, &mut || false).unwrap();
            assert_near(&curve, &faired, 2e-3);
            let fall = faired.energies[0] / faired.energies.last().unwrap();
            // The length holds back what would make the curve longer, and no more than that.
            let longer = CurveFairing { length: None, ..fairing.clone() };
            let free = fair_curve(&curve, &longer, &mut || false).unwrap();
            let most = free.energies[0] / free.energies.last().unwrap();
            println!("rational {rational} {name}: energy / {fall:.2}, of any length / {most:.2}");
            assert!(fall > 1.02 && fall > 0.8 * most, "{name} {fall} {most}");
            assert_eq!(curve.poles()[9], faired.shape.poles()[9]);
            for (u, order) in [(0.0, 1), (1.0, 2), (0.45, 0), (0.7, 0)] {
                let mut d = [[[0.0; 3]; 3]; 2];
                curve.derivatives(u, 2, &mut d[0]);
                faired.shape.derivatives(u, 2, &mut d[1]);
                for k in 0..=order {
                    let gap = norm(sub(d[0][k], d[1][k]));
                    assert!(gap <= 1e-9 * (1.0 + norm(d[0][k])), "{name} {u} {k} {gap}");
                }
            }
            let after = arc_length(&faired.shape, 1e-10);
            let allowed = 0.999 * length * (1.0 - 1e-8)..=length * (1.0 + 1e-8);
            assert!(allowed.contains(&after), "{name} {after}");
        }
    }
}

#[test]
fn local_methods_work_at_chosen_places_and_nowhere_else() {
    for rational in [false, true] {
        let curve = noisy_bow(rational);
        let t = curve.knots().values();
        // Knots far from each other: what is done at one says nothing at the other.
        let knots = vec![t[8], t[20]];
        for method in [Method::Local, Method::KnotRemoval] {
            let fairing = CurveFairing {
                method,
                strain: 0.0,
                jerk: 1.0,
                knots: knots.clone(),
                ..CurveFairing::new(2e-3)
            };
            let faired = fair_curve(&curve, &fairing, &mut || false).unwrap();
            assert_near(&curve, &faired, 2e-3);
            let pairs = curve.poles().iter().zip(faired.shape.poles());
            let moved: Vec<usize> =
                pairs.enumerate().filter(|(_, (a, b))| a != b).map(|(i, _)| i).collect();
            // The pole in the middle of the jump at knot t[k] of a cubic over uniform knots is number k - 2.
            assert_eq!(moved, [6, 18], "{method:?} rational {rational}");
            let jump = |curve: &Curve, u: f64| {
                let mut d = [[[0.0; 3]; 4]; 2];
                curve.derivatives_on(u, footpoint::knots::Side::Below, 3, &mut d[0]);
                curve.derivatives_on(u, footpoint::knots::Side::Above, 3, &mut d[1]);
                norm(sub(d[0][3], d[1][3]))
            };
            for &u in &knots {
                let [before, after] = [&curve, &faired.shape].map(|curve| jump(curve, u));
                println!(
                    "{method:?} rational {rational}: jump at {u:.3} {before:.3} -> {after:.3}"
                );
                assert!(after < 0.7 * before, "{method:?} {u} {before} {after}");
                // Farin and Sapidis: as if the knot were removed.
                let vanishes = after < 1e-9 * before;
                assert!(method == Method::Local || vanishes, "{u} {before} {after}");
            }
        }
    }
}

/// A patch of a bowl over [0, 2] x [0, 1] with waves on its inner poles, as two halves that meet with all derivatives.
fn noisy_halves(rational: bool) -> [Surface; 2] {
    let n = 14;
    let mut random = Random(23);
    let inner: Vec<f64> = (1..n - 3).map(|k| k as f64 / (n - 3) as f64).collect();
    let knots: Vec<f64> = [vec![0.0; 4], inner, vec![1.0; 4]].concat();
    let greville = |i: usize| knots[i + 1..i + 4].iter().sum::<f64>() / 3.0;
    let (mut poles, mut weights) = (Vec::new(), Vec::new());
    for k in 0..n * n {
        let (x, y) = (2.0 * greville(k / n), greville(k % n));
        poles.push([x, y, 0.1 * x * x + 0.2 * y * y + 1e-3 * random.between(-1.0, 1.0)]);
        weights.push(random.between(0.95, 1.05));
    }
    let weights = rational.then_some(&weights[..]);
    let whole = Surface::new(&knots, &knots, 3, 3, &poles, n, n, weights).unwrap();
    let (left, right) = whole.split_u(5.0 / 11.0).unwrap();
    [left, right]
}

/// How the halves meet when the right one has been faired and kept `order` along its left border, which they share.
fn meet(rational: bool, order: usize) -> Continuity {
    let [left, right] = noisy_halves(rational);
    let fairing = SurfaceFairing { borders: [order, 0, 0, 0], ..SurfaceFairing::new(2e-3) };
    let faired = fair_surface(&right, &fairing, &mut || false).unwrap();
    assert!(faired.deviation <= 2e-3 && faired.energies.len() > 1);
    assert!(faired.energies.windows(2).all(|pair| pair[1] < pair[0]), "{:?}", faired.energies);
    let fall = faired.energies[0] / faired.energies.last().unwrap();
    let (left, right) = (IndexedSurface::new(left), IndexedSurface::new(faired.shape));
    let found = continuity(&left, 1, &right, 0, &mut || false).unwrap();
    println!("rational {rational}, order {order}: energy / {fall:.2}, {found:?}");
    found
}

#[test]
fn a_border_kept_g0_has_no_gap_but_its_normals_turn() {
    for rational in [false, true] {
        let found = meet(rational, 1);
        assert!(found.gap.lower < 1e-12 && found.gap.upper < 1e-5, "{found:?}");
        assert!(found.angle.lower > 1e-4, "{found:?}");
    }
}

#[test]
fn a_border_kept_g1_has_the_same_normals_but_its_curvature_jumps() {
    for rational in [false, true] {
        let found = meet(rational, 2);
        assert!(found.gap.lower < 1e-12 && found.gap.upper < 1e-5, "{found:?}");
        assert!(found.angle.lower < 1e-7 && found.angle.upper < 5e-3, "{found:?}");
        assert!(found.curvature.lower > 1e-2, "{found:?}");
    }
}

#[test]
fn a_border_kept_g2_has_the_same_curvature() {
    for rational in [false, true] {
        let found = meet(rational, 3);
        assert!(found.gap.lower < 1e-12 && found.gap.upper < 1e-5, "{found:?}");
        assert!(found.angle.lower < 1e-7 && found.angle.upper < 5e-3, "{found:?}");
        assert!(found.curvature.lower < 1e-7 && found.curvature.upper < 0.1, "{found:?}");
    }
}

#[test]
fn a_border_that_is_not_kept_opens() {
    let found = meet(false, 0);
    assert!(found.gap.lower > 1e-5, "{found:?}");
}

#[test]
fn energies_near_the_least_number_move_nothing_out_of_bounds() {
    let (curve, [surface, _]) = (noisy_bow(false), noisy_halves(false));
    for method in [Method::Energy, Method::Local, Method::KnotRemoval] {
        for weight in [1e-320, 1e-300, 1e-160] {
            let fairing = CurveFairing { method, strain: weight, ..CurveFairing::new(2e-3) };
            let faired = fair_curve(&curve, &fairing, &mut || false).unwrap();
            let fairing = SurfaceFairing { method, plate: weight, ..SurfaceFairing::new(2e-3) };
            let other = fair_surface(&surface, &fairing, &mut || false).unwrap();
            for (deviation, energies) in
                [(faired.deviation, faired.energies), (other.deviation, other.energies)]
            {
                assert!(deviation <= 2e-3, "{method:?} {weight} {deviation}");
                assert!(energies.windows(2).all(|pair| pair[1] < pair[0]), "{energies:?}");
            }
            let pairs =
                [(curve.poles(), faired.shape.poles()), (surface.poles(), other.shape.poles())];
            for (a, b) in pairs.iter().flat_map(|(a, b)| a.iter().zip(*b)) {
                assert!(norm(sub(*a, *b)) < 0.1, "{method:?} {weight} {b:?}");
            }
        }
    }
}
