//! Jets: the vector from a query to a shape, with its first and second derivatives.
//!
//! With `r = X - W p` the vector is `d = r / W`, and differentiating `W d = r` gives
//! `W d_s = r_s - W_s d`, `W d_ss = r_ss - 2 W_s d_s - W_ss d`, `W d_st = r_st - W_s d_t - W_t d_s - W_st d`.
//! Reference: Piegl, Tiller, *The NURBS Book*, 2nd ed., equations 4.8 and 4.20.

mod lockstep;
mod slopes;
mod sums;

pub use lockstep::{PatchJets, SegmentJets};
pub use slopes::Slopes;

use crate::bezier::Bidegree;
use crate::bounds::{Vector, dot, norm, sub};
use crate::knots::MAX_DEGREE;
use crate::simd::{Kernel, Lanes, Level, Simd};
use sums::{
    EXACT, FIXED, MIDDLE, bernstein, patch_sums, quotients, quotients_of_two, segment_sums,
};

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

impl From<Jet1> for Jet2 {
    /// A jet that does not depend on t.
    fn from(jet: Jet1) -> Self {
        Self { d: jet.d, s: jet.s, ss: jet.ss, w: [jet.w[0], jet.w[1], 0.0], ..Self::default() }
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
        let v = if a.abs() * g > c.abs() * e { [-b, a] } else { [c, -b] };
        let size = v[0].abs().max(v[1].abs());
        // Each by the metric: one tangent may be much shorter than the other.
        let is_zero =
            a.abs() <= FLAT * e && c.abs() <= FLAT * g && b.abs() <= FLAT * (e * g).sqrt();
        let speeds = [e.sqrt(), g.sqrt()];
        let part = (v[0].abs() * speeds[0]).max(v[1].abs() * speeds[1]);
        // All zero but for rounding: every direction is flat.
        let snapped = [0, 1].map(|k| {
            let is_small = v[k].abs() * speeds[k] <= FLAT * part;
            if is_small { 0.0 } else { v[k] / size }
        });
        Some(if is_zero { [1.0, 0.0] } else { snapped })
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
    /// The same poles, pole by pole (see [`lanes`]).
    pub lanes: &'a [Lane],
    /// Vector instructions for its kernels.
    pub level: Level,
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
    /// The same poles, pole by pole (see [`lanes`]).
    pub lanes: &'a [Lane],
    /// Vector instructions for its kernels.
    pub level: Level,
}

/// One homogeneous pole: x, y, z, w, or any sum of such.
pub type Lane = [f64; 4];

/// The poles of a net given component by component, pole by pole: the form in which sums over poles run in vectors. The
/// weight of a polynomial net is 1.
pub fn lanes(poles: &[f64], rational: bool) -> impl Iterator<Item = Lane> + '_ {
    let count = poles.len() / if rational { 4 } else { 3 };
    let weight = move |k: usize| if rational { poles[3 * count + k] } else { 1.0 };
    (0..count).map(move |k| [poles[k], poles[count + k], poles[2 * count + k], weight(k)])
}

/// A homogeneous pole as a point.
pub fn place([x, y, z, w]: Lane) -> Vector {
    [x / w, y / w, z / w]
}

/// Distance of a homogeneous pole from a point.
pub fn pole_distance(pole: &Lane, q: Vector) -> f64 {
    norm(sub(place(*pole), q))
}

#[inline(always)]
fn vector<V: Lanes<4>>(lane: V) -> Vector {
    let [x, y, z, _] = lane.array();
    [x, y, z]
}

#[inline(always)]
fn weight<V: Lanes<4>>(lane: V) -> f64 {
    lane.array()[3]
}

struct SegmentJet<'a>(&'a BezierSegment<'a>, f64, Vector);

impl SegmentJet<'_> {
    /// Value, first and second derivative; `N` is the number of poles, or at least that.
    #[inline(always)]
    fn sums<S: Simd, const N: usize>(&self, n: usize) -> [S::F4; 3] {
        let b = bernstein::<f64, 1, N>(n, self.1);
        let [values, first, second] = &b;
        segment_sums::<S, 1>(&self.0.lanes[..n], [values, first, second])
    }
}

impl Kernel for SegmentJet<'_> {
    type Out = Jet1;

    #[inline(always)]
    fn run<S: Simd>(self, _: S) -> Jet1 {
        let sums = match self.0.degree {
            1 => self.sums::<S, 2>(2),
            2 => self.sums::<S, 3>(3),
            3 => self.sums::<S, 4>(4),
            4 => self.sums::<S, 5>(5),
            FIXED => self.sums::<S, 6>(6),
            6 => self.sums::<S, 7>(7),
            7 => self.sums::<S, 8>(8),
            8 => self.sums::<S, 9>(9),
            9 => self.sums::<S, 10>(10),
            p @ ..=MIDDLE => self.sums::<S, { MIDDLE + 1 }>(p + 1),
            p => self.sums::<S, { MAX_DEGREE + 1 }>(p + 1),
        };
        if !self.0.rational {
            let d = sub(vector(sums[0]), self.2);
            return Jet1 { d, s: vector(sums[1]), ss: vector(sums[2]), w: [1.0, 0.0] };
        }
        let p = S::F4::load(&[self.2[0], self.2[1], self.2[2], 0.0]);
        let weights = [weight(sums[0]), weight(sums[1]), weight(sums[2])];
        let [w, w1, w2] = weights;
        let weighting = [S::F4::splat(w), S::F4::splat(w1), S::F4::splat(w2)];
        let [d, s, ss] = quotients(sums, weighting, p);
        Jet1 { d: vector(d), s: vector(s), ss: vector(ss), w: [weights[0], weights[1]] }
    }
}

impl BezierSegment<'_> {
    /// The jet at `s` for the query `p`. Cost: O(degree^2) for the basis, then three short sums.
    pub fn jet(&self, s: f64, p: Vector) -> Jet1 {
        self.level.run(SegmentJet(self, s, p))
    }
}

struct PatchJet<'a>(&'a BezierPatch<'a>, [f64; 2], Vector);

impl PatchJet<'_> {
    /// Value, s, t, ss, st, tt. `N` is the number of columns, or at least that.
    #[inline(always)]
    fn sums<S: Simd, const N: usize>(&self) -> [S::F4; 6] {
        if self.0.degree.s <= FIXED {
            self.sums_of::<S, N, { FIXED + 1 }>()
        } else if self.0.degree.s <= MIDDLE {
            self.sums_of::<S, N, { MIDDLE + 1 }>()
        } else {
            self.sums_of::<S, N, { MAX_DEGREE + 1 }>()
        }
    }

    #[inline(always)]
    fn sums_of<S: Simd, const N: usize, const ROWS: usize>(&self) -> [S::F4; 6] {
        let columns = if N > EXACT + 1 { self.0.degree.t + 1 } else { N };
        let across = bernstein::<f64, 1, ROWS>(self.0.degree.s + 1, self.1[0]);
        let along = bernstein::<f64, 1, N>(columns, self.1[1]);
        let [b, b1, b2] = &across;
        let [c, c1, c2] = &along;
        patch_sums::<S, N, 1>(self.0.lanes, columns, [b, b1, b2], [c, c1, c2])
    }
}

impl Kernel for PatchJet<'_> {
    type Out = Jet2;

    #[inline(always)]
    fn run<S: Simd>(self, _: S) -> Jet2 {
        let sums = match self.0.degree.t {
            1 => self.sums::<S, 2>(),
            2 => self.sums::<S, 3>(),
            3 => self.sums::<S, 4>(),
            4 => self.sums::<S, 5>(),
            FIXED => self.sums::<S, 6>(),
            6 => self.sums::<S, 7>(),
            7 => self.sums::<S, 8>(),
            8 => self.sums::<S, 9>(),
            9 => self.sums::<S, 10>(),
            ..=MIDDLE => self.sums::<S, { MIDDLE + 1 }>(),
            _ => self.sums::<S, { MAX_DEGREE + 1 }>(),
        };
        if !self.0.rational {
            return Jet2 {
                d: sub(vector(sums[0]), self.2),
                s: vector(sums[1]),
                t: vector(sums[2]),
                ss: vector(sums[3]),
                st: vector(sums[4]),
                tt: vector(sums[5]),
                w: [1.0, 0.0, 0.0],
            };
        }
        divided(sums, self.2)
    }
}

struct PatchVector<'a>(&'a BezierPatch<'a>, [f64; 2], Vector);

impl PatchVector<'_> {
    #[inline(always)]
    fn sum<S: Simd, const ROWS: usize, const N: usize>(&self) -> S::F4 {
        let (rows, columns) = (self.0.degree.s + 1, self.0.degree.t + 1);
        let [across, ..] = bernstein::<f64, 1, ROWS>(rows, self.1[0]);
        let [along, ..] = bernstein::<f64, 1, N>(columns, self.1[1]);
        let mut sum = S::F4::splat(0.0);
        for (row, b) in self.0.lanes.chunks_exact(columns).zip(&across) {
            let mut part = S::F4::splat(0.0);
            for (lane, b) in row.iter().zip(&along) {
                part = part + S::F4::splat(*b) * S::F4::load(lane);
            }
            sum = sum + S::F4::splat(*b) * part;
        }
        sum
    }
}

impl Kernel for PatchVector<'_> {
    type Out = Vector;

    #[inline(always)]
    fn run<S: Simd>(self, _: S) -> Vector {
        let sum = if self.0.degree.s.max(self.0.degree.t) <= FIXED {
            self.sum::<S, { FIXED + 1 }, { FIXED + 1 }>()
        } else if self.0.degree.s.max(self.0.degree.t) <= MIDDLE {
            self.sum::<S, { MIDDLE + 1 }, { MIDDLE + 1 }>()
        } else {
            self.sum::<S, { MAX_DEGREE + 1 }, { MAX_DEGREE + 1 }>()
        };
        if !self.0.rational {
            return sub(vector(sum), self.2);
        }
        let w = S::F4::splat(weight(sum));
        vector((sum - w * S::F4::load(&[self.2[0], self.2[1], self.2[2], 0.0])) / w)
    }
}

impl BezierPatch<'_> {
    /// How fast points move at most with s and with t, weights apart.
    pub fn speed(&self) -> [f64; 2] {
        let (width, mut most) = (self.degree.t + 1, [0.0_f64; 2]);
        for (k, pole) in self.lanes.iter().enumerate() {
            let from = place(*pole);
            if k >= width {
                most[0] = most[0].max(pole_distance(&self.lanes[k - width], from));
            }
            if k % width > 0 {
                most[1] = most[1].max(pole_distance(&self.lanes[k - 1], from));
            }
        }
        [most[0] * self.degree.s as f64, most[1] * self.degree.t as f64]
    }

    /// The vector from the query `p` to the point at `(s, t)`: the jet without its derivatives.
    pub fn vector(&self, s: f64, t: f64, p: Vector) -> Vector {
        self.level.run(PatchVector(self, [s, t], p))
    }

    /// The jet at `(s, t)` for the query `p`.
    pub fn jet(&self, s: f64, t: f64, p: Vector) -> Jet2 {
        self.level.run(PatchJet(self, [s, t], p))
    }
}

#[inline(always)]
fn divided<V: Lanes<4>>(sums: [V; 6], p: Vector) -> Jet2 {
    let p = V::load(&[p[0], p[1], p[2], 0.0]);
    let weights = [weight(sums[0]), weight(sums[1]), weight(sums[2])];
    let [w, ws, wt] = [V::splat(weights[0]), V::splat(weights[1]), V::splat(weights[2])];
    let (wss, wst) = (V::splat(weight(sums[3])), V::splat(weight(sums[4])));
    let wtt = V::splat(weight(sums[5]));
    let [d, s, t, ss, st, tt] = quotients_of_two(sums, [w, ws, wt, wss, wst, wtt], p);
    Jet2 {
        d: vector(d),
        s: vector(s),
        t: vector(t),
        ss: vector(ss),
        st: vector(st),
        tt: vector(tt),
        w: weights,
    }
}

#[cfg(test)]
mod tests {
    use super::sums::{Basis, fixed_basis, widened};
    use super::*;
    use crate::bezier::basis;
    use crate::bounds::scaled;

    #[test]
    fn a_basis_without_loops_is_the_basis() {
        let same = |n: usize, fixed: Basis<f64, 6>, s: f64| {
            let mut out = [[0.0; 6]; 3];
            let [values, first, second] = &mut out;
            basis::<f64, 1, 6>(n - 1, s, &mut values[..n], &mut first[..n], &mut second[..n]);
            for (a, b) in out.iter().flatten().zip(fixed.iter().flatten()) {
                assert!((a - b).abs() <= 1e-14, "{n} poles, s {s}: {a} {b}");
            }
        };
        for s in [0.0, 0.3, 0.77, 1.0] {
            same(2, widened::<f64, 1, 2, 6>(fixed_basis(s)), s);
            same(3, widened::<f64, 1, 3, 6>(fixed_basis(s)), s);
            same(4, widened::<f64, 1, 4, 6>(fixed_basis(s)), s);
            same(5, widened::<f64, 1, 5, 6>(fixed_basis(s)), s);
            same(6, widened::<f64, 1, 6, 6>(fixed_basis(s)), s);
        }
    }

    #[test]
    fn a_quarter_circle_has_its_curvature() {
        let r = 0.5f64.sqrt();
        let poles = [1.0, r, 0.0, 0.0, r, 1.0, 0.0, 0.0, 0.0, 1.0, r, 1.0];
        let pole_lanes: Vec<Lane> = lanes(&poles, true).collect();
        let level = Level::detect();
        let arc =
            BezierSegment { degree: 2, rational: true, poles: &poles, lanes: &pole_lanes, level };
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
        let pole_lanes: Vec<Lane> = lanes(&poles, true).collect();
        let level = Level::detect();
        let patch =
            BezierPatch { degree, rational: true, poles: &poles, lanes: &pole_lanes, level };
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
        assert!(norm(sub(jet.d, patch.vector(s, t, p))) < 1e-15);
        let slopes = patch.slopes(s, t, p);
        for (a, b) in [(slopes.d, jet.d), (slopes.s, jet.s), (slopes.t, jet.t)] {
            assert!(norm(sub(a, b)) < 1e-14);
        }
    }
}
