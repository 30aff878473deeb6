//! Methods by name, each alone, with an intersection as its result: for comparison, and where the caller knows a start.
//!
//! ```text
//!   subdivision, mesh      polylines on triangles: points are as far from the surfaces as the triangles, which the gap says
//!   marching, bisection    points on both surfaces within the corrector's tolerance
//! ```
//!
//! Nothing is proven: one undecided box is all of both domains, and chords are unknown (infinite).

use super::bisect::refined;
use super::correct::Corrector;
use super::follow::follow;
use super::functions::{both_domains, branch, drawn, size};
use super::shape::Shape;
use super::triangles::{Discrete, meshed, subdivided};
use super::watch::Watch;
use super::{DEFAULT_BUDGET, Intersection, MarchOptions, MarchPoint};
use crate::bounds::{add, norm, scaled, sub};
use crate::error::Error;
use crate::surface::Surface;

/// Cells along each direction when the caller does not say.
const CELLS: u32 = 64;

/// Most of them: their triangles are memory.
const MOST_CELLS: u32 = 1024;

/// Most levels of a subdivision.
const MOST_LEVELS: u32 = 20;

/// Ends of a polyline within this share of the smaller surface are one.
const CLOSED: f64 = 1e-9;

/// About the size of the smaller of two surfaces.
pub fn smaller(a: &dyn Shape, b: &dyn Shape) -> f64 {
    size(a).min(size(b))
}

/// The point of an intersection at u, v, s, t.
pub fn on_both(a: &dyn Shape, b: &dyn Shape, [u, v, s, t]: [f64; 4]) -> MarchPoint {
    let (x, y) = (a.evaluate(u, v), b.evaluate(s, t));
    MarchPoint { point: scaled(add(x, y), 0.5), uv: [u, v], st: [s, t] }
}

fn too_many(levels: u32, most: u32) -> Error {
    Error::InvalidArgument(format!("levels: {levels} is more than {most}"))
}

/// Subdivision by hulls, both surfaces quartered `levels` times (at most 20); 0: until their parts are as flat as the chord tolerance.
///
/// # Errors
/// [`Error::InvalidArgument`] for a length that is none or too many levels.
pub fn by_subdivision(
    a: &Surface,
    b: &Surface,
    levels: u32,
    options: &MarchOptions,
    poll: &mut dyn FnMut(u64, u64) -> bool,
) -> Result<Intersection, Error> {
    let options = options.checked()?;
    if levels > MOST_LEVELS {
        return Err(too_many(levels, MOST_LEVELS));
    }
    let flat = (levels == 0).then(|| options.chord_or(smaller(a, b)));
    let budget = if options.budget > 0 { options.budget } else { DEFAULT_BUDGET };
    Ok(of_lines(a, b, subdivided(a, b, 2 * levels, flat, budget, poll)))
}

/// The intersection of two tessellations of `cells` x `cells` cells (at most 1024; 0: 64).
///
/// # Errors
/// [`Error::InvalidArgument`] for too many cells; [`Error::OutOfMemory`].
pub fn by_mesh(
    a: &dyn Shape,
    b: &dyn Shape,
    cells: u32,
    poll: &mut dyn FnMut(u64, u64) -> bool,
) -> Result<Intersection, Error> {
    if cells > MOST_CELLS {
        return Err(too_many(cells, MOST_CELLS));
    }
    let cells = if cells > 0 { cells } else { CELLS };
    Ok(of_lines(a, b, meshed(a, b, cells as usize, poll)?))
}

/// The branch through a place near a start, walked both ways. `first` is the length of the first step, 0: a 256th of the smaller surface.
/// `None` when the start leads to no point of the intersection, or its tangent planes are parallel.
///
/// # Errors
/// [`Error::InvalidArgument`] for a length that is none.
pub fn by_marching(
    a: &dyn Shape,
    b: &dyn Shape,
    start: [f64; 4],
    corrector: Corrector,
    first: f64,
    options: &MarchOptions,
    poll: &mut dyn FnMut(u64, u64) -> bool,
) -> Result<Option<Intersection>, Error> {
    let options = options.checked()?;
    let size = smaller(a, b);
    let first = if first > 0.0 { first } else { size / 256.0 };
    let watch = Watch::new(poll);
    let mut stops = || watch.stops(0);
    let walk = follow(a, b, start, corrector, first, options.chord_or(size), &mut stops);
    let Some(walk) = walk.filter(|walk| walk.places.len() > 1 || watch.stopped()) else {
        return Ok(None);
    };
    let branches = vec![branch(a, b, &walk)];
    let undecided = vec![both_domains(a, b)];
    let stopped = watch.stopped();
    Ok(Some(Intersection { branches, undecided, stopped, ..Intersection::default() }))
}

/// The branch through given places u, v, s, t in order, with as many between them as the chord tolerance asks for. `None` where a
/// correction fails, or lands elsewhere than between two places.
///
/// # Errors
/// [`Error::InvalidArgument`] for a length that is none, or fewer than two places.
pub fn by_bisection(
    a: &dyn Shape,
    b: &dyn Shape,
    places: &[[f64; 4]],
    corrector: Corrector,
    options: &MarchOptions,
    poll: &mut dyn FnMut(u64, u64) -> bool,
) -> Result<Option<Intersection>, Error> {
    let options = options.checked()?;
    if places.len() < 2 {
        return Err(Error::InvalidArgument(format!("places: {} are given", places.len())));
    }
    let watch = Watch::new(poll);
    let chord = options.chord_or(smaller(a, b));
    let fine = refined(a, b, places, corrector, chord, &mut || watch.stops(0));
    let made = |places: Vec<[f64; 4]>| Intersection {
        branches: vec![drawn(a, b, &places, places[0] == places[places.len() - 1])],
        undecided: vec![both_domains(a, b)],
        stopped: watch.stopped(),
        ..Intersection::default()
    };
    Ok(fine.map(made))
}

fn of_lines(a: &dyn Shape, b: &dyn Shape, found: Discrete) -> Intersection {
    let near = CLOSED * smaller(a, b);
    let branches = found.lines.iter().map(|line| {
        let is_closed = line.len() > 3 && norm(sub(line[0].x, line[line.len() - 1].x)) <= near;
        let mut places: Vec<[f64; 4]> = line.iter().map(|node| node.at).collect();
        if is_closed {
            let end = places.len() - 1;
            places[end] = places[0];
        }
        drawn(a, b, &places, is_closed)
    });
    Intersection {
        branches: branches.collect(),
        undecided: vec![both_domains(a, b)],
        judged: found.looked,
        exhausted: found.exhausted,
        stopped: found.stopped,
        ..Intersection::default()
    }
}
