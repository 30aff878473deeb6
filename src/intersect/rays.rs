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

use super::cell::{Axis, Meeting, inverse};
use super::cells::{Beam, LEAF, Node, Placed, Slabs, WIDTH, cells_of, halves, model};
use crate::batch::{self, Memory, Record};
use crate::bounds::{HALF_ULP, Vector, add, cross, dot, norm, scaled, sub};
use crate::closest::{GREATEST_COORDINATE, QueryOptions};
use crate::error::Error;
use crate::index::{IndexedSurface, Poll, SurfaceIndex};
use crate::preimage::Line;
use crate::set::Kind;
use crate::simd::Level;
use std::sync::Arc;

/// Most halvings of a cell for one ray.
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

impl Record for Hit {
    fn unreached() -> Self {
        Self { t: f64::NAN, ..Self::none(ray_flag::NOT_PROVEN) }
    }
}

impl Memory for CastMemory {}

/// The hits of many rays.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RayHits {
    /// The hits of ray k are those from `starts[k]` to `starts[k + 1]`.
    pub starts: Vec<usize>,
    /// All hits, ray by ray, in the order along each.
    pub hits: Vec<Hit>,
    /// Flags of each ray.
    pub flags: Vec<u32>,
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

impl Caster {
    /// Cuts the surface into cells. Cost: some microseconds a cell; 4 to 64 cells a patch are usual.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`]; [`Error::Cancelled`] when `poll` said so.
    pub fn new(shape: Arc<IndexedSurface>, poll: Poll) -> Result<Self, Error> {
        let index = shape.index(poll)?;
        let level = index.grid.level;
        let (nodes, cells) = cells_of(index, poll)?;
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
            Some(hit) => Hit { count: memory.hits.len() as u32, flags: hit.flags | flags, ..*hit },
            None => Hit::none(flags),
        }
    }

    /// The first hits of many rays, with the number of all, over `threads` threads (0: all cores). The same bits for any number
    /// of threads; nothing is allocated for a ray.
    ///
    /// # Errors
    /// As [`batch::run`].
    pub fn first_hits(
        &self,
        rays: &(dyn Fn(usize) -> Ray + Sync),
        out: &mut [Hit],
        threads: usize,
        poll: batch::Poll,
    ) -> Result<(), Error> {
        let work = |k: usize, memory: &mut CastMemory| self.first(&rays(k), memory);
        batch::run(out, threads, None, &work, poll)
    }

    /// All hits of many rays: those with more than one are cast a second time.
    ///
    /// # Errors
    /// As [`batch::run`]; when cancelled nothing is handed over.
    pub fn all_hits(
        &self,
        rays: &(dyn Fn(usize) -> Ray + Sync),
        count: usize,
        threads: usize,
        poll: batch::Poll,
    ) -> Result<RayHits, Error> {
        let mut first: Vec<Hit> = Vec::new();
        first.try_reserve_exact(count).map_err(|_| Error::OutOfMemory)?;
        first.resize(count, Hit::unreached());
        self.first_hits(rays, &mut first, threads, poll)?;
        let total: usize = first.iter().map(|hit| hit.count as usize).sum();
        let mut all = RayHits::default();
        let reserve = |list: &mut Vec<usize>| list.try_reserve_exact(count + 1);
        reserve(&mut all.starts).map_err(|_| Error::OutOfMemory)?;
        all.hits.try_reserve_exact(total).map_err(|_| Error::OutOfMemory)?;
        all.flags.try_reserve_exact(count).map_err(|_| Error::OutOfMemory)?;
        let mut memory = CastMemory::default();
        for (k, hit) in first.iter().enumerate() {
            all.starts.push(all.hits.len());
            if hit.count > 1 {
                if k % batch::GROUP == 0 && poll(count) {
                    return Err(Error::Cancelled);
                }
                all.flags.push(self.cast(&rays(k), &mut memory));
                all.hits.extend_from_slice(&memory.hits);
                continue;
            }
            let of_ray = ray_flag::NOT_PROVEN | ray_flag::BAD_RAY;
            all.flags.push(hit.flags & of_ray);
            if hit.count == 1 {
                all.hits.push(Hit { flags: hit.flags & !of_ray, ..*hit });
            }
        }
        all.starts.push(all.hits.len());
        Ok(all)
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
        let inverse =
            direction.map(|d| 1.0 / if d.abs() < 1e-30 { 1e-30f64.copysign(d) } else { d });
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
                // Most of those that come out beside the cell are shown to with one value.
                if !is_inside && at.iter().any(|x| x.abs() > 1.0) {
                    let edge = at.map(|x| x.clamp(-1.0, 1.0));
                    if self.is_outside(index, placed, base, beam, edge, deviation) {
                        return Some(());
                    }
                }
                let (inner, along, slant) = newton(
                    index,
                    patch,
                    base,
                    &beam.axis,
                    [0, 1].map(|k| middle[k] + half[k] * at[k]),
                    half,
                )?;
                let x = [0, 1].map(|k| (inner[k] - middle[k]) / half[k]);
                let rim = [0, 1].map(|k| 1.0 + RIM / half[k]);
                let is_on = (0..2).all(|k| x[k].abs() <= rim[k]);
                if !is_on && !is_inside {
                    let edge = x.map(|x| x.clamp(-1.0, 1.0));
                    return self
                        .is_outside(index, placed, base, beam, edge, deviation)
                        .then_some(());
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
            if slant.is_nan() || slant <= 1e-5 {
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
        let step =
            [(j[0][1] * f[1] - j[1][1] * f[0]) / det, (j[1][0] * f[0] - j[0][0] * f[1]) / det];
        if step.iter().zip(half).any(|(d, h)| d.is_nan() || d.abs() > 8.0 * h) {
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
