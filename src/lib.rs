//! footpoint: from a point back to the parameters of a NURBS curve or surface, with a proof.
//!
//! Every global answer carries a proven lower bound of the distance, or says that it is not proven.
//! Reading order = module order: a file uses only the files listed before it.

pub mod error;

pub mod portable;

pub mod simd;

pub mod knots;

pub mod basis;

pub mod curve;

pub mod surface;

pub mod bezier;

pub mod bounds;

pub mod coefficients;

pub mod jet;

pub mod tree;

mod sparse;

pub mod analytic;

pub mod index;

pub mod refine;

pub mod closest;

pub mod set;

pub mod roots;

pub mod extrema;

pub mod preimage;

pub mod unwrap;

pub mod normal;

pub mod scene;

pub mod callback;

pub mod batch;

pub mod weights;

pub mod operate;

pub mod fit;

pub mod elementary;

pub mod construct;

pub mod transform;

pub mod pcurve;

pub mod trim;

pub mod face;

pub mod intersect;

pub mod march;

pub mod inspect;

pub mod fair;

mod ffi;
