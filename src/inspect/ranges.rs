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
use super::cell::{Bending, Forms, Known, Piece, check_degree};
use super::climb::places;
use super::glance::glance;
use super::interval::Interval;
use super::request::{
    Quantity, Range, RangeOptions, areas_inside, check, collapsed_side, known, parts_inside,
    patch_piece, segment_piece,
};
use super::search::{Field, Start, found};
use crate::bezier::Bidegree;
use crate::error::Error;
use crate::index::{IndexedCurve, IndexedSurface, Span, SurfaceIndex};

/// Boxes that become pieces of their own at most.
const MOST_LOCAL: usize = 20_000;

/// The patches of a surface.
struct Patches<'a> {
    index: &'a SurfaceIndex,
    quantity: Quantity,
    forms: Vec<Option<Forms>>,
    /// Boxes that are pieces of their own; their numbers follow those of the patches.
    local: Vec<(Start, Forms)>,
    /// How far nets were moved to be flat at their poles.
    moved: f64,
    net: Vec<f64>,
    work: Vec<f64>,
}

/// The forms of a piece on a box of a patch; those of smooth poles that the box touches divided out.
fn forms(index: &SurfaceIndex, piece: Piece, (k, s, t): Start, moved: &mut f64) -> Forms {
    let patch = &index.patches[k];
    let touched = [s[0] == 0.0, s[1] == 1.0, t[0] == 0.0, t[1] == 1.0];
    let sides: Vec<usize> = (0..4).filter(|&i| touched[i] && patch.collapsed[i]).collect();
    if sides.is_empty() {
        return Forms::light(&piece);
    }
    // Two sides that meet in a corner leave no frame there.
    if sides.iter().any(|side| side / 2 != sides[0] / 2) {
        return Forms::new(&piece);
    }
    let gaps: Option<Vec<f64>> = sides.iter().map(|&side| piece.flatness(side)).collect();
    let Some(gaps) = gaps else { return Forms::new(&piece) };
    let gap = gaps.iter().fold(0.0, |a, b| a + b);
    let flat = Piece { error: piece.error + gap, ..piece };
    let divided = sides.iter().try_fold(Forms::new(&flat), |forms, &side| forms.divided(side));
    match divided {
        Some(forms) => {
            *moved = moved.max(gap + patch.spread + piece.error);
            forms
        }
        None => Forms::new(&piece),
    }
}

impl Patches<'_> {
    /// The forms of a box of a patch.
    fn part(&mut self, at: Start) -> Forms {
        let part = patch_piece(self.index, at.0).part(at.1, at.2, &mut self.net);
        forms(self.index, part, at, &mut self.moved)
    }

    fn forms(&mut self, k: usize) -> &Forms {
        if let Some(k) = k.checked_sub(self.forms.len()) {
            return &self.local[k].1;
        }
        let (index, moved) = (self.index, &mut self.moved);
        let whole = [0.0, 1.0];
        self.forms[k]
            .get_or_insert_with(|| forms(index, patch_piece(index, k), (k, whole, whole), moved))
    }
}

impl Field for Patches<'_> {
    fn glance(&mut self, k: usize) -> Option<Interval> {
        glance(&patch_piece(self.index, k)).map(|shape| known(&shape, self.quantity).range)
    }

    fn on(&mut self, (k, s, t): Start) -> Known {
        let mut work = std::mem::take(&mut self.work);
        let shape = self.forms(k).on(s, t, &mut work);
        self.work = work;
        known(&shape, self.quantity)
    }

    fn avoids(&mut self, at: Start, value: f64) -> Option<bool> {
        let (k, s, t) = at;
        let (quantity, mut work) = (self.quantity, std::mem::take(&mut self.work));
        let avoids = if s == [0.0, 1.0] && t == [0.0, 1.0] {
            self.forms(k).avoids(quantity, value, &mut work)
        } else {
            self.part(self.origin(at)).avoids(quantity, value, &mut work)
        };
        self.work = work;
        avoids
    }

    fn local(&mut self, at: Start) -> Option<Start> {
        let origin = self.origin(at);
        let degree = self.index.degree;
        let is_low = degree.s.max(degree.t) <= if self.index.rational { 2 } else { 3 };
        // Beside a smooth pole the forms of the patch, with its factors divided out, are the better ones.
        if self.local.len() >= MOST_LOCAL || is_low || self.index.patches[origin.0].has_collapsed()
        {
            return None;
        }
        let forms = self.part(origin);
        self.local.push((origin, forms));
        Some((self.forms.len() + self.local.len() - 1, [0.0, 1.0], [0.0, 1.0]))
    }

    fn origin(&self, at: Start) -> Start {
        let (k, s, t) = at;
        let Some((whole, _)) = k.checked_sub(self.forms.len()).map(|k| &self.local[k]) else {
            return at;
        };
        let (k, u, v) = *whole;
        // The ends are kept to the bit: they tell which sides a box touches.
        let place = |[a, b]: [f64; 2], x: f64| if x == 1.0 { b } else { a + (b - a) * x };
        (k, s.map(|x| place(u, x)), t.map(|x| place(v, x)))
    }

    fn across(&self, at: Start) -> Option<usize> {
        let (k, s, t) = self.origin(at);
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
        forms: (0..index.patches.len()).map(|_| None).collect(),
        local: Vec::new(),
        moved: 0.0,
        net: Vec::new(),
        work: Vec::new(),
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
