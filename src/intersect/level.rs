//! The zeros of one polynomial in two parameters on a grid of patches: arcs between nodes, none missing.
//!
//! ```text
//!   edges of the grid first:  certified zeros of one polynomial in one parameter = nodes, shared by both patches
//!   box -> coefficients of one sign?          no zero: closed
//!          monotone in s (or t)?              arcs are graphs over t: signs at the sides between nodes say which
//!          double zeros on opposite sides and a ridge of one sign between them?    an arc of contact
//!          image below the point tolerance?   kept as a lump: singular, or not decided
//!          otherwise                          halve; the zeros on the new line are nodes of both halves
//! ```
//!
//! A line is placed so that its zeros are simple; a side on which the polynomial vanishes is an arc itself, and is divided
//! out. So topology comes from signs and from nodes that neighbours share, never from distances.
//!
//! References: Grandine, Klein, *A new approach to the surface intersection problem*, 1997 (monotone regions between
//! border points); Keyser et al., *Efficient and exact manipulation of algebraic points and curves*, 2000.
//! Limit: degenerate points of more than two arms are lumps of the size of the point tolerance.

use super::edges::{Edges, NodeKind, line_zeros};
use super::quadric::Polynomial;
use crate::bezier::{Bidegree, MAX_PRODUCT, basis, cut_2d, halve_s, halve_t, isocurve};
use crate::bounds::{HALF_ULP, extent};
use crate::portable::SameDigits;

/// Where a line that halves a box may lie, in the order of trial: zeros on it should be simple.
const PLACES: [f64; 6] = [0.5, 0.4375, 0.5625, 0.40625, 0.53125, 0.46875];

/// How much steeper, in space, an arc may be than its parameter line before its box is halved.
const STEEPEST: f64 = 8.0;

/// Halvings after which steepness does not matter any more.
const PATIENT: u32 = 24;

/// A narrow box is kept as a lump where values are at most so many times those that count as none: there they may vanish twice. Where
/// they are greater the box is at a small loop, and taken apart further, but not below this share of the least width.
const MOST_FLAT: f64 = 16.0;
const NARROWEST: f64 = 1.0 / 1024.0;

/// Halvings after which a box is kept as a lump in any case.
const DEEPEST: u32 = 80;

/// How to follow an arc from one end to the other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shape {
    /// Between two ends, parameter `along` runs; the other one is the only zero in `range`.
    Graph {
        /// 0: s runs, 1: t runs.
        along: usize,
        /// Where the other parameter is.
        range: [f64; 2],
    },
    /// Straight in the parameters.
    Straight,
}

/// An arc between two nodes in one patch.
#[derive(Clone, Copy, Debug)]
pub struct Arc {
    /// Nodes.
    pub nodes: [usize; 2],
    /// Local parameters of the two ends.
    pub ends: [[f64; 2]; 2],
    /// The patch.
    pub patch: usize,
    /// How to follow it.
    pub shape: Shape,
    /// Whether the surfaces touch along it.
    pub tangential: bool,
}

/// A small box that was not taken apart.
#[derive(Clone, Debug)]
pub struct Lump {
    /// The patch.
    pub patch: usize,
    /// Local box: s0, s1, t0, t1.
    pub area: [f64; 4],
    /// Nodes on its border, with their local places.
    pub nodes: Vec<(usize, [f64; 2])>,
    /// Whether it is small; else the budget ran out.
    pub is_small: bool,
}

/// What was found.
#[derive(Debug, Default)]
pub struct Level {
    /// Kinds of the nodes.
    pub nodes: Vec<NodeKind>,
    /// Arcs.
    pub arcs: Vec<Arc>,
    /// What was not taken apart.
    pub lumps: Vec<Lump>,
    /// Patches on which the polynomial vanishes.
    pub flat: Vec<usize>,
}

/// A patch of the grid to be searched.
pub struct Field<'a> {
    /// Its number.
    pub patch: usize,
    /// The polynomial, divided by the sides on which it vanishes.
    pub polynomial: &'a Polynomial,
    /// Values below this are none.
    pub flat: f64,
    /// Lengths of the images of parameter steps at a place.
    pub speeds: &'a dyn Fn(f64, f64) -> [f64; 2],
    /// Boxes with a smaller image are lumps.
    pub least: f64,
}

struct Area {
    low: [f64; 2],
    high: [f64; 2],
    values: Vec<f64>,
    error: f64,
    /// Nodes on the sides s0, s1, t0, t1: local parameter along the side, node.
    sides: [Vec<(f64, usize)>; 4],
    /// Nodes at (s0,t0), (s0,t1), (s1,t0), (s1,t1).
    corners: [Option<usize>; 4],
    depth: u32,
}

/// Values of a polynomial at a place of its unit square.
pub fn value(values: &[f64], degree: Bidegree, at: [f64; 2]) -> f64 {
    let mut rows = [[0.0; MAX_PRODUCT]; 6];
    let [a, a1, a2, b, b1, b2] = &mut rows;
    basis::<f64, 1, MAX_PRODUCT>(degree.s, at[0], a, a1, a2);
    basis::<f64, 1, MAX_PRODUCT>(degree.t, at[1], b, b1, b2);
    let row = |r: &[f64]| r.iter().zip(&*b).map(|(c, b)| c * b).sum::<f64>();
    values.chunks_exact(degree.t + 1).zip(&*a).map(|(r, a)| a * row(r)).sum()
}

/// Ranges of the first differences times the degree, along s and t.
fn slopes(values: &[f64], degree: Bidegree) -> [(f64, f64); 2] {
    let width = degree.t + 1;
    let mut out = [(f64::INFINITY, f64::NEG_INFINITY); 2];
    let mut take = |k: usize, n: usize, d: f64| {
        let d = n as f64 * d;
        out[k] = (out[k].0.min(d), out[k].1.max(d));
    };
    for (a, b) in values.iter().zip(&values[width..]) {
        take(0, degree.s, b - a);
    }
    for row in values.chunks_exact(width) {
        for pair in row.windows(2) {
            take(1, degree.t, pair[1] - pair[0]);
        }
    }
    out.map(|(low, high)| if low > high { (0.0, 0.0) } else { (low, high) })
}

/// Whether second differences along s (0) or t (1) are of one sign beyond the error.
fn bends(values: &[f64], degree: Bidegree, along: usize, error: f64) -> bool {
    let (rows, width) = (degree.s + 1, degree.t + 1);
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    let mut take = |a: f64, b: f64, c: f64| {
        let d = (c - b) - (b - a);
        (low, high) = (low.min(d), high.max(d));
    };
    for i in 0..rows {
        for j in 0..width {
            let at = i * width + j;
            if along == 0 && i + 2 < rows {
                take(values[at], values[at + width], values[at + 2 * width]);
            }
            if along == 1 && j + 2 < width {
                take(values[at], values[at + 1], values[at + 2]);
            }
        }
    }
    low.is_finite() && (low > 4.0 * error || high < -4.0 * error)
}

impl Field<'_> {
    fn degree(&self) -> Bidegree {
        self.polynomial.degree
    }

    /// Searches the patch; `edges` has the nodes of its four sides. What is found goes to `level`.
    pub fn search(&self, edges: &Edges, level: &mut Level, budget: &mut u64) {
        let (sides, corners) = edges.of_patch(self.patch);
        let start = Area {
            low: [0.0; 2],
            high: [1.0; 2],
            values: self.polynomial.values.clone(),
            error: self.polynomial.error,
            sides,
            corners,
            depth: 0,
        };
        let mut waiting = vec![start];
        while let Some(area) = waiting.pop() {
            let (low, high) = extent(&area.values);
            if low > area.error || high < -area.error {
                continue;
            }
            if self.arcs(&area, level) || self.ridge(&area, level) {
                continue;
            }
            let image = self.image(&area);
            let (size, (low, high)) = (image[0].max(image[1]), extent(&area.values));
            let is_flat = high.max(-low) <= MOST_FLAT * self.flat;
            let is_small = (size < self.least && (is_flat || size < NARROWEST * self.least))
                || area.depth >= DEEPEST;
            if is_small || *budget == 0 {
                level.lumps.push(self.lump(area, is_small));
                continue;
            }
            *budget -= 1;
            let direction = usize::from(image[1] > image[0]);
            waiting.extend(self.halved(area, direction, level));
        }
    }

    /// About the lengths of the box in space along s and t.
    fn image(&self, area: &Area) -> [f64; 2] {
        let middle = [0, 1].map(|k| 0.5 * (area.low[k] + area.high[k]));
        let speeds = (self.speeds)(middle[0], middle[1]);
        [0, 1].map(|k| speeds[k] * (area.high[k] - area.low[k]))
    }

    fn lump(&self, area: Area, is_small: bool) -> Lump {
        let mut nodes = Vec::new();
        for side in 0..4 {
            for &(x, node) in &area.sides[side] {
                nodes.push((node, area.on_side(side, x)));
            }
        }
        for (k, corner) in area.corners.iter().enumerate() {
            let place = [
                if k < 2 { area.low[0] } else { area.high[0] },
                if k % 2 == 0 { area.low[1] } else { area.high[1] },
            ];
            nodes.extend(corner.map(|node| (node, place)));
        }
        let area = [area.low[0], area.high[0], area.low[1], area.high[1]];
        Lump { patch: self.patch, area, nodes, is_small }
    }

    /// Where the polynomial is monotone along one parameter: its arcs. False when it is along neither, or not well enough.
    fn arcs(&self, area: &Area, level: &mut Level) -> bool {
        let degree = self.degree();
        let ranges = slopes(&area.values, degree);
        let image = self.image(area);
        for across in 0..2 {
            let n = if across == 0 { degree.s } else { degree.t };
            let (low, high) = ranges[across];
            let slack = 2.0 * n as f64 * area.error;
            if low <= slack && high >= -slack {
                continue;
            }
            let least = low.abs().min(high.abs()) * image[1 - across];
            let other = ranges[1 - across];
            let most = other.0.abs().max(other.1.abs()) * image[across];
            if STEEPEST * least < most && area.depth < PATIENT {
                continue;
            }
            let before = level.arcs.len();
            if self.graphs(area, across, level) {
                return true;
            }
            level.arcs.truncate(before);
        }
        false
    }

    /// The arcs of a box that is monotone along `across`; false when signs and nodes do not agree.
    fn graphs(&self, area: &Area, across: usize, level: &mut Level) -> bool {
        let along = 1 - across;
        let [first, last] = if across == 0 { [0, 1] } else { [2, 3] };
        let mut stops: Vec<(f64, usize, usize)> = Vec::new();
        for side in [first, last] {
            stops.extend(area.sides[side].iter().map(|&(x, node)| (x, node, side)));
        }
        stops.sort_by(|a, b| a.0.total_cmp(&b.0));
        let count = stops.len();
        let bound = |k: usize| match k {
            0 => area.low[along],
            k if k > count => area.high[along],
            k => stops[k - 1].0,
        };
        let mut before = false;
        for k in 0..=count {
            let Some(signs) = self.signs(area, across, bound(k), bound(k + 1)) else {
                return false;
            };
            let runs = signs[0] != signs[1];
            // A simple zero on a side is where an arc comes in or goes out; at a double one it touches the side, or is not
            // there.
            let is_double = k > 0 && level.nodes[stops[k - 1].1] == NodeKind::Double;
            if k > 0 && (runs == before) != is_double {
                return false;
            }
            before = runs;
            if !runs {
                continue;
            }
            let end = |j: usize, side_of_box: usize| {
                if j == 0 || j > count {
                    return self.end_of(area, across, side_of_box, signs);
                }
                let (x, node, side) = stops[j - 1];
                Some((node, area.on_side(side, x)))
            };
            let [start, stop] = [0, 1].map(|high| if across == 0 { 2 + high } else { high });
            let (Some(a), Some(b)) = (end(k, start), end(k + 1, stop)) else { return false };
            let shape = Shape::Graph { along, range: [area.low[across], area.high[across]] };
            level.arcs.push(Arc {
                nodes: [a.0, b.0],
                ends: [a.1, b.1],
                patch: self.patch,
                shape,
                tangential: false,
            });
        }
        true
    }

    /// The node where an arc leaves the box through a side that the monotone parameter runs along: at most one.
    fn end_of(
        &self,
        area: &Area,
        across: usize,
        side: usize,
        signs: [bool; 2],
    ) -> Option<(usize, [f64; 2])> {
        if let [(x, node)] = area.sides[side][..] {
            return Some((node, area.on_side(side, x)));
        }
        if !area.sides[side].is_empty() {
            return None;
        }
        // Only a corner is left: the one whose side of the box has the other sign than the side in between.
        let corners = match side {
            0 => [0, 1],
            1 => [2, 3],
            2 => [0, 2],
            _ => [1, 3],
        };
        let place = |k: usize| {
            let edge = if side == 0 || side == 2 { area.low } else { area.high };
            let other = if k == 0 { area.low } else { area.high };
            if across == 0 { [other[0], edge[1]] } else { [edge[0], other[1]] }
        };
        match [area.corners[corners[0]], area.corners[corners[1]]] {
            [Some(node), None] => Some((node, place(0))),
            [None, Some(node)] => Some((node, place(1))),
            [Some(a), Some(b)] => {
                let middle = [0, 1].map(|k| 0.5 * (place(0)[k] + place(1)[k]));
                let inside = self.value(area, middle) > 0.0;
                Some(if inside == signs[0] { (b, place(1)) } else { (a, place(0)) })
            }
            [None, None] => None,
        }
    }

    /// Signs at the two sides across which the polynomial is monotone, somewhere between two stops.
    fn signs(&self, area: &Area, across: usize, from: f64, to: f64) -> Option<[bool; 2]> {
        for share in [0.5, 0.25, 0.75, 0.0625, 0.9375] {
            let x = from + share * (to - from);
            let both = [area.low[across], area.high[across]].map(|edge| {
                let at = if across == 0 { [edge, x] } else { [x, edge] };
                self.value(area, at)
            });
            if both.iter().all(|v| v.abs() > area.error) {
                return Some(both.map(|v| v > 0.0));
            }
        }
        None
    }

    /// The value at a place given in local parameters of the patch.
    fn value(&self, area: &Area, at: [f64; 2]) -> f64 {
        let inner =
            [0, 1].map(|k| ((at[k] - area.low[k]) / (area.high[k] - area.low[k])).clamp(0.0, 1.0));
        value(&area.values, self.degree(), inner)
    }

    /// An arc along which the surfaces touch: double zeros on two opposite sides, one curvature between, and values that
    /// are none along the chord. False when it is not one.
    fn ridge(&self, area: &Area, level: &mut Level) -> bool {
        for [a, b, free] in [[2, 3, 0], [0, 1, 2]] {
            let ([first], [last]) = (&area.sides[a][..], &area.sides[b][..]) else { continue };
            let double = |x: &(f64, usize)| level.nodes[x.1] == NodeKind::Double;
            let is_free = area.sides[free].is_empty() && area.sides[free + 1].is_empty();
            let across = usize::from(a == 0);
            if !(double(first)
                && double(last)
                && is_free
                && bends(&area.values, self.degree(), across, area.error))
            {
                continue;
            }
            let ends = [area.on_side(a, first.0), area.on_side(b, last.0)];
            if !self.vanishes_along(area, ends) {
                continue;
            }
            level.arcs.push(Arc {
                nodes: [first.1, last.1],
                ends,
                patch: self.patch,
                shape: Shape::Straight,
                tangential: true,
            });
            return true;
        }
        false
    }

    /// Whether values along a chord are none: bounded by those at as many Chebyshev points as the degree asks for (the
    /// Lebesgue constant is below 4 for degrees up to 124).
    fn vanishes_along(&self, area: &Area, ends: [[f64; 2]; 2]) -> bool {
        let n = self.degree().s + self.degree().t + 1;
        (0..n).all(|k| {
            let x = (std::f64::consts::PI * (k as f64 + 0.5) / n as f64).cosine();
            let share = 0.5 - 0.5 * x;
            let at = [0, 1].map(|c| ends[0][c] + share * (ends[1][c] - ends[0][c]));
            self.value(area, at).abs() <= 0.25 * self.flat
        })
    }

    /// The two halves, the one with lower parameters last.
    fn halved(&self, area: Area, direction: usize, level: &mut Level) -> [Area; 2] {
        let (place, roots) = self.line(&area, direction);
        let degree = self.degree();
        let x = area.low[direction] + place * (area.high[direction] - area.low[direction]);
        let (mut low, mut high) = (area.values.clone(), area.values.clone());
        if place == 0.5 {
            let halve = if direction == 0 { halve_s } else { halve_t };
            halve(&mut low, &mut high, degree);
        } else {
            let whole = [0.0, 1.0];
            let (a, b) = ([0.0, place], [place, 1.0]);
            let of = |k: usize, part: [f64; 2]| if k == direction { part } else { whole };
            cut_2d(&mut low, degree, of(0, a), of(1, a));
            cut_2d(&mut high, degree, of(0, b), of(1, b));
        }
        let (least, most) = extent(&area.values);
        let steps = 8.0 * degree.s.max(degree.t) as f64 * HALF_ULP;
        let error = area.error + steps * least.abs().max(most.abs());
        let along = 1 - direction;
        let line: Vec<(f64, usize)> = roots
            .into_iter()
            .map(|(share, kind)| {
                level.nodes.push(kind);
                let width = area.high[along] - area.low[along];
                (area.low[along] + share * width, level.nodes.len() - 1)
            })
            .collect();
        let (first, crossed) = if direction == 0 { (0, [2, 3]) } else { (2, [0, 1]) };
        let half = |is_high: bool, values: Vec<f64>| {
            let mut sides = area.sides.clone();
            sides[first + usize::from(!is_high)] = line.clone();
            for side in crossed {
                sides[side].retain(|&(at, _)| (at > x) == is_high);
            }
            let mut corners = area.corners;
            for k in 0..4 {
                let at_high = if direction == 0 { k >= 2 } else { k % 2 == 1 };
                if at_high != is_high {
                    corners[k] = None;
                }
            }
            let mut part = Area {
                low: area.low,
                high: area.high,
                values,
                error,
                sides,
                corners,
                depth: area.depth + 1,
            };
            if is_high {
                part.low[direction] = x
            } else {
                part.high[direction] = x
            }
            part
        };
        [half(true, high), half(false, low)]
    }

    /// Where to halve, as a share, and the zeros on that line: simple ones if some place has only such.
    fn line(&self, area: &Area, direction: usize) -> (f64, Vec<(f64, NodeKind)>) {
        let degree = self.degree();
        let n = if direction == 0 { degree.t } else { degree.s };
        let crossed = if direction == 0 { [2, 3] } else { [0, 1] };
        let width = area.high[direction] - area.low[direction];
        let mut kept = None;
        for place in PLACES {
            let x = area.low[direction] + place * width;
            let near = |&(at, _): &(f64, usize)| (at - x).abs() < 1e-3 * width;
            let hits = crossed.iter().any(|&side| area.sides[side].iter().any(near));
            let mut coefficients = vec![0.0; n + 1];
            isocurve(&mut area.values.clone(), degree, direction == 0, place, &mut coefficients);
            let roots = line_zeros(&coefficients, 2.0 * area.error, self.flat);
            let is_simple = roots.iter().all(|(_, kind)| *kind == NodeKind::Simple);
            if is_simple && !hits {
                return (place, roots);
            }
            if kept.is_none() && !hits {
                kept = Some((place, roots));
            }
        }
        kept.unwrap_or((PLACES[1], Vec::new()))
    }
}

impl Area {
    /// The place on a side, in local parameters of the patch.
    fn on_side(&self, side: usize, x: f64) -> [f64; 2] {
        match side {
            0 => [self.low[0], x],
            1 => [self.high[0], x],
            2 => [x, self.low[1]],
            _ => [x, self.high[1]],
        }
    }
}
