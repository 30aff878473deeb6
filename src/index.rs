//! Stub of the agreed interface.
#![allow(missing_docs)]
use crate::curve::Curve;
use crate::error::Error;
use crate::surface::Surface;

#[derive(Debug)]
pub struct IndexedCurve(Curve);
#[derive(Debug)]
pub struct IndexedSurface(Surface);

impl IndexedCurve {
    pub fn new(curve: Curve) -> Self {
        Self(curve)
    }
    pub fn curve(&self) -> &Curve {
        &self.0
    }
    pub fn prepare(&self, poll: &mut dyn FnMut() -> bool) -> Result<(), Error> {
        if poll() { Err(Error::Cancelled) } else { Ok(()) }
    }
}

impl IndexedSurface {
    pub fn new(surface: Surface) -> Self {
        Self(surface)
    }
    pub fn surface(&self) -> &Surface {
        &self.0
    }
    pub fn prepare(&self, poll: &mut dyn FnMut() -> bool) -> Result<(), Error> {
        if poll() { Err(Error::Cancelled) } else { Ok(()) }
    }
}
