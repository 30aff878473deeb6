//! Marching by name: from a start along n_A x n_B, without proof.
//!
//! ```text
//!   step h along the tangent, from the turn of the last two: h^2 turn / 8 = chord tolerance
//!   corrected (four parameters inside, three where a border holds one); closed when the start is passed again
//! ```

use super::contact::{in_tangent_plane, second};
use super::correct::{Corrector, correct};
use super::join::distance_to_chord;
use super::shape::Shape;
use crate::bounds::{Vector, cross, dot, norm, scaled, sub};

/// Most points of one walk.
const MOST_POINTS: usize = 100_000;

/// How a walk ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WalkEnd {
    /// It came back to its start.
    Closed,
    /// A border of a surface.
    Border,
    /// The tangent planes are parallel: a singular point.
    Singular,
    /// The corrector failed, there were too many points, or the caller said stop.
    Lost,
}

/// Places u, v, s, t of a walk in both directions from a start, in order, and its two ends.
pub struct Walk {
    /// Places.
    pub places: Vec<[f64; 4]>,
    /// Its ends.
    pub ends: [WalkEnd; 2],
}

/// Unit direction of the intersection, and the step of the parameters per length; `None` where the planes are parallel.
fn direction(a: &dyn Shape, b: &dyn Shape, at: [f64; 4]) -> Option<(Vector, [f64; 4])> {
    let (p, q) = (second(a, [at[0], at[1]]), second(b, [at[2], at[3]]));
    let (n, m) = (cross(p[1], p[2]), cross(q[1], q[2]));
    let along = cross(n, m);
    let length = norm(along);
    if length.is_nan() || length <= 1e-9 * norm(n) * norm(m) {
        return None;
    }
    let d = scaled(along, 1.0 / length);
    let ([u, v], [s, t]) = (in_tangent_plane(p[1], p[2], d)?, in_tangent_plane(q[1], q[2], d)?);
    Some((d, [u, v, s, t]))
}

/// Walks from a point of the intersection near `start` until both ends are known, or `poll` says stop at a point. `first` is the first
/// step, `chord` the tolerance.
pub fn follow(
    a: &dyn Shape,
    b: &dyn Shape,
    start: [f64; 4],
    corrector: Corrector,
    first: f64,
    chord: f64,
    poll: &mut dyn FnMut() -> bool,
) -> Option<Walk> {
    let tolerance = 1e-2 * chord;
    let begin = correct(a, b, start, corrector, tolerance, None)?.at;
    let mut ahead = vec![begin];
    let end = one_way(a, b, begin, 1.0, corrector, first, chord, poll, &mut ahead);
    if end == WalkEnd::Closed {
        return Some(Walk { places: ahead, ends: [end; 2] });
    }
    let mut behind = vec![begin];
    let other = one_way(a, b, begin, -1.0, corrector, first, chord, poll, &mut behind);
    behind.reverse();
    behind.pop();
    behind.extend(ahead);
    Some(Walk { places: behind, ends: [other, end] })
}

fn one_way(
    a: &dyn Shape,
    b: &dyn Shape,
    begin: [f64; 4],
    sign: f64,
    corrector: Corrector,
    first: f64,
    chord: f64,
    poll: &mut dyn FnMut() -> bool,
    out: &mut Vec<[f64; 4]>,
) -> WalkEnd {
    let (da, db) = (a.domain(), b.domain());
    let ends = [da[0], da[1], da[2], da[3], db[0], db[1], db[2], db[3]];
    let origin = a.evaluate(begin[0], begin[1]);
    let (mut at, mut h) = (begin, first);
    let Some((mut d, mut step)) = direction(a, b, at) else { return WalkEnd::Singular };
    while out.len() < MOST_POINTS {
        if h < 1e-10 * first || poll() {
            return WalkEnd::Lost;
        }
        let wish = [0, 1, 2, 3].map(|k| at[k] + sign * h * step[k]);
        // A border on the way: its parameter is held there, the other three are solved for.
        let out_of = |k: usize| {
            (wish[k] < ends[2 * k])
                .then_some(ends[2 * k])
                .or((wish[k] > ends[2 * k + 1]).then_some(ends[2 * k + 1]))
        };
        let landing = (0..4).filter_map(|k| {
            out_of(k).map(|end| (k, end, ((end - at[k]) / (wish[k] - at[k])).abs()))
        });
        let landing = landing.min_by(|x, y| x.2.total_cmp(&y.2));
        let (start, method) = match landing {
            Some((k, end, share)) => {
                let mut start = [0, 1, 2, 3].map(|q| at[q] + share * (wish[q] - at[q]));
                start[k] = end;
                (start, Corrector::NewtonThree(k))
            }
            None => (wish, corrector),
        };
        let here = a.evaluate(at[0], at[1]);
        let found = correct(a, b, start, method, 1e-2 * chord, None).map(|found| found.at);
        let Some(next) = found.filter(|next| {
            let moved = norm(sub(a.evaluate(next[0], next[1]), here));
            moved <= 2.0 * h && (landing.is_some() || moved >= 0.3 * h)
        }) else {
            h *= 0.5;
            continue;
        };
        let there = a.evaluate(next[0], next[1]);
        let Some((turned, onward)) = direction(a, b, next) else {
            out.push(next);
            return WalkEnd::Singular;
        };
        let turn = norm(sub(turned, d));
        let length = norm(sub(there, here));
        // The arc's height over its chord, and a turn that is not a jump to another branch.
        if landing.is_none() && (length * turn / 8.0 > chord || turn > 0.5) {
            h *= 0.5;
            continue;
        }
        let passes = distance_to_chord(origin, here, there) <= 2.0 * chord
            && dot(sub(origin, here), sub(there, here)) > 0.0;
        if out.len() > 2 && passes {
            out.push(begin);
            return WalkEnd::Closed;
        }
        out.push(next);
        if landing.is_some() {
            return WalkEnd::Border;
        }
        if length * turn / 8.0 < 0.25 * chord {
            h *= 1.5;
        }
        (at, d, step) = (next, turned, onward);
    }
    WalkEnd::Lost
}
