//! The cells of a surface under a tree of boxes, and the test of a ray against the boxes of a node.

use super::cell::{Axis, Cell};
use crate::bezier::cut_2d;
use crate::bounds::{Aabb, HALF_ULP, Vector, add, norm};
use crate::error::Error;
use crate::index::{Poll, SurfaceIndex};
use crate::simd::{Kernel, Lanes, Simd};

/// Children of a node.
pub const WIDTH: usize = 8;
/// Marks a child that is a cell.
pub const LEAF: u32 = 1 << 31;

/// Cells are cut until their crookedness is below this.
const CALM: f64 = 0.2;

/// Most cells, unless there are more patches.
const MOST_CELLS: usize = 1 << 19;

/// Most halvings of a patch.
const DEEPEST: u32 = 12;

/// A node: boxes of its children, component by component, in floats rounded outward.
#[derive(Clone, Debug)]
#[repr(align(64))]
pub struct Node {
    /// Least coordinates.
    pub low: [[f32; WIDTH]; 3],
    /// Greatest coordinates.
    pub high: [[f32; WIDTH]; 3],
    /// Node, or cell with the mark; 0: none.
    pub child: [u32; WIDTH],
}

/// A cell with its place in a patch.
#[derive(Clone, Copy, Debug)]
pub struct Placed {
    /// Its model, in the coordinates of the index.
    pub cell: Cell,
    /// Its patch.
    pub patch: u32,
    /// Halvings for one ray.
    pub depth: u32,
    /// Its part of the patch.
    pub area: [f64; 4],
}

/// A ray in the coordinates of the index.
pub struct Beam {
    /// The line.
    pub axis: Axis,
    /// One over the direction.
    pub inverse: Vector,
    /// Caller's length of the origin.
    /// As it says: `t` there.
    pub start: f64,
    /// Least and greatest length from the origin.
    pub reach: [f64; 2],
    /// Bound of the rounding of a place on it.
    pub slack: f64,
}

/// Cuts a surface into cells and builds the tree.
///
/// # Errors
/// [`Error::OutOfMemory`], [`Error::Cancelled`].
pub fn cells_of(index: &SurfaceIndex, poll: Poll) -> Result<(Vec<Node>, Vec<Placed>), Error> {
    let (mut cells, mut boxes) = (Vec::new(), Vec::new());
    let most = (MOST_CELLS / index.patches.len().max(1)).max(1);
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
            let (cell, aabb) = model(index, patch, area, &mut net);
            if depth < deepest && cell.crookedness() > CALM {
                let [a, b] = halves(&cell, area);
                waiting.extend([(b, depth + 1), (a, depth + 1)]);
                continue;
            }
            cells.try_reserve(1).map_err(|_| Error::OutOfMemory)?;
            cells.push(Placed { cell, patch: patch as u32, depth: 0, area });
            boxes.push(aabb);
        }
    }
    let mut nodes = Vec::new();
    build(&mut nodes, &boxes, 0, boxes.len());
    drop(boxes);
    Ok((nodes, cells))
}

/// The model of a part of a patch in the coordinates of the index, with its box.
pub fn model(
    index: &SurfaceIndex,
    patch: usize,
    area: [f64; 4],
    net: &mut Vec<f64>,
) -> (Cell, Aabb) {
    let (of, count) = (&index.patches[patch], index.degree.count());
    net.clear();
    net.extend_from_slice(index.net(patch).poles);
    for component in net.chunks_exact_mut(count) {
        cut_2d(component, index.degree, [area[0], area[1]], [area[2], area[3]]);
    }
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

/// The two halves of an area, across the direction in which the cell bends more.
pub fn halves(cell: &Cell, area: [f64; 4]) -> [[f64; 4]; 2] {
    let [aa, ab, bb] = cell.bends.map(norm);
    let lengths = cell.edges.map(norm);
    let (s, t) = (aa + 0.5 * ab, bb + 0.5 * ab);
    let along_t = if s == t { lengths[1] > lengths[0] } else { t > s };
    let k = usize::from(along_t);
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

/// How long a ray is in each of eight boxes, negative where it misses.
pub struct Slabs<'a> {
    /// The node.
    pub node: &'a Node,
    /// The ray.
    pub beam: &'a Beam,
}

impl Kernel for Slabs<'_> {
    type Out = [f64; WIDTH];

    #[inline(always)]
    fn run<S: Simd>(self, _: S) -> [f64; WIDTH] {
        let slack = S::F8::splat(self.beam.slack);
        let mut enter = S::F8::splat(self.beam.reach[0]);
        let mut leave = S::F8::splat(self.beam.reach[1]);
        for k in 0..3 {
            let (mut low, mut high) = ([0.0; WIDTH], [0.0; WIDTH]);
            for slot in 0..WIDTH {
                low[slot] = f64::from(self.node.low[k][slot]);
                high[slot] = f64::from(self.node.high[k][slot]);
            }
            let o = S::F8::splat(self.beam.axis.origin[k]);
            let i = S::F8::splat(self.beam.inverse[k]);
            let a = (S::F8::load(&low) - o - slack) * i;
            let b = (S::F8::load(&high) - o + slack) * i;
            enter = a.min(b).max(enter);
            leave = a.max(b).min(leave);
        }
        // Boxes in floats are wider than the rounding of these products: half a unit of 2^-24.
        (leave - enter).array()
    }
}
