//! Arcs joined into branches, with points as dense as the chord tolerance asks for.
//!
//! Every inner point of a graph is the one zero of a monotone polynomial in a known interval: no step can land on
//! another branch.

use super::edges::NodeKind;
use super::level::{Arc, Level, Shape};
use super::quadric::Polynomial;
use crate::bezier::{MAX_PRODUCT, isocurve};
use crate::bounds::{HALF_ULP, Vector, cross, norm, sub};
use crate::index::{Patch, SurfaceIndex};
use crate::surface::Surface;

/// Halvings of one arc at most.
const DEEPEST: u32 = 16;

/// Where a branch ends.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// It is closed: both ends are the same point of space.
    Closed = 0,
    /// A border of the domain.
    Border = 1,
    /// A point where branches meet or the surfaces touch.
    Singular = 2,
    /// A collapsed edge where branches meet.
    Collapsed = 3,
    /// A box that was not decided.
    Undecided = 4,
}

/// A point of a branch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BranchPoint {
    /// Parameters on the surface.
    pub at: [f64; 2],
    /// The surface there.
    pub point: Vector,
}

/// A connected piece of an intersection between special points.
#[derive(Clone, Debug, PartialEq)]
pub struct Branch {
    /// Points in order; where a branch crosses a seam two with the same place and different parameters.
    pub points: Vec<BranchPoint>,
    /// What the two ends are.
    pub ends: [End; 2],
    /// Whether the surfaces touch all along it.
    pub tangential: bool,
}

impl Branch {
    /// Whether it is a loop.
    pub fn is_closed(&self) -> bool {
        self.ends[0] == End::Closed
    }
}

/// What points need.
pub struct Drawing<'a> {
    /// The shape.
    pub surface: &'a Surface,
    /// Its patches.
    pub index: &'a SurfaceIndex,
    /// The polynomial of a patch.
    pub polynomial: &'a dyn Fn(usize) -> Option<&'a Polynomial>,
    /// Most distance of a branch from its chords.
    pub chord: f64,
    /// Nodes beside what was not decided.
    pub undecided: &'a [bool],
}

/// Joins the arcs of a level into branches.
pub fn branches(level: &Level, drawing: &Drawing) -> Vec<Branch> {
    let mut around: Vec<Vec<usize>> = vec![Vec::new(); level.nodes.len()];
    for (k, arc) in level.arcs.iter().enumerate() {
        around[arc.nodes[0]].push(k);
        around[arc.nodes[1]].push(k);
    }
    let mut used = vec![false; level.arcs.len()];
    let passes = |node: usize| {
        let [a, b] = around[node][..] else { return false };
        level.nodes[node] != NodeKind::Singular
            && level.arcs[a].tangential == level.arcs[b].tangential
    };
    let mut out = Vec::new();
    // From special nodes first; what is left are loops.
    for only_ends in [true, false] {
        for start in 0..level.arcs.len() {
            if used[start] {
                continue;
            }
            let nodes = level.arcs[start].nodes;
            let special = (0..2).find(|&k| !passes(nodes[k]));
            if only_ends && special.is_none() {
                continue;
            }
            let first = nodes[special.unwrap_or(0)];
            let (mut node, mut at, mut walk) = (first, start, Vec::new());
            loop {
                used[at] = true;
                let arc = &level.arcs[at];
                let forward = arc.nodes[0] == node;
                walk.push((at, forward));
                node = arc.nodes[usize::from(forward)];
                if !passes(node) || node == first {
                    break;
                }
                let next = around[node].iter().find(|&&k| !used[k]);
                let Some(&next) = next else { break };
                at = next;
            }
            out.push(drawing.branch(level, &walk, [first, node], passes(first)));
        }
    }
    out
}

impl Drawing<'_> {
    fn branch(
        &self,
        level: &Level,
        walk: &[(usize, bool)],
        nodes: [usize; 2],
        is_loop: bool,
    ) -> Branch {
        let mut points: Vec<BranchPoint> = Vec::new();
        let mut tangential = true;
        for &(k, forward) in walk {
            let arc = &level.arcs[k];
            tangential &= arc.tangential;
            let mut part = self.points(arc);
            if !forward {
                part.reverse();
            }
            let repeats = points.last().is_some_and(|last| self.is_same(last, &part[0]));
            points.extend(part.into_iter().skip(usize::from(repeats)));
        }
        let ends = if is_loop && nodes[0] == nodes[1] {
            [End::Closed; 2]
        } else {
            [
                self.end(level, nodes[0], &points[0]),
                self.end(level, nodes[1], &points[points.len() - 1]),
            ]
        };
        Branch { points, ends, tangential }
    }

    fn is_same(&self, a: &BranchPoint, b: &BranchPoint) -> bool {
        let [u0, u1, v0, v1] = self.surface.domain();
        let width = [u1 - u0, v1 - v0];
        (0..2).all(|k| (a.at[k] - b.at[k]).abs() <= 1e-6 * width[k])
    }

    fn end(&self, level: &Level, node: usize, point: &BranchPoint) -> End {
        if self.undecided[node] {
            return End::Undecided;
        }
        match level.nodes[node] {
            NodeKind::Singular => return End::Singular,
            NodeKind::Collapsed => return End::Collapsed,
            _ => {}
        }
        let [u0, u1, v0, v1] = self.surface.domain();
        let on_border =
            point.at[0] == u0 || point.at[0] == u1 || point.at[1] == v0 || point.at[1] == v1;
        if on_border { End::Border } else { End::Singular }
    }

    /// Points of an arc, from its first end to its last.
    fn points(&self, arc: &Arc) -> Vec<BranchPoint> {
        let patch = &self.index.patches[arc.patch];
        let [a, b] = arc.ends;
        let mut out = vec![self.point(patch, a)];
        self.refine(arc, patch, [0.0, 1.0], [out[0], self.point(patch, b)], 0, &mut out);
        out.push(self.point(patch, b));
        out
    }

    fn point(&self, patch: &Patch, at: [f64; 2]) -> BranchPoint {
        let at = [patch.u.global(at[0]), patch.v.global(at[1])];
        BranchPoint { at, point: self.surface.evaluate(at[0], at[1]) }
    }

    fn refine(
        &self,
        arc: &Arc,
        patch: &Patch,
        [from, to]: [f64; 2],
        [a, b]: [BranchPoint; 2],
        depth: u32,
        out: &mut Vec<BranchPoint>,
    ) {
        let middle = 0.5 * (from + to);
        let at = |share: f64| self.point(patch, self.place(arc, share));
        let m = at(middle);
        let far = |x: &BranchPoint| away(x.point, a.point, b.point) > 0.5 * self.chord;
        let split = depth < DEEPEST
            && (far(&m) || far(&at(0.5 * (from + middle))) || far(&at(0.5 * (middle + to))));
        if split {
            self.refine(arc, patch, [from, middle], [a, m], depth + 1, out);
            out.push(m);
            self.refine(arc, patch, [middle, to], [m, b], depth + 1, out);
        }
    }

    /// The place at a share of an arc.
    fn place(&self, arc: &Arc, share: f64) -> [f64; 2] {
        let [a, b] = arc.ends;
        let straight = [0, 1].map(|k| a[k] + share * (b[k] - a[k]));
        let Shape::Graph { along, range } = arc.shape else { return straight };
        let Some(f) = (self.polynomial)(arc.patch) else { return straight };
        let across = 1 - along;
        let mut at = straight;
        let bounds = range;
        at[across] = zero_across(f, along, at[along], bounds, straight[across]);
        at
    }
}

/// Distance of a point from a chord.
fn away(x: Vector, a: Vector, b: Vector) -> f64 {
    let (chord, r) = (sub(b, a), sub(x, a));
    let length = norm(chord);
    if length < 1e-300 { norm(r) } else { norm(cross(chord, r)) / length }
}

/// The zero across, where parameter `along` is `x`: of a polynomial that is monotone in between.
fn zero_across(
    f: &Polynomial,
    along: usize,
    x: f64,
    [mut low, mut high]: [f64; 2],
    start: f64,
) -> f64 {
    let n = if along == 0 { f.degree.t } else { f.degree.s };
    let mut line = [0.0; MAX_PRODUCT];
    let line = &mut line[..=n];
    isocurve(&mut f.values.clone(), f.degree, along == 0, x, line);
    let value = |y: f64| value_and_slope(line, y);
    let rising = value(high).0 > value(low).0;
    let mut y = start.clamp(low, high);
    for _ in 0..60 {
        let (v, slope) = value(y);
        if v == 0.0 {
            return y;
        }
        if (v > 0.0) == rising {
            high = y
        } else {
            low = y
        }
        let newton = y - v / slope;
        let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
        if (next - y).abs() <= 2.0 * HALF_ULP {
            return next;
        }
        y = next;
    }
    y
}

fn value_and_slope(line: &[f64], x: f64) -> (f64, f64) {
    let n = line.len() - 1;
    let mut work = [0.0; MAX_PRODUCT];
    let work = &mut work[..=n];
    work.copy_from_slice(line);
    let mut slope = 0.0;
    for level in (0..n).rev() {
        if level == 0 {
            slope = n as f64 * (work[1] - work[0]);
        }
        for k in 0..=level {
            work[k] = (1.0 - x) * work[k] + x * work[k + 1];
        }
    }
    (work[0], slope)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bezier::Bidegree;

    #[test]
    fn the_zero_across_is_found_from_a_bad_start() {
        // s - t^2 with t along: zero at s = t^2.
        let values = vec![0.0, 0.0, -1.0, 1.0, 1.0, 0.0];
        let f = Polynomial { values, degree: Bidegree { s: 1, t: 2 }, error: 1e-16 };
        let s = zero_across(&f, 1, 0.3, [0.0, 1.0], 1.0);
        assert!((s - 0.09).abs() < 1e-15, "{s}");
    }
}
