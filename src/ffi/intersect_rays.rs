//! Rays against a surface: a prepared surface, first hits as records, all hits as a handle.

use super::intersect_records::{fpt_hit_options, fpt_ray_hit};
use super::memory::{array, optional_array, output, place, shared};
use super::surface::{self, fpt_surface};
use super::{Failure, fpt_status, guard};
use crate::batch::Record;
use crate::error::Error;
use crate::intersect::{Caster, Hit, Ray, RayHits};

/// A surface prepared for rays. Immutable; keeps what it needs of the surface. Owned by the caller, released by fpt_caster_free.
pub struct fpt_caster {
    caster: Caster,
}

/// The hits of many rays. Immutable; owned by the caller, released by fpt_ray_hits_free.
pub struct fpt_ray_hits {
    hits: RayHits,
}

/// Prepares a surface for rays: its patches are cut into cells that a line crosses at most once. Cost: some microseconds a
/// cell, of which a patch has 4 to 64, as a rule.
///
/// @param options  should_stop and user count; NULL: the defaults
/// @param out      the caster; release it with fpt_caster_free
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_caster_new(
    surface: *const fpt_surface,
    options: *const fpt_hit_options,
    out: *mut *mut fpt_caster,
) -> fpt_status {
    // SAFETY: the header asks for a live handle, options and room for a handle.
    guard(|| unsafe {
        let shape = surface::shared_spline(surface)?;
        let options = fpt_hit_options::read(options)?;
        let out = place("out", out)?;
        let callbacks = options.callbacks();
        let caster = Caster::new(shape, &mut || callbacks.poll(0, 1))?;
        *out = Box::into_raw(Box::new(fpt_caster { caster }));
        Ok(())
    })
}

/// Releases a caster. NULL is fine. No other call may use the handle during or after this one.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_caster_free(caster: *mut fpt_caster) {
    let release = || {
        if !caster.is_null() {
            // SAFETY: a handle comes from Box::into_raw and is released once.
            drop(unsafe { Box::from_raw(caster) });
        }
        Ok(())
    };
    let _ = guard(release);
}

/// The rays of a call.
struct Rays<'a> {
    origins: &'a [[f64; 3]],
    directions: &'a [[f64; 3]],
    reach: Option<&'a [f64]>,
}

impl<'a> Rays<'a> {
    /// # Safety
    /// NULL or arrays of these lengths.
    unsafe fn read(
        origins: *const f64,
        directions: *const f64,
        reach: *const f64,
        count: usize,
    ) -> Result<Self, Failure> {
        // SAFETY: the caller vouches for them.
        unsafe {
            Ok(Self {
                origins: array("origins", origins.cast::<[f64; 3]>(), count)?,
                directions: array("directions", directions.cast::<[f64; 3]>(), count)?,
                reach: optional_array("reach", reach, 2)?,
            })
        }
    }

    fn get(&self, k: usize) -> Ray {
        let reach = self.reach.map_or([0.0, f64::INFINITY], |ends| [ends[0], ends[1]]);
        Ray { origin: self.origins[k], direction: self.directions[k], reach }
    }
}

/// The first hit of each ray, with the number of all its hits: proven, unless its flags have FPT_RAY_NOT_PROVEN. A bad ray
/// marks its own record. The bits do not depend on the threads.
///
/// @param origins     x,y,z of `count` origins
/// @param directions  x,y,z of `count` directions of any length but 0
/// @param count       may be 0
/// @param reach       2 numbers: least and greatest length along each ray that counts, infinities allowed (a line: both); NULL: from
///                    the origin on
/// @param options     threads, should_stop, progress and user count; NULL: the defaults
/// @param out         `count` records
/// @return FPT_CANCELLED when should_stop said so; then records not reached have t NaN and FPT_RAY_NOT_PROVEN
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_caster_first(
    caster: *const fpt_caster,
    origins: *const f64,
    directions: *const f64,
    count: usize,
    reach: *const f64,
    options: *const fpt_hit_options,
    out: *mut fpt_ray_hit,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and arrays of these lengths; the layouts of the records agree.
    guard(|| unsafe { cast(caster, (origins, directions, count, reach), options, out, false) })
}

/// # Safety
/// As the header of fpt_caster_first asks.
unsafe fn cast(
    caster: *const fpt_caster,
    (origins, directions, count, reach): (*const f64, *const f64, usize, *const f64),
    options: *const fpt_hit_options,
    out: *mut fpt_ray_hit,
    alone: bool,
) -> Result<(), Failure> {
    // SAFETY: the caller vouches for them; the layouts of the records agree.
    unsafe {
        let caster = &shared("caster", caster)?.caster;
        let rays = Rays::read(origins, directions, reach, count)?;
        let options = fpt_hit_options::read(options)?;
        let out = output("out", out.cast::<Hit>(), count)?;
        let callbacks = options.callbacks();
        let mut poll = |done: usize| callbacks.poll(done, count);
        out.fill(Hit::unreached());
        let (threads, ray) = (options.threads as usize, |k| rays.get(k));
        if alone {
            caster.nearest_hits(&ray, out, threads, &mut poll)?;
        } else {
            caster.first_hits(&ray, out, threads, &mut poll)?;
        }
        callbacks.report(count, count);
        Ok(())
    }
}

/// The first hit of each ray alone: what lies behind it is not looked at. Proven as fpt_caster_first; the records are the same but for
/// `count`, which is 1, or 0 for none. Cost: half of fpt_caster_first where rays pass through two walls.
///
/// @param origins     as for fpt_caster_first
/// @param directions  as for fpt_caster_first
/// @param count       as for fpt_caster_first
/// @param reach       as for fpt_caster_first
/// @param options     as for fpt_caster_first
/// @param out         `count` records
/// @return as fpt_caster_first
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_caster_nearest(
    caster: *const fpt_caster,
    origins: *const f64,
    directions: *const f64,
    count: usize,
    reach: *const f64,
    options: *const fpt_hit_options,
    out: *mut fpt_ray_hit,
) -> fpt_status {
    // SAFETY: the caller vouches for the same as with fpt_caster_first.
    guard(|| unsafe { cast(caster, (origins, directions, count, reach), options, out, true) })
}

/// All hits of each ray, in the order along it.
///
/// @param origins     as for fpt_caster_first
/// @param directions  as for fpt_caster_first
/// @param count       as for fpt_caster_first
/// @param reach       as for fpt_caster_first
/// @param options     as for fpt_caster_first
/// @param out         the hits; release them with fpt_ray_hits_free
/// @return FPT_CANCELLED when should_stop said so: rays not reached have no hit, some have only their first one, and all of these have
///         FPT_RAY_NOT_PROVEN in their flags
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_caster_all(
    caster: *const fpt_caster,
    origins: *const f64,
    directions: *const f64,
    count: usize,
    reach: *const f64,
    options: *const fpt_hit_options,
    out: *mut *mut fpt_ray_hits,
) -> fpt_status {
    // SAFETY: the header asks for a live handle, arrays of these lengths and room for a handle.
    guard(|| unsafe {
        let caster = &shared("caster", caster)?.caster;
        let rays = Rays::read(origins, directions, reach, count)?;
        let options = fpt_hit_options::read(options)?;
        let out = place("out", out)?;
        let callbacks = options.callbacks();
        let mut poll = |done: usize| callbacks.poll(done, count);
        let threads = options.threads as usize;
        let hits = caster.all_hits(&|k| rays.get(k), count, threads, &mut poll)?;
        let stopped = hits.stopped;
        *out = Box::into_raw(Box::new(fpt_ray_hits { hits }));
        if !stopped {
            callbacks.report(count, count);
            return Ok(());
        }
        let text = "cancelled by should_stop: rays that were not cast have FPT_RAY_NOT_PROVEN";
        Err(Failure::Stopped(text.into()))
    })
}

/// The number of all hits.
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_ray_hits_count(
    hits: *const fpt_ray_hits,
    out_count: *mut usize,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for a number.
    guard(|| unsafe {
        let hits = &shared("hits", hits)?.hits;
        *place("out_count", out_count)? = hits.hits.len();
        Ok(())
    })
}

/// All hits, ray by ray.
///
/// @param capacity  records that fit into `out`; at least the number of hits, else FPT_INVALID_ARGUMENT
/// @param out       the hits
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_ray_hits_get(
    hits: *const fpt_ray_hits,
    capacity: usize,
    out: *mut fpt_ray_hit,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for `capacity` records; the layouts agree.
    guard(|| unsafe {
        let hits = &shared("hits", hits)?.hits.hits;
        check_room(hits.len(), capacity)?;
        output("out", out.cast::<Hit>(), hits.len())?.copy_from_slice(hits);
        Ok(())
    })
}

/// Where the hits of each ray begin: those of ray k are numbers starts[k] to starts[k+1] - 1.
///
/// @param capacity  numbers that fit into `out`; at least the number of rays + 1, else FPT_INVALID_ARGUMENT
/// @param out       the starts, as many as rays + 1
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_ray_hits_starts(
    hits: *const fpt_ray_hits,
    capacity: usize,
    out: *mut usize,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for `capacity` numbers.
    guard(|| unsafe {
        let starts = &shared("hits", hits)?.hits.starts;
        check_room(starts.len(), capacity)?;
        output("out", out, starts.len())?.copy_from_slice(starts);
        Ok(())
    })
}

/// Flags of each ray: FPT_RAY_NOT_PROVEN where hits may be missing, FPT_RAY_BAD_RAY.
///
/// @param capacity  numbers that fit into `out`; at least the number of rays, else FPT_INVALID_ARGUMENT
/// @param out       the flags, one number a ray
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_ray_hits_flags(
    hits: *const fpt_ray_hits,
    capacity: usize,
    out: *mut u32,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for `capacity` numbers.
    guard(|| unsafe {
        let flags = &shared("hits", hits)?.hits.flags;
        check_room(flags.len(), capacity)?;
        output("out", out, flags.len())?.copy_from_slice(flags);
        Ok(())
    })
}

/// Releases hits. NULL is fine. No other call may use the handle during or after this one.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_ray_hits_free(hits: *mut fpt_ray_hits) {
    let release = || {
        if !hits.is_null() {
            // SAFETY: a handle comes from Box::into_raw and is released once.
            drop(unsafe { Box::from_raw(hits) });
        }
        Ok(())
    };
    let _ = guard(release);
}

fn check_room(needed: usize, capacity: usize) -> Result<(), Failure> {
    if capacity >= needed {
        return Ok(());
    }
    let text = format!("capacity: {capacity} is less than the {needed} asked for");
    Err(Error::InvalidArgument(text).into())
}
