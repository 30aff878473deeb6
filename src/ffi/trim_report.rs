//! What is known about a trimmed surface: report, text, picture.

use super::memory::{array, output, place, shared};
use super::options::check_length;
use super::trim::{face, fpt_trim};
use super::{Failure, fpt_status, guard};
use crate::trim::{Finding, Place, Report, TrimmedSurface, picture};
use std::ffi::{CStr, c_char};

/// What can be wrong with a face, for fpt_trim_finding.kind.
#[repr(C)]
#[derive(Clone, Copy)]
pub enum fpt_finding_kind {
    /// A coedge ends away from the beginning of the next one: numbers are the gap in space (0 across a seam or along a collapsed
    /// edge that is missing), and in u and v.
    FPT_FINDING_OPEN = 0,
    /// A loop runs the wrong way: numbers[0] is its area in the domain.
    FPT_FINDING_DIRECTION = 1,
    /// The area of a loop is so small that its direction cannot be told.
    FPT_FINDING_NO_DIRECTION = 2,
    /// Two coedges cross, proven; or one crosses itself.
    FPT_FINDING_CROSSING = 3,
    /// Two coedges come nearer than the tolerance away from common ends: numbers[0] bounds their distance in space.
    FPT_FINDING_TOUCHING = 4,
    /// The image of a pcurve is away from its edge: numbers[0] is the distance.
    FPT_FINDING_EDGE_GAP = 5,
    /// A pcurve leaves the domain: numbers are by how much in u and v.
    FPT_FINDING_OUTSIDE = 6,
    /// A loop is not where its kind says: numbers[0] counts the outer loops around it less the holes around it, 1 for a hole
    /// and 0 for an outer loop that are right.
    FPT_FINDING_CONTAINMENT = 7,
    /// Both coedges of an edge run along it the same way; `loop_index` is the number of the edge.
    FPT_FINDING_SENSE = 8,
    /// The surface's function fails on a coedge.
    FPT_FINDING_FAILING = 9,
    /// Whether two coedges touch could not be decided: they are too long for the tolerance, or lie on each other.
    FPT_FINDING_UNDECIDED = 10,
}

/// Something that is wrong. 80 bytes, frozen. What a kind does not have is SIZE_MAX or 0.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct fpt_trim_finding {
    /// A value of fpt_finding_kind.
    pub kind: u32,
    /// 0.
    pub reserved: u32,
    /// Number of the loop.
    pub loop_index: usize,
    /// Number of the coedge in it.
    pub coedge: usize,
    /// Parameter of its pcurve.
    pub parameter: f64,
    /// The other loop of a contact.
    pub other_loop: usize,
    /// The other coedge.
    pub other_coedge: usize,
    /// The parameter there.
    pub other_parameter: f64,
    /// What the kind says.
    pub numbers: [f64; 3],
}

/// A report in a few numbers. 56 bytes, frozen.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct fpt_trim_summary {
    /// The tolerance used, a length.
    pub tolerance: f64,
    /// Largest distance of a coedge's end and the next one's beginning, in space.
    pub largest_opening: f64,
    /// Largest distance of a pcurve's image and its edge found, at 33 places and all corners of each coedge.
    pub largest_gap: f64,
    /// Proven: no image of a pcurve and its edge are farther apart, at equal parameters where they share them, else as sets of points.
    /// Infinite where a function takes part, a pcurve leaves the domain, or no bound could be had.
    pub gap_bound: f64,
    /// How far the segments that stand for curves may be off, a length; part of the tolerance unless a curve is very long.
    pub segment_error: f64,
    /// 1: coedges without a finding are proven to be disjoint away from common ends; 0: the surface is a function, its speed is known from samples only.
    pub proven: u32,
    /// 0.
    pub reserved: u32,
    /// Number of findings; 0: the face is valid.
    pub finding_count: usize,
}

/// What was found wrong with a face. Immutable. Owned by the caller, released by fpt_trim_report_free.
pub struct fpt_trim_report {
    report: Report,
}

/// Checks a face: open loops, wrong directions, crossing and touching curves, gaps between curves and edges, curves outside of the domain,
/// containment of loops. Cost: milliseconds, some ten where edges have other parameters than their coedges.
///
/// @param tolerance  length, finite, >= 0; 0: 1e-7 x the diagonal of the surface's box
/// @param out        the report; release it with fpt_trim_report_free
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_trim_report_new(
    trim: *const fpt_trim,
    tolerance: f64,
    out: *mut *mut fpt_trim_report,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for a handle.
    guard(|| unsafe {
        let out = place("out", out)?;
        let face = face("trim", trim)?;
        check_length("tolerance", tolerance)?;
        let report = face.report(tolerance)?;
        *out = Box::into_raw(Box::new(fpt_trim_report { report }));
        Ok(())
    })
}

/// # Safety
/// NULL or a live handle.
unsafe fn report<'a>(report: *const fpt_trim_report) -> Result<&'a Report, Failure> {
    // SAFETY: the caller vouches for it.
    Ok(&unsafe { shared("report", report) }?.report)
}

/// The report in a few numbers.
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_trim_report_summary(
    report: *const fpt_trim_report,
    out: *mut fpt_trim_summary,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for a record.
    guard(|| unsafe {
        let report = self::report(report)?;
        *place("out", out)? = fpt_trim_summary {
            tolerance: report.tolerance,
            largest_opening: report.largest_opening,
            largest_gap: report.largest_gap,
            gap_bound: report.gap_bound,
            segment_error: report.segment_error,
            proven: u32::from(report.proven),
            reserved: 0,
            finding_count: report.findings.len(),
        };
        Ok(())
    })
}

/// One thing that is wrong.
///
/// @param index  less than finding_count of the summary
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_trim_report_get(
    report: *const fpt_trim_report,
    index: usize,
    out: *mut fpt_trim_finding,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for a record.
    guard(|| unsafe {
        let findings = &self::report(report)?.findings;
        let out = place("out", out)?;
        let Some(finding) = findings.get(index) else {
            let text = format!("index: {index} is not less than {}", findings.len());
            return Err(Failure::invalid(text));
        };
        *out = record(finding);
        Ok(())
    })
}

fn record(finding: &Finding) -> fpt_trim_finding {
    use fpt_finding_kind::*;
    let none = Place { chain: usize::MAX, coedge: usize::MAX, parameter: 0.0 };
    let whole = |chain: usize| Place { chain, ..none };
    let (kind, first, second, numbers) = match *finding {
        Finding::Open { place, domain_gap: [u, v], gap } => {
            (FPT_FINDING_OPEN, place, none, [gap, u, v])
        }
        Finding::Direction { chain, area } => {
            (FPT_FINDING_DIRECTION, whole(chain), none, [area, 0.0, 0.0])
        }
        Finding::NoDirection { chain, area } => {
            (FPT_FINDING_NO_DIRECTION, whole(chain), none, [area, 0.0, 0.0])
        }
        Finding::Crossing { first, second } => (FPT_FINDING_CROSSING, first, second, [0.0; 3]),
        Finding::Touching { first, second, distance } => {
            (FPT_FINDING_TOUCHING, first, second, [distance, 0.0, 0.0])
        }
        Finding::EdgeGap { place, gap } => (FPT_FINDING_EDGE_GAP, place, none, [gap, 0.0, 0.0]),
        Finding::Outside { place, by: [u, v] } => (FPT_FINDING_OUTSIDE, place, none, [u, v, 0.0]),
        Finding::Containment { chain, depth } => {
            (FPT_FINDING_CONTAINMENT, whole(chain), none, [f64::from(depth), 0.0, 0.0])
        }
        Finding::Sense { edge } => (FPT_FINDING_SENSE, whole(edge), none, [0.0; 3]),
        Finding::Undecided { first, second } => {
            let place = |[chain, coedge]: [usize; 2]| Place { chain, coedge, parameter: 0.0 };
            (FPT_FINDING_UNDECIDED, place(first), place(second), [0.0; 3])
        }
        Finding::Failing { place } => (FPT_FINDING_FAILING, place, none, [0.0; 3]),
    };
    fpt_trim_finding {
        kind: kind as u32,
        reserved: 0,
        loop_index: first.chain,
        coedge: first.coedge,
        parameter: first.parameter,
        other_loop: second.chain,
        other_coedge: second.coedge,
        other_parameter: second.parameter,
        numbers,
    }
}

/// Releases a report. NULL is fine.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_trim_report_free(report: *mut fpt_trim_report) {
    if !report.is_null() {
        // SAFETY: a handle comes from Box::into_raw and is released once.
        let _ = guard(|| unsafe {
            drop(Box::from_raw(report));
            Ok(())
        });
    }
}

/// Writes a text with a closing NUL when there is room for it, and its length in any case.
///
/// # Safety
/// Room for `capacity` bytes and for the length.
unsafe fn hand_over(
    text: &str,
    capacity: usize,
    out: *mut c_char,
    out_length: *mut usize,
) -> Result<(), Failure> {
    // SAFETY: the caller vouches for it.
    unsafe {
        let length = place("out_length", out_length)?;
        if capacity > 0 {
            let room = output("out", out.cast::<u8>(), capacity)?;
            if capacity <= text.len() {
                let (found, needed) = (capacity, text.len() + 1);
                let text = format!("capacity: {found} is less than the {needed} bytes of the text");
                return Err(Failure::invalid(text));
            }
            room[..text.len()].copy_from_slice(text.as_bytes());
            room[text.len()] = 0;
        }
        *length = text.len();
    }
    Ok(())
}

/// The face as JSON text (UTF-8): every number comes back with the same bits. Ask with a capacity of 0 for the length.
///
/// @param capacity    0, or bytes of room: at least the length and a closing NUL
/// @param out         the text; may be NULL when capacity is 0
/// @param out_length  bytes of the text, the closing NUL not counted
/// @return FPT_UNSUPPORTED for surfaces and curves given by functions
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_trim_to_json(
    trim: *const fpt_trim,
    capacity: usize,
    out: *mut c_char,
    out_length: *mut usize,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for the text.
    guard(|| unsafe { hand_over(&face("trim", trim)?.to_json()?, capacity, out, out_length) })
}

/// The face of a JSON text. It goes through the checks of fpt_trim_new.
///
/// @param text    length bytes of UTF-8; a closing NUL is not needed
/// @param out     the handle; release it with fpt_trim_free
/// @return FPT_INVALID_ARGUMENT names line and column of what is no JSON, or the path of an entry that is missing or not allowed
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_trim_from_json(
    text: *const c_char,
    length: usize,
    out: *mut *mut fpt_trim,
) -> fpt_status {
    // SAFETY: the header asks for bytes and room for a handle.
    guard(|| unsafe {
        let out = place("out", out)?;
        let bytes = array("text", text.cast::<u8>(), length)?;
        let text = std::str::from_utf8(bytes)
            .map_err(|error| Failure::invalid(format!("text: is not UTF-8: {error}")))?;
        *out = fpt_trim::handle(TrimmedSurface::from_json(text)?);
        Ok(())
    })
}

/// A picture of faces as SVG text (UTF-8), one column each: the domain with its loops, and the face in space without perspective. Ask
/// with a capacity of 0 for the length.
///
/// @param trims       count handles
/// @param titles      count texts (UTF-8) that end with a NUL; NULL: none
/// @param count       1 to 16
/// @param view        3 numbers: the direction in which one looks; NULL: the usual one
/// @param capacity    0, or bytes of room: at least the length and a closing NUL
/// @param out         the text; may be NULL when capacity is 0
/// @param out_length  bytes of the text, the closing NUL not counted
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_trim_picture(
    trims: *const *const fpt_trim,
    titles: *const *const c_char,
    count: usize,
    view: *const f64,
    capacity: usize,
    out: *mut c_char,
    out_length: *mut usize,
) -> fpt_status {
    // SAFETY: the header asks for live handles, texts, and room for the text.
    guard(|| unsafe {
        let handles = array("trims", trims, count)?;
        let texts = if titles.is_null() { None } else { Some(array("titles", titles, count)?) };
        let mut faces = Vec::new();
        for (k, &handle) in handles.iter().enumerate().take(crate::trim::MOST_COLUMNS + 1) {
            let title = match texts.map(|texts| texts[k]) {
                Some(text) if !text.is_null() => CStr::from_ptr(text)
                    .to_str()
                    .map_err(|_| Failure::invalid(format!("titles: title {k} is not UTF-8")))?,
                _ => "",
            };
            faces.push((title, face("trims", handle)?));
        }
        let direction = if view.is_null() {
            [0.0; 3]
        } else {
            let view = array("view", view, 3)?;
            [view[0], view[1], view[2]]
        };
        hand_over(&picture(&faces, direction)?, capacity, out, out_length)
    })
}
