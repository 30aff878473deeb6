//! Offsets: exactly, as shapes given by a function, and as splines with a proven error.
//!
//! ```text
//!   surface  S + d n,   n = m / |m|,   m = S_u x S_v        derivatives by  n_x = (m_x - n (n . m_x)) / |m|, and again
//!   curve    C + d n,   m = C' x V     V: the normal of the plane; n is on the right, seen from the tip of V
//! ```
//!
//! The spline is fitted adaptively, with breaks where the shape's normal is less smooth than it; [`super::offset_proof`] proves how far it is
//! from the exact offset at equal parameters.
//!
//! Reference: Piegl, Tiller, *Computing offsets of NURBS curves and surfaces*, Computer-Aided Design 31, 1999.
//! Limit: loops and cusps where the offset folds are not removed; folds are not told.

use super::offset_proof::{curve_error, surface_error};
use super::{check_number, check_positive, check_vector, gap, invalid};
use crate::bounds::{Vector, add, cross, dot, norm, scaled, sub};
use crate::callback::{CallbackCurve, CallbackSurface, CurveBounds, SurfaceBounds};
use crate::closest::FootPoint;
use crate::curve::Curve;
use crate::error::Error;
use crate::fit::{Adaptive, Grid, GridOptions, adaptive_grid, of_function};
use crate::knots::{Knots, MAX_DEGREE, Side};
use crate::normal::Normals;
use crate::surface::Surface;

/// An offset as a spline.
#[derive(Clone, Debug, PartialEq)]
pub struct OffsetFit<S> {
    /// Over the domain of the given shape.
    pub shape: S,
    /// The greatest distance from the exact offset at equal parameters, at the samples.
    pub measured: f64,
    /// No point is farther than this from the exact offset at its parameters; infinite when that could not be proven.
    pub proven: f64,
}

/// Greatest change of a unit normal that is rounding.
const JUMP: f64 = 1e-9;

/// How many times the samples of a span are doubled.
const ROUNDS: usize = 4;

/// Most samples of a surface beyond the first round.
const MOST_SAMPLES: usize = 4_000_000;

/// `m / |m|` and its derivatives from those of m: n, n_u, n_v, n_uu, n_uv, n_vv. Nothing where m vanishes.
fn unit_jet(m: &[Vector; 6]) -> Option<[Vector; 6]> {
    let length = norm(m[0]);
    if length.is_nan() || length <= 0.0 {
        return None;
    }
    let n = scaled(m[0], 1.0 / length);
    let slope = |k: usize| dot(n, m[k]);
    let first = |k: usize| scaled(sub(m[k], scaled(n, slope(k))), 1.0 / length);
    let (nu, nv) = (first(1), first(2));
    let second = |a: usize, b: usize, ab: usize| {
        let (na, nb) = ([n, nu, nv][a], [n, nu, nv][b]);
        let bent = dot(nb, m[a]) + dot(n, m[ab]);
        let rest = add(add(scaled(nb, slope(a)), scaled(na, slope(b))), scaled(n, bent));
        scaled(sub(m[ab], rest), 1.0 / length)
    };
    Some([n, nu, nv, second(1, 1, 3), second(1, 2, 4), second(2, 2, 5)])
}

/// The partial derivatives of `S_u x S_v`, from S's to order 3.
fn normal_jet(s: &[Vector; 10]) -> [Vector; 6] {
    let [_, u, v, uu, uv, vv, uuu, uuv, uvv, vvv] = *s;
    let sum = |a: Vector, b: Vector| add(a, b);
    [
        cross(u, v),
        sum(cross(uu, v), cross(u, uv)),
        sum(cross(uv, v), cross(u, vv)),
        sum(sum(cross(uuu, v), scaled(cross(uu, uv), 2.0)), cross(u, uuv)),
        sum(sum(cross(uuv, v), cross(uu, vv)), cross(u, uvv)),
        sum(sum(cross(uvv, v), scaled(cross(uv, vv), 2.0)), cross(u, vvv)),
    ]
}

/// The surface at a distance along its normal (negative: against it), by a function with derivatives to order 2. Where `S_u x S_v`
/// vanishes the function fails.
///
/// # Errors
/// A distance that is not finite.
pub fn offset_surface(
    surface: &Surface,
    distance: f64,
    bounds: SurfaceBounds,
) -> Result<CallbackSurface, Error> {
    check_number("distance", distance)?;
    let (base, domain) = (surface.clone(), surface.domain());
    CallbackSurface::new(domain, bounds, move |u, v, order, out| {
        let mut s = [[0.0; 3]; 10];
        let count = order.min(2) + 1;
        base.partials(u, v, count, &mut s[..(count + 1) * (count + 2) / 2]);
        let normal = unit_jet(&normal_jet(&s))?;
        for k in 0..count * (count + 1) / 2 {
            out[k] = add(s[k], scaled(normal[k], distance));
        }
        Some(count - 1)
    })
}

/// The curve at a distance to the right of its direction, seen from the tip of `plane_normal` (any length); negative: to the left. Where
/// the tangent vanishes or is the normal the function fails.
///
/// # Errors
/// Numbers that are not finite; a normal that is 0.
pub fn offset_curve(
    curve: &Curve,
    distance: f64,
    plane_normal: Vector,
    bounds: CurveBounds,
) -> Result<CallbackCurve, Error> {
    let up = unit_normal(plane_normal)?;
    check_number("distance", distance)?;
    let (base, (start, end)) = (curve.clone(), curve.domain());
    CallbackCurve::new([start, end], bounds, move |u, order, out| {
        let mut c = [[0.0; 3]; 4];
        let count = order.min(2) + 1;
        base.derivatives(u, count, &mut c[..=count]);
        let m = [c[1], c[2], [0.0; 3], c[3], [0.0; 3], [0.0; 3]].map(|x| cross(x, up));
        let normal = unit_jet(&m)?;
        for (k, entry) in [0, 1, 3].into_iter().enumerate().take(count) {
            out[k] = add(c[k], scaled(normal[entry], distance));
        }
        Some(count - 1)
    })
}

fn unit_normal(normal: Vector) -> Result<Vector, Error> {
    check_vector("plane_normal", normal)?;
    let length = norm(normal);
    if length == 0.0 {
        return invalid("plane_normal: is 0".into());
    }
    Ok(scaled(normal, 1.0 / length))
}

/// Inner knots, and multiplicities with which a fit of some degree is no smoother than the normal. `jump` is the greatest change of the
/// normal at a knot where the shape need not have a tangent.
fn breaks(
    knots: &Knots,
    degree: usize,
    name: &str,
    jump: impl Fn(f64) -> f64,
) -> Result<Vec<(f64, usize)>, Error> {
    let (start, end) = knots.domain();
    let mut out: Vec<(f64, usize)> = Vec::new();
    for &u in knots.values().iter().filter(|u| start < **u && **u < end) {
        if out.last().is_some_and(|last| last.0 == u) {
            continue;
        }
        let times = knots.multiplicity(u);
        if times >= knots.degree() && jump(u) > JUMP {
            return Err(Error::Unsupported(format!("{name}: its normal jumps at the knot {u}")));
        }
        let smooth = knots.degree().saturating_sub(times + 1);
        out.push((u, degree.saturating_sub(smooth).clamp(1, degree)));
    }
    Ok(out)
}

/// The greatest change of the normal across a knot line, at samples along it; 0 where there is none.
fn jump(surface: &Surface, direction: usize, at: f64) -> f64 {
    let along = [surface.knots_v(), surface.knots_u()][direction];
    let normal = |t: f64, side: Side| {
        let mut s = [[0.0; 3]; 3];
        let (place, sides) = match direction {
            0 => ([at, t], [side, Side::Above]),
            _ => ([t, at], [Side::Above, side]),
        };
        surface.partials_on(place, sides, 1, &mut s);
        let m = cross(s[1], s[2]);
        let length = norm(m);
        if length > 0.0 { scaled(m, 1.0 / length) } else { m }
    };
    let change = |t: f64| {
        let (below, above) = (normal(t, Side::Below), normal(t, Side::Above));
        if norm(below) * norm(above) == 0.0 { 0.0 } else { gap(below, above) }
    };
    sampled(along, 8).into_iter().map(change).fold(0.0, f64::max)
}

fn check_fit(distance: f64, degree: usize, tolerance: f64) -> Result<(), Error> {
    check_number("distance", distance)?;
    check_positive("tolerance", tolerance)?;
    if degree == 0 || degree > MAX_DEGREE {
        return invalid(format!("degree: {degree} given, 1 to {MAX_DEGREE} accepted"));
    }
    Ok(())
}

/// A spline of some degree at a distance to the right of a curve, as [`offset_curve`]. Beyond the tolerance in [`OffsetFit::proven`] means:
/// not reached, or not proven. The proof needs a curve in a plane across the normal, or nearly so.
///
/// # Errors
/// Numbers that are not allowed, by name; knots at which the normal may jump, places without one ([`Error::Unsupported`], with the
/// parameter).
pub fn offset_curve_fit(
    curve: &Curve,
    distance: f64,
    plane_normal: Vector,
    degree: usize,
    tolerance: f64,
) -> Result<OffsetFit<Curve>, Error> {
    check_fit(distance, degree, tolerance)?;
    let up = unit_normal(plane_normal)?;
    let curve = curve.clamp()?;
    let (start, end) = curve.domain();
    let breaks = breaks(curve.knots(), degree, "curve", |u| {
        let side = |side: Side| {
            let mut c = [[0.0; 3]; 2];
            curve.derivatives_on(u, side, 1, &mut c);
            scaled(c[1], 1.0 / norm(c[1]))
        };
        gap(side(Side::Below), side(Side::Above))
    })?;
    let exact = |u: f64| {
        let mut c = [[0.0; 3]; 2];
        curve.derivatives(u, 1, &mut c);
        let m = cross(c[1], up);
        let length = norm(m);
        (length > 0.0).then(|| add(c[0], scaled(m, distance / length)))
    };
    let mut share = 0.5;
    let mut best: Option<OffsetFit<Curve>> = None;
    for _ in 0..ROUNDS {
        let wanted = Adaptive {
            degree,
            tolerance: share * tolerance,
            breaks: &breaks,
            ..Adaptive::default()
        };
        let fit = of_function(exact, [start, end], &wanted)?;
        let shape = fit.spline.curve()?;
        let proven = curve_error(&curve, &shape, distance, up, tolerance)?;
        let reached = proven <= tolerance;
        if best.as_ref().is_none_or(|best| proven < best.proven) {
            best = Some(OffsetFit { shape, measured: fit.worst, proven });
        }
        if reached {
            break;
        }
        share *= 0.25;
    }
    best.ok_or(Error::OutOfMemory)
}

/// A spline surface at a distance along the normal, as [`offset_surface`]; at collapsed edges the normal is its limit. Beyond the tolerance in
/// [`OffsetFit::proven`] means: not reached, or not proven (a collapsed edge never is; look at `measured` then).
///
/// # Errors
/// As [`offset_curve_fit`].
pub fn offset_surface_fit(
    surface: &Surface,
    distance: f64,
    degrees: [usize; 2],
    tolerance: f64,
) -> Result<OffsetFit<Surface>, Error> {
    check_fit(distance, degrees[0], tolerance)?;
    check_fit(distance, degrees[1], tolerance)?;
    let surface = surface.clamp()?;
    let breaks = [
        breaks(surface.knots_u(), degrees[0], "surface", |u| jump(&surface, 0, u))?,
        breaks(surface.knots_v(), degrees[1], "surface", |v| jump(&surface, 1, v))?,
    ];
    let normals = Normals::new(&surface);
    let exact = |u: f64, v: f64| -> Result<Vector, Error> {
        let mut s = [[0.0; 3]; 3];
        surface.partials(u, v, 1, &mut s);
        let m = cross(s[1], s[2]);
        let length = norm(m);
        let normal = if length > 1e-9 * dot(s[1], s[1]).max(dot(s[2], s[2])) {
            scaled(m, 1.0 / length)
        } else {
            normals.at(&FootPoint { u, v, point: s[0], ..FootPoint::unreached() }, None).normal
        };
        if normal[0].is_nan() {
            return Err(Error::Unsupported(format!("surface: it has no normal at ({u}, {v})")));
        }
        Ok(add(s[0], scaled(normal, distance)))
    };
    let (mut share, mut per_span) = (0.5, degrees.map(|degree| 3 * (degree + 1)));
    let mut best: Option<OffsetFit<Surface>> = None;
    for round in 1..=ROUNDS {
        let lists =
            [sampled(surface.knots_u(), per_span[0]), sampled(surface.knots_v(), per_span[1])];
        let count = lists[0].len().saturating_mul(lists[1].len());
        if count > MOST_SAMPLES && best.is_some() {
            break;
        }
        let mut points = Vec::new();
        points.try_reserve_exact(count).map_err(|_| Error::OutOfMemory)?;
        for &u in &lists[0] {
            for &v in &lists[1] {
                points.push(exact(u, v)?);
            }
        }
        let grid = Grid::new(&points, lists[0].len(), lists[1].len())?;
        let wanted = GridOptions {
            degrees,
            tolerance: share * tolerance,
            breaks: [&breaks[0], &breaks[1]],
            ..GridOptions::default()
        };
        let fit = adaptive_grid([&lists[0], &lists[1]], &grid, &wanted)?;
        // Halfway between the samples, where the fit has not looked.
        let mut measured = fit.worst;
        let middle =
            |list: &[f64]| list.windows(2).map(|w| 0.5 * w[0] + 0.5 * w[1]).collect::<Vec<_>>();
        let (middle_u, middle_v) = (middle(&lists[0]), middle(&lists[1]));
        for &u in &middle_u {
            for &v in &middle_v {
                measured = measured.max(gap(exact(u, v)?, fit.surface.evaluate(u, v)));
            }
        }
        // What misses its samples is not worth a proof, unless nothing better comes.
        let worth = measured <= tolerance || round == ROUNDS;
        let proven = if worth {
            surface_error(&surface, &fit.surface, distance, tolerance)?
        } else {
            f64::INFINITY
        };
        let reached = proven <= tolerance;
        let better = |best: &OffsetFit<Surface>| {
            proven < best.proven || (proven == best.proven && measured < best.measured)
        };
        if best.as_ref().is_none_or(better) {
            best = Some(OffsetFit { shape: fit.surface, measured, proven });
        }
        if reached || (worth && proven.is_infinite()) {
            break;
        }
        share *= 0.5;
        per_span = per_span.map(|count| 2 * count);
    }
    best.ok_or(Error::OutOfMemory)
}

/// `count` even steps in every span.
fn sampled(knots: &Knots, count: usize) -> Vec<f64> {
    let values = knots.values();
    let mut list = vec![knots.domain().0];
    for span in knots.spans() {
        let [a, b] = [values[span], values[span + 1]];
        list.extend((1..count).map(|i| a + (b - a) * (i as f64 / count as f64)));
        list.push(b);
    }
    list
}
