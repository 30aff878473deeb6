//! A search of its own for the nearest place: dense samples kept for all queries of a shape, then damped Newton steps
//! from the best of their local minima, over the borders of pieces and along those of the area.
//!
//! ```text
//!   lines closer where the shape runs fast -> points in columns -> local minima -> the nearest few -> descent
//! ```
//!
//! Whatever it finds is attained by the shape: a nearer place, or one below a bound, is a counterexample
//! whatever the quality of the search. It knows the Bezier pieces of `pieces` only, nothing of the library.

use super::pieces::{Jet, Pieces, Place};
use super::shapes::{Vector, cross, dot, sub};

/// Sample lines in each direction of a surface, and on a curve.
const LINES: [usize; 2] = [64, 700];

/// Starts for descents of a query.
const STARTS: usize = 10;

/// A place and its squared distance.
#[derive(Clone, Copy, Debug)]
pub struct Found {
    pub place: Place,
    pub square: f64,
}

/// Memory of one thread.
#[derive(Default)]
pub struct Scratch {
    squares: Vec<f64>,
    starts: Vec<(f64, usize)>,
}

/// The samples of an area of a shape.
pub struct Search<'a> {
    pub pieces: &'a Pieces,
    /// u0, u1, v0, v1
    area: [f64; 4],
    lines: [Vec<(usize, f64)>; 2],
    points: [Vec<f64>; 3],
    /// Distance of a sample to the farthest of its neighbours.
    reach: Vec<f64>,
    diagonal: f64,
}

pub fn square(a: Vector) -> f64 {
    a[0] * a[0] + a[1] * a[1] + a[2] * a[2]
}

impl<'a> Search<'a> {
    pub fn new(pieces: &'a Pieces, area: [f64; 4], diagonal: f64) -> Self {
        let none = || [const { Vec::new() }; 3];
        let lines = [Vec::new(), Vec::new()];
        let mut search = Self { pieces, area, lines, points: none(), reach: Vec::new(), diagonal };
        search.lines = [search.lines_of(0), search.lines_of(1)];
        search.sample();
        search
    }

    fn is_curve(&self) -> bool {
        self.pieces.degrees[1] == 0
    }

    /// First and last local parameter of a piece that belong to the area; `None` where there are none.
    fn range(&self, direction: usize, piece: usize) -> Option<[f64; 2]> {
        let [start, length] = self.pieces.interval(direction, piece);
        let end = self.pieces.breaks[direction][piece + 1];
        let [low, high] = [self.area[2 * direction], self.area[2 * direction + 1]];
        if direction == 1 && self.is_curve() {
            return Some([0.0, 0.0]);
        }
        if low >= end || high <= start {
            return None;
        }
        let first = if low <= start { 0.0 } else { (low - start) / length };
        let last = if high >= end { 1.0 } else { (high - start) / length };
        Some([first.min(1.0), last.min(1.0)])
    }

    fn ranges(&self, place: &Place) -> [[f64; 2]; 2] {
        [0, 1].map(|k| self.range(k, place.piece[k]).unwrap_or([place.at[k]; 2]))
    }

    /// Sample lines of a direction: some in each span, more where the shape runs fast.
    fn lines_of(&self, direction: usize) -> Vec<(usize, f64)> {
        if direction == 1 && self.is_curve() {
            return vec![(0, 0.0)];
        }
        let most = LINES[usize::from(self.is_curve())];
        let count = self.pieces.spans[direction].len();
        let least = (most / 3 / count).clamp(2, 24).max(self.pieces.degrees[direction].min(20));
        let mut lines = Vec::new();
        for piece in 0..count {
            let Some([low, high]) = self.range(direction, piece) else { continue };
            lines.extend((0..least).map(|k| (piece, low + (high - low) * k as f64 / least as f64)));
            lines.push((piece, high));
        }
        self.thicken(direction, &mut lines, most);
        lines
    }

    /// Halves the longest step until no step is long or there are `most` lines.
    fn thicken(&self, direction: usize, lines: &mut Vec<(usize, f64)>, most: usize) {
        let probes = self.probes(1 - direction);
        let points = |line: (usize, f64)| -> Vec<Vector> {
            probes.iter().map(|probe| self.at(direction, line, *probe)).collect()
        };
        let step = |a: &[Vector], b: &[Vector]| {
            a.iter().zip(b).map(|(a, b)| square(sub(*a, *b))).fold(0.0, f64::max)
        };
        let mut rows: Vec<Vec<Vector>> = lines.iter().map(|line| points(*line)).collect();
        let mut steps: Vec<f64> = rows.windows(2).map(|w| step(&w[0], &w[1])).collect();
        let limit = (self.diagonal / most as f64).powi(2);
        while lines.len() < most {
            let longest = (0..steps.len()).max_by(|a, b| steps[*a].total_cmp(&steps[*b]));
            let Some(k) = longest.filter(|k| steps[*k] > limit) else { break };
            let middle = 0.5 * (lines[k].1 + lines[k + 1].1);
            if lines[k].0 != lines[k + 1].0 || middle <= lines[k].1 || middle >= lines[k + 1].1 {
                steps[k] = 0.0;
                continue;
            }
            let (line, row) = ((lines[k].0, middle), points((lines[k].0, middle)));
            steps[k] = step(&rows[k], &row);
            steps.insert(k + 1, step(&row, &rows[k + 1]));
            lines.insert(k + 1, line);
            rows.insert(k + 1, row);
        }
    }

    /// Lines of the other direction along which the speed is looked at.
    fn probes(&self, direction: usize) -> Vec<(usize, f64)> {
        let count = self.pieces.spans[direction].len();
        let inside: Vec<usize> =
            (0..count).filter(|piece| self.range(direction, *piece).is_some()).collect();
        let every = inside.len().div_ceil(4);
        let mut probes = Vec::new();
        for piece in inside.iter().step_by(every) {
            let [low, high] = self.range(direction, *piece).unwrap_or([0.0, 1.0]);
            let shares: &[f64] = if low == high { &[0.0] } else { &[0.0, 0.4, 1.0] };
            probes.extend(shares.iter().map(|x| (*piece, low + (high - low) * x)));
        }
        probes
    }

    fn at(&self, direction: usize, line: (usize, f64), other: (usize, f64)) -> Vector {
        let [a, b] = if direction == 0 { [line, other] } else { [other, line] };
        self.pieces.point(&Place { piece: [a.0, b.0], at: [a.1, b.1] }, [0.0; 3])
    }

    fn place_of(&self, k: usize) -> Place {
        let columns = self.lines[1].len();
        let (a, b) = (self.lines[0][k / columns], self.lines[1][k % columns]);
        Place { piece: [a.0, b.0], at: [a.1, b.1] }
    }

    fn sample(&mut self) {
        let count = self.lines[0].len() * self.lines[1].len();
        for k in 0..count {
            let point = self.pieces.point(&self.place_of(k), [0.0; 3]);
            for axis in 0..3 {
                self.points[axis].push(point[axis]);
            }
        }
        self.reach = (0..count)
            .map(|k| {
                let away = |n: usize| square(sub(self.sampled(n), self.sampled(k)));
                self.beside(k).into_iter().flatten().map(away).fold(0.0, f64::max).sqrt()
            })
            .collect();
    }

    pub fn sampled(&self, k: usize) -> Vector {
        [0, 1, 2].map(|axis| self.points[axis][k])
    }

    pub fn count(&self) -> usize {
        self.reach.len()
    }

    pub fn sample_place(&self, k: usize) -> Place {
        self.place_of(k)
    }

    /// The neighbours before and after in v, before and after in u.
    fn beside(&self, k: usize) -> [Option<usize>; 4] {
        let (columns, count) = (self.lines[1].len(), self.lines[0].len() * self.lines[1].len());
        let column = k % columns;
        [
            (column > 0).then(|| k - 1),
            (column + 1 < columns).then(|| k + 1),
            (k >= columns).then(|| k - columns),
            (k + columns < count).then(|| k + columns),
        ]
    }

    /// The nearest place found, from the samples and from `others`.
    pub fn nearest(&self, query: Vector, others: &[Place], scratch: &mut Scratch) -> Found {
        self.measure(query, scratch);
        let mut best = Found { place: self.place_of(scratch.starts[0].1), square: f64::INFINITY };
        for place in others {
            let found = self.descend(*place, query);
            if found.square < best.square {
                best = found;
            }
        }
        for (square, k) in &scratch.starts {
            if square.sqrt() - self.reach[*k] > best.square.sqrt() {
                continue;
            }
            let found = self.descend(self.place_of(*k), query);
            if found.square < best.square {
                best = found;
            }
        }
        best
    }

    /// Where the descents from the best local minima of the samples and from `others` end.
    pub fn descents(&self, query: Vector, others: &[Place], scratch: &mut Scratch) -> Vec<Found> {
        self.measure(query, scratch);
        let starts = scratch.starts.iter().map(|(_, k)| self.place_of(*k));
        starts.chain(others.iter().copied()).map(|place| self.descend(place, query)).collect()
    }

    /// The squared distances of all samples, and their least ones.
    fn measure(&self, query: Vector, scratch: &mut Scratch) {
        let [xs, ys, zs] = &self.points;
        scratch.squares.clear();
        let columns = xs.iter().zip(ys).zip(zs);
        let away =
            |((x, y), z): ((&f64, &f64), &f64)| square([x - query[0], y - query[1], z - query[2]]);
        scratch.squares.extend(columns.map(away));
        self.minima(scratch);
    }

    /// The samples that no neighbour is nearer than, nearest first, a few of them.
    fn minima(&self, scratch: &mut Scratch) {
        let Scratch { squares, starts } = scratch;
        let (columns, count) = (self.lines[1].len(), squares.len());
        starts.clear();
        for (k, s) in squares.iter().enumerate() {
            let is_least = (k + columns >= count || squares[k + columns] >= *s)
                && (k < columns || squares[k - columns] > *s)
                && self.beside(k)[..2].iter().flatten().all(|n| squares[*n] >= *s);
            if is_least {
                starts.push((*s, k));
            }
        }
        if starts.is_empty() {
            starts.push((squares[0], 0));
        }
        let kept = starts.len().min(STARTS);
        starts.select_nth_unstable_by(kept - 1, |a, b| a.0.total_cmp(&b.0));
        starts.truncate(kept);
        starts.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
    }

    /// Damped Newton steps with the parameters kept in the area. Over a knot the descent goes on in the next piece;
    /// where that one leads back, the foot lies on the knot line.
    pub fn descend(&self, start: Place, query: Vector) -> Found {
        let (mut place, mut jet) = (start, self.pieces.jet(&start, query));
        let mut best = Found { place, square: square(jet.d) };
        let (mut damping, mut stuck, mut turns) = (0.0, [false; 2], 0);
        for _ in 0..30 {
            let ranges = self.ranges(&place);
            let g = [dot(jet.d, jet.s), dot(jet.d, jet.t)];
            let mut held = self.held(&place, ranges, g);
            let leaving = [0, 1].into_iter().find(|k| held[*k] && !stuck[*k]);
            if let Some((k, next)) = leaving.and_then(|k| Some((k, self.beyond(&place, k)?))) {
                let there = self.pieces.jet(&next, query);
                let g = [dot(there.d, there.s), dot(there.d, there.t)];
                stuck[k] = self.held(&next, self.ranges(&next), g)[k] || turns > 20;
                (place, jet, turns) = (next, there, turns + 1);
                continue;
            }
            held[1] |= self.is_curve();
            let step = step(&jet, g, held, damping);
            let at = [0, 1].map(|k| (place.at[k] + step[k]).clamp(ranges[k][0], ranges[k][1]));
            let moved = [0, 1, 2]
                .map(|c| jet.s[c] * (at[0] - place.at[0]) + jet.t[c] * (at[1] - place.at[1]));
            if at == place.at || at.iter().any(|x| x.is_nan()) {
                break;
            }
            let next = Place { at, ..place };
            let there = self.pieces.jet(&next, query);
            if square(there.d) < best.square {
                best = Found { place: next, square: square(there.d) };
                (place, jet, damping) = (next, there, damping * 0.1);
                stuck = [0, 1].map(|k| stuck[k] && held[k]);
            } else {
                damping = if damping == 0.0 { 1e-2 } else { damping * 8.0 };
            }
            if square(moved) < (1e-15 * self.diagonal).powi(2) || damping > 1e8 {
                break;
            }
        }
        best
    }

    /// The parameters that stand at an end of their range and would leave it.
    fn held(&self, place: &Place, ranges: [[f64; 2]; 2], g: [f64; 2]) -> [bool; 2] {
        [0, 1].map(|k| {
            let ([low, high], x) = (ranges[k], place.at[k]);
            (x <= low && g[k] >= 0.0) || (x >= high && g[k] <= 0.0)
        })
    }

    /// The same place seen from the piece beyond the knot at which a parameter stands.
    fn beyond(&self, place: &Place, k: usize) -> Option<Place> {
        let (mut next, [low, high]) = (*place, self.range(k, place.piece[k])?);
        if place.at[k] == 1.0 && high == 1.0 {
            next.piece[k] += 1;
            let is_there = next.piece[k] < self.pieces.spans[k].len();
            next.at[k] = 0.0;
            is_there.then_some(())?;
        } else if place.at[k] == 0.0 && low == 0.0 {
            next.piece[k] = place.piece[k].checked_sub(1)?;
            next.at[k] = 1.0;
        } else {
            return None;
        }
        self.range(k, next.piece[k]).map(|_| next)
    }
}

/// `-(H + damping D)^-1 g` over the parameters that are not held, D the squared speeds; with Gauss and Newton's matrix
/// where the true one is not positive definite.
fn step(jet: &Jet, g: [f64; 2], held: [bool; 2], damping: f64) -> [f64; 2] {
    let (e, f, k) = (dot(jet.s, jet.s), dot(jet.s, jet.t), dot(jet.t, jet.t));
    let bent = [e + dot(jet.d, jet.ss), f + dot(jet.d, jet.st), k + dot(jet.d, jet.tt)];
    let single = |h: f64, e: f64, g: f64| {
        let h = if h > 1e-3 * e { h } else { e };
        if h > 0.0 { -g / (h + damping * e) } else { 0.0 }
    };
    match held {
        [true, true] => [0.0; 2],
        [true, false] => [0.0, single(bent[2], k, g[1])],
        [false, true] => [single(bent[0], e, g[0]), 0.0],
        [false, false] => {
            let is_definite =
                bent[0] > 0.0 && bent[0] * bent[2] - bent[1] * bent[1] > 1e-12 * bent[0] * bent[2];
            let [a, b, c] = if is_definite { bent } else { [e, f, k] };
            let least =
                if is_definite || square(cross(jet.s, jet.t)) > 1e-6 * e * k { 0.0 } else { 1e-3 };
            let (a, c) = (a + damping.max(least) * e, c + damping.max(least) * k);
            let det = a * c - b * b;
            if det > 0.0 {
                [(b * g[1] - c * g[0]) / det, (b * g[0] - a * g[1]) / det]
            } else {
                [single(a, e, g[0]), single(c, k, g[1])]
            }
        }
    }
}
