//! What is behind a handle: a spline with its index, or a function.
//!
//! Functions of the C API that both kinds can answer go through [`CurveForm`] and [`SurfaceForm`]; those about knots,
//! poles and weights ask for the spline and refuse a function with a clear text.

use super::Failure;
use crate::callback::{CallbackCurve, CallbackSurface};
use crate::closest::{FootPoint, QueryOptions, Trace, Workspace};
use crate::error::Error;
use crate::extrema::ExtremaOptions;
use crate::index::{IndexedCurve, IndexedSurface, Poll};
use crate::set::FootSet;
use std::sync::Arc;

/// A curve of either kind.
#[derive(Debug)]
pub(super) enum CurveForm {
    Spline(Arc<IndexedCurve>),
    Function(Arc<CallbackCurve>),
}

/// A surface of either kind.
#[derive(Debug)]
pub(super) enum SurfaceForm {
    Spline(Arc<IndexedSurface>),
    Function(Arc<CallbackSurface>),
}

fn no_spline(name: &str) -> Failure {
    let text = format!("{name}: is given by a function; this call needs knots and poles");
    Error::Unsupported(text).into()
}

/// Highest order of derivatives that a shape given by a function has.
fn check_callback_order(order: usize) -> Result<(), Failure> {
    if order <= 2 {
        return Ok(());
    }
    let text = format!("derivatives: {order} is more than the 2 of a shape given by a function");
    Err(Error::Unsupported(text).into())
}

fn failed_at(name: &str, at: &[f64]) -> Failure {
    Failure::invalid(format!("{name}: its function failed at {at:?}, or its values are not finite"))
}

impl CurveForm {
    pub(super) fn spline(&self) -> Result<&IndexedCurve, Failure> {
        match self {
            Self::Spline(curve) => Ok(curve),
            Self::Function(_) => Err(no_spline("curve")),
        }
    }

    pub(super) fn domain(&self) -> (f64, f64) {
        match self {
            Self::Spline(curve) => curve.curve().domain(),
            Self::Function(curve) => curve.domain(),
        }
    }

    /// Whether derivatives up to this order can be had.
    pub(super) fn check_order(&self, order: usize) -> Result<(), Failure> {
        if let Self::Function(_) = self { check_callback_order(order) } else { Ok(()) }
    }

    /// The derivatives up to an order that was checked, at a parameter that was checked.
    pub(super) fn derivatives(
        &self,
        u: f64,
        order: usize,
        out: &mut [[f64; 3]],
    ) -> Result<(), Failure> {
        match self {
            Self::Spline(curve) => curve.curve().derivatives(u, order, out),
            Self::Function(curve) if curve.derivatives(u, order, out) => {}
            Self::Function(_) => return Err(failed_at("curve", &[u])),
        }
        Ok(())
    }

    pub(super) fn bounding_box(&self) -> [[f64; 3]; 2] {
        match self {
            Self::Spline(curve) => curve.curve().bounding_box().into(),
            Self::Function(curve) => [curve.bounding_box().low, curve.bounding_box().high],
        }
    }

    pub(super) fn is_rational(&self) -> bool {
        matches!(self, Self::Spline(curve) if curve.curve().is_rational())
    }

    pub(super) fn is_closed(&self) -> bool {
        match self {
            Self::Spline(curve) => curve.curve().is_closed(),
            Self::Function(curve) => curve.is_closed(),
        }
    }

    pub(super) fn check_domain(&self, domain: [f64; 4]) -> Result<(), Error> {
        match self {
            Self::Spline(curve) => curve.check_domain(domain),
            Self::Function(curve) => curve.check_domain(domain),
        }
    }

    /// Bytes held: the curve, and the index once it is built.
    pub(super) fn memory(&self) -> usize {
        match self {
            Self::Spline(curve) => curve.memory(),
            Self::Function(curve) => curve.memory(),
        }
    }

    pub(super) fn prepare(&self, poll: Poll) -> Result<(), Error> {
        if let Self::Spline(curve) = self { curve.prepare(poll) } else { Ok(()) }
    }

    pub(super) fn closest(
        &self,
        query: [f64; 3],
        hint: Option<[f64; 1]>,
        options: &QueryOptions,
        workspace: &mut Workspace,
        trace: Option<Trace<'_>>,
    ) -> FootPoint {
        let hint = hint.map(|[u]| u);
        match self {
            Self::Spline(curve) => curve.closest(query, hint, options, workspace, trace),
            Self::Function(curve) => curve.closest(query, hint, options, trace),
        }
    }

    pub(super) fn invert(
        &self,
        query: [f64; 3],
        hint: Option<[f64; 1]>,
        options: &QueryOptions,
        workspace: &mut Workspace,
        trace: Option<Trace<'_>>,
    ) -> FootPoint {
        let hint = hint.map(|[u]| u);
        match self {
            Self::Spline(curve) => curve.invert(query, hint, options, workspace, trace),
            Self::Function(curve) => curve.invert(query, hint, options, trace),
        }
    }

    pub(super) fn closest_together(
        &self,
        asked: &dyn Fn(usize) -> ([f64; 3], Option<[f64; 1]>),
        options: &QueryOptions,
        workspace: &mut Workspace,
        out: &mut [FootPoint],
    ) {
        match self {
            Self::Spline(curve) => curve.closest_together(asked, options, workspace, out),
            Self::Function(_) => {
                for (k, foot) in out.iter_mut().enumerate() {
                    let (query, hint) = asked(k);
                    *foot = self.closest(query, hint, options, workspace, None);
                }
            }
        }
    }

    pub(super) fn invert_together(
        &self,
        asked: &dyn Fn(usize) -> ([f64; 3], Option<[f64; 1]>),
        options: &QueryOptions,
        workspace: &mut Workspace,
        out: &mut [FootPoint],
    ) {
        match self {
            Self::Spline(curve) => curve.invert_together(asked, options, workspace, out),
            Self::Function(_) => {
                for (k, foot) in out.iter_mut().enumerate() {
                    let (query, hint) = asked(k);
                    *foot = self.invert(query, hint, options, workspace, None);
                }
            }
        }
    }

    pub(super) fn preimage(
        &self,
        query: [f64; 3],
        tolerance: f64,
        options: &QueryOptions,
        poll: Poll,
    ) -> Result<FootSet, Error> {
        match self {
            Self::Spline(curve) => curve.preimage(query, tolerance, options, poll),
            Self::Function(curve) => curve.preimage(query, tolerance, options, poll),
        }
    }

    pub(super) fn extrema(
        &self,
        query: [f64; 3],
        options: &ExtremaOptions,
        poll: Poll,
    ) -> Result<FootSet, Error> {
        match self {
            Self::Spline(curve) => curve.extrema(query, options, poll),
            Self::Function(curve) => curve.extrema(query, options, poll),
        }
    }
}

impl SurfaceForm {
    /// The spline, to be kept.
    pub(super) fn shared_spline(&self) -> Result<Arc<IndexedSurface>, Failure> {
        match self {
            Self::Spline(surface) => Ok(Arc::clone(surface)),
            Self::Function(_) => Err(no_spline("surface")),
        }
    }

    pub(super) fn spline(&self) -> Result<&IndexedSurface, Failure> {
        match self {
            Self::Spline(surface) => Ok(surface),
            Self::Function(_) => Err(no_spline("surface")),
        }
    }

    pub(super) fn domain(&self) -> [f64; 4] {
        match self {
            Self::Spline(surface) => surface.surface().domain(),
            Self::Function(surface) => surface.domain(),
        }
    }

    /// Whether derivatives up to this order can be had.
    pub(super) fn check_order(&self, order: usize) -> Result<(), Failure> {
        if let Self::Function(_) = self { check_callback_order(order) } else { Ok(()) }
    }

    /// The partial derivatives up to an order that was checked, at parameters that were checked.
    pub(super) fn partials(
        &self,
        [u, v]: [f64; 2],
        order: usize,
        out: &mut [[f64; 3]],
    ) -> Result<(), Failure> {
        match self {
            Self::Spline(surface) => surface.surface().partials(u, v, order, out),
            Self::Function(surface) if surface.partials(u, v, order, out) => {}
            Self::Function(_) => return Err(failed_at("surface", &[u, v])),
        }
        Ok(())
    }

    pub(super) fn bounding_box(&self) -> [[f64; 3]; 2] {
        match self {
            Self::Spline(surface) => surface.surface().bounding_box().into(),
            Self::Function(surface) => [surface.bounding_box().low, surface.bounding_box().high],
        }
    }

    pub(super) fn is_rational(&self) -> bool {
        matches!(self, Self::Spline(surface) if surface.surface().is_rational())
    }

    /// In u and in v.
    pub(super) fn is_closed(&self) -> [bool; 2] {
        match self {
            Self::Spline(surface) => {
                [surface.surface().is_closed_u(), surface.surface().is_closed_v()]
            }
            Self::Function(surface) => [surface.is_closed_u(), surface.is_closed_v()],
        }
    }

    pub(super) fn collapsed_edges(&self) -> [bool; 4] {
        match self {
            Self::Spline(surface) => surface.surface().collapsed_edges(),
            Self::Function(surface) => surface.collapsed_edges(),
        }
    }

    pub(super) fn check_domain(&self, domain: [f64; 4]) -> Result<(), Error> {
        match self {
            Self::Spline(surface) => surface.check_domain(domain),
            Self::Function(surface) => surface.check_domain(domain),
        }
    }

    /// Bytes held: the surface, and the index once it is built.
    pub(super) fn memory(&self) -> usize {
        match self {
            Self::Spline(surface) => surface.memory(),
            Self::Function(surface) => surface.memory(),
        }
    }

    pub(super) fn prepare(&self, poll: Poll) -> Result<(), Error> {
        if let Self::Spline(surface) = self { surface.prepare(poll) } else { Ok(()) }
    }

    pub(super) fn closest(
        &self,
        query: [f64; 3],
        hint: Option<[f64; 2]>,
        options: &QueryOptions,
        workspace: &mut Workspace,
        trace: Option<Trace<'_>>,
    ) -> FootPoint {
        match self {
            Self::Spline(surface) => surface.closest(query, hint, options, workspace, trace),
            Self::Function(surface) => surface.closest(query, hint, options, trace),
        }
    }

    pub(super) fn invert(
        &self,
        query: [f64; 3],
        hint: Option<[f64; 2]>,
        options: &QueryOptions,
        workspace: &mut Workspace,
        trace: Option<Trace<'_>>,
    ) -> FootPoint {
        match self {
            Self::Spline(surface) => surface.invert(query, hint, options, workspace, trace),
            Self::Function(surface) => surface.invert(query, hint, options, trace),
        }
    }

    pub(super) fn closest_together(
        &self,
        asked: &dyn Fn(usize) -> ([f64; 3], Option<[f64; 2]>),
        options: &QueryOptions,
        workspace: &mut Workspace,
        out: &mut [FootPoint],
    ) {
        match self {
            Self::Spline(surface) => surface.closest_together(asked, options, workspace, out),
            Self::Function(_) => {
                for (k, foot) in out.iter_mut().enumerate() {
                    let (query, hint) = asked(k);
                    *foot = self.closest(query, hint, options, workspace, None);
                }
            }
        }
    }

    pub(super) fn invert_together(
        &self,
        asked: &dyn Fn(usize) -> ([f64; 3], Option<[f64; 2]>),
        options: &QueryOptions,
        workspace: &mut Workspace,
        out: &mut [FootPoint],
    ) {
        match self {
            Self::Spline(surface) => surface.invert_together(asked, options, workspace, out),
            Self::Function(_) => {
                for (k, foot) in out.iter_mut().enumerate() {
                    let (query, hint) = asked(k);
                    *foot = self.invert(query, hint, options, workspace, None);
                }
            }
        }
    }

    pub(super) fn preimage(
        &self,
        query: [f64; 3],
        tolerance: f64,
        options: &QueryOptions,
        poll: Poll,
    ) -> Result<FootSet, Error> {
        match self {
            Self::Spline(surface) => surface.preimage(query, tolerance, options, poll),
            Self::Function(surface) => surface.preimage(query, tolerance, options, poll),
        }
    }

    pub(super) fn extrema(
        &self,
        query: [f64; 3],
        options: &ExtremaOptions,
        poll: Poll,
    ) -> Result<FootSet, Error> {
        match self {
            Self::Spline(surface) => surface.extrema(query, options, poll),
            Self::Function(surface) => surface.extrema(query, options, poll),
        }
    }
}
