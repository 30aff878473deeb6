//! Inversion on a support: the parameters of a point, with the certificate of the engine.

use super::{ElementarySupport, Support, form_transform};
use crate::bounds::{Vector, norm, sub};
use crate::closest::{FootPoint, QueryOptions, Workspace, flag};
use crate::error::Error;
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

impl Support {
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
