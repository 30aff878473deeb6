//! The caller's memory: pointers, counts and strides are checked here before anything is read.
//!
//! Two shapes of input: a packed array, read in place as a slice, and a strided one, read number by
//! number through [`Strided`], which needs no alignment. Outputs are packed arrays.

use super::Failure;
use std::marker::PhantomData;
use std::mem::{align_of, size_of};

/// The object behind a pointer that must not be NULL.
///
/// # Safety
/// A pointer that is not NULL points to a live `T` that nobody changes during `'a`.
pub(super) unsafe fn shared<'a, T>(
    name: &'static str,
    pointer: *const T,
) -> Result<&'a T, Failure> {
    // SAFETY: the caller vouches for every pointer that is not NULL.
    unsafe { pointer.as_ref() }.ok_or(Failure::Null(name))
}

/// A packed array of `count` elements; NULL is allowed when `count` is 0.
///
/// # Safety
/// A pointer that is not NULL points to `count` values of `T` that nobody changes during `'a`.
pub(super) unsafe fn array<'a, T>(
    name: &'static str,
    pointer: *const T,
    count: usize,
) -> Result<&'a [T], Failure> {
    check_array(name, pointer, count)?;
    if count == 0 {
        return Ok(&[]);
    }
    // SAFETY: not NULL, aligned and no larger than an object can be; the caller vouches for the rest.
    Ok(unsafe { std::slice::from_raw_parts(pointer, count) })
}

/// A packed array to write; NULL is allowed when `count` is 0. `T` must be a type of which every
/// bit pattern is a value, because the caller need not have written the memory before.
///
/// # Safety
/// A pointer that is not NULL points to room for `count` values of `T` that only this call uses.
pub(super) unsafe fn output<'a, T>(
    name: &'static str,
    pointer: *mut T,
    count: usize,
) -> Result<&'a mut [T], Failure> {
    check_array(name, pointer, count)?;
    if count == 0 {
        return Ok(&mut []);
    }
    // SAFETY: not NULL, aligned and no larger than an object can be; the caller vouches for the rest.
    Ok(unsafe { std::slice::from_raw_parts_mut(pointer, count) })
}

/// Room for one value.
///
/// # Safety
/// As [`output`], for one value.
pub(super) unsafe fn place<'a, T>(
    name: &'static str,
    pointer: *mut T,
) -> Result<&'a mut T, Failure> {
    check_array(name, pointer, 1)?;
    // SAFETY: not NULL and aligned; the caller vouches for the rest.
    Ok(unsafe { &mut *pointer })
}

fn check_array<T>(name: &'static str, pointer: *const T, count: usize) -> Result<(), Failure> {
    if count == 0 {
        return Ok(());
    }
    if pointer.is_null() {
        return Err(Failure::Null(name));
    }
    if !pointer.is_aligned() {
        let text = format!("{name}: must be aligned to {} bytes", align_of::<T>());
        return Err(Failure::invalid(text));
    }
    check_extent(name, count, size_of::<T>())
}

/// More bytes than any array has: 64-bit machines address at most 2^56 bytes of a program's own memory. A
/// count beyond that is a mistake of the caller, often a negative number, and nothing is read.
const MAX_BYTES: usize = if usize::BITS < 64 { isize::MAX as usize } else { 1 << 56 };

/// Refuses counts whose array does not fit into memory.
pub(super) fn check_extent(name: &str, count: usize, bytes_each: usize) -> Result<(), Failure> {
    match count.checked_mul(bytes_each) {
        Some(bytes) if bytes <= MAX_BYTES => Ok(()),
        _ => Err(Failure::invalid(format!("{name}: {count} elements overflow the address space"))),
    }
}

/// As [`array()`], but NULL means that there is none.
///
/// # Safety
/// As [`array()`].
pub(super) unsafe fn optional_array<'a, T>(
    name: &'static str,
    pointer: *const T,
    count: usize,
) -> Result<Option<&'a [T]>, Failure> {
    if pointer.is_null() {
        return Ok(None);
    }
    // SAFETY: the caller vouches for it.
    unsafe { array(name, pointer, count) }.map(Some)
}

/// As [`output`], but NULL means that it is not wanted.
///
/// # Safety
/// As [`output`].
pub(super) unsafe fn optional_output<'a, T>(
    name: &'static str,
    pointer: *mut T,
    count: usize,
) -> Result<Option<&'a mut [T]>, Failure> {
    if pointer.is_null() {
        return Ok(None);
    }
    // SAFETY: the caller vouches for it.
    unsafe { output(name, pointer, count) }.map(Some)
}

/// Writes one value.
///
/// # Safety
/// As [`output`], for one value.
pub(super) unsafe fn write<T: Copy>(
    name: &'static str,
    value: T,
    out: *mut T,
) -> Result<(), Failure> {
    // SAFETY: the caller vouches for it.
    *unsafe { place(name, out) }? = value;
    Ok(())
}

/// Copies `values` to the beginning of the caller's array.
///
/// # Safety
/// As [`output`], for `capacity` numbers.
pub(super) unsafe fn write_array(
    name: &'static str,
    values: &[f64],
    capacity: usize,
    out: *mut f64,
) -> Result<(), Failure> {
    check_capacity(values.len(), capacity)?;
    // SAFETY: the caller vouches for `capacity` numbers, and there are no more than that.
    unsafe { output(name, out, values.len()) }?.copy_from_slice(values);
    Ok(())
}

/// Writes the weights of `count` poles, all 1 for a polynomial shape.
///
/// # Safety
/// As [`write_array`].
pub(super) unsafe fn write_weights(
    weights: Option<&[f64]>,
    count: usize,
    capacity: usize,
    out: *mut f64,
) -> Result<(), Failure> {
    check_capacity(count, capacity)?;
    // SAFETY: the caller vouches for `capacity` numbers, and there are no more than that.
    let out = unsafe { output("out_weights", out, count) }?;
    match weights {
        Some(weights) => out.copy_from_slice(weights),
        None => out.fill(1.0),
    }
    Ok(())
}

fn check_capacity(needed: usize, capacity: usize) -> Result<(), Failure> {
    if capacity >= needed {
        return Ok(());
    }
    Err(Failure::invalid(format!(
        "capacity: {capacity} is less than the {needed} numbers asked for"
    )))
}

/// `a * b` entries of an array, refused when the product overflows.
pub(super) fn product(name: &'static str, a: usize, b: usize) -> Result<usize, Failure> {
    let overflow = || Failure::invalid(format!("{name}: {a} x {b} elements overflow"));
    a.checked_mul(b).ok_or_else(overflow)
}

/// Query points in memory, x,y,z each, in either precision.
#[derive(Clone, Copy)]
pub(super) enum Points {
    Doubles(*const f64),
    Floats(*const f32),
}

impl From<*const f64> for Points {
    fn from(pointer: *const f64) -> Self {
        Self::Doubles(pointer)
    }
}

impl From<*const f32> for Points {
    fn from(pointer: *const f32) -> Self {
        Self::Floats(pointer)
    }
}

/// Rows of `N` doubles or floats, a fixed number of bytes apart, anywhere in memory.
#[derive(Clone, Copy, Debug)]
pub(super) struct Strided<'a, const N: usize> {
    base: *const u8,
    stride: usize,
    count: usize,
    are_floats: bool,
    borrowed: PhantomData<&'a [u8]>,
}

// SAFETY: rows are only read, and the maker vouched that nobody changes them during `'a`.
unsafe impl<const N: usize> Sync for Strided<'_, N> {}

impl<'a, const N: usize> Strided<'a, N> {
    /// `stride` in bytes, 0 for packed rows. Names the array and the stride in what it refuses.
    ///
    /// # Safety
    /// A pointer that is not NULL points to `count` rows, `stride` bytes apart, that nobody changes
    /// during `'a`.
    pub(super) unsafe fn new(
        (name, pointer): (&'static str, impl Into<Points>),
        count: usize,
        (stride_name, stride): (&'static str, usize),
    ) -> Result<Self, Failure> {
        let (base, each, are_floats) = match pointer.into() {
            Points::Doubles(pointer) => (pointer.cast::<u8>(), size_of::<f64>(), false),
            Points::Floats(pointer) => (pointer.cast::<u8>(), size_of::<f32>(), true),
        };
        let packed = N * each;
        let stride = if stride == 0 { packed } else { stride };
        // No division: it would take as long as all else that a call with one query reads.
        if stride < packed || stride & (each - 1) != 0 {
            let text =
                format!("{stride_name}: {stride} is not a multiple of {each} of at least {packed}");
            return Err(Failure::invalid(text));
        }
        if count > 0 && base.is_null() {
            return Err(Failure::Null(name));
        }
        check_extent(name, count, stride)?;
        Ok(Self { base, stride, count, are_floats, borrowed: PhantomData })
    }

    pub(super) fn len(&self) -> usize {
        self.count
    }

    pub(super) fn row(&self, i: usize) -> [f64; N] {
        assert!(i < self.count, "row {i} of {}", self.count);
        // SAFETY: row `i` exists, `new` checked that its offset is no overflow, and the reads need no
        // alignment.
        unsafe {
            let row = self.base.add(i * self.stride);
            if self.are_floats {
                row.cast::<[f32; N]>().read_unaligned().map(f64::from)
            } else {
                row.cast::<[f64; N]>().read_unaligned()
            }
        }
    }
}
