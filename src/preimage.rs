//! All parameters whose point lies within a tolerance of a point, or of a line.
//!
//! ```text
//!   box of a piece -> hull beyond the tolerance?             no answer inside: closed
//!                     hull within the tolerance?             all of it belongs to the answer
//!                     squared distance convex on it?         one connected part: its foot and an enclosure
//!                     image smaller than the tolerance?      kept as a whole
//!                     otherwise                              halve
//!   parts that touch are one member
//! ```
//!
//! For a line the distance is measured across it: everything is projected along its direction, and the same search
//! finds crossings as points, generatrices that lie in the line as arcs.
//!
//! A seam has two parameters and gives two members; a collapsed edge, a span without length, a strip without width
//! give arcs. Intervals of members are outer: they hold every parameter within the tolerance. Members come in the order of
//! u, then v, so that the canonical one of a seam is first; those of a line in the order along it.
//!
//! Reference: Sherbrooke, Patrikalakis, *Computation of the solutions of nonlinear polynomial systems*, 1993 (hull
//! tests on subdivided boxes); convexity as in `closest`.
//! Limit: a tolerance that is not small against the shape makes regions, whose rim takes many boxes.

mod walk;

mod curve;

mod surface;

mod project;

use crate::bounds::{HALF_ULP, Vector, add, dot, norm, scaled, sub};
use crate::closest::{FootPoint, QueryOptions, flag};
use crate::error::Error;
use crate::index::Frame;
use crate::set::{FootSet, Kind, Member, Nature, joined, touch};
use walk::Part;

pub use project::ProjectMemory;

/// Largest coordinate of a target, in the size of the shape, whose products cannot overflow.
const GREATEST_REACH: f64 = 1e60;

/// Boxes that one request may take by default.
pub const DEFAULT_BUDGET: u64 = 20_000;

/// A line, or the part of it from `reach[0]` to `reach[1]` along its direction; a ray has 0 and infinity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    /// A point of the line; lengths along it count from here.
    pub origin: Vector,
    /// Its direction, of any length but zero.
    pub direction: Vector,
    /// Least and greatest length along the direction.
    pub reach: [f64; 2],
}

impl Line {
    /// Checks the numbers.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] naming the entry.
    pub fn check(&self) -> Result<(), Error> {
        let refuse = |text: &str| Err(Error::InvalidArgument(text.into()));
        let far = |v: Vector| v.iter().position(|x| !x.is_finite() || x.abs() > 1e100);
        if let Some(k) = far(self.origin) {
            return refuse(&format!("origin: entry {k} is not finite or beyond 1e100"));
        }
        if let Some(k) = far(self.direction) {
            return refuse(&format!("direction: entry {k} is not finite or beyond 1e100"));
        }
        if norm(self.direction) < 1e-100 {
            return refuse("direction: shorter than 1e-100");
        }
        if self.reach[0].is_nan() || self.reach[1].is_nan() || self.reach[0] > self.reach[1] {
            return refuse("reach: entry 0 is not at most entry 1");
        }
        Ok(())
    }

    fn unit(&self) -> Vector {
        // Twice, so that a rounded length leaves no trace.
        let once = scaled(self.direction, 1.0 / norm(self.direction));
        scaled(once, 1.0 / norm(once))
    }
}

/// What is asked for: the points near a point, or near a line.
#[derive(Clone, Copy, Debug)]
enum Target {
    Point(Vector),
    Line(Line),
}

impl Target {
    /// The point of the target from which places are seen, in the caller's coordinates: the query, or the point of the
    /// line nearest to the shape's frame.
    fn base(&self, frame: &Frame) -> Vector {
        match self {
            Self::Point(point) => *point,
            Self::Line(line) => {
                let d = line.unit();
                let along = dot(sub(frame.center, line.origin), d);
                add(line.origin, scaled(d, along))
            }
        }
    }

    fn direction(&self) -> Option<Vector> {
        match self {
            Self::Point(_) => None,
            Self::Line(line) => Some(line.unit()),
        }
    }

    /// Distance of a point of the shape.
    fn distance(&self, point: Vector) -> f64 {
        match self {
            Self::Point(query) => norm(sub(point, *query)),
            Self::Line(line) => {
                let (r, d) = (sub(point, line.origin), line.unit());
                norm(sub(r, scaled(d, dot(r, d))))
            }
        }
    }

    /// Distance between two points of the shape as the target sees it.
    fn apart(&self, a: Vector, b: Vector) -> f64 {
        let r = sub(a, b);
        self.direction().map_or(norm(r), |d| norm(sub(r, scaled(d, dot(r, d)))))
    }

    /// The query, or the point from which lengths along the line count.
    fn origin(&self) -> Vector {
        match self {
            Self::Point(point) => *point,
            Self::Line(line) => line.origin,
        }
    }

    /// Length along the line; 0 for a point.
    fn along(&self, point: Vector) -> f64 {
        match self {
            Self::Point(_) => 0.0,
            Self::Line(line) => dot(sub(point, line.origin), line.unit()),
        }
    }

    fn reach(&self) -> [f64; 2] {
        match self {
            Self::Point(_) => [f64::NEG_INFINITY, f64::INFINITY],
            Self::Line(line) => line.reach,
        }
    }

    /// How far rounding of the line itself may move it near the shape.
    fn rounding(&self, frame: &Frame) -> f64 {
        match self {
            Self::Point(_) => 0.0,
            Self::Line(line) => 8.0 * HALF_ULP * norm(sub(line.origin, frame.center)),
        }
    }
}

/// A request with its lengths in the caller's unit.
struct Request {
    target: Target,
    tolerance: f64,
    /// Rounding of shape and target: the tolerance cannot mean less.
    floor: f64,
}

impl Request {
    fn new(target: Target, tolerance: f64, frame: &Frame, floor: f64) -> Self {
        let asked = if tolerance > 0.0 { tolerance } else { 1e-7 * frame.diagonal };
        let floor = floor + target.rounding(frame);
        Self { target, tolerance: asked.max(floor), floor }
    }
}

fn budget(options: &QueryOptions) -> u64 {
    if options.budget > 0 { options.budget } else { DEFAULT_BUDGET }
}

/// What the members need of a shape.
trait Place {
    /// The shape's point.
    fn point(&self, at: [f64; 2]) -> Vector;
    /// The record at a place, which keeps its parameters.
    fn record(&self, at: [f64; 2]) -> FootPoint;
    /// A better foot near a place, inside an area.
    fn refine(&self, at: [f64; 2], area: [f64; 4]) -> [f64; 2];
    /// Parameters at which pieces begin, in direction 0 (u) or 1 (v).
    fn knots(&self, k: usize) -> Vec<f64>;
    /// Which parameters vary on an area around a place without moving the point.
    fn flat(&self, at: [f64; 2], area: [f64; 4]) -> [bool; 2];
}

/// Joins parts into members, in order.
fn members(parts: &[Part], place: &impl Place, request: &Request) -> Vec<Member> {
    let areas = joined(parts.iter().map(|part| part.area).collect());
    let mut members: Vec<Member> = Vec::with_capacity(areas.len());
    for area in areas {
        let inside = parts.iter().filter(|part| touch(&part.area, &area));
        let Some(best) = inside.min_by(|a, b| a.distance.total_cmp(&b.distance)) else { continue };
        let at = best_place(best, area, place, request);
        members.push(member(at, area, place, request));
    }
    let key = |m: &Member| request.target.along(m.foot.point);
    members.sort_by(|a, b| {
        let by_place = a.foot.u.total_cmp(&b.foot.u).then(a.foot.v.total_cmp(&b.foot.v));
        key(a).total_cmp(&key(b)).then(by_place)
    });
    let [low, high] = request.target.reach();
    let slack = request.tolerance;
    members.retain(|m| key(m) >= low - slack && key(m) <= high + slack);
    members
}

/// The foot of a part; on an end of the area where that is as near.
fn best_place(best: &Part, area: [f64; 4], place: &impl Place, request: &Request) -> [f64; 2] {
    let mut at = place.refine(best.at, area);
    let distance = |at: [f64; 2]| request.target.distance(place.point(at));
    let limit = distance(at) + request.floor;
    for k in 0..4 {
        let mut end = at;
        end[k / 2] = area[k];
        let width = area[k / 2 * 2 + 1] - area[k / 2 * 2];
        let near = (at[k / 2] - area[k]).abs() <= 1e-6 * width;
        if near && distance(end) <= limit {
            at = end;
        }
    }
    at
}

fn member(at: [f64; 2], area: [f64; 4], place: &impl Place, request: &Request) -> Member {
    let flat = place.flat(at, area);
    let at = canonical(at, area, flat, place, request);
    let mut foot = place.record(at);
    foot.distance = request.target.distance(foot.point);
    if foot.distance > request.tolerance + request.floor {
        foot.flags |= flag::NOT_PROVEN;
    }
    if flat != [false; 2] && foot.flags & flag::COLLAPSED == 0 {
        foot.flags |= flag::CONTINUUM;
    }
    let kind = match flat {
        [false, false] => Kind::Point,
        [true, false] => Kind::ArcU,
        [false, true] => Kind::ArcV,
        [true, true] => Kind::Region,
    };
    let [u0, u1, v0, v1] = area;
    let nature = if flat == [false; 2] { Nature::Minimum } else { Nature::Flat };
    Member { foot, u: [u0, u1], v: [v0, v1], kind, nature }
}

/// Along an arc every place is as good but for its ends, which the tolerance moves: the first of start and knots that is as
/// near as the foot.
fn canonical(
    at: [f64; 2],
    area: [f64; 4],
    flat: [bool; 2],
    place: &impl Place,
    request: &Request,
) -> [f64; 2] {
    let mut at = at;
    let limit = request.target.distance(place.point(at)) + request.floor;
    for k in (0..2).filter(|&k| flat[k]) {
        let (low, high) = (area[2 * k], area[2 * k + 1]);
        let near = |x: f64| {
            let mut there = at;
            there[k] = x;
            request.target.distance(place.point(there)) <= limit
        };
        let knots = place.knots(k).into_iter().filter(|x| (low..=high).contains(x));
        at[k] = std::iter::once(low).chain(knots).find(|&x| near(x)).unwrap_or(at[k]);
    }
    at
}

/// A set without a single decision, for queries beyond all reach.
fn nothing_decided(range: [f64; 4]) -> FootSet {
    FootSet { members: Vec::new(), undecided: vec![range] }
}
