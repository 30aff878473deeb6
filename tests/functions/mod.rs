//! Shapes given by functions, for the tests: trigonometric ones with exact bounds, and offsets of splines.
#![allow(dead_code, reason = "each test program uses a part")]

use crate::shapes::{Vector, along, cross, dot, norm};
use footpoint::callback::{CallbackCurve, CallbackSurface, CurveBounds, SurfaceBounds};
use footpoint::surface::Surface;
use std::f64::consts::{FRAC_1_SQRT_2 as HALF, PI, TAU};

/// Radii of the torus: of its axis and of its tube.
pub const RADII: [f64; 2] = [3.0, 1.25];

/// The torus about the z axis, which delivers `orders`.
pub fn torus(orders: usize, bounds: SurfaceBounds) -> CallbackSurface {
    let [big, small] = RADII;
    let function = move |u: f64, v: f64, order: usize, out: &mut [Vector; 6]| {
        let ((su, cu), (sv, cv)) = (u.sin_cos(), v.sin_cos());
        let (w, wv) = (big + small * cv, -small * sv);
        out[0] = [w * cu, w * su, small * sv];
        if order.min(orders) >= 1 {
            out[1] = [-w * su, w * cu, 0.0];
            out[2] = [wv * cu, wv * su, small * cv];
        }
        if order.min(orders) >= 2 {
            out[3] = [-w * cu, -w * su, 0.0];
            out[4] = [-wv * su, wv * cu, 0.0];
            out[5] = [-small * cv * cu, -small * cv * su, -small * sv];
        }
        Some(orders)
    };
    CallbackSurface::new([0.0, TAU, 0.0, TAU], bounds, function).unwrap()
}

pub fn torus_bounds() -> SurfaceBounds {
    let [big, small] = RADII;
    SurfaceBounds { speed: Some([big + small, small]), second: Some([big + small, small, small]) }
}

pub fn torus_distance(q: Vector) -> f64 {
    let [big, small] = RADII;
    ((q[0].hypot(q[1]) - big).hypot(q[2]) - small).abs()
}

/// The sphere about the origin by longitude and latitude, first derivatives given.
pub fn sphere(radius: f64, known: bool) -> CallbackSurface {
    let function = move |u: f64, v: f64, _: usize, out: &mut [Vector; 6]| {
        let ((su, cu), (sv, cv)) = (u.sin_cos(), v.sin_cos());
        out[0] = [cv * cu, cv * su, sv].map(|x| radius * x);
        out[1] = [-cv * su, cv * cu, 0.0].map(|x| radius * x);
        out[2] = [-sv * cu, -sv * su, cv].map(|x| radius * x);
        Some(1)
    };
    let bounds =
        SurfaceBounds { speed: known.then_some([radius; 2]), second: known.then_some([radius; 3]) };
    CallbackSurface::new([0.0, TAU, -0.5 * PI, 0.5 * PI], bounds, function).unwrap()
}

/// The unit square in the plane z = 0.
pub fn plane(known: bool) -> CallbackSurface {
    let function = |u: f64, v: f64, _: usize, out: &mut [Vector; 6]| {
        *out = [[0.0; 3]; 6];
        (out[0], out[1], out[2]) = ([u, v, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]);
        Some(2)
    };
    let bounds = SurfaceBounds { speed: None, second: known.then_some([0.0; 3]) };
    CallbackSurface::new([0.0, 1.0, 0.0, 1.0], bounds, function).unwrap()
}

/// The segment from the origin to (1, 0, 0).
pub fn line() -> CallbackCurve {
    let function = |u: f64, _: usize, out: &mut [Vector; 3]| {
        *out = [[u, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0; 3]];
        Some(2)
    };
    let bounds = CurveBounds { speed: Some(1.0), second: Some(0.0) };
    CallbackCurve::new([0.0, 1.0], bounds, function).unwrap()
}

/// A circle in the plane z = 0, run through up to the angle `end`.
pub fn ring(radius: f64, end: f64, known: bool) -> CallbackCurve {
    let function = move |u: f64, _: usize, out: &mut [Vector; 3]| {
        let (s, c) = u.sin_cos();
        out[0] = [radius * c, radius * s, 0.0];
        out[1] = [-radius * s, radius * c, 0.0];
        Some(1)
    };
    let bounds = CurveBounds { speed: None, second: known.then_some(radius) };
    CallbackCurve::new([0.0, end], bounds, function).unwrap()
}

/// The lemniscate (cos u, sin u cos u), which crosses itself in the origin at pi/2 and 3 pi/2.
pub fn figure_eight() -> CallbackCurve {
    let function = |u: f64, _: usize, out: &mut [Vector; 3]| {
        let (s, c) = u.sin_cos();
        out[0] = [c, s * c, 0.0];
        out[1] = [-s, c * c - s * s, 0.0];
        Some(1)
    };
    // |C''| = |(-cos u, -2 sin 2u)|.
    let bounds = CurveBounds { speed: Some(1.5), second: Some(5f64.sqrt()) };
    CallbackCurve::new([0.0, TAU], bounds, function).unwrap()
}

/// The curve at a distance outside an ellipse; points only.
pub fn ellipse_offset(a: f64, b: f64, distance: f64, known: bool) -> CallbackCurve {
    let point = move |u: f64| {
        let (s, c) = u.sin_cos();
        let size = (b * c).hypot(a * s);
        [a * c + distance * b * c / size, b * s + distance * a * s / size, 0.0]
    };
    let function = move |u: f64, _: usize, out: &mut [Vector; 3]| {
        out[0] = point(u);
        Some(0)
    };
    let sampled = || {
        let h = 1e-4;
        let second = |u: f64| {
            let [x, y, z] = [point(u - h), point(u), point(u + h)];
            norm([0, 1, 2].map(|k| x[k] - 2.0 * y[k] + z[k])) / (h * h)
        };
        1.05 * (0..4000).map(|i| second(TAU / 4000.0 * f64::from(i))).fold(0.0, f64::max)
    };
    let bounds = CurveBounds { speed: None, second: known.then(sampled) };
    CallbackCurve::new([0.0, TAU], bounds, function).unwrap()
}

/// The torus with tube radius 1 as a rational spline of quadrants.
pub fn spline_torus() -> Surface {
    let ring = [
        [1., 0.],
        [1., 1.],
        [0., 1.],
        [-1., 1.],
        [-1., 0.],
        [-1., -1.],
        [0., -1.],
        [1., -1.],
        [1., 0.],
    ];
    let knots = [0., 0., 0., 1., 1., 2., 2., 3., 3., 4., 4., 4.];
    let weight = |i: usize| if i % 2 == 1 { HALF } else { 1.0 };
    let (mut poles, mut weights) = (Vec::new(), Vec::new());
    for (i, [x, y]) in ring.iter().enumerate() {
        for (j, [r, z]) in ring.iter().enumerate() {
            poles.push([(RADII[0] + r) * x, (RADII[0] + r) * y, *z]);
            weights.push(weight(i) * weight(j));
        }
    }
    Surface::new(&knots, &knots, 2, 2, &poles, 9, 9, Some(&weights)).unwrap()
}

/// z = x^2 + y^2 over the square [-1, 1]^2, with the normal up.
pub fn paraboloid() -> Surface {
    let knots = [-1., -1., -1., 1., 1., 1.];
    let (line, square) = ([-1.0, 0.0, 1.0], [1.0, -1.0, 1.0]);
    let poles: Vec<Vector> =
        (0..9).map(|k| [line[k / 3], line[k % 3], square[k / 3] + square[k % 3]]).collect();
    Surface::new(&knots, &knots, 2, 2, &poles, 3, 3, None).unwrap()
}

/// The surface at a distance along the normals of a spline, with 0 or 1 orders; `known`: with bounds from samples.
pub fn spline_offset(base: &Surface, distance: f64, orders: usize, known: bool) -> CallbackSurface {
    let domain = base.domain();
    let make = |bounds| {
        let base = base.clone();
        let function = move |u: f64, v: f64, order: usize, out: &mut [Vector; 6]| {
            let mut jet = [[0.0; 3]; 6];
            base.partials(u, v, 1 + order.min(orders), &mut jet);
            let [point, s, t, ss, st, tt] = jet;
            let normal = cross(s, t);
            let size = norm(normal);
            let n = normal.map(|x| x / size);
            out[0] = along(point, n, distance);
            if order.min(orders) >= 1 {
                let turn = |a: Vector, b: Vector| {
                    let raw = along(cross(a, t), cross(s, b), 1.0).map(|x| x / size);
                    along(raw, n, -dot(raw, n))
                };
                out[1] = along(s, turn(ss, st), distance);
                out[2] = along(t, turn(st, tt), distance);
            }
            Some(orders)
        };
        CallbackSurface::new(domain, bounds, function).unwrap()
    };
    let plain = make(SurfaceBounds::default());
    if known {
        make(SurfaceBounds { speed: None, second: Some(greatest(&plain).map(|x| 1.1 * x)) })
    } else {
        plain
    }
}

/// Greatest second derivatives of samples.
pub fn greatest(shape: &CallbackSurface) -> [f64; 3] {
    let [u0, u1, v0, v1] = shape.domain();
    let mut most = [0.0f64; 3];
    for k in 0..101 * 101 {
        let at =
            [u0 + (u1 - u0) * (k % 101) as f64 / 100.0, v0 + (v1 - v0) * (k / 101) as f64 / 100.0];
        let mut jet = [[0.0; 3]; 6];
        assert!(shape.partials(at[0].min(u1), at[1].min(v1), 2, &mut jet));
        for i in 0..3 {
            most[i] = most[i].max(norm(jet[3 + i]));
        }
    }
    most
}
