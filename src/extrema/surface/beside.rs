//! Beside a collapsed edge: the slope across it that rounding must not hide.
//!
//! ```text
//!   X_u -> 0 towards the edge, and with it the derivative of the distance along u, but not its sign:
//!
//!        \   |   /        the lines u = const leave the point c of the edge; one step beside it X_u is as short
//!         \  |  /         as the step, and a rounding of the size of the patch would say nothing of its direction
//!          \ | /
//!            c
//! ```
//!
//! Seen from c nothing large cancels: `X_u` is a sum over the poles less c, and those of the edge itself are zero up to
//! what the edge is open. [`Surface::partials_on`] sums so, from the pole whose basis function is the greatest; its
//! error shrinks with the distance from the edge. The patches of the index do not: they have another origin, and their
//! edge was moved onto one point, which turns the lines that are as short as the move.
//!
//! Reference: `docs/rounding.md`, section 15.
//! Limit: an edge where the knots are not clamped is no row of poles; there the patches decide.
//!
//! [`Surface::partials_on`]: crate::surface::Surface::partials_on

use super::{Search, Sheet, snapped};
use crate::bounds::{extent, norm};
use crate::extrema::nature::{Along, end_of};
use crate::index::{Patch, position_steps, side};
use crate::jet::Jet2;
use crate::knots::{Knots, Side};

/// A place is beside an edge up to this share of the poles beyond it. Farther away rounding of the size of the patch is
/// less than a slope that counts; and up to one half the greatest basis function is that of a pole of the edge.
const BESIDE: f64 = 0.01;

/// Iterations that give a zero its last digits there; halved steps count too.
const BESIDE_STEPS: usize = 16;

impl Search<'_> {
    /// For each parameter: the slope along it, when a collapsed edge along it is beside the place. `at` in the caller's
    /// parameters, `local` the same in the piece.
    pub(super) fn slopes_beside(
        &self,
        piece: usize,
        at: [f64; 2],
        local: [f64; 2],
    ) -> [Option<Along>; 2] {
        let patch = &self.index.patches[piece];
        let away = [0, 1].map(|k| self.away(patch, at, local, k));
        if away == [None; 2] {
            return [None; 2];
        }
        let jet = self.jet_beside(patch, at, local);
        let degree = self.index.degree;
        let steps = position_steps(degree.s + degree.t) * self.weight_ratio().powi(2);
        [0, 1].map(|k| {
            let span = if k == 0 { patch.u } else { patch.v };
            let p = if k == 0 { degree.s } else { degree.t } as f64;
            let speed = norm(if k == 0 { jet.s } else { jet.t });
            let tangent = 4.0 * p * away[k]? / (span.ends[1] - span.ends[0]) * steps;
            let share = self.index.frame.scale / speed;
            let along =
                Along { slope: jet.gradient()[k] * share, noise: norm(jet.d) * tangent * share };
            (speed > 0.0).then_some(along)
        })
    }

    /// How far the local net is from the point of the edge, as it counts at a place: greatest distance of a pole times the
    /// share of the poles beyond the edge, and what the edge is open. `None` when no edge along parameter `k` is near.
    fn away(&self, patch: &Patch, at: [f64; 2], local: [f64; 2], k: usize) -> Option<f64> {
        let surface = self.shape.surface();
        let o = 1 - k;
        let (knots, span, degree) = match o {
            0 => (surface.knots_u(), patch.u, self.index.degree.s),
            _ => (surface.knots_v(), patch.v, self.index.degree.t),
        };
        let ends = if o == 0 { [side::S0, side::S1] } else { [side::T0, side::T1] };
        let x = placed(span.ends, at[o], local[o]);
        (0..2).find_map(|e| {
            let share = (x - span.ends[e]).abs() / (span.ends[1] - span.ends[0]) * degree as f64;
            let is_beside = patch.collapsed[ends[e]] && share < BESIDE;
            let size = 2.0 * patch.radius * share + patch.spread;
            (is_beside && is_clamped(knots, span.ends[e])).then_some(size / self.index.frame.scale)
        })
    }

    /// The caller's shape at a place of a piece, in the caller's parameters.
    fn jet_beside(&self, patch: &Patch, at: [f64; 2], local: [f64; 2]) -> Jet2 {
        let surface = self.shape.surface();
        let [u, v] = [placed(patch.u.ends, at[0], local[0]), placed(patch.v.ends, at[1], local[1])];
        let sides = local.map(|x| if x == 1.0 { Side::Below } else { Side::Above });
        let mut out = [[0.0; 3]; 6];
        surface.partials_on([u, v], sides, 2, &mut out);
        let [_, s, t, ss, st, tt] = out;
        let d = surface.vector_from(self.query, u, v);
        Jet2 { d, s, t, ss, st, tt, w: [1.0, 0.0, 0.0] }
    }

    fn weight_ratio(&self) -> f64 {
        let weights = self.shape.surface().weights().unwrap_or(&[1.0]);
        let (low, high) = extent(weights);
        high / low
    }

    /// Newton on the caller's shape from a zero of a patch, in local parameters; `None` when no collapsed edge is beside it.
    /// A step that does not make the gradient less is halved, and none comes nearer to the edge than half the way: there
    /// are other zeros, of how the edge is open. A zero that was proven to be inside the piece does not leave it.
    pub(super) fn polish_beside(&self, sheet: &Sheet, local: [f64; 2]) -> Option<[f64; 2]> {
        let patch = &self.index.patches[sheet.piece];
        let start = self.global(sheet, local);
        let away = [0, 1].map(|k| self.away(patch, start, local, k));
        if away == [None; 2] {
            return None;
        }
        let ends = [patch.u.ends, patch.v.ends];
        let range = [0, 1].map(|k| {
            let [low, high] = half_way(ends[k], start[k], away[1 - k].is_some());
            [low.max(self.range[2 * k]), high.min(self.range[2 * k + 1])]
        });
        let jet_at = |at: [f64; 2]| {
            let inner = [0, 1].map(|k| if at[k] == ends[k][1] { 1.0 } else { 0.5 });
            self.jet_beside(patch, at, inner)
        };
        let (mut at, mut jet, mut share) = (start, jet_at(start), 1.0);
        for _ in 0..BESIDE_STEPS {
            let step = newton_step(&jet);
            let next = [0, 1].map(|k| (at[k] + share * step[k]).clamp(range[k][0], range[k][1]));
            if next == at || next.iter().any(|x| x.is_nan()) {
                break;
            }
            let there = jet_at(next);
            if steepness(&there) < steepness(&jet) {
                (at, jet, share) = (next, there, 1.0);
            } else {
                share *= 0.5;
            }
        }
        let found = [patch.u.local(at[0]), patch.v.local(at[1])].map(snapped);
        let leaves = (0..2).any(|k| end_of(found[k]) != 0.0 && end_of(local[k]) == 0.0);
        Some(if at == start || leaves { local } else { found })
    }
}

/// The ends of a piece, the nearer one moved half the way to `x` when a collapsed edge is there.
fn half_way([low, high]: [f64; 2], x: f64, is_collapsed: bool) -> [f64; 2] {
    if !is_collapsed {
        [low, high]
    } else if x - low < high - x {
        [0.5 * (low + x), high]
    } else {
        [low, 0.5 * (x + high)]
    }
}

/// Length of the greater part of the gradient along one of the two parameters.
fn steepness(jet: &Jet2) -> f64 {
    let [g, h] = jet.gradient();
    (g / norm(jet.s)).abs().max((h / norm(jet.t)).abs())
}

fn newton_step(jet: &Jet2) -> [f64; 2] {
    let ([a, b, c], [g, h]) = (jet.hessian(), jet.gradient());
    let det = a * c - b * b;
    [(b * h - c * g) / det, (b * g - a * h) / det]
}

/// A parameter on the end of its piece that the local one tells, also where a seam is seen from the other side.
fn placed(ends: [f64; 2], x: f64, local: f64) -> f64 {
    if local == 0.0 {
        ends[0]
    } else if local == 1.0 {
        ends[1]
    } else {
        x
    }
}

/// Whether the border of the domain there is a row of poles.
fn is_clamped(knots: &Knots, end: f64) -> bool {
    knots.multiplicity(end) > knots.degree()
}
