//! Inspection: options and records.

use super::Failure;
use super::options::{SelfSized, sized};
use crate::inspect::{Directed, Measured};
use std::ffi::{c_int, c_void};
use std::mem::{offset_of, size_of};

/// A quantity of curvature, for fpt_inspect_surface_range.
#[repr(C)]
#[derive(Clone, Copy)]
pub enum fpt_inspect_quantity {
    /// The greater principal curvature, 1 / length. Positive: the surface bends towards S_u x S_v.
    FPT_QUANTITY_GREATER = 0,
    /// The less principal curvature, 1 / length.
    FPT_QUANTITY_LESS = 1,
    /// Half their sum, 1 / length.
    FPT_QUANTITY_MEAN = 2,
    /// Their product, 1 / area.
    FPT_QUANTITY_GAUSSIAN = 3,
    /// The greatest absolute normal curvature, 1 / length: its reciprocal is the least radius of curvature.
    FPT_QUANTITY_SHARPEST = 4,
}

/// Which extremes of a range are looked for, for fpt_inspect_options.side.
#[repr(C)]
#[derive(Clone, Copy)]
pub enum fpt_inspect_side {
    /// The least value and the greatest.
    FPT_SIDE_BOTH = 0,
    /// The least one.
    FPT_SIDE_LEAST = 1,
    /// The greatest one: of FPT_QUANTITY_SHARPEST that is the least radius, in half the time or less.
    FPT_SIDE_GREATEST = 2,
}

/// What a picture shows, for fpt_inspect_picture_options.pattern.
#[repr(C)]
#[derive(Clone, Copy)]
pub enum fpt_inspect_pattern {
    /// Plain shading.
    FPT_PATTERN_SHADED = 0,
    /// Stripes of a surrounding striped room, seen in the surface.
    FPT_PATTERN_ZEBRA = 1,
    /// Bands of equal angle between normal and light.
    FPT_PATTERN_ISOPHOTES = 2,
    /// Bands where the reflection of the view meets parallel lamps.
    FPT_PATTERN_REFLECTION_LINES = 3,
    /// Bands where the normal line passes parallel lamps.
    FPT_PATTERN_HIGHLIGHT_LINES = 4,
    /// Colours of the greater principal curvature.
    FPT_PATTERN_GREATER = 5,
    /// Colours of the less principal curvature.
    FPT_PATTERN_LESS = 6,
    /// Colours of the mean curvature.
    FPT_PATTERN_MEAN = 7,
    /// Colours of the Gaussian curvature.
    FPT_PATTERN_GAUSSIAN = 8,
}

/// What a place of a set is, for fpt_inspect_place.kind.
#[repr(C)]
#[derive(Clone, Copy)]
pub enum fpt_inspect_kind {
    /// The curvature grows along the piece.
    FPT_PLACE_RISING = 0,
    /// It falls.
    FPT_PLACE_FALLING = 1,
    /// It is the same up to rounding.
    FPT_PLACE_CONSTANT = 2,
    /// Neither could be shown.
    FPT_PLACE_UNKNOWN = 3,
    /// The curve changes the side to which it bends.
    FPT_PLACE_INFLECTION = 4,
    /// The curve is straight there, and whether it changes sides is not shown.
    FPT_PLACE_STRAIGHT = 5,
    /// A small box outside of which, and of the others, principal curvatures differ.
    FPT_PLACE_UMBILIC = 6,
    /// A large such box: a line or an area of umbilics, or the budget ran out.
    FPT_PLACE_UMBILIC_AREA = 7,
    /// A box that a range excludes and in which the quantity has no bound, proven: a tip, a cusp, a cross-cap (partials that are parallel).
    FPT_PLACE_UNBOUNDED = 8,
    /// A box that a range excludes and of which nothing is proven.
    FPT_PLACE_EXCLUDED = 9,
}

/// What is proven of a range that excludes a part of the domain: bits of fpt_inspect_range.flags.
#[repr(C)]
#[derive(Clone, Copy)]
pub enum fpt_inspect_range_flag {
    /// In an excluded box the quantity falls below every number.
    FPT_RANGE_LEAST_UNBOUNDED = 1,
    /// In an excluded box the quantity exceeds every number: of FPT_QUANTITY_SHARPEST, the least radius is 0.
    FPT_RANGE_GREATEST_UNBOUNDED = 2,
    /// Outside of the excluded boxes both gaps are the allowed ones.
    FPT_RANGE_REST_PROVEN = 4,
}

/// How far an inspection goes. Fill it with fpt_inspect_options_init. Grows at the end only.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct fpt_inspect_options {
    /// sizeof(fpt_inspect_options), set by fpt_inspect_options_init.
    pub struct_size: usize,
    /// Ranges and umbilics: only the part u0,u1,v0,v1; all 0: the whole domain. On a curve only u0,u1 count.
    pub domain: [f64; 4],
    /// Ranges: allowed gap between the two bounds of an extreme, as a share of its size or of what a sphere as large as the shape
    /// has; above 0, at most 1. Default 1e-3.
    pub relative: f64,
    /// Distances: allowed gap between the bounds, length; 0: 1e-3 of the diagonal of the first shape's box.
    pub accuracy: f64,
    /// Boxes at most; 0: the default, 200000 (ranges, umbilics), 50000 (distances).
    pub budget: u64,
    /// Asked on the calling thread now and then; non-zero ends the call with FPT_CANCELLED. NULL: never.
    pub should_stop: Option<unsafe extern "C" fn(user: *mut c_void) -> c_int>,
    /// Handed to should_stop as it is.
    pub user: *mut c_void,
    /// Ranges: a value of fpt_inspect_side, which extremes must have the gap; bounds of the other one are true, but loose.
    pub side: u32,
    /// Must be 0.
    pub reserved: u32,
}

// SAFETY: repr(C), begins with struct_size; numbers, raw pointers and nullable function pointers.
unsafe impl SelfSized for fpt_inspect_options {
    const SHORTER: &'static [usize] = &[];

    fn defaults() -> Self {
        Self {
            struct_size: size_of::<Self>(),
            domain: [0.0; 4],
            relative: 1e-3,
            accuracy: 0.0,
            budget: 0,
            should_stop: None,
            user: std::ptr::null_mut(),
            side: fpt_inspect_side::FPT_SIDE_BOTH as u32,
            reserved: 0,
        }
    }
}

/// How a picture is made. Fill it with fpt_inspect_picture_options_init. Grows at the end only.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct fpt_inspect_picture_options {
    /// sizeof(fpt_inspect_picture_options), set by fpt_inspect_picture_options_init.
    pub struct_size: usize,
    /// A value of fpt_inspect_pattern.
    pub pattern: u32,
    /// Bands over the range of what they show, 1 to 1000. Default 16.
    pub bands: u32,
    /// Pixels in a row, 1 to 8192. Default 640.
    pub width: u32,
    /// Rows, 1 to 8192. Default 480.
    pub height: u32,
    /// Direction from the surface towards the eye; not 0. The view is orthographic and holds the whole surface.
    pub eye: [f64; 3],
    /// What is up in the picture; not 0, not the direction of the eye.
    pub up: [f64; 3],
    /// Direction from the surface towards the light, and towards the plane of the lamps; not 0.
    pub light: [f64; 3],
    /// Values of the ends of the colours of curvature; both 0: the range of what is seen, but for a hundredth at either end.
    pub range: [f64; 2],
}

// SAFETY: repr(C), begins with struct_size; numbers.
unsafe impl SelfSized for fpt_inspect_picture_options {
    const SHORTER: &'static [usize] = &[];

    fn defaults() -> Self {
        let core = crate::inspect::PictureOptions::default();
        Self {
            struct_size: size_of::<Self>(),
            pattern: fpt_inspect_pattern::FPT_PATTERN_SHADED as u32,
            bands: core.bands as u32,
            width: core.size[0] as u32,
            height: core.size[1] as u32,
            eye: core.eye,
            up: core.up,
            light: core.light,
            range: core.range,
        }
    }
}

/// The least and the greatest value of a quantity, each between two bounds: 96 bytes, frozen.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fpt_inspect_range {
    /// Nothing is less than the first; something is not greater than the second.
    pub least: [f64; 2],
    /// Something is not less than the first; nothing is greater than the second.
    pub greatest: [f64; 2],
    /// Parameters where the inner bound of the least is attained; curves: u, 0.
    pub at_least: [f64; 2],
    /// Parameters where the inner bound of the greatest is attained; curves: u, 0.
    pub at_greatest: [f64; 2],
    /// Share of the domain that is left out: beside tips and cusps, where curvatures are not bounded. The bounds hold for the rest;
    /// flags tells what is proven of the part that is left out, fpt_inspect_surface_range_places where it is.
    pub excluded: f64,
    /// Length. 0: the bounds are those of the shape. Otherwise those of a shape from which no point of this one is farther, which is
    /// rounding: beside a pole the rounding of its coordinates alone makes curvatures infinite.
    pub moved: f64,
    /// Boxes looked at.
    pub boxes: u64,
    /// 1: both gaps are the allowed ones and nothing is excluded.
    pub proven: u32,
    /// Bits of fpt_inspect_range_flag: what is proven of tips and cusps, and of the rest.
    pub flags: u32,
}

/// A tooth of a curvature comb: 96 bytes, frozen.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fpt_inspect_tooth {
    /// Parameter.
    pub u: f64,
    /// The point.
    pub point: [f64; 3],
    /// Unit tangent; 0 where the derivative vanishes.
    pub tangent: [f64; 3],
    /// Curvature times the unit normal: towards the centre of curvature.
    pub bend: [f64; 3],
    /// 1 / length, >= 0.
    pub curvature: f64,
    /// 1 / length; 0 where the curvature vanishes.
    pub torsion: f64,
}

/// The curvatures at one place of a surface: 136 bytes, frozen. All NaN but the last two where the parametrisation is singular.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fpt_inspect_curvature {
    /// The point.
    pub point: [f64; 3],
    /// Unit normal, along S_u x S_v.
    pub normal: [f64; 3],
    /// Greater and less principal curvature; positive: towards the normal.
    pub principal: [f64; 2],
    /// Unit direction of the greater one, then of the less.
    pub directions: [f64; 6],
    /// Half their sum.
    pub mean: f64,
    /// Their product.
    pub gaussian: f64,
    /// 1: they are equal up to rounding, and the directions any.
    pub is_umbilic: u32,
    /// 1: the parametrisation is singular.
    pub is_singular: u32,
}

/// A place or a piece: 56 bytes, frozen.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fpt_inspect_place {
    /// First and last u of the piece or box.
    pub u: [f64; 2],
    /// First and last v; curves: 0.
    pub v: [f64; 2],
    /// Monotone pieces: curvature at both ends. Inflections: the parameter, 0. Umbilics: difference of the principal curvatures at
    /// the best place found, 0. FPT_PLACE_UNBOUNDED: the place u,v in the box near which every bound is passed.
    pub value: [f64; 2],
    /// A value of fpt_inspect_kind.
    pub kind: u32,
    /// 0.
    pub reserved: u32,
}

/// A greatest value and its bounds: 24 bytes, frozen.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fpt_inspect_measured {
    /// Found somewhere.
    pub lower: f64,
    /// Nowhere more, proven.
    pub upper: f64,
    /// Parameter of the first border where the lower one is.
    pub at: f64,
}

/// How two surfaces meet: 80 bytes, frozen.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fpt_inspect_continuity {
    /// Greatest distance of a point of the first border from the second, length.
    pub gap: fpt_inspect_measured,
    /// Greatest angle of the normals, radians, 0 to pi / 2; orientations do not count.
    pub angle: fpt_inspect_measured,
    /// Greatest difference of the normal curvatures across the border, 1 / length.
    pub curvature: fpt_inspect_measured,
    /// Intervals looked at.
    pub intervals: u64,
}

/// The greatest distance of a point of one shape from another: 48 bytes, frozen.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fpt_inspect_distance {
    /// Some point is not nearer than this to the other shape.
    pub lower: f64,
    /// No point is farther than this from the other shape.
    pub upper: f64,
    /// Parameters of that point; curves: u, 0.
    pub at: [f64; 2],
    /// Boxes looked at.
    pub boxes: u64,
    /// 1: the gap is the allowed one.
    pub proven: u32,
    /// 0.
    pub reserved: u32,
}

const _: () = {
    assert!(size_of::<fpt_inspect_range>() == 96 && size_of::<fpt_inspect_tooth>() == 96);
    assert!(size_of::<fpt_inspect_curvature>() == 136 && size_of::<fpt_inspect_place>() == 56);
    assert!(size_of::<fpt_inspect_continuity>() == 80 && size_of::<fpt_inspect_distance>() == 48);
    assert!(offset_of!(fpt_inspect_curvature, is_umbilic) == 128);
};

impl From<Measured> for fpt_inspect_measured {
    fn from(measured: Measured) -> Self {
        Self { lower: measured.lower, upper: measured.upper, at: measured.at }
    }
}

impl From<Directed> for fpt_inspect_distance {
    fn from(directed: Directed) -> Self {
        Self {
            lower: directed.lower,
            upper: directed.upper,
            at: directed.at,
            boxes: directed.boxes,
            proven: directed.proven.into(),
            reserved: 0,
        }
    }
}

/// Writes the defaults over `struct_size` bytes.
///
/// # Safety
/// NULL, or room for `struct_size` bytes.
pub(super) unsafe fn initialise<T: SelfSized>(options: *mut T, struct_size: usize) {
    if options.is_null() || struct_size < size_of::<usize>() {
        return;
    }
    let known = struct_size.min(size_of::<T>());
    let defaults = T::defaults();
    let source = (&raw const defaults).cast::<u8>();
    let target = options.cast::<u8>();
    // SAFETY: the caller's struct has `struct_size` bytes; these structs have no padding, and begin with their size.
    unsafe {
        source.copy_to_nonoverlapping(target, known);
        target.add(known).write_bytes(0, struct_size - known);
        target.cast::<usize>().write_unaligned(struct_size);
    }
}

/// The caller's struct, or the defaults for NULL.
///
/// # Safety
/// As [`sized`].
pub(super) unsafe fn sized_or_default<T: SelfSized>(
    name: &'static str,
    options: *const T,
) -> Result<T, Failure> {
    if options.is_null() {
        return Ok(T::defaults());
    }
    // SAFETY: the caller vouches for it.
    unsafe { sized(name, options) }
}

/// Fills `options` with the defaults. Touches exactly struct_size bytes: pass sizeof *options.
/// Does nothing when `options` is NULL or struct_size is smaller than a size_t.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_inspect_options_init(
    options: *mut fpt_inspect_options,
    struct_size: usize,
) {
    // SAFETY: the caller's struct has `struct_size` bytes.
    unsafe { initialise(options, struct_size) }
}

/// Fills `options` with the defaults. Touches exactly struct_size bytes: pass sizeof *options.
/// Does nothing when `options` is NULL or struct_size is smaller than a size_t.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_inspect_picture_options_init(
    options: *mut fpt_inspect_picture_options,
    struct_size: usize,
) {
    // SAFETY: the caller's struct has `struct_size` bytes.
    unsafe { initialise(options, struct_size) }
}

/// The meaning of a number that C gave for a choice.
pub(super) fn choice<T: Copy>(
    name: &str,
    number: u32,
    choices: &[(u32, T)],
    kind: &str,
) -> Result<T, Failure> {
    let found = choices.iter().find(|(code, _)| *code == number);
    let unknown = || Failure::invalid(format!("{name}: {number} is not {kind}"));
    found.map(|&(_, meaning)| meaning).ok_or_else(unknown)
}
