//! Surfaces: handle, inputs back out, evaluation.

use super::form::SurfaceForm;
use super::limits::{check_degree, check_inside, check_inside_at, check_order};
use super::memory::{
    array, optional_array, output, place, product, shared, write, write_array, write_weights,
};
use super::options::{SelfSized, sized};
use super::{Failure, fpt_status, guard};
use crate::index::IndexedSurface;
use crate::surface::Surface;
use crate::trim::Support;
use std::mem::size_of;
use std::sync::Arc;

/// A surface. Immutable: any number of threads may use one at a time. The search index is built on first
/// use, by one thread while the others wait. Made by fpt_surface_new or fpt_surface_from_callback, owned by
/// the caller, released by fpt_surface_free. A surface from a callback has no degrees, knots, poles and
/// weights: functions that need them return FPT_UNSUPPORTED.
pub struct fpt_surface {
    form: SurfaceForm,
}

impl fpt_surface {
    /// A handle for the caller.
    pub(super) fn handle(form: SurfaceForm) -> *mut Self {
        Box::into_raw(Box::new(Self { form }))
    }
}

/// The input of fpt_surface_new. Copied: nothing is borrowed after the call.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct fpt_surface_data {
    /// sizeof(fpt_surface_data).
    pub struct_size: usize,
    /// 1 to 31.
    pub degree_u: usize,
    /// 1 to 31.
    pub degree_v: usize,
    /// At least degree_u + 1.
    pub pole_count_u: usize,
    /// At least degree_v + 1.
    pub pole_count_v: usize,
    /// pole_count_u + degree_u + 1 numbers, not decreasing, repeats written out, no interior knot more
    /// than degree_u times. Periodic surfaces come unrolled: the domain is `knots_u[degree_u]` to
    /// `knots_u[pole_count_u]`.
    pub knots_u: *const f64,
    /// The same in v.
    pub knots_v: *const f64,
    /// x,y,z of pole (i,j) at 3*(i*pole_count_v + j). Not multiplied by the weights.
    pub poles: *const f64,
    /// Of pole (i,j) at i*pole_count_v + j, 1e-100 to 1e100; NULL: polynomial.
    pub weights: *const f64,
}

// SAFETY: repr(C), begins with struct_size; numbers and raw pointers.
unsafe impl SelfSized for fpt_surface_data {
    const SHORTER: &'static [usize] = &[];

    fn defaults() -> Self {
        let none = std::ptr::null();
        Self {
            struct_size: size_of::<Self>(),
            degree_u: 0,
            degree_v: 0,
            pole_count_u: 0,
            pole_count_v: 0,
            knots_u: none,
            knots_v: none,
            poles: none,
            weights: none,
        }
    }
}

/// What is behind a handle: a spline or a function.
///
/// # Safety
/// NULL or a live handle.
pub(super) unsafe fn form<'a>(surface: *const fpt_surface) -> Result<&'a SurfaceForm, Failure> {
    // SAFETY: the caller vouches for it.
    Ok(&unsafe { shared("surface", surface) }?.form)
}

/// As [`indexed`], where a call takes several surfaces and an error must name one.
///
/// # Safety
/// NULL or a live handle.
pub(super) unsafe fn indexed_as<'a>(
    name: &'static str,
    surface: *const fpt_surface,
) -> Result<&'a IndexedSurface, Failure> {
    // SAFETY: the caller vouches for it.
    match &unsafe { shared(name, surface) }?.form {
        SurfaceForm::Spline(surface) => Ok(surface),
        SurfaceForm::Function(_) => {
            let text = format!("{name}: is given by a function; this call needs knots and poles");
            Err(crate::error::Error::Unsupported(text).into())
        }
    }
}

/// The shape behind a handle, a spline or a function, where a call takes several and an error must name one.
///
/// # Safety
/// NULL or a live handle.
pub(super) unsafe fn support_as(
    name: &'static str,
    surface: *const fpt_surface,
) -> Result<Support, Failure> {
    // SAFETY: the caller vouches for it.
    Ok(match &unsafe { shared(name, surface) }?.form {
        SurfaceForm::Spline(surface) => Support::Spline(surface.clone()),
        SurfaceForm::Function(function) => Support::Callback(function.clone()),
    })
}

/// The spline surface behind a handle; a function is refused as unsupported.
///
/// # Safety
/// NULL or a live handle.
pub(super) unsafe fn indexed<'a>(
    surface: *const fpt_surface,
) -> Result<&'a IndexedSurface, Failure> {
    // SAFETY: the caller vouches for it.
    unsafe { form(surface) }?.spline()
}

/// As [`indexed`], to be kept.
///
/// # Safety
/// NULL or a live handle.
pub(super) unsafe fn shared_spline(
    surface: *const fpt_surface,
) -> Result<Arc<IndexedSurface>, Failure> {
    // SAFETY: the caller vouches for it.
    unsafe { form(surface) }?.shared_spline()
}

/// As [`indexed`], without the index.
///
/// # Safety
/// NULL or a live handle.
pub(super) unsafe fn plain<'a>(surface: *const fpt_surface) -> Result<&'a Surface, Failure> {
    // SAFETY: the caller vouches for it.
    Ok(unsafe { indexed(surface) }?.surface())
}

/// Reads and checks the input of a surface.
///
/// # Safety
/// NULL, or a struct whose arrays have the documented lengths.
unsafe fn read(data: *const fpt_surface_data) -> Result<Surface, Failure> {
    // SAFETY: the caller vouches for the struct and its arrays; degrees are small and pole counts no
    // larger than an address space holds, so the lengths of the knots do not overflow.
    unsafe {
        let data = sized("data", data)?;
        let (count_u, count_v) = (data.pole_count_u, data.pole_count_v);
        check_degree("degree_u", data.degree_u, count_u)?;
        check_degree("degree_v", data.degree_v, count_v)?;
        let count = product("poles", count_u, count_v)?;
        let knots_u = array("knots_u", data.knots_u, count_u + data.degree_u + 1)?;
        let knots_v = array("knots_v", data.knots_v, count_v + data.degree_v + 1)?;
        let poles = array("poles", data.poles.cast::<[f64; 3]>(), count)?;
        let weights = optional_array("weights", data.weights, count)?;
        let (degree_u, degree_v) = (data.degree_u, data.degree_v);
        let surface =
            Surface::new(knots_u, knots_v, degree_u, degree_v, poles, count_u, count_v, weights)?;
        Ok(surface)
    }
}

/// Makes a surface from its inputs.
///
/// @param data  the inputs, copied; a struct_size shorter than the struct is FPT_INVALID_ARGUMENT
/// @param out   the handle; release it with fpt_surface_free
/// @return FPT_INVALID_ARGUMENT names the array and the index of the first bad number
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_new(
    data: *const fpt_surface_data,
    out: *mut *mut fpt_surface,
) -> fpt_status {
    // SAFETY: the header asks for a surface data struct and room for a handle.
    guard(|| unsafe {
        let out = place("out", out)?;
        *out = fpt_surface::handle(SurfaceForm::Spline(Arc::new(IndexedSurface::new(read(data)?))));
        Ok(())
    })
}

/// Releases a surface. NULL is fine. No other call may use the handle during or after this one.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_free(surface: *mut fpt_surface) {
    let release = || {
        if !surface.is_null() {
            // SAFETY: a handle comes from Box::into_raw in `_new` and is released once.
            drop(unsafe { Box::from_raw(surface) });
        }
        Ok(())
    };
    let _ = guard(release);
}

/// The rectangle on which the surface is defined.
///
/// @param out_uv  4 numbers: start and end of u, start and end of v
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_domain(
    surface: *const fpt_surface,
    out_uv: *mut f64,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for 4 numbers.
    guard(|| unsafe { write("out_uv", form(surface)?.domain(), out_uv.cast()) })
}

/// The surface and its partial derivatives at one pair of parameters. At a knot the piece on the right
/// counts, at the domain's end the one on the left.
///
/// @param u            in the domain, else FPT_INVALID_ARGUMENT
/// @param v            in the domain, else FPT_INVALID_ARGUMENT
/// @param derivatives  highest total order d, at most 31; 0: the point only. More than 2 of a surface
///                     from a callback: FPT_UNSUPPORTED
/// @param out          3*(d + 1)*(d + 2)/2 numbers, order by order: S; Su,Sv; Suu,Suv,Svv; ... with
///                     x,y,z each. Where a callback fails: FPT_INVALID_ARGUMENT
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_evaluate(
    surface: *const fpt_surface,
    u: f64,
    v: f64,
    derivatives: u32,
    out: *mut f64,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for 3*(d+1)*(d+2)/2 numbers.
    guard(|| unsafe {
        let surface = form(surface)?;
        let order = check_order(derivatives)?;
        surface.check_order(order)?;
        let out = output("out", out.cast::<[f64; 3]>(), partial_count(order))?;
        let [u0, u1, v0, v1] = surface.domain();
        check_inside("u", u, u0, u1)?;
        check_inside("v", v, v0, v1)?;
        surface.partials([u, v], order, out)
    })
}

/// The surface and its partial derivatives at many pairs of parameters, as fpt_surface_evaluate gives
/// them one by one.
///
/// @param parameters   2*count numbers: u,v of pair i at 2*i, each in the domain; the error names the
///                     first that is not
/// @param count        pairs; may be 0
/// @param derivatives  highest total order d, at most 31
/// @param out          count*n numbers with n = 3*(d + 1)*(d + 2)/2, the values of pair i at i*n; must
///                     not overlap `parameters`. Where a callback fails: FPT_INVALID_ARGUMENT, the
///                     values before are written
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_evaluate_many(
    surface: *const fpt_surface,
    parameters: *const f64,
    count: usize,
    derivatives: u32,
    out: *mut f64,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and arrays of these lengths that do not overlap.
    guard(|| unsafe {
        let surface = form(surface)?;
        let order = check_order(derivatives)?;
        surface.check_order(order)?;
        let parameters = array("parameters", parameters.cast::<[f64; 2]>(), count)?;
        let each = partial_count(order);
        let out = output("out", out.cast::<[f64; 3]>(), product("out", count, each)?)?;
        let [u0, u1, v0, v1] = surface.domain();
        for (i, &[u, v]) in parameters.iter().enumerate() {
            check_inside_at("parameters", i, "u", u, u0, u1)?;
            check_inside_at("parameters", i, "v", v, v0, v1)?;
        }
        for (&pair, values) in parameters.iter().zip(out.chunks_exact_mut(each)) {
            surface.partials(pair, order, values)?;
        }
        Ok(())
    })
}

/// Vectors in one evaluation: the point and all partial derivatives up to `order`.
fn partial_count(order: usize) -> usize {
    (order + 1) * (order + 2) / 2
}

/// The degree in u.
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_degree_u(
    surface: *const fpt_surface,
    out_degree_u: *mut usize,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for the value.
    guard(|| unsafe { write("out_degree_u", plain(surface)?.knots_u().degree(), out_degree_u) })
}

/// The degree in v.
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_degree_v(
    surface: *const fpt_surface,
    out_degree_v: *mut usize,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for the value.
    guard(|| unsafe { write("out_degree_v", plain(surface)?.knots_v().degree(), out_degree_v) })
}

/// The number of poles in u.
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_pole_count_u(
    surface: *const fpt_surface,
    out_pole_count_u: *mut usize,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for the value.
    guard(|| unsafe {
        write("out_pole_count_u", plain(surface)?.knots_u().pole_count(), out_pole_count_u)
    })
}

/// The number of poles in v.
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_pole_count_v(
    surface: *const fpt_surface,
    out_pole_count_v: *mut usize,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for the value.
    guard(|| unsafe {
        write("out_pole_count_v", plain(surface)?.knots_v().pole_count(), out_pole_count_v)
    })
}

/// The knots in u, bit for bit as they came in.
///
/// @param capacity     how many numbers `out_knots_u` has room for; less than
///                     pole_count_u + degree_u + 1 is FPT_INVALID_ARGUMENT
/// @param out_knots_u  pole_count_u + degree_u + 1 numbers
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_knots_u(
    surface: *const fpt_surface,
    capacity: usize,
    out_knots_u: *mut f64,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for `capacity` numbers.
    guard(|| unsafe {
        write_array("out_knots_u", plain(surface)?.knots_u().values(), capacity, out_knots_u)
    })
}

/// The knots in v, bit for bit as they came in.
///
/// @param capacity     how many numbers `out_knots_v` has room for; less than
///                     pole_count_v + degree_v + 1 is FPT_INVALID_ARGUMENT
/// @param out_knots_v  pole_count_v + degree_v + 1 numbers
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_knots_v(
    surface: *const fpt_surface,
    capacity: usize,
    out_knots_v: *mut f64,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for `capacity` numbers.
    guard(|| unsafe {
        write_array("out_knots_v", plain(surface)?.knots_v().values(), capacity, out_knots_v)
    })
}

/// The poles, bit for bit as they came in.
///
/// @param capacity   how many numbers `out_poles` has room for; less than
///                   3*pole_count_u*pole_count_v is FPT_INVALID_ARGUMENT
/// @param out_poles  3*pole_count_u*pole_count_v numbers: x,y,z of pole (i,j) at
///                   3*(i*pole_count_v + j)
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_poles(
    surface: *const fpt_surface,
    capacity: usize,
    out_poles: *mut f64,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for `capacity` numbers.
    guard(|| unsafe {
        write_array("out_poles", plain(surface)?.poles().as_flattened(), capacity, out_poles)
    })
}

/// The weights as they came in; all 1 for a polynomial surface.
///
/// @param capacity     how many numbers `out_weights` has room for; less than
///                     pole_count_u*pole_count_v is FPT_INVALID_ARGUMENT
/// @param out_weights  pole_count_u*pole_count_v numbers: of pole (i,j) at i*pole_count_v + j
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_weights(
    surface: *const fpt_surface,
    capacity: usize,
    out_weights: *mut f64,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for `capacity` numbers.
    guard(|| unsafe {
        let surface = plain(surface)?;
        write_weights(surface.weights(), surface.poles().len(), capacity, out_weights)
    })
}

/// The box of the poles that act on the domain, in which the surface lies. Its diagonal is what the default
/// tolerance and accuracy are relative to. Of a surface from a callback: the box of samples, which it may
/// leave between them.
///
/// @param out_box  6 numbers: least x,y,z, then greatest x,y,z
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_box(
    surface: *const fpt_surface,
    out_box: *mut f64,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for 6 numbers.
    guard(|| unsafe { write("out_box", form(surface)?.bounding_box(), out_box.cast()) })
}

/// Whether the surface has weights that differ: 1 or 0. 0 for a surface from a callback.
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_is_rational(
    surface: *const fpt_surface,
    out_is_rational: *mut i32,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for the value.
    guard(|| unsafe {
        write("out_is_rational", i32::from(form(surface)?.is_rational()), out_is_rational)
    })
}

/// Whether the edges at the start and the end of u are one curve, as geometry and not only by the
/// knots: 1 or 0.
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_is_closed_u(
    surface: *const fpt_surface,
    out_is_closed_u: *mut i32,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for the value.
    guard(|| unsafe {
        write("out_is_closed_u", i32::from(form(surface)?.is_closed()[0]), out_is_closed_u)
    })
}

/// Whether the edges at the start and the end of v are one curve, as geometry and not only by the
/// knots: 1 or 0.
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_is_closed_v(
    surface: *const fpt_surface,
    out_is_closed_v: *mut i32,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for the value.
    guard(|| unsafe {
        write("out_is_closed_v", i32::from(form(surface)?.is_closed()[1]), out_is_closed_v)
    })
}

/// Which edges of the domain are a single point in space.
///
/// @param out_collapsed  4 numbers, 1 or 0: the edges at the start of u, the end of u, the start of v,
///                       the end of v
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_collapsed_edges(
    surface: *const fpt_surface,
    out_collapsed: *mut i32,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for 4 numbers.
    guard(|| unsafe {
        let collapsed = form(surface)?.collapsed_edges().map(i32::from);
        write("out_collapsed", collapsed, out_collapsed.cast())
    })
}
/// Builds the search index now instead of on the first query. May be called again and from any thread.
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_prepare(surface: *const fpt_surface) -> fpt_status {
    // SAFETY: the header asks for a live handle.
    guard(|| Ok(unsafe { form(surface) }?.prepare(&mut || false)?))
}

/// Bytes that the library holds for the surface: the copies of its inputs, and the search index once it is built (with more than
/// 131,072 patches: the parts of it that queries have visited). What the function of a callback keeps for itself is not
/// counted.
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_surface_memory(
    surface: *const fpt_surface,
    out_memory: *mut usize,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for the value.
    guard(|| unsafe {
        write("out_memory", size_of::<fpt_surface>() + form(surface)?.memory(), out_memory)
    })
}
