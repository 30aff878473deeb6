//! When the budget has run out: plain iterations from many starts, without proof.

use super::super::proof::{Proof, Site};
use super::super::{Workspace, tree_limit, tree_slack};
use super::SurfaceSearch;
use crate::bounds::{norm, sub};
use crate::refine::{Method, foot_on_surface};

/// When the budget has run out: nearest patches sampled and samples in either direction of each (fewer for high
/// degrees, whose evaluations cost more), and the samples that are iterated from.
const RESCUE_SAMPLING: (usize, usize) = (200, 6);
const RESCUE_SAMPLING_HIGH: (usize, usize) = (16, 3);
const RESCUE_STARTS: usize = 24;
/// Iterations that continue the best foot then.
const PERSISTENCE: usize = 10;

impl SurfaceSearch<'_> {
    /// Goes on from the best foot until nothing moves: in a long valley one iteration is not enough.
    fn persist(&self, proof: &mut Proof) {
        for _ in 0..PERSISTENCE {
            let (Some(site), before) = (proof.site, proof.best) else { return };
            self.roam(site, proof);
            if proof.best == before {
                return;
            }
        }
    }

    /// Iterates on the whole surface, across the lines between patches.
    fn roam(&self, start: Site, proof: &mut Proof) {
        let start = self.parameters(start);
        let (at, _, taken) = foot_on_surface(&self.whole, start, self.range, Method::Auto, None);
        proof.iterated(taken);
        self.start_at(at, proof);
    }

    /// Samples the nearest patches and iterates from the best samples.
    pub(super) fn rescue(&self, workspace: &mut Workspace, proof: &mut Proof) {
        self.persist(proof);
        let mut starts = [(f64::INFINITY, Site { piece: 0, at: [0.0; 2] }); RESCUE_STARTS];
        let small = self.index.degree.count() <= 36;
        let (patches, samples) = if small { RESCUE_SAMPLING } else { RESCUE_SAMPLING_HIGH };
        let slack = tree_slack(self.query);
        self.index.tree.start(&mut workspace.queue);
        let mut sampled = 0;
        while let Some(next) = workspace.queue.pop() {
            let limit = tree_limit(proof, slack);
            if next.key > limit || sampled == patches {
                break;
            }
            match next.piece() {
                None => self.index.tree.open(next, self.query, limit, &mut workspace.queue),
                Some(k) => {
                    self.sample(k, samples, &mut starts, proof);
                    sampled += 1;
                }
            }
        }
        for (_, site) in starts.into_iter().filter(|start| start.0.is_finite()) {
            self.roam(site, proof);
        }
        self.persist(proof);
    }

    /// Keeps the best of a grid of samples of patch `k` in `starts`, nearest first.
    fn sample(
        &self,
        k: usize,
        samples: usize,
        starts: &mut [(f64, Site); RESCUE_STARTS],
        proof: &mut Proof,
    ) {
        let Some([s0, s1, t0, t1]) = self.local_range(k) else { return };
        let p = sub(self.query, self.index.patches[k].center);
        let share = |i: usize| (i as f64 + 0.5) / samples as f64;
        for (i, j) in (0..samples * samples).map(|n| (n / samples, n % samples)) {
            let at = [s0 + share(i) * (s1 - s0), t0 + share(j) * (t1 - t0)];
            let d = norm(self.index.net(k).jet(at[0], at[1], p).d);
            proof.evaluations += 1;
            let place = starts.partition_point(|start| start.0 <= d);
            if place < RESCUE_STARTS {
                starts[place..].rotate_right(1);
                starts[place] = (d, Site { piece: k, at });
            }
        }
    }
}
