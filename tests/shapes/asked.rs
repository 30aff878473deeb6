//! A shape of either kind, asked for its nearest points.

use footpoint::closest::{FootPoint, QueryOptions, Workspace};
use footpoint::index::{IndexedCurve, IndexedSurface};

use super::{EPS, FAMILIES, Random, Vector, curve, extent, norm, samples, sub, surface};

/// The shape under test with what the laws need of it.
pub enum Shape {
    Curve(IndexedCurve),
    Surface(IndexedSurface),
}

impl Shape {
    pub fn new(family: usize, seed: u64) -> Self {
        let family = &FAMILIES[family];
        if seed.is_multiple_of(2) {
            Self::Curve(IndexedCurve::new(curve(family, seed)))
        } else {
            Self::Surface(IndexedSurface::new(surface(family, seed)))
        }
    }

    pub fn evaluate(&self, [u, v]: [f64; 2]) -> Vector {
        match self {
            Self::Curve(curve) => curve.curve().evaluate(u),
            Self::Surface(surface) => surface.surface().evaluate(u, v),
        }
    }

    /// u0, u1, v0, v1; curves: v is 0.
    pub fn domain(&self) -> [f64; 4] {
        match self {
            Self::Curve(curve) => {
                let (u0, u1) = curve.curve().domain();
                [u0, u1, 0.0, 0.0]
            }
            Self::Surface(surface) => surface.surface().domain(),
        }
    }

    pub fn bounding_box(&self) -> (Vector, Vector) {
        match self {
            Self::Curve(curve) => curve.curve().bounding_box(),
            Self::Surface(surface) => surface.surface().bounding_box(),
        }
    }

    pub fn diagonal(&self) -> f64 {
        extent(self.bounding_box()).0
    }

    pub fn degrees(&self) -> usize {
        match self {
            Self::Curve(curve) => curve.curve().degree(),
            Self::Surface(surface) => {
                surface.surface().knots_u().degree() + surface.surface().knots_v().degree()
            }
        }
    }

    /// A grid over the spans, all knots in it.
    pub fn samples(&self) -> Vec<[f64; 2]> {
        self.samples_of(if matches!(self, Self::Curve(_)) { 40 } else { 12 })
    }

    /// The same with `per_span` places in each span and direction.
    pub fn samples_of(&self, per_span: usize) -> Vec<[f64; 2]> {
        match self {
            Self::Curve(curve) => {
                let us = samples(curve.curve().knots(), per_span);
                us.into_iter().map(|u| [u, 0.0]).collect()
            }
            Self::Surface(surface) => {
                let vs = samples(surface.surface().knots_v(), per_span);
                let us = samples(surface.surface().knots_u(), per_span);
                us.into_iter().flat_map(|u| vs.iter().map(move |v| [u, *v])).collect()
            }
        }
    }

    pub fn ask(&self, query: Vector, hint: Option<[f64; 2]>, options: &QueryOptions) -> FootPoint {
        self.ask_with(query, hint, options, &mut Workspace::default())
    }

    pub fn ask_with(
        &self,
        query: Vector,
        hint: Option<[f64; 2]>,
        options: &QueryOptions,
        workspace: &mut Workspace,
    ) -> FootPoint {
        match self {
            Self::Curve(curve) => {
                curve.closest(query, hint.map(|h| h[0]), options, workspace, None)
            }
            Self::Surface(surface) => surface.closest(query, hint, options, workspace, None),
        }
    }

    /// A parameter pair anywhere; often an end.
    pub fn place(&self, r: &mut Random) -> [f64; 2] {
        let [u0, u1, v0, v1] = self.domain();
        let mut pick = |a: f64, b: f64| match r.whole(0, 9) {
            0 => a,
            1 => b,
            _ => r.between(a, b).clamp(a, b),
        };
        [pick(u0, u1), pick(v0, v1)]
    }

    pub fn query(&self, r: &mut Random) -> Vector {
        let on = self.evaluate(self.place(r));
        super::query(self.bounding_box(), on, r)
    }

    /// What evaluation and the norm may be off by.
    pub fn rounding(&self, query: Vector, distance: f64) -> f64 {
        let (diagonal, magnitude) = extent(self.bounding_box());
        let largest = query.iter().fold(magnitude, |m, x| m.max(x.abs()));
        EPS * ((self.degrees() + 4) as f64 * diagonal + 4.0 * (largest + distance))
    }

    /// What the step from one parameter to the next moves the point: feet cannot be nearer than the parameters'
    /// own grain allows.
    pub fn grain(&self, foot: &FootPoint) -> f64 {
        let [u0, u1, v0, v1] = self.domain();
        let next = |x: f64, last: f64| if x < last { x.next_up() } else { x.next_down() };
        let in_u = self.evaluate([next(foot.u, u1).max(u0), foot.v]);
        let in_v = self.evaluate([foot.u, if v0 < v1 { next(foot.v, v1) } else { 0.0 }]);
        norm(sub(in_u, foot.point)) + norm(sub(in_v, foot.point))
    }

    /// What two certified answers may differ by.
    pub fn gap(&self, query: Vector, distance: f64) -> f64 {
        1e-10 * self.diagonal() + 100.0 * self.rounding(query, distance)
    }
}

pub fn apart(query: Vector, point: Vector) -> f64 {
    norm(sub(query, point))
}

/// All bits of an answer.
pub fn bits(foot: &FootPoint) -> [u64; 9] {
    let [x, y, z] = foot.point.map(f64::to_bits);
    let [u, v] = [foot.u, foot.v].map(f64::to_bits);
    let [distance, bound] = [foot.distance, foot.lower_bound].map(f64::to_bits);
    [u, v, x, y, z, distance, bound, foot.flags.into(), foot.iterations.into()]
}
