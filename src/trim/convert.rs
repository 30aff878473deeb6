//! Algorithm 2: faces on elementary surfaces by their geometric parameters, and on the NURBS form of the same surface.
//!
//! The surface is replaced and the domain goes through the relations of the circle forms, in either direction. Degree elevation and
//! knot refinement change no parameter: the surface is replaced and the domain stays.

use super::{ChangeOptions, Changed, Support, TrimmedSurface, invalid};
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
        self.changed(&transform, surface.nurbs(forms)?.into(), options)
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
        self.changed(&transform, surface.into(), options)
    }

    /// This face on another spline form with the same parametrisation: with more knots, or of higher degree.
    ///
    /// # Errors
    /// Another domain, or points that differ by more than the tolerance.
    pub fn on_surface(&self, surface: Surface, options: &ChangeOptions) -> Result<Changed, Error> {
        let transform = Transform::identity(self.support().domain())?;
        self.changed(&transform, surface.into(), options)
    }
}
