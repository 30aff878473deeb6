//! How far a shape may lie from a carrier: a bound over every piece, from Bernstein coefficients.
//!
//! ```text
//!   plane, line      heights of the poles
//!   sphere, cylinder | rho^2 - R^2 |             <= e    =>    | rho - R | <= e / R
//!   cone             | (rho c)^2 - (z s)^2 |     <= e z  =>    | rho c - z s | <= e / s
//!   torus            | (d^2 - r^2)(d'^2 - r^2) | <= e    =>    | d - r | <= e / (r (R^2 - r^2))
//! ```
//!
//! `d`, `d'` are the distances to the nearest and the farthest point of the torus's circle: `d' >= R`. In a cone's tip the
//! poles are divided by the parameter that leads there. `docs/rounding.md`, section 16, has the derivations.

use super::form::{Form, MOST_DEGREE};
use super::{Carrier, Kind, MOST_DEVIATION, Piece, Pieces};
use crate::bezier::Bidegree;
use crate::bounds::{HALF_ULP, dot, norm, sub};

/// Half ulps of a pole's move into the carrier's frame, relative to its distance: 20 for the frame, 8 for what is done.
const MOVE_STEPS: f64 = 40.0;

/// Poles nearer to a cone's tip, or to the axis of a sector, than this are moved there: far from the origin, rounding of
/// poles is not far below. What they move is added to the deviation.
pub const TIP: f64 = 4e-12;

/// The poles of a piece in the carrier's frame.
pub struct Moved {
    /// Homogeneous x, y, z, and weights.
    pub poles: [Vec<f64>; 4],
    degree: Bidegree,
    /// How far the exact shape may be from them.
    error: f64,
}

impl Moved {
    /// Moves a piece.
    pub fn new(piece: &Piece, carrier: &Carrier) -> Self {
        let (net, count) = (&piece.net, piece.net.degree.count());
        let shift = sub(piece.center, carrier.origin);
        let mut poles: [Vec<f64>; 4] = Default::default();
        let mut size = 0.0f64;
        for k in 0..count {
            let w = if net.rational { net.poles[3 * count + k] } else { 1.0 };
            let pole = [0, 1, 2].map(|c| net.poles[c * count + k]);
            size = size.max(norm(pole) / w);
            let pole = [0, 1, 2].map(|c| pole[c] + w * shift[c]);
            (0..3).for_each(|c| poles[c].push(dot(carrier.axes[c], pole)));
            poles[3].push(w);
        }
        let error = piece.error + MOVE_STEPS * HALF_ULP * (size + norm(shift) + carrier.size);
        Self { poles, degree: net.degree, error }
    }

    fn form(&self, c: usize) -> Form {
        Form::exact(self.degree, self.poles[c].clone())
    }

    /// Least and greatest of a coordinate.
    fn range(&self, c: usize) -> [f64; 2] {
        let ratios = self.poles[c].iter().zip(&self.poles[3]).map(|(x, w)| x / w);
        ratios.fold([f64::INFINITY, f64::NEG_INFINITY], |r, x| [r[0].min(x), r[1].max(x)])
    }

    /// Greatest absolute height.
    fn height(&self) -> f64 {
        let [low, high] = self.range(2);
        low.abs().max(high.abs())
    }

    /// Greatest distance from the third axis.
    fn axis_distance(&self) -> f64 {
        let [x, y, _, w] = &self.poles;
        (0..w.len()).map(|k| norm([x[k] / w[k], y[k] / w[k], 0.0])).fold(0.0, f64::max)
    }

    /// Least and greatest distance from the third axis; none when the weight is not proven positive.
    pub fn axis_range(&self) -> Option<[f64; 2]> {
        let w = self.form(3);
        let (across, weights) =
            (Form::sum_of_squares(&[&self.form(0), &self.form(1)]), w.times(&w));
        let [low, high] = across.range_over(&weights)?;
        Some([low.max(0.0).sqrt(), high.sqrt()])
    }

    /// A bound of `|sum of the first squares - radius^2|` over the weight's.
    fn square_defect(&self, components: usize, radius: f64) -> Option<f64> {
        let forms: Vec<Form> = (0..components).map(|c| self.form(c)).collect();
        let w = self.form(3);
        let squares = Form::sum_of_squares(&forms.iter().collect::<Vec<_>>());
        let weights = w.times(&w);
        squares.plus(-radius * radius, &weights).most_over(&weights)
    }

    /// Moves the poles of a side that lies in the tip onto it; the side.
    fn settle_tip(&mut self) -> Option<usize> {
        let width = self.degree.t + 1;
        let last = [self.degree.s, self.degree.t];
        let on = |side: usize, k: usize| {
            let at = if side < 2 { k / width } else { k % width };
            at == if side.is_multiple_of(2) { 0 } else { last[side / 2] }
        };
        let away = |k: usize| norm([0, 1, 2].map(|c| self.poles[c][k])) / self.poles[3][k];
        let count = self.degree.count();
        let most = |side: usize| (0..count).filter(|&k| on(side, k)).map(away).fold(0.0, f64::max);
        let side = (0..4).find(|&side| most(side) <= TIP && last[side / 2] > 0)?;
        self.error += most(side);
        for k in (0..count).filter(|&k| on(side, k)) {
            (0..3).for_each(|c| self.poles[c][k] = 0.0);
        }
        Some(side)
    }

    fn cone_defect(&mut self, sin: f64, cos: f64) -> Option<f64> {
        let tip = self.settle_tip();
        let divided = |form: Form| tip.map_or(form.clone(), |side| form.divided_by_side(side));
        let [x, y, z] = [0, 1, 2].map(|c| divided(self.form(c)));
        if !z.is_positive() {
            return None;
        }
        let across = Form::sum_of_squares(&[&x, &y]);
        let mut defect = across.scaled(cos * cos).plus(-sin * sin, &z.times(&z));
        if let Some(side) = tip {
            defect = defect.elevated(side / 2);
        }
        defect.most_over(&z.times(&self.form(3))).map(|e| e / sin)
    }

    fn torus_defect(&self, major: f64, minor: f64) -> Option<f64> {
        let [x, y, z, w] = [0, 1, 2, 3].map(|c| self.form(c));
        let (weights, height) = (w.times(&w), z.times(&z));
        // All terms are of the size of the tube, whose thinness so costs no digits.
        let radii = major * major + minor * minor;
        let out = Form::sum_of_squares(&[&x, &y, &z]).plus(-radii, &weights);
        let up = height.plus(-minor * minor, &weights);
        let defect = out.times(&out).plus(4.0 * major * major, &up.times(&weights));
        let most = defect.most_over(&weights.times(&weights))?;
        Some(most / (minor * (major - minor) * (major + minor)))
    }

    /// A bound of the distance of every point from the carrier.
    fn deviation(&mut self, kind: Kind) -> Option<f64> {
        let own = match kind {
            Kind::Line => Some(self.axis_distance()),
            Kind::Plane => Some(self.height()),
            Kind::Circle { radius } => {
                self.square_defect(2, radius).map(|e| e / radius + self.height())
            }
            Kind::Cylinder { radius } => self.square_defect(2, radius).map(|e| e / radius),
            Kind::Sphere { radius } => self.square_defect(3, radius).map(|e| e / radius),
            Kind::Cone { sin, cos } => self.cone_defect(sin, cos),
            Kind::Torus { major, minor } => self.torus_defect(major, minor),
        };
        // Quotients, products and roots above: a few half ulps.
        own.map(|own| own * (1.0 + 1e-9) + self.error)
    }
}

/// How many coordinates are multiplied in the form of a kind.
fn order(kind: Kind) -> usize {
    match kind {
        Kind::Line | Kind::Plane => 1,
        Kind::Torus { .. } => 4,
        _ => 2,
    }
}

/// The carrier with its deviation and bounds, when every piece is proven to lie along it.
pub fn proven(mut carrier: Carrier, pieces: &Pieces) -> Option<Carrier> {
    let nothing = [f64::INFINITY, f64::NEG_INFINITY];
    let mut bounds = [nothing; 3];
    carrier.deviation = 0.0;
    for k in 0..pieces.rows * pieces.columns {
        let piece = (pieces.piece)(k);
        let degree = piece.net.degree;
        if order(carrier.kind) * degree.s.max(degree.t) > MOST_DEGREE {
            return None;
        }
        let mut moved = Moved::new(&piece, &carrier);
        let deviation = moved.deviation(carrier.kind)?;
        if deviation.is_nan() || deviation > MOST_DEVIATION {
            return None;
        }
        carrier.deviation = carrier.deviation.max(deviation);
        for c in 0..3 {
            let [low, high] = moved.range(c);
            bounds[c] = [bounds[c][0].min(low), bounds[c][1].max(high)];
        }
    }
    carrier.bounds = bounds_of(&carrier, bounds);
    Some(carrier)
}

/// Where the carrier's points near the shape lie, from the ranges of x, y, z of all poles.
///
/// A point of the shape is within the deviation of one of the carrier, and its coordinates are off by less than that; a
/// quotient's rounding is covered by the second one.
fn bounds_of(carrier: &Carrier, bounds: [[f64; 2]; 3]) -> [[f64; 2]; 2] {
    let margin = 2.0 * carrier.deviation;
    let [x, y, z] = bounds.map(|[low, high]| [low - margin, high + margin]);
    match carrier.kind {
        Kind::Plane => [x, y],
        Kind::Cone { cos, .. } => {
            let along = z.map(|z| z / cos);
            [along, [along[0].max(0.0), along[1]]]
        }
        _ => [z, z],
    }
}
