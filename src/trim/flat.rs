//! Curves of the domain as chains of segments, in lengths of the surface, with the distance that they may be off.
//!
//! A place (u, v) stands at `(L_u u, L_v v)` with bounds L of |Su| and |Sv|: no two places are farther apart in space than the sum
//! of their coordinate differences here. A chord of a curve over an interval of length h is off by at most `h^2 / 8 max |C''|`.

use super::speed::{motion, speeds};
use super::{Support, norm, sub};
use crate::error::Error;
use crate::pcurve::{Parameters, Pcurve};
use crate::portable::SameDigits;
use crate::transform::between;

/// Most segments of one curve; with more to do the error stays above what was asked for.
const MOST_SEGMENTS: usize = 1 << 15;

/// Halvings after which bounds of bends are no longer made tighter.
const LEVELS: usize = 6;

/// Segments below one box of the pair search.
const LEAF: usize = 4;

/// How lengths of the surface are seen in its domain.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Scale {
    pub speeds: [f64; 2],
    /// Whether the speeds are bounds, not the largest at samples.
    pub proven: bool,
}

impl Scale {
    /// The bounds of a support; for a function twice the largest speeds at samples.
    pub fn of(support: &Support) -> Result<Self, Error> {
        if let Some(speeds) = speeds(support)? {
            return Ok(Self { speeds, proven: true });
        }
        let [u0, u1, v0, v1] = support.domain();
        let mut most = [f64::MIN_POSITIVE; 2];
        for k in 0..256 {
            let share = |k: usize| (k % 16) as f64 / 15.0;
            let at = [between(u0, u1, share(k)), between(v0, v1, share(k / 16))];
            let mut out = [[0.0; 3]; 3];
            if support.partials(at, 1, &mut out) {
                most = [most[0].max(norm(out[1])), most[1].max(norm(out[2]))];
            }
        }
        Ok(Self { speeds: most.map(|x| 2.0 * x), proven: false })
    }

    pub fn point(&self, p: Parameters) -> Parameters {
        [self.speeds[0] * p[0], self.speeds[1] * p[1]]
    }
}

/// A curve as a chain of segments.
#[derive(Clone, Debug)]
pub(crate) struct Flat {
    pub parameters: Vec<f64>,
    pub points: Vec<Parameters>,
    /// How far the curve may be from its segments.
    pub error: f64,
    /// Length of the chain.
    pub length: f64,
    /// Boxes of runs of segments, a binary tree by halves; the root is the first one.
    boxes: Vec<[f64; 4]>,
}

impl Flat {
    /// The segments of a curve, off by no more than `error` if [`MOST_SEGMENTS`] allow.
    pub fn new(pcurve: &Pcurve, scale: &Scale, error: f64) -> Self {
        let (a, b) = pcurve.domain();
        let places = [vec![a], pcurve.breaks(), vec![b]].concat();
        let (mut parameters, mut worst) = (vec![a], 0.0f64);
        let mut waiting: Vec<([f64; 2], usize, [f64; 2])> =
            places.windows(2).rev().map(|w| ([w[0], w[1]], 0, [0.0; 2])).collect();
        while let Some(([from, to], depth, above)) = waiting.pop() {
            let bend = if depth < LEVELS { motion(pcurve, [from, to]).second } else { above };
            let h = to - from;
            let off =
                h * h / 8.0 * (scale.speeds[0] * bend[0]).hypotenuse(scale.speeds[1] * bend[1]);
            let middle = from + 0.5 * h;
            let room = parameters.len() + waiting.len() < MOST_SEGMENTS;
            if off > error && room && from < middle && middle < to {
                waiting.push(([middle, to], depth + 1, bend));
                waiting.push(([from, middle], depth + 1, bend));
                continue;
            }
            worst = worst.max(off);
            parameters.push(to);
        }
        let points: Vec<Parameters> =
            parameters.iter().map(|&t| scale.point(pcurve.evaluate(t))).collect();
        let length = points.windows(2).map(|w| far(w[0], w[1])).sum();
        let mut flat = Self { parameters, points, error: worst, length, boxes: Vec::new() };
        let mut boxes = Vec::new();
        flat.gather(0, flat.segments(), &mut boxes);
        flat.boxes = boxes;
        flat
    }

    pub fn segments(&self) -> usize {
        self.points.len() - 1
    }

    pub fn segment(&self, k: usize) -> [Parameters; 2] {
        [self.points[k], self.points[k + 1]]
    }

    /// Length of the chain up to point k.
    pub fn run(&self, from: usize, to: usize) -> f64 {
        self.points[from..=to].windows(2).map(|w| far(w[0], w[1])).sum()
    }

    /// Boxes of the runs of `count` segments from `first` on, in the order of the tree.
    fn gather(&self, first: usize, count: usize, out: &mut Vec<[f64; 4]>) -> [f64; 4] {
        let own = out.len();
        out.push([0.0; 4]);
        let found = if count <= LEAF {
            let mut all = [f64::INFINITY, f64::NEG_INFINITY, f64::INFINITY, f64::NEG_INFINITY];
            for p in &self.points[first..=first + count] {
                all = [all[0].min(p[0]), all[1].max(p[0]), all[2].min(p[1]), all[3].max(p[1])];
            }
            all
        } else {
            let half = count / 2;
            let a = self.gather(first, half, out);
            let b = self.gather(first + half, count - half, out);
            [a[0].min(b[0]), a[1].max(b[1]), a[2].min(b[2]), a[3].max(b[3])]
        };
        out[own] = found;
        found
    }

    /// Calls `found` with all pairs of segments of two chains whose boxes are nearer than `reach`.
    pub fn pairs(&self, other: &Self, reach: f64, found: &mut dyn FnMut(usize, usize)) {
        let (root, theirs) = (Run::whole(self), Run::whole(other));
        self.pairs_of(root, other, theirs, reach, found);
    }

    fn pairs_of(
        &self,
        a: Run,
        other: &Self,
        b: Run,
        reach: f64,
        found: &mut dyn FnMut(usize, usize),
    ) {
        let (p, q) = (self.boxes[a.node], other.boxes[b.node]);
        let apart =
            (0..2).any(|k| p[2 * k] > q[2 * k + 1] + reach || q[2 * k] > p[2 * k + 1] + reach);
        if apart {
            return;
        }
        match (a.count <= LEAF, b.count <= LEAF) {
            (true, true) => {
                for i in a.first..a.first + a.count {
                    (b.first..b.first + b.count).for_each(|j| found(i, j));
                }
            }
            (false, leaf) if leaf || a.count >= b.count => {
                for half in a.halves() {
                    self.pairs_of(half, other, b, reach, found);
                }
            }
            _ => {
                for half in b.halves() {
                    self.pairs_of(a, other, half, reach, found);
                }
            }
        }
    }
}

/// Segments below a node of the tree.
#[derive(Clone, Copy)]
struct Run {
    node: usize,
    first: usize,
    count: usize,
}

impl Run {
    fn whole(flat: &Flat) -> Self {
        Self { node: 0, first: 0, count: flat.segments() }
    }

    fn halves(self) -> [Self; 2] {
        let half = self.count / 2;
        let left = Self { node: self.node + 1, first: self.first, count: half };
        let node = self.node + 1 + nodes(half);
        [left, Self { node, first: self.first + half, count: self.count - half }]
    }
}

/// Nodes of the tree over `count` segments.
fn nodes(count: usize) -> usize {
    if count <= LEAF { 1 } else { 1 + nodes(count / 2) + nodes(count - count / 2) }
}

pub(crate) fn far(a: Parameters, b: Parameters) -> f64 {
    let d = sub([a[0], a[1], 0.0], [b[0], b[1], 0.0]);
    d[0].hypotenuse(d[1])
}

/// How the segments ab and cd meet: whether each has its ends on different sides of the other's line by more than `margin`, and
/// otherwise their distance, with the shares of the nearest places.
pub(crate) fn meeting(
    [a, b]: [Parameters; 2],
    [c, d]: [Parameters; 2],
    margin: f64,
) -> (bool, f64, [f64; 2]) {
    let side = |p: Parameters, q: Parameters, r: Parameters| {
        let (x, y) = ([q[0] - p[0], q[1] - p[1]], [r[0] - p[0], r[1] - p[1]]);
        let length = x[0].hypotenuse(x[1]);
        if length == 0.0 { 0.0 } else { (x[0] * y[1] - x[1] * y[0]) / length }
    };
    let (c_side, d_side) = (side(a, b, c), side(a, b, d));
    let (a_side, b_side) = (side(c, d, a), side(c, d, b));
    let least = [c_side, d_side, a_side, b_side].iter().fold(f64::INFINITY, |m, x| m.min(x.abs()));
    if c_side * d_side < 0.0 && a_side * b_side < 0.0 {
        let shares = [a_side / (a_side - b_side), c_side / (c_side - d_side)];
        return (least > margin, 0.0, shares);
    }
    let mut best = (false, f64::INFINITY, [0.0; 2]);
    let nearest = |p: Parameters, [q, r]: [Parameters; 2]| {
        let x = [r[0] - q[0], r[1] - q[1]];
        let square = x[0] * x[0] + x[1] * x[1];
        let share = ((p[0] - q[0]) * x[0] + (p[1] - q[1]) * x[1]) / square;
        let share = if square > 0.0 { share.clamp(0.0, 1.0) } else { 0.0 };
        (far(p, [q[0] + share * x[0], q[1] + share * x[1]]), share)
    };
    for (end, p) in [(0.0, a), (1.0, b)] {
        let (distance, share) = nearest(p, [c, d]);
        if distance < best.1 {
            best = (false, distance, [end, share]);
        }
    }
    for (end, p) in [(0.0, c), (1.0, d)] {
        let (distance, share) = nearest(p, [a, b]);
        if distance < best.1 {
            best = (false, distance, [share, end]);
        }
    }
    best
}
