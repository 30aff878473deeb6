//! Sets of feet: the answer to a request that can have more than one.
//!
//! A member is a foot with the parameter intervals that belong to it:
//!
//! ```text
//!   point     one place; the intervals enclose what the tolerance leaves open
//!   arc       an interval of one parameter with the other one fixed: a collapsed edge, a strip without width
//!   region    intervals in both parameters: the centre of a sphere, a surface that is a single point
//! ```
//!
//! A set is complete when nothing is undecided: every answer then lies in the intervals of a member.

use crate::closest::FootPoint;

/// What the parameters of a member form.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// One place.
    Point = 0,
    /// An interval of u, with v fixed.
    ArcU = 1,
    /// An interval of v, with u fixed.
    ArcV = 2,
    /// Both parameters vary.
    Region = 3,
}

/// What the distance does at a member, among the points of the domain around it.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Nature {
    /// Nothing around is nearer.
    Minimum = 0,
    /// Nothing around is farther.
    Maximum = 1,
    /// Nearer in some directions, farther in others.
    Saddle = 2,
    /// Second derivatives do not tell.
    Flat = 3,
}

/// A foot and the parameters that belong to it.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Member {
    /// The representative: the place in the intervals that was found best.
    pub foot: FootPoint,
    /// Interval of u.
    pub u: [f64; 2],
    /// Interval of v; 0, 0 for curves.
    pub v: [f64; 2],
    /// What the parameters form.
    pub kind: Kind,
    /// What the distance does there.
    pub nature: Nature,
}

/// An answer of many feet.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FootSet {
    /// The feet, in the order that the request defines.
    pub members: Vec<Member>,
    /// Boxes u0, u1, v0, v1 in which nothing could be decided before the budget ran out.
    pub undecided: Vec<[f64; 4]>,
}

impl FootSet {
    /// Whether nothing is missing.
    pub fn is_complete(&self) -> bool {
        self.undecided.is_empty()
    }
}
