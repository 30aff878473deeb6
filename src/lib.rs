//! footpoint: from a point back to the parameters of a NURBS curve or surface, with a proof.
//!
//! Every global answer carries a proven lower bound of the distance, or says that it is not proven.
//! Reading order = module order: a file uses only the files listed before it.

pub mod batch;
pub mod closest;
pub mod curve;
pub mod error;
mod ffi;
pub mod index;
pub mod knots;
pub mod refine;
pub mod surface;
