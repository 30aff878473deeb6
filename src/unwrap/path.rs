//! Feet of a polyline of points, joined to a path.

use super::trail::{Ground, Stand, Trail};
use crate::bounds::Vector;
use crate::closest::{FootPoint, QueryOptions, Scope, Workspace, rounding_floor};
use crate::error::Error;
use crate::index::{CurveIndex, IndexedCurve, IndexedSurface, SurfaceIndex};

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

    fn allowed(&self, query: Vector) -> f64 {
        allowed(&self.local, &self.index.frame, query)
    }
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

    fn allowed(&self, query: Vector) -> f64 {
        allowed(&self.local, &self.index.frame, query)
    }
}
