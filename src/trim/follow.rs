//! A face on another parametrisation of its surface when the change is not separable: every curve is followed by inversion.
//!
//! ```text
//!   a place inside                 its inversion
//!   on a seam of the target        the side that the curve comes from, or goes to
//!   on a collapsed edge            the other parameter is the limit along the curve
//!   a curve all along a seam       the side that the face is on, to the left of the curve
//!   a curve on a collapsed edge    an isoline from the end of the one before to the beginning of the one behind
//! ```
//!
//! Curves become polylines whose images stay within the tolerance of the old ones at samples between the vertices: measured, not
//! proven. So a loop stays one closed loop, or, when it crosses a seam of the target, is refused: it would have to be cut there.

use super::flat::{Flat, Scale};
use super::{ChangeOptions, Changed, Coedge, DEFAULT_TOLERANCE, MOST_VERTICES};
use super::{Loop, LoopKind, Support, TrimmedSurface, invalid, norm, sub};
use crate::closest::{QueryOptions, Workspace, flag};
use crate::error::Error;
use crate::pcurve::{Direction, Parameters, Pcurve};
use crate::portable::SameDigits;
use crate::transform::between;

/// A point nearer to a border than this share of the diagonal is on it.
const BORDER_TOLERANCE: f64 = 1e-13;

/// Halvings of every curve before its samples may decide, and at most.
const LEAST_DEPTH: usize = 3;
const MOST_DEPTH: usize = 40;

/// Shares near the ends of a curve from which a side or a limit at the end is told.
const NEAR_END: [f64; 2] = [1e-3, 2e-3];

/// A place on the target; which parameters are not told by the point alone.
#[derive(Clone, Copy, Debug)]
struct Foot {
    at: Parameters,
    /// The seam of this direction.
    on_seam: [bool; 2],
    /// A collapsed edge leaves this parameter free.
    free: [bool; 2],
}

struct Follower<'a> {
    from: &'a Support,
    to: &'a Support,
    domain: [f64; 4],
    closed: [bool; 2],
    collapsed: [bool; 4],
    tolerance: f64,
    diagonal: f64,
    workspace: Workspace,
    deviation: f64,
}

/// A curve that was followed.
enum Course {
    Line {
        parameters: Vec<f64>,
        points: Vec<Parameters>,
    },
    /// All along a seam of this direction.
    Seam {
        first: Parameters,
        last: Parameters,
        direction: usize,
    },
    /// On a collapsed edge: which parameter is free, and the place.
    Pole {
        free: usize,
        at: Parameters,
    },
}

impl TrimmedSurface {
    /// The face on `support`, which is the same surface in any other parameters, found by inversion along the loops. Loops and face
    /// are turned when the parameters turn.
    ///
    /// # Errors
    /// A point of a curve that is not on `support`, or whose inversion is not proven; [`Error::Unsupported`] for a curve that crosses
    /// a seam of `support`.
    pub fn followed(&self, support: Support, options: &ChangeOptions) -> Result<Changed, Error> {
        let diagonal = support.bounding_box()?.diagonal();
        let tolerance = match options.tolerance {
            0.0 => DEFAULT_TOLERANCE * diagonal,
            t if t > 0.0 && t.is_finite() => t,
            t => return invalid(format!("tolerance: {t} is not a positive length")),
        };
        let mut follower = Follower {
            from: self.support(),
            to: &support,
            domain: support.domain(),
            closed: support.closed(),
            collapsed: support.collapsed_edges(),
            tolerance,
            diagonal,
            workspace: Workspace::default(),
            deviation: 0.0,
        };
        let mut loops = Vec::new();
        for chain in self.loops() {
            let courses = chain
                .coedges
                .iter()
                .map(|coedge| follower.course(&coedge.pcurve))
                .collect::<Result<Vec<_>, _>>()?;
            let pcurves = follower.settled(courses)?;
            let coedges = chain.coedges.iter().zip(pcurves).map(|(old, pcurve)| {
                let same_parameter = old.same_parameter && matches!(pcurve, Pcurve::Polyline(_));
                Coedge { pcurve, same_parameter, ..*old }
            });
            loops.push(Loop { kind: chain.kind, coedges: coedges.collect() });
        }
        let deviation = follower.deviation;
        let turned = is_turned(&loops, &support, tolerance)?;
        if turned {
            loops.iter_mut().for_each(super::change::reverse);
        }
        let face = Self::new(support, self.edges().to_vec(), loops, self.is_flipped() != turned)?;
        Ok(Changed { face, deviation, proven: false, surface_deviation: deviation })
    }
}

/// Whether the first outer loop runs clockwise.
fn is_turned(loops: &[Loop], support: &Support, tolerance: f64) -> Result<bool, Error> {
    let scale = Scale::of(support)?;
    let Some(chain) = loops.iter().find(|chain| chain.kind == LoopKind::Outer) else {
        return Ok(false);
    };
    let mut polygon = Vec::new();
    for coedge in &chain.coedges {
        polygon.extend(Flat::new(&coedge.pcurve, &scale, tolerance).points);
    }
    let origin = polygon[0];
    let at = |k: usize| {
        let p = polygon[k % polygon.len()];
        [p[0] - origin[0], p[1] - origin[1]]
    };
    let twice: f64 = (0..polygon.len())
        .map(|k| {
            let (p, q) = (at(k), at(k + 1));
            p[0] * q[1] - p[1] * q[0]
        })
        .sum();
    Ok(twice < 0.0)
}

impl Follower<'_> {
    fn ends(&self, k: usize) -> [f64; 2] {
        [self.domain[2 * k], self.domain[2 * k + 1]]
    }

    /// The inversion of the point of a curve.
    fn foot(&mut self, pcurve: &Pcurve, t: f64) -> Result<Foot, Error> {
        let place = pcurve.evaluate(t);
        let query = self.from.evaluate(place);
        let foot = self.to.invert(query, &QueryOptions::default(), &mut self.workspace);
        let lost = foot.flags & flag::NOT_PROVEN != 0;
        if lost || foot.distance.is_nan() || foot.distance > self.tolerance {
            let [u, v] = place;
            return invalid(format!(
                "support: the point of the surface at ({u}, {v}) is {} away from it, {}",
                foot.distance,
                if lost { "not proven" } else { "more than the tolerance" }
            ));
        }
        let mut found = Foot { at: [foot.u, foot.v], on_seam: [false; 2], free: [false; 2] };
        for k in 0..2 {
            for (side, end) in self.ends(k).into_iter().enumerate() {
                let mut border = found.at;
                border[k] = end;
                let off = norm(sub(self.to.evaluate(border), query));
                if off > BORDER_TOLERANCE * self.diagonal {
                    continue;
                }
                if self.collapsed[2 * k + side] {
                    found.at[k] = end;
                    found.free[1 - k] = true;
                } else if self.closed[k] {
                    found.at[k] = end;
                    found.on_seam[k] = true;
                }
            }
        }
        Ok(found)
    }

    /// What the point does not tell, told by a place nearby.
    fn told(&self, foot: Foot, near: Parameters) -> Parameters {
        [0, 1].map(|k| {
            let [a, b] = self.ends(k);
            match (foot.free[k], foot.on_seam[k]) {
                (true, _) => near[k],
                (_, true) if near[k] - a <= b - near[k] => a,
                (_, true) => b,
                _ => foot.at[k],
            }
        })
    }

    fn is_told(foot: &Foot) -> bool {
        !(foot.free[0] || foot.free[1] || foot.on_seam[0] || foot.on_seam[1])
    }

    fn course(&mut self, pcurve: &Pcurve) -> Result<Course, Error> {
        let (a, b) = pcurve.domain();
        let middle = self.foot(pcurve, between(a, b, 0.43))?;
        let other = self.foot(pcurve, between(a, b, 0.61))?;
        for k in 0..2 {
            if middle.free[k] && other.free[k] {
                return Ok(Course::Pole { free: k, at: middle.at });
            }
            if middle.on_seam[k] && other.on_seam[k] {
                let side = self.inner_side(pcurve, k)?;
                let (_, points) = self.line(pcurve, Some(k))?;
                let [first, last] = [points[0], points[points.len() - 1]].map(|mut p| {
                    p[k] = side;
                    p
                });
                return Ok(Course::Seam { first, last, direction: k });
            }
        }
        let (parameters, points) = self.line(pcurve, None)?;
        Ok(Course::Line { parameters, points })
    }

    /// The side of the seam that the face is on, which lies to the left of its curves.
    fn inner_side(&mut self, pcurve: &Pcurve, k: usize) -> Result<f64, Error> {
        let (a, b) = pcurve.domain();
        let t = between(a, b, 0.43);
        let mut out = [[0.0; 2]; 2];
        pcurve.derivatives(t, 1, &mut out);
        let domain = self.from.domain();
        let size = [domain[1] - domain[0], domain[3] - domain[2]];
        // Left in the domain as a square, so that both parameters count.
        let way = [-out[1][1] / size[1], out[1][0] / size[0]];
        let length = way[0].hypotenuse(way[1]);
        let beside = [0, 1].map(|j| out[0][j] + NEAR_END[0] * size[j] * way[j] / length);
        let query = self.from.evaluate(beside);
        let foot = self.to.invert(query, &QueryOptions::default(), &mut self.workspace);
        let found = [foot.u, foot.v][k];
        let [low, high] = self.ends(k);
        if found.is_nan() {
            return invalid("support: the side of a curve along its seam is not told".into());
        }
        Ok(if found - low <= high - found { low } else { high })
    }

    /// The end of a curve, with what is not told there as the limit of places before it.
    fn end(
        &mut self,
        pcurve: &Pcurve,
        last: bool,
        seam: Option<usize>,
    ) -> Result<Parameters, Error> {
        let (a, b) = pcurve.domain();
        let share = |x: f64| between(a, b, if last { 1.0 - x } else { x });
        let mut foot = self.foot(pcurve, share(0.0))?;
        self.ignore(&mut foot, seam);
        if Self::is_told(&foot) {
            return Ok(foot.at);
        }
        let mut near = [[0.0; 2]; 2];
        for (k, x) in NEAR_END.into_iter().enumerate() {
            let mut beside = self.foot(pcurve, share(x))?;
            self.ignore(&mut beside, seam);
            if !Self::is_told(&beside) {
                return invalid(format!(
                    "support: a curve stays on a seam or a collapsed edge near its parameter {}",
                    share(x)
                ));
            }
            near[k] = beside.at;
        }
        let limit = [0, 1].map(|k| {
            let [a, b] = self.ends(k);
            (2.0 * near[0][k] - near[1][k]).max(a).min(b)
        });
        Ok(self.told(foot, limit))
    }

    /// A curve along a seam is followed at its lower side; the side is settled later.
    fn ignore(&self, foot: &mut Foot, seam: Option<usize>) {
        if let Some(k) = seam {
            foot.on_seam[k] = false;
            foot.at[k] = self.ends(k)[0];
        }
    }

    fn line(
        &mut self,
        pcurve: &Pcurve,
        seam: Option<usize>,
    ) -> Result<(Vec<f64>, Vec<Parameters>), Error> {
        let (a, b) = pcurve.domain();
        let first = self.end(pcurve, false, seam)?;
        let last = self.end(pcurve, true, seam)?;
        let mut places = vec![(a, first)];
        for t in pcurve.breaks() {
            let mut foot = self.foot(pcurve, t)?;
            self.ignore(&mut foot, seam);
            let near = places[places.len() - 1].1;
            places.push((t, self.told(foot, near)));
        }
        places.push((b, last));
        let (mut parameters, mut points) = (vec![a], vec![first]);
        let mut waiting: Vec<([(f64, Parameters); 2], usize)> =
            places.windows(2).rev().map(|w| ([w[0], w[1]], 0)).collect();
        while let Some(([(t, p), (x, q)], depth)) = waiting.pop() {
            let middle = t + 0.5 * (x - t);
            let chord = [0, 1].map(|k| 0.5 * (p[k] + q[k]));
            let there = self.from.evaluate(pcurve.evaluate(middle));
            let off = 1.5 * norm(sub(self.to.evaluate(chord), there));
            if depth >= LEAST_DEPTH && off <= self.tolerance {
                self.deviation = self.deviation.max(off);
                parameters.push(x);
                points.push(q);
                continue;
            }
            let jump = (0..2).any(|k| {
                let [a, b] = self.ends(k);
                self.closed[k] && (p[k] - q[k]).abs() > 0.5 * (b - a)
            });
            if depth >= MOST_DEPTH || points.len() + waiting.len() > MOST_VERTICES {
                let why = if jump { "crosses a seam of it" } else { "takes too many vertices" };
                return Err(Error::Unsupported(format!("support: a curve {why} near {middle}")));
            }
            let mut foot = self.foot(pcurve, middle)?;
            self.ignore(&mut foot, seam);
            let at = self.told(foot, chord);
            waiting.push(([(middle, at), (x, q)], depth + 1));
            waiting.push(([(t, p), (middle, at)], depth + 1));
        }
        Ok((parameters, points))
    }

    /// The curves of a loop, with ends on collapsed edges taken from their neighbours.
    fn settled(&self, courses: Vec<Course>) -> Result<Vec<Pcurve>, Error> {
        let count = courses.len();
        let place = |k: usize, last: bool| match &courses[k] {
            Course::Line { points, .. } => Some(points[if last { points.len() - 1 } else { 0 }]),
            Course::Seam { first, last: end, .. } => Some(if last { *end } else { *first }),
            Course::Pole { .. } => None,
        };
        let pcurve = |(k, course): (usize, &Course)| match course {
            Course::Line { parameters, points } => Pcurve::polyline_at(parameters, points),
            Course::Seam { first, last, direction } => {
                // A straight line on the border, whatever its speed.
                let fixed = [Direction::U, Direction::V][*direction];
                let along = 1 - direction;
                Pcurve::isoline(fixed, first[*direction], first[along], last[along])
            }
            Course::Pole { free, at } => {
                let before = place((k + count - 1) % count, true);
                let behind = place((k + 1) % count, false);
                let (Some(before), Some(behind)) = (before, behind) else {
                    return invalid("support: two curves of a loop on one collapsed edge".into());
                };
                let fixed = [Direction::V, Direction::U][*free];
                Pcurve::isoline(fixed, at[1 - free], before[*free], behind[*free])
            }
        };
        courses.iter().enumerate().map(pcurve).collect()
    }
}
