//! Parts of a patch that the search has not closed yet.

use crate::coefficients::Rung;

/// A box of parameters whose coefficients lie in a slot.
#[derive(Clone, Copy, Debug, Default)]
pub struct Area {
    pub s: [f64; 2],
    pub t: [f64; 2],
    pub error: f64,
    pub radius: f64,
    pub age: u32,
    /// In a walk for ties: whether it holds one foot at most.
    pub small: bool,
    /// Whether its slot holds nothing yet: its coefficients are formed from the poles when its turn comes.
    pub unformed: bool,
    /// The degrees of its coefficients.
    pub rung: Rung,
    /// How much more their error is to second differences along s and along t, since they have lower degrees; to first ones
    /// its root.
    pub growth: [f64; 2],
    /// Halvings in each direction before lower degrees are thought of.
    pub patience: [u32; 2],
    /// Whether lowering has failed: it keeps its degrees.
    pub is_stiff: bool,
}

impl Area {
    /// The place at a share of it.
    pub fn place(&self, [s, t]: [f64; 2]) -> [f64; 2] {
        [self.s[0] + s * (self.s[1] - self.s[0]), self.t[0] + t * (self.t[1] - self.t[0])]
    }
}
