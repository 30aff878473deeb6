//! Bounding-volume tree over a grid of pieces, four children a node, walked nearest first.
//!
//! ```text
//!   node: 4 boxes, component by component      child = node index, or LEAF | piece index
//!         low x0 x1 x2 x3  ...                 unused children have the empty box (distance infinite)
//! ```
//!
//! Pieces of one spline form a grid (a curve is a grid of one column), so neighbours in the grid are
//! neighbours in space and the tree is built by halving index ranges: no sorting, O(n).

use crate::bounds::{Aabb, Vector};

const LEAF: u32 = 1 << 31;

#[derive(Clone, Debug)]
struct Node {
    low: [[f64; 4]; 3],
    high: [[f64; 4]; 3],
    child: [u32; 4],
}

/// The tree. Immutable once built.
#[derive(Clone, Debug)]
pub struct Tree {
    nodes: Vec<Node>,
    bounds: Aabb,
}

/// A part of the tree that waits for its turn: squared distance of its box and what it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Waiting {
    /// Squared distance from the query to the box, rounded.
    pub key: f64,
    id: u32,
}

impl Waiting {
    /// The piece, when this is a leaf.
    pub fn piece(self) -> Option<usize> {
        (self.id & LEAF != 0).then_some((self.id & !LEAF) as usize)
    }
}

#[derive(Clone, Copy)]
struct Rectangle {
    rows: (usize, usize),
    columns: (usize, usize),
}

impl Rectangle {
    fn count(self) -> usize {
        (self.rows.1 - self.rows.0) * (self.columns.1 - self.columns.0)
    }

    fn halves(self) -> (Self, Self) {
        let (rows, columns) = (self.rows.1 - self.rows.0, self.columns.1 - self.columns.0);
        if rows >= columns {
            let middle = self.rows.0 + rows / 2;
            (
                Self { rows: (self.rows.0, middle), ..self },
                Self { rows: (middle, self.rows.1), ..self },
            )
        } else {
            let middle = self.columns.0 + columns / 2;
            (
                Self { columns: (self.columns.0, middle), ..self },
                Self { columns: (middle, self.columns.1), ..self },
            )
        }
    }
}

impl Tree {
    /// Builds the tree over `boxes`, where box `r * columns + c` belongs to grid place (r, c).
    pub fn new(boxes: &[Aabb], rows: usize, columns: usize) -> Self {
        let mut tree = Self { nodes: Vec::with_capacity(boxes.len() / 2 + 1), bounds: Aabb::EMPTY };
        let all = Rectangle { rows: (0, rows), columns: (0, columns) };
        tree.bounds = tree.build(boxes, columns, all).1;
        tree
    }

    /// Bytes held.
    pub fn memory(&self) -> usize {
        self.nodes.capacity() * size_of::<Node>()
    }

    /// The box of everything.
    pub fn bounds(&self) -> Aabb {
        self.bounds
    }

    fn build(&mut self, boxes: &[Aabb], columns: usize, all: Rectangle) -> (u32, Aabb) {
        let index = self.nodes.len();
        let empty =
            Node { low: [[f64::INFINITY; 4]; 3], high: [[f64::NEG_INFINITY; 4]; 3], child: [0; 4] };
        self.nodes.push(empty);
        let mut bounds = Aabb::EMPTY;
        for (slot, part) in quarters(all).into_iter().enumerate() {
            let (child, aabb) = match part.count() {
                0 => continue,
                1 => {
                    let piece = part.rows.0 * columns + part.columns.0;
                    (LEAF | piece as u32, boxes[piece])
                }
                _ => self.build(boxes, columns, part),
            };
            self.nodes[index].set(slot, child, &aabb);
            bounds = bounds.union(aabb);
        }
        (index as u32, bounds)
    }

    /// Starts a walk: empties `queue` and puts the root in.
    pub fn start(&self, queue: &mut Queue) {
        queue.heap.clear();
        queue.push(Waiting { key: 0.0, id: 0 });
    }

    /// Replaces a node by its children that are nearer than `limit` (squared).
    pub fn open(&self, node: Waiting, query: Vector, limit: f64, queue: &mut Queue) {
        let node = &self.nodes[node.id as usize];
        let keys = node.distances(query);
        for slot in 0..4 {
            if keys[slot] < limit {
                queue.push(Waiting { key: keys[slot], id: node.child[slot] });
            }
        }
    }
}

fn quarters(all: Rectangle) -> [Rectangle; 4] {
    let (a, b) = all.halves();
    let ((a, c), (b, d)) = (a.halves(), b.halves());
    [a, c, b, d]
}

impl Node {
    fn set(&mut self, slot: usize, child: u32, aabb: &Aabb) {
        self.child[slot] = child;
        for k in 0..3 {
            self.low[k][slot] = aabb.low[k];
            self.high[k][slot] = aabb.high[k];
        }
    }

    /// Squared distances to the four boxes; an unused child is infinitely far.
    fn distances(&self, query: Vector) -> [f64; 4] {
        let mut sum = [0.0; 4];
        for k in 0..3 {
            for (slot, total) in sum.iter_mut().enumerate() {
                let below = self.low[k][slot] - query[k];
                let above = query[k] - self.high[k][slot];
                let outside = if below > above { below } else { above };
                let outside = if outside > 0.0 { outside } else { 0.0 };
                *total += outside * outside;
            }
        }
        sum
    }
}

/// The parts of a tree that wait, nearest first; ties by index, so that the order is reproducible.
#[derive(Clone, Debug, Default)]
pub struct Queue {
    heap: Vec<Waiting>,
}

impl Queue {
    fn before(a: Waiting, b: Waiting) -> bool {
        a.key < b.key || (a.key == b.key && a.id < b.id)
    }

    fn push(&mut self, item: Waiting) {
        self.heap.push(item);
        let mut at = self.heap.len() - 1;
        while at > 0 {
            let parent = (at - 1) / 2;
            if !Self::before(item, self.heap[parent]) {
                break;
            }
            self.heap[at] = self.heap[parent];
            at = parent;
        }
        self.heap[at] = item;
    }

    /// Key of the nearest part, without taking it.
    pub fn nearest(&self) -> Option<f64> {
        self.heap.first().map(|item| item.key)
    }

    /// Takes the nearest part.
    pub fn pop(&mut self) -> Option<Waiting> {
        let last = self.heap.pop()?;
        let Some(&top) = self.heap.first() else { return Some(last) };
        let (mut at, count) = (0, self.heap.len());
        loop {
            let mut child = 2 * at + 1;
            if child >= count {
                break;
            }
            if child + 1 < count && Self::before(self.heap[child + 1], self.heap[child]) {
                child += 1;
            }
            if !Self::before(self.heap[child], last) {
                break;
            }
            self.heap[at] = self.heap[child];
            at = child;
        }
        self.heap[at] = last;
        Some(top)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grid(rows: usize, columns: usize) -> Vec<Aabb> {
        let corner = |i: usize, j: usize| [i as f64, j as f64, ((i * 31 + j * 17) % 7) as f64];
        let mut boxes = Vec::new();
        for i in 0..rows {
            for j in 0..columns {
                let low = corner(i, j);
                boxes.push(Aabb { low, high: crate::bounds::add(low, [1.0; 3]) });
            }
        }
        boxes
    }

    #[test]
    fn every_piece_comes_once_and_in_order_of_distance() {
        for (rows, columns) in [(1, 1), (1, 2), (5, 1), (7, 9), (16, 16)] {
            let tree = Tree::new(&grid(rows, columns), rows, columns);
            let mut queue = Queue::default();
            tree.start(&mut queue);
            let (mut seen, mut last) = (vec![0; rows * columns], 0.0);
            while let Some(item) = queue.pop() {
                assert!(item.key >= last);
                last = item.key;
                match item.piece() {
                    Some(piece) => seen[piece] += 1,
                    None => tree.open(item, [2.2, -1.0, 9.0], f64::INFINITY, &mut queue),
                }
            }
            assert!(seen.iter().all(|&n| n == 1), "{rows} x {columns}");
        }
    }

    #[test]
    fn parts_beyond_the_limit_are_dropped() {
        let tree = Tree::new(&grid(8, 8), 8, 8);
        let mut queue = Queue::default();
        tree.start(&mut queue);
        let root = queue.pop().unwrap();
        tree.open(root, [-100.0, 0.0, 0.0], 1.0, &mut queue);
        assert_eq!(queue.pop(), None);
    }
}
