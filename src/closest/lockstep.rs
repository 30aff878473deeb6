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
use crate::refine::{Approach, Course, CurveSteps, SurfaceSteps, Worth};
use crate::simd::{Row, row};

use super::FootPoint;
use super::settle::{Landed, LandedOnCurve};

/// Jets after which a query goes on alone.
pub const MOST_TAKEN: u32 = 12;

/// How far from the middle of a shape, in lengths of its index, queries begin alone: so far out no foot settles its query (K of
/// [`crate::index::Reach`] has a least value).
pub const FAR: f64 = 6.0;

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
    /// Whether it began at a hint.
    pub is_hinted: bool,
}

/// A query that lanes have left, and where.
#[derive(Clone, Copy, Debug)]
pub struct Left<P> {
    /// Segment or patch.
    pub piece: usize,
    /// Where its iteration goes on.
    pub approach: Approach<P>,
    /// Whether it began at a hint.
    pub is_hinted: bool,
}

/// Where a search begins.
#[derive(Clone, Copy, Debug)]
pub enum Begin<P> {
    /// At a place that is likely near.
    Anywhere,
    /// At the caller's parameters.
    Hint(P),
    /// Where lanes have left off.
    On(Left<P>),
}

impl<P> Begin<P> {
    /// At a hint, if there is one.
    pub fn at(hint: Option<P>) -> Self {
        hint.map_or(Self::Anywhere, Self::Hint)
    }

    /// Whether the caller gave a hint.
    pub fn is_hinted(&self) -> bool {
        matches!(self, Self::Hint(_) | Self::On(Left { is_hinted: true, .. }))
    }
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
}

/// Room for queries on a surface.
#[derive(Clone, Debug, Default)]
pub struct SurfaceMemory {
    pub flights: Vec<Flight<[f64; 2]>>,
    pub landings: Vec<Landing<[f64; 2], 3>>,
    /// Queries that go on alone, and from where if not from the start.
    pub alone: Vec<(usize, Option<Left<[f64; 2]>>)>,
    pub jets: PatchJets,
    pub steps: SurfaceSteps,
    pub landed: Landed,
}

/// Room for queries on a curve.
#[derive(Clone, Debug, Default)]
pub struct CurveMemory {
    pub flights: Vec<Flight<f64>>,
    pub landings: Vec<Landing<f64, 2>>,
    /// Queries that go on alone, and from where if not from the start.
    pub alone: Vec<(usize, Option<Left<f64>>)>,
    pub jets: SegmentJets,
    pub steps: CurveSteps,
    pub landed: LandedOnCurve,
}

/// What has become of a flight.
pub enum Fate {
    Flies,
    Landed,
    Alone,
}

impl<P: Copy> Flight<P> {
    /// Where the query goes on alone, from the place that was looked at last.
    pub fn left(&self, is_foot: bool) -> (usize, Option<Left<P>>) {
        let &Self { at, step, .. } = self;
        let approach = Approach { at, step, taken: self.taken - 1, is_foot };
        (self.number, Some(Left { piece: self.piece, approach, is_hinted: self.is_hinted }))
    }

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
