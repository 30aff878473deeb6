//! The middles of cells, to begin an iteration at the nearest one.

use crate::bounds::Vector;
use crate::error::Error;
use crate::index::piece::reserved;
use crate::simd::{Kernel, Level, Simd};
use crate::tree::Tree;

/// Most cells that are all looked at; of more, those of near pieces.
const MOST: usize = 256;

/// How far a foot on the tangent of a cell may be off, in widths of the cell: a hint that is nearer is better.
const DOUBT: f64 = 0.05;

/// Cells that are looked at together.
const WIDTH: usize = 16;

/// Coordinate by coordinate; what is left of the last ones is infinitely far.
type Block = [[f32; WIDTH]; 3];

/// A cell: the middle of its box, and by which vectors to multiply what is from there to a query to get how far the foot
/// is off along each parameter, in widths of the cell.
pub struct Middle {
    pub center: Vector,
    pub steps: [Vector; 2],
}

/// The middles of all cells.
#[derive(Clone, Debug, Default)]
pub struct Middles {
    blocks: Vec<Block>,
    steps: Vec<[[f32; 3]; 2]>,
}

impl Middles {
    /// Of all cells.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn new(cells: impl ExactSizeIterator<Item = Middle>) -> Result<Self, Error> {
        let count = cells.len();
        let mut blocks: Vec<Block> = reserved(count.div_ceil(WIDTH))?;
        let mut steps = reserved(count)?;
        for (k, cell) in cells.enumerate() {
            if k % WIDTH == 0 {
                blocks.push([[f32::INFINITY; WIDTH]; 3]);
            }
            let block = &mut blocks[k / WIDTH];
            (0..3).for_each(|c| block[c][k % WIDTH] = cell.center[c] as f32);
            steps.push(cell.steps.map(|step| step.map(|x| x as f32)));
        }
        Ok(Self { blocks, steps })
    }

    /// The nearest one, but for the last digits, and the place in it from which to begin, in widths from its start; `None` where
    /// there are too many.
    pub fn nearest(&self, query: Vector, level: Level) -> Option<(usize, [f64; 2])> {
        if self.steps.is_empty() || self.steps.len() > MOST {
            return None;
        }
        let query = query.map(|x| x as f32);
        let at = level.run(Nearest { blocks: &self.blocks, query });
        Some((at, self.place(at, query)))
    }

    /// As [`Self::nearest`], of any number: `cells` tells those of a piece of the tree. Likely the nearest, see [`Tree::seek`].
    pub fn near<C>(
        &self,
        query: Vector,
        tree: &Tree,
        cells: impl Fn(usize) -> C,
    ) -> (usize, [f64; 2])
    where
        C: Iterator<Item = usize>,
    {
        let from = query.map(|x| x as f32);
        let (mut at, mut least) = (0, f32::INFINITY);
        tree.seek(query, |piece| {
            for cell in cells(piece) {
                let square = self.square(cell, from);
                if square < least {
                    (at, least) = (cell, square);
                }
            }
            f64::from(least)
        });
        (at, self.place(at, from))
    }

    fn from(&self, at: usize, query: [f32; 3]) -> [f32; 3] {
        let block = &self.blocks[at / WIDTH];
        [0, 1, 2].map(|c| query[c] - block[c][at % WIDTH])
    }

    fn square(&self, at: usize, query: [f32; 3]) -> f32 {
        let [x, y, z] = self.from(at, query);
        x * x + y * y + z * z
    }

    /// The place in a cell from which to begin, in widths from its start.
    fn place(&self, at: usize, query: [f32; 3]) -> [f64; 2] {
        self.off(at, query)
            .map(|off| if off.is_nan() { 0.5 } else { f64::from(0.5 + off.clamp(-0.5, 0.5)) })
    }

    /// How far the foot on the tangent or tangent plane in the middle of a cell is off, in widths of the cell.
    fn off(&self, at: usize, query: [f32; 3]) -> [f32; 2] {
        let from = self.from(at, query);
        self.steps[at].map(|step| step[0] * from[0] + step[1] * from[1] + step[2] * from[2])
    }

    /// A likely better place than `hint` in a cell of a curve, both in widths from its start: the foot on the tangent in the
    /// middle of the cell. The hint where that foot is elsewhere, or as near as a tangent tells.
    pub fn better(&self, at: usize, query: Vector, hint: f64) -> f64 {
        let [off, _] = self.off(at, query.map(|x| x as f32));
        let foot = 0.5 + f64::from(off);
        let is_better = (0.0..=1.0).contains(&foot) && (foot - hint).abs() > DOUBT;
        if is_better { foot } else { hint }
    }

    /// Bytes held.
    pub fn memory(&self) -> usize {
        self.blocks.capacity() * size_of::<Block>()
            + self.steps.capacity() * size_of::<[[f32; 3]; 2]>()
    }
}

/// Bits of the number of a block.
const BLOCK: u32 = (MOST / WIDTH - 1) as u32;

struct Nearest<'a> {
    blocks: &'a [Block],
    query: [f32; 3],
}

impl Kernel for Nearest<'_> {
    type Out = usize;

    #[inline(always)]
    fn run<S: Simd>(self, _: S) -> usize {
        // Squares as their bits, which have the order of positive numbers, but for the last few: those number the blocks.
        let mut least = [u32::MAX; WIDTH];
        for (k, block) in self.blocks.iter().enumerate() {
            for n in 0..WIDTH {
                let [x, y, z] = [
                    block[0][n] - self.query[0],
                    block[1][n] - self.query[1],
                    block[2][n] - self.query[2],
                ];
                let square = x * x + y * y + z * z;
                let key = (square.to_bits() & !BLOCK) | k as u32;
                least[n] = if key < least[n] { key } else { least[n] };
            }
        }
        let mut best = 0;
        for n in 1..WIDTH {
            if least[n] < least[best] {
                best = n;
            }
        }
        (least[best] & BLOCK) as usize * WIDTH + best
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bounds::Aabb;

    #[test]
    fn the_nearest_middle_is_found_on_every_path() {
        let place = |k: usize| [(k % 7) as f64, (k % 5) as f64, (k / 35) as f64];
        let steps = [[1.0, 0.0, 0.0], [0.0, 0.0, 8.0]];
        let middles = |count| Middles::new((0..count).map(|k| Middle { center: place(k), steps }));
        for count in [1, 15, 16, 17, 250] {
            let middles = middles(count).unwrap();
            for k in 0..count {
                let near = place(k).map(|x| x + 0.125);
                for level in Level::available() {
                    let (found, from) = middles.nearest(near, level).unwrap();
                    assert_eq!((place(found), from), (place(k), [0.625, 1.0]));
                }
            }
        }
        let one = middles(1).unwrap();
        assert_eq!(one.better(0, [0.25, 9.0, 9.0], 0.5), 0.75);
        assert_eq!(one.better(0, [0.25, 9.0, 9.0], 0.74), 0.74);
        for elsewhere in [0.75, f64::NAN, f64::INFINITY] {
            assert_eq!(one.better(0, [elsewhere, 0.0, 0.0], 0.25), 0.25);
        }
        let many = middles(280).unwrap();
        assert!(many.nearest([0.0; 3], Level::detect()).is_none());
        let boxes: Vec<Aabb> = (0..280).map(|k| Aabb { low: place(k), high: place(k) }).collect();
        let tree = Tree::new(&boxes, 8, 35, Level::detect());
        for k in 0..280 {
            let near = place(k).map(|x| x + 0.125);
            let (found, from) = many.near(near, &tree, |piece| piece..piece + 1);
            assert_eq!((place(found), from), (place(k), [0.625, 1.0]));
        }
    }
}
