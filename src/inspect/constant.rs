//! Patches whose curvatures hardly change: spheres, cylinders, cones, tori.
//!
//! On those, intervals say little: every factor of a curvature changes, and only together they do not. The derivative of
//!
//! ```text
//!   f = p g^a h^b ...      is   f' = (p' g h + a p g' h + b p g h' ...) g^(a-1) h^(b-1) ...
//! ```
//!
//! and its first factor is one polynomial, all of whose coefficients vanish, but for rounding, when f is constant. One box a
//! patch then is enough.
//!
//! Limit: products up to 94 coefficients a direction; patches of higher degree are halved as usual.

use super::cell::{Forms, Shape};
use super::interval::Interval;
use super::polynomial::Polynomial;
use super::slope::Slope;
use crate::bezier::MAX_TRIPLE;

const WHOLE: [f64; 2] = [0.0, 1.0];

/// Most coefficients of a product: beyond, halving is cheaper.
const MOST: usize = 2_500;

/// All powers x^(halves / 2) of an interval that is not negative.
fn power(x: Interval, halves: i32) -> Interval {
    let base = if halves % 2 == 0 { x } else { x.sqrt() };
    let steps = if halves % 2 == 0 { halves.abs() / 2 } else { halves.abs() };
    let one = Interval::point(1.0);
    let raised = (0..steps).fold(one, |product, _| product * base);
    if halves < 0 { one / raised } else { raised }
}

/// `p` times powers of other polynomials over the whole patch; none when the products would be too long.
fn product(
    p: &Polynomial,
    factors: &[(&Polynomial, i32)],
    work: &mut Vec<f64>,
) -> Option<Slope<2>> {
    let total =
        |k: fn(&Polynomial) -> usize| k(p) + factors.iter().map(|(g, _)| k(g)).sum::<usize>() + 1;
    let (s, t) = (total(|f| f.degree.s), total(|f| f.degree.t));
    if s.max(t) > MAX_TRIPLE || s * t > MOST {
        return None;
    }
    let mut at = |f: &Polynomial| f.on(WHOLE, WHOLE, work);
    let own = at(p);
    let known: Vec<(Slope<2>, i32)> = factors.iter().map(|(g, halves)| (at(g), *halves)).collect();
    let raised = |of: fn(&Slope<2>) -> Interval, less: i32| {
        known.iter().fold(Interval::point(1.0), |x, (g, halves)| x * power(of(g), halves - less))
    };
    let rest = raised(|g| g.range, 2);
    let gradient = [0, 1].map(|k| match numerator(p, factors, k) {
        Some(numerator) => at(&numerator).range * rest,
        None => Interval::point(0.0),
    });
    let middle = own.middle * raised(|g| g.middle, 0);
    Some(Slope::new(middle, own.range * raised(|g| g.range, 0), gradient))
}

/// The first factor of the derivative in direction k; none when nothing depends on that parameter.
fn numerator(p: &Polynomial, factors: &[(&Polynomial, i32)], k: usize) -> Option<Polynomial> {
    let depends = |f: &Polynomial| if k == 0 { f.degree.s > 0 } else { f.degree.t > 0 };
    let others = |skipped: usize, first: Polynomial| {
        let rest = factors.iter().enumerate().filter(|(i, _)| *i != skipped);
        rest.fold(first, |product, (_, (g, _))| product.times(g))
    };
    let mut sum: Option<Polynomial> = None;
    if depends(p) {
        sum = Some(others(factors.len(), p.derivative(k)));
    }
    for (i, (g, halves)) in factors.iter().enumerate() {
        if depends(g) {
            let term = others(i, p.times(&g.derivative(k)));
            let factor = 0.5 * f64::from(*halves);
            sum = Some(match sum {
                Some(sum) => sum.plus(factor, &term),
                None => {
                    let zero = Polynomial::new(&vec![0.0; term.degree.count()], term.degree, 0.0);
                    zero.plus(factor, &term)
                }
            });
        }
    }
    sum
}

impl Forms {
    /// The curvatures over the whole patch from derivatives that are one polynomial each.
    pub fn as_constant(&self, work: &mut Vec<f64>) -> Option<Shape> {
        let [e, f, _] = &self.metric;
        let [l, m, q] = &self.second;
        let longest = |k: fn(&Polynomial) -> usize| {
            let weight = self.weight.as_ref().map_or(0, k);
            3 * k(e).max(k(f)) + k(q).max(k(m)).max(k(l)) + k(&self.area) + weight + 1
        };
        let (s, t) = (longest(|f| f.degree.s), longest(|f| f.degree.t));
        if s.max(t) > MAX_TRIPLE || s * t > MOST {
            return None;
        }
        let sheared = e.times(m).plus(-1.0, &f.times(l));
        let across = e.times(&e.times(q)).plus(-2.0, &e.times(&f.times(m)));
        let across = across.plus(1.0, &f.times(&f.times(l)));
        let with = |halves: [i32; 3]| {
            let mut factors = vec![(&self.area, halves[0]), (e, halves[1])];
            factors.extend(self.weight.as_ref().map(|w| (w, halves[2])));
            factors
        };
        Some(Shape {
            a: product(l, &with([-1, -2, 6]), work)?,
            b: product(&sheared, &with([-2, -2, 4]), work)?,
            d: product(&across, &with([-3, -2, 2]), work)?,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bezier::Bidegree;
    use crate::inspect::cell::Piece;

    #[test]
    fn a_patch_of_a_torus_has_a_constant_curvature() {
        // A quarter of the tube (radius 1.25) over a quarter of the ring (radius 3).
        let half = 0.5f64.sqrt();
        let turn = [([1.0, 0.0], 1.0), ([1.0, 1.0], half), ([0.0, 1.0], 1.0)];
        let mut poles = vec![0.0; 36];
        for (i, (u, wu)) in turn.iter().enumerate() {
            for (j, (v, wv)) in turn.iter().enumerate() {
                let (ring, height, w) = (3.0 + 1.25 * v[0], 1.25 * v[1], wu * wv);
                let pole = [ring * u[0] * w, ring * u[1] * w, height * w, w];
                (0..4).for_each(|c| poles[9 * c + 3 * i + j] = pole[c]);
            }
        }
        let degree = Bidegree { s: 2, t: 2 };
        let piece = Piece { poles: &poles, degree, rational: true, error: 1e-15, steps: 1e-15 };
        let mut work = Vec::new();
        let forms = Forms::new(&piece);
        let shape = forms.as_constant(&mut work).expect("short products");
        let d = shape.d.range;
        assert!(d.low <= 0.8 && 0.8 <= d.high || d.low <= -0.8 && -0.8 <= d.high, "{d:?}");
        assert!(d.high - d.low < 1e-6, "{:?} {:?} {:?}", shape.a, shape.b, shape.d);
        assert!(shape.b.range.magnitude() < 1e-6, "{:?}", shape.b);
    }
}
