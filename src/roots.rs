//! All zeros of polynomials in Bernstein form on a box, with proof that none is missing.
//!
//! ```text
//!   box -> a coefficient row of one sign?          no zero inside: closed
//!          derivative regular on the whole box?    at most one zero inside: Newton finds it or the box is halved
//!          values flat to the tolerance?           kept whole: a continuum, or a multiple zero
//!          otherwise                               halve
//! ```
//!
//! Coefficients carry an absolute rounding allowance, so that no zero of the exact polynomials is lost.
//!
//! References: Krawczyk, *Newton-Algorithmen zur Bestimmung von Nullstellen mit Fehlerschranken*, 1969; Mourrain, Pavone,
//! *Subdivision methods for solving polynomial equations*, 2009 (preconditioned Bernstein tests).
//! Limit: a curve of zeros that runs obliquely to the parameters takes more boxes; the budget may leave some undecided.

mod single;

mod pair;

pub use pair::{Meaning, Pair, zeros_of_pair};
pub use single::zeros_of;

/// Zeros found nearer than this to each other in the unit box are one zero seen from two boxes.
pub const SAME: f64 = 1e-11;

/// Boxes narrower than this share of the unit box are not halved any more.
const LEAST_WIDTH: f64 = 1e-13;

/// What is known of a box that holds zeros.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Found {
    /// One zero, and no other one in the box.
    Root,
    /// Zeros may be anywhere in the box; the values stay within the tolerance there.
    Flat,
    /// Neither could be shown before budget or width ran out.
    Undecided,
}

/// A zero, or a box of zeros, in `N` parameters of the unit box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Zero<const N: usize> {
    /// What is known.
    pub found: Found,
    /// The zero; the middle of the box when it is not a root.
    pub at: [f64; N],
    /// Least parameters of the box.
    pub low: [f64; N],
    /// Greatest parameters of the box.
    pub high: [f64; N],
}

impl<const N: usize> Zero<N> {
    fn root(at: [f64; N], radius: f64) -> Self {
        let low = at.map(|x| (x - radius).max(0.0));
        let high = at.map(|x| (x + radius).min(1.0));
        Self { found: Found::Root, at, low, high }
    }

    fn area(found: Found, low: [f64; N], high: [f64; N]) -> Self {
        let at = std::array::from_fn(|k| 0.5 * (low[k] + high[k]));
        Self { found, at, low, high }
    }

    fn is_near(&self, other: &Self) -> bool {
        (0..N).all(|k| (self.at[k] - other.at[k]).abs() <= SAME)
    }
}

/// Adds a root unless it has been found from a neighbouring box.
fn push_root<const N: usize>(out: &mut Vec<Zero<N>>, first: usize, root: Zero<N>) {
    let known = |zero: &Zero<N>| zero.found == Found::Root && zero.is_near(&root);
    if !out[first..].iter().any(known) {
        out.push(root);
    }
}

/// Takes one from the budget; false when nothing is left.
fn spend(budget: &mut u64) -> bool {
    let some = *budget > 0;
    *budget = budget.saturating_sub(1);
    some
}
