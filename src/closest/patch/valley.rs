//! Valleys: areas in which `h` is convex in one parameter and nearly level in the other, as around a query near an axis of
//! curvature. Boxes close there when they are as narrow as the square root of the height, a line along the floor when its
//! length is about the fourth root.
//!
//! With `h_tt >= M > 0` and any line `t = l(s)` in the area, each point of it is bounded by Taylor's formula about the line,
//!
//! ```text
//!   h(s, t) >= g(s) - d(s)^2 / (2 M)        with g(s) = h(s, l(s)) and d(s) = h_t(s, l(s)),
//! ```
//!
//! so that polynomials of one parameter remain.

use super::super::certificate::free_slope;
use super::{Area, Walk};
use crate::bezier::{binomial, cut};
use crate::bounds::{HALF_ULP, extent};
use crate::coefficients::Differences;

/// Boxes of a query after which valleys are looked for; after some tries of which less than one in four closed its area, in
/// one box of `SELDOM`.
const LATE: u64 = 24;
const TRIES: u64 = 4;
const SELDOM: u64 = 8;
/// Most of both degrees of `h` together: beyond, a try costs more than the boxes that it saves.
const MOST_DEGREE: usize = 20;

/// Steps to the least point of a convex polynomial.
const STEPS: usize = 2;

/// Halvings of the line.
const DEPTH: u32 = 2;

impl Walk<'_, '_, '_> {
    /// Whether the floor of a valley shows that nothing in the area is nearer than the target (in a walk for ties: than their
    /// reach).
    pub(super) fn valley(
        &mut self,
        area: &Area,
        at: usize,
        weight: f64,
        slopes: &Differences,
    ) -> bool {
        let (tries, hits) = self.proof.valleys;
        let rarely = tries >= TRIES && 4 * hits < tries;
        if self.proof.spent <= LATE || rarely && !self.proof.spent.is_multiple_of(SELDOM) {
            return false;
        }
        self.proof.valleys.0 += 1;
        let level = self.proof.level_squared();
        let slopes =
            if self.sheet.net.rational { self.differences(area, at, level) } else { *slopes };
        let Some(height) = self.floor(area, at, weight, &slopes) else { return false };
        if height <= (self.proof.tie_squared() - level) * weight {
            self.proof.loosen(self.proof.target);
        }
        self.proof.valleys.1 += 1;
        true
    }

    /// A positive lower bound of `N - level C` from the floor of the valley.
    fn floor(&mut self, area: &Area, at: usize, weight: f64, slopes: &Differences) -> Option<f64> {
        let (degree, error) = (self.grid(area).degree, area.error * weight);
        let level = self.proof.level_squared();
        let bend = |n: usize, least: f64, k: usize| {
            (n * n.saturating_sub(1)) as f64 * (least - 4.0 * error * area.growth[k])
        };
        let (a, c) = (bend(degree.s, slopes.ss, 0), bend(degree.t, slopes.tt, 1));
        let across_t = c >= a;
        let (m, n) = if across_t { (degree.s, degree.t) } else { (degree.t, degree.s) };
        if !(a.max(c) > 0.0 && error.is_finite() && m + n <= MOST_DEGREE) {
            return None;
        }
        let mut memory = std::mem::take(&mut self.memory.valley);
        let curve = (m + n + 1) * (DEPTH as usize + 2);
        memory.clear();
        memory.resize((m + 1) * (2 * n + 1) + 2 * curve, 0.0);
        let (h, rest) = memory.split_at_mut((m + 1) * (n + 1));
        let (values, weights) = (self.n(area, at), self.c(area, at));
        let mut size = 0.0_f64;
        for j in 0..=n {
            for i in 0..=m {
                let k = if across_t { i * (n + 1) + j } else { j * (m + 1) + i };
                let c = if weights.is_empty() { 1.0 } else { weights[k] };
                h[j * (m + 1) + i] = values[k] - level * c;
                size = size.max(h[j * (m + 1) + i].abs());
            }
        }
        // What first differences need is more than enough for values.
        let error = error * area.growth[0].max(area.growth[1]).sqrt();
        let error = error + 64.0 * (m + n) as f64 * HALF_ULP * size;
        let height = Floor { m, n, bend: a.max(c), error }.over(h, rest);
        self.memory.valley = memory;
        height
    }
}

/// A valley: degrees `m` along and `n` across it.
struct Floor {
    m: usize,
    n: usize,
    /// Least second derivative across.
    bend: f64,
    /// How far a coefficient may be off.
    error: f64,
}

impl Floor {
    /// A positive lower bound of `h`. Coefficient (i along, j across) is `h[j (m + 1) + i]`; `rest` is room.
    fn over(&self, h: &mut [f64], rest: &mut [f64]) -> Option<f64> {
        let (n, row) = (self.n, self.m + 1);
        let [low, high] = self.line(h)?;
        let (slope, curve) = rest.split_at_mut(row * n);
        for (k, x) in slope.iter_mut().enumerate() {
            *x = n as f64 * (h[k + row] - h[k]);
        }
        let (from, to) = (low.min(high), low.max(high));
        cut(h, n, row, row, from, to);
        cut(slope, n - 1, row, row, from, to);
        let (g, d) = curve.split_at_mut(curve.len() / 2);
        self.collect(h, n, low > high, g);
        self.collect(slope, n - 1, low > high, d);
        self.height([low, high], g, d, DEPTH)
    }

    /// The diagonal of a net of `degree` across, as coefficients.
    fn collect(&self, net: &[f64], degree: usize, falls: bool, out: &mut [f64]) {
        let (m, total) = (self.m, self.m + degree);
        out[..=total].fill(0.0);
        for j in 0..=degree {
            let from = if falls { degree - j } else { j } * (m + 1);
            for i in 0..=m {
                out[j + i] += binomial(m, i) * binomial(degree, j) * net[from + i];
            }
        }
        for (k, x) in out[..=total].iter_mut().enumerate() {
            *x /= binomial(total, k);
        }
    }

    /// The line along the floor, by its ends: through the least points of the two ends of the area, moved by half of what
    /// the least point of the middle is off. `None` when the bound fails at one of the three.
    fn line(&self, h: &[f64]) -> Option<[f64; 2]> {
        let (m, row) = (self.m, self.m + 1);
        let half = 0.5_f64.powi(m as i32);
        let middle = |j: usize| {
            let strand = h[j * row..][..row].iter().enumerate();
            half * strand.map(|(i, x)| binomial(m, i) * x).sum::<f64>()
        };
        let stations =
            [self.station(|j| h[j * row]), self.station(middle), self.station(|j| h[j * row + m])];
        let [low, middle, high] = stations.map(|b| least_point(&b[..=self.n]));
        let off = 0.5 * (middle - 0.5 * (low + high));
        let ends = [low, high].map(|x| (x + off).clamp(0.0, 1.0));
        let places = [ends[0], 0.5 * (ends[0] + ends[1]), ends[1]];
        let holds = |(b, at): (&Strand, f64)| {
            let [value, slope, _] = jet(&b[..=self.n], at);
            value > self.loss([slope; 2], [at; 2])
        };
        stations.iter().zip(places).all(holds).then_some(ends)
    }

    fn station(&self, coefficient: impl Fn(usize) -> f64) -> Strand {
        let mut b = [0.0; MOST_DEGREE + 1];
        for (j, x) in b[..=self.n].iter_mut().enumerate() {
            *x = coefficient(j);
        }
        b
    }

    /// What `h` may lose off the line where its slope across is in an extent and the line at `l`: down to the vertex of the
    /// parabola across, or to the side of the area.
    fn loss(&self, [falling, rising]: [f64; 2], l: [f64; 2]) -> f64 {
        let slack = 2.0 * self.n as f64 * self.error;
        let to = |slope: f64, room: f64| {
            let slope = (slope + slack).max(0.0);
            slope * room.min(slope / (2.0 * self.bend))
        };
        let (below, above) = (l[0].max(l[1]), 1.0 - l[0].min(l[1]));
        to(rising, below).max(to(-falling, above)) * (1.0 + 1e-12) + self.error
    }

    /// A positive lower bound of `g - d^2 / (2 M)` along the line from l[0] to l[1], from the first coefficients in `g` and `d`; the rest is room for halves.
    fn height(&self, l: [f64; 2], g: &mut [f64], d: &mut [f64], depth: u32) -> Option<f64> {
        let (length, shorter) = (self.m + self.n + 1, self.m + self.n);
        let (falling, rising) = extent(&d[..shorter]);
        let loss = self.loss([falling, rising], l);
        let least = extent(&g[..length]).0;
        if least > loss {
            return Some(least - loss);
        }
        if let Some(value) = self.tangent(&g[..length]).filter(|value| *value > loss) {
            return Some(value - loss);
        }
        let middle = 0.5 * (l[0] + l[1]);
        let fails = |k: usize, i: usize| {
            g[k * (length - 1)] <= self.loss([d[k * (shorter - 1)]; 2], [l[i]; 2])
        };
        if depth == 0 || fails(0, 0) || fails(1, 1) {
            return None;
        }
        let (g, g_half) = g.split_at_mut(length);
        let (d, d_half) = d.split_at_mut(length);
        halve(g, &mut g_half[..length]);
        halve(&mut d[..shorter], &mut d_half[..shorter]);
        let upper = self.height([middle, l[1]], g_half, d_half, depth - 1)?;
        g_half[..length].copy_from_slice(g);
        d_half[..shorter].copy_from_slice(&d[..shorter]);
        Some(upper.min(self.height([l[0], middle], g_half, d_half, depth - 1)?))
    }

    /// The least value of g, when it is convex.
    fn tangent(&self, g: &[f64]) -> Option<f64> {
        let n = g.len() - 1;
        let second = |x: &[f64]| (x[0] - x[1]) + (x[2] - x[1]);
        let least = g.windows(3).map(second).fold(f64::INFINITY, f64::min);
        let bend = (n * (n - 1)) as f64 * (least - 4.0 * self.error);
        if bend <= 0.0 {
            return None;
        }
        let at = least_point(g);
        let [value, first, _] = jet(g, at);
        let slope = free_slope(first, 2.0 * n as f64 * self.error, at == 0.0, at == 1.0);
        Some(value - slope * slope / (2.0 * bend) * (1.0 + 1e-12) - self.error)
    }
}

/// Coefficients in one direction.
type Strand = [f64; MOST_DEGREE + 1];

/// Near the least point of a convex polynomial of degree >= 2 on [0, 1].
fn least_point(coefficients: &[f64]) -> f64 {
    let mut at = 0.5;
    for _ in 0..STEPS {
        let [_, first, second] = jet(coefficients, at);
        let next = at - first / second;
        if next.is_nan() {
            return at;
        }
        at = next.clamp(0.0, 1.0);
    }
    at
}

/// Value and two derivatives of a polynomial of degree >= 2: means of three coefficients each, weighted by the Bernstein polynomials of
/// a degree that is less by two.
fn jet(coefficients: &[f64], t: f64) -> [f64; 3] {
    let n = coefficients.len() - 1;
    let (mut b, mut power) = ([coefficients[0], coefficients[1], coefficients[2]], 1.0);
    for (k, three) in coefficients.windows(3).enumerate().skip(1) {
        power *= t;
        let share = binomial(n - 2, k) * power;
        for (sum, x) in b.iter_mut().zip(three) {
            *sum = *sum * (1.0 - t) + share * x;
        }
    }
    let (low, high) = (b[1] - b[0], b[2] - b[1]);
    let (a, c) = (b[0] + t * low, b[1] + t * high);
    let n = n as f64;
    [a + t * (c - a), n * (c - a), n * (n - 1.0) * (high - low)]
}

/// Splits at the middle: `low` becomes the first half, `high` the rest.
fn halve(low: &mut [f64], high: &mut [f64]) {
    let last = low.len() - 1;
    for k in 0..=last {
        high[last - k] = low[last];
        for i in (k + 1..=last).rev() {
            low[i] = 0.5 * (low[i - 1] + low[i]);
        }
    }
}
