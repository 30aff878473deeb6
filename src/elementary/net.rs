//! The exact NURBS form of an elementary surface.
//!
//! Where v is no angle its parameter stays what it is; angles become the parameter 0 to 1 of a [`CircleForm`]. A surface of
//! revolution is the product of its circle and its profile: `(c, s; w) x (a, b; x)` gives the pole `O + a (c X + s Y) + b Z` of
//! weight `w x`.
//!
//! [`ElementarySurface::chart`] is the same with cosine and sine as polynomials of the angle: parameters stay what they are, points
//! are those of the surface to a few roundings.

use super::angle;
use super::circle::{CircleForm, Net};
use super::{Elementary, ElementarySurface, split_about};
use crate::bounds::{Vector, add, scaled, sub};
use crate::curve::Curve;
use crate::error::Error;
use crate::surface::Surface;

/// Poles along one direction: a place and a weight.
struct Row<T> {
    poles: Vec<(T, f64)>,
    knots: Vec<f64>,
    degree: usize,
}

impl Row<[f64; 2]> {
    /// The arc of a circle.
    fn arc(net: Net) -> Self {
        let poles = net.poles.iter().map(|&[c, s, w]| ([c, s], w)).collect();
        Self { poles, knots: net.knots, degree: 2 }
    }

    /// The arc with the angle as parameter.
    fn angle(range: [f64; 2]) -> Self {
        let (places, knots) = angle::spline(range);
        let poles = places.into_iter().map(|place| (place, 1.0)).collect();
        Self { poles, knots, degree: angle::DEGREE }
    }

    /// A line between two places.
    fn line(places: [[f64; 2]; 2], [a, b]: [f64; 2]) -> Self {
        Self { poles: places.map(|p| (p, 1.0)).into(), knots: vec![a, a, b, b], degree: 1 }
    }
}

impl Row<Vector> {
    /// The part of a curve over an interval of its domain.
    fn curve(curve: &Curve, range: [f64; 2]) -> Result<Self, Error> {
        let part = part(curve, range)?;
        let weight = |i: usize| part.weights().map_or(1.0, |w| w[i]);
        let poles = part.poles().iter().enumerate().map(|(i, &p)| (p, weight(i))).collect();
        Ok(Self { poles, knots: part.knots().values().into(), degree: part.degree() })
    }
}

/// The part of a curve between two parameters of its domain.
pub(crate) fn part(curve: &Curve, [a, b]: [f64; 2]) -> Result<Curve, Error> {
    let mut part = curve.clone();
    if b < part.domain().1 {
        part = part.split(b)?.0;
    }
    if a > part.domain().0 {
        part = part.split(a)?.1;
    }
    Ok(part)
}

/// The tensor product of two rows.
fn product<S: Copy, T: Copy>(
    across: &Row<S>,
    along: &Row<T>,
    point: impl Fn(S, T) -> Vector,
) -> Result<Surface, Error> {
    let (mut poles, mut weights) = (Vec::new(), Vec::new());
    for &(s, w) in &across.poles {
        for &(t, x) in &along.poles {
            poles.push(point(s, t));
            weights.push(w * x);
        }
    }
    let rational = weights.iter().any(|w| *w != weights[0]);
    Surface::new(
        &across.knots,
        &along.knots,
        across.degree,
        along.degree,
        &poles,
        across.poles.len(),
        along.poles.len(),
        rational.then_some(&weights[..]),
    )
}

impl ElementarySurface {
    /// The forms of arcs of at most a quarter turn, for both directions.
    pub fn usual_forms(&self) -> [CircleForm; 2] {
        let [u0, u1, v0, v1] = self.domain;
        [CircleForm::quarters(u1 - u0), CircleForm::quarters(v1 - v0)]
    }

    /// The exact NURBS form. Directions that are angles run from 0 to 1 in the circle form given for them; the others keep their
    /// parameter and ignore the form.
    ///
    /// # Errors
    /// A form that cannot make the sweep; memory that could not be had.
    pub fn nurbs(&self, forms: [CircleForm; 2]) -> Result<Surface, Error> {
        let circle = |k: usize| {
            let [a, b] = [self.domain[2 * k], self.domain[2 * k + 1]];
            forms[k].net(a, b).map(Row::arc)
        };
        self.assembled(&circle)
    }

    /// A spline surface in the parameters of this one, and how far it may be from it at equal parameters: some roundings of its largest
    /// coordinate.
    ///
    /// # Errors
    /// Memory that could not be had.
    pub fn chart(&self) -> Result<(Surface, f64), Error> {
        let range = |k: usize| [self.domain[2 * k], self.domain[2 * k + 1]];
        let made = self.assembled(&|k| Ok(Row::angle(range(k))))?;
        let (low, high) = made.bounding_box();
        let largest = low.iter().chain(&high).fold(0.0, |most: f64, x| most.max(x.abs()));
        let share = [0, 1].map(|k| if self.angular()[k] { angle::error(range(k)) } else { 0.0 });
        // The points of both are rounded as well.
        Ok((made, (2.0 * (share[0] + share[1]) + 32.0 * f64::EPSILON) * largest))
    }

    /// The product of the arcs `arc(0)` along u and `arc(1)` along v where they are angles, of lines and curves where they are not.
    fn assembled(
        &self,
        arc: &dyn Fn(usize) -> Result<Row<[f64; 2]>, Error>,
    ) -> Result<Surface, Error> {
        let [u0, u1, v0, v1] = self.domain;
        match &self.kind {
            Elementary::Plane { axes } => {
                let side = |a: f64, b: f64| Row::line([[a, 0.0], [b, 0.0]], [a, b]);
                product(&side(u0, u1), &side(v0, v1), |[x, _], [y, _]| axes.point([x, y, 0.0]))
            }
            Elementary::Revolution { origin, axis, meridian } => {
                let profile = Row::curve(meridian, [v0, v1])?;
                product(&arc(0)?, &profile, |[c, s], pole| {
                    let [along, flat, aside] = split_about(*axis, sub(pole, *origin));
                    add(*origin, add(along, add(scaled(flat, c), scaled(aside, s))))
                })
            }
            Elementary::Extrusion { curve, direction } => {
                let base = Row::curve(curve, [u0, u1])?;
                let way = Row::line([[v0, 0.0], [v1, 0.0]], [v0, v1]);
                product(&base, &way, |pole, [v, _]| add(pole, scaled(*direction, v)))
            }
            Elementary::Cylinder { axes, .. }
            | Elementary::Cone { axes, .. }
            | Elementary::Sphere { axes, .. }
            | Elementary::Torus { axes, .. } => {
                let profile = self.profile_row(arc)?;
                product(&arc(0)?, &profile, |[c, s], [radius, height]| {
                    axes.point([radius * c, radius * s, height])
                })
            }
        }
    }

    /// Radius and height along v.
    fn profile_row(
        &self,
        arc: &dyn Fn(usize) -> Result<Row<[f64; 2]>, Error>,
    ) -> Result<Row<[f64; 2]>, Error> {
        let [_, _, v0, v1] = self.domain;
        let (out, radius) = match self.kind {
            Elementary::Sphere { radius, .. } => (0.0, radius),
            Elementary::Torus { major, minor, .. } => (major, minor),
            _ => {
                return Ok(Row::line([self.profile(v0, 0), self.profile(v1, 0)], [v0, v1]));
            }
        };
        let mut row = arc(1)?;
        for (place, _) in &mut row.poles {
            *place = [out + radius * place[0], radius * place[1]];
        }
        let last = row.poles.len() - 1;
        for (k, at) in [(0, v0), (last, v1)] {
            if self.is_on_axis(at) {
                row.poles[k].0[0] = 0.0;
            }
        }
        Ok(row)
    }
}
