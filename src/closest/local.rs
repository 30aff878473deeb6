//! Local scope: the published iterations on the shape itself, from a hint or from the published start.
//!
//! The start is that of Hu, Sun, Jin, Wang: the pieces whose hull (a box that holds it) holds the query are cut
//! three times; the parameters of the sub-piece that survives are the start. Where several or none survive, the
//! one with the nearest box is taken, and of its corners the nearest.

use super::flag;
use crate::bezier::{cut, cut_2d};
use crate::bounds::{Aabb, Vector, norm, scaled, sub};
use crate::curve::Curve;
use crate::index::{CurveIndex, SurfaceIndex};
use crate::jet::{Jet1, Jet2};
use crate::refine::{CurveJets, SurfaceJets};
use crate::surface::Surface;

/// Parts of a piece in either direction: three levels of subdivision.
const PARTS: u32 = 8;

/// A curve as the local iteration sees it, in the caller's coordinates.
pub struct WholeCurve<'a> {
    /// The curve.
    pub curve: &'a Curve,
    /// The query.
    pub query: Vector,
    /// What lengths are multiplied by, a power of two: thresholds of the iteration are for shapes of size 1.
    pub scale: f64,
    /// Whether a rounded point says too little about its distance.
    pub coarse: bool,
}

/// A surface as the local iteration sees it, in the caller's coordinates.
pub struct WholeSurface<'a> {
    /// The surface.
    pub surface: &'a Surface,
    /// The query.
    pub query: Vector,
    /// What lengths are multiplied by, a power of two.
    pub scale: f64,
    /// Whether a rounded point says too little about its distance.
    pub coarse: bool,
}

impl CurveJets for WholeCurve<'_> {
    fn jet(&self, s: f64) -> Jet1 {
        let mut out = [[0.0; 3]; 3];
        self.curve.derivatives(s, 2, &mut out);
        out[0] = if self.coarse {
            self.curve.vector_from(self.query, s)
        } else {
            sub(out[0], self.query)
        };
        let [d, s, ss] = out.map(|vector| scaled(vector, self.scale));
        Jet1 { d, s, ss, w: [1.0, 0.0] }
    }

    fn global(&self, s: f64) -> [f64; 2] {
        [s, 0.0]
    }

    fn scale(&self) -> f64 {
        self.scale
    }
}

impl SurfaceJets for WholeSurface<'_> {
    fn jet(&self, s: f64, t: f64) -> Jet2 {
        let mut out = [[0.0; 3]; 6];
        self.surface.partials(s, t, 2, &mut out);
        out[0] = if self.coarse {
            self.surface.vector_from(self.query, s, t)
        } else {
            sub(out[0], self.query)
        };
        let [d, s, t, ss, st, tt] = out.map(|vector| scaled(vector, self.scale));
        Jet2 { d, s, t, ss, st, tt, w: [1.0, 0.0, 0.0] }
    }

    fn global(&self, s: f64, t: f64) -> [f64; 2] {
        [s, t]
    }

    fn scale(&self) -> f64 {
        self.scale
    }
}

/// Flags of every local answer.
pub const LOCAL_FLAGS: u32 = flag::NOT_PROVEN;

fn distance_to(aabb: &Aabb, query: Vector) -> f64 {
    norm([0, 1, 2].map(|k| (aabb.low[k] - query[k]).max(query[k] - aabb.high[k]).max(0.0)))
}

fn hull(net: &[f64], count: usize, rational: bool) -> Aabb {
    let mut aabb = Aabb::EMPTY;
    for k in 0..count {
        let w = if rational { net[3 * count + k] } else { 1.0 };
        aabb.include([net[k] / w, net[count + k] / w, net[2 * count + k] / w]);
    }
    aabb
}

/// The published start on a curve; `query` in the index's coordinates, `net` is scratch.
pub fn curve_start(index: &CurveIndex, query: Vector, net: &mut Vec<f64>) -> f64 {
    let mut best = (f64::INFINITY, 0.0);
    for (k, segment) in index.segments.iter().enumerate() {
        let view = index.net(k);
        let p = sub(query, segment.center);
        for part in 0..PARTS {
            let range = part_range(part);
            net.clear();
            net.extend_from_slice(view.poles);
            for component in net.chunks_exact_mut(view.degree + 1) {
                cut(component, view.degree, 1, 1, range[0], range[1]);
            }
            let away = distance_to(&hull(net, view.degree + 1, view.rational), p);
            if away < best.0 {
                let nearest = range.map(|s| norm(view.jet(s, p).d));
                let s = if nearest[0] <= nearest[1] { range[0] } else { range[1] };
                best = (away, segment.u.global(s));
            }
        }
    }
    best.1
}

/// The published start on a surface; `query` in the index's coordinates, `net` is scratch.
pub fn surface_start(index: &SurfaceIndex, query: Vector, net: &mut Vec<f64>) -> [f64; 2] {
    let mut best = (f64::INFINITY, [0.0; 2]);
    for k in 0..index.patches.len() {
        let view = index.net(k);
        let aabb = hull(view.poles, view.degree.count(), view.rational);
        if distance_to(&aabb, sub(query, index.patches[k].center)) < best.0 {
            patch_start(index, k, query, net, &mut best);
        }
    }
    best.1
}

fn part_range(part: u32) -> [f64; 2] {
    [part, part + 1].map(|x| f64::from(x) / f64::from(PARTS))
}

fn patch_start(
    index: &SurfaceIndex,
    k: usize,
    query: Vector,
    net: &mut Vec<f64>,
    best: &mut (f64, [f64; 2]),
) {
    let (view, patch) = (index.net(k), &index.patches[k]);
    let p = sub(query, patch.center);
    for part in 0..PARTS * PARTS {
        let (s, t) = (part_range(part / PARTS), part_range(part % PARTS));
        net.clear();
        net.extend_from_slice(view.poles);
        for component in net.chunks_exact_mut(view.degree.count()) {
            cut_2d(component, view.degree, s, t);
        }
        let away = distance_to(&hull(net, view.degree.count(), view.rational), p);
        if away < best.0 {
            let corners = [[s[0], t[0]], [s[0], t[1]], [s[1], t[0]], [s[1], t[1]]];
            let apart = |at: &[f64; 2]| norm(view.jet(at[0], at[1], p).d);
            let nearest = corners.into_iter().min_by(|a, b| apart(a).total_cmp(&apart(b)));
            let [s, t] = nearest.unwrap_or([s[0], t[0]]);
            *best = (away, [patch.u.global(s), patch.v.global(t)]);
        }
    }
}
