//! Pcurves of edges: the faces that users of other libraries suffer from, each one a test by name.

mod known_shapes;

use footpoint::curve::Curve;
use footpoint::fit::{Adaptive, of_function};
use footpoint::index::IndexedSurface;
use footpoint::pcurve::lift::{LiftOptions, lift};
use footpoint::pcurve::pull::{PullOptions, Pulled, pulled};
use footpoint::pcurve::{Direction, Pcurve};
use footpoint::surface::Surface;
use known_shapes::{Vector, norm, sphere, sub, torus};

/// The curve in space near a function.
fn edge(function: impl Fn(f64) -> Vector, domain: [f64; 2]) -> Curve {
    let options = Adaptive { degree: 5, tolerance: 1e-11, ..Adaptive::default() };
    let fit = of_function(|t| Some(function(t)), domain, &options).unwrap();
    fit.spline.curve().unwrap()
}

fn pull(surface: &IndexedSurface, edge: &Curve, tolerance: f64) -> Pulled {
    let options = PullOptions { tolerance, ..PullOptions::default() };
    surface.pull(edge, &options, &mut || false).unwrap()
}

/// Pieces follow each other in the edge, are proven, and the proof holds at samples.
fn check(surface: &IndexedSurface, edge: &Curve, found: &Pulled, tolerance: f64) {
    let (mut t, end) = edge.domain();
    let [u0, u1, v0, v1] = surface.surface().domain();
    for piece in &found.pieces {
        let (from, to) = piece.curve.domain();
        assert_eq!(from, t);
        t = to;
        assert_eq!(piece.flags & pulled::NOT_PROVEN, 0, "{:?}", piece.deviation);
        assert!(piece.deviation.bound <= tolerance);
        let mut most: f64 = 0.0;
        for k in 0..=1000 {
            let t = from + (to - from) * f64::from(k) / 1000.0;
            let [u, v, _] = piece.curve.evaluate(t);
            assert!(u0 <= u && u <= u1 && v0 <= v && v <= v1, "{u} {v}");
            most = most.max(norm(sub(surface.surface().evaluate(u, v), edge.evaluate(t))));
        }
        assert!(most <= piece.deviation.bound + 1e-14, "{most} {:?}", piece.deviation);
    }
    assert_eq!(t, end);
}

#[test]
fn a_curve_over_both_seams_of_a_torus_is_cut_at_each() {
    let torus = torus();
    // Twice round the tube and once round the axis; at t = 0 away from both seams.
    let at = |t: f64| {
        let (a, b) = (0.3 + t, 0.7 + 2.0 * t);
        [(2.0 + 0.5 * b.cos()) * a.cos(), (2.0 + 0.5 * b.cos()) * a.sin(), 0.5 * b.sin()]
    };
    let edge = edge(at, [0.0, 2.0 * std::f64::consts::PI]);
    let found = pull(&torus, &edge, 1e-7);
    check(&torus, &edge, &found, 1e-7);
    assert_eq!(found.pieces.len(), 4);
    for pair in found.pieces.windows(2) {
        let end = pair[0].curve.evaluate(pair[0].curve.domain().1);
        let start = pair[1].curve.evaluate(pair[1].curve.domain().0);
        // One parameter goes over from one end of the domain to the other, exactly.
        let jumps = (0..2).filter(|&k| (end[k], start[k]) == (4.0, 0.0)).count();
        assert_eq!(jumps, 1, "{end:?} {start:?}");
        assert!(pair[0].flags & pulled::TO_SEAM != 0 && pair[1].flags & pulled::FROM_SEAM != 0);
    }
}

fn quarter_cylinder(quarters: usize) -> IndexedSurface {
    let (knots, ring) = known_shapes::circle_parts(0.0, 4.0);
    let count = 2 * quarters + 1;
    let mut u = knots[..3 + 2 * quarters].to_vec();
    u.push(quarters as f64);
    let (mut poles, mut weights) = (Vec::new(), Vec::new());
    for ([x, y], w) in &ring[..count] {
        for z in [-1.0, 1.0] {
            poles.push([*x, *y, z]);
            weights.push(*w);
        }
    }
    let v = [0., 0., 1., 1.];
    let made = Surface::new(&u, &v, 2, 1, &poles, count, 2, Some(&weights)).unwrap();
    IndexedSurface::new(made)
}

#[test]
fn an_oblique_cut_of_a_270_degree_cylinder_stays_on_it() {
    let cylinder = quarter_cylinder(3);
    let at = |a: f64| [a.cos(), a.sin(), 0.5 * a.cos() - 0.3 * a.sin()];
    let edge = edge(at, [0.0, 1.5 * std::f64::consts::PI]);
    let found = pull(&cylinder, &edge, 1e-8);
    check(&cylinder, &edge, &found, 1e-8);
    assert_eq!((found.pieces.len(), found.flags()), (1, 0));
    let curve = &found.pieces[0].curve;
    assert!(curve.evaluate(0.0)[0].abs() < 1e-9);
    assert!((curve.evaluate(curve.domain().1)[0] - 3.0).abs() < 1e-9);
}

#[test]
fn borders_generatrices_and_circles_become_isolines() {
    let cylinder = quarter_cylinder(3);
    let surface = cylinder.surface();
    for curve in [surface.isocurve_u(0.0), surface.isocurve_u(1.7), surface.isocurve_v(0.25)] {
        let found = pull(&cylinder, &curve, 0.0);
        check(&cylinder, &curve, &found, 1e-6);
        assert_eq!((found.pieces.len(), found.pieces[0].curve.degree()), (1, 1));
        assert!(found.deviation().bound < 1e-12, "{:?}", found.deviation());
    }
}

#[test]
fn an_edge_along_a_seam_says_so_and_takes_the_side_of_the_hint() {
    let torus = torus();
    let edge = torus.surface().isocurve_u(0.0);
    let found = pull(&torus, &edge, 1e-9);
    check(&torus, &edge, &found, 1e-9);
    assert_eq!(found.flags(), pulled::ALONG_SEAM_U);
    assert_eq!(found.pieces[0].curve.poles()[0][0], 0.0);
    let options = PullOptions { hint: Some([4.0, 0.0]), ..PullOptions::default() };
    let other = torus.pull(&edge, &options, &mut || false).unwrap();
    assert_eq!(other.pieces[0].curve.poles()[0][0], 4.0);
}

#[test]
fn a_great_circle_over_the_pole_is_two_meridians() {
    let sphere = sphere([0.0, 4.0]);
    // From the equator at longitude 0.4 over the north pole to the equator on the other side.
    let at = |a: f64| [a.cos() * 0.4f64.cos(), a.cos() * 0.4f64.sin(), a.sin()];
    let edge = edge(at, [0.0, std::f64::consts::PI]);
    let found = pull(&sphere, &edge, 1e-8);
    check(&sphere, &edge, &found, 1e-8);
    assert_eq!(found.pieces.len(), 2);
    let (a, b) = (&found.pieces[0], &found.pieces[1]);
    assert!(a.flags & pulled::TO_COLLAPSED != 0 && b.flags & pulled::FROM_COLLAPSED != 0);
    let (end, start) = (a.curve.evaluate(a.curve.domain().1), b.curve.evaluate(b.curve.domain().0));
    assert_eq!((end[1], start[1]), (2.0, 2.0));
    assert!((start[0] - end[0] - 2.0).abs() < 1e-6, "{end:?} {start:?}");
}

#[test]
fn a_small_circle_through_the_pole_has_limits_there() {
    let sphere = sphere([0.0, 4.0]);
    // The sphere cut by the plane through the pole with normal (1, 0.2, 1).
    let n: Vector = [1.0, 0.2, 1.0].map(|x: f64| x / 2.04f64.sqrt());
    let d = n[2];
    let r = (1.0 - d * d).sqrt();
    let a = [n[1], -n[0], 0.0].map(|x| x / (n[0] * n[0] + n[1] * n[1]).sqrt());
    let b = known_cross(n, a);
    let at = |t: f64| std::array::from_fn(|k| d * n[k] + r * (t.cos() * a[k] + t.sin() * b[k]));
    let edge = edge(at, [0.0, 2.0 * std::f64::consts::PI]);
    let found = pull(&sphere, &edge, 1e-7);
    check(&sphere, &edge, &found, 1e-7);
    assert!(found.flags() & pulled::TO_COLLAPSED != 0);
}

#[test]
fn a_circle_that_passes_the_pole_at_a_millionth_turns_fast_and_is_one_curve() {
    let sphere = sphere([0.0, 4.0]);
    let tilt = 1e-4f64;
    let at = |a: f64| {
        let [x, y, z] = [a.cos(), a.sin() * tilt.sin(), a.sin() * tilt.cos()];
        [x, y, z]
    };
    let edge = edge(at, [0.2, 3.0]);
    let found = pull(&sphere, &edge, 1e-7);
    check(&sphere, &edge, &found, 1e-7);
    assert_eq!(found.pieces.len(), 1);
}

fn known_cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// A band between two helices: the ribbon of a thread, 0.1 wide, of `turns` turns with pitch 0.12.
fn ribbon(turns: usize) -> IndexedSurface {
    let (from, to) = (0.0, turns as f64 * 2.0 * std::f64::consts::PI);
    let options = Adaptive { degree: 5, tolerance: 1e-9, ..Adaptive::default() };
    let row = |r: f64, z: f64| {
        let helix =
            move |t: f64| Some([r * t.cos(), r * t.sin(), z + 0.12 * t / 6.283185307179586]);
        of_function(helix, [from, to], &options).unwrap().spline
    };
    let (inner, outer) = (row(1.0, 0.0), row(1.1, 0.05));
    // Both on the knots of the finer one would need insertion; the fits of one shape have the same knots.
    assert_eq!(inner.knots().values(), outer.knots().values());
    let poles: Vec<Vector> =
        inner.poles().iter().zip(outer.poles()).flat_map(|(a, b)| [*a, *b]).collect();
    let (u, count) = (inner.knots().values(), inner.poles().len());
    let made = Surface::new(u, &[0., 0., 1., 1.], 5, 1, &poles, count, 2, None).unwrap();
    IndexedSurface::new(made)
}

#[test]
fn a_curve_along_a_thread_keeps_its_turn() {
    let ribbon = ribbon(12);
    let surface = ribbon.surface().clone();
    let [u0, u1, ..] = surface.domain();
    let wave = |t: f64| surface.evaluate(t, 0.5 + 0.45 * (1.3 * t).sin());
    let edge = edge(wave, [u0 + 0.1, u1 - 0.1]);
    let found = pull(&ribbon, &edge, 1e-6);
    check(&ribbon, &edge, &found, 1e-6);
    assert_eq!(found.pieces.len(), 1);
    let curve = &found.pieces[0].curve;
    for k in 0..=200 {
        let t = u0 + 0.1 + (u1 - u0 - 0.2) * f64::from(k) / 200.0;
        assert!((curve.evaluate(t)[0] - t).abs() < 1e-4);
    }
}

#[test]
fn a_tiny_face_on_a_huge_surface_keeps_its_digits() {
    // A wavy bicubic a kilometre wide, an edge of three millimetres.
    let knots = [0., 0., 0., 0., 1., 2., 3., 3., 3., 3.];
    let mut poles = Vec::new();
    for i in 0..6 {
        for j in 0..6 {
            let z = f64::from((i * 7 + j * 5) % 4) * 3e4;
            poles.push([f64::from(i) * 2e5, f64::from(j) * 2e5, z]);
        }
    }
    let surface = Surface::new(&knots, &knots, 3, 3, &poles, 6, 6, None).unwrap();
    let at = |t: f64| surface.evaluate(1.2 + 1e-6 * t.cos(), 0.8 + 1e-6 * t.sin());
    let options = Adaptive { degree: 3, tolerance: 1e-7, ..Adaptive::default() };
    let fit = of_function(|t| Some(at(t)), [0.0, 4.0], &options).unwrap();
    let edge = fit.spline.curve().unwrap();
    let huge = IndexedSurface::new(surface.clone());
    let found = pull(&huge, &edge, 1e-6);
    check(&huge, &edge, &found, 1e-6);
}

#[test]
fn an_edge_beside_the_surface_is_told_and_a_point_refused() {
    let cylinder = quarter_cylinder(3);
    let at = |a: f64| [1.001 * a.cos(), 1.001 * a.sin(), 0.1];
    let found = pull(&cylinder, &edge(at, [0.2, 1.2]), 1e-6);
    assert_eq!(found.flags(), pulled::NOT_PROVEN | pulled::NOT_ON_SURFACE);
    let deviation = found.deviation();
    assert!((deviation.bound - 0.001).abs() < 1e-4, "{deviation:?}");
    let point = Curve::new(&[0., 0., 1., 1.], 1, &[[1.0, 0.0, 0.0]; 2], None).unwrap();
    let refused = cylinder.pull(&point, &PullOptions::default(), &mut || false).unwrap_err();
    assert!(refused.to_string().starts_with("edge: it is a single point"));
    let options = PullOptions { tolerance: f64::NAN, ..PullOptions::default() };
    assert!(cylinder.pull(&point, &options, &mut || false).is_err());
}

fn hill() -> Surface {
    let knots = [0., 0., 0., 0., 0.3, 1., 1., 1., 1.];
    let mut poles = Vec::new();
    let mut weights = Vec::new();
    for i in 0..5 {
        for j in 0..5 {
            poles.push([f64::from(i), f64::from(j), f64::from((i * 3 + j * 2) % 5) * 0.4]);
            weights.push(1.0 + 0.2 * f64::from((i + 2 * j) % 3));
        }
    }
    Surface::new(&knots, &knots, 3, 3, &poles, 5, 5, Some(&weights)).unwrap()
}

/// The image is within its bound of the surface's points, at equal parameters.
fn check_image(surface: &Surface, pcurve: &Pcurve, options: &LiftOptions, exact: bool, limit: f64) {
    let spline = pcurve.as_spline().unwrap();
    let lifted = lift(surface, pcurve, options).unwrap();
    assert_eq!(lifted.exact, exact);
    assert!(lifted.deviation.bound <= limit, "{:?}", lifted.deviation);
    let (a, b) = spline.domain();
    assert_eq!(lifted.curve.domain(), (a, b));
    for k in 0..=2000 {
        let t = (a + (b - a) * f64::from(k) / 2000.0).clamp(a, b);
        let [u, v, _] = spline.evaluate(t);
        let apart = norm(sub(surface.evaluate(u, v), lifted.curve.evaluate(t)));
        assert!(apart <= lifted.deviation.bound + 1e-14, "{t} {apart} {:?}", lifted.deviation);
    }
}

#[test]
fn images_are_exact_where_degrees_allow_and_proven_elsewhere() {
    let surface = hill();
    let usual = LiftOptions { tolerance: 1e-8, ..LiftOptions::default() };
    for (from, to) in [(0.1, 0.8), (0.9, 0.0)] {
        let isoline = Pcurve::isoline(Direction::U, 0.4, from, to).unwrap();
        check_image(&surface, &isoline, &usual, true, 1e-12);
    }
    let line = Pcurve::polyline(&[[0.1, 0.9], [0.7, 0.2], [0.75, 0.9]]).unwrap();
    check_image(&surface, &line, &usual, true, 1e-12);
    let poles = [[0.1, 0.2, 0.0], [0.5, 1.0, 0.0], [0.6, 0.0, 0.0], [0.9, 0.8, 0.0]];
    let weights = [1.0, 2.0, 0.7, 1.0];
    let cubic = Curve::new(&[0., 0., 0., 0., 2., 2., 2., 2.], 3, &poles, Some(&weights)).unwrap();
    let cubic = Pcurve::spline(cubic).unwrap();
    check_image(&surface, &cubic, &usual, false, 1e-8);
    let composed = LiftOptions { exact_degree: 18, ..usual };
    check_image(&surface, &cubic, &composed, true, 1e-12);
    let arc = Pcurve::arc([0.5, 0.5], [0.4, 0.1], [-0.1, 0.3], [0.2, 5.9]).unwrap();
    check_image(&surface, &arc, &usual, false, 1e-8);
}

#[test]
fn what_is_lifted_is_pulled_back() {
    let surface = IndexedSurface::new(hill());
    let arc = Pcurve::arc([0.5, 0.5], [0.4, 0.1], [-0.1, 0.3], [0.2, 5.9]).unwrap();
    let fine = LiftOptions { tolerance: 1e-9, ..LiftOptions::default() };
    let image = lift(surface.surface(), &arc, &fine).unwrap().curve;
    for (tolerance, degree) in [(1e-4, 3), (1e-6, 3), (1e-7, 5), (1e-7, 2)] {
        let options = PullOptions { tolerance, degree, ..PullOptions::default() };
        let found = surface.pull(&image, &options, &mut || false).unwrap();
        check(&surface, &image, &found, tolerance);
        assert_eq!(found.pieces.len(), 1);
        let (ours, given) = (&found.pieces[0].curve, arc.as_spline().unwrap());
        for k in 0..=100 {
            let t = 0.2 + 5.7 * f64::from(k) / 100.0;
            assert!(
                norm(sub(ours.evaluate(t.min(5.9)), given.evaluate(t.min(5.9)))) < 10.0 * tolerance
            );
        }
    }
}

#[test]
fn a_curve_that_leaves_the_domain_is_refused_with_the_place() {
    let surface = hill();
    let text =
        |pcurve: &Pcurve| lift(&surface, pcurve, &LiftOptions::default()).unwrap_err().to_string();
    let line = Pcurve::polyline(&[[0.1, 0.9], [1.2, 0.2]]).unwrap();
    assert_eq!(text(&line), "pcurve: at 1.0 it leaves the domain, u = 1.2");
    let isoline = Pcurve::isoline(Direction::V, -0.5, 0.0, 1.0).unwrap();
    assert_eq!(text(&isoline), "pcurve: at 0.0 it leaves the domain, v = -0.5");
}
