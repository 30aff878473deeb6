//! Fairing of noisy data of smooth shapes: the energy falls, inflections vanish, the deviation holds.

mod shapes;

use footpoint::curve::Curve;
use footpoint::fair::{
    CurveFairing, Faired, Method, SurfaceFairing, arc_length, fair_curve, fair_surface,
};
use footpoint::fit;
use footpoint::index::IndexedCurve;
use footpoint::inspect::{Trend, inflections, monotone_pieces, turn_count};
use footpoint::surface::Surface;
use shapes::{Random, Vector, norm, sub};

const UP: Vector = [0.0, 0.0, 1.0];

/// The contour of the aerofoil NACA 0012 from the upper trailing edge around the nose to the lower one, z = 0.
fn aerofoil(count: usize, noise: f64, random: &mut Random) -> Vec<Vector> {
    let point = |k: usize| {
        let angle = std::f64::consts::PI * (2.0 * k as f64 / (count - 1) as f64 - 1.0);
        let x = 0.5 * (1.0 - angle.cos());
        let thick = 0.6
            * (0.2969 * x.sqrt() - 0.126 * x - 0.3516 * x * x + 0.2843 * x.powi(3)
                - 0.1015 * x.powi(4));
        [x, if angle < 0.0 { thick } else { -thick }, 0.0]
    };
    let mut points: Vec<Vector> = (0..count).map(point).collect();
    for p in &mut points[1..count - 1] {
        p[0] += noise * random.between(-1.0, 1.0);
        p[1] += noise * random.between(-1.0, 1.0);
    }
    points
}

fn interpolated(points: &[Vector]) -> Curve {
    let parameters = fit::parameters(fit::Spacing::Centripetal, points).unwrap();
    fit::interpolate(3, &parameters, points).unwrap().spline.curve().unwrap()
}

fn noisy_aerofoil() -> Curve {
    interpolated(&aerofoil(61, 1e-4, &mut Random(7)))
}

fn turns(curve: &Curve) -> usize {
    turn_count(&IndexedCurve::new(curve.clone()), UP).unwrap()
}

/// What holds whatever is asked for.
fn assert_laws(before: &Curve, faired: &Faired<Curve>, deviation: f64) {
    assert!(faired.deviation <= deviation, "{}", faired.deviation);
    assert!(faired.energies.windows(2).all(|pair| pair[1] <= pair[0]), "{:?}", faired.energies);
    let (start, end) = before.domain();
    for k in 0..=1000 {
        let u = start + (end - start) * k as f64 / 1000.0;
        let gap = norm(sub(before.evaluate(u), faired.shape.evaluate(u)));
        assert!(gap <= faired.deviation, "{u} {gap} {}", faired.deviation);
    }
    assert_eq!(before.knots(), faired.shape.knots());
    assert_eq!(before.weights(), faired.shape.weights());
}

fn factor<T>(faired: &Faired<T>) -> f64 {
    faired.energies[0] / faired.energies.last().unwrap()
}

/// Every energy that is offered, by its name.
fn energies(deviation: f64) -> Vec<(&'static str, CurveFairing)> {
    let plain = CurveFairing { ends: [1; 2], strain: 0.0, ..CurveFairing::new(deviation) };
    let by_length = CurveFairing { by_length: true, ..plain.clone() };
    vec![
        ("strain", CurveFairing { strain: 1.0, ..plain.clone() }),
        ("jerk", CurveFairing { jerk: 1.0, ..plain.clone() }),
        ("mixed", CurveFairing { strain: 1.0, jerk: 1e-2, ..plain.clone() }),
        ("slope", CurveFairing { slope: 1.0, ..plain }),
        ("strain by length", CurveFairing { strain: 1.0, ..by_length.clone() }),
        ("jerk by length", CurveFairing { jerk: 1.0, ..by_length }),
    ]
}

/// Half the waterline of a hull, and the section of a bumper: two bends of one sense.
fn drawn(name: &str, noise: f64) -> Vec<Vector> {
    let mut random = Random(3);
    let point = |k: usize| {
        let x = k as f64 / 40.0;
        let shift = if k == 0 || k == 40 { 0.0 } else { noise * random.between(-1.0, 1.0) };
        let y = match name {
            "waterline" => 0.4 * x * (1.0 - x),
            _ => 0.3 - 0.9 * (x - 0.5).powi(2) - 3.0 * (x - 0.5).powi(4),
        };
        [x, y + shift, 0.0]
    };
    (0..=40).map(point).collect()
}

#[test]
fn inflections_that_the_original_has_not_vanish_with_every_energy() {
    // The aerofoil, the waterline and the bumper have none.
    let shapes = [
        ("aerofoil", aerofoil(61, 1e-4, &mut Random(7)), aerofoil(61, 0.0, &mut Random(7)), 3e-4),
        ("waterline", drawn("waterline", 2e-4), drawn("waterline", 0.0), 6e-4),
        ("bumper", drawn("bumper", 1.2e-3), drawn("bumper", 0.0), 3.6e-3),
    ];
    let mut wrong = Vec::new();
    for (shape, noisy, smooth, deviation) in &shapes {
        let (curve, smooth) = (&interpolated(noisy), interpolated(smooth));
        let before = turns(curve);
        let pieces =
            |curve: &Curve| monotone_pieces(&IndexedCurve::new(curve.clone())).unwrap().len();
        for (name, fairing) in energies(*deviation) {
            let start = std::time::Instant::now();
            let faired = fair_curve(curve, &fairing, &mut || false).unwrap();
            let time = start.elapsed().as_secs_f64() * 1e3;
            assert_laws(curve, &faired, *deviation);
            let by_length = fairing.by_length;
            let one = CurveFairing { steps: 1, calm: false, ..fairing };
            let true_energy = fair_curve(&smooth, &one, &mut || false).unwrap().energies[0];
            let [first, last] =
                [0, faired.energies.len() - 1].map(|k| faired.energies[k] / true_energy);
            println!(
                "{shape:9} {name:16} inflections {before} -> {}, energy over the true one {first:9.3} -> {last:.3}, deviation {:.2e}, steps {:2}, monotone pieces {} -> {}, {time:.0} ms",
                turns(&faired.shape),
                faired.deviation,
                faired.energies.len() - 1,
                pieces(curve),
                pieces(&faired.shape)
            );
            // By the arc length of the wavy curve energies are not those of the original.
            let most = if by_length { 0.95 * first } else { 1.02f64.min(0.98 * first) };
            if before < 10 || turns(&faired.shape) > 0 || last > most {
                let places = inflections(&IndexedCurve::new(faired.shape), UP).unwrap();
                wrong.push(format!("{shape} {name}: {first} {last} {places:?}"));
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn an_inflection_of_the_original_stays_one() {
    let mut random = Random(9);
    let point = |k: usize| {
        let x = k as f64 / 40.0;
        let shift = if k == 0 || k == 40 { 0.0 } else { 2e-4 * random.between(-1.0, 1.0) };
        [x, 0.05 * (std::f64::consts::TAU * x).sin() + shift, 0.0]
    };
    let curve = interpolated(&(0..=40).map(point).collect::<Vec<_>>());
    assert!(turns(&curve) >= 10);
    let mut wrong = Vec::new();
    for (name, fairing) in energies(6e-4) {
        let faired = fair_curve(&curve, &fairing, &mut || false).unwrap();
        assert_laws(&curve, &faired, 6e-4);
        if turns(&faired.shape) != 1 {
            let places = inflections(&IndexedCurve::new(faired.shape), UP).unwrap();
            wrong.push(format!("{name}: {places:?}"));
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn the_slope_of_the_curvature_is_as_small_as_a_minimum() {
    let curve = interpolated(&drawn("waterline", 2e-4));
    let fairing = CurveFairing {
        slope: 1.0,
        strain: 0.0,
        ends: [1; 2],
        steps: 400,
        calm: false,
        ..CurveFairing::new(6e-4)
    };
    let faired = fair_curve(&curve, &fairing, &mut || false).unwrap();
    assert_laws(&curve, &faired, 6e-4);
    // The energy of the log is the integral of (dk/ds)^2, by differences of curvatures along the curve.
    let shape = &faired.shape;
    let (start, end) = shape.domain();
    let bend = |u: f64| footpoint::inspect::tooth(shape, u, footpoint::knots::Side::Above);
    let n = 40_000;
    let mut sum = 0.0;
    for k in 0..n {
        let [a, b] = [k, k + 1].map(|k| bend(start + (end - start) * k as f64 / n as f64));
        let length = norm(sub(b.point, a.point));
        if length > 0.0 {
            sum += (b.curvature - a.curvature).powi(2) / length;
        }
    }
    let last = *faired.energies.last().unwrap();
    assert!((sum - last).abs() < 0.01 * last, "{sum} {last}");
    // Of a wide tolerance the minimum is a circle: no slope at all.
    let wide = CurveFairing { ends: [1; 2], ..CurveFairing { deviation: 0.5, ..fairing } };
    let faired = fair_curve(&curve, &wide, &mut || false).unwrap();
    let (first, last) = (faired.energies[0], *faired.energies.last().unwrap());
    assert!(last < 1e-6 * first, "{first} {last}");
}

#[test]
fn local_methods_obey_the_same_laws() {
    let curve = noisy_aerofoil();
    for method in [Method::Local, Method::KnotRemoval] {
        let deviation = 3e-4;
        let (strain, jerk, ends) = (0.0, 1.0, [1; 2]);
        let fairing = CurveFairing { method, strain, jerk, ends, ..CurveFairing::new(deviation) };
        let faired = fair_curve(&curve, &fairing, &mut || false).unwrap();
        assert_laws(&curve, &faired, deviation);
        println!(
            "{method:?}: inflections {} -> {}, energy / {:.1}, deviation {:.2e}, steps {}",
            turns(&curve),
            turns(&faired.shape),
            factor(&faired),
            faired.deviation,
            faired.energies.len() - 1
        );
        assert!(turns(&faired.shape) <= turns(&curve) / 2);
    }
}

#[test]
fn what_is_to_be_kept_is_kept() {
    let curve = noisy_aerofoil();
    let deviation = 3e-4;
    let length = arc_length(&curve, 1e-10);
    let fairing = CurveFairing {
        ends: [3, 1],
        fixed: vec![20],
        through: vec![0.4, 0.61],
        length: Some([length * 0.9995, length]),
        jerk: 1e-3,
        ..CurveFairing::new(deviation)
    };
    let faired = fair_curve(&curve, &fairing, &mut || false).unwrap();
    assert_laws(&curve, &faired, deviation);
    assert!(factor(&faired) > 1.02, "{}", factor(&faired));
    assert_eq!(curve.poles()[20], faired.shape.poles()[20]);
    let mut d = [[[0.0; 3]; 3]; 2];
    curve.derivatives(0.0, 2, &mut d[0]);
    faired.shape.derivatives(0.0, 2, &mut d[1]);
    for k in 0..3 {
        assert!(norm(sub(d[0][k], d[1][k])) <= 1e-9 * (1.0 + norm(d[0][k])));
    }
    for u in [1.0, 0.4, 0.61] {
        let gap = norm(sub(curve.evaluate(u), faired.shape.evaluate(u)));
        assert!(gap < 1e-11, "{u} {gap}");
    }
    let after = arc_length(&faired.shape, 1e-10);
    assert!(after <= length * (1.0 + 1e-8) && after >= length * 0.9995 * (1.0 - 1e-8));
    // Chosen knots only: other poles than those in the middle of their jumps stay.
    let chosen = curve.knots().values()[10];
    let fairing = CurveFairing {
        method: Method::KnotRemoval,
        knots: vec![chosen],
        ..CurveFairing::new(deviation)
    };
    let faired = fair_curve(&curve, &fairing, &mut || false).unwrap();
    let moved = curve.poles().iter().zip(faired.shape.poles()).filter(|(a, b)| a != b).count();
    assert_eq!(moved, 1);
}

#[test]
fn rational_and_closed_curves_stay_rational_and_closed() {
    // A circle of eight quadratic-like cubic spans with noise: periodic knots, weights near 1.
    let mut random = Random(11);
    let n = 24;
    let pole = |k: usize, noise: &[Vector]| {
        let angle = std::f64::consts::TAU * k as f64 / n as f64;
        let [x, y, z] = noise[k % n];
        [angle.cos() + x, angle.sin() + y, z]
    };
    let noise: Vec<Vector> = (0..n).map(|_| random.vector().map(|x| 4e-3 * x)).collect();
    let weight: Vec<f64> = (0..n).map(|_| random.between(0.9, 1.1)).collect();
    let poles: Vec<Vector> = (0..n + 3).map(|k| pole(k % n, &noise)).collect();
    let weights: Vec<f64> = (0..n + 3).map(|k| weight[k % n]).collect();
    let knots: Vec<f64> = (0..n + 7).map(|k| k as f64 - 3.0).collect();
    let curve = Curve::new(&knots, 3, &poles, Some(&weights)).unwrap();
    for method in [Method::Energy, Method::Local, Method::KnotRemoval] {
        let fairing = CurveFairing { method, jerk: 0.5, ..CurveFairing::new(0.01) };
        let faired = fair_curve(&curve, &fairing, &mut || false).unwrap();
        assert_laws(&curve, &faired, 0.01);
        let poles = faired.shape.poles();
        assert_eq!(poles[..3], poles[n..]);
        println!("{method:?}: energy / {:.2}", factor(&faired));
        assert!(factor(&faired) > 1.05, "{method:?} {}", factor(&faired));
    }
}

#[test]
fn monotone_pieces_cover_the_curve_and_agree_with_samples() {
    let curve = IndexedCurve::new(noisy_aerofoil());
    let pieces = monotone_pieces(&curve).unwrap();
    let (start, end) = curve.curve().domain();
    assert_eq!((pieces[0].u[0], pieces[pieces.len() - 1].u[1]), (start, end));
    assert!(pieces.windows(2).all(|pair| pair[0].u[1] == pair[1].u[0]));
    for piece in &pieces {
        let sample = |k: usize| {
            let u = piece.u[0] + (piece.u[1] - piece.u[0]) * k as f64 / 20.0;
            footpoint::inspect::tooth(curve.curve(), u, footpoint::knots::Side::Above).curvature
        };
        let values: Vec<f64> = (0..20).map(sample).collect();
        for pair in values.windows(2) {
            let slack = 1e-9 * pair[0].max(pair[1]);
            match piece.trend {
                Trend::Rising => assert!(pair[1] >= pair[0] - slack, "{piece:?}"),
                Trend::Falling => assert!(pair[1] <= pair[0] + slack, "{piece:?}"),
                _ => {}
            }
        }
    }
}

#[test]
fn a_cubic_has_its_inflection_where_its_formula_says() {
    // y = x^3 - x on [-1, 2]: one inflection, at x = 0.
    let poles = [[-1.0, 0.0, 0.0], [0.0, 2.0, 0.0], [1.0, -5.0, 0.0], [2.0, 6.0, 0.0]];
    let curve = Curve::new(&[-1., -1., -1., -1., 2., 2., 2., 2.], 3, &poles, None).unwrap();
    let found = inflections(&IndexedCurve::new(curve), UP).unwrap();
    assert_eq!(found.len(), 1, "{found:?}");
    assert!(found[0].changes && found[0].u.abs() < 1e-9, "{found:?}");
}

/// A height field over the unit square with noise on its poles.
fn noisy_surface(n: usize, noise: f64, height: impl Fn(f64, f64) -> f64) -> Surface {
    let mut random = Random(5);
    let inner: Vec<f64> = (1..n - 3).map(|k| k as f64 / (n - 3) as f64).collect();
    let knots: Vec<f64> = [vec![0.0; 4], inner, vec![1.0; 4]].concat();
    let greville = |i: usize| knots[i + 1..i + 4].iter().sum::<f64>() / 3.0;
    let mut poles = Vec::new();
    for i in 0..n {
        for j in 0..n {
            let (u, v) = (greville(i), greville(j));
            let inside = (2..n - 2).contains(&i) && (2..n - 2).contains(&j);
            let shift = if inside { noise * random.between(-1.0, 1.0) } else { 0.0 };
            poles.push([u, v, height(u, v) + shift]);
        }
    }
    Surface::new(&knots, &knots, 3, 3, &poles, n, n, None).unwrap()
}

/// How often isocurves change the side to which they bend, seen from above: thirty each way.
fn isocurve_turns(surface: &Surface) -> usize {
    let mut turns = 0;
    for along_u in [true, false] {
        for i in 0..30 {
            let mut before = 0.0;
            for j in 0..300 {
                let (a, b) = ((i as f64 + 0.5) / 30.0, (j as f64 + 0.5) / 300.0);
                let mut d = [[0.0; 3]; 6];
                if along_u {
                    surface.partials(b, a, 2, &mut d);
                } else {
                    surface.partials(a, b, 2, &mut d);
                }
                let normal = shapes::cross(d[1], d[2]);
                let bend = shapes::dot(normal, if along_u { d[3] } else { d[5] });
                turns += usize::from(bend * before < 0.0);
                before = bend;
            }
        }
    }
    turns
}

#[test]
fn noisy_surfaces_get_fairer_within_the_deviation() {
    // Wigley's hull, and a bumper: a bent strip.
    let hull = |u: f64, v: f64| 0.1 * (1.0 - (2.0 * u - 1.0).powi(2)) * (1.0 - v * v);
    let bumper = |u: f64, v: f64| {
        -0.4 * (u - 0.5).powi(4) - 0.15 * (v - 0.4).powi(2) - 0.1 * (u - 0.5).powi(2)
    };
    let shapes = [
        ("hull", noisy_surface(16, 1e-3, hull), noisy_surface(16, 0.0, hull)),
        ("bumper", noisy_surface(20, 1e-3, bumper), noisy_surface(20, 0.0, bumper)),
    ];
    for (name, surface, smooth) in shapes {
        let (before, original) = (isocurve_turns(&surface), isocurve_turns(&smooth));
        let deviation = 2e-3;
        let new = SurfaceFairing::new(deviation);
        let kinds = [
            ("thin plate", new.clone()),
            ("third derivatives", SurfaceFairing { plate: 0.0, jerk: 1.0, ..new.clone() }),
            ("mixed", SurfaceFairing { jerk: 1e-2, ..new.clone() }),
            ("one pole at a time", SurfaceFairing { method: Method::Local, ..new.clone() }),
            ("knot lines", SurfaceFairing { method: Method::KnotRemoval, ..new }),
        ];
        for (kind, fairing) in kinds {
            let method = fairing.method;
            let start = std::time::Instant::now();
            let faired = fair_surface(&surface, &fairing, &mut || false).unwrap();
            println!(
                "{name} {kind}: turns of isocurves {before} -> {} ({original}), energy {:.3e} / {:.1}, deviation {:.2e}, steps {}, {:.0} ms",
                isocurve_turns(&faired.shape),
                faired.energies[0],
                factor(&faired),
                faired.deviation,
                faired.energies.len() - 1,
                start.elapsed().as_secs_f64() * 1e3
            );
            assert!(before > 100 && original == 0, "{before} {original}");
            assert!(
                method != Method::Energy || isocurve_turns(&faired.shape) == 0,
                "{name} {kind}"
            );
            assert!(faired.deviation <= deviation);
            assert!(faired.energies.windows(2).all(|pair| pair[1] <= pair[0]));
            let none = SurfaceFairing { borders: [3; 4], ..fairing };
            let least = fair_surface(&smooth, &none, &mut || false).unwrap().energies[0];
            let (first, last) = (faired.energies[0], faired.energies.last().unwrap());
            println!(
                "    energy over that of the smooth one: {:.3} -> {:.3}",
                first / least,
                last / least
            );
            match method {
                Method::KnotRemoval => assert!(factor(&faired) > 50.0, "{}", factor(&faired)),
                _ => {
                    assert!(*last < 1.02 * least && first > 1.05 * least, "{first} {last} {least}")
                }
            }
            for i in 0..=20 {
                for j in 0..=20 {
                    let (u, v) = (i as f64 / 20.0, j as f64 / 20.0);
                    let mut d = [[[0.0; 3]; 3]; 2];
                    surface.partials(u, v, 1, &mut d[0]);
                    faired.shape.partials(u, v, 1, &mut d[1]);
                    assert!(norm(sub(d[0][0], d[1][0])) <= faired.deviation);
                    if i % 20 == 0 || j % 20 == 0 {
                        assert!((0..3).all(|k| norm(sub(d[0][k], d[1][k])) < 1e-12));
                    }
                }
            }
        }
    }
}

#[test]
fn only_the_region_of_a_surface_changes() {
    let surface = noisy_surface(16, 1e-3, |u, v| u * v);
    let region = [0.2, 0.7, 0.3, 0.9];
    let fairing =
        SurfaceFairing { region: Some(region), borders: [0; 4], ..SurfaceFairing::new(2e-3) };
    let faired = fair_surface(&surface, &fairing, &mut || false).unwrap();
    let mut changed = 0;
    for i in 0..=50 {
        for j in 0..=50 {
            let (u, v) = (i as f64 / 50.0, j as f64 / 50.0);
            let gap = norm(sub(surface.evaluate(u, v), faired.shape.evaluate(u, v)));
            let inside = region[0] < u && u < region[1] && region[2] < v && v < region[3];
            assert!(inside || gap < 1e-15, "{u} {v} {gap}");
            changed += usize::from(gap > 1e-6);
        }
    }
    assert!(changed > 100);
}

#[test]
fn nonsense_is_refused_by_name() {
    let curve = noisy_aerofoil();
    let refused = |change: &dyn Fn(&mut CurveFairing)| {
        let mut fairing = CurveFairing::new(1e-3);
        change(&mut fairing);
        fair_curve(&curve, &fairing, &mut || false).unwrap_err().to_string()
    };
    assert!(refused(&|f| f.deviation = 0.0).starts_with("deviation: 0 given"));
    assert!(refused(&|f| f.deviation = f64::NAN).starts_with("deviation: NaN"));
    assert!(refused(&|f| f.jerk = -1.0).starts_with("jerk: -1 given"));
    assert!(refused(&|f| f.fixed = vec![3, 999]).starts_with("fixed: entry 1 is pole 999"));
    assert!(refused(&|f| f.through = vec![0.5, f64::NAN]).starts_with("through: entry 1"));
    assert!(refused(&|f| f.ends = [4, 0]).starts_with("ends: entry 0"));
    assert!(refused(&|f| f.length = Some([9.0, 10.0])).starts_with("length: the curve has"));
    assert!(refused(&|f| f.knots = vec![0.123]).starts_with("knots: entry 0"));
    assert!(refused(&|f| f.strain = 0.0).starts_with("strain:"));
    let stopped = fair_curve(&curve, &CurveFairing::new(1e-3), &mut || true);
    assert_eq!(stopped.unwrap_err().to_string(), "cancelled by should_stop");
}

/// The figures of docs/fairing.md: `FOOTPOINT_LIST=1 cargo test --release --test fairing large_surfaces -- --nocapture`.
#[test]
fn large_surfaces_take_the_time_that_is_told() {
    if std::env::var_os("FOOTPOINT_LIST").is_none() {
        return;
    }
    for n in [24, 50, 100, 200] {
        let surface =
            noisy_surface(n, 1e-3, |u, v| 0.1 * (1.0 - (2.0 * u - 1.0).powi(2)) * (1.0 - v * v));
        for method in [Method::Energy, Method::Local, Method::KnotRemoval] {
            let start = std::time::Instant::now();
            let fairing = SurfaceFairing { method, ..SurfaceFairing::new(2e-3) };
            let faired = fair_surface(&surface, &fairing, &mut || false).unwrap();
            println!(
                "{n} x {n} {method:?}: energy / {:.2}, deviation {:.2e}, steps {}, {:.2} s",
                factor(&faired),
                faired.deviation,
                faired.energies.len() - 1,
                start.elapsed().as_secs_f64()
            );
        }
    }
}
