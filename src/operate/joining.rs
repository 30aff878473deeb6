//! Joining: shapes one after the other as one shape.
//!
//! The parts keep their speed: each domain is shifted to where the one before ends. Weights are scaled so that they agree where
//! parts meet. The knot there has the multiplicity of the degree, whatever smoothness the points have;
//! [`Curve::simplify`] takes out what is not needed.

use super::compatible::along;
use super::reparametrisation::{rational, rational_surface};
use super::{Bounded, Direction, Surface, check_tolerance};
use crate::bounds::{norm, sub};
use crate::curve::Curve;
use crate::curve::insertion::{Weighted, checked, spare, transposed};
use crate::error::Error;
use crate::knots::Knots;

/// Weights along a common edge agree up to a factor and this share.
const SAME_WEIGHT: f64 = 1e-12;

/// The curves as one, each beginning where the one before ends. Starts are moved onto ends that are not farther than `tolerance`;
/// the error is how far points move by that, proven, at parameters shifted by the domains before.
///
/// # Errors
/// No curves; a gap beyond the tolerance, by index; memory that could not be had.
pub fn join_curves(curves: &[Curve], tolerance: f64) -> Result<Bounded<Curve>, Error> {
    check(curves.len(), "curves", tolerance)?;
    let degree = curves.iter().map(Curve::degree).max().unwrap_or(1);
    let weighted = curves.iter().any(Curve::is_rational);
    // Parts, and the strand of all.
    spare(curves.iter().map(|curve| curve.poles().len()).sum(), 256)?;
    let mut parts: Vec<Curve> = Vec::new();
    for curve in curves {
        let (start, end) = curve.domain();
        let at = parts.last().map_or(start, |part| part.domain().1);
        let moved = curve.clamp()?.with_domain(at, at + (end - start))?;
        parts.push(moved.elevate(degree - curve.degree())?);
    }
    let (mut values, mut net): (Vec<f64>, Vec<Weighted>) = (Vec::new(), Vec::new());
    for (i, part) in parts.iter().enumerate() {
        let mut strand = part.strand()?;
        if let Some(end) = net.last() {
            let gap = norm(sub(end.pole, strand[0].pole));
            check_gap("curves", i, gap, tolerance)?;
            let factor = end.weight / strand[0].weight;
            strand.iter_mut().for_each(|point| point.weight *= factor);
        }
        append(&mut values, part.knots());
        net.extend_from_slice(&strand[usize::from(i > 0)..]);
    }
    let knots = checked(&values, degree)?;
    let mut shape = rational(knots, &net)?;
    if !weighted {
        shape = Curve::new(&values, degree, shape.poles(), None)?;
    }
    let mut error = 0.0_f64;
    for part in &parts {
        let (start, end) = part.domain();
        error = error.max(shape.part(start, end)?.difference(part)?.bound);
    }
    Ok(Bounded { shape, error })
}

/// The surfaces as one along a direction, as [`join_curves`]; in the other direction they get the domain of the first.
///
/// # Errors
/// No surfaces; a gap beyond the tolerance, by index; weights along a common edge that do not agree up to a factor; memory that could not be had.
pub fn join_surfaces(
    surfaces: &[Surface],
    direction: Direction,
    tolerance: f64,
) -> Result<Bounded<Surface>, Error> {
    check(surfaces.len(), "surfaces", tolerance)?;
    let other = [Direction::V, Direction::U][direction.index()];
    let weighted = surfaces.iter().any(Surface::is_rational);
    let common = surfaces[0].knots(other).domain();
    spare(surfaces.iter().map(|surface| surface.poles().len()).sum(), 256)?;
    let mut parts: Vec<Surface> = Vec::new();
    for surface in surfaces {
        let (start, end) = surface.knots(direction).domain();
        let at = parts.last().map_or(start, |part| part.knots(direction).domain().1);
        let ours = (at, at + (end - start));
        let (u, v) = if direction == Direction::U { (ours, common) } else { (common, ours) };
        parts.push(surface.clamp()?.with_domain([u.0, u.1, v.0, v.1])?);
    }
    let degree = parts.iter().map(|part| part.knots(direction).degree()).max().unwrap_or(1);
    let raise = |part: &Surface| part.elevate(direction, degree - part.knots(direction).degree());
    parts = along(&parts, other)?.iter().map(raise).collect::<Result<_, _>>()?;
    let (mut values, mut net): (Vec<f64>, Vec<Weighted>) = (Vec::new(), Vec::new());
    let width = parts[0].knots(other).pole_count();
    for (i, part) in parts.iter().enumerate() {
        // Lines of poles across the direction, one after the other.
        let mut lines = part.strands(other)?;
        if i > 0 {
            let end = &net[net.len() - width..];
            meet(end, &mut lines, i, tolerance)?;
        }
        append(&mut values, part.knots(direction));
        net.extend_from_slice(&lines[if i > 0 { width } else { 0 }..]);
    }
    let (knots, across) = (checked(&values, degree)?, parts[0].knots(other).clone());
    let mut shape = match direction {
        Direction::U => rational_surface(&knots, &across, &net)?,
        Direction::V => rational_surface(&across, &knots, &transposed(&net, width)?)?,
    };
    if !weighted {
        let [u, v] = [shape.knots_u().clone(), shape.knots_v().clone()];
        shape = Surface::from_parts(u, v, shape.poles().into(), None);
    }
    let mut error = 0.0_f64;
    for part in &parts {
        let (start, end) = part.knots(direction).domain();
        let there = shape.part_along(direction, start, end)?;
        error = error.max(there.difference(part)?.bound);
    }
    Ok(Bounded { shape, error })
}

fn check(count: usize, name: &str, tolerance: f64) -> Result<(), Error> {
    if count == 0 {
        return Err(Error::InvalidArgument(format!("{name}: none given")));
    }
    check_tolerance(tolerance)
}

fn check_gap(name: &str, i: usize, gap: f64, tolerance: f64) -> Result<(), Error> {
    if gap <= tolerance {
        return Ok(());
    }
    let text = format!("{name}: {i} begins {gap:e} from where {} ends", i - 1);
    Err(Error::InvalidArgument(text))
}

/// Appends a clamped vector whose start is where `values` ends.
fn append(values: &mut Vec<f64>, knots: &Knots) {
    if values.is_empty() {
        values.extend_from_slice(knots.values());
    } else {
        values.pop();
        values.extend_from_slice(&knots.values()[knots.degree() + 1..]);
    }
}

/// Scales the weights of `lines` so that its first line has those of `end`, and checks that the lines agree.
fn meet(end: &[Weighted], lines: &mut [Weighted], i: usize, tolerance: f64) -> Result<(), Error> {
    let factor = end[0].weight / lines[0].weight;
    lines.iter_mut().for_each(|point| point.weight *= factor);
    for (a, b) in end.iter().zip(&*lines) {
        check_gap("surfaces", i, norm(sub(a.pole, b.pole)), tolerance)?;
        if (a.weight - b.weight).abs() > SAME_WEIGHT * a.weight {
            let text = format!(
                "surfaces: the weights of {i} do not agree with those of {} where they meet",
                i - 1
            );
            return Err(Error::Unsupported(text));
        }
    }
    Ok(())
}
