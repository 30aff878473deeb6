//! Surfaces through and near grids of points: two fits of curves, one after the other.
//!
//! Row (i, j) of the grid has the parameters (u_i, v_j). Least squares over a grid is a tensor product: all columns are fitted at
//! the same parameters u, at once, with as many right sides as they have coordinates; then the columns of the poles, at v.
//! Adaptive fits add knots in u until all columns are met, and knots in v until all rows are.

use super::adaptive::refined;
use super::parameters::{averaged_knots, check_parameters, check_points, parameters};
use super::triangle::zeros;
use super::{Adaptive, Ends, INTERPOLATION_TOLERANCE, Spacing, point, rising, solve};
use crate::bounds::{Vector, norm, sub};
use crate::curve::insertion::collect;
use crate::curve::insertion::spare;
use crate::error::Error;
use crate::knots::{Knots, MAX_DEGREE};
use crate::surface::Surface;

/// Points of a surface in rows: point (i, j) is `points[i * count_v + j]`.
#[derive(Clone, Copy, Debug)]
pub struct Grid<'a> {
    points: &'a [Vector],
    counts: [usize; 2],
}

/// A surface and how far it is from the points that it was fitted to.
#[derive(Clone, Debug, PartialEq)]
pub struct SheetFit {
    /// The result.
    pub surface: Surface,
    /// The greatest distance of a point from the surface at the point's parameters.
    pub worst: f64,
    /// The parameters of that point.
    pub worst_at: [f64; 2],
    /// Root of the mean of the squared distances.
    pub rms: f64,
}

/// How [`adaptive_grid`] fits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GridOptions<'a> {
    /// Degrees of the surface, 1 to 31; 3 by default.
    pub degrees: [usize; 2],
    /// Distance of a point at its parameters that is good enough; positive.
    pub tolerance: f64,
    /// No more poles than that in either direction; 4096 by default.
    pub max_poles: usize,
    /// What happens at the borders: corners interpolated by default, borders fitted as curves of their own.
    pub ends: Ends,
    /// Knots in u and v that are there from the beginning, with their multiplicities, as [`Adaptive::breaks`].
    pub breaks: [&'a [(f64, usize)]; 2],
}

impl Default for GridOptions<'_> {
    fn default() -> Self {
        Self {
            degrees: [3, 3],
            tolerance: 1e-6,
            max_poles: 4096,
            ends: Ends::default(),
            breaks: [&[], &[]],
        }
    }
}

impl<'a> Grid<'a> {
    /// A grid of at least two rows of at least two points.
    ///
    /// # Errors
    /// Counts that do not belong to the points; points that are not finite, by index.
    pub fn new(points: &'a [Vector], count_u: usize, count_v: usize) -> Result<Self, Error> {
        for (name, count) in [("count_u", count_u), ("count_v", count_v)] {
            if count < 2 {
                let text = format!("{name}: {count} given, at least 2 needed");
                return Err(Error::InvalidArgument(text));
            }
        }
        if count_u.checked_mul(count_v) != Some(points.len()) {
            let text =
                format!("points: {} given, {count_u} times {count_v} expected", points.len());
            return Err(Error::InvalidArgument(text));
        }
        check_points(points, 4)?;
        Ok(Self { points, counts: [count_u, count_v] })
    }

    /// The coordinates relative to the first point, row by row.
    fn rows(&self) -> Result<Vec<f64>, Error> {
        let mut rows = zeros(self.points.len(), 3)?;
        for (row, point) in rows.chunks_exact_mut(3).zip(self.points) {
            row.copy_from_slice(&sub(*point, self.points[0]));
        }
        Ok(rows)
    }

    fn check(&self, parameters: [&[f64]; 2]) -> Result<(), Error> {
        for k in 0..2 {
            check_parameters(parameters[k], self.counts[k]).map_err(|e| suffixed(e, k))?;
        }
        Ok(())
    }
}

/// The error of one direction: "parameters_u: ..." for "parameters: ...".
fn suffixed(error: Error, direction: usize) -> Error {
    let suffix = ["_u", "_v"][direction];
    match error {
        Error::InvalidArgument(text) => Error::InvalidArgument(match text.split_once(':') {
            Some((name, rest)) => format!("{name}{suffix}:{rest}"),
            None => text,
        }),
        other => other,
    }
}

/// Rows for columns: `list` has `rows` rows of points with three coordinates.
fn transposed(list: &[f64], rows: usize) -> Result<Vec<f64>, Error> {
    let columns = list.len() / 3 / rows;
    let mut out = zeros(list.len(), 1)?;
    for i in 0..rows {
        for j in 0..columns {
            let (from, to) = ((i * columns + j) * 3, (j * rows + i) * 3);
            out[to..to + 3].copy_from_slice(&list[from..from + 3]);
        }
    }
    Ok(out)
}

/// Parameters from 0 to 1 for both directions: means over all rows that are not a single point.
///
/// # Errors
/// A direction in which all rows are single points.
pub fn grid_parameters(spacing: Spacing, grid: &Grid) -> Result<[Vec<f64>; 2], Error> {
    let [count_u, count_v] = grid.counts;
    let mean = |count: usize, lines: usize, at: &dyn Fn(usize, usize) -> Vector| {
        let (mut sum, mut used) = (vec![0.0; count], 0.0);
        let mut line = Vec::with_capacity(count);
        for k in 0..lines {
            line.clear();
            line.extend((0..count).map(|i| at(i, k)));
            if let Ok(list) = parameters(spacing, &line) {
                sum.iter_mut().zip(list).for_each(|(s, t)| *s += t);
                used += 1.0;
            }
        }
        if used == 0.0 {
            return Err(Error::InvalidArgument("points: all of a row are the same point".into()));
        }
        sum.iter_mut().for_each(|t| *t /= used);
        sum[count - 1] = 1.0;
        Ok(sum)
    };
    Ok([
        mean(count_u, count_v, &|i, j| grid.points[i * count_v + j])?,
        mean(count_v, count_u, &|j, i| grid.points[i * count_v + j])?,
    ])
}

/// The surface on full knots that is nearest to the grid at its parameters (not decreasing), in the sense of least squares. With
/// [`Ends::Interpolated`] borders are the fits of the border points with their ends interpolated: corners are met.
///
/// # Errors
/// What is not allowed, by name ("_u", "_v") and index; poles that the parameters leave open.
pub fn least_squares_grid(
    degrees: [usize; 2],
    knots: [&[f64]; 2],
    parameters: [&[f64]; 2],
    grid: &Grid,
    ends: Ends,
) -> Result<SheetFit, Error> {
    grid.check(parameters)?;
    let checked = |k: usize| {
        let count = knots[k].len().saturating_sub(degrees[k].saturating_add(1));
        Knots::new(knots[k], degrees[k], count).map_err(|error| error.named(["_u", "_v"][k]))
    };
    let knots = [checked(0)?, checked(1)?];
    let columns = solve(&knots[0], parameters[0], grid.rows()?, 3 * grid.counts[1], ends)
        .map_err(|error| suffixed(error, 0))?;
    finished(knots, &columns, parameters, grid, ends)
}

/// The second half of a tensor product, and its distances: `columns` are the poles in u of every column of the grid.
fn finished(
    knots: [Knots; 2],
    columns: &[f64],
    parameters: [&[f64]; 2],
    grid: &Grid,
    ends: Ends,
) -> Result<SheetFit, Error> {
    let rows = knots[0].pole_count();
    let across = transposed(columns, rows)?;
    let across =
        solve(&knots[1], parameters[1], across, 3 * rows, ends).map_err(|e| suffixed(e, 1))?;
    let poles = transposed(&across, knots[1].pole_count())?;
    measured(knots, &poles, parameters, grid)
}

/// The surface of poles relative to the first point, and its distances.
fn measured(
    [knots_u, knots_v]: [Knots; 2],
    poles: &[f64],
    parameters: [&[f64]; 2],
    grid: &Grid,
) -> Result<SheetFit, Error> {
    let (center, counts) = (grid.points[0], [knots_u.pole_count(), knots_v.pole_count()]);
    let place = |p: &[f64]| [p[0] + center[0], p[1] + center[1], p[2] + center[2]];
    let list = collect(poles.len() / 3, poles.chunks_exact(3).map(place))?;
    let surface = Surface::new(
        knots_u.values(),
        knots_v.values(),
        knots_u.degree(),
        knots_v.degree(),
        &list,
        counts[0],
        counts[1],
        None,
    )?;
    let (mut worst, mut worst_at, mut sum) = (0.0, [parameters[0][0], parameters[1][0]], 0.0);
    let mut row = zeros(counts[1], 3)?;
    for (i, &u) in parameters[0].iter().enumerate() {
        point(&knots_u, poles, u, &mut row);
        for (j, &v) in parameters[1].iter().enumerate() {
            let mut at = [0.0; 3];
            point(&knots_v, &row, v, &mut at);
            let missed = norm(sub(at, sub(grid.points[i * grid.counts[1] + j], center)));
            sum += missed * missed;
            if missed > worst {
                (worst, worst_at) = (missed, [u, v]);
            }
        }
    }
    let rms = (sum / grid.points.len() as f64).sqrt();
    Ok(SheetFit { surface, worst, worst_at, rms })
}

/// The surface through a grid at strictly increasing parameters, on averaged knots.
///
/// # Errors
/// What is not allowed, by name and index; fewer than `degree + 1` points in a direction; equations too ill-conditioned for doubles.
pub fn interpolate_grid(
    degrees: [usize; 2],
    parameters: [&[f64]; 2],
    grid: &Grid,
) -> Result<SheetFit, Error> {
    grid.check(parameters)?;
    // Poles of either step, the surface, and residuals.
    spare(grid.points.len(), 8 * size_of::<Vector>())?;
    for k in 0..2 {
        let (degree, count) = (degrees[k], grid.counts[k]);
        let name = ["_u", "_v"][k];
        if degree == 0 || degree > MAX_DEGREE || count <= degree {
            let most = MAX_DEGREE.min(count - 1);
            let text = format!("degree{name}: {degree} given, 1 to {most} accepted");
            return Err(Error::InvalidArgument(text));
        }
        rising(parameters[k]).map_err(|error| suffixed(error, k))?;
    }
    let knots = [0, 1].map(|k| averaged_knots(degrees[k], parameters[k]));
    let both = [&knots[0][..], &knots[1][..]];
    let fit = least_squares_grid(degrees, both, parameters, grid, Ends::Interpolated)?;
    let size = grid.points.iter().fold(0.0, |size: f64, p| size.max(norm(sub(*p, grid.points[0]))));
    let scale = grid.points.iter().flatten().fold(0.0, |most: f64, x| most.max(x.abs()));
    if fit.worst > INTERPOLATION_TOLERANCE * size + 8.0 * f64::EPSILON * scale {
        let text = format!(
            "parameters: the point at {:?} is missed by {:e}, the equations are too ill-conditioned",
            fit.worst_at, fit.worst
        );
        return Err(Error::InvalidArgument(text));
    }
    Ok(fit)
}

/// A surface near a grid at its parameters (not decreasing), with knots added in both directions until every point is within the tolerance at
/// its parameters. Where that is not reached [`SheetFit::worst`] is above the tolerance: look.
///
/// # Errors
/// What is not allowed, by name and index; fewer points than the first knots need.
pub fn adaptive_grid(
    parameters: [&[f64]; 2],
    grid: &Grid,
    options: &GridOptions,
) -> Result<SheetFit, Error> {
    grid.check(parameters)?;
    let rows = grid.rows()?;
    let sides = [rows.as_slice(), &transposed(&rows, grid.counts[0])?];
    let of = |k: usize, tolerance: f64| Adaptive {
        degree: options.degrees[k],
        tolerance,
        max_poles: options.max_poles,
        ends: options.ends,
        breaks: options.breaks[k],
    };
    let mut values = [Vec::new(), Vec::new()];
    for k in 0..2 {
        let domain = [parameters[k][0], parameters[k][grid.counts[k] - 1]];
        let first = of(k, options.tolerance);
        first.check(domain).map_err(|error| suffixed(error, k))?;
        values[k] = first.first_knots(domain);
    }
    // Both directions add to the error; how much each does is seen only together.
    let mut share = 0.7;
    let mut before = 0;
    loop {
        let mut knots = Vec::new();
        let mut columns = Vec::new();
        for k in [1, 0] {
            let width = 3 * grid.counts[1 - k];
            let wanted = of(k, share * options.tolerance);
            let start = std::mem::take(&mut values[k]);
            let found = refined(start, parameters[k], sides[k], [width, 3], &wanted)
                .map_err(|error| suffixed(error, k))?;
            values[k] = found.0.values().to_vec();
            knots.insert(0, found.0);
            columns = found.1;
        }
        let [knots_u, knots_v] = [knots.remove(0), knots.remove(0)];
        let fit = finished([knots_u, knots_v], &columns, parameters, grid, options.ends)?;
        let count = fit.surface.poles().len();
        if fit.worst <= options.tolerance || (count == before && share < 0.1) || share < 1e-3 {
            return Ok(fit);
        }
        (share, before) = (0.7 * share, count);
    }
}
