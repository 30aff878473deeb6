//! How far data points are from a shape that was fitted to them, proven.
//!
//! ```text
//!   upper bound of a point's distance     its distance from any point of the shape: a foot that was approached from its parameters
//!   lower bound                           a global search, with proof
//!   at_least                              the greatest lower bound so far
//! ```
//!
//! A point whose upper bound is not above `at_least` is not the farthest: only those above approach their feet, and only those still above
//! are searched for globally, the worst first. Mostly these are a few dozen of any number of points.

use crate::batch;
use crate::bounds::{Aabb, Vector, dot, norm, sub};
use crate::closest::{FootPoint, QueryOptions, Workspace, flag};
use crate::error::Error;
use crate::index::IndexedSurface;
use crate::surface::Surface;

use super::parameters::check_points;

/// Asked now and then; true stops the work.
pub type Poll<'a> = &'a mut dyn FnMut() -> bool;

/// What is known of the distances of the data points from a shape.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Certificate {
    /// No data point is farther from the shape than this.
    pub worst: f64,
    /// The data point with that distance.
    pub worst_index: usize,
    /// Some data point is at least that far from the shape: the greatest proven lower bound. `worst` exceeds it by the accuracy of
    /// queries at most, unless points are `unproven`.
    pub at_least: f64,
    /// Root of the mean of the squared distances to the feet that were found.
    pub rms: f64,
    /// Data points that may be farther away than `at_least`: no nearer place was found, and none excluded.
    pub unproven: usize,
}

/// Points that are searched for before the next look at what is left.
const GROUP: usize = 128;

/// `worst` and `at_least` are closed up to this share of the box of the shape.
const ACCURACY: f64 = 1e-10;

/// Records for `count` points; `ask` answers for one.
pub(super) fn feet(
    count: usize,
    threads: usize,
    ask: &(dyn Fn(usize, &mut Workspace) -> FootPoint + Sync),
    poll: Poll,
) -> Result<Vec<FootPoint>, Error> {
    let mut out = Vec::new();
    out.try_reserve_exact(count).map_err(|_| Error::OutOfMemory)?;
    out.resize(count, FootPoint::unreached());
    let ask = |i: usize, workspace: &mut Workspace| ask(i, workspace);
    batch::run(&mut out, threads, None, &ask, &mut |_| poll())?;
    Ok(out)
}

/// Searches for the farthest of the points of which `feet` are upper bounds; `ask` searches globally, from a foot. What it finds
/// replaces the feet.
pub(super) fn farthest(
    feet: &mut [FootPoint],
    size: f64,
    threads: usize,
    ask: &(dyn Fn(usize, &FootPoint, &mut Workspace) -> FootPoint + Sync),
    poll: Poll,
) -> Result<Certificate, Error> {
    let mut order = Vec::new();
    order.try_reserve_exact(feet.len()).map_err(|_| Error::OutOfMemory)?;
    order.extend(0..feet.len());
    order.sort_by(|&a, &b| feet[b].distance.total_cmp(&feet[a].distance));
    let mut all = Certificate::default();
    let may_be_farthest =
        |foot: &FootPoint, at_least: f64| foot.distance > at_least + ACCURACY * size;
    let mut searched = 0;
    for group in order.chunks(GROUP) {
        if !may_be_farthest(&feet[group[0]], all.at_least) {
            break;
        }
        let now = &*feet;
        let one = |k: usize, workspace: &mut Workspace| ask(group[k], &now[group[k]], workspace);
        let found = self::feet(group.len(), threads, &one, poll)?;
        for (&i, foot) in group.iter().zip(found) {
            all.at_least = all.at_least.max(foot.lower_bound);
            feet[i] = match foot.distance <= feet[i].distance {
                true => foot,
                false => FootPoint { lower_bound: foot.lower_bound, flags: foot.flags, ..feet[i] },
            };
        }
        searched += group.len();
    }
    let mut sum = 0.0;
    for (i, foot) in feet.iter().enumerate() {
        sum += foot.distance * foot.distance;
        if foot.distance > all.worst || i == 0 {
            (all.worst, all.worst_index) = (foot.distance, i);
        }
    }
    let open = |i: &&usize| {
        feet[**i].flags & flag::NOT_PROVEN != 0 && may_be_farthest(&feet[**i], all.at_least)
    };
    all.unproven = order[..searched].iter().filter(open).count();
    all.rms = (sum / feet.len() as f64).sqrt();
    Ok(all)
}

/// Diagonal of the box of poles.
pub(super) fn size(poles: &[Vector]) -> f64 {
    let mut bounds = Aabb::EMPTY;
    poles.iter().for_each(|pole| bounds.include(*pole));
    bounds.diagonal()
}

/// At most `steps` steps of Gauss and Newton from `at` towards the foot of a point, as far as they lead nearer: parameters, and the
/// distance of the point that they are rounded to.
pub(super) fn nearer(
    surface: &Surface,
    point: Vector,
    at: [f64; 2],
    steps: usize,
) -> ([f64; 2], f64) {
    let ends = [surface.knots_u().domain(), surface.knots_v().domain()];
    let (mut best, mut next, mut distance) = (at, at, f64::INFINITY);
    for step in 0..=steps {
        let mut out = [[0.0; 3]; 3];
        surface.partials(next[0], next[1], usize::from(step < steps), &mut out);
        let [place, a, b] = out;
        let away = sub(point, place);
        if norm(away).is_nan() || norm(away) >= distance {
            break;
        }
        (best, distance) = (next, norm(away));
        let [aa, ab, bb] = [dot(a, a), dot(a, b), dot(b, b)];
        let [ra, rb] = [dot(away, a), dot(away, b)];
        let determinant = aa * bb - ab * ab;
        let moved = [(ra * bb - rb * ab) / determinant, (rb * aa - ra * ab) / determinant];
        if moved.iter().any(|x| !x.is_finite()) {
            break;
        }
        next = [0, 1].map(|k| (best[k] + moved[k]).clamp(ends[k].0, ends[k].1));
    }
    (best, distance)
}

/// The distance from the point at parameters, as every distance of a foot: without the rounding of that point to its coordinates.
fn placed(surface: &Surface, point: Vector, [u, v]: [f64; 2]) -> FootPoint {
    let distance = norm(surface.vector_from(point, u, v));
    FootPoint { u, v, distance, ..FootPoint::unreached() }
}

/// Steps before the global searches.
const STEPS: usize = 3;

/// The distances of points from a surface, with proof, and parameters at which no point is farther away than `worst`. `hints` are parameters near
/// the feet; without them every point is searched for globally.
///
/// # Errors
/// [`Error::Cancelled`] when `poll` said so; memory that could not be had.
pub fn certify(
    surface: &IndexedSurface,
    points: &[Vector],
    hints: Option<&[[f64; 2]]>,
    threads: usize,
    poll: Poll,
) -> Result<(Vec<[f64; 2]>, Certificate), Error> {
    check_points(points, 1)?;
    surface.prepare(&mut || false)?;
    let options = QueryOptions::default();
    let from_hint = |i: usize, hint: Option<[f64; 2]>, workspace: &mut Workspace| {
        surface.closest(points[i], hint, &options, workspace, None)
    };
    let shape = surface.surface();
    let near = |i: usize, workspace: &mut Workspace| match hints {
        Some(hints) => placed(shape, points[i], hints[i]),
        None => from_hint(i, None, workspace),
    };
    let mut found = feet(points.len(), threads, &near, poll)?;
    if let Some(hints) = hints {
        // The farthest by their hints tell which points may be the farthest at all; only these approach their feet.
        let mut order: Vec<usize> = (0..points.len()).collect();
        let group = GROUP.min(points.len());
        let farther = |&a: &usize, &b: &usize| found[b].distance.total_cmp(&found[a].distance);
        order.select_nth_unstable_by(group - 1, farther);
        let one = |k: usize, workspace: &mut Workspace| {
            from_hint(order[k], Some(hints[order[k]]), workspace)
        };
        let probed = feet(group, threads, &one, poll)?;
        let level = probed.iter().fold(0.0, |level: f64, foot| level.max(foot.lower_bound));
        order.retain(|&i| found[i].distance > level);
        let one = |k: usize, _: &mut Workspace| {
            let (point, hint) = (points[order[k]], hints[order[k]]);
            placed(shape, point, nearer(shape, point, hint, STEPS).0)
        };
        let approached = feet(order.len(), threads, &one, poll)?;
        order.iter().zip(approached).for_each(|(&i, foot)| found[i] = foot);
    }
    let ask = |i: usize, foot: &FootPoint, workspace: &mut Workspace| {
        from_hint(i, Some([foot.u, foot.v]), workspace)
    };
    let size = size(shape.poles());
    let all = farthest(&mut found, size, threads, &ask, poll)?;
    Ok((found.iter().map(|foot| [foot.u, foot.v]).collect(), all))
}
