//! Splines near points and through points, of any dimension.
//!
//! ```text
//!   least squares   knots and parameters given       sum |C(t_i) - P_i|^2 is least
//!   interpolation   as many poles as points          C(t_i) = P_i
//!   adaptive        parameters given                 knots are added where a point is missed
//!   of a function   nothing given                    samples and knots are added where the function is missed
//! ```
//!
//! The equations are banded and solved by rotations (`triangle`), not by normal equations. Every result tells the distance of the
//! worst point at its parameter, measured on the result: an upper bound of its distance from the curve. Points are recentred first.
//!
//! Reference: Piegl, Tiller, *The NURBS Book*, 2nd ed., chapter 9; Dierckx, *Curve and Surface Fitting with Splines*, 1993.
//! Limit: nothing is smoothed; knots denser than the points are refused, by the pole that the points do not determine.

use crate::basis;
use crate::curve::{Curve, largest};
use crate::error::Error;
use crate::knots::{Knots, MAX_DEGREE};

mod adaptive;
mod certificate;
mod conditions;
mod grid;
mod near;
mod parameters;
mod sample;
mod scattered;
mod triangle;

pub use adaptive::{Adaptive, adaptive, of_function};
pub use certificate::{Certificate, certify};
pub use conditions::{Condition, interpolate_periodic, interpolate_with, least_squares_periodic};
pub use grid::{
    Grid, GridOptions, SheetFit, adaptive_grid, grid_parameters, interpolate_grid,
    least_squares_grid,
};
pub use near::{Near, NearOptions, curve_near, plane_parameters, surface_near};
pub use parameters::{Spacing, averaged_knots, parameters, spread_knots};
use parameters::{check_parameters, check_points, distance};
use triangle::{Triangle, zeros};

/// An interpolant that misses a point by more than this part of the size of the points is refused.
const INTERPOLATION_TOLERANCE: f64 = 1e-9;

/// What happens at the first and last point.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Ends {
    /// They count like all others.
    Free,
    /// The curve begins and ends there. The knots must be clamped, the first and last parameter the ends of the domain.
    #[default]
    Interpolated,
}

/// A B-spline in N dimensions: a function of one parameter, not rational.
#[derive(Clone, Debug, PartialEq)]
pub struct Spline<const N: usize> {
    knots: Knots,
    poles: Vec<[f64; N]>,
}

/// A spline and how far it is from the points that it was fitted to.
#[derive(Clone, Debug, PartialEq)]
pub struct Fit<const N: usize> {
    /// The result.
    pub spline: Spline<N>,
    /// The greatest distance of a point from the spline at the point's parameter.
    pub worst: f64,
    /// The parameter of that point.
    pub worst_at: f64,
    /// Root of the mean of the squared distances.
    pub rms: f64,
}

impl<const N: usize> Spline<N> {
    /// A spline of full knots.
    ///
    /// # Errors
    /// The first value that is not allowed, by name and index.
    pub fn new(degree: usize, knots: &[f64], poles: Vec<[f64; N]>) -> Result<Self, Error> {
        let knots = Knots::new(knots, degree, poles.len()).map_err(|error| error.named(""))?;
        check_points(&poles, 1)?;
        Ok(Self { knots, poles })
    }

    /// The knots.
    pub fn knots(&self) -> &Knots {
        &self.knots
    }

    /// The poles.
    pub fn poles(&self) -> &[[f64; N]] {
        &self.poles
    }

    /// The point at `u` in the domain.
    pub fn evaluate(&self, u: f64) -> [f64; N] {
        let mut out = [[0.0; N]];
        self.derivatives(u, 0, &mut out);
        out[0]
    }

    /// Point and derivatives to order `count` at `u` in the domain, to `out[0..=count]`.
    pub fn derivatives(&self, u: f64, count: usize, out: &mut [[f64; N]]) {
        let (degree, span) = (self.knots.degree(), self.knots.span(u));
        let highest = count.min(degree);
        let mut room = [0.0; (MAX_DEGREE + 1) * (MAX_DEGREE + 1)];
        let table = &mut room[..(highest + 1) * (degree + 1)];
        basis::derivatives(&self.knots, span, u, highest, table);
        let poles = &self.poles[span - degree..=span];
        let center = poles[largest(&table[..=degree])];
        out[..=count].fill([0.0; N]);
        for (row, out) in table.chunks_exact(degree + 1).zip(out.iter_mut()) {
            for (n, pole) in row.iter().zip(poles) {
                (0..N).for_each(|x| out[x] += n * (pole[x] - center[x]));
            }
        }
        (0..N).for_each(|x| out[0][x] += center[x]);
    }
}

impl Spline<3> {
    /// The same as a curve in space.
    pub fn curve(&self) -> Result<Curve, Error> {
        Curve::new(self.knots.values(), self.knots.degree(), &self.poles, None)
    }
}

impl Spline<2> {
    /// The same as a curve in the plane z = 0.
    pub fn curve(&self) -> Result<Curve, Error> {
        let poles: Vec<[f64; 3]> = self.poles.iter().map(|p| [p[0], p[1], 0.0]).collect();
        Curve::new(self.knots.values(), self.knots.degree(), &poles, None)
    }
}

/// The spline on full `knots` that is nearest to `points` at `parameters` (not decreasing, in the domain), in the sense of least squares.
/// Cost: O(points * degree^2).
///
/// # Errors
/// What is not allowed, by name and index; a pole that the parameters leave open ("parameters: ..."), if some basis functions see fewer
/// points than they are.
pub fn least_squares<const N: usize>(
    degree: usize,
    knots: &[f64],
    parameters: &[f64],
    points: &[[f64; N]],
    ends: Ends,
) -> Result<Fit<N>, Error> {
    let pole_count = knots.len().saturating_sub(degree.saturating_add(1));
    let knots = Knots::new(knots, degree, pole_count).map_err(|error| error.named(""))?;
    check_points(points, 1)?;
    check_parameters(parameters, points.len())?;
    fitted(knots, parameters, points, ends)
}

/// The spline through `points` at strictly increasing `parameters`, on averaged knots.
///
/// # Errors
/// What is not allowed, by name and index; fewer than `degree + 1` points; equations too ill-conditioned for doubles.
pub fn interpolate<const N: usize>(
    degree: usize,
    parameters: &[f64],
    points: &[[f64; N]],
) -> Result<Fit<N>, Error> {
    if degree == 0 || degree > MAX_DEGREE {
        return Err(Error::InvalidArgument(format!(
            "degree: {degree} given, 1 to {MAX_DEGREE} accepted"
        )));
    }
    check_points(points, degree + 1)?;
    check_parameters(parameters, points.len())?;
    rising(parameters)?;
    let knots = averaged_knots(degree, parameters);
    let fit = least_squares(degree, &knots, parameters, points, Ends::Interpolated)?;
    checked_interpolant(fit, points)
}

/// Refuses parameters that do not increase strictly.
fn rising(parameters: &[f64]) -> Result<(), Error> {
    match parameters.windows(2).position(|w| w[1] <= w[0]) {
        Some(i) => {
            let text = format!("parameters: parameter {} equals parameter {i}", i + 1);
            Err(Error::InvalidArgument(text))
        }
        None => Ok(()),
    }
}

/// Refuses an interpolant that does not interpolate.
fn checked_interpolant<const N: usize>(fit: Fit<N>, points: &[[f64; N]]) -> Result<Fit<N>, Error> {
    let size = points.iter().fold(0.0, |size: f64, p| size.max(distance(p, &points[0])));
    let scale = points.iter().flatten().fold(0.0, |most: f64, x| most.max(x.abs()));
    if fit.worst <= INTERPOLATION_TOLERANCE * size + 8.0 * f64::EPSILON * scale {
        return Ok(fit);
    }
    let (at, missed) = (fit.worst_at, fit.worst);
    Err(Error::InvalidArgument(format!(
        "parameters: the point at {at} is missed by {missed:e}, the equations are too ill-conditioned"
    )))
}

/// The work of [`least_squares`], for what has been checked, apart from the domain.
fn fitted<const N: usize>(
    knots: Knots,
    parameters: &[f64],
    points: &[[f64; N]],
    ends: Ends,
) -> Result<Fit<N>, Error> {
    let center = points[0];
    let mut right = zeros(points.len(), N)?;
    for (right, point) in right.chunks_exact_mut(N).zip(points) {
        (0..N).for_each(|x| right[x] = point[x] - center[x]);
    }
    let list = solve(&knots, parameters, right, N, ends)?;
    Ok(measured(spline(knots, &list, points, ends), parameters, points))
}

/// The spline of poles relative to the first point.
fn spline<const N: usize>(
    knots: Knots,
    list: &[f64],
    points: &[[f64; N]],
    ends: Ends,
) -> Spline<N> {
    let center = points[0];
    let mut poles: Vec<[f64; N]> =
        list.chunks_exact(N).map(|pole| std::array::from_fn(|x| pole[x] + center[x])).collect();
    if ends == Ends::Interpolated {
        // Without the rounding of the recentring.
        let last = poles.len() - 1;
        (poles[0], poles[last]) = (center, points[points.len() - 1]);
    }
    Spline { knots, poles }
}

/// The point at `t` of poles of any width, to `out`.
fn point(knots: &Knots, poles: &[f64], t: f64, out: &mut [f64]) {
    let (degree, width, span) = (knots.degree(), out.len(), knots.span(t));
    let mut row = [0.0; MAX_DEGREE + 1];
    basis::values(knots, span, t, &mut row[..=degree]);
    out.fill(0.0);
    for (n, pole) in row[..=degree].iter().zip(poles[(span - degree) * width..].chunks_exact(width))
    {
        out.iter_mut().zip(pole).for_each(|(x, p)| *x += n * p);
    }
}

/// A spline with its distances from the points.
fn measured<const N: usize>(spline: Spline<N>, parameters: &[f64], points: &[[f64; N]]) -> Fit<N> {
    let (mut worst, mut worst_at, mut sum) = (0.0, parameters[0], 0.0);
    for (&t, point) in parameters.iter().zip(points) {
        let missed = distance(&spline.evaluate(t), point);
        sum += missed * missed;
        if missed > worst {
            (worst, worst_at) = (missed, t);
        }
    }
    let rms = (sum / points.len() as f64).sqrt();
    Fit { spline, worst, worst_at, rms }
}

/// The poles, `width` numbers each, of least squares against `right`, `width` numbers for each parameter (which is used up).
/// `ends` fixes the first and last pole.
fn solve(
    knots: &Knots,
    parameters: &[f64],
    mut right: Vec<f64>,
    width: usize,
    ends: Ends,
) -> Result<Vec<f64>, Error> {
    let (degree, poles) = (knots.degree(), knots.pole_count());
    if let Some(i) = parameters.iter().position(|&t| !knots.contains(t)) {
        return Err(Error::InvalidArgument(format!(
            "parameters: parameter {i} is outside the domain"
        )));
    }
    let fixed = match ends {
        Ends::Free => 0,
        Ends::Interpolated => 1,
    };
    let last = parameters.len() - 1;
    let (mut first_pole, mut last_pole) = (Vec::new(), Vec::new());
    if ends == Ends::Interpolated {
        check_ends(knots, parameters)?;
        first_pole = right[..width].to_vec();
        last_pole = right[last * width..].to_vec();
    }
    let mut triangle = Triangle::new(poles - 2 * fixed, degree + 1, width)?;
    let mut row = [0.0; MAX_DEGREE + 1];
    let row = &mut row[..=degree];
    for (&t, right) in parameters.iter().zip(right.chunks_exact_mut(width)) {
        let span = knots.span(t);
        basis::values(knots, span, t, row);
        let mut first = span - degree;
        if fixed == 1 {
            if span == poles - 1 {
                right.iter_mut().zip(&last_pole).for_each(|(x, p)| *x -= row[degree] * p);
                row[degree] = 0.0;
            }
            if first == 0 {
                right.iter_mut().zip(&first_pole).for_each(|(x, p)| *x -= row[0] * p);
                row.copy_within(1.., 0);
                row[degree] = 0.0;
            } else {
                first -= 1;
            }
        }
        triangle.add(first, row, right);
    }
    let inner = triangle.solve().map_err(|i| {
        Error::InvalidArgument(format!("parameters: too few of them for pole {}", i + fixed))
    })?;
    first_pole.extend(inner);
    first_pole.extend(last_pole);
    Ok(first_pole)
}

/// Poles near rows of `width` numbers at parameters, in the sense of least squares; as many poles as rows interpolate.
pub(crate) fn rows_near(
    knots: &Knots,
    parameters: &[f64],
    rows: Vec<f64>,
    width: usize,
    ends: Ends,
) -> Result<Vec<f64>, Error> {
    check_parameters(parameters, rows.len() / width)?;
    solve(knots, parameters, rows, width, ends)
}

/// Can the ends be poles?
fn check_ends(knots: &Knots, parameters: &[f64]) -> Result<(), Error> {
    let (degree, (start, end)) = (knots.degree(), knots.domain());
    let clamped =
        knots.values()[1] == start && knots.values()[knots.pole_count() + degree - 1] == end;
    let (first, last) = (parameters[0], parameters[parameters.len() - 1]);
    let text = if !clamped {
        "knots: the ends are interpolated on clamped knots only".into()
    } else if first != start {
        format!("parameters: parameter 0 is {first}, not the domain's begin {start}")
    } else if last != end {
        format!(
            "parameters: parameter {} is {last}, not the domain's end {end}",
            parameters.len() - 1
        )
    } else {
        return Ok(());
    };
    Err(Error::InvalidArgument(text))
}
