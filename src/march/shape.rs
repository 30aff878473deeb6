//! What the methods without proof ask of a surface: points and derivatives on a rectangle.

use crate::bounds::Vector;
use crate::surface::Surface;
use crate::trim::Support;

/// A surface over a rectangle.
pub trait Shape {
    /// First and last u, first and last v.
    fn domain(&self) -> [f64; 4];
    /// The point at a place of the domain.
    fn evaluate(&self, u: f64, v: f64) -> Vector;
    /// S; Su, Sv; Suu, Suv, Svv: to order `count`, at most 2. NaN where a function fails.
    fn partials(&self, u: f64, v: f64, count: usize, out: &mut [Vector]);
}

impl Shape for Surface {
    fn domain(&self) -> [f64; 4] {
        Surface::domain(self)
    }

    fn evaluate(&self, u: f64, v: f64) -> Vector {
        Surface::evaluate(self, u, v)
    }

    fn partials(&self, u: f64, v: f64, count: usize, out: &mut [Vector]) {
        Surface::partials(self, u, v, count, out);
    }
}

impl Shape for Support {
    fn domain(&self) -> [f64; 4] {
        Support::domain(self)
    }

    fn evaluate(&self, u: f64, v: f64) -> Vector {
        Support::evaluate(self, [u, v])
    }

    fn partials(&self, u: f64, v: f64, count: usize, out: &mut [Vector]) {
        if !Support::partials(self, [u, v], count, out) {
            out.fill([f64::NAN; 3]);
        }
    }
}
