//! One Bezier segment of a curve, without its numbers.

use super::piece::Span;
use crate::bounds::Vector;

/// One Bezier segment; its numbers are in the arrays of the index that holds it.
#[derive(Clone, Debug)]
pub struct Segment {
    /// Parameters.
    pub u: Span,
    /// Origin of the segment's coordinates, in the index's coordinates.
    pub center: Vector,
    /// Greatest distance of a pole from `center`.
    pub radius: f64,
    /// Whether a least distance may sit on this end with a gradient: a curve end or a C0 knot.
    pub border: [bool; 2],
}
