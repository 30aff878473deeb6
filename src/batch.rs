//! Many queries over all cores, with the same bits for any number of threads.
//!
//! Queries never seed each other and every thread has its own workspace, so the order of work cannot show in the
//! answers. Tiles go round the threads like cards; the calling thread works too and looks at `poll` between
//! its tiles. No locks, no allocation per query.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use crate::closest::{FootPoint, Workspace};
use crate::error::Error;

/// Queries in a tile: neighbours in the input share a tile and with it the caches; long enough for that, short
/// enough that the threads end together.
const TILE: usize = 128;

/// The work of a batch: query number and workspace to record.
pub type Work<'a> = &'a (dyn Fn(usize, &mut Workspace) -> FootPoint + Sync);

/// Asked on the calling thread with the number of queries done; true stops the batch.
pub type Poll<'a> = &'a mut dyn FnMut(usize) -> bool;

#[derive(Default)]
struct Progress {
    done: AtomicUsize,
    stop: AtomicBool,
}

/// Runs `work` for every index of `out` on `threads` threads (0: all cores; 1: the calling thread only).
///
/// # Errors
/// [`Error::Cancelled`] when `poll` said so: records not reached are [`FootPoint::unreached`].
/// [`Error::OutOfMemory`] when a thread could not be started; likewise.
pub fn run(out: &mut [FootPoint], threads: usize, work: Work, poll: Poll) -> Result<(), Error> {
    let total = out.len();
    let wanted = if threads == 0 { cores() } else { threads };
    let threads = wanted.min(total.div_ceil(TILE)).max(1);
    out.fill(FootPoint::unreached());
    let mut hands: Vec<Vec<(usize, &mut [FootPoint])>> = (0..threads).map(|_| Vec::new()).collect();
    for (k, tile) in out.chunks_mut(TILE).enumerate() {
        hands[k % threads].push((k * TILE, tile));
    }
    let progress = Progress::default();
    let mut hands = hands.into_iter();
    let own = hands.next().unwrap_or_default();
    let started = std::thread::scope(|scope| {
        let mut started = true;
        for hand in hands {
            let progress = &progress;
            let task = move || work_off(hand, work, progress, &mut |_| false);
            started &= std::thread::Builder::new().spawn_scoped(scope, task).is_ok();
        }
        work_off(own, work, &progress, poll);
        started
    });
    if !started {
        return Err(Error::OutOfMemory);
    }
    let complete = progress.done.load(Ordering::Relaxed) == total;
    if complete { Ok(()) } else { Err(Error::Cancelled) }
}

fn work_off(hand: Vec<(usize, &mut [FootPoint])>, work: Work, progress: &Progress, poll: Poll) {
    let mut workspace = Workspace::default();
    for (first, tile) in hand {
        if poll(progress.done.load(Ordering::Relaxed)) {
            progress.stop.store(true, Ordering::Relaxed);
        }
        if progress.stop.load(Ordering::Relaxed) {
            return;
        }
        for (k, record) in tile.iter_mut().enumerate() {
            *record = work(first + k, &mut workspace);
        }
        progress.done.fetch_add(tile.len(), Ordering::Relaxed);
    }
}

fn cores() -> usize {
    std::thread::available_parallelism().map_or(1, usize::from)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn numbered(i: usize, _: &mut Workspace) -> FootPoint {
        FootPoint { u: i as f64, ..FootPoint::unreached() }
    }

    #[test]
    fn every_record_is_written_in_its_place() {
        for (count, threads) in [(0, 3), (1, 0), (1000, 1), (1000, 3), (5000, 8)] {
            let mut out = vec![FootPoint::unreached(); count];
            run(&mut out, threads, &numbered, &mut |_| false).unwrap();
            assert!(out.iter().enumerate().all(|(i, foot)| foot.u == i as f64));
        }
    }

    #[test]
    fn a_stopped_batch_leaves_the_rest_unreached() {
        let mut out = vec![FootPoint::unreached(); 1000];
        let stopped = run(&mut out, 1, &numbered, &mut |done| done >= 300);
        assert_eq!(stopped, Err(Error::Cancelled));
        assert!(out[0].u == 0.0 && out[999].u.is_nan());
    }
}
