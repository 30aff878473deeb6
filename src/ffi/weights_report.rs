//! Weights from wishes: what was found.

use super::curve::fpt_curve;
use super::form::{CurveForm, SurfaceForm};
use super::memory::{place, shared, write, write_array};
use super::surface::fpt_surface;
use super::weights_records::{fpt_weights_outcome, fpt_weights_pole, fpt_weights_summary};
use super::{Failure, fpt_status, guard};
use crate::index::{IndexedCurve, IndexedSurface};
use crate::weights::{PoleReport, Report, State};
use std::sync::Arc;

/// What a method found: weights, and for each pole what was wished and what was achieved. Immutable, owned by the caller, released
/// by fpt_weights_report_free; it does not refer to the shape that it came from.
pub struct fpt_weights_report {
    report: Report,
}

/// A handle for the caller.
pub(super) fn hand_over(report: Report, out: &mut *mut fpt_weights_report) -> Result<(), Failure> {
    *out = Box::into_raw(Box::new(fpt_weights_report { report }));
    Ok(())
}

/// The report behind a handle.
///
/// # Safety
/// NULL or a live handle.
unsafe fn report<'a>(report: *const fpt_weights_report) -> Result<&'a Report, Failure> {
    // SAFETY: the caller vouches for it.
    Ok(&unsafe { shared("report", report) }?.report)
}

/// An element by its number.
fn at<T: Copy>(list: &[T], index: usize) -> Result<T, Failure> {
    list.get(index).copied().ok_or_else(|| {
        Failure::invalid(format!("index: {index} is not below the count of {}", list.len()))
    })
}

/// The number of poles.
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_weights_report_pole_count(
    report: *const fpt_weights_report,
    out_count: *mut usize,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for a number.
    guard(|| unsafe { write("out_count", self::report(report)?.poles.len(), out_count) })
}

/// A pole's part.
///
/// @param index  below the count, else FPT_INVALID_ARGUMENT
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_weights_report_pole(
    report: *const fpt_weights_report,
    index: usize,
    out: *mut fpt_weights_pole,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for a record; the layouts agree (above).
    guard(|| unsafe { write("out", at(&self::report(report)?.poles, index)?, out.cast()) })
}

/// All weights, in the order of the poles.
///
/// @param capacity     numbers that out_weights has room for, at least the number of poles
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_weights_report_weights(
    report: *const fpt_weights_report,
    capacity: usize,
    out_weights: *mut f64,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for `capacity` numbers.
    guard(|| unsafe {
        write_array("out_weights", &self::report(report)?.weights(), capacity, out_weights)
    })
}

/// What came of a constraint.
///
/// @param index  as in the call that made the report; beyond its constraints FPT_INVALID_ARGUMENT
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_weights_report_constraint(
    report: *const fpt_weights_report,
    index: usize,
    out: *mut fpt_weights_outcome,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for a record; the layouts agree (above).
    guard(|| unsafe { write("out", at(&self::report(report)?.constraints, index)?, out.cast()) })
}

/// The report in a few numbers.
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_weights_report_summary(
    report: *const fpt_weights_report,
    out: *mut fpt_weights_summary,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for a record.
    guard(|| unsafe {
        let report = self::report(report)?;
        let count = |state: State| {
            let is = |pole: &&PoleReport| pole.state == state as u32;
            report.poles.iter().filter(is).count() as u64
        };
        let summary = fpt_weights_summary {
            tolerance: report.tolerance,
            iterations: report.iterations,
            starts: report.starts,
            is_met: u32::from(report.is_met()),
            met: count(State::Met),
            not_met: count(State::NotMet),
            impossible: count(State::Impossible),
        };
        write("out", summary, out)
    })
}

/// The curve with the weights found, as a new handle; FPT_UNSUPPORTED for a report of a surface.
///
/// @param out  the curve; release it with fpt_curve_free
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_weights_report_curve(
    report: *const fpt_weights_report,
    out: *mut *mut fpt_curve,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for a handle.
    guard(|| unsafe {
        let curve = IndexedCurve::new(self::report(report)?.curve()?.clone());
        *place("out", out)? = fpt_curve::handle(CurveForm::Spline(Arc::new(curve)));
        Ok(())
    })
}

/// The surface with the weights found, as a new handle; FPT_UNSUPPORTED for a report of a curve.
///
/// @param out  the surface; release it with fpt_surface_free
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_weights_report_surface(
    report: *const fpt_weights_report,
    out: *mut *mut fpt_surface,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for a handle.
    guard(|| unsafe {
        let surface = IndexedSurface::new(self::report(report)?.surface()?.clone());
        *place("out", out)? = fpt_surface::handle(SurfaceForm::Spline(Arc::new(surface)));
        Ok(())
    })
}

/// Releases a report. NULL is fine. No other call may use the handle during or after this one.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_weights_report_free(report: *mut fpt_weights_report) {
    let release = || {
        if !report.is_null() {
            // SAFETY: a handle comes from Box::into_raw and is released once.
            drop(unsafe { Box::from_raw(report) });
        }
        Ok(())
    };
    let _ = guard(release);
}
