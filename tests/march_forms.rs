//! More closed forms of pairs of quadrics and tori, moved, scaled and far away; touching and crossing ones in every position.

mod march_shapes;

use footpoint::index::IndexedSurface;
use footpoint::march::{ContactKind, Intersection, MarchOptions, intersect};
use footpoint::surface::Surface;
use march_shapes::{Motion, P, cone, cylinder, moved, plane, sphere, torus, z_to_x};

fn meet(a: &Surface, b: &Surface, motion: &Motion) -> Intersection {
    let (a, b) = (motion.surface(a), motion.surface(b));
    intersect(&a, &b, &MarchOptions::default(), &mut |_, _| false).unwrap()
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

fn at(shift: P) -> Motion {
    Motion { shift, ..Motion::NONE }
}

fn upright(x: f64) -> Surface {
    plane([x, -3.0, -3.1], [0.0, 6.2, 0.0], [0.0, 0.0, 6.3])
}

fn level(z: f64) -> Surface {
    plane([-3.1, -3.0, z], [6.0, 0.0, 0.0], [0.0, 6.2, 0.0])
}

fn radius(p: P) -> f64 {
    (p[0] * p[0] + p[1] * p[1] + p[2] * p[2]).sqrt()
}

/// Loops and open branches, each point on both forms.
fn proven(name: &str, a: &Surface, b: &Surface, want: (usize, usize), off: fn(P) -> f64) {
    for motion in motions() {
        let found = meet(a, b, &motion);
        let closed = found.branches.iter().filter(|b| b.is_closed()).count();
        let text = format!("{name}, factor {:e}, shift {:?}", motion.factor, motion.shift);
        assert!(found.is_proven, "{text}: {:?} {}", found.contacts, found.undecided.len());
        assert_eq!((closed, found.branches.len() - closed), want, "{text}");
        let magnitude = motion.shift.iter().fold(motion.factor, |m, x| m.max(x.abs()));
        for branch in &found.branches {
            // What the chord tolerance asks for is proven: 1e-3 of the power of two above the smaller diagonal, at most 16.
            assert!(branch.chord <= 1.7e-2 * motion.factor, "{text}: {:e}", branch.chord);
            for p in &branch.points {
                let by = off(motion.back(p.point)) * motion.factor;
                let allowed = 6e-12 * motion.factor + 8.0 * f64::EPSILON * magnitude;
                assert!(by <= allowed, "{text}: {by:e} at {p:?}");
            }
        }
    }
}

#[test]
fn spheres_cylinders_cones_and_tori_in_every_position() {
    let ball = moved(&sphere(1.2), &at([1.0, 0.2, 0.1]));
    proven("sphere, sphere", &sphere(1.0), &ball, (1, 0), |p| {
        let q = [p[0] - 1.0, p[1] - 0.2, p[2] - 0.1];
        (radius(p) - 1.0).abs().max((radius(q) - 1.2).abs())
    });
    proven("sphere, cylinder", &sphere(1.5), &cylinder(1.0, 2.5), (2, 0), |p| {
        (radius(p) - 1.5).abs().max((p[0].hypot(p[1]) - 1.0).abs())
    });
    let tube = moved(&cylinder(0.5, 2.5), &at([0.8, 0.1, 0.0]));
    proven("sphere, cylinder through its side", &sphere(1.0), &tube, (1, 0), |p| {
        (radius(p) - 1.0).abs().max(((p[0] - 0.8).hypot(p[1] - 0.1) - 0.5).abs())
    });
    let lying = moved(&cylinder(0.3, 3.0), &z_to_x([0.0, 0.1, 0.15]));
    proven("torus, cylinder", &torus(2.0, 0.5), &lying, (4, 0), |p| {
        let tube = ((p[1] - 0.1).hypot(p[2] - 0.15) - 0.3).abs();
        ((p[0].hypot(p[1]) - 2.0).hypot(p[2]) - 0.5).abs().max(tube)
    });
    proven("torus, sphere on its axis", &torus(2.0, 0.5), &sphere(2.0), (2, 0), |p| {
        ((p[0].hypot(p[1]) - 2.0).hypot(p[2]) - 0.5).abs().max((radius(p) - 2.0).abs())
    });
    let other = moved(&torus(2.0, 0.5), &z_to_x([2.0, 0.0, 0.0]));
    proven("torus, torus across", &torus(2.0, 0.4), &other, (2, 0), |p| {
        let q = [p[0] - 2.0, p[1], p[2]];
        let ours = ((p[0].hypot(p[1]) - 2.0).hypot(p[2]) - 0.4).abs();
        ours.max(((q[1].hypot(q[2]) - 2.0).hypot(q[0]) - 0.5).abs())
    });
    let narrow = moved(&cone(-2.0, 0.1, 2.0, 0.5), &z_to_x([0.0, 0.0, 0.3]));
    proven("cone, cone", &cone(-2.0, 1.5, 2.0, 1.0), &narrow, (2, 0), |p| {
        let wide = (p[0].hypot(p[1]) - 1.25 + 0.125 * p[2]).abs();
        wide.max((p[1].hypot(p[2] - 0.3) - 0.3 - 0.1 * p[0]).abs())
    });
    proven("cone, cylinder", &cone(-2.0, 1.5, 2.0, 0.5), &cylinder(1.0, 2.5), (1, 0), |p| {
        (p[0].hypot(p[1]) - 1.0).abs().max((p[0].hypot(p[1]) - 1.0 + 0.25 * p[2]).abs())
    });
    // A plane along the axis beside it: a hyperbola; one parallel to a generatrix: a parabola.
    proven("cone, plane: hyperbola", &cone(0.1, 0.1, 2.0, 2.0), &upright(0.5), (0, 1), |p| {
        (p[0] - 0.5).abs().max((p[0].hypot(p[1]) - p[2]).abs())
    });
    let slope = plane([-3.0, -3.0, -2.5], [6.0, 0.0, 6.0], [0.0, 6.1, 0.0]);
    proven("cone, plane: parabola", &cone(0.1, 0.1, 2.0, 2.0), &slope, (0, 1), |p| {
        (p[2] - p[0] - 0.5).abs().max((p[0].hypot(p[1]) - p[2]).abs())
    });
    proven("plane, plane", &level(0.2), &upright(0.3), (0, 1), |p| {
        (p[2] - 0.2).abs().max((p[0] - 0.3).abs())
    });
    // Nothing in common.
    let ball = moved(&sphere(0.5), &at([0.2, 0.0, 0.0]));
    proven("sphere in a sphere", &sphere(1.0), &ball, (0, 0), |_| 0.0);
    proven("tubes about one axis", &cylinder(1.0, 2.0), &cylinder(0.999, 2.0), (0, 0), |_| 0.0);
    proven("sphere in a torus", &torus(2.0, 0.5), &sphere(1.4), (0, 0), |_| 0.0);
}

/// Contacts of a kind, and open branches between them, in every position.
fn singular(
    name: &str,
    a: &Surface,
    b: &Surface,
    kinds: &[ContactKind],
    open: usize,
    closed: usize,
    positions: &[Motion],
) {
    for motion in positions {
        let found = meet(a, b, motion);
        let seen: Vec<ContactKind> = found.contacts.iter().map(|c| c.kind).collect();
        let loops = found.branches.iter().filter(|b| b.is_closed()).count();
        let text = format!(
            "{name}, factor {:e}, shift {:?}: {seen:?}, {} undecided",
            motion.factor,
            motion.shift,
            found.undecided.len()
        );
        assert!(!found.is_proven, "{text}");
        assert_eq!(seen, kinds, "{text}");
        assert_eq!((found.branches.len() - loops, loops), (open, closed), "{text}");
    }
}

#[test]
fn crossings_and_touching_points_in_every_position() {
    use ContactKind::{Crossing, Touching};
    let near = &motions();
    let (sin, cos) = (0.25f64, (1.0f64 - 0.0625).sqrt());
    let through =
        plane([-3.0 * cos, -3.1, -3.0 * sin], [6.0 * cos, 0.0, 6.0 * sin], [0.0, 6.2, 0.0]);
    singular("villarceau", &torus(2.0, 0.5), &through, &[Crossing; 2], 4, 0, near);
    let across = moved(&cylinder(1.0, 2.0), &z_to_x([0.0; 3]));
    singular("equal cylinders", &cylinder(1.0, 2.0), &across, &[Crossing; 2], 4, 0, near);
    singular("sphere, tangent plane", &sphere(1.0), &upright(1.0), &[Touching], 0, 0, near);
    let ball = moved(&sphere(0.7), &at([1.7, 0.0, 0.0]));
    singular("touching spheres", &sphere(1.0), &ball, &[Touching], 0, 0, near);
    // Viviani: a cylinder of half the radius that touches the sphere from inside, a figure of eight.
    let tube = moved(&cylinder(0.5, 1.5), &at([0.5, 0.0, 0.0]));
    let ball = moved(&sphere(1.0), &Motion::new([0.9, 0.2, 0.3, 0.1], 1.0, [0.0; 3]));
    singular("viviani", &ball, &tube, &[Crossing], 2, 0, near);
    singular("saddle of a torus", &torus(2.0, 0.5), &upright(1.5), &[Crossing], 2, 0, near);
}

#[test]
fn areas_of_coincidence_are_bounded_by_curves() {
    // A small sheet on a large one, and two that lie over one another like shingles.
    let large = level(0.2);
    let small = plane([-1.0, -1.0, 0.2], [2.0, 0.3, 0.0], [-0.2, 2.0, 0.0]);
    let found = meet(&large, &small, &Motion::NONE);
    let rims: Vec<_> = found.branches.iter().filter(|b| b.bounds_overlap).collect();
    assert_eq!((rims.len(), found.branches.len()), (1, 1));
    assert!(rims[0].is_closed() && !found.is_proven && found.undecided.is_empty());
    let length = |points: &[footpoint::march::MarchPoint]| {
        let apart = |w: &[footpoint::march::MarchPoint]| {
            (0..3).map(|k| (w[0].point[k] - w[1].point[k]).powi(2)).sum::<f64>().sqrt()
        };
        points.windows(2).map(apart).sum::<f64>()
    };
    let want = 2.0 * (4.09f64.sqrt() + 4.04f64.sqrt());
    assert!((length(&rims[0].points) - want).abs() < 1e-6, "{}", length(&rims[0].points));
    let shifted = moved(&level(0.2), &at([2.0, 1.0, 0.0]));
    let found = meet(&large, &shifted, &Motion::NONE);
    let rims: Vec<_> = found.branches.iter().filter(|b| b.bounds_overlap).collect();
    assert_eq!(rims.len(), 1);
    assert!(rims[0].is_closed());
    assert!((length(&rims[0].points) - 2.0 * (4.0 + 5.2)).abs() < 1e-6);
    // Tubes of one radius and axis: the shorter one's two circles. Spheres: no border.
    let found = meet(&cylinder(1.0, 2.0), &cylinder(1.0, 1.0), &Motion::NONE);
    let rims: Vec<_> = found.branches.iter().filter(|b| b.bounds_overlap).collect();
    assert_eq!(rims.len(), 2);
    for rim in rims {
        assert!(rim.points.iter().all(|p| (p.point[2].abs() - 1.0).abs() < 1e-9));
        assert!((length(&rim.points) - std::f64::consts::TAU).abs() < 1e-2);
    }
    let found = meet(&sphere(1.0), &sphere(1.0), &Motion::NONE);
    assert!(found.branches.is_empty() && !found.overlaps.is_empty());
}

#[test]
fn the_proven_chord_holds() {
    let a = IndexedSurface::new(torus(2.0, 0.5));
    let b = IndexedSurface::new(plane([-3.0, -3.1, 0.1], [6.0, 0.0, 0.3], [0.0, 6.2, 0.2]));
    let ask = |chord: f64| {
        let options = MarchOptions { chord, ..MarchOptions::default() };
        intersect(&a, &b, &options, &mut |_, _| false).unwrap()
    };
    let fine = ask(1e-6);
    for chord in [1e-1, 1e-2, 1e-3, 1e-4] {
        let found = ask(chord);
        assert!(found.is_proven && found.branches.len() == fine.branches.len());
        for branch in &found.branches {
            assert!(branch.chord <= chord && branch.chord > 0.0);
            // Each point of the fine branch is as near to the chords as was proven.
            let mut worst = 0.0f64;
            for p in fine.branches.iter().flat_map(|b| &b.points).step_by(7) {
                let far = |w: &[footpoint::march::MarchPoint]| {
                    footpoint::march::distance_to_chord(p.point, w[0].point, w[1].point)
                };
                let own = branch.points.windows(2).map(far).fold(f64::INFINITY, f64::min);
                let all = found.branches.iter().flat_map(|b| b.points.windows(2));
                let nearest = all.map(far).fold(f64::INFINITY, f64::min);
                if own == nearest {
                    worst = worst.max(own);
                }
            }
            assert!(worst <= branch.chord + 1e-6, "{worst:e} > {:e}", branch.chord);
        }
    }
}
