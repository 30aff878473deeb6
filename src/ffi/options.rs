//! Option structs: sized reading, defaults, and the checks that turn them into [`QueryOptions`].
//!
//! A struct begins with its own size, so that one library serves callers of older and newer headers:
//!
//! ```text
//!   caller's struct  |struct_size|....known....|..tail..|
//!   this version's   |struct_size|....known....|              tail all zero: ignored, else unsupported
//!   shorter caller   |struct_size|..|                         ends between two fields: defaults for the rest
//! ```

use super::Failure;
use crate::closest::{QueryOptions, Scope};
use crate::error::Error;
use crate::refine::Method;
use std::ffi::{c_int, c_void};
use std::mem::{MaybeUninit, offset_of, size_of};

/// Local iteration, for fpt_query_options.method. Global answers are certified with each.
#[repr(C)]
#[derive(Clone, Copy)]
pub enum fpt_method {
    /// The best of the others, chosen by the library.
    FPT_METHOD_AUTO = 0,
    /// Moving affine frame: steps to the foot on the tangent line or plane.
    FPT_METHOD_MAF = 1,
    /// Newton's method for the stationary point of the squared distance.
    FPT_METHOD_NEWTON = 2,
    /// A second-order step along the osculating circle, on surfaces along those of both principal directions.
    FPT_METHOD_OSCULATING = 3,
}

/// What an answer is about, for fpt_query_options.scope.
#[repr(C)]
#[derive(Clone, Copy)]
pub enum fpt_scope {
    /// The whole shape (or the restricted domain), with proof.
    FPT_SCOPE_GLOBAL = 0,
    /// One local iteration from the hint, or without a hint from the published decomposition start.
    /// Answers carry FPT_FOOT_NOT_PROVEN and lower_bound 0.
    FPT_SCOPE_LOCAL = 1,
}

/// How to answer queries. Fill it with fpt_query_options_init, then change what matters. All zero after
/// struct_size is the default of everything. Grows at the end only.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct fpt_query_options {
    /// sizeof(fpt_query_options), set by fpt_query_options_init.
    pub struct_size: usize,
    /// Length, finite, >= 0. invert: points farther away are not on the shape. 0: 1e-7 x the diagonal of
    /// the shape's box.
    pub tolerance: f64,
    /// Length, finite, >= 0. The asked-for distance - lower_bound. 0: 1e-10 x the diagonal of the shape's
    /// box. Never an early stop: feet are always polished to the limit of the arithmetic.
    pub accuracy: f64,
    /// A value of fpt_method.
    pub method: u32,
    /// A value of fpt_scope.
    pub scope: u32,
    /// Start parameters, (u,v) per query on a surface, u on a curve; NULL: none. A NaN means no hint for
    /// this query, an infinity is FPT_INVALID_ARGUMENT, a parameter outside is moved to the domain.
    /// Borrowed during the call. A hint never changes the distance by more than the accuracy, nor
    /// whether an answer is proven.
    pub hints: *const f64,
    /// Bytes from one query point to the next: 0 (packed: 24) or a multiple of 8, at least 24. For points in floats
    /// (the functions that end in _f32): 0 (packed: 12) or a multiple of 4, at least 12.
    pub point_stride: usize,
    /// Bytes from one hint to the next: 0 (packed: 16 on a surface, 8 on a curve) or a multiple of 8, at
    /// least that. Looked at only with hints.
    pub hint_stride: usize,
    /// Restricts the answers to u0,u1,v0,v1 inside the domain with u0 < u1 and v0 < v1. All 0: the whole
    /// domain. On a curve only u0,u1 count.
    pub domain: [f64; 4],
    /// 0: all cores, 1: the calling thread only. Answers are the same bits for any number.
    pub threads: u32,
    /// Must be 0.
    pub reserved: u32,
    /// Nodes and subdivisions per query; 0: the default, 150 to 2,500 by degree. A query that runs out has
    /// FPT_FOOT_BUDGET.
    pub budget: u64,
    /// Asked on the calling thread now and then; non-zero ends the call with FPT_CANCELLED. NULL: never.
    pub should_stop: Option<unsafe extern "C" fn(user: *mut c_void) -> c_int>,
    /// Told on the calling thread now and then, and once at the end with done = total. While the index
    /// is built, done is 0. NULL: nobody.
    pub progress: Option<unsafe extern "C" fn(user: *mut c_void, done: usize, total: usize)>,
    /// Told each iteration on the calling thread; step 0 is the start of a refinement. Forces one thread.
    /// NULL: nobody.
    pub trace: Option<
        unsafe extern "C" fn(
            user: *mut c_void,
            query: usize,
            step: u32,
            u: f64,
            v: f64,
            residual: f64,
        ),
    >,
    /// Handed to the three callbacks as it is.
    pub user: *mut c_void,
}

impl Default for fpt_query_options {
    fn default() -> Self {
        Self {
            struct_size: size_of::<Self>(),
            tolerance: 0.0,
            accuracy: 0.0,
            method: fpt_method::FPT_METHOD_AUTO as u32,
            scope: fpt_scope::FPT_SCOPE_GLOBAL as u32,
            hints: std::ptr::null(),
            point_stride: 0,
            hint_stride: 0,
            domain: [0.0; 4],
            threads: 0,
            reserved: 0,
            budget: 0,
            should_stop: None,
            progress: None,
            trace: None,
            user: std::ptr::null_mut(),
        }
    }
}

/// A struct that begins with its size in bytes.
///
/// # Safety
/// `repr(C)`, the first field is a `usize`, and any bytes in the others are a value.
pub(super) unsafe trait SelfSized: Copy {
    /// Offsets at which an older, shorter version of the struct may end.
    const SHORTER: &'static [usize];
    /// What the fields have that a shorter struct lacks.
    fn defaults() -> Self;
}

// SAFETY: repr(C), begins with struct_size; numbers, raw pointers and nullable function pointers.
unsafe impl SelfSized for fpt_query_options {
    const SHORTER: &'static [usize] = &[
        offset_of!(Self, tolerance),
        offset_of!(Self, accuracy),
        offset_of!(Self, method),
        offset_of!(Self, scope),
        offset_of!(Self, hints),
        offset_of!(Self, point_stride),
        offset_of!(Self, hint_stride),
        offset_of!(Self, domain),
        offset_of!(Self, threads),
        offset_of!(Self, reserved),
        offset_of!(Self, budget),
        offset_of!(Self, should_stop),
        offset_of!(Self, progress),
        offset_of!(Self, trace),
        offset_of!(Self, user),
    ];

    fn defaults() -> Self {
        Self::default()
    }
}

/// Largest struct_size that is believed: a larger one is memory that nobody initialised, and its tail
/// must not be read.
const MAX_STRUCT_SIZE: usize = 4096;

/// Copies the part of the caller's struct that both sides know.
///
/// # Safety
/// A pointer that is not NULL points to a struct whose first field is its size in bytes, at least the
/// size of that field.
pub(super) unsafe fn sized<T: SelfSized>(
    name: &'static str,
    pointer: *const T,
) -> Result<T, Failure> {
    if pointer.is_null() {
        return Err(Failure::Null(name));
    }
    let bytes = pointer.cast::<u8>();
    // SAFETY: the struct begins with its size.
    let size = unsafe { bytes.cast::<usize>().read_unaligned() };
    let known = size_of::<T>();
    if size > MAX_STRUCT_SIZE || (size < known && !T::SHORTER.contains(&size)) {
        let text =
            format!("{name}: struct_size is {size}, not {known} or that of an older version");
        return Err(Failure::invalid(text));
    }
    if size == known {
        // SAFETY: the caller's struct has as many bytes as T; any bytes are a value of T (trait contract).
        return Ok(unsafe { pointer.read_unaligned() });
    }
    // SAFETY: the caller's struct has `size` bytes.
    if (known..size).any(|i| unsafe { bytes.add(i).read() } != 0) {
        let text = format!("{name}: struct_size is {size} and a field after byte {known} is set");
        return Err(Error::Unsupported(text).into());
    }
    let mut value = MaybeUninit::new(T::defaults());
    // SAFETY: both sides have min(size, known) bytes; any bytes are a value of T (trait contract).
    Ok(unsafe {
        bytes.copy_to_nonoverlapping(value.as_mut_ptr().cast(), size.min(known));
        value.assume_init()
    })
}

/// Fills `options` with the defaults. Touches exactly struct_size bytes: pass sizeof *options.
/// Does nothing when `options` is NULL or struct_size is smaller than a size_t.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_query_options_init(
    options: *mut fpt_query_options,
    struct_size: usize,
) {
    if options.is_null() || struct_size < size_of::<usize>() {
        return;
    }
    let known = struct_size.min(size_of::<fpt_query_options>());
    let defaults = fpt_query_options { struct_size, ..Default::default() };
    let source = (&raw const defaults).cast::<u8>();
    let target = options.cast::<u8>();
    // SAFETY: the caller's struct has `struct_size` bytes; `defaults` has no padding before `known`.
    unsafe {
        source.copy_to_nonoverlapping(target, known);
        target.add(known).write_bytes(0, struct_size - known);
    }
}

impl fpt_query_options {
    /// The caller's options, or the defaults for NULL.
    ///
    /// # Safety
    /// As [`sized`].
    pub(super) unsafe fn read(options: *const Self) -> Result<Self, Failure> {
        if options.is_null() {
            return Ok(Self::default());
        }
        // SAFETY: the caller vouches for it.
        unsafe { sized("options", options) }
    }

    /// Checks what concerns the engine. `used` is how many of the four domain ends count.
    pub(super) fn checked(&self, used: usize) -> Result<QueryOptions, Failure> {
        check_length("tolerance", self.tolerance)?;
        check_length("accuracy", self.accuracy)?;
        if self.reserved != 0 {
            return Err(Failure::invalid(format!("reserved: {} must be 0", self.reserved)));
        }
        Ok(QueryOptions {
            tolerance: self.tolerance,
            accuracy: self.accuracy,
            method: method(self.method)?,
            scope: scope(self.scope)?,
            domain: restriction(&self.domain[..used])?,
            budget: self.budget,
        })
    }

    /// Threads of the batch; a trace is told on the calling thread alone.
    pub(super) fn thread_count(&self) -> usize {
        if self.trace.is_some() { 1 } else { self.threads as usize }
    }
}

pub(super) fn check_length(name: &str, length: f64) -> Result<(), Failure> {
    if length.is_finite() && length >= 0.0 {
        return Ok(());
    }
    Err(Failure::invalid(format!("{name}: {length} is not a finite length of at least 0")))
}

fn method(number: u32) -> Result<Method, Failure> {
    Ok(match number {
        _ if number == fpt_method::FPT_METHOD_AUTO as u32 => Method::Auto,
        _ if number == fpt_method::FPT_METHOD_MAF as u32 => Method::Maf,
        _ if number == fpt_method::FPT_METHOD_NEWTON as u32 => Method::Newton,
        _ if number == fpt_method::FPT_METHOD_OSCULATING as u32 => Method::Osculating,
        _ => {
            return Err(Failure::invalid(format!("method: {number} is not an FPT_METHOD_ value")));
        }
    })
}

fn scope(number: u32) -> Result<Scope, Failure> {
    Ok(match number {
        _ if number == fpt_scope::FPT_SCOPE_GLOBAL as u32 => Scope::Global,
        _ if number == fpt_scope::FPT_SCOPE_LOCAL as u32 => Scope::Local,
        _ => return Err(Failure::invalid(format!("scope: {number} is not an FPT_SCOPE_ value"))),
    })
}

/// The ends that count, as four; `None` when all of them are 0.
pub(super) fn restriction(ends: &[f64]) -> Result<Option<[f64; 4]>, Failure> {
    if ends.iter().all(|&end| end == 0.0) {
        return Ok(None);
    }
    if let Some(i) = ends.iter().position(|end| !end.is_finite()) {
        return Err(Failure::invalid(format!("domain: domain[{i}] is not finite")));
    }
    let mut domain = [0.0; 4];
    domain[..ends.len()].copy_from_slice(ends);
    Ok(Some(domain))
}
