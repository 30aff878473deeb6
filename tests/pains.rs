//! What users of other libraries suffer from, each one a test by name, and the flags of special feet.

mod shapes;

use footpoint::closest::{FootPoint, QueryOptions, Scope, Workspace, flag};
use footpoint::curve::Curve;
use footpoint::index::{IndexedCurve, IndexedSurface};
use footpoint::surface::Surface;
use shapes::asked::bits;
use shapes::{Random, Vector, along, cross, norm, sub};

const HALF: f64 = std::f64::consts::FRAC_1_SQRT_2;

fn on_curve(curve: &IndexedCurve, query: Vector) -> FootPoint {
    curve.closest(query, None, &QueryOptions::default(), &mut Workspace::default(), None)
}

fn on_surface(surface: &IndexedSurface, query: Vector) -> FootPoint {
    surface.closest(query, None, &QueryOptions::default(), &mut Workspace::default(), None)
}

fn curve(knots: &[f64], degree: usize, poles: &[Vector], weights: Option<&[f64]>) -> IndexedCurve {
    IndexedCurve::new(Curve::new(knots, degree, poles, weights).expect("a curve"))
}

/// A full ellipse of quadrants with the half axes a and b, over the domain [5, 9].
fn ellipse(a: f64, b: f64) -> IndexedCurve {
    let ring = [
        [1., 0.],
        [1., 1.],
        [0., 1.],
        [-1., 1.],
        [-1., 0.],
        [-1., -1.],
        [0., -1.],
        [1., -1.],
        [1., 0.],
    ];
    let poles = ring.map(|[x, y]| [a * x, b * y, 0.]);
    let weights = [1., HALF, 1., HALF, 1., HALF, 1., HALF, 1.];
    curve(&[5., 5., 5., 6., 6., 7., 7., 8., 8., 9., 9., 9.], 2, &poles, Some(&weights))
}

/// A meridian (radius, height, weight) turned about the z axis.
fn turned(knots_v: &[f64], degree_v: usize, meridian: &[[f64; 3]]) -> IndexedSurface {
    let ring = ellipse(1.0, 1.0);
    let (mut poles, mut weights) = (Vec::new(), Vec::new());
    for (p, w) in ring.curve().poles().iter().zip(ring.curve().weights().expect("weights")) {
        for [radius, z, weight] in meridian {
            poles.push([radius * p[0], radius * p[1], *z]);
            weights.push(w * weight);
        }
    }
    let (knots, count) = (ring.curve().knots().values(), meridian.len());
    let surface = Surface::new(knots, knots_v, 2, degree_v, &poles, 9, count, Some(&weights));
    IndexedSurface::new(surface.expect("a surface"))
}

fn sphere() -> IndexedSurface {
    let half = [[0., -1., 1.], [1., -1., HALF], [1., 0., 1.], [1., 1., HALF], [0., 1., 1.]];
    turned(&[0., 0., 0., 1., 1., 2., 2., 2.], 2, &half)
}

fn cone() -> IndexedSurface {
    turned(&[0., 0., 1., 1.], 1, &[[0., 0., 1.], [2., 2., 1.]])
}

fn wavy() -> IndexedCurve {
    let poles: Vec<Vector> =
        (0..8).map(|i| [f64::from(i), f64::from(i % 2), f64::from(i % 3) * 0.5]).collect();
    curve(&[0., 0., 0., 0., 0.2, 0.4, 0.6, 0.8, 1., 1., 1., 1.], 3, &poles, None)
}

fn has(foot: &FootPoint, bit: u32) -> bool {
    foot.flags & bit != 0
}

/// Pain: a foot at a Bezier junction is lost by half-open root tests.
#[test]
fn a_foot_at_a_junction_of_pieces_is_found() {
    let curve = wavy();
    for u in [0.2, 0.4, 0.6, 0.8] {
        let mut out = [[0.0; 3]; 2];
        curve.curve().derivatives(u, 1, &mut out);
        let side = cross(out[1], [0.3, -0.2, 1.0]);
        let query = along(out[0], side, 0.05 / norm(side));
        let foot = on_curve(&curve, query);
        assert!((foot.u - u).abs() < 1e-13 && (foot.distance - 0.05).abs() < 1e-15, "{foot:?}");
        assert!(!has(&foot, flag::CREASE | flag::NOT_PROVEN));
    }
}

/// Pain: a foot at a curve end or at a parameter above 0.995 is lost.
#[test]
fn a_foot_at_a_curve_end_or_close_to_it_is_found() {
    let curve = wavy();
    for u in [0.0, 1e-9, 1e-4, 0.9951, 0.9999, 1.0 - 1e-9, 1.0] {
        let query = curve.curve().evaluate(u);
        let foot = on_curve(&curve, query);
        assert!((foot.u - u).abs() < 1e-14 && foot.distance < 1e-15, "{u}: {foot:?}");
    }
    let foot = on_curve(&curve, [9., 2., 1.]);
    assert!(foot.u == 1.0 && has(&foot, flag::EDGE) && !has(&foot, flag::NOT_PROVEN));
}

/// Pain: a slightly twisted bilinear patch never converges.
#[test]
fn a_slightly_twisted_bilinear_patch_converges() {
    for twist in [0.3, 1e-3, 1e-6, 1e-9, 1e-12, 1e-15, 0.0] {
        let poles = [[0., 0., 0.], [0., 1., 0.], [1., 0., 0.], [1., 1., twist]];
        let knots = [0., 0., 1., 1.];
        let patch = Surface::new(&knots, &knots, 1, 1, &poles, 2, 2, None).expect("a patch");
        let patch = IndexedSurface::new(patch);
        for (u, v, h) in [(0.3, 0.6, 0.4), (0.9, 0.1, -2.0), (0.5, 0.5, 1e-9), (0.02, 0.98, 30.0)] {
            let mut out = [[0.0; 3]; 3];
            patch.surface().partials(u, v, 1, &mut out);
            let n = cross(out[1], out[2]);
            let query = along(out[0], n, h / norm(n));
            let foot = on_surface(&patch, query);
            assert!(foot.distance <= h.abs() * (1.0 + 1e-15) + 1e-16, "{twist}: {foot:?}");
            assert!(!has(&foot, flag::NOT_PROVEN), "{twist}: {foot:?}");
            // Far away and twisted, another corner may be nearer.
            if h.abs() * twist < 0.1 {
                assert!((foot.u - u).abs() + (foot.v - v).abs() < 1e-12, "{twist}: {foot:?}");
            }
        }
    }
}

/// Pain: a closed direction is wrapped with the wrong sign below the start of the domain.
#[test]
fn on_a_closed_curve_whose_domain_does_not_begin_at_0_parameters_beside_the_seam_stay_in_the_domain()
 {
    let circle = ellipse(1.0, 1.0);
    for k in -20..=20 {
        let angle = f64::from(k) * 1e-3;
        let query = [1.3 * angle.cos(), 1.3 * angle.sin(), 0.2];
        let foot = on_curve(&circle, query);
        // A hint at the start must not keep the foot from going below it, to the end.
        for hint in [5.0, 5.0 + 1e-3, 9.0 - 1e-3, 9.0] {
            let options = QueryOptions::default();
            let hinted =
                circle.closest(query, Some(hint), &options, &mut Workspace::default(), None);
            assert!((hinted.u - foot.u).abs() < 1e-13, "{k} {hint}: {foot:?} {hinted:?}");
        }
        assert!((5.0..=9.0).contains(&foot.u), "{foot:?}");
        let near_start = foot.u < 5.1;
        assert!(if k < 0 { foot.u > 8.9 } else { near_start }, "{k}: {foot:?}");
        assert_eq!(has(&foot, flag::SEAM), k == 0, "{k}: {foot:?}");
        let along_circle = [angle.cos(), angle.sin(), 0.0];
        assert!(norm(sub(foot.point, along_circle)) < 1e-14, "{k}: {foot:?}");
    }
}

/// Pain: distance above zero for touching shapes.
#[test]
fn points_of_a_shape_are_at_distance_zero() {
    let (sphere, r) = (sphere(), &mut Random(3));
    for _ in 0..2000 {
        let (u, v) = (r.between(5.0, 9.0), r.between(0.0, 2.0));
        let foot = on_surface(&sphere, sphere.surface().evaluate(u, v));
        assert!(foot.distance <= 3e-15 && !has(&foot, flag::NOT_PROVEN), "{u} {v}: {foot:?}");
        assert_eq!(foot.point, sphere.surface().evaluate(foot.u, foot.v));
    }
}

/// Pain: the nearest turn of a thread is mixed up.
#[test]
fn the_nearest_turn_of_a_thread_is_not_mixed_up() {
    // Turns 1e-3 apart: a helix interpolated by its cubic net, 40 poles a turn.
    let (turns, per_turn, pitch) = (50, 40, 1e-3);
    let count = turns * per_turn + 3;
    let poles: Vec<Vector> = (0..count)
        .map(|i| {
            let t = i as f64 / per_turn as f64;
            let angle = t * std::f64::consts::TAU;
            [angle.cos(), angle.sin(), pitch * t]
        })
        .collect();
    let knots: Vec<f64> = (0..count + 4).map(|i| i as f64).collect();
    let helix = curve(&knots, 3, &poles, None);
    let (first, last) = helix.curve().domain();
    let r = &mut Random(5);
    for _ in 0..500 {
        let u = r.between(first + 1.0, last - 1.0);
        let mut query = helix.curve().evaluate(u);
        query[2] += 0.4 * pitch * r.between(-1.0, 1.0);
        let foot = on_curve(&helix, query);
        assert!((foot.u - u).abs() < 0.1, "{u}: {foot:?}");
    }
}

/// Pain: near-coincident sheets are mixed up.
#[test]
fn near_coincident_sheets_are_told_apart() {
    // A strip bent back over itself, its halves 1e-6 apart.
    let gap = 1e-6;
    let line = [[0., 0.], [2., 0.], [2., gap], [0., gap]];
    let poles: Vec<Vector> =
        line.iter().flat_map(|[x, z]| [0.0, 1.0].map(|y| [*x, y, *z])).collect();
    let knots = [0., 0., 1., 2., 3., 3.];
    let sheet = Surface::new(&knots, &[0., 0., 1., 1.], 1, 1, &poles, 4, 2, None).expect("a sheet");
    let sheet = IndexedSurface::new(sheet);
    for x in [0.1, 0.7, 1.3, 1.9] {
        for (z, upper) in [(0.2 * gap, false), (0.49 * gap, false), (0.51 * gap, true), (3.0, true)]
        {
            let foot = on_surface(&sheet, [x, 0.5, z]);
            assert_eq!(foot.u > 1.5, upper, "{x} {z}: {foot:?}");
            assert!(!has(&foot, flag::NOT_PROVEN));
        }
    }
}

/// Pain: a foot on a degenerate edge.
#[test]
fn feet_on_collapsed_edges_are_found_and_flagged() {
    let cone = cone();
    for query in [[0., 0., -1.], [0.3, -0.2, -2.], [1e-9, 0., -1e-9], [0.5, 0., -0.6]] {
        let foot = on_surface(&cone, query);
        assert_eq!(foot.point, [0.0; 3], "{foot:?}");
        assert!(has(&foot, flag::COLLAPSED) && has(&foot, flag::EDGE), "{foot:?}");
        assert!(!has(&foot, flag::NOT_PROVEN));
    }
    let sphere = sphere();
    for z in [-3.0, -1.0, -0.2, 0.2, 1.0, 3.0] {
        let foot = on_surface(&sphere, [0., 0., z]);
        assert_eq!(foot.point, [0., 0., z.signum()], "{foot:?}");
        assert!(has(&foot, flag::COLLAPSED) && !has(&foot, flag::NOT_PROVEN), "{foot:?}");
    }
}

/// Pain: the circle's axis, where feet are infinitely many.
#[test]
fn the_axis_of_a_circle_is_proven_and_flagged_as_a_continuum() {
    let circle = ellipse(1.0, 1.0);
    for z in [0.0, 0.5, -2.0] {
        let foot = on_curve(&circle, [0., 0., z]);
        assert!((foot.distance - z.hypot(1.0)).abs() < 1e-15, "{foot:?}");
        assert!(has(&foot, flag::CONTINUUM) && !has(&foot, flag::NOT_PROVEN), "{foot:?}");
    }
    assert!(!has(&on_curve(&circle, [0.3, 0., 0.]), flag::CONTINUUM | flag::TIE));
}

/// Shapes with an axis, places on it and the distance there.
fn on_axes() -> Vec<(IndexedSurface, f64, f64)> {
    let cylinder = || turned(&[0., 0., 1., 1.], 1, &[[1., -1., 1.], [1., 1., 1.]]);
    let mut places = vec![(sphere(), 0.0, 1.0)];
    places.extend([-0.9, -0.3, 0.0, 0.1, 0.5].map(|z| (cylinder(), z, 1.0)));
    places.extend([0.1, 0.5, 1.0, 1.3, 1.9].map(|z| (cone(), z, HALF * z)));
    places
}

/// Pain: the sphere's centre and the axes of surfaces.
#[test]
fn axes_and_centres_of_surfaces_are_proven() {
    for (surface, z, distance) in on_axes() {
        let foot = on_surface(&surface, [0., 0., z]);
        assert!((foot.distance - distance).abs() < 1e-15, "{z}: {foot:?}");
        assert!(!has(&foot, flag::NOT_PROVEN), "{z}: {foot:?}");
    }
}

#[test]
fn axes_and_centres_of_surfaces_are_flagged_as_a_continuum() {
    for (surface, z, _) in on_axes() {
        let foot = on_surface(&surface, [0., 0., z]);
        assert!(has(&foot, flag::CONTINUUM) && has(&foot, flag::TIE), "{z}: {foot:?}");
    }
}

#[test]
fn two_feet_at_the_same_distance_are_a_tie_and_one_is_not() {
    let ellipse = ellipse(2.0, 1.0);
    let foot = on_curve(&ellipse, [0.0; 3]);
    assert!((foot.distance - 1.0).abs() < 1e-15 && has(&foot, flag::TIE), "{foot:?}");
    assert!(!has(&foot, flag::CONTINUUM | flag::NOT_PROVEN), "{foot:?}");
    let foot = on_curve(&ellipse, [0.0, 0.01, 0.0]);
    assert!(!has(&foot, flag::TIE) && foot.point[1] == 1.0, "{foot:?}");
}

#[test]
fn a_tangent_break_is_a_crease_and_a_quadrant_of_a_circle_is_not() {
    let poles = [[0., 0., 0.], [1., 0., 0.], [1., 1., 0.]];
    let corner = curve(&[0., 0., 1., 2., 2.], 1, &poles, None);
    let foot = on_curve(&corner, [1.5, -0.5, 0.2]);
    assert!(foot.u == 1.0 && has(&foot, flag::CREASE), "{foot:?}");
    assert!(!has(&on_curve(&corner, [0.5, 0.3, 0.0]), flag::CREASE));
    let foot = on_curve(&ellipse(1.0, 1.0), [0.0, 1.5, 0.0]);
    assert!(foot.u == 6.0 && !has(&foot, flag::CREASE), "{foot:?}");
}

/// Pain: a tiny trimmed region of a huge surface.
#[test]
fn a_tiny_region_of_a_huge_surface_is_answered_in_its_box() {
    let poles: Vec<Vector> = (0..36)
        .map(|k| [1e6 * f64::from(k / 6), 1e6 * f64::from(k % 6), 1e4 * f64::from(k * k % 7)])
        .collect();
    let knots = [0., 0., 0., 0., 1., 2., 3., 3., 3., 3.];
    let huge = Surface::new(&knots, &knots, 3, 3, &poles, 6, 6, None).expect("a surface");
    let huge = IndexedSurface::new(huge);
    let region = [1.25, 1.25 + 1e-6, 2.5, 2.5 + 1e-6];
    let options = QueryOptions { domain: Some(region), accuracy: 1e-6, ..QueryOptions::default() };
    let middle = huge.surface().evaluate(1.25 + 5e-7, 2.5 + 5e-7);
    for query in [middle, along(middle, [0., 0., 1.], 3.0), [0., 0., 9e9], [5e6, 0., 0.]] {
        let foot = huge.closest(query, None, &options, &mut Workspace::default(), None);
        assert!(!has(&foot, flag::NOT_PROVEN), "{foot:?}");
        assert!((region[0]..=region[1]).contains(&foot.u), "{foot:?}");
        assert!((region[2]..=region[3]).contains(&foot.v), "{foot:?}");
    }
}

/// Pain: threads that meet while the index is built.
#[test]
fn sixteen_threads_that_meet_on_a_fresh_shape_get_the_same_bits() {
    let r = &mut Random(11);
    let queries: Vec<Vector> = (0..200).map(|_| r.vector().map(|x| 2.0 * x)).collect();
    let expected: Vec<_> = queries.iter().map(|q| bits(&on_surface(&sphere(), *q))).collect();
    let fresh = sphere();
    std::thread::scope(|scope| {
        for _ in 0..16 {
            scope.spawn(|| {
                let answers: Vec<_> =
                    queries.iter().map(|q| bits(&on_surface(&fresh, *q))).collect();
                assert_eq!(answers, expected);
            });
        }
    });
}

/// Pain: a progress callback that asks the same shape, while its index is made, waits for ever.
#[test]
fn what_is_polled_while_the_index_is_made_may_ask_the_shape() {
    let n = 80;
    let poles: Vec<Vector> = (0..n * n)
        .map(|k| [(k / n) as f64, (k % n) as f64, ((k / n * 7 + k % n * 3) % 11) as f64 * 0.1])
        .collect();
    let ends = [vec![0.0; 3], (0..=n - 3).map(|k| k as f64).collect(), vec![(n - 3) as f64; 3]];
    let knots = ends.concat();
    let surface = Surface::new(&knots, &knots, 3, 3, &poles, n, n, None).expect("a surface");
    let surface = IndexedSurface::new(surface);
    let mut asked = 0;
    surface
        .prepare(&mut || {
            asked += 1;
            surface.prepare(&mut || false).is_err()
        })
        .unwrap();
    assert!(asked > 0);
    assert_eq!(on_surface(&surface, [30.5, 30.5, 0.4]).flags & flag::NOT_PROVEN, 0);
}

/// The wavy curve over a domain that begins at `start`.
fn wavy_from(start: f64) -> IndexedCurve {
    let wavy = wavy();
    let knots: Vec<f64> = wavy.curve().knots().values().iter().map(|u| u + start).collect();
    curve(&knots, 3, wavy.curve().poles(), None)
}

/// Pain: the start value is wrong when the domain does not begin at 0.
#[test]
fn the_start_is_right_when_the_domain_does_not_begin_at_0() {
    let (reference, r) = (wavy_from(0.0), &mut Random(21));
    for start in [-64.0, -1.0, 2.0, 1024.0] {
        let moved = wavy_from(start);
        for _ in 0..50 {
            let query = along([3.5, 0.5, 0.4], r.vector(), 4.0);
            for scope in [Scope::Global, Scope::Local] {
                let options = QueryOptions { scope, ..QueryOptions::default() };
                let ask = |curve: &IndexedCurve| {
                    curve.closest(query, None, &options, &mut Workspace::default(), None)
                };
                let (here, there) = (ask(&reference), ask(&moved));
                assert!((here.distance - there.distance).abs() < 1e-12, "{here:?} {there:?}");
                assert!((here.u + start - there.u).abs() < 1e-9, "{start}: {here:?} {there:?}");
            }
        }
    }
}

/// Pain: the seam folds an edge's parameters over: neighbouring points jump from branch to branch.
#[test]
fn the_parameters_of_an_edge_across_the_seam_run_on() {
    let cylinder = turned(&[0., 0., 1., 1.], 1, &[[1., -1., 1.], [1., 1., 1.]]);
    let (count, mut last) = (4000, None::<f64>);
    for k in 0..=count {
        // A helix of one and a half turns, through the seam twice; a little off the surface.
        let share = f64::from(k) / f64::from(count);
        let angle = -2.0 + 9.4 * share;
        let query = [1.01 * angle.cos(), 1.01 * angle.sin(), 1.8 * share - 0.9];
        let foot = on_surface(&cylinder, query);
        assert!((foot.v - (1.8 * share + 0.1) / 2.0).abs() < 1e-12, "{k}: {foot:?}");
        if let Some(before) = last {
            // The parameter goes forward by the same small step, or from the end to the start.
            let step = (foot.u - before).rem_euclid(4.0);
            assert!(step > 0.0 && step < 3e-3, "{k}: from {before} to {foot:?}");
        }
        last = Some(foot.u);
    }
}

/// Pain: the far extremum is returned because the foot lies outside the trim.
#[test]
fn a_foot_outside_the_box_gives_the_border_of_the_box_and_not_the_far_extremum() {
    // The near side of the circle is cut off: what is left has a farthest point inside, and its nearest at an end.
    let circle = ellipse(1.0, 1.0);
    let options = QueryOptions { domain: Some([5.5, 8.5, 0.0, 0.0]), ..QueryOptions::default() };
    for y in [0.1, 0.0, -0.1] {
        let foot = circle.closest([3.0, y, 0.0], None, &options, &mut Workspace::default(), None);
        let nearest = if y < 0.0 { 8.5 } else { 5.5 };
        assert!(foot.u == nearest || y == 0.0 && foot.u == 8.5, "{y}: {foot:?}");
        assert!(!has(&foot, flag::NOT_PROVEN) && foot.distance < 2.5, "{y}: {foot:?}");
    }
    let sphere = sphere();
    let domain = Some([5.5, 8.5, 0.25, 1.75]);
    let options = QueryOptions { domain, ..QueryOptions::default() };
    let query = [3.0, 0.2, 0.1];
    let foot = sphere.closest(query, None, &options, &mut Workspace::default(), None);
    let end = circle.curve().evaluate(5.5);
    assert!(foot.u == 5.5 && !has(&foot, flag::NOT_PROVEN), "{foot:?}");
    assert!(foot.distance < norm(sub(query, end)) + 1e-12, "{foot:?}");
}

/// Pain: distance above zero for touching shapes.
#[test]
fn where_two_shapes_touch_both_distances_are_zero() {
    let sphere = sphere();
    let poles = [[-2., -2., 1.], [-2., 2., 1.], [2., -2., 1.], [2., 2., 1.]];
    let knots = [0., 0., 1., 1.];
    let plane = Surface::new(&knots, &knots, 1, 1, &poles, 2, 2, None).expect("a plane");
    let plane = IndexedSurface::new(plane);
    let touch = [0., 0., 1.];
    for shape in [&sphere, &plane] {
        let foot = on_surface(shape, touch);
        assert!(foot.distance == 0.0 && foot.lower_bound == 0.0, "{foot:?}");
        assert_eq!(foot.flags & (flag::NOT_PROVEN | flag::NOT_ON_SHAPE), 0);
    }
    // From the nearest point of the one to the other and back: still there.
    let there = on_surface(&plane, on_surface(&sphere, [0., 0., 1.5]).point);
    assert!(on_surface(&sphere, there.point).distance <= 1e-16);
}

/// Pain: point and returned parameter do not match.
#[test]
fn the_point_is_that_of_the_parameters_bit_for_bit() {
    let (curve, surfaces, r) = (wavy_from(-3.0), [sphere(), cone()], &mut Random(31));
    for _ in 0..500 {
        let query = r.vector().map(|x| 4.0 * x);
        let foot = on_curve(&curve, query);
        assert_eq!(foot.point, curve.curve().evaluate(foot.u));
        assert!((foot.distance - norm(sub(query, foot.point))).abs() <= 1e-15 * foot.distance);
        for surface in &surfaces {
            let foot = on_surface(surface, query);
            assert_eq!(foot.point, surface.surface().evaluate(foot.u, foot.v));
        }
    }
}

/// Pain: evaluators that cache the last span race across threads.
#[test]
fn evaluations_of_far_spans_in_many_threads_do_not_disturb_each_other() {
    let (curve, surface) = (wavy_from(2.0), sphere());
    let places: Vec<[f64; 2]> = (0..400)
        .map(|k| [f64::from(k * 97 % 400) / 100.0, f64::from(k * 31 % 400) / 200.0])
        .collect();
    let all = || -> Vec<[Vector; 6]> {
        let mut both = Vec::new();
        for [u, v] in &places {
            let (mut on_curve, mut on_surface) = ([[0.0; 3]; 3], [[0.0; 3]; 3]);
            curve.curve().derivatives(2.0 + u / 4.0, 2, &mut on_curve);
            surface.surface().partials(5.0 + u, *v, 1, &mut on_surface);
            let [a, b, c] = on_curve;
            let [d, e, f] = on_surface;
            both.push([a, b, c, d, e, f]);
        }
        both
    };
    let expected = all();
    std::thread::scope(|scope| {
        for _ in 0..8 {
            scope.spawn(|| (0..20).for_each(|_| assert_eq!(all(), expected)));
        }
    });
}

/// Pain: results differ between operating systems. Sums, products, quotients and square roots are the same
/// everywhere; functions of the system's mathematics are not, and so are none in the library.
#[test]
fn no_function_is_called_whose_digits_depend_on_the_system() {
    const REFUSED: [&str; 16] = [
        "mul_add", "sin", "cos", "tan", "asin", "acos", "atan", "atan2", "exp", "exp2", "ln",
        "log10", "log2", "powf", "hypot", "cbrt",
    ];
    fn visit(folder: &std::path::Path, calls: &mut Vec<String>) {
        for entry in std::fs::read_dir(folder).expect("a folder of sources") {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                visit(&path, calls);
                continue;
            }
            if path.ends_with("tests.rs") {
                continue;
            }
            let text = std::fs::read_to_string(&path).expect("a source file");
            let code = text.split("#[cfg(test)]").next().unwrap_or_default();
            for line in code.lines().map(|line| line.split("//").next().unwrap_or_default()) {
                for name in REFUSED {
                    let is_called = line.contains(&format!(".{name}("))
                        || line.contains(&format!("f64::{name}("));
                    calls.extend(is_called.then(|| format!("{}: {line}", path.display())));
                }
            }
        }
    }
    let mut calls = Vec::new();
    visit(&std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("src"), &mut calls);
    assert!(calls.is_empty(), "{calls:#?}");
}

/// Pain: process-wide settings changed by one bad query.
#[test]
fn a_bad_query_changes_nothing_for_the_queries_after_it() {
    let (sphere, r) = (sphere(), &mut Random(41));
    let queries: Vec<Vector> = (0..40).map(|_| r.vector().map(|x| 3.0 * x)).collect();
    let (options, mut workspace) = (QueryOptions::default(), Workspace::default());
    let mut all = |bad: Option<Vector>| -> Vec<_> {
        let mut answers = Vec::new();
        for query in &queries {
            if let Some(bad) = bad {
                let foot = sphere.closest(bad, Some([f64::NAN; 2]), &options, &mut workspace, None);
                assert!(has(&foot, flag::NOT_PROVEN) || foot.distance.is_finite());
            }
            answers.push(bits(&sphere.closest(*query, None, &options, &mut workspace, None)));
        }
        answers
    };
    let expected = all(None);
    for bad in [f64::NAN, f64::INFINITY, -f64::INFINITY, f64::MAX, 1e99, f64::MIN_POSITIVE, 5e-324]
    {
        assert_eq!(all(Some([bad, 0.0, 1.0])), expected, "{bad}");
        // Another thread, too, and arithmetic itself: small numbers are not flushed, rounding is to nearest.
        let other = std::thread::scope(|scope| {
            let answer =
                || queries.iter().map(|q| bits(&on_surface(&sphere, *q))).collect::<Vec<_>>();
            scope.spawn(answer).join().expect("a thread")
        });
        assert_eq!(other, expected, "{bad}");
        let [tiny, third] = [f64::MIN_POSITIVE, 3.0].map(std::hint::black_box);
        assert!(tiny / 2.0 > 0.0 && (1.0 / third).to_bits() == 0x3fd5_5555_5555_5555);
    }
}

/// A wavy sheet of `count` x `count` pieces.
fn waves(count: usize) -> IndexedSurface {
    let place = |i: usize| i as f64 / count as f64;
    let knots: Vec<f64> = (0..count + 7).map(|i| place(i.clamp(3, count + 3) - 3)).collect();
    let rows = count + 3;
    let poles: Vec<Vector> = (0..rows * rows)
        .map(|k| {
            [place(k / rows), place(k % rows), 0.02 * ((k / rows * 7 + k % rows * 3) % 5) as f64]
        })
        .collect();
    let sheet = Surface::new(&knots, &knots, 3, 3, &poles, rows, rows, None).expect("a sheet");
    IndexedSurface::new(sheet)
}

/// Pain: slow single queries because the surface is sampled again every time.
#[test]
fn a_single_query_of_a_large_surface_takes_no_more_evaluations_than_one_of_a_small_surface() {
    let (small, large, r) = (waves(4), waves(64), &mut Random(51));
    let mean = |surface: &IndexedSurface, r: &mut Random| {
        let spent = (0..300).map(|_| {
            let query = [r.between(0.1, 0.9), r.between(0.1, 0.9), r.between(-0.05, 0.15)];
            u64::from(on_surface(surface, query).iterations)
        });
        spent.sum::<u64>() as f64 / 300.0
    };
    let [few, many] = [&small, &large].map(|surface| mean(surface, r));
    assert!(many < 4.0 * few + 60.0, "{few} evaluations a query, {many} on 256 times the pieces");
    assert!(many < 4096.0 / 8.0, "{many} evaluations: as if all 4096 pieces were sampled");
    let index = large.index(&mut || false).expect("an index") as *const _;
    on_surface(&large, [0.5, 0.5, 1.0]);
    assert!(std::ptr::eq(index, large.index(&mut || false).expect("an index")), "built again");
}
