//! Small pieces of a patch that a line crosses at most once: their linear models, and the test of a line against one.
//!
//! ```text
//!   X(a, b) = X0 + a Xa + b Xb + E(a, b)   on [-1, 1]^2       |E| <= off    |E_a| <= sa, |E_b| <= sb
//!   line o + t d, n1 and n2 across:        n.(X - o) = c + A (a, b) + n.E    Y = A^-1, rows Y1 and Y2
//!   a zero lies in  -Y c +- |Y| off:       outside of the square: none
//!                                          inside of it: one (Brouwer)
//!   |Y1| sa + |Y2| sb < 1:                 at most one: the spectral radius of the matrix |Yi| sj
//! ```
//!
//! References: Krawczyk 1969 (the operator); Toth, *On ray tracing parametric surfaces*, 1985 (its use for rays).

use crate::bezier::{Bidegree, convolve, scale_down_2d, scale_up_2d};
use crate::bounds::{HALF_ULP, Vector, add, cross, dot, norm, scaled, sub};
use crate::index::position_steps;

/// The greatest deviation at which a line is taken to cross a cell at most once.
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
    /// Bounds of |E_a| and |E_b|.
    pub slopes: [f64; 2],
    /// How much straighter it gets, about, when it is halved across the direction a, b.
    pub gains: [f64; 2],
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
    /// `|Y1| sa + |Y2| sb`.
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

/// A polynomial in two parameters in scaled Bernstein form: coefficients times binomials, so that products are convolutions.
struct Scaled {
    degree: Bidegree,
    values: Vec<f64>,
}

impl Scaled {
    fn new(coefficients: Vec<f64>, degree: Bidegree) -> Self {
        let mut values = coefficients;
        scale_up_2d(&mut values, degree);
        Self { degree, values }
    }

    fn times(&self, other: &Self) -> Self {
        let degree =
            Bidegree { s: self.degree.s + other.degree.s, t: self.degree.t + other.degree.t };
        let mut values = vec![0.0; degree.count()];
        convolve(&self.values, self.degree, &other.values, other.degree, 1.0, &mut values);
        Self { degree, values }
    }

    /// `self + factor * other`, of one bidegree.
    fn plus(mut self, factor: f64, other: &Self) -> Self {
        self.values.iter_mut().zip(&other.values).for_each(|(x, y)| *x += factor * y);
        self
    }
}

/// Polynomials of one bidegree on [-1, 1]^2 as a net: Bernstein coefficients, polynomial by polynomial.
struct Plain<const N: usize> {
    degree: Bidegree,
    values: [Vec<f64>; N],
}

impl<const N: usize> Plain<N> {
    fn new(parts: [Scaled; N]) -> Self {
        let degree = parts[0].degree;
        let values = parts.map(|mut part| {
            scale_down_2d(&mut part.values, degree);
            part.values
        });
        Self { degree, values }
    }

    /// The greatest length of a coefficient.
    fn greatest(&self) -> f64 {
        let square = |k: usize| self.values.iter().map(|list| list[k] * list[k]).sum();
        (0..self.values[0].len()).map(square).fold(0.0, f64::max).sqrt()
    }

    fn slope(&self, direction: usize) -> Self {
        let (Bidegree { s, t }, width) = (self.degree, self.degree.t + 1);
        let (n, stride) = if direction == 0 { (s, width) } else { (t, 1) };
        let degree = Bidegree {
            s: if direction == 0 { s.saturating_sub(1) } else { s },
            t: if direction == 0 { t } else { t.saturating_sub(1) },
        };
        let columns = degree.t + 1;
        let values = self.values.each_ref().map(|list| {
            let step = |k: usize| {
                let k = k / columns * width + k % columns;
                if n == 0 { 0.0 } else { 0.5 * n as f64 * (list[k + stride] - list[k]) }
            };
            (0..degree.count()).map(step).collect()
        });
        Self { degree, values }
    }

    /// Bounds of the values, of the derivatives along a and b, and of the derivatives aa, ab, bb.
    fn bounds(&self) -> Bounds {
        let [a, b] = [0, 1].map(|k| self.slope(k));
        let bends = [a.slope(0), a.slope(1), b.slope(1)].map(|part| part.greatest());
        Bounds { off: self.greatest(), slopes: [a.greatest(), b.greatest()], bends }
    }
}

/// Bounds of lengths: of a function, its first and its second derivatives.
struct Bounds {
    off: f64,
    slopes: [f64; 2],
    bends: [f64; 3],
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
            slopes: [0.0; 2],
            gains: [0.0; 2],
        };
        cell.bends[1] = mean([a, b, c, d], [1., -1., -1., 1.]);
        cell.centre(degree, &place);
        let (steps, degrees) = (cell.steps(degree, radius), (degree.s + degree.t) as f64);
        let (of, turns, spread) = if rational {
            cell.bound_rational(degree, poles)
        } else {
            (cell.bound(degree, poles), Bounds { off: 1.0, slopes: [0.0; 2], bends: [0.0; 3] }, 1.0)
        };
        // Rounding: of the places, and twice as much for each derivative, over the weights that divide.
        let steps = steps * spread * spread;
        let more = 1.0 + 1e-9;
        cell.off = of.off * more + steps;
        // With N = W E: `W E_a = N_a - W_a E`, `W E_aa = N_aa - W_aa E - 2 W_a E_a`.
        let first = |k: usize| of.slopes[k] + turns.slopes[k] * cell.off;
        cell.slopes = [0, 1].map(|k| first(k) * more + 8.0 * degrees * steps);
        let [[p, q], [a, b]] = [turns.slopes, cell.slopes];
        let mixed = [2.0 * p * a, p * b + q * a, 2.0 * q * b];
        let second = |k: usize| of.bends[k] + turns.bends[k] * cell.off + mixed[k];
        cell.most_bent = [0, 1, 2].map(|k| second(k) * more + 32.0 * degrees * degrees * steps);
        let [aa, ab, bb] = cell.most_bent;
        let lengths = cell.edges.map(norm);
        cell.gains = [aa / lengths[0] + ab / lengths[1], ab / lengths[0] + bb / lengths[1]];
        cell
    }

    fn steps(&self, degree: Bidegree, radius: f64) -> f64 {
        position_steps(degree.s + degree.t) * radius
    }

    /// The sum of the bounds of |E_a| and |E_b|.
    pub fn slope(&self) -> f64 {
        self.slopes[0] + self.slopes[1]
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

    /// Bounds of E of a polynomial net.
    fn bound(&self, degree: Bidegree, poles: &[f64]) -> Bounds {
        let (count, width) = (degree.count(), degree.t + 1);
        let (x, rest) = poles.split_at(count);
        let (y, z) = rest.split_at(count);
        let place = |k: usize| [x[k], y[k], z[k]];
        let square = |v: Vector| dot(v, v);
        let mut off = 0.0f64;
        for k in 0..count {
            off = off.max(square(self.residual(degree, k, place(k))));
        }
        let (mut slopes, mut bent) = ([0.0; 2], [[0.0f64; 2]; 2]);
        for (direction, n, stride) in [(0, degree.s, width), (1, degree.t, 1)] {
            let rows = if direction == 0 { degree.s } else { degree.s + 1 };
            let columns = if direction == 0 { width } else { degree.t };
            let slope = |k: usize| scaled(sub(place(k + stride), place(k)), 0.5 * n as f64);
            let (mut off, mut turns) = (0.0f64, [0.0f64; 2]);
            for i in 0..rows {
                for j in 0..columns {
                    let here = slope(i * width + j);
                    off = off.max(square(sub(here, self.edges[direction])));
                    // The same difference one row and one column on.
                    if i + 1 < rows {
                        turns[0] = turns[0].max(square(sub(slope((i + 1) * width + j), here)));
                    }
                    if j + 1 < columns {
                        turns[1] = turns[1].max(square(sub(slope(i * width + j + 1), here)));
                    }
                }
            }
            slopes[direction] = off.sqrt();
            let less = n.saturating_sub(1);
            let degrees = if direction == 0 { [less, degree.t] } else { [degree.s, less] };
            bent[direction] = [0, 1].map(|by| 0.5 * degrees[by] as f64 * turns[by].sqrt());
        }
        Bounds {
            off: off.sqrt(),
            slopes,
            bends: [bent[0][0], bent[0][1].max(bent[1][0]), bent[1][1]],
        }
    }

    /// Bounds of N = W E of a rational net, of W, both over the least weight, and the greatest weight over the least. The coefficients of
    /// `W E = r - W (X0 + a Xa + b Xb)` are formed, so that what cancels does.
    fn bound_rational(&self, degree: Bidegree, poles: &[f64]) -> (Bounds, Bounds, f64) {
        let count = degree.count();
        let weight = &poles[3 * count..];
        let fold = |[low, high]: [f64; 2], &w: &f64| [low.min(w), high.max(w)];
        let [least, most] = weight.iter().fold([f64::INFINITY, 0.0], fold);
        // 1, a and b with the degree (1, 1).
        let bilinear = Bidegree { s: 1, t: 1 };
        let [one, a, b] = [[1., 1., 1., 1.], [-1., -1., 1., 1.], [-1., 1., -1., 1.]]
            .map(|values| Scaled::new(values.to_vec(), bilinear));
        let w = Scaled::new(weight.to_vec(), degree);
        let linear = [w.times(&a), w.times(&b)];
        let rest = [0, 1, 2].map(|c| {
            let of = |k: usize| poles[c * count + k] - weight[k] * self.middle[c];
            let part = Scaled::new((0..count).map(of).collect(), degree).times(&one);
            part.plus(-self.edges[0][c], &linear[0]).plus(-self.edges[1][c], &linear[1])
        });
        let over = |x: Bounds| Bounds {
            off: x.off / least,
            slopes: x.slopes.map(|x| x / least),
            bends: x.bends.map(|x| x / least),
        };
        (over(Plain::new(rest).bounds()), over(Plain::new([w]).bounds()), most / least)
    }

    /// How near a line along the normal comes to crossing twice: its deviation.
    pub fn crookedness(&self) -> f64 {
        let [e, f, g] = [
            dot(self.edges[0], self.edges[0]),
            dot(self.edges[0], self.edges[1]),
            dot(self.edges[1], self.edges[1]),
        ];
        let det = e * g - f * f;
        // The lengths of the two rows: sqrt(g / det), sqrt(e / det).
        if det <= 1e-18 * e * g {
            return f64::INFINITY;
        }
        (g / det).sqrt() * self.slopes[0] + (e / det).sqrt() * self.slopes[1]
    }

    /// Direction in which halving straightens the cell more: 0 or 1.
    pub fn more_crooked(&self) -> usize {
        let [a, b] = self.gains;
        if a < b || b < a {
            usize::from(b > a)
        } else {
            usize::from(norm(self.edges[1]) > norm(self.edges[0]))
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
        let deviation = lengths[0] * self.slopes[0] + lengths[1] * self.slopes[1];
        let zero = Zero { at, reach, deviation };
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
                assert!(norm(sub(slope, cell.edges[0])) <= cell.slopes[0]);
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
