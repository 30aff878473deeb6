//! Coons, Ferguson, Gordon, skinned and swept surfaces, and offsets.

use footpoint::construct::*;
use footpoint::curve::Curve;
use footpoint::elementary::{Axes, CircleForm};
use footpoint::fit::interpolate;
use footpoint::surface::Surface;
use std::f64::consts::{PI, TAU};

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

/// A surface to take borders from.
fn sheet(weights: bool) -> Surface {
    let knots_u = [0., 0., 0., 0., 0.4, 1., 1., 1., 1.];
    let knots_v = [2., 2., 2., 3., 5., 5., 5.];
    let pole = |k: usize| {
        let (i, j) = ((k / 4) as f64, (k % 4) as f64);
        [i + 0.1 * j, j - 0.2 * (i * 1.3).sin(), (0.8 * i).sin() * (j + 1.0).cos()]
    };
    let poles: Vec<Vector> = (0..20).map(pole).collect();
    let list: Vec<f64> = (0..20).map(|k| 1.0 + 0.3 * (k as f64 * 1.1).sin()).collect();
    Surface::new(&knots_u, &knots_v, 3, 2, &poles, 5, 4, weights.then_some(&list[..])).unwrap()
}

fn borders(s: &Surface) -> [Curve; 4] {
    let [u0, u1, v0, v1] = s.domain();
    [s.isocurve_u(u0), s.isocurve_u(u1), s.isocurve_v(v0), s.isocurve_v(v1)]
}

fn along(curve: &Curve) -> Vec<Vector> {
    let (a, b) = curve.domain();
    (0..=400).map(|i| curve.evaluate(a + (b - a) * i as f64 / 400.0)).collect()
}

/// The greatest distance of a point of the first from the polyline through dense points of the second.
fn apart(a: &Curve, b: &Curve) -> f64 {
    let chain = along(b);
    let to_segment = |p: Vector, q: &[Vector]| {
        let d = sub(q[1], q[0]);
        let t = (dot(sub(p, q[0]), d) / dot(d, d)).clamp(0.0, 1.0);
        gap(p, [0, 1, 2].map(|k| q[0][k] + t * d[k]))
    };
    let near = |p: Vector| chain.windows(2).map(|q| to_segment(p, q)).fold(f64::INFINITY, f64::min);
    along(a).into_iter().step_by(7).map(near).fold(0.0, f64::max)
}

#[test]
fn a_coons_patch_has_its_borders() {
    let given = borders(&sheet(false));
    let patch = coons(&given).unwrap();
    assert_eq!(patch.domain(), [0.0, 1.0, 2.0, 5.0]);
    for (a, b) in borders(&patch).iter().zip(&given) {
        for (p, q) in along(a).into_iter().zip(along(b)) {
            assert!(gap(p, q) < 1e-13);
        }
    }
    // Rational borders: the same point sets, at other times.
    let given = borders(&sheet(true));
    let patch = coons(&given).unwrap();
    for (a, b) in borders(&patch).iter().zip(&given) {
        assert!(apart(a, b) < 1e-5, "{}", apart(a, b));
    }
    // A bilinear patch is its own.
    let flat = Surface::new(
        &[0., 0., 1., 1.],
        &[0., 0., 1., 1.],
        1,
        1,
        &[[0., 0., 0.], [0., 1., 1.], [1., 0., 2.], [1., 1., -1.]],
        2,
        2,
        None,
    )
    .unwrap();
    let again = coons(&borders(&flat)).unwrap();
    assert!(gap(again.evaluate(0.3, 0.6), flat.evaluate(0.3, 0.6)) < 1e-15);
    let mut open = borders(&flat);
    open[2] = line([0.0; 3], [1.0, 0.0, 1.9]).unwrap();
    let refused = coons(&open).unwrap_err().to_string();
    assert!(
        refused.contains("border 1 and border 2") && refused.contains("corner (1, 0)"),
        "{refused}"
    );
}

/// The derivative across a border as a curve: bicubic surfaces have it as a cubic with the knots of the border.
fn slope(s: &Surface, edge: usize) -> Curve {
    let [u0, u1, v0, v1] = s.domain();
    let at = [u0, u1, v0, v1][edge];
    let knots = if edge < 2 { s.knots_v() } else { s.knots_u() };
    let (a, b) = knots.domain();
    let count = knots.pole_count();
    let list: Vec<f64> = (0..count).map(|i| a + (b - a) * i as f64 / (count - 1) as f64).collect();
    let value = |t: f64| {
        let mut out = [[0.0; 3]; 3];
        if edge < 2 {
            s.partials(at, t, 1, &mut out)
        } else {
            s.partials(t, at, 1, &mut out)
        }
        out[1 + edge / 2]
    };
    let points: Vec<Vector> = list.iter().map(|&t| value(t)).collect();
    let fit = footpoint::fit::least_squares(
        knots.degree(),
        knots.values(),
        &list,
        &points,
        footpoint::fit::Ends::Interpolated,
    );
    fit.unwrap().spline.curve().unwrap()
}

#[test]
fn a_bicubic_coons_patch_has_its_borders_and_slopes() {
    let base = sheet(false);
    let given = borders(&base);
    let slopes = [0, 1, 2, 3].map(|edge| slope(&base, edge));
    let patch = coons_bicubic(&given, &slopes).unwrap();
    let [u0, u1, v0, v1] = patch.domain();
    for edge in 0..4 {
        for i in 0..=40 {
            let t = i as f64 / 40.0;
            let (u, v) = match edge {
                0 => (u0, v0 + (v1 - v0) * t),
                1 => (u1, v0 + (v1 - v0) * t),
                2 => (u0 + (u1 - u0) * t, v0),
                _ => (u0 + (u1 - u0) * t, v1),
            };
            let (mut ours, mut theirs) = ([[0.0; 3]; 3], [[0.0; 3]; 3]);
            patch.partials(u, v, 1, &mut ours);
            base.partials(u, v, 1, &mut theirs);
            for k in 0..3 {
                assert!(gap(ours[k], theirs[k]) < 1e-11, "edge {edge} at {t}: {k}");
            }
        }
    }
    let mut wrong = slopes.clone();
    wrong[1] = slopes[0].clone();
    assert!(
        coons_bicubic(&given, &wrong).unwrap_err().to_string().contains("does not fit at corner")
    );
}

#[test]
fn a_ferguson_patch_has_its_corners_slopes_and_twists() {
    let vector = |k: usize| [(k as f64).sin(), (2.0 * k as f64).cos(), 0.3 * k as f64];
    let block = |k: usize| [[vector(k), vector(k + 1)], [vector(k + 2), vector(k + 3)]];
    let given =
        Corners { points: block(0), slopes_u: block(4), slopes_v: block(8), twists: block(12) };
    let patch = ferguson(&given).unwrap();
    for i in 0..2 {
        for j in 0..2 {
            let mut out = [[0.0; 3]; 6];
            patch.partials(i as f64, j as f64, 2, &mut out);
            let wanted =
                [given.points, given.slopes_u, given.slopes_v, given.twists].map(|b| b[i][j]);
            for (k, wanted) in [0, 1, 2, 4].into_iter().zip(wanted) {
                assert!(gap(out[k], wanted) < 1e-13 * 10.0, "({i}, {j}) {k}");
            }
        }
    }
    let bad = Corners { twists: [[[f64::NAN; 3]; 2]; 2], ..given };
    assert!(ferguson(&bad).unwrap_err().to_string().contains("twists"));
}

#[test]
fn a_gordon_surface_passes_through_its_network() {
    let base = sheet(false);
    let (us, vs) = ([0.0, 0.3, 0.45, 0.8, 1.0], [2.0, 2.5, 3.6, 4.4, 5.0]);
    let in_u: Vec<Curve> = vs.iter().map(|&v| base.isocurve_v(v)).collect();
    let in_v: Vec<Curve> = us.iter().map(|&u| base.isocurve_u(u)).collect();
    let surface = gordon(&in_u, &vs, &in_v, &us).unwrap();
    for i in 0..=60 {
        let s = i as f64 / 60.0;
        for &v in &vs {
            assert!(gap(surface.evaluate(s, v), base.evaluate(s, v)) < 1e-13 * 10.0);
        }
        for &u in &us {
            let v = 2.0 + 3.0 * s;
            assert!(gap(surface.evaluate(u, v), base.evaluate(u, v)) < 1e-13 * 10.0);
        }
    }
    let mut wrong = in_u.clone();
    wrong[2] = base.isocurve_v(3.7);
    let refused = gordon(&wrong, &vs, &in_v, &us).unwrap_err().to_string();
    assert!(refused.contains("curves_u: curve 2"), "{refused}");
    assert!(gordon(&in_u, &vs[1..], &in_v, &us).is_err());
}

#[test]
fn a_skinned_surface_passes_through_its_sections() {
    let axes = |z: f64| Axes { origin: [0.0, 0.1 * z * z, z], ..Axes::STANDARD };
    let usual = ArcForm::usual(TAU);
    let thirds = ArcForm::Quadratic(CircleForm::Arcs(3));
    let made = |forms: [ArcForm; 4]| -> Vec<Curve> {
        [0.0, 1.0, 2.5, 4.0]
            .iter()
            .enumerate()
            .map(|(i, &z)| ellipse(&axes(z), [1.0 + 0.2 * z, 2.0 - 0.1 * z], [0.0, TAU], forms[i]))
            .collect::<Result<_, _>>()
            .unwrap()
    };
    let parameters = [0.0, 1.0, 2.0, 5.0];
    let mixed = made([usual, thirds, usual, ArcForm::Quintic]);
    let sections = made([usual; 4]);
    for (sections, degree) in [(&mixed, 1), (&sections, 2), (&sections, 3)] {
        let surface = skinned(sections, degree, Some(&parameters)).unwrap();
        for (section, &v) in sections.iter().zip(&parameters) {
            for i in 0..=60 {
                let u = i as f64 / 60.0;
                assert!(gap(surface.evaluate(u, v), section.evaluate(u)) < 1e-13 * 10.0);
            }
        }
        assert!(skinned(sections, degree, None).unwrap().is_closed_u());
    }
    let text = |sections: &[Curve], degree, list: Option<&[f64]>| {
        skinned(sections, degree, list).unwrap_err().to_string()
    };
    assert!(text(&sections, 4, None).contains("degree_v"));
    assert!(text(&sections[..1], 1, None).contains("sections: 1 given"));
    assert!(text(&sections, 3, Some(&[0.0, 1.0, 1.0, 2.0])).contains("parameter 2"));
    let same = [sections[0].clone(), sections[0].clone()];
    assert!(text(&same, 1, None).contains("section 1 is section 0"));
}

#[test]
fn a_circle_swept_along_a_circle_is_a_torus() {
    let spine = circle(&Axes::STANDARD, 3.0, ArcForm::usual(TAU)).unwrap();
    let start = Axes {
        origin: [3.0, 0.0, 0.0],
        x: [1.0, 0.0, 0.0],
        y: [0.0, 0.0, 1.0],
        z: [0.0, -1.0, 0.0],
    };
    let profile = circle(&start, 1.0, ArcForm::usual(TAU)).unwrap();
    for tolerance in [1e-3, 1e-6, 1e-8] {
        let options = SweepOptions { tolerance, ..SweepOptions::default() };
        let swept = swept(&profile, &spine, &options).unwrap();
        let (error, measured) = (swept.error, swept.measured);
        assert!(measured <= error && error <= tolerance, "{tolerance:e}: {error:e} {measured:e}");
        assert!(swept.holonomy.abs() < 1e-9);
        let [u0, u1, v0, v1] = swept.surface.domain();
        for i in 0..=40 {
            for j in 0..=300 {
                let u = u0 + (u1 - u0) * i as f64 / 40.0;
                let [x, y, z] = swept.surface.evaluate(u, v0 + (v1 - v0) * j as f64 / 300.0);
                assert!(((x.hypot(y) - 3.0).hypot(z) - 1.0).abs() <= error);
            }
        }
    }
}

#[test]
fn a_sweep_does_not_twist_and_keeps_its_profile_rigid() {
    // A helix: the frame turns against its tangent by torsion times length, relative to the Frenet frame.
    let list: Vec<f64> = (0..200).map(|i| i as f64 / 199.0).collect();
    let (radius, rise, turns) = (2.0, 0.5, TAU);
    let helix = |t: f64| [radius * (turns * t).cos(), radius * (turns * t).sin(), rise * turns * t];
    let points: Vec<Vector> = list.iter().map(|&t| helix(t)).collect();
    let spine = interpolate(5, &list, &points).unwrap().spline.curve().unwrap();
    let start = helix(0.0);
    let poles = [start, [start[0] + 0.4, 0.0, 0.0], [start[0] + 0.4, 0.3, 0.2]];
    let profile = Curve::new(&[0., 0., 0., 1., 1., 1.], 2, &poles, None).unwrap();
    let result = swept(&profile, &spine, &SweepOptions::default()).unwrap();
    let end = |u: f64| result.surface.evaluate(u, 1.0);
    // Rigid: lengths within the profile stay.
    for (a, b) in [(0.0, 1.0), (0.2, 0.7)] {
        let before = gap(profile.evaluate(a), profile.evaluate(b));
        assert!((gap(end(a), end(b)) - before).abs() < 4e-6);
    }
    // After one turn the Frenet normal is the same as at the start; the frame has turned by the total torsion.
    let speed = (radius * radius + rise * rise).sqrt();
    let torsion = rise / (speed * speed) * speed * turns;
    let tangent = [0.0, radius / speed, rise / speed];
    let normal = [1.0, 0.0, 0.0];
    let binormal = [0.0, -rise / speed, radius / speed];
    let arm = result.surface.evaluate(0.0, 1.0);
    assert!(gap(arm, spine.evaluate(1.0)) < 2e-6);
    // The middle pole of the quadratic: its direction from the start, moved.
    let moved = {
        let (p, q, r) = (end(0.0), end(0.5), end(1.0));
        [0, 1, 2].map(|k| 2.0 * q[k] - 0.5 * p[k] - 0.5 * r[k] - p[k])
    };
    let along = [dot(moved, normal), dot(moved, binormal), dot(moved, tangent)];
    let angle = along[1].atan2(along[0]);
    // `normal` points away from the axis: angles count the other way round.
    let wrapped = (angle - torsion + PI).rem_euclid(TAU) - PI;
    assert!(wrapped.abs() < 2e-5 && along[2].abs() < 4e-6, "{angle} {torsion}");
    let corner =
        Curve::new(&[0., 0., 1., 2., 2.], 1, &[[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0]], None);
    let refused =
        swept(&profile, &corner.unwrap(), &SweepOptions::default()).unwrap_err().to_string();
    assert!(refused.contains("corner at 1"), "{refused}");
    let close = SweepOptions { close: true, ..SweepOptions::default() };
    assert!(swept(&profile, &spine, &close).unwrap_err().to_string().contains("close"));
}

/// A closed spine out of the plane, smooth everywhere.
#[test]
fn a_closed_sweep_can_be_closed() {
    let around = |t: f64| [2.0 * t.cos(), 2.0 * t.sin(), 0.6 * (2.0 * t).sin() + 0.3 * t.cos()];
    let list: Vec<f64> = (0..=120).map(|i| TAU * i as f64 / 120.0).collect();
    let points: Vec<Vector> = list[..120].iter().map(|&t| around(t)).collect();
    let spine = footpoint::fit::interpolate_periodic(5, &list, &points).unwrap();
    let spine = spine.spline.curve().unwrap().clamp().unwrap();
    let start = spine.evaluate(spine.domain().0);
    let poles = [start, [start[0] + 0.4, start[1] + 0.1, start[2]]];
    let profile = Curve::new(&[0., 0., 1., 1.], 1, &poles, None).unwrap();
    let open = swept(&profile, &spine, &SweepOptions::default()).unwrap();
    assert!(open.holonomy.abs() > 0.01, "{}", open.holonomy);
    let [_, u1, v0, v1] = open.surface.domain();
    let torn = gap(open.surface.evaluate(u1, v0), open.surface.evaluate(u1, v1));
    assert!(torn > 1e-3);
    let close = SweepOptions { close: true, ..SweepOptions::default() };
    let closed = swept(&profile, &spine, &close).unwrap();
    let torn = gap(closed.surface.evaluate(u1, v0), closed.surface.evaluate(u1, v1));
    assert!(torn < 1e-9, "{torn}");
    let once = SweepOptions { close: true, twist: TAU, ..SweepOptions::default() };
    let twisted = swept(&profile, &spine, &once).unwrap();
    let torn = gap(twisted.surface.evaluate(u1, v0), twisted.surface.evaluate(u1, v1));
    assert!(torn < 1e-9, "{torn}");
    let half = 0.5 * (v0 + v1);
    assert!(gap(twisted.surface.evaluate(u1, half), closed.surface.evaluate(u1, half)) > 0.4);
}
