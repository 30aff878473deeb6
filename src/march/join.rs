//! Branches from arcs: walked from arc to arc, over knot lines and seams, with points as close as the chord tolerance asks.
//!
//! ```text
//!   arc 1  x----------------x          the end of each arc lies inside the next one: found by its proven surroundings,
//!   arc 2              x---------x     never by nearness alone; at a knot line both sides are asked
//! ```
//!
//! Points between are solutions on the same arc, so a refinement cannot jump to another branch, and the bounds of the arc say how far
//! it may leave their chords. After a stop arcs are still joined, which takes little beside finding them, but no points are put between.

use super::arc::Arc;
use super::pieces::Pieces;
use super::search::Search;
use super::watch::Watch;
use crate::bounds::{Vector, dot, norm, scaled, sub};
use std::collections::HashMap;

/// Most chords between two ends of an arc.
const MOST_CHORDS: f64 = 4096.0;

/// A place on both surfaces: position in the frame of the search, and u, v, s, t.
#[derive(Clone, Copy, Debug)]
pub struct Place {
    /// Position.
    pub x: Vector,
    /// Parameters.
    pub at: [f64; 4],
}

/// How a chain ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stop {
    /// On a border of a surface: the side 2 q + high, q = u, v, s, t.
    Border(usize),
    /// Nothing goes on: an undecided box is there.
    Open,
    /// Where it began.
    Closed,
}

/// A chain of arcs as places in order.
pub struct Chain {
    /// Places u, v, s, t; at a seam the same position comes twice.
    pub places: Vec<[f64; 4]>,
    /// How it ends, at its beginning and at its end.
    pub stops: [Stop; 2],
    /// How far it may leave the chord of two places, proven.
    pub chord: f64,
    /// How far its parameters may leave theirs, proven.
    pub bulge: [f64; 4],
    /// For each chord the parameter over which it is a graph; 5 where it passes a seam.
    pub held: Vec<u8>,
}

/// A piece of an arc that a chain runs over, in order.
#[derive(Clone, Copy)]
struct Step {
    arc: usize,
    from: f64,
    to: f64,
    jump: bool,
}

/// Arcs by the patches that they belong to.
pub struct Joiner<'a, 'b, 'w> {
    search: &'a Search<'b>,
    by_patches: HashMap<[u32; 2], Vec<usize>>,
    used: Vec<bool>,
    /// The last walk that passed each arc.
    visited: Vec<u32>,
    walks: u32,
    closed: [bool; 4],
    collapsed: [bool; 8],
    domain: [f64; 8],
    chord: f64,
    watch: &'a Watch<'w>,
}

impl<'a, 'b, 'w> Joiner<'a, 'b, 'w> {
    /// Sorts the arcs of a search; `chord`: how far points may lie from the chord of their neighbours.
    pub fn new(search: &'a Search<'b>, chord: f64, watch: &'a Watch<'w>) -> Self {
        let mut by_patches: HashMap<[u32; 2], Vec<usize>> = HashMap::new();
        for (k, found) in search.found.iter().enumerate() {
            by_patches.entry(found.arc.patches).or_default().push(k);
        }
        let [a, b] = search.surfaces;
        let (da, db) = (a.domain(), b.domain());
        Self {
            search,
            by_patches,
            used: vec![false; search.found.len()],
            visited: vec![0; search.found.len()],
            walks: 0,
            closed: [a.is_closed_u(), a.is_closed_v(), b.is_closed_u(), b.is_closed_v()],
            collapsed: std::array::from_fn(|k| {
                [a.collapsed_edges(), b.collapsed_edges()][k / 4][k % 4]
            }),
            domain: [da[0], da[1], da[2], da[3], db[0], db[1], db[2], db[3]],
            chord,
            watch,
        }
    }

    /// All chains, and places where an arc has no length (a corner of a domain that just meets the other surface).
    pub fn chains(mut self) -> (Vec<Chain>, Vec<[f64; 4]>) {
        let (mut chains, mut points) = (Vec::new(), Vec::new());
        let count = self.search.found.len();
        for k in 0..count {
            self.watch.stops(count - k);
            let arc = &self.search.found[k].arc;
            if self.used[k] || arc.x[1] - arc.x[0] < 1e-9 {
                continue;
            }
            let middle = 0.5 * (arc.x[0] + arc.x[1]);
            if self.is_covered(k, middle) {
                self.used[k] = true;
                continue;
            }
            chains.push(self.chain(k, middle));
        }
        for k in 0..self.search.found.len() {
            let arc = &self.search.found[k].arc;
            if !self.used[k] && arc.x[1] - arc.x[0] < 1e-9 && !self.is_covered(k, arc.x[0]) {
                self.used[k] = true;
                points.push(self.place(arc, arc.x[0]));
            }
        }
        (chains, points)
    }

    /// u, v, s, t of the solution at `x`.
    fn place(&self, arc: &Arc, x: f64) -> [f64; 4] {
        self.global(arc.patches, arc.solve(&self.search.a, &self.search.b, x))
    }

    fn global(&self, patches: [u32; 2], z: [f64; 4]) -> [f64; 4] {
        let ([u, v], [s, t]) = (
            self.search.a.global(patches[0], [z[0], z[1]]),
            self.search.b.global(patches[1], [z[2], z[3]]),
        );
        let all = [u, v, s, t];
        [0, 1, 2, 3].map(|q| all[q].clamp(self.domain[2 * q], self.domain[2 * q + 1]))
    }

    /// Arcs that a place lies on, with its position there.
    fn on(&self, at: [f64; 4]) -> Vec<(usize, f64)> {
        let (mut found, (a, b)) = (Vec::new(), (&self.search.a, &self.search.b));
        let room = self.room(at);
        let theirs = b.patches_at([at[2], at[3]], [room[2], room[3]]);
        for pa in a.patches_at([at[0], at[1]], [room[0], room[1]]) {
            let uv = a.local(pa, [at[0], at[1]]);
            for &pb in &theirs {
                let Some(arcs) = self.by_patches.get(&[pa, pb]) else { continue };
                let st = b.local(pb, [at[2], at[3]]);
                for &k in arcs {
                    let arc = &self.search.found[k].arc;
                    if let Some(x) = arc.position([uv[0], uv[1], st[0], st[1]], slack(arc)) {
                        found.push((k, x));
                    }
                }
            }
        }
        found
    }

    /// How far rounding may move the parameters of a place, as shares of the patches: much beside a collapsed edge.
    fn room(&self, at: [f64; 4]) -> [f64; 4] {
        let of = |pieces: &Pieces, at: [f64; 2]| {
            let Some(&patch) = pieces.patches_at(at, [1e-9; 2]).first() else { return [1e-9; 2] };
            let [_, du, dv] = pieces.jet(patch, pieces.local(patch, at));
            [du, dv].map(|d| (self.search.floor / norm(d).max(1e-300)).clamp(1e-9, 1e-2))
        };
        let (a, b) = (of(&self.search.a, [at[0], at[1]]), of(&self.search.b, [at[2], at[3]]));
        [a[0], a[1], b[0], b[1]]
    }

    fn is_covered(&self, k: usize, x: f64) -> bool {
        let at = self.place(&self.search.found[k].arc, x);
        if self.on(at).iter().any(|&(j, _)| j != k && self.used[j]) {
            return true;
        }
        self.mirrored(at).iter().any(|&at| self.on(at).iter().any(|&(j, _)| j != k && self.used[j]))
    }

    /// The same place on the other side of the seams that it lies on.
    fn mirrored(&self, at: [f64; 4]) -> Vec<[f64; 4]> {
        let mut all = vec![at];
        if self.closed == [false; 4] {
            return Vec::new();
        }
        let room = self.room(at);
        for q in (0..4).filter(|&q| self.closed[q]) {
            let [low, high] = [self.domain[2 * q], self.domain[2 * q + 1]];
            let near = room[q] * (high - low);
            let other = if at[q] - low <= near {
                Some(high)
            } else {
                (high - at[q] <= near).then_some(low)
            };
            if let Some(other) = other {
                for k in 0..all.len() {
                    let mut moved = all[k];
                    moved[q] = other;
                    all.push(moved);
                }
            }
        }
        all.split_off(1)
    }

    /// +1 when x grows along the walk.
    fn sign(&self, k: usize, forward: bool) -> f64 {
        if self.search.found[k].arc.forward == forward { 1.0 } else { -1.0 }
    }

    fn chain(&mut self, start: usize, middle: f64) -> Chain {
        let (ahead, end) = self.walk(start, middle, true);
        if end == Stop::Closed {
            return self.made(&ahead, [end; 2]);
        }
        let (behind, first) = self.walk(start, middle, false);
        let mut steps: Vec<Step> = Vec::with_capacity(ahead.len() + behind.len());
        let mut jump = false;
        for step in behind.iter().rev() {
            steps.push(Step { arc: step.arc, from: step.to, to: step.from, jump });
            jump = step.jump;
        }
        steps.extend(ahead);
        self.made(&steps, [first, end])
    }

    fn walk(&mut self, start: usize, x0: f64, forward: bool) -> (Vec<Step>, Stop) {
        let origin = self.place(&self.search.found[start].arc, x0);
        let homes = self.on(origin);
        self.walks += 1;
        let (mut k, mut x, mut jump) = (start, x0, false);
        let mut steps: Vec<Step> = Vec::new();
        for _ in 0..4 * self.search.found.len() + 16 {
            self.watch.stops(0);
            let found = &self.search.found[k];
            let sign = self.sign(k, forward);
            self.used[k] = true;
            self.visited[k] = self.walks;
            let high = sign > 0.0;
            let to = found.arc.x[usize::from(high)];
            if !steps.is_empty() {
                // Has the walk come back to where it began?
                if let Some(&(_, home)) =
                    homes.iter().find(|&&(j, home)| j == k && sign * (home - x) > -1e-9)
                {
                    steps.push(Step { arc: k, from: x, to: home, jump });
                    return (steps, Stop::Closed);
                }
            }
            steps.push(Step { arc: k, from: x, to, jump });
            let side = found.ends[usize::from(high)];
            let end = self.place(&found.arc, to);
            // A walk passes every arc once; only its first one is reached again, when it closes.
            let fresh = |found: Vec<(usize, f64)>| -> Vec<(usize, f64)> {
                let home = |j: usize, x: f64| {
                    j == start && j != k && self.sign(j, forward) * (x0 - x) > -1e-9
                };
                found
                    .into_iter()
                    .filter(|&(j, x)| self.visited[j] != self.walks || home(j, x))
                    .collect()
            };
            let mut next = self.onward(fresh(self.on(end)), forward);
            jump = false;
            if next.is_none() {
                next = self
                    .mirrored(end)
                    .into_iter()
                    .find_map(|at| self.onward(fresh(self.on(at)), forward));
                jump = next.is_some();
            }
            match next {
                Some((j, at)) => (k, x) = (j, at),
                None => return (steps, self.stop(side, end)),
            }
        }
        (steps, Stop::Open)
    }

    /// The arc that goes on farthest.
    fn onward(&self, arcs: Vec<(usize, f64)>, forward: bool) -> Option<(usize, f64)> {
        let mut best: Option<(usize, f64, f64)> = None;
        for (j, x) in arcs {
            let arc = &self.search.found[j].arc;
            let sign = self.sign(j, forward);
            let left = if sign > 0.0 { arc.x[1] - x } else { x - arc.x[0] };
            if left > 4.0 * slack(arc) {
                let length = left * arc.half[arc.k];
                if best.is_none_or(|b| length > b.2) {
                    best = Some((j, x, length));
                }
            }
        }
        best.map(|(j, x, _)| (j, x))
    }

    fn stop(&self, side: Option<usize>, at: [f64; 4]) -> Stop {
        // A collapsed edge is a point, and no border.
        let is_border = |side: usize| {
            let (q, end) = (side / 2, self.domain[side]);
            !self.collapsed[side]
                && (at[q] - end).abs() <= 1e-9 * (self.domain[2 * q + 1] - self.domain[2 * q])
        };
        match side {
            Some(side) if is_border(side) => Stop::Border(side),
            _ => (0..8).find(|&side| is_border(side)).map_or(Stop::Open, Stop::Border),
        }
    }

    /// Places along the steps, as many as the chord tolerance asks by the bounds of the arcs.
    fn made(&self, steps: &[Step], stops: [Stop; 2]) -> Chain {
        let (mut places, mut held) = (Vec::new(), Vec::new());
        let (mut chord, mut bulge) = (0.0f64, [0.0f64; 4]);
        let (a, b) = (&self.search.a, &self.search.b);
        for (n, step) in steps.iter().enumerate() {
            let arc = &self.search.found[step.arc].arc;
            let at = |x: f64| self.place(arc, x);
            if n == 0 || step.jump {
                places.push(at(step.from));
                if n > 0 {
                    held.push(super::Branch::JUMP);
                }
            }
            if (step.to - step.from).abs() < 1e-12 {
                continue;
            }
            let whole = arc.bulge(step.from, step.to, 1).0;
            let parts = (whole / (0.999 * self.chord)).sqrt().ceil().clamp(1.0, MOST_CHORDS);
            let widths = [a.width(arc.patches[0]), b.width(arc.patches[1])];
            let mut holds = |(far, aside): (f64, [f64; 4])| {
                chord = chord.max(far);
                bulge = [0, 1, 2, 3].map(|q| bulge[q].max(aside[q] * widths[q / 2][q % 2]));
            };
            holds(arc.bulge(step.from, step.to, parts as usize));
            let mut last = step.from;
            for k in 1..parts as usize {
                if self.watch.stops(steps.len() - n) {
                    // What is left of the arc is one chord.
                    holds(arc.bulge(last, step.to, 1));
                    break;
                }
                last = step.from + k as f64 / parts * (step.to - step.from);
                places.push(at(last));
            }
            places.push(at(step.to));
            held.resize(places.len() - 1, arc.k as u8);
        }
        Chain { places, stops, chord, bulge, held }
    }
}

/// What the rounding of parameters does to a position on an arc, in its half widths.
fn slack(arc: &Arc) -> f64 {
    let least = arc.half.iter().fold(f64::INFINITY, |m, h| m.min(*h));
    (1e-9 + 1e-13 / least).min(0.02)
}

/// Distance of a point from the segment between two others.
pub fn distance_to_chord(p: Vector, a: Vector, b: Vector) -> f64 {
    let (along, to) = (sub(b, a), sub(p, a));
    let length = dot(along, along);
    if length == 0.0 {
        return norm(to);
    }
    let share = (dot(to, along) / length).clamp(0.0, 1.0);
    norm(sub(to, scaled(along, share)))
}
