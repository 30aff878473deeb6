//! Surfaces under faces: splines, functions, and elementary surfaces by their geometric parameters.

use super::curve::{self, fpt_curve};
use super::memory::{array, output, place, shared};
use super::options::{SelfSized, check_length, sized};
use super::records::{feet, fpt_foot_point};
use super::surface::{self, fpt_surface};
use super::transform::{circle_form, fpt_transform};
use super::{Failure, fpt_status, guard};
use crate::elementary::{Axes, CircleForm, Elementary, ElementarySurface, arc_by_angle};
use crate::error::Error;
use crate::ffi::form::{CurveForm, SurfaceForm};
use crate::index::{IndexedCurve, IndexedSurface};
use crate::trim::{Matching, Support, form_transform};
use std::mem::size_of;
use std::sync::Arc;

/// The kinds of elementary surfaces, for fpt_elementary_data.kind. Angles in radians.
#[repr(C)]
#[derive(Clone, Copy)]
pub enum fpt_elementary_kind {
    /// origin + u x + v y.
    FPT_ELEMENTARY_PLANE = 0,
    /// Radius first; u the angle, v the height.
    FPT_ELEMENTARY_CYLINDER = 1,
    /// Radius first at v = 0, half angle second (with sign); u the angle, v the length along a generatrix.
    FPT_ELEMENTARY_CONE = 2,
    /// Radius first; u the longitude, v the latitude, -pi/2 to pi/2.
    FPT_ELEMENTARY_SPHERE = 3,
    /// Major radius first, minor radius second; u the angle about the axis, v that of the tube.
    FPT_ELEMENTARY_TORUS = 4,
    /// The curve turned about the axis z through the origin by the angle u (right-handed); v is the curve's parameter.
    FPT_ELEMENTARY_REVOLUTION = 5,
    /// The curve moved along the vector z (of any length): curve(u) + v z.
    FPT_ELEMENTARY_EXTRUSION = 6,
}

/// The input of fpt_support_elementary. Copied: nothing is borrowed after the call.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct fpt_elementary_data {
    /// sizeof(fpt_elementary_data).
    pub struct_size: usize,
    /// A value of fpt_elementary_kind.
    pub kind: u32,
    /// Must be 0.
    pub reserved: u32,
    /// Start and end of u, start and end of v. An angle spans at most a full turn.
    pub domain: [f64; 4],
    /// A point of the axis, the centre, or the place of u = v = 0 of a plane.
    pub origin: [f64; 3],
    /// Direction of the angle 0. x, y, z are orthonormal within 1e-12, right-handed or left-handed; x and y are not looked at by
    /// revolutions and extrusions.
    pub x: [f64; 3],
    /// Direction of a quarter turn.
    pub y: [f64; 3],
    /// The axis.
    pub z: [f64; 3],
    /// What the kind calls first.
    pub first: f64,
    /// What the kind calls second.
    pub second: f64,
    /// A spline curve, for revolutions and extrusions; else NULL.
    pub curve: *const fpt_curve,
}

// SAFETY: repr(C), begins with struct_size; numbers and raw pointers.
unsafe impl SelfSized for fpt_elementary_data {
    const SHORTER: &'static [usize] = &[];

    fn defaults() -> Self {
        Self {
            struct_size: size_of::<Self>(),
            kind: 0,
            reserved: 0,
            domain: [0.0; 4],
            origin: [0.0; 3],
            x: [1.0, 0.0, 0.0],
            y: [0.0, 1.0, 0.0],
            z: [0.0, 0.0, 1.0],
            first: 0.0,
            second: 0.0,
            curve: std::ptr::null(),
        }
    }
}

/// The surface under a face. Immutable: any number of threads may use one at a time. Owned by the caller, released by
/// fpt_support_free; what it was made from may be freed before or after it.
pub struct fpt_support {
    support: Support,
}

impl fpt_support {
    /// A handle for the caller.
    pub(super) fn handle(support: Support) -> *mut Self {
        Box::into_raw(Box::new(Self { support }))
    }
}

/// The support behind a handle.
///
/// # Safety
/// NULL or a live handle.
pub(super) unsafe fn support<'a>(
    name: &'static str,
    support: *const fpt_support,
) -> Result<&'a Support, Failure> {
    // SAFETY: the caller vouches for it.
    Ok(&unsafe { shared(name, support) }?.support)
}

/// The elementary surface of a support.
pub(super) fn elementary<'a>(
    name: &str,
    support: &'a Support,
) -> Result<&'a ElementarySurface, Failure> {
    match support {
        Support::Elementary(elementary) => Ok(elementary.surface()),
        _ => Err(Failure::invalid(format!("{name}: its surface is not elementary"))),
    }
}

/// The circle forms of u and v; NULL: arcs of at most a quarter turn.
///
/// # Safety
/// NULL or an array of two numbers.
pub(super) unsafe fn forms(
    surface: &ElementarySurface,
    arcs: *const u32,
) -> Result<[CircleForm; 2], Failure> {
    if arcs.is_null() {
        return Ok(surface.usual_forms());
    }
    // SAFETY: the caller vouches for it.
    let arcs = unsafe { array("arcs", arcs, 2) }?;
    Ok([circle_form(arcs[0]), circle_form(arcs[1])])
}

/// The arc centre + cos t first + sin t second of a circle or an ellipse, as a polynomial spline of its angle t: off by some roundings of its
/// largest coordinate. For edges and meridians whose parameter is an angle; exact arcs (fpt_curve_arc) have another parameter.
///
/// @param center  3 numbers
/// @param first   3 numbers: the half diameter of t = 0
/// @param second  3 numbers: the half diameter of a quarter turn
/// @param angles  first and last t, increasing, at most a full turn apart
/// @param out     the handle; release it with fpt_curve_free
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_curve_arc_by_angle(
    center: *const f64,
    first: *const f64,
    second: *const f64,
    angles: *const f64,
    out: *mut *mut fpt_curve,
) -> fpt_status {
    // SAFETY: the header asks for arrays of these lengths and room for a handle.
    guard(|| unsafe {
        let out = place("out", out)?;
        let vector = |name, from| array(name, from, 3).map(|v: &[f64]| [v[0], v[1], v[2]]);
        let angles = array("angles", angles, 2)?;
        let curve = arc_by_angle(
            vector("center", center)?,
            vector("first", first)?,
            vector("second", second)?,
            [angles[0], angles[1]],
        )?;
        *out = fpt_curve::handle(CurveForm::Spline(Arc::new(IndexedCurve::new(curve))));
        Ok(())
    })
}

/// A support of a surface, spline or function. The search index is shared with it.
///
/// @param out  the handle; release it with fpt_support_free
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_support_new(
    surface: *const fpt_surface,
    out: *mut *mut fpt_support,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for a handle.
    guard(|| unsafe {
        let out = place("out", out)?;
        *out = fpt_support::handle(match surface::form(surface)? {
            SurfaceForm::Spline(spline) => Support::Spline(spline.clone()),
            SurfaceForm::Function(function) => Support::Callback(function.clone()),
        });
        Ok(())
    })
}

/// An elementary surface by its geometric parameters, on a rectangle of them.
///
/// @param data  the inputs, copied
/// @param out   the handle; release it with fpt_support_free
/// @return FPT_INVALID_ARGUMENT names what is not allowed: also a domain in which the radius is negative, or that leaves the curve's
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_support_elementary(
    data: *const fpt_elementary_data,
    out: *mut *mut fpt_support,
) -> fpt_status {
    // SAFETY: the header asks for a struct with a live handle or NULL, and room for a handle.
    guard(|| unsafe {
        let out = place("out", out)?;
        let data = sized("data", data)?;
        if data.reserved != 0 {
            return Err(Failure::invalid(format!("reserved: {} must be 0", data.reserved)));
        }
        let axes = Axes { origin: data.origin, x: data.x, y: data.y, z: data.z };
        let curve = || curve::indexed(data.curve).map(|curve| curve.curve().clone());
        use fpt_elementary_kind::*;
        let kind = match data.kind {
            kind if kind == FPT_ELEMENTARY_PLANE as u32 => Elementary::Plane { axes },
            kind if kind == FPT_ELEMENTARY_CYLINDER as u32 => {
                Elementary::Cylinder { axes, radius: data.first }
            }
            kind if kind == FPT_ELEMENTARY_CONE as u32 => {
                Elementary::Cone { axes, radius: data.first, half_angle: data.second }
            }
            kind if kind == FPT_ELEMENTARY_SPHERE as u32 => {
                Elementary::Sphere { axes, radius: data.first }
            }
            kind if kind == FPT_ELEMENTARY_TORUS as u32 => {
                Elementary::Torus { axes, major: data.first, minor: data.second }
            }
            kind if kind == FPT_ELEMENTARY_REVOLUTION as u32 => {
                Elementary::Revolution { origin: data.origin, axis: data.z, meridian: curve()? }
            }
            kind if kind == FPT_ELEMENTARY_EXTRUSION as u32 => {
                Elementary::Extrusion { curve: curve()?, direction: data.z }
            }
            kind => {
                let text = format!("kind: {kind} is not an FPT_ELEMENTARY_ value");
                return Err(Failure::invalid(text));
            }
        };
        *out = fpt_support::handle(ElementarySurface::new(kind, data.domain)?.into());
        Ok(())
    })
}

/// First and last parameters.
///
/// @param out  u0, u1, v0, v1
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_support_domain(
    support: *const fpt_support,
    out: *mut f64,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for four numbers.
    guard(|| unsafe {
        let domain = self::support("support", support)?.domain();
        output("out", out, 4)?.copy_from_slice(&domain);
        Ok(())
    })
}

/// The points at many places; a place outside of the domain is moved to its border first.
///
/// @param uv     2 * count numbers, finite
/// @param out    3 * count numbers; NaN where a function fails
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_support_evaluate(
    support: *const fpt_support,
    uv: *const f64,
    count: usize,
    out: *mut f64,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and two arrays.
    guard(|| unsafe {
        let support = self::support("support", support)?;
        let places = array("uv", uv.cast::<[f64; 2]>(), count)?;
        if let Some(k) = places.iter().position(|p| p.iter().any(|x| !x.is_finite())) {
            return Err(Failure::invalid(format!("uv: entry {k} is not finite")));
        }
        let out = output("out", out.cast::<[f64; 3]>(), count)?;
        places.iter().zip(out).for_each(|(p, q)| *q = support.evaluate(*p));
        Ok(())
    })
}

/// The support as a spline surface. That of an elementary surface is its exact NURBS form: angles become a parameter from 0 to 1, the
/// other direction keeps its parameter.
///
/// @param arcs  circle forms of u and v as fpt_relation_circle has them, not looked at where there is no angle; NULL: arcs of at most a
///              quarter turn
/// @param out   the handle; release it with fpt_surface_free
/// @return FPT_INVALID_ARGUMENT for a form that cannot make the sweep, FPT_UNSUPPORTED for a function
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_support_spline(
    support: *const fpt_support,
    arcs: *const u32,
    out: *mut *mut fpt_surface,
) -> fpt_status {
    // SAFETY: the header asks for a live handle, two numbers or NULL, and room for a handle.
    guard(|| unsafe {
        let out = place("out", out)?;
        let spline = match self::support("support", support)? {
            Support::Spline(spline) => spline.clone(),
            Support::Elementary(elementary) => {
                let surface = elementary.surface();
                Arc::new(IndexedSurface::new(surface.nurbs(forms(surface, arcs)?)?))
            }
            Support::Callback(_) => {
                let text = "support: is given by a function; it has no spline form";
                return Err(Error::Unsupported(text.into()).into());
            }
        };
        *out = fpt_surface::handle(SurfaceForm::Spline(spline));
        Ok(())
    })
}

/// The transform from the parameters of an elementary surface to those of its NURBS form, exact at the ends.
///
/// @param arcs  as for fpt_support_spline
/// @param out   the handle; release it with fpt_transform_free
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_support_spline_transform(
    support: *const fpt_support,
    arcs: *const u32,
    out: *mut *mut fpt_transform,
) -> fpt_status {
    // SAFETY: the header asks for a live handle, two numbers or NULL, and room for a handle.
    guard(|| unsafe {
        let out = place("out", out)?;
        let surface = elementary("support", self::support("support", support)?)?;
        *out = fpt_transform::handle(form_transform(surface, forms(surface, arcs)?)?);
        Ok(())
    })
}

/// The transform between two parametrisations of one surface, found by proven inversions: (s, t) = (f(u), g(v)) with monotone f and
/// g is assumed and checked. Both have their seams at the same place. What it is used for is measured, not proven.
///
/// @param tolerance  length, finite, >= 0: how far points of one may be from the other; 0: 1e-7 x the diagonal of the box
/// @param out        the handle; release it with fpt_transform_free
/// @return FPT_INVALID_ARGUMENT when the surfaces differ, their seams are elsewhere, or parameters do not follow each other
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_support_match(
    from: *const fpt_support,
    to: *const fpt_support,
    tolerance: f64,
    out: *mut *mut fpt_transform,
) -> fpt_status {
    // SAFETY: the header asks for live handles and room for a handle.
    guard(|| unsafe {
        let out = place("out", out)?;
        let (from, to) = (support("from", from)?, support("to", to)?);
        check_length("tolerance", tolerance)?;
        let matching = Matching::new(from.clone(), to.clone(), tolerance)?;
        *out = fpt_transform::handle(matching.transform()?);
        Ok(())
    })
}

/// As fpt_support_match, for many places at once. A record has the parameters on the target, the point there and its distance from the
/// point of the place; lower_bound is 0. Places on a border of the domain give the border that belongs to it: no seam or pole point
/// is on the wrong side.
///
/// Flags: FPT_FOOT_NOT_PROVEN when an inversion was not proven, FPT_FOOT_NOT_ON_SHAPE when the distance is beyond the tolerance,
/// FPT_FOOT_BAD_QUERY for a place outside of the domain.
///
/// @param uv       2 * count numbers
/// @param threads  0: all cores, 1: the calling thread only
/// @param out      count records
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_support_match_many(
    from: *const fpt_support,
    to: *const fpt_support,
    tolerance: f64,
    uv: *const f64,
    count: usize,
    threads: u32,
    out: *mut fpt_foot_point,
) -> fpt_status {
    // SAFETY: the header asks for live handles and two arrays.
    guard(|| unsafe {
        let (from, to) = (support("from", from)?, support("to", to)?);
        check_length("tolerance", tolerance)?;
        let places = array("uv", uv.cast::<[f64; 2]>(), count)?;
        let out = feet(out, count)?;
        let matching = Matching::new(from.clone(), to.clone(), tolerance)?;
        Ok(matching.images(places, out, threads as usize, &mut |_| false)?)
    })
}

/// Releases a support. NULL is fine.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_support_free(support: *mut fpt_support) {
    if !support.is_null() {
        // SAFETY: a handle comes from Box::into_raw and is released once.
        let _ = guard(|| unsafe {
            drop(Box::from_raw(support));
            Ok(())
        });
    }
}
