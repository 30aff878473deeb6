//! Hausdorff distance between two shapes, between two bounds.
//!
//! ```text
//!   a box of the one shape: its corners' feet on the other
//!   any point of the box  <=  greatest corner distance            the mean of the corners with the bilinear weights
//!                           + how far the box is from that mean   second derivatives of the one
//!                           + how far the mean of the feet is     second derivatives of the other between the feet
//! ```
//!
//! Both rests shrink with the square of the box; where feet jump (seams, medial axes), distance from a corner bounds the box.
//! Distances to the other shape come with proven bounds from `closest`.
//!
//! Reference: Kim, Oh, Yoon, Kim, Elber, *Precise Hausdorff distance computation for planar freeform curves using biarcs and
//! depth buffer*, 2010, for branch and bound; the bound with corners' feet is ours.
//! Limit: two shapes that are nearly equal and parametrised differently take boxes in the inverse of the asked gap.

use super::cell::Piece;
use super::request::{patch_piece, segment_piece};
use crate::bezier::cut_2d;
use crate::bounds::{HALF_ULP, Vector, add, norm, scaled, sub};
use crate::closest::{FootPoint, QueryOptions, Workspace};
use crate::error::Error;
use crate::index::{Frame, IndexedCurve, IndexedSurface, Span};
use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// A curve or a surface.
#[derive(Clone, Copy, Debug)]
pub enum Shape<'a> {
    /// A curve.
    Curve(&'a IndexedCurve),
    /// A surface.
    Surface(&'a IndexedSurface),
}

/// How far to go.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct HausdorffOptions {
    /// Allowed gap between the bounds, length. 0: 1e-3 of the box diagonal of the first shape.
    pub accuracy: f64,
    /// Most boxes for each direction; 0: 50000.
    pub budget: u64,
}

/// The greatest distance of a point of one shape from the other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Directed {
    /// Some point is not nearer than this to the other shape.
    pub lower: f64,
    /// No point is farther than this from the other shape.
    pub upper: f64,
    /// Parameters of that point.
    pub at: [f64; 2],
    /// Whether the gap is the allowed one.
    pub proven: bool,
    /// Boxes looked at.
    pub boxes: u64,
}

/// The Hausdorff distance: the greater of both directions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hausdorff {
    /// From the first shape to the second.
    pub forward: Directed,
    /// From the second shape to the first.
    pub backward: Directed,
}

impl Hausdorff {
    /// Proven lower and upper bound.
    pub fn bounds(&self) -> [f64; 2] {
        [self.forward.lower.max(self.backward.lower), self.forward.upper.max(self.backward.upper)]
    }
}

/// Boxes by default.
const BUDGET: u64 = 50_000;

/// Least part of a piece over which second derivatives are bounded.
const LEAST_PART: f64 = 1.0 / 64.0;

/// A piece with its parameters.
struct Part<'a> {
    piece: Piece<'a>,
    spans: [Span; 2],
    center: Vector,
}

/// The pieces of a shape; those of a curve have one parameter, t.
struct Parts<'a> {
    shape: Shape<'a>,
    frame: Frame,
    parts: Vec<Part<'a>>,
    /// Parameters of both directions at which first derivatives may jump.
    breaks: [Vec<f64>; 2],
    has_s: bool,
    magnitude: f64,
}

/// Inner knots at which a shape may have a tangent break.
fn breaks(knots: &crate::knots::Knots) -> Vec<f64> {
    let mut found: Vec<f64> = knots.values().to_vec();
    let (start, end) = knots.domain();
    found.retain(|&u| start < u && u < end && knots.multiplicity(u) >= knots.degree());
    found.dedup();
    found
}

impl<'a> Parts<'a> {
    fn new(shape: Shape<'a>, poll: &mut dyn FnMut() -> bool) -> Result<Self, Error> {
        let nothing = Span { ends: [0.0; 2], balance: 1.0 };
        let (frame, parts, breaks, has_s) = match shape {
            Shape::Curve(curve) => {
                let index = curve.index(poll)?;
                let part = |k: usize| Part {
                    piece: segment_piece(index, k),
                    spans: [nothing, index.segments[k].u],
                    center: index.segments[k].center,
                };
                let parts = (0..index.segments.len()).map(part).collect();
                (index.frame, parts, [Vec::new(), breaks(curve.curve().knots())], false)
            }
            Shape::Surface(surface) => {
                let index = surface.index(poll)?;
                let part = |k: usize| Part {
                    piece: patch_piece(index, k),
                    spans: [index.patches[k].u, index.patches[k].v],
                    center: index.patches[k].center,
                };
                let parts = (0..index.patches.len()).map(part).collect();
                let knots = [surface.surface().knots_u(), surface.surface().knots_v()];
                (index.frame, parts, knots.map(breaks), true)
            }
        };
        let magnitude = frame.magnitude;
        Ok(Self { shape, frame, parts, breaks, has_s, magnitude })
    }

    fn closest(&self, q: Vector, hint: Option<[f64; 2]>, work: &mut Workspace) -> FootPoint {
        let options = QueryOptions::default();
        match self.shape {
            Shape::Curve(curve) => curve.closest(q, hint.map(|at| at[1]), &options, work, None),
            Shape::Surface(surface) => surface.closest(q, hint, &options, work, None),
        }
    }

    /// Parameters of a foot, those of a curve second.
    fn place(&self, foot: &FootPoint) -> [f64; 2] {
        if self.has_s { [foot.u, foot.v] } else { [0.0, foot.u] }
    }

    fn evaluate(&self, [u, v]: [f64; 2]) -> Vector {
        match self.shape {
            Shape::Curve(curve) => curve.curve().evaluate(v),
            Shape::Surface(surface) => surface.surface().evaluate(u, v),
        }
    }

    /// Greatest rounding of a point, in the caller's lengths.
    fn rounding(&self) -> f64 {
        let piece = self.parts.iter().map(|p| p.piece.error).fold(0.0, f64::max);
        4.0 * piece / self.frame.scale + 16.0 * HALF_ULP * self.magnitude
    }

    /// Bound of how far the mean of points is from the point of the mean parameters, for parameters within these
    /// intervals; infinite when the shape may have a tangent break between them.
    fn bend_between(&self, low: [f64; 2], high: [f64; 2]) -> f64 {
        let broken = |k: usize| self.breaks[k].iter().any(|x| low[k] < *x && *x < high[k]);
        if broken(0) || broken(1) {
            return f64::INFINITY;
        }
        let mut worst = 0.0f64;
        for part in &self.parts {
            let meets =
                |k: usize| part.spans[k].ends[0] <= high[k] && low[k] <= part.spans[k].ends[1];
            if !((!self.has_s || meets(0)) && meets(1)) {
                continue;
            }
            let (mut boxes, mut shares) = ([[0.0, 1.0]; 2], [0.0; 2]);
            for k in usize::from(!self.has_s)..2 {
                let span = part.spans[k];
                if span.balance != 1.0 {
                    return f64::INFINITY;
                }
                let [a, b] = span.cover([low[k], high[k]]);
                let widen = (0.5 * (LEAST_PART - (b - a))).max(0.0);
                boxes[k] = [(a - widen).max(0.0), (b + widen).min(1.0)];
                let length = (span.ends[1] - span.ends[0]) * (boxes[k][1] - boxes[k][0]);
                shares[k] = (high[k] - low[k]) / length;
            }
            let [ss, st, tt] = part.piece.second_bounds(boxes[0], boxes[1]);
            let [x, y] = shares;
            worst = worst.max((ss * x * x + 2.0 * st * x * y + tt * y * y) / 8.0);
        }
        worst / self.frame.scale * (1.0 + 64.0 * HALF_ULP)
    }
}

impl Piece<'_> {
    /// The poles on a box, Cartesian, and their weights.
    pub fn cut(&self, s: [f64; 2], t: [f64; 2]) -> (Vec<Vector>, Vec<f64>) {
        let count = self.degree.count();
        let mut net = self.poles.to_vec();
        net.chunks_exact_mut(count).for_each(|part| cut_2d(part, self.degree, s, t));
        net.resize(4 * count, 1.0);
        let weights = net[3 * count..].to_vec();
        let pole = |i: usize| [0, 1, 2].map(|c| net[c * count + i] / weights[i]);
        ((0..count).map(pole).collect(), weights)
    }

    /// Bounds of the lengths of the second derivatives (ss, st, tt) on a box, in the box's own parameters.
    fn second_bounds(&self, s: [f64; 2], t: [f64; 2]) -> [f64; 3] {
        let (poles, weights) = self.cut(s, t);
        let centre = poles[poles.len() / 2];
        let heavy: Vec<[f64; 4]> = poles
            .iter()
            .zip(&weights)
            .map(|(p, &w)| {
                let d = sub(*p, centre);
                [w * d[0], w * d[1], w * d[2], w]
            })
            .collect();
        let least = weights.iter().fold(f64::INFINITY, |m, w| m.min(*w));
        let size = |i: usize, j: usize| self.derivative_sizes(&heavy, i, j);
        let [x, _] = size(0, 0);
        let ([xs, ws], [xt, wt]) = (size(1, 0), size(0, 1));
        let value = x / least;
        let (s1, t1) = ((xs + ws * value) / least, (xt + wt * value) / least);
        let second = |[x2, w2]: [f64; 2], cross: f64| (x2 + cross + w2 * value) / least;
        let p = self.degree.s.max(self.degree.t) as f64;
        let rounding = (64.0 + 8.0 * p * p) * self.error / least;
        [
            second(size(2, 0), 2.0 * ws * s1) + rounding,
            second(size(1, 1), ws * t1 + wt * s1) + rounding,
            second(size(0, 2), 2.0 * wt * t1) + rounding,
        ]
    }

    /// Greatest length of a derivative of the homogeneous net: of its coordinates and of its weight.
    fn derivative_sizes(&self, net: &[[f64; 4]], i: usize, j: usize) -> [f64; 2] {
        let (mut rows, mut width) = (self.degree.s + 1, self.degree.t + 1);
        let mut net = net.to_vec();
        let mut factor = 1.0;
        for k in 0..i + j {
            let along_s = k < i;
            let n = if along_s { rows - 1 } else { width - 1 };
            if n == 0 {
                return [0.0; 2];
            }
            factor *= n as f64;
            let step = if along_s { width } else { 1 };
            let (next_rows, next_width) =
                if along_s { (rows - 1, width) } else { (rows, width - 1) };
            net = (0..next_rows * next_width)
                .map(|m| {
                    let at = m / next_width * width + m % next_width;
                    std::array::from_fn(|c| net[at + step][c] - net[at][c])
                })
                .collect();
            (rows, width) = (next_rows, next_width);
        }
        net.iter().fold([0.0f64; 2], |[x, w], p| {
            [x.max(factor * norm([p[0], p[1], p[2]])), w.max(factor * p[3].abs())]
        })
    }
}

#[derive(Clone, Copy)]
struct Corner {
    point: Vector,
    foot: [f64; 2],
    distance: f64,
}

/// A box of a piece; corner (i, j) is at `2 i + j`.
struct Area {
    piece: usize,
    s: [f64; 2],
    t: [f64; 2],
    corners: [Corner; 4],
    upper: f64,
    /// Extents in s and t.
    extents: [f64; 2],
}

impl PartialEq for Area {
    fn eq(&self, other: &Self) -> bool {
        self.upper.total_cmp(&other.upper) == Ordering::Equal
    }
}

impl Eq for Area {}

impl PartialOrd for Area {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Area {
    fn cmp(&self, other: &Self) -> Ordering {
        self.upper.total_cmp(&other.upper)
    }
}

struct Walk<'a, 'b> {
    from: &'b Parts<'a>,
    to: &'b Parts<'a>,
    work: Workspace,
    lower: f64,
    /// Where the lower bound is attained; the first place before any is.
    at: Option<[f64; 2]>,
    rounding: f64,
    boxes: u64,
}

impl Walk<'_, '_> {
    fn corner(&mut self, piece: usize, s: f64, t: f64, hint: Option<[f64; 2]>) -> Corner {
        let [u, v] = self.from.parts[piece].spans;
        let place = [u.global(s), v.global(t)];
        let point = self.from.evaluate(place);
        let foot = self.to.closest(point, hint, &mut self.work);
        let proven = foot.lower_bound - self.rounding;
        if proven > self.lower {
            self.lower = proven;
            self.at = Some(place);
        }
        self.at.get_or_insert(place);
        let distance = if foot.distance.is_nan() { f64::INFINITY } else { foot.distance };
        Corner { point, foot: self.to.place(&foot), distance }
    }

    fn area(&mut self, piece: usize, s: [f64; 2], t: [f64; 2], corners: [Corner; 4]) -> Area {
        self.boxes += 1;
        let part = &self.from.parts[piece];
        let scale = self.from.frame.scale;
        let (poles, _) = part.piece.cut(s, t);
        let place =
            |p: &Vector| add(self.from.frame.center, scaled(add(*p, part.center), 1.0 / scale));
        let poles: Vec<Vector> = poles.iter().map(place).collect();
        let reach = |c: &Corner| poles.iter().map(|p| norm(sub(*p, c.point))).fold(0.0, f64::max);
        let plain = corners.iter().map(|c| c.distance + reach(c)).fold(f64::INFINITY, f64::min);
        let [ss, _, tt] = part.piece.second_bounds(s, t);
        let own = (ss + tt) / 8.0 / scale;
        let pick = |k: usize, f: fn(f64, f64) -> f64| {
            corners.iter().map(|c| c.foot[k]).reduce(f).unwrap_or(0.0)
        };
        let low = [pick(0, f64::min), pick(1, f64::min)];
        let high = [pick(0, f64::max), pick(1, f64::max)];
        let most = corners.iter().map(|c| c.distance).fold(0.0, f64::max);
        let bent = if most + own < plain {
            most + own + self.to.bend_between(low, high)
        } else {
            f64::INFINITY
        };
        let upper = plain.min(bent) + self.rounding;
        let side = |a: usize, b: usize| norm(sub(corners[a].point, corners[b].point));
        let extents = [side(0, 2).max(side(1, 3)), side(0, 1).max(side(2, 3))];
        Area { piece, s, t, corners, upper, extents }
    }

    fn halve(&mut self, area: &Area) -> [Area; 2] {
        let wider = area.extents[0] > area.extents[1]
            || (area.extents == [0.0; 2] && area.s[1] - area.s[0] > area.t[1] - area.t[0]);
        let along_s = self.from.has_s && wider;
        let hint = |c: &Corner| Some(c.foot);
        let [a, b, c, d] = area.corners;
        if along_s {
            let x = 0.5 * (area.s[0] + area.s[1]);
            let e = self.corner(area.piece, x, area.t[0], hint(&a));
            let f = self.corner(area.piece, x, area.t[1], hint(&b));
            return [
                self.area(area.piece, [area.s[0], x], area.t, [a, b, e, f]),
                self.area(area.piece, [x, area.s[1]], area.t, [e, f, c, d]),
            ];
        }
        let y = 0.5 * (area.t[0] + area.t[1]);
        let e = self.corner(area.piece, area.s[0], y, hint(&a));
        let f = if self.from.has_s { self.corner(area.piece, area.s[1], y, hint(&c)) } else { e };
        [
            self.area(area.piece, area.s, [area.t[0], y], [a, e, c, f]),
            self.area(area.piece, area.s, [y, area.t[1]], [e, b, f, d]),
        ]
    }
}

/// The greatest distance of a point of `from` from `to`.
fn directed(
    from: &Parts,
    to: &Parts,
    accuracy: f64,
    budget: u64,
    poll: &mut dyn FnMut() -> bool,
) -> Result<Directed, Error> {
    let rounding = from.rounding() + to.rounding();
    let work = Workspace::default();
    let mut walk = Walk { from, to, work, lower: 0.0, at: None, rounding, boxes: 0 };
    let mut heap = BinaryHeap::new();
    for piece in 0..from.parts.len() {
        let mut corner = |s: f64, t: f64| walk.corner(piece, s, t, None);
        let (a, b) = (corner(0.0, 0.0), corner(0.0, 1.0));
        let (c, d) = if from.has_s { (corner(1.0, 0.0), corner(1.0, 1.0)) } else { (a, b) };
        heap.push(walk.area(piece, [0.0, 1.0], [0.0, 1.0], [a, b, c, d]));
    }
    let mut looks = 0u64;
    let (mut upper, mut proven) = (0.0, true);
    while let Some(area) = heap.pop() {
        upper = area.upper;
        if upper - walk.lower <= accuracy {
            break;
        }
        looks += 1;
        if looks % 64 == 63 && poll() {
            return Err(Error::Cancelled);
        }
        let narrow = (area.t[1] - area.t[0]).max(area.s[1] - area.s[0]) < 1e-12;
        if walk.boxes >= budget || narrow {
            proven = false;
            break;
        }
        heap.extend(walk.halve(&area));
    }
    let upper = upper.max(walk.lower);
    let [u, v] = walk.at.unwrap_or_default();
    let at = if from.has_s { [u, v] } else { [v, 0.0] };
    Ok(Directed { lower: walk.lower.max(0.0), upper, at, proven, boxes: walk.boxes })
}

/// The Hausdorff distance between two shapes, between proven bounds.
///
/// Cost: one or two queries of `closest` a box; boxes grow with the inverse of the accuracy.
///
/// # Errors
/// An accuracy that is none; memory that could not be had; [`Error::Cancelled`].
pub fn hausdorff(
    first: Shape,
    second: Shape,
    options: &HausdorffOptions,
    poll: &mut dyn FnMut() -> bool,
) -> Result<Hausdorff, Error> {
    if !(options.accuracy >= 0.0 && options.accuracy.is_finite()) {
        let text = format!("accuracy: {} given, a length expected", options.accuracy);
        return Err(Error::InvalidArgument(text));
    }
    let (a, b) = (Parts::new(first, poll)?, Parts::new(second, poll)?);
    let size = a.frame.diagonal;
    let accuracy = if options.accuracy > 0.0 { options.accuracy } else { 1e-3 * size };
    let budget = if options.budget > 0 { options.budget } else { BUDGET };
    Ok(Hausdorff {
        forward: directed(&a, &b, accuracy, budget, poll)?,
        backward: directed(&b, &a, accuracy, budget, poll)?,
    })
}
