//! Curves and surfaces given by a function: offsets, Coons patches, shapes of other kernels.
//!
//! A shape is a function that gives the point at a parameter, with derivatives up to order 2 if it has them; what it
//! does not give is taken from finite differences (`source`). It is all that is known about the shape, so a proof
//! needs one thing more: bounds of the derivatives, vouched for by the caller.
//!
//! ```text
//!   bounds given         every parameter box gets a proven interval of distances   -> branch and bound, proven
//!   no bounds            the same search with bounds estimated from samples        -> found, never proven
//! ```
//!
//! The inequalities, on a box with centre c and half widths h, k; `r = S(c) - q` for the query q, `|S_u| <= L_u`,
//! `|S_uu| <= M_uu` and so on:
//!
//! ```text
//!   Lipschitz   |S - q| >= |r| - L_u h - L_v k
//!   tangents    S = S(c) + a S_u(c) + b S_v(c) + e,  |e| <= R = (M_uu h^2 + 2 M_uv h k + M_vv k^2) / 2   (Taylor), so
//!               |S - q| >= n.r - |n.S_u| h - |n.S_v| k - R for every unit vector n; the best n points to the
//!               nearest point of the tangent parallelogram, and any other n is only less sharp
//!   speeds      |S_u| <= |S_u(c)| + M_uu h + M_uv k, and at least the same with minus signs: intervals of E, G
//!   slopes      with f = |S - q|^2 / 2:  f_u = r.S_u,  f_uu = |S_u|^2 + r.S_uu,  f_uv = S_u.S_v + r.S_uv, so f_u varies
//!               by at most (E + |r| M_uu) h + (|F| + |r| M_uv) k: where |f_u(c)| is more, f_u keeps its sign; no
//!               nearest point then lies in the box, unless on the border that f_u presses against
//!   convexity   f_uu >= E - |r| M_uu = A,  f_vv >= G - |r| M_vv = C,  |f_uv| <= |F| + |r| M_uv = B; where A > 0, C > 0
//!               and A C > B^2, f is convex with curvature at least l = (A C - B^2) / (A + C): a place with
//!               gradient g then is within |g|^2 / (2 l) of the box's minimum of f, and within |g| / l of where it is
//! ```
//!
//! Convexity closes the box that holds a near foot at once, because the local iteration makes g tiny; the slopes shrink
//! all others at a constant number of boxes a level.
//!
//! Trusted, and documented for callers: the bounds; that the function is as smooth as they say; that its points are
//! accurate to [`POINT_ULPS`] ulps of the largest coordinate of the shape, its derivatives to as many ulps of
//! themselves and of that coordinate over the width of the domain. A function that is called from several threads
//! must allow it, must give the same numbers for the same parameters, and must not panic.
//!
//! References: Piyavskii, *An algorithm for finding the absolute extremum of a function*, 1972 (Lipschitz bounds);
//! Hansen, Walster, *Global optimization using interval analysis*, 2004 (monotonicity, convexity).
//! Limits: Lipschitz bounds alone prove points on the shape quickly and distances off the shape only roughly: the gap
//! shrinks with the number of boxes, not with its square. Creases are not recognised.

mod source;

mod cell;

mod foot;

mod nature;

mod search;

mod cluster;

mod preimage;

mod extrema;

use crate::bounds::{Aabb, Vector};
use crate::closest::{FootPoint, QueryOptions, Trace};
use crate::error::Error;
use crate::extrema::ExtremaOptions;
use crate::index::Poll;
use crate::set::FootSet;
use source::{Shape, Source};
use std::sync::Arc;

pub use source::{CURVE_SAMPLES, POINT_ULPS, STEP_FIRST, STEP_SECOND, SURFACE_SAMPLES};

/// Boxes a query may look at by default when bounds are given.
pub const DEFAULT_BUDGET: u64 = 20_000;

/// The same for preimages: an arc takes many, a place few.
pub const DEFAULT_BUDGET_PREIMAGE: u64 = 100_000;

/// Boxes by default when there are no bounds: more boxes prove nothing then.
pub const DEFAULT_BUDGET_UNPROVEN: u64 = 2_000;

/// What the caller vouches for about a curve. Each bound is finite and at least 0.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CurveBounds {
    /// `|C'| <= speed` on the whole domain.
    pub speed: Option<f64>,
    /// `|C''| <= second` on the whole domain.
    pub second: Option<f64>,
}

/// What the caller vouches for about a surface. Each bound is finite and at least 0.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SurfaceBounds {
    /// `|S_u|` and `|S_v|` are at most these on the whole domain.
    pub speed: Option<[f64; 2]>,
    /// `|S_uu|`, `|S_uv|` and `|S_vv|` are at most these on the whole domain.
    pub second: Option<[f64; 3]>,
}

/// A curve given by a function.
#[derive(Debug)]
pub struct CallbackCurve {
    shape: Shape,
}

/// A surface given by a function.
#[derive(Debug)]
pub struct CallbackSurface {
    shape: Shape,
}

impl CallbackCurve {
    /// A curve on `domain`, from `function(u, order, out)`: it writes the point and the derivatives up to `order` (0 to
    /// 2) to `out[0]`, `out[1]`, `out[2]` and returns the highest order that it has written, `None` where it fails.
    ///
    /// The function is called here, at [`CURVE_SAMPLES`] places: for the box, for whether the curve is closed, and
    /// to estimate bounds that are not given.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for a domain or bounds that are none, or when no sample gives a finite point.
    pub fn new(
        domain: [f64; 2],
        bounds: CurveBounds,
        function: impl Fn(f64, usize, &mut [Vector; 3]) -> Option<usize> + Send + Sync + 'static,
    ) -> Result<Self, Error> {
        let spread = move |at: [f64; 2], order: usize, out: &mut [Vector; 6]| {
            let mut values = [[f64::NAN; 3]; 3];
            let delivered = function(at[0], order, &mut values)?;
            (out[0], out[1], out[3]) = (values[0], values[1], values[2]);
            // A curve does not move with the second parameter.
            (out[2], out[4], out[5]) = ([0.0; 3], [0.0; 3], [0.0; 3]);
            Some(delivered)
        };
        let [u0, u1] = domain;
        let source = Source::new(1, [u0, u1, 0.0, 0.0], Box::new(spread))?;
        let speed = bounds.speed.map(|speed| [speed, 0.0]);
        let second = bounds.second.map(|second| [second, 0.0, 0.0]);
        Ok(Self { shape: Shape::new(source, SurfaceBounds { speed, second })? })
    }

    /// The part between two parameters of the domain, with the same bounds.
    ///
    /// # Errors
    /// Parameters that are not in the domain or do not increase; what [`Self::new`] refuses.
    pub fn part(self: &Arc<Self>, ends: [f64; 2]) -> Result<Self, Error> {
        self.check_domain([ends[0], ends[1], 0.0, 0.0])?;
        let whole = Arc::clone(self);
        Self::new(ends, self.bounds(), move |u, order, out| {
            whole.derivatives(u, order, out).then_some(order)
        })
    }

    /// What the caller vouched for.
    pub fn bounds(&self) -> CurveBounds {
        let SurfaceBounds { speed, second } = self.shape.bounds;
        CurveBounds { speed: speed.map(|b| b[0]), second: second.map(|b| b[0]) }
    }

    /// First and last parameter.
    pub fn domain(&self) -> (f64, f64) {
        (self.shape.source.domain[0], self.shape.source.domain[1])
    }

    /// The point at `u` in the domain; `None` where the function fails.
    pub fn evaluate(&self, u: f64) -> Option<Vector> {
        Some(self.shape.source.sample([u, 0.0], 0)?.values[0])
    }

    /// The derivatives of order 0 to `order` (at most 2) into `out[0..=order]`; false where the function fails.
    pub fn derivatives(&self, u: f64, order: usize, out: &mut [Vector]) -> bool {
        let Some(sample) = self.shape.source.sample([u, 0.0], order) else { return false };
        let [point, first, _, second, ..] = sample.values;
        out[..=order].copy_from_slice(&[point, first, second][..=order]);
        true
    }

    /// Bytes held; what the function keeps for itself is not known.
    pub fn memory(&self) -> usize {
        size_of::<Self>() + self.shape.survey.memory()
    }

    /// Box of the samples. The curve may leave it between them.
    pub fn bounding_box(&self) -> Aabb {
        self.shape.survey.aabb
    }

    /// True when both ends are the same point.
    pub fn is_closed(&self) -> bool {
        self.shape.survey.closed[0]
    }

    /// Whether a restriction u0, u1 (the other two numbers do not count) lies in the domain, with u0 < u1.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] naming the entry.
    pub fn check_domain(&self, domain: [f64; 4]) -> Result<(), Error> {
        self.shape.check_restriction(domain)
    }

    /// The nearest point of the curve, as for a spline curve. Without bounds it is never proven.
    pub fn closest(
        &self,
        query: Vector,
        hint: Option<f64>,
        options: &QueryOptions,
        trace: Option<Trace>,
    ) -> FootPoint {
        search::closest(&self.shape, query, hint.map(|u| [u, 0.0]), options, trace)
    }

    /// As [`Self::closest`], for a query that should lie on the curve.
    pub fn invert(
        &self,
        query: Vector,
        hint: Option<f64>,
        options: &QueryOptions,
        trace: Option<Trace>,
    ) -> FootPoint {
        search::invert(&self.shape, query, hint.map(|u| [u, 0.0]), options, trace)
    }

    /// All parameters whose point lies within `tolerance` of the query (0: 1e-7 of the box diagonal), ordered by u.
    ///
    /// # Errors
    /// [`Error::Cancelled`] when `poll` said so.
    pub fn preimage(
        &self,
        query: Vector,
        tolerance: f64,
        options: &QueryOptions,
        poll: Poll,
    ) -> Result<FootSet, Error> {
        preimage::preimage(&self.shape, query, tolerance, options, poll)
    }

    /// All stationary points of the distance, nearest first.
    ///
    /// # Errors
    /// [`Error::Cancelled`] when `poll` said so.
    pub fn extrema(
        &self,
        query: Vector,
        options: &ExtremaOptions,
        poll: Poll,
    ) -> Result<FootSet, Error> {
        extrema::extrema(&self.shape, query, options, poll)
    }
}

impl CallbackSurface {
    /// A surface on `domain` (u0, u1, v0, v1), from `function(u, v, order, out)`: it writes the point and the partial
    /// derivatives up to the total `order` (0 to 2) to `out`, in the order S; Su, Sv; Suu, Suv, Svv, and returns
    /// the highest order that it has written, `None` where it fails.
    ///
    /// The function is called here, at a grid of [`SURFACE_SAMPLES`] squared places: for the box, for closed
    /// directions and collapsed edges, and to estimate bounds that are not given.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for a domain or bounds that are none, or when no sample gives a finite point.
    pub fn new(
        domain: [f64; 4],
        bounds: SurfaceBounds,
        function: impl Fn(f64, f64, usize, &mut [Vector; 6]) -> Option<usize> + Send + Sync + 'static,
    ) -> Result<Self, Error> {
        let spread = move |at: [f64; 2], order: usize, out: &mut [Vector; 6]| {
            function(at[0], at[1], order, out)
        };
        let source = Source::new(2, domain, Box::new(spread))?;
        Ok(Self { shape: Shape::new(source, bounds)? })
    }

    /// What the caller vouched for.
    pub fn bounds(&self) -> SurfaceBounds {
        self.shape.bounds
    }

    /// First and last parameters: u0, u1, v0, v1.
    pub fn domain(&self) -> [f64; 4] {
        self.shape.source.domain
    }

    /// The point at (u, v) in the domain; `None` where the function fails.
    pub fn evaluate(&self, u: f64, v: f64) -> Option<Vector> {
        Some(self.shape.source.sample([u, v], 0)?.values[0])
    }

    /// The partial derivatives of total order 0 to `order` (at most 2) into `out`, S; Su, Sv; Suu, Suv, Svv; false where
    /// the function fails.
    pub fn partials(&self, u: f64, v: f64, order: usize, out: &mut [Vector]) -> bool {
        let Some(sample) = self.shape.source.sample([u, v], order) else { return false };
        let count = source::VALUES[order];
        out[..count].copy_from_slice(&sample.values[..count]);
        true
    }

    /// Bytes held; what the function keeps for itself is not known.
    pub fn memory(&self) -> usize {
        size_of::<Self>() + self.shape.survey.memory()
    }

    /// Box of the samples. The surface may leave it between them.
    pub fn bounding_box(&self) -> Aabb {
        self.shape.survey.aabb
    }

    /// True when the edges at the start and the end of u agree in all samples.
    pub fn is_closed_u(&self) -> bool {
        self.shape.survey.closed[0]
    }

    /// True when the edges at the start and the end of v agree in all samples.
    pub fn is_closed_v(&self) -> bool {
        self.shape.survey.closed[1]
    }

    /// Which of the edges u0, u1, v0, v1 is a single point in all samples.
    pub fn collapsed_edges(&self) -> [bool; 4] {
        self.shape.survey.collapsed
    }

    /// Whether a restriction u0, u1, v0, v1 lies in the domain, with u0 < u1 and v0 < v1.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] naming the entry.
    pub fn check_domain(&self, domain: [f64; 4]) -> Result<(), Error> {
        self.shape.check_restriction(domain)
    }

    /// The nearest point of the surface, as for a spline surface. Without bounds it is never proven.
    pub fn closest(
        &self,
        query: Vector,
        hint: Option<[f64; 2]>,
        options: &QueryOptions,
        trace: Option<Trace>,
    ) -> FootPoint {
        search::closest(&self.shape, query, hint, options, trace)
    }

    /// As [`Self::closest`], for a query that should lie on the surface.
    pub fn invert(
        &self,
        query: Vector,
        hint: Option<[f64; 2]>,
        options: &QueryOptions,
        trace: Option<Trace>,
    ) -> FootPoint {
        search::invert(&self.shape, query, hint, options, trace)
    }

    /// All parameters whose point lies within `tolerance` of the query (0: 1e-7 of the box diagonal), ordered by u, then
    /// by v.
    ///
    /// # Errors
    /// [`Error::Cancelled`] when `poll` said so.
    pub fn preimage(
        &self,
        query: Vector,
        tolerance: f64,
        options: &QueryOptions,
        poll: Poll,
    ) -> Result<FootSet, Error> {
        preimage::preimage(&self.shape, query, tolerance, options, poll)
    }

    /// All stationary points of the distance, nearest first.
    ///
    /// # Errors
    /// [`Error::Cancelled`] when `poll` said so.
    pub fn extrema(
        &self,
        query: Vector,
        options: &ExtremaOptions,
        poll: Poll,
    ) -> Result<FootSet, Error> {
        extrema::extrema(&self.shape, query, options, poll)
    }
}
