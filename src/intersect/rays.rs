//! Rays against a surface: all crossings, with proof, for millions of rays.
//!
//! ```text
//!   once:  patches cut into cells that a line along their normal crosses at most once; a tree of boxes over them
//!   ray:   boxes of the tree by slabs, eight at a time -> linear models of cells, eight at a time -> `cast`: one by one
//!          what stays open (the ray touches, or runs in the surface) goes to `on_line`
//! ```
//!
//! A crossing that is counted is shown to exist and to be the only one of its cell; a cell that is left out is shown to
//! have none. References: Toth 1985; Martin et al., *Practical ray tracing of trimmed NURBS surfaces*, 2000.
//! Limit: of two crossings nearer than the rounding one may be told.

use super::cast::{Root, Search};
use super::cell::Axis;
use super::cells::{Beam, Candidate, Cells, Walk, cells_of};
use crate::batch::{self, Memory, Record};
use crate::bounds::{HALF_ULP, Vector, add, cross, dot, norm, scaled, sub};
use crate::closest::{GREATEST_COORDINATE, QueryOptions};
use crate::error::Error;
use crate::index::{IndexedSurface, Poll, SurfaceIndex};
use crate::preimage::{DEFAULT_BUDGET, Line};
use crate::set::Kind;
use crate::simd::Level;
use std::sync::Arc;

/// Multiplications that the search with a tolerance may take for a ray, about: a tenth of a second. What is left open then is not proven.
const MOST_BY_LINE: u64 = 1 << 27;

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
    /// Whether the caller said stop: rays not reached, and those of which the first hit alone is known, are not proven.
    pub stopped: bool,
}

/// A surface prepared for rays. Immutable; any number of threads may use it.
#[derive(Debug)]
pub struct Caster {
    shape: Arc<IndexedSurface>,
    cells: Cells,
    level: Level,
}

/// Reusable memory of one thread: nothing is allocated once it has grown.
#[derive(Clone, Debug, Default)]
pub struct CastMemory {
    /// The hits of the last ray, in the order along it.
    pub hits: Vec<Hit>,
    candidates: Vec<Candidate>,
    /// Candidates by their least length along the ray.
    order: Vec<(f64, u32)>,
    parts: Vec<[f64; 4]>,
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
        let level = index.level;
        let cells = cells_of(index, poll)?;
        Ok(Self { shape, cells, level })
    }

    /// The surface.
    pub fn shape(&self) -> &Arc<IndexedSurface> {
        &self.shape
    }

    /// Number of cells.
    pub fn cell_count(&self) -> usize {
        self.cells.count()
    }

    /// Bytes held, without the surface.
    pub fn memory(&self) -> usize {
        size_of::<Self>() + self.cells.memory()
    }

    /// All hits of a ray, to `memory.hits`, in the order along it. Returns flags of the ray: 0 when the list is complete.
    pub fn cast(&self, ray: &Ray, memory: &mut CastMemory) -> u32 {
        let Some((index, beam)) = self.candidates(ray, memory) else {
            return ray_flag::BAD_RAY | ray_flag::NOT_PROVEN;
        };
        let CastMemory { hits, candidates, parts, .. } = memory;
        let search = Search { index, cells: &self.cells, beam: &beam };
        let mut take = |root: Root| hits.extend(self.hit(index, &beam, root));
        for candidate in candidates {
            if !search.cell(candidate, parts, &mut take) {
                return self.by_line(ray, memory);
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

    /// The first hit of a ray alone: cells behind it are not looked at. Its `count` is 1, or 0 for none.
    pub fn nearest(&self, ray: &Ray, memory: &mut CastMemory) -> Hit {
        let Some((index, beam)) = self.candidates(ray, memory) else {
            return Hit::none(ray_flag::BAD_RAY | ray_flag::NOT_PROVEN);
        };
        let CastMemory { hits, candidates, order, parts, .. } = memory;
        order.clear();
        let least = |c: &Candidate| self.cells.least_along(c.cell, &beam.axis) - beam.slack;
        order.extend(candidates.iter().enumerate().map(|(k, c)| (least(c), k as u32)));
        order.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let search = Search { index, cells: &self.cells, beam: &beam };
        let mut reached = f64::INFINITY;
        let mut take = |root: Root| {
            // What is as near may be the same place, seen from beyond a seam.
            if root.along <= reached + beam.slack
                && let Some(hit) = self.hit(index, &beam, root)
            {
                reached = reached.min(root.along);
                hits.push(hit);
            }
            reached
        };
        let mut end = f64::INFINITY;
        for &(least, k) in &*order {
            if least > end {
                break;
            }
            let mut tell = |root: Root| end = take(root);
            if !search.cell(&candidates[k as usize], parts, &mut tell) {
                let flags = self.by_line(ray, memory);
                let hit = memory.hits.first().copied();
                return hit.map_or(Hit::none(flags), |hit| Hit { flags: hit.flags | flags, ..hit });
            }
        }
        self.finish(memory);
        memory.hits.first().map_or(Hit::none(0), |hit| Hit { count: 1, ..*hit })
    }

    /// The cells that a ray may meet, to `memory`.
    fn candidates(&self, ray: &Ray, memory: &mut CastMemory) -> Option<(&SurfaceIndex, Beam)> {
        memory.hits.clear();
        memory.candidates.clear();
        let index = self.shape.index(&mut || false).ok()?;
        let beam = beam(index, ray)?;
        self.level.run(Walk { cells: &self.cells, beam: &beam, out: &mut memory.candidates });
        Some((index, beam))
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

    /// The first hits alone of many rays: as [`Self::first_hits`] without what lies behind.
    ///
    /// # Errors
    /// As [`batch::run`].
    pub fn nearest_hits(
        &self,
        rays: &(dyn Fn(usize) -> Ray + Sync),
        out: &mut [Hit],
        threads: usize,
        poll: batch::Poll,
    ) -> Result<(), Error> {
        let work = |k: usize, memory: &mut CastMemory| self.nearest(&rays(k), memory);
        batch::run(out, threads, None, &work, poll)
    }

    /// All hits of many rays: those with more than one are cast a second time. When `poll` says stop the answer is what was found so far
    /// ([`RayHits::stopped`]).
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
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
        let mut stopped = match self.first_hits(rays, &mut first, threads, poll) {
            Err(Error::Cancelled) => true,
            done => {
                done?;
                false
            }
        };
        let total: usize = first.iter().map(|hit| hit.count as usize).sum();
        let mut all = RayHits::default();
        let reserve = |list: &mut Vec<usize>| list.try_reserve_exact(count + 1);
        reserve(&mut all.starts).map_err(|_| Error::OutOfMemory)?;
        all.hits.try_reserve_exact(total).map_err(|_| Error::OutOfMemory)?;
        all.flags.try_reserve_exact(count).map_err(|_| Error::OutOfMemory)?;
        let (mut memory, mut again) = (CastMemory::default(), 0usize);
        for (k, hit) in first.iter().enumerate() {
            all.starts.push(all.hits.len());
            if hit.count > 1 {
                stopped = stopped || again.is_multiple_of(batch::GROUP) && poll(count);
                again += 1;
            }
            if hit.count > 1 && stopped {
                all.flags.push(hit.flags & ray_flag::BAD_RAY | ray_flag::NOT_PROVEN);
                all.hits.push(Hit { flags: hit.flags & !ray_flag::NOT_PROVEN, count: 1, ..*hit });
                continue;
            }
            if hit.count > 1 {
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
        all.stopped = stopped;
        Ok(all)
    }

    /// The hit of a crossing, when the ray reaches it.
    fn hit(&self, index: &SurfaceIndex, beam: &Beam, root: Root) -> Option<Hit> {
        if root.along < beam.reach[0] || root.along > beam.reach[1] {
            return None;
        }
        let snapped = [0, 1].map(|k| {
            let (x, rim) = (root.at[k], root.rim[k]);
            if x <= rim {
                0.0
            } else if x >= 1.0 - rim {
                1.0
            } else {
                x
            }
        });
        let of = &index.patches[root.patch];
        let (u, v) = (of.u.global(snapped[0]), of.v.global(snapped[1]));
        let surface = self.shape.surface();
        let [u0, u1, v0, v1] = surface.domain();
        let edge = if u == u0 || u == u1 || v == v0 || v == v1 { ray_flag::EDGE } else { 0 };
        let touching = if root.slant < 1e-9 { ray_flag::TANGENTIAL } else { 0 };
        let t = beam.start + root.along / index.frame.scale;
        let point = surface.evaluate(u, v);
        Some(Hit { t, u, v, point, flags: edge | touching, count: 1 })
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
        // A box takes products of nets.
        let budget =
            (MOST_BY_LINE / (index.degree.count() as u64).pow(2)).clamp(64, DEFAULT_BUDGET);
        let options = QueryOptions { budget, ..QueryOptions::default() };
        let set = self.shape.on_line(&line, tolerance, &options, &mut || false);
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

/// A ray in the coordinates of the index; `None` for a bad one.
fn beam(index: &SurfaceIndex, ray: &Ray) -> Option<Beam> {
    let bad = |v: &Vector| v.iter().any(|x| !x.is_finite() || x.abs() > GREATEST_COORDINATE);
    let length = norm(ray.direction);
    let wrong = ray.reach[0].is_nan() || ray.reach[1].is_nan();
    if bad(&ray.origin) || bad(&ray.direction) || length < 1e-100 || wrong {
        return None;
    }
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
