//! Curves and surfaces given by functions, against closed forms: offsets of splines, circles, spheres, tori.

mod functions;
mod shapes;

use footpoint::callback::{CallbackCurve, CallbackSurface, CurveBounds, SurfaceBounds};
use footpoint::closest::{FootPoint, QueryOptions, Scope, flag};
use footpoint::error::Error;
use footpoint::extrema::ExtremaOptions;
use footpoint::set::{FootSet, Kind, Nature};
use functions::{
    RADII, ellipse_offset, figure_eight, greatest, line, paraboloid, plane, ring, sphere,
    spline_offset, spline_torus, torus, torus_bounds, torus_distance,
};
use shapes::{Random, Vector, along, norm, sub};
use std::f64::consts::{PI, TAU};

const NO_BOUNDS: SurfaceBounds = SurfaceBounds { speed: None, second: None };

fn points(count: usize, size: f64, seed: u64) -> Vec<Vector> {
    let mut random = Random(seed);
    (0..count).map(|_| random.vector().map(|x| x * size)).collect()
}

fn on(shape: &CallbackSurface, q: Vector) -> FootPoint {
    shape.closest(q, None, &QueryOptions::default(), None)
}

fn has(foot: &FootPoint, bit: u32) -> bool {
    foot.flags & bit != 0
}

/// The distance is `truth`; proven when `proven`, else marked and without a bound.
fn check_foot(foot: &FootPoint, truth: f64, proven: bool) {
    assert!((foot.distance - truth).abs() < 1e-9, "{foot:?} against {truth}");
    assert!(foot.lower_bound <= truth + 1e-12, "{foot:?} against {truth}");
    assert_eq!(has(foot, flag::NOT_PROVEN), !proven, "{foot:?} against {truth}");
    assert!(proven || foot.lower_bound == 0.0);
}

#[test]
fn the_offset_torus_has_its_distance_with_each_kind_of_bounds_and_each_number_of_orders() {
    for orders in 0..=2 {
        for (bounds, proven) in [
            (torus_bounds(), true),
            (SurfaceBounds { speed: None, ..torus_bounds() }, true),
            (NO_BOUNDS, false),
        ] {
            let shape = torus(orders, bounds);
            for q in points(60, 5.0, 1) {
                check_foot(&on(&shape, q), torus_distance(q), proven);
            }
        }
    }
}

#[test]
fn lipschitz_bounds_prove_points_on_the_shape_and_bound_the_others() {
    let shape = torus(2, SurfaceBounds { second: None, ..torus_bounds() });
    for q in points(60, 5.0, 2) {
        let foot = on(&shape, q);
        let truth = torus_distance(q);
        assert!((foot.distance - truth).abs() < 1e-9);
        assert!(foot.lower_bound <= truth && foot.lower_bound > truth - 0.05, "{foot:?}");
        let coarse = QueryOptions { accuracy: 0.05, ..QueryOptions::default() };
        assert!(!has(&shape.closest(q, None, &coarse, None), flag::NOT_PROVEN));
        check_foot(&on(&shape, foot.point), 0.0, true);
    }
}

#[test]
fn the_offset_of_a_spline_torus_is_the_torus_with_the_sum_of_radii() {
    for orders in [0, 1] {
        for known in [true, false] {
            let shape = spline_offset(&spline_torus(), 0.25, orders, known);
            assert!(shape.is_closed_u() && shape.is_closed_v());
            for q in points(40, 5.0, 3) {
                check_foot(&on(&shape, q), torus_distance(q), known);
            }
        }
    }
}

#[test]
fn the_offset_of_a_paraboloid_keeps_its_distance_along_the_normals() {
    let (surface, delta) = (paraboloid(), 0.4);
    let mut random = Random(4);
    for known in [true, false] {
        let shape = spline_offset(&surface, -delta, 1, known);
        for _ in 0..60 {
            let (x, y) = (random.between(-0.8, 0.8), random.between(-0.8, 0.8));
            let slope = (1.0 + 4.0 * (x * x + y * y)).sqrt();
            // Outward is down; a point at the height t over the paraboloid is t - delta from the offset.
            let outward = [2.0 * x / slope, 2.0 * y / slope, -1.0 / slope];
            let t = random.between(delta, 2.0);
            let q = along([x, y, x * x + y * y], outward, t);
            check_foot(&on(&shape, q), t - delta, known);
        }
    }
}

#[test]
fn an_offset_curve_keeps_its_distance_along_the_normals() {
    let (a, b, delta) = (3.0, 2.0, 0.5);
    for known in [true, false] {
        let curve = ellipse_offset(a, b, delta, known);
        assert!(curve.is_closed());
        let mut random = Random(5);
        for _ in 0..100 {
            let u = random.between(0.0, TAU);
            let (s, c) = u.sin_cos();
            let size = (b * c).hypot(a * s);
            let t = random.between(delta, 4.0);
            let height = random.between(-1.0, 1.0);
            let q = [a * c + t * b * c / size, b * s + t * a * s / size, height];
            let foot = curve.closest(q, None, &QueryOptions::default(), None);
            check_foot(&foot, (t - delta).hypot(height), known);
            assert!((foot.u - u).abs() < 1e-6, "{foot:?} at {u}");
        }
    }
}

#[test]
fn an_offset_sphere_has_its_poles_and_its_seam() {
    let radius = 1.5;
    for known in [true, false] {
        let shape = sphere(radius, known);
        assert!(shape.is_closed_u() && !shape.is_closed_v());
        assert_eq!(shape.collapsed_edges(), [false, false, true, true]);
        for q in points(60, 3.0, 6) {
            check_foot(&on(&shape, q), (norm(q) - radius).abs(), known);
        }
        let top = on(&shape, [0.0, 0.0, 2.0]);
        assert!((top.distance - 0.5).abs() < 1e-12 && top.v > 1.5, "{top:?}");
        let seam = on(&shape, [2.0, 0.0, 0.0]);
        assert!(has(&seam, flag::SEAM | flag::EDGE) && seam.u == 0.0, "{seam:?}");
    }
    // The centre is as far from everything: found, flagged, bounded.
    let centre = on(&sphere(radius, true), [0.0; 3]);
    assert!(has(&centre, flag::CONTINUUM | flag::TIE) && centre.lower_bound > radius - 5e-3);
    assert!((centre.distance - radius).abs() < 1e-12);
}

#[test]
fn an_inversion_tells_what_is_not_on_the_shape() {
    let shape = torus(1, torus_bounds());
    let options = QueryOptions::default();
    let mut random = Random(7);
    for _ in 0..50 {
        let at = [random.between(0.0, TAU), random.between(0.0, TAU)];
        let point = shape.evaluate(at[0], at[1]).unwrap();
        let foot = shape.invert(point, None, &options, None);
        assert!(norm(sub(foot.point, point)) < 1e-12 && !has(&foot, flag::NOT_ON_SHAPE));
        assert!(!has(&foot, flag::NOT_PROVEN), "{foot:?}");
        assert!((foot.u - at[0]).abs() + (foot.v - at[1]).abs() < 1e-9);
        let beside = shape.invert(point.map(|x| 1.01 * x), None, &options, None);
        assert!(has(&beside, flag::NOT_ON_SHAPE) && !has(&beside, flag::NOT_PROVEN));
    }
}

#[test]
fn an_answer_in_a_box_is_the_least_of_it() {
    let shape = torus(2, torus_bounds());
    for (i, q) in points(40, 5.0, 8).into_iter().enumerate() {
        let [u, v] = [0.1 * i as f64, 0.12 * i as f64];
        let domain = [u, u + 0.7, v, v + 0.9];
        let options = QueryOptions { domain: Some(domain), ..QueryOptions::default() };
        let foot = shape.closest(q, None, &options, None);
        assert!(!has(&foot, flag::NOT_PROVEN), "{foot:?}");
        assert!(domain[0] <= foot.u && foot.u <= domain[1]);
        assert!(domain[2] <= foot.v && foot.v <= domain[3]);
        for k in 0..=40 * 40 {
            let at = [u + 0.7 / 40.0 * (k % 41) as f64, v + 0.9 / 40.0 * (k / 41) as f64];
            let point = shape.evaluate(at[0], at[1]).unwrap();
            assert!(norm(sub(point, q)) >= foot.lower_bound - 1e-12);
            assert!(norm(sub(point, q)) >= foot.distance - 1e-9);
        }
    }
}

#[test]
fn hints_methods_and_traces_leave_the_proven_distance() {
    use footpoint::refine::Method::{Auto, Maf, Newton, Osculating};
    let shape = torus(2, torus_bounds());
    for q in points(20, 5.0, 9) {
        for method in [Auto, Maf, Newton, Osculating] {
            let options = QueryOptions { method, ..QueryOptions::default() };
            let mut steps = 0;
            let mut told = |_: u32, _: f64, _: f64, _: f64| steps += 1;
            let foot = shape.closest(q, Some([1.0, 1.0]), &options, Some(&mut told));
            check_foot(&foot, torus_distance(q), true);
            assert!(has(&foot, flag::HINT_USED) && steps > 0);
        }
        let local = QueryOptions { scope: Scope::Local, ..QueryOptions::default() };
        let foot = shape.closest(q, None, &local, None);
        assert!(has(&foot, flag::NOT_PROVEN) && foot.lower_bound == 0.0);
        assert!((foot.distance - torus_distance(q)).abs() < 1e-9);
    }
}

#[test]
fn a_budget_that_runs_out_is_told_and_leaves_a_sound_bound() {
    let shape = torus(1, torus_bounds());
    for budget in [1, 5, 20] {
        let options = QueryOptions { budget, ..QueryOptions::default() };
        for q in points(20, 5.0, 10) {
            let foot = shape.closest(q, None, &options, None);
            assert!(foot.lower_bound <= torus_distance(q) + 1e-12);
            assert!(!has(&foot, flag::NOT_PROVEN) || has(&foot, flag::BUDGET), "{foot:?}");
        }
        let set = shape.preimage([3.1, 0.2, 1.24], 0.1, &options, &mut || false).unwrap();
        assert!(!set.is_complete());
    }
}

#[test]
fn queries_that_are_not_finite_or_too_large_are_marked() {
    let shape = torus(1, torus_bounds());
    for x in [f64::NAN, f64::INFINITY, -2e100] {
        assert!(has(&on(&shape, [0.0, x, 0.0]), flag::BAD_QUERY));
        assert!(
            shape
                .preimage([x, 0.0, 0.0], 0.0, &QueryOptions::default(), &mut || false)
                .unwrap()
                .members
                .is_empty()
        );
        assert!(
            shape
                .extrema([x, 0.0, 0.0], &ExtremaOptions::default(), &mut || false)
                .unwrap()
                .members
                .is_empty()
        );
    }
    let far = on(&shape, [1e90, 0.0, 0.0]);
    assert!(far.distance == 1e90 && far.lower_bound <= 1e90 && far.lower_bound > 0.9e90, "{far:?}");
}

/// The distances and natures of a set, nearest first.
fn natures(set: &FootSet) -> Vec<(f64, Nature)> {
    set.members.iter().map(|member| (member.foot.distance, member.nature)).collect()
}

#[test]
fn a_torus_has_four_stationary_points() {
    for (orders, bounds) in
        [(2, torus_bounds()), (1, torus_bounds()), (0, torus_bounds()), (2, NO_BOUNDS)]
    {
        let shape = torus(orders, bounds);
        for q in points(30, 5.0, 11) {
            let set = shape.extrema(q, &ExtremaOptions::default(), &mut || false).unwrap();
            assert_eq!(set.is_complete(), bounds.second.is_some(), "{set:?}");
            let [big, small] = RADII;
            let rho = q[0].hypot(q[1]);
            let mut truth: Vec<f64> = [rho - big, rho + big]
                .iter()
                .flat_map(|x| [(x.hypot(q[2]) - small).abs(), x.hypot(q[2]) + small])
                .collect();
            truth.sort_by(f64::total_cmp);
            let found = natures(&set);
            assert_eq!(found.len(), 4, "{q:?} {set:#?}");
            for (k, d) in truth.iter().enumerate() {
                assert!((found[k].0 - d).abs() < 1e-9, "{q:?} {set:#?}");
            }
            assert_eq!(found[0].1, Nature::Minimum);
            assert_eq!(found[3].1, Nature::Maximum);
            assert!(set.members.iter().all(|m| m.u[0] <= m.foot.u && m.foot.u <= m.u[1]));
        }
    }
}

#[test]
fn a_sphere_has_two_stationary_points_and_its_centre_a_region() {
    let shape = sphere(1.5, true);
    for q in points(30, 3.0, 12) {
        let set = shape.extrema(q, &ExtremaOptions::default(), &mut || false).unwrap();
        let found = natures(&set);
        assert!(found.len() == 2, "{q:?} {set:#?}");
        // Near the axis the poles blur: more boxes than a request has by default.
        assert!(set.is_complete() || q[0].hypot(q[1]) < 0.6, "{q:?} {set:#?}");
        assert_eq!([found[0].1, found[1].1], [Nature::Minimum, Nature::Maximum]);
        assert!((found[1].0 - norm(q) - 1.5).abs() < 1e-9);
    }
    let poles = shape.extrema([0.0, 0.0, 0.3], &ExtremaOptions::default(), &mut || false).unwrap();
    assert_eq!(poles.members.len(), 2, "{poles:#?}");
    assert!(poles.members.iter().all(|m| m.kind == Kind::ArcU && has(&m.foot, flag::COLLAPSED)));
    assert_eq!(
        [poles.members[0].nature, poles.members[1].nature],
        [Nature::Minimum, Nature::Maximum]
    );
    // Feet beside the poles are not taken for the poles.
    for x in [1e-3, 4e-3, 0.02, 0.1] {
        let set = shape.extrema([x, 0.0, 0.5], &ExtremaOptions::default(), &mut || false).unwrap();
        let v = (0.5f64 / x).atan();
        for (v, nature) in [(v, Nature::Minimum), (-v, Nature::Maximum)] {
            let found = set.members.iter().find(|m| (m.foot.v - v).abs() < 1e-6);
            assert_eq!(found.map(|m| m.nature), Some(nature), "{x} {set:#?}");
        }
    }
    let centre = shape.extrema([0.0; 3], &ExtremaOptions::default(), &mut || false).unwrap();
    assert!(centre.members.iter().any(|m| m.kind == Kind::Region), "{centre:#?}");
}

#[test]
fn the_axis_of_a_torus_has_circles_of_stationary_points() {
    let shape = torus(2, torus_bounds());
    let set = shape.extrema([0.0, 0.0, 0.7], &ExtremaOptions::default(), &mut || false).unwrap();
    let arcs: Vec<_> = set.members.iter().filter(|m| m.kind == Kind::ArcU).collect();
    assert_eq!(arcs.len(), 2, "{set:#?}");
    for (arc, far) in arcs.iter().zip([-1.0, 1.0]) {
        let truth = 3.0f64.hypot(0.7) + far * RADII[1];
        assert!((arc.foot.distance - truth).abs() < 1e-9 && has(&arc.foot, flag::CONTINUUM));
    }
}

#[test]
fn a_plane_square_has_its_borders_and_corners() {
    for known in [true, false] {
        let set = plane(known)
            .extrema([0.4, 0.45, 1.0], &ExtremaOptions::default(), &mut || false)
            .unwrap();
        assert_eq!(set.is_complete(), known);
        let count = |nature| set.members.iter().filter(|m| m.nature == nature).count();
        assert_eq!(set.members.len(), 9, "{set:#?}");
        assert_eq!(
            [count(Nature::Minimum), count(Nature::Saddle), count(Nature::Maximum)],
            [1, 4, 4]
        );
    }
}

#[test]
fn curves_have_their_stationary_points() {
    let circle = ring(2.0, TAU, true);
    for q in points(40, 3.0, 13) {
        let found = natures(&circle.extrema(q, &ExtremaOptions::default(), &mut || false).unwrap());
        let rho = q[0].hypot(q[1]);
        assert_eq!(found.len(), 2, "{q:?} {found:?}");
        assert!((found[0].0 - (rho - 2.0).hypot(q[2])).abs() < 1e-9);
        assert!((found[1].0 - (rho + 2.0).hypot(q[2])).abs() < 1e-9);
        assert_eq!([found[0].1, found[1].1], [Nature::Minimum, Nature::Maximum]);
    }
    let axis = circle.extrema([0.0, 0.0, 1.0], &ExtremaOptions::default(), &mut || false).unwrap();
    assert!(axis.members.len() == 1 && axis.members[0].kind == Kind::ArcU, "{axis:#?}");
    let segment =
        line().extrema([0.3, 1.0, 0.0], &ExtremaOptions::default(), &mut || false).unwrap();
    let [near, first, last] = natures(&segment)[..] else { panic!("{segment:#?}") };
    assert_eq!([near.1, first.1, last.1], [Nature::Minimum, Nature::Maximum, Nature::Maximum]);
    // Inside the evolute of an ellipse: four; outside: two.
    let ellipse = ellipse_offset(3.0, 2.0, 0.0, true);
    assert_eq!(
        ellipse
            .extrema([0.1, 0.2, 0.0], &ExtremaOptions::default(), &mut || false)
            .unwrap()
            .members
            .len(),
        4
    );
    assert_eq!(
        ellipse
            .extrema([2.5, 1.8, 0.0], &ExtremaOptions::default(), &mut || false)
            .unwrap()
            .members
            .len(),
        2
    );
}

#[test]
fn extrema_can_be_filtered_and_sets_can_be_stopped() {
    let (shape, q) = (torus(1, torus_bounds()), [4.0, 1.0, 2.0]);
    let ask = |options: ExtremaOptions| shape.extrema(q, &options, &mut || false).unwrap();
    let count = |options| ask(options).members.len();
    assert_eq!(count(ExtremaOptions { minima_only: true, ..ExtremaOptions::default() }), 1);
    assert_eq!(count(ExtremaOptions { nearest: 3, ..ExtremaOptions::default() }), 3);
    assert_eq!(count(ExtremaOptions { radius: 4.0, ..ExtremaOptions::default() }), 2);
    let domain = Some([1.0, 2.0, 1.0, 2.0]);
    let part = ask(ExtremaOptions { domain, ..ExtremaOptions::default() });
    assert!(part.is_complete() && part.members.len() >= 4, "{part:#?}");
    assert!(part.members.iter().all(|m| (1.0..=2.0).contains(&m.foot.u)));
    let stopped = shape.extrema(q, &ExtremaOptions::default(), &mut || true);
    assert_eq!(stopped, Err(Error::Cancelled));
    let stopped = shape.preimage(q, 0.1, &QueryOptions::default(), &mut || true);
    assert_eq!(stopped, Err(Error::Cancelled));
}

#[test]
fn preimages_on_a_torus_are_one_place_and_on_its_seams_two_or_four() {
    let options = QueryOptions::default();
    for (orders, bounds) in [(2, torus_bounds()), (0, torus_bounds()), (2, NO_BOUNDS)] {
        let shape = torus(orders, bounds);
        let mut random = Random(14);
        for _ in 0..40 {
            let at = [random.between(0.01, TAU - 0.01), random.between(0.01, TAU - 0.01)];
            let set = shape
                .preimage(shape.evaluate(at[0], at[1]).unwrap(), 0.0, &options, &mut || false)
                .unwrap();
            assert_eq!(set.members.len(), 1, "{at:?} {set:#?}");
            assert_eq!(set.is_complete(), bounds.second.is_some());
            let member = &set.members[0];
            assert!(member.u[0] <= at[0] && at[0] <= member.u[1]);
            assert!(member.v[0] <= at[1] && at[1] <= member.v[1]);
            assert!(member.kind == Kind::Point && member.u[1] - member.u[0] < 1e-4);
        }
        for (at, count) in [([0.0, 1.0], 2), ([2.0, 0.0], 2), ([0.0, TAU], 4)] {
            let set = shape
                .preimage(shape.evaluate(at[0], at[1]).unwrap(), 0.0, &options, &mut || false)
                .unwrap();
            assert_eq!(set.members.len(), count, "{at:?} {set:#?}");
            assert!((set.members[0].foot.u - at[0]).abs() < 1e-6);
        }
        assert!(
            shape
                .preimage([3.0, 0.0, 0.0], 0.0, &options, &mut || false)
                .unwrap()
                .members
                .is_empty()
        );
    }
}

#[test]
fn preimages_at_crossings_poles_and_double_covers() {
    let options = QueryOptions::default();
    let crossing = figure_eight().preimage([0.0; 3], 0.0, &options, &mut || false).unwrap();
    assert!(crossing.is_complete(), "{crossing:#?}");
    let places: Vec<f64> = crossing.members.iter().map(|m| m.foot.u).collect();
    assert!(places.len() == 2 && (places[0] - 0.5 * PI).abs() < 1e-6, "{crossing:#?}");
    assert!((places[1] - 1.5 * PI).abs() < 1e-6);

    let twice = ring(2.0, 2.0 * TAU, true);
    let covered = twice.preimage([0.0, 2.0, 0.0], 0.0, &options, &mut || false).unwrap();
    assert!(covered.is_complete() && covered.members.len() == 2, "{covered:#?}");
    assert_eq!(
        twice.preimage([2.0, 0.0, 0.0], 0.0, &options, &mut || false).unwrap().members.len(),
        3
    );

    let pole = sphere(1.5, true).preimage([0.0, 0.0, 1.5], 1e-4, &options, &mut || false).unwrap();
    assert!(pole.is_complete(), "{pole:#?}");
    let [member] = &pole.members[..] else { panic!("{pole:#?}") };
    assert_eq!((member.kind, member.u), (Kind::ArcU, [0.0, TAU]));
    assert!(member.v[1] == 0.5 * PI && member.v[0] > 1.56);
}

#[test]
fn a_function_that_fails_takes_the_proof_away_and_not_the_foot() {
    use std::sync::Arc;
    use std::sync::atomic::{AtomicBool, Ordering};
    let down = Arc::new(AtomicBool::new(false));
    let heard = down.clone();
    let function = move |u: f64, v: f64, _: usize, out: &mut [Vector; 6]| {
        if heard.load(Ordering::Relaxed) || (u > 0.8 && v > 0.8) {
            return None;
        }
        let infinite = if u < 0.1 && v < 0.1 { f64::NAN } else { 0.0 };
        out[0] = [u, v, infinite];
        Some(0)
    };
    let bounds = SurfaceBounds { speed: Some([1.0; 2]), second: Some([1e-3; 3]) };
    let shape = CallbackSurface::new([0.0, 1.0, 0.0, 1.0], bounds, function).unwrap();
    assert!(shape.evaluate(0.9, 0.9).is_none() && shape.evaluate(0.05, 0.05).is_none());
    let fine = on(&shape, [0.5, 0.25, 1.0]);
    assert!((fine.distance - 1.0).abs() < 1e-9, "{fine:?}");
    // The nearest finite places lie beside the corner.
    for corner in [[0.95, 0.95, 0.5], [0.02, 0.02, 0.5]] {
        let foot = on(&shape, corner);
        assert!(foot.distance.is_finite() && foot.distance < 0.6, "{foot:?}");
        assert!(has(&foot, flag::NOT_PROVEN) && foot.lower_bound == 0.0, "{foot:?}");
        let set = shape
            .preimage([corner[0], corner[1], 0.0], 1e-3, &QueryOptions::default(), &mut || false)
            .unwrap();
        assert!(!set.is_complete());
        assert!(
            !shape
                .extrema(corner, &ExtremaOptions::default(), &mut || false)
                .unwrap()
                .is_complete()
        );
    }
    down.store(true, Ordering::Relaxed);
    let none = on(&shape, [0.5, 0.25, 1.0]);
    assert!(none.u.is_nan() && none.distance.is_nan() && none.lower_bound == 0.0);
    assert!(has(&none, flag::NOT_PROVEN));
    let set = shape.extrema([0.5, 0.25, 1.0], &ExtremaOptions::default(), &mut || false).unwrap();
    assert!(set.members.is_empty() && !set.is_complete());
}

#[test]
fn constructors_refuse_what_is_no_shape() {
    let flat = |u: f64, v: f64, _: usize, out: &mut [Vector; 6]| {
        out[0] = [u, v, 0.0];
        Some(0)
    };
    let make = |domain, bounds| CallbackSurface::new(domain, bounds, flat).map(|_| ());
    let speed = |x| SurfaceBounds { speed: Some([x, 1.0]), second: None };
    let second = |x| SurfaceBounds { speed: None, second: Some([0.0, x, 0.0]) };
    assert!(make([0.0, 1.0, 0.0, 1.0], NO_BOUNDS).is_ok());
    for domain in [[0.0, 0.0, 0.0, 1.0], [0.0, 1.0, 1.0, 0.0], [0.0, f64::NAN, 0.0, 1.0]] {
        assert!(make(domain, NO_BOUNDS).unwrap_err().to_string().contains("domain"));
    }
    for x in [-1.0, f64::NAN, f64::INFINITY] {
        assert!(make([0.0, 1.0, 0.0, 1.0], speed(x)).unwrap_err().to_string().contains("speed"));
        assert!(make([0.0, 1.0, 0.0, 1.0], second(x)).unwrap_err().to_string().contains("second"));
    }
    let nothing = CallbackCurve::new([0.0, 1.0], CurveBounds::default(), |_, _, _| None);
    assert!(nothing.unwrap_err().to_string().contains("finite"));
    let silent = CallbackCurve::new([0.0, 1.0], CurveBounds::default(), |_, _, _| Some(2));
    assert!(silent.is_err(), "what is not written is not finite");
    assert!(make([0.0, 1.0, 0.0, 1.0], NO_BOUNDS).is_ok());
    let shape = torus(1, NO_BOUNDS);
    assert!(shape.check_domain([0.0, 1.0, 0.0, 7.0]).is_err());
    assert!(shape.check_domain([0.0, 1.0, 2.0, 2.0]).is_err());
    assert!(shape.check_domain([0.0, 1.0, 2.0, 3.0]).is_ok());
}

#[test]
fn bounds_of_samples_hold_for_samples() {
    let shape = spline_offset(&spline_torus(), 0.25, 1, true);
    let aabb = shape.bounding_box();
    assert!((aabb.high[0] - 4.25).abs() < 1e-9 && (aabb.low[2] + 1.25).abs() < 1e-9, "{aabb:?}");
    let [uu, _, _] = greatest(&shape);
    assert!(uu > 1.0);
}
