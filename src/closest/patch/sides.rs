//! The sides of an area: a search along a border, and what a collapsed side says.

use super::super::collapsed::{along, rational_slope_extent, slope_extent};
use super::super::line::{Given, Line, Source, search_line};
use super::super::proof::Site;
use super::super::settle::settled;
use super::{Area, Walk};
use crate::bezier::{cut_2d, isocurve};
use crate::bounds::extent;
use crate::index::{product_steps, side};
use crate::jet::{BezierSegment, Jet2, lanes};
use crate::knots::MAX_DEGREE;

impl Walk<'_, '_, '_> {
    /// The collapsed points are candidates of their own.
    pub(super) fn look_at_collapsed_sides(&mut self) {
        let corner: [[f64; 2]; 4] = [[0.0, 0.0], [1.0, 0.0], [0.0, 0.0], [0.0, 1.0]];
        for k in 0..4 {
            let inner = self.sheet.range[k] == [0.0, 1.0, 0.0, 1.0][k];
            if self.sheet.patch.collapsed[k] && inner {
                let at = [0, 1].map(|c| {
                    corner[k][c].clamp(self.sheet.range[2 * c], self.sheet.range[2 * c + 1])
                });
                self.look_at(at);
            }
        }
    }

    fn look_at(&mut self, at: [f64; 2]) -> Jet2 {
        let jet = self.sheet.net.jet(at[0], at[1], self.sheet.query);
        self.proof.evaluations += 1;
        let site = Site { piece: self.sheet.piece, at };
        self.proof.offer(site, jet.d, || None);
        self.proof.rival(site, jet.d);
        jet
    }

    /// Goes on along side `k` of the area, if that can hold the nearest point at all.
    pub(super) fn follow_side(&mut self, area: &Area, at: usize, k: usize) {
        let ends = [area.s[0], area.s[1], area.t[0], area.t[1]];
        let outer = ends[k] == self.sheet.range[k];
        let collapsed = self.sheet.patch.collapsed[k] && ends[k] == [0.0, 1.0, 0.0, 1.0][k];
        if !outer || !self.sheet.border[k] || collapsed {
            return;
        }
        let along_s = k == side::T0 || k == side::T1;
        let (range, first) = if along_s { (area.s, side::S0) } else { (area.t, side::T0) };
        let border =
            [0, 1].map(|e| self.sheet.border[first + e] && range[e] == self.sheet.range[first + e]);
        let known = self.proof.site.filter(|best| {
            let at = best.at[usize::from(!along_s)];
            best.piece == self.sheet.piece
                && best.at[k / 2] == ends[k]
                && (range[0]..=range[1]).contains(&at)
        });
        let foot = known.and_then(|best| {
            let jet = self.proof.jet_at(best)?;
            Some((best.at[usize::from(!along_s)], jet.along(usize::from(!along_s))))
        });
        let mut memory = std::mem::take(&mut self.memory.edge);
        let p = self.edge_net(k, ends[k], &mut memory);
        let components = if self.sheet.net.rational { 4 } else { 3 };
        let (net, product) = memory.split_at_mut(4 * (MAX_DEGREE + 1));
        let (n, c) = product.split_at_mut(2 * MAX_DEGREE + 1);
        let (n, c) = (&mut n[..=2 * p], &mut c[..=2 * p]);
        let rational = self.sheet.net.rational;
        let is_whole = area.rung == [0; 2];
        if is_whole {
            for i in 0..=2 * p {
                let place = self.place_on_side(k, i);
                n[i] = self.n(area, at)[place];
                if rational {
                    c[i] = self.c(area, at)[place];
                }
            }
        }
        let poles = &net[..components * (p + 1)];
        let mut pole_lanes = [[0.0; 4]; MAX_DEGREE + 1];
        for (lane, pole) in pole_lanes.iter_mut().zip(lanes(poles, rational)) {
            *lane = pole;
        }
        let (piece, fixed) = (self.sheet.piece, ends[k]);
        let site = |x: f64| Site { piece, at: if along_s { [x, fixed] } else { [fixed, x] } };
        let line = Line {
            segment: BezierSegment {
                degree: p,
                rational,
                poles,
                lanes: &pole_lanes[..=p],
                level: self.sheet.net.level,
            },
            query: self.sheet.query,
            position: self.sheet.position,
            range,
            border,
            site: &site,
            grid: &self.sheet.edge_grids[usize::from(!along_s)],
            method: self.sheet.method,
            reach: None,
        };
        let c = if rational { &c[..] } else { &[] };
        let source = if is_whole { Source::Products(n, c) } else { Source::Poles };
        let given = Given { source, error: area.error, radius: area.radius, foot };
        let before = self.proof.best;
        search_line(&line, &given, &mut self.memory.line, self.proof);
        self.memory.edge = memory;
        if let (Some(best), Some(_)) = (self.proof.site, self.sheet.reach)
            && self.proof.best < before
        {
            let jet = self.sheet.net.jet(best.at[0], best.at[1], self.sheet.query);
            self.proof.evaluations += 1;
            self.settle(best, &jet);
        }
    }

    /// See [`settled`].
    pub(super) fn settle(&mut self, site: Site, jet: &Jet2) {
        let Some(reach) = self.sheet.reach else { return };
        let (position, degree) = (self.sheet.position, self.sheet.net.degree);
        let gap = self.proof.gap;
        let found = || settled(reach, site, jet, [position, gap], degree, None);
        self.proof.settle(site, found);
    }

    /// Index of product coefficient `i` along side `k`.
    fn place_on_side(&self, k: usize, i: usize) -> usize {
        let degree = self.sheet.ladder.whole().degree;
        let width = degree.t + 1;
        match k {
            side::S0 => i,
            side::S1 => degree.s * width + i,
            side::T0 => i * width,
            _ => i * width + degree.t,
        }
    }

    /// The poles of the isocurve on side `k` at parameter `x`, into `out`; returns its degree.
    fn edge_net(&mut self, k: usize, x: f64, out: &mut [f64]) -> usize {
        let degree = self.sheet.net.degree;
        let (rows, columns) = (degree.s + 1, degree.t + 1);
        let across_s = k == side::S0 || k == side::S1;
        let size = if across_s { columns } else { rows };
        if x == 0.0 || x == 1.0 {
            let (first, step) = match k {
                side::S0 => (0, 1),
                side::S1 => (degree.s * columns, 1),
                side::T0 => (0, columns),
                _ => (degree.t, columns),
            };
            let components = self.sheet.net.poles.chunks_exact(rows * columns);
            for (component, edge) in components.zip(out.chunks_exact_mut(size)) {
                for (i, pole) in edge.iter_mut().enumerate() {
                    *pole = component[first + i * step];
                }
            }
            return size - 1;
        }
        for (component, edge) in
            self.sheet.net.poles.chunks_exact(rows * columns).zip(out.chunks_exact_mut(size))
        {
            let work = &mut self.memory.net[..rows * columns];
            work.copy_from_slice(component);
            isocurve(work, degree, across_s, x, edge);
        }
        size - 1
    }

    /// At a collapsed side: whether the distance changes strictly along the side everywhere off it (see
    /// `collapsed`). Then only the collapsed point or a border can be nearest.
    pub(super) fn turning(&mut self, area: &Area, at: usize, weight: f64) -> bool {
        let ends = [area.s[0], area.s[1], area.t[0], area.t[1]];
        let touched =
            (0..4).find(|&k| self.sheet.patch.collapsed[k] && ends[k] == [0.0, 1.0, 0.0, 1.0][k]);
        let Some(k) = touched else { return false };
        let ((low, high), allowance) = self.turning_extent(area, at, k, weight);
        if low > allowance || high < -allowance {
            self.follow_side(area, at, 2 * along(k) + usize::from(high < 0.0));
            return true;
        }
        false
    }

    /// Extent of the slope along side `k` off that side, and its rounding.
    fn turning_extent(
        &mut self,
        area: &Area,
        at: usize,
        k: usize,
        weight: f64,
    ) -> ((f64, f64), f64) {
        let mut memory = std::mem::take(&mut self.memory.turning);
        let degree = self.sheet.ladder.whole().degree;
        let n_degree = [degree.s, degree.t][along(k)] as f64;
        let found = if self.sheet.net.rational {
            let net = self.sheet.net.degree;
            let w = &mut self.memory.weights;
            w.clear();
            w.extend_from_slice(&self.sheet.net.poles[3 * net.count()..]);
            cut_2d(w, net, area.s, area.t);
            let slot = &self.memory.coefficients[at * self.slot..(at + 1) * self.slot];
            let n = self.sheet.ladder.whole().n(slot);
            let found = rational_slope_extent(n, w, net, k, &mut memory);
            let size = product_steps(2 * net.count()) * area.radius * area.radius;
            (found, 8.0 * n_degree * extent(w).1 * weight * (area.error + size))
        } else {
            (slope_extent(self.n(area, at), degree, k, &mut memory), 2.0 * n_degree * area.error)
        };
        self.memory.turning = memory;
        found
    }
}
