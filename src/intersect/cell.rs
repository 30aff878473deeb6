//! Small pieces of a patch that a line crosses at most once: their linear models, and the test of a line against one.
//!
//! ```text
//!   X(a, b) = X0 + a Xa + b Xb + E(a, b)   on [-1, 1]^2       |E| <= off    |E_a| + |E_b| <= slope
//!   line o + t d, n1 and n2 across:        n.(X - o) = c + A (a, b) + n.E    Y = A^-1
//!   a zero lies in  -Y c +- |Y| off:       outside of the square: none
//!                                          inside of it: one (Brouwer)
//!   |Y| slope < 1:                         at most one
//! ```
//!
//! References: Krawczyk 1969 (the operator); Toth, *On ray tracing parametric surfaces*, 1985 (its use for rays).

use crate::bezier::Bidegree;
use crate::bounds::{HALF_ULP, Vector, add, cross, dot, norm, scaled, sub};
use crate::index::position_steps;

/// The greatest `|Y| slope` at which a line is taken to cross a cell at most once.
pub const MOST_DEVIATION: f64 = 0.9;

/// See [`Inverse::rounding`]: six roundings a product, and those of the slopes.
pub const ROUNDING: f64 = 16.0 * HALF_ULP;

/// The model of a piece.
#[derive(Clone, Copy, Debug)]
pub struct Cell {
    /// X0, in the patch's coordinates until it is put into a list.
    pub middle: Vector,
    /// Xa, Xb.
    pub edges: [Vector; 2],
    /// Halves of the second derivatives aa, ab, bb in the middle, about.
    pub bends: [Vector; 3],
    /// Bounds of |X_aa|, |X_ab|, |X_bb|.
    pub most_bent: [f64; 3],
    /// Bound of |E|.
    pub off: f64,
    /// Bound of |E_a| + |E_b|.
    pub slope: f64,
}

/// What a test of a line against a cell shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Meeting {
    /// They do not meet.
    None,
    /// At most one zero.
    Once(Zero),
    /// Any number of zeros.
    Open(Zero),
    /// Nothing: the line lies in the plane of the model.
    Grazing,
}

/// Where zeros can be in a cell, in [-1, 1]^2.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Zero {
    /// The zero of the linear model.
    pub at: [f64; 2],
    /// How far from there zeros can be.
    pub reach: [f64; 2],
    /// Bound of `|Y| slope`.
    pub deviation: f64,
}

impl Zero {
    /// Whether a zero that is the only one is sure to be in the cell.
    pub fn is_inside(&self) -> bool {
        (0..2).all(|k| self.at[k].abs() + self.reach[k] < 1.0)
    }
}

/// A line with two unit vectors across it, in the coordinates of what it is tested against.
#[derive(Clone, Copy, Debug)]
pub struct Axis {
    /// A point of the line near the shape.
    pub origin: Vector,
    /// Unit direction.
    pub direction: Vector,
    /// Two unit vectors across.
    pub across: [Vector; 2],
}

impl Axis {
    /// The line through a point along a unit direction.
    pub fn new(origin: Vector, direction: Vector) -> Self {
        let least = (0..3).min_by(|&a, &b| direction[a].abs().total_cmp(&direction[b].abs()));
        let mut e = [0.0; 3];
        e[least.unwrap_or(0)] = 1.0;
        let first = cross(direction, e);
        let first = scaled(first, 1.0 / norm(first));
        Self { origin, direction, across: [first, cross(direction, first)] }
    }
}

/// The two rows that undo the middle slopes; `None` when they cannot be undone.
pub fn inverse(axis: &Axis, edges: &[Vector; 2]) -> Option<Inverse> {
    let a = axis.across.map(|n| [dot(n, edges[0]), dot(n, edges[1])]);
    let det = a[0][0] * a[1][1] - a[0][1] * a[1][0];
    let size = (a[0][0] * a[1][1]).abs() + (a[0][1] * a[1][0]).abs();
    if det.abs() <= 1e-9 * size || det.is_nan() {
        return None;
    }
    let rows = [[a[1][1] / det, -a[0][1] / det], [-a[1][0] / det, a[0][0] / det]];
    let lengths = rows.map(|row| (row[0] * row[0] + row[1] * row[1]).sqrt() * (1.0 + 1e-6));
    Some(Inverse { rows, lengths, rounding: ROUNDING * (1.0 + 4.0 * (size / det).abs()) })
}

/// See [`inverse`].
#[derive(Clone, Copy, Debug)]
pub struct Inverse {
    /// The rows.
    pub rows: [[f64; 2]; 2],
    /// Bounds of their lengths: the rounding of the rows is at most a few units over 1e-9.
    pub lengths: [f64; 2],
    /// What rounding leaves of `1 - Y A`, and in `Y c`, for places up to twice the size of the cell.
    pub rounding: f64,
}

impl Cell {
    /// The model of a net, component by component (x, y, z and, when rational, w); `radius` bounds its places.
    pub fn new(poles: &[f64], degree: Bidegree, rational: bool, radius: f64) -> Self {
        let count = degree.count();
        let width = degree.t + 1;
        let weight = |k: usize| if rational { poles[3 * count + k] } else { 1.0 };
        let place = |k: usize| {
            let w = weight(k);
            [poles[k] / w, poles[count + k] / w, poles[2 * count + k] / w]
        };
        let corners = [0, degree.t, degree.s * width, count - 1].map(place);
        let [a, b, c, d] = corners;
        let mean = |p: [Vector; 4], s: [f64; 4]| {
            [0, 1, 2].map(|k| 0.25 * (0..4).map(|i| s[i] * p[i][k]).sum::<f64>())
        };
        let mut cell = Self {
            middle: mean(corners, [1.0; 4]),
            edges: [mean([a, b, c, d], [-1., -1., 1., 1.]), mean([a, b, c, d], [-1., 1., -1., 1.])],
            bends: [[0.0; 3]; 3],
            most_bent: [0.0; 3],
            off: 0.0,
            slope: 0.0,
        };
        cell.bends[1] = mean([a, b, c, d], [1., -1., -1., 1.]);
        cell.centre(degree, &place);
        cell.bound(degree, rational, &weight, &place, poles);
        let steps = position_steps(degree.s + degree.t) * radius;
        let degrees = (degree.s + degree.t) as f64;
        cell.off = cell.off * (1.0 + 1e-9) + steps;
        cell.slope = cell.slope * (1.0 + 1e-9) + 2.0 * degrees * steps;
        cell.bound_bends(degree, rational, poles);
        cell.most_bent = cell.most_bent.map(|x| x * (1.0 + 1e-9) + 4.0 * degrees * degrees * steps);
        cell
    }

    /// Moves the model into the middle of the residuals, and estimates bends.
    fn centre(&mut self, degree: Bidegree, place: &impl Fn(usize) -> Vector) {
        let width = degree.t + 1;
        let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        for k in 0..degree.count() {
            let r = self.residual(degree, k, place(k));
            for c in 0..3 {
                (low[c], high[c]) = (low[c].min(r[c]), high[c].max(r[c]));
            }
        }
        self.middle = [0, 1, 2].map(|c| self.middle[c] + 0.5 * (low[c] + high[c]));
        // Second differences in the middle of the net.
        let (i, j) = (degree.s / 2, degree.t / 2);
        let second = |a: Vector, b: Vector, c: Vector, n: usize| {
            let d = [0, 1, 2].map(|k| (c[k] - b[k]) - (b[k] - a[k]));
            scaled(d, 0.125 * (n * (n - 1)) as f64)
        };
        if degree.s > 1 {
            let i = i.max(1).min(degree.s - 1);
            let at = |i: usize| place(i * width + j);
            self.bends[0] = second(at(i - 1), at(i), at(i + 1), degree.s);
        }
        if degree.t > 1 {
            let j = j.max(1).min(degree.t - 1);
            let at = |j: usize| place(i * width + j);
            self.bends[2] = second(at(j - 1), at(j), at(j + 1), degree.t);
        }
    }

    /// A pole less the linear model: coefficient of E (without weights).
    fn residual(&self, degree: Bidegree, k: usize, place: Vector) -> Vector {
        let width = degree.t + 1;
        let share = |i: usize, n: usize| 2.0 * i as f64 / n.max(1) as f64 - 1.0;
        let (a, b) = (share(k / width, degree.s), share(k % width, degree.t));
        let model = add(self.middle, add(scaled(self.edges[0], a), scaled(self.edges[1], b)));
        sub(place, model)
    }

    fn bound(
        &mut self,
        degree: Bidegree,
        rational: bool,
        weight: &impl Fn(usize) -> f64,
        place: &impl Fn(usize) -> Vector,
        poles: &[f64],
    ) {
        let (count, width) = (degree.count(), degree.t + 1);
        let ([mut least, mut most], mut reach, mut off) = ([f64::INFINITY, 0.0f64], 0.0f64, 0.0f64);
        for k in 0..count {
            let w = weight(k);
            (least, most) = (least.min(w), most.max(w));
            reach = reach.max(norm(sub(place(k), self.middle)));
            off = off.max(norm(self.residual(degree, k, place(k))));
        }
        // With weights the model's parameters are not those of the net: the linear part is off by the mean of
        // (w_k - middle)(a_k - a), at most half the spread of the weights times the deviation of a binomial, 1 / sqrt(n).
        let skew = if rational { 0.5 * (most - least) / least } else { 0.0 };
        let spread = |k: usize, n: usize| norm(self.edges[k]) / (n.max(1) as f64).sqrt();
        self.off = off + skew * (spread(0, degree.s) + spread(1, degree.t));
        for (direction, n) in [(0, degree.s), (1, degree.t)] {
            let stride = if direction == 0 { width } else { 1 };
            let number = |k: usize| if direction == 0 { k / width } else { k % width };
            let mut worst = 0.0f64;
            let mut steepest = 0.0f64;
            for k in 0..count {
                let i = number(k);
                // The derivative, with its degree raised to that of the weights.
                let step = |c: usize| {
                    let value =
                        |k: usize| if c == 3 && !rational { 1.0 } else { poles[c * count + k] };
                    let before = if i > 0 { value(k) - value(k - stride) } else { 0.0 };
                    let after = if i < n { value(k + stride) - value(k) } else { 0.0 };
                    0.5 * (i as f64 * before + (n - i) as f64 * after)
                };
                let slope = [step(0), step(1), step(2)];
                let grows = step(3);
                let linear = scaled(self.edges[direction], weight(k));
                let rest = sub(sub(slope, scaled(self.middle, grows)), linear);
                worst = worst.max(norm(rest));
                steepest = steepest.max(grows.abs());
            }
            self.slope += (worst + steepest * reach) / least;
        }
    }

    /// How near a line across the middle comes to crossing twice: `|Y| slope` for a line along the normal.
    pub fn crookedness(&self) -> f64 {
        let [e, f, g] = [
            dot(self.edges[0], self.edges[0]),
            dot(self.edges[0], self.edges[1]),
            dot(self.edges[1], self.edges[1]),
        ];
        let det = e * g - f * f;
        // The greatest of the two rows' lengths: sqrt(g / det), sqrt(e / det).
        if det <= 1e-18 * e * g { f64::INFINITY } else { (e.max(g) / det).sqrt() * self.slope }
    }

    /// Bounds the second derivatives: those of `r - W X0`, and what the weights add.
    fn bound_bends(&mut self, degree: Bidegree, rational: bool, poles: &[f64]) {
        let (count, width) = (degree.count(), degree.t + 1);
        let middle = self.middle;
        // The parts of `r - W X0` and W in one differenced coefficient: a sum of `share` times pole.
        let of = |terms: &[(f64, usize)]| {
            let sum = |c: usize| terms.iter().map(|&(f, k)| f * poles[c * count + k]).sum::<f64>();
            let w = if rational { sum(3) } else { terms.iter().map(|&(f, _)| f).sum() };
            (norm([0, 1, 2].map(|c| sum(c) - w * middle[c])), w.abs())
        };
        let (n, m) = (degree.s as f64, degree.t as f64);
        let mut second = [(0.0f64, 0.0f64); 3];
        let mut first = [0.0f64; 2];
        let (mut least, mut reach) = (f64::INFINITY, 0.0f64);
        let raise = |to: &mut (f64, f64), (a, b): (f64, f64), by: f64| {
            *to = (to.0.max(by * a), to.1.max(by * b));
        };
        for k in 0..count {
            let (i, j) = (k / width, k % width);
            let (distance, w) = of(&[(1.0, k)]);
            (least, reach) = (least.min(w), reach.max(distance / w));
            if i < degree.s {
                first[0] = first[0].max(0.5 * n * of(&[(1.0, k + width), (-1.0, k)]).1);
            }
            if j < degree.t {
                first[1] = first[1].max(0.5 * m * of(&[(1.0, k + 1), (-1.0, k)]).1);
            }
            if i + 2 <= degree.s {
                let terms = [(1.0, k), (-2.0, k + width), (1.0, k + 2 * width)];
                raise(&mut second[0], of(&terms), 0.25 * n * (n - 1.0));
            }
            if i < degree.s && j < degree.t {
                let terms = [(1.0, k), (-1.0, k + width), (-1.0, k + 1), (1.0, k + width + 1)];
                raise(&mut second[1], of(&terms), 0.25 * n * m);
            }
            if j + 2 <= degree.t {
                let terms = [(1.0, k), (-2.0, k + 1), (1.0, k + 2)];
                raise(&mut second[2], of(&terms), 0.25 * m * (m - 1.0));
            }
        }
        if !rational {
            self.most_bent = second.map(|(of_r, _)| of_r);
            return;
        }
        let speed = self.edges.map(|e| norm(e) + self.slope);
        let turns = [
            2.0 * first[0] * speed[0],
            first[0] * speed[1] + first[1] * speed[0],
            2.0 * first[1] * speed[1],
        ];
        for k in 0..3 {
            self.most_bent[k] = (second[k].0 + turns[k] + second[k].1 * reach) / least;
        }
    }

    /// Whether a line that grazes passes beside: seen along it the cell is a strip. `r` leads from the line to the middle.
    pub fn is_beside(&self, axis: &Axis, r: Vector, off: f64) -> bool {
        let n = cross(self.edges[0], self.edges[1]);
        let m = sub(n, scaled(axis.direction, dot(n, axis.direction)));
        let spread = dot(m, self.edges[0]).abs() + dot(m, self.edges[1]).abs() + norm(m) * off;
        // What rounding leaves of m along the line, over lengths of at most 4 in the coordinates of the index.
        let rounding = 128.0 * HALF_ULP * norm(n);
        dot(m, r).abs() > spread * (1.0 + 64.0 * HALF_ULP) + rounding
    }

    /// Tests a line: `r` leads from a point of it to the middle of the cell; `slack` bounds the rounding of its place.
    pub fn meet(&self, axis: &Axis, r: Vector, slack: f64) -> Meeting {
        let off = self.off + slack;
        let c = [dot(axis.across[0], r), dot(axis.across[1], r)];
        let a = axis.across.map(|n| [dot(n, self.edges[0]), dot(n, self.edges[1])]);
        for k in 0..2 {
            if c[k].abs() > a[k][0].abs() + a[k][1].abs() + off {
                return Meeting::None;
            }
        }
        let Some(Inverse { rows, lengths, rounding }) = inverse(axis, &self.edges) else {
            return if self.is_beside(axis, r, off) { Meeting::None } else { Meeting::Grazing };
        };
        let at = rows.map(|row| -(row[0] * c[0] + row[1] * c[1]));
        let reach = lengths.map(|l| l * off + rounding);
        if (0..2).any(|k| at[k].abs() - reach[k] > 1.0) {
            return Meeting::None;
        }
        let zero = Zero { at, reach, deviation: lengths[0].max(lengths[1]) * self.slope };
        if zero.deviation <= MOST_DEVIATION {
            return Meeting::Once(zero);
        }
        if self.is_beside(axis, r, off) { Meeting::None } else { Meeting::Open(zero) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_bounds_hold_on_a_curved_patch_and_a_line_meets_it_once() {
        // z = s^2 / 8 + t over the unit square, in Bernstein form: straight enough to be met once for certain.
        let degree = Bidegree { s: 2, t: 1 };
        let mut poles = vec![0.0; 18];
        for i in 0..3 {
            for j in 0..2 {
                let k = 2 * i + j;
                poles[k] = 0.5 * i as f64;
                poles[6 + k] = j as f64;
                poles[12 + k] = if i == 2 { 0.125 } else { 0.0 } + j as f64;
            }
        }
        let cell = Cell::new(&poles, degree, false, 2.0);
        for i in 0..=8 {
            for j in 0..=8 {
                let (a, b) = (i as f64 / 4.0 - 1.0, j as f64 / 4.0 - 1.0);
                let (s, t) = (0.5 * (a + 1.0), 0.5 * (b + 1.0));
                let x = [s, t, 0.125 * s * s + t];
                let model =
                    [0, 1, 2].map(|k| cell.middle[k] + a * cell.edges[0][k] + b * cell.edges[1][k]);
                assert!(norm(sub(x, model)) <= cell.off);
                let slope = [0.5, 0.0, 0.125 * s];
                assert!(norm(sub(slope, cell.edges[0])) <= cell.slope);
            }
        }
        let axis = Axis::new([0.3, 0.6, 0.0], [0.0, 0.0, 1.0]);
        let Meeting::Once(zero) = cell.meet(&axis, sub(cell.middle, axis.origin), 0.0) else {
            panic!()
        };
        assert!(zero.is_inside() && (zero.at[0] + 0.4).abs() < 1e-12);
        assert!((zero.at[1] - 0.2).abs() < 1e-12);
        let away = Axis::new([1.3, 0.6, 0.0], [0.0, 0.0, 1.0]);
        assert_eq!(cell.meet(&away, sub(cell.middle, away.origin), 0.0), Meeting::None);
    }
}
