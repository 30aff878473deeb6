//! Faces in all forms: other elementary surfaces, raised and refined splines, merged, followed, as text and as pictures.

mod faces;

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use faces::{FORMS, KINDS, Random, face, sphere};
use footpoint::bounds::{norm, sub};
use footpoint::curve::Curve;
use footpoint::elementary::{Axes, CircleForm, Elementary, ElementarySurface};
use footpoint::operate::Direction;
use footpoint::pcurve::Pcurve;
use footpoint::surface::Surface;
use footpoint::transform::{Relation, Transform};
use footpoint::trim::{
    ChangeOptions, Coedge, Loop, LoopKind, Replacement, Support, TrimmedSurface, picture,
};

fn made(kind: Elementary, domain: [f64; 4]) -> ElementarySurface {
    ElementarySurface::new(kind, domain).unwrap()
}

fn meridian() -> Curve {
    let poles = [[1.5, 0.1, 0.0], [2.0, 0.1, 1.0], [1.0, 0.1, 2.0], [1.7, 0.1, 3.0]];
    let knots = [0.0, 0.0, 0.0, 0.4, 1.0, 1.0, 1.0];
    Curve::new(&knots, 2, &poles, Some(&[1.0, 2.0, 0.5, 1.0])).unwrap()
}

fn elementary(random: &mut Random) -> Vec<ElementarySurface> {
    let axes = Axes::around(random.vector(), random.vector(), random.vector()).unwrap();
    vec![
        made(Elementary::Plane { axes }, [-1.0, 2.0, 0.5, 3.0]),
        made(Elementary::Cylinder { axes, radius: 0.7 }, [0.0, TAU, -1.0, 2.0]),
        made(Elementary::Cone { axes, radius: 0.0, half_angle: -0.3 }, [0.0, TAU, -4.0, 0.0]),
        made(Elementary::Sphere { axes, radius: 2.0 }, [0.0, TAU, -FRAC_PI_2, FRAC_PI_2]),
        made(Elementary::Torus { axes, major: 2.0, minor: 0.5 }, [0.0, TAU, 0.0, TAU]),
        made(
            Elementary::Revolution {
                origin: [0.0; 3],
                axis: [0.0, 0.0, 1.0],
                meridian: meridian(),
            },
            [0.0, TAU, 0.2, 0.9],
        ),
        made(
            Elementary::Extrusion { curve: meridian(), direction: [0.3, 1.0, 0.0] },
            [0.1, 1.0, -1.0, 2.0],
        ),
    ]
}

/// The whole surface with a round hole in the middle.
fn holed(support: Support) -> TrimmedSurface {
    let whole = TrimmedSurface::whole(support.clone()).unwrap();
    let [u0, u1, v0, v1] = support.domain();
    let (center, size) = ([0.5 * (u0 + u1), 0.5 * (v0 + v1)], [0.2 * (u1 - u0), 0.3 * (v1 - v0)]);
    let hole = Pcurve::arc(center, [size[0], 0.0], [0.0, -size[1]], [0.0, TAU]).unwrap();
    let mut loops = whole.loops().to_vec();
    loops.push(Loop::inner(vec![Coedge::alone(hole)]));
    TrimmedSurface::new(support, whole.edges().to_vec(), loops, false).unwrap()
}

#[test]
fn every_elementary_face_goes_to_nurbs_forms_and_back() {
    let mut random = Random(31);
    let options = ChangeOptions { replacement: Replacement::Vertices, ..Default::default() };
    for surface in elementary(&mut random) {
        let forms = [
            surface.usual_forms(),
            [CircleForm::Arcs(5), CircleForm::Arcs(7)],
            [CircleForm::Halves; 2],
        ];
        for forms in forms {
            if forms[0] == CircleForm::Halves && surface.angular()[0] && !surface.full_turns()[0] {
                continue;
            }
            let face = holed(surface.clone().into());
            let report = face.report(0.0).unwrap();
            assert!(report.is_valid(), "{:?}: {report:?}", surface.kind());
            let there = face.to_nurbs(forms, &options).unwrap();
            let report = there.face.report(0.0).unwrap();
            assert!(report.is_valid(), "{:?}: {report:?}", surface.kind());
            let back = there.face.to_elementary(surface.clone(), forms, &options).unwrap();
            for ((_, _, old), (_, _, new)) in face.coedges().zip(back.face.coedges()) {
                assert_eq!((old.edge, old.reversed), (new.edge, new.reversed));
                let [u0, u1, v0, v1] = surface.domain();
                for (p, q) in [(old.start(), new.start()), (old.end(), new.end())] {
                    assert!((p[0] - q[0]).abs() <= 1e-14 * (u1 - u0), "{p:?} {q:?}");
                    assert!((p[1] - q[1]).abs() <= 1e-14 * (v1 - v0), "{p:?} {q:?}");
                }
            }
        }
    }
}

#[test]
fn raised_and_refined_surfaces_keep_the_domain_bit_for_bit() {
    let mut random = Random(32);
    let options = ChangeOptions::default();
    for kind in 0..KINDS.len() {
        let (surface, face) = face(kind, &mut random);
        let forms = FORMS[kind % FORMS.len()];
        let vertices = ChangeOptions { replacement: Replacement::Vertices, ..options };
        let spline = face.to_nurbs(forms, &vertices).unwrap().face;
        let Support::Spline(support) = spline.support() else { unreachable!() };
        let finer = support.surface().elevate(Direction::U, 1).unwrap();
        let finer = finer.elevate(Direction::V, 2).unwrap().insert_knot_u(0.37, 1).unwrap();
        let finer = spline.on_surface(finer, &options).unwrap();
        assert!(finer.proven && finer.deviation == 0.0);
        for ((_, _, old), (_, _, new)) in spline.coedges().zip(finer.face.coedges()) {
            assert_eq!(old.pcurve, new.pcurve);
        }
        let back = finer.face.to_elementary(surface, forms, &vertices).unwrap();
        assert_eq!(back.face.loops().len(), face.loops().len());
    }
}

#[test]
fn reversal_and_exchange_of_splines_are_exact_and_their_own_inverses() {
    let mut random = Random(33);
    let options = ChangeOptions { replacement: Replacement::Vertices, ..Default::default() };
    for kind in 0..KINDS.len() {
        let (_, face) = face(kind, &mut random);
        let forms = [CircleForm::Halves, CircleForm::Arcs(2)];
        let face = face.to_nurbs(forms, &options).unwrap().face;
        let domain = face.support().domain();
        let range = [domain[0], domain[1]];
        let turn = || Relation::reversal(range).unwrap();
        let stay = || Relation::identity(range).unwrap();
        let transforms = [
            Transform::new(turn(), stay()),
            Transform::new(stay(), turn()),
            Transform::new(turn(), turn()),
            Transform::exchange(domain).unwrap(),
        ];
        for transform in transforms {
            let once = face.reparametrised(&transform, &options).unwrap();
            assert!(once.proven && once.deviation == 0.0);
            assert_eq!(once.face.is_flipped() != face.is_flipped(), !transform.keeps_direction());
            // A point of the boundary keeps its normal in space.
            let twice = once.face.reparametrised(&transform.inverse(), &options).unwrap().face;
            assert_eq!(twice.is_flipped(), face.is_flipped());
            for ((_, _, old), (_, _, new)) in face.coedges().zip(twice.coedges()) {
                assert_eq!((old.edge, old.reversed), (new.edge, new.reversed));
                let (p, q) = (old.start(), new.start());
                assert!((p[0] - q[0]).abs() <= 4e-16 && (p[1] - q[1]).abs() <= 4e-16);
            }
        }
    }
}

#[test]
fn two_halves_of_a_face_are_merged_to_the_whole() {
    let mut random = Random(34);
    let Elementary::Sphere { axes, radius } = *sphere(&mut random).kind() else { unreachable!() };
    let part = |u0: f64, u1: f64| -> Support {
        made(Elementary::Sphere { axes, radius }, [u0, u1, -1.0, 1.0]).into()
    };
    let (left, right) = (part(0.0, 2.0), part(2.0, 5.0));
    let first = TrimmedSurface::whole(left.clone()).unwrap();
    let second = TrimmedSurface::whole(right.clone()).unwrap();
    let options = ChangeOptions::default();
    let whole = first.merged(&second, Direction::U, part(0.0, 5.0), &options).unwrap();
    assert_eq!((whole.loops().len(), whole.loops()[0].coedges.len()), (1, 6));
    assert_eq!(whole.edges().len(), 6);
    // A shorter face: what is left of the border keeps its part of the edge.
    let shorter = {
        let iso =
            |fixed, at, from, to| Coedge::alone(Pcurve::isoline(fixed, at, from, to).unwrap());
        let (u, v) = (Direction::U, Direction::V);
        let coedges = vec![
            iso(v, -0.6, 2.0, 5.0),
            iso(u, 5.0, -0.6, 0.3),
            iso(v, 0.3, 5.0, 2.0),
            iso(u, 2.0, 0.3, -0.6),
        ];
        TrimmedSurface::new(right.clone(), Vec::new(), vec![Loop::outer(coedges)], false).unwrap()
    };
    let stepped = first.merged(&shorter, Direction::U, part(0.0, 5.0), &options).unwrap();
    let kept: Vec<_> = stepped
        .coedges()
        .filter(|(_, _, c)| matches!(&c.pcurve, Pcurve::Isoline(l) if l.fixed == Direction::U && l.at == 2.0))
        .collect();
    assert_eq!(kept.len(), 2);
    for (_, _, coedge) in kept {
        assert!(coedge.edge.is_some());
        for share in [0.0, 0.4, 1.0] {
            let there = stepped.edge_point(coedge, share).unwrap();
            let off = norm(sub(stepped.coedge_point(coedge, share), there));
            // The edge has the parameters of the NURBS form between its ends.
            assert!(
                off < if share == 0.4 { 0.1 * radius } else { 1e-9 * radius },
                "{share} {off:e}"
            );
        }
    }
    let report = stepped.report(0.0).unwrap();
    assert!(report.is_valid() && report.gap_bound < 1e-6 * radius, "{report:?}");
    let report = whole.report(0.0).unwrap();
    assert!(report.is_valid() && (report.areas[0] - 10.0).abs() < 1e-9, "{report:?}");
    // Two faces with a notch each on the border make a hole; a shorter border leaves pieces of it.
    let notched = |support: Support, at_end: bool| {
        let iso =
            |fixed, at, from, to| Coedge::alone(Pcurve::isoline(fixed, at, from, to).unwrap());
        let [u0, u1, ..] = support.domain();
        let (u, v) = (Direction::U, Direction::V);
        let coedges = if at_end {
            vec![
                iso(v, -1.0, u0, u1),
                iso(u, u1, -1.0, -0.5),
                iso(v, -0.5, u1, u1 - 0.5),
                iso(u, u1 - 0.5, -0.5, 0.5),
                iso(v, 0.5, u1 - 0.5, u1),
                iso(u, u1, 0.5, 1.0),
                iso(v, 1.0, u1, u0),
                iso(u, u0, 1.0, -1.0),
            ]
        } else {
            vec![
                iso(v, -1.0, u0, u1),
                iso(u, u1, -1.0, 1.0),
                iso(v, 1.0, u1, u0),
                iso(u, u0, 1.0, 0.4),
                iso(v, 0.4, u0, u0 + 0.5),
                iso(u, u0 + 0.5, 0.4, -0.4),
                iso(v, -0.4, u0 + 0.5, u0),
                iso(u, u0, -0.4, -1.0),
            ]
        };
        TrimmedSurface::new(support, Vec::new(), vec![Loop::outer(coedges)], false).unwrap()
    };
    let (first, second) = (notched(left, true), notched(right.clone(), false));
    let whole = first.merged(&second, Direction::U, part(0.0, 5.0), &options).unwrap();
    let kinds: Vec<LoopKind> = whole.loops().iter().map(|chain| chain.kind).collect();
    assert_eq!(kinds, [LoopKind::Outer, LoopKind::Inner]);
    let report = whole.report(0.0).unwrap();
    assert!(report.is_valid(), "{report:?}");
    assert!((report.areas[0] - 10.0).abs() < 1e-9 && (report.areas[1] + 0.9).abs() < 1e-9);
    let text = second.merged(&first, Direction::U, part(0.0, 5.0), &options).unwrap_err();
    assert!(text.to_string().starts_with("other: its domain begins at 0"), "{text}");
}

/// A face on a sphere seen in the parameters of a spline form whose axis is tilted: not separable.
#[test]
fn a_face_is_followed_onto_other_axes() {
    let mut random = Random(35);
    let Elementary::Sphere { axes, .. } = *sphere(&mut random).kind() else { unreachable!() };
    let domain = [0.0, TAU, -FRAC_PI_2, FRAC_PI_2];
    let surface = made(Elementary::Sphere { axes, radius: 2.0 }, domain);
    let circle = Pcurve::arc([2.0, 0.3], [0.5, 0.0], [0.0, 0.4], [0.0, TAU]).unwrap();
    let ring = Pcurve::arc([2.0, 0.3], [0.2, 0.0], [0.0, -0.1], [0.0, TAU]).unwrap();
    let loops =
        vec![Loop::outer(vec![Coedge::alone(circle)]), Loop::inner(vec![Coedge::alone(ring)])];
    let face = TrimmedSurface::new(surface.clone().into(), Vec::new(), loops, false).unwrap();
    // Turned about x: the old pole lies on the new equator; the seam is elsewhere.
    let tilted = Axes { x: axes.x, y: axes.z, z: axes.y.map(|x| -x), ..axes };
    let other = made(Elementary::Sphere { axes: tilted, radius: 2.0 }, domain);
    let options = ChangeOptions { tolerance: 1e-4, ..Default::default() };
    let changed = face.followed(other.clone().into(), &options).unwrap();
    assert!(changed.face.report(4e-4).unwrap().is_valid());
    for ((_, _, old), (_, _, new)) in face.coedges().zip(changed.face.coedges()) {
        for k in 0..=200 {
            let share = f64::from(k) / 200.0;
            let off = sub(face.coedge_point(old, share), changed.face.coedge_point(new, share));
            assert!(norm(off) < 1e-4);
        }
    }
    // A mirrored surface turns the loops and keeps the normal of the face.
    let mirrored = Axes { z: axes.z.map(|x| -x), ..axes };
    let mirrored = made(Elementary::Sphere { axes: mirrored, radius: 2.0 }, domain);
    let turned = face.followed(mirrored.into(), &options).unwrap().face;
    assert!(turned.is_flipped() && turned.report(4e-4).unwrap().is_valid());
    // A loop around the new seam is two there, with a seam edge between them.
    let crossing = Axes { x: axes.x.map(|x| -x), y: axes.y.map(|x| -x), ..axes };
    let away = made(Elementary::Sphere { axes: crossing, radius: 2.0 }, domain);
    let arc = Pcurve::arc([PI, 0.3], [0.5, 0.0], [0.0, 0.4], [0.0, TAU]).unwrap();
    let loops = vec![Loop::outer(vec![Coedge::alone(arc)])];
    let across = TrimmedSurface::new(surface.into(), Vec::new(), loops, false).unwrap();
    let cut = across.followed(away.into(), &options).unwrap();
    assert!(cut.proven && cut.face.loops().len() == 2 && cut.face.edges().len() == 1);
    assert!(cut.face.report(4e-4).unwrap().is_valid());
}

#[test]
fn faces_with_seams_and_poles_are_followed_as_closed_loops() {
    let mut random = Random(36);
    for kind in 0..KINDS.len() {
        let (surface, face) = face(kind, &mut random);
        let Elementary::Sphere { radius, .. } = *surface.kind() else { unreachable!() };
        let form = surface.nurbs([CircleForm::Halves, CircleForm::Arcs(2)]).unwrap();
        let options = ChangeOptions { tolerance: 1e-3 * radius, ..Default::default() };
        let changed = face.followed(form.into(), &options).unwrap();
        let report = changed.face.report(4e-3 * radius).unwrap();
        assert!(report.is_valid(), "{}: {report:?}", KINDS[kind]);
        for (old, new) in face.loops().iter().zip(changed.face.loops()) {
            assert_eq!((old.kind, old.coedges.len()), (new.kind, new.coedges.len()));
        }
    }
}

/// The same bits of every number, told by the text of a second writing.
#[test]
fn text_comes_back_with_the_same_bits() {
    let mut random = Random(37);
    let mut all: Vec<TrimmedSurface> =
        (0..20).map(|round| face(round % KINDS.len(), &mut random).1).collect();
    all.extend(elementary(&mut random).into_iter().map(|surface| holed(surface.into())));
    let vertices = ChangeOptions { replacement: Replacement::Vertices, ..Default::default() };
    let splines: Vec<TrimmedSurface> = all
        .iter()
        .filter_map(|face| {
            let Support::Elementary(support) = face.support() else { return None };
            face.to_nurbs(support.surface().usual_forms(), &vertices).ok()
        })
        .map(|changed| changed.face)
        .collect();
    assert!(splines.len() > 20);
    all.extend(splines);
    for face in all {
        let text = face.to_json().unwrap();
        let back = TrimmedSurface::from_json(&text).unwrap();
        assert_eq!(back.to_json().unwrap(), text);
        assert_eq!(back.support().domain(), face.support().domain());
        for ((_, _, a), (_, _, b)) in face.coedges().zip(back.coedges()) {
            assert_eq!(a.pcurve, b.pcurve);
            assert_eq!(
                (a.edge, a.reversed, a.same_parameter),
                (b.edge, b.reversed, b.same_parameter)
            );
            for share in [0.0, 0.3, 1.0] {
                assert_eq!(face.coedge_point(a, share), back.coedge_point(b, share));
                assert_eq!(face.edge_point(a, share), back.edge_point(b, share));
            }
        }
    }
}

#[test]
fn text_that_is_no_face_is_refused_with_its_place() {
    let face = holed(elementary(&mut Random(38)).swap_remove(3).into());
    let text = face.to_json().unwrap();
    let refused = |from: &str, to: &str| {
        assert!(text.contains(from), "{from} is not in {text}");
        TrimmedSurface::from_json(&text.replacen(from, to, 1)).unwrap_err().to_string()
    };
    assert!(TrimmedSurface::from_json("{").unwrap_err().to_string().starts_with("json: EOF"));
    assert_eq!(refused("\"flipped\"", "\"flip\""), "json.flipped: is missing");
    assert_eq!(
        refused("\"radius\":2.0", "\"radius\":-2.0"),
        "json.support: radius: -2 is not positive"
    );
    assert_eq!(
        refused("\"radius\":2.0", "\"radius\":\"2\""),
        "json.support.radius: is not a number"
    );
    assert_eq!(
        refused("\"isoline\"", "\"iso\""),
        "json.loops[0].coedges[0].pcurve.kind: \"iso\" is no kind of pcurve"
    );
    assert_eq!(refused("\"version\":1", "\"version\":2"), "json.version: is not 1");
    let deep = "[".repeat(100_000);
    assert!(TrimmedSurface::from_json(&deep).is_err());
    for cut in (0..text.len()).step_by(41) {
        assert!(TrimmedSurface::from_json(&text[..cut]).is_err());
    }
}

/// With `FOOTPOINT_PICTURES=folder` the picture is written there, to be looked at.
#[test]
fn a_picture_shows_each_face_with_finite_numbers() {
    let mut random = Random(41);
    let vertices = ChangeOptions { tolerance: 1e-3, replacement: Replacement::Polyline };
    let mut faces = Vec::new();
    for kind in [1, 2, 3] {
        let (_, face) = face(kind, &mut random);
        let form = face.to_nurbs([CircleForm::Halves, CircleForm::Arcs(2)], &vertices).unwrap();
        faces.extend([
            (format!("{}: by angles", KINDS[kind]), face),
            ("as NURBS".into(), form.face),
        ]);
    }
    let list: Vec<(&str, &TrimmedSurface)> =
        faces.iter().map(|(title, face)| (title.as_str(), face)).collect();
    let svg = picture(&list, [0.0; 3]).unwrap();
    assert!(svg.starts_with("<svg") && svg.trim_end().ends_with("</svg>"));
    assert!(!svg.contains("NaN") && !svg.contains("inf") && svg.matches("<path").count() > 50);
    assert!(picture(&[], [0.0; 3]).is_err() && picture(&list, [f64::NAN; 3]).is_err());
    if let Ok(folder) = std::env::var("FOOTPOINT_PICTURES") {
        std::fs::write(std::path::Path::new(&folder).join("trims.svg"), svg).unwrap();
    }
}

/// The fewest vertices: each chord as long as samples allow.
fn fewest(
    curve: &Pcurve,
    from: &Support,
    to: &Support,
    change: &Transform,
    tolerance: f64,
) -> usize {
    let (a, b) = curve.domain();
    let place = |t: f64| change.apply(curve.evaluate(t));
    let fits = |s: f64, t: f64| {
        let (p, q) = (place(s), place(t));
        (1..20).all(|k| {
            let share = f64::from(k) / 20.0;
            let on = [0, 1].map(|d| p[d] + share * (q[d] - p[d]));
            let there = from.evaluate(curve.evaluate(s + share * (t - s)));
            norm(sub(to.evaluate(on), there)) <= tolerance
        })
    };
    let (mut t, mut count) = (a, 1);
    while t < b {
        let (mut low, mut high) = (t, b);
        if !fits(t, b) {
            while high - low > 1e-7 * (b - a) {
                let middle = 0.5 * (low + high);
                if fits(t, middle) { low = middle } else { high = middle }
            }
            high = low;
        }
        (t, count) = (high, count + 1);
    }
    count
}

#[test]
fn polylines_on_uneven_splines_take_few_vertices_and_fitted_splines_few_poles() {
    // A bicubic a hundred times faster at one end than at the other: bounds over all of it say little.
    let knots = [0.0, 0.0, 0.0, 0.0, 0.5, 1.0, 1.0, 1.0, 1.0];
    let along = [0.0, 0.01, 0.05, 2.0, 6.0];
    let poles: Vec<[f64; 3]> =
        (0..25).map(|k| [along[k / 5], along[k % 5], 0.2 * f64::from((k * 7 % 5) as u8)]).collect();
    let surface = Surface::new(&knots, &knots, 3, 3, &poles, 5, 5, None).unwrap();
    let from = Support::from(surface);
    let bend = Relation::circle(CircleForm::Arcs(2), PI, [0.0, 1.0], [0.0, 1.0]).unwrap();
    let change = Transform::new(bend.clone(), bend);
    let arc = Pcurve::arc([0.25, 0.25], [0.2, 0.0], [0.0, 0.15], [0.0, TAU]).unwrap();
    let loops = vec![Loop::outer(vec![Coedge::alone(arc.clone())])];
    let face = TrimmedSurface::new(from.clone(), Vec::new(), loops, false).unwrap();
    let tolerance = 1e-4;
    let options = ChangeOptions { tolerance, ..Default::default() };
    let changed = face.reparametrised(&change, &options).unwrap();
    let count = |face: &TrimmedSurface| match &face.loops()[0].coedges[0].pcurve {
        Pcurve::Polyline(line) => line.points().len(),
        Pcurve::Spline(curve) => curve.poles().len(),
        _ => 0,
    };
    let least = fewest(&arc, &from, changed.face.support(), &change, tolerance);
    assert!(count(&changed.face) <= 4 * least, "{} for {least}", count(&changed.face));
    // On elementary surfaces deviations are proven, whatever the way.
    let sphere: Support = elementary(&mut Random(39)).swap_remove(3).into();
    let Support::Elementary(support) = &sphere else { unreachable!() };
    let hole = Pcurve::arc([2.0, 0.3], [1.2, 0.0], [0.0, 0.9], [0.0, TAU]).unwrap();
    let loops = vec![Loop::outer(vec![Coedge::alone(hole.clone())])];
    let face = TrimmedSurface::new(sphere.clone(), Vec::new(), loops, false).unwrap();
    let forms = support.surface().usual_forms();
    let polyline = face.to_nurbs(forms, &options).unwrap();
    let to_form = footpoint::trim::form_transform(support.surface(), forms).unwrap();
    let least = fewest(&hole, &sphere, polyline.face.support(), &to_form, tolerance);
    assert!(polyline.proven && polyline.deviation <= tolerance);
    assert!(count(&polyline.face) <= 4 * least, "{} for {least}", count(&polyline.face));
    let options = ChangeOptions { replacement: Replacement::Spline, ..options };
    let spline = face.to_nurbs(forms, &options).unwrap();
    assert!(spline.proven && spline.deviation <= tolerance);
    println!(
        "vertices {} of at least {least}, poles {}",
        count(&polyline.face),
        count(&spline.face)
    );
    assert!(count(&spline.face) < count(&polyline.face) / 2);
}
