//! What a path needs of a shape.

use crate::bounds::Vector;
use crate::closest::FootPoint;
use crate::knots::Knots;

/// What a path needs of a shape; a curve has a second parameter without extent.
pub trait Ground {
    /// Start and end of each parameter.
    fn ends(&self) -> [[f64; 2]; 2];
    /// Closed directions.
    fn closed(&self) -> [bool; 2];
    /// The points of the collapsed edges u0, u1, v0, v1.
    fn tips(&self) -> [Option<Vector>; 4];
    /// Diagonal of the box.
    fn diagonal(&self) -> f64;
    /// First derivatives.
    fn frame(&self, at: [f64; 2]) -> [Vector; 2];
    /// The point.
    fn point(&self, at: [f64; 2]) -> Vector;
    /// The foot that the local iteration finds from a start.
    fn local(&mut self, query: Vector, start: [f64; 2]) -> FootPoint;
    /// Where the local iteration ends inside one cell (u0, u1, v0, v1), and its distance.
    fn local_in(&self, query: Vector, start: [f64; 2], cell: [f64; 4]) -> ([f64; 2], f64);
    /// Whether answers are restricted to a part of the domain.
    fn is_restricted(&self) -> bool;
    /// The knots of a parameter, when there are any.
    fn knots(&self, k: usize) -> Option<&Knots>;
    /// The gap between distance and bound that a proven answer may have.
    fn allowed(&self, query: Vector) -> f64;
}
