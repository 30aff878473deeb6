//! Elementary surfaces: forms, seams, derivatives, refusals.

use super::*;

fn axes() -> Axes {
    Axes::around([0.3, -0.2, 1.0], [1.0, 2.0, -0.7], [0.2, 0.1, 0.9]).unwrap()
}

fn meridian() -> Curve {
    let poles = [[1.5, 0.1, 0.0], [2.0, 0.1, 1.0], [1.0, 0.1, 2.0], [1.7, 0.1, 3.0]];
    let knots = [0.0, 0.0, 0.0, 0.4, 1.0, 1.0, 1.0];
    Curve::new(&knots, 2, &poles, Some(&[1.0, 2.0, 0.5, 1.0])).unwrap()
}

fn surfaces() -> Vec<ElementarySurface> {
    let axes = axes();
    let made = |kind, domain| ElementarySurface::new(kind, domain).unwrap();
    let turn = [0.0, TAU, 0.0, 1.0];
    vec![
        made(Elementary::Plane { axes }, [-1.0, 2.0, 0.5, 3.0]),
        made(Elementary::Cylinder { axes, radius: 0.7 }, turn),
        made(Elementary::Cylinder { axes, radius: 0.7 }, [0.3, 2.9, -2.0, 1.0]),
        made(Elementary::Cone { axes, radius: 0.5, half_angle: 0.3 }, turn),
        made(Elementary::Sphere { axes, radius: 2.0 }, [0.0, TAU, -FRAC_PI_2, FRAC_PI_2]),
        made(Elementary::Sphere { axes, radius: 2.0 }, [-1.0, 2.0, -0.4, 1.1]),
        made(Elementary::Torus { axes, major: 2.0, minor: 0.5 }, [0.0, TAU, 0.0, TAU]),
        made(Elementary::Torus { axes, major: 0.5, minor: 2.0 }, [0.0, TAU, -1.2, 1.3]),
        made(
            Elementary::Revolution {
                origin: [0.0; 3],
                axis: [0.0, 0.0, 1.0],
                meridian: meridian(),
            },
            [0.5, 4.0, 0.2, 0.9],
        ),
        made(
            Elementary::Extrusion { curve: meridian(), direction: [0.3, 1.0, 0.0] },
            [0.1, 1.0, -1.0, 2.0],
        ),
    ]
}

#[test]
fn the_nurbs_form_has_the_same_corners_middles_borders_and_seams() {
    for surface in surfaces() {
        let forms = surface.usual_forms();
        let form = surface.nurbs(forms).unwrap();
        let ([a0, a1, b0, b1], [u0, u1, v0, v1]) = (form.domain(), surface.domain());
        let size = surface.size();
        // The middle of an arc is the middle of its parameters.
        for (i, j) in [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0), (0.5, 0.5), (0.5, 0.0)] {
            let at = |a: f64, b: f64, share: f64| a + share * (b - a);
            let p = surface.evaluate(at(u0, u1, i), at(v0, v1, j));
            let q = form.evaluate(at(a0, a1, i), at(b0, b1, j));
            assert!(norm(sub(p, q)) <= 4e-15 * size, "{surface:?} {i} {j}");
        }
        assert_eq!(surface.closed(), [form.is_closed_u(), form.is_closed_v()]);
        assert_eq!(surface.collapsed_edges(), form.collapsed_edges());
    }
}

#[test]
fn seams_are_closed_and_poles_collapsed_bit_for_bit() {
    for surface in surfaces() {
        let [u0, u1, v0, v1] = surface.domain();
        let share = |a: f64, b: f64, k: usize| a + (b - a) * k as f64 / 7.0;
        for k in 0..7 {
            let (u, v) = (share(u0, u1, k), share(v0, v1, k));
            if surface.closed()[0] {
                assert_eq!(surface.evaluate(u0, v), surface.evaluate(u1, v));
            }
            if surface.closed()[1] {
                assert_eq!(surface.evaluate(u, v0), surface.evaluate(u, v1));
            }
            for (edge, v) in [(2, v0), (3, v1)] {
                if surface.collapsed_edges()[edge] {
                    assert_eq!(surface.evaluate(u, v), surface.evaluate(u0, v));
                }
            }
        }
    }
}

#[test]
fn partials_are_the_limits_of_differences() {
    let h = 1e-5;
    for surface in surfaces() {
        let [u0, u1, v0, v1] = surface.domain();
        let (u, v) = (u0 + 0.37 * (u1 - u0), v0 + 0.61 * (v1 - v0));
        let mut here = [[0.0; 3]; 6];
        surface.partials(u, v, 2, &mut here);
        let around = |du: f64, dv: f64| {
            let mut out = [[0.0; 3]; 3];
            surface.partials(u + du, v + dv, 1, &mut out);
            out
        };
        let along_u = [around(h, 0.0), around(-h, 0.0)];
        let along_v = [around(0.0, h), around(0.0, -h)];
        let slope =
            |pair: &[[Vector; 3]; 2], k: usize| scaled(sub(pair[0][k], pair[1][k]), 0.5 / h);
        let pairs = [
            (here[1], slope(&along_u, 0)),
            (here[2], slope(&along_v, 0)),
            (here[3], slope(&along_u, 1)),
            (here[4], slope(&along_u, 2)),
            (here[5], slope(&along_v, 2)),
        ];
        for (k, (exact, rough)) in pairs.into_iter().enumerate() {
            assert!(norm(sub(exact, rough)) < 1e-6, "{surface:?} {k} {exact:?} {rough:?}");
        }
    }
}

#[test]
fn what_is_no_surface_is_refused_by_name() {
    let axes = Axes::STANDARD;
    let text = |kind, domain| ElementarySurface::new(kind, domain).unwrap_err().to_string();
    let sphere = |radius| Elementary::Sphere { axes, radius };
    assert_eq!(text(sphere(-1.0), [0.0, 1.0, 0.0, 1.0]), "radius: -1 is not positive");
    assert_eq!(text(sphere(1.0), [0.0, 7.0, 0.0, 1.0]), "domain: u spans more than a full turn");
    let inside = "domain: the radius is negative or 0 inside v";
    assert_eq!(text(sphere(1.0), [0.0, 1.0, 0.0, 2.0]), inside);
    let cone = Elementary::Cone { axes, radius: 1.0, half_angle: 0.5 };
    assert_eq!(text(cone, [0.0, 1.0, -3.0, 1.0]), inside);
    let spindle = Elementary::Torus { axes, major: 1.0, minor: 2.0 };
    assert_eq!(text(spindle, [0.0, 1.0, 0.0, 6.0]), inside);
    let skew = Axes { x: [1.0, 0.1, 0.0], ..axes };
    assert!(text(Elementary::Plane { axes: skew }, [0.0, 1.0, 0.0, 1.0]).starts_with("x: has"));
    let plane = Elementary::Plane { axes };
    let empty = "domain: entry 2 is not less than entry 3";
    assert_eq!(text(plane, [0.0, 1.0, 1.0, 1.0]), empty);
}
