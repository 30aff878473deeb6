//! What is measured on shapes: arc length, frames, continuity at the knots; and the power form.

use super::curve::{fpt_curve, plain};
use super::limits::check_degree;
use super::memory::{array, output, place, shared, write};
use super::operate_curve::hand_over;
use super::operate_surface::{self, read_direction};
use super::surface::{self, fpt_surface};
use super::{Failure, fpt_status, guard};
use crate::curve::insertion::copy_of;
use crate::knots::Side;
use crate::operate::{ArcLength, Crease, Joint, PowerCurve, PowerSurface};

/// The arc length of a curve as a function of its parameter. Immutable: any number of threads may use one at a time. Owned by the caller,
/// released by fpt_arc_length_free; the curve may be released before.
pub struct fpt_arc_length {
    length: ArcLength,
}

/// A number and how far it may be from the true one: 16 bytes, frozen.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fpt_estimate {
    /// The number.
    pub value: f64,
    /// The true one is not farther from it. Proven.
    pub error: f64,
}

/// The moving frame of a curve: 120 bytes, frozen. NaN marks what is not defined.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fpt_curve_frame_record {
    /// The point.
    pub point: [f64; 3],
    /// Unit tangent; NaN where the first derivative is 0.
    pub tangent: [f64; 3],
    /// Unit vector to the centre of curvature; NaN where the curve is straight.
    pub normal: [f64; 3],
    /// Tangent x normal.
    pub binormal: [f64; 3],
    /// Length of the first derivative.
    pub speed: f64,
    /// 1 / length, >= 0.
    pub curvature: f64,
    /// 1 / length, positive for right-handed screws; NaN where the curve is straight.
    pub torsion: f64,
}

/// How the pieces of a curve meet at a knot: 48 bytes, frozen.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fpt_joint {
    /// The knot; the seam of a closed curve is reported at the end of the domain.
    pub u: f64,
    /// How often it is a knot.
    pub multiplicity: u32,
    /// The highest order to which all derivatives agree; 0 is a mere join.
    pub order: u32,
    /// Length of the gap between the pieces.
    pub gap: f64,
    /// Length of the jump of the first derivative.
    pub first_jump: f64,
    /// Angle of the tangents in radians; NaN beside a cusp.
    pub tangent_angle: f64,
    /// Length of the jump of the curvature vector, 1 / length; NaN beside a cusp.
    pub curvature_jump: f64,
}

impl From<Joint> for fpt_joint {
    fn from(joint: Joint) -> Self {
        Self {
            u: joint.u,
            multiplicity: joint.multiplicity as u32,
            order: joint.order as u32,
            gap: joint.jumps[0],
            first_jump: joint.jumps[1],
            tangent_angle: joint.tangent_angle,
            curvature_jump: joint.curvature_jump,
        }
    }
}

/// How the pieces of a surface meet along a knot line: 32 bytes, frozen.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fpt_knot_line {
    /// The knot; the seam of a closed surface is reported at the end of the domain.
    pub value: f64,
    /// How often it is a knot.
    pub multiplicity: u32,
    /// The highest order to which all derivatives across the line agree all along it; 0 is a mere join.
    pub order: u32,
    /// No gap between the pieces is wider, anywhere on the line: the hull of the jump. Of rational surfaces this and the next are of the
    /// homogeneous form, with weights at most 1, around a pole.
    pub gap: f64,
    /// No jump of the first derivative across the line is longer.
    pub first_jump: f64,
}

impl From<Crease> for fpt_knot_line {
    fn from(crease: Crease) -> Self {
        Self {
            value: crease.value,
            multiplicity: crease.multiplicity as u32,
            order: crease.order as u32,
            gap: crease.jumps[0],
            first_jump: crease.jumps[1],
        }
    }
}

/// Hands a list of numbers over, when there is room.
///
/// # Safety
/// NULL or room for `capacity` numbers; NULL or room for one.
unsafe fn numbers(
    list: Vec<f64>,
    capacity: usize,
    out: *mut f64,
    out_count: *mut usize,
) -> Result<(), Failure> {
    // SAFETY: the caller vouches for both.
    let out_count = unsafe { place("out_count", out_count) }?;
    if capacity < list.len() {
        let text = format!("capacity: {capacity} given, {} needed", list.len());
        return Err(Failure::invalid(text));
    }
    // SAFETY: as above; there is room for as many.
    unsafe { output("out", out, list.len()) }?.copy_from_slice(&list);
    *out_count = list.len();
    Ok(())
}

/// The arc length behind a handle.
///
/// # Safety
/// NULL or a live handle.
unsafe fn length<'a>(length: *const fpt_arc_length) -> Result<&'a ArcLength, Failure> {
    // SAFETY: the caller vouches for it.
    Ok(&unsafe { shared("length", length) }?.length)
}

/// Answers for many numbers; nothing is written unless all have one.
///
/// # Safety
/// Arrays of `count` elements each.
unsafe fn each(
    name: &'static str,
    numbers: *const f64,
    count: usize,
    out: *mut fpt_estimate,
    of: impl Fn(f64) -> Result<crate::operate::Estimate, crate::error::Error>,
) -> Result<(), Failure> {
    // SAFETY: the caller vouches for both arrays.
    let (numbers, out) = unsafe { (array(name, numbers, count)?, output("out", out, count)?) };
    let mut found = Vec::new();
    found.try_reserve_exact(count).map_err(|_| crate::error::Error::OutOfMemory)?;
    for &number in numbers {
        let estimate = of(number)?;
        found.push(fpt_estimate { value: estimate.value, error: estimate.error });
    }
    out.copy_from_slice(&found);
    Ok(())
}

/// Measures the arc length of a curve.
///
/// @param tolerance  length, finite, >= 0: the proven error of the whole, or what rounding allows; 0: 1e-12 of the length
/// @param out        the handle; release it with fpt_arc_length_free
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_arc_length_new(
    curve: *const fpt_curve,
    tolerance: f64,
    out: *mut *mut fpt_arc_length,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for one.
    guard(|| unsafe {
        let curve = plain(curve)?;
        let out = place("out", out)?;
        let length = curve.arc_length(tolerance)?;
        *out = Box::into_raw(Box::new(fpt_arc_length { length }));
        Ok(())
    })
}

/// Releases an arc length. NULL is fine. No other call may use the handle during or after this one.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_arc_length_free(length: *mut fpt_arc_length) {
    let release = || {
        if !length.is_null() {
            // SAFETY: a handle comes from Box::into_raw in `_new` and is released once.
            drop(unsafe { Box::from_raw(length) });
        }
        Ok(())
    };
    let _ = guard(release);
}

/// The length of the whole curve.
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_arc_length_total(
    length: *const fpt_arc_length,
    out: *mut fpt_estimate,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for a record.
    guard(|| unsafe {
        let total = self::length(length)?.total();
        write("out", fpt_estimate { value: total.value, error: total.error }, out)
    })
}

/// The lengths from the start of the curve to parameters.
///
/// @param parameters  in the domain; the error names the first that is not
/// @param out         count records
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_arc_length_at(
    length: *const fpt_arc_length,
    parameters: *const f64,
    count: usize,
    out: *mut fpt_estimate,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and arrays of one length.
    guard(|| unsafe {
        let length = self::length(length)?;
        each("parameters", parameters, count, out, |u| length.at(u))
    })
}

/// The parameters of lengths from the start of the curve.
///
/// @param lengths  0 to the length of the curve; the error names the first that is not
/// @param out      count records: a parameter, and as its error a length, how far the length to there may be from the wanted one
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_arc_length_parameters(
    length: *const fpt_arc_length,
    lengths: *const f64,
    count: usize,
    out: *mut fpt_estimate,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and arrays of one length.
    guard(|| unsafe {
        let length = self::length(length)?;
        each("lengths", lengths, count, out, |s| length.parameter(s))
    })
}

/// Tangent, normals, curvature and torsion of a curve.
///
/// @param u     in the domain
/// @param side  -1: of the piece that ends there, where u is a knot; else of the one that begins there
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_curve_frame(
    curve: *const fpt_curve,
    u: f64,
    side: i32,
    out: *mut fpt_curve_frame_record,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for a record.
    guard(|| unsafe {
        let side = if side < 0 { Side::Below } else { Side::Above };
        let f = plain(curve)?.frame(u, side)?;
        let record = fpt_curve_frame_record {
            point: f.point,
            tangent: f.tangent,
            normal: f.normal,
            binormal: f.binormal,
            speed: f.speed,
            curvature: f.curvature,
            torsion: f.torsion,
        };
        write("out", record, out)
    })
}

/// How the pieces of a curve meet at its knots inside the domain and, if it is closed, at the seam.
///
/// @param tolerance  0 to 1: a jump of a derivative counts beyond this share of what the derivative can be; 1e-9 is a good choice
/// @param capacity   room in out; one record a knot value is enough
/// @param out_count  the number of records, also when there is not room for all
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_curve_continuity(
    curve: *const fpt_curve,
    tolerance: f64,
    capacity: usize,
    out: *mut fpt_joint,
    out_count: *mut usize,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for what comes out.
    guard(|| unsafe {
        let joints = plain(curve)?.continuity(tolerance)?;
        let out_count = place("out_count", out_count)?;
        let out = output("out", out, capacity)?;
        *out_count = joints.len();
        for (joint, out) in joints.into_iter().zip(out) {
            *out = joint.into();
        }
        Ok(())
    })
}

/// The powers of a local parameter t, 0 to 1 on each span of the domain: w x, w y, w z, w of t^k of span i at 4 * (i * (degree + 1) + k). The ends of
/// the spans are the knots of the domain, each once. Loses digits as the degree grows.
///
/// @param capacity   room in out, in numbers
/// @param out_count  how many there are: 4 * spans * (degree + 1); FPT_INVALID_ARGUMENT when there is not room for all
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_curve_power(
    curve: *const fpt_curve,
    capacity: usize,
    out: *mut f64,
    out_count: *mut usize,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for what comes out.
    guard(|| unsafe {
        let pieces = plain(curve)?.power_pieces()?;
        let all = pieces.iter().flat_map(|piece| piece.coefficients.as_flattened());
        numbers(all.copied().collect(), capacity, out, out_count)
    })
}

/// The Bezier curve of powers of a local parameter, 0 at start and 1 at end.
///
/// @param coefficients  4 * (degree + 1) numbers: w x, w y, w z, w of t^k; polynomial: w is 1 for k = 0, else 0
/// @param out           the curve; release it with fpt_curve_free
/// @return FPT_UNSUPPORTED when a Bezier weight is not positive
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_curve_from_power(
    degree: usize,
    start: f64,
    end: f64,
    coefficients: *const f64,
    out: *mut *mut fpt_curve,
) -> fpt_status {
    // SAFETY: the header asks for an array and room for a handle.
    guard(|| unsafe {
        check_degree("degree", degree, degree.saturating_add(1))?;
        let coefficients = array("coefficients", coefficients.cast::<[f64; 4]>(), degree + 1)?;
        let out = place("out", out)?;
        let power = PowerCurve { domain: [start, end], coefficients: copy_of(coefficients)? };
        hand_over(crate::curve::Curve::from_power(&power)?, out)
    })
}

/// How the pieces of a surface meet along its knot lines of a direction inside the domain and, if it is closed there, along the seam.
///
/// @param direction  FPT_DIRECTION_U: lines of constant u; or FPT_DIRECTION_V
/// @param tolerance  as in fpt_curve_continuity
/// @param capacity   room in out; one record a knot value is enough
/// @param out_count  the number of records, also when there is not room for all
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_continuity(
    surface: *const fpt_surface,
    direction: u32,
    tolerance: f64,
    capacity: usize,
    out: *mut fpt_knot_line,
    out_count: *mut usize,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for what comes out.
    guard(|| unsafe {
        let direction = read_direction(direction)?;
        let lines = surface::plain(surface)?.continuity(direction, tolerance)?;
        let out_count = place("out_count", out_count)?;
        let out = output("out", out, capacity)?;
        *out_count = lines.len();
        for (line, out) in lines.into_iter().zip(out) {
            *out = line.into();
        }
        Ok(())
    })
}

/// The powers of local parameters s and t, each 0 to 1 on every patch: w x, w y, w z, w of s^k t^l of patch (i,j) at
/// 4 * (((i * patches_v + j) * (degree_u + 1) + k) * (degree_v + 1) + l). As fpt_curve_power.
///
/// @param capacity   room in out, in numbers
/// @param out_count  how many there are: 4 * patches * (degree_u + 1) * (degree_v + 1); FPT_INVALID_ARGUMENT when there is not room for all
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_power(
    surface: *const fpt_surface,
    capacity: usize,
    out: *mut f64,
    out_count: *mut usize,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for what comes out.
    guard(|| unsafe {
        let (patches, _) = surface::plain(surface)?.power_pieces()?;
        let all = patches.iter().flat_map(|patch| patch.coefficients.as_flattened());
        numbers(all.copied().collect(), capacity, out, out_count)
    })
}

/// The Bezier patch of powers of local parameters, 0 at the beginnings of the domain and 1 at its ends.
///
/// @param degree_u      1 to 31
/// @param degree_v      1 to 31
/// @param domain        u0,u1,v0,v1
/// @param coefficients  4 * (degree_u + 1) * (degree_v + 1) numbers: w x, w y, w z, w of s^k t^l at 4 * (k * (degree_v + 1) + l); polynomial:
///                      w is 1 for k = l = 0, else 0
/// @param out           the surface; release it with fpt_surface_free
/// @return FPT_UNSUPPORTED when a Bezier weight is not positive
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_from_power(
    degree_u: usize,
    degree_v: usize,
    domain: *const f64,
    coefficients: *const f64,
    out: *mut *mut fpt_surface,
) -> fpt_status {
    // SAFETY: the header asks for arrays and room for a handle.
    guard(|| unsafe {
        check_degree("degree_u", degree_u, degree_u.saturating_add(1))?;
        check_degree("degree_v", degree_v, degree_v.saturating_add(1))?;
        let domain = operate_surface::four("domain", domain)?;
        let count = (degree_u + 1) * (degree_v + 1);
        let coefficients = copy_of(array("coefficients", coefficients.cast::<[f64; 4]>(), count)?)?;
        let out = place("out", out)?;
        let power = PowerSurface { domain, degree: [degree_u, degree_v], coefficients };
        operate_surface::hand_over(crate::surface::Surface::from_power(&power)?, out)
    })
}
