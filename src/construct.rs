//! Shapes made from what designers give: numbers, points, curves.
//!
//! ```text
//!   exact          lines, conics and arcs in every usual form; quadrics and tori; ruled, extruded, revolved; Coons, Ferguson,
//!                  Gordon; skinned through sections
//!   approximate    swept along a curve without twist; offsets: with their error
//! ```
//!
//! Exact means: the formula's point set, up to rounding. Curves that are to fit together are made compatible first (`operate`);
//! sums of surfaces are sums of homogeneous poles, relative to one of them.
//!
//! Reference: Piegl, Tiller, *The NURBS Book*, 2nd ed., chapters 7, 8 and 10; Farin, *Curves and Surfaces for CAGD*, chapter 22.

use crate::bounds::{Vector, norm, sub};
use crate::error::Error;

mod conic;
mod quadric;
mod sweep;
mod skin;
mod blend;
mod poly;
mod rail_proof;
mod rail;
mod offset_proof;
mod offset;

pub use blend::{Corners, MEETING_TOLERANCE, coons, coons_bicubic, ferguson, gordon};
pub use conic::{ArcForm, arc, arc_through, circle, conic_arc, ellipse, hyperbola, line, parabola};
pub use offset::{OffsetFit, offset_curve, offset_curve_fit, offset_surface, offset_surface_fit};
pub use quadric::{Quadric, cone, cylinder, plane, quadric, saddle, sphere, torus};
pub use rail::{SweepOptions, Swept, swept};
pub use skin::skinned;
pub use sweep::{extruded, revolved, ruled, translational};

fn invalid<T>(text: String) -> Result<T, Error> {
    Err(Error::InvalidArgument(text))
}

/// Refuses what is not finite or too large, by name.
fn check_number(name: &str, x: f64) -> Result<(), Error> {
    if x.is_finite() && x.abs() <= 1e100 {
        return Ok(());
    }
    invalid(format!("{name}: {x} is not finite or beyond 1e100"))
}

fn check_vector(name: &str, vector: Vector) -> Result<(), Error> {
    vector.into_iter().try_for_each(|x| check_number(name, x))
}

/// Refuses what is not positive, by name.
fn check_positive(name: &str, x: f64) -> Result<(), Error> {
    check_number(name, x)?;
    if x > 0.0 {
        return Ok(());
    }
    invalid(format!("{name}: {x} is not positive"))
}

fn check_interval(name: &str, [a, b]: [f64; 2]) -> Result<(), Error> {
    check_number(name, a)?;
    check_number(name, b)?;
    if a < b {
        return Ok(());
    }
    invalid(format!("{name}: {a} is not less than {b}"))
}

fn gap(a: Vector, b: Vector) -> f64 {
    norm(sub(a, b))
}
