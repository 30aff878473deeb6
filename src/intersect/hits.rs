//! What a curve has in common with a curve, a surface or a quadric, and what a caller asks for.

use crate::bounds::Vector;

/// Boxes that one request may take by default.
pub const DEFAULT_BUDGET: u64 = 1_000_000;

/// How two shapes meet.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Nature {
    /// At an angle.
    Transversal = 0,
    /// They touch: multiplicity 2 when they stay on one side, 3 when they cross.
    Tangential = 1,
    /// They run together along an interval.
    Overlap = 2,
}

/// A hit: of a curve with a curve (parameters u of the first, w of the second) or with a surface (u, v; w of the curve).
/// The layout is frozen (C API).
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurveHit {
    /// First parameter of the first shape.
    pub u: f64,
    /// Second one; 0 on a curve.
    pub v: f64,
    /// Parameter of the second shape, a curve.
    pub w: f64,
    /// The first shape there.
    pub point: Vector,
    /// Distance between both there.
    pub distance: f64,
    /// Interval of u that holds every place within the tolerance that belongs to the hit.
    pub u_range: [f64; 2],
    /// The same for v.
    pub v_range: [f64; 2],
    /// The same for w; of an overlap: where they run together.
    pub w_range: [f64; 2],
    /// How they meet.
    pub nature: Nature,
    /// 1 at an angle; 2 or 3 where they touch; 0 along an overlap.
    pub multiplicity: u32,
}

/// What is asked; zeros are the defaults.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct HitOptions {
    /// Length: places farther apart do not meet. 0: 1e-7 of the greater diagonal; never less than the rounding.
    pub tolerance: f64,
    /// Most boxes. 0: 1,000,000.
    pub budget: u64,
}

/// All hits, in the order of w (of the second shape).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CurveHits {
    /// The hits.
    pub hits: Vec<CurveHit>,
    /// Boxes u0, u1, v0, v1, w0, w1 in which nothing could be decided.
    pub undecided: Vec<[f64; 6]>,
    /// Whether the caller said stop: what was not looked at by then is undecided.
    pub stopped: bool,
}

impl CurveHits {
    /// Of which nothing is known but the domains.
    pub(super) fn unreached(domains: [f64; 6]) -> Self {
        Self { undecided: vec![domains], stopped: true, ..Self::default() }
    }

    /// Whether nothing is missing.
    pub fn is_complete(&self) -> bool {
        self.undecided.is_empty()
    }
}
