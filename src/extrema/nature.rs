//! What a stationary point is: minimum, maximum or saddle among the points around it.
//!
//! Around a place lie one to four pieces (more than one on knot lines and seams). Each tells, for each parameter, the sign
//! of the first derivative into the piece, or where that vanishes the sign of the second. All signs up: a minimum; all
//! down: a maximum; mixed: a saddle; a zero that nothing settles: flat.

use crate::bounds::{dot, norm};
use crate::jet::{Jet1, Jet2};
use crate::set::Nature;

/// First derivatives count as zero below this cosine between distance and tangent.
const LEAST_COSINE: f64 = 1e-9;

/// Second derivatives count as zero below this share of the metric.
const LEAST_CURVATURE: f64 = 1e-7;

/// Derivatives are off by some times what positions are: at a place where they vanish, only that is left of them.
const NOISE: f64 = 64.0;

/// A parameter does not move the point when its speed is below this share of the other one's.
const SINGULAR: f64 = 1e-10;

/// The derivative of the distance along a parameter per length of the way times the distance, so a length.
#[derive(Clone, Copy, Debug)]
pub struct Along {
    /// Towards greater parameters.
    pub slope: f64,
    /// How far it may be off for the rounding of the tangent.
    pub noise: f64,
}

/// Signs gathered around a place.
#[derive(Clone, Copy, Debug, Default)]
pub struct Signs {
    up: bool,
    down: bool,
    zero: bool,
    /// A parameter does not move the point here.
    singular: bool,
    /// For each parameter: seen rising and falling into a piece, from the two sides of a knot line.
    across: [[bool; 2]; 2],
    /// For each parameter: a piece on the high side, on the low side of a knot line through the place.
    sides: [[bool; 2]; 2],
}

/// Where a place lies in a piece, in one parameter: at its low end, its high end, or inside.
pub fn end_of(x: f64) -> f64 {
    if x == 0.0 {
        1.0
    } else if x == 1.0 {
        -1.0
    } else {
        0.0
    }
}

impl Signs {
    fn put(&mut self, value: f64, least: f64) {
        if value > least {
            self.up = true;
        } else if value < -least {
            self.down = true;
        } else {
            self.zero = true;
        }
    }

    /// The derivative into the piece along one parameter; true when it is not zero.
    fn first(&mut self, k: usize, inward: f64, least: f64) -> bool {
        if inward.abs() <= least {
            return false;
        }
        self.across[k][usize::from(inward < 0.0)] = true;
        self.put(inward, 0.0);
        true
    }

    /// A segment at whose end (or inside of which) the place lies; `position` is how far its points may be off.
    pub fn segment(&mut self, jet: &Jet1, x: f64, position: f64) {
        let (speed, distance) = (norm(jet.s), norm(jet.d));
        let noise = NOISE * distance * position;
        let least = speed * (LEAST_COSINE * distance + 32.0 * position) + noise;
        let inward = end_of(x);
        if inward != 0.0 && self.first(0, inward * jet.gradient(), least) {
            return;
        }
        self.put(jet.hessian(), LEAST_CURVATURE * speed * speed + 4.0 * noise);
    }

    /// A patch at whose side or corner (or inside of which) the place lies; `sharp` is told where slopes are known better
    /// than from `jet`.
    pub fn patch(&mut self, jet: &Jet2, at: [f64; 2], position: f64, sharp: [Option<Along>; 2]) {
        let gradient = jet.gradient();
        let tangents = [jet.s, jet.t];
        let reach = LEAST_COSINE * norm(jet.d) + 32.0 * position;
        let noise = NOISE * norm(jet.d) * position;
        let moves = [0, 1].map(|k| {
            let inward = end_of(at[k]);
            if inward != 0.0 {
                self.sides[k][usize::from(inward < 0.0)] = true;
            }
            let (slope, least) = match sharp[k] {
                Some(along) => (along.slope, reach + along.noise),
                None => (gradient[k], norm(tangents[k]) * reach + noise),
            };
            inward != 0.0 && self.first(k, inward * slope, least)
        });
        let [a, b, c] = jet.hessian();
        let [e, _, g] = jet.metric();
        match moves {
            [true, true] => {}
            [true, false] => self.put(c, LEAST_CURVATURE * g + 4.0 * noise),
            [false, true] => self.put(a, LEAST_CURVATURE * e + 4.0 * noise),
            [false, false] => self.form([a, b, c], [e, dot(jet.s, jet.t), g], 4.0 * noise),
        }
    }

    /// Eigenvalues of the second derivatives relative to the metric.
    fn form(&mut self, [a, b, c]: [f64; 3], [e, f, g]: [f64; 3], noise: f64) {
        let area = e * g - f * f;
        if e.min(g) <= SINGULAR * SINGULAR * e.max(g) {
            self.singular = true;
            return;
        }
        if area <= 1e-12 * e * g {
            self.zero = true;
            return;
        }
        // Roots of det(H - x M): x^2 - 2 m x + d = 0.
        let m = 0.5 * (a * g - 2.0 * b * f + c * e) / area;
        let d = (a * c - b * b) / area;
        let spread = (m * m - d).max(0.0).sqrt();
        for value in [m - spread, m + spread] {
            self.put(value, LEAST_CURVATURE + noise / e.min(g));
        }
    }

    /// Whether the place is not stationary: across some knot line the distance falls on one side and rises on the other.
    pub fn passes(&self) -> bool {
        self.across.contains(&[true, true])
    }

    /// Whether the place lies on a knot line and neither of its sides tells whether the distance rises or falls.
    pub fn is_unclear(&self) -> bool {
        (0..2).any(|k| self.sides[k] == [true; 2] && self.across[k] == [false; 2])
    }

    /// The verdict on a continuum, along which nothing changes: what the signs across it say, if they say anything.
    pub fn nature_across(&self) -> Option<Nature> {
        match (self.up, self.down) {
            (true, true) => Some(Nature::Saddle),
            (true, false) => Some(Nature::Minimum),
            (false, true) => Some(Nature::Maximum),
            (false, false) => None,
        }
    }

    /// Whether the surface is singular at the place, so that neither derivatives nor samples around tell.
    pub fn is_singular(&self) -> bool {
        self.singular
    }

    /// The verdict.
    pub fn nature(&self) -> Nature {
        match (self.up, self.down, self.zero || self.singular) {
            (true, true, _) => Nature::Saddle,
            (_, _, true) => Nature::Flat,
            (true, false, false) => Nature::Minimum,
            (false, true, false) => Nature::Maximum,
            (false, false, false) => Nature::Flat,
        }
    }
}

/// The verdict from squared distances around a place whose own is `here`, all within `tolerance` of rounding.
pub fn from_samples(here: f64, around: impl Iterator<Item = f64>, tolerance: f64) -> Nature {
    let (mut up, mut down) = (false, false);
    for value in around {
        up |= value > here + tolerance;
        down |= value < here - tolerance;
    }
    match (up, down) {
        (true, true) => Nature::Saddle,
        (true, false) => Nature::Minimum,
        (false, true) => Nature::Maximum,
        (false, false) => Nature::Flat,
    }
}
