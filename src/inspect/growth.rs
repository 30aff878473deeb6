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
//! Limit: approaches along straight lines of the domain from sides of patches; orders below 16.

use super::doubled::{Doubled, UNIT};
use super::interval::Interval;
use super::net::ExactNet;
use super::request::Quantity;
use crate::bezier::binomial;

/// Terms that are kept.
const TERMS: usize = 16;

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

/// A component's coefficients along t at s0, of the derivative by s of order `order`, as a series.
fn series(net: &ExactNet, c: usize, order: usize, s0: f64) -> Series {
    let (p, width, count) = (net.degree.s, net.degree.t + 1, net.degree.count());
    if order > p {
        return Series([ZERO; TERMS]);
    }
    let mut rows: Vec<Digit> =
        (0..count).map(|k| (net.poles[c * count + k], net.zeros[c * count + k])).collect();
    let share = Doubled::new(s0);
    let rest = Doubled::one() - share;
    let (mut size, mut factor) = (0.0f64, 1.0);
    for level in 0..p {
        let last = p - level;
        for k in 0..last * width {
            let ((a, is_a), (b, is_b)) = (rows[k], rows[k + width]);
            size = size.max(a.high.abs()).max(b.high.abs());
            rows[k] = if level < order {
                (Doubled::new(last as f64) * (b - a), is_a && is_b)
            } else {
                let is_zero = (is_a || rest.is_zero()) && (is_b || share.is_zero());
                (rest * a + share * b, is_zero)
            };
        }
        if level < order {
            factor *= 2.0 * last as f64;
        }
    }
    // Differences along t: coefficient k of the power form is C(n, k) times the difference of order k.
    let error = factor * (net.error(c) + (8 * p + 8) as f64 * UNIT * size);
    let n = width - 1;
    let mut row: Vec<Digit> = rows[..width].to_vec();
    let mut out = [ZERO; TERMS];
    for (k, out) in out.iter_mut().enumerate().take(width) {
        let (value, is_zero) = row[0];
        if !is_zero {
            let scale = binomial(n, k);
            let more = (error + 4.0 * UNIT * size * factor) * 2.0f64.powi(k as i32) * scale;
            *out = Interval::around(value.rounded(), 1e-15 * value.high.abs()).times(scale)
                + Interval::around(0.0, more);
        }
        row = row.windows(2).map(|pair| (pair[1].0 - pair[0].0, pair[0].1 && pair[1].1)).collect();
    }
    Series(out)
}

/// Whether a quantity falls below and grows beyond every bound where s = s0 and t goes to 0 on a net about its point there; `sign`
/// is -1 when the net is mirrored.
pub(super) fn unbounded(net: &ExactNet, s0: f64, quantity: Quantity, sign: f64) -> [bool; 2] {
    let of = |order: usize| [0, 1, 2].map(|c| series(net, c, order, s0));
    let by_t = |x: &Vector| [0, 1, 2].map(|c| x[c].derivative());
    let (x, xs, xss) = (of(0), of(1), of(2));
    let (xt, xst) = (by_t(&x), by_t(&xs));
    let xtt = by_t(&xt);
    let mut one = Series([ZERO; TERMS]);
    one.0[0] = Interval::point(1.0);
    let weight = |order: usize| match (net.rational, order) {
        (true, _) => series(net, 3, order, s0),
        (false, 0) => one.clone(),
        _ => Series([ZERO; TERMS]),
    };
    let (w, ws, wss) = (weight(0), weight(1), weight(2));
    let (wt, wst) = (w.derivative(), ws.derivative());
    let wtt = wt.derivative();
    // As of `cell`, the polynomials of the fundamental forms.
    let turned = cross(&xs, &xt);
    let part = mixed(&wt, &cross(&x, &xs), -1.0, &ws, &cross(&x, &xt));
    let normal = mixed(&w, &turned, 1.0, &one, &part);
    let triple = dot(&x, &turned);
    let second = |xx: &Vector, ww: &Series| dot(&normal, xx).plus(-1.0, &triple.times(ww));
    let (l, m, q) = (second(&xss, &wss), second(&xst, &wst), second(&xtt, &wtt));
    let (s, t) = (mixed(&w, &xs, -1.0, &ws, &x), mixed(&w, &xt, -1.0, &wt, &x));
    let (e, f, g) = (dot(&s, &s), dot(&s, &t), dot(&t, &t));
    let Some((area, _)) = dot(&normal, &normal).lead() else { return [false; 2] };
    let mut found = [false; 2];
    // Twice the order of the quotient decides.
    let mut note = |numerator: &Series, below: i32| {
        if let Some((order, side)) = numerator.lead()
            && 2 * order < below
        {
            found[usize::from(side * sign > 0.0)] = true;
        }
    };
    match quantity {
        Quantity::Mean => {
            let n = e.times(&q).plus(-2.0, &f.times(&m)).plus(1.0, &g.times(&l));
            note(&n, 3 * area);
        }
        Quantity::Gaussian => {
            let p = l.times(&q).plus(-1.0, &m.times(&m));
            // The product does not change with the side of the normal.
            if let Some((order, side)) = p.lead()
                && order < 2 * area
            {
                found[usize::from(side > 0.0)] = true;
            }
        }
        _ => {
            if let Some((e, _)) = e.lead() {
                note(&l, area + 2 * e);
            }
            if let Some((g, _)) = g.lead() {
                note(&q, area + 2 * g);
            }
        }
    }
    match quantity {
        // A normal curvature is between the principal ones.
        Quantity::Greater => [false, found[1]],
        Quantity::Less => [found[0], false],
        Quantity::Sharpest => [false, found[0] || found[1]],
        _ => found,
    }
}
