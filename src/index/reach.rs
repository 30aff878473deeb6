//! How far from a surface its normals, from a curve vectors across, may be followed before another part of it can be as near.
//!
//! For a place f with unit normal N the ball through f around f + a N holds no other point x of the surface when
//!
//! ```text
//!   N.(x - f) <= K |x - f|^2   for all x,   and   2 a K <= 1
//! ```
//!
//! and then |x - q|^2 >= a^2 + (1 - 2 a K) |x - f|^2 for q = f + a N: f is the only nearest point. The least such K is half the
//! inverse of the reach at f (Federer, *Curvature measures*, 1959, theorem 4.8). Here it is bounded for all f in a cell of
//! a patch, for both sides, against the whole surface:
//!
//! - x in the block of cells around, where the surface is C1: both sides are integrals along the segment between the
//!   parameters, of the second derivatives along N and of the first ones;
//! - x elsewhere: from boxes around cells and groups of cells, and the cone of the normals.
//!
//! Where that is too much, x in the blocks around alone is bounded, and the boxes of the other cells tell whether they matter for a
//! query (`rings`).
//!
//! For f on a side of the surface the same is bounded for its outward conormal. What lies across a crease is at distance zero of
//! what is beside it: there K is infinite, and the search has to do without. Lines and seams where the surface is smooth but for
//! rounding are none (`joints`). For a curve, vectors across take the place of the normal (`curve`). `docs/rounding.md`, section 21,
//! has the proof.

mod arc;
mod cell;
mod curve;
mod edge;
mod field;
mod groups;
mod joints;
mod middles;
mod oriented;
mod raster;
mod rings;
mod shell;

use super::piece::reserved;
use crate::bounds::Vector;
use crate::error::Error;
use crate::simd::Level;
use crate::tree::Tree;
pub use cell::{Cell, push_cells};
pub use curve::{Across, Chain, CurveReach};
pub use edge::Edge;
pub use field::RINGS;
use field::{Field, STRAIGHT, WIDEST};
use joints::Joints;
pub use joints::Net;
use middles::Middles;
pub use raster::Raster;
use rings::Rings;
use shell::Shell;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

/// Cells of a piece of work, and pieces from which on all cores work.
const TILE: usize = 256;
const MANY: usize = 16;

/// How far from a line between patches an iteration begins: on it, it would be held.
const OFF_LINE: f64 = 1.0 / 64.0;

/// Bounds are rounded up by this share.
const MARGIN: f64 = 1.0 + 1e-6;

fn rounded_up(x: f64) -> f32 {
    ((x * MARGIN) as f32).next_up()
}

/// The bounds K of all cells.
#[derive(Clone, Debug, Default)]
pub struct Reach {
    raster: Raster,
    columns: usize,
    /// Of a cell, row by row: for queries on the side of the normal, and on the other.
    bends: Vec<[f32; 2]>,
    /// Of the cells along the sides of the surface: for their outward conormals.
    rims: [Vec<f32>; 4],
    rings: Rings,
    /// Boxes around groups of cells.
    around: Shell,
    middles: Middles,
    /// Whether the surface goes on smoothly beyond its sides in u, in v.
    seamless: [bool; 2],
    /// What is allowed for where derivatives or sides are one but for rounding: for all x, `N.(x - f)` is at most
    /// `K |x - f|^2 + kink |x - f| + gap`.
    pub kink: f64,
    /// See `kink`.
    pub gap: f64,
}

impl Reach {
    /// From the cells of all patches, in their order; `poll` is asked now and then whether to stop. All cores work on many
    /// cells; the bits do not depend on them.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`], [`Error::Cancelled`].
    pub fn new(
        cells: Vec<Cell>,
        net: &Net,
        raster: Raster,
        poll: &mut dyn FnMut() -> bool,
    ) -> Result<Self, Error> {
        let joints = Joints::new(net)?;
        let (field, count) = (Field::new(cells, &raster, &joints)?, raster.count());
        let mut bends = reserved(count)?;
        bends.resize(count, [f32::INFINITY; 2]);
        let columns = field.size[1];
        let middles = Middles::new(field.middles())?;
        let mut tiles = reserved(count.div_ceil(TILE))?;
        tiles.extend(bends.chunks_mut(TILE).map(|tile| Mutex::new(Some(tile))));
        let (next, stop) = (AtomicUsize::new(0), AtomicBool::new(false));
        let work = |poll: &mut dyn FnMut() -> bool| {
            loop {
                let k = next.fetch_add(1, Ordering::Relaxed);
                if stop.load(Ordering::Relaxed) || k >= tiles.len() {
                    return;
                }
                if k > 0 && poll() {
                    return stop.store(true, Ordering::Relaxed);
                }
                let tile = tiles[k].lock().unwrap_or_else(PoisonError::into_inner).take();
                for (n, bend) in tile.into_iter().flatten().enumerate() {
                    let at = k * TILE + n;
                    let found = field.bend([at / columns, at % columns]);
                    *bend = found.map(rounded_up);
                }
            }
        };
        let cores = std::thread::available_parallelism().map_or(1, usize::from);
        std::thread::scope(|scope| {
            for _ in 1..if tiles.len() < MANY { 1 } else { cores } {
                // A thread that could not be started leaves its share to the others.
                let _ = std::thread::Builder::new().spawn_scoped(scope, || work(&mut || false));
            }
            work(poll);
        });
        if stop.load(Ordering::Relaxed) {
            return Err(Error::Cancelled);
        }
        // Beyond a seam that is none there is no side.
        let seamless = joints.smooth.each_ref().map(|list| list[0]);
        let mut rims: [Vec<f32>; 4] = Default::default();
        for (side, list) in rims.iter_mut().enumerate() {
            let count = field.size[1 - side / 2];
            *list = reserved(count)?;
            list.extend((0..count).map(|n| {
                let bound = if seamless[side / 2] {
                    f64::INFINITY
                } else {
                    field.rim(field.on_side(n, side), side)
                };
                rounded_up(bound)
            }));
        }
        let rings = Rings::new(&field, seamless)?;
        let around = Shell::new(field.few_boxes(shell::WIDTH).iter())?;
        let columns = raster.starts[1].len() - 1;
        // So many lines there may be in a block, and a derivative may be twice the mean; see `Field::near`.
        let kink = joints.kink * 2.0 * (2 * WIDEST) as f64 / STRAIGHT;
        Ok(Self {
            raster,
            columns,
            bends,
            rims,
            rings,
            around,
            middles,
            seamless,
            kink,
            gap: 4.0 * joints.gap,
        })
    }

    /// The row and column of a patch.
    fn patch(&self, k: usize) -> [usize; 2] {
        let (k, columns) = (k as u32, self.columns as u32);
        [(k / columns) as usize, (k % columns) as usize]
    }

    /// K for queries on the side of the normal, and on the other, at a place of patch `k`.
    pub fn bend(&self, k: usize, at: [f64; 2]) -> [f64; 2] {
        let [i, j] = self.raster.cell(self.patch(k), at);
        let width = self.raster.starts[1][self.columns] as usize;
        self.bends[i * width + j].map(f64::from)
    }

    /// The sides of the surface (as in `side`) on which a place of patch `k` lies, and beyond which it does not go on.
    pub fn sides(&self, k: usize, at: [f64; 2]) -> [bool; 4] {
        let patch = self.patch(k);
        let last = self.raster.starts.each_ref().map(|list| list.len() - 2);
        [0, 1, 2, 3].map(|side| {
            let d = side / 2;
            let end = if side % 2 == 0 { 0 } else { last[d] };
            !self.seamless[d] && patch[d] == end && at[d] == (side % 2) as f64
        })
    }

    /// K for the outward conormal in place of the normal, at a place of patch `k` on side `side` of the surface.
    pub fn rim(&self, k: usize, at: [f64; 2], side: usize) -> f64 {
        let cell = self.raster.cell(self.patch(k), at);
        f64::from(self.rims[side][cell[1 - side / 2]])
    }

    /// As [`Self::bend`] against the cells in a ring around that of the place, and those within; `None` where there are none.
    pub fn near(&self, k: usize, at: [f64; 2], ring: usize) -> Option<[f64; 2]> {
        let is_there = ring < RINGS && !self.rings.is_empty();
        is_there.then(|| self.rings.bend(self.raster.cell(self.patch(k), at), ring))
    }

    /// What is in a ring around the cell of a place of patch `k` on side `side` of the surface, where something is known;
    /// and the widths of the cell in the local parameters.
    pub fn edge(
        &self,
        k: usize,
        at: [f64; 2],
        side: usize,
        ring: usize,
    ) -> Option<(&Edge, [f64; 2])> {
        let patch = self.patch(k);
        let edge = self.rings.edge(self.raster.cell(patch, at), side, ring)?;
        Some((edge, self.raster.split(patch).map(|n| 1.0 / n as f64)))
    }

    /// Whether everything nearer to a query than `reach` lies in a ring around the cell of a place and those within, where
    /// [`Self::near`] says something.
    pub fn holds(
        &self,
        (k, at): (usize, [f64; 2]),
        ring: usize,
        query: Vector,
        reach: f64,
        level: Level,
    ) -> bool {
        self.rings.hold(self.raster.cell(self.patch(k), at), ring, query, reach, level)
    }

    /// At most the distance from a query to the surface, by boxes around all cells; `None` where there are too many.
    pub fn distance(&self, query: Vector, level: Level) -> Option<f64> {
        (!self.rings.is_empty()).then(|| self.rings.distance(query, level))
    }

    /// As [`Self::distance`], by some boxes around many cells each: less, in less time.
    pub fn rough_distance(&self, query: Vector, level: Level) -> f64 {
        self.around.distance(query, level)
    }

    /// A place near a query: a patch and local parameters, inside but on the sides of the surface. `tree`: that of the patches.
    pub fn start(&self, query: Vector, tree: &Tree) -> (usize, [f64; 2]) {
        let width = self.raster.starts[1][self.columns] as usize;
        let cells = |k: usize| {
            let [row, column] = self.patch(k);
            let [rows, columns] = [(0, row), (1, column)].map(|(k, n)| {
                self.raster.starts[k][n] as usize..self.raster.starts[k][n + 1] as usize
            });
            rows.flat_map(move |i| columns.clone().map(move |j| i * width + j))
        };
        let nearest = self.middles.nearest(query, tree.level());
        let (cell, at) = nearest.unwrap_or_else(|| self.middles.near(query, tree, cells));
        let (row, s) = self.raster.place(0, cell / width, at[0]);
        let (column, t) = self.raster.place(1, cell % width, at[1]);
        (row * self.columns + column, [self.within(0, row, s), self.within(1, column, t)])
    }

    /// A local parameter of a row (0) or column (1) of patches moved off the lines where others go on.
    fn within(&self, k: usize, patch: usize, at: f64) -> f64 {
        let last = self.raster.starts[k].len() - 2;
        if at == 0.0 && (patch > 0 || self.seamless[k]) {
            OFF_LINE
        } else if at == 1.0 && (patch < last || self.seamless[k]) {
            1.0 - OFF_LINE
        } else {
            at
        }
    }

    /// Bytes held.
    pub fn memory(&self) -> usize {
        self.raster.memory()
            + self.middles.memory()
            + self.rings.memory()
            + self.around.memory()
            + self.bends.capacity() * size_of::<[f32; 2]>()
            + self.rims.iter().map(|list| list.capacity() * size_of::<f32>()).sum::<usize>()
    }
}
