//! Pcurves: pull-back of edges, lift, deviation.

use super::curve::{self, fpt_curve};
use super::form::CurveForm;
use super::memory::{array, optional_output, place, shared};
use super::options::{SelfSized, check_length, sized};
use super::query::Callbacks;
use super::surface::{self, fpt_surface};
use super::{Failure, fpt_status, guard};
use crate::curve::Curve;
use crate::error::Error;
use crate::index::IndexedCurve;
use crate::pcurve::Pcurve;
use crate::pcurve::compose::Composer;
use crate::pcurve::deviation::{Deviation, deviation};
use crate::pcurve::lift::{EXACT_DEGREE, LiftOptions, lift};
use crate::pcurve::pull::{PullOptions, Pulled, pulled};
use std::ffi::{c_int, c_void};
use std::mem::{offset_of, size_of};
use std::sync::Arc;

/// Bits of fpt_deviation.flags.
#[repr(C)]
#[derive(Clone, Copy)]
pub enum fpt_deviation_flag {
    /// The proven bound exceeds the tolerance.
    FPT_DEVIATION_NOT_PROVEN = 1,
    /// Pull: the edge is proven to leave the surface by more than the tolerance.
    FPT_DEVIATION_NOT_ON_SURFACE = 2,
    /// Pull: the piece runs along the seam of u; the other end of u is as good.
    FPT_DEVIATION_ALONG_SEAM_U = 4,
    /// Pull: the piece runs along the seam of v.
    FPT_DEVIATION_ALONG_SEAM_V = 8,
    /// Pull: the edge crosses a seam where the piece begins.
    FPT_DEVIATION_FROM_SEAM = 16,
    /// Pull: the edge crosses a seam where the piece ends.
    FPT_DEVIATION_TO_SEAM = 32,
    /// Pull: the piece begins on a collapsed edge of the surface.
    FPT_DEVIATION_FROM_COLLAPSED = 64,
    /// Pull: the piece ends on a collapsed edge of the surface.
    FPT_DEVIATION_TO_COLLAPSED = 128,
    /// Lift: the curve is the image up to rounding, not fitted.
    FPT_DEVIATION_EXACT = 256,
}

const _: () = {
    assert!(fpt_deviation_flag::FPT_DEVIATION_NOT_PROVEN as u32 == pulled::NOT_PROVEN);
    assert!(fpt_deviation_flag::FPT_DEVIATION_NOT_ON_SURFACE as u32 == pulled::NOT_ON_SURFACE);
    assert!(fpt_deviation_flag::FPT_DEVIATION_ALONG_SEAM_U as u32 == pulled::ALONG_SEAM_U);
    assert!(fpt_deviation_flag::FPT_DEVIATION_ALONG_SEAM_V as u32 == pulled::ALONG_SEAM_V);
    assert!(fpt_deviation_flag::FPT_DEVIATION_FROM_SEAM as u32 == pulled::FROM_SEAM);
    assert!(fpt_deviation_flag::FPT_DEVIATION_TO_SEAM as u32 == pulled::TO_SEAM);
    assert!(fpt_deviation_flag::FPT_DEVIATION_FROM_COLLAPSED as u32 == pulled::FROM_COLLAPSED);
    assert!(fpt_deviation_flag::FPT_DEVIATION_TO_COLLAPSED as u32 == pulled::TO_COLLAPSED);
};

/// How far a curve in space is from the image of a pcurve, at equal parameters: 32 bytes, frozen.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct fpt_deviation {
    /// Proven: nowhere more than this, rounding included.
    pub bound: f64,
    /// The greatest distance found, up to rounding; bound - reached is what the proof leaves open.
    pub reached: f64,
    /// The parameter where it was found.
    pub at: f64,
    /// Sum of fpt_deviation_flag values.
    pub flags: u32,
    /// 0.
    pub reserved: u32,
}

impl fpt_deviation {
    fn of(deviation: Deviation, flags: u32) -> Self {
        let Deviation { bound, reached, at } = deviation;
        Self { bound, reached, at, flags, reserved: 0 }
    }
}

/// How to pull an edge back. Fill it with fpt_pull_options_init, then change what matters. All zero after struct_size is the
/// default of everything. Grows at the end only.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct fpt_pull_options {
    /// sizeof(fpt_pull_options), set by fpt_pull_options_init.
    pub struct_size: usize,
    /// Length, finite, >= 0: greatest distance between edge and image at equal parameters. 0: 1e-7 x the diagonal of the
    /// surface's box.
    pub tolerance: f64,
    /// Degree of fitted pcurves, 1 to 9. 0: 3, or 5 for tolerances below 1e-8 x the diagonal.
    pub degree: usize,
    /// Most poles of a pcurve; 0: 2000.
    pub pole_limit: usize,
    /// 2 finite numbers u,v near the edge's start, where more than one place of the surface is as near: seams,
    /// self-intersections. Along a seam the nearer end of the domain is taken. NULL: none. Borrowed during the call.
    pub hint: *const f64,
    /// Asked on the calling thread now and then; non-zero ends the call with FPT_CANCELLED. NULL: never.
    pub should_stop: Option<unsafe extern "C" fn(user: *mut c_void) -> c_int>,
    /// Handed to should_stop as it is.
    pub user: *mut c_void,
}

impl Default for fpt_pull_options {
    fn default() -> Self {
        Self {
            struct_size: size_of::<Self>(),
            tolerance: 0.0,
            degree: 0,
            pole_limit: 0,
            hint: std::ptr::null(),
            should_stop: None,
            user: std::ptr::null_mut(),
        }
    }
}

// SAFETY: repr(C), begins with struct_size; numbers, raw pointers and a nullable function pointer.
unsafe impl SelfSized for fpt_pull_options {
    const SHORTER: &'static [usize] = &[
        offset_of!(Self, tolerance),
        offset_of!(Self, degree),
        offset_of!(Self, pole_limit),
        offset_of!(Self, hint),
        offset_of!(Self, should_stop),
        offset_of!(Self, user),
    ];

    fn defaults() -> Self {
        Self::default()
    }
}

/// How to lift a pcurve. Fill it with fpt_lift_options_init, then change what matters. All zero after struct_size is the
/// default of everything. Grows at the end only.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct fpt_lift_options {
    /// sizeof(fpt_lift_options), set by fpt_lift_options_init.
    pub struct_size: usize,
    /// Length, finite, >= 0: greatest deviation of a fitted image. 0: 1e-7 x the diagonal of the surface's box.
    pub tolerance: f64,
    /// Exact images may have at most this degree, 1 to 31: that of the pcurve times the sum of the surface's. Isocurves always
    /// are exact. 0: 6.
    pub exact_degree: usize,
}

impl Default for fpt_lift_options {
    fn default() -> Self {
        Self { struct_size: size_of::<Self>(), tolerance: 0.0, exact_degree: 0 }
    }
}

// SAFETY: repr(C), begins with struct_size; numbers.
unsafe impl SelfSized for fpt_lift_options {
    const SHORTER: &'static [usize] =
        &[offset_of!(Self, tolerance), offset_of!(Self, exact_degree)];

    fn defaults() -> Self {
        Self::default()
    }
}

/// Writes the defaults into the first `struct_size` bytes of an option struct, zeros behind what is known.
///
/// # Safety
/// `options` is NULL or has `struct_size` bytes; `defaults` has no padding.
unsafe fn init<T: Copy>(options: *mut T, struct_size: usize, defaults: T) {
    if options.is_null() || struct_size < size_of::<usize>() {
        return;
    }
    let known = struct_size.min(size_of::<T>());
    let source = (&raw const defaults).cast::<u8>();
    let target = options.cast::<u8>();
    // SAFETY: the caller vouches for it.
    unsafe {
        source.copy_to_nonoverlapping(target, known);
        target.add(known).write_bytes(0, struct_size - known);
    }
}

/// Fills `options` with the defaults. Touches exactly struct_size bytes: pass sizeof *options.
/// Does nothing when `options` is NULL or struct_size is smaller than a size_t.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_pull_options_init(options: *mut fpt_pull_options, struct_size: usize) {
    // SAFETY: the header asks for struct_size bytes; the fields of this struct leave no gaps.
    unsafe { init(options, struct_size, fpt_pull_options { struct_size, ..Default::default() }) }
}

/// Fills `options` with the defaults. Touches exactly struct_size bytes: pass sizeof *options.
/// Does nothing when `options` is NULL or struct_size is smaller than a size_t.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_lift_options_init(options: *mut fpt_lift_options, struct_size: usize) {
    // SAFETY: the header asks for struct_size bytes; the fields of this struct leave no gaps.
    unsafe { init(options, struct_size, fpt_lift_options { struct_size, ..Default::default() }) }
}

/// The pcurves of an edge, in its order. Immutable. Owned by the caller, released by fpt_pcurve_set_free; it does not refer to
/// the handles that it came from.
pub struct fpt_pcurve_set {
    pulled: Pulled,
}

/// A curve of a parameter plane behind a handle.
///
/// # Safety
/// NULL or a live handle.
pub(super) unsafe fn pcurve(
    name: &'static str,
    curve: *const fpt_curve,
) -> Result<Pcurve, Failure> {
    if curve.is_null() {
        return Err(Failure::Null(name));
    }
    // SAFETY: the caller vouches for it.
    let curve = unsafe { curve::indexed(curve) }?.curve().clone();
    Pcurve::spline(curve).map_err(|error| match error {
        Error::InvalidArgument(text) => Failure::invalid(format!("{name}: {text}")),
        other => other.into(),
    })
}

/// The pcurves of an edge: curves u,v,0 in the domain of the surface whose images are the edge, up to a proven deviation, with
/// the edge's parameter.
///
/// The edge is inverted along its way, with proof, and followed over seams; where it crosses a seam or meets a collapsed edge the
/// pcurve is cut, since the domain demands it: the pieces there end and begin on the border of the domain, bit for bit. A line
/// is taken where it is near enough, otherwise a spline by least squares, whose knots are added until the bound of the
/// deviation is below the tolerance. The bound holds at all parameters, not at samples: no piece leaves the edge for another
/// branch in between. An edge that is not on the surface gets the pcurve of its feet, and flags that say so.
///
/// Cost: some hundred microseconds to some milliseconds.
///
/// @param surface  a spline surface
/// @param edge     a spline curve in space
/// @param options  NULL: the defaults
/// @param out      the set; release it with fpt_pcurve_set_free
/// @return FPT_INVALID_ARGUMENT also for an edge that is a single point up to the tolerance, and for one whose feet jump from one
///         branch of the surface to another
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_pcurve_pull(
    surface: *const fpt_surface,
    edge: *const fpt_curve,
    options: *const fpt_pull_options,
    out: *mut *mut fpt_pcurve_set,
) -> fpt_status {
    // SAFETY: the header asks for live handles, options and room for a handle.
    guard(|| unsafe {
        let surface = surface::form(surface)?.spline()?;
        if edge.is_null() {
            return Err(Failure::Null("edge"));
        }
        let edge = curve::indexed(edge)?.curve();
        let given = if options.is_null() { Default::default() } else { sized("options", options)? };
        check_length("tolerance", given.tolerance)?;
        let hint = if given.hint.is_null() {
            None
        } else {
            let hint = array("hint", given.hint, 2)?;
            Some([hint[0], hint[1]])
        };
        let options = PullOptions {
            tolerance: given.tolerance,
            degree: given.degree,
            most_poles: given.pole_limit,
            hint,
        };
        let out = place("out", out)?;
        let callbacks = Callbacks::stopping(given.should_stop, given.user);
        let pulled = surface.pull(edge, &options, &mut || callbacks.poll(0, 1))?;
        *out = Box::into_raw(Box::new(fpt_pcurve_set { pulled }));
        Ok(())
    })
}

/// The number of pcurves: one, or more where seams and collapsed edges cut the edge.
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_pcurve_set_count(
    set: *const fpt_pcurve_set,
    out_count: *mut usize,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for a number.
    guard(|| unsafe {
        let pieces = &shared("set", set)?.pulled.pieces;
        *place("out_count", out_count)? = pieces.len();
        Ok(())
    })
}

/// A pcurve and its proof. Its domain is the part of the edge's domain that it belongs to.
///
/// @param index         below the count, else FPT_INVALID_ARGUMENT
/// @param out_pcurve    a new handle with z = 0; release it with fpt_curve_free
/// @param out_deviation distance between its image and the edge, and where it runs; NULL: not wanted
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_pcurve_set_get(
    set: *const fpt_pcurve_set,
    index: usize,
    out_pcurve: *mut *mut fpt_curve,
    out_deviation: *mut fpt_deviation,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for a handle and a record.
    guard(|| unsafe {
        let pieces = &shared("set", set)?.pulled.pieces;
        let Some(piece) = pieces.get(index) else {
            let text = format!("index: {index} is not below the count of {}", pieces.len());
            return Err(Failure::invalid(text));
        };
        let (out, told) =
            (place("out_pcurve", out_pcurve)?, optional_output("out_deviation", out_deviation, 1)?);
        *out = handle(piece.curve.clone());
        if let Some(told) = told {
            told[0] = fpt_deviation::of(piece.deviation, piece.flags);
        }
        Ok(())
    })
}

/// Releases a set. NULL is fine. No other call may use the handle during or after this one.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_pcurve_set_free(set: *mut fpt_pcurve_set) {
    let release = || {
        if !set.is_null() {
            // SAFETY: a handle comes from Box::into_raw and is released once.
            drop(unsafe { Box::from_raw(set) });
        }
        Ok(())
    };
    let _ = guard(release);
}

fn handle(curve: Curve) -> *mut fpt_curve {
    fpt_curve::handle(CurveForm::Spline(Arc::new(IndexedCurve::new(curve))))
}

/// The image of a pcurve in space, with the pcurve's parameter: the isocurve for an isoline, the composed curve where degrees allow,
/// else a spline with a proven deviation.
///
/// @param surface       a spline surface
/// @param pcurve        a spline curve with z = 0 in the domain of the surface
/// @param options       NULL: the defaults
/// @param out_curve     a new handle; release it with fpt_curve_free
/// @param out_deviation how far it is from the image; FPT_DEVIATION_EXACT, or FPT_DEVIATION_NOT_PROVEN when the tolerance was not reached.
///                      NULL: not wanted
/// @return FPT_INVALID_ARGUMENT also for a pcurve that leaves the domain
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_pcurve_lift(
    surface: *const fpt_surface,
    pcurve: *const fpt_curve,
    options: *const fpt_lift_options,
    out_curve: *mut *mut fpt_curve,
    out_deviation: *mut fpt_deviation,
) -> fpt_status {
    // SAFETY: the header asks for live handles, options and room for a handle and a record.
    guard(|| unsafe {
        let surface = surface::form(surface)?.spline()?.surface();
        let pcurve = self::pcurve("pcurve", pcurve)?;
        let given: fpt_lift_options =
            if options.is_null() { Default::default() } else { sized("options", options)? };
        check_length("tolerance", given.tolerance)?;
        if given.exact_degree > 31 {
            let text = format!("exact_degree: {} is more than 31", given.exact_degree);
            return Err(Failure::invalid(text));
        }
        let exact_degree = if given.exact_degree > 0 { given.exact_degree } else { EXACT_DEGREE };
        let options = LiftOptions { tolerance: given.tolerance, exact_degree };
        let (out, told) =
            (place("out_curve", out_curve)?, optional_output("out_deviation", out_deviation, 1)?);
        let lifted = lift(surface, &pcurve, &options)?;
        if let Some(told) = told {
            let missed = !lifted.exact && !lifted.is_within(surface, &options);
            let flags =
                if lifted.exact { fpt_deviation_flag::FPT_DEVIATION_EXACT as u32 } else { 0 }
                    | if missed { pulled::NOT_PROVEN } else { 0 };
            told[0] = fpt_deviation::of(lifted.deviation, flags);
        }
        *out = handle(lifted.curve);
        Ok(())
    })
}

/// The greatest distance between a curve in space and the image of a pcurve at equal parameters, on the common part of their
/// domains, with proof: for checking what another program gives.
///
/// @param surface  a spline surface
/// @param pcurve   a spline curve with z = 0 in the domain of the surface
/// @param curve    a spline curve in space
/// @param out      bound and value differ by some per cent, or by rounding; flags are 0
/// @return FPT_INVALID_ARGUMENT also for a pcurve that leaves the domain, or domains that have nothing in common
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_pcurve_deviation(
    surface: *const fpt_surface,
    pcurve: *const fpt_curve,
    curve: *const fpt_curve,
    out: *mut fpt_deviation,
) -> fpt_status {
    // SAFETY: the header asks for live handles and room for a record.
    guard(|| unsafe {
        let surface = surface::form(surface)?.spline()?.surface();
        let pcurve = self::pcurve("pcurve", pcurve)?.as_spline()?;
        let curve = curve::indexed(curve)?.curve();
        let out = place("out", out)?;
        let (a, b) = (pcurve.domain(), curve.domain());
        let range = [a.0.max(b.0), a.1.min(b.1)];
        if range[0] >= range[1] {
            let text = format!("curve: its domain {b:?} has nothing of the pcurve's, {a:?}");
            return Err(Failure::invalid(text));
        }
        let mut composer = Composer::new(surface);
        let found = deviation(&mut composer, &pcurve, curve, range, 0.0)?;
        *out = fpt_deviation::of(found, 0);
        Ok(())
    })
}
