//! Algorithm 3: the parameters of one surface that belong to those of another parametrisation, found by inversion.
//!
//! Where no formula is known but the change is separable and monotone, `(s, t) = (f(u), g(v))`, every point of the isoline
//! v = constant tells f alone, and every point of an isoline u = constant tells g. Both are taken from isolines through the middle
//! of the domain, away from poles:
//!
//! ```text
//!   u at an end of the domain       s is that end (the other one when f falls)
//!   otherwise                       s of the inversion of S(u, v_m), polished along the target's isoline; beside a seam of the
//!                                   target, on the side that u is on
//!   the same for v with S(u_m, v)
//! ```
//!
//! So nothing is ambiguous: a seam has its sides by rule, and a pole keeps its longitude, which direct inversion loses there.
//! That the change is separable is checked at every place: the image must be the same point within the tolerance.
//!
//! Precondition: both surfaces have their seams at the same place; that is checked when a matching is made.
//!
//! Reference: Yang, Yong, *Parameter transformation of trimmed surfaces*, Algorithm 3.

use std::sync::Arc;

use super::{Support, invalid};
use crate::batch;
use crate::bounds::{Vector, dot, norm, sub};
use crate::closest::{FootPoint, QueryOptions, Workspace, flag};
use crate::error::Error;
use crate::transform::{Function, Relation, Transform, between};

/// Share of the domain beside a seam where an inversion may tell the wrong side.
const BESIDE: f64 = 1e-6;

/// Most Newton steps after an inversion, which stops at a border that is nearer than its accuracy.
const STEPS: usize = 8;

/// Default tolerance as a share of the diagonal.
const DEFAULT_TOLERANCE: f64 = 1e-7;

/// Shares of the domain that isolines in the middle are chosen from, and places on each.
const MIDDLES: [f64; 7] = [0.5, 0.4, 0.6, 0.3, 0.7, 0.45, 0.55];
const PLACES: usize = 7;

/// Two parametrisations of one surface that differ by a separable, monotone change.
#[derive(Clone, Debug)]
pub struct Matching {
    from: Support,
    to: Support,
    /// u and v of the isolines that tell g and f.
    middle: [f64; 2],
    /// Their images, once they are known.
    image_middle: Option<[f64; 2]>,
    rising: [bool; 2],
    tolerance: f64,
    closed: [bool; 2],
}

/// One parameter's image, and whether the inversion was proven.
type Found = (f64, bool);

impl Matching {
    /// Compares two supports. `tolerance`: how far points of one may be from the other; 0: 1e-7 of the diagonal.
    ///
    /// # Errors
    /// A tolerance that is no length; surfaces that are not the same, whose seams are at different places, or whose parameters
    /// do not follow each other.
    pub fn new(from: Support, to: Support, tolerance: f64) -> Result<Self, Error> {
        let diagonal = to.bounding_box()?.diagonal();
        let tolerance = match tolerance {
            0.0 => DEFAULT_TOLERANCE * diagonal,
            t if t > 0.0 && t.is_finite() => t,
            t => return invalid(format!("tolerance: {t} is not a positive length")),
        };
        let middle = [middle_of(&from, 0)?, middle_of(&from, 1)?];
        let closed = to.closed();
        let mut matching =
            Self { from, to, middle, image_middle: None, rising: [true; 2], tolerance, closed };
        matching.rising = [matching.find_direction(0)?, matching.find_direction(1)?];
        let workspace = &mut Workspace::default();
        let images =
            [0, 1].map(|k| matching.along(k, middle[k], workspace).map_or(f64::NAN, |f| f.0));
        matching.image_middle = Some(images);
        for direction in 0..2 {
            matching.check_ends(direction)?;
        }
        Ok(matching)
    }

    /// Whether f and g rise.
    pub fn rising(&self) -> [bool; 2] {
        self.rising
    }

    /// The image of a place: its parameters on the target, the point there, and the distance to the point of the place. Flags:
    /// [`flag::NOT_PROVEN`] when an inversion was not proven, [`flag::NOT_ON_SHAPE`] when the distance is beyond the tolerance,
    /// that is, the surfaces or their parameters differ there; [`flag::BAD_QUERY`] for a place that is not in the domain.
    pub fn image(&self, [u, v]: [f64; 2], workspace: &mut Workspace) -> FootPoint {
        let [u0, u1, v0, v1] = self.from.domain();
        if !(u0 <= u && u <= u1 && v0 <= v && v <= v1) {
            return FootPoint::bad_query();
        }
        let (Some((s, proven_s)), Some((t, proven_t))) =
            (self.along(0, u, workspace), self.along(1, v, workspace))
        else {
            return FootPoint::unreached();
        };
        let point = self.to.evaluate([s, t]);
        let distance = norm(sub(self.from.evaluate([u, v]), point));
        let mut flags = 0;
        if !(proven_s && proven_t) {
            flags |= flag::NOT_PROVEN;
        }
        if distance.is_nan() || distance > self.tolerance {
            flags |= flag::NOT_ON_SHAPE;
        }
        FootPoint { u: s, v: t, point, distance, lower_bound: 0.0, flags, iterations: 2 }
    }

    /// The images of many places, over threads as [`batch::run`] has them.
    ///
    /// # Errors
    /// [`Error::Cancelled`] when `poll` said so; memory that could not be had.
    pub fn images(
        &self,
        places: &[[f64; 2]],
        out: &mut [FootPoint],
        threads: usize,
        poll: batch::Poll,
    ) -> Result<(), Error> {
        let work = |k: usize, workspace: &mut Workspace| self.image(places[k], workspace);
        batch::run(&mut out[..places.len()], threads, None, &work, poll)
    }

    /// The change as a transform, for [`super::TrimmedSurface::changed`]. An inversion that is not proven ends its making.
    ///
    /// # Errors
    /// An inverse that disagrees, or a relation that is not monotone where it is checked.
    pub fn transform(&self) -> Result<Transform, Error> {
        let there = Arc::new(self.clone());
        let back = Arc::new(Self::new(self.to.clone(), self.from.clone(), self.tolerance)?);
        let relation = |direction: usize| {
            let function = |matching: &Arc<Self>| -> Function {
                let matching = Arc::clone(matching);
                Arc::new(move |x| {
                    let found = matching.along(direction, x, &mut Workspace::default());
                    found.filter(|found| found.1).map_or(f64::NAN, |found| found.0)
                })
            };
            let domain = self.from.domain();
            let range = [domain[2 * direction], domain[2 * direction + 1]];
            Relation::function(range, function(&there), function(&back))
        };
        Ok(Transform::new(relation(0)?, relation(1)?))
    }

    /// f of u or g of v.
    fn along(&self, direction: usize, x: f64, workspace: &mut Workspace) -> Option<Found> {
        let [a, b] = ends(&self.from, direction);
        let [c, d] = self.target_ends(direction);
        if x <= a {
            return Some((c, true));
        }
        if x >= b {
            return Some((d, true));
        }
        let query = self.isoline_point(direction, x);
        let foot = self.to.invert(query, &QueryOptions::default(), workspace);
        if foot.distance.is_nan() || foot.distance > self.tolerance {
            return None;
        }
        let mut found = [foot.u, foot.v];
        // Beside a seam, start on the side that x is on.
        let (low, high) = (c.min(d), c.max(d));
        let beside = (found[direction] - low).min(high - found[direction]);
        if self.closed[direction] && beside <= BESIDE * (high - low) {
            found[direction] = if x - a <= b - x { c } else { d };
        }
        let found = self.polished(direction, query, found);
        let off = norm(sub(query, self.to.evaluate(found)));
        let proven = foot.flags & flag::NOT_PROVEN == 0 && off <= self.tolerance;
        Some((found[direction], proven))
    }

    /// Newton steps along the target's isoline that the query lies on, as far as the arithmetic goes.
    fn polished(&self, direction: usize, query: Vector, mut at: [f64; 2]) -> [f64; 2] {
        let [c, d] = ends(&self.to, direction);
        if let Some(image) = self.image_middle {
            at[1 - direction] = image[1 - direction];
        }
        let mut best = (norm(sub(query, self.to.evaluate(at))), at);
        for _ in 0..STEPS {
            let mut out = [[0.0; 3]; 3];
            if !self.to.partials(at, 1, &mut out) {
                break;
            }
            let slope = out[1 + direction];
            let step = dot(sub(query, out[0]), slope) / dot(slope, slope);
            if !step.is_finite() {
                break;
            }
            at[direction] = (at[direction] + step).max(c).min(d);
            let off = norm(sub(query, self.to.evaluate(at)));
            if off < best.0 {
                best = (off, at);
            } else {
                break;
            }
        }
        best.1
    }

    /// A point of the isoline that tells the image of this parameter.
    fn isoline_point(&self, direction: usize, x: f64) -> Vector {
        let mut at = self.middle;
        at[direction] = x;
        self.from.evaluate(at)
    }

    /// The images of the ends of a direction.
    fn target_ends(&self, direction: usize) -> [f64; 2] {
        let [c, d] = ends(&self.to, direction);
        if self.rising[direction] { [c, d] } else { [d, c] }
    }

    /// Whether the image rises between two places in the middle of the domain.
    fn find_direction(&self, direction: usize) -> Result<bool, Error> {
        let [a, b] = ends(&self.from, direction);
        let mut workspace = Workspace::default();
        let mut images = Vec::new();
        for share in [0.25, 0.5, 0.75] {
            let x = between(a, b, share);
            match self.along(direction, x, &mut workspace) {
                Some((image, _)) => images.push(image),
                None => return invalid(format!("to: has no point of the surface at {x}")),
            }
        }
        if images[0] < images[1] && images[1] < images[2] {
            return Ok(true);
        }
        if images[0] > images[1] && images[1] > images[2] {
            return Ok(false);
        }
        let name = ["u", "v"][direction];
        invalid(format!("to: its parameters do not follow {name}, or its seam is elsewhere"))
    }

    /// The borders of the domains must be the same curves: the middle isoline must end on the target's border.
    fn check_ends(&self, direction: usize) -> Result<(), Error> {
        let mut workspace = Workspace::default();
        let other = 1 - direction;
        let [a, b] = ends(&self.from, direction);
        let image = self.along(other, self.middle[other], &mut workspace);
        for (x, target) in [a, b].into_iter().zip(self.target_ends(direction)) {
            let mut at = [target; 2];
            at[other] = image.map_or(f64::NAN, |found| found.0);
            let off = norm(sub(self.isoline_point(direction, x), self.to.evaluate(at)));
            if off.is_nan() || off > self.tolerance {
                let name = ["u", "v"][direction];
                return invalid(format!("to: its border is {off} away from that at {name} = {x}"));
            }
        }
        Ok(())
    }
}

fn ends(support: &Support, direction: usize) -> [f64; 2] {
    let domain = support.domain();
    [domain[2 * direction], domain[2 * direction + 1]]
}

/// The value of a parameter on whose isoline the other one moves points fastest where it is slowest.
fn middle_of(support: &Support, direction: usize) -> Result<f64, Error> {
    let (own, other) = (ends(support, direction), ends(support, 1 - direction));
    let mut best = (0.0, f64::NAN);
    for share in MIDDLES {
        let x = between(own[0], own[1], share);
        let mut least = f64::INFINITY;
        for k in 0..PLACES {
            let mut at = [x; 2];
            at[1 - direction] = between(other[0], other[1], (k as f64 + 0.5) / PLACES as f64);
            let mut out = [[0.0; 3]; 3];
            if !support.partials(at, 1, &mut out) {
                least = f64::NAN;
            }
            least = least.min(norm(out[2 - direction]));
        }
        // The middle itself unless another one is clearly better.
        if least > 1.05 * best.0 {
            best = (least, x);
        }
    }
    if best.1.is_nan() {
        return invalid("from: no isoline in the middle of the domain moves".into());
    }
    Ok(best.1)
}
