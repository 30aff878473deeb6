//! Ties and continua: set where another foot is as near within the accuracy, not set where there is none.

mod shapes;

use footpoint::closest::{FootPoint, QueryOptions, Workspace, flag};
use footpoint::curve::Curve;
use footpoint::index::{IndexedCurve, IndexedSurface};
use footpoint::surface::Surface;
use shapes::asked::Shape;
use shapes::{FAMILIES, Random, Vector, along, norm, sub};

const HALF: f64 = std::f64::consts::FRAC_1_SQRT_2;
const BOTH: u32 = flag::TIE | flag::CONTINUUM;

fn ask(shape: &Shape, query: Vector) -> FootPoint {
    shape.ask(query, None, &QueryOptions::default())
}

fn within(shape: &Shape, query: Vector, accuracy: f64) -> FootPoint {
    shape.ask(query, None, &QueryOptions { accuracy, ..QueryOptions::default() })
}

fn curve(knots: &[f64], degree: usize, poles: &[Vector], weights: Option<&[f64]>) -> Shape {
    Shape::Curve(IndexedCurve::new(Curve::new(knots, degree, poles, weights).expect("a curve")))
}

fn surface(
    (knots_u, knots_v): (&[f64], &[f64]),
    degrees: [usize; 2],
    counts: [usize; 2],
    poles: &[Vector],
    weights: Option<&[f64]>,
) -> Shape {
    let [p, q] = degrees;
    let made = Surface::new(knots_u, knots_v, p, q, poles, counts[0], counts[1], weights);
    Shape::Surface(IndexedSurface::new(made.expect("a surface")))
}

const RING: [[f64; 3]; 9] = [
    [1., 0., 1.],
    [1., 1., HALF],
    [0., 1., 1.],
    [-1., 1., HALF],
    [-1., 0., 1.],
    [-1., -1., HALF],
    [0., -1., 1.],
    [1., -1., HALF],
    [1., 0., 1.],
];
const RING_KNOTS: [f64; 12] = [0., 0., 0., 1., 1., 2., 2., 3., 3., 4., 4., 4.];

fn ellipse(a: f64, b: f64) -> Shape {
    let poles = RING.map(|[x, y, _]| [a * x, b * y, 0.]);
    curve(&RING_KNOTS, 2, &poles, Some(&RING.map(|[_, _, w]| w)))
}

/// A meridian (radius, height, weight) turned about the z axis.
fn turned(knots_v: &[f64], degree_v: usize, meridian: &[[f64; 3]]) -> Shape {
    let (mut poles, mut weights) = (Vec::new(), Vec::new());
    for [x, y, w] in RING {
        for [radius, z, weight] in meridian {
            poles.push([radius * x, radius * y, *z]);
            weights.push(w * weight);
        }
    }
    let counts = [9, meridian.len()];
    surface((&RING_KNOTS, knots_v), [2, degree_v], counts, &poles, Some(&weights))
}

fn sphere() -> Shape {
    let half = [[0., -1., 1.], [1., -1., HALF], [1., 0., 1.], [1., 1., HALF], [0., 1., 1.]];
    turned(&[0., 0., 0., 1., 1., 2., 2., 2.], 2, &half)
}

fn cylinder() -> Shape {
    turned(&[0., 0., 1., 1.], 1, &[[1., -1., 1.], [1., 1., 1.]])
}

fn cone() -> Shape {
    turned(&[0., 0., 1., 1.], 1, &[[0., 0., 1.], [2., 2., 1.]])
}

/// Radii 2 and 0.5.
fn torus() -> Shape {
    let tube = RING.map(|[x, y, w]| [2.0 + 0.5 * x, 0.5 * y, w]);
    turned(&RING_KNOTS, 2, &tube)
}

/// The two sheets z = 0 and z = 1, joined at x = 1: a fold of degree 1.
fn sheets() -> Shape {
    let mut poles = Vec::new();
    for [x, z] in [[0., 0.], [1., 0.], [1., 1.], [0., 1.]] {
        poles.extend([[x, 0., z], [x, 1., z]]);
    }
    surface((&[0., 0., 1., 2., 3., 3.], &[0., 0., 1., 1.]), [1, 1], [4, 2], &poles, None)
}

fn check(name: &str, shape: &Shape, query: Vector, distance: f64, flags: u32) {
    let foot = ask(shape, query);
    assert!((foot.distance - distance).abs() < 4e-16 * (1.0 + distance), "{name}: {foot:?}");
    assert_eq!(foot.flags & (BOTH | flag::NOT_PROVEN), flags, "{name} {query:?}: {foot:?}");
}

#[test]
fn centres_and_axes_are_continua() {
    check("sphere", &sphere(), [0.; 3], 1.0, BOTH);
    for z in [0.0, 0.4, -3.0] {
        check("circle", &ellipse(1., 1.), [0., 0., z], z.hypot(1.0), BOTH);
    }
    for z in [-0.9, -0.2, 0.0, 0.7] {
        check("cylinder", &cylinder(), [0., 0., z], 1.0, BOTH);
    }
    for z in [0.1, 0.5, 1.0, 1.9] {
        check("cone", &cone(), [0., 0., z], HALF * z, BOTH);
    }
    for z in [0.0, 0.2, 1.0, -4.0] {
        check("torus axis", &torus(), [0., 0., z], z.hypot(2.0) - 0.5, BOTH);
    }
    for [c, s] in [[1.0, 0.0], [0.6, 0.8], [-0.28, 0.96]] {
        check("torus core", &torus(), [2.0 * c, 2.0 * s, 0.], 0.5, BOTH);
    }
}

/// A cylinder of radius 1 from z = 0 whose upper rim has these heights at the poles; `swapped`: u is the height.
fn wall(heights: [f64; 9], swapped: bool) -> Shape {
    let sides = [[0.0; 9], heights];
    let pole = |n: usize, k: usize| [RING[k][0], RING[k][1], sides[n][k]];
    let line = [0., 0., 1., 1.];
    let rows: Vec<(usize, usize)> = if swapped {
        (0..2).flat_map(|n| (0..9).map(move |k| (n, k))).collect()
    } else {
        (0..9).flat_map(|k| (0..2).map(move |n| (n, k))).collect()
    };
    let poles: Vec<Vector> = rows.iter().map(|&(n, k)| pole(n, k)).collect();
    let weights: Vec<f64> = rows.iter().map(|&(_, k)| RING[k][2]).collect();
    if swapped {
        surface((&line, &RING_KNOTS), [1, 2], [2, 9], &poles, Some(&weights))
    } else {
        surface((&RING_KNOTS, &line), [2, 1], [9, 2], &poles, Some(&weights))
    }
}

#[test]
fn thin_rings_are_continua_and_wavy_rims_are_not() {
    for swapped in [false, true] {
        for height in [1.0, 1e-2, 1e-3, 1e-4, 1e-5] {
            let ring = wall([height; 9], swapped);
            check("ring", &ring, [0., 0., 0.5 * height], 1.0, BOTH);
            check("rim", &ring, [0., 0., 2.0], (2.0 - height).hypot(1.0), BOTH);
        }
        // Straight to the eye, but two crests are nearest.
        for wave in [3e-9, 1e-6, 1e-3] {
            let [top, low] = [1.0 + wave, 1.0 - wave];
            let wavy = wall([top, 1.0, low, 1.0, top, 1.0, low, 1.0, top], swapped);
            check("crests", &wavy, [0., 0., 3.0], (3.0 - top).hypot(1.0), flag::TIE);
        }
    }
}

#[test]
fn a_short_arc_is_a_continuum_too() {
    // Points of the unit circle between the angles -+2 atan(0.01), and its chord's half length as a bulge.
    let t: f64 = 0.01;
    let (c, s) = ((1.0 - t * t) / (1.0 + t * t), 2.0 * t / (1.0 + t * t));
    let poles = [[c, -s, 0.], [1.0 / c, 0., 0.], [c, s, 0.]];
    let arc = curve(&[0., 0., 0., 1., 1., 1.], 2, &poles, Some(&[1.0, c, 1.0]));
    let foot = within(&arc, [0.; 3], 1e-10);
    assert_eq!(foot.flags & (BOTH | flag::NOT_PROVEN), BOTH, "{foot:?}");
    let foot = within(&arc, [0.3, 0., 0.], 1e-10);
    assert_eq!(foot.flags & (BOTH | flag::NOT_PROVEN), 0, "{foot:?}");
}

#[test]
fn off_centres_and_axes_by_ten_accuracies_there_is_one_foot() {
    for (name, shape, centre) in [
        ("sphere", sphere(), [0.; 3]),
        ("circle", ellipse(1., 1.), [0., 0., 0.5]),
        ("cylinder", cylinder(), [0., 0., 0.1]),
        ("cone", cone(), [0., 0., 0.7]),
        ("torus axis", torus(), [0., 0., 0.3]),
        ("torus core", torus(), [2., 0., 0.]),
    ] {
        let accuracy = 1e-10 * shape.diagonal();
        for direction in [[0.6, 0.8, 0.], [-0.8, 0.6, 0.], [1., 0., 0.], [0., -1., 0.]] {
            if name == "torus core" && direction[0] == 0.0 {
                continue;
            }
            // Rivals 90 degrees away are farther by the whole move.
            let foot = ask(&shape, along(centre, direction, 10.0 * accuracy));
            assert_eq!(foot.flags & (flag::TIE | flag::NOT_PROVEN), 0, "{name}: {foot:?}");
        }
    }
}

#[test]
fn points_between_two_feet_are_ties_and_points_beside_are_not() {
    let (fold, oval) = (sheets(), ellipse(2.0, 1.0));
    let mut places = Vec::new();
    for [x, y] in [[0.1, 0.5], [0.25, 0.1], [0.4, 0.99], [0.0, 0.0]] {
        places.push((&fold, [x, y, 0.5], [0., 0., 1.], 0.5));
    }
    // On the long axis between the centres of curvature: b sqrt(1 - x^2 / (a^2 - b^2)).
    for x in [0.0f64, 0.5, -0.7, 1.2, 1.45] {
        places.push((&oval, [x, 0., 0.], [0., 1., 0.], (1.0 - x * x / 3.0).sqrt()));
    }
    for (shape, query, aside, distance) in places {
        let foot = ask(shape, query);
        assert!((foot.distance - distance).abs() < 1e-15, "{foot:?}");
        assert_eq!(foot.flags & (BOTH | flag::NOT_PROVEN), flag::TIE, "{query:?}: {foot:?}");
        for step in [10.0, -10.0] {
            let beside = along(query, aside, step * 1e-10 * shape.diagonal());
            let foot = ask(shape, beside);
            assert_eq!(foot.flags & (BOTH | flag::NOT_PROVEN), 0, "{beside:?}: {foot:?}");
        }
    }
}

#[test]
fn the_vertex_of_an_ellipse_is_alone_beyond_its_centre_of_curvature() {
    let oval = ellipse(2.0, 1.0);
    for x in [1.51, 1.6, 1.9, 2.5, -1.7] {
        check("ellipse", &oval, [x, 0., 0.], (2.0 - x.abs()).abs(), 0);
    }
    let foot = ask(&oval, [1.5, 0., 0.]);
    assert!((foot.distance - 0.5).abs() < 1e-15 && foot.flags & flag::NOT_PROVEN == 0);
}

#[test]
fn feet_on_borders_corners_creases_and_other_patches_tie() {
    // A square plate of 3 x 3 patches with a hole in the query's way: two opposite edges are equally near.
    let arch = |x: f64| [x, 0.0, if x == 0.5 { -2.0 } else { 0.0 }];
    let poles: Vec<Vector> = [0.0, 0.5, 1.0]
        .into_iter()
        .flat_map(|x| [0.0, 1.0].map(|y| along(arch(x), [0., 1., 0.], y)))
        .collect();
    let roof = surface((&[0., 0., 1., 2., 2.], &[0., 0., 1., 1.]), [1, 1], [3, 2], &poles, None);
    for y in [0.2, 0.5, 0.8] {
        check("border edges", &roof, [0.5, y, 1.0], 0.5f64.hypot(1.0), flag::TIE);
    }
    check("corners", &roof, [0.5, -0.25, 1.0], (1.0f64 + 0.25 + 0.0625).sqrt(), flag::TIE);
    check("one corner", &roof, [0.4, -0.25, 1.0], (1.0f64 + 0.16 + 0.0625).sqrt(), 0);
    // The ridges of a W: creases at x = 1 and x = 3.
    let zigzag: Vec<Vector> =
        (0..5).flat_map(|i| [0.0, 1.0].map(|y| [f64::from(i), y, f64::from(i % 2)])).collect();
    let knots = [0., 0., 1., 2., 3., 4., 4.];
    let roof = surface((&knots, &[0., 0., 1., 1.]), [1, 1], [5, 2], &zigzag, None);
    check("creases", &roof, [2.0, 0.5, 3.0], 5f64.sqrt(), flag::TIE);
    check("one crease", &roof, [1.9, 0.5, 3.0], 0.9f64.hypot(2.0), 0);
    check("two slopes", &roof, [2.0, 0.5, 0.5], 0.125f64.sqrt(), flag::TIE);
}

#[test]
fn a_seam_is_one_foot() {
    let (tube, ball) = (cylinder(), sphere());
    for query in [[3., 0., 0.2], [0.4, 0., 0.2], [0.9, 0., -0.3]] {
        assert_eq!(ask(&tube, query).flags & BOTH, 0);
        assert_eq!(ask(&ball, query).flags & BOTH, 0);
    }
    for z in [-2.0, -0.5, 0.3, 3.0] {
        assert_eq!(ask(&ball, [0., 0., z]).flags & (BOTH | flag::NOT_PROVEN), 0);
    }
    assert_eq!(ask(&ellipse(1., 1.), [2., 0., 0.]).flags & BOTH, 0);
    assert_eq!(ask(&ellipse(2., 1.), [2.5, 0., 0.]).flags & BOTH, 0);
}

#[test]
fn a_point_of_the_shape_has_no_tie_even_where_the_shape_meets_itself() {
    // A figure eight of one cubic: its crossing has one point and two parameters.
    let poles = [[0., 0., 0.], [3., 2., 0.], [-2., 2., 0.], [1., 0., 0.]];
    let loop_ = curve(&[0., 0., 0., 0., 1., 1., 1., 1.], 3, &poles, None);
    let crossing = ask(&loop_, [0.5, 0.55, 0.]);
    assert_ne!(crossing.flags & flag::TIE, 0, "between two strands: {crossing:?}");
    let foot = ask(&loop_, crossing.point);
    assert_eq!(foot.flags & (BOTH | flag::NOT_PROVEN), 0, "{foot:?}");
}

/// Mirrors a random shape at the plane x = 0, so that feet come in pairs.
fn mirrored(seed: u64) -> Shape {
    let r = &mut Random(seed);
    let (p, half) = (r.whole(1, 4), r.whole(2, 4));
    let rows = (2 * half).max(p + 1);
    let columns = if seed.is_multiple_of(3) { 1 } else { r.whole(2, 5) };
    let q = r.whole(1, 3).min(columns - 1).max(1);
    let (mut poles, mut weights) = (vec![[0.; 3]; rows * columns], vec![1.0; rows * columns]);
    for i in 0..rows.div_ceil(2) {
        for j in 0..columns {
            let pole = along([0.2 * i as f64, 0.5 * j as f64, 0.], r.vector(), 0.7);
            let weight = if seed.is_multiple_of(2) { r.between(0.3, 3.0) } else { 1.0 };
            let last = rows - 1 - i;
            let x = if last == i { 0.0 } else { pole[0] };
            poles[i * columns + j] = [x, pole[1], pole[2]];
            poles[last * columns + j] = [-x, pole[1], pole[2]];
            weights[i * columns + j] = weight;
            weights[last * columns + j] = weight;
        }
    }
    let knots = |p: usize, n: usize| -> Vec<f64> {
        (0..n + p + 1).map(|i| (i.clamp(p, n) - p) as f64).collect()
    };
    if columns == 1 {
        return curve(&knots(p, rows), p, &poles, Some(&weights));
    }
    let (u, v) = (knots(p, rows), knots(q, columns));
    surface((&u, &v), [p, q], [rows, columns], &poles, Some(&weights))
}

#[test]
fn feet_that_mirror_each_other_tie_on_the_mirror_and_not_beside_it() {
    let (mut pairs, mut singles) = (0, 0);
    for seed in 0..400 {
        let shape = mirrored(seed);
        let r = &mut Random(seed + 1000);
        let accuracy = 1e-10 * shape.diagonal();
        for _ in 0..8 {
            let [_, y, z] = r.vector().map(|x| 2.0 * x);
            let foot = ask(&shape, [0.0, y, z]);
            assert_eq!(foot.flags & flag::NOT_PROVEN, 0, "{seed}: {foot:?}");
            let apart = 2.0 * foot.point[0].abs();
            let told = 20.0 * (accuracy * foot.distance).sqrt();
            if apart > told {
                assert_eq!(foot.flags & BOTH, flag::TIE, "{seed} {y} {z}: {foot:?}");
                pairs += 1;
                // The mirrored foot is farther by 2 x |x| / d.
                let x = foot.point[0].signum() * 10.0 * accuracy * foot.distance / apart;
                let beside = ask(&shape, [x, y, z]);
                assert_eq!(beside.flags & BOTH, 0, "{seed} {x} {y} {z}: {beside:?}");
            } else if apart < 1e-12 {
                assert_eq!(foot.flags & flag::CONTINUUM, 0, "{seed} {y} {z}: {foot:?}");
                singles += 1;
            }
        }
    }
    assert!(pairs > 1000 && singles > 100, "{pairs} {singles}");
}

/// What feet must tie within when queries are no finer than doubles.
fn tie_width(shape: &Shape) -> f64 {
    let (low, high) = shape.bounding_box();
    let largest = low.iter().chain(&high).fold(0.0, |m: f64, x| m.max(x.abs()));
    (1e-10 * shape.diagonal()).max(64.0 * f64::EPSILON * largest)
}

/// The last two doubles' worth of a stretch on which the foot jumps, by bisection.
fn jump(shape: &Shape, mut a: Vector, mut b: Vector) -> Option<[FootPoint; 2]> {
    let accuracy = tie_width(shape);
    let far = |a: &FootPoint, b: &FootPoint| norm(sub(a.point, b.point));
    let (mut foot_a, mut foot_b) = (within(shape, a, accuracy), within(shape, b, accuracy));
    for _ in 0..60 {
        let middle = [0, 1, 2].map(|k| 0.5 * (a[k] + b[k]));
        if middle == a || middle == b {
            break;
        }
        let foot = within(shape, middle, accuracy);
        if far(&foot_a, &foot) >= far(&foot, &foot_b) {
            (b, foot_b) = (middle, foot);
        } else {
            (a, foot_a) = (middle, foot);
        }
    }
    let told = 50.0 * (accuracy * (foot_a.distance + accuracy)).sqrt();
    (far(&foot_a, &foot_b) > told.max(1e-6 * shape.diagonal())).then_some([foot_a, foot_b])
}

#[test]
fn where_the_foot_jumps_there_is_a_tie() {
    let mut found = 0;
    for family in 0..FAMILIES.len() {
        for seed in 0..16 {
            let shape = Shape::new(family, seed);
            let r = &mut Random(seed);
            for _ in 0..4 {
                let (a, b) = (shape.query(r), shape.query(r));
                let Some(feet) = jump(&shape, a, b) else { continue };
                for foot in feet.iter().filter(|foot| foot.flags & flag::NOT_PROVEN == 0) {
                    let name = FAMILIES[family].name;
                    assert_ne!(foot.flags & flag::TIE, 0, "{name} {seed}: {feet:?}");
                    found += 1;
                }
            }
        }
    }
    assert!(found > 500, "{found}");
}

#[test]
fn a_random_point_has_one_foot() {
    let mut tied = Vec::new();
    for family in 0..FAMILIES.len() {
        for seed in 0..24 {
            let shape = Shape::new(family, seed);
            let (r, diagonal) = (&mut Random(seed), shape.diagonal());
            let (low, high) = shape.bounding_box();
            for _ in 0..20 {
                let query =
                    [0, 1, 2].map(|k| r.between(low[k] - 0.3 * diagonal, high[k] + 0.3 * diagonal));
                let foot = ask(&shape, query);
                if foot.flags & flag::TIE != 0 && foot.flags & flag::NOT_PROVEN == 0 {
                    tied.push((FAMILIES[family].name, seed, query, foot));
                }
            }
        }
    }
    assert!(tied.len() <= 3, "{tied:?}");
}

#[test]
fn ties_do_not_depend_on_the_workspace() {
    let mut workspace = Workspace::default();
    for seed in 0..40 {
        let shape = mirrored(seed);
        let query = [0.0, 0.3, 0.4];
        let options = QueryOptions::default();
        let used = shape.ask_with(query, None, &options, &mut workspace);
        assert_eq!(used, ask(&shape, query));
    }
}

/// A sphere or a torus whose poles are moved by `size`, so that its centre or core sees an almost-continuum.
fn jittered(round: bool, size: f64, seed: u64) -> Shape {
    let Shape::Surface(exact) = (if round { sphere() } else { torus() }) else { unreachable!() };
    let (exact, r) = (exact.surface(), &mut Random(seed));
    let poles: Vec<Vector> = exact.poles().iter().map(|p| along(*p, r.vector(), size)).collect();
    let (u, v) = (exact.knots_u(), exact.knots_v());
    let (counts, degrees) = ([u.pole_count(), v.pole_count()], [u.degree(), v.degree()]);
    surface((u.values(), v.values()), degrees, counts, &poles, exact.weights())
}

#[test]
fn near_focal_points_and_almost_continua_the_work_is_bounded_and_the_bound_honest() {
    let (mut most, mut open, mut asked) = (0, 0, 0);
    for (k, size) in [1e-3, 1e-5, 1e-7, 1e-9, 1e-11, 1e-13].into_iter().enumerate() {
        for seed in 0..4 {
            let (ball, ring) = (jittered(true, size, seed), jittered(false, size, seed));
            let r = &mut Random(17 * seed + k as u64);
            for _ in 0..6 {
                let off = r.vector().map(|x| x * size * r.scale(-3.0, 1.0));
                for (shape, query) in
                    [(&ball, off), (&ring, along([2., 0., 0.], off, 1.0)), (&ring, off)]
                {
                    let foot = ask(shape, query);
                    assert!(foot.lower_bound <= foot.distance);
                    let gap = foot.distance - foot.lower_bound;
                    let proven = foot.flags & flag::NOT_PROVEN == 0;
                    assert!(!proven || gap <= 1.01e-10 * shape.diagonal(), "{size} {foot:?}");
                    most = most.max(foot.iterations);
                    open += usize::from(!proven);
                    asked += 1;
                }
            }
        }
    }
    assert!(most <= 2_000, "{most} evaluations");
    assert!(100 * open <= 2 * asked, "{open} of {asked} are not proven");
}
