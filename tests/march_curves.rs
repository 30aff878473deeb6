//! Curves of branches with corners, borders and coincident surfaces; every phase of an intersection asks whether to stop.

mod march_shapes;

use footpoint::error::Error;
use footpoint::index::IndexedSurface;
use footpoint::march::curves::{BranchCurves, curves};
use footpoint::march::faces::intersect_faces;
use footpoint::march::split::{cuts_of, split};
use footpoint::march::{Branch, Intersection, MarchOptions, intersect};
use footpoint::surface::Surface;
use footpoint::trim::TrimmedSurface;
use march_shapes::{Motion, P, cylinder, moved, plane, torus, z_to_x};

fn indexed(s: &Surface) -> IndexedSurface {
    IndexedSurface::new(s.clone())
}

fn meet(a: &Surface, b: &Surface) -> Intersection {
    intersect(&indexed(a), &indexed(b), &MarchOptions::default(), &mut |_, _| false).unwrap()
}

fn fitted(a: &Surface, b: &Surface, branch: &Branch, tolerance: f64) -> Vec<BranchCurves> {
    curves(&indexed(a), &indexed(b), &branch.points, tolerance, &mut |_, _| false).unwrap()
}

fn apart(p: P, q: P) -> f64 {
    (0..3).map(|k| (p[k] - q[k]).powi(2)).sum::<f64>().sqrt()
}

/// A cubic in u with a corner at u = 1/2, drawn up from z = 0 to z = 1: an arch, a corner, an arch.
fn folded() -> Surface {
    let knots = [0.0, 0.0, 0.0, 0.0, 0.5, 0.5, 0.5, 1.0, 1.0, 1.0, 1.0];
    let outline =
        [[-1.0, 0.0], [-0.9, 0.6], [-0.4, 0.9], [0.0, 0.2], [0.3, 0.8], [0.8, 0.7], [1.0, -0.1]];
    let poles: Vec<P> =
        outline.iter().flat_map(|&[x, y]| [[x, y, 0.0], [x, y + 0.1, 1.0]]).collect();
    Surface::new(&knots, &[0.0, 0.0, 1.0, 1.0], 3, 1, &poles, 7, 2, None).unwrap()
}

/// Each part is within its error of both surfaces, and they follow one another.
fn check_parts(a: &Surface, b: &Surface, parts: &[BranchCurves]) {
    for part in parts {
        let (low, high) = part.space.domain();
        for n in 0..=200 {
            let t = (low + (high - low) * f64::from(n) / 200.0).min(high);
            let (p, uv, st) = (part.space.evaluate(t), part.uv.evaluate(t), part.st.evaluate(t));
            let far = apart(p, a.evaluate(uv[0], uv[1])).max(apart(p, b.evaluate(st[0], st[1])));
            assert!(far <= part.error + 1e-14, "{far:e} > {:e}", part.error);
        }
    }
    for pair in parts.windows(2) {
        let (end, start) = (pair[0].space.domain().1, pair[1].space.domain().0);
        assert!(apart(pair[0].space.evaluate(end), pair[1].space.evaluate(start)) < 1e-9);
    }
}

#[test]
fn a_branch_with_a_corner_is_fitted_in_parts() {
    let a = folded();
    // Through the middle, slanted, and along the border z = 0 of the folded sheet.
    let level =
        |z: f64, rise: f64| plane([-2.0, -2.0, z], [4.0, 0.0, rise], [0.0, 4.1, 0.3 * rise]);
    for b in [level(0.3, 0.0), level(0.4, 0.1), level(0.0, 0.0)] {
        let found = meet(&a, &b);
        assert_eq!(found.branches.len(), 1, "{found:?}");
        for tolerance in [1e-4, 1e-7] {
            let parts = fitted(&a, &b, &found.branches[0], tolerance);
            assert_eq!(parts.len(), 2);
            check_parts(&a, &b, &parts);
            for part in &parts {
                assert!(part.error <= tolerance, "{:e} for {tolerance:e}", part.error);
                assert!(part.space.poles().len() < 300, "{}", part.space.poles().len());
            }
            let corner = parts[1].uv.evaluate(parts[1].uv.domain().0);
            assert!((corner[0] - 0.5).abs() < 1e-9, "{corner:?}");
        }
    }
}

#[test]
fn a_smooth_branch_over_knots_of_full_multiplicity_is_one_part() {
    // Circles are four arcs with double knots, and smooth.
    let (a, b) = (cylinder(1.0, 2.0), plane([-3.0, -3.1, 0.1], [6.0, 0.0, 0.3], [0.0, 6.2, 0.2]));
    let found = meet(&a, &b);
    let parts: usize = found.branches.iter().map(|br| fitted(&a, &b, br, 1e-6).len()).sum();
    // Cut at the seam alone, or where it was begun.
    assert!(parts <= 2, "{parts}");
}

#[test]
fn the_border_of_an_overlap_is_fitted_from_corner_to_corner() {
    let large = plane([-3.1, -3.0, 0.2], [6.0, 0.0, 0.0], [0.0, 6.2, 0.0]);
    let inside = plane([-1.0, -1.0, 0.2], [2.0, 0.3, 0.0], [-0.2, 2.0, 0.0]);
    let shifted = plane([-1.1, -2.0, 0.2], [6.0, 0.0, 0.0], [0.0, 6.2, 0.0]);
    for small in [inside, shifted] {
        let found = meet(&large, &small);
        assert!(found.branches.len() == 1 && found.branches[0].bounds_overlap);
        let parts = fitted(&large, &small, &found.branches[0], 1e-7);
        assert!((4..=5).contains(&parts.len()), "{}", parts.len());
        check_parts(&large, &small, &parts);
        assert!(parts.iter().all(|part| part.error <= 1e-9 && part.space.poles().len() < 100));
    }
}

#[test]
fn the_border_of_an_overlap_goes_over_the_seam_of_the_other_surface() {
    // The same tube, shorter and turned about its axis: the seam of the longer one lies in the middle of the rims.
    let long = cylinder(1.0, 2.0);
    let turn = Motion::new([1f64.cos(), 0.0, 0.0, 1f64.sin()], 1.0, [0.0; 3]);
    let short = moved(&cylinder(1.0, 1.0), &turn);
    for [a, b] in [[&long, &short], [&short, &long]] {
        let found = meet(a, b);
        assert!(found.branches.len() == 2 && found.branches.iter().all(|rim| rim.bounds_overlap));
        for rim in &found.branches {
            let parts = fitted(a, b, rim, 1e-6);
            assert!((2..=4).contains(&parts.len()), "{}", parts.len());
            check_parts(a, b, &parts);
            assert!(
                parts.iter().all(|part| part.error <= 1e-4),
                "{:?}",
                parts.iter().map(|p| p.error).collect::<Vec<_>>()
            );
        }
    }
}

#[test]
fn a_fit_that_misses_its_tolerance_is_no_worse_than_the_chords() {
    let (a, b) = (torus(2.0, 0.5), plane([-3.0, -3.1, 0.1], [6.0, 0.0, 0.3], [0.0, 6.2, 0.2]));
    for chord in [1e-1, 1e-2] {
        let options = MarchOptions { chord, ..MarchOptions::default() };
        let found = intersect(&indexed(&a), &indexed(&b), &options, &mut |_, _| false).unwrap();
        for branch in &found.branches {
            // Below the last digits: not to be had.
            let parts = fitted(&a, &b, branch, 1e-17);
            check_parts(&a, &b, &parts);
            assert!(parts.iter().all(|part| part.error > 1e-17 && part.error < 8.0 * chord));
        }
    }
}

/// Stops `ask` at each of its questions in turn, at most forty of them; returns how many there were. `is_stopped`: whether an answer says
/// that it is that of a stop; without one a stop must be an error.
fn stopped_everywhere<T>(
    is_stopped: Option<fn(&T) -> bool>,
    ask: impl Fn(&mut dyn FnMut(u64, u64) -> bool) -> Result<T, Error>,
) -> u64 {
    let mut count = 0;
    let whole = ask(&mut |_, _| {
        count += 1;
        false
    });
    assert!(whole.is_ok_and(|whole| is_stopped.is_none_or(|is_stopped| !is_stopped(&whole))));
    for at in (0..count).step_by((count as usize).div_ceil(40)) {
        let mut asked = 0;
        let stopped = ask(&mut |_, _| {
            assert!(asked <= at, "asked again after it was stopped");
            asked += 1;
            asked > at
        });
        match is_stopped {
            Some(is_stopped) => assert!(stopped.is_ok_and(|part| is_stopped(&part))),
            None => assert_eq!(stopped.err(), Some(Error::Cancelled), "question {at} of {count}"),
        }
    }
    count
}

#[test]
fn every_phase_asks_whether_to_stop() {
    let level = |z: f64| plane([-3.1, -3.0, z], [6.0, 0.0, 0.0], [0.0, 6.2, 0.0]);
    let small = plane([-1.0, -1.0, 0.2], [2.0, 0.3, 0.0], [-0.2, 2.0, 0.0]);
    let across = moved(&cylinder(0.6, 2.0), &z_to_x([0.0; 3]));
    // Transversal; touching along a circle; coincident.
    let pairs = [
        (cylinder(1.0, 2.0), across.clone(), 1e-6),
        (torus(2.0, 0.5), level(0.5), 1e-4),
        (level(0.2), small, 0.0),
    ];
    for (a, b, chord) in pairs {
        let options = MarchOptions { chord, ..MarchOptions::default() };
        let (a, b) = (indexed(&a), indexed(&b));
        let judged = intersect(&a, &b, &options, &mut |_, _| false).unwrap().judged;
        let asked = stopped_everywhere(Some(|f: &Intersection| f.stopped), |poll| {
            intersect(&a, &b, &options, poll)
        });
        // One question in 256 pairs, and one at least: the others come from what is done with them.
        assert!(asked > judged / 256 + 2, "{asked} questions, {judged} pairs");
    }
    let faces = [cylinder(1.0, 2.0), across].map(|s| TrimmedSurface::whole(s.into()).unwrap());
    let options = MarchOptions { chord: 1e-5, ..MarchOptions::default() };
    stopped_everywhere(Some(|f: &Intersection| f.stopped), |poll| {
        intersect_faces(&faces[0], &faces[1], &options, poll)
    });
    let found = intersect_faces(&faces[0], &faces[1], &options, &mut |_, _| false).unwrap();
    let cuts = cuts_of(&found, false).unwrap();
    assert!(stopped_everywhere(None, |poll| split(&faces[0], &cuts, 1e-6, poll)) > 0);
    let (a, b) = (cylinder(1.0, 2.0), level(0.3));
    let branch = &meet(&a, &b).branches[0];
    let (a, b) = (indexed(&a), indexed(&b));
    assert!(stopped_everywhere(None, |poll| curves(&a, &b, &branch.points, 1e-8, poll)) > 1);
}
