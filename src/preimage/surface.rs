//! Preimages on surfaces.

use super::walk::{Memory, Part, Sheet, search};
use super::{GREATEST_REACH, Line, Place, Request, Target, budget, members, nothing_decided};
use crate::bounds::{Vector, dot, norm, scaled, sub};
use crate::closest::{FootPoint, QueryOptions, Workspace, local_interval, rounding_floor};
use crate::error::Error;
use crate::index::{IndexedSurface, SurfaceIndex, position_error, position_steps};
use crate::set::{FootSet, is_arc, is_wide};

impl IndexedSurface {
    /// All parameters whose point lies within `tolerance` (0: 1e-7 of the box diagonal) of `query`; see the module's head.
    ///
    /// Of the options `domain` and `budget` count. `poll` is asked now and then whether to stop.
    /// Cost: some ten microseconds for an isolated parameter.
    ///
    /// # Errors
    /// [`Error::Cancelled`] when `poll` said so, [`Error::OutOfMemory`].
    pub fn preimage(
        &self,
        query: Vector,
        tolerance: f64,
        options: &QueryOptions,
        poll: &mut dyn FnMut() -> bool,
    ) -> Result<FootSet, Error> {
        self.within(Target::Point(query), tolerance, options, poll)
    }

    /// All parameters whose point lies within `tolerance` of a line, in the order along it.
    ///
    /// # Errors
    /// As [`Self::preimage`]; [`Error::InvalidArgument`] for a line that is none.
    pub fn on_line(
        &self,
        line: &Line,
        tolerance: f64,
        options: &QueryOptions,
        poll: &mut dyn FnMut() -> bool,
    ) -> Result<FootSet, Error> {
        line.check()?;
        self.within(Target::Line(*line), tolerance, options, poll)
    }

    fn within(
        &self,
        target: Target,
        tolerance: f64,
        options: &QueryOptions,
        poll: &mut dyn FnMut() -> bool,
    ) -> Result<FootSet, Error> {
        let index = self.index(poll)?;
        if poll() {
            return Err(Error::Cancelled);
        }
        let range = self.restricted(options.domain);
        match Search::new(self, index, target, tolerance, range) {
            Some(search) => search.run(budget(options), poll),
            None => Ok(nothing_decided(range)),
        }
    }
}

/// One request on a surface.
pub struct Search<'a> {
    shape: &'a IndexedSurface,
    /// Its index.
    pub index: &'a SurfaceIndex,
    /// What is asked for.
    pub request: Request,
    /// The target's base point in the index's coordinates.
    base: Vector,
    /// Searched part of the domain.
    pub range: [f64; 4],
    steps: f64,
}

impl<'a> Search<'a> {
    /// Prepares a search; `None` when the target is so far away that products overflow.
    pub fn new(
        shape: &'a IndexedSurface,
        index: &'a SurfaceIndex,
        target: Target,
        tolerance: f64,
        range: [f64; 4],
    ) -> Option<Self> {
        let point = target.base(&index.frame);
        let base = index.frame.enter(point);
        let steps = position_steps(index.degree.s + index.degree.t);
        let size = norm(base);
        let worst = position_error(steps, index.rational, 2.0, size + 2.0, size);
        let floor = rounding_floor(&index.frame, point, worst);
        let request = Request::new(target, tolerance, &index.frame, floor);
        let near = base.iter().all(|x| x.abs() <= GREATEST_REACH);
        near.then_some(Self { shape, index, request, base, range, steps })
    }

    /// How far along the line the base point is from the line's origin.
    pub fn origin(&self) -> f64 {
        self.request.target.along(self.request.target.base(&self.index.frame))
    }

    fn run(&self, budget: u64, poll: &mut dyn FnMut() -> bool) -> Result<FootSet, Error> {
        let (mut budget, mut set, mut parts) = (budget, FootSet::default(), Vec::new());
        let mut memory = Memory::default();
        for (count, k) in self.near_patches().into_iter().enumerate() {
            if count % 64 == 63 && poll() {
                return Err(Error::Cancelled);
            }
            let Some(sheet) = self.sheet(k) else { continue };
            search(&sheet, &mut memory, &mut budget);
            let of = |area: [f64; 4]| self.area(k, area);
            set.undecided.extend(memory.undecided.iter().map(|area| of(*area)));
            parts.extend(memory.parts.iter().map(|part| Part {
                area: self.area(k, part.area),
                at: self.parameters(k, part.at),
                ..*part
            }));
        }
        set.members = members(&parts, self, &self.request);
        Ok(set)
    }

    /// The patches whose boxes the tolerance reaches, in the order of the walk.
    fn near_patches(&self) -> Vec<usize> {
        let reach = self.request.tolerance * self.index.frame.scale * (1.0 + 1e-9) + 1e-14;
        if let Target::Line(_) = self.request.target {
            return (0..self.index.patches.len()).filter(|&k| self.is_near_line(k)).collect();
        }
        let mut workspace = Workspace::default();
        let queue = workspace.queue();
        let slack = 1e-14 * (2.0 + norm(self.base));
        let limit = (reach + slack) * (reach + slack);
        let mut list = Vec::new();
        self.index.tree.start(queue);
        while let Some(next) = queue.pop() {
            match next.piece() {
                None => self.index.tree.open(next, self.base, limit, queue),
                Some(k) => list.push(k),
            }
        }
        list.sort_unstable();
        list
    }

    /// Whether the line may come within the tolerance of patch `k`.
    pub fn is_near_line(&self, k: usize) -> bool {
        let direction = self.request.target.direction().unwrap_or([0.0; 3]);
        let patch = &self.index.patches[k];
        let reach = self.request.tolerance * self.index.frame.scale;
        let r = sub(patch.center, self.base);
        let r = norm(sub(r, scaled(direction, dot(r, direction))));
        r <= (patch.radius + patch.spread + reach) * (1.0 + 1e-9) + 1e-12
    }

    /// Patch `k` as the walk takes it; `None` when it is outside the range.
    pub fn sheet(&self, k: usize) -> Option<Sheet<'a>> {
        let patch = &self.index.patches[k];
        let s = local_interval(patch.u, [self.range[0], self.range[1]])?;
        let t = local_interval(patch.v, [self.range[2], self.range[3]])?;
        let base = sub(self.base, patch.center);
        let scale = self.index.frame.scale;
        let rational = self.index.rational;
        let position =
            position_error(self.steps, rational, patch.radius, norm(base), norm(self.base));
        let net = self.index.net(k);
        let origin = self.origin();
        Some(Sheet {
            poles: net.poles,
            lanes: net.lanes,
            level: net.level,
            degree: net.degree,
            rational,
            base,
            direction: self.request.target.direction(),
            reach: self.request.target.reach().map(|x| (x - origin) * scale),
            range: [s[0], s[1], t[0], t[1]],
            position: position
                + patch.spread
                + self.request.target.rounding(&self.index.frame) * scale,
            tolerance: self.request.tolerance * scale,
        })
    }

    /// The caller's parameters of a place in patch `k`.
    pub fn parameters(&self, k: usize, at: [f64; 2]) -> [f64; 2] {
        let patch = &self.index.patches[k];
        [
            patch.u.global(at[0]).clamp(self.range[0], self.range[1]),
            patch.v.global(at[1]).clamp(self.range[2], self.range[3]),
        ]
    }

    /// An area in the caller's parameters, rounded outward; ends of patches come out exactly.
    pub fn area(&self, k: usize, area: [f64; 4]) -> [f64; 4] {
        let patch = &self.index.patches[k];
        let outward = |span: crate::index::Span, x: f64, up: bool| {
            let u = span.global(x);
            match (x == 0.0 || x == 1.0, up) {
                (true, _) => u,
                (false, true) => u.next_up().next_up(),
                (false, false) => u.next_down().next_down(),
            }
        };
        let r = self.range;
        [
            outward(patch.u, area[0], false).clamp(r[0], r[1]),
            outward(patch.u, area[1], true).clamp(r[0], r[1]),
            outward(patch.v, area[2], false).clamp(r[2], r[3]),
            outward(patch.v, area[3], true).clamp(r[2], r[3]),
        ]
    }
}

impl Place for Search<'_> {
    fn point(&self, at: [f64; 2]) -> Vector {
        self.shape.surface().evaluate(at[0], at[1])
    }

    fn record(&self, at: [f64; 2]) -> FootPoint {
        let Target::Point(query) = self.request.target else {
            return self.shape.foot_at(self.index, self.point(at), at, [f64::NAN; 4]);
        };
        // A range that no end equals: the parameters of a seam stay what they are.
        self.shape.foot_at(self.index, query, at, [f64::NAN; 4])
    }

    fn refine(&self, at: [f64; 2], area: [f64; 4]) -> [f64; 2] {
        let around = self.index.around(at, self.range);
        let Some(&(k, local)) = around.first() else { return at };
        let Some(sheet) = self.sheet(k) else { return at };
        let patch = &self.index.patches[k];
        let range = [
            patch.u.local(area[0]).max(sheet.range[0]),
            patch.u.local(area[1]).min(sheet.range[1]),
            patch.v.local(area[2]).max(sheet.range[2]),
            patch.v.local(area[3]).min(sheet.range[3]),
        ];
        let (found, _) = sheet.best(local, range);
        let found = self.parameters(k, found);
        [found[0].clamp(area[0], area[1]), found[1].clamp(area[2], area[3])]
    }

    fn knots(&self, k: usize) -> Vec<f64> {
        let (patches, columns) = (&self.index.patches, self.index.columns);
        if k == 0 {
            return patches.iter().step_by(columns).map(|p| p.u.ends[0]).collect();
        }
        patches[..columns].iter().map(|p| p.v.ends[0]).collect()
    }

    fn flat(&self, at: [f64; 2], area: [f64; 4]) -> [bool; 2] {
        let home = self.point(at);
        let limit = self.request.tolerance.max(64.0 * self.request.floor);
        let is_still = |k: usize| {
            let change = |x: f64| {
                let mut there = at;
                there[k] = x;
                self.request.target.apart(self.point(there), home)
            };
            let all = area[2 * k..2 * k + 2] == self.range[2 * k..2 * k + 2];
            all || is_arc([area[2 * k], area[2 * k + 1]], limit, change)
        };
        let of_u = self.index.patches.iter().step_by(self.index.columns).map(|p| p.u.ends);
        let of_v = self.index.patches[..self.index.columns].iter().map(|p| p.v.ends);
        let r = self.range;
        [
            is_wide([area[0], area[1]], [r[0], r[1]], of_u) && is_still(0),
            is_wide([area[2], area[3]], [r[2], r[3]], of_v) && is_still(1),
        ]
    }
}
