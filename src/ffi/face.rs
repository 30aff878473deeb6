//! Faces: classification, nearest points, preimages.

use super::curve::fpt_curve;
use super::form::SurfaceForm;
use super::inspect_records::{initialise, sized_or_default};
use super::memory::{Strided, array, check_extent, optional_output, output, place, shared};
use super::options::{SelfSized, check_length, fpt_query_options, sized};
use super::pcurve::pcurve;
use super::query::{Callbacks, LARGE, check_hints};
use super::records::{feet, fpt_foot_point};
use super::sets::{fpt_foot_set, hand_over, point};
use super::surface::{self, fpt_surface};
use super::trim::{self, fpt_trim};
use super::{Failure, fpt_status, guard};
use crate::batch;
use crate::closest::{FootPoint, QueryOptions, Scope};
use crate::error::Error;
use crate::face::{Face, FaceWorkspace, NOT_PROVEN, Place, Standing};
use crate::trim::{Coedge, Loop, Support, TrimmedSurface};
use std::ffi::{c_int, c_void};
use std::mem::{align_of, offset_of, size_of};
use std::sync::atomic::{AtomicU64, Ordering};

/// Where a place lies, for fpt_face_place.standing.
#[repr(C)]
#[derive(Clone, Copy)]
pub enum fpt_face_standing {
    /// In the face, farther from its edges than the tolerance.
    FPT_FACE_INSIDE = 0,
    /// Not in the face, farther from its edges than the tolerance.
    FPT_FACE_OUTSIDE = 1,
    /// Within the tolerance of an edge, in space.
    FPT_FACE_ON_EDGE = 2,
    /// It could not be decided whether an edge is within the tolerance; or the query was none.
    FPT_FACE_UNKNOWN = 3,
}

/// A place of a face: 24 bytes, frozen.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct fpt_face_place {
    /// A value of fpt_face_standing.
    pub standing: u32,
    /// On an edge: the number of its loop; else UINT32_MAX.
    pub loop_index: u32,
    /// On an edge: the number of the pcurve in its loop; else UINT32_MAX.
    pub coedge_index: u32,
    /// 0 or FPT_STANDING_NOT_PROVEN.
    pub flags: u32,
    /// On an edge: the parameter of the pcurve; else NaN.
    pub parameter: f64,
}

/// Bits of fpt_face_place.flags.
#[repr(C)]
#[derive(Clone, Copy)]
pub enum fpt_standing_flag {
    /// Whether an edge is within the tolerance is not proven: the surface is a function without a bound of its speed. Sides in the domain
    /// are exact all the same.
    FPT_STANDING_NOT_PROVEN = 1,
}

// Places are copied out as they are: the layouts must agree.
const _: () = {
    assert!(size_of::<fpt_face_place>() == 24 && size_of::<Place>() == 24);
    assert!(align_of::<fpt_face_place>() == align_of::<Place>());
    assert!(offset_of!(fpt_face_place, standing) == offset_of!(Place, standing));
    assert!(offset_of!(fpt_face_place, loop_index) == offset_of!(Place, loop_index));
    assert!(offset_of!(fpt_face_place, coedge_index) == offset_of!(Place, coedge_index));
    assert!(offset_of!(fpt_face_place, flags) == offset_of!(Place, flags));
    assert!(offset_of!(fpt_face_place, parameter) == offset_of!(Place, parameter));
    assert!(fpt_standing_flag::FPT_STANDING_NOT_PROVEN as u32 == NOT_PROVEN);
    assert!(fpt_face_standing::FPT_FACE_INSIDE as u32 == Standing::Inside as u32);
    assert!(fpt_face_standing::FPT_FACE_OUTSIDE as u32 == Standing::Outside as u32);
    assert!(fpt_face_standing::FPT_FACE_ON_EDGE as u32 == Standing::OnEdge as u32);
    assert!(fpt_face_standing::FPT_FACE_UNKNOWN as u32 == Standing::Unknown as u32);
};

/// The input of fpt_face_new. Copied: nothing is borrowed after the call.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct fpt_face_data {
    /// sizeof(fpt_face_data).
    pub struct_size: usize,
    /// A surface of any kind.
    pub surface: *const fpt_surface,
    /// At least 1.
    pub loop_count: usize,
    /// For each loop the number of its pcurves, at least 1.
    pub coedge_counts: *const usize,
    /// The pcurves of all loops, one after the other: spline curves with z = 0 in the domain of the surface, each beginning
    /// where the one before ends, up to a gap that a line closes. A region across a seam is bounded on both sides of it.
    pub pcurves: *const *const fpt_curve,
}

// SAFETY: repr(C), begins with struct_size; numbers and raw pointers.
unsafe impl SelfSized for fpt_face_data {
    const SHORTER: &'static [usize] = &[];

    fn defaults() -> Self {
        Self {
            struct_size: size_of::<Self>(),
            surface: std::ptr::null(),
            loop_count: 0,
            coedge_counts: std::ptr::null(),
            pcurves: std::ptr::null(),
        }
    }
}

/// How a face is prepared. Fill it with fpt_face_options_init. All zero after struct_size is the default of everything. Grows at the end
/// only.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct fpt_face_options {
    /// sizeof(fpt_face_options), set by fpt_face_options_init.
    pub struct_size: usize,
    /// Most spans of the images of all pcurves, which bounds time and memory; 0: 10,000,000. What would take more is FPT_UNSUPPORTED.
    pub budget: u64,
    /// Asked on the calling thread between pcurves, and every 64 spans of long ones; non-zero ends the call with FPT_CANCELLED. NULL: never.
    pub should_stop: Option<unsafe extern "C" fn(user: *mut c_void) -> c_int>,
    /// Told on the calling thread how many pcurves are done, of how many. NULL: not wanted.
    pub progress: Option<unsafe extern "C" fn(user: *mut c_void, done: usize, total: usize)>,
    /// Handed to both as it is.
    pub user: *mut c_void,
}

impl Default for fpt_face_options {
    fn default() -> Self {
        Self {
            struct_size: size_of::<Self>(),
            budget: 0,
            should_stop: None,
            progress: None,
            user: std::ptr::null_mut(),
        }
    }
}

// SAFETY: repr(C), begins with struct_size; numbers, a raw pointer and nullable function pointers.
unsafe impl SelfSized for fpt_face_options {
    const SHORTER: &'static [usize] = &[
        offset_of!(Self, budget),
        offset_of!(Self, should_stop),
        offset_of!(Self, progress),
        offset_of!(Self, user),
    ];

    fn defaults() -> Self {
        Self::default()
    }
}

/// Sets all options to their defaults.
///
/// @param options      room for struct_size bytes
/// @param struct_size  sizeof(fpt_face_options)
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_face_options_init(options: *mut fpt_face_options, struct_size: usize) {
    // SAFETY: the header asks for room for `struct_size` bytes.
    unsafe { initialise(options, struct_size) }
}

/// Prepares a face as the options say.
///
/// # Safety
/// NULL or a struct of the size that it says.
unsafe fn prepared(
    trim: &TrimmedSurface,
    options: *const fpt_face_options,
) -> Result<*mut fpt_face, Failure> {
    // SAFETY: the caller vouches for it.
    let given = unsafe { sized_or_default("options", options) }?;
    let callbacks = Callbacks::telling(given.should_stop, given.progress, given.user);
    let total = trim.coedges().count();
    let face = Face::new(trim, given.budget, &mut |done| callbacks.poll(done, total))?;
    callbacks.report(total, total);
    Ok(Box::into_raw(Box::new(fpt_face { face })))
}

/// A face prepared for queries: a surface and loops of pcurves. Immutable: any number of threads may use one at a time. Owned by the
/// caller, released by fpt_face_free; the handles that it was made from may be freed before or after it.
pub struct fpt_face {
    face: Face,
}

/// The face behind a handle.
///
/// # Safety
/// NULL or a live handle.
unsafe fn face<'a>(face: *const fpt_face) -> Result<&'a Face, Failure> {
    // SAFETY: the caller vouches for it.
    Ok(&unsafe { shared("face", face) }?.face)
}

/// Reads and checks the loops.
///
/// # Safety
/// NULL, or a struct with live handles and arrays of the documented lengths.
unsafe fn read(data: *const fpt_face_data) -> Result<TrimmedSurface, Failure> {
    // SAFETY: the caller vouches for the struct and its arrays.
    unsafe {
        let data = sized("data", data)?;
        let support = match surface::form(data.surface)? {
            SurfaceForm::Spline(surface) => Support::Spline(surface.clone()),
            SurfaceForm::Function(surface) => Support::Callback(surface.clone()),
        };
        let counts = array("coedge_counts", data.coedge_counts, data.loop_count)?;
        let mut total = 0usize;
        for (k, &count) in counts.iter().enumerate() {
            total = total.checked_add(count).ok_or_else(|| {
                Failure::invalid(format!("coedge_counts: entry {k} overflows the sum"))
            })?;
        }
        check_extent("pcurves", total, size_of::<*const fpt_curve>())?;
        let mut handles = array("pcurves", data.pcurves, total)?.iter();
        let mut loops = Vec::new();
        for (k, &count) in counts.iter().enumerate() {
            let mut coedges = Vec::new();
            for (i, &handle) in handles.by_ref().take(count).enumerate() {
                let curve = pcurve("pcurves", handle).map_err(|failure| at(failure, i, k))?;
                coedges.push(Coedge::alone(curve));
            }
            loops.push(if k == 0 { Loop::outer(coedges) } else { Loop::inner(coedges) });
        }
        Ok(TrimmedSurface::new(support, Vec::new(), loops, false)?)
    }
}

/// Names the pcurve that a failure is about.
fn at(failure: Failure, coedge: usize, chain: usize) -> Failure {
    let number = format!("pcurves: pcurve {coedge} of loop {chain}");
    match failure {
        Failure::Null(_) => Failure::invalid(format!("{number} is NULL")),
        Failure::Refused(Error::InvalidArgument(text)) => {
            Failure::invalid(format!("{number}: {}", text.trim_start_matches("pcurves: ")))
        }
        other => other,
    }
}

/// Prepares a face for queries. The face is where a ray in the domain crosses the loops an odd number of times: their direction
/// does not count, holes are what is inside of two. Cost: that of the surface's index, some microseconds a pcurve, some
/// milliseconds for one whose image must be fitted.
///
/// On a surface given by a function what is proven depends on the bounds that it was made with: none of its speed, and no distance
/// is (FPT_FOOT_NOT_PROVEN, FPT_STANDING_NOT_PROVEN); none of its second derivatives, and not where the nearest point is neither the surface's
/// nor that of the edges.
///
/// @param data     the inputs, copied
/// @param options  NULL: the defaults
/// @param out      the handle; release it with fpt_face_free
/// @return FPT_INVALID_ARGUMENT names loop and pcurve, also for one that leaves the domain by more than 1e-6 of it
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_face_new(
    data: *const fpt_face_data,
    options: *const fpt_face_options,
    out: *mut *mut fpt_face,
) -> fpt_status {
    // SAFETY: the header asks for a data struct, options and room for a handle.
    guard(|| unsafe {
        let out = place("out", out)?;
        *out = prepared(&read(data)?, options)?;
        Ok(())
    })
}

/// Prepares a trimmed surface for queries: as fpt_face_new, with the surface and the loops of `trim`; its edges in space play no part, the
/// border of a face is the image of its pcurves.
///
/// @param trim     a trimmed surface over any support
/// @param options  NULL: the defaults
/// @param out      the handle; release it with fpt_face_free. Parameters of answers are those of the support (angles of an elementary
///                 surface are angles), those of places the parameters of the coedges' pcurves
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_face_of_trim(
    trim: *const fpt_trim,
    options: *const fpt_face_options,
    out: *mut *mut fpt_face,
) -> fpt_status {
    // SAFETY: the header asks for a live handle, options and room for a handle.
    guard(|| unsafe {
        let trim = trim::face("trim", trim)?;
        let out = place("out", out)?;
        *out = prepared(trim, options)?;
        Ok(())
    })
}

/// Releases a face. NULL is fine. No other call may use the handle during or after this one.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_face_free(face: *mut fpt_face) {
    let release = || {
        if !face.is_null() {
            // SAFETY: a handle comes from Box::into_raw and is released once.
            drop(unsafe { Box::from_raw(face) });
        }
        Ok(())
    };
    let _ = guard(release);
}

/// Refuses what a face has no use for.
fn check(given: &fpt_query_options, options: &QueryOptions) -> Result<(), Failure> {
    let refuse = |text: &str| Err(Error::Unsupported(text.into()).into());
    if options.domain.is_some() {
        return refuse("domain: a face has no restriction");
    }
    if given.trace.is_some() {
        return refuse("trace: a face tells no iterations");
    }
    if options.scope == Scope::Local {
        return refuse("scope: a face answers globally");
    }
    Ok(())
}

/// On which side of its edges places of the domain lie: inside, outside, or within options->tolerance of an edge, in space.
///
/// Sides are exact: only places nearer to a pcurve than the rounding of its poles, some 1e-13 of them, cannot be told from places on it,
/// and these are on the edge for any tolerance that is not smaller. Places outside the domain are outside.
///
/// @param uv       `count` pairs u,v, packed. A pair that is not finite is FPT_FACE_UNKNOWN
/// @param count    may be 0, then `uv` and `out` may be NULL
/// @param options  tolerance (0: 1e-7 x the diagonal of the surface's box), budget, threads, should_stop and progress count;
///                 NULL: the defaults
/// @param out      `count` places
/// @return FPT_CANCELLED when should_stop said so; then the places not reached are FPT_FACE_UNKNOWN
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_face_classify(
    face: *const fpt_face,
    uv: *const f64,
    count: usize,
    options: *const fpt_query_options,
    out: *mut fpt_face_place,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and arrays of these lengths that do not overlap.
    guard(|| unsafe {
        let face = self::face(face)?;
        let given = fpt_query_options::read(options)?;
        let options = given.checked(4)?;
        check(&given, &options)?;
        check_extent("uv", count, 16)?;
        let at = array("uv", uv.cast::<[f64; 2]>(), count)?;
        // The caller's memory may hold anything: it is written before it is read as places.
        let raw = output("out", out, count)?;
        raw.fill(fpt_face_place {
            standing: 3,
            loop_index: u32::MAX,
            coedge_index: u32::MAX,
            flags: 0,
            parameter: f64::NAN,
        });
        let out = output("out", out.cast::<Place>(), count)?;
        let callbacks = Callbacks::of(&given);
        let threads = given.thread_count();
        face.classify_all(&|i| at[i], &options, threads, out, &mut || callbacks.poll(0, count))?;
        callbacks.report(count, count);
        Ok(())
    })
}

/// The nearest point of the face for each query point, with a proven lower bound of the distance: as fpt_surface_closest, for the
/// part of the surface that the loops leave.
///
/// Where the nearest point of the surface is inside, it is the answer. Otherwise the nearest point of the edges is, unless the surface
/// has a nearer stationary point inside the face: all of those are looked for, with proof that none is missing.
///
/// @param points     `count` query points x,y,z, options->point_stride bytes apart. A bad point (NaN, infinite, beyond 1e100)
///                   marks its own record with FPT_FOOT_BAD_QUERY
/// @param count      may be 0, then all arrays may be NULL
/// @param options    NULL: the defaults. `domain` must be all 0, `scope` global and `trace` NULL: FPT_UNSUPPORTED. The
///                   tolerance tells from where on a foot is on an edge; the budget is that of each search
/// @param out        `count` records, packed; must not overlap `points` or the hints. FPT_FOOT_EDGE, _CORNER, _SEAM and _COLLAPSED are
///                   about the domain of the surface
/// @param out_places `count` places: where on the face the foot lies; NULL: not wanted
/// @return as fpt_surface_closest
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_face_closest(
    face: *const fpt_face,
    points: *const f64,
    count: usize,
    options: *const fpt_query_options,
    out: *mut fpt_foot_point,
    out_places: *mut fpt_face_place,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and arrays of these lengths that do not overlap; three atomic numbers have
    // the layout of a place.
    guard(|| unsafe {
        let face = self::face(face)?;
        let given = fpt_query_options::read(options)?;
        let options = given.checked(4)?;
        check(&given, &options)?;
        let points = Strided::new(("points", points), count, ("point_stride", given.point_stride))?;
        let hints: Option<Strided<2>> = if given.hints.is_null() {
            None
        } else {
            let stride = ("hint_stride", given.hint_stride);
            Some(Strided::new(("hints", given.hints), count, stride)?)
        };
        hints.as_ref().map_or(Ok(()), check_hints)?;
        let places = optional_output("out_places", out_places.cast::<[AtomicU64; 3]>(), count)?;
        let places: Option<&[[AtomicU64; 3]]> = places.map(|places| &*places);
        let out = feet(out, count)?;
        let store = |place: &[AtomicU64; 3], value: Place| {
            for (number, word) in place.iter().zip(words(value)) {
                number.store(word, Ordering::Relaxed);
            }
        };
        places.into_iter().flatten().for_each(|place| store(place, Place::off(Standing::Unknown)));
        let [u0, u1, v0, v1] = face.support().domain();
        let hint = |i: usize| {
            let [u, v] = hints.as_ref()?.row(i);
            (!u.is_nan() && !v.is_nan()).then(|| [u.clamp(u0, u1), v.clamp(v0, v1)])
        };
        let work = |i: usize, workspace: &mut FaceWorkspace| {
            let (foot, found) = face.closest(points.row(i), hint(i), &options, workspace);
            if let Some(places) = places {
                store(&places[i], found);
            }
            foot
        };
        let callbacks = Callbacks::of(&given);
        let row = |i: usize| points.row(i);
        let order: Option<batch::Place> =
            if face.surface_memory() > LARGE { Some(&row) } else { None };
        let threads = given.thread_count();
        batch::run(out, threads, order, &work, &mut |done| callbacks.poll(done, count))?;
        callbacks.report(count, count);
        Ok(())
    })
}

/// A place as three numbers of 64 bits.
fn words(place: Place) -> [u64; 3] {
    // SAFETY: repr(C), 24 bytes without padding; any bits are numbers.
    unsafe { std::mem::transmute::<Place, [u64; 3]>(place) }
}

/// All parameters of the face whose point lies within a tolerance of a point, with proof that none is missing: the members of
/// fpt_surface_preimage that lie in the face or within the tolerance of its edges.
///
/// @param point      3 finite numbers
/// @param tolerance  length, finite, >= 0; 0: 1e-7 x the diagonal of the surface's box
/// @param options    budget, should_stop and user count; NULL: the defaults. `domain` must be all 0
/// @param out        the set; release it with fpt_foot_set_free. Intervals of arcs and regions are those on the surface
/// @return FPT_BUDGET_EXHAUSTED with a set that misses what lies in its undecided boxes: also arcs of which only a sliver may belong
///         to the face
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_face_preimage(
    face: *const fpt_face,
    point: *const f64,
    tolerance: f64,
    options: *const fpt_query_options,
    out: *mut *mut fpt_foot_set,
) -> fpt_status {
    // SAFETY: the header asks for a live handle, three numbers, options and room for a handle.
    guard(|| unsafe {
        let face = self::face(face)?;
        let query = self::point("point", point)?;
        check_length("tolerance", tolerance)?;
        let given = fpt_query_options::read(options)?;
        let options = given.checked(4)?;
        check(&given, &options)?;
        let out = place("out", out)?;
        let callbacks = Callbacks::of(&given);
        let set = face.preimage(query, tolerance, &options, &mut || callbacks.poll(0, 1))?;
        hand_over(set, out)
    })
}

// The record that the batch layer fills has the layout of the C one.
const _: () = assert!(size_of::<FootPoint>() == size_of::<fpt_foot_point>());
