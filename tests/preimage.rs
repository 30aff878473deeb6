//! Preimages on shapes that are known in closed form: exactly the known parameters, for random points on and off them.

mod closed_forms;
mod sets;
mod shapes;

use closed_forms::{cone, cylinder, double_circle, ellipse, sphere, torus};
use footpoint::closest::QueryOptions;
use footpoint::curve::Curve;
use footpoint::index::{IndexedCurve, IndexedSurface};
use footpoint::set::Kind;
use footpoint::surface::Surface;
use sets::known::{ENNEPER, crossing_loop, eight, enneper};
use sets::{Asked, Limits, Log, QUERIES, Wanted, check_preimage, complaint, preimage};
use shapes::asked::Shape;
use shapes::{Random, Vector, along, norm, sub};

/// Points are given by parameters: those must come back.
const BACK: Limits = Limits { parameters: 1e-8, distance: 1e-13 };

fn points(places: &[[f64; 2]]) -> Vec<Wanted> {
    places.iter().map(|at| Wanted::at(*at)).collect()
}

/// Asks for the preimages of points at random places; `others` tells all parameters that a place's point has.
fn check_places(name: &str, shape: &Shape, others: impl Fn([f64; 2]) -> Option<Vec<[f64; 2]>>) {
    let (r, mut log) = (&mut Random(4_711), Log::default());
    let [u0, u1, v0, v1] = shape.domain();
    for _ in 0..QUERIES {
        let at = [r.between(u0, u1), if v0 < v1 { r.between(v0, v1) } else { 0.0 }];
        match others(at) {
            None => log.leave_out(),
            Some(places) => {
                check_preimage(&mut log, shape, shape.evaluate(at), &points(&places), BACK);
            }
        }
    }
    log.close(name, 0.02);
}

#[test]
fn curves_without_crossings_have_one_parameter() {
    check_places("circle", &Shape::Curve(ellipse(1.5, 1.5)), |at| Some(vec![at]));
    check_places("ellipse", &Shape::Curve(ellipse(3.0, 1.0)), |at| Some(vec![at]));
}

#[test]
fn a_double_covered_circle_has_two() {
    check_places("double circle", &Shape::Curve(double_circle(2.0)), |[u, _]| {
        Some(vec![[u, 0.0], [(u + 4.0) % 8.0, 0.0]])
    });
}

/// Near the crossing the other branch comes within the tolerance.
#[test]
fn crossing_curves_have_one_off_the_crossing() {
    let off = |at: f64, crossing: &[f64]| crossing.iter().all(|x| (at - x).abs() > 1e-5);
    check_places("figure eight", &Shape::Curve(eight()), |at| {
        off(at[0], &[-1.0, 0.0, 1.0]).then(|| vec![at])
    });
    check_places("loop", &Shape::Curve(crossing_loop()), |at| {
        off(at[0], &[-1.0, 1.0]).then(|| vec![at])
    });
}

#[test]
fn crossings_have_one_for_each_branch() {
    let mut log = Log::default();
    let origin = [0.0; 3];
    let places = [[-1.0, 0.0], [0.0, 0.0], [1.0, 0.0]];
    check_preimage(&mut log, &Shape::Curve(eight()), origin, &points(&places), BACK);
    let crossing = [1.0, 0.0, 0.0];
    let places = [[-1.0, 0.0], [1.0, 0.0]];
    check_preimage(&mut log, &Shape::Curve(crossing_loop()), crossing, &points(&places), BACK);
    log.close("crossings", 0.0);
}

#[test]
fn surfaces_of_revolution_have_one_off_seams_and_tips() {
    check_places("sphere", &Shape::Surface(sphere(2.0)), |at| {
        (at[1] > 1e-5 && at[1] < 2.0 - 1e-5).then(|| vec![at])
    });
    check_places("torus", &Shape::Surface(torus(3.0, 1.0)), |at| Some(vec![at]));
    check_places("cylinder", &Shape::Surface(cylinder(1.0, 2.0)), |at| Some(vec![at]));
    check_places("cone", &Shape::Surface(cone(1.0, 1.0)), |at| (at[1] > 1e-5).then(|| vec![at]));
}

/// Both ends of a closed direction, in the order of the parameters: the canonical one first.
#[test]
fn points_of_seams_have_both_ends() {
    let (r, mut log) = (&mut Random(1), Log::default());
    let round = Shape::Curve(ellipse(2.0, 1.0));
    check_preimage(&mut log, &round, [2.0, 0.0, 0.0], &points(&[[0.0, 0.0], [4.0, 0.0]]), BACK);
    let double = Shape::Curve(double_circle(1.0));
    let places = points(&[[0.0, 0.0], [4.0, 0.0], [8.0, 0.0]]);
    check_preimage(&mut log, &double, [1.0, 0.0, 0.0], &places, BACK);
    for _ in 0..QUERIES / 10 {
        for shape in [sphere(1.0), torus(3.0, 1.0), cylinder(1.0, 2.0), cone(1.0, 1.0)] {
            let shape = Shape::Surface(shape);
            let [.., v1] = shape.domain();
            let v = r.between(0.01, v1 - 0.01);
            let places = points(&[[0.0, v], [4.0, v]]);
            check_preimage(&mut log, &shape, shape.evaluate([0.0, v]), &places, BACK);
        }
        let shape = Shape::Surface(torus(2.0, 0.5));
        let u = r.between(0.01, 3.99);
        let places = points(&[[u, 0.0], [u, 4.0]]);
        check_preimage(&mut log, &shape, shape.evaluate([u, 4.0]), &places, BACK);
    }
    log.close("seams", 0.0);
}

#[test]
fn the_corner_of_a_torus_has_four() {
    let mut log = Log::default();
    let shape = Shape::Surface(torus(3.0, 1.0));
    let places = points(&[[0.0, 0.0], [0.0, 4.0], [4.0, 0.0], [4.0, 4.0]]);
    check_preimage(&mut log, &shape, [4.0, 0.0, 0.0], &places, BACK);
    log.close("corner", 0.0);
}

fn arc_u(v: f64) -> Wanted {
    Wanted { kind: Kind::ArcU, ..Wanted::at([0.0, v]) }
}

#[test]
fn collapsed_edges_are_arcs() {
    let mut log = Log::default();
    let ball = Shape::Surface(sphere(2.0));
    check_preimage(&mut log, &ball, [0.0, 0.0, -2.0], &[arc_u(0.0)], BACK);
    check_preimage(&mut log, &ball, [0.0, 0.0, 2.0], &[arc_u(2.0)], BACK);
    check_preimage(&mut log, &Shape::Surface(cone(1.0, 3.0)), [0.0; 3], &[arc_u(0.0)], BACK);
    log.close("collapsed edges", 0.0);
}

/// The two symmetric curves in which Enneper's surface crosses itself, in the planes x = 0 and y = 0.
#[test]
fn a_surface_that_crosses_itself_has_two_on_the_crossing() {
    let (r, mut log) = (&mut Random(77), Log::default());
    let shape = Shape::Surface(enneper());
    for k in 0..QUERIES {
        let most = (ENNEPER * ENNEPER / 3.0 - 1.0).sqrt();
        let b = r.between(-most, most) * (1.0 - 1e-6);
        let a = (3.0 * (1.0 + b * b)).sqrt();
        let places = if k % 2 == 0 { [[-a, b], [a, b]] } else { [[b, -a], [b, a]] };
        check_preimage(&mut log, &shape, shape.evaluate(places[1]), &points(&places), BACK);
    }
    log.close("crossing of a surface", 0.0);
    // Its partners lie within a few tolerances of the places near the crossing.
    let near = |a: f64, b: f64| (a.abs() - (3.0 * (1.0 + b * b)).sqrt()).abs() < 1e-5;
    check_places("off the crossing", &shape, |[u, v]| {
        (!near(u, v) && !near(v, u)).then(|| vec![[u, v]])
    });
}

/// Off the shape by more than the tolerance: nothing, proven.
#[test]
fn points_off_the_shape_have_none() {
    let (r, mut log) = (&mut Random(3), Log::default());
    let shapes = [
        Shape::Curve(eight()),
        Shape::Curve(ellipse(3.0, 1.0)),
        Shape::Surface(sphere(2.0)),
        Shape::Surface(torus(3.0, 1.0)),
        Shape::Surface(cone(1.0, 1.0)),
        Shape::Surface(enneper()),
    ];
    for k in 0..QUERIES {
        let shape = &shapes[k % shapes.len()];
        let query = shape.query(r);
        let foot = shape.ask(query, None, &QueryOptions::default());
        let set = preimage(shape, query, 0.0, &QueryOptions::default());
        let tolerance = 1e-7 * shape.diagonal();
        let complete = set.is_complete();
        let agrees = if foot.distance > tolerance * 1.001 {
            set.members.is_empty()
        } else {
            !set.members.is_empty()
        };
        let text = format!("{foot:?} {set:?}");
        log.put(query, if complete && agrees { None } else { Some(text) });
    }
    log.close("off the shape", 0.0);
}

/// Members are separate places within the tolerance, and hold every sample that lies within it.
#[test]
fn wide_tolerances_hold_all_samples_within() {
    let (r, mut log) = (&mut Random(31), Log::default());
    let shapes = [
        Shape::Curve(eight()),
        Shape::Curve(crossing_loop()),
        Shape::Surface(torus(3.0, 1.0)),
        Shape::Surface(enneper()),
    ];
    let options = QueryOptions { budget: 200_000, ..QueryOptions::default() };
    for k in 0..QUERIES / 100 {
        let shape = &shapes[k % shapes.len()];
        let tolerance = shape.diagonal() * r.scale(-6.0, -2.0);
        let on = shape.evaluate(shape.place(r));
        let query = along(on, r.direction(), tolerance * r.unit());
        let set = preimage(shape, query, tolerance, &options);
        let holds = |at: [f64; 2]| {
            let inside = |i: [f64; 2], x: f64| i[0] <= x && x <= i[1];
            set.members.iter().any(|m| inside(m.u, at[0]) && inside(m.v, at[1]))
        };
        let near = |at: &[f64; 2]| norm(sub(shape.evaluate(*at), query)) <= tolerance;
        let missing = shape.samples_of(400).into_iter().find(|at| near(at) && !holds(*at));
        let broken = complaint(shape, &set, &Asked::Preimage(query));
        let text = missing.map(|at| format!("misses {at:?}, tolerance {tolerance}: {set:?}"));
        let text = text.or(broken);
        let undecided = (!set.is_complete()).then(|| format!("{} undecided", set.undecided.len()));
        log.put(query, text.or(undecided));
    }
    log.close("wide tolerances", 0.0);
}

/// A polynomial curve with all poles of its middle span equal.
fn curve_with_an_empty_span() -> IndexedCurve {
    let knots = [0., 0., 0., 0., 1., 1., 1., 2., 2., 2., 3., 3., 3., 3.];
    let tip = [1.0, 1.0, 0.5];
    let poles: [Vector; 10] = [
        [0., 0., 0.],
        [0.3, 0.2, 0.],
        [0.6, 0.7, 0.3],
        tip,
        tip,
        tip,
        tip,
        [1.2, 1.5, 0.4],
        [2., 2., 0.],
        [3., 1., 1.],
    ];
    IndexedCurve::new(Curve::new(&knots, 3, &poles, None).expect("a curve"))
}

#[test]
fn a_span_without_length_is_an_arc() {
    let shape = Shape::Curve(curve_with_an_empty_span());
    let query = [1.0, 1.0, 0.5];
    let set = preimage(&shape, query, 0.0, &QueryOptions::default());
    assert!(set.is_complete() && set.members.len() == 1, "{set:?}");
    let arc = &set.members[0];
    assert_eq!(arc.kind, Kind::ArcU);
    assert!(arc.u[0] <= 1.0 && arc.u[1] >= 2.0, "{arc:?}");
    assert!(arc.u[0] > 0.99 && arc.u[1] < 2.01 && arc.foot.distance <= 1e-15, "{arc:?}");
    assert_eq!(complaint(&shape, &set, &Asked::Preimage(query)), None);
}

/// A bilinear sheet with a strip without width: in v nothing moves between v = 1 and v = 2.
fn surface_with_an_empty_strip() -> IndexedSurface {
    let (knots_u, knots_v) = ([0., 0., 1., 1.], [0., 0., 1., 2., 3., 3.]);
    let mut poles = Vec::new();
    for x in [0.0, 2.0] {
        for y in [0.0, 1.0, 1.0, 3.0] {
            poles.push([x, y, 0.3 * x * y]);
        }
    }
    let surface = Surface::new(&knots_u, &knots_v, 1, 1, &poles, 2, 4, None);
    IndexedSurface::new(surface.expect("a surface"))
}

#[test]
fn a_strip_without_width_is_an_arc() {
    let (r, mut log) = (&mut Random(5), Log::default());
    let shape = Shape::Surface(surface_with_an_empty_strip());
    for _ in 0..QUERIES / 10 {
        let u = r.unit();
        let query = shape.evaluate([u, 1.0]);
        let set = preimage(&shape, query, 0.0, &QueryOptions::default());
        let holds = set.is_complete()
            && set.members.len() == 1
            && set.members[0].kind == Kind::ArcV
            && (set.members[0].foot.u - u).abs() < 1e-9
            && set.members[0].v[0] <= 1.0
            && set.members[0].v[1] >= 2.0
            && set.members[0].v[0] > 0.999
            && set.members[0].v[1] < 2.001;
        let broken = (!holds).then(|| format!("{set:?}"));
        log.put(query, broken.or_else(|| complaint(&shape, &set, &Asked::Preimage(query))));
    }
    log.close("strip", 0.0);
}

#[test]
fn a_restriction_leaves_what_lies_outside_and_keeps_its_ends() {
    let shape = Shape::Surface(torus(3.0, 1.0));
    let corner = [4.0, 0.0, 0.0];
    let part = |domain: [f64; 4]| {
        let options = QueryOptions { domain: Some(domain), ..QueryOptions::default() };
        let set = preimage(&shape, corner, 0.0, &options);
        assert!(set.is_complete());
        set.members.iter().map(|m| [m.foot.u, m.foot.v]).collect::<Vec<_>>()
    };
    assert_eq!(part([0.0, 2.0, 0.0, 4.0]), [[0.0, 0.0], [0.0, 4.0]]);
    assert_eq!(part([2.0, 4.0, 2.0, 4.0]), [[4.0, 4.0]]);
    assert_eq!(part([1.0, 3.0, 0.0, 4.0]), [[0.0; 2]; 0]);
    let on = shape.evaluate([1.0, 2.5]);
    let options = QueryOptions { domain: Some([1.0, 2.0, 2.0, 2.5]), ..QueryOptions::default() };
    let set = preimage(&shape, on, 0.0, &options);
    assert_eq!(set.members.len(), 1);
    assert_eq!([set.members[0].foot.u, set.members[0].foot.v], [1.0, 2.5]);
}

/// What is missing when the budget ran out lies in the undecided boxes.
#[test]
fn a_small_budget_says_where_the_rest_may_be() {
    let (r, mut log) = (&mut Random(8), Log::default());
    let shapes =
        [Shape::Surface(enneper()), Shape::Surface(torus(3.0, 1.0)), Shape::Curve(eight())];
    let mut incomplete = 0;
    for k in 0..QUERIES / 10 {
        let shape = &shapes[k % shapes.len()];
        let at = shape.place(r);
        let query = shape.evaluate(at);
        let options = QueryOptions { budget: 1 + k as u64 % 7, ..QueryOptions::default() };
        let part = preimage(shape, query, 0.0, &options);
        let whole = preimage(shape, query, 0.0, &QueryOptions::default());
        incomplete += usize::from(!part.is_complete());
        let inside = |i: [f64; 2], x: f64| i[0] <= x && x <= i[1];
        let known = |at: [f64; 2]| {
            part.undecided
                .iter()
                .any(|b| inside([b[0], b[1]], at[0]) && inside([b[2], b[3]], at[1]))
                || part.members.iter().any(|m| inside(m.u, at[0]) && inside(m.v, at[1]))
        };
        let all = whole.members.iter().all(|m| known([m.foot.u, m.foot.v])) && known(at);
        log.put(query, if all { None } else { Some(format!("{part:?} of {whole:?}")) });
    }
    assert!(incomplete > QUERIES / 50, "{incomplete}");
    log.close("small budget", 0.0);
}
