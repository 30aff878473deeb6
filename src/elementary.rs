//! Elementary surfaces by their geometric parameters: plane, cylinder, cone, sphere, torus, revolution, extrusion.
//!
//! ```text
//!   plane       O + u X + v Y
//!   cylinder    O + r d(u) + v Z                              d(u) = cos u X + sin u Y
//!   cone        O + (r + v sin a) d(u) + v cos a Z            v is the length along a generatrix
//!   sphere      O + r cos v d(u) + r sin v Z
//!   torus       O + (R + r cos v) d(u) + r sin v Z
//!   revolution  C(v) turned by u about the axis
//!   extrusion   C(u) + v D
//! ```
//!
//! Angles are in radians. These are the parametrisations of IGES, STEP and OpenCASCADE. Each surface has a rectangular domain; its
//! exact NURBS form is made by [`ElementarySurface::nurbs`], in which angles are replaced by the parameters of a [`CircleForm`].
//!
//! Multiples of a quarter turn give exact sines and cosines, and the end of a full turn gives the point of its start: seams are
//! closed and poles collapsed bit for bit.

mod circle;

pub(crate) mod angle;

mod net;

pub(crate) use net::part;

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use crate::bounds::{Vector, add, cross, dot, norm, scaled, sub};
use crate::curve::Curve;
use crate::error::Error;
use crate::knots::MAX_MAGNITUDE;
use crate::portable::SameDigits;
use crate::surface::COLLAPSED_TOLERANCE;

pub use angle::arc_by_angle;
pub use circle::{CircleForm, quadrant_exact};

/// How far axes may be from orthonormal. They are used as they are given.
pub const AXES_TOLERANCE: f64 = 1e-12;

/// Radii of cones and tori below this share of their size are 0: the rounding of a radius that vanishes.
const AXIS_TOLERANCE: f64 = 1e-13;

/// A sweep that differs from a full turn by no more than this many units in the last place of its ends is a full turn.
const TURN_ULPS: f64 = 8.0;

/// An origin and three orthonormal directions, right-handed or left-handed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axes {
    /// The origin.
    pub origin: Vector,
    /// Direction of the angle 0.
    pub x: Vector,
    /// Direction of the angle of a quarter turn.
    pub y: Vector,
    /// The axis.
    pub z: Vector,
}

impl Axes {
    /// The coordinate axes.
    pub const STANDARD: Self =
        Self { origin: [0.0; 3], x: [1.0, 0.0, 0.0], y: [0.0, 1.0, 0.0], z: [0.0, 0.0, 1.0] };

    /// Right-handed axes with a given axis of any length; x is the direction across it that is nearest to `towards`.
    ///
    /// # Errors
    /// Numbers that are not finite; an axis shorter than 1e-100; `towards` along the axis.
    pub fn around(origin: Vector, axis: Vector, towards: Vector) -> Result<Self, Error> {
        check_vector("axis", axis)?;
        check_vector("towards", towards)?;
        let z = unit("axis", axis)?;
        let flat = unit("towards", towards)?;
        let flat = sub(flat, scaled(z, dot(flat, z)));
        if norm(flat) < 1e-10 {
            return invalid("towards: has the direction of the axis".into());
        }
        // Twice, so that x is orthogonal to the last digit.
        let x = unit("towards", flat)?;
        let x = unit("towards", sub(x, scaled(z, dot(x, z))))?;
        Self { origin, x, y: cross(z, x), z }.checked()
    }

    /// The same axes, when they are orthonormal within [`AXES_TOLERANCE`].
    ///
    /// # Errors
    /// Numbers that are not finite; axes that are not orthonormal.
    pub fn checked(self) -> Result<Self, Error> {
        check_vector("origin", self.origin)?;
        let axes = [self.x, self.y, self.z];
        for (k, name) in ["x", "y", "z"].into_iter().enumerate() {
            check_vector(name, axes[k])?;
            if (norm(axes[k]) - 1.0).abs() > AXES_TOLERANCE {
                return invalid(format!("{name}: has the length {}, not 1", norm(axes[k])));
            }
            if dot(axes[k], axes[(k + 1) % 3]).abs() > AXES_TOLERANCE {
                let other = ["y", "z", "x"][k];
                return invalid(format!("{name}: is not orthogonal to {other}"));
            }
        }
        Ok(self)
    }

    /// `origin + x X + y Y + z Z`.
    fn point(&self, [x, y, z]: Vector) -> Vector {
        add(self.origin, self.vector([x, y, z]))
    }

    /// `x X + y Y + z Z`.
    fn vector(&self, [x, y, z]: Vector) -> Vector {
        std::array::from_fn(|k| x * self.x[k] + y * self.y[k] + z * self.z[k])
    }
}

/// The kinds of elementary surfaces, with their geometric parameters.
#[derive(Clone, Debug, PartialEq)]
pub enum Elementary {
    /// u along X, v along Y.
    Plane {
        /// Its place.
        axes: Axes,
    },
    /// u the angle, v the height.
    Cylinder {
        /// Its place.
        axes: Axes,
        /// Its radius, more than 0.
        radius: f64,
    },
    /// u the angle, v the length along a generatrix.
    Cone {
        /// Its place.
        axes: Axes,
        /// The radius at v = 0, at least 0.
        radius: f64,
        /// Angle between axis and generatrix, between -pi/2 and pi/2, not 0.
        half_angle: f64,
    },
    /// u the longitude, v the latitude.
    Sphere {
        /// Its place.
        axes: Axes,
        /// Its radius, more than 0.
        radius: f64,
    },
    /// u the angle about the axis, v that about the circle of centres.
    Torus {
        /// Its place.
        axes: Axes,
        /// Radius of the circle of centres, more than 0.
        major: f64,
        /// Radius of the tube, more than 0.
        minor: f64,
    },
    /// u the angle of rotation (right-handed about the axis), v the parameter of the meridian.
    Revolution {
        /// A point of the axis.
        origin: Vector,
        /// Direction of the axis, of length 1.
        axis: Vector,
        /// The curve at u = 0.
        meridian: Curve,
    },
    /// u the parameter of the curve, v the way along the direction.
    Extrusion {
        /// The curve at v = 0.
        curve: Curve,
        /// The way for v = 1; not 0.
        direction: Vector,
    },
}

/// An elementary surface on a rectangle of its parameters. Immutable.
#[derive(Clone, Debug, PartialEq)]
pub struct ElementarySurface {
    kind: Elementary,
    domain: [f64; 4],
    /// Whether u and v are angles over a full turn.
    turns: [bool; 2],
    closed: [bool; 2],
    collapsed: [bool; 4],
}

/// Values and derivatives of one coordinate along v.
const ORDERS: usize = crate::knots::MAX_DEGREE + 1;

impl ElementarySurface {
    /// A surface on `domain` (u0, u1, v0, v1).
    ///
    /// # Errors
    /// Numbers that are not finite or not in their range; a domain that is empty, more than a turn, beyond the curve, or in which
    /// the radius is negative; by name and index.
    pub fn new(kind: Elementary, domain: [f64; 4]) -> Result<Self, Error> {
        check_domain(domain)?;
        kind.check(domain)?;
        let angular = kind.angular();
        let mut turns = [false; 2];
        for k in 0..2 {
            let [a, b] = [domain[2 * k], domain[2 * k + 1]];
            let slack = TURN_ULPS * f64::EPSILON * TAU.max(a.abs()).max(b.abs());
            if angular[k] && b - a > TAU + slack {
                let name = ["u", "v"][k];
                return invalid(format!("domain: {name} spans more than a full turn"));
            }
            turns[k] = angular[k] && b - a >= TAU - slack;
        }
        let mut surface = Self { kind, domain, turns, closed: turns, collapsed: [false; 4] };
        surface.check_radius()?;
        surface.find_borders();
        Ok(surface)
    }

    /// The kind with its geometric parameters.
    pub fn kind(&self) -> &Elementary {
        &self.kind
    }

    /// First and last u, first and last v.
    pub fn domain(&self) -> [f64; 4] {
        self.domain
    }

    /// Which parameters are angles.
    pub fn angular(&self) -> [bool; 2] {
        self.kind.angular()
    }

    /// Whether u and v are angles over a full turn.
    pub fn full_turns(&self) -> [bool; 2] {
        self.turns
    }

    /// Whether the borders u0 and u1, v0 and v1 are the same curve.
    pub fn closed(&self) -> [bool; 2] {
        self.closed
    }

    /// Which of the edges u0, u1, v0, v1 is a single point.
    pub fn collapsed_edges(&self) -> [bool; 4] {
        self.collapsed
    }

    /// The point at (u, v). Parameters outside the domain are continued as the formula says, for curves they are moved into
    /// their domain.
    pub fn evaluate(&self, u: f64, v: f64) -> Vector {
        let mut out = [[0.0; 3]];
        self.partials(u, v, 0, &mut out);
        out[0]
    }

    /// The partial derivatives at (u, v) to the total order `count` into `out`: S; Su, Sv; Suu, Suv, Svv; ..., as
    /// [`crate::surface::Surface::partials`] orders them; `count` is at most 31.
    pub fn partials(&self, u: f64, v: f64, count: usize, out: &mut [Vector]) {
        let place = |k: usize, l: usize| (k + l) * (k + l + 1) / 2 + l;
        let mut set = |value: &dyn Fn(usize, usize) -> Vector| {
            for order in 0..=count {
                for l in 0..=order {
                    out[place(order - l, l)] = value(order - l, l);
                }
            }
        };
        match &self.kind {
            Elementary::Plane { axes } => set(&|k, l| match (k, l) {
                (0, 0) => axes.point([u, v, 0.0]),
                (1, 0) => axes.x,
                (0, 1) => axes.y,
                _ => [0.0; 3],
            }),
            Elementary::Revolution { origin, axis, meridian } => {
                let [c, s] = self.turn(u);
                let mut rows = [[0.0; 3]; ORDERS];
                meridian.derivatives(within(v, meridian.domain()), count, &mut rows);
                rows[0] = sub(rows[0], *origin);
                set(&|k, l| {
                    let [along, flat, aside] = split_about(*axis, rows[l]);
                    let [c, s] = derived([c, s], k);
                    let turned = add(scaled(flat, c), scaled(aside, s));
                    let along = if k == 0 { along } else { [0.0; 3] };
                    let vector = add(along, turned);
                    if (k, l) == (0, 0) { add(vector, *origin) } else { vector }
                });
            }
            Elementary::Extrusion { curve, direction } => {
                let mut row = [[0.0; 3]; ORDERS];
                curve.derivatives(self.wrapped_end(0, within(u, curve.domain())), count, &mut row);
                set(&|k, l| match (k, l) {
                    (k, 0) if k > 0 => row[k],
                    (0, 0) => add(row[0], scaled(*direction, v)),
                    (0, 1) => *direction,
                    _ => [0.0; 3],
                });
            }
            Elementary::Cylinder { axes, .. }
            | Elementary::Cone { axes, .. }
            | Elementary::Sphere { axes, .. }
            | Elementary::Torus { axes, .. } => {
                let turn = self.turn(u);
                set(&|k, l| {
                    let [radius, height] = self.profile(v, l);
                    let [c, s] = derived(turn, k);
                    let height = if k == 0 { height } else { 0.0 };
                    let local = [radius * c, radius * s, height];
                    if (k, l) == (0, 0) { axes.point(local) } else { axes.vector(local) }
                });
            }
        }
    }

    /// Radius and height along v, their derivative of order `l`.
    fn profile(&self, v: f64, l: usize) -> [f64; 2] {
        let linear = |value: [f64; 2], slope: [f64; 2]| match l {
            0 => value,
            1 => slope,
            _ => [0.0; 2],
        };
        match self.kind {
            Elementary::Cylinder { radius, .. } => linear([radius, v], [0.0, 1.0]),
            Elementary::Cone { radius, half_angle, .. } => {
                let (s, c) = half_angle.sine_cosine();
                let at = if self.is_on_axis(v) { 0.0 } else { radius + v * s };
                linear([at, v * c], [s, c])
            }
            Elementary::Sphere { radius, .. } => {
                let [c, s] = derived(self.turn_v(v), l);
                [radius * c, radius * s]
            }
            Elementary::Torus { major, minor, .. } => {
                let [c, s] = derived(self.turn_v(v), l);
                let out = if l == 0 { major } else { 0.0 };
                let radius = out + minor * c;
                [if l == 0 && self.is_on_axis(v) { 0.0 } else { radius }, minor * s]
            }
            _ => unreachable!("only surfaces of revolution in closed form have a profile"),
        }
    }

    /// Whether `v` is an end of the domain whose edge is collapsed.
    fn is_on_axis(&self, v: f64) -> bool {
        (self.collapsed[2] && v == self.domain[2]) || (self.collapsed[3] && v == self.domain[3])
    }

    /// The end of a closed direction is its start.
    fn wrapped_end(&self, k: usize, x: f64) -> f64 {
        let [first, last] = [self.domain[2 * k], self.domain[2 * k + 1]];
        if self.closed[k] && x == last { first } else { x }
    }

    fn turn(&self, u: f64) -> [f64; 2] {
        quadrant_exact(self.wrapped_end(0, u))
    }

    fn turn_v(&self, v: f64) -> [f64; 2] {
        quadrant_exact(self.wrapped_end(1, v))
    }

    /// A length of the size of the surface, for tolerances.
    fn size(&self) -> f64 {
        let [u0, u1, v0, v1] = self.domain;
        let low = self.evaluate(u0, v0);
        let mut size: f64 = 0.0;
        for i in 0..5 {
            for j in 0..5 {
                let share = |k: usize, a: f64, b: f64| a + (b - a) * k as f64 / 4.0;
                let at = self.evaluate(share(i, u0, u1), share(j, v0, v1));
                size = size.max(norm(sub(at, low)));
            }
        }
        size
    }

    /// The radius must not be negative inside the domain.
    fn check_radius(&self) -> Result<(), Error> {
        let [_, _, v0, v1] = self.domain;
        let bad = match self.kind {
            Elementary::Cone { radius, half_angle, .. } => {
                let slack = AXIS_TOLERANCE * radius.max((v1 - v0).abs() * half_angle.sine().abs());
                [v0, v1].iter().any(|v| radius + v * half_angle.sine() < -slack)
            }
            Elementary::Sphere { .. } => {
                let slack = 4.0 * f64::EPSILON;
                v0 < -FRAC_PI_2 - slack || v1 > FRAC_PI_2 + slack
            }
            Elementary::Torus { major, minor, .. } => {
                // The radius is least at odd multiples of half a turn, if there is one inside.
                let inner = ((v0 / PI + 1.0) / 2.0).floor() * 2.0 + 1.0;
                let crosses = v0 < inner * PI && inner * PI < v1;
                let least = if crosses { -1.0 } else { v0.cosine().min(v1.cosine()) };
                let radius = major + minor * least;
                radius < -AXIS_TOLERANCE * (major + minor) || (crosses && radius <= 0.0)
            }
            _ => false,
        };
        if bad {
            return invalid("domain: the radius is negative or 0 inside v".into());
        }
        Ok(())
    }

    /// Closed directions of curves, and collapsed edges.
    fn find_borders(&mut self) {
        match &self.kind {
            Elementary::Extrusion { curve, .. } => {
                let (a, b) = curve.domain();
                self.closed[0] = self.domain[..2] == [a, b] && curve.is_closed();
            }
            Elementary::Revolution { meridian, .. } => {
                let (a, b) = meridian.domain();
                self.closed[1] = self.domain[2..] == [a, b] && meridian.is_closed();
            }
            _ => {}
        }
        let size = self.size();
        for k in 0..2 {
            let v = self.domain[2 + k];
            self.collapsed[2 + k] = match &self.kind {
                Elementary::Plane { .. }
                | Elementary::Cylinder { .. }
                | Elementary::Extrusion { .. } => false,
                Elementary::Cone { radius, half_angle, .. } => {
                    (radius + v * half_angle.sine()).abs() <= AXIS_TOLERANCE * size
                }
                Elementary::Sphere { .. } => (v.abs() - FRAC_PI_2).abs() <= 4.0 * f64::EPSILON,
                Elementary::Torus { .. } => self.profile(v, 0)[0].abs() <= AXIS_TOLERANCE * size,
                Elementary::Revolution { origin, axis, meridian } => {
                    let at = sub(meridian.evaluate(within(v, meridian.domain())), *origin);
                    norm(split_about(*axis, at)[1]) <= COLLAPSED_TOLERANCE * size
                }
            };
        }
    }
}

impl Elementary {
    /// Which parameters are angles.
    pub fn angular(&self) -> [bool; 2] {
        match self {
            Self::Plane { .. } | Self::Extrusion { .. } => [false, false],
            Self::Cylinder { .. } | Self::Cone { .. } | Self::Revolution { .. } => [true, false],
            Self::Sphere { .. } | Self::Torus { .. } => [true, true],
        }
    }

    /// The domain that belongs to the shape where it is bounded by itself; infinite ends where it is not.
    pub fn natural_domain(&self) -> [f64; 4] {
        let all = [f64::NEG_INFINITY, f64::INFINITY];
        match self {
            Self::Plane { .. } => [all[0], all[1], all[0], all[1]],
            Self::Cylinder { .. } => [0.0, TAU, all[0], all[1]],
            Self::Cone { radius, half_angle, .. } => {
                let apex = -radius / half_angle.sine();
                if *half_angle > 0.0 { [0.0, TAU, apex, all[1]] } else { [0.0, TAU, all[0], apex] }
            }
            Self::Sphere { .. } => [0.0, TAU, -FRAC_PI_2, FRAC_PI_2],
            Self::Torus { .. } => [0.0, TAU, 0.0, TAU],
            Self::Revolution { meridian, .. } => {
                let (a, b) = meridian.domain();
                [0.0, TAU, a, b]
            }
            Self::Extrusion { curve, .. } => {
                let (a, b) = curve.domain();
                [a, b, all[0], all[1]]
            }
        }
    }

    fn check(&self, domain: [f64; 4]) -> Result<(), Error> {
        let positive = |name: &str, x: f64| match x {
            x if !x.is_finite() => invalid(format!("{name}: is not finite")),
            x if x <= 0.0 => invalid(format!("{name}: {x} is not positive")),
            x if x > MAX_MAGNITUDE => invalid(format!("{name}: is beyond 1e100")),
            _ => Ok(()),
        };
        let on_curve = |name: &str, range: &[f64], (a, b): (f64, f64)| {
            if range[0] < a || range[1] > b {
                return invalid(format!("domain: {name} leaves the curve's domain [{a}, {b}]"));
            }
            Ok(())
        };
        match self {
            Self::Plane { axes } => axes.checked().map(drop),
            Self::Cylinder { axes, radius } | Self::Sphere { axes, radius } => {
                axes.checked()?;
                positive("radius", *radius)
            }
            Self::Cone { axes, radius, half_angle } => {
                axes.checked()?;
                if !radius.is_finite() || *radius < 0.0 || *radius > MAX_MAGNITUDE {
                    return invalid(format!("radius: {radius} is not in 0 .. 1e100"));
                }
                let slope = half_angle.abs();
                if !(1e-12..=FRAC_PI_2 - 1e-12).contains(&slope) {
                    return invalid(format!(
                        "half_angle: {half_angle} is 0, or not between -pi/2 and pi/2"
                    ));
                }
                Ok(())
            }
            Self::Torus { axes, major, minor } => {
                axes.checked()?;
                positive("major", *major)?;
                positive("minor", *minor)
            }
            Self::Revolution { origin, axis, meridian } => {
                check_vector("origin", *origin)?;
                check_vector("axis", *axis)?;
                if (norm(*axis) - 1.0).abs() > AXES_TOLERANCE {
                    return invalid(format!("axis: has the length {}, not 1", norm(*axis)));
                }
                on_curve("v", &domain[2..], meridian.domain())
            }
            Self::Extrusion { curve, direction } => {
                check_vector("direction", *direction)?;
                if norm(*direction) < 1e-100 {
                    return invalid("direction: shorter than 1e-100".into());
                }
                on_curve("u", &domain[..2], curve.domain())
            }
        }
    }
}

/// The derivative of order `k` of a cosine and a sine.
fn derived([c, s]: [f64; 2], k: usize) -> [f64; 2] {
    match k % 4 {
        0 => [c, s],
        1 => [-s, c],
        2 => [-c, -s],
        _ => [s, -c],
    }
}

/// A vector's part along an axis, across it, and the latter turned by a quarter.
fn split_about(axis: Vector, v: Vector) -> [Vector; 3] {
    let along = scaled(axis, dot(v, axis));
    let flat = sub(v, along);
    [along, flat, cross(axis, flat)]
}

fn within(x: f64, (a, b): (f64, f64)) -> f64 {
    x.max(a).min(b)
}

fn unit(name: &str, v: Vector) -> Result<Vector, Error> {
    let length = norm(v);
    if length < 1e-100 {
        return invalid(format!("{name}: shorter than 1e-100"));
    }
    // Twice, so that a rounded length leaves no trace.
    let once = scaled(v, 1.0 / length);
    Ok(scaled(once, 1.0 / norm(once)))
}

fn check_vector(name: &str, v: Vector) -> Result<(), Error> {
    match v.iter().position(|x| !x.is_finite() || x.abs() > MAX_MAGNITUDE) {
        Some(k) => invalid(format!("{name}: entry {k} is not finite or beyond 1e100")),
        None => Ok(()),
    }
}

fn check_domain(domain: [f64; 4]) -> Result<(), Error> {
    if let Some(k) = domain.iter().position(|x| !x.is_finite() || x.abs() > MAX_MAGNITUDE) {
        return invalid(format!("domain: entry {k} is not finite or beyond 1e100"));
    }
    for k in [0, 2] {
        if domain[k] >= domain[k + 1] {
            return invalid(format!("domain: entry {k} is not less than entry {}", k + 1));
        }
    }
    Ok(())
}

fn invalid<T>(text: String) -> Result<T, Error> {
    Err(Error::InvalidArgument(text))
}

#[cfg(test)]
mod tests;
