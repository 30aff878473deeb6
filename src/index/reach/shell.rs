//! The boxes around all cells, looked at together: which of them come near a query.

use super::oriented::Oriented;
use crate::bounds::Vector;
use crate::error::Error;
use crate::index::piece::reserved;
use crate::simd::{Kernel, Level, Simd};

/// Most cells that are all looked at.
pub const MOST: usize = 256;

/// Boxes that are looked at together.
pub const WIDTH: usize = 16;

/// What rounding to single precision takes of a distance, relative to the query's and the shape's size: 64 of its units.
const ROUNDING: f64 = 4e-6;

/// Middles, axes one after the other, half the widths: number by number. What is left of the last ones is far away.
type Block = [[f32; WIDTH]; 15];

/// How far, so that squares do not overflow.
const NOWHERE: f32 = 1e18;

/// The boxes.
#[derive(Clone, Debug, Default)]
pub struct Shell {
    blocks: Vec<Block>,
}

/// Of lane n, bit k: whether cell `16 k + n` is meant.
#[derive(Clone, Copy, Debug, Default)]
pub struct Hits([u32; WIDTH]);

impl Hits {
    /// The numbers of the cells.
    pub fn cells(self) -> impl Iterator<Item = usize> {
        self.0.into_iter().enumerate().flat_map(|(lane, mut bits)| {
            std::iter::from_fn(move || {
                let block = bits.trailing_zeros() as usize;
                bits &= bits.wrapping_sub(1);
                (block < u32::BITS as usize).then_some(block * WIDTH + lane)
            })
        })
    }
}

impl Shell {
    /// Around all cells; empty when there are too many.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn new<'a>(boxes: impl ExactSizeIterator<Item = &'a Oriented>) -> Result<Self, Error> {
        let count = boxes.len();
        if count > MOST {
            return Ok(Self::default());
        }
        let mut blocks: Vec<Block> = reserved(count.div_ceil(WIDTH))?;
        for (k, cell) in boxes.enumerate() {
            if k % WIDTH == 0 {
                let mut empty = [[0.0; WIDTH]; 15];
                (0..3).for_each(|c| empty[c] = [NOWHERE; WIDTH]);
                (0..3).for_each(|c| empty[3 + 4 * c] = [1.0; WIDTH]);
                blocks.push(empty);
            }
            let block = &mut blocks[k / WIDTH];
            for c in 0..3 {
                block[c][k % WIDTH] = cell.center[c] as f32;
                block[12 + c][k % WIDTH] = ((cell.half[c] * super::MARGIN) as f32).next_up();
                for d in 0..3 {
                    block[3 + 3 * c + d][k % WIDTH] = cell.axes[c][d] as f32;
                }
            }
        }
        Ok(Self { blocks })
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.blocks.is_empty()
    }

    /// The cells that may come within `reach` of a query.
    pub fn hits(&self, query: Vector, reach: f64, level: Level) -> Hits {
        let reach = reach + rounding(query);
        // In single precision, rounded up by some units.
        let limit = (reach * reach * (1.0 + 1e-6)) as f32;
        Hits(level.run(Near { blocks: &self.blocks, query: query.map(|x| x as f32), limit }))
    }

    /// At most the distance from a query to the nearest.
    pub fn distance(&self, query: Vector, level: Level) -> f64 {
        let square = level.run(Least { blocks: &self.blocks, query: query.map(|x| x as f32) });
        let distance = f64::from(square).sqrt() * (1.0 - 1e-6) - rounding(query);
        // Not where squares overflow.
        if distance.is_finite() { distance.max(0.0) } else { 0.0 }
    }

    /// Bytes held.
    pub fn memory(&self) -> usize {
        self.blocks.capacity() * size_of::<Block>()
    }
}

fn rounding(query: Vector) -> f64 {
    ROUNDING * (4.0 + query.iter().map(|x| x.abs()).sum::<f64>())
}

/// Squares of the distances from the boxes of a block.
#[inline(always)]
fn squares(block: &Block, query: [f32; 3]) -> [f32; WIDTH] {
    let mut out = [0.0; WIDTH];
    for n in 0..WIDTH {
        let (x, y, z) = (query[0] - block[0][n], query[1] - block[1][n], query[2] - block[2][n]);
        let mut sum = 0.0;
        for c in 0..3 {
            let axis = 3 + 3 * c;
            let along = x * block[axis][n] + y * block[axis + 1][n] + z * block[axis + 2][n];
            let gap = along.abs() - block[12 + c][n];
            let gap = if gap > 0.0 { gap } else { 0.0 };
            sum += gap * gap;
        }
        out[n] = sum;
    }
    out
}

struct Near<'a> {
    blocks: &'a [Block],
    query: [f32; 3],
    limit: f32,
}

impl Kernel for Near<'_> {
    type Out = [u32; WIDTH];

    #[inline(always)]
    fn run<S: Simd>(self, _: S) -> [u32; WIDTH] {
        let mut hits = [0; WIDTH];
        for (k, block) in self.blocks.iter().enumerate() {
            let squares = squares(block, self.query);
            for n in 0..WIDTH {
                // Also what is no number.
                let far = u32::from(squares[n] > self.limit);
                hits[n] |= (1 - far) << k;
            }
        }
        hits
    }
}

struct Least<'a> {
    blocks: &'a [Block],
    query: [f32; 3],
}

impl Kernel for Least<'_> {
    type Out = f32;

    #[inline(always)]
    fn run<S: Simd>(self, _: S) -> f32 {
        let mut least = [f32::INFINITY; WIDTH];
        for block in self.blocks {
            let squares = squares(block, self.query);
            for n in 0..WIDTH {
                least[n] = if squares[n] < least[n] { squares[n] } else { least[n] };
            }
        }
        let mut all = least[0];
        for n in 1..WIDTH {
            all = if least[n] < all { least[n] } else { all };
        }
        all
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bounds::{add, cross, dot, norm, scaled, sub};

    fn number(seed: usize) -> f64 {
        2.0 * ((seed as f64 + 1.0) * 0.618_033_988_749_895).fract() - 1.0
    }

    fn boxes(count: usize) -> Vec<Oriented> {
        let vector = |k: usize| [0, 1, 2].map(|c| number(3 * k + c));
        let around = |k: usize| {
            let a = scaled(vector(k), 1.0 / norm(vector(k)));
            let b = cross(a, vector(k + 7777));
            let b = scaled(b, 1.0 / norm(b));
            let ends = [0.05, -0.03, 0.001].map(|x| x * (1.0 + number(k).abs()));
            let corner = |s: f64, t: f64| {
                let rise = scaled(cross(a, b), s * t * ends[2]);
                add(add(vector(k + 991), rise), add(scaled(a, s * ends[0]), scaled(b, t * ends[1])))
            };
            let corners = [corner(0.0, 0.0), corner(0.0, 1.0), corner(1.0, 0.0), corner(1.0, 1.0)];
            Oriented::around(corners.into_iter(), [a, b, cross(a, b)], 1e-15)
        };
        (0..count).map(around).collect()
    }

    fn distance(cell: &Oriented, query: Vector) -> f64 {
        let way = sub(query, cell.center);
        let gap = |k: usize| (dot(way, cell.axes[k]).abs() - cell.half[k]).max(0.0);
        norm([0, 1, 2].map(gap))
    }

    #[test]
    fn nothing_near_is_overlooked_on_any_level() {
        for count in [1, 15, 16, 17, 100, MOST] {
            let boxes = boxes(count);
            let shell = Shell::new(boxes.iter()).unwrap();
            for n in 0..40 {
                let size = [1.0, 1e-3, 1e3, 1e18, 1e200][n % 5];
                let query = [0, 1, 2].map(|c| size * number(5000 + 3 * n + c));
                let all: Vec<f64> = boxes.iter().map(|cell| distance(cell, query)).collect();
                let least = all.iter().fold(f64::INFINITY, |least: f64, x| least.min(*x));
                for reach in [0.0, least, 1.5 * least, f64::INFINITY] {
                    let mut first: Option<(Vec<usize>, u64)> = None;
                    for level in Level::available() {
                        let hits: Vec<usize> = shell.hits(query, reach, level).cells().collect();
                        let near = shell.distance(query, level);
                        assert!(
                            near <= least && (size > 1.0 || near > least - 1e-4),
                            "{near} {least}"
                        );
                        for (k, distance) in all.iter().enumerate() {
                            assert!(
                                *distance > reach || hits.contains(&k),
                                "{k} of {count} at {query:?}"
                            );
                        }
                        // And little else.
                        let others = hits.iter().filter(|&&k| k < count && all[k] > reach + 1e-4);
                        assert!(size > 1.0 || others.count() == 0);
                        let answer = (hits, near.to_bits());
                        assert_eq!(first.get_or_insert(answer.clone()), &answer);
                    }
                }
            }
        }
        let none = Shell::new(boxes(MOST + 1).iter()).unwrap();
        assert!(none.is_empty() && none.memory() == 0);
    }
}
