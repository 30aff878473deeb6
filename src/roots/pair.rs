//! Common zeros of two polynomials in two parameters.

use super::{Found, LEAST_WIDTH, Zero, push_root, spend};
use crate::bezier::{Bidegree, MAX_TRIPLE, basis, halve_s, halve_t};
use crate::bounds::{HALF_ULP, extent};
use crate::closest::Slopes;

/// On the whole box, the preconditioned derivative may differ from the identity by at most this in the greatest row
/// sum. Below 1 it is regular; the distance to 1 keeps the bounds that divide by `1 - x` sharp.
const MOST_DEVIATION: f64 = 0.8;

/// How far outside its box, as a share of it, Newton may end and still mean a zero on the border seen from both sides.
const OVERSHOOT: f64 = 1e-9;

/// Values below this many allowances are rounding: halving does not tell more about them.
const NOISE: f64 = 4.0;

/// Boxes after which a pair counts as difficult: values are then taken as good as zero as easily as if rounding hid them.
const PATIENCE: u32 = 400;

/// Two polynomials of the same bidegree on the unit box.
pub struct Pair<'a> {
    /// Coefficients of the first.
    pub first: &'a [f64],
    /// Coefficients of the second.
    pub second: &'a [f64],
    /// Their bidegree.
    pub degree: Bidegree,
    /// How far the coefficients of each may be off.
    pub error: [f64; 2],
}

/// What the caller knows of the meaning of the values.
pub trait Meaning {
    /// Factors that make greatest values of the two polynomials on a box comparable: the greater the product of value,
    /// factor and width, the more the box needs halving in that direction.
    fn scale(&self, low: [f64; 2], high: [f64; 2]) -> [f64; 2];
    /// Whether values of at most `sizes` on the box are as good as zero; `is_noise`: rounding is as large as they are.
    fn is_flat(&self, low: [f64; 2], high: [f64; 2], sizes: [f64; 2], is_noise: bool) -> bool;
}

#[derive(Clone, Copy)]
struct Area {
    low: [f64; 2],
    high: [f64; 2],
    error: [f64; 2],
}

/// Appends all common zeros of the pair on the unit box to `out`.
pub fn zeros_of_pair(pair: &Pair, meaning: &dyn Meaning, budget: &mut u64, out: &mut Vec<Zero<2>>) {
    let count = pair.degree.count();
    let mut memory = Vec::with_capacity(32 * 2 * count);
    memory.extend_from_slice(pair.first);
    memory.extend_from_slice(pair.second);
    let growth = [0, 1].map(|k| {
        let (low, high) = extent(&memory[k * count..(k + 1) * count]);
        2.0 * HALF_ULP * pair.degree.s.max(pair.degree.t) as f64 * low.abs().max(high.abs())
    });
    let scratch = vec![0.0; 2 * count];
    let first = out.len();
    let mut walk = Walk {
        degree: pair.degree,
        count,
        memory,
        scratch,
        growth,
        meaning,
        out,
        first,
        looked: 0,
    };
    let mut waiting = vec![Area { low: [0.0; 2], high: [1.0; 2], error: pair.error }];
    while let Some(area) = waiting.pop() {
        match walk.judge(&area, waiting.len(), budget) {
            Verdict::Closed => {}
            Verdict::Halve(direction) => walk.halve(area, &mut waiting, direction),
        }
    }
}

enum Verdict {
    Closed,
    Halve(usize),
}

struct Walk<'a, 'b> {
    degree: Bidegree,
    count: usize,
    memory: Vec<f64>,
    scratch: Vec<f64>,
    growth: [f64; 2],
    meaning: &'a dyn Meaning,
    out: &'b mut Vec<Zero<2>>,
    first: usize,
    /// Boxes looked at.
    looked: u32,
}

fn greatest((low, high): (f64, f64)) -> f64 {
    low.abs().max(high.abs())
}

impl Walk<'_, '_> {
    fn coefficients(&self, at: usize, k: usize) -> &[f64] {
        let start = (2 * at + k) * self.count;
        &self.memory[start..start + self.count]
    }

    fn judge(&mut self, area: &Area, at: usize, budget: &mut u64) -> Verdict {
        let ranges = [0, 1].map(|k| extent(self.coefficients(at, k)));
        if (0..2).any(|k| ranges[k].0 > area.error[k] || ranges[k].1 < -area.error[k]) {
            return Verdict::Closed;
        }
        let sizes = ranges.map(greatest);
        if self.isolate(area, at) {
            return Verdict::Closed;
        }
        self.looked += 1;
        let is_noise = self.looked > PATIENCE || (0..2).all(|k| sizes[k] <= NOISE * area.error[k]);
        if self.meaning.is_flat(area.low, area.high, sizes, is_noise) {
            self.out.push(Zero::area(Found::Flat, area.low, area.high));
            return Verdict::Closed;
        }
        let width = [area.high[0] - area.low[0], area.high[1] - area.low[1]];
        if width[0].max(width[1]) < LEAST_WIDTH || !spend(budget) {
            self.out.push(Zero::area(Found::Undecided, area.low, area.high));
            return Verdict::Closed;
        }
        Verdict::Halve(self.direction(area, at, sizes))
    }

    /// Which parameter to halve: the one along which more of what the values mean goes.
    fn direction(&self, area: &Area, at: usize, sizes: [f64; 2]) -> usize {
        let width = [0, 1].map(|k| area.high[k] - area.low[k]);
        let scale = self.meaning.scale(area.low, area.high);
        // What rounding hides does not get smaller by halving; where it hides both, the box is flat once it is small
        // enough, and then what is hidden counts.
        let seen = [0, 1].map(|k| (sizes[k] - NOISE * area.error[k]).max(0.0));
        let left = if seen == [0.0; 2] { sizes } else { seen };
        let mut need = [0, 1].map(|k| left[k] * scale[k] * width[k]);
        if self.looked > PATIENCE {
            // Along an oblique line of zeros a value may come from the other parameter than its own: there halving
            // its own one for ever does not make it less.
            let slopes = self.derivative([self.coefficients(at, 0), self.coefficients(at, 1)]);
            let share = |j: usize, k: usize| (greatest(slopes[j][k]) / sizes[j]).min(1.0);
            need = [0, 1].map(|k| need[0] * share(0, k) + need[1] * share(1, k));
        }
        let narrow = [0, 1].map(|k| width[k] < LEAST_WIDTH);
        let s_first = need[0] > need[1] || (need[0] == need[1] && width[0] >= width[1]);
        if narrow[1] || (s_first && !narrow[0]) { 0 } else { 1 }
    }

    /// The derivative in the unit parameters of the area: ranges of the four entries.
    fn derivative(&self, values: [&[f64]; 2]) -> [[(f64, f64); 2]; 2] {
        let (n, m) = (self.degree.s as f64, self.degree.t as f64);
        values.map(|g| {
            let mut slopes = Slopes::NONE;
            slopes.include(g, self.degree);
            [(n * slopes.s.0, n * slopes.s.1), (m * slopes.t.0, m * slopes.t.1)]
        })
    }

    /// Closes the area when it provably holds no zero, or exactly one; false when it must be looked at closer.
    fn isolate(&mut self, area: &Area, at: usize) -> bool {
        let ranges = self.derivative([self.coefficients(at, 0), self.coefficients(at, 1)]);
        let middle = ranges.map(|row| row.map(|(low, high)| 0.5 * (low + high)));
        let det = middle[0][0] * middle[1][1] - middle[0][1] * middle[1][0];
        let size = (middle[0][0] * middle[1][1]).abs() + (middle[0][1] * middle[1][0]).abs();
        if det.is_nan() || det.abs() <= 1e-12 * size {
            return false;
        }
        let inverse =
            [[middle[1][1] / det, -middle[0][1] / det], [-middle[1][0] / det, middle[0][0] / det]];
        let error = inverse.map(|row| {
            let size = [0, 1].map(|k| greatest(extent(self.coefficients(at, k))));
            let rounded = 8.0 * HALF_ULP * (row[0].abs() * size[0] + row[1].abs() * size[1]);
            row[0].abs() * area.error[0] + row[1].abs() * area.error[1] + rounded
        });
        if error.iter().any(|x| x.is_nan() || *x > 1e-2) {
            return false;
        }
        self.precondition(at, inverse);
        let p = [&self.scratch[..self.count], &self.scratch[self.count..]];
        for k in 0..2 {
            let (low, high) = extent(p[k]);
            if low > error[k] || high < -error[k] {
                return true;
            }
        }
        let slopes = self.derivative(p);
        let steps = [self.degree.s as f64, self.degree.t as f64].map(|n| 2.0 * n);
        let mut deviation = [0.0; 2];
        for i in 0..2 {
            for j in 0..2 {
                let (low, high) = slopes[i][j];
                let wanted = if i == j { 1.0 } else { 0.0 };
                deviation[i] +=
                    (low - wanted).abs().max((high - wanted).abs()) + steps[j] * error[i];
            }
        }
        let worst = deviation[0].max(deviation[1]);
        if worst > MOST_DEVIATION {
            return false;
        }
        self.settle(area, error, deviation)
    }

    /// `inverse` times the two polynomials, into the scratch memory.
    fn precondition(&mut self, at: usize, inverse: [[f64; 2]; 2]) {
        let count = self.count;
        let (first, second) = self.memory[2 * at * count..2 * (at + 1) * count].split_at(count);
        let (a, b) = self.scratch.split_at_mut(count);
        for k in 0..count {
            a[k] = inverse[0][0] * first[k] + inverse[0][1] * second[k];
            b[k] = inverse[1][0] * first[k] + inverse[1][1] * second[k];
        }
    }

    /// At most one zero is left: Newton finds it, or Krawczyk's interval shows that there is none.
    fn settle(&mut self, area: &Area, error: [f64; 2], deviation: [f64; 2]) -> bool {
        let at_middle = self.values([0.5; 2]);
        for k in 0..2 {
            let centre = 0.5 - at_middle[k][0];
            let reach = 0.5 * deviation[k] + error[k];
            if centre + reach < 0.0 || centre - reach > 1.0 {
                return true;
            }
        }
        let Some(x) = self.newton() else { return false };
        let slack = OVERSHOOT + 8.0 * error[0].max(error[1]) / (1.0 - MOST_DEVIATION);
        if x.iter().any(|x| !(-slack..=1.0 + slack).contains(x)) {
            return false;
        }
        let at = [0, 1].map(|k| {
            let x = x[k].clamp(0.0, 1.0);
            area.low[k] + x * (area.high[k] - area.low[k])
        });
        let width = (area.high[0] - area.low[0]).max(area.high[1] - area.low[1]);
        push_root(self.out, self.first, Zero::root(at, slack * width + 8.0 * HALF_ULP));
        true
    }

    /// Newton from the middle, in the unit parameters of the area.
    fn newton(&self) -> Option<[f64; 2]> {
        let mut x = [0.5; 2];
        for _ in 0..12 {
            let [[f, fs, ft], [g, gs, gt]] = self.values(x);
            let det = fs * gt - ft * gs;
            let step = [(ft * g - gt * f) / det, (gs * f - fs * g) / det];
            if step.iter().any(|d| d.is_nan() || d.abs() > 4.0) {
                return None;
            }
            x = [x[0] + step[0], x[1] + step[1]];
            if x.iter().any(|x| !(-0.5..=1.5).contains(x)) {
                return Some(x);
            }
            if step[0].abs().max(step[1].abs()) < 1e-12 {
                return Some(x);
            }
        }
        None
    }

    /// Value and both slopes of the two preconditioned polynomials.
    fn values(&self, x: [f64; 2]) -> [[f64; 3]; 2] {
        let mut arrays = [[0.0; MAX_TRIPLE]; 6];
        let [a, a1, a2, b, b1, b2] = &mut arrays;
        basis::<f64, 1, MAX_TRIPLE>(self.degree.s, x[0], a, a1, a2);
        basis::<f64, 1, MAX_TRIPLE>(self.degree.t, x[1], b, b1, b2);
        let width = self.degree.t + 1;
        [0, 1].map(|k| {
            let mut sum = [0.0; 3];
            let g = &self.scratch[k * self.count..(k + 1) * self.count];
            for (i, row) in g.chunks_exact(width).enumerate() {
                let (mut value, mut slope) = (0.0, 0.0);
                for (j, c) in row.iter().enumerate() {
                    value += b[j] * c;
                    slope += b1[j] * c;
                }
                sum[0] += a[i] * value;
                sum[1] += a1[i] * value;
                sum[2] += a[i] * slope;
            }
            sum
        })
    }

    fn halve(&mut self, area: Area, waiting: &mut Vec<Area>, direction: usize) {
        let (at, count) = (waiting.len(), self.count);
        let needed = 2 * (at + 2) * count;
        if self.memory.len() < needed {
            self.memory.resize(needed, 0.0);
        }
        let (low, high) = self.memory[2 * at * count..needed].split_at_mut(2 * count);
        for (a, b) in low.chunks_exact_mut(count).zip(high.chunks_exact_mut(count)) {
            if direction == 0 { halve_s(a, b, self.degree) } else { halve_t(a, b, self.degree) }
        }
        let error = [area.error[0] + self.growth[0], area.error[1] + self.growth[1]];
        let middle = 0.5 * (area.low[direction] + area.high[direction]);
        let mut pair = [Area { error, ..area }; 2];
        pair[0].high[direction] = middle;
        pair[1].low[direction] = middle;
        waiting.extend(pair);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Plain;

    impl Meaning for Plain {
        fn scale(&self, _: [f64; 2], _: [f64; 2]) -> [f64; 2] {
            [1.0; 2]
        }

        fn is_flat(&self, low: [f64; 2], high: [f64; 2], sizes: [f64; 2], _: bool) -> bool {
            sizes[0] * (high[0] - low[0]) + sizes[1] * (high[1] - low[1]) < 1e-10
        }
    }

    fn found(first: &[f64], second: &[f64], degree: Bidegree) -> Vec<Zero<2>> {
        let mut out = Vec::new();
        let pair = Pair { first, second, degree, error: [1e-15; 2] };
        zeros_of_pair(&pair, &Plain, &mut 20_000, &mut out);
        out
    }

    #[test]
    fn a_circle_and_a_line_meet_twice() {
        // (s - 1/2)^2 + (t - 1/2)^2 = 1/16 and s = t, in bidegree (2, 2).
        let parabola = [0.25, -0.25, 0.25];
        let line = [0.0, 0.5, 1.0];
        let mut f = [0.0; 9];
        let mut g = [0.0; 9];
        for i in 0..3 {
            for j in 0..3 {
                f[3 * i + j] = parabola[i] + parabola[j] - 1.0 / 16.0;
                g[3 * i + j] = line[i] - line[j];
            }
        }
        let zeros = found(&f, &g, Bidegree { s: 2, t: 2 });
        let r = 0.125f64.sqrt() / 2.0;
        assert_eq!(zeros.len(), 2, "{zeros:?}");
        for x in [0.5 - r, 0.5 + r] {
            assert!(zeros.iter().any(|z| (z.at[0] - x).abs() + (z.at[1] - x).abs() < 1e-12));
        }
        assert!(zeros.iter().all(|z| z.found == Found::Root));
    }

    #[test]
    fn a_zero_on_the_border_of_boxes_is_found_once_and_one_on_the_border_of_all_too() {
        // s = 1/2, t = 1/2; then s = 0, t = 1.
        let zeros =
            found(&[-0.5, -0.5, 0.5, 0.5], &[-0.5, 0.5, -0.5, 0.5], Bidegree { s: 1, t: 1 });
        assert_eq!(zeros.len(), 1);
        assert_eq!(zeros[0].at, [0.5, 0.5]);
        let zeros = found(&[0.0, 0.0, 1.0, 1.0], &[-1.0, 0.0, -1.0, 0.0], Bidegree { s: 1, t: 1 });
        assert_eq!((zeros.len(), zeros[0].at), (1, [0.0, 1.0]));
    }

    #[test]
    fn a_line_of_zeros_along_a_parameter_takes_few_boxes() {
        // First: zero everywhere; second: t - 1/3.
        let third = 1.0 / 3.0;
        let second = [-third, 1.0 - third, -third, 1.0 - third];
        let mut budget = 1_000;
        let pair = Pair {
            first: &[0.0; 4],
            second: &second,
            degree: Bidegree { s: 1, t: 1 },
            error: [1e-15; 2],
        };
        let mut out = Vec::new();
        zeros_of_pair(&pair, &Plain, &mut budget, &mut out);
        assert!(budget > 900, "{budget}");
        assert!(out.iter().all(|z| z.found == Found::Flat && z.low[0] == 0.0 && z.high[0] == 1.0));
        assert!(out.iter().any(|z| z.low[1] <= third && third <= z.high[1]));
    }
}
