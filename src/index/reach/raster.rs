//! The grid of cells: how finely each row and column of patches is cut.

use crate::bounds::{norm, sub};
use crate::surface::Surface;

/// Cells of one direction of a patch, at most.
const MOST_SPLIT: usize = 16;
/// Cells of a surface, at most, unless it has more patches.
const CELLS: usize = 144;

/// Change of the tangents in a cell that is aimed at, relative to their lengths, and the factor by which it grows while the
/// cells are too many.
const CHANGE: f64 = 0.125;
const COARSER: f64 = 1.25;

/// A greater change says nothing of the tangents of arcs any more, so that rational patches may have more cells: so many each.
const COARSEST: f64 = 0.4;
const MORE: [usize; 2] = [48, 1024];

/// Patches of a row or column of patches that are looked at.
const SAMPLES: usize = 16;

/// Cells beside a line where the surface is not C1.
const CREASED: f64 = 4.0;

/// The cells of all patches as a grid: for rows and columns of patches, the first row or column of cells, and the end.
#[derive(Clone, Debug, Default)]
pub struct Raster {
    pub(super) starts: [Vec<u32>; 2],
}

impl Raster {
    /// For a surface whose patches lie in the given knot spans of u and v: finer where tangents change.
    pub fn new(surface: &Surface, spans: [&[usize]; 2]) -> Self {
        let mut changes = changes(surface, spans);
        let closed = [surface.is_closed_u(), surface.is_closed_v()];
        for (k, knots) in [surface.knots_u(), surface.knots_v()].into_iter().enumerate() {
            for (change, &span) in changes[k].iter_mut().zip(spans[k]) {
                // Beside a line where the surface is not C1 nothing is settled: that strip should be narrow.
                let ends = [knots.values()[span], knots.values()[span + 1]];
                let (first, last) = knots.domain();
                let broken = |u: f64| {
                    if u == first || u == last { closed[k] } else { knots.breaks_at(u) }
                };
                if ends.into_iter().any(broken) {
                    *change = change.max(CREASED * CHANGE);
                }
            }
        }
        let most = CELLS.max(spans[0].len() * spans[1].len());
        let more = (MORE[0] * spans[0].len() * spans[1].len()).min(MORE[1]);
        let mut aim = CHANGE;
        loop {
            let splits = changes
                .each_ref()
                .map(|list| list.iter().map(|change| split(*change, aim)).collect::<Vec<usize>>());
            let [rows, columns] = splits.each_ref().map(|list| list.iter().sum::<usize>());
            let most = if surface.is_rational() && aim > COARSEST { most.max(more) } else { most };
            if rows * columns <= most || splits.iter().flatten().all(|&n| n == 1) {
                return Self { starts: splits.map(|list| starts(&list)) };
            }
            aim *= COARSER;
        }
    }

    /// Cells along s, along t of a patch.
    pub fn split(&self, patch: [usize; 2]) -> [usize; 2] {
        [0, 1].map(|k| (self.starts[k][patch[k] + 1] - self.starts[k][patch[k]]) as usize)
    }

    /// Rows and columns of cells.
    pub(super) fn size(&self) -> [usize; 2] {
        self.starts.each_ref().map(|list| list[list.len() - 1] as usize)
    }

    /// Number of cells.
    pub fn count(&self) -> usize {
        let [rows, columns] = self.size();
        rows * columns
    }

    /// The row and column of cells of a place.
    pub(super) fn cell(&self, patch: [usize; 2], at: [f64; 2]) -> [usize; 2] {
        [0, 1].map(|k| {
            let [first, next] = [0, 1].map(|n| self.starts[k][patch[k] + n] as usize);
            first + ((at[k] * (next - first) as f64) as usize).min(next - first - 1)
        })
    }

    /// The row (0) or column (1) of patches with a row or column of cells, and the local parameter of a place in it.
    pub(super) fn place(&self, k: usize, cell: usize, at: f64) -> (usize, f64) {
        let patch = self.starts[k].partition_point(|&first| first as usize <= cell) - 1;
        let [first, next] = [0, 1].map(|n| self.starts[k][patch + n] as usize);
        (patch, ((cell - first) as f64 + at) / (next - first) as f64)
    }

    pub(super) fn memory(&self) -> usize {
        self.starts.iter().map(|list| list.capacity() * size_of::<u32>()).sum()
    }
}

fn split(change: f64, aim: f64) -> usize {
    ((change / aim).ceil() as usize).clamp(1, MOST_SPLIT)
}

fn starts(splits: &[usize]) -> Vec<u32> {
    let mut sum = 0;
    let mut list = vec![0];
    list.extend(splits.iter().map(|n| {
        sum += *n as u32;
        sum
    }));
    list
}

/// How much the tangents change across each span of u and of v, relative to their lengths, in three quarters of the patches.
fn changes(surface: &Surface, spans: [&[usize]; 2]) -> [Vec<f64>; 2] {
    let degrees = [surface.knots_u().degree(), surface.knots_v().degree()];
    let columns = surface.knots_v().pole_count();
    let strides = [columns, 1];
    let pole = |at: usize| surface.poles()[at];
    // Of the patch whose poles begin at `first`: the change along each direction.
    let change = |first: usize| {
        let at = |i: usize, j: usize| first + i * columns + j;
        let leg = |i: usize, j: usize, k: usize| sub(pole(at(i, j) + strides[k]), pole(at(i, j)));
        let mut change = [0.0f64; 2];
        for k in 0..2 {
            let count = |d: usize| degrees[d] + usize::from(d != k);
            let (mut longest, mut most) = (0.0f64, [0.0f64; 2]);
            for i in 0..count(0) {
                for j in 0..count(1) {
                    let x = leg(i, j, k);
                    longest = longest.max(norm(x));
                    if i + 1 < count(0) {
                        most[0] =
                            most[0].max(norm(sub(leg(i + 1, j, k), x)) * (count(0) - 1) as f64);
                    }
                    if j + 1 < count(1) {
                        most[1] =
                            most[1].max(norm(sub(leg(i, j + 1, k), x)) * (count(1) - 1) as f64);
                    }
                }
            }
            if longest > 0.0 {
                for d in 0..2 {
                    change[d] = change[d].max(most[d] / longest);
                }
            }
        }
        change
    };
    // Some patches of each row and column are enough.
    let some = |count: usize| (0..count).step_by(count.div_ceil(SAMPLES)).collect::<Vec<usize>>();
    let chosen = [some(spans[1].len()), some(spans[0].len())];
    [0, 1].map(|k| {
        let along = |n: usize| {
            let mut list: Vec<f64> = chosen[k]
                .iter()
                .map(|&m| {
                    let (u, v) = if k == 0 { (n, m) } else { (m, n) };
                    let (u, v) = (spans[0][u] - degrees[0], spans[1][v] - degrees[1]);
                    change(u * columns + v)[k]
                })
                .collect();
            let at = list.len() * 3 / 4;
            *list.select_nth_unstable_by(at, f64::total_cmp).1
        };
        (0..spans[k].len()).map(along).collect()
    })
}
