//! What is near a place on a side or in a corner of the surface, for the one query at hand.
//!
//! With w from the place f to a query and parameters h, k of x from f, in the block of cells around:
//!
//! ```text
//!   w.(x - f) = w.S_u h + w.S_v k + int (1 - t) (w.S_uu h^2 + 2 w.S_uv h k + w.S_vv k^2)
//!            <= -G_u |h| - G_v |k| + (A h^2 + 2 B h k + C k^2) / 2
//! ```
//!
//! G is how fast `w.x` falls inward across a side, 0 along one. Where it falls faster than the bends across can make up for,
//! only the bend along the side is left, in a corner nothing. A, B, C come from balls around the second derivatives of the block.

use super::cell::Bend;
use super::{MARGIN, rounded_up};
use crate::bounds::{Vector, add, dot, norm, scaled, sub};

/// Share by which rounding to single precision may change a vector.
const SINGLE: f64 = 2e-7;

/// The second derivatives of a block of cells around one, and how far it goes, in widths of that cell.
#[derive(Clone, Copy, Debug)]
pub struct Edge {
    /// Greatest `|h|`, `|k|`.
    extents: [f32; 2],
    /// `|x - f|^2` is at least the first times `h^2`, the second times `k^2`, and their sum.
    squares: [f32; 2],
    /// Balls around the second derivatives uu, uv, vv.
    means: [[f32; 3]; 3],
    radii: [f32; 3],
}

impl Edge {
    /// From the cells of the block: their second derivatives; see the fields for the rest.
    pub fn new(
        bends: &[[Bend; 3]],
        widths: [f64; 2],
        extents: [f64; 2],
        squares: [f64; 2],
    ) -> Self {
        let mut out = Self {
            extents: extents.map(rounded_up),
            squares: squares.map(|x| ((x / MARGIN) as f32).next_down().max(0.0)),
            means: [[0.0; 3]; 3],
            radii: [0.0; 3],
        };
        let [a, b] = widths;
        for (n, by) in [a * a, a * b, b * b].into_iter().enumerate() {
            let sum = bends.iter().fold([0.0; 3], |sum, bend| add(sum, bend[n].mean));
            let mean = scaled(sum, 1.0 / bends.len() as f64);
            let far = |bend: &[Bend; 3]| norm(sub(bend[n].mean, mean)) + bend[n].apart;
            let radius = bends.iter().map(far).fold(0.0, f64::max);
            let radius = (radius + SINGLE * norm(mean)) * by;
            // What is no number says nothing; a maximum would leave it out.
            let is_known = bends.iter().all(|bend| far(bend).is_finite()) && radius.is_finite();
            out.means[n] = mean.map(|x| if is_known { (x * by) as f32 } else { 0.0 });
            out.radii[n] = if is_known { rounded_up(radius) } else { f32::INFINITY };
        }
        out
    }

    /// A bound of `w.(x - f) / |x - f|^2` in the block, at least 0, for w that may be off by `off`. `fall`: G, for widths of the
    /// cell; `corner`: the sign of `h k` inward, in a corner.
    pub fn asked(&self, w: Vector, off: f64, fall: [f64; 2], corner: Option<f64>) -> f64 {
        let size = norm(w) + off;
        let [[_, a], [low, high], [_, c]] = [0, 1, 2].map(|n| {
            let (mean, radius) = (self.means[n].map(f64::from), f64::from(self.radii[n]));
            let (along, wide) = (dot(w, mean), size * radius + (off + 1e-12 * size) * norm(mean));
            [along - wide * MARGIN, along + wide * MARGIN]
        });
        if [a, low, high, c].iter().any(|x| !x.is_finite()) {
            return f64::INFINITY;
        }
        let mixed = match corner {
            None => high.max(-low),
            Some(sign) if sign > 0.0 => high.max(0.0),
            Some(_) => (-low).max(0.0),
        };
        let bends = [a.max(0.0), c.max(0.0)];
        let extents = self.extents.map(f64::from);
        let squares = self.squares.map(f64::from);
        let left = [0, 1].map(|k| fall[k] - 0.5 * bends[k] * extents[k] * MARGIN);
        if corner.is_some() && left[0] >= 0.0 && left[1] >= 0.0 {
            // Each takes a share of the mixed one.
            if left[0] * extents[0] + left[1] * extents[1]
                >= mixed * extents[0] * extents[1] * MARGIN
            {
                return 0.0;
            }
        }
        let mut asked = {
            let [a, c] = [a / squares[0], c / squares[1]];
            let (b, half) = (mixed / (squares[0] * squares[1]).sqrt(), 0.5 * (a - c));
            0.5 * (0.5 * (a + c) + (half * half + b * b).sqrt()) * MARGIN
        };
        if asked.is_nan() {
            return f64::INFINITY;
        }
        asked = asked.max(0.0);
        for k in 0..2 {
            if left[k] >= mixed * extents[1 - k] * MARGIN {
                asked = asked.min(0.5 * bends[1 - k] / squares[1 - k] * MARGIN);
            }
        }
        asked
    }
}
