//! Where a plane or a quadric meets a plane or a quadric, when that is made of conics: exact circles, ellipses, lines and so on.
//!
//! ```text
//!   plane, quadric:    the quadric in coordinates of the plane is a conic
//!   quadric, quadric:  a member of the pencil  Q1 + x Q2  of rank 2 or less is a pair of planes that holds
//!                      all common points: each plane meets Q1 in a conic
//! ```
//!
//! Spheres, equal crossing cylinders, quadrics about one axis, cylinders with parallel axes: all are such pairs.
//! Reference: Levin, *A parametric algorithm for drawing pictures of solid objects composed of quadric surfaces*, 1976; Dupont
//! et al., *Near-optimal parameterization of the intersection of quadrics*, 2008.
//! Limit: other pairs meet in curves of degree four; take one as a NURBS surface and its section by the other.

use super::quadric::Quadric;
use crate::bounds::{Vector, add, cross, dot, norm, scaled, sub};
use crate::portable::SameDigits;

/// Share of the greatest eigenvalue below which one counts as zero.
const NOTHING: f64 = 1e-9;

/// How far, in the size of the two, a plane of the pencil may be off.
const NEARLY: f64 = 1e-6;

/// Share of the terms of a form below which their sum is none: rounding, a hundred times over.
const NONE: f64 = 3e-14;

/// Sum of the absolute terms of a quadric at a point, with what the rounding of coordinates makes of it.
fn reach_of(q: &Quadric, x: Vector) -> f64 {
    let y = norm(sub(x, q.origin));
    let grain = 1e-6 * (norm(x) + norm(q.origin));
    q.constant.abs() + q.size() * (y * y + grain * grain) + 2.0 * norm(q.linear) * y
}

/// A conic in space; directions are unit vectors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Conic {
    /// A line.
    Line {
        /// A point of it.
        origin: Vector,
        /// Its direction.
        direction: Vector,
    },
    /// `center + major cos t x + minor sin t y`; a circle when both lengths are the same.
    Ellipse {
        /// Its centre.
        center: Vector,
        /// Unit directions of the two axes.
        axes: [Vector; 2],
        /// Their half lengths.
        lengths: [f64; 2],
    },
    /// `center +- lengths.0 cosh t x + lengths.1 sinh t y`, both branches.
    Hyperbola {
        /// Its centre.
        center: Vector,
        /// Unit directions: of the vertices, and across.
        axes: [Vector; 2],
        /// Half lengths.
        lengths: [f64; 2],
    },
    /// `vertex + t y + t^2 / (4 focal) x`.
    Parabola {
        /// Its vertex.
        vertex: Vector,
        /// Unit directions: of the axis, and across.
        axes: [Vector; 2],
        /// Distance of the focus from the vertex.
        focal: f64,
    },
    /// A single point of contact.
    Point(Vector),
}

impl Conic {
    /// A point of it, by the parameter of its formula; of a hyperbola the branch along its first axis.
    pub fn point(&self, t: f64) -> Vector {
        let on = |center: Vector, axes: &[Vector; 2], x: f64, y: f64| {
            add(center, add(scaled(axes[0], x), scaled(axes[1], y)))
        };
        match self {
            Self::Line { origin, direction } => add(*origin, scaled(*direction, t)),
            Self::Ellipse { center, axes, lengths } => {
                on(*center, axes, lengths[0] * t.cosine(), lengths[1] * t.sine())
            }
            Self::Hyperbola { center, axes, lengths } => {
                let (up, down) = (t.exponential(), (-t).exponential());
                on(*center, axes, lengths[0] * 0.5 * (up + down), lengths[1] * 0.5 * (up - down))
            }
            Self::Parabola { vertex, axes, focal } => on(*vertex, axes, t * t / (4.0 * focal), t),
            Self::Point(point) => *point,
        }
    }
}

/// How two quadrics meet.
#[derive(Clone, Debug, PartialEq)]
pub enum Common {
    /// They are the same.
    Same,
    /// In these conics and nowhere else; none: they do not meet.
    Conics(Vec<Conic>),
    /// Not in conics, or too nearly so to tell.
    Quartic,
}

/// A quadric in homogeneous form about a point, in units of a length.
fn homogeneous(q: &Quadric, center: Vector, unit: f64) -> [[f64; 4]; 4] {
    let e = sub(center, q.origin);
    let moved = scaled(add(q.times(e), q.linear), unit);
    let constant = q.value(center);
    let [xx, xy, xz, yy, yz, zz] = q.matrix.map(|a| a * unit * unit);
    let [x, y, z] = moved;
    let m = [[xx, xy, xz, x], [xy, yy, yz, y], [xz, yz, zz, z], [x, y, z, constant]];
    let size = m.iter().flatten().fold(0.0f64, |s, a| s.max(a.abs()));
    m.map(|row| row.map(|a| a / size))
}

/// Eigenvalues and vectors (rows) of a symmetric matrix, by Jacobi's rotations.
fn eigen<const N: usize>(mut m: [[f64; N]; N]) -> ([f64; N], [[f64; N]; N]) {
    let mut v = [[0.0; N]; N];
    (0..N).for_each(|k| v[k][k] = 1.0);
    for _ in 0..60 {
        let mut off = 0.0f64;
        for p in 0..N {
            for q in p + 1..N {
                off = off.max(m[p][q].abs());
                if m[p][q] == 0.0 {
                    continue;
                }
                let theta = (m[q][q] - m[p][p]) / (2.0 * m[p][q]);
                let t = theta.signum() / (theta.abs() + (theta * theta + 1.0).sqrt());
                let t = if theta == 0.0 { 1.0 } else { t };
                let c = 1.0 / (t * t + 1.0).sqrt();
                let s = t * c;
                for k in 0..N {
                    (m[k][p], m[k][q]) = (c * m[k][p] - s * m[k][q], s * m[k][p] + c * m[k][q]);
                }
                for k in 0..N {
                    (m[p][k], m[q][k]) = (c * m[p][k] - s * m[q][k], s * m[p][k] + c * m[q][k]);
                    (v[p][k], v[q][k]) = (c * v[p][k] - s * v[q][k], s * v[p][k] + c * v[q][k]);
                }
            }
        }
        if off < 1e-300 {
            break;
        }
    }
    (std::array::from_fn(|k| m[k][k]), v)
}

/// The conic of a quadric in a plane through `origin` with orthonormal directions.
fn in_plane(q: &Quadric, origin: Vector, x: Vector, y: Vector) -> Option<Vec<Conic>> {
    let g = scaled(q.gradient(origin), 0.5);
    let (ax, ay) = (q.times(x), q.times(y));
    let a = [[dot(x, ax), dot(x, ay)], [dot(x, ay), dot(y, ay)]];
    let (b, c) = ([dot(x, g), dot(y, g)], q.value(origin));
    let (values, vectors) = eigen(a);
    let size = q.size();
    let axis = |k: usize| add(scaled(x, vectors[k][0]), scaled(y, vectors[k][1]));
    let slope = |k: usize| vectors[k][0] * b[0] + vectors[k][1] * b[1];
    let is_zero = |v: f64| v.abs() <= NOTHING * size;
    let line = |origin: Vector, direction: Vector| Conic::Line {
        origin,
        direction: scaled(direction, 1.0 / norm(direction)),
    };
    match [is_zero(values[0]), is_zero(values[1])] {
        [true, true] => {
            let length = b[0].hypotenuse(b[1]);
            if length == 0.0 {
                return if c == 0.0 { None } else { Some(Vec::new()) };
            }
            let n = add(scaled(x, b[0] / length), scaled(y, b[1] / length));
            let across = add(scaled(x, -b[1] / length), scaled(y, b[0] / length));
            Some(vec![line(sub(origin, scaled(n, c / (2.0 * length))), across)])
        }
        [false, false] => {
            let shift = [0, 1].map(|k| -slope(k) / values[k]);
            let center = add(origin, add(scaled(axis(0), shift[0]), scaled(axis(1), shift[1])));
            // l0 X^2 + l1 Y^2 = level
            let level = -q.value(center);
            let reach = reach_of(q, center);
            let is_none = level.abs() <= NONE * reach;
            let (p, r) = (values[0] * level.signum(), values[1] * level.signum());
            if values[0] * values[1] > 0.0 {
                if is_none {
                    return Some(vec![Conic::Point(center)]);
                }
                if p < 0.0 {
                    return Some(Vec::new());
                }
                let lengths = [(level.abs() / p).sqrt(), (level.abs() / r).sqrt()];
                let (major, minor) = if lengths[0] >= lengths[1] { (0, 1) } else { (1, 0) };
                return Some(vec![Conic::Ellipse {
                    center,
                    axes: [axis(major), axis(minor)],
                    lengths: [lengths[major], lengths[minor]],
                }]);
            }
            if is_none {
                let ratio = (-values[0] / values[1]).sqrt();
                let direction = |s: f64| add(axis(0), scaled(axis(1), s * ratio));
                return Some(vec![line(center, direction(1.0)), line(center, direction(-1.0))]);
            }
            let (along, across) = if p > 0.0 { (0, 1) } else { (1, 0) };
            let length = |k: usize| (level / values[k]).abs().sqrt();
            Some(vec![Conic::Hyperbola {
                center,
                axes: [axis(along), axis(across)],
                lengths: [length(along), length(across)],
            }])
        }
        [first_is_zero, _] => {
            let (k, free) = if first_is_zero { (1, 0) } else { (0, 1) };
            let (value, linear) = (values[k], slope(free));
            let shift = -slope(k) / value;
            let base = add(origin, scaled(axis(k), shift));
            // value X^2 + 2 linear Y + rest = 0
            let rest = c - slope(k) * slope(k) / value;
            let reach = reach_of(q, base);
            if linear.abs() <= NOTHING * (reach * value.abs()).sqrt() {
                let square = -rest / value;
                if square.abs() <= NONE * reach / value.abs() {
                    return Some(vec![line(base, axis(free))]);
                }
                if square < 0.0 {
                    return Some(Vec::new());
                }
                let d = scaled(axis(k), square.sqrt());
                return Some(vec![line(add(base, d), axis(free)), line(sub(base, d), axis(free))]);
            }
            let vertex = sub(base, scaled(axis(free), rest / (2.0 * linear)));
            let focal = -linear / (2.0 * value);
            let axes = [scaled(axis(free), focal.signum()), axis(k)];
            Some(vec![Conic::Parabola { vertex, axes, focal: focal.abs() }])
        }
    }
}

/// Two unit vectors across a direction.
fn frame_of(n: Vector) -> [Vector; 2] {
    let least = (0..3).min_by(|&a, &b| n[a].abs().total_cmp(&n[b].abs())).unwrap_or(0);
    let mut e = [0.0; 3];
    e[least] = 1.0;
    let x = cross(n, e);
    let x = scaled(x, 1.0 / norm(x));
    [x, cross(n, x)]
}

impl Quadric {
    /// Where this plane or quadric meets another one, if that is made of conics. Every point of the answer lies within `tolerance`
    /// (a length) of both; when one does not, the answer is [`Common::Quartic`].
    pub fn meet(&self, other: &Self, tolerance: f64) -> Common {
        let found = match (self.is_plane(), other.is_plane()) {
            (true, _) => with_plane(self, other),
            (_, true) => with_plane(other, self),
            _ => pencil(self, other),
        };
        let Common::Conics(list) = &found else { return found };
        let is_near = |x: Vector| self.distance(x) <= tolerance && other.distance(x) <= tolerance;
        let sure = list.iter().all(|conic| (-6..=6).all(|k| is_near(conic.point(0.5 * k as f64))));
        if sure { found } else { Common::Quartic }
    }
}

fn with_plane(plane: &Quadric, other: &Quadric) -> Common {
    let n = scaled(plane.linear, 1.0 / norm(plane.linear));
    // The point of the plane nearest to where the other counts from.
    let away =
        dot(n, sub(other.origin, plane.origin)) + plane.constant / (2.0 * norm(plane.linear));
    let origin = sub(other.origin, scaled(n, away));
    if other.is_plane() {
        let m = scaled(other.linear, 1.0 / norm(other.linear));
        let direction = cross(n, m);
        if norm(direction) < NOTHING {
            let apart = other.value(origin).abs() / (2.0 * norm(other.linear));
            let same =
                apart <= 1e-14 * norm(sub(plane.origin, other.origin)).max(f64::MIN_POSITIVE);
            return if same { Common::Same } else { Common::Conics(Vec::new()) };
        }
    }
    let [x, y] = frame_of(n);
    match in_plane(other, origin, x, y) {
        Some(conics) => Common::Conics(conics),
        None => Common::Same,
    }
}

fn pencil(a: &Quadric, b: &Quadric) -> Common {
    let center = a.origin;
    let own = |q: &Quadric| (q.constant.abs() / q.size()).sqrt().max(norm(q.linear) / q.size());
    let unit = norm(sub(b.origin, center)).max(own(a)).max(own(b)).max(1e-300);
    let (p, q) = (homogeneous(a, center, unit), homogeneous(b, center, unit));
    let same = |s: f64| (0..16).all(|k| (p[k / 4][k % 4] - s * q[k / 4][k % 4]).abs() < 1e-13);
    if same(1.0) || same(-1.0) {
        return Common::Same;
    }
    // Both signs of the pencil: cos p + sin q, sampled, then the angle of least third eigenvalue by golden section.
    let third = |angle: f64| {
        let (s, c) = angle.sine_cosine();
        let m: [[f64; 4]; 4] =
            std::array::from_fn(|i| std::array::from_fn(|j| c * p[i][j] + s * q[i][j]));
        let mut sizes = eigen(m).0.map(f64::abs);
        sizes.sort_by(|x, y| y.total_cmp(x));
        sizes[2] / sizes[0]
    };
    let steps = 720;
    let at = |k: usize| std::f64::consts::PI * k as f64 / steps as f64;
    let values: Vec<f64> = (0..steps).map(|k| third(at(k))).collect();
    let mut best: Option<(f64, f64)> = None;
    for k in 0..steps {
        let (before, after) = (values[(k + steps - 1) % steps], values[(k + 1) % steps]);
        if values[k] > before || values[k] > after {
            continue;
        }
        let angle = least(at(k) - at(1), at(k) + at(1), &third);
        let size = third(angle);
        if size < NOTHING && best.is_none_or(|(least, _)| size < least) {
            best = Some((size, angle));
        }
    }
    let Some((_, angle)) = best else { return Common::Quartic };
    planes(a, &p, &q, angle, center, unit)
}

/// Where a function that has one least value in an interval has it.
fn least(mut a: f64, mut b: f64, f: &dyn Fn(f64) -> f64) -> f64 {
    let golden = 0.5 * (5.0f64.sqrt() - 1.0);
    let (mut x, mut y) = (b - golden * (b - a), a + golden * (b - a));
    let (mut fx, mut fy) = (f(x), f(y));
    for _ in 0..90 {
        if fx <= fy {
            (b, y, fy) = (y, x, fx);
            x = b - golden * (b - a);
            fx = f(x);
        } else {
            (a, x, fx) = (x, y, fy);
            y = a + golden * (b - a);
            fy = f(y);
        }
    }
    if fx <= fy { x } else { y }
}

/// The planes of the member of the pencil at an angle, and the conics in them.
fn planes(
    a: &Quadric,
    p: &[[f64; 4]; 4],
    q: &[[f64; 4]; 4],
    angle: f64,
    center: Vector,
    unit: f64,
) -> Common {
    let (s, c) = angle.sine_cosine();
    let m: [[f64; 4]; 4] =
        std::array::from_fn(|i| std::array::from_fn(|j| c * p[i][j] + s * q[i][j]));
    let (values, vectors) = eigen(m);
    let mut order = [0, 1, 2, 3];
    order.sort_by(|&i, &j| values[j].abs().total_cmp(&values[i].abs()));
    let [i, j] = [order[0], order[1]];
    let (first, second) = (values[i], values[j]);
    let mut forms: Vec<[f64; 4]> = Vec::new();
    if second.abs() <= NOTHING * first.abs() {
        forms.push(vectors[i]);
    } else if first * second < 0.0 {
        let ratio = (-second / first).sqrt();
        for sign in [1.0, -1.0] {
            forms.push(std::array::from_fn(|k| vectors[i][k] + sign * ratio * vectors[j][k]));
        }
    } else {
        return axis_of(a, &vectors[i], &vectors[j], center, unit);
    }
    let mut conics = Vec::new();
    for form in forms {
        let n = [form[0], form[1], form[2]];
        let length = norm(n);
        if length <= NOTHING * form[3].abs() {
            // The plane at infinity.
            continue;
        }
        let normal = scaled(n, 1.0 / length);
        let origin = add(center, scaled(normal, -form[3] / length * unit));
        let [x, y] = frame_of(normal);
        // The plane is known to some digits only: where it misses by less, nothing is told.
        let nearly = |by: f64| in_plane(a, add(origin, scaled(normal, by * unit)), x, y);
        let is_near = |by: f64| nearly(by).is_none_or(|list| !list.is_empty());
        match in_plane(a, origin, x, y) {
            Some(list) if list.is_empty() && (is_near(NEARLY) || is_near(-NEARLY)) => {
                return Common::Quartic;
            }
            Some(list) => conics.extend(list),
            None => return Common::Quartic,
        }
    }
    Common::Conics(conics)
}

/// A pair of planes that is not real but for the line in which they meet: all common points lie on it.
fn axis_of(a: &Quadric, first: &[f64; 4], second: &[f64; 4], center: Vector, unit: f64) -> Common {
    let n = [first, second].map(|f| [f[0], f[1], f[2]]);
    let direction = cross(n[0], n[1]);
    let square = dot(direction, direction);
    if square < NOTHING {
        // They meet at infinity only.
        return Common::Conics(Vec::new());
    }
    let numerator =
        add(scaled(cross(n[1], direction), -first[3]), scaled(cross(direction, n[0]), -second[3]));
    let origin = add(center, scaled(numerator, unit / square));
    let d = scaled(direction, 1.0 / square.sqrt());
    let (k, h, c) = (dot(d, a.times(d)), 0.5 * dot(d, a.gradient(origin)), a.value(origin));
    let at = |t: f64| Conic::Point(add(origin, scaled(d, t)));
    if k.abs() <= NOTHING * a.size() {
        let none = NOTHING * a.size() * unit;
        return Common::Conics(match (h.abs() <= none, c.abs() <= none * unit) {
            (true, true) => vec![Conic::Line { origin, direction: d }],
            // The line is known to some digits only.
            (true, false) if c.abs() <= 16.0 * NEARLY * a.size() * unit * unit => {
                return Common::Quartic;
            }
            (true, false) => Vec::new(),
            _ => vec![at(-c / (2.0 * h))],
        });
    }
    let root = h * h - k * c;
    if root.abs() <= NOTHING * (h * h).max((k * c).abs()) {
        return Common::Conics(vec![at(-h / k)]);
    }
    if root < 0.0 && -root <= 16.0 * NEARLY * (h * h).max((k * c).abs()) {
        return Common::Quartic;
    }
    if root < 0.0 {
        return Common::Conics(Vec::new());
    }
    Common::Conics([-1.0, 1.0].map(|s| at((-h + s * root.sqrt()) / k)).to_vec())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn conics(a: &Quadric, b: &Quadric) -> Vec<Conic> {
        match a.meet(b, 1e-9) {
            Common::Conics(list) => list,
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn spheres_meet_in_a_circle_a_point_or_not_at_all() {
        let a = Quadric::sphere([1.0, 2.0, 3.0], 1.0).unwrap();
        let at = |d: f64, r: f64| Quadric::sphere([1.0 + d, 2.0, 3.0], r).unwrap();
        let [Conic::Ellipse { center, lengths, .. }] = conics(&a, &at(1.0, 1.0))[..] else {
            panic!()
        };
        assert!(norm(sub(center, [1.5, 2.0, 3.0])) < 1e-14, "{center:?}");
        assert!(lengths.iter().all(|l| (l - 0.75f64.sqrt()).abs() < 1e-14), "{lengths:?}");
        assert!(matches!(conics(&a, &at(2.0, 1.0))[..], [Conic::Point(_)]));
        assert!(conics(&a, &at(3.0, 1.0)).is_empty());
        assert!(conics(&a, &at(0.0, 0.5)).is_empty());
        assert_eq!(a.meet(&a, 1e-9), Common::Same);
    }

    #[test]
    fn equal_crossing_cylinders_meet_in_two_ellipses() {
        let a = Quadric::cylinder([0.0; 3], [0.0, 0.0, 1.0], 1.0).unwrap();
        let b = Quadric::cylinder([0.0; 3], [0.0, 1.0, 1.0], 1.0).unwrap();
        let found = conics(&a, &b);
        assert_eq!(found.len(), 2, "{found:?}");
        assert!(found.iter().all(|c| matches!(c, Conic::Ellipse { .. })));
        let unequal = Quadric::cylinder([0.0; 3], [0.0, 1.0, 1.0], 0.9).unwrap();
        assert_eq!(a.meet(&unequal, 1e-9), Common::Quartic);
    }

    #[test]
    fn parallel_cylinders_meet_in_lines() {
        let a = Quadric::cylinder([0.0; 3], [1.0, 1.0, 1.0], 1.0).unwrap();
        let side = [0.5f64.sqrt(), -(0.5f64.sqrt()), 0.0];
        let at = |d: f64| Quadric::cylinder(scaled(side, d), [1.0, 1.0, 1.0], 1.0).unwrap();
        let lines = |d: f64| match a.meet(&at(d), 1e-9) {
            Common::Conics(list) => Some(list.len()),
            _ => None,
        };
        assert_eq!([lines(1.0), lines(2.5)], [Some(2), Some(0)]);
        // Where they touch it is one line, or not told; never none.
        assert!(matches!(lines(2.0), Some(1) | None));
    }

    #[test]
    fn planes_cut_a_cone_in_every_conic() {
        let cone =
            Quadric::cone([0.0, 0.0, 1.0], [0.0, 0.0, 1.0], 0.25 * std::f64::consts::PI).unwrap();
        let cut = |origin, normal| conics(&cone, &Quadric::plane(origin, normal).unwrap());
        assert!(matches!(cut([0.0; 3], [0.0, 0.0, 1.0])[..], [Conic::Ellipse { .. }]));
        assert!(matches!(cut([0.0; 3], [0.0, 0.3, 1.0])[..], [Conic::Ellipse { .. }]));
        assert!(matches!(cut([0.0; 3], [0.0, 1.0, 1.0])[..], [Conic::Parabola { .. }]));
        assert!(matches!(cut([0.0; 3], [0.0, 1.0, 0.1])[..], [Conic::Hyperbola { .. }]));
        assert!(matches!(
            cut([0.0, 0.0, 1.0], [0.0, 1.0, 0.1])[..],
            [Conic::Line { .. }, Conic::Line { .. }]
        ));
        assert!(matches!(cut([0.0, 0.0, 1.0], [0.0, 0.1, 1.0])[..], [Conic::Point(_)]));
    }
}
