//! Curves: handle, inputs back out, evaluation.

use super::form::CurveForm;
use super::limits::{check_degree, check_inside, check_inside_at, check_order};
use super::memory::{
    array, optional_array, output, place, product, shared, write, write_array, write_weights,
};
use super::options::{SelfSized, sized};
use super::{Failure, fpt_status, guard};
use crate::curve::Curve;
use crate::index::IndexedCurve;
use std::mem::size_of;
use std::sync::Arc;

/// A curve. Immutable: any number of threads may use one at a time. The search index is built on first
/// use, by one thread while the others wait. Made by fpt_curve_new or fpt_curve_from_callback, owned by the
/// caller, released by fpt_curve_free. A curve from a callback has no degree, knots, poles and weights:
/// functions that need them return FPT_UNSUPPORTED.
pub struct fpt_curve {
    form: CurveForm,
}

impl fpt_curve {
    /// A handle for the caller.
    pub(super) fn handle(form: CurveForm) -> *mut Self {
        Box::into_raw(Box::new(Self { form }))
    }
}

/// The input of fpt_curve_new. Copied: nothing is borrowed after the call.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct fpt_curve_data {
    /// sizeof(fpt_curve_data).
    pub struct_size: usize,
    /// 1 to 31.
    pub degree: usize,
    /// At least degree + 1.
    pub pole_count: usize,
    /// pole_count + degree + 1 numbers, not decreasing, repeats written out, no interior knot more than
    /// degree times. Periodic curves come unrolled: the domain is `knots[degree]` to
    /// `knots[pole_count]`.
    pub knots: *const f64,
    /// x,y,z of pole i at 3*i; plane curves have z = 0. Not multiplied by the weights.
    pub poles: *const f64,
    /// One per pole, 1e-100 to 1e100; NULL: polynomial.
    pub weights: *const f64,
}

// SAFETY: repr(C), begins with struct_size; numbers and raw pointers.
unsafe impl SelfSized for fpt_curve_data {
    const SHORTER: &'static [usize] = &[];

    fn defaults() -> Self {
        let none = std::ptr::null();
        let struct_size = size_of::<Self>();
        Self { struct_size, degree: 0, pole_count: 0, knots: none, poles: none, weights: none }
    }
}

/// What is behind a handle: a spline or a function.
///
/// # Safety
/// NULL or a live handle.
pub(super) unsafe fn form<'a>(curve: *const fpt_curve) -> Result<&'a CurveForm, Failure> {
    // SAFETY: the caller vouches for it.
    Ok(&unsafe { shared("curve", curve) }?.form)
}

/// The spline curve behind a handle; a function is refused as unsupported.
///
/// # Safety
/// NULL or a live handle.
pub(super) unsafe fn indexed<'a>(curve: *const fpt_curve) -> Result<&'a IndexedCurve, Failure> {
    // SAFETY: the caller vouches for it.
    unsafe { form(curve) }?.spline()
}

/// As [`indexed`], without the index.
///
/// # Safety
/// NULL or a live handle.
pub(super) unsafe fn plain<'a>(curve: *const fpt_curve) -> Result<&'a Curve, Failure> {
    // SAFETY: the caller vouches for it.
    Ok(unsafe { indexed(curve) }?.curve())
}

/// Reads and checks the input of a curve.
///
/// # Safety
/// NULL, or a struct whose arrays have the documented lengths.
unsafe fn read(data: *const fpt_curve_data) -> Result<Curve, Failure> {
    // SAFETY: the caller vouches for the struct and its arrays; the degree is small and the pole count
    // no larger than an address space holds, so the lengths do not overflow.
    unsafe {
        let data = sized("data", data)?;
        let count = data.pole_count;
        check_degree("degree", data.degree, count)?;
        let knots = array("knots", data.knots, count + data.degree + 1)?;
        let poles = array("poles", data.poles.cast::<[f64; 3]>(), count)?;
        let weights = optional_array("weights", data.weights, count)?;
        Ok(Curve::new(knots, data.degree, poles, weights)?)
    }
}

/// Makes a curve from its inputs.
///
/// @param data  the inputs, copied; a struct_size shorter than the struct is FPT_INVALID_ARGUMENT
/// @param out   the handle; release it with fpt_curve_free
/// @return FPT_INVALID_ARGUMENT names the array and the index of the first bad number
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_curve_new(
    data: *const fpt_curve_data,
    out: *mut *mut fpt_curve,
) -> fpt_status {
    // SAFETY: the header asks for a curve data struct and room for a handle.
    guard(|| unsafe {
        let out = place("out", out)?;
        *out = fpt_curve::handle(CurveForm::Spline(Arc::new(IndexedCurve::new(read(data)?))));
        Ok(())
    })
}

/// Releases a curve. NULL is fine. No other call may use the handle during or after this one.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_curve_free(curve: *mut fpt_curve) {
    let release = || {
        if !curve.is_null() {
            // SAFETY: a handle comes from Box::into_raw in `_new` and is released once.
            drop(unsafe { Box::from_raw(curve) });
        }
        Ok(())
    };
    let _ = guard(release);
}

/// The interval on which the curve is defined.
///
/// @param out_u  2 numbers: start, end
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_curve_domain(curve: *const fpt_curve, out_u: *mut f64) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for 2 numbers.
    guard(|| unsafe {
        let (start, end) = form(curve)?.domain();
        write("out_u", [start, end], out_u.cast())
    })
}

/// The curve and its derivatives at one parameter. At a knot the piece on the right counts, at the
/// domain's end the one on the left.
///
/// @param u            in the domain, else FPT_INVALID_ARGUMENT
/// @param derivatives  highest order d, at most 31; 0: the point only. More than 2 of a curve from a
///                     callback: FPT_UNSUPPORTED
/// @param out          3*(d + 1) numbers: C, C', C'', ... with x,y,z each. Where a callback fails:
///                     FPT_INVALID_ARGUMENT
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_curve_evaluate(
    curve: *const fpt_curve,
    u: f64,
    derivatives: u32,
    out: *mut f64,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for 3*(d+1) numbers.
    guard(|| unsafe {
        let curve = form(curve)?;
        let order = check_order(derivatives)?;
        curve.check_order(order)?;
        let out = output("out", out.cast::<[f64; 3]>(), order + 1)?;
        let (start, end) = curve.domain();
        check_inside("u", u, start, end)?;
        curve.derivatives(u, order, out)
    })
}

/// The curve and its derivatives at many parameters, as fpt_curve_evaluate gives them one by one.
///
/// @param parameters   `count` numbers, each in the domain; the error names the first that is not
/// @param count        may be 0
/// @param derivatives  highest order d, at most 31
/// @param out          count*3*(d + 1) numbers, the values of parameter i at i*3*(d + 1); must not
///                     overlap `parameters`. Where a callback fails: FPT_INVALID_ARGUMENT, the values
///                     before are written
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_curve_evaluate_many(
    curve: *const fpt_curve,
    parameters: *const f64,
    count: usize,
    derivatives: u32,
    out: *mut f64,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and arrays of these lengths that do not overlap.
    guard(|| unsafe {
        let curve = form(curve)?;
        let order = check_order(derivatives)?;
        curve.check_order(order)?;
        let parameters = array("parameters", parameters, count)?;
        let out = output("out", out.cast::<[f64; 3]>(), product("out", count, order + 1)?)?;
        let (start, end) = curve.domain();
        for (i, &u) in parameters.iter().enumerate() {
            check_inside_at("parameters", i, "u", u, start, end)?;
        }
        for (&u, values) in parameters.iter().zip(out.chunks_exact_mut(order + 1)) {
            curve.derivatives(u, order, values)?;
        }
        Ok(())
    })
}

/// The degree.
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_curve_degree(
    curve: *const fpt_curve,
    out_degree: *mut usize,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for the value.
    guard(|| unsafe { write("out_degree", plain(curve)?.degree(), out_degree) })
}

/// The number of poles.
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_curve_pole_count(
    curve: *const fpt_curve,
    out_pole_count: *mut usize,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for the value.
    guard(|| unsafe { write("out_pole_count", plain(curve)?.poles().len(), out_pole_count) })
}

/// The knots, bit for bit as they came in.
///
/// @param capacity   how many numbers `out_knots` has room for; less than pole_count + degree + 1 is
///                   FPT_INVALID_ARGUMENT
/// @param out_knots  pole_count + degree + 1 numbers
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_curve_knots(
    curve: *const fpt_curve,
    capacity: usize,
    out_knots: *mut f64,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for `capacity` numbers.
    guard(|| unsafe {
        write_array("out_knots", plain(curve)?.knots().values(), capacity, out_knots)
    })
}

/// The poles, bit for bit as they came in.
///
/// @param capacity   how many numbers `out_poles` has room for; less than 3*pole_count is
///                   FPT_INVALID_ARGUMENT
/// @param out_poles  3*pole_count numbers: x,y,z of pole i at 3*i
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_curve_poles(
    curve: *const fpt_curve,
    capacity: usize,
    out_poles: *mut f64,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for `capacity` numbers.
    guard(|| unsafe {
        write_array("out_poles", plain(curve)?.poles().as_flattened(), capacity, out_poles)
    })
}

/// The weights as they came in; all 1 for a polynomial curve.
///
/// @param capacity     how many numbers `out_weights` has room for; less than pole_count is
///                     FPT_INVALID_ARGUMENT
/// @param out_weights  pole_count numbers
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_curve_weights(
    curve: *const fpt_curve,
    capacity: usize,
    out_weights: *mut f64,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for `capacity` numbers.
    guard(|| unsafe {
        let curve = plain(curve)?;
        write_weights(curve.weights(), curve.poles().len(), capacity, out_weights)
    })
}

/// The box of the poles that act on the domain, in which the curve lies. Its diagonal is what the default
/// tolerance and accuracy are relative to. Of a curve from a callback: the box of samples, which it may
/// leave between them.
///
/// @param out_box  6 numbers: least x,y,z, then greatest x,y,z
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_curve_box(curve: *const fpt_curve, out_box: *mut f64) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for 6 numbers.
    guard(|| unsafe { write("out_box", form(curve)?.bounding_box(), out_box.cast()) })
}

/// Whether the curve has weights that differ: 1 or 0. 0 for a curve from a callback.
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_curve_is_rational(
    curve: *const fpt_curve,
    out_is_rational: *mut i32,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for the value.
    guard(|| unsafe {
        write("out_is_rational", i32::from(form(curve)?.is_rational()), out_is_rational)
    })
}

/// Whether the curve ends where it starts, as geometry and not only by its knots: 1 or 0.
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_curve_is_closed(
    curve: *const fpt_curve,
    out_is_closed: *mut i32,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for the value.
    guard(|| unsafe { write("out_is_closed", i32::from(form(curve)?.is_closed()), out_is_closed) })
}

/// Builds the search index now instead of on the first query. May be called again and from any thread.
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_curve_prepare(curve: *const fpt_curve) -> fpt_status {
    // SAFETY: the header asks for a live handle.
    guard(|| Ok(unsafe { form(curve) }?.prepare(&mut || false)?))
}

/// Bytes that the library holds for the curve: the copies of its inputs, and the search index once it is built. What the
/// function of a callback keeps for itself is not counted.
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_curve_memory(
    curve: *const fpt_curve,
    out_memory: *mut usize,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for the value.
    guard(|| unsafe {
        write("out_memory", size_of::<fpt_curve>() + form(curve)?.memory(), out_memory)
    })
}
