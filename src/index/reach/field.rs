//! All cells of a surface, and what they ask of each other.

use super::MARGIN;
use super::cell::{Cell, Shape, angle_factor, relative};
use super::groups::{Groups, View};
use super::raster::Raster;
use crate::bounds::{Vector, add, norm, scaled, sub};
use crate::error::Error;
use crate::index::patch::Patch;
use crate::index::piece::reserved;

/// Cells to each side that count as near, and most of them where cells are long and thin.
const NEAR: usize = 2;
const WIDEST: usize = 12;
/// Bounds less than this are of no use: with it, queries are settled from five diagonals away.
const LEAST: f64 = 0.1;

/// The cells of a surface in rows and columns.
pub struct Field {
    pub size: [usize; 2],
    cells: Vec<Cell>,
    /// Of each row, of each column: how many of the next ones are C1 with it and each other, and of those before.
    smooth: [Vec<[usize; 2]>; 2],
    groups: Groups,
}

impl Field {
    pub fn new(cells: &[Cell], patches: &[Patch], raster: &Raster) -> Result<Self, Error> {
        let size = raster.size();
        let [rows, columns] = raster.starts.each_ref().map(|list| list.len() - 1);
        let mut ordered = reserved(cells.len())?;
        for a in 0..rows {
            let first = raster.starts[0][a] as usize;
            for i in 0..raster.split([a, 0])[0] {
                for b in 0..columns {
                    let [up, across] = raster.split([a, b]);
                    let start = first * size[1] + up * raster.starts[1][b] as usize;
                    ordered.extend_from_slice(&cells[start + i * across..start + (i + 1) * across]);
                }
            }
        }
        // Across the sides of a patch that are no borders the surface is C1.
        let smooth = [0, 1].map(|k| {
            let stride = [columns, 1][k];
            let mut broken = vec![false; size[k] + 1];
            for (patch, &line) in raster.starts[k].iter().enumerate() {
                let at_end = line as usize == size[k];
                broken[line as usize] = at_end || patches[patch * stride].border[2 * k];
            }
            let reach = |at: usize| {
                let before = (0..WIDEST).take_while(|n| !broken[at - n]).count();
                let after = (0..WIDEST).take_while(|n| !broken[at + 1 + n]).count();
                [before, after]
            };
            (0..size[k]).map(reach).collect()
        });
        let mut boxes = reserved(ordered.len())?;
        boxes.extend(ordered.iter().map(|cell: &Cell| cell.bounds));
        let groups = Groups::new(size, boxes)?;
        Ok(Self { size, cells: ordered, smooth, groups })
    }

    /// The bounds of a cell: for queries on the side of its normal, and on the other.
    pub fn bend(&self, place: [usize; 2]) -> [f64; 2] {
        let cell = &self.cells[place[0] * self.size[1] + place[1]];
        let Some(shape) = &cell.shape else { return [f64::INFINITY; 2] };
        let block = self.block(place, cell);
        let view = View {
            from: &cell.bounds,
            axis: shape.normal,
            cone: shape.cone,
            depth: cell.bounds.half[2],
        };
        let mut bend = [LEAST; 2];
        for i in block[0][0]..=block[0][1] {
            for j in block[1][0]..=block[1][1] {
                let other = &self.cells[i * self.size[1] + j];
                let far = view.asked(&other.bounds, bend[0].min(bend[1]));
                if far[0] <= bend[0] && far[1] <= bend[1] {
                    continue;
                }
                let near = self.near(shape, place, [i, j]).unwrap_or([f64::INFINITY; 2]);
                bend = [0, 1].map(|k| bend[k].max(near[k].min(far[k])));
            }
        }
        if bend[0] < f64::INFINITY || bend[1] < f64::INFINITY {
            self.groups.far(&[view], covered(block), &mut bend);
        }
        bend
    }

    /// The bound for the outward conormal of a side in place of the normal, for places on that side of a cell.
    pub fn rim(&self, place: [usize; 2], side: usize) -> f64 {
        let cell = &self.cells[place[0] * self.size[1] + place[1]];
        let Some(shape) = &cell.shape else { return f64::INFINITY };
        let (axis, speed) = shape.conormal(side);
        let k = side / 2;
        let [across, along] = [k, 1 - k].map(|d| norm(shape.tangents[d]));
        // The conormal is perpendicular to the normal and to the tangent of the side.
        let turn = shape.off[1 - k] / (along - 0.5 * shape.off[1 - k]);
        let fall = speed - shape.off[k] - turn * (across + shape.off[k]);
        let cone = (turn + shape.cone) * MARGIN;
        let view = View { from: &cell.bounds, axis, cone, depth: -shape.rims[side] };
        let block = self.block(place, cell);
        let mut bend = LEAST;
        for i in block[0][0]..=block[0][1] {
            for j in block[1][0]..=block[1][1] {
                let other = &self.cells[i * self.size[1] + j];
                let far = view.asked(&other.bounds, bend)[0];
                if far <= bend {
                    continue;
                }
                let near = self.near_rim(shape, place, [i, j], k, fall).unwrap_or(f64::INFINITY);
                bend = bend.max(near.min(far));
            }
        }
        // NaN where the tangents are lost in their error.
        if !(fall > 0.0 && turn >= 0.0) {
            return f64::INFINITY;
        }
        let mut bend = [bend, f64::INFINITY];
        if bend[0] < f64::INFINITY {
            self.groups.far(&[view], covered(block), &mut bend);
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
        place: [usize; 2],
        other: [usize; 2],
        k: usize,
        fall: f64,
    ) -> Option<f64> {
        let (tangents, least, between) = self.between(shape, place, other)?;
        let (mut sizes, mut extent) = ([0.0f64; 3], [0.0f64; 2]);
        for shape in between {
            sizes = [0, 1, 2].map(|n| sizes[n].max(shape.bends[n].size));
        }
        for d in 0..2 {
            for at in place[d].min(other[d])..=place[d].max(other[d]) {
                let mut on = place;
                on[d] = at;
                extent[d] += self.cells[on[0] * self.size[1] + on[1]].shape.as_ref()?.width[d];
            }
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
    fn block(&self, place: [usize; 2], cell: &Cell) -> [[usize; 2]; 2] {
        [0, 1].map(|k| {
            let [before, after] = self.smooth[k][place[k]];
            let ratio = 1.5 * cell.bounds.half[1 - k] / cell.bounds.half[k];
            let wide = (ratio.min(WIDEST as f64) as usize).max(NEAR);
            [place[k] - before.min(wide), place[k] + after.min(wide)]
        })
    }

    /// What a cell across which the surface is C1 asks of the bounds of another; `None` where tangents differ too much
    /// between them.
    ///
    /// For parameters h, k apart: `N.(x - f) = int (1 - t) (N.S_uu h^2 + ..)`, at most half the greatest; and
    /// `|x - f| = |int S_u h + S_v k|`, at least that of the mean tangents less what they are off.
    fn near(&self, shape: &Shape, place: [usize; 2], other: [usize; 2]) -> Option<[f64; 2]> {
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
        place: [usize; 2],
        other: [usize; 2],
    ) -> Option<([Vector; 2], f64, impl Iterator<Item = &Shape>)> {
        let end = self.cells[other[0] * self.size[1] + other[1]].shape.as_ref()?;
        let tangents = [0, 1].map(|k| scaled(add(shape.tangents[k], end.tangents[k]), 0.5));
        let [rows, columns] = [0, 1].map(|k| place[k].min(other[k])..=place[k].max(other[k]));
        let cells = rows.flat_map(move |i| columns.clone().map(move |j| (i, j)));
        let shapes = cells.map(|(i, j)| self.cells[i * self.size[1] + j].shape.as_ref());
        let mut off = [0.0f64; 2];
        for between in shapes.clone() {
            let between = between?;
            for k in 0..2 {
                let apart = norm(sub(between.tangents[k], tangents[k]));
                off[k] = off[k].max(apart + between.off[k]);
            }
        }
        let least = angle_factor(&tangents) - relative(&tangents, &off) * MARGIN;
        (least > 0.0).then(|| (tangents, least, shapes.flatten()))
    }
}

/// Whether rows and columns (first and last) lie in a block.
fn covered(block: [[usize; 2]; 2]) -> impl Fn([usize; 2], [usize; 2]) -> bool {
    let within = move |k: usize, ends: [usize; 2]| block[k][0] <= ends[0] && ends[1] <= block[k][1];
    move |rows, columns| within(0, rows) && within(1, columns)
}
