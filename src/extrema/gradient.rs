//! The gradient of the squared distance of a piece as Bernstein polynomials.
//!
//! With `r = X - W p` and `T_s = W X_s - W_s X` (polynomial pieces: `X_s`), half the derivative of the squared distance is
//!
//! ```text
//!   f_s / 2 = r . T_s / W^3            (the query cancels in T: no digits are lost for far queries)
//! ```
//!
//! so the zeros of `G_s = r . T_s` and `G_t = r . T_t` are the stationary points. On a collapsed side t = 0 the row of
//! `G_s` vanishes for every shape; `G_s / t` is used in its place.

use crate::bezier::{
    Bidegree, convolve, cut_2d, derivative, divided_by_side, elevated, scale_down_2d, scale_up_2d,
};
use crate::bounds::{Vector, extent};
use crate::closest::subtract_query;
use crate::index::{position_steps, product_steps};

/// A piece, cut to a range and seen from a query.
pub struct View {
    degree: Bidegree,
    rational: bool,
    /// X (three components) and W.
    poles: Vec<f64>,
    /// r (three components) and W.
    seen: Vec<f64>,
    /// Greatest |r| / W of the poles.
    reach: f64,
    /// Greatest |X| / W of the poles.
    radius: f64,
    /// Least and greatest weight.
    weight: (f64, f64),
    position: f64,
    spread: f64,
}

/// Coefficients of half a derivative of the squared distance, times a power of the weight.
pub struct Slope {
    /// The coefficients.
    pub coefficients: Vec<f64>,
    /// Their bidegree.
    pub degree: Bidegree,
    /// How far each may be off.
    pub error: f64,
}

impl View {
    /// The piece with these poles (component by component) on `range`; `radius` bounds |X| / W,
    /// `position` is how far `r / W` may be off, `spread` how far poles were moved.
    pub fn new(
        poles: &[f64],
        degree: Bidegree,
        rational: bool,
        range: [f64; 4],
        query: Vector,
        [radius, position, spread]: [f64; 3],
    ) -> Self {
        let count = degree.count();
        let mut all = poles.to_vec();
        all.resize(4 * count, 1.0);
        let components = if rational { 4 } else { 3 };
        for component in all[..components * count].chunks_exact_mut(count) {
            cut_2d(component, degree, [range[0], range[1]], [range[2], range[3]]);
        }
        let mut seen = all.clone();
        let reach = subtract_query(&mut seen, count, query);
        let weight = extent(&all[3 * count..]);
        Self { degree, rational, poles: all, seen, reach, radius, weight, position, spread }
    }

    /// Least weight.
    pub fn least_weight(&self) -> f64 {
        self.weight.0
    }

    /// Half the derivative in direction 0 (s) or 1 (t).
    pub fn slope(&self, direction: usize) -> Slope {
        let (degree, lowered) = (self.degree, self.degree.lowered(direction));
        let count = degree.count();
        let mut tangents = Vec::with_capacity(4 * lowered.count());
        for component in self.poles.chunks_exact(count) {
            derivative(component, degree, direction, &mut tangents);
        }
        let steepest = |c: std::ops::Range<usize>| {
            let (low, high) = extent(&tangents[c.start * lowered.count()..c.end * lowered.count()]);
            low.abs().max(high.abs())
        };
        let sizes = [steepest(0..3), steepest(3..4)];
        let t_degree = if self.rational { degree.times(lowered) } else { lowered };
        let mut seen = self.seen[..3 * count].to_vec();
        let total = degree.times(t_degree);
        let mut sum = vec![0.0; total.count()];
        let w = self.scaled(&self.poles[3 * count..], degree);
        let w_slope = self.scaled(&tangents[3 * lowered.count()..], lowered);
        for c in 0..3 {
            let mut tangent = tangents[c * lowered.count()..(c + 1) * lowered.count()].to_vec();
            scale_up_2d(&mut tangent, lowered);
            if self.rational {
                let x = self.scaled(&self.poles[c * count..(c + 1) * count], degree);
                let mut product = vec![0.0; t_degree.count()];
                convolve(&w, degree, &tangent, lowered, 1.0, &mut product);
                convolve(&x, degree, &w_slope, lowered, -1.0, &mut product);
                tangent = product;
            }
            let r = &mut seen[c * count..(c + 1) * count];
            scale_up_2d(r, degree);
            convolve(r, degree, &tangent, t_degree, 1.0, &mut sum);
        }
        scale_down_2d(&mut sum, total);
        let error = self.slope_error(if direction == 0 { degree.s } else { degree.t }, sizes);
        Slope { coefficients: sum, degree: total, error }
    }

    fn scaled(&self, f: &[f64], degree: Bidegree) -> Vec<f64> {
        let mut f = f.to_vec();
        scale_up_2d(&mut f, degree);
        f
    }

    /// How far a coefficient of `r . T` may be off, where T has `sizes` = greatest |X_s| and |W_s|, component by
    /// component.
    ///
    /// Bernstein coefficients of a product are convex combinations of products of coefficients, so errors multiply as for
    /// numbers. `X` and `W` are off by `steps` relative to the radius, their differences by `2 p` times that.
    fn slope_error(&self, p: usize, [x_slope, w_slope]: [f64; 2]) -> f64 {
        let steps = position_steps(self.degree.s + self.degree.t);
        let products = product_steps(4 * self.degree.count()) + steps;
        let (w, p) = (self.weight.1, p as f64);
        let (t, t_error) = if self.rational {
            let t = w * x_slope + w_slope * self.radius * w;
            let given = w * w * self.radius * 4.0 * p + w * x_slope + w_slope * self.radius * w;
            (t, steps * given + products * t)
        } else {
            (x_slope, steps * 2.0 * p * self.radius)
        };
        let t_error = t_error + 4.0 * p * w * w * self.spread;
        let (r, r_error) = (self.reach * w, self.position * w);
        // Three components, and a margin for the second-order terms.
        3.1 * (r * t_error + r_error * t + products * r * t)
    }
}

impl Slope {
    /// Divides by the parameters that vanish on collapsed sides.
    pub fn divide(&mut self, side: usize) {
        let n = if side < 2 { self.degree.s } else { self.degree.t };
        self.coefficients = divided_by_side(&self.coefficients, self.degree, side);
        self.degree = self.degree.lowered(side / 2);
        self.error *= n as f64;
    }

    /// Raises the degree to `wanted`.
    pub fn elevate(&mut self, wanted: Bidegree) {
        while self.degree.s < wanted.s {
            self.coefficients = elevated(&self.coefficients, self.degree, 0);
            self.degree.s += 1;
        }
        while self.degree.t < wanted.t {
            self.coefficients = elevated(&self.coefficients, self.degree, 1);
            self.degree.t += 1;
        }
        let (low, high) = extent(&self.coefficients);
        self.error += 16.0 * crate::bounds::HALF_ULP * low.abs().max(high.abs());
    }

    /// The coefficients on a side (as in `index::side`).
    pub fn on_side(&self, side: usize) -> Vec<f64> {
        let width = self.degree.t + 1;
        let pick = |k: usize| match side {
            0 => k < width,
            1 => k >= self.degree.s * width,
            2 => k.is_multiple_of(width),
            _ => k % width == self.degree.t,
        };
        let list = self.coefficients.iter().enumerate();
        list.filter(|&(k, _)| pick(k)).map(|(_, &c)| c).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::jet::{BezierPatch, Lane, lanes};
    use crate::simd::Level;

    #[test]
    fn slopes_are_the_derivatives_of_the_squared_distance() {
        let degree = Bidegree { s: 3, t: 2 };
        let mut poles: Vec<f64> = (0..48).map(|k| ((k * 29 + 5) % 17) as f64 / 7.0).collect();
        for w in &mut poles[36..] {
            *w += 0.5;
        }
        let p = [0.3, -0.2, 1.0];
        for rational in [true, false] {
            let poles = if rational { &poles[..] } else { &poles[..36] };
            let all = [0.0, 1.0, 0.0, 1.0];
            let view = View::new(poles, degree, rational, all, p, [9.0, 1e-15, 0.0]);
            let lanes: Vec<Lane> = lanes(poles, rational).collect();
            let level = Level::detect();
            let patch = BezierPatch { degree, rational, poles, lanes: &lanes, level };
            for direction in [0, 1] {
                let mut slope = view.slope(direction);
                let k = if rational { 3 } else { 2 };
                slope.elevate(Bidegree { s: k * degree.s, t: k * degree.t });
                assert!(slope.error < 1e-8, "{}", slope.error);
                for (s, t) in [(0.0, 1.0), (0.3, 0.8), (0.6, 0.1)] {
                    let jet = patch.jet(s, t, p);
                    let w = if rational { jet.w[0] } else { 1.0 };
                    let expected = jet.gradient()[direction] * w * w * w;
                    let mut c = slope.coefficients.clone();
                    cut_2d(&mut c, slope.degree, [0.0, s.max(1e-300)], [0.0, t.max(1e-300)]);
                    let row = slope.degree.s * (slope.degree.t + 1);
                    let s_end = if s > 0.0 { row } else { 0 };
                    let found = c[s_end + if t > 0.0 { slope.degree.t } else { 0 }];
                    let size = 1.0 + expected.abs();
                    assert!((found - expected).abs() < 1e-12 * size, "{found} {expected}");
                }
            }
        }
    }
}
