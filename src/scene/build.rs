//! Building the indexes of many shapes on all cores, polled on the calling thread.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

use super::Shape;
use crate::error::Error;

/// How often the calling thread polls while it waits for the others.
const PAUSE: Duration = Duration::from_millis(1);

/// What the threads share.
struct Work<'a> {
    shapes: &'a [Shape],
    next: AtomicUsize,
    stop: AtomicBool,
    failure: Mutex<Option<Error>>,
}

impl Work<'_> {
    /// Builds one shape after the other until none is left or the work is stopped.
    fn go_on(&self, poll: &mut dyn FnMut() -> bool) {
        loop {
            let mut asked = || {
                let stop = poll() || self.stop.load(Ordering::Relaxed);
                self.stop.fetch_or(stop, Ordering::Relaxed);
                stop
            };
            if asked() {
                return;
            }
            let k = self.next.fetch_add(1, Ordering::Relaxed);
            let Some(shape) = self.shapes.get(k) else { return };
            if let Err(error) = shape.prepare(&mut asked) {
                self.stop.store(true, Ordering::Relaxed);
                if error != Error::Cancelled {
                    self.failure
                        .lock()
                        .unwrap_or_else(PoisonError::into_inner)
                        .get_or_insert(error);
                }
                return;
            }
        }
    }

    fn outcome(self) -> Result<(), Error> {
        match self.failure.into_inner().unwrap_or_else(PoisonError::into_inner) {
            Some(error) => Err(error),
            None if self.stop.into_inner() => Err(Error::Cancelled),
            None => Ok(()),
        }
    }
}

/// Builds the index of every shape on `threads` threads (0: all cores), the calling one included.
///
/// # Errors
/// [`Error::OutOfMemory`]; [`Error::Cancelled`] when `poll` said so. What is built stays.
pub fn prepare(
    shapes: &[Shape],
    threads: usize,
    poll: &mut dyn FnMut() -> bool,
) -> Result<(), Error> {
    let cores = || std::thread::available_parallelism().map_or(1, usize::from);
    let wanted = if threads == 0 { cores() } else { threads };
    let work = Work {
        shapes,
        next: AtomicUsize::new(0),
        stop: AtomicBool::new(false),
        failure: Mutex::new(None),
    };
    std::thread::scope(|scope| {
        let caller = std::thread::current();
        let mut started = Vec::new();
        for _ in 1..wanted.min(shapes.len()) {
            let (work, caller) = (&work, caller.clone());
            let task = move || {
                work.go_on(&mut || false);
                caller.unpark();
            };
            started.extend(std::thread::Builder::new().spawn_scoped(scope, task));
        }
        work.go_on(poll);
        while !started.iter().all(|thread| thread.is_finished()) {
            if poll() {
                work.stop.store(true, Ordering::Relaxed);
            }
            std::thread::park_timeout(PAUSE);
        }
    });
    work.outcome()
}
