//! Carriers proposed from a few points and normals, settled by least squares, and handed to the proof.
//!
//! ```text
//!   plane      least direction of the points' scatter      cylinder   least direction of the normals
//!   sphere     |p|^2 = 2 c.p + k                           cone       least direction of their differences, tangent planes meet
//!   torus      axis: the line that all normals meet; then a circle in its half plane
//! ```
//!
//! A proposal costs a microsecond and is good to half the digits; a few Gauss-Newton steps on the signed distances make it
//! exact to rounding. Whether it is right is for `deviation` to say.
//! Reference: Pottmann, Wallner, *Computational Line Geometry*, 2001 (the complex of lines that meet an axis).

use super::deviation::proven;
use super::linear::{add_square, any_frame, fitted, frame, least_direction, solved, unit};
use super::{Carrier, Kind, MOST_DEVIATION, Pieces};
use crate::bounds::{Vector, add, cross, dot, norm, scaled, sub};

/// Where samples are taken, as shares of all pieces in a direction: at no place of symmetry, and off the borders, where
/// normals may vanish.
pub const PLACES: [f64; 4] = [0.07, 0.36, 0.64, 0.93];
const CURVE_PLACES: [f64; 12] =
    [0.01, 0.08, 0.17, 0.26, 0.35, 0.44, 0.53, 0.62, 0.71, 0.82, 0.91, 0.99];

/// A proposal is worth settling when it is as good as this: proposals are good to about 1e-8.
const PROMISING: f64 = 1e-5;
/// Steps that settle it.
const STEPS: usize = 4;
/// Greatest size of a carrier beside the shape: beyond it, its distances have too few digits.
const MOST_SIZE: f64 = 1e3;
/// Least difference of the radii of a torus, as a share of the greater one.
const LEAST_HOLE: f64 = 0.01;

/// Points of the shape, with normals where it has some, in the order of [`PLACES`], the second direction running fastest.
pub struct Samples {
    points: Vec<Vector>,
    normals: Vec<(Vector, Vector)>,
}

/// Piece and local parameter at a share of `count` pieces.
fn place(share: f64, count: usize) -> (usize, f64) {
    let at = share * count as f64;
    let piece = (at as usize).min(count - 1);
    (piece, at - piece as f64)
}

impl Samples {
    /// The point at shares of the two directions.
    pub fn point(pieces: &Pieces, share: [f64; 2]) -> Vector {
        let ((row, s), (column, t)) =
            (place(share[0], pieces.rows), place(share[1], pieces.columns));
        let piece = (pieces.piece)(row * pieces.columns + column);
        add(piece.net.jet(s, t, [0.0; 3]).d, piece.center)
    }

    fn of_curve(pieces: &Pieces) -> Self {
        let points = CURVE_PLACES.map(|share| Self::point(pieces, [share, 0.0])).to_vec();
        Self { points, normals: Vec::new() }
    }

    fn of_surface(pieces: &Pieces) -> Self {
        let mut samples = Self { points: Vec::new(), normals: Vec::new() };
        for k in 0..PLACES.len() * PLACES.len() {
            let share = [PLACES[k / PLACES.len()], PLACES[k % PLACES.len()]];
            let (row, s) = place(share[0], pieces.rows);
            let (column, t) = place(share[1], pieces.columns);
            let piece = (pieces.piece)(row * pieces.columns + column);
            let jet = piece.net.jet(s, t, [0.0; 3]);
            let (point, normal) = (add(jet.d, piece.center), cross(jet.s, jet.t));
            samples.points.push(point);
            if dot(normal, normal) > 1e-16 * dot(jet.s, jet.s) * dot(jet.t, jet.t) {
                samples.normals.push((point, unit(normal)));
            }
        }
        samples
    }

    fn mean(&self) -> Vector {
        let sum = self.points.iter().fold([0.0; 3], |sum, p| add(sum, *p));
        scaled(sum, 1.0 / self.points.len() as f64)
    }
}

/// A kind of carrier through samples, if there is one.
type Proposal = fn(&Samples) -> Option<Carrier>;

/// The carrier of a shape, proven.
pub fn carrier(pieces: &Pieces) -> Option<Carrier> {
    let (samples, proposals): (_, &[Proposal]) = if pieces.is_curve {
        (Samples::of_curve(pieces), &[line, circle])
    } else {
        (Samples::of_surface(pieces), &[plane, cylinder, cone, sphere, torus])
    };
    proposals.iter().find_map(|propose| {
        let carrier = propose(&samples).filter(|c| c.size < MOST_SIZE)?;
        let settled = settled(carrier, &samples)?;
        proven(settled, pieces)
    })
}

fn made(kind: Kind, origin: Vector, axes: [Vector; 3]) -> Carrier {
    let radii = match kind {
        Kind::Line | Kind::Plane | Kind::Cone { .. } => 0.0,
        Kind::Circle { radius } | Kind::Cylinder { radius } | Kind::Sphere { radius } => radius,
        Kind::Torus { major, minor } => major + minor,
    };
    let size = norm(origin) + radii;
    let bounds = [[0.0; 2]; 2];
    Carrier { kind, origin, axes, bounds, sector: None, arc: None, deviation: 0.0, size }
}

/// The normal of the plane through the points.
fn flat_normal(samples: &Samples) -> Option<Vector> {
    let (mean, mut scatter) = (samples.mean(), [[0.0; 3]; 3]);
    samples.points.iter().for_each(|p| add_square(&mut scatter, &sub(*p, mean)));
    least_direction(&scatter)
}

fn line(samples: &Samples) -> Option<Carrier> {
    let mean = samples.mean();
    let away = |p: &&Vector| norm(sub(**p, mean));
    let far = samples.points.iter().max_by(|a, b| away(a).total_cmp(&away(b)))?;
    Some(made(Kind::Line, mean, any_frame(sub(*far, mean))))
}

fn circle(samples: &Samples) -> Option<Carrier> {
    let axes = any_frame(flat_normal(samples)?);
    let (origin, radius) = turned(&samples.points, samples.mean(), axes)?;
    Some(made(Kind::Circle { radius }, origin, axes))
}

fn plane(samples: &Samples) -> Option<Carrier> {
    Some(made(Kind::Plane, samples.mean(), any_frame(flat_normal(samples)?)))
}

/// Centre and radius of the circle through points seen along the third axis; the centre at the height of `near`.
fn turned(points: &[Vector], near: Vector, axes: [Vector; 3]) -> Option<(Vector, f64)> {
    let flat = |p: &Vector| [dot(axes[0], sub(*p, near)), dot(axes[1], sub(*p, near))];
    let (x, y, radius) = circle_through(points.iter().map(flat))?;
    Some((add(near, add(scaled(axes[0], x), scaled(axes[1], y))), radius))
}

/// Centre and radius of the circle through points of a plane.
fn circle_through(points: impl Iterator<Item = [f64; 2]>) -> Option<(f64, f64, f64)> {
    let row = |[x, y]: [f64; 2]| ([2.0 * x, 2.0 * y, 1.0], x * x + y * y);
    let [x, y, k] = fitted(points.map(row))?;
    let square = k + x * x + y * y;
    (square > 0.0).then(|| (x, y, square.sqrt()))
}

fn cylinder(samples: &Samples) -> Option<Carrier> {
    let mut scatter = [[0.0; 3]; 3];
    samples.normals.iter().for_each(|(_, n)| add_square(&mut scatter, n));
    let axes = any_frame(least_direction(&scatter)?);
    let (origin, radius) = turned(&samples.points, samples.mean(), axes)?;
    Some(made(Kind::Cylinder { radius }, origin, axes))
}

fn cone(samples: &Samples) -> Option<Carrier> {
    let normals = &samples.normals;
    let sum = normals.iter().fold([0.0; 3], |sum, (_, n)| add(sum, *n));
    let mean = scaled(sum, 1.0 / normals.len() as f64);
    let mut scatter = [[0.0; 3]; 3];
    normals.iter().for_each(|(_, n)| add_square(&mut scatter, &sub(*n, mean)));
    let axis = least_direction(&scatter)?;
    // All tangent planes pass through the tip.
    let near = samples.mean();
    let tip = fitted(normals.iter().map(|(p, n)| (*n, dot(*n, sub(*p, near)))))?;
    let up = if dot(axis, tip) > 0.0 { scaled(axis, -1.0) } else { axis };
    let sin = dot(axis, mean).abs();
    let cos = (1.0 - sin * sin).max(0.0).sqrt();
    Some(made(Kind::Cone { sin, cos }, add(near, tip), any_frame(up)))
}

fn sphere(samples: &Samples) -> Option<Carrier> {
    let mean = samples.mean();
    let row = |p: &Vector| {
        let [x, y, z] = sub(*p, mean);
        ([2.0 * x, 2.0 * y, 2.0 * z, 1.0], x * x + y * y + z * z)
    };
    let [x, y, z, k] = fitted(samples.points.iter().map(row))?;
    let square = k + x * x + y * y + z * z;
    let axes = any_frame([0.0, 0.0, 1.0]);
    (square > 0.0).then(|| made(Kind::Sphere { radius: square.sqrt() }, add(mean, [x, y, z]), axes))
}

fn torus(samples: &Samples) -> Option<Carrier> {
    let mean = samples.mean();
    let mut lines = [[0.0; 6]; 6];
    for (p, n) in &samples.normals {
        let m = cross(sub(*p, mean), *n);
        add_square(&mut lines, &[m[0], m[1], m[2], n[0], n[1], n[2]]);
    }
    let [a, b, c, d, e, f] = least_direction(&lines)?;
    let (axis, moment) = ([a, b, c], [d, e, f]);
    let origin = scaled(cross(axis, moment), 1.0 / dot(axis, axis));
    let axes = any_frame(axis);
    let half = |p: &Vector| {
        let v = sub(sub(*p, mean), origin);
        [norm([dot(axes[0], v), dot(axes[1], v), 0.0]), dot(axes[2], v)]
    };
    let (major, up, minor) = circle_through(samples.points.iter().map(half))?;
    let origin = add(add(mean, origin), scaled(axes[2], up));
    let ring = major - minor > LEAST_HOLE * major;
    ring.then(|| made(Kind::Torus { major, minor }, origin, axes))
}

/// A signed distance, its gradient in space and its derivatives in the (up to two) numbers of the kind.
type Residual = (f64, Vector, [f64; 2]);

impl Carrier {
    /// The residuals of a point in the carrier's frame; curves have two, surfaces one.
    fn residuals(&self, [x, y, z]: Vector) -> (Residual, Option<Residual>) {
        let rho = (x * x + y * y).sqrt();
        let out = [x / rho, y / rho, 0.0];
        let up: Residual = (z, [0.0, 0.0, 1.0], [0.0; 2]);
        match self.kind {
            Kind::Line => ((x, [1.0, 0.0, 0.0], [0.0; 2]), Some((y, [0.0, 1.0, 0.0], [0.0; 2]))),
            Kind::Circle { radius } => ((rho - radius, out, [-1.0, 0.0]), Some(up)),
            Kind::Plane => (up, None),
            Kind::Cylinder { radius } => ((rho - radius, out, [-1.0, 0.0]), None),
            Kind::Cone { sin, cos } => {
                let gradient = [cos * out[0], cos * out[1], -sin];
                ((rho * cos - z * sin, gradient, [-(rho * sin + z * cos), 0.0]), None)
            }
            Kind::Sphere { radius } => {
                let size = norm([x, y, z]);
                ((size - radius, [x, y, z].map(|x| x / size), [-1.0, 0.0]), None)
            }
            Kind::Torus { major, minor } => {
                let (away, d) = (rho - major, norm([rho - major, z, 0.0]));
                let gradient = [away * out[0] / d, away * out[1] / d, z / d];
                ((d - minor, gradient, [-away / d, -1.0]), None)
            }
        }
    }

    /// Greatest residual.
    fn misfit(&self, samples: &Samples) -> f64 {
        samples.points.iter().fold(0.0, |most: f64, p| {
            let (one, two) = self.residuals(self.local(*p));
            let size = one.0.abs() + two.map_or(0.0, |r| r.0.abs());
            if size.is_nan() { f64::INFINITY } else { most.max(size) }
        })
    }

    /// One step of least squares over moves, two turns and the numbers of the kind.
    fn improved(&self, samples: &Samples) -> Option<Self> {
        let (mut m, mut b) = ([[0.0; 7]; 7], [0.0; 7]);
        for point in &samples.points {
            let p = self.local(*point);
            let (one, two) = self.residuals(p);
            for (value, g, own) in [Some(one), two].into_iter().flatten() {
                let turn = cross(p, g);
                let row = [-g[0], -g[1], -g[2], -turn[0], -turn[1], own[0], own[1]];
                add_square(&mut m, &row);
                (0..7).for_each(|k| b[k] -= value * row[k]);
            }
        }
        let [x, y, z, turn_x, turn_y, first, second] = solved(&m, b)?;
        let [e, f, a] = self.axes;
        let origin = add(self.origin, add(scaled(e, x), add(scaled(f, y), scaled(a, z))));
        let axis = add(a, sub(scaled(e, turn_y), scaled(f, turn_x)));
        let kind = match self.kind {
            Kind::Line => Kind::Line,
            Kind::Plane => Kind::Plane,
            Kind::Circle { radius } => Kind::Circle { radius: radius + first },
            Kind::Cylinder { radius } => Kind::Cylinder { radius: radius + first },
            Kind::Sphere { radius } => Kind::Sphere { radius: radius + first },
            Kind::Torus { major, minor } => {
                Kind::Torus { major: major + first, minor: minor + second }
            }
            Kind::Cone { sin, cos } => {
                let [cos, sin, _] = unit([cos - first * sin, sin + first * cos, 0.0]);
                Kind::Cone { sin, cos }
            }
        };
        Some(made(kind, origin, frame(axis, e)))
    }
}

/// The proposal after a few steps of least squares, when that fits to rounding.
fn settled(proposal: Carrier, samples: &Samples) -> Option<Carrier> {
    let mut best = (proposal.misfit(samples), proposal);
    if best.0.is_nan() || best.0 > PROMISING {
        return None;
    }
    for _ in 0..STEPS {
        let next = best.1.improved(samples)?;
        let misfit = next.misfit(samples);
        if misfit.is_nan() || misfit >= best.0 {
            break;
        }
        best = (misfit, next);
    }
    let sound = match best.1.kind {
        Kind::Cone { sin, cos } => sin > 0.0 && cos > 0.0,
        Kind::Torus { major, minor } => minor > 0.0 && major - minor > LEAST_HOLE * major,
        Kind::Circle { radius } | Kind::Cylinder { radius } | Kind::Sphere { radius } => {
            radius > 0.0
        }
        Kind::Line | Kind::Plane => true,
    };
    (sound && best.0 <= MOST_DEVIATION).then_some(best.1)
}
