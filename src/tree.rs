//! Bounding-volume tree over a grid of pieces, eight children a node, walked nearest first.
//!
//! ```text
//!   node: 8 boxes, component by component      child = node index, or LEAF | piece index
//!         low x0 x1 .. x7  ...                 unused children have the empty box (distance infinite)
//! ```
//!
//! Boxes are kept in floats, rounded outward: eight children take as much as four would in doubles. Distances are in
//! doubles. Pieces of one spline form a grid (a curve is a grid of one column), so neighbours in the grid are
//! neighbours in space and the tree is built by halving index ranges: no sorting, O(n).

use crate::bounds::{Aabb, Vector};
use crate::simd::{Kernel, Lanes, Level, Simd};

const LEAF: u32 = 1 << 31;

/// Nodes that [`Tree::seek`] opens at most, and parts that wait meanwhile: eight of each node but for the one that is next.
const MOST_OPENED: usize = 24;
const MOST_WAITING: usize = 7 * MOST_OPENED + 1;

/// Children of a node.
const WIDTH: usize = 8;

#[derive(Clone, Debug)]
#[repr(align(32))]
struct Node {
    low: [[f32; WIDTH]; 3],
    high: [[f32; WIDTH]; 3],
    child: [u32; WIDTH],
}

/// The tree. Immutable once built.
#[derive(Clone, Debug)]
pub struct Tree {
    nodes: Vec<Node>,
    level: Level,
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
    pub fn new(boxes: &[Aabb], rows: usize, columns: usize, level: Level) -> Self {
        let nodes = Vec::with_capacity(boxes.len() / 4 + 1);
        let mut tree = Self { nodes, level };
        let all = Rectangle { rows: (0, rows), columns: (0, columns) };
        tree.build(boxes, columns, all);
        tree.nodes.shrink_to_fit();
        tree
    }

    /// The instructions that it uses.
    pub fn level(&self) -> Level {
        self.level
    }

    /// Bytes held.
    pub fn memory(&self) -> usize {
        self.nodes.capacity() * size_of::<Node>()
    }

    fn build(&mut self, boxes: &[Aabb], columns: usize, all: Rectangle) -> (u32, Aabb) {
        let index = self.nodes.len();
        self.nodes.push(Node {
            low: [[f32::INFINITY; WIDTH]; 3],
            high: [[f32::NEG_INFINITY; WIDTH]; 3],
            child: [0; WIDTH],
        });
        let mut bounds = Aabb::EMPTY;
        for (slot, part) in parts(all).into_iter().enumerate() {
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
        queue.clear();
        queue.push(Waiting { key: 0.0, id: 0 });
    }

    /// Replaces a node by its children that are nearer than `limit` (squared).
    pub fn open(&self, node: Waiting, query: Vector, limit: f64, queue: &mut Queue) {
        let node = &self.nodes[node.id as usize];
        let keys = self.level.run(Distances { node, query });
        for (key, id) in keys.into_iter().zip(node.child) {
            if key < limit {
                queue.push(Waiting { key, id });
            }
        }
    }

    /// Visits pieces near a query, the nearest of each node first, as long as boxes are nearer than the least square that
    /// `visit` has told, and no more nodes than a search would: what is found is most likely near, not surely nearest.
    pub fn seek(&self, query: Vector, mut visit: impl FnMut(usize) -> f64) {
        let mut waiting = [Waiting { key: 0.0, id: 0 }; MOST_WAITING];
        let (mut count, mut least, mut opened) = (1, f64::INFINITY, 0);
        while count > 0 {
            count -= 1;
            let next = waiting[count];
            if next.key >= least {
                continue;
            }
            if let Some(piece) = next.piece() {
                least = visit(piece);
                continue;
            }
            if opened == MOST_OPENED {
                return;
            }
            opened += 1;
            let node = &self.nodes[next.id as usize];
            let (keys, first) = (self.level.run(Distances { node, query }), count);
            for (key, id) in keys.into_iter().zip(node.child).filter(|&(key, _)| key < least) {
                // The nearest on top.
                let mut at = count;
                while at > first && waiting[at - 1].key < key {
                    waiting[at] = waiting[at - 1];
                    at -= 1;
                }
                waiting[at] = Waiting { key, id };
                count += 1;
            }
        }
    }

    /// A piece whose box is near, found without looking at more than one node a level; `None` when one node is all.
    pub fn glance(&self, query: Vector) -> Option<usize> {
        let mut at = 0;
        loop {
            let node = &self.nodes[at];
            let keys = self.level.run(Distances { node, query });
            let mut best = 0;
            for slot in 1..WIDTH {
                if keys[slot] < keys[best] {
                    best = slot;
                }
            }
            let child = node.child[best];
            if child & LEAF != 0 {
                return (at > 0).then_some((child & !LEAF) as usize);
            }
            if child == 0 {
                return None;
            }
            at = child as usize;
        }
    }
}

fn parts(all: Rectangle) -> [Rectangle; WIDTH] {
    let (a, b) = all.halves();
    let ((a, c), (b, d)) = (a.halves(), b.halves());
    let [(a, e), (c, f), (b, g), (d, h)] = [a, c, b, d].map(Rectangle::halves);
    [a, e, c, f, b, g, d, h]
}

/// The greatest float that is not more.
fn rounded_down(x: f64) -> f32 {
    let y = x as f32;
    if f64::from(y) > x { y.next_down() } else { y }
}

impl Node {
    fn set(&mut self, slot: usize, child: u32, aabb: &Aabb) {
        self.child[slot] = child;
        for k in 0..3 {
            self.low[k][slot] = rounded_down(aabb.low[k]);
            self.high[k][slot] = -rounded_down(-aabb.high[k]);
        }
    }
}

/// Squared distances to the eight boxes; an unused child is infinitely far.
struct Distances<'a> {
    node: &'a Node,
    query: Vector,
}

impl Kernel for Distances<'_> {
    type Out = [f64; WIDTH];

    #[inline(always)]
    fn run<S: Simd>(self, _: S) -> [f64; WIDTH] {
        let mut sum = S::F8::splat(0.0);
        for k in 0..3 {
            let (mut low, mut high) = ([0.0; WIDTH], [0.0; WIDTH]);
            for slot in 0..WIDTH {
                low[slot] = f64::from(self.node.low[k][slot]);
                high[slot] = f64::from(self.node.high[k][slot]);
            }
            let q = S::F8::splat(self.query[k]);
            let outside = (S::F8::load(&low) - q).max(q - S::F8::load(&high));
            let outside = outside.max(S::F8::splat(0.0));
            sum = sum + outside * outside;
        }
        sum.array()
    }
}

/// How many of the nearest a [`Queue`] keeps in order.
const FRONT: usize = 24;

/// The parts of a tree that wait, nearest first; ties by index, so that the order is reproducible.
///
/// ```text
///   front: the nearest, in order, the very nearest last      rest: a heap of what is farther than all of the front
/// ```
///
/// What a walk puts in is mostly among the nearest: a few steps through the front, and nothing to be done when it is taken
/// out.
#[derive(Clone, Debug, Default)]
pub struct Queue {
    front: Vec<Waiting>,
    rest: Vec<Waiting>,
}

impl Queue {
    fn before(a: Waiting, b: Waiting) -> bool {
        a.key < b.key || (a.key == b.key && a.id < b.id)
    }

    fn clear(&mut self) {
        self.front.clear();
        self.rest.clear();
    }

    fn push(&mut self, item: Waiting) {
        if self.rest.first().is_some_and(|&nearest| Self::before(nearest, item)) {
            return self.put_by(item);
        }
        if self.front.len() == FRONT {
            let farthest = self.front[0];
            if Self::before(farthest, item) {
                return self.put_by(item);
            }
            self.front.remove(0);
            self.put_by(farthest);
        }
        self.front.push(item);
        let mut at = self.front.len() - 1;
        while at > 0 && Self::before(self.front[at - 1], item) {
            self.front[at] = self.front[at - 1];
            at -= 1;
        }
        self.front[at] = item;
    }

    /// Key of the nearest part, without taking it.
    pub fn nearest(&self) -> Option<f64> {
        self.front.last().or(self.rest.first()).map(|item| item.key)
    }

    /// Takes the nearest part.
    pub fn pop(&mut self) -> Option<Waiting> {
        self.front.pop().or_else(|| self.take_from_rest())
    }

    fn put_by(&mut self, item: Waiting) {
        self.rest.push(item);
        let mut at = self.rest.len() - 1;
        while at > 0 {
            let parent = (at - 1) / 2;
            if !Self::before(item, self.rest[parent]) {
                break;
            }
            self.rest[at] = self.rest[parent];
            at = parent;
        }
        self.rest[at] = item;
    }

    fn take_from_rest(&mut self) -> Option<Waiting> {
        let last = self.rest.pop()?;
        let Some(&top) = self.rest.first() else { return Some(last) };
        let (mut at, count) = (0, self.rest.len());
        loop {
            let mut child = 2 * at + 1;
            if child >= count {
                break;
            }
            if child + 1 < count && Self::before(self.rest[child + 1], self.rest[child]) {
                child += 1;
            }
            if !Self::before(self.rest[child], last) {
                break;
            }
            self.rest[at] = self.rest[child];
            at = child;
        }
        self.rest[at] = last;
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
    fn a_search_for_a_near_piece_ends_at_the_nearest_of_a_few() {
        let boxes = grid(7, 9);
        let tree = Tree::new(&boxes, 7, 9, Level::PORTABLE);
        let query = [3.2, 5.4, 2.0];
        let square =
            |k: usize| (0..3).map(|c| (boxes[k].low[c] + 0.5 - query[c]).powi(2)).sum::<f64>();
        let (mut least, mut visited) = (f64::INFINITY, 0);
        tree.seek(query, |piece| {
            visited += 1;
            least = square(piece).min(least);
            least
        });
        let nearest = (0..boxes.len()).map(square).fold(f64::INFINITY, f64::min);
        assert_eq!(least, nearest);
        assert!(visited < boxes.len(), "{visited}");
    }

    #[test]
    fn a_search_for_a_near_piece_ends_though_nothing_is_near() {
        let tree = Tree::new(&grid(100, 100), 100, 100, Level::PORTABLE);
        let mut visited = 0;
        tree.seek([1e100; 3], |_| {
            visited += 1;
            f64::INFINITY
        });
        assert!((1..=8 * MOST_OPENED).contains(&visited), "{visited}");
    }

    #[test]
    fn every_piece_comes_once_and_in_order_of_distance() {
        for (rows, columns) in [(1, 1), (1, 2), (5, 1), (7, 9), (16, 16)] {
            let tree = Tree::new(&grid(rows, columns), rows, columns, Level::PORTABLE);
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
        let tree = Tree::new(&grid(8, 8), 8, 8, Level::PORTABLE);
        let mut queue = Queue::default();
        tree.start(&mut queue);
        let root = queue.pop().unwrap();
        tree.open(root, [-100.0, 0.0, 0.0], 1.0, &mut queue);
        assert_eq!(queue.pop(), None);
    }
}
