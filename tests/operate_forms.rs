//! Maps, derivatives, power form, arc length, continuity and frames: laws over random shapes, and closed forms.

mod strategies;

use footpoint::curve::Curve;
use footpoint::knots::{Knots, Side};
use footpoint::operate::{Direction, PowerCurve};
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

fn norm(a: [f64; 3]) -> f64 {
    a.iter().map(|x| x * x).sum::<f64>().sqrt()
}

fn sub(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|x| a[x] - b[x])
}

fn gap(a: [f64; 3], b: [f64; 3]) -> f64 {
    norm(sub(a, b))
}

fn size(poles: &[[f64; 3]]) -> f64 {
    poles.iter().flatten().fold(0.0, |size: f64, x| size.max(x.abs()))
}

fn places(start: f64, end: f64, count: usize) -> impl Iterator<Item = f64> {
    (0..=count).map(move |i| (start + (end - start) * (i as f64 / count as f64)).clamp(start, end))
}

fn shortest(knots: &Knots) -> f64 {
    let steps = knots.spans().map(|i| knots.values()[i + 1] - knots.values()[i]);
    steps.fold(f64::INFINITY, f64::min)
}

/// A circle of radius 2 in four quadrants.
fn circle() -> Curve {
    let h = 0.5f64.sqrt();
    let corners = [[1, 0], [1, 1], [0, 1], [-1, 1], [-1, 0], [-1, -1], [0, -1], [1, -1], [1, 0]];
    let poles = corners.map(|[x, y]| [2.0 * x as f64, 2.0 * y as f64, 0.0]);
    let knots = [0., 0., 0., 1., 1., 2., 2., 3., 3., 4., 4., 4.];
    Curve::new(&knots, 2, &poles, Some(&[1., h, 1., h, 1., h, 1., h, 1.])).unwrap()
}

fn bezier(poles: &[[f64; 3]]) -> Curve {
    let p = poles.len() - 1;
    let knots: Vec<f64> = (0..2 * p + 2).map(|i| if i <= p { 0.0 } else { 1.0 }).collect();
    Curve::new(&knots, p, poles, None).unwrap()
}

fn matrices() -> impl Strategy<Value = [[f64; 4]; 4]> {
    prop::array::uniform4(prop::array::uniform4(-1.0..1.0f64))
}

fn product(matrix: &[[f64; 4]; 4], [x, y, z]: [f64; 3]) -> [f64; 4] {
    matrix.map(|[a, b, c, d]| a * x + b * y + c * z + d)
}

proptest! {
    #![proptest_config(config(100))]

    #[test]
    fn maps_of_the_shape_are_maps_of_its_points(curve in curves(), surface in surfaces(), matrix in matrices()) {
        // All poles within 10 of the origin lie before the vanishing plane.
        let mut deep = matrix;
        deep[3] = [0.03 * matrix[3][0], 0.03 * matrix[3][1], 0.03 * matrix[3][2], 1.5];
        let affine = [matrix[0], matrix[1], matrix[2]];
        let moved = |p: [f64; 3]| { let [x, y, z, _] = product(&matrix, p); [x, y, z] };
        let seen = |p: [f64; 3]| { let [x, y, z, w] = product(&deep, p); [x / w, y / w, z / w] };
        let (a, b) = (curve.affine(&affine).unwrap(), curve.projective(&deep).unwrap());
        let (start, end) = curve.domain();
        for u in places(start, end, 20) {
            prop_assert!(gap(a.evaluate(u), moved(curve.evaluate(u))) < 1e-12);
            prop_assert!(gap(b.evaluate(u), seen(curve.evaluate(u))) < 1e-12);
        }
        let (a, b) = (surface.affine(&affine).unwrap(), surface.projective(&deep).unwrap());
        let [u0, u1, v0, v1] = surface.domain();
        for (u, v) in places(u0, u1, 9).zip(places(v0, v1, 9).collect::<Vec<_>>().into_iter().rev()) {
            prop_assert!(gap(a.evaluate(u, v), moved(surface.evaluate(u, v))) < 1e-12);
            prop_assert!(gap(b.evaluate(u, v), seen(surface.evaluate(u, v))) < 1e-12);
        }
    }

    #[test]
    fn the_derivative_as_a_shape_is_the_derivative(curve in curves()) {
        let Ok(derivative) = curve.derivative() else {
            // Refused only where it jumps, or where the degree would be too high.
            let (start, end) = curve.domain();
            let full = curve.knots().values().iter().any(|&u| {
                start < u && u < end && curve.knots().multiplicity(u) == curve.degree()
            });
            prop_assert!(full || (curve.is_rational() && curve.degree() > 15));
            return Ok(());
        };
        let (start, end) = curve.domain();
        prop_assert_eq!(derivative.domain(), (start, end));
        // Bezier poles of rational curves are exact to their rounding, which a short span divides.
        let short = if curve.is_rational() { shortest(curve.knots()) } else { f64::INFINITY };
        for u in places(start, end, 30) {
            let mut d = [[0.0; 3]; 3];
            curve.derivatives(u, 2, &mut d);
            let error = gap(derivative.evaluate(u), d[1]);
            let allowed = 1e-12 * size(derivative.poles()) + 1e-14 * size(curve.poles()) / short;
            prop_assert!(error <= allowed, "{error:e} {allowed:e} {} {} {:e}", curve.degree(), curve.is_rational(), size(derivative.poles()));
        }
    }

    #[test]
    fn the_power_form_gives_the_points_and_goes_back(curve in curves()) {
        prop_assume!(curve.degree() <= 6);
        for (piece, power) in curve.bezier_pieces().unwrap().iter().zip(curve.power_pieces().unwrap()) {
            let (start, end) = piece.domain();
            prop_assert_eq!(power.domain, [start, end]);
            let ratio = curve.weights().map_or(1.0, |w| {
                w.iter().fold(0.0, |a: f64, b| a.max(*b)) / w.iter().fold(f64::MAX, |a: f64, b| a.min(*b))
            });
            for i in 0..=8 {
                let t = i as f64 / 8.0;
                let h = power.coefficients.iter().rev().fold([0.0; 4], |sum: [f64; 4], a| {
                    std::array::from_fn(|x| sum[x] * t + a[x])
                });
                let point = [0, 1, 2].map(|x| h[x] / h[3]);
                let u = (start + t * (end - start)).clamp(start, end);
                // The homogeneous form loses what weights of other sizes hide.
                let far = start.abs().max(end.abs());
                let mut d = [[0.0; 3]; 2];
                piece.derivatives(u, 1, &mut d);
                let allowed = 1e-12 * size(piece.poles()) * ratio + 1e-15 * far * norm(d[1]);
                prop_assert!(gap(point, piece.evaluate(u)) <= allowed);
            }
            if let Ok(back) = Curve::from_power(&power) {
                prop_assert!(piece.difference(&back).unwrap().reached <= 1e-12 * size(piece.poles()) * ratio);
            }
        }
    }

    #[test]
    fn arc_length_lies_between_chords_and_polygons(curve in curves(), shares in [0.0..1.0f64, 0.0..1.0f64]) {
        let length = curve.arc_length(0.0).unwrap();
        let total = length.total();
        let polygon: f64 = curve.clamp().unwrap().poles().windows(2).map(|w| gap(w[0], w[1])).sum();
        let (start, end) = curve.domain();
        let points: Vec<[f64; 3]> = places(start, end, 400).map(|u| curve.evaluate(u)).collect();
        let chords: f64 = points.windows(2).map(|w| gap(w[0], w[1])).sum();
        let rounding = 400.0 * 1e-15 * (1.0 + curve.degree() as f64) * size(curve.poles());
        prop_assert!(total.value + total.error + rounding >= chords, "{total:?} {chords}");
        prop_assert!(total.value - total.error - rounding <= polygon, "{total:?} {polygon}");
        // Monotone, additive, and the inverse goes back.
        let [a, b] = shares.map(|share| (start + share * (end - start)).clamp(start, end));
        let (a, b) = (a.min(b), a.max(b));
        let [to_a, to_b] = [a, b].map(|u| length.at(u).unwrap());
        prop_assert!(to_a.value - to_a.error <= to_b.value + to_b.error);
        let u = length.parameter(to_b.value.min(total.value)).unwrap();
        let back = length.at(u.value).unwrap();
        prop_assert!((back.value - to_b.value).abs() <= u.error + back.error + to_b.error);
        if !curve.is_rational() {
            let rounding = 1e-13 * (curve.degree() + 1) as f64 * size(curve.poles());
            prop_assert!(total.error <= 1e-10 * total.value + rounding, "{total:?}");
            if a < b {
                let part = curve.part(a, b).unwrap().arc_length(0.0).unwrap().total();
                let difference = to_b.value - to_a.value;
                // The poles of the part are rounded.
                let poles = 1e-14 * (curve.degree() + 1) as f64 * size(curve.poles());
                let allowed = part.error + to_a.error + to_b.error + poles;
                prop_assert!((part.value - difference).abs() <= allowed, "{part:?} {difference:e} {allowed:e}");
            }
        }
    }

    #[test]
    fn continuity_is_at_least_what_the_multiplicity_says(curve in curves(), surface in surfaces()) {
        for joint in curve.continuity(1e-9).unwrap() {
            let (start, end) = curve.domain();
            if start < joint.u && joint.u < end && !curve.is_rational() {
                prop_assert!(joint.order + joint.multiplicity >= curve.degree(), "{joint:?}");
            }
        }
        for direction in [Direction::U, Direction::V] {
            let knots = surface.knots(direction);
            let (start, end) = knots.domain();
            for crease in surface.continuity(direction, 1e-9).unwrap() {
                if start < crease.value && crease.value < end {
                    prop_assert!(crease.order + crease.multiplicity >= knots.degree(), "{crease:?}");
                }
            }
        }
    }
}

proptest! {
    #![proptest_config(config(25))]

    #[test]
    fn the_derivatives_of_a_surface_are_its_derivatives(surface in surfaces()) {
        let [u0, u1, v0, v1] = surface.domain();
        prop_assume!(!surface.is_rational() || surface.knots_u().degree() * surface.knots_v().degree() < 30);
        for direction in [Direction::U, Direction::V] {
            let Ok(derivative) = surface.derivative(direction) else { continue };
            for u in places(u0, u1, 7) {
                for v in places(v0, v1, 7) {
                    let mut d = [[0.0; 3]; 6];
                    surface.partials(u, v, 2, &mut d);
                    let error = gap(derivative.evaluate(u, v), d[1 + direction.index()]);
                    let short = shortest(surface.knots(direction));
                    let short = if surface.is_rational() { short } else { f64::INFINITY };
                    let allowed = 1e-12 * size(derivative.poles())
                        + 1e-14 * size(surface.poles()) / short;
                    prop_assert!(error <= allowed, "{error:e} {allowed:e}");
                }
            }
        }
    }
}

#[test]
fn the_length_of_a_circle_is_known_and_so_is_the_place_of_each_length() {
    let (circle, tau) = (circle(), std::f64::consts::TAU);
    let length = circle.arc_length(0.0).unwrap();
    let total = length.total();
    assert!((total.value - 2.0 * tau).abs() <= total.error && total.error < 1e-11, "{total:?}");
    for i in 0..=40 {
        let angle = i as f64 * tau / 40.0;
        let u = length.parameter((2.0 * angle).min(total.value)).unwrap();
        let point = circle.evaluate(u.value);
        let there = [2.0 * angle.cos(), 2.0 * angle.sin(), 0.0];
        assert!(gap(point, there) <= u.error + 1e-14 && u.error < 1e-11, "{u:?}");
    }
    assert!(length.parameter(13.0).is_err() && length.parameter(f64::NAN).is_err());
    assert!(length.at(4.1).is_err() && circle.arc_length(-1.0).is_err());
}

#[test]
fn the_length_of_a_parabola_and_of_a_cusp_are_their_closed_forms() {
    // (t, t^2): integral of sqrt(1 + 4 t^2).
    let parabola = bezier(&[[0.0; 3], [0.5, 0.0, 0.0], [1.0, 1.0, 0.0]]);
    let exact = 5f64.sqrt() / 2.0 + (2.0 + 5f64.sqrt()).ln() / 4.0;
    let found = parabola.arc_length(0.0).unwrap().total();
    assert!((found.value - exact).abs() <= found.error + 4e-16 && found.error < 1e-12, "{found:?}");
    // (t^2, t^3) from -1 to 1: twice (13^1.5 - 8) / 27, with a cusp in the middle.
    let cusp = bezier(&[
        [1.0, -1.0, 0.0],
        [-1.0 / 3.0, 1.0, 0.0],
        [-1.0 / 3.0, -1.0, 0.0],
        [1.0, 1.0, 0.0],
    ]);
    let exact = 2.0 * (13f64.powf(1.5) - 8.0) / 27.0;
    for tolerance in [0.0, 1e-6, 1e-9] {
        let found = cusp.arc_length(tolerance).unwrap().total();
        assert!((found.value - exact).abs() <= found.error, "{found:?} {exact}");
        assert!(found.error <= if tolerance > 0.0 { tolerance } else { 1e-11 }, "{found:?}");
    }
    // A curve that is a point.
    let point = bezier(&[[1.0; 3]; 4]).arc_length(0.0).unwrap();
    assert!(point.total().value == 0.0 && point.parameter(0.0).unwrap().value == 0.0);
}

#[test]
fn a_circle_has_its_curvature_and_no_torsion_and_a_cubic_has_both() {
    let circle = circle();
    for u in places(0.0, 4.0, 33) {
        let frame = circle.frame(u, Side::Above).unwrap();
        assert!((frame.curvature - 0.5).abs() < 1e-13 && frame.torsion.abs() < 1e-13);
        assert!(gap(frame.normal, frame.point.map(|x| -x / 2.0)) < 1e-13);
        assert!(gap(frame.binormal, [0.0, 0.0, 1.0]) < 1e-13);
    }
    // (t, t^2, t^3): at 0 curvature 2, torsion 3.
    let cubic = bezier(&[[0.0; 3], [1.0 / 3.0, 0.0, 0.0], [2.0 / 3.0, 1.0 / 3.0, 0.0], [1.0; 3]]);
    let frame = cubic.frame(0.0, Side::Above).unwrap();
    assert!((frame.curvature - 2.0).abs() < 1e-14 && (frame.torsion - 3.0).abs() < 1e-14);
    let line = bezier(&[[0.1, 0.2, 0.3], [0.4, 0.8, 1.2], [0.7, 1.4, 2.1]]);
    let frame = line.frame(0.3, Side::Above).unwrap();
    assert!(frame.curvature < 1e-15 && frame.torsion.is_nan() && frame.normal[0].is_nan());
    assert!(cubic.frame(2.0, Side::Below).is_err());
}

#[test]
fn a_circle_of_quadrants_is_seen_to_be_c1_and_a_corner_to_be_none() {
    let joints = circle().continuity(1e-9).unwrap();
    assert_eq!(joints.len(), 4);
    for joint in joints {
        assert_eq!(
            (joint.multiplicity.min(3), joint.order),
            (if joint.u == 4.0 { 3 } else { 2 }, 1),
            "{joint:?}"
        );
        assert!(joint.tangent_angle < 1e-14 && joint.curvature_jump < 1e-13);
    }
    let corner =
        Curve::new(&[0., 0., 1., 2., 2.], 1, &[[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0]], None)
            .unwrap();
    let joints = corner.continuity(1e-9).unwrap();
    assert_eq!((joints[0].order, joints.len()), (0, 1));
    assert!((joints[0].tangent_angle - std::f64::consts::FRAC_PI_2).abs() < 1e-15);
    assert!((joints[0].jumps[1] - 2f64.sqrt()).abs() < 1e-15);
}

#[test]
fn the_derivative_of_a_circle_is_a_curve_at_right_angles_and_that_of_a_corner_does_not_exist() {
    let (circle, derivative) = (circle(), circle().derivative().unwrap());
    assert_eq!(derivative.degree(), 4);
    for u in places(0.0, 4.0, 50) {
        let (p, d) = (circle.evaluate(u), derivative.evaluate(u));
        assert!((0..3).map(|x| p[x] * d[x]).sum::<f64>().abs() < 1e-13);
    }
    let corner =
        Curve::new(&[0., 0., 1., 2., 2.], 1, &[[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0]], None)
            .unwrap();
    assert_eq!(
        corner.derivative().unwrap_err().to_string(),
        "knots: the derivative jumps at u = 1"
    );
    let straight =
        Curve::new(&[0., 0., 1., 2., 2.], 1, &[[0.0; 3], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0]], None)
            .unwrap();
    assert_eq!(straight.derivative().unwrap().evaluate(1.5), [1.0, 0.0, 0.0]);
}

#[test]
fn power_forms_and_matrices_that_are_no_shapes_are_refused() {
    let bad = |coefficients: Vec<[f64; 4]>, domain: [f64; 2]| {
        Curve::from_power(&PowerCurve { domain, coefficients }).unwrap_err().to_string()
    };
    assert!(bad(vec![], [0.0, 1.0]).starts_with("degree"));
    assert!(bad(vec![[1.0; 4]; 40], [0.0, 1.0]).starts_with("degree: 39"));
    assert!(
        bad(vec![[1.0; 4], [f64::NAN; 4]], [0.0, 1.0]).starts_with("coefficients: coefficient 1")
    );
    assert!(bad(vec![[1.0; 4]; 2], [1.0, 1.0]).starts_with("domain"));
    assert!(
        bad(vec![[0.0, 0.0, 0.0, 1.0], [0.0, 0.0, 0.0, -2.0]], [0.0, 1.0]).contains("weight 1")
    );
    let circle = circle();
    let mut matrix = [[1.0, 0., 0., 0.], [0., 1., 0., 0.], [0., 0., 1., 0.], [1.0, 0.0, 0.0, 0.5]];
    assert!(circle.projective(&matrix).unwrap_err().to_string().starts_with("matrix: pole"));
    matrix[1][2] = f64::INFINITY;
    assert_eq!(
        circle.projective(&matrix).unwrap_err().to_string(),
        "matrix: entry (1, 2) is not finite"
    );
    let flat = [[1.0, 0., 0., 0.], [0., 0., 0., 0.], [0., 0., 0., 3.0]];
    assert_eq!(circle.affine(&flat).unwrap().evaluate(1.0)[1..], [0.0, 3.0]);
}

#[test]
fn a_patch_goes_through_the_power_form() {
    let poles: Vec<[f64; 3]> =
        (0..12).map(|k| [(k / 4) as f64, (k % 4) as f64, ((k * 7) % 5) as f64]).collect();
    let weights: Vec<f64> = (0..12).map(|k| 1.0 + 0.1 * (k % 3) as f64).collect();
    let knots =
        |p: usize| (0..2 * p + 2).map(|i| if i <= p { 2.0 } else { 5.0 }).collect::<Vec<f64>>();
    let patch = Surface::new(&knots(2), &knots(3), 2, 3, &poles, 3, 4, Some(&weights)).unwrap();
    let (power, counts) = patch.power_pieces().unwrap();
    assert_eq!((counts, power[0].domain, power[0].degree), ([1, 1], [2.0, 5.0, 2.0, 5.0], [2, 3]));
    let back = Surface::from_power(&power[0]).unwrap();
    assert!(patch.difference(&back).unwrap().bound < 1e-12);
    let (s, t) = (0.25f64, 0.75f64);
    let mut h = [0.0; 4];
    for (k, a) in power[0].coefficients.iter().enumerate() {
        let factor = s.powi((k / 4) as i32) * t.powi((k % 4) as i32);
        h = std::array::from_fn(|x| h[x] + factor * a[x]);
    }
    let point = [0, 1, 2].map(|x| h[x] / h[3]);
    assert!(gap(point, patch.evaluate(2.0 + 3.0 * s, 2.0 + 3.0 * t)) < 1e-13);
}
