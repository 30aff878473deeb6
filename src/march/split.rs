//! A face cut into faces along curves in its domain: the pcurves of an intersection.
//!
//! ```text
//!   coedges of the loops, cut where a curve ends on them        walked with the face on the left
//!   + each curve, in both directions                            at a node: the first way out, clockwise from where we came
//!   -> closed chains: counter-clockwise an outer loop, clockwise a hole of the smallest one around it
//! ```
//!
//! A curve that is not closed, and does not end on loops and other curves, cuts nothing: it is named, and left out. Coedges that are not cut keep their edges; cut ones are known as the
//! images of their pcurves; a new curve is one edge for the two coedges along it.

use super::watch::Watch;
use super::{Intersection, MarchPoint};
use crate::bounds::{norm, sub};
use crate::curve::Curve;
use crate::error::Error;
use crate::face::{Halving, Region, Side};
use crate::pcurve::Pcurve;
use crate::portable::SameDigits;
use crate::trim::{Coedge, Edge, Loop, TrimmedSurface};

/// Samples of a curve for its area and for the nearest place on it.
const SAMPLES: usize = 64;

/// A curve along which a face is cut.
#[derive(Clone, Debug)]
pub struct Cut {
    /// In the domain of the face.
    pub pcurve: Pcurve,
    /// The same curve in space, with the same parameter; none: only known by the pcurve.
    pub edge: Option<Curve>,
}

#[derive(Clone, Copy)]
enum Source {
    /// A coedge of the face; whether it is whole.
    Loop { chain: usize, coedge: usize, whole: bool },
    /// A cut; whether against it.
    Cut { number: usize, against: bool },
}

/// A directed curve between two nodes, with the face on the left.
struct Way {
    pcurve: Pcurve,
    source: Source,
    from: usize,
    to: usize,
}

struct Plane<'a, 'w> {
    face: &'a TrimmedSurface,
    scale: [f64; 2],
    tolerance: f64,
    nodes: Vec<[f64; 2]>,
    ways: Vec<Way>,
    watch: &'a Watch<'w>,
}

fn refused<T>(text: String) -> Result<T, Error> {
    Err(Error::InvalidArgument(text))
}

impl Plane<'_, '_> {
    fn apart(&self, p: [f64; 2], q: [f64; 2]) -> f64 {
        ((p[0] - q[0]) / self.scale[0]).hypotenuse((p[1] - q[1]) / self.scale[1])
    }

    /// Whether two places are one: in the domain, and in space.
    fn same(&self, p: [f64; 2], q: [f64; 2]) -> bool {
        let support = self.face.support();
        self.apart(p, q) <= 1e-3
            && norm(sub(support.evaluate(p), support.evaluate(q))) <= self.tolerance
    }

    fn node(&mut self, at: [f64; 2]) -> usize {
        match (0..self.nodes.len()).find(|&k| self.same(self.nodes[k], at)) {
            Some(known) => known,
            None => {
                self.nodes.push(at);
                self.nodes.len() - 1
            }
        }
    }

    /// The parameter of the place of a pcurve that is nearest to `at`.
    fn nearest(&self, pcurve: &Pcurve, at: [f64; 2]) -> f64 {
        let (a, b) = pcurve.domain();
        let far = |t: f64| self.apart(pcurve.evaluate(t), at);
        let count = SAMPLES.max(4 * pcurve.breaks().len());
        let t = |k: usize| if k == count { b } else { a + (b - a) * k as f64 / count as f64 };
        let best = (0..=count).min_by(|&i, &j| far(t(i)).total_cmp(&far(t(j)))).unwrap_or(0);
        // Golden section between the neighbours, then what the ends are.
        let (mut low, mut high) = (t(best.saturating_sub(1)), t((best + 1).min(count)));
        let golden = 0.618_033_988_749_894_9;
        let (mut x, mut y) = (high - golden * (high - low), low + golden * (high - low));
        for _ in 0..90 {
            if far(x) <= far(y) {
                (high, y) = (y, x);
                x = high - golden * (high - low);
            } else {
                (low, x) = (x, y);
                y = low + golden * (high - low);
            }
        }
        let ends = [a, b, 0.5 * (low + high)];
        ends.into_iter().min_by(|&s, &t| far(s).total_cmp(&far(t))).unwrap_or(a)
    }

    /// Direction of a way at its beginning, or back along it from its end, as an angle.
    fn angle(&self, pcurve: &Pcurve, at_end: bool) -> f64 {
        let (a, b) = pcurve.domain();
        let (from, sign) = if at_end { (b, -1.0) } else { (a, 1.0) };
        let (p, mut share) = (pcurve.evaluate(from), 1e-6);
        loop {
            let q = pcurve.evaluate(from + sign * share * (b - a));
            let d = [(q[0] - p[0]) / self.scale[0], (q[1] - p[1]) / self.scale[1]];
            if d[0].abs() + d[1].abs() > 1e-9 || share > 0.1 {
                return d[1].arctangent_over(d[0]);
            }
            share *= 8.0;
        }
    }

    fn loops(&mut self, cuts: &[Cut]) -> Result<(), Error> {
        let ends: Vec<[f64; 2]> = cuts
            .iter()
            .filter(|cut| !self.is_loop(&cut.pcurve))
            .flat_map(|cut| [cut.pcurve.start(), cut.pcurve.end()])
            .collect();
        let face = self.face;
        for (chain, i, coedge) in face.coedges() {
            let pcurve = &coedge.pcurve;
            let (a, b) = pcurve.domain();
            let mut places: Vec<f64> = Vec::new();
            for &end in &ends {
                if self.watch.stops(ends.len()) {
                    return Err(Error::Cancelled);
                }
                let t = self.nearest(pcurve, end);
                if !self.same(pcurve.evaluate(t), end) {
                    continue;
                }
                let apart = |s: f64| !self.same(pcurve.evaluate(s), pcurve.evaluate(t));
                if [a, b].into_iter().chain(places.iter().copied()).all(apart) {
                    places.push(t);
                }
            }
            places.sort_by(f64::total_cmp);
            let mut from = self.node(pcurve.start());
            let mut begin = a;
            for (k, &t) in places.iter().chain([&b]).enumerate() {
                let whole = places.is_empty();
                let part = if whole { pcurve.clone() } else { pcurve.part(begin, t)? };
                let at = if k == places.len() { pcurve.end() } else { pcurve.evaluate(t) };
                let to = self.node(at);
                let source = Source::Loop { chain, coedge: i, whole };
                self.ways.push(Way { pcurve: part, source, from, to });
                (from, begin) = (to, t);
            }
        }
        Ok(())
    }

    fn is_loop(&self, pcurve: &Pcurve) -> bool {
        self.same(pcurve.start(), pcurve.end())
    }

    fn cuts(&mut self, cuts: &[Cut]) {
        for (number, cut) in cuts.iter().enumerate() {
            let (from, to) = (self.node(cut.pcurve.start()), self.node(cut.pcurve.end()));
            let back = cut.pcurve.reversed();
            let source = |against: bool| Source::Cut { number, against };
            self.ways.push(Way { pcurve: cut.pcurve.clone(), source: source(false), from, to });
            self.ways.push(Way { pcurve: back, source: source(true), from: to, to: from });
        }
    }

    /// Numbers of the cuts that are closed, or end on loops and on one another.
    fn useful(&self, cuts: &[Cut]) -> Vec<usize> {
        let on_loop = |at: [f64; 2]| {
            self.face.coedges().any(|(_, _, coedge)| {
                if self.watch.stops(cuts.len()) {
                    return false;
                }
                let t = self.nearest(&coedge.pcurve, at);
                self.same(coedge.pcurve.evaluate(t), at)
            })
        };
        let ends: Vec<[[f64; 2]; 2]> =
            cuts.iter().map(|cut| [cut.pcurve.start(), cut.pcurve.end()]).collect();
        let held: Vec<[bool; 2]> = ends.iter().map(|ends| ends.map(on_loop)).collect();
        let mut useful: Vec<usize> = (0..cuts.len()).collect();
        loop {
            let before = useful.len();
            let among = useful.clone();
            useful.retain(|&k| {
                let meets = |end: usize| {
                    held[k][end]
                        || among.iter().any(|&j| {
                            (0..2)
                                .any(|e| (j, e) != (k, end) && self.same(ends[j][e], ends[k][end]))
                        })
                };
                meets(0) && meets(1)
            });
            if useful.len() == before {
                return useful;
            }
        }
    }

    /// Closed chains of ways.
    fn chains(&self) -> Result<Vec<Vec<usize>>, Error> {
        let turn = 2.0 * std::f64::consts::PI;
        let out: Vec<f64> = self.ways.iter().map(|w| self.angle(&w.pcurve, false)).collect();
        let mut used = vec![false; self.ways.len()];
        let mut chains = Vec::new();
        for start in 0..self.ways.len() {
            if used[start] {
                continue;
            }
            let (mut chain, mut at) = (Vec::new(), start);
            loop {
                if used[at] {
                    return refused("cuts: two of them leave a place in one direction".into());
                }
                if self.watch.stops(self.ways.len()) {
                    return Err(Error::Cancelled);
                }
                used[at] = true;
                chain.push(at);
                let back = self.angle(&self.ways[at].pcurve, true);
                let clockwise = |k: usize| {
                    let by = (back - out[k]) % turn;
                    let by = if by < 0.0 { by + turn } else { by };
                    // The way back is the last choice.
                    if by < 1e-7 { by + turn } else { by }
                };
                let node = self.ways[at].to;
                let ways = (0..self.ways.len()).filter(|&k| self.ways[k].from == node);
                let Some(next) = ways.min_by(|&i, &j| clockwise(i).total_cmp(&clockwise(j))) else {
                    return refused("face: a loop is not closed".into());
                };
                at = next;
                if at == start {
                    break;
                }
            }
            chains.push(chain);
        }
        Ok(chains)
    }

    /// Twice the area that a chain encloses, positive counter-clockwise.
    fn area(&self, chain: &[usize]) -> f64 {
        let mut points: Vec<[f64; 2]> = Vec::new();
        for &k in chain {
            let pcurve = &self.ways[k].pcurve;
            let count = SAMPLES.max(8 * pcurve.breaks().len());
            points.extend(
                (0..count).map(|i| pcurve.evaluate(pcurve.parameter_at(i as f64 / count as f64))),
            );
        }
        let next = |i: usize| points[(i + 1) % points.len()];
        (0..points.len()).map(|i| points[i][0] * next(i)[1] - points[i][1] * next(i)[0]).sum()
    }

    fn region(&self, chain: &[usize]) -> Result<Region, Error> {
        let curves: Result<Vec<Curve>, Error> =
            chain.iter().map(|&k| self.ways[k].pcurve.as_spline()).collect();
        Region::new([curves?.iter()])
    }

    /// The face of some chains, the outer one first.
    fn made(&self, chains: &[&Vec<usize>], cuts: &[Cut]) -> Result<TrimmedSurface, Error> {
        let mut edges: Vec<Edge> = Vec::new();
        let mut known: Vec<(usize, usize)> = Vec::new();
        let old = self.face.edges().len();
        let mut loops = Vec::new();
        for (n, chain) in chains.iter().enumerate() {
            let mut coedges = Vec::new();
            for &k in *chain {
                let way = &self.ways[k];
                let (key, edge, reversed, same_parameter) = match way.source {
                    Source::Loop { chain, coedge, whole } => {
                        let own = &self.face.loops()[chain].coedges[coedge];
                        let edge = own.edge.filter(|_| whole);
                        let curve = edge.map(|e| self.face.edges()[e].clone());
                        (edge, curve, own.reversed && whole, own.same_parameter && whole)
                    }
                    Source::Cut { number, against } => {
                        let curve = cuts[number].edge.clone().map(Edge::along);
                        let is_known = curve.is_some();
                        (Some(old + number), curve, against && is_known, is_known)
                    }
                };
                let edge = match (key, edge) {
                    (Some(key), Some(edge)) => {
                        let found = known.iter().find(|(k, _)| *k == key).map(|(_, n)| *n);
                        Some(found.unwrap_or_else(|| {
                            edges.push(edge);
                            known.push((key, edges.len() - 1));
                            edges.len() - 1
                        }))
                    }
                    _ => None,
                };
                let pcurve = way.pcurve.clone();
                coedges.push(Coedge { pcurve, edge, reversed, same_parameter });
            }
            loops.push(if n == 0 { Loop::outer(coedges) } else { Loop::inner(coedges) });
        }
        let support = self.face.support().clone();
        TrimmedSurface::new(support, edges, loops, self.face.is_flipped())
    }
}

/// A face in parts.
pub struct Split {
    /// The parts.
    pub faces: Vec<TrimmedSurface>,
    /// Numbers of the cuts that end inside the face and cut nothing.
    pub unused: Vec<usize>,
}

/// The branches of an intersection as cuts of one of its faces (`second`: of B): polylines in the domain and in space, as near as the chord
/// tolerance made them. Branches over a seam are cut there; touching ones are left out.
///
/// # Errors
/// None in practice.
pub fn cuts_of(found: &Intersection, second: bool) -> Result<Vec<Cut>, Error> {
    let mut cuts = Vec::new();
    for branch in found.branches.iter().filter(|branch| !branch.is_tangential) {
        let mut run: Vec<MarchPoint> = Vec::new();
        for (i, point) in branch.points.iter().enumerate() {
            let seam = i > 0 && branch.points[i - 1].point == point.point;
            if seam || branch.passes_seam(i) {
                cuts.extend(polylines(&run, second)?);
                run.clear();
            }
            run.push(*point);
        }
        cuts.extend(polylines(&run, second)?);
    }
    Ok(cuts)
}

/// A run of points as a cut; `None` when it has no length.
fn polylines(run: &[MarchPoint], second: bool) -> Result<Option<Cut>, Error> {
    let at = |p: &MarchPoint| if second { p.st } else { p.uv };
    let (mut parameters, mut places, mut points) = (Vec::new(), Vec::new(), Vec::new());
    for p in run {
        let last = points.last().map_or(f64::INFINITY, |&x| norm(sub(p.point, x)));
        if last > 0.0 && places.last() != Some(&at(p)) {
            parameters.push(if last.is_finite() {
                parameters[parameters.len() - 1] + last
            } else {
                0.0
            });
            places.push(at(p));
            points.push(p.point);
        }
    }
    if points.len() < 2 {
        return Ok(None);
    }
    let mut knots = vec![parameters[0]];
    knots.extend(&parameters);
    knots.push(parameters[parameters.len() - 1]);
    let edge = Some(Curve::new(&knots, 1, &points, None)?);
    Ok(Some(Cut { pcurve: Pcurve::polyline_at(&parameters, &places)?, edge }))
}

/// The faces into which curves cut a face. `tolerance`: a length within which ends of curves meet loops and one another. Curves that
/// cross one another must be cut there first. `poll(done, left)` is asked now and then whether to stop.
///
/// # Errors
/// A tolerance that is no positive length; cuts that touch; loops that are not closed; [`Error::Cancelled`].
pub fn split(
    face: &TrimmedSurface,
    cuts: &[Cut],
    tolerance: f64,
    poll: &mut dyn FnMut(u64, u64) -> bool,
) -> Result<Split, Error> {
    if !tolerance.is_finite() || tolerance <= 0.0 {
        return refused(format!("tolerance: {tolerance} is not a positive length"));
    }
    let [u0, u1, v0, v1] = face.support().domain();
    let watch = Watch::new(poll);
    let mut plane = Plane {
        face,
        scale: [u1 - u0, v1 - v0],
        tolerance,
        nodes: Vec::new(),
        ways: Vec::new(),
        watch: &watch,
    };
    let useful = plane.useful(cuts);
    let unused = (0..cuts.len()).filter(|k| !useful.contains(k)).collect();
    let cuts: Vec<Cut> = useful.iter().map(|&k| cuts[k].clone()).collect();
    plane.loops(&cuts)?;
    plane.cuts(&cuts);
    let chains = plane.chains()?;
    let areas: Vec<f64> = chains.iter().map(|chain| plane.area(chain)).collect();
    let outer: Vec<usize> = (0..chains.len()).filter(|&k| areas[k] > 0.0).collect();
    let regions: Result<Vec<Region>, Error> =
        outer.iter().map(|&k| plane.region(&chains[k])).collect();
    let (regions, mut memory) = (regions?, Halving::default());
    let mut parts: Vec<Vec<&Vec<usize>>> = outer.iter().map(|&k| vec![&chains[k]]).collect();
    for (k, chain) in chains.iter().enumerate().filter(|&(k, _)| areas[k] <= 0.0) {
        if watch.stops(chains.len() - k) {
            return Err(Error::Cancelled);
        }
        let pcurve = &plane.ways[chain[0]].pcurve;
        let at = pcurve.evaluate(pcurve.parameter_at(0.437));
        let around = |&n: &usize| {
            areas[outer[n]] > -areas[k] && regions[n].side(at, &mut memory) == Side::Inside
        };
        let around: Vec<usize> = (0..outer.len()).filter(around).collect();
        let least = around.into_iter().min_by(|&m, &n| areas[outer[m]].total_cmp(&areas[outer[n]]));
        match least {
            Some(n) => parts[n].push(chain),
            None => return refused("cuts: a hole lies in no part of the face".into()),
        }
    }
    let faces: Result<Vec<TrimmedSurface>, Error> = parts
        .iter()
        .map(|chains| watch.checked().and_then(|()| plane.made(chains, &cuts)))
        .collect();
    Ok(Split { faces: faces?, unused })
}
