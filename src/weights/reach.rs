//! Distances that no weights in the range can give: proofs that a wish is impossible.
//!
//! With weights between `a` and `b`, a point is the mean of the local poles with shares that the range bounds.
//!
//! *Too far.* At fixed parameters `|C - P_k| <= sum R_j |P_j - P_k|`. The right side is greatest when poles beyond some length have
//! weight `b` and the others `a`, so that the local poles in the order of their distance give all candidates. The
//! least of the greatest values over some parameters bounds the distance of every such shape.
//!
//! *Too near.* `C - P_k = beta (Q - P_k)` with `Q` in the hull of the other local poles, and
//!
//! ```text
//!   beta >= (1 - N) a / ((1 - N) a + N b),    N = the greatest N_k on the piece
//! ```
//!
//! `|Q - P_k|` is at least what any direction separates of the hull; the direction only has to be good, not exact.
//!
//! Rounding: `docs/rounding.md`, section 18.

use super::net::{Net, Share};
use crate::bezier::extraction;
use crate::bounds::{Aabb, Vector, add, dot, norm, scaled, sub};
use crate::knots::Knots;

/// What bounds are loosened by, relative to the largest coordinate of the net and to its diagonal.
const SLACK: f64 = 1e-12;

/// Parts that a span is cut into; fewer on surfaces, so that there are not more than some [`MOST_PIECES`].
const PARTS: usize = 8;
const MOST_PIECES: usize = 10_000;

/// Steps towards the point of a hull that is nearest to a pole.
const HULL_STEPS: usize = 30;

/// A part of the domain: its local poles and a bound of each one's basis function there.
struct Piece {
    greatest: Vec<Share>,
    bounds: Aabb,
}

/// Bounds of distances over all weights in a range.
pub struct Reach<'a> {
    net: Net<'a>,
    range: [f64; 2],
    pieces: Vec<Piece>,
    places: Vec<Vec<Share>>,
    slack: f64,
}

impl<'a> Reach<'a> {
    pub fn new(net: Net<'a>, range: [f64; 2]) -> Self {
        let [u, v] = net.knots();
        let spans = |knots: Option<&Knots>| knots.map_or(1, |knots| knots.spans().count());
        let fits = |cuts: &usize| v.is_none() || spans(u) * spans(v) * cuts * cuts <= MOST_PIECES;
        let cuts = [PARTS, PARTS / 2, PARTS / 4].into_iter().find(fits).unwrap_or(1);
        let (mut pieces, width) = (Vec::new(), net.width());
        let parts_v = v.map(|knots| parts(knots, cuts));
        for a in u.map(|knots| parts(knots, cuts)).unwrap_or_default() {
            let Some(parts_v) = &parts_v else {
                pieces.push(Piece::new(&net, a));
                continue;
            };
            for b in parts_v {
                let pair = |&(i, n): &Share| b.iter().map(move |&(j, m)| (i * width + j, n * m));
                pieces.push(Piece::new(&net, a.iter().flat_map(pair).collect()));
            }
        }
        let mut places = Vec::new();
        for u in u.map(|knots| parameters(knots, cuts)).unwrap_or_default() {
            for v in v.map_or(vec![0.0], |knots| parameters(knots, cuts)) {
                let mut shares = Vec::new();
                net.shares([u, v], &mut shares);
                places.push(shares);
            }
        }
        let far = net.poles().iter().flatten().fold(0.0, |far: f64, x| far.max(x.abs()));
        Self { net, range, pieces, places, slack: SLACK * (far + net.diagonal()) }
    }

    /// No weights of the range give a greater distance from pole `k`.
    pub fn greatest(&self, k: usize) -> f64 {
        let least = |least: f64, place: &Vec<Share>| least.min(self.farthest(k, place));
        self.places.iter().fold(f64::INFINITY, least) + self.slack
    }

    /// The greatest `sum R_j |P_j - P_k|` at one place.
    fn farthest(&self, k: usize, place: &[Share]) -> f64 {
        let (poles, [low, high]) = (self.net.poles(), self.range);
        let mut lengths: Vec<(f64, f64)> =
            place.iter().map(|&(j, n)| (norm(sub(poles[j], poles[k])), n)).collect();
        lengths.sort_by(|a, b| b.0.total_cmp(&a.0));
        let value = |heavy: usize| {
            let each = lengths.iter().enumerate();
            let terms = each.map(|(i, (d, n))| (d, n * if i < heavy { high } else { low }));
            let (top, bottom) =
                terms.fold((0.0, 0.0), |(top, bottom), (d, w)| (top + d * w, bottom + w));
            top / bottom
        };
        (0..=lengths.len()).map(value).fold(0.0, f64::max)
    }

    /// No weights of the range give a lesser distance from pole `k`.
    pub fn least(&self, k: usize) -> f64 {
        let mut least = f64::INFINITY;
        for piece in &self.pieces {
            // A box beyond what is known already cannot hold less.
            if piece.box_distance(self.net.poles()[k]) * (1.0 - 1e-14) < least {
                least = least.min(self.nearest(k, piece));
            }
        }
        (least - self.slack).max(0.0)
    }

    fn nearest(&self, k: usize, piece: &Piece) -> f64 {
        let (poles, [low, high]) = (self.net.poles(), self.range);
        let own = piece.greatest.iter().find(|(j, _)| *j == k).map_or(0.0, |(_, n)| *n);
        let rest = (1.0 - own).max(0.0) * low;
        let share = rest / (rest + own * high);
        if share <= 0.0 || share.is_nan() {
            return 0.0;
        }
        let others = piece.greatest.iter().filter(|(j, _)| *j != k);
        let away: Vec<Vector> = others.map(|(j, _)| sub(poles[*j], poles[k])).collect();
        share * separation(&away)
    }
}

impl Piece {
    fn new(net: &Net, greatest: Vec<Share>) -> Self {
        let mut bounds = Aabb::EMPTY;
        greatest.iter().for_each(|(j, _)| bounds.include(net.poles()[*j]));
        Self { greatest, bounds }
    }

    /// The distance of a point from the box of the local poles.
    fn box_distance(&self, point: Vector) -> f64 {
        let Aabb { low, high } = self.bounds;
        let beyond = |axis: usize| (low[axis] - point[axis]).max(point[axis] - high[axis]).max(0.0);
        norm([beyond(0), beyond(1), beyond(2)])
    }
}

/// A lower bound of the distance of the hull of some points from the origin.
fn separation(points: &[Vector]) -> f64 {
    let Some(&first) = points.first() else { return f64::INFINITY };
    let (mut near, mut best) = (first, 0.0_f64);
    for _ in 0..HULL_STEPS {
        let length = norm(near);
        if length <= 0.0 {
            return best;
        }
        let direction = scaled(near, 1.0 / length);
        let (mut least, mut corner) = (f64::INFINITY, first);
        for &point in points {
            let along = dot(direction, point);
            if along < least {
                (least, corner) = (along, point);
            }
        }
        best = best.max(least);
        // To the nearest point of the segment from here to the corner that is least along the direction.
        let way = sub(corner, near);
        let square = dot(way, way);
        if least >= length * (1.0 - 1e-12) || square <= 0.0 {
            break;
        }
        near = add(near, scaled(way, (-dot(near, way) / square).clamp(0.0, 1.0)));
    }
    best
}

/// Parameters at which distances are bounded: the ends of the spans and some between.
fn parameters(knots: &Knots, cuts: usize) -> Vec<f64> {
    let mut out = Vec::new();
    for span in knots.spans() {
        let (a, b) = (knots.values()[span], knots.values()[span + 1]);
        out.extend((0..cuts).map(|i| a + (b - a) * (i as f64 / cuts as f64)));
    }
    out.push(knots.domain().1);
    out
}

/// The parts of all spans, each with a bound of the basis functions on it: the greatest Bernstein coefficient.
fn parts(knots: &Knots, cuts: usize) -> Vec<Vec<Share>> {
    let (p, mut out) = (knots.degree(), Vec::new());
    let mut matrix = vec![0.0; (p + 1) * (p + 1)];
    for span in knots.spans() {
        let (a, b) = (knots.values()[span], knots.values()[span + 1]);
        let at = |i: usize| if i == cuts { b } else { a + (b - a) * (i as f64 / cuts as f64) };
        for i in 0..cuts {
            if at(i) < at(i + 1) {
                extraction(knots, span, [at(i), at(i + 1)], &mut matrix);
                let column = |j: usize| matrix.iter().skip(j).step_by(p + 1);
                let most = |j: usize| column(j).fold(0.0, |most: f64, x| most.max(*x));
                out.push(
                    (0..=p).map(|j| (span - p + j, (most(j) * (1.0 + 1e-13)).min(1.0))).collect(),
                );
            }
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_hull_is_separated_by_its_distance() {
        let square = [[1.0, -1.0, 0.0], [1.0, 1.0, 0.0], [3.0, 1.0, 0.0], [3.0, -1.0, 0.0]];
        assert!((separation(&square) - 1.0).abs() < 1e-9);
        let around = [[1.0, 0.0, 0.0], [-1.0, 1.0, 0.0], [-1.0, -1.0, 0.0]];
        assert_eq!(separation(&around), 0.0);
        assert_eq!(separation(&[]), f64::INFINITY);
    }
}
