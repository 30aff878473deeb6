//! The search index: Bezier pieces with their distance tensors under a bounding-volume tree.
//!
//! A shape is scaled by a power of two to a box diagonal in [1, 2) and recentred (both exact but for one
//! rounding per coordinate); each piece is recentred again on one of its own poles. For a query `p` in a
//! piece's frame
//!
//! ```text
//!   r = X - W p      N = |r|^2 = A - 2 p.B + |p|^2 C      C = W^2      distance^2 = N / C
//! ```
//!
//! and the Bernstein coefficients of A, B, C ("tensors", twice the degree) are stored, so that those of N are
//! one small matrix-vector product. Reference: Johnson, Cohen, *Distance extrema for spline models using tangent
//! cones*, 2005, for the squared-distance form; the layout is ours.
//!
//! Built once, on first use or by `prepare`; immutable afterwards and shared by threads without locks.

mod around;
mod patch;
mod patches;
mod piece;
mod reach;
mod recognise;
mod segment;
mod segments;
mod shape;

pub use piece::{Frame, MAX_TENSOR_BYTES, Span, position_error, position_steps, product_steps};
pub use reach::{Across, CurveReach, Edge, RINGS, Reach};
pub use segment::Segment;
pub use segments::CurveIndex;
pub use shape::{IndexedCurve, IndexedSurface, Poll};

pub use patch::{Patch, side};
pub use patches::SurfaceIndex;
