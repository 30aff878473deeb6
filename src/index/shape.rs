//! A shape together with its index, built once.

use std::sync::{Arc, Mutex, OnceLock, PoisonError};
use std::thread::ThreadId;

use super::patches::HUGE;
use super::{CurveIndex, SurfaceIndex};
use crate::curve::Curve;
use crate::error::Error;
use crate::simd::Level;
use crate::surface::Surface;

/// Asked now and then during long work: true means stop.
pub type Poll<'a> = &'a mut dyn FnMut() -> bool;

/// An index that is built on first use. Reading it takes no lock.
#[derive(Debug)]
struct Once<T> {
    value: OnceLock<Box<T>>,
    building: Mutex<()>,
    /// Who holds `building`: what is polled during the work may ask for the index too.
    builder: Mutex<Option<ThreadId>>,
}

impl<T> Once<T> {
    fn new() -> Self {
        Self { value: OnceLock::new(), building: Mutex::new(()), builder: Mutex::new(None) }
    }

    fn get(&self) -> Option<&T> {
        self.value.get().map(|value| &**value)
    }

    fn get_or_build(&self, build: impl FnOnce() -> Result<T, Error>) -> Result<&T, Error> {
        if let Some(value) = self.get() {
            return Ok(value);
        }
        let me = Some(std::thread::current().id());
        let builder = || self.builder.lock().unwrap_or_else(PoisonError::into_inner);
        if *builder() == me {
            // Asked from inside of its own building: waiting would never end, so it is built here as well.
            let value = Box::new(build()?);
            return Ok(self.value.get_or_init(|| value));
        }
        let _only_one = self.building.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(value) = self.get() {
            return Ok(value);
        }
        *builder() = me;
        let _end = OnDrop(|| *builder() = None);
        let value = Box::new(build()?);
        Ok(self.value.get_or_init(|| value))
    }
}

/// Does something at the end of its scope, however that ends.
struct OnDrop<F: FnMut()>(F);

impl<F: FnMut()> Drop for OnDrop<F> {
    fn drop(&mut self) {
        (self.0)();
    }
}

/// A curve and its search index.
#[derive(Debug)]
pub struct IndexedCurve {
    curve: Curve,
    level: Level,
    index: Once<CurveIndex>,
    general: bool,
    few: bool,
}

/// A surface and its search index.
#[derive(Debug)]
pub struct IndexedSurface {
    surface: Arc<Surface>,
    level: Level,
    index: Once<SurfaceIndex>,
    general: bool,
    few: bool,
    /// Patches from which on the index is made in blocks.
    huge: usize,
}

impl IndexedCurve {
    /// Takes the curve; the index is built on first use.
    pub fn new(curve: Curve) -> Self {
        Self::at_level(curve, Level::detect())
    }

    /// As [`Self::new`], with the vector instructions of a level: answers have the same bits at each.
    pub fn at_level(curve: Curve, level: Level) -> Self {
        Self { curve, level, index: Once::new(), general: false, few: false }
    }

    /// As [`Self::new`], for a shape that is asked a few times: what pays with hundreds of queries (see `index::reach`) is not
    /// made.
    pub fn for_few(curve: Curve) -> Self {
        Self { few: true, ..Self::new(curve) }
    }

    /// As [`Self::new`], but elementary shapes are searched like any other: for tests that compare the two.
    #[doc(hidden)]
    pub fn general(curve: Curve) -> Self {
        Self { general: true, ..Self::new(curve) }
    }

    /// The curve.
    pub fn curve(&self) -> &Curve {
        &self.curve
    }

    /// Bytes held: the curve, and the index once it is built.
    pub fn memory(&self) -> usize {
        let index = self.index.get().map_or(0, CurveIndex::memory);
        size_of::<Self>() + self.curve.heap_memory() + index
    }

    /// The index, built now if it was not there.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`]; [`Error::Cancelled`] when `poll` said so.
    pub fn index(&self, poll: Poll) -> Result<&CurveIndex, Error> {
        self.index.get_or_build(|| {
            let mut index = CurveIndex::new(&self.curve, self.level, poll)?;
            if !self.general {
                index.recognise();
            }
            if !self.few {
                index.measure_reach(poll)?;
            }
            Ok(index)
        })
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
        Self::at_level(surface, Level::detect())
    }

    /// As [`Self::new`], with the vector instructions of a level: answers have the same bits at each.
    pub fn at_level(surface: Surface, level: Level) -> Self {
        let (surface, index) = (Arc::new(surface), Once::new());
        Self { surface, level, index, general: false, few: false, huge: HUGE }
    }

    /// As [`Self::new`], for a shape that is asked a few times: what pays with hundreds of queries (see `index::reach`) is not
    /// made.
    pub fn for_few(surface: Surface) -> Self {
        Self { few: true, ..Self::new(surface) }
    }

    /// As [`Self::new`], but elementary shapes are searched like any other: for tests that compare the two.
    #[doc(hidden)]
    pub fn general(surface: Surface) -> Self {
        Self { general: true, ..Self::new(surface) }
    }

    /// As [`Self::new`], but the index is made in blocks however small the surface is: for tests that compare the two.
    #[doc(hidden)]
    pub fn in_blocks(surface: Surface) -> Self {
        Self { huge: 0, ..Self::new(surface) }
    }

    /// The surface.
    pub fn surface(&self) -> &Surface {
        &self.surface
    }

    /// Bytes held: the surface, and the index once it is built.
    pub fn memory(&self) -> usize {
        let index = self.index.get().map_or(0, SurfaceIndex::memory);
        // The surface lies in a shared box with two counters.
        let shared = size_of::<Surface>() + 2 * size_of::<usize>();
        size_of::<Self>() + shared + self.surface.heap_memory() + index
    }

    /// The index, built now if it was not there.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`]; [`Error::Cancelled`] when `poll` said so.
    pub fn index(&self, poll: Poll) -> Result<&SurfaceIndex, Error> {
        self.index.get_or_build(|| {
            let mut index = SurfaceIndex::new(&self.surface, self.level, self.huge, poll)?;
            if !self.general {
                index.recognise();
            }
            if !self.few {
                index.measure_reach(poll)?;
            }
            Ok(index)
        })
    }

    /// Builds the index if it was not there.
    ///
    /// # Errors
    /// As [`Self::index`].
    pub fn prepare(&self, poll: Poll) -> Result<(), Error> {
        self.index(poll).map(|_| ())
    }
}
