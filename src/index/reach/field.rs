//! All cells of a surface, and what they ask of each other.

use super::MARGIN;
use super::cell::{Cell, Shape, angle_factor, relative};
use super::edge::Edge;
use super::groups::{Groups, View};
use super::joints::Joints;
use super::middles::Middle;
use super::oriented::Oriented;
use super::raster::Raster;
use crate::bounds::{Vector, add, norm, scaled, sub};
use crate::error::Error;
use crate::index::piece::reserved;

/// Cells to each side that count as near, and most of them where cells are long and thin.
const NEAR: usize = 2;
pub const WIDEST: usize = 12;
/// Rings around a cell: itself, those beside it, all that are near.
pub const RINGS: usize = 3;
/// Least of `|x - f|`, relative to what the tangents say, up to which cells count as near where there are kinks.
pub const STRAIGHT: f64 = 0.25;
/// Bounds less than this are of no use: with it, queries are settled from five diagonals away.
const LEAST: f64 = 0.1;

/// Rows and columns from one to another, first and last; beyond a seam that is none they are counted on.
type Block = [[isize; 2]; 2];

/// The cells of a surface in rows and columns.
pub struct Field {
    pub size: [usize; 2],
    cells: Vec<Cell>,
    /// Of each row, of each column: how many of the next ones are C1 with it and each other, and of those before.
    smooth: [Vec<[usize; 2]>; 2],
    groups: Groups,
    /// See [`STRAIGHT`].
    straight: f64,
}

impl Field {
    pub fn new(cells: Vec<Cell>, raster: &Raster, joints: &Joints) -> Result<Self, Error> {
        let size = raster.size();
        let ordered = Self::ordered(cells, raster, joints)?;
        let smooth = [0, 1].map(|k| {
            let (n, mut broken) = (size[k], vec![false; size[k] + 1]);
            for (&line, smooth) in raster.starts[k].iter().zip(&joints.smooth[k]) {
                broken[line as usize] = !smooth;
            }
            let most = WIDEST.min(n - 1);
            let reach = |at: usize| {
                // Line n is line 0, and beyond it only where both are smooth.
                let before = (0..most).take_while(|m| !broken[(at + n - m) % n]).count();
                let after = (0..most).take_while(|m| !broken[(at + m) % n + 1]).count();
                [before, after]
            };
            (0..n).map(reach).collect()
        });
        let mut boxes = reserved(ordered.len())?;
        boxes.extend(ordered.iter().map(|cell: &Cell| cell.bounds));
        let groups = Groups::new(size, boxes)?;
        let straight = if joints.kink > 0.0 { STRAIGHT } else { 0.0 };
        Ok(Self { size, cells: ordered, smooth, groups, straight })
    }

    /// The cells of all patches row by row, their parameters stretched.
    fn ordered(cells: Vec<Cell>, raster: &Raster, joints: &Joints) -> Result<Vec<Cell>, Error> {
        let size = raster.size();
        let [rows, columns] = raster.starts.each_ref().map(|list| list.len() - 1);
        if size == [rows, columns] && joints.stretch.iter().flatten().all(|by| *by == 1.0) {
            return Ok(cells);
        }
        let mut ordered: Vec<Cell> = reserved(cells.len())?;
        for a in 0..rows {
            let first = raster.starts[0][a] as usize;
            for i in 0..raster.split([a, 0])[0] {
                for b in 0..columns {
                    let [up, across] = raster.split([a, b]);
                    let start = first * size[1] + up * raster.starts[1][b] as usize;
                    let stretch = [joints.stretch[0][a], joints.stretch[1][b]];
                    let list = &cells[start + i * across..start + (i + 1) * across];
                    ordered.extend(list.iter().map(|cell| cell.stretched(stretch)));
                }
            }
        }
        Ok(ordered)
    }

    /// A cell, counted on beyond a seam.
    fn cell(&self, place: [isize; 2]) -> &Cell {
        // At most one time around; a division takes longer than all else here.
        let around = |k: usize| {
            let (at, size) = (place[k], self.size[k] as isize);
            (if at < 0 {
                at + size
            } else if at >= size {
                at - size
            } else {
                at
            }) as usize
        };
        &self.cells[around(0) * self.size[1] + around(1)]
    }

    /// Where to begin in each cell.
    pub fn middles(&self) -> impl ExactSizeIterator<Item = Middle> + '_ {
        self.cells.iter().map(|cell| {
            let steps = cell.shape.as_ref().map_or_else(Default::default, Shape::steps);
            Middle { center: cell.bounds.center, steps }
        })
    }

    /// The bounds of a cell: for queries on the side of its normal, and on the other.
    pub fn bend(&self, place: [usize; 2]) -> [f64; 2] {
        let place = place.map(|x| x as isize);
        let cell = self.cell(place);
        let Some(shape) = &cell.shape else { return [f64::INFINITY; 2] };
        let block = self.block(place, cell);
        let from = &cell.bounds;
        let view = View { axis: shape.normal, cone: shape.cone, depth: from.half[2] };
        let mut bend = [LEAST; 2];
        for i in block[0][0]..=block[0][1] {
            for j in block[1][0]..=block[1][1] {
                let other = self.cell([i, j]);
                let seen = from.seen(&other.bounds, bend[0].min(bend[1]));
                let far = view.asked(&other.bounds, seen);
                if far[0] <= bend[0] && far[1] <= bend[1] {
                    continue;
                }
                let near = self.near(shape, place, [i, j]).unwrap_or([f64::INFINITY; 2]);
                bend = [0, 1].map(|k| bend[k].max(near[k].min(far[k])));
            }
        }
        if bend[0] < f64::INFINITY || bend[1] < f64::INFINITY {
            self.groups.far(from, &[view], self.covered(block), &mut bend);
        }
        bend
    }

    /// The boxes of all cells, row by row.
    pub fn boxes(&self) -> impl ExactSizeIterator<Item = &Oriented> {
        self.cells.iter().map(|cell| &cell.bounds)
    }

    /// Some boxes around groups of cells, `most` at most, in which all lie.
    pub fn few_boxes(&self, most: usize) -> &[Oriented] {
        self.groups.few(most)
    }

    /// Cells to each side that a ring has, at most.
    pub fn wide(ring: usize) -> usize {
        [0, 1, WIDEST][ring]
    }

    /// How many rows before and after a cell, columns before and after it are near.
    pub fn around(&self, place: [usize; 2]) -> [[usize; 2]; 2] {
        let place = place.map(|x| x as isize);
        let block = self.block(place, self.cell(place));
        [0, 1].map(|k| [place[k] - block[k][0], block[k][1] - place[k]].map(|n| n as usize))
    }

    /// The cell at place `n` along a side of the surface.
    pub fn on_side(&self, n: usize, side: usize) -> [usize; 2] {
        let mut place = [n; 2];
        place[side / 2] = if side.is_multiple_of(2) { 0 } else { self.size[side / 2] - 1 };
        place
    }

    /// The bounds of a cell against the cells of each ring and those within, as [`Self::bend`].
    pub fn rings(&self, place: [usize; 2]) -> [[f64; 2]; RINGS] {
        let place = place.map(|x| x as isize);
        let cell = self.cell(place);
        let Some(shape) = &cell.shape else { return [[f64::INFINITY; 2]; RINGS] };
        let (block, mut most, mut inner) = (self.block(place, cell), [0.0f64; 2], None);
        std::array::from_fn(|ring| {
            let wide = Self::wide(ring) as isize;
            for other in Self::ring(block, place, (inner, wide)) {
                if most.iter().any(|x| *x < f64::INFINITY) {
                    let asked = self.near(shape, place, other).unwrap_or([f64::INFINITY; 2]);
                    most = [0, 1].map(|k| most[k].max(asked[k]));
                }
            }
            inner = Some(wide);
            most
        })
    }

    /// What is around a cell on a side of the surface, for each ring and those within.
    pub fn edges(&self, place: [usize; 2]) -> [Option<Edge>; RINGS] {
        let place = place.map(|x| x as isize);
        let cell = self.cell(place);
        let Some(shape) = &cell.shape else { return [None; RINGS] };
        let (mut bends, mut extents, mut least) = (Vec::new(), [0.0f64; 2], [f64::INFINITY; 2]);
        let mut is_known = true;
        let block = self.block(place, cell);
        let mut inner = None;
        std::array::from_fn(|ring| {
            let wide = Self::wide(ring) as isize;
            for other in Self::ring(block, place, (inner, wide)) {
                let found = if is_known { self.between(shape, place, other) } else { None };
                let Some((tangents, factor, _)) = found else {
                    is_known = false;
                    break;
                };
                for k in 0..2 {
                    let speed = factor * norm(tangents[k]) * shape.width[k];
                    least[k] = least[k].min(speed * speed);
                    extents[k] = extents[k].max(self.extent(place, other, k)? / shape.width[k]);
                }
                bends.push(self.cell(other).shape.as_ref()?.bends);
            }
            inner = Some(wide);
            is_known.then(|| Edge::new(&bends, shape.width, extents, least))
        })
    }

    /// How far places of a cell and of another may be apart in direction `k`, in the surface's parameters.
    fn extent(&self, place: [isize; 2], other: [isize; 2], k: usize) -> Option<f64> {
        let mut sum = 0.0;
        for at in place[k].min(other[k])..=place[k].max(other[k]) {
            let mut on = place;
            on[k] = at;
            sum += self.cell(on).shape.as_ref()?.width[k];
        }
        Some(sum)
    }

    /// The places of a block farther from one than the inner ring (if there is one), up to a wider one.
    fn ring(
        block: Block,
        place: [isize; 2],
        (inner, wide): (Option<isize>, isize),
    ) -> impl Iterator<Item = [isize; 2]> {
        let range =
            move |k: usize| block[k][0].max(place[k] - wide)..=block[k][1].min(place[k] + wide);
        range(0).flat_map(move |i| range(1).map(move |j| [i, j])).filter(move |at| {
            let apart = (at[0] - place[0]).abs().max((at[1] - place[1]).abs());
            inner.is_none_or(|inner| apart > inner)
        })
    }

    /// The bound for the outward conormal of a side in place of the normal, for places on that side of a cell.
    pub fn rim(&self, place: [usize; 2], side: usize) -> f64 {
        let place = place.map(|x| x as isize);
        let cell = self.cell(place);
        let rim = cell.shape.as_ref().and_then(|shape| Rim::new(shape, side));
        let Some(Rim { shape, fall, view }) = rim else { return f64::INFINITY };
        let (from, k) = (&cell.bounds, side / 2);
        let block = self.block(place, cell);
        let mut bend = LEAST;
        for i in block[0][0]..=block[0][1] {
            for j in block[1][0]..=block[1][1] {
                let other = self.cell([i, j]);
                let far = view.asked(&other.bounds, from.seen(&other.bounds, bend))[0];
                if far <= bend {
                    continue;
                }
                let near = self.near_rim(shape, place, [i, j], k, fall).unwrap_or(f64::INFINITY);
                bend = bend.max(near.min(far));
            }
        }
        let mut bend = [bend, f64::INFINITY];
        if bend[0] < f64::INFINITY {
            self.groups.far(from, &[view], self.covered(block), &mut bend);
        }
        bend[0]
    }

    /// As [`Self::near`] for the conormal of a side across direction `k`, along which the surface falls by `fall` at least.
    ///
    /// `o.(x - f) <= -fall k + (L h^2 + 2 M h k + I k^2) / 2` for h along the side and k across, and while `fall` is more than
    /// `M h + I k / 2` only the first square is left.
    fn near_rim(
        &self,
        shape: &Shape,
        place: [isize; 2],
        other: [isize; 2],
        k: usize,
        fall: f64,
    ) -> Option<f64> {
        let (tangents, least, between) = self.between(shape, place, other)?;
        let (mut sizes, mut extent) = ([0.0f64; 3], [0.0f64; 2]);
        for shape in between {
            sizes = [0, 1, 2].map(|n| sizes[n].max(shape.bends[n].size));
        }
        for (d, extent) in extent.iter_mut().enumerate() {
            *extent = self.extent(place, other, d)?;
        }
        let speeds = tangents.map(norm);
        let (first, mixed, last) = (sizes[2 - 2 * k], sizes[1], sizes[2 * k]);
        let first = first / (speeds[1 - k] * speeds[1 - k]);
        let greatest = if fall >= (mixed * extent[1 - k] + 0.5 * last * extent[k]) * MARGIN {
            first
        } else {
            let (mixed, last) = (mixed / (speeds[0] * speeds[1]), last / (speeds[k] * speeds[k]));
            let half = 0.5 * (first - last);
            0.5 * (first + last) + (half * half + mixed * mixed).sqrt()
        };
        Some(0.5 * greatest / (least * least) * MARGIN)
    }

    /// Rows and columns around a place that count as near and across which the surface is C1: first and last.
    fn block(&self, place: [isize; 2], cell: &Cell) -> Block {
        [0, 1].map(|k| {
            let [before, after] = self.smooth[k][place[k] as usize];
            let ratio = 1.5 * cell.bounds.half[1 - k] / cell.bounds.half[k];
            let wide = (ratio.min(WIDEST as f64) as usize).max(NEAR);
            [place[k] - before.min(wide) as isize, place[k] + after.min(wide) as isize]
        })
    }

    /// What a cell across which the surface is C1 asks of the bounds of another; `None` where tangents differ too much
    /// between them.
    ///
    /// For parameters h, k apart: `N.(x - f) = int (1 - t) (N.S_uu h^2 + ..)`, at most half the greatest; and
    /// `|x - f| = |int S_u h + S_v k|`, at least that of the mean tangents less what they are off.
    fn near(&self, shape: &Shape, place: [isize; 2], other: [isize; 2]) -> Option<[f64; 2]> {
        let (tangents, least, between) = self.between(shape, place, other)?;
        let mut along = [[f64::INFINITY, f64::NEG_INFINITY]; 3];
        for other in between {
            let turned = shape.cone + norm(sub(other.normal, shape.normal));
            for (along, bend) in along.iter_mut().zip(&other.bends) {
                let aside = turned * bend.size;
                let [low, high] = [bend.along[0] - aside, bend.along[1] + aside];
                *along = [along[0].min(low), along[1].max(high)];
            }
        }
        let [u, v] = tangents.map(norm);
        let mixed = along[1][1].max(-along[1][0]).max(0.0) / (u * v);
        let side = |a: f64, c: f64| {
            let (a, c) = (a / (u * u), c / (v * v));
            let greatest = 0.5 * (a + c) + (0.25 * (a - c) * (a - c) + mixed * mixed).sqrt();
            (0.5 * greatest / (least * least) * MARGIN).max(0.0)
        };
        Some([side(along[0][1], along[2][1]), side(-along[0][0], -along[2][0])])
    }

    /// The cells of the rectangle from a place to another: their mean tangents, the least of `|x - f|` relative to
    /// `|(h |S_u|, k |S_v|)|` there, and the shapes. `None` where tangents differ too much.
    fn between(
        &self,
        shape: &Shape,
        place: [isize; 2],
        other: [isize; 2],
    ) -> Option<([Vector; 2], f64, impl Iterator<Item = &Shape>)> {
        let end = self.cell(other).shape.as_ref()?;
        let tangents = [0, 1].map(|k| scaled(add(shape.tangents[k], end.tangents[k]), 0.5));
        let [rows, columns] = [0, 1].map(|k| place[k].min(other[k])..=place[k].max(other[k]));
        let cells = rows.flat_map(move |i| columns.clone().map(move |j| (i, j)));
        let shapes = cells.map(|(i, j)| self.cell([i, j]).shape.as_ref());
        let mut off = [0.0f64; 2];
        for between in shapes.clone() {
            let between = between?;
            for k in 0..2 {
                let apart = norm(sub(between.tangents[k], tangents[k]));
                off[k] = off[k].max(apart + between.off[k]);
            }
        }
        let least = angle_factor(&tangents) - relative(&tangents, &off) * MARGIN;
        (least > self.straight).then(|| (tangents, least, shapes.flatten()))
    }

    /// Whether rows and columns (first and last) lie in a block.
    fn covered(&self, block: Block) -> impl Fn([usize; 2], [usize; 2]) -> bool {
        let size = self.size;
        let within = move |k: usize, [first, last]: [usize; 2]| {
            let [low, high] = block[k];
            let from = (first as isize - low).rem_euclid(size[k] as isize);
            from + (last - first) as isize <= high - low
        };
        move |rows, columns| within(0, rows) && within(1, columns)
    }
}

/// A side of a cell of the surface.
struct Rim<'a> {
    shape: &'a Shape,
    /// How fast the surface falls along the outward conormal, going inward, at least.
    fall: f64,
    view: View,
}

impl<'a> Rim<'a> {
    /// `None` where the tangents are lost in their error.
    fn new(shape: &'a Shape, side: usize) -> Option<Self> {
        let (axis, speed) = shape.conormal(side);
        let k = side / 2;
        let [across, along] = [k, 1 - k].map(|d| norm(shape.tangents[d]));
        // The conormal is perpendicular to the normal and to the tangent of the side.
        let turn = shape.off[1 - k] / (along - 0.5 * shape.off[1 - k]);
        let fall = speed - shape.off[k] - turn * (across + shape.off[k]);
        let cone = (turn + shape.cone) * MARGIN;
        let view = View { axis, cone, depth: -shape.rims[side] };
        (fall > 0.0 && turn >= 0.0).then_some(Self { shape, fall, view })
    }
}
