//! What goes in and out of intersections: options, quadrics, hits, branches, conics.

use super::Failure;
use super::options::{SelfSized, check_length, sized};
use super::query::Callbacks;
use crate::intersect::{
    Conic, CurveHit, End, Hit, HitOptions, Nature, Quadric, SectionOptions, ray_flag,
};
use crate::portable::SameDigits;
use std::ffi::{c_int, c_void};
use std::mem::{offset_of, size_of};

/// How intersections are computed. Fill it with fpt_hit_options_init, then change what matters. All zero after struct_size
/// is the default of everything. Grows at the end only.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct fpt_hit_options {
    /// sizeof(fpt_hit_options), set by fpt_hit_options_init.
    pub struct_size: usize,
    /// Length, finite, >= 0. Curves: places farther apart do not meet. Sections: what is smaller is not taken apart. 0: 1e-7 x
    /// the diagonal of the (larger) box.
    pub tolerance: f64,
    /// Length, finite, >= 0: most distance of a branch from its polyline. 0: 1e-4 x the diagonal of the box.
    pub chord: f64,
    /// Most boxes; 0: the default, 1,000,000 for curves, 200,000 for a section.
    pub budget: u64,
    /// Threads of sections and rays; 0: all cores, 1: the calling thread only. The answers do not depend on it.
    pub threads: u32,
    /// Must be 0.
    pub reserved: u32,
    /// Asked on the calling thread now and then; non-zero ends the call with FPT_CANCELLED and what was found by then. NULL: never.
    pub should_stop: Option<unsafe extern "C" fn(user: *mut c_void) -> c_int>,
    /// Told on the calling thread how many of all sections or rays are done. NULL: not wanted.
    pub progress: Option<unsafe extern "C" fn(user: *mut c_void, done: usize, total: usize)>,
    /// Handed to the callbacks as it is.
    pub user: *mut c_void,
}

impl Default for fpt_hit_options {
    fn default() -> Self {
        Self {
            struct_size: size_of::<Self>(),
            tolerance: 0.0,
            chord: 0.0,
            budget: 0,
            threads: 0,
            reserved: 0,
            should_stop: None,
            progress: None,
            user: std::ptr::null_mut(),
        }
    }
}

// SAFETY: repr(C), begins with struct_size; numbers, a raw pointer and nullable function pointers.
unsafe impl SelfSized for fpt_hit_options {
    const SHORTER: &'static [usize] = &[
        offset_of!(Self, tolerance),
        offset_of!(Self, chord),
        offset_of!(Self, budget),
        offset_of!(Self, threads),
        offset_of!(Self, reserved),
        offset_of!(Self, should_stop),
        offset_of!(Self, progress),
        offset_of!(Self, user),
    ];

    fn defaults() -> Self {
        Self::default()
    }
}

/// Fills `options` with the defaults. Touches exactly struct_size bytes: pass sizeof *options.
/// Does nothing when `options` is NULL or struct_size is smaller than a size_t.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_hit_options_init(options: *mut fpt_hit_options, struct_size: usize) {
    if options.is_null() || struct_size < size_of::<usize>() {
        return;
    }
    let known = struct_size.min(size_of::<fpt_hit_options>());
    let defaults = fpt_hit_options { struct_size, ..Default::default() };
    let source = (&raw const defaults).cast::<u8>();
    let target = options.cast::<u8>();
    // SAFETY: the caller's struct has `struct_size` bytes; `defaults` has no padding before `known`.
    unsafe {
        source.copy_to_nonoverlapping(target, known);
        target.add(known).write_bytes(0, struct_size - known);
    }
}

impl fpt_hit_options {
    /// The caller's options, checked, or the defaults for NULL.
    ///
    /// # Safety
    /// As [`sized`].
    pub(super) unsafe fn read(options: *const Self) -> Result<Self, Failure> {
        let given = match options.is_null() {
            true => Self::default(),
            // SAFETY: the caller vouches for it.
            false => unsafe { sized("options", options) }?,
        };
        check_length("tolerance", given.tolerance)?;
        check_length("chord", given.chord)?;
        if given.reserved != 0 {
            return Err(Failure::invalid(format!("reserved: {} must be 0", given.reserved)));
        }
        Ok(given)
    }

    pub(super) fn hits(&self) -> HitOptions {
        HitOptions { tolerance: self.tolerance, budget: self.budget }
    }

    pub(super) fn sections(&self) -> SectionOptions {
        SectionOptions { tolerance: self.tolerance, chord: self.chord, budget: self.budget }
    }

    pub(super) fn callbacks(&self) -> Callbacks {
        Callbacks::telling(self.should_stop, self.progress, self.user)
    }
}

/// What a fpt_quadric is.
#[repr(C)]
#[derive(Clone, Copy)]
pub enum fpt_quadric_kind {
    /// Through `origin`, across `axis`.
    FPT_QUADRIC_PLANE = 0,
    /// About `origin`, with radius `size`.
    FPT_QUADRIC_SPHERE = 1,
    /// Infinite, about the line through `origin` along `axis`, with radius `size`.
    FPT_QUADRIC_CYLINDER = 2,
    /// Infinite on both sides of its apex `origin`, about `axis`; `size` is the radius per unit of height.
    FPT_QUADRIC_CONE = 3,
    /// y.A y + 2 b.y + c = 0 with y = x - origin, from `matrix`, `linear` and `constant`.
    FPT_QUADRIC_GENERAL = 4,
}

/// A plane or a quadric in implicit form: 144 bytes, frozen. Fields that its kind does not name are not read.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct fpt_quadric {
    /// A value of fpt_quadric_kind.
    pub kind: u32,
    /// Must be 0.
    pub reserved: u32,
    /// A point: see the kind.
    pub origin: [f64; 3],
    /// A direction of any length but 0.
    pub axis: [f64; 3],
    /// A radius, or a cone's radius per unit of height.
    pub size: f64,
    /// A as xx, xy, xz, yy, yz, zz.
    pub matrix: [f64; 6],
    /// b.
    pub linear: [f64; 3],
    /// c.
    pub constant: f64,
}

impl fpt_quadric {
    /// The quadric of entry `index` of a list.
    pub(super) fn checked(&self, index: usize) -> Result<Quadric, Failure> {
        use fpt_quadric_kind::*;
        if self.reserved != 0 {
            let text = format!("quadrics: quadric {index}: reserved: {} must be 0", self.reserved);
            return Err(Failure::invalid(text));
        }
        let kinds = [
            FPT_QUADRIC_PLANE,
            FPT_QUADRIC_SPHERE,
            FPT_QUADRIC_CYLINDER,
            FPT_QUADRIC_CONE,
            FPT_QUADRIC_GENERAL,
        ];
        let Some(&kind) = kinds.iter().find(|&&kind| kind as u32 == self.kind) else {
            let text = format!(
                "quadrics: quadric {index}: kind {} is not an FPT_QUADRIC_ value",
                self.kind
            );
            return Err(Failure::invalid(text));
        };
        let made = match kind {
            FPT_QUADRIC_PLANE => Quadric::plane(self.origin, self.axis),
            FPT_QUADRIC_SPHERE => Quadric::sphere(self.origin, self.size),
            FPT_QUADRIC_CYLINDER => Quadric::cylinder(self.origin, self.axis, self.size),
            FPT_QUADRIC_CONE => Quadric::cone(self.origin, self.axis, self.size.arctangent()),
            FPT_QUADRIC_GENERAL => {
                Quadric::general(self.origin, self.matrix, self.linear, self.constant)
            }
        };
        made.map_err(|error| Failure::invalid(format!("quadrics: quadric {index}: {error}")))
    }
}

/// How two shapes meet, for fpt_curve_hit.nature.
#[repr(C)]
pub enum fpt_hit_nature {
    /// At an angle.
    FPT_HIT_TRANSVERSAL = 0,
    /// They touch.
    FPT_HIT_TANGENTIAL = 1,
    /// They run together.
    FPT_HIT_OVERLAP = 2,
}

/// Where a curve meets a curve, a surface or a quadric: 112 bytes, frozen.
#[repr(C)]
pub struct fpt_curve_hit {
    /// Parameter of the first curve, or first one of the surface; 0 for a quadric.
    pub u: f64,
    /// Second parameter of the surface, else 0.
    pub v: f64,
    /// Parameter of the (second) curve.
    pub w: f64,
    /// The first shape there; for a quadric the curve.
    pub point: [f64; 3],
    /// Distance between both there.
    pub distance: f64,
    /// Interval of u around the hit: outside of the intervals of all hits, and of the undecided boxes, the shapes are farther
    /// apart than the tolerance.
    pub u_range: [f64; 2],
    /// The same for v.
    pub v_range: [f64; 2],
    /// The same for w; of an overlap, where they run together (outer).
    pub w_range: [f64; 2],
    /// A value of fpt_hit_nature.
    pub nature: u32,
    /// 1 at an angle; where they touch 2 when they stay on one side, 3 when they cross; 0 along an overlap.
    pub multiplicity: u32,
}

/// The bits of fpt_ray_hit.flags.
#[repr(C)]
pub enum fpt_ray_flag {
    /// The ray touches the surface, or the angle is too small to tell.
    FPT_RAY_TANGENTIAL = 1,
    /// The hit is on a border of the domain.
    FPT_RAY_EDGE = 2,
    /// The ray runs in the surface: a point of that piece.
    FPT_RAY_OVERLAP = 4,
    /// Hits may be missing.
    FPT_RAY_NOT_PROVEN = 8,
    /// Origin, direction or reach are not numbers, too large, or the direction is 0.
    FPT_RAY_BAD_RAY = 16,
}

/// A hit of a ray and a surface: 56 bytes, frozen. A ray without a hit has t infinite, NaN in u, v and point, and count 0; a ray
/// that was not reached when should_stop ended the call has t NaN and FPT_RAY_NOT_PROVEN.
#[repr(C)]
pub struct fpt_ray_hit {
    /// Length along the ray from its origin.
    pub t: f64,
    /// First parameter, in the domain.
    pub u: f64,
    /// Second parameter, in the domain.
    pub v: f64,
    /// The surface at (u,v), bit for bit what _evaluate returns there.
    pub point: [f64; 3],
    /// Sum of fpt_ray_flag values.
    pub flags: u32,
    /// fpt_caster_first: the number of all hits of the ray; in a list 1.
    pub count: u32,
}

/// What an end of a branch is.
#[repr(C)]
pub enum fpt_section_end {
    /// The branch is a loop: both ends are the same point of space.
    FPT_SECTION_END_CLOSED = 0,
    /// A border of the domain.
    FPT_SECTION_END_BORDER = 1,
    /// A point where branches meet.
    FPT_SECTION_END_SINGULAR = 2,
    /// A collapsed edge.
    FPT_SECTION_END_COLLAPSED = 3,
    /// A box that was not decided.
    FPT_SECTION_END_UNDECIDED = 4,
}

/// A branch of a section: 24 bytes, frozen.
#[repr(C)]
pub struct fpt_branch {
    /// Number of its points.
    pub point_count: usize,
    /// Values of fpt_section_end.
    pub ends: [u32; 2],
    /// 1: the surfaces touch all along it.
    pub tangential: u32,
    /// 0.
    pub reserved: u32,
}

/// A single point of a section: 56 bytes, frozen.
#[repr(C)]
pub struct fpt_section_point {
    /// First parameter.
    pub u: f64,
    /// Second parameter.
    pub v: f64,
    /// The surface there.
    pub point: [f64; 3],
    /// About the distance from the quadric.
    pub distance: f64,
    /// Number of branches that meet here; 0: an isolated point of contact.
    pub arms: u32,
    /// 0.
    pub reserved: u32,
}

/// A part of the domain in a section: 40 bytes, frozen.
#[repr(C)]
pub struct fpt_section_region {
    /// u0, u1, v0, v1.
    pub domain: [f64; 4],
    /// 1: the surface lies in the quadric; 0: not decided, branches may be missing here.
    pub overlaps: u32,
    /// 0.
    pub reserved: u32,
}

/// What a fpt_conic is.
#[repr(C)]
pub enum fpt_conic_kind {
    /// center + t axes[0].
    FPT_CONIC_LINE = 0,
    /// center + lengths[0] cos t axes[0] + lengths[1] sin t axes[1]; a circle when both lengths are the same.
    FPT_CONIC_ELLIPSE = 1,
    /// center +- lengths[0] cosh t axes[0] + lengths[1] sinh t axes[1].
    FPT_CONIC_HYPERBOLA = 2,
    /// center + t^2 / (4 lengths[0]) axes[0] + t axes[1].
    FPT_CONIC_PARABOLA = 3,
    /// The point center.
    FPT_CONIC_POINT = 4,
}

/// A conic in space: 96 bytes, frozen.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fpt_conic {
    /// A value of fpt_conic_kind.
    pub kind: u32,
    /// 0.
    pub reserved: u32,
    /// Centre, vertex, or a point.
    pub center: [f64; 3],
    /// Two unit vectors, one after the other; unused ones 0.
    pub axes: [f64; 6],
    /// Half lengths, or the focal length; unused ones 0.
    pub lengths: [f64; 2],
}

impl From<&Conic> for fpt_conic {
    fn from(conic: &Conic) -> Self {
        use fpt_conic_kind::*;
        let (kind, center, axes, lengths) = match conic {
            Conic::Line { origin, direction } => {
                (FPT_CONIC_LINE, origin, [*direction, [0.0; 3]], [0.0; 2])
            }
            Conic::Ellipse { center, axes, lengths } => {
                (FPT_CONIC_ELLIPSE, center, *axes, *lengths)
            }
            Conic::Hyperbola { center, axes, lengths } => {
                (FPT_CONIC_HYPERBOLA, center, *axes, *lengths)
            }
            Conic::Parabola { vertex, axes, focal } => {
                (FPT_CONIC_PARABOLA, vertex, *axes, [*focal, 0.0])
            }
            Conic::Point(point) => (FPT_CONIC_POINT, point, [[0.0; 3]; 2], [0.0; 2]),
        };
        let [[a, b, c], [d, e, f]] = axes;
        Self { kind: kind as u32, reserved: 0, center: *center, axes: [a, b, c, d, e, f], lengths }
    }
}

// Records are copied out as they are: the layouts must agree.
const _: () = {
    assert!(size_of::<fpt_curve_hit>() == 112 && size_of::<CurveHit>() == 112);
    assert!(offset_of!(fpt_curve_hit, v) == offset_of!(CurveHit, v));
    assert!(offset_of!(fpt_curve_hit, w) == offset_of!(CurveHit, w));
    assert!(offset_of!(fpt_curve_hit, point) == offset_of!(CurveHit, point));
    assert!(offset_of!(fpt_curve_hit, distance) == offset_of!(CurveHit, distance));
    assert!(offset_of!(fpt_curve_hit, u_range) == offset_of!(CurveHit, u_range));
    assert!(offset_of!(fpt_curve_hit, v_range) == offset_of!(CurveHit, v_range));
    assert!(offset_of!(fpt_curve_hit, w_range) == offset_of!(CurveHit, w_range));
    assert!(offset_of!(fpt_curve_hit, nature) == offset_of!(CurveHit, nature));
    assert!(offset_of!(fpt_curve_hit, multiplicity) == offset_of!(CurveHit, multiplicity));
    assert!(size_of::<fpt_ray_hit>() == 56 && size_of::<Hit>() == 56);
    assert!(offset_of!(fpt_ray_hit, u) == offset_of!(Hit, u));
    assert!(offset_of!(fpt_ray_hit, v) == offset_of!(Hit, v));
    assert!(offset_of!(fpt_ray_hit, point) == offset_of!(Hit, point));
    assert!(offset_of!(fpt_ray_hit, flags) == offset_of!(Hit, flags));
    assert!(offset_of!(fpt_ray_hit, count) == offset_of!(Hit, count));
    assert!(fpt_ray_flag::FPT_RAY_TANGENTIAL as u32 == ray_flag::TANGENTIAL);
    assert!(fpt_ray_flag::FPT_RAY_EDGE as u32 == ray_flag::EDGE);
    assert!(fpt_ray_flag::FPT_RAY_OVERLAP as u32 == ray_flag::OVERLAP);
    assert!(fpt_ray_flag::FPT_RAY_NOT_PROVEN as u32 == ray_flag::NOT_PROVEN);
    assert!(fpt_ray_flag::FPT_RAY_BAD_RAY as u32 == ray_flag::BAD_RAY);
    assert!(fpt_hit_nature::FPT_HIT_TRANSVERSAL as u32 == Nature::Transversal as u32);
    assert!(fpt_hit_nature::FPT_HIT_TANGENTIAL as u32 == Nature::Tangential as u32);
    assert!(fpt_hit_nature::FPT_HIT_OVERLAP as u32 == Nature::Overlap as u32);
    assert!(fpt_section_end::FPT_SECTION_END_CLOSED as u32 == End::Closed as u32);
    assert!(fpt_section_end::FPT_SECTION_END_BORDER as u32 == End::Border as u32);
    assert!(fpt_section_end::FPT_SECTION_END_SINGULAR as u32 == End::Singular as u32);
    assert!(fpt_section_end::FPT_SECTION_END_COLLAPSED as u32 == End::Collapsed as u32);
    assert!(fpt_section_end::FPT_SECTION_END_UNDECIDED as u32 == End::Undecided as u32);
};
