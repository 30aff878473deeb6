//! Fairing of curves.

use super::cells::Functional;
use super::length::{LengthLimit, arc_length};
use super::problem::{Problem, State, differences};
use super::rows::{curve_energy, curve_rows, hull_deviation, jumps, refinement};
use super::slope::Slope;
use super::{Faired, Method};
use crate::bounds::{Vector, cross, dot, norm, sub};
use crate::curve::Curve;
use crate::curve::insertion::{append, collect, filled, spare};
use crate::error::Error;
use crate::index::IndexedCurve;
use crate::inspect::turn_count;
use crate::knots::{Knots, Side};

/// Poles up to which the proof is sharpened by inserted knots.
const SHARPEN_UP_TO: usize = 400;

/// Bytes a pole that must be there for what is allocated piece by piece: copies of the curve, its index where bends are counted.
const BYTES: usize = 4096;

/// Relative error of arc lengths that are compared.
const LENGTH_ERROR: f64 = 1e-9;

/// What a curve is faired for, and what must stay.
#[derive(Clone, Debug, PartialEq)]
pub struct CurveFairing {
    /// How poles are moved.
    pub method: Method,
    /// Weight of the integral of |C''|^2, the strain.
    pub strain: f64,
    /// Weight of the integral of |C'''|^2, the jerk.
    pub jerk: f64,
    /// Weight of the integral of the squared change of the curvature vector along the curve: (dk/ds)^2 of planar curves,
    /// (dk/ds)^2 + k^2 tau^2 in space, by the arc length of the curve as it becomes. [`Method::Energy`] only.
    pub slope: f64,
    /// Weight of the integral of |C - old C|^2.
    pub distance: f64,
    /// Derivatives and integrals by the arc length of the curve as it was, not by the parameter: the jerk then is the change
    /// of the curvature vector along the curve.
    pub by_length: bool,
    /// How far a point may move from the point of the same parameter; length, positive.
    pub deviation: f64,
    /// How much is kept at the start and at the end: 0 nothing, 1 the point, 2 the first derivative too, 3 the second too.
    pub ends: [usize; 2],
    /// Poles that stay.
    pub fixed: Vec<usize>,
    /// Parameters whose points stay.
    pub through: Vec<f64>,
    /// Knots to be faired by [`Method::KnotRemoval`] and [`Method::Local`]: of each the pole in the middle of its jump moves. Empty:
    /// all inner ones, and with [`Method::Local`] all poles.
    pub knots: Vec<f64>,
    /// Least and greatest arc length allowed, which the curve has already.
    pub length: Option<[f64; 2]>,
    /// No more changes of the side to which the curve bends, seen across its plane, than the curve of least jerk by arc length has
    /// that the constraints allow: as much of that energy is added as this takes. For curves whose poles are nearer to a plane than
    /// half the deviation, and [`Method::Energy`].
    pub calm: bool,
    /// Solutions of the equations at most, five a step; local methods take eight steps a pole at least.
    pub steps: usize,
}

impl CurveFairing {
    /// Least strain within a deviation, points and tangents of the ends kept.
    pub fn new(deviation: f64) -> Self {
        Self {
            method: Method::Energy,
            strain: 1.0,
            jerk: 0.0,
            slope: 0.0,
            distance: 0.0,
            by_length: false,
            deviation,
            ends: [2; 2],
            fixed: Vec::new(),
            through: Vec::new(),
            knots: Vec::new(),
            length: None,
            calm: true,
            steps: 300,
        }
    }
}

/// Refuses a number that is not finite, or less than `least`.
pub(super) fn check_number(name: &str, x: f64, least: f64) -> Result<(), Error> {
    if x.is_finite() && x >= least {
        return Ok(());
    }
    Err(Error::InvalidArgument(format!(
        "{name}: {x} given, a finite number of at least {least} expected"
    )))
}

/// Refuses a deviation that is not positive.
pub(super) fn check_deviation(x: f64) -> Result<(), Error> {
    if x.is_finite() && x > 0.0 {
        return Ok(());
    }
    Err(Error::InvalidArgument(format!("deviation: {x} given, a positive length expected")))
}

fn check(curve: &Curve, fairing: &CurveFairing) -> Result<(), Error> {
    check_deviation(fairing.deviation)?;
    check_number("strain", fairing.strain, 0.0)?;
    check_number("jerk", fairing.jerk, 0.0)?;
    check_number("slope", fairing.slope, 0.0)?;
    check_number("distance", fairing.distance, 0.0)?;
    let refuse = |text: String| Err(Error::InvalidArgument(text));
    if fairing.slope > 0.0 && fairing.method != Method::Energy {
        return refuse("slope: only the method that moves all poles at once lessens it".into());
    }
    let sum = fairing.strain + fairing.jerk + fairing.slope;
    if fairing.method != Method::KnotRemoval && sum == 0.0 {
        return refuse("strain: and jerk and slope are 0, there is no energy".into());
    }
    if let Some(k) = (0..2).find(|&k| fairing.ends[k] > 3) {
        return refuse(format!("ends: entry {k} = {}, 0 to 3 accepted", fairing.ends[k]));
    }
    let count = curve.poles().len();
    if let Some(k) = fairing.fixed.iter().position(|&i| i >= count) {
        return refuse(format!("fixed: entry {k} is pole {}, there are {count}", fairing.fixed[k]));
    }
    for (name, list) in [("through", &fairing.through), ("knots", &fairing.knots)] {
        if let Some(k) = list.iter().position(|&u| !curve.knots().contains(u)) {
            return refuse(format!("{name}: entry {k} = {} is outside the domain", list[k]));
        }
    }
    if let Some(k) = fairing.knots.iter().position(|&u| curve.knots().multiplicity(u) == 0) {
        return refuse(format!("knots: entry {k} = {} is no knot", fairing.knots[k]));
    }
    if let Some([low, high]) = fairing.length {
        check_number("length", low, 0.0)?;
        check_number("length", high, low)?;
        let now = arc_length(curve, LENGTH_ERROR);
        if now < low * (1.0 - LENGTH_ERROR) || now > high * (1.0 + LENGTH_ERROR) {
            return refuse(format!("length: the curve has {now}, outside [{low}, {high}]"));
        }
    }
    Ok(())
}

/// The curve with other poles.
fn moved(curve: &Curve, poles: &[Vector]) -> Curve {
    let weights = curve.weights().map(Into::into);
    Curve::from_parts(curve.knots().clone(), poles.into(), weights)
}

/// The number of poles that repeat at the end of a periodic curve: the last `degree` ones are the first ones, and so are
/// their weights and steps of knots. 0 when they are not.
pub(super) fn wrapped(count: usize, degree: usize, same: impl Fn(usize, usize) -> bool) -> usize {
    let repeats = count > 2 * degree && (0..degree).all(|i| same(i, count - degree + i));
    if repeats { degree } else { 0 }
}

/// Whether the knots of an unclamped direction repeat with the length of the domain.
pub(super) fn repeats(knots: &Knots) -> bool {
    let (t, p, n) = (knots.values(), knots.degree(), knots.pole_count());
    let period = t[n] - t[p];
    (0..=2 * p).all(|i| (t[n - p + i] - t[i] - period).abs() <= 1e-12 * period.abs())
}

/// Whether each pole may move by the choice of knots; `inner` are the knots of the cells `lines`.
fn chosen_poles(
    curve: &Curve,
    fairing: &CurveFairing,
    (inner, lines): (&[f64], &Functional),
) -> Result<Vec<bool>, Error> {
    let is_free = fairing.method != Method::Local || fairing.knots.is_empty();
    let mut chosen = filled(curve.poles().len(), is_free)?;
    for (_, cell) in inner.iter().zip(lines.cells()).filter(|line| fairing.knots.contains(line.0)) {
        let middle = (0..cell.poles.len())
            .max_by(|&a, &b| cell.rows[a].abs().total_cmp(&cell.rows[b].abs()));
        middle.into_iter().for_each(|a| chosen[cell.poles[a]] = true);
    }
    Ok(chosen)
}

/// The unknown of each pole, their number, and the linear forms that must vanish.
fn freedom(
    curve: &Curve,
    fairing: &CurveFairing,
    chosen: &[bool],
) -> Result<(Vec<Option<usize>>, usize, Functional), Error> {
    let (count, p) = (curve.poles().len(), curve.degree());
    let weight = |i: usize| curve.weights().map_or(1.0, |w| w[i]);
    let same = |i: usize, j: usize| curve.poles()[i] == curve.poles()[j] && weight(i) == weight(j);
    let wrap = if repeats(curve.knots()) { wrapped(count, p, same) } else { 0 };
    let mut fixed = collect(count, chosen.iter().map(|is_chosen| !is_chosen))?;
    let mut forms = Functional::default();
    fairing.fixed.iter().for_each(|&i| fixed[i] = true);
    let (start, end) = curve.domain();
    for (k, u) in [start, end].into_iter().enumerate() {
        if wrap > 0 || fairing.ends[k] == 0 {
            continue;
        }
        let side = if k == 0 { Side::Above } else { Side::Below };
        let order = fairing.ends[k] - 1;
        let (first, rows) = curve_rows(curve, u, side, order);
        if curve.knots().multiplicity(u) > p {
            let poles = 0..=order.min(p);
            poles.for_each(|i| fixed[if k == 0 { i } else { count - 1 - i }] = true);
        } else {
            for row in rows.chunks_exact(p + 1).take(p.min(order) + 1) {
                forms.push(first..first + p + 1, row)?;
            }
        }
    }
    for &u in &fairing.through {
        let (first, rows) = curve_rows(curve, u, Side::Above, 0);
        if fairing.method == Method::Energy {
            forms.push(first..first + p + 1, &rows)?;
        } else {
            let pulls = (0..=p).filter(|&i| rows[i] != 0.0);
            pulls.for_each(|i| fixed[first + i] = true);
        }
    }
    if wrap > 0 {
        (0..wrap).for_each(|i| fixed[i] = fixed[i] || fixed[count - wrap + i]);
    }
    let mut unknowns = filled(count, None)?;
    let mut next = 0;
    for i in 0..count - wrap {
        if !fixed[i] {
            unknowns[i] = Some(next);
            next += 1;
        }
    }
    for i in 0..wrap {
        unknowns[count - wrap + i] = unknowns[i];
    }
    // A form over poles that stay says nothing.
    let mut kept = Functional::default();
    for cell in forms.cells().filter(|cell| cell.poles.iter().any(|&i| unknowns[i].is_some())) {
        kept.push(cell.poles.iter().copied(), cell.rows)?;
    }
    Ok((unknowns, next, kept))
}

/// How far no point of `new` has moved, proven: the hull of the difference after each span has been halved twice.
fn proven_deviation(curve: &Curve, new: &[Vector]) -> Result<f64, Error> {
    let plain = hull_deviation(new, curve.poles());
    if plain == 0.0 || curve.poles().len() > SHARPEN_UP_TO {
        return Ok(plain);
    }
    let difference = moved(curve, &differences(new, curve.poles())?);
    let difference = difference.refine(&quarters(difference.knots()))?;
    let zero = vec![[0.0; 3]; difference.poles().len()];
    let sharp = hull_deviation(difference.poles(), &zero);
    // Inserting rounds by some ulps of the differences, each insertion once.
    let rounding = 1e-12 * plain + size_rounding(curve);
    Ok(plain.min(sharp + rounding))
}

/// The poles of a motion over quartered spans; over the spans themselves where the proof does not cut them.
fn tubes(curve: &Curve) -> Result<Functional, Error> {
    let (knots, count) = (curve.knots(), curve.poles().len());
    let fine = if count > SHARPEN_UP_TO { None } else { refinement(knots, &quarters(knots)) };
    let mut tubes = Functional::default();
    let Some(fine) = fine else {
        for i in 0..count {
            tubes.push(std::iter::once(i), &[1.0])?;
        }
        return Ok(tubes);
    };
    let weight = |i: usize| curve.weights().map_or(1.0, |w| w[i]);
    for (first, row) in fine {
        let row: Vec<f64> = row.iter().enumerate().map(|(j, x)| x * weight(first + j)).collect();
        let sum: f64 = row.iter().sum();
        let row: Vec<f64> = row.iter().map(|x| x / sum).collect();
        tubes.push(first..first + row.len(), &row)?;
    }
    Ok(tubes)
}

/// The places that cut every span in four, but for those that are knots because a span is that short.
pub(super) fn quarters(knots: &Knots) -> Vec<f64> {
    let t = knots.values();
    let cut = |i: usize| [0.25, 0.5, 0.75].map(|x| t[i] + x * (t[i + 1] - t[i]));
    let mut places: Vec<f64> = knots.spans().flat_map(cut).collect();
    places.dedup();
    places.retain(|&u| knots.multiplicity(u) == 0);
    places
}

/// The normal of the plane that the poles are nearest to, at least about, and how far they are from it; none for straight curves.
fn plane(curve: &Curve) -> Option<(Vector, f64)> {
    let poles = curve.poles();
    let from = |p: &Vector| sub(*p, poles[0]);
    let along = poles.iter().map(from).max_by(|a, b| norm(*a).total_cmp(&norm(*b)))?;
    let across = poles.iter().map(|p| cross(along, from(p)));
    let normal = across.max_by(|a, b| norm(*a).total_cmp(&norm(*b)))?;
    let size = norm(normal);
    if size.is_nan() || size <= 1e-9 * dot(along, along) {
        return None;
    }
    let gap = poles.iter().map(|p| (dot(from(p), normal) / size).abs()).fold(0.0, f64::max);
    Some((normal, gap))
}

/// Rounding of differences of poles.
fn size_rounding(curve: &Curve) -> f64 {
    let most = curve.poles().iter().flatten().fold(0.0f64, |m, x| m.max(x.abs()));
    f64::EPSILON * most
}

/// Weights of the calming energy, as powers of ten of what makes it as large as the asked one.
const CALMING: [i32; 10] = [2, 1, 0, -1, -2, -3, -4, -5, -6, -7];

/// Least energy among the curves that bend to and fro as seldom as the calmest one.
struct Calm<'a> {
    curve: &'a Curve,
    normal: Vector,
    deviation: f64,
    radius: f64,
}

type Run<'a> = dyn FnMut(&mut Problem, &mut State) -> Result<bool, Error> + 'a;
type Proof<'a> = dyn Fn(&[Vector]) -> Result<f64, Error> + 'a;

impl Calm<'_> {
    /// A state with fewer turns than the one of least energy alone, if there is one; whether it converged, and its deviation.
    ///
    /// The calming energy is the jerk by arc length. Of several shares of it the least energy without more turns is taken.
    fn instead_of(
        &self,
        problem: &mut Problem,
        plain: &State,
        run: &mut Run,
        proven: &Proof,
    ) -> Result<Option<(State, bool, f64)>, Error> {
        let sampled = Slope::new(self.curve, 1.0)?;
        // Degrees too high for a proof are counted at samples.
        let count = |poles: &[Vector]| {
            let shape = IndexedCurve::new(moved(self.curve, poles));
            turn_count(&shape, self.normal).unwrap_or_else(|_| sampled.turns(poles, self.normal))
        };
        let before = count(&plain.poles);
        if before == 0 {
            return Ok(None);
        }
        let old = self.curve.poles();
        let calming = curve_energy(self.curve, [0.0, 0.0, 0.0, 1.0], true)?;
        let asked = problem.energy.copied()?;
        let (first, calm) = (plain.energies[0], calming.value(old));
        let energy = |problem: &Problem, poles: &[Vector]| problem.value(poles, old);
        let slope = problem.slope.take();
        problem.energy = calming.copied()?;
        problem.radius = self.radius;
        let mut state = State::new(old, calm)?;
        let mut found = problem.in_rounds(&mut state, self.deviation, run, proven)?;
        (problem.energy, problem.slope) = (asked.copied()?, slope);
        let most = count(&state.poles);
        if most >= before || calm <= 0.0 || found.1 == 0.0 {
            return Ok(None);
        }
        let mut best = State::new(old, first)?;
        let mut result = None;
        let mut value = energy(problem, &state.poles)?;
        for power in CALMING {
            if value < best.last() && count(&state.poles) <= most {
                best.poles.copy_from_slice(&state.poles);
                append(&mut best.energies, value)?;
                result = Some(found);
            }
            let share = first / calm * 10f64.powi(power);
            problem.energy = asked.with(share, &calming)?;
            let mixed = energy(problem, &state.poles)?;
            state = State { poles: state.poles, ..State::new(old, mixed)? };
            problem.radius = self.radius;
            found = problem.in_rounds(&mut state, self.deviation, run, proven)?;
            problem.energy = asked.copied()?;
            value = energy(problem, &state.poles)?;
            if found.1 == 0.0 {
                break;
            }
        }
        Ok(result.map(|(converged, deviation)| (best, converged, deviation)))
    }
}

/// A fairer curve on the same knots and weights, within the deviation.
///
/// Cost: each step solves equations with one unknown a pole and a band as wide as the degree.
///
/// # Errors
/// What is asked makes no sense (named); memory that could not be had; [`Error::Cancelled`].
pub fn fair_curve(
    curve: &Curve,
    fairing: &CurveFairing,
    poll: &mut dyn FnMut() -> bool,
) -> Result<Faired<Curve>, Error> {
    check(curve, fairing)?;
    spare(curve.poles().len(), BYTES)?;
    let (inner, lines) = jumps(curve)?;
    let chosen = chosen_poles(curve, fairing, (&inner, &lines))?;
    let (unknowns, count, kept) = freedom(curve, fairing, &chosen)?;
    let mut chosen = Vec::new();
    for (k, u) in inner.iter().enumerate() {
        if fairing.knots.is_empty() || fairing.knots.contains(u) {
            append(&mut chosen, k..k + 1)?;
        }
    }
    let weights = [0.0, 0.0, fairing.strain, fairing.jerk];
    let energy = match fairing.method {
        Method::KnotRemoval => lines,
        _ => curve_energy(curve, weights, fairing.by_length)?,
    };
    let distance = if fairing.method == Method::Energy && fairing.distance > 0.0 {
        curve_energy(curve, [fairing.distance, 0.0, 0.0, 0.0], fairing.by_length)?
    } else {
        Functional::default()
    };
    let slope = if fairing.slope > 0.0 { Some(Slope::new(curve, fairing.slope)?) } else { None };
    let radius = fairing.deviation * (1.0 - 1e-9) - size_rounding(curve);
    if radius <= 0.0 {
        let text = "deviation: is below the rounding of the poles".to_string();
        return Err(Error::InvalidArgument(text));
    }
    let fits = |poles: &[Vector]| {
        fairing.length.is_none_or(|[low, high]| {
            let length = arc_length(&moved(curve, poles), LENGTH_ERROR);
            (low..=high).contains(&length)
        })
    };
    let proven = |poles: &[Vector]| proven_deviation(curve, poles);
    let tubes = tubes(curve)?;
    let mut problem = Problem {
        energy,
        distance,
        slope,
        unknowns,
        count,
        kept,
        tubes,
        radius,
        length: fairing.length.map(|range| LengthLimit::new(curve, range)).transpose()?,
        allowed: &fits,
        poll,
    };
    let mut state = State::new(curve.poles(), 0.0)?;
    state.energies[0] = problem.value(curve.poles(), curve.poles())?;
    if !state.last().is_finite() {
        let text =
            "strain: its energy, that of jerk or slope or of the shape is too large for a number";
        return Err(Error::InvalidArgument(text.into()));
    }
    let mut run = |problem: &mut Problem, state: &mut State| match fairing.method {
        Method::Energy => problem.run(state, fairing.steps),
        Method::Local => problem.run_local(state, fairing.steps),
        Method::KnotRemoval => problem.run_knots(state, &chosen, fairing.steps),
    };
    let (mut converged, mut deviation) =
        problem.in_rounds(&mut state, fairing.deviation, &mut run, &proven)?;
    let normal = plane(curve).filter(|(_, gap)| 2.0 * gap <= fairing.deviation).map(|(n, _)| n);
    if let (true, Method::Energy, Some(normal)) = (fairing.calm, fairing.method, normal) {
        let calm = Calm { curve, normal, deviation: fairing.deviation, radius };
        if let Some(found) = calm.instead_of(&mut problem, &state, &mut run, &proven)? {
            (state, converged, deviation) = found;
        }
    }
    let shape = moved(curve, &state.poles);
    Ok(Faired { shape, energies: state.energies, deviation, converged })
}
