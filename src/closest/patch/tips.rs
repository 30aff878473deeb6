//! Cuts beside a side that is a point, or nearly: around a tip that is near the query, halving would take a box for each power
//! of two between the size of the patch and the distance.

use super::{Area, LEAST_WIDTH, Walk};
use crate::bezier::Bidegree;
use crate::bounds::{Vector, norm, sub};

/// How far from the tip an area is cut, in distances of the best foot.
const BEYOND: f64 = 4.0;

impl Walk<'_, '_, '_> {
    /// Where to cut an area that ends at a tip, when the query is far nearer to the shape than the area is wide: some way
    /// beyond the distance of the best foot, so that one test closes what lies farther out.
    pub(super) fn beyond_tip(&self, area: &Area, direction: usize) -> Option<f64> {
        let [low, high] = if direction == 0 { area.s } else { area.t };
        let best = self.proof.best;
        if !(low == 0.0 || high == 1.0) || !best.is_finite() {
            return None;
        }
        let Bidegree { s, t } = self.sheet.net.degree;
        let (degree, step, along, across) =
            if direction == 0 { (s, t + 1, 1, t) } else { (t, 1, t + 1, s) };
        // The poles of the side at its ends and in the middle, and those one row further in.
        let row = |k: usize| [0, across / 2, across].map(|i| self.pole(k * step + i * along));
        let tip = |side: [Vector; 3]| side.iter().all(|x| norm(sub(*x, side[0])) <= best);
        let first = row(0);
        let from_low = low == 0.0 && tip(first);
        let (side, next) = if from_low {
            (first, row(1))
        } else {
            let last = row(degree);
            if high != 1.0 || !tip(last) {
                return None;
            }
            (last, row(degree - 1))
        };
        let speed = |k: usize| degree as f64 * norm(sub(next[k], side[k]));
        let share = BEYOND * best / speed(0).min(speed(2));
        if share.is_nan() || share > 0.125 * (high - low) || share < LEAST_WIDTH {
            return None;
        }
        Some(if from_low { share } else { 1.0 - share })
    }

    fn pole(&self, k: usize) -> Vector {
        let [x, y, z, w] = self.sheet.net.lanes[k];
        [x / w, y / w, z / w]
    }

    /// Cuts an area; the coefficients of the parts are formed from the poles when their turn comes. The narrow one is next.
    pub(super) fn cut(&mut self, area: Area, direction: usize, middle: f64) {
        let [a, b] = if direction == 0 { area.s } else { area.t };
        let low_is_narrow = middle - a < b - middle;
        let (low, high) = ([a, middle], [middle, b]);
        for ends in if low_is_narrow { [high, low] } else { [low, high] } {
            let mut part = Area { unformed: true, ..area };
            *(if direction == 0 { &mut part.s } else { &mut part.t }) = ends;
            self.memory.waiting.push(part);
        }
    }
}
