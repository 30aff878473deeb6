//! Offsets: exact by functions, and as splines with an error that is proven.

use footpoint::callback::{CurveBounds, SurfaceBounds};
use footpoint::closest::{QueryOptions, Workspace};
use footpoint::construct::*;
use footpoint::curve::Curve;
use footpoint::elementary::Axes;
use footpoint::index::IndexedSurface;
use footpoint::surface::Surface;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

type Vector = [f64; 3];

fn sub(a: Vector, b: Vector) -> Vector {
    [0, 1, 2].map(|k| a[k] - b[k])
}

fn dot(a: Vector, b: Vector) -> f64 {
    (0..3).map(|k| a[k] * b[k]).sum()
}

fn gap(a: Vector, b: Vector) -> f64 {
    dot(sub(a, b), sub(a, b)).sqrt()
}

/// A bicubic hill, C2, with weights or without.
fn hill(weights: bool) -> Surface {
    let knots = [0., 0., 0., 0., 1., 2., 3., 3., 3., 3.];
    let pole = |k: usize| {
        let (i, j) = ((k / 6) as f64, (k % 6) as f64);
        [i + 0.1 * (j * 2.0).sin(), j, (0.9 * i).sin() * (0.7 * j).cos()]
    };
    let poles: Vec<Vector> = (0..36).map(pole).collect();
    let list: Vec<f64> = (0..36).map(|k| 1.0 + 0.2 * (k as f64 * 1.3).sin()).collect();
    Surface::new(&knots, &knots, 3, 3, &poles, 6, 6, weights.then_some(&list[..])).unwrap()
}

fn exact(s: &Surface, u: f64, v: f64, d: f64) -> Vector {
    let mut out = [[0.0; 3]; 3];
    s.partials(u, v, 1, &mut out);
    let [a, b] = [out[1], out[2]];
    let m = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
    let length = dot(m, m).sqrt();
    [0, 1, 2].map(|k| out[0][k] + d * m[k] / length)
}

#[test]
fn an_offset_function_has_the_right_points_and_derivatives() {
    let base = hill(true);
    let d = 0.15;
    let offset = offset_surface(&base, d, SurfaceBounds::default()).unwrap();
    let mut out = [[0.0; 3]; 6];
    for (u, v) in [(0.3, 0.4), (1.5, 2.2), (2.9, 0.1), (0.5, 2.5)] {
        assert!(offset.partials(u, v, 2, &mut out));
        assert!(gap(out[0], exact(&base, u, v, d)) < 1e-14 * 10.0);
        let h = 1e-4;
        let at = |i: f64, j: f64| exact(&base, u + i * h, v + j * h, d);
        let by = |a: Vector, b: Vector, f: f64| sub(a, b).map(|x| x / f);
        assert!(gap(out[1], by(at(1., 0.), at(-1., 0.), 2.0 * h)) < 1e-6);
        assert!(gap(out[2], by(at(0., 1.), at(0., -1.), 2.0 * h)) < 1e-6);
        let twice =
            |a: Vector, b: Vector, c: Vector| [0, 1, 2].map(|k| (a[k] - 2.0 * b[k] + c[k]) / h / h);
        assert!(gap(out[3], twice(at(1., 0.), at(0., 0.), at(-1., 0.))) < 1e-5);
        assert!(gap(out[5], twice(at(0., 1.), at(0., 0.), at(0., -1.))) < 1e-5);
        let mixed = sub(sub(at(1., 1.), at(1., -1.)), sub(at(-1., 1.), at(-1., -1.)));
        assert!(gap(out[4], mixed.map(|x| x / (4.0 * h * h))) < 1e-5);
    }
    // A circle's offsets are circles: to the right of its direction, which is outside.
    let round = circle(&Axes::STANDARD, 2.0, ArcForm::usual(TAU)).unwrap();
    let offset = offset_curve(&round, 0.5, [0.0, 0.0, 3.0], CurveBounds::default()).unwrap();
    for i in 0..=50 {
        let u = i as f64 / 50.0;
        let p = offset.evaluate(u).unwrap();
        assert!((p[0].hypot(p[1]) - 2.5).abs() < 1e-13);
        let (mut ours, mut base) = ([[0.0; 3]; 3], [[0.0; 3]; 3]);
        assert!(offset.derivatives(u, 2, &mut ours));
        round.derivatives(u, 2, &mut base);
        for k in 0..3 {
            assert!(gap(ours[k], base[k].map(|x| 1.25 * x)) < 1e-11, "order {k}");
        }
    }
    assert!(offset_curve(&round, 0.5, [0.0; 3], CurveBounds::default()).is_err());
}

#[test]
fn a_fitted_offset_of_a_surface_is_proven() {
    for weights in [false, true] {
        let base = hill(weights);
        for (d, tolerance) in [(0.2, 1e-3), (-0.2, 1e-5)] {
            let fit = offset_surface_fit(&base, d, [3, 3], tolerance).unwrap();
            assert!(fit.proven <= tolerance, "{weights} {d} {}", fit.proven);
            assert!(fit.measured <= fit.proven);
            let mut worst = 0.0f64;
            for i in 0..=97 {
                for j in 0..=89 {
                    let (u, v) = (3.0 * i as f64 / 97.0, 3.0 * j as f64 / 89.0);
                    worst = worst.max(gap(fit.shape.evaluate(u, v), exact(&base, u, v, d)));
                }
            }
            assert!(worst <= fit.proven, "{worst} {}", fit.proven);
            assert!(fit.proven < 50.0 * worst.max(1e-2 * tolerance), "{worst} {}", fit.proven);
            // The engine's certified distance from the base agrees, away from the borders.
            let shape = IndexedSurface::new(base.clone());
            let mut workspace = Workspace::default();
            for k in 0..60 {
                let (u, v) =
                    (0.5 + 2.0 * (k as f64 * 0.37).fract(), 0.5 + 2.0 * (k as f64 * 0.61).fract());
                let p = fit.shape.evaluate(u, v);
                let foot =
                    shape.closest(p, Some([u, v]), &QueryOptions::default(), &mut workspace, None);
                assert!(foot.distance <= d.abs() + fit.proven);
                assert!(
                    foot.lower_bound >= d.abs() - fit.proven - 1e-9,
                    "{} {}",
                    foot.lower_bound,
                    d
                );
            }
        }
    }
}

#[test]
fn a_wrong_offset_is_not_proven() {
    // The proof must not believe a shifted or mirrored surface: a tolerance that degree 1 with few poles does not reach stays unproven.
    let base = hill(false);
    let fit = offset_surface_fit(&base, 0.2, [1, 1], 1e-6).unwrap();
    assert!(fit.proven > 1e-6 && fit.measured > 1e-6 && fit.proven >= fit.measured);
}

#[test]
fn a_fitted_offset_of_a_sphere_is_a_sphere() {
    let base = sphere(&Axes::STANDARD, 2.0, [0.0, TAU], [-FRAC_PI_2, FRAC_PI_2]).unwrap();
    // Quarters meet at double knots, but the normal does not jump there.
    let fit = offset_surface_fit(&base, 0.5, [3, 3], 1e-4).unwrap();
    assert!(fit.measured <= 1e-4 && fit.proven.is_infinite());
    let part = sphere(&Axes::STANDARD, 2.0, [0.0, 1.5], [0.0, FRAC_PI_2]).unwrap();
    let fit = offset_surface_fit(&part, 0.5, [3, 3], 1e-5).unwrap();
    assert!(fit.measured <= 1e-5 && fit.proven.is_infinite());
    for i in 0..=30 {
        for j in 0..=30 {
            let p = fit.shape.evaluate(i as f64 / 30.0, j as f64 / 30.0);
            assert!((gap(p, [0.0; 3]) - 2.5).abs() < 1.2e-5);
        }
    }
    let pipe = cylinder(&Axes::STANDARD, 1.0, [0.0, TAU], [0.0, 2.0]).unwrap();
    let fit = offset_surface_fit(&pipe, 0.5, [3, 1], 1e-6).unwrap();
    assert!(fit.proven <= 1e-6, "{}", fit.proven);
    let roof = Surface::new(
        &[0., 0., 1., 2., 2.],
        &[0., 0., 1., 1.],
        1,
        1,
        &[[0., 0., 0.], [0., 1., 0.], [1., 0., 1.], [1., 1., 1.], [2., 0., 0.], [2., 1., 0.]],
        3,
        2,
        None,
    );
    let refused = offset_surface_fit(&roof.unwrap(), 0.1, [3, 3], 1e-4).unwrap_err().to_string();
    assert!(refused.contains("jumps at the knot 1"), "{refused}");
    let band = sphere(&Axes::STANDARD, 2.0, [0.0, 1.5], [-0.7, 0.8]).unwrap();
    let fit = offset_surface_fit(&band, -0.5, [3, 3], 1e-6).unwrap();
    assert!(fit.proven <= 1e-6, "{}", fit.proven);
}

#[test]
fn fitted_offsets_of_curves_are_proven() {
    let knots = [0., 0., 0., 0., 1., 2., 3., 4., 4., 4., 4.];
    let poles: Vec<Vector> = (0..7).map(|k| [k as f64, (k as f64 * 1.1).sin(), 0.0]).collect();
    let weights = [1.0, 0.8, 1.3, 1.0, 0.7, 1.0, 1.2];
    for weights in [None, Some(&weights[..])] {
        let curve = Curve::new(&knots, 3, &poles, weights).unwrap();
        for (d, degree, tolerance) in [(0.1, 3, 1e-4), (-0.3, 5, 1e-8), (0.2, 2, 1e-3)] {
            let fit = offset_curve_fit(&curve, d, [0.0, 0.0, 1.0], degree, tolerance).unwrap();
            assert!(fit.proven <= tolerance, "{} {}", fit.proven, fit.measured);
            let offset = offset_curve(&curve, d, [0.0, 0.0, 1.0], CurveBounds::default()).unwrap();
            let mut worst = 0.0f64;
            for i in 0..=2000 {
                let u = 4.0 * i as f64 / 2000.0;
                worst = worst.max(gap(fit.shape.evaluate(u), offset.evaluate(u).unwrap()));
            }
            assert!(
                worst <= fit.proven && fit.proven < 50.0 * worst + 1e-10,
                "{worst} {}",
                fit.proven
            );
        }
        // Distance 0 is the curve.
        let same = offset_curve_fit(&curve, 0.0, [0.0, 0.0, 1.0], 4, 1e-7).unwrap();
        assert!(same.proven <= 1e-7);
    }
    let corner = Curve::new(&[0., 0., 1., 2., 2.], 1, &poles[..3], None).unwrap();
    let refused = offset_curve_fit(&corner, 0.1, [0.0, 0.0, 1.0], 3, 1e-4).unwrap_err();
    assert!(refused.to_string().contains("knot 1"));
    let half = arc(&Axes::STANDARD, 1.0, [0.0, PI], ArcForm::Cubic).unwrap();
    let fit = offset_curve_fit(&half, -0.25, [0.0, 0.0, 1.0], 3, 1e-7).unwrap();
    assert!(fit.proven <= 1e-7 && (gap(fit.shape.evaluate(0.37), [0.0; 3]) - 0.75).abs() < 1e-7);
}
