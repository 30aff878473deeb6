//! Feet of a polyline of points, joined to a path.

use super::ground::Ground;
use super::trail::{Stand, Trail};
use crate::bounds::{Vector, norm, sub};
use crate::closest::{FootPoint, QueryOptions, Scope, Workspace, rounding_floor};
use crate::curve::Curve;
use crate::error::Error;
use crate::index::{CurveIndex, IndexedCurve, IndexedSurface, SurfaceIndex};
use crate::jet::{Jet1, Jet2};
use crate::knots::{Knots, Side};
use crate::refine::{CurveJets, SurfaceJets, foot_on_curve, foot_on_surface};
use crate::surface::Surface;

/// Points between two questions whether to stop.
const POLLED: usize = 64;

/// What a joined path is written to besides its feet; both of the feet's length, or absent.
#[derive(Debug, Default)]
pub struct PathOutput<'a, const N: usize> {
    /// Parameters that go on past seams; NaN where there is no foot.
    pub unwrapped: Option<&'a mut [[f64; N]]>,
    /// Bits of [`super::change`].
    pub changes: Option<&'a mut [u32]>,
}

/// Asked now and then: true means stop.
pub type Poll<'a> = &'a mut dyn FnMut() -> bool;

impl IndexedCurve {
    /// Joins the feet of consecutive queries to a path: where another foot is as near, or the parameter is free, the one
    /// that continues the path is taken. `feet` are global or local answers, asked one by one with these `options`.
    ///
    /// A query without a foot is stepped over.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`] for the index; [`Error::Cancelled`], then the feet not reached are as they were.
    pub fn join(
        &self,
        queries: &dyn Fn(usize) -> Vector,
        feet: &mut [FootPoint],
        options: &QueryOptions,
        output: PathOutput<1>,
        poll: Poll,
    ) -> Result<(), Error> {
        let index = self.index(&mut || false)?;
        let local = QueryOptions { scope: Scope::Local, ..*options };
        let workspace = Workspace::default();
        join(&mut CurveGround { curve: self, index, local, workspace }, queries, feet, output, poll)
    }
}

impl IndexedSurface {
    /// As [`IndexedCurve::join`]; on a collapsed edge the parameter along it stays what it was.
    ///
    /// # Errors
    /// As [`IndexedCurve::join`].
    pub fn join(
        &self,
        queries: &dyn Fn(usize) -> Vector,
        feet: &mut [FootPoint],
        options: &QueryOptions,
        output: PathOutput<2>,
        poll: Poll,
    ) -> Result<(), Error> {
        let index = self.index(&mut || false)?;
        let [u0, u1, v0, v1] = self.surface().domain();
        let corners = [[u0, v0], [u1, v0], [u0, v0], [u0, v1]];
        let tip = |edge: usize| {
            let [u, v] = corners[edge];
            index.collapsed[edge].then(|| self.surface().evaluate(u, v))
        };
        let mut ground = SurfaceGround {
            surface: self,
            index,
            tips: [0, 1, 2, 3].map(tip),
            local: QueryOptions { scope: Scope::Local, ..*options },
            workspace: Workspace::default(),
        };
        join(&mut ground, queries, feet, output, poll)
    }
}

fn join<G: Ground, const N: usize>(
    ground: &mut G,
    queries: &dyn Fn(usize) -> Vector,
    feet: &mut [FootPoint],
    mut output: PathOutput<N>,
    poll: Poll,
) -> Result<(), Error> {
    let mut trail = Trail { ground };
    let mut before: Option<Stand> = None;
    for (i, foot) in feet.iter_mut().enumerate() {
        if i % POLLED == 0 && poll() {
            return Err(Error::Cancelled);
        }
        let (mut unwrapped, mut marks) = ([f64::NAN; 2], 0);
        if foot.distance.is_finite() {
            let (stand, found) = match &before {
                None => trail.begin(queries(i), *foot),
                Some(before) => trail.advance(before, queries(i), *foot),
            };
            (*foot, unwrapped, marks) = (stand.foot, stand.unwrapped, found);
            before = Some(stand);
        }
        if let Some(out) = &mut output.unwrapped {
            out[i] = std::array::from_fn(|k| unwrapped[k]);
        }
        if let Some(out) = &mut output.changes {
            out[i] = marks;
        }
    }
    Ok(())
}

fn allowed(options: &QueryOptions, frame: &crate::index::Frame, query: Vector) -> f64 {
    let accuracy = if options.accuracy > 0.0 { options.accuracy } else { 1e-10 * frame.diagonal };
    accuracy.max(rounding_floor(frame, query, 0.0))
}

struct CurveGround<'a> {
    curve: &'a IndexedCurve,
    index: &'a CurveIndex,
    local: QueryOptions,
    workspace: Workspace,
}

impl Ground for CurveGround<'_> {
    fn ends(&self) -> [[f64; 2]; 2] {
        [self.curve.curve().domain().into(), [0.0, 1.0]]
    }

    fn closed(&self) -> [bool; 2] {
        [self.index.closed, false]
    }

    fn tips(&self) -> [Option<Vector>; 4] {
        [None; 4]
    }

    fn diagonal(&self) -> f64 {
        self.index.frame.diagonal
    }

    fn frame(&self, at: [f64; 2]) -> [Vector; 2] {
        let mut jet = [[0.0; 3]; 2];
        self.curve.curve().derivatives(at[0], 1, &mut jet);
        [jet[1], [0.0; 3]]
    }

    fn point(&self, at: [f64; 2]) -> Vector {
        self.curve.curve().evaluate(at[0])
    }

    fn local(&mut self, query: Vector, start: [f64; 2]) -> FootPoint {
        self.curve.closest(query, Some(start[0]), &self.local, &mut self.workspace, None)
    }

    fn local_in(&self, query: Vector, start: [f64; 2], cell: [f64; 4]) -> ([f64; 2], f64) {
        let cell = cut(cell, self.local.domain);
        let sided = SidedCurve { curve: self.curve.curve(), query, high: cell[1] };
        let (u, jet, _) =
            foot_on_curve(&sided, start[0], [cell[0], cell[1]], self.local.method, None);
        ([u, 0.0], norm(jet.d))
    }

    fn is_restricted(&self) -> bool {
        self.local.domain.is_some()
    }

    fn knots(&self, k: usize) -> Option<&Knots> {
        (k == 0).then(|| self.curve.curve().knots())
    }

    fn allowed(&self, query: Vector) -> f64 {
        allowed(&self.local, &self.index.frame, query)
    }
}

/// A curve whose upper end of a cell belongs to the cell.
struct SidedCurve<'a> {
    curve: &'a Curve,
    query: Vector,
    high: f64,
}

impl CurveJets for SidedCurve<'_> {
    fn jet(&self, s: f64) -> Jet1 {
        let mut out = [[0.0; 3]; 3];
        self.curve.derivatives_on(s, side_at(s, self.high), 2, &mut out);
        Jet1 { d: sub(out[0], self.query), s: out[1], ss: out[2], w: [1.0, 0.0] }
    }

    fn global(&self, s: f64) -> [f64; 2] {
        [s, 0.0]
    }
}

/// A surface whose upper sides of a cell belong to the cell.
struct SidedSurface<'a> {
    surface: &'a Surface,
    query: Vector,
    high: [f64; 2],
}

impl SurfaceJets for SidedSurface<'_> {
    fn jet(&self, s: f64, t: f64) -> Jet2 {
        let mut out = [[0.0; 3]; 6];
        let sides = [side_at(s, self.high[0]), side_at(t, self.high[1])];
        self.surface.partials_on([s, t], sides, 2, &mut out);
        let [point, s, t, ss, st, tt] = out;
        Jet2 { d: sub(point, self.query), s, t, ss, st, tt, w: [1.0, 0.0, 0.0] }
    }

    fn global(&self, s: f64, t: f64) -> [f64; 2] {
        [s, t]
    }
}

fn side_at(x: f64, high: f64) -> Side {
    if x >= high { Side::Below } else { Side::Above }
}

/// The part of a cell that a restriction leaves; where it leaves nothing, a point of the restriction.
fn cut(cell: [f64; 4], domain: Option<[f64; 4]>) -> [f64; 4] {
    let Some(d) = domain else { return cell };
    [0, 1, 2, 3].map(|i| {
        let [low, high] = [d[i / 2 * 2], d[i / 2 * 2 + 1]];
        // Curves have no second interval.
        if low < high { cell[i].clamp(low, high) } else { cell[i] }
    })
}

struct SurfaceGround<'a> {
    surface: &'a IndexedSurface,
    index: &'a SurfaceIndex,
    tips: [Option<Vector>; 4],
    local: QueryOptions,
    workspace: Workspace,
}

impl Ground for SurfaceGround<'_> {
    fn ends(&self) -> [[f64; 2]; 2] {
        let [u0, u1, v0, v1] = self.surface.surface().domain();
        [[u0, u1], [v0, v1]]
    }

    fn closed(&self) -> [bool; 2] {
        self.index.closed
    }

    fn tips(&self) -> [Option<Vector>; 4] {
        self.tips
    }

    fn diagonal(&self) -> f64 {
        self.index.frame.diagonal
    }

    fn frame(&self, at: [f64; 2]) -> [Vector; 2] {
        let mut jet = [[0.0; 3]; 3];
        self.surface.surface().partials(at[0], at[1], 1, &mut jet);
        [jet[1], jet[2]]
    }

    fn point(&self, at: [f64; 2]) -> Vector {
        self.surface.surface().evaluate(at[0], at[1])
    }

    fn local(&mut self, query: Vector, start: [f64; 2]) -> FootPoint {
        self.surface.closest(query, Some(start), &self.local, &mut self.workspace, None)
    }

    fn local_in(&self, query: Vector, start: [f64; 2], cell: [f64; 4]) -> ([f64; 2], f64) {
        let cell = cut(cell, self.local.domain);
        let surface = self.surface.surface();
        let sided = SidedSurface { surface, query, high: [cell[1], cell[3]] };
        let (at, jet, _) = foot_on_surface(&sided, start, cell, self.local.method, None);
        (at, norm(jet.d))
    }

    fn is_restricted(&self) -> bool {
        self.local.domain.is_some()
    }

    fn knots(&self, k: usize) -> Option<&Knots> {
        let surface = self.surface.surface();
        Some([surface.knots_u(), surface.knots_v()][k])
    }

    fn allowed(&self, query: Vector) -> f64 {
        allowed(&self.local, &self.index.frame, query)
    }
}
