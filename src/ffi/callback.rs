//! Shapes from the caller's functions: the two structs and the constructors.
//!
//! The caller's `evaluate` and `user` become a closure of the engine; `release` is called when the closure goes, that
//! is with the handle, but only once a handle has been given out.

use super::curve::fpt_curve;
use super::form::{CurveForm, SurfaceForm};
use super::memory::place;
use super::options::{SelfSized, sized};
use super::surface::fpt_surface;
use super::{Failure, fpt_status, guard};
use crate::callback::{CallbackCurve, CallbackSurface, CurveBounds, SurfaceBounds};
use std::ffi::c_void;
use std::mem::size_of;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// A curve given by a function: the input of fpt_curve_from_callback. The numbers are copied, `user` is kept.
///
/// The bounds are the caller's word. With one of them answers are proven (extrema: with second_bound only), with
/// neither every foot carries FPT_FOOT_NOT_PROVEN and lower_bound 0. A bound that is too small makes the proofs
/// wrong.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct fpt_curve_callback {
    /// sizeof(fpt_curve_callback).
    pub struct_size: usize,
    /// Writes C, C', C'' at u, x,y,z each, up to order `derivatives` (0 to 2) to `out`, which has room for
    /// 3*(derivatives + 1) numbers, and returns the highest order that it has written: 0 for the point only;
    /// orders that are missing are taken from finite differences. Negative: the function fails at u; so does one
    /// that writes numbers that are not finite or beyond 1e100. Points must be accurate to 64 ulps of the
    /// largest coordinate of the curve, derivatives to 64 ulps of themselves and of that coordinate over the
    /// length of the domain. Called in the constructor and by every function that evaluates the handle, on any
    /// thread and on several at a time; must give the same numbers for the same u, and must not throw,
    /// longjmp, or free the handle.
    pub evaluate: Option<
        unsafe extern "C" fn(user: *mut c_void, u: f64, derivatives: u32, out: *mut f64) -> i32,
    >,
    /// Handed to both functions as it is.
    pub user: *mut c_void,
    /// Called once with `user` when the handle is freed. NULL: nothing to release.
    pub release: Option<unsafe extern "C" fn(user: *mut c_void)>,
    /// Start and end of u.
    pub domain: [f64; 2],
    /// |C'| is at most this on the whole domain; 0: unknown.
    pub speed_bound: f64,
    /// |C''| is at most this on the whole domain; 0: unknown. Of a line, give any small positive number.
    pub second_bound: f64,
}

/// A surface given by a function: the input of fpt_surface_from_callback. The numbers are copied, `user` is kept.
///
/// The bounds are the caller's word. With one kind of them answers are proven (extrema: with second_bounds only), with
/// neither every foot carries FPT_FOOT_NOT_PROVEN and lower_bound 0. A bound that is too small makes the proofs wrong. Bounds of the
/// second derivatives prove fast; with those of the first alone points on the surface are proven fast, but
/// distances off the surface only roughly.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct fpt_surface_callback {
    /// sizeof(fpt_surface_callback).
    pub struct_size: usize,
    /// Writes S; Su,Sv; Suu,Suv,Svv at (u,v), x,y,z each, up to the total order `derivatives` (0 to 2) to
    /// `out`, which has room for 3, 9 or 18 numbers, and returns the highest order that it has written: 0 for the
    /// point only. All else as for fpt_curve_callback.evaluate.
    pub evaluate: Option<
        unsafe extern "C" fn(
            user: *mut c_void,
            u: f64,
            v: f64,
            derivatives: u32,
            out: *mut f64,
        ) -> i32,
    >,
    /// Handed to both functions as it is.
    pub user: *mut c_void,
    /// Called once with `user` when the handle is freed. NULL: nothing to release.
    pub release: Option<unsafe extern "C" fn(user: *mut c_void)>,
    /// Start and end of u, start and end of v.
    pub domain: [f64; 4],
    /// |Su| and |Sv| are at most these on the whole domain; both 0: unknown.
    pub speed_bounds: [f64; 2],
    /// |Suu|, |Suv| and |Svv| are at most these on the whole domain; all 0: unknown (of a plane, give any
    /// small positive number). A 0 beside a positive number is a bound.
    pub second_bounds: [f64; 3],
}

// SAFETY: repr(C), begins with struct_size; numbers, raw pointers and nullable function pointers.
unsafe impl SelfSized for fpt_curve_callback {
    const SHORTER: &'static [usize] = &[];

    fn defaults() -> Self {
        Self {
            struct_size: size_of::<Self>(),
            evaluate: None,
            user: std::ptr::null_mut(),
            release: None,
            domain: [0.0; 2],
            speed_bound: 0.0,
            second_bound: 0.0,
        }
    }
}

// SAFETY: repr(C), begins with struct_size; numbers, raw pointers and nullable function pointers.
unsafe impl SelfSized for fpt_surface_callback {
    const SHORTER: &'static [usize] = &[];

    fn defaults() -> Self {
        Self {
            struct_size: size_of::<Self>(),
            evaluate: None,
            user: std::ptr::null_mut(),
            release: None,
            domain: [0.0; 4],
            speed_bounds: [0.0; 2],
            second_bounds: [0.0; 3],
        }
    }
}

/// The caller's data, released with the last reference once a handle was given out.
pub(super) struct User {
    data: *mut c_void,
    release: Option<unsafe extern "C" fn(*mut c_void)>,
    given_out: AtomicBool,
}

// SAFETY: the header asks for a function that may be called on any thread with this data.
unsafe impl Send for User {}
// SAFETY: as above, and on several at a time.
unsafe impl Sync for User {}

impl User {
    pub(super) fn new(
        data: *mut c_void,
        release: Option<unsafe extern "C" fn(*mut c_void)>,
    ) -> Arc<Self> {
        Arc::new(Self { data, release, given_out: AtomicBool::new(false) })
    }

    /// What the functions are called with.
    pub(super) fn data(&self) -> *mut c_void {
        self.data
    }

    /// A handle that uses the functions was given out: from now on they are released.
    pub(super) fn give_out(&self) {
        self.given_out.store(true, Ordering::Relaxed);
    }
}

impl Drop for User {
    fn drop(&mut self) {
        if let (Some(release), true) = (self.release, self.given_out.load(Ordering::Relaxed)) {
            // SAFETY: the header asks for a function that takes this data, called once.
            unsafe { release(self.data) }
        }
    }
}

/// The order that a function has reported; `None` when it failed.
fn delivered(returned: i32) -> Option<usize> {
    usize::try_from(returned).ok()
}

/// Bounds as given; `None` when all are 0.
fn known<const N: usize>(bounds: [f64; N]) -> Option<[f64; N]> {
    (bounds != [0.0; N]).then_some(bounds)
}

/// Makes a curve from a function. It is used like any other curve; functions that need degree, knots, poles
/// or weights return FPT_UNSUPPORTED. A query looks at 20,000 boxes of parameters by default when a bound is
/// given (a preimage at 100,000), at 2,000 when there is none; finite differences use steps of 2^-17 of the domain for first
/// derivatives and for derivatives of given ones, 2^-13 for second differences of points, one-sided at the
/// ends. The function is called 129 times or more, for the box and to see whether the curve is closed.
///
/// @param callback  the function and what is known about it. After a failure nothing of it is kept and
///                  release is not called
/// @param out       the handle; release it with fpt_curve_free
/// @return FPT_INVALID_ARGUMENT for a domain that is empty, not finite or too narrow for its doubles, for a
///         bound that is negative or not finite, or when the function fails at all samples
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_curve_from_callback(
    callback: *const fpt_curve_callback,
    out: *mut *mut fpt_curve,
) -> fpt_status {
    // SAFETY: the header asks for a callback struct and room for a handle.
    guard(|| unsafe {
        let out = place("out", out)?;
        let given = sized("callback", callback)?;
        let evaluate = given.evaluate.ok_or(Failure::Null("evaluate"))?;
        let user = User::new(given.user, given.release);
        let kept = user.clone();
        let function = move |u: f64, order: usize, values: &mut [[f64; 3]; 3]| {
            let values = values.as_flattened_mut().as_mut_ptr();
            delivered(evaluate(kept.data, u, order as u32, values))
        };
        let bounds = CurveBounds {
            speed: known([given.speed_bound]).map(|[x]| x),
            second: known([given.second_bound]).map(|[x]| x),
        };
        let curve = CallbackCurve::new(given.domain, bounds, function)?;
        *out = fpt_curve::handle(CurveForm::Function(Arc::new(curve)));
        user.give_out();
        Ok(())
    })
}

/// Makes a surface from a function. It is used like any other surface; functions that need degrees, knots,
/// poles or weights return FPT_UNSUPPORTED. Budget and finite differences are those of fpt_curve_from_callback. The
/// function is called 625 times or more, for the box, for closed directions and collapsed edges.
///
/// @param callback  the function and what is known about it. After a failure nothing of it is kept and
///                  release is not called
/// @param out       the handle; release it with fpt_surface_free
/// @return FPT_INVALID_ARGUMENT for a domain that is empty, not finite or too narrow for its doubles, for a
///         bound that is negative or not finite, or when the function fails at all samples
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_from_callback(
    callback: *const fpt_surface_callback,
    out: *mut *mut fpt_surface,
) -> fpt_status {
    // SAFETY: the header asks for a callback struct and room for a handle.
    guard(|| unsafe {
        let out = place("out", out)?;
        let given = sized("callback", callback)?;
        let evaluate = given.evaluate.ok_or(Failure::Null("evaluate"))?;
        let user = User::new(given.user, given.release);
        let kept = user.clone();
        let function = move |u: f64, v: f64, order: usize, values: &mut [[f64; 3]; 6]| {
            let values = values.as_flattened_mut().as_mut_ptr();
            delivered(evaluate(kept.data, u, v, order as u32, values))
        };
        let bounds =
            SurfaceBounds { speed: known(given.speed_bounds), second: known(given.second_bounds) };
        let surface = CallbackSurface::new(given.domain, bounds, function)?;
        *out = fpt_surface::handle(SurfaceForm::Function(Arc::new(surface)));
        user.give_out();
        Ok(())
    })
}
