//! What is asked of the weights, as equations: their residuals and derivatives.
//!
//! Variables are the logarithms of the weights. A point at fixed parameters moves towards a pole by
//!
//! ```text
//!   dC / d log w_j = R_j (P_j - C),     R_j = N_j w_j / sum N w
//! ```
//!
//! and a least distance changes with its foot held fast (its own motion counts in second order only). Logarithms are never
//! computed: a step `x` multiplies a weight by `(x/2 + sqrt(1 + x^2/4))^2`, which is exp(2 asinh(x/2)), and
//! [`height`] is its inverse; both use `+ - * / sqrt` only, so that bits are the same on every machine.

use super::net::{Fitted, Net, Share};
use crate::basis;
use crate::bounds::{Vector, cross, dot, norm, scaled, sub};
use crate::closest::{FootPoint, Workspace};
use crate::error::Error;

/// The factor of a step.
pub fn factor(step: f64) -> f64 {
    let half = 0.5 * step.abs();
    let root = half + (1.0 + half * half).sqrt();
    if step < 0.0 { 1.0 / (root * root) } else { root * root }
}

/// The step with this factor: 0 for 1, near the logarithm around it.
pub fn height(factor: f64) -> f64 {
    (factor - 1.0) / factor.sqrt()
}

/// A constraint with its numbers settled.
#[derive(Clone, Copy, Debug)]
pub enum Target {
    At([f64; 2], Vector),
    Anywhere(Vector),
    /// A unit vector.
    Tangent(f64, Vector),
}

impl Target {
    /// Equations that it gives.
    fn rows(&self) -> usize {
        3
    }
}

/// The equations, all relative to the size of the net.
pub struct Problem<'a> {
    pub net: Net<'a>,
    pub diagonal: f64,
    /// Poles and distances that are asked for, without those proven impossible.
    pub wishes: Vec<(usize, f64)>,
    pub targets: Vec<Target>,
    /// The variable of each pole: poles that are kept equal share one.
    pub variable_of: Vec<usize>,
    pub variables: usize,
    /// Accuracy asked of the nearest points.
    pub accuracy: f64,
}

/// Residuals `f` and their derivatives, a row of `variables` numbers each, at some weights.
#[derive(Clone, Debug, Default)]
pub struct Equations {
    pub f: Vec<f64>,
    pub rows: Vec<f64>,
}

impl Equations {
    pub fn squares(&self) -> f64 {
        self.f.iter().map(|f| f * f).sum()
    }

    pub fn worst(&self) -> f64 {
        self.f.iter().fold(0.0, |most: f64, f| most.max(f.abs()))
    }
}

/// Memory and counts of one search.
#[derive(Default)]
pub struct Tools {
    pub workspace: Workspace,
    shares: Vec<Share>,
    /// Shapes that were made and measured.
    pub shapes: u64,
}

impl Problem<'_> {
    /// The weights of the poles from those of the variables.
    pub fn spread(&self, variables: &[f64]) -> Vec<f64> {
        self.variable_of.iter().map(|&v| variables[v]).collect()
    }

    /// All equations at the weights of the variables.
    pub fn equations(&self, variables: &[f64], tools: &mut Tools) -> Result<Equations, Error> {
        let weights = self.spread(variables);
        let shape = self.net.with(&weights)?;
        tools.shapes += 1;
        let mut all = Equations::default();
        for &(pole, wish) in &self.wishes {
            let query = self.net.poles()[pole];
            let foot = shape.closest(query, self.accuracy, &mut tools.workspace);
            self.wish(&weights, pole, wish, &foot, tools, &mut all);
        }
        for target in &self.targets {
            self.target(&weights, &shape, target, tools, &mut all);
        }
        Ok(all)
    }

    /// One row: `distance - wish`.
    fn wish(
        &self,
        weights: &[f64],
        pole: usize,
        wish: f64,
        foot: &FootPoint,
        tools: &mut Tools,
        all: &mut Equations,
    ) {
        all.f.push((foot.distance - wish) / self.diagonal);
        let start = self.grow(all, 1);
        if foot.distance > 0.0 {
            let away = sub(foot.point, self.net.poles()[pole]);
            let along = scaled(away, 1.0 / (foot.distance * self.diagonal));
            self.rational_shares(weights, [foot.u, foot.v], tools);
            for &(j, share) in &tools.shares {
                let change = share * dot(along, sub(self.net.poles()[j], foot.point));
                all.rows[start + self.variable_of[j]] += change;
            }
        }
    }

    /// Room for `count` more rows; returns where they begin.
    fn grow(&self, all: &mut Equations, count: usize) -> usize {
        let start = all.rows.len();
        all.rows.resize(start + count * self.variables, 0.0);
        start
    }

    /// `R_j` at a place into `tools.shares`.
    fn rational_shares(&self, weights: &[f64], at: [f64; 2], tools: &mut Tools) {
        self.net.shares(at, &mut tools.shares);
        let sum: f64 = tools.shares.iter().map(|&(j, n)| n * weights[j]).sum();
        for (j, n) in &mut tools.shares {
            *n *= weights[*j] / sum;
        }
    }

    fn target(
        &self,
        weights: &[f64],
        shape: &Fitted,
        target: &Target,
        tools: &mut Tools,
        all: &mut Equations,
    ) {
        let (at, point, across) = match *target {
            Target::Tangent(u, direction) => {
                return self.tangent(weights, shape, u, direction, all);
            }
            Target::At(at, point) => (at, point, Vec::new()),
            Target::Anywhere(point) => {
                let foot = shape.closest(point, self.accuracy, &mut tools.workspace);
                let at = [foot.u, foot.v];
                (at, point, orthonormal(&shape.tangents(at)))
            }
        };
        let place = shape.point(at);
        let start = self.grow(all, target.rows());
        all.f.extend(sub(place, point).map(|x| x / self.diagonal));
        self.rational_shares(weights, at, tools);
        for &(j, share) in &tools.shares {
            let mut motion = scaled(sub(self.net.poles()[j], place), share / self.diagonal);
            for t in &across {
                motion = sub(motion, scaled(*t, dot(motion, *t)));
            }
            for (axis, x) in motion.into_iter().enumerate() {
                all.rows[start + axis * self.variables + self.variable_of[j]] += x;
            }
        }
    }

    /// `C' x direction = 0`, relative to the length of `C'`.
    ///
    /// `dC' / d log w_j = R_j' (P_j - C) - R_j C'` with `R_j' = (N_j' w_j - R_j W') / W`.
    fn tangent(
        &self,
        weights: &[f64],
        shape: &Fitted,
        u: f64,
        direction: Vector,
        all: &mut Equations,
    ) {
        let start = self.grow(all, 3);
        let (Net::Curve(curve), place) = (self.net, shape.point([u, 0.0])) else {
            all.f.extend([0.0; 3]);
            return;
        };
        let (knots, degree) = (curve.knots(), curve.degree());
        let (span, velocity) = (knots.span(u), shape.tangents([u, 0.0])[0]);
        let speed = norm(velocity).max(f64::MIN_POSITIVE);
        all.f.extend(cross(velocity, direction).map(|x| x / speed));
        let mut basis = vec![0.0; 2 * (degree + 1)];
        basis::derivatives(knots, span, u, 1, &mut basis);
        let (values, slopes) = basis.split_at(degree + 1);
        let local = &weights[span - degree..=span];
        let sum = |row: &[f64]| -> f64 { row.iter().zip(local).map(|(n, w)| n * w).sum() };
        let (total, total_slope) = (sum(values), sum(slopes));
        for j in 0..=degree {
            let share = values[j] * local[j] / total;
            let slope = (slopes[j] * local[j] - share * total_slope) / total;
            let pole = self.net.poles()[span - degree + j];
            let motion = sub(scaled(sub(pole, place), slope), scaled(velocity, share));
            let variable = self.variable_of[span - degree + j];
            for (axis, x) in cross(motion, direction).into_iter().enumerate() {
                all.rows[start + axis * self.variables + variable] += x / speed;
            }
        }
    }
}

/// Orthonormal vectors that span the same plane or line; what vanishes is left out.
fn orthonormal(vectors: &[Vector]) -> Vec<Vector> {
    let mut out: Vec<Vector> = Vec::new();
    for vector in vectors {
        let length = norm(*vector);
        let rest = out.iter().fold(*vector, |rest, t| sub(rest, scaled(*t, dot(rest, *t))));
        let left = norm(rest);
        if left > 1e-9 * length {
            out.push(scaled(rest, 1.0 / left));
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_and_heights_are_inverse() {
        for step in [-7.0, -1.0, -1e-9, 0.0, 1e-9, 0.5, 6.0] {
            assert!((height(factor(step)) - step).abs() <= 1e-14 * (1.0 + step.abs()), "{step}");
        }
        assert_eq!(factor(0.0), 1.0);
        assert!((factor(1e-6) - 1.000001).abs() < 1e-12);
    }
}
