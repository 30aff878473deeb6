//! What is asked of a range of curvatures, the answer, and the pieces of a shape that a domain holds.

use super::cell::{Known, Piece, Shape, eigenvalues};
use super::interval::Interval;
use crate::bezier::Bidegree;
use crate::bounds::HALF_ULP;
use crate::error::Error;
use crate::index::{CurveIndex, Span, SurfaceIndex, position_steps};

/// What of the curvature of a surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// The greater principal curvature, 1 / length. Positive: the surface bends towards S_u x S_v.
    Greater,
    /// The less principal curvature, 1 / length.
    Less,
    /// Half their sum, 1 / length.
    Mean,
    /// Their product, 1 / area.
    Gaussian,
    /// The greatest absolute normal curvature, 1 / length: its reciprocal is the least radius of curvature.
    Sharpest,
}

/// Which extremes are looked for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Side {
    /// The least value and the greatest.
    #[default]
    Both,
    /// The least one.
    Least,
    /// The greatest one.
    Greatest,
}

/// How far to go.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RangeOptions {
    /// Only u0, u1, v0, v1; curves use the first two.
    pub domain: Option<[f64; 4]>,
    /// Allowed gap between the two bounds of an extreme, as a share of its size or of what a sphere as large as the shape has.
    pub relative: f64,
    /// Which extremes must have that gap; what is known of the other one is true, but loose.
    pub side: Side,
    /// Most boxes.
    pub budget: u64,
}

impl Default for RangeOptions {
    fn default() -> Self {
        Self { domain: None, relative: 1e-3, side: Side::Both, budget: 200_000 }
    }
}

/// The least and the greatest value of a quantity, each between two bounds.
#[derive(Clone, Debug, PartialEq)]
pub struct Range {
    /// Nothing is less than the first; something is not greater than the second.
    pub least: [f64; 2],
    /// Something is not less than the first; nothing is greater than the second.
    pub greatest: [f64; 2],
    /// Parameters where the inner bound of the least is attained.
    pub at_least: [f64; 2],
    /// Parameters where the inner bound of the greatest is attained.
    pub at_greatest: [f64; 2],
    /// Parameter boxes u0, u1, v0, v1 that are left out: the shape is singular there. The bounds are those of the rest.
    pub excluded: Vec<[f64; 4]>,
    /// Where the quantity is proven to have no bound, each in one of the excluded boxes.
    pub unbounded: Vec<Unbounded>,
    /// Whether the gaps are allowed ones outside of what is excluded.
    pub rest_proven: bool,
    /// Whether the gaps are allowed ones and nothing is excluded.
    pub proven: bool,
    /// Length. 0: the bounds are those of the shape. Otherwise they are those of a shape from which no point of this one is farther,
    /// which is rounding: beside a pole the rounding of its coordinates alone makes curvatures infinite.
    pub moved: f64,
    /// Boxes looked at.
    pub boxes: u64,
}

/// A place near which a quantity passes every bound: a tip, a cusp.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unbounded {
    /// Parameters.
    pub at: [f64; 2],
    /// The excluded box that holds it: u0, u1, v0, v1.
    pub domain: [f64; 4],
    /// Whether the quantity falls below every number.
    pub falls: bool,
    /// Whether it exceeds every number.
    pub grows: bool,
}

/// A patch of an index with its rounding.
pub(super) fn patch_piece(index: &SurfaceIndex, k: usize) -> Piece<'_> {
    let (net, patch) = (index.net(k), &index.patches[k]);
    piece(net.poles, net.degree, net.rational, patch.radius, patch.spread)
}

/// A segment of an index with its rounding.
pub(super) fn segment_piece(index: &CurveIndex, k: usize) -> Piece<'_> {
    let net = index.net(k);
    let degree = Bidegree { s: 0, t: net.degree };
    piece(net.poles, degree, net.rational, index.segments[k].radius, 0.0)
}

fn piece(poles: &[f64], degree: Bidegree, rational: bool, radius: f64, spread: f64) -> Piece<'_> {
    let steps = position_steps(degree.s + degree.t);
    // The frame rounds coordinates up to 2 once, the piece's own centre once more.
    let error = steps * radius + 32.0 * HALF_ULP + spread;
    Piece { poles, degree, rational, error, steps }
}

/// The part of each piece inside the domain.
pub(super) fn parts_inside(spans: &[Span], range: Option<[f64; 2]>) -> Vec<Option<[f64; 2]>> {
    let part = |span: &Span| {
        let [a, b] = range.map_or([0.0, 1.0], |range| span.cover(range));
        (a < b).then_some([a, b])
    };
    spans.iter().map(part).collect()
}

/// Refuses options that make no sense.
pub(super) fn check(options: &RangeOptions, bounds: &[[f64; 2]]) -> Result<(), Error> {
    if !(options.relative > 0.0 && options.relative <= 1.0) {
        let text = format!("relative: {} is not between 0 and 1", options.relative);
        return Err(Error::InvalidArgument(text));
    }
    let Some(domain) = options.domain else { return Ok(()) };
    for (k, bounds) in bounds.iter().enumerate() {
        let range = [domain[2 * k], domain[2 * k + 1]];
        for (i, x) in range.into_iter().enumerate() {
            if !(bounds[0]..=bounds[1]).contains(&x) {
                let [low, high] = bounds;
                let text = format!("domain: entry {} = {x} is outside [{low}, {high}]", 2 * k + i);
                return Err(Error::InvalidArgument(text));
            }
        }
        if range[0] >= range[1] {
            let text = format!("domain: entry {} is not less than entry {}", 2 * k, 2 * k + 1);
            return Err(Error::InvalidArgument(text));
        }
    }
    Ok(())
}

/// The greater absolute value of two.
pub(super) fn sharper(a: Interval, b: Interval) -> Interval {
    Interval {
        low: a.least_magnitude().max(b.least_magnitude()),
        high: a.magnitude().max(b.magnitude()),
    }
}

/// A quantity from what is known of the entries of the shape operator `[[a, b], [b, d]]`.
pub(super) fn of_entries([a, b, d]: [Interval; 3], quantity: Quantity) -> Interval {
    match quantity {
        Quantity::Mean => (a + d).times(0.5),
        Quantity::Gaussian => a * d - b.squared(),
        Quantity::Greater => eigenvalues([a, b, d])[0],
        Quantity::Less => eigenvalues([a, b, d])[1],
        Quantity::Sharpest => {
            let [greater, less] = eigenvalues([a, b, d]);
            sharper(greater, less)
        }
    }
}

pub(super) fn known(shape: &Shape, quantity: Quantity) -> Known {
    match quantity {
        Quantity::Mean => shape.mean().into(),
        Quantity::Gaussian => shape.gaussian().into(),
        Quantity::Greater => shape.principal()[0],
        Quantity::Less => shape.principal()[1],
        Quantity::Sharpest => {
            let [greater, less] = shape.principal();
            // Both sides' slopes count; for the choice of the halving the wider one will do.
            let gradient = [0, 1].map(|k| greater.gradient[k].or(less.gradient[k]));
            Known {
                middle: sharper(greater.middle, less.middle),
                range: sharper(greater.range, less.range),
                gradient,
            }
        }
    }
}

/// The direction across a collapsed side of a patch that a box touches.
pub(super) fn collapsed_side(
    index: &SurfaceIndex,
    k: usize,
    s: [f64; 2],
    t: [f64; 2],
) -> Option<usize> {
    let touched = [s[0] == 0.0, s[1] == 1.0, t[0] == 0.0, t[1] == 1.0];
    let collapsed = index.patches[k].collapsed;
    (0..4).find(|&side| touched[side] && collapsed[side]).map(|side| side / 2)
}

/// The parts of all patches inside a domain.
pub(super) fn areas_inside(
    index: &SurfaceIndex,
    domain: Option<[f64; 4]>,
) -> Vec<(usize, [f64; 2], [f64; 2])> {
    let column = |k: usize| index.patches[k].v;
    let columns: Vec<Span> = (0..index.columns).map(column).collect();
    let rows: Vec<Span> = index.patches.iter().step_by(index.columns).map(|p| p.u).collect();
    let along_u = parts_inside(&rows, domain.map(|d| [d[0], d[1]]));
    let along_v = parts_inside(&columns, domain.map(|d| [d[2], d[3]]));
    let mut areas = Vec::new();
    for (a, s) in along_u.iter().enumerate() {
        for (b, t) in along_v.iter().enumerate() {
            if let (Some(s), Some(t)) = (s, t) {
                areas.push((a * index.columns + b, *s, *t));
            }
        }
    }
    areas
}
