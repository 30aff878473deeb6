//! Images of curves of the domain compared with proof: under two supports, and with curves in space.
//!
//! Every support but a function has a chart, a spline in its own parameters ([`Support::chart`]), and every pcurve is a spline in its own
//! parameter, arcs up to rounding. So distances of images at equal parameters have bounds from Bernstein coefficients
//! ([`crate::pcurve::deviation`]); what charts and arcs may be off is added.

use super::Support;
use super::speed::{curve_speed, speeds};
use crate::curve::Curve;
use crate::error::Error;
use crate::pcurve::Pcurve;
use crate::pcurve::compose::Composer;
use crate::pcurve::deviation::{between_images, deviation};

/// Bounds below this share of what is asked for are not made sharper.
const ENOUGH: f64 = 0.3;

/// A support into which curves are put.
pub(crate) struct Imager<'a> {
    composer: Composer<'a>,
    /// How far the chart may be off.
    error: f64,
    /// Bounds of |Su| and |Sv|.
    speeds: [f64; 2],
}

/// A curve of the domain as a spline in its own parameter.
#[derive(Clone, Debug)]
pub(crate) struct Drawn {
    pub spline: Curve,
    /// How far its image may be from that of the curve on the support, in space.
    error: f64,
}

impl<'a> Imager<'a> {
    /// None for a function.
    ///
    /// # Errors
    /// Memory that could not be had.
    pub fn of(support: &'a Support) -> Result<Option<Self>, Error> {
        let (Some(chart), Some(speeds)) = (support.chart()?, speeds(support)?) else {
            return Ok(None);
        };
        let composer = Composer::new(chart.surface);
        Ok(Some(Self { composer, error: chart.error, speeds }))
    }

    /// A curve ready to be compared.
    ///
    /// # Errors
    /// Memory that could not be had.
    pub fn drawn(&self, pcurve: &Pcurve) -> Result<Drawn, Error> {
        let (spline, off) = pcurve.as_spline_in_parameter()?;
        let (spline, moved) = self.composer.brought_inside(&spline)?;
        let moved = |k: usize| self.speeds[k] * (off[k] + moved[k]);
        Ok(Drawn { spline, error: self.error + moved(0) + moved(1) })
    }

    /// A bound of the distance of two images at equal parameters of a range; none where a curve leaves its domain. Below `goal` it is
    /// made no sharper than need be.
    pub fn apart(
        &mut self,
        own: &Drawn,
        other: &mut Imager,
        theirs: &Drawn,
        range: [f64; 2],
        goal: f64,
    ) -> Option<f64> {
        let first = (&mut self.composer, &own.spline);
        let second = (&mut other.composer, &theirs.spline);
        let found = between_images(first, second, range, ENOUGH * goal).ok()?;
        let bound = found.bound + own.error + theirs.error;
        bound.is_finite().then_some(bound)
    }

    /// A bound of the distance of an image from a curve in space with the same domain, at equal parameters; none where the curve leaves
    /// the domain.
    pub fn off(&mut self, own: &Drawn, curve: &Curve, goal: f64) -> Option<f64> {
        let (a, b) = own.spline.domain();
        let found =
            deviation(&mut self.composer, &own.spline, curve, [a, b], ENOUGH * goal).ok()?;
        // The knots of a curve that was brought to this domain are rounded.
        let grain = 8.0 * f64::EPSILON * a.abs().max(b.abs()) * curve_speed(curve);
        let bound = found.bound + own.error + grain;
        bound.is_finite().then_some(bound)
    }

    /// As [`Self::off`], from the curve `C(e(t))` with a curve e whose first coordinate is a parameter of C.
    pub fn off_along(
        &mut self,
        own: &Drawn,
        curve: &mut Composer,
        along: &Curve,
        goal: f64,
    ) -> Option<f64> {
        let (a, b) = own.spline.domain();
        let (first, second) = ((&mut self.composer, &own.spline), (curve, along));
        let found = between_images(first, second, [a, b], ENOUGH * goal).ok()?;
        let bound = found.bound + own.error;
        bound.is_finite().then_some(bound)
    }
}
