//! One ray and one cell: the crossing, or the proof that there is none.
//!
//! ```text
//!   once   two or three Newton steps on the patch; at the rim of the cell Krawczyk's interval says in or out
//!   open   a model in the middle of where zeros can be: one evaluation, and the bounds of the second derivatives
//!          none, once: as above      it shrinks: again in the smaller part      else: both halves
//! ```
//!
//! Reference: Krawczyk 1969; Toth 1985.

use super::cell::{Cell, Inverse, Meeting, Zero, inverse};
use super::cells::{Beam, Candidate, Cells, halves};
use crate::bounds::{Vector, cross, dot, norm, scaled, sub};
use crate::index::{SurfaceIndex, position_steps};

/// Most parts of a cell that are looked at for one ray before the search with a tolerance takes over.
const MOST_PARTS: usize = 1024;

/// Part of a patch below which nothing is told apart.
const LEAST_PART: f64 = 1e-12;

/// How far outside its cell, in the patch's unit square, a crossing may come out at most and still be on the cell's rim.
const RIM: f64 = 1e-11;

/// The same as a length, where the patch is run through fast: of the size of the shape.
const RIM_LENGTH: f64 = 1e-12;

/// A step of this share of the cell is the last but one: two digits short of half of a double.
const NEARLY: f64 = 1e-5;

/// A step of this share of the cell is the last.
const LAST: f64 = 1e-7;

/// A part of a patch and its linear model.
struct Part {
    patch: usize,
    area: [f64; 4],
    edges: [Vector; 2],
    bends: [Vector; 3],
    slopes: [f64; 2],
    /// Bound of the rounding of an evaluation.
    error: f64,
}

/// A crossing.
#[derive(Clone, Copy, Debug)]
pub struct Root {
    /// Its patch.
    pub patch: usize,
    /// Its place in the unit square.
    pub at: [f64; 2],
    /// How near the border of the patch it counts as on it.
    pub rim: [f64; 2],
    /// Length along the ray from the beam's origin.
    pub along: f64,
    /// Sine of the angle between ray and surface.
    pub slant: f64,
}

enum Outcome {
    Nothing,
    Crossing(Root),
    Open,
}

/// A ray among the cells of a surface.
pub struct Search<'a> {
    /// The surface.
    pub index: &'a SurfaceIndex,
    /// Its cells.
    pub cells: &'a Cells,
    /// The ray.
    pub beam: &'a Beam,
}

impl Search<'_> {
    /// Hands all crossings with a cell to `take`; false when that could not be decided. `waiting` is memory.
    pub fn cell(
        &self,
        candidate: &Candidate,
        waiting: &mut Vec<[f64; 4]>,
        take: &mut impl FnMut(Root),
    ) -> bool {
        let (rest, cell) = (self.cells.rest(candidate.cell), self.cells.cell(candidate.cell));
        let of = &self.index.patches[rest.patch as usize];
        let base = sub(self.beam.axis.origin, of.center);
        let degree = self.index.degree;
        let seen = if self.index.rational { of.radius + norm(base) } else { of.radius };
        let error = position_steps(degree.s + degree.t) * seen + self.beam.slack + 2.0 * of.spread;
        let part = Part {
            patch: rest.patch as usize,
            area: rest.area,
            edges: cell.edges,
            bends: cell.bends,
            slopes: cell.slopes,
            error,
        };
        if candidate.is_single() {
            match self.settle(&part, base, &candidate.zero) {
                Outcome::Nothing => return true,
                Outcome::Crossing(root) => {
                    take(root);
                    return true;
                }
                Outcome::Open => {}
            }
        } else {
            let r = sub(cell.middle, self.beam.axis.origin);
            if cell.is_beside(&self.beam.axis, r, cell.off + self.beam.slack) {
                return true;
            }
        }
        self.narrow(&part, base, &candidate.zero, rest.most_bent, waiting, take)
    }

    /// Takes the only crossing of a part, or shows that there is none.
    fn settle(&self, part: &Part, base: Vector, zero: &Zero) -> Outcome {
        let axis = &self.beam.axis;
        let Some(inverse) = inverse(axis, &part.edges) else { return Outcome::Open };
        let (middle, half) = middle_and_half(part.area);
        // One step of the quadratic model.
        let [p, q] = zero.at.map(|x| x.clamp(-1.0, 1.0));
        let [aa, ab, bb] = part.bends;
        let e = [0, 1, 2].map(|k| p * p * aa[k] + p * q * ab[k] + q * q * bb[k]);
        let f = axis.across.map(|n| dot(n, e));
        let at = [0, 1].map(|k| {
            let row = inverse.rows[k];
            zero.at[k] - (row[0] * f[0] + row[1] * f[1])
        });
        let is_inside = zero.is_inside();
        // Most of those that come out beside the part are shown to with one value.
        if !is_inside
            && at.iter().any(|x| x.abs() > 1.0)
            && self.is_outside(part, base, &inverse, at.map(|x| x.clamp(-1.0, 1.0)), zero.deviation)
        {
            return Outcome::Nothing;
        }
        let start = [0, 1].map(|k| middle[k] + half[k] * at[k]);
        let Some(root) = self.newton(part.patch, base, start, half) else { return Outcome::Open };
        let x = [0, 1].map(|k| (root.at[k] - middle[k]) / half[k]);
        if (0..2).all(|k| x[k].abs() <= 1.0 + root.rim[k] / half[k]) {
            return Outcome::Crossing(root);
        }
        let edge = x.map(|x| x.clamp(-1.0, 1.0));
        if !is_inside && self.is_outside(part, base, &inverse, edge, zero.deviation) {
            return Outcome::Nothing;
        }
        Outcome::Open
    }

    /// Whether no zero is in the part, seen from a place y on its rim. With `r = Y F(y)` every zero z of the part has
    /// `|zi - yi + ri| <= |Yi| m` with `m = sa |z1 - y1| + sb |z2 - y2|`, so that `m <= (sa |r1| + sb |r2|) / (1 - deviation)`.
    fn is_outside(
        &self,
        part: &Part,
        base: Vector,
        inverse: &Inverse,
        edge: [f64; 2],
        deviation: f64,
    ) -> bool {
        let (middle, half) = middle_and_half(part.area);
        let at = [0, 1].map(|k| middle[k] + half[k] * edge[k]);
        let d = self.index.net(part.patch).vector(at[0], at[1], base);
        let f = self.beam.axis.across.map(|n| dot(n, d));
        let r = inverse.rows.map(|row| row[0] * f[0] + row[1] * f[1]);
        let sum = part.slopes[0] * r[0].abs() + part.slopes[1] * r[1].abs();
        // The rounding of F moves r by as much in each row: both terms of the sum, and the row itself.
        let most = (sum + deviation * part.error) / (1.0 - deviation) + part.error;
        (0..2).any(|k| {
            let (z, spread) = (edge[k] - r[k], inverse.lengths[k] * most + inverse.rounding);
            z - spread > 1.0 || z + spread < -1.0
        })
    }

    /// Looks at smaller and smaller parts of a cell.
    fn narrow(
        &self,
        whole: &Part,
        base: Vector,
        zero: &Zero,
        most_bent: [f64; 3],
        waiting: &mut Vec<[f64; 4]>,
        take: &mut impl FnMut(Root),
    ) -> bool {
        let axis = &self.beam.axis;
        let (_, full) = middle_and_half(whole.area);
        let degrees = (self.index.degree.s + self.index.degree.t) as f64;
        waiting.clear();
        waiting.push(reached(whole.area, zero));
        for _ in 0..MOST_PARTS {
            let Some(area) = waiting.pop() else { return true };
            let (middle, half) = middle_and_half(area);
            if half[0] < LEAST_PART && half[1] < LEAST_PART {
                return false;
            }
            let jet = self.index.net(whole.patch).slopes(middle[0], middle[1], base);
            let share = [half[0] / full[0], half[1] / full[1]];
            let square = [share[0] * share[0], share[0] * share[1], share[1] * share[1]];
            let bent = [0, 1, 2].map(|k| most_bent[k] * square[k]);
            let rounding = [0, 1].map(|k| 2.0 * degrees * whole.error * half[k]);
            let edges = [scaled(jet.s, half[0]), scaled(jet.t, half[1])];
            let lengths = edges.map(norm);
            let cell = Cell {
                middle: jet.d,
                edges,
                bends: [0, 1, 2].map(|k| scaled(whole.bends[k], square[k])),
                most_bent,
                off: 0.5 * bent[0] + bent[1] + 0.5 * bent[2] + whole.error,
                slopes: [bent[0] + bent[1] + rounding[0], bent[1] + bent[2] + rounding[1]],
                gains: [
                    bent[0] / lengths[0] + bent[1] / lengths[1],
                    bent[1] / lengths[0] + bent[2] / lengths[1],
                ],
            };
            let zero = match cell.meet(axis, jet.d, 0.0) {
                Meeting::None => continue,
                Meeting::Once(zero) => {
                    let Cell { edges, bends, slopes, .. } = cell;
                    let part = Part { area, edges, bends, slopes, ..*whole };
                    match self.settle(&part, base, &zero) {
                        Outcome::Nothing => continue,
                        Outcome::Crossing(root) => {
                            take(root);
                            continue;
                        }
                        Outcome::Open => Some(zero),
                    }
                }
                Meeting::Open(zero) => Some(zero),
                Meeting::Grazing => None,
            };
            let smaller = zero.map_or(area, |zero| reached(area, &zero));
            let (_, left) = middle_and_half(smaller);
            if left[0] * left[1] < 0.5 * half[0] * half[1] {
                waiting.push(smaller);
                continue;
            }
            waiting.extend(halves(&cell, smaller));
        }
        waiting.is_empty()
    }

    /// The zero near a start in the patch's unit square.
    fn newton(&self, patch: usize, base: Vector, start: [f64; 2], half: [f64; 2]) -> Option<Root> {
        let (net, axis) = (self.index.net(patch), &self.beam.axis);
        let mut x = start;
        for _ in 0..8 {
            let jet = net.slopes(x[0], x[1], base);
            let j = axis.across.map(|n| [dot(n, jet.s), dot(n, jet.t)]);
            let det = j[0][0] * j[1][1] - j[0][1] * j[1][0];
            let step_at = |d: Vector| {
                let f = axis.across.map(|n| dot(n, d));
                [(j[0][1] * f[1] - j[1][1] * f[0]) / det, (j[1][0] * f[0] - j[0][0] * f[1]) / det]
            };
            let moved = |d: Vector, step: [f64; 2]| {
                [0, 1, 2].map(|c| d[c] + step[0] * jet.s[c] + step[1] * jet.t[c])
            };
            let step = step_at(jet.d);
            let size = (step[0] / half[0]).abs().max((step[1] / half[1]).abs());
            if !(step[0].is_finite() && step[1].is_finite() && size <= 8.0) {
                return None;
            }
            x = [x[0] + step[0], x[1] + step[1]];
            if size > NEARLY {
                continue;
            }
            let mut d = moved(jet.d, step);
            if size > LAST {
                // The slopes are good enough for one more step.
                let there = net.vector(x[0], x[1], base);
                let step = step_at(there);
                x = [x[0] + step[0], x[1] + step[1]];
                d = moved(there, step);
            }
            let slant = det.abs() / norm(cross(jet.s, jet.t));
            let rim = [jet.s, jet.t].map(|slope| (RIM_LENGTH / norm(slope)).clamp(1e-15, RIM));
            return Some(Root { patch, at: x, rim, along: dot(d, axis.direction), slant });
        }
        None
    }
}

fn middle_and_half([s0, s1, t0, t1]: [f64; 4]) -> ([f64; 2], [f64; 2]) {
    ([0.5 * (s0 + s1), 0.5 * (t0 + t1)], [0.5 * (s1 - s0), 0.5 * (t1 - t0)])
}

/// The part of an area where zeros can be.
fn reached(area: [f64; 4], zero: &Zero) -> [f64; 4] {
    let (middle, half) = middle_and_half(area);
    let mut out = area;
    for k in 0..2 {
        let (low, high) = (zero.at[k] - zero.reach[k], zero.at[k] + zero.reach[k]);
        if low > -1.0 {
            out[2 * k] = area[2 * k].max(middle[k] + half[k] * low - RIM);
        }
        if high < 1.0 {
            out[2 * k + 1] = area[2 * k + 1].min(middle[k] + half[k] * high + RIM);
        }
    }
    out
}
