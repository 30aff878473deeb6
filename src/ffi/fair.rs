//! Fairing: options, and reports with the new shape.

use super::curve::{self, fpt_curve};
use super::form::{CurveForm, SurfaceForm};
use super::inspect_records::{choice, initialise, sized_or_default};
use super::memory::{array, place, shared, write, write_array};
use super::options::SelfSized;
use super::query::Callbacks;
use super::surface::{self, fpt_surface};
use super::{Failure, fpt_status, guard};
use crate::curve::Curve;
use crate::fair::{CurveFairing, Faired, Method, SurfaceFairing, fair_curve, fair_surface};
use crate::index::{IndexedCurve, IndexedSurface};
use crate::surface::Surface;
use std::ffi::{c_int, c_void};
use std::mem::size_of;
use std::sync::Arc;

/// How poles are moved, for fpt_fair_options.method.
#[repr(C)]
#[derive(Clone, Copy)]
pub enum fpt_fair_method {
    /// All poles at once, to the least energy that the constraints allow.
    FPT_FAIR_ENERGY = 0,
    /// One pole at a time, where the energy falls most (Eck, Hadenfeld).
    FPT_FAIR_LOCAL = 1,
    /// One knot (line) at a time: what removing it would do to the poles (Farin, Sapidis). The energy is the sum of the squared jumps of
    /// the first derivative that is not continuous. Polynomial surfaces only, curves of any kind.
    FPT_FAIR_KNOT_REMOVAL = 2,
}

/// What a shape is faired for, and what must stay. Fill it with fpt_fair_options_init, then set the deviation. Grows at the end only.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct fpt_fair_options {
    /// sizeof(fpt_fair_options), set by fpt_fair_options_init.
    pub struct_size: usize,
    /// Length, positive: how far a point may move from the point of the same parameters. Must be set.
    pub deviation: f64,
    /// Weight of the integral of the squared second derivative (curves), of the thin plate |Suu|^2 + 2 |Suv|^2 + |Svv|^2
    /// (surfaces); finite, >= 0. Default 1.
    pub strain: f64,
    /// Weight of the integral of the squared third derivatives; finite, >= 0. Default 0.
    pub jerk: f64,
    /// Weight of the integral of the squared distance from the shape as it was; finite, >= 0. Default 0.
    pub distance: f64,
    /// A value of fpt_fair_method.
    pub method: u32,
    /// Curves: 1: derivatives and integrals by the arc length of the curve as it was, 0: by the parameter.
    pub by_length: u32,
    /// Curves: what is kept at the start and at the end. 0 nothing, 1 the point, 2 the first derivative too, 3 the second too. Default 2.
    pub ends: [u32; 2],
    /// Surfaces: what is kept along u0, u1, v0, v1. 0 nothing, 1 the border (G0), 2 first cross derivatives too (G1), 3 second
    /// ones too (G2). Default 2. The direction must be clamped there, unless 0 or periodic.
    pub borders: [u32; 4],
    /// Curves: `fixed_count` numbers of poles that stay. NULL: none.
    pub fixed: *const usize,
    /// See fixed.
    pub fixed_count: usize,
    /// Curves: `through_count` parameters whose points stay. NULL: none.
    pub through: *const f64,
    /// See through.
    pub through_count: usize,
    /// Curves: `knot_count` knots that FPT_FAIR_KNOT_REMOVAL and FPT_FAIR_LOCAL may fair: of each the pole in the middle of its jump
    /// moves. NULL: all inner ones, with FPT_FAIR_LOCAL all poles.
    pub knots: *const f64,
    /// See knots.
    pub knot_count: usize,
    /// Curves: least and greatest arc length, which the curve has already. Both 0: any.
    pub length: [f64; 2],
    /// Surfaces: only the part u0,u1,v0,v1 changes. All 0: the whole surface.
    pub region: [f64; 4],
    /// Solutions of the equations at most, five a step (local methods: steps, eight a pole at least); 0: the default, 300 (curves), 150
    /// (surfaces).
    pub steps: u32,
    /// Planar curves, FPT_FAIR_ENERGY: 1: no more changes of the side to which the curve bends than the curve of least jerk by length
    /// has that the constraints allow; as much of that energy is added as this takes. 0: only the energy asked for. Default 1.
    pub calm: u32,
    /// Asked on the calling thread between steps; non-zero ends the call with FPT_CANCELLED. NULL: never.
    pub should_stop: Option<unsafe extern "C" fn(user: *mut c_void) -> c_int>,
    /// Handed to should_stop as it is.
    pub user: *mut c_void,
    /// Curves, FPT_FAIR_ENERGY: weight of the integral of the squared change of the curvature vector along the arc length of the curve
    /// as it becomes: (dk/ds)^2 of planar curves, (dk/ds)^2 + k^2 tau^2 in space; finite, >= 0. Default 0.
    pub slope: f64,
}

// SAFETY: repr(C), begins with struct_size; numbers, raw pointers and nullable function pointers.
unsafe impl SelfSized for fpt_fair_options {
    const SHORTER: &'static [usize] = &[];

    fn defaults() -> Self {
        Self {
            struct_size: size_of::<Self>(),
            deviation: 0.0,
            strain: 1.0,
            jerk: 0.0,
            distance: 0.0,
            method: fpt_fair_method::FPT_FAIR_ENERGY as u32,
            by_length: 0,
            ends: [2; 2],
            borders: [2; 4],
            fixed: std::ptr::null(),
            fixed_count: 0,
            through: std::ptr::null(),
            through_count: 0,
            knots: std::ptr::null(),
            knot_count: 0,
            length: [0.0; 2],
            region: [0.0; 4],
            steps: 0,
            calm: 1,
            should_stop: None,
            user: std::ptr::null_mut(),
            slope: 0.0,
        }
    }
}

/// Fills `options` with the defaults. Touches exactly struct_size bytes: pass sizeof *options.
/// Does nothing when `options` is NULL or struct_size is smaller than a size_t.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_fair_options_init(options: *mut fpt_fair_options, struct_size: usize) {
    // SAFETY: the caller's struct has `struct_size` bytes.
    unsafe { initialise(options, struct_size) }
}

/// A faired shape and what is known of it. Immutable, owned by the caller, released by fpt_fair_report_free; it does not refer to the
/// shape that it came from.
pub struct fpt_fair_report {
    result: Outcome,
}

enum Outcome {
    Curve(Faired<Curve>),
    Surface(Faired<Surface>),
}

/// A report in a few numbers: 40 bytes, frozen.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fpt_fair_summary {
    /// The energy before the first step.
    pub energy_before: f64,
    /// The energy after the last step, never more.
    pub energy_after: f64,
    /// No point has moved farther from the point of the same parameters, proven; at most the deviation asked for.
    pub deviation: f64,
    /// Steps that lowered the energy.
    pub steps: u64,
    /// 1: the last steps changed the energy by less than a millionth.
    pub converged: u32,
    /// 0.
    pub reserved: u32,
}

impl fpt_fair_report {
    fn energies(&self) -> &[f64] {
        match &self.result {
            Outcome::Curve(faired) => &faired.energies,
            Outcome::Surface(faired) => &faired.energies,
        }
    }

    fn summary(&self) -> fpt_fair_summary {
        let (deviation, converged) = match &self.result {
            Outcome::Curve(faired) => (faired.deviation, faired.converged),
            Outcome::Surface(faired) => (faired.deviation, faired.converged),
        };
        let energies = self.energies();
        fpt_fair_summary {
            energy_before: energies[0],
            energy_after: energies[energies.len() - 1],
            deviation,
            steps: energies.len() as u64 - 1,
            converged: converged.into(),
            reserved: 0,
        }
    }
}

fn method(number: u32) -> Result<Method, Failure> {
    use fpt_fair_method::*;
    let methods = [
        (FPT_FAIR_ENERGY as u32, Method::Energy),
        (FPT_FAIR_LOCAL as u32, Method::Local),
        (FPT_FAIR_KNOT_REMOVAL as u32, Method::KnotRemoval),
    ];
    choice("method", number, &methods, "an fpt_fair_method value")
}

/// Small numbers as the core takes them.
fn orders<const N: usize>(given: [u32; N]) -> [usize; N] {
    given.map(|x| x as usize)
}

/// The options, checked but for what the core checks.
///
/// # Safety
/// As [`super::options::sized`], and arrays as documented.
unsafe fn read(options: *const fpt_fair_options) -> Result<fpt_fair_options, Failure> {
    // SAFETY: the caller vouches for it.
    let given = unsafe { sized_or_default("options", options) }?;
    for (name, value) in [("calm", given.calm), ("by_length", given.by_length)] {
        if value > 1 {
            return Err(Failure::invalid(format!("{name}: {value} is not 0 or 1")));
        }
    }
    Ok(given)
}

/// A fairer curve on the same knots and weights.
///
/// @param options  what is wanted; deviation must be set, so NULL is FPT_INVALID_ARGUMENT
/// @param out      the report; release it with fpt_fair_report_free
/// @return FPT_INVALID_ARGUMENT names the option; FPT_UNSUPPORTED for a curve from a callback
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_fair_curve(
    curve: *const fpt_curve,
    options: *const fpt_fair_options,
    out: *mut *mut fpt_fair_report,
) -> fpt_status {
    // SAFETY: the header asks for a live handle, options with their arrays and room for a handle.
    guard(|| unsafe {
        let curve = curve::indexed(curve)?.curve();
        let given = read(options)?;
        let fairing = CurveFairing {
            method: method(given.method)?,
            strain: given.strain,
            jerk: given.jerk,
            slope: given.slope,
            distance: given.distance,
            by_length: given.by_length == 1,
            deviation: given.deviation,
            ends: orders(given.ends),
            fixed: array("fixed", given.fixed, given.fixed_count)?.to_vec(),
            through: array("through", given.through, given.through_count)?.to_vec(),
            knots: array("knots", given.knots, given.knot_count)?.to_vec(),
            length: (given.length != [0.0; 2]).then_some(given.length),
            calm: given.calm == 1,
            steps: if given.steps > 0 { given.steps as usize } else { 300 },
        };
        let callbacks = Callbacks::stopping(given.should_stop, given.user);
        let out = place("out", out)?;
        let faired = fair_curve(curve, &fairing, &mut || callbacks.poll(0, 0))?;
        *out = Box::into_raw(Box::new(fpt_fair_report { result: Outcome::Curve(faired) }));
        Ok(())
    })
}

/// A fairer surface on the same knots and weights.
///
/// @param options  what is wanted; deviation must be set, so NULL is FPT_INVALID_ARGUMENT
/// @param out      the report; release it with fpt_fair_report_free
/// @return FPT_INVALID_ARGUMENT names the option; FPT_UNSUPPORTED for a surface from a callback, knot removal of a rational surface,
///         and borders of a direction that is not clamped; FPT_OUT_OF_MEMORY for too many poles
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_fair_surface(
    surface: *const fpt_surface,
    options: *const fpt_fair_options,
    out: *mut *mut fpt_fair_report,
) -> fpt_status {
    // SAFETY: the header asks for a live handle, options and room for a handle.
    guard(|| unsafe {
        let surface = surface::indexed(surface)?.surface();
        let given = read(options)?;
        let fairing = SurfaceFairing {
            method: method(given.method)?,
            plate: given.strain,
            jerk: given.jerk,
            distance: given.distance,
            deviation: given.deviation,
            borders: orders(given.borders),
            region: (given.region != [0.0; 4]).then_some(given.region),
            steps: if given.steps > 0 { given.steps as usize } else { 150 },
        };
        let callbacks = Callbacks::stopping(given.should_stop, given.user);
        let out = place("out", out)?;
        let faired = fair_surface(surface, &fairing, &mut || callbacks.poll(0, 0))?;
        *out = Box::into_raw(Box::new(fpt_fair_report { result: Outcome::Surface(faired) }));
        Ok(())
    })
}

/// The numbers of a report.
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_fair_report_summary(
    report: *const fpt_fair_report,
    out: *mut fpt_fair_summary,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for a record.
    guard(|| unsafe { write("out", shared("report", report)?.summary(), out) })
}

/// The energy before the first step and after each, never rising.
///
/// @param capacity      numbers that out_energies has room for, at least the steps of the summary + 1
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_fair_report_energies(
    report: *const fpt_fair_report,
    capacity: usize,
    out_energies: *mut f64,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for `capacity` numbers.
    guard(|| unsafe {
        write_array("out_energies", shared("report", report)?.energies(), capacity, out_energies)
    })
}

/// The faired curve, a new handle.
///
/// @param out_curve  release it with fpt_curve_free
/// @return FPT_UNSUPPORTED when a surface was faired
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_fair_report_curve(
    report: *const fpt_fair_report,
    out_curve: *mut *mut fpt_curve,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for a handle.
    guard(|| unsafe {
        let Outcome::Curve(faired) = &shared("report", report)?.result else {
            return Err(other("curve"));
        };
        let out = place("out_curve", out_curve)?;
        let curve = Arc::new(IndexedCurve::new(faired.shape.clone()));
        *out = fpt_curve::handle(CurveForm::Spline(curve));
        Ok(())
    })
}

/// The faired surface, a new handle.
///
/// @param out_surface  release it with fpt_surface_free
/// @return FPT_UNSUPPORTED when a curve was faired
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_fair_report_surface(
    report: *const fpt_fair_report,
    out_surface: *mut *mut fpt_surface,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for a handle.
    guard(|| unsafe {
        let Outcome::Surface(faired) = &shared("report", report)?.result else {
            return Err(other("surface"));
        };
        let out = place("out_surface", out_surface)?;
        let surface = Arc::new(IndexedSurface::new(faired.shape.clone()));
        *out = fpt_surface::handle(SurfaceForm::Spline(surface));
        Ok(())
    })
}

fn other(wanted: &str) -> Failure {
    crate::error::Error::Unsupported(format!("report: is not that of a {wanted}")).into()
}

/// Releases a report. NULL is fine.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_fair_report_free(report: *mut fpt_fair_report) {
    if !report.is_null() {
        // SAFETY: made by Box::into_raw and not released before (the header's rule).
        drop(unsafe { Box::from_raw(report) });
    }
}
