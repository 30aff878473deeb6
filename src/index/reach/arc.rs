//! A cell of a segment: where it lies, its tangent, its curvature vector.

use super::MARGIN;
use super::middles::Middle;
use super::oriented::Oriented;
use crate::bezier::{Bidegree, cut, derivative};
use crate::bounds::{Vector, add, cross, dot, norm, scaled, sub};
use crate::index::piece::{position_error, position_steps};
use crate::index::segment::Segment;

/// What is kept of a cell until all are there: a box around it, and its shape.
#[derive(Clone, Copy, Debug)]
pub struct Arc {
    pub bounds: Oriented,
    /// `None` where the derivative says nothing of the tangent.
    pub shape: Option<Bow>,
    /// Least heights of both ends along the outward tangent, over the middle of the box.
    pub tips: [f64; 2],
}

impl Arc {
    /// Where to begin in the cell.
    pub fn middle(&self) -> Middle {
        let step = self.shape.map_or([0.0; 3], |bow| scaled(bow.axes[0], 1.0 / bow.length));
        Middle { center: self.bounds.center, steps: [step, [0.0; 3]] }
    }
}

/// The shape of a cell.
#[derive(Clone, Copy, Debug)]
pub struct Bow {
    /// Unit vectors: a tangent, and two across.
    pub axes: [Vector; 3],
    /// Greatest distance of a unit tangent from the first axis, and of the axes across at a place from the others.
    pub cone: f64,
    /// The curvature vector in the middle, and how far others may be off.
    pub bend: Vector,
    pub off: f64,
    /// About its length.
    pub length: f64,
}

/// Cells into which a segment (`poles`: component by component) is cut, so that tangents turn by about `aim` in each, and
/// curvatures change by about its square root.
pub fn parts(poles: &[f64], p: usize, rational: bool, aim: f64) -> usize {
    let point = |i: usize| {
        let w = if rational { poles[3 * (p + 1) + i] } else { 1.0 };
        [0, 1, 2].map(|c| poles[c * (p + 1) + i] / w)
    };
    let legs: Vec<Vector> = (0..p).map(|i| sub(point(i + 1), point(i))).collect();
    let longest = legs.iter().fold(0.0, |most: f64, leg| most.max(norm(*leg)));
    let change = legs.windows(2).fold(0.0, |most: f64, pair| most.max(norm(sub(pair[1], pair[0]))));
    let share = change * (p - 1) as f64 / longest;
    if share > 0.0 { (share / aim).ceil() as usize } else { 1 }
}

/// Appends the cells of a segment.
pub fn push_arcs(
    poles: &[f64],
    p: usize,
    rational: bool,
    segment: &Segment,
    count: usize,
    out: &mut Vec<Arc>,
) {
    for k in 0..count {
        let mut piece = poles.to_vec();
        if count > 1 {
            let [low, high] = [0, 1].map(|n| (k + n) as f64 / count as f64);
            piece.chunks_exact_mut(p + 1).for_each(|row| cut(row, p, 1, 1, low, high));
        }
        out.push(arc(&piece, p, rational, segment));
    }
}

fn arc(poles: &[f64], p: usize, rational: bool, segment: &Segment) -> Arc {
    let weight = |i: usize| if rational { poles[3 * (p + 1) + i] } else { 1.0 };
    let point = |i: usize| [0, 1, 2].map(|c| poles[c * (p + 1) + i] / weight(i));
    let error = position_error(position_steps(p), rational, segment.radius, segment.radius, 2.0);
    let shape = bow(poles, p, rational, error);
    let axes = shape.map_or([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], |bow| bow.axes);
    let mut bounds = Oriented::around((0..=p).map(point), axes, error);
    let height = |i: usize| dot(sub(point(i), bounds.center), axes[0]);
    let tips = [-height(0), height(p)].map(|x| x - error - 1e-12 * segment.radius);
    bounds.center = add(segment.center, bounds.center);
    Arc { bounds, shape, tips }
}

/// The shape of a cell whose poles are off by `error`.
///
/// With `Q = X' W - X W'`, which is `W^2` times the derivative, the tangent is `T = Q / |Q|` and the curvature vector
/// `W^2 (Q' - T (T.Q')) / |Q|^2`: the derivative of `W^2` adds to `Q'` along T only.
fn bow(poles: &[f64], p: usize, rational: bool, error: f64) -> Option<Bow> {
    let (xyz, w) = poles.split_at(3 * (p + 1));
    let degree = Bidegree { s: 0, t: p };
    let (mut slopes, mut order) = (Vec::new(), degree.lowered(1));
    for component in xyz.chunks_exact(p + 1) {
        derivative(component, degree, 1, &mut slopes);
    }
    let mut weights = [1.0; 2];
    if rational {
        let mut slope = Vec::new();
        derivative(w, degree, 1, &mut slope);
        slopes = super::cell::quotient(xyz, w, degree, slopes, slope, order);
        order = order.times(degree);
        weights = super::oriented::extent(w.iter().copied());
    }
    let [least, most] = weights.map(|w| w * w);
    let n = order.t + 1;
    let first: Vec<Vector> = (0..n).map(|i| [0, 1, 2].map(|c| slopes[c * n + i])).collect();
    let second: Vec<Vector> =
        first.windows(2).map(|pair| scaled(sub(pair[1], pair[0]), order.t as f64)).collect();
    // Rounding: of the poles, by the factors of the differences.
    let blur = 16.0 * p as f64 * error * most * (most / least);
    let (q, spread) = ball(&first);
    let spread = spread + blur;
    let (x, change) = ball(&second);
    let change = change + 4.0 * blur * order.t as f64;
    let speed = norm(q);
    let sine = spread / speed * MARGIN;
    if sine.is_nan() || sine >= 0.7 {
        return None;
    }
    // The chord of an angle with that sine; axes are floats.
    let cone = (2.0 - 2.0 * (1.0 - sine * sine).sqrt()).sqrt() * MARGIN + 1e-6;
    let along = scaled(q, 1.0 / speed);
    let aside = sub(x, scaled(along, dot(x, along)));
    let factors = [least / (speed + spread).powi(2), most / (speed - spread).powi(2)];
    let (factor, uneven) = (0.5 * (factors[0] + factors[1]), 0.5 * (factors[1] - factors[0]));
    let bend = scaled(aside, factor);
    let off = factors[1] * (change + sine * norm(x)) + uneven * norm(aside);
    let off = off * MARGIN + 1e-9 * norm(bend);
    // What rounding leaves of a vector along the tangent is none across.
    let bent = norm(aside) > 1e-6 * norm(x);
    let across = floats(unit(if bent { aside } else { cross(along, least_axis(along)) })?)?;
    let axes = [along, across, cross(along, across)];
    off.is_finite().then_some(Bow { axes, cone, bend, off, length: 2.0 * speed / (least + most) })
}

/// The unit coordinate vector that is most across.
fn least_axis(v: Vector) -> Vector {
    let k = (0..3).fold(0, |k, n| if v[n].abs() < v[k].abs() { n } else { k });
    [0, 1, 2].map(|n| if n == k { 1.0 } else { 0.0 })
}

fn unit(v: Vector) -> Option<Vector> {
    let size = norm(v);
    (size > 1e-300 && size.is_finite()).then(|| scaled(v, 1.0 / size))
}

/// The vector as floats hold it, a unit vector again.
fn floats(v: Vector) -> Option<Vector> {
    unit(v.map(|x| f64::from(x as f32)))
}

/// A ball around points: their mean, and the greatest distance from it.
fn ball(list: &[Vector]) -> (Vector, f64) {
    if list.is_empty() {
        return ([0.0; 3], 0.0);
    }
    let sum = list.iter().fold([0.0; 3], |sum, x| add(sum, *x));
    let mean = scaled(sum, 1.0 / list.len() as f64);
    let spread = list.iter().fold(0.0, |most: f64, x| most.max(norm(sub(*x, mean))));
    (mean, spread * MARGIN)
}
