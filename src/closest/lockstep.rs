//! Many queries at once: iterations that meet nothing in their way, lane by lane.
//!
//! ```text
//!   queries -> starts -> rounds of one Newton step each -> feet -> bounds from the reach -> records
//!                 \             \                             \
//!                  '-------------'-----------------------------'--> the rest, one by one
//! ```
//!
//! A query that needs more than whole Newton steps inside of one piece, or whose foot does not settle it, is asked again
//! alone. The bits are those of single queries: each lane takes the same steps in the same order, and the decisions are the same.

use crate::bounds::Vector;
use crate::jet::{PatchJets, SegmentJets};
use crate::refine::{Course, CurveSteps, SurfaceSteps, Worth};
use crate::simd::{Row, row};

use super::FootPoint;
use super::settle::Landed;

/// Jets after which a query goes on alone.
pub const MOST_TAKEN: u32 = 12;

/// A record of a place inside of a piece, before it says where.
pub const NOWHERE: FootPoint = FootPoint {
    u: 0.0,
    v: 0.0,
    point: [0.0; 3],
    distance: 0.0,
    lower_bound: 0.0,
    flags: 0,
    iterations: 0,
};

/// A query on its way over a piece.
#[derive(Clone, Copy, Debug)]
pub struct Flight<P> {
    /// Which one of those that were given.
    pub number: usize,
    /// Segment or patch.
    pub piece: usize,
    /// Local parameters, inside of the piece.
    pub at: P,
    /// The query in the coordinates of the piece.
    pub query: Vector,
    /// How far a point of the piece may be off.
    pub position: f64,
    /// What the place before was worth.
    pub worth: Option<Worth>,
    /// The size of the step to this one.
    pub step: Option<f64>,
    /// Jets taken.
    pub taken: u32,
    /// Whether this is the foot, to be looked at.
    pub is_foot: bool,
}

/// A query that has come to its foot: the jet of the last place that was looked at is to settle it.
#[derive(Clone, Copy, Debug)]
pub struct Landing<P, const N: usize> {
    pub flight: Flight<P>,
    /// The last place that was looked at.
    pub seen: P,
    /// The vector from the query, first derivatives.
    pub jet: [Vector; N],
    /// The weight.
    pub w: f64,
}

/// Room for the queries of a group.
#[derive(Clone, Debug, Default)]
pub struct Memory {
    pub surface: Option<Box<SurfaceMemory>>,
    pub curve: Option<Box<CurveMemory>>,
    /// Queries that go on alone.
    pub alone: Vec<usize>,
}

/// Room for queries on a surface.
#[derive(Clone, Debug, Default)]
pub struct SurfaceMemory {
    pub flights: Vec<Flight<[f64; 2]>>,
    pub landings: Vec<Landing<[f64; 2], 3>>,
    pub jets: PatchJets,
    pub steps: SurfaceSteps,
    pub landed: Landed,
}

/// Room for queries on a curve.
#[derive(Clone, Debug, Default)]
pub struct CurveMemory {
    pub flights: Vec<Flight<f64>>,
    pub landings: Vec<Landing<f64, 2>>,
    pub jets: SegmentJets,
    pub steps: CurveSteps,
}

/// What has become of a flight.
pub enum Fate {
    Flies,
    Landed,
    Alone,
}

impl<P: Copy> Flight<P> {
    /// Takes the course from its place, which is worth `worth`.
    pub fn follow(&mut self, course: Course<P>, worth: Worth) -> Fate {
        match course {
            Course::Leaves => Fate::Alone,
            Course::Stays => Fate::Landed,
            Course::Lands(to) => {
                self.at = to;
                Fate::Landed
            }
            Course::Goes(..) if self.taken >= MOST_TAKEN => Fate::Alone,
            Course::Goes(to, size) => {
                (self.at, self.worth, self.step) = (to, Some(worth), Some(size));
                Fate::Flies
            }
        }
    }
}

/// Vectors of up to [`WIDTH`](crate::simd::WIDTH) items, lane by lane; of fewer, the first fills the rest.
pub fn rows<T>(items: &[T], vector: impl Fn(&T) -> Vector) -> [Row; 3] {
    [0, 1, 2].map(|c| row(items, |item| vector(item)[c]))
}
