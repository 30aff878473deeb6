//! The index of a surface: its Bezier patches.

use super::piece::{
    Frame, LocalNet, MAX_TENSOR_BYTES, Span, balance_for, parts_for, position_steps,
    power_of_two_over, push_tensors, reserved, tensor_len,
};
use crate::analytic::Analytic;
use crate::bezier::{Bidegree, extraction};
use crate::bounds::{Aabb, HALF_ULP, Vector, add, extent, norm, sub};
use crate::coefficients::Grid;
use crate::error::Error;
use crate::index::segments::pieces;
use crate::jet::{BezierPatch, Lane, lanes, pole_distance};
use crate::knots::Knots;
use crate::simd::Level;
use crate::surface::Surface;
use crate::tree::Tree;

/// A collapsed edge whose poles spread by more than this share of the box diagonal is searched as the tiny edge
/// that it is; below it, the poles are made to coincide, at the price of that much in every bound.
pub const MOST_SPREAD: f64 = 1e-12;

/// The four sides of a patch, as indices of its `border` and `collapsed` arrays.
pub mod side {
    /// s = 0.
    pub const S0: usize = 0;
    /// s = 1.
    pub const S1: usize = 1;
    /// t = 0.
    pub const T0: usize = 2;
    /// t = 1.
    pub const T1: usize = 3;
}

/// One Bezier patch; its numbers are in [`SurfaceIndex`]'s arrays.
#[derive(Clone, Debug)]
pub struct Patch {
    /// Parameters of s.
    pub u: Span,
    /// Parameters of t.
    pub v: Span,
    /// Origin of the patch's coordinates, in the index's coordinates.
    pub center: Vector,
    /// Greatest distance of a pole from `center`.
    pub radius: f64,
    /// Whether a least distance may sit on this side with a gradient: a border of the domain or a C0 knot line.
    pub border: [bool; 4],
    /// Whether this side is a collapsed edge; its poles then coincide exactly (see `spread`).
    pub collapsed: [bool; 4],
    /// How far the net was moved to make its collapsed edges exact.
    pub spread: f64,
}

impl Patch {
    /// Whether one of its sides is a collapsed edge.
    pub fn has_collapsed(&self) -> bool {
        self.collapsed != [false; 4]
    }
}

/// Search structure of a surface.
#[derive(Debug)]
pub struct SurfaceIndex {
    /// Map from the caller's coordinates.
    pub frame: Frame,
    /// The patches; (a, b) at `a * columns + b`.
    pub patches: Vec<Patch>,
    /// Boxes of the patches.
    pub tree: Tree,
    /// Degrees of the patches.
    pub degree: Bidegree,
    /// Whether weights are there.
    pub rational: bool,
    /// Number of patches in v.
    pub columns: usize,
    /// Whether the surface is closed in u, in v.
    pub closed: [bool; 2],
    /// Whether the edges u0, u1, v0, v1 are collapsed.
    pub collapsed: [bool; 4],
    /// The elementary surface that this one is, if it is one.
    pub analytic: Option<Box<Analytic>>,
    nets: Vec<f64>,
    lanes: Vec<Lane>,
    tensors: Vec<f64>,
    /// The coefficient arrays of its patches.
    pub grid: Grid,
    /// Those of their edges along s and along t.
    pub edge_grids: [Grid; 2],
}

/// One direction's spans with their extraction matrices.
struct Direction {
    spans: Vec<(usize, [f64; 2])>,
    matrices: Vec<f64>,
    size: usize,
}

impl Direction {
    fn new(knots: &Knots, parts: usize) -> Self {
        let spans = pieces(knots, parts);
        let size = knots.degree() + 1;
        let mut matrices = vec![0.0; spans.len() * size * size];
        for (matrix, &(span, ends)) in matrices.chunks_exact_mut(size * size).zip(&spans) {
            extraction(knots, span, ends, matrix);
        }
        Self { spans, matrices, size }
    }

    fn matrix(&self, k: usize) -> &[f64] {
        let n = self.size * self.size;
        &self.matrices[k * n..(k + 1) * n]
    }
}

impl SurfaceIndex {
    /// Builds the index for the vector instructions of `level`; `poll` is asked now and then whether to stop.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`], [`Error::Cancelled`].
    pub fn new(
        surface: &Surface,
        level: Level,
        poll: &mut dyn FnMut() -> bool,
    ) -> Result<Self, Error> {
        let rational = surface.is_rational();
        let [parts_u, parts_v] = if rational { parts(surface) } else { [1, 1] };
        let u = Direction::new(surface.knots_u(), parts_u);
        let v = Direction::new(surface.knots_v(), parts_v);
        let degree = Bidegree { s: u.size - 1, t: v.size - 1 };
        let (rows, columns) = (u.spans.len(), v.spans.len());
        let (count, width) = (rows * columns, degree.count() * if rational { 4 } else { 3 });
        let tensor_width = tensor_len(degree, rational);
        let keep_tensors = count * tensor_width * 8 <= MAX_TENSOR_BYTES || tensor_width <= 1125;
        let mut index = Self {
            frame: Frame::new(surface.poles(), surface.bounding_box()),
            patches: reserved(count)?,
            tree: Tree::new(&[], 0, 0, level),
            degree,
            rational,
            columns,
            closed: [surface.is_closed_u(), surface.is_closed_v()],
            collapsed: surface.collapsed_edges(),
            analytic: None,
            nets: reserved(count * width)?,
            lanes: reserved(count * degree.count())?,
            grid: Grid::new(degree, rational, level),
            edge_grids: [degree.s, degree.t]
                .map(|t| Grid::new(Bidegree { s: 0, t }, rational, level)),
            tensors: reserved(if keep_tensors { count * tensor_width } else { 0 })?,
        };
        let mut boxes = reserved(count)?;
        let exact = |k: usize| surface.collapsed_spread(k) <= MOST_SPREAD * index.frame.diagonal;
        let edges = [0, 1, 2, 3].map(|k| index.collapsed[k] && exact(k));
        let points = collapsed_points(surface, edges).map(|point| index.frame.enter(point));
        for k in 0..count {
            if k % 256 == 255 && poll() {
                return Err(Error::Cancelled);
            }
            let (a, b) = (k / columns, k % columns);
            let at_side = [a == 0, a + 1 == rows, b == 0, b + 1 == columns];
            let collapsed = [0, 1, 2, 3].map(|k| at_side[k] && edges[k]);
            boxes.push(index.push_patch(surface, (&u, a), (&v, b), (collapsed, &points)));
            let net = &index.nets[k * width..];
            index.lanes.extend(lanes(net, rational));
            if keep_tensors {
                push_tensors(net, degree, rational, &mut index.tensors);
            }
        }
        index.tree = Tree::new(&boxes, rows, columns, level);
        Ok(index)
    }

    fn push_patch(
        &mut self,
        surface: &Surface,
        (u, a): (&Direction, usize),
        (v, b): (&Direction, usize),
        (collapsed, points): ([bool; 4], &[Vector; 4]),
    ) -> Aabb {
        let net = self.local_net(surface, u.spans[a].0, v.spans[b].0);
        let start = self.nets.len();
        let components = if self.rational { 4 } else { 3 };
        for component in &net.components[..components] {
            extract(component, u.matrix(a), u.size, v.matrix(b), v.size, &mut self.nets);
        }
        let balance = self.balance(start);
        let (border_u, border_v) =
            (border(surface.knots_u(), u.spans[a].1), border(surface.knots_v(), v.spans[b].1));
        let mut patch = Patch {
            u: Span { ends: u.spans[a].1, balance: balance[0] },
            v: Span { ends: v.spans[b].1, balance: balance[1] },
            center: net.center,
            radius: net.radius,
            border: [border_u[0], border_u[1], border_v[0], border_v[1]],
            collapsed,
            spread: 0.0,
        };
        self.make_collapsed_exact(points, &mut patch, start);
        let mut aabb = Aabb::EMPTY;
        self.visit_poles(start, |_, _, pole, _| aabb.include(add(net.center, pole)));
        let margin = position_steps(self.degree.s + self.degree.t) * net.radius + 8.0 * HALF_ULP;
        let margin = margin + patch.spread;
        self.patches.push(patch);
        aabb.grown(margin)
    }

    /// Balances the weights of the net that starts at `start`, by the product of the weights on opposite sides.
    fn balance(&mut self, start: usize) -> [f64; 2] {
        let (degree, count) = (self.degree, self.degree.count());
        if !self.rational {
            return [1.0; 2];
        }
        let w = &self.nets[start + 3 * count..];
        let width = degree.t + 1;
        let ratio = |first: f64, last: f64| last / first;
        let corner = [w[0], w[degree.t], w[degree.s * width], w[count - 1]];
        let balance = [
            balance_for(ratio(corner[0] * corner[1], corner[2] * corner[3]).sqrt(), degree.s),
            balance_for(ratio(corner[0] * corner[2], corner[1] * corner[3]).sqrt(), degree.t),
        ];
        if balance != [1.0; 2] {
            let grown = |k: usize| {
                balance[0].powi((k / width) as i32) * balance[1].powi((k % width) as i32)
            };
            let largest = (0..count).fold(0.0, |m: f64, k| m.max(w[k] * grown(k)));
            let factor = power_of_two_over(largest);
            for component in self.nets[start..].chunks_exact_mut(count) {
                (0..count).for_each(|k| component[k] *= grown(k) * factor);
            }
        }
        balance
    }

    fn local_net(&self, surface: &Surface, span_u: usize, span_v: usize) -> LocalNet {
        let columns = surface.knots_v().pole_count();
        let mut local = Vec::with_capacity(self.degree.count());
        // Equal weights are no weights: the surface says so, and then they must not scale the poles.
        let weights = surface.weights().filter(|_| self.rational);
        for i in span_u - self.degree.s..=span_u {
            for j in span_v - self.degree.t..=span_v {
                let at = i * columns + j;
                let weight = weights.map_or(1.0, |w| w[at]);
                local.push((self.frame.enter(surface.poles()[at]), weight));
            }
        }
        LocalNet::new(&local)
    }

    /// Calls `f(i, j, Euclidean pole, weight)` for the net that starts at `start`.
    fn visit_poles(&self, start: usize, mut f: impl FnMut(usize, usize, Vector, f64)) {
        let count = self.degree.count();
        let net = &self.nets[start..];
        for k in 0..count {
            let w = if self.rational { net[3 * count + k] } else { 1.0 };
            let at = |c: usize| net[c * count + k] / w;
            f(k / (self.degree.t + 1), k % (self.degree.t + 1), [at(0), at(1), at(2)], w);
        }
    }

    /// Moves the poles of collapsed sides onto their points, and records how far.
    fn make_collapsed_exact(&mut self, points: &[Vector; 4], patch: &mut Patch, start: usize) {
        for k in (0..4).filter(|&k| patch.collapsed[k]) {
            let point = sub(points[k], patch.center);
            let (last_i, last_j) = (self.degree.s, self.degree.t);
            let (mut moves, mut move_) = (Vec::new(), 0.0f64);
            self.visit_poles(start, |i, j, pole, weight| {
                if [i == 0, i == last_i, j == 0, j == last_j][k] {
                    moves.push((i * (last_j + 1) + j, weight));
                    move_ = move_.max(norm(sub(pole, point)));
                }
            });
            // The poles themselves are rounded, and so is the point.
            patch.spread += move_ + 2.0 * position_steps(last_i + last_j) * patch.radius;
            for (at, weight) in moves {
                for c in 0..3 {
                    self.nets[start + c * self.degree.count() + at] = weight * point[c];
                }
            }
        }
    }

    /// Patch `k`'s poles.
    pub fn net(&self, k: usize) -> BezierPatch<'_> {
        let width = self.degree.count() * if self.rational { 4 } else { 3 };
        let poles = &self.nets[k * width..(k + 1) * width];
        let count = self.degree.count();
        let lanes = &self.lanes[k * count..(k + 1) * count];
        BezierPatch {
            degree: self.degree,
            rational: self.rational,
            poles,
            lanes,
            level: self.grid.level,
        }
    }

    /// Distance from `query` to the nearest corner of patch `k`, in the index's coordinates and but for rounding.
    pub fn corner_distance(&self, k: usize, query: Vector) -> f64 {
        let (lanes, columns) = (self.net(k).lanes, self.degree.t + 1);
        let q = sub(query, self.patches[k].center);
        let corners = [0, self.degree.t, self.degree.s * columns, lanes.len() - 1];
        corners.into_iter().fold(f64::INFINITY, |least, at| least.min(pole_distance(&lanes[at], q)))
    }

    /// Patch `k`'s tensors A, -2 B, C, when they are kept.
    pub fn tensors(&self, k: usize) -> Option<&[f64]> {
        let width = tensor_len(self.degree, self.rational);
        self.tensors.get(k * width..(k + 1) * width)
    }

    /// Bytes held.
    pub fn memory(&self) -> usize {
        size_of::<Self>()
            + (self.nets.capacity() + self.tensors.capacity() + 4 * self.lanes.capacity()) * 8
            + self.patches.capacity() * size_of::<Patch>()
            + self.tree.memory()
            + self.grid.memory()
            + self.edge_grids.iter().map(Grid::memory).sum::<usize>()
            + self.analytic.as_ref().map_or(0, |analytic| analytic.memory())
    }
}

/// Whether the ends of a piece are borders of the domain or C0 knots.
fn border(knots: &Knots, ends: [f64; 2]) -> [bool; 2] {
    let (first, last) = knots.domain();
    ends.map(|u| u == first || u == last || knots.multiplicity(u) >= knots.degree())
}

/// The points onto which collapsed edges are moved: a corner of the surface on each. Edges that meet share theirs.
fn collapsed_points(surface: &Surface, edges: [bool; 4]) -> [Vector; 4] {
    let [u0, u1, v0, v1] = surface.domain();
    let corner = [(u0, v0), (u1, v0), (u0, v0), (u0, v1)].map(|(u, v)| surface.evaluate(u, v));
    let linked = edges[0] && (edges[2] || edges[3]);
    let first = if edges[0] { Some(0) } else { edges[1].then_some(1) };
    let of_v = |k: usize| corner[first.unwrap_or(k)];
    [corner[0], corner[if linked { 0 } else { 1 }], of_v(2), of_v(3)]
}

/// Into how many parts the spans of u and v are cut: by the weights' growth along each direction.
fn parts(surface: &Surface) -> [usize; 2] {
    let weights = surface.weights().unwrap_or(&[]);
    let columns = surface.knots_v().pole_count();
    let window = |w: &[f64]| {
        let (low, high) = extent(w);
        high / low
    };
    let size = [surface.knots_u().degree() + 1, surface.knots_v().degree() + 1];
    let along_v = weights.chunks_exact(columns).flat_map(|row| row.windows(size[1]).map(window));
    let column = |j: usize| weights.iter().skip(j).step_by(columns).copied().collect::<Vec<f64>>();
    let along_u = (0..columns).map(|j| column(j).windows(size[0]).map(window).fold(1.0, f64::max));
    [along_u.fold(1.0, f64::max), along_v.fold(1.0, f64::max)].map(parts_for)
}

/// Applies the two extraction matrices to one component of a local net and appends the Bezier poles.
fn extract(
    local: &[f64],
    m_u: &[f64],
    rows: usize,
    m_v: &[f64],
    columns: usize,
    out: &mut Vec<f64>,
) {
    let mut half = vec![0.0; rows * columns];
    for i in 0..rows {
        for j in 0..columns {
            let row = &m_v[j * columns..(j + 1) * columns];
            half[i * columns + j] = row.iter().zip(&local[i * columns..]).map(|(m, x)| m * x).sum();
        }
    }
    for i in 0..rows {
        for j in 0..columns {
            out.push((0..rows).map(|k| m_u[i * rows + k] * half[k * columns + j]).sum());
        }
    }
}
