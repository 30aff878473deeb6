//! The cells of a surface under a tree of boxes, and the walk of a ray through it.

use super::cell::{Axis, Cell, MOST_DEVIATION, ROUNDING, Zero};
use crate::bezier::cut_2d;
use crate::bounds::{Aabb, HALF_ULP, Vector, add};
use crate::error::Error;
use crate::index::{Poll, SurfaceIndex};
use crate::simd::{Kernel, Lanes, Simd};

/// Children of a node, and cells of a packet.
pub const WIDTH: usize = 8;

/// Marks a child that is a packet.
const LEAF: u32 = 1 << 31;

/// Most parts of the tree that wait: seven for each level of nodes.
const WAITING: usize = 128;

/// Cells are cut until their crookedness is below this.
const CALM: f64 = 0.2;

/// Most cells, unless there are more patches.
const MOST_CELLS: usize = 1 << 19;

/// Work that the cells of a surface may take, about, in multiplications: a tenth of a second or two.
const MOST_WORK: usize = 1 << 27;

/// Most halvings of a patch.
const DEEPEST: u32 = 12;

/// A node: boxes of its children, component by component, in floats rounded outward.
#[derive(Clone, Debug)]
#[repr(align(64))]
pub struct Node {
    /// Least coordinates.
    low: [[f32; WIDTH]; 3],
    /// Greatest coordinates.
    high: [[f32; WIDTH]; 3],
    /// Node, or packet with the mark; 0: none.
    child: [u32; WIDTH],
}

/// The linear models of eight cells, component by component, in the coordinates of the index. Lane k of packet n is cell
/// 8 n + k; lanes of the last one that are no cells lie on no line.
#[derive(Clone, Debug)]
#[repr(align(64))]
pub struct Packet {
    middle: [[f64; WIDTH]; 3],
    edges: [[[f64; WIDTH]; 3]; 2],
    off: [f64; WIDTH],
    slopes: [[f64; WIDTH]; 2],
}

impl Packet {
    const EMPTY: Self = Self {
        middle: [[0.0; WIDTH]; 3],
        edges: [[[0.0; WIDTH]; 3]; 2],
        off: [f64::NEG_INFINITY; WIDTH],
        slopes: [[0.0; WIDTH]; 2],
    };

    fn set(&mut self, lane: usize, cell: &Cell) {
        for c in 0..3 {
            self.middle[c][lane] = cell.middle[c];
            self.edges[0][c][lane] = cell.edges[0][c];
            self.edges[1][c][lane] = cell.edges[1][c];
        }
        self.off[lane] = cell.off;
        (self.slopes[0][lane], self.slopes[1][lane]) = (cell.slopes[0], cell.slopes[1]);
    }
}

/// What else there is of a cell.
#[derive(Clone, Copy, Debug)]
pub struct Rest {
    /// Its patch.
    pub patch: u32,
    /// Its part of the patch.
    pub area: [f64; 4],
    /// See [`Cell::bends`].
    pub bends: [Vector; 3],
    /// See [`Cell::most_bent`].
    pub most_bent: [f64; 3],
}

/// The cells of a surface under a tree.
#[derive(Debug)]
pub struct Cells {
    nodes: Vec<Node>,
    packets: Vec<Packet>,
    rest: Vec<Rest>,
}

/// A ray in the coordinates of the index.
pub struct Beam {
    /// The line.
    pub axis: Axis,
    /// One over the direction.
    pub inverse: Vector,
    /// The caller's length at the origin.
    pub start: f64,
    /// Least and greatest length from the origin.
    pub reach: [f64; 2],
    /// Bound of the rounding of a place on it.
    pub slack: f64,
}

/// A cell that a ray may meet.
#[derive(Clone, Copy, Debug)]
pub struct Candidate {
    /// The cell.
    pub cell: u32,
    /// Where zeros can be; [`Zero::reach`] is not finite where the linear model says nothing.
    pub zero: Zero,
}

impl Candidate {
    /// Whether the ray crosses the cell once at most.
    pub fn is_single(&self) -> bool {
        self.zero.deviation <= MOST_DEVIATION
    }
}

impl Cells {
    /// Number of cells.
    pub fn count(&self) -> usize {
        self.rest.len()
    }

    /// Bytes held.
    pub fn memory(&self) -> usize {
        self.nodes.capacity() * size_of::<Node>()
            + self.packets.capacity() * size_of::<Packet>()
            + self.rest.capacity() * size_of::<Rest>()
    }

    /// What a packet does not have of a cell.
    pub fn rest(&self, cell: u32) -> &Rest {
        &self.rest[cell as usize]
    }

    /// The model of a cell.
    pub fn cell(&self, cell: u32) -> Cell {
        let (packet, lane) = (&self.packets[cell as usize / WIDTH], cell as usize % WIDTH);
        let rest = self.rest(cell);
        let lane_of = |x: &[[f64; WIDTH]; 3]| [x[0][lane], x[1][lane], x[2][lane]];
        Cell {
            middle: lane_of(&packet.middle),
            edges: [lane_of(&packet.edges[0]), lane_of(&packet.edges[1])],
            bends: rest.bends,
            most_bent: rest.most_bent,
            off: packet.off[lane],
            slopes: [packet.slopes[0][lane], packet.slopes[1][lane]],
            gains: [0.0; 2],
        }
    }

    /// Least length along a ray at which it can meet a cell.
    pub fn least_along(&self, cell: u32, axis: &Axis) -> f64 {
        let (packet, lane) = (&self.packets[cell as usize / WIDTH], cell as usize % WIDTH);
        let d = axis.direction;
        let along =
            |x: &[[f64; WIDTH]; 3]| d[0] * x[0][lane] + d[1] * x[1][lane] + d[2] * x[2][lane];
        let o = axis.origin;
        let middle = along(&packet.middle) - (d[0] * o[0] + d[1] * o[1] + d[2] * o[2]);
        let reach = along(&packet.edges[0]).abs() + along(&packet.edges[1]).abs();
        middle - reach - packet.off[lane] - 64.0 * HALF_ULP
    }
}

/// Cuts a surface into cells and builds the tree.
///
/// # Errors
/// [`Error::OutOfMemory`], [`Error::Cancelled`].
pub fn cells_of(index: &SurfaceIndex, poll: Poll) -> Result<Cells, Error> {
    let (mut packets, mut rest, mut boxes) = (Vec::new(), Vec::new(), Vec::new());
    // Cutting, bounds, and what is halved again; products and derivatives of rational nets take memory.
    let count = index.degree.count() + if index.rational { 64 } else { 0 };
    let each = 4 * count * (index.degree.s + index.degree.t + 8);
    let all = MOST_CELLS.min(MOST_WORK / each);
    let most = (all / index.patches.len().max(1)).max(1);
    let deepest = DEEPEST.min(most.ilog2());
    let mut order = Vec::with_capacity(index.patches.len());
    in_order(
        [0, index.patches.len() / index.columns],
        [0, index.columns],
        index.columns,
        &mut order,
    );
    let mut net = Vec::new();
    for (k, patch) in order.into_iter().enumerate() {
        if k % 64 == 63 && poll() {
            return Err(Error::Cancelled);
        }
        let mut waiting = vec![([0.0, 1.0, 0.0, 1.0], 0)];
        while let Some((area, depth)) = waiting.pop() {
            cut(index, patch, area, &mut net);
            let (cell, aabb) = model(index, patch, &net);
            if depth < deepest && cell.crookedness() > CALM {
                let [a, b] = halves(&cell, area);
                waiting.extend([(b, depth + 1), (a, depth + 1)]);
                continue;
            }
            let lane = rest.len() % WIDTH;
            rest.try_reserve(1).map_err(|_| Error::OutOfMemory)?;
            if lane == 0 {
                packets.try_reserve(1).map_err(|_| Error::OutOfMemory)?;
                packets.push(Packet::EMPTY);
                boxes.push(Aabb::EMPTY);
            }
            let Cell { bends, most_bent, .. } = cell;
            rest.push(Rest { patch: patch as u32, area, bends, most_bent });
            let last = packets.len() - 1;
            packets[last].set(lane, &cell);
            boxes[last] = boxes[last].union(aabb);
        }
    }
    packets.shrink_to_fit();
    rest.shrink_to_fit();
    let mut nodes = Vec::new();
    build(&mut nodes, &boxes, 0, boxes.len());
    Ok(Cells { nodes, packets, rest })
}

/// The net of a part of a patch.
fn cut(index: &SurfaceIndex, patch: usize, area: [f64; 4], net: &mut Vec<f64>) {
    net.clear();
    net.extend_from_slice(index.net(patch).poles);
    for component in net.chunks_exact_mut(index.degree.count()) {
        cut_2d(component, index.degree, [area[0], area[1]], [area[2], area[3]]);
    }
}

/// The model of the net of a part of a patch in the coordinates of the index, with its box.
fn model(index: &SurfaceIndex, patch: usize, net: &[f64]) -> (Cell, Aabb) {
    let (of, count) = (&index.patches[patch], index.degree.count());
    let mut cell = Cell::new(net, index.degree, index.rational, of.radius);
    cell.off += 2.0 * of.spread + 16.0 * HALF_ULP;
    cell.middle = add(cell.middle, of.center);
    let mut aabb = Aabb::EMPTY;
    for k in 0..count {
        let w = if index.rational { net[3 * count + k] } else { 1.0 };
        let x = [net[k] / w, net[count + k] / w, net[2 * count + k] / w];
        aabb.include(add(of.center, x));
    }
    (cell, aabb.grown(cell.off.min(1e-12) + 64.0 * HALF_ULP))
}

/// The two halves of an area, across the direction in which the cell is the more crooked.
pub fn halves(cell: &Cell, area: [f64; 4]) -> [[f64; 4]; 2] {
    let k = cell.more_crooked();
    let middle = 0.5 * (area[2 * k] + area[2 * k + 1]);
    let mut out = [area; 2];
    out[0][2 * k + 1] = middle;
    out[1][2 * k] = middle;
    out
}

/// Patches of a grid in the order of halved rectangles.
fn in_order(rows: [usize; 2], columns: [usize; 2], width: usize, out: &mut Vec<usize>) {
    let size = [rows[1] - rows[0], columns[1] - columns[0]];
    if size[0] == 0 || size[1] == 0 {
        return;
    }
    if size == [1, 1] {
        out.push(rows[0] * width + columns[0]);
    } else if size[0] >= size[1] {
        let middle = rows[0] + size[0] / 2;
        in_order([rows[0], middle], columns, width, out);
        in_order([middle, rows[1]], columns, width, out);
    } else {
        let middle = columns[0] + size[1] / 2;
        in_order(rows, [columns[0], middle], width, out);
        in_order(rows, [middle, columns[1]], width, out);
    }
}

/// Builds the node of a range of boxes; returns its number and box.
fn build(nodes: &mut Vec<Node>, boxes: &[Aabb], first: usize, last: usize) -> (u32, Aabb) {
    let number = nodes.len();
    nodes.push(Node {
        low: [[f32::INFINITY; WIDTH]; 3],
        high: [[f32::NEG_INFINITY; WIDTH]; 3],
        child: [0; WIDTH],
    });
    let mut all = Aabb::EMPTY;
    let count = last - first;
    let parts = count.min(WIDTH);
    for slot in 0..parts {
        let (a, b) = (first + count * slot / parts, first + count * (slot + 1) / parts);
        let (child, aabb) =
            if b - a == 1 { (LEAF | a as u32, boxes[a]) } else { build(nodes, boxes, a, b) };
        let node = &mut nodes[number];
        node.child[slot] = child;
        for c in 0..3 {
            node.low[c][slot] = (aabb.low[c] as f32).next_down();
            node.high[c][slot] = (aabb.high[c] as f32).next_up();
        }
        all = all.union(aabb);
    }
    (number as u32, all)
}

/// The walk of a ray through the tree: all cells that it may meet.
pub struct Walk<'a> {
    /// The tree.
    pub cells: &'a Cells,
    /// The ray.
    pub beam: &'a Beam,
    /// Where candidates go.
    pub out: &'a mut Vec<Candidate>,
}

impl Kernel for Walk<'_> {
    type Out = ();

    #[inline(always)]
    fn run<S: Simd>(self, _: S) {
        let mut stack = [0u32; WAITING];
        let mut count = 1;
        while count > 0 {
            count -= 1;
            let at = stack[count];
            if at & LEAF != 0 {
                meet::<S>(self.cells, at & !LEAF, self.beam, self.out);
                continue;
            }
            let node = &self.cells.nodes[at as usize];
            let mut near = slabs::<S>(node, self.beam);
            while near != 0 {
                let child = node.child[near.trailing_zeros() as usize];
                near &= near - 1;
                // The box of a child that is not there is turned inside out: slabs do not see it. The root is no child.
                if child != 0 && count < WAITING {
                    stack[count] = child;
                    count += 1;
                }
            }
        }
    }
}

/// Which boxes of a node a ray may meet, as bits.
#[inline(always)]
fn slabs<S: Simd>(node: &Node, beam: &Beam) -> u32 {
    let slack = S::F8::splat(beam.slack);
    let mut enter = S::F8::splat(beam.reach[0]);
    let mut leave = S::F8::splat(beam.reach[1]);
    for k in 0..3 {
        let (mut low, mut high) = ([0.0; WIDTH], [0.0; WIDTH]);
        for slot in 0..WIDTH {
            low[slot] = f64::from(node.low[k][slot]);
            high[slot] = f64::from(node.high[k][slot]);
        }
        let o = S::F8::splat(beam.axis.origin[k]);
        let i = S::F8::splat(beam.inverse[k]);
        let a = (S::F8::load(&low) - o - slack) * i;
        let b = (S::F8::load(&high) - o + slack) * i;
        enter = a.min(b).max(enter);
        leave = a.max(b).min(leave);
    }
    // Boxes in floats are wider than the rounding of these products: half a unit of 2^-24.
    !leave.less(enter) & 0xff
}

/// The test of [`Cell::meet`] for the cells of a packet.
#[inline(always)]
fn meet<S: Simd>(cells: &Cells, number: u32, beam: &Beam, out: &mut Vec<Candidate>) {
    let (packet, axis) = (&cells.packets[number as usize], &beam.axis);
    let mut r = [S::F8::splat(0.0); 3];
    let mut edges = [[S::F8::splat(0.0); 3]; 2];
    for k in 0..3 {
        r[k] = S::F8::load(&packet.middle[k]) - S::F8::splat(axis.origin[k]);
        edges[0][k] = S::F8::load(&packet.edges[0][k]);
        edges[1][k] = S::F8::load(&packet.edges[1][k]);
    }
    let off = S::F8::load(&packet.off) + S::F8::splat(beam.slack);
    let mut c = [off; 2];
    let mut a = [[off; 2]; 2];
    let mut beside = 0;
    for k in 0..2 {
        c[k] = dot::<S>(&axis.across[k], &r);
        a[k] = [dot::<S>(&axis.across[k], &edges[0]), dot::<S>(&axis.across[k], &edges[1])];
        beside |= (a[k][0].abs() + a[k][1].abs() + off).less(c[k].abs());
    }
    if beside == 0xff {
        return;
    }
    let (p, q) = (a[0][0] * a[1][1], a[0][1] * a[1][0]);
    let (one, zero) = (S::F8::splat(1.0), S::F8::splat(0.0));
    let (det, size) = (p - q, p.abs() + q.abs());
    let turns = (S::F8::splat(1e-9) * size).less(det.abs());
    let d = one / det;
    let y = [[a[1][1] * d, zero - a[0][1] * d], [zero - a[1][0] * d, a[0][0] * d]];
    let more = S::F8::splat(1.0 + 1e-6);
    let rounding = S::F8::splat(ROUNDING) * (one + S::F8::splat(4.0) * (size * d).abs());
    let mut at = [zero; 2];
    let mut reach = [zero; 2];
    let mut deviation = zero;
    for k in 0..2 {
        at[k] = zero - (y[k][0] * c[0] + y[k][1] * c[1]);
        let length = (y[k][0] * y[k][0] + y[k][1] * y[k][1]).sqrt() * more;
        deviation = deviation + length * S::F8::load(&packet.slopes[k]);
        reach[k] = length * off + rounding;
        beside |= turns & one.less(at[k].abs() - reach[k]);
    }
    let mut left = !beside & 0xff;
    let (at, reach) = ([at[0].array(), at[1].array()], [reach[0].array(), reach[1].array()]);
    let deviation = deviation.array();
    while left != 0 {
        let lane = left.trailing_zeros();
        left &= left - 1;
        let k = lane as usize;
        let zero = if turns >> lane & 1 == 1 {
            Zero {
                at: [at[0][k], at[1][k]],
                reach: [reach[0][k], reach[1][k]],
                deviation: deviation[k],
            }
        } else {
            Zero { at: [0.0; 2], reach: [f64::INFINITY; 2], deviation: f64::INFINITY }
        };
        out.push(Candidate { cell: number * WIDTH as u32 + lane, zero });
    }
}

#[inline(always)]
fn dot<S: Simd>(a: &Vector, b: &[S::F8; 3]) -> S::F8 {
    S::F8::splat(a[0]) * b[0] + S::F8::splat(a[1]) * b[1] + S::F8::splat(a[2]) * b[2]
}
