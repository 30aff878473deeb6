//! Projection along a direction: the nearest point of a shape on the line through a query.

use super::walk::{Memory, Part, search};
use super::{Line, Request, Target, budget, curve, surface};
use crate::bounds::{Vector, norm, sub};
use crate::closest::{FootPoint, GREATEST_COORDINATE, QueryOptions, Workspace, flag};
use crate::index::{IndexedCurve, IndexedSurface};

/// Reusable memory of one thread.
#[derive(Clone, Debug, Default)]
pub struct ProjectMemory {
    walk: Memory,
    closest: Workspace,
}

/// The crossing nearest to the query so far.
struct Nearest {
    /// Least length along the line that a crossing can have.
    bound: f64,
    /// Distance and place of the nearest one found; areas that are long along the line are left to `closest`.
    found: Option<(f64, [f64; 2])>,
    is_open: bool,
}

/// What the projection needs of a shape.
trait Shadow {
    fn point(&self, at: [f64; 2]) -> Vector;
    fn record(&self, at: [f64; 2]) -> FootPoint;
    /// The place nearest to the query in an area.
    fn closest_in(&self, area: [f64; 4], workspace: &mut Workspace) -> FootPoint;
}

impl Nearest {
    fn none() -> Self {
        Self { bound: f64::INFINITY, found: None, is_open: false }
    }

    /// Takes a part in, its area and place in the caller's parameters; `along` are its lengths from the query, in the
    /// caller's unit as everything here.
    fn take(
        &mut self,
        part: &Part,
        along: [f64; 2],
        request: &Request,
        shape: &impl Shadow,
        workspace: &mut Workspace,
    ) {
        self.bound = self.bound.min(along[0].max(-along[1]).max(0.0));
        let mut at = part.at;
        if along[1] - along[0] > 8.0 * request.tolerance {
            // A line that runs in the shape: its nearest point, not any one.
            let foot = shape.closest_in(part.area, workspace);
            let least = request.target.distance(shape.point(at));
            if request.target.distance(foot.point) <= least + 4.0 * request.floor {
                at = [foot.u, foot.v];
            }
        }
        let away = norm(sub(shape.point(at), request.target.origin()));
        if self.found.is_none_or(|(least, _)| away < least) {
            self.found = Some((away, at));
        }
    }

    fn foot(self, shape: &impl Shadow) -> FootPoint {
        let open = if self.is_open { flag::NOT_PROVEN | flag::BUDGET } else { 0 };
        let bound = if self.is_open { 0.0 } else { self.bound };
        let Some((_, at)) = self.found else {
            let missed = FootPoint::unreached();
            let flags = flag::NOT_ON_SHAPE | open;
            return FootPoint { distance: f64::INFINITY, lower_bound: bound, flags, ..missed };
        };
        let foot = shape.record(at);
        FootPoint {
            lower_bound: bound.min(foot.distance),
            flags: foot.flags | open,
            iterations: 0,
            ..foot
        }
    }
}

fn is_bad(query: Vector) -> bool {
    query.iter().any(|x| !x.is_finite() || x.abs() > GREATEST_COORDINATE)
}

fn line(query: Vector, direction: Vector) -> Line {
    Line { origin: query, direction, reach: [f64::NEG_INFINITY, f64::INFINITY] }
}

impl IndexedSurface {
    /// The point of the surface on the line through `query` along `direction`, to either side, that is nearest to the
    /// query; within the tolerance of the options (0: 1e-7 of the box diagonal) of the line.
    ///
    /// `lower_bound`: nothing of the surface on the line is nearer. A line that misses gives
    /// [`flag::NOT_ON_SHAPE`], no parameters and an infinite distance. Cost: as for a preimage; nothing is allocated once
    /// the memory has grown.
    pub fn project(
        &self,
        query: Vector,
        direction: Vector,
        options: &QueryOptions,
        memory: &mut ProjectMemory,
    ) -> FootPoint {
        if is_bad(query) {
            return FootPoint::bad_query();
        }
        let Ok(index) = self.index(&mut || false) else { return FootPoint::unreached() };
        let target = Target::Line(line(query, direction));
        let range = self.restricted(options.domain);
        let Some(walk) = surface::Search::new(self, index, target, options.tolerance, range) else {
            let unknown = FootPoint::unreached();
            return FootPoint { distance: f64::INFINITY, ..unknown };
        };
        let (mut nearest, mut budget) = (Nearest::none(), budget(options));
        let shadow = SurfaceShadow { shape: self, query, search: &walk, options };
        let scale = index.frame.scale;
        let origin = walk.origin();
        for k in 0..index.patches.len() {
            if !walk.is_near_line(k) {
                continue;
            }
            let Some(sheet) = walk.sheet(k) else { continue };
            search(&sheet, &mut memory.walk, &mut budget);
            nearest.is_open |= !memory.walk.undecided.is_empty();
            for part in &memory.walk.parts {
                let along = part.along.map(|x| x / scale + origin);
                let (at, _) = sheet.best(part.at, part.area);
                let part =
                    Part { area: walk.area(k, part.area), at: walk.parameters(k, at), ..*part };
                nearest.take(&part, along, &walk.request, &shadow, &mut memory.closest);
            }
        }
        nearest.foot(&shadow)
    }
}

struct SurfaceShadow<'a> {
    shape: &'a IndexedSurface,
    query: Vector,
    search: &'a surface::Search<'a>,
    options: &'a QueryOptions,
}

impl Shadow for SurfaceShadow<'_> {
    fn point(&self, at: [f64; 2]) -> Vector {
        self.shape.surface().evaluate(at[0], at[1])
    }

    fn record(&self, at: [f64; 2]) -> FootPoint {
        let search = self.search;
        let foot = self.shape.foot_at(search.index, self.query, at, search.range);
        FootPoint { distance: norm(sub(foot.point, self.query)), ..foot }
    }

    fn closest_in(&self, area: [f64; 4], workspace: &mut Workspace) -> FootPoint {
        let options = QueryOptions { domain: Some(area), ..*self.options };
        self.shape.closest(self.query, None, &options, workspace, None)
    }
}

impl IndexedCurve {
    /// The point of the curve on the line through `query` along `direction`, to either side, that is nearest to the
    /// query: as [`IndexedSurface::project`].
    pub fn project(
        &self,
        query: Vector,
        direction: Vector,
        options: &QueryOptions,
        memory: &mut ProjectMemory,
    ) -> FootPoint {
        if is_bad(query) {
            return FootPoint::bad_query();
        }
        let Ok(index) = self.index(&mut || false) else { return FootPoint::unreached() };
        let target = Target::Line(line(query, direction));
        let range = self.restricted(options.domain);
        let Some(walk) = curve::Search::new(self, index, target, options.tolerance, range) else {
            let unknown = FootPoint::unreached();
            return FootPoint { distance: f64::INFINITY, ..unknown };
        };
        let (mut nearest, mut budget) = (Nearest::none(), budget(options));
        let shadow = CurveShadow { shape: self, query, search: &walk, options };
        let scale = index.frame.scale;
        let origin = walk.origin();
        for k in 0..index.segments.len() {
            let Some(sheet) = walk.sheet(k) else { continue };
            search(&sheet, &mut memory.walk, &mut budget);
            nearest.is_open |= !memory.walk.undecided.is_empty();
            for part in &memory.walk.parts {
                let along = part.along.map(|x| x / scale + origin);
                let (at, _) = sheet.best(part.at, part.area);
                let at = [walk.parameter(k, at[1]), 0.0];
                let part = Part { area: walk.area(k, part.area), at, ..*part };
                nearest.take(&part, along, &walk.request, &shadow, &mut memory.closest);
            }
        }
        nearest.foot(&shadow)
    }
}

struct CurveShadow<'a> {
    shape: &'a IndexedCurve,
    query: Vector,
    search: &'a curve::Search<'a>,
    options: &'a QueryOptions,
}

impl Shadow for CurveShadow<'_> {
    fn point(&self, at: [f64; 2]) -> Vector {
        self.shape.curve().evaluate(at[0])
    }

    fn record(&self, at: [f64; 2]) -> FootPoint {
        self.shape.foot_at(self.search.index, self.query, at[0], self.search.range)
    }

    fn closest_in(&self, area: [f64; 4], workspace: &mut Workspace) -> FootPoint {
        let options = QueryOptions { domain: Some(area), ..*self.options };
        self.shape.closest(self.query, None, &options, workspace, None)
    }
}
