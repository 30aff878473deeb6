//! Elementary shapes given as NURBS: lines, circles, planes, cylinders, cones, spheres, ring tori.
//!
//! ```text
//!   fit        a few points and normals propose a carrier, least squares settle it        (`fit`)
//!   deviation  Bernstein coefficients prove that the whole shape lies along it            (`deviation`)
//!   nearest    distance of a query to the carrier, in closed form: a bound for the shape
//!   table      the carrier's nearest place -> piece and local parameters                  (`table`)
//! ```
//!
//! Recognition looks at points only: degree, knots, weights, poles and what was trimmed away play no part. What lies farther
//! than [`MOST_DEVIATION`] from every carrier has none, and is searched like any shape.
//!
//! References: Pratt, *Direct least-squares fitting of algebraic surfaces*, 1987; Lukács, Martin, Marshall, *Faithful
//! least-squares fitting of spheres, cylinders, cones and tori*, 1998.
//! Limits: tori that touch or cross themselves have no carrier; nor have shapes on whose lines of constant parameter the
//! carrier's own coordinates are not constant (their parameters are not found in closed form).

pub(crate) mod linear;

mod form;

mod fit;

mod deviation;

mod table;

mod extent;

use crate::bounds::{HALF_ULP, Vector, dot, norm, sub};
use crate::jet::BezierPatch;

pub use extent::Arc;
use extent::End;
pub use table::Table;

/// A vector of a plane.
type Direction = [f64; 2];

/// Greatest distance of a shape from its carrier, for a box diagonal of 1 to 2: a fifth of the default accuracy. Poles written
/// with twelve digits are that good; rounding of poles is far below.
pub const MOST_DEVIATION: f64 = 2e-11;

/// What a carrier is, in its own frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    /// The third axis (of curves).
    Line,
    /// About the third axis (of curves).
    Circle {
        /// Radius.
        radius: f64,
    },
    /// Perpendicular to the third axis.
    Plane,
    /// About the third axis.
    Cylinder {
        /// Radius.
        radius: f64,
    },
    /// The part of a cone about the third axis that lies on its positive side, tip in the origin.
    Cone {
        /// Sine of the half angle.
        sin: f64,
        /// Its cosine.
        cos: f64,
    },
    /// About the origin.
    Sphere {
        /// Radius.
        radius: f64,
    },
    /// About the third axis; it neither touches nor crosses itself.
    Torus {
        /// Radius of the circle of centres.
        major: f64,
        /// Radius of the tube.
        minor: f64,
    },
}

/// An elementary shape near which all points of a curve or surface lie. Lengths are the index's.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Carrier {
    /// What it is.
    pub kind: Kind,
    /// Origin of its frame.
    pub origin: Vector,
    /// Axes of its frame.
    pub axes: [Vector; 3],
    /// The carrier's points near the shape have their coordinates in here: planes x and y; in the second place lines and
    /// cylinders z, cones the length from the tip. Others do not use it.
    pub bounds: [[f64; 2]; 2],
    /// The angles about the third axis that the shape takes, when it does not go round.
    pub sector: Option<Arc>,
    /// The angles of the meridian that it takes, for spheres and tori.
    pub arc: Option<Arc>,
    /// No point of the shape is farther from the carrier.
    pub deviation: f64,
    /// Distance of the origin, plus radii: what the rounding of a distance is relative to.
    pub size: f64,
}

/// The place of a carrier that is nearest to a query.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// The distance.
    pub distance: f64,
    /// A carrier's point within `r` of the query is within `sqrt(spread (r^2 - distance^2))` of the place.
    pub spread: f64,
    /// The carrier's two coordinates of the place as directions in a plane: an angle is its own direction, a length `x`
    /// is (x, 1).
    pub towards: [[f64; 2]; 2],
}

/// Half ulps of a carrier's distance, relative to the lengths that meet in it.
const DISTANCE_STEPS: f64 = 64.0;

impl Carrier {
    /// A point in the carrier's frame.
    pub fn local(&self, point: Vector) -> Vector {
        let v = sub(point, self.origin);
        self.axes.map(|axis| dot(axis, v))
    }

    /// How far [`Place::distance`] may be off, for a query `size` from the origin of the index.
    pub fn rounding(&self, size: f64) -> f64 {
        DISTANCE_STEPS * HALF_ULP * (2.0 + size + self.size)
    }

    /// The nearest place to a query.
    pub fn nearest(&self, query: Vector) -> Place {
        let [x, y, z] = self.local(query);
        if self.kind != Kind::Plane {
            return self.nearest_turned([x, y], z);
        }
        let (a, b) = (self.clamped(x, 0), self.clamped(y, 1));
        let towards = [[a, 1.0], [b, 1.0]];
        Place { distance: norm([x - a, y - b, z]), spread: 1.0, towards }
    }

    fn clamped(&self, x: f64, k: usize) -> f64 {
        x.max(self.bounds[k][0]).min(self.bounds[k][1])
    }

    /// The nearest place of a shape of revolution: the half plane of the query, or that at the end of the sector, and in
    /// it the meridian.
    fn nearest_turned(&self, at: Direction, z: f64) -> Place {
        let rho = length(at);
        let whole = End { direction: at, along: rho, aside: 0.0, hold: 1.0 };
        let end = self.sector.and_then(|arc| arc.beyond(at)).unwrap_or(whole);
        let meridian = self.nearest_in_half_plane([end.along, z]);
        let turned = meridian.radius / (rho * end.hold);
        Place {
            distance: length([meridian.distance, end.aside]),
            spread: meridian.spread.max(turned),
            towards: [end.direction, meridian.towards],
        }
    }

    fn nearest_in_half_plane(&self, [rho, z]: Direction) -> Meridian {
        let on_line = |distance: Direction, radius: f64, end: f64| Meridian {
            distance: length(distance),
            spread: 1.0,
            radius,
            towards: [end, 1.0],
        };
        match self.kind {
            Kind::Cylinder { radius } => {
                let end = self.clamped(z, 1);
                on_line([rho - radius, z - end], radius, end)
            }
            Kind::Cone { sin, cos } => {
                let (along, height) = (rho * sin + z * cos, rho * cos - z * sin);
                let end = self.clamped(along, 1);
                on_line([height, along - end], end * sin, end)
            }
            Kind::Sphere { radius } => self.nearest_on_arc([rho, z], radius, 0.0),
            Kind::Torus { major, minor } => self.nearest_on_arc([rho - major, z], minor, major),
            Kind::Circle { radius } => {
                let towards = [0.0; 2];
                Meridian { distance: length([rho - radius, z]), spread: 0.0, radius, towards }
            }
            Kind::Line => {
                let end = self.clamped(z, 1);
                on_line([rho, z - end], 0.0, end)
            }
            // All of it: what of a plane is left is no sector, but a rectangle.
            Kind::Plane => on_line([z, 0.0], rho, rho),
        }
    }

    /// The nearest place of a circle about the origin, `out` from the axis, or of its arc.
    fn nearest_on_arc(&self, at: Direction, radius: f64, out: f64) -> Meridian {
        let size = length(at);
        match self.arc.and_then(|arc| arc.beyond(at)) {
            None => Meridian {
                distance: (size - radius).abs(),
                spread: radius / size,
                radius: out + radius * (at[0] / size),
                towards: at,
            },
            Some(end) => {
                let [x, y] = end.direction;
                Meridian {
                    distance: length([at[0] - radius * x, at[1] - radius * y]),
                    spread: radius / (size * end.hold),
                    radius: out + radius * x,
                    towards: end.direction,
                }
            }
        }
    }
}

/// The nearest place of a meridian in its half plane.
struct Meridian {
    distance: f64,
    /// As in [`Place`], within the half plane.
    spread: f64,
    /// Distance of the place from the axis.
    radius: f64,
    towards: Direction,
}

fn length([x, y]: Direction) -> f64 {
    (x * x + y * y).sqrt()
}

/// A Bezier piece, as the index has it. A curve is a surface whose second degree is 0.
pub struct Piece<'a> {
    /// Its poles.
    pub net: BezierPatch<'a>,
    /// Origin of the poles.
    pub center: Vector,
    /// How far the exact shape may be from what the poles say.
    pub error: f64,
}

/// The pieces of a shape: `rows` along s, `columns` along t, piece (a, b) has the number `a * columns + b`.
pub struct Pieces<'a> {
    /// Number along s.
    pub rows: usize,
    /// Number along t.
    pub columns: usize,
    /// Whether they are those of a curve.
    pub is_curve: bool,
    /// Piece by number.
    pub piece: &'a dyn Fn(usize) -> Piece<'a>,
}

/// A carrier with the way back to the pieces.
#[derive(Clone, Debug)]
pub struct Analytic {
    /// The carrier.
    pub carrier: Carrier,
    /// Rows, columns: from a direction of [`Place::towards`] to a piece in that direction and the parameter in it.
    pub tables: [Table; 2],
    /// Which direction of [`Place::towards`] belongs to rows; the other one belongs to columns.
    pub rows_first: bool,
    columns: usize,
}

impl Analytic {
    /// The carrier of a shape, if it has one.
    pub fn of(pieces: &Pieces) -> Option<Self> {
        let carrier = fit::carrier(pieces)?;
        let (carrier, tables, rows_first) = table::tables(carrier, pieces)?;
        let first = usize::from(!rows_first);
        let carrier = extent::trimmed(carrier, pieces, [&tables[first], &tables[1 - first]]);
        Some(Self { carrier, tables, rows_first, columns: pieces.columns })
    }

    /// The piece and local parameters of a place.
    pub fn locate(&self, place: &Place) -> (usize, [f64; 2]) {
        let own = usize::from(!self.rows_first);
        let (row, s) = self.tables[0].find(place.towards[own]);
        let (column, t) = self.tables[1].find(place.towards[1 - own]);
        (row * self.columns + column, [s, t])
    }

    /// Bytes held.
    pub fn memory(&self) -> usize {
        size_of::<Self>() + self.tables.iter().map(Table::memory).sum::<usize>()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bounds::{add, scaled};

    fn direction(angle: f64) -> Direction {
        [angle.cos(), angle.sin()]
    }

    fn carrier(kind: Kind, sector: [f64; 2], arc: [f64; 2]) -> Carrier {
        let between = |[a, b]: [f64; 2]| Arc::new(direction(a), direction(b));
        Carrier {
            kind,
            origin: [0.3, -0.2, 0.1],
            axes: linear::any_frame([1.0, 2.0, -0.7]),
            bounds: [[-1.0, 0.5], [0.2, 0.9]],
            sector: Some(between(sector)),
            arc: Some(between(arc)),
            deviation: 0.0,
            size: 2.0,
        }
    }

    /// The point of a carrier with two coordinates given as directions.
    fn point(carrier: &Carrier, towards: [Direction; 2]) -> Vector {
        let unit = |a: Direction| a.map(|x| x / length(a));
        let ([x, y], [a, b]) = (unit(towards[0]), unit(towards[1]));
        let (rho, z) = match carrier.kind {
            Kind::Cylinder { radius } => (radius, towards[1][0]),
            Kind::Cone { sin, cos } => (towards[1][0] * sin, towards[1][0] * cos),
            Kind::Sphere { radius } => (radius * a, radius * b),
            Kind::Torus { major, minor } => (major + minor * a, minor * b),
            _ => unreachable!("not asked"),
        };
        let own = [rho * x, rho * y, z];
        (0..3).fold(carrier.origin, |p, k| add(p, scaled(carrier.axes[k], own[k])))
    }

    #[test]
    fn nothing_on_a_carrier_is_nearer_than_its_place_and_what_is_as_near_is_around_it() {
        let kinds = [
            Kind::Cylinder { radius: 0.7 },
            Kind::Cone { sin: 0.6, cos: 0.8 },
            Kind::Sphere { radius: 0.9 },
            Kind::Torus { major: 0.8, minor: 0.3 },
        ];
        let mut seed = 3u64;
        let mut random = |low: f64, high: f64| {
            seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            low + (high - low) * (seed >> 11) as f64 / (1u64 << 53) as f64
        };
        for round in 0..2000 {
            let kind = kinds[round % 4];
            let from = random(0.0, 6.0);
            let sector = [from, from + random(0.2, 5.8)];
            let low = if round % 4 == 2 { random(-1.5, 0.0) } else { random(0.0, 6.0) };
            let way = if round % 4 == 2 { random(0.2, 1.5) } else { random(0.2, 5.8) };
            let (arc, carrier) = ([low, low + way], carrier(kind, sector, [low, low + way]));
            let query = [0, 1, 2].map(|_| random(-1.5, 1.5));
            let place = carrier.nearest(query);
            let foot = point(&carrier, place.towards);
            assert!((norm(sub(foot, query)) - place.distance).abs() < 1e-14, "{carrier:?}");
            for _ in 0..100 {
                let along = |[a, b]: [f64; 2], share: f64| direction(a + share * (b - a));
                let second = match kind {
                    Kind::Cylinder { .. } | Kind::Cone { .. } => [random(0.2, 0.9), 1.0],
                    _ => along(arc, random(0.0, 1.0)),
                };
                let other = point(&carrier, [along(sector, random(0.0, 1.0)), second]);
                let (way, move_) = (sub(other, query), sub(other, foot));
                let over = dot(way, way) - place.distance * place.distance;
                assert!(over > -1e-13, "{carrier:?} {query:?}");
                let most = place.spread * (over + 1e-13) * (1.0 + 1e-9);
                assert!(dot(move_, move_) <= most + 1e-13, "{carrier:?} {query:?} {other:?}");
            }
        }
    }
}
