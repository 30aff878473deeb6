//! Faces followed onto parametrisations whose seams and poles are elsewhere: loops are cut there and joined anew.

mod faces;

use std::f64::consts::{FRAC_PI_2, TAU};

use faces::{KINDS, Random, face};
use footpoint::bounds::{Vector, cross};
use footpoint::closest::{QueryOptions, Workspace};
use footpoint::elementary::{Axes, CircleForm, Elementary, ElementarySurface};
use footpoint::face::{Face, FaceWorkspace, Standing};
use footpoint::pcurve::Pcurve;
use footpoint::trim::{ChangeOptions, Changed, Coedge, Loop, LoopKind, Support, TrimmedSurface};

/// Axes turned about their own z, and then tilted about x.
fn turned(axes: &Axes, about_z: f64, about_x: f64) -> Axes {
    let mix = |a: Vector, b: Vector, angle: f64| -> [Vector; 2] {
        let (s, c) = angle.sin_cos();
        let sum = |p: f64, q: f64| std::array::from_fn(|k| p * a[k] + q * b[k]);
        [sum(c, s), sum(-s, c)]
    };
    let [x, y] = mix(axes.x, axes.y, about_z);
    let [y, z] = mix(y, axes.z, about_x);
    Axes::around(axes.origin, z, x)
        .map(|made| Axes { y: cross(made.z, made.x), ..made })
        .unwrap_or(Axes { x, y, z, ..*axes })
}

/// The same side everywhere, the same normal, a valid report.
fn agree(about: &str, old: &TrimmedSurface, changed: &Changed, size: f64, random: &mut Random) {
    let new = &changed.face;
    let report = new.report(4e-4 * size).unwrap();
    let wrong: Vec<_> = report.findings.iter().collect();
    assert!(wrong.is_empty(), "{about}: {wrong:?}");
    let [a, b] = [old, new].map(|trim| Face::new(trim, 0, &mut |_| false).unwrap());
    let options = QueryOptions { tolerance: 3e-3 * size, ..QueryOptions::default() };
    let (mut workspace, mut search) = (FaceWorkspace::default(), Workspace::default());
    let [u0, u1, v0, v1] = old.support().domain();
    let mut sides = [0, 0];
    for _ in 0..300 {
        let at = [random.between(u0, u1), random.between(v0, v1)];
        let point = old.support().evaluate(at);
        let foot = new.support().invert(point, &QueryOptions::default(), &mut search);
        assert!(foot.distance < 1e-9 * size);
        let was = a.classify(at, &options, &mut workspace).standing;
        let is = b.classify([foot.u, foot.v], &options, &mut workspace).standing;
        // Seams are edges of one and not of the other.
        let side = |standing| match standing {
            Standing::Inside => Some(0),
            Standing::Outside => Some(1),
            _ => None,
        };
        if let (Some(was), Some(is)) = (side(was), side(is)) {
            assert_eq!(was, is, "{about}: {at:?} {foot:?}");
            sides[was] += 1;
        }
    }
    assert!(sides[0] > 20, "{about}: {sides:?}");
}

#[test]
fn random_spheres_keep_their_sides_under_any_other_axes() {
    let mut random = Random(51);
    for round in 0..4 * KINDS.len() {
        let kind = round % KINDS.len();
        let (surface, face) = face(kind, &mut random);
        let Elementary::Sphere { axes, radius } = *surface.kind() else { unreachable!() };
        // About the axis alone, tilted, and mirrored.
        let tilt = if round < KINDS.len() { 0.0 } else { random.between(0.2, 2.8) };
        let mut other = turned(&axes, random.between(0.3, 6.0), tilt);
        if round >= 3 * KINDS.len() {
            other.x = other.x.map(|x| -x);
        }
        let domain = [0.0, TAU, -FRAC_PI_2, FRAC_PI_2];
        let new = ElementarySurface::new(Elementary::Sphere { axes: other, radius }, domain);
        let new = new.unwrap();
        let options = ChangeOptions { tolerance: 1e-4 * radius, ..Default::default() };
        let about = format!("{} {round} {:?}", KINDS[kind], other);
        let changed = face.followed(new.clone().into(), &options);
        let changed = changed.unwrap_or_else(|error| panic!("{about}: {error}"));
        assert!(changed.proven && changed.deviation <= options.tolerance, "{about}: {changed:?}");
        assert_eq!(changed.face.is_flipped(), face.is_flipped() != (round >= 3 * KINDS.len()));
        agree(&about, &face, &changed, radius, &mut random);
        // Onto the NURBS form as well.
        if round % 3 == 0 {
            let form = new.nurbs([CircleForm::Halves, CircleForm::Arcs(2)]).unwrap();
            let changed = face.followed(form.into(), &options).unwrap();
            agree(&about, &face, &changed, radius, &mut random);
        }
    }
}

fn whole_with_hole(kind: Elementary, domain: [f64; 4], center: [f64; 2]) -> TrimmedSurface {
    let support: Support = ElementarySurface::new(kind, domain).unwrap().into();
    let whole = TrimmedSurface::whole(support.clone()).unwrap();
    let hole = Pcurve::arc(center, [0.7, 0.0], [0.0, -0.5], [0.0, TAU]).unwrap();
    let mut loops = whole.loops().to_vec();
    loops.push(Loop::inner(vec![Coedge::alone(hole)]));
    TrimmedSurface::new(support, whole.edges().to_vec(), loops, false).unwrap()
}

#[test]
fn tori_and_cylinders_are_cut_at_new_seams() {
    let mut random = Random(52);
    let axes = Axes::around(random.vector(), random.vector(), random.vector()).unwrap();
    let (major, minor) = (3.0, 1.0);
    let torus =
        whole_with_hole(Elementary::Torus { axes, major, minor }, [0.0, TAU, 0.0, TAU], [2.0, 3.0]);
    // The tube's seam and that of the axis move so that the hole lies over one of them, over both, over none.
    for (about_z, from) in [(2.0, 0.5), (2.0, 3.0), (0.7, 3.1), (0.7, 0.5)] {
        let kind = Elementary::Torus { axes: turned(&axes, about_z, 0.0), major, minor };
        let domain = [0.0, TAU, from, from + TAU];
        let new: Support = ElementarySurface::new(kind, domain).unwrap().into();
        let options = ChangeOptions { tolerance: 1e-4, ..Default::default() };
        let changed = torus.followed(new, &options).unwrap();
        assert!(changed.proven, "{about_z} {from}");
        agree(&format!("torus {about_z} {from}"), &torus, &changed, 4.0, &mut random);
        // A seam edge is used from both sides.
        for edge in 0..changed.face.edges().len() {
            let uses = changed.face.coedges().filter(|(_, _, c)| c.edge == Some(edge)).count();
            assert_eq!(uses, 2, "{about_z} {from}: edge {edge}");
        }
    }
    let radius = 1.5;
    let cylinder =
        whole_with_hole(Elementary::Cylinder { axes, radius }, [0.0, TAU, -1.0, 2.0], [2.0, 0.5]);
    for about_z in [2.2, 0.7] {
        let kind = Elementary::Cylinder { axes: turned(&axes, about_z, 0.0), radius };
        let new: Support = ElementarySurface::new(kind, [0.0, TAU, -1.0, 2.0]).unwrap().into();
        let options = ChangeOptions { tolerance: 1e-4, ..Default::default() };
        let changed = cylinder.followed(new, &options).unwrap();
        agree(&format!("cylinder {about_z}"), &cylinder, &changed, 3.0, &mut random);
        let outer = changed.face.loops().iter().filter(|c| c.kind == LoopKind::Outer).count();
        assert_eq!(outer, 1, "{about_z}");
    }
}

#[test]
fn the_edge_of_a_coedge_that_is_cut_is_cut_with_it() {
    // A polyline over the new seam, with its edge.
    let axes = Axes::STANDARD;
    let make = |axes: Axes| -> Support {
        let kind = Elementary::Cylinder { axes, radius: 1.0 };
        ElementarySurface::new(kind, [0.0, TAU, 0.0, 2.0]).unwrap().into()
    };
    let iso = |fixed, at, from, to| Pcurve::isoline(fixed, at, from, to).unwrap();
    use footpoint::pcurve::Direction::{U, V};
    let side = |pcurve: &Pcurve| {
        let Support::Elementary(support) = make(axes) else { unreachable!() };
        let lifted = footpoint::pcurve::lift::lift(
            support.chart().unwrap().surface,
            pcurve,
            &Default::default(),
        );
        footpoint::trim::Edge::along(lifted.unwrap().curve)
    };
    let curves = [
        iso(V, 0.5, 1.0, 4.0),
        iso(U, 4.0, 0.5, 1.5),
        iso(V, 1.5, 4.0, 1.0),
        iso(U, 1.0, 1.5, 0.5),
    ];
    let edges: Vec<_> = curves.iter().map(side).collect();
    let coedges = curves.iter().enumerate().map(|(k, p)| Coedge::along(p.clone(), k)).collect();
    let face = TrimmedSurface::new(make(axes), edges, vec![Loop::outer(coedges)], false).unwrap();
    assert!(face.report(1e-6).unwrap().is_valid());
    let new = make(turned(&axes, 2.0, 0.0));
    let options = ChangeOptions { tolerance: 1e-6, ..Default::default() };
    let changed = face.followed(new, &options).unwrap();
    let report = changed.face.report(1e-5).unwrap();
    assert!(report.is_valid(), "{report:?}");
    assert!(report.gap_bound <= 1e-5, "{report:?}");
    // Two curves cut in two, two whole ones, a seam edge between the cuts.
    assert_eq!(changed.face.edges().len(), 7);
    assert_eq!(changed.face.loops().len(), 2);
    let without = changed.face.coedges().filter(|(_, _, c)| c.edge.is_none()).count();
    assert_eq!(without, 0);
}
