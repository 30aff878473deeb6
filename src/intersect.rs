//! Intersections of curves, lines, planes and quadrics with curves and surfaces: all of them, with proof.

mod quadric;

mod edges;

mod level;

mod branches;

mod section;

mod cell;

mod cells;

mod rays;

mod pairs;

mod curves;

mod curve_quadric;

mod conics;

pub use branches::{Branch, BranchPoint, End};
pub use conics::{Common, Conic};
pub use curves::{CurveHit, CurveHits, HitOptions, Nature};
pub use quadric::Quadric;
pub use rays::{CastMemory, Caster, Hit, Ray, RayHits, ray_flag};
pub use section::{Contact, DEFAULT_BUDGET, Junction, Section, SectionOptions};
