//! Jets: the vector from a query to a shape, with its first and second derivatives.
//!
//! With `r = X - W p` the vector is `d = r / W`, and differentiating `W d = r` gives
//! `W d_s = r_s - W_s d`, `W d_ss = r_ss - 2 W_s d_s - W_ss d`, `W d_st = r_st - W_s d_t - W_t d_s - W_st d`.
//! Reference: Piegl, Tiller, *The NURBS Book*, 2nd ed., equations 4.8 and 4.20.

use crate::bezier::{Bidegree, basis};
use crate::bounds::{Vector, dot, sub};
use crate::knots::MAX_DEGREE;

/// Second derivatives of the squared distance below this share of the metric count as zero.
const FLAT: f64 = 1e-6;

/// Vector to a curve point and its derivatives in the local parameter.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Jet1 {
    /// Point minus query.
    pub d: Vector,
    /// First derivative.
    pub s: Vector,
    /// Second derivative.
    pub ss: Vector,
    /// Weight and its first derivative.
    pub w: [f64; 2],
}

/// Vector to a surface point and its derivatives in the local parameters.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Jet2 {
    /// Point minus query.
    pub d: Vector,
    /// First derivatives.
    pub s: Vector,
    /// See `s`.
    pub t: Vector,
    /// Second derivatives.
    pub ss: Vector,
    /// See `ss`.
    pub st: Vector,
    /// See `ss`.
    pub tt: Vector,
    /// Weight and its two first derivatives.
    pub w: [f64; 3],
}

impl Jet1 {
    /// Squared distance.
    pub fn squared(&self) -> f64 {
        dot(self.d, self.d)
    }

    /// Half the derivative of the squared distance.
    pub fn gradient(&self) -> f64 {
        dot(self.d, self.s)
    }

    /// Half the second derivative of the squared distance.
    pub fn hessian(&self) -> f64 {
        dot(self.s, self.s) + dot(self.d, self.ss)
    }

    /// Whether the distance is stationary to second order: the query is near the centre of curvature.
    pub fn is_flat(&self) -> bool {
        self.hessian().abs() <= FLAT * dot(self.s, self.s)
    }
}

impl Jet2 {
    /// Squared distance.
    pub fn squared(&self) -> f64 {
        dot(self.d, self.d)
    }

    /// Half the gradient of the squared distance.
    pub fn gradient(&self) -> [f64; 2] {
        [dot(self.d, self.s), dot(self.d, self.t)]
    }

    /// Half the Hessian of the squared distance: ss, st, tt.
    pub fn hessian(&self) -> [f64; 3] {
        let [e, f, g] = self.metric();
        [e + dot(self.d, self.ss), f + dot(self.d, self.st), g + dot(self.d, self.tt)]
    }

    /// A parameter direction in which the distance is stationary to second order, if there is one; scaled to 1 in
    /// its greater component.
    pub fn flat_direction(&self) -> Option<[f64; 2]> {
        let ([e, f, g], [a, b, c]) = (self.metric(), self.hessian());
        let area = e * g - f * f;
        if area <= 1e-12 * e * g || (a * c - b * b).abs() > FLAT * area {
            return None;
        }
        let v = if a * g > c * e { [-b, a] } else { [c, -b] };
        let size = v[0].abs().max(v[1].abs());
        let scale = a.abs().max(b.abs()).max(c.abs());
        // All zero but for rounding: every direction is flat.
        Some(if scale <= FLAT * (e + g) { [1.0, 0.0] } else { v.map(|x| x / size) })
    }

    /// First fundamental form: E, F, G.
    pub fn metric(&self) -> [f64; 3] {
        [dot(self.s, self.s), dot(self.s, self.t), dot(self.t, self.t)]
    }

    /// The jet along one direction: 0 keeps s, 1 keeps t.
    pub fn along(&self, direction: usize) -> Jet1 {
        if direction == 0 {
            Jet1 { d: self.d, s: self.s, ss: self.ss, w: [self.w[0], self.w[1]] }
        } else {
            Jet1 { d: self.d, s: self.t, ss: self.tt, w: [self.w[0], self.w[2]] }
        }
    }
}

/// A Bezier segment: poles component by component (x, y, z and, when rational, w; `degree + 1` each).
#[derive(Clone, Copy, Debug)]
pub struct BezierSegment<'a> {
    /// Degree.
    pub degree: usize,
    /// Whether the fourth component is there.
    pub rational: bool,
    /// Homogeneous poles.
    pub poles: &'a [f64],
}

/// A Bezier patch: poles component by component, pole (i, j) of a component at `i * (degree.t + 1) + j`.
#[derive(Clone, Copy, Debug)]
pub struct BezierPatch<'a> {
    /// Degrees.
    pub degree: Bidegree,
    /// Whether the fourth component is there.
    pub rational: bool,
    /// Homogeneous poles.
    pub poles: &'a [f64],
}

type Basis = [f64; MAX_DEGREE + 1];

impl BezierSegment<'_> {
    /// The jet at `s` for the query `p`. Cost: O(degree^2) for the basis, then 12 or 9 short sums.
    pub fn jet(&self, s: f64, p: Vector) -> Jet1 {
        let n = self.degree + 1;
        let (mut b, mut b1, mut b2): (Basis, Basis, Basis) = Default::default();
        basis(self.degree, s, &mut b, &mut b1, &mut b2);
        let mut sums = [[0.0; 4]; 3];
        for (c, component) in self.poles.chunks_exact(n).enumerate() {
            for (k, x) in component.iter().enumerate() {
                sums[0][c] += b[k] * x;
                sums[1][c] += b1[k] * x;
                sums[2][c] += b2[k] * x;
            }
        }
        if !self.rational {
            let [x, s, ss] = sums.map(|[x, y, z, _]| [x, y, z]);
            return Jet1 { d: sub(x, p), s, ss, w: [1.0, 0.0] };
        }
        let (w, w1, w2) = (sums[0][3], sums[1][3], sums[2][3]);
        let mut jet = Jet1 { w: [w, w1], ..Jet1::default() };
        for c in 0..3 {
            let r = |k: usize| sums[k][c] - sums[k][3] * p[c];
            jet.d[c] = r(0) / w;
            jet.s[c] = (r(1) - w1 * jet.d[c]) / w;
            jet.ss[c] = (r(2) - 2.0 * w1 * jet.s[c] - w2 * jet.d[c]) / w;
        }
        jet
    }
}

impl BezierPatch<'_> {
    /// The jet at `(s, t)` for the query `p`.
    pub fn jet(&self, s: f64, t: f64, p: Vector) -> Jet2 {
        // Fixed inner lengths let the compiler unroll the common degrees; the sums and their order are the same.
        let sums = match self.degree.t {
            1 => self.sums::<2>(s, t),
            2 => self.sums::<3>(s, t),
            3 => self.sums::<4>(s, t),
            _ => self.sums::<0>(s, t),
        };
        if !self.rational {
            let [x, s, t, ss, st, tt] = sums.map(|[x, y, z, _]| [x, y, z]);
            return Jet2 { d: sub(x, p), s, t, ss, st, tt, w: [1.0, 0.0, 0.0] };
        }
        divided(&sums, p)
    }

    /// Value, s, t, ss, st, tt of the four components. `N` is the number of columns, 0 when not fixed.
    fn sums<const N: usize>(&self, s: f64, t: f64) -> [[f64; 4]; 6] {
        let columns = if N == 0 { self.degree.t + 1 } else { N };
        let (mut bs, mut bs1, mut bs2): (Basis, Basis, Basis) = Default::default();
        let (mut bt, mut bt1, mut bt2): (Basis, Basis, Basis) = Default::default();
        basis(self.degree.s, s, &mut bs, &mut bs1, &mut bs2);
        basis(self.degree.t, t, &mut bt, &mut bt1, &mut bt2);
        let mut sums = [[0.0; 4]; 6];
        for (c, component) in self.poles.chunks_exact(self.degree.count()).enumerate() {
            for (i, row) in component.chunks_exact(columns).enumerate() {
                let mut v = [0.0; 3];
                for j in 0..columns {
                    v[0] += bt[j] * row[j];
                    v[1] += bt1[j] * row[j];
                    v[2] += bt2[j] * row[j];
                }
                sums[0][c] += bs[i] * v[0];
                sums[1][c] += bs1[i] * v[0];
                sums[2][c] += bs[i] * v[1];
                sums[3][c] += bs2[i] * v[0];
                sums[4][c] += bs1[i] * v[1];
                sums[5][c] += bs[i] * v[2];
            }
        }
        sums
    }
}

fn divided(sums: &[[f64; 4]; 6], p: Vector) -> Jet2 {
    let [w, ws, wt, wss, wst, wtt] = sums.map(|sum| sum[3]);
    let mut jet = Jet2 { w: [w, ws, wt], ..Jet2::default() };
    for c in 0..3 {
        let r = |k: usize| sums[k][c] - sums[k][3] * p[c];
        let d = r(0) / w;
        let (s, t) = ((r(1) - ws * d) / w, (r(2) - wt * d) / w);
        jet.d[c] = d;
        jet.s[c] = s;
        jet.t[c] = t;
        jet.ss[c] = (r(3) - 2.0 * ws * s - wss * d) / w;
        jet.st[c] = (r(4) - ws * t - wt * s - wst * d) / w;
        jet.tt[c] = (r(5) - 2.0 * wt * t - wtt * d) / w;
    }
    jet
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bounds::{norm, scaled};

    #[test]
    fn a_quarter_circle_has_its_curvature() {
        let r = 0.5f64.sqrt();
        let poles = [1.0, r, 0.0, 0.0, r, 1.0, 0.0, 0.0, 0.0, 1.0, r, 1.0];
        let arc = BezierSegment { degree: 2, rational: true, poles: &poles };
        for s in [0.0, 0.3, 1.0] {
            let jet = arc.jet(s, [0.0; 3]);
            assert!((norm(jet.d) - 1.0).abs() < 1e-15);
            let speed = norm(jet.s);
            let k = norm(crate::bounds::cross(jet.s, jet.ss)) / speed.powi(3);
            assert!((k - 1.0).abs() < 1e-14, "s {s} curvature {k}");
        }
    }

    #[test]
    fn patch_derivatives_agree_with_differences() {
        let degree = Bidegree { s: 3, t: 2 };
        let mut poles: Vec<f64> = (0..48).map(|k| ((k * 29 + 5) % 17) as f64 / 7.0).collect();
        for w in &mut poles[36..] {
            *w += 0.5;
        }
        let patch = BezierPatch { degree, rational: true, poles: &poles };
        let (s, t, h, p) = (0.4, 0.7, 1e-5, [0.3, -0.2, 1.0]);
        let jet = patch.jet(s, t, p);
        let central =
            |a: Jet2, b: Jet2, f: fn(&Jet2) -> Vector| scaled(sub(f(&a), f(&b)), 1.0 / (2.0 * h));
        let (sp, sm) = (patch.jet(s + h, t, p), patch.jet(s - h, t, p));
        let (tp, tm) = (patch.jet(s, t + h, p), patch.jet(s, t - h, p));
        let close = |a: Vector, b: Vector| assert!(norm(sub(a, b)) < 1e-6, "{a:?} {b:?}");
        close(jet.s, central(sp, sm, |j| j.d));
        close(jet.t, central(tp, tm, |j| j.d));
        close(jet.ss, central(sp, sm, |j| j.s));
        close(jet.st, central(tp, tm, |j| j.s));
        close(jet.tt, central(tp, tm, |j| j.t));
    }
}
