//! A region of the domain: closed chains of rational Bezier pieces, and on which side of them a place lies.
//!
//! ```text
//!            .--.        a ray from the place towards greater u
//!       o---/----\--->   a piece in whose box the place does not lie is as good as its chord: only the ends' v count
//!          /      \      a piece in whose box it lies is halved, until it is not, or the box is rounding
//! ```
//!
//! Every decision compares two doubles: no product is rounded. The ends of pieces are the same bits for both
//! neighbours and the half-open rule (v <= place counts as below) counts each once, so that the number of crossings is that
//! of a closed chain. Where a chain is not closed, lines close it. A place is inside when the number is odd.
//!
//! Reference: Haines, *Point in polygon strategies*, Graphics Gems IV, 1994 (the crossing rule); Nishita, Sederberg,
//! Kakimoto, *Ray tracing trimmed rational surface patches*, 1990 (halving in the box).
//! Limit: a place nearer to a curve than the rounding of its poles, some 1e-13 of their size, is on it.

use crate::bezier::{Bidegree, halve_t};
use crate::bounds::HALF_ULP;
use crate::curve::Curve;
use crate::error::Error;
use crate::pcurve::compose::arc;

/// Half ulps of the largest coordinate, for each pole of a piece, that extraction and 48 halvings may move a pole by; and for all of
/// them together (`docs/rounding.md`).
const EACH_POLE: usize = 116;
const ALL_POLES: usize = 32;

/// Where a place lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// In the region.
    Inside,
    /// Not in it.
    Outside,
    /// On its border, as far as doubles can tell.
    Border,
}

/// A rational Bezier piece of a border.
#[derive(Clone, Debug)]
struct Piece {
    homogeneous: Net,
    first: [f64; 2],
    last: [f64; 2],
    bounds: [f64; 4],
    /// How far rounding may move what is computed from the coefficients.
    error: f64,
}

/// Closed chains in the plane.
#[derive(Clone, Debug, Default)]
pub struct Region {
    pieces: Vec<Piece>,
    bounds: [f64; 4],
}

/// Memory for halving.
#[derive(Clone, Debug, Default)]
pub struct Halving {
    waiting: Vec<(Net, [f64; 2], [f64; 2])>,
    spare: Vec<Net>,
}

/// Coefficients of weight times u, weight times v, weight.
type Net = [Vec<f64>; 3];

impl Region {
    /// The region inside of closed chains of splines (u, v, 0).
    ///
    /// # Errors
    /// Memory that could not be had.
    pub fn new<'a, C>(chains: impl IntoIterator<Item = C>) -> Result<Self, Error>
    where
        C: IntoIterator<Item = &'a Curve>,
    {
        let mut region = Self::default();
        for chain in chains {
            let begin = region.pieces.len();
            for curve in chain {
                region.push_curve(curve, begin);
            }
            if let (Some(first), Some(last)) = (region.pieces.get(begin), region.pieces.last()) {
                let (from, to) = (last.last, first.first);
                region.push_line(from, to);
            }
        }
        region.bounds = [f64::INFINITY, f64::NEG_INFINITY, f64::INFINITY, f64::NEG_INFINITY];
        for piece in &region.pieces {
            for k in 0..2 {
                region.bounds[2 * k] = region.bounds[2 * k].min(piece.bounds[2 * k]);
                region.bounds[2 * k + 1] = region.bounds[2 * k + 1].max(piece.bounds[2 * k + 1]);
            }
        }
        Ok(region)
    }

    fn push_curve(&mut self, curve: &Curve, begin: usize) {
        let p = curve.degree();
        for span in curve.knots().spans() {
            let ends = [curve.knots().values()[span], curve.knots().values()[span + 1]];
            let center = curve.poles()[span - p / 2];
            let piece = arc(curve, span, ends, center);
            let place = |k: usize| {
                let (n, w) = (piece.numerator[k], piece.weights[k]);
                [center[0] + n[0] / w, center[1] + n[1] / w]
            };
            let mut places: Vec<[f64; 2]> = (0..=p).map(place).collect();
            // A clamped end is its pole; the next piece begins where this one ends.
            if ends[0] == curve.knots().domain().0 {
                let start = curve.evaluate(ends[0]);
                places[0] = [start[0], start[1]];
                if let Some(before) = self.pieces[begin..].last() {
                    let from = before.last;
                    self.push_line(from, places[0]);
                }
            } else if let Some(before) = self.pieces.last() {
                places[0] = before.last;
            }
            if ends[1] == curve.knots().domain().1 {
                let end = curve.evaluate(ends[1]);
                places[p] = [end[0], end[1]];
            }
            self.push(&places, &piece.weights);
        }
    }

    /// A line that closes a gap, if there is one.
    fn push_line(&mut self, from: [f64; 2], to: [f64; 2]) {
        if from != to {
            self.push(&[from, to], &[1.0, 1.0]);
        }
    }

    fn push(&mut self, places: &[[f64; 2]], weights: &[f64]) {
        let column = |k: usize| places.iter().zip(weights).map(|(p, w)| w * p[k]).collect();
        let largest = places.iter().flatten().fold(0.0, |most: f64, x| most.max(x.abs()));
        let error = (EACH_POLE * places.len() + ALL_POLES) as f64 * HALF_ULP * largest;
        let bounds = hull(places.iter().copied());
        let (first, last) = (places[0], places[places.len() - 1]);
        let homogeneous = [column(0), column(1), weights.to_vec()];
        self.pieces.push(Piece { homogeneous, first, last, bounds, error });
    }

    /// The box u0, u1, v0, v1 around the region.
    pub fn bounds(&self) -> [f64; 4] {
        self.bounds
    }

    /// Whether a border may run through a box u0, u1, v0, v1; false is certain.
    pub fn may_cross(&self, area: &[f64; 4]) -> bool {
        self.pieces.iter().any(|piece| {
            let [u0, u1, v0, v1] = grown(piece.bounds, piece.error);
            u0 <= area[1] && area[0] <= u1 && v0 <= area[3] && area[2] <= v1
        })
    }

    /// On which side of its borders a place lies.
    pub fn side(&self, at: [f64; 2], memory: &mut Halving) -> Side {
        let mut odd = false;
        for piece in &self.pieces {
            let [u0, u1, v0, v1] = grown(piece.bounds, piece.error);
            if at[1] < v0 || at[1] > v1 || at[0] > u1 {
                continue;
            }
            if at[0] < u0 {
                odd ^= passes(piece.first, piece.last, at);
                continue;
            }
            match piece.crossings(at, memory) {
                Some(crossed) => odd ^= crossed,
                None => return Side::Border,
            }
        }
        if odd { Side::Inside } else { Side::Outside }
    }
}

/// Whether the ends lie on different sides of the ray's line.
fn passes(first: [f64; 2], last: [f64; 2], at: [f64; 2]) -> bool {
    (first[1] <= at[1]) != (last[1] <= at[1])
}

fn hull(places: impl Iterator<Item = [f64; 2]>) -> [f64; 4] {
    let empty = [f64::INFINITY, f64::NEG_INFINITY, f64::INFINITY, f64::NEG_INFINITY];
    places.fold(empty, |[u0, u1, v0, v1], [u, v]| [u0.min(u), u1.max(u), v0.min(v), v1.max(v)])
}

fn grown([u0, u1, v0, v1]: [f64; 4], error: f64) -> [f64; 4] {
    [u0 - error, u1 + error, v0 - error, v1 + error]
}

impl Piece {
    /// Whether the ray from a place in the box crosses the piece an odd number of times; `None` on the piece.
    fn crossings(&self, at: [f64; 2], memory: &mut Halving) -> Option<bool> {
        let degree = Bidegree { s: 0, t: self.homogeneous[0].len() - 1 };
        // Halves never lose their own ends: those of the whole stay the caller's bits.
        let mut odd = false;
        let mut here = memory.take();
        for (own, given) in here.iter_mut().zip(&self.homogeneous) {
            own.clear();
            own.extend_from_slice(given);
        }
        let mut ends = std::mem::take(&mut memory.waiting);
        ends.push((here, self.first, self.last));
        let mut on = false;
        while let Some((mut low, first, last)) = ends.pop() {
            let place = |c: &Net, k: usize| [c[0][k] / c[2][k], c[1][k] / c[2][k]];
            let inner = (1..degree.t).map(|k| place(&low, k));
            let tight = hull(inner.chain([first, last]));
            let [u0, u1, v0, v1] = grown(tight, self.error);
            if on || at[1] < v0 || at[1] > v1 || at[0] > u1 {
                memory.spare.push(low);
                continue;
            }
            if at[0] < u0 {
                odd ^= passes(first, last, at);
                memory.spare.push(low);
                continue;
            }
            if tight[1] - tight[0] <= self.error && tight[3] - tight[2] <= self.error {
                on = true;
                memory.spare.push(low);
                continue;
            }
            let mut high = memory.take();
            for (low, high) in low.iter_mut().zip(&mut high) {
                high.clear();
                high.resize(degree.t + 1, 0.0);
                halve_t(low, high, degree);
            }
            let middle = place(&high, 0);
            ends.push((high, middle, last));
            ends.push((low, first, middle));
        }
        memory.waiting = ends;
        (!on).then_some(odd)
    }
}

impl Halving {
    fn take(&mut self) -> Net {
        self.spare.pop().unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(x: f64, y: f64, size: f64) -> Curve {
        let poles = [[x, y], [x + size, y], [x + size, y + size], [x, y + size], [x, y]];
        let poles: Vec<[f64; 3]> = poles.iter().map(|p| [p[0], p[1], 0.0]).collect();
        Curve::new(&[0., 0., 1., 2., 3., 4., 4.], 1, &poles, None).unwrap()
    }

    #[test]
    fn a_square_with_a_hole_knows_its_sides_corners_and_borders() {
        let (outer, hole) = (square(0.0, 0.0, 3.0), square(1.0, 1.0, 1.0));
        let region = Region::new([[&outer], [&hole]]).unwrap();
        let mut memory = Halving::default();
        let mut side = |u: f64, v: f64| region.side([u, v], &mut memory);
        for (u, v) in [(0.5, 0.5), (0.5, 1.0), (2.5, 2.0), (1.5, 0.999), (0.999, 1.0)] {
            assert_eq!(side(u, v), Side::Inside, "{u} {v}");
        }
        for (u, v) in [(1.5, 1.5), (-1.0, 0.0), (-1.0, 3.0), (4.0, 1.0), (1.5, -1.0), (-1.0, 1.0)] {
            assert_eq!(side(u, v), Side::Outside, "{u} {v}");
        }
        for (u, v) in [(0.0, 0.0), (3.0, 1.7), (1.0, 1.5), (1.0, 1.0), (2.0, 2.0), (0.3, 3.0)] {
            assert_eq!(side(u, v), Side::Border, "{u} {v}");
        }
    }

    #[test]
    fn an_open_chain_is_closed_by_a_line() {
        let open = Curve::new(
            &[0., 0., 1., 2., 2.],
            1,
            &[[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
            None,
        );
        let region = Region::new([[&open.unwrap()]]).unwrap();
        let mut memory = Halving::default();
        assert_eq!(region.side([0.2, 0.2], &mut memory), Side::Inside);
        assert_eq!(region.side([0.6, 0.6], &mut memory), Side::Outside);
        assert_eq!(region.side([-0.1, 0.5], &mut memory), Side::Outside);
    }
}
