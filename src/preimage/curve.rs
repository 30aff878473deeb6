//! Preimages on curves.

use super::walk::{Memory, Part, Sheet, search};
use super::{GREATEST_REACH, Line, Place, Request, Target, budget, members, nothing_decided};
use crate::bezier::Bidegree;
use crate::bounds::{Vector, dot, norm, scaled, sub};
use crate::closest::{FootPoint, QueryOptions, rounding_floor};
use crate::error::Error;
use crate::index::{CurveIndex, IndexedCurve, position_error, position_steps};
use crate::set::{FootSet, is_arc, is_wide};

impl IndexedCurve {
    /// All parameters whose point lies within `tolerance` (0: 1e-7 of the box diagonal) of `query`; see the module's head.
    ///
    /// Of the options `domain` and `budget` count. `poll` is asked now and then whether to stop.
    /// Cost: a few microseconds for an isolated parameter.
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
            None => Ok(nothing_decided([range[0], range[1], 0.0, 0.0])),
        }
    }
}

/// One request on a curve.
pub struct Search<'a> {
    shape: &'a IndexedCurve,
    /// Its index.
    pub index: &'a CurveIndex,
    /// What is asked for.
    pub request: Request,
    /// The target's base point in the index's coordinates.
    base: Vector,
    /// Searched part of the domain.
    pub range: [f64; 2],
    steps: f64,
}

impl<'a> Search<'a> {
    /// Prepares a search; `None` when the target is so far away that products overflow.
    pub fn new(
        shape: &'a IndexedCurve,
        index: &'a CurveIndex,
        target: Target,
        tolerance: f64,
        range: [f64; 2],
    ) -> Option<Self> {
        let point = target.base(&index.frame);
        let base = index.frame.enter(point);
        let steps = position_steps(index.degree());
        let size = norm(base);
        let worst = position_error(steps, index.is_rational(), 2.0, size + 2.0, size);
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
        for k in 0..self.index.segments.len() {
            if k % 256 == 255 && poll() {
                return Err(Error::Cancelled);
            }
            let Some(sheet) = self.sheet(k) else { continue };
            search(&sheet, &mut memory, &mut budget);
            set.undecided.extend(memory.undecided.iter().map(|area| self.area(k, *area)));
            parts.extend(memory.parts.iter().map(|part| Part {
                area: self.area(k, part.area),
                at: [self.parameter(k, part.at[1]), 0.0],
                ..*part
            }));
        }
        set.members = members(&parts, self, &self.request);
        Ok(set)
    }

    /// The segment as the walk takes it; `None` when it is outside the range or out of reach.
    pub fn sheet(&self, k: usize) -> Option<Sheet<'a>> {
        let segment = &self.index.segments[k];
        let range = segment.u.cover(self.range);
        let base = sub(self.base, segment.center);
        let (scale, target) = (self.index.frame.scale, &self.request.target);
        let tolerance = self.request.tolerance * scale;
        let r = target.direction().map_or(base, |d| sub(base, scaled(d, dot(base, d))));
        let away = norm(r) - (segment.radius + tolerance) * (1.0 + 1e-9) - 1e-12;
        if range[0] >= range[1] || away > 1e-13 * norm(self.base) {
            return None;
        }
        let rational = self.index.is_rational();
        let position =
            position_error(self.steps, rational, segment.radius, norm(base), norm(self.base));
        let net = self.index.net(k);
        let origin = self.origin();
        Some(Sheet {
            poles: net.poles,
            lanes: net.lanes,
            level: net.level,
            degree: Bidegree { s: 0, t: net.degree },
            rational,
            base,
            direction: target.direction(),
            reach: target.reach().map(|x| (x - origin) * scale),
            range: [0.0, 1.0, range[0], range[1]],
            position: position + target.rounding(&self.index.frame) * scale,
            tolerance,
        })
    }

    /// The caller's parameter of a place in segment `k`.
    pub fn parameter(&self, k: usize, t: f64) -> f64 {
        self.index.segments[k].u.global(t).clamp(self.range[0], self.range[1])
    }

    /// An area in the caller's parameters, rounded outward; ends of segments come out exactly.
    pub fn area(&self, k: usize, area: [f64; 4]) -> [f64; 4] {
        let span = self.index.segments[k].u;
        let exact = |x: f64| x == 0.0 || x == 1.0;
        let (low, high) = (span.global(area[2]), span.global(area[3]));
        let low = if exact(area[2]) { low } else { low.next_down().next_down() };
        let high = if exact(area[3]) { high } else { high.next_up().next_up() };
        let [first, last] = self.range;
        [low.clamp(first, last), high.clamp(first, last), 0.0, 0.0]
    }
}

impl Place for Search<'_> {
    fn point(&self, at: [f64; 2]) -> Vector {
        self.shape.curve().evaluate(at[0])
    }

    fn record(&self, at: [f64; 2]) -> FootPoint {
        // A range that no end equals: the parameter of a seam stays what it is.
        let range = [f64::NAN; 2];
        match self.request.target {
            Target::Point(query) => self.shape.foot_at(self.index, query, at[0], range),
            Target::Line(_) => self.shape.foot_at(self.index, self.point(at), at[0], range),
        }
    }

    fn refine(&self, at: [f64; 2], area: [f64; 4]) -> [f64; 2] {
        let Some(&(k, local)) = self.index.around(at[0], self.range).first() else { return at };
        let Some(sheet) = self.sheet(k) else { return at };
        let span = self.index.segments[k].u;
        let low = span.local(area[0]).max(sheet.range[2]);
        let high = span.local(area[1]).min(sheet.range[3]);
        let (found, _) = sheet.best([0.0, local], [0.0, 1.0, low, high]);
        [self.parameter(k, found[1]).clamp(area[0], area[1]), 0.0]
    }

    fn knots(&self, _: usize) -> Vec<f64> {
        self.index.segments.iter().map(|s| s.u.ends[0]).collect()
    }

    fn flat(&self, at: [f64; 2], area: [f64; 4]) -> [bool; 2] {
        let home = self.point(at);
        let change = |u: f64| self.request.target.apart(self.point([u, 0.0]), home);
        let interval = [area[0], area[1]];
        let spans = self.index.segments.iter().map(|s| s.u.ends);
        let limit = self.request.tolerance.max(64.0 * self.request.floor);
        let still = interval == self.range || is_arc(interval, limit, change);
        [is_wide(interval, self.range, spans) && still, false]
    }
}
