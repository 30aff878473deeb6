//! Local iterations: from a start to a foot point nearby, inside a parameter box.
//!
//! ```text
//!   MAF         the query falls on the tangent (plane); the fall, in parameters, is the step
//!   Newton      the second-order model of the squared distance, when it has a minimum
//!   osculating  the fall goes on along the osculating circle (in both principal directions of a surface)
//! ```
//!
//! All are safeguarded alike: borders by an active set (a parameter at a border whose gradient points outward is
//! held, the others move freely), a step that does not bring the query nearer is halved. Fast, and allowed to be
//! wrong: `closest` proves.
//!
//! References: Hu, Sun, Jin, Wang, *An algorithm for NURBS curve and surface point inversion* (the moving affine
//! frame); Hu, Wallner, *A second order algorithm for orthogonal projection onto curves and surfaces*, 2005;
//! Bertsekas, *Projected Newton methods for optimization problems with simple constraints*, 1982.
//! Limit: where the Hessian is singular the convergence is linear and ends at the step limit.

mod curve;
mod lockstep;
mod surface;

pub use curve::{CurveJets, foot_on_curve, land_on_curve};
pub use lockstep::{Course, CurveSteps, SurfaceSteps, Worth, is_inside};
pub use surface::{SurfaceJets, foot_on_surface, land_on_surface};

/// Which local iteration is used.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Method {
    /// Newton where its model has a minimum, osculating steps elsewhere.
    #[default]
    Auto,
    /// Moving affine frame: first order off the shape, quadratic on it.
    Maf,
    /// Newton; where its model has no minimum, MAF.
    Newton,
    /// Osculating circle, torus.
    Osculating,
}

/// Called with (step, u, v, distance): each iteration of a local method; step 0 is the start.
pub type Trace<'a> = &'a mut dyn FnMut(u32, f64, f64, f64);

/// Step limit of the second-order methods: a good start needs 3 to 6, a bad one 20.
const STEPS: u32 = 40;
/// Step limit of MAF, which is of first order off the shape.
const STEPS_FIRST_ORDER: u32 = 200;
/// A parameter step below this share of the box is the last one: the next would be below its square.
const LAST_STEP: f64 = 3e-9;
/// So is a longer one, up to this share, when the step before tells that the next would be rounding.
const MOST_LAST: f64 = 1e-6;
const ROUNDING: f64 = 1e-16;
/// A parameter step below this share of the parameter (of the box, on surfaces) is rounding.
const NO_STEP: f64 = 4e-16;

/// Where an iteration begins, or goes on after others have begun it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Approach<P> {
    /// Parameters.
    pub at: P,
    /// The size of the whole second-order step to this place, if it was one.
    pub step: Option<f64>,
    /// Jets taken so far, the one at this place left out: so many steps, each accepted at once.
    pub taken: u32,
    /// Whether the iteration ends here.
    pub is_foot: bool,
}

impl<P> Approach<P> {
    /// From a start.
    pub fn new(at: P) -> Self {
        Self { at, step: None, taken: 0, is_foot: false }
    }
}

/// Where an iteration has ended.
pub struct Landing<P, J> {
    /// The foot.
    pub at: P,
    /// The last place that was looked at, which is `at` or where the last step began, and the jet there.
    pub seen: P,
    /// See `seen`.
    pub jet: J,
    /// Jets taken.
    pub taken: u32,
}

/// Whether a step of second order (as a share of the box) is the last one, after a whole one of second order: with errors
/// that go like squares the next is `size^3 / before^2`.
fn is_last(size: f64, before: Option<f64>) -> bool {
    let next = |before: f64| size * size * size <= ROUNDING * before * before;
    size <= LAST_STEP || size <= MOST_LAST && before.is_some_and(next)
}

impl Method {
    fn steps(self) -> u32 {
        if self == Self::Maf { STEPS_FIRST_ORDER } else { STEPS }
    }
}

/// Arc length, over the length of the fall on the tangent, to the foot on an osculating circle of signed
/// curvature `k`, for a fall of length `along` and a height `height` over the tangent (towards the centre: > 0).
///
/// The arc is taken as twice the tangent of half its angle: right to third order, and free of trigonometric
/// functions, whose last bits differ between systems. Never longer than half the circle.
fn arc_ratio(along: f64, height: f64, k: f64) -> f64 {
    let (x, y) = (along * k, 1.0 - height * k);
    let sum = y + (x * x + y * y).sqrt();
    if sum == 0.0 {
        // In the centre of the circle, and nothing to fall.
        return 1.0;
    }
    let ratio = 2.0 / sum;
    if ratio * x.abs() <= std::f64::consts::PI { ratio } else { std::f64::consts::PI / x.abs() }
}
