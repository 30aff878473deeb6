//! Curves from branches: fewer points, and B-splines in space and in both parameter planes with one parameter.
//!
//! ```text
//!   points -> a cubic through them in (x, y, z, u, v, s, t) -> each of its places corrected onto both surfaces -> a spline of seven
//!             coordinates near that function -> split into C(t), (u, v)(t), (s, t)(t) on the same knots
//! ```
//!
//! A branch is cut where it has a corner, in space or in a domain: over a seam, over a knot line where a surface is not smooth, in the
//! corners of an overlap. Where the fit misses its tolerance and the chords of the points are nearer, the chords are the curve.
//!
//! The error is proven on the result (`pcurve::deviation`): C(t) - A(u(t), v(t)) and C(t) - B(s(t), t(t)) as polynomials, bounded by their
//! coefficients. Parameters count in the fit as the lengths that they move.

use super::MarchPoint;
use super::corners::corners;
use super::correct::{Corrector, correct};
use super::join::distance_to_chord;
use super::watch::Watch;
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

/// Most poles of a fit for each point: a smooth branch takes less than one.
const POLES_A_POINT: usize = 16;

/// A branch, or the part of it between two seams or corners, as curves with a common parameter.
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

/// The curves of a branch: one set between two seams or corners. `tolerance` is what the fit aims at, a length; where it is missed,
/// [`BranchCurves::error`] says so, and is not more than that of the chords between the points. `poll(points done, points left
/// of this part)` is asked now and then whether to stop.
///
/// # Errors
/// [`Error::InvalidArgument`] for a tolerance that is not a positive length, or a branch of a single point; [`Error::Cancelled`].
pub fn curves(
    a: &IndexedSurface,
    b: &IndexedSurface,
    points: &[MarchPoint],
    tolerance: f64,
    poll: &mut dyn FnMut(u64, u64) -> bool,
) -> Result<Vec<BranchCurves>, Error> {
    if !tolerance.is_finite() || tolerance <= 0.0 {
        return Err(Error::InvalidArgument(format!(
            "tolerance: {tolerance} is not a positive length"
        )));
    }
    let watch = Watch::new(poll);
    let (a, b) = (a.surface(), b.surface());
    let mut all = Vec::new();
    let (mut start, near) = (0, seam_distance(points));
    for k in 1..=points.len() {
        if k == points.len() || is_seam(&points[k - 1], &points[k], near) {
            if k - start > 1 {
                let points = &points[start..k];
                let mut from = 0;
                for to in corners(a, b, points).into_iter().chain([points.len() - 1]) {
                    watch.asks((start + from) as u64, (points.len() - from) as u64);
                    watch.checked()?;
                    all.push(run(a, b, &points[from..=to], tolerance, &watch)?);
                    from = to;
                }
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

/// A part of a branch without corners, ready for a fit: coordinates x, y, z, and u, v, s, t as the lengths that they move.
struct Run<'a> {
    surfaces: [&'a Surface; 2],
    scale: [f64; 4],
    parameters: Vec<f64>,
    list: Vec<[f64; 7]>,
    tolerance: f64,
}

fn run(
    sa: &Surface,
    sb: &Surface,
    points: &[MarchPoint],
    tolerance: f64,
    watch: &Watch,
) -> Result<BranchCurves, Error> {
    let run = Run::new([sa, sb], points, tolerance)?;
    let mut best = run.fitted(watch)?;
    if best.as_ref().is_none_or(|best| best.error > tolerance) {
        watch.checked()?;
        let chords = run.chords()?;
        if best.as_ref().is_none_or(|best| chords.error < best.error) {
            best = Some(chords);
        }
    }
    best.ok_or_else(|| Error::InvalidArgument("branch: has no curve".into()))
}

impl<'a> Run<'a> {
    fn new(
        surfaces: [&'a Surface; 2],
        points: &[MarchPoint],
        tolerance: f64,
    ) -> Result<Self, Error> {
        let scale = scales(surfaces[0], surfaces[1], points);
        let seven = |p: &MarchPoint| {
            let ([x, y, z], [u, v], [s, t]) = (p.point, p.uv, p.st);
            [x, y, z, u * scale[0], v * scale[1], s * scale[2], t * scale[3]]
        };
        // Points much nearer to one another than the rest bend a cubic through them at will.
        let apart = |pair: &[MarchPoint]| norm(sub(pair[1].point, pair[0].point));
        let near = CLOSE * points.windows(2).map(apart).sum::<f64>();
        let (mut parameters, mut list) = (vec![0.0], vec![seven(&points[0])]);
        let mut kept = &points[0];
        for (k, point) in points.iter().enumerate().skip(1) {
            let length = norm(sub(point.point, kept.point));
            let is_last = k + 1 == points.len();
            if is_last && length <= near && list.len() > 1 {
                list.pop();
                list.push(seven(point));
            } else if length > near {
                parameters.push(parameters[parameters.len() - 1] + length);
                list.push(seven(point));
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
        Ok(Self { surfaces, scale, parameters, list, tolerance })
    }

    fn total(&self) -> f64 {
        self.parameters[self.parameters.len() - 1]
    }

    /// The place of a point of seven coordinates.
    fn place(&self, p: &[f64; 7]) -> [f64; 4] {
        [0, 1, 2, 3].map(|k| p[k + 3] / self.scale[k])
    }

    /// Both surfaces at a place of their domains, in the middle.
    fn seven(&self, at: [f64; 4]) -> [f64; 7] {
        let ([a, b], scale) = (self.surfaces, self.scale);
        let ([u, v], [s, t]) = (clamp(a, [at[0], at[1]]), clamp(b, [at[2], at[3]]));
        let (x, y) = (a.evaluate(u, v), b.evaluate(s, t));
        let [x, y, z] = [0, 1, 2].map(|k| 0.5 * (x[k] + y[k]));
        [x, y, z, u * scale[0], v * scale[1], s * scale[2], t * scale[3]]
    }

    /// Splines near the branch, the best of those that were tried.
    fn fitted(&self, watch: &Watch) -> Result<Option<BranchCurves>, Error> {
        let ([sa, sb], tolerance, total) = (self.surfaces, self.tolerance, self.total());
        let list = &self.list;
        let base = interpolate(3.min(list.len() - 1), &self.parameters, list)?.spline;
        let function = |t: f64| {
            if watch.stops(list.len()) {
                return None;
            }
            // Ends are what they are; places between go to the nearest point of the curve.
            if t == 0.0 || t == total {
                return Some(if t == 0.0 { list[0] } else { list[list.len() - 1] });
            }
            let p = base.evaluate(t);
            let guess = self.place(&p);
            let near = self.seven(guess);
            let far = |x: &[f64; 7], y: &[f64; 7]| norm([x[0] - y[0], x[1] - y[1], x[2] - y[2]]);
            // The base is much nearer to the curve than its points are apart: what is farther away is another curve, or where an
            // iteration strayed along coincident surfaces.
            let k = self.parameters.partition_point(|&p| p <= t).clamp(1, list.len() - 1);
            let room = 0.25 * far(&list[k - 1], &list[k]);
            let found = correct(sa, sb, guess, Corrector::NewtonFour, tolerance, None);
            let found = found.map(|found| self.seven(found.at));
            Some(found.filter(|found| far(found, &near) <= room).unwrap_or(near))
        };
        // The fit aims at what it samples; what is proven of it decides.
        let mut best: Option<BranchCurves> = None;
        for share in [0.25, 0.06, 0.015] {
            let options = Adaptive {
                degree: 3,
                tolerance: share * tolerance,
                max_poles: (POLES_A_POINT * list.len() + 64).min(4096),
                ..Adaptive::default()
            };
            let spline = of_function(function, [0.0, total], &options);
            watch.checked()?;
            let fit = spline?;
            let (spline, misses) = (fit.spline, fit.worst > share * tolerance);
            let made = self.curves(spline.knots().values(), spline.poles())?;
            let error = made.error;
            if best.as_ref().is_none_or(|best| error < best.error) {
                best = Some(made);
            }
            // What the poles did not suffice for they will not for less.
            if error <= tolerance || misses {
                break;
            }
        }
        Ok(best)
    }

    /// The chords of the points, as cubics.
    fn chords(&self) -> Result<BranchCurves, Error> {
        let (list, total) = (&self.list, self.total());
        let mut poles = vec![list[0]];
        for pair in list.windows(2) {
            let at = |k: usize| {
                std::array::from_fn(|c| pair[0][c] + (pair[1][c] - pair[0][c]) * k as f64 / 3.0)
            };
            poles.extend([at(1), at(2), pair[1]]);
        }
        let mut knots = vec![0.0];
        knots.extend(self.parameters.iter().flat_map(|&t| [t; 3]));
        knots.push(total);
        self.curves(&knots, &poles)
    }

    /// A cubic of seven coordinates as curves in space and in both domains, with what is proven of it.
    fn curves(&self, knots: &[f64], poles: &[[f64; 7]]) -> Result<BranchCurves, Error> {
        let ([sa, sb], total, scale) = (self.surfaces, self.total(), self.scale);
        let part = |first: usize, scale: [f64; 2], surface: &Surface| {
            // Poles inside the domain keep the curve there.
            let pole = |p: &[f64; 7]| {
                let at = clamp(surface, [p[first] / scale[0], p[first + 1] / scale[1]]);
                [at[0], at[1], 0.0]
            };
            let poles: Vec<Vector> = poles.iter().map(pole).collect();
            Curve::new(knots, 3, &poles, None)
        };
        let places: Vec<Vector> = poles.iter().map(|p| [p[0], p[1], p[2]]).collect();
        let space = Curve::new(knots, 3, &places, None)?;
        let uv = part(3, [scale[0], scale[1]], sa)?;
        let st = part(5, [scale[2], scale[3]], sb)?;
        let sharp = 0.5 * self.tolerance;
        let distance = [
            deviation(&mut Composer::new(sa), &uv, &space, [0.0, total], sharp)?.bound,
            deviation(&mut Composer::new(sb), &st, &space, [0.0, total], sharp)?.bound,
        ];
        let error = distance[0].max(distance[1]);
        Ok(BranchCurves { space, uv, st, error, distance })
    }
}

fn clamp(surface: &Surface, at: [f64; 2]) -> [f64; 2] {
    super::contact::into_domain(surface, at)
}
