//! What was trimmed away: the sector about the axis and the arc of the meridian that a shape of revolution takes.
//!
//! ```text
//!      from        beyond an end, at the angle psi from it, distances grow with the angle d from the end on:
//!       /          cos psi - cos (psi + d) = 2 sin^2(d / 2) (cos psi + sin psi cot(d / 2))
//!      /  arc                              >= (1 - cos d) hold,      hold at the arc's whole angle
//!     +----- to
//! ```
//!
//! The table of the parameters proposes the ends; poles prove them (`docs/rounding.md`, section 16). What is not proven
//! is not used: the whole carrier gives a bound too.

use super::deviation::{Moved, TIP};
use super::table::{Table, pseudo_angle, turn};
use super::{Carrier, Direction, Kind, Pieces, length};
use std::f64::consts::FRAC_1_SQRT_2;

/// By how much the sector is opened on either side, in radians: rounding of directions is far below, and so is what it
/// costs in distance.
const OPENED: f64 = 1e-13;
/// A sector that leaves out less than this is the whole.
const LEAST_LEFT_OUT: f64 = 1e-3;

/// Directions from one to another, counterclockwise, less than a full turn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arc {
    from: Direction,
    to: Direction,
    /// Cotangent of half its angle.
    cotangent: f64,
}

/// The end of an arc, seen from a vector beyond it.
pub struct End {
    /// The end.
    pub direction: Direction,
    /// Component of the vector along it.
    pub along: f64,
    /// Component across it, absolute.
    pub aside: f64,
    /// See the head of the module.
    pub hold: f64,
}

impl Arc {
    /// The arc between two directions of length 1.
    pub fn new(from: Direction, to: Direction) -> Self {
        let (sin, cos) = (turn(from, to), from[0] * to[0] + from[1] * to[1]);
        Self { from, to, cotangent: sin / (1.0 - cos) }
    }

    /// The nearer end, when a vector does not point into the arc.
    pub fn beyond(&self, at: Direction) -> Option<End> {
        let (after, before) = (turn(self.from, at) >= 0.0, turn(at, self.to) >= 0.0);
        // Up to half a turn both must hold, beyond it one.
        let inside = if self.cotangent >= 0.0 { after && before } else { after || before };
        if inside {
            return None;
        }
        let along = |end: Direction| end[0] * at[0] + end[1] * at[1];
        let nearer = along(self.from) >= along(self.to);
        let direction = if nearer { self.from } else { self.to };
        let (along, aside) = (along(direction), turn(direction, at).abs());
        let hold = (along + aside * self.cotangent) / length(at);
        // The other end is no nearer, so what is below zero is rounding.
        Some(End { direction, along, aside, hold: hold.max(0.0) })
    }
}

/// `a` turned by a small angle, of length 1.
fn turned(a: Direction, angle: f64) -> Direction {
    let b = [a[0] - angle * a[1], a[1] + angle * a[0]];
    let size = length(b);
    b.map(|x| x / size)
}

/// The direction at a number of eighths of a turn: the pseudo-angle is half the number.
fn diagonal(eighth: usize) -> Direction {
    const SHARES: [f64; 8] =
        [1.0, FRAC_1_SQRT_2, 0.0, -FRAC_1_SQRT_2, -1.0, -FRAC_1_SQRT_2, 0.0, FRAC_1_SQRT_2];
    [SHARES[eighth % 8], SHARES[(eighth + 6) % 8]]
}

/// The carrier with what is known about its trimming. `tables`: those of its two coordinates.
pub fn trimmed(mut carrier: Carrier, pieces: &Pieces, tables: [&Table; 2]) -> Carrier {
    match carrier.kind {
        Kind::Line | Kind::Plane => return carrier,
        Kind::Sphere { radius } => carrier.arc = Some(zone(carrier.bounds[1], radius)),
        Kind::Torus { major, minor } => {
            carrier.arc = tube(&carrier, pieces, tables[1].ends(), major, minor);
        }
        Kind::Circle { .. } | Kind::Cylinder { .. } | Kind::Cone { .. } => {}
    }
    if let Some((arc, moved)) = sector(&carrier, pieces, tables[0].ends()[0]) {
        carrier.sector = Some(arc);
        carrier.deviation += moved;
    }
    carrier
}

/// The meridian of a sphere between two heights.
fn zone([low, high]: [f64; 2], radius: f64) -> Arc {
    let at = |z: f64| {
        let z = (z / radius).clamp(-1.0, 1.0);
        [(1.0 - z * z).max(0.0).sqrt(), z]
    };
    Arc::new(at(low), at(high))
}

/// The angles about the axis in which all poles lie, those of each piece within half a turn, and how far poles were
/// moved onto the axis, where they have no direction.
fn sector(carrier: &Carrier, pieces: &Pieces, start: Direction) -> Option<(Arc, f64)> {
    let from = turned(start, -OPENED);
    let (mut last, mut moved) = ((0.0, from), 0.0f64);
    for k in 0..pieces.rows * pieces.columns {
        let Moved { poles: [x, y, _, w], .. } = Moved::new(&(pieces.piece)(k), carrier);
        let (mut low, mut high) = (4.0f64, 0.0f64);
        for i in 0..w.len() {
            let at = [x[i], y[i]];
            if length(at) <= TIP * w[i] {
                moved = moved.max(2.0 * length(at) / w[i]);
                continue;
            }
            let ahead = from[0] * at[0] + from[1] * at[1];
            let angle = pseudo_angle(ahead, turn(from, at));
            (low, high) = (low.min(angle), high.max(angle));
            if angle > last.0 {
                last = (angle, at);
            }
        }
        // Opposite directions differ by 2.
        if high - low > 2.0 - 1e-6 {
            return None;
        }
    }
    let size = length(last.1);
    let to = turned(last.1.map(|x| x / size), OPENED);
    (last.0 > 0.0 && last.0 < 4.0 - LEAST_LEFT_OUT).then(|| (Arc::new(from, to), moved))
}

/// The angles of a torus's tube, from `ends`, when the ranges of height and distance from the axis leave out all others.
fn tube(
    carrier: &Carrier,
    pieces: &Pieces,
    ends: [Direction; 2],
    major: f64,
    minor: f64,
) -> Option<Arc> {
    let mut out = [f64::INFINITY, f64::NEG_INFINITY];
    for k in 0..pieces.rows * pieces.columns {
        let range = Moved::new(&(pieces.piece)(k), carrier).axis_range()?;
        out = [out[0].min(range[0]), out[1].max(range[1])];
    }
    let margin = 2.0 * carrier.deviation;
    let share = |x: f64| x / minor;
    let x = [share(out[0] - margin - major), share(out[1] + margin - major)];
    let y = carrier.bounds[1].map(share);
    // Where a range ends flat on the circle the other one crosses it: the margins move ends by that much at most.
    let opened = 16.0 * carrier.deviation / minor + 1e-12;
    let (from, to) = (turned(ends[0], -opened), turned(ends[1], opened));
    let (start, mut end) = (pseudo_angle(to[0], to[1]), pseudo_angle(from[0], from[1]));
    if end <= start {
        end += 4.0;
    }
    if end - start < LEAST_LEFT_OUT || end - start > 4.0 - LEAST_LEFT_OUT {
        return None;
    }
    // From the arc's end on to its start, half a quarter by half a quarter: there both coordinates are monotone, and one of
    // them is far from where it is at the opposite side.
    let mut here = to;
    for eighth in (2.0 * start) as usize + 1.. {
        let at = 0.5 * eighth as f64;
        let next = if at < end { diagonal(eighth) } else { from };
        let outside = |k: usize, [low, high]: [f64; 2]| {
            here[k].max(next[k]) < low || here[k].min(next[k]) > high
        };
        if !outside(0, x) && !outside(1, y) {
            return None;
        }
        here = next;
        if at >= end {
            break;
        }
    }
    Some(Arc::new(from, to))
}
