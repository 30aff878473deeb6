//! The index of a surface: its Bezier patches.

mod blocks;
mod build;

use super::patch::Patch;
use super::piece::{Frame, tensor_len};
use super::reach::{Cell, Net, Raster, Reach};
use crate::analytic::Analytic;
use crate::bezier::Bidegree;
use crate::bounds::{Vector, sub};
use crate::coefficients::{Grid, Ladder};
use crate::error::Error;
use crate::jet::{BezierPatch, pole_distance};
use crate::simd::Level;
use crate::surface::Surface;
use crate::tree::Tree;
pub use blocks::HUGE;
use blocks::{Blocks, Store};
use build::{Keep, Plan};
use std::sync::Arc;

/// Search structure of a surface.
#[derive(Debug)]
pub struct SurfaceIndex {
    /// Map from the caller's coordinates.
    pub frame: Frame,
    /// The patches; (a, b) at `a * columns + b`.
    pub patches: Vec<Patch>,
    /// Boxes of the patches.
    pub tree: Tree,
    /// Degrees of the patches.
    pub degree: Bidegree,
    /// Whether weights are there.
    pub rational: bool,
    /// Number of patches in v.
    pub columns: usize,
    /// Whether the surface is closed in u, in v.
    pub closed: [bool; 2],
    /// Whether the edges u0, u1, v0, v1 are collapsed.
    pub collapsed: [bool; 4],
    /// The elementary surface that this one is, if it is one.
    pub analytic: Option<Box<Analytic>>,
    /// How far normals may be followed; without it nothing is known of that.
    pub reach: Option<Reach>,
    cells: (Vec<Cell>, Raster),
    numbers: Store,
    /// Vector instructions.
    pub level: Level,
    /// The coefficient arrays of its patches, and those of lower degrees.
    pub ladder: Ladder,
    /// Those of their edges along s and along t.
    pub edge_grids: [Grid; 2],
}

impl SurfaceIndex {
    /// Builds the index for the vector instructions of `level`; `poll` is asked now and then whether to stop. A large surface is
    /// built by all cores; the bits do not depend on them. Of one of more than `huge` patches nets and tensors are made
    /// when a query first visits their part, so that memory goes with what is visited.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`], [`Error::Cancelled`].
    pub fn new(
        surface: &Arc<Surface>,
        level: Level,
        huge: usize,
        poll: &mut dyn FnMut() -> bool,
    ) -> Result<Self, Error> {
        let plan = Plan::new(surface.clone());
        let raster = plan.raster.clone();
        let (degree, rational, columns) = (plan.degree, plan.rational, plan.columns);
        let (frame, is_huge) = (plan.frame, plan.count() > huge);
        let all = plan.build(if is_huge { Keep::Places } else { Keep::All }, poll)?;
        let numbers = if is_huge {
            Store::Blocks(Box::new(Blocks::new(plan)?))
        } else {
            Store::Parts(all.numbers)
        };
        Ok(Self {
            frame,
            tree: Tree::new(&all.boxes, all.boxes.len() / columns, columns, level),
            patches: all.patches,
            degree,
            rational,
            columns,
            closed: [surface.is_closed_u(), surface.is_closed_v()],
            collapsed: surface.collapsed_edges(),
            analytic: None,
            reach: None,
            cells: (all.cells, raster),
            numbers,
            level,
            ladder: Ladder::new(degree, rational, level),
            edge_grids: [degree.s, degree.t]
                .map(|t| Grid::new(Bidegree { s: 0, t }, rational, level)),
        })
    }

    /// Makes [`Self::reach`], once, of what building left for it.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`], [`Error::Cancelled`].
    pub fn measure_reach(&mut self, poll: &mut dyn FnMut() -> bool) -> Result<(), Error> {
        let (cells, raster) = std::mem::take(&mut self.cells);
        if self.analytic.is_none() {
            let poles = |k: usize| self.net(k).poles;
            let (patches, columns) = (&self.patches[..], self.columns);
            let (degree, rational) = (self.degree, self.rational);
            let poles = if patches.len() <= HUGE { Some(&poles as _) } else { None };
            let net = Net { patches, columns, degree, rational, poles };
            self.reach = Some(Reach::new(cells, &net, raster, poll)?);
        }
        Ok(())
    }

    /// Patch `k`'s poles.
    pub fn net(&self, k: usize) -> BezierPatch<'_> {
        let width = self.degree.count() * if self.rational { 4 } else { 3 };
        let (numbers, k) = self.numbers.of(k);
        let poles = &numbers.nets[k * width..(k + 1) * width];
        let count = self.degree.count();
        let lanes = &numbers.lanes[k * count..(k + 1) * count];
        BezierPatch {
            degree: self.degree,
            rational: self.rational,
            poles,
            lanes,
            level: self.level,
        }
    }

    /// The row (0) or column (1) of patches that holds a parameter in the domain: the last one that begins at or before it.
    pub fn strip(&self, k: usize, at: f64) -> usize {
        let stride = [self.columns, 1][k];
        let (mut found, mut end) = (0, [self.patches.len() / self.columns, self.columns][k]);
        while end - found > 1 {
            let middle = found.midpoint(end);
            let patch = &self.patches[middle * stride];
            let start = [patch.u, patch.v][k].ends[0];
            *(if start <= at { &mut found } else { &mut end }) = middle;
        }
        found
    }

    /// Distance from `query` to the nearest corner of patch `k`, in the index's coordinates and but for rounding.
    pub fn corner_distance(&self, k: usize, query: Vector) -> f64 {
        let (lanes, columns) = (self.net(k).lanes, self.degree.t + 1);
        let q = sub(query, self.patches[k].center);
        let corners = [0, self.degree.t, self.degree.s * columns, lanes.len() - 1];
        corners.into_iter().fold(f64::INFINITY, |least, at| least.min(pole_distance(&lanes[at], q)))
    }

    /// Patch `k`'s tensors A, -2 B, C, when they are kept.
    pub fn tensors(&self, k: usize) -> Option<&[f64]> {
        let width = tensor_len(self.degree, self.rational);
        let (numbers, k) = self.numbers.of(k);
        numbers.tensors.get(k * width..(k + 1) * width)
    }

    /// Bytes held now: of a huge surface it grows with the parts that queries have visited.
    pub fn memory(&self) -> usize {
        size_of::<Self>()
            + self.numbers.memory()
            + self.patches.capacity() * size_of::<Patch>()
            + self.tree.memory()
            + self.ladder.memory()
            + self.edge_grids.iter().map(Grid::memory).sum::<usize>()
            + self.analytic.as_ref().map_or(0, |analytic| analytic.memory())
            + self.reach.as_ref().map_or(0, Reach::memory)
    }
}
