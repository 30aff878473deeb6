//! Operations on the real cases: what is exact stays within 1e-12 of the size, what is not keeps its error.

#[allow(dead_code, reason = "a part of the cases only")]
#[path = "cases/mod.rs"]
mod cases;

use cases::{Shape, folders, read};
use footpoint::curve::Curve;
use footpoint::knots::Knots;
use footpoint::operate::Direction;
use footpoint::surface::Surface;

/// Is no span shorter than 1e-3 of the largest knot?
fn is_even(knots: &Knots) -> bool {
    let t = knots.values();
    let far = t.iter().fold(0.0, |far: f64, u| far.max(u.abs()));
    knots.spans().all(|i| t[i + 1] - t[i] >= 1e-3 * far)
}

fn curve(name: &str, size: f64, curve: &Curve) {
    let near = |other: &Curve, what: &str| {
        let bound = curve.difference(other).unwrap().bound;
        assert!(bound <= 1e-12 * (1 + curve.degree()) as f64 * size, "{name}: {what}: {bound:e}");
    };
    near(&curve.clamp().unwrap(), "clamped");
    near(&curve.bezier_form().unwrap(), "Bezier form");
    // A mirrored knot is rounded to the ulps of the domain, which a short span does not forgive.
    if is_even(curve.knots()) {
        near(&curve.reverse().unwrap().reverse().unwrap(), "reversed twice");
    }
    if curve.degree() < 25 {
        near(&curve.elevate(1).unwrap(), "elevated");
    }
    let (start, end) = curve.domain();
    let middle = 0.5 * start + 0.5 * end;
    let parts = [curve.part(start, middle).unwrap(), curve.part(middle, end).unwrap()];
    let joined = footpoint::operate::join_curves(&parts, 1e-9 * size).unwrap();
    assert!(joined.error <= 1e-11 * size, "{name}: joined: {:e}", joined.error);
    let coarse = curve.simplify(1e-3 * size).unwrap();
    assert!(coarse.error <= 1e-3 * size && coarse.shape.poles().len() <= curve.poles().len());
    let length = curve.arc_length(0.0).unwrap().total();
    assert!(length.value > 0.0 && length.error <= 1e-9 * size, "{name}: {length:?}");
}

fn surface(name: &str, size: f64, surface: &Surface) {
    let near = |other: &Surface, what: &str| {
        let bound = surface.difference(other).unwrap().bound;
        let degree = surface.knots_u().degree().max(surface.knots_v().degree());
        assert!(bound <= 1e-12 * (1 + degree) as f64 * size, "{name}: {what}: {bound:e}");
    };
    near(&surface.clamp().unwrap(), "clamped");
    near(&surface.swap().unwrap().swap().unwrap(), "swapped twice");
    for direction in [Direction::U, Direction::V] {
        if is_even(surface.knots(direction)) {
            near(
                &surface.reverse(direction).unwrap().reverse(direction).unwrap(),
                "reversed twice",
            );
        }
        near(&surface.elevate(direction, 1).unwrap(), "elevated");
    }
    let coarse = surface.simplify(1e-3 * size).unwrap();
    assert!(coarse.error <= 1e-3 * size && coarse.shape.poles().len() <= surface.poles().len());
}

#[test]
fn the_laws_hold_on_the_real_cases() {
    let mut count = 0;
    for folder in folders() {
        let case = read(&folder);
        let size = case.magnitude;
        match &case.shape {
            Shape::Curve(c) => curve(&case.name, size, c.curve()),
            // Few poles: the large ones take too long here.
            Shape::Surface(s) if s.surface().poles().len() <= 400 => {
                surface(&case.name, size, s.surface())
            }
            Shape::Surface(_) => continue,
        }
        count += 1;
    }
    assert!(count >= 20, "{count} cases");
}
