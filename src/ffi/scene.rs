//! Scenes: handle, members in and out, evaluation.

use super::curve::{self, fpt_curve};
use super::form::{CurveForm, SurfaceForm};
use super::limits::{check_inside, check_order};
use super::memory::{check_extent, output, place, shared, write};
use super::options::{SelfSized, sized};
use super::surface::{self, fpt_surface};
use super::{Failure, fpt_status, guard};
use crate::error::Error;
use crate::scene::{MAX_MEMBERS, Member, Placement, Scene, Shape};
use std::mem::size_of;

/// Many curves and surfaces that are searched together. Immutable, as they are: any number of threads may use one at a time.
/// Made by fpt_scene_new, owned by the caller, released by fpt_scene_free. It shares the shapes of the handles it was
/// made from: these may be freed before or after it.
pub struct fpt_scene {
    scene: Scene,
}

/// A member of a scene: a curve or a surface, and where it stands. Several members may have the same handle and different
/// placements; its search index is built once.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct fpt_scene_member {
    /// sizeof(fpt_scene_member), the same for all members of an array.
    pub struct_size: usize,
    /// A curve, or NULL. One from a callback is FPT_UNSUPPORTED.
    pub curve: *const fpt_curve,
    /// A surface, or NULL; exactly one of both is given. One from a callback is FPT_UNSUPPORTED.
    pub surface: *const fpt_surface,
    /// 12 numbers, three rows of rotation and translation: a point x of the shape stands at y with
    /// y[i] = placement[4*i]*x[0] + placement[4*i + 1]*x[1] + placement[4*i + 2]*x[2] + placement[4*i + 3].
    /// No entry of R^T R may differ from the identity by more than 1e-9, and the determinant is positive; the nearest
    /// rotation is taken (one that is orthogonal up to rounding keeps its bits). NULL: the shape stands where it is.
    pub placement: *const f64,
}

/// The input of fpt_scene_new. Copied: nothing is borrowed after the call.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct fpt_scene_data {
    /// sizeof(fpt_scene_data).
    pub struct_size: usize,
    /// 1 to 2^31 - 1.
    pub member_count: usize,
    /// The members, struct_size bytes of the first apart.
    pub members: *const fpt_scene_member,
}

// SAFETY: repr(C), begins with struct_size; numbers and raw pointers.
unsafe impl SelfSized for fpt_scene_member {
    const SHORTER: &'static [usize] = &[];

    fn defaults() -> Self {
        Self {
            struct_size: size_of::<Self>(),
            curve: std::ptr::null(),
            surface: std::ptr::null(),
            placement: std::ptr::null(),
        }
    }
}

// SAFETY: repr(C), begins with struct_size; numbers and raw pointers.
unsafe impl SelfSized for fpt_scene_data {
    const SHORTER: &'static [usize] = &[];

    fn defaults() -> Self {
        Self { struct_size: size_of::<Self>(), member_count: 0, members: std::ptr::null() }
    }
}

/// The scene behind a handle.
///
/// # Safety
/// NULL or a live handle.
pub(super) unsafe fn scene<'a>(scene: *const fpt_scene) -> Result<&'a Scene, Failure> {
    // SAFETY: the caller vouches for it.
    Ok(&unsafe { shared("scene", scene) }?.scene)
}

/// Reads and checks the members.
///
/// # Safety
/// NULL, or a struct whose members are `member_count` structs of the first one's size, with live handles and placements of
/// 12 numbers.
unsafe fn read(data: *const fpt_scene_data) -> Result<Vec<Member>, Failure> {
    // SAFETY: the caller vouches for the struct and its members; the extent is checked before they are read.
    unsafe {
        let data = sized("data", data)?;
        if data.member_count == 0 {
            return Err(Failure::invalid("members: a scene needs at least one".into()));
        }
        if data.member_count > MAX_MEMBERS {
            let text = format!("members: {} are more than {MAX_MEMBERS}", data.member_count);
            return Err(Failure::invalid(text));
        }
        let first = sized("members", data.members)?;
        check_extent("members", data.member_count, first.struct_size)?;
        let mut members = Vec::new();
        members.try_reserve_exact(data.member_count).map_err(|_| Error::OutOfMemory)?;
        for i in 0..data.member_count {
            let at = data.members.cast::<u8>().add(i * first.struct_size);
            let member = sized("members", at.cast::<fpt_scene_member>())?;
            if member.struct_size != first.struct_size {
                let (size, expected) = (member.struct_size, first.struct_size);
                let text = format!("members: member {i} has struct_size {size}, not {expected}");
                return Err(Failure::invalid(text));
            }
            members.push(Member {
                shape: shape(i, &member)?,
                placement: placement(i, member.placement)?,
            });
        }
        Ok(members)
    }
}

/// The shape of member `i`.
///
/// # Safety
/// Handles that are not NULL are live.
unsafe fn shape(i: usize, member: &fpt_scene_member) -> Result<Shape, Failure> {
    let wrong = |text: &str| Failure::invalid(format!("members: member {i} has {text}"));
    let by_function = || {
        let text =
            format!("members: member {i} is given by a function; a scene needs knots and poles");
        Failure::from(Error::Unsupported(text))
    };
    match (member.curve.is_null(), member.surface.is_null()) {
        (true, true) => Err(wrong("neither a curve nor a surface")),
        (false, false) => Err(wrong("a curve and a surface, only one is allowed")),
        // SAFETY: the caller vouches for the handle.
        (false, true) => match unsafe { curve::form(member.curve) }? {
            CurveForm::Spline(curve) => Ok(Shape::Curve(curve.clone())),
            CurveForm::Function(_) => Err(by_function()),
        },
        // SAFETY: the caller vouches for the handle.
        (true, false) => match unsafe { surface::form(member.surface) }? {
            SurfaceForm::Spline(surface) => Ok(Shape::Surface(surface.clone())),
            SurfaceForm::Function(_) => Err(by_function()),
        },
    }
}

/// The placement of member `i`.
///
/// # Safety
/// NULL or 12 numbers.
unsafe fn placement(i: usize, given: *const f64) -> Result<Placement, Failure> {
    if given.is_null() {
        return Ok(Placement::IDENTITY);
    }
    // SAFETY: the caller vouches for the numbers; the read needs no alignment.
    let rows = unsafe { given.cast::<[[f64; 4]; 3]>().read_unaligned() };
    Placement::new(rows).map_err(|text| Failure::invalid(format!("members: member {i}: {text}")))
}

/// A member by its number.
fn member(scene: &Scene, number: u32) -> Result<&Member, Failure> {
    let members = scene.members();
    members.get(number as usize).ok_or_else(|| {
        let text = format!("member: {number} is not below the count of {}", members.len());
        Failure::invalid(text)
    })
}

/// Makes a scene of its members, which are numbered from 0 as they come.
///
/// @param data  the members; a struct_size shorter than the struct is FPT_INVALID_ARGUMENT
/// @param out   the handle; release it with fpt_scene_free
/// @return FPT_INVALID_ARGUMENT names the first bad member ("members: member 17: placement[3] is not finite"),
///         FPT_UNSUPPORTED a member that is given by a callback
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_scene_new(
    data: *const fpt_scene_data,
    out: *mut *mut fpt_scene,
) -> fpt_status {
    // SAFETY: the header asks for a scene data struct and room for a handle.
    guard(|| unsafe {
        let out = place("out", out)?;
        let scene = Scene::new(read(data)?)?;
        *out = Box::into_raw(Box::new(fpt_scene { scene }));
        Ok(())
    })
}

/// Releases a scene, not the handles that it was made from. NULL is fine. No other call may use the handle during or after
/// this one.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_scene_free(scene: *mut fpt_scene) {
    let release = || {
        if !scene.is_null() {
            // SAFETY: a handle comes from Box::into_raw in `_new` and is released once.
            drop(unsafe { Box::from_raw(scene) });
        }
        Ok(())
    };
    let _ = guard(release);
}

/// The number of members.
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_scene_count(
    scene: *const fpt_scene,
    out_count: *mut usize,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for the value.
    guard(|| unsafe { write("out_count", self::scene(scene)?.members().len(), out_count) })
}

/// A member's shape as a new handle that shares everything with it: one of both outputs is the handle, to be released by its
/// _free, the other is NULL.
///
/// @param member       less than the count
/// @param out_curve    the curve, or NULL for a surface
/// @param out_surface  the surface, or NULL for a curve
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_scene_shape(
    scene: *const fpt_scene,
    member: u32,
    out_curve: *mut *mut fpt_curve,
    out_surface: *mut *mut fpt_surface,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for two handles.
    guard(|| unsafe {
        let member = self::member(self::scene(scene)?, member)?;
        let (out_curve, out_surface) =
            (place("out_curve", out_curve)?, place("out_surface", out_surface)?);
        (*out_curve, *out_surface) = (std::ptr::null_mut(), std::ptr::null_mut());
        match &member.shape {
            Shape::Curve(curve) => {
                *out_curve = fpt_curve::handle(CurveForm::Spline(curve.clone()));
            }
            Shape::Surface(surface) => {
                *out_surface = fpt_surface::handle(SurfaceForm::Spline(surface.clone()));
            }
        }
        Ok(())
    })
}

/// Where a member stands, as it is used: the nearest rotation to the one that was given.
///
/// @param member         less than the count
/// @param out_placement  12 numbers, as fpt_scene_member.placement
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_scene_placement(
    scene: *const fpt_scene,
    member: u32,
    out_placement: *mut f64,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for 12 numbers.
    guard(|| unsafe {
        let member = self::member(self::scene(scene)?, member)?;
        write("out_placement", member.placement.matrix(), out_placement.cast())
    })
}

/// The box in which all members lie. Its diagonal is what the default tolerance and accuracy are relative to.
///
/// @param out_box  6 numbers: least x,y,z, then greatest x,y,z
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_scene_box(scene: *const fpt_scene, out_box: *mut f64) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for 6 numbers.
    guard(|| unsafe {
        let bounds = self::scene(scene)?.bounding_box();
        write("out_box", [bounds.low, bounds.high], out_box.cast())
    })
}

/// Bytes that the library holds for the scene: members, tree, and the shapes with what is built of their search indexes, each
/// shape once, whether or not other handles share it.
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_scene_memory(
    scene: *const fpt_scene,
    out_memory: *mut usize,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for the value.
    guard(|| unsafe { write("out_memory", self::scene(scene)?.memory(), out_memory) })
}

/// Builds the search indexes of all members now, on all cores, instead of on the first query. May be called again and from
/// any thread.
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_scene_prepare(scene: *const fpt_scene) -> fpt_status {
    // SAFETY: the header asks for a live handle.
    guard(|| Ok(unsafe { self::scene(scene) }?.prepare(0, &mut || false)?))
}

/// A member's point and derivatives where it stands. The point has the bits that a foot's `point` has there: the shape's
/// point x by fpt_curve_evaluate or fpt_surface_evaluate, then per coordinate
/// ((r0*x[0] + r1*x[1]) + r2*x[2]) + t, each operation rounded, with the numbers of fpt_scene_placement; without a
/// placement the shape's point itself.
///
/// @param member       less than the count
/// @param u            in the member's domain, else FPT_INVALID_ARGUMENT
/// @param v            in the member's domain, else FPT_INVALID_ARGUMENT; on a curve it is not looked at
/// @param derivatives  highest (total) order d, at most 31; 0: the point only
/// @param out          of a curve 3*(d + 1) numbers as fpt_curve_evaluate, of a surface 3*(d + 1)*(d + 2)/2 as
///                     fpt_surface_evaluate
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_scene_evaluate(
    scene: *const fpt_scene,
    member: u32,
    u: f64,
    v: f64,
    derivatives: u32,
    out: *mut f64,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for as many numbers.
    guard(|| unsafe {
        let (scene, number) = (self::scene(scene)?, member);
        let shape = &self::member(scene, number)?.shape;
        let order = check_order(derivatives)?;
        let vectors = match shape {
            Shape::Curve(_) => order + 1,
            Shape::Surface(_) => (order + 1) * (order + 2) / 2,
        };
        let out = output("out", out.cast::<[f64; 3]>(), vectors)?;
        let [u0, u1, v0, v1] = shape.domain();
        check_inside("u", u, u0, u1)?;
        if let Shape::Surface(_) = shape {
            check_inside("v", v, v0, v1)?;
        }
        scene.derivatives(number as usize, [u, v], order, out);
        Ok(())
    })
}
