//! Trimmed surfaces: a surface, and loops of curves in its domain that bound a face.
//!
//! ```text
//!   TrimmedSurface --- Support      the surface: spline, elementary or callback
//!     |       |
//!     |       +------- Edge ...     curves in space, each used by one coedge or two (a seam, or an edge between two loops)
//!     |
//!     +--------------- Loop ...     outer: counter-clockwise, inner: clockwise in the domain
//!                        |
//!                        +-- Coedge ...   a pcurve, the edge that it is the image of, and whether they run the same way
//! ```
//!
//! This is the structure of IGES entities 142 and 144 and of the faces of STEP. Conventions:
//!
//! - The inside of the face lies to the left of each coedge in the (u, v) plane. A loop's coedges follow each other head to tail.
//! - The domain of the surface is a rectangle that is not continued: a region across a seam is bounded by coedges on both sides
//!   of it, which share one seam edge. A face may have several outer loops, for the parts of such a region.
//! - On a collapsed edge of the domain the coedge is an isoline and its edge a point.
//! - The place at a share s of the domain of a pcurve lies on the edge at the share s of its domain (1 - s when they run against
//!   each other) when [`Coedge::same_parameter`] says so; else only the two point sets are the same.
//!
//! A trimmed surface never changes. That its references are right is checked when it is made; whether its loops are closed,
//! directed, and disjoint, and how far pcurves are from edges, is what a report tells.

mod speed;

mod imager;

mod compare;

mod change;

mod convert;

mod invert;

mod matching;

mod flat;

mod gap;

mod report;

mod dump;

mod picture;

mod merge;

mod course;

mod recut;

mod follow;

use std::sync::{Arc, OnceLock};

use crate::bounds::{Aabb, Vector, norm, sub};
use crate::callback::{CallbackCurve, CallbackSurface};
use crate::curve::Curve;
use crate::elementary::ElementarySurface;
use crate::error::Error;
use crate::index::{IndexedCurve, IndexedSurface};
use crate::pcurve::{Direction, Parameters, Pcurve};
use crate::surface::Surface;
use crate::transform::between;

pub use change::{ChangeOptions, Changed, DEFAULT_TOLERANCE, MOST_VERTICES, Replacement};
pub use compare::PLACES;
pub use convert::form_transform;
pub use gap::GAP_SAMPLES;
pub use matching::Matching;
pub use picture::{MOST_COLUMNS, picture};
pub use report::{Finding, Place, REPORT_TOLERANCE, Report};
pub(crate) use speed::motion;

/// The surface under a face.
#[derive(Clone, Debug)]
pub enum Support {
    /// A B-spline or NURBS surface.
    Spline(Arc<IndexedSurface>),
    /// An elementary surface by its geometric parameters.
    Elementary(Arc<ElementarySupport>),
    /// A surface given by a function.
    Callback(Arc<CallbackSurface>),
}

/// An elementary surface with its exact NURBS form, made on first use.
#[derive(Debug)]
pub struct ElementarySupport {
    surface: ElementarySurface,
    form: OnceLock<Box<IndexedSurface>>,
    chart: OnceLock<Box<(Surface, f64)>>,
}

/// A spline in the parameters of a support, and how far it may be from it.
#[derive(Clone, Copy, Debug)]
pub struct Chart<'a> {
    /// The spline.
    pub surface: &'a Surface,
    /// No point of it is farther from the support's at equal parameters.
    pub error: f64,
}

impl ElementarySupport {
    /// Takes the surface.
    pub fn new(surface: ElementarySurface) -> Self {
        Self { surface, form: OnceLock::new(), chart: OnceLock::new() }
    }

    /// The surface.
    pub fn surface(&self) -> &ElementarySurface {
        &self.surface
    }

    /// The exact NURBS form with arcs of at most a quarter turn ([`ElementarySurface::usual_forms`]); angles run from 0 to 1 in it.
    ///
    /// # Errors
    /// Memory that could not be had.
    pub fn form(&self) -> Result<&IndexedSurface, Error> {
        if let Some(form) = self.form.get() {
            return Ok(form);
        }
        let form = self.surface.nurbs(self.surface.usual_forms())?;
        Ok(self.form.get_or_init(|| Box::new(IndexedSurface::new(form))))
    }

    /// A spline in the parameters of the surface, angles included ([`ElementarySurface::chart`]).
    ///
    /// # Errors
    /// Memory that could not be had.
    pub fn chart(&self) -> Result<Chart<'_>, Error> {
        let (surface, error) = match self.chart.get() {
            Some(made) => made.as_ref(),
            None => {
                let made = self.surface.chart()?;
                self.chart.get_or_init(|| Box::new(made)).as_ref()
            }
        };
        Ok(Chart { surface, error: *error })
    }
}

impl Support {
    /// First and last u, first and last v.
    pub fn domain(&self) -> [f64; 4] {
        match self {
            Self::Spline(spline) => spline.surface().domain(),
            Self::Elementary(elementary) => elementary.surface.domain(),
            Self::Callback(callback) => callback.domain(),
        }
    }

    /// The nearest place of the domain.
    pub fn clamped(&self, [u, v]: Parameters) -> Parameters {
        let [u0, u1, v0, v1] = self.domain();
        [u.max(u0).min(u1), v.max(v0).min(v1)]
    }

    /// The point at a place; places outside the domain are moved to its border first. NaN where a function fails.
    pub fn evaluate(&self, at: Parameters) -> Vector {
        let [u, v] = self.clamped(at);
        match self {
            Self::Spline(spline) => spline.surface().evaluate(u, v),
            Self::Elementary(elementary) => elementary.surface.evaluate(u, v),
            Self::Callback(callback) => callback.evaluate(u, v).unwrap_or([f64::NAN; 3]),
        }
    }

    /// The partial derivatives S; Su, Sv; Suu, Suv, Svv; ... to total order `count` at a place, moved into the domain; false where
    /// a function fails. `count` is at most 31, for functions 2.
    pub fn partials(&self, at: Parameters, count: usize, out: &mut [Vector]) -> bool {
        let [u, v] = self.clamped(at);
        match self {
            Self::Spline(spline) => spline.surface().partials(u, v, count, out),
            Self::Elementary(elementary) => elementary.surface.partials(u, v, count, out),
            Self::Callback(callback) => return callback.partials(u, v, count, out),
        }
        true
    }

    /// Whether the borders u0 and u1, v0 and v1 are the same curve.
    pub fn closed(&self) -> [bool; 2] {
        match self {
            Self::Spline(spline) => {
                [spline.surface().is_closed_u(), spline.surface().is_closed_v()]
            }
            Self::Elementary(elementary) => elementary.surface.closed(),
            Self::Callback(callback) => [callback.is_closed_u(), callback.is_closed_v()],
        }
    }

    /// Which of the edges u0, u1, v0, v1 is a single point.
    pub fn collapsed_edges(&self) -> [bool; 4] {
        match self {
            Self::Spline(spline) => spline.surface().collapsed_edges(),
            Self::Elementary(elementary) => elementary.surface.collapsed_edges(),
            Self::Callback(callback) => callback.collapsed_edges(),
        }
    }

    /// A spline in the parameters of the support; none for a function.
    ///
    /// # Errors
    /// Memory that could not be had.
    pub fn chart(&self) -> Result<Option<Chart<'_>>, Error> {
        match self {
            Self::Spline(spline) => Ok(Some(Chart { surface: spline.surface(), error: 0.0 })),
            Self::Elementary(elementary) => elementary.chart().map(Some),
            Self::Callback(_) => Ok(None),
        }
    }

    /// A box that holds the surface (for a function: its samples).
    ///
    /// # Errors
    /// Memory that could not be had.
    pub fn bounding_box(&self) -> Result<Aabb, Error> {
        let (low, high) = match self {
            Self::Spline(spline) => spline.surface().bounding_box(),
            Self::Elementary(elementary) => elementary.form()?.surface().bounding_box(),
            Self::Callback(callback) => return Ok(callback.bounding_box()),
        };
        Ok(Aabb { low, high })
    }
}

/// The curve of an edge in space.
#[derive(Clone, Debug)]
pub enum EdgeCurve {
    /// A B-spline or NURBS curve.
    Spline(Arc<IndexedCurve>),
    /// A curve given by a function.
    Callback(Arc<CallbackCurve>),
    /// A single point: the edge of a collapsed side of the domain.
    Point(Vector),
}

/// An edge: a curve in space with an orientation.
#[derive(Clone, Debug)]
pub struct Edge {
    /// The curve; all of its domain.
    pub curve: EdgeCurve,
    /// Whether the edge runs against its curve.
    pub reversed: bool,
}

impl Edge {
    /// The edge along a spline curve.
    pub fn along(curve: Curve) -> Self {
        Self { curve: EdgeCurve::Spline(Arc::new(IndexedCurve::new(curve))), reversed: false }
    }

    /// The edge of a collapsed side.
    pub fn collapsed(point: Vector) -> Self {
        Self { curve: EdgeCurve::Point(point), reversed: false }
    }

    /// Whether the edge is a single point.
    pub fn is_collapsed(&self) -> bool {
        matches!(self.curve, EdgeCurve::Point(_))
    }

    /// The parameter of the curve at a share, 0 to 1, of the way along the edge; 0 for a point.
    pub fn parameter_at(&self, share: f64) -> f64 {
        let share = if self.reversed { 1.0 - share } else { share };
        let (a, b) = match &self.curve {
            EdgeCurve::Spline(curve) => curve.curve().domain(),
            EdgeCurve::Callback(curve) => curve.domain(),
            EdgeCurve::Point(_) => return 0.0,
        };
        between(a, b, share)
    }

    /// The point at a share, 0 to 1, of the way along the edge. NaN where a function fails.
    pub fn evaluate(&self, share: f64) -> Vector {
        let t = self.parameter_at(share);
        match &self.curve {
            EdgeCurve::Spline(curve) => curve.curve().evaluate(t),
            EdgeCurve::Callback(curve) => curve.evaluate(t).unwrap_or([f64::NAN; 3]),
            EdgeCurve::Point(point) => *point,
        }
    }
}

/// The use of an edge by a loop: its curve in the domain.
#[derive(Clone, Debug)]
pub struct Coedge {
    /// The curve in the domain, along the loop.
    pub pcurve: Pcurve,
    /// Number of its edge; none when the edge is only known as the image of the pcurve.
    pub edge: Option<usize>,
    /// Whether the coedge runs against its edge.
    pub reversed: bool,
    /// Whether equal shares of both domains (mirrored when reversed) belong together.
    pub same_parameter: bool,
}

impl Coedge {
    /// A coedge along an edge, its parameters those of the edge.
    pub fn along(pcurve: Pcurve, edge: usize) -> Self {
        Self { pcurve, edge: Some(edge), reversed: false, same_parameter: true }
    }

    /// A coedge against an edge, its parameters those of the edge, mirrored.
    pub fn against(pcurve: Pcurve, edge: usize) -> Self {
        Self { reversed: true, ..Self::along(pcurve, edge) }
    }

    /// A coedge whose edge is the image of its pcurve.
    pub fn alone(pcurve: Pcurve) -> Self {
        Self { pcurve, edge: None, reversed: false, same_parameter: false }
    }

    /// Where it begins in the domain.
    pub fn start(&self) -> Parameters {
        self.pcurve.start()
    }

    /// Where it ends in the domain.
    pub fn end(&self) -> Parameters {
        self.pcurve.end()
    }
}

/// What a loop bounds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LoopKind {
    /// The face from outside; counter-clockwise.
    Outer,
    /// A hole; clockwise.
    Inner,
}

/// A closed chain of coedges.
#[derive(Clone, Debug)]
pub struct Loop {
    /// What it bounds.
    pub kind: LoopKind,
    /// The coedges in their order.
    pub coedges: Vec<Coedge>,
}

impl Loop {
    /// An outer loop.
    pub fn outer(coedges: Vec<Coedge>) -> Self {
        Self { kind: LoopKind::Outer, coedges }
    }

    /// An inner loop.
    pub fn inner(coedges: Vec<Coedge>) -> Self {
        Self { kind: LoopKind::Inner, coedges }
    }
}

/// A face: a surface bounded by loops. Immutable.
#[derive(Clone, Debug)]
pub struct TrimmedSurface {
    support: Support,
    edges: Vec<Edge>,
    loops: Vec<Loop>,
    flipped: bool,
}

impl TrimmedSurface {
    /// A face of `support`. `flipped`: its normal is opposite to Su x Sv.
    ///
    /// # Errors
    /// No loop; a loop without coedges; an edge that is not there, or used by no coedge or more than two; a curve that is a point on
    /// a side that is none; by index.
    pub fn new(
        support: Support,
        edges: Vec<Edge>,
        loops: Vec<Loop>,
        flipped: bool,
    ) -> Result<Self, Error> {
        if loops.is_empty() {
            return invalid("loops: none given".into());
        }
        let mut uses = vec![0; edges.len()];
        for (k, chain) in loops.iter().enumerate() {
            if chain.coedges.is_empty() {
                return invalid(format!("loops: loop {k} has no coedges"));
            }
            for (i, edge) in
                chain.coedges.iter().enumerate().filter_map(|(i, c)| Some((i, c.edge?)))
            {
                if edge >= edges.len() {
                    return invalid(format!(
                        "loops: coedge {i} of loop {k} uses edge {edge}, there are {}",
                        edges.len()
                    ));
                }
                uses[edge] += 1;
            }
        }
        if let Some(k) = uses.iter().position(|&n| n == 0 || n > 2) {
            let n = uses[k];
            return invalid(format!("edges: edge {k} is used by {n} coedges, not by one or two"));
        }
        for (k, edge) in edges.iter().enumerate() {
            if let EdgeCurve::Point(point) = edge.curve
                && point.iter().any(|x| !x.is_finite() || x.abs() > 1e100)
            {
                return invalid(format!(
                    "edges: the point of edge {k} is not finite or beyond 1e100"
                ));
            }
        }
        Ok(Self { support, edges, loops, flipped })
    }

    /// The whole surface: one outer loop around its domain, with seam edges used twice and points at collapsed sides. The sides of
    /// a surface given by a function have no edges of their own.
    ///
    /// # Errors
    /// Memory that could not be had.
    pub fn whole(support: Support) -> Result<Self, Error> {
        let [u0, u1, v0, v1] = support.domain();
        let (closed, collapsed) = (support.closed(), support.collapsed_edges());
        let isolines = [
            Pcurve::isoline(Direction::V, v0, u0, u1)?,
            Pcurve::isoline(Direction::U, u1, v0, v1)?,
            Pcurve::isoline(Direction::V, v1, u1, u0)?,
            Pcurve::isoline(Direction::U, u0, v1, v0)?,
        ];
        // Sides in the order of the loop: v0, u1, v1, u0; the last two run against their isocurves.
        let borders = support.borders()?;
        let mut edges = Vec::new();
        let mut first_use: [Option<usize>; 4] = [None; 4];
        let mut coedges = Vec::new();
        for (side, pcurve) in isolines.into_iter().enumerate() {
            let border = [2, 1, 3, 0][side];
            let seam = closed[usize::from(side % 2 == 0)];
            let partner = if seam && side >= 2 { first_use[side - 2] } else { None };
            let curve = if collapsed[border] {
                Some(Edge::collapsed(support.evaluate(pcurve.start())))
            } else {
                borders[border].clone().map(Edge::along)
            };
            let edge = match (partner, curve) {
                (Some(edge), _) => Some(edge),
                (None, Some(curve)) => {
                    edges.push(curve);
                    Some(edges.len() - 1)
                }
                (None, None) => None,
            };
            first_use[side] = edge;
            let along_angle = support.angular()[usize::from(side % 2 == 1)];
            let same_parameter = edge.is_some() && (collapsed[border] || !along_angle);
            coedges.push(Coedge {
                pcurve,
                edge,
                reversed: edge.is_some() && side >= 2,
                same_parameter,
            });
        }
        Self::new(support, edges, vec![Loop::outer(coedges)], false)
    }

    /// The surface.
    pub fn support(&self) -> &Support {
        &self.support
    }

    /// The edges; coedges refer to them by number.
    pub fn edges(&self) -> &[Edge] {
        &self.edges
    }

    /// The loops.
    pub fn loops(&self) -> &[Loop] {
        &self.loops
    }

    /// Whether the normal of the face is opposite to Su x Sv.
    pub fn is_flipped(&self) -> bool {
        self.flipped
    }

    /// The coedges of all loops, with the numbers of loop and coedge.
    pub fn coedges(&self) -> impl Iterator<Item = (usize, usize, &Coedge)> {
        self.loops.iter().enumerate().flat_map(|(k, chain)| {
            chain.coedges.iter().enumerate().map(move |(i, coedge)| (k, i, coedge))
        })
    }

    /// The image of a coedge's pcurve at a share, 0 to 1, of its domain.
    pub fn coedge_point(&self, coedge: &Coedge, share: f64) -> Vector {
        self.support.evaluate(coedge.pcurve.evaluate(coedge.pcurve.parameter_at(share)))
    }

    /// The point of a coedge's edge at a share, 0 to 1, along the coedge; none without an edge.
    pub fn edge_point(&self, coedge: &Coedge, share: f64) -> Option<Vector> {
        let edge = &self.edges[coedge.edge?];
        Some(edge.evaluate(if coedge.reversed { 1.0 - share } else { share }))
    }
}

impl Support {
    /// Which parameters are angles of an elementary surface.
    fn angular(&self) -> [bool; 2] {
        match self {
            Self::Elementary(elementary) => elementary.surface.angular(),
            _ => [false; 2],
        }
    }

    /// The curves of the sides u0, u1, v0, v1, in the direction of the parameter that runs; none for a function.
    fn borders(&self) -> Result<[Option<Curve>; 4], Error> {
        let surface = match self {
            Self::Spline(spline) => spline.surface(),
            Self::Elementary(elementary) => elementary.form()?.surface(),
            Self::Callback(_) => return Ok([None, None, None, None]),
        };
        let [u0, u1, v0, v1] = surface.domain();
        Ok([
            Some(surface.isocurve_u(u0)),
            Some(surface.isocurve_u(u1)),
            Some(surface.isocurve_v(v0)),
            Some(surface.isocurve_v(v1)),
        ])
    }
}

impl From<Surface> for Support {
    fn from(surface: Surface) -> Self {
        Self::Spline(Arc::new(IndexedSurface::new(surface)))
    }
}

impl From<ElementarySurface> for Support {
    fn from(surface: ElementarySurface) -> Self {
        Self::Elementary(Arc::new(ElementarySupport::new(surface)))
    }
}

fn invalid<T>(text: String) -> Result<T, Error> {
    Err(Error::InvalidArgument(text))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::elementary::{Axes, Elementary};
    use std::f64::consts::{FRAC_PI_2, TAU};

    fn sphere() -> Support {
        let kind = Elementary::Sphere { axes: Axes::STANDARD, radius: 2.0 };
        ElementarySurface::new(kind, [0.0, TAU, -FRAC_PI_2, FRAC_PI_2]).unwrap().into()
    }

    #[test]
    fn a_whole_sphere_has_one_seam_used_twice_and_two_points() {
        let face = TrimmedSurface::whole(sphere()).unwrap();
        assert_eq!(face.edges().len(), 3);
        assert_eq!(face.edges().iter().filter(|edge| edge.is_collapsed()).count(), 2);
        let coedges = &face.loops()[0].coedges;
        assert_eq!((coedges[1].edge, coedges[3].edge), (Some(1), Some(1)));
        assert!(!coedges[1].reversed && coedges[3].reversed);
        for (k, coedge) in coedges.iter().enumerate() {
            assert_eq!(coedge.end(), coedges[(k + 1) % 4].start());
            for share in [0.0, 0.5, 1.0] {
                let there = face.edge_point(coedge, share).unwrap();
                assert!(norm(sub(there, face.coedge_point(coedge, share))) < 4e-15);
            }
        }
    }

    #[test]
    fn references_that_lead_nowhere_are_refused_by_index() {
        let whole = TrimmedSurface::whole(sphere()).unwrap();
        let text = |edges: Vec<Edge>, loops: Vec<Loop>| {
            TrimmedSurface::new(sphere(), edges, loops, false).unwrap_err().to_string()
        };
        let (edges, loops) = (whole.edges().to_vec(), whole.loops().to_vec());
        assert_eq!(text(edges.clone(), vec![]), "loops: none given");
        assert_eq!(text(edges.clone(), vec![Loop::outer(vec![])]), "loops: loop 0 has no coedges");
        assert_eq!(
            text(edges[..2].to_vec(), loops.clone()),
            "loops: coedge 2 of loop 0 uses edge 2, there are 2"
        );
        let more = [edges.clone(), vec![Edge::collapsed([0.0; 3])]].concat();
        assert_eq!(text(more, loops), "edges: edge 3 is used by 0 coedges, not by one or two");
    }
}
