//! What a search has come to.

use super::FootPoint;
use super::proof::Certificate;

/// A record, or a place whose record is still to be made: many can be made together.
pub enum Outcome<P> {
    Record(FootPoint),
    Place(Sought<P>),
}

/// A place that a search has found.
#[derive(Clone, Copy, Debug, Default)]
pub struct Sought<P> {
    /// The caller's parameters.
    pub at: P,
    pub certificate: Certificate,
    /// Of the search.
    pub flags: u32,
    pub evaluations: u32,
    /// The gap that is allowed.
    pub allowed: f64,
}
