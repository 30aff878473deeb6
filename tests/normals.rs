//! Normals, sides, tangents and uncertainties on shapes with known answers, and on all cases.

#[path = "cases/mod.rs"]
mod cases;
mod known_shapes;

use footpoint::closest::{FootPoint, QueryOptions, Workspace, flag as foot_flag};
use footpoint::curve::Curve;
use footpoint::index::{IndexedCurve, IndexedSurface};
use footpoint::knots::Side;
use footpoint::normal::{Facing, Normals, Tangents, flag, of_curve, of_surface};
use footpoint::surface::Surface;
use known_shapes::*;

const POINTS: usize = 10_000;

fn nearest(surface: &IndexedSurface, query: Vector) -> FootPoint {
    surface.closest(query, None, &QueryOptions::default(), &mut Workspace::default(), None)
}

fn facing(surface: &IndexedSurface, query: Vector) -> (FootPoint, Facing) {
    let foot = nearest(surface, query);
    (foot, Normals::new(surface.surface()).at(&foot, Some(query)))
}

fn place(u: f64, v: f64) -> FootPoint {
    FootPoint { u, v, ..FootPoint::unreached() }
}

/// Signed distances of many random points against a formula; points too near to the surface for a side are left out.
fn check_sides(surface: &IndexedSurface, reach: f64, truth: impl Fn(Vector) -> f64) {
    let (normals, mut random) = (Normals::new(surface.surface()), Random(7));
    let mut workspace = Workspace::default();
    for _ in 0..POINTS {
        let query = random.point(reach);
        let (expected, options) = (truth(query), QueryOptions::default());
        let foot = surface.closest(query, None, &options, &mut workspace, None);
        let facing = normals.at(&foot, Some(query));
        if expected.abs() > 1e-9 {
            assert!(
                (facing.signed - expected).abs() < 1e-8,
                "{query:?} {expected} {facing:?} {foot:?}"
            );
            assert_eq!(facing.flags & flag::AMBIGUOUS_SIDE, 0, "{query:?} {facing:?} {foot:?}");
        }
        assert!((norm(facing.normal) - 1.0).abs() < 1e-14, "{query:?} {facing:?}");
    }
}

#[test]
fn spheres_tori_and_prisms_have_the_signed_distances_of_their_solids() {
    check_sides(&sphere([0.0, 4.0]), 2.0, |p| norm(p) - 1.0);
    check_sides(&torus(), 3.0, |p| (p[0].hypot(p[1]) - 2.0).hypot(p[2]) - 0.5);
    let square = [[-1., -1.], [1., -1.], [1., 1.], [-1., 1.]];
    check_sides(&prism(&square, [0.0; 2], 1.0), 2.5, |p| prism_distance(&square, 1.0, p));
    let angle = [[0., 0.], [2., 0.], [2., 1.], [1., 1.], [1., 2.], [0., 2.]];
    check_sides(&prism(&angle, [0.5; 2], 1.0), 3.0, |p| prism_distance(&angle, 1.0, p));
    // Acute corners, a reflex one between them.
    let arrow = [[0., 0.], [3., 0.2], [0.7, 0.5], [0.1, 2.0]];
    check_sides(&prism(&arrow, [0.4, 0.3], 0.4), 3.0, |p| prism_distance(&arrow, 0.4, p));
}

#[test]
fn turned_polygons_have_the_signed_distances_of_their_solids() {
    for meridian in [
        &[[0., -1.], [1., -1.], [1., 1.], [0., 1.]][..],
        // A cone on a disc, a double cone, a goblet with a dent at its top, a thin needle.
        &[[0., -1.], [1., -1.], [0., 1.]],
        &[[0., -2.], [1., 0.], [0., 0.3]],
        &[[0., -1.], [1., -1.], [1., 1.], [0., 0.]],
        &[[0., -1.], [0.05, -1.], [0., 1.]],
    ] {
        check_sides(&turned_polygon(meridian), 2.0, |p| turned_distance(meridian, p));
    }
}

/// Distance to a triangle, by its plane and its edges.
fn triangle_distance([a, b, c]: [Vector; 3], p: Vector) -> f64 {
    let edge = |a: Vector, b: Vector| {
        let (e, w) = (sub(b, a), sub(p, a));
        let share = (dot(e, w) / dot(e, e)).clamp(0.0, 1.0);
        norm([0, 1, 2].map(|k| w[k] - share * e[k]))
    };
    let (ab, ac, w) = (sub(b, a), sub(c, a), sub(p, a));
    let (m, k, n) = (dot(ab, ab), dot(ab, ac), dot(ac, ac));
    let (x, y, det) = (dot(ab, w), dot(ac, w), m * n - k * k);
    let (s, t) = ((n * x - k * y) / det, (m * y - k * x) / det);
    if s >= 0.0 && t >= 0.0 && s + t <= 1.0 {
        return norm([0, 1, 2].map(|i| w[i] - s * ab[i] - t * ac[i]));
    }
    edge(a, b).min(edge(b, c)).min(edge(c, a))
}

#[test]
fn thin_tetrahedra_have_the_right_sides_at_acute_edges_and_corners() {
    for corners in [
        [[0., 0., 0.], [1., 0., 0.], [0.5, 0.2, 0.], [0.6, 0.05, 0.4]],
        [[0., 0., 0.], [2., 0., 0.], [0., 2., 0.], [1.9, 0.05, 0.1]],
        [[0., 0., 0.], [1., 0., 0.], [0., 1., 0.], [-1.5, -1.5, 0.2]],
    ] {
        let [a, b, c, top]: [Vector; 4] = corners;
        let center = [0, 1, 2].map(|k| (a[k] + b[k] + c[k]) / 3.0);
        let solid = polyhedron(&[vec![center; 3], vec![a, b, c], vec![top; 3]]);
        let faces = [[a, c, b], [a, b, top], [b, c, top], [c, a, top]];
        let truth = |p: Vector| {
            let near = faces.iter().map(|f| triangle_distance(*f, p)).fold(f64::INFINITY, f64::min);
            let behind = faces.iter().all(|[a, b, c]| {
                let (e, f, w) = (sub(*b, *a), sub(*c, *a), sub(p, *a));
                let n = [
                    e[1] * f[2] - e[2] * f[1],
                    e[2] * f[0] - e[0] * f[2],
                    e[0] * f[1] - e[1] * f[0],
                ];
                dot(n, w) < 0.0
            });
            if behind { -near } else { near }
        };
        check_sides(&solid, 2.0, truth);
    }
}

/// An arc of the meridian from `a` to `b` about `center`: its middle pole and weight.
fn arc(center: [f64; 2], a: [f64; 2], b: [f64; 2]) -> (f64, f64, f64) {
    let (p, q) = ([a[0] - center[0], a[1] - center[1]], [b[0] - center[0], b[1] - center[1]]);
    let square = p[0] * p[0] + p[1] * p[1];
    let cos = (p[0] * q[0] + p[1] * q[1]) / square;
    let share = 1.0 / (1.0 + cos);
    let middle = [0, 1].map(|k| center[k] + share * (p[k] + q[k]));
    (middle[0], middle[1], ((1.0 + cos) / 2.0).sqrt())
}

/// Signs of many random points against a predicate; the distances are those of the feet.
fn check_signs(surface: &IndexedSurface, reach: f64, inside: impl Fn(Vector) -> bool) {
    let (normals, mut random, mut counts) = (Normals::new(surface.surface()), Random(9), [0; 2]);
    for _ in 0..POINTS {
        let query = random.point(reach);
        let foot = nearest(surface, query);
        let facing = normals.at(&foot, Some(query));
        counts[usize::from(inside(query))] += 1;
        if foot.distance > 1e-9 {
            assert_eq!(facing.signed < 0.0, inside(query), "{query:?} {facing:?} {foot:?}");
            assert_eq!(facing.flags & flag::AMBIGUOUS_SIDE, 0, "{query:?} {facing:?} {foot:?}");
        }
    }
    assert!(counts[0] > 10 && counts[1] > 10, "{counts:?}");
}

#[test]
fn curved_solids_with_rims_and_thorns_have_the_right_sides() {
    const TWO: [f64; 8] = [0., 0., 0., 1., 1., 2., 2., 2.];
    // A lens: two balls of radius 1 about (0, 0, +-0.8).
    let (low, rim, high) = ([0., -0.2], [0.6, 0.], [0., 0.2]);
    let (one, two) = (arc([0., 0.8], low, rim), arc([0., -0.8], rim, high));
    let corner = |p: [f64; 2]| (p[0], p[1], 1.0);
    let lens = turned([0., 4.], &TWO, 2, &[corner(low), one, corner(rim), two, corner(high)]);
    check_signs(&lens, 0.7, |p| [0.8, -0.8].iter().all(|z| norm(sub(p, [0., 0., *z])) < 1.0));
    // A lemon: the arc of radius 1 about (-0.8, 0) turned; curved cones at both ends.
    let (low, high) = ([0., -0.6], [0., 0.6]);
    let knots = [0., 0., 0., 1., 1., 1.];
    let lemon =
        turned([0., 4.], &knots, 2, &[corner(low), arc([-0.8, 0.], low, high), corner(high)]);
    check_signs(&lemon, 0.8, |p| (p[0].hypot(p[1]) + 0.8).hypot(p[2]) < 1.0);
    // An apple: the same arc from the other side, dented at both ends.
    let (bottom, side, top) = ([0., -0.6], [1.8, 0.], [0., 0.6]);
    let (one, two) = (arc([0.8, 0.], bottom, [0.8, -1.]), arc([0.8, 0.], [0.8, -1.], side));
    let (three, four) = (arc([0.8, 0.], side, [0.8, 1.]), arc([0.8, 0.], [0.8, 1.], top));
    let apple = turned(
        [0., 4.],
        &[0., 0., 0., 1., 1., 2., 2., 3., 3., 4., 4., 4.],
        2,
        &[
            corner(bottom),
            one,
            corner([0.8, -1.]),
            two,
            corner(side),
            three,
            corner([0.8, 1.]),
            four,
            corner(top),
        ],
    );
    check_signs(&apple, 2.0, |p| (p[0].hypot(p[1]) - 0.8).hypot(p[2]) < 1.0);
    // A thorn on a disc: r = (1 - z)^2; its tip has no angle.
    let thorn = turned(
        [0., 4.],
        &TWO,
        2,
        &[(0., 0., 1.), (0.5, 0., 1.), (1., 0., 1.), (0., 0.5, 1.), (0., 1., 1.)],
    );
    check_signs(&thorn, 1.2, |p| {
        let r = p[0].hypot(p[1]);
        p[2] > 0.0 && p[2] < 1.0 && r < (1.0 - p[2]) * (1.0 - p[2])
    });
    let (_, tip) = facing(&thorn, [0.2, 0.1, 1.5]);
    assert_eq!(tip.flags, flag::CREASE | flag::LIMIT);
    assert!(norm(sub(tip.normal, [0., 0., 1.])) < 1e-9 && tip.signed > 0.5, "{tip:?}");
}

#[test]
fn small_far_and_turned_solids_have_their_sides() {
    let angle = [[0., 0.], [2., 0.], [2., 1.], [1., 1.], [1., 2.], [0., 2.]];
    for (size, offset) in [(1e-6, 0.0), (1e6, 1e3), (1.0, 1e6), (1e-3, -50.0)] {
        // Turned by a rotation that is exact: (x, y, z) -> (2x - y + 2z, 2x + 2y - z, -x + 2y + 2z) / 3.
        let there = |p: Vector| {
            let [x, y, z] = p;
            [2. * x - y + 2. * z, 2. * x + 2. * y - z, -x + 2. * y + 2. * z]
                .map(|x| offset + size * x / 3.0)
        };
        let row = |z: f64| angle.iter().map(|[x, y]| there([*x, *y, z])).collect::<Vec<_>>();
        let tip = |z: f64| vec![there([0.5, 0.5, z]); angle.len()];
        let solid = polyhedron(&[tip(0.0), row(0.0), row(1.0), tip(1.0)]);
        let (normals, mut random) = (Normals::new(solid.surface()), Random(21));
        for _ in 0..2000 {
            let p = random.point(3.0);
            let truth = prism_distance(&angle, 1.0, p);
            let query = there(p);
            let foot = nearest(&solid, query);
            let facing = normals.at(&foot, Some(query));
            let grain = 1e-9 * size + 4e-15 * offset.abs();
            if truth.abs() * size > 16.0 * grain {
                assert!(
                    (facing.signed - truth * size).abs() < 4.0 * grain,
                    "{size} {p:?} {truth} {facing:?} {foot:?}"
                );
                assert_eq!(facing.flags & flag::AMBIGUOUS_SIDE, 0, "{size} {p:?} {facing:?}");
            }
        }
    }
}

#[test]
fn poles_seams_and_tips_have_the_normals_of_the_shape() {
    let ball = sphere([-3.0, 2.0]);
    for (query, expected) in [([0., 0., 3.], [0., 0., 1.]), ([0., 0., -0.5], [0., 0., -1.])] {
        let (foot, facing) = facing(&ball, query);
        assert!(foot.flags & foot_flag::COLLAPSED != 0);
        assert_eq!(facing.flags, flag::LIMIT);
        assert!(norm(sub(facing.normal, expected)) < 1e-15, "{facing:?}");
        assert!((facing.signed - (norm(query) - 1.0)).abs() < 1e-15);
    }
    let (foot, seam) = facing(&ball, [0.5, 0., 0.]);
    assert!(foot.flags & foot_flag::SEAM != 0 && seam.flags == 0);
    assert!(norm(sub(seam.normal, [1., 0., 0.])) < 1e-15 && (seam.signed + 0.5).abs() < 1e-15);
    // The tip of a cone: many normals, their mean is the axis, and the side is known.
    let cone = turned_polygon(&[[1., 0.], [0., 1.]]);
    let (_, tip) = facing(&cone, [0.1, 0.2, 3.0]);
    assert_eq!(tip.flags, flag::CREASE | flag::LIMIT);
    assert!(norm(sub(tip.normal, [0., 0., 1.])) < 1e-12 && tip.signed > 2.0, "{tip:?}");
}

#[test]
fn what_has_no_side_says_so() {
    let tube = cylinder([0.0, 4.0]);
    let flags = |query| facing(&tube, query).1.flags;
    assert_eq!(flags([0.5, 0.2, 0.3]), 0);
    // Beyond the border, on the surface, and on the axis (a tie of a surface with borders).
    assert_eq!(flags([0.5, 0.2, 3.0]), flag::AMBIGUOUS_SIDE);
    assert_eq!(flags([1.0, 0.0, 0.5]) & flag::AMBIGUOUS_SIDE, flag::AMBIGUOUS_SIDE);
    assert_eq!(flags([0.0, 0.0, 0.0]) & flag::AMBIGUOUS_SIDE, flag::AMBIGUOUS_SIDE);
    let unreached = Normals::new(tube.surface()).at(&FootPoint::unreached(), Some([0.0; 3]));
    assert_eq!(unreached.flags, flag::UNDEFINED | flag::AMBIGUOUS_SIDE);
    assert!(unreached.normal[0].is_nan() && unreached.signed.is_nan());
    let bad = Normals::new(tube.surface()).at(&place(1.0, 0.5), Some([f64::NAN; 3]));
    assert!(bad.flags == flag::AMBIGUOUS_SIDE && bad.signed.is_nan() && norm(bad.normal) > 0.9);
    // All points of a sphere are equally near to its centre, and all agree that it is inside.
    let (_, center) = facing(&sphere([0.0, 4.0]), [0.0; 3]);
    assert_eq!((center.flags & flag::AMBIGUOUS_SIDE, center.signed < 0.0), (0, true));
}

#[test]
fn a_cuspidal_edge_is_a_fold_and_has_a_normal() {
    // (u, t^2, t^3) for t = -1 .. 1.
    let cubic = [[1., -1.], [-1. / 3., 1.], [-1. / 3., -1.], [1., 1.]];
    let poles: Vec<Vector> =
        [0.0, 1.0].iter().flat_map(|u| cubic.map(|[y, z]| [*u, y, z])).collect();
    let knots_v = [-1., -1., -1., -1., 1., 1., 1., 1.];
    let made = Surface::new(&[0., 0., 1., 1.], &knots_v, 1, 3, &poles, 2, 4, None).unwrap();
    let facing = Normals::new(&made).at(&place(0.5, 0.0), None);
    assert_eq!(facing.flags, flag::LIMIT | flag::CREASE);
    assert!((facing.normal[2].abs() - 1.0).abs() < 1e-9, "{facing:?}");
    let folded = FootPoint { point: made.evaluate(0.5, 0.0), ..place(0.5, 0.0) };
    let facing = Normals::new(&made).at(&folded, Some([0.5, -1.0, 0.1]));
    assert!(facing.flags & flag::AMBIGUOUS_SIDE != 0);
}

/// A single foot off the borders.
fn is_inside(foot: &FootPoint) -> bool {
    foot.flags & (foot_flag::EDGE | foot_flag::TIE | foot_flag::NOT_PROVEN) == 0
}

#[test]
fn normals_at_all_cases_are_unit_vectors_or_said_to_be_none() {
    let (mut asked, mut undefined, mut ambiguous, mut lost) = (0, 0, 0, 0);
    for folder in cases::folders() {
        let case = cases::read(&folder);
        let cases::Shape::Surface(shape) = &case.shape else { continue };
        let (normals, mut workspace) = (Normals::new(shape.surface()), Workspace::default());
        for class in ["edge", "seam", "pole", "sing", "near", "off", "medial", "on"] {
            for row in case.rows.iter().filter(|row| row.class == class).take(30) {
                let options = QueryOptions::default();
                let foot = shape.closest(row.query, None, &options, &mut workspace, None);
                let facing = normals.at(&foot, Some(row.query));
                let none = facing.flags & flag::UNDEFINED != 0;
                asked += 1;
                undefined += usize::from(none);
                ambiguous += usize::from(facing.flags & flag::AMBIGUOUS_SIDE != 0);
                assert_eq!(none, facing.normal[0].is_nan(), "{} {facing:?}", case.name);
                assert!(
                    none || (norm(facing.normal) - 1.0).abs() < 1e-14,
                    "{} {facing:?}",
                    case.name
                );
                assert_eq!(facing.signed.abs(), foot.distance, "{} {facing:?}", case.name);
                let far = row.distance > 1e-9 * (case.diagonal + case.magnitude);
                lost += usize::from(
                    class == "near"
                        && far
                        && is_inside(&foot)
                        && facing.flags & flag::AMBIGUOUS_SIDE != 0,
                );
            }
        }
    }
    println!(
        "{asked} normals, {undefined} undefined, {ambiguous} ambiguous sides, {lost} of them near the inside"
    );
    assert!(asked > 1000 && undefined * 100 < asked && lost == 0);
}

#[test]
fn one_sided_derivatives_differ_at_knots_only() {
    let corner = [[0., 0., 0.], [1., 0., 0.], [1., 2., 0.]];
    let curve = Curve::new(&[0., 0., 1., 2., 2.], 1, &corner, None).unwrap();
    let on = |u: f64, side: Side| {
        let mut out = [[0.0; 3]; 2];
        curve.derivatives_on(u, side, 1, &mut out);
        out[1]
    };
    assert_eq!((on(1.0, Side::Below), on(1.0, Side::Above)), ([1., 0., 0.], [0., 2., 0.]));
    assert_eq!((on(0.0, Side::Below), on(2.0, Side::Above)), ([1., 0., 0.], [0., 2., 0.]));
    assert_eq!(on(0.5, Side::Below), on(0.5, Side::Above));
    let roof = prism(&[[-1., -1.], [1., -1.], [1., 1.], [-1., 1.]], [0.0; 2], 1.0);
    let mut out = [[[0.0; 3]; 3]; 2];
    for (side, out) in [Side::Below, Side::Above].into_iter().zip(&mut out) {
        roof.surface().partials_on([1.0, 1.5], [side, Side::Above], 1, out);
    }
    assert_eq!((out[0][1], out[1][1]), ([2., 0., 0.], [0., 2., 0.]));
}

#[test]
fn tangents_of_a_circle_are_perpendicular_to_the_radius_on_its_seam_too() {
    let ring = circle(2.0, 4.0, 1.0);
    let tangents = Tangents::new(ring.curve());
    for k in 0..=100 {
        let u = (2.0 + 0.04 * f64::from(k)).min(6.0);
        let (tangent, flags) = tangents.at(u);
        let p = ring.curve().evaluate(u);
        assert_eq!(flags, 0);
        assert!(norm(sub(tangent, [-p[1], p[0], 0.0])) < 1e-13, "{u} {tangent:?}");
    }
}

/// The answer `found` at a place: the boundary of the rectangle of twice the extents is out of reach, and half the
/// extents are reached.
fn check_extents(surface: &Surface, closed: [bool; 2], at: [f64; 2], accuracy: f64, name: &str) {
    let found = of_surface(surface, closed, &place(at[0], at[1]), accuracy);
    let [u0, u1, v0, v1] = surface.domain();
    let (ends, home) = ([[u0, u1], [v0, v1]], surface.evaluate(at[0], at[1]));
    let moved = |k: usize, step: f64| {
        let ([low, high], x) = (ends[k], at[k] + step);
        let wrapped = if !closed[k] {
            if x < low || x > high { return None } else { x }
        } else if x > high {
            x - (high - low)
        } else if x < low {
            x + (high - low)
        } else {
            x
        };
        Some(wrapped.clamp(low, high))
    };
    let far =
        |du: f64, dv: f64| Some(norm(sub(surface.evaluate(moved(0, du)?, moved(1, dv)?), home)));
    let room = |k: usize| {
        let [low, high] = ends[k];
        if closed[k] { high - low } else { (at[k] - low).max(high - at[k]) }
    };
    const N: i32 = 30;
    let mut most = [0.0f64; 2];
    for i in -N..=N {
        for j in -N..=N {
            let d = [
                f64::from(i) / f64::from(N) * 2.0 * found[0],
                f64::from(j) / f64::from(N) * 2.0 * found[1],
            ];
            let Some(far) = far(d[0], d[1]) else { continue };
            if far <= accuracy {
                most = [most[0].max(d[0].abs()), most[1].max(d[1].abs())];
                for k in 0..2 {
                    let at_rim = [i, j][k].abs() == N && found[k] < 0.5 * room(k);
                    assert!(!at_rim, "{name} {at:?} {accuracy}: {found:?} is too small");
                }
            }
        }
    }
    for k in 0..2 {
        let reached = most[k] >= 0.45 * found[k];
        assert!(reached, "{name} {at:?} {accuracy}: {found:?} is too large, {most:?}");
    }
}

#[test]
fn uncertainties_are_right_within_a_factor_of_two() {
    let ball = sphere([0.0, 4.0]);
    for v in [1.0, 1.9, 1.99, 1.999, 1.9999, 1.99999, 2.0] {
        for u in [0.0, 0.3, 1.0, 3.999] {
            for accuracy in [1e-3, 1e-6] {
                check_extents(ball.surface(), [true, false], [u, v], accuracy, "sphere");
            }
        }
    }
    assert_eq!(of_surface(ball.surface(), [true, false], &place(1.3, 2.0), 1e-9)[0], 4.0);
    let square = [[-1., -1.], [1., -1.], [1., 1.], [-1., 1.]];
    let cube = prism(&square, [0.0; 2], 1.0);
    for at in [[0.0, 1.5], [1.0, 1.0], [1.0, 2.0], [0.5, 1.0], [2.5, 2.5], [2.5, 3.0]] {
        check_extents(cube.surface(), [true, false], at, 1e-5, "cube");
    }
    for name in [
        "syn_s_cuspidal_edge",
        "syn_s_whitney",
        "syn_s_su_zero_edge",
        "syn_s_aspect_1e5",
        "syn_s_torus",
        "syn_s_disc_4corners",
        "syn_s_hourglass",
    ] {
        let folder = cases::folders().into_iter().find(|folder| folder.ends_with(name)).unwrap();
        let case = cases::read(&folder);
        let cases::Shape::Surface(shape) = &case.shape else { panic!("{name}") };
        let surface = shape.surface();
        let closed = [surface.is_closed_u(), surface.is_closed_v()];
        for row in case.rows.iter().step_by(case.rows.len().div_ceil(20)) {
            let foot = nearest(shape, row.query);
            for accuracy in [1e-4, 1e-8] {
                check_extents(surface, closed, [foot.u, foot.v], accuracy * case.diagonal, name);
            }
        }
    }
}

#[test]
fn uncertainties_of_curves_agree_with_samples() {
    for name in
        ["syn_c_cusp_t2t3", "syn_c_cusp_t3t4", "syn_c_rose", "syn_c_zero_spans", "syn_c_near_cusp"]
    {
        let folder = cases::folders().into_iter().find(|folder| folder.ends_with(name)).unwrap();
        let case = cases::read(&folder);
        let cases::Shape::Curve(shape) = &case.shape else { panic!("{name}") };
        let (curve, (low, high)) = (shape.curve(), shape.curve().domain());
        for row in case.rows.iter().step_by(5) {
            let options = QueryOptions::default();
            let foot = shape.closest(row.query, None, &options, &mut Workspace::default(), None);
            for share in [1e-3, 1e-6, 1e-9] {
                let accuracy = share * case.diagonal;
                let found = of_curve(curve, curve.is_closed(), &foot, accuracy);
                let far = |step: f64| {
                    let (length, mut u) = (high - low, foot.u + step);
                    if curve.is_closed() {
                        u = if u > high {
                            u - length
                        } else if u < low {
                            u + length
                        } else {
                            u
                        };
                    }
                    let inside = (low..=high).contains(&u);
                    if inside { norm(sub(curve.evaluate(u), foot.point)) } else { f64::INFINITY }
                };
                if found < 16.0 * f64::EPSILON * high.abs().max(low.abs()) {
                    continue;
                }
                let (mut most, count) = (0.0, 4000);
                for way in [-1.0, 1.0] {
                    for k in 1..=count {
                        let step = 3.0 * found * f64::from(k) / f64::from(count);
                        if far(way * step) > accuracy {
                            break;
                        }
                        most = step.max(most);
                    }
                }
                assert!(
                    most <= 2.0 * found && most >= 0.49 * found,
                    "{name} {foot:?} {share}: {found} {most}"
                );
            }
        }
    }
}

#[test]
fn many_feet_or_one_the_numbers_are_the_same() {
    let shape: IndexedCurve = figure_eight(24);
    let tangents = Tangents::new(shape.curve());
    assert_eq!(tangents.at(5.5), tangents.clone().at(5.5));
    let ball = sphere([0.0, 4.0]);
    let (a, b) = (Normals::new(ball.surface()), Normals::new(ball.surface()));
    for u in [0.0, 0.4, 3.9] {
        let foot = nearest(&ball, [0.4 + u, 0.2, 0.6]);
        assert_eq!(a.at(&foot, Some([1.0; 3])), b.at(&foot, Some([1.0; 3])));
    }
}
