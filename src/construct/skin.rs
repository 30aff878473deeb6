//! Skinned surfaces: sections made compatible, and their poles interpolated across, row by row, in homogeneous coordinates.
//!
//! Reference: Piegl, Tiller, *The NURBS Book*, 2nd ed., section 10.3.

use super::{gap, invalid};
use crate::bounds::{Vector, add, scaled, sub};
use crate::curve::Curve;
use crate::error::Error;
use crate::fit::{Ends, averaged_knots, rows_near};
use crate::knots::Knots;
use crate::operate::compatible_curves;
use crate::surface::Surface;

/// The sections' poles: for each section, all of them in homogeneous coordinates relative to `center`.
pub(super) struct Rows {
    knots: Knots,
    center: Vector,
    rational: bool,
    values: Vec<f64>,
}

impl Rows {
    pub fn of_curves(sections: &[Curve]) -> Self {
        let center = sections[0].poles()[0];
        let rational = sections.iter().any(Curve::is_rational);
        let mut values = Vec::new();
        for section in sections {
            for (i, pole) in section.poles().iter().enumerate() {
                let weight = if rational { section.weights().map_or(1.0, |w| w[i]) } else { 1.0 };
                values.extend(scaled(sub(*pole, center), weight));
                values.push(weight);
            }
        }
        Self { knots: sections[0].knots().clone(), center, rational, values }
    }
}

/// The surface through sections at parameters v: u along the sections.
pub(super) fn interpolated(
    rows: &Rows,
    parameters: &[f64],
    degree: usize,
) -> Result<Surface, Error> {
    let (count_u, count_v) = (rows.knots.pole_count(), parameters.len());
    let values = averaged_knots(degree, parameters);
    let knots_v = Knots::new(&values, degree, count_v).map_err(|error| error.named("_v"))?;
    let list =
        rows_near(&knots_v, parameters, rows.values.clone(), 4 * count_u, Ends::Interpolated)?;
    let (mut poles, mut weights) = (Vec::new(), Vec::new());
    for i in 0..count_u {
        for j in 0..count_v {
            let at = &list[4 * (j * count_u + i)..][..4];
            let weight = if rows.rational { at[3] } else { 1.0 };
            if weight.is_nan() || weight <= 0.0 {
                let text =
                    format!("sections: interpolated weight ({i}, {j}) is {weight}, not positive");
                return Err(Error::Unsupported(text));
            }
            poles.push(add(rows.center, [0, 1, 2].map(|k| at[k] / weight)));
            weights.push(weight);
        }
    }
    Surface::new(
        rows.knots.values(),
        knots_v.values(),
        rows.knots.degree(),
        degree,
        &poles,
        count_u,
        count_v,
        rows.rational.then_some(&weights[..]),
    )
}

/// The surface through sections, in order: u along them (over the domain of the first), v across, of a degree less than their number.
/// `parameters` are the v of the sections, strictly increasing; without them chordal ones from 0 to 1, the mean over all poles.
///
/// # Errors
/// Fewer than two sections, a degree or parameters that do not fit, by name and index; sections whose poles all are the same as those of the one
/// before; rational ones between which a weight would not be positive.
pub fn skinned(
    sections: &[Curve],
    degree: usize,
    parameters: Option<&[f64]>,
) -> Result<Surface, Error> {
    let count = sections.len();
    if count < 2 {
        return invalid(format!("sections: {count} given, at least 2 needed"));
    }
    if degree == 0 || degree >= count || degree > crate::knots::MAX_DEGREE {
        let most = (count - 1).min(crate::knots::MAX_DEGREE);
        return invalid(format!("degree_v: {degree} given, 1 to {most} accepted"));
    }
    let curves = compatible_curves(sections)?;
    let parameters = match parameters {
        None => chordal(&curves)?,
        Some(list) => {
            if list.len() != count {
                return invalid(format!("parameters: {} given, {count} expected", list.len()));
            }
            let rises = |w: &[f64]| w[0] < w[1] && w[0].is_finite() && w[1].is_finite();
            if let Some(i) = list.windows(2).position(|w| !rises(w)) {
                return invalid(format!(
                    "parameters: parameter {} is not greater than parameter {i}",
                    i + 1
                ));
            }
            list.to_vec()
        }
    };
    interpolated(&Rows::of_curves(&curves), &parameters, degree)
}

fn chordal(curves: &[Curve]) -> Result<Vec<f64>, Error> {
    let count = curves[0].poles().len();
    let mut steps = vec![0.0; curves.len() - 1];
    for i in 0..count {
        let chords: Vec<f64> =
            curves.windows(2).map(|w| gap(w[0].poles()[i], w[1].poles()[i])).collect();
        let length: f64 = chords.iter().sum();
        if length > 0.0 {
            steps.iter_mut().zip(chords).for_each(|(step, chord)| *step += chord / length);
        }
    }
    let total: f64 = steps.iter().sum();
    if let Some(i) = steps.iter().position(|step| *step <= 0.0) {
        return invalid(format!("sections: section {} is section {i}", i + 1));
    }
    let mut at = 0.0;
    let mut list = vec![0.0];
    for step in steps {
        at += step / total;
        list.push(at);
    }
    list[curves.len() - 1] = 1.0;
    Ok(list)
}
