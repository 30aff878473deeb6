//! Each method of intersection by name, beside the certified search; curves and fewer points of branches.

mod march_shapes;

use footpoint::index::IndexedSurface;
use footpoint::march::bisect::refined;
use footpoint::march::correct::{Corrector, correct};
use footpoint::march::curves::{curves, reduced};
use footpoint::march::follow::{WalkEnd, follow};
use footpoint::march::triangles::{Polyline, meshed, subdivided};
use footpoint::march::{MarchOptions, MarchPoint, intersect, named};
use footpoint::surface::Surface;
use march_shapes::{P, bumps, cylinder, lid, moved, plane, sphere, torus, z_to_x};

fn pair() -> (Surface, Surface) {
    (torus(2.0, 0.5), plane([-3.0, -3.1, 0.1], [6.0, 0.0, 0.3], [0.0, 6.2, 0.2]))
}

fn off(p: P) -> f64 {
    let plane = p[2] - 0.1 - 0.05 * (p[0] + 3.0) - 0.2 / 6.2 * (p[1] + 3.1);
    let torus = (p[0].hypot(p[1]) - 2.0).hypot(p[2]) - 0.5;
    plane.abs().max(torus.abs())
}

/// A place beside the curve, some share of the domain away on all four parameters.
fn starts(a: &Surface, b: &Surface, beside: f64) -> Vec<[f64; 4]> {
    let found = intersect(
        &IndexedSurface::new(a.clone()),
        &IndexedSurface::new(b.clone()),
        &MarchOptions::default(),
        &mut |_, _| false,
    )
    .unwrap();
    let points = found.branches.iter().flat_map(|branch| branch.points.iter().step_by(7));
    let moved = |x: f64, by: f64| (x + by * beside).clamp(0.0, 1.0);
    points
        .map(|p| {
            [moved(p.uv[0], 0.7), moved(p.uv[1], -0.5), moved(p.st[0], 0.6), moved(p.st[1], 0.9)]
        })
        .collect()
}

#[test]
fn correctors_end_on_both_surfaces_in_few_steps() {
    let (a, b) = pair();
    let starts = starts(&a, &b, 1e-2);
    assert!(starts.len() > 10);
    let methods = [
        Corrector::Auto,
        Corrector::NewtonFour,
        Corrector::Maf,
        Corrector::NewtonThree(0),
        Corrector::NewtonThree(1),
        Corrector::NewtonThree(2),
        Corrector::NewtonThree(3),
    ];
    for method in methods {
        let (mut solved, mut steps) = (0, 0);
        for &start in &starts {
            let mut seen = 0;
            let mut trace = |_: u32, _: [f64; 4], _: f64| seen += 1;
            let Some(found) = correct(&a, &b, start, method, 1e-9, Some(&mut trace)) else {
                continue;
            };
            let [u, v, s, t] = found.at;
            assert!(
                off(a.evaluate(u, v)) < 2e-9 && off(b.evaluate(s, t)) < 2e-9,
                "{method:?} {found:?}"
            );
            assert_eq!(seen, found.steps + 1);
            if let Corrector::NewtonThree(held) = method {
                assert_eq!(found.at[held], start[held]);
            }
            (solved, steps) = (solved + 1, steps + found.steps);
        }
        println!(
            "{method:?}: {solved} of {}, {:.2} steps",
            starts.len(),
            f64::from(steps) / f64::from(solved.max(1))
        );
        // An isoline may miss the curve: three parameters then fail, and say so. All four must not.
        let all = !matches!(method, Corrector::NewtonThree(_));
        assert!(
            if all { solved as usize == starts.len() } else { solved > 0 },
            "{method:?}: {solved}"
        );
        assert!(!all || steps <= 8 * solved, "{method:?}: {steps} steps for {solved}");
    }
}

/// Steps as the papers count them: until the gap is within the tolerance, without the step that confirms it; from places as marching makes
/// them, straight on along the last chord.
#[test]
fn from_marching_starts_correctors_take_two_or_three_steps() {
    let (a, b) = pair();
    let [x, y] = [&a, &b].map(|s| IndexedSurface::new(s.clone()));
    let mut starts = Vec::new();
    for branch in intersect(&x, &y, &MarchOptions::default(), &mut |_, _| false).unwrap().branches {
        for w in branch.points.windows(3) {
            let [p, q, r] = [w[0], w[1], w[2]].map(|p| [p.uv[0], p.uv[1], p.st[0], p.st[1]]);
            let length = |i: usize| {
                let by = |k: usize| (w[i + 1].point[k] - w[i].point[k]).powi(2);
                (0..3).map(by).sum::<f64>().sqrt()
            };
            let share = length(1) / length(0);
            let ahead = [0, 1, 2, 3].map(|k| q[k] + share * (q[k] - p[k]));
            // Not over a seam, where parameters jump.
            let is_near = (0..4).all(|k| (ahead[k] - r[k]).abs() < 0.1);
            if is_near && ahead.iter().all(|x| (0.0..=1.0).contains(x)) {
                starts.push(ahead);
            }
        }
    }
    assert!(starts.len() > 40, "{}", starts.len());
    for method in [Corrector::NewtonFour, Corrector::Maf] {
        for tolerance in [1e-6, 1e-12] {
            let (mut all, mut most) = (0, 0);
            for &start in &starts {
                let mut first = None;
                let mut trace = |step: u32, _: [f64; 4], gap: f64| {
                    if gap <= tolerance && first.is_none() {
                        first = Some(step);
                    }
                };
                assert!(correct(&a, &b, start, method, tolerance, Some(&mut trace)).is_some());
                let steps = first.unwrap();
                (all, most) = (all + steps, most.max(steps));
            }
            let mean = f64::from(all) / starts.len() as f64;
            println!(
                "{method:?}, {tolerance:e}: {mean:.2} steps, {most} at most, {} starts",
                starts.len()
            );
            // The first step of the moving affine frame is the ball transform of the start, which the papers do not count.
            let extra = if method == Corrector::Maf { 1.0 } else { 0.0 };
            assert!(mean <= 3.0 + extra, "{method:?}: {mean}");
        }
    }
}

#[test]
fn a_held_isoline_that_misses_the_curve_is_a_failure_and_a_border_is_kept() {
    // The loop around a bump: u beyond it never meets the lid.
    let (a, b) = (bumps(1, |p| p), lid(1, 4.0 / 9.0 - 1e-2, |p| p));
    let start = [4.5, 3.0, 0.5, 0.5];
    assert!(correct(&a, &b, start, Corrector::NewtonThree(0), 1e-10, None).is_none());
    // A curve that leaves through a border: the corrected place stays in the domain and on the curve.
    let (a, b) = (cylinder(1.0, 2.0), plane([0.3, -3.0, -3.1], [0.0, 6.2, 0.0], [0.0, 0.0, 6.3]));
    let u = 0.2;
    let found = correct(&a, &b, [u, 1.0, 0.6, 0.9], Corrector::NewtonFour, 1e-12, None).unwrap();
    assert!(found.gap < 1e-14 && (0.0..=1.0).contains(&found.at[1]));
}

#[test]
fn marching_finds_the_branch_of_its_start() {
    let (a, b) = pair();
    let whole = intersect(
        &IndexedSurface::new(a.clone()),
        &IndexedSurface::new(b.clone()),
        &MarchOptions::default(),
        &mut |_, _| false,
    );
    let whole = whole.unwrap();
    for corrector in [Corrector::Auto, Corrector::Maf] {
        for branch in &whole.branches {
            let p = branch.points[branch.points.len() / 3];
            let start = [p.uv[0], p.uv[1], p.st[0], p.st[1]];
            let walk = follow(&a, &b, start, corrector, 0.05, 1e-3, &mut || false).unwrap();
            // The walk ends at the seams of the torus, the branch goes on.
            assert!(
                walk.ends.iter().all(|end| matches!(end, WalkEnd::Border | WalkEnd::Closed)),
                "{:?}",
                walk.ends
            );
            assert!(walk.places.len() > 10);
            for at in &walk.places {
                assert!(off(a.evaluate(at[0], at[1])) < 1e-4);
            }
        }
    }
    // A loop inside both domains closes.
    let (a, b) = (bumps(1, |p| p), lid(1, 4.0 / 9.0 - 1e-2, |p| p));
    let top = intersect(
        &IndexedSurface::new(a.clone()),
        &IndexedSurface::new(b.clone()),
        &MarchOptions::default(),
        &mut |_, _| false,
    );
    let p = top.unwrap().branches[0].points[3];
    let start = [p.uv[0], p.uv[1], p.st[0], p.st[1]];
    let walk = follow(&a, &b, start, Corrector::Auto, 0.01, 1e-4, &mut || false).unwrap();
    assert_eq!(walk.ends, [WalkEnd::Closed; 2]);
    assert!(walk.places.len() > 12 && walk.places.len() < 400);
}

fn length(line: &Polyline) -> f64 {
    let apart = |w: &[footpoint::march::triangles::Node]| {
        (0..3).map(|k| (w[0].x[k] - w[1].x[k]).powi(2)).sum::<f64>().sqrt()
    };
    line.windows(2).map(apart).sum()
}

#[test]
fn discrete_methods_find_the_same_curves_coarsely() {
    let (a, b) = (sphere(1.0), plane([-3.0, -3.1, 0.3], [6.0, 0.0, 0.0], [0.0, 6.2, 0.0]));
    let want = 2.0 * std::f64::consts::PI * 0.91f64.sqrt();
    let go_on = &mut |_: u64, _: u64| false;
    let depth = subdivided(&a, &b, 8, None, 1_000_000, go_on).lines;
    let flat = subdivided(&a, &b, 0, Some(1e-2), 1_000_000, go_on).lines;
    let mesh = meshed(&a, &b, 40, go_on).unwrap().lines;
    for (name, lines) in [("depth", &depth), ("flat", &flat), ("mesh", &mesh)] {
        let total: f64 = lines.iter().map(length).sum();
        println!(
            "{name}: {} lines, {} nodes, length {total} of {want}",
            lines.len(),
            lines.iter().map(Vec::len).sum::<usize>()
        );
        assert!((total - want).abs() < 2e-2 * want, "{name}: {total} for {want}");
        // Nodes are starts for a corrector.
        for node in lines.iter().flatten().step_by(5) {
            let found = correct(&a, &b, node.at, Corrector::Auto, 1e-10, None).unwrap();
            assert!((a.evaluate(found.at[0], found.at[1])[2] - 0.3).abs() < 1e-10);
        }
    }
    assert!(mesh.len() == 1, "{} lines", mesh.len());
}

/// Each method of the named module beside the search that proves: the same loop, coarsely or not; what a stop leaves.
#[test]
fn methods_by_name_give_the_branch_of_the_search_and_claim_nothing() {
    let (a, b) = (sphere(1.0), plane([-3.0, -3.1, 0.3], [6.0, 0.0, 0.0], [0.0, 6.2, 0.0]));
    let options = MarchOptions { chord: 1e-3, ..MarchOptions::default() };
    let [x, y] = [&a, &b].map(|s| IndexedSurface::new(s.clone()));
    let proven = intersect(&x, &y, &options, &mut |_, _| false).unwrap();
    let p = proven.branches[0].points[2];
    let start = [p.uv[0] + 1e-3, p.uv[1], p.st[0], p.st[1] - 1e-3];
    let all = |poll: &mut dyn FnMut(u64, u64) -> bool| {
        let marched = named::by_marching(&a, &b, start, Corrector::Maf, 0.0, &options, poll);
        let marched = marched.unwrap().unwrap();
        let at = |p: &MarchPoint| [p.uv[0], p.uv[1], p.st[0], p.st[1]];
        let coarse: Vec<[f64; 4]> = marched.branches[0].points.iter().step_by(9).map(at).collect();
        let bisected = (coarse.len() > 1).then(|| {
            let made = named::by_bisection(&a, &b, &coarse, Corrector::Auto, &options, poll);
            made.unwrap().unwrap()
        });
        let subdivided = named::by_subdivision(&a, &b, 4, &options, poll).unwrap();
        let flat = named::by_subdivision(&a, &b, 0, &options, poll).unwrap();
        let meshed = named::by_mesh(&a, &b, 50, poll).unwrap();
        (vec![subdivided, flat, meshed, marched], bisected)
    };
    let (found, bisected) = all(&mut |_, _| false);
    let radius = 0.91f64.sqrt();
    for (k, made) in found.iter().chain(&bisected).enumerate() {
        assert!(!made.is_proven && !made.stopped && made.undecided.len() == 1, "method {k}");
        assert!(!made.branches.is_empty(), "method {k}");
        let want = if k < 3 { 2e-2 } else { 1e-8 };
        for p in made.branches.iter().flat_map(|branch| &branch.points) {
            let off = (p.point[0].hypot(p.point[1]) - radius).abs().max((p.point[2] - 0.3).abs());
            assert!(off < want, "method {k}: {off:e}");
        }
        let gap = made.branches.iter().map(|branch| branch.gap).fold(0.0, f64::max);
        assert!(gap < 4.0 * want && (k >= 3 || gap > 1e-6), "method {k}: {gap:e}");
    }
    let whole = found[2].branches.iter().filter(|branch| branch.is_closed()).count();
    assert_eq!((found[2].branches.len(), whole), (1, 1), "the mesh has one loop");
    for made in all(&mut |_, _| true).0 {
        assert!(made.stopped && !made.is_proven && made.undecided.len() == 1);
    }
    // A budget that runs out is told; what is none is refused.
    let few = MarchOptions { budget: 20, ..options };
    assert!(named::by_subdivision(&a, &b, 4, &few, &mut |_, _| false).unwrap().exhausted);
    assert!(named::by_subdivision(&a, &b, 21, &options, &mut |_, _| false).is_err());
    assert!(named::by_mesh(&a, &b, 1025, &mut |_, _| false).is_err());
    let far = [0.5, 0.99, 0.01, 0.01];
    let held = Corrector::NewtonThree(1);
    let lost = named::by_marching(&a, &b, far, held, 0.0, &options, &mut |_, _| false);
    assert!(lost.unwrap().is_none());
    assert!(named::by_bisection(&a, &b, &[start], held, &options, &mut |_, _| false).is_err());
}

#[test]
fn curves_of_a_branch_agree_and_fewer_points_keep_the_chord() {
    let a = IndexedSurface::new(cylinder(1.0, 2.0));
    let b = IndexedSurface::new(moved(&cylinder(0.6, 2.0), &z_to_x([0.0; 3])));
    let options = MarchOptions { chord: 1e-4, ..MarchOptions::default() };
    let found = intersect(&a, &b, &options, &mut |_, _| false).unwrap();
    assert_eq!(found.branches.len(), 2);
    for branch in &found.branches {
        let few = reduced(&branch.points, 1e-2);
        assert!(
            few.len() * 2 < branch.points.len() && few.len() > 6,
            "{} of {}",
            few.len(),
            branch.points.len()
        );
        assert_eq!(
            (few[0], few[few.len() - 1]),
            (branch.points[0], branch.points[branch.points.len() - 1])
        );
        let parts = curves(&a, &b, &branch.points, 1e-6, &mut |_, _| false).unwrap();
        assert!(!parts.is_empty());
        for part in &parts {
            assert!(part.error <= 1e-6, "{:e}", part.error);
            let (low, high) = part.space.domain();
            for n in 0..=40 {
                let t = (low + (high - low) * f64::from(n) / 40.0).min(high);
                let p = part.space.evaluate(t);
                assert!(
                    (p[0].hypot(p[1]) - 1.0).abs() < 1e-6 && (p[1].hypot(p[2]) - 0.6).abs() < 1e-6
                );
                let uv = part.uv.evaluate(t);
                let on = a.surface().evaluate(uv[0].clamp(0.0, 1.0), uv[1].clamp(0.0, 1.0));
                assert!((0..3).all(|k| (on[k] - p[k]).abs() < 2e-6));
            }
        }
        assert!(
            curves(&a, &b, &branch.points, 0.0, &mut |_, _| false).is_err()
                && curves(&a, &b, &branch.points[..1], 1e-6, &mut |_, _| false).is_err()
        );
    }
}

/// A random rational bicubic sheet of 6 x 6 poles with inner knots, one of them double.
fn random_sheet(seed: &mut u64, tilt: f64) -> Surface {
    let mut random = || {
        *seed =
            seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (*seed >> 11) as f64 / (1u64 << 53) as f64
    };
    let (mut poles, mut weights) = (Vec::new(), Vec::new());
    for k in 0..36 {
        let (x, y) = ((k / 6) as f64, (k % 6) as f64);
        poles.push([
            x + 0.3 * random(),
            y + 0.3 * random(),
            2.0 * random() - 1.0 + tilt * (x - 2.5),
        ]);
        weights.push(0.5 + random());
    }
    let (u, v) =
        ([0., 0., 0., 0., 0.3, 0.7, 1., 1., 1., 1.], [0., 0., 0., 0., 0.5, 0.5, 1., 1., 1., 1.]);
    Surface::new(&u, &v, 3, 3, &poles, 6, 6, Some(&weights)).unwrap()
}

#[test]
fn random_sheets_give_the_same_branches_in_either_order_and_hold_all_that_a_mesh_sees() {
    let mut seed = 20_261_126;
    let mut total = 0;
    for round in 0..14 {
        let a = random_sheet(&mut seed, 0.0);
        let b = random_sheet(&mut seed, if round % 2 == 0 { 0.0 } else { 0.4 });
        let (x, y) = (IndexedSurface::new(a.clone()), IndexedSurface::new(b.clone()));
        let ask = |p: &IndexedSurface, q: &IndexedSurface| {
            intersect(p, q, &MarchOptions::default(), &mut |_, _| false).unwrap()
        };
        let (found, swapped) = (ask(&x, &y), ask(&y, &x));
        assert!(
            found.is_proven && swapped.is_proven,
            "round {round}: {} undecided",
            found.undecided.len()
        );
        let shape = |f: &footpoint::march::Intersection| {
            let closed = f.branches.iter().filter(|b| b.is_closed()).count();
            (f.branches.len(), closed)
        };
        assert_eq!(shape(&found), shape(&swapped), "round {round}");
        total += found.branches.len();
        let apart = |p: P, q: P| (0..3).map(|k| (p[k] - q[k]).powi(2)).sum::<f64>().sqrt();
        let mesh = meshed(&a, &b, 48, &mut |_, _| false).unwrap().lines;
        for node in mesh.iter().flatten().step_by(3) {
            // What the mesh sees may lie just beyond a border: then there is nothing to correct to.
            let Some(place) = correct(&a, &b, node.at, Corrector::NewtonFour, 1e-10, None) else {
                continue;
            };
            let p = a.evaluate(place.at[0], place.at[1]);
            let near = found.branches.iter().flat_map(|b| b.points.windows(2)).any(|w| {
                let (d, f) =
                    (apart(w[0].point, w[1].point), apart(w[0].point, p) + apart(w[1].point, p));
                f <= d + 2e-2
            });
            assert!(near, "round {round}: nothing near {p:?}");
        }
    }
    println!("{total} branches");
    assert!(total > 30);
}

#[test]
fn bisection_makes_a_coarse_walk_as_fine_as_asked() {
    let (a, b) = pair();
    let (x, y) = (IndexedSurface::new(a.clone()), IndexedSurface::new(b.clone()));
    let coarse = MarchOptions { chord: 0.1, ..MarchOptions::default() };
    let found = intersect(&x, &y, &coarse, &mut |_, _| false).unwrap();
    for branch in &found.branches {
        // Up to the first seam.
        let apart = |w: &[footpoint::march::MarchPoint]| {
            (0..3).map(|k| (w[0].point[k] - w[1].point[k]).abs()).fold(0.0, f64::max)
        };
        let seam = branch.points.windows(2).position(|w| apart(w) < 1e-12);
        let points = &branch.points[..=seam.unwrap_or(branch.points.len() - 1)];
        if points.len() < 3 {
            continue;
        }
        let places: Vec<[f64; 4]> =
            points.iter().map(|p| [p.uv[0], p.uv[1], p.st[0], p.st[1]]).collect();
        let (mut before, mut counts) = (places.len(), Vec::new());
        for chord in [1e-2, 1e-3, 1e-4] {
            let fine = refined(&a, &b, &places, Corrector::Auto, chord, &mut || false).unwrap();
            assert!(fine.len() >= before);
            assert!(fine.iter().all(|at| off(a.evaluate(at[0], at[1])) < 1e-2 * chord + 1e-12));
            (before, counts) = (fine.len(), [counts, vec![fine.len()]].concat());
            // The middle of each chord, corrected, is as near as was asked for.
            for w in fine.windows(2) {
                let middle = [0, 1, 2, 3].map(|k| 0.5 * (w[0][k] + w[1][k]));
                let m = correct(&a, &b, middle, Corrector::Auto, 1e-12, None).unwrap().at;
                let [p, q, r] = [w[0], m, w[1]].map(|at| a.evaluate(at[0], at[1]));
                assert!(footpoint::march::distance_to_chord(q, p, r) <= 1.02 * chord);
            }
        }
        // Ten times as fine takes about sqrt(10) times the points.
        assert!(counts[2] < 6 * counts[1] && counts[2] > counts[1], "{counts:?}");
    }
    let far = [[0.1, 0.2, 0.3, 0.4], [0.6, 0.7, 0.9, 0.1]];
    assert!(refined(&a, &b, &far, Corrector::NewtonThree(0), 1e-12, &mut || false).is_none());
}

/// A step of four parameters that is cut off at the borders, as textbooks have it: no parameter is held.
fn cut_off(a: &Surface, b: &Surface, at: [f64; 4]) -> [f64; 4] {
    let (mut p, mut q) = ([[0.0; 3]; 3], [[0.0; 3]; 3]);
    a.partials(at[0], at[1], 1, &mut p);
    b.partials(at[2], at[3], 1, &mut q);
    let c = [p[1], p[2], q[1].map(|x| -x), q[2].map(|x| -x)];
    let f: Vec<f64> = (0..3).map(|i| p[0][i] - q[0][i]).collect();
    // J J^T y = -f by Cramer's rule, then J^T y.
    let m = |i: usize, j: usize| c.iter().map(|v| v[i] * v[j]).sum::<f64>();
    let det = |m: [[f64; 3]; 3]| {
        m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1])
            - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0])
            + m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0])
    };
    let whole: [[f64; 3]; 3] = std::array::from_fn(|i| std::array::from_fn(|j| m(i, j)));
    let y: [f64; 3] = std::array::from_fn(|k| {
        let mut n = whole;
        (0..3).for_each(|i| n[i][k] = -f[i]);
        det(n) / det(whole)
    });
    std::array::from_fn(|k| (at[k] + (0..3).map(|i| c[k][i] * y[i]).sum::<f64>()).clamp(0.0, 1.0))
}

#[test]
fn four_parameters_stick_at_a_border_unless_it_holds_one() {
    // The curve leaves a wavy sheet through u = 0; starts lie beside the border, their nearest points of the longer curve beyond it.
    let mut seed = 7;
    let a = random_sheet(&mut seed, 0.0);
    let mut b = random_sheet(&mut seed, 0.5);
    let (mut held, mut stuck, mut starts) = (0, 0, 0);
    for round in 0..6 {
        let found = intersect(
            &IndexedSurface::new(a.clone()),
            &IndexedSurface::new(b.clone()),
            &MarchOptions::default(),
            &mut |_, _| false,
        )
        .unwrap();
        for branch in &found.branches {
            for (end, k) in branch.ends.iter().zip([0, branch.points.len() - 1]) {
                let footpoint::march::End::Border(side) = *end else { continue };
                let p = branch.points[k];
                let at = [p.uv[0], p.uv[1], p.st[0], p.st[1]];
                for n in 0..8 {
                    let by = |c: u32| 0.03 * (f64::from((n * (c + 3) + c) % 8) / 3.5 - 1.0);
                    let mut start: [f64; 4] =
                        std::array::from_fn(|c| (at[c] + by(c as u32)).clamp(0.0, 1.0));
                    start[usize::from(side) / 2] = at[usize::from(side) / 2];
                    starts += 1;
                    if let Some(found) = correct(&a, &b, start, Corrector::Auto, 1e-11, None) {
                        assert!(found.at.iter().all(|x| (0.0..=1.0).contains(x)));
                        held += 1;
                    }
                    let end = (0..50).fold(start, |at, _| cut_off(&a, &b, at));
                    let (x, y) = (a.evaluate(end[0], end[1]), b.evaluate(end[2], end[3]));
                    stuck += usize::from((0..3).any(|i| (x[i] - y[i]).abs() > 1e-9));
                }
            }
        }
        b = random_sheet(&mut seed, 0.3 + 0.1 * f64::from(round));
    }
    println!(
        "{starts} starts at borders: {held} solved with a held border, {stuck} stuck when cut off"
    );
    assert!(starts > 50 && held == starts, "{held} of {starts}");
    assert!(stuck > 0);
}

#[test]
fn a_fit_is_proven_and_a_fairer_one_stays_near_both_surfaces() {
    use footpoint::fair::{CurveFairing, fair_curve};
    use footpoint::pcurve::compose::Composer;
    use footpoint::pcurve::deviation::deviation;
    let a = IndexedSurface::new(cylinder(1.0, 2.0));
    let b = IndexedSurface::new(moved(&cylinder(0.6, 2.0), &z_to_x([0.0; 3])));
    let found = intersect(&a, &b, &MarchOptions::default(), &mut |_, _| false).unwrap();
    for tolerance in [1e-4, 1e-7] {
        for branch in &found.branches {
            for part in curves(&a, &b, &branch.points, tolerance, &mut |_, _| false).unwrap() {
                assert!(part.error <= tolerance, "{:e} for {tolerance:e}", part.error);
                let (low, high) = part.space.domain();
                for n in 0..=300 {
                    let t = (low + (high - low) * f64::from(n) / 300.0).min(high);
                    let p = part.space.evaluate(t);
                    let far = (p[0].hypot(p[1]) - 1.0).abs().max((p[1].hypot(p[2]) - 0.6).abs());
                    assert!(far <= part.error * (1.0 + 1e-9) + 1e-15, "{far:e} {:e}", part.error);
                }
                // Smooth by energy: how far it moved is bounded, so is its distance from both surfaces.
                let fairing = CurveFairing::new(10.0 * tolerance);
                let fair = fair_curve(&part.space, &fairing, &mut || false).unwrap().shape;
                let whole = [low, high];
                let bound = deviation(&mut Composer::new(a.surface()), &part.uv, &fair, whole, 0.0);
                assert!(bound.unwrap().bound <= 11.0 * tolerance);
            }
        }
    }
}
