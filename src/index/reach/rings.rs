//! Bounds K for what is near only, and boxes that show for one query whether the rest is far.
//!
//! The bounds of the whole surface hold for all queries on the normals of a cell, so they allow for all directions in it. Where
//! they are too large, those of the cells around may do, and the boxes of the others tell for the one query at hand.

use super::edge::Edge;
use super::field::{Field, RINGS};
use super::rounded_up;
use super::shell::{MOST, Shell};
use crate::bounds::Vector;
use crate::error::Error;
use crate::index::piece::reserved;
use crate::simd::Level;

/// Bounds for the cells around each cell, ring by ring, and the boxes; empty when there are too many cells.
#[derive(Clone, Debug, Default)]
pub struct Rings {
    /// Rows and columns of cells.
    size: [usize; 2],
    /// Of a cell, row by row: for queries on the side of the normal, and on the other.
    bends: Vec<[[f32; 2]; RINGS]>,
    /// Of the cells along the sides of the surface.
    edges: [Vec<[Option<Edge>; RINGS]>; 4],
    /// How many rows before and after, columns before and after a cell the last ring has.
    blocks: Vec<[[u8; 2]; 2]>,
    shell: Shell,
}

impl Rings {
    /// Of all cells; of the four sides those that are `seams` are none.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn new(field: &Field, seams: [bool; 2]) -> Result<Self, Error> {
        let size = field.size;
        let count = size[0] * size[1];
        if count > MOST {
            return Ok(Self::default());
        }
        let (mut bends, mut blocks) = (reserved(count)?, reserved(count)?);
        for place in (0..count).map(|k| [k / size[1], k % size[1]]) {
            let rings = field.rings(place);
            bends.push(rings.map(|ring| ring.map(rounded_up)));
            blocks.push(field.around(place).map(|ends| ends.map(|n| n as u8)));
        }
        let mut edges: [Vec<[Option<Edge>; RINGS]>; 4] = Default::default();
        for (side, list) in edges.iter_mut().enumerate().filter(|(side, _)| !seams[side / 2]) {
            *list = reserved(size[1 - side / 2])?;
            list.extend((0..size[1 - side / 2]).map(|n| field.edges(field.on_side(n, side))));
        }
        Ok(Self { size, bends, edges, blocks, shell: Shell::new(field.boxes())? })
    }

    /// Whether there is nothing to look at.
    pub fn is_empty(&self) -> bool {
        self.shell.is_empty()
    }

    /// K of a cell for queries on the side of the normal and on the other, against what is in a ring and those within.
    pub fn bend(&self, [row, column]: [usize; 2], ring: usize) -> [f64; 2] {
        self.bends[row * self.size[1] + column][ring].map(f64::from)
    }

    /// What is in a ring around a cell on a side of the surface and those within, where something is known.
    pub fn edge(&self, cell: [usize; 2], side: usize, ring: usize) -> Option<&Edge> {
        self.edges[side].get(cell[1 - side / 2])?[ring].as_ref()
    }

    /// Whether everything nearer to a query than `reach` lies in a ring of a cell and those within.
    pub fn hold(
        &self,
        cell: [usize; 2],
        ring: usize,
        query: Vector,
        reach: f64,
        level: Level,
    ) -> bool {
        let around = self.blocks[cell[0] * self.size[1] + cell[1]];
        let wide = Field::wide(ring);
        let within = |k: usize, at: usize| {
            let [before, after] = around[k].map(|n| usize::from(n).min(wide));
            // Counted from the first row or column, on beyond a seam.
            (at + self.size[k] + before - cell[k]) % self.size[k] <= before + after
        };
        let columns = self.size[1];
        let mut hits = self.shell.hits(query, reach, level).cells();
        hits.all(|k| within(0, k / columns) && within(1, k % columns))
    }

    /// At most the distance from a query to the surface, unless that is empty.
    pub fn distance(&self, query: Vector, level: Level) -> f64 {
        self.shell.distance(query, level)
    }

    /// Bytes held.
    pub fn memory(&self) -> usize {
        self.shell.memory()
            + self.bends.capacity() * size_of::<[[f32; 2]; RINGS]>()
            + self.blocks.capacity() * size_of::<[[u8; 2]; 2]>()
            + self
                .edges
                .iter()
                .map(|list| list.capacity() * size_of::<[Option<Edge>; RINGS]>())
                .sum::<usize>()
    }
}
