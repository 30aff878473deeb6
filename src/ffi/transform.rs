//! Parameter transforms: relations of one parameter, and the change of both.

use super::callback::User;
use super::memory::{array, output, place, shared, write};
use super::options::{SelfSized, sized};
use super::{Failure, fpt_status, guard};
use crate::elementary::CircleForm;
use crate::transform::{Function, Relation, Transform};
use std::ffi::c_void;
use std::mem::size_of;

/// A monotone function of one parameter on an interval, with its inverse. Immutable: any number of threads may use one at a time.
/// Owned by the caller, released by fpt_relation_free.
pub struct fpt_relation {
    relation: Relation,
}

/// A change of both parameters: (u, v) to (f(u), g(v)), or to (g(v), f(u)). Immutable: any number of threads may use one at a time.
/// Owned by the caller, released by fpt_transform_free.
pub struct fpt_transform {
    transform: Transform,
}

impl fpt_relation {
    fn handle(relation: Relation) -> *mut Self {
        Box::into_raw(Box::new(Self { relation }))
    }
}

impl fpt_transform {
    /// A handle for the caller.
    pub(super) fn handle(transform: Transform) -> *mut Self {
        Box::into_raw(Box::new(Self { transform }))
    }
}

/// The relation behind a handle.
///
/// # Safety
/// NULL or a live handle.
unsafe fn relation<'a>(
    name: &'static str,
    relation: *const fpt_relation,
) -> Result<&'a Relation, Failure> {
    // SAFETY: the caller vouches for it.
    Ok(&unsafe { shared(name, relation) }?.relation)
}

/// The transform behind a handle.
///
/// # Safety
/// NULL or a live handle.
pub(super) unsafe fn transform<'a>(
    name: &'static str,
    transform: *const fpt_transform,
) -> Result<&'a Transform, Failure> {
    // SAFETY: the caller vouches for it.
    Ok(&unsafe { shared(name, transform) }?.transform)
}

/// The circle form of a number: 0 is half turns of 4 poles, n is n equal arcs.
pub(super) fn circle_form(number: u32) -> CircleForm {
    if number == 0 { CircleForm::Halves } else { CircleForm::Arcs(number as usize) }
}

/// Two numbers of the caller.
///
/// # Safety
/// NULL or an array of two numbers.
unsafe fn pair(name: &'static str, pointer: *const f64) -> Result<[f64; 2], Failure> {
    // SAFETY: the caller vouches for it.
    let numbers = unsafe { array(name, pointer, 2) }?;
    Ok([numbers[0], numbers[1]])
}

/// The linear function that maps from[0] to to[0] and from[1] to to[1], bit for bit. It is continued outside.
///
/// @param from  increasing
/// @param to    two different numbers; falling: the relation falls
/// @param out   the handle; release it with fpt_relation_free
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_relation_linear(
    from: *const f64,
    to: *const f64,
    out: *mut *mut fpt_relation,
) -> fpt_status {
    // SAFETY: the header asks for two arrays and room for a handle.
    guard(|| unsafe {
        let out = place("out", out)?;
        *out = fpt_relation::handle(Relation::linear(pair("from", from)?, pair("to", to)?)?);
        Ok(())
    })
}

/// From the parameter of a circular arc, written as a rational spline of degree 2 in a standard form, to its angle. Both ways agree to
/// 1e-15 of the interval.
///
/// @param arcs   0: half turns of 4 poles with shared ends (4 poles for a sweep of pi, 7 for 2 pi). n: n equal arcs with
///               double knots between them (of a half turn 2 arcs have 5 poles; of a full one 4 arcs have 9, 3 arcs have 7)
/// @param sweep  angle of the whole arc, radians, more than 0, at most a full turn
/// @param from   first and last parameter of the spline, increasing
/// @param to     first and last angle, increasing, in any unit
/// @param out    the handle; release it with fpt_relation_free
/// @return FPT_INVALID_ARGUMENT also for a form that cannot make the sweep
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_relation_circle(
    arcs: u32,
    sweep: f64,
    from: *const f64,
    to: *const f64,
    out: *mut *mut fpt_relation,
) -> fpt_status {
    // SAFETY: the header asks for two arrays and room for a handle.
    guard(|| unsafe {
        let out = place("out", out)?;
        let (from, to) = (pair("from", from)?, pair("to", to)?);
        *out = fpt_relation::handle(Relation::circle(circle_form(arcs), sweep, from, to)?);
        Ok(())
    })
}

/// The piecewise linear relation through values at places.
///
/// @param places  increasing
/// @param values  all rising or all falling
/// @param count   of each, at least 2
/// @param out     the handle; release it with fpt_relation_free
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_relation_through(
    places: *const f64,
    values: *const f64,
    count: usize,
    out: *mut *mut fpt_relation,
) -> fpt_status {
    // SAFETY: the header asks for two arrays and room for a handle.
    guard(|| unsafe {
        let out = place("out", out)?;
        let (places, values) = (array("places", places, count)?, array("values", values, count)?);
        *out = fpt_relation::handle(Relation::through(places, values)?);
        Ok(())
    })
}

/// Relations one after the other along the domain: each begins where the one before ends, in domain and image, bit for bit.
///
/// @param pieces  count handles; they may be freed before or after the result
/// @param count   at least 1
/// @param out     the handle; release it with fpt_relation_free
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_relation_piecewise(
    pieces: *const *const fpt_relation,
    count: usize,
    out: *mut *mut fpt_relation,
) -> fpt_status {
    // SAFETY: the header asks for an array of live handles and room for a handle.
    guard(|| unsafe {
        let out = place("out", out)?;
        let handles = array("pieces", pieces, count)?;
        let pieces = handles
            .iter()
            .map(|&handle| relation("pieces", handle).cloned())
            .collect::<Result<Vec<_>, _>>()?;
        *out = fpt_relation::handle(Relation::piecewise(pieces)?);
        Ok(())
    })
}

/// The input of fpt_relation_from_callback.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct fpt_relation_callback {
    /// sizeof(fpt_relation_callback).
    pub struct_size: usize,
    /// The value at x in the domain: finite, all rising or all falling. Called from any thread; the same numbers for the same x; must
    /// not throw or longjmp.
    pub forward: Option<unsafe extern "C" fn(user: *mut c_void, x: f64) -> f64>,
    /// The place of a value.
    pub backward: Option<unsafe extern "C" fn(user: *mut c_void, y: f64) -> f64>,
    /// Handed to all three functions as it is.
    pub user: *mut c_void,
    /// Called once with `user` when nothing uses the functions any more. NULL: nothing to release.
    pub release: Option<unsafe extern "C" fn(user: *mut c_void)>,
    /// First and last place.
    pub domain: [f64; 2],
}

// SAFETY: repr(C), begins with struct_size; numbers, raw pointers and nullable function pointers.
unsafe impl SelfSized for fpt_relation_callback {
    const SHORTER: &'static [usize] = &[];

    fn defaults() -> Self {
        Self {
            struct_size: size_of::<Self>(),
            forward: None,
            backward: None,
            user: std::ptr::null_mut(),
            release: None,
            domain: [0.0; 2],
        }
    }
}

/// A relation by a function and its inverse. They are compared at 65 places here; that the function is monotone between them is the
/// caller's word. What uses such a relation is measured, not proven.
///
/// @param callback  the functions. After a failure nothing of it is kept and release is not called
/// @param out       the handle; release it with fpt_relation_free
/// @return FPT_INVALID_ARGUMENT for values that are not finite or not monotone, or an inverse that is off by more than 1e-9 of the domain
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_relation_from_callback(
    callback: *const fpt_relation_callback,
    out: *mut *mut fpt_relation,
) -> fpt_status {
    // SAFETY: the header asks for a callback struct and room for a handle.
    guard(|| unsafe {
        let out = place("out", out)?;
        let given = sized("callback", callback)?;
        let forward = given.forward.ok_or(Failure::Null("forward"))?;
        let backward = given.backward.ok_or(Failure::Null("backward"))?;
        let user = User::new(given.user, given.release);
        let function = |call: unsafe extern "C" fn(*mut c_void, f64) -> f64| -> Function {
            let kept = user.clone();
            std::sync::Arc::new(move |x| call(kept.data(), x))
        };
        let made = Relation::function(given.domain, function(forward), function(backward))?;
        *out = fpt_relation::handle(made);
        user.give_out();
        Ok(())
    })
}

/// The inverse of a relation.
///
/// @param out  the handle; release it with fpt_relation_free
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_relation_inverse(
    relation: *const fpt_relation,
    out: *mut *mut fpt_relation,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for a handle.
    guard(|| unsafe {
        let out = place("out", out)?;
        *out = fpt_relation::handle(self::relation("relation", relation)?.inverse());
        Ok(())
    })
}

/// A relation and then another one, whose domain is the image of the first.
///
/// @param out  the handle; release it with fpt_relation_free
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_relation_then(
    first: *const fpt_relation,
    next: *const fpt_relation,
    out: *mut *mut fpt_relation,
) -> fpt_status {
    // SAFETY: the header asks for live handles and room for a handle.
    guard(|| unsafe {
        let out = place("out", out)?;
        let made = relation("first", first)?.then(relation("next", next)?)?;
        *out = fpt_relation::handle(made);
        Ok(())
    })
}

/// Domain, and the values at its ends.
///
/// @param out_from  first and last place
/// @param out_to    the values there; falling when the relation falls
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_relation_domain(
    relation: *const fpt_relation,
    out_from: *mut f64,
    out_to: *mut f64,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for two numbers each.
    guard(|| unsafe {
        let relation = self::relation("relation", relation)?;
        let (from, to) = (output("out_from", out_from, 2)?, output("out_to", out_to, 2)?);
        let domain = relation.domain();
        from.copy_from_slice(&domain);
        to.copy_from_slice(&domain.map(|x| relation.apply(x)));
        Ok(())
    })
}

/// The values at many places. Linear relations are continued outside of the domain, others give the value at its end.
///
/// @param places  count numbers, finite
/// @param out     count numbers
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_relation_apply(
    relation: *const fpt_relation,
    places: *const f64,
    count: usize,
    out: *mut f64,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and two arrays.
    guard(|| unsafe {
        let relation = self::relation("relation", relation)?;
        let (places, out) = (array("places", places, count)?, output("out", out, count)?);
        check_finite("places", places)?;
        places.iter().zip(out).for_each(|(x, y)| *y = relation.apply(*x));
        Ok(())
    })
}

fn check_finite(name: &str, numbers: &[f64]) -> Result<(), Failure> {
    match numbers.iter().position(|x| !x.is_finite()) {
        Some(k) => Err(Failure::invalid(format!("{name}: entry {k} is not finite"))),
        None => Ok(()),
    }
}

/// Releases a relation. Transforms made of it stay. NULL is fine.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_relation_free(relation: *mut fpt_relation) {
    if !relation.is_null() {
        // SAFETY: a handle comes from Box::into_raw and is released once.
        let _ = guard(|| unsafe {
            drop(Box::from_raw(relation));
            Ok(())
        });
    }
}

/// The transform (u, v) -> (f(u), g(v)).
///
/// @param u     f; may be freed before or after the result
/// @param v     g, as well
/// @param swap  1: (u, v) -> (g(v), f(u)); 0: not
/// @param out   the handle; release it with fpt_transform_free
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_transform_new(
    u: *const fpt_relation,
    v: *const fpt_relation,
    swap: u32,
    out: *mut *mut fpt_transform,
) -> fpt_status {
    // SAFETY: the header asks for live handles and room for a handle.
    guard(|| unsafe {
        let out = place("out", out)?;
        let (u, v) = (relation("u", u)?.clone(), relation("v", v)?.clone());
        *out = fpt_transform::handle(Transform { u, v, swap: truth("swap", swap)? });
        Ok(())
    })
}

/// A choice of two.
pub(super) fn truth(name: &str, number: u32) -> Result<bool, Failure> {
    match number {
        0 => Ok(false),
        1 => Ok(true),
        other => Err(Failure::invalid(format!("{name}: {other} is neither 0 nor 1"))),
    }
}

/// The inverse of a transform.
///
/// @param out  the handle; release it with fpt_transform_free
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_transform_inverse(
    transform: *const fpt_transform,
    out: *mut *mut fpt_transform,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for a handle.
    guard(|| unsafe {
        let out = place("out", out)?;
        *out = fpt_transform::handle(self::transform("transform", transform)?.inverse());
        Ok(())
    })
}

/// A transform and then another one, whose domain is the image of the first.
///
/// @param out  the handle; release it with fpt_transform_free
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_transform_then(
    first: *const fpt_transform,
    next: *const fpt_transform,
    out: *mut *mut fpt_transform,
) -> fpt_status {
    // SAFETY: the header asks for live handles and room for a handle.
    guard(|| unsafe {
        let out = place("out", out)?;
        let made = transform("first", first)?.then(transform("next", next)?)?;
        *out = fpt_transform::handle(made);
        Ok(())
    })
}

/// Domain and image of a transform, and whether it keeps the direction of loops.
///
/// @param out_domain           u0, u1, v0, v1
/// @param out_image            the same of the image
/// @param out_keeps_direction  1: loops keep their direction; 0: they are turned
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_transform_domain(
    transform: *const fpt_transform,
    out_domain: *mut f64,
    out_image: *mut f64,
    out_keeps_direction: *mut i32,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and room for the numbers.
    guard(|| unsafe {
        let transform = self::transform("transform", transform)?;
        let domain = output("out_domain", out_domain, 4)?;
        let image = output("out_image", out_image, 4)?;
        let keeps = i32::from(transform.keeps_direction());
        write("out_keeps_direction", keeps, out_keeps_direction)?;
        domain.copy_from_slice(&transform.domain());
        image.copy_from_slice(&transform.image());
        Ok(())
    })
}

/// The images of many places.
///
/// @param uv     2 * count numbers, finite
/// @param out    2 * count numbers
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_transform_apply(
    transform: *const fpt_transform,
    uv: *const f64,
    count: usize,
    out: *mut f64,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and two arrays.
    guard(|| unsafe {
        let transform = self::transform("transform", transform)?;
        let places = array("uv", uv.cast::<[f64; 2]>(), count)?;
        check_finite("uv", places.as_flattened())?;
        let out = output("out", out.cast::<[f64; 2]>(), count)?;
        places.iter().zip(out).for_each(|(p, q)| *q = transform.apply(*p));
        Ok(())
    })
}

/// Releases a transform. NULL is fine.
/// @since 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_transform_free(transform: *mut fpt_transform) {
    if !transform.is_null() {
        // SAFETY: a handle comes from Box::into_raw and is released once.
        let _ = guard(|| unsafe {
            drop(Box::from_raw(transform));
            Ok(())
        });
    }
}
