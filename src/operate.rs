//! Operations on shapes: each makes a new shape and leaves the old one as it is.
//!
//! ```text
//!   exact               insert, refine, part, clamp, unclamp, elevate, reverse, swap, reparametrise, transform,
//!                       derivative, compatible, Bezier and power form: the same points up to rounding
//!   with a proven error  remove knots, reduce, periodic, join: `Bounded { shape, error }`
//! ```
//!
//! Nearly all exact ones are one thing, a `map`: each new pole is a mean of neighbouring old ones with shares that are never
//! negative, so that errors stay a few units of the size of the local net. The error of the others is not estimated:
//! [`difference`](crate::operate::Difference) bounds the distance of old and new shape at equal parameters by the hull of
//! their difference, and that also bounds the Hausdorff distance.
//!
//! Surfaces take the [`Direction`] first. Knot insertion and splitting stand at the shapes themselves.
//!
//! References: Piegl, Tiller, *The NURBS Book*, 2nd ed., chapters 5 and 6; Ramshaw, *Blossoms are polar forms*, 1989.

use crate::curve::Curve;
use crate::curve::insertion::{Weighted, transposed};
use crate::error::Error;
use crate::knots::{Knots, MAX_MAGNITUDE};
use crate::surface::Surface;

pub(crate) mod map;

mod refinement;

mod elevation;

mod pieces;

mod difference;

mod reparametrisation;

mod compatible;

mod removal;

mod least_squares;

mod reduction;

mod periodicity;

mod joining;

mod transformation;

mod derivation;

mod length;

mod power;

mod continuity;

pub use compatible::{compatible_curves, compatible_surfaces};
pub use continuity::{Crease, Frame, Joint};
pub use difference::Difference;
pub use joining::{join_curves, join_surfaces};
pub use length::{ArcLength, Estimate};
pub use power::{Coefficient, PowerCurve, PowerSurface};

use map::Map;

/// A parameter direction of a surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// The first parameter.
    U,
    /// The second parameter.
    V,
}

impl Direction {
    /// 0 for u, 1 for v.
    pub fn index(self) -> usize {
        self as usize
    }

    /// "_u" or "_v", what names of parameters end in.
    pub(crate) fn suffix(self) -> &'static str {
        ["_u", "_v"][self.index()]
    }
}

/// An approximation, and how far it is from what it stands for.
#[derive(Clone, Debug, PartialEq)]
pub struct Bounded<T> {
    /// The new shape.
    pub shape: T,
    /// No point of it is farther than this from the point of the old shape at the same parameters. Proven.
    pub error: f64,
}

impl Curve {
    /// The curve whose poles are means of the poles of this one.
    fn mapped(&self, map: &Map) -> Result<Self, Error> {
        self.like(map.knots.clone(), &map.apply(&self.strand()?)?)
    }
}

impl Surface {
    /// The knot vector of a direction.
    pub fn knots(&self, direction: Direction) -> &Knots {
        match direction {
            Direction::U => self.knots_u(),
            Direction::V => self.knots_v(),
        }
    }

    /// The surface whose rows or columns of poles are means of those of this one.
    fn mapped(&self, direction: Direction, map: &Map) -> Result<Self, Error> {
        self.with_strands(direction, map.knots.clone(), &map.apply(&self.strands(direction)?)?)
    }

    /// The net as strands that run in a direction, one after the other.
    fn strands(&self, direction: Direction) -> Result<Vec<Weighted>, Error> {
        match direction {
            Direction::U => self.columns(),
            Direction::V => self.rows(),
        }
    }

    /// The surface with other strands in a direction.
    fn with_strands(
        &self,
        direction: Direction,
        knots: Knots,
        strands: &[Weighted],
    ) -> Result<Self, Error> {
        match direction {
            Direction::U => self.like_columns(knots, strands),
            Direction::V => self.like(self.knots_u().clone(), knots, strands),
        }
    }

    /// The surface with the directions exchanged: `new(v, u) = old(u, v)`. Exact.
    ///
    /// # Errors
    /// Memory that could not be had.
    pub fn swap(&self) -> Result<Self, Error> {
        let net = transposed(&self.rows()?, self.knots_v().pole_count())?;
        self.like(self.knots_v().clone(), self.knots_u().clone(), &net)
    }
}

fn check_tolerance(tolerance: f64) -> Result<(), Error> {
    if (0.0..=MAX_MAGNITUDE).contains(&tolerance) {
        return Ok(());
    }
    Err(Error::InvalidArgument(format!("tolerance: {tolerance} is negative or not finite")))
}
