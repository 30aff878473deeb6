//! Algorithm 2: faces on elementary surfaces by their geometric parameters, and on the NURBS form of the same surface.
//!
//! The surface is replaced and the domain goes through the relations of the circle forms, in either direction. Degree elevation and
//! knot refinement change no parameter: the surface is replaced and the domain stays. Reversal, exchange and another domain of a
//! spline are exact; any other change of parameters makes a surface by a function of the old one.

use std::sync::Arc;

use super::compare::linearly;
use super::{ChangeOptions, Changed, Support, TrimmedSurface, invalid};
use crate::callback::{CallbackSurface, SurfaceBounds};
use crate::elementary::{CircleForm, ElementarySurface};
use crate::error::Error;
use crate::surface::Surface;
use crate::transform::{Relation, Transform};

/// From the parameters of an elementary surface to those of its NURBS form ([`ElementarySurface::nurbs`]) with these circle forms.
///
/// # Errors
/// A form that cannot make the sweep.
pub fn form_transform(
    surface: &ElementarySurface,
    forms: [CircleForm; 2],
) -> Result<Transform, Error> {
    let (domain, angular) = (surface.domain(), surface.angular());
    let relation = |k: usize| {
        let range = [domain[2 * k], domain[2 * k + 1]];
        if !angular[k] {
            return Relation::identity(range);
        }
        let angle = Relation::circle(forms[k], range[1] - range[0], [0.0, 1.0], range)?;
        Ok(angle.inverse())
    };
    Ok(Transform::new(relation(0)?, relation(1)?))
}

impl TrimmedSurface {
    /// This face of an elementary surface on the exact NURBS form of it.
    ///
    /// # Errors
    /// A surface that is not elementary; a form that cannot make the sweep; what [`TrimmedSurface::changed`] refuses.
    pub fn to_nurbs(
        &self,
        forms: [CircleForm; 2],
        options: &ChangeOptions,
    ) -> Result<Changed, Error> {
        let Support::Elementary(elementary) = self.support() else {
            return invalid("face: its surface is not elementary".into());
        };
        let surface = elementary.surface();
        let transform = form_transform(surface, forms)?;
        let form = surface.nurbs(forms)?;
        let known = rounding(&form);
        self.changed_known(&transform, form.into(), options, Some(known))
    }

    /// This face of a NURBS form on the elementary surface that it is the form of. Knots may have been refined and degrees raised.
    ///
    /// # Errors
    /// A form that cannot make the sweep; a surface that is not this form of `surface`; what [`TrimmedSurface::changed`] refuses.
    pub fn to_elementary(
        &self,
        surface: ElementarySurface,
        forms: [CircleForm; 2],
        options: &ChangeOptions,
    ) -> Result<Changed, Error> {
        let transform = form_transform(&surface, forms)?.inverse();
        // Proven when the face's surface is near the form itself.
        let mut known = None;
        if let Support::Spline(spline) = self.support() {
            let form = surface.nurbs(forms)?;
            if form.domain() == spline.surface().domain() {
                known = Some(form.difference(spline.surface())?.bound + rounding(&form));
            }
        }
        self.changed_known(&transform, surface.into(), options, known)
    }

    /// This face on another spline form with the same parametrisation: with more knots, or of higher degree.
    ///
    /// # Errors
    /// Another domain, or points that differ by more than the tolerance.
    pub fn on_surface(&self, surface: Surface, options: &ChangeOptions) -> Result<Changed, Error> {
        let transform = Transform::identity(self.support().domain())?;
        self.changed(&transform, surface.into(), options)
    }

    /// This face with its surface in the parameters `transform(u, v)`. Under a linear transform a spline, or an elementary surface
    /// without angles, becomes a spline, exactly; else the new surface is a function of the old one, and nothing is proven.
    ///
    /// # Errors
    /// What [`TrimmedSurface::changed`] refuses.
    pub fn reparametrised(
        &self,
        transform: &Transform,
        options: &ChangeOptions,
    ) -> Result<Changed, Error> {
        if !transform.is_linear() {
            return self.changed(transform, composed(self.support(), transform)?, options);
        }
        match self.support() {
            Support::Spline(spline) => {
                let surface = linearly(spline.surface(), transform)?;
                self.changed(transform, surface.into(), options)
            }
            Support::Elementary(elementary) if elementary.surface().angular() == [false; 2] => {
                let surface = linearly(elementary.form()?.surface(), transform)?;
                self.changed(transform, surface.into(), options)
            }
            other => self.changed(transform, composed(other, transform)?, options),
        }
    }
}

/// How far points of a NURBS form may be from those of the elementary surface, which they are but for rounding.
fn rounding(form: &Surface) -> f64 {
    let (low, high) = form.bounding_box();
    let largest = low.iter().chain(&high).fold(0.0, |most: f64, x| most.max(x.abs()));
    64.0 * f64::EPSILON * largest
}

/// A surface in other parameters, by a function of the old one.
fn composed(support: &Support, transform: &Transform) -> Result<Support, Error> {
    let (old, back) = (support.clone(), transform.inverse());
    let function = move |s: f64, t: f64, _: usize, out: &mut [crate::bounds::Vector; 6]| {
        out[0] = old.evaluate(back.apply([s, t]));
        Some(0)
    };
    let made = CallbackSurface::new(transform.image(), SurfaceBounds::default(), function)?;
    Ok(Support::Callback(Arc::new(made)))
}
