//! Laws of sets on random shapes of every family.

mod sets;
mod shapes;

use footpoint::closest::{QueryOptions, flag};
use footpoint::curve::Curve;
use footpoint::extrema::ExtremaOptions;
use footpoint::index::{IndexedCurve, IndexedSurface};
use footpoint::set::{FootSet, Kind, Member, Nature};
use footpoint::surface::Surface;
use sets::{Asked, Log, complaint, extrema, preimage, topology};
use shapes::asked::{Shape, apart};
use shapes::{FAMILIES, Random, Vector, along, dot, norm, sub};

/// Shapes per family and queries per shape.
const ROUNDS: [u64; 2] = if cfg!(debug_assertions) { [8, 10] } else { [40, 25] };

/// Runs a check on random shapes of all families with random queries.
fn every(log: &mut Log, check: impl Fn(&Shape, Vector, &mut Random) -> Check) {
    for family in 0..FAMILIES.len() {
        for seed in 0..ROUNDS[0] {
            let shape = Shape::new(family, seed);
            let r = &mut Random(seed * 1_000 + family as u64);
            for _ in 0..ROUNDS[1] {
                let query = shape.query(r);
                match check(&shape, query, r) {
                    Check::LeftOut => log.leave_out(),
                    Check::Right => log.put(query, None),
                    Check::Wrong(text) => {
                        log.put((FAMILIES[family].name, seed, query), Some(text));
                    }
                }
            }
        }
    }
}

enum Check {
    Right,
    Wrong(String),
    LeftOut,
}

impl Check {
    fn of(right: bool, text: impl Fn() -> String) -> Self {
        if right { Self::Right } else { Self::Wrong(text()) }
    }
}

fn is_inside(interval: [f64; 2], x: f64) -> bool {
    interval[0] <= x && x <= interval[1]
}

fn holds(set: &FootSet, at: [f64; 2]) -> bool {
    let inside = |m: &Member| is_inside(m.u, at[0]) && is_inside(m.v, at[1]);
    let open = |b: &[f64; 4]| is_inside([b[0], b[1]], at[0]) && is_inside([b[2], b[3]], at[1]);
    set.members.iter().any(inside) || set.undecided.iter().any(open)
}

#[test]
fn every_point_of_a_shape_is_in_its_own_preimage() {
    let mut log = Log::default();
    every(&mut log, |shape, _, r| {
        let at = shape.place(r);
        let query = shape.evaluate(at);
        let set = preimage(shape, query, 0.0, &QueryOptions::default());
        let broken = complaint(shape, &set, &Asked::Preimage(query));
        let is_proven = set.members.iter().all(|m| m.foot.flags & flag::NOT_PROVEN == 0);
        let own = holds(&set, at);
        Check::of(own && (broken.is_none() || !is_proven), || format!("{at:?} {broken:?} {set:?}"))
    });
    log.close("own preimage", 0.0);
}

/// The nearest member of a complete set is as near as the nearest point.
#[test]
fn the_nearest_extremum_is_the_nearest_point() {
    let mut log = Log::default();
    every(&mut log, |shape, query, _| {
        let foot = shape.ask(query, None, &QueryOptions::default());
        let options = ExtremaOptions { minima_only: true, ..ExtremaOptions::default() };
        let set = extrema(shape, query, &options);
        if foot.flags & flag::NOT_PROVEN != 0 || !set.is_complete() {
            return Check::LeftOut;
        }
        let gap = 2.0 * shape.gap(query, foot.distance) + shape.grain(&foot);
        let least = set.members.first().map_or(f64::INFINITY, |m| m.foot.distance);
        Check::of((least - foot.distance).abs() <= gap, || format!("{foot:?} {set:?}"))
    });
    log.close("nearest extremum", 0.2);
}

#[test]
fn sets_obey_the_laws_of_members() {
    let mut log = Log::default();
    every(&mut log, |shape, query, _| {
        let set = extrema(shape, query, &ExtremaOptions::default());
        let broken = complaint(shape, &set, &Asked::Extrema(query));
        Check::of(broken.is_none(), || format!("{broken:?}"))
    });
    log.close("laws", 0.0);
}

/// The members that must agree between two descriptions of a shape: isolated and not flat.
fn isolated(set: &FootSet) -> Option<Vec<&Member>> {
    let is_plain = |m: &&Member| m.kind == Kind::Point && m.nature != Nature::Flat;
    let is_thin = |m: &&Member| m.u[1] == m.u[0] && m.v[1] == m.v[0];
    let list: Vec<&Member> = set.members.iter().collect();
    let right = set.is_complete() && list.iter().all(|m| is_plain(m) && is_thin(m));
    right.then_some(list)
}

/// Whether two members have nearly one distance, or nearly one point: rounding then decides what they are.
fn is_close_call(shape: &Shape, query: Vector, list: &[&Member]) -> bool {
    let limit = 1e-8 * shape.diagonal() + 100.0 * shape.gap(query, 0.0);
    let level = list.windows(2).any(|p| p[1].foot.distance - p[0].foot.distance < limit);
    let pair = |a: &Member, b: &Member| norm(sub(a.foot.point, b.foot.point)) < limit;
    level || (0..list.len()).any(|i| (0..i).any(|j| pair(list[i], list[j])))
}

/// Whether some span is so short that its parameters have few digits.
fn has_tiny_spans(shape: &Shape) -> bool {
    let tiny = |knots: &footpoint::knots::Knots| {
        let (first, last) = knots.domain();
        let lengths = knots.spans().map(|i| knots.values()[i + 1] - knots.values()[i]);
        lengths.fold(f64::INFINITY, f64::min) < 1e-8 * (last - first)
    };
    match shape {
        Shape::Curve(curve) => tiny(curve.curve().knots()),
        Shape::Surface(surface) => {
            tiny(surface.surface().knots_u()) || tiny(surface.surface().knots_v())
        }
    }
}

/// Compares numbers, natures and distances (times `scale`) of two sets.
fn agree(shape: &Shape, query: Vector, a: &FootSet, b: &FootSet, scale: f64) -> Check {
    let (Some(first), Some(second)) = (isolated(a), isolated(b)) else { return Check::LeftOut };
    let doubtful = |list: &[&Member]| is_close_call(shape, query, list);
    if has_tiny_spans(shape) || doubtful(&first) || doubtful(&second) {
        return Check::LeftOut;
    }
    let natures = |list: &[&Member]| {
        let mut of: Vec<u32> = list.iter().map(|m| m.nature as u32).collect();
        of.sort_unstable();
        of
    };
    let near = first.iter().zip(&second).all(|(a, b)| {
        (a.foot.distance * scale - b.foot.distance).abs()
            <= scale * 4.0 * shape.gap(query, a.foot.distance)
    });
    Check::of(near && natures(&first) == natures(&second), || format!("{a:#?} {b:#?}"))
}

fn scaled(shape: &Shape, factor: f64) -> Shape {
    match shape {
        Shape::Curve(curve) => {
            let curve = curve.curve();
            let poles: Vec<Vector> = curve.poles().iter().map(|p| p.map(|x| x * factor)).collect();
            let same = Curve::new(curve.knots().values(), curve.degree(), &poles, curve.weights());
            Shape::Curve(IndexedCurve::new(same.expect("a curve")))
        }
        Shape::Surface(surface) => {
            Shape::Surface(moved(surface.surface(), |p| p.map(|x| x * factor)))
        }
    }
}

fn moved(surface: &Surface, map: impl Fn(Vector) -> Vector) -> IndexedSurface {
    let poles: Vec<Vector> = surface.poles().iter().map(|p| map(*p)).collect();
    let (ku, kv) = (surface.knots_u(), surface.knots_v());
    let (p, q) = (ku.degree(), kv.degree());
    let counts = [ku.values().len() - p - 1, kv.values().len() - q - 1];
    let same = Surface::new(
        ku.values(),
        kv.values(),
        p,
        q,
        &poles,
        counts[0],
        counts[1],
        surface.weights(),
    );
    IndexedSurface::new(same.expect("a surface"))
}

/// Scaling by a power of two changes no parameter.
#[test]
fn scaling_by_powers_of_two_scales_the_set() {
    let mut log = Log::default();
    every(&mut log, |shape, query, r| {
        let factor = 2f64.powi(r.whole(0, 40) as i32 - 20);
        let other = scaled(shape, factor);
        let a = extrema(shape, query, &ExtremaOptions::default());
        let b = extrema(&other, query.map(|x| x * factor), &ExtremaOptions::default());
        let same = a.members.len() == b.members.len()
            && a.undecided == b.undecided
            && a.members.iter().zip(&b.members).all(|(a, b)| {
                (a.foot.u, a.foot.v, a.u, a.v, a.kind, a.nature)
                    == (b.foot.u, b.foot.v, b.u, b.v, b.kind, b.nature)
                    && (a.foot.distance * factor - b.foot.distance).abs() <= 1e-15 * b.foot.distance
            });
        Check::of(same, || format!("{factor} {a:#?} {b:#?}"))
    });
    log.close("scaling", 0.0);
}

/// A turn about an axis with the cosine 0.6, and a shift in the size of the shape.
fn turned(p: Vector, size: f64) -> Vector {
    let turned = [0.6 * p[0] - 0.8 * p[1], 0.8 * p[0] + 0.6 * p[1], p[2]];
    along(turned, [0.3, -0.2, 0.1], size)
}

#[test]
fn a_rigid_motion_moves_the_set() {
    let mut log = Log::default();
    every(&mut log, |shape, query, _| {
        let size = shape.diagonal();
        let other = match shape {
            Shape::Curve(curve) => {
                let c = curve.curve();
                let poles: Vec<Vector> = c.poles().iter().map(|p| turned(*p, size)).collect();
                let same = Curve::new(c.knots().values(), c.degree(), &poles, c.weights());
                Shape::Curve(IndexedCurve::new(same.expect("a curve")))
            }
            Shape::Surface(surface) => {
                Shape::Surface(moved(surface.surface(), |p| turned(p, size)))
            }
        };
        let a = extrema(shape, query, &ExtremaOptions::default());
        let b = extrema(&other, turned(query, size), &ExtremaOptions::default());
        agree(shape, query, &a, &b, 1.0)
    });
    log.close("rigid motion", 0.5);
}

#[test]
fn knot_insertion_leaves_the_set() {
    let mut log = Log::default();
    every(&mut log, |shape, query, r| {
        let [u, v] = shape.place(r);
        let [u0, u1, v0, v1] = shape.domain();
        let is_end = u <= u0 || u >= u1 || (v0 < v1 && (v <= v0 || v >= v1));
        let inserted = match shape {
            Shape::Curve(curve) if !is_end => {
                curve.curve().insert_knot(u, 1).ok().map(|c| Shape::Curve(IndexedCurve::new(c)))
            }
            Shape::Surface(surface) if !is_end => surface
                .surface()
                .insert_knot_u(u, 1)
                .and_then(|s| s.insert_knot_v(v, 1))
                .ok()
                .map(|s| Shape::Surface(IndexedSurface::new(s))),
            _ => None,
        };
        let Some(other) = inserted else { return Check::LeftOut };
        let a = extrema(shape, query, &ExtremaOptions::default());
        let b = extrema(&other, query, &ExtremaOptions::default());
        agree(shape, query, &a, &b, 1.0)
    });
    log.close("knot insertion", 0.7);
}

/// A grid of squared distances; nodes lower (or higher) than all neighbours, across seams too.
fn bumps(shape: &Shape, query: Vector, count: usize) -> Vec<([f64; 2], bool)> {
    let ([u0, u1, v0, v1], (closed, _)) = (shape.domain(), topology(shape));
    let rows = if v0 < v1 { count } else { 0 };
    let at = |i: usize, j: usize| {
        let share = |k: usize, n: usize| if n > 0 { k as f64 / n as f64 } else { 0.0 };
        let place = |low: f64, high: f64, x: f64| (low + (high - low) * x).clamp(low, high);
        [place(u0, u1, share(i, count)), place(v0, v1, share(j, rows))]
    };
    let values: Vec<Vec<f64>> = (0..=count)
        .map(|i| (0..=rows).map(|j| apart(query, shape.evaluate(at(i, j)))).collect())
        .collect();
    let step = |k: usize, d: i32, n: usize, closed: bool| {
        let moved = k as i32 + d;
        let inside = (0..=n as i32).contains(&moved);
        let wrapped = (moved + n as i32) % (n.max(1) as i32);
        if inside { Some(moved as usize) } else { closed.then_some(wrapped as usize) }
    };
    let mut found = Vec::new();
    for i in 0..=count {
        for j in 0..=rows {
            let here = values[i][j];
            let around = (-1..=1).flat_map(|a| (-1..=1).map(move |b| (a, b)));
            let around: Vec<f64> = around
                .filter(|&d| d != (0, 0) && (rows > 0 || d.1 == 0))
                .filter_map(|(a, b)| {
                    Some(values[step(i, a, count, closed[0])?][step(j, b, rows, closed[1])?])
                })
                .collect();
            if around.iter().all(|x| here < *x) {
                found.push((at(i, j), true));
            } else if around.iter().all(|x| here > *x) {
                found.push((at(i, j), false));
            }
        }
    }
    found
}

/// Walks downhill (or uphill) from a place by a shrinking pattern; what it ends at is attained.
fn climb(
    shape: &Shape,
    query: Vector,
    start: [f64; 2],
    down: bool,
    count: usize,
) -> ([f64; 2], f64) {
    let [u0, u1, v0, v1] = shape.domain();
    let mut step = [(u1 - u0) / count as f64, (v1 - v0) / count as f64];
    let value = |at: [f64; 2]| {
        let distance = apart(query, shape.evaluate(at));
        if down { distance } else { -distance }
    };
    let (mut at, mut best) = (start, value(start));
    for _ in 0..600 {
        let around =
            [[1., 0.], [-1., 0.], [0., 1.], [0., -1.], [1., 1.], [-1., -1.], [1., -1.], [-1., 1.]];
        let next = around
            .map(|d| {
                let place = [
                    (at[0] + d[0] * step[0]).clamp(u0, u1),
                    (at[1] + d[1] * step[1]).clamp(v0, v1),
                ];
                (value(place), place)
            })
            .into_iter()
            .min_by(|a, b| a.0.total_cmp(&b.0));
        match next {
            Some((value, place)) if value < best => (at, best) = (place, value),
            _ => step = step.map(|x| 0.5 * x),
        }
        if step[0] < 1e-13 * (u1 - u0) {
            break;
        }
    }
    (at, best.abs())
}

/// Minima and maxima that a dense grid shows are members. Folds, where the pattern walk gets stuck on a crease or in a
/// narrow valley, are told by a gradient that does not vanish, and left out.
#[test]
fn minima_and_maxima_of_a_grid_are_members() {
    let mut log = Log::default();
    let rounds = if cfg!(debug_assertions) { 3 } else { 12 };
    for family in 0..FAMILIES.len() {
        for seed in 0..rounds {
            let shape = Shape::new(family, 500 + seed);
            if has_tiny_spans(&shape) {
                // Minima hide in spans between two nodes.
                continue;
            }
            let r = &mut Random(seed * 77 + family as u64);
            let count = if matches!(shape, Shape::Curve(_)) { 4_000 } else { 200 };
            let query = shape.query(r);
            let set = extrema(&shape, query, &ExtremaOptions::default());
            for (start, down) in bumps(&shape, query, count) {
                let (at, distance) = climb(&shape, query, start, down, count);
                let gap = 1e-6 * shape.diagonal();
                let nature = if down { Nature::Minimum } else { Nature::Maximum };
                let point = shape.evaluate(at);
                let is_it = |m: &Member| {
                    (m.nature == nature || m.nature == Nature::Flat)
                        && (m.foot.distance - distance).abs() <= gap
                        && (norm(sub(m.foot.point, point)) <= 1e-3 * shape.diagonal()
                            || m.kind != Kind::Point)
                };
                if set.members.iter().any(is_it) || holds(&set, at) {
                    log.put(query, None);
                } else if is_stuck(&shape, query, at, down) {
                    log.leave_out();
                } else {
                    let text = format!("{nature:?} at {at:?} distance {distance}: {set:#?}");
                    log.put((FAMILIES[family].name, 500 + seed, query), Some(text));
                }
            }
        }
    }
    log.close("grid", 0.1);
}

/// Whether some step, anywhere or along a parameter line, improves on a place by more than rounding: the walk was stuck.
fn is_stuck(shape: &Shape, query: Vector, at: [f64; 2], down: bool) -> bool {
    let [u0, u1, v0, v1] = shape.domain();
    let here = sub(shape.evaluate(at), query);
    let limit = 1e-12 * dot(here, here);
    let r = &mut Random(1);
    (0..4_000).any(|k| {
        let size = r.scale(-9.0, -1.0);
        let moved =
            |x: f64, low: f64, high: f64, s: f64| (x + s * size * (high - low)).clamp(low, high);
        let [a, b, _] = r.vector();
        let [a, b] = [[a, b], [a, 0.0], [0.0, b]][k % 3];
        let there = sub(shape.evaluate([moved(at[0], u0, u1, a), moved(at[1], v0, v1, b)]), query);
        let change = dot(there, there) - dot(here, here);
        if down { change < -limit } else { change > limit }
    })
}
