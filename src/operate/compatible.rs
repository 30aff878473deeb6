//! Shapes with common degrees and knots: what skinning, Gordon surfaces and differences of poles need.
//!
//! The domain of the first shape becomes the domain of all, by an affine change of parameters. Knots of different shapes are one
//! knot when rounding of that change can have parted them and moving one onto the other moves no point beyond rounding:
//! nearer than [`SAME_KNOT`] of the largest knot and [`SAME_STEP`] of the steps to their neighbours. Others stay apart,
//! however near; knots of one shape never fall together.

use super::refinement::merged;
use super::{Direction, Surface};
use crate::curve::Curve;
use crate::curve::insertion::{checked, spare};
use crate::error::Error;
use crate::knots::Knots;

/// Some ulps of the largest knot in magnitude: what two affine maps may move.
const SAME_KNOT: f64 = 8.0 * f64::EPSILON;

/// The same as a share of the shorter step to a neighbour: what moving the knot may move of the local net.
const SAME_STEP: f64 = 1e-12;

/// The same curves, clamped, over the domain of the first, with one degree and one knot vector for all; the points
/// stay, curve by curve, and `new(u)` is `old` at the parameter that the affine map of the domains gives. If one is rational, all have weights.
///
/// # Errors
/// No curves; memory that could not be had.
pub fn compatible_curves(curves: &[Curve]) -> Result<Vec<Curve>, Error> {
    let Some(first) = curves.first() else {
        return Err(Error::InvalidArgument("curves: none given".into()));
    };
    let degree = curves.iter().map(Curve::degree).max().unwrap_or(1);
    let (start, end) = first.domain();
    let raise =
        |curve: &Curve| curve.clamp()?.with_domain(start, end)?.elevate(degree - curve.degree());
    let raised: Vec<Curve> = curves.iter().map(raise).collect::<Result<_, _>>()?;
    let union = Union::new(raised.iter().map(Curve::knots))?;
    let weighted = raised.iter().any(|curve| curve.weights().is_some());
    raised.iter().map(|curve| onto(curve, &union)?.weighted_if(weighted)).collect()
}

/// The same surfaces, clamped, over the domain of the first, with the same degrees and knot vectors, as [`compatible_curves`].
///
/// # Errors
/// No surfaces; memory that could not be had.
pub fn compatible_surfaces(surfaces: &[Surface]) -> Result<Vec<Surface>, Error> {
    let Some(first) = surfaces.first() else {
        return Err(Error::InvalidArgument("surfaces: none given".into()));
    };
    let domain = first.domain();
    let mut all: Vec<Surface> = surfaces
        .iter()
        .map(|surface| surface.clamp()?.with_domain(domain))
        .collect::<Result<_, _>>()?;
    for direction in [Direction::U, Direction::V] {
        all = along(&all, direction)?;
    }
    let weighted = all.iter().any(|surface| surface.weights().is_some());
    all.into_iter().map(|surface| surface.weighted_if(weighted)).collect()
}

/// Surfaces with the same degree and knots in one direction, in which they have the same domain and are clamped.
pub(super) fn along(surfaces: &[Surface], direction: Direction) -> Result<Vec<Surface>, Error> {
    let degree = surfaces.iter().map(|surface| surface.knots(direction).degree()).max();
    let raise = |surface: &Surface| {
        let by = degree.unwrap_or(1) - surface.knots(direction).degree();
        surface.elevate(direction, by)
    };
    let raised: Vec<Surface> = surfaces.iter().map(raise).collect::<Result<_, _>>()?;
    let union = Union::new(raised.iter().map(|surface| surface.knots(direction)))?;
    let fine = |surface: &Surface| {
        let (moved, added) = union.apply(surface.knots(direction))?;
        let same = surface.with_strands(direction, moved, &surface.strands(direction)?)?;
        same.refine(direction, &added)
    };
    raised.iter().map(fine).collect()
}

/// The knots of some vectors, those that are the same as one.
struct Union {
    /// The distinct knots of all, and the knot that each is.
    meaning: Vec<(f64, f64)>,
    /// Every knot as often as in the vector where it is most frequent.
    common: Vec<f64>,
}

impl Union {
    fn new<'a>(all: impl Iterator<Item = &'a Knots> + Clone) -> Result<Self, Error> {
        // Distinct knots with their steps, what they mean, the common ones.
        spare(all.clone().map(|knots| knots.values().len()).sum(), 128)?;
        let far = all.clone().flat_map(Knots::values).fold(0.0, |far: f64, u| far.max(u.abs()));
        let mut distinct: Vec<(f64, f64)> = all.clone().flat_map(with_steps).collect();
        distinct.sort_by(|a, b| a.0.total_cmp(&b.0));
        let ends = all.clone().next().map(Knots::domain);
        let (mut meaning, mut first) = (Vec::<(f64, f64)>::new(), 0);
        for (i, &(u, step)) in distinct.iter().enumerate() {
            let (start, least) = distinct[first];
            let reach = (SAME_KNOT * far).min(SAME_STEP * step.min(least));
            if u - start > reach {
                first = i;
            }
            meaning.push((u, distinct[first].0));
            if ends.is_some_and(|(_, end)| u == end) {
                meaning[first..].iter_mut().for_each(|(_, knot)| *knot = u);
            }
        }
        let mut union = Self { meaning, common: Vec::new() };
        union.common = union.merge(all)?;
        Ok(union)
    }

    fn merge<'a>(&self, all: impl Iterator<Item = &'a Knots>) -> Result<Vec<f64>, Error> {
        let mut common = Vec::new();
        for knots in all {
            let lacking = lacking(&common, &self.meant(knots.values()));
            common = merged(&common, &lacking)?;
        }
        Ok(common)
    }

    /// The knots that some knots are.
    fn meant(&self, values: &[f64]) -> Vec<f64> {
        let of = |u: f64| self.meaning[self.meaning.partition_point(|&(x, _)| x < u)].1;
        values.iter().map(|&u| of(u)).collect()
    }

    /// The vector with its knots moved onto the common ones, and those that it lacks.
    fn apply(&self, knots: &Knots) -> Result<(Knots, Vec<f64>), Error> {
        spare(knots.values().len() + self.common.len(), 3 * size_of::<f64>())?;
        let values = self.meant(knots.values());
        let added = lacking(&values, &self.common);
        Ok((checked(&values, knots.degree())?, added))
    }
}

/// The distinct knots of a vector, each with the step to its nearer neighbour.
fn with_steps(knots: &Knots) -> Vec<(f64, f64)> {
    let mut values = knots.values().to_vec();
    values.dedup();
    let step = |i: usize| {
        let below = i.checked_sub(1).map_or(f64::INFINITY, |k| values[i] - values[k]);
        let above = values.get(i + 1).map_or(f64::INFINITY, |u| u - values[i]);
        below.min(above)
    };
    (0..values.len()).map(|i| (values[i], step(i))).collect()
}

/// What of `wanted` is not in `there`, counting copies; both in order.
fn lacking(there: &[f64], wanted: &[f64]) -> Vec<f64> {
    let (mut out, mut at) = (Vec::new(), 0);
    for &u in wanted {
        while there.get(at).is_some_and(|&x| x < u) {
            at += 1;
        }
        if there.get(at) == Some(&u) { at += 1 } else { out.push(u) }
    }
    out
}

fn onto(curve: &Curve, union: &Union) -> Result<Curve, Error> {
    let (moved, added) = union.apply(curve.knots())?;
    curve.like(moved, &curve.strand()?)?.refine(&added)
}

impl Curve {
    /// The same curve, with weights 1 if there are none and some are wanted.
    pub(super) fn weighted_if(self, wanted: bool) -> Result<Self, Error> {
        if !wanted || self.weights().is_some() {
            return Ok(self);
        }
        spare(self.poles().len(), size_of::<f64>())?;
        let weights = vec![1.0; self.poles().len()].into_boxed_slice();
        Ok(Self::from_parts(self.knots().clone(), self.poles().into(), Some(weights)))
    }
}

impl Surface {
    /// The same surface, with weights 1 if there are none and some are wanted.
    pub(super) fn weighted_if(self, wanted: bool) -> Result<Self, Error> {
        if !wanted || self.weights().is_some() {
            return Ok(self);
        }
        spare(self.poles().len(), size_of::<f64>())?;
        let weights = vec![1.0; self.poles().len()].into_boxed_slice();
        let [u, v] = [self.knots_u().clone(), self.knots_v().clone()];
        Ok(Self::from_parts(u, v, self.poles().into(), Some(weights)))
    }
}
