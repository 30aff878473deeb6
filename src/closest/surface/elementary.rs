//! Feet on elementary surfaces.

use super::super::elementary::{
    BESIDE_EDGE, LAST_STEP, ON_EDGE, OVER, Prospect, STEPS, is_level, settled,
};
use super::super::proof::Site;
use super::super::{FootPoint, flag};
use super::SurfaceSearch;
use crate::bounds::{Vector, norm, sub};
use crate::index::{IndexedSurface, SurfaceIndex};
use crate::refine::Method;

impl IndexedSurface {
    /// The answer in closed form; none where the general search has to answer.
    pub(super) fn elementary(
        &self,
        index: &SurfaceIndex,
        query: Vector,
        search: &SurfaceSearch,
        (gap, allowed): (f64, f64),
    ) -> Option<FootPoint> {
        let analytic = index.analytic.as_deref()?;
        if search.options.method != Method::Auto {
            return None;
        }
        let prospect = Prospect::new(analytic, search.query)?;
        let start = Site { piece: prospect.piece, at: prospect.at };
        let found = match search.beside_collapsed(start) {
            Some((_, away)) if away > ON_EDGE => return None,
            Some((edge, _)) => Some(search.on_collapsed(edge, start)),
            None => search.stepped(start),
        };
        let (site, d, taken) = found?;
        let at = search.free_parameters(site);
        let inside = at == search.parameters(site);
        let half = 0.5 * gap * index.frame.scale;
        if !inside || !prospect.proves(norm(d), half) {
            return None;
        }
        let alone = prospect.is_alone(norm(d), half);
        let flags = if alone { 0 } else { search.among_others(site, d, half)? };
        let mut foot = self.foot_at(index, query, at, search.range);
        if !prospect.certify(&mut foot, index.frame.scale, allowed) {
            return None;
        }
        foot.iterations = taken;
        foot.flags = foot.flags & !flag::NOT_PROVEN | flags;
        Some(foot)
    }
}

impl SurfaceSearch<'_> {
    /// The flags of a foot beside which others are as near; none where the general search has to tell.
    fn among_others(&self, site: Site, d: Vector, gap: f64) -> Option<u32> {
        let query = sub(self.query, self.index.patches[site.piece].center);
        let jet = self.index.net(site.piece).jet(site.at[0], site.at[1], query);
        let flat = jet.flat_direction().or_else(|| self.flat_at_border(site));
        let proof = Prospect::proof(site, d, gap, flat);
        let is_continuum = flat.is_some_and(|v| self.is_continuum(site, v, &proof));
        is_continuum.then_some(flag::CONTINUUM | flag::TIE)
    }

    /// As [`Self::parameters`], wherever the restriction ends.
    fn free_parameters(&self, site: Site) -> [f64; 2] {
        let patch = &self.index.patches[site.piece];
        [patch.u.global(site.at[0]), patch.v.global(site.at[1])]
    }

    /// The sides of a patch that are borders of the surface.
    fn outer(&self, piece: usize) -> [bool; 4] {
        let (columns, rows) = (self.index.columns, self.index.patches.len() / self.index.columns);
        let (row, column) = (piece / columns, piece % columns);
        [row == 0, row + 1 == rows, column == 0, column + 1 == columns]
    }

    /// The collapsed edge beside which a place lies, and how far from it.
    fn beside_collapsed(&self, site: Site) -> Option<(usize, f64)> {
        let (outer, [s, t]) = (self.outer(site.piece), site.at);
        let away = [s, 1.0 - s, t, 1.0 - t];
        let on = |k: &usize| self.index.collapsed[*k] && outer[*k] && away[*k] < BESIDE_EDGE;
        (0..4).find(on).map(|k| (k, away[k]))
    }

    /// The point of a collapsed edge, with the parameter along it that the general search gives.
    fn on_collapsed(&self, edge: usize, near: Site) -> (Site, Vector, u32) {
        let mut at = [0.0; 2];
        at[edge / 2] = (edge % 2) as f64;
        let site = Site { at, ..near };
        let query = sub(self.query, self.index.patches[site.piece].center);
        (site, self.index.net(site.piece).jet(at[0], at[1], query).d, 1)
    }

    /// Newton steps in the piece of `start`: the foot, its vector from the query, the evaluations. None when they leave
    /// the piece or do not converge.
    fn stepped(&self, start: Site) -> Option<(Site, Vector, u32)> {
        let (index, piece) = (self.index, start.piece);
        let outer = self.outer(piece);
        let view = (index.net(piece), sub(self.query, index.patches[piece].center));
        let noise = self.noise();
        let mut at = start.at;
        for taken in 1..=STEPS {
            let jet = view.0.jet(at[0], at[1], view.1);
            let (g, h) = (jet.gradient(), jet.hessian());
            let held = [0, 1].map(|k| {
                if is_level(&jet.along(k), noise) {
                    return true;
                }
                let low = outer[2 * k] && at[k] == 0.0 && g[k] >= 0.0;
                let high = outer[2 * k + 1] && at[k] == 1.0 && g[k] <= 0.0;
                !index.closed[k] && (low || high)
            });
            let step = newton_step(g, h, held)?;
            let to = [0, 1].map(|k| (at[k] + step[k]).clamp(0.0, 1.0));
            for k in 0..2 {
                let border = outer[2 * k + usize::from(step[k] > 0.0)] && !index.closed[k];
                if !border && (at[k] + step[k] - to[k]).abs() > OVER {
                    return None;
                }
            }
            let size = [0, 1].map(|k| (to[k] - at[k]).abs());
            at = to;
            if size[0].max(size[1]) <= LAST_STEP {
                return Some((Site { piece, at: at.map(settled) }, jet.d, taken as u32));
            }
        }
        None
    }
}

/// The Newton step in the parameters that are not held; none where its model has no clear minimum.
fn newton_step(g: [f64; 2], [a, b, c]: [f64; 3], held: [bool; 2]) -> Option<[f64; 2]> {
    let along = |g: f64, h: f64| (h > 0.0).then_some(-g / h);
    match held {
        [true, true] => Some([0.0; 2]),
        [true, false] => Some([0.0, along(g[1], c)?]),
        [false, true] => Some([along(g[0], a)?, 0.0]),
        [false, false] => {
            let det = a * c - b * b;
            let clear = a > 0.0 && c > 0.0 && det > 1e-6 * a * c;
            clear.then(|| [(b * g[1] - c * g[0]) / det, (b * g[0] - a * g[1]) / det])
        }
    }
}
