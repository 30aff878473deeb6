//! What goes in and out of surface-surface intersections: options, counts, branches, points, contacts.

use super::Failure;
use super::options::{SelfSized, check_length, sized};
use super::query::Callbacks;
use crate::march::correct::Corrector;
use crate::march::{MarchOptions, MarchPoint};
use std::ffi::{c_int, c_void};
use std::mem::{offset_of, size_of};

/// What an end of a branch is, for fpt_intersection_branch.end_kind.
#[repr(C)]
pub enum fpt_branch_end {
    /// The branch is closed.
    FPT_BRANCH_END_CLOSED = 0,
    /// A border: end_index is the side, 0 to 7 for u low, u high, v low, v high of A, then of B.
    FPT_BRANCH_END_BORDER = 1,
    /// A contact (a branch point, a cusp, a collapsed edge): end_index is its number.
    FPT_BRANCH_END_CONTACT = 2,
    /// An undecided box is there.
    FPT_BRANCH_END_UNDECIDED = 3,
    /// A trim: end_index is 0 for one of A, 1 for one of B.
    FPT_BRANCH_END_TRIM = 4,
}

/// What a contact is, for fpt_intersection_contact.kind.
#[repr(C)]
pub enum fpt_contact_kind {
    /// The surfaces touch from one side.
    FPT_CONTACT_TOUCHING = 0,
    /// Two curves cross.
    FPT_CONTACT_CROSSING = 1,
    /// The surfaces agree beyond the second order, or have no tangent plane.
    FPT_CONTACT_DEGENERATE = 2,
    /// A border of one surface just meets the other.
    FPT_CONTACT_BORDER = 3,
    /// A collapsed edge of one surface lies on the other.
    FPT_CONTACT_TIP = 4,
}

/// How an intersection is found, for fpt_intersect_surfaces_options.method.
#[repr(C)]
pub enum fpt_intersect_method {
    /// The search that proves: subdivision for the topology, Newton for points.
    FPT_INTERSECT_AUTO = 0,
    /// Subdivision by hulls to a depth or until flat, triangle pairs, segments joined: polylines of which nothing is proven.
    FPT_INTERSECT_SUBDIVISION = 1,
    /// Two tessellations: polylines of which nothing is proven. Of surfaces given by functions too.
    FPT_INTERSECT_MESH = 2,
}

/// How a place near both surfaces becomes one on both, for fpt_intersect_surfaces_options.corrector.
#[repr(C)]
#[derive(Clone, Copy)]
pub enum fpt_corrector {
    /// Newton with four parameters, and with three where one is held at a border.
    FPT_CORRECTOR_AUTO = 0,
    /// Newton with three parameters: u of A is held.
    FPT_CORRECTOR_NEWTON_HOLDS_U = 1,
    /// v of A is held.
    FPT_CORRECTOR_NEWTON_HOLDS_V = 2,
    /// u of B is held.
    FPT_CORRECTOR_NEWTON_HOLDS_S = 3,
    /// v of B is held.
    FPT_CORRECTOR_NEWTON_HOLDS_T = 4,
    /// Newton with four parameters: the step that moves both surface points least.
    FPT_CORRECTOR_NEWTON_FOUR = 5,
    /// Moving affine frame: ball and midpoint transforms, the middle of both feet where the tangent planes are parallel.
    FPT_CORRECTOR_MAF = 6,
}

/// What an intersection asks for. Fill it with fpt_intersect_surfaces_options_init, then change what matters. All zero after
/// struct_size is the default of everything. Grows at the end only.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct fpt_intersect_surfaces_options {
    /// sizeof(fpt_intersect_surfaces_options), set by fpt_intersect_surfaces_options_init.
    pub struct_size: usize,
    /// Length, finite, >= 0. How far a branch may be from the chord between two of its points. 0: 1e-3 x the size of
    /// the smaller surface (the power of two above the diagonal of its box).
    pub chord: f64,
    /// Most pairs of parts; 0: the default, 2,000,000.
    pub budget: u64,
    /// Asked on the calling thread now and then; non-zero ends the call with FPT_CANCELLED, and an intersection with what was found by
    /// then. NULL: never.
    pub should_stop: Option<unsafe extern "C" fn(user: *mut c_void) -> c_int>,
    /// Told on the calling thread now and then: pairs judged, and pairs judged or waiting; by fpt_surface_intersection_curves points of
    /// the branch. NULL: nobody.
    pub progress: Option<unsafe extern "C" fn(user: *mut c_void, done: usize, total: usize)>,
    /// Handed to the callbacks as it is.
    pub user: *mut c_void,
    /// Length, finite, >= 0: surfaces that are nearer than this touch where they are parallel, and are not told apart further; points of
    /// branches are within it of both surfaces, rounding included, or the result is not proven. fpt_intersect_correct ends within
    /// it. 0: what the arithmetic can tell.
    pub tolerance: f64,
    /// A value of fpt_intersect_method.
    pub method: u32,
    /// A value of fpt_corrector, for fpt_intersect_correct, fpt_intersect_march and fpt_intersect_bisect.
    pub corrector: u32,
    /// FPT_INTERSECT_SUBDIVISION: how often both surfaces are quartered, at most 20; 0: until their parts are as flat as the chord.
    /// FPT_INTERSECT_MESH: cells along each direction, at most 1024; 0: 64.
    pub levels: u32,
    /// Must be 0.
    pub reserved: u32,
    /// Told by fpt_intersect_correct on the calling thread: each iterate, its u, v of A and u, v of B, and the distance between the two
    /// surface points; step 0 is the start. NULL: nobody.
    pub trace:
        Option<unsafe extern "C" fn(user: *mut c_void, step: u32, uvst: *const f64, gap: f64)>,
}

impl Default for fpt_intersect_surfaces_options {
    fn default() -> Self {
        Self {
            struct_size: size_of::<Self>(),
            chord: 0.0,
            budget: 0,
            should_stop: None,
            progress: None,
            user: std::ptr::null_mut(),
            tolerance: 0.0,
            method: fpt_intersect_method::FPT_INTERSECT_AUTO as u32,
            corrector: fpt_corrector::FPT_CORRECTOR_AUTO as u32,
            levels: 0,
            reserved: 0,
            trace: None,
        }
    }
}

// SAFETY: repr(C), begins with struct_size; numbers, a raw pointer and nullable function pointers.
unsafe impl SelfSized for fpt_intersect_surfaces_options {
    const SHORTER: &'static [usize] = &[
        offset_of!(Self, chord),
        offset_of!(Self, budget),
        offset_of!(Self, should_stop),
        offset_of!(Self, progress),
        offset_of!(Self, user),
        offset_of!(Self, tolerance),
        offset_of!(Self, method),
        offset_of!(Self, corrector),
        offset_of!(Self, levels),
        offset_of!(Self, reserved),
        offset_of!(Self, trace),
    ];

    fn defaults() -> Self {
        Self::default()
    }
}

/// Counts and verdicts of an intersection.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct fpt_intersection_summary {
    /// Curves.
    pub branch_count: usize,
    /// Points.
    pub contact_count: usize,
    /// Boxes in which the surfaces coincide.
    pub overlap_count: usize,
    /// Boxes about which nothing is known.
    pub undecided_count: usize,
    /// Pairs of parts judged.
    pub pairs: u64,
    /// 1: nothing is missing and every branch is transversal, with proof. 0 with contacts, overlaps, tangential branches or
    /// undecided boxes: what touches cannot be told from a gap below the rounding.
    pub is_proven: u32,
    /// 1: the budget ran out.
    pub is_exhausted: u32,
    /// 1: should_stop said so. What was not looked at by then is undecided; chords may be longer than asked (the chord of each branch is
    /// true), and borders of overlaps are left out.
    pub is_stopped: u32,
    /// 0.
    pub reserved: u32,
}

/// A branch without its points.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct fpt_intersection_branch {
    /// Number of points.
    pub point_count: usize,
    /// Greatest distance between the two surface points of one of its points.
    pub gap: f64,
    /// Proven: between two points the branch stays within this of their chord. Infinite where nothing is proven.
    pub chord: f64,
    /// 1: the surfaces touch along it.
    pub is_tangential: u32,
    /// 1: it bounds an area in which the surfaces coincide; then it is tangential too.
    pub bounds_overlap: u32,
    /// 1: it is a loop; its first point comes again as the last.
    pub is_closed: u32,
    /// 0.
    pub reserved: u32,
    /// Values of fpt_branch_end, of its beginning and its end.
    pub end_kind: [u32; 2],
    /// What they refer to.
    pub end_index: [u32; 2],
}

/// A point of an intersection: 56 bytes, frozen.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct fpt_intersection_point {
    /// Middle of the two surface points.
    pub point: [f64; 3],
    /// Parameters of A.
    pub uv: [f64; 2],
    /// Parameters of B.
    pub st: [f64; 2],
}

const _: () = {
    assert!(size_of::<fpt_intersection_point>() == 56 && size_of::<MarchPoint>() == 56);
    assert!(offset_of!(fpt_intersection_point, point) == offset_of!(MarchPoint, point));
    assert!(offset_of!(fpt_intersection_point, uv) == offset_of!(MarchPoint, uv));
    assert!(offset_of!(fpt_intersection_point, st) == offset_of!(MarchPoint, st));
};

/// An isolated contact.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct fpt_intersection_contact {
    /// Where.
    pub place: fpt_intersection_point,
    /// Distance between the surfaces there.
    pub gap: f64,
    /// Length: what the surfaces do within it was not told apart further.
    pub radius: f64,
    /// A value of fpt_contact_kind.
    pub kind: u32,
    /// 0.
    pub reserved: u32,
}

/// Fills `options` with the defaults. Touches exactly struct_size bytes: pass sizeof *options.
/// Does nothing when `options` is NULL or struct_size is smaller than a size_t.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_intersect_surfaces_options_init(
    options: *mut fpt_intersect_surfaces_options,
    struct_size: usize,
) {
    if options.is_null() || struct_size < size_of::<usize>() {
        return;
    }
    let known = struct_size.min(size_of::<fpt_intersect_surfaces_options>());
    let defaults = fpt_intersect_surfaces_options { struct_size, ..Default::default() };
    let source = (&raw const defaults).cast::<u8>();
    let target = options.cast::<u8>();
    // SAFETY: the caller's struct has `struct_size` bytes; `defaults` has no padding before `known`.
    unsafe {
        source.copy_to_nonoverlapping(target, known);
        target.add(known).write_bytes(0, struct_size - known);
    }
}

impl fpt_intersect_surfaces_options {
    /// The options of a call, checked; NULL: the defaults.
    ///
    /// # Safety
    /// NULL or options with a size that is true.
    pub(super) unsafe fn read(options: *const Self) -> Result<Self, Failure> {
        let given = match options.is_null() {
            true => Self::default(),
            // SAFETY: the caller vouches for it.
            false => unsafe { sized("options", options) }?,
        };
        check_length("chord", given.chord)?;
        check_length("tolerance", given.tolerance)?;
        if given.reserved != 0 {
            return Err(Failure::invalid(format!("reserved: {} must be 0", given.reserved)));
        }
        Ok(given)
    }

    pub(super) fn march(&self) -> MarchOptions {
        MarchOptions { chord: self.chord, budget: self.budget, tolerance: self.tolerance }
    }

    pub(super) fn callbacks(&self) -> Callbacks {
        Callbacks::telling(self.should_stop, self.progress, self.user)
    }

    pub(super) fn corrector(&self) -> Result<Corrector, Failure> {
        use fpt_corrector::*;
        const CORRECTORS: [(fpt_corrector, Corrector); 7] = [
            (FPT_CORRECTOR_AUTO, Corrector::Auto),
            (FPT_CORRECTOR_NEWTON_HOLDS_U, Corrector::NewtonThree(0)),
            (FPT_CORRECTOR_NEWTON_HOLDS_V, Corrector::NewtonThree(1)),
            (FPT_CORRECTOR_NEWTON_HOLDS_S, Corrector::NewtonThree(2)),
            (FPT_CORRECTOR_NEWTON_HOLDS_T, Corrector::NewtonThree(3)),
            (FPT_CORRECTOR_NEWTON_FOUR, Corrector::NewtonFour),
            (FPT_CORRECTOR_MAF, Corrector::Maf),
        ];
        let number = self.corrector;
        let found = CORRECTORS.iter().find(|(code, _)| *code as u32 == number);
        let unknown =
            || Failure::invalid(format!("corrector: {number} is not an FPT_CORRECTOR_ value"));
        found.map(|&(_, corrector)| corrector).ok_or_else(unknown)
    }
}
