//! Lines, conics, arcs and offsets of curves.

use super::curve::fpt_curve;
use super::fit::{chosen, curve_handle};
use super::memory::{array, place, shared};
use super::{Failure, fpt_status, guard};
use crate::construct::{ArcForm, arc_through, conic_arc, ellipse, hyperbola, line, parabola};
use crate::elementary::{Axes, CircleForm};

/// How an arc of a circle or ellipse is written as a spline over [0, 1], for the functions that take a form.
#[repr(C)]
#[derive(Clone, Copy)]
pub enum fpt_arc_form {
    /// Degree 2: equal arcs of 3 poles that share their ends, of at most a quarter turn (a full turn has 9 poles).
    FPT_ARC_QUARTERS = 0,
    /// Degree 2: half turns of 4 poles (a full turn has 7); only for sweeps of one or two half turns.
    FPT_ARC_HALVES = 1,
    /// Degree 2: arcs of at most a third of a turn (a full turn has 7 poles).
    FPT_ARC_THIRDS = 2,
    /// Degree 3: one piece of 4 poles, for sweeps up to 4 radians.
    FPT_ARC_CUBIC = 3,
    /// Degree 5: one piece of 6 poles, for full turns.
    FPT_ARC_QUINTIC = 4,
}

pub(super) fn arc_form(number: u32, sweep: f64) -> Result<ArcForm, Failure> {
    let thirds = || {
        let share = sweep.abs() * 3.0 / std::f64::consts::TAU;
        CircleForm::Arcs(((share - 1e-9).ceil() as usize).max(1))
    };
    use fpt_arc_form::*;
    let values = [
        (FPT_ARC_QUARTERS as u32, ArcForm::usual(sweep)),
        (FPT_ARC_HALVES as u32, ArcForm::Quadratic(CircleForm::Halves)),
        (FPT_ARC_THIRDS as u32, ArcForm::Quadratic(thirds())),
        (FPT_ARC_CUBIC as u32, ArcForm::Cubic),
        (FPT_ARC_QUINTIC as u32, ArcForm::Quintic),
    ];
    chosen("form", "FPT_ARC_", number, &values)
}

/// Axes of the caller.
///
/// # Safety
/// NULL or nine numbers.
pub(super) unsafe fn axes(axes: *const f64) -> Result<Axes, Failure> {
    if axes.is_null() {
        return Ok(Axes::STANDARD);
    }
    // SAFETY: the caller vouches for it.
    let given = unsafe { array("axes", axes.cast::<[f64; 3]>(), 3) }?;
    Ok(Axes::around(given[0], given[1], given[2])?)
}

/// Numbers of the caller.
///
/// # Safety
/// NULL or N values.
pub(super) unsafe fn numbers<const N: usize>(
    name: &'static str,
    list: *const f64,
) -> Result<[f64; N], Failure> {
    // SAFETY: the caller vouches for it.
    Ok(*unsafe { shared(name, list.cast::<[f64; N]>()) }?)
}

/// The segment between two points, by its length from 0 on.
///
/// @param start  x,y,z
/// @param end    x,y,z, another point
/// @param out    the handle; release it with fpt_curve_free
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_curve_line(
    start: *const f64,
    end: *const f64,
    out: *mut *mut fpt_curve,
) -> fpt_status {
    // SAFETY: the header asks for two points and room for a handle.
    guard(|| unsafe {
        let (start, end) = (numbers("start", start)?, numbers("end", end)?);
        let out = place("out", out)?;
        *out = curve_handle(line(start, end)?);
        Ok(())
    })
}

/// The arc of the circle or ellipse origin + radius_x cos t X + radius_y sin t Y.
///
/// @param axes    9 numbers: the origin, the axis Z, and a direction whose part across Z is X (any lengths); NULL: the coordinate axes
/// @param start   t of its begin, in radians
/// @param end     t of its end, more than start by at most a turn
/// @param form    a value of fpt_arc_form
/// @param out     the handle; release it with fpt_curve_free
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_curve_arc(
    axes: *const f64,
    radius_x: f64,
    radius_y: f64,
    start: f64,
    end: f64,
    form: u32,
    out: *mut *mut fpt_curve,
) -> fpt_status {
    // SAFETY: the header asks for axes and room for a handle.
    guard(|| unsafe {
        let axes = self::axes(axes)?;
        let form = arc_form(form, end - start)?;
        let out = place("out", out)?;
        *out = curve_handle(ellipse(&axes, [radius_x, radius_y], [start, end], form)?);
        Ok(())
    })
}

/// The arc of a circle through three points, from the first over the second to the third, in quadratic pieces.
///
/// @param points  x,y,z of three points that are not on a line
/// @param out     the handle; release it with fpt_curve_free
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_curve_arc_through(
    points: *const f64,
    out: *mut *mut fpt_curve,
) -> fpt_status {
    // SAFETY: the header asks for three points and room for a handle.
    guard(|| unsafe {
        let points = array("points", points.cast::<[f64; 3]>(), 3)?;
        let out = place("out", out)?;
        *out = curve_handle(arc_through([points[0], points[1], points[2]])?);
        Ok(())
    })
}

/// The conic over a triangle: from its first pole to its third, along the sides at both.
///
/// @param poles  x,y,z of three poles
/// @param rho    shape factor between 0 and 1: ellipse below 1/2, parabola at 1/2, hyperbola above
/// @param out    the handle; release it with fpt_curve_free
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_curve_conic(
    poles: *const f64,
    rho: f64,
    out: *mut *mut fpt_curve,
) -> fpt_status {
    // SAFETY: the header asks for three points and room for a handle.
    guard(|| unsafe {
        let poles = array("poles", poles.cast::<[f64; 3]>(), 3)?;
        let out = place("out", out)?;
        *out = curve_handle(conic_arc([poles[0], poles[1], poles[2]], rho)?);
        Ok(())
    })
}

/// The arc of the parabola origin + t^2/(4 focal) X + t Y between two t, which are its parameters.
///
/// @param axes   as fpt_curve_arc
/// @param focal  distance of the focus from the apex, more than 0
/// @param out    the handle; release it with fpt_curve_free
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_curve_parabola(
    axes: *const f64,
    focal: f64,
    start: f64,
    end: f64,
    out: *mut *mut fpt_curve,
) -> fpt_status {
    // SAFETY: the header asks for axes and room for a handle.
    guard(|| unsafe {
        let axes = self::axes(axes)?;
        let out = place("out", out)?;
        *out = curve_handle(parabola(&axes, focal, [start, end])?);
        Ok(())
    })
}

/// The arc of the hyperbola origin + radius_x cosh t X + radius_y sinh t Y between two t; its parameter runs from 0 to 1.
///
/// @param axes  as fpt_curve_arc
/// @param out   the handle; release it with fpt_curve_free
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_curve_hyperbola(
    axes: *const f64,
    radius_x: f64,
    radius_y: f64,
    start: f64,
    end: f64,
    out: *mut *mut fpt_curve,
) -> fpt_status {
    // SAFETY: the header asks for axes and room for a handle.
    guard(|| unsafe {
        let axes = self::axes(axes)?;
        let out = place("out", out)?;
        *out = curve_handle(hyperbola(&axes, [radius_x, radius_y], [start, end])?);
        Ok(())
    })
}

/// Room for a number that may not be wanted.
///
/// # Safety
/// NULL or room for one.
pub(super) unsafe fn wanted<'a>(
    name: &'static str,
    out: *mut f64,
) -> Result<Option<&'a mut f64>, Failure> {
    if out.is_null() {
        return Ok(None);
    }
    // SAFETY: the caller vouches for it.
    unsafe { place(name, out) }.map(Some)
}
