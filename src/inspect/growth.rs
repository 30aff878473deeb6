//! Whether a curvature grows beyond every bound at a side of a patch: the orders of what it is a quotient of.
//!
//! ```text
//!   s = s0, t -> 0:     l = l_i t^i + ...     E = E_j t^j + ...     D = D_k t^k + ...
//!   normal curvature along s:   l / (sqrt(D) E)  ~  t^(i - k/2 - j)    grows without bound when the exponent is negative
//! ```
//!
//! Coefficients that vanish because poles coincide are exactly zero; the first one that is not must exclude zero, rounding
//! included. A cone's tip has i = 2, j = 2, k = 2: 1 / t. A cusp (two equal rows of poles) has the same along t.
//!
//! In a corner the partials may be parallel without vanishing. Then the direction that bends without bound is neither that of s nor
//! that of t, and the mean curvature, which knows all directions, tells: E q - 2 F m + G l over 2 D^(3/2), there t / t^3. A
//! corner is approached along curves s - s0 = t^a too, each of which sees other terms first.
//!
//! Limit: approaches from sides of patches along these curves; orders below 16.

use super::doubled::{Doubled, UNIT};
use super::interval::Interval;
use super::net::ExactNet;
use super::request::Quantity;
use crate::bezier::binomial;
use crate::bounds::HALF_ULP;

/// Terms that are kept.
const TERMS: usize = 16;

/// A way into a side: s = s0 + sign x^a, t = x^b for x -> 0; a is 0 when s stays.
#[derive(Clone, Copy)]
pub(super) struct Way {
    pub s0: f64,
    pub sign: f64,
    pub powers: [usize; 2],
}

impl Way {
    /// Straight across the side.
    pub fn across(s0: f64) -> Self {
        Self { s0, sign: 0.0, powers: [0, 1] }
    }

    /// Into a corner, s0 being 0 or 1.
    pub fn into_corner(s0: f64) -> [Self; 4] {
        let sign = 1.0 - 2.0 * s0;
        let bent = [[1, 1], [1, 2], [2, 1]].map(|powers| Self { s0, sign, powers });
        [Self::across(s0), bent[0], bent[1], bent[2]]
    }
}

/// A power series in t; exact zeros are [0, 0].
#[derive(Clone)]
struct Series([Interval; TERMS]);

const ZERO: Interval = Interval::point(0.0);

fn sum(a: Interval, b: Interval) -> Interval {
    match (a == ZERO, b == ZERO) {
        (true, _) => b,
        (_, true) => a,
        _ => a + b,
    }
}

impl Series {
    fn plus(&self, factor: f64, other: &Self) -> Self {
        let scaled = |x: Interval| if x == ZERO { ZERO } else { x.times(factor) };
        Self(std::array::from_fn(|k| sum(self.0[k], scaled(other.0[k]))))
    }

    fn times(&self, other: &Self) -> Self {
        let mut out = [ZERO; TERMS];
        for i in 0..TERMS {
            for j in 0..TERMS - i {
                if self.0[i] != ZERO && other.0[j] != ZERO {
                    out[i + j] = sum(out[i + j], self.0[i] * other.0[j]);
                }
            }
        }
        Self(out)
    }

    /// The derivative by t; its last term is not known.
    fn derivative(&self) -> Self {
        let term = |k: usize| match self.0.get(k + 1) {
            Some(&x) if x == ZERO => ZERO,
            Some(x) => x.times((k + 1) as f64),
            None => Interval::ENTIRE,
        };
        Self(std::array::from_fn(term))
    }

    /// The first term that is not zero: its order and its sign; none when that is not known.
    fn lead(&self) -> Option<(i32, f64)> {
        let k = self.0.iter().position(|&x| x != ZERO)?;
        let sign = if self.0[k].low > 0.0 { 1.0 } else { -1.0 };
        (!self.0[k].holds_zero()).then_some((k as i32, sign))
    }
}

type Vector = [Series; 3];

fn dot(a: &Vector, b: &Vector) -> Series {
    let terms = [0, 1, 2].map(|k| a[k].times(&b[k]));
    terms[0].plus(1.0, &terms[1]).plus(1.0, &terms[2])
}

fn cross(a: &Vector, b: &Vector) -> Vector {
    [0, 1, 2].map(|k| {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        a[i].times(&b[j]).plus(-1.0, &a[j].times(&b[i]))
    })
}

fn mixed(a: &Series, x: &Vector, factor: f64, b: &Series, y: &Vector) -> Vector {
    [0, 1, 2].map(|k| a.times(&x[k]).plus(factor, &b.times(&y[k])))
}

/// A number in doubled precision, and whether it is exactly zero.
type Digit = (Doubled, bool);

/// The derivatives by s of a component at s0 up to an order, as series in t.
fn by_s(net: &ExactNet, c: usize, last: usize, s0: f64) -> Vec<Series> {
    let (p, width, count) = (net.degree.s, net.degree.t + 1, net.degree.count());
    let of = |k: usize| (net.poles[c * count + k], net.zeros[c * count + k]);
    let size = (0..count).map(|k| of(k).0.high.abs()).fold(0.0, f64::max);
    let error = net.error(c) + (8 * p + 8) as f64 * UNIT * size;
    let row = |i: usize| (i * width..(i + 1) * width).map(of).collect::<Vec<Digit>>();
    let mut found = Vec::new();
    if s0 == 0.0 || s0 == 1.0 {
        // Differences of rows, from the one at s0 inwards: all orders at once.
        let mut rows: Vec<Vec<Digit>> = (0..=p).map(row).collect();
        if s0 == 1.0 {
            rows.reverse();
        }
        let mut factor = 1.0;
        for order in 0..=last.min(p) {
            found.push(along_t(&rows[0], factor, error * 2.0f64.powi(order as i32), size));
            // From s = 1 the parameter runs backwards.
            factor *= (p - order) as f64 * (1.0 - 2.0 * s0);
            for k in 0..p - order {
                let (inner, outer) = rows.split_at_mut(k + 1);
                for (a, b) in inner[k].iter_mut().zip(&outer[0]) {
                    *a = (b.0 - a.0, a.1 && b.1);
                }
            }
        }
    } else {
        for order in 0..=last.min(p) {
            let mut rows: Vec<Digit> = (0..count).map(of).collect();
            let (share, mut factor) = (Doubled::new(s0), 1.0);
            let rest = Doubled::one() - share;
            for level in 0..p {
                for k in 0..(p - level) * width {
                    let ((a, is_a), (b, is_b)) = (rows[k], rows[k + width]);
                    rows[k] = if level < order {
                        (b - a, is_a && is_b)
                    } else {
                        (rest * a + share * b, is_a && is_b)
                    };
                }
                if level < order {
                    factor *= (p - level) as f64;
                }
            }
            found.push(along_t(&rows[..width], factor, error * 2.0f64.powi(order as i32), size));
        }
    }
    found.resize(last + 1, Series([ZERO; TERMS]));
    found
}

/// `factor` times the polynomial with these Bernstein coefficients, each off by at most `error`, as a series.
fn along_t(row: &[Digit], factor: f64, error: f64, size: f64) -> Series {
    // Differences along t: coefficient k of the power form is C(n, k) times the difference of order k.
    let n = row.len() - 1;
    let mut row = row.to_vec();
    let mut out = [ZERO; TERMS];
    for (k, out) in out.iter_mut().enumerate().take(n + 1) {
        let (value, is_zero) = row[0];
        if !is_zero {
            let scale = binomial(n, k) * factor;
            let more = (error + 4.0 * UNIT * size) * 2.0f64.powi(k as i32) * scale.abs();
            *out = Interval::around(value.rounded(), 1e-15 * value.high.abs()).times(scale)
                + Interval::around(0.0, more);
        }
        row = row.windows(2).map(|pair| (pair[1].0 - pair[0].0, pair[0].1 && pair[1].1)).collect();
    }
    Series(out)
}

/// A component and its derivatives by s, t, ss, st and tt along a way.
fn jet(net: &ExactNet, c: usize, way: Way) -> [Series; 6] {
    let Way { s0, sign, powers: [a, b] } = way;
    // Derivatives by s, as series in t.
    let last = if a == 0 { 2 } else { net.degree.s.max(2) };
    let by_s = by_s(net, c, last, s0);
    let along = |by_s: &[Series], order: usize| {
        let mut sum = Series([ZERO; TERMS]);
        let (mut factor, mut power) = (1.0, 0);
        for (k, term) in by_s[order..].iter().enumerate() {
            if k > 0 {
                // Taylor's series about s0: exact factors but for the division by k!.
                factor *= sign / k as f64;
                power += a;
            }
            if power >= TERMS || (k > 0 && a == 0) {
                break;
            }
            let moved = Series(std::array::from_fn(|i| match i.checked_sub(power) {
                Some(i) if i % b == 0 => term.0[i / b],
                _ => ZERO,
            }));
            let rounded = Interval::around(factor, 4.0 * k as f64 * HALF_ULP * factor.abs());
            let scaled = |x: Interval| if x == ZERO { ZERO } else { x * rounded };
            sum = sum.plus(1.0, &Series(moved.0.map(scaled)));
        }
        sum
    };
    let by_t = |f: &[Series]| f.iter().map(Series::derivative).collect::<Vec<_>>();
    let (t, tt) = (by_t(&by_s), by_t(&by_t(&by_s)));
    [along(&by_s, 0), along(&by_s, 1), along(&t, 0), along(&by_s, 2), along(&t, 1), along(&tt, 0)]
}

/// Whether a quantity falls below and grows beyond every bound along a way into the side t = 0 of a net about its point there;
/// none when the patch is regular at its end. `sign` is -1 when the net is mirrored.
fn unbounded(net: &ExactNet, way: Way, quantity: Quantity, sign: f64) -> Option<[bool; 2]> {
    let jets = [0, 1, 2].map(|c| jet(net, c, way));
    let of = |k: usize| [0, 1, 2].map(|c: usize| jets[c][k].clone());
    let [x, xs, xt, xss, xst, xtt] = [0, 1, 2, 3, 4, 5].map(of);
    let mut one = Series([ZERO; TERMS]);
    one.0[0] = Interval::point(1.0);
    let zero = || Series([ZERO; TERMS]);
    let weight = if net.rational {
        jet(net, 3, way)
    } else {
        [one.clone(), zero(), zero(), zero(), zero(), zero()]
    };
    let [w, ws, wt, wss, wst, wtt] = weight;
    // As of `cell`, the polynomials of the fundamental forms.
    let turned = cross(&xs, &xt);
    let part = mixed(&wt, &cross(&x, &xs), -1.0, &ws, &cross(&x, &xt));
    let normal = mixed(&w, &turned, 1.0, &one, &part);
    let triple = dot(&x, &turned);
    let second = |xx: &Vector, ww: &Series| dot(&normal, xx).plus(-1.0, &triple.times(ww));
    let (l, m, q) = (second(&xss, &wss), second(&xst, &wst), second(&xtt, &wtt));
    let (s, t) = (mixed(&w, &xs, -1.0, &ws, &x), mixed(&w, &xt, -1.0, &wt, &x));
    let (e, f, g) = (dot(&s, &s), dot(&s, &t), dot(&t, &t));
    let Some((area, _)) = dot(&normal, &normal).lead() else { return Some([false; 2]) };
    if area == 0 {
        return None;
    }
    let mut found = [false; 2];
    // Twice the order of the quotient decides.
    let mut note = |numerator: &Series, below: i32| {
        if let Some((order, side)) = numerator.lead()
            && 2 * order < below
        {
            found[usize::from(side * sign > 0.0)] = true;
        }
    };
    let mean = e.times(&q).plus(-2.0, &f.times(&m)).plus(1.0, &g.times(&l));
    let product = l.times(&q).plus(-1.0, &m.times(&m)).lead().filter(|(k, _)| *k < 2 * area);
    match quantity {
        Quantity::Mean => note(&mean, 3 * area),
        Quantity::Gaussian => {
            // The product does not change with the side of the normal.
            if let Some((_, side)) = product {
                found[usize::from(side > 0.0)] = true;
            }
        }
        _ => {
            // A normal curvature is between the principal ones, and so is the mean.
            note(&mean, 3 * area);
            if let Some((e, _)) = e.lead() {
                note(&l, area + 2 * e);
            }
            if let Some((g, _)) = g.lead() {
                note(&q, area + 2 * g);
            }
        }
    }
    Some(match quantity {
        Quantity::Greater => [false, found[1]],
        Quantity::Less => [found[0], false],
        Quantity::Sharpest => [false, found[0] || found[1] || product.is_some()],
        _ => found,
    })
}

/// The same along several ways; those after one that shows a regular end are not tried.
pub(super) fn unbounded_along(
    net: &ExactNet,
    ways: &[Way],
    quantity: Quantity,
    sign: f64,
) -> [bool; 2] {
    let mut all = [false; 2];
    for way in ways {
        let Some(found) = unbounded(net, *way, quantity, sign) else { break };
        all = [all[0] || found[0], all[1] || found[1]];
    }
    all
}
