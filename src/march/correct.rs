//! Correctors by name: from a place near both surfaces to a point of the intersection.
//!
//! ```text
//!   Newton, three    one parameter held, three equations in three: a point on an isoline; fails where the isoline misses the curve
//!   Newton, four     all move by the shortest step in space: the nearest point of the curve, to first order
//!   MAF              ball transform: feet X, Y of P on both; midpoint transform: feet of X and Y on the line in which the tangent
//!                    planes meet, their middle is the next P; parallel planes: the middle of X and Y
//! ```
//!
//! Parameters that would leave the domain are held at the border that they meet, and the step is made again without them: a clamped full
//! step has false ends. Fast and allowed to fail: failure is reported by `None`, never by a wrong place.

use super::contact::{foot, in_tangent_plane, into_domain, second};
use super::shape::Shape;
use super::system::{inverse, others};
use crate::bounds::{Vector, add, cross, dot, norm, scaled, sub};

/// Steps after which an iteration counts as failed.
const MOST_STEPS: u32 = 50;

/// A step to a border, in steps that do without: the border runs along the curve, if it takes more.
const ALONG: f64 = 64.0;

/// The method of a correction.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Corrector {
    /// Newton with all four parameters, and with three where one is held at a border.
    #[default]
    Auto,
    /// Newton with this parameter held: 0 to 3 for u, v, s, t.
    NewtonThree(usize),
    /// Newton with four parameters, minimum norm in space.
    NewtonFour,
    /// Moving affine frame: ball and midpoint transforms.
    Maf,
}

/// Called with (step, u, v, s, t as an array, gap): every iterate, step 0 is the start.
pub type Trace<'a> = &'a mut dyn FnMut(u32, [f64; 4], f64);

/// A corrected place.
#[derive(Clone, Copy, Debug)]
pub struct Corrected {
    /// u, v, s, t.
    pub at: [f64; 4],
    /// Distance between the two surface points.
    pub gap: f64,
    /// Iterations.
    pub steps: u32,
}

fn gap(a: &dyn Shape, b: &dyn Shape, at: [f64; 4]) -> Vector {
    sub(a.evaluate(at[0], at[1]), b.evaluate(at[2], at[3]))
}

/// Moves `start` onto both surfaces until the gap is at most `tolerance` and the steps are rounding; `None` when that fails.
pub fn correct(
    a: &dyn Shape,
    b: &dyn Shape,
    start: [f64; 4],
    method: Corrector,
    tolerance: f64,
    mut trace: Option<Trace>,
) -> Option<Corrected> {
    let ([u, v], [s, t]) =
        (into_domain(a, [start[0], start[1]]), into_domain(b, [start[2], start[3]]));
    let mut at = [u, v, s, t];
    let mut point = scaled(add(a.evaluate(u, v), b.evaluate(s, t)), 0.5);
    let mut last = f64::INFINITY;
    for steps in 0..=MOST_STEPS {
        let g = norm(gap(a, b, at));
        if let Some(tell) = &mut trace {
            tell(steps, at, g);
        }
        // Quadratic at the end: what is below the tolerance and gets no smaller is the last digit.
        if g <= tolerance && g >= 0.25 * last || g == 0.0 {
            return Some(Corrected { at, gap: g, steps });
        }
        last = g;
        at = match method {
            Corrector::Maf => maf_step(a, b, at, &mut point),
            Corrector::NewtonThree(held) => newton(a, b, at, Some(held))?,
            _ => newton(a, b, at, None)?,
        };
    }
    None
}

/// One ball transform and one midpoint transform.
fn maf_step(a: &dyn Shape, b: &dyn Shape, at: [f64; 4], point: &mut Vector) -> [f64; 4] {
    let uv = foot(a, [at[0], at[1]], *point);
    let st = foot(b, [at[2], at[3]], *point);
    let (p, q) = (second(a, uv), second(b, st));
    let (n, m) = (cross(p[1], p[2]), cross(q[1], q[2]));
    let along = cross(n, m);
    let (x, y) = (p[0], q[0]);
    let parallel = norm(along) <= 1e-9 * norm(n) * norm(m);
    let feet = (!parallel).then(|| on_both_planes((x, n), (y, m), along)).flatten();
    *point = match feet {
        Some(origin) => {
            let d = scaled(along, 1.0 / norm(along));
            let on_line = |z: Vector| add(origin, scaled(d, dot(sub(z, origin), d)));
            scaled(add(on_line(x), on_line(y)), 0.5)
        }
        None => scaled(add(x, y), 0.5),
    };
    [uv[0], uv[1], st[0], st[1]]
}

/// A point on two planes.
fn on_both_planes(
    (x, n): (Vector, Vector),
    (y, m): (Vector, Vector),
    along: Vector,
) -> Option<Vector> {
    let middle = scaled(add(x, y), 0.5);
    // Rows n, m, along: the inverse of the matrix with these columns, transposed, is applied.
    let rows = inverse([n, m, along])?;
    let right = [dot(n, sub(x, middle)), dot(m, sub(y, middle)), 0.0];
    let step = [0, 1, 2].map(|k| (0..3).map(|i| rows[i][k] * right[i]).sum::<f64>());
    Some(add(middle, step))
}

/// A Newton step with one parameter held, or with none: then the shortest in space. Borders hold what would leave.
fn newton(a: &dyn Shape, b: &dyn Shape, at: [f64; 4], held: Option<usize>) -> Option<[f64; 4]> {
    let (mut p, mut q) = ([[0.0; 3]; 3], [[0.0; 3]; 3]);
    a.partials(at[0], at[1], 1, &mut p);
    b.partials(at[2], at[3], 1, &mut q);
    let f = sub(p[0], q[0]);
    let columns = [p[1], p[2], scaled(q[1], -1.0), scaled(q[2], -1.0)];
    let three = |k: usize| {
        let o = others(k);
        let rows = inverse(o.map(|c| columns[c]))?;
        let mut step = [0.0; 4];
        for i in 0..3 {
            step[o[i]] = -dot(rows[i], f);
        }
        Some(step)
    };
    let step = match held {
        Some(k) => three(k)?,
        None => shortest(&columns, f)?,
    };
    let (da, db) = (a.domain(), b.domain());
    let ends = [[da[0], da[1]], [da[2], da[3]], [db[0], db[1]], [db[2], db[3]]];
    let leaves = |x: f64, k: usize| x < ends[k][0] || x > ends[k][1];
    let out = (0..4).find(|&k| leaves(at[k] + step[k], k));
    let length = |step: &[f64; 4]| {
        let of =
            |k: usize| norm(add(scaled(columns[k], step[k]), scaled(columns[k + 1], step[k + 1])));
        of(0).max(of(2))
    };
    let free = length(&step);
    let step = match out {
        // The border that is met holds its parameter; the others meet it there.
        Some(k) if held.is_none() => {
            let border = (at[k] + step[k]).clamp(ends[k][0], ends[k][1]);
            let moved = border - at[k];
            let o = others(k);
            let f = add(f, scaled(columns[k], moved));
            let held = inverse(o.map(|c| columns[c])).map(|rows| {
                let mut step = [0.0; 4];
                step[k] = moved;
                for i in 0..3 {
                    step[o[i]] = -dot(rows[i], f);
                }
                step
            });
            // A curve that runs along the border leaves it by rounding alone, and the border does not cut it anywhere.
            held.filter(|held| length(held) <= ALONG * free).unwrap_or(step)
        }
        _ => step,
    };
    Some([0, 1, 2, 3].map(|k| (at[k] + step[k]).clamp(ends[k][0], ends[k][1])))
}

/// The step of four parameters that makes the linear gap vanish and moves the two points least.
fn shortest(columns: &[Vector; 4], f: Vector) -> Option<[f64; 4]> {
    let frame = |x: Vector, y: Vector| {
        let e = scaled(x, 1.0 / norm(x));
        let rest = sub(y, scaled(e, dot(e, y)));
        [e, scaled(rest, 1.0 / norm(rest))]
    };
    let ([e0, e1], [f0, f1]) = (frame(columns[0], columns[1]), frame(columns[2], columns[3]));
    let all = [e0, e1, f0, f1];
    // J J^T is symmetric; its columns are combinations of the four unit vectors.
    let column = |k: usize| all.iter().fold([0.0; 3], |sum, v| add(sum, scaled(*v, v[k])));
    let rows = inverse([column(0), column(1), column(2)])?;
    let y = [0, 1, 2].map(|k| -(0..3).map(|i| rows[k][i] * f[i]).sum::<f64>());
    let move_a = add(scaled(e0, dot(e0, y)), scaled(e1, dot(e1, y)));
    let move_b = add(scaled(f0, dot(f0, y)), scaled(f1, dot(f1, y)));
    let [u, v] = in_tangent_plane(columns[0], columns[1], move_a)?;
    let [s, t] = in_tangent_plane(columns[2], columns[3], move_b)?;
    [u, v, s, t].iter().all(|x| x.is_finite()).then_some([u, v, s, t])
}
