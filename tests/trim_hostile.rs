//! Faces that no system should write, and some do: every answer is right or says that it is not proven, and nothing panics.

mod faces;

use std::f64::consts::{FRAC_PI_2, TAU};

use faces::Random;
use footpoint::bounds::{Vector, norm, sub};
use footpoint::closest::{QueryOptions, flag};
use footpoint::curve::Curve;
use footpoint::elementary::{Axes, CircleForm, Elementary, ElementarySurface};
use footpoint::face::{Face, FaceWorkspace, Halving, Side, Standing};
use footpoint::pcurve::{Direction, Pcurve};
use footpoint::surface::Surface;
use footpoint::trim::{ChangeOptions, Coedge, Edge, Finding, Loop, Support, TrimmedSurface};

fn sphere(radius: f64) -> Support {
    let kind = Elementary::Sphere { axes: Axes::STANDARD, radius };
    ElementarySurface::new(kind, [0.0, TAU, -FRAC_PI_2, FRAC_PI_2]).unwrap().into()
}

fn plane(size: f64) -> Support {
    let kind = Elementary::Plane { axes: Axes::STANDARD };
    ElementarySurface::new(kind, [0.0, size, 0.0, size]).unwrap().into()
}

fn polygon(points: &[[f64; 2]]) -> Loop {
    let closed = [points, &points[..1]].concat();
    Loop::outer(vec![Coedge::alone(Pcurve::polyline(&closed).unwrap())])
}

fn trimmed(support: Support, loops: Vec<Loop>) -> TrimmedSurface {
    TrimmedSurface::new(support, Vec::new(), loops, false).unwrap()
}

fn prepared(trim: &TrimmedSurface) -> Face {
    Face::new(trim, 0, &mut |_| false).unwrap()
}

/// Queries whose answers must not be farther than any sample of the face, and bounds that hold for them.
fn attack(trim: &TrimmedSurface, random: &mut Random, count: usize) {
    let face = prepared(trim);
    let (mut workspace, options) = (FaceWorkspace::default(), QueryOptions::default());
    let [u0, u1, v0, v1] = trim.support().domain();
    let box_of_region = face.region().bounds();
    let mut points: Vec<Vector> = Vec::new();
    for k in 0..2 * count {
        let wide = k % 2 == 0;
        let [a, b, c, d] = if wide { [u0, u1, v0, v1] } else { box_of_region };
        let at = [random.between(a, b).clamp(u0, u1), random.between(c, d).clamp(v0, v1)];
        // The exact side: within the tolerance of an edge a place may be outside.
        if face.region().side(at, &mut Halving::default()) != Side::Outside {
            points.push(trim.support().evaluate(at));
        }
    }
    for coedge in trim.coedges().map(|(_, _, coedge)| coedge) {
        points.extend([0.0, 0.3, 0.9].map(|share| trim.coedge_point(coedge, share)));
    }
    let bounds = trim.support().bounding_box().unwrap();
    let size = bounds.diagonal();
    for k in 0..count {
        let base = points[random.below(points.len())];
        let reach = size * 10f64.powf(random.between(-7.0, 0.3));
        let way = random.vector();
        let query = [0, 1, 2].map(|k| base[k] + reach * way[k]);
        let (foot, _) = face.closest(query, None, &options, &mut workspace);
        assert!(foot.lower_bound <= foot.distance, "{k}: {foot:?}");
        for point in &points {
            let there = norm(sub(query, *point));
            assert!(foot.lower_bound <= there + 1e-12 * size, "{k}: {foot:?} {there}");
            let proven = foot.flags & flag::NOT_PROVEN == 0;
            // Proven to the accuracy, 1e-10 of the diagonal of the surface's box or the larger one of its NURBS form.
            assert!(!proven || foot.distance <= there + 1e-9 * size, "{k}: {foot:?} {there}");
        }
    }
}

#[test]
fn random_tangles_are_answered_and_reported() {
    let mut random = Random(61);
    for round in 0..24 {
        let support = match round % 4 {
            0 => plane(3.0),
            1 => sphere(2.0),
            2 => {
                let kind = Elementary::Torus { axes: Axes::STANDARD, major: 3.0, minor: 1.0 };
                ElementarySurface::new(kind, [0.0, TAU, 0.0, TAU]).unwrap().into()
            }
            _ => {
                let Support::Elementary(sphere) = sphere(2.0) else { unreachable!() };
                sphere.surface().nurbs([CircleForm::Halves, CircleForm::Arcs(2)]).unwrap().into()
            }
        };
        let [u0, u1, v0, v1] = support.domain();
        let loops = (0..1 + random.below(3))
            .map(|_| {
                let corners: Vec<[f64; 2]> = (0..3 + random.below(8))
                    .map(|_| {
                        // Some on borders and corners of the domain.
                        let pick = |random: &mut Random, a: f64, b: f64| match random.below(5) {
                            0 => a,
                            1 => b,
                            _ => random.between(a, b),
                        };
                        [pick(&mut random, u0, u1), pick(&mut random, v0, v1)]
                    })
                    .collect();
                polygon(&corners)
            })
            .collect();
        let trim = trimmed(support, loops);
        attack(&trim, &mut random, 12);
        let report = trim.report(0.0).unwrap();
        assert!(report.tolerance > 0.0);
        // Round trips of what is not valid must not panic either.
        let options = ChangeOptions { tolerance: 1e-3, ..Default::default() };
        if let Support::Elementary(elementary) = trim.support() {
            let forms = elementary.surface().usual_forms();
            trim.to_nurbs(forms, &options).unwrap();
            let _ = trim.followed(elementary.form().unwrap().surface().clone().into(), &options);
        }
        let again = TrimmedSurface::from_json(&trim.to_json().unwrap()).unwrap();
        assert_eq!(again.to_json().unwrap(), trim.to_json().unwrap());
    }
}

#[test]
fn slivers_are_reported_and_their_points_found() {
    let mut random = Random(62);
    for width in [1e-3, 1e-6, 1e-9, 1e-12, 1e-15] {
        for support in [plane(3.0), sphere(2.0)] {
            let sliver = polygon(&[[0.5, 0.5], [1.4, 0.5 + width], [0.6, 0.5 + 2.0 * width]]);
            let trim = trimmed(support, vec![sliver]);
            let report = trim.report(1e-7).unwrap();
            // Sides that meet at such angles are nearer than the tolerance a hundredth of their length from the corner.
            assert_eq!(report.is_valid(), width > 1e-5, "{width:e} {report:?}");
            attack(&trim, &mut random, 8);
            let face = prepared(&trim);
            let on = trim.support().evaluate([0.9, 0.5 + 0.5 * width]);
            let (foot, place) =
                face.closest(on, None, &QueryOptions::default(), &mut FaceWorkspace::default());
            assert!(foot.distance <= 2.0 * width + 1e-14, "{width:e} {foot:?}");
            assert_ne!(place.standing, Standing::Outside);
        }
    }
    // The same of two curves that share both ends.
    for (width, valid) in [(1e-3, true), (1e-8, false), (0.0, false)] {
        let curve = |points: &[[f64; 2]]| Coedge::alone(Pcurve::polyline(points).unwrap());
        let (a, b) = ([0.5, 0.5], [2.5, 0.5]);
        let chain = vec![curve(&[a, b]), curve(&[b, [1.5, 0.5 + width], a])];
        let report = trimmed(plane(3.0), vec![Loop::outer(chain)]).report(1e-7).unwrap();
        assert_eq!(report.is_valid(), valid, "{width:e} {report:?}");
    }
    // A loop without any area: a line there and back.
    let flat = trimmed(plane(3.0), vec![polygon(&[[0.5, 0.5], [2.0, 1.0]])]);
    let report = flat.report(0.0).unwrap();
    assert!(report.findings.iter().any(|f| matches!(f, Finding::NoDirection { .. })), "{report:?}");
    attack(&flat, &mut random, 8);
}

#[test]
fn loops_that_touch_are_reported_and_keep_their_sides() {
    let square = |a: f64, b: f64| polygon(&[[a, a], [b, a], [b, b], [a, b]]);
    let hole = |points: &[[f64; 2]]| {
        let mut made = polygon(points);
        made.kind = footpoint::trim::LoopKind::Inner;
        made.coedges[0].pcurve = made.coedges[0].pcurve.reversed();
        made
    };
    // A corner of the hole on a side, a hole that shares half a side, two holes that share a corner.
    let cases = [
        vec![square(0.5, 2.5), hole(&[[0.5, 1.5], [1.5, 1.0], [1.5, 2.0]])],
        vec![square(0.5, 2.5), hole(&[[0.5, 1.0], [1.5, 1.0], [1.5, 2.0], [0.5, 2.0]])],
        vec![
            square(0.5, 2.5),
            hole(&[[1.0, 1.0], [1.5, 1.0], [1.5, 1.5], [1.0, 1.5]]),
            hole(&[[1.5, 1.5], [2.0, 1.5], [2.0, 2.0], [1.5, 2.0]]),
        ],
    ];
    let mut random = Random(63);
    for loops in cases {
        let trim = trimmed(plane(3.0), loops);
        let report = trim.report(1e-7).unwrap();
        let contact = |f: &Finding| {
            matches!(
                f,
                Finding::Touching { .. } | Finding::Crossing { .. } | Finding::Undecided { .. }
            )
        };
        assert!(report.findings.iter().any(contact), "{report:?}");
        let face = prepared(&trim);
        let side = |u: f64, v: f64| {
            let options = QueryOptions::default();
            face.classify([u, v], &options, &mut FaceWorkspace::default()).standing
        };
        assert_eq!(side(2.2, 0.7), Standing::Inside);
        assert_eq!(side(1.49, 1.49), Standing::Outside);
        assert_eq!(side(0.2, 1.5), Standing::Outside);
        attack(&trim, &mut random, 10);
    }
}

#[test]
fn a_tiny_face_on_a_huge_surface_keeps_its_digits() {
    let knots = [0., 0., 0., 0., 1., 2., 3., 3., 3., 3.];
    let mut poles = Vec::new();
    for i in 0..6 {
        for j in 0..6 {
            let z = f64::from((i * 7 + j * 5) % 4) * 3e4;
            poles.push([f64::from(i) * 2e5, f64::from(j) * 2e5, z]);
        }
    }
    let huge = Surface::new(&knots, &knots, 3, 3, &poles, 6, 6, None).unwrap();
    // Three millimetres of a kilometre; and the same of a sphere of a kilometre.
    for (support, size) in [(Support::from(huge), 1e-6), (sphere(1e6), 3e-9)] {
        let corner = |x: f64, y: f64| [1.2 + size * x, 0.8 + size * y];
        let outer =
            polygon(&[corner(0.0, 0.0), corner(1.0, 0.1), corner(1.1, 1.0), corner(0.0, 0.9)]);
        let trim = trimmed(support, vec![outer]);
        let face = prepared(&trim);
        let options = QueryOptions { tolerance: 1e-5, ..QueryOptions::default() };
        let mut workspace = FaceWorkspace::default();
        let mut side =
            |x: f64, y: f64| face.classify(corner(x, y), &options, &mut workspace).standing;
        assert_eq!(side(0.5, 0.5), Standing::Inside);
        assert_eq!(side(-0.2, 0.5), Standing::Outside);
        assert_eq!(side(1.0, 0.05), Standing::Outside);
        assert_eq!(side(0.0, 0.0), Standing::OnEdge);
        let at = corner(0.4, 0.4);
        let query = trim.support().evaluate(at);
        let (foot, place) = face.closest(query, None, &options, &mut FaceWorkspace::default());
        assert!(foot.distance < 1e-7, "{foot:?}");
        assert_eq!(place.standing, Standing::Inside);
        let report = trim.report(1e-5).unwrap();
        assert!(report.is_valid(), "{report:?}");
    }
}

#[test]
fn collapsed_and_doubled_edges_are_told() {
    let iso = |fixed, at, from, to| Pcurve::isoline(fixed, at, from, to).unwrap();
    let (u, v) = (Direction::U, Direction::V);
    let whole = TrimmedSurface::whole(sphere(2.0)).unwrap();
    // The seam used twice the same way.
    let mut loops = whole.loops().to_vec();
    loops[0].coedges[3].reversed = false;
    let wrong = TrimmedSurface::new(sphere(2.0), whole.edges().to_vec(), loops, false).unwrap();
    let findings = wrong.report(0.0).unwrap().findings;
    assert!(findings.iter().any(|f| matches!(f, Finding::Sense { edge: 1 })), "{findings:?}");
    // The point of another pole.
    let mut edges = whole.edges().to_vec();
    edges[2] = Edge::collapsed([0.0, 0.0, -2.0]);
    let wrong = TrimmedSurface::new(sphere(2.0), edges, whole.loops().to_vec(), false).unwrap();
    let report = wrong.report(0.0).unwrap();
    let gap = |f: &Finding| matches!(f, Finding::EdgeGap { gap, .. } if (gap - 4.0).abs() < 1e-9);
    assert!(report.findings.iter().any(gap), "{report:?}");
    assert!(report.gap_bound >= 4.0 && report.gap_bound < 4.01);
    // A pole without its coedge: the loop is open in the domain and closed in space.
    let coedges = vec![
        Coedge::alone(iso(v, 0.0, 0.0, TAU)),
        Coedge::alone(iso(u, TAU, 0.0, FRAC_PI_2)),
        Coedge::alone(iso(u, 0.0, FRAC_PI_2, 0.0)),
    ];
    let open = trimmed(sphere(2.0), vec![Loop::outer(coedges)]);
    let report = open.report(0.0).unwrap();
    assert!(
        matches!(report.findings[..], [Finding::Open { gap, domain_gap, .. }] if gap < 1e-12 && domain_gap[0] == TAU),
        "{report:?}"
    );
    // Queries close it by a line.
    attack(&open, &mut Random(64), 10);
}

#[test]
fn a_bump_between_samples_is_in_the_bound_of_the_gap() {
    // An edge that leaves its coedge by 0.01 between two of the 33 places where gaps are looked for.
    let iso = |fixed, at, from, to| Pcurve::isoline(fixed, at, from, to).unwrap();
    let (u, v) = (Direction::U, Direction::V);
    let edge = |bump: f64| {
        let at = [0.0, 0.0, 1.505, 1.51, 1.515, 3.0, 3.0];
        let poles: Vec<Vector> =
            [0.0, 1.505, 1.51, 1.515, 3.0].iter().map(|&x| [x, 0.0, 0.0]).collect();
        let mut poles = poles;
        poles[2][2] = bump;
        Edge::along(Curve::new(&at, 1, &poles, None).unwrap())
    };
    for same_parameter in [true, false] {
        for bump in [0.0, 0.01] {
            let first = Coedge { same_parameter, ..Coedge::along(iso(v, 0.0, 0.0, 3.0), 0) };
            let coedges = vec![
                first,
                Coedge::alone(iso(u, 3.0, 0.0, 3.0)),
                Coedge::alone(iso(v, 3.0, 3.0, 0.0)),
                Coedge::alone(iso(u, 0.0, 3.0, 0.0)),
            ];
            let loops = vec![Loop::outer(coedges)];
            let face = TrimmedSurface::new(plane(3.0), vec![edge(bump)], loops, false).unwrap();
            let report = face.report(1e-6).unwrap();
            assert!(report.largest_gap < 1e-12, "{report:?}");
            if bump == 0.0 {
                assert!(report.gap_bound < 1e-9, "{same_parameter} {report:?}");
            } else {
                assert!(report.gap_bound >= bump, "{same_parameter} {report:?}");
            }
        }
    }
}
