//! What goes with a foot, in arrays parallel to the feet: normal and side, tangent, one-sided derivatives, how well
//! the point fixes the parameters.

use super::curve::{self, fpt_curve};
use super::limits::{check_inside, check_inside_at, check_order};
use super::memory::{array, optional_array, optional_output, output};
use super::records::fpt_foot_point;
use super::surface::{self, fpt_surface};
use super::{Failure, fpt_status, guard};
use crate::closest::FootPoint;
use crate::knots::Side;
use crate::normal::{self, Normals, Tangents, flag};

/// The bits that go with normals and tangents.
#[repr(C)]
pub enum fpt_normal_flag {
    /// The side of the query cannot be told, or not from this foot alone: the query lies on the surface, beyond
    /// an open border, in the tangent plane, or at a fold; or the foot is a tie (FPT_FOOT_TIE) of a
    /// surface with borders, and another foot may tell another side. The sign is a guess.
    FPT_NORMAL_AMBIGUOUS_SIDE = 1,
    /// Several normals meet at a crease, a corner of patches or the tip of a cone: the one given is their mean,
    /// weighted by the angles between the tangents of each patch. Tangents: the tangent breaks.
    FPT_NORMAL_CREASE = 2,
    /// Taken as a limit from inside the domain, because the derivatives do not give it.
    FPT_NORMAL_LIMIT = 4,
    /// There is none, not even as a limit; its three numbers are NaN.
    FPT_NORMAL_UNDEFINED = 8,
}
use fpt_normal_flag::*;

const _: () = {
    assert!(FPT_NORMAL_AMBIGUOUS_SIDE as u32 == flag::AMBIGUOUS_SIDE);
    assert!(FPT_NORMAL_CREASE as u32 == flag::CREASE);
    assert!(FPT_NORMAL_LIMIT as u32 == flag::LIMIT);
    assert!(FPT_NORMAL_UNDEFINED as u32 == flag::UNDEFINED);
};

/// Feet that come in; `ends`: the domain, four numbers or two.
///
/// # Safety
/// As [`array`].
unsafe fn feet_in<'a>(
    feet: *const fpt_foot_point,
    count: usize,
    ends: &[f64],
) -> Result<&'a [FootPoint], Failure> {
    // SAFETY: the layouts agree (records.rs); the caller vouches for the rest.
    let feet = unsafe { array("feet", feet.cast::<FootPoint>(), count) }?;
    for (i, foot) in feet.iter().enumerate() {
        for ((name, x), end) in [("u", foot.u), ("v", foot.v)].into_iter().zip(ends.chunks(2)) {
            if !x.is_nan() {
                check_inside_at("feet", i, name, x, end[0], end[1])?;
            }
        }
    }
    Ok(feet)
}

/// The unit normal of the surface at each foot, in the direction of Su x Sv, and on which side of the surface the
/// query lies.
///
/// At a crease, a corner of patches or the tip of a cone the normal is the mean of the patches' normals weighted by
/// the angles of the patches there; with it, other than with the normal of one patch, the sign is right
/// wherever the surface does not cross itself near the foot. At collapsed edges and where derivatives vanish or are
/// parallel it is a limit (FPT_NORMAL_LIMIT). For a closed surface the sign tells inside from outside.
///
/// @param points      x,y,z of the query of each foot, packed; NULL: normals only, then `out_signed` must be NULL
/// @param feet        `count` records, as the query functions give them, of this surface. NaN parameters have no
///                    normal; parameters outside the domain are FPT_INVALID_ARGUMENT
/// @param count       may be 0
/// @param out_normals 3*count numbers; NaN where there is no normal (FPT_NORMAL_UNDEFINED)
/// @param out_signed  `count` numbers or NULL: |query - foot| where the query is on the normal's side, else
///                    -|query - foot|; without a normal positive, for a bad query NaN
/// @param out_flags   `count` numbers or NULL: sums of fpt_normal_flag values
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_normals(
    surface: *const fpt_surface,
    points: *const f64,
    feet: *const fpt_foot_point,
    count: usize,
    out_normals: *mut f64,
    out_signed: *mut f64,
    out_flags: *mut u32,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and arrays of these lengths that do not overlap.
    guard(|| unsafe {
        let surface = surface::indexed(surface)?.surface();
        let points = optional_array("points", points.cast::<[f64; 3]>(), count)?;
        let feet = feet_in(feet, count, &surface.domain())?;
        let out = output("out_normals", out_normals.cast::<[f64; 3]>(), count)?;
        let mut signed = optional_output("out_signed", out_signed, count)?;
        let mut flags = optional_output("out_flags", out_flags, count)?;
        if signed.is_some() && points.is_none() && count > 0 {
            return Err(Failure::Null("points"));
        }
        let normals = Normals::new(surface);
        for (i, foot) in feet.iter().enumerate() {
            let facing = normals.at(foot, points.map(|points| points[i]));
            out[i] = facing.normal;
            if let Some(signed) = &mut signed {
                signed[i] = facing.signed;
            }
            if let Some(flags) = &mut flags {
                flags[i] = facing.flags;
            }
        }
        Ok(())
    })
}

/// The unit tangent of the curve at each foot, in the direction of growing u. Where the derivative vanishes it is that of
/// the first derivative that does not (FPT_NORMAL_LIMIT); where the tangent breaks (corners, cusps, the seam
/// of a closed curve) it is that of the piece above, at the end of the domain of the one below (FPT_NORMAL_CREASE).
///
/// @param feet         `count` records of this curve. NaN parameters have no tangent; parameters outside the domain
///                     are FPT_INVALID_ARGUMENT
/// @param count        may be 0
/// @param out_tangents 3*count numbers; NaN where there is none (FPT_NORMAL_UNDEFINED)
/// @param out_flags    `count` numbers or NULL: sums of fpt_normal_flag values
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_curve_tangents(
    curve: *const fpt_curve,
    feet: *const fpt_foot_point,
    count: usize,
    out_tangents: *mut f64,
    out_flags: *mut u32,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and arrays of these lengths that do not overlap.
    guard(|| unsafe {
        let curve = curve::indexed(curve)?.curve();
        let feet = feet_in(feet, count, &<[f64; 2]>::from(curve.domain()))?;
        let out = output("out_tangents", out_tangents.cast::<[f64; 3]>(), count)?;
        let mut flags = optional_output("out_flags", out_flags, count)?;
        let tangents = Tangents::new(curve);
        for (i, foot) in feet.iter().enumerate() {
            let (tangent, bits) = tangents.at(foot.u);
            out[i] = tangent;
            if let Some(flags) = &mut flags {
                flags[i] = bits;
            }
        }
        Ok(())
    })
}

/// The curve and its derivatives on one side of a parameter: they differ at knots only.
///
/// @param u            in the domain, else FPT_INVALID_ARGUMENT
/// @param side         -1: the piece below; +1: the piece above; 0: as fpt_curve_evaluate, which is the piece above.
///                     At an end of the domain every side is the piece inside, on closed curves too
/// @param derivatives  highest order d, at most 31; 0: the point only
/// @param out          3*(d + 1) numbers: C, C', C'', ... with x,y,z each. Below a knot C may differ from that of
///                     fpt_curve_evaluate by rounding
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_curve_evaluate_sided(
    curve: *const fpt_curve,
    u: f64,
    side: i32,
    derivatives: u32,
    out: *mut f64,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for 3*(d+1) numbers.
    guard(|| unsafe {
        let curve = curve::indexed(curve)?.curve();
        let side = side_of("side", side)?;
        let order = check_order(derivatives)?;
        let out = output("out", out.cast::<[f64; 3]>(), order + 1)?;
        let (start, end) = curve.domain();
        check_inside("u", u, start, end)?;
        curve.derivatives_on(u, side, order, out);
        Ok(())
    })
}

/// The surface and its partial derivatives on one side in each direction: they differ at knot lines only.
///
/// @param u            in the domain, else FPT_INVALID_ARGUMENT
/// @param v            in the domain, else FPT_INVALID_ARGUMENT
/// @param side_u       -1: the piece below u; +1: the piece above; 0: as fpt_surface_evaluate, which is the piece
///                     above. At an end of the domain every side is the piece inside, in closed directions too
/// @param side_v       the same in v
/// @param derivatives  highest total order d, at most 31; 0: the point only
/// @param out          3*(d + 1)*(d + 2)/2 numbers, as for fpt_surface_evaluate. Below a knot the point may differ from
///                     that of fpt_surface_evaluate by rounding
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_evaluate_sided(
    surface: *const fpt_surface,
    u: f64,
    v: f64,
    side_u: i32,
    side_v: i32,
    derivatives: u32,
    out: *mut f64,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for 3*(d+1)*(d+2)/2 numbers.
    guard(|| unsafe {
        let surface = surface::indexed(surface)?.surface();
        let sides = [side_of("side_u", side_u)?, side_of("side_v", side_v)?];
        let order = check_order(derivatives)?;
        let out = output("out", out.cast::<[f64; 3]>(), (order + 1) * (order + 2) / 2)?;
        let [u0, u1, v0, v1] = surface.domain();
        check_inside("u", u, u0, u1)?;
        check_inside("v", v, v0, v1)?;
        surface.partials_on([u, v], sides, order, out);
        Ok(())
    })
}

fn side_of(name: &str, side: i32) -> Result<Side, Failure> {
    match side {
        -1 => Ok(Side::Below),
        0 | 1 => Ok(Side::Above),
        _ => Err(Failure::invalid(format!("{name}: {side} is not -1, 0 or 1"))),
    }
}

/// How well each foot fixes its parameter: how far u may move while the point moves by at most the accuracy.
///
/// @param feet      `count` records of this curve; NaN parameters give NaN
/// @param count     may be 0
/// @param accuracy  length, finite, >= 0; 0: 1e-10 x the diagonal of the curve's box
/// @param out       `count` numbers: the greater step of both directions, right within a factor of two; at most what
///                  the domain leaves, on a closed curve its length
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_curve_uncertainty(
    curve: *const fpt_curve,
    feet: *const fpt_foot_point,
    count: usize,
    accuracy: f64,
    out: *mut f64,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and arrays of these lengths that do not overlap.
    guard(|| unsafe {
        let curve = curve::indexed(curve)?.curve();
        let feet = feet_in(feet, count, &<[f64; 2]>::from(curve.domain()))?;
        let out = output("out", out, count)?;
        let accuracy = accuracy_or_default(accuracy, curve.bounding_box())?;
        let closed = curve.is_closed();
        for (foot, out) in feet.iter().zip(out) {
            *out = normal::of_curve(curve, closed, foot, accuracy);
        }
        Ok(())
    })
}

/// How well each foot fixes its parameters: how far u and v may move (together) while the point moves by at most the
/// accuracy. Near a regular point these are the half extents of an ellipse; at cusps they are larger, and at a collapsed
/// edge the parameter along it is free.
///
/// @param feet      `count` records of this surface; NaN parameters give NaN
/// @param count     may be 0
/// @param accuracy  length, finite, >= 0; 0: 1e-10 x the diagonal of the surface's box
/// @param out       2*count numbers: for u and for v the greater step of both directions, right within a factor of
///                  two; at most what the domain leaves, in a closed direction its length
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_uncertainty(
    surface: *const fpt_surface,
    feet: *const fpt_foot_point,
    count: usize,
    accuracy: f64,
    out: *mut f64,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and arrays of these lengths that do not overlap.
    guard(|| unsafe {
        let surface = surface::indexed(surface)?.surface();
        let feet = feet_in(feet, count, &surface.domain())?;
        let out = output("out", out.cast::<[f64; 2]>(), count)?;
        let accuracy = accuracy_or_default(accuracy, surface.bounding_box())?;
        let closed = [surface.is_closed_u(), surface.is_closed_v()];
        for (foot, out) in feet.iter().zip(out) {
            *out = normal::of_surface(surface, closed, foot, accuracy);
        }
        Ok(())
    })
}

fn accuracy_or_default(accuracy: f64, (low, high): ([f64; 3], [f64; 3])) -> Result<f64, Failure> {
    if !(accuracy.is_finite() && accuracy >= 0.0) {
        let text = format!("accuracy: {accuracy} is not a finite length of at least 0");
        return Err(Failure::invalid(text));
    }
    if accuracy > 0.0 {
        return Ok(accuracy);
    }
    let square: f64 = (0..3).map(|k| (high[k] - low[k]) * (high[k] - low[k])).sum();
    Ok(1e-10 * square.sqrt())
}
