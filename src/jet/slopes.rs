//! The vector to a point of a patch with its first derivatives: what a ray needs.

use super::sums::{EXACT, FIXED, MIDDLE, bernstein};
use super::{BezierPatch, vector, weight};
use crate::bounds::{Vector, sub};
use crate::knots::MAX_DEGREE;
use crate::simd::{Kernel, Lanes, Simd};

/// Vector to a surface point and its first derivatives in the local parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slopes {
    /// Point minus query.
    pub d: Vector,
    /// First derivatives.
    pub s: Vector,
    /// See `s`.
    pub t: Vector,
}

struct PatchSlopes<'a>(&'a BezierPatch<'a>, [f64; 2], Vector);

impl PatchSlopes<'_> {
    /// Value, s, t: as those of [`PatchJet`].
    #[inline(always)]
    fn sums<S: Simd, const ROWS: usize, const N: usize>(&self) -> [S::F4; 3] {
        let columns = if N > EXACT + 1 { self.0.degree.t + 1 } else { N };
        let across = bernstein::<f64, 1, ROWS>(self.0.degree.s + 1, self.1[0]);
        let along = bernstein::<f64, 1, N>(columns, self.1[1]);
        let zero = S::F4::splat(0.0);
        let mut partial = [[zero; N]; 2];
        for (i, row) in self.0.lanes.chunks_exact(columns).enumerate() {
            let (b, b1) = (S::F4::splat(across[0][i]), S::F4::splat(across[1][i]));
            for j in 0..columns {
                let lane = S::F4::load(&row[j]);
                partial[0][j] = partial[0][j] + b * lane;
                partial[1][j] = partial[1][j] + b1 * lane;
            }
        }
        let mut sums = [zero; 3];
        for j in 0..columns {
            let (value, s) = (partial[0][j], partial[1][j]);
            let (b, b1) = (S::F4::splat(along[0][j]), S::F4::splat(along[1][j]));
            sums[0] = sums[0] + b * value;
            sums[1] = sums[1] + b * s;
            sums[2] = sums[2] + b1 * value;
        }
        sums
    }

    #[inline(always)]
    fn rows<S: Simd, const N: usize>(&self) -> [S::F4; 3] {
        if self.0.degree.s <= FIXED {
            self.sums::<S, { FIXED + 1 }, N>()
        } else if self.0.degree.s <= MIDDLE {
            self.sums::<S, { MIDDLE + 1 }, N>()
        } else {
            self.sums::<S, { MAX_DEGREE + 1 }, N>()
        }
    }
}

impl Kernel for PatchSlopes<'_> {
    type Out = Slopes;

    #[inline(always)]
    fn run<S: Simd>(self, _: S) -> Slopes {
        let sums = match self.0.degree.t {
            1 => self.rows::<S, 2>(),
            2 => self.rows::<S, 3>(),
            3 => self.rows::<S, 4>(),
            4 => self.rows::<S, 5>(),
            FIXED => self.rows::<S, 6>(),
            6 => self.rows::<S, 7>(),
            7 => self.rows::<S, 8>(),
            8 => self.rows::<S, 9>(),
            9 => self.rows::<S, 10>(),
            ..=MIDDLE => self.rows::<S, { MIDDLE + 1 }>(),
            _ => self.rows::<S, { MAX_DEGREE + 1 }>(),
        };
        if !self.0.rational {
            let d = sub(vector(sums[0]), self.2);
            return Slopes { d, s: vector(sums[1]), t: vector(sums[2]) };
        }
        let p = S::F4::load(&[self.2[0], self.2[1], self.2[2], 0.0]);
        let (w, ws) = (S::F4::splat(weight(sums[0])), S::F4::splat(weight(sums[1])));
        let wt = S::F4::splat(weight(sums[2]));
        let d = (sums[0] - w * p) / w;
        let s = (sums[1] - ws * p - ws * d) / w;
        let t = (sums[2] - wt * p - wt * d) / w;
        Slopes { d: vector(d), s: vector(s), t: vector(t) }
    }
}

impl BezierPatch<'_> {
    /// The jet at `(s, t)` for the query `p`, without its second derivatives.
    pub fn slopes(&self, s: f64, t: f64, p: Vector) -> Slopes {
        self.level.run(PatchSlopes(self, [s, t], p))
    }
}
