//! Whether a face is valid: what is wrong with its loops, and how far its parts are from each other.
//!
//! ```text
//!   open loop         a coedge does not begin where the one before it ends             in space, through the domain
//!   wrong direction   an outer loop that runs clockwise, an inner one that does not    sign of the area, with its error
//!   crossing          two coedges that change sides                                    proven
//!   touching          two coedges nearer than the tolerance away from common ends      none farther is named
//!   edge gap          the image of a pcurve away from its edge                         found at samples, bounded between (`gap`)
//!   containment       a hole outside, an outer loop inside another one                 winding numbers
//!   sense             an edge that both of its coedges run along the same way          -
//!   outside           a pcurve that leaves the domain                                  by its box
//! ```
//!
//! Distances in the domain are measured with bounds of the speeds of the surface (`flat`): what is found to be apart by a
//! length here may be nearer in space only where the surface is slower than its bound, as at a pole. Coedges without a finding are
//! proven to be disjoint, the error of their segments included; within a hundredth of the shorter one from a common end, or eight
//! tolerances, only that their segments do not cross is. Edge gaps are found at [`super::GAP_SAMPLES`] places and at all corners of each coedge, and have a proven
//! bound where no function takes part.

use super::flat::{Flat, Scale, far, meeting};
use super::gap::Gaps;
use super::{LoopKind, TrimmedSurface, invalid, norm, sub};
use crate::error::Error;
use crate::pcurve::{Parameters, Pcurve};
use crate::transform::between;

/// Default tolerance as a share of the diagonal of the surface's box.
pub const REPORT_TOLERANCE: f64 = 1e-7;

/// Around a common end, this many tolerances are part of the corner.
const CORNER: f64 = 8.0;

/// Contact near a common end of two coedges, up to this share of the shorter one, is the corner itself unless they cross there.
const CORNER_SHARE: f64 = 0.01;

/// A place on a coedge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// Number of the loop.
    pub chain: usize,
    /// Number of the coedge in it.
    pub coedge: usize,
    /// Parameter of the pcurve.
    pub parameter: f64,
}

/// Something that is wrong.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Finding {
    /// The coedge ends away from the beginning of the next one. `gap` is the distance in space; it may be 0 across a seam or along a
    /// collapsed edge that is missing.
    Open {
        /// The end.
        place: Place,
        /// Distance in the domain, u and v.
        domain_gap: [f64; 2],
        /// Distance in space.
        gap: f64,
    },
    /// The loop runs the wrong way; `area` is signed, in the domain.
    Direction {
        /// Number of the loop.
        chain: usize,
        /// Its area.
        area: f64,
    },
    /// The area of the loop is so small that its direction cannot be told.
    NoDirection {
        /// Number of the loop.
        chain: usize,
        /// Its area.
        area: f64,
    },
    /// Two coedges cross, or one crosses itself.
    Crossing {
        /// A place on the first.
        first: Place,
        /// A place on the second.
        second: Place,
    },
    /// Two coedges come nearer than the tolerance away from common ends, or one does to itself.
    Touching {
        /// A place on the first.
        first: Place,
        /// A place on the second.
        second: Place,
        /// Bound of their distance in space.
        distance: f64,
    },
    /// The image of the pcurve is away from the edge.
    EdgeGap {
        /// Where it is most.
        place: Place,
        /// Distance in space.
        gap: f64,
    },
    /// The pcurve leaves the domain of the surface.
    Outside {
        /// Where it is farthest outside.
        place: Place,
        /// By how much, u and v.
        by: [f64; 2],
    },
    /// A loop is not where its kind says: a hole outside of all outer loops or inside another hole, or an outer loop inside another.
    Containment {
        /// Number of the loop.
        chain: usize,
        /// Outer loops around it, less holes around it; 1 for a hole, 0 for an outer loop that are right.
        depth: i32,
    },
    /// Both coedges of an edge run along it the same way.
    Sense {
        /// Number of the edge.
        edge: usize,
    },
    /// Whether two coedges touch could not be decided: they are too long for the tolerance, or lie on each other.
    Undecided {
        /// Loop and coedge of the first.
        first: [usize; 2],
        /// Loop and coedge of the second.
        second: [usize; 2],
    },
    /// The surface's function fails on a coedge.
    Failing {
        /// Where.
        place: Place,
    },
}

/// What was found.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    /// All that is wrong, in the order of the checks.
    pub findings: Vec<Finding>,
    /// The tolerance used, a length.
    pub tolerance: f64,
    /// Largest distance of a coedge's end and the next one's beginning, in space.
    pub largest_opening: f64,
    /// Largest distance of a pcurve's image and its edge at samples.
    pub largest_gap: f64,
    /// Proven: no image of a pcurve and its edge are farther apart, at equal parameters where they share them, else as sets of points.
    /// Infinite where a function takes part or a pcurve leaves the domain.
    pub gap_bound: f64,
    /// Area of each loop in the domain; counter-clockwise is positive.
    pub areas: Vec<f64>,
    /// How far segments may be from the curves, a length; below the tolerance unless a curve is very long.
    pub segment_error: f64,
    /// Whether the speeds behind lengths in the domain are bounds; for surfaces by a function they come from samples.
    pub proven: bool,
}

impl Report {
    /// Whether nothing is wrong.
    pub fn is_valid(&self) -> bool {
        self.findings.is_empty()
    }
}

/// Two segments that meet.
struct Hit {
    crossing: bool,
    distance: f64,
    at: Parameters,
    segments: [usize; 2],
    parameters: [f64; 2],
}

impl Hit {
    /// Whether another one is the same contact: at the same place, or a touch that goes on along neighbouring segments.
    fn continues(&self, next: &Self, near: f64) -> bool {
        let beside = |k: usize| self.segments[k].abs_diff(next.segments[k]) <= 1;
        let touch = !self.crossing && !next.crossing && beside(0) && beside(1);
        touch || far(self.at, next.at) <= near
    }
}

/// A part of a segment of a chain.
struct Clipped {
    ends: [Parameters; 2],
    /// Its shares of the segment.
    shares: [f64; 2],
}

impl Clipped {
    fn of(flat: &Flat, k: usize) -> Self {
        Self { ends: flat.segment(k), shares: [0.0, 1.0] }
    }

    fn at(&self, share: f64) -> Parameters {
        let [a, b] = self.ends;
        [0, 1].map(|k| a[k] + share * (b[k] - a[k]))
    }

    /// The share of the whole segment.
    fn share(&self, share: f64) -> f64 {
        self.shares[0] + share * (self.shares[1] - self.shares[0])
    }

    /// Leaves what is farther than `reach` from a corner near one of its ends; false when nothing is.
    fn leave(&mut self, corner: Parameters, reach: f64) -> bool {
        let [x, y] = self.ends.map(|end| far(end, corner));
        if x.max(y) <= reach {
            return false;
        }
        if x.min(y) < reach {
            let cut = (reach - x) / (y - x);
            let side = usize::from(x > y);
            (self.ends[side], self.shares[side]) = (self.at(cut), self.share(cut));
        }
        true
    }
}

/// Whether the second of two neighbouring segments goes back along the first.
fn turns_back([a, b]: [Parameters; 2], [c, d]: [Parameters; 2]) -> bool {
    (b[0] - a[0]) * (d[0] - c[0]) + (b[1] - a[1]) * (d[1] - c[1]) < 0.0
}

struct Checker<'a> {
    face: &'a TrimmedSurface,
    scale: Scale,
    tolerance: f64,
    /// Chains of segments, by loop and coedge.
    flats: Vec<Vec<Flat>>,
    findings: Vec<Finding>,
}

impl TrimmedSurface {
    /// Checks the face. `tolerance` is a length; 0: [`REPORT_TOLERANCE`] of the diagonal of the surface's box. Cost: milliseconds.
    ///
    /// # Errors
    /// A tolerance that is no length; memory that could not be had.
    pub fn report(&self, tolerance: f64) -> Result<Report, Error> {
        let tolerance = match tolerance {
            0.0 => REPORT_TOLERANCE * self.support().bounding_box()?.diagonal(),
            t if t > 0.0 && t.is_finite() => t,
            t => return invalid(format!("tolerance: {t} is not a positive length")),
        };
        let scale = Scale::of(self.support())?;
        let flats: Vec<Vec<Flat>> = self
            .loops()
            .iter()
            .map(|chain| {
                let flat = |pcurve: &Pcurve| Flat::new(pcurve, &scale, tolerance / 8.0);
                chain.coedges.iter().map(|coedge| flat(&coedge.pcurve)).collect()
            })
            .collect();
        let mut checker = Checker { face: self, scale, tolerance, flats, findings: Vec::new() };
        checker.domain();
        let largest_opening = checker.openings();
        let areas = checker.directions();
        checker.contacts();
        checker.containment();
        let [largest_gap, gap_bound] = checker.gaps()?;
        checker.senses();
        let errors = checker.flats.iter().flatten().map(|flat| flat.error);
        Ok(Report {
            tolerance,
            largest_opening,
            largest_gap,
            gap_bound,
            areas,
            segment_error: errors.fold(0.0, f64::max),
            proven: scale.proven,
            findings: checker.findings,
        })
    }
}

impl Checker<'_> {
    fn pcurve(&self, chain: usize, coedge: usize) -> &Pcurve {
        &self.face.loops()[chain].coedges[coedge].pcurve
    }

    /// All coedges by loop and number.
    fn all(&self) -> Vec<[usize; 2]> {
        self.face.coedges().map(|(chain, coedge, _)| [chain, coedge]).collect()
    }

    fn domain(&mut self) {
        let domain = self.face.support().domain();
        for [chain, coedge] in self.all() {
            let pcurve = self.pcurve(chain, coedge);
            let flat = &self.flats[chain][coedge];
            let mut worst = (0.0f64, [0.0; 2], 0.0);
            for &t in &flat.parameters {
                let p = pcurve.evaluate(t);
                let by =
                    [0, 1].map(|k| (domain[2 * k] - p[k]).max(p[k] - domain[2 * k + 1]).max(0.0));
                let length = self.scale.point(by);
                if length[0] + length[1] > worst.0 {
                    worst = (length[0] + length[1], by, t);
                }
            }
            if worst.0 > self.tolerance {
                let place = Place { chain, coedge, parameter: worst.2 };
                self.findings.push(Finding::Outside { place, by: worst.1 });
            }
        }
    }

    fn openings(&mut self) -> f64 {
        let mut largest: f64 = 0.0;
        for [chain, coedge] in self.all() {
            let coedges = &self.face.loops()[chain].coedges;
            let next = &coedges[(coedge + 1) % coedges.len()];
            let (end, start) = (coedges[coedge].end(), next.start());
            let support = self.face.support();
            let gap = norm(sub(support.evaluate(end), support.evaluate(start)));
            let domain_gap = [0, 1].map(|k| (end[k] - start[k]).abs());
            let length = self.scale.point(domain_gap);
            let place = Place { chain, coedge, parameter: self.pcurve(chain, coedge).domain().1 };
            if gap.is_nan() {
                self.findings.push(Finding::Failing { place });
                continue;
            }
            largest = largest.max(gap);
            if length[0] + length[1] > self.tolerance {
                self.findings.push(Finding::Open { place, domain_gap, gap });
            }
        }
        largest
    }

    /// The loop as a polygon, closed across what is open.
    fn polygon(&self, chain: usize) -> Vec<Parameters> {
        self.flats[chain].iter().flat_map(|flat| flat.points.iter().copied()).collect()
    }

    fn directions(&mut self) -> Vec<f64> {
        let mut areas = Vec::new();
        for (chain, item) in self.face.loops().iter().enumerate() {
            let polygon = self.polygon(chain);
            let origin = polygon[0];
            let at = |k: usize| {
                let p = polygon[k % polygon.len()];
                [p[0] - origin[0], p[1] - origin[1]]
            };
            let mut twice = 0.0;
            let mut size: f64 = 0.0;
            for k in 0..polygon.len() {
                let (p, q) = (at(k), at(k + 1));
                twice += p[0] * q[1] - p[1] * q[0];
                size = size.max(far(p, [0.0; 2]));
            }
            let flats = &self.flats[chain];
            let length: f64 = flats.iter().map(|flat| flat.length).sum();
            let off = flats.iter().map(|flat| flat.error).fold(0.0, f64::max);
            let rounding = 1e-15 * polygon.len() as f64 * size * size;
            let error = length * off + rounding + self.tolerance * self.tolerance;
            let scaled = 0.5 * twice;
            let area = scaled / (self.scale.speeds[0] * self.scale.speeds[1]);
            areas.push(area);
            if scaled.abs() <= error {
                self.findings.push(Finding::NoDirection { chain, area });
            } else if (scaled > 0.0) != (item.kind == LoopKind::Outer) {
                self.findings.push(Finding::Direction { chain, area });
            }
        }
        areas
    }

    fn contacts(&mut self) {
        let all = self.all();
        let mut findings = Vec::new();
        for (k, &first) in all.iter().enumerate() {
            for &second in &all[k..] {
                self.pair(first, second, &mut findings);
            }
        }
        self.findings.extend(findings);
    }

    /// The corners that two coedges share: their neighbouring ends.
    fn corners(&self, first: [usize; 2], second: [usize; 2]) -> Vec<Parameters> {
        if first[0] != second[0] {
            return Vec::new();
        }
        let count = self.flats[first[0]].len();
        let point =
            |flat: &Flat, last: bool| flat.points[if last { flat.points.len() - 1 } else { 0 }];
        let (a, b) = (&self.flats[first[0]][first[1]], &self.flats[second[0]][second[1]]);
        let mut corners = Vec::new();
        if (first[1] + 1) % count == second[1] {
            corners.extend([point(a, true), point(b, false)]);
        }
        if (second[1] + 1) % count == first[1] {
            corners.extend([point(b, true), point(a, false)]);
        }
        corners
    }

    fn pair(&self, first: [usize; 2], second: [usize; 2], findings: &mut Vec<Finding>) {
        let (a, b) = (&self.flats[first[0]][first[1]], &self.flats[second[0]][second[1]]);
        let own = first == second;
        let contact = self.tolerance + a.error + b.error;
        let corners = self.corners(first, second);
        let near = CORNER * contact;
        let wide = near + CORNER_SHARE * a.length.min(b.length);
        let mut hits: Vec<Hit> = Vec::new();
        let complete = a.pairs(b, contact, &mut |i, j| {
            let (mut p, mut q) = (Clipped::of(a, i), Clipped::of(b, j));
            let (mut ends, mut wide) = (corners.clone(), wide);
            if own && i >= j || own && j - i > 1 && a.run(i + 1, j) <= near {
                return;
            }
            if own && j - i == 1 {
                // Neighbours touch where they turn back.
                if !turns_back(p.ends, q.ends) {
                    return;
                }
                ends = vec![a.points[j]];
                wide =
                    near + CORNER_SHARE * far(p.ends[0], p.ends[1]).min(far(q.ends[0], q.ends[1]));
            }
            let (mut crossing, mut distance, mut shares) =
                meeting(p.ends, q.ends, a.error + b.error);
            if distance > contact {
                return;
            }
            let reach = if crossing { near } else { wide };
            if ends.iter().any(|corner| far(*corner, p.at(shares[0])) <= reach) {
                // The corner itself is no contact; what comes after it may be.
                let all = ends.iter().all(|c| p.leave(*c, wide) && q.leave(*c, wide));
                if !all {
                    return;
                }
                (crossing, distance, shares) = meeting(p.ends, q.ends, a.error + b.error);
                if distance > contact {
                    return;
                }
            }
            let s = between(a.parameters[i], a.parameters[i + 1], p.share(shares[0]));
            let t = between(b.parameters[j], b.parameters[j + 1], q.share(shares[1]));
            let (at, segments) = (p.at(shares[0]), [i, j]);
            hits.push(Hit { crossing, distance, at, segments, parameters: [s, t] });
        });
        if !complete {
            findings.push(Finding::Undecided { first, second });
            return;
        }
        hits.sort_by(|x, y| x.parameters[0].total_cmp(&y.parameters[0]));
        let mut before: Option<Hit> = None;
        for hit in hits {
            let place = |k: usize, at: [usize; 2]| Place {
                chain: at[0],
                coedge: at[1],
                parameter: hit.parameters[k],
            };
            let (first, second) = (place(0, first), place(1, second));
            let same = before.as_ref().is_some_and(|old| old.continues(&hit, near));
            match findings.last_mut() {
                Some(last) if same => {
                    if hit.crossing {
                        *last = Finding::Crossing { first, second };
                    }
                }
                _ if hit.crossing => findings.push(Finding::Crossing { first, second }),
                _ => {
                    let distance = 2f64.sqrt() * hit.distance + a.error + b.error;
                    findings.push(Finding::Touching { first, second, distance });
                }
            }
            before = Some(hit);
        }
    }

    fn containment(&mut self) {
        let polygons: Vec<Vec<Parameters>> =
            (0..self.flats.len()).map(|chain| self.polygon(chain)).collect();
        for (chain, item) in self.face.loops().iter().enumerate() {
            let [p, q] = self.flats[chain][0].segment(self.flats[chain][0].segments() / 2);
            let at = [0, 1].map(|k| 0.5 * (p[k] + q[k]));
            let mut depth = 0;
            for (other, polygon) in polygons.iter().enumerate() {
                if other != chain && winding(polygon, at) != 0 {
                    let outer = self.face.loops()[other].kind == LoopKind::Outer;
                    depth += if outer { 1 } else { -1 };
                }
            }
            if depth != i32::from(item.kind == LoopKind::Inner) {
                self.findings.push(Finding::Containment { chain, depth });
            }
        }
    }

    /// The largest gap at samples, and a bound of all.
    fn gaps(&mut self) -> Result<[f64; 2], Error> {
        let (mut largest, mut bound) = (0.0f64, 0.0f64);
        let face = self.face;
        let mut gaps = Gaps::new(face, self.tolerance)?;
        for (chain, number, coedge) in face.coedges() {
            let Some(edge) = coedge.edge.map(|edge| &face.edges()[edge]) else { continue };
            let (gap, parameter) = gaps.measured(coedge, edge);
            let place = Place { chain, coedge: number, parameter };
            if gap.is_nan() {
                self.findings.push(Finding::Failing { place });
                bound = f64::INFINITY;
                continue;
            }
            largest = largest.max(gap);
            bound = bound.max(gaps.bound(coedge, edge)?.max(gap));
            if gap > self.tolerance {
                self.findings.push(Finding::EdgeGap { place, gap });
            }
        }
        Ok([largest, bound])
    }

    fn senses(&mut self) {
        for edge in 0..self.face.edges().len() {
            let uses: Vec<bool> = self
                .face
                .coedges()
                .filter(|(_, _, coedge)| coedge.edge == Some(edge))
                .map(|(_, _, coedge)| coedge.reversed)
                .collect();
            if uses.len() == 2 && uses[0] == uses[1] && !self.face.edges()[edge].is_collapsed() {
                self.findings.push(Finding::Sense { edge });
            }
        }
    }
}

/// Number of turns of a polygon around a place that is not on it.
pub(super) fn winding(polygon: &[Parameters], [x, y]: Parameters) -> i32 {
    let mut turns = 0;
    for k in 0..polygon.len() {
        let (p, q) = (polygon[k], polygon[(k + 1) % polygon.len()]);
        let left = (q[0] - p[0]) * (y - p[1]) - (x - p[0]) * (q[1] - p[1]);
        if p[1] <= y && q[1] > y && left > 0.0 {
            turns += 1;
        } else if p[1] > y && q[1] <= y && left < 0.0 {
            turns -= 1;
        }
    }
    turns
}
