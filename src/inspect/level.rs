//! Lines on which a curvature has one value, as the zeros of one polynomial.
//!
//! With P = l q - m^2 and N = E q - 2 F m + G l (see [`super::cell`]) the products of a rational patch are
//!
//! ```text
//!   K = P W^4 / D^2     H = N W / (2 D^(3/2))
//!   D^4 (c^2 - k1^2) (c^2 - k2^2)  =  c^4 D^4 - c^2 D W^2 (N^2 - 2 P D W^2) + P^2 W^8
//! ```
//!
//! A polynomial without zeros on a box has one sign there, and so has the quantity minus c: what intervals lose because the
//! factors of a curvature vary together is not lost here, so that spheres and tori are as good as anything.
//!
//! Limit: products up to 94 coefficients a direction; patches of higher degree are halved as usual.

use super::cell::Forms;
use super::polynomial::Polynomial;
use super::request::Quantity;
use crate::bezier::{Bidegree, MAX_TRIPLE, halve_s, halve_t};
use crate::bounds::{HALF_ULP, extent};

/// Most coefficients of a product: beyond, halving is cheaper.
const MOST: usize = 4_300;

/// Parts of a box that are looked at.
const PARTS: usize = 16;

/// The degree of a product of powers.
fn degree(factors: &[(&Polynomial, usize)]) -> Bidegree {
    let sum = |k: fn(&Bidegree) -> usize| factors.iter().map(|(f, n)| n * k(&f.degree)).sum();
    Bidegree { s: sum(|d| d.s), t: sum(|d| d.t) }
}

impl Forms {
    /// Terms of the polynomial: which powers of c they belong to depends on the quantity.
    fn terms(&self, quantity: Quantity) -> Option<Vec<Polynomial>> {
        let one = Polynomial::new(&[1.0], Bidegree { s: 0, t: 0 }, 0.0);
        let (d, w) = (&self.area, self.weight.as_ref().unwrap_or(&one));
        let [e, f, g] = &self.metric;
        let [l, m, q] = &self.second;
        let short = |factors: &[(&Polynomial, usize)]| {
            let Bidegree { s, t } = degree(factors);
            s.max(t) < MAX_TRIPLE && (s + 1) * (t + 1) <= MOST
        };
        let products = [[e, q], [f, m], [g, l], [l, q], [m, m]];
        if !products.iter().all(|[a, b]| short(&[(a, 1), (b, 1)])) || !short(&[(w, 4)]) {
            return None;
        }
        let (n, p, w2) = (self.mean_numerator(), self.gaussian_numerator(), w.times(w).light());
        let w4 = w2.times(&w2).light();
        let longest: &[&[(&Polynomial, usize)]] = match quantity {
            Quantity::Gaussian => &[&[(d, 2)], &[(&p, 1), (&w4, 1)]],
            Quantity::Mean => &[&[(d, 3)], &[(&n, 2), (&w2, 1)]],
            _ => &[
                &[(d, 4)],
                &[(d, 1), (&n, 2), (&w2, 1)],
                &[(d, 2), (&p, 1), (&w2, 2)],
                &[(&p, 2), (&w4, 2)],
            ],
        };
        // Sums have the greatest degree of their terms in each direction.
        let most = |k: fn(Bidegree) -> usize| longest.iter().map(|x| k(degree(x))).max();
        let (s, t) = (most(|d| d.s)?, most(|d| d.t)?);
        if s.max(t) >= MAX_TRIPLE || (s + 1) * (t + 1) > MOST {
            return None;
        }
        Some(match quantity {
            Quantity::Gaussian => vec![d.times(d), p.times(&w4)],
            Quantity::Mean => vec![d.times(&d.times(d)), n.times(&n).times(&w2)],
            _ => {
                let sum = n.times(&n).plus(-2.0, &p.times(d).times(&w2));
                let (d2, pw4) = (d.times(d), p.times(&w4));
                vec![d2.times(&d2), sum.times(&d.times(&w2)), pw4.times(&pw4)]
            }
        })
    }

    /// E q - 2 F m + G l.
    fn mean_numerator(&self) -> Polynomial {
        let ([e, f, g], [l, m, q]) = (&self.metric, &self.second);
        e.times(q).plus(-2.0, &f.times(m)).plus(1.0, &g.times(l)).light()
    }

    /// l q - m^2.
    fn gaussian_numerator(&self) -> Polynomial {
        let [l, m, q] = &self.second;
        l.times(q).plus(-1.0, &m.times(m)).light()
    }

    /// Whether the quantity is proven not to be `c` anywhere on the patch; none when the products are too long.
    pub fn avoids(&self, quantity: Quantity, c: f64, work: &mut Vec<f64>) -> Option<bool> {
        // At a fold or a cusp inside curvatures jump from one side to the other.
        if self.area.on([0.0, 1.0], [0.0, 1.0], work).range.low <= 0.0 {
            return Some(false);
        }
        let terms = self.terms(quantity)?;
        let factors = match quantity {
            Quantity::Gaussian => vec![c, -1.0],
            Quantity::Mean => vec![4.0 * c * c, -1.0],
            _ => vec![c * c * c * c, -c * c, 1.0],
        };
        let zero = Polynomial::new(&[0.0], Bidegree { s: 0, t: 0 }, 0.0);
        let pairs = terms.iter().zip(factors);
        let sum = pairs.fold(zero, |sum, (term, factor)| sum.plus(factor, term));
        Some(has_one_sign(sum))
    }
}

/// Whether a polynomial is proven to have no zero on [0, 1] x [0, 1].
fn has_one_sign(f: Polynomial) -> bool {
    let Polynomial { coefficients, degree, mut error } = f;
    let (low, high) = extent(&coefficients);
    let size = low.abs().max(high.abs());
    let sign = if coefficients[0] > 0.0 { 1.0 } else { -1.0 };
    let corners = [0, degree.t, degree.s * (degree.t + 1), degree.count() - 1];
    // Each halving is a mean of coefficients at every step.
    error += 8.0 * (degree.s + degree.t + 8) as f64 * HALF_ULP * size;
    let mut level = vec![coefficients];
    let mut looked = 0;
    while let Some(part) = level.pop() {
        looked += 1;
        if corners.iter().any(|&k| sign * part[k] <= error) {
            return false;
        }
        if part.iter().all(|x| sign * x > error) {
            continue;
        }
        if looked + level.len() >= PARTS {
            return false;
        }
        let (mut low, mut high) = (part, vec![0.0; degree.count()]);
        if varies_more_along_s(&low, degree) {
            halve_s(&mut low, &mut high, degree);
        } else {
            halve_t(&mut low, &mut high, degree);
        }
        level.push(high);
        level.push(low);
    }
    true
}

fn varies_more_along_s(f: &[f64], degree: Bidegree) -> bool {
    let width = degree.t + 1;
    let bend = |a: f64, b: f64, c: f64| (a - 2.0 * b + c).abs();
    let along_s = f
        .iter()
        .zip(f.iter().skip(width))
        .zip(f.iter().skip(2 * width))
        .map(|((a, b), c)| bend(*a, *b, *c))
        .fold(0.0, f64::max);
    let along_t = f
        .chunks_exact(width)
        .flat_map(|row| row.windows(3))
        .map(|x| bend(x[0], x[1], x[2]))
        .fold(0.0, f64::max);
    let (m, n) = (degree.s as f64, degree.t as f64);
    along_s * m * m > along_t * n * n || degree.t == 0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::inspect::cell::Piece;

    #[test]
    fn a_patch_of_a_torus_takes_its_own_curvature_only() {
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
        let forms = Forms::new(&piece);
        let avoids = |quantity, c| forms.avoids(quantity, c, &mut Vec::new()).unwrap();
        // The other principal curvature runs from 1 / 4.25 to 0 there.
        for (c, wanted) in [(0.8008, true), (0.7992, true), (0.8, false), (0.3, true), (0.1, false)]
        {
            assert_eq!(avoids(Quantity::Sharpest, c), wanted, "{c}");
        }
        assert!(avoids(Quantity::Gaussian, 0.19) && !avoids(Quantity::Gaussian, 0.1));
        assert!(avoids(Quantity::Mean, 0.52) && !avoids(Quantity::Mean, 0.45));
    }
}
