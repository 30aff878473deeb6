//! The record at a parameter pair: point, distance, and the flags of the place.

use crate::bounds::{Vector, cross, dot, norm};
use crate::closest::curve::LEAST_CREASE;
use crate::closest::{FootPoint, distance, flag, rounding_floor};
use crate::index::{IndexedSurface, SurfaceIndex};
use crate::knots::Knots;

impl IndexedSurface {
    /// The record at a parameter pair, with the flags of the place.
    pub(crate) fn foot_at(
        &self,
        index: &SurfaceIndex,
        query: Vector,
        at: [f64; 2],
        range: [f64; 4],
    ) -> FootPoint {
        let surface = self.surface();
        let ([u0, u1, v0, v1], mut at) = (surface.domain(), at);
        let mut point = surface.evaluate(at[0], at[1]);
        let closed = index.closed;
        let (first, last) = ([u0, v0], [u1, v1]);
        for k in 0..2 {
            if closed[k] && at[k] == last[k] && range[2 * k] == first[k] {
                // The canonical parameter of a seam is the start, when it is as near.
                let mut start = at;
                start[k] = first[k];
                let there = surface.evaluate(start[0], start[1]);
                let floor = rounding_floor(&index.frame, query, 0.0);
                if distance(query, there) <= distance(query, point) + floor {
                    (at, point) = (start, there);
                }
            }
        }
        let on = [at[0] == u0, at[0] == u1, at[1] == v0, at[1] == v1];
        FootPoint {
            u: at[0],
            v: at[1],
            point,
            distance: distance(query, point),
            lower_bound: 0.0,
            flags: place_flags(on, closed, index.collapsed) | self.crease_flag(index, at, closed),
            iterations: 0,
        }
    }

    /// [`flag::CREASE`] where the tangent plane breaks across a knot line of multiplicity >= degree, or across a
    /// seam.
    fn crease_flag(&self, index: &SurfaceIndex, at: [f64; 2], closed: [bool; 2]) -> u32 {
        let surface = self.surface();
        let [u0, u1, v0, v1] = surface.domain();
        let breaks = |knots: &Knots, x: f64, ends: [f64; 2], closed: bool| {
            let at_end = x == ends[0] || x == ends[1];
            if at_end { closed } else { knots.multiplicity(x) >= knots.degree() }
        };
        let in_u = breaks(surface.knots_u(), at[0], [u0, u1], closed[0]);
        let in_v = breaks(surface.knots_v(), at[1], [v0, v1], closed[1]);
        let bent = (in_u && index.normals_differ(at, 0)) || (in_v && index.normals_differ(at, 1));
        if bent { flag::CREASE } else { 0 }
    }
}

fn place_flags(on: [bool; 4], closed: [bool; 2], collapsed: [bool; 4]) -> u32 {
    let (in_u, in_v) = (on[0] || on[1], on[2] || on[3]);
    let mut flags = 0;
    if in_u || in_v {
        flags |= flag::EDGE;
    }
    if in_u && in_v {
        flags |= flag::CORNER;
    }
    if (in_u && closed[0]) || (in_v && closed[1]) {
        flags |= flag::SEAM;
    }
    if (0..4).any(|k| on[k] && collapsed[k]) {
        flags |= flag::COLLAPSED;
    }
    flags
}

impl SurfaceIndex {
    /// The pieces before and after `x` in direction `k`, of those that hold the other parameter; across the seam
    /// at the ends of the domain.
    fn normals_differ(&self, at: [f64; 2], k: usize) -> bool {
        let span = |piece: usize, k: usize| {
            if k == 0 { self.patches[piece].u } else { self.patches[piece].v }
        };
        let (rows, columns) = (self.patches.len() / self.columns, self.columns);
        let stride = [columns, 1][k];
        let count = [rows, columns][k];
        let other_count = [rows, columns][1 - k];
        let other_stride = [columns, 1][1 - k];
        let other = (0..other_count)
            .position(|i| at[1 - k] < span(i * other_stride, 1 - k).ends[1])
            .unwrap_or(other_count - 1);
        let base = other * other_stride;
        let after = (0..count).find(|&i| span(base + i * stride, k).ends[0] == at[k]);
        let (before, after) = match after {
            Some(0) | None => (count - 1, 0),
            Some(i) => (i - 1, i),
        };
        let normal = |piece: usize, y: f64| {
            let x = span(piece, 1 - k).local(at[1 - k]);
            let (s, t) = if k == 0 { (y, x) } else { (x, y) };
            let jet = self.net(piece).jet(s, t, [0.0; 3]);
            cross(jet.s, jet.t)
        };
        let a = normal(base + before * stride, 1.0);
        let b = normal(base + after * stride, 0.0);
        let size = norm(a) * norm(b);
        size > 0.0 && (norm(cross(a, b)) > LEAST_CREASE * size || dot(a, b) < 0.0)
    }
}
