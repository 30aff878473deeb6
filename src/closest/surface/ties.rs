//! Ties on a surface.

use super::super::curve::{neighbour, shortest, wrapped};
use super::super::patch::PatchMemory;
use super::super::proof::{Proof, Rival, Site};
use super::super::ties::{Finding, Ground, HOPS, LEAST_GAIN, flags, told_apart};
use super::super::{CONTINUUM_STEPS, Workspace, tree_slack};
use super::SurfaceSearch;
use crate::bounds::{Vector, norm, sub};
use crate::refine::{Method, foot_on_surface};

/// Most patches in which a collapsed point is left.
const FAN: usize = 16;

struct SurfaceGround<'a, 'b> {
    search: &'a SurfaceSearch<'b>,
    memory: &'a mut PatchMemory,
}

impl SurfaceSearch<'_> {
    /// How far a distance may be off that is formed from the caller's shape, in the index's lengths.
    pub(super) fn noise(&self) -> f64 {
        tree_slack(self.query)
    }

    /// The flat direction of a foot on a side of its patch, where it was found in one parameter only; at a collapsed
    /// point, where one derivative vanishes, that of the other.
    pub(super) fn flat_at_border(&self, site: Site) -> Option<[f64; 2]> {
        let [s, t] = site.at;
        let patch = &self.index.patches[site.piece];
        if s != 0.0 && s != 1.0 && t != 0.0 && t != 1.0 {
            return None;
        }
        let jet = self.index.net(site.piece).jet(s, t, sub(self.query, patch.center));
        let on = [s == 0.0, s == 1.0, t == 0.0, t == 1.0];
        match (0..4).find(|&k| on[k] && patch.collapsed[k]) {
            Some(k) if jet.along(k / 2).is_flat() => {
                Some(if k < 2 { [1.0, 0.0] } else { [0.0, 1.0] })
            }
            Some(_) => None,
            None => jet.flat_direction(),
        }
    }

    /// Whether there is a foot within the window wherever the iteration starts along the flat direction `v`.
    pub(super) fn is_continuum(&self, site: Site, v: [f64; 2], proof: &Proof) -> bool {
        let Some(range) = self.local_range(site.piece) else { return false };
        let patch = &self.index.patches[site.piece];
        let view = (self.index.net(site.piece), sub(self.query, patch.center));
        let home = view.0.jet(site.at[0], site.at[1], view.1).d;
        let stays = |step: f64| {
            let start = [site.at[0] + step * v[0], site.at[1] + step * v[1]];
            let inside = (range[0]..=range[1]).contains(&start[0])
                && (range[2]..=range[3]).contains(&start[1]);
            if !inside {
                return false;
            }
            let reach = proof.level();
            let there = view.0.jet(start[0], start[1], view.1).d;
            if norm(there) <= reach {
                return true;
            }
            // A continuum need not follow the straight line in the parameters.
            let (_, jet, _) = foot_on_surface(&view, start, range, self.options.method, None);
            norm(jet.d) <= reach && norm(sub(jet.d, home)) > 0.5 * norm(sub(there, home))
        };
        proof.best > proof.window()
            && [-1.0, 1.0]
                .into_iter()
                .any(|side| CONTINUUM_STEPS.into_iter().all(|step| stays(side * step)))
    }

    /// The flags of a walk that has ended.
    pub(super) fn ties(&self, workspace: &mut Workspace, proof: &mut Proof) -> u32 {
        let nothing_met = workspace.loose.is_empty() && !proof.has_rivals();
        if proof.is_trivial() || nothing_met {
            return 0;
        }
        let mut ground = SurfaceGround { search: self, memory: &mut workspace.patch };
        flags(&mut ground, &workspace.loose, proof)
    }

    /// Length of the domain in direction `k` when it is closed and not cut by a restriction.
    pub(super) fn period(&self, k: usize) -> Option<f64> {
        let ends = &self.whole.surface.domain()[2 * k..2 * k + 2];
        (self.index.closed[k] && self.range[2 * k..2 * k + 2] == *ends).then_some(ends[1] - ends[0])
    }

    /// Iterates in one patch.
    fn foot_in(&self, site: Site, proof: &mut Proof) -> Option<(Site, Vector)> {
        let range = self.local_range(site.piece)?;
        let view =
            (self.index.net(site.piece), sub(self.query, self.index.patches[site.piece].center));
        let (at, jet, taken) = foot_on_surface(&view, site.at, range, Method::Auto, None);
        proof.iterated(taken);
        Some((Site { at, ..site }, jet.d))
    }

    /// The place across the sides of a patch in the directions `over`, also across a seam.
    fn across(&self, site: Site, over: [bool; 2]) -> Option<Site> {
        let (columns, rows) = (self.index.columns, self.index.patches.len() / self.index.columns);
        let mut place = [site.piece / columns, site.piece % columns];
        let mut at = site.at;
        for k in (0..2).filter(|&k| over[k]) {
            if at[k] != 0.0 && at[k] != 1.0 {
                return None;
            }
            let round = self.period(k).is_some();
            place[k] = neighbour(place[k], at[k] == 1.0, [rows, columns][k], round)?;
            at[k] = 1.0 - at[k];
        }
        let piece = place[0] * columns + place[1];
        let (from, to) = (&self.index.patches[site.piece], &self.index.patches[piece]);
        if !over[0] {
            at[0] = to.u.local(from.u.global(at[0]));
        }
        if !over[1] {
            at[1] = to.v.local(from.v.global(at[1]));
        }
        Some(Site { piece, at })
    }

    /// The foot that the iteration from `site` ends at, across the sides of patches.
    fn settled(&self, site: Site, proof: &mut Proof) -> Option<(Site, Vector)> {
        let mut here = self.foot_in(site, proof)?;
        for _ in 0..HOPS {
            let mut next = here;
            for over in [[false, false], [true, false], [false, true], [true, true]] {
                let found = self.across(here.0, over).and_then(|site| self.foot_in(site, proof));
                next = found.filter(|found| norm(found.1) < norm(next.1)).unwrap_or(next);
            }
            if norm(next.1) >= norm(here.1) - LEAST_GAIN * proof.window() {
                break;
            }
            here = next;
        }
        Some(here)
    }

    /// The collapsed side on which a place lies.
    fn collapsed_side(&self, site: Site) -> Option<usize> {
        let [s, t] = site.at;
        let on = [s == 0.0, s == 1.0, t == 0.0, t == 1.0];
        (0..4).find(|&k| on[k] && self.index.patches[site.piece].collapsed[k])
    }

    /// A collapsed point as a foot: none when the distance falls from it into one of its patches.
    fn settled_point(
        &self,
        side: usize,
        rival: Rival,
        proof: &mut Proof,
    ) -> Option<(Site, Vector)> {
        let columns = self.index.columns;
        let (step, count) =
            if side < 2 { (1, columns) } else { (columns, self.index.patches.len() / columns) };
        let first = if side < 2 {
            rival.site.piece / columns * columns
        } else {
            rival.site.piece % columns
        };
        for k in (0..count).step_by(count.div_ceil(FAN)) {
            let mut start = Site { piece: first + k * step, ..rival.site };
            start.at[1 - side / 2] = 0.5;
            let left = self.foot_in(start, proof);
            if left.is_some_and(|(_, d)| norm(d) < norm(rival.d) - LEAST_GAIN * proof.window()) {
                return None;
            }
        }
        Some((rival.site, rival.d))
    }
}

impl Ground for SurfaceGround<'_, '_> {
    fn search(&mut self, piece: usize, proof: &mut Proof) {
        self.search.search(piece, u64::MAX, self.memory, proof);
    }

    fn look(&self, rival: Rival, proof: &mut Proof) -> Finding {
        let search = self.search;
        let Some(home) = proof.site.filter(|_| proof.is_rival(rival.d)) else {
            return Finding::None;
        };
        let found = match search.collapsed_side(rival.site) {
            Some(side) => search.settled_point(side, rival, proof),
            None => search.settled(rival.site, proof),
        };
        let Some((site, d)) = found.filter(|(_, d)| proof.is_rival(*d)) else {
            return Finding::None;
        };
        let (home, there) = (search.parameters(home), search.parameters(site));
        let ends = search.whole.surface.domain();
        let way = [0, 1].map(|k| shortest(there[k] - home[k], search.period(k)));
        told_apart(d, search.noise(), proof, |share| {
            let [u, v] =
                [0, 1].map(|k| wrapped(home[k] + share * way[k], ends[2 * k], ends[2 * k + 1]));
            let d = search.whole.surface.vector_from(search.whole.query, u, v);
            norm(d) * search.index.frame.scale
        })
    }
}
