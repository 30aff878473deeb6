//! Shapes whose feet are known in closed form, as NURBS: circles, ellipses and surfaces of revolution.

#![allow(dead_code, reason = "each test takes what it needs")]

use footpoint::curve::Curve;
use footpoint::index::{IndexedCurve, IndexedSurface};
use footpoint::surface::Surface;

pub type Vector = [f64; 3];

/// Knots of the circle in four quarters, each a span of length 1.
pub const CIRCLE_KNOTS: [f64; 12] = [0., 0., 0., 1., 1., 2., 2., 3., 3., 4., 4., 4.];

/// Poles (x, y) and weights of the unit circle in nine poles.
pub fn unit_circle() -> [([f64; 2], f64); 9] {
    let r = 0.5f64.sqrt();
    [
        ([1., 0.], 1.),
        ([1., 1.], r),
        ([0., 1.], 1.),
        ([-1., 1.], r),
        ([-1., 0.], 1.),
        ([-1., -1.], r),
        ([0., -1.], 1.),
        ([1., -1.], r),
        ([1., 0.], 1.),
    ]
}

/// The ellipse with half axes a (x) and b (y) around the origin, in the plane z = 0.
pub fn ellipse(a: f64, b: f64) -> IndexedCurve {
    let circle = unit_circle();
    let poles: Vec<Vector> = circle.iter().map(|(p, _)| [a * p[0], b * p[1], 0.0]).collect();
    let weights: Vec<f64> = circle.iter().map(|c| c.1).collect();
    IndexedCurve::new(Curve::new(&CIRCLE_KNOTS, 2, &poles, Some(&weights)).expect("an ellipse"))
}

/// The circle run through twice: two turns over [0, 8].
pub fn double_circle(radius: f64) -> IndexedCurve {
    let circle = unit_circle();
    let twice = || circle.iter().chain(&circle[1..]);
    let poles: Vec<Vector> = twice().map(|(p, _)| [radius * p[0], radius * p[1], 0.0]).collect();
    let weights: Vec<f64> = twice().map(|c| c.1).collect();
    let mut knots = vec![0.0; 3];
    (1..8).for_each(|k| knots.extend([k as f64; 2]));
    knots.extend([8.0; 3]);
    IndexedCurve::new(Curve::new(&knots, 2, &poles, Some(&weights)).expect("two turns"))
}

/// A meridian in the plane (distance from the axis, height), with weights, turned around the z axis: u is the angle.
pub fn turned(knots: &[f64], degree: usize, meridian: &[([f64; 2], f64)]) -> IndexedSurface {
    let (mut poles, mut weights) = (Vec::new(), Vec::new());
    for (c, w) in unit_circle() {
        for ([r, z], x) in meridian {
            poles.push([r * c[0], r * c[1], *z]);
            weights.push(w * x);
        }
    }
    let surface =
        Surface::new(&CIRCLE_KNOTS, knots, 2, degree, &poles, 9, meridian.len(), Some(&weights));
    IndexedSurface::new(surface.expect("a surface of revolution"))
}

/// The sphere around the origin: v from the south pole (0) over the equator (1) to the north pole (2).
pub fn sphere(radius: f64) -> IndexedSurface {
    let r = 0.5f64.sqrt();
    let half: Vec<([f64; 2], f64)> =
        [([0., -1.], 1.), ([1., -1.], r), ([1., 0.], 1.), ([1., 1.], r), ([0., 1.], 1.)]
            .map(|([x, z], w)| ([radius * x, radius * z], w))
            .to_vec();
    turned(&[0., 0., 0., 1., 1., 2., 2., 2.], 2, &half)
}

/// The torus around the z axis.
pub fn torus(large: f64, small: f64) -> IndexedSurface {
    let ring: Vec<([f64; 2], f64)> =
        unit_circle().map(|([x, z], w)| ([large + small * x, small * z], w)).to_vec();
    turned(&CIRCLE_KNOTS, 2, &ring)
}

/// The cylinder around the z axis from z = 0 to z = height.
pub fn cylinder(radius: f64, height: f64) -> IndexedSurface {
    turned(&[0., 0., 1., 1.], 1, &[([radius, 0.], 1.), ([radius, height], 1.)])
}

/// The cone with its tip at the origin (v = 0), opening upwards to a circle of this radius at this height.
pub fn cone(radius: f64, height: f64) -> IndexedSurface {
    turned(&[0., 0., 1., 1.], 1, &[([0., 0.], 1.), ([radius, height], 1.)])
}

/// Numbers in [0, 1) from a seed, the same on every system.
pub struct Random(pub u64);

impl Random {
    pub fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut x = self.0;
        x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((x ^ (x >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }

    pub fn point(&mut self, size: f64) -> Vector {
        [self.between(-size, size), self.between(-size, size), self.between(-size, size)]
    }
}

pub fn norm(a: Vector) -> f64 {
    (a[0] * a[0] + a[1] * a[1] + a[2] * a[2]).sqrt()
}

pub fn sub(a: Vector, b: Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}
