//! Bisection refinement by name: midpoints of the parameters are corrected until the chord tolerance holds at them. Without proof.

use super::correct::{Corrector, correct};
use super::join::distance_to_chord;
use super::shape::Shape;
use crate::bounds::{norm, sub};

/// Most halvings between two places.
const MOST_HALVINGS: u32 = 20;

/// The given places u, v, s, t of an intersection with as many between them as `chord`, a length, asks for; none more once `poll` says
/// stop. `None` where a correction fails, or lands elsewhere than between the two.
pub fn refined(
    a: &dyn Shape,
    b: &dyn Shape,
    places: &[[f64; 4]],
    corrector: Corrector,
    chord: f64,
    poll: &mut dyn FnMut() -> bool,
) -> Option<Vec<[f64; 4]>> {
    let mut out = vec![*places.first()?];
    for pair in places.windows(2) {
        between(a, b, [pair[0], pair[1]], corrector, chord, poll, 0, &mut out)?;
        out.push(pair[1]);
    }
    Some(out)
}

fn between(
    a: &dyn Shape,
    b: &dyn Shape,
    [from, to]: [[f64; 4]; 2],
    corrector: Corrector,
    chord: f64,
    poll: &mut dyn FnMut() -> bool,
    depth: u32,
    out: &mut Vec<[f64; 4]>,
) -> Option<()> {
    if poll() {
        return Some(());
    }
    let middle = [0, 1, 2, 3].map(|k| 0.5 * (from[k] + to[k]));
    let at = correct(a, b, middle, corrector, 1e-2 * chord, None)?.at;
    let [x, y, z] = [from, at, to].map(|p| a.evaluate(p[0], p[1]));
    let length = norm(sub(z, x));
    if norm(sub(y, x)).max(norm(sub(y, z))) > length {
        return None;
    }
    if distance_to_chord(y, x, z) <= chord || depth == MOST_HALVINGS {
        return Some(());
    }
    between(a, b, [from, at], corrector, chord, poll, depth + 1, out)?;
    out.push(at);
    between(a, b, [at, to], corrector, chord, poll, depth + 1, out)
}
