//! Stub of the agreed interface.
#![allow(missing_docs)]
use crate::error::Error;
use crate::index::{IndexedCurve, IndexedSurface};
use crate::refine::Method;

pub mod flag {
    pub const NOT_PROVEN: u32 = 1;
    pub const EDGE: u32 = 2;
    pub const CORNER: u32 = 4;
    pub const SEAM: u32 = 8;
    pub const COLLAPSED: u32 = 16;
    pub const TIE: u32 = 32;
    pub const CONTINUUM: u32 = 64;
    pub const NOT_ON_SHAPE: u32 = 128;
    pub const BAD_QUERY: u32 = 256;
    pub const HINT_USED: u32 = 512;
    pub const BUDGET: u32 = 1024;
    pub const CREASE: u32 = 2048;
}

#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FootPoint {
    pub u: f64,
    pub v: f64,
    pub point: [f64; 3],
    pub distance: f64,
    pub lower_bound: f64,
    pub flags: u32,
    pub iterations: u32,
}

impl FootPoint {
    pub fn unreached() -> Self {
        let nan = f64::NAN;
        Self {
            u: nan,
            v: nan,
            point: [nan; 3],
            distance: nan,
            lower_bound: 0.0,
            flags: flag::NOT_PROVEN,
            iterations: 0,
        }
    }
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Scope {
    #[default]
    Global,
    Local,
}

#[derive(Clone, Copy, Debug, Default)]
pub struct QueryOptions {
    pub tolerance: f64,
    pub accuracy: f64,
    pub method: Method,
    pub scope: Scope,
    pub domain: Option<[f64; 4]>,
    pub budget: u64,
}

#[derive(Debug, Default)]
pub struct Workspace;
pub type Trace<'a> = &'a mut dyn FnMut(u32, f64, f64, f64);

fn answer(query: [f64; 3], u: f64, v: f64, trace: Option<Trace<'_>>) -> FootPoint {
    if let Some(trace) = trace {
        trace(0, u, v, 1.0);
    }
    let mut foot = FootPoint::unreached();
    (foot.u, foot.v, foot.point, foot.distance, foot.flags) = (u, v, query, 0.0, 0);
    foot
}

impl IndexedCurve {
    pub fn check_domain(&self, d: [f64; 4]) -> Result<(), Error> {
        let (a, b) = self.curve().domain();
        if a <= d[0] && d[0] < d[1] && d[1] <= b {
            return Ok(());
        }
        Err(Error::InvalidArgument("domain: not inside the curve's".into()))
    }
    pub fn closest(
        &self,
        query: [f64; 3],
        hint: Option<f64>,
        _: &QueryOptions,
        _: &mut Workspace,
        trace: Option<Trace<'_>>,
    ) -> FootPoint {
        answer(query, hint.unwrap_or(self.curve().domain().0), 0.0, trace)
    }
    pub fn invert(
        &self,
        query: [f64; 3],
        hint: Option<f64>,
        options: &QueryOptions,
        workspace: &mut Workspace,
        trace: Option<Trace<'_>>,
    ) -> FootPoint {
        self.closest(query, hint, options, workspace, trace)
    }
}

impl IndexedSurface {
    pub fn check_domain(&self, d: [f64; 4]) -> Result<(), Error> {
        let all = self.surface().domain();
        let inside = |i: usize| all[i] <= d[i] && d[i] < d[i + 1] && d[i + 1] <= all[i + 1];
        if inside(0) && inside(2) {
            return Ok(());
        }
        Err(Error::InvalidArgument("domain: not inside the surface's".into()))
    }
    pub fn closest(
        &self,
        query: [f64; 3],
        hint: Option<[f64; 2]>,
        _: &QueryOptions,
        _: &mut Workspace,
        trace: Option<Trace<'_>>,
    ) -> FootPoint {
        let all = self.surface().domain();
        let [u, v] = hint.unwrap_or([all[0], all[2]]);
        answer(query, u, v, trace)
    }
    pub fn invert(
        &self,
        query: [f64; 3],
        hint: Option<[f64; 2]>,
        options: &QueryOptions,
        workspace: &mut Workspace,
        trace: Option<Trace<'_>>,
    ) -> FootPoint {
        self.closest(query, hint, options, workspace, trace)
    }
}
