//! Whether the caller wants to stop: asked by every phase of an intersection, also deep within closures.

use crate::error::Error;
use std::cell::{Cell, RefCell};

/// Steps between two questions: a step is some microseconds.
const GROUP: u32 = 32;

/// What the caller is asked with, and what it said.
pub struct Watch<'a> {
    poll: RefCell<&'a mut dyn FnMut(u64, u64) -> bool>,
    /// What is told as done.
    done: Cell<u64>,
    calls: Cell<u32>,
    stopped: Cell<bool>,
}

impl<'a> Watch<'a> {
    /// Asks `poll(done, left)`; nobody if it is known that `stopped` was said.
    pub fn after(stopped: bool, poll: &'a mut dyn FnMut(u64, u64) -> bool) -> Self {
        let watch = Self::new(poll);
        watch.stopped.set(stopped);
        watch
    }

    /// Asks `poll(done, left)`.
    pub fn new(poll: &'a mut dyn FnMut(u64, u64) -> bool) -> Self {
        Self {
            poll: RefCell::new(poll),
            done: Cell::new(0),
            calls: Cell::new(0),
            stopped: Cell::new(false),
        }
    }

    /// Whether to stop, told how much is done and waits. Once it is true it stays so, and nobody is asked again.
    pub fn asks(&self, done: u64, left: u64) -> bool {
        self.done.set(done);
        if !self.stopped.get() && (self.poll.borrow_mut())(done, left) {
            self.stopped.set(true);
        }
        self.stopped.get()
    }

    /// Whether to stop, asked once in a group of steps; `left` of the phase wait.
    pub fn stops(&self, left: usize) -> bool {
        let calls = self.calls.get();
        self.calls.set(calls.wrapping_add(1));
        if calls.is_multiple_of(GROUP) {
            return self.asks(self.done.get(), left as u64);
        }
        self.stopped.get()
    }

    /// Whether it was said to stop.
    pub fn stopped(&self) -> bool {
        self.stopped.get()
    }

    /// Asks at the end of a phase.
    pub fn phase(&self) {
        self.asks(self.done.get(), 0);
    }

    /// What a phase made is of use only if nobody stopped it.
    ///
    /// # Errors
    /// [`Error::Cancelled`].
    pub fn checked(&self) -> Result<(), Error> {
        if self.stopped.get() { Err(Error::Cancelled) } else { Ok(()) }
    }
}
