//! Curvature beside what is nearly or truly singular: short edges, corners with parallel partials, cross-caps.

mod shapes;

use footpoint::index::IndexedSurface;
use footpoint::inspect::{Quantity, Range, RangeOptions, Side, surface_range};
use footpoint::surface::Surface;
use shapes::{Random, Vector, cross, dot, norm};

fn range(surface: &IndexedSurface, quantity: Quantity) -> Range {
    surface_range(surface, quantity, &RangeOptions::default(), &mut || false).unwrap()
}

fn greatest(surface: &IndexedSurface) -> Range {
    let options = RangeOptions { side: Side::Greatest, ..RangeOptions::default() };
    surface_range(surface, Quantity::Sharpest, &options, &mut || false).unwrap()
}

/// A patch of one span in each direction, v fastest.
fn patch(p: usize, q: usize, poles: &[Vector]) -> IndexedSurface {
    let knots = |n: usize| [vec![0.0; n + 1], vec![1.0; n + 1]].concat();
    let surface = Surface::new(&knots(p), &knots(q), p, q, poles, p + 1, q + 1, None).unwrap();
    IndexedSurface::new(surface)
}

/// The greatest absolute normal curvature at a place; partials that are parallel to 1e-9 tell nothing.
fn sharpest(surface: &Surface, u: f64, v: f64) -> Option<f64> {
    let mut d = [[0.0; 3]; 6];
    surface.partials(u, v, 2, &mut d);
    let n = cross(d[1], d[2]);
    let (e, f, g) = (dot(d[1], d[1]), dot(d[1], d[2]), dot(d[2], d[2]));
    let area = norm(n);
    if area.is_nan() || area <= 1e-9 * (e * g).sqrt() {
        return None;
    }
    let [l, m, q] = [3, 4, 5].map(|k| dot(n, d[k]) / area);
    let gaussian = (l * q - m * m) / (area * area);
    let mean = (e * q - 2.0 * f * m + g * l) / (2.0 * area * area);
    Some(mean.abs() + (mean * mean - gaussian).max(0.0).sqrt())
}

/// The greatest sample outside of what is excluded: even ones and such as crowd towards v = 0.
fn sampled(surface: &IndexedSurface, found: &Range) -> f64 {
    let mut most = 0.0f64;
    for i in 0..=60 {
        for k in 0..=120 {
            let (u, even) = (f64::from(i) / 60.0, f64::from(k) / 120.0);
            for v in [even, 10.0f64.powf(-18.0 * even), 0.0] {
                let inside = |a: &[f64; 4]| a[0] <= u && u <= a[1] && a[2] <= v && v <= a[3];
                if found.excluded.iter().any(inside) {
                    continue;
                }
                if let Some(x) = sharpest(surface.surface(), u, v) {
                    assert!(x <= found.greatest[1] * (1.0 + 1e-6), "{u} {v} {x} {found:?}");
                    most = most.max(x);
                }
            }
        }
    }
    most
}

const FOOT: [[f64; 2]; 3] = [[1.0, 0.0], [1.1, 1.0], [0.0, 1.3]];

/// Rings around the z axis: v from a radius of `edge` to one of 1, at heights `rise[0] v + rise[1] v^2`.
fn rings(edge: f64, rise: [f64; 2]) -> IndexedSurface {
    let heights = [0.0, 0.5 * rise[0], rise[0] + rise[1]];
    let mut poles = Vec::new();
    for [x, y] in FOOT {
        for (k, z) in heights.into_iter().enumerate() {
            let r = edge + (1.0 - edge) * 0.5 * k as f64;
            poles.push([r * x, r * y, z]);
        }
    }
    patch(2, 2, &poles)
}

#[test]
fn short_edges_of_calm_shapes_are_bounded_without_a_gap() {
    for edge in [1e-6, 1e-9, 1e-10, 3e-11, 1e-11, 1e-12] {
        let surface = rings(edge, [0.0, 1.0]);
        let found = greatest(&surface);
        // What is short enough for rounding is a pole, and said to be moved.
        assert!(found.proven && found.excluded.is_empty(), "{edge} {found:?}");
        assert!(found.moved <= 2.0 * edge, "{edge} {found:?}");
        let most = sampled(&surface, &found);
        assert!(found.greatest[1] < 10.0 && found.greatest[1] <= 1.01 * most, "{most} {found:?}");
        assert!(found.boxes < 20_000, "{edge} {found:?}");
    }
}

#[test]
fn a_tip_cut_off_has_the_curvature_of_its_edge() {
    for edge in [1e-6, 1e-8, 1e-9, 1e-10, 3e-11] {
        let surface = rings(edge, [-1.0, 0.3]);
        let found = greatest(&surface);
        assert!(found.proven && found.unbounded.is_empty() && found.moved == 0.0, "{found:?}");
        let most = sampled(&surface, &found);
        assert!(most > 0.1 / edge && found.greatest[0] >= most * (1.0 - 2e-3), "{most} {found:?}");
        assert!(found.greatest[1] <= most * (1.0 + 2e-3), "{most} {found:?}");
    }
}

#[test]
fn an_edge_that_turns_back_has_cross_caps_beside_it() {
    let mut random = Random(5);
    let mut count = 0;
    for round in 0..12 {
        let edge = [1e-9, 1e-10, 1e-11, 5e-12][round % 4];
        let degree = 5;
        // A curved foot, and poles of the edge all over the place.
        let mut poles = Vec::new();
        for i in 0..=degree {
            let angle = 1.5 * i as f64 / degree as f64;
            let noise = random.vector().map(|x| edge * x);
            let mut at = |r: f64| [r * angle.cos(), r * angle.sin(), r * r * 0.4];
            let rows = [0.0, 1.0 / 3.0, 2.0 / 3.0, 1.0].map(&mut at);
            poles.push(noise);
            // The next row is in the plane z = 0.
            poles.push([rows[1][0], rows[1][1], 0.0]);
            poles.extend([rows[2], rows[3]]);
        }
        let surface = patch(degree, 3, &poles);
        let found = greatest(&surface);
        sampled(&surface, &found);
        if found.unbounded.is_empty() {
            continue;
        }
        count += 1;
        assert!(found.rest_proven && found.moved == 0.0, "{found:?}");
        for place in &found.unbounded {
            let [u, v] = place.at;
            assert!(place.grows && 0.0 < v && v < 100.0 * edge, "{place:?}");
            // Ten times nearer it bends a hundred times as much, on both sides.
            for side in [-1.0, 1.0] {
                let at = |h: f64| sharpest(surface.surface(), u, v * (1.0 + side * h)).unwrap();
                let [far, near] = [at(1e-2), at(1e-3)];
                assert!((50.0..200.0).contains(&(near / far)), "{far} {near} {place:?}");
            }
        }
    }
    assert!(count >= 6, "{count}");
}

/// Partials along x in the corner (0, 0); they turn apart from there.
fn corner(angle: f64) -> Vec<Vector> {
    let mut poles = Vec::new();
    for i in 0..3 {
        for j in 0..3 {
            let (x, y) = (f64::from(i), f64::from(j));
            poles.push([
                x + 0.6 * y + 0.1 * x * y,
                0.3 * x * (x - 1.0) + x * y,
                0.5 * y * (y - 1.0),
            ]);
        }
    }
    poles[1] = [0.6, 0.6 * angle, 0.0];
    poles
}

#[test]
fn parallel_partials_in_a_corner_leave_no_bound() {
    let surface = patch(2, 2, &corner(0.0));
    let found = greatest(&surface);
    assert!(found.rest_proven && found.moved == 0.0 && !found.proven, "{found:?}");
    assert_eq!(found.unbounded.len(), 1, "{found:?}");
    assert!(found.unbounded[0].at == [0.0; 2] && found.unbounded[0].grows, "{found:?}");
    let most = sampled(&surface, &found);
    assert!(most <= found.greatest[1] * (1.0 + 1e-6), "{most} {found:?}");
    // Turned in space they are parallel up to rounding, and the answer says so.
    let (sin, cos) = 0.7f64.sin_cos();
    let turned = |[x, y, z]: Vector| {
        let (x, y) = (cos * x - sin * y, sin * x + cos * y);
        [3.0 + cos * x - sin * z, y - 2.0, 1.0 + sin * x + cos * z]
    };
    let turned: Vec<Vector> = corner(0.0).into_iter().map(turned).collect();
    let found = greatest(&patch(2, 2, &turned));
    assert!(found.rest_proven && !found.proven, "{found:?}");
    assert!(found.unbounded.len() == 1 && found.unbounded[0].at == [0.0; 2], "{found:?}");
    assert!(found.moved > 0.0 && found.moved < 1e-13, "{found:?}");
}

#[test]
fn partials_that_are_not_quite_parallel_have_a_bound() {
    let mut before = 0.0;
    for angle in [1e-2, 1e-4, 1e-6] {
        let surface = patch(2, 2, &corner(angle));
        let found = greatest(&surface);
        let most = sampled(&surface, &found);
        assert!(found.unbounded.is_empty() && found.proven, "{angle} {found:?}");
        assert!(found.greatest[1] >= most && found.greatest[1] > 10.0 * before, "{found:?}");
        before = found.greatest[1];
    }
}

/// (x, x y, y^2), x from -0.4 to 0.6 and y from -0.3 to 0.7.
fn umbrella() -> IndexedSurface {
    let (x, y) = ([-0.4, 0.6], [-0.3, 0.7]);
    let mut poles = Vec::new();
    for x in x {
        for z in [y[0] * y[0], y[0] * y[1], y[1] * y[1]] {
            let k = poles.len() % 3;
            let y = [y[0], 0.5 * (y[0] + y[1]), y[1]][k];
            poles.push([x, x * y, z]);
        }
    }
    patch(1, 2, &poles)
}

#[test]
fn a_cross_cap_inside_is_proven_to_have_no_bound() {
    let surface = umbrella();
    for (quantity, falls, grows) in [
        (Quantity::Sharpest, false, true),
        (Quantity::Greater, false, true),
        (Quantity::Less, true, false),
        (Quantity::Mean, true, true),
        (Quantity::Gaussian, true, false),
    ] {
        let found = range(&surface, quantity);
        assert!(!found.unbounded.is_empty() && !found.proven, "{quantity:?} {found:?}");
        let place = &found.unbounded[0];
        assert!((place.at[0] - 0.4).abs() < 1e-9 && (place.at[1] - 0.3).abs() < 1e-9, "{place:?}");
        assert!(place.falls == falls && place.grows == grows, "{quantity:?} {place:?}");
        assert!(found.moved == 0.0, "{found:?}");
    }
    let found = greatest(&surface);
    assert!(found.rest_proven, "{found:?}");
    sampled(&surface, &found);
}

#[test]
fn weights_that_hardly_differ_cost_no_boxes() {
    // A bent sheet of 8 x 8 spans; weights fall from 1 to 0.8 along it.
    let count = 10;
    let mut knots = vec![0.0, 0.0];
    knots.extend((0..9).map(f64::from));
    knots.extend([8.0, 8.0]);
    let (mut poles, mut weights) = (Vec::new(), Vec::new());
    for i in 0..count {
        for j in 0..count {
            let (x, y) = (i as f64 / 9.0, j as f64 / 9.0);
            poles.push([x, y, 0.3 * (x * x + 0.5 * y * y)]);
            weights.push(1.0 - 0.1 * x - 0.1 * y);
        }
    }
    let surface = Surface::new(&knots, &knots, 2, 2, &poles, count, count, Some(&weights)).unwrap();
    let surface = IndexedSurface::new(surface);
    let found = greatest(&surface);
    assert!(found.proven && found.boxes <= 3 * 64, "{found:?}");
}
