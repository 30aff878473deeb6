//! Inspection: how a curve bends, how a surface bends, how two shapes meet and how far they are apart.
//!
//! Numbers that are called bounds are proven, rounding included: see [`surface_range`], [`hausdorff`]. The others are
//! evaluations.
//!
//! Reference: Hagen, Hahmann, Schreiber, *Visualization and computation of curvature behaviour of freeform curves and
//! surfaces*, 1995.

mod interval;

mod slope;

mod polynomial;

mod doubled;

mod net;

mod chebyshev;

mod model;

mod cell;

mod request;

mod local;

mod crosscap;

mod growth;

mod search;

mod glance;

mod climb;

mod carrier;

mod ranges;

mod bend;

mod umbilic;

mod paint;

mod picture;

mod hausdorff;

mod continuity;

pub use bend::{
    Inflection, Monotone, Tooth, Trend, comb, inflections, monotone_pieces, plane_normal, tooth,
    turn_count,
};
pub use continuity::{Continuity, Measured, continuity};
pub use hausdorff::{Directed, Hausdorff, HausdorffOptions, Shape, hausdorff};
pub use paint::Pattern;
pub use picture::{Picture, PictureOptions, picture};
pub use ranges::{curve_range, surface_range};
pub use request::{Quantity, Range, RangeOptions, Side, Unbounded};
pub use umbilic::{Curvatures, Umbilic, curvatures, umbilics};
