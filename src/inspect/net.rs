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
use crate::bounds::HALF_ULP;
use crate::index::SurfaceIndex;
use crate::knots::Knots;
use crate::surface::Surface;

/// Homogeneous poles of a patch, component by component, in index coordinates about a pole of the surface.
pub(super) struct ExactNet {
    pub degree: Bidegree,
    pub rational: bool,
    pub poles: Vec<Doubled>,
    /// Greatest absolute value of what each component was made of.
    sizes: [f64; 4],
}

/// A rounded net.
#[derive(Clone, Debug)]
pub(super) struct Net {
    pub degree: Bidegree,
    pub rational: bool,
    /// Component by component: x, y, z and, when rational, the weight.
    pub poles: Vec<f64>,
    /// How far the coefficients of each component may be off.
    pub errors: [f64; 4],
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
        row[p] = Doubled::ONE;
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

/// `2^-e` with `2^e <= x < 2^(e+1)`, for a positive normal number.
fn power_of_two_over(x: f64) -> f64 {
    1.0 / f64::from_bits(x.to_bits() & 0x7ff0_0000_0000_0000)
}

impl<'a> Nets<'a> {
    pub fn new(surface: &'a Surface, index: &'a SurfaceIndex) -> Self {
        let (columns, count) = (index.columns, index.patches.len());
        Self { surface, index, rows: vec![None; count / columns], columns: vec![None; columns] }
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
        let mut sizes = [0.0; 4];
        let mut half = vec![Doubled::default(); count];
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
                    let terms = (0..=p).map(|k| by_u[i * (p + 1) + k] * local[k * (q + 1) + j]);
                    half[i * (q + 1) + j] = terms.fold(Doubled::default(), |sum, x| sum + x);
                }
            }
            for i in 0..=p {
                for j in 0..=q {
                    let terms = (0..=q).map(|k| by_v[j * (q + 1) + k] * half[i * (q + 1) + k]);
                    poles.push(terms.fold(Doubled::default(), |sum, x| sum + x));
                }
            }
        }
        let degree = Bidegree { s: p, t: q };
        let mut net = ExactNet { degree, rational, poles, sizes };
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
        let weight = if self.rational { self.poles[3 * count + k] } else { Doubled::ONE };
        [0, 1, 2].map(|c| self.poles[c * count + k] / weight)
    }

    /// The net about `origin`, to the last digits of its own size.
    pub fn about(&self, origin: [Doubled; 3]) -> Self {
        let count = self.degree.count();
        let mut poles = self.poles.clone();
        let mut sizes = self.sizes;
        for c in 0..3 {
            for k in 0..count {
                let weight = if self.rational { self.poles[3 * count + k] } else { Doubled::ONE };
                poles[c * count + k] = poles[c * count + k] - origin[c] * weight;
            }
            sizes[c] += 2.0 * origin[c].high.abs();
        }
        Self { degree: self.degree, rational: self.rational, poles, sizes }
    }

    pub fn rounded(&self) -> Net {
        let count = self.degree.count();
        let poles: Vec<f64> = self.poles.iter().map(|x| x.rounded()).collect();
        // Entries of the matrices have 5 operations a degree, each sum as many as the degree; the origin is two more.
        let steps = (16 * (self.degree.s + self.degree.t) + 64) as f64 * UNIT;
        let mut errors = [0.0; 4];
        for (c, part) in poles.chunks_exact(count).enumerate() {
            let size = part.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
            errors[c] = steps * self.sizes[c] + 2.0 * HALF_ULP * size;
        }
        Net { degree: self.degree, rational: self.rational, poles, errors }
    }
}

impl Net {
    /// The coefficients of a component.
    pub fn component(&self, c: usize) -> &[f64] {
        let count = self.degree.count();
        &self.poles[c * count..(c + 1) * count]
    }

    /// The net seen with the side (as `index::side`) at t = 0, and whether that is a mirror image in the parameters.
    pub fn turned(&self, side: usize) -> (Self, bool) {
        let Bidegree { s: p, t: q } = self.degree;
        let is_across = side < 2;
        let degree = if is_across { Bidegree { s: q, t: p } } else { self.degree };
        let mut poles = Vec::with_capacity(self.poles.len());
        for part in self.poles.chunks_exact((p + 1) * (q + 1)) {
            for i in 0..=degree.s {
                for j in 0..=degree.t {
                    let k = match side {
                        0 => j * (q + 1) + i,
                        1 => (p - j) * (q + 1) + i,
                        2 => i * (q + 1) + j,
                        _ => i * (q + 1) + q - j,
                    };
                    poles.push(part[k]);
                }
            }
        }
        let net = Self { degree, rational: self.rational, poles, errors: self.errors };
        (net, side == 0 || side == 3)
    }
}
