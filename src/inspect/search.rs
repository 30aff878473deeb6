//! Branch and bound: the least and the greatest value of a function over boxes of pieces.
//!
//! ```text
//!   boxes, the one that may exceed the known values most first
//!     -> range within the allowed gap of what was attained?     kept
//!     -> proven not to take the allowed value anywhere?         kept
//!     -> otherwise                                              halved
//! ```
//!
//! Reference: Ratschek, Rokne, *New Computer Methods for Global Optimization*, 1988.

use super::cell::Known;
use super::interval::Interval;
use super::request::{Range, RangeOptions, Side};
use crate::error::Error;
use crate::index::Span;
use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// Boxes that are singular and narrower than this share of their piece are excluded, unless the field goes on.
pub(super) const NARROW: f64 = 1.0 / 1024.0;

/// Curvature of a sphere about as large as the shape, in the index's coordinates: what gaps of small curvatures are measured by.
pub(super) const FLOOR: f64 = 0.5;

/// Halvings from which on rounding may be all that is seen.
const DEEP: u32 = 21;

/// A piece and the part of it.
pub(super) type Start = (usize, [f64; 2], [f64; 2]);

/// A function over pieces, each with parameters s and t from 0 to 1.
pub(super) trait Field {
    /// What can be said about a whole piece at little cost.
    fn glance(&mut self, _: usize) -> Option<Interval> {
        None
    }

    /// What is known on a box.
    fn on(&mut self, start: Start) -> Known;

    /// Direction across a side on which the piece is singular and that the box touches.
    fn across(&self, _: Start) -> Option<usize> {
        None
    }

    /// Singular boxes that are narrower are excluded.
    fn grain(&self, _: Start) -> [f64; 2] {
        [NARROW; 2]
    }

    /// Lengths over which the function may be thought to vary alike in both directions.
    fn lengths(&self, _: Start) -> [f64; 2] {
        [1.0; 2]
    }
}

#[derive(Clone, Copy, Debug)]
struct Area {
    at: Start,
    known: Known,
    /// Halvings since the piece; none: only glanced at.
    depth: Option<u32>,
}

/// An area with the excess it had when it was put in the heap.
struct Waiting(f64, Area);

impl PartialEq for Waiting {
    fn eq(&self, other: &Self) -> bool {
        self.0.total_cmp(&other.0) == Ordering::Equal
    }
}

impl Eq for Waiting {}

impl PartialOrd for Waiting {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Waiting {
    fn cmp(&self, other: &Self) -> Ordering {
        self.0.total_cmp(&other.0)
    }
}

/// A value that is attained somewhere.
#[derive(Clone, Copy)]
struct Attained {
    value: f64,
    piece: usize,
    place: [f64; 2],
}

struct Search<'a> {
    field: &'a mut dyn Field,
    least: Attained,
    greatest: Attained,
    heap: BinaryHeap<Waiting>,
    excluded: Vec<Area>,
    /// Boxes in which rounding hides what is asked.
    undecided: Vec<Area>,
    relative: f64,
    side: Side,
    boxes: u64,
    /// Areas that are not looked at.
    left_out: &'a [Start],
    /// Whether s is a parameter at all.
    has_s: bool,
}

impl Search<'_> {
    /// Looks at a box.
    fn look(&mut self, at: Start) -> Known {
        let (piece, s, t) = at;
        let known = self.field.on(at);
        self.boxes += 1;
        let place = [0.5 * (s[0] + s[1]), 0.5 * (t[0] + t[1])];
        if self.left_out.iter().any(|area| holds(area, piece, place)) {
            return known;
        }
        let Interval { low, high } = known.middle;
        if high < self.least.value {
            self.least = Attained { value: high, piece, place };
        }
        if low > self.greatest.value {
            self.greatest = Attained { value: low, piece, place };
        }
        known
    }

    fn add(&mut self, at: Start, depth: u32) {
        let overlap = |area: &&Start| area.0 == at.0 && overlaps([area.1, area.2], [at.1, at.2]);
        if let Some(area) = self.left_out.iter().find(overlap) {
            if within(at.1, area.1) && within(at.2, area.2) {
                return;
            }
            // Halved until it is inside or outside.
            let depth = Some(depth);
            return self.push(Area { at, known: Known::ENTIRE, depth });
        }
        let known = self.look(at);
        self.push(Area { at, known, depth: Some(depth) });
    }

    fn push(&mut self, area: Area) {
        self.heap.push(Waiting(self.excess(&area), area));
    }

    /// A piece: a glance at first, when that tells anything.
    fn begin(&mut self, at: Start) {
        if self.left_out.iter().any(|area| area.0 == at.0) {
            return self.add(at, 0);
        }
        let Some(range) = self.field.glance(at.0) else { return self.add(at, 0) };
        let entire = Interval::ENTIRE;
        let known = Known { middle: entire, range, gradient: [entire; 2] };
        self.push(Area { at, known, depth: None });
    }

    fn allowed(&self, value: f64) -> f64 {
        self.relative * value.abs().max(FLOOR)
    }

    /// By how much an area may exceed what is allowed; not positive: it is good enough.
    fn excess(&self, area: &Area) -> f64 {
        let Interval { low, high } = area.known.range;
        let above = high - self.greatest.value - self.allowed(self.greatest.value);
        let below = self.least.value - self.allowed(self.least.value) - low;
        let excess = match self.side {
            Side::Both => above.max(below),
            Side::Least => below,
            Side::Greatest => above,
        };
        if excess.is_nan() { f64::INFINITY } else { excess }
    }

    /// Whether all areas are good enough.
    fn run(&mut self, budget: u64, poll: &mut dyn FnMut() -> bool) -> Result<bool, Error> {
        while let Some(Waiting(before, area)) = self.heap.pop() {
            if self.boxes % 256 == 255 && poll() {
                return Err(Error::Cancelled);
            }
            let excess = self.excess(&area);
            if excess < before {
                // What is attained has come nearer since.
                self.heap.push(Waiting(excess, area));
                if self.heap.peek().is_some_and(|top| top.0 <= 0.0) {
                    return Ok(self.undecided.is_empty());
                }
                continue;
            }
            if excess <= 0.0 || self.boxes >= budget {
                self.heap.push(Waiting(excess, area));
                return Ok(excess <= 0.0 && self.undecided.is_empty());
            }
            match area.depth {
                None => self.add(area.at, 0),
                Some(depth) if self.is_noise(&area, depth) => self.undecided.push(area),
                Some(depth) => self.halve(area, depth),
            }
        }
        Ok(self.undecided.is_empty())
    }

    /// Whether rounding alone is more than the allowed gap in the middle of a small box: its parts would be no better.
    fn is_noise(&mut self, area: &Area, depth: u32) -> bool {
        let width = |x: Interval| x.high - x.low;
        let wide = |middle: Interval| {
            let gap = width(middle);
            gap > self.allowed(middle.low.abs().min(middle.high.abs()))
                && width(area.known.range) <= 4.0 * gap
        };
        if depth < DEEP || !width(area.known.range).is_finite() || !wide(area.known.middle) {
            return false;
        }
        // A box without extent has nothing but its rounding.
        let (piece, s, t) = area.at;
        let on = |[a, b]: [f64; 2]| [0.5 * (a + b); 2];
        let at = self.look((piece, on(s), on(t))).middle;
        let gap = width(at);
        gap > self.allowed(at.low.abs().min(at.high.abs())) && width(area.known.range) <= 4.0 * gap
    }

    fn halve(&mut self, area: Area, depth: u32) {
        let (piece, s, t) = area.at;
        let widths = [s[1] - s[0], t[1] - t[0]];
        let is_singular = area.known.range.low.is_infinite() || area.known.range.high.is_infinite();
        let across = if is_singular { self.field.across(area.at) } else { None };
        let left_out = self.sticking_out(area.at);
        let wanted = left_out.or(across);
        let direction = wanted.unwrap_or_else(|| self.direction(&area, widths));
        let grain = self.field.grain(area.at);
        let narrow = |k: usize| widths[k] <= grain[k];
        let is_last = match across {
            Some(k) => narrow(k),
            None => narrow(1) && (narrow(0) || !self.has_s),
        };
        if is_singular && is_last && left_out.is_none() {
            self.excluded.push(area);
            return;
        }
        let mut parts = [(s, t); 2];
        let side = |part: &mut ([f64; 2], [f64; 2]), end: usize| {
            let interval = if direction == 0 { &mut part.0 } else { &mut part.1 };
            interval[end] = 0.5 * (interval[0] + interval[1]);
        };
        side(&mut parts[0], 1);
        side(&mut parts[1], 0);
        for (s, t) in parts {
            self.add((piece, s, t), depth + 1);
        }
    }

    /// The direction in which a box reaches out of an area that is left out.
    fn sticking_out(&self, (piece, s, t): Start) -> Option<usize> {
        let overlap = |area: &&Start| area.0 == piece && overlaps([area.1, area.2], [s, t]);
        let area = self.left_out.iter().find(overlap)?;
        let out = |inner: [f64; 2], outer: [f64; 2]| {
            let cut = |x: f64| inner[0] < x && x < inner[1];
            if cut(outer[0]) || cut(outer[1]) { inner[1] - inner[0] } else { 0.0 }
        };
        Some(usize::from(out(t, area.2) > out(s, area.1)))
    }

    /// The direction in which the slope is known least.
    fn direction(&self, area: &Area, widths: [f64; 2]) -> usize {
        if !self.has_s {
            return 1;
        }
        let spread = area.known.gradient.map(|slope| slope.high - slope.low);
        let lengths = self.field.lengths(area.at);
        let widths = [0, 1].map(|k| widths[k] / lengths[k]);
        let wider = usize::from(widths[1] > widths[0]);
        let is_known = spread.iter().all(|x| x.is_finite()) && spread != [0.0; 2];
        if !is_known || widths[wider] > 64.0 * widths[1 - wider] {
            return wider;
        }
        usize::from(spread[1] > spread[0])
    }

    fn bounds(&self) -> [f64; 2] {
        let start = [self.least.value, self.greatest.value];
        let areas = self.heap.iter().map(|waiting| &waiting.1).chain(&self.undecided);
        areas.fold(start, |[low, high], area| {
            [low.min(area.known.range.low), high.max(area.known.range.high)]
        })
    }
}

fn within(inner: [f64; 2], outer: [f64; 2]) -> bool {
    outer[0] <= inner[0] && inner[1] <= outer[1]
}

/// Whether two boxes have more than their borders in common.
fn overlaps(a: [[f64; 2]; 2], b: [[f64; 2]; 2]) -> bool {
    (0..2).all(|k| a[k][0] < b[k][1] && b[k][0] < a[k][1])
}

/// Whether an area holds a place, its border counted where it is that of the piece.
fn holds(area: &Start, piece: usize, place: [f64; 2]) -> bool {
    let inside = |[a, b]: [f64; 2], x: f64| {
        (a < x || (a == 0.0 && x == 0.0)) && (x < b || (b == 1.0 && x == 1.0))
    };
    area.0 == piece && inside(area.1, place[0]) && inside(area.2, place[1])
}

/// What a search came to.
pub(super) struct Found {
    pub range: Range,
    /// Whether all gaps are allowed ones, outside of what is excluded.
    pub is_complete: bool,
    /// The boxes that are singular, as parts of pieces.
    pub excluded: Vec<Start>,
}

/// What a search is over.
pub(super) struct Task<'a> {
    pub starts: &'a [Start],
    /// Where the extremes are thought to be.
    pub places: &'a [Start],
    /// Areas that are not looked at.
    pub left_out: &'a [Start],
    /// The parameters of a piece.
    pub spans: &'a dyn Fn(usize) -> [Span; 2],
    /// The unit of the range.
    pub factor: f64,
}

/// Runs the search.
pub(super) fn found(
    field: &mut dyn Field,
    task: &Task,
    options: &RangeOptions,
    poll: &mut dyn FnMut() -> bool,
) -> Result<Found, Error> {
    let (spans, factor) = (task.spans, task.factor);
    let has_s = spans(0)[0].ends[0] < spans(0)[0].ends[1];
    let nowhere = |value: f64| Attained { value, piece: 0, place: [0.5; 2] };
    let mut search = Search {
        field,
        least: nowhere(f64::INFINITY),
        greatest: nowhere(f64::NEG_INFINITY),
        heap: BinaryHeap::new(),
        excluded: Vec::new(),
        undecided: Vec::new(),
        relative: options.relative,
        side: options.side,
        boxes: 0,
        left_out: task.left_out,
        has_s,
    };
    for &place in task.places {
        search.look(place);
    }
    for &start in task.starts {
        search.begin(start);
    }
    let is_complete = search.run(options.budget, poll)?;
    let [low, high] = search.bounds();
    let place = |at: &Attained| {
        let [u, v] = spans(at.piece);
        [u.global(at.place[0]), v.global(at.place[1])]
    };
    let excluded: Vec<Start> = search.excluded.iter().map(|area| area.at).collect();
    let outside = |&(piece, s, t): &Start| {
        let [u, v] = spans(piece);
        [u.global(s[0]), u.global(s[1]), v.global(t[0]), v.global(t[1])]
    };
    let range = Range {
        least: [low * factor, search.least.value * factor],
        greatest: [search.greatest.value * factor, high * factor],
        at_least: place(&search.least),
        at_greatest: place(&search.greatest),
        excluded: excluded.iter().chain(task.left_out).map(outside).collect(),
        unbounded: Vec::new(),
        rest_proven: is_complete,
        proven: is_complete && excluded.is_empty() && task.left_out.is_empty(),
        moved: 0.0,
        boxes: search.boxes,
    };
    Ok(Found { range, is_complete, excluded })
}
