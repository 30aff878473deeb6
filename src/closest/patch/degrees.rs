//! The coefficients of an area: formed from the poles, and of as low degrees as the area needs.

use super::super::certificate::{LEAST_C, least_height, nearness, plane_separates, tilted_height};
use super::super::net::{Cut, CutFree};
use super::{Area, FRESH, Walk};
use crate::bounds::HALF_ULP;
use crate::coefficients::Step;

/// What lower degrees may likely add to the error of coefficients, in errors.
const SHARE: f64 = 0.25;
/// Where they have added more than so many: such an area keeps its degrees.
const MOST: f64 = 16.0;

/// Boxes of a patch before which arrays are not lowered, and nets only where their products have many coefficients.
const EARLY: u64 = 8;
const MANY: usize = 150;

impl Walk<'_, '_, '_> {
    /// Lowers the degrees of slot `at` as far as that adds little to its error.
    pub(super) fn lower(&mut self, area: &mut Area, at: usize) {
        let is_early = self.proof.spent - self.start <= EARLY;
        if is_early || area.is_stiff || !self.proof.best.is_finite() || self.touches_collapsed(area)
        {
            return;
        }
        for k in 0..2 {
            let ladder = self.sheet.ladder;
            let is_due = area.patience[k] == 0 && ladder.has_lower(area.rung, k);
            if !is_due || !area.error.is_finite() {
                continue;
            }
            // No squared distance that counts is greater.
            let mu = self.proof.tie_squared();
            let least_c = self.c(area, at).iter().fold(1.0_f64, |least, c| least.min(*c));
            let slot = &mut self.memory.coefficients[at * self.slot..(at + 1) * self.slot];
            let Step { to, later } =
                ladder.step(area.rung, k, slot, mu, SHARE * area.error * least_c);
            area.patience[k] = later;
            if to == area.rung[k] {
                continue;
            }
            let [n, c] = ladder.lower(area.rung, k, to, slot);
            area.growth[k] *= ladder.growth(area.rung, k, to);
            area.rung[k] = to;
            let least_c = self.c(area, at).iter().fold(1.0_f64, |least, c| least.min(*c));
            let error = (area.error * (1.0 + c / least_c) + (n + mu * c) / least_c)
                * (1.0 + 8.0 * HALF_ULP);
            if !(least_c >= LEAST_C && error <= MOST * area.error) {
                (area.age, area.is_stiff) = (FRESH, true);
            }
            area.error = if least_c >= LEAST_C { error } else { f64::INFINITY };
        }
    }

    /// Whether a side of the area is a collapsed side of the patch.
    fn touches_collapsed(&self, area: &Area) -> bool {
        let ends = [area.s[0], area.s[1], area.t[0], area.t[1]];
        (0..4).any(|k| self.sheet.patch.collapsed[k] && ends[k] == [0.0, 1.0, 0.0, 1.0][k])
    }

    /// Rebuilds the coefficients of slot `at` from the poles; true when a plane already separates the query.
    pub(super) fn load(&mut self, area: &mut Area, at: usize) -> bool {
        let Some(cut) = self.cut_free(area) else { return true };
        let ladder = self.sheet.ladder;
        let slot = &mut self.memory.coefficients[at * self.slot..(at + 1) * self.slot];
        ladder.grid(cut.rung).square(&mut self.memory.lanes[..cut.count], slot);
        area.growth = [1.0; 2];
        for k in 0..2 {
            if cut.rung[k] > 0 {
                area.growth[k] = ladder.growth([0; 2], k, cut.rung[k]);
            }
        }
        area.rung = cut.rung;
        area.patience = [0; 2];
        self.set_error(area, at, cut.radius, self.sheet.position + cut.off, 3 * cut.count);
        let mu = self.proof.tie_squared();
        if cut.off_weight > 0.0 {
            area.error += mu * cut.off_weight * (2.0 + cut.off_weight);
        }
        false
    }

    /// The poles of an area into the scratch memory, as `r` and `W`; `None` when a plane separates them from the query.
    pub(super) fn cut_free(&mut self, area: &mut Area) -> Option<Cut> {
        let patch = &self.sheet.net;
        let count = patch.degree.count();
        let known = self.proof.best.is_finite();
        let is_many = self.sheet.ladder.whole().count > MANY;
        let may_lower = known
            && !area.is_stiff
            && (is_many || self.proof.spent - self.start > EARLY)
            && !self.touches_collapsed(area);
        let lower = may_lower.then_some((self.sheet.ladder, self.sheet.position));
        let net = &mut self.memory.net[..4 * count];
        let lanes = &mut self.memory.lanes[..count];
        let query = self.sheet.query;
        let (degree, rational, poles) = (patch.degree, patch.rational, patch.lanes);
        let (s, t) = (area.s, area.t);
        let cut = CutFree { poles, degree, rational, s, t, query, lower, lanes, net };
        let cut = patch.level.run(cut);
        let position = self.sheet.position + cut.off;
        if known && plane_separates(net, cut.count, self.proof, position) {
            return None;
        }
        if known && self.hard() && self.is_under_a_tilted_plane(&cut) {
            return None;
        }
        if self.proof.tying {
            let near = nearness(&self.memory.net[..4 * cut.count], cut.count, self.proof);
            area.small = near.small;
            if near.around_foot {
                return None;
            }
        }
        Some(cut)
    }

    /// Whether a plane that fits the net in the scratch memory separates it from the query.
    fn is_under_a_tilted_plane(&mut self, cut: &Cut) -> bool {
        let (count, position) = (cut.count, self.sheet.position + cut.off);
        let corners = [0, cut.columns, count - 1 - cut.columns, count - 1];
        let height = tilted_height(&self.memory.net[..4 * count], count, corners, self.proof);
        let beyond_ties = height > least_height(self.proof.reach(), position);
        let hit = if self.proof.tying {
            beyond_ties
        } else {
            height > least_height(self.proof.target, position)
        };
        let (tries, hits) = self.proof.tilts;
        self.proof.tilts = (tries + 1, hits + u64::from(hit));
        if hit && !beyond_ties {
            self.proof.loosen(self.proof.target);
        }
        hit
    }
}
