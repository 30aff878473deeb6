//! Trimmed surfaces: made from data, taken apart again.

use super::curve::{self, fpt_curve};
use super::form::CurveForm;
use super::memory::{array, place, shared};
use super::options::{SelfSized, sized};
use super::support::{fpt_support, support};
use super::transform::truth;
use super::{Failure, fpt_status, guard};
use crate::error::Error;
use crate::operate::Direction;
use crate::pcurve::Pcurve;
use crate::trim::{Coedge, Edge, EdgeCurve, Loop, LoopKind, TrimmedSurface};
use std::mem::size_of;

/// The kinds of curves in the domain, for fpt_coedge_data.kind.
#[repr(C)]
#[derive(Clone, Copy)]
pub enum fpt_pcurve_kind {
    /// values: 0 when u is fixed, 1 when v is; its value; where the other parameter begins and ends.
    FPT_PCURVE_ISOLINE = 0,
    /// points joined by lines, at parameters.
    FPT_PCURVE_POLYLINE = 1,
    /// A spline curve with z = 0.
    FPT_PCURVE_SPLINE = 2,
    /// values: centre; half diameter of t = 0; half diameter of a quarter turn, conjugate to it; first and last t, at most a
    /// full turn: centre + cos t first + sin t second.
    FPT_PCURVE_ARC = 3,
}

/// Bits of fpt_coedge_data.flags.
#[repr(C)]
#[derive(Clone, Copy)]
pub enum fpt_coedge_flag {
    /// The coedge runs against its edge.
    FPT_COEDGE_REVERSED = 1,
    /// The place at a share s of the pcurve's domain lies on the edge at the share s of its domain (1 - s when reversed).
    FPT_COEDGE_SAME_PARAMETER = 2,
}

/// A curve of a loop. 112 bytes, frozen.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct fpt_coedge_data {
    /// A value of fpt_pcurve_kind.
    pub kind: u32,
    /// Sum of fpt_coedge_flag values.
    pub flags: u32,
    /// Number of its edge; SIZE_MAX: none, the edge is only known as the image of the pcurve.
    pub edge: usize,
    /// Numbers of an isoline (4) or an arc (8).
    pub values: [f64; 8],
    /// u,v of the points of a polyline.
    pub points: *const f64,
    /// Increasing parameters of the points; NULL: 0, 1, 2, ...
    pub parameters: *const f64,
    /// Points of a polyline, at least 2.
    pub point_count: usize,
    /// The spline.
    pub curve: *const fpt_curve,
}

/// A closed chain of curves, each beginning where the one before ends. 24 bytes, frozen.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct fpt_loop_data {
    /// 0: outer, counter-clockwise; 1: inner, clockwise.
    pub is_inner: u32,
    /// Must be 0.
    pub reserved: u32,
    /// The curves in their order.
    pub coedges: *const fpt_coedge_data,
    /// At least 1.
    pub coedge_count: usize,
}

/// A curve in space, or the point of a collapsed side. 40 bytes, frozen.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct fpt_edge_data {
    /// All of the curve; NULL: a point.
    pub curve: *const fpt_curve,
    /// The point; looked at without a curve.
    pub point: [f64; 3],
    /// 1: the edge runs against its curve; 0: along it.
    pub reversed: u32,
    /// Must be 0.
    pub reserved: u32,
}

/// The input of fpt_trim_new. Copied: nothing is borrowed after the call.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct fpt_trim_data {
    /// sizeof(fpt_trim_data).
    pub struct_size: usize,
    /// The surface.
    pub support: *const fpt_support,
    /// The edges; coedges refer to them by number. Each is used once, or twice: a seam.
    pub edges: *const fpt_edge_data,
    /// May be 0.
    pub edge_count: usize,
    /// The loops.
    pub loops: *const fpt_loop_data,
    /// At least 1.
    pub loop_count: usize,
    /// 1: the normal of the face is opposite to Su x Sv; 0: it is that.
    pub flipped: u32,
    /// Must be 0.
    pub reserved: u32,
}

// SAFETY: repr(C), begins with struct_size; numbers and raw pointers.
unsafe impl SelfSized for fpt_trim_data {
    const SHORTER: &'static [usize] = &[];

    fn defaults() -> Self {
        Self {
            struct_size: size_of::<Self>(),
            support: std::ptr::null(),
            edges: std::ptr::null(),
            edge_count: 0,
            loops: std::ptr::null(),
            loop_count: 0,
            flipped: 0,
            reserved: 0,
        }
    }
}

/// A trimmed surface: a surface, loops of curves in its domain, and their edges in space; the structure of IGES entities 142 and 144
/// and of faces in STEP. Immutable: any number of threads may use one at a time. Owned by the caller, released by fpt_trim_free.
pub struct fpt_trim {
    face: TrimmedSurface,
}

impl fpt_trim {
    /// A handle for the caller.
    pub(super) fn handle(face: TrimmedSurface) -> *mut Self {
        Box::into_raw(Box::new(Self { face }))
    }
}

/// The face behind a handle.
///
/// # Safety
/// NULL or a live handle.
pub(super) unsafe fn face<'a>(
    name: &'static str,
    trim: *const fpt_trim,
) -> Result<&'a TrimmedSurface, Failure> {
    // SAFETY: the caller vouches for it.
    Ok(&unsafe { shared(name, trim) }?.face)
}

/// Names the place of a failure.
fn at(failure: Failure, place: &str) -> Failure {
    match failure {
        Failure::Null(name) => Failure::invalid(format!("{place}: {name}: must not be NULL")),
        Failure::Refused(Error::InvalidArgument(text)) => {
            Failure::invalid(format!("{place}: {text}"))
        }
        other => other,
    }
}

/// The curve behind a handle, shared with it.
///
/// # Safety
/// NULL or a live handle.
unsafe fn shared_curve(curve: *const fpt_curve) -> Result<EdgeCurve, Failure> {
    // SAFETY: the caller vouches for it.
    Ok(match unsafe { curve::form(curve) }? {
        CurveForm::Spline(spline) => EdgeCurve::Spline(spline.clone()),
        CurveForm::Function(function) => EdgeCurve::Callback(function.clone()),
    })
}

/// # Safety
/// Handles and arrays as the header asks for.
unsafe fn read_edge(data: &fpt_edge_data) -> Result<Edge, Failure> {
    if data.reserved != 0 {
        return Err(Failure::invalid(format!("reserved: {} must be 0", data.reserved)));
    }
    let curve = if data.curve.is_null() {
        EdgeCurve::Point(data.point)
    } else {
        // SAFETY: the caller vouches for it.
        unsafe { shared_curve(data.curve) }?
    };
    Ok(Edge { curve, reversed: truth("reversed", data.reversed)? })
}

/// # Safety
/// Handles and arrays as the header asks for.
unsafe fn read_coedge(data: &fpt_coedge_data) -> Result<Coedge, Failure> {
    use fpt_coedge_flag::*;
    use fpt_pcurve_kind::*;
    let known = FPT_COEDGE_REVERSED as u32 | FPT_COEDGE_SAME_PARAMETER as u32;
    if data.flags & !known != 0 {
        return Err(Failure::invalid(format!("flags: {} has unknown bits", data.flags)));
    }
    let [a, b, c, d, e, f, g, h] = data.values;
    let pcurve = match data.kind {
        kind if kind == FPT_PCURVE_ISOLINE as u32 => {
            let fixed = match a {
                0.0 => Direction::U,
                1.0 => Direction::V,
                _ => return Err(Failure::invalid(format!("values: entry 0 is {a}, not 0 or 1"))),
            };
            Pcurve::isoline(fixed, b, c, d)?
        }
        // SAFETY: the caller vouches for the arrays and the handle.
        kind if kind == FPT_PCURVE_POLYLINE as u32 => unsafe {
            let points = array("points", data.points.cast::<[f64; 2]>(), data.point_count)?;
            if data.parameters.is_null() {
                Pcurve::polyline(points)?
            } else {
                let parameters = array("parameters", data.parameters, data.point_count)?;
                Pcurve::polyline_at(parameters, points)?
            }
        },
        // SAFETY: as above.
        kind if kind == FPT_PCURVE_SPLINE as u32 => {
            Pcurve::spline(unsafe { curve::indexed(data.curve) }?.curve().clone())?
        }
        kind if kind == FPT_PCURVE_ARC as u32 => Pcurve::arc([a, b], [c, d], [e, f], [g, h])?,
        kind => {
            return Err(Failure::invalid(format!("kind: {kind} is not an FPT_PCURVE_ value")));
        }
    };
    Ok(Coedge {
        pcurve,
        edge: (data.edge != usize::MAX).then_some(data.edge),
        reversed: data.flags & FPT_COEDGE_REVERSED as u32 != 0,
        same_parameter: data.flags & FPT_COEDGE_SAME_PARAMETER as u32 != 0,
    })
}

/// Makes a face from its inputs. References are checked here; whether the loops are closed, directed and disjoint is what fpt_trim_report
/// tells.
///
/// @param data  the inputs, copied
/// @param out   the handle; release it with fpt_trim_free
/// @return FPT_INVALID_ARGUMENT names loop, coedge and edge
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_trim_new(
    data: *const fpt_trim_data,
    out: *mut *mut fpt_trim,
) -> fpt_status {
    // SAFETY: the header asks for a struct with live handles and arrays, and room for a handle.
    guard(|| unsafe {
        let out = place("out", out)?;
        let data = sized("data", data)?;
        if data.reserved != 0 {
            return Err(Failure::invalid(format!("reserved: {} must be 0", data.reserved)));
        }
        let support = support("support", data.support)?.clone();
        let mut edges = Vec::new();
        for (k, edge) in array("edges", data.edges, data.edge_count)?.iter().enumerate() {
            edges.push(read_edge(edge).map_err(|f| at(f, &format!("edges: edge {k}")))?);
        }
        let mut loops = Vec::new();
        for (k, chain) in array("loops", data.loops, data.loop_count)?.iter().enumerate() {
            let name = format!("loops: loop {k}");
            if chain.reserved != 0 {
                let text = format!("{name}: reserved: {} must be 0", chain.reserved);
                return Err(Failure::invalid(text));
            }
            let inner = truth("is_inner", chain.is_inner).map_err(|f| at(f, &name))?;
            let list = array("coedges", chain.coedges, chain.coedge_count);
            let mut coedges = Vec::new();
            for (i, coedge) in list.map_err(|f| at(f, &name))?.iter().enumerate() {
                let place = format!("{name}: coedge {i}");
                coedges.push(read_coedge(coedge).map_err(|f| at(f, &place))?);
            }
            let kind = if inner { LoopKind::Inner } else { LoopKind::Outer };
            loops.push(Loop { kind, coedges });
        }
        let flipped = truth("flipped", data.flipped)?;
        *out = fpt_trim::handle(TrimmedSurface::new(support, edges, loops, flipped)?);
        Ok(())
    })
}

/// The whole surface as a face: one outer loop around its domain, with seam edges used twice and points at collapsed sides. The sides
/// of a function have no edges.
///
/// @param out  the handle; release it with fpt_trim_free
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_trim_whole(
    support: *const fpt_support,
    out: *mut *mut fpt_trim,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for a handle.
    guard(|| unsafe {
        let out = place("out", out)?;
        let support = self::support("support", support)?.clone();
        *out = fpt_trim::handle(TrimmedSurface::whole(support)?);
        Ok(())
    })
}

/// Releases a face. NULL is fine.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_trim_free(trim: *mut fpt_trim) {
    if !trim.is_null() {
        // SAFETY: a handle comes from Box::into_raw and is released once.
        let _ = guard(|| unsafe {
            drop(Box::from_raw(trim));
            Ok(())
        });
    }
}
