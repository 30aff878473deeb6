//! Curvatures at a place of a surface, and the places where the principal ones are equal.

use super::cell::{Forms, check_degree};
use super::request::{RangeOptions, areas_inside, check, patch_piece};
use crate::bounds::{Vector, add, cross, dot, norm, scaled};
use crate::error::Error;
use crate::index::IndexedSurface;
use crate::knots::Side;
use crate::portable::SameDigits;
use crate::surface::Surface;

/// Principal curvatures nearer to each other than this share of the greater one are equal: the directions are noise.
const EQUAL: f64 = 1e-7;

/// Boxes are halved until they are narrower than this share of a patch.
const NARROW: f64 = 1.0 / 4096.0;

/// The curvatures at one place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Curvatures {
    /// The point.
    pub point: Vector,
    /// Unit normal, along S_u x S_v.
    pub normal: Vector,
    /// The greater principal curvature and the less, 1 / length; positive: towards the normal.
    pub principal: [f64; 2],
    /// Their unit directions; any two at an umbilic.
    pub directions: [Vector; 2],
    /// Half the sum of the principal curvatures.
    pub mean: f64,
    /// Their product.
    pub gaussian: f64,
    /// Whether they are equal up to rounding.
    pub is_umbilic: bool,
}

/// The curvatures of the surface at (u, v), of the piece on these sides of knot lines; none where the parametrisation is
/// singular.
pub fn curvatures(surface: &Surface, at: [f64; 2], sides: [Side; 2]) -> Option<Curvatures> {
    let mut d = [[0.0; 3]; 6];
    surface.partials_on(at, sides, 2, &mut d);
    let (size_u, size_v) = (norm(d[1]), norm(d[2]));
    let across = cross(d[1], d[2]);
    let area = norm(across);
    if area.is_nan() || area <= 1e-14 * size_u * size_v || area == 0.0 {
        return None;
    }
    let normal = scaled(across, 1.0 / area);
    let first = scaled(d[1], 1.0 / size_u);
    let second = cross(normal, first);
    // S_u = x first, S_v = y first + z second; the second form in that frame.
    let (x, y, z) = (size_u, dot(d[2], first), dot(d[2], second));
    let [l, m, q] = [3, 4, 5].map(|k| dot(normal, d[k]));
    let a = l / (x * x);
    let b = (m - y * x * a) / (x * z);
    let c = (q - y * y * a - 2.0 * y * z * b) / (z * z);
    let (mean, half) = (0.5 * (a + c), 0.5 * (a - c));
    let root = half.hypotenuse(b);
    let angle = 0.5 * b.arctangent_over(half);
    let along = |angle: f64| add(scaled(first, angle.cosine()), scaled(second, angle.sine()));
    let principal = [mean + root, mean - root];
    Some(Curvatures {
        point: d[0],
        normal,
        principal,
        directions: [along(angle), along(angle + std::f64::consts::FRAC_PI_2)],
        mean,
        gaussian: a * c - b * b,
        is_umbilic: root <= EQUAL * principal[0].abs().max(principal[1].abs()),
    })
}

/// Places where the principal curvatures may be equal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Umbilic {
    /// Least u and greatest u, least v and greatest v: no umbilic lies outside of all the boxes.
    pub domain: [f64; 4],
    /// Parameters of the middle, or of the least difference near it.
    pub at: [f64; 2],
    /// Difference of the principal curvatures there.
    pub difference: f64,
    /// Whether the box is small: a point. Otherwise a line or an area of umbilics, or the budget ran out.
    pub is_small: bool,
}

/// All places where the principal curvatures may be equal: boxes outside of which they are proven to differ.
///
/// Planes and spheres consist of umbilics: they come back as one large box. Flat places count.
///
/// # Errors
/// As [`super::surface_range`].
pub fn umbilics(
    surface: &IndexedSurface,
    options: &RangeOptions,
    poll: &mut dyn FnMut() -> bool,
) -> Result<Vec<Umbilic>, Error> {
    let [u0, u1, v0, v1] = surface.surface().domain();
    check(options, &[[u0, u1], [v0, v1]])?;
    let index = surface.index(poll)?;
    check_degree(index.degree, index.rational)?;
    let mut forms: Vec<Option<Forms>> = (0..index.patches.len()).map(|_| None).collect();
    let mut level = areas_inside(index, options.domain);
    let (mut work, mut boxes, mut width) = (Vec::new(), 0u64, 1.0);
    while width > NARROW && !level.is_empty() && boxes < options.budget {
        let mut next = Vec::new();
        width *= 0.5;
        for (k, s, t) in level {
            if boxes % 256 == 255 && poll() {
                return Err(Error::Cancelled);
            }
            let forms = forms[k].get_or_insert_with(|| Forms::new(&patch_piece(index, k)));
            let middle = [0.5 * (s[0] + s[1]), 0.5 * (t[0] + t[1])];
            for s in [[s[0], middle[0]], [middle[0], s[1]]] {
                for t in [[t[0], middle[1]], [middle[1], t[1]]] {
                    boxes += 1;
                    if forms.on(s, t, &mut work).may_be_umbilic() {
                        next.push((k, s, t));
                    }
                }
            }
        }
        level = next;
    }
    let global = |&(k, s, t): &(usize, [f64; 2], [f64; 2])| {
        let patch = &index.patches[k];
        [patch.u.global(s[0]), patch.u.global(s[1]), patch.v.global(t[0]), patch.v.global(t[1])]
    };
    let joined = joined(level.iter().map(global).collect());
    let size = [(u1 - u0) * 0.02, (v1 - v0) * 0.02];
    Ok(joined.into_iter().map(|domain| seen(surface.surface(), domain, size)).collect())
}

/// Boxes that touch become one.
fn joined(boxes: Vec<[f64; 4]>) -> Vec<[f64; 4]> {
    let mut groups: Vec<[f64; 4]> = Vec::new();
    for mut here in boxes {
        loop {
            let touches = |g: &[f64; 4]| {
                let slack = [here[1] - here[0], here[3] - here[2]];
                g[0] <= here[1] + slack[0]
                    && here[0] - slack[0] <= g[1]
                    && g[2] <= here[3] + slack[1]
                    && here[2] - slack[1] <= g[3]
            };
            let Some(k) = groups.iter().position(touches) else { break };
            let g = groups.swap_remove(k);
            here = [here[0].min(g[0]), here[1].max(g[1]), here[2].min(g[2]), here[3].max(g[3])];
        }
        groups.push(here);
    }
    groups
}

/// A group with its best place: the least difference on a grid in the box.
fn seen(surface: &Surface, domain: [f64; 4], small: [f64; 2]) -> Umbilic {
    let mut best = (f64::INFINITY, [0.5 * (domain[0] + domain[1]), 0.5 * (domain[2] + domain[3])]);
    let mut around = domain;
    for _ in 0..12 {
        for i in 0..=8 {
            for j in 0..=8 {
                let share = |k: usize, n: usize| {
                    let x = around[k] + (around[k + 1] - around[k]) * n as f64 / 8.0;
                    x.clamp(domain[k], domain[k + 1])
                };
                let at = [share(0, i), share(2, j)];
                if let Some(c) = curvatures(surface, at, [Side::Above; 2]) {
                    let difference = c.principal[0] - c.principal[1];
                    if difference < best.0 {
                        best = (difference, at);
                    }
                }
            }
        }
        let half = [0.25 * (around[1] - around[0]), 0.25 * (around[3] - around[2])];
        let [u, v] = best.1;
        around = [u - half[0], u + half[0], v - half[1], v + half[1]];
    }
    let is_small = domain[1] - domain[0] <= small[0] && domain[3] - domain[2] <= small[1];
    Umbilic { domain, at: best.1, difference: best.0, is_small }
}
