//! Surface-surface intersection against closed forms: right branches, points to 1e-12 of the size, moved, scaled and far away.

mod march_shapes;

use footpoint::index::IndexedSurface;
use footpoint::march::{
    Branch, ContactKind, End, Intersection, MarchOptions, MarchPoint, distance_to_chord, intersect,
};
use footpoint::surface::Surface;
use march_shapes::{Motion, P, bumps, cone, cylinder, lid, moved, plane, sphere, torus, z_to_x};

fn meet(a: &IndexedSurface, b: &IndexedSurface) -> Intersection {
    intersect(a, b, &MarchOptions::default(), &mut |_, _| false).unwrap()
}

/// What a pair of shapes must give, in every position: loops, open branches, tangential ones among them, contacts.
struct Wanted {
    name: &'static str,
    a: Surface,
    b: Surface,
    closed: usize,
    open: usize,
    tangential: usize,
    contacts: &'static [ContactKind],
    is_proven: bool,
    /// Distance of a point from the closed form, in the shapes' own position.
    off: fn(P) -> f64,
}

fn motions() -> [Motion; 6] {
    let turn = [0.3, -0.5, 0.7, 0.2];
    [
        Motion::NONE,
        Motion::new(turn, 1.0, [0.3, -0.2, 0.9]),
        Motion::new([0.1, 0.9, -0.3, 0.4], 1e6, [5e5, 0.0, -3e5]),
        Motion::new([0.8, -0.1, 0.3, 0.5], 1e-6, [0.0, 2e-6, 0.0]),
        Motion::new([0.5, 0.5, -0.5, 0.5], 1.0, [1e4, -1e4, 1e4]),
        Motion::new(turn, 1e3, [1e6, 1e6, 1e6]),
    ]
}

fn check_branch(
    wanted: &Wanted,
    motion: &Motion,
    surfaces: [&Surface; 2],
    branch: &Branch,
    crossings: &[P],
) {
    let name = wanted.name;
    let magnitude = motion.shift.iter().fold(motion.factor, |m, x| m.max(x.abs()));
    for p in &branch.points {
        let off = (wanted.off)(motion.back(p.point)).abs() * motion.factor;
        // Poles and points are rounded to their coordinates: 1e-12 of the size counts from there.
        let allowed = 1e-12 * 6.0 * motion.factor + 8.0 * f64::EPSILON * magnitude;
        let from =
            |c: &P| (0..3).map(|k| (c[k] - p.point[k]).powi(2)).sum::<f64>().sqrt() / motion.factor;
        let nearest = crossings.iter().map(from).fold(1.0, f64::min);
        let allowed = if branch.is_tangential { 1e3 * allowed } else { allowed };
        let [u, v] = p.uv;
        let [s, t] = p.st;
        let (x, y) = (surfaces[0].evaluate(u, v), surfaces[1].evaluate(s, t));
        let apart = (0..3).map(|k| (x[k] - y[k]).abs()).fold(0.0, f64::max);
        assert!(apart <= allowed, "{name}: {apart:e} apart");
        // Near a crossing the surfaces meet at an angle that falls with the distance, and the place is as much less certain.
        let allowed = allowed * (0.05 / nearest).clamp(1.0, 1e5);
        assert!(off <= allowed, "{name}: {off:e} > {allowed:e} at {p:?}, gap {:e}", branch.gap);
    }
    if branch.is_closed() {
        let (first, last) = (branch.points[0].point, branch.points[branch.points.len() - 1].point);
        let apart = (0..3).map(|k| (first[k] - last[k]).abs()).fold(0.0, f64::max);
        assert!(
            apart <= 1e-11 * magnitude.max(6.0 * motion.factor),
            "{name}: a loop that is {apart:e} open"
        );
    }
}

fn check(wanted: &Wanted, motion: &Motion) {
    let name = wanted.name;
    let (a, b) = (motion.surface(&wanted.a), motion.surface(&wanted.b));
    let found = meet(&a, &b);
    let kinds: Vec<ContactKind> = found.contacts.iter().map(|c| c.kind).collect();
    let closed = found.branches.iter().filter(|b| b.is_closed()).count();
    let tangential = found.branches.iter().filter(|b| b.is_tangential).count();
    let counts = (closed, found.branches.len() - closed, tangential);
    let ends: Vec<_> = found.branches.iter().map(|b| (b.ends, b.points.len())).collect();
    let text = format!(
        "{name}, factor {:e}, shift {:?}: {ends:?}, {kinds:?}",
        motion.factor, motion.shift
    );
    assert_eq!(counts, (wanted.closed, wanted.open, wanted.tangential), "{text}");
    assert_eq!(kinds, wanted.contacts, "{text}");
    assert_eq!(
        (found.undecided.len(), found.overlaps.len(), found.exhausted),
        (0, 0, false),
        "{text}"
    );
    assert_eq!(found.is_proven, wanted.is_proven, "{text}");
    let crossings: Vec<P> = found.contacts.iter().map(|c| c.place.point).collect();
    for branch in &found.branches {
        assert!(!branch.ends.contains(&End::Undecided), "{text}");
        check_branch(wanted, motion, [a.surface(), b.surface()], branch, &crossings);
    }
}

fn check_everywhere(wanted: &Wanted) {
    motions().iter().for_each(|motion| check(wanted, motion));
}

fn level(z: f64) -> Surface {
    plane([-3.1, -3.0, z], [6.0, 0.0, 0.0], [0.0, 6.2, 0.0])
}

/// The plane x = `x`.
fn upright(x: f64) -> Surface {
    plane([x, -3.0, -3.1], [0.0, 6.2, 0.0], [0.0, 0.0, 6.3])
}

fn hypot(p: P) -> f64 {
    (p[0] * p[0] + p[1] * p[1] + p[2] * p[2]).sqrt()
}

#[test]
fn spheres_and_planes_meet_in_circles_and_touch_in_points() {
    let circle = Wanted {
        name: "sphere, plane",
        a: sphere(1.0),
        b: level(0.3),
        closed: 1,
        open: 0,
        tangential: 0,
        contacts: &[],
        is_proven: true,
        off: |p| (p[2] - 0.3).abs().max((hypot(p) - 1.0).abs()),
    };
    check_everywhere(&circle);
    check_everywhere(&Wanted {
        name: "sphere, equator",
        b: level(0.0),
        off: |p| p[2].abs().max((hypot(p) - 1.0).abs()),
        ..circle
    });
}

#[test]
fn a_plane_through_the_poles_of_a_sphere_gives_one_circle() {
    check_everywhere(&Wanted {
        name: "sphere, meridian",
        a: sphere(1.0),
        b: upright(0.0),
        closed: 1,
        open: 0,
        tangential: 0,
        contacts: &[],
        is_proven: true,
        off: |p| p[0].abs().max((hypot(p) - 1.0).abs()),
    });
}

#[test]
fn cylinders_and_planes() {
    let lines = Wanted {
        name: "cylinder, axial plane",
        a: cylinder(1.0, 2.0),
        b: upright(0.3),
        closed: 0,
        open: 2,
        tangential: 0,
        contacts: &[],
        is_proven: true,
        off: |p| (p[0] - 0.3).abs().max((p[0].hypot(p[1]) - 1.0).abs()),
    };
    check_everywhere(&lines);
    check_everywhere(&Wanted {
        name: "cylinder, oblique plane",
        a: cylinder(1.0, 2.0),
        b: plane([-3.0, -3.0, -0.9], [6.0, 0.0, 1.2], [0.0, 6.0, 0.6]),
        closed: 1,
        open: 0,
        off: |p| (p[2] - 0.2 * p[0] - 0.1 * p[1]).abs().max((p[0].hypot(p[1]) - 1.0).abs()),
        ..lines
    });
}

#[test]
fn a_plane_touches_a_cylinder_along_a_line_and_a_torus_along_a_circle() {
    let line = Wanted {
        name: "cylinder, tangent plane",
        a: cylinder(1.0, 2.0),
        b: upright(1.0),
        closed: 0,
        open: 1,
        tangential: 1,
        contacts: &[],
        is_proven: false,
        off: |p| (p[0] - 1.0).abs().max((p[0].hypot(p[1]) - 1.0).abs()),
    };
    // Rounded poles far away: the plane is a plane through the cylinder then, or beside it, by 1e-12 of the size.
    motions()[..2].iter().for_each(|motion| check(&line, motion));
    let circle = Wanted {
        name: "torus, plane on top",
        a: torus(2.0, 0.5),
        b: level(0.5),
        closed: 1,
        open: 0,
        off: |p| (p[2] - 0.5).abs().max((p[0].hypot(p[1]) - 2.0).abs() * 1e-6),
        ..line
    };
    motions()[..1].iter().for_each(|motion| check(&circle, motion));
}

#[test]
fn two_cylinders_cross_in_loops_and_equal_ones_in_two_ellipses_with_four_arms() {
    let loops = Wanted {
        name: "cylinders",
        a: cylinder(1.0, 2.0),
        b: moved(&cylinder(0.6, 2.0), &z_to_x([0.0; 3])),
        closed: 2,
        open: 0,
        tangential: 0,
        contacts: &[],
        is_proven: true,
        off: |p| (p[0].hypot(p[1]) - 1.0).abs().max((p[1].hypot(p[2]) - 0.6).abs()),
    };
    check_everywhere(&loops);
    let equal = Wanted {
        name: "equal cylinders",
        b: moved(&cylinder(1.0, 2.0), &z_to_x([0.0; 3])),
        closed: 0,
        open: 4,
        contacts: &[ContactKind::Crossing, ContactKind::Crossing],
        is_proven: false,
        off: |p| (p[0].hypot(p[1]) - 1.0).abs().max((p[1].hypot(p[2]) - 1.0).abs()),
        ..loops
    };
    motions()[..1].iter().for_each(|motion| check(&equal, motion));
}

#[test]
fn villarceau_circles_cross_in_two_points() {
    // The plane through the centre that touches the torus twice: sin = r / R.
    let (sin, cos) = (0.25f64, (1.0f64 - 0.0625).sqrt());
    let wanted = Wanted {
        name: "villarceau",
        a: torus(2.0, 0.5),
        b: plane([-3.0 * cos, -3.1, -3.0 * sin], [6.0 * cos, 0.0, 6.0 * sin], [0.0, 6.2, 0.0]),
        closed: 0,
        open: 4,
        tangential: 0,
        contacts: &[ContactKind::Crossing, ContactKind::Crossing],
        is_proven: false,
        // Both circles have the radius 2 and their centres at y = +-1/2.
        off: |p| {
            (p[0].hypot(p[2]).hypot(p[1] - 0.5) - 2.0)
                .abs()
                .min((p[0].hypot(p[2]).hypot(p[1] + 0.5) - 2.0).abs())
        },
    };
    check(&wanted, &Motion::NONE);
}

#[test]
fn tori_cones_and_spheres() {
    let flat = Wanted {
        name: "torus, plane of its centre",
        a: torus(2.0, 0.5),
        b: level(0.0),
        closed: 2,
        open: 0,
        tangential: 0,
        contacts: &[],
        is_proven: true,
        off: |p| p[2].abs().max((p[0].hypot(p[1]) - 2.0).abs() - 0.5).abs(),
    };
    check_everywhere(&flat);
    let through = Wanted {
        name: "cone through a sphere",
        a: cone(-2.0, 0.2, 2.0, 1.0),
        b: sphere(1.2),
        off: |p| (p[0].hypot(p[1]) - 0.6 - 0.2 * p[2]).abs().max((hypot(p) - 1.2).abs()),
        ..flat
    };
    check_everywhere(&through);
    let apex = Wanted {
        name: "cone with its apex",
        a: cone(0.0, 0.0, 2.0, 1.0),
        b: plane([-3.0, -3.0, 0.9], [6.0, 0.0, 1.2], [0.0, 6.0, 0.0]),
        closed: 1,
        off: |p| (p[2] - 1.5 - 0.2 * p[0]).abs().max((p[0].hypot(p[1]) - 0.5 * p[2]).abs()),
        ..through
    };
    check_everywhere(&apex);
}

#[test]
fn what_touches_in_a_point_is_a_contact_and_what_does_not_touch_is_nothing() {
    let found = meet(&IndexedSurface::new(sphere(1.0)), &IndexedSurface::new(upright(1.0)));
    assert_eq!((found.branches.len(), found.contacts.len(), found.undecided.len()), (0, 1, 0));
    let contact = found.contacts[0];
    assert_eq!(contact.kind, ContactKind::Touching);
    assert!((contact.place.point[0] - 1.0).abs() < 1e-12 && contact.radius < 1e-5, "{contact:?}");
    assert!(!found.is_proven);
    // At a collapsed edge.
    let found = meet(&IndexedSurface::new(sphere(1.0)), &IndexedSurface::new(level(1.0)));
    assert_eq!((found.branches.len(), found.contacts.len(), found.undecided.len()), (0, 1, 0));
    assert_eq!(found.contacts[0].kind, ContactKind::Tip);
    for (a, b) in [
        (sphere(1.0), sphere(1.5)),
        (sphere(1.0), level(1.0 + 1e-9)),
        (cylinder(1.0, 2.0), cylinder(1.001, 2.0)),
    ] {
        let found = meet(&IndexedSurface::new(a), &IndexedSurface::new(b));
        assert!(found.is_proven && found.branches.is_empty(), "{} branches", found.branches.len());
    }
}

#[test]
fn coincident_surfaces_are_overlaps() {
    let turned = moved(&sphere(1.0), &z_to_x([0.0; 3]));
    for (a, b) in [
        (sphere(1.0), sphere(1.0)),
        (cylinder(1.0, 2.0), cylinder(1.0, 1.0)),
        (level(0.0), plane([-1.0, -1.0, 0.0], [2.0, 0.3, 0.0], [-0.2, 2.0, 0.0])),
        (sphere(1.0), turned),
    ] {
        let found = meet(&IndexedSurface::new(a), &IndexedSurface::new(b));
        assert!(!found.overlaps.is_empty() && !found.is_proven);
        assert!(
            !found.exhausted && found.undecided.is_empty(),
            "{} undecided",
            found.undecided.len()
        );
    }
}

#[test]
fn a_budget_that_ends_and_a_stop_are_honest() {
    let (a, b) = (IndexedSurface::new(torus(2.0, 0.5)), IndexedSurface::new(level(0.1)));
    let options = MarchOptions { budget: 40, ..MarchOptions::default() };
    let found = intersect(&a, &b, &options, &mut |_, _| false).unwrap();
    assert!(found.exhausted && !found.is_proven && !found.undecided.is_empty());
    let stopped = intersect(&a, &b, &MarchOptions::default(), &mut |_, _| true).unwrap();
    assert!(stopped.stopped && !stopped.exhausted && !stopped.is_proven);
    assert!(stopped.judged == 0 && stopped.branches.is_empty() && !stopped.undecided.is_empty());
    for chord in [-1.0, f64::NAN, f64::INFINITY] {
        let options = MarchOptions { chord, ..MarchOptions::default() };
        let refused = intersect(&a, &b, &options, &mut |_, _| false).unwrap_err();
        assert!(refused.to_string().starts_with("chord"));
    }
}

/// Whether all that `whole` has is in `part`, or in what it lists as undecided.
fn check_part(whole: &Intersection, part: &Intersection, text: &str) {
    let holds = |range: &[f64; 8], p: &MarchPoint| {
        let at = [p.uv[0], p.uv[1], p.st[0], p.st[1]];
        (0..4).all(|q| range[2 * q] - 1e-9 <= at[q] && at[q] <= range[2 * q + 1] + 1e-9)
    };
    let apart = |p: P, q: P| (0..3).map(|k| (p[k] - q[k]).powi(2)).sum::<f64>().sqrt();
    let is_told = |p: &MarchPoint| {
        let areas = part.undecided.iter().chain(&part.overlaps);
        let contacts = part.contacts.iter();
        areas.map(|area| &area.range).any(|range| holds(range, p))
            || contacts.clone().any(|c| apart(c.place.point, p.point) <= 8.0 * c.radius + 1e-9)
            || part.branches.iter().any(|branch| {
                let chord = if branch.chord.is_finite() { branch.chord } else { 1e-2 };
                let near = |w: &[MarchPoint]| {
                    distance_to_chord(p.point, w[0].point, w[1].point) <= 1.01 * chord + 1e-9
                };
                branch.points.windows(2).any(near)
            })
    };
    let points = whole.branches.iter().flat_map(|branch| &branch.points);
    let missing = points.chain(whole.contacts.iter().map(|c| &c.place)).find(|p| !is_told(p));
    assert!(missing.is_none(), "{text}: {missing:?} is lost");
    assert!(!part.is_proven || part.branches.len() == whole.branches.len(), "{text}");
}

#[test]
fn a_stop_gives_what_was_found_and_lists_the_rest() {
    let turned = moved(&sphere(1.0), &z_to_x([0.0; 3]));
    let pairs = [
        (torus(2.0, 0.5), level(0.1), 1e-3),
        (bumps(4, |p| p), lid(4, 4.0 / 9.0 - 1e-4, |p| p), 1e-3),
        (torus(2.0, 0.5), level(0.5), 1e-4),
        (cylinder(1.0, 2.0), cylinder(1.0, 1.0), 0.0),
        (sphere(1.0), turned, 0.0),
        (sphere(1.0), level(1.0), 0.0),
    ];
    let (mut partial, mut given) = (0, 0);
    for (number, (a, b, chord)) in pairs.into_iter().enumerate() {
        let (a, b) = (IndexedSurface::new(a), IndexedSurface::new(b));
        let options = MarchOptions { chord, ..MarchOptions::default() };
        let stopped_at = |n: usize| {
            let mut asked = 0;
            let found = intersect(&a, &b, &options, &mut |_, _| {
                asked += 1;
                asked == n
            });
            (found.unwrap(), asked)
        };
        let (whole, asked) = stopped_at(usize::MAX);
        assert!(!whole.stopped && asked > 0);
        for n in (1..=asked).step_by(asked.div_ceil(12)).chain([asked]) {
            let (part, questions) = stopped_at(n);
            let text = format!("pair {number}, question {n} of {asked}");
            assert!(part.stopped && questions == n, "{text}: {questions} questions");
            assert_eq!(part.exhausted, whole.exhausted, "{text}");
            check_part(&whole, &part, &text);
            let some = !part.branches.is_empty();
            (partial, given) = (partial + usize::from(!part.is_proven), given + usize::from(some));
        }
        // A budget that runs out at any pair is answered in the same way.
        for k in 1..=24 {
            let budget = (whole.judged * k / 25).max(1);
            let options = MarchOptions { budget, ..options };
            let part = intersect(&a, &b, &options, &mut |_, _| false).unwrap();
            let text = format!("pair {number}, budget {budget} of {}", whole.judged);
            assert!(part.exhausted && !part.stopped && part.judged == budget, "{text}");
            assert!(!part.is_proven && !part.undecided.is_empty(), "{text}");
            check_part(&whole, &part, &text);
        }
    }
    assert!(partial > 20 && given > 20, "{partial} parts, {given} with branches");
}

/// A plane that comes as near to a sphere, or to its like, as `gap`: told apart by the arithmetic, and not within the tolerance.
#[test]
fn what_is_nearer_than_the_tolerance_touches_and_points_hold_it() {
    let ask = |a: &Surface, b: &Surface, tolerance: f64| {
        let [a, b] = [a, b].map(|s| IndexedSurface::new(s.clone()));
        let options = MarchOptions { tolerance, ..MarchOptions::default() };
        intersect(&a, &b, &options, &mut |_, _| false).unwrap()
    };
    // Above the top of a sphere by 1e-9: nothing; within 1e-7 a contact whose gap is that.
    let (ball, above) = (sphere(1.0), level(1.0 + 1e-9));
    let apart = ask(&ball, &above, 0.0);
    assert!(apart.is_proven && apart.branches.is_empty() && apart.contacts.is_empty());
    let near = ask(&ball, &above, 1e-7);
    assert_eq!((near.branches.len(), near.contacts.len()), (0, 1), "{:?}", near.contacts);
    assert!(!near.is_proven && (near.contacts[0].gap - 1e-9).abs() < 1e-12);
    // The same where the place is no pole of the sphere, and from inside: one loop to the arithmetic, a contact to the tolerance.
    let turned = moved(&ball, &z_to_x([0.0; 3]));
    for (height, loops) in [(1.0 + 1e-9, 0), (1.0 - 1e-9, 1)] {
        let apart = ask(&turned, &level(height), 0.0);
        assert!(apart.is_proven && apart.branches.len() == loops, "{height}: {:?}", apart.branches);
        let near = ask(&turned, &level(height), 1e-7);
        assert!(near.branches.is_empty() && !near.is_proven, "{height}");
        let [contact] = &near.contacts[..] else { panic!("{:?}", near.contacts) };
        assert_eq!(contact.kind, ContactKind::Touching);
        assert!((contact.gap - 1e-9).abs() < 1e-12 && near.undecided.is_empty(), "{height}");
    }
    let far = ask(&turned, &level(1.0 + 1e-6), 1e-7);
    assert!(far.is_proven && far.contacts.is_empty());
    // What crosses at an angle, or is deeper than the tolerance, is what it is without one.
    let crossing = [
        (ball.clone(), level(1.0 - 1e-4)),
        (turned.clone(), level(1.0 - 1e-4)),
        (torus(2.0, 0.5), level(0.1)),
        (torus(2.0, 0.5), cylinder(2.0, 1.0)),
        (bumps(4, |p| p), lid(4, 4.0 / 9.0 - 1e-4, |p| p)),
        (bumps(4, |p| p), lid(4, 4.0 / 9.0 + 1e-4, |p| p)),
    ];
    for (number, (a, b)) in crossing.iter().enumerate() {
        let (without, with) = (ask(a, b, 0.0), ask(a, b, 1e-7));
        assert!(without.is_proven && with.is_proven, "{number}: {:?}", with.undecided);
        assert_eq!(without.branches.len(), with.branches.len(), "{number}");
        println!("{number}: {} pairs, {} with a tolerance", without.judged, with.judged);
        // One that is as great as what they are: not told apart, and not said to be.
        for tolerance in [1e-5, 1e-3, 1e-2] {
            let with = ask(a, b, tolerance);
            let same = with.branches.len() == without.branches.len();
            println!(
                "{number}: {tolerance:e}: {} branches, {}",
                with.branches.len(),
                with.is_proven
            );
            let listed = with.contacts.len() + with.undecided.len() + with.overlaps.len();
            assert!(if with.is_proven { same } else { listed > 0 }, "{number}: {tolerance:e}");
        }
    }
    // Planes 1e-9 apart are none to the arithmetic, one to the tolerance.
    let (a, b) = (level(0.2), level(0.2 + 1e-9));
    let apart = ask(&a, &b, 0.0);
    assert!(apart.is_proven && apart.overlaps.is_empty());
    let same = ask(&a, &b, 1e-7);
    assert!(!same.overlaps.is_empty() && same.branches.iter().all(|b| b.bounds_overlap));
    assert!(same.branches.iter().all(|b| b.gap <= 1e-7));
    // A tolerance that no arithmetic holds is not said to hold.
    let (ring, plane) = (torus(2.0, 0.5), level(0.1));
    for (tolerance, holds) in [(1e-9, true), (1e-12, true), (1e-17, false)] {
        let found = ask(&ring, &plane, tolerance);
        assert_eq!(found.branches.len(), 2);
        assert_eq!(found.is_proven, holds, "{tolerance:e}, {:e}", found.rounding);
        let worst = found.branches.iter().map(|b| b.gap + found.rounding).fold(0.0, f64::max);
        assert_eq!(worst <= tolerance, holds, "{tolerance:e}: {worst:e}");
    }
    for tolerance in [-1.0, f64::NAN, f64::INFINITY] {
        let options = MarchOptions { tolerance, ..MarchOptions::default() };
        let [x, y] = [&ring, &plane].map(|s| IndexedSurface::new(s.clone()));
        let refused = intersect(&x, &y, &options, &mut |_, _| false).unwrap_err();
        assert!(refused.to_string().starts_with("tolerance"));
    }
}

fn check_loops(n: usize, gap: f64, lift: impl Fn(P) -> P + Copy) {
    let a = IndexedSurface::new(bumps(n, lift));
    let b = IndexedSurface::new(lid(n, 4.0 / 9.0 - gap, lift));
    let found = meet(&a, &b);
    let text = format!("{n} bumps, gap {gap:e}: {} branches", found.branches.len());
    assert!(found.is_proven, "{text}");
    assert_eq!(found.branches.len(), n, "{text}");
    let mut seen = std::collections::BTreeSet::new();
    for branch in &found.branches {
        assert!(branch.is_closed());
        let mut middle = [0.0; 2];
        for p in &branch.points {
            middle = [0, 1].map(|k| middle[k] + p.uv[k] / branch.points.len() as f64);
        }
        let radius = branch
            .points
            .iter()
            .map(|p| (p.uv[0] - middle[0]).hypot(p.uv[1] - middle[1]))
            .fold(0.0, f64::max);
        // Height 4/9 (1 - 3/2 r^2)^2 near the top: r^2 = 3/4 gap.
        assert!(
            radius > 0.5 * gap.sqrt() && radius < 1.6 * gap.sqrt(),
            "{text}: radius {radius:e}"
        );
        seen.insert([0, 1].map(|k| (middle[k] / 5.0).round() as i64));
    }
    assert_eq!(seen.len(), n, "{text}");
}

#[test]
fn all_small_loops_are_found_as_loops_at_every_gap() {
    for gap in [1e-2, 1e-4, 1e-6, 1e-8] {
        for n in [1, 16] {
            check_loops(n, gap, |p| p);
        }
    }
    let turned = Motion::new([0.3, -0.5, 0.7, 0.2], 1.0, [3.0, 1.0, -2.0]);
    for gap in [1e-2, 1e-5, 1e-8] {
        check_loops(9, gap, |p| turned.apply(p));
        // On a curved sheet: a product of parameters is the same on both nets, so that the gap stays.
        check_loops(4, gap, |p| [p[0], p[1], p[2] + 0.02 * p[0] * p[1]]);
    }
}

#[test]
fn one_sheet_sliding_through_tangency_changes_from_loops_to_contacts_to_nothing() {
    let height = 4.0 / 9.0;
    for (shift, loops) in [(-1e-3, 1), (-1e-7, 1), (-1e-9, 1), (1e-9, 0), (1e-6, 0)] {
        let a = IndexedSurface::new(bumps(1, |p| p));
        let found = meet(&a, &IndexedSurface::new(lid(1, height + shift, |p| p)));
        assert_eq!((found.branches.len(), found.is_proven), (loops, true), "shift {shift:e}");
    }
    let a = IndexedSurface::new(bumps(1, |p| p));
    let found = meet(&a, &IndexedSurface::new(lid(1, height, |p| p)));
    assert_eq!((found.branches.len(), found.contacts.len(), found.undecided.len()), (0, 1, 0));
    assert_eq!(found.contacts[0].kind, ContactKind::Touching);
}
