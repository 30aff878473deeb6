//! Operations on curves: each makes a new curve.

use super::curve::{fpt_curve, plain};
use super::form::CurveForm;
use super::memory::{array, output, place, write};
use super::{Failure, fpt_status, guard};
use crate::curve::Curve;
use crate::index::IndexedCurve;
use crate::operate::{Bounded, Difference, compatible_curves, join_curves};
use std::sync::Arc;

/// The greatest distance of two shapes at equal parameters, between two numbers: 32 bytes, frozen.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fpt_difference {
    /// No points at equal parameters are farther apart. Proven. Bounds the Hausdorff distance too.
    pub bound: f64,
    /// The points at (u, v) are at least so far apart.
    pub reached: f64,
    /// Where, nearly the worst place.
    pub u: f64,
    /// Curves: 0.
    pub v: f64,
}

impl From<Difference> for fpt_difference {
    fn from(found: Difference) -> Self {
        let (Difference { bound, reached, .. }, [u, v]) = (found, found.at);
        Self { bound, reached, u, v }
    }
}

fn handle(curve: Curve) -> *mut fpt_curve {
    fpt_curve::handle(CurveForm::Spline(Arc::new(IndexedCurve::new(curve))))
}

pub(super) fn hand_over(curve: Curve, out: &mut *mut fpt_curve) -> Result<(), Failure> {
    *out = handle(curve);
    Ok(())
}

/// Writes the error, where it is wanted, and the handle.
///
/// # Safety
/// `out_error` is NULL or has room for a number.
unsafe fn bounded(
    found: Bounded<Curve>,
    out_error: *mut f64,
    out: &mut *mut fpt_curve,
) -> Result<(), Failure> {
    if !out_error.is_null() {
        // SAFETY: the caller vouches for it.
        unsafe { write("out_error", found.error, out_error)? };
    }
    hand_over(found.shape, out)
}

/// A matrix of the caller, row by row.
///
/// # Safety
/// NULL or an array of 4 `ROWS` numbers.
pub(super) unsafe fn matrix_of<'a, const ROWS: usize>(
    name: &'static str,
    matrix: *const f64,
) -> Result<&'a [[f64; 4]; ROWS], Failure> {
    // SAFETY: the caller vouches for it; an array of arrays has the layout of the numbers.
    Ok(&unsafe { array(name, matrix.cast::<[[f64; 4]; ROWS]>(), 1) }?[0])
}

/// The curves behind an array of handles, copied.
///
/// # Safety
/// NULL or an array of `count` live handles.
unsafe fn all(curves: *const *const fpt_curve, count: usize) -> Result<Vec<Curve>, Failure> {
    // SAFETY: the caller vouches for the array and the handles in it.
    let handles = unsafe { array("curves", curves, count) }?;
    handles.iter().map(|&curve| Ok(unsafe { plain(curve) }?.clone())).collect()
}

/// The same curve with more knots. Exact.
///
/// @param values  knots to add, in any order, each as often as it stands; in the domain. The ends may then be knots degree + 1 times,
///                others degree times
/// @param out  the new curve; release it with fpt_curve_free
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_curve_refine(
    curve: *const fpt_curve,
    values: *const f64,
    value_count: usize,
    out: *mut *mut fpt_curve,
) -> fpt_status {
    // SAFETY: the header asks for live handles, arrays and room for what comes out.
    guard(|| unsafe {
        let curve = plain(curve)?;
        let out = place("out", out)?;
        hand_over(curve.refine(array("values", values, value_count)?)?, out)
    })
}

/// The curve without some copies of a knot.
///
/// @param u      a knot inside the domain
/// @param times  at most how often it is a knot
/// @param out_error  the proven error, a length; NULL: not wanted
/// @param out  the new curve; release it with fpt_curve_free
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_curve_remove_knot(
    curve: *const fpt_curve,
    u: f64,
    times: usize,
    out_error: *mut f64,
    out: *mut *mut fpt_curve,
) -> fpt_status {
    // SAFETY: the header asks for live handles and room for what comes out.
    guard(|| unsafe {
        let curve = plain(curve)?;
        let out = place("out", out)?;
        bounded(curve.remove_knot(u, times)?, out_error, out)
    })
}

/// The curve without the knots that are not needed to stay within a tolerance; the one whose removal changes least goes first.
///
/// @param tolerance  length, finite, >= 0; the error is at most that
/// @param out_error  the proven error, a length; NULL: not wanted
/// @param out  the new curve; release it with fpt_curve_free
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_curve_simplify(
    curve: *const fpt_curve,
    tolerance: f64,
    out_error: *mut f64,
    out: *mut *mut fpt_curve,
) -> fpt_status {
    // SAFETY: the header asks for live handles and room for what comes out.
    guard(|| unsafe {
        let curve = plain(curve)?;
        let out = place("out", out)?;
        bounded(curve.simplify(tolerance)?, out_error, out)
    })
}

/// The part of the curve between two parameters, clamped, with its parameters. Exact.
///
/// @param start  in the domain
/// @param end    in the domain, greater than start
/// @param out  the new curve; release it with fpt_curve_free
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_curve_part(
    curve: *const fpt_curve,
    start: f64,
    end: f64,
    out: *mut *mut fpt_curve,
) -> fpt_status {
    // SAFETY: the header asks for live handles and room for what comes out.
    guard(|| unsafe {
        let curve = plain(curve)?;
        let out = place("out", out)?;
        hand_over(curve.part(start, end)?, out)
    })
}

/// The same curve with clamped ends: the first and the last pole are its end points. Exact. Also the way back from fpt_curve_periodic.
///
/// @param out  the new curve; release it with fpt_curve_free
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_curve_clamp(
    curve: *const fpt_curve,
    out: *mut *mut fpt_curve,
) -> fpt_status {
    // SAFETY: the header asks for live handles and room for what comes out.
    guard(|| unsafe {
        let curve = plain(curve)?;
        let out = place("out", out)?;
        hand_over(curve.clamp()?, out)
    })
}

/// The same curve with unclamped ends, knots outside the domain mirrored from those inside.
///
/// @param out_error  the proven error, a length; NULL: not wanted
/// @param out  the new curve; release it with fpt_curve_free
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_curve_unclamp(
    curve: *const fpt_curve,
    out_error: *mut f64,
    out: *mut *mut fpt_curve,
) -> fpt_status {
    // SAFETY: the header asks for live handles and room for what comes out.
    guard(|| unsafe {
        let curve = plain(curve)?;
        let out = place("out", out)?;
        bounded(curve.unclamp()?, out_error, out)
    })
}

/// The periodic form of a closed curve, unrolled: knots repeat after a period, poles after as many as a period has knots. The
/// seam is the smoothest one that keeps the error within the tolerance.
///
/// @param tolerance  length, finite, >= 0
/// @return FPT_INVALID_ARGUMENT when the curve is not closed within the tolerance
/// @param out_error  the proven error, a length; NULL: not wanted
/// @param out  the new curve; release it with fpt_curve_free
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_curve_periodic(
    curve: *const fpt_curve,
    tolerance: f64,
    out_error: *mut f64,
    out: *mut *mut fpt_curve,
) -> fpt_status {
    // SAFETY: the header asks for live handles and room for what comes out.
    guard(|| unsafe {
        let curve = plain(curve)?;
        let out = place("out", out)?;
        bounded(curve.periodic(tolerance)?, out_error, out)
    })
}

/// The same curve with a higher degree; its smoothness at the knots stays. Exact.
///
/// @param by  how many degrees more; the degree is at most 31
/// @param out  the new curve; release it with fpt_curve_free
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_curve_elevate(
    curve: *const fpt_curve,
    by: usize,
    out: *mut *mut fpt_curve,
) -> fpt_status {
    // SAFETY: the header asks for live handles and room for what comes out.
    guard(|| unsafe {
        let curve = plain(curve)?;
        let out = place("out", out)?;
        hand_over(curve.elevate(by)?, out)
    })
}

/// The clamped curve of a degree lower by one that is nearest in its poles; exact where the curve is of that degree.
///
/// @param out_error  the proven error, a length; NULL: not wanted
/// @param out  the new curve; release it with fpt_curve_free
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_curve_reduce(
    curve: *const fpt_curve,
    out_error: *mut f64,
    out: *mut *mut fpt_curve,
) -> fpt_status {
    // SAFETY: the header asks for live handles and room for what comes out.
    guard(|| unsafe {
        let curve = plain(curve)?;
        let out = place("out", out)?;
        bounded(curve.reduce()?, out_error, out)
    })
}

/// The same curve run through backwards, over the same domain. Exact.
///
/// @param out  the new curve; release it with fpt_curve_free
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_curve_reverse(
    curve: *const fpt_curve,
    out: *mut *mut fpt_curve,
) -> fpt_status {
    // SAFETY: the header asks for live handles and room for what comes out.
    guard(|| unsafe {
        let curve = plain(curve)?;
        let out = place("out", out)?;
        hand_over(curve.reverse()?, out)
    })
}

/// The same curve over another domain, by an affine change of the parameter. Exact.
///
/// @param start  finite
/// @param end    finite, greater than start
/// @param out  the new curve; release it with fpt_curve_free
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_curve_with_domain(
    curve: *const fpt_curve,
    start: f64,
    end: f64,
    out: *mut *mut fpt_curve,
) -> fpt_status {
    // SAFETY: the header asks for live handles and room for what comes out.
    guard(|| unsafe {
        let curve = plain(curve)?;
        let out = place("out", out)?;
        hand_over(curve.with_domain(start, end)?, out)
    })
}

/// The same curve, clamped, in a parameter that is a Moebius function of the old one, over the same domain. Exact; a polynomial curve becomes
/// rational. With x and y the shares of the domain before the old and the new parameter: y = speed x / (1 + (speed - 1) x).
///
/// @param speed  derivative of the new parameter by the old one at the start; finite, > 0
/// @param out  the new curve; release it with fpt_curve_free
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_curve_reparametrise(
    curve: *const fpt_curve,
    speed: f64,
    out: *mut *mut fpt_curve,
) -> fpt_status {
    // SAFETY: the header asks for live handles and room for what comes out.
    guard(|| unsafe {
        let curve = plain(curve)?;
        let out = place("out", out)?;
        hand_over(curve.reparametrise(speed)?, out)
    })
}

/// The curve of the points A (x, y, z, 1). Exact.
///
/// @param matrix  12 finite numbers, 3 rows of 4; may be singular
/// @param out  the new curve; release it with fpt_curve_free
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_curve_affine(
    curve: *const fpt_curve,
    matrix: *const f64,
    out: *mut *mut fpt_curve,
) -> fpt_status {
    // SAFETY: the header asks for live handles, arrays and room for what comes out.
    guard(|| unsafe {
        let curve = plain(curve)?;
        let out = place("out", out)?;
        hand_over(curve.affine(matrix_of::<3>("matrix", matrix)?)?, out)
    })
}

/// The curve of the points (x', y', z') / w' with (x', y', z', w') = A (x, y, z, 1). Exact.
///
/// @param matrix  16 finite numbers, 4 rows of 4
/// @return FPT_UNSUPPORTED when poles lie on both sides of the plane that goes to infinity, or on it; refine the curve then
/// @param out  the new curve; release it with fpt_curve_free
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_curve_projective(
    curve: *const fpt_curve,
    matrix: *const f64,
    out: *mut *mut fpt_curve,
) -> fpt_status {
    // SAFETY: the header asks for live handles, arrays and room for what comes out.
    guard(|| unsafe {
        let curve = plain(curve)?;
        let out = place("out", out)?;
        hand_over(curve.projective(matrix_of::<4>("matrix", matrix)?)?, out)
    })
}

/// The derivative as a curve: of one degree less (at least 1), or of twice the degree if the curve is rational (degree up to 15). Exact.
///
/// @return FPT_UNSUPPORTED when the derivative jumps at a knot, which is named
///
/// @param out  the new curve; release it with fpt_curve_free
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_curve_derivative(
    curve: *const fpt_curve,
    out: *mut *mut fpt_curve,
) -> fpt_status {
    // SAFETY: the header asks for live handles and room for what comes out.
    guard(|| unsafe {
        let curve = plain(curve)?;
        let out = place("out", out)?;
        hand_over(curve.derivative()?, out)
    })
}

/// The same curve with knots of full multiplicity: piece i has the poles from i * degree to i * degree + degree. Exact.
///
/// @param out  the new curve; release it with fpt_curve_free
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_curve_bezier_form(
    curve: *const fpt_curve,
    out: *mut *mut fpt_curve,
) -> fpt_status {
    // SAFETY: the header asks for live handles and room for what comes out.
    guard(|| unsafe {
        let curve = plain(curve)?;
        let out = place("out", out)?;
        hand_over(curve.bezier_form()?, out)
    })
}

/// The parts of the curve before and behind a parameter. Exact.
///
/// @param u  inside the domain
/// @param out_before  the first part; release it with fpt_curve_free
/// @param out_behind  the second part; release it with fpt_curve_free
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_curve_split(
    curve: *const fpt_curve,
    u: f64,
    out_before: *mut *mut fpt_curve,
    out_behind: *mut *mut fpt_curve,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for two.
    guard(|| unsafe {
        let curve = plain(curve)?;
        let (before, behind) = (place("out_before", out_before)?, place("out_behind", out_behind)?);
        let parts = curve.split(u)?;
        (*before, *behind) = (handle(parts.0), handle(parts.1));
        Ok(())
    })
}

/// The curves as one, each beginning where the one before ends. Each keeps its speed: its domain is shifted. The knot where two meet is one degree
/// times; fpt_curve_simplify takes out what is not needed.
///
/// @param curves     live handles
/// @param tolerance  length, finite, >= 0: a start may be so far from the end before it, and is moved there
/// @param out_error  how far points move by that, proven; NULL: not wanted
/// @param out        the new curve; release it with fpt_curve_free
/// @return FPT_INVALID_ARGUMENT names the first curve that begins elsewhere
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_curve_join(
    curves: *const *const fpt_curve,
    count: usize,
    tolerance: f64,
    out_error: *mut f64,
    out: *mut *mut fpt_curve,
) -> fpt_status {
    // SAFETY: the header asks for an array of live handles and room for what comes out.
    guard(|| unsafe {
        let curves = all(curves, count)?;
        let out = place("out", out)?;
        bounded(join_curves(&curves, tolerance)?, out_error, out)
    })
}

/// The same curves, clamped, with one degree, one knot vector and the domain of the first; if one is rational, all have weights. Exact.
///
/// @param curves  live handles, at least one
/// @param out     room for count handles; release each with fpt_curve_free
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_curve_make_compatible(
    curves: *const *const fpt_curve,
    count: usize,
    out: *mut *mut fpt_curve,
) -> fpt_status {
    // SAFETY: the header asks for an array of live handles and room for as many.
    guard(|| unsafe {
        let curves = all(curves, count)?;
        let out = output("out", out, count)?;
        for (curve, out) in compatible_curves(&curves)?.into_iter().zip(out) {
            *out = handle(curve);
        }
        Ok(())
    })
}

/// How far two curves over the same domain are apart at equal parameters; degrees and knots may differ.
///
/// @param curve  a spline
/// @param other  a spline over the same domain
/// @param out    bound and what is reached, within 0.1 % of each other but for rounding and rare shapes
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_curve_difference(
    curve: *const fpt_curve,
    other: *const fpt_curve,
    out: *mut fpt_difference,
) -> fpt_status {
    // SAFETY: the header asks for two live handles and room for a record.
    guard(|| unsafe { write("out", plain(curve)?.difference(plain(other)?)?.into(), out) })
}
