//! Curves of the domain followed onto another parametrisation of their surface by inversion.
//!
//! ```text
//!   a place inside                 its inversion, unrolled: parameters go on over a seam
//!   on a seam of the target        the side that the curve comes from, or goes to
//!   on a collapsed edge            the other parameter is the limit along the curve
//!   a curve all along a seam       the side that the face is on, to the left of the curve
//!   a curve on a collapsed edge    an isoline from the end of the one before to the beginning of the one behind
//! ```
//!
//! Curves become polylines whose images stay within the tolerance of the old ones: found with samples, then proven (`imager`) where no
//! function takes part.

use super::gap::off_curve;
use super::imager::Imager;
use super::{MOST_VERTICES, Support, TrimmedSurface, invalid, norm, sub};
use crate::bounds::{cross, dot};
use crate::closest::{QueryOptions, Workspace, flag};
use crate::error::Error;
use crate::pcurve::{Direction, Parameters, Pcurve};
use crate::portable::SameDigits;
use crate::transform::between;

/// A point nearer to a border than this share of the diagonal is on it.
const BORDER_TOLERANCE: f64 = 1e-13;

/// Samples of every curve at the beginning, how many times more when steps are wide, and how often.
const LEAST_SAMPLES: usize = 16;
const MORE_SAMPLES: usize = 8;
const ROUNDS: usize = 4;

/// A step of a closed direction must be shorter than this share of a turn.
const WIDEST_STEP: f64 = 0.2;

/// Halvings between samples.
const MOST_DEPTH: usize = 40;

/// Places in the middle of a curve from which the direction of the normals is told.
const BESIDE: [f64; 5] = [0.37, 0.61, 0.13, 0.83, 0.5];

/// Shares near the ends of a curve from which a side or a limit at the end is told.
const NEAR_END: [f64; 2] = [1e-3, 2e-3];

/// A place on the target; which parameters are not told by the point alone.
#[derive(Clone, Copy, Debug)]
pub(super) struct Foot {
    pub at: Parameters,
    /// The seam of this direction.
    pub on_seam: [bool; 2],
    /// A collapsed edge leaves this parameter free.
    free: [bool; 2],
}

pub(super) struct Follower<'a> {
    pub from: &'a Support,
    pub to: &'a Support,
    domain: [f64; 4],
    pub closed: [bool; 2],
    pub collapsed: [bool; 4],
    pub tolerance: f64,
    diagonal: f64,
    workspace: Workspace,
    imagers: Option<(Imager<'a>, Imager<'a>)>,
    /// Whether all deviations are proven so far, and the largest.
    pub proven: bool,
    pub deviation: f64,
}

/// A curve that was followed.
pub(super) enum Course {
    /// Unrolled over seams.
    Line { parameters: Vec<f64>, points: Vec<Parameters> },
    /// All along a seam of this direction.
    Seam { first: Parameters, last: Parameters, direction: usize },
    /// On a collapsed edge: which parameter is free, and the place.
    Pole { free: usize, at: Parameters },
}

impl<'a> Follower<'a> {
    /// From one support onto another one, within a tolerance; `diagonal` is that of the latter.
    pub fn new(
        from: &'a Support,
        to: &'a Support,
        tolerance: f64,
        diagonal: f64,
    ) -> Result<Self, Error> {
        Ok(Self {
            from,
            to,
            domain: to.domain(),
            closed: to.closed(),
            collapsed: to.collapsed_edges(),
            tolerance,
            diagonal,
            workspace: Workspace::default(),
            imagers: Imager::of(from)?.zip(Imager::of(to)?),
            proven: true,
            deviation: 0.0,
        })
    }

    /// Whether the normals Su x Sv of both supports are opposite, told beside the curves of the face.
    pub fn is_turned(&mut self, face: &TrimmedSurface) -> Result<bool, Error> {
        for (_, _, coedge) in face.coedges() {
            for share in BESIDE {
                let pcurve = &coedge.pcurve;
                let at = pcurve.evaluate(pcurve.parameter_at(share));
                let mut old = [[0.0; 3]; 3];
                let foot = self.foot(pcurve, pcurve.parameter_at(share))?;
                let mut new = [[0.0; 3]; 3];
                if !self.from.partials(at, 1, &mut old) || !self.to.partials(foot.at, 1, &mut new) {
                    continue;
                }
                let (a, b) = (cross(old[1], old[2]), cross(new[1], new[2]));
                let (together, size) = (dot(a, b), norm(a) * norm(b));
                let speeds = norm(old[1]) * norm(old[2]) * norm(new[1]) * norm(new[2]);
                // Not where one of them has no normal.
                if size > 1e-6 * speeds && together.abs() > 0.5 * size {
                    return Ok(together < 0.0);
                }
            }
        }
        invalid("face: its normal is not told beside any of its curves".into())
    }

    /// Whether a curve leaves the domain over a seam.
    pub fn crosses(&self, course: &Course) -> bool {
        let Course::Line { points, .. } = course else { return false };
        (0..2).filter(|&k| self.closed[k]).any(|k| {
            let [a, b] = self.ends(k);
            points.iter().any(|p| p[k] < a || p[k] > b)
        })
    }

    pub fn period(&self, k: usize) -> f64 {
        self.domain[2 * k + 1] - self.domain[2 * k]
    }

    /// The place inside the domain.
    fn canonical(&self, at: Parameters) -> Parameters {
        [0, 1].map(|k| {
            let [a, b] = self.ends(k);
            if !self.closed[k] || (a..=b).contains(&at[k]) {
                return at[k];
            }
            (at[k] - ((at[k] - a) / (b - a)).floor() * (b - a)).clamp(a, b)
        })
    }

    /// What is proven of a new curve beside the old one.
    pub fn prove(&mut self, old: &Pcurve, new: &Pcurve) -> Result<(), Error> {
        let Some((from, to)) = &mut self.imagers else {
            self.proven = false;
            return Ok(());
        };
        let (ours, (a, b)) = (from.drawn(old)?, new.domain());
        let bound = match new {
            Pcurve::Polyline(_) => {
                let theirs = to.drawn(new)?;
                from.apart(&ours, to, &theirs, [a, b], self.tolerance)
            }
            // A border of the domain: its curve in space is exact.
            Pcurve::Isoline(line) => match self.to.isocurve(line)? {
                Some(curve) => {
                    let along = line.from < line.to;
                    off_curve(from, self.from, old, &curve, along, self.tolerance)?
                }
                None => None,
            },
            _ => None,
        };
        match bound.filter(|bound| *bound <= self.tolerance) {
            Some(bound) => self.deviation = self.deviation.max(bound),
            None => self.proven = false,
        }
        Ok(())
    }

    pub fn ends(&self, k: usize) -> [f64; 2] {
        [self.domain[2 * k], self.domain[2 * k + 1]]
    }

    /// The inversion of the point of a curve.
    pub fn foot(&mut self, pcurve: &Pcurve, t: f64) -> Result<Foot, Error> {
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

    /// The place on the turn that is nearest to another one, with what is not told taken from there.
    pub fn unrolled(&self, foot: &Foot, near: Parameters) -> Parameters {
        [0, 1].map(|k| {
            let ([a, _], period) = (self.ends(k), self.period(k));
            match (foot.free[k], self.closed[k]) {
                (true, _) => near[k],
                (_, false) => foot.at[k],
                _ if foot.on_seam[k] => a + ((near[k] - a) / period).round() * period,
                _ => match ((near[k] - foot.at[k]) / period).round() {
                    0.0 => foot.at[k],
                    turns => foot.at[k] + turns * period,
                },
            }
        })
    }

    fn is_told(foot: &Foot) -> bool {
        !(foot.free[0] || foot.free[1] || foot.on_seam[0] || foot.on_seam[1])
    }

    pub fn course(&mut self, pcurve: &Pcurve) -> Result<Course, Error> {
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

    /// The beginning of a curve, with what is not told there as the limit of places behind it.
    fn first(&mut self, pcurve: &Pcurve, seam: Option<usize>) -> Result<Parameters, Error> {
        let (a, b) = pcurve.domain();
        let mut foot = self.foot(pcurve, a)?;
        self.ignore(&mut foot, seam);
        if Self::is_told(&foot) {
            return Ok(foot.at);
        }
        let mut near = [[0.0; 2]; 2];
        for (k, x) in NEAR_END.into_iter().enumerate() {
            let mut beside = self.foot(pcurve, between(a, b, x))?;
            self.ignore(&mut beside, seam);
            if !Self::is_told(&beside) {
                let t = between(a, b, x);
                let text =
                    "support: a curve stays on a seam or a collapsed edge near its parameter";
                return invalid(format!("{text} {t}"));
            }
            near[k] = if k == 0 { beside.at } else { self.unrolled(&beside, near[0]) };
        }
        let limit = [0, 1].map(|k| 2.0 * near[0][k] - near[1][k]);
        // Where the beginning is on the turn of the domain.
        let at = self.unrolled(&foot, limit);
        Ok([0, 1].map(|k| {
            let [a, b] = self.ends(k);
            if self.closed[k] && !foot.on_seam[k] && !(a..=b).contains(&at[k]) {
                return (at[k] - ((at[k] - a) / (b - a)).floor() * (b - a)).clamp(a, b);
            }
            at[k].clamp(a, b)
        }))
    }

    /// The end of a curve, unrolled, after a place near it.
    fn last(
        &mut self,
        pcurve: &Pcurve,
        before: Parameters,
        seam: Option<usize>,
    ) -> Result<Parameters, Error> {
        let (a, b) = pcurve.domain();
        let mut foot = self.foot(pcurve, b)?;
        self.ignore(&mut foot, seam);
        if !(foot.free[0] || foot.free[1]) {
            return Ok(self.unrolled(&foot, before));
        }
        let mut near = [before; 2];
        for (k, x) in NEAR_END.into_iter().enumerate().rev() {
            let mut beside = self.foot(pcurve, between(a, b, 1.0 - x))?;
            self.ignore(&mut beside, seam);
            near[k] = self.unrolled(&beside, if k == 0 { near[1] } else { before });
        }
        let limit = [0, 1].map(|k| 2.0 * near[0][k] - near[1][k]);
        Ok(self.unrolled(&foot, limit))
    }

    /// Samples of a curve, unrolled, so many that no step is wide.
    fn table(
        &mut self,
        pcurve: &Pcurve,
        seam: Option<usize>,
    ) -> Result<Vec<(f64, Parameters)>, Error> {
        let (a, b) = pcurve.domain();
        let first = self.first(pcurve, seam)?;
        let mut count = LEAST_SAMPLES;
        for _ in 0..ROUNDS {
            let even = (1..count).map(|k| between(a, b, k as f64 / count as f64));
            let mut parameters: Vec<f64> = even.chain(pcurve.breaks()).collect();
            parameters.sort_by(f64::total_cmp);
            parameters.dedup();
            let mut places = vec![(a, first)];
            for t in parameters {
                let mut foot = self.foot(pcurve, t)?;
                self.ignore(&mut foot, seam);
                let at = self.unrolled(&foot, places[places.len() - 1].1);
                places.push((t, at));
            }
            let before = places[places.len() - 1].1;
            places.push((b, self.last(pcurve, before, seam)?));
            let is_wide = |pair: &[(f64, Parameters)]| {
                (0..2).any(|k| {
                    let step = (pair[1].1[k] - pair[0].1[k]).abs();
                    self.closed[k] && step > WIDEST_STEP * self.period(k)
                })
            };
            if !places.windows(2).any(is_wide) {
                return Ok(places);
            }
            count *= MORE_SAMPLES;
        }
        let text =
            "support: a curve passes through a collapsed edge of it, or turns too fast beside one";
        Err(Error::Unsupported(text.into()))
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
        let places = self.table(pcurve, seam)?;
        let (mut parameters, mut points) = (vec![places[0].0], vec![places[0].1]);
        let mut waiting: Vec<([(f64, Parameters); 2], usize)> =
            places.windows(2).rev().map(|w| ([w[0], w[1]], 0)).collect();
        while let Some(([(t, p), (x, q)], depth)) = waiting.pop() {
            let middle = t + 0.5 * (x - t);
            let chord = [0, 1].map(|k| 0.5 * (p[k] + q[k]));
            let there = self.from.evaluate(pcurve.evaluate(middle));
            let off = 1.5 * norm(sub(self.to.evaluate(self.canonical(chord)), there));
            if off <= self.tolerance {
                self.deviation = self.deviation.max(off);
                parameters.push(x);
                points.push(q);
                continue;
            }
            if depth >= MOST_DEPTH || points.len() + waiting.len() > MOST_VERTICES {
                let text = format!("support: a curve takes too many vertices near {middle}");
                return Err(Error::Unsupported(text));
            }
            let mut foot = self.foot(pcurve, middle)?;
            self.ignore(&mut foot, seam);
            let at = self.unrolled(&foot, chord);
            waiting.push(([(middle, at), (x, q)], depth + 1));
            waiting.push(([(t, p), (middle, at)], depth + 1));
        }
        Ok((parameters, points))
    }

    /// The curves of a loop, with ends on collapsed edges taken from their neighbours.
    pub fn settled(&self, courses: &[Course]) -> Result<Vec<Pcurve>, Error> {
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
