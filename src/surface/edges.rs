//! What the borders of a surface are: isocurves, closed directions, collapsed edges.
//!
//! ```text
//!   v1 +-----------+      edge 0: u = u0     edge 2: v = v0
//!      |           |      edge 1: u = u1     edge 3: v = v1
//!   v0 +-----------+
//!     u0           u1
//! ```
//!
//! Everything is decided on the geometry of the boundary isocurves, never on the knots: the pole rows
//! of an unclamped surface are not its borders.
//!
//! Limit: two borders that are equal as point sets but differ in their parametrisation are not
//! recognised as closed.

use super::{ORDER, Surface};
use crate::basis;
use crate::curve::{
    CLOSED_TOLERANCE, Curve, add_scaled, box_of, distance, largest, length_tolerance,
};
use crate::knots::Knots;

/// An edge whose poles are nearer to each other than this, relative to the diagonal of the box of the
/// surface, is one point.
pub const COLLAPSED_TOLERANCE: f64 = 1e-8;

impl Surface {
    /// The curve v -> S(u, v) for a fixed `u` in the domain, on the knots of v. The borders of a clamped surface
    /// are its rows of poles bit for bit.
    pub fn isocurve_u(&self, u: f64) -> Curve {
        let stride = self.knots_v.pole_count();
        self.isocurve(&self.knots_u, u, &self.knots_v, |i, j| i * stride + j)
    }

    /// The curve u -> S(u, v) for a fixed `v` in the domain, on the knots of u. The borders of a clamped surface
    /// are its columns of poles bit for bit.
    pub fn isocurve_v(&self, v: f64) -> Curve {
        let stride = self.knots_v.pole_count();
        self.isocurve(&self.knots_v, v, &self.knots_u, |i, j| j * stride + i)
    }

    /// The isocurve at `at` on the knots `free`; `index(i, j)` is the pole i across it, j along it.
    fn isocurve(
        &self,
        fixed: &Knots,
        at: f64,
        free: &Knots,
        index: impl Fn(usize, usize) -> usize,
    ) -> Curve {
        debug_assert!(fixed.contains(at), "{at} is outside the domain");
        let span = fixed.span(at);
        let first = span - fixed.degree();
        let mut basis = [0.0; ORDER];
        let basis = &mut basis[..=fixed.degree()];
        basis::values(fixed, span, at, basis);
        let middle = first + largest(basis);
        let (mut poles, mut weights) = (Vec::new(), Vec::new());
        for j in 0..free.pole_count() {
            let reference = self.poles[index(middle, j)];
            let mut sum = [0.0; 4];
            for (i, n) in basis.iter().enumerate() {
                let place = index(first + i, j);
                add_scaled(&mut sum, n * self.weight(place), &self.poles[place], reference);
            }
            poles.push(self.position(reference, sum));
            weights.push(sum[3]);
        }
        let weights = self.rational.then(|| weights.into());
        Curve::from_parts(free.clone(), poles.into(), weights)
    }

    /// The weight in effect: 1 when the surface is not rational.
    fn weight(&self, place: usize) -> f64 {
        match &self.weights {
            Some(weights) if self.rational => weights[place],
            _ => 1.0,
        }
    }

    /// True when the borders u = u0 and u = u1 are the same curve: their poles agree within
    /// [`CLOSED_TOLERANCE`] of the diagonal of the box (and the rounding of its coordinates), their
    /// weights up to a common factor.
    pub fn is_closed_u(&self) -> bool {
        let (start, end) = self.knots_u.domain();
        self.coincide(&self.isocurve_u(start), &self.isocurve_u(end))
    }

    /// True when the borders v = v0 and v = v1 are the same curve, like [`Surface::is_closed_u`].
    pub fn is_closed_v(&self) -> bool {
        let (start, end) = self.knots_v.domain();
        self.coincide(&self.isocurve_v(start), &self.isocurve_v(end))
    }

    /// Are two curves with the same knots the same curve?
    fn coincide(&self, a: &Curve, b: &Curve) -> bool {
        let active = a.knots().active_poles();
        let tolerance = length_tolerance(self.bounding_box(), CLOSED_TOLERANCE);
        let (ours, theirs) = (&a.poles()[active.clone()], &b.poles()[active.clone()]);
        if ours.iter().zip(theirs).any(|(&p, &q)| distance(p, q) > tolerance) {
            return false;
        }
        let (Some(ours), Some(theirs)) = (a.weights(), b.weights()) else { return true };
        let (ours, theirs) = (&ours[active.clone()], &theirs[active]);
        let factor = ours[largest(ours)] / theirs[largest(ours)];
        ours.iter().zip(theirs).all(|(w, x)| (w - x * factor).abs() <= CLOSED_TOLERANCE * w)
    }

    /// Which of the edges u0, u1, v0, v1 is a single point: the poles of its isocurve lie within
    /// [`COLLAPSED_TOLERANCE`] of the diagonal of the box (and the rounding of its coordinates).
    pub fn collapsed_edges(&self) -> [bool; 4] {
        let tolerance = length_tolerance(self.bounding_box(), COLLAPSED_TOLERANCE);
        std::array::from_fn(|edge| self.collapsed_spread(edge) <= tolerance)
    }

    /// Diagonal of the box of the poles of an edge's isocurve, edges in the order u0, u1, v0, v1: no
    /// two points of the edge are farther apart, up to rounding.
    pub fn collapsed_spread(&self, edge: usize) -> f64 {
        let [u0, u1, v0, v1] = self.domain();
        let border = match edge {
            0 => self.isocurve_u(u0),
            1 => self.isocurve_u(u1),
            2 => self.isocurve_v(v0),
            _ => self.isocurve_v(v1),
        };
        let (low, high) = box_of(&border.poles()[border.knots().active_poles()]);
        distance(low, high)
    }
}
