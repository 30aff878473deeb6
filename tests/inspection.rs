//! Hausdorff distances, continuity along borders, umbilics: closed forms.

mod revolved;
mod shapes;

use footpoint::curve::Curve;
use footpoint::index::{IndexedCurve, IndexedSurface};
use footpoint::inspect::{
    HausdorffOptions, RangeOptions, Shape, continuity, curvatures, hausdorff, umbilics,
};
use footpoint::knots::Side;
use footpoint::surface::Surface;
use revolved::{circle, ellipsoid, revolved};
use shapes::{Random, Vector, norm, sub};

const LINE: [f64; 4] = [0., 0., 1., 1.];

fn plane(corners: [Vector; 4]) -> IndexedSurface {
    IndexedSurface::new(Surface::new(&LINE, &LINE, 1, 1, &corners, 2, 2, None).unwrap())
}

fn ellipse(a: f64, b: f64) -> IndexedCurve {
    let (knots, poles) = circle([0.0; 3], 1.0);
    let moved: Vec<Vector> = poles.iter().map(|(p, _)| [a * p[0], b * p[2], 0.0]).collect();
    let weights: Vec<f64> = poles.iter().map(|p| p.1).collect();
    IndexedCurve::new(Curve::new(&knots, 2, &moved, Some(&weights)).unwrap())
}

fn assert_bounds(bounds: [f64; 2], value: f64, accuracy: f64) {
    let slack = 1e-12 * value;
    assert!(bounds[0] <= value + slack && value <= bounds[1] + slack, "{bounds:?} {value}");
    assert!(bounds[1] - bounds[0] <= accuracy, "{bounds:?} {value}");
}

#[test]
fn the_distance_of_an_ellipse_from_a_circle_is_that_of_its_far_end() {
    let (circle, ellipse) = (ellipse(1.0, 1.0), ellipse(1.3, 0.9));
    let options = HausdorffOptions { accuracy: 1e-4, ..HausdorffOptions::default() };
    let (a, b) = (Shape::Curve(&ellipse), Shape::Curve(&circle));
    let found = hausdorff(a, b, &options, &mut || false).unwrap();
    assert!(found.forward.proven && found.backward.proven, "{found:?}");
    assert_bounds([found.forward.lower, found.forward.upper], 0.3, 1.1e-4);
    assert_bounds(found.bounds(), 0.3, 1.1e-4);
}

#[test]
fn the_lower_bound_of_a_distance_is_attained_at_its_place() {
    let (circle, ellipse) = (ellipse(1.0, 1.0), ellipse(1.3, 0.9));
    let ball = IndexedSurface::new(ellipsoid([1.0; 3]));
    let egg = IndexedSurface::new(ellipsoid([1.2, 1.0, 1.0]));
    let options = HausdorffOptions { accuracy: 1e-2, ..HausdorffOptions::default() };
    let pairs = [
        (Shape::Curve(&ellipse), Shape::Curve(&circle), 0.3),
        (Shape::Curve(&ellipse), Shape::Surface(&ball), 0.3),
        (Shape::Surface(&egg), Shape::Surface(&ball), 0.2),
    ];
    for (a, b, far) in pairs {
        let found = hausdorff(a, b, &options, &mut || false).unwrap().forward;
        let point = match a {
            Shape::Curve(curve) => curve.curve().evaluate(found.at[0]),
            Shape::Surface(surface) => surface.surface().evaluate(found.at[0], found.at[1]),
        };
        // The second shape is the unit circle or ball, and the first is farthest from it where its parameter begins.
        let distance = (norm(point) - 1.0).abs();
        assert!(found.lower <= distance + 1e-12 && distance <= found.upper, "{found:?} {point:?}");
        assert!(distance > far - 1e-2, "{found:?} {distance}");
    }
}

#[test]
fn concentric_spheres_are_apart_by_the_difference_of_their_radii() {
    let (inner, outer) = (ellipsoid([1.0; 3]), ellipsoid([1.02; 3]));
    let (inner, outer) = (IndexedSurface::new(inner), IndexedSurface::new(outer));
    let options = HausdorffOptions { accuracy: 2e-3, ..HausdorffOptions::default() };
    let (a, b) = (Shape::Surface(&inner), Shape::Surface(&outer));
    let found = hausdorff(a, b, &options, &mut || false).unwrap();
    println!("{found:?}");
    assert_bounds([found.forward.lower, found.forward.upper], 0.02, 2.1e-3);
    assert_bounds([found.backward.lower, found.backward.upper], 0.02, 2.1e-3);
}

#[test]
fn bounds_of_the_distance_hold_dense_samples_of_random_shapes() {
    let mut random = Random(21);
    for family in shapes::FAMILIES.iter().take(4) {
        let make = |random: &mut Random| {
            let knots = [0., 0., 0., 0., 0.5, 1., 1., 1., 1.];
            let poles: Vec<Vector> = (0..5)
                .map(|i| {
                    let v = random.vector();
                    [i as f64 + v[0], v[1], v[2]]
                })
                .collect();
            let weights: Vec<f64> = (0..5)
                .map(|_| random.scale(-family.weights / 6.0, 0.1 + family.weights / 6.0))
                .collect();
            IndexedCurve::new(Curve::new(&knots, 3, &poles, Some(&weights)).unwrap())
        };
        let (a, b) = (make(&mut random), make(&mut random));
        let found = hausdorff(
            Shape::Curve(&a),
            Shape::Curve(&b),
            &HausdorffOptions::default(),
            &mut || false,
        )
        .unwrap();
        let far = |from: &IndexedCurve, to: &IndexedCurve| {
            (0..=400)
                .map(|k| {
                    let q = from.curve().evaluate(k as f64 / 400.0);
                    (0..=4000)
                        .map(|j| norm(sub(q, to.curve().evaluate(j as f64 / 4000.0))))
                        .fold(f64::INFINITY, f64::min)
                })
                .fold(0.0, f64::max)
        };
        let (forward, backward) = (far(&a, &b), far(&b, &a));
        // A sampled distance is too great by the sampling of the other curve, at most.
        let slack = 2e-3;
        assert!(found.forward.proven && found.backward.proven, "{found:?}");
        assert!(
            forward <= found.forward.upper + slack && found.forward.lower <= forward + slack,
            "{found:?} {forward}"
        );
        assert!(
            backward <= found.backward.upper + slack && found.backward.lower <= backward + slack
        );
        assert!((forward - found.forward.lower).abs() < 0.03, "{found:?} {forward}");
    }
}

#[test]
fn halves_of_a_surface_meet_with_all_derivatives() {
    let knots = [0., 0., 0., 0., 0.3, 0.7, 1., 1., 1., 1.];
    let mut random = Random(4);
    let poles: Vec<Vector> =
        (0..36).map(|k| [(k / 6) as f64, (k % 6) as f64, random.between(-0.5, 0.5)]).collect();
    let whole = Surface::new(&knots, &knots, 3, 3, &poles, 6, 6, None).unwrap();
    let (low, high) = whole.split_u(0.45).unwrap();
    let (low, high) = (IndexedSurface::new(low), IndexedSurface::new(high));
    let found = continuity(&low, 1, &high, 0, &mut || false).unwrap();
    println!("{found:?}");
    assert!(found.gap.lower < 1e-12 && found.gap.upper < 1e-5, "{found:?}");
    assert!(found.angle.lower < 1e-7 && found.angle.upper < 5e-3, "{found:?}");
    assert!(found.curvature.lower < 1e-7 && found.curvature.upper < 0.1, "{found:?}");
}

#[test]
fn planes_meet_in_their_angle_and_a_cylinder_meets_its_tangent_plane_in_its_curvature() {
    let floor = plane([[0., 0., 0.], [0., 1., 0.], [1., 0., 0.], [1., 1., 0.]]);
    let angle = 0.4f64;
    let (s, c) = angle.sin_cos();
    let ramp = plane([[1., 0., 0.], [1., 1., 0.], [1. + c, 0., s], [1. + c, 1., s]]);
    let found = continuity(&floor, 1, &ramp, 0, &mut || false).unwrap();
    assert!(found.angle.lower <= angle + 1e-9 && angle <= found.angle.upper + 1e-12, "{found:?}");
    assert!(found.angle.upper - found.angle.lower < 2e-3, "{found:?}");
    // A quarter cylinder of radius 2 that leaves the floor upwards at x = 1.
    let radius = 2.0;
    let half = 0.5f64.sqrt();
    let knots = [0., 0., 0., 1., 1., 1.];
    let arc = [[1.0, 0.0], [1.0 + radius, 0.0], [1.0 + radius, radius]];
    let mut poles = Vec::new();
    for [x, z] in arc {
        poles.push([x, 0.0, z]);
        poles.push([x, 1.0, z]);
    }
    let weights = [1.0, 1.0, half, half, 1.0, 1.0];
    let fillet = Surface::new(&knots, &LINE, 2, 1, &poles, 3, 2, Some(&weights)).unwrap();
    let fillet = IndexedSurface::new(fillet);
    let found = continuity(&floor, 1, &fillet, 0, &mut || false).unwrap();
    assert!(
        found.gap.upper < 1e-5 && found.angle.lower < 1e-7 && found.angle.upper < 2e-3,
        "{found:?}"
    );
    let jump = 1.0 / radius;
    assert!(
        found.curvature.lower <= jump + 1e-9 && jump <= found.curvature.upper + 1e-9,
        "{found:?}"
    );
    assert!(found.curvature.upper - found.curvature.lower < 0.02, "{found:?}");
    let text = continuity(&floor, 4, &ramp, 0, &mut || false).unwrap_err().to_string();
    assert_eq!(text, "side_a: 4 given, 0 to 3 accepted");
}

#[test]
fn an_ellipsoid_has_four_umbilics_where_the_formula_says() {
    let [a, b, c] = [3.0, 2.0, 1.0f64];
    let surface = IndexedSurface::new(ellipsoid([a, b, c]));
    let [u0, u1, v0, v1] = surface.surface().domain();
    let inset = 0.02 * (v1 - v0);
    let options =
        RangeOptions { domain: Some([u0, u1, v0 + inset, v1 - inset]), ..RangeOptions::default() };
    let found = umbilics(&surface, &options, &mut || false).unwrap();
    let x = a * ((a * a - b * b) / (a * a - c * c)).sqrt();
    let z = c * ((b * b - c * c) / (a * a - c * c)).sqrt();
    // The two at u = u0 = u1 are seen from both ends of the seam.
    for place in &found {
        assert!(place.is_small, "{place:?}");
        let [px, py, pz] = surface.surface().evaluate(place.at[0], place.at[1]);
        let gap = norm([px.abs() - x, py, pz.abs() - z]);
        assert!(gap < 1e-2, "{place:?} {gap}");
    }
    let sign = |place: &footpoint::inspect::Umbilic| {
        let p = surface.surface().evaluate(place.at[0], place.at[1]);
        (p[0] > 0.0, p[2] > 0.0)
    };
    for wanted in [(false, false), (false, true), (true, false), (true, true)] {
        assert!(found.iter().any(|place| sign(place) == wanted), "{found:?}");
    }
}

#[test]
fn principal_directions_of_a_torus_run_along_its_circles() {
    let (knots, profile) = circle([3.0, 0.0, 0.0], 1.0);
    let surface = revolved(&knots, 2, &profile);
    let c = curvatures(&surface, [0.4, 0.7], [Side::Above; 2]).unwrap();
    let [x, y, z] = c.point;
    let ring = x.hypot(y);
    let outward: Vector = [(ring - 3.0) * x / ring, (ring - 3.0) * y / ring, z];
    let flip = if shapes::dot(outward, c.normal) > 0.0 { -1.0 } else { 1.0 };
    let around = flip * (ring - 3.0) / ring;
    let mut wanted = [flip, around];
    wanted.sort_by(|a, b| b.total_cmp(a));
    for k in 0..2 {
        assert!((c.principal[k] - wanted[k]).abs() < 1e-12, "{c:?} {wanted:?}");
        let along = [-y / ring, x / ring, 0.0];
        let cosine = shapes::dot(c.directions[k], along).abs();
        let is_around = (c.principal[k] - around).abs() < 1e-9;
        assert!((cosine - if is_around { 1.0 } else { 0.0 }).abs() < 1e-9, "{c:?}");
    }
    assert!((c.gaussian - around * flip).abs() < 1e-12 && !c.is_umbilic);
}
