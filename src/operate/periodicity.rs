//! Clamped, unclamped and periodic forms of the same shape.
//!
//! ```text
//!   clamped      0 0 0 0  1 2 3  4 4 4 4
//!   unclamped   -3 -2 -1 0  1 2 3  4 5 6 7      mirrored at the ends; any shape
//!   periodic    -3 -2 -1 0  1 2 3  4 5 6 7      knots and poles repeat after a period; closed and smooth shapes
//! ```
//!
//! A periodic form is unrolled: with N knots a period, pole i + N is pole i and knot i + N is knot i plus the period. The seam has as many
//! knots as its smoothness asks for. Poles whose knots lie on both sides of an end are the blossom of the piece there, which is
//! extrapolation: a short piece at the end makes the error grow, and the proven error says how far.
//!
//! Reference: Piegl, Tiller, *The NURBS Book*, 2nd ed., section 12.2.

use super::{Bounded, Direction, Surface, check_tolerance};
use crate::curve::Curve;
use crate::curve::insertion::{Strands, Weighted, checked, spare};
use crate::error::Error;
use crate::knots::{Knots, MAX_MAGNITUDE};

impl Curve {
    /// The same curve with unclamped ends, the knots outside the domain mirrored from those inside; and the proven error.
    ///
    /// # Errors
    /// Weights that would not stay positive; memory that could not be had.
    pub fn unclamp(&self) -> Result<Bounded<Self>, Error> {
        let clamped = self.clamp()?;
        let (knots, strand) = unclamped(clamped.knots(), &clamped.strand()?)?;
        let shape = clamped.like(knots, &strand)?;
        let error = self.difference(&shape)?.bound;
        Ok(Bounded { shape, error })
    }

    /// The periodic form of a closed curve: the smoothest seam that keeps the proven error within `tolerance`. To go back: [`Curve::clamp`].
    ///
    /// # Errors
    /// The curve is not closed within the tolerance; a tolerance that is negative or not finite; memory that could not be had.
    pub fn periodic(&self, tolerance: f64) -> Result<Bounded<Self>, Error> {
        check_tolerance(tolerance)?;
        let clamped = self.clamp()?;
        let strand = clamped.strand()?;
        for copies in 1..=self.degree() {
            let Some((knots, poles)) = wrapped(clamped.knots(), &strand, copies)? else { continue };
            let shape = clamped.like(knots, &poles)?;
            let error = self.difference(&shape)?.bound;
            if error <= tolerance {
                return Ok(Bounded { shape, error });
            }
        }
        Err(not_closed(""))
    }
}

impl Surface {
    /// The same surface with unclamped ends in a direction, as [`Curve::unclamp`].
    ///
    /// # Errors
    /// As for curves.
    pub fn unclamp(&self, direction: Direction) -> Result<Bounded<Self>, Error> {
        let clamped = self.clamp_along(direction)?;
        let strands = clamped.strands(direction)?;
        let (knots, strands) = unclamped(clamped.knots(direction), &strands)?;
        let shape = clamped.with_strands(direction, knots, &strands)?;
        let error = self.difference(&shape)?.bound;
        Ok(Bounded { shape, error })
    }

    /// The periodic form of a surface that is closed in a direction, as [`Curve::periodic`].
    ///
    /// # Errors
    /// As for curves.
    pub fn periodic(&self, direction: Direction, tolerance: f64) -> Result<Bounded<Self>, Error> {
        check_tolerance(tolerance)?;
        let clamped = self.clamp_along(direction)?;
        let (old, strands) = (clamped.knots(direction), clamped.strands(direction)?);
        for copies in 1..=old.degree() {
            let Some((knots, net)) = wrapped(old, &strands, copies)? else { continue };
            let shape = clamped.with_strands(direction, knots, &net)?;
            let error = self.difference(&shape)?.bound;
            if error <= tolerance {
                return Ok(Bounded { shape, error });
            }
        }
        Err(not_closed(direction.suffix()))
    }

    fn clamp_along(&self, direction: Direction) -> Result<Self, Error> {
        let (start, end) = self.knots(direction).domain();
        self.part_along(direction, start, end)
    }
}

fn not_closed(suffix: &str) -> Error {
    let which = if suffix.is_empty() { "the curve" } else { "the surface" };
    let along = suffix.trim_start_matches('_');
    let along = if along.is_empty() { String::new() } else { format!(" along {along}") };
    Error::InvalidArgument(format!("tolerance: {which} is not closed{along} within it"))
}

/// Homogeneous coordinates around a centre.
fn raised(point: &Weighted, centre: [f64; 3]) -> [f64; 4] {
    let [x, y, z] = [0, 1, 2].map(|axis| point.weight * (point.pole[axis] - centre[axis]));
    [x, y, z, point.weight]
}

/// The blossom of the piece on `span` at any arguments; none when its weight is not positive.
fn extrapolated(
    knots: &Knots,
    span: usize,
    arguments: &[f64],
    strand: &[Weighted],
) -> Result<Weighted, Error> {
    let (p, t) = (knots.degree(), knots.values());
    let local = &strand[span - p..=span];
    let centre = local[p / 2].pole;
    let mut row: Vec<[f64; 4]> = local.iter().map(|point| raised(point, centre)).collect();
    for (level, x) in (1..=p).zip(arguments) {
        for j in (level..=p).rev() {
            let (low, high) = (t[span - p + j], t[span + 1 + j - level]);
            let [b, a] = [(high - x) / (high - low), (x - low) / (high - low)];
            row[j] = std::array::from_fn(|axis| b * row[j - 1][axis] + a * row[j][axis]);
        }
    }
    let h = row[p];
    if !(h[3] > 1.0 / MAX_MAGNITUDE && h[3] < MAX_MAGNITUDE) {
        return Err(Error::Unsupported("weights: one outside the domain is not positive".into()));
    }
    let pole = [0, 1, 2].map(|axis| centre[axis] + h[axis] / h[3]);
    Ok(Weighted { pole, weight: h[3] })
}

/// A clamped vector and its strands with mirrored knots outside the domain.
fn unclamped(knots: &Knots, strands: &[Weighted]) -> Result<Strands, Error> {
    let (p, t, count) = (knots.degree(), knots.values(), knots.pole_count());
    spare(strands.len() + t.len(), size_of::<Weighted>() + size_of::<f64>())?;
    let (start, end) = knots.domain();
    let before = (1..=p).rev().map(|k| start - (t[(p + k).min(count)] - start));
    let behind = (1..=p).map(|k| end + (end - t[count.saturating_sub(k).max(p)]));
    let inside = t[p..=count].iter().copied();
    let values: Vec<f64> = before.chain(inside).chain(behind).collect();
    let (first, last) = (knots.span(start), knots.span(end));
    let mut out = strands.to_vec();
    for (old, new) in strands.chunks_exact(count).zip(out.chunks_exact_mut(count)) {
        for i in 0..count {
            let arguments = &values[i + 1..=i + p];
            // A pole with knots beyond both ends belongs to the only piece that there is.
            if arguments[0] < start {
                new[i] = extrapolated(knots, first, arguments, old)?;
            } else if arguments[p - 1] > end {
                new[i] = extrapolated(knots, last, arguments, old)?;
            }
        }
    }
    Ok((checked(&values, p)?, out))
}

/// A clamped vector and its strands in periodic form with `copies` knots at the seam; none where the period is too short for
/// that, or a weight is not positive.
fn wrapped(knots: &Knots, strands: &[Weighted], copies: usize) -> Result<Option<Strands>, Error> {
    let (p, t, old_count) = (knots.degree(), knots.values(), knots.pole_count());
    spare(strands.len() + t.len(), 2 * (size_of::<Weighted>() + size_of::<f64>()))?;
    let (start, end) = knots.domain();
    let mut period = vec![start; copies];
    period.extend_from_slice(&t[p + 1..old_count]);
    let n = period.len();
    if n <= p - copies {
        return Ok(None);
    }
    let knot = |k: isize| {
        let turns = k.div_euclid(n as isize);
        period[k.rem_euclid(n as isize) as usize] + turns as f64 * (end - start)
    };
    let lowest = copies as isize - 1 - p as isize;
    let mut values: Vec<f64> = (lowest..=(n + p) as isize).map(knot).collect();
    let count = n + p - copies + 1;
    // Copies of the seam at the end are the end bit for bit, whatever rounding a turn brings.
    values[count..count + copies].fill(end);
    let (Ok(new_knots), shared) = (checked(&values, p), p - copies) else { return Ok(None) };
    let mut out = Vec::with_capacity(strands.len() / old_count * count);
    for strand in strands.chunks_exact(old_count) {
        let mut poles: Vec<Weighted> = strand[..=shared.max(n)].to_vec();
        poles.truncate(n + 1);
        poles[0] = if shared > 0 { strand[n] } else { strand[0] };
        for i in 1..shared {
            let arguments = &values[i + 1..=i + p];
            let moved: Vec<f64> = arguments.iter().map(|u| u + (end - start)).collect();
            let found = if 2 * i >= shared {
                extrapolated(knots, knots.span(start), arguments, strand)
            } else {
                extrapolated(knots, knots.span(end), &moved, strand)
            };
            let Ok(found) = found else { return Ok(None) };
            poles[i] = found;
        }
        poles.truncate(n);
        poles.extend_from_within(..=shared);
        out.append(&mut poles);
    }
    Ok(Some((new_knots, out)))
}
