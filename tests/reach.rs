//! The bounds by which a foot settles a search, against places all over the surface.

#[path = "cases/mod.rs"]
#[allow(dead_code, reason = "shapes only")]
mod cases;

use cases::{Case, Shape};
use footpoint::bounds::{Vector, add, cross, dot, norm, scaled, sub};
use footpoint::index::{IndexedCurve, IndexedSurface, RINGS, SurfaceIndex};
use footpoint::simd::Level;

/// Places on each surface whose bounds are checked, and places that each is checked against, all over and near by.
const PLACES: usize = 40;
/// Queries on the normal of each place, both ways.
const QUERIES: usize = 6;
const OTHERS: usize = 250;
const NEAR: usize = 50;

/// Places on each curve.
const CURVE_PLACES: usize = 200;

/// Numbers in [0, 1) that are the same every time.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }
}

/// A place in the index's coordinates, with its unit normal and its outward conormal for a side.
struct Place {
    point: Vector,
    normal: Vector,
    outward: [Vector; 4],
    /// By u and v.
    tangents: [Vector; 2],
}

fn place(shape: &IndexedSurface, u: f64, v: f64) -> Place {
    let mut jet = [[0.0; 3]; 3];
    shape.surface().partials(u, v, 1, &mut jet);
    let index = shape.index(&mut || false).unwrap();
    let unit = |x: Vector| scaled(x, 1.0 / norm(x));
    let away = |a: Vector, b: Vector| unit(sub(a, scaled(b, dot(a, b) / dot(b, b))));
    let (across_u, across_v) = (away(jet[1], jet[2]), away(jet[2], jet[1]));
    Place {
        point: index.frame.enter(jet[0]),
        normal: unit(cross(jet[1], jet[2])),
        outward: [scaled(across_u, -1.0), across_u, scaled(across_v, -1.0), across_v],
        tangents: [1, 2].map(|k| scaled(jet[k], index.frame.scale)),
    }
}

/// What is beside a place on a side, or in the corner of two, is bounded for queries outward: checks of those that boxes leave.
struct Beside {
    query: Vector,
    far: f64,
    /// Unit vector to the query.
    direction: Vector,
    bound: f64,
}

impl Beside {
    /// A query from a place of patch `k` on sides, where something is known of it.
    fn new(
        index: &SurfaceIndex,
        (here, k, at): (&Place, usize, [f64; 2]),
        sides: &[usize],
        random: &mut Random,
    ) -> Option<Self> {
        let reach = index.reach.as_ref()?;
        let size = |random: &mut Random| random.next() * 0.5f64.powi((random.next() * 12.0) as i32);
        let mut w =
            scaled(here.normal, size(random) * if random.next() < 0.5 { 1.0 } else { -1.0 });
        let mut signs = [0.0; 2];
        for &side in sides {
            w = add(w, scaled(here.outward[side], 4.0 * size(random)));
            signs[side / 2] = if side % 2 == 0 { -1.0 } else { 1.0 };
        }
        let (query, far) = (add(here.point, w), 1.25 * norm(w));
        let ring = (random.next() * RINGS as f64) as usize;
        let (edge, widths) = reach.edge(k, at, sides[0], ring)?;
        if !reach.holds((k, at), ring, query, far, Level::detect()) {
            return None;
        }
        let patch = &index.patches[k];
        let spans = [patch.u, patch.v].map(|span| span.ends[1] - span.ends[0]);
        let fall = [0, 1].map(|d| signs[d] * dot(w, here.tangents[d]) * spans[d] * widths[d]);
        let corner = (sides.len() == 2).then_some(signs[0] * signs[1]);
        let bound = edge.asked(w, 0.0, fall, corner) / norm(w);
        Some(Self { query, far, direction: scaled(w, 1.0 / norm(w)), bound })
    }
}

/// Checks `direction.(x - f) <= bound |x - f|^2`; `rounding`: of the points, and of directions by `kink`.
fn check(
    name: &str,
    direction: Vector,
    [from, to]: [Vector; 2],
    bound: f64,
    [rounding, kink]: [f64; 2],
) {
    let e = sub(to, from);
    let (rise, square) = (dot(direction, e), dot(e, e));
    let rounding = rounding + (1e-13 + kink) * norm(e);
    let is_held = bound == f64::INFINITY || rise <= bound * square + rounding;
    assert!(is_held, "{name}: {rise} > {bound} * {square} from {from:?}");
}

/// Checks some places of a surface; how many of their bounds say something.
fn look_at(case: &Case, shape: &IndexedSurface, random: &mut Random) -> [usize; 4] {
    let name = &case.name;
    let rounding = 1e-14 * (1.0 + case.magnitude / case.diagonal);
    let index = shape.index(&mut || false).unwrap();
    let Some(reach) = &index.reach else { return [0; 4] };
    let rounding = rounding + reach.gap;
    let [u0, u1, v0, v1] = shape.surface().domain();
    let (mut finite, mut rings, mut outside) = (0, 0, 0);
    for n in 0..PLACES {
        let (a, b) = (random.next(), random.next());
        // A third of them on the sides and in the corners.
        let mut on: Vec<usize> = Vec::new();
        let [mut a, mut b] = [a, b];
        if n % 3 == 0 {
            let ends = [[Some(0.0), None], [Some(1.0), None], [None, Some(0.0)], [None, Some(1.0)]];
            let corner = |n: usize| [Some((n / 2) as f64), Some((n % 2) as f64)];
            let round = n / 3 % 8;
            let [at_a, at_b] = if round < 4 { ends[round] } else { corner(round - 4) };
            [a, b] = [at_a.unwrap_or(a), at_b.unwrap_or(b)];
            on.extend(
                [(a == 0.0, 0), (a == 1.0, 1), (b == 0.0, 2), (b == 1.0, 3)]
                    .iter()
                    .filter(|x| x.0)
                    .map(|x| x.1),
            );
        }
        let side = on.first().copied();
        let mix =
            |x: f64, low: f64, high: f64| if x == 1.0 { high } else { low + x * (high - low) };
        let (u, v) = (mix(a, u0, u1), mix(b, v0, v1));
        let k = (0..index.patches.len())
            .find(|&k| u <= index.patches[k].u.ends[1] && v <= index.patches[k].v.ends[1])
            .unwrap();
        let at = [index.patches[k].u.local(u), index.patches[k].v.local(v)];
        let bounds = reach.bend(k, at);
        let here = place(shape, u, v);
        if !here.normal[0].is_finite() {
            continue;
        }
        let rim = side.map(|side| {
            let is_side = reach.sides(k, at)[side] || reach.rim(k, at, side) == f64::INFINITY;
            assert!(is_side, "{name}: side {side} at {u} {v}");
            (here.outward[side], reach.rim(k, at, side))
        });
        finite += usize::from(bounds[0].min(bounds[1]) < f64::INFINITY);
        // Queries on the normal, the rings that hold all that is not much farther than the place.
        let level = Level::detect();
        let mut held = Vec::new();
        for n in 0..QUERIES * usize::from(reach.near(k, at, 0).is_some()) {
            let height = random.next() * 0.5f64.powi(2 * (n / 2) as i32);
            let side = n % 2;
            let normal = scaled(here.normal, if side == 0 { 1.0 } else { -1.0 });
            let query = add(here.point, scaled(normal, height));
            for ring in 0..RINGS {
                let far = 1.25 * height;
                if reach.holds((k, at), ring, query, far, level) {
                    let bound = reach.near(k, at, ring).unwrap()[side];
                    held.push(Beside { query, far, direction: normal, bound });
                }
            }
            let least = reach.distance(query, level).unwrap();
            assert!(least <= height + rounding, "{name}: {least} {height}");
        }
        rings += usize::from(held.iter().any(|held| held.bound < f64::INFINITY));
        if on.iter().all(|&side| reach.sides(k, at)[side]) && !on.is_empty() {
            let asked =
                (0..4 * QUERIES).filter_map(|_| Beside::new(index, (&here, k, at), &on, random));
            let before = held.len();
            held.extend(asked.filter(|beside| beside.bound < f64::INFINITY));
            outside += held.len() - before;
        }
        for m in 0..OTHERS + NEAR {
            let (c, d) = (random.next(), random.next());
            let (c, d) = if m < OTHERS {
                (c, d)
            } else {
                let small = 0.5f64.powi((m - OTHERS) as i32 / 2 + 2);
                ((a + small * (c - 0.5)).clamp(0.0, 1.0), (b + small * (d - 0.5)).clamp(0.0, 1.0))
            };
            let there = shape.surface().evaluate(mix(c, u0, u1), mix(d, v0, v1));
            let there = index.frame.enter(there);
            let (way, rounding) = ([here.point, there], [rounding, reach.kink]);
            check(name, here.normal, way, bounds[0], rounding);
            check(name, scaled(here.normal, -1.0), way, bounds[1], rounding);
            if let Some((outward, bound)) = rim {
                check(name, outward, way, bound, rounding);
            }
            for &Beside { query, far, direction, bound } in &held {
                if norm(sub(there, query)) < far - rounding[0] {
                    check(name, direction, way, bound, rounding);
                }
            }
        }
    }
    [finite, rings, PLACES, outside]
}

#[test]
fn no_place_of_the_cases_lies_in_a_ball_that_a_bound_allows() {
    let mut random = Random(0x666f_6f74);
    let mut sum = [0; 4];
    for folder in cases::folders() {
        let case = cases::read(&folder);
        if let Shape::Surface(shape) = &case.shape {
            let index = shape.index(&mut || false).unwrap();
            if index.patches.len() <= 1000 {
                let found = look_at(&case, shape, &mut random);
                sum = [0, 1, 2, 3].map(|k| sum[k] + found[k]);
            }
        }
    }
    println!("bounds of all, of rings, places, queries outside: {sum:?}");
    assert!(sum[2] == 0 || 4 * sum[0].min(sum[1]) > sum[2] && sum[3] > sum[2], "{sum:?}");
}

/// Checks some places of a curve for vectors across it; how many of their bounds say something.
fn look_along(case: &Case, shape: &IndexedCurve, random: &mut Random) -> [usize; 2] {
    let name = &case.name;
    let index = shape.index(&mut || false).unwrap();
    let Some(reach) = &index.reach else { return [0, 0] };
    let rounding = 1e-14 * (1.0 + case.magnitude / case.diagonal) + reach.gap;
    let (u0, u1) = shape.curve().domain();
    let mix = |x: f64| if x == 1.0 { u1 } else { u0 + x * (u1 - u0) };
    let mut finite = 0;
    for n in 0..CURVE_PLACES {
        let a = match n % 20 {
            0 => 0.0,
            1 => 1.0,
            _ => random.next(),
        };
        let u = mix(a);
        let last = index.segments.len() - 1;
        let k = (0..=last).find(|&k| u <= index.segments[k].u.ends[1]).unwrap_or(last);
        let at = index.segments[k].u.local(u);
        let mut jet = [[0.0; 3]; 2];
        shape.curve().derivatives(u, 1, &mut jet);
        let tangent = scaled(jet[1], 1.0 / norm(jet[1]));
        if !tangent[0].is_finite() {
            continue;
        }
        let point = index.frame.enter(jet[0]);
        let end = reach.end(k, at);
        assert_eq!(end.is_some(), n % 20 < 2, "{name}: an end at {u}");
        for m in 0..OTHERS + NEAR {
            let b = if m < OTHERS {
                random.next()
            } else {
                let small = 0.5f64.powi((m - OTHERS) as i32 / 2 + 2);
                (a + small * (random.next() - 0.5)).clamp(0.0, 1.0)
            };
            let there = index.frame.enter(shape.curve().evaluate(mix(b)));
            let e = sub(there, point);
            let rest = sub(e, scaled(tangent, dot(e, tangent)));
            // Across towards the place: nothing asks for more.
            let across = scaled(rest, 1.0 / norm(rest));
            if norm(rest) > rounding {
                let bound = reach.across(k, at).asked(tangent, across, 0.0);
                let bound = if bound.is_nan() { f64::INFINITY } else { bound };
                check(name, across, [point, there], bound, [rounding, reach.kink]);
                finite += usize::from(m == 0 && bound < f64::INFINITY);
            }
            if let Some((side, bound)) = end {
                let outward = scaled(tangent, if side == 0 { -1.0 } else { 1.0 });
                check(name, outward, [point, there], bound, [rounding, 0.0]);
            }
        }
    }
    [finite, CURVE_PLACES]
}

#[test]
fn no_place_of_the_curves_lies_in_a_ball_that_a_bound_allows() {
    let mut random = Random(0x6275_6f77);
    let mut sum = [0, 0];
    for folder in cases::folders() {
        let case = cases::read(&folder);
        if let Shape::Curve(shape) = &case.shape {
            let [finite, all] = look_along(&case, shape, &mut random);
            sum = [sum[0] + finite, sum[1] + all];
        }
    }
    eprintln!("{sum:?}");
    assert!(sum[1] == 0 || 4 * sum[0] > sum[1], "{sum:?}");
}
