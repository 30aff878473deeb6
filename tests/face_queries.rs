//! Point queries on faces: sides, nearest points, preimages.

mod shapes;

#[path = "known_shapes/mod.rs"]
mod known;

use std::sync::Arc;

use footpoint::closest::{FootPoint, QueryOptions, flag};
use footpoint::curve::Curve;
use footpoint::face::{Face, FaceWorkspace, Halving, Place, Region, Side, Standing};
use footpoint::index::IndexedSurface;
use footpoint::pcurve::{Direction, Pcurve};
use footpoint::set::Kind;
use footpoint::surface::Surface;
use footpoint::trim::{Coedge, Loop, Support, TrimmedSurface};
use shapes::{Random, Vector, norm, sub};

/// A closed cubic around a centre: `count` poles at random radii.
fn blob(
    center: [f64; 2],
    radius: [f64; 2],
    count: usize,
    clockwise: bool,
    r: &mut Random,
) -> Curve {
    let mut poles: Vec<Vector> = (0..count)
        .map(|k| {
            let angle = std::f64::consts::TAU * k as f64 / count as f64;
            let angle = if clockwise { -angle } else { angle };
            let size = r.between(0.6, 1.0);
            let [a, b] = [size * radius[0], size * radius[1]];
            [center[0] + a * angle.cos(), center[1] + b * angle.sin(), 0.0]
        })
        .collect();
    poles.push(poles[0]);
    let inner = (1..=count - 3).map(|k| k as f64);
    let last = (count - 2) as f64;
    let knots: Vec<f64> = [0.0; 4].into_iter().chain(inner).chain([last; 4]).collect();
    Curve::new(&knots, 3, &poles, None).unwrap()
}

fn coedge(pcurve: Pcurve) -> Coedge {
    Coedge::alone(pcurve)
}

fn face_of(surface: Surface, loops: Vec<Loop>) -> Face {
    let support = Support::Spline(Arc::new(IndexedSurface::new(surface)));
    let trimmed = TrimmedSurface::new(support, Vec::new(), loops, false).unwrap();
    Face::new(&trimmed, 0, &mut |_| false).unwrap()
}

/// A wavy surface over the unit square with a random outline and a hole.
fn random_face(seed: u64) -> Face {
    let mut r = Random(seed);
    let knots = [0., 0., 0., 0., 0.5, 1., 1., 1., 1.];
    let mut poles = Vec::new();
    for i in 0..5 {
        for j in 0..5 {
            poles.push([f64::from(i), f64::from(j), r.between(-1.5, 1.5)]);
        }
    }
    let weights: Vec<f64> = (0..25).map(|_| r.between(0.5, 2.0)).collect();
    let rational = seed.is_multiple_of(2);
    let surface =
        Surface::new(&knots, &knots, 3, 3, &poles, 5, 5, rational.then_some(&weights)).unwrap();
    let outer = blob([0.5, 0.5], [0.5, 0.45], 9, false, &mut r);
    let hole = blob([0.5, 0.5], [0.2, 0.15], 7, true, &mut r);
    let loops = vec![
        Loop::outer(vec![coedge(Pcurve::spline(outer).unwrap())]),
        Loop::inner(vec![coedge(Pcurve::spline(hole).unwrap())]),
    ];
    face_of(surface, loops)
}

fn ask(face: &Face, query: Vector) -> (FootPoint, Place) {
    face.closest(query, None, &QueryOptions::default(), &mut FaceWorkspace::default())
}

/// Points of a face on a grid, and of its loops.
fn samples(face: &Face, count: usize) -> Vec<([f64; 2], Vector)> {
    let surface = face.support();
    let [u0, u1, v0, v1] = surface.domain();
    let mut memory = Halving::default();
    let mut out = Vec::new();
    for i in 0..=count {
        for j in 0..=count {
            let share = |k: usize| k as f64 / count as f64;
            let at = [u0 + (u1 - u0) * share(i), v0 + (v1 - v0) * share(j)];
            if face.region().side(at, &mut memory) != Side::Outside {
                out.push((at, surface.evaluate(at)));
            }
        }
    }
    out
}

#[test]
fn nothing_of_a_face_is_nearer_than_the_answer_or_its_bound() {
    let (mut proven, mut total, mut inside) = (0, 0, 0);
    for seed in 1..=12 {
        let face = random_face(seed);
        let all = samples(&face, 120);
        assert!(all.len() > 2000);
        let mut r = Random(seed + 100);
        for _ in 0..60 {
            let query = [r.between(-1.0, 5.0), r.between(-1.0, 5.0), r.between(-3.0, 3.0)];
            let (foot, place) = ask(&face, query);
            let nearest = all.iter().map(|s| norm(sub(query, s.1))).fold(f64::INFINITY, f64::min);
            assert!(foot.lower_bound <= nearest + 1e-12, "{seed} {query:?} {foot:?} {nearest}");
            assert!(foot.distance <= nearest + 1e-9, "{seed} {query:?} {foot:?} {nearest}");
            assert!(foot.lower_bound <= foot.distance);
            // It is a point of the face.
            let at = [foot.u, foot.v];
            match place.standing {
                Standing::Inside => {
                    let side = face.region().side(at, &mut Halving::default());
                    assert_eq!(side, Side::Inside);
                    inside += 1;
                }
                Standing::OnEdge => {}
                other => panic!("{other:?}"),
            }
            total += 1;
            proven += usize::from(foot.flags & flag::NOT_PROVEN == 0);
        }
    }
    assert_eq!(proven, total, "of {total} answers, {inside} inside");
    assert!(inside > total / 10 && inside < total);
}

#[test]
fn the_nearest_point_may_be_a_foot_that_is_not_the_surface_s_own() {
    // An arch over u; the query is nearer to the leg that is cut away.
    let poles: Vec<Vector> = [[-1., 0.], [-1., 3.], [1., 3.], [1., 0.]]
        .iter()
        .flat_map(|[x, z]| [[*x, -1.0, *z], [*x, 1.0, *z]])
        .collect();
    let (u, v) = ([0., 0., 0., 0., 1., 1., 1., 1.], [0., 0., 1., 1.]);
    let surface = Surface::new(&u, &v, 3, 1, &poles, 4, 2, None).unwrap();
    let rectangle = |u0: f64, u1: f64| {
        let sides = [
            Pcurve::isoline(Direction::V, 0.1, u0, u1).unwrap(),
            Pcurve::isoline(Direction::U, u1, 0.1, 0.9).unwrap(),
            Pcurve::isoline(Direction::V, 0.9, u1, u0).unwrap(),
            Pcurve::isoline(Direction::U, u0, 0.9, 0.1).unwrap(),
        ];
        vec![Loop::outer(sides.into_iter().map(coedge).collect())]
    };
    let face = face_of(surface.clone(), rectangle(0.55, 0.99));
    let query = [-0.1, 0.0, 0.9];
    let whole = IndexedSurface::new(surface.clone()).closest(
        query,
        None,
        &QueryOptions::default(),
        &mut footpoint::closest::Workspace::default(),
        None,
    );
    assert!(whole.u < 0.5);
    let (foot, place) = ask(&face, query);
    assert_eq!((place.standing, foot.flags & flag::NOT_PROVEN), (Standing::Inside, 0));
    assert!(foot.u > 0.55 && foot.u < 0.99 && foot.distance > whole.distance + 0.05);
    // The side that it lies on ends below the foot: then the edge is nearest.
    let face = face_of(surface, rectangle(0.9, 0.99));
    let (foot, place) = ask(&face, query);
    assert_eq!((place.standing, foot.flags & flag::NOT_PROVEN), (Standing::OnEdge, 0));
    assert_eq!((foot.u, place.coedge_index), (0.9, 3));
}

#[test]
fn a_continuum_of_feet_is_answered_by_what_the_face_has_of_it() {
    let cylinder = known::cylinder([0.0, 4.0]);
    let surface = cylinder.surface().clone();
    for (u, inside) in [([1.2, 2.9], true), ([0.0, 4.0], true)] {
        let sides = [
            Pcurve::isoline(Direction::V, 0.2, u[0], u[1]).unwrap(),
            Pcurve::isoline(Direction::U, u[1], 0.2, 0.8).unwrap(),
            Pcurve::isoline(Direction::V, 0.8, u[1], u[0]).unwrap(),
            Pcurve::isoline(Direction::U, u[0], 0.8, 0.2).unwrap(),
        ];
        let face = face_of(surface.clone(), vec![Loop::outer(sides.map(coedge).into())]);
        let (foot, _) = ask(&face, [0.0, 0.0, 0.1]);
        assert!((foot.distance - 1.0).abs() < 1e-12 && foot.flags & flag::NOT_PROVEN == 0);
        assert_eq!(
            face.region().side([foot.u, foot.v], &mut Halving::default()) != Side::Outside,
            inside
        );
        // Beyond the end the nearest is a whole circle of the border.
        let (foot, place) = ask(&face, [0.0, 0.0, 0.9]);
        assert!((foot.distance - (1.0f64 + 0.09).sqrt()).abs() < 1e-12);
        assert_eq!((place.standing, foot.flags & flag::NOT_PROVEN), (Standing::OnEdge, 0));
    }
}

#[test]
fn sides_agree_with_a_fine_polygon_and_edges_with_their_distance() {
    for seed in 1..=8 {
        let face = random_face(seed);
        let surface = face.support().clone();
        let mut r = Random(seed);
        let _ = (0..25).map(|_| r.between(-1.5, 1.5)).count();
        let mut workspace = FaceWorkspace::default();
        let options = QueryOptions { tolerance: 1e-3, ..QueryOptions::default() };
        for _ in 0..60 {
            let at = [r.between(0.0, 1.0), r.between(0.0, 1.0)];
            let place = face.classify(at, &options, &mut workspace);
            let point = surface.evaluate(at);
            let side = face.region().side(at, &mut Halving::default());
            match place.standing {
                Standing::Inside => assert_eq!(side, Side::Inside),
                Standing::Outside => assert_eq!(side, Side::Outside),
                Standing::OnEdge => assert!(edge_distance(&face, point) <= 1e-3 * (1.0 + 1e-4)),
                Standing::Unknown => panic!("{at:?}"),
            }
            if place.standing != Standing::OnEdge {
                assert!(edge_distance(&face, point) > 1e-3 * (1.0 - 1e-4));
            }
        }
    }
}

/// Distance to the loops by sampling and a parabola.
fn edge_distance(face: &Face, point: Vector) -> f64 {
    let surface = face.support();
    let mut best = f64::INFINITY;
    for curve in face.pcurves() {
        let (a, b) = curve.domain();
        let at = |k: f64| {
            let [u, v, _] = curve.evaluate((a + (b - a) * k / 1500.0).clamp(a, b));
            norm(sub(surface.evaluate([u, v]), point))
        };
        let nearest = (0..=1500).map(f64::from).min_by(|i, j| at(*i).total_cmp(&at(*j))).unwrap();
        for k in -100..=100 {
            best = best.min(at((nearest + f64::from(k) / 100.0).clamp(0.0, 1500.0)));
        }
    }
    best
}

#[test]
fn the_whole_of_a_sphere_has_its_seam_and_its_poles_as_edges() {
    let sphere = known::sphere([0.0, 4.0]);
    let support = Support::Spline(Arc::new(IndexedSurface::new(sphere.surface().clone())));
    let trimmed = TrimmedSurface::whole(support).unwrap();
    let face = Face::new(&trimmed, 0, &mut |_| false).unwrap();
    let mut workspace = FaceWorkspace::default();
    let mut classify =
        |u: f64, v: f64| face.classify([u, v], &QueryOptions::default(), &mut workspace).standing;
    assert_eq!(classify(1.3, 0.7), Standing::Inside);
    assert_eq!(classify(0.0, 0.7), Standing::OnEdge);
    assert_eq!(classify(4.0, 0.7), Standing::OnEdge);
    assert_eq!(classify(1.3, 2.0), Standing::OnEdge);
    assert_eq!(classify(1.3, 2.5), Standing::Outside);
    let (foot, place) = ask(&face, [0.3, 0.4, 0.5]);
    assert!((foot.distance - (1.0 - 0.5f64.sqrt())).abs() < 1e-12);
    assert_eq!((place.standing, foot.flags & flag::NOT_PROVEN), (Standing::Inside, 0));
}

#[test]
fn preimages_of_a_self_crossing_surface_are_those_of_the_face() {
    // A band that crosses itself: the crossing line has two parameters, one of them cut away.
    let poles: Vec<Vector> = [[-1., 0.], [3., 2.], [-3., 2.], [1., 0.]]
        .iter()
        .flat_map(|[x, z]| [[*x, -1.0, *z], [*x, 1.0, *z]])
        .collect();
    let (u, v) = ([0., 0., 0., 0., 1., 1., 1., 1.], [0., 0., 1., 1.]);
    let surface = Surface::new(&u, &v, 3, 1, &poles, 4, 2, None).unwrap();
    let indexed = IndexedSurface::new(surface.clone());
    let at_crossing = (0..100_000)
        .map(|k| f64::from(k) / 200_000.0)
        .min_by(|a, b| {
            let x = |u: f64| surface.evaluate(u, 0.5)[0].abs();
            x(*a).total_cmp(&x(*b))
        })
        .unwrap();
    let point = surface.evaluate(at_crossing, 0.5);
    let all = indexed.preimage(point, 1e-3, &QueryOptions::default(), &mut || false).unwrap();
    assert_eq!(all.members.len(), 2);
    let sides = [
        Pcurve::isoline(Direction::V, 0.0, 0.0, 0.5).unwrap(),
        Pcurve::isoline(Direction::U, 0.5, 0.0, 1.0).unwrap(),
        Pcurve::isoline(Direction::V, 1.0, 0.5, 0.0).unwrap(),
        Pcurve::isoline(Direction::U, 0.0, 1.0, 0.0).unwrap(),
    ];
    let face = face_of(surface, vec![Loop::outer(sides.map(coedge).into())]);
    let of_face = face.preimage(point, 1e-3, &QueryOptions::default(), &mut || false).unwrap();
    assert_eq!((of_face.members.len(), of_face.is_complete()), (1, true));
    assert_eq!(of_face.members[0].kind, Kind::Point);
    assert!(of_face.members[0].foot.u < 0.5);
}

#[test]
fn an_arc_and_its_polygon_agree_away_from_the_border() {
    let circle = Pcurve::arc([0.5, 0.4], [0.3, 0.0], [0.0, 0.3], [0.0, std::f64::consts::TAU]);
    let circle = circle.unwrap().as_spline().unwrap();
    let region = Region::new([[&circle]]).unwrap();
    let mut memory = Halving::default();
    let mut r = Random(7);
    for _ in 0..20_000 {
        let at = [r.between(0.0, 1.0), r.between(0.0, 1.0)];
        let radius = (at[0] - 0.5).hypot(at[1] - 0.4);
        if (radius - 0.3).abs() > 1e-13 {
            let expected = if radius < 0.3 { Side::Inside } else { Side::Outside };
            assert_eq!(region.side(at, &mut memory), expected);
        }
    }
    // Beside the border at every scale.
    for k in 0..1000 {
        let angle = r.between(0.0, std::f64::consts::TAU);
        let off = 10f64.powf(-3.0 - 9.0 * f64::from(k) / 1000.0);
        for (radius, expected) in [(0.3 - off, Side::Inside), (0.3 + off, Side::Outside)] {
            let at = [0.5 + radius * angle.cos(), 0.4 + radius * angle.sin()];
            assert_eq!(region.side(at, &mut memory), expected, "{off}");
        }
    }
}

#[test]
fn what_is_no_query_is_marked() {
    let face = random_face(3);
    let (foot, place) = ask(&face, [f64::NAN, 0.0, 0.0]);
    assert!(foot.flags & flag::BAD_QUERY != 0);
    assert_eq!(place.standing, Standing::Unknown);
    let mut workspace = FaceWorkspace::default();
    let place = face.classify([f64::INFINITY, 0.5], &QueryOptions::default(), &mut workspace);
    assert_eq!(place.standing, Standing::Unknown);
}
