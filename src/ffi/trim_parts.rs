//! Trimmed surfaces: their parts.

use super::curve::fpt_curve;
use super::form::CurveForm;
use super::memory::{array, check_extent, optional_output, output, place, write};
use super::support::fpt_support;
use super::trim::{face, fpt_coedge_data, fpt_coedge_flag, fpt_pcurve_kind, fpt_trim};
use super::{Failure, fpt_status, guard};
use crate::index::IndexedCurve;
use crate::pcurve::Pcurve;
use crate::trim::{Coedge, EdgeCurve, Loop, LoopKind, TrimmedSurface};
use std::mem::size_of;
use std::sync::Arc;

/// The surface of a face.
///
/// @param out  a handle of its own; release it with fpt_support_free
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_trim_support(
    trim: *const fpt_trim,
    out: *mut *mut fpt_support,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for a handle.
    guard(|| unsafe {
        let out = place("out", out)?;
        *out = fpt_support::handle(face("trim", trim)?.support().clone());
        Ok(())
    })
}

/// What a face consists of.
///
/// @param out_edge_count  number of its edges
/// @param out_loop_count  number of its loops
/// @param out_flipped     1: its normal is opposite to Su x Sv; 0: it is that
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_trim_counts(
    trim: *const fpt_trim,
    out_edge_count: *mut usize,
    out_loop_count: *mut usize,
    out_flipped: *mut u32,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for the numbers.
    guard(|| unsafe {
        let face = face("trim", trim)?;
        let edges = place("out_edge_count", out_edge_count)?;
        let loops = place("out_loop_count", out_loop_count)?;
        write("out_flipped", u32::from(face.is_flipped()), out_flipped)?;
        (*edges, *loops) = (face.edges().len(), face.loops().len());
        Ok(())
    })
}

/// A loop of a face.
///
/// @param index             less than the number of loops
/// @param out_is_inner      0: outer, 1: inner
/// @param out_coedge_count  number of its coedges
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_trim_loop(
    trim: *const fpt_trim,
    index: usize,
    out_is_inner: *mut u32,
    out_coedge_count: *mut usize,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for the numbers.
    guard(|| unsafe {
        let chain = chain(face("trim", trim)?, index)?;
        let count = place("out_coedge_count", out_coedge_count)?;
        write("out_is_inner", u32::from(chain.kind == LoopKind::Inner), out_is_inner)?;
        *count = chain.coedges.len();
        Ok(())
    })
}

fn chain(face: &TrimmedSurface, index: usize) -> Result<&Loop, Failure> {
    let count = face.loops().len();
    face.loops()
        .get(index)
        .ok_or_else(|| Failure::invalid(format!("index: {index} is not less than {count}")))
}

fn coedge(face: &TrimmedSurface, chain_index: usize, index: usize) -> Result<&Coedge, Failure> {
    let count = face.loops().len();
    let chain = face.loops().get(chain_index).ok_or_else(|| {
        Failure::invalid(format!("loop_index: {chain_index} is not less than {count}"))
    })?;
    let count = chain.coedges.len();
    chain
        .coedges
        .get(index)
        .ok_or_else(|| Failure::invalid(format!("index: {index} is not less than {count}")))
}

/// A curve of a loop, as it was given but for its arrays: points, parameters and curve are NULL. Those of a polyline are got with
/// fpt_trim_coedge_points, a spline with fpt_trim_coedge_curve.
///
/// @param loop_index  less than the number of loops
/// @param index       less than the loop's number of coedges
/// @param out         the data
/// @param out_domain  first and last parameter of the curve; NULL: not wanted
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_trim_coedge(
    trim: *const fpt_trim,
    loop_index: usize,
    index: usize,
    out: *mut fpt_coedge_data,
    out_domain: *mut f64,
) -> fpt_status {
    // SAFETY: the header asks for a live handle, room for a struct and for two numbers or NULL.
    guard(|| unsafe {
        let coedge = coedge(face("trim", trim)?, loop_index, index)?;
        let domain = optional_output("out_domain", out_domain, 2)?;
        write("out", described(coedge), out)?;
        let (a, b) = coedge.pcurve.domain();
        domain.into_iter().for_each(|domain| domain.copy_from_slice(&[a, b]));
        Ok(())
    })
}

fn described(coedge: &Coedge) -> fpt_coedge_data {
    use fpt_coedge_flag::*;
    use fpt_pcurve_kind::*;
    let mut values = [0.0; 8];
    let (kind, point_count) = match &coedge.pcurve {
        Pcurve::Isoline(line) => {
            let fixed = line.fixed.index() as f64;
            values[..4].copy_from_slice(&[fixed, line.at, line.from, line.to]);
            (FPT_PCURVE_ISOLINE, 0)
        }
        Pcurve::Polyline(line) => (FPT_PCURVE_POLYLINE, line.points().len()),
        Pcurve::Spline(_) => (FPT_PCURVE_SPLINE, 0),
        Pcurve::Arc(arc) => {
            let ([a, b], [c, d], [e, f]) = (arc.center, arc.first, arc.second);
            values = [a, b, c, d, e, f, arc.angles[0], arc.angles[1]];
            (FPT_PCURVE_ARC, 0)
        }
    };
    let flag = |set: bool, flag: fpt_coedge_flag| if set { flag as u32 } else { 0 };
    fpt_coedge_data {
        kind: kind as u32,
        flags: flag(coedge.reversed, FPT_COEDGE_REVERSED)
            | flag(coedge.same_parameter, FPT_COEDGE_SAME_PARAMETER),
        edge: coedge.edge.unwrap_or(usize::MAX),
        values,
        points: std::ptr::null(),
        parameters: std::ptr::null(),
        point_count,
        curve: std::ptr::null(),
    }
}

/// The points of a polyline.
///
/// @param capacity        points that there is room for, at least point_count of fpt_trim_coedge
/// @param out_points      u,v of each point
/// @param out_parameters  parameter of each point; NULL: not wanted
/// @return FPT_INVALID_ARGUMENT also for a curve that is none
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_trim_coedge_points(
    trim: *const fpt_trim,
    loop_index: usize,
    index: usize,
    capacity: usize,
    out_points: *mut f64,
    out_parameters: *mut f64,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for the points.
    guard(|| unsafe {
        let coedge = coedge(face("trim", trim)?, loop_index, index)?;
        let Pcurve::Polyline(line) = &coedge.pcurve else {
            return Err(Failure::invalid("index: the curve is no polyline".into()));
        };
        let needed = line.points().len();
        if capacity < needed {
            let text = format!("capacity: {capacity} is less than the {needed} points");
            return Err(Failure::invalid(text));
        }
        let points = output("out_points", out_points.cast::<[f64; 2]>(), needed)?;
        let parameters = optional_output("out_parameters", out_parameters, needed)?;
        points.copy_from_slice(line.points());
        parameters.into_iter().for_each(|p| p.copy_from_slice(line.parameters()));
        Ok(())
    })
}

/// The spline of a coedge, with z = 0.
///
/// @param out  the handle; release it with fpt_curve_free
/// @return FPT_INVALID_ARGUMENT also for a curve that is none
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_trim_coedge_curve(
    trim: *const fpt_trim,
    loop_index: usize,
    index: usize,
    out: *mut *mut fpt_curve,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for a handle.
    guard(|| unsafe {
        let out = place("out", out)?;
        let coedge = coedge(face("trim", trim)?, loop_index, index)?;
        let Pcurve::Spline(curve) = &coedge.pcurve else {
            return Err(Failure::invalid("index: the curve is no spline".into()));
        };
        let curve = Arc::new(IndexedCurve::new(curve.clone()));
        *out = fpt_curve::handle(CurveForm::Spline(curve));
        Ok(())
    })
}

/// Places of a coedge in the domain, and their points on the surface.
///
/// @param shares      count numbers from 0 to 1: shares of the curve's domain, along the loop
/// @param out_uv      2 * count numbers; NULL: not wanted
/// @param out_points  3 * count numbers: the images; NULL: not wanted
/// @param out_edge    3 * count numbers: the points of the edge at these shares, NaN without an edge; NULL: not wanted
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_trim_coedge_evaluate(
    trim: *const fpt_trim,
    loop_index: usize,
    index: usize,
    shares: *const f64,
    count: usize,
    out_uv: *mut f64,
    out_points: *mut f64,
    out_edge: *mut f64,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and arrays.
    guard(|| unsafe {
        let face = face("trim", trim)?;
        let coedge = coedge(face, loop_index, index)?;
        let shares = array("shares", shares, count)?;
        if let Some(k) = shares.iter().position(|x| !(0.0..=1.0).contains(x)) {
            let text = format!("shares: entry {k} = {} is not 0 to 1", shares[k]);
            return Err(Failure::invalid(text));
        }
        check_extent("shares", count, size_of::<[f64; 3]>())?;
        let uv = optional_output("out_uv", out_uv.cast::<[f64; 2]>(), count)?;
        let points = optional_output("out_points", out_points.cast::<[f64; 3]>(), count)?;
        let edge = optional_output("out_edge", out_edge.cast::<[f64; 3]>(), count)?;
        let place = |share: f64| coedge.pcurve.evaluate(coedge.pcurve.parameter_at(share));
        if let Some(uv) = uv {
            shares.iter().zip(uv).for_each(|(&s, out)| *out = place(s));
        }
        if let Some(points) = points {
            shares.iter().zip(points).for_each(|(&s, out)| *out = face.coedge_point(coedge, s));
        }
        if let Some(edge) = edge {
            let point = |s: f64| face.edge_point(coedge, s).unwrap_or([f64::NAN; 3]);
            shares.iter().zip(edge).for_each(|(&s, out)| *out = point(s));
        }
        Ok(())
    })
}

/// An edge of a face.
///
/// @param index         less than the number of edges
/// @param out_curve     a handle of its own, or NULL for a point; release it with fpt_curve_free
/// @param out_point     3 numbers: the point of a collapsed side; else where the edge begins
/// @param out_reversed  1: the edge runs against its curve; 0: along it
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_trim_edge(
    trim: *const fpt_trim,
    index: usize,
    out_curve: *mut *mut fpt_curve,
    out_point: *mut f64,
    out_reversed: *mut u32,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for the answers.
    guard(|| unsafe {
        let face = face("trim", trim)?;
        let count = face.edges().len();
        let edge = face
            .edges()
            .get(index)
            .ok_or_else(|| Failure::invalid(format!("index: {index} is not less than {count}")))?;
        let curve = place("out_curve", out_curve)?;
        let point = output("out_point", out_point, 3)?;
        write("out_reversed", u32::from(edge.reversed), out_reversed)?;
        point.copy_from_slice(&edge.evaluate(0.0));
        *curve = match &edge.curve {
            EdgeCurve::Spline(spline) => fpt_curve::handle(CurveForm::Spline(spline.clone())),
            EdgeCurve::Callback(function) => {
                fpt_curve::handle(CurveForm::Function(function.clone()))
            }
            EdgeCurve::Point(_) => std::ptr::null_mut(),
        };
        Ok(())
    })
}
