//! Interpolation with conditions at the ends, and closed curves.
//!
//! ```text
//!   tangents   derivatives given at one end or at both
//!   natural    odd degree p: derivatives of order (p+1)/2 .. p-1 vanish at both ends; the smoothest interpolant
//!   periodic   the last parameter is the first one again; poles repeat after one turn
//! ```
//!
//! A periodic spline of degree p with m poles in a turn: the equations wrap around. The last p unknowns are carried along as further
//! right sides of the banded triangle, and what the rotations leave of an equation belongs to a small triangle of their own.
//!
//! Reference: Piegl, Tiller, *The NURBS Book*, 2nd ed., section 9.2; Dierckx, *Curve and Surface Fitting with Splines*, section 4.1.3.

use super::parameters::{averaged_knots, check_parameters, check_points};
use super::triangle::{Triangle, zeros};
use super::{Fit, Spline, checked_interpolant, measured, rising};
use crate::basis;
use crate::error::Error;
use crate::knots::{Knots, MAX_DEGREE};

/// What is asked of the ends of an interpolant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Condition<const N: usize> {
    /// The first derivative with respect to the parameter at the first and the last point, where given. Degree 2 or more.
    Tangents([Option<[f64; N]>; 2]),
    /// The natural spline: odd degrees.
    Natural,
}

/// One equation: derivative of some order at a parameter.
struct Equation<const N: usize> {
    at: f64,
    order: usize,
    value: [f64; N],
}

/// The spline through `points` at strictly increasing `parameters` with conditions at the ends.
///
/// Knots: cubics and natural splines have them at the parameters, others at means of parameters in a row.
///
/// # Errors
/// What is not allowed, by name and index: a degree that has no such conditions, too few points, tangents that are not finite.
pub fn interpolate_with<const N: usize>(
    degree: usize,
    parameters: &[f64],
    points: &[[f64; N]],
    condition: &Condition<N>,
) -> Result<Fit<N>, Error> {
    let refuse = |text: String| Err(Error::InvalidArgument(text));
    let natural = matches!(condition, Condition::Natural);
    let least = if natural { 1 } else { 2 };
    if degree < least || degree > MAX_DEGREE || (natural && degree % 2 == 0) {
        let which = if natural { "odd degrees" } else { "2" };
        return refuse(format!("degree: {degree} given, {which} to {MAX_DEGREE} accepted"));
    }
    let (mut before, mut behind) = (Vec::new(), Vec::new());
    let zero = [0.0; N];
    match condition {
        Condition::Natural => {
            let orders = degree.div_ceil(2)..degree;
            before.extend(orders.clone().map(|order| (order, zero)));
            behind.extend(orders.map(|order| (order, zero)));
        }
        Condition::Tangents(tangents) => {
            for (k, tangent) in tangents.iter().enumerate() {
                if tangent.is_some_and(|t| t.iter().any(|x| !x.is_finite())) {
                    return refuse(format!("tangents: tangent {k} is not finite"));
                }
            }
            before.extend(tangents[0].map(|value| (1, value)));
            behind.extend(tangents[1].map(|value| (1, value)));
        }
    }
    let conditions = before.len() + behind.len();
    check_points(points, (degree + 1).saturating_sub(conditions).max(2))?;
    check_parameters(parameters, points.len())?;
    rising(parameters)?;
    let (start, end) = (parameters[0], parameters[points.len() - 1]);
    let values = if natural || (degree == 3 && conditions == 2) {
        let inner = &parameters[1..points.len() - 1];
        [&vec![start; degree + 1][..], inner, &vec![end; degree + 1]].concat()
    } else {
        let first = vec![start; before.len()];
        averaged_knots(degree, &[&first[..], parameters, &vec![end; behind.len()]].concat())
    };
    let inner = points.iter().zip(parameters).map(|(&value, &at)| Equation { at, order: 0, value });
    let mut equations: Vec<_> = inner.collect();
    let last = equations.split_off(points.len() - 1);
    let first = equations.drain(..1).collect::<Vec<_>>();
    let at = |at: f64| move |(order, value)| Equation { at, order, value };
    let order = first.into_iter().chain(before.into_iter().map(at(start)));
    let equations = order.chain(equations).chain(behind.into_iter().map(at(end))).chain(last);
    let knots = Knots::new(&values, degree, values.len() - degree - 1).map_err(|e| e.named(""))?;
    let spline = solved(knots, equations, points[0])?;
    checked_interpolant(measured(spline, parameters, points), points)
}

/// The spline that satisfies as many equations as it has poles.
fn solved<const N: usize>(
    knots: Knots,
    equations: impl Iterator<Item = Equation<N>>,
    center: [f64; N],
) -> Result<Spline<N>, Error> {
    let degree = knots.degree();
    let mut triangle = Triangle::new(knots.pole_count(), degree + 1, N)?;
    let mut table = vec![0.0; (degree + 1) * (degree + 1)];
    for Equation { at, order, mut value } in equations {
        let span = knots.span(at);
        basis::derivatives(&knots, span, at, order, &mut table);
        let row = &mut table[order * (degree + 1)..][..=degree];
        if order == 0 {
            (0..N).for_each(|x| value[x] -= center[x]);
        }
        // Derivatives would outweigh points by powers of the span's length.
        let scale = 1.0 / row.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        row.iter_mut().chain(&mut value).for_each(|x| *x *= scale);
        triangle.add(span - degree, row, &mut value);
    }
    let list = triangle.solve().map_err(|i| {
        Error::InvalidArgument(format!("parameters: pole {i} is not determined by them"))
    })?;
    let pole = |pole: &[f64]| std::array::from_fn(|x| pole[x] + center[x]);
    Ok(Spline { knots, poles: list.chunks_exact(N).map(pole).collect() })
}

/// The closed spline with one pole for each of the `breaks` but the last, which is the first one a turn later, that is nearest to `points`
/// at `parameters` (within the turn, in any order) in the sense of least squares. The knots run on beyond the turn: the curve is
/// unclamped, and its first `degree` poles are repeated at its end.
///
/// # Errors
/// What is not allowed, by name and index; poles that the parameters leave open.
pub fn least_squares_periodic<const N: usize>(
    degree: usize,
    breaks: &[f64],
    parameters: &[f64],
    points: &[[f64; N]],
) -> Result<Fit<N>, Error> {
    let refuse = |text: String| Err(Error::InvalidArgument(text));
    if degree == 0 || degree > MAX_DEGREE {
        return refuse(format!("degree: {degree} given, 1 to {MAX_DEGREE} accepted"));
    }
    if breaks.len() < degree + 2 {
        return refuse(format!("breaks: {} given, at least {} needed", breaks.len(), degree + 2));
    }
    check_points(points, 1)?;
    if parameters.len() != points.len() {
        return refuse(format!(
            "parameters: {} given, {} expected",
            parameters.len(),
            points.len()
        ));
    }
    let (start, end) = (breaks[0], breaks[breaks.len() - 1]);
    if let Some(i) = parameters.iter().position(|t| !(start <= *t && *t <= end)) {
        return refuse(format!("parameters: parameter {i} is outside the domain"));
    }
    let count = breaks.len() - 1;
    let period = end - start;
    let before = breaks[count - degree..count].iter().map(|u| u - period);
    let behind = breaks[1..=degree].iter().map(|u| u + period);
    let values: Vec<f64> = before.chain(breaks.iter().copied()).chain(behind).collect();
    let knots =
        Knots::new(&values, degree, count + degree).map_err(|error| match error.named("") {
            Error::InvalidArgument(text) => Error::InvalidArgument(format!("breaks: {text}")),
            other => other,
        })?;
    // The last `degree` poles of the turn are the border.
    let (banded, center) = (count - degree, points[0]);
    let mut triangle = Triangle::new(banded, degree + 1, degree + N)?;
    let mut corner = Triangle::new(degree, degree, N)?;
    let mut order: Vec<usize> = (0..points.len()).collect();
    order.sort_by(|&a, &b| parameters[a].total_cmp(&parameters[b]));
    let mut values = vec![0.0; degree + 1];
    let mut right = zeros(degree + N, 1)?;
    for i in order {
        let span = knots.span(parameters[i]);
        basis::values(&knots, span, parameters[i], &mut values);
        let mut row = [0.0; MAX_DEGREE + 1];
        right.fill(0.0);
        let first = Some(span - degree).filter(|first| *first < banded).unwrap_or(0);
        for (k, n) in values.iter().enumerate() {
            match (span - degree + k) % count {
                column if column >= banded => right[column - banded] += n,
                column => row[column - first] += n,
            }
        }
        (0..N).for_each(|x| right[degree + x] = points[i][x] - center[x]);
        triangle.add(first, &mut row[..=degree], &mut right);
        let (border, rest) = right.split_at_mut(degree);
        corner.add(0, border, rest);
    }
    let open =
        |i: usize| Error::InvalidArgument(format!("parameters: too few of them for pole {i}"));
    let border = corner.solve().map_err(|i| open(banded + i))?;
    // With the border known, its part of the right sides moves over: one more back substitution.
    let all = triangle.solve().map_err(open)?;
    let mut poles: Vec<[f64; N]> = Vec::with_capacity(count + degree);
    for own in all.chunks_exact(degree + N) {
        let value = |x: usize| {
            let moved: f64 = (0..degree).map(|b| own[b] * border[b * N + x]).sum();
            own[degree + x] - moved + center[x]
        };
        poles.push(std::array::from_fn(value));
    }
    poles.extend(
        border.chunks_exact(N).map(|p| std::array::from_fn::<_, N, _>(|x| p[x] + center[x])),
    );
    poles.extend_from_within(..degree);
    Ok(measured(Spline { knots, poles }, parameters, points))
}

/// The closed spline through `points` at strictly increasing `parameters`, of which there is one more: the end of the turn, where the first
/// point comes again. Knots lie at the parameters for odd degrees, halfway between them for even ones.
///
/// # Errors
/// What is not allowed, by name and index: fewer than `degree + 1` points; points and parameters that determine no such spline.
pub fn interpolate_periodic<const N: usize>(
    degree: usize,
    parameters: &[f64],
    points: &[[f64; N]],
) -> Result<Fit<N>, Error> {
    check_points(points, degree.saturating_add(1))?;
    check_parameters(parameters, points.len() + 1)?;
    rising(parameters)?;
    let count = points.len();
    let period = parameters[count] - parameters[0];
    if degree % 2 == 1 {
        let fit = least_squares_periodic(degree, parameters, &parameters[..count], points)?;
        return checked_interpolant(fit, points);
    }
    // The turn begins half a step before the first parameter; the last parameter's place comes a turn earlier.
    let middles = parameters.windows(2).map(|w| 0.5 * w[0] + 0.5 * w[1]);
    let mut breaks = vec![0.5 * parameters[0] + 0.5 * (parameters[count - 1] - period)];
    breaks.extend(middles);
    let fit = least_squares_periodic(degree, &breaks, &parameters[..count], points)?;
    checked_interpolant(fit, points)
}
