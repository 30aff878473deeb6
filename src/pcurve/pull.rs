//! Pull-back: from a curve in space that lies on a surface to its pcurve.
//!
//! ```text
//!   feet       certified inversion at samples, joined over seams and breaks (`unwrap`); more samples where a step is wide
//!   breaks     where the edge meets a collapsed edge or crosses a seam: the pcurve is cut there (`cut`)
//!   fit        a line if that is near enough, else a spline by least squares, with knots added where the proof fails (`fit`)
//!   proof      greatest distance between S(p(t)) and the edge at equal t, from Bernstein coefficients (`deviation`)
//! ```
//!
//! A pcurve is continuous and its image is proven to stay within the deviation of the edge everywhere, not at samples: it
//! cannot have jumped to another branch between two of them.
//!
//! On a seam the parameter is the end of the domain exactly, on a collapsed edge likewise, and there the other parameter is
//! the limit from the side of the piece.
//!
//! Reference: Piegl, Tiller, *The NURBS Book*, 2nd ed., section 9.4 (least squares).
//! Limits: an edge that is a single point has no pcurve of its own; an edge that runs along a seam gets the pcurve of one
//! side (flag), the other one is a period away.

mod approximate;
mod cut;
mod feet;

use super::compose::Composer;
use super::deviation::Deviation;
use crate::bounds::norm;
use crate::closest::{QueryOptions, Workspace};
use crate::curve::Curve;
use crate::error::Error;
use crate::index::{IndexedSurface, SurfaceIndex};
use feet::Sample;

/// Bits of a pulled piece.
pub mod pulled {
    /// The proven deviation exceeds the tolerance.
    pub const NOT_PROVEN: u32 = 1;
    /// The edge is proven to leave the surface by more than the tolerance.
    pub const NOT_ON_SURFACE: u32 = 2;
    /// The piece runs along the seam of u; the pcurve at the other end of u is as good.
    pub const ALONG_SEAM_U: u32 = 4;
    /// The same of v.
    pub const ALONG_SEAM_V: u32 = 8;
    /// The piece begins where the edge crosses a seam.
    pub const FROM_SEAM: u32 = 16;
    /// The piece ends where the edge crosses a seam.
    pub const TO_SEAM: u32 = 32;
    /// The piece begins on a collapsed edge of the surface.
    pub const FROM_COLLAPSED: u32 = 64;
    /// The piece ends on a collapsed edge of the surface.
    pub const TO_COLLAPSED: u32 = 128;
}

/// Highest degree of a fitted pcurve.
pub const MOST_FITTED_DEGREE: usize = 9;

/// Poles of one piece that are not exceeded by default.
const DEFAULT_POLES: usize = 2_000;

/// Share of the tolerance by which a foot beside a seam or a collapsed edge is moved on it.
const SNAP: f64 = 0.01;

/// What is asked for.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PullOptions {
    /// Greatest distance between the image and the edge at equal parameters. 0: 1e-7 of the surface's box diagonal.
    pub tolerance: f64,
    /// Degree of fitted pieces, 1 to [`MOST_FITTED_DEGREE`]. 0: 3, or 5 for a tolerance below 1e-8 of the diagonal.
    pub degree: usize,
    /// Most poles of a piece. 0: 2000.
    pub most_poles: usize,
    /// Parameters near the edge's start, where more than one place of the surface is as near (seams, self-intersections).
    pub hint: Option<[f64; 2]>,
}

/// A pcurve and its proof.
#[derive(Clone, Debug, PartialEq)]
pub struct PulledPiece {
    /// u, v, 0 over a part of the edge's domain, with the edge's parameter.
    pub curve: Curve,
    /// Distance between its image and the edge.
    pub deviation: Deviation,
    /// Bits of [`pulled`].
    pub flags: u32,
}

/// The pcurves of an edge, in its order; each begins where the one before ends.
#[derive(Clone, Debug, PartialEq)]
pub struct Pulled {
    /// One piece, or more where the domain demands it.
    pub pieces: Vec<PulledPiece>,
}

impl Pulled {
    /// The greatest deviation.
    pub fn deviation(&self) -> Deviation {
        self.pieces.iter().fold(Deviation::none(), |most, piece| most.max(piece.deviation))
    }

    /// The flags of all pieces.
    pub fn flags(&self) -> u32 {
        self.pieces.iter().fold(0, |flags, piece| flags | piece.flags)
    }
}

impl IndexedSurface {
    /// The pcurves of `edge`, a curve that lies on the surface.
    ///
    /// Never fails for an edge that is not on the surface: the pieces then are its feet's, and say so.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for options out of range, an edge that is a single point, feet that jump from one branch of
    /// the surface to another; [`Error::OutOfMemory`]; [`Error::Cancelled`] when `poll` said so.
    pub fn pull(
        &self,
        edge: &Curve,
        options: &PullOptions,
        poll: &mut dyn FnMut() -> bool,
    ) -> Result<Pulled, Error> {
        check(options)?;
        let index = self.index(poll)?;
        let mut puller = Puller::new(self, index, edge, options);
        puller.refuse_points()?;
        puller.sample(options.hint, poll)?;
        let stretches = puller.stretches(poll)?;
        let mut pieces = Vec::with_capacity(stretches.len());
        for stretch in stretches {
            pieces.push(puller.approximate(&stretch, poll)?);
        }
        Ok(Pulled { pieces })
    }
}

fn check(options: &PullOptions) -> Result<(), Error> {
    let refuse = |text: String| Err(Error::InvalidArgument(text));
    if !(options.tolerance >= 0.0 && options.tolerance.is_finite()) {
        return refuse(format!("tolerance: {} is not a length", options.tolerance));
    }
    if options.degree > MOST_FITTED_DEGREE {
        return refuse(format!("degree: {} given, at most {MOST_FITTED_DEGREE}", options.degree));
    }
    match options.hint.and_then(|hint| hint.iter().position(|x| !x.is_finite())) {
        Some(k) => refuse(format!("hint: entry {k} is not finite")),
        None => Ok(()),
    }
}

/// The work on one edge.
struct Puller<'a> {
    shape: &'a IndexedSurface,
    index: &'a SurfaceIndex,
    edge: &'a Curve,
    composer: Composer<'a>,
    tolerance: f64,
    degree: usize,
    most_poles: usize,
    ends: [[f64; 2]; 2],
    workspace: Workspace,
    options: QueryOptions,
    /// Along a seam, whether the end of the domain is taken instead of the start.
    high: [bool; 2],
    /// In the order of t; parameters unrolled.
    samples: Vec<Sample>,
}

impl<'a> Puller<'a> {
    fn new(
        shape: &'a IndexedSurface,
        index: &'a SurfaceIndex,
        edge: &'a Curve,
        options: &PullOptions,
    ) -> Self {
        let diagonal = index.frame.diagonal;
        let tolerance = if options.tolerance > 0.0 { options.tolerance } else { 1e-7 * diagonal };
        let by_default = if tolerance < 1e-8 * diagonal { 5 } else { 3 };
        let [u0, u1, v0, v1] = shape.surface().domain();
        let ends = [[u0, u1], [v0, v1]];
        let near_end = |k: usize, hint: [f64; 2]| ends[k][1] - hint[k] < hint[k] - ends[k][0];
        Self {
            high: [0, 1].map(|k| options.hint.is_some_and(|hint| near_end(k, hint))),
            shape,
            index,
            edge,
            composer: Composer::new(shape.surface()),
            tolerance,
            degree: if options.degree > 0 { options.degree } else { by_default },
            most_poles: if options.most_poles > 0 { options.most_poles } else { DEFAULT_POLES },
            ends,
            workspace: Workspace::default(),
            options: QueryOptions::default(),
            samples: Vec::new(),
        }
    }

    fn refuse_points(&self) -> Result<(), Error> {
        let (low, high) = self.edge.bounding_box();
        if norm(crate::bounds::sub(high, low)) > self.tolerance {
            return Ok(());
        }
        let text = "edge: it is a single point up to the tolerance; its pcurve is a side of the domain or none";
        Err(Error::InvalidArgument(text.into()))
    }

    fn period(&self, k: usize) -> f64 {
        self.ends[k][1] - self.ends[k][0]
    }
}
