//! The surface under a face, asked in its own parameters, whatever it is given by.
//!
//! ```text
//!   spline        its index
//!   elementary    the index of its exact NURBS form; parameters go through the relations of the circle forms
//!   function      its own search, proven as far as the function has bounds
//! ```

use std::sync::Arc;

use crate::bounds::{Vector, norm, sub};
use crate::callback::CallbackSurface;
use crate::closest::{FootPoint, QueryOptions, Workspace};
use crate::error::Error;
use crate::extrema::ExtremaOptions;
use crate::index::{IndexedSurface, Poll};
use crate::set::FootSet;
use crate::transform::{Relation, Transform};
use crate::trim::{ElementarySupport, Support};

/// Share of the domain by which intervals grow when they go from one parametrisation to another: far above rounding.
const GROWN: f64 = 1e-14;

/// A surface that answers queries.
#[derive(Debug)]
pub(super) enum Ground {
    Spline(Arc<IndexedSurface>),
    Elementary {
        support: Arc<ElementarySupport>,
        /// From the parameters of the surface to those of its form, and back.
        to_form: Box<Transform>,
        back: Box<Transform>,
    },
    Function(Arc<CallbackSurface>),
}

impl Ground {
    pub fn new(support: &Support, poll: Poll) -> Result<Self, Error> {
        Ok(match support {
            Support::Spline(spline) => {
                spline.prepare(poll)?;
                Self::Spline(Arc::clone(spline))
            }
            Support::Elementary(elementary) => {
                elementary.form()?.prepare(poll)?;
                let to_form = Box::new(elementary.to_form()?);
                let back = Box::new(to_form.inverse());
                Self::Elementary { support: Arc::clone(elementary), to_form, back }
            }
            Support::Callback(callback) => Self::Function(Arc::clone(callback)),
        })
    }

    /// Whether distances are proven: a function needs a bound of its speed for that.
    pub fn is_proven(&self) -> bool {
        match self {
            Self::Function(function) => function.bounds().speed.is_some(),
            _ => true,
        }
    }

    /// Whether no stationary point is missing: a function needs bounds of its second derivatives for that.
    pub fn has_all_extrema(&self) -> bool {
        match self {
            Self::Function(function) => function.bounds().second.is_some(),
            _ => true,
        }
    }

    /// Bytes held.
    pub fn memory(&self) -> usize {
        match self {
            Self::Spline(spline) => spline.memory(),
            Self::Elementary { support, .. } => support.form().map_or(0, IndexedSurface::memory),
            Self::Function(function) => function.memory(),
        }
    }

    /// Diagonal of the surface's box.
    pub fn diagonal(&self, poll: Poll) -> Result<f64, Error> {
        Ok(match self {
            Self::Spline(spline) => spline.index(poll)?.frame.diagonal,
            Self::Elementary { support, .. } => support.form()?.index(poll)?.frame.diagonal,
            Self::Function(function) => function.bounding_box().diagonal(),
        })
    }

    pub fn closest(
        &self,
        query: Vector,
        hint: Option<[f64; 2]>,
        options: &QueryOptions,
        workspace: &mut Workspace,
    ) -> FootPoint {
        match self {
            Self::Spline(spline) => spline.closest(query, hint, options, workspace, None),
            Self::Function(function) => function.closest(query, hint, options, None),
            Self::Elementary { support, to_form, back } => {
                let Ok(form) = support.form() else { return FootPoint::unreached() };
                let hint = hint.map(|at| to_form.apply(at));
                let options = QueryOptions {
                    domain: options.domain.map(|area| moved(area, to_form)),
                    ..*options
                };
                let foot = form.closest(query, hint, &options, workspace, None);
                own_foot(query, foot, support, back)
            }
        }
    }

    pub fn extrema(
        &self,
        query: Vector,
        options: &ExtremaOptions,
        poll: Poll,
    ) -> Result<FootSet, Error> {
        match self {
            Self::Spline(spline) => spline.extrema(query, options, poll),
            Self::Function(function) => function.extrema(query, options, poll),
            Self::Elementary { support, to_form, back } => {
                let domain = options.domain.map(|area| moved(area, to_form));
                let asked = ExtremaOptions { domain, ..*options };
                let set = support.form()?.extrema(query, &asked, poll)?;
                Ok(own_set(query, set, support, back))
            }
        }
    }

    pub fn preimage(
        &self,
        query: Vector,
        tolerance: f64,
        options: &QueryOptions,
        poll: Poll,
    ) -> Result<FootSet, Error> {
        match self {
            Self::Spline(spline) => spline.preimage(query, tolerance, options, poll),
            Self::Function(function) => function.preimage(query, tolerance, options, poll),
            Self::Elementary { support, back, .. } => {
                let set = support.form()?.preimage(query, tolerance, options, poll)?;
                Ok(own_set(query, set, support, back))
            }
        }
    }

    /// Whether a restriction u0, u1, v0, v1 lies in the domain and is none too small.
    pub fn check_domain(&self, area: [f64; 4]) -> Result<(), Error> {
        match self {
            Self::Spline(spline) => spline.check_domain(area),
            Self::Function(function) => function.check_domain(area),
            Self::Elementary { support, to_form, .. } => {
                support.form()?.check_domain(moved(area, to_form))
            }
        }
    }
}

/// A box of parameters under a transform that rises in both, grown against rounding.
fn moved(area: [f64; 4], transform: &Transform) -> [f64; 4] {
    let along = |relation: &Relation, low: f64, high: f64| {
        let [a, b] = relation.image();
        let room = GROWN * (b - a);
        let grown = |x: f64, by: f64| {
            let y = relation.apply(x);
            // What is on the border stays there.
            if y == a || y == b { y } else { (y + by).clamp(a, b) }
        };
        [grown(low, -room), grown(high, room)]
    };
    let ([a, b], [c, d]) =
        (along(&transform.u, area[0], area[1]), along(&transform.v, area[2], area[3]));
    [a, b, c, d]
}

/// A foot of the form in the parameters of the surface.
fn own_foot(
    query: Vector,
    foot: FootPoint,
    support: &ElementarySupport,
    back: &Transform,
) -> FootPoint {
    if !(foot.u.is_finite() && foot.v.is_finite()) {
        return foot;
    }
    let [u, v] = back.apply([foot.u, foot.v]);
    let point = support.surface().evaluate(u, v);
    let distance = norm(sub(query, point));
    let lower_bound = foot.lower_bound.min(distance);
    FootPoint { u, v, point, distance, lower_bound, ..foot }
}

fn own_set(
    query: Vector,
    mut set: FootSet,
    support: &ElementarySupport,
    back: &Transform,
) -> FootSet {
    for member in &mut set.members {
        member.foot = own_foot(query, member.foot, support, back);
        let area = [member.u[0], member.u[1], member.v[0], member.v[1]];
        let [a, b, c, d] = moved(area, back);
        (member.u, member.v) = ([a, b], [c, d]);
    }
    for area in &mut set.undecided {
        *area = moved(*area, back);
    }
    set
}
