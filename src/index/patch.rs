//! One Bezier patch of a surface, without its numbers.

use super::piece::Span;
use crate::bounds::Vector;

/// A collapsed edge whose poles spread by more than this share of the box diagonal is searched as the tiny edge
/// that it is; below it, the poles are made to coincide, at the price of that much in every bound.
pub const MOST_SPREAD: f64 = 1e-12;

/// The four sides of a patch, as indices of its `border` and `collapsed` arrays.
pub mod side {
    /// s = 0.
    pub const S0: usize = 0;
    /// s = 1.
    pub const S1: usize = 1;
    /// t = 0.
    pub const T0: usize = 2;
    /// t = 1.
    pub const T1: usize = 3;
}

/// One Bezier patch; its numbers are in the arrays of the index.
#[derive(Clone, Debug)]
pub struct Patch {
    /// Parameters of s.
    pub u: Span,
    /// Parameters of t.
    pub v: Span,
    /// Origin of the patch's coordinates, in the index's coordinates.
    pub center: Vector,
    /// Greatest distance of a pole from `center`.
    pub radius: f64,
    /// Whether a least distance may sit on this side with a gradient: a border of the domain or a C0 knot line.
    pub border: [bool; 4],
    /// Whether this side is a collapsed edge; its poles then coincide exactly (see `spread`).
    pub collapsed: [bool; 4],
    /// How far the net was moved to make its collapsed edges exact.
    pub spread: f64,
}

impl Patch {
    /// Whether one of its sides is a collapsed edge.
    pub fn has_collapsed(&self) -> bool {
        self.collapsed != [false; 4]
    }
}
