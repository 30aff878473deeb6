//! The edges of a grid of patches: where the polynomial vanishes on them, as nodes that both neighbours share.
//!
//! ```text
//!   corner    value none: a node
//!   edge      values none all along: an arc of its own, and both patches are divided by that side
//!             otherwise: certified zeros, without those that are its corners
//!   collapsed edge: one node for all of it
//! ```
//!
//! Opposite borders of a closed surface are one edge.

use super::quadric::Polynomial;
use crate::bezier::{Bidegree, MAX_PRODUCT, basis, divided_by_side};
use crate::bounds::extent;
use crate::index::SurfaceIndex;
use crate::roots::{Found, zeros_of};

/// Most times that a polynomial is divided by one side.
const MOST_DIVISIONS: u8 = 4;

/// What a node is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NodeKind {
    /// A simple zero on a line.
    Simple,
    /// A double zero on a line.
    Double,
    /// A corner of the grid.
    Corner,
    /// A collapsed edge.
    Collapsed,
    /// A singular point inside.
    Singular,
}

/// What is known of the polynomial on a patch.
pub enum Cell {
    /// It has one sign.
    Clear,
    /// It vanishes.
    Flat,
    /// It may have zeros.
    Open(Polynomial),
}

/// Whether values are none.
pub fn vanishes(values: &[f64], flat: f64) -> bool {
    let (low, high) = extent(values);
    low >= -flat && high <= flat
}

/// An edge on which the polynomial vanishes: nodes along it, in order, and how to walk it.
pub struct FlatEdge {
    /// A patch beside it and which side it is.
    pub patch: usize,
    /// As in `index::side`.
    pub side: usize,
    /// Local parameter along the side, node.
    pub stops: Vec<(f64, usize)>,
    /// Whether the polynomial vanishes there to second order.
    pub tangential: bool,
}

/// Nodes on the four sides of a patch: local parameter along the side, node.
pub type Sides = [Vec<(f64, usize)>; 4];

/// Nodes on the edges and corners of a grid.
pub struct Edges {
    rows: usize,
    columns: usize,
    closed: [bool; 2],
    /// Per edge across u, `i * columns + j`; then per edge across v, `i * (columns + 1) + j`: global parameter, node.
    along: [Vec<Vec<(f64, usize)>>; 2],
    corners: Vec<Option<usize>>,
    spans: Vec<[crate::index::Span; 2]>,
    /// Kinds of the nodes made so far.
    pub kinds: Vec<NodeKind>,
    /// Edges that are arcs.
    pub flat: Vec<FlatEdge>,
}

/// The coefficients on a side.
fn on_side(values: &[f64], degree: Bidegree, side: usize) -> Vec<f64> {
    let width = degree.t + 1;
    match side {
        0 => values[..width].to_vec(),
        1 => values[degree.s * width..].to_vec(),
        2 => values.iter().step_by(width).copied().collect(),
        _ => values.iter().skip(degree.t).step_by(width).copied().collect(),
    }
}

impl Edges {
    /// Finds the nodes; divides the polynomials by the sides on which they vanish. `flat`: values below are none.
    pub fn new(index: &SurfaceIndex, cells: &mut [Cell], flat: f64) -> Self {
        let columns = index.columns;
        let rows = cells.len() / columns;
        let spans = index.patches.iter().map(|patch| [patch.u, patch.v]).collect();
        let mut edges = Self {
            rows,
            columns,
            closed: index.closed,
            along: [vec![Vec::new(); (rows + 1) * columns], vec![Vec::new(); rows * (columns + 1)]],
            corners: vec![None; (rows + 1) * (columns + 1)],
            spans,
            kinds: Vec::new(),
            flat: Vec::new(),
        };
        edges.find_corners(index, cells, flat);
        let flat_edges = edges.find_flat(cells, flat);
        let counts: Vec<[u8; 4]> = edges.divide(cells, &flat_edges, flat);
        edges.find_zeros(index, cells, &flat_edges, &counts, flat);
        edges
    }

    fn corner(&self, i: usize, j: usize) -> usize {
        let i = if self.closed[0] && i == self.rows { 0 } else { i };
        let j = if self.closed[1] && j == self.columns { 0 } else { j };
        i * (self.columns + 1) + j
    }

    /// Edge across u (k = 0) or v (k = 1) at grid place (i, j).
    fn edge(&self, k: usize, i: usize, j: usize) -> usize {
        if k == 0 {
            let i = if self.closed[0] && i == self.rows { 0 } else { i };
            i * self.columns + j
        } else {
            let j = if self.closed[1] && j == self.columns { 0 } else { j };
            i * (self.columns + 1) + j
        }
    }

    /// The edge that is a side of a patch.
    fn side_edge(&self, patch: usize, side: usize) -> usize {
        let (i, j) = (patch / self.columns, patch % self.columns);
        self.edge(side / 2, i + usize::from(side == 1), j + usize::from(side == 3))
    }

    /// The corners of a patch, as in `Area`.
    fn patch_corners(&self, patch: usize) -> [usize; 4] {
        let (i, j) = (patch / self.columns, patch % self.columns);
        [self.corner(i, j), self.corner(i, j + 1), self.corner(i + 1, j), self.corner(i + 1, j + 1)]
    }

    fn find_corners(&mut self, index: &SurfaceIndex, cells: &[Cell], flat: f64) {
        let mut least = vec![f64::INFINITY; self.corners.len()];
        let mut sides = vec![None; self.corners.len()];
        for (patch, cell) in cells.iter().enumerate() {
            let places = self.patch_corners(patch);
            let Cell::Open(f) = cell else {
                if matches!(cell, Cell::Flat) {
                    places.iter().for_each(|&at| least[at] = 0.0);
                }
                continue;
            };
            let (n, m) = (f.degree.s, f.degree.t);
            let at = [0, m, n * (m + 1), (n + 1) * (m + 1) - 1];
            for k in 0..4 {
                least[places[k]] = least[places[k]].min(f.values[at[k]].abs());
            }
            for side in 0..4 {
                let ends = [[0, 1], [2, 3], [0, 2], [1, 3]][side];
                if index.patches[patch].collapsed[side] {
                    ends.iter().for_each(|&k| sides[places[k]] = Some(side));
                }
            }
        }
        let mut collapsed = [None; 4];
        for at in 0..least.len() {
            if least[at] > flat {
                continue;
            }
            let known = sides[at].and_then(|side: usize| collapsed[side]);
            let node = known.unwrap_or_else(|| {
                self.kinds.push(match sides[at] {
                    Some(_) => NodeKind::Collapsed,
                    None => NodeKind::Corner,
                });
                self.kinds.len() - 1
            });
            if let Some(side) = sides[at] {
                collapsed[side] = Some(node);
            }
            self.corners[at] = Some(node);
        }
    }

    /// Which edges the polynomial vanishes on.
    fn find_flat(&self, cells: &[Cell], flat: f64) -> [Vec<bool>; 2] {
        let mut found = [vec![false; self.along[0].len()], vec![false; self.along[1].len()]];
        for (patch, cell) in cells.iter().enumerate() {
            for side in 0..4 {
                let is_flat = match cell {
                    Cell::Clear => false,
                    Cell::Flat => true,
                    Cell::Open(f) => vanishes(&on_side(&f.values, f.degree, side), flat),
                };
                found[side / 2][self.side_edge(patch, side)] |= is_flat;
            }
        }
        found
    }

    /// Divides the open polynomials by flat sides; how many times each.
    fn divide(&self, cells: &mut [Cell], flat_edges: &[Vec<bool>; 2], flat: f64) -> Vec<[u8; 4]> {
        let mut counts = vec![[0; 4]; cells.len()];
        for (patch, cell) in cells.iter_mut().enumerate() {
            let Cell::Open(f) = cell else { continue };
            for side in 0..4 {
                if !flat_edges[side / 2][self.side_edge(patch, side)] {
                    continue;
                }
                loop {
                    let n = if side < 2 { f.degree.s } else { f.degree.t };
                    let values = on_side(&f.values, f.degree, side);
                    if n == 0
                        || counts[patch][side] == MOST_DIVISIONS
                        || (counts[patch][side] > 0 && !vanishes(&values, flat * n as f64))
                    {
                        break;
                    }
                    f.values = divided_by_side(&f.values, f.degree, side);
                    f.degree = f.degree.lowered(side / 2);
                    f.error *= n as f64;
                    counts[patch][side] += 1;
                }
            }
        }
        counts
    }

    fn find_zeros(
        &mut self,
        index: &SurfaceIndex,
        cells: &[Cell],
        flat_edges: &[Vec<bool>; 2],
        counts: &[[u8; 4]],
        flat: f64,
    ) {
        let mut done = [vec![false; self.along[0].len()], vec![false; self.along[1].len()]];
        for (patch, cell) in cells.iter().enumerate() {
            let Cell::Open(f) = cell else { continue };
            let corners = self.patch_corners(patch);
            for side in 0..4 {
                let (k, edge) = (side / 2, self.side_edge(patch, side));
                if std::mem::replace(&mut done[k][edge], true) {
                    continue;
                }
                let ends = [[0, 1], [2, 3], [0, 2], [1, 3]][side].map(|c| self.corners[corners[c]]);
                let is_flat = flat_edges[k][edge];
                let values = on_side(&f.values, f.degree, side);
                let collapsed = index.patches[patch].collapsed[side];
                let zeros = if is_flat {
                    line_zeros(&values, f.error, flat)
                } else {
                    zeros_inside(values, f.error, flat, ends.map(|end| end.is_some()))
                };
                let span = self.spans[patch][1 - k];
                let mut stops = Vec::with_capacity(zeros.len());
                for (x, kind) in zeros {
                    let pole = ends[0].filter(|_| collapsed && is_flat);
                    let node = pole.unwrap_or_else(|| {
                        self.kinds.push(kind);
                        self.kinds.len() - 1
                    });
                    stops.push((x, node));
                    self.along[k][edge].push((span.global(x), node));
                }
                if let ([Some(a), Some(b)], true, false) = (ends, is_flat, collapsed) {
                    stops.insert(0, (0.0, a));
                    stops.push((1.0, b));
                    let tangential = counts[patch][side] > 1;
                    self.flat.push(FlatEdge { patch, side, stops, tangential });
                }
            }
        }
    }

    /// Nodes on the four sides and corners of a patch, in its local parameters.
    pub fn of_patch(&self, patch: usize) -> (Sides, [Option<usize>; 4]) {
        let sides = [0, 1, 2, 3].map(|side| {
            let span = self.spans[patch][1 - side / 2];
            let nodes = &self.along[side / 2][self.side_edge(patch, side)];
            nodes.iter().map(|&(x, node)| (span.local(x), node)).collect()
        });
        (sides, self.patch_corners(patch).map(|at| self.corners[at]))
    }
}

/// Zeros of a polynomial without those that are its ends: they are divided out.
fn zeros_inside(
    mut values: Vec<f64>,
    mut error: f64,
    flat: f64,
    ends: [bool; 2],
) -> Vec<(f64, NodeKind)> {
    for (k, _) in ends.iter().enumerate().filter(|(_, is_node)| **is_node) {
        let mut limit = flat;
        for _ in 0..2 {
            let n = values.len() - 1;
            let end = if k == 0 { values[0] } else { values[n] };
            if n == 0 || end.abs() > limit {
                break;
            }
            values = divided_by_side(&values, Bidegree { s: 0, t: n }, 2 + k);
            error *= n as f64;
            limit = flat * n as f64;
        }
    }
    line_zeros(&values, error, flat)
}

/// Zeros of a polynomial along a line, in order; those that are not simple are where it is nearest to zero.
pub fn line_zeros(coefficients: &[f64], error: f64, flat: f64) -> Vec<(f64, NodeKind)> {
    if coefficients.len() < 2 || vanishes(coefficients, flat) {
        return Vec::new();
    }
    let is_flat = |_: f64, _: f64, size: f64, is_noise: bool| is_noise || size <= 0.25 * flat;
    let mut zeros = Vec::new();
    zeros_of(coefficients, error, &is_flat, &mut 2_000, &mut zeros);
    let mut out: Vec<(f64, NodeKind)> = Vec::new();
    for zero in zeros {
        let (at, kind) = if zero.found == Found::Root {
            (zero.at[0], NodeKind::Simple)
        } else {
            (nearest_to_zero(coefficients, zero.low[0], zero.high[0]), NodeKind::Double)
        };
        // Two zeros with nothing between them but values that are none are a double one.
        if let Some(last) = out.last_mut()
            && at - last.0 < CLOSE
        {
            let middle = nearest_to_zero(coefficients, last.0, at);
            if (last.1, kind) != (NodeKind::Simple, NodeKind::Simple)
                || value_on(coefficients, middle).abs() <= flat
            {
                *last = (middle, NodeKind::Double);
                continue;
            }
        }
        out.push((at, kind));
    }
    out
}

/// Zeros on a line that are nearer than this share of it are looked at together.
const CLOSE: f64 = 1e-2;

/// The value of a polynomial in one parameter.
fn value_on(coefficients: &[f64], x: f64) -> f64 {
    let mut rows = [[0.0; MAX_PRODUCT]; 3];
    let [a, a1, a2] = &mut rows;
    basis::<f64, 1, MAX_PRODUCT>(coefficients.len() - 1, x, a, a1, a2);
    coefficients.iter().zip(&*a).map(|(c, d)| c * d).sum()
}

/// Where the slope changes its sign in a small interval and its surroundings.
fn nearest_to_zero(coefficients: &[f64], low: f64, high: f64) -> f64 {
    let n = coefficients.len() - 1;
    let slope = |x: f64| {
        let mut rows = [[0.0; MAX_PRODUCT]; 3];
        let [a, a1, a2] = &mut rows;
        basis::<f64, 1, MAX_PRODUCT>(n, x, a, a1, a2);
        coefficients.iter().zip(&*a1).map(|(c, d)| c * d).sum::<f64>()
    };
    let width = high - low;
    let (mut a, mut b) = ((low - width).max(0.0), (high + width).min(1.0));
    let rising = slope(b) > 0.0;
    if (slope(a) > 0.0) == rising {
        return 0.5 * (low + high);
    }
    for _ in 0..60 {
        let x = 0.5 * (a + b);
        if (slope(x) > 0.0) == rising { b = x } else { a = x }
    }
    0.5 * (a + b)
}
