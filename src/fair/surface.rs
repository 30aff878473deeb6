//! Fairing of surfaces.

use super::cells::Functional;
use super::curve::{check_deviation, check_number, quarters, repeats, wrapped};
use super::problem::{Problem, State, differences};
use super::rows::{hull_deviation, knot_jumps, refinement, surface_energy};
use super::{Faired, Method};
use crate::bounds::Vector;
use crate::curve::insertion::{append, copy_of, filled};
use crate::error::Error;
use crate::knots::Knots;
use crate::operate::Direction;
use crate::surface::Surface;
use std::ops::Range;

/// Poles up to which the proof is sharpened by inserted knots.
const SHARPEN_UP_TO: usize = 40_000;

/// Poles up to which forms over quartered spans are held in the deviation: beyond, each pole is.
const TUBE_UP_TO: usize = 5_000;

/// What a surface is faired for, and what must stay.
#[derive(Clone, Debug, PartialEq)]
pub struct SurfaceFairing {
    /// How poles are moved.
    pub method: Method,
    /// Weight of the thin plate: the integral of |Suu|^2 + 2 |Suv|^2 + |Svv|^2.
    pub plate: f64,
    /// Weight of its like with third derivatives: |Suuu|^2 + 3 |Suuv|^2 + 3 |Suvv|^2 + |Svvv|^2.
    pub jerk: f64,
    /// Weight of the integral of |S - old S|^2.
    pub distance: f64,
    /// How far a point may move from the point of the same parameters; length, positive.
    pub deviation: f64,
    /// How much is kept along the borders u0, u1, v0, v1: 0 nothing, 1 the border (G0), 2 the cross derivatives too (G1),
    /// 3 the second ones too (G2).
    pub borders: [usize; 4],
    /// Only the part u0, u1, v0, v1 changes; none: all.
    pub region: Option<[f64; 4]>,
    /// Steps at most.
    pub steps: usize,
}

impl SurfaceFairing {
    /// The thin plate within a deviation, borders and tangent planes along them kept.
    pub fn new(deviation: f64) -> Self {
        Self {
            method: Method::Energy,
            plate: 1.0,
            jerk: 0.0,
            distance: 0.0,
            deviation,
            borders: [2; 4],
            region: None,
            steps: 150,
        }
    }
}

fn check(surface: &Surface, fairing: &SurfaceFairing) -> Result<(), Error> {
    check_deviation(fairing.deviation)?;
    check_number("plate", fairing.plate, 0.0)?;
    check_number("jerk", fairing.jerk, 0.0)?;
    check_number("distance", fairing.distance, 0.0)?;
    let refuse = |text: String| Err(Error::InvalidArgument(text));
    if fairing.method != Method::KnotRemoval && fairing.plate + fairing.jerk == 0.0 {
        return refuse("plate: and jerk are 0, there is no energy".into());
    }
    if fairing.method == Method::KnotRemoval && surface.is_rational() {
        let text = "method: knot lines of rational surfaces cannot vanish while the weights stay";
        return Err(Error::Unsupported(text.into()));
    }
    if let Some(k) = (0..4).find(|&k| fairing.borders[k] > 3) {
        return refuse(format!("borders: entry {k} = {}, 0 to 3 accepted", fairing.borders[k]));
    }
    let domain = surface.domain();
    if let Some(region) = fairing.region {
        for k in 0..4 {
            let [low, high] = [domain[k / 2 * 2], domain[k / 2 * 2 + 1]];
            if !(low..=high).contains(&region[k]) {
                return refuse(format!(
                    "region: entry {k} = {} is outside [{low}, {high}]",
                    region[k]
                ));
            }
        }
        if let Some(k) = [0, 2].into_iter().find(|&k| region[k] >= region[k + 1]) {
            return refuse(format!("region: entry {k} is not less than entry {}", k + 1));
        }
    }
    Ok(())
}

/// Which rows of poles may move in one direction, and how many repeat at its end.
fn free(
    knots: &Knots,
    kept: [usize; 2],
    region: Option<[f64; 2]>,
    wrap: usize,
    name: &str,
) -> Result<Vec<bool>, Error> {
    let (count, p, t) = (knots.pole_count(), knots.degree(), knots.values());
    let (start, end) = knots.domain();
    let mut free = filled(count, true)?;
    if let Some([low, high]) = region {
        // A pole pulls at the open interval of its knots.
        (0..count).for_each(|i| free[i] = low <= t[i].max(start) && t[i + p + 1].min(end) <= high);
    }
    for (k, u) in [start, end].into_iter().enumerate() {
        if kept[k] == 0 || wrap > 0 {
            continue;
        }
        if knots.multiplicity(u) <= p {
            let text = format!("borders: the direction {name} is not clamped; clamp it first");
            return Err(Error::Unsupported(text));
        }
        (0..kept[k].min(count)).for_each(|i| free[if k == 0 { i } else { count - 1 - i }] = false);
    }
    (0..wrap).for_each(|i| {
        let both = free[i] && free[count - wrap + i];
        (free[i], free[count - wrap + i]) = (both, both);
    });
    Ok(free)
}

/// The unknown of each pole and their number, the shorter direction running fastest.
fn freedom(
    surface: &Surface,
    fairing: &SurfaceFairing,
) -> Result<(Vec<Option<usize>>, usize), Error> {
    let (ku, kv) = (surface.knots_u(), surface.knots_v());
    let (nu, nv) = (ku.pole_count(), kv.pole_count());
    let weight = |i: usize| surface.weights().map_or(1.0, |w| w[i]);
    let same =
        |a: usize, b: usize| surface.poles()[a] == surface.poles()[b] && weight(a) == weight(b);
    let row_same = |i: usize, k: usize| (0..nv).all(|j| same(i * nv + j, k * nv + j));
    let column_same = |j: usize, k: usize| (0..nu).all(|i| same(i * nv + j, i * nv + k));
    let wrap_u = if repeats(ku) { wrapped(nu, ku.degree(), row_same) } else { 0 };
    let wrap_v = if repeats(kv) { wrapped(nv, kv.degree(), column_same) } else { 0 };
    let [a, b, c, d] = fairing.borders;
    let free_u = free(ku, [a, b], fairing.region.map(|r| [r[0], r[1]]), wrap_u, "u")?;
    let free_v = free(kv, [c, d], fairing.region.map(|r| [r[2], r[3]]), wrap_v, "v")?;
    let mut unknowns = filled(nu * nv, None)?;
    let (mu, mv) = (nu - wrap_u, nv - wrap_v);
    let mut next = 0;
    for n in 0..mu * mv {
        let (i, j) = if mv <= mu { (n / mv, n % mv) } else { (n % mu, n / mu) };
        if free_u[i] && free_v[j] {
            unknowns[i * nv + j] = Some(next);
            next += 1;
        }
    }
    for i in 0..nu {
        for j in 0..nv {
            unknowns[i * nv + j] = unknowns[i % mu * nv + j % mv];
        }
    }
    Ok((unknowns, next))
}

/// The jumps across all inner knot lines as cells, and which cells belong to each line.
fn knot_lines(surface: &Surface) -> Result<(Functional, Vec<Range<usize>>), Error> {
    let (nu, nv) = (surface.knots_u().pole_count(), surface.knots_v().pole_count());
    let (mut cells, mut lines) = (Functional::default(), Vec::new());
    let directions = [(surface.knots_u(), nv, [nv, 1]), (surface.knots_v(), nu, [1, nv])];
    for (knots, strands, [across, along]) in directions {
        for jump in knot_jumps(knots)?.cells() {
            append(&mut lines, cells.len()..cells.len() + strands)?;
            for strand in 0..strands {
                let poles = jump.poles.iter().map(|&i| i * across + strand * along);
                cells.push(poles, jump.rows)?;
            }
        }
    }
    Ok((cells, lines))
}

/// The poles of a motion over quartered spans; over the spans themselves where the proof does not cut them.
fn tubes(surface: &Surface) -> Result<Functional, Error> {
    let (ku, kv) = (surface.knots_u(), surface.knots_v());
    let (count, stride) = (surface.poles().len(), kv.pole_count());
    let fine = |knots: &Knots| refinement(knots, &quarters(knots));
    let mut cells = Functional::default();
    let (Some(us), Some(vs), true) = (fine(ku), fine(kv), count <= TUBE_UP_TO) else {
        for i in 0..count {
            cells.push(std::iter::once(i), &[1.0])?;
        }
        return Ok(cells);
    };
    let weight = |i: usize| surface.weights().map_or(1.0, |w| w[i]);
    for (first_u, row_u) in &us {
        for (first_v, row_v) in &vs {
            let (mut poles, mut rows) = (Vec::new(), Vec::new());
            for (a, x) in row_u.iter().enumerate() {
                for (b, y) in row_v.iter().enumerate() {
                    let i = (first_u + a) * stride + first_v + b;
                    if x * y != 0.0 {
                        poles.push(i);
                        rows.push(x * y * weight(i));
                    }
                }
            }
            let sum: f64 = rows.iter().sum();
            rows.iter_mut().for_each(|x| *x /= sum);
            cells.push(poles.into_iter(), &rows)?;
        }
    }
    Ok(cells)
}

/// How far no point of the surface with other poles has moved, proven: the hull of the difference after each span has been
/// cut in four.
fn proven_deviation(surface: &Surface, new: &[Vector]) -> Result<f64, Error> {
    let old = surface.poles();
    let plain = hull_deviation(new, old);
    let rounding = f64::EPSILON * old.iter().flatten().fold(0.0f64, |m, x| m.max(x.abs()));
    if plain == 0.0 || old.len() > SHARPEN_UP_TO {
        return Ok(plain + rounding);
    }
    let (ku, kv) = (surface.knots_u(), surface.knots_v());
    let weights = surface.weights().map(copy_of).transpose()?.map(Into::into);
    let poles = differences(new, old)?.into_boxed_slice();
    let difference = Surface::from_parts(ku.clone(), kv.clone(), poles, weights);
    let difference = difference.refine(Direction::U, &quarters(ku))?;
    let difference = difference.refine(Direction::V, &quarters(kv))?;
    let sharp = hull_deviation(difference.poles(), &filled(difference.poles().len(), [0.0; 3])?);
    Ok(plain.min(sharp + 1e-12 * plain) + rounding)
}

/// A fairer surface on the same knots and weights, within the deviation.
///
/// Cost: a step solves sparse equations with one unknown a pole, which are factored a few times: some `n^1.5` operations and
/// `n log n` memory for n poles, as figures in docs/fairing.md have it. The local methods: a step costs what the poles touch that move.
///
/// # Errors
/// What is asked makes no sense (named); too many poles for the memory; [`Error::Cancelled`].
pub fn fair_surface(
    surface: &Surface,
    fairing: &SurfaceFairing,
    poll: &mut dyn FnMut() -> bool,
) -> Result<Faired<Surface>, Error> {
    check(surface, fairing)?;
    let (unknowns, count) = freedom(surface, fairing)?;
    let (ku, kv) = (surface.knots_u(), surface.knots_v());
    let (energy, lines) = match fairing.method {
        Method::KnotRemoval => knot_lines(surface)?,
        _ => (surface_energy(surface, [0.0, 0.0, fairing.plate, fairing.jerk])?, Vec::new()),
    };
    let distance = if fairing.method == Method::Energy && fairing.distance > 0.0 {
        surface_energy(surface, [fairing.distance, 0.0, 0.0, 0.0])?
    } else {
        Functional::default()
    };
    let old = surface.poles();
    let most = old.iter().flatten().fold(0.0f64, |m, x| m.max(x.abs()));
    let radius = fairing.deviation * (1.0 - 1e-9) - 4.0 * f64::EPSILON * most;
    if radius <= 0.0 {
        let text = "deviation: is below the rounding of the poles".to_string();
        return Err(Error::InvalidArgument(text));
    }
    let mut state = State::new(old, energy.value(old))?;
    if !state.last().is_finite() {
        let text = "plate: its energy, that of jerk or of the shape is too large for a number";
        return Err(Error::InvalidArgument(text.into()));
    }
    let allowed = |_: &[Vector]| true;
    let kept = Functional::default();
    let tubes =
        if fairing.method == Method::Energy { tubes(surface)? } else { Functional::default() };
    let mut problem = Problem {
        energy,
        distance,
        slope: None,
        unknowns,
        count,
        kept,
        tubes,
        radius,
        length: None,
        allowed: &allowed,
        poll,
    };
    let mut run = |problem: &mut Problem, state: &mut State| match fairing.method {
        Method::Energy => problem.run(state, fairing.steps),
        Method::Local => problem.run_local(state, fairing.steps),
        Method::KnotRemoval => problem.run_knots(state, &lines, fairing.steps),
    };
    let proven = |poles: &[Vector]| proven_deviation(surface, poles);
    let (converged, deviation) =
        problem.in_rounds(&mut state, fairing.deviation, &mut run, &proven)?;
    let weights = surface.weights().map(copy_of).transpose()?.map(Into::into);
    let shape =
        Surface::from_parts(ku.clone(), kv.clone(), state.poles.into_boxed_slice(), weights);
    Ok(Faired { shape, energies: state.energies, deviation, converged })
}
