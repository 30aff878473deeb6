//! Curves from branches: fewer points, and B-splines in space and in both parameter planes with one parameter.
//!
//! ```text
//!   points -> a cubic through them in (x, y, z, u, v, s, t) -> each of its places corrected onto both surfaces -> a spline of seven
//!             coordinates near that function -> split into C(t), (u, v)(t), (s, t)(t) on the same knots
//! ```
//!
//! The error is proven on the result (`pcurve::deviation`): C(t) - A(u(t), v(t)) and C(t) - B(s(t), t(t)) as polynomials, bounded by their
//! coefficients. Parameters count in the fit as the lengths that they move.

use super::MarchPoint;
use super::correct::{Corrector, correct};
use super::join::distance_to_chord;
use crate::bounds::{Vector, norm, sub};
use crate::curve::Curve;
use crate::error::Error;
use crate::fit::{Adaptive, interpolate, of_function};
use crate::index::IndexedSurface;
use crate::pcurve::compose::Composer;
use crate::pcurve::deviation::deviation;
use crate::surface::Surface;

/// Points nearer than this share of the length are one for a fit.
const CLOSE: f64 = 1e-6;

/// A branch, or the part of it between two seams, as curves with a common parameter.
pub struct BranchCurves {
    /// In space.
    pub space: Curve,
    /// In the domain of A, z = 0.
    pub uv: Curve,
    /// In the domain of B, z = 0.
    pub st: Curve,
    /// Proven: the greater one of `distance`.
    pub error: f64,
    /// Proven: at equal parameters `space` is nowhere farther from A(`uv`), and from B(`st`), and so from A and from B.
    pub distance: [f64; 2],
}

/// The points that are needed for the polyline to stay within `chord` of the given one: the farthest point is kept, over and over.
/// Ends and both points of a seam stay.
pub fn reduced(points: &[MarchPoint], chord: f64) -> Vec<MarchPoint> {
    let mut keep = vec![false; points.len()];
    let mut waiting = Vec::new();
    let (mut start, near) = (0, seam_distance(points));
    for k in 1..=points.len() {
        if k == points.len() || is_seam(&points[k - 1], &points[k], near) {
            (keep[start], keep[k - 1]) = (true, true);
            // A loop has no chord: its farthest point makes two.
            waiting.push((start, k - 1));
            start = k;
        }
    }
    while let Some((i, j)) = waiting.pop() {
        let far = |k: usize| distance_to_chord(points[k].point, points[i].point, points[j].point);
        let Some(worst) = (i + 1..j).max_by(|&k, &l| far(k).total_cmp(&far(l))) else { continue };
        if far(worst) > chord {
            keep[worst] = true;
            waiting.extend([(i, worst), (worst, j)]);
        }
    }
    points.iter().zip(keep).filter(|(_, keep)| *keep).map(|(point, _)| *point).collect()
}

/// How near two points are that are one, seen from either side of a seam.
fn seam_distance(points: &[MarchPoint]) -> f64 {
    let far = |p: &MarchPoint| norm(sub(p.point, points[0].point));
    let size = points.iter().map(far).fold(0.0, f64::max);
    1e-13 * size + 8.0 * f64::EPSILON * points.first().map_or(0.0, |p| norm(p.point))
}

/// The same point of space with other parameters.
fn is_seam(a: &MarchPoint, b: &MarchPoint, near: f64) -> bool {
    norm(sub(a.point, b.point)) <= near && (a.uv != b.uv || a.st != b.st)
}

/// The curves of a branch: one set between two seams. `tolerance` is what the fit aims at, a length.
///
/// # Errors
/// [`Error::InvalidArgument`] for a tolerance that is not a positive length, or a branch of a single point.
pub fn curves(
    a: &IndexedSurface,
    b: &IndexedSurface,
    points: &[MarchPoint],
    tolerance: f64,
) -> Result<Vec<BranchCurves>, Error> {
    if !tolerance.is_finite() || tolerance <= 0.0 {
        return Err(Error::InvalidArgument(format!(
            "tolerance: {tolerance} is not a positive length"
        )));
    }
    let mut all = Vec::new();
    let (mut start, near) = (0, seam_distance(points));
    for k in 1..=points.len() {
        if k == points.len() || is_seam(&points[k - 1], &points[k], near) {
            if k - start > 1 {
                all.push(run(a.surface(), b.surface(), &points[start..k], tolerance)?);
            }
            start = k;
        }
    }
    if all.is_empty() {
        return Err(Error::InvalidArgument("branch: has fewer than two points".into()));
    }
    Ok(all)
}

/// Mean lengths of the steps of the four parameters along the points.
fn scales(a: &Surface, b: &Surface, points: &[MarchPoint]) -> [f64; 4] {
    let mut sum = [0.0; 4];
    for p in points {
        let (mut x, mut y) = ([[0.0; 3]; 3], [[0.0; 3]; 3]);
        a.partials(p.uv[0], p.uv[1], 1, &mut x);
        b.partials(p.st[0], p.st[1], 1, &mut y);
        for (sum, d) in sum.iter_mut().zip([x[1], x[2], y[1], y[2]]) {
            *sum += norm(d) / points.len() as f64;
        }
    }
    sum.map(|x| x.max(1e-300))
}

fn run(
    sa: &Surface,
    sb: &Surface,
    points: &[MarchPoint],
    tolerance: f64,
) -> Result<BranchCurves, Error> {
    let scale = scales(sa, sb, points);
    let seven = |x: Vector, at: [f64; 4]| {
        [x[0], x[1], x[2], at[0] * scale[0], at[1] * scale[1], at[2] * scale[2], at[3] * scale[3]]
    };
    // Points much nearer to one another than the rest bend a cubic through them at will.
    let apart = |pair: &[MarchPoint]| norm(sub(pair[1].point, pair[0].point));
    let near = CLOSE * points.windows(2).map(apart).sum::<f64>();
    let of = |p: &MarchPoint| seven(p.point, [p.uv[0], p.uv[1], p.st[0], p.st[1]]);
    let (mut parameters, mut list) = (vec![0.0], vec![of(&points[0])]);
    let mut kept = &points[0];
    for (k, point) in points.iter().enumerate().skip(1) {
        let length = norm(sub(point.point, kept.point));
        let is_last = k + 1 == points.len();
        if is_last && length <= near && list.len() > 1 {
            list.pop();
            list.push(of(point));
        } else if length > near {
            parameters.push(parameters[parameters.len() - 1] + length);
            list.push(of(point));
            kept = point;
        }
    }
    if list.len() < 2 {
        return Err(Error::InvalidArgument("branch: has no length".into()));
    }
    // The parameter runs to a power of two: knots that halve it, and what others do with them, are exact.
    let length = parameters[parameters.len() - 1];
    let mut total = 1.0;
    while total < length {
        total *= 2.0;
    }
    while 0.5 * total >= length && total > f64::MIN_POSITIVE {
        total *= 0.5;
    }
    let count = parameters.len();
    parameters.iter_mut().for_each(|t| *t *= total / length);
    parameters[count - 1] = total;
    let base = interpolate(3.min(list.len() - 1), &parameters, &list)?.spline;
    let function = |t: f64| {
        let p = base.evaluate(t);
        let at = [p[3] / scale[0], p[4] / scale[1], p[5] / scale[2], p[6] / scale[3]];
        // Ends are what they are; places between go to the nearest point of the curve.
        if t == 0.0 || t == total {
            return Some(if t == 0.0 { list[0] } else { list[list.len() - 1] });
        }
        let found = correct(sa, sb, at, Corrector::NewtonFour, tolerance, None);
        let at = found.map_or(at, |found| found.at);
        let (x, y) = (
            sa.evaluate(clamp(sa, [at[0], at[1]])[0], clamp(sa, [at[0], at[1]])[1]),
            sb.evaluate(clamp(sb, [at[2], at[3]])[0], clamp(sb, [at[2], at[3]])[1]),
        );
        Some(seven([0, 1, 2].map(|k| 0.5 * (x[k] + y[k])), at))
    };
    // The fit aims at what it samples; what is proven of it decides.
    let mut best: Option<BranchCurves> = None;
    for share in [0.25, 0.06, 0.015] {
        let options = Adaptive { degree: 3, tolerance: share * tolerance, ..Adaptive::default() };
        let spline = of_function(function, [0.0, total], &options)?.spline;
        let knots = spline.knots().values();
        let part = |first: usize, scale: [f64; 2], surface: &Surface| {
            // Poles inside the domain keep the curve there.
            let pole = |p: &[f64; 7]| {
                let at = clamp(surface, [p[first] / scale[0], p[first + 1] / scale[1]]);
                [at[0], at[1], 0.0]
            };
            let poles: Vec<Vector> = spline.poles().iter().map(pole).collect();
            Curve::new(knots, 3, &poles, None)
        };
        let poles: Vec<Vector> = spline.poles().iter().map(|p| [p[0], p[1], p[2]]).collect();
        let space = Curve::new(knots, 3, &poles, None)?;
        let uv = part(3, [scale[0], scale[1]], sa)?;
        let st = part(5, [scale[2], scale[3]], sb)?;
        let distance = [
            deviation(&mut Composer::new(sa), &uv, &space, [0.0, total], 0.5 * tolerance)?.bound,
            deviation(&mut Composer::new(sb), &st, &space, [0.0, total], 0.5 * tolerance)?.bound,
        ];
        let error = distance[0].max(distance[1]);
        if best.as_ref().is_none_or(|best| error < best.error) {
            best = Some(BranchCurves { space, uv, st, error, distance });
        }
        if error <= tolerance {
            break;
        }
    }
    best.ok_or_else(|| Error::InvalidArgument("branch: has no curve".into()))
}

fn clamp(surface: &Surface, at: [f64; 2]) -> [f64; 2] {
    super::contact::into_domain(surface, at)
}
