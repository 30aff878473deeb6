//! The cone of a collapsed edge: the tangents that leave its point, one for each parameter along the edge.
//!
//! ```text
//!        v1: one point            T(u) = tangent of the isocurve u, away from the point
//!         /|\                     sector of T(u), T(u + du): normal T x dT, angle |dT|
//!     T  / | \  T
//! ```
//!
//! When all normals agree the tip is smooth (the pole of a sphere). When they do not (a cone) their mean, weighted by the
//! angles, is the axis. A tip without any angle (a thorn) faces the way its cross sections turn.

use super::fan::{Fan, angle, unit};
use super::limit::Corner;
use crate::bounds::{Vector, add, cross, norm, sub};
use crate::knots::{Knots, Side};
use crate::surface::Surface;

/// Tangents per span.
const SAMPLES: usize = 16;

/// Sectors narrower than this have no normal of their own.
const LEAST_ANGLE: f64 = 1e-9;

/// A cone of less than this angle in all is a thorn.
const LEAST_CONE: f64 = 1e-6;

/// Where a thorn is cut, in spans from its tip.
const CUT: f64 = 1.0 / 1024.0;

/// The fan at a collapsed edge (u0, u1, v0, v1); `closed`: its ends meet.
pub fn cone(surface: &Surface, edge: usize, closed: bool) -> Fan {
    let tip = Tip::new(surface, edge);
    let mut fan = Fan::of_limits(!closed);
    let mut turned = 0.0;
    let mut before: Option<Vector> = None;
    tip.along(|at| {
        let Some(tangent) = tip.corner(at).tangent(edge / 2) else { return };
        if let Some(last) = before {
            let step = angle(last, tangent);
            turned += step;
            let normal = if tip.turns_left { cross(last, tangent) } else { cross(tangent, last) };
            if step > LEAST_ANGLE
                && let Some(normal) = unit(normal)
            {
                fan.add(normal, step);
            }
        }
        before = Some(tangent);
    });
    if turned < LEAST_CONE {
        fan = Fan::of_limits(!closed);
        fan.bent = true;
        if let Some(normal) = unit(tip.cut_area()) {
            fan.add(normal, 1.0);
        }
    }
    fan
}

/// A collapsed edge and the way along it.
struct Tip<'a> {
    surface: &'a Surface,
    edge: usize,
    fixed: (f64, Side),
    free: &'a Knots,
    /// Whether `T x dT` is on the side of `Su x Sv`.
    turns_left: bool,
}

impl<'a> Tip<'a> {
    fn new(surface: &'a Surface, edge: usize) -> Self {
        let side = if edge.is_multiple_of(2) { Side::Above } else { Side::Below };
        let knots = [surface.knots_v(), surface.knots_u()];
        Self {
            surface,
            edge,
            fixed: (surface.domain()[edge], side),
            free: knots[edge / 2],
            turns_left: edge == 0 || edge == 3,
        }
    }

    /// Visits the samples along the edge, both ends too.
    fn along(&self, mut visit: impl FnMut((f64, Side))) {
        for span in self.free.spans() {
            let (first, last) = (self.free.values()[span], self.free.values()[span + 1]);
            for k in 0..SAMPLES {
                let share = k as f64 / SAMPLES as f64;
                visit(((first + share * (last - first)).min(last), Side::Above));
            }
        }
        visit((self.free.domain().1, Side::Below));
    }

    fn corner(&self, at: (f64, Side)) -> Corner<'a> {
        if self.edge < 2 {
            Corner::new(self.surface, self.fixed, at)
        } else {
            Corner::new(self.surface, at, self.fixed)
        }
    }

    /// Area vector of the cut through the surface near the tip, on the side of `Su x Sv`.
    fn cut_area(&self) -> Vector {
        let knots = [self.surface.knots_u(), self.surface.knots_v()][self.edge / 2];
        let x = self.fixed.0 + CUT * super::limit::step(knots, self.fixed);
        let point = |at: f64| {
            if self.edge < 2 { self.surface.evaluate(x, at) } else { self.surface.evaluate(at, x) }
        };
        let center = point(self.free.domain().0);
        let (mut sum, mut before) = ([0.0; 3], [0.0; 3]);
        self.along(|(at, _)| {
            let next = sub(point(at), center);
            sum = add(sum, cross(before, next));
            before = next;
        });
        let sum = if self.turns_left { sum } else { sum.map(|x| -x) };
        if norm(sum) > 0.0 { sum } else { [0.0; 3] }
    }
}
