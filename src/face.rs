//! Point queries on faces: on which side of the borders a place lies, the nearest point of a face, preimages on a face.
//!
//! ```text
//!   TrimmedSurface -> Face     region     loops as Bezier pieces in the domain (`region`)
//!                              borders    images of the pcurves in space, each with its proven deviation (`border`)
//!
//!   nearest point    foot of the whole surface inside the face?                          it is the answer
//!                    nearest point of the borders no farther than the whole surface is?  it is the answer
//!                    otherwise    all stationary points nearer than the borders, those inside the face
//! ```
//!
//! The nearest point of a face lies on its border or is a stationary point inside it: the last step asks for all of those,
//! with proof that none is missing (`extrema`), and so the bound holds for faces whose nearest point is not the nearest
//! one of the surface. A continuum of feet needs no extra care: where it leaves the face it crosses the border.
//!
//! The border of a face is the image of its pcurves; edges in space, which files give with a gap, play no part.
//!
//! Limits: faces of spline surfaces; elementary ones are brought into that form by `transform` first.

mod border;

mod region;

mod nearest;

mod members;

mod many;

use std::sync::Arc;

use crate::batch::Memory;
use crate::bounds::{Aabb, Vector, norm, sub};
use crate::closest::{FootPoint, QueryOptions, Workspace};
use crate::curve::Curve;
use crate::error::Error;
use crate::index::{IndexedSurface, Poll};
use crate::pcurve::compose::Composer;
use crate::trim::{Support, TrimmedSurface};
use border::Border;
pub use region::{Halving, Region, Side};

/// Share of the diagonal within which a place counts as on an edge by default.
const DEFAULT_TOLERANCE: f64 = 1e-7;

/// Share of the diagonal that an answer may be from its bound by default.
const DEFAULT_ACCURACY: f64 = 1e-10;

/// Where a place lies.
#[repr(u32)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Standing {
    /// In the face, farther from its edges than the tolerance.
    Inside = 0,
    /// Not in the face, farther from its edges than the tolerance.
    Outside = 1,
    /// Within the tolerance of an edge, in space.
    OnEdge = 2,
    /// It could not be decided whether an edge is within the tolerance, or the query was none.
    #[default]
    Unknown = 3,
}

/// A place of a face, and the edge that it lies on.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// Where it lies.
    pub standing: Standing,
    /// On an edge: the number of its loop; else `u32::MAX`.
    pub loop_index: u32,
    /// On an edge: the number of the coedge in its loop; else `u32::MAX`.
    pub coedge_index: u32,
    /// 0.
    pub reserved: u32,
    /// On an edge: the parameter of the pcurve; else NaN.
    pub parameter: f64,
}

impl Place {
    /// Not on an edge.
    pub fn off(standing: Standing) -> Self {
        let (loop_index, coedge_index) = (u32::MAX, u32::MAX);
        Self { standing, loop_index, coedge_index, reserved: 0, parameter: f64::NAN }
    }
}

/// Reusable memory of one thread.
#[derive(Clone, Debug, Default)]
pub struct FaceWorkspace {
    shape: Workspace,
    halving: Halving,
}

impl Memory for FaceWorkspace {}

/// A face with what its queries need. Immutable.
#[derive(Debug)]
pub struct Face {
    shape: Arc<IndexedSurface>,
    region: Region,
    borders: Vec<Border>,
    /// Diagonal of the surface's box.
    diagonal: f64,
    bounds: Aabb,
}

impl Face {
    /// Prepares a trimmed surface for queries. Cost: some microseconds a pcurve, milliseconds where an image must be fitted.
    ///
    /// # Errors
    /// [`Error::Unsupported`] for a surface that is not a spline; [`Error::InvalidArgument`] for a pcurve that leaves the domain, by
    /// loop and coedge; [`Error::OutOfMemory`]; [`Error::Cancelled`] when `poll` said so.
    pub fn new(trimmed: &TrimmedSurface, poll: Poll) -> Result<Self, Error> {
        let Support::Spline(shape) = trimmed.support() else {
            let text = "trim: its surface is not a spline; transform it first";
            return Err(Error::Unsupported(text.into()));
        };
        let shape = Arc::clone(shape);
        let diagonal = shape.index(poll)?.frame.diagonal;
        let mut chains: Vec<Vec<Curve>> = Vec::new();
        let mut borders = Vec::new();
        let mut composer = Composer::new(shape.surface());
        for (k, chain) in trimmed.loops().iter().enumerate() {
            let mut curves = Vec::new();
            for (i, coedge) in chain.coedges.iter().enumerate() {
                if poll() {
                    return Err(Error::Cancelled);
                }
                let border = Border::new(&mut composer, &coedge.pcurve, [k, i], diagonal)
                    .map_err(|error| named(error, k, i))?;
                curves.push(border.pcurve().clone());
                borders.push(border);
            }
            chains.push(curves);
        }
        let region = Region::new(chains.iter().map(|chain| chain.iter()))?;
        let bounds = borders.iter().fold(Aabb::EMPTY, |all, border| all.union(border.bounds()));
        Ok(Self { shape, region, borders, diagonal, bounds })
    }

    /// The surface.
    pub fn surface(&self) -> &IndexedSurface {
        &self.shape
    }

    /// The loops in the domain.
    pub fn region(&self) -> &Region {
        &self.region
    }

    /// The pcurves of all loops as splines, in order.
    pub fn pcurves(&self) -> impl Iterator<Item = &Curve> {
        self.borders.iter().map(Border::pcurve)
    }

    /// The box around the edges in space; the face may bulge out of it.
    pub fn border_box(&self) -> Aabb {
        self.bounds
    }

    fn tolerance(&self, options: &QueryOptions) -> f64 {
        let given = options.tolerance;
        if given > 0.0 { given } else { DEFAULT_TOLERANCE * self.diagonal }
    }

    fn accuracy(&self, options: &QueryOptions) -> f64 {
        let given = options.accuracy;
        if given > 0.0 { given } else { DEFAULT_ACCURACY * self.diagonal }
    }

    /// On which side of the edges a place of the domain lies: on an edge when its point is within `options.tolerance` (0: 1e-7 of
    /// the surface's diagonal) of the image of a pcurve, in space. Places outside the domain are outside.
    ///
    /// Cost: below a microsecond in the domain, some more for each edge whose box is within the tolerance.
    pub fn classify(
        &self,
        at: [f64; 2],
        options: &QueryOptions,
        workspace: &mut FaceWorkspace,
    ) -> Place {
        if at.iter().any(|x| !x.is_finite()) {
            return Place::off(Standing::Unknown);
        }
        let [u0, u1, v0, v1] = self.shape.surface().domain();
        if at[0] < u0 || at[0] > u1 || at[1] < v0 || at[1] > v1 {
            return Place::off(Standing::Outside);
        }
        let point = self.shape.surface().evaluate(at[0], at[1]);
        let tolerance = self.tolerance(options);
        let (mut nearest, mut unknown) = (None::<(f64, Place)>, false);
        for border in &self.borders {
            let limit = nearest.map_or(tolerance, |(distance, _)| distance);
            let Some(found) = border.nearest(self, point, limit, options, workspace) else {
                continue;
            };
            if found.distance <= limit {
                nearest = Some((found.distance, border.place(found.t)));
            } else if found.lower_bound + found.allowed < tolerance {
                unknown = true;
            }
        }
        if let Some((_, place)) = nearest {
            return place;
        }
        match self.region.side(at, &mut workspace.halving) {
            _ if unknown => Place::off(Standing::Unknown),
            Side::Inside => Place::off(Standing::Inside),
            Side::Outside => Place::off(Standing::Outside),
            // The image of a border place that no border's search has found: only rounding is between them.
            Side::Border => Place::off(Standing::Unknown),
        }
    }

    /// Whether a place belongs to the closed region, without a tolerance.
    fn holds(&self, at: [f64; 2], workspace: &mut FaceWorkspace) -> bool {
        self.region.side(at, &mut workspace.halving) != Side::Outside
    }

    /// As [`Self::holds`], also for the same point at the other end of a closed direction; the parameters that do.
    fn held(&self, foot: &FootPoint, workspace: &mut FaceWorkspace) -> Option<[f64; 2]> {
        let [u0, u1, v0, v1] = self.shape.surface().domain();
        let closed = self.shape.index(&mut || false).map_or([false; 2], |index| index.closed);
        let other = |x: f64, [low, high]: [f64; 2], closed: bool| {
            let twin = if x == low { high } else { low };
            (closed && (x == low || x == high)).then_some(twin)
        };
        let us = [Some(foot.u), other(foot.u, [u0, u1], closed[0])];
        let vs = [Some(foot.v), other(foot.v, [v0, v1], closed[1])];
        for u in us.into_iter().flatten() {
            for v in vs.into_iter().flatten() {
                if self.holds([u, v], workspace) {
                    return Some([u, v]);
                }
            }
        }
        None
    }

    /// Distance between a query and the surface at a place.
    fn distance(&self, query: Vector, at: [f64; 2]) -> f64 {
        norm(sub(query, self.shape.surface().evaluate(at[0], at[1])))
    }
}

fn named(error: Error, chain: usize, coedge: usize) -> Error {
    match error {
        Error::InvalidArgument(text) => {
            Error::InvalidArgument(format!("loops: coedge {coedge} of loop {chain}: {text}"))
        }
        other => other,
    }
}
