//! Faces under other parametrisations of their surfaces: the six properties, round trips on a thousand spheres, reports.

mod faces;

use std::f64::consts::{FRAC_PI_2, TAU};
use std::sync::Arc;

use faces::{FORMS, KINDS, Random, face};
use footpoint::bounds::{norm, sub};
use footpoint::callback::{CallbackSurface, SurfaceBounds};
use footpoint::elementary::{Axes, CircleForm, Elementary, ElementarySurface};
use footpoint::pcurve::{Direction, Pcurve};
use footpoint::transform::{Function, Relation, Transform, between};
use footpoint::trim::{
    ChangeOptions, Coedge, Edge, Finding, Loop, LoopKind, Replacement, Support, TrimmedSurface,
};

fn vertices(pcurve: &Pcurve) -> Vec<[f64; 2]> {
    match pcurve {
        Pcurve::Polyline(line) => line.points().to_vec(),
        other => vec![other.start(), other.end()],
    }
}

/// Loops, kinds, coedges, edges and their senses, flip: all that is not geometry.
fn topology(face: &TrimmedSurface) -> Vec<(LoopKind, Vec<(Option<usize>, bool)>)> {
    let coedges =
        |chain: &Loop| chain.coedges.iter().map(|c| (c.edge, c.reversed)).collect::<Vec<_>>();
    face.loops().iter().map(|chain| (chain.kind, coedges(chain))).collect()
}

#[test]
fn a_thousand_spheres_go_to_nurbs_and_back() {
    let mut random = Random(7);
    let (mut most_parameter, mut most_point) = (0.0f64, 0.0f64);
    for round in 0..1000 {
        let (surface, face) = face(round % KINDS.len(), &mut random);
        let Elementary::Sphere { radius, .. } = *surface.kind() else { unreachable!() };
        let forms = FORMS[round / KINDS.len() % FORMS.len()];
        // Polylines are their vertices here; what becomes one has its vertices on the curve whatever the tolerance.
        let options =
            ChangeOptions { replacement: Replacement::Vertices, tolerance: 1e-3 * radius };
        let there = face.to_nurbs(forms, &options).unwrap();
        let back = there.face.to_elementary(surface.clone(), forms, &options).unwrap();
        for other in [&there.face, &back.face] {
            assert_eq!(topology(&face), topology(other));
            assert_eq!(other.edges().len(), face.edges().len());
            assert_eq!(other.is_flipped(), face.is_flipped());
        }
        for ((_, _, old), ((_, _, image), (_, _, new))) in
            face.coedges().zip(there.face.coedges().zip(back.face.coedges()))
        {
            // Ends keep; what is not polyline may have become one, with vertices on it.
            let border = |[u, v]: [f64; 2]| [u == 0.0, u == TAU, v == -FRAC_PI_2, v == FRAC_PI_2];
            assert_eq!(border(old.start()), border(new.start()));
            let scale = [TAU, TAU / 2.0];
            let isoline = matches!(old.pcurve, Pcurve::Isoline(_));
            assert_eq!(isoline, matches!(image.pcurve, Pcurve::Isoline(_)));
            assert_eq!(isoline, matches!(new.pcurve, Pcurve::Isoline(_)));
            let (was, is) = (vertices(&old.pcurve), vertices(&new.pcurve));
            let (a, b) = match (&old.pcurve, &new.pcurve) {
                (Pcurve::Spline(_) | Pcurve::Arc(_), Pcurve::Polyline(line)) => {
                    let places = line.parameters().iter().map(|&t| old.pcurve.evaluate(t));
                    (places.collect::<Vec<_>>(), line.points().to_vec())
                }
                _ => (was, is),
            };
            assert_eq!(a.len(), b.len());
            for (p, q) in a.iter().zip(&b) {
                for k in 0..2 {
                    most_parameter = most_parameter.max((p[k] - q[k]).abs() / scale[k]);
                }
                let (p, q) = (face.support().evaluate(*p), back.face.support().evaluate(*q));
                most_point = most_point.max(norm(sub(p, q)) / radius);
            }
            for (p, q) in a.iter().zip(vertices(&image.pcurve)) {
                let (p, q) = (face.support().evaluate(*p), there.face.support().evaluate(q));
                most_point = most_point.max(norm(sub(p, q)) / radius);
            }
        }
        // Loops stay closed as they were.
        for (other, chain) in [(&there.face, "there"), (&back.face, "back")] {
            for (k, old) in face.loops().iter().enumerate() {
                let new = &other.loops()[k];
                for i in 0..old.coedges.len() {
                    let next = (i + 1) % old.coedges.len();
                    let was = old.coedges[i].end() == old.coedges[next].start();
                    let is = new.coedges[i].end() == new.coedges[next].start();
                    assert!(is || !was, "{chain} {round}");
                }
            }
        }
    }
    assert!(most_parameter <= 1e-14, "{most_parameter:e}");
    assert!(most_point <= 1e-13, "{most_point:e}");
    println!("parameters {most_parameter:e}, points {most_point:e} of the radius");
}

#[test]
fn free_curves_stay_within_the_tolerance_as_polylines_and_as_splines() {
    let mut random = Random(11);
    for round in 0..20 {
        let (surface, face) = face(round % KINDS.len(), &mut random);
        let Elementary::Sphere { radius, .. } = *surface.kind() else { unreachable!() };
        let forms = FORMS[round % FORMS.len()];
        for (replacement, tolerance) in
            [(Replacement::Polyline, 1e-5 * radius), (Replacement::Spline, 1e-7 * radius)]
        {
            let options = ChangeOptions { tolerance, replacement };
            let changed = face.to_nurbs(forms, &options).unwrap();
            assert!(changed.proven && changed.deviation <= tolerance, "{changed:?}");
            for ((_, _, old), (_, _, new)) in face.coedges().zip(changed.face.coedges()) {
                if matches!(old.pcurve, Pcurve::Isoline(_)) {
                    continue;
                }
                assert_eq!(old.pcurve.domain(), new.pcurve.domain());
                for k in 0..=1000 {
                    let t = old.pcurve.parameter_at(f64::from(k) / 1000.0);
                    let p = face.support().evaluate(old.pcurve.evaluate(t));
                    let q = changed.face.support().evaluate(new.pcurve.evaluate(t));
                    let off = norm(sub(p, q));
                    assert!(off <= changed.deviation + 1e-13 * radius, "{round} {off:e}");
                }
            }
        }
    }
}

/// Relations of every kind on an interval, rising and falling.
fn relation(random: &mut Random, [a, b]: [f64; 2]) -> Relation {
    let from = random.between(-3.0, 3.0);
    let to = from + random.between(0.5, 4.0);
    let to = if random.unit() < 0.5 { [from, to] } else { [to, from] };
    let linear = Relation::linear([a, b], to).unwrap();
    match random.below(4) {
        0 => linear,
        1 => {
            let circle = Relation::circle(CircleForm::Halves, TAU, [a, b], [a, b]).unwrap();
            circle.then(&linear).unwrap()
        }
        2 => {
            let middle = a + random.between(0.3, 0.7) * (b - a);
            let value = a + random.between(0.3, 0.7) * (b - a);
            Relation::through(&[a, middle, b], &[a, value, b]).unwrap().then(&linear).unwrap()
        }
        _ => {
            let bend = random.between(0.2, 2.0);
            let span = b - a;
            let forward: Function =
                Arc::new(move |x| ((bend * (x - a) / span).exp() - 1.0) / (bend.exp() - 1.0));
            let backward: Function =
                Arc::new(move |y| a + span / bend * (y * (bend.exp() - 1.0) + 1.0).ln());
            let unit = Relation::function([a, b], forward, backward).unwrap();
            let image = unit.image();
            unit.then(&Relation::linear(image, to).unwrap()).unwrap()
        }
    }
}

/// The surface in other parameters, by a function.
fn composed(surface: &ElementarySurface, transform: &Transform) -> Support {
    let (surface, back) = (surface.clone(), transform.inverse());
    let function = move |s: f64, t: f64, _: usize, out: &mut [[f64; 3]; 6]| {
        let [u, v] = back.apply([s, t]);
        out[0] = surface.evaluate(u, v);
        Some(0)
    };
    let made = CallbackSurface::new(transform.image(), SurfaceBounds::default(), function);
    Support::Callback(Arc::new(made.expect("a surface")))
}

#[test]
fn the_six_properties_of_separable_transforms() {
    let mut random = Random(23);
    for round in 0..40 {
        let (surface, face) = face(round % KINDS.len(), &mut random);
        let [u0, u1, v0, v1] = surface.domain();
        let transform = Transform {
            u: relation(&mut random, [u0, u1]),
            v: relation(&mut random, [v0, v1]),
            swap: random.unit() < 0.3,
        };
        let Elementary::Sphere { radius, .. } = *surface.kind() else { unreachable!() };
        let tolerance = 1e-4 * radius;
        let before = face.report(tolerance).unwrap();
        assert!(before.is_valid(), "{round}: {before:?}");
        let options = ChangeOptions { tolerance, ..Default::default() };
        let changed = face.changed(&transform, composed(&surface, &transform), &options).unwrap();
        // Disjoint curves stay disjoint (2), loops closed (3), inner loops inside (4), outer ones counter-clockwise (5).
        let after = changed.face.report(tolerance).unwrap();
        let kept = |finding: &&Finding| !matches!(finding, Finding::EdgeGap { .. });
        let wrong: Vec<_> = after.findings.iter().filter(kept).collect();
        assert!(wrong.is_empty(), "{round} {transform:?}: {wrong:?}");
        let turned = !transform.keeps_direction();
        assert_eq!(changed.face.is_flipped(), face.is_flipped() != turned);
        for (old, new) in face.loops().iter().zip(changed.face.loops()) {
            assert_eq!((old.kind, old.coedges.len()), (new.kind, new.coedges.len()));
            for (k, was) in old.coedges.iter().enumerate() {
                let last = old.coedges.len() - 1;
                let is = &new.coedges[if turned { last - k } else { k }];
                assert_eq!(was.edge, is.edge);
                assert_eq!(was.reversed != turned && was.edge.is_some(), is.reversed);
                // Isolines stay isolines (1); kinds change only under maps that are not linear (6).
                let same =
                    std::mem::discriminant(&was.pcurve) == std::mem::discriminant(&is.pcurve);
                let kept = matches!(was.pcurve, Pcurve::Isoline(_) | Pcurve::Polyline(_));
                assert_eq!(same, kept || transform.is_linear(), "{round} {transform:?}");
                let ends = [was.start(), was.end()].map(|p| transform.apply(p));
                let found = if turned { [is.end(), is.start()] } else { [is.start(), is.end()] };
                for (p, q) in ends.iter().zip(&found) {
                    assert!((p[0] - q[0]).hypot(p[1] - q[1]) < 1e-13, "{round}");
                }
            }
        }
    }
}

fn square(from: f64, to: f64, outer: bool) -> Loop {
    let corners = [[from, from], [to, from], [to, to], [from, to], [from, from]];
    let pcurve = Pcurve::polyline(&corners).unwrap();
    if outer {
        Loop::outer(vec![Coedge::alone(pcurve)])
    } else {
        Loop::inner(vec![Coedge::alone(pcurve.reversed())])
    }
}

fn plane() -> Support {
    let kind = Elementary::Plane { axes: Axes::STANDARD };
    ElementarySurface::new(kind, [0.0, 10.0, 0.0, 10.0]).unwrap().into()
}

fn findings(loops: Vec<Loop>) -> Vec<Finding> {
    let face = TrimmedSurface::new(plane(), Vec::new(), loops, false).unwrap();
    face.report(1e-6).unwrap().findings
}

#[test]
fn a_report_finds_each_defect_and_nothing_else() {
    let outer = || square(1.0, 9.0, true);
    assert_eq!(findings(vec![outer(), square(2.0, 4.0, false), square(5.0, 7.0, false)]), []);
    let turned = Loop { kind: LoopKind::Outer, ..square(1.0, 9.0, false) };
    assert!(
        matches!(findings(vec![turned])[..], [Finding::Direction { chain: 0, area }] if area == -64.0)
    );
    let outside = findings(vec![outer(), square(9.5, 9.8, false)]);
    assert_eq!(outside, [Finding::Containment { chain: 1, depth: 0 }]);
    let nested = findings(vec![outer(), square(2.0, 8.0, false), square(3.0, 7.0, false)]);
    assert_eq!(nested, [Finding::Containment { chain: 2, depth: 0 }]);
    let island = [outer(), square(2.0, 8.0, false), square(3.0, 7.0, true)];
    assert_eq!(findings(island.into()), []);
    let twice = findings(vec![outer(), square(3.0, 7.0, true)]);
    assert_eq!(twice, [Finding::Containment { chain: 1, depth: 1 }]);
    let crossing = findings(vec![outer(), square(2.0, 5.0, false), square(4.0, 7.0, false)]);
    let count = crossing.iter().filter(|f| matches!(f, Finding::Crossing { .. })).count();
    assert_eq!(count, 2, "{crossing:?}");
    let touching = findings(vec![outer(), square(2.0, 5.0, false), square(5.0, 7.0, false)]);
    assert!(matches!(touching[..], [Finding::Touching { distance, .. }] if distance < 1e-12));
    let apart = findings(vec![outer(), square(2.0, 5.0, false), square(5.00001, 7.0, false)]);
    assert_eq!(apart, []);
    let outside = findings(vec![square(-0.5, 9.0, true)]);
    assert!(matches!(outside[..], [Finding::Outside { by: [0.5, _], .. }]), "{outside:?}");
    let open = Loop::outer(vec![Coedge::alone(
        Pcurve::polyline(&[[1.0, 1.0], [9.0, 1.0], [9.0, 9.0], [1.0, 1.1]]).unwrap(),
    )]);
    let open = findings(vec![open]);
    assert!(
        matches!(open[..], [Finding::Open { gap, .. }] if (gap - 0.1).abs() < 1e-12),
        "{open:?}"
    );
    let eight = Loop::outer(vec![Coedge::alone(
        Pcurve::polyline(&[[1.0, 1.0], [9.0, 9.0], [9.0, 1.0], [1.0, 8.0], [1.0, 1.0]]).unwrap(),
    )]);
    let eight = findings(vec![eight]);
    assert!(eight.iter().any(|f| matches!(f, Finding::Crossing { .. })), "{eight:?}");
}

#[test]
fn a_report_measures_edges_and_senses() {
    let side = |from: [f64; 3], to: [f64; 3]| {
        let knots = [0.0, 0.0, 1.0, 1.0];
        Edge::along(footpoint::curve::Curve::new(&knots, 1, &[from, to], None).unwrap())
    };
    let iso = |fixed, at, from, to| Pcurve::isoline(fixed, at, from, to).unwrap();
    let (u, v) = (Direction::U, Direction::V);
    let make = |lift: f64, reversed: bool| {
        let edges =
            vec![side([1.0, 1.0, 0.0], [9.0, 1.0, lift]), side([9.0, 1.0, 0.0], [9.0, 9.0, 0.0])];
        let coedges = vec![
            Coedge::along(iso(v, 1.0, 1.0, 9.0), 0),
            Coedge { reversed, ..Coedge::along(iso(u, 9.0, 1.0, 9.0), 1) },
            Coedge::alone(iso(v, 9.0, 9.0, 1.0)),
            Coedge::alone(iso(u, 1.0, 9.0, 1.0)),
        ];
        let face = TrimmedSurface::new(plane(), edges, vec![Loop::outer(coedges)], false);
        face.unwrap().report(1e-6).unwrap()
    };
    let good = make(0.0, false);
    assert!(good.is_valid() && good.proven, "{good:?}");
    let lifted = make(0.3, false);
    assert_eq!(lifted.largest_gap, 0.3);
    assert!(
        matches!(lifted.findings[..], [Finding::EdgeGap { gap: 0.3, place }] if place.coedge == 0)
    );
    let against = make(0.0, true);
    assert!(matches!(against.findings[..], [Finding::EdgeGap { gap: 8.0, .. }]), "{against:?}");
}

#[test]
fn a_surface_that_is_another_one_is_refused_with_the_place() {
    let mut random = Random(3);
    let (surface, face) = face(0, &mut random);
    let Elementary::Sphere { axes, radius } = *surface.kind() else { unreachable!() };
    let other = Elementary::Sphere { axes, radius: 1.001 * radius };
    let other = ElementarySurface::new(other, surface.domain()).unwrap();
    let transform = Transform::identity(surface.domain()).unwrap();
    let text = |transform: &Transform, surface: &ElementarySurface| {
        let changed = face.changed(transform, surface.clone().into(), &ChangeOptions::default());
        changed.unwrap_err().to_string()
    };
    assert!(text(&transform, &other).starts_with("support: differs from the surface by"));
    let half = Transform::identity([0.0, 1.0, -FRAC_PI_2, FRAC_PI_2]).unwrap();
    assert!(text(&half, &surface).starts_with("transform: entry 1 of its domain is 1"));
    assert_eq!(between(1.0, 2.0, 1.0), 2.0);
}
