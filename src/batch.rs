//! Many queries over all cores, with the same bits for any number of threads.
//!
//! Queries never seed each other and every thread has its own workspace, so the order of work cannot show in the
//! answers. Tiles go round the threads like cards; the calling thread works too and looks at `poll` between
//! its tiles. No locks and no allocation on the way of a query.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

use crate::closest::FootPoint;
use crate::error::Error;

/// Queries in a tile: neighbours in the input share a tile and with it the caches; long enough for that, short
/// enough that the threads end together.
const TILE: usize = 128;

/// How often the calling thread polls while it waits for the others.
const PAUSE: Duration = Duration::from_millis(1);

/// The work of a batch: query number and workspace of the thread to record.
pub type Work<'a, W> = &'a (dyn Fn(usize, &mut W) -> FootPoint + Sync);

/// Asked on the calling thread with the number of queries done; true stops the batch.
pub type Poll<'a> = &'a mut dyn FnMut(usize) -> bool;

/// The tiles of one thread: number of the first query and where its records go.
type Hand<'a> = Vec<(usize, &'a mut [FootPoint])>;

#[derive(Default)]
struct Progress {
    done: AtomicUsize,
    stop: AtomicBool,
}

/// Runs `work` for every index of `out` on `threads` threads (0: all cores; 1: the calling thread only).
///
/// # Errors
/// [`Error::OutOfMemory`] before anything is written. [`Error::Cancelled`] when `poll` said so: records not
/// reached are [`FootPoint::unreached`].
pub fn run<W: Default>(
    out: &mut [FootPoint],
    threads: usize,
    work: Work<W>,
    poll: Poll,
) -> Result<(), Error> {
    let total = out.len();
    let wanted = if threads == 0 { cores() } else { threads };
    let threads = wanted.min(total.div_ceil(TILE)).max(1);
    let mut hands = deal(out, threads)?;
    for (_, tile) in hands.iter_mut().flatten() {
        tile.fill(FootPoint::unreached());
    }
    let progress = Progress::default();
    if threads == 1 {
        hands.into_iter().for_each(|hand| work_off(hand, work, &progress, poll));
    } else {
        work_together(hands, work, &progress, poll);
    }
    let complete = progress.done.load(Ordering::Relaxed) == total;
    if complete { Ok(()) } else { Err(Error::Cancelled) }
}

fn deal(out: &mut [FootPoint], threads: usize) -> Result<Vec<Hand<'_>>, Error> {
    let tiles = out.len().div_ceil(TILE);
    let mut hands = Vec::new();
    hands.try_reserve_exact(threads).map_err(|_| Error::OutOfMemory)?;
    for _ in 0..threads {
        let mut hand = Hand::new();
        hand.try_reserve_exact(tiles.div_ceil(threads)).map_err(|_| Error::OutOfMemory)?;
        hands.push(hand);
    }
    for (k, tile) in out.chunks_mut(TILE).enumerate() {
        hands[k % threads].push((k * TILE, tile));
    }
    Ok(hands)
}

/// One thread a hand, the calling one included. Hands that no thread has taken, because it could not be started or
/// has not got so far, are left to the caller, which then polls until the last thread has ended.
fn work_together<W: Default>(hands: Vec<Hand>, work: Work<W>, progress: &Progress, poll: Poll) {
    let hands: Vec<Mutex<Option<Hand>>> =
        hands.into_iter().map(|hand| Mutex::new(Some(hand))).collect();
    let take = |k: usize| hands[k].lock().unwrap_or_else(PoisonError::into_inner).take();
    std::thread::scope(|scope| {
        let caller = std::thread::current();
        let mut started = Vec::with_capacity(hands.len());
        for k in 1..hands.len() {
            let (take, caller) = (&take, caller.clone());
            let task = move || {
                take(k).into_iter().for_each(|hand| work_off(hand, work, progress, &mut |_| false));
                caller.unpark();
            };
            started.extend(std::thread::Builder::new().spawn_scoped(scope, task));
        }
        take(0).into_iter().for_each(|hand| work_off(hand, work, progress, poll));
        for k in 1..hands.len() {
            take(k).into_iter().for_each(|hand| work_off(hand, work, progress, poll));
        }
        while !started.iter().all(|thread| thread.is_finished()) {
            if poll(progress.done.load(Ordering::Relaxed)) {
                progress.stop.store(true, Ordering::Relaxed);
            }
            std::thread::park_timeout(PAUSE);
        }
    });
}

fn work_off<W: Default>(hand: Hand, work: Work<W>, progress: &Progress, poll: Poll) {
    let mut workspace = W::default();
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
    use crate::closest::Workspace;

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
