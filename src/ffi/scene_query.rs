//! Batches of queries on scenes, and the normals of their feet.

use super::limits::check_inside_at;
use super::memory::{Points, Strided, array, optional_array, optional_output, output};
use super::options::fpt_query_options;
use super::query::{Callbacks, LARGE, check_hints};
use super::records::{feet, fpt_foot_point};
use super::scene::{self, fpt_scene};
use super::{Failure, fpt_status, guard};
use crate::batch;
use crate::closest::{FootPoint, QueryOptions};
use crate::error::Error;
use crate::scene::{Hint, NO_MEMBER, Scene, SceneFoot, SceneWorkspace, Shape};
use std::sync::atomic::{AtomicU32, Ordering};

/// The nearest point of all members of the scene for each query point, with a proven lower bound of the distance: as
/// fpt_surface_closest, for all members at once.
///
/// The records' `u` and `v` are parameters of the member that is named beside them; `point` is where it stands (see
/// fpt_scene_evaluate); `lower_bound` holds for every member. Of members at the same distance the lowest number is named. A
/// foot of another member within the accuracy sets FPT_FOOT_TIE when it is another point in space; where members
/// meet, or lie upon each other, their common point is one foot. The bound allows for the rounding of the placements.
/// options->budget is that of each member that a query comes to. FPT_SCOPE_LOCAL iterates on the hint's member only,
/// without a hint on one whose box is nearest.
///
/// @param points       `count` query points x,y,z, options->point_stride bytes apart. A bad point (NaN, infinite, beyond
///                     1e100) marks its own record with FPT_FOOT_BAD_QUERY
/// @param count        may be 0, then all arrays may be NULL
/// @param options      NULL: the defaults, relative to the diagonal of the scene's box. `domain` must be all 0 and `trace`
///                     NULL: FPT_UNSUPPORTED. `hints` hold (u,v) of the hinted member, on a curve v is not looked at
/// @param hint_members the member to begin with, per query; UINT32_MAX: no hint for this query. With options->hints the
///                     search begins there, where they are NULL or NaN with the member alone. Any other number
///                     that is not a member's is FPT_INVALID_ARGUMENT. NULL: no hints, then options->hints must be NULL too
/// @param out          `count` records, packed; must not overlap `points` or the hints
/// @param out_members  `count` members' numbers, UINT32_MAX where there is no foot; NULL: not wanted
/// @return as fpt_surface_closest
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_scene_closest(
    scene: *const fpt_scene,
    points: *const f64,
    count: usize,
    options: *const fpt_query_options,
    hint_members: *const u32,
    out: *mut fpt_foot_point,
    out_members: *mut u32,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and arrays of these lengths that do not overlap.
    guard(|| unsafe {
        let scene = scene::scene(scene)?;
        let given = SceneBatch::read(scene, points, count, options, hint_members)?;
        given.run(out, out_members, Scene::closest)
    })
}

/// The members and parameters of points that lie in the scene: as fpt_scene_closest, and points proven to be farther from
/// every member than options->tolerance are marked with FPT_FOOT_NOT_ON_SHAPE.
///
/// @param points       as for fpt_scene_closest
/// @param count        as for fpt_scene_closest
/// @param options      as for fpt_scene_closest
/// @param hint_members as for fpt_scene_closest
/// @param out          as for fpt_scene_closest
/// @param out_members  as for fpt_scene_closest
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_scene_invert(
    scene: *const fpt_scene,
    points: *const f64,
    count: usize,
    options: *const fpt_query_options,
    hint_members: *const u32,
    out: *mut fpt_foot_point,
    out_members: *mut u32,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and arrays of these lengths that do not overlap.
    guard(|| unsafe {
        let scene = scene::scene(scene)?;
        let given = SceneBatch::read(scene, points, count, options, hint_members)?;
        given.run(out, out_members, Scene::invert)
    })
}

/// As fpt_scene_closest, for query points in single precision; see fpt_surface_closest_f32.
///
/// @param points       `count` query points x,y,z, options->point_stride bytes apart, without alignment
/// @param count        as for fpt_scene_closest
/// @param options      as for fpt_scene_closest; hints are doubles
/// @param hint_members as for fpt_scene_closest
/// @param out          as for fpt_scene_closest
/// @param out_members  as for fpt_scene_closest
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_scene_closest_f32(
    scene: *const fpt_scene,
    points: *const f32,
    count: usize,
    options: *const fpt_query_options,
    hint_members: *const u32,
    out: *mut fpt_foot_point,
    out_members: *mut u32,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and arrays of these lengths that do not overlap.
    guard(|| unsafe {
        let scene = scene::scene(scene)?;
        let given = SceneBatch::read(scene, points, count, options, hint_members)?;
        given.run(out, out_members, Scene::closest)
    })
}

/// As fpt_scene_invert, for query points in single precision; see fpt_surface_invert_f32.
///
/// @param points       `count` query points x,y,z, options->point_stride bytes apart, without alignment
/// @param count        as for fpt_scene_closest
/// @param options      as for fpt_scene_closest; hints are doubles
/// @param hint_members as for fpt_scene_closest
/// @param out          as for fpt_scene_closest
/// @param out_members  as for fpt_scene_closest
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_scene_invert_f32(
    scene: *const fpt_scene,
    points: *const f32,
    count: usize,
    options: *const fpt_query_options,
    hint_members: *const u32,
    out: *mut fpt_foot_point,
    out_members: *mut u32,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and arrays of these lengths that do not overlap.
    guard(|| unsafe {
        let scene = scene::scene(scene)?;
        let given = SceneBatch::read(scene, points, count, options, hint_members)?;
        given.run(out, out_members, Scene::invert)
    })
}

/// The checked inputs of one call.
struct SceneBatch<'a> {
    scene: &'a Scene,
    points: Strided<'a, 3>,
    hints: Option<Strided<'a, 2>>,
    hint_members: Option<&'a [u32]>,
    options: QueryOptions,
    threads: usize,
    callbacks: Callbacks,
}

impl<'a> SceneBatch<'a> {
    /// Reads every input.
    ///
    /// # Safety
    /// Pointers that are not NULL point to what the header asks for, for as long as the call lasts.
    unsafe fn read(
        scene: &'a Scene,
        points: impl Into<Points>,
        count: usize,
        options: *const fpt_query_options,
        hint_members: *const u32,
    ) -> Result<Self, Failure> {
        // SAFETY: the caller vouches for the pointers.
        unsafe {
            let given = fpt_query_options::read(options)?;
            let options = given.checked(4)?;
            if options.domain.is_some() {
                return Err(unsupported("domain: a scene has no restriction"));
            }
            if given.trace.is_some() {
                return Err(unsupported("trace: a scene tells no iterations"));
            }
            let stride = ("point_stride", given.point_stride);
            let points = Strided::new(("points", points), count, stride)?;
            let hint_members = optional_array("hint_members", hint_members, count)?;
            hint_members.map_or(Ok(()), |numbers| check_members("hint_members", numbers, scene))?;
            let hints = if given.hints.is_null() {
                None
            } else {
                let stride = ("hint_stride", given.hint_stride);
                Some(Strided::new(("hints", given.hints), count, stride)?)
            };
            if hints.is_some() && hint_members.is_none() && count > 0 {
                return Err(Failure::Null("hint_members"));
            }
            hints.as_ref().map_or(Ok(()), check_hints)?;
            let (threads, callbacks) = (given.thread_count(), Callbacks::of(&given));
            Ok(Self { scene, points, hints, hint_members, options, threads, callbacks })
        }
    }

    fn hint(&self, i: usize) -> Option<Hint> {
        let member = self.hint_members.map(|members| members[i]).filter(|&m| m != NO_MEMBER)?;
        let at = self.hints.as_ref().map(|hints| hints.row(i));
        let [is_curve, known] = [
            matches!(self.scene.members()[member as usize].shape, Shape::Curve(_)),
            at.is_some_and(|at| !at[0].is_nan()),
        ];
        let at = at.filter(|at| known && (is_curve || !at[1].is_nan()));
        Some(Hint { member, at: at.map(|[u, v]| [u, if is_curve { 0.0 } else { v }]) })
    }

    /// Asks `ask` for every point.
    ///
    /// # Safety
    /// As [`output`], for both arrays.
    unsafe fn run(
        self,
        out: *mut fpt_foot_point,
        out_members: *mut u32,
        ask: impl Fn(&Scene, [f64; 3], Option<Hint>, &QueryOptions, &mut SceneWorkspace) -> SceneFoot
        + Sync,
    ) -> Result<(), Failure> {
        let total = self.points.len();
        // SAFETY: the caller vouches for the arrays; atomic numbers have the layout of plain ones.
        let (out, members) = unsafe {
            let members = optional_output("out_members", out_members.cast::<AtomicU32>(), total)?;
            (feet(out, total)?, members.map(|members| &*members))
        };
        if total == 0 {
            return Ok(());
        }
        members.into_iter().flatten().for_each(|member| member.store(NO_MEMBER, Ordering::Relaxed));
        let callbacks = &self.callbacks;
        let built = self.scene.prepare(self.threads, &mut || callbacks.poll(0, total));
        if built == Err(Error::Cancelled) {
            out.fill(FootPoint::unreached());
        }
        built?;
        let work = |i: usize, workspace: &mut SceneWorkspace| {
            let found = ask(self.scene, self.points.row(i), self.hint(i), &self.options, workspace);
            if let Some(members) = members {
                members[i].store(found.member, Ordering::Relaxed);
            }
            found.foot
        };
        let at = |i: usize| self.points.row(i);
        let place: Option<batch::Place> =
            if total > batch::GROUP && self.scene.memory() > LARGE { Some(&at) } else { None };
        batch::run(out, self.threads, place, &work, &mut |done| callbacks.poll(done, total))?;
        callbacks.report(total, total);
        Ok(())
    }
}

fn unsupported(text: &str) -> Failure {
    Error::Unsupported(text.into()).into()
}

/// Refuses numbers that are no member's.
fn check_members(name: &str, numbers: &[u32], scene: &Scene) -> Result<(), Failure> {
    let count = scene.members().len();
    let wrong = |&n: &u32| n != NO_MEMBER && n as usize >= count;
    match numbers.iter().position(wrong) {
        Some(i) => {
            let text =
                format!("{name}: entry {i} is {}, the scene has {count} members", numbers[i]);
            Err(Failure::invalid(text))
        }
        None => Ok(()),
    }
}

/// The unit normal of the member at each foot, turned with it, and on which side of it the query lies: as
/// fpt_surface_normals. Feet on curves and feet without a member have no normal (FPT_NORMAL_UNDEFINED).
///
/// The side is that of the one member: where the members together bound a solid, feet on their common edges and corners
/// tell the side of one face only.
///
/// @param points      x,y,z of the query of each foot, packed; NULL: normals only, then `out_signed` must be NULL
/// @param feet        `count` records, as fpt_scene_closest gives them. Parameters outside the member's domain are
///                    FPT_INVALID_ARGUMENT; NaN parameters have no normal
/// @param members     `count` numbers beside them; UINT32_MAX: no member
/// @param count       may be 0
/// @param out_normals 3*count numbers; NaN where there is no normal
/// @param out_signed  `count` numbers or NULL, as for fpt_surface_normals
/// @param out_flags   `count` numbers or NULL: sums of fpt_normal_flag values
/// @since 0.1
#[must_use]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fpt_scene_normals(
    scene: *const fpt_scene,
    points: *const f64,
    feet: *const fpt_foot_point,
    members: *const u32,
    count: usize,
    out_normals: *mut f64,
    out_signed: *mut f64,
    out_flags: *mut u32,
) -> fpt_status {
    // SAFETY: the header asks for a live handle and arrays of these lengths that do not overlap.
    guard(|| unsafe {
        let scene = scene::scene(scene)?;
        let points = optional_array("points", points.cast::<[f64; 3]>(), count)?;
        let feet = array("feet", feet.cast::<FootPoint>(), count)?;
        let members = array("members", members, count)?;
        check_members("members", members, scene)?;
        check_feet(scene, feet, members)?;
        let out = output("out_normals", out_normals.cast::<[f64; 3]>(), count)?;
        let mut signed = optional_output("out_signed", out_signed, count)?;
        let mut flags = optional_output("out_flags", out_flags, count)?;
        if signed.is_some() && points.is_none() && count > 0 {
            return Err(Failure::Null("points"));
        }
        let foot = |i: usize| SceneFoot { foot: feet[i], member: members[i] };
        let query = |i: usize| points.map(|points| points[i]);
        scene.facings(&foot, count, &query, &mut |i, facing| {
            out[i] = facing.normal;
            if let Some(signed) = &mut signed {
                signed[i] = facing.signed;
            }
            if let Some(flags) = &mut flags {
                flags[i] = facing.flags;
            }
        })?;
        Ok(())
    })
}

/// Refuses parameters outside the domain of their member.
fn check_feet(scene: &Scene, feet: &[FootPoint], members: &[u32]) -> Result<(), Failure> {
    for (i, foot) in feet.iter().enumerate() {
        let Some(member) = scene.members().get(members[i] as usize) else { continue };
        let [u0, u1, v0, v1] = member.shape.domain();
        for (name, x, first, last) in [("u", foot.u, u0, u1), ("v", foot.v, v0, v1)] {
            if !x.is_nan() {
                check_inside_at("feet", i, name, x, first, last)?;
            }
        }
    }
    Ok(())
}
