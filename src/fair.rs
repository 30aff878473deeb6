//! Fairing: smaller energy, fewer inflections, and a proof of how far the shape has moved.
//!
//! ```text
//!   energy = sum over quadrature points of |row . poles|^2      rows: derivatives of the (rational) basis functions
//!   |new(u) - old(u)|  <=  max |new pole - old pole|            knots and weights stay, so this is a hull
//! ```
//!
//! Knots and weights stay, poles move: each within a ball about where it was, so that the deviation is proven at every
//! parameter. Every step goes to a point of the segment between two allowed sets of poles at which the energy is least; the
//! energy never rises.
//!
//! References: Farin, Sapidis, *Curvature and the fairness of curves and surfaces*, 1989; Eck, Hadenfeld, *Local energy
//! fairing of B-spline curves*, 1995; Hoschek, Lasser, *Fundamentals of Computer Aided Geometric Design*, chapter 13.
//! Limit: energies are integrals over the parameters (or over the arc length of the shape as it was): Gauss' quadrature, exact
//! for polynomial shapes.

mod cells;

mod rows;

mod slope;

mod length;

mod problem;

mod equations;

mod solve;

mod local;

mod lines;

mod curve;

mod surface;

pub use curve::{CurveFairing, fair_curve};
pub use length::arc_length;
pub use surface::{SurfaceFairing, fair_surface};

/// How poles are moved.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Method {
    /// All poles at once, to the least energy that the constraints allow.
    #[default]
    Energy,
    /// One pole at a time, where the energy falls most (Eck, Hadenfeld).
    Local,
    /// One knot at a time: what removing it would do to the poles, where the jump of the first derivative that is not
    /// continuous there is greatest (Farin, Sapidis). The energy is then the sum of the squared jumps.
    KnotRemoval,
}

/// A shape after fairing, and what is known of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Faired<T> {
    /// The shape, with knots and weights as they were.
    pub shape: T,
    /// The energy before the first step and after each: never rising.
    pub energies: Vec<f64>,
    /// No point has moved farther from the point of the same parameters, proven.
    pub deviation: f64,
    /// Whether the last steps changed the energy by less than a millionth.
    pub converged: bool,
}

/// Steps with less than this share of the energy are none.
const LEAST_GAIN: f64 = 1e-6;
