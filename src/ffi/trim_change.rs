//! Trimmed surfaces under other parametrisations of their surfaces, and merged.

use super::memory::place;
use super::options::{SelfSized, check_length, sized};
use super::support::{elementary, forms, fpt_support, support};
use super::transform::{fpt_transform, transform};
use super::trim::{face, fpt_trim};
use super::{Failure, fpt_status, guard};
use crate::operate::Direction;
use crate::trim::{ChangeOptions, Changed, Replacement};
use std::mem::{offset_of, size_of};

/// What becomes of splines and arcs in the domain under transforms that are not linear, for fpt_change_options.replacement.
#[repr(C)]
#[derive(Clone, Copy)]
pub enum fpt_replacement {
    /// Polylines.
    FPT_REPLACEMENT_POLYLINE = 0,
    /// Cubic splines.
    FPT_REPLACEMENT_SPLINE = 1,
    /// Polylines; of polylines the vertices are mapped and none is added: they stand for themselves.
    FPT_REPLACEMENT_VERTICES = 2,
}

/// How a face is changed. Fill it with fpt_change_options_init. All zero after struct_size is the default of everything. Grows at the
/// end only.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct fpt_change_options {
    /// sizeof(fpt_change_options), set by fpt_change_options_init.
    pub struct_size: usize,
    /// Length, finite, >= 0: largest distance of old and new images of a curve at the same parameter. 0: 1e-7 x the diagonal of the box
    /// of the new surface.
    pub tolerance: f64,
    /// A value of fpt_replacement.
    pub replacement: u32,
    /// Must be 0.
    pub reserved: u32,
}

impl Default for fpt_change_options {
    fn default() -> Self {
        Self { struct_size: size_of::<Self>(), tolerance: 0.0, replacement: 0, reserved: 0 }
    }
}

// SAFETY: repr(C), begins with struct_size; numbers.
unsafe impl SelfSized for fpt_change_options {
    const SHORTER: &'static [usize] = &[offset_of!(Self, tolerance), offset_of!(Self, replacement)];

    fn defaults() -> Self {
        Self::default()
    }
}

/// How well a face was changed. 24 bytes, frozen.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct fpt_change_summary {
    /// Largest distance of old and new images of a curve at the same parameter: 0 where all are exact.
    pub deviation: f64,
    /// Largest distance of the old and the new surface at places that belong together.
    pub surface_deviation: f64,
    /// 1: the deviation is proven; 0: it is the largest at samples.
    pub proven: u32,
    /// 1: that of the surfaces is proven; 0: it is the largest at 33 x 33 places.
    pub surface_proven: u32,
}

/// Sets all options to their defaults.
///
/// @param options      room for struct_size bytes
/// @param struct_size  sizeof(fpt_change_options)
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_change_options_init(
    options: *mut fpt_change_options,
    struct_size: usize,
) {
    if options.is_null() || struct_size < size_of::<usize>() {
        return;
    }
    let known = struct_size.min(size_of::<fpt_change_options>());
    let defaults = fpt_change_options { struct_size, ..Default::default() };
    let source = (&raw const defaults).cast::<u8>();
    let target = options.cast::<u8>();
    // SAFETY: the caller's struct has `struct_size` bytes; `defaults` has no padding.
    unsafe {
        source.copy_to_nonoverlapping(target, known);
        target.add(known).write_bytes(0, struct_size - known);
    }
}

/// # Safety
/// NULL or a struct of the size that it says.
unsafe fn read(options: *const fpt_change_options) -> Result<ChangeOptions, Failure> {
    if options.is_null() {
        return Ok(ChangeOptions::default());
    }
    // SAFETY: the caller vouches for it.
    let given = unsafe { sized("options", options) }?;
    check_length("tolerance", given.tolerance)?;
    if given.reserved != 0 {
        return Err(Failure::invalid(format!("reserved: {} must be 0", given.reserved)));
    }
    use fpt_replacement::*;
    let replacement = match given.replacement {
        x if x == FPT_REPLACEMENT_POLYLINE as u32 => Replacement::Polyline,
        x if x == FPT_REPLACEMENT_SPLINE as u32 => Replacement::Spline,
        x if x == FPT_REPLACEMENT_VERTICES as u32 => Replacement::Vertices,
        x => {
            let text = format!("replacement: {x} is not an FPT_REPLACEMENT_ value");
            return Err(Failure::invalid(text));
        }
    };
    Ok(ChangeOptions { tolerance: given.tolerance, replacement })
}

/// Hands a changed face over.
///
/// # Safety
/// NULL or room for a record; room for a handle.
unsafe fn hand_over(
    changed: Changed,
    out: &mut *mut fpt_trim,
    out_summary: *mut fpt_change_summary,
) -> Result<(), Failure> {
    let summary = fpt_change_summary {
        deviation: changed.deviation,
        surface_deviation: changed.surface_deviation,
        proven: u32::from(changed.proven),
        surface_proven: u32::from(changed.surface_proven),
    };
    if !out_summary.is_null() {
        // SAFETY: the caller vouches for it.
        *unsafe { place("out_summary", out_summary) }? = summary;
    }
    *out = fpt_trim::handle(changed.face);
    Ok(())
}

/// The face on another surface, which is its surface in the parameters of a transform. Isolines, polylines, and under linear transforms
/// everything, keep their kind; other curves are replaced within the tolerance. A transform that turns directions turns every curve and
/// loop, the sense of edges and that of the face: outer loops stay counter-clockwise, the normal in space stays. Edges stay.
///
/// @param transform    from the domain of the face's surface to that of `support`
/// @param support      the other surface
/// @param options      NULL: the defaults
/// @param out          the handle; release it with fpt_trim_free
/// @param out_summary  how well; NULL: not wanted
/// @return FPT_INVALID_ARGUMENT for domains that do not fit, or surfaces that differ by more than the tolerance, with the place;
///         FPT_UNSUPPORTED when a curve would take more than 1,048,576 vertices
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_trim_change(
    trim: *const fpt_trim,
    transform: *const fpt_transform,
    support: *const fpt_support,
    options: *const fpt_change_options,
    out: *mut *mut fpt_trim,
    out_summary: *mut fpt_change_summary,
) -> fpt_status {
    // SAFETY: the header asks for live handles, options, and room for the answers.
    guard(|| unsafe {
        let out = place("out", out)?;
        let face = face("trim", trim)?;
        let transform = self::transform("transform", transform)?;
        let support = self::support("support", support)?.clone();
        hand_over(face.changed(transform, support, &read(options)?)?, out, out_summary)
    })
}

/// The face with its surface in the parameters of a transform. Under a linear transform a spline stays one, exactly; else the new surface
/// is a function of the old one, and nothing is proven.
///
/// @param options      NULL: the defaults
/// @param out          the handle; release it with fpt_trim_free
/// @param out_summary  how well; NULL: not wanted
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_trim_reparametrise(
    trim: *const fpt_trim,
    transform: *const fpt_transform,
    options: *const fpt_change_options,
    out: *mut *mut fpt_trim,
    out_summary: *mut fpt_change_summary,
) -> fpt_status {
    // SAFETY: the header asks for live handles, options, and room for the answers.
    guard(|| unsafe {
        let out = place("out", out)?;
        let face = face("trim", trim)?;
        let transform = self::transform("transform", transform)?;
        hand_over(face.reparametrised(transform, &read(options)?)?, out, out_summary)
    })
}

/// The face of an elementary surface on the exact NURBS form of it.
///
/// @param arcs         circle forms of u and v, as for fpt_support_spline; NULL: arcs of at most a quarter turn
/// @param options      NULL: the defaults
/// @param out          the handle; release it with fpt_trim_free
/// @param out_summary  how well; NULL: not wanted
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_trim_to_nurbs(
    trim: *const fpt_trim,
    arcs: *const u32,
    options: *const fpt_change_options,
    out: *mut *mut fpt_trim,
    out_summary: *mut fpt_change_summary,
) -> fpt_status {
    // SAFETY: the header asks for a live handle, two numbers or NULL, options, and room for the answers.
    guard(|| unsafe {
        let out = place("out", out)?;
        let face = face("trim", trim)?;
        let forms = forms(elementary("trim", face.support())?, arcs)?;
        hand_over(face.to_nurbs(forms, &read(options)?)?, out, out_summary)
    })
}

/// The face of a NURBS form on the elementary surface that it is the form of; knots may have been refined and degrees raised.
///
/// @param support      an elementary surface
/// @param arcs         the circle forms that the surface of the face has, as for fpt_support_spline
/// @param options      NULL: the defaults
/// @param out          the handle; release it with fpt_trim_free
/// @param out_summary  how well; NULL: not wanted
/// @return FPT_INVALID_ARGUMENT also when the surface of the face is not that form, with a place where it differs
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_trim_to_elementary(
    trim: *const fpt_trim,
    support: *const fpt_support,
    arcs: *const u32,
    options: *const fpt_change_options,
    out: *mut *mut fpt_trim,
    out_summary: *mut fpt_change_summary,
) -> fpt_status {
    // SAFETY: the header asks for live handles, two numbers or NULL, options, and room for the answers.
    guard(|| unsafe {
        let out = place("out", out)?;
        let face = face("trim", trim)?;
        let surface = elementary("support", self::support("support", support)?)?;
        let forms = forms(surface, arcs)?;
        let changed = face.to_elementary(surface.clone(), forms, &read(options)?)?;
        hand_over(changed, out, out_summary)
    })
}

/// The face on the same surface in any other parameters, found by proven inversions along its curves, which become polylines. On seams and
/// collapsed edges of the new surface the side is told by where the curve comes from: a loop stays one closed loop. The deviation is
/// measured, not proven.
///
/// @param support      the same surface in other parameters
/// @param options      the tolerance counts; NULL: the defaults
/// @param out          the handle; release it with fpt_trim_free
/// @param out_summary  how well; NULL: not wanted
/// @return FPT_UNSUPPORTED for a loop that crosses a seam of the new surface: it would have to be cut there
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_trim_follow(
    trim: *const fpt_trim,
    support: *const fpt_support,
    options: *const fpt_change_options,
    out: *mut *mut fpt_trim,
    out_summary: *mut fpt_change_summary,
) -> fpt_status {
    // SAFETY: the header asks for live handles, options, and room for the answers.
    guard(|| unsafe {
        let out = place("out", out)?;
        let face = face("trim", trim)?;
        let support = self::support("support", support)?.clone();
        hand_over(face.followed(support, &read(options)?)?, out, out_summary)
    })
}

/// Two faces whose domains follow each other made one face. What their coedges have in common on the border is taken out; what is left
/// is joined to loops again. Edges that end up inside are dropped.
///
/// @param first      the face whose domain ends where that of the other begins
/// @param second     the other face, with the same normal
/// @param direction  0: the domains follow each other in u; 1: in v
/// @param support    the surface of both: its domain is the union
/// @param options    the tolerance counts; NULL: the defaults
/// @param out        the handle; release it with fpt_trim_free
/// @return FPT_INVALID_ARGUMENT for domains that do not follow each other bit for bit, a surface that differs, or loops that do not close
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_trim_merge(
    first: *const fpt_trim,
    second: *const fpt_trim,
    direction: u32,
    support: *const fpt_support,
    options: *const fpt_change_options,
    out: *mut *mut fpt_trim,
) -> fpt_status {
    // SAFETY: the header asks for live handles, options, and room for a handle.
    guard(|| unsafe {
        let out = place("out", out)?;
        let (first, second) = (face("first", first)?, face("second", second)?);
        let direction = match direction {
            0 => Direction::U,
            1 => Direction::V,
            x => return Err(Failure::invalid(format!("direction: {x} is neither 0 nor 1"))),
        };
        let support = self::support("support", support)?.clone();
        let merged = first.merged(second, direction, support, &read(options)?)?;
        *out = fpt_trim::handle(merged);
        Ok(())
    })
}
