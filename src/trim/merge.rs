//! Two faces that share a border of their domains made one face.
//!
//! ```text
//!   v1 +---------+---------+        the first face's domain ends in u (or v) where the second one's begins
//!      |  first  >  second |        coedges on the border run up in the first, down in the second: what both have is taken out
//!   v0 +---------+---------+        what is left is joined to loops again, and counted as outer or inner by its area
//!     u0         c         u1
//! ```
//!
//! Surfaces whose parameters do not fit are changed first ([`TrimmedSurface::changed`] with a linear transform).

use super::compare::compare_part;
use super::flat::{Flat, Scale, far};
use super::{ChangeOptions, Coedge, DEFAULT_TOLERANCE, Edge, EdgeCurve, Loop, LoopKind};
use super::{Support, TrimmedSurface, invalid};
use crate::closest::{QueryOptions, Workspace};
use crate::elementary::part;
use crate::error::Error;
use crate::index::IndexedCurve;
use crate::pcurve::{Direction, Isoline, Parameters, Pcurve};
use std::sync::Arc;

impl TrimmedSurface {
    /// This face and `other` on `support`, whose domain is the union of theirs and whose points are theirs. The domains follow each
    /// other in `direction` and agree in the other one, bit for bit. Edges that end up inside are dropped; what is left of a coedge keeps
    /// that part of its edge. Of the options the tolerance counts.
    ///
    /// # Errors
    /// Domains that do not follow each other; faces with opposite normals; a surface that differs by more than the tolerance, with the
    /// place; loops that do not close.
    pub fn merged(
        &self,
        other: &Self,
        direction: Direction,
        support: Support,
        options: &ChangeOptions,
    ) -> Result<Self, Error> {
        let border = check_domains(self, other, direction, &support)?;
        if self.is_flipped() != other.is_flipped() {
            return invalid("other: its normal is opposite".into());
        }
        let tolerance = match options.tolerance {
            0.0 => DEFAULT_TOLERANCE * support.bounding_box()?.diagonal(),
            t if t > 0.0 && t.is_finite() => t,
            t => return invalid(format!("tolerance: {t} is not a positive length")),
        };
        for (name, face) in [("face", self), ("other", other)] {
            compare_part(name, face.support(), &support, tolerance)?;
        }
        let mut edges = self.edges().to_vec();
        edges.extend_from_slice(other.edges());
        let shift = self.edges().len();
        let chains = |face: &Self, shift: usize| -> Vec<Vec<Coedge>> {
            let moved = |coedge: &Coedge| Coedge {
                edge: coedge.edge.map(|edge| edge + shift),
                ..coedge.clone()
            };
            face.loops().iter().map(|chain| chain.coedges.iter().map(moved).collect()).collect()
        };
        let all: Vec<Vec<Coedge>> =
            chains(self, 0).into_iter().chain(chains(other, shift)).collect();
        let kept = without_common(&support, all, &mut edges, direction, border)?;
        let scale = Scale::of(&support)?;
        let loops = joined(kept, &scale, tolerance)?;
        let (edges, loops) = with_used(edges, loops);
        Self::new(support, edges, loops, self.is_flipped())
    }
}

/// The edges that loops use, and the loops with their numbers.
pub(super) fn with_used(edges: Vec<Edge>, mut loops: Vec<Loop>) -> (Vec<Edge>, Vec<Loop>) {
    let mut number = vec![None; edges.len()];
    let mut left = Vec::new();
    for coedge in loops.iter_mut().flat_map(|chain| &mut chain.coedges) {
        if let Some(edge) = coedge.edge {
            let new = *number[edge].get_or_insert_with(|| {
                left.push(edges[edge].clone());
                left.len() - 1
            });
            coedge.edge = Some(new);
        }
    }
    (left, loops)
}

/// What a closed chain of coedges bounds, by the sign of its area.
pub(super) fn kind_of(coedges: &[Coedge], scale: &Scale, tolerance: f64) -> LoopKind {
    let origin = scale.point(coedges[0].start());
    let mut twice = 0.0;
    for coedge in coedges {
        let flat = Flat::new(&coedge.pcurve, scale, tolerance);
        for pair in flat.points.windows(2) {
            let [p, q] = [pair[0], pair[1]].map(|p| [p[0] - origin[0], p[1] - origin[1]]);
            twice += p[0] * q[1] - p[1] * q[0];
        }
    }
    if twice > 0.0 { LoopKind::Outer } else { LoopKind::Inner }
}

/// The common border, when the domains follow each other.
fn check_domains(
    first: &TrimmedSurface,
    second: &TrimmedSurface,
    direction: Direction,
    support: &Support,
) -> Result<f64, Error> {
    let (a, b, c) = (first.support().domain(), second.support().domain(), support.domain());
    let (own, across) = (2 * direction.index(), 2 * direction.other().index());
    if a[own + 1] != b[own] {
        return invalid(format!(
            "other: its domain begins at {}, the face's ends at {}",
            b[own],
            a[own + 1]
        ));
    }
    if a[across..across + 2] != b[across..across + 2] {
        return invalid("other: its domain differs across the common border".into());
    }
    let mut union = a;
    union[own + 1] = b[own + 1];
    if union != c {
        return invalid(format!("support: its domain is {c:?}, not {union:?}"));
    }
    Ok(b[own])
}

/// A piece of the common border: from, to.
type Span = [f64; 2];

/// The part of a line on the border, when a coedge is one.
fn on_border(coedge: &Coedge, direction: Direction, border: f64) -> Option<Isoline> {
    match coedge.pcurve {
        Pcurve::Isoline(line) if line.fixed == direction && line.at == border => Some(line),
        _ => None,
    }
}

/// The part of an edge that belongs to the part of a coedge between two shares; none when it is a point of a curve.
pub(super) fn part_of_edge(
    support: &Support,
    edge: &Edge,
    coedge: &Coedge,
    shares: [f64; 2],
) -> Result<Option<Edge>, Error> {
    let parameter = |share: f64| {
        let along = if coedge.reversed { 1.0 - share } else { share };
        if coedge.same_parameter || along == 0.0 || along == 1.0 {
            return edge.parameter_at(along);
        }
        let place = coedge.pcurve.evaluate(coedge.pcurve.parameter_at(share));
        let (query, options) = (support.evaluate(place), QueryOptions::default());
        match &edge.curve {
            EdgeCurve::Spline(curve) => {
                curve.closest(query, None, &options, &mut Workspace::default(), None).u
            }
            EdgeCurve::Callback(curve) => curve.closest(query, None, &options, None).u,
            EdgeCurve::Point(_) => 0.0,
        }
    };
    let [a, b] = shares.map(parameter);
    let ends = [a.min(b), a.max(b)];
    let curve = match &edge.curve {
        EdgeCurve::Point(point) => EdgeCurve::Point(*point),
        // Also where a function fails.
        _ if ends[0].is_nan() || ends[0] >= ends[1] => return Ok(None),
        EdgeCurve::Spline(curve) => {
            EdgeCurve::Spline(Arc::new(IndexedCurve::new(part(curve.curve(), ends)?)))
        }
        EdgeCurve::Callback(curve) => EdgeCurve::Callback(Arc::new(curve.part(ends)?)),
    };
    Ok(Some(Edge { curve, reversed: edge.reversed }))
}

/// The coedges of all loops without what runs both ways on the border.
fn without_common(
    support: &Support,
    chains: Vec<Vec<Coedge>>,
    edges: &mut Vec<Edge>,
    direction: Direction,
    border: f64,
) -> Result<Vec<Coedge>, Error> {
    let lines: Vec<Isoline> =
        chains.iter().flatten().filter_map(|c| on_border(c, direction, border)).collect();
    let mut kept = Vec::new();
    for coedge in chains.into_iter().flatten() {
        let Some(line) = on_border(&coedge, direction, border) else {
            kept.push(coedge);
            continue;
        };
        let rising = line.from < line.to;
        let against = lines.iter().filter(|other| (other.from < other.to) != rising);
        let spans: Vec<Span> = against.map(|o| [o.from.min(o.to), o.from.max(o.to)]).collect();
        let own = [line.from.min(line.to), line.from.max(line.to)];
        let left = difference(own, spans);
        if left == [own] {
            kept.push(coedge);
            continue;
        }
        for [a, b] in left {
            let (from, to) = if rising { (a, b) } else { (b, a) };
            let pcurve = Pcurve::isoline(direction, border, from, to)?;
            let share = |x: f64| (x - line.from) / (line.to - line.from);
            let shares = [share(from), share(to)];
            let cut = match coedge.edge {
                Some(edge) => part_of_edge(support, &edges[edge], &coedge, shares)?,
                None => None,
            };
            kept.push(match cut {
                Some(cut) => {
                    edges.push(cut);
                    Coedge { pcurve, edge: Some(edges.len() - 1), ..coedge.clone() }
                }
                None => Coedge::alone(pcurve),
            });
        }
    }
    Ok(kept)
}

/// An interval without others.
fn difference(own: Span, mut spans: Vec<Span>) -> Vec<Span> {
    spans.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let (mut left, mut from) = (Vec::new(), own[0]);
    for [a, b] in spans {
        if a > from && from < own[1] {
            left.push([from, a.min(own[1])]);
        }
        from = from.max(b);
    }
    if from < own[1] {
        left.push([from, own[1]]);
    }
    left
}

/// The coedges head to tail, as loops.
fn joined(mut left: Vec<Coedge>, scale: &Scale, tolerance: f64) -> Result<Vec<Loop>, Error> {
    let far_apart = |p: Parameters, q: Parameters| far(scale.point(p), scale.point(q));
    let mut loops = Vec::new();
    left.reverse();
    while let Some(first) = left.pop() {
        let start = first.start();
        let mut coedges = vec![first];
        loop {
            let end = coedges[coedges.len() - 1].end();
            let back = far_apart(end, start);
            // The next of the list is the one that followed before, and is last in it.
            let next = (0..left.len())
                .rev()
                .map(|k| (far_apart(end, left[k].start()), k))
                .filter(|(off, _)| *off <= tolerance && *off < back)
                .min_by(|a, b| a.0.total_cmp(&b.0).then(b.1.cmp(&a.1)));
            match next {
                Some((_, k)) => coedges.push(left.remove(k)),
                None if back <= tolerance => break,
                None => {
                    return invalid(format!(
                        "other: no coedge continues at ({}, {})",
                        end[0], end[1]
                    ));
                }
            }
        }
        let kind = kind_of(&coedges, scale, tolerance);
        loops.push(Loop { kind, coedges });
    }
    Ok(loops)
}
