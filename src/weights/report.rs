//! What came of the wishes: weights, measured distances, and who is right about them.

use super::Constraint;
use super::net::{Fitted, Net};
use super::rows::Target;
use crate::bounds::{Vector, cross, dot, norm, sub};
use crate::closest::{FootPoint, Workspace};
use crate::curve::Curve;
use crate::error::Error;
use crate::surface::Surface;

/// What came of a wish.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum State {
    /// There was none.
    None = 0,
    /// Proven: the distance is the wished one within the tolerance.
    Met = 1,
    /// It is not met, or that could not be proven.
    NotMet = 2,
    /// Proven: no weights in the range meet it, or not together with another wish, from which it differs by more than their poles are
    /// apart.
    Impossible = 3,
}

/// Bits of [`PoleReport::flags`].
pub mod flag {
    /// The pole lies on its chord: formula (3) says nothing, its weight is 1.
    pub const ON_CHORD: u32 = 1;
    /// Formula (3) gave a weight outside the range (or none, for a distance beyond the chord's): the nearest end was taken.
    pub const LIMITED: u32 = 2;
    /// The weight is an end of the range.
    pub const AT_LIMIT: u32 = 4;
    /// The training of a network ended before this pole was as wished; the nearest weight that is was taken.
    pub const UNTRAINED: u32 = 8;
}

/// One pole's part of a report. Frozen (C API).
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PoleReport {
    /// The distance asked for; NaN: none.
    pub wish: f64,
    /// `L` of formula (3): the distance of the pole from its chord.
    pub chord_distance: f64,
    /// The weight of formula (3); 1 without a wish.
    pub first_guess: f64,
    /// The weight found.
    pub weight: f64,
    /// Distance of the pole from the shape with the weights found.
    pub distance: f64,
    /// Nothing on that shape is nearer to the pole than this.
    pub lower_bound: f64,
    /// First parameter of the nearest point.
    pub u: f64,
    /// Second parameter; 0 for curves.
    pub v: f64,
    /// A [`State`].
    pub state: u32,
    /// Bits of [`flag`].
    pub flags: u32,
}

/// What came of a constraint. Frozen (C API).
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ConstraintReport {
    /// Distance from the point (its nearest point for [`Constraint::Point`]), or the sine of the angle to the direction, 2 when the
    /// tangent has the opposite direction.
    pub error: f64,
    /// Parameters of the place.
    pub u: f64,
    /// Second parameter; 0 for curves.
    pub v: f64,
    /// 1: within the tolerance (sines: within 1e-9).
    pub met: u32,
    /// 0.
    pub reserved: u32,
}

/// Sine of an angle up to which two directions are one.
const SINE: f64 = 1e-9;

/// What a method found.
#[derive(Clone, Debug)]
pub struct Report {
    /// One for each pole.
    pub poles: Vec<PoleReport>,
    /// One for each constraint.
    pub constraints: Vec<ConstraintReport>,
    /// Training steps, or shapes that were measured.
    pub iterations: u64,
    /// Searches that were begun; 0 for a formula.
    pub starts: u32,
    /// The length within which wishes are met.
    pub tolerance: f64,
    shape: Owned,
}

/// The net with the weights found.
#[derive(Clone, Debug)]
enum Owned {
    Curve(Curve),
    Surface(Surface),
}

impl Report {
    /// Measures the shape with these weights.
    pub(super) fn measured(
        net: &Net,
        weights: &[f64],
        mut poles: Vec<PoleReport>,
        tolerance: f64,
        range: [f64; 2],
    ) -> Result<Self, Error> {
        let shape = net.with(weights)?;
        let mut workspace = Workspace::default();
        for (k, pole) in poles.iter_mut().enumerate() {
            let foot = shape.closest(net.poles()[k], tolerance / 16.0, &mut workspace);
            pole.settle(weights[k], &foot, tolerance, range);
        }
        let shape = match net {
            Net::Curve(_) => Owned::Curve(net.curve_with(weights)?),
            Net::Surface(_) => Owned::Surface(net.surface_with(weights)?),
        };
        Ok(Self { poles, constraints: Vec::new(), iterations: 0, starts: 0, tolerance, shape })
    }

    /// The weights found.
    pub fn weights(&self) -> Vec<f64> {
        self.poles.iter().map(|pole| pole.weight).collect()
    }

    /// Whether every wish and every constraint is met.
    pub fn is_met(&self) -> bool {
        let missed = |pole: &PoleReport| pole.state >= State::NotMet as u32;
        !self.poles.iter().any(missed) && self.constraints.iter().all(|c| c.met == 1)
    }

    /// The curve with the weights found.
    ///
    /// # Errors
    /// [`Error::Unsupported`] when it is a surface.
    pub fn curve(&self) -> Result<&Curve, Error> {
        match &self.shape {
            Owned::Curve(curve) => Ok(curve),
            Owned::Surface(_) => Err(Error::Unsupported("report: is that of a surface".into())),
        }
    }

    /// The surface with the weights found.
    ///
    /// # Errors
    /// [`Error::Unsupported`] when it is a curve.
    pub fn surface(&self) -> Result<&Surface, Error> {
        match &self.shape {
            Owned::Surface(surface) => Ok(surface),
            Owned::Curve(_) => Err(Error::Unsupported("report: is that of a curve".into())),
        }
    }

    /// Looks at the constraints.
    pub(super) fn check(
        &mut self,
        net: &Net,
        targets: &[(Constraint, Target)],
    ) -> Result<(), Error> {
        let shape = net.with(&self.weights())?;
        let mut workspace = Workspace::default();
        for (_, target) in targets {
            self.constraints.push(examined(&shape, target, self.tolerance, &mut workspace));
        }
        Ok(())
    }
}

impl PoleReport {
    /// What is known before any weights are: wish, chord and formula (3).
    pub(super) fn guessed(wish: Option<f64>, length: f64, flags: u32, guess: f64) -> Self {
        let nan = f64::NAN;
        Self {
            wish: wish.unwrap_or(nan),
            chord_distance: length,
            first_guess: guess,
            weight: guess,
            distance: nan,
            lower_bound: 0.0,
            u: nan,
            v: nan,
            state: State::None as u32,
            flags,
        }
    }

    /// Fills in what was measured. A wish that was proven impossible stays so.
    fn settle(&mut self, weight: f64, foot: &FootPoint, tolerance: f64, [low, high]: [f64; 2]) {
        self.weight = weight;
        (self.distance, self.lower_bound) = (foot.distance, foot.lower_bound);
        (self.u, self.v) = (foot.u, foot.v);
        if weight <= low || weight >= high {
            self.flags |= flag::AT_LIMIT;
        }
        if self.wish.is_nan() || self.state == State::Impossible as u32 {
            return;
        }
        // The true distance lies between bound and distance: both must be as wished.
        let met =
            foot.distance <= self.wish + tolerance && foot.lower_bound >= self.wish - tolerance;
        self.state = if met { State::Met } else { State::NotMet } as u32;
    }
}

fn examined(
    shape: &Fitted,
    target: &Target,
    tolerance: f64,
    workspace: &mut Workspace,
) -> ConstraintReport {
    let report = |error: f64, at: [f64; 2], limit: f64| ConstraintReport {
        error,
        u: at[0],
        v: at[1],
        met: u32::from(error <= limit),
        reserved: 0,
    };
    match *target {
        Target::At(at, point) => report(norm(sub(shape.point(at), point)), at, tolerance),
        Target::Anywhere(point) => {
            let foot = shape.closest(point, tolerance / 16.0, workspace);
            report(foot.distance, [foot.u, foot.v], tolerance)
        }
        Target::Tangent(u, direction) => {
            let tangent = shape.tangents([u, 0.0])[0];
            report(sine(tangent, direction), [u, 0.0], SINE)
        }
    }
}

/// Sine of the angle between a vector and a unit vector, 2 when it is obtuse.
fn sine(vector: Vector, direction: Vector) -> f64 {
    if dot(vector, direction) <= 0.0 {
        return 2.0;
    }
    norm(cross(vector, direction)) / norm(vector)
}
