//! All stationary points of the distance between a point and a shape, with proof that none is missing.
//!
//! ```text
//!   piece -> half derivatives of the squared distance, as Bernstein polynomials (`gradient`)
//!         -> their common zeros, each alone in its box (`roots`); zeros along borders and creases; corners
//!         -> the same point seen from several pieces is one; what it is follows from all pieces around it (`nature`)
//! ```
//!
//! On a border the distance must be stationary along the border; at a corner nothing is asked. At a crease (a knot line
//! where the shape is only continuous) the derivatives on the two sides must not agree in sign, so that the distance is
//! least, greatest or stationary across it. A collapsed point counts when it is a minimum or a maximum.
//!
//! Continua (the axis of a circle, the centre of a sphere) come out as one member with its intervals: there the
//! distance stays within the accuracy.
//!
//! References: Piegl, Tiller, *The NURBS Book*, section 6.1 (the equations); Goresky, MacPherson, *Stratified Morse theory*,
//! 1988 (points of borders, creases and corners).
//! Limits: proof is up to the accuracy: stationary points whose distances differ by less along a short way may come out
//! as one flat member; a continuum that runs obliquely to the parameters takes more boxes, and its intervals hold places
//! beside it.

mod gradient;

mod nature;

mod curve;

mod surface;

use crate::bounds::{Vector, norm, sub};
use crate::closest::FootPoint;
use crate::set::{FootSet, Kind, Member, Nature};
use nature::Signs;

/// What is asked for. The default is every stationary point.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ExtremaOptions {
    /// Stationary points whose distances differ by less may come out as one; the width of continua. 0: 1e-10 of the box
    /// diagonal.
    pub accuracy: f64,
    /// Only points at most this far from the query; 0: all.
    pub radius: f64,
    /// At most this many of the nearest; 0: all.
    pub nearest: usize,
    /// Only minima.
    pub minima_only: bool,
    /// Restriction to u0, u1, v0, v1; curves use the first two. Its ends then are borders.
    pub domain: Option<[f64; 4]>,
    /// Most boxes; 0: [`DEFAULT_BUDGET`].
    pub budget: u64,
}

/// Boxes that one request may take by default.
pub const DEFAULT_BUDGET: u64 = 20_000;

/// Iterations that give a zero its last digits, and the longest step they may take (of a piece): longer ones say that the
/// polynomials and the shape itself do not agree.
const POLISH_STEPS: usize = 6;
const LONGEST_POLISH: f64 = 1e-4;

/// Largest coordinate of a query, in the size of the shape, whose products cannot overflow.
const GREATEST_REACH: f64 = 1e60;

impl ExtremaOptions {
    fn budget(&self) -> u64 {
        if self.budget > 0 { self.budget } else { DEFAULT_BUDGET }
    }

    fn radius(&self) -> f64 {
        if self.radius > 0.0 { self.radius } else { f64::INFINITY }
    }

    /// Puts the nearest first, and leaves what was asked for.
    pub(crate) fn finish(&self, mut members: Vec<Member>, undecided: Vec<[f64; 4]>) -> FootSet {
        let radius = self.radius();
        members.retain(|member| member.foot.distance.is_nan() || member.foot.distance <= radius);
        if self.minima_only {
            members.retain(|member| matches!(member.nature, Nature::Minimum | Nature::Flat));
        }
        members.sort_by(|a, b| {
            let by_place = a.foot.u.total_cmp(&b.foot.u).then(a.foot.v.total_cmp(&b.foot.v));
            a.foot.distance.total_cmp(&b.foot.distance).then(by_place)
        });
        if self.nearest > 0 {
            members.truncate(self.nearest);
        }
        FootSet { members, undecided }
    }
}

/// A place that may be stationary, in the caller's parameters.
#[derive(Clone, Copy, Debug)]
struct Candidate {
    at: [f64; 2],
    /// u0, u1, v0, v1.
    area: [f64; 4],
    source: Source,
    /// For a zero inside its piece: the signs there. Its parameters may be rounded to the end of the piece, where others
    /// tell other signs.
    own: Option<Signs>,
}

/// How a candidate was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Source {
    /// The gradient vanishes.
    Inside,
    /// A collapsed edge.
    Collapsed,
    /// The derivative along a border or crease vanishes, or it is a corner.
    Border,
    /// The gradient vanishes at the end of a piece, perhaps only by the allowance for rounding: where the zero lies
    /// beyond, the neighbour has it inside.
    OnEnd,
    /// The distance stays within the accuracy on the area.
    Flat,
}

/// A candidate that has become a member.
struct Taken {
    candidate: Candidate,
    point: Vector,
    distance: f64,
}

/// Parameters nearer to each other than this share of the range are beside each other.
const BESIDE: f64 = 1e-7;

/// Points nearer to each other than this share of the diagonal may be one point seen from two pieces.
const NEAR: f64 = 1e-8;

impl Taken {
    fn new(member: &Member, candidate: Candidate) -> Self {
        Self { candidate, point: member.foot.point, distance: member.foot.distance }
    }

    /// Whether another candidate, whose foot this is, means the same place. `holds(area, at)` tells whether a place lies
    /// in an area, `beside(at)` whether it is next to the other one; both across seams too.
    ///
    /// The box in which a zero is alone may be large: two zeros are one only if each lies in the other's box, and their
    /// points are near too (corners may be near in their parameters only), or if they
    /// were found alike and are beside each other. A flat area takes in what lies in it.
    fn is_same(
        &self,
        other: &Candidate,
        foot: &FootPoint,
        (diagonal, accuracy): (f64, f64),
        holds: impl Fn(&[f64; 4], [f64; 2]) -> bool,
        beside: impl Fn([f64; 2]) -> bool,
    ) -> bool {
        let within = holds(&self.candidate.area, other.at);
        if self.candidate.source == Source::Flat {
            return within && (foot.distance - self.distance).abs() <= 8.0 * accuracy;
        }
        let near = norm(sub(foot.point, self.point)) <= NEAR * diagonal + accuracy;
        let zero = |source: Source| matches!(source, Source::Inside | Source::OnEnd);
        let (a, b) = (self.candidate.source, other.source);
        let level = (foot.distance - self.distance).abs() <= 2.0 * accuracy;
        let twins = level && ((zero(a) && zero(b)) || a == b);
        near && ((within && holds(&other.area, self.candidate.at))
            || (twins && beside(self.candidate.at)))
    }
}

/// Squared distances within the accuracy of that at distance `d`: how much they may differ.
fn flat_limit(d: f64, accuracy: f64) -> f64 {
    accuracy * d.max(accuracy)
}

/// Whether a query can be answered at all without overflow; in the index's coordinates.
fn is_reachable(query: Vector) -> bool {
    query.iter().all(|x| x.abs() <= GREATEST_REACH)
}

/// The kind of a member from its flat directions.
fn kind(flat: [bool; 2]) -> Kind {
    match flat {
        [false, false] => Kind::Point,
        [true, false] => Kind::ArcU,
        [false, true] => Kind::ArcV,
        [true, true] => Kind::Region,
    }
}
