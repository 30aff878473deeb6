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
//! Every support will do, and parameters are the support's own (`ground`). Sides in the domain never need the surface. On a function
//! distances are proven as far as it has a bound of its speed; without one nothing that needs a distance is, and places say so.

mod border;

mod ground;

mod region;

mod nearest;

mod members;

mod many;

use crate::batch::Memory;
use crate::bounds::{Aabb, Vector, norm, sub};
use crate::closest::{FootPoint, QueryOptions, Workspace};
use crate::curve::Curve;
use crate::error::Error;
use crate::trim::{Support, TrimmedSurface};
use border::{Border, Setting};
use ground::Ground;
pub use region::{Halving, Region, Side};

/// Share of the diagonal within which a place counts as on an edge by default.
const DEFAULT_TOLERANCE: f64 = 1e-7;

/// Share of the diagonal that an answer may be from its bound by default.
const DEFAULT_ACCURACY: f64 = 1e-10;

/// Bit of [`Place::flags`]: whether an edge is within the tolerance is not proven, since the surface is a function without a bound.
pub const NOT_PROVEN: u32 = 1;

/// Most spans that the images of all coedges may have by default.
pub const DEFAULT_BUDGET: u64 = 10_000_000;

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
    /// 0 or [`NOT_PROVEN`].
    pub flags: u32,
    /// On an edge: the parameter of the pcurve; else NaN.
    pub parameter: f64,
}

impl Place {
    /// Not on an edge.
    pub fn off(standing: Standing) -> Self {
        let (loop_index, coedge_index) = (u32::MAX, u32::MAX);
        Self { standing, loop_index, coedge_index, flags: 0, parameter: f64::NAN }
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
    support: Support,
    ground: Ground,
    region: Region,
    /// The pcurves of all loops as splines.
    pcurves: Vec<Curve>,
    borders: Vec<Border>,
    closed: [bool; 2],
    collapsed: [bool; 4],
    /// Diagonal of the surface's box.
    diagonal: f64,
    bounds: Aabb,
}

impl Face {
    /// Prepares a trimmed surface for queries. Cost: some microseconds a pcurve, milliseconds where an image must be fitted. `budget`: most
    /// spans of the images of all pcurves, 0: [`DEFAULT_BUDGET`]. `poll` is told how many coedges are done.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for a pcurve that leaves the domain, by loop and coedge; [`Error::Unsupported`] when the budget does not
    /// do; [`Error::OutOfMemory`]; [`Error::Cancelled`] when `poll` said so.
    pub fn new(
        trimmed: &TrimmedSurface,
        budget: u64,
        poll: &mut dyn FnMut(usize) -> bool,
    ) -> Result<Self, Error> {
        let support = trimmed.support().clone();
        let ground = Ground::new(&support, &mut || poll(0))?;
        let diagonal = ground.diagonal(&mut || false)?;
        let budget = if budget > 0 { budget } else { DEFAULT_BUDGET };
        let (mut pcurves, mut borders) = (Vec::new(), Vec::new());
        let (mut spent, mut counts) = (0u64, Vec::new());
        let mut setting = Setting::new(&support, diagonal)?;
        for (k, chain) in trimmed.loops().iter().enumerate() {
            counts.push(chain.coedges.len());
            for (i, coedge) in chain.coedges.iter().enumerate() {
                let (done, before) = (pcurves.len(), borders.len());
                let mut stop = || poll(done);
                if stop() {
                    return Err(Error::Cancelled);
                }
                let curve = setting.borders(&coedge.pcurve, [k, i], &mut stop, &mut borders);
                pcurves.push(curve.map_err(|error| named(error, k, i))?);
                spent += borders[before..].iter().map(Border::spans).sum::<u64>();
                if spent > budget {
                    let text = format!("budget: {budget} spans do not do for loop {k}, coedge {i}");
                    return Err(Error::Unsupported(text));
                }
            }
        }
        let mut rest = &pcurves[..];
        let chains = counts.iter().map(|&count| {
            let (chain, behind) = rest.split_at(count);
            rest = behind;
            chain.iter()
        });
        let region = Region::new(chains)?;
        let bounds = borders.iter().fold(Aabb::EMPTY, |all, border| all.union(border.bounds()));
        let (closed, collapsed) = (support.closed(), support.collapsed_edges());
        drop(setting);
        Ok(Self { support, ground, region, pcurves, borders, closed, collapsed, diagonal, bounds })
    }

    /// The surface.
    pub fn support(&self) -> &Support {
        &self.support
    }

    /// Bytes held by the surface and its index.
    pub fn surface_memory(&self) -> usize {
        self.ground.memory()
    }

    /// The loops in the domain.
    pub fn region(&self) -> &Region {
        &self.region
    }

    /// The pcurves of all loops as splines, in order.
    pub fn pcurves(&self) -> impl Iterator<Item = &Curve> {
        self.pcurves.iter()
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
        let [u0, u1, v0, v1] = self.support.domain();
        if at[0] < u0 || at[0] > u1 || at[1] < v0 || at[1] > v1 {
            return Place::off(Standing::Outside);
        }
        let point = self.support.evaluate(at);
        if point.iter().any(|x| !x.is_finite()) {
            // A function fails there.
            return Place::off(Standing::Unknown);
        }
        let (proven, mut doubt) = (self.ground.is_proven(), 0);
        let tolerance = self.tolerance(options);
        let (mut nearest, mut unknown) = (None::<(f64, Place)>, false);
        for border in &self.borders {
            let limit = nearest.map_or(tolerance, |(distance, _)| distance);
            let Some(found) = border.nearest(self, point, limit, options, workspace) else {
                continue;
            };
            if found.distance <= limit {
                nearest = Some((found.distance, border.place(found.t)));
            } else if proven && found.lower_bound + found.allowed < tolerance {
                unknown = true;
            } else if !proven {
                doubt = NOT_PROVEN;
            }
        }
        if let Some((_, place)) = nearest {
            return place;
        }
        let standing = match self.region.side(at, &mut workspace.halving) {
            _ if unknown => Standing::Unknown,
            Side::Inside => Standing::Inside,
            Side::Outside => Standing::Outside,
            // The image of a border place that no border's search has found: only rounding is between them.
            Side::Border => Standing::Unknown,
        };
        Place { flags: doubt, ..Place::off(standing) }
    }

    /// Whether a place belongs to the closed region, without a tolerance.
    fn holds(&self, at: [f64; 2], workspace: &mut FaceWorkspace) -> bool {
        self.region.side(at, &mut workspace.halving) != Side::Outside
    }

    /// As [`Self::holds`], also for the same point at the other end of a closed direction; the parameters that do.
    fn held(&self, foot: &FootPoint, workspace: &mut FaceWorkspace) -> Option<[f64; 2]> {
        let ([u0, u1, v0, v1], closed) = (self.support.domain(), self.closed);
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
        norm(sub(query, self.support.evaluate(at)))
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
