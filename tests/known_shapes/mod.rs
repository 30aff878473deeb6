//! Shapes whose distances, sides and normals are known by formula.
#![allow(dead_code, reason = "each test takes what it needs")]

use footpoint::curve::Curve;
use footpoint::index::{IndexedCurve, IndexedSurface};
use footpoint::surface::Surface;

pub type Vector = [f64; 3];

pub fn sub(a: Vector, b: Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

pub fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub fn norm(a: Vector) -> f64 {
    dot(a, a).sqrt()
}

/// A 64-bit congruential generator.
pub struct Random(pub u64);

impl Random {
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        low + (high - low) * ((self.0 >> 11) as f64 / 9007199254740992.0)
    }

    pub fn point(&mut self, reach: f64) -> Vector {
        [0, 1, 2].map(|_| self.between(-reach, reach))
    }
}

/// Knots of a full circle over `start .. start + length`, and its poles with weights, radius 1, starting on the x axis.
pub fn circle_parts(start: f64, length: f64) -> (Vec<f64>, Vec<([f64; 2], f64)>) {
    let c = 0.5f64.sqrt();
    let ring =
        [(1., 0.), (1., 1.), (0., 1.), (-1., 1.), (-1., 0.), (-1., -1.), (0., -1.), (1., -1.)];
    let ring = ring.into_iter().chain([(1., 0.)]).enumerate();
    let poles = ring.map(|(i, (x, y))| ([x, y], if i % 2 == 0 { 1.0 } else { c })).collect();
    let knots = [0., 0., 0., 1., 1., 2., 2., 3., 3., 4., 4., 4.];
    (knots.iter().map(|k| start + length * k / 4.0).collect(), poles)
}

pub fn circle(start: f64, length: f64, radius: f64) -> IndexedCurve {
    let (knots, parts) = circle_parts(start, length);
    let poles: Vec<Vector> =
        parts.iter().map(|(p, _)| [radius * p[0], radius * p[1], 0.0]).collect();
    let weights: Vec<f64> = parts.iter().map(|(_, w)| *w).collect();
    IndexedCurve::new(Curve::new(&knots, 2, &poles, Some(&weights)).unwrap())
}

/// A meridian (radius, z, weight) turned about the z axis; u goes round over `start .. start + length`.
pub fn turned(
    [start, length]: [f64; 2],
    knots_v: &[f64],
    degree_v: usize,
    meridian: &[(f64, f64, f64)],
) -> IndexedSurface {
    let (knots_u, ring) = circle_parts(start, length);
    let (mut poles, mut weights) = (Vec::new(), Vec::new());
    for ([x, y], w) in ring {
        for (radius, z, weight) in meridian {
            poles.push([radius * x, radius * y, *z]);
            weights.push(w * weight);
        }
    }
    let count = meridian.len();
    let made =
        Surface::new(&knots_u, knots_v, 2, degree_v, &poles, 9, count, Some(&weights)).unwrap();
    IndexedSurface::new(made)
}

const HALF: [f64; 8] = [0., 0., 0., 1., 1., 2., 2., 2.];

/// The unit sphere, south pole at v = 0, north pole at v = 2.
pub fn sphere(u: [f64; 2]) -> IndexedSurface {
    let c = 0.5f64.sqrt();
    let half = [(0., -1., 1.), (1., -1., c), (1., 0., 1.), (1., 1., c), (0., 1., 1.)];
    turned(u, &HALF, 2, &half)
}

/// Radii 2 and 0.5; v round the tube.
pub fn torus() -> IndexedSurface {
    let (knots_v, ring) = circle_parts(0.0, 4.0);
    let meridian: Vec<_> = ring.iter().map(|([x, z], w)| (2.0 + 0.5 * x, 0.5 * z, *w)).collect();
    turned([0.0, 4.0], &knots_v, 2, &meridian)
}

/// Open at both ends, radius 1, z = -1 .. 1 over v = 0 .. 1.
pub fn cylinder(u: [f64; 2]) -> IndexedSurface {
    turned(u, &[0., 0., 1., 1.], 1, &[(1., -1., 1.), (1., 1., 1.)])
}

/// Degree 1 along a meridian.
pub fn turned_polygon(meridian: &[[f64; 2]]) -> IndexedSurface {
    let meridian: Vec<_> = meridian.iter().map(|[r, z]| (*r, *z, 1.0)).collect();
    let last = meridian.len() - 1;
    let knots: Vec<f64> =
        std::iter::once(0).chain(0..=last).chain([last]).map(|k| k as f64).collect();
    turned([0.0, 4.0], &knots, 1, &meridian)
}

/// A closed polyhedron of bilinear patches: rows of as many points each, the first and the last row a single point;
/// rows go round against the clock seen from the last one.
pub fn polyhedron(rows: &[Vec<Vector>]) -> IndexedSurface {
    let (around, up) = (rows[0].len(), rows.len());
    let mut poles = Vec::new();
    for i in 0..=around {
        for row in rows {
            poles.push(row[i % around]);
        }
    }
    let knots = |count: usize| -> Vec<f64> {
        let last = count - 1;
        std::iter::once(0).chain(0..=last).chain([last]).map(|k| k as f64).collect()
    };
    let made = Surface::new(&knots(around + 1), &knots(up), 1, 1, &poles, around + 1, up, None);
    IndexedSurface::new(made.unwrap())
}

/// A polygon between z = 0 and z = height, with caps that meet at `center`.
pub fn prism(polygon: &[[f64; 2]], center: [f64; 2], height: f64) -> IndexedSurface {
    let row = |z: f64| polygon.iter().map(|[x, y]| [*x, *y, z]).collect::<Vec<_>>();
    let tip = |z: f64| vec![[center[0], center[1], z]; polygon.len()];
    polyhedron(&[tip(0.0), row(0.0), row(height), tip(height)])
}

/// Signed distance to a polygon in the plane.
pub fn polygon_distance(polygon: &[[f64; 2]], p: [f64; 2]) -> f64 {
    let (mut best, mut inside) = (f64::INFINITY, false);
    for (i, a) in polygon.iter().enumerate() {
        let b = polygon[(i + 1) % polygon.len()];
        let (e, w) = ([b[0] - a[0], b[1] - a[1]], [p[0] - a[0], p[1] - a[1]]);
        let share = ((e[0] * w[0] + e[1] * w[1]) / (e[0] * e[0] + e[1] * e[1])).clamp(0.0, 1.0);
        best = best.min((w[0] - share * e[0]).hypot(w[1] - share * e[1]));
        if (a[1] > p[1]) != (b[1] > p[1]) && p[0] < a[0] + e[0] * (p[1] - a[1]) / e[1] {
            inside = !inside;
        }
    }
    if inside { -best } else { best }
}

/// Signed distance to a prism.
pub fn prism_distance(polygon: &[[f64; 2]], height: f64, p: Vector) -> f64 {
    let flat = polygon_distance(polygon, [p[0], p[1]]);
    let up = (p[2] - 0.5 * height).abs() - 0.5 * height;
    if flat < 0.0 && up < 0.0 { flat.max(up) } else { flat.max(0.0).hypot(up.max(0.0)) }
}

/// Signed distance to the solid of a turned polygon whose ends lie on the axis.
pub fn turned_distance(meridian: &[[f64; 2]], p: Vector) -> f64 {
    let mirrored = meridian.iter().rev().map(|[r, z]| [-r, *z]);
    let polygon: Vec<[f64; 2]> =
        meridian.iter().copied().chain(mirrored.filter(|[r, _]| *r != 0.0)).collect();
    polygon_distance(&polygon, [p[0].hypot(p[1]), p[2]])
}

/// The figure eight (sin t, sin 2t / 2) as a periodic cubic through many points; closed, crossing itself at the origin.
pub fn figure_eight(count: usize) -> IndexedCurve {
    let at = |i: usize| {
        let t = std::f64::consts::TAU * (i % count) as f64 / count as f64;
        [t.sin(), 0.5 * (2.0 * t).sin(), 0.0]
    };
    let poles: Vec<Vector> = (0..count + 3).map(at).collect();
    let knots: Vec<f64> = (0..count + 7).map(|k| k as f64).collect();
    IndexedCurve::new(Curve::new(&knots, 3, &poles, None).unwrap())
}
