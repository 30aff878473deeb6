//! Projection along a direction, against closed forms.

mod closed_forms;

use closed_forms::{Random, cylinder, ellipse, norm, sphere, sub, torus};
use footpoint::closest::{QueryOptions, flag};
use footpoint::preimage::ProjectMemory;

#[test]
fn a_point_projects_onto_the_nearer_side_of_a_sphere_or_misses_it() {
    let (ball, options, mut memory) =
        (sphere(1.5), QueryOptions::default(), ProjectMemory::default());
    let mut random = Random(11);
    let (mut hits, mut misses) = (0, 0);
    for _ in 0..2_000 {
        let (q, d) = (random.point(2.5), random.point(1.0));
        let foot = ball.project(q, d, &options, &mut memory);
        let size = norm(d);
        let along = -(q[0] * d[0] + q[1] * d[1] + q[2] * d[2]) / size;
        let apart2 = norm(q).powi(2) - along * along;
        let half2 = 1.5 * 1.5 - apart2;
        if half2.abs() < 1e-4 {
            continue;
        }
        if half2 < 0.0 {
            misses += 1;
            assert!(foot.flags & flag::NOT_ON_SHAPE != 0 && foot.distance == f64::INFINITY);
            assert!(foot.u.is_nan() && foot.lower_bound == f64::INFINITY);
            continue;
        }
        hits += 1;
        let half = half2.sqrt();
        let expected = (along - half).abs().min((along + half).abs());
        assert!((foot.distance - expected).abs() < 1e-9, "{} {expected}", foot.distance);
        assert!(
            foot.lower_bound <= foot.distance && foot.lower_bound > expected - 1e-3,
            "{q:?} {d:?} {half} {foot:?}"
        );
        assert_eq!(foot.flags & (flag::NOT_PROVEN | flag::NOT_ON_SHAPE), 0);
        assert_eq!(foot.point, ball.surface().evaluate(foot.u, foot.v));
    }
    assert!(hits > 400 && misses > 400);
}

#[test]
fn where_the_line_runs_in_the_surface_its_nearest_point_counts() {
    let tube = cylinder(1.0, 2.0);
    let (options, mut memory) = (QueryOptions::default(), ProjectMemory::default());
    for (z, expected) in [(0.7, 0.0), (5.0, 3.0), (-1.0, 1.0)] {
        let foot = tube.project([0.6, 0.8, z], [0.0, 0.0, 2.0], &options, &mut memory);
        assert!((foot.distance - expected).abs() < 1e-9, "{foot:?}");
    }
}

#[test]
fn a_restriction_hides_the_rest_and_bad_points_are_marked() {
    let ring = torus(2.0, 0.5);
    let mut memory = ProjectMemory::default();
    let half = QueryOptions { domain: Some([0.0, 2.0, 0.0, 4.0]), ..QueryOptions::default() };
    // The half y >= 0 of the torus: looking along x from the middle of its ring, both arms are there; along y one.
    let foot = ring.project([0.0, 0.1, 0.0], [0.0, 1.0, 0.0], &half, &mut memory);
    assert!((foot.point[1] - 1.5).abs() < 1e-9, "{foot:?}");
    let foot = ring.project([0.0, -2.0, 0.0], [0.0, 1.0, 0.0], &half, &mut memory);
    assert!((foot.distance - 3.5).abs() < 1e-9, "{foot:?}");
    let bad = ring.project([f64::NAN, 0.0, 0.0], [0.0, 1.0, 0.0], &half, &mut memory);
    assert!(bad.flags & flag::BAD_QUERY != 0);
}

#[test]
fn curves_are_met_where_they_cross_the_line() {
    let oval = ellipse(2.0, 1.0);
    let (options, mut memory) = (QueryOptions::default(), ProjectMemory::default());
    let foot = oval.project([0.5, 0.6, 0.0], [-3.0, 0.0, 0.0], &options, &mut memory);
    assert!(norm(sub(foot.point, [1.6, 0.6, 0.0])) < 1e-9, "{foot:?}");
    let foot = oval.project([0.5, 0.6, 0.1], [1.0, 0.0, 0.0], &options, &mut memory);
    assert!(foot.flags & flag::NOT_ON_SHAPE != 0);
}
