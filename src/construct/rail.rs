//! Swept surfaces without twist: the profile moves along the spine in a rotation minimising frame.
//!
//! ```text
//!   S(u, v) = T(v) + M(v) (C(u) - T(v0))       M(v0) = 1, M turns the tangent of the spine along, and nothing about it
//! ```
//!
//! Frames go from node to node by double reflection, with an error of fourth order in the step; the steps are halved until the frames
//! agree. The surface is linear in (T, M): both are fitted together as one curve in twelve dimensions, lengths of the profile as the
//! weight of M, so that no point of the surface is off by more than the fit. The error is proven (`rail_proof`).
//!
//! Reference: Wang, Jüttler, Zheng, Liu, *Computation of rotation minimizing frames*, ACM Transactions on Graphics 27, 2008.
//! Limit: spines with corners are refused; rational ones of degrees above 13 have no proof.

use super::rail_proof::motion_error;
use super::{check_number, check_positive, gap, invalid};
use crate::analytic::linear::any_frame;
use crate::bounds::{Vector, add, cross, dot, norm, scaled, sub};
use crate::curve::Curve;
use crate::error::Error;
use crate::fit::{Adaptive, Spline, of_function};
use crate::knots::{MAX_DEGREE, Side};
use crate::portable::SameDigits;
use crate::surface::Surface;

/// How [`swept`] moves the profile.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SweepOptions {
    /// No point is farther than this from the exact swept surface at its parameters.
    pub tolerance: f64,
    /// Degree along the spine; 3 by default.
    pub degree: usize,
    /// Turn about the tangent in all, in radians, spread evenly over the length.
    pub twist: f64,
    /// On a closed spine: turn besides by what brings the last frame onto the first.
    pub close: bool,
    /// No more poles than that along the spine; 2000 by default.
    pub max_poles: usize,
}

impl Default for SweepOptions {
    fn default() -> Self {
        Self { tolerance: 1e-6, degree: 3, twist: 0.0, close: false, max_poles: 2000 }
    }
}

/// A swept surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Swept {
    /// u along the profile, v along the spine.
    pub surface: Surface,
    /// No point is farther from the exact swept surface at its parameters: proven. Infinite where nothing is.
    pub error: f64,
    /// The greatest distance from it at the samples of the fit.
    pub measured: f64,
    /// The turn, in radians, between a rotation minimising frame carried once along and the frame at the start, about the tangent there:
    /// what `close` takes away. 0 for spines whose ends have different tangents.
    pub holonomy: f64,
}

/// A frame at a parameter: point, tangent, a direction across it, and the length so far.
#[derive(Clone, Copy, Debug)]
struct Node {
    at: f64,
    point: Vector,
    tangent: Vector,
    across: Vector,
}

struct Frames<'a> {
    spine: &'a Curve,
    nodes: Vec<Node>,
}

/// Change of the last frame, in radians, at which halving the steps ends; and the most nodes.
const FRAME_TOLERANCE: f64 = 1e-11;
const MOST_NODES: usize = 1 << 17;

fn at(spine: &Curve, v: f64, side: Side) -> Result<(Vector, Vector), Error> {
    let mut out = [[0.0; 3]; 2];
    spine.derivatives_on(v, side, 1, &mut out);
    let speed = norm(out[1]);
    if speed.is_nan() || speed <= 0.0 {
        return Err(Error::Unsupported(format!("spine: it stands still at {v}")));
    }
    Ok((spine.evaluate(v), scaled(out[1], 1.0 / speed)))
}

/// The vector mirrored at the plane across `normal`.
fn mirrored(x: Vector, normal: Vector) -> Vector {
    let square = dot(normal, normal);
    if square == 0.0 { x } else { sub(x, scaled(normal, 2.0 * dot(normal, x) / square)) }
}

/// The frame at `v`, carried from a node nearby.
fn carried(from: &Node, spine: &Curve, v: f64) -> Result<Node, Error> {
    let (point, tangent) = at(spine, v, Side::Above)?;
    let chord = sub(point, from.point);
    let (across, turned) = (mirrored(from.across, chord), mirrored(from.tangent, chord));
    let across = mirrored(across, sub(tangent, turned));
    // Rounding must not grow along the way.
    let across = sub(across, scaled(tangent, dot(across, tangent)));
    let across = scaled(across, 1.0 / norm(across));
    Ok(Node { at: v, point, tangent, across })
}

impl<'a> Frames<'a> {
    fn new(spine: &'a Curve) -> Result<Self, Error> {
        check_corners(spine)?;
        let (start, _) = spine.domain();
        let (point, tangent) = at(spine, start, Side::Above)?;
        let [across, ..] = any_frame(tangent);
        let first = Node { at: start, point, tangent, across };
        let mut before: Option<Vector> = None;
        let mut steps = 16;
        loop {
            let nodes = Self::nodes(spine, first, steps)?;
            let last = nodes[nodes.len() - 1].across;
            let settled = before.is_some_and(|before| gap(before, last) < FRAME_TOLERANCE);
            if settled || 2 * nodes.len() > MOST_NODES {
                return Ok(Self { spine, nodes });
            }
            before = Some(last);
            steps *= 2;
        }
    }

    /// `steps` equal steps in every span.
    fn nodes(spine: &Curve, first: Node, steps: usize) -> Result<Vec<Node>, Error> {
        let values = spine.knots().values();
        let mut nodes = vec![first];
        for span in spine.knots().spans() {
            let [a, b] = [values[span], values[span + 1]];
            for i in 1..=steps {
                let v = if i == steps { b } else { a + (b - a) * (i as f64 / steps as f64) };
                let last = nodes[nodes.len() - 1];
                nodes.push(carried(&last, spine, v)?);
            }
        }
        Ok(nodes)
    }

    /// Frame at `v`: point, tangent, across.
    fn frame(&self, v: f64) -> Result<Node, Error> {
        let behind = self.nodes.partition_point(|node| node.at <= v).max(1);
        let near = &self.nodes[behind - 1];
        if near.at == v { Ok(*near) } else { carried(near, self.spine, v) }
    }

    /// Angle from the first direction to the last, about the first tangent, when both tangents agree.
    fn holonomy(&self) -> f64 {
        let (first, last) = (&self.nodes[0], &self.nodes[self.nodes.len() - 1]);
        if gap(first.tangent, last.tangent) > 1e-6 {
            return 0.0;
        }
        let side = cross(first.tangent, first.across);
        dot(last.across, side).arctangent_over(dot(last.across, first.across))
    }
}

/// Refuses spines whose tangent jumps.
fn check_corners(spine: &Curve) -> Result<(), Error> {
    let (start, end) = spine.domain();
    let inner = spine.knots().values().iter().filter(|v| start < **v && **v < end);
    for &v in inner {
        if spine.knots().multiplicity(v) < spine.degree() {
            continue;
        }
        let (below, above) = (at(spine, v, Side::Below)?.1, at(spine, v, Side::Above)?.1);
        if gap(below, above) > 1e-9 {
            return Err(Error::Unsupported(format!("spine: it has a corner at {v}")));
        }
    }
    Ok(())
}

/// The profile carried along the spine, from where both are: it keeps its place relative to the spine's start. v is the spine's
/// parameter.
///
/// # Errors
/// Options that are not allowed, by name; a spine that stands still or has a corner ([`Error::Unsupported`], with the parameter).
pub fn swept(profile: &Curve, spine: &Curve, options: &SweepOptions) -> Result<Swept, Error> {
    check_positive("tolerance", options.tolerance)?;
    check_number("twist", options.twist)?;
    if options.degree == 0 || options.degree > MAX_DEGREE {
        return invalid(format!("degree: {} given, 1 to {MAX_DEGREE} accepted", options.degree));
    }
    let frames = Frames::new(spine)?;
    let (start, end) = spine.domain();
    let holonomy = frames.holonomy();
    if options.close && !spine.is_closed() {
        return invalid("close: the spine is open".into());
    }
    let turn = options.twist - if options.close { holonomy } else { 0.0 };
    let first = frames.nodes[0];
    let reach = profile.poles().iter().fold(0.0, |reach: f64, p| reach.max(gap(*p, first.point)));
    let scale = if reach > 0.0 { reach } else { 1.0 };
    let basis = [first.across, cross(first.tangent, first.across), first.tangent];
    // Turns are spread over the length.
    let length = if turn == 0.0 { None } else { Some(spine.arc_length(0.0)?) };
    let rate = length.as_ref().map_or(0.0, |length| turn / length.total().value);
    let motion = |v: f64| -> Option<[f64; 12]> {
        let node = frames.frame(v).ok()?;
        let so_far = length.as_ref().map_or(Some(0.0), |length| Some(length.at(v).ok()?.value))?;
        let (sine, cosine) = (rate * so_far).sine_cosine();
        let side = cross(node.tangent, node.across);
        let turned = [
            add(scaled(node.across, cosine), scaled(side, sine)),
            sub(scaled(side, cosine), scaled(node.across, sine)),
            node.tangent,
        ];
        let mut out = [0.0; 12];
        out[..3].copy_from_slice(&node.point);
        for row in 0..3 {
            for column in 0..3 {
                let entry: f64 = (0..3).map(|k| turned[k][row] * basis[k][column]).sum();
                out[3 + 3 * row + column] = scale * entry;
            }
        }
        Some(out)
    };
    let breaks = breaks(spine, options.degree);
    // |dT + dM x| <= |dT| + |dM| |x| <= sqrt(2) times the distance in twelve dimensions. A quarter is for what lies between the samples
    // and for what the proof loses.
    let wanted = Adaptive {
        degree: options.degree,
        tolerance: 0.75 * options.tolerance / std::f64::consts::SQRT_2,
        max_poles: options.max_poles,
        breaks: &breaks,
        ..Adaptive::default()
    };
    let fit = of_function(motion, [start, end], &wanted)?;
    let turns = |v: f64| motion(v).map(|m| std::array::from_fn(|k| if k < 3 { 0.0 } else { m[k] }));
    let error = proven_error(spine, &fit.spline, turns, (scale, rate), options.tolerance)?;
    // The length is known to its own error, and the rate to its rounding.
    let slack = length.map_or(0.0, |length| {
        let total = length.total();
        2.0 * scale * turn.abs() * (total.error / total.value + 4.0 * f64::EPSILON)
    });
    let poles_v = fit.spline.poles();
    let mut poles = Vec::with_capacity(profile.poles().len() * poles_v.len());
    let mut weights = Vec::with_capacity(poles.capacity());
    for (i, p) in profile.poles().iter().enumerate() {
        let x = scaled(sub(*p, first.point), 1.0 / scale);
        for pole in poles_v {
            let row = |k: usize| dot([pole[3 + 3 * k], pole[4 + 3 * k], pole[5 + 3 * k]], x);
            poles.push(std::array::from_fn(|k| pole[k] + row(k)));
            weights.push(profile.weights().map_or(1.0, |w| w[i]));
        }
    }
    let surface = Surface::new(
        profile.knots().values(),
        fit.spline.knots().values(),
        profile.degree(),
        options.degree,
        &poles,
        profile.poles().len(),
        poles_v.len(),
        profile.is_rational().then_some(&weights[..]),
    )?;
    let far = poles.iter().flatten().fold(scale, |far: f64, x| far.max(x.abs()));
    let error = error + slack + 16.0 * f64::EPSILON * far;
    Ok(Swept { surface, error, measured: fit.worst * std::f64::consts::SQRT_2, holonomy })
}

/// Breaks where the spine is less smooth than a fit of a degree.
fn breaks(spine: &Curve, degree: usize) -> Vec<(f64, usize)> {
    let (start, end) = spine.domain();
    let mut breaks: Vec<(f64, usize)> = Vec::new();
    for &v in spine.knots().values().iter().filter(|v| start < **v && **v < end) {
        if breaks.last().is_none_or(|last| last.0 != v) {
            // The tangent is once less smooth than the spine.
            let smooth = spine.degree() - spine.knots().multiplicity(v).min(spine.degree());
            let times = degree.saturating_sub(smooth.saturating_sub(1)).max(1);
            breaks.push((v, times.min(degree)));
        }
    }
    breaks
}

/// Degree of the reference of a proof, and its tolerance as a share of that of the fit.
const REFERENCE_DEGREE: usize = 7;
const REFERENCE_SHARE: f64 = 1e-4;

/// The proven error of a fit to the motion: its path against the spine, its turns against a reference, and the reference against the exact
/// turns.
fn proven_error(
    spine: &Curve,
    fit: &Spline<12>,
    turns: impl Fn(f64) -> Option<[f64; 12]>,
    (scale, rate): (f64, f64),
    tolerance: f64,
) -> Result<f64, Error> {
    let (start, end) = spine.domain();
    let breaks = breaks(spine, REFERENCE_DEGREE);
    let wanted = Adaptive {
        degree: REFERENCE_DEGREE,
        // Closer than doubles are is not reached, only paid for.
        tolerance: (REFERENCE_SHARE * tolerance).max(1e-14 * scale),
        breaks: &breaks,
        ..Adaptive::default()
    };
    let reference = of_function(turns, [start, end], &wanted)?.spline;
    let path = coordinates(fit, [0, 1, 2])?.difference(spine)?.bound;
    let (mut columns, mut square) = (Vec::with_capacity(3), 0.0);
    for k in 0..3 {
        let rows = [3 + k, 6 + k, 9 + k];
        let column = coordinates(&reference, rows)?;
        let bound = coordinates(fit, rows)?.difference(&column)?.bound;
        square += bound * bound;
        columns.push(column);
    }
    let motion = motion_error(spine, &columns, scale, rate)?;
    Ok((path + f64::sqrt(square)) * (1.0 + 8.0 * f64::EPSILON) + motion)
}

/// Three of the coordinates as a curve.
fn coordinates(spline: &Spline<12>, rows: [usize; 3]) -> Result<Curve, Error> {
    let poles: Vec<Vector> = spline.poles().iter().map(|pole| rows.map(|row| pole[row])).collect();
    Curve::new(spline.knots().values(), spline.knots().degree(), &poles, None)
}
