//! Weights from shape wishes: how near a rational shape should come to its poles.
//!
//! When only the weight `w` of pole `P` changes, the point at a fixed parameter runs on a line through `P`. `B` is its place for
//! weight 0, and the weight is a cross ratio of four points of that line:
//!
//! ```text
//!    B ------------ N -------- P        N is the point for weight w, I the one for weight 1
//!    |<----- L ---------------->|       w = (PI / IB) : (PN / NB)
//!                   |<-- l --->|        with PI = IB:  w = 1/lambda - 1,  lambda = l / L     (3)
//! ```
//!
//! Formula (3) with the foot of the pole on a chord for `B` is the published first guess: [`published`] gives it for ratios or an even
//! run of distances, [`network`] trains weights for some wished distances and a range for the others. [`refine`] goes on to weights
//! whose shape really has the wished distances, measured and bounded by this library's own nearest points. [`edit`] changes weights
//! one by one, [`conic`] knows the shape factors of conics, [`form`] changes weights without or beyond the shape, [`positive`]
//! makes a curve of homogeneous data with weights that are not positive.
//!
//! References: Wang, Li, *Automatic definition of initial weights of NURBS*, Acta Aeronautica et Astronautica Sinica 22(2), 2001
//! (two signs in its formulas are misprints: (1) lacks the division, section 1.3 has `+ 1` for the `- 1` of (3)); Piegl, *Modifying
//! the shape of rational B-splines*, Computer-Aided Design 21(8), 1989.
//! Limits: distances are those to the whole shape, so a wish may be met by a far branch that passes the pole. Weights whose wishes
//! exist may be missed; what is reported as met is proven, and as impossible too.

use crate::bounds::Vector;
use crate::error::Error;

mod linear;
mod net;
mod chord;
mod rows;
mod reach;
mod solve;
mod report;
mod start;

pub mod published;
pub mod network;
pub mod refine;
pub mod edit;
pub mod conic;
pub mod form;
pub mod positive;

pub use net::Net;
pub use report::{ConstraintReport, PoleReport, Report, State, flag};

/// The distance that the shape should have from one of its poles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wish {
    /// Number of the pole; of a surface `i * pole_count_v + j`.
    pub pole: usize,
    /// Length, finite, at least 0.
    pub distance: f64,
}

/// What the shape must do besides.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Constraint {
    /// Pass through a point at a parameter; of a curve the second one does not count.
    PointAt([f64; 2], Vector),
    /// Pass through a point anywhere.
    Point(Vector),
    /// Have a direction at a parameter; curves only.
    TangentAt(f64, Vector),
    /// Keep the direction that the given curve has at a parameter; curves only.
    TangentKept(f64),
}

/// What every method asks. The default is what most callers want.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Options {
    /// Least weight; 0: [`LEAST_WEIGHT`].
    pub weight_min: f64,
    /// Greatest weight; 0: [`GREATEST_WEIGHT`].
    pub weight_max: f64,
    /// Greatest weight over least weight; 0: no limit but that of the two above.
    pub ratio_limit: f64,
    /// How far a distance may be from its wish; 0: 1e-9 of the diagonal of the poles' box.
    pub tolerance: f64,
    /// Weights of opposite poles are kept equal: of a surface in both directions.
    pub symmetric: bool,
    /// Seed of the random numbers.
    pub seed: u64,
    /// Most training steps of a network; 0: [`network::DEFAULT_STEPS`].
    pub steps: u32,
    /// Most starts of a refinement; 0: [`refine::DEFAULT_STARTS`].
    pub starts: u32,
}

/// Default of the least weight.
pub const LEAST_WEIGHT: f64 = 1e-2;

/// Default of the greatest weight.
pub const GREATEST_WEIGHT: f64 = 1e2;

/// Least and greatest weight that a caller may ask for; their powers must stay far inside the doubles.
pub const WEIGHT_LIMITS: [f64; 2] = [1e-12, 1e12];

/// Default tolerance, relative to the diagonal of the poles' box.
pub const TOLERANCE: f64 = 1e-9;

/// Poles nearer to one another than this, relative to the diagonal, coincide; so does a pole with its chord.
pub const COINCIDENT: f64 = 1e-12;

impl Options {
    /// The range of the weights. A limited ratio narrows it around 1 (weights may be multiplied by anything, so that no shape is
    /// lost), or from its nearer end when 1 is not inside.
    ///
    /// # Errors
    /// A number that is not allowed, by name.
    pub fn range(&self) -> Result<[f64; 2], Error> {
        let [least, greatest] = WEIGHT_LIMITS;
        let given = |name: &str, value: f64, default: f64| {
            if value == 0.0 {
                return Ok(default);
            }
            if (least..=greatest).contains(&value) {
                return Ok(value);
            }
            invalid(format!("{name}: {value} is not within {least:e} .. {greatest:e}"))
        };
        let low = given("weight_min", self.weight_min, LEAST_WEIGHT)?;
        let high = given("weight_max", self.weight_max, GREATEST_WEIGHT)?;
        if low > high {
            return invalid(format!("weight_min: {low} is more than weight_max {high}"));
        }
        let limit = self.ratio_limit;
        if limit == 0.0 || high <= low * limit {
            return Ok([low, high]);
        }
        if limit.is_nan() || limit < 1.0 {
            return invalid(format!("ratio_limit: {limit} is less than 1"));
        }
        // One ulp for the rounding of the quotient that a caller forms.
        let limit = (limit * (1.0 - 4.0 * f64::EPSILON)).max(1.0);
        let first = (1.0 / limit.sqrt()).clamp(low, high / limit);
        Ok([first, (first * limit).min(high)])
    }

    fn tolerance(&self, diagonal: f64) -> Result<f64, Error> {
        if !self.tolerance.is_finite() || self.tolerance < 0.0 {
            let text =
                format!("tolerance: {} is not a finite length of at least 0", self.tolerance);
            return invalid(text);
        }
        Ok(if self.tolerance > 0.0 { self.tolerance } else { TOLERANCE * diagonal })
    }
}

fn invalid<T>(text: String) -> Result<T, Error> {
    Err(Error::InvalidArgument(text))
}

fn check_distance(name: &str, distance: f64) -> Result<(), Error> {
    if distance.is_finite() && distance >= 0.0 {
        return Ok(());
    }
    invalid(format!("{name}: {distance} is not a finite distance of at least 0"))
}

/// The wished distance of each pole, or none.
fn wished(net: &Net, wishes: &[Wish]) -> Result<Vec<Option<f64>>, Error> {
    let count = net.poles().len();
    let mut found = Vec::new();
    found.try_reserve_exact(count).map_err(|_| Error::OutOfMemory)?;
    found.resize(count, None);
    for (i, wish) in wishes.iter().enumerate() {
        if wish.pole >= count {
            return invalid(format!("wish_poles: wish {i} names pole {} of {count}", wish.pole));
        }
        check_distance(&format!("wish_distances: wish {i}"), wish.distance)?;
        if found[wish.pole].replace(wish.distance).is_some() {
            return invalid(format!("wish_poles: wish {i} names pole {} again", wish.pole));
        }
        check_apart(net, wish.pole)?;
    }
    Ok(found)
}

/// Refuses a pole that coincides with a neighbour: only the sum of their weights counts, nearly.
fn check_apart(net: &Net, pole: usize) -> Result<(), Error> {
    match net.coincident(pole) {
        Some(other) => {
            let (a, b) = (net.name(pole), net.name(other));
            invalid(format!(
                "poles: pole {a} coincides with pole {b}, a wish cannot tell them apart"
            ))
        }
        None => Ok(()),
    }
}
