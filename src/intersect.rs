//! Intersections of curves, rays, planes and quadrics with curves and surfaces: all of them, with proof.
//!
//! ```text
//!   plane, quadric x surface   put in: a polynomial f(u, v) = 0     -> edges, level, branches: arcs between nodes
//!   plane, quadric x curve     put in: a polynomial f(t) = 0        -> curve_quadric: certified zeros
//!   plane, quadric x quadric   a pair of planes in their pencil     -> conics in closed form
//!   ray x surface              cells that a line crosses once       -> cells, cast, rays: millions
//!   curve x curve, surface     boxes of both, halved                -> pairs, curves: crossings, contacts, overlaps
//! ```
//!
//! Every answer lists what could not be decided, with its size; nothing is left out silently. What is proven: outside of the
//! hits, branches, contacts and undecided boxes nothing is nearer than the tolerance (rays and quadrics: nothing meets).

mod quadric;

mod edges;

mod level;

mod branches;

mod section;

mod cell;

mod cells;

mod cast;

mod rays;

mod pairs;

mod hits;

mod curves;

mod curve_quadric;

mod conics;

pub use branches::{Branch, BranchPoint, End};
pub use conics::{Common, Conic};
pub use hits::{CurveHit, CurveHits, HitOptions, Nature};
pub use quadric::Quadric;
pub use rays::{CastMemory, Caster, Hit, Ray, RayHits, ray_flag};
pub use section::{Contact, DEFAULT_BUDGET, Junction, Section, SectionOptions};
