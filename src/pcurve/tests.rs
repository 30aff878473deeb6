//! Curves in the parameter plane: maps, bounds, parts, refusals.

use super::*;

fn kinds() -> Vec<Pcurve> {
    let poles = [[0.1, 0.2, 0.0], [0.4, 0.9, 0.0], [0.8, -0.1, 0.0], [0.9, 0.7, 0.0]];
    let knots = [0.0, 0.0, 0.0, 0.3, 1.0, 1.0, 1.0];
    let weights = [1.0, 2.0, 0.5, 1.0];
    vec![
        Pcurve::isoline(Direction::U, 0.3, 0.9, 0.1).unwrap(),
        Pcurve::isoline(Direction::V, 0.3, 0.2, 0.7).unwrap(),
        Pcurve::polyline(&[[0.0, 0.1], [0.5, 0.7], [0.2, 0.9]]).unwrap(),
        Pcurve::spline(Curve::new(&knots, 2, &poles, Some(&weights)).unwrap()).unwrap(),
        Pcurve::arc([0.5, 0.4], [0.3, 0.1], [-0.05, 0.2], [0.4, 5.0]).unwrap(),
    ]
}

fn near(a: Parameters, b: Parameters) -> bool {
    (a[0] - b[0]).abs() < 1e-14 && (a[1] - b[1]).abs() < 1e-14
}

#[test]
fn reversing_twice_gives_the_same_bits_and_once_the_same_places() {
    for curve in kinds() {
        let back = curve.reversed();
        assert_eq!(back.reversed(), curve);
        assert_eq!((back.start(), back.end()), (curve.end(), curve.start()));
        for k in 0..=40 {
            let share = f64::from(k) / 40.0;
            let there = curve.evaluate(curve.parameter_at(share));
            assert!(near(back.evaluate(back.parameter_at(1.0 - share)), there));
        }
    }
}

#[test]
fn an_affine_image_is_the_image_of_each_place_and_keeps_the_kind() {
    let plain = Affine { matrix: [[0.0, -2.0], [0.5, 0.0]], offset: [0.3, -1.0] };
    let skew = Affine { matrix: [[1.0, 0.3], [-0.4, 0.8]], offset: [0.3, -1.0] };
    for curve in kinds() {
        for map in [plain, skew] {
            let image = curve.mapped(&map).unwrap();
            for k in 0..=40 {
                let share = f64::from(k) / 40.0;
                let there = map.point(curve.evaluate(curve.parameter_at(share)));
                assert!(near(image.evaluate(image.parameter_at(share)), there));
            }
        }
        let kept = std::mem::discriminant(&curve.mapped(&plain).unwrap());
        assert_eq!(kept, std::mem::discriminant(&curve));
    }
}

#[test]
fn bounds_hold_the_curve_and_parts_are_parts() {
    for curve in kinds() {
        let [u0, u1, v0, v1] = curve.bounds();
        let (a, b) = curve.domain();
        let (from, to) = (between(a, b, 0.2), between(a, b, 0.85));
        let part = curve.part(from, to).unwrap();
        assert!(near(part.start(), curve.evaluate(from)) && near(part.end(), curve.evaluate(to)));
        for k in 0..=200 {
            let t = between(a, b, f64::from(k) / 200.0);
            let [u, v] = curve.evaluate(t);
            assert!(u0 - 1e-15 <= u && u <= u1 + 1e-15 && v0 - 1e-15 <= v && v <= v1 + 1e-15);
            if from < t && t < to {
                assert!(near(part.evaluate(t), [u, v]));
            }
        }
    }
}

#[test]
fn derivatives_are_the_limits_of_differences() {
    for curve in kinds() {
        let (a, b) = curve.domain();
        for k in 1..20 {
            let (t, h) = (between(a, b, (f64::from(k) + 0.37) / 21.0), 1e-6);
            let mut out = [[0.0; 2]; 3];
            curve.derivatives(t, 2, &mut out);
            let (p, q) = (curve.evaluate(t - h), curve.evaluate(t + h));
            for axis in 0..2 {
                let slope = (q[axis] - p[axis]) / (2.0 * h);
                assert!((slope - out[1][axis]).abs() < 1e-7, "{curve:?} {t}");
            }
        }
    }
}

#[test]
fn what_is_no_curve_is_refused_by_name() {
    let text = |made: Result<Pcurve, Error>| made.unwrap_err().to_string();
    let nan = f64::NAN;
    assert_eq!(
        text(Pcurve::isoline(Direction::U, nan, 0.0, 1.0)),
        "at: is not finite or beyond 1e100"
    );
    assert_eq!(text(Pcurve::isoline(Direction::U, 0.0, 1.0, 1.0)), "to: equals from, 1");
    assert_eq!(text(Pcurve::polyline(&[[0.0; 2]])), "points: 1 given, at least 2 needed");
    assert_eq!(
        text(Pcurve::polyline_at(&[0.0, 0.0], &[[0.0; 2]; 2])),
        "parameters: entry 1 is not more than entry 0"
    );
    let bent = Curve::new(&[0., 0., 1., 1.], 1, &[[0.0; 3], [1.0; 3]], None).unwrap();
    assert_eq!(text(Pcurve::spline(bent)), "poles: pole 1 has z = 1, not 0");
    let arc = Pcurve::arc([0.0; 2], [1.0, 0.0], [0.0, 1.0], [0.0, 7.0]);
    assert_eq!(text(arc), "angles: more than a full turn");
}
