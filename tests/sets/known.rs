//! Closed forms: parameters of circles and meridians, polynomials in Bernstein form, zeros by scanning.

use footpoint::curve::Curve;
use footpoint::index::{IndexedCurve, IndexedSurface};
use footpoint::set::Nature;
use footpoint::surface::Surface;

use super::Wanted;
use crate::shapes::Vector;

/// Parameter in [0, 4) on the circle in four quarters of the direction (x, y).
pub fn turn([x, y]: [f64; 2]) -> f64 {
    let (quarter, x, y) = match (x > 0.0, y > 0.0) {
        (true, _) if y >= 0.0 => (0.0, x, y),
        (_, true) => (1.0, y, -x),
        (false, _) if x < 0.0 => (2.0, -x, -y),
        _ => (3.0, -y, x),
    };
    let t = y / (x.hypot(y) + x);
    let root = 2f64.sqrt();
    let s = root * t / (1.0 + (root - 1.0) * t);
    (quarter + s) % 4.0
}

/// Parameter in [0, 2] on the sphere's meridian from the south to the north of the direction (distance from the axis,
/// height).
pub fn rise([rho, z]: [f64; 2]) -> f64 {
    if rho == 0.0 && z > 0.0 { 2.0 } else { turn([-z, rho]) }
}

/// Bernstein coefficients of degree `n` on `[a, b]` of the power `t^k`.
pub fn power(k: usize, n: usize, [a, b]: [f64; 2]) -> Vec<f64> {
    let choose = |n: usize, k: usize| (0..k).fold(1.0, |c, i| c * (n - i) as f64 / (i + 1) as f64);
    // Blossom: the mean of all products of k of the n arguments, i of which are b.
    let of = |i: usize| {
        let terms = (0..=k.min(i)).filter(|j| k - j <= n - i);
        terms
            .map(|j| {
                choose(i, j) * choose(n - i, k - j) * b.powi(j as i32) * a.powi((k - j) as i32)
            })
            .sum::<f64>()
            / choose(n, k)
    };
    (0..=n).map(of).collect()
}

/// Bernstein coefficients of degree `n` of a polynomial given by its coefficients, the constant first.
pub fn bernstein(polynomial: &[f64], n: usize, range: [f64; 2]) -> Vec<f64> {
    let mut sum = vec![0.0; n + 1];
    for (k, c) in polynomial.iter().enumerate() {
        for (sum, x) in sum.iter_mut().zip(power(k, n, range)) {
            *sum += c * x;
        }
    }
    sum
}

fn clamped([a, b]: [f64; 2], degree: usize) -> Vec<f64> {
    [vec![a; degree + 1], vec![b; degree + 1]].concat()
}

/// A polynomial curve in the plane z = 0.
pub fn polynomial_curve(x: &[f64], y: &[f64], degree: usize, range: [f64; 2]) -> IndexedCurve {
    let (x, y) = (bernstein(x, degree, range), bernstein(y, degree, range));
    let poles: Vec<Vector> = x.iter().zip(&y).map(|(x, y)| [*x, *y, 0.0]).collect();
    IndexedCurve::new(Curve::new(&clamped(range, degree), degree, &poles, None).expect("a curve"))
}

/// t (1 - t^2) and t (1 - t^2)(1 - 4 t^2): a closed figure eight on [-1, 1] that crosses itself where it is closed.
pub const EIGHT: [[f64; 6]; 2] = [[0., 1., 0., -1., 0., 0.], [0., 1., 0., -5., 0., 4.]];

/// t^2 and t^3 - t: a loop that crosses itself at t = -1 and t = 1.
pub const LOOP: [[f64; 4]; 2] = [[0., 0., 1., 0.], [0., -1., 0., 1.]];

pub fn eight() -> IndexedCurve {
    polynomial_curve(&EIGHT[0], &EIGHT[1], 5, [-1.0, 1.0])
}

pub fn crossing_loop() -> IndexedCurve {
    polynomial_curve(&LOOP[0], &LOOP[1], 3, [-1.5, 1.25])
}

pub fn horner(polynomial: &[f64], t: f64) -> f64 {
    polynomial.iter().rev().fold(0.0, |sum, c| sum * t + c)
}

pub fn slope(polynomial: &[f64]) -> Vec<f64> {
    polynomial.iter().enumerate().skip(1).map(|(k, c)| k as f64 * c).collect()
}

/// Half width of the domain of `enneper`, inside the circle of radius 3 where it crosses itself twice at most.
pub const ENNEPER: f64 = 2.1;

/// Enneper's minimal surface, bicubic: x = u - u^3/3 + u v^2, y = v - v^3/3 + v u^2, z = u^2 - v^2.
pub fn enneper() -> IndexedSurface {
    let range = [-ENNEPER, ENNEPER];
    let p: Vec<Vec<f64>> = (0..4).map(|k| power(k, 3, range)).collect();
    let mut poles = Vec::new();
    for i in 0..4 {
        for j in 0..4 {
            poles.push([
                p[1][i] - p[3][i] / 3.0 + p[1][i] * p[2][j],
                p[1][j] - p[3][j] / 3.0 + p[1][j] * p[2][i],
                p[2][i] - p[2][j],
            ]);
        }
    }
    let knots = clamped(range, 3);
    let surface = Surface::new(&knots, &knots, 3, 3, &poles, 4, 4, None);
    IndexedSurface::new(surface.expect("a surface"))
}

/// Samples of `zeros`.
const SAMPLES: usize = 1_500;

/// Zeros of `f` on an interval with the sign of the slope; `None` when a double zero is too near to tell.
///
/// `scale` is the size of `f`; a local extremum of |f| below `least * scale` without a change of sign is doubtful.
pub fn zeros(
    f: impl Fn(f64) -> f64,
    [a, b]: [f64; 2],
    scale: f64,
    least: f64,
) -> Option<Vec<(f64, bool)>> {
    let at = |k: usize| a + (b - a) * k as f64 / SAMPLES as f64;
    let values: Vec<f64> = (0..=SAMPLES).map(|k| f(at(k))).collect();
    let mut found = Vec::new();
    for k in 0..SAMPLES {
        if (values[k] < 0.0) != (values[k + 1] < 0.0) {
            let rises = values[k] < 0.0;
            let (mut low, mut high) = (at(k), at(k + 1));
            while low < 0.5 * (low + high) && 0.5 * (low + high) < high {
                let middle = 0.5 * (low + high);
                if (f(middle) < 0.0) == rises { low = middle } else { high = middle }
            }
            found.push((high, rises));
        }
    }
    let is_bump = |k: usize| {
        let [x, y, z] = [values[k - 1], values[k], values[k + 1]];
        (y - x) * (z - y) <= 0.0 && y.abs() < least * scale
    };
    if (1..SAMPLES).any(is_bump) { None } else { Some(found) }
}

/// Stationary points of the distance on a plane polynomial curve; ends count unless it is closed. `None` near
/// double zeros.
pub fn on_plane_curve(
    x: &[f64],
    y: &[f64],
    range: [f64; 2],
    closed: bool,
    query: Vector,
) -> Option<Vec<Wanted>> {
    let (dx, dy) = (slope(x), slope(y));
    let g = |t: f64| {
        (horner(x, t) - query[0]) * horner(&dx, t) + (horner(y, t) - query[1]) * horner(&dy, t)
    };
    let distance =
        |t: f64| (horner(x, t) - query[0]).hypot(horner(y, t) - query[1]).hypot(query[2]);
    let found = zeros(g, range, 1.0 + distance(0.0), 1e-3)?;
    let nature = |rises: bool| if rises { Nature::Minimum } else { Nature::Maximum };
    let mut wanted: Vec<Wanted> = found
        .iter()
        .map(|&(t, rises)| Wanted::point([t, 0.0], nature(rises), distance(t)))
        .collect();
    for (t, sign) in [(range[0], 1.0), (range[1], -1.0)].into_iter().filter(|_| !closed) {
        if g(t).abs() < 1e-3 {
            return None;
        }
        wanted.push(Wanted::point([t, 0.0], nature(sign * g(t) > 0.0), distance(t)));
    }
    if closed && g(range[0]).abs() < 1e-3 {
        return None;
    }
    Some(wanted)
}
