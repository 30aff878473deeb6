//! Stationary points of shapes that are known in closed form: exactly the known sets, for random points.

mod closed_forms;
mod sets;
mod shapes;

use closed_forms::{cone, cylinder, double_circle, ellipse, sphere, torus};
use footpoint::extrema::ExtremaOptions;
use footpoint::set::Nature::{self, Maximum, Minimum, Saddle};
use sets::known::{EIGHT, LOOP, crossing_loop, eight, on_plane_curve, rise, turn, zeros};
use sets::{CLOSE, Log, QUERIES, Wanted, check_extrema};
use shapes::asked::Shape;
use shapes::{Random, Vector, norm};

fn all() -> ExtremaOptions {
    ExtremaOptions::default()
}

/// Asks for all stationary points at many random queries in a cube; `wanted` leaves some out with `None`.
fn check_all(
    name: &str,
    shape: &Shape,
    size: f64,
    most_left_out: f64,
    wanted: impl Fn(Vector) -> Option<Vec<Wanted>>,
) {
    let (r, mut log) = (&mut Random(20_250), Log::default());
    for _ in 0..QUERIES {
        let query = r.vector().map(|x| size * x);
        match wanted(query) {
            None => log.leave_out(),
            Some(wanted) => check_extrema(&mut log, shape, query, &all(), &wanted, CLOSE),
        }
    }
    log.close(name, most_left_out);
}

fn reversed([x, y]: [f64; 2]) -> [f64; 2] {
    [-x, -y]
}

#[test]
fn circle() {
    let radius = 1.5;
    check_all("circle", &Shape::Curve(ellipse(radius, radius)), 4.0, 1e-3, |p| {
        let rho = p[0].hypot(p[1]);
        let member = |direction: [f64; 2], nature: Nature, across: f64| {
            Wanted::point([turn(direction), 0.0], nature, across.hypot(p[2]))
        };
        (rho > 1e-3).then(|| {
            vec![
                member([p[0], p[1]], Minimum, rho - radius),
                member([-p[0], -p[1]], Maximum, rho + radius),
            ]
        })
    });
}

#[test]
fn double_covered_circle() {
    check_all("double circle", &Shape::Curve(double_circle(2.0)), 4.0, 1e-3, |p| {
        let rho = p[0].hypot(p[1]);
        let (near, far) = (turn([p[0], p[1]]), turn([-p[0], -p[1]]));
        let member = |u: f64, nature: Nature, across: f64| {
            Wanted::point([u, 0.0], nature, across.hypot(p[2]))
        };
        (rho > 1e-3).then(|| {
            vec![
                member(near, Minimum, rho - 2.0),
                member(near + 4.0, Minimum, rho - 2.0),
                member(far, Maximum, rho + 2.0),
                member(far + 4.0, Maximum, rho + 2.0),
            ]
        })
    });
}

/// Two to four points. Queries within a thousandth of the evolute, where two of them meet, are left out.
#[test]
fn ellipses() {
    for (a, b) in [(2.0, 1.0), (1.0, 3.0), (1.0, 0.9), (10.0, 1.0)] {
        let shape = Shape::Curve(ellipse(a, b));
        check_all("ellipse", &shape, 1.2 * f64::max(a, b), 0.05, |p| {
            let evolute = (a * p[0]).abs().cbrt().powi(2) + (b * p[1]).abs().cbrt().powi(2);
            let limit = (a * a - b * b).abs().cbrt().powi(2);
            if (evolute / limit - 1.0).abs() < 1e-3 {
                return None;
            }
            let slope = |angle: f64| {
                let (s, c) = angle.sin_cos();
                (b * b - a * a) * s * c + a * p[0] * s - b * p[1] * c
            };
            // The scan begins off the axes, where many zeros lie.
            let found = zeros(slope, [0.1, 0.1 + std::f64::consts::TAU], 1.0, 0.0)?;
            let member = |&(angle, rises): &(f64, bool)| {
                let (s, c) = angle.sin_cos();
                let distance = (a * c - p[0]).hypot(b * s - p[1]).hypot(p[2]);
                let nature = if rises { Minimum } else { Maximum };
                Wanted::point([turn([c, s]), 0.0], nature, distance)
            };
            assert!(matches!((found.len(), evolute < limit), (4, true) | (2, false)));
            Some(found.iter().map(member).collect())
        });
    }
}

#[test]
fn figure_eight() {
    check_all("figure eight", &Shape::Curve(eight()), 1.0, 0.1, |p| {
        on_plane_curve(&EIGHT[0], &EIGHT[1], [-1.0, 1.0], true, p)
    });
}

#[test]
fn open_loop() {
    check_all("loop", &Shape::Curve(crossing_loop()), 2.0, 0.1, |p| {
        on_plane_curve(&LOOP[0], &LOOP[1], [-1.5, 1.25], false, p)
    });
}

#[test]
fn spheres() {
    for radius in [1.0, 3.0] {
        let shape = Shape::Surface(sphere(radius));
        check_all("sphere", &shape, 2.0 * radius, 1e-3, |p| {
            let (rho, distance) = (p[0].hypot(p[1]), norm(p));
            let at = |x: [f64; 2], z: f64| [turn(x), rise([rho, z])];
            (rho > 1e-3).then(|| {
                let far = [-p[0], -p[1]];
                vec![
                    Wanted::point(at([p[0], p[1]], p[2]), Minimum, (distance - radius).abs()),
                    Wanted::point(at(far, -p[2]), Maximum, distance + radius),
                ]
            })
        });
    }
}

/// On each of the two meridians that the query's plane cuts out, the nearest and the farthest place.
#[test]
fn tori() {
    for (large, small) in [(3.0, 1.0), (5.0, 0.5), (1.1, 1.0)] {
        let shape = Shape::Surface(torus(large, small));
        check_all("torus", &shape, 2.0 * large, 0.02, |p| {
            let (rho, z) = (p[0].hypot(p[1]), p[2]);
            let (near, far) = ([rho - large, z], [-rho - large, z]);
            if rho < 1e-3 || near[0].hypot(near[1]) < 1e-3 || far[0].hypot(far[1]) < 1e-3 {
                return None;
            }
            let member = |x: [f64; 2], ring: [f64; 2], nature: Nature, across: f64| {
                Wanted::point([turn(x), turn(ring)], nature, across.abs())
            };
            let (toward, away) = ([p[0], p[1]], [-p[0], -p[1]]);
            let lengths = [near[0].hypot(near[1]), far[0].hypot(far[1])];
            Some(vec![
                member(toward, near, Minimum, lengths[0] - small),
                member(toward, reversed(near), Saddle, lengths[0] + small),
                member(away, far, Saddle, lengths[1] - small),
                member(away, reversed(far), Maximum, lengths[1] + small),
            ])
        });
    }
}

/// What a point is that is least (or greatest) along two directions.
fn nature(first_is_least: bool, second_is_least: bool) -> Nature {
    match (first_is_least, second_is_least) {
        (true, true) => Minimum,
        (false, false) => Maximum,
        _ => Saddle,
    }
}

/// Two inside where the height allows it, two on each border.
#[test]
fn cylinders() {
    for (radius, height) in [(1.0, 2.0), (2.0, 0.5), (0.2, 5.0)] {
        let shape = Shape::Surface(cylinder(radius, height));
        check_all("cylinder", &shape, 1.5 * f64::max(radius, height), 0.01, |p| {
            let (rho, z) = (p[0].hypot(p[1]), p[2]);
            if rho < 1e-3 || z.abs() < 1e-6 || (z - height).abs() < 1e-6 {
                return None;
            }
            let mut wanted = Vec::new();
            for (is_near, x) in [(true, [p[0], p[1]]), (false, [-p[0], -p[1]])] {
                let across = if is_near { rho - radius } else { rho + radius };
                let mut put = |v: f64, is_least: bool| {
                    let distance = across.hypot(z - v * height);
                    wanted.push(Wanted::point([turn(x), v], nature(is_near, is_least), distance));
                };
                put(0.0, z < 0.0);
                put(1.0, z > height);
                if (0.0..height).contains(&z) {
                    put(z / height, true);
                }
            }
            Some(wanted)
        });
    }
}

/// On the two generators in the query's plane: feet inside, ends on the border; the tip when the distance rises or falls
/// along all generators.
#[test]
fn cones() {
    for (radius, height) in [(1.0, 1.0), (0.3, 2.0), (3.0, 1.0)] {
        let shape = Shape::Surface(cone(radius, height));
        check_all("cone", &shape, 2.0 * f64::max(radius, height), 0.01, |p| {
            let (rho, square) = (p[0].hypot(p[1]), radius * radius + height * height);
            let feet = [rho, -rho].map(|x| (x * radius + p[2] * height) / square);
            if rho < 1e-3 || feet.iter().any(|v| v.abs() < 1e-4 || (v - 1.0).abs() < 1e-4) {
                return None;
            }
            let mut wanted = Vec::new();
            for (is_near, x, foot) in
                [(true, [p[0], p[1]], feet[0]), (false, [-p[0], -p[1]], feet[1])]
            {
                let across = if is_near { rho } else { -rho };
                let mut put = |v: f64, is_least: bool| {
                    let distance = (across - v * radius).hypot(p[2] - v * height);
                    wanted.push(Wanted::point([turn(x), v], nature(is_near, is_least), distance));
                };
                put(1.0, foot > 1.0);
                if (0.0..1.0).contains(&foot) {
                    put(foot, true);
                }
            }
            let tip =
                |nature: Nature| Wanted::of(footpoint::set::Kind::ArcU, [0.0; 2], nature, norm(p));
            if feet[0] < 0.0 {
                wanted.push(tip(Minimum));
            } else if feet[1] > 0.0 {
                wanted.push(tip(Maximum));
            }
            Some(wanted)
        });
    }
}
