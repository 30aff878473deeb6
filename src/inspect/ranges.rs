//! Certified ranges of curvatures: the least and the greatest value over a face or a curve, each between two bounds.
//!
//! ```text
//!   elementary surfaces      closed forms                               (`carrier`)
//!   others                   climbs from samples: a good inner bound    (`climb`)
//!                            branch and bound over boxes                (`search`)
//!                              range of a box: hulls of derivatives (`glance`), cubic models (`local`)
//!   singular boxes           orders of growth: bounded by nothing?      (`growth`)
//! ```
//!
//! The inner bound of an extreme is attained (proven at the middle of a box), the outer one holds everywhere. At a collapsed edge
//! that is a smooth pole the vanishing factors are divided out; where the parametrisation is singular otherwise (tips, cusps)
//! curvatures are not bounded by any box: such boxes are excluded once they are narrow, and reported. The search is then run again
//! over the rest.
//!
//! Limit: beside a singularity the cost grows; the budget then ends the search, with honest bounds.

use super::carrier::Elementary;
use super::cell::{Bending, Known, check_degree};
use super::climb::places;
use super::crosscap::{crosscap, passes};
use super::glance::glance;
use super::growth::{Way, unbounded_along};
use super::interval::Interval;
use super::local::{Form, Local, Room, rounding};
use super::net::{ExactNet, Nets};
use super::request::{
    Quantity, Range, RangeOptions, Unbounded, areas_inside, check, collapsed_side, of_entries,
    parts_inside, patch_piece, segment_piece,
};
use super::search::{Field, NARROW, Start, Task, found};
use crate::bezier::Bidegree;
use crate::bounds::Vector;
use crate::error::Error;
use crate::index::{IndexedCurve, IndexedSurface, Span, SurfaceIndex};

/// Searches at most: each may meet singular boxes that the one before did not.
const ROUNDS: usize = 4;

/// A side is short when the patch is as wide as the side is long this near to it; then it is left alone at first.
const SHORT_SIDE: f64 = NARROW / 8.0;

/// Where nothing is proven of singular boxes, those that are left of them when they are halved on.
const DEEP_NARROW: f64 = NARROW * NARROW * NARROW;

/// Singular boxes at most that are halved on.
const MOST_DEEP: usize = 16;

/// Boxes at most before closed forms that hold up to rounding are tried.
const SHORT: u64 = 1_000;

/// Excluded areas of which the rim is looked at first.
const MOST_RIMS: usize = 64;

/// Excluded areas of a piece that are kept apart.
const MOST_AREAS: usize = 8;

/// The patches of a surface.
struct Patches<'a> {
    index: &'a SurfaceIndex,
    quantity: Quantity,
    nets: Nets<'a>,
    locals: Vec<Option<Local>>,
    /// How far patches were moved to be flat at their poles.
    moved: f64,
    room: Room,
    work: Vec<Vector>,
    /// Whether singular boxes are halved on until they are tiny.
    is_deep: bool,
}

impl Field for Patches<'_> {
    fn glance(&mut self, k: usize) -> Option<Interval> {
        glance(&patch_piece(self.index, k), &mut self.work)
            .map(|entries| of_entries(entries, self.quantity))
    }

    fn on(&mut self, (k, s, t): Start) -> Known {
        if self.locals[k].is_none() {
            let local = Local::new(&mut self.nets, self.index, k);
            self.moved = self.moved.max(local.moved);
            self.locals[k] = Some(local);
        }
        match &self.locals[k] {
            Some(local) => local.on(s, t, self.quantity, &mut self.room),
            None => Known::ENTIRE,
        }
    }

    fn across(&self, (k, s, t): Start) -> Option<usize> {
        let local = self.locals[k].as_ref().filter(|local| !local.is_smooth())?;
        let Some(side) = self.short_side(k, s, t) else {
            return collapsed_side(self.index, k, s, t);
        };
        // Where the length of the side counts it is no singular one.
        let far = [s[1], 1.0 - s[0], t[1], 1.0 - t[0]][side];
        (far > 4.0 * local.short[side]).then_some(side / 2)
    }

    fn grain(&self, (k, s, t): Start) -> [f64; 2] {
        if !self.is_deep {
            return [NARROW; 2];
        }
        let mut grain = [DEEP_NARROW; 2];
        if let Some(side) = self.short_side(k, s, t) {
            let short = self.locals[k].as_ref().map_or(1.0, |local| local.short[side]);
            grain[side / 2] = (NARROW * short).max(f64::MIN_POSITIVE);
            grain[1 - side / 2] = NARROW;
        }
        grain
    }

    fn lengths(&self, (k, s, t): Start) -> [f64; 2] {
        let mut lengths = [1.0; 2];
        if let Some(local) = &self.locals[k] {
            let far = [s[1], 1.0 - s[0], t[1], 1.0 - t[0]];
            for side in (0..4).filter(|&side| local.short[side] < SHORT_SIDE) {
                lengths[side / 2] = far[side].max(local.short[side]).min(lengths[side / 2]);
            }
        }
        lengths
    }
}

impl Patches<'_> {
    /// A side that has next to no length and that a box touches.
    fn short_side(&self, k: usize, s: [f64; 2], t: [f64; 2]) -> Option<usize> {
        let local = self.locals[k].as_ref()?;
        let touched = [s[0] == 0.0, s[1] == 1.0, t[0] == 0.0, t[1] == 1.0];
        (0..4).find(|&side| touched[side] && local.short[side] < SHORT_SIDE)
    }

    /// A proven cross-cap in an area.
    fn crosscap(&mut self, &(k, s, t): &Start) -> Option<[f64; 2]> {
        let side = self.short_side(k, s, t);
        let corner = side.map_or([0.5; 2], |side| {
            let mut corner = [0.0; 2];
            corner[side / 2] = (side % 2) as f64;
            corner
        });
        let net = self.nets.net(k, corner);
        let Bidegree { s: p, t: q } = net.degree;
        let pole = |x: f64, n: usize| (x * n as f64) as usize;
        let origin = net.point(pole(corner[0], p) * (q + 1) + pole(corner[1], q));
        let form = Form::new(&net.about(origin));
        crosscap(&form, [s, t], side.map(|side| 1 - side / 2), &mut self.room)
    }

    /// Where the quantity is proven to have no bound in an area that touches sides of its patch.
    fn unbounded(
        &mut self,
        &(k, s, t): &Start,
        spans: &dyn Fn(usize) -> [Span; 2],
    ) -> Option<Unbounded> {
        let is_smooth = self.locals[k].as_ref().is_some_and(Local::is_smooth);
        let touched = [s[0] == 0.0, s[1] == 1.0, t[0] == 0.0, t[1] == 1.0];
        let touched = touched.map(|touched| touched && !is_smooth);
        let (mut best, mut at) = ([false; 2], None);
        for side in (0..4).filter(|&side| touched[side]) {
            let is_collapsed = self.index.patches[k].collapsed[side];
            // Along the side, as it is after turning.
            let along = if side < 2 { t } else { s };
            let ends = [0.0, 1.0].map(|x| (x, along.contains(&x)));
            let inside = [0.5, 0.25, 0.75].map(|x| along[0] + x * (along[1] - along[0]));
            let inside = inside.map(|x| (x, is_collapsed));
            for (x, _) in inside.into_iter().chain(ends).filter(|place| place.1) {
                let end = (side % 2) as f64;
                let corner = x.round();
                let corner = if side < 2 { [end, corner] } else { [corner, end] };
                let (net, is_mirrored) = self.nets.net(k, corner).turned(side);
                let (net, mut moved) = if is_collapsed { net.collapsed() } else { (net, 0.0) };
                let sign = if is_mirrored { -1.0 } else { 1.0 };
                let is_corner = x == 0.0 || x == 1.0;
                let across = [Way::across(x)];
                let into = Way::into_corner(x);
                let ways = if is_corner { &into[..] } else { &across[..] };
                let along = |net: &ExactNet| unbounded_along(net, ways, self.quantity, sign);
                let mut found = along(&net);
                if found == [false; 2]
                    && is_corner
                    && !is_collapsed
                    && let Some((net, off)) = net.parallel(x, rounding(self.nets.magnitude()))
                {
                    (found, moved) = (along(&net), off);
                }
                if found != [false; 2] {
                    self.moved = self.moved.max(moved);
                    let [u, v] = spans(k);
                    let place = if side < 2 { [end, x] } else { [x, end] };
                    at = at.or(Some([u.global(place[0]), v.global(place[1])]));
                    best = [best[0] || found[0], best[1] || found[1]];
                }
            }
        }
        if at.is_none()
            && !is_smooth
            && let Some(place) = self.crosscap(&(k, s, t))
        {
            let [u, v] = spans(k);
            at = Some([u.global(place[0]), v.global(place[1])]);
            best = passes(self.quantity);
        }
        let [u, v] = spans(k);
        let domain = [u.global(s[0]), u.global(s[1]), v.global(t[0]), v.global(t[1])];
        at.map(|at| Unbounded { at, domain, falls: best[0], grows: best[1] })
    }
}

/// The range of a curvature over a surface or a part of it.
///
/// Cost: some ten microseconds a box; elementary surfaces take a box a patch, calm bicubic ones some hundred boxes. `poll` is asked
/// now and then whether to stop.
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
    check_degree(index.degree, index.rational)?;
    let starts = areas_inside(index, options.domain);
    let spans = |k: usize| [index.patches[k].u, index.patches[k].v];
    let scale = index.frame.scale;
    let factor = if quantity == Quantity::Gaussian { scale * scale } else { scale };
    let task = Task { starts: &starts, places: &[], left_out: &[], spans: &spans, factor };
    let elementary =
        |is_loose: bool| Elementary::new(index, quantity, &starts, options.relative, is_loose);
    let closed = |mut field: Elementary, poll: &mut dyn FnMut() -> bool| {
        let found = found(&mut field, &task, options, poll)?;
        // A cone's tip is not the carrier's business.
        let range = Some(found.range).filter(|range| range.proven);
        Ok::<_, Error>(range.map(|range| Range { moved: field.moved / scale, ..range }))
    };
    if let Some(field) = elementary(false)
        && let Some(range) = closed(field, poll)?
    {
        return Ok(range);
    }
    let mut field = Patches {
        index,
        quantity,
        nets: Nets::new(surface.surface(), index),
        locals: (0..index.patches.len()).map(|_| None).collect(),
        moved: 0.0,
        room: Room::default(),
        work: Vec::new(),
        is_deep: false,
    };
    let thought = places(surface.surface(), &spans, &starts, quantity, options.side);
    // Where the surface is singular, closed forms that hold up to rounding say more than a long search.
    let loose = elementary(true);
    let most = if loose.is_some() { SHORT.min(options.budget) } else { options.budget };
    let first = RangeOptions { budget: most, ..*options };
    let mut all = found(&mut field, &Task { places: &thought, ..task }, &first, poll)?;
    if let Some(loose) = loose
        && !all.range.proven
    {
        let is_bounded = all.range.least[0].is_finite() && all.range.greatest[1].is_finite();
        let is_singular = !all.excluded.is_empty() || !is_bounded;
        if is_singular && let Some(range) = closed(loose, poll)? {
            return Ok(range);
        }
        if !all.is_complete {
            all = found(&mut field, &Task { places: &thought, ..task }, options, poll)?;
        }
    }
    let (mut left_out, mut boxes) = (Vec::new(), all.range.boxes);
    let mut unbounded = Vec::new();
    // What is beside a singularity is not known before it has been met once.
    for _ in 0..ROUNDS {
        if all.excluded.is_empty() {
            break;
        }
        let mut unproven = Vec::new();
        for area in std::mem::take(&mut all.excluded) {
            match field.unbounded(&area, &spans) {
                Some(found) => {
                    unbounded.push(found);
                    left_out.push(area);
                }
                None => unproven.push(area),
            }
        }
        if !field.is_deep && unproven.len() <= MOST_DEEP {
            field.is_deep = true;
        } else {
            left_out.append(&mut unproven);
        }
        join(&mut left_out);
        let mut around = thought.clone();
        around.extend(left_out.iter().take(MOST_RIMS).flat_map(rim));
        all = found(
            &mut field,
            &Task { places: &around, left_out: &left_out, ..task },
            options,
            poll,
        )?;
        boxes += all.range.boxes;
    }
    let rest_proven = all.is_complete && all.excluded.is_empty();
    Ok(Range { moved: field.moved / scale, unbounded, boxes, rest_proven, ..all.range })
}

/// Makes one area of those of a piece that are many.
fn join(areas: &mut Vec<Start>) {
    areas.sort_by_key(|area| area.0);
    let mut joined: Vec<Start> = Vec::new();
    for group in areas.chunk_by(|a, b| a.0 == b.0) {
        if group.len() <= MOST_AREAS {
            joined.extend(group);
            continue;
        }
        let over = |a: [f64; 2], b: [f64; 2]| [a[0].min(b[0]), a[1].max(b[1])];
        let all = |all: Start, one: &Start| (all.0, over(all.1, one.1), over(all.2, one.2));
        joined.push(group.iter().fold(group[0], all));
    }
    *areas = joined;
}

/// Places around an area inside its piece.
fn rim(&(k, s, t): &Start) -> Vec<Start> {
    let mut places = Vec::new();
    for x in [0.1, 0.3, 0.5, 0.7, 0.9] {
        let on = |[a, b]: [f64; 2]| [a + x * (b - a); 2];
        for end in [0, 1] {
            if s[end] > 0.0 && s[end] < 1.0 {
                places.push((k, [s[end]; 2], on(t)));
            }
            if t[end] > 0.0 && t[end] < 1.0 {
                places.push((k, on(s), [t[end]; 2]));
            }
        }
    }
    places
}

/// The segments of a curve.
struct Segments {
    pieces: Vec<Bending>,
    work: Vec<f64>,
}

impl Field for Segments {
    fn on(&mut self, (k, _, t): Start) -> Known {
        let squared = self.pieces[k].on(t, &mut self.work);
        Known {
            middle: squared.middle.sqrt(),
            range: squared.range.sqrt(),
            gradient: squared.gradient,
        }
    }
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
    let pieces = (0..spans.len()).map(|k| Bending::new(&segment_piece(index, k))).collect();
    let mut field = Segments { pieces, work: Vec::new() };
    let nothing = Span { ends: [0.0; 2], balance: 1.0 };
    let spans_of = |k: usize| [nothing, spans[k]];
    let scale = index.frame.scale;
    let (starts, factor) = (&starts, scale);
    let task = Task { starts, places: &[], left_out: &[], spans: &spans_of, factor };
    let mut range = found(&mut field, &task, options, poll)?.range;
    // Values attained beside a cusp say nothing of the rest.
    range.rest_proven = range.proven;
    range.at_least = [range.at_least[1], 0.0];
    range.at_greatest = [range.at_greatest[1], 0.0];
    for area in &mut range.excluded {
        *area = [area[2], area[3], 0.0, 0.0];
    }
    Ok(range)
}
