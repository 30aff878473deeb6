//! The Bezier net of one patch to the last digit of its own size: cut from the poles in doubled precision.
//!
//! ```text
//!   poles - centre (exact) -> weights -> extraction (31 digits) -> origin in the patch -> rounded
//! ```
//!
//! The nets of an index are off by half an ulp of the whole shape: on a span of 1e-6 of it that hides second derivatives.
//! These are off by an ulp of the patch, component by component, so that what is exactly flat stays so, and poles that coincide
//! have differences of exactly zero.

use super::doubled::{Doubled, UNIT};
use crate::bezier::Bidegree;
use crate::bounds::{HALF_ULP, cross, norm, scaled, sub};
use crate::index::SurfaceIndex;
use crate::knots::Knots;
use crate::surface::Surface;

/// Homogeneous poles of a patch, component by component, in index coordinates about a pole of the surface.
pub(super) struct ExactNet {
    pub degree: Bidegree,
    pub rational: bool,
    pub poles: Vec<Doubled>,
    /// Which coordinates are exactly zero: everything that they were made of was.
    pub zeros: Vec<bool>,
    /// Greatest absolute value of what each component was made of.
    sizes: [f64; 4],
}

/// Makes nets of patches.
pub(super) struct Nets<'a> {
    surface: &'a Surface,
    index: &'a SurfaceIndex,
    rows: Vec<Option<Vec<Doubled>>>,
    columns: Vec<Option<Vec<Doubled>>>,
}

/// As [`crate::bezier::extraction`], in doubled precision.
fn extraction(knots: &Knots, [start, end]: [f64; 2]) -> Vec<Doubled> {
    let (p, t) = (knots.degree(), knots.values());
    let span = knots.span(start);
    let mut matrix = vec![Doubled::default(); (p + 1) * (p + 1)];
    for i in 0..=p {
        let row = &mut matrix[i * (p + 1)..(i + 1) * (p + 1)];
        row[p] = Doubled::one();
        for level in (1..=p).rev() {
            let a = if level - 1 < p - i { start } else { end };
            for j in level..=p {
                let (low, high) = (t[span - p + j], t[span + 1 + j - level]);
                let width = Doubled::difference(high, low);
                let (weight, before) = (row[j], row[j - 1]);
                let share = weight * (Doubled::difference(high, a) / width);
                row[j - 1] = if j > level { before + share } else { share };
                row[j] = weight * (Doubled::difference(a, low) / width);
            }
        }
    }
    matrix
}

/// A sum of products, of which many are zero.
fn sum_of(pairs: impl Iterator<Item = (Doubled, Doubled)>) -> Doubled {
    pairs.fold(
        Doubled::default(),
        |sum, (a, b)| {
            if a.is_zero() || b.is_zero() { sum } else { sum + a * b }
        },
    )
}

/// `2^-e` with `2^e <= x < 2^(e+1)`, for a positive normal number.
fn power_of_two_over(x: f64) -> f64 {
    1.0 / f64::from_bits(x.to_bits() & 0x7ff0_0000_0000_0000)
}

impl<'a> Nets<'a> {
    pub fn new(surface: &'a Surface, index: &'a SurfaceIndex) -> Self {
        let (columns, count) = (index.columns, index.patches.len());
        Self { surface, index, rows: vec![None; count / columns], columns: vec![None; columns] }
    }

    /// The greatest coordinate of the surface, in index lengths.
    pub fn magnitude(&self) -> f64 {
        self.index.frame.magnitude * self.index.frame.scale
    }

    /// The net of patch `k` about the pole of the surface that shapes it in corner (`at[0]` p, `at[1]` q), in the middle at 1/2.
    pub fn net(&mut self, k: usize, at: [f64; 2]) -> ExactNet {
        let (surface, index) = (self.surface, self.index);
        let (a, b) = (k / index.columns, k % index.columns);
        let [p, q] = [index.degree.s, index.degree.t];
        let (u, v) = (index.patches[k].u, index.patches[k].v);
        let by_u = self.rows[a].get_or_insert_with(|| extraction(surface.knots_u(), u.ends));
        let by_v = self.columns[b].get_or_insert_with(|| extraction(surface.knots_v(), v.ends));
        let (span_u, span_v) =
            (surface.knots_u().span(u.ends[0]), surface.knots_v().span(v.ends[0]));
        let width = surface.knots_v().pole_count();
        let number = |i: usize, j: usize| (span_u - p + i) * width + span_v - q + j;
        let corner = |x: f64, n: usize| (x * n as f64) as usize;
        let centre = surface.poles()[number(corner(at[0], p), corner(at[1], q))];
        let rational = index.rational;
        let weights = surface.weights().filter(|_| rational);
        let weight = |i: usize, j: usize| weights.map_or(1.0, |w| w[number(i, j)]);
        let places = || (0..=p).flat_map(|i| (0..=q).map(move |j| (i, j)));
        let heaviest = places().fold(0.0f64, |m, (i, j)| m.max(weight(i, j)));
        let factor = if rational { power_of_two_over(heaviest) } else { 1.0 };
        let count = (p + 1) * (q + 1);
        let components = if rational { 4 } else { 3 };
        let mut poles = Vec::with_capacity(components * count);
        let mut zeros = Vec::with_capacity(components * count);
        let mut sizes = [0.0; 4];
        let mut half = vec![Doubled::default(); count];
        let mut half_zeros = vec![false; count];
        for (c, size) in sizes.iter_mut().enumerate().take(components) {
            let local: Vec<Doubled> = places()
                .map(|(i, j)| {
                    let w = Doubled::new(weight(i, j) * factor);
                    if c == 3 {
                        return w;
                    }
                    let x = Doubled::difference(surface.poles()[number(i, j)][c], centre[c]);
                    x.scaled(index.frame.scale) * w
                })
                .collect();
            *size = local.iter().fold(0.0, |m: f64, x| m.max(x.high.abs()));
            for i in 0..=p {
                for j in 0..=q {
                    half[i * (q + 1) + j] =
                        sum_of((0..=p).map(|k| (by_u[i * (p + 1) + k], local[k * (q + 1) + j])));
                    half_zeros[i * (q + 1) + j] = (0..=p).all(|k| {
                        by_u[i * (p + 1) + k].is_zero() || local[k * (q + 1) + j].is_zero()
                    });
                }
            }
            for i in 0..=p {
                for j in 0..=q {
                    poles.push(sum_of(
                        (0..=q).map(|k| (by_v[j * (q + 1) + k], half[i * (q + 1) + k])),
                    ));
                    zeros.push(
                        (0..=q).all(|k| {
                            by_v[j * (q + 1) + k].is_zero() || half_zeros[i * (q + 1) + k]
                        }),
                    );
                }
            }
        }
        let degree = Bidegree { s: p, t: q };
        let mut net = ExactNet { degree, rational, poles, zeros, sizes };
        if rational {
            net.balance([u.balance, v.balance]);
        }
        net
    }
}

impl ExactNet {
    /// The linear fractional maps of the patch's spans: pole (i, j) times powers of theirs, all of them powers of two.
    fn balance(&mut self, [a, b]: [f64; 2]) {
        if a == 1.0 && b == 1.0 {
            return;
        }
        let (count, width) = (self.degree.count(), self.degree.t + 1);
        let grown = |k: usize| a.powi((k / width) as i32) * b.powi((k % width) as i32);
        let weights = &self.poles[3 * count..];
        let largest = (0..count).fold(0.0f64, |m, k| m.max(weights[k].high * grown(k)));
        let factor = power_of_two_over(largest);
        let mut most = 0.0f64;
        for component in self.poles.chunks_exact_mut(count) {
            for (k, x) in component.iter_mut().enumerate() {
                *x = x.scaled(grown(k) * factor);
                most = most.max(grown(k) * factor);
            }
        }
        self.sizes.iter_mut().for_each(|size| *size *= most);
    }

    /// The point of pole `k`.
    pub fn point(&self, k: usize) -> [Doubled; 3] {
        let count = self.degree.count();
        let weight = if self.rational { self.poles[3 * count + k] } else { Doubled::one() };
        [0, 1, 2].map(|c| self.poles[c * count + k] / weight)
    }

    /// The net about `origin`.
    pub fn about(mut self, origin: [Doubled; 3]) -> Self {
        let count = self.degree.count();
        for c in (0..3).filter(|&c| !origin[c].is_zero()) {
            for k in 0..count {
                let weight = if self.rational { self.poles[3 * count + k] } else { Doubled::one() };
                self.poles[c * count + k] = self.poles[c * count + k] - origin[c] * weight;
                self.zeros[c * count + k] = false;
            }
            self.sizes[c] += 2.0 * origin[c].high.abs();
        }
        self
    }

    /// For each side the share of the patch from it on which the patch is no wider than the side is long, at most 1 and only about;
    /// 1 for a side that is a point.
    pub fn short_sides(&self) -> [f64; 4] {
        let Bidegree { s: p, t: q } = self.degree;
        let count = self.degree.count();
        let at = |k: usize| {
            let weight = if self.rational { self.poles[3 * count + k].high } else { 1.0 };
            [0, 1, 2].map(|c| self.poles[c * count + k].high / weight)
        };
        [0, 1, 2, 3].map(|side| {
            let along = if side < 2 { q } else { p };
            // A pole of the side and the one next to it.
            let poles = |i: usize| match side {
                0 => [i, if p > 0 { q + 1 + i } else { i }],
                1 => [p * (q + 1) + i, p.saturating_sub(1) * (q + 1) + i],
                2 => [i * (q + 1), i * (q + 1) + q.min(1)],
                _ => [i * (q + 1) + q, i * (q + 1) + q.saturating_sub(1)],
            };
            let (mut length, mut opening) = (0.0f64, 0.0f64);
            for i in 0..along {
                let [a, b] = [poles(i), poles(i + 1)].map(|pair| pair.map(at));
                let (edge, next) = (sub(b[0], a[0]), sub(b[1], a[1]));
                length = length.max(norm(edge));
                opening = opening.max(norm(sub(next, edge)));
            }
            let across = (if side < 2 { p } else { q }) as f64;
            if length > 0.0 { (length / (across * opening)).min(1.0) } else { 1.0 }
        })
    }

    /// The net, turned in space, with the partials in the corner (s0, 0) moved to be parallel and the corner in the origin; and how far.
    /// None when they are farther from it than `most`, or as far as they are long.
    pub fn parallel(self, s0: f64, most: f64) -> Option<(Self, f64)> {
        let Bidegree { s: p, t: q } = self.degree;
        if p == 0 || q == 0 {
            return None;
        }
        let count = self.degree.count();
        let (first, next) = if s0 == 0.0 { (0, q + 1) } else { (p * (q + 1), (p - 1) * (q + 1)) };
        let origin = self.point(first);
        let mut net = self.about(origin);
        let weight = |net: &Self, k: usize| {
            if net.rational { net.poles[3 * count + k].high } else { 1.0 }
        };
        let at = |net: &Self, k: usize| {
            [0, 1, 2].map(|c| net.poles[c * count + k].high / weight(net, k))
        };
        let mut ways = [next, first + 1].map(|k| at(&net, k));
        if norm(ways[1]) > norm(ways[0]) {
            ways.swap(0, 1);
        }
        let along = scaled(ways[0], 1.0 / norm(ways[0]));
        let off = norm(cross(along, ways[1]));
        if off.is_nan() || off > most || off > 1e-6 * norm(ways[1]) {
            return None;
        }
        // Any two axes normal to it; unit vectors and normal to each other up to rounding: that much the patch is sheared.
        let least = [0, 1, 2].map(|c: usize| along[c].abs());
        let axis = if least[0] <= least[1].min(least[2]) {
            [1.0, 0.0, 0.0]
        } else if least[1] <= least[2] {
            [0.0, 1.0, 0.0]
        } else {
            [0.0, 0.0, 1.0]
        };
        let second = cross(along, axis);
        let second = scaled(second, 1.0 / norm(second));
        let axes = [along, second, cross(along, second)];
        let radius = (0..count).map(|k| norm(at(&net, k))).fold(0.0, f64::max);
        let rows: Vec<Doubled> = net.poles[..3 * count].to_vec();
        let size = net.sizes[0] + net.sizes[1] + net.sizes[2];
        for (c, axis) in axes.iter().enumerate() {
            for k in 0..count {
                let terms = [0, 1, 2].map(|i| rows[i * count + k] * Doubled::new(axis[i]));
                let is_fixed = k == first || (c > 0 && (k == next || k == first + 1));
                let value =
                    if is_fixed { Doubled::default() } else { terms[0] + terms[1] + terms[2] };
                net.poles[c * count + k] = value;
                net.zeros[c * count + k] = is_fixed;
            }
            net.sizes[c] = 2.0 * size;
        }
        Some((net, off + 16.0 * HALF_ULP * radius))
    }

    /// The net with the poles of the side t = 0 moved into the origin, and how far.
    pub fn collapsed(mut self) -> (Self, f64) {
        let (count, width) = (self.degree.count(), self.degree.t + 1);
        let mut moved = 0.0f64;
        for k in (0..count).step_by(width) {
            let weight = if self.rational { self.poles[3 * count + k].high } else { 1.0 };
            for c in 0..3 {
                moved += self.poles[c * count + k].high.abs() / weight;
                self.poles[c * count + k] = Doubled::default();
                self.zeros[c * count + k] = true;
            }
        }
        (self, moved)
    }

    /// The coefficients of a component.
    pub fn component(&self, c: usize) -> &[Doubled] {
        let count = self.degree.count();
        &self.poles[c * count..(c + 1) * count]
    }

    /// How far the coefficients of a component may be off.
    ///
    /// Entries of the matrices have 5 operations a degree, each sum as many as the degree; the origin is two more.
    pub fn error(&self, c: usize) -> f64 {
        (16 * (self.degree.s + self.degree.t) + 64) as f64 * UNIT * self.sizes[c]
    }

    /// The net seen with the side (as `index::side`) at t = 0, and whether that is a mirror image in the parameters.
    pub fn turned(&self, side: usize) -> (Self, bool) {
        let Bidegree { s: p, t: q } = self.degree;
        let degree = if side < 2 { Bidegree { s: q, t: p } } else { self.degree };
        let (mut poles, mut zeros) = (Vec::new(), Vec::new());
        for start in (0..self.poles.len()).step_by((p + 1) * (q + 1)) {
            for i in 0..=degree.s {
                for j in 0..=degree.t {
                    let k = match side {
                        0 => j * (q + 1) + i,
                        1 => (p - j) * (q + 1) + i,
                        2 => i * (q + 1) + j,
                        _ => i * (q + 1) + q - j,
                    };
                    poles.push(self.poles[start + k]);
                    zeros.push(self.zeros[start + k]);
                }
            }
        }
        let net = Self { degree, rational: self.rational, poles, zeros, sizes: self.sizes };
        (net, side == 0 || side == 3)
    }
}

/// Coefficients in doubled precision, each off by at most `error`.
pub(super) struct Exact {
    pub coefficients: Vec<Doubled>,
    pub degree: Bidegree,
    pub error: f64,
}

impl Exact {
    fn size(&self) -> f64 {
        self.coefficients.iter().fold(0.0, |m: f64, x| m.max(x.high.abs()))
    }

    /// The derivative in direction 0 (s) or 1 (t); zero when the degree is.
    pub fn derivative(&self, direction: usize) -> Self {
        let Bidegree { s: p, t: q } = self.degree;
        let n = if direction == 0 { p } else { q };
        if n == 0 {
            let coefficients = vec![Doubled::default(); self.degree.count()];
            return Self { coefficients, degree: self.degree, error: 0.0 };
        }
        let degree = self.degree.lowered(direction);
        let step = if direction == 0 { q + 1 } else { 1 };
        let factor = Doubled::new(n as f64);
        let coefficients = (0..degree.count())
            .map(|k| {
                let at = k / (degree.t + 1) * (q + 1) + k % (degree.t + 1);
                factor * (self.coefficients[at + step] - self.coefficients[at])
            })
            .collect();
        let error = 2.0 * n as f64 * (self.error + 4.0 * UNIT * self.size());
        Self { coefficients, degree, error }
    }

    /// Divided `times` times by t; the coefficients that must vanish for it are left out.
    pub fn divided(&self, times: usize) -> Self {
        let (mut f, mut n, mut error) = (self.coefficients.clone(), self.degree.t, self.error);
        for _ in 0..times {
            let factor = |k: usize| Doubled::new(n as f64) / Doubled::new(k as f64);
            let rows = f.chunks_exact(n + 1);
            f = rows.flat_map(|row| (1..=n).map(move |k| row[k] * factor(k))).collect();
            error *= n as f64;
            n -= 1;
        }
        let degree = Bidegree { s: self.degree.s, t: n };
        let divided = Self { coefficients: f, degree, error };
        Self { error: divided.error + 8.0 * UNIT * divided.size(), ..divided }
    }

    pub fn rounded(&self) -> Rounded {
        let coefficients: Vec<f64> = self.coefficients.iter().map(|x| x.rounded()).collect();
        let width = self.degree.t + 1;
        let mut rows = vec![0.0f64; self.degree.s + 1];
        let mut columns = vec![0.0f64; width];
        for (row, most) in coefficients.chunks_exact(width).zip(&mut rows) {
            for (x, along) in row.iter().zip(&mut columns) {
                *along = if x.abs() > *along { x.abs() } else { *along };
                *most = if x.abs() > *most { x.abs() } else { *most };
            }
        }
        Rounded { coefficients, degree: self.degree, error: self.error, rows, columns }
    }
}

/// Coefficients as doubles: each is off by its own rounding, a half ulp, and by `error`.
pub(super) struct Rounded {
    pub coefficients: Vec<f64>,
    pub degree: Bidegree,
    pub error: f64,
    /// Greatest absolute coefficient of each row (s) and of each column (t).
    pub rows: Vec<f64>,
    pub columns: Vec<f64>,
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::index::IndexedSurface;

    #[test]
    fn a_net_of_a_tiny_span_keeps_its_second_derivative() {
        // z = u^2 on spans of which the middle one is 1e-9 long.
        let knots = [0., 0., 0., 0.5, 0.5 + 1e-9, 1., 1., 1.];
        let line = [0., 0., 1., 1.];
        let mut poles = Vec::new();
        for i in 0..5 {
            let (a, b) = (knots[i + 1], knots[i + 2]);
            poles.push([0.5 * (a + b), 0.0, a * b]);
            poles.push([0.5 * (a + b), 1.0, a * b]);
        }
        let surface = Surface::new(&knots, &line, 2, 1, &poles, 5, 2, None).unwrap();
        let surface = IndexedSurface::new(surface);
        let index = surface.index(&mut || false).unwrap();
        let mut nets = Nets::new(surface.surface(), index);
        let net = nets.net(1, [0.5; 2]);
        let z = Exact {
            coefficients: net.component(2).to_vec(),
            degree: net.degree,
            error: net.error(2),
        };
        let second = z.derivative(0).derivative(0).rounded();
        let width = (0.5 + 1e-9) - 0.5;
        for x in &second.coefficients {
            // The poles themselves are rounded to 1e-16: a share of 1e2 of what they differ by.
            let found = x / (index.frame.scale * width * width);
            assert!(second.error < 1e-8 * x.abs() && found.is_finite(), "{x} {}", second.error);
        }
        assert!(net.zeros.iter().any(|zero| *zero));
    }
}
