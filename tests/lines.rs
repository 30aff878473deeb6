//! Points of a shape on a line: crossings, tangents and generators that are known in closed form.

mod closed_forms;
mod sets;
mod shapes;

use closed_forms::{cone, cylinder, ellipse, sphere, torus};
use footpoint::closest::QueryOptions;
use footpoint::preimage::Line;
use footpoint::set::Kind;
use sets::known::{crossing_loop, rise, turn, zeros};
use sets::{Asked, Limits, Log, QUERIES, Wanted, complaint, difference, on_line};
use shapes::asked::Shape;
use shapes::{Random, Vector, along, dot, norm};

/// Parameters of crossings that are not nearly tangent.
const CROSSING: Limits = Limits { parameters: 1e-8, distance: 1e-7 };

fn whole(origin: Vector, direction: Vector) -> Line {
    Line { origin, direction, reach: [f64::NEG_INFINITY, f64::INFINITY] }
}

/// Compares the set of a line with the points wanted, which come with their places along the line.
fn check_line(log: &mut Log, shape: &Shape, line: &Line, wanted: &[Wanted]) {
    let set = on_line(shape, line, 0.0, &QueryOptions::default());
    let broken = difference(shape, &set, wanted, CROSSING);
    log.put(line, broken.or_else(|| complaint(shape, &set, &Asked::OnLine(*line))));
}

fn random_line(r: &mut Random, size: f64) -> Line {
    let origin = r.vector().map(|x| size * x);
    let length = r.scale(-3.0, 3.0);
    let direction = r.direction().map(|x| length * x);
    let reach = match r.whole(0, 3) {
        0 => [0.0, f64::INFINITY],
        1 => [r.between(-size, 0.0), r.between(0.0, size)],
        _ => [f64::NEG_INFINITY, f64::INFINITY],
    };
    Line { origin, direction, reach }
}

/// Places along the line, at unit speed, of the zeros of a quadratic form; `None` near a tangent.
fn quadratic([a, b, c]: [f64; 3]) -> Option<Vec<f64>> {
    let discriminant = b * b - a * c;
    if discriminant.abs() < 1e-3 * (b * b + (a * c).abs()) || a.abs() < 1e-6 {
        return None;
    }
    if discriminant < 0.0 {
        return Some(Vec::new());
    }
    let root = discriminant.sqrt();
    Some(vec![(-b - root) / a, (-b + root) / a])
}

/// The members at the places in the line's reach; `None` when a place is near an end of the reach or of the shape.
fn members(
    line: &Line,
    places: &[f64],
    parameters: impl Fn(Vector) -> Option<Option<[f64; 2]>>,
) -> Option<Vec<Wanted>> {
    let unit = line.direction.map(|x| x / norm(line.direction));
    let mut wanted = Vec::new();
    for t in places {
        if line.reach.iter().any(|end| (t - end).abs() < 1e-4) {
            return None;
        }
        if line.reach[0] < *t && *t < line.reach[1] {
            wanted.extend(parameters(along(line.origin, unit, *t))?.map(Wanted::at));
        }
    }
    Some(wanted)
}

/// Coefficients of x^2 + y^2 - (slope z)^2 + shift along a line.
fn form(line: &Line, squares: Vector, shift: f64) -> [f64; 3] {
    let unit = line.direction.map(|x| x / norm(line.direction));
    let weigh = |v: Vector| [0, 1, 2].map(|k| squares[k] * v[k]);
    let (o, d) = (line.origin, unit);
    [dot(weigh(d), d), dot(weigh(o), d), dot(weigh(o), o) + shift]
}

fn check_all(
    name: &str,
    shape: &Shape,
    size: f64,
    most_left_out: f64,
    wanted: impl Fn(&Line) -> Option<Vec<Wanted>>,
) {
    let (r, mut log) = (&mut Random(99), Log::default());
    for _ in 0..QUERIES {
        let line = random_line(r, size);
        match wanted(&line) {
            None => log.leave_out(),
            Some(wanted) => check_line(&mut log, shape, &line, &wanted),
        }
    }
    log.close(name, most_left_out);
}

#[test]
fn spheres() {
    check_all("sphere", &Shape::Surface(sphere(2.0)), 3.0, 0.02, |line| {
        let places = quadratic(form(line, [1.0; 3], -4.0))?;
        members(line, &places, |p| {
            let rho = p[0].hypot(p[1]);
            (rho > 1e-3).then(|| Some([turn([p[0], p[1]]), rise([rho, p[2]])]))
        })
    });
}

#[test]
fn cylinders() {
    check_all("cylinder", &Shape::Surface(cylinder(1.0, 2.0)), 2.0, 0.02, |line| {
        let places = quadratic(form(line, [1.0, 1.0, 0.0], -1.0))?;
        members(line, &places, |p| {
            let is_doubtful = p[2].abs() < 1e-4 || (p[2] - 2.0).abs() < 1e-4;
            let inside = (0.0..2.0).contains(&p[2]);
            (!is_doubtful).then(|| inside.then(|| [turn([p[0], p[1]]), 0.5 * p[2]]))
        })
    });
}

#[test]
fn cones() {
    check_all("cone", &Shape::Surface(cone(1.0, 2.0)), 2.0, 0.03, |line| {
        let places = quadratic(form(line, [1.0, 1.0, -0.25], 0.0))?;
        members(line, &places, |p| {
            let is_doubtful = p[2].abs() < 1e-3 || (p[2] - 2.0).abs() < 1e-4;
            let inside = (0.0..2.0).contains(&p[2]);
            (!is_doubtful).then(|| inside.then(|| [turn([p[0], p[1]]), 0.5 * p[2]]))
        })
    });
}

/// Up to four crossings, by scanning the torus' equation along the line.
#[test]
fn tori() {
    check_all("torus", &Shape::Surface(torus(3.0, 1.0)), 3.0, 0.1, |line| {
        let unit = line.direction.map(|x| x / norm(line.direction));
        let value = |t: f64| {
            let p = along(line.origin, unit, t);
            let across = p[0].hypot(p[1]) - 3.0;
            across * across + p[2] * p[2] - 1.0
        };
        let found = zeros(value, [-12.0, 12.0], 1.0, 1e-2)?;
        let places: Vec<f64> = found.iter().map(|zero| zero.0).collect();
        members(line, &places, |p| {
            let rho = p[0].hypot(p[1]);
            Some(Some([turn([p[0], p[1]]), turn([rho - 3.0, p[2]])]))
        })
    });
}

/// Lines in the plane of a circle cross it twice or not at all; others meet it nowhere.
#[test]
fn circles() {
    let shape = Shape::Curve(ellipse(2.0, 2.0));
    let (r, mut log) = (&mut Random(98), Log::default());
    for k in 0..QUERIES {
        let mut line = random_line(r, 3.0);
        if k % 2 == 0 {
            (line.origin[2], line.direction[2]) = (0.0, 0.0);
        }
        let wanted = if line.direction[2] == 0.0 {
            let places = quadratic(form(&line, [1.0; 3], -4.0));
            places.and_then(|t| members(&line, &t, |p| Some(Some([turn([p[0], p[1]]), 0.0]))))
        } else {
            // Where the line crosses the plane.
            let p = along(line.origin, line.direction, -line.origin[2] / line.direction[2]);
            ((p[0].hypot(p[1]) - 2.0).abs() > 1e-3).then(Vec::new)
        };
        match wanted {
            None => log.leave_out(),
            Some(wanted) => check_line(&mut log, &shape, &line, &wanted),
        }
    }
    log.close("circle", 0.02);
}

#[test]
fn tangents_touch_once() {
    let (r, mut log) = (&mut Random(97), Log::default());
    let shapes = [sphere(2.0), cylinder(1.0, 2.0), torus(3.0, 1.0)].map(Shape::Surface);
    let round = Shape::Curve(ellipse(2.0, 2.0));
    for k in 0..QUERIES / 10 {
        let angle = r.between(0.0, std::f64::consts::TAU);
        let (s, c) = angle.sin_cos();
        let u = turn([c, s]);
        // Along the parallel: on the sphere's equator, the cylinder's middle, the torus' outer equator.
        let (rho, v, z) = [(2.0, 1.0, 0.0), (1.0, 0.5, 1.0), (4.0, 0.0, 0.0)][k % 3];
        let line = whole([rho * c + 5.0 * s, rho * s - 5.0 * c, z], [-s, c, 0.0]);
        let places: &[[f64; 2]] = if k % 3 == 2 { &[[u, 0.0], [u, 4.0]] } else { &[[u, v]] };
        let touching: Vec<Wanted> = places.iter().map(|at| Wanted::at(*at)).collect();
        let limits = Limits { parameters: 1e-3, distance: 1e-6 };
        let set = on_line(&shapes[k % 3], &line, 0.0, &QueryOptions::default());
        let broken = difference(&shapes[k % 3], &set, &touching, limits);
        log.put((line, "surface"), broken);
        let line = whole([2.0 * c + 5.0 * s, 2.0 * s - 5.0 * c, 0.0], [-s, c, 0.0]);
        let set = on_line(&round, &line, 0.0, &QueryOptions::default());
        log.put((line, "curve"), difference(&round, &set, &[Wanted::at([u, 0.0])], limits));
    }
    log.close("tangents", 0.0);
}

/// The generators of a cylinder lie in it: an arc of all heights.
#[test]
fn generators_are_arcs() {
    let (r, mut log) = (&mut Random(96), Log::default());
    let shape = Shape::Surface(cylinder(1.0, 2.0));
    for _ in 0..QUERIES / 10 {
        let (s, c) = r.between(0.05, 6.2).sin_cos();
        let line = whole([c, s, r.between(-9.0, 9.0)], [0.0, 0.0, r.scale(-2.0, 2.0)]);
        let wanted = [Wanted { kind: Kind::ArcV, ..Wanted::at([turn([c, s]), 0.0]) }];
        let limits = Limits { parameters: 1e-6, distance: 1e-6 };
        let set = on_line(&shape, &line, 0.0, &QueryOptions::default());
        log.put(line, difference(&shape, &set, &wanted, limits));
    }
    log.close("generators", 0.0);
}

/// A generator of a cone meets its tip, where every u belongs to it.
#[test]
fn a_generator_of_a_cone_is_complete_and_encloses() {
    let shape = Shape::Surface(cone(1.0, 1.0));
    let line = whole([0.0, 0.0, 0.0], [0.6, 0.8, 1.0]);
    let set = on_line(&shape, &line, 0.0, &QueryOptions::default());
    assert!(set.is_complete(), "{set:?}");
    let u = turn([0.6, 0.8]);
    let holds = |at: [f64; 2]| {
        let inside = |i: [f64; 2], x: f64| i[0] <= x && x <= i[1];
        set.members.iter().any(|m| inside(m.u, at[0]) && inside(m.v, at[1]))
    };
    assert!(
        (0..=10).all(|k| holds([u, 0.1 * k as f64]) && holds([0.4 * k as f64, 0.0])),
        "{set:?}"
    );
    assert!(set.members.iter().all(|m| m.kind != Kind::Point), "{set:?}");
}

/// A line through the axis of a sphere meets both collapsed poles.
#[test]
fn the_axis_of_a_sphere_meets_both_poles() {
    let shape = Shape::Surface(sphere(2.0));
    let line = whole([0.0, 0.0, -7.0], [0.0, 0.0, 2.0]);
    let arc = |v: f64| Wanted { kind: Kind::ArcU, ..Wanted::at([0.0, v]) };
    let set = on_line(&shape, &line, 0.0, &QueryOptions::default());
    assert_eq!(difference(&shape, &set, &[arc(0.0), arc(2.0)], CROSSING), None);
    assert_eq!(set.members.iter().map(|m| m.foot.v).collect::<Vec<_>>(), [0.0, 2.0]);
    let ray = Line { reach: [7.0, f64::INFINITY], ..line };
    let set = on_line(&shape, &ray, 0.0, &QueryOptions::default());
    assert_eq!(difference(&shape, &set, &[arc(2.0)], CROSSING), None);
}

/// In the order along the line, not of the parameters; backwards when the direction is reversed.
#[test]
fn members_come_in_the_order_along_the_line() {
    let shape = Shape::Surface(torus(3.0, 1.0));
    for sign in [1.0, -1.0] {
        let line = whole([0.1, 0.2, 0.3], [sign, 0.0, 0.0]);
        let set = on_line(&shape, &line, 0.0, &QueryOptions::default());
        assert_eq!(set.members.len(), 4);
        assert!(
            set.members.windows(2).all(|p| sign * p[0].foot.point[0] < sign * p[1].foot.point[0])
        );
    }
    let line = whole([1.0, -3.0, 0.0], [0.0, 1.0, 0.0]);
    let set = on_line(&Shape::Curve(crossing_loop()), &line, 0.0, &QueryOptions::default());
    // The line meets the crossing, with both branches.
    assert_eq!(set.members.len(), 2, "{set:?}");
    assert_eq!(set.members.iter().map(|m| m.foot.u.signum()).collect::<Vec<_>>(), [-1.0, 1.0]);
}

#[test]
fn lines_that_are_none_are_refused_by_name() {
    let shape = sphere(1.0);
    let good = whole([0.0; 3], [1.0, 0.0, 0.0]);
    let refused = |line: Line, words: &str| {
        let found = shape.on_line(&line, 0.0, &QueryOptions::default(), &mut || false);
        let text = found.expect_err("a refusal").to_string();
        assert!(text.contains(words), "{text}");
    };
    refused(Line { origin: [0.0, f64::NAN, 0.0], ..good }, "origin: entry 1");
    refused(Line { direction: [0.0; 3], ..good }, "direction");
    refused(Line { direction: [0.0, 0.0, f64::INFINITY], ..good }, "direction: entry 2");
    refused(Line { reach: [1.0, 0.0], ..good }, "reach");
    refused(Line { reach: [f64::NAN, 0.0], ..good }, "reach");
}
