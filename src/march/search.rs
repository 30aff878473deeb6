//! All arcs of the intersection: pairs of parts are judged, and halved until nothing is open.
//!
//! ```text
//!   pairs of patches whose boxes meet -> judge -> empty | one arc | halve the part that bends more
//!                                                              |
//!          surfaces touch here to the last digits, along a curve or everywhere: kept for `trace`, `overlap`
//!          flat to the last digits: kept as undecided (a touching point, a branch point, a collapsed edge)
//! ```
//!
//! Level by level, so that a budget that runs out leaves boxes of equal size. Cost: linear in the length of the curves; a touching
//! point takes a constant number of pairs a level.

use super::arc::{Arc, Clip};
use super::contact::{into_domain, look, settle};
use super::pair::{Verdict, judge, misses};
use super::pieces::{Part, Pieces};
use super::watch::Watch;
use crate::bounds::{Aabb, HALF_ULP, Vector, cross, dot, norm, sub};
use crate::surface::Surface;

/// Halvings of a pair after which touching along a curve is looked for.
const LEVEL_OF_CURVES: u32 = 12;

/// Halvings of a pair after which coincidence is looked for.
const LEVEL_OF_AREAS: u32 = 8;

/// A relative curvature beyond this share of the greatest one is none by rounding, nor by what changes within a small part.
const BENDS_APART: f64 = 0.02;

/// Pairs between two looks at whether to stop.
const GROUP: u64 = 256;

/// Parts of a surface are at most this many: what they hold is memory.
pub const MOST_PARTS: usize = 2_000_000;

/// What a pair that was not divided further is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Open {
    /// The surfaces touch along a curve there.
    Curve,
    /// They coincide there.
    Area,
    /// Both parts are flat to the last digits, and still nothing is known.
    Flat,
    /// It was not reached: the budget ran out, or the caller said stop.
    Left,
}

/// A collapsed edge that comes near the other surface.
#[derive(Clone, Copy, Debug)]
pub struct Tip {
    /// A (0) or B (1).
    pub whose: usize,
    /// 0 to 3: u low, u high, v low, v high.
    pub side: usize,
    /// As far as this parameter the surface was taken for a point.
    pub inner: f64,
}

/// A pair that was not divided further: a box of u, v, s, t.
#[derive(Clone, Copy, Debug)]
pub struct OpenPair {
    /// Why.
    pub why: Open,
    /// Least parameters.
    pub low: [f64; 4],
    /// Greatest parameters.
    pub high: [f64; 4],
    /// Size of the smaller part, a length: what the two have in common is not larger.
    pub size: f64,
}

/// An arc with the sides of the patches at its ends.
pub struct Found {
    /// The arc.
    pub arc: Arc,
    /// Side of a patch (2 q + high, q = u, v, s, t) at its low and high end.
    pub ends: [Option<usize>; 2],
}

/// The search and what it found.
pub struct Search<'a> {
    /// The surfaces in the frame of the search.
    pub surfaces: [&'a Surface; 2],
    /// A in pieces.
    pub a: Pieces,
    /// B in pieces.
    pub b: Pieces,
    /// How far two positions may be off together.
    pub error: f64,
    /// Lengths below this are rounding.
    pub floor: f64,
    /// The caller's point tolerance; 0: none.
    tolerance: f64,
    /// Arcs, in the order in which they were found.
    pub found: Vec<Found>,
    /// What is open.
    pub open: Vec<OpenPair>,
    /// Collapsed edges that come near the other surface.
    pub tips: Vec<Tip>,
    /// Pairs judged.
    pub judged: u64,
    /// Whether the budget ran out.
    pub exhausted: bool,
}

impl<'a> Search<'a> {
    /// Prepares two surfaces of size about one around the origin; `noise`: what their poles may be off; `tolerance`: what is nearer
    /// may count as touching.
    pub fn new(surfaces: [&'a Surface; 2], noise: f64, tolerance: f64) -> Self {
        let (a, b) = (Pieces::new(surfaces[0]), Pieces::new(surfaces[1]));
        let floor = 64.0 * HALF_ULP + 2.0 * (noise + a.error + b.error);
        let error = a.error + b.error + noise;
        Self {
            surfaces,
            a,
            b,
            error,
            floor,
            tolerance,
            found: Vec::new(),
            open: Vec::new(),
            tips: Vec::new(),
            judged: 0,
            exhausted: false,
        }
    }

    /// Gaps up to this are none: so many times what rounding does, or the caller's tolerance.
    pub fn touching_gap(&self, times: f64) -> f64 {
        (times * self.floor).max(self.tolerance)
    }

    /// Judges all pairs, at most `budget`, until the watch says stop; what waits then is left open.
    pub fn run(&mut self, budget: u64, watch: &Watch) {
        let mut waiting = self.first_pairs();
        let mut level = 0;
        while !waiting.is_empty() {
            let mut next = Vec::new();
            for (k, &pair) in waiting.iter().enumerate() {
                self.exhausted =
                    self.judged >= budget || self.a.parts.len() + self.b.parts.len() > MOST_PARTS;
                let left = (waiting.len() - k + next.len()) as u64;
                let is_asked = !self.exhausted && self.judged.is_multiple_of(GROUP);
                if self.exhausted || is_asked && watch.asks(self.judged, left) {
                    for &pair in waiting[k..].iter().chain(&next) {
                        self.leave(pair, Open::Left);
                    }
                    return;
                }
                self.step(pair, level, &mut next);
            }
            waiting = next;
            level += 1;
        }
    }

    /// Whether two parts that do not meet may be nearer than the caller's tolerance where they are parallel.
    fn may_touch(&self, a: &Part, b: &Part) -> bool {
        self.may_be_parallel(a, b) && !misses(a, b, self.error + self.tolerance)
    }

    /// Whether two parts may be parallel somewhere, as far as the caller's tolerance counts; false where there is none.
    fn may_be_parallel(&self, a: &Part, b: &Part) -> bool {
        if self.tolerance == 0.0 {
            return false;
        }
        // Planes that part by less than the tolerance over these parts are parallel here.
        let parting = self.tolerance / size(a).min(size(b)).max(1e-300);
        norm(cross(a.normal, b.normal)) <= a.tilt() + b.tilt() + parting
    }

    /// Pairs of patches whose boxes meet: blocks of B's patches first.
    fn first_pairs(&self) -> Vec<(u32, u32)> {
        const BLOCK: usize = 32;
        let near = self.touching_gap(1.0);
        let meets = |a: &Aabb, b: &Aabb| {
            (0..3).all(|k| a.low[k] <= b.high[k] + near && b.low[k] <= a.high[k] + near)
        };
        let of = |pieces: &Pieces, k: usize| pieces.parts[pieces.patches[k].root as usize].aabb;
        let blocks: Vec<Aabb> = (0..self.b.patches.len().div_ceil(BLOCK))
            .map(|block| {
                let last = ((block + 1) * BLOCK).min(self.b.patches.len());
                (block * BLOCK..last).fold(Aabb::EMPTY, |all, k| all.union(of(&self.b, k)))
            })
            .collect();
        let mut pairs = Vec::new();
        for i in 0..self.a.patches.len() {
            let ours = of(&self.a, i);
            for (block, aabb) in blocks.iter().enumerate() {
                if !meets(&ours, aabb) {
                    continue;
                }
                for j in block * BLOCK..((block + 1) * BLOCK).min(self.b.patches.len()) {
                    if meets(&ours, &of(&self.b, j)) {
                        pairs.push((self.a.patches[i].root, self.b.patches[j].root));
                    }
                }
            }
        }
        pairs
    }

    fn step(&mut self, (i, j): (u32, u32), level: u32, next: &mut Vec<(u32, u32)>) {
        self.judged += 1;
        let (a, b) = (&self.a.parts[i as usize], &self.b.parts[j as usize]);
        let by_size = size(a) >= size(b);
        let halve_first = match judge([&self.a, &self.b], [a, b], self.error) {
            Verdict::Empty if self.may_touch(a, b) => by_size,
            Verdict::Empty => return,
            Verdict::Arc(arc) => match self.keep(*arc, [i, j]) {
                true => return,
                false => by_size,
            },
            Verdict::Halve(first) => first,
        };
        let (a, b) = (&self.a.parts[i as usize], &self.b.parts[j as usize]);
        if let Some((whose, side)) = self.tip(a, b) {
            return self.keep_tip(whose, side, [i, j]);
        }
        // What crosses at an angle is told apart as far as the arithmetic can.
        let thin = if self.may_be_parallel(a, b) { self.touching_gap(1.0) } else { self.floor };
        let flat = a.bend().min(1e9) + b.bend().min(1e9) <= thin
            || is_slab(a.normal, a, b, thin)
            || is_slab(b.normal, a, b, thin);
        let narrow = |p: &Part| (0..2).any(|k| p.high[k] - p.low[k] < 1e-12);
        if flat || narrow(a) || narrow(b) {
            for (whose, side) in [a.pole, b.pole].into_iter().enumerate() {
                if let Some(side) = side {
                    self.keep_tip(whose, side, [i, j]);
                }
            }
            let (a, b) = (&self.a.parts[i as usize], &self.b.parts[j as usize]);
            let why = if level < 2 && self.coincide(a, b) { Open::Area } else { Open::Flat };
            return self.leave((i, j), why);
        }
        let looked = level >= LEVEL_OF_AREAS && level.is_multiple_of(4) && parallel(a, b);
        if let Some(why) = looked.then(|| self.touching(a, b, level)).flatten() {
            return self.leave((i, j), why);
        }
        if halve_first {
            next.extend(self.a.halves(i).map(|i| (i, j)));
        } else {
            next.extend(self.b.halves(j).map(|j| (i, j)));
        }
    }

    /// Within this of a collapsed edge the surface counts as a point.
    pub fn tip_size(&self) -> f64 {
        2048.0 * self.floor
    }

    /// Whether one of two parts is the end of a surface at a collapsed edge, and as good as a point.
    fn tip(&self, a: &Part, b: &Part) -> Option<(usize, usize)> {
        let is_tip = |part: &Part| part.pole.filter(|_| part.aabb.diagonal() <= self.tip_size());
        is_tip(a).map(|side| (0, side)).or_else(|| is_tip(b).map(|side| (1, side)))
    }

    /// Keeps a collapsed edge, with all that is as good as a point there.
    fn keep_tip(&mut self, whose: usize, side: usize, [i, j]: [u32; 2]) {
        let (pieces, k) = if whose == 0 { (&self.a, i) } else { (&self.b, j) };
        let part = &pieces.parts[k as usize];
        let [low, high] = [part.low, part.high].map(|at| pieces.global(part.patch, at)[side / 2]);
        // Low sides are even.
        let (outer, inner) = if side & 1 == 0 { (low, high) } else { (high, low) };
        match self.tips.iter_mut().find(|tip| (tip.whose, tip.side) == (whose, side)) {
            Some(tip) if (tip.inner - outer).abs() < (inner - outer).abs() => tip.inner = inner,
            Some(_) => {}
            None => self.tips.push(Tip { whose, side, inner }),
        }
    }

    /// Keeps the part of an arc that is inside the patches; false when that is not clear.
    fn keep(&mut self, mut arc: Arc, parts: [u32; 2]) -> bool {
        let slack = self.slack(&arc, parts);
        match arc.clip(&self.a, &self.b, slack) {
            Clip::Outside => true,
            Clip::Unclear => false,
            Clip::Kept(ends) => {
                self.found.push(Found { arc, ends });
                true
            }
        }
    }

    /// How far parameters may leave the patches, in unit parameters: what rounding does to them.
    fn slack(&self, arc: &Arc, [i, j]: [u32; 2]) -> [f64; 4] {
        let (a, b) = (&self.a.parts[i as usize], &self.b.parts[j as usize]);
        let slope = [a.slope[0], a.slope[1], b.slope[0], b.slope[1]].map(norm);
        [0, 1, 2, 3].map(|q| {
            let most = 0.01 * arc.half[q];
            (self.floor * arc.half[q] / slope[q].max(1e-300)).clamp(1e-14f64.min(most), most)
        })
    }

    fn leave(&mut self, (i, j): (u32, u32), why: Open) {
        let (a, b) = (&self.a.parts[i as usize], &self.b.parts[j as usize]);
        let ends = |a_at: [f64; 2], b_at: [f64; 2]| {
            let ([u, v], [s, t]) = (self.a.global(a.patch, a_at), self.b.global(b.patch, b_at));
            [u, v, s, t]
        };
        let (low, high) = (ends(a.low, b.low), ends(a.high, b.high));
        let size = a.aabb.diagonal().min(b.aabb.diagonal());
        self.open.push(OpenPair { why, low, high, size });
    }

    fn middle(&self, a: &Part, b: &Part) -> [f64; 4] {
        let half = |p: &Part| [0.5 * (p.low[0] + p.high[0]), 0.5 * (p.low[1] + p.high[1])];
        let ([u, v], [s, t]) = (self.a.global(a.patch, half(a)), self.b.global(b.patch, half(b)));
        [u, v, s, t]
    }

    /// Whether the surfaces touch in this pair along a curve, or coincide, to the last digits.
    fn touching(&self, a: &Part, b: &Part, level: u32) -> Option<Open> {
        let [u, v, s, t] = self.middle(a, b);
        // Where they bend apart both ways they touch in a point at most.
        if let Some((here, _)) = look(self.surfaces[0], self.surfaces[1], [u, v], [s, t])
            && here.curvature[1].abs() > BENDS_APART * here.greatest
        {
            return None;
        }
        if self.coincide(a, b) {
            return Some(Open::Area);
        }
        if level < LEVEL_OF_CURVES {
            return None;
        }
        let (sa, sb) = (self.surfaces[0], self.surfaces[1]);
        let start = self.middle(a, b);
        let reach = size(a).max(size(b));
        let touch = settle(sa, sb, start, reach)?;
        let none = self.touching_gap(1.0);
        if touch.gap.abs() > none || touch.slope > 1e-7 || touch.rank() != 1 {
            return None;
        }
        // The same must hold a little farther along the curve, on both sides.
        let goes_on = |sign: f64| {
            let by = 0.5 * sign * size(a).min(size(b));
            let moved = [0, 1].map(|k| start[k] + by * touch.step[1][k]);
            let moved = into_domain(sa, moved);
            settle(sa, sb, [moved[0], moved[1], touch.at[2], touch.at[3]], reach).is_some_and(|t| {
                let there = sa.evaluate(t.at[0], t.at[1]);
                let moved =
                    norm(sub(there, sa.evaluate(touch.at[0], touch.at[1]))) > 0.25 * by.abs();
                moved && t.gap.abs() <= none && t.rank() == 1 && t.slope <= 1e-7
            })
        };
        (goes_on(1.0) && goes_on(-1.0)).then_some(Open::Curve)
    }

    /// Whether gap and relative curvatures are rounding at nine places of either part, as far as they lie over the other surface.
    fn coincide(&self, a: &Part, b: &Part) -> bool {
        let middle = self.middle(a, b);
        let (uv, st) = ([middle[0], middle[1]], [middle[2], middle[3]]);
        let Some(ours) = self.on_other([0, 1], a, st) else { return false };
        let Some(theirs) = self.on_other([1, 0], b, uv) else { return false };
        ours + theirs > 0
    }

    /// At how many of nine places of a part the other surface coincides; `None` when it does not at one that lies over it.
    fn on_other(&self, [own, other]: [usize; 2], part: &Part, near: [f64; 2]) -> Option<usize> {
        let (surface, other) = (self.surfaces[own], self.surfaces[other]);
        let pieces = if own == 0 { &self.a } else { &self.b };
        let mut seen = 0;
        // The middle first: most pairs are told apart there.
        for n in [4, 0, 2, 6, 8, 1, 3, 5, 7] {
            let share = [0.5 * (n / 3) as f64, 0.5 * (n % 3) as f64];
            let at = [0, 1].map(|k| part.low[k] + share[k] * (part.high[k] - part.low[k]));
            let at = pieces.global(part.patch, at);
            // A collapsed edge has no tangent plane: the other places decide.
            let Some((touch, _)) = look(surface, other, at, near) else { continue };
            let apart =
                norm(sub(surface.evaluate(at[0], at[1]), other.evaluate(touch.at[2], touch.at[3])));
            if apart > 2.0 * touch.gap.abs() + 8.0 * self.floor {
                continue;
            }
            let none = self.touching_gap(2.0);
            if touch.gap.abs() > none || touch.slope > 1e-6 || touch.rank() > 0 {
                return None;
            }
            seen += 1;
        }
        Some(seen)
    }
}

/// Whether both parts lie between two parallel planes at most `thickness` apart: what they do there rounding hides.
fn is_slab(n: Vector, a: &Part, b: &Part, thickness: f64) -> bool {
    if n == [0.0; 3] {
        return false;
    }
    let mut range = (f64::INFINITY, f64::NEG_INFINITY);
    for &p in a.hull.iter().chain(&b.hull) {
        let x = dot(n, sub(p, a.at));
        range = (range.0.min(x), range.1.max(x));
        if range.1 - range.0 > thickness {
            return false;
        }
    }
    true
}

fn size(part: &Part) -> f64 {
    norm(part.slope[0]) + norm(part.slope[1])
}

fn parallel(a: &Part, b: &Part) -> bool {
    norm(cross(a.normal, b.normal)) < 0.2
}
