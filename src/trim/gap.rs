//! How far coedges are from their edges: at samples, and with proof between them.
//!
//! ```text
//!   same parameter     |S(p(t)) - C(t)| by Bernstein coefficients
//!   other parameters   |S(p(t)) - C(e(t))| with a spline e near the parameters of the feet, from end to end of the edge: no point of
//!                      either is farther from the other curve, whatever e is
//! ```
//!
//! Curves and surfaces given by functions have no bound.

use super::imager::Imager;
use super::speed::curve_speed;
use super::{Coedge, Edge, EdgeCurve, Support, TrimmedSurface, norm, sub};
use crate::bounds::Vector;
use crate::closest::{QueryOptions, Workspace};
use crate::curve::Curve;
use crate::error::Error;
use crate::fit::{Adaptive, of_function};
use crate::index::IndexedCurve;
use crate::pcurve::compose::Composer;
use crate::pcurve::lift::over;
use crate::pcurve::{Pcurve, reversed_curve};
use crate::surface::Surface;
use crate::transform::between;
use std::cell::RefCell;

/// Places on each coedge at which its edge is compared.
pub const GAP_SAMPLES: usize = 33;

/// Places from which the parameters of feet go on, and the degree of the spline through them.
const TABLE: usize = 64;
const DEGREE: usize = 5;

/// Share of the tolerance that the parameters of feet may miss along the edge.
const ALONG: f64 = 0.05;

/// What is compared.
pub(super) struct Gaps<'a> {
    face: &'a TrimmedSurface,
    imager: Option<Imager<'a>>,
    tolerance: f64,
    workspace: Workspace,
}

impl<'a> Gaps<'a> {
    pub fn new(face: &'a TrimmedSurface, tolerance: f64) -> Result<Self, Error> {
        let imager = Imager::of(face.support())?;
        Ok(Self { face, imager, tolerance, workspace: Workspace::default() })
    }

    /// The largest gap at samples and corners, and its parameter; the gap is NaN where a function fails.
    pub fn measured(&mut self, coedge: &Coedge, edge: &Edge) -> (f64, f64) {
        let (a, b) = coedge.pcurve.domain();
        let mut shares: Vec<f64> =
            (0..GAP_SAMPLES).map(|k| k as f64 / (GAP_SAMPLES - 1) as f64).collect();
        shares.extend(coedge.pcurve.breaks().iter().map(|t| (t - a) / (b - a)));
        let mut worst = (0.0f64, a);
        for share in shares {
            let point = self.face.coedge_point(coedge, share);
            let parameter = coedge.pcurve.parameter_at(share);
            let gap = if coedge.same_parameter || share == 0.0 || share == 1.0 {
                let there = self.face.edge_point(coedge, share);
                norm(sub(point, there.unwrap_or([f64::NAN; 3])))
            } else {
                self.away(&edge.curve, point)
            };
            if gap.is_nan() {
                return (gap, parameter);
            }
            if gap > worst.0 {
                worst = (gap, parameter);
            }
        }
        worst
    }

    /// Distance of a point from a curve.
    fn away(&mut self, curve: &EdgeCurve, point: Vector) -> f64 {
        let options = QueryOptions::default();
        match curve {
            EdgeCurve::Spline(curve) => {
                curve.closest(point, None, &options, &mut self.workspace, None).distance
            }
            EdgeCurve::Callback(curve) => curve.closest(point, None, &options, None).distance,
            EdgeCurve::Point(there) => norm(sub(point, *there)),
        }
    }

    /// A bound of the distance of image and edge: at equal parameters where they have the same, else of the point sets; infinite
    /// where none can be had.
    ///
    /// # Errors
    /// Memory that could not be had.
    pub fn bound(&mut self, coedge: &Coedge, edge: &Edge) -> Result<f64, Error> {
        let Some(imager) = &self.imager else { return Ok(f64::INFINITY) };
        let drawn = imager.drawn(&coedge.pcurve)?;
        let (a, b) = drawn.spline.domain();
        let along = coedge.reversed == edge.reversed;
        let other = match &edge.curve {
            EdgeCurve::Callback(_) => return Ok(f64::INFINITY),
            EdgeCurve::Point(point) => Curve::new(&[a, a, b, b], 1, &[*point; 2], None)?,
            EdgeCurve::Spline(curve) if coedge.same_parameter => {
                let turned =
                    if along { curve.curve().clone() } else { reversed_curve(curve.curve()) };
                over(&turned, [a, b])?
            }
            EdgeCurve::Spline(curve) => {
                let (support, pcurve) = (self.face.support(), &coedge.pcurve);
                let Some(imager) = &mut self.imager else { return Ok(f64::INFINITY) };
                let found = off_indexed(imager, support, pcurve, curve, along, self.tolerance)?;
                return Ok(found.unwrap_or(f64::INFINITY));
            }
        };
        let imager = self.imager.as_mut();
        let found = imager.and_then(|imager| imager.off(&drawn, &other, self.tolerance));
        Ok(found.unwrap_or(f64::INFINITY))
    }
}

/// A bound of the distance of the image of a curve of the domain and a curve in space, as sets of points; `along`: whether they run the
/// same way.
///
/// # Errors
/// Memory that could not be had.
pub(super) fn off_curve(
    imager: &mut Imager,
    support: &Support,
    pcurve: &Pcurve,
    curve: &Curve,
    along: bool,
    tolerance: f64,
) -> Result<Option<f64>, Error> {
    let indexed = IndexedCurve::new(curve.clone());
    off_indexed(imager, support, pcurve, &indexed, along, tolerance)
}

fn off_indexed(
    imager: &mut Imager,
    support: &Support,
    pcurve: &Pcurve,
    curve: &IndexedCurve,
    along: bool,
    tolerance: f64,
) -> Result<Option<f64>, Error> {
    let Some(feet) = feet(support, pcurve, curve, along, tolerance)? else { return Ok(None) };
    let (drawn, strip) = (imager.drawn(pcurve)?, strip(curve.curve())?);
    Ok(imager.off_along(&drawn, &mut Composer::new(&strip), &feet, tolerance))
}

/// A curve (e, 0, 0) over the domain of a pcurve: near the parameters of the points of `curve` that are nearest to its image, from one
/// end of that to the other.
fn feet(
    support: &Support,
    pcurve: &Pcurve,
    curve: &IndexedCurve,
    along: bool,
    tolerance: f64,
) -> Result<Option<Curve>, Error> {
    let (low, high) = curve.curve().domain();
    let ends = if along { [low, high] } else { [high, low] };
    let (a, b) = pcurve.domain();
    let closed = curve.curve().is_closed();
    let workspace = RefCell::new(Workspace::default());
    // The foot at a parameter, on the turn that is nearest to what is expected.
    let foot = |t: f64, expected: f64| -> f64 {
        let query = support.evaluate(pcurve.evaluate(t));
        let (options, workspace) = (QueryOptions::default(), &mut *workspace.borrow_mut());
        let found = curve.closest(query, None, &options, workspace, None).u;
        let turns = if closed { ((expected - found) / (high - low)).round() } else { 0.0 };
        found + turns * (high - low)
    };
    let mut table = vec![ends[0]];
    for k in 1..TABLE {
        let step = if k > 1 { table[k - 1] - table[k - 2] } else { 0.0 };
        table.push(foot(between(a, b, k as f64 / TABLE as f64), table[k - 1] + step));
    }
    table.push(ends[1]);
    let function = |t: f64| {
        let share = ((t - a) / (b - a) * TABLE as f64).clamp(0.0, TABLE as f64);
        let k = (share as usize).min(TABLE - 1);
        let expected = table[k] + (share - k as f64) * (table[k + 1] - table[k]);
        let e = if t <= a {
            ends[0]
        } else if t >= b {
            ends[1]
        } else {
            foot(t, expected)
        };
        e.is_finite().then_some([e])
    };
    let breaks: Vec<(f64, usize)> = pcurve.breaks().into_iter().map(|t| (t, DEGREE)).collect();
    let tolerance = ALONG * tolerance / curve_speed(curve.curve());
    let tolerance = tolerance.max(f64::EPSILON * (high - low));
    let options = Adaptive { degree: DEGREE, tolerance, breaks: &breaks, ..Adaptive::default() };
    let Ok(fit) = of_function(function, [a, b], &options) else { return Ok(None) };
    let poles = fit.spline.poles().iter().map(|[e]| [e.clamp(low, high), 0.0, 0.0]);
    let poles: Vec<Vector> = poles.collect();
    Curve::new(fit.spline.knots().values(), DEGREE, &poles, None).map(Some)
}

/// A curve as a surface that is the same for every v.
fn strip(curve: &Curve) -> Result<Surface, Error> {
    let twice = |poles: &[Vector]| poles.iter().flat_map(|p| [*p; 2]).collect::<Vec<_>>();
    let weights: Option<Vec<f64>> =
        curve.weights().map(|weights| weights.iter().flat_map(|w| [*w; 2]).collect());
    let (poles, count) = (twice(curve.poles()), curve.poles().len());
    let (u, v) = (curve.knots().values(), [0.0, 0.0, 1.0, 1.0]);
    Surface::new(u, &v, curve.degree(), 1, &poles, count, 2, weights.as_deref())
}
