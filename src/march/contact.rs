//! Where two surfaces touch: the place near a start at which the gap between them is stationary, and how they bend apart there.
//!
//! ```text
//!   gap(u, v) = n_B . (A(u, v) - foot on B)      gradient n_B . A_u, n_B . A_v      Hessian = second form of A - that of B
//! ```
//!
//! Newton with the pseudo-inverse: along a direction in which the surfaces bend alike the place is not moved, so that it falls on a
//! tangential curve beside it. The eigenvalues (relative curvatures) tell what the contact is: same signs: a point; different signs:
//! two crossing curves; one zero: a tangential curve; both: contact of higher order. Reference: Ye, Maekawa, *Differential geometry
//! of intersection curves of two surfaces*, 1999.

use super::shape::Shape;
use crate::bounds::{Vector, add, cross, dot, norm, scaled, sub};
use crate::portable::SameDigits;

/// A relative curvature below this share of the greatest curvature there counts as none.
const NO_CURVATURE: f64 = 1e-5;

/// A place of stationary gap.
#[derive(Clone, Copy, Debug)]
pub struct Touch {
    /// Parameters on A and B.
    pub at: [f64; 4],
    /// Signed gap along the normal of B.
    pub gap: f64,
    /// What is left of the gradient: sine of the angle of the normals.
    pub slope: f64,
    /// Relative curvatures, the greater in absolute value first.
    pub curvature: [f64; 2],
    /// Greatest curvature of either surface there.
    pub greatest: f64,
    /// Unit directions in space that belong to them.
    pub direction: [Vector; 2],
    /// The same as steps of A's parameters.
    pub step: [[f64; 2]; 2],
}

impl Touch {
    /// How many relative curvatures count.
    pub fn rank(&self) -> usize {
        let most = NO_CURVATURE * self.greatest;
        self.curvature.iter().filter(|x| x.abs() > most).count()
    }
}

/// Derivatives of a surface to the second order.
pub fn second(surface: &dyn Shape, [u, v]: [f64; 2]) -> [Vector; 6] {
    let mut out = [[0.0; 3]; 6];
    surface.partials(u, v, 2, &mut out);
    out
}

/// Moves a parameter pair into the domain.
pub fn into_domain(surface: &dyn Shape, at: [f64; 2]) -> [f64; 2] {
    let [u0, u1, v0, v1] = surface.domain();
    [at[0].clamp(u0, u1), at[1].clamp(v0, v1)]
}

/// The step in two parameters whose tangential effect is `want`, in the least-squares sense.
pub fn in_tangent_plane(du: Vector, dv: Vector, want: Vector) -> Option<[f64; 2]> {
    let (e, f, g) = (dot(du, du), dot(du, dv), dot(dv, dv));
    let det = e * g - f * f;
    if det.is_nan() || det <= 1e-24 * e * g || det == 0.0 {
        return None;
    }
    let (p, q) = (dot(du, want), dot(dv, want));
    Some([(g * p - f * q) / det, (e * q - f * p) / det])
}

/// The foot of a point near a start: Newton where the squared distance is convex, the tangent plane elsewhere.
pub fn foot(surface: &dyn Shape, mut at: [f64; 2], point: Vector) -> [f64; 2] {
    for _ in 0..20 {
        let [x, du, dv, duu, duv, dvv] = second(surface, at);
        let r = sub(x, point);
        let g = [dot(r, du), dot(r, dv)];
        let h = [dot(du, du) + dot(r, duu), dot(du, dv) + dot(r, duv), dot(dv, dv) + dot(r, dvv)];
        let det = h[0] * h[2] - h[1] * h[1];
        let step = if h[0] > 0.0 && det > 1e-12 * h[0] * h[2] {
            [(h[1] * g[1] - h[2] * g[0]) / det, (h[1] * g[0] - h[0] * g[1]) / det]
        } else {
            match in_tangent_plane(du, dv, scaled(r, -1.0)) {
                Some(step) => step,
                None => break,
            }
        };
        let next = into_domain(surface, [at[0] + step[0], at[1] + step[1]]);
        let moved = norm(add(scaled(du, next[0] - at[0]), scaled(dv, next[1] - at[1])));
        at = next;
        if moved <= 1e-15 * (norm(x) + 1.0) {
            break;
        }
    }
    at
}

/// The gap at a place and how the surfaces bend apart; `None` where a surface has no tangent plane.
pub fn look(
    a: &dyn Shape,
    b: &dyn Shape,
    uv: [f64; 2],
    near: [f64; 2],
) -> Option<(Touch, [f64; 2])> {
    let p = second(a, uv);
    let st = foot(b, near, p[0]);
    let q = second(b, st);
    let normal = cross(q[1], q[2]);
    let length = norm(normal);
    if length.is_nan() || length <= 1e-12 * norm(q[1]) * norm(q[2]) || length == 0.0 {
        return None;
    }
    let n = scaled(normal, 1.0 / length);
    let gradient = [dot(n, p[1]), dot(n, p[2])];
    let c = [in_tangent_plane(q[1], q[2], p[1])?, in_tangent_plane(q[1], q[2], p[2])?];
    let form = [dot(n, q[3]), dot(n, q[4]), dot(n, q[5])];
    let theirs = |x: [f64; 2], y: [f64; 2]| {
        form[0] * x[0] * y[0] + form[1] * (x[0] * y[1] + x[1] * y[0]) + form[2] * x[1] * y[1]
    };
    let h = [
        dot(n, p[3]) - theirs(c[0], c[0]),
        dot(n, p[4]) - theirs(c[0], c[1]),
        dot(n, p[5]) - theirs(c[1], c[1]),
    ];
    // An orthonormal frame of A's tangent plane: columns of parameters per unit of length.
    let (e, f, g) = (dot(p[1], p[1]), dot(p[1], p[2]), dot(p[2], p[2]));
    let det = e * g - f * f;
    if det.is_nan() || det <= 1e-24 * e * g || det == 0.0 {
        return None;
    }
    let first = [1.0 / e.sqrt(), 0.0];
    let second = [-f / (e * det).sqrt(), e / (e * det).sqrt()];
    let on = |m: &[f64; 3], x: [f64; 2], y: [f64; 2]| {
        m[0] * x[0] * y[0] + m[1] * (x[0] * y[1] + x[1] * y[0]) + m[2] * x[1] * y[1]
    };
    let [xx, xy, yy] = [on(&h, first, first), on(&h, first, second), on(&h, second, second)];
    let ours = [dot(n, p[3]), dot(n, p[4]), dot(n, p[5])];
    let sizes = |m: &[f64; 3]| {
        on(m, first, first).abs() + on(m, second, second).abs() + on(m, first, second).abs()
    };
    let greatest =
        sizes(&ours).max(sizes(&[theirs(c[0], c[0]), theirs(c[0], c[1]), theirs(c[1], c[1])]));
    let angle = 0.5 * (2.0 * xy).arctangent_over(xx - yy);
    let (sin, cos) = angle.sine_cosine();
    let values = [
        xx * cos * cos + 2.0 * xy * sin * cos + yy * sin * sin,
        xx * sin * sin - 2.0 * xy * sin * cos + yy * cos * cos,
    ];
    let mix = |x: f64, y: f64| [x * first[0] + y * second[0], x * first[1] + y * second[1]];
    let mut pairs = [(values[0], mix(cos, sin)), (values[1], mix(-sin, cos))];
    if pairs[1].0.abs() > pairs[0].0.abs() {
        pairs.swap(0, 1);
    }
    let step = pairs.map(|pair| pair.1);
    let touch = Touch {
        at: [uv[0], uv[1], st[0], st[1]],
        gap: dot(n, sub(p[0], q[0])),
        slope: norm([
            gradient[0] * first[0] + gradient[1] * first[1],
            gradient[0] * second[0] + gradient[1] * second[1],
            0.0,
        ]),
        curvature: pairs.map(|pair| pair.0),
        greatest,
        direction: step.map(|x| add(scaled(p[1], x[0]), scaled(p[2], x[1]))),
        step,
    };
    Some((touch, gradient))
}

/// The place of stationary gap near a start; `None` when the iteration leaves `reach` (a length) or does not end.
pub fn settle(a: &dyn Shape, b: &dyn Shape, start: [f64; 4], reach: f64) -> Option<Touch> {
    let (mut uv, mut st) = ([start[0], start[1]], [start[2], start[3]]);
    let mut gone = 0.0;
    for _ in 0..30 {
        let (touch, gradient) = look(a, b, uv, st)?;
        st = [touch.at[2], touch.at[3]];
        let mut step = [0.0; 2];
        let mut length: f64 = 0.0;
        for (value, along) in touch.curvature.into_iter().zip(touch.step) {
            if value.abs() > NO_CURVATURE * touch.greatest {
                let share = -(gradient[0] * along[0] + gradient[1] * along[1]) / value;
                length += share.abs();
                step = [step[0] + share * along[0], step[1] + share * along[1]];
            }
        }
        let most = (0.5 * reach / length).min(1.0);
        let next = into_domain(a, [uv[0] + most * step[0], uv[1] + most * step[1]]);
        gone += most * length;
        let stays = length <= 1e-11 * (1.0 + reach);
        if stays {
            return Some(touch);
        }
        if gone > 4.0 * reach || next == uv {
            return None;
        }
        uv = next;
    }
    None
}
