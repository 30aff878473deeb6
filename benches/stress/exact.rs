//! The verdict beyond rounding: de Boor's recursion and Newton's iteration in doubled precision, on the data as they
//! were given.

use super::design::Design;
use super::double::Double;
use super::pieces::{Homogeneous, Pieces, Place, homogeneous, mix};
use super::search::square;
use super::shapes::{Vector, dot};

/// A place with parameters in doubled precision, and the distance there.
#[derive(Clone, Copy, Debug)]
pub struct Verdict {
    pub at: [Double; 2],
    pub distance: f64,
}

type Wide = [Double; 3];

/// Vector from the query to the point, and its derivatives in the caller's parameters.
struct Slopes {
    d: Wide,
    u: Wide,
    v: Wide,
}

pub struct Exact<'a> {
    pub design: &'a Design,
    pub pieces: &'a Pieces,
    /// u0, u1, v0, v1
    pub area: [f64; 4],
}

fn scalar(a: &Wide, b: &Wide) -> Double {
    (0..3).fold(Double::ZERO, |sum, k| sum.plus(a[k].times(b[k])))
}

/// Value and derivative of a spline of homogeneous points on one span, by de Boor's recursion.
fn recursion(
    knots: &[f64],
    degree: usize,
    span: usize,
    x: Double,
    row: &mut [Homogeneous],
) -> [Homogeneous; 2] {
    let mut slope = [Double::ZERO; 4];
    for level in 1..=degree {
        if level == degree {
            let length = Double::sum(knots[span + 1], -knots[span]).over(Double::of(degree as f64));
            slope = [0, 1, 2, 3].map(|c| row[degree][c].minus(row[degree - 1][c]).over(length));
        }
        for k in (level..=degree).rev() {
            let i = span + k - degree;
            let (low, high) = (knots[i], knots[i + degree + 1 - level]);
            let share = x.minus(Double::of(low)).over(Double::sum(high, -low));
            row[k] = mix(&row[k - 1], &row[k], share);
        }
    }
    [row[degree], slope]
}

impl Exact<'_> {
    fn slopes(&self, spans: [usize; 2], at: [Double; 2], query: Vector) -> Slopes {
        let (design, [p, q]) = (self.design, self.design.degrees);
        let columns = design.counts[1];
        let (mut values, mut slopes) = (Vec::new(), Vec::new());
        for i in spans[0] - p..=spans[0] {
            let mut row: Vec<Homogeneous> =
                (spans[1] - q..=spans[1]).map(|j| homogeneous(design, i * columns + j)).collect();
            let [value, slope] = recursion(&design.knots[1], q, spans[1], at[1], &mut row);
            values.push(value);
            slopes.push(slope);
        }
        let [point, u] = recursion(&design.knots[0], p, spans[0], at[0], &mut values);
        let [v, _] = recursion(&design.knots[0], p, spans[0], at[0], &mut slopes);
        let d = [0, 1, 2].map(|k| {
            let away = Double::sum(design.poles[0][k], -query[k]);
            point[k].over(point[3]).plus(away)
        });
        // Derivative of the quotient, with the vector to the pole that everything is relative to.
        let quotient = |slope: Homogeneous| {
            [0, 1, 2]
                .map(|k| slope[k].minus(slope[3].times(point[k].over(point[3]))).over(point[3]))
        };
        Slopes { d, u: quotient(u), v: quotient(v) }
    }

    /// The point of the caller's parameters, relative to the query.
    pub fn point(&self, parameters: [f64; 2], query: Vector) -> Vector {
        let place = self.pieces.place(parameters);
        let slopes = self.slopes(self.spans(&place), parameters.map(Double::of), query);
        slopes.d.map(Double::value)
    }

    fn spans(&self, place: &Place) -> [usize; 2] {
        [0, 1].map(|k| self.pieces.spans[k][place.piece[k]])
    }

    /// Newton's iteration in the piece from a place there.
    pub fn refine(&self, place: &Place, query: Vector) -> Verdict {
        let at = [0, 1].map(|k| {
            let [start, _] = self.pieces.interval(k, place.piece[k]);
            let end = self.pieces.breaks[k][place.piece[k] + 1];
            let inside = Double::sum(end, -start).times(Double::of(place.at[k]));
            inside.plus(Double::of(start))
        });
        self.refine_from(place, at, query)
    }

    /// The same from the caller's parameters, which count as they are.
    pub fn refine_parameters(&self, parameters: [f64; 2], query: Vector) -> Verdict {
        let place = self.pieces.place(parameters);
        self.refine_from(&place, parameters.map(Double::of), query)
    }

    fn refine_from(&self, place: &Place, start: [Double; 2], query: Vector) -> Verdict {
        let limits = [0, 1].map(|k| {
            let breaks = &self.pieces.breaks[k][place.piece[k]..];
            [self.area[2 * k].max(breaks[0]), self.area[2 * k + 1].min(breaks[1])]
        });
        let inside = |at: [Double; 2]| [0, 1].map(|k| at[k].clamp(limits[k][0], limits[k][1]));
        let spans = self.spans(place);
        let mut at = inside(start);
        let mut slopes = self.slopes(spans, at, query);
        for _ in 0..6 {
            let step = self.step(place, at, limits, &slopes, query);
            let next = inside([0, 1].map(|k| at[k].plus(Double::of(step[k]))));
            let there = self.slopes(spans, next, query);
            if next == at || !scalar(&there.d, &there.d).is_less(scalar(&slopes.d, &slopes.d)) {
                break;
            }
            (at, slopes) = (next, there);
        }
        Verdict { at, distance: square(slopes.d.map(Double::value)).sqrt() }
    }

    /// Newton's step in the caller's parameters: the gradient in doubled precision, the second derivatives rounded.
    fn step(
        &self,
        place: &Place,
        at: [Double; 2],
        limits: [[f64; 2]; 2],
        slopes: &Slopes,
        query: Vector,
    ) -> [f64; 2] {
        let intervals = [0, 1].map(|k| self.pieces.interval(k, place.piece[k]));
        let lengths = intervals.map(|i| i[1]);
        let local = [0, 1].map(|k| at[k].minus(Double::of(intervals[k][0])).value() / lengths[k]);
        let jet = self.pieces.jet(&Place { at: local, ..*place }, query);
        let g = [&slopes.u, &slopes.v];
        let g = [0, 1].map(|k| scalar(&slopes.d, g[k]).value() * lengths[k]);
        let mut held = [0, 1].map(|k| {
            let [low, high] = limits[k];
            (at[k].value() <= low && g[k] >= 0.0) || (at[k].value() >= high && g[k] <= 0.0)
        });
        held[1] |= self.design.is_curve();
        let [mut a, mut b, mut c] = [
            dot(jet.s, jet.s) + dot(jet.d, jet.ss),
            dot(jet.s, jet.t) + dot(jet.d, jet.st),
            dot(jet.t, jet.t) + dot(jet.d, jet.tt),
        ];
        if a * c - b * b <= 0.0 || a <= 0.0 {
            [a, b, c] = [dot(jet.s, jet.s), 0.0, dot(jet.t, jet.t)];
        }
        let det = a * c - b * b;
        let step = match held {
            [true, true] => [0.0; 2],
            [true, false] => [0.0, -g[1] / c],
            [false, true] => [-g[0] / a, 0.0],
            _ => [(b * g[1] - c * g[0]) / det, (b * g[0] - a * g[1]) / det],
        };
        [0, 1].map(|k| if step[k].is_finite() { step[k] * lengths[k] } else { 0.0 })
    }
}
