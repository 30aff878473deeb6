//! Sets of feet: preimages and extrema.
//!
//! A set is a handle of its own: the sizes are not known beforehand. It is written when it is complete and also when the
//! budget ran out (then with FPT_BUDGET_EXHAUSTED and the boxes that are undecided); any other failure writes nothing.

use super::curve::{self, fpt_curve};
use super::memory::{array, place, shared};
use super::options::{SelfSized, check_length, fpt_query_options, restriction, sized};
use super::query::{Callbacks, check_restriction};
use super::records::fpt_foot_point;
use super::surface::{self, fpt_surface};
use super::{Failure, fpt_status, guard};
use crate::closest::GREATEST_COORDINATE;
use crate::error::Error;
use crate::extrema::ExtremaOptions;
use crate::set::{FootSet, Kind, Member, Nature};
use std::ffi::{c_int, c_void};
use std::mem::{align_of, offset_of, size_of};

/// A set of feet. Immutable: any number of threads may read one at a time. Owned by the caller, released by
/// fpt_foot_set_free; it does not refer to the shape that it came from.
pub struct fpt_foot_set {
    set: FootSet,
}

/// What the parameters of a member form, for fpt_foot_member.kind.
#[repr(C)]
pub enum fpt_member_kind {
    /// One place. The intervals enclose what the tolerance leaves open.
    FPT_MEMBER_POINT = 0,
    /// An interval of u with v fixed: every u in it gives the point (preimage) or the distance (extrema).
    FPT_MEMBER_ARC_U = 1,
    /// An interval of v with u fixed.
    FPT_MEMBER_ARC_V = 2,
    /// Both parameters vary.
    FPT_MEMBER_REGION = 3,
}

/// What the distance does around a member, for fpt_foot_member.nature. On a border of the domain only points of
/// the domain count.
#[repr(C)]
pub enum fpt_member_nature {
    /// Nothing around is nearer.
    FPT_NATURE_MINIMUM = 0,
    /// Nothing around is farther.
    FPT_NATURE_MAXIMUM = 1,
    /// Nearer in some directions, farther in others.
    FPT_NATURE_SADDLE = 2,
    /// It does not change to second order, and samples around do not tell.
    FPT_NATURE_FLAT = 3,
}

/// A member of a set: 104 bytes, frozen.
#[repr(C)]
pub struct fpt_foot_member {
    /// The representative. Its lower_bound is 0. FPT_FOOT_NOT_PROVEN: in a preimage, a place within the tolerance could
    /// be neither found nor excluded here; in extrema, the intervals may hold more than one stationary point, or places
    /// where the distance differs by more than the accuracy.
    pub foot: fpt_foot_point,
    /// Least and greatest u that belong to the member; they enclose, rounding included.
    pub u: [f64; 2],
    /// Least and greatest v; 0, 0 on a curve.
    pub v: [f64; 2],
    /// A value of fpt_member_kind.
    pub kind: u32,
    /// A value of fpt_member_nature.
    pub nature: u32,
}

// Members are copied out as they are: the layouts must agree.
const _: () = {
    assert!(size_of::<fpt_foot_member>() == 104 && size_of::<Member>() == 104);
    assert!(align_of::<fpt_foot_member>() == align_of::<Member>());
    assert!(offset_of!(fpt_foot_member, foot) == offset_of!(Member, foot));
    assert!(offset_of!(fpt_foot_member, u) == offset_of!(Member, u));
    assert!(offset_of!(fpt_foot_member, v) == offset_of!(Member, v));
    assert!(offset_of!(fpt_foot_member, kind) == offset_of!(Member, kind));
    assert!(offset_of!(fpt_foot_member, nature) == offset_of!(Member, nature));
    assert!(fpt_member_kind::FPT_MEMBER_POINT as u32 == Kind::Point as u32);
    assert!(fpt_member_kind::FPT_MEMBER_ARC_U as u32 == Kind::ArcU as u32);
    assert!(fpt_member_kind::FPT_MEMBER_ARC_V as u32 == Kind::ArcV as u32);
    assert!(fpt_member_kind::FPT_MEMBER_REGION as u32 == Kind::Region as u32);
    assert!(fpt_member_nature::FPT_NATURE_MINIMUM as u32 == Nature::Minimum as u32);
    assert!(fpt_member_nature::FPT_NATURE_MAXIMUM as u32 == Nature::Maximum as u32);
    assert!(fpt_member_nature::FPT_NATURE_SADDLE as u32 == Nature::Saddle as u32);
    assert!(fpt_member_nature::FPT_NATURE_FLAT as u32 == Nature::Flat as u32);
};

/// Which stationary points to list. Fill it with fpt_extrema_options_init, then change what matters. All zero
/// after struct_size is the default of everything. Grows at the end only.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct fpt_extrema_options {
    /// sizeof(fpt_extrema_options), set by fpt_extrema_options_init.
    pub struct_size: usize,
    /// Length, finite, >= 0. Places whose distances differ by less along the way between them may come out as one
    /// member. 0: 1e-10 x the diagonal of the shape's box.
    pub accuracy: f64,
    /// Length, finite, >= 0. Only points at most this far from the query. 0: all.
    pub radius: f64,
    /// At most this many, the nearest. 0: all.
    pub nearest: usize,
    /// 1: only minima (and members of nature flat); 0: all.
    pub minima_only: u32,
    /// Must be 0.
    pub reserved: u32,
    /// Restricts the answers to u0,u1,v0,v1 inside the domain; the ends of the restriction count as borders.
    /// All 0: the whole domain. On a curve only u0,u1 count.
    pub domain: [f64; 4],
    /// Most boxes; 0: the default, 20,000.
    pub budget: u64,
    /// Asked on the calling thread now and then, between pieces of the shape; non-zero ends the call with
    /// FPT_CANCELLED. NULL: never.
    pub should_stop: Option<unsafe extern "C" fn(user: *mut c_void) -> c_int>,
    /// Handed to should_stop as it is.
    pub user: *mut c_void,
}

impl Default for fpt_extrema_options {
    fn default() -> Self {
        Self {
            struct_size: size_of::<Self>(),
            accuracy: 0.0,
            radius: 0.0,
            nearest: 0,
            minima_only: 0,
            reserved: 0,
            domain: [0.0; 4],
            budget: 0,
            should_stop: None,
            user: std::ptr::null_mut(),
        }
    }
}

// SAFETY: repr(C), begins with struct_size; numbers, a raw pointer and a nullable function pointer.
unsafe impl SelfSized for fpt_extrema_options {
    const SHORTER: &'static [usize] = &[
        offset_of!(Self, accuracy),
        offset_of!(Self, radius),
        offset_of!(Self, nearest),
        offset_of!(Self, minima_only),
        offset_of!(Self, reserved),
        offset_of!(Self, domain),
        offset_of!(Self, budget),
        offset_of!(Self, should_stop),
        offset_of!(Self, user),
    ];

    fn defaults() -> Self {
        Self::default()
    }
}

/// Fills `options` with the defaults. Touches exactly struct_size bytes: pass sizeof *options.
/// Does nothing when `options` is NULL or struct_size is smaller than a size_t.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_extrema_options_init(
    options: *mut fpt_extrema_options,
    struct_size: usize,
) {
    if options.is_null() || struct_size < size_of::<usize>() {
        return;
    }
    let known = struct_size.min(size_of::<fpt_extrema_options>());
    let defaults = fpt_extrema_options { struct_size, ..Default::default() };
    let source = (&raw const defaults).cast::<u8>();
    let target = options.cast::<u8>();
    // SAFETY: the caller's struct has `struct_size` bytes; `defaults` has no padding before `known`.
    unsafe {
        source.copy_to_nonoverlapping(target, known);
        target.add(known).write_bytes(0, struct_size - known);
    }
}

impl fpt_extrema_options {
    /// The caller's options, or the defaults for NULL.
    ///
    /// # Safety
    /// As [`sized`].
    unsafe fn read(options: *const Self) -> Result<Self, Failure> {
        if options.is_null() {
            return Ok(Self::default());
        }
        // SAFETY: the caller vouches for it.
        unsafe { sized("options", options) }
    }

    fn checked(&self, used: usize) -> Result<ExtremaOptions, Failure> {
        check_length("accuracy", self.accuracy)?;
        check_length("radius", self.radius)?;
        let zero_or_one = |name: &str, value: u32, most: u32| {
            if value <= most {
                return Ok(());
            }
            let wanted = if most == 0 { "must be 0" } else { "is not 0 or 1" };
            Err(Failure::invalid(format!("{name}: {value} {wanted}")))
        };
        zero_or_one("minima_only", self.minima_only, 1)?;
        zero_or_one("reserved", self.reserved, 0)?;
        Ok(ExtremaOptions {
            accuracy: self.accuracy,
            radius: self.radius,
            nearest: self.nearest,
            minima_only: self.minima_only == 1,
            domain: restriction(&self.domain[..used])?,
            budget: self.budget,
        })
    }

    fn callbacks(&self) -> Callbacks {
        Callbacks::stopping(self.should_stop, self.user)
    }
}

/// One point that must be finite: a set has no record to mark.
///
/// # Safety
/// NULL or three numbers.
pub(super) unsafe fn point(name: &'static str, numbers: *const f64) -> Result<[f64; 3], Failure> {
    // SAFETY: the caller vouches for it.
    let list = unsafe { array(name, numbers, 3) }?;
    let bad = |x: &f64| !x.is_finite() || x.abs() > GREATEST_COORDINATE;
    match list.iter().position(bad) {
        Some(k) => {
            let text = format!("{name}: entry {k} is not finite or beyond {GREATEST_COORDINATE:e}");
            Err(Failure::invalid(text))
        }
        None => Ok([list[0], list[1], list[2]]),
    }
}

/// Hands a set over, complete or not.
pub(super) fn hand_over(set: FootSet, out: &mut *mut fpt_foot_set) -> Result<(), Failure> {
    let left = set.undecided.len();
    *out = Box::into_raw(Box::new(fpt_foot_set { set }));
    if left == 0 {
        return Ok(());
    }
    let text =
        format!("budget: ran out with {left} boxes undecided; see fpt_foot_set_undecided_get");
    Err(Failure::Budget(text))
}

/// All parameters of a curve whose point lies within a tolerance of a point, with proof that none is missing.
///
/// Isolated parameters are members of kind point (a closed curve's seam gives two, a self-intersection as many as
/// branches), spans without length are arcs. Members come in the order of u.
///
/// @param point      3 finite numbers
/// @param tolerance  length, finite, >= 0; 0: 1e-7 x the diagonal of the curve's box. Never less than the rounding
///                   of curve and point
/// @param options    domain, budget (0: 20,000 boxes; a shape from a callback: 100,000), should_stop and user
///                   count; NULL: the defaults
/// @param out        the set; release it with fpt_foot_set_free. Empty when nothing is within the tolerance
/// @return FPT_BUDGET_EXHAUSTED with a set that misses what lies in its undecided intervals; of a curve from a
///         callback without the bounds that it takes, always, with the whole domain undecided
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_curve_preimage(
    curve: *const fpt_curve,
    point: *const f64,
    tolerance: f64,
    options: *const fpt_query_options,
    out: *mut *mut fpt_foot_set,
) -> fpt_status {
    // SAFETY: the header asks for a live handle, three numbers, options and room for a handle.
    guard(|| unsafe {
        let curve = curve::form(curve)?;
        let query = self::point("point", point)?;
        check_length("tolerance", tolerance)?;
        let given = fpt_query_options::read(options)?;
        let options = given.checked(2)?;
        check_restriction(curve, options.domain)?;
        let out = place("out", out)?;
        let callbacks = Callbacks::of(&given);
        let set = curve.preimage(query, tolerance, &options, &mut || callbacks.poll(0, 1))?;
        hand_over(set, out)
    })
}

/// All parameters of a surface whose point lies within a tolerance of a point, with proof that none is missing.
///
/// A point on a seam has two members (at a corner of two seams four), a self-intersection as many as branches; collapsed
/// edges and strips without width are arcs. Members come in the order of u, then v, so that the canonical one of a
/// seam is first.
///
/// @param point      3 finite numbers
/// @param tolerance  length, finite, >= 0; 0: 1e-7 x the diagonal of the surface's box. Never less than the rounding
///                   of surface and point
/// @param options    domain, budget (0: 20,000 boxes; a shape from a callback: 100,000), should_stop and user
///                   count; NULL: the defaults
/// @param out        the set; release it with fpt_foot_set_free. Empty when nothing is within the tolerance
/// @return FPT_BUDGET_EXHAUSTED with a set that misses what lies in its undecided boxes; of a surface from a
///         callback without the bounds that it takes, always, with the whole domain undecided
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_preimage(
    surface: *const fpt_surface,
    point: *const f64,
    tolerance: f64,
    options: *const fpt_query_options,
    out: *mut *mut fpt_foot_set,
) -> fpt_status {
    // SAFETY: the header asks for a live handle, three numbers, options and room for a handle.
    guard(|| unsafe {
        let surface = surface::form(surface)?;
        let query = self::point("point", point)?;
        check_length("tolerance", tolerance)?;
        let given = fpt_query_options::read(options)?;
        let options = given.checked(4)?;
        check_restriction(surface, options.domain)?;
        let out = place("out", out)?;
        let callbacks = Callbacks::of(&given);
        let set = surface.preimage(query, tolerance, &options, &mut || callbacks.poll(0, 1))?;
        hand_over(set, out)
    })
}

/// All points of a curve where the distance from a point is stationary, with proof that none is missing: nearest first.
///
/// Ends of the curve (not of a closed one) and of a restriction count: minimum or maximum among the points of the
/// domain. At a break of the tangent the distance must rise or fall to both sides.
///
/// @param point    3 finite numbers
/// @param options  NULL: the defaults
/// @param out      the set; release it with fpt_foot_set_free
/// @return FPT_BUDGET_EXHAUSTED with a set that misses what lies in its undecided intervals; of a curve from a
///         callback without the bounds that it takes, always, with the whole domain undecided
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_curve_extrema(
    curve: *const fpt_curve,
    point: *const f64,
    options: *const fpt_extrema_options,
    out: *mut *mut fpt_foot_set,
) -> fpt_status {
    // SAFETY: the header asks for a live handle, three numbers, options and room for a handle.
    guard(|| unsafe {
        let curve = curve::form(curve)?;
        let query = self::point("point", point)?;
        let given = fpt_extrema_options::read(options)?;
        let options = given.checked(2)?;
        check_restriction(curve, options.domain)?;
        let out = place("out", out)?;
        let callbacks = given.callbacks();
        let set = curve.extrema(query, &options, &mut || callbacks.poll(0, 1))?;
        hand_over(set, out)
    })
}

/// All points of a surface where the distance from a point is stationary, with proof that none is missing: nearest first.
///
/// Inside: minima, maxima, saddles. On the border of the domain (not on seams) and of a restriction: points where
/// the distance is stationary along the border, and corners; they are minimum, maximum or saddle among the points of
/// the domain. On creases: points where it is stationary along the crease and rises or falls to both sides. A collapsed
/// edge counts when it is a minimum or maximum. Continua (the axis of a surface of revolution, the centre of a
/// sphere) are arcs or regions with FPT_FOOT_CONTINUUM.
///
/// @param point    3 finite numbers
/// @param options  NULL: the defaults
/// @param out      the set; release it with fpt_foot_set_free
/// @return FPT_BUDGET_EXHAUSTED with a set that misses what lies in its undecided boxes; of a surface from a
///         callback without the bounds that it takes, always, with the whole domain undecided
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_extrema(
    surface: *const fpt_surface,
    point: *const f64,
    options: *const fpt_extrema_options,
    out: *mut *mut fpt_foot_set,
) -> fpt_status {
    // SAFETY: the header asks for a live handle, three numbers, options and room for a handle.
    guard(|| unsafe {
        let surface = surface::form(surface)?;
        let query = self::point("point", point)?;
        let given = fpt_extrema_options::read(options)?;
        let options = given.checked(4)?;
        check_restriction(surface, options.domain)?;
        let out = place("out", out)?;
        let callbacks = given.callbacks();
        let set = surface.extrema(query, &options, &mut || callbacks.poll(0, 1))?;
        hand_over(set, out)
    })
}

/// The number of members.
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_foot_set_count(
    set: *const fpt_foot_set,
    out_count: *mut usize,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for a number.
    guard(|| unsafe {
        let set = &shared("set", set)?.set;
        *place("out_count", out_count)? = set.members.len();
        Ok(())
    })
}

/// A member.
///
/// @param index  below the count, else FPT_INVALID_ARGUMENT
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_foot_set_get(
    set: *const fpt_foot_set,
    index: usize,
    out: *mut fpt_foot_member,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for a member; the layouts agree (above).
    guard(|| unsafe {
        let members = &shared("set", set)?.set.members;
        let member = members.get(index).ok_or_else(|| beyond(index, members.len()))?;
        *place("out", out.cast::<Member>())? = *member;
        Ok(())
    })
}

/// The number of boxes that are undecided: 0 for a complete set.
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_foot_set_undecided_count(
    set: *const fpt_foot_set,
    out_count: *mut usize,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for a number.
    guard(|| unsafe {
        let set = &shared("set", set)?.set;
        *place("out_count", out_count)? = set.undecided.len();
        Ok(())
    })
}

/// A box that is undecided: more members may lie in it.
///
/// @param index   below the count, else FPT_INVALID_ARGUMENT
/// @param out_uv  4 numbers: start and end of u, start and end of v (0, 0 on a curve)
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_foot_set_undecided_get(
    set: *const fpt_foot_set,
    index: usize,
    out_uv: *mut f64,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for four numbers.
    guard(|| unsafe {
        let boxes = &shared("set", set)?.set.undecided;
        let area = boxes.get(index).ok_or_else(|| beyond(index, boxes.len()))?;
        super::memory::write_array("out_uv", area, 4, out_uv)
    })
}

/// Releases a set. NULL is fine. No other call may use the handle during or after this one.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_foot_set_free(set: *mut fpt_foot_set) {
    let release = || {
        if !set.is_null() {
            // SAFETY: a handle comes from Box::into_raw and is released once.
            drop(unsafe { Box::from_raw(set) });
        }
        Ok(())
    };
    let _ = guard(release);
}

fn beyond(index: usize, count: usize) -> Failure {
    Error::InvalidArgument(format!("index: {index} is not below the count of {count}")).into()
}
