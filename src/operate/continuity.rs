//! How smooth a shape is at its knots, measured, not read from multiplicities.
//!
//! At a knot the derivatives of the two pieces are compared. A jump of the derivative of order k counts when it is more than `tolerance` times
//!
//! ```text
//!   p! / (p-k)! d / h^k      d the diagonal of the poles around the knot, h the shorter of the spans beside it
//! ```
//!
//! what a derivative of that order can be; what rounding leaves is some units of this times 2^-53.

use super::{Direction, Surface};
use crate::basis;
use crate::bounds::{Aabb, Vector, cross, dot, norm, scaled, sub};
use crate::curve::Curve;
use crate::error::Error;
use crate::knots::{Knots, Side};
use crate::portable::SameDigits;

/// How the pieces of a curve meet at a knot.
#[derive(Clone, Debug, PartialEq)]
pub struct Joint {
    /// The knot. The seam of a closed curve is reported at the end of the domain.
    pub u: f64,
    /// How often it is a knot.
    pub multiplicity: usize,
    /// The highest order to which all derivatives agree: 0 for a mere join. At most the degree; the degree means one polynomial
    /// on both sides (for rational curves: derivatives to that order agree).
    pub order: usize,
    /// Lengths of the jumps of the derivatives of order 0 to the degree.
    pub jumps: Vec<f64>,
    /// Angle of the tangents in radians; NaN beside a cusp, where a tangent is not defined.
    pub tangent_angle: f64,
    /// Length of the jump of the curvature vector, in 1 / length; NaN beside a cusp.
    pub curvature_jump: f64,
}

/// How the pieces of a surface meet along a knot line.
#[derive(Clone, Debug, PartialEq)]
pub struct Crease {
    /// The knot. The seam of a closed surface is reported at the end of the domain.
    pub value: f64,
    /// How often it is a knot.
    pub multiplicity: usize,
    /// The highest order to which all derivatives across the line agree all along it; of rational surfaces: of the homogeneous form.
    pub order: usize,
    /// Bounds of the jumps of the derivatives of order 0 to the degree along the whole line: the hull of the jump. Of rational
    /// surfaces: of the homogeneous form with weights at most 1, around a pole.
    pub jumps: Vec<f64>,
}

impl Curve {
    /// How the pieces meet at each knot inside the domain, and at the seam if the curve is closed.
    ///
    /// # Errors
    /// A tolerance that is not between 0 and 1.
    pub fn continuity(&self, tolerance: f64) -> Result<Vec<Joint>, Error> {
        check(tolerance)?;
        let knots = self.knots();
        let (start, end) = knots.domain();
        let mut out: Vec<Joint> =
            inner(knots).into_iter().map(|u| self.joint([u, u], tolerance)).collect();
        if self.is_closed() {
            out.push(self.joint([end, start], tolerance));
        }
        Ok(out)
    }

    /// What derivatives can be on some spans.
    fn size(&self, spans: [usize; 2]) -> Size {
        let degree = self.degree();
        let mut bounds = Aabb::EMPTY;
        let poles = spans.into_iter().flat_map(|span| &self.poles()[span - degree..=span]);
        poles.for_each(|pole| bounds.include(*pole));
        Size { diagonal: bounds.diagonal(), step: step(self.knots(), spans), degree }
    }

    fn joint(&self, [before, behind]: [f64; 2], tolerance: f64) -> Joint {
        let p = self.degree();
        let mut sides = [vec![[0.0; 3]; p.max(2) + 1], vec![[0.0; 3]; p.max(2) + 1]];
        self.derivatives_on(before, Side::Below, p.max(2), &mut sides[0]);
        self.derivatives_on(behind, Side::Above, p.max(2), &mut sides[1]);
        let [a, b] = &sides;
        let jumps: Vec<f64> = (0..=p).map(|k| norm(sub(a[k], b[k]))).collect();
        let spans = [self.knots().span_on(before, Side::Below), self.knots().span(behind)];
        let size = self.size(spans);
        let [t, s] = [a[1], b[1]];
        let (tangent_angle, curvature_jump) = match (norm(t), norm(s)) {
            (x, y) if x <= tolerance * size.of(1) || y <= tolerance * size.of(1) => {
                (f64::NAN, f64::NAN)
            }
            _ => (
                norm(cross(t, s)).arctangent_over(dot(t, s)),
                norm(sub(curvature_vector(a), curvature_vector(b))),
            ),
        };
        Joint {
            u: before,
            multiplicity: self.knots().multiplicity(before),
            order: size.order(&jumps, tolerance),
            jumps,
            tangent_angle,
            curvature_jump,
        }
    }
}

impl Surface {
    /// How the pieces meet along each knot line of a direction inside the domain, and along the seam if the surface is closed.
    ///
    /// # Errors
    /// A tolerance that is not between 0 and 1.
    pub fn continuity(&self, direction: Direction, tolerance: f64) -> Result<Vec<Crease>, Error> {
        check(tolerance)?;
        let knots = self.knots(direction);
        let net = self.homogeneous(direction)?;
        let (start, end) = knots.domain();
        let mut out: Vec<Crease> =
            inner(knots).into_iter().map(|u| crease(knots, &net, [u, u], tolerance)).collect();
        let is_closed = match direction {
            Direction::U => self.is_closed_u(),
            Direction::V => self.is_closed_v(),
        };
        if is_closed {
            out.push(crease(knots, &net, [end, start], tolerance));
        }
        Ok(out)
    }

    /// Strands of homogeneous poles around one of them, with weights at most 1.
    fn homogeneous(&self, direction: Direction) -> Result<Vec<[f64; 4]>, Error> {
        let strands = self.strands(direction)?;
        let centre = strands[strands.len() / 2].pole;
        let top = match self.is_rational() {
            true => strands.iter().fold(0.0, |top: f64, point| top.max(point.weight)),
            false => 0.0,
        };
        let raise = |w: f64, [x, y, z]: Vector| [w * x, w * y, w * z, w];
        Ok(strands
            .iter()
            .map(|point| {
                let w = if top > 0.0 { point.weight / top } else { 1.0 };
                raise(w, sub(point.pole, centre))
            })
            .collect())
    }
}

/// What derivatives can be around a knot.
struct Size {
    diagonal: f64,
    step: f64,
    degree: usize,
}

impl Size {
    fn of(&self, order: usize) -> f64 {
        let falling = (0..order).map(|k| self.degree.saturating_sub(k).max(1) as f64);
        falling.fold(self.diagonal, |size, factor| size * factor / self.step)
    }

    fn order(&self, jumps: &[f64], tolerance: f64) -> usize {
        let agree = |&(k, jump): &(usize, &f64)| *jump <= tolerance * self.of(k);
        jumps.iter().enumerate().take_while(agree).count().max(1) - 1
    }
}

fn check(tolerance: f64) -> Result<(), Error> {
    if (0.0..=1.0).contains(&tolerance) {
        return Ok(());
    }
    Err(Error::InvalidArgument(format!("tolerance: {tolerance} is not between 0 and 1")))
}

/// The knots inside the domain, each once.
fn inner(knots: &Knots) -> Vec<f64> {
    let (start, end) = knots.domain();
    let mut out: Vec<f64> =
        knots.values().iter().copied().filter(|&u| start < u && u < end).collect();
    out.dedup();
    out
}

/// The shorter of two spans.
fn step(knots: &Knots, spans: [usize; 2]) -> f64 {
    let [a, b] = spans.map(|i| knots.values()[i + 1] - knots.values()[i]);
    a.min(b)
}

/// `C'' / |C'|^2` without its part along the tangent.
fn curvature_vector(derivatives: &[Vector]) -> Vector {
    let (first, second) = (derivatives[1], derivatives[2]);
    let square = dot(first, first);
    let normal = sub(second, scaled(first, dot(first, second) / square));
    scaled(normal, 1.0 / square)
}

fn crease(knots: &Knots, net: &[[f64; 4]], places: [f64; 2], tolerance: f64) -> Crease {
    let p = knots.degree();
    let spans = [knots.span_on(places[0], Side::Below), knots.span(places[1])];
    let rows = [0, 1].map(|side| {
        let mut rows = vec![0.0; (p + 1) * (p + 1)];
        basis::derivatives(knots, spans[side], places[side], p, &mut rows);
        rows
    });
    let mut jumps = vec![0.0_f64; p + 1];
    let (mut low, mut high) = ([f64::INFINITY; 4], [f64::NEG_INFINITY; 4]);
    for strand in net.chunks_exact(knots.pole_count()) {
        for (k, jump) in jumps.iter_mut().enumerate() {
            let mut apart = [0.0; 4];
            for side in 0..2 {
                let local = &strand[spans[side] - p..=spans[side]];
                let sign = [1.0, -1.0][side];
                for (n, h) in rows[side][k * (p + 1)..].iter().zip(local) {
                    apart = std::array::from_fn(|x| apart[x] + sign * n * h[x]);
                }
            }
            *jump = jump.max(apart.iter().map(|x| x * x).sum::<f64>().sqrt());
        }
        for h in spans.iter().flat_map(|span| &strand[span - p..=*span]) {
            low = std::array::from_fn(|x| low[x].min(h[x]));
            high = std::array::from_fn(|x| high[x].max(h[x]));
        }
    }
    let diagonal = (0..4).map(|x| (high[x] - low[x]).powi(2)).sum::<f64>().sqrt();
    let size = Size { diagonal, step: step(knots, spans), degree: p };
    let multiplicity = knots.multiplicity(places[0]);
    Crease { value: places[0], multiplicity, order: size.order(&jumps, tolerance), jumps }
}

/// Second derivatives below this share of what they can be are rounding.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// The moving frame of a curve and how it turns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// The point.
    pub point: Vector,
    /// Length of the first derivative.
    pub speed: f64,
    /// Unit tangent; NaN where the first derivative is 0.
    pub tangent: Vector,
    /// Unit vector towards the centre of curvature; NaN where the curvature is 0 or not defined.
    pub normal: Vector,
    /// Tangent x normal; NaN where the normal is.
    pub binormal: Vector,
    /// Curvature, not negative, in 1 / length; NaN where the first derivative is 0.
    pub curvature: f64,
    /// Torsion, positive for right-handed screws, in 1 / length; NaN where the curvature is 0 or not defined.
    pub torsion: f64,
}

impl Curve {
    /// Tangent, normals, curvature and torsion at `u` in the domain, of the piece on one side of a knot.
    ///
    /// # Errors
    /// `u` is outside the domain.
    pub fn frame(&self, u: f64, side: Side) -> Result<Frame, Error> {
        if !self.knots().contains(u) {
            return Err(Error::InvalidArgument(format!("u: {u} is outside the domain")));
        }
        let mut d = [[0.0; 3]; 4];
        self.derivatives_on(u, side, 3, &mut d);
        let (speed, across) = (norm(d[1]), cross(d[1], d[2]));
        let span = self.knots().span_on(u, side);
        let area = norm(across);
        // What rounding of the second derivative leaves has no direction.
        let is_straight = area <= ROUNDING * speed * self.size([span; 2]).of(2);
        let unit = |v: Vector, length: f64| v.map(|x| x / length);
        let curvature = if speed > 0.0 { area / speed / speed / speed } else { f64::NAN };
        let tangent = if speed > 0.0 { unit(d[1], speed) } else { [f64::NAN; 3] };
        let (binormal, torsion) = if is_straight {
            ([f64::NAN; 3], f64::NAN)
        } else {
            (unit(across, area), dot(across, d[3]) / area / area)
        };
        let normal = cross(binormal, tangent);
        Ok(Frame { point: d[0], speed, tangent, normal, binormal, curvature, torsion })
    }
}
