//! A shape together with its index, built once.

use std::sync::{Mutex, OnceLock, PoisonError};

use super::{CurveIndex, SurfaceIndex};
use crate::curve::Curve;
use crate::error::Error;
use crate::surface::Surface;

/// Asked now and then during long work: true means stop.
pub type Poll<'a> = &'a mut dyn FnMut() -> bool;

/// An index that is built on first use. Reading it takes no lock.
#[derive(Debug)]
struct Once<T> {
    value: OnceLock<T>,
    building: Mutex<()>,
}

impl<T> Once<T> {
    fn new() -> Self {
        Self { value: OnceLock::new(), building: Mutex::new(()) }
    }

    fn get_or_build(&self, build: impl FnOnce() -> Result<T, Error>) -> Result<&T, Error> {
        if let Some(value) = self.value.get() {
            return Ok(value);
        }
        let _only_one = self.building.lock().unwrap_or_else(PoisonError::into_inner);
        if self.value.get().is_none() {
            let value = build()?;
            return Ok(self.value.get_or_init(|| value));
        }
        self.value.get().ok_or(Error::OutOfMemory)
    }
}

/// A curve and its search index.
#[derive(Debug)]
pub struct IndexedCurve {
    curve: Curve,
    index: Once<CurveIndex>,
}

/// A surface and its search index.
#[derive(Debug)]
pub struct IndexedSurface {
    surface: Surface,
    index: Once<SurfaceIndex>,
}

impl IndexedCurve {
    /// Takes the curve; the index is built on first use.
    pub fn new(curve: Curve) -> Self {
        Self { curve, index: Once::new() }
    }

    /// The curve.
    pub fn curve(&self) -> &Curve {
        &self.curve
    }

    /// Bytes held: the curve, and the index once it is built.
    pub fn memory(&self) -> usize {
        let index = self.index.value.get().map_or(0, CurveIndex::memory);
        size_of::<Self>() + self.curve.heap_memory() + index
    }

    /// The index, built now if it was not there.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`]; [`Error::Cancelled`] when `poll` said so.
    pub fn index(&self, poll: Poll) -> Result<&CurveIndex, Error> {
        self.index.get_or_build(|| CurveIndex::new(&self.curve, poll))
    }

    /// Builds the index if it was not there. Errors as [`Self::index`].
    ///
    /// # Errors
    /// As [`Self::index`].
    pub fn prepare(&self, poll: Poll) -> Result<(), Error> {
        self.index(poll).map(|_| ())
    }
}

impl IndexedSurface {
    /// Takes the surface; the index is built on first use.
    pub fn new(surface: Surface) -> Self {
        Self { surface, index: Once::new() }
    }

    /// The surface.
    pub fn surface(&self) -> &Surface {
        &self.surface
    }

    /// Bytes held: the surface, and the index once it is built.
    pub fn memory(&self) -> usize {
        let index = self.index.value.get().map_or(0, SurfaceIndex::memory);
        size_of::<Self>() + self.surface.heap_memory() + index
    }

    /// The index, built now if it was not there.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`]; [`Error::Cancelled`] when `poll` said so.
    pub fn index(&self, poll: Poll) -> Result<&SurfaceIndex, Error> {
        self.index.get_or_build(|| SurfaceIndex::new(&self.surface, poll))
    }

    /// Builds the index if it was not there.
    ///
    /// # Errors
    /// As [`Self::index`].
    pub fn prepare(&self, poll: Poll) -> Result<(), Error> {
        self.index(poll).map(|_| ())
    }
}
