//! Intersections of curves with curves, surfaces and quadrics; sections of surfaces by quadrics; conics of quadrics.
//!
//! Answers are handles of their own: sizes are not known beforehand. They are written when they are complete and also when
//! something could not be decided or should_stop said so (then with FPT_BUDGET_EXHAUSTED or FPT_CANCELLED and the boxes); any other failure
//! writes nothing.

use super::curve::{self, fpt_curve};
use super::intersect_records::{
    fpt_branch, fpt_conic, fpt_curve_hit, fpt_hit_options, fpt_quadric, fpt_section_point,
    fpt_section_region,
};
use super::memory::{array, output, place, shared, write_array};
use super::options::check_length;
use super::surface::{self, fpt_surface};
use super::{Failure, fpt_status, guard};
use crate::intersect::{Common, CurveHit, CurveHits, Section};

/// Where a curve meets another shape. Immutable; owned by the caller, released by fpt_curve_hits_free.
pub struct fpt_curve_hits {
    hits: CurveHits,
}

/// Sections of a surface, one per plane or quadric. Immutable; owned by the caller, released by fpt_sections_free.
pub struct fpt_sections {
    sections: Vec<Section>,
}

fn beyond(index: usize, count: usize) -> Failure {
    Failure::invalid(format!("index: {index} is not below the count of {count}"))
}

fn undecided(stopped: bool, left: usize) -> Result<(), Failure> {
    let see = format!("{left} boxes are undecided; the answer lists them");
    match (stopped, left) {
        (true, _) => Err(Failure::Stopped(format!("cancelled by should_stop: {see}"))),
        (_, 0) => Ok(()),
        _ => Err(Failure::Budget(format!("budget: {see}"))),
    }
}

fn hand_over(hits: CurveHits, out: &mut *mut fpt_curve_hits) -> Result<(), Failure> {
    let (stopped, left) = (hits.stopped, hits.undecided.len());
    *out = Box::into_raw(Box::new(fpt_curve_hits { hits }));
    undecided(stopped, left)
}

/// Where two curves meet: crossings, contacts and overlaps, with proof that none is missing: everything else of the two is
/// farther apart than the tolerance. Hits come in the order of w, the parameter of `other`; u is that of `curve`. Where both are
/// closed, a hit on a seam is told once.
///
/// Cost: microseconds a crossing and pair of segments whose boxes meet; an overlap takes about length / sqrt(tolerance x
/// radius of curvature) boxes.
///
/// @param options  tolerance, budget, should_stop and user count; NULL: the defaults
/// @param out      the hits; release them with fpt_curve_hits_free
/// @return FPT_BUDGET_EXHAUSTED, or FPT_CANCELLED when should_stop said so, with hits that miss what lies in the undecided boxes
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_intersect_curves(
    curve: *const fpt_curve,
    other: *const fpt_curve,
    options: *const fpt_hit_options,
    out: *mut *mut fpt_curve_hits,
) -> fpt_status {
    // SAFETY: the header asks for live handles, options and room for a handle.
    guard(|| unsafe {
        let (curve, other) = (curve::indexed(curve)?, curve::indexed(other)?);
        let options = fpt_hit_options::read(options)?;
        let out = place("out", out)?;
        let callbacks = options.callbacks();
        let hits = curve.meet_curve(other, &options.hits(), &mut || callbacks.poll(0, 1))?;
        hand_over(hits, out)
    })
}

/// Where a curve meets a surface: as fpt_intersect_curves; u, v are the surface's parameters, w the curve's.
///
/// @param options  as for fpt_intersect_curves
/// @param out      the hits; release them with fpt_curve_hits_free
/// @return as fpt_intersect_curves
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_intersect_surface_curve(
    surface: *const fpt_surface,
    curve: *const fpt_curve,
    options: *const fpt_hit_options,
    out: *mut *mut fpt_curve_hits,
) -> fpt_status {
    // SAFETY: the header asks for live handles, options and room for a handle.
    guard(|| unsafe {
        let (surface, curve) = (surface::indexed(surface)?, curve::indexed(curve)?);
        let options = fpt_hit_options::read(options)?;
        let out = place("out", out)?;
        let callbacks = options.callbacks();
        let hits = surface.meet_curve(curve, &options.hits(), &mut || callbacks.poll(0, 1))?;
        hand_over(hits, out)
    })
}

/// Where a curve meets a plane or a quadric in implicit form: the zeros of a polynomial, none missing; w is the curve's parameter.
///
/// @param quadric  one plane or quadric
/// @param options  as for fpt_intersect_curves; the tolerance decides what lies in the quadric (a 64th of it)
/// @param out      the hits; release them with fpt_curve_hits_free
/// @return as fpt_intersect_curves
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_intersect_curve_quadric(
    curve: *const fpt_curve,
    quadric: *const fpt_quadric,
    options: *const fpt_hit_options,
    out: *mut *mut fpt_curve_hits,
) -> fpt_status {
    // SAFETY: the header asks for a live handle, a quadric, options and room for a handle.
    guard(|| unsafe {
        let curve = curve::indexed(curve)?;
        let quadric = shared("quadric", quadric)?.checked(0)?;
        let options = fpt_hit_options::read(options)?;
        let out = place("out", out)?;
        let callbacks = options.callbacks();
        let hits = curve.meet_quadric(&quadric, &options.hits(), &mut || callbacks.poll(0, 1))?;
        hand_over(hits, out)
    })
}

/// The number of hits.
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_curve_hits_count(
    hits: *const fpt_curve_hits,
    out_count: *mut usize,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for a number.
    guard(|| unsafe {
        let hits = &shared("hits", hits)?.hits.hits;
        *place("out_count", out_count)? = hits.len();
        Ok(())
    })
}

/// A hit.
///
/// @param index  below the count, else FPT_INVALID_ARGUMENT
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_curve_hits_get(
    hits: *const fpt_curve_hits,
    index: usize,
    out: *mut fpt_curve_hit,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for a hit; the layouts agree.
    guard(|| unsafe {
        let hits = &shared("hits", hits)?.hits.hits;
        let hit = hits.get(index).ok_or_else(|| beyond(index, hits.len()))?;
        *place("out", out.cast::<CurveHit>())? = *hit;
        Ok(())
    })
}

/// The number of boxes that are undecided: 0 when the hits are complete.
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_curve_hits_undecided_count(
    hits: *const fpt_curve_hits,
    out_count: *mut usize,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for a number.
    guard(|| unsafe {
        let boxes = &shared("hits", hits)?.hits.undecided;
        *place("out_count", out_count)? = boxes.len();
        Ok(())
    })
}

/// A box that is undecided: more hits may lie in it.
///
/// @param index    below the count, else FPT_INVALID_ARGUMENT
/// @param out_uvw  6 numbers: start and end of u, of v, of w
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_curve_hits_undecided_get(
    hits: *const fpt_curve_hits,
    index: usize,
    out_uvw: *mut f64,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for six numbers.
    guard(|| unsafe {
        let boxes = &shared("hits", hits)?.hits.undecided;
        let area = boxes.get(index).ok_or_else(|| beyond(index, boxes.len()))?;
        write_array("out_uvw", area, 6, out_uvw)
    })
}

/// Releases hits. NULL is fine. No other call may use the handle during or after this one.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_curve_hits_free(hits: *mut fpt_curve_hits) {
    let release = || {
        if !hits.is_null() {
            // SAFETY: a handle comes from Box::into_raw and is released once.
            drop(unsafe { Box::from_raw(hits) });
        }
        Ok(())
    };
    let _ = guard(release);
}

/// Sections of a surface by planes or quadrics: all branches of each, small loops too, with proof; isolated points of contact,
/// points where branches meet, parts that lie in the quadric, and boxes that could not be decided.
///
/// Points of branches lie on the surface and, to rounding, on the quadric (branches with tangential 1: to the root of it along
/// the surface). A stack of parallel planes gives contour lines.
///
/// @param quadrics  `count` planes or quadrics
/// @param count     at least 1
/// @param options   NULL: the defaults
/// @param out       the sections, in the order of the quadrics; release them with fpt_sections_free
/// @return FPT_BUDGET_EXHAUSTED, or FPT_CANCELLED when should_stop said so, with sections of which some miss what lies in their undecided
///         regions: all of the domain for those not begun
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_intersect_surface_quadrics(
    surface: *const fpt_surface,
    quadrics: *const fpt_quadric,
    count: usize,
    options: *const fpt_hit_options,
    out: *mut *mut fpt_sections,
) -> fpt_status {
    // SAFETY: the header asks for a live handle, an array of this length, options and room for a handle.
    guard(|| unsafe {
        let surface = surface::indexed(surface)?;
        let given = array("quadrics", quadrics, count)?;
        if count == 0 {
            return Err(Failure::invalid("count: 0 given, at least 1 needed".into()));
        }
        let mut list = Vec::new();
        list.try_reserve_exact(count).map_err(|_| crate::error::Error::OutOfMemory)?;
        for (k, quadric) in given.iter().enumerate() {
            list.push(quadric.checked(k)?);
        }
        let options = fpt_hit_options::read(options)?;
        let out = place("out", out)?;
        let callbacks = options.callbacks();
        let mut poll = |done: usize| callbacks.poll(done, count);
        let threads = options.threads as usize;
        let sections = surface.sections(&list, &options.sections(), threads, &mut poll)?;
        let left = sections.iter().map(|section| section.undecided.len()).sum();
        let stopped = sections.iter().any(|section| section.stopped);
        if !stopped {
            callbacks.report(count, count);
        }
        *out = Box::into_raw(Box::new(fpt_sections { sections }));
        undecided(stopped, left)
    })
}

/// One section.
///
/// # Safety
/// NULL or a live handle.
unsafe fn section<'a>(sections: *const fpt_sections, index: usize) -> Result<&'a Section, Failure> {
    // SAFETY: the caller vouches for it.
    let all = unsafe { &shared("sections", sections)?.sections };
    all.get(index).ok_or_else(|| {
        Failure::invalid(format!("section: {index} is not below the count of {}", all.len()))
    })
}

/// The numbers of branches, of single points and of regions of a section.
///
/// @param out_counts  3 numbers
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_sections_counts(
    sections: *const fpt_sections,
    section: usize,
    out_counts: *mut usize,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for three numbers.
    guard(|| unsafe {
        let section = self::section(sections, section)?;
        let counts = [
            section.branches.len(),
            section.contacts.len() + section.junctions.len(),
            section.overlaps.len() + section.undecided.len(),
        ];
        output("out_counts", out_counts, 3)?.copy_from_slice(&counts);
        Ok(())
    })
}

/// A branch of a section.
///
/// @param index  below the number of branches, else FPT_INVALID_ARGUMENT
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_sections_branch_get(
    sections: *const fpt_sections,
    section: usize,
    index: usize,
    out: *mut fpt_branch,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for a record.
    guard(|| unsafe {
        let branches = &self::section(sections, section)?.branches;
        let branch = branches.get(index).ok_or_else(|| beyond(index, branches.len()))?;
        *place("out", out)? = fpt_branch {
            point_count: branch.points.len(),
            ends: branch.ends.map(|end| end as u32),
            tangential: u32::from(branch.tangential),
            reserved: 0,
        };
        Ok(())
    })
}

/// The points of a branch in order; a loop ends with the point that it begins with. Where a branch crosses a seam two points with the same
/// place and different parameters follow each other.
///
/// @param capacity  numbers that fit into `out`; at least 5 x point_count, else FPT_INVALID_ARGUMENT
/// @param out       x, y, z, u, v of each point
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_sections_branch_points(
    sections: *const fpt_sections,
    section: usize,
    index: usize,
    capacity: usize,
    out: *mut f64,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for `capacity` numbers.
    guard(|| unsafe {
        let branches = &self::section(sections, section)?.branches;
        let branch = branches.get(index).ok_or_else(|| beyond(index, branches.len()))?;
        let row = |p: &crate::intersect::BranchPoint| {
            let ([x, y, z], [u, v]) = (p.point, p.at);
            [x, y, z, u, v]
        };
        let numbers: Vec<f64> = branch.points.iter().flat_map(row).collect();
        write_array("out", &numbers, capacity, out)
    })
}

/// A single point of a section: the contacts first, then the points where branches meet.
///
/// @param index  below the number of single points, else FPT_INVALID_ARGUMENT
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_sections_point_get(
    sections: *const fpt_sections,
    section: usize,
    index: usize,
    out: *mut fpt_section_point,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for a record.
    guard(|| unsafe {
        let Section { contacts, junctions, .. } = self::section(sections, section)?;
        let count = contacts.len() + junctions.len();
        let (at, distance, arms) = match contacts.get(index) {
            Some(contact) => (contact.at, contact.distance, 0),
            None => {
                let junction = junctions.get(index - contacts.len());
                let junction = junction.ok_or_else(|| beyond(index, count))?;
                (junction.at, 0.0, junction.arms as u32)
            }
        };
        let ([u, v], point) = (at.at, at.point);
        *place("out", out)? = fpt_section_point { u, v, point, distance, arms, reserved: 0 };
        Ok(())
    })
}

/// A region of a section: those in which the surface lies in the quadric first, then the undecided ones.
///
/// @param index  below the number of regions, else FPT_INVALID_ARGUMENT
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_sections_region_get(
    sections: *const fpt_sections,
    section: usize,
    index: usize,
    out: *mut fpt_section_region,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for a record.
    guard(|| unsafe {
        let Section { overlaps, undecided, .. } = self::section(sections, section)?;
        let count = overlaps.len() + undecided.len();
        let domain = match overlaps.get(index) {
            Some(domain) => domain,
            None => undecided.get(index - overlaps.len()).ok_or_else(|| beyond(index, count))?,
        };
        let is_overlap = u32::from(index < overlaps.len());
        *place("out", out)? =
            fpt_section_region { domain: *domain, overlaps: is_overlap, reserved: 0 };
        Ok(())
    })
}

/// Releases sections. NULL is fine. No other call may use the handle during or after this one.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_sections_free(sections: *mut fpt_sections) {
    let release = || {
        if !sections.is_null() {
            // SAFETY: a handle comes from Box::into_raw and is released once.
            drop(unsafe { Box::from_raw(sections) });
        }
        Ok(())
    };
    let _ = guard(release);
}

/// Where two planes or quadrics meet, when that is made of conics: circles, ellipses, lines and so on in closed form.
///
/// @param first      a plane or quadric
/// @param second     another one
/// @param tolerance  length, finite, > 0: points of the conics lie within it of both
/// @param out        room for 4 conics, of which the first `out_count` are written
/// @param out_count  number of conics; 0: they do not meet
/// @return FPT_UNSUPPORTED when both are the same, or meet in a curve that is not made of conics: then take one as a surface and
///         its section by the other
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_intersect_quadrics(
    first: *const fpt_quadric,
    second: *const fpt_quadric,
    tolerance: f64,
    out: *mut fpt_conic,
    out_count: *mut usize,
) -> fpt_status {
    // SAFETY: the header asks for two quadrics and room for the conics and a number.
    guard(|| unsafe {
        let a = shared("first", first)?.checked(0)?;
        let b = shared("second", second)?.checked(0)?;
        check_length("tolerance", tolerance)?;
        let unsupported =
            |text: &str| Failure::from(crate::error::Error::Unsupported(text.to_owned()));
        let conics = match a.meet(&b, tolerance) {
            Common::Conics(conics) => conics,
            Common::Same => return Err(unsupported("second: is the same as first")),
            Common::Quartic => return Err(unsupported("second: they do not meet in conics")),
        };
        let (room, number) = (output("out", out, 4)?, place("out_count", out_count)?);
        for (place, conic) in room.iter_mut().zip(&conics) {
            *place = conic.into();
        }
        *number = conics.len().min(4);
        Ok(())
    })
}
