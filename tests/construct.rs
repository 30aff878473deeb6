//! Constructions against closed forms.

use footpoint::construct::*;
use footpoint::curve::Curve;
use footpoint::elementary::{Axes, CircleForm};
use footpoint::surface::Surface;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

type Vector = [f64; 3];

/// Relative to shapes of size about 1 to 10.
const EXACT: f64 = 1e-13;

fn sub(a: Vector, b: Vector) -> Vector {
    [0, 1, 2].map(|k| a[k] - b[k])
}

fn dot(a: Vector, b: Vector) -> f64 {
    (0..3).map(|k| a[k] * b[k]).sum()
}

fn gap(a: Vector, b: Vector) -> f64 {
    dot(sub(a, b), sub(a, b)).sqrt()
}

/// Axes that are nobody's favourites.
fn tilted() -> Axes {
    Axes::around([1.0, -2.0, 0.5], [0.3, 0.4, 1.2], [1.0, 0.2, 0.1]).unwrap()
}

fn local(axes: &Axes, p: Vector) -> Vector {
    let d = sub(p, axes.origin);
    [dot(d, axes.x), dot(d, axes.y), dot(d, axes.z)]
}

fn samples(curve: &Curve) -> Vec<Vector> {
    let (a, b) = curve.domain();
    (0..=200).map(|i| curve.evaluate(a + (b - a) * i as f64 / 200.0)).collect()
}

fn grid(surface: &Surface) -> Vec<Vector> {
    let [u0, u1, v0, v1] = surface.domain();
    let at = |k: usize, a: f64, b: f64| a + (b - a) * k as f64 / 23.0;
    (0..576).map(|k| surface.evaluate(at(k / 24, u0, u1), at(k % 24, v0, v1))).collect()
}

#[test]
fn every_form_of_a_circle_is_the_circle() {
    let axes = tilted();
    let quadratic = |n| ArcForm::Quadratic(CircleForm::Arcs(n));
    let halves = ArcForm::Quadratic(CircleForm::Halves);
    let cases = [
        ([0.0, TAU], quadratic(4), 9, 2),
        ([0.0, TAU], quadratic(3), 7, 2),
        ([0.0, TAU], halves, 7, 2),
        ([0.0, TAU], ArcForm::Quintic, 6, 5),
        ([1.0, 1.0 + TAU], ArcForm::Quintic, 6, 5),
        ([0.0, PI], halves, 4, 2),
        ([0.0, PI], quadratic(2), 5, 2),
        ([0.0, PI], ArcForm::Cubic, 4, 3),
        ([0.3, 0.3 + 3.9], ArcForm::Cubic, 4, 3),
        ([0.4, 1.9], ArcForm::Cubic, 4, 3),
        ([-0.4, 1.2], quadratic(1), 3, 2),
        ([-0.4, 4.9], ArcForm::usual(5.3), 9, 2),
    ];
    for (angles, form, poles, degree) in cases {
        let curve = arc(&axes, 2.5, angles, form).unwrap();
        assert_eq!((curve.poles().len(), curve.degree()), (poles, degree), "{form:?}");
        let mut before = angles[0];
        for (i, p) in samples(&curve).into_iter().enumerate() {
            let [x, y, z] = local(&axes, p);
            assert!((x.hypot(y) - 2.5).abs() < EXACT * 2.5 && z.abs() < EXACT, "{form:?}");
            // The angle grows, from the first to the last.
            let mut angle = y.atan2(x);
            while angle < before - 1e-9 {
                angle += TAU;
            }
            assert!(angle - before < 0.2, "{form:?}: {before} {angle} at {i}");
            before = angle;
        }
        assert!((before - angles[1]).abs() < 1e-7, "{form:?}");
    }
    let refused = |angles, form| arc(&axes, 1.0, angles, form).unwrap_err().to_string();
    assert!(refused([0.0, 4.5], ArcForm::Cubic).contains("form"));
    assert!(refused([0.0, 4.5], ArcForm::Quintic).contains("form"));
    assert!(refused([0.0, 7.0], quadratic(4)).contains("angles"));
    assert!(refused([1.0, 1.0], quadratic(4)).contains("angles"));
    assert!(circle(&axes, -1.0, quadratic(4)).unwrap_err().to_string().contains("radius"));
}

#[test]
fn conics_satisfy_their_equations() {
    let axes = tilted();
    let points = |curve: &Curve| -> Vec<Vector> {
        samples(curve).into_iter().map(|p| local(&axes, p)).collect()
    };
    for form in [ArcForm::usual(TAU), ArcForm::Quintic] {
        let curve = ellipse(&axes, [3.0, 1.25], [0.0, TAU], form).unwrap();
        for [x, y, z] in points(&curve) {
            assert!(((x / 3.0).hypot(y / 1.25) - 1.0).abs() < EXACT && z.abs() < EXACT);
        }
        assert!(curve.is_closed());
    }
    let curve = parabola(&axes, 0.7, [-1.0, 2.0]).unwrap();
    for ([x, y, z], i) in points(&curve).into_iter().zip(0..) {
        assert!((x - y * y / 2.8).abs() < EXACT * 4.0 && z.abs() < EXACT);
        assert!((y - (-1.0 + 3.0 * i as f64 / 200.0)).abs() < EXACT * 4.0);
    }
    let curve = hyperbola(&axes, [1.5, 0.8], [-0.7, 1.4]).unwrap();
    for [x, y, z] in points(&curve) {
        assert!(
            ((x / 1.5).powi(2) - (y / 0.8).powi(2) - 1.0).abs() < EXACT * 10.0 && z.abs() < EXACT
        );
    }
    let ends = [points(&curve)[0], points(&curve)[200]];
    assert!(
        (ends[0][1] / 0.8 - (-0.7f64).sinh()).abs() < EXACT
            && (ends[1][1] / 0.8 - 1.4f64.sinh()).abs() < EXACT * 4.0
    );
    let b = [[0.0, 0.0, 0.0], [1.0, 2.0, 0.0], [3.0, 0.0, 1.0]];
    let middle = conic_arc(b, 0.4).unwrap().evaluate(0.5);
    let chord = [1.5, 0.0, 0.5];
    assert!(gap(middle, [0, 1, 2].map(|k| 0.6 * chord[k] + 0.4 * b[1][k])) < EXACT);
    assert!(conic_arc(b, 1.0).is_err() && line(b[0], b[0]).is_err());
    assert_eq!(line([0.0; 3], [0.0, 3.0, 4.0]).unwrap().evaluate(2.5), [0.0, 1.5, 2.0]);
    assert!(parabola(&axes, f64::NAN, [0.0, 1.0]).unwrap_err().to_string().contains("focal"));
}

#[test]
fn an_arc_through_three_points_passes_through_them() {
    let axes = tilted();
    let at = |t: f64| {
        let (s, c) = t.sin_cos();
        [0, 1, 2].map(|k| axes.origin[k] + 3.0 * (c * axes.x[k] + s * axes.y[k]))
    };
    for [a, b, c] in [[0.0, 0.5, 1.0], [0.0, 3.0, 6.0], [1.0, 0.0, -4.0], [2.0, 2.1, 2.2]] {
        let curve = arc_through([at(a), at(b), at(c)]).unwrap();
        let all = samples(&curve);
        assert_eq!((all[0], all[200]), (at(a), at(c)));
        assert!(all.iter().all(|p| (gap(*p, axes.origin) - 3.0).abs() < 1e-12));
        let nearest = all.iter().map(|p| gap(*p, at(b))).fold(1.0, f64::min);
        assert!(nearest < 0.06, "{nearest}");
        let (length, turn) = (all.windows(2).map(|w| gap(w[0], w[1])).sum::<f64>(), (c - a).abs());
        assert!((length - 3.0 * turn).abs() < 1e-2);
    }
    assert!(arc_through([at(0.0), at(0.0), at(1.0)]).is_err());
    assert!(arc_through([[0.0; 3], [1.0, 1.0, 1.0], [3.0, 3.0, 3.0]]).is_err());
}

#[test]
fn quadrics_satisfy_their_equations() {
    let axes = tilted();
    let [a, b, c] = [2.0, 1.5, 0.8];
    let turn = [0.0, TAU];
    let form = ArcForm::usual(TAU);
    let make = |kind, range| quadric(kind, &axes, [a, b, c], turn, range, form).unwrap();
    type Law = fn(f64, f64, f64) -> f64;
    let cases: [(Surface, Law); 6] = [
        (make(Quadric::Ellipsoid, [-FRAC_PI_2, FRAC_PI_2]), |x, y, z| x * x + y * y + z * z - 1.0),
        (make(Quadric::OneSheet, [-0.8, 1.1]), |x, y, z| x * x + y * y - z * z - 1.0),
        (make(Quadric::TwoSheets, [0.0, 1.3]), |x, y, z| x * x + y * y - z * z + 1.0),
        (make(Quadric::Paraboloid, [0.0, 1.5]), |x, y, z| x * x + y * y - z),
        (make(Quadric::Cone, [0.0, 1.5]), |x, y, z| x * x + y * y - z * z),
        (make(Quadric::Cylinder, [-1.0, 2.0]), |x, y, _| x * x + y * y - 1.0),
    ];
    for (surface, law) in &cases {
        assert!(surface.is_closed_u());
        for p in grid(surface) {
            let [x, y, z] = local(&axes, p);
            assert!(law(x / a, y / b, z / c).abs() < 2e-13 * 5.0, "{p:?}");
        }
    }
    assert_eq!(cases[0].0.collapsed_edges(), [false, false, true, true]);
    assert_eq!(cases[3].0.collapsed_edges(), [false, false, true, false]);
    let surface = saddle(&axes, [1.2, 0.9], [-1.0, 2.0, -0.5, 1.0]).unwrap();
    for p in grid(&surface) {
        let [x, y, z] = local(&axes, p);
        assert!((z - (x / 1.2).powi(2) + (y / 0.9).powi(2)).abs() < EXACT * 4.0);
    }
    let at = surface.evaluate(0.3, 0.7);
    assert!((local(&axes, at)[0] - 0.3).abs() < EXACT && (local(&axes, at)[1] - 0.7).abs() < EXACT);
    let surface = torus(&axes, [3.0, 1.0], turn, turn, None).unwrap();
    for p in grid(&surface) {
        let [x, y, z] = local(&axes, p);
        assert!(((x.hypot(y) - 3.0).hypot(z) - 1.0).abs() < EXACT * 4.0);
    }
    for p in grid(&sphere(&axes, 2.0, turn, [-FRAC_PI_2, FRAC_PI_2]).unwrap()) {
        assert!((gap(p, axes.origin) - 2.0).abs() < EXACT * 2.0);
    }
    for p in grid(&cone(&axes, 1.0, 0.3, turn, [0.0, 2.0]).unwrap()) {
        let [x, y, z] = local(&axes, p);
        assert!((x.hypot(y) - 1.0 - z * 0.3f64.tan()).abs() < EXACT * 4.0);
    }
    for p in grid(&cylinder(&axes, 1.0, [0.0, PI], [0.0, 2.0]).unwrap()) {
        let [x, y, _] = local(&axes, p);
        assert!((x.hypot(y) - 1.0).abs() < EXACT);
    }
    assert!(
        grid(&plane(&axes, [0.0, 1.0, 0.0, 2.0]).unwrap())
            .iter()
            .all(|p| local(&axes, *p)[2].abs() < EXACT)
    );
    let refused = quadric(Quadric::Cone, &axes, [a, b, c], turn, [-1.0, 1.0], form).unwrap_err();
    assert!(refused.to_string().contains("profile"));
    let refused = quadric(Quadric::Cone, &axes, [a, 0.0, c], turn, [0.0, 1.0], form).unwrap_err();
    assert!(refused.to_string().contains("radius_y"));
}

/// A wavy curve of some degree in the plane of x and y, moved by z.
fn wavy(degree: usize, z: f64, weights: bool) -> Curve {
    let count = degree + 4;
    let mut knots = vec![0.0; degree + 1];
    knots.extend((1..count - degree).map(|k| k as f64 + 0.1 * degree as f64));
    knots.extend(vec![(count - degree) as f64 + 1.0; degree + 1]);
    let pole = |k: usize| {
        let t = k as f64;
        [t, (1.7 * t + degree as f64).sin() + 0.3 * z, z + 0.2 * (t * 0.9).cos()]
    };
    let poles: Vec<Vector> = (0..count).map(pole).collect();
    let list: Vec<f64> = (0..count).map(|k| 1.0 + 0.5 * (k as f64).sin()).collect();
    Curve::new(&knots, degree, &poles, weights.then_some(&list[..])).unwrap()
}

fn share(curve: &Curve, s: f64) -> f64 {
    let (a, b) = curve.domain();
    a + (b - a) * s
}

#[test]
fn ruled_and_moved_surfaces_hold_their_curves() {
    for weights in [false, true] {
        let (first, second) = (wavy(2, 0.0, weights), wavy(4, 3.0, false));
        let surface = ruled(&first, &second).unwrap();
        for i in 0..=50 {
            let s = i as f64 / 50.0;
            let u = share(&first, s);
            let (p, q) = (first.evaluate(u), second.evaluate(share(&second, s)));
            assert!(gap(surface.evaluate(u, 0.0), p) < EXACT * 10.0);
            assert!(gap(surface.evaluate(u, 1.0), q) < EXACT * 10.0);
            let middle = surface.evaluate(u, 0.4);
            let on_line = gap(middle, p) + gap(middle, q) - gap(p, q);
            assert!(on_line.abs() < EXACT * 20.0);
        }
        let tall = extruded(&first, [0.5, 1.0, -2.0]).unwrap();
        let spine = wavy(3, 1.0, weights);
        let moved = translational(&first, &spine).unwrap();
        for i in 0..=50 {
            let (u, v) = (share(&first, i as f64 / 50.0), ((7 * i) % 51) as f64 / 50.0);
            let p = first.evaluate(u);
            let up = [p[0] + 0.5 * v, p[1] + v, p[2] - 2.0 * v];
            assert!(gap(tall.evaluate(u, v), up) < EXACT * 10.0);
            let v = share(&spine, v);
            let (t, t0) = (spine.evaluate(v), spine.evaluate(spine.domain().0));
            let wanted = [0, 1, 2].map(|k| p[k] + t[k] - t0[k]);
            assert!(gap(moved.evaluate(u, v), wanted) < EXACT * 20.0);
        }
        let origin = [0.0, -4.0, 0.0];
        let round = revolved(&first, origin, [2.0, 0.0, 0.0], [0.0, 1.5 * PI], None).unwrap();
        let (v0, v1) = first.domain();
        for i in 0..=50 {
            let v = v0 + (v1 - v0) * i as f64 / 50.0;
            let p = first.evaluate(v);
            for j in 0..=20 {
                let q = round.evaluate(j as f64 / 20.0, v);
                assert!((q[0] - p[0]).abs() < EXACT * 10.0);
                assert!(((q[1] + 4.0).hypot(q[2]) - (p[1] + 4.0).hypot(p[2])).abs() < EXACT * 10.0);
            }
            let end = [p[0], -4.0 + p[2], -(p[1] + 4.0)];
            assert!(gap(round.evaluate(1.0, v), end) < EXACT * 10.0, "{end:?}");
        }
    }
    let flat = wavy(2, 0.0, false);
    assert!(extruded(&flat, [0.0; 3]).unwrap_err().to_string().contains("direction"));
    assert!(
        revolved(&flat, [0.0; 3], [0.0; 3], [0.0, 1.0], None)
            .unwrap_err()
            .to_string()
            .contains("axis")
    );
}
