//! A search of its own for the nearest place: dense samples, then Newton from the best of them. It uses the
//! evaluation only. Whatever it finds is attained, so that a nearer place, or one below a bound, is a counterexample
//! whatever the quality of the search.

use super::asked::{Shape, apart};
use super::{Vector, dot, sub};

/// A place in the domain and its distance.
#[derive(Clone, Copy)]
pub struct Found {
    pub at: [f64; 2],
    pub distance: f64,
}

/// Least distance that dense samples and Newton from the best of them find.
pub fn search(shape: &Shape, samples: &[([f64; 2], Vector)], query: Vector) -> Found {
    let mut best: Vec<Found> = samples
        .iter()
        .map(|(at, point)| Found { at: *at, distance: apart(query, *point) })
        .collect();
    let starts = best.len().min(24);
    best.select_nth_unstable_by(starts - 1, |a, b| a.distance.total_cmp(&b.distance));
    let polished = best[..starts].iter().map(|start| descend(shape, query, *start));
    polished.min_by(|a, b| a.distance.total_cmp(&b.distance)).expect("a start")
}

/// Levenberg's damped Newton steps with the parameters kept in the domain.
fn descend(shape: &Shape, query: Vector, start: Found) -> Found {
    let [u0, u1, v0, v1] = shape.domain();
    let (mut best, mut damping) = (start, 1e-3);
    for _ in 0..60 {
        let [g, h] = model(shape, query, best.at);
        let inside = |k: usize, step: f64| {
            let (low, high) = [(u0, u1), (v0, v1)][k];
            (best.at[k] + step).clamp(low, high)
        };
        let held = [0, 1].map(|k| {
            inside(k, -g[k].signum() * 1e-300) == best.at[k] && {
                let (low, high) = [(u0, u1), (v0, v1)][k];
                (best.at[k] == low && g[k] > 0.0) || (best.at[k] == high && g[k] < 0.0)
            }
        });
        let step = damped(g, h, held, damping);
        let at = [inside(0, step[0]), inside(1, step[1])];
        let distance = apart(query, shape.evaluate(at));
        if distance < best.distance {
            best = Found { at, distance };
            damping = (damping * 0.1).max(1e-12);
        } else {
            damping *= 8.0;
            if damping > 1e12 {
                break;
            }
        }
    }
    best
}

/// Gradient and Hessian (uu, uv, vv in `h[0]`, `h[1]`, `h[2]`) of half the squared distance.
fn model(shape: &Shape, query: Vector, at: [f64; 2]) -> [[f64; 3]; 2] {
    let mut jet = [[0.0; 3]; 6];
    match shape {
        Shape::Curve(curve) => {
            let mut out = [[0.0; 3]; 3];
            curve.curve().derivatives(at[0], 2, &mut out);
            [jet[0], jet[1], jet[3]] = out;
        }
        Shape::Surface(surface) => surface.surface().partials(at[0], at[1], 2, &mut jet),
    }
    let [s, su, sv, suu, suv, svv] = jet;
    let away = sub(s, query);
    [
        [dot(away, su), dot(away, sv), 0.0],
        [dot(su, su) + dot(away, suu), dot(su, sv) + dot(away, suv), dot(sv, sv) + dot(away, svv)],
    ]
}

/// `-(H + damping diag)^-1 g` over the parameters that are not held; Gauss-Newton's sign where H is indefinite.
fn damped(g: [f64; 3], h: [f64; 3], held: [bool; 2], damping: f64) -> [f64; 2] {
    let [a, b, c] = [h[0].abs() * (1.0 + damping), h[1], h[2].abs() * (1.0 + damping)];
    let single = |g: f64, h: f64| if h > 0.0 { -g / h } else { 0.0 };
    let det = a * c - b * b;
    match held {
        [true, true] => [0.0; 2],
        [true, false] => [0.0, single(g[1], c)],
        [false, true] => [single(g[0], a), 0.0],
        _ if det > 1e-12 * a * c => [(b * g[1] - c * g[0]) / det, (b * g[0] - a * g[1]) / det],
        _ => [single(g[0], a * (1.0 + damping)), single(g[1], c * (1.0 + damping))],
    }
}

/// Dense samples of a shape with their points.
pub fn dense(shape: &Shape) -> Vec<([f64; 2], Vector)> {
    let per_span = if matches!(shape, Shape::Curve(_)) { 400 } else { 40 };
    shape.samples_of(per_span).into_iter().map(|at| (at, shape.evaluate(at))).collect()
}
