//! Parameters found by inversion against the closed forms: seams, poles, corners, falling directions.

mod faces;

use std::f64::consts::{FRAC_PI_2, TAU};

use faces::{FORMS, KINDS, Random, face, sphere};
use footpoint::closest::{FootPoint, Workspace, flag};
use footpoint::elementary::{Axes, Elementary, ElementarySurface};
use footpoint::surface::Surface;
use footpoint::transform::{Relation, Transform};
use footpoint::trim::{ChangeOptions, Finding, Matching, Replacement, Support, form_transform};

/// The surface with its directions run through backwards where asked.
fn turned(surface: &Surface, turns: [bool; 2]) -> Surface {
    let (count_u, count_v) = (surface.knots_u().pole_count(), surface.knots_v().pole_count());
    let [u0, u1, v0, v1] = surface.domain();
    let knots = |values: &[f64], turn: bool, ends: [f64; 2]| -> Vec<f64> {
        let mirror = |x: &f64| if *x == ends[0] { ends[1] } else { ends[0] + (ends[1] - x) };
        if turn { values.iter().rev().map(mirror).collect() } else { values.to_vec() }
    };
    let place = |i: usize, j: usize| {
        let i = if turns[0] { count_u - 1 - i } else { i };
        let j = if turns[1] { count_v - 1 - j } else { j };
        i * count_v + j
    };
    let all: Vec<usize> = (0..count_u * count_v).map(|k| place(k / count_v, k % count_v)).collect();
    let poles: Vec<[f64; 3]> = all.iter().map(|&k| surface.poles()[k]).collect();
    let weights: Option<Vec<f64>> = surface.weights().map(|w| all.iter().map(|&k| w[k]).collect());
    Surface::new(
        &knots(surface.knots_u().values(), turns[0], [u0, u1]),
        &knots(surface.knots_v().values(), turns[1], [v0, v1]),
        surface.knots_u().degree(),
        surface.knots_v().degree(),
        &poles,
        count_u,
        count_v,
        weights.as_deref(),
    )
    .unwrap()
}

/// An elementary surface, a turned form of it, and the closed transform between them.
fn pair(surface: &ElementarySurface, round: usize) -> (Support, Support, Transform, [bool; 2]) {
    let turns = [round % 2 == 1, round / 2 % 2 == 1];
    let forms = if surface.angular()[1] && surface.full_turns()[1] {
        surface.usual_forms()
    } else {
        FORMS[round / 4 % FORMS.len()]
    };
    let mut form = turned(&surface.nurbs(forms).unwrap(), turns);
    let mut closed = form_transform(surface, forms).unwrap();
    let [s0, s1, t0, t1] = form.domain();
    let back = |turn: bool, range: [f64; 2]| {
        if turn { Relation::reversal(range) } else { Relation::identity(range) }.unwrap()
    };
    let turn = Transform::new(back(turns[0], [s0, s1]), back(turns[1], [t0, t1]));
    closed = closed.then(&turn).unwrap();
    if round % 3 == 2 {
        form = form.insert_knot_u(s0 + 0.37 * (s1 - s0), 1).unwrap();
    }
    (surface.clone().into(), form.into(), closed, turns)
}

/// Places of a domain: any, at and beside its borders, at corners.
fn place(random: &mut Random, domain: [f64; 4]) -> [f64; 2] {
    [0, 1].map(|k| {
        let [a, b] = [domain[2 * k], domain[2 * k + 1]];
        match random.below(8) {
            0 => a,
            1 => b,
            2 => a + (b - a) * 10f64.powf(random.between(-17.0, -3.0)),
            3 => b - (b - a) * 10f64.powf(random.between(-17.0, -3.0)),
            _ => random.between(a, b),
        }
    })
}

/// Compares images with the closed transform, both ways; the largest error as a share of the domain.
fn compare(surface: &ElementarySurface, round: usize, count: usize, random: &mut Random) -> f64 {
    let (from, to, closed, turns) = pair(surface, round);
    let mut most: f64 = 0.0;
    let ways = [(&from, &to, closed.clone()), (&to, &from, closed.inverse())];
    for (from, to, closed) in ways {
        let matching = Matching::new(from.clone(), to.clone(), 0.0).unwrap();
        assert_eq!(matching.rising(), turns.map(|turn| !turn));
        let places: Vec<[f64; 2]> = (0..count).map(|_| place(random, from.domain())).collect();
        let mut images = vec![FootPoint::unreached(); count];
        matching.images(&places, &mut images, 0, &mut |_| false).unwrap();
        let [s0, s1, t0, t1] = to.domain();
        for (at, image) in places.iter().zip(&images) {
            let expected = closed.apply(*at);
            assert_eq!(image.flags, 0, "{at:?} {image:?}");
            let off = ((image.u - expected[0]).abs() / (s1 - s0))
                .max((image.v - expected[1]).abs() / (t1 - t0));
            assert!(off <= 1e-12, "{round} {at:?}: {image:?}, not {expected:?}");
            // Places on a border stay on the border that the rule names, bit for bit.
            let [u0, u1, v0, v1] = from.domain();
            for (k, ends) in [[u0, u1], [v0, v1]].into_iter().enumerate() {
                if ends.contains(&at[k]) {
                    assert_eq!([image.u, image.v][k], expected[k], "{at:?}");
                }
            }
            most = most.max(off);
        }
    }
    most
}

#[test]
fn images_agree_with_closed_forms_on_spheres() {
    let mut random = Random(5);
    let mut most: f64 = 0.0;
    for round in 0..16 {
        let surface = sphere(&mut random);
        most = most.max(compare(&surface, round, 1000, &mut random));
    }
    println!("largest error {most:e}");
}

/// The long form: a million places; `cargo test --release --test matching -- --ignored --nocapture`.
#[test]
#[ignore = "a million places"]
fn images_agree_with_closed_forms_on_spheres_at_a_million_places() {
    let mut random = Random(6);
    let mut most: f64 = 0.0;
    for round in 0..20 {
        let surface = sphere(&mut random);
        most = most.max(compare(&surface, round, 25_000, &mut random));
    }
    println!("largest error {most:e}");
}

#[test]
fn images_agree_with_closed_forms_on_cylinders_cones_and_tori() {
    let mut random = Random(8);
    for round in 0..6 {
        let axes = Axes::around(random.vector(), random.vector(), random.vector()).unwrap();
        let kinds = [
            (Elementary::Cylinder { axes, radius: 2.0 }, [0.0, TAU, -1.0, 3.0]),
            (Elementary::Cone { axes, radius: 1.0, half_angle: 0.4 }, [0.0, TAU, 0.0, 3.0]),
            (Elementary::Cone { axes, radius: 0.0, half_angle: 0.4 }, [0.5, 0.5 + TAU, 0.0, 3.0]),
            (Elementary::Torus { axes, major: 3.0, minor: 1.0 }, [0.0, TAU, 0.0, TAU]),
            (Elementary::Sphere { axes, radius: 3.0 }, [0.3, 3.0, 0.1, FRAC_PI_2]),
        ];
        for (kind, domain) in kinds {
            let surface = ElementarySurface::new(kind, domain).unwrap();
            // Halves make a full or a half turn only.
            let round = if surface.full_turns()[0] { round % 4 } else { round % 4 + 12 };
            let round = match surface.kind() {
                Elementary::Sphere { .. } => round % 4 + 12,
                _ => round,
            };
            compare(&surface, round, 500, &mut random);
        }
    }
}

#[test]
fn faces_under_a_matching_stay_closed_and_valid() {
    let mut random = Random(9);
    for kind in 0..KINDS.len() {
        let (surface, face) = face(kind, &mut random);
        let (_, to, closed, _) = pair(&surface, kind);
        let matching = Matching::new(face.support().clone(), to.clone(), 0.0).unwrap();
        let transform = matching.transform().unwrap();
        let Elementary::Sphere { radius, .. } = *surface.kind() else { unreachable!() };
        let options =
            ChangeOptions { replacement: Replacement::Polyline, tolerance: 1e-4 * radius };
        let changed = face.changed(&transform, to.clone(), &options).unwrap();
        let exact = face.changed(&closed, to, &options).unwrap();
        assert!(exact.proven);
        for changed in [&changed, &exact] {
            let report = changed.face.report(2e-4 * radius).unwrap();
            let wrong: Vec<&Finding> = report.findings.iter().collect();
            assert!(wrong.is_empty(), "{kind}: {wrong:?}");
        }
        for ((_, _, a), (_, _, b)) in changed.face.coedges().zip(exact.face.coedges()) {
            let (p, q) = (a.start(), b.start());
            assert!((p[0] - q[0]).abs() <= 1e-12 && (p[1] - q[1]).abs() <= 1e-12);
        }
    }
}

#[test]
fn surfaces_that_do_not_match_are_refused() {
    let mut random = Random(10);
    let surface = sphere(&mut random);
    let Elementary::Sphere { axes, radius } = *surface.kind() else { unreachable!() };
    let text = |kind: Elementary, domain: [f64; 4]| {
        let other = ElementarySurface::new(kind, domain).unwrap();
        Matching::new(surface.clone().into(), other.into(), 0.0).unwrap_err().to_string()
    };
    let domain = surface.domain();
    let larger = text(Elementary::Sphere { axes, radius: 1.01 * radius }, domain);
    assert!(larger.starts_with("to: has no point of the surface"), "{larger}");
    let away = [1.0, 1.0 + TAU, domain[2], domain[3]];
    let seam = text(Elementary::Sphere { axes, radius }, away);
    assert!(seam.starts_with("to: its"), "{seam}");
    let tilted = Axes { x: axes.z, y: axes.x, z: axes.y, ..axes };
    let tilted = text(Elementary::Sphere { axes: tilted, radius }, domain);
    assert!(tilted.starts_with("to: "), "{tilted}");
    let matching = Matching::new(surface.clone().into(), surface.into(), 0.0).unwrap();
    let mut workspace = Workspace::default();
    for at in [[f64::NAN, 0.0], [7.0, 0.0], [1.0, -2.0]] {
        assert_ne!(matching.image(at, &mut workspace).flags & flag::BAD_QUERY, 0);
    }
}
