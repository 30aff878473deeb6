//! Certified ranges of curvatures: the least and the greatest value over a face or a curve, each between two bounds.
//!
//! ```text
//!   elementary surfaces      closed forms                               (`carrier`)
//!   others                   climbs from samples: a good inner bound    (`climb`)
//!                            branch and bound over boxes                (`search`)
//!                              range of a box: hulls of derivatives (`glance`), slopes (`cell`),
//!                              sign of one polynomial (`level`)
//! ```
//!
//! The inner bound of an extreme is attained (proven at the middle of a box), the outer one holds everywhere. At a collapsed edge
//! that is a smooth pole the vanishing factors are divided out; where the parametrisation is singular otherwise (tips, cusps)
//! curvatures are not bounded by any box: such boxes are excluded once they are narrow, and reported.
//!
//! Limit: beside a singularity the cost grows; the budget then ends the search, with honest bounds.

use super::carrier::Elementary;
use super::cell::{Bending, Known, check_degree};
use super::climb::places;
use super::glance::glance;
use super::interval::Interval;
use super::local::{Local, Room};
use super::net::Nets;
use super::request::{
    Quantity, Range, RangeOptions, areas_inside, check, collapsed_side, known, parts_inside,
    patch_piece, segment_piece,
};
use super::search::{Field, Start, found};
use crate::bezier::Bidegree;
use crate::error::Error;
use crate::index::{IndexedCurve, IndexedSurface, Span, SurfaceIndex};

/// The patches of a surface.
struct Patches<'a> {
    index: &'a SurfaceIndex,
    quantity: Quantity,
    nets: Nets<'a>,
    locals: Vec<Option<Local>>,
    /// How far patches were moved to be flat at their poles.
    moved: f64,
    room: Room,
}

impl Field for Patches<'_> {
    fn glance(&mut self, k: usize) -> Option<Interval> {
        glance(&patch_piece(self.index, k)).map(|shape| known(&shape, self.quantity).range)
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
        collapsed_side(self.index, k, s, t)
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
    if let Some(mut field) = Elementary::new(index, quantity, &starts, options.relative) {
        let range = found(&mut field, &starts, &[], &spans, factor, options, poll)?;
        return Ok(Range { moved: field.moved / scale, ..range });
    }
    let mut field = Patches {
        index,
        quantity,
        nets: Nets::new(surface.surface(), index),
        locals: (0..index.patches.len()).map(|_| None).collect(),
        moved: 0.0,
        room: Room::default(),
    };
    let thought = places(surface.surface(), &spans, &starts, quantity, options.side);
    let range = found(&mut field, &starts, &thought, &spans, factor, options, poll)?;
    Ok(Range { moved: field.moved / scale, ..range })
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
    let mut range = found(&mut field, &starts, &[], &spans_of, scale, options, poll)?;
    range.at_least = [range.at_least[1], 0.0];
    range.at_greatest = [range.at_greatest[1], 0.0];
    for area in &mut range.excluded {
        *area = [area[2], area[3], 0.0, 0.0];
    }
    Ok(range)
}
