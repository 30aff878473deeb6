//! Faces over elementary surfaces and functions, asked in their own parameters.

mod faces;

use std::f64::consts::{FRAC_PI_2, TAU};
use std::sync::Arc;

use faces::{KINDS, Random, face};
use footpoint::bounds::{Vector, norm, sub};
use footpoint::callback::{CallbackSurface, SurfaceBounds};
use footpoint::closest::{FootPoint, QueryOptions, flag};
use footpoint::curve::Curve;
use footpoint::elementary::{Axes, Elementary, ElementarySurface};
use footpoint::face::{Face, FaceWorkspace, NOT_PROVEN, Place, Standing};
use footpoint::pcurve::Pcurve;
use footpoint::transform::between;
use footpoint::trim::{ChangeOptions, Coedge, Loop, Replacement, Support, TrimmedSurface};

fn prepared(trim: &TrimmedSurface) -> Face {
    Face::new(trim, 0, &mut |_| false).unwrap()
}

fn ask(face: &Face, query: Vector) -> (FootPoint, Place) {
    face.closest(query, None, &QueryOptions::default(), &mut FaceWorkspace::default())
}

fn meridian() -> Curve {
    let poles = [[1.5, 0.1, 0.0], [2.0, 0.1, 1.0], [1.0, 0.1, 2.0], [1.7, 0.1, 3.0]];
    let knots = [0.0, 0.0, 0.0, 0.4, 1.0, 1.0, 1.0];
    Curve::new(&knots, 2, &poles, Some(&[1.0, 2.0, 0.5, 1.0])).unwrap()
}

/// Every kind of elementary surface, with a spline hole and a round one.
fn elementary(random: &mut Random) -> Vec<TrimmedSurface> {
    let axes = Axes::around(random.vector(), random.vector(), random.vector()).unwrap();
    let (origin, axis) = ([0.0; 3], [0.0, 0.0, 1.0]);
    let kinds = [
        (Elementary::Plane { axes }, [-1.0, 2.0, 0.5, 3.0]),
        (Elementary::Cylinder { axes, radius: 0.7 }, [0.0, TAU, -1.0, 2.0]),
        (Elementary::Cone { axes, radius: 0.0, half_angle: -0.3 }, [0.0, TAU, -4.0, 0.0]),
        (Elementary::Sphere { axes, radius: 2.0 }, [0.0, TAU, -FRAC_PI_2, FRAC_PI_2]),
        (Elementary::Torus { axes, major: 2.0, minor: 0.5 }, [0.0, TAU, 0.0, TAU]),
        (Elementary::Revolution { origin, axis, meridian: meridian() }, [0.4, 5.0, 0.2, 0.9]),
        (
            Elementary::Extrusion { curve: meridian(), direction: [0.3, 1.0, 0.0] },
            [0.1, 1.0, -1.0, 2.0],
        ),
    ];
    kinds.map(|(kind, domain)| holed(ElementarySurface::new(kind, domain).unwrap().into())).into()
}

fn holed(support: Support) -> TrimmedSurface {
    let whole = TrimmedSurface::whole(support.clone()).unwrap();
    let [u0, u1, v0, v1] = support.domain();
    let at = |x: f64, y: f64| [between(u0, u1, x), between(v0, v1, y)];
    let (center, size) = (at(0.3, 0.5), [0.2 * (u1 - u0), 0.3 * (v1 - v0)]);
    let hole = Pcurve::arc(center, [size[0], 0.0], [0.0, -size[1]], [0.0, TAU]).unwrap();
    let corners = [at(0.6, 0.3), at(0.65, 0.8), at(0.8, 0.9), at(0.9, 0.2), at(0.6, 0.3)];
    let poles: Vec<Vector> = corners.iter().map(|p| [p[0], p[1], 0.0]).collect();
    let knots = [0.0, 0.0, 0.0, 1.0, 2.0, 3.0, 3.0, 3.0];
    let free = Pcurve::spline(Curve::new(&knots, 2, &poles, None).unwrap()).unwrap();
    let mut loops = whole.loops().to_vec();
    loops.push(Loop::inner(vec![Coedge::alone(hole)]));
    loops.push(Loop::inner(vec![Coedge::alone(free)]));
    TrimmedSurface::new(support, whole.edges().to_vec(), loops, false).unwrap()
}

/// Points of the face at a grid of its domain.
fn samples(face: &Face, count: usize) -> Vec<Vector> {
    let [u0, u1, v0, v1] = face.support().domain();
    let mut out = Vec::new();
    let (mut workspace, options) = (FaceWorkspace::default(), QueryOptions::default());
    for i in 0..=count {
        for j in 0..=count {
            let share = |k: usize| k as f64 / count as f64;
            let at = [between(u0, u1, share(i)), between(v0, v1, share(j))];
            if face.classify(at, &options, &mut workspace).standing != Standing::Outside {
                out.push(face.support().evaluate(at));
            }
        }
    }
    out
}

/// Queries around some points.
fn queries(random: &mut Random, around: &[Vector], count: usize) -> Vec<Vector> {
    (0..count)
        .map(|_| {
            let base = around[random.below(around.len())];
            let size = 10f64.powf(random.between(-6.0, 0.5));
            let way = random.vector();
            [0, 1, 2].map(|k| base[k] + size * way[k])
        })
        .collect()
}

#[test]
fn elementary_faces_answer_as_their_nurbs_forms_do_in_their_own_parameters() {
    let mut random = Random(41);
    let mut all = elementary(&mut random);
    all.extend((0..KINDS.len()).map(|kind| face(kind, &mut random).1));
    for trim in &all {
        let Support::Elementary(support) = trim.support() else { unreachable!() };
        let own = prepared(trim);
        let forms = support.surface().usual_forms();
        let (low, high) = support.form().unwrap().surface().bounding_box();
        let size = norm(sub(high, low));
        let options = ChangeOptions { replacement: Replacement::Spline, tolerance: 1e-8 * size };
        let changed = trim.to_nurbs(forms, &options).unwrap();
        let other = prepared(&changed.face);
        let nearby = samples(&own, 20);
        assert!(nearby.len() > 20);
        for query in queries(&mut random, &nearby, 60) {
            let ((a, place), (b, _)) = (ask(&own, query), ask(&other, query));
            assert_eq!(a.flags & flag::NOT_PROVEN, 0, "{a:?}");
            assert!((a.distance - b.distance).abs() <= 2e-8 * size, "{a:?} {b:?}");
            assert!(a.lower_bound <= a.distance);
            let there = trim.support().evaluate([a.u, a.v]);
            assert_eq!(there, a.point);
            assert!(place.standing == Standing::Inside || place.standing == Standing::OnEdge);
            // Nothing of the face is nearer.
            let nearest = nearby.iter().map(|p| norm(sub(query, *p))).fold(f64::INFINITY, f64::min);
            assert!(a.distance <= nearest + 1e-12 * size, "{a:?} {nearest}");
        }
    }
}

#[test]
fn sides_of_elementary_faces_are_exact_and_edges_are_named_in_their_own_parameters() {
    let mut random = Random(42);
    for trim in elementary(&mut random) {
        let own = prepared(&trim);
        let [u0, u1, v0, v1] = trim.support().domain();
        let (mut workspace, options) = (FaceWorkspace::default(), QueryOptions::default());
        for _ in 0..300 {
            let (x, y) = (random.unit(), random.unit());
            let round = ((x - 0.3) / 0.2).hypot((y - 0.5) / 0.3);
            let at = [between(u0, u1, x), between(v0, v1, y)];
            let place = own.classify(at, &options, &mut workspace);
            if round < 0.999 {
                assert_eq!(place.standing, Standing::Outside, "{at:?}");
            } else if round > 1.001 && x < 0.55 {
                assert_eq!(place.standing, Standing::Inside, "{at:?}");
            }
        }
        // Places on curves: the coedge and its parameter.
        for (chain, number, coedge) in trim.coedges() {
            for share in [0.0, 0.21, 0.5, 0.83] {
                let t = coedge.pcurve.parameter_at(share);
                let at = coedge.pcurve.evaluate(t);
                let place = own.classify(at, &options, &mut workspace);
                assert_eq!(place.standing, Standing::OnEdge, "{chain} {number} {share}");
                // Corners, seams and collapsed sides belong to several coedges: the point is the same.
                let named =
                    &trim.loops()[place.loop_index as usize].coedges[place.coedge_index as usize];
                let there = trim.support().evaluate(named.pcurve.evaluate(place.parameter));
                let apart = norm(sub(there, trim.support().evaluate(at)));
                assert!(apart < 1e-6, "{chain} {number} {share}: {place:?} {apart:e}");
                if share > 0.0 && chain > 0 {
                    assert!((place.parameter - t).abs() < 1e-6, "{place:?} {t}");
                }
            }
        }
    }
}

#[test]
fn preimages_on_an_elementary_face_are_those_of_its_region() {
    let mut random = Random(43);
    let Some(torus) = elementary(&mut random).into_iter().nth(4) else { unreachable!() };
    let own = prepared(&torus);
    let point = |u: f64, v: f64| torus.support().evaluate([u, v]);
    let find = |p: Vector| own.preimage(p, 1e-9, &QueryOptions::default(), &mut || false).unwrap();
    let inside = find(point(0.3, 0.4));
    assert_eq!((inside.members.len(), inside.is_complete()), (1, true));
    let foot = inside.members[0].foot;
    assert!((foot.u - 0.3).abs() < 1e-8 && (foot.v - 0.4).abs() < 1e-8, "{foot:?}");
    assert!(inside.members[0].u[0] <= foot.u && foot.u <= inside.members[0].u[1]);
    let in_hole = find(point(0.3 * TAU, 0.5 * TAU));
    assert_eq!((in_hole.members.len(), in_hole.is_complete()), (0, true));
}

/// A sphere by a function of its angles.
fn called(radius: f64, bounds: SurfaceBounds) -> Support {
    let function = move |u: f64, v: f64, order: usize, out: &mut [Vector; 6]| {
        let ((su, cu), (sv, cv)) = (u.sin_cos(), v.sin_cos());
        let at = |a: f64, b: f64, c: f64| [radius * a, radius * b, radius * c];
        out[0] = at(cv * cu, cv * su, sv);
        out[1] = at(-cv * su, cv * cu, 0.0);
        out[2] = at(-sv * cu, -sv * su, cv);
        out[3] = at(-cv * cu, -cv * su, 0.0);
        out[4] = at(sv * su, -sv * cu, 0.0);
        out[5] = at(-cv * cu, -cv * su, -sv);
        Some(order)
    };
    let domain = [0.0, TAU, -FRAC_PI_2, FRAC_PI_2];
    Support::Callback(Arc::new(CallbackSurface::new(domain, bounds, function).unwrap()))
}

#[test]
fn faces_on_functions_are_proven_as_far_as_their_bounds_go() {
    let mut random = Random(44);
    let radius = 2.0;
    let patch = |support: Support| {
        let hole = Pcurve::arc([2.0, 0.1], [0.5, 0.0], [0.0, -0.4], [0.0, TAU]).unwrap();
        let corners = [[1.0, -0.8], [4.0, -1.0], [4.2, 0.9], [1.2, 1.0], [1.0, -0.8]];
        let outer = Pcurve::polyline(&corners).unwrap();
        let loops =
            vec![Loop::outer(vec![Coedge::alone(outer)]), Loop::inner(vec![Coedge::alone(hole)])];
        TrimmedSurface::new(support, Vec::new(), loops, false).unwrap()
    };
    let kind = Elementary::Sphere { axes: Axes::STANDARD, radius };
    let exact = ElementarySurface::new(kind, [0.0, TAU, -FRAC_PI_2, FRAC_PI_2]).unwrap();
    let exact = prepared(&patch(exact.into()));
    let known = SurfaceBounds { speed: Some([radius; 2]), second: Some([radius; 3]) };
    let options = QueryOptions { accuracy: 1e-6, tolerance: 1e-4, ..QueryOptions::default() };
    for bounds in [known, SurfaceBounds::default()] {
        let is_proven = bounds.speed.is_some();
        let own = prepared(&patch(called(radius, bounds)));
        let mut workspace = FaceWorkspace::default();
        for _ in 0..40 {
            let at = [random.between(0.5, 4.5), random.between(-1.2, 1.2)];
            let expected = exact.classify(at, &options, &mut workspace);
            let place = own.classify(at, &options, &mut workspace);
            assert_eq!(place.standing, expected.standing, "{at:?}");
            assert!(is_proven == (place.flags & NOT_PROVEN == 0) || place.flags == 0);
        }
        let mut proven = 0;
        for _ in 0..12 {
            let query = random.vector().map(|x| 4.0 * x);
            let (found, place) = own.closest(query, None, &options, &mut workspace);
            let (expected, _) = exact.closest(query, None, &options, &mut workspace);
            assert!((found.distance - expected.distance).abs() < 2e-6, "{found:?} {expected:?}");
            assert!(found.lower_bound <= expected.distance + 1e-12);
            let says = found.flags & flag::NOT_PROVEN == 0;
            assert!(is_proven || !says && place.flags == NOT_PROVEN && found.lower_bound == 0.0);
            proven += usize::from(says);
        }
        assert!(!is_proven || proven >= 8, "{proven}");
    }
}

#[test]
fn making_a_face_can_be_stopped_watched_and_limited() {
    let trim = elementary(&mut Random(45)).swap_remove(3);
    let total = trim.coedges().count();
    let mut told = Vec::new();
    Face::new(&trim, 0, &mut |done| {
        told.push(done);
        false
    })
    .unwrap();
    assert!(told.windows(2).all(|w| w[0] <= w[1]) && told.contains(&(total - 1)), "{told:?}");
    let stopped = Face::new(&trim, 0, &mut |done| done == 3).unwrap_err();
    assert_eq!(stopped.to_string(), "cancelled by should_stop");
    let limited = Face::new(&trim, 5, &mut |_| false).unwrap_err().to_string();
    assert!(limited.starts_with("budget: 5 spans do not do for loop"), "{limited}");
    // A long polyline is asked about in between.
    let count = 2000;
    let corner = |k: usize| {
        let angle = TAU * (k % count) as f64 / count as f64;
        [2.0 + 0.5 * angle.cos(), 0.4 * angle.sin()]
    };
    let points: Vec<[f64; 2]> = (0..=count).map(corner).collect();
    let long = Loop::outer(vec![Coedge::alone(Pcurve::polyline(&points).unwrap())]);
    let long = TrimmedSurface::new(trim.support().clone(), Vec::new(), vec![long], false).unwrap();
    let mut asked = 0;
    Face::new(&long, 0, &mut |_| {
        asked += 1;
        false
    })
    .unwrap();
    assert!(asked > count / 64, "{asked}");
}
