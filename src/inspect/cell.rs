//! Curvatures of a Bezier piece on a box, as intervals that hold them.
//!
//! ```text
//!   net of the piece -> polynomials of the metric and of the second form, once a piece
//!                    -> cut to the box -> shape operator [[a, b], [b, d]] in an orthonormal frame
//! ```
//!
//! With E, F, G of the metric, D = |S_s x S_t|^2 and l, m, q the products of S_s x S_t with the second derivatives, the frame
//! of S_s and of what of S_t is normal to it gives
//!
//! ```text
//!   a = l / (sqrt(D) E)     b = (m - F l / E) / D     d = (E q - 2 F m + F^2 l / E) / D^(3/2)
//! ```
//!
//! Of a rational patch X / W all of these are polynomials over powers of W: E W^4, D W^6, l W^4 and so on, where
//! W^3 S_s x S_t = W X_s x X_t + W_t X x X_s - W_s X x X_t = n and l W^4 = n . X_ss - W_ss X . (X_s x X_t).
//!
//! Reference: do Carmo, *Differential Geometry of Curves and Surfaces*, section 3.3.
//! Limit: the degree of D, 4 p - 2 or 6 p - 2 (rational), must not exceed that of a triple product, 93.

use super::interval::Interval;
use super::polynomial::Polynomial;
use super::slope::Slope;
use crate::bezier::{Bidegree, MAX_TRIPLE};
use crate::bounds::HALF_ULP;
use crate::error::Error;

/// A Bezier piece: homogeneous poles component by component, of which coordinates are off by at most `error` times the
/// greatest weight, weights by `steps` times it. A segment has degree 0 in s.
pub(super) struct Piece<'a> {
    pub poles: &'a [f64],
    pub degree: Bidegree,
    pub rational: bool,
    pub error: f64,
    pub steps: f64,
}

/// Refuses degrees whose products are too long.
pub(super) fn check_degree(degree: Bidegree, rational: bool) -> Result<(), Error> {
    let p = degree.s.max(degree.t);
    let (most, kind) = if rational {
        ((MAX_TRIPLE + 1) / 6, "rational")
    } else {
        ((MAX_TRIPLE + 1) / 4, "polynomial")
    };
    if p <= most {
        return Ok(());
    }
    let text = format!("degree: {p} of a {kind} shape, curvature bounds are made up to {most}");
    Err(Error::Unsupported(text))
}

impl Piece<'_> {
    /// x, y, z and w; the weight of a polynomial piece is none.
    fn homogeneous(&self) -> ([Polynomial; 3], Option<Polynomial>) {
        let count = self.degree.count();
        let component = |c: usize| &self.poles[c * count..(c + 1) * count];
        let heaviest = |w: &[f64]| w.iter().fold(0.0f64, |m, x| m.max(*x));
        let weight = self.rational.then(|| component(3));
        let heavy = weight.map_or(1.0, heaviest);
        let of = |c: usize| Polynomial::new(component(c), self.degree, self.error * heavy);
        let weight = weight.map(|w| Polynomial::new(w, self.degree, self.steps * heavy));
        ([of(0), of(1), of(2)], weight)
    }
}

fn refs(a: &[Polynomial; 3]) -> [&Polynomial; 3] {
    [&a[0], &a[1], &a[2]]
}

fn each(a: &[Polynomial; 3], f: impl Fn(&Polynomial) -> Polynomial) -> [Polynomial; 3] {
    [f(&a[0]), f(&a[1]), f(&a[2])]
}

/// `a + factor b`.
fn sum(a: [Polynomial; 3], factor: f64, b: &[Polynomial; 3]) -> [Polynomial; 3] {
    let [x, y, z] = a;
    [x.plus(factor, &b[0]), y.plus(factor, &b[1]), z.plus(factor, &b[2])]
}

/// The fundamental forms of a patch as polynomials, each times a power of the weight.
pub(super) struct Forms {
    /// W^4 E, F, G.
    pub metric: [Polynomial; 3],
    /// W^6 D.
    pub area: Polynomial,
    /// W^4 l, m, q.
    pub second: [Polynomial; 3],
    pub weight: Option<Polynomial>,
    /// W^3 S_s x S_t.
    pub normal: [Polynomial; 3],
}

/// A patch and its derivatives.
struct Parts {
    position: [Polynomial; 3],
    first: [[Polynomial; 3]; 2],
    second: [[Polynomial; 3]; 3],
    /// Weight, its first and its second derivatives.
    weight: Option<(Polynomial, [Polynomial; 2], [Polynomial; 3])>,
}

impl Parts {
    fn new(piece: &Piece) -> Self {
        let (position, weight) = piece.homogeneous();
        let first = [0, 1].map(|k| each(&position, |f| f.derivative(k)));
        let [s, t] = &first;
        let second = [
            each(s, |f| f.derivative(0)),
            each(s, |f| f.derivative(1)),
            each(t, |f| f.derivative(1)),
        ];
        let weight = weight.map(|w| {
            let [s, t] = [0, 1].map(|k| w.derivative(k));
            let second = [s.derivative(0), s.derivative(1), t.derivative(1)];
            (w, [s, t], second)
        });
        Self { position, first, second, weight }
    }
}

impl Forms {
    pub fn new(piece: &Piece) -> Self {
        Self::from(Parts::new(piece))
    }

    fn from(Parts { position: x, first: [xs, xt], second: seconds, weight }: Parts) -> Self {
        let turned = Polynomial::cross(refs(&xs), refs(&xt));
        let Some((w, [ws, wt], weights)) = weight else {
            let second = seconds.map(|second| Polynomial::dot(refs(&turned), refs(&second)));
            return Self::of([xs, xt], turned, second, None);
        };
        let first = |xk: &[Polynomial; 3], wk: &Polynomial| {
            sum(each(xk, |f| f.times(&w)), -1.0, &each(&x, |f| f.times(wk)))
        };
        let triple = Polynomial::dot(refs(&x), refs(&turned));
        let by_s = each(&Polynomial::cross(refs(&x), refs(&xs)), |f| f.times(&wt));
        let by_t = each(&Polynomial::cross(refs(&x), refs(&xt)), |f| f.times(&ws));
        let normal = sum(sum(each(&turned, |f| f.times(&w)), 1.0, &by_s), -1.0, &by_t);
        let second = [0, 1, 2].map(|k| {
            let across = Polynomial::dot(refs(&normal), refs(&seconds[k]));
            across.plus(-1.0, &triple.times(&weights[k]))
        });
        Self::of([first(&xs, &ws), first(&xt, &wt)], normal, second, Some(w))
    }

    fn of(
        [s, t]: [[Polynomial; 3]; 2],
        normal: [Polynomial; 3],
        second: [Polynomial; 3],
        weight: Option<Polynomial>,
    ) -> Self {
        let [s_, t_] = [refs(&s), refs(&t)];
        let metric = [Polynomial::dot(s_, s_), Polynomial::dot(s_, t_), Polynomial::dot(t_, t_)];
        let area = Polynomial::dot(refs(&normal), refs(&normal));
        Self { metric, area, second, weight, normal }
    }

    /// The curvatures on a box; `work` is scratch memory.
    pub fn on(&self, s: [f64; 2], t: [f64; 2], work: &mut Vec<f64>) -> Shape {
        let mut at = |f: &Polynomial| f.on(s, t, work);
        let (e, f, area) = (at(&self.metric[0]), at(&self.metric[1]), at(&self.area));
        let (l, m, q) = (at(&self.second[0]), at(&self.second[1]), at(&self.second[2]));
        let j = area.sqrt();
        let ratio = f / e;
        let sheared = m - ratio * l;
        let mut a = l / (j * e);
        let mut b = sheared / area;
        let mut d = e * (q - ratio * (m + sheared)) / (area * j);
        if let Some(weight) = &self.weight {
            let w = at(weight);
            let squared = w.squared();
            a = a * squared * w;
            b = b * squared;
            d = d * w;
        }
        Shape { a, b, d }
    }

    /// The normal curvature across the isocurves of s (direction 0: the isocurve s = const) or of t (1) on a box.
    pub fn across(
        &self,
        direction: usize,
        s: [f64; 2],
        t: [f64; 2],
        work: &mut Vec<f64>,
    ) -> Interval {
        let mut at = |f: &Polynomial| f.on(s, t, work);
        let (e, f, g) = (at(&self.metric[0]), at(&self.metric[1]), at(&self.metric[2]));
        let (l, m, q) = (at(&self.second[0]), at(&self.second[1]), at(&self.second[2]));
        let area = at(&self.area);
        let (e, l, q) = if direction == 1 { (e, l, q) } else { (g, q, l) };
        let ratio = f / e;
        let across = e * (q - ratio * (m.times(2.0) - ratio * l)) / (area * area.sqrt());
        match &self.weight {
            Some(weight) => (across * at(weight)).range,
            None => across.range,
        }
    }

    /// The normal on a box, scaled by the cube of the weight.
    pub fn normal_on(&self, s: [f64; 2], t: [f64; 2], work: &mut Vec<f64>) -> [Interval; 3] {
        [0, 1, 2].map(|k| self.normal[k].on(s, t, work).range)
    }
}

/// Speed and bending of a segment as polynomials: squared curvature = bending W^6 / speed^3.
pub(super) struct Bending {
    /// W^4 |C'|^2.
    pub speed: Polynomial,
    /// W^6 |C' x C''|^2.
    pub bending: Polynomial,
    /// W^3 C' x C''.
    pub binormal: [Polynomial; 3],
    pub weight: Option<Polynomial>,
}

impl Bending {
    pub fn new(piece: &Piece) -> Self {
        let (x, weight) = piece.homogeneous();
        let x1 = each(&x, |f| f.derivative(1));
        let x2 = each(&x1, |f| f.derivative(1));
        let turned = Polynomial::cross(refs(&x1), refs(&x2));
        let (first, binormal) = match &weight {
            None => (x1, turned),
            Some(w) => {
                let w1 = w.derivative(1);
                let w2 = w1.derivative(1);
                let first = sum(each(&x1, |f| f.times(w)), -1.0, &each(&x, |f| f.times(&w1)));
                let by_second = each(&Polynomial::cross(refs(&x), refs(&x2)), |f| f.times(&w1));
                let by_first = each(&Polynomial::cross(refs(&x), refs(&x1)), |f| f.times(&w2));
                let turned = each(&turned, |f| f.times(w));
                (first, sum(sum(turned, -1.0, &by_second), 1.0, &by_first))
            }
        };
        let speed = Polynomial::dot(refs(&first), refs(&first));
        let bending = Polynomial::dot(refs(&binormal), refs(&binormal));
        Self { speed, bending, binormal, weight }
    }

    /// The squared curvature on an interval.
    pub fn on(&self, t: [f64; 2], work: &mut Vec<f64>) -> Slope<2> {
        let mut at = |f: &Polynomial| f.on([0.0, 1.0], t, work);
        let (speed, bending) = (at(&self.speed), at(&self.bending));
        let squared = bending / (speed * speed.squared());
        match &self.weight {
            None => squared,
            Some(weight) => {
                let w = at(weight).squared();
                squared * w * w.squared()
            }
        }
    }
}

/// The shape operator of a patch on a box, in an orthonormal frame: `[[a, b], [b, d]]`.
pub(super) struct Shape {
    pub a: Slope<2>,
    pub b: Slope<2>,
    pub d: Slope<2>,
}

/// A quantity on a box.
#[derive(Clone, Copy, Debug)]
pub(super) struct Known {
    /// In the middle.
    pub middle: Interval,
    /// Over the box.
    pub range: Interval,
    /// Derivatives in the box's own parameters over the box, where they are known.
    pub gradient: [Interval; 2],
}

impl Known {
    /// Nothing.
    pub const ENTIRE: Self =
        Self { middle: Interval::ENTIRE, range: Interval::ENTIRE, gradient: [Interval::ENTIRE; 2] };
}

impl From<Slope<2>> for Known {
    fn from(slope: Slope<2>) -> Self {
        Self { middle: slope.middle, range: slope.range, gradient: slope.gradient }
    }
}

impl Shape {
    /// Mean curvature.
    pub fn mean(&self) -> Slope<2> {
        (self.a + self.d).times(0.5)
    }

    /// Gaussian curvature.
    pub fn gaussian(&self) -> Slope<2> {
        self.a * self.d - self.b.squared()
    }

    /// The principal curvatures, the greater one and the less.
    pub fn principal(&self) -> [Known; 2] {
        let half = (self.a - self.d).times(0.5);
        let root = (half.squared() + self.b.squared()).sqrt();
        let mean = self.mean();
        let of = |f: fn(&Slope<2>) -> Interval| eigenvalues([&self.a, &self.b, &self.d].map(f));
        let (middle, range) = (of(|slope| slope.middle), of(|slope| slope.range));
        let sides = [mean + root, mean - root].map(Known::from);
        [0, 1].map(|k| Known {
            middle: sides[k].middle.and(middle[k]),
            range: sides[k].range.and(range[k]),
            gradient: self.slopes_or(sides[k].gradient),
        })
    }

    /// Where the root hides the slopes (equal curvatures), those of the entries bound them.
    fn slopes_or(&self, gradient: [Interval; 2]) -> [Interval; 2] {
        [0, 1].map(|k| {
            if gradient[k].magnitude().is_finite() {
                return gradient[k];
            }
            self.a.gradient[k].or(self.d.gradient[k]) + self.b.gradient[k].or(-self.b.gradient[k])
        })
    }

    /// Whether equal principal curvatures somewhere on the box cannot be excluded.
    pub fn may_be_umbilic(&self) -> bool {
        self.b.range.holds_zero() && (self.a - self.d).range.holds_zero()
    }
}

/// The eigenvalues of `[[a, b], [b, d]]`, the greater one and the less, from what is known of the entries: both grow with a and
/// d; the greater grows with |b|, the other falls.
///
/// Rounding: the sum, the difference and the root are off by no more than 8 half ulps of the entries; a square that underflows by
/// less than 1e-150.
pub(super) fn eigenvalues([a, b, d]: [Interval; 3]) -> [Interval; 2] {
    let pair = |a: f64, b: f64, d: f64| {
        let (mean, half) = (0.5 * a + 0.5 * d, 0.5 * a - 0.5 * d);
        let root = (half * half + b * b).sqrt();
        let error = 8.0 * HALF_ULP * (a.abs() + b.abs() + d.abs()) + 1e-150;
        (mean, root, error)
    };
    let (most, least) = (b.magnitude(), b.least_magnitude());
    let sides = [pair(a.low, least, d.low), pair(a.high, most, d.high)];
    let others = [pair(a.low, most, d.low), pair(a.high, least, d.high)];
    let greater = (sides[0].0 + sides[0].1 - sides[0].2, sides[1].0 + sides[1].1 + sides[1].2);
    let less = (others[0].0 - others[0].1 - others[0].2, others[1].0 - others[1].1 + others[1].2);
    [greater, less].map(|(low, high)| {
        let is_known = !(low.is_nan() || high.is_nan());
        if is_known { Interval { low, high } } else { Interval::ENTIRE }
    })
}
