//! Certified ranges of curvatures: the least and the greatest value over a face or a curve, each between two bounds.
//!
//! ```text
//!   boxes of all pieces, the one that may exceed the known values most first
//!     -> range within the allowed gap of what was attained?   kept
//!     -> otherwise                                            halved
//! ```
//!
//! The inner bound of an extreme is attained (proven at the middle of a box), the outer one holds everywhere. Where the
//! parametrisation is singular (collapsed edges, cusps) curvatures are not bounded by any box; such boxes are excluded once
//! they are narrow, and reported.
//!
//! Reference: Ratschek, Rokne, *New Computer Methods for Global Optimization*, 1988.
//! Limit: beside a singularity the cost grows; the budget then ends the search, with honest bounds.

use super::cell::{Bending, Forms, Known, Piece, Shape, check_degree};
use super::interval::Interval;
use crate::bezier::Bidegree;
use crate::bounds::HALF_ULP;
use crate::error::Error;
use crate::index::{CurveIndex, IndexedCurve, IndexedSurface, Span, SurfaceIndex, position_steps};
use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// What of the curvature of a surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// The greater principal curvature, 1 / length. Positive: the surface bends towards S_u x S_v.
    Greater,
    /// The less principal curvature, 1 / length.
    Less,
    /// Half their sum, 1 / length.
    Mean,
    /// Their product, 1 / area.
    Gaussian,
    /// The greatest absolute normal curvature, 1 / length: its reciprocal is the least radius of curvature.
    Sharpest,
}

/// How far to go.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RangeOptions {
    /// Only u0, u1, v0, v1; curves use the first two.
    pub domain: Option<[f64; 4]>,
    /// Allowed gap between the two bounds of an extreme, as a share of its size or of what a sphere as large as the shape has.
    pub relative: f64,
    /// Most boxes.
    pub budget: u64,
}

impl Default for RangeOptions {
    fn default() -> Self {
        Self { domain: None, relative: 1e-3, budget: 200_000 }
    }
}

/// The least and the greatest value of a quantity, each between two bounds.
#[derive(Clone, Debug, PartialEq)]
pub struct Range {
    /// Nothing is less than the first; something is not greater than the second.
    pub least: [f64; 2],
    /// Something is not less than the first; nothing is greater than the second.
    pub greatest: [f64; 2],
    /// Parameters where the inner bound of the least is attained.
    pub at_least: [f64; 2],
    /// Parameters where the inner bound of the greatest is attained.
    pub at_greatest: [f64; 2],
    /// Parameter boxes u0, u1, v0, v1 of which nothing is proven: the shape is singular there.
    pub excluded: Vec<[f64; 4]>,
    /// Whether both gaps are allowed ones and nothing is excluded.
    pub proven: bool,
    /// Boxes looked at.
    pub boxes: u64,
}

/// Boxes that are singular and narrower than this share of their piece are excluded.
const NARROW: f64 = 1.0 / 1024.0;

/// Curvature of a sphere about as large as the shape, in the index's coordinates: what gaps of small curvatures are measured by.
const FLOOR: f64 = 0.5;

#[derive(Clone, Copy, Debug)]
struct Area {
    piece: usize,
    s: [f64; 2],
    t: [f64; 2],
    known: Known,
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
    evaluate: &'a mut dyn FnMut(usize, [f64; 2], [f64; 2]) -> Known,
    /// Direction across a collapsed side that an area touches.
    across: &'a dyn Fn(&Area) -> Option<usize>,
    least: Attained,
    greatest: Attained,
    heap: BinaryHeap<Waiting>,
    excluded: Vec<Area>,
    relative: f64,
    boxes: u64,
    /// Whether s is a parameter at all.
    has_s: bool,
}

impl Search<'_> {
    fn add(&mut self, piece: usize, s: [f64; 2], t: [f64; 2]) {
        let known = (self.evaluate)(piece, s, t);
        self.boxes += 1;
        let place = [0.5 * (s[0] + s[1]), 0.5 * (t[0] + t[1])];
        let Interval { low, high } = known.middle;
        if high < self.least.value {
            self.least = Attained { value: high, piece, place };
        }
        if low > self.greatest.value {
            self.greatest = Attained { value: low, piece, place };
        }
        let area = Area { piece, s, t, known };
        self.heap.push(Waiting(self.excess(&area), area));
    }

    /// By how much an area may exceed what is allowed; not positive: it is good enough.
    fn excess(&self, area: &Area) -> f64 {
        let Interval { low, high } = area.known.range;
        let allowed = |value: f64| self.relative * value.abs().max(FLOOR);
        let above = high - self.greatest.value - allowed(self.greatest.value);
        let below = self.least.value - allowed(self.least.value) - low;
        let excess = above.max(below);
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
                    return Ok(true);
                }
                continue;
            }
            if excess <= 0.0 || self.boxes >= budget {
                self.heap.push(Waiting(excess, area));
                return Ok(excess <= 0.0);
            }
            self.halve(area);
        }
        Ok(true)
    }

    fn halve(&mut self, area: Area) {
        let widths = [area.s[1] - area.s[0], area.t[1] - area.t[0]];
        let is_singular = area.known.range.low.is_infinite() || area.known.range.high.is_infinite();
        let across = if is_singular { (self.across)(&area) } else { None };
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
        let mut parts = [(area.s, area.t); 2];
        let side = |part: &mut ([f64; 2], [f64; 2]), end: usize| {
            let interval = if direction == 0 { &mut part.0 } else { &mut part.1 };
            interval[end] = 0.5 * (interval[0] + interval[1]);
        };
        side(&mut parts[0], 1);
        side(&mut parts[1], 0);
        for (s, t) in parts {
            self.add(area.piece, s, t);
        }
    }

    /// The direction in which the slope is known least.
    fn direction(&self, area: &Area, widths: [f64; 2]) -> usize {
        if !self.has_s {
            return 1;
        }
        let spread = area.known.gradient.map(|slope| slope.high - slope.low);
        let wider = usize::from(widths[1] > widths[0]);
        if !spread.iter().all(|x| x.is_finite()) || widths[wider] > 64.0 * widths[1 - wider] {
            return wider;
        }
        usize::from(spread[1] > spread[0])
    }

    fn bounds(&self) -> [f64; 2] {
        let start = [self.least.value, self.greatest.value];
        self.heap.iter().fold(start, |[low, high], Waiting(_, area)| {
            [low.min(area.known.range.low), high.max(area.known.range.high)]
        })
    }
}

/// Runs the search over `starts` and gives the range in units of `factor`.
fn found(
    starts: &[(usize, [f64; 2], [f64; 2])],
    evaluate: &mut dyn FnMut(usize, [f64; 2], [f64; 2]) -> Known,
    across: &dyn Fn(&Area) -> Option<usize>,
    spans: &dyn Fn(usize) -> [Span; 2],
    factor: f64,
    options: &RangeOptions,
    poll: &mut dyn FnMut() -> bool,
) -> Result<Range, Error> {
    let has_s = spans(0)[0].ends[0] < spans(0)[0].ends[1];
    let nowhere = |value: f64| Attained { value, piece: 0, place: [0.5; 2] };
    let mut search = Search {
        evaluate,
        across,
        least: nowhere(f64::INFINITY),
        greatest: nowhere(f64::NEG_INFINITY),
        heap: BinaryHeap::new(),
        excluded: Vec::new(),
        relative: options.relative,
        boxes: 0,
        has_s,
    };
    for &(piece, s, t) in starts {
        search.add(piece, s, t);
    }
    let complete = search.run(options.budget, poll)?;
    let [low, high] = search.bounds();
    let place = |at: &Attained| {
        let [u, v] = spans(at.piece);
        [u.global(at.place[0]), v.global(at.place[1])]
    };
    let outside = |area: &Area| {
        let [u, v] = spans(area.piece);
        [u.global(area.s[0]), u.global(area.s[1]), v.global(area.t[0]), v.global(area.t[1])]
    };
    Ok(Range {
        least: [low * factor, search.least.value * factor],
        greatest: [search.greatest.value * factor, high * factor],
        at_least: place(&search.least),
        at_greatest: place(&search.greatest),
        excluded: search.excluded.iter().map(outside).collect(),
        proven: complete && search.excluded.is_empty(),
        boxes: search.boxes,
    })
}

/// A patch of an index with its rounding.
pub(super) fn patch_piece(index: &SurfaceIndex, k: usize) -> Piece<'_> {
    let (net, patch) = (index.net(k), &index.patches[k]);
    piece(net.poles, net.degree, net.rational, patch.radius, patch.spread)
}

/// A segment of an index with its rounding.
pub(super) fn segment_piece(index: &CurveIndex, k: usize) -> Piece<'_> {
    let net = index.net(k);
    let degree = Bidegree { s: 0, t: net.degree };
    piece(net.poles, degree, net.rational, index.segments[k].radius, 0.0)
}

fn piece(poles: &[f64], degree: Bidegree, rational: bool, radius: f64, spread: f64) -> Piece<'_> {
    let steps = position_steps(degree.s + degree.t);
    // The frame rounds coordinates up to 2 once, the piece's own centre once more.
    let error = steps * radius + 32.0 * HALF_ULP + spread;
    Piece { poles, degree, rational, error, steps }
}

/// The part of each piece inside the domain.
pub(super) fn parts_inside(spans: &[Span], range: Option<[f64; 2]>) -> Vec<Option<[f64; 2]>> {
    let part = |span: &Span| {
        let [a, b] = range.map_or([0.0, 1.0], |range| span.cover(range));
        (a < b).then_some([a, b])
    };
    spans.iter().map(part).collect()
}

/// Refuses options that make no sense.
pub(super) fn check(options: &RangeOptions, bounds: &[[f64; 2]]) -> Result<(), Error> {
    if !(options.relative > 0.0 && options.relative <= 1.0) {
        let text = format!("relative: {} is not between 0 and 1", options.relative);
        return Err(Error::InvalidArgument(text));
    }
    let Some(domain) = options.domain else { return Ok(()) };
    for (k, bounds) in bounds.iter().enumerate() {
        let range = [domain[2 * k], domain[2 * k + 1]];
        for (i, x) in range.into_iter().enumerate() {
            if !(bounds[0]..=bounds[1]).contains(&x) {
                let [low, high] = bounds;
                let text = format!("domain: entry {} = {x} is outside [{low}, {high}]", 2 * k + i);
                return Err(Error::InvalidArgument(text));
            }
        }
        if range[0] >= range[1] {
            let text = format!("domain: entry {} is not less than entry {}", 2 * k, 2 * k + 1);
            return Err(Error::InvalidArgument(text));
        }
    }
    Ok(())
}

fn known(shape: &Shape, quantity: Quantity) -> Known {
    match quantity {
        Quantity::Mean => shape.mean().into(),
        Quantity::Gaussian => shape.gaussian().into(),
        Quantity::Greater => shape.principal()[0],
        Quantity::Less => shape.principal()[1],
        Quantity::Sharpest => {
            let [greater, less] = shape.principal();
            let sharper = |a: Interval, b: Interval| Interval {
                low: a.least_magnitude().max(b.least_magnitude()),
                high: a.magnitude().max(b.magnitude()),
            };
            // Both sides' slopes count; for the choice of the halving the wider one will do.
            let gradient = [0, 1].map(|k| greater.gradient[k].or(less.gradient[k]));
            Known {
                middle: sharper(greater.middle, less.middle),
                range: sharper(greater.range, less.range),
                gradient,
            }
        }
    }
}

/// Whether a box is about a quarter of its patch: small enough for weights to be alike, large enough to be worth long
/// products.
fn is_quarter(s: [f64; 2], t: [f64; 2]) -> bool {
    let widths = [s[1] - s[0], t[1] - t[0]];
    widths[0].max(widths[1]) == 0.5 && widths[0].min(widths[1]) >= 0.125
}

/// Whether the quantity is the same in the middle of a box and around it, within the allowed gap.
fn is_nearly_constant(
    forms: &Forms,
    [s, t]: [[f64; 2]; 2],
    quantity: Quantity,
    relative: f64,
    work: &mut Vec<f64>,
) -> bool {
    let place = |range: [f64; 2], x: f64| [range[0] + x * (range[1] - range[0]); 2];
    let mut at =
        |x: f64, y: f64| known(&forms.on(place(s, x), place(t, y), work), quantity).middle.middle();
    let middle = at(0.5, 0.5);
    let allowed = relative * middle.abs().max(FLOOR);
    let places = [[0.1, 0.2], [0.9, 0.8], [0.2, 0.9], [0.8, 0.1]];
    places.into_iter().all(|[x, y]| (at(x, y) - middle).abs() <= allowed)
}

/// The range of a curvature over a surface or a part of it.
///
/// Cost: a few microseconds a box; a bicubic face with the default gap takes some thousand boxes. `poll` is asked now and
/// then whether to stop.
///
/// # Errors
/// A domain outside that of the surface, a gap that is none; [`Error::Cancelled`]; memory that could not be had.
pub fn surface_range(
    surface: &IndexedSurface,
    quantity: Quantity,
    options: &RangeOptions,
    poll: &mut dyn FnMut() -> bool,
) -> Result<Range, Error> {
    let [u0, u1, v0, v1] = surface.surface().domain();
    check(options, &[[u0, u1], [v0, v1]])?;
    let index = surface.index(poll)?;
    let starts = areas_inside(index, options.domain);
    check_degree(index.degree, index.rational)?;
    let mut forms: Vec<Option<Forms>> = (0..index.patches.len()).map(|_| None).collect();
    let mut work = Vec::new();
    let (relative, mut net) = (options.relative, Vec::new());
    let mut evaluate = |k: usize, s: [f64; 2], t: [f64; 2]| {
        let forms = forms[k].get_or_insert_with(|| Forms::new(&patch_piece(index, k)));
        let plain = known(&forms.on(s, t, &mut work), quantity);
        if !is_quarter(s, t) || !is_nearly_constant(forms, [s, t], quantity, relative, &mut work) {
            return plain;
        }
        let part = patch_piece(index, k).part(s, t, &mut net);
        let sharp = Forms::new(&part).as_constant(&mut work).map(|shape| known(&shape, quantity));
        sharp.map_or(plain, |sharp| Known { range: plain.range.and(sharp.range), ..plain })
    };
    let across = |area: &Area| {
        let touched = [area.s[0] == 0.0, area.s[1] == 1.0, area.t[0] == 0.0, area.t[1] == 1.0];
        let collapsed = index.patches[area.piece].collapsed;
        (0..4).find(|&side| touched[side] && collapsed[side]).map(|side| side / 2)
    };
    let spans = |k: usize| [index.patches[k].u, index.patches[k].v];
    let scale = index.frame.scale;
    let factor = if quantity == Quantity::Gaussian { scale * scale } else { scale };
    found(&starts, &mut evaluate, &across, &spans, factor, options, poll)
}

/// The parts of all patches inside a domain.
pub(super) fn areas_inside(
    index: &SurfaceIndex,
    domain: Option<[f64; 4]>,
) -> Vec<(usize, [f64; 2], [f64; 2])> {
    let column = |k: usize| index.patches[k].v;
    let columns: Vec<Span> = (0..index.columns).map(column).collect();
    let rows: Vec<Span> = index.patches.iter().step_by(index.columns).map(|p| p.u).collect();
    let along_u = parts_inside(&rows, domain.map(|d| [d[0], d[1]]));
    let along_v = parts_inside(&columns, domain.map(|d| [d[2], d[3]]));
    let mut areas = Vec::new();
    for (a, s) in along_u.iter().enumerate() {
        for (b, t) in along_v.iter().enumerate() {
            if let (Some(s), Some(t)) = (s, t) {
                areas.push((a * index.columns + b, *s, *t));
            }
        }
    }
    areas
}

/// The range of the curvature of a curve or a part of it, 1 / length; never negative.
///
/// # Errors
/// As [`surface_range`].
pub fn curve_range(
    curve: &IndexedCurve,
    options: &RangeOptions,
    poll: &mut dyn FnMut() -> bool,
) -> Result<Range, Error> {
    let (start, end) = curve.curve().domain();
    check(options, &[[start, end]])?;
    let index = curve.index(poll)?;
    check_degree(Bidegree { s: 0, t: curve.curve().degree() }, true)?;
    let spans: Vec<Span> = index.segments.iter().map(|segment| segment.u).collect();
    let parts = parts_inside(&spans, options.domain.map(|d| [d[0], d[1]]));
    let starts: Vec<_> =
        (0..spans.len()).filter_map(|k| parts[k].map(|t| (k, [0.0, 1.0], t))).collect();
    let pieces: Vec<Bending> =
        (0..spans.len()).map(|k| Bending::new(&segment_piece(index, k))).collect();
    let mut work = Vec::new();
    let mut evaluate = |k: usize, _: [f64; 2], t: [f64; 2]| {
        let squared = pieces[k].on(t, &mut work);
        Known {
            middle: squared.middle.sqrt(),
            range: squared.range.sqrt(),
            gradient: squared.gradient,
        }
    };
    let nothing = Span { ends: [0.0; 2], balance: 1.0 };
    let spans_of = |k: usize| [nothing, spans[k]];
    let scale = index.frame.scale;
    let mut range = found(&starts, &mut evaluate, &|_| None, &spans_of, scale, options, poll)?;
    range.at_least = [range.at_least[1], 0.0];
    range.at_greatest = [range.at_greatest[1], 0.0];
    for area in &mut range.excluded {
        *area = [area[2], area[3], 0.0, 0.0];
    }
    Ok(range)
}
