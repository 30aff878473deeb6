//! Many queries over all cores, with the same bits for any number of threads.
//!
//! Queries never seed each other and every thread has its own workspace, so the order of work cannot show in the
//! answers. Threads take tiles as they get free; the calling thread works too and looks at `poll` between its groups.
//! Within a tile the queries may be asked in the order of a space-filling curve (Z order), so that neighbours find the
//! pieces of a large shape in the caches. No locks and no allocation on the way of a query; memory beyond the answers is
//! bounded for any number of queries: at most 512 KiB a thread.

use std::cell::Cell;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};
use std::thread::LocalKey;
use std::time::Duration;

use crate::bounds::Vector;
use crate::closest::{FootPoint, Workspace};
use crate::error::Error;
use crate::preimage::ProjectMemory;
use crate::scene::SceneWorkspace;

/// Queries between two looks at `poll`, and least queries of a tile and of an order.
pub const GROUP: usize = 128;

/// Most queries of a tile: their order takes 512 KiB.
const LARGEST_TILE: usize = 1 << 16;

/// Tiles a thread: enough for threads to end together when queries differ in cost; fewer when each is put in order, since
/// that gains more the larger the tile is.
const TILES: usize = 64;
const ORDERED_TILES: usize = 8;

/// Bits of the Z order in each direction.
const BITS: u32 = 10;

/// How often the calling thread polls while it waits for the others.
const PAUSE: Duration = Duration::from_millis(1);

/// The work of a batch; `W`: the workspace of a thread.
pub trait Work<W, R = FootPoint>: Sync {
    /// The record of a query, by its number.
    fn one(&self, number: usize, memory: &mut W) -> R;

    /// The records of some queries, at most [`GROUP`].
    fn group(&self, numbers: &[usize], memory: &mut W, out: &mut [R]) {
        for (record, &number) in out.iter_mut().zip(numbers) {
            *record = self.one(number, memory);
        }
    }
}

impl<W, R, F: Fn(usize, &mut W) -> R + Sync> Work<W, R> for F {
    fn one(&self, number: usize, memory: &mut W) -> R {
        self(number, memory)
    }
}

/// What a query leaves.
pub trait Record: Copy + Send {
    /// What a query leaves that was not reached.
    fn unreached() -> Self;
}

impl Record for FootPoint {
    fn unreached() -> Self {
        Self::unreached()
    }
}

/// Where a query is, when queries are to be put in order.
pub type Place<'a> = &'a (dyn Fn(usize) -> Vector + Sync);

/// Asked on the calling thread with the number of queries done; true stops the batch.
pub type Poll<'a> = &'a mut dyn FnMut(usize) -> bool;

/// Memory that a thread keeps until it ends, so that calls with one query each allocate nothing.
pub type Kept<W> = LocalKey<Cell<Option<Box<W>>>>;

/// What a thread works with.
pub trait Memory: Default + 'static {
    /// Where the calling thread keeps it for its next batch, if it does.
    fn kept() -> Option<&'static Kept<Self>> {
        None
    }
}

macro_rules! keep {
    ($memory:ty) => {
        impl Memory for $memory {
            fn kept() -> Option<&'static Kept<Self>> {
                thread_local! {
                    static OWN: Cell<Option<Box<$memory>>> = const { Cell::new(None) };
                }
                Some(&OWN)
            }
        }
    };
}

keep!(Workspace);
keep!(SceneWorkspace);
impl Memory for ProjectMemory {}

/// Calls `f` with the memory of the calling thread.
fn with_own<W: Memory, R>(f: impl FnOnce(&mut W) -> R) -> R {
    // A call from within a callback, or while the thread ends, finds none and makes its own.
    let kept = W::kept().and_then(|kept| kept.try_with(Cell::take).ok().flatten());
    let mut memory = kept.unwrap_or_default();
    let result = f(&mut memory);
    if let Some(kept) = W::kept() {
        let _ = kept.try_with(|own| own.set(Some(memory)));
    }
    result
}

/// A tile: number of the first query and where its records go.
type Tile<'a, R> = (usize, &'a mut [R]);

/// Tiles that wait for the thread that takes them.
type Dealt<'a, R> = Vec<Mutex<Option<Tile<'a, R>>>>;

#[derive(Default)]
struct Progress {
    next: AtomicUsize,
    done: AtomicUsize,
    stop: AtomicBool,
}

/// Runs `work` for every index of `out` on `threads` threads (0: all cores; 1: the calling thread only), those of a tile in
/// the order of their places when `place` is given.
///
/// # Errors
/// [`Error::OutOfMemory`] before anything is written. [`Error::Cancelled`] when `poll` said so: records not
/// reached are [`Record::unreached`].
pub fn run<W: Memory, R: Record>(
    out: &mut [R],
    threads: usize,
    place: Option<Place>,
    work: &dyn Work<W, R>,
    poll: Poll,
) -> Result<(), Error> {
    let total = out.len();
    let wanted = if threads == 0 && total > GROUP { cores() } else { threads.max(1) };
    let threads = wanted.min(total.div_ceil(GROUP)).max(1);
    let tiles = threads * if place.is_some() { ORDERED_TILES } else { TILES };
    // A division takes as long as all else that a call with one query needs here.
    let size = if total <= GROUP { GROUP } else { (total / tiles).clamp(GROUP, LARGEST_TILE) };
    let progress = Progress::default();
    if threads == 1 {
        with_own::<W, _>(|memory| {
            for (k, records) in out.chunks_mut(size).enumerate() {
                work_off((k * size, records), memory, place, work, &progress, poll);
            }
        });
    } else {
        let tiles = dealt(out, size)?;
        work_together(&tiles, threads, place, work, &progress, poll);
    }
    let complete = progress.done.load(Ordering::Relaxed) == total;
    if complete { Ok(()) } else { Err(Error::Cancelled) }
}

fn dealt<R>(out: &mut [R], size: usize) -> Result<Dealt<'_, R>, Error> {
    let mut tiles = Vec::new();
    tiles.try_reserve_exact(out.len().div_ceil(size)).map_err(|_| Error::OutOfMemory)?;
    for (k, records) in out.chunks_mut(size).enumerate() {
        tiles.push(Mutex::new(Some((k * size, records))));
    }
    Ok(tiles)
}

/// Threads that take tiles until none is left, the calling one included: it polls between its groups and while it waits
/// for the others. A thread that cannot be started leaves its share to the rest.
fn work_together<W: Memory, R: Record>(
    tiles: &[Mutex<Option<Tile<R>>>],
    threads: usize,
    place: Option<Place>,
    work: &dyn Work<W, R>,
    progress: &Progress,
    poll: Poll,
) {
    let take_all = |memory: &mut W, poll: Poll| {
        while let Some(tile) = tiles.get(progress.next.fetch_add(1, Ordering::Relaxed)) {
            // Each tile is taken once: nobody waits here.
            let tile = tile.lock().unwrap_or_else(PoisonError::into_inner).take();
            if let Some(tile) = tile {
                work_off(tile, memory, place, work, progress, poll);
            }
        }
    };
    std::thread::scope(|scope| {
        let caller = std::thread::current();
        let mut started = Vec::with_capacity(threads);
        for _ in 1..threads {
            let (take_all, caller) = (&take_all, caller.clone());
            let task = move || {
                take_all(&mut W::default(), &mut |_| false);
                caller.unpark();
            };
            started.extend(std::thread::Builder::new().spawn_scoped(scope, task));
        }
        with_own::<W, _>(|memory| take_all(memory, poll));
        while !started.iter().all(|thread| thread.is_finished()) {
            if poll(progress.done.load(Ordering::Relaxed)) {
                progress.stop.store(true, Ordering::Relaxed);
            }
            std::thread::park_timeout(PAUSE);
        }
    });
}

fn work_off<W, R: Record>(
    (first, records): Tile<R>,
    memory: &mut W,
    place: Option<Place>,
    work: &dyn Work<W, R>,
    progress: &Progress,
    poll: Poll,
) {
    let total = records.len();
    let place = place.filter(|_| total > GROUP);
    let order = place.map(|place| in_z_order(first, total, place)).unwrap_or_default();
    for group in (0..total).step_by(GROUP) {
        let end = (group + GROUP).min(total);
        let at = |k: usize| order.get(k).map_or(k, |&entry| (entry & 0xffff_ffff) as usize);
        if poll(progress.done.load(Ordering::Relaxed)) {
            progress.stop.store(true, Ordering::Relaxed);
        }
        if progress.stop.load(Ordering::Relaxed) {
            (group..total).for_each(|k| records[at(k)] = R::unreached());
            return;
        }
        if end - group == 1 {
            records[at(group)] = work.one(first + at(group), memory);
            progress.done.fetch_add(1, Ordering::Relaxed);
            continue;
        }
        let mut numbers = [0; GROUP];
        let numbers = &mut numbers[..end - group];
        for (number, k) in numbers.iter_mut().zip(group..) {
            *number = first + at(k);
        }
        if order.is_empty() {
            work.group(numbers, memory, &mut records[group..end]);
        } else {
            let mut found = [R::unreached(); GROUP];
            work.group(numbers, memory, &mut found[..numbers.len()]);
            for (&number, record) in numbers.iter().zip(found) {
                records[number - first] = record;
            }
        }
        progress.done.fetch_add(end - group, Ordering::Relaxed);
    }
}

/// The queries of a tile along the Z order of their box: key in the upper half, number in the tile in the lower. Empty
/// (the order as it is) when there is no memory for it.
fn in_z_order(first: usize, count: usize, place: Place) -> Vec<u64> {
    let mut order = Vec::new();
    if order.try_reserve_exact(count).is_err() {
        return order;
    }
    let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    for at in (first..first + count).map(place) {
        for c in (0..3).filter(|&c| at[c].is_finite()) {
            (low[c], high[c]) = (low[c].min(at[c]), high[c].max(at[c]));
        }
    }
    let cells = f64::from(1 << BITS);
    let scale = [0, 1, 2].map(|c| cells / (high[c] - low[c]).max(f64::MIN_POSITIVE));
    order.extend((0..count).map(|k| {
        let at = place(first + k);
        // A cast of what is not a number is zero; queries may be anywhere, only time depends on it.
        let cell = [0, 1, 2].map(|c| (((at[c] - low[c]) * scale[c]) as u32).min((1 << BITS) - 1));
        let bit =
            |b: u32| (0..3).map(|c| ((cell[c] >> b) as u64 & 1) << (3 * b + c as u32)).sum::<u64>();
        (0..BITS).map(bit).sum::<u64>() << 32 | k as u64
    }));
    order.sort_unstable();
    order
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

    fn scattered(i: usize) -> Vector {
        if i % 97 == 3 {
            return [f64::NAN, f64::INFINITY, 1e300];
        }
        [((i * 31) % 101) as f64, ((i * 17) % 89) as f64, (i % 7) as f64 - 1e4]
    }

    #[test]
    fn an_order_holds_every_query_once_and_neighbours_are_near() {
        let order = in_z_order(1000, 4096, &scattered);
        let mut seen: Vec<u64> = order.iter().map(|entry| entry & 0xffff_ffff).collect();
        let at = |k: u64| scattered(1000 + k as usize);
        let apart = |pair: &[u64]| {
            let (a, b) = (at(pair[0]), at(pair[1]));
            (0..3).map(|c| (a[c] - b[c]).abs()).filter(|x| x.is_finite()).sum::<f64>()
        };
        let walk = |list: &[u64]| list.windows(2).map(apart).filter(|&x| x < 1e3).sum::<f64>();
        let sorted = walk(&seen);
        seen.sort_unstable();
        assert!(seen.iter().enumerate().all(|(i, &k)| i as u64 == k));
        assert!(4.0 * sorted < walk(&seen), "{sorted} {}", walk(&seen));
    }

    #[test]
    fn every_record_is_written_in_its_place() {
        for (count, threads) in [(0, 3), (1, 0), (1000, 1), (1000, 3), (70_000, 8)] {
            let mut out = vec![FootPoint::unreached(); count];
            for place in [None, Some(&scattered as Place)] {
                out.fill(FootPoint::unreached());
                run(&mut out, threads, place, &numbered, &mut |_| false).unwrap();
                assert!(out.iter().enumerate().all(|(i, foot)| foot.u == i as f64));
            }
        }
    }

    #[test]
    fn a_stopped_batch_leaves_the_rest_unreached() {
        let mut out = vec![FootPoint::unreached(); 1000];
        let stopped = run(&mut out, 1, None, &numbered, &mut |done| done >= 300);
        assert_eq!(stopped, Err(Error::Cancelled));
        assert!(out[0].u == 0.0 && out[999].u.is_nan());
    }
}
