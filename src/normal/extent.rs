//! How well a point fixes its parameters: how far they may move while the point moves by a given length.
//!
//! ```text
//!   v ^   .--.         {(du, dv): |S(u + du, v + dv) - S(u, v)| <= accuracy} around (0, 0)
//!     |  /  . \        near a regular place an ellipse: |du| <= accuracy sqrt(G / (E G - F^2)), dv with E for G
//!     |  \   /         (E, F, G the metric); the answer is the greatest |du| and the greatest |dv|
//!     |   '-'
//!     +---------> u
//! ```
//!
//! The ellipse is believed when its four extreme points are where they should be. Otherwise (cusps, collapsed edges,
//! creases, long steps) each parameter is moved outward, the other one following in the valley of the distance, until
//! the point has moved too far; the last factor is bisected. Right within a factor of two; an excursion that begins
//! and ends between two samples is missed.
//!
//! Limit: below the rounding of positions, and below the gap between parameters, the answer is that of the rounding.

use crate::bounds::{Vector, dot, norm, sub};
use crate::closest::FootPoint;
use crate::curve::Curve;
use crate::jet::Jet1;
use crate::knots::Side;
use crate::refine::{CurveJets, Method, foot_on_curve};
use crate::surface::Surface;

/// The move of a point that confirms an ellipse, as shares of the accuracy: so near to 1 that at twice the step the
/// point has left.
const CONFIRMED: std::ops::RangeInclusive<f64> = 0.85..=1.2;

/// First step of a search, as a share of the room.
const FIRST: f64 = 1.0 / 4_503_599_627_370_496.0;

/// Growth from sample to sample, and how often the last factor is bisected.
const GROWTH: f64 = 4.0;
const BISECTIONS: usize = 5;

/// A determinant of the metric below this share of E G is rounding.
const LEAST_DETERMINANT: f64 = 1e-12;

/// How far the parameter of a foot may move while its point moves by at most `accuracy`: the greater of both directions,
/// at most what the domain leaves (on a closed curve its length). NaN for a foot that has no parameter.
///
/// `closed` is [`Curve::is_closed`], asked once for many feet.
pub fn of_curve(curve: &Curve, closed: bool, foot: &FootPoint, accuracy: f64) -> f64 {
    if !foot.u.is_finite() {
        return f64::NAN;
    }
    let range = Range { ends: curve.domain().into(), closed };
    let home = curve.evaluate(foot.u);
    let way = |sign: f64, side: Side| {
        let room = range.room(foot.u, sign);
        let at = if room > 0.0 { range.moved(foot.u, 0.0, sign) } else { foot.u };
        let mut jet = [[0.0; 3]; 2];
        curve.derivatives_on(at, side, 1, &mut jet);
        let far = |step: f64| norm(sub(curve.evaluate(range.moved(foot.u, step, sign)), home));
        let step = accuracy / norm(jet[1]);
        if step <= room && CONFIRMED.contains(&(far(step) / accuracy)) {
            return step;
        }
        grown(room, step, accuracy, far)
    };
    way(-1.0, Side::Below).max(way(1.0, Side::Above))
}

/// As [`of_curve`], for the two parameters of a surface; `closed`: in u, in v.
pub fn of_surface(
    surface: &Surface,
    closed: [bool; 2],
    foot: &FootPoint,
    accuracy: f64,
) -> [f64; 2] {
    if !(foot.u.is_finite() && foot.v.is_finite()) {
        return [f64::NAN; 2];
    }
    let [u0, u1, v0, v1] = surface.domain();
    let ranges =
        [Range { ends: [u0, u1], closed: closed[0] }, Range { ends: [v0, v1], closed: closed[1] }];
    let home = surface.evaluate(foot.u, foot.v);
    let around = Around { surface, ranges, at: [foot.u, foot.v], home, accuracy };
    around.ellipse().unwrap_or_else(|| [0, 1].map(|k| around.search(k)))
}

/// The values of one parameter.
#[derive(Clone, Copy)]
struct Range {
    ends: [f64; 2],
    closed: bool,
}

impl Range {
    fn length(&self) -> f64 {
        self.ends[1] - self.ends[0]
    }

    /// How far `x` can go up (1) or down (-1).
    fn room(&self, x: f64, sign: f64) -> f64 {
        if self.closed {
            self.length()
        } else if sign < 0.0 {
            x - self.ends[0]
        } else {
            self.ends[1] - x
        }
    }

    /// The parameter a step away, across the seam of a closed direction, inside the ends otherwise.
    fn moved(&self, x: f64, step: f64, sign: f64) -> f64 {
        let [low, high] = self.ends;
        let to = x + sign * step;
        let to = match self.closed {
            true if to > high || to == high && sign > 0.0 => to - self.length(),
            true if to < low || to == low && sign < 0.0 => to + self.length(),
            _ => to,
        };
        to.clamp(low, high)
    }
}

/// The greatest step up to `room` that moves the point by at most `accuracy`, by growing samples; `linear`: what the first
/// derivative says.
fn grown(room: f64, linear: f64, accuracy: f64, mut far: impl FnMut(f64) -> f64) -> f64 {
    let (mut inside, mut step) = (0.0, (FIRST * room).min(0.25 * linear).max(f64::MIN_POSITIVE));
    while far(step) <= accuracy {
        if step >= room {
            return room;
        }
        inside = step;
        step = (step * GROWTH).min(room);
    }
    if inside == 0.0 {
        return step;
    }
    let mut outside = step;
    for _ in 0..BISECTIONS {
        let middle = (inside * outside).sqrt();
        if far(middle) <= accuracy { inside = middle } else { outside = middle }
    }
    inside
}

/// A surface around one foot.
struct Around<'a> {
    surface: &'a Surface,
    ranges: [Range; 2],
    at: [f64; 2],
    home: Vector,
    accuracy: f64,
}

impl Around<'_> {
    /// The extents of the metric's ellipse, if its extreme points lie where they should.
    fn ellipse(&self) -> Option<[f64; 2]> {
        let mut jet = [[0.0; 3]; 3];
        self.surface.partials(self.at[0], self.at[1], 1, &mut jet);
        let [e, f, g] = [dot(jet[1], jet[1]), dot(jet[1], jet[2]), dot(jet[2], jet[2])];
        let determinant = e * g - f * f;
        if determinant.is_nan() || determinant <= LEAST_DETERMINANT * e * g {
            return None;
        }
        let extents = [g, e].map(|m| self.accuracy * (m / determinant).sqrt());
        let slopes = [-f / g, -f / e];
        let mut most = [0.0; 2];
        for k in 0..2 {
            for sign in [-1.0, 1.0] {
                let room = self.ranges[k].room(self.at[k], sign);
                if room > 0.0 && !self.is_confirmed(k, sign * extents[k], slopes[k], room) {
                    return None;
                }
                most[k] = extents[k].min(room).max(most[k]);
            }
        }
        Some(most)
    }

    /// Whether the point moves by about the accuracy at an extreme point of the ellipse.
    fn is_confirmed(&self, k: usize, step: f64, slope: f64, room: f64) -> bool {
        // Where the domain ends the ellipse is cut: its share is looked at.
        let share = (room / step.abs()).min(1.0);
        let mut to = [share * step; 2];
        to[1 - k] = share * step * slope;
        let other = to[1 - k];
        if self.ranges[1 - k].room(self.at[1 - k], other) < other.abs() {
            return false;
        }
        let at = [0, 1].map(|i| self.ranges[i].moved(self.at[i], to[i].abs(), to[i].signum()));
        let moved = norm(sub(self.surface.evaluate(at[0], at[1]), self.home));
        let ratio = moved / (share * self.accuracy);
        if share < 1.0 { ratio <= *CONFIRMED.end() } else { CONFIRMED.contains(&ratio) }
    }

    /// The extent in direction `k`, by growing steps with the other parameter in the valley.
    fn search(&self, k: usize) -> f64 {
        let mut jet = [[0.0; 3]; 3];
        self.surface.partials(self.at[0], self.at[1], 1, &mut jet);
        let linear = self.accuracy / norm(jet[1 + k]);
        let way = |sign: f64| {
            let mut valley = Valley { around: self, fixed: k, value: self.at[k] };
            let other = self.ranges[1 - k];
            let reach = if other.closed {
                let half = 0.5 * other.length();
                [self.at[1 - k] - half, self.at[1 - k] + half]
            } else {
                other.ends
            };
            let mut start = self.at[1 - k];
            let room = self.ranges[k].room(self.at[k], sign);
            grown(room, linear, self.accuracy, |step| {
                valley.value = self.ranges[k].moved(self.at[k], step, sign);
                let stay = norm(valley.jet(self.at[1 - k]).d);
                if stay <= self.accuracy {
                    return stay;
                }
                let (x, jet, _) = foot_on_curve(&valley, start, reach, Method::Auto, None);
                let far = norm(jet.d);
                if far <= self.accuracy {
                    start = x;
                }
                far
            })
        };
        way(-1.0).max(way(1.0))
    }
}

/// The isocurve across the direction that is moved, seen from the foot.
struct Valley<'a> {
    around: &'a Around<'a>,
    fixed: usize,
    value: f64,
}

impl CurveJets for Valley<'_> {
    fn jet(&self, s: f64) -> Jet1 {
        let range = self.around.ranges[1 - self.fixed];
        let free = range.moved(s, 0.0, 0.0);
        let mut at = [self.value; 2];
        at[1 - self.fixed] = free;
        let mut out = [[0.0; 3]; 6];
        self.around.surface.partials(at[0], at[1], 2, &mut out);
        let [first, second] = if self.fixed == 0 { [2, 5] } else { [1, 3] };
        Jet1 { d: sub(out[0], self.around.home), s: out[first], ss: out[second], w: [1.0, 0.0] }
    }

    fn global(&self, s: f64) -> [f64; 2] {
        [s, 0.0]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn foot(u: f64, v: f64) -> FootPoint {
        FootPoint { u, v, ..FootPoint::unreached() }
    }

    #[test]
    fn at_a_cusp_the_parameter_is_loose_by_the_root_of_the_accuracy() {
        // (t^2, t^3) on -1 .. 1.
        let poles = [[1., -1., 0.], [-1. / 3., 1., 0.], [-1. / 3., -1., 0.], [1., 1., 0.]];
        let knots = [-1., -1., -1., -1., 1., 1., 1., 1.];
        let curve = Curve::new(&knots, 3, &poles, None).unwrap();
        let at = |u: f64, accuracy: f64| of_curve(&curve, false, &foot(u, 0.0), accuracy);
        for accuracy in [1e-4, 1e-8, 1e-12] {
            let ratio = at(0.0, accuracy) / accuracy.sqrt();
            assert!((0.5..=2.0).contains(&ratio), "{accuracy}: {ratio}");
        }
        // At 1/2 the speed is (1, 3/4).
        assert!((at(0.5, 1e-6) * 1.25e6 - 1.0).abs() < 1e-3);
        assert_eq!(at(0.5, 100.0), 1.5);
        // Below the grain of the parameters.
        assert!(at(0.5, 1e-320) < 1e-15 && at(0.0, 1e-320) < 1e-7);
    }

    #[test]
    fn on_a_skew_plane_the_extents_are_those_of_the_ellipse() {
        // x = u + v, y = v / 10: E = 1, F = 1, G = 1.01.
        let poles = [[0., 0., 0.], [1., 0.1, 0.], [1., 0., 0.], [2., 0.1, 0.]];
        let line = [0., 0., 1., 1.];
        let plane = Surface::new(&line, &line, 1, 1, &poles, 2, 2, None).unwrap();
        let [du, dv] = of_surface(&plane, [false; 2], &foot(0.5, 0.5), 1e-3);
        assert!((du / (1e-3 * (1.01f64 / 0.01).sqrt()) - 1.0).abs() < 1e-9, "{du}");
        assert!((dv / (1e-3 * (1.0f64 / 0.01).sqrt()) - 1.0).abs() < 1e-9, "{dv}");
        let [du, dv] = of_surface(&plane, [false; 2], &foot(0.0, 0.5), 1.0);
        assert_eq!([du, dv], [1.0, 0.5]);
    }
}
