//! Ties on a curve.

use super::super::line::LineMemory;
use super::super::proof::{Proof, Rival, Site};
use super::super::ties::{Finding, Ground, HOPS, LEAST_GAIN, flags, told_apart};
use super::super::{Workspace, tree_slack};
use super::CurveSearch;
use crate::bounds::{Vector, norm, sub};
use crate::refine::{Method, foot_on_curve};

struct CurveGround<'a, 'b> {
    search: &'a CurveSearch<'b>,
    memory: &'a mut LineMemory,
}

impl CurveSearch<'_> {
    /// How far a distance may be off that is formed from the caller's shape, in the index's lengths.
    fn noise(&self) -> f64 {
        tree_slack(self.query)
    }

    /// The flags of a walk that has ended.
    pub(super) fn ties(&self, workspace: &mut Workspace, proof: &mut Proof) -> u32 {
        let nothing_met = workspace.loose.is_empty() && !proof.has_rivals();
        if proof.is_trivial() || nothing_met {
            return 0;
        }
        let mut ground = CurveGround { search: self, memory: &mut workspace.line };
        flags(&mut ground, &workspace.loose, proof)
    }

    /// Length of the domain when the curve is closed and not cut by a restriction.
    fn period(&self) -> Option<f64> {
        let (first, last) = self.whole.curve.domain();
        (self.index.closed && self.range == [first, last]).then_some(last - first)
    }

    /// Iterates in one segment.
    fn foot_in(&self, site: Site, proof: &mut Proof) -> Option<(Site, Vector)> {
        let range = self.local_range(site.piece)?;
        let view =
            (self.index.net(site.piece), sub(self.query, self.index.segments[site.piece].center));
        let (s, jet, taken) = foot_on_curve(&view, site.at[0], range, Method::Auto, None);
        proof.iterated(taken);
        Some((Site { at: [s, 0.0], ..site }, jet.d))
    }

    /// The place across the end of a segment, also across the seam.
    fn across(&self, site: Site) -> Option<Site> {
        let count = self.index.segments.len();
        let round = self.period().is_some();
        let (forward, at) = match site.at[0] {
            0.0 => (false, 1.0),
            1.0 => (true, 0.0),
            _ => return None,
        };
        let piece = neighbour(site.piece, forward, count, round)?;
        Some(Site { piece, at: [at, 0.0] })
    }

    /// The foot that the iteration from `site` ends at, across the ends of segments.
    fn settled(&self, site: Site, proof: &mut Proof) -> Option<(Site, Vector)> {
        let mut here = self.foot_in(site, proof)?;
        for _ in 0..HOPS {
            let next = match self.across(here.0) {
                Some(site) => self.foot_in(site, proof),
                None => self.foot_in(here.0, proof),
            };
            match next {
                Some(next) if norm(next.1) < norm(here.1) - LEAST_GAIN * proof.window() => {
                    here = next
                }
                _ => break,
            }
        }
        Some(here)
    }
}

impl Ground for CurveGround<'_, '_> {
    fn search(&mut self, piece: usize, proof: &mut Proof) {
        self.search.search(piece, self.memory, proof);
    }

    fn look(&self, rival: Rival, proof: &mut Proof) -> Finding {
        let search = self.search;
        let Some(home) = proof.site.filter(|_| proof.is_rival(rival.d)) else {
            return Finding::None;
        };
        let found = search.settled(rival.site, proof).filter(|(_, d)| proof.is_rival(*d));
        let Some((site, d)) = found else { return Finding::None };
        let (first, last) = search.whole.curve.domain();
        let home = search.parameter(home);
        let way = shortest(search.parameter(site) - home, search.period());
        told_apart(d, search.noise(), proof, |share| {
            let at = wrapped(home + share * way, first, last);
            let d = search.whole.curve.vector_from(search.whole.query, at);
            norm(d) * search.index.frame.scale
        })
    }
}

/// The next or the last of `count` pieces, around the seam when the shape is `round`.
pub fn neighbour(piece: usize, forward: bool, count: usize, round: bool) -> Option<usize> {
    match (forward, piece) {
        (true, k) if k + 1 < count => Some(k + 1),
        (false, k) if k > 0 => Some(k - 1),
        (true, _) if round => Some(0),
        (false, _) if round => Some(count - 1),
        _ => None,
    }
}

/// The way between two parameters, the other way round when that is shorter.
pub fn shortest(way: f64, period: Option<f64>) -> f64 {
    match period {
        Some(period) if way > 0.5 * period => way - period,
        Some(period) if way < -0.5 * period => way + period,
        _ => way,
    }
}

/// A parameter beyond an end of the domain, counted on from the other end.
pub fn wrapped(at: f64, first: f64, last: f64) -> f64 {
    let at = if at < first { at + (last - first) } else { at };
    let at = if at > last { at - (last - first) } else { at };
    at.clamp(first, last)
}
