//! Cuts beside a side that is a point, or nearly: around a tip that is near the query, halving would take a box for each power
//! of two between the size of the patch and the distance.

use super::{Area, LEAST_WIDTH, Walk};
use crate::bezier::Bidegree;
use crate::bounds::{HALF_ULP, Vector, norm, sub};

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
        // A power of two: the parts can be halved without rounding for as long as they have digits.
        let share = power_of_two(2.0 * BEYOND * best / speed(0).min(speed(2)));
        if share.is_nan() || share > 0.125 * (high - low) || share < LEAST_WIDTH {
            return None;
        }
        Some(if from_low { share } else { 1.0 - share })
    }

    fn pole(&self, k: usize) -> Vector {
        let [x, y, z, w] = self.sheet.net.lanes[k];
        [x / w, y / w, z / w]
    }

    /// Cuts an area. The narrow part is next; its coefficients are formed from the poles, since little is left of the digits of
    /// those that are there. Those of the wide part are cut out of them.
    pub(super) fn cut(&mut self, area: Area, at: usize, direction: usize, middle: f64) {
        let [a, b] = if direction == 0 { area.s } else { area.t };
        let low_is_narrow = middle - a < b - middle;
        let (low, high) = ([a, middle], [middle, b]);
        let parts = if low_is_narrow { [high, low] } else { [low, high] };
        let [mut wide, mut narrow] = parts.map(|ends| {
            let mut part = Area { unformed: true, ..area };
            *(if direction == 0 { &mut part.s } else { &mut part.t }) = ends;
            part
        });
        narrow.patience = [0; 2];
        // Otherwise the share is rounded, and so is the place that it stands for.
        if b - a == power_of_two(b - a) {
            let grid = self.sheet.ladder.grid(area.rung);
            let slot = &mut self.memory.coefficients[at * self.slot..(at + 1) * self.slot];
            grid.cut(direction, (middle - a) / (b - a), low_is_narrow, slot);
            let n = if direction == 0 { grid.degree.s } else { grid.degree.t };
            let growth = 6.0 * HALF_ULP * n as f64 * area.radius * area.radius;
            (wide.unformed, wide.error, wide.age) = (false, area.error + growth, area.age + 1);
        }
        self.memory.waiting.extend([wide, narrow]);
    }
}

/// The greatest power of two that is not above a positive number.
fn power_of_two(x: f64) -> f64 {
    const EXPONENT: u64 = 0x7ff << 52;
    f64::from_bits(x.to_bits() & EXPONENT)
}
