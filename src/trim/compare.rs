//! How far two supports are apart where one is the other in changed parameters.
//!
//! ```text
//!   linear change, two charts      greatest distance of the splines at equal parameters, proven (`operate::difference`)
//!   anything else                  greatest distance at a grid of [`PLACES`] squared places, borders included: not proven
//! ```

use super::{Support, invalid, norm, sub};
use crate::error::Error;
use crate::operate::Direction;
use crate::pcurve::Parameters;
use crate::surface::Surface;
use crate::transform::{Transform, between};

/// Places per direction at which supports are compared that cannot be compared with proof.
pub const PLACES: usize = 33;

/// The distance of two supports.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Apart {
    pub distance: f64,
    pub proven: bool,
}

/// The distance of `from` at (u, v) from `to` at `transform(u, v)`.
///
/// # Errors
/// A place at which it is more than the tolerance, or a function fails; memory that could not be had.
pub(super) fn compare(
    transform: &Transform,
    from: &Support,
    to: &Support,
    tolerance: f64,
) -> Result<Apart, Error> {
    if let Some(bound) = proven(transform, from, to)?
        && bound <= tolerance
    {
        return Ok(Apart { distance: bound, proven: true });
    }
    let distance = measured("surface", transform, from, to, tolerance)?;
    Ok(Apart { distance, proven: false })
}

/// The distance of a support from a larger one with the same parameters.
///
/// # Errors
/// As [`compare`]; texts call the part by its name.
pub(super) fn compare_part(
    name: &str,
    part: &Support,
    whole: &Support,
    tolerance: f64,
) -> Result<Apart, Error> {
    if let (Some(ours), Some(theirs)) = (part.chart()?, whole.chart()?)
        && let Ok(cut) = theirs.surface.part(part.domain())
        && cut.domain() == ours.surface.domain()
    {
        let distance = cut.difference(ours.surface)?.bound + ours.error + theirs.error;
        if distance <= tolerance {
            return Ok(Apart { distance, proven: true });
        }
    }
    let stay = Transform::identity(part.domain())?;
    let distance = measured(&format!("surface of the {name}"), &stay, part, whole, tolerance)?;
    Ok(Apart { distance, proven: false })
}

/// A bound, when both are splines in parameters that differ linearly.
fn proven(transform: &Transform, from: &Support, to: &Support) -> Result<Option<f64>, Error> {
    if !transform.is_linear() || transform.domain() != from.domain() {
        return Ok(None);
    }
    let (Some(ours), Some(theirs)) = (from.chart()?, to.chart()?) else { return Ok(None) };
    let moved = linearly(ours.surface, transform)?;
    if moved.domain() != theirs.surface.domain() {
        return Ok(None);
    }
    let bound = moved.difference(theirs.surface)?.bound + ours.error + theirs.error;
    Ok(Some(bound))
}

fn measured(
    name: &str,
    transform: &Transform,
    from: &Support,
    to: &Support,
    tolerance: f64,
) -> Result<f64, Error> {
    let [u0, u1, v0, v1] = from.domain();
    let share = |k: usize| k as f64 / (PLACES - 1) as f64;
    let mut most: f64 = 0.0;
    for k in 0..PLACES * PLACES {
        let at: Parameters =
            [between(u0, u1, share(k % PLACES)), between(v0, v1, share(k / PLACES))];
        let off = norm(sub(from.evaluate(at), to.evaluate(transform.apply(at))));
        if off.is_nan() || off > tolerance {
            let [u, v] = at;
            return invalid(format!("support: differs from the {name} by {off} at ({u}, {v})"));
        }
        most = most.max(off);
    }
    Ok(most)
}

/// A spline in linearly changed parameters.
pub(super) fn linearly(surface: &Surface, transform: &Transform) -> Result<Surface, Error> {
    let mut new = surface.clone();
    for (direction, relation) in [(Direction::U, &transform.u), (Direction::V, &transform.v)] {
        if !relation.is_increasing() {
            new = new.reverse(direction)?;
        }
    }
    let ([u0, u1], [v0, v1]) = (transform.u.image(), transform.v.image());
    if new.domain() != [u0, u1, v0, v1] {
        new = new.with_domain([u0, u1, v0, v1])?;
    }
    if transform.swap { new.swap() } else { Ok(new) }
}
