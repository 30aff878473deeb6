//! Many places classified over threads.

use super::{Face, FaceWorkspace, Place, Standing};
use crate::closest::QueryOptions;
use crate::error::Error;
use crate::index::Poll;

/// Places between two looks at `poll`.
const TILE: usize = 4096;

impl Face {
    /// [`Face::classify`] for the place `at(i)` of every index of `out`, on `threads` threads (0: all cores); the answers do not depend on
    /// their number.
    ///
    /// # Errors
    /// [`Error::Cancelled`] when `poll` said so: places not reached are unknown.
    pub fn classify_all(
        &self,
        at: &(dyn Fn(usize) -> [f64; 2] + Sync),
        options: &QueryOptions,
        threads: usize,
        out: &mut [Place],
        poll: Poll,
    ) -> Result<(), Error> {
        let cores = || std::thread::available_parallelism().map_or(1, usize::from);
        let threads = if threads == 0 { cores() } else { threads };
        out.fill(Place::off(Standing::Unknown));
        let work = |first: usize, places: &mut [Place], workspace: &mut FaceWorkspace| {
            for (k, place) in places.iter_mut().enumerate() {
                *place = self.classify(at(first + k), options, workspace);
            }
        };
        let mut own = FaceWorkspace::default();
        for (tile, places) in out.chunks_mut(TILE * threads).enumerate() {
            if poll() {
                return Err(Error::Cancelled);
            }
            let first = tile * TILE * threads;
            let mut parts = places.chunks_mut(TILE).enumerate();
            let mine = parts.next();
            std::thread::scope(|scope| {
                for (k, part) in parts {
                    let work = &work;
                    let task = move || work(first + k * TILE, part, &mut FaceWorkspace::default());
                    scope.spawn(task);
                }
                if let Some((_, part)) = mine {
                    work(first, part, &mut own);
                }
            });
        }
        Ok(())
    }
}
