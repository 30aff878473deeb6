//! The image of a pcurve in space, and its nearest point.

use super::{Face, FaceWorkspace, Place, Standing};
use crate::bounds::{Aabb, Vector, norm, scaled, sub};
use crate::closest::{QueryOptions, Within, flag};
use crate::curve::Curve;
use crate::error::Error;
use crate::index::IndexedCurve;
use crate::pcurve::Pcurve;
use crate::pcurve::compose::Composer;
use crate::pcurve::lift::{LiftOptions, lift_spline};

/// Share of the surface's diagonal within which a fitted image stays: a fifth of the accuracy of an answer.
const FITTED: f64 = 2e-11;

/// Highest degree of exact images; those of higher ones are fitted, whose search is faster.
const EXACT: usize = 9;

/// Images shorter than this share of the diagonal are a point.
const POINT: f64 = 1e-13;

/// A coedge as its image.
#[derive(Debug)]
pub(super) struct Border {
    pcurve: Curve,
    image: Image,
    /// Proven: how far the image may be from that of the pcurve.
    error: f64,
    bounds: Aabb,
    /// Loop and coedge.
    number: [usize; 2],
}

#[derive(Debug)]
enum Image {
    Curve(Box<IndexedCurve>),
    /// A collapsed edge.
    Point(Vector),
}

/// The nearest point of a border.
#[derive(Clone, Copy, Debug)]
pub(super) struct Nearest {
    /// Parameter of the pcurve; NaN when nothing is near.
    pub t: f64,
    /// Distance from the image of the pcurve there; NaN when nothing is near.
    pub distance: f64,
    /// Nothing on the border is nearer.
    pub lower_bound: f64,
    /// The gap between distance and bound that rounding may leave.
    pub allowed: f64,
    /// The bits of the search's certificate that the answer takes over.
    pub flags: u32,
    /// Evaluations.
    pub iterations: u32,
}

impl Border {
    pub fn new(
        composer: &mut Composer,
        pcurve: &Pcurve,
        number: [usize; 2],
        diagonal: f64,
    ) -> Result<Self, Error> {
        let options = LiftOptions { tolerance: FITTED * diagonal, exact_degree: EXACT };
        let spline = pcurve.as_spline()?;
        let lifted = lift_spline(composer, &spline, &options)?;
        let (low, high) = lifted.curve.bounding_box();
        let size = norm(sub(high, low));
        let (image, error) = if size <= POINT * diagonal {
            (Image::Point(lifted.curve.evaluate(lifted.curve.domain().0)), size)
        } else {
            (Image::Curve(Box::new(IndexedCurve::new(lifted.curve))), 0.0)
        };
        let error = error + lifted.deviation.bound;
        let bounds = Aabb { low, high }.grown(error);
        Ok(Self { pcurve: spline, image, error, bounds, number })
    }

    pub fn pcurve(&self) -> &Curve {
        &self.pcurve
    }

    pub fn bounds(&self) -> Aabb {
        self.bounds
    }

    pub fn error(&self) -> f64 {
        self.error
    }

    /// The place on the coedge at a parameter.
    pub fn place(&self, t: f64) -> Place {
        let [loop_index, coedge_index] = self.number.map(|k| k as u32);
        Place { standing: Standing::OnEdge, loop_index, coedge_index, reserved: 0, parameter: t }
    }

    /// Parameters of the surface at a parameter of the pcurve.
    pub fn at(&self, t: f64, [u0, u1, v0, v1]: [f64; 4]) -> [f64; 2] {
        let [u, v, _] = self.pcurve.evaluate(t);
        [u.clamp(u0, u1), v.clamp(v0, v1)]
    }

    /// The nearest point if one is as near as `limit`; `None` when the box already tells that none is.
    pub fn nearest(
        &self,
        face: &Face,
        query: Vector,
        limit: f64,
        options: &QueryOptions,
        workspace: &mut FaceWorkspace,
    ) -> Option<Nearest> {
        let far = box_distance(&self.bounds, query);
        if far > limit {
            return None;
        }
        let domain = face.shape.surface().domain();
        let here = |t: f64| face.distance(query, self.at(t, domain));
        let curve = match &self.image {
            Image::Point(point) => {
                let t = self.pcurve.domain().0;
                let lower_bound = (norm(sub(query, *point)) - self.error).max(0.0);
                let distance = here(t);
                let lower_bound = lower_bound.min(distance);
                let allowed = self.error;
                let (flags, iterations) = (0, 1);
                return Some(Nearest { t, distance, lower_bound, allowed, flags, iterations });
            }
            Image::Curve(curve) => curve,
        };
        let asked = QueryOptions {
            accuracy: face.accuracy(options),
            method: options.method,
            budget: options.budget,
            ..QueryOptions::default()
        };
        let middle = scaled(crate::bounds::add(self.bounds.low, self.bounds.high), 0.5);
        let towards = sub(middle, query);
        let length = norm(towards);
        let direction = if length > 0.0 { scaled(towards, 1.0 / length) } else { [1.0, 0.0, 0.0] };
        let within =
            limit.is_finite().then_some(Within { distance: limit + self.error, direction });
        let found = curve.closest_within(query, None, within, &asked, &mut workspace.shape);
        let lower_bound = (found.foot.lower_bound - self.error).max(0.0);
        let (t, distance) = if found.foot.distance.is_nan() {
            (f64::NAN, f64::NAN)
        } else {
            (found.foot.u, here(found.foot.u))
        };
        let flags = found.foot.flags & (flag::TIE | flag::CONTINUUM | flag::BUDGET);
        let lower_bound = if distance < lower_bound { distance } else { lower_bound };
        let (allowed, iterations) = (found.allowed, found.foot.iterations);
        Some(Nearest { t, distance, lower_bound, allowed, flags, iterations })
    }
}

/// Distance to a box, a little less for rounding.
pub(super) fn box_distance(bounds: &Aabb, query: Vector) -> f64 {
    let beside = |k: usize| (bounds.low[k] - query[k]).max(query[k] - bounds.high[k]).max(0.0);
    norm([0, 1, 2].map(beside)) * (1.0 - 1e-15)
}
