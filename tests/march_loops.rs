//! Small loops: on curved and rational sheets, turned, scaled, and with one sheet sliding through tangency: the right count at every
//! position, or an honest contact, never a wrong one.

mod march_shapes;

use footpoint::index::IndexedSurface;
use footpoint::march::{ContactKind, End, Intersection, MarchOptions, intersect};
use footpoint::surface::Surface;
use march_shapes::{Motion, P, bumps, lid};

const HEIGHT: f64 = 4.0 / 9.0;

fn meet(a: &Surface, b: &Surface) -> Intersection {
    let (a, b) = (IndexedSurface::new(a.clone()), IndexedSurface::new(b.clone()));
    intersect(&a, &b, &MarchOptions::default(), &mut |_, _| false).unwrap()
}

/// The image of a sheet under (x, y, z) -> (x, y, z) / (1 + a x + b y): rational, planes stay planes, what meets stays.
fn in_perspective(s: &Surface, [a, b]: [f64; 2]) -> Surface {
    let (u, v) = (s.knots_u(), s.knots_v());
    let weight = |p: &P| 1.0 + a * p[0] + b * p[1];
    let poles: Vec<P> = s.poles().iter().map(|p| p.map(|x| x / weight(p))).collect();
    let weights: Vec<f64> = s.poles().iter().map(weight).collect();
    Surface::new(
        u.values(),
        v.values(),
        u.degree(),
        v.degree(),
        &poles,
        u.pole_count(),
        v.pole_count(),
        Some(&weights),
    )
    .unwrap()
}

/// How a pair of sheets is carried to another one on which as many loops are.
type Carry = fn(&Surface) -> Surface;

fn turned(s: &Surface) -> Surface {
    march_shapes::moved(s, &Motion::new([0.3, -0.5, 0.7, 0.2], 1.0, [3.0, 1.0, -2.0]))
}

const CARRIES: [(&str, Carry); 5] = [
    ("as they are", |s| s.clone()),
    ("turned", turned),
    ("rational", |s| in_perspective(s, [0.03, -0.01])),
    ("rational, turned", |s| turned(&in_perspective(s, [0.02, 0.02]))),
    ("scaled by 1e-6", |s| {
        march_shapes::moved(s, &Motion::new([0.9, 0.1, 0.3, 0.1], 1e-6, [2e-6, 0.0, 1e-6]))
    }),
];

/// A sheet on a saddle: a product of parameters is the same on both nets, so that the gap stays.
fn saddle(p: P) -> P {
    [p[0], p[1], p[2] + 0.02 * p[0] * p[1]]
}

#[test]
fn as_many_loops_as_bumps_on_every_kind_of_sheet() {
    for (name, carry) in CARRIES {
        for (n, gap) in [(4, 1e-2), (9, 1e-4), (4, 1e-6), (4, 1e-8)] {
            for lift in [|p: P| p, saddle] {
                let (a, b) = (carry(&bumps(n, lift)), carry(&lid(n, HEIGHT - gap, lift)));
                let found = meet(&a, &b);
                let text = format!("{name}, {n} bumps, gap {gap:e}");
                assert!(found.is_proven, "{text}: {} undecided", found.undecided.len());
                assert_eq!(found.branches.len(), n, "{text}");
                assert!(found.branches.iter().all(|b| b.is_closed()), "{text}");
            }
        }
    }
}

#[test]
fn a_sheet_that_slides_through_tangency_never_shows_a_wrong_count() {
    let (n, mut decided, mut open) = (4, 0, 0);
    for (name, carry) in CARRIES {
        for lift in [|p: P| p, saddle] {
            for exponent in [2, 4, 6, 8, 10, 11, 12, 13, 14, 17] {
                for sign in [-1.0, 1.0, 0.0] {
                    if sign == 0.0 && exponent > 2 {
                        continue;
                    }
                    let shift = sign * 10f64.powi(-exponent);
                    let found =
                        meet(&carry(&bumps(n, lift)), &carry(&lid(n, HEIGHT + shift, lift)));
                    let loops = found.branches.iter().filter(|b| b.is_closed()).count();
                    let text = format!("{name}, shift {shift:e}: {loops} loops");
                    // A piece of a loop beside what was not told apart says so.
                    let honest = |end: &End| matches!(end, End::Undecided | End::Contact(_));
                    let mut pieces = found.branches.iter().filter(|b| !b.is_closed());
                    assert!(pieces.all(|b| b.ends.iter().all(honest)), "{text}");
                    if found.is_proven {
                        assert_eq!(loops, found.branches.len(), "{text}");
                        // What is proven is true: rounding of the poles moves the sheets by less than 1e-14.
                        let want = if shift < 0.0 { n } else { 0 };
                        let clear = shift.abs() > 1e-14;
                        assert!(!clear || loops == want, "{text}");
                        decided += 1;
                    } else {
                        // Each bump is a loop, a contact, a box, or nothing when that is proven.
                        let kinds = [ContactKind::Touching, ContactKind::Degenerate];
                        assert!(found.contacts.iter().all(|c| kinds.contains(&c.kind)), "{text}");
                        let seen = loops + found.contacts.len() + found.undecided.len();
                        assert!(seen > 0 && loops <= n, "{text}");
                        let whole = loops == found.branches.len();
                        assert!(!whole || loops + found.contacts.len() <= n, "{text}");
                        // The sheets are 17 long: that is 1e-12 of it.
                        assert!(shift.abs() <= 1e-11, "{text}: not decided");
                        assert!(shift >= 0.0 || seen >= n || shift > -1e-14, "{text}: {seen}");
                        open += 1;
                    }
                }
            }
        }
    }
    println!("{decided} positions decided, {open} not");
    assert!(decided > 100 && open > 0);
}

#[test]
fn pairs_that_are_judged_grow_with_the_number_of_loops() {
    let judged = |n: usize| {
        let found = meet(&bumps(n, |p| p), &lid(n, HEIGHT - 1e-4, |p| p));
        assert_eq!((found.branches.len(), found.is_proven), (n, true));
        found.judged
    };
    let (few, many) = (judged(4), judged(64));
    assert!(many <= 17 * few, "{few} pairs for 4 loops, {many} for 64");
}
