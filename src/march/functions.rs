//! Surfaces given by functions: what a mesh of both sees, made exact and walked along. Nothing is proven.
//!
//! Loops smaller than a cell of the mesh, and places where the surfaces touch, are not seen: the result says so with one undecided box
//! that is all of both domains.

use super::correct::{Corrector, correct};
use super::follow::{Walk, WalkEnd, follow};
use super::join::distance_to_chord;
use super::shape::Shape;
use super::triangles::meshed;
use super::watch::Watch;
use super::{Branch, End, Intersection, MarchPoint, Region};
use crate::bounds::{Aabb, add, norm, scaled, sub};
use crate::error::Error;

/// Cells of the mesh along each direction.
const CELLS: usize = 64;

/// The branches that a mesh of two surfaces sees, until `poll(walked, waiting)` says stop. `chord`: a length, or 0 for 1e-3 of the smaller
/// surface.
///
/// # Errors
/// [`Error::OutOfMemory`].
pub fn walked(
    a: &dyn Shape,
    b: &dyn Shape,
    chord: f64,
    poll: &mut dyn FnMut(u64, u64) -> bool,
) -> Result<Intersection, Error> {
    let size = size(a).min(size(b));
    let chord = if chord > 0.0 { chord } else { 1e-3 * size };
    let watch = Watch::new(poll);
    let lines = meshed(a, b, CELLS, &mut |done, left| watch.asks(done, left))?.lines;
    let mut found = Intersection::default();
    let waiting = lines.iter().map(Vec::len).sum::<usize>() as u64;
    for node in lines.iter().flatten() {
        if watch.asks(found.judged, waiting) {
            break;
        }
        found.judged += 1;
        let Some(place) = correct(a, b, node.at, Corrector::Auto, 1e-2 * chord, None) else {
            continue;
        };
        let [u, v, s, t] = place.at;
        let x = scaled(add(a.evaluate(u, v), b.evaluate(s, t)), 0.5);
        let near = |branch: &Branch| {
            branch
                .points
                .windows(2)
                .any(|w| distance_to_chord(x, w[0].point, w[1].point) <= 4.0 * chord)
        };
        if found.branches.iter().any(near) {
            continue;
        }
        let first = 0.25 * size / CELLS as f64;
        let mut stops = || watch.stops(0);
        if let Some(walk) = follow(a, b, place.at, Corrector::Auto, first, chord, &mut stops)
            && walk.places.len() > 1
        {
            found.branches.push(branch(a, b, &walk));
        }
    }
    found.stopped = watch.stopped();
    found.undecided.push(both_domains(a, b));
    Ok(found)
}

/// What is undecided where nothing is proven: all of both domains.
pub fn both_domains(a: &dyn Shape, b: &dyn Shape) -> Region {
    let (da, db) = (a.domain(), b.domain());
    Region { range: std::array::from_fn(|k| [da, db][k / 4][k % 4]) }
}

/// About the diagonal of a surface's box, from samples.
pub fn size(shape: &dyn Shape) -> f64 {
    let [u0, u1, v0, v1] = shape.domain();
    let mut all = Aabb::EMPTY;
    for k in 0..81 {
        let share = |n: usize, a: f64, b: f64| a + (b - a) * n as f64 / 8.0;
        let p = shape.evaluate(share(k / 9, u0, u1), share(k % 9, v0, v1));
        if p.iter().all(|x| x.is_finite()) {
            all.include(p);
        }
    }
    all.diagonal()
}

/// A branch through places of which nothing is proven; ends that are not closed are borders where a parameter is on one.
pub fn drawn(a: &dyn Shape, b: &dyn Shape, places: &[[f64; 4]], is_closed: bool) -> Branch {
    let mut gap = 0.0f64;
    let mut point = |at: &[f64; 4]| {
        let (x, y) = (a.evaluate(at[0], at[1]), b.evaluate(at[2], at[3]));
        gap = gap.max(norm(sub(x, y)));
        MarchPoint { point: scaled(add(x, y), 0.5), uv: [at[0], at[1]], st: [at[2], at[3]] }
    };
    let points: Vec<MarchPoint> = places.iter().map(&mut point).collect();
    let (da, db) = (a.domain(), b.domain());
    let end = |at: &[f64; 4]| {
        let ends = [da[0], da[1], da[2], da[3], db[0], db[1], db[2], db[3]];
        let side = (0..8).find(|&side| at[side / 2] == ends[side]);
        side.map_or(End::Undecided, |side| End::Border(side as u8))
    };
    let ends = match is_closed {
        true => [End::Closed; 2],
        false => [end(&places[0]), end(&places[places.len() - 1])],
    };
    Branch {
        points,
        ends,
        is_tangential: false,
        bounds_overlap: false,
        gap,
        chord: f64::INFINITY,
        bulge: [f64::INFINITY; 4],
        held: Vec::new(),
    }
}

/// A walk as a branch.
pub fn branch(a: &dyn Shape, b: &dyn Shape, walk: &Walk) -> Branch {
    let mut branch = drawn(a, b, &walk.places, walk.ends[0] == WalkEnd::Closed);
    for (end, walked) in branch.ends.iter_mut().zip(walk.ends) {
        if matches!(walked, WalkEnd::Singular | WalkEnd::Lost) {
            *end = End::Undecided;
        }
    }
    branch
}
