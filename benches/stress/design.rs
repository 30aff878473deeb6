//! The data of a shape under test: what its constructor is given, as the verdict sees it too.
//!
//! A curve is a surface of degree 0 in v with one column of poles, so that search and verdict are written once.

use std::fmt::Write;

use footpoint::curve::Curve;
use footpoint::index::{IndexedCurve, IndexedSurface};
use footpoint::surface::Surface;

use super::shapes::asked::Shape;
use super::shapes::{Vector, norm, sub};

/// Knots, poles and weights, and places worth asking at.
#[derive(Clone, Debug, Default)]
pub struct Design {
    pub degrees: [usize; 2],
    pub knots: [Vec<f64>; 2],
    pub counts: [usize; 2],
    /// v runs fastest.
    pub poles: Vec<Vector>,
    pub weights: Option<Vec<f64>>,
    /// Centres and points of axes.
    pub special: Vec<Vector>,
}

impl Design {
    /// A curve; the second knot vector is that of a constant.
    pub fn curve(degree: usize, knots: Vec<f64>, poles: Vec<Vector>) -> Self {
        let counts = [poles.len(), 1];
        Self {
            degrees: [degree, 0],
            knots: [knots, vec![0.0, 1.0]],
            counts,
            poles,
            ..Self::default()
        }
    }

    pub fn surface(degrees: [usize; 2], knots: [Vec<f64>; 2], poles: Vec<Vector>) -> Self {
        let counts = [0, 1].map(|k| knots[k].len() - degrees[k] - 1);
        Self { degrees, knots, counts, poles, ..Self::default() }
    }

    pub fn of_curve(curve: &Curve) -> Self {
        let design =
            Self::curve(curve.degree(), curve.knots().values().to_vec(), curve.poles().to_vec());
        Self { weights: curve.weights().map(<[f64]>::to_vec), ..design }
    }

    pub fn of_surface(surface: &Surface) -> Self {
        let knots = [surface.knots_u(), surface.knots_v()];
        let values = knots.map(|k| k.values().to_vec());
        let design = Self::surface(knots.map(|k| k.degree()), values, surface.poles().to_vec());
        Self { weights: surface.weights().map(<[f64]>::to_vec), ..design }
    }

    pub fn is_curve(&self) -> bool {
        self.degrees[1] == 0
    }

    /// The shape of the library; `None` where it refuses the data.
    pub fn shape(&self) -> Option<Shape> {
        let ([ku, kv], weights) = (&self.knots, self.weights.as_deref());
        let ([p, q], [m, n]) = (self.degrees, self.counts);
        Some(if self.is_curve() {
            Shape::Curve(IndexedCurve::new(Curve::new(ku, p, &self.poles, weights).ok()?))
        } else {
            let surface = Surface::new(ku, kv, p, q, &self.poles, m, n, weights).ok()?;
            Shape::Surface(IndexedSurface::new(surface))
        })
    }

    /// u0, u1, v0, v1; curves: v is 0.
    pub fn domain(&self) -> [f64; 4] {
        let end = |k: usize, i: usize| self.knots[k][i];
        let [p, q] = self.degrees;
        let u = [end(0, p), end(0, self.counts[0])];
        if self.is_curve() {
            [u[0], u[1], 0.0, 0.0]
        } else {
            [u[0], u[1], end(1, q), end(1, self.counts[1])]
        }
    }

    pub fn weight(&self, k: usize) -> f64 {
        self.weights.as_ref().map_or(1.0, |weights| weights[k])
    }

    /// Diagonal of the box of the poles, and the largest coordinate.
    pub fn extent(&self) -> (f64, f64) {
        let (low, high) = self.bounding_box();
        (norm(sub(high, low)), low.iter().chain(&high).fold(0.0, |m: f64, x| m.max(x.abs())))
    }

    pub fn bounding_box(&self) -> (Vector, Vector) {
        let mut corners = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        for (k, x) in self.poles.iter().flat_map(|pole| pole.iter().enumerate()) {
            corners.0[k] = corners.0[k].min(*x);
            corners.1[k] = corners.1[k].max(*x);
        }
        corners
    }

    /// Sizes and places other than the maker's: `x -> size x + centre`.
    pub fn moved(mut self, size: f64, center: Vector) -> Self {
        for point in self.poles.iter_mut().chain(&mut self.special) {
            *point = [0, 1, 2].map(|k| size * point[k] + center[k]);
        }
        self
    }

    /// The data in full digits, to be pasted into a test.
    pub fn text(&self) -> String {
        let mut text = format!("degrees {:?}, counts {:?}\n", self.degrees, self.counts);
        let _ = writeln!(text, "knots_u {:?}\nknots_v {:?}", self.knots[0], self.knots[1]);
        let _ = writeln!(text, "poles {:?}\nweights {:?}", self.poles, self.weights);
        text
    }
}
