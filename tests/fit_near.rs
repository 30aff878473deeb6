//! Fits whose parameters are corrected, and what is proven about them.

use footpoint::curve::Curve;
use footpoint::fit::{
    Adaptive, NearOptions, Spacing, adaptive, certify, curve_near, parameters, plane_parameters,
    surface_near,
};
use footpoint::index::IndexedSurface;

/// Numbers from 0 to 1, always the same.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }
}

fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|k| (a[k] - b[k]) * (a[k] - b[k])).sum::<f64>().sqrt()
}

/// Least distance to dense samples of a curve.
fn dense(curve: &Curve, p: [f64; 3]) -> f64 {
    let (start, end) = curve.domain();
    let samples = (0..=4000).map(|i| start + (end - start) * i as f64 / 4000.0);
    samples.map(|u| distance(curve.evaluate(u), p)).fold(f64::INFINITY, f64::min)
}

#[test]
fn a_curve_near_points_keeps_its_tolerance_and_needs_fewer_poles_than_without_feet() {
    let spiral = |t: f64| [(1.0 + t) * (4.0 * t).cos(), (1.0 + t) * (4.0 * t).sin(), t * t];
    let mut random = Random(1);
    let mut list: Vec<f64> = (0..498).map(|_| random.next()).chain([0.0, 1.0]).collect();
    list.sort_by(f64::total_cmp);
    let points: Vec<[f64; 3]> = list.iter().map(|&t| spiral(t * t)).collect();
    // A bad parametrisation: uniform for points at random places.
    let start = parameters(Spacing::Uniform, &points).unwrap();
    let tolerance = 1e-4;
    let options = NearOptions { tolerance, ..NearOptions::default() };
    let near = curve_near(&points, &start, &options, &mut || false).unwrap();
    let all = near.certificate;
    assert!(all.worst <= tolerance && all.unproven == 0, "{all:?}");
    assert!(all.at_least <= all.worst && all.worst - all.at_least < 1e-8);
    for (i, p) in points.iter().enumerate().step_by(7) {
        let foot = distance(near.shape.evaluate(near.parameters[i]), *p);
        assert!(foot <= all.worst && foot <= dense(&near.shape, *p) + 1e-9);
    }
    let options = Adaptive { tolerance, ..Adaptive::default() };
    let plain = adaptive(&start, &points, &options).unwrap();
    let (with, without) = (near.shape.poles().len(), plain.spline.poles().len());
    assert!(with * 2 < without, "{with} poles with feet, {without} without");
    assert_eq!((near.shape.evaluate(0.0), near.shape.evaluate(1.0)), (points[0], points[499]));
}

/// A hill over the plane, tilted.
fn hill(x: f64, y: f64) -> [f64; 3] {
    let z = (1.5 * x).sin() * (1.2 * y).cos() + 0.1 * x * y;
    [x + 0.2 * z, y - 0.1 * z, z - 0.3 * x]
}

#[test]
fn scattered_points_of_a_surface_are_met_with_proof() {
    let mut random = Random(7);
    let points: Vec<[f64; 3]> =
        (0..3000).map(|_| hill(4.0 * random.next() - 2.0, 3.0 * random.next())).collect();
    let start = plane_parameters(&points).unwrap();
    let mut before = 0;
    for tolerance in [1e-2, 1e-3, 1e-4] {
        let options = NearOptions { tolerance, ..NearOptions::default() };
        let near = surface_near(&points, &start, &options, &mut || false).unwrap();
        let all = near.certificate;
        assert!(all.worst <= tolerance && all.unproven == 0, "{tolerance} {all:?}");
        for (p, at) in points.iter().zip(&near.parameters) {
            let found = distance(near.shape.evaluate(at[0], at[1]), *p);
            assert!(found <= all.worst + 1e-15, "{found:e} {:e}", all.worst);
        }
        let count = near.shape.poles().len();
        assert!(before < count && count < 600, "{tolerance}: {count}");
        before = count;
    }
}

/// A place of the plane, bent: what parameters are that were guessed.
fn bent([x, y]: [f64; 2]) -> [f64; 2] {
    [x + 0.15 * (1.7 * x + y).sin(), y + 0.12 * (2.0 * y - x).cos()]
}

#[test]
fn many_points_at_uneven_parameters_are_met_whatever_the_threads() {
    let mut random = Random(11);
    let places: Vec<[f64; 2]> =
        (0..20_000).map(|_| [4.0 * random.next() - 2.0, 3.0 * random.next()]).collect();
    let points: Vec<[f64; 3]> = places.iter().map(|p| hill(p[0], p[1])).collect();
    let guessed: Vec<[f64; 2]> = places.iter().map(|p| bent(*p)).collect();
    let fit = |start: &[[f64; 2]], threads: usize| {
        let options = NearOptions { tolerance: 1e-3, threads, ..NearOptions::default() };
        surface_near(&points, start, &options, &mut || false).unwrap()
    };
    let (even, uneven) = (fit(&places, 1), fit(&guessed, 1));
    for near in [&even, &uneven] {
        let all = near.certificate;
        assert!(all.worst <= 1e-3 && all.unproven == 0, "{all:?}");
        let away = |i: usize| {
            let [u, v] = near.parameters[i];
            distance(near.shape.evaluate(u, v), points[i])
        };
        assert!((0..points.len()).all(|i| away(i) <= all.worst + 1e-12));
        assert!((away(all.worst_index) - all.worst).abs() < 1e-12);
    }
    let [few, more] = [&even, &uneven].map(|near| near.shape.poles().len());
    assert!(few < 150 && more < 4 * few, "{few} {more}");
    assert_eq!(fit(&guessed, 3), uneven);
}

#[test]
fn noise_is_not_followed_and_said_to_be_there() {
    let mut random = Random(3);
    let points: Vec<[f64; 3]> = (0..2000)
        .map(|_| {
            let mut p = hill(4.0 * random.next() - 2.0, 3.0 * random.next());
            p[2] += 2e-3 * (random.next() - 0.5);
            p
        })
        .collect();
    let start = plane_parameters(&points).unwrap();
    let options = NearOptions { tolerance: 2e-3, ..NearOptions::default() };
    let near = surface_near(&points, &start, &options, &mut || false).unwrap();
    assert!(near.certificate.worst <= 2e-3 && near.shape.poles().len() < 400);
    // A tolerance that the noise forbids with that few poles: not reached, and told.
    let options = NearOptions { tolerance: 1e-6, max_poles: 300, ..NearOptions::default() };
    let near = surface_near(&points, &start, &options, &mut || false).unwrap();
    assert!(near.certificate.worst > 1e-6 && near.certificate.at_least > 1e-5);
}

#[test]
fn holes_are_bridged_smoothly() {
    let mut random = Random(5);
    let mut points = Vec::new();
    while points.len() < 3000 {
        let (x, y) = (4.0 * random.next() - 2.0, 3.0 * random.next());
        if (x - 0.3).hypot(y - 1.4) > 0.5 {
            points.push(hill(x, y));
        }
    }
    let start = plane_parameters(&points).unwrap();
    let options = NearOptions { tolerance: 1e-3, ..NearOptions::default() };
    let near = surface_near(&points, &start, &options, &mut || false).unwrap();
    assert!(near.certificate.worst <= 1e-3);
    let surface = IndexedSurface::new(near.shape);
    let inside = [hill(0.3, 1.4), hill(0.2, 1.2), hill(0.5, 1.5)];
    let (_, all) = certify(&surface, &inside, None, 1, &mut || false).unwrap();
    assert!(all.worst < 0.1, "{all:?}");
}

#[test]
fn defects_are_named_and_a_stop_is_heard() {
    let points: Vec<[f64; 3]> = (0..40).map(|k| hill((k % 8) as f64, (k / 8) as f64)).collect();
    let start = plane_parameters(&points).unwrap();
    let text = |options: NearOptions| {
        surface_near(&points, &start, &options, &mut || false).unwrap_err().to_string()
    };
    let base = NearOptions::default();
    assert!(text(NearOptions { degrees: [3, 0], ..base }).contains("degree_v: 0"));
    assert!(text(NearOptions { tolerance: f64::NAN, ..base }).contains("tolerance"));
    assert!(
        text(NearOptions { max_poles: 15, ..base }).contains("max_poles: 15 given, at least 16")
    );
    let refused = surface_near(&points, &start[1..], &base, &mut || false).unwrap_err();
    assert!(refused.to_string().contains("parameters: 39 given, 40 expected"));
    let one = vec![[0.0, 0.0]; 40];
    assert!(
        surface_near(&points, &one, &base, &mut || false)
            .unwrap_err()
            .to_string()
            .contains("knots_u")
    );
    let options = NearOptions { tolerance: 1e-12, ..base };
    assert_eq!(
        surface_near(&points, &start, &options, &mut || true).err(),
        Some(footpoint::error::Error::Cancelled)
    );
    let line: Vec<[f64; 3]> = (0..9).map(|k| [k as f64, 2.0 * k as f64, 1.0]).collect();
    assert!(plane_parameters(&line).unwrap_err().to_string().contains("on a line"));
}
