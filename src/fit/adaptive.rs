//! Knots where they are needed: a fit begins with as few spans as allowed, and spans that miss a sample are cut.
//!
//! A cut lies halfway between two neighbouring samples, so that every span keeps samples of its own: with at least as many
//! samples as poles, every pole then is determined (Schoenberg, Whitney). The error of a span of length h falls like
//! `h^(degree+1)`: that tells into how many pieces it is cut, 2 to 4.

use super::parameters::{check_parameters, check_points, distance};
use super::{Ends, Fit, Spline, fitted, measured};
use crate::error::Error;
use crate::knots::{Knots, MAX_DEGREE};
use crate::portable::SameDigits;

/// How [`adaptive`] and [`of_function`] fit.
#[derive(Clone, Debug, PartialEq)]
pub struct Adaptive<'a> {
    /// Degree of the spline, 1 to 31; 3 by default.
    pub degree: usize,
    /// Distance of a sample at its parameter that is good enough; positive.
    pub tolerance: f64,
    /// No more poles than that; 4096 by default.
    pub max_poles: usize,
    /// What happens at the ends; interpolated by default.
    pub ends: Ends,
    /// Parameters inside the domain, increasing, at which the spline may break from the beginning: knots of this
    /// multiplicity, 1 to degree.
    pub breaks: &'a [(f64, usize)],
}

impl Default for Adaptive<'_> {
    fn default() -> Self {
        Self { degree: 3, tolerance: 1e-6, max_poles: 4096, ends: Ends::default(), breaks: &[] }
    }
}

impl Adaptive<'_> {
    fn check(&self, [start, end]: [f64; 2]) -> Result<(), Error> {
        let text = if self.degree == 0 || self.degree > MAX_DEGREE {
            format!("degree: {} given, 1 to {MAX_DEGREE} accepted", self.degree)
        } else if !(self.tolerance > 0.0 && self.tolerance.is_finite()) {
            format!("tolerance: {} is not positive and finite", self.tolerance)
        } else if self.max_poles <= self.degree {
            format!("max_poles: {} given, at least {} needed", self.max_poles, self.degree + 1)
        } else if let Some(i) = self.breaks.iter().position(|b| !(start < b.0 && b.0 < end)) {
            format!("breaks: break {i} is not inside the domain")
        } else if let Some(i) = self.breaks.windows(2).position(|w| w[1].0 <= w[0].0) {
            format!("breaks: break {} is not behind break {i}", i + 1)
        } else if let Some(i) = self.breaks.iter().position(|b| b.1 == 0 || b.1 > self.degree) {
            format!(
                "breaks: the multiplicity of break {i} is {}, 1 to {} accepted",
                self.breaks[i].1, self.degree
            )
        } else {
            return Ok(());
        };
        Err(Error::InvalidArgument(text))
    }

    /// The knots that are there from the beginning.
    fn first_knots(&self, [start, end]: [f64; 2]) -> Vec<f64> {
        let breaks = self.breaks.iter().flat_map(|&(u, times)| std::iter::repeat_n(u, times));
        let ends = |u| std::iter::repeat_n(u, self.degree + 1);
        ends(start).chain(breaks).chain(ends(end)).collect()
    }

    /// Into how many pieces a span with this error is cut.
    fn pieces(&self, error: f64) -> usize {
        let wished = (error / self.tolerance).power(1.0 / (self.degree + 1) as f64).ceil();
        wished.clamp(2.0, 4.0) as usize
    }
}

/// A spline near `points` at `parameters` (not decreasing), on the domain from the first to the last parameter, with knots added until
/// every point is within the tolerance at its parameter. Where that is not reached, with the knots that the points or
/// `max_poles` allow, [`Fit::worst`] is above the tolerance: look. Cost: O(points * degree^2) for each of about log2(spans) rounds.
///
/// # Errors
/// What is not allowed, by name and index; fewer points than the first knots need.
pub fn adaptive<const N: usize>(
    parameters: &[f64],
    points: &[[f64; N]],
    options: &Adaptive,
) -> Result<Fit<N>, Error> {
    check_points(points, 2)?;
    check_parameters(parameters, points.len())?;
    let domain = [parameters[0], parameters[points.len() - 1]];
    options.check(domain)?;
    let distinct = 1 + parameters.windows(2).filter(|w| w[0] < w[1]).count();
    let limit = options.max_poles.min(distinct);
    let mut values = options.first_knots(domain);
    let mut best: Option<Fit<N>> = None;
    loop {
        let pole_count = values.len() - options.degree - 1;
        let knots =
            Knots::new(&values, options.degree, pole_count).map_err(|error| error.named(""))?;
        let fit = match (fitted(knots, parameters, points, options.ends), best) {
            (Ok(fit), _) => fit,
            (Err(_), Some(best)) => return Ok(best),
            (Err(error), None) => return Err(error),
        };
        let cuts = cuts(&fit.spline, parameters, points, options, limit - pole_count.min(limit));
        if fit.worst <= options.tolerance || cuts.is_empty() {
            return Ok(fit);
        }
        values.extend(cuts);
        values.sort_by(f64::total_cmp);
        best = Some(fit);
    }
}

/// New knots, at most `room`, in the spans that miss a point, the worst spans first.
fn cuts<const N: usize>(
    spline: &Spline<N>,
    parameters: &[f64],
    points: &[[f64; N]],
    options: &Adaptive,
    room: usize,
) -> Vec<f64> {
    let knots = spline.knots();
    let (values, end) = (knots.values(), knots.domain().1);
    let mut missed = Vec::new();
    for span in knots.spans() {
        let first = parameters.partition_point(|&t| t < values[span]);
        let behind = match values[span + 1] {
            upper if upper == end => parameters.len(),
            upper => parameters.partition_point(|&t| t < upper),
        };
        let error = (first..behind)
            .map(|i| distance(&spline.evaluate(parameters[i]), &points[i]))
            .fold(0.0, f64::max);
        if error > options.tolerance {
            missed.push((error, span, first, behind));
        }
    }
    missed.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut cuts = Vec::new();
    for (error, span, first, behind) in missed {
        let pieces = options.pieces(error);
        let mut last = values[span];
        for j in 1..pieces {
            let mut i = first + ((behind - first) * j).div_ceil(pieces);
            while i < behind && parameters[i - 1] == parameters[i] {
                i += 1;
            }
            if i <= first || i >= behind || cuts.len() == room {
                continue;
            }
            let cut = 0.5 * parameters[i - 1] + 0.5 * parameters[i];
            if last < cut
                && parameters[i - 1] < cut
                && cut < parameters[i]
                && cut < values[span + 1]
            {
                cuts.push(cut);
                last = cut;
            }
        }
    }
    cuts
}

/// The samples of one span: evenly spread, every second one only for checking.
struct Piece<const N: usize> {
    start: f64,
    end: f64,
    points: Vec<[f64; N]>,
}

impl<const N: usize> Piece<N> {
    fn sample(
        function: &impl Fn(f64) -> Option<[f64; N]>,
        [start, end]: [f64; 2],
        degree: usize,
    ) -> Result<Self, Error> {
        let mut piece = Self { start, end, points: Vec::new() };
        for i in 0..2 * (degree + 2) {
            piece.points.push(valued(function, piece.place(i, degree))?);
        }
        Ok(piece)
    }

    fn place(&self, i: usize, degree: usize) -> f64 {
        self.start + (self.end - self.start) * (i as f64 / (2 * (degree + 2)) as f64)
    }
}

fn valued<const N: usize>(
    function: &impl Fn(f64) -> Option<[f64; N]>,
    t: f64,
) -> Result<[f64; N], Error> {
    let refused = || Error::InvalidArgument(format!("function: no finite point at parameter {t}"));
    function(t).filter(|p| p.iter().all(|x| x.is_finite())).ok_or_else(refused)
}

/// A spline near `function` on `domain`: samples and knots are added where the function is missed at samples that the fit did not use.
/// [`Fit::worst`] is the greatest distance at all samples, `2 degree + 4` in each span: measured densely, not proven between them.
///
/// # Errors
/// What is not allowed, by name and index; a parameter at which `function` has no finite point.
pub fn of_function<const N: usize>(
    function: impl Fn(f64) -> Option<[f64; N]>,
    domain: [f64; 2],
    options: &Adaptive,
) -> Result<Fit<N>, Error> {
    let [start, end] = domain;
    if !(start.is_finite() && end.is_finite() && start < end) {
        return Err(Error::InvalidArgument("domain: is empty or not finite".into()));
    }
    options.check(domain)?;
    let degree = options.degree;
    let last = valued(&function, end)?;
    let mut values = options.first_knots(domain);
    let mut pieces = Vec::new();
    for pair in values[degree..values.len() - degree].windows(2).filter(|w| w[0] < w[1]) {
        pieces.push(Piece::sample(&function, [pair[0], pair[1]], degree)?);
    }
    loop {
        let samples = |step: usize| {
            let of_piece = move |piece: &Piece<N>| -> Vec<(f64, [f64; N])> {
                let every = piece.points.iter().enumerate().step_by(step);
                every.map(|(i, point)| (piece.place(i, degree), *point)).collect()
            };
            pieces.iter().flat_map(of_piece).chain(std::iter::once((end, last))).unzip()
        };
        let pole_count = values.len() - degree - 1;
        let knots = Knots::new(&values, degree, pole_count).map_err(|error| error.named(""))?;
        let (parameters, points): (Vec<_>, Vec<_>) = samples(2);
        let fit = fitted(knots, &parameters, &points, options.ends)?;
        let (parameters, points): (Vec<_>, Vec<_>) = samples(1);
        let fit = measured(fit.spline, &parameters, &points);
        if fit.worst <= options.tolerance {
            return Ok(fit);
        }
        let mut room = options.max_poles.saturating_sub(pole_count);
        let (mut next, mut cut_any) = (Vec::new(), false);
        for piece in pieces {
            let error = (0..piece.points.len())
                .map(|i| distance(&fit.spline.evaluate(piece.place(i, degree)), &piece.points[i]))
                .fold(0.0, f64::max);
            let count =
                if error > options.tolerance { options.pieces(error).min(room + 1) } else { 1 };
            let share = |j: usize| match j {
                0 => piece.start,
                j if j == count => piece.end,
                j => piece.start + (piece.end - piece.start) * (j as f64 / count as f64),
            };
            if count == 1
                || (0..count)
                    .any(|j| share(j + 1) - share(j) <= 16.0 * f64::EPSILON * share(j).abs())
            {
                next.push(piece);
                continue;
            }
            for j in 0..count {
                next.push(Piece::sample(&function, [share(j), share(j + 1)], degree)?);
            }
            values.extend((1..count).map(share));
            room -= count - 1;
            cut_any = true;
        }
        if !cut_any {
            return Ok(fit);
        }
        values.sort_by(f64::total_cmp);
        pieces = next;
    }
}
