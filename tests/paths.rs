//! Unrolled parameters and paths: turns, poles, crossings, ties and jumps.

#[path = "cases/mod.rs"]
mod cases;
mod known_shapes;

use footpoint::closest::{FootPoint, QueryOptions, Workspace, flag};
use footpoint::curve::Curve;
use footpoint::index::{IndexedCurve, IndexedSurface};
use footpoint::surface::Surface;
use footpoint::unwrap::{PathOutput, change};
use known_shapes::*;

/// A joined path: the feet asked one by one, the joined ones, the unrolled parameters, the changes.
struct Path<const N: usize> {
    alone: Vec<FootPoint>,
    feet: Vec<FootPoint>,
    unwrapped: Vec<[f64; N]>,
    changes: Vec<u32>,
}

fn joined_surface(surface: &IndexedSurface, points: &[Vector]) -> Path<2> {
    let (options, mut workspace) = (QueryOptions::default(), Workspace::default());
    let ask = |p: &Vector| surface.closest(*p, None, &options, &mut workspace, None);
    let alone: Vec<FootPoint> = points.iter().map(ask).collect();
    let mut feet = alone.clone();
    let (mut unwrapped, mut changes) = (vec![[0.0; 2]; feet.len()], vec![0; feet.len()]);
    let output = PathOutput { unwrapped: Some(&mut unwrapped), changes: Some(&mut changes) };
    surface.join(&|i| points[i], &mut feet, &options, output, &mut || false).unwrap();
    Path { alone, feet, unwrapped, changes }
}

fn on_surface(surface: &IndexedSurface, points: &[Vector]) -> Path<2> {
    checked(joined_surface(surface, points), points, |f| surface.surface().evaluate(f.u, f.v))
}

fn joined_curve(curve: &IndexedCurve, points: &[Vector]) -> Path<1> {
    let (options, mut workspace) = (QueryOptions::default(), Workspace::default());
    let ask = |p: &Vector| curve.closest(*p, None, &options, &mut workspace, None);
    let alone: Vec<FootPoint> = points.iter().map(ask).collect();
    let mut feet = alone.clone();
    let (mut unwrapped, mut changes) = (vec![[0.0; 1]; feet.len()], vec![0; feet.len()]);
    let output = PathOutput { unwrapped: Some(&mut unwrapped), changes: Some(&mut changes) };
    curve.join(&|i| points[i], &mut feet, &options, output, &mut || false).unwrap();
    Path { alone, feet, unwrapped, changes }
}

fn on_curve(curve: &IndexedCurve, points: &[Vector]) -> Path<1> {
    checked(joined_curve(curve, points), points, |f| curve.curve().evaluate(f.u))
}

/// What holds for every path: the distance is the one asked alone, to the bit unless a tie was taken.
fn checked<const N: usize>(
    path: Path<N>,
    points: &[Vector],
    evaluate: impl Fn(&FootPoint) -> Vector,
) -> Path<N> {
    for (i, (foot, alone)) in path.feet.iter().zip(&path.alone).enumerate() {
        let taken = path.changes[i] & (change::TIE | change::THROUGH_COLLAPSED) != 0;
        assert!(taken || foot == alone, "{i}: {foot:?} {alone:?} {}", path.changes[i]);
        assert!((foot.distance - alone.distance).abs() <= 1e-9, "{i}: {foot:?} {alone:?}");
        assert_eq!(foot.point, evaluate(foot), "{i}: {foot:?}");
        assert_eq!(foot.distance, norm(sub(points[i], foot.point)));
        assert!(foot.lower_bound <= foot.distance && foot.lower_bound <= alone.lower_bound);
        assert_eq!(foot.flags & flag::NOT_PROVEN, alone.flags & flag::NOT_PROVEN);
        let place = flag::SEAM | flag::EDGE | flag::CORNER;
        let same_place = (foot.u, foot.v) == (alone.u, alone.v);
        assert!(
            !same_place || foot.flags & place == alone.flags & place,
            "{i}: {foot:?} {alone:?}"
        );
    }
    path
}

fn jumps<const N: usize>(path: &Path<N>) -> Vec<usize> {
    let jumped = |i: &usize| path.changes[*i] & change::JUMP != 0;
    (0..path.changes.len()).filter(jumped).collect()
}

fn crossings<const N: usize>(path: &Path<N>) -> usize {
    path.changes.iter().filter(|c| **c & change::SEAM_CROSSED != 0).count()
}

#[test]
fn three_turns_around_a_cylinder_are_three_turns_of_the_parameter() {
    let tube = cylinder([-1.0, 4.0]);
    for (start, sign) in [(0.3, 1.0), (0.0, 1.0), (0.0, -1.0), (2.0, -1.0)] {
        let angle = |i: usize| start + sign * 3.0 * std::f64::consts::TAU * i as f64 / 300.0;
        let point = |i: usize| {
            let (a, r) = (angle(i), 1.0 + 0.5 * (i as f64 / 30.0).sin());
            [r * a.cos(), r * a.sin(), 0.9 * (i as f64 / 150.0 - 1.0)]
        };
        let points: Vec<Vector> = (0..=300).map(point).collect();
        let path = on_surface(&tube, &points);
        assert!(jumps(&path).is_empty(), "{:?}", jumps(&path));
        let first = path.unwrapped[0][0];
        let turns = (path.unwrapped[300][0] - first) / 3.0;
        // A turn has length 4.
        assert!(
            (turns - sign * 4.0).abs() < 1e-9 || (turns.abs() - 4.0).abs() < 1e-9,
            "{turns} {:?} {:?}",
            path.unwrapped.first(),
            path.unwrapped.last()
        );
        for pair in path.unwrapped.windows(2) {
            assert!((pair[1][0] - pair[0][0]) * sign > 0.0, "{pair:?}");
        }
        assert!((3..=4).contains(&crossings(&path)), "{}", crossings(&path));
    }
}

#[test]
fn over_the_pole_of_a_sphere_nothing_jumps() {
    let ball = sphere([0.0, 4.0]);
    for aside in [0.0, 1e-13, 1e-6, 0.003, 0.05, 0.3] {
        for count in [20, 21, 200, 201] {
            let point = |i: usize| [2.0 * i as f64 / (count - 1) as f64 - 1.0, aside, 1.5];
            let points: Vec<Vector> = (0..count).map(point).collect();
            let path = on_surface(&ball, &points);
            assert!(jumps(&path).is_empty(), "{aside} {count} {:?}", jumps(&path));
            let through = path.changes.iter().any(|c| c & change::THROUGH_COLLAPSED != 0);
            assert!(through || aside > 1e-6, "{aside} {count}");
            assert!(!through || aside < 0.1, "{aside} {count}");
        }
    }
    // On the pole the longitude is kept.
    let points: Vec<Vector> = (0..=10).map(|i| [-0.5 + 0.1 * f64::from(i), 0.0, 1.5]).collect();
    let path = on_surface(&ball, &points);
    let on_pole: Vec<usize> =
        (0..points.len()).filter(|i| path.feet[*i].flags & flag::COLLAPSED != 0).collect();
    for i in on_pole {
        assert_eq!(path.feet[i].u, path.feet[i - 1].u);
        assert_eq!(path.changes[i] & change::THROUGH_COLLAPSED, change::THROUGH_COLLAPSED);
    }
}

#[test]
fn along_a_figure_eight_the_branch_is_kept_at_the_crossing() {
    let eight = figure_eight(32);
    let (low, high) = eight.curve().domain();
    for count in [64, 65, 640, 1000] {
        // Twice round, through the crossing four times; 64 and 640 steps meet it exactly.
        let at = |i: usize| low + (high - low) * ((2.0 * i as f64 / count as f64) % 1.0);
        let points: Vec<Vector> = (0..=count).map(|i| eight.curve().evaluate(at(i))).collect();
        let path = on_curve(&eight, &points);
        assert!(jumps(&path).is_empty(), "{count} {:?}", jumps(&path));
        let whole = path.unwrapped[count][0] - path.unwrapped[0][0];
        assert!((whole - 2.0 * (high - low)).abs() < 1e-6, "{count}: {whole}");
        let step = 2.0 * (high - low) / count as f64;
        for pair in path.unwrapped.windows(2) {
            assert!((pair[1][0] - pair[0][0] - step).abs() < 1e-6, "{pair:?}");
        }
    }
}

#[test]
fn across_the_medial_axis_the_foot_jumps_once_and_it_is_said() {
    // A parabola; its medial axis is x = 0 above the focus.
    let poles = [[-2., 4., 0.], [0., -4., 0.], [2., 4., 0.]];
    let parabola = Curve::new(&[0., 0., 0., 1., 1., 1.], 2, &poles, None).unwrap();
    let parabola = IndexedCurve::new(parabola);
    for count in [10, 11, 100, 1001] {
        let point = |i: usize| [2.0 * i as f64 / (count - 1) as f64 - 1.0, 2.5, 0.0];
        let points: Vec<Vector> = (0..count).map(point).collect();
        let path = on_curve(&parabola, &points);
        // On the axis itself both are as near: the step after it jumps.
        assert_eq!(jumps(&path), [count.div_ceil(2)], "{count}");
    }
    // Below the focus it slides through the vertex.
    let points: Vec<Vector> = (0..50).map(|i| [f64::from(i) / 24.5 - 1.0, 0.3, 0.0]).collect();
    assert!(jumps(&on_curve(&parabola, &points)).is_empty());
    // Into a concave corner of a polyline.
    let poles = [[-1., 1., 0.], [0., 0., 0.], [1., 1., 0.]];
    let corner = Curve::new(&[0., 0., 1., 2., 2.], 1, &poles, None).unwrap();
    let points: Vec<Vector> = (0..20).map(|i| [f64::from(i) / 19.0 - 0.5, 0.8, 0.0]).collect();
    assert_eq!(jumps(&on_curve(&IndexedCurve::new(corner), &points)), [10]);
}

#[test]
fn from_sheet_to_sheet_the_foot_jumps() {
    // A sheet bent to a hairpin: z = 0 and z = 0.1 over x = 0 .. 1.
    let profile = [[1., 0.], [0., 0.], [-0.2, 0.05], [0., 0.1], [1., 0.1]];
    let poles: Vec<Vector> =
        profile.iter().flat_map(|[x, z]| [[*x, 0., *z], [*x, 1., *z]]).collect();
    let knots = [0., 0., 0., 1., 2., 3., 3., 3.];
    let pin = Surface::new(&knots, &[0., 0., 1., 1.], 2, 1, &poles, 5, 2, None).unwrap();
    let points: Vec<Vector> = (0..=10).map(|i| [0.8, 0.5, 0.01 * f64::from(i) + 0.001]).collect();
    let path = on_surface(&IndexedSurface::new(pin), &points);
    assert_eq!(jumps(&path), [5]);
}

#[test]
fn along_the_axis_of_a_cylinder_the_free_angle_is_kept() {
    let tube = cylinder([0.0, 4.0]);
    let mut points: Vec<Vector> = vec![[0.5, 0.3, -0.8], [0.2, 0.12, -0.7]];
    points.extend((0..20).map(|i| [0.0, 0.0, -0.6 + 0.06 * f64::from(i)]));
    let path = on_surface(&tube, &points);
    assert!(jumps(&path).is_empty(), "{:?}", jumps(&path));
    for i in 2..points.len() {
        assert!(
            (path.unwrapped[i][0] - path.unwrapped[1][0]).abs() < 1e-6,
            "{i} {:?} {:?} {:?}",
            path.unwrapped,
            path.feet[i],
            path.alone[i]
        );
        assert!(path.changes[i] & change::TIE != 0);
    }
}

#[test]
fn a_path_in_a_part_of_the_domain_stays_there() {
    let tube = cylinder([0.0, 4.0]);
    let part = QueryOptions { domain: Some([0.5, 3.0, 0.1, 0.9]), ..QueryOptions::default() };
    let points: Vec<Vector> = (0..200)
        .map(|i| f64::from(i) / 20.0)
        .map(|a| [1.2 * a.cos(), 1.2 * a.sin(), 1.5 * (0.3 * a).sin()])
        .collect();
    let mut workspace = Workspace::default();
    let ask = |p: &Vector| tube.closest(*p, None, &part, &mut workspace, None);
    let mut feet: Vec<FootPoint> = points.iter().map(ask).collect();
    let alone = feet.clone();
    let mut changes = vec![0; feet.len()];
    let output = PathOutput { unwrapped: None, changes: Some(&mut changes) };
    tube.join(&|i| points[i], &mut feet, &part, output, &mut || false).unwrap();
    for (foot, alone) in feet.iter().zip(&alone) {
        assert!((0.5..=3.0).contains(&foot.u) && (0.1..=0.9).contains(&foot.v));
        assert!((foot.distance - alone.distance).abs() < 1e-9);
    }
    // Over the gap it jumps, each time round.
    assert!(changes.iter().any(|c| c & change::JUMP != 0));
}

#[test]
fn around_a_torus_both_parameters_unroll() {
    let ring = torus();
    let at = |i: usize| {
        let (a, b) = (2.0 * i as f64 / 50.0, 5.0 * i as f64 / 50.0 + 0.4);
        let (r, h) = (2.0 + 0.7 * b.cos(), 0.7 * b.sin());
        [r * a.cos(), r * a.sin(), h]
    };
    let points: Vec<Vector> = (0..=400).map(at).collect();
    let path = on_surface(&ring, &points);
    assert!(jumps(&path).is_empty(), "{:?}", jumps(&path));
    let [du, dv] = [0, 1].map(|k| path.unwrapped[400][k] - path.unwrapped[0][k]);
    // 16 and 40 radians, in quarters.
    let quarter = std::f64::consts::FRAC_PI_2;
    assert!((du - 16.0 / quarter).abs() < 0.2 && (dv - 40.0 / quarter).abs() < 0.2, "{du} {dv}");
}

#[test]
fn bad_points_are_stepped_over() {
    let ring = circle(5.0, 2.0, 1.0);
    let mut points: Vec<Vector> = (0..=40)
        .map(|i| f64::from(i) / 20.0 * std::f64::consts::TAU)
        .map(|a| [1.3 * a.cos(), 1.3 * a.sin(), 0.2])
        .collect();
    points[7] = [f64::NAN; 3];
    points[0] = [1e300; 3];
    let path = {
        let (options, mut workspace) = (QueryOptions::default(), Workspace::default());
        let ask = |p: &Vector| ring.closest(*p, None, &options, &mut workspace, None);
        let mut feet: Vec<FootPoint> = points.iter().map(ask).collect();
        let mut unwrapped = vec![[0.0]; feet.len()];
        let output = PathOutput { unwrapped: Some(&mut unwrapped), changes: None };
        ring.join(&|i| points[i], &mut feet, &options, output, &mut || false).unwrap();
        unwrapped
    };
    assert!(path[0][0].is_nan() && path[7][0].is_nan());
    assert!((path[40][0] - path[1][0] - 2.0 * 39.0 / 20.0).abs() < 0.1);
}

#[test]
fn one_parameter_is_unrolled_next_to_another() {
    let ring = circle(5.0, 2.0, 1.0);
    assert_eq!(ring.unwrap(105.25, 6.0), Ok(106.0));
    assert_eq!(ring.unwrap(-5.25, 5.5), Ok(-4.5));
    assert!(ring.unwrap(0.0, 4.0).is_err() && ring.unwrap(f64::NAN, 5.0).is_err());
    let tube = cylinder([0.0, 4.0]);
    assert_eq!(tube.unwrap([8.5, 77.0], [1.0, 0.5]), Ok([9.0, 0.5]));
    assert!(tube.unwrap([0.0, f64::INFINITY], [1.0, 0.5]).is_err());
}

#[test]
fn every_step_of_a_random_walk_is_the_nearest_point() {
    let shapes =
        [sphere([0.0, 4.0]), torus(), turned_polygon(&[[0., -1.], [1., -1.], [1., 1.], [0., 0.]])];
    let mut random = Random(3);
    for shape in &shapes {
        let mut at = [0.3, 0.2, 0.1];
        let walk: Vec<Vector> = (0..2000)
            .map(|_| {
                let step = random.point(0.1);
                at = [0, 1, 2].map(|k| (at[k] + step[k]).clamp(-2.0, 2.0));
                at
            })
            .collect();
        let path = on_surface(shape, &walk);
        for pair in path.unwrapped.windows(2) {
            assert!((pair[1][0] - pair[0][0]).abs() <= 2.0 + 1e-12, "{pair:?}");
        }
    }
}

#[test]
fn through_the_queries_of_all_cases_a_path_has_the_distances_asked_alone() {
    let (mut steps, mut jumped, mut tied) = (0, 0, 0);
    for folder in cases::folders() {
        let case = cases::read(&folder);
        // Far apart, and then a fine line between the first two.
        let mut points: Vec<Vector> =
            case.rows.iter().step_by(7).take(60).map(|r| r.query).collect();
        let (a, b) = (points[0], points[1]);
        let truths: Vec<_> = case.rows.iter().step_by(7).take(60).collect();
        points
            .extend((0..60).map(|i| [0, 1, 2].map(|k| a[k] + (b[k] - a[k]) * f64::from(i) / 59.0)));
        let scale = 1e-9 * case.diagonal + 4e-15 * case.magnitude;
        let (alone, feet, changes) = match &case.shape {
            cases::Shape::Surface(surface) => {
                let path = joined_surface(surface, &points);
                (path.alone, path.feet, path.changes)
            }
            cases::Shape::Curve(curve) => {
                let path = joined_curve(curve, &points);
                (path.alone, path.feet, path.changes)
            }
        };
        for (i, (foot, alone)) in feet.iter().zip(&alone).enumerate() {
            steps += 1;
            jumped += usize::from(changes[i] & change::JUMP != 0);
            tied += usize::from(foot.u != alone.u || foot.v != alone.v);
            assert!(
                foot.distance <= alone.distance + scale,
                "{} {i} {foot:?} {alone:?}",
                case.name
            );
            assert!(foot.distance >= alone.lower_bound);
            if let Some(row) = truths.get(i) {
                let most = row.distance + scale + 4e-15 * row.distance;
                assert!(foot.distance <= most, "{} {} {foot:?}", case.name, row.class);
            }
            assert_eq!(foot.distance, norm(sub(points[i], foot.point)));
        }
    }
    println!("{steps} steps, {jumped} jumps, {tied} other feet as near");
}

/// The nearest point of a convex solid moves no farther than its query: outside nothing jumps.
#[test]
fn outside_convex_solids_no_walk_jumps() {
    let square = [[-1., -1.], [1., -1.], [1., 1.], [-1., 1.]];
    let flat = [[0., -1.], [1., -1.], [1., 1.], [0., 1.]];
    let shapes: [(IndexedSurface, &dyn Fn(Vector) -> f64); 5] = [
        // Not convex, but near the tube the nearest point is unique too; it moves up to five times as far.
        (torus(), &|p| 0.4 - ((p[0].hypot(p[1]) - 2.0).hypot(p[2]) - 0.5).abs()),
        (sphere([0.0, 4.0]), &|p| norm(p) - 1.0),
        (prism(&square, [0.3, -0.2], 1.0), &|p| prism_distance(&square, 1.0, p)),
        (turned_polygon(&flat), &|p| turned_distance(&flat, p)),
        (turned_polygon(&[[0., -1.], [1., -1.], [0., 1.]]), &|p| {
            turned_distance(&[[0., -1.], [1., -1.], [0., 1.]], p)
        }),
    ];
    let mut random = Random(5);
    for (k, (shape, distance)) in shapes.iter().enumerate() {
        for reach in [1e-3, 0.02, 0.2, 1.0] {
            let mut at = if k == 0 { [2.3, 0.3, 0.2] } else { [0.4, 0.3, 1.7] };
            let mut walk = vec![at];
            while walk.len() < 3000 {
                let step = random.point(reach);
                let next = [0, 1, 2].map(|k| (at[k] + step[k]).clamp(-2.5, 2.5));
                // The way there must not lead through the solid.
                let on_the_way =
                    |i: i32| [0, 1, 2].map(|k| at[k] + (next[k] - at[k]) * f64::from(i) / 40.0);
                if (1..=40).all(|i| distance(on_the_way(i)) > 0.0) {
                    at = next;
                    walk.push(at);
                }
            }
            let path = on_surface(shape, &walk);
            let jumps = jumps(&path);
            for i in jumps.iter().take(3) {
                println!(
                    "{k} {reach} {:?} {:?}\n {:?} {:?}\n {:?}",
                    walk[i - 1],
                    path.feet[i - 1],
                    walk[*i],
                    path.feet[*i],
                    path.alone[*i]
                );
            }
            assert!(jumps.is_empty(), "shape {k}, steps {reach}: {} jumps", jumps.len());
        }
    }
}

/// Without a jump the foot moves at most 16 times as far as its query.
#[test]
fn without_a_jump_a_foot_does_not_rush() {
    let angle = [[0., 0.], [2., 0.], [2., 1.], [1., 1.], [1., 2.], [0., 2.]];
    let shapes = [torus(), prism(&angle, [0.5; 2], 1.0), cylinder([0.0, 4.0])];
    let mut random = Random(11);
    for shape in &shapes {
        for reach in [0.01, 0.1] {
            let mut at = [0.3, 0.2, 0.1];
            let walk: Vec<Vector> = (0..3000)
                .map(|_| {
                    let step = random.point(reach);
                    at = [0, 1, 2].map(|k| (at[k] + step[k]).clamp(-3.0, 3.0));
                    at
                })
                .collect();
            let path = on_surface(shape, &walk);
            for i in 1..walk.len() {
                let moved = norm(sub(path.feet[i].point, path.feet[i - 1].point));
                let most = 16.0 * norm(sub(walk[i], walk[i - 1])) + 1e-4;
                assert!(moved <= most || path.changes[i] & change::JUMP != 0, "{i}");
            }
        }
    }
}
