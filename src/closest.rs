//! The nearest point of a shape, with a proof.
//!
//! ```text
//!   query -> tree, nearest box first -> piece -> boxes of the piece (see `line`, `patch`)
//!         -> foot = best place found, bound = what the walk has proven for everything else
//! ```
//!
//! Every answer carries `lower_bound`: nothing on the shape is nearer to the query than that, rounding included
//! (`docs/rounding.md`). The gap `distance - lower_bound` is at most the accuracy asked for or the rounding floor
//! of the shape and query ([`rounding_floor`]), or the flag [`flag::NOT_PROVEN`] is set.
//!
//! References: Johnson, Cohen, *A framework for efficient minimum distance computations*, 1998 (walk and prune);
//! Mourrain, Pavone, *Subdivision methods for solving polynomial equations*, 2009 (Bernstein tests).
//! Limits: a query whose foot is degenerate along a whole curve without being exactly constant may exhaust the
//! budget; it is then marked, never guessed.

mod proof;
mod settle;
mod sought;

mod certificate;

mod differences;

mod net;

mod line;

mod collapsed;

mod patch;

mod ties;

mod local;

mod lockstep;

mod elementary;

mod curve;

mod surface;

mod within;

use crate::bounds::{HALF_ULP, Vector, norm, sub};
use crate::index::{Frame, position_error};
use crate::refine::Method;
use crate::tree::Queue;
use proof::{Certificate, Proof};

pub(crate) use certificate::{free_slope, slope_error, squared_error, subtract_query};
pub(crate) use differences::{Slopes, convexity};
pub(crate) use surface::local_interval;
pub(crate) use within::{Found, Within};

/// Bits of [`FootPoint::flags`].
pub mod flag {
    /// `distance - lower_bound` exceeds both the accuracy and the rounding floor.
    pub const NOT_PROVEN: u32 = 1;
    /// One parameter equals an end of the domain, bit for bit.
    pub const EDGE: u32 = 2;
    /// Both parameters do.
    pub const CORNER: u32 = 4;
    /// The foot lies on the seam of a closed direction; the other end of the domain gives the same point.
    pub const SEAM: u32 = 8;
    /// The foot lies on a collapsed edge: a whole parameter interval maps to it.
    pub const COLLAPSED: u32 = 16;
    /// Another foot lies within the accuracy of the least distance, or that could not be excluded within the budget.
    ///
    /// Feet are points in space: a seam or a self-intersection is one foot, and so are places nearer to one another than
    /// eight times the root of distance times accuracy. At a distance below half the accuracy there are no ties.
    pub const TIE: u32 = 32;
    /// The feet form a continuum, the same distance up to rounding. A tie as well.
    pub const CONTINUUM: u32 = 64;
    /// Inversion: proven farther than the tolerance.
    pub const NOT_ON_SHAPE: u32 = 128;
    /// The query point is not finite or beyond 1e100.
    pub const BAD_QUERY: u32 = 256;
    /// The answer started from the caller's hint.
    pub const HINT_USED: u32 = 512;
    /// The budget ran out.
    pub const BUDGET: u32 = 1024;
    /// The foot lies on a tangent break.
    pub const CREASE: u32 = 2048;
}

/// A foot point and its certificate. 64 bits a field but the last two; the layout is frozen (C API).
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FootPoint {
    /// First parameter, in the domain.
    pub u: f64,
    /// Second parameter, in the domain; 0 for curves.
    pub v: f64,
    /// The shape at (u, v), the bits that its evaluation gives.
    pub point: Vector,
    /// |query - point|.
    pub distance: f64,
    /// Nothing on the shape is nearer to the query than this; 0 for local scope.
    pub lower_bound: f64,
    /// Bits of [`flag`].
    pub flags: u32,
    /// Evaluations of the shape spent.
    pub iterations: u32,
}

impl FootPoint {
    /// The record of a query that was not reached.
    pub fn unreached() -> Self {
        let nan = f64::NAN;
        Self {
            u: nan,
            v: nan,
            point: [nan; 3],
            distance: nan,
            lower_bound: 0.0,
            flags: flag::NOT_PROVEN,
            iterations: 0,
        }
    }

    /// The record of a query point that is not finite or too large.
    pub fn bad_query() -> Self {
        Self { flags: flag::BAD_QUERY | flag::NOT_PROVEN, ..Self::unreached() }
    }
}

/// Greatest absolute coordinate of a query.
pub const GREATEST_COORDINATE: f64 = 1e100;

/// How far an answer must hold.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Scope {
    /// The whole shape (or the restriction), with proof.
    #[default]
    Global,
    /// The iteration from the hint, or from the published start; without proof.
    Local,
}

/// What a query asks for. The default is what most callers want.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct QueryOptions {
    /// Inversion: farther points are not on the shape. 0: 1e-7 of the box diagonal.
    pub tolerance: f64,
    /// Asked-for `distance - lower_bound`. 0: 1e-10 of the box diagonal.
    pub accuracy: f64,
    /// Local iteration.
    pub method: Method,
    /// Global with proof, or local.
    pub scope: Scope,
    /// Restriction to u0, u1, v0, v1; curves use the first two.
    pub domain: Option<[f64; 4]>,
    /// Most boxes per query; 0: [`default_budget`].
    pub budget: u64,
}

pub use crate::refine::Trace;

/// Reusable memory of one thread. No query allocates once it has grown to the shape's degree.
#[derive(Clone, Debug, Default)]
pub struct Workspace {
    queue: Queue,
    deferred: Vec<(f64, usize)>,
    loose: Vec<(f64, usize)>,
    start: Vec<f64>,
    line: line::LineMemory,
    patch: patch::PatchMemory,
    lockstep: lockstep::Memory,
}

impl Workspace {
    /// The queue of the tree walk.
    pub(crate) fn queue(&mut self) -> &mut Queue {
        &mut self.queue
    }
}

/// Boxes a query may look at by default: 2,500 for small pieces, fewer where a box costs more.
/// `coefficients` is the number of product coefficients of a piece: (2p+1) for curves, (2p+1)(2q+1) for surfaces.
pub fn default_budget(coefficients: usize) -> u64 {
    (400_000 / coefficients as u64).clamp(150, 2_500)
}

/// The gap that rounding leaves at least, in the caller's lengths: 16 half ulps of the largest coordinate of shape and
/// query, and eight times what a position in the shape may be off (`position`, in the index's lengths): four on
/// either side of the target.
pub fn rounding_floor(frame: &Frame, query: Vector, position: f64) -> f64 {
    let largest = query.iter().fold(frame.magnitude, |m, x| m.max(x.abs()));
    16.0 * HALF_ULP * largest + 8.0 * position / frame.scale
}

/// The gap that rounding leaves to a search: eight times what a position in the shape may be off, four on either side
/// of the target. `steps` from [`position_steps`] of the shape's degrees.
fn search_floor(frame: &Frame, query: Vector, steps: f64, rational: bool) -> f64 {
    let size = norm(frame.enter(query));
    8.0 * position_error(steps, rational, 2.0, size + 2.0, size) / frame.scale
}

/// Whether the coordinates are so large beside the shape that a rounded point says less about its distance than the
/// search does: then iterations across pieces use the vector from the query, which is not rounded to coordinates.
fn is_coarse(frame: &Frame, query: Vector, search_floor: f64) -> bool {
    rounding_floor(frame, query, 0.0) > 0.25 * search_floor
}

/// Steps in the local parameters at which a continuum of feet must still be one.
const CONTINUUM_STEPS: [f64; 2] = [1.0 / 32.0, 1.0 / 16.0];

/// Share of the box diagonal up to which the grain of the parameters (speed times the gap between doubles) may widen the
/// allowed gap; where it is coarser, the parameters cannot say where the foot is and the answer is not proven.
pub const MOST_GAP: f64 = 9e-10;

/// Distance from `x` to the next double away from zero.
fn ulp(x: f64) -> f64 {
    x.abs().next_up() - x.abs()
}

pub(crate) fn is_bad(query: Vector) -> bool {
    query.iter().any(|x| !x.is_finite() || x.abs() > GREATEST_COORDINATE)
}

impl QueryOptions {
    fn tolerance(&self, frame: &Frame) -> f64 {
        if self.tolerance > 0.0 { self.tolerance } else { 1e-7 * frame.diagonal }
    }

    fn accuracy(&self, frame: &Frame) -> f64 {
        if self.accuracy > 0.0 { self.accuracy } else { 1e-10 * frame.diagonal }
    }
}

/// The allowed gap where no doubles are nearer to the parameters than `grain` in space.
fn grained(allowed: f64, grain: f64, frame: &Frame) -> f64 {
    allowed.max((allowed + grain).min(MOST_GAP * frame.diagonal))
}

/// What every global answer ends with: the bound in the caller's lengths and the flags of the certificate.
fn certify(foot: &mut FootPoint, certificate: Certificate, frame: &Frame, allowed: f64) {
    foot.iterations = certificate.evaluations;
    if certificate.exhausted {
        foot.flags |= flag::BUDGET;
    }
    bounded(foot, certificate.proven, frame, allowed);
}

/// Takes a proven bound, in the index's lengths, into the record.
fn bounded(foot: &mut FootPoint, proven: f64, frame: &Frame, allowed: f64) {
    let bound = proven / frame.scale;
    foot.lower_bound = if bound > 0.0 { bound.min(foot.distance) } else { 0.0 };
    let gap = foot.distance - foot.lower_bound;
    foot.flags &= !flag::NOT_PROVEN;
    if gap.is_nan() || gap > allowed {
        foot.flags |= flag::NOT_PROVEN;
    }
}

/// The record of a query so far away that its square overflows in the shape's scale: any point will do, and nothing is
/// nearer than that by more than the shape's diagonal.
fn far_foot(mut foot: FootPoint, frame: &Frame, allowed: f64) -> FootPoint {
    let bound = (foot.distance - 2.0 * frame.diagonal) * (1.0 - 16.0 * HALF_ULP);
    foot.lower_bound = bound.max(0.0);
    if foot.distance - foot.lower_bound > allowed {
        foot.flags |= flag::NOT_PROVEN;
    }
    foot
}

/// The further flag of an inversion.
pub(crate) fn mark_inversion(foot: &mut FootPoint, tolerance: f64) {
    if foot.lower_bound > tolerance {
        foot.flags |= flag::NOT_ON_SHAPE;
    } else if foot.distance > tolerance {
        foot.flags |= flag::NOT_PROVEN;
    }
}

fn distance(query: Vector, point: Vector) -> f64 {
    norm(sub(query, point))
}

/// Rounding of a distance to a box of the tree: a few half ulps of the coordinates that meet there.
pub(crate) fn tree_slack(query: Vector) -> f64 {
    16.0 * HALF_ULP * (2.0 + norm(query))
}

/// Squared distance beyond which a box of the tree need not be opened, neither for the proof nor for a tie.
fn tree_limit(proof: &Proof, slack: f64) -> f64 {
    limit_within(proof.best, proof, slack)
}

/// The same when the shape is known to be as near as `distance`, but for rounding.
fn first_limit(distance: f64, proof: &Proof, slack: f64) -> f64 {
    limit_within(distance * (1.0 + CORNER_ROUNDING) + CORNER_ROUNDING, proof, slack)
}

fn limit_within(distance: f64, proof: &Proof, slack: f64) -> f64 {
    let reach = distance + proof.window() + slack;
    reach * reach * (1.0 + 32.0 * HALF_ULP)
}

/// What is added to the distance of a corner: far more than its rounding and what a collapsed edge was moved.
const CORNER_ROUNDING: f64 = 1e-9;

/// Checks one interval of a restriction against the domain.
fn check_range(
    name: &str,
    first: usize,
    range: [f64; 2],
    domain: (f64, f64),
) -> Result<(), crate::error::Error> {
    let refuse = |text: String| Err(crate::error::Error::InvalidArgument(text));
    for (k, x) in range.into_iter().enumerate() {
        if x.is_nan() || x < domain.0 || x > domain.1 {
            return refuse(format!(
                "{name}: entry {} = {x} is outside [{}, {}]",
                first + k,
                domain.0,
                domain.1
            ));
        }
    }
    if range[0] >= range[1] {
        return refuse(format!("{name}: entry {first} is not less than entry {}", first + 1));
    }
    Ok(())
}
