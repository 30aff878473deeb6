//! The proof at once: the foot's normal is short enough that nothing else on the surface can be as near.

use super::certificate::slope_error;
use super::proof::Site;
use crate::bezier::Bidegree;
use crate::bounds::{HALF_ULP, add, cross, dot, norm, scaled, sub};
use crate::index::{CurveReach, Reach};
use crate::jet::{Jet1, Jet2};

/// What must be left of `1 - 2 a K`: less says too little of feet that tie.
const LEAST_ROOM: f64 = 0.0625;

/// A lower bound of the distance to the whole surface within `gap` of that of a place with this jet, where there is one (see
/// [`Reach`]): then nothing else is as near. `position`: how far the point may be off.
pub fn settled(
    reach: Option<&Reach>,
    site: Site,
    jet: &Jet2,
    position: f64,
    degree: Bidegree,
    gap: f64,
) -> Option<f64> {
    let bound = bound(reach?, site, jet, position, [degree.s, degree.t]);
    // Not where the iteration has left more than the gap.
    bound.filter(|b| *b >= norm(jet.d) - gap)
}

/// A lower bound of the distance to the whole surface, if the place of the jet gives one.
///
/// With `q - f = a N + b o + e` (o the outward conormal, where the place is on a side of the surface, b >= 0):
/// `|x - q|^2 >= |q - f|^2 + r^2 room - 2 |e| r` for `r = |x - f|` and `room = 1 - 2 (|a| K + b K_o)`, so the square is less
/// than that of the foot by `|e|^2 / room` at most. A kink adds what it is worth for both parts to `|e|`, and so does a gap.
fn bound(
    reach: &Reach,
    Site { piece: k, at }: Site,
    jet: &Jet2,
    position: f64,
    degrees: [usize; 2],
) -> Option<f64> {
    let d = norm(jet.d);
    let normal = cross(jet.s, jet.t);
    let tangents = [jet.s, jet.t];
    let (w, speeds) = (jet.w[0], tangents.map(norm));
    // `slope_error` bounds more than the rounding of the product of d with a derivative, times w^2.
    let slacks =
        [0, 1].map(|k| slope_error(d, speeds[k], w, position, degrees[k]) / (w * w * speeds[k]));
    // How far along a tangent the query is.
    let aside = |k: usize| dot(jet.d, tangents[k]).abs() / speeds[k] + slacks[k];
    let (across, along) = (norm(normal) / speeds[1], norm(normal) / speeds[0]);
    let turned = 4.0 * (slacks[0] * speeds[0] / across + slacks[1] * speeds[1] / along);
    let off = position + 1e-9 * d + turned;
    // The jet looks from the query to the foot.
    let height = -dot(jet.d, normal) / norm(normal);
    let [above, below] = reach.bend(k, at);
    let bend = if height > off {
        above
    } else if height < -off {
        below
    } else {
        above.max(below)
    };
    let sides = reach.sides(k, at);
    let (asked, lost) = match (0..4).find(|&side| sides[side]) {
        None => {
            let angle = 1.0 - dot(jet.s, jet.t).abs() / (speeds[0] * speeds[1]);
            let (a, b) = (aside(0), aside(1));
            ((d + position) * bend, (a * a + b * b) / (angle * (1.0 - 1e-9)))
        }
        Some(side) => {
            let (across, along) = (tangents[side / 2], tangents[1 - side / 2]);
            let rest = sub(across, scaled(along, dot(across, along) / dot(along, along)));
            let out = dot(jet.d, rest) / norm(rest) * if side % 2 == 0 { 1.0 } else { -1.0 };
            let corner = (side + 1..4).any(|other| sides[other]);
            if out.is_nan() || out < 0.0 || corner {
                return None;
            }
            // An outward part that may be none may also be an inward one.
            let a = aside(1 - side / 2) + if out < off { 2.0 * off } else { 0.0 };
            ((height.abs() + off) * bend + (out + off) * reach.rim(k, at, side), a * a)
        }
    };
    let room = 1.0 - 2.0 * asked * (1.0 + 1e-12);
    if room.is_nan() || room < LEAST_ROOM {
        return None;
    }
    let lost = lost.sqrt() + 2.0 * reach.kink * d + reach.gap;
    let less = lost * lost / room + 4.0 * reach.gap * d;
    let square = (d - position).max(0.0) * (1.0 - 8.0 * HALF_ULP);
    let bound = (square * square - less).max(0.0).sqrt() * (1.0 - 4.0 * HALF_ULP);
    // Not where the tangents vanish or agree.
    lost.is_finite().then_some(bound)
}

/// As [`settled`], for a curve.
pub fn settled_on_curve(
    reach: Option<&CurveReach>,
    site: Site,
    jet: &Jet1,
    position: f64,
    degree: usize,
    gap: f64,
) -> Option<f64> {
    let bound = bound_on_curve(reach?, site, jet, position, degree);
    bound.filter(|b| *b >= norm(jet.d) - gap)
}

/// A lower bound of the distance to the whole curve, if the place of the jet gives one.
///
/// With `q - f = n + b o + e` (n across, o the outward tangent at an end, b >= 0, e along the curve) as for a surface;
/// a tangent that breaks by `kink` adds to `|e|` what it is worth for both parts of n, and so does a gap between ends.
fn bound_on_curve(
    reach: &CurveReach,
    Site { piece: k, at }: Site,
    jet: &Jet1,
    position: f64,
    degree: usize,
) -> Option<f64> {
    let (d, speed, w) = (norm(jet.d), norm(jet.s), jet.w[0]);
    let slack = slope_error(d, speed, w, position, degree) / (w * w * speed);
    let tangent = scaled(jet.s, 1.0 / speed);
    let along = -dot(jet.d, tangent);
    let across = scaled(add(jet.d, scaled(tangent, along)), -1.0);
    let off = position + 1e-9 * d + 4.0 * slack;
    let mut asked = reach.asked(k, at[0], tangent, across, off);
    let mut lost = along.abs() + slack;
    if let Some((side, bend)) = reach.end(k, at[0]) {
        let out = if side == 0 { -along } else { along };
        if out >= 0.0 {
            asked += (out + off) * bend;
            // An outward part that may be none may also be an inward one.
            lost = slack + if out < off { 2.0 * off } else { 0.0 };
        }
    }
    lost += 1.5 * reach.kink * d + reach.gap;
    let room = 1.0 - 2.0 * asked * (1.0 + 1e-12);
    if room.is_nan() || room < LEAST_ROOM {
        return None;
    }
    let square = (d - position).max(0.0) * (1.0 - 8.0 * HALF_ULP);
    let less = lost * lost / room + 4.0 * reach.gap * d;
    let bound = (square * square - less).max(0.0).sqrt() * (1.0 - 4.0 * HALF_ULP);
    lost.is_finite().then_some(bound)
}
