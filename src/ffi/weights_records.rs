//! Weights from wishes: choices, records, options.

use super::Failure;
use super::options::{SelfSized, check_length, sized};
use super::query::Callbacks;
use crate::weights::{ConstraintReport, Options, PoleReport, State, flag};
use std::ffi::{c_int, c_void};
use std::mem::{offset_of, size_of};

/// What came of a wish, for fpt_weights_pole.state.
#[repr(C)]
pub enum fpt_weights_state {
    /// There was none.
    FPT_WISH_NONE = 0,
    /// Proven: the distance is the wished one within the tolerance.
    FPT_WISH_MET = 1,
    /// It is not met, or that could not be proven. The weights are the best found.
    FPT_WISH_NOT_MET = 2,
    /// Proven: no weights in the range meet it, or not together with another wish, from which it differs by more than their poles are
    /// apart.
    FPT_WISH_IMPOSSIBLE = 3,
}

/// Bits of fpt_weights_pole.flags.
#[repr(C)]
pub enum fpt_weights_flag {
    /// The pole lies on its chord (an end of a clamped curve does): formula (3) says nothing, its weight is 1.
    FPT_WEIGHT_ON_CHORD = 1,
    /// Formula (3) gave a weight outside the range, or a wish beyond the chord none: the nearest end of the range was taken.
    FPT_WEIGHT_LIMITED = 2,
    /// The weight is an end of the range.
    FPT_WEIGHT_AT_LIMIT = 4,
    /// The steps of a network ran out before this pole was as wished; the nearest weight that is was taken.
    FPT_WEIGHT_UNTRAINED = 8,
}

/// What a constraint asks, for fpt_weights_constraint.kind.
#[repr(C)]
pub enum fpt_weights_constraint_kind {
    /// The point at (u,v) is `vector`.
    FPT_CONSTRAINT_POINT_AT = 0,
    /// Some point is `vector`.
    FPT_CONSTRAINT_POINT = 1,
    /// The tangent of the curve at u has the direction `vector`, of any length but 0.
    FPT_CONSTRAINT_TANGENT_AT = 2,
    /// The tangent of the curve at u has the direction that it has with the given weights.
    FPT_CONSTRAINT_TANGENT_KEPT = 3,
}

/// What a shape must do besides. 48 bytes, frozen.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fpt_weights_constraint {
    /// A value of fpt_weights_constraint_kind.
    pub kind: u32,
    /// Must be 0.
    pub reserved: u32,
    /// In the domain; not looked at by FPT_CONSTRAINT_POINT.
    pub u: f64,
    /// In the domain; not looked at by FPT_CONSTRAINT_POINT and for curves.
    pub v: f64,
    /// A point or direction; not looked at by FPT_CONSTRAINT_TANGENT_KEPT.
    pub vector: [f64; 3],
}

/// One pole's part of a report: 72 bytes, frozen.
#[repr(C)]
pub struct fpt_weights_pole {
    /// The distance asked for; NaN: none.
    pub wish: f64,
    /// L of formula (3): the distance of the pole from its chord; of a surface, from where the middle of its support would be
    /// without the pole.
    pub chord_distance: f64,
    /// The weight of formula (3), within the range; 1 without a wish.
    pub first_guess: f64,
    /// The weight found.
    pub weight: f64,
    /// Distance of the pole from the shape with the weights found.
    pub distance: f64,
    /// Proven: nothing on that shape is nearer to the pole than this.
    pub lower_bound: f64,
    /// First parameter of the nearest point.
    pub u: f64,
    /// Second parameter; 0 on a curve.
    pub v: f64,
    /// A value of fpt_weights_state.
    pub state: u32,
    /// Sum of fpt_weights_flag values.
    pub flags: u32,
}

/// What came of a constraint: 32 bytes, frozen.
#[repr(C)]
pub struct fpt_weights_outcome {
    /// Distance from the point, or sine of the angle between tangent and direction (2: the opposite direction).
    pub error: f64,
    /// Where on the shape.
    pub u: f64,
    /// Second parameter; 0 on a curve.
    pub v: f64,
    /// 1: within the tolerance, of a direction within 1e-9; 0: not.
    pub met: u32,
    /// 0.
    pub reserved: u32,
}

/// A report in a few numbers: 48 bytes, frozen.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fpt_weights_summary {
    /// The length within which a distance is the wished one.
    pub tolerance: f64,
    /// Training steps of a network, shapes that a refinement measured; 0 for a formula.
    pub iterations: u64,
    /// Searches that a refinement began.
    pub starts: u32,
    /// 1: every wish and every constraint is met.
    pub is_met: u32,
    /// Wishes met.
    pub met: u64,
    /// Wishes not met, those that are impossible not counted.
    pub not_met: u64,
    /// Wishes proven impossible.
    pub impossible: u64,
}

// Records are copied out as they are: the layouts must agree.
const _: () = {
    assert!(size_of::<fpt_weights_pole>() == 72 && size_of::<PoleReport>() == 72);
    assert!(offset_of!(fpt_weights_pole, wish) == offset_of!(PoleReport, wish));
    assert!(offset_of!(fpt_weights_pole, chord_distance) == offset_of!(PoleReport, chord_distance));
    assert!(offset_of!(fpt_weights_pole, first_guess) == offset_of!(PoleReport, first_guess));
    assert!(offset_of!(fpt_weights_pole, weight) == offset_of!(PoleReport, weight));
    assert!(offset_of!(fpt_weights_pole, distance) == offset_of!(PoleReport, distance));
    assert!(offset_of!(fpt_weights_pole, lower_bound) == offset_of!(PoleReport, lower_bound));
    assert!(offset_of!(fpt_weights_pole, u) == offset_of!(PoleReport, u));
    assert!(offset_of!(fpt_weights_pole, v) == offset_of!(PoleReport, v));
    assert!(offset_of!(fpt_weights_pole, state) == offset_of!(PoleReport, state));
    assert!(offset_of!(fpt_weights_pole, flags) == offset_of!(PoleReport, flags));
    assert!(size_of::<fpt_weights_outcome>() == 32 && size_of::<ConstraintReport>() == 32);
    assert!(offset_of!(fpt_weights_outcome, error) == offset_of!(ConstraintReport, error));
    assert!(offset_of!(fpt_weights_outcome, met) == offset_of!(ConstraintReport, met));
    assert!(size_of::<fpt_weights_constraint>() == 48 && size_of::<fpt_weights_summary>() == 48);
    assert!(fpt_weights_state::FPT_WISH_NONE as u32 == State::None as u32);
    assert!(fpt_weights_state::FPT_WISH_MET as u32 == State::Met as u32);
    assert!(fpt_weights_state::FPT_WISH_NOT_MET as u32 == State::NotMet as u32);
    assert!(fpt_weights_state::FPT_WISH_IMPOSSIBLE as u32 == State::Impossible as u32);
    assert!(fpt_weights_flag::FPT_WEIGHT_ON_CHORD as u32 == flag::ON_CHORD);
    assert!(fpt_weights_flag::FPT_WEIGHT_LIMITED as u32 == flag::LIMITED);
    assert!(fpt_weights_flag::FPT_WEIGHT_AT_LIMIT as u32 == flag::AT_LIMIT);
    assert!(fpt_weights_flag::FPT_WEIGHT_UNTRAINED as u32 == flag::UNTRAINED);
};

/// How to look for weights. Fill it with fpt_weights_options_init, then change what matters. All zero after struct_size is the
/// default of everything. Grows at the end only.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct fpt_weights_options {
    /// sizeof(fpt_weights_options), set by fpt_weights_options_init.
    pub struct_size: usize,
    /// Least weight, 1e-12 to 1e12; 0: 0.01.
    pub weight_min: f64,
    /// Greatest weight, 1e-12 to 1e12; 0: 100.
    pub weight_max: f64,
    /// Greatest weight over least weight, >= 1; 0: no limit but that of the two above.
    pub ratio_limit: f64,
    /// Length, finite, >= 0: how far a distance may be from its wish. 0: 1e-9 x the diagonal of the poles' box. Less than about 1e-11 of
    /// it cannot be proven.
    pub tolerance: f64,
    /// 1: refinement keeps the weights of opposite poles equal (of a surface in both directions); 0: not.
    pub symmetric: u32,
    /// Most training steps of a network; 0: 1,000.
    pub steps: u32,
    /// Most searches of a refinement; 0: 2,000. One or a few are enough when the wishes exist; each takes 0.1 ms to 1 ms for a curve.
    pub starts: u32,
    /// Must be 0.
    pub reserved: u32,
    /// Seed of the random numbers of networks and of starts. Equal inputs and seeds give equal bits.
    pub seed: u64,
    /// Asked on the calling thread before each search of a refinement; non-zero ends the call with FPT_CANCELLED. NULL: never.
    pub should_stop: Option<unsafe extern "C" fn(user: *mut c_void) -> c_int>,
    /// Handed to should_stop as it is.
    pub user: *mut c_void,
}

impl Default for fpt_weights_options {
    fn default() -> Self {
        Self {
            struct_size: size_of::<Self>(),
            weight_min: 0.0,
            weight_max: 0.0,
            ratio_limit: 0.0,
            tolerance: 0.0,
            symmetric: 0,
            steps: 0,
            starts: 0,
            reserved: 0,
            seed: 0,
            should_stop: None,
            user: std::ptr::null_mut(),
        }
    }
}

// SAFETY: repr(C), begins with struct_size; numbers, a raw pointer and a nullable function pointer.
unsafe impl SelfSized for fpt_weights_options {
    const SHORTER: &'static [usize] = &[
        offset_of!(Self, weight_min),
        offset_of!(Self, weight_max),
        offset_of!(Self, ratio_limit),
        offset_of!(Self, tolerance),
        offset_of!(Self, symmetric),
        offset_of!(Self, steps),
        offset_of!(Self, starts),
        offset_of!(Self, reserved),
        offset_of!(Self, seed),
        offset_of!(Self, should_stop),
        offset_of!(Self, user),
    ];

    fn defaults() -> Self {
        Self::default()
    }
}

impl fpt_weights_options {
    /// The caller's options, or the defaults for NULL.
    ///
    /// # Safety
    /// As [`sized`].
    pub(super) unsafe fn read(options: *const Self) -> Result<(Options, Callbacks), Failure> {
        // SAFETY: the caller vouches for it.
        let given =
            if options.is_null() { Self::default() } else { unsafe { sized("options", options) }? };
        check_length("tolerance", given.tolerance)?;
        if given.symmetric > 1 {
            return Err(Failure::invalid(format!("symmetric: {} is not 0 or 1", given.symmetric)));
        }
        if given.reserved != 0 {
            return Err(Failure::invalid(format!("reserved: {} must be 0", given.reserved)));
        }
        let options = Options {
            weight_min: given.weight_min,
            weight_max: given.weight_max,
            ratio_limit: given.ratio_limit,
            tolerance: given.tolerance,
            symmetric: given.symmetric == 1,
            seed: given.seed,
            steps: given.steps,
            starts: given.starts,
        };
        options.range()?;
        Ok((options, Callbacks::stopping(given.should_stop, given.user)))
    }
}

/// Fills `options` with the defaults. Touches exactly struct_size bytes: pass sizeof *options.
/// Does nothing when `options` is NULL or struct_size is smaller than a size_t.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_weights_options_init(
    options: *mut fpt_weights_options,
    struct_size: usize,
) {
    if options.is_null() || struct_size < size_of::<usize>() {
        return;
    }
    let known = struct_size.min(size_of::<fpt_weights_options>());
    let defaults = fpt_weights_options { struct_size, ..Default::default() };
    let source = (&raw const defaults).cast::<u8>();
    let target = options.cast::<u8>();
    // SAFETY: the caller's struct has `struct_size` bytes; `defaults` has no padding before `known`.
    unsafe {
        source.copy_to_nonoverlapping(target, known);
        target.add(known).write_bytes(0, struct_size - known);
    }
}
