//! The C API: a veneer over the modules below, and the only place with `unsafe` code.
//!
//! Problem: C callers bring raw pointers, counts and numbers that nobody checked, and nothing may
//! unwind into them. Every function is one call of [`guard`], the fence: inside it a request is first
//! checked in full, then answered, and only an answer is written to the caller's memory.
//!
//! ```text
//!   C call -> guard -> arguments (pointers, counts, strides)   memory.rs, limits.rs
//!                   -> options, records (struct layouts)       options.rs, records.rs
//!                   -> spline or function behind a handle      form.rs
//!                   -> Curve, Surface, closest, batch          curve.rs, surface.rs, callback.rs,
//!                                                              query.rs, floats.rs, sets.rs, lines.rs
//!                   -> normal, unwrap                          normals.rs, path.rs
//!                   -> scene                                   scene.rs, scene_query.rs
//!                   -> pcurve, face                            pcurve.rs, face.rs
//!                   -> weights                                 weights.rs, weights_records.rs, weights_report.rs, weights_edit.rs
//!                   -> operate                                 operate_curve.rs, operate_surface.rs, operate_measure.rs
//!                   -> transform, trim                         transform.rs, support.rs, trim.rs, trim_parts.rs,
//!                                                              trim_change.rs, trim_report.rs
//!                   -> fair, inspect                          fair.rs, inspect_records.rs, inspect.rs
//!                   -> intersect                               intersect_records.rs, intersect.rs, intersect_rays.rs
//!          <- fpt_status, text of a failure for fpt_last_error
//! ```
//!
//! The header `include/footpoint.h` is rendered from these files by `build.rs`. The documentation of the
//! items here is its text, so it is written for C and has no Rust headings.
//! Limits: memory that runs out inside a fixed-size allocation (a handle, a thread) aborts as in any
//! Rust program; whatever is sized by the caller is reserved first and fails as `FPT_OUT_OF_MEMORY`.
#![allow(unsafe_code, reason = "a C boundary reads and writes through the caller's pointers")]
#![allow(non_camel_case_types, reason = "the names are C's, and cbindgen takes them as they are")]

mod memory;
mod limits;
mod options;
mod records;
mod form;
mod curve;
mod surface;
mod callback;
mod query;
mod floats;
mod sets;
mod lines;
mod normals;
mod path;
mod scene;
mod scene_query;
mod weights_records;
mod weights_report;
mod weights;
mod weights_edit;
mod operate_curve;
mod operate_surface;
mod operate_measure;
mod fit;
mod construct;
mod construct_surface;
mod offset;
mod pcurve;
mod face;
mod transform;
mod support;
mod trim;
mod trim_parts;
mod trim_change;
mod trim_report;
mod march_records;
mod march;
mod march_methods;
mod inspect_records;
mod fair;
mod inspect;
mod intersect_records;
mod intersect;
mod intersect_rays;
#[cfg(test)]
mod tests;

use crate::error::Error;
use std::any::Any;
use std::cell::UnsafeCell;
use std::ffi::{CStr, c_char};
use std::fmt::{self, Write};
use std::panic::{AssertUnwindSafe, catch_unwind};

/// What a call returns: FPT_OK (0) or one of the other numbers of fpt_status_code. Never renumbered.
pub type fpt_status = i32;

/// The values of fpt_status.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum fpt_status_code {
    /// The outputs are written.
    FPT_OK = 0,
    /// A pointer that must not be NULL is; the text names the parameter.
    FPT_NULL_ARGUMENT = 1,
    /// A value that the documentation excludes; the text names the parameter and the index.
    FPT_INVALID_ARGUMENT = 2,
    /// The budget ran out before a set was complete. Foot points carry FPT_FOOT_BUDGET instead.
    FPT_BUDGET_EXHAUSTED = 3,
    /// should_stop returned non-zero. Records not reached are marked, see fpt_foot_point.
    FPT_CANCELLED = 4,
    /// A request of a newer version, or one that this version cannot answer.
    FPT_UNSUPPORTED = 5,
    /// Memory that could not be had.
    FPT_OUT_OF_MEMORY = 6,
    /// A defect of the library. Handles stay valid; please report the text of fpt_last_error.
    FPT_INTERNAL = 99,
}
use fpt_status_code::*;

/// A call that failed: C has two cases more than Rust, the pointer that is missing and the defect.
#[derive(Debug)]
enum Failure {
    Null(&'static str),
    Refused(Error),
    /// A set that was handed over without being complete.
    Budget(String),
    /// What was found when the caller said stop.
    Stopped(String),
    Internal(String),
}

impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        Self::Refused(error)
    }
}

impl Failure {
    fn invalid(text: String) -> Self {
        Self::Refused(Error::InvalidArgument(text))
    }

    fn status(&self) -> fpt_status_code {
        match self {
            Self::Null(_) => FPT_NULL_ARGUMENT,
            Self::Refused(Error::InvalidArgument(_)) => FPT_INVALID_ARGUMENT,
            Self::Refused(Error::Unsupported(_)) => FPT_UNSUPPORTED,
            Self::Refused(Error::OutOfMemory) => FPT_OUT_OF_MEMORY,
            Self::Refused(Error::Cancelled) | Self::Stopped(_) => FPT_CANCELLED,
            Self::Budget(_) => FPT_BUDGET_EXHAUSTED,
            Self::Internal(_) => FPT_INTERNAL,
        }
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Null(name) => write!(f, "{name}: must not be NULL"),
            Self::Refused(error) => error.fmt(f),
            Self::Budget(text) | Self::Stopped(text) => f.write_str(text),
            Self::Internal(text) => write!(f, "internal error, please report: {text}"),
        }
    }
}

/// The fence around every fallible function: no panic leaves, every failure leaves its text.
fn guard(body: impl FnOnce() -> Result<(), Failure>) -> fpt_status {
    // A handle is never changed after `_new` and the index is published only when complete, so a
    // body that unwound leaves nothing half-made behind.
    let outcome = catch_unwind(AssertUnwindSafe(body));
    let failure = match outcome {
        Ok(Ok(())) => return FPT_OK as fpt_status,
        Ok(Err(failure)) => failure,
        Err(payload) => Failure::Internal(panic_text(payload)),
    };
    remember(&failure);
    failure.status() as fpt_status
}

/// The message of a panic. A payload of another type is leaked: its destructor could panic again.
fn panic_text(payload: Box<dyn Any + Send>) -> String {
    match payload.downcast::<String>() {
        Ok(text) => *text,
        Err(other) => match other.downcast::<&'static str>() {
            Ok(text) => (*text).to_owned(),
            Err(unknown) => {
                std::mem::forget(unknown);
                "a panic without a text".to_owned()
            }
        },
    }
}

/// Longest text of a failure, with its closing NUL; longer ones are cut. Fixed, so that reporting
/// "out of memory" needs no memory.
const TEXT_CAPACITY: usize = 512;

struct Text {
    bytes: [u8; TEXT_CAPACITY],
    length: usize,
}

impl Write for Text {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        let taken = fitting(text, TEXT_CAPACITY - 1 - self.length);
        self.bytes[self.length..self.length + taken].copy_from_slice(&text.as_bytes()[..taken]);
        self.length += taken;
        self.bytes[self.length] = 0;
        if taken == text.len() { Ok(()) } else { Err(fmt::Error) }
    }
}

/// The longest beginning of `text` of at most `room` bytes that ends between two characters.
fn fitting(text: &str, room: usize) -> usize {
    (0..=room.min(text.len())).rev().find(|&end| text.is_char_boundary(end)).unwrap_or(0)
}

thread_local! {
    static LAST_ERROR: UnsafeCell<Text> =
        const { UnsafeCell::new(Text { bytes: [0; TEXT_CAPACITY], length: 0 }) };
}

fn remember(failure: &Failure) {
    LAST_ERROR.with(|cell| {
        // SAFETY: the cell belongs to this thread, no reference to it outlives this closure, and the
        // formatting below calls no function that could come back here.
        let text = unsafe { &mut *cell.get() };
        (text.length, text.bytes[0]) = (0, 0);
        // An error means that the text was cut: what fits is kept.
        let _ = write!(text, "{failure}");
    });
}

/// The text of the calling thread's last failure, "" when there was none. It names the parameter and
/// the index, for example "poles: pole 17 is not finite". Never NULL. A call that succeeds leaves it.
/// Valid until the same thread's next failure or its end; copy it to keep it.
/// @since 0.1
#[unsafe(no_mangle)]
pub extern "C" fn fpt_last_error() -> *const c_char {
    LAST_ERROR.with(|cell| cell.get().cast_const().cast())
}

/// The name of a status, for example "FPT_INVALID_ARGUMENT"; "FPT_?" for a number that is none.
/// A constant of the library: never NULL, never freed.
/// @since 0.1
#[unsafe(no_mangle)]
pub extern "C" fn fpt_status_name(status: fpt_status) -> *const c_char {
    status_name(status).as_ptr()
}

fn status_name(status: fpt_status) -> &'static CStr {
    const NAMES: [(fpt_status_code, &CStr); 8] = [
        (FPT_OK, c"FPT_OK"),
        (FPT_NULL_ARGUMENT, c"FPT_NULL_ARGUMENT"),
        (FPT_INVALID_ARGUMENT, c"FPT_INVALID_ARGUMENT"),
        (FPT_BUDGET_EXHAUSTED, c"FPT_BUDGET_EXHAUSTED"),
        (FPT_CANCELLED, c"FPT_CANCELLED"),
        (FPT_UNSUPPORTED, c"FPT_UNSUPPORTED"),
        (FPT_OUT_OF_MEMORY, c"FPT_OUT_OF_MEMORY"),
        (FPT_INTERNAL, c"FPT_INTERNAL"),
    ];
    let found = NAMES.iter().find(|(code, _)| *code as fpt_status == status);
    found.map_or(c"FPT_?", |(_, name)| name)
}

/// The version of the library in use: major*1000000 + minor*1000 + patch, as FPT_VERSION of the header.
/// @since 0.1
#[unsafe(no_mangle)]
pub extern "C" fn fpt_version() -> u32 {
    MAJOR * 1_000_000 + MINOR * 1_000 + number(env!("CARGO_PKG_VERSION_PATCH"))
}

/// The binary interface of the library in use: the number in its SONAME, written as one integer. The
/// SONAME is 0.MINOR while the major version is 0 and this returns MINOR; from 1.0 on the SONAME is
/// MAJOR and this returns major*1000. A program may use the library when this equals the
/// FPT_ABI_VERSION that it was compiled with.
/// @since 0.1
#[unsafe(no_mangle)]
pub extern "C" fn fpt_abi_version() -> u32 {
    if MAJOR == 0 { MINOR } else { MAJOR * 1_000 }
}

const MAJOR: u32 = number(env!("CARGO_PKG_VERSION_MAJOR"));
const MINOR: u32 = number(env!("CARGO_PKG_VERSION_MINOR"));

const fn number(digits: &str) -> u32 {
    let (bytes, mut value, mut i) = (digits.as_bytes(), 0, 0);
    while i < bytes.len() {
        value = value * 10 + (bytes[i] - b'0') as u32;
        i += 1;
    }
    value
}

/// Panics on purpose inside the fence, in one record of a batch on `threads` threads: with several of them on one
/// that is not the caller's.
/// Only with the feature "panic-test", never in a shipped library, and not in the header: a test
/// declares it as `int32_t fpt_panic_test(uint32_t threads)`.
///
/// cbindgen:ignore
#[cfg(feature = "panic-test")]
#[unsafe(no_mangle)]
pub extern "C" fn fpt_panic_test(threads: u32) -> fpt_status {
    guard(|| {
        let unreached = crate::closest::FootPoint::unreached();
        let mut out = [unreached; 1024];
        // Not in the first tile.
        let work = |i, _: &mut crate::closest::Workspace| {
            if i == 200 { panic!("record {i} panics on purpose") } else { unreached }
        };
        Ok(crate::batch::run(&mut out, threads as usize, None, &work, &mut |_| false)?)
    })
}
