//! Whole Newton steps of many queries, lane by lane, inside of their pieces.
//!
//! Only what the iteration does where nothing is in its way: who meets a border, a model without a minimum or a step that
//! leads away leaves ([`Course::Leaves`]) and begins again alone. So both give the same bits.

use super::surface::{Products, State, determinant, is_better, solved, steepness, stride};
use super::{NO_STEP, is_last};
use crate::bounds::dot;
use crate::jet::{PatchJets, SegmentJets};
use crate::simd::{Kernel, Lanes, Level, Row, Simd, WIDTH};

/// Where an iteration goes from a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Course<P> {
    /// On, by a step of this size.
    Goes(P, f64),
    /// To its foot, which need not be looked at.
    Lands(P),
    /// Nowhere: this is the foot.
    Stays,
    /// It takes more than whole Newton steps.
    Leaves,
}

/// What was found at the places of some queries, row by row.
#[derive(Clone, Debug, Default)]
pub struct SurfaceSteps {
    /// d, s, t.
    pub jets: [[Row; 3]; 3],
    /// The weight.
    pub w: Row,
    squared: Row,
    steepness: Row,
    step: [Row; 2],
    /// Lanes whose model has a minimum near enough.
    newton: u32,
}

/// As [`SurfaceSteps`], on curves.
#[derive(Clone, Debug, Default)]
pub struct CurveSteps {
    /// d, s.
    pub jets: [[Row; 3]; 2],
    /// The weight.
    pub w: Row,
    squared: Row,
    gradient: Row,
    hessian: Row,
}

/// By how much a place is worse than the next: what is kept of it.
pub type Worth = [f64; 2];

impl SurfaceSteps {
    /// From the jets for the queries `p`.
    pub fn take(&mut self, jets: &PatchJets, p: &[Row; 3], rational: bool, level: Level) {
        level.run(TakeSurface { jets, p, rational, out: self });
    }

    /// What lane `q` is worth.
    pub fn worth(&self, q: usize) -> Worth {
        [self.squared[q], self.steepness[q]]
    }

    /// Whether a step from a place worth `before` to the one of lane `q` is accepted.
    pub fn is_better(&self, q: usize, before: Worth) -> bool {
        let [squared, steepness] = self.worth(q);
        is_better([squared, before[0]], || [steepness, before[1]])
    }

    /// The course of lane `q` from its place, inside of the patch, after a step of size `before`.
    pub fn course(&self, q: usize, at: [f64; 2], before: Option<f64>) -> Course<[f64; 2]> {
        if self.newton >> q & 1 == 0 {
            return Course::Leaves;
        }
        let state = State { at, range: [0.0, 1.0, 0.0, 1.0] };
        let to = state.moved([self.step[0][q], self.step[1][q]], 1.0);
        let size = state.size(to);
        if size <= NO_STEP {
            Course::Stays
        } else if !(is_inside(to[0]) && is_inside(to[1])) {
            Course::Leaves
        } else if is_last(size, before) {
            Course::Lands(to)
        } else {
            Course::Goes(to, size)
        }
    }
}

impl CurveSteps {
    /// From the jets for the queries `p`.
    pub fn take(&mut self, jets: &SegmentJets, p: &[Row; 3], rational: bool, level: Level) {
        level.run(TakeCurve { jets, p, rational, out: self });
    }

    /// What lane `q` is worth.
    pub fn worth(&self, q: usize) -> Worth {
        [self.squared[q], self.gradient[q]]
    }

    /// Whether a step from a place worth `before` to the one of lane `q` is accepted.
    pub fn is_better(&self, q: usize, before: Worth) -> bool {
        super::curve::is_better(self.worth(q), before)
    }

    /// The course of lane `q` from its place, inside of the segment, after a step of size `before`.
    pub fn course(&self, q: usize, at: f64, before: Option<f64>) -> Course<f64> {
        if self.hessian[q].is_nan() || self.hessian[q] <= 0.0 {
            return Course::Leaves;
        }
        let to = (at - self.gradient[q] / self.hessian[q]).clamp(0.0, 1.0);
        let size = (to - at).abs();
        if size <= NO_STEP * to.abs() {
            Course::Stays
        } else if !is_inside(to) {
            Course::Leaves
        } else if is_last(size, before) {
            Course::Lands(to)
        } else {
            Course::Goes(to, size)
        }
    }
}

/// Whether a parameter is inside of its piece.
pub fn is_inside(x: f64) -> bool {
    0.0 < x && x < 1.0
}

#[inline(always)]
fn loaded<V: Lanes<WIDTH>>(p: &[Row; 3]) -> [V; 3] {
    [V::load(&p[0]), V::load(&p[1]), V::load(&p[2])]
}

#[inline(always)]
fn stored<V: Lanes<WIDTH>>(vector: [V; 3], out: &mut [Row; 3]) {
    for c in 0..3 {
        vector[c].store(&mut out[c]);
    }
}

struct TakeSurface<'a> {
    jets: &'a PatchJets,
    p: &'a [Row; 3],
    rational: bool,
    out: &'a mut SurfaceSteps,
}

impl Kernel for TakeSurface<'_> {
    type Out = ();

    #[inline(always)]
    fn run<S: Simd>(self, _: S) {
        let (jets, w) = self.jets.jets::<S::F8>(loaded(self.p), self.rational);
        let Products { squared, g, metric, hessian } = Products::new(jets);
        let step = solved(hessian, g);
        let [determinant, least] = determinant(hessian);
        let [square, most] = stride(metric, step, squared);
        let (zero, out) = (S::F8::splat(0.0), self.out);
        let definite = zero.less(hessian[0]) & zero.less(hessian[2]) & least.less(determinant);
        out.newton = definite & !most.less(square);
        for k in 0..3 {
            stored(jets[k], &mut out.jets[k]);
        }
        w.store(&mut out.w);
        squared.store(&mut out.squared);
        (steepness(g[0], metric[0]) + steepness(g[1], metric[2])).store(&mut out.steepness);
        step[0].store(&mut out.step[0]);
        step[1].store(&mut out.step[1]);
    }
}

struct TakeCurve<'a> {
    jets: &'a SegmentJets,
    p: &'a [Row; 3],
    rational: bool,
    out: &'a mut CurveSteps,
}

impl Kernel for TakeCurve<'_> {
    type Out = ();

    #[inline(always)]
    fn run<S: Simd>(self, _: S) {
        let ([d, s, ss], w) = self.jets.jets::<S::F8>(loaded(self.p), self.rational);
        let out = self.out;
        stored(d, &mut out.jets[0]);
        stored(s, &mut out.jets[1]);
        w.store(&mut out.w);
        dot(d, d).store(&mut out.squared);
        dot(d, s).store(&mut out.gradient);
        (dot(s, s) + dot(d, ss)).store(&mut out.hessian);
    }
}
