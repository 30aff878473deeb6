//! Feet on lines and circles.

use super::super::elementary::{LAST_STEP, OVER, Prospect, STEPS, is_level, settled};
use super::super::proof::Site;
use super::super::{FootPoint, flag, tree_slack};
use super::CurveSearch;
use crate::bounds::{Vector, norm, sub};
use crate::index::{CurveIndex, IndexedCurve};
use crate::refine::Method;

impl IndexedCurve {
    /// The answer in closed form; none where the general search has to answer.
    pub(super) fn elementary(
        &self,
        index: &CurveIndex,
        query: Vector,
        search: &CurveSearch,
        (gap, allowed): (f64, f64),
    ) -> Option<FootPoint> {
        let analytic = index.analytic.as_deref()?;
        if search.options.method != Method::Auto {
            return None;
        }
        let prospect = Prospect::new(analytic, search.query)?;
        let start = Site { piece: prospect.piece, at: [prospect.at[0], 0.0] };
        let (site, d, taken) = search.stepped(start)?;
        let u = index.segments[site.piece].u.global(site.at[0]);
        let inside = u == search.parameter(site);
        let half = 0.5 * gap * index.frame.scale;
        if !inside || !prospect.proves(norm(d), half) {
            return None;
        }
        let alone = prospect.is_alone(norm(d), half);
        let flags = if alone { 0 } else { search.among_others(site, d, half)? };
        let mut foot = self.foot_at(index, query, u, search.range);
        if !prospect.certify(&mut foot, index.frame.scale, allowed) {
            return None;
        }
        foot.iterations = taken;
        foot.flags = foot.flags & !flag::NOT_PROVEN | flags;
        Some(foot)
    }
}

impl CurveSearch<'_> {
    /// The flags of a foot beside which others are as near; none where the general search has to tell.
    fn among_others(&self, site: Site, d: Vector, gap: f64) -> Option<u32> {
        let query = sub(self.query, self.index.segments[site.piece].center);
        let flat = self.index.net(site.piece).jet(site.at[0], query).is_flat();
        let proof = Prospect::proof(site, d, gap, flat.then_some([1.0, 0.0]));
        (flat && self.is_continuum(site, &proof)).then_some(flag::CONTINUUM | flag::TIE)
    }

    /// Newton steps in the piece of `start`: the foot, its vector from the query, the evaluations. None when they leave
    /// the piece or do not converge.
    fn stepped(&self, start: Site) -> Option<(Site, Vector, u32)> {
        let (index, piece) = (self.index, start.piece);
        let outer = [piece == 0, piece + 1 == index.segments.len()].map(|end| end && !index.closed);
        let (net, query) = (index.net(piece), sub(self.query, index.segments[piece].center));
        let noise = tree_slack(self.query);
        let mut at = start.at[0];
        for taken in 1..=STEPS {
            let jet = net.jet(at, query);
            let (g, h) = (jet.gradient(), jet.hessian());
            let held = is_level(&jet, noise)
                || (outer[0] && at == 0.0 && g >= 0.0)
                || (outer[1] && at == 1.0 && g <= 0.0);
            if !held && (h.is_nan() || h <= 0.0) {
                return None;
            }
            let step = if held { 0.0 } else { -g / h };
            let to = (at + step).clamp(0.0, 1.0);
            if !outer[usize::from(step > 0.0)] && (at + step - to).abs() > OVER {
                return None;
            }
            let size = (to - at).abs();
            at = to;
            if size <= LAST_STEP {
                let site = Site { piece, at: [settled(at), 0.0] };
                return Some((site, jet.d, taken as u32));
            }
        }
        None
    }
}
