//! Polynomials in Bernstein form with one bound for what rounding has done to them: what the proofs of offsets and sweeps compute with.
//!
//! Every polynomial is loosened by units of the sizes of its factors, counted generously; so bounds are a little wide, and simple.

use crate::bezier::{Bidegree, convolve, derivative, halve_s, halve_t, scale_down_2d, scale_up_2d};
use crate::bounds::{Vector, extent, norm, sub};

/// Units in the last place that one product, sum or change of knots may cost in all, relative to the sizes of the factors.
const UNITS: f64 = 256.0;

/// A polynomial in Bernstein form, and what its coefficients may be off.
#[derive(Clone)]
pub(super) struct Poly {
    pub degree: Bidegree,
    pub c: Vec<f64>,
    pub slack: f64,
}

impl Poly {
    pub fn size(&self) -> f64 {
        self.c.iter().fold(self.slack, |size, x| size.max(x.abs()))
    }

    /// Nothing is below it.
    pub fn least(&self) -> f64 {
        extent(&self.c).0 - self.slack
    }

    /// No absolute value is above it.
    pub fn most(&self) -> f64 {
        let (low, high) = extent(&self.c);
        low.abs().max(high.abs()) + self.slack
    }

    pub fn times(&self, other: &Self) -> Self {
        let degree = self.degree.times(other.degree);
        let (mut f, mut g) = (self.c.clone(), other.c.clone());
        scale_up_2d(&mut f, self.degree);
        scale_up_2d(&mut g, other.degree);
        let mut c = vec![0.0; degree.count()];
        convolve(&f, self.degree, &g, other.degree, 1.0, &mut c);
        scale_down_2d(&mut c, degree);
        let (a, b) = (self.size(), other.size());
        let slack = a * other.slack + b * self.slack + UNITS * f64::EPSILON * a * b;
        Self { degree, c, slack }
    }

    /// `self + factor * other`, of one degree.
    pub fn plus(mut self, factor: f64, other: &Self) -> Self {
        debug_assert_eq!(self.degree, other.degree);
        self.c.iter_mut().zip(&other.c).for_each(|(x, y)| *x += factor * y);
        let size = self.size() + factor.abs() * other.size();
        self.slack += factor.abs() * other.slack + 4.0 * f64::EPSILON * size;
        self
    }

    pub fn derived(&self, direction: usize) -> Self {
        let mut c = Vec::new();
        derivative(&self.c, self.degree, direction, &mut c);
        let order = [self.degree.s, self.degree.t][direction] as f64;
        let slack = 2.0 * order * (self.slack + 4.0 * f64::EPSILON * self.size());
        Self { degree: self.degree.lowered(direction), c, slack }
    }

    /// The same, written with a higher degree.
    pub fn raised(&self, degree: Bidegree) -> Self {
        let one = Bidegree { s: degree.s - self.degree.s, t: degree.t - self.degree.t };
        self.times(&Self { degree: one, c: vec![1.0; one.count()], slack: 0.0 })
    }

    pub fn halved(&self, direction: usize) -> [Self; 2] {
        let (mut low, mut high) = (self.c.clone(), self.c.clone());
        if direction == 0 {
            halve_s(&mut low, &mut high, self.degree);
        } else {
            halve_t(&mut low, &mut high, self.degree);
        }
        let slack = self.slack + 32.0 * f64::EPSILON * self.size();
        [low, high].map(|c| Self { degree: self.degree, c, slack })
    }
}

/// The coordinates of a vector.
pub(super) type Polys = [Poly; 3];

/// The scalar product.
pub(super) fn product(a: &Polys, b: &Polys) -> Poly {
    a[0].times(&b[0]).plus(1.0, &a[1].times(&b[1])).plus(1.0, &a[2].times(&b[2]))
}

/// Coordinates of poles relative to `center`, times weights; and the weights.
pub(super) fn homogeneous(
    poles: &[Vector],
    weights: Option<&[f64]>,
    center: Vector,
    degree: Bidegree,
) -> (Polys, Poly) {
    let weight = |k: usize| weights.map_or(1.0, |w| w[k]);
    let far = poles.iter().flatten().fold(0.0, |m: f64, x| m.max(x.abs()));
    let greatest = (0..poles.len()).map(weight).fold(0.0, f64::max);
    // Poles are stored to an ulp of their coordinates, and the change of knots costs some of the net's size.
    let size = poles.iter().fold(0.0, |size: f64, p| size.max(norm(sub(*p, center))));
    let slack = greatest * f64::EPSILON * (8.0 * far + UNITS * size);
    let coordinate = |x: usize| Poly {
        degree,
        c: (0..poles.len()).map(|k| (poles[k][x] - center[x]) * weight(k)).collect(),
        slack,
    };
    let w = match weights {
        Some(weights) => {
            Poly { degree, c: weights.to_vec(), slack: UNITS * f64::EPSILON * greatest }
        }
        None => Poly { degree: Bidegree { s: 0, t: 0 }, c: vec![1.0], slack: 0.0 },
    };
    ([coordinate(0), coordinate(1), coordinate(2)], w)
}
