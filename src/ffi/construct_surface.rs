//! Quadrics, swept, blended and skinned surfaces, and offsets of surfaces.

use super::construct::{arc_form, axes, numbers, wanted};
use super::curve::{self, fpt_curve};
use super::fit::{chosen, surface_handle};
use super::memory::{array, optional_array, place};
use super::options::{SelfSized, sized};
use super::surface::fpt_surface;
use super::{Failure, fpt_status, guard};
use crate::construct::{
    self, ArcForm, Corners, Quadric, SweepOptions, coons, coons_bicubic, ferguson, gordon, quadric,
    skinned, swept,
};
use crate::curve::Curve;
use crate::elementary::CircleForm;
use std::mem::{offset_of, size_of};

/// Quadrics with an axis, for fpt_surface_quadric: distance from the axis and height along the profile's parameter t.
#[repr(C)]
#[derive(Clone, Copy)]
pub enum fpt_quadric_patch {
    /// cos t, sin t: t is a latitude.
    FPT_PATCH_ELLIPSOID = 0,
    /// cosh t, sinh t: hyperboloid of one sheet.
    FPT_PATCH_ONE_SHEET = 1,
    /// sinh t, cosh t: half a hyperboloid of two sheets, t >= 0.
    FPT_PATCH_TWO_SHEETS = 2,
    /// t, t^2: elliptic paraboloid, t >= 0.
    FPT_PATCH_PARABOLOID = 3,
    /// t, t: elliptic cone, t >= 0.
    FPT_PATCH_CONE = 4,
    /// 1, t: elliptic cylinder.
    FPT_PATCH_CYLINDER = 5,
}

/// How fpt_surface_swept moves a profile. All zero after struct_size is the default of everything but the tolerance. Grows at the end
/// only.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct fpt_sweep_options {
    /// sizeof(fpt_sweep_options), set by fpt_sweep_options_init.
    pub struct_size: usize,
    /// Length, more than 0: greatest distance from the exact swept surface at equal parameters.
    pub tolerance: f64,
    /// Turn about the tangent in all, in radians, spread evenly over the length.
    pub twist: f64,
    /// Degree along the spine, 1 to 31; 0: 3.
    pub degree: u32,
    /// 1: on a closed spine the last frame is brought onto the first; 0: not.
    pub close: u32,
    /// Most poles along the spine; 0: 2,000.
    pub max_poles: usize,
}

impl Default for fpt_sweep_options {
    fn default() -> Self {
        let struct_size = size_of::<Self>();
        Self { struct_size, tolerance: 0.0, twist: 0.0, degree: 0, close: 0, max_poles: 0 }
    }
}

// SAFETY: repr(C), begins with struct_size; numbers.
unsafe impl SelfSized for fpt_sweep_options {
    const SHORTER: &'static [usize] = &[
        offset_of!(Self, tolerance),
        offset_of!(Self, twist),
        offset_of!(Self, degree),
        offset_of!(Self, close),
        offset_of!(Self, max_poles),
    ];

    fn defaults() -> Self {
        Self::default()
    }
}

/// Fills `options` with the defaults. Touches exactly struct_size bytes: pass sizeof *options.
/// Does nothing when `options` is NULL or struct_size is smaller than a size_t.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_sweep_options_init(
    options: *mut fpt_sweep_options,
    struct_size: usize,
) {
    if options.is_null() || struct_size < size_of::<usize>() {
        return;
    }
    let known = struct_size.min(size_of::<fpt_sweep_options>());
    let defaults = fpt_sweep_options { struct_size, ..Default::default() };
    let source = (&raw const defaults).cast::<u8>();
    let target = options.cast::<u8>();
    // SAFETY: the caller's struct has `struct_size` bytes; `defaults` has no padding before `known`.
    unsafe {
        source.copy_to_nonoverlapping(target, known);
        target.add(known).write_bytes(0, struct_size - known);
    }
}

/// The spline curve behind a handle.
///
/// # Safety
/// NULL or a live handle.
unsafe fn spline<'a>(curve: *const fpt_curve) -> Result<&'a Curve, Failure> {
    // SAFETY: the caller vouches for it.
    Ok(unsafe { curve::indexed(curve) }?.curve())
}

/// The curves behind handles.
///
/// # Safety
/// NULL or `count` handles that are NULL or live.
unsafe fn splines(
    name: &'static str,
    curves: *const *const fpt_curve,
    count: usize,
) -> Result<Vec<Curve>, Failure> {
    // SAFETY: the caller vouches for the array.
    let handles = unsafe { array(name, curves, count) }?;
    let mut out = Vec::new();
    out.try_reserve_exact(count).map_err(|_| crate::error::Error::OutOfMemory)?;
    for (i, &handle) in handles.iter().enumerate() {
        if handle.is_null() {
            return Err(Failure::invalid(format!("{name}: handle {i} is NULL")));
        }
        // SAFETY: the caller vouches for each handle.
        out.push(unsafe { spline(handle) }?.clone());
    }
    Ok(out)
}

/// The part of a quadric between two angles about its axis (u, over [0, 1]) and two parameters of its profile (v).
///
/// @param kind       a value of fpt_quadric_patch
/// @param axes       as fpt_curve_arc
/// @param semi_axes  3 numbers more than 0: across along X, across along Y, along the axis
/// @param angles     begin and end in radians, at most a turn
/// @param profile    begin and end of t
/// @param form       a value of fpt_arc_form, for u
/// @param out        the handle; release it with fpt_surface_free
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_quadric(
    kind: u32,
    axes: *const f64,
    semi_axes: *const f64,
    angles: *const f64,
    profile: *const f64,
    form: u32,
    out: *mut *mut fpt_surface,
) -> fpt_status {
    // SAFETY: the header asks for arrays of these lengths and room for a handle.
    guard(|| unsafe {
        use fpt_quadric_patch::*;
        let values = [
            (FPT_PATCH_ELLIPSOID as u32, Quadric::Ellipsoid),
            (FPT_PATCH_ONE_SHEET as u32, Quadric::OneSheet),
            (FPT_PATCH_TWO_SHEETS as u32, Quadric::TwoSheets),
            (FPT_PATCH_PARABOLOID as u32, Quadric::Paraboloid),
            (FPT_PATCH_CONE as u32, Quadric::Cone),
            (FPT_PATCH_CYLINDER as u32, Quadric::Cylinder),
        ];
        let kind = chosen("kind", "FPT_PATCH_", kind, &values)?;
        let axes = self::axes(axes)?;
        let semi_axes = numbers("semi_axes", semi_axes)?;
        let angles: [f64; 2] = numbers("angles", angles)?;
        let profile = numbers("profile", profile)?;
        let form = arc_form(form, angles[1] - angles[0])?;
        let out = place("out", out)?;
        *out = surface_handle(quadric(kind, &axes, semi_axes, angles, profile, form)?);
        Ok(())
    })
}

/// The hyperbolic paraboloid origin + x X + y Y + (x^2/radius_x^2 - y^2/radius_y^2) Z over a rectangle of x and y, its parameters.
///
/// @param axes    as fpt_curve_arc
/// @param domain  4 numbers: x0, x1, y0, y1
/// @param out     the handle; release it with fpt_surface_free
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_saddle(
    axes: *const f64,
    radius_x: f64,
    radius_y: f64,
    domain: *const f64,
    out: *mut *mut fpt_surface,
) -> fpt_status {
    // SAFETY: the header asks for arrays of these lengths and room for a handle.
    guard(|| unsafe {
        let axes = self::axes(axes)?;
        let domain = numbers("domain", domain)?;
        let out = place("out", out)?;
        *out = surface_handle(construct::saddle(&axes, [radius_x, radius_y], domain)?);
        Ok(())
    })
}

/// The rectangle origin + u X + v Y.
///
/// @param axes    as fpt_curve_arc
/// @param domain  4 numbers: u0, u1, v0, v1
/// @param out     the handle; release it with fpt_surface_free
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_plane(
    axes: *const f64,
    domain: *const f64,
    out: *mut *mut fpt_surface,
) -> fpt_status {
    // SAFETY: the header asks for arrays of these lengths and room for a handle.
    guard(|| unsafe {
        let axes = self::axes(axes)?;
        let domain = numbers("domain", domain)?;
        let out = place("out", out)?;
        *out = surface_handle(construct::plane(&axes, domain)?);
        Ok(())
    })
}

/// A torus, or a part of it; u runs about the axis and v about the tube, both over [0, 1].
///
/// @param axes      as fpt_curve_arc
/// @param major     radius of the circle of centres, more than 0
/// @param minor     radius of the tube, more than 0
/// @param angles_u  begin and end in radians, at most a turn
/// @param angles_v  the same about the tube; 0 is outside
/// @param form      FPT_ARC_QUARTERS, FPT_ARC_HALVES or FPT_ARC_THIRDS, for both
/// @param out       the handle; release it with fpt_surface_free
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_torus(
    axes: *const f64,
    major: f64,
    minor: f64,
    angles_u: *const f64,
    angles_v: *const f64,
    form: u32,
    out: *mut *mut fpt_surface,
) -> fpt_status {
    // SAFETY: the header asks for arrays of these lengths and room for a handle.
    guard(|| unsafe {
        let axes = self::axes(axes)?;
        let (u, v): ([f64; 2], [f64; 2]) =
            (numbers("angles_u", angles_u)?, numbers("angles_v", angles_v)?);
        let forms = [circle_form(form, u)?, circle_form(form, v)?];
        let out = place("out", out)?;
        let torus = construct::torus(&axes, [major, minor], u, v, Some(forms))?;
        *out = surface_handle(torus);
        Ok(())
    })
}

fn circle_form(form: u32, [start, end]: [f64; 2]) -> Result<CircleForm, Failure> {
    match arc_form(form, end - start)? {
        ArcForm::Quadratic(form) => Ok(form),
        _ => Err(Failure::invalid("form: an arc of degree 2 is needed here".into())),
    }
}

/// The surface of the lines between points of two curves at equal parameters (affinely, over the domain of the first): u along the
/// curves, v from 0 on the first to 1 on the second.
///
/// @param out  the handle; release it with fpt_surface_free
/// @return FPT_UNSUPPORTED for a curve from a callback
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_ruled(
    first: *const fpt_curve,
    second: *const fpt_curve,
    out: *mut *mut fpt_surface,
) -> fpt_status {
    // SAFETY: the header asks for live handles and room for one.
    guard(|| unsafe {
        let (first, second) = (spline(first)?, spline(second)?);
        let out = place("out", out)?;
        *out = surface_handle(construct::ruled(first, second)?);
        Ok(())
    })
}

/// The surface C(u) + v * direction, v from 0 to 1.
///
/// @param direction  x,y,z, not 0
/// @param out        the handle; release it with fpt_surface_free
/// @return FPT_UNSUPPORTED for a curve from a callback
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_extruded(
    curve: *const fpt_curve,
    direction: *const f64,
    out: *mut *mut fpt_surface,
) -> fpt_status {
    // SAFETY: the header asks for a live handle, a vector and room for a handle.
    guard(|| unsafe {
        let curve = spline(curve)?;
        let direction = numbers("direction", direction)?;
        let out = place("out", out)?;
        *out = surface_handle(construct::extruded(curve, direction)?);
        Ok(())
    })
}

/// A curve turned about an axis: u the angle over [0, 1], v the parameter of the curve.
///
/// @param origin  x,y,z of a point of the axis
/// @param axis    its direction, any length
/// @param angles  begin and end in radians, right-handed, at most a turn
/// @param form    FPT_ARC_QUARTERS, FPT_ARC_HALVES or FPT_ARC_THIRDS
/// @param out     the handle; release it with fpt_surface_free
/// @return FPT_UNSUPPORTED for a curve from a callback
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_revolved(
    curve: *const fpt_curve,
    origin: *const f64,
    axis: *const f64,
    angles: *const f64,
    form: u32,
    out: *mut *mut fpt_surface,
) -> fpt_status {
    // SAFETY: the header asks for a live handle, arrays of these lengths and room for a handle.
    guard(|| unsafe {
        let curve = spline(curve)?;
        let (origin, axis) = (numbers("origin", origin)?, numbers("axis", axis)?);
        let angles = numbers("angles", angles)?;
        let form = circle_form(form, angles)?;
        let out = place("out", out)?;
        *out = surface_handle(construct::revolved(curve, origin, axis, angles, Some(form))?);
        Ok(())
    })
}

/// A curve carried along another without turning: C(u) + T(v) - T(v0). Exact.
///
/// @param out  the handle; release it with fpt_surface_free
/// @return FPT_UNSUPPORTED for a curve from a callback
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_translational(
    curve: *const fpt_curve,
    spine: *const fpt_curve,
    out: *mut *mut fpt_surface,
) -> fpt_status {
    // SAFETY: the header asks for live handles and room for one.
    guard(|| unsafe {
        let (curve, spine) = (spline(curve)?, spline(spine)?);
        let out = place("out", out)?;
        *out = surface_handle(construct::translational(curve, spine)?);
        Ok(())
    })
}

/// The bilinearly blended Coons patch of four borders.
///
/// @param borders  4 handles: along u = u0, u = u1 (in v), v = v0, v = v1 (in u); they meet at the corners within 1e-7 of their size.
///                 Rational borders are kept as point sets, not in time
/// @param out      the handle; release it with fpt_surface_free
/// @return FPT_UNSUPPORTED also for rational borders whose blend has a weight that is not positive
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_coons(
    borders: *const *const fpt_curve,
    out: *mut *mut fpt_surface,
) -> fpt_status {
    // SAFETY: the header asks for four live handles and room for one.
    guard(|| unsafe {
        let borders = four(splines("borders", borders, 4)?)?;
        let out = place("out", out)?;
        *out = surface_handle(coons(&borders)?);
        Ok(())
    })
}

fn four(curves: Vec<Curve>) -> Result<[Curve; 4], Failure> {
    curves.try_into().map_err(|_| Failure::Internal("four curves are four".into()))
}

/// The bicubically blended Coons patch: four borders, and the derivatives across them.
///
/// @param borders  as fpt_surface_coons; polynomial; opposite ones over the same domain
/// @param slopes   4 handles in the same order: curves whose points are S_u along the first two, S_v along the last two, over the
///                 same domains. At a corner they are the derivatives of the borders there, and their own derivatives agree
/// @param out      the handle; release it with fpt_surface_free
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_coons_bicubic(
    borders: *const *const fpt_curve,
    slopes: *const *const fpt_curve,
    out: *mut *mut fpt_surface,
) -> fpt_status {
    // SAFETY: the header asks for eight live handles and room for one.
    guard(|| unsafe {
        let borders = four(splines("borders", borders, 4)?)?;
        let slopes = four(splines("slopes", slopes, 4)?)?;
        let out = place("out", out)?;
        *out = surface_handle(coons_bicubic(&borders, &slopes)?);
        Ok(())
    })
}

/// The bicubic patch over [0, 1] x [0, 1] with given corners, slopes and twists (Ferguson, Hermite).
///
/// @param points    x,y,z at (0,0), (0,1), (1,0), (1,1) as (u,v)
/// @param slopes_u  S_u in the same order
/// @param slopes_v  S_v in the same order
/// @param twists    S_uv in the same order; NULL: 0
/// @param out       the handle; release it with fpt_surface_free
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_ferguson(
    points: *const f64,
    slopes_u: *const f64,
    slopes_v: *const f64,
    twists: *const f64,
    out: *mut *mut fpt_surface,
) -> fpt_status {
    // SAFETY: the header asks for arrays of these lengths and room for a handle.
    guard(|| unsafe {
        let block = |name: &'static str, list: *const f64| -> Result<[[[f64; 3]; 2]; 2], Failure> {
            let v: [f64; 12] = numbers(name, list)?;
            let at = |k: usize| [v[3 * k], v[3 * k + 1], v[3 * k + 2]];
            Ok([[at(0), at(1)], [at(2), at(3)]])
        };
        let given = Corners {
            points: block("points", points)?,
            slopes_u: block("slopes_u", slopes_u)?,
            slopes_v: block("slopes_v", slopes_v)?,
            twists: if twists.is_null() { [[[0.0; 3]; 2]; 2] } else { block("twists", twists)? },
        };
        let out = place("out", out)?;
        *out = surface_handle(ferguson(&given)?);
        Ok(())
    })
}

/// The Gordon surface through a network of polynomial curves that cross.
///
/// @param curves_u      `count_u` handles of curves in u, at least 2
/// @param parameters_v  the v of each, strictly increasing, over the domain of the first of curves_v
/// @param curves_v      `count_v` handles of curves in v, at least 2
/// @param parameters_u  the u of each, strictly increasing, over the domain of the first of curves_u
/// @param out           the handle; release it with fpt_surface_free
/// @return FPT_INVALID_ARGUMENT names curves that are more than 1e-7 of their size apart where they should cross
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_gordon(
    curves_u: *const *const fpt_curve,
    parameters_v: *const f64,
    count_u: usize,
    curves_v: *const *const fpt_curve,
    parameters_u: *const f64,
    count_v: usize,
    out: *mut *mut fpt_surface,
) -> fpt_status {
    // SAFETY: the header asks for arrays of these lengths, live handles and room for one.
    guard(|| unsafe {
        let in_u = splines("curves_u", curves_u, count_u)?;
        let in_v = splines("curves_v", curves_v, count_v)?;
        let across_v = array("parameters_v", parameters_v, count_u)?;
        let across_u = array("parameters_u", parameters_u, count_v)?;
        let out = place("out", out)?;
        *out = surface_handle(gordon(&in_u, across_v, &in_v, across_u)?);
        Ok(())
    })
}

/// The surface through sections: u along them, v across.
///
/// @param sections    `count` handles in order, at least 2; over the domain of the first, affinely
/// @param degree      across, 1 to count - 1
/// @param parameters  v of the sections, strictly increasing; NULL: from 0 to 1, by the distances of their poles
/// @param out         the handle; release it with fpt_surface_free
/// @return FPT_UNSUPPORTED also for rational sections between which a weight would not be positive
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_skinned(
    sections: *const *const fpt_curve,
    count: usize,
    degree: usize,
    parameters: *const f64,
    out: *mut *mut fpt_surface,
) -> fpt_status {
    // SAFETY: the header asks for arrays of these lengths, live handles and room for one.
    guard(|| unsafe {
        let sections = splines("sections", sections, count)?;
        let parameters = optional_array("parameters", parameters, count)?;
        let out = place("out", out)?;
        *out = surface_handle(skinned(&sections, degree, parameters)?);
        Ok(())
    })
}

/// A profile carried along a spine in a rotation minimising frame: it keeps its place relative to the spine's begin. u along the profile,
/// v is the parameter of the spine.
///
/// @param options   must not be NULL: tolerance
/// @param out       the handle; release it with fpt_surface_free
/// @param error     no point is farther from the exact swept surface at its parameters, proven; above the tolerance where max_poles or rounding
///                  do not allow it, infinite where nothing is proven (rational spines of degrees above 13). NULL: not wanted
/// @param holonomy  radians by which the frame has turned about the tangent after one way round a closed spine; 0 for open ones. NULL: not
///                  wanted
/// @return FPT_UNSUPPORTED for spines with a corner or that stand still, with the parameter
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_swept(
    profile: *const fpt_curve,
    spine: *const fpt_curve,
    options: *const fpt_sweep_options,
    out: *mut *mut fpt_surface,
    error: *mut f64,
    holonomy: *mut f64,
) -> fpt_status {
    // SAFETY: the header asks for live handles, options and room for the outputs.
    guard(|| unsafe {
        let (profile, spine) = (spline(profile)?, spline(spine)?);
        let given = sized("options", options)?;
        if given.close > 1 {
            return Err(Failure::invalid(format!("close: {} is not 0 or 1", given.close)));
        }
        let defaults = SweepOptions::default();
        let options = SweepOptions {
            tolerance: given.tolerance,
            twist: given.twist,
            degree: if given.degree == 0 { defaults.degree } else { given.degree as usize },
            close: given.close == 1,
            max_poles: if given.max_poles == 0 { defaults.max_poles } else { given.max_poles },
        };
        let out = place("out", out)?;
        let numbers = [wanted("error", error)?, wanted("holonomy", holonomy)?];
        let result = swept(profile, spine, &options)?;
        *out = surface_handle(result.surface);
        for (place, value) in numbers.into_iter().zip([result.error, result.holonomy]) {
            place.into_iter().for_each(|place| *place = value);
        }
        Ok(())
    })
}
