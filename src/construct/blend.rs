//! Surfaces of a network of curves: Coons, Ferguson, Gordon.
//!
//! ```text
//!            border 3 (v = v1)          Coons    ruled in u  +  ruled in v  -  bilinear in the corners
//!          +------------------+         bicubic  Hermite in u  +  Hermite in v  -  bicubic: slopes across the borders, too
//! border 0 |                  | 1       Gordon   skin of the u curves  +  skin of the v curves  -  interpolant of their crossings
//!  (u = u0)+------------------+
//!            border 2 (v = v0)          each term corrects what the others count twice (a Boolean sum)
//! ```
//!
//! Rational borders of a bilinear Coons patch are given end weights of 1 first (a change of parameter, `weights::form`): then the sum of
//! homogeneous poles has them as its borders.
//!
//! Reference: Piegl, Tiller, *The NURBS Book*, 2nd ed., sections 10.5 and 10.6; Gordon, *Spline-blended surface interpolation through
//! curve networks*, 1969.

use super::skin::{Rows, interpolated};
use super::sweep::across;
use super::{check_interval, check_vector, gap, invalid};
use crate::bounds::{Vector, add, scaled, sub};
use crate::curve::Curve;
use crate::error::Error;
use crate::operate::{compatible_curves, compatible_surfaces};
use crate::surface::Surface;
use crate::weights::form::standard;

/// Corners, slopes and twists must meet within this part of the size of the data; what is left of the gap is left on the borders.
pub const MEETING_TOLERANCE: f64 = 1e-7;

/// A sum of surfaces with factors: homogeneous poles over common knots.
fn summed(parts: [(f64, Surface); 3]) -> Result<Surface, Error> {
    let factors = [parts[0].0, parts[1].0, parts[2].0];
    let surfaces = compatible_surfaces(&parts.map(|part| part.1))?;
    let first = &surfaces[0];
    let count = first.poles().len();
    let (mut poles, mut weights) = (Vec::with_capacity(count), Vec::with_capacity(count));
    for k in 0..count {
        let center = first.poles()[k];
        let (mut sum, mut weight) = ([0.0; 3], 0.0);
        for (surface, factor) in surfaces.iter().zip(factors) {
            let part = factor * surface.weights().map_or(1.0, |w| w[k]);
            sum = add(sum, scaled(sub(surface.poles()[k], center), part));
            weight += part;
        }
        if weight.is_nan() || weight <= 0.0 {
            let text = format!("borders: the weight {k} of their blend is {weight}, not positive");
            return Err(Error::Unsupported(text));
        }
        poles.push(add(center, scaled(sum, 1.0 / weight)));
        weights.push(weight);
    }
    let counts = [first.knots_u(), first.knots_v()].map(|knots| knots.pole_count());
    Surface::new(
        first.knots_u().values(),
        first.knots_v().values(),
        first.knots_u().degree(),
        first.knots_v().degree(),
        &poles,
        counts[0],
        counts[1],
        first.weights().is_some().then_some(&weights[..]),
    )
}

/// u and v exchanged, for curves that run in v.
fn along_v(curves: &[Curve], knots_u: &[f64], degree_u: usize) -> Result<Surface, Error> {
    across(curves, knots_u, degree_u)?.swap()
}

fn ends(curve: &Curve) -> [Vector; 2] {
    let (start, end) = curve.domain();
    [curve.evaluate(start), curve.evaluate(end)]
}

/// Corner (i, j): the border u_i at v_j, when the border v_j at u_i is the same.
fn corners(borders: &[Curve; 4], size: f64) -> Result<[[Vector; 2]; 2], Error> {
    let [a, b, c, d] = [0, 1, 2, 3].map(|k| ends(&borders[k]));
    let (by_u, by_v) = ([a, b], [c, d]);
    for i in 0..2 {
        for j in 0..2 {
            let apart = gap(by_u[i][j], by_v[j][i]);
            if apart > MEETING_TOLERANCE * size {
                let text = format!(
                    "borders: border {i} and border {} are {apart} apart at corner ({i}, {j})",
                    j + 2
                );
                return invalid(text);
            }
        }
    }
    Ok(by_u)
}

fn size_of(curves: &[Curve]) -> f64 {
    let start = curves[0].poles()[0];
    curves.iter().flat_map(Curve::poles).fold(0.0, |size: f64, p| size.max(gap(*p, start)))
}

/// Domains of u and v: those of border 2 and border 0.
fn domains(borders: &[Curve; 4]) -> [[f64; 2]; 2] {
    [2, 0].map(|k| {
        let (start, end) = borders[k].domain();
        [start, end]
    })
}

fn linear([a, b]: [f64; 2]) -> [f64; 4] {
    [a, a, b, b]
}

/// The bilinearly blended Coons patch over four borders, in the order u = u0, u = u1 (curves in v), v = v0, v = v1 (curves in u).
/// The domains are those of the borders 0 and 2; rational borders run through their points in another time.
///
/// # Errors
/// Borders that do not meet at a corner; rational ones whose blend has a weight that is not positive.
pub fn coons(borders: &[Curve; 4]) -> Result<Surface, Error> {
    let size = size_of(borders);
    corners(borders, size)?;
    let prepared = |k: usize| {
        let curve = borders[k].clamp()?;
        if curve.is_rational() { standard(&curve) } else { polynomial(&curve) }
    };
    let borders = [prepared(0)?, prepared(1)?, prepared(2)?, prepared(3)?];
    let corners = corners(&borders, size)?;
    let [range_u, range_v] = domains(&borders);
    let in_u = compatible_curves(&borders[..2])?;
    let in_v = compatible_curves(&borders[2..])?;
    let flat = Surface::new(
        &linear(range_u),
        &linear(range_v),
        1,
        1,
        &[corners[0][0], corners[0][1], corners[1][0], corners[1][1]],
        2,
        2,
        None,
    )?;
    summed([
        (1.0, along_v(&in_u, &linear(range_u), 1)?),
        (1.0, across(&in_v, &linear(range_v), 1)?),
        (-1.0, flat),
    ])
}

/// The same curve without its equal weights.
fn polynomial(curve: &Curve) -> Result<Curve, Error> {
    Curve::new(curve.knots().values(), curve.degree(), curve.poles(), None)
}

/// Bezier poles of the cubic over a step with ends and slopes.
fn hermite(step: f64, [start, slope0, slope1, end]: [Vector; 4]) -> [Vector; 4] {
    let third = step / 3.0;
    [start, add(start, scaled(slope0, third)), sub(end, scaled(slope1, third)), end]
}

fn cubic([a, b]: [f64; 2]) -> [f64; 8] {
    [a, a, a, a, b, b, b, b]
}

/// The surface that is a cubic across four compatible curves: borders and slopes.
fn hermite_across(curves: [&Curve; 4], range: [f64; 2]) -> Result<Surface, Error> {
    let plain = curves.map(polynomial).into_iter().collect::<Result<Vec<_>, _>>()?;
    let all = compatible_curves(&plain)?;
    let mut lists = [const { Vec::new() }; 4];
    for i in 0..all[0].poles().len() {
        let data = [0, 1, 2, 3].map(|k| all[k].poles()[i]);
        for (list, pole) in lists.iter_mut().zip(hermite(range[1] - range[0], data)) {
            list.push(pole);
        }
    }
    let knots = all[0].knots();
    let curve = |list: &Vec<Vector>| Curve::new(knots.values(), knots.degree(), list, None);
    let curves: Vec<Curve> = lists.iter().map(curve).collect::<Result<_, _>>()?;
    across(&curves, &cubic(range), 3)
}

/// The bicubically blended Coons patch: it has the four borders (as [`coons`] orders them) and across them the slopes: S_u along the
/// borders 0 and 1, S_v along the borders 2 and 3, as functions of the border's parameter with vectors as poles. Domains of all
/// curves in one direction must be the same.
///
/// # Errors
/// Rational curves; borders that do not meet, slopes that are not the derivatives of the borders at a corner, twists that differ there.
pub fn coons_bicubic(borders: &[Curve; 4], slopes: &[Curve; 4]) -> Result<Surface, Error> {
    let size = size_of(borders);
    let corners = corners(borders, size)?;
    let ranges = domains(borders);
    for k in 0..4 {
        for (name, curve) in [("border", &borders[k]), ("slope", &slopes[k])] {
            let (start, end) = curve.domain();
            if [start, end] != ranges[usize::from(k < 2)] {
                return invalid(format!("{name}s: the domain of {name} {k} is another"));
            }
            if curve.is_rational() {
                return Err(Error::Unsupported(format!("{name}s: {name} {k} is rational")));
            }
        }
    }
    let steps = ranges.map(|[a, b]| b - a);
    let derived = |curve: &Curve, end: usize| {
        let (a, b) = curve.domain();
        let mut out = [[0.0; 3]; 2];
        curve.derivatives([a, b][end], 1, &mut out);
        out
    };
    // Functionals in u: value, slope at u0; slope, value at u1. The same in v.
    let mut data = [[[0.0; 3]; 4]; 4];
    for i in 0..2 {
        for j in 0..2 {
            let (value_u, slope_u) = ([0, 3][i], [1, 2][i]);
            let (value_v, slope_v) = ([0, 3][j], [1, 2][j]);
            let in_u = [derived(&slopes[i], j), derived(&slopes[j + 2], i)];
            let along = [derived(&borders[j + 2], i)[1], derived(&borders[i], j)[1]];
            let checks = [
                ("slope", i, steps[0], in_u[0][0], along[0]),
                ("slope", j + 2, steps[1], in_u[1][0], along[1]),
                ("twist", i, steps[0] * steps[1], in_u[0][1], in_u[1][1]),
            ];
            for (name, k, step, a, b) in checks {
                let apart = gap(a, b) * step;
                if apart > MEETING_TOLERANCE * size {
                    let text = format!(
                        "slopes: the {name} of slope {k} does not fit at corner ({i}, {j})"
                    );
                    return invalid(text);
                }
            }
            data[value_u][value_v] = corners[i][j];
            data[slope_u][value_v] = in_u[0][0];
            data[value_u][slope_v] = in_u[1][0];
            data[slope_u][slope_v] = scaled(add(in_u[0][1], in_u[1][1]), 0.5);
        }
    }
    let in_u = [&borders[0], &slopes[0], &slopes[1], &borders[1]];
    let in_v = [&borders[2], &slopes[2], &slopes[3], &borders[3]];
    summed([
        (1.0, hermite_across(in_u, ranges[0])?.swap()?),
        (1.0, hermite_across(in_v, ranges[1])?),
        (-1.0, bicubic(ranges, data)?),
    ])
}

/// The bicubic patch of values, slopes and twists at its corners.
fn bicubic(ranges: [[f64; 2]; 2], data: [[Vector; 4]; 4]) -> Result<Surface, Error> {
    let steps = ranges.map(|[a, b]| b - a);
    let rows = data.map(|row| hermite(steps[1], row));
    let columns = [0, 1, 2, 3].map(|j| hermite(steps[0], [0, 1, 2, 3].map(|i| rows[i][j])));
    let poles: Vec<Vector> = (0..16).map(|k| columns[k % 4][k / 4]).collect();
    Surface::new(&cubic(ranges[0]), &cubic(ranges[1]), 3, 3, &poles, 4, 4, None)
}

/// What a Ferguson patch is made of; entry (i, j) belongs to the corner (u_i, v_j).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Corners {
    /// The corners.
    pub points: [[Vector; 2]; 2],
    /// S_u there.
    pub slopes_u: [[Vector; 2]; 2],
    /// S_v there.
    pub slopes_v: [[Vector; 2]; 2],
    /// S_uv there; 0 in Ferguson's patch.
    pub twists: [[Vector; 2]; 2],
}

/// The bicubic patch over [0, 1] x [0, 1] with given corners, slopes and twists.
///
/// # Errors
/// Numbers that are not finite, by name.
pub fn ferguson(given: &Corners) -> Result<Surface, Error> {
    let named = [
        ("points", &given.points),
        ("slopes_u", &given.slopes_u),
        ("slopes_v", &given.slopes_v),
        ("twists", &given.twists),
    ];
    for (name, vectors) in named {
        vectors.iter().flatten().try_for_each(|v| check_vector(name, *v))?;
    }
    let mut data = [[[0.0; 3]; 4]; 4];
    for i in 0..2 {
        for j in 0..2 {
            let ([value_u, slope_u], [value_v, slope_v]) =
                ([[0, 1], [3, 2]][i], [[0, 1], [3, 2]][j]);
            data[value_u][value_v] = given.points[i][j];
            data[slope_u][value_v] = given.slopes_u[i][j];
            data[value_u][slope_v] = given.slopes_v[i][j];
            data[slope_u][slope_v] = given.twists[i][j];
        }
    }
    bicubic([[0.0, 1.0]; 2], data)
}

/// The Gordon surface through a network: `curves_u[l]` runs in u at v = `parameters_v[l]`, `curves_v[k]` runs in v at u =
/// `parameters_u[k]`. The parameters increase strictly, from end to end of the domains of the first curve in either direction. At least two
/// curves in each direction. Degrees across are 3, or less with fewer than four curves.
///
/// # Errors
/// Rational curves; parameters that do not fit; curves that do not cross where they should, by index.
pub fn gordon(
    curves_u: &[Curve],
    parameters_v: &[f64],
    curves_v: &[Curve],
    parameters_u: &[f64],
) -> Result<Surface, Error> {
    let curves = [curves_u, curves_v];
    let parameters = [parameters_u, parameters_v];
    for k in 0..2 {
        let name = ["u", "v"][k];
        let across = ["v", "u"][k];
        if curves[k].len() < 2 || curves[k].len() != parameters[1 - k].len() {
            return invalid(format!(
                "curves_{name}: {} given, and {} parameters_{across}; at least 2 of each needed",
                curves[k].len(),
                parameters[1 - k].len()
            ));
        }
        if let Some(i) = curves[k].iter().position(Curve::is_rational) {
            return Err(Error::Unsupported(format!("curves_{name}: curve {i} is rational")));
        }
    }
    for k in 0..2 {
        let name = ["u", "v"][k];
        let (start, end) = curves[k][0].domain();
        for pair in parameters[k].windows(2) {
            check_interval(&format!("parameters_{name}"), [pair[0], pair[1]])?;
        }
        if parameters[k][0] != start || parameters[k][parameters[k].len() - 1] != end {
            return invalid(format!("parameters_{name}: they do not run from {start} to {end}"));
        }
    }
    let plain = |curves: &[Curve]| -> Result<Vec<Curve>, Error> {
        compatible_curves(&curves.iter().map(polynomial).collect::<Result<Vec<_>, _>>()?)
    };
    let (in_u, in_v) = (plain(curves_u)?, plain(curves_v)?);
    let size = size_of(&in_u).max(size_of(&in_v));
    let mut crossings = Vec::new();
    for (k, &u) in parameters_u.iter().enumerate() {
        for (l, &v) in parameters_v.iter().enumerate() {
            let (p, q) = (in_u[l].evaluate(u), in_v[k].evaluate(v));
            let apart = gap(p, q);
            if apart > MEETING_TOLERANCE * size {
                return invalid(format!(
                    "curves_u: curve {l} is {apart} from curve {k} of v at u = {u}, v = {v}"
                ));
            }
            crossings.push(p);
        }
    }
    let degree = |count: usize| 3.min(count - 1);
    let (degree_u, degree_v) = (degree(curves_v.len()), degree(curves_u.len()));
    let skin_u = interpolated(&Rows::of_curves(&in_u), parameters_v, degree_v)?;
    let skin_v = interpolated(&Rows::of_curves(&in_v), parameters_u, degree_u)?.swap()?;
    // The crossings as curves in u through them, then across.
    let columns: Vec<Curve> = (0..parameters_v.len())
        .map(|l| {
            let line = crossings.iter().skip(l).step_by(parameters_v.len()).copied();
            let points: Vec<Vector> = line.collect();
            crate::fit::interpolate(degree_u, parameters_u, &points)?.spline.curve()
        })
        .collect::<Result<_, _>>()?;
    let net = interpolated(&Rows::of_curves(&columns), parameters_v, degree_v)?;
    summed([(1.0, skin_u), (1.0, skin_v), (-1.0, net)])
}
