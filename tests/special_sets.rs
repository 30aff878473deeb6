//! Extrema where there are infinitely many, where the options leave some, and where the budget runs out.

mod closed_forms;
mod sets;
mod shapes;

use closed_forms::{cone, cylinder, double_circle, ellipse, sphere, torus};
use footpoint::curve::Curve;
use footpoint::extrema::ExtremaOptions;
use footpoint::index::IndexedCurve;
use footpoint::set::Kind::{self, ArcU, ArcV, Region};
use footpoint::set::Nature::{self, Flat, Maximum, Minimum, Saddle};
use footpoint::set::{FootSet, Member};
use sets::known::{eight, enneper};
use sets::{
    Asked, CLOSE, Limits, Log, QUERIES, Wanted, check_extrema, complaint, difference, extrema,
};
use shapes::asked::Shape;
use shapes::{Random, Vector, norm};

fn all() -> ExtremaOptions {
    ExtremaOptions::default()
}

fn check_one(shape: &Shape, query: Vector, wanted: &[Wanted]) {
    let mut log = Log::default();
    check_extrema(&mut log, shape, query, &all(), wanted, CLOSE);
    log.close("one", 0.0);
}

fn arc(kind: Kind, at: [f64; 2], nature: Nature, distance: f64) -> Wanted {
    Wanted::of(kind, at, nature, distance)
}

#[test]
fn the_axis_of_a_circle_is_one_arc() {
    let shape = Shape::Curve(ellipse(3.0, 3.0));
    for z in [0.0, 1.0, -1e-3, 4.0, 1e3] {
        check_one(&shape, [0.0, 0.0, z], &[arc(ArcU, [0.0; 2], Flat, z.hypot(3.0))]);
    }
    let double = Shape::Curve(double_circle(2.0));
    check_one(&double, [0.0; 3], &[arc(ArcU, [0.0; 2], Flat, 2.0)]);
}

#[test]
fn the_centre_of_a_sphere_is_a_region() {
    for radius in [1.0, 1e-3, 1e6] {
        let shape = Shape::Surface(sphere(radius));
        let wanted = [arc(Region, [0.0; 2], Flat, radius)];
        let mut log = Log::default();
        let limits = Limits { distance: 1e-11 * radius, ..CLOSE };
        check_extrema(&mut log, &shape, [0.0; 3], &all(), &wanted, limits);
        log.close("centre", 0.0);
    }
}

#[test]
fn the_axis_of_a_sphere_has_both_poles() {
    let (r, mut log) = (&mut Random(4), Log::default());
    let shape = Shape::Surface(sphere(2.0));
    for _ in 0..QUERIES / 10 {
        let z = r.between(-4.0, 4.0);
        let (near, far) = if z < 0.0 { (0.0, 2.0) } else { (2.0, 0.0) };
        let wanted = [
            arc(ArcU, [0.0, near], Minimum, (z.abs() - 2.0).abs()),
            arc(ArcU, [0.0, far], Maximum, z.abs() + 2.0),
        ];
        check_extrema(&mut log, &shape, [0.0, 0.0, z], &all(), &wanted, CLOSE);
    }
    log.close("axis of a sphere", 0.0);
}

/// The parallel in a cylinder's axis, the circles at both ends.
#[test]
fn the_axis_of_a_cylinder_has_three_circles() {
    let (r, mut log) = (&mut Random(9), Log::default());
    let shape = Shape::Surface(cylinder(1.0, 2.0));
    for _ in 0..QUERIES / 10 {
        let z = r.between(-2.0, 4.0);
        if z.abs() < 1e-3 || (z - 2.0).abs() < 1e-3 {
            continue;
        }
        let circle = |v: f64, nature: Nature| arc(ArcU, [0.0, v], nature, 1f64.hypot(z - 2.0 * v));
        let end = |is_least: bool| if is_least { Minimum } else { Maximum };
        let mut wanted = vec![circle(0.0, end(z < 0.0)), circle(1.0, end(z > 2.0))];
        if (0.0..2.0).contains(&z) {
            wanted.push(circle(z / 2.0, Minimum));
        }
        check_extrema(&mut log, &shape, [0.0, 0.0, z], &all(), &wanted, CLOSE);
    }
    log.close("axis of a cylinder", 0.0);
}

#[test]
fn the_axis_of_a_torus_has_two_circles() {
    let (r, mut log) = (&mut Random(9), Log::default());
    let shape = Shape::Surface(torus(3.0, 1.0));
    for k in 0..QUERIES / 10 {
        let z = if k == 0 { 0.0 } else { r.between(-4.0, 4.0) };
        let away = z.hypot(3.0);
        let ring = |sign: f64| sets::known::turn([-3.0 * sign, z * sign]);
        let wanted = [
            arc(ArcU, [0.0, ring(1.0)], Minimum, away - 1.0),
            arc(ArcU, [0.0, ring(-1.0)], Maximum, away + 1.0),
        ];
        check_extrema(&mut log, &shape, [0.0, 0.0, z], &all(), &wanted, CLOSE);
    }
    log.close("axis of a torus", 0.0);
}

/// The middle of the tube: its circle, and the two far points of the meridian across.
#[test]
fn the_spine_of_a_torus_has_a_circle_and_two_points() {
    let (r, mut log) = (&mut Random(10), Log::default());
    let shape = Shape::Surface(torus(3.0, 1.0));
    for _ in 0..QUERIES / 10 {
        let angle = r.between(0.05, 6.2);
        let (u, opposite) = {
            let (s, c) = angle.sin_cos();
            (sets::known::turn([c, s]), sets::known::turn([-c, -s]))
        };
        let (s, c) = angle.sin_cos();
        let wanted = [
            arc(ArcV, [u, 0.0], Minimum, 1.0),
            Wanted::point([opposite, 2.0], Saddle, 5.0),
            Wanted::point([opposite, 0.0], Maximum, 7.0),
        ];
        check_extrema(&mut log, &shape, [3.0 * c, 3.0 * s, 0.0], &all(), &wanted, CLOSE);
    }
    log.close("spine of a torus", 0.0);
}

#[test]
fn the_axis_of_a_cone_has_its_tip_and_circles() {
    let (r, mut log) = (&mut Random(12), Log::default());
    let shape = Shape::Surface(cone(1.0, 1.0));
    for _ in 0..QUERIES / 10 {
        let z = r.between(-2.0, 4.0);
        if z.abs() < 1e-3 || (z - 2.0).abs() < 1e-3 {
            continue;
        }
        let circle = |v: f64, nature: Nature| arc(ArcU, [0.0, v], nature, v.hypot(z - v));
        let tip = |nature: Nature| arc(ArcU, [0.0; 2], nature, z.abs());
        let wanted = if z < 0.0 {
            vec![tip(Minimum), circle(1.0, Maximum)]
        } else if z < 2.0 {
            vec![circle(0.5 * z, Minimum), tip(Maximum), circle(1.0, Maximum)]
        } else {
            vec![circle(1.0, Minimum), tip(Maximum)]
        };
        check_extrema(&mut log, &shape, [0.0, 0.0, z], &all(), &wanted, CLOSE);
    }
    log.close("axis of a cone", 0.0);
}

/// Points with two nearest feet: both, with the same distance.
#[test]
fn medial_points_have_both_nearest_feet() {
    let shape = Shape::Curve(ellipse(2.0, 1.0));
    let (x, mut log) = (0.6, Log::default());
    // On the long axis inside the evolute the feet have cos(angle) = a x / (a^2 - b^2).
    let c: f64 = 2.0 * x / 3.0;
    let s = (1.0 - c * c).sqrt();
    let distance = (2.0 * c - x).hypot(s);
    let wanted = [
        Wanted::point([sets::known::turn([c, s]), 0.0], Minimum, distance),
        Wanted::point([sets::known::turn([c, -s]), 0.0], Minimum, distance),
        Wanted::point([0.0, 0.0], Maximum, 2.0 - x),
        Wanted::point([2.0, 0.0], Maximum, 2.0 + x),
    ];
    check_extrema(&mut log, &shape, [x, 0.0, 0.0], &all(), &wanted, CLOSE);
    log.close("medial", 0.0);
}

/// A triple zero of the slope: one point, found to what the accuracy leaves open.
#[test]
fn the_cusp_of_the_evolute_has_a_flat_nearest_point() {
    let shape = Shape::Curve(ellipse(2.0, 1.0));
    let set = extrema(&shape, [1.5, 0.0, 0.0], &all());
    assert!(set.is_complete() && set.members.len() == 2, "{set:?}");
    let near = &set.members[0];
    assert!((near.foot.distance - 0.5).abs() < 1e-9 && near.kind == Kind::Point, "{near:?}");
    assert!(near.foot.u.min(4.0 - near.foot.u) < 2e-2, "{near:?}");
    assert!(matches!(near.nature, Minimum | Flat), "{near:?}");
    assert_eq!(set.members[1].nature, Maximum);
}

/// A line, an arc around it and a line again: the arc's centre sees a part of the curve at one distance.
#[test]
fn an_arc_in_a_curve_is_a_continuum_of_its_spans() {
    let h = 0.5f64.sqrt();
    let poles = [
        [3., -2., 0.],
        [3., -1., 0.],
        [3., 0., 0.],
        [3., 3., 0.],
        [0., 3., 0.],
        [-1., 3., 0.],
        [-2., 3., 0.],
    ];
    let weights = [1., 1., 1., h, 1., 1., 1.];
    let knots = [0., 0., 0., 1., 1., 2., 2., 3., 3., 3.];
    let curve = Curve::new(&knots, 2, &poles, Some(&weights)).expect("a curve");
    let shape = Shape::Curve(IndexedCurve::new(curve));
    let set = extrema(&shape, [0.0; 3], &all());
    assert!(set.is_complete() && set.members.len() == 3, "{set:?}");
    let arc = &set.members[0];
    assert_eq!((arc.kind, arc.nature), (ArcU, Minimum));
    assert!(arc.u[0] <= 1.0 && arc.u[0] > 0.99 && arc.u[1] >= 2.0 && arc.u[1] < 2.01, "{arc:?}");
    assert!((arc.foot.distance - 3.0).abs() < 1e-14, "{arc:?}");
    assert!(set.members[1..].iter().all(|m| m.nature == Maximum));
    assert_eq!(complaint(&shape, &set, &Asked::Extrema([0.0; 3])), None);
}

fn is_least(m: &Member) -> bool {
    matches!(m.nature, Minimum | Flat)
}

/// Every choice of options leaves the same members that it would leave of the whole set.
#[test]
fn options_leave_what_they_say() {
    let (r, mut log) = (&mut Random(13), Log::default());
    let shapes = [
        Shape::Curve(eight()),
        Shape::Curve(ellipse(3.0, 1.0)),
        Shape::Surface(torus(3.0, 1.0)),
        Shape::Surface(cylinder(1.0, 2.0)),
        Shape::Surface(cone(1.0, 2.0)),
        Shape::Surface(sphere(1.0)),
        Shape::Surface(enneper()),
    ];
    for k in 0..QUERIES / 2 {
        let shape = &shapes[k % shapes.len()];
        let query = r.vector().map(|x| 0.6 * shape.diagonal() * x);
        let whole = extrema(shape, query, &all());
        let radius = if r.unit() < 0.5 { 0.0 } else { shape.diagonal() * r.unit() };
        let (nearest, minima_only) = (r.whole(0, 3), r.unit() < 0.5);
        let options = ExtremaOptions { radius, nearest, minima_only, ..all() };
        let set = extrema(shape, query, &options);
        let mut wanted: Vec<Member> = whole.members.clone();
        wanted.retain(|m| radius == 0.0 || m.foot.distance <= radius);
        wanted.retain(|m| !minima_only || is_least(m));
        wanted.truncate(if nearest > 0 { nearest } else { usize::MAX });
        let same = set.is_complete() && set.members == wanted;
        log.put(query, if same { None } else { Some(format!("{options:?} {set:?} {wanted:?}")) });
    }
    log.close("options", 0.0);
}

/// The ends of a restriction are borders: a part of the torus has points on its sides and at its corners.
#[test]
fn a_restriction_has_borders_and_corners() {
    let shape = Shape::Surface(torus(3.0, 1.0));
    let options = ExtremaOptions { domain: Some([0.0, 1.0, 0.0, 1.0]), ..all() };
    // A query outside, on the diagonal plane of the quarter: everything by symmetry at u of 45 degrees.
    let query = [6.0, 6.0, 0.0];
    let away = 72f64.sqrt();
    let middle = sets::known::turn([1.0, 1.0]);
    let end = |u: f64, v: f64, nature: Nature| {
        Wanted::point([u, v], nature, norm(shapes::sub(shape.evaluate([u, v]), query)))
    };
    let wanted = [
        Wanted::point([middle, 0.0], Minimum, away - 4.0),
        Wanted::point([middle, 1.0], Saddle, (away - 3.0).hypot(1.0)),
        end(0.0, 0.0, Saddle),
        end(1.0, 0.0, Saddle),
        end(0.0, 1.0, Maximum),
        end(1.0, 1.0, Maximum),
    ];
    let set = extrema(&shape, query, &options);
    assert_eq!(difference(&shape, &set, &wanted, CLOSE), None);
    assert_eq!(complaint(&shape, &set, &Asked::Extrema(query)), None);
}

/// Restrictions of a circle: stationary points inside, and both ends.
#[test]
fn a_part_of_a_circle_has_its_ends() {
    let (r, mut log) = (&mut Random(14), Log::default());
    let shape = Shape::Curve(ellipse(2.0, 2.0));
    for _ in 0..QUERIES / 4 {
        let (a, b) = (r.between(0.0, 4.0), r.between(0.0, 4.0));
        let (a, b) = (a.min(b), a.max(b));
        let p = r.vector().map(|x| 3.0 * x);
        let rho = p[0].hypot(p[1]);
        let (near, far) = (sets::known::turn([p[0], p[1]]), sets::known::turn([-p[0], -p[1]]));
        let is_doubtful = [a, b].iter().any(|x| (x - near).abs() < 1e-4 || (x - far).abs() < 1e-4);
        if rho < 1e-3 || b - a < 1e-3 || is_doubtful {
            log.leave_out();
            continue;
        }
        let options = ExtremaOptions { domain: Some([a, b, 0.0, 0.0]), ..all() };
        let mut wanted = Vec::new();
        for (u, nature, across) in [(near, Minimum, rho - 2.0), (far, Maximum, rho + 2.0)] {
            if (a..=b).contains(&u) {
                wanted.push(Wanted::point([u, 0.0], nature, across.hypot(p[2])));
            }
        }
        // From `near` on the distance rises for half a turn.
        let rises = |u: f64| (u - near).rem_euclid(4.0) < 2.0;
        let end = |u: f64, up: bool| {
            let nature = if up { Minimum } else { Maximum };
            Wanted::point([u, 0.0], nature, norm(shapes::sub(shape.evaluate([u, 0.0]), p)))
        };
        wanted.push(end(a, rises(a)));
        wanted.push(end(b, !rises(b)));
        check_extrema(&mut log, &shape, p, &options, &wanted, CLOSE);
    }
    log.close("part of a circle", 0.05);
}

fn is_inside(area: &[f64; 4], at: [f64; 2]) -> bool {
    area[0] <= at[0] && at[0] <= area[1] && area[2] <= at[1] && at[1] <= area[3]
}

fn is_known(part: &FootSet, m: &Member) -> bool {
    let at = [m.foot.u, m.foot.v];
    let same = |k: &Member| (k.foot.u - at[0]).abs() < 1e-8 && (k.foot.v - at[1]).abs() < 1e-8;
    let holds = |k: &Member| is_inside(&[k.u[0], k.u[1], k.v[0], k.v[1]], at);
    part.members.iter().any(|k| same(k) || holds(k))
        || part.undecided.iter().any(|area| is_inside(area, at))
}

/// What is missing when the budget ran out lies in the undecided boxes.
#[test]
fn a_small_budget_says_where_the_rest_may_be() {
    let (r, mut log) = (&mut Random(15), Log::default());
    let shapes = [
        Shape::Curve(eight()),
        Shape::Surface(torus(3.0, 1.0)),
        Shape::Surface(enneper()),
        Shape::Surface(sphere(1.0)),
    ];
    let mut incomplete = 0;
    for k in 0..QUERIES / 2 {
        let shape = &shapes[k % shapes.len()];
        let query = r.vector().map(|x| 0.6 * shape.diagonal() * x);
        let whole = extrema(shape, query, &all());
        let options = ExtremaOptions { budget: 1 + k as u64 % 11, ..all() };
        let part = extrema(shape, query, &options);
        incomplete += usize::from(!part.is_complete());
        let missing = whole.members.iter().find(|m| !is_known(&part, m));
        let foreign = part.members.iter().find(|m| !is_known(&whole, m));
        let text = missing.map(|m| format!("misses {m:?}: {part:?}"));
        log.put(query, text.or(foreign.map(|m| format!("has {m:?}: {whole:?}"))));
    }
    assert!(incomplete > QUERIES / 20, "{incomplete}");
    log.close("small budget", 0.0);
}

/// The law holds for a set and its parts in any order of shapes: a query far away loses digits, no members.
#[test]
fn far_queries_keep_all_members() {
    let mut log = Log::default();
    let shape = Shape::Surface(torus(3.0, 1.0));
    for k in 1..12 {
        let far = 10f64.powi(k);
        let query = [0.6 * far, 0.8 * far, 0.3 * far];
        let set = extrema(&shape, query, &all());
        let natures: Vec<Nature> = set.members.iter().map(|m| m.nature).collect();
        let right = set.is_complete() && natures == [Minimum, Saddle, Saddle, Maximum];
        log.put(query, if right { None } else { Some(format!("{set:?}")) });
    }
    log.close("far", 0.0);
}
