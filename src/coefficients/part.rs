//! The part of a box before or behind a place along one direction, by the algorithm of de Casteljau.

use super::lower::{MOST, strands};
use super::{Grid, LANES};
use crate::simd::{Kernel, Lanes, Simd};

/// A slot cut in place.
pub struct Part<'a> {
    pub grid: &'a Grid,
    pub direction: usize,
    /// The place, as a share of the box.
    pub place: f64,
    /// Whether the part behind it is kept.
    pub keeps_rest: bool,
    pub slot: &'a mut [f64],
}

impl Kernel for Part<'_> {
    type Out = ();

    #[inline(always)]
    fn run<S: Simd>(self, _: S) {
        let Self { grid, direction, place, keeps_rest, slot } = self;
        for array in slot.chunks_exact_mut(grid.stride).take(1 + usize::from(grid.rational)) {
            cut::<S>(grid, direction, place, keeps_rest, array);
        }
    }
}

/// One array.
#[inline(always)]
fn cut<S: Simd>(grid: &Grid, direction: usize, place: f64, keeps_rest: bool, array: &mut [f64]) {
    let (columns, rows) = (grid.width(), grid.degree.s + 1);
    let (count, others) = if direction == 0 { (rows, columns) } else { (columns, rows) };
    let (before, own) = (S::F8::splat(1.0 - place), S::F8::splat(place));
    let mut strand = [S::F8::splat(0.0); MOST];
    let mut first = 0;
    while first < others {
        let lanes = (others - first).min(LANES);
        strands::<S>(grid, array, direction, first, &mut strand);
        for level in 1..count {
            if keeps_rest {
                for k in 0..count - level {
                    strand[k] = strand[k] * before + strand[k + 1] * own;
                }
            } else {
                for k in (level..count).rev() {
                    strand[k] = strand[k - 1] * before + strand[k] * own;
                }
            }
        }
        let step = if direction == 0 { [columns, 1] } else { [1, columns] };
        for k in 0..count {
            for (i, value) in strand[k].array()[..lanes].iter().enumerate() {
                array[LANES + k * step[0] + (first + i) * step[1]] = *value;
            }
        }
        first += LANES;
    }
}
