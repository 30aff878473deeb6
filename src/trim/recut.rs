//! Loops of a followed face cut at the seams of the new surface, and joined anew.
//!
//! ```text
//!        v1 +-------------------------+        A curve that leaves the domain over a seam goes on at the other side of it.
//!           |   --> A     A -->       |        The face lies to the left of its curves: from where one leaves, its border
//!   u0 = u1 |  (face)      (face)     |        runs along the sides of the domain, counter-clockwise, to where the next one
//!           |   <-- B     B <--       |        comes in. Here: up on u1 from A to B, and down on u0 from B to A.
//!        v0 +-------------------------+
//! ```
//!
//! What lies on a closed side gets a seam edge, used from both sides; on a collapsed side, the edge that is a point. The old face's
//! own seams, where they are none on the new surface, and its collapsed edges bound nothing and go. A loop that bounds a hole in nothing
//! says that the whole domain is around it.

use super::course::{Course, Follower};
use super::flat::{Flat, Scale, far};
use super::merge::{kind_of, part_of_edge, with_used};
use super::report::winding;
use super::{Coedge, Edge, Loop, LoopKind, Support, TrimmedSurface, invalid};
use crate::error::Error;
use crate::pcurve::{Direction, Isoline, Parameters, Pcurve};

/// Shares of a side of the domain that are one place.
const SAME: f64 = 1e-11;

/// A curve of the new loops and where it comes from.
struct Piece {
    coedge: Coedge,
    chain: usize,
    number: usize,
}

/// Whether a coedge lies on a seam of its own surface and another one lies on the other side of it, against it.
pub(super) fn is_own_seam(face: &TrimmedSurface, [chain, number]: [usize; 2]) -> bool {
    let (domain, closed) = (face.support().domain(), face.support().closed());
    let Pcurve::Isoline(line) = &face.loops()[chain].coedges[number].pcurve else { return false };
    let k = line.fixed.index();
    let ends = [domain[2 * k], domain[2 * k + 1]];
    let Some(side) = ends.iter().position(|end| *end == line.at).filter(|_| closed[k]) else {
        return false;
    };
    let near = |x: f64, y: f64| (x - y).abs() <= 1e-9 * (domain[3 - 2 * k] - domain[2 - 2 * k]);
    face.coedges().any(|(_, _, other)| match &other.pcurve {
        Pcurve::Isoline(other) => {
            other.fixed == line.fixed
                && other.at == ends[1 - side]
                && near(other.from, line.to)
                && near(other.to, line.from)
        }
        _ => false,
    })
}

/// Whether a curve lies on a collapsed side of its surface.
fn is_own_point(support: &Support, pcurve: &Pcurve) -> bool {
    let (Pcurve::Isoline(line), domain) = (pcurve, support.domain()) else { return false };
    let k = line.fixed.index();
    (0..2).any(|side| support.collapsed_edges()[2 * k + side] && line.at == domain[2 * k + side])
}

/// Edges and loops of a followed face on the new surface.
pub(super) fn recut(
    follower: &mut Follower,
    face: &TrimmedSurface,
    courses: Vec<Vec<Course>>,
    turned: bool,
) -> Result<(Vec<Edge>, Vec<Loop>), Error> {
    let mut edges = face.edges().to_vec();
    let mut pieces = Vec::new();
    for (chain, courses) in courses.into_iter().enumerate() {
        for (number, course) in courses.into_iter().enumerate() {
            let old = &face.loops()[chain].coedges[number];
            if is_own_seam(face, [chain, number]) || is_own_point(face.support(), &old.pcurve) {
                continue;
            }
            for coedge in parts(follower, face.support(), &mut edges, old, course)? {
                follower.prove(&old.pcurve, &coedge.pcurve)?;
                pieces.push(Piece { coedge, chain, number });
            }
        }
    }
    if turned {
        pieces.reverse();
        for piece in &mut pieces {
            let coedge = &mut piece.coedge;
            coedge.pcurve = coedge.pcurve.reversed();
            coedge.reversed = coedge.edge.is_some() && !coedge.reversed;
        }
    }
    let scale = Scale::of(follower.to)?;
    let tolerance = follower.tolerance;
    let mut border = Border::new(follower, &pieces);
    let mut loops = joined(&mut border, &pieces, &scale, tolerance, &mut edges)?;
    if loops.is_empty() || has_hole_in_nothing(&loops, &scale, tolerance) {
        let whole = TrimmedSurface::whole(follower.to.clone())?;
        let shift = edges.len();
        edges.extend_from_slice(whole.edges());
        let mut outer = whole.loops()[0].clone();
        for coedge in &mut outer.coedges {
            coedge.edge = coedge.edge.map(|edge| edge + shift);
        }
        loops.insert(0, outer);
    }
    Ok(with_used(edges, loops))
}

/// The coedges that become of one.
fn parts(
    follower: &mut Follower,
    support: &Support,
    edges: &mut Vec<Edge>,
    old: &Coedge,
    course: Course,
) -> Result<Vec<Coedge>, Error> {
    let pcurves = match course {
        Course::Pole { .. } => return Ok(Vec::new()),
        Course::Seam { first, last, direction } => {
            let fixed = [Direction::U, Direction::V][direction];
            let along = 1 - direction;
            let line = Pcurve::isoline(fixed, first[direction], first[along], last[along])?;
            return Ok(vec![Coedge { pcurve: line, same_parameter: false, ..*old }]);
        }
        Course::Line { parameters, points } => cut(follower, &old.pcurve, &parameters, &points)?,
    };
    if let [_] = &pcurves[..] {
        return Ok(pcurves.into_iter().map(|pcurve| Coedge { pcurve, ..*old }).collect());
    }
    let (a, b) = old.pcurve.domain();
    let mut out = Vec::new();
    for pcurve in pcurves {
        let (from, to) = pcurve.domain();
        let shares = [(from - a) / (b - a), (to - a) / (b - a)];
        let cut = match old.edge {
            Some(edge) => part_of_edge(support, &edges[edge], old, shares)?,
            None => None,
        };
        out.push(match cut {
            Some(cut) => {
                edges.push(cut);
                Coedge { pcurve, edge: Some(edges.len() - 1), ..*old }
            }
            None => Coedge::alone(pcurve),
        });
    }
    Ok(out)
}

/// An unrolled polyline cut where it crosses a seam; each part inside the domain.
fn cut(
    follower: &mut Follower,
    pcurve: &Pcurve,
    parameters: &[f64],
    points: &[Parameters],
) -> Result<Vec<Pcurve>, Error> {
    let mut all = vec![(parameters[0], points[0])];
    for (&t, &at) in parameters.iter().zip(points).skip(1) {
        let before = all[all.len() - 1];
        let mut after = (t, at);
        let mut found = Vec::new();
        let closed = follower.closed;
        for k in (0..2).filter(|&k| closed[k]) {
            let ([a, _], period) = (follower.ends(k), follower.period(k));
            let (x, y) = ((before.1[k] - a) / period, (after.1[k] - a) / period);
            let n = x.min(y).floor() + 1.0;
            if n < x.max(y) {
                let value = a + n * period;
                let place = crossing(follower, pcurve, [before, after], k, value)?;
                if place.0 < t {
                    found.push(place);
                } else {
                    after.1[k] = value;
                }
            }
        }
        found.sort_by(|p, q| p.0.total_cmp(&q.0));
        found.dedup_by(|q, p| q.0 == p.0);
        all.extend(found);
        all.push(after);
    }
    // The turn of a segment is that of its middle.
    let lap = |pair: &[(f64, Parameters)]| {
        [0, 1].map(|k| {
            let middle = 0.5 * (pair[0].1[k] + pair[1].1[k]);
            let turns = (middle - follower.ends(k)[0]) / follower.period(k);
            if follower.closed[k] { turns.floor() } else { 0.0 }
        })
    };
    let laps: Vec<[f64; 2]> = all.windows(2).map(lap).collect();
    let mut out = Vec::new();
    let mut from = 0;
    for k in 1..=laps.len() {
        if k < laps.len() && laps[k] == laps[from] {
            continue;
        }
        let inside = |p: Parameters| {
            [0, 1].map(|d| {
                let ([a, b], period) = (follower.ends(d), follower.period(d));
                let x = if laps[from][d] == 0.0 { p[d] } else { p[d] - laps[from][d] * period };
                let near = |end: f64| follower.closed[d] && (x - end).abs() <= SAME * period;
                if near(a) {
                    a
                } else if near(b) {
                    b
                } else {
                    x
                }
            })
        };
        let range = &all[from..=k];
        let parameters: Vec<f64> = range.iter().map(|place| place.0).collect();
        let points: Vec<Parameters> = range.iter().map(|place| inside(place.1)).collect();
        out.push(Pcurve::polyline_at(&parameters, &points)?);
        from = k;
    }
    Ok(out)
}

/// Where a parameter takes a value between two places of a curve.
fn crossing(
    follower: &mut Follower,
    pcurve: &Pcurve,
    [mut low, mut high]: [(f64, Parameters); 2],
    k: usize,
    value: f64,
) -> Result<(f64, Parameters), Error> {
    let rising = high.1[k] > value;
    loop {
        let t = low.0 + 0.5 * (high.0 - low.0);
        if t <= low.0 || t >= high.0 {
            high.1[k] = value;
            return Ok(high);
        }
        let near = [0, 1].map(|d| 0.5 * (low.1[d] + high.1[d]));
        let foot = follower.foot(pcurve, t)?;
        let at = follower.unrolled(&foot, near);
        if at[k] == value {
            return Ok((t, at));
        }
        if (at[k] > value) == rising { high = (t, at) } else { low = (t, at) }
    }
}

/// The sides of the domain, counter-clockwise: v0 from 0 to 1, u1 to 2, v1 to 3, u0 to 4.
struct Border<'a> {
    to: &'a Support,
    domain: [f64; 4],
    closed: [bool; 2],
    collapsed: [bool; 4],
    /// Positions of all ends of pieces.
    events: Vec<f64>,
    /// Seam edges: direction, from, to, number.
    seams: Vec<(usize, [f64; 2], usize)>,
}

impl<'a> Border<'a> {
    fn new(follower: &Follower<'a>, pieces: &[Piece]) -> Self {
        let mut made = Self {
            to: follower.to,
            domain: follower.to.domain(),
            closed: follower.closed,
            collapsed: follower.collapsed,
            events: Vec::new(),
            seams: Vec::new(),
        };
        let ends = pieces.iter().flat_map(|piece| [piece.coedge.start(), piece.coedge.end()]);
        let mut events: Vec<f64> = ends.filter_map(|at| made.position(at)).collect();
        // What happens on one side of a seam happens on the other.
        let twins: Vec<f64> = events
            .iter()
            .filter(|&&s| made.closed[usize::from((s as usize).is_multiple_of(2))])
            .map(|&s| {
                let side = (s as usize).min(3);
                ((side + 2) % 4) as f64 + (1.0 - (s - side as f64))
            })
            .collect();
        events.extend(twins);
        events.sort_by(f64::total_cmp);
        events.dedup_by(|b, a| *b - *a <= SAME);
        made.events = events;
        made
    }

    /// The position of a place on the border; none inside.
    fn position(&self, [u, v]: Parameters) -> Option<f64> {
        let [u0, u1, v0, v1] = self.domain;
        let (x, y) = ((u - u0) / (u1 - u0), (v - v0) / (v1 - v0));
        if v == v0 && u < u1 {
            Some(x)
        } else if u == u1 && v < v1 {
            Some(1.0 + y)
        } else if v == v1 && u > u0 {
            Some(2.0 + (1.0 - x))
        } else if u == u0 {
            Some(3.0 + (1.0 - y))
        } else {
            None
        }
    }

    /// The place at a position.
    fn place(&self, position: f64) -> Parameters {
        let [u0, u1, v0, v1] = self.domain;
        let side = position as usize % 4;
        let x = position - position.floor();
        let (u, v) = (u0 + x * (u1 - u0), v0 + x * (v1 - v0));
        match side {
            0 => [u, v0],
            1 => [u1, v],
            2 => [u1 - (u - u0), v1],
            _ => [u0, v1 - (v - v0)],
        }
    }

    /// The way from one position to the next, counter-clockwise.
    fn way(from: f64, to: f64) -> f64 {
        let way = to - from;
        let way = if way < 0.0 { way + 4.0 } else { way };
        if (SAME..=4.0 - SAME).contains(&way) { way } else { 0.0 }
    }

    /// The coedges along the border from one place to another.
    fn walk(
        &mut self,
        from: Parameters,
        to: Parameters,
        edges: &mut Vec<Edge>,
    ) -> Result<Vec<Coedge>, Error> {
        let (Some(start), Some(end)) = (self.position(from), self.position(to)) else {
            return invalid("face: a loop is not closed".into());
        };
        let way = Self::way(start, end);
        let corners = (0..8).map(f64::from);
        let events = self.events.iter().flat_map(|s| [*s, s + 4.0]);
        let mut stops: Vec<f64> = corners
            .chain(events)
            .filter(|s| *s > start + SAME && *s < start + way - SAME)
            .collect();
        stops.sort_by(f64::total_cmp);
        stops.dedup_by(|b, a| *b - *a <= SAME);
        let (mut at, mut position, mut out) = (from, start, Vec::new());
        if way == 0.0 {
            return Ok(out);
        }
        stops.push(start + way);
        for (k, &stop) in stops.iter().enumerate() {
            let next = if k + 1 == stops.len() { to } else { self.place(stop) };
            let side = (0.5 * (position + stop)) as usize % 4;
            // The fixed coordinate is the side's, whatever corner the place was named from.
            let fixed = [Direction::V, Direction::U][side % 2];
            let border = [2, 1, 3, 0][side];
            let along = fixed.other().index();
            let ends = [at[along], next[along]].map(|x| self.on_side(along, x));
            if ends[0] != ends[1] {
                let line = Isoline { fixed, at: self.domain[border], from: ends[0], to: ends[1] };
                out.push(self.coedge(&line, border, edges)?);
            }
            (at, position) = (next, stop);
        }
        Ok(out)
    }

    /// A coordinate along a side; at a corner exactly.
    fn on_side(&self, along: usize, x: f64) -> f64 {
        let [low, high] = [self.domain[2 * along], self.domain[2 * along + 1]];
        let near = |end: f64| (x - end).abs() <= SAME * (high - low);
        if near(low) {
            low
        } else if near(high) {
            high
        } else {
            x
        }
    }

    /// The coedge along a side, with its edge.
    fn coedge(
        &mut self,
        line: &Isoline,
        border: usize,
        edges: &mut Vec<Edge>,
    ) -> Result<Coedge, Error> {
        let pcurve = Pcurve::Isoline(*line);
        let k = border / 2;
        if self.collapsed[border] {
            edges.push(Edge::collapsed(self.to.evaluate(pcurve.start())));
            return Ok(Coedge::along(pcurve, edges.len() - 1));
        }
        if !self.closed[k] {
            let text = "face: it leaves the new surface over a border that is not closed";
            return Err(Error::Unsupported(text.into()));
        }
        let (low, high) = (line.from.min(line.to), line.from.max(line.to));
        let length = self.domain[3 - 2 * k] - self.domain[2 - 2 * k];
        let near = |x: f64, y: f64| (x - y).abs() <= 10.0 * SAME * length;
        let known = self
            .seams
            .iter()
            .position(|(d, ends, _)| *d == k && near(ends[0], low) && near(ends[1], high));
        let edge = match known {
            Some(place) => Some(self.seams.swap_remove(place).2),
            None => match self.to.isocurve(line)? {
                Some(curve) => {
                    edges.push(Edge::along(curve));
                    self.seams.push((k, [low, high], edges.len() - 1));
                    Some(edges.len() - 1)
                }
                None => None,
            },
        };
        let Some(edge) = edge else { return Ok(Coedge::alone(pcurve)) };
        let same_parameter = !self.to.angular()[1 - k];
        let reversed = line.from > line.to;
        Ok(Coedge { pcurve, edge: Some(edge), reversed, same_parameter })
    }
}

/// Head to tail, along the border where pieces end on it, to loops.
fn joined(
    border: &mut Border,
    pieces: &[Piece],
    scale: &Scale,
    tolerance: f64,
    edges: &mut Vec<Edge>,
) -> Result<Vec<Loop>, Error> {
    let apart = |p: Parameters, q: Parameters| far(scale.point(p), scale.point(q));
    let mut used = vec![false; pieces.len()];
    let mut loops = Vec::new();
    for first in 0..pieces.len() {
        if used[first] {
            continue;
        }
        let (mut coedges, mut at) = (Vec::new(), first);
        loop {
            used[at] = true;
            coedges.push(pieces[at].coedge.clone());
            let end = pieces[at].coedge.end();
            let free = |k: &usize| !used[*k] || *k == first;
            // The one that follows in the old loop where several begin here.
            let beside = |k: &usize| {
                let (a, b) = (&pieces[at], &pieces[*k]);
                a.chain != b.chain || a.number.abs_diff(b.number) > 1
            };
            let inner = (0..pieces.len())
                .filter(free)
                .map(|k| (apart(end, pieces[k].coedge.start()), k))
                .filter(|(off, _)| *off <= tolerance)
                .min_by(|a, b| beside(&a.1).cmp(&beside(&b.1)).then(a.0.total_cmp(&b.0)));
            let next = match (inner, border.position(end)) {
                (Some((_, k)), _) => k,
                (None, Some(position)) => {
                    let way = |k: usize| {
                        let start = border.position(pieces[k].coedge.start())?;
                        Some((Border::way(position, start), k))
                    };
                    let found = (0..pieces.len()).filter(free).filter_map(way);
                    let Some((_, k)) = found.min_by(|a, b| a.0.total_cmp(&b.0)) else {
                        return invalid("face: a loop ends on a border where none begins".into());
                    };
                    let start = pieces[k].coedge.start();
                    coedges.extend(border.walk(end, start, edges)?);
                    k
                }
                (None, None) => {
                    let [u, v] = end;
                    return invalid(format!("face: a loop is not closed; on it ({u}, {v}) ends"));
                }
            };
            if next == first {
                break;
            }
            at = next;
        }
        let kind = kind_of(&coedges, scale, tolerance);
        loops.push(Loop { kind, coedges });
    }
    Ok(loops)
}

/// Whether a hole lies in no outer loop.
fn has_hole_in_nothing(loops: &[Loop], scale: &Scale, tolerance: f64) -> bool {
    let polygon = |chain: &Loop| -> Vec<Parameters> {
        let flats = chain.coedges.iter().map(|c| Flat::new(&c.pcurve, scale, tolerance));
        flats.flat_map(|flat| flat.points).collect()
    };
    let polygons: Vec<Vec<Parameters>> = loops.iter().map(polygon).collect();
    loops.iter().enumerate().any(|(k, chain)| {
        let at = [0, 1].map(|d| 0.5 * (polygons[k][0][d] + polygons[k][1][d]));
        let around = (0..loops.len()).filter(|&other| other != k);
        let depth: i32 = around.map(|other| winding(&polygons[other], at)).sum();
        chain.kind == LoopKind::Inner && depth < 1
    })
}
