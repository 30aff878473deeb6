//! Curves and surfaces near points whose parameters are corrected: each point is fitted at its foot.
//!
//! ```text
//!   fit at the parameters -> feet of the points, by the iterations of `closest` from the parameters -> fit again
//!                         -> knots where points are still missed -> ...
//! ```
//!
//! At its foot a point's distance is that from the shape, not from a place that the parametrisation chose: fewer poles do. On surfaces a
//! step of Gauss and Newton towards the foot is enough of a correction, since the next fit moves the feet anyway.
//!
//! While knots are missing, surfaces are fitted to some of the points, drawn evenly, as many as their poles need, at the parameters that were
//! given; all points come in for the last rounds, and parameters are corrected once the surface is near.
//!
//! What is proven ([`super::certificate`]): `worst` is not exceeded by any data point, and some data point is at least `at_least` away.
//! Nothing is said between the data points.
//!
//! Reference: Hoschek, *Intrinsic parametrization for approximation*, Computer Aided Geometric Design 5, 1988.

use super::adaptive::cuts;
use super::certificate::{Certificate, Poll, certify, farthest, feet, nearer, size};
use super::parameters::{check_parameters, check_points};
use super::sample::{drawn, ordered};
use super::scattered::Design;
use super::{Adaptive, Ends, fitted};
use crate::analytic::linear::{add_square, any_frame, least_direction};
use crate::bounds::{Vector, dot, norm, sub};
use crate::closest::{FootPoint, QueryOptions, Scope, Workspace};
use crate::curve::Curve;
use crate::curve::insertion::{collect, copy_of, spare};
use crate::error::Error;
use crate::index::{IndexedCurve, IndexedSurface};
use crate::knots::{Knots, MAX_DEGREE};
use crate::portable::SameDigits;
use crate::surface::Surface;

/// How [`curve_near`] and [`surface_near`] fit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NearOptions {
    /// Degrees, 1 to 31; 3 by default. Curves use the first.
    pub degrees: [usize; 2],
    /// Distance of a point from the shape that is good enough; positive.
    pub tolerance: f64,
    /// No more poles than that; 10,000 by default.
    pub max_poles: usize,
    /// Corrections of all parameters for each set of knots, of surfaces once no point is farther away than ten tolerances; 3 by
    /// default, 0 for none.
    pub corrections: usize,
    /// Threads; 0 means all cores.
    pub threads: usize,
}

impl Default for NearOptions {
    fn default() -> Self {
        Self { degrees: [3, 3], tolerance: 1e-6, max_poles: 10_000, corrections: 3, threads: 0 }
    }
}

/// A shape near points, the parameters of their feet, and what is proven.
#[derive(Clone, Debug, PartialEq)]
pub struct Near<S, P> {
    /// The result.
    pub shape: S,
    /// Parameters of a place near every point: its foot, or one that is not farther away than the worst point's.
    pub parameters: Vec<P>,
    /// The distances.
    pub certificate: Certificate,
}

const LOCAL: QueryOptions = QueryOptions {
    tolerance: 0.0,
    accuracy: 0.0,
    method: crate::refine::Method::Auto,
    scope: Scope::Local,
    domain: None,
    budget: 0,
};

fn check_options(options: &NearOptions, directions: usize) -> Result<(), Error> {
    let refuse = |text: String| Err(Error::InvalidArgument(text));
    for (k, &degree) in options.degrees[..directions].iter().enumerate() {
        if degree == 0 || degree > MAX_DEGREE {
            let name = if directions == 1 { "" } else { ["_u", "_v"][k] };
            return refuse(format!("degree{name}: {degree} given, 1 to {MAX_DEGREE} accepted"));
        }
    }
    let needed: usize = options.degrees[..directions].iter().map(|p| p + 1).product();
    if options.max_poles < needed {
        return refuse(format!("max_poles: {} given, at least {needed} needed", options.max_poles));
    }
    if !(options.tolerance > 0.0 && options.tolerance.is_finite()) {
        return refuse(format!("tolerance: {} is not positive and finite", options.tolerance));
    }
    Ok(())
}

/// A curve near `points`, from the first to the last, which are its ends. `parameters` (not decreasing) are where the search begins:
/// chordal ones will do. Knots are added until every point is within the tolerance of the curve; where that is not reached
/// [`Certificate::worst`] is above it.
///
/// # Errors
/// What is not allowed, by name and index; [`Error::Cancelled`] when `poll` said so.
pub fn curve_near(
    points: &[Vector],
    parameters: &[f64],
    options: &NearOptions,
    poll: Poll,
) -> Result<Near<Curve, f64>, Error> {
    check_options(options, 1)?;
    check_points(points, 2)?;
    check_parameters(parameters, points.len())?;
    // Feet, residuals, knots and poles, and the certificate.
    spare(points.len(), 512)?;
    let degree = options.degrees[0];
    let (start, end) = (parameters[0], parameters[points.len() - 1]);
    let adaptive = Adaptive { degree, tolerance: options.tolerance, ..Adaptive::default() };
    adaptive.check([start, end])?;
    let mut values = adaptive.first_knots([start, end]);
    let limit = options.max_poles.min(points.len());
    let mut at = parameters.to_vec();
    let mut kept: Option<(Curve, Vec<f64>, f64)> = None;
    let curve_of = |at: &[f64], values: &[f64]| {
        let knots =
            Knots::new(values, degree, values.len() - degree - 1).map_err(|e| e.named(""))?;
        // In the order of the parameters: feet of neighbours may change places.
        let mut order: Vec<usize> = (0..at.len()).collect();
        order.sort_by(|&a, &b| at[a].total_cmp(&at[b]));
        // The ends stay the ends, whatever else has come to their parameters.
        order.retain(|&i| i != 0 && i + 1 != at.len());
        order.insert(0, 0);
        order.push(at.len() - 1);
        let sorted: Vec<f64> = order.iter().map(|&i| at[i]).collect();
        let list: Vec<Vector> = order.iter().map(|&i| points[i]).collect();
        fitted(knots, &sorted, &list, Ends::Interpolated)?.spline.curve()
    };
    loop {
        let mut curve = match (curve_of(&at, &values), &kept) {
            (Ok(curve), _) => curve,
            (Err(_), Some(_)) => break,
            (Err(error), None) => return Err(error),
        };
        let mut missed = missed_by(&curve, points, &at);
        for _ in 0..options.corrections {
            if worst(&missed) <= options.tolerance {
                break;
            }
            let shape = IndexedCurve::new(curve.clone());
            let ask = |i: usize, workspace: &mut Workspace| {
                shape.closest(points[i], Some(at[i]), &LOCAL, workspace, None)
            };
            let found = feet(points.len(), options.threads, &ask, poll)?;
            let mut next = at.clone();
            for i in 1..points.len() - 1 {
                if found[i].distance < missed[i] {
                    next[i] = found[i].u;
                }
            }
            // The feet alone never make it worse; the new fit may.
            (at, missed) =
                (next, missed.iter().zip(&found).map(|(m, f)| m.min(f.distance)).collect());
            let Ok(again) = curve_of(&at, &values) else { break };
            let now = missed_by(&again, points, &at);
            if worst(&now) >= worst(&missed) {
                break;
            }
            (curve, missed) = (again, now);
        }
        let error = worst(&missed);
        let done = error <= options.tolerance;
        let knots = curve.knots().clone();
        if kept.as_ref().is_none_or(|kept| error < kept.2) {
            kept = Some((curve, at.clone(), error));
        }
        if done {
            break;
        }
        let mut order: Vec<usize> = (0..at.len()).collect();
        order.sort_by(|&a, &b| at[a].total_cmp(&at[b]));
        let sorted: Vec<f64> = order.iter().map(|&i| at[i]).collect();
        let sorted_missed: Vec<f64> = order.iter().map(|&i| missed[i]).collect();
        let room = limit.saturating_sub(knots.pole_count());
        let new = cuts(&knots, &sorted, &sorted_missed, &adaptive, room);
        if new.is_empty() {
            break;
        }
        values.extend(new);
        values.sort_by(f64::total_cmp);
    }
    let Some((curve, at, _)) = kept else {
        return Err(Error::InvalidArgument("points: no curve".into()));
    };
    let size = size(curve.poles());
    let shape = IndexedCurve::new(curve);
    let from_hint = |i: usize, hint: f64, options: &QueryOptions, workspace: &mut Workspace| {
        shape.closest(points[i], Some(hint), options, workspace, None)
    };
    let near = |i: usize, workspace: &mut Workspace| from_hint(i, at[i], &LOCAL, workspace);
    let mut found = feet(points.len(), options.threads, &near, poll)?;
    let global = QueryOptions::default();
    let ask = |i: usize, foot: &FootPoint, workspace: &mut Workspace| {
        from_hint(i, foot.u, &global, workspace)
    };
    let certificate = farthest(&mut found, size, options.threads, &ask, poll)?;
    let parameters = found.iter().map(|foot| foot.u).collect();
    Ok(Near { shape: shape.curve().clone(), parameters, certificate })
}

fn worst(missed: &[f64]) -> f64 {
    missed.iter().fold(0.0, |a, b| a.max(*b))
}

fn missed_by(curve: &Curve, points: &[Vector], at: &[f64]) -> Vec<f64> {
    points.iter().zip(at).map(|(p, &t)| norm(curve.vector_from(*p, t))).collect()
}

/// Parameters in the plane that is nearest to the points, along its directions of greatest and least extent.
///
/// # Errors
/// Fewer than three points, or points that are not finite; points on a line.
pub fn plane_parameters(points: &[Vector]) -> Result<Vec<[f64; 2]>, Error> {
    check_points(points, 3)?;
    let size = points.iter().fold(0.0, |size: f64, p| size.max(norm(sub(*p, points[0]))));
    let part = |p: &Vector| sub(*p, points[0]).map(|x| x / size / points.len() as f64);
    let middle =
        points.iter().map(part).fold([0.0; 3], |a, b| [a[0] + b[0], a[1] + b[1], a[2] + b[2]]);
    let local = |p: &Vector| sub(sub(*p, points[0]).map(|x| x / size), middle);
    let mut square = [[0.0; 3]; 3];
    points.iter().for_each(|p| add_square(&mut square, &local(p)));
    let line = || Error::InvalidArgument("points: they lie on a line".into());
    let normal = least_direction(&square).ok_or_else(line)?;
    let [e, f, _] = any_frame(normal);
    let flat = |p: &Vector| [dot(local(p), e), dot(local(p), f)];
    let [xx, xy, yy] = points
        .iter()
        .map(flat)
        .fold([0.0; 3], |sum, [x, y]| [sum[0] + x * x, sum[1] + x * y, sum[2] + y * y]);
    let (sine, cosine) = (0.5 * (2.0 * xy).arctangent_over(xx - yy)).sine_cosine();
    let turned = |p: &Vector| {
        let [x, y] = flat(p);
        [cosine * x + sine * y, cosine * y - sine * x]
    };
    let list: Vec<[f64; 2]> = points.iter().map(turned).collect();
    if list.iter().all(|p| p[1].abs() < 1e-12) || list.iter().any(|p| !p[0].is_finite()) {
        return Err(line());
    }
    Ok(list)
}

/// A surface near `points` in any order. `parameters` are where the search begins (from [`plane_parameters`], from a grid, or from feet on a
/// surface that is roughly there); their box is the domain. Knots are added until every point is within the tolerance of the surface;
/// where that is not reached [`Certificate::worst`] is above it. Where there are no points the surface runs smoothly on.
///
/// # Errors
/// What is not allowed, by name and index; [`Error::Cancelled`] when `poll` said so.
pub fn surface_near(
    points: &[Vector],
    parameters: &[[f64; 2]],
    options: &NearOptions,
    poll: Poll,
) -> Result<Near<Surface, [f64; 2]>, Error> {
    check_options(options, 2)?;
    check_points(points, 4)?;
    let refuse = |text: String| Err(Error::InvalidArgument(text));
    if parameters.len() != points.len() {
        return refuse(format!(
            "parameters: {} given, {} expected",
            parameters.len(),
            points.len()
        ));
    }
    if let Some(i) = parameters.iter().position(|at| at.iter().any(|x| !x.is_finite())) {
        return refuse(format!("parameters: parameter {i} is not finite"));
    }
    let order = ordered(parameters)?;
    let given = points;
    let points = &collect(order.len(), order.iter().map(|&i| given[i]))?[..];
    let mut at = collect(order.len(), order.iter().map(|&i| parameters[i]))?;
    let mut values = [0, 1].map(|k| {
        let low = at.iter().fold(f64::INFINITY, |m, x| m.min(x[k]));
        let high = at.iter().fold(f64::NEG_INFINITY, |m, x| m.max(x[k]));
        let ends = |u| std::iter::repeat_n(u, options.degrees[k] + 1);
        ends(low).chain(ends(high)).collect::<Vec<f64>>()
    });
    let limit = options.max_poles.min(points.len());
    let mut kept: Option<(Surface, Vec<[f64; 2]>, f64)> = None;
    let mut takes_all = false;
    loop {
        let poles: usize = (0..2).map(|k| values[k].len() - options.degrees[k] - 1).product();
        let some = if takes_all { None } else { drawn(points.len(), PER_POLE * poles) };
        takes_all = some.is_none();
        let more = match some {
            Some(some) => {
                let list = collect(0, some)?;
                let points = collect(list.len(), list.iter().map(|&i| points[i]))?;
                let at = collect(list.len(), list.iter().map(|&i| at[i]))?;
                let (surface, mut missed) = surface_of(&points, &at, &values, options.degrees)?;
                if options.corrections > 0 {
                    (_, missed) = stepped(&surface, &points, &at, options.threads, poll)?;
                }
                new_knots(&surface, &at, &missed, options, limit)
            }
            None => {
                let Round { surface, error, more } =
                    corrected(points, &mut at, &values, options, limit, poll)?;
                if kept.as_ref().is_none_or(|kept| error < kept.2) {
                    kept = Some((surface, copy_of(&at)?, error));
                }
                more
            }
        };
        if more.iter().all(Vec::is_empty) {
            if takes_all {
                break;
            }
            takes_all = true;
        }
        for (values, more) in values.iter_mut().zip(more) {
            values.extend(more);
            values.sort_by(f64::total_cmp);
        }
    }
    let Some((surface, mut at, _)) = kept else { return refuse("points: no surface".into()) };
    let shape = IndexedSurface::new(surface);
    let (found, certificate) = certify(&shape, points, Some(&at), options.threads, poll)?;
    order.iter().zip(&found).for_each(|(&i, found)| at[i] = *found);
    let certificate = Certificate { worst_index: order[certificate.worst_index], ..certificate };
    Ok(Near { shape: shape.surface().clone(), parameters: at, certificate })
}

/// Points for each pole, at least, that tell, while knots are still missing, where: up to twice as many are drawn. Few enough to be quick,
/// enough for a cell to be seen: the worst of two dozen points of a cell is seldom far below the worst of all.
const PER_POLE: usize = 16;

/// Parameters are corrected when no point is farther away than this many tolerances. Feet on a surface that is still coarse are no better
/// than the parameters that were there, and bend the parametrisation: that takes more poles, not fewer.
const NEAR: f64 = 10.0;

/// All parameters a step of Gauss and Newton nearer to their feet, and the distances there.
fn stepped(
    surface: &Surface,
    points: &[Vector],
    at: &[[f64; 2]],
    threads: usize,
    poll: Poll,
) -> Result<(Vec<[f64; 2]>, Vec<f64>), Error> {
    let ask = |i: usize, _: &mut Workspace| {
        let ([u, v], distance) = nearer(surface, points[i], at[i], 1);
        FootPoint { u, v, distance, ..FootPoint::unreached() }
    };
    let found = feet(points.len(), threads, &ask, poll)?;
    let places = collect(found.len(), found.iter().map(|foot| [foot.u, foot.v]))?;
    Ok((places, collect(found.len(), found.iter().map(|foot| foot.distance))?))
}

/// A surface of all points.
struct Round {
    surface: Surface,
    /// Greatest distance at the parameters, or a step beyond.
    error: f64,
    /// Knots that are missing.
    more: [Vec<f64>; 2],
}

/// The surface of least squares for these knots, the parameters corrected on the way.
fn corrected(
    points: &[Vector],
    at: &mut Vec<[f64; 2]>,
    values: &[Vec<f64>; 2],
    options: &NearOptions,
    limit: usize,
    poll: Poll,
) -> Result<Round, Error> {
    let (mut surface, mut missed) = surface_of(points, at, values, options.degrees)?;
    for correction in 1..=options.corrections {
        if worst(&missed) <= options.tolerance {
            break;
        }
        let (places, reached) = stepped(&surface, points, at, options.threads, poll)?;
        if correction == 1 && worst(&reached) > NEAR * options.tolerance {
            // Without room for knots corrections are what is left.
            let more = new_knots(&surface, at, &reached, options, limit);
            if more.iter().any(|more| !more.is_empty()) {
                return Ok(Round { surface, error: worst(&reached), more });
            }
        }
        (*at, missed) = (places, reached);
        let reached = worst(&missed);
        if correction == options.corrections || reached <= options.tolerance {
            break;
        }
        let (again, now) = surface_of(points, at, values, options.degrees)?;
        if worst(&now) >= reached {
            break;
        }
        (surface, missed) = (again, now);
    }
    let more = new_knots(&surface, at, &missed, options, limit);
    Ok(Round { surface, error: worst(&missed), more })
}

/// The surface of least squares at parameters, and the distances there.
fn surface_of(
    points: &[Vector],
    at: &[[f64; 2]],
    values: &[Vec<f64>; 2],
    degrees: [usize; 2],
) -> Result<(Surface, Vec<f64>), Error> {
    let knots = |k: usize| {
        let count = values[k].len() - degrees[k] - 1;
        Knots::new(&values[k], degrees[k], count).map_err(|e| e.named(["_u", "_v"][k]))
    };
    let design = Design::new([knots(0)?, knots(1)?], at)?;
    let center = points[0];
    let (poles, missed) = design.solve(points, center)?;
    let list: Vec<Vector> =
        poles.iter().map(|p| std::array::from_fn(|x| p[x] + center[x])).collect();
    let counts = [0, 1].map(|k| values[k].len() - degrees[k] - 1);
    let surface = Surface::new(
        &values[0], &values[1], degrees[0], degrees[1], &list, counts[0], counts[1], None,
    )?;
    Ok((surface, missed))
}

/// New knots in the middle of spans: in the cells that miss a point, across their longer side, or both when they are nearly square. Halves
/// only: as long as the detail is not resolved, errors fall faster than any order says, and more pieces are more poles.
fn new_knots(
    surface: &Surface,
    at: &[[f64; 2]],
    missed: &[f64],
    options: &NearOptions,
    limit: usize,
) -> [Vec<f64>; 2] {
    let knots = [surface.knots_u(), surface.knots_v()];
    let counts = knots.map(Knots::pole_count);
    let mut wanted = [0, 1].map(|k| vec![0.0f64; counts[k]]);
    for (at, &missed) in at.iter().zip(missed).filter(|(_, m)| **m > options.tolerance) {
        let span = [0, 1].map(|k| knots[k].span(at[k]));
        let length = |k: usize| knots[k].values()[span[k] + 1] - knots[k].values()[span[k]];
        let mut partials = [[0.0; 3]; 3];
        surface.partials(at[0], at[1], 1, &mut partials);
        let sides = [norm(partials[1]) * length(0), norm(partials[2]) * length(1)];
        for k in 0..2 {
            if 1.5 * sides[k] >= sides[1 - k] {
                wanted[k][span[k]] = wanted[k][span[k]].max(missed);
            }
        }
    }
    let mut list: Vec<(f64, usize, usize)> = Vec::new();
    for (k, wanted) in wanted.iter().enumerate() {
        let spans = wanted.iter().enumerate().filter(|(_, missed)| **missed > 0.0);
        list.extend(spans.map(|(span, &missed)| (missed, k, span)));
    }
    list.sort_by(|a, b| b.0.total_cmp(&a.0));
    let (mut grown, mut out) = (counts, [Vec::new(), Vec::new()]);
    for (_, k, span) in list {
        if (grown[k] + 1).saturating_mul(grown[1 - k]) > limit {
            continue;
        }
        let [low, high] = [knots[k].values()[span], knots[k].values()[span + 1]];
        let (start, end) = knots[k].domain();
        // A span that thin holds no detail: the points contradict each other there.
        if high - low > 1e-6 * (end - start) {
            out[k].push(0.5 * low + 0.5 * high);
            grown[k] += 1;
        }
    }
    out
}
