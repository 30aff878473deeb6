//! An arc of the intersection: three parameters as functions of the fourth, followed with proof from node to node.
//!
//! ```text
//!   the map y -> F(x, y) is one to one in the reach (`pair`): for each x there is at most one solution there
//!   node: a solution x, y with its slope; within d of x      |y''| <= K by second derivatives over the reach,
//!                                                            so it goes on as long as |y| + |y'| d + K d^2 / 2 stays in the reach
//!   two nodes whose intervals meet are solutions of one arc, as there is no other one
//! ```
//!
//! The same bounds give the distance of the arc from its chords, in space and in the parameters.

use super::bends::{Bends, REACH};
use super::pieces::Pieces;
use super::system::{inverse, others, system};
use crate::bounds::{Vector, dot, norm, scaled, sub};

/// What is left of the estimates for rounding of nodes.
const CARE: f64 = 1.0 + 1e-4;

/// Newton's steps, in half widths, below which a node is good enough (its square is what is left), and a solution is.
const NODE: f64 = 1e-5;
const SOLUTION: f64 = 1e-8;

/// Below such a step the inverse is kept; and the product of it and a step after which what is left is below the last digits.
const FROZEN: f64 = 1e-3;
const LAST: f64 = 1e-15;

/// Steps of Newton at most.
const MOST_STEPS: u32 = 12;

/// How far a node may be off, in half widths.
const OFF: f64 = 1e-9;

/// Rows of a matrix applied to the second derivatives of both surfaces: bounds for uu, uv, vv of either.
pub type Bent = [[f64; 3]; 2];

/// A row applied to the second derivatives of both surfaces.
pub fn bent(row: Vector, bends: [&Bends; 2]) -> Bent {
    let size = [row[0].abs(), row[1].abs(), row[2].abs()];
    let one = |b: &Bends, n: usize| dot(row, b.middle[n]).abs() + dot(size, b.spread[n]);
    let of = |b: &Bends| [one(b, 0), one(b, 1), one(b, 2)];
    [of(bends[0]), of(bends[1])]
}

/// Greatest change of the slopes along both parameters of a surface within half widths `r`.
pub fn change(h: [f64; 3], r: [f64; 2]) -> [f64; 2] {
    [h[0] * r[0] + h[1] * r[1], h[1] * r[0] + h[2] * r[1]]
}

/// Greatest second derivative along directions within `t`.
pub fn form(h: [f64; 3], t: [f64; 2]) -> f64 {
    h[0] * t[0] * t[0] + 2.0 * h[1] * t[0] * t[1] + h[2] * t[1] * t[1]
}

/// A solution, and what holds within the half distance of nodes.
#[derive(Clone, Copy, Debug)]
struct Node {
    x: f64,
    y: [f64; 3],
    slope: [f64; 3],
    /// Bounds of the second derivatives of y.
    bend: [f64; 3],
    /// Bound of the second derivative of the point in space.
    curve: f64,
}

/// An arc of the intersection of two patches: the graph of three parameters over the fourth.
#[derive(Clone, Debug)]
pub struct Arc {
    /// Patch of A, patch of B.
    pub patches: [u32; 2],
    /// Middle of the part in the unit parameters of the patches.
    pub middle: [f64; 4],
    /// Half widths.
    pub half: [f64; 4],
    /// The parameter over which it is a graph.
    pub k: usize,
    /// Its interval, in half widths.
    pub x: [f64; 2],
    /// Whether x grows along n_A x n_B.
    pub forward: bool,
    nodes: Vec<Node>,
    /// Where the interval of the first node begins, and half the length of each.
    begin: f64,
    step: f64,
}

/// What the ends of the patches do to an arc.
pub enum Clip {
    /// It lies outside.
    Outside,
    /// It stays, or what is left of it; the patch side at its low and high end, if it ends there.
    Kept([Option<usize>; 2]),
    /// It runs along a side and cannot be told from it: halve.
    Unclear,
}

/// The equations around which an arc is followed.
pub struct Frame<'a> {
    /// The surfaces.
    pub pieces: [&'a Pieces; 2],
    /// Their bends in the part.
    pub bends: [&'a Bends; 2],
    /// Patches of both.
    pub patches: [u32; 2],
    /// Middle of the part in the unit parameters of the patches.
    pub middle: [f64; 4],
    /// Half widths.
    pub half: [f64; 4],
    /// The parameter over which the arc is a graph.
    pub k: usize,
}

/// Why an arc is not found in this way.
enum Failure {
    /// A solution lies outside of the reach.
    Leaves,
    /// More nodes might do.
    Bends,
}

/// Newton's iteration for the three others at `x`: where it ends, the columns there, and how far it may be off, in half widths.
fn newton(
    pieces: [&Pieces; 2],
    patches: [u32; 2],
    (middle, half): ([f64; 4], [f64; 4]),
    k: usize,
    x: f64,
    mut y: [f64; 3],
    enough: f64,
) -> Option<([f64; 3], [Vector; 4], f64)> {
    let o = others(k);
    let mut last = f64::INFINITY;
    for n in 1..=MOST_STEPS {
        let z = unit((middle, half), k, x, y);
        let (f, columns) = system(pieces[0], pieces[1], patches, z);
        let columns: [Vector; 4] = std::array::from_fn(|c| scaled(columns[c], half[c]));
        let rows = inverse(o.map(|c| columns[c]))?;
        let step = rows.map(|r| dot(r, f));
        let mut moved = 0.0f64;
        for i in 0..3 {
            y[i] -= step[i];
            moved = moved.max(step[i].abs());
        }
        if y.iter().any(|y| y.abs() > 2.0 * REACH) || moved.is_nan() {
            return None;
        }
        // Quadratic from here: the next step would be below the last digit. Where the surfaces meet at a small angle, steps stop
        // falling at what the last digits are worth.
        if moved < enough {
            return Some((y, columns, OFF));
        }
        // The inverse is good for the rest: its error is to the step as the step is to the reach.
        if moved < FROZEN && enough < NODE {
            let mut share = moved;
            for _ in 0..3 {
                let z = unit((middle, half), k, x, y);
                let [p, q] = [0, 1].map(|side| {
                    pieces[side].position(patches[side], [z[2 * side], z[2 * side + 1]])
                });
                let f = sub(p, q);
                let step = rows.map(|r| dot(r, f));
                let next = step.iter().fold(0.0f64, |m, x| m.max(x.abs()));
                if next.is_nan() || next > share {
                    break;
                }
                (0..3).for_each(|i| y[i] -= step[i]);
                if moved * next < LAST {
                    return Some((y, columns, OFF));
                }
                share = next;
            }
        }
        if (moved < 1e-3 && moved >= last) || (n == MOST_STEPS && moved < 1e-6) {
            return Some((y, columns, OFF + 4.0 * moved));
        }
        last = moved;
    }
    None
}

fn unit((middle, half): ([f64; 4], [f64; 4]), k: usize, x: f64, y: [f64; 3]) -> [f64; 4] {
    let o = others(k);
    let mut z = middle;
    z[k] += x * half[k];
    for i in 0..3 {
        z[o[i]] += y[i] * half[o[i]];
    }
    z
}

impl Frame<'_> {
    /// The arc over `[x0, x1]` near `guess(x)`; `None` when it does not stay in the reach, or bends too much for this.
    pub fn arc(
        &self,
        [x0, x1]: [f64; 2],
        forward: bool,
        guess: impl Fn(f64) -> [f64; 3],
    ) -> Option<Arc> {
        for count in [5, 13] {
            match self.arc_of(count, [x0, x1], forward, &guess) {
                Ok(arc) => return Some(arc),
                Err(Failure::Leaves) => return None,
                Err(Failure::Bends) => {}
            }
        }
        None
    }

    fn arc_of(
        &self,
        count: usize,
        [x0, x1]: [f64; 2],
        forward: bool,
        guess: impl Fn(f64) -> [f64; 3],
    ) -> Result<Arc, Failure> {
        let step = 0.5 * (x1 - x0) / count as f64;
        let at = |j: usize| x0 + (2 * j + 1) as f64 * step;
        let start = count / 2;
        let mut nodes = vec![self.node(at(start), guess(at(start)), step)?; count];
        for j in (0..start).rev().chain(start + 1..count) {
            let side = |n: usize| if j < start { j + n } else { j - n };
            let (from, x) = (nodes[side(1)], at(j));
            // The slope half way, by those of the two nodes before.
            let before = if j.abs_diff(start) > 1 { nodes[side(2)] } else { from };
            let slope = |i: usize| 1.5 * from.slope[i] - 0.5 * before.slope[i];
            let y = [0, 1, 2].map(|i| from.y[i] + (x - from.x) * slope(i));
            nodes[j] = self.node(x, y, step)?;
        }
        Ok(Arc {
            patches: self.patches,
            middle: self.middle,
            half: self.half,
            k: self.k,
            x: [x0, x1],
            forward,
            nodes,
            begin: x0,
            step,
        })
    }

    /// The solution at `x`, proven to go on in the reach for `step` on both sides.
    fn node(&self, x: f64, guess: [f64; 3], step: f64) -> Result<Node, Failure> {
        let place = (self.middle, self.half);
        let (y, columns, off) = newton(self.pieces, self.patches, place, self.k, x, guess, NODE)
            .ok_or(Failure::Leaves)?;
        if y.iter().any(|y| y.abs() > REACH) {
            return Err(Failure::Leaves);
        }
        let o = others(self.k);
        let rows = inverse(o.map(|c| columns[c])).ok_or(Failure::Leaves)?;
        let slope = rows.map(|r| -dot(r, columns[self.k]));
        let h = rows.map(|r| bent(r, self.bends));
        let mut t = [1.0; 4];
        for i in 0..3 {
            t[o[i]] = slope[i].abs();
        }
        let seconds =
            |t: [f64; 4]| h.map(|h| CARE * (form(h[0], [t[0], t[1]]) + form(h[1], [t[2], t[3]])));
        let greatest = |x: [f64; 3]| x[0].max(x[1]).max(x[2]);
        // Supposed: no slope changes by more than `most` x the way. What follows from it must not exceed it.
        let most = 3.0 * greatest(seconds(t));
        let mut wide = t;
        for &c in &o {
            wide[c] += most * step;
        }
        let r = wide.map(|t| t * step);
        let lost = h.map(|h| {
            let c = [change(h[0], [r[0], r[1]]), change(h[1], [r[2], r[3]])];
            o.iter().map(|&q| c[q / 2][q % 2]).sum::<f64>()
        });
        let lost = greatest(lost);
        if lost.is_nan() || lost > 0.5 {
            return Err(Failure::Bends);
        }
        let second = seconds(wide);
        let bend = second.map(|s| s + lost / (1.0 - lost) * greatest(second));
        if greatest(bend) > most {
            return Err(Failure::Bends);
        }
        let reaches =
            |i: usize| y[i].abs() + CARE * (slope[i].abs() * step + 0.5 * bend[i] * step * step);
        if (0..3).any(|i| reaches(i) > REACH - off) {
            return Err(Failure::Bends);
        }
        let mut k = [0.0; 4];
        for i in 0..3 {
            k[o[i]] = bend[i];
        }
        let curve = |side: usize| {
            let (b, q) = (self.bends[side].size, 2 * side);
            let grown = change(b, [r[q], r[q + 1]]);
            form(b, [wide[q], wide[q + 1]])
                + (norm(columns[q]) + grown[0]) * k[q]
                + (norm(columns[q + 1]) + grown[1]) * k[q + 1]
        };
        // Both surfaces hold the arc: the better bound is as true.
        Ok(Node { x, y, slope, bend, curve: CARE * curve(0).min(curve(1)) })
    }
}

impl Arc {
    fn place(&self) -> ([f64; 4], [f64; 4]) {
        (self.middle, self.half)
    }

    /// The node whose interval holds `x`.
    fn node(&self, x: f64) -> usize {
        let k = ((x - self.begin) / (2.0 * self.step)).floor();
        (k.max(0.0) as usize).min(self.nodes.len() - 1)
    }

    /// A cubic through the two nodes beside `x`, or the tangent of the last one.
    fn near(&self, x: f64) -> [f64; 3] {
        let own = self.node(x);
        let a = &self.nodes[own];
        let other = if x >= a.x { own + 1 } else { own.wrapping_sub(1) };
        let d = x - a.x;
        let Some(b) = self.nodes.get(other) else {
            return [0, 1, 2].map(|i| a.y[i] + d * a.slope[i]);
        };
        let h = b.x - a.x;
        let s = d / h;
        [0, 1, 2].map(|i| {
            let (p, q) = (h * a.slope[i], h * b.slope[i]);
            let rise = b.y[i] - a.y[i];
            a.y[i] + s * (p + s * (3.0 * rise - 2.0 * p - q + s * (p + q - 2.0 * rise)))
        })
    }

    /// The solution at `x`, in the unit parameters of the patches: Newton with `k` held.
    pub fn solve(&self, a: &Pieces, b: &Pieces, x: f64) -> [f64; 4] {
        let guess = self.near(x);
        let y = newton([a, b], self.patches, self.place(), self.k, x, guess, SOLUTION)
            .map_or(guess, |y| y.0);
        unit(self.place(), self.k, x, y)
    }

    /// How far it may leave the chord between two of its points: in space, and in the unit parameters of the patches. `parts`: how
    /// many chords share the interval equally.
    pub fn bulge(&self, from: f64, to: f64, parts: usize) -> (f64, [f64; 4]) {
        let (i, j) = (self.node(from.min(to)), self.node(from.max(to)));
        let (mut curve, mut bend) = (0.0f64, [0.0f64; 4]);
        let o = others(self.k);
        for node in &self.nodes[i..=j] {
            curve = curve.max(node.curve);
            for q in 0..3 {
                bend[o[q]] = bend[o[q]].max(node.bend[q] * self.half[o[q]]);
            }
        }
        let share = (to - from) / parts as f64;
        let factor = 0.125 * share * share;
        (curve * factor, bend.map(|b| b * factor))
    }

    /// Where a place in unit parameters, which is a solution, stands on the arc, if it is there: no other one is in the reach.
    pub fn position(&self, z: [f64; 4], slack: f64) -> Option<f64> {
        let x = (z[self.k] - self.middle[self.k]) / self.half[self.k];
        if !(self.x[0] - slack..=self.x[1] + slack).contains(&x) {
            return None;
        }
        let on = |c: usize| (z[c] - self.middle[c]).abs() <= (REACH + slack) * self.half[c];
        others(self.k).into_iter().all(on).then_some(x)
    }

    /// Cuts the arc where it leaves the patches by more than `slack` (unit parameters).
    pub fn clip(&mut self, a: &Pieces, b: &Pieces, slack: [f64; 4]) -> Clip {
        let mut ends = [None; 2];
        for q in 0..4 {
            for high in [false, true] {
                let limit = if high { 1.0 } else { 0.0 };
                let reach = REACH * self.half[q];
                let far =
                    if high { self.middle[q] + reach < 1.0 } else { self.middle[q] - reach > 0.0 };
                if far {
                    continue;
                }
                match self.clip_side(a, b, q, limit, slack[q], &mut ends) {
                    Clip::Kept(_) => {}
                    other => return other,
                }
            }
        }
        Clip::Kept(ends)
    }

    fn clip_side(
        &mut self,
        a: &Pieces,
        b: &Pieces,
        q: usize,
        limit: f64,
        slack: f64,
        ends: &mut [Option<usize>; 2],
    ) -> Clip {
        let sign = if limit > 0.5 { 1.0 } else { -1.0 };
        let side = 2 * q + usize::from(limit > 0.5);
        if q == self.k {
            let end = (limit - self.middle[q]) / self.half[q];
            if sign > 0.0 && self.x[1] > end {
                self.x[1] = end;
                ends[1] = Some(side);
            }
            if sign < 0.0 && self.x[0] < end {
                self.x[0] = end;
                ends[0] = Some(side);
            }
            return if self.x[0] > self.x[1] { Clip::Outside } else { Clip::Kept(*ends) };
        }
        let i = others(self.k).iter().position(|&c| c == q).unwrap_or(0);
        let (low, high) = (self.x[0], self.x[1]);
        let edge = sign * (limit - self.middle[q]) / self.half[q];
        let room = slack / self.half[q];
        let (mut least, mut greatest) = (f64::INFINITY, f64::NEG_INFINITY);
        let (mut rises, mut falls) = (true, true);
        let mut along = true;
        for node in &self.nodes[self.node(low)..=self.node(high)] {
            let (y, slope) = (sign * node.y[i] - edge, sign * node.slope[i]);
            let turn = node.bend[i] * self.step;
            let reach = CARE * (slope.abs() + 0.5 * turn) * self.step;
            (least, greatest) = (least.min(y - reach - OFF), greatest.max(y + reach + OFF));
            (rises, falls) = (rises && slope > turn, falls && slope < -turn);
            along = along && y <= room && y >= -4.0 * room;
        }
        if greatest < 0.0 {
            return Clip::Kept(*ends);
        }
        if least > room {
            return Clip::Outside;
        }
        let outside = |x: f64| sign * (self.solve(a, b, x)[q] - limit);
        let at = [outside(low), outside(high)];
        if !(rises || falls) {
            // It lies on the side, as far as rounding can tell.
            let along = along && at.iter().all(|&x| x <= slack && x >= -4.0 * slack);
            return if along { Clip::Kept(*ends) } else { Clip::Unclear };
        }
        if at[0].max(at[1]) <= slack {
            return Clip::Kept(*ends);
        }
        if at[0].min(at[1]) > slack {
            return Clip::Outside;
        }
        let high_end = usize::from(rises);
        let cut = crossing(outside, low, high);
        self.x[high_end] = cut;
        ends[high_end] = Some(side);
        if self.x[0] > self.x[1] { Clip::Outside } else { Clip::Kept(*ends) }
    }
}

/// Zero of a monotone function between `low` and `high`: regula falsi in the Illinois form, ended by the last digits.
fn crossing(f: impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    let (mut fl, mut fh) = (f(low), f(high));
    if fl.signum() == fh.signum() {
        return if fl.abs() < fh.abs() { low } else { high };
    }
    for _ in 0..60 {
        let x = high - fh * (high - low) / (fh - fl);
        let fx = f(x);
        if fx == 0.0 || (high - low).abs() < 1e-15 {
            return x;
        }
        if fx.signum() == fh.signum() {
            fl *= 0.5;
        } else {
            (low, fl) = (high, fh);
        }
        if (x - high).abs() < 1e-15 {
            return x;
        }
        (high, fh) = (x, fx);
    }
    high
}
