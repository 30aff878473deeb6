//! Inversion on a support: the parameters of a point, with the certificate of the engine.

use super::{ElementarySupport, Support, form_transform};
use crate::bounds::{Vector, norm, sub};
use crate::closest::{FootPoint, QueryOptions, Workspace, flag};
use crate::curve::Curve;
use crate::elementary::part;
use crate::error::Error;
use crate::pcurve::{Direction, Isoline};
use crate::transform::Transform;

impl ElementarySupport {
    /// From the parameters of the surface to those of [`ElementarySupport::form`].
    ///
    /// # Errors
    /// None in practice: the usual forms fit every sweep.
    pub fn to_form(&self) -> Result<Transform, Error> {
        form_transform(self.surface(), self.surface().usual_forms())
    }
}

impl ElementarySupport {
    /// The curve of an isoline in space, along the increasing parameter: an isocurve of the exact form. None for a point.
    ///
    /// # Errors
    /// Memory that could not be had.
    pub(crate) fn isocurve(&self, line: &Isoline) -> Result<Option<Curve>, Error> {
        let (form, to_form) = (self.form()?.surface(), self.to_form()?);
        let (across, along) = match line.fixed {
            Direction::U => (&to_form.u, &to_form.v),
            Direction::V => (&to_form.v, &to_form.u),
        };
        let at = across.apply(line.at);
        let whole = match line.fixed {
            Direction::U => form.isocurve_u(at),
            Direction::V => form.isocurve_v(at),
        };
        let [low, high] = along.domain();
        let end = |x: f64| along.apply(x.clamp(low, high));
        let (a, b) = (end(line.from.min(line.to)), end(line.from.max(line.to)));
        if a < b { part(&whole, [a, b]).map(Some) } else { Ok(None) }
    }
}

impl Support {
    /// The curve of an isoline of the domain in space, along the increasing parameter; with the parameters of the isoline unless
    /// these are angles. None for a point, or on a function.
    ///
    /// # Errors
    /// Memory that could not be had.
    pub(super) fn isocurve(&self, line: &Isoline) -> Result<Option<Curve>, Error> {
        let spline = match self {
            Self::Elementary(elementary) => return elementary.isocurve(line),
            Self::Callback(_) => return Ok(None),
            Self::Spline(spline) => spline.surface(),
        };
        let whole = match line.fixed {
            Direction::U => spline.isocurve_u(line.at),
            Direction::V => spline.isocurve_v(line.at),
        };
        let (low, high) = whole.domain();
        let end = |x: f64| x.clamp(low, high);
        let (a, b) = (end(line.from.min(line.to)), end(line.from.max(line.to)));
        if a < b { part(&whole, [a, b]).map(Some) } else { Ok(None) }
    }

    /// The nearest point of the whole surface to `query`, in the parameters of this support. Elementary surfaces are searched in
    /// their exact NURBS form: the bound is that of the form, which is the same surface up to rounding. A point farther than the
    /// tolerance is marked [`flag::NOT_ON_SHAPE`]. What cannot be had for lack of memory is [`FootPoint::unreached`].
    pub fn invert(
        &self,
        query: Vector,
        options: &QueryOptions,
        workspace: &mut Workspace,
    ) -> FootPoint {
        match self {
            Self::Spline(spline) => spline.invert(query, None, options, workspace, None),
            Self::Callback(callback) => callback.invert(query, None, options, None),
            Self::Elementary(elementary) => {
                let (Ok(form), Ok(to_form)) = (elementary.form(), elementary.to_form()) else {
                    return FootPoint::unreached();
                };
                let mut foot = form.invert(query, None, options, workspace, None);
                if foot.flags & flag::BAD_QUERY != 0 || !foot.u.is_finite() {
                    return foot;
                }
                let [u, v] = to_form.inverse().apply([foot.u, foot.v]);
                let point = elementary.surface().evaluate(u, v);
                let distance = norm(sub(query, point));
                foot = FootPoint { u, v, point, distance, ..foot };
                foot.lower_bound = foot.lower_bound.min(distance);
                foot
            }
        }
    }
}
