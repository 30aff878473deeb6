//! Surface-surface intersection of faces: trims end branches, elementary supports keep their own parameters, functions are honest.

mod march_shapes;

use footpoint::bounds::{norm, sub};
use footpoint::callback::{CallbackSurface, SurfaceBounds};
use footpoint::curve::Curve;
use footpoint::elementary::{Axes, Elementary, ElementarySurface};
use footpoint::index::IndexedSurface;
use footpoint::march::curves::curves;
use footpoint::march::faces::intersect_faces;
use footpoint::march::split::{Cut, cuts_of, split};
use footpoint::march::{End, Intersection, MarchOptions, MarchPoint, distance_to_chord};
use footpoint::pcurve::Pcurve;
use footpoint::surface::Surface;
use footpoint::trim::{Coedge, Loop, Support, TrimmedSurface};
use march_shapes::{cylinder, plane, sphere};
use std::f64::consts::{PI, TAU};

fn meet(a: &TrimmedSurface, b: &TrimmedSurface) -> Intersection {
    intersect_faces(a, b, &MarchOptions::default(), &mut |_, _| false).unwrap()
}

fn whole(s: Surface) -> TrimmedSurface {
    TrimmedSurface::whole(s.into()).unwrap()
}

fn level(z: f64) -> Surface {
    plane([-3.1, -3.0, z], [6.0, 0.0, 0.0], [0.0, 6.2, 0.0])
}

/// The plane z = `z` with a round hole, or a disc of it, around the origin: u, v are (x + 3.1) / 6, (y + 3) / 6.2.
fn disc(z: f64, radius: f64, x: f64, is_hole: bool) -> TrimmedSurface {
    let (centre, ru, rv) = ([(3.1 + x) / 6.0, 3.0 / 6.2], radius / 6.0, radius / 6.2);
    let around = if is_hole { -rv } else { rv };
    let circle = Pcurve::arc(centre, [ru, 0.0], [0.0, around], [0.0, TAU]).unwrap();
    let chain = vec![Coedge::alone(circle)];
    let support: Support = level(z).into();
    let loops = if is_hole {
        let mut loops = TrimmedSurface::whole(support.clone()).unwrap().loops().to_vec();
        for coedge in &mut loops[0].coedges {
            coedge.edge = None;
            coedge.same_parameter = false;
            coedge.reversed = false;
        }
        loops.push(Loop::inner(chain));
        loops
    } else {
        vec![Loop::outer(chain)]
    };
    TrimmedSurface::new(support, Vec::new(), loops, false).unwrap()
}

#[test]
fn a_circle_that_a_trim_cuts_is_an_arc_with_ends_on_the_trim() {
    // The circle of radius sqrt(0.91) and one of radius 1 around x = 0.5 cross at x = (0.91 - 1 + 0.25) / 1.
    let x = 0.16;
    for (is_hole, want) in [(false, 1), (true, 1)] {
        let found = meet(&whole(sphere(1.0)), &disc(0.3, 1.0, 0.5, is_hole));
        assert_eq!(found.branches.len(), want, "{:?}", found.branches);
        assert!(found.is_proven && found.undecided.is_empty());
        let branch = &found.branches[0];
        assert_eq!(branch.ends, [End::Trim(1), End::Trim(1)]);
        let points = &branch.points;
        for end in [points[0], points[points.len() - 1]] {
            assert!((end.point[0] - x).abs() < 1e-11, "{:?}", end.point);
        }
        for p in points {
            assert!((norm(p.point) - 1.0).abs() < 1e-12 && (p.point[2] - 0.3).abs() < 1e-12);
            let inside = (p.point[0] - 0.5).hypot(p.point[1]) - 1.0;
            assert!(if is_hole { inside > -1e-11 } else { inside < 1e-11 }, "{inside}");
        }
    }
    // All of it, and nothing of it.
    let found = meet(&whole(sphere(1.0)), &disc(0.3, 1.2, 0.0, false));
    assert!(found.is_proven && found.branches.len() == 1 && found.branches[0].is_closed());
    let found = meet(&whole(sphere(1.0)), &disc(0.3, 1.2, 0.0, true));
    assert!(found.is_proven && found.branches.is_empty());
    // Four ends: a narrow strip across the circle.
    let strip = [[0.4, 0.2], [0.6, 0.2], [0.6, 0.9], [0.4, 0.9], [0.4, 0.2]];
    let chain = vec![Coedge::alone(Pcurve::polyline(&strip).unwrap())];
    let face = TrimmedSurface::new(level(0.3).into(), vec![], vec![Loop::outer(chain)], false);
    let found = meet(&whole(sphere(1.0)), &face.unwrap());
    assert!(found.is_proven && found.branches.len() == 2);
    assert!(found.branches.iter().all(|b| b.ends == [End::Trim(1); 2]));
}

/// Stops at each question: what both faces hold is in a branch or a box, and what one of them does not hold is in no branch beyond a box.
#[test]
fn a_stop_while_branches_are_cut_at_trims_loses_nothing_and_claims_nothing() {
    let ball = whole(sphere(1.0));
    let mut cut_in_part = 0;
    for is_hole in [false, true] {
        let disc = disc(0.3, 1.0, 0.5, is_hole);
        let options = MarchOptions { chord: 1e-4, ..MarchOptions::default() };
        let stopped_at = |n: usize| {
            let mut asked = 0;
            let found = intersect_faces(&ball, &disc, &options, &mut |_, _| {
                asked += 1;
                asked == n
            });
            (found.unwrap(), asked)
        };
        let (whole, asked) = stopped_at(usize::MAX);
        assert!(whole.is_proven && !whole.stopped && asked > 4, "{asked} questions");
        for n in 1..=asked {
            let (part, questions) = stopped_at(n);
            assert!(part.stopped && questions == n, "question {n} of {asked}");
            let holds = |p: &MarchPoint| {
                let at = [p.uv[0], p.uv[1], p.st[0], p.st[1]];
                part.undecided.iter().any(|box_of| {
                    let r = box_of.range;
                    (0..4).all(|q| r[2 * q] - 1e-9 <= at[q] && at[q] <= r[2 * q + 1] + 1e-9)
                })
            };
            let near = |p: &MarchPoint| {
                part.branches.iter().any(|branch| {
                    let far = |w: &[MarchPoint]| distance_to_chord(p.point, w[0].point, w[1].point);
                    branch.points.windows(2).any(|w| far(w) <= 1.01 * branch.chord + 1e-9)
                })
            };
            let lost = whole.branches[0].points.iter().find(|p| !holds(p) && !near(p));
            assert!(lost.is_none(), "question {n} of {asked}: {lost:?} is lost");
            for p in part.branches.iter().flat_map(|branch| &branch.points) {
                let inside = ((p.point[0] - 0.5).hypot(p.point[1]) < 1.0 + 1e-9) != is_hole;
                let rim = ((p.point[0] - 0.5).hypot(p.point[1]) - 1.0).abs() < 1e-9;
                assert!(inside || rim || holds(p), "question {n} of {asked}: {p:?} is cut off");
            }
            assert!(!part.undecided.is_empty() || part.is_proven, "question {n} of {asked}");
            let ends = part.branches.iter().flat_map(|branch| branch.ends);
            cut_in_part += usize::from(ends.into_iter().any(|end| end == End::Undecided));
        }
    }
    assert!(cut_in_part > 0);
}

#[test]
fn a_trim_along_the_curve_is_kept_and_listed() {
    // The disc ends where the sphere meets it.
    let found = meet(&whole(sphere(1.0)), &disc(0.3, 0.91f64.sqrt(), 0.0, false));
    assert!(!found.is_proven && !found.undecided.is_empty());
    let length: f64 = found
        .branches
        .iter()
        .flat_map(|b| b.points.windows(2).map(|w| norm(sub(w[1].point, w[0].point))))
        .sum();
    // Chords are shorter than the circle, by less than their allowance of 1e-3 of the size lets them be.
    let circle = TAU * 0.91f64.sqrt();
    assert!((0.99 * circle..=circle + 1e-9).contains(&length), "{length} of {circle}");
}

#[test]
fn elementary_supports_keep_their_angles() {
    let axes = Axes::around([0.0; 3], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]).unwrap();
    let tube = Elementary::Cylinder { axes, radius: 1.0 };
    let tube = ElementarySurface::new(tube, [0.0, TAU, -2.0, 2.0]).unwrap();
    let ball = Elementary::Sphere {
        axes: Axes::around([0.5, 0.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]).unwrap(),
        radius: 1.2,
    };
    let ball = ElementarySurface::new(ball, [0.0, TAU, -PI / 2.0, PI / 2.0]).unwrap();
    let (a, b): (Support, Support) = (tube.clone().into(), ball.clone().into());
    let found = meet(&TrimmedSurface::whole(a).unwrap(), &TrimmedSurface::whole(b).unwrap());
    assert!(found.is_proven && !found.branches.is_empty());
    for p in found.branches.iter().flat_map(|b| &b.points) {
        let (x, y) = (tube.evaluate(p.uv[0], p.uv[1]), ball.evaluate(p.st[0], p.st[1]));
        assert!(norm(sub(x, p.point)) < 1e-13 && norm(sub(y, p.point)) < 1e-13);
        assert!(
            (p.point[1].atan2(p.point[0]).rem_euclid(TAU) - p.uv[0]).abs() < 1e-12
                || p.uv[0] > TAU - 1e-12
        );
    }
}

#[test]
fn functions_are_met_and_never_said_to_be_proven() {
    let bowl =
        CallbackSurface::new([-1.0, 1.0, -1.0, 1.0], SurfaceBounds::default(), |u, v, _, out| {
            *out = [
                [u, v, u * u + v * v],
                [1.0, 0.0, 2.0 * u],
                [0.0, 1.0, 2.0 * v],
                [0.0, 0.0, 2.0],
                [0.0; 3],
                [0.0, 0.0, 2.0],
            ];
            Some(2)
        })
        .unwrap();
    let a = TrimmedSurface::whole(Support::Callback(std::sync::Arc::new(bowl))).unwrap();
    let found = meet(&a, &whole(level(0.3)));
    assert!(!found.is_proven && found.undecided.len() == 1);
    assert_eq!(found.branches.len(), 1);
    assert!(found.branches[0].is_closed());
    for p in &found.branches[0].points {
        assert!((p.point[0].hypot(p.point[1]) - 0.3f64.sqrt()).abs() < 1e-5, "{:?}", p.point);
    }
}

/// Area in the domain by the trapezoid rule.
fn area(face: &TrimmedSurface) -> f64 {
    let of = |pcurve: &Pcurve| {
        let at = |k: u32| pcurve.evaluate(pcurve.parameter_at(f64::from(k) / 512.0));
        (0..512)
            .map(|k| (at(k), at(k + 1)))
            .map(|(p, q)| 0.5 * (p[0] * q[1] - p[1] * q[0]))
            .sum::<f64>()
    };
    face.coedges().map(|(_, _, coedge)| of(&coedge.pcurve)).sum()
}

fn cuts(a: &IndexedSurface, b: &IndexedSurface, found: &Intersection, second: bool) -> Vec<Cut> {
    let mut all = Vec::new();
    for branch in &found.branches {
        for part in curves(a, b, &branch.points, 1e-4, &mut |_, _| false).unwrap() {
            let plane: Curve = if second { part.st } else { part.uv };
            all.push(Cut { pcurve: Pcurve::spline(plane).unwrap(), edge: Some(part.space) });
        }
    }
    all
}

#[test]
fn faces_are_split_by_what_they_have_in_common() {
    // A ball through a plane: a disc and a plane with a hole; the ball in two caps, over its seam.
    let (ball, sheet) = (sphere(1.0), level(0.3));
    let (a, b) = (IndexedSurface::new(ball.clone()), IndexedSurface::new(sheet.clone()));
    let (fa, fb) = (whole(ball), whole(sheet));
    let found = meet(&fa, &fb);
    let parts = split(&fb, &cuts(&a, &b, &found, true), 1e-6, &mut |_, _| false).unwrap().faces;
    assert_eq!(parts.len(), 2);
    let mut areas: Vec<f64> = parts.iter().map(area).collect();
    areas.sort_by(f64::total_cmp);
    let disc = 0.91 * PI / (6.0 * 6.2);
    assert!((areas[0] - disc).abs() < 1e-4 && (areas[1] - 1.0 + disc).abs() < 1e-4, "{areas:?}");
    let begin = std::time::Instant::now();
    for part in &parts {
        let report = part.report(1e-3).unwrap();
        assert!(report.is_valid(), "{report:?}");
    }
    println!("two reports: {:?}", begin.elapsed());
    let parts = split(&fa, &cuts(&a, &b, &found, false), 1e-6, &mut |_, _| false).unwrap().faces;
    assert_eq!(parts.len(), 2);
    for part in &parts {
        let report = part.report(1e-3).unwrap();
        assert!(report.is_valid(), "{report:?}");
    }
    let total: f64 = parts.iter().map(area).sum();
    assert!((total - 1.0).abs() < 1e-9);
    // Open cuts: two lines on a cylinder give two faces beside the seam, three in the domain.
    let tube = cylinder(1.0, 2.0);
    let upright = plane([0.3, -3.0, -3.1], [0.0, 6.2, 0.0], [0.0, 0.0, 6.3]);
    let (a, b) = (IndexedSurface::new(tube.clone()), IndexedSurface::new(upright.clone()));
    let (fa, fb) = (whole(tube), whole(upright));
    let found = meet(&fa, &fb);
    assert_eq!(found.branches.len(), 2);
    let parts = split(&fa, &cuts(&a, &b, &found, false), 1e-6, &mut |_, _| false).unwrap().faces;
    assert_eq!(parts.len(), 3);
    assert!((parts.iter().map(area).sum::<f64>() - 1.0).abs() < 1e-9);
    assert!(split(&fa, &[], 0.0, &mut |_, _| false).is_err());
    let inside = Pcurve::polyline(&[[0.4, 0.4], [0.6, 0.6]]).unwrap();
    let unused =
        split(&fa, &[Cut { pcurve: inside, edge: None }], 1e-6, &mut |_, _| false).unwrap();
    assert_eq!((unused.faces.len(), unused.unused), (1, vec![0]));
    // The polylines of the branches do as well, also in the angles of an elementary support.
    let axes = Axes::around([0.0; 3], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]).unwrap();
    let tube =
        ElementarySurface::new(Elementary::Cylinder { axes, radius: 1.0 }, [0.0, TAU, -2.0, 2.0]);
    let tube = TrimmedSurface::whole(tube.unwrap().into()).unwrap();
    let found = meet(&tube, &fb);
    let split = split(&tube, &cuts_of(&found, false).unwrap(), 1e-6, &mut |_, _| false).unwrap();
    assert_eq!((split.faces.len(), split.unused.len()), (3, 0));
    assert!((split.faces.iter().map(area).sum::<f64>() - 4.0 * TAU).abs() < 1e-9);
    for part in &split.faces {
        assert!(part.report(1e-3).unwrap().is_valid());
    }
}
