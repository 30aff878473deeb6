//! Surface-surface intersection: branches, contacts, regions and boxes behind a handle.
//!
//! The result is written when it is complete and also when the budget ran out or should_stop said so (then with FPT_BUDGET_EXHAUSTED or
//! FPT_CANCELLED and what is undecided); any other failure writes nothing.

use super::curve::fpt_curve;
use super::form::CurveForm;
use super::march_records::{
    fpt_branch_end, fpt_contact_kind, fpt_intersect_method, fpt_intersect_surfaces_options,
    fpt_intersection_branch, fpt_intersection_contact, fpt_intersection_point,
    fpt_intersection_summary,
};
use super::memory::{output, place, shared, write_array};
use super::surface::{self, fpt_surface};
use super::trim::{self, fpt_trim};
use super::{Failure, fpt_status, guard};
use crate::curve::Curve;
use crate::index::IndexedCurve;
use crate::march::curves::curves;
use crate::march::faces::intersect_faces;
use crate::march::split::{cuts_of, split};
use crate::march::{ContactKind, End, Intersection, MarchPoint, Region, intersect, named};
use std::sync::Arc;

/// All that two surfaces have in common. Immutable: any number of threads may read one at a time. Owned by the caller,
/// released by fpt_surface_intersection_free; it does not refer to the surfaces that it came from.
pub struct fpt_surface_intersection {
    found: Intersection,
}

/// All branches and points that two surfaces have in common, with proof that none is missing, or with what could not be decided.
///
/// Pairs of Bezier pieces are halved until they provably hold nothing or one transversal arc; loops cannot hide. Where the surfaces touch
/// to the last digits, the contact is classified and measured, not proven.
///
/// FPT_INTERSECT_SUBDIVISION and FPT_INTERSECT_MESH give polylines on triangles: the gap of a branch says how far its points are off, nothing
/// is proven, and one undecided box is all of both domains.
///
/// @param a, b     surfaces of knots and poles; FPT_UNSUPPORTED for one given by a function (but by FPT_INTERSECT_MESH), or that is a
///                 point
/// @param options  NULL: the defaults
/// @param out      the result; release it with fpt_surface_intersection_free
/// @return FPT_BUDGET_EXHAUSTED, or FPT_CANCELLED when should_stop said so, with a result that misses what lies in its undecided boxes
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_intersect_surfaces(
    a: *const fpt_surface,
    b: *const fpt_surface,
    options: *const fpt_intersect_surfaces_options,
    out: *mut *mut fpt_surface_intersection,
) -> fpt_status {
    // SAFETY: the header asks for live handles, options and room for a handle.
    guard(|| unsafe {
        let options = fpt_intersect_surfaces_options::read(options)?;
        let (asked, callbacks) = (options.march(), options.callbacks());
        let mut poll = |done: u64, left: u64| callbacks.poll(done as usize, (done + left) as usize);
        const AUTO: u32 = fpt_intersect_method::FPT_INTERSECT_AUTO as u32;
        const SUBDIVISION: u32 = fpt_intersect_method::FPT_INTERSECT_SUBDIVISION as u32;
        const MESH: u32 = fpt_intersect_method::FPT_INTERSECT_MESH as u32;
        let splines = || -> Result<_, Failure> {
            Ok((surface::indexed_as("a", a)?, surface::indexed_as("b", b)?))
        };
        let made = |found| handed_out(found, place("out", out)?);
        match options.method {
            AUTO => {
                let (a, b) = splines()?;
                place("out", out)?;
                made(intersect(a, b, &asked, &mut poll)?)
            }
            SUBDIVISION => {
                let (a, b) = splines()?;
                place("out", out)?;
                let (a, b) = (a.surface(), b.surface());
                made(named::by_subdivision(a, b, options.levels, &asked, &mut poll)?)
            }
            MESH => {
                let (a, b) = (surface::support_as("a", a)?, surface::support_as("b", b)?);
                place("out", out)?;
                made(named::by_mesh(&a, &b, options.levels, &mut poll)?)
            }
            other => {
                let text = format!("method: {other} is not an FPT_INTERSECT_ value");
                Err(Failure::invalid(text))
            }
        }
    })
}

/// All that two faces have in common: as fpt_intersect_surfaces of their supports, cut off at their trims (FPT_BRANCH_END_TRIM). A whole
/// support is a face too: fpt_trim_whole.
///
/// Parameters are those of the supports; elementary ones are intersected in their exact NURBS form. A support given by a function is meshed
/// and walked along: nothing is proven then, and one undecided box is all of both domains. A face holds its border; what runs along
/// a trim is kept, and listed as undecided.
///
/// @param a, b     the faces
/// @param options  NULL: the defaults
/// @param out      the result; release it with fpt_surface_intersection_free
/// @return FPT_BUDGET_EXHAUSTED, or FPT_CANCELLED when should_stop said so, with a result that misses what lies in its undecided boxes
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_intersect_trims(
    a: *const fpt_trim,
    b: *const fpt_trim,
    options: *const fpt_intersect_surfaces_options,
    out: *mut *mut fpt_surface_intersection,
) -> fpt_status {
    // SAFETY: the header asks for live handles, options and room for a handle.
    guard(|| unsafe {
        let (a, b) = (trim::face("a", a)?, trim::face("b", b)?);
        let options = fpt_intersect_surfaces_options::read(options)?;
        if options.method != fpt_intersect_method::FPT_INTERSECT_AUTO as u32 {
            let text = format!("method: {}: faces take FPT_INTERSECT_AUTO only", options.method);
            return Err(Failure::invalid(text));
        }
        let callbacks = options.callbacks();
        let out = place("out", out)?;
        let found = intersect_faces(a, b, &options.march(), &mut |done, left| {
            callbacks.poll(done as usize, (done + left) as usize)
        })?;
        handed_out(found, out)
    })
}

/// Hands a result to the caller, with the failure of a budget that ran out or of a stop.
pub(super) fn handed_out(
    found: Intersection,
    out: &mut *mut fpt_surface_intersection,
) -> Result<(), Failure> {
    let (stopped, exhausted, left) = (found.stopped, found.exhausted, found.undecided.len());
    *out = Box::into_raw(Box::new(fpt_surface_intersection { found }));
    let see = format!("with {left} boxes undecided; see fpt_surface_intersection_undecided");
    match (stopped, exhausted) {
        (true, _) => Err(Failure::Stopped(format!("cancelled by should_stop {see}"))),
        (_, true) => Err(Failure::Budget(format!("budget: ran out {see}"))),
        _ => Ok(()),
    }
}

/// Counts and verdicts.
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_intersection_summary(
    intersection: *const fpt_surface_intersection,
    out: *mut fpt_intersection_summary,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for a record.
    guard(|| unsafe {
        let found = &shared("intersection", intersection)?.found;
        *place("out", out)? = fpt_intersection_summary {
            branch_count: found.branches.len(),
            contact_count: found.contacts.len(),
            overlap_count: found.overlaps.len(),
            undecided_count: found.undecided.len(),
            pairs: found.judged,
            is_proven: u32::from(found.is_proven),
            is_exhausted: u32::from(found.exhausted),
            is_stopped: u32::from(found.stopped),
            reserved: 0,
        };
        Ok(())
    })
}

/// A branch without its points.
///
/// @param index  below branch_count, else FPT_INVALID_ARGUMENT
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_intersection_branch(
    intersection: *const fpt_surface_intersection,
    index: usize,
    out: *mut fpt_intersection_branch,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for a record.
    guard(|| unsafe {
        let branch = item(&shared("intersection", intersection)?.found.branches, index)?;
        let end = |end: End| match end {
            End::Closed => (fpt_branch_end::FPT_BRANCH_END_CLOSED, 0),
            End::Border(side) => (fpt_branch_end::FPT_BRANCH_END_BORDER, u32::from(side)),
            End::Contact(contact) => (fpt_branch_end::FPT_BRANCH_END_CONTACT, contact as u32),
            End::Undecided => (fpt_branch_end::FPT_BRANCH_END_UNDECIDED, 0),
            End::Trim(whose) => (fpt_branch_end::FPT_BRANCH_END_TRIM, u32::from(whose)),
        };
        let [(first, i), (last, j)] = branch.ends.map(end);
        *place("out", out)? = fpt_intersection_branch {
            point_count: branch.points.len(),
            gap: branch.gap,
            chord: branch.chord,
            is_tangential: u32::from(branch.is_tangential),
            bounds_overlap: u32::from(branch.bounds_overlap),
            is_closed: u32::from(branch.is_closed()),
            reserved: 0,
            end_kind: [first as u32, last as u32],
            end_index: [i, j],
        };
        Ok(())
    })
}

/// The points of a branch, in order. At a seam of a closed surface the same point comes twice, with the parameters of either side.
///
/// @param index     below branch_count, else FPT_INVALID_ARGUMENT
/// @param capacity  room in `out`, at least the branch's point_count, else FPT_INVALID_ARGUMENT
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_intersection_points(
    intersection: *const fpt_surface_intersection,
    index: usize,
    capacity: usize,
    out: *mut fpt_intersection_point,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for the points; the layouts agree (above).
    guard(|| unsafe {
        let points = &item(&shared("intersection", intersection)?.found.branches, index)?.points;
        if capacity < points.len() {
            let text = format!("capacity: {capacity} given, {} points", points.len());
            return Err(Failure::invalid(text));
        }
        output("out", out.cast::<MarchPoint>(), points.len())?.copy_from_slice(points);
        Ok(())
    })
}

/// A contact.
///
/// @param index  below contact_count, else FPT_INVALID_ARGUMENT
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_intersection_contact(
    intersection: *const fpt_surface_intersection,
    index: usize,
    out: *mut fpt_intersection_contact,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for a record.
    guard(|| unsafe {
        let contact = item(&shared("intersection", intersection)?.found.contacts, index)?;
        let kind = match contact.kind {
            ContactKind::Touching => fpt_contact_kind::FPT_CONTACT_TOUCHING,
            ContactKind::Crossing => fpt_contact_kind::FPT_CONTACT_CROSSING,
            ContactKind::Degenerate => fpt_contact_kind::FPT_CONTACT_DEGENERATE,
            ContactKind::Border => fpt_contact_kind::FPT_CONTACT_BORDER,
            ContactKind::Tip => fpt_contact_kind::FPT_CONTACT_TIP,
        };
        let MarchPoint { point, uv, st } = contact.place;
        *place("out", out)? = fpt_intersection_contact {
            place: fpt_intersection_point { point, uv, st },
            gap: contact.gap,
            radius: contact.radius,
            kind: kind as u32,
            reserved: 0,
        };
        Ok(())
    })
}

/// A box in which the surfaces coincide to the last digits.
///
/// @param index      below overlap_count, else FPT_INVALID_ARGUMENT
/// @param out_range  8 numbers: ends of u, v of A, of u, v of B
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_intersection_overlap(
    intersection: *const fpt_surface_intersection,
    index: usize,
    out_range: *mut f64,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for eight numbers.
    guard(|| unsafe {
        let Region { range } = item(&shared("intersection", intersection)?.found.overlaps, index)?;
        write_array("out_range", range, 8, out_range)
    })
}

/// A box about which nothing is known.
///
/// @param index      below undecided_count, else FPT_INVALID_ARGUMENT
/// @param out_range  8 numbers: ends of u, v of A, of u, v of B
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_intersection_undecided(
    intersection: *const fpt_surface_intersection,
    index: usize,
    out_range: *mut f64,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for eight numbers.
    guard(|| unsafe {
        let Region { range } = item(&shared("intersection", intersection)?.found.undecided, index)?;
        write_array("out_range", range, 8, out_range)
    })
}

/// A branch as cubic B-splines in space and in both domains (z = 0), with the same knots. A branch is cut at seams and corners. Where the fit
/// misses its tolerance, the error says so, and is not more than that of the chords between the points.
///
/// @param a, b        the surfaces that the intersection was made of
/// @param index       below branch_count, else FPT_INVALID_ARGUMENT
/// @param tolerance   length, > 0: what the fit aims at
/// @param part        which part between two seams or corners; beyond the count of parts FPT_INVALID_ARGUMENT
/// @param options     should_stop, progress and user count; NULL: nobody is asked
/// @param out_count   the number of parts
/// @param out_curves  3 handles: in space, in A's domain, in B's domain; release each with fpt_curve_free
/// @param out_error   proven: at equal parameters the curve is nowhere farther from the surface points at its parameters, and so from
///                    both surfaces
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_intersection_curves(
    intersection: *const fpt_surface_intersection,
    a: *const fpt_surface,
    b: *const fpt_surface,
    index: usize,
    tolerance: f64,
    part: usize,
    options: *const fpt_intersect_surfaces_options,
    out_count: *mut usize,
    out_curves: *mut *mut fpt_curve,
    out_error: *mut f64,
) -> fpt_status {
    // SAFETY: the header asks for live handles and room for the outputs.
    guard(|| unsafe {
        let branch = item(&shared("intersection", intersection)?.found.branches, index)?;
        let (a, b) = (surface::indexed_as("a", a)?, surface::indexed_as("b", b)?);
        let (count, error) = (place("out_count", out_count)?, place("out_error", out_error)?);
        let out = output("out_curves", out_curves, 3)?;
        let callbacks = fpt_intersect_surfaces_options::read(options)?.callbacks();
        let mut parts = curves(a, b, &branch.points, tolerance, &mut |done, left| {
            callbacks.poll(done as usize, (done + left) as usize)
        })?;
        if part >= parts.len() {
            let text = format!("part: {part} is not below the count of {}", parts.len());
            return Err(Failure::invalid(text));
        }
        *count = parts.len();
        let made = parts.swap_remove(part);
        *error = made.error;
        out.copy_from_slice(&[handed(made.space), handed(made.uv), handed(made.st)]);
        Ok(())
    })
}

/// The faces into which the branches cut one of the two faces that they came from. Cuts are polylines in its domain and in space, as near as the
/// chord tolerance made them. Branches that end inside the face, and tangential ones, cut nothing.
///
/// @param trim       the first (which = 0) or the second (which = 1) face of the intersection
/// @param tolerance  length, > 0: within it ends of branches meet loops and one another
/// @param options    should_stop, progress and user count; NULL: nobody is asked
/// @param capacity   room in out_trims, at least the number of faces, else FPT_INVALID_ARGUMENT with *out_count set
/// @param out_trims  handles; release each with fpt_trim_free
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_intersection_split(
    intersection: *const fpt_surface_intersection,
    trim: *const fpt_trim,
    which: u32,
    tolerance: f64,
    options: *const fpt_intersect_surfaces_options,
    capacity: usize,
    out_trims: *mut *mut fpt_trim,
    out_count: *mut usize,
) -> fpt_status {
    // SAFETY: the header asks for live handles and room for the outputs.
    guard(|| unsafe {
        let found = &shared("intersection", intersection)?.found;
        let face = trim::face("trim", trim)?;
        if which > 1 {
            return Err(Failure::invalid(format!("which: {which} is not 0 or 1")));
        }
        let count = place("out_count", out_count)?;
        let callbacks = fpt_intersect_surfaces_options::read(options)?.callbacks();
        let faces = split(face, &cuts_of(found, which == 1)?, tolerance, &mut |done, left| {
            callbacks.poll(done as usize, (done + left) as usize)
        })?
        .faces;
        *count = faces.len();
        if capacity < faces.len() {
            let text = format!("capacity: {capacity} given, {} faces", faces.len());
            return Err(Failure::invalid(text));
        }
        let out = output("out_trims", out_trims, faces.len())?;
        for (out, face) in out.iter_mut().zip(faces) {
            *out = fpt_trim::handle(face);
        }
        Ok(())
    })
}

/// Releases an intersection. NULL is fine. No other call may use the handle during or after this one.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_intersection_free(
    intersection: *mut fpt_surface_intersection,
) {
    let release = || {
        if !intersection.is_null() {
            // SAFETY: a handle comes from Box::into_raw and is released once.
            drop(unsafe { Box::from_raw(intersection) });
        }
        Ok(())
    };
    let _ = guard(release);
}

fn handed(curve: Curve) -> *mut fpt_curve {
    fpt_curve::handle(CurveForm::Spline(Arc::new(IndexedCurve::new(curve))))
}

fn item<T>(list: &[T], index: usize) -> Result<&T, Failure> {
    let beyond =
        || Failure::invalid(format!("index: {index} is not below the count of {}", list.len()));
    list.get(index).ok_or_else(beyond)
}
