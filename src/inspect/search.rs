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

/// Boxes that are singular and narrower than this share of their piece are excluded.
const NARROW: f64 = 1.0 / 1024.0;

/// Curvature of a sphere about as large as the shape, in the index's coordinates: what gaps of small curvatures are measured by.
pub(super) const FLOOR: f64 = 0.5;

/// Halvings between two tries to prove that a box does not take a value.
const EVERY: u32 = 3;

/// Halvings up to which boxes become pieces of their own: rounding counts more the smaller a piece is.
const LOCAL: u32 = 9;

/// Tries after so many halvings that may all fail; then at least one of so many must succeed.
const TRIES: u64 = 8;

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

    /// Whether the function is proven not to be `value` anywhere on a box; none when that cannot be looked at.
    fn avoids(&mut self, _: Start, _value: f64) -> Option<bool> {
        None
    }

    /// The box as a piece of its own, on which later boxes cost less.
    fn local(&mut self, _: Start) -> Option<Start> {
        None
    }

    /// The box of the piece that a box of a piece made by [`Self::local`] stands for.
    fn origin(&self, at: Start) -> Start {
        at
    }

    /// Direction across a side on which the piece is singular and that the box touches.
    fn across(&self, _: Start) -> Option<usize> {
        None
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
    /// Tries and successes of `avoids` by depth.
    tries: [[u64; 2]; 16],
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
        let (piece, s, t) = self.field.origin((piece, [place[0]; 2], [place[1]; 2]));
        let place = [s[0], t[0]];
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
        let known = self.look(at);
        self.push(Area { at, known, depth: Some(depth) });
    }

    fn push(&mut self, area: Area) {
        self.heap.push(Waiting(self.excess(&area), area));
    }

    /// A piece: a glance at first, when that tells anything.
    fn begin(&mut self, at: Start) {
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
                Some(depth) => {
                    let mut area = area;
                    if depth > 0 && depth <= LOCAL && depth % EVERY == 0 {
                        area.at = self.field.local(area.at).unwrap_or(area.at);
                    }
                    match self.tried(area, depth) {
                        Some(area) => self.push(area),
                        None => self.halve(area, depth),
                    }
                }
            }
        }
        Ok(self.undecided.is_empty())
    }

    /// Whether rounding alone is more than the allowed gap in the middle of a small box: its parts would be no better.
    fn is_noise(&self, area: &Area, depth: u32) -> bool {
        let Interval { low, high } = area.known.middle;
        let (gap, range) = (high - low, area.known.range.high - area.known.range.low);
        let allowed = self.allowed(low.abs().min(high.abs()));
        depth >= 7 * EVERY && gap > allowed && range <= 4.0 * gap && range.is_finite()
    }

    /// As [`Self::cut_off`], when it is time to try and tries have been worth their while.
    fn tried(&mut self, area: Area, depth: u32) -> Option<Area> {
        let slot = (depth / EVERY).min(15) as usize;
        let [tries, wins] = self.tries[slot];
        if !depth.is_multiple_of(EVERY) || tries >= TRIES * (wins + 1) {
            return None;
        }
        let (area, is_tried) = self.cut_off(area);
        let is_won = self.excess(&area) <= 0.0;
        if is_tried {
            self.tries[slot] = [tries + 1, wins + u64::from(is_won)];
        }
        is_won.then_some(area)
    }

    /// The area with its range cut off at the allowed values, when they are proven not to be taken; and whether that could be
    /// looked at.
    fn cut_off(&mut self, area: Area) -> (Area, bool) {
        let (mut area, mut is_tried) = (area, false);
        let Interval { low, high } = area.known.middle;
        let above = self.greatest.value + 0.999 * self.allowed(self.greatest.value);
        let below = self.least.value - 0.999 * self.allowed(self.least.value);
        if self.side != Side::Least && area.known.range.high > above && high < above {
            let found = self.field.avoids(area.at, above);
            is_tried |= found.is_some();
            if found == Some(true) {
                area.known.range.high = above;
            }
        }
        if self.side != Side::Greatest && area.known.range.low < below && low > below {
            let found = self.field.avoids(area.at, below);
            is_tried |= found.is_some();
            if found == Some(true) {
                area.known.range.low = below;
            }
        }
        (area, is_tried)
    }

    fn halve(&mut self, area: Area, depth: u32) {
        let (piece, s, t) = area.at;
        let (_, across_s, across_t) = self.field.origin(area.at);
        let widths = [across_s[1] - across_s[0], across_t[1] - across_t[0]];
        let is_singular = area.known.range.low.is_infinite() || area.known.range.high.is_infinite();
        let across = if is_singular { self.field.across(area.at) } else { None };
        let direction = across.unwrap_or_else(|| self.direction(&area, widths));
        let narrow = |k: usize| widths[k] <= NARROW;
        let is_last = match across {
            Some(k) => narrow(k),
            None => narrow(1) && (narrow(0) || !self.has_s),
        };
        if is_singular && is_last {
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

    /// The direction in which the slope is known least.
    fn direction(&self, area: &Area, widths: [f64; 2]) -> usize {
        if !self.has_s {
            return 1;
        }
        let spread = area.known.gradient.map(|slope| slope.high - slope.low);
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

/// Runs the search over `starts` and gives the range in units of `factor`. `places` are where the extremes are thought to be.
pub(super) fn found(
    field: &mut dyn Field,
    starts: &[Start],
    places: &[Start],
    spans: &dyn Fn(usize) -> [Span; 2],
    factor: f64,
    options: &RangeOptions,
    poll: &mut dyn FnMut() -> bool,
) -> Result<Range, Error> {
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
        tries: [[0; 2]; 16],
        has_s,
    };
    for &place in places {
        search.look(place);
    }
    for &start in starts {
        search.begin(start);
    }
    let complete = search.run(options.budget, poll)?;
    let [low, high] = search.bounds();
    let place = |at: &Attained| {
        let [u, v] = spans(at.piece);
        [u.global(at.place[0]), v.global(at.place[1])]
    };
    let field = &*search.field;
    let outside = |area: &Area| {
        let (piece, s, t) = field.origin(area.at);
        let [u, v] = spans(piece);
        [u.global(s[0]), u.global(s[1]), v.global(t[0]), v.global(t[1])]
    };
    Ok(Range {
        least: [low * factor, search.least.value * factor],
        greatest: [search.greatest.value * factor, high * factor],
        at_least: place(&search.least),
        at_greatest: place(&search.greatest),
        excluded: search.excluded.iter().map(outside).collect(),
        proven: complete && search.excluded.is_empty(),
        moved: 0.0,
        boxes: search.boxes,
    })
}
