//! Rays against a surface: all crossings, with proof, for millions of rays.
//!
//! ```text
//!   once:  patches cut into cells that a line along their normal crosses at most once; a tree of boxes over them
//!   ray:   boxes of the tree by slabs -> cells by their linear models: none, one, or open
//!          one  -> two or three Newton steps on the patch; at the cell's rim Krawczyk's interval says in or out
//!          open -> halve; what stays open (the ray touches, or runs in the surface) goes to `on_line`
//! ```
//!
//! A crossing that is counted is shown to exist and to be the only one of its cell; a cell that is left out is shown to
//! have none. References: Toth 1985; Martin et al., *Practical ray tracing of trimmed NURBS surfaces*, 2000.
//! Limit: of two crossings nearer than the rounding one may be told.

use super::cell::{Axis, Cell, Meeting, inverse};
use crate::bezier::cut_2d;
use crate::bounds::{Aabb, HALF_ULP, Vector, add, cross, dot, norm, scaled, sub};
use crate::closest::{GREATEST_COORDINATE, QueryOptions};
use crate::error::Error;
use crate::index::{IndexedSurface, Poll, SurfaceIndex};
use crate::preimage::Line;
use crate::set::Kind;
use crate::simd::{Kernel, Lanes, Level, Simd};
use std::sync::Arc;

/// Children of a node.
const WIDTH: usize = 8;
const LEAF: u32 = 1 << 31;

/// Cells are cut until their crookedness is below this.
const CALM: f64 = 0.3;

/// Most cells, unless there are more patches.
const MOST_CELLS: usize = 1 << 19;

/// Most halvings of a patch beforehand, and of a cell for one ray.
const DEEPEST: u32 = 12;
const DEEPEST_OPEN: u32 = 40;

/// Most open cells that one ray may halve before `on_line` takes over.
const MOST_OPEN: usize = 256;

/// How far outside its cell, in the patch's unit square, a crossing may come out and still be on the cell's rim.
const RIM: f64 = 1e-11;

/// What a hit is, and a ray: bits.
pub mod ray_flag {
    /// The ray touches the surface, or the angle is too small to tell.
    pub const TANGENTIAL: u32 = 1;
    /// The hit is on a border of the domain.
    pub const EDGE: u32 = 2;
    /// The ray runs in the surface here: the first point of the piece.
    pub const OVERLAP: u32 = 4;
    /// Crossings may be missing.
    pub const NOT_PROVEN: u32 = 8;
    /// Origin or direction are not finite, too large, or zero.
    pub const BAD_RAY: u32 = 16;
}

/// A ray: the points `origin + t * direction / |direction|` with t in `reach`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Where t is 0.
    pub origin: Vector,
    /// Direction of any length but zero.
    pub direction: Vector,
    /// Least and greatest t.
    pub reach: [f64; 2],
}

/// A crossing of a ray and a surface. The layout is frozen (C API).
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Length along the ray from its origin.
    pub t: f64,
    /// First parameter, in the domain.
    pub u: f64,
    /// Second parameter, in the domain.
    pub v: f64,
    /// The surface at (u, v), the bits that its evaluation gives.
    pub point: Vector,
    /// Bits of [`ray_flag`].
    pub flags: u32,
    /// Number of hits of the ray, in the record of a ray; 1 in a list of hits.
    pub count: u32,
}

impl Hit {
    /// The record of a ray without a hit.
    pub fn none(flags: u32) -> Self {
        let nan = f64::NAN;
        Self { t: f64::INFINITY, u: nan, v: nan, point: [nan; 3], flags, count: 0 }
    }
}

#[derive(Clone, Debug)]
#[repr(align(64))]
struct Node {
    low: [[f32; WIDTH]; 3],
    high: [[f32; WIDTH]; 3],
    child: [u32; WIDTH],
}

/// A cell with its place in a patch.
#[derive(Clone, Copy, Debug)]
struct Placed {
    cell: Cell,
    patch: u32,
    depth: u32,
    area: [f64; 4],
}

/// A surface prepared for rays. Immutable; any number of threads may use it.
#[derive(Debug)]
pub struct Caster {
    shape: Arc<IndexedSurface>,
    nodes: Vec<Node>,
    cells: Vec<Placed>,
    level: Level,
}

/// Reusable memory of one thread: nothing is allocated once it has grown.
#[derive(Clone, Debug, Default)]
pub struct CastMemory {
    /// The hits of the last ray, in the order along it.
    pub hits: Vec<Hit>,
    net: Vec<f64>,
    open: Vec<Placed>,
    /// Cells halved since the last ray began.
    halved: usize,
    by_line: u64,
}

impl CastMemory {
    /// Number of rays so far that went to the search with a tolerance.
    pub fn by_line(&self) -> u64 {
        self.by_line
    }
}

/// A ray in the coordinates of the index.
struct Beam {
    axis: Axis,
    inverse: Vector,
    /// Caller's length of the origin.
    start: f64,
    reach: [f64; 2],
    slack: f64,
}

impl Caster {
    /// Cuts the surface into cells. Cost: some microseconds a cell; 4 to 64 cells a patch are usual.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`]; [`Error::Cancelled`] when `poll` said so.
    pub fn new(shape: Arc<IndexedSurface>, poll: Poll) -> Result<Self, Error> {
        let index = shape.index(poll)?;
        let level = index.grid.level;
        let (mut cells, mut boxes) = (Vec::new(), Vec::new());
        let most = (MOST_CELLS / index.patches.len().max(1)).max(1);
        let deepest = DEEPEST.min(most.ilog2());
        let mut order = Vec::with_capacity(index.patches.len());
        in_order([0, index.patches.len() / index.columns], [0, index.columns], index.columns, &mut order);
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
        Ok(Self { shape, nodes, cells, level })
    }

    /// The surface.
    pub fn shape(&self) -> &Arc<IndexedSurface> {
        &self.shape
    }

    /// Number of cells.
    pub fn cell_count(&self) -> usize {
        self.cells.len()
    }

    /// Bytes held, without the surface.
    pub fn memory(&self) -> usize {
        size_of::<Self>()
            + self.nodes.capacity() * size_of::<Node>()
            + self.cells.capacity() * size_of::<Placed>()
    }

    /// All hits of a ray, to `memory.hits`, in the order along it. Returns flags of the ray: 0 when the list is complete.
    pub fn cast(&self, ray: &Ray, memory: &mut CastMemory) -> u32 {
        memory.hits.clear();
        let Some(beam) = self.beam(ray) else { return ray_flag::BAD_RAY | ray_flag::NOT_PROVEN };
        let Ok(index) = self.shape.index(&mut || false) else { return ray_flag::NOT_PROVEN };
        memory.halved = 0;
        let mut stack = [0u32; 128];
        let mut count = 1;
        while count > 0 {
            count -= 1;
            let node = &self.nodes[stack[count] as usize];
            let near = self.level.run(Slabs { node, beam: &beam });
            for slot in 0..WIDTH {
                let child = node.child[slot];
                // The box of a child that is not there is turned inside out: slabs do not see it. The root is no child.
                if child == 0 || near[slot] < 0.0 {
                    continue;
                }
                if child & LEAF == 0 {
                    stack[count] = child;
                    count += 1;
                } else if !self.try_cell(index, (child & !LEAF) as usize, &beam, memory) {
                    return self.by_line(ray, memory);
                }
            }
        }
        self.finish(memory);
        0
    }

    /// The first hit of a ray with the number of all.
    pub fn first(&self, ray: &Ray, memory: &mut CastMemory) -> Hit {
        let flags = self.cast(ray, memory);
        match memory.hits.first() {
            Some(hit) => {
                Hit { count: memory.hits.len() as u32, flags: hit.flags | flags, ..*hit }
            }
            None => Hit::none(flags),
        }
    }

    fn beam(&self, ray: &Ray) -> Option<Beam> {
        let bad = |v: &Vector| v.iter().any(|x| !x.is_finite() || x.abs() > GREATEST_COORDINATE);
        let length = norm(ray.direction);
        let wrong = ray.reach[0].is_nan() || ray.reach[1].is_nan();
        if bad(&ray.origin) || bad(&ray.direction) || length < 1e-100 || wrong {
            return None;
        }
        let index = self.shape.index(&mut || false).ok()?;
        let once = scaled(ray.direction, 1.0 / length);
        let direction = scaled(once, 1.0 / norm(once));
        let from = index.frame.enter(ray.origin);
        let along = -dot(from, direction);
        // The point of the line nearest to the middle of the shape.
        let origin = add(from, scaled(direction, along));
        let scale = index.frame.scale;
        let start = along / scale;
        let slack = 16.0 * HALF_ULP * (4.0 + norm(from) + along.abs());
        let inverse = direction.map(|d| 1.0 / if d.abs() < 1e-30 { 1e-30f64.copysign(d) } else { d });
        let reach = ray.reach.map(|t| (t - start) * scale);
        let reach = [reach[0] - slack, reach[1] + slack];
        Some(Beam { axis: Axis::new(origin, direction), inverse, start, reach, slack })
    }

    /// Adds what a ray has in a cell; false when it stays open.
    #[inline]
    fn try_cell(
        &self,
        index: &SurfaceIndex,
        number: usize,
        beam: &Beam,
        memory: &mut CastMemory,
    ) -> bool {
        let placed = &self.cells[number];
        match self.settle(index, placed, beam, memory) {
            Some(()) => true,
            None => self.open(index, *placed, beam, memory),
        }
    }

    /// Takes a crossing, or shows that there is none; `None` when the cell must be halved.
    #[inline]
    fn settle(
        &self,
        index: &SurfaceIndex,
        placed: &Placed,
        beam: &Beam,
        memory: &mut CastMemory,
    ) -> Option<()> {
        match placed.cell.meet(&beam.axis, beam.slack) {
            Meeting::None => Some(()),
            Meeting::Open => None,
            Meeting::Once { at, deviation, is_inside } => {
                let patch = placed.patch as usize;
                let base = sub(beam.axis.origin, index.patches[patch].center);
                let [s0, s1, t0, t1] = placed.area;
                let half = [0.5 * (s1 - s0), 0.5 * (t1 - t0)];
                let middle = [0.5 * (s0 + s1), 0.5 * (t0 + t1)];
                let (inner, along, slant) =
                    newton(index, patch, base, &beam.axis, [0, 1].map(|k| middle[k] + half[k] * at[k]), half)?;
                let x = [0, 1].map(|k| (inner[k] - middle[k]) / half[k]);
                let rim = [0, 1].map(|k| 1.0 + RIM / half[k]);
                let is_on = (0..2).all(|k| x[k].abs() <= rim[k]);
                if !is_on && !is_inside {
                    let edge = x.map(|x| x.clamp(-1.0, 1.0));
                    return self.is_outside(index, placed, base, beam, edge, deviation).then_some(());
                }
                if !is_on {
                    return None;
                }
                self.take(index, patch, inner, along, slant, beam, memory);
                Some(())
            }
        }
    }

    /// Whether no zero is in the cell, seen from a place on its rim: every zero z of the cell has
    /// `|z - y + Y F(y)| <= deviation |z - y|`.
    fn is_outside(
        &self,
        index: &SurfaceIndex,
        placed: &Placed,
        base: Vector,
        beam: &Beam,
        edge: [f64; 2],
        deviation: f64,
    ) -> bool {
        let Some((y, lengths)) = inverse(&beam.axis, &placed.cell.edges) else { return false };
        let [s0, s1, t0, t1] = placed.area;
        let at = [
            0.5 * (s0 + s1) + 0.5 * (s1 - s0) * edge[0],
            0.5 * (t0 + t1) + 0.5 * (t1 - t0) * edge[1],
        ];
        let d = index.net(placed.patch as usize).vector(at[0], at[1], base);
        let f = beam.axis.across.map(|n| dot(n, d));
        let r = y.map(|row| row[0] * f[0] + row[1] * f[1]);
        let most = r[0].abs().max(r[1].abs());
        let spread = deviation * most / (1.0 - deviation) + lengths[0].max(lengths[1]) * beam.slack;
        (0..2).any(|k| {
            let z = edge[k] - r[k];
            z - spread > 1.0 || z + spread < -1.0
        })
    }

    fn take(
        &self,
        index: &SurfaceIndex,
        patch: usize,
        at: [f64; 2],
        along: f64,
        slant: f64,
        beam: &Beam,
        memory: &mut CastMemory,
    ) {
        if along < beam.reach[0] || along > beam.reach[1] {
            return;
        }
        let snapped = at.map(|x| {
            if x <= RIM {
                0.0
            } else if x >= 1.0 - RIM {
                1.0
            } else {
                x
            }
        });
        let of = &index.patches[patch];
        let (u, v) = (of.u.global(snapped[0]), of.v.global(snapped[1]));
        let surface = self.shape.surface();
        let [u0, u1, v0, v1] = surface.domain();
        let edge = if u == u0 || u == u1 || v == v0 || v == v1 { ray_flag::EDGE } else { 0 };
        let touching = if slant < 1e-9 { ray_flag::TANGENTIAL } else { 0 };
        let t = beam.start + along / index.frame.scale;
        let point = surface.evaluate(u, v);
        memory.hits.push(Hit { t, u, v, point, flags: edge | touching, count: 1 });
    }

    /// Halves a cell until it is decided.
    fn open(
        &self,
        index: &SurfaceIndex,
        placed: Placed,
        beam: &Beam,
        memory: &mut CastMemory,
    ) -> bool {
        let first = memory.open.len();
        memory.open.push(placed);
        while memory.open.len() > first {
            let Some(cell) = memory.open.pop() else { break };
            memory.halved += 1;
            if cell.depth >= DEEPEST_OPEN || memory.halved > MOST_OPEN {
                memory.open.clear();
                return false;
            }
            for area in halves(&cell.cell, cell.area) {
                let (model, _) = model(index, cell.patch as usize, area, &mut memory.net);
                let part = Placed { cell: model, area, depth: cell.depth + 1, ..cell };
                if self.settle(index, &part, beam, memory).is_none() {
                    memory.open.push(part);
                }
            }
        }
        true
    }

    /// Orders the hits; what neighbouring cells saw both is one.
    fn finish(&self, memory: &mut CastMemory) {
        if memory.hits.len() < 2 {
            return;
        }
        memory.hits.sort_unstable_by(|a, b| {
            a.t.total_cmp(&b.t).then(a.u.total_cmp(&b.u)).then(a.v.total_cmp(&b.v))
        });
        let Ok(index) = self.shape.index(&mut || false) else { return };
        let [u0, u1, v0, v1] = self.shape.surface().domain();
        let width = [u1 - u0, v1 - v0];
        let near = 1e-9 * index.frame.diagonal;
        let apart = |a: f64, b: f64, k: usize| {
            let d = (a - b).abs();
            if index.closed[k] { d.min((width[k] - d).abs()) } else { d }
        };
        let is_same = |a: &Hit, b: &Hit| {
            let together = norm(sub(a.point, b.point)) <= near;
            let collapsed = a.flags & b.flags & ray_flag::EDGE != 0 && together;
            collapsed
                || (together
                    && apart(a.u, b.u, 0) <= 1e-8 * width[0]
                    && apart(a.v, b.v, 1) <= 1e-8 * width[1])
        };
        let mut kept = 0;
        for k in 0..memory.hits.len() {
            let hit = memory.hits[k];
            let known = memory.hits[..kept].iter().rev();
            let mut known = known.take_while(|other| hit.t - other.t <= near);
            if !known.any(|other| is_same(other, &hit)) {
                memory.hits[kept] = hit;
                kept += 1;
            }
        }
        memory.hits.truncate(kept);
    }

    /// The ray as a line with a tolerance: for rays that touch the surface or run in it.
    fn by_line(&self, ray: &Ray, memory: &mut CastMemory) -> u32 {
        memory.hits.clear();
        memory.by_line += 1;
        let Ok(index) = self.shape.index(&mut || false) else { return ray_flag::NOT_PROVEN };
        let line = Line { origin: ray.origin, direction: ray.direction, reach: ray.reach };
        let tolerance = 1e-11 * index.frame.diagonal;
        let set = self.shape.on_line(&line, tolerance, &QueryOptions::default(), &mut || false);
        let Ok(set) = set else { return ray_flag::NOT_PROVEN };
        let surface = self.shape.surface();
        let unit = scaled(ray.direction, 1.0 / norm(ray.direction));
        let [u0, u1, v0, v1] = surface.domain();
        for member in &set.members {
            let foot = &member.foot;
            let mut partials = [[0.0; 3]; 3];
            surface.partials(foot.u, foot.v, 1, &mut partials);
            let normal = cross(partials[1], partials[2]);
            let slant = dot(normal, unit).abs() / norm(normal);
            let on_edge = foot.u == u0 || foot.u == u1 || foot.v == v0 || foot.v == v1;
            let mut flags = if on_edge { ray_flag::EDGE } else { 0 };
            if member.kind != Kind::Point {
                flags |= ray_flag::OVERLAP;
            }
            // Not a number on a collapsed edge: not shown to cross.
            if !(slant > 1e-5) {
                flags |= ray_flag::TANGENTIAL;
            }
            let t = dot(sub(foot.point, ray.origin), unit);
            memory.hits.push(Hit { t, u: foot.u, v: foot.v, point: foot.point, flags, count: 1 });
        }
        self.finish(memory);
        if set.is_complete() { 0 } else { ray_flag::NOT_PROVEN }
    }
}

/// The zero near a start in the patch's unit square, the length along the line there, and the sine of the angle.
#[inline]
fn newton(
    index: &SurfaceIndex,
    patch: usize,
    base: Vector,
    axis: &Axis,
    start: [f64; 2],
    half: [f64; 2],
) -> Option<([f64; 2], f64, f64)> {
    let net = index.net(patch);
    let mut x = start;
    let enough = [1e-7 * half[0], 1e-7 * half[1]];
    for _ in 0..8 {
        let jet = net.jet(x[0], x[1], base);
        let f = axis.across.map(|n| dot(n, jet.d));
        let j = axis.across.map(|n| [dot(n, jet.s), dot(n, jet.t)]);
        let det = j[0][0] * j[1][1] - j[0][1] * j[1][0];
        let step = [
            (j[0][1] * f[1] - j[1][1] * f[0]) / det,
            (j[1][0] * f[0] - j[0][0] * f[1]) / det,
        ];
        if step.iter().zip(half).any(|(d, h)| !(d.abs() <= 8.0 * h)) {
            return None;
        }
        x = [x[0] + step[0], x[1] + step[1]];
        if (0..2).all(|k| step[k].abs() <= enough[k]) {
            let d = [0, 1, 2].map(|c| jet.d[c] + step[0] * jet.s[c] + step[1] * jet.t[c]);
            let area = norm(cross(jet.s, jet.t));
            return Some((x, dot(d, axis.direction), det.abs() / area));
        }
    }
    None
}

/// The model of a part of a patch in the coordinates of the index, with its box.
fn model(index: &SurfaceIndex, patch: usize, area: [f64; 4], net: &mut Vec<f64>) -> (Cell, Aabb) {
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
fn halves(cell: &Cell, area: [f64; 4]) -> [[f64; 4]; 2] {
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
struct Slabs<'a> {
    node: &'a Node,
    beam: &'a Beam,
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
