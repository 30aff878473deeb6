//! Elementary shapes in many NURBS forms: recognised, answered like any other shape, bounds below the closed form.

mod elementary_forms;

use elementary_forms::{
    Motion, Profile, Random, Vector, arc, book_circle, curve, norm, rectangle, segment, sub, turned,
};
use footpoint::closest::{FootPoint, QueryOptions, Workspace, flag};
use footpoint::index::{IndexedCurve, IndexedSurface};
use footpoint::surface::Surface;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Signed distance of a point in the shape's own frame from the whole carrier, absolute value.
type Distance = Box<dyn Fn(Vector) -> f64>;

fn length(x: f64, y: f64) -> f64 {
    x.hypot(y)
}

/// A circle profile about the axis: full or an arc, in one of many forms.
fn ring(random: &mut Random) -> Profile {
    match random.whole(0, 5) {
        0 => book_circle(true),
        1 => book_circle(false),
        2 => arc(0.0, TAU, random, true),
        3 => {
            let from = random.between(0.0, 6.0);
            let to = from + random.between(0.3, 6.0);
            arc(from, to, random, false)
        }
        _ => {
            let from = random.between(0.0, 6.0);
            arc(from, from + TAU, random, false)
        }
    }
}

/// A random elementary surface, its name and carrier.
fn sheet(random: &mut Random, motion: &Motion) -> (&'static str, Surface, Distance) {
    let (circle, swapped) = (ring(random), random.whole(0, 1) == 1);
    let radius = random.between(0.2, 2.0);
    match random.whole(0, 6) {
        0 => {
            let line = segment([radius, random.between(-2.0, 0.0)], [radius, 0.7], random, false);
            let distance = move |[x, y, _]: Vector| (length(x, y) - radius).abs();
            ("cylinder", turned(&circle, &line, swapped, motion), Box::new(distance))
        }
        1 | 2 => {
            let (sin, cos) = random.between(0.2, 1.3).sin_cos();
            let from = if random.whole(0, 1) == 0 { 0.0 } else { random.between(0.1, 1.0) };
            let to = from + random.between(0.5, 2.0);
            let line = segment([from * sin, from * cos], [to * sin, to * cos], random, false);
            // The nappe: nearest to the tip below it.
            let distance = move |[x, y, z]: Vector| {
                let rho = length(x, y);
                let along = (rho * sin + z * cos).max(0.0);
                length(rho - along * sin, z - along * cos)
            };
            let name = if from == 0.0 { "cone with tip" } else { "cone" };
            (name, turned(&circle, &line, swapped, motion), Box::new(distance))
        }
        3 | 4 => {
            let (from, to) = match random.whole(0, 2) {
                0 => (-FRAC_PI_2, FRAC_PI_2),
                1 => (random.between(-1.4, 0.0), FRAC_PI_2),
                _ => (random.between(-1.4, 0.0), random.between(0.3, 1.4)),
            };
            let mut meridian = arc(from, to, random, false).placed(radius, 0.0);
            let last = meridian.poles.len() - 1;
            for (k, angle) in [(0, from), (last, to)] {
                if angle.abs() == FRAC_PI_2 {
                    meridian.poles[k][0] = 0.0;
                }
            }
            let distance = move |p: Vector| (norm(p) - radius).abs();
            ("sphere", turned(&circle, &meridian, swapped, motion), Box::new(distance))
        }
        5 => {
            let minor = radius * random.between(0.05, 0.9);
            let from = random.between(0.0, 6.0);
            let way = if random.whole(0, 1) == 0 { TAU } else { random.between(0.5, 5.0) };
            let meridian = arc(from, from + way, random, false).placed(minor, radius);
            let distance =
                move |[x, y, z]: Vector| (length(length(x, y) - radius, z) - minor).abs();
            ("torus", turned(&circle, &meridian, swapped, motion), Box::new(distance))
        }
        _ => {
            let a = segment([random.between(-2.0, -0.1), 0.0], [0.4, 0.0], random, false);
            let b = segment([random.between(-2.0, -0.1), 0.0], [0.9, 0.0], random, false);
            ("plane", rectangle(&a, &b, motion), Box::new(|p: Vector| p[2].abs()))
        }
    }
}

/// A query in the shape's own frame: anywhere, near the surface, on the axis, far away.
fn asked(random: &mut Random, near: Vector) -> Vector {
    let reach = [2.5, 2.5, 1e-3, 1e-9, 0.0, 300.0][random.whole(0, 5)];
    let p = random.point(reach);
    let beside = 10.0f64.powf(random.between(-17.0, -1.0));
    match random.whole(0, 10) {
        0 => [0.0, 0.0, p[2]],
        1 => [1e-4 * p[0], 1e-7 * p[1], p[2]],
        2 => [beside * random.between(-1.0, 1.0), beside * random.between(-1.0, 1.0), p[2]],
        3..=5 => p,
        _ => [0, 1, 2].map(|c| near[c] + p[c]),
    }
}

/// Flags that say where the foot is and how many there are.
const PLACE: u32 = flag::EDGE | flag::CORNER | flag::SEAM | flag::COLLAPSED | flag::CREASE;
const TIES: u32 = flag::TIE | flag::CONTINUUM;

/// Most evaluations that a closed form takes; more of them are those of a search.
const STEPS: u32 = 6;

/// What two answers must have in common, when one is that of the general search.
fn agree(
    ours: &FootPoint,
    general: &FootPoint,
    [floor, gap]: [f64; 2],
    context: &dyn Fn() -> String,
) {
    let apart = norm(sub(ours.point, general.point));
    assert!(ours.flags & flag::NOT_PROVEN == 0, "{} {ours:?} {general:?}", context());
    assert!(ours.lower_bound <= general.distance + floor, "{} {ours:?} {general:?}", context());
    assert!(general.lower_bound <= ours.distance + floor, "{} {ours:?} {general:?}", context());
    // A search may end up to its gap above the least distance; closed forms do not, but that what is beside a tip within the
    // accuracy is the tip, and beside a tip a search of few steps may answer a query that is on the shape but for the accuracy.
    let is_closed = ours.iterations <= STEPS;
    let is_exact = is_closed && ours.flags & (TIES | flag::COLLAPSED) == 0 && ours.distance > gap;
    let over = if is_exact { 4.0 * floor } else { gap };
    assert!(ours.distance <= general.distance + over, "{} {ours:?} {general:?}", context());
    assert!(general.distance <= ours.distance + gap, "{} {ours:?} {general:?}", context());
    // The general search may leave open what closed forms decide, never the other way round. Where these do not decide, the
    // search of an elementary shape knows less than that of others, of which feet are known to be alone.
    let more = ours.flags & flag::TIE & !general.flags;
    // In a continuum but for the accuracy a search may find the one least place.
    let is_level = ours.flags & flag::CONTINUUM != 0;
    // Of a few evaluations more, it may be the search of an elementary shape that leaves a tie open.
    let is_decided = ours.iterations <= 2;
    assert!(more == 0 || !is_decided || is_level, "{} {ours:?} {general:?}", context());
    let other_place = ours.flags & PLACE != general.flags & PLACE;
    if apart <= 4.0 * floor && ours.flags & TIES == 0 && is_closed && other_place {
        // A foot within rounding of a border may be on it or not.
        let moved = (ours.u - general.u).abs() + (ours.v - general.v).abs();
        let collapsed = (ours.flags | general.flags) & flag::COLLAPSED != 0;
        // Beside a tip parameters that differ by much give one point.
        let beside_tip = apart < 1e-6 * moved;
        assert!(
            moved < 1e-11
                || beside_tip
                || collapsed
                || (ours.flags | general.flags) & flag::SEAM != 0,
            "{} {ours:?} {general:?}",
            context()
        );
    }
}

#[test]
fn elementary_surfaces_in_any_form_are_recognised_and_answered_like_any_other() {
    let mut random = Random(4);
    let mut closed_forms = 0;
    let (mut asked_in_all, mut missed) = (0, 0);
    let (mut continua, mut closed_there) = (0, 0);
    let rounds = 1500;
    for round in 0..rounds {
        let scale = [1.0, 1.0, 1e-6, 1e6][random.whole(0, 3)];
        let offset = scale * [0.0, 10.0, 1000.0][random.whole(0, 2)];
        let motion = Motion::random(&mut random, scale, offset);
        let (name, surface, carrier) = sheet(&mut random, &motion);
        let ours = IndexedSurface::new(surface.clone());
        let general = IndexedSurface::general(surface.clone());
        let index = ours.index(&mut || false).unwrap();
        // Far from the origin poles have few digits: small pieces then look like anything.
        if index.analytic.is_none() {
            assert!(offset > 100.0 * scale, "{round} {name} {motion:?} {surface:?}");
            missed += 1;
            continue;
        }
        let (options, mut workspace) = (QueryOptions::default(), Workspace::default());
        let [u0, u1, v0, v1] = surface.domain();
        for _ in 0..40 {
            let at = [random.between(u0, u1), random.between(v0, v1)];
            let on = surface.evaluate(at[0], at[1]);
            let near = own(&motion, on);
            let p = asked(&mut random, near);
            let query = motion.of(p);
            let largest = query.iter().fold(index.frame.magnitude, |m, x| m.max(x.abs()));
            let floor = 1e-14 * largest + 1e-13 * index.frame.diagonal;
            let a = ours.closest(query, None, &options, &mut workspace, None);
            let b = general.closest(query, None, &options, &mut workspace, None);
            let context = || format!("{round} {name} {p:?} {query:?}");
            let gap = 1.01e-10 * index.frame.diagonal + 1e-12 * b.distance;
            agree(&a, &b, [floor, gap], &context);
            let least = carrier(p) * scale;
            assert!(a.distance >= least * (1.0 - 1e-13) - floor, "{} {a:?} {least}", context());
            closed_forms += usize::from(a.iterations <= 2);
            asked_in_all += 1;
            if a.flags & b.flags & flag::CONTINUUM != 0 {
                continua += 1;
                closed_there += usize::from(a.iterations <= STEPS);
            }
        }
    }
    assert!(missed * 200 <= rounds, "{missed}");
    assert!(2 * closed_forms > asked_in_all, "{closed_forms} of {asked_in_all}");
    assert!(4 * closed_there > 3 * continua && continua > 500, "{closed_there} of {continua}");
}

/// A point of the caller in the shape's own frame.
fn own(motion: &Motion, p: Vector) -> Vector {
    let origin = motion.of([0.0; 3]);
    let axis = |k: usize| {
        let mut e = [0.0; 3];
        e[k] = 1.0;
        sub(motion.of(e), origin)
    };
    let v = sub(p, origin);
    [0, 1, 2].map(|k| {
        let e = axis(k);
        (v[0] * e[0] + v[1] * e[1] + v[2] * e[2]) / (motion.scale * motion.scale)
    })
}

#[test]
fn lines_and_circles_in_any_form_are_recognised_and_answered_like_any_other() {
    let mut random = Random(5);
    for round in 0..1000 {
        let scale = [1.0, 1e-6, 1e6][random.whole(0, 2)];
        let motion = Motion::random(&mut random, scale, scale * [0.0, 100.0][round % 2]);
        let is_line = round % 4 == 0;
        let profile = if is_line {
            segment([random.between(-2.0, 0.0), 0.3], [0.8, 0.3], &mut random, false)
        } else {
            ring(&mut random)
        };
        let curve = curve(&profile, &motion);
        let ours = IndexedCurve::new(curve.clone());
        let general = IndexedCurve::general(curve.clone());
        let index = ours.index(&mut || false).unwrap();
        assert!(index.analytic.is_some(), "{round} {motion:?} {curve:?}");
        let (options, mut workspace) = (QueryOptions::default(), Workspace::default());
        let (u0, u1) = curve.domain();
        for _ in 0..50 {
            let near = own(&motion, curve.evaluate(random.between(u0, u1)));
            let p = asked(&mut random, near);
            let query = motion.of(p);
            let largest = query.iter().fold(index.frame.magnitude, |m, x| m.max(x.abs()));
            let floor = 1e-14 * largest + 1e-13 * index.frame.diagonal;
            let a = ours.closest(query, None, &options, &mut workspace, None);
            let b = general.closest(query, None, &options, &mut workspace, None);
            let gap = 1.01e-10 * index.frame.diagonal + 1e-12 * b.distance;
            let context = || format!("{round} {p:?} {query:?}");
            agree(&a, &b, [floor, gap], &context);
            let least = if is_line {
                length(p[1] - 0.3, p[2])
            } else {
                length(length(p[0], p[1]) - 1.0, p[2])
            };
            assert!(
                a.distance >= least * scale * (1.0 - 1e-13) - floor,
                "{} {a:?} {least}",
                context()
            );
        }
    }
}

#[test]
fn what_is_nearly_elementary_is_never_claimed_nearer_to_it_than_it_is() {
    let mut random = Random(6);
    let mut recognised = [0; 2];
    for round in 0..300 {
        let motion = Motion::random(&mut random, 1.0, 1.0);
        let (name, surface, _) = sheet(&mut random, &motion);
        let size = 10f64.powf(random.between(-13.0, -6.0));
        let poles: Vec<Vector> = (surface.poles().iter())
            .map(|p| {
                let move_ = random.point(size);
                [0, 1, 2].map(|c| p[c] + move_[c])
            })
            .collect();
        let (ku, kv) = (surface.knots_u(), surface.knots_v());
        let moved = Surface::new(
            ku.values(),
            kv.values(),
            ku.degree(),
            kv.degree(),
            &poles,
            ku.pole_count(),
            kv.pole_count(),
            surface.weights(),
        )
        .unwrap();
        let ours = IndexedSurface::new(moved.clone());
        let index = ours.index(&mut || false).unwrap();
        recognised[usize::from(size > 1e-9)] += usize::from(index.analytic.is_some());
        let [u0, u1, v0, v1] = moved.domain();
        let (options, mut workspace) = (QueryOptions::default(), Workspace::default());
        for _ in 0..20 {
            let near = moved.evaluate(random.between(u0, u1), random.between(v0, v1));
            let step = random.point([1.0, 1e-3, 1e-6, 1e-11][round % 4]);
            let query = [0, 1, 2].map(|c| near[c] + step[c]);
            let foot = ours.closest(query, None, &options, &mut workspace, None);
            // The bound holds at the point that the query was made from, at the foot and all around it.
            for k in 0..200 {
                let spread = [1.0, 1e-3, 1e-6][k % 3];
                let u = (foot.u + spread * random.between(-1.0, 1.0) * (u1 - u0)).clamp(u0, u1);
                let v = (foot.v + spread * random.between(-1.0, 1.0) * (v1 - v0)).clamp(v0, v1);
                let distance = norm(sub(moved.evaluate(u, v), query));
                assert!(
                    foot.lower_bound <= distance + 4e-15 * (2.0 + distance),
                    "{round} {name} {size:e} {query:?} {foot:?} ({u}, {v}) {distance:e}"
                );
            }
            assert!(foot.lower_bound <= norm(step) + 1e-15, "{round} {name} {foot:?}");
        }
    }
    assert!(recognised[0] > 20 && recognised[1] == 0, "{recognised:?}");
}

#[test]
fn hints_restrictions_and_the_accuracy_leave_elementary_answers_right() {
    let mut random = Random(7);
    for round in 0..300 {
        let motion = Motion::random(&mut random, 1.0, 3.0);
        let (name, surface, _) = sheet(&mut random, &motion);
        let ours = IndexedSurface::new(surface.clone());
        let general = IndexedSurface::general(surface.clone());
        let [u0, u1, v0, v1] = surface.domain();
        let mut workspace = Workspace::default();
        for _ in 0..20 {
            let between = |random: &mut Random| [random.between(u0, u1), random.between(v0, v1)];
            let [near, hint, a, b] = [0; 4].map(|_| between(&mut random));
            let near = own(&motion, surface.evaluate(near[0], near[1]));
            let query = motion.of(asked(&mut random, near));
            let plain = ours.closest(query, None, &QueryOptions::default(), &mut workspace, None);
            let hinted =
                ours.closest(query, Some(hint), &QueryOptions::default(), &mut workspace, None);
            assert!(hinted.flags & flag::HINT_USED != 0);
            if plain.iterations <= 2 && hinted.iterations <= 2 && plain.flags & TIES == 0 {
                let (flags, iterations) = (plain.flags | flag::HINT_USED, hinted.iterations);
                assert_eq!(hinted, FootPoint { flags, iterations, ..plain }, "{round} {name}");
            }
            let domain = [a[0].min(b[0]), a[0].max(b[0]), a[1].min(b[1]), a[1].max(b[1])];
            let options = QueryOptions { domain: Some(domain), ..QueryOptions::default() };
            let part = ours.closest(query, None, &options, &mut workspace, None);
            let truth = general.closest(query, None, &options, &mut workspace, None);
            let floor = 1e-12 * (3.0 + truth.distance);
            let gap = if (truth.flags | part.flags) & TIES != 0 { 1e-9 } else { floor };
            let context = || format!("{round} {name} {domain:?} {query:?} {part:?} {truth:?}");
            assert!((part.distance - truth.distance).abs() <= gap, "{}", context());
            assert!(part.lower_bound <= truth.distance + floor, "{}", context());
            let inside = part.u >= domain[0] && part.u <= domain[1];
            assert!(inside && part.v >= domain[2] && part.v <= domain[3], "{}", context());
            let sharp = QueryOptions { accuracy: 1e-16, ..QueryOptions::default() };
            let sharp = ours.closest(query, None, &sharp, &mut workspace, None);
            assert!((sharp.distance - plain.distance).abs() <= 1e-9, "{round} {name}");
        }
    }
}

#[test]
fn other_shapes_have_no_carrier() {
    let mut random = Random(8);
    let still = Motion::random(&mut random, 1.0, 0.0);
    // A spindle torus, an ellipsoid of revolution, a half turn of an ellipse.
    let circle = arc(0.0, TAU, &mut random, true);
    let spindle = arc(-2.0, 2.0, &mut random, true).placed(1.0, 0.5);
    let mut egg = arc(-FRAC_PI_2, FRAC_PI_2, &mut random, true);
    egg.poles.iter_mut().for_each(|p| p[1] *= 1.0 + 1e-7);
    for meridian in [spindle, egg] {
        let surface = IndexedSurface::new(turned(&circle, &meridian, false, &still));
        assert!(surface.index(&mut || false).unwrap().analytic.is_none());
    }
    let mut ellipse = arc(0.0, PI, &mut random, true);
    ellipse.poles.iter_mut().for_each(|p| p[1] *= 1.0 + 1e-7);
    let ellipse = IndexedCurve::new(curve(&ellipse, &still));
    assert!(ellipse.index(&mut || false).unwrap().analytic.is_none());
}
