//! The same for a curve: how far from it a vector across may be followed.
//!
//! For a place f with unit tangent T, and for every unit vector n across T, `n.(x - f) <= K(n) |x - f|^2` for all points x
//! of the curve. K is kept for four directions of each cell, `+-P` and `+-B` with `B = T x P`; for `n = a P + b B` it is at
//! most `|a| K(+-P) + |b| K(+-B)`.
//!
//! - x close along the curve: with the arc length l from f to x, `n.(x - f)` is the integral of `(l - m) n.k(m)` with the
//!   curvature vector k, and `|x - f|` at least l times the least of the tangents along their mean. Both need a tangent that
//!   is continuous, whatever the parameters are.
//! - x elsewhere: from boxes around cells and groups of them.

use super::arc::{Arc, Bow, parts, push_arcs};
use super::groups::{Groups, View};
use super::middles::Middles;
use super::{MARGIN, OFF_LINE};
use crate::bounds::{Vector, add, cross, dot, norm, scaled, sub};
use crate::error::Error;
use crate::index::piece::{position_error, position_steps, reserved};
use crate::index::segment::Segment;
use crate::jet::BezierSegment;
use crate::simd::Lanes;
use crate::tree::Tree;

/// Turn of the tangent in a cell that is aimed at, and the most cells, unless there are more segments.
const AIM: f64 = 0.1;
const MOST_SPLIT: usize = 64;
const MOST_CELLS: usize = 1 << 13;

/// Cells to each side that count as close.
const CLOSE: usize = 16;
/// Least of the tangents along their mean up to which cells count as close.
const STRAIGHT: f64 = 0.5;

/// Bounds less than this are of no use.
const LEAST: f64 = 0.1;

/// Tangents that differ by less are one, and ends that are nearer: what that costs is allowed for.
const KINK: f64 = 1e-9;
const GAP: f64 = 1e-12;

/// The segments of a curve.
pub struct Chain<'a> {
    pub segments: &'a [Segment],
    pub degree: usize,
    pub rational: bool,
    /// The poles of a segment.
    pub net: &'a dyn Fn(usize) -> BezierSegment<'a>,
}

/// The bounds of a cell.
#[derive(Clone, Copy, Debug)]
struct Kept {
    /// P.
    across: [f32; 3],
    /// K for P, -P, B, -B.
    bends: [f32; 4],
}

/// The bounds of a cell or, lane by lane, of many.
#[derive(Clone, Copy, Debug, Default)]
pub struct Across<V> {
    /// P.
    pub axis: [V; 3],
    /// K for P, -P, B, -B.
    pub bends: [V; 4],
}

impl<V> Across<V> {
    /// An upper bound of K(n) |n| at a place with the unit tangent `tangent`, for a vector n across that may be off by `off`; not
    /// a number where the place says nothing.
    #[inline(always)]
    pub fn asked<const N: usize>(&self, tangent: [V; 3], n: [V; 3], off: V) -> V
    where
        V: Lanes<N>,
    {
        let [a, b, c] = self.axis;
        let along = dot(tangent, self.axis);
        let across = [a - tangent[0] * along, b - tangent[1] * along, c - tangent[2] * along];
        let inverse = V::splat(1.0) / norm(across);
        let across = [across[0] * inverse, across[1] * inverse, across[2] * inverse];
        let [plus, minus, left, right] = self.bends;
        larger(dot(n, across), [plus, minus], off)
            + larger(dot(n, cross(tangent, across)), [left, right], off)
    }
}

/// What a part of a vector asks for, with K for it and for its opposite.
#[inline(always)]
fn larger<V: Lanes<N>, const N: usize>(part: V, [plus, minus]: [V; 2], off: V) -> V {
    let either = minus.where_less(part, V::splat(0.0) - off, plus.max(minus));
    (part.abs() + off) * plus.where_less(off, part, either)
}

/// The bounds of all cells of a curve.
#[derive(Clone, Debug)]
pub struct CurveReach {
    /// The first cell of each segment, and the end.
    starts: Vec<u32>,
    cells: Vec<Kept>,
    /// K for the outward tangents of both ends.
    ends: [f64; 2],
    /// What is allowed for where tangents or ends are one but for rounding.
    pub kink: f64,
    /// See `kink`.
    pub gap: f64,
    middles: Middles,
}

impl CurveReach {
    /// Of the segments of a curve; `poll` is asked now and then whether to stop.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`], [`Error::Cancelled`].
    pub fn new(chain: &Chain, poll: &mut dyn FnMut() -> bool) -> Result<Self, Error> {
        let (p, rational, count) = (chain.degree, chain.rational, chain.segments.len());
        let mut starts = reserved(count + 1)?;
        starts.push(0);
        let most = (MOST_CELLS / count).clamp(1, MOST_SPLIT);
        let mut sum = 0;
        for k in 0..count {
            sum += parts((chain.net)(k).poles, p, rational, AIM).clamp(1, most);
            starts.push(sum as u32);
        }
        let mut arcs = reserved(sum)?;
        for k in 0..count {
            if k % 256 == 255 && poll() {
                return Err(Error::Cancelled);
            }
            let parts = (starts[k + 1] - starts[k]) as usize;
            push_arcs((chain.net)(k).poles, p, rational, &chain.segments[k], parts, &mut arcs);
        }
        let mut boxes = reserved(sum)?;
        boxes.extend(arcs.iter().map(|arc: &Arc| arc.bounds));
        let groups = Groups::new([1, sum], boxes)?;
        let (mut kink, mut gap) = (0.0f64, 0.0f64);
        let mut broken = reserved(sum + 1)?;
        broken.resize(sum + 1, false);
        for k in 0..=count {
            let (before, after) = ((k + count - 1) % count, k % count);
            let inner = k > 0 && k < count;
            if inner && !chain.segments[k].border[0] {
                continue;
            }
            let [turn, apart] = join(chain, before, after);
            let is_one = turn <= KINK && (inner || apart <= GAP);
            if is_one {
                (kink, gap) = (kink.max(turn), if inner { gap } else { gap.max(apart) });
            }
            broken[starts[k] as usize] = !is_one;
        }
        let middles = Middles::new(arcs.iter().map(Arc::middle))?;
        let line = Line { arcs, broken, groups };
        let mut cells = reserved(sum)?;
        for k in 0..sum {
            if k % 256 == 255 && poll() {
                return Err(Error::Cancelled);
            }
            cells.push(line.kept(k));
        }
        let ends = [0, 1].map(|side| line.end(side));
        // So many joins there may be in what is close.
        let joins = CLOSE.min(count + 1) as f64;
        let (kink, gap) = (kink * joins / STRAIGHT, gap * joins);
        Ok(Self { starts, cells, ends, kink, gap, middles })
    }

    /// What the cell of a place of segment `k` knows of vectors across.
    pub fn across(&self, k: usize, at: f64) -> Across<f64> {
        let [first, next] = [0, 1].map(|n| self.starts[k + n] as usize);
        let cell = first + ((at * (next - first) as f64) as usize).min(next - first - 1);
        let Kept { across, bends } = &self.cells[cell];
        Across { axis: across.map(f64::from), bends: bends.map(f64::from) }
    }

    /// K for the outward tangent, where a place of segment `k` is an end of the curve: which one, and K.
    pub fn end(&self, k: usize, at: f64) -> Option<(usize, f64)> {
        let last = self.starts.len() - 2;
        if k == 0 && at == 0.0 {
            Some((0, self.ends[0]))
        } else {
            (k == last && at == 1.0).then_some((1, self.ends[1]))
        }
    }

    /// A place from which to begin in segment `k`, likely nearer to the foot than a hint there.
    pub fn better(&self, k: usize, hint: f64, query: Vector) -> f64 {
        let [first, next] = [0, 1].map(|n| self.starts[k + n] as usize);
        let count = (next - first) as f64;
        let at = ((hint * count) as usize).min(next - first - 1);
        let from = hint * count - at as f64;
        let to = self.middles.better(first + at, query, from);
        if to == from { hint } else { (at as f64 + to) / count }
    }

    /// A place near a query: a segment and a local parameter, inside but at the ends of the curve. `tree`: that of the segments.
    pub fn start(&self, query: Vector, tree: &Tree) -> (usize, f64) {
        let cells = |k: usize| self.starts[k] as usize..self.starts[k + 1] as usize;
        let nearest = self.middles.nearest(query, tree.level());
        let (near, [at, _]) = nearest.unwrap_or_else(|| self.middles.near(query, tree, cells));
        let k = self.starts.partition_point(|&first| first as usize <= near) - 1;
        let [first, next] = [0, 1].map(|n| self.starts[k + n] as usize);
        let at = ((near - first) as f64 + at) / (next - first) as f64;
        let last = self.starts.len() - 2;
        let at = if at == 0.0 && k > 0 {
            OFF_LINE
        } else if at == 1.0 && k < last {
            1.0 - OFF_LINE
        } else {
            at
        };
        (k, at)
    }

    /// Bytes held.
    pub fn memory(&self) -> usize {
        self.middles.memory()
            + self.starts.capacity() * size_of::<u32>()
            + self.cells.capacity() * size_of::<Kept>()
    }
}

/// The angle between the tangents where one segment ends and another begins, and how far these ends are apart: at most.
fn join(chain: &Chain, before: usize, after: usize) -> [f64; 2] {
    let end = |k: usize, s: f64| {
        let segment = &chain.segments[k];
        let jet = (chain.net)(k).jet(s, [0.0; 3]);
        let (steps, rational) = (position_steps(chain.degree), chain.rational);
        let error = position_error(steps, rational, segment.radius, segment.radius, 2.0);
        let speed = norm(jet.s);
        let turn = 24.0 * chain.degree as f64 * error / (jet.w[0].min(1.0) * speed);
        (add(segment.center, jet.d), scaled(jet.s, 1.0 / speed), turn, error)
    };
    let (a, b) = (end(before, 1.0), end(after, 0.0));
    // A chord, of small angles.
    let turn = (norm(sub(a.1, b.1)) * 1.1 + a.2 + b.2) * MARGIN;
    let apart = (norm(sub(a.0, b.0)) + a.3 + b.3) * MARGIN;
    [if turn.is_nan() { f64::INFINITY } else { turn }, apart]
}

/// The cells of a curve in order.
struct Line {
    arcs: Vec<Arc>,
    /// Whether the tangent breaks before a cell, or after the last one.
    broken: Vec<bool>,
    groups: Groups,
}

impl Line {
    fn kept(&self, place: usize) -> Kept {
        let arc = &self.arcs[place];
        let Some(bow) = &arc.shape else {
            return Kept { across: [0.0; 3], bends: [f32::INFINITY; 4] };
        };
        let views = [1, 2].map(|k| View {
            axis: bow.axes[k],
            cone: bow.cone,
            depth: arc.bounds.reach(bow.axes[k]) * MARGIN,
        });
        let mut bends = near(curvatures(bow, bow), straightness(bow, bow.axes[0]));
        bends.iter_mut().for_each(|bend| *bend = bend.max(LEAST));
        let [behind, ahead] =
            [false, true].map(|forward| self.walk(place, forward, bow, &views, &mut bends));
        let count = self.arcs.len();
        let first = (place + count - behind) % count;
        let covered = |_: [usize; 2], [from, to]: [usize; 2]| {
            let steps = (from + count - first) % count + to - from;
            steps <= behind + ahead || behind + ahead + 1 >= count
        };
        self.groups.far(&arc.bounds, &views, covered, &mut bends);
        Kept {
            across: bow.axes[1].map(|x| x as f32),
            bends: bends.map(|x| ((x * MARGIN) as f32).next_up()),
        }
    }

    /// Raises the bounds of a cell to what the cells along one way ask; how many.
    fn walk(
        &self,
        place: usize,
        forward: bool,
        bow: &Bow,
        views: &[View; 2],
        bends: &mut [f64; 4],
    ) -> usize {
        let count = self.arcs.len();
        let most = CLOSE.min(count - 1);
        let mut passed = [bow; CLOSE + 1];
        let mut greatest = curvatures(bow, bow);
        let mut at = place;
        for step in 1..=most {
            // The line after the last cell is the one before the first.
            if self.broken[if forward { at + 1 } else { at }] {
                return step - 1;
            }
            at = if forward { (at + 1) % count } else { (at + count - 1) % count };
            let Some(next) = &self.arcs[at].shape else { return step - 1 };
            passed[step] = next;
            let middle = add(bow.axes[0], next.axes[0]);
            let middle = scaled(middle, 1.0 / norm(middle));
            let least = passed[..=step].iter().map(|bow| straightness(bow, middle));
            let least = least.fold(f64::INFINITY, f64::min);
            if !(STRAIGHT..).contains(&least) {
                return step - 1;
            }
            let asked = curvatures(bow, next);
            greatest = [0, 1, 2, 3].map(|k| greatest[k].max(asked[k]));
            let near = near(greatest, least);
            let floor = bends.iter().fold(f64::INFINITY, |least, x| x.min(least));
            let other = &self.arcs[at].bounds;
            let seen = self.arcs[place].bounds.seen(other, floor);
            let [p, b] = [&views[0], &views[1]].map(|view| view.asked(other, seen));
            let far = [p[0], p[1], b[0], b[1]];
            *bends = [0, 1, 2, 3].map(|k| bends[k].max(near[k].min(far[k])));
        }
        most
    }

    /// K for the outward tangent of an end.
    ///
    /// As long as tangents are within a right angle of that of the end, the curve only falls.
    fn end(&self, side: usize) -> f64 {
        let count = self.arcs.len();
        let cell = |step: usize| if side == 0 { step } else { count - 1 - step };
        // Beyond a seam that is none the curve goes on.
        if !self.broken[0] {
            return f64::INFINITY;
        }
        let arc = &self.arcs[cell(0)];
        let Some(bow) = &arc.shape else { return f64::INFINITY };
        let falls = |step: &usize| {
            let next = self.arcs[cell(*step)].shape.as_ref();
            next.is_some_and(|next| {
                norm(sub(next.axes[0], bow.axes[0])) + next.cone + bow.cone < 1.4
            })
        };
        let done = (0..count).take_while(falls).count();
        let axis = scaled(bow.axes[0], if side == 0 { -1.0 } else { 1.0 });
        let view = View { axis, cone: bow.cone, depth: -arc.tips[side] };
        let covered = |_: [usize; 2], [first, last]: [usize; 2]| {
            if side == 0 { last < done } else { first + done >= count }
        };
        let mut bends = [LEAST, f64::INFINITY];
        self.groups.far(&arc.bounds, &[view], covered, &mut bends);
        bends[0]
    }
}

/// Bounds of the curvature vectors of another cell along P, -P, B, -B of a place in this one.
fn curvatures(bow: &Bow, other: &Bow) -> [f64; 4] {
    let more = other.off + bow.cone * (norm(other.bend) + other.off);
    let [p, b] = [1, 2].map(|k| dot(bow.axes[k], other.bend));
    [p, -p, b, -b].map(|x| x + more)
}

/// The least product of a tangent of a cell with a unit vector.
fn straightness(bow: &Bow, middle: Vector) -> f64 {
    let chord = norm(sub(bow.axes[0], middle)) + bow.cone;
    (1.0 - 0.5 * chord * chord) / MARGIN
}

/// K for the greatest curvatures along the way.
fn near(greatest: [f64; 4], straightness: f64) -> [f64; 4] {
    greatest.map(|x| 0.5 * x.max(0.0) / (straightness * straightness) * MARGIN)
}
