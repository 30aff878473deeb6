//! How far a polynomial spline F is from the exact offset S + d n at equal parameters, proven.
//!
//! On a common Bezier piece let S = A / w and e = w F - A, so that E = F - S = e / w. Everything below is a polynomial, and bounded by its
//! Bernstein coefficients:
//!
//! ```text
//!   a_u = A_u w - A w_u = w^2 S_u         g_u = e . a_u = w^3 E . S_u          (the same for v)
//!   q   = e . e - d^2 w^2                 h   = (a_u x a_v) . N <= w^4 |S_u x S_v|   for a fixed unit vector N
//!   t   = a_u . a_u + a_v . a_v           = w^4 trace of the first fundamental form
//!
//!   E = alpha n + tau:   |tau|^2 <= (g_u^2 + g_v^2) t / (w^2 h^2),    |alpha^2 - d^2| <= |q| / w^2 + |tau|^2 =: c
//!   c < d^2 and alpha of d's sign in one point:     |E - d n|^2 <= (c / d)^2 + |tau|^2
//! ```
//!
//! The least eigenvalue of the form is at least its determinant over its trace, which gives the first line; alpha has no zero, so its sign
//! is that of one point. A planar curve is the same with `a_v = w^2 V`. Pieces whose bound is above the goal are halved. Every
//! polynomial is loosened by what rounding may do: units of the sizes of its factors, counted generously.

use super::poly::{Poly, Polys, homogeneous, product};
use crate::bezier::{Bidegree, MAX_TRIPLE};
use crate::bounds::{Vector, dot, norm, scaled, sub};
use crate::curve::Curve;
use crate::error::Error;
use crate::operate::{compatible_curves, compatible_surfaces};
use crate::surface::Surface;

/// Most halvings of one piece.
const DEPTH: usize = 12;

/// The polynomials of the bound on one piece.
struct Cell {
    w: Poly,
    q: Poly,
    g_u: Poly,
    g_v: Poly,
    h: Poly,
    t: Poly,
}

impl Cell {
    /// From A, w, F and, for curves, the plane's normal; all relative to one point. Nothing when the sign is wrong or degrees are
    /// too high.
    fn new(a: &Polys, w: &Poly, f: &Polys, distance: f64, up: Option<Vector>) -> Option<Self> {
        let most = 4 * (w.degree.s.max(w.degree.t)).max(f[0].degree.s.max(f[0].degree.t));
        if most >= MAX_TRIPLE {
            return None;
        }
        let e: Polys = [0, 1, 2].map(|k| {
            let product = w.times(&f[k]);
            let raised = a[k].raised(product.degree);
            product.plus(-1.0, &raised)
        });
        let along = |direction: usize| -> Polys {
            [0, 1, 2].map(|k| {
                if w.degree.count() == 1 {
                    return a[k].derived(direction);
                }
                let left = a[k].derived(direction).times(w);
                let right = a[k].times(&w.derived(direction));
                left.plus(-1.0, &right)
            })
        };
        let square = w.times(w);
        let a_u = along(0);
        let a_v = match up {
            None => along(1),
            Some(up) => up.map(|x| {
                let c = square.c.iter().map(|w| w * x).collect();
                Poly { degree: square.degree, c, slack: square.slack }
            }),
        };
        let m: Polys = [(1, 2), (2, 0), (0, 1)]
            .map(|(i, j)| a_u[i].times(&a_v[j]).plus(-1.0, &a_u[j].times(&a_v[i])));
        let at = |polys: &Polys, k: usize| [polys[0].c[k], polys[1].c[k], polys[2].c[k]];
        // The sign of alpha in the first corner.
        let side = dot(at(&e, 0), at(&m, 0)) * distance;
        if side.is_nan() || side <= 0.0 {
            return None;
        }
        let middle =
            (0..m[0].c.len()).map(|k| at(&m, k)).fold([0.0; 3], |a, b| sub(a, scaled(b, -1.0)));
        let normal = scaled(middle, 1.0 / norm(middle));
        let h = Poly {
            degree: m[0].degree,
            c: (0..m[0].c.len()).map(|k| dot(at(&m, k), normal)).collect(),
            slack: 2.0 * (m[0].slack + m[1].slack + m[2].slack)
                + 16.0 * f64::EPSILON * (m[0].size() + m[1].size() + m[2].size()),
        };
        let ee = product(&e, &e);
        let q = {
            let raised = square.raised(ee.degree);
            ee.plus(-distance * distance, &raised)
        };
        let (uu, vv) = (product(&a_u, &a_u), product(&a_v, &a_v));
        let top = Bidegree { s: uu.degree.s.max(vv.degree.s), t: uu.degree.t.max(vv.degree.t) };
        let t = uu.raised(top).plus(1.0, &vv.raised(top));
        Some(Self { w: w.clone(), q, g_u: product(&e, &a_u), g_v: product(&e, &a_v), h, t })
    }

    /// The bound on the piece, infinite when there is none.
    fn bound(&self, distance: f64) -> f64 {
        let (least, most) = (Poly::least, Poly::most);
        let (w, h) = (least(&self.w), least(&self.h));
        if !(w > 0.0 && h > 0.0) {
            return f64::INFINITY;
        }
        let (g_u, g_v) = (most(&self.g_u), most(&self.g_v));
        let tau = (g_u * g_u + g_v * g_v) * most(&self.t) / (w * w * h * h);
        let c = most(&self.q) / (w * w) + tau;
        if c.is_nan() || c >= distance * distance {
            return f64::INFINITY;
        }
        (c / distance * (c / distance) + tau).sqrt() * (1.0 + 16.0 * f64::EPSILON)
    }

    fn halved(&self, direction: usize) -> [Self; 2] {
        let [w, q, g_u, g_v, h, t] =
            [&self.w, &self.q, &self.g_u, &self.g_v, &self.h, &self.t].map(|p| p.halved(direction));
        let half = |k: usize| Self {
            w: w[k].clone(),
            q: q[k].clone(),
            g_u: g_u[k].clone(),
            g_v: g_v[k].clone(),
            h: h[k].clone(),
            t: t[k].clone(),
        };
        [half(0), half(1)]
    }

    /// The bound after as many halvings as it takes to get below the goal, at most `depth`.
    fn refined(&self, distance: f64, goal: f64, depth: usize) -> f64 {
        let bound = self.bound(distance);
        if bound <= goal || depth == 0 {
            return bound;
        }
        let direction = if self.w.degree.t == 0 && self.g_u.degree.t == 0 { 0 } else { depth % 2 };
        let [low, high] = self.halved(direction);
        let first = low.refined(distance, goal, depth - 1);
        // One half that fails decides.
        if first > goal {
            return first.max(bound.min(high.bound(distance)));
        }
        first.max(high.refined(distance, goal, depth - 1))
    }
}

/// The proven error of `fit` as the offset of `surface`: infinite when nothing is proven.
pub(super) fn surface_error(
    surface: &Surface,
    fit: &Surface,
    distance: f64,
    goal: f64,
) -> Result<f64, Error> {
    if distance == 0.0 {
        return Ok(surface.difference(fit)?.bound);
    }
    let pair = compatible_surfaces(&[surface.clone(), fit.clone()])?;
    let (base, _) = pair[0].bezier_pieces()?;
    let (fitted, _) = pair[1].bezier_pieces()?;
    let degree = Bidegree { s: pair[0].knots_u().degree(), t: pair[0].knots_v().degree() };
    let mut worst: f64 = 0.0;
    for (base, fitted) in base.iter().zip(&fitted) {
        let center = base.poles()[0];
        let (a, w) = homogeneous(base.poles(), base.weights(), center, degree);
        let (f, _) = homogeneous(fitted.poles(), None, center, degree);
        let cell = Cell::new(&a, &w, &f, distance, None);
        worst = worst.max(cell.map_or(f64::INFINITY, |cell| cell.refined(distance, goal, DEPTH)));
        if worst.is_infinite() {
            break;
        }
    }
    Ok(worst)
}

/// The proven error of `fit` as the offset of `curve` in the plane across the unit vector `up`: infinite when nothing is proven.
pub(super) fn curve_error(
    curve: &Curve,
    fit: &Curve,
    distance: f64,
    up: Vector,
    goal: f64,
) -> Result<f64, Error> {
    if distance == 0.0 {
        return Ok(curve.difference(fit)?.bound);
    }
    // n = C' x V: S_u is C', S_v is V.
    let pair = compatible_curves(&[curve.clone(), fit.clone()])?;
    let (base, fitted) = (pair[0].bezier_pieces()?, pair[1].bezier_pieces()?);
    let degree = Bidegree { s: pair[0].degree(), t: 0 };
    let mut worst: f64 = 0.0;
    for (base, fitted) in base.iter().zip(&fitted) {
        let center = base.poles()[0];
        let (a, w) = homogeneous(base.poles(), base.weights(), center, degree);
        let (f, _) = homogeneous(fitted.poles(), None, center, degree);
        let cell = Cell::new(&a, &w, &f, distance, Some(up));
        worst = worst.max(cell.map_or(f64::INFINITY, |cell| cell.refined(distance, goal, DEPTH)));
        if worst.is_infinite() {
            break;
        }
    }
    Ok(worst)
}
