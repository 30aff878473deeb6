//! Ties: whether another foot lies within the accuracy of the least distance.
//!
//! ```text
//!   walk            closes boxes for the target; notes the pieces where a box would not have closed for the reach of ties
//!   places met      feet and ends of iterations within reach, elsewhere: each is iterated from on the whole shape
//!   noted pieces    searched again: beyond the reach, monotone, convex (one foot), around the best foot, or halved
//! ```
//!
//! Feet are told apart in space: one point with two parameters (a seam, a self-intersection) is one foot, and so are places
//! nearer to one another than eight times the root of distance times accuracy. Two places with no rise of the distance
//! between them are no two feet, but a continuum when the distance is the same up to rounding. Limit: what a share of the budget does not decide counts as a tie.

use super::flag;
use super::proof::{Proof, Rival};
use crate::bounds::{Vector, norm};

/// Places that are looked at between two feet.
const BETWEEN: usize = 16;

/// Pieces through which the iteration from a place may go.
pub const HOPS: usize = 12;
/// Share of the window below which a distance has not become less.
pub const LEAST_GAIN: f64 = 0.015625;

/// What a place that may tie turned out to be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Finding {
    /// The best foot, or none.
    None,
    /// Another foot.
    Foot,
    /// A place that the shape joins to the best foot within the reach, far away from it.
    Continuum,
}

/// A shape with a query, as the search for ties sees it.
pub trait Ground {
    /// Searches a piece for ties.
    fn search(&mut self, piece: usize, proof: &mut Proof);
    /// What a place that may tie is.
    fn look(&self, rival: Rival, proof: &mut Proof) -> Finding;
}

/// The flags of a query whose walk has ended. `pieces`: what the walk closed for the target only, each with a bound.
pub fn flags(ground: &mut impl Ground, pieces: &[(f64, usize)], proof: &mut Proof) -> u32 {
    let proven = !proof.exhausted;
    proof.seek_ties();
    let mut waiting = pieces.iter();
    let mut piece = None;
    loop {
        while let Some(rival) = proof.next_rival() {
            match ground.look(rival, proof) {
                Finding::None => {}
                Finding::Foot => return flag::TIE,
                Finding::Continuum => return flag::TIE | flag::CONTINUUM,
            }
        }
        piece = piece.or_else(|| waiting.find(|p| p.0 <= proof.reach()));
        let (Some(&(_, k)), true) = (piece, proven) else { return 0 };
        proof.loose = f64::INFINITY;
        ground.search(k, proof);
        if proof.exhausted || proof.crowded || proof.loose <= proof.reach() {
            return flag::TIE;
        }
        if !proof.has_news() {
            piece = None;
        }
    }
}

/// What another foot is, `d` from the query, when `distance` tells the distance at a share of the way from the best foot
/// to it. `noise`: how far distances may be off.
pub fn told_apart(
    d: Vector,
    noise: f64,
    proof: &Proof,
    mut distance: impl FnMut(f64) -> f64,
) -> Finding {
    let top = (1..BETWEEN).map(|k| distance(k as f64 / BETWEEN as f64)).fold(0.0, f64::max);
    if top > norm(d) + noise {
        return Finding::Foot;
    }
    if norm(d) <= proof.best + noise { Finding::Continuum } else { Finding::None }
}
