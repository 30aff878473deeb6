//! A query allocates nothing once its workspace has grown to the shape, counted by the allocator; and what shapes and
//! scenes say about the bytes that they hold is what the allocator gave them.
//!
//! The one place outside the C layer with `unsafe`: an allocator cannot be written without it.
#![allow(unsafe_code, reason = "the counting allocator")]

mod shapes;

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;
use std::sync::Arc;

use footpoint::batch;
use footpoint::closest::{FootPoint, QueryOptions, Scope, Workspace};
use footpoint::curve::Curve;
use footpoint::index::{IndexedCurve, IndexedSurface};
use footpoint::intersect::{CastMemory, Caster, Hit, Ray};
use footpoint::normal::{Normals, Tangents, flag, of_curve, of_surface};
use footpoint::preimage::ProjectMemory;
use footpoint::refine::Method;
use footpoint::scene::{Hint, Member, Placement, Scene, SceneWorkspace};
use footpoint::surface::Surface;
use footpoint::unwrap::PathOutput;
use shapes::asked::Shape;
use shapes::{FAMILIES, Random, Vector};

struct Counting;

thread_local! {
    static COUNT: Cell<usize> = const { Cell::new(0) };
    static BYTES: Cell<isize> = const { Cell::new(0) };
}

fn held(more: usize, less: usize) {
    let _ = BYTES.try_with(|bytes| bytes.set(bytes.get() + more as isize - less as isize));
}

// SAFETY: hands everything on to the system's allocator; the counters are plain numbers of the thread.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        let _ = COUNT.try_with(|count| count.set(count.get() + 1));
        held(layout.size(), 0);
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        held(0, layout.size());
        unsafe { System.dealloc(pointer, layout) }
    }

    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        let _ = COUNT.try_with(|count| count.set(count.get() + 1));
        held(size, layout.size());
        unsafe { System.realloc(pointer, layout, size) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// Allocations of this thread during `work`.
fn allocations(work: impl FnOnce()) -> usize {
    let before = COUNT.with(Cell::get);
    work();
    COUNT.with(Cell::get) - before
}

/// What `make` made, and the bytes of this thread that it holds.
fn bytes<T>(make: impl FnOnce() -> T) -> (T, f64) {
    let before = BYTES.with(Cell::get);
    let made = make();
    (made, (BYTES.with(Cell::get) - before) as f64)
}

/// The surface of a meridian in the plane y = 0 turned about the z axis, as nine rational columns.
fn turned(knots_v: &[f64], degree_v: usize, meridian: &[([f64; 2], f64)]) -> Surface {
    let c = 0.5f64.sqrt();
    let ring = [(1., 0., 1.), (1., 1., c), (0., 1., 1.), (-1., 1., c), (-1., 0., 1.)];
    let ring = ring.into_iter().chain([(-1., -1., c), (0., -1., 1.), (1., -1., c), (1., 0., 1.)]);
    let (mut poles, mut weights) = (Vec::new(), Vec::new());
    for (x, y, w) in ring {
        for ([radius, z], weight) in meridian {
            poles.push([radius * x, radius * y, *z]);
            weights.push(w * weight);
        }
    }
    let knots_u = [0., 0., 0., 1., 1., 2., 2., 3., 3., 4., 4., 4.];
    let count = meridian.len();
    Surface::new(&knots_u, knots_v, 2, degree_v, &poles, 9, count, Some(&weights))
        .expect("a surface")
}

fn sphere() -> Surface {
    let c = 0.5f64.sqrt();
    let half = [([0., -1.], 1.), ([1., -1.], c), ([1., 0.], 1.), ([1., 1.], c), ([0., 1.], 1.)];
    turned(&[0., 0., 0., 1., 1., 2., 2., 2.], 2, &half)
}

fn cone() -> Surface {
    turned(&[0., 0., 1., 1.], 1, &[([0., 0.], 1.), ([2., 3.], 1.)])
}

/// Curves and surfaces of every kind: sphere and cone with their collapsed edges, each family, high degrees.
fn shapes() -> Vec<(String, Shape)> {
    let mut all = vec![
        ("sphere".into(), Shape::Surface(IndexedSurface::new(sphere()))),
        ("cone".into(), Shape::Surface(IndexedSurface::new(cone()))),
    ];
    for (k, family) in FAMILIES.iter().enumerate() {
        for seed in 0..2 {
            all.push((format!("{} {seed}", family.name), Shape::new(k, seed)));
        }
    }
    let r = &mut Random(1);
    for degrees in [[15, 15], [31, 2], [31, 31]] {
        let surface = shapes::surface_of(&FAMILIES[1], degrees, [1, 1], r);
        all.push((format!("degrees {degrees:?}"), Shape::Surface(IndexedSurface::new(surface))));
    }
    let curve: Curve = shapes::curve_of(&FAMILIES[1], 31, 3, r);
    all.push(("degree 31".into(), Shape::Curve(IndexedCurve::new(curve))));
    all
}

fn queries(shape: &Shape, count: usize) -> Vec<Vector> {
    let r = &mut Random(7);
    (0..count).map(|_| shape.query(r)).collect()
}

#[test]
fn a_query_allocates_nothing_with_a_workspace_that_has_seen_the_shape() {
    let [auto, maf, newton, osculating] =
        [Method::Auto, Method::Maf, Method::Newton, Method::Osculating]
            .map(|method| QueryOptions { method, ..QueryOptions::default() });
    for (name, shape) in shapes() {
        let (queries, [u0, u1, v0, v1]) = (queries(&shape, 40), shape.domain());
        let boxed = QueryOptions {
            domain: Some([0.7 * u0 + 0.3 * u1, u1, v0, 0.4 * v0 + 0.6 * v1]),
            ..auto
        };
        let mut workspace = Workspace::default();
        for (kind, options) in [
            ("auto", auto),
            ("maf", maf),
            ("newton", newton),
            ("osculating", osculating),
            ("box", boxed),
        ] {
            for hint in [None, Some([0.3 * u0 + 0.7 * u1, 0.5 * (v0 + v1)])] {
                let mut ask = || {
                    for query in &queries {
                        shape.ask_with(*query, hint, &options, &mut workspace);
                    }
                };
                ask();
                let count = allocations(ask);
                assert_eq!(count, 0, "{name}, {kind}, hint {hint:?}: {} queries", queries.len());
            }
        }
    }
}

#[test]
fn a_projection_allocates_nothing_with_a_memory_that_has_seen_the_shape() {
    let options = QueryOptions::default();
    for (name, shape) in shapes() {
        let points = queries(&shape, 40);
        let mut memory = ProjectMemory::default();
        let mut ask = |query: Vector| {
            let direction = [0.3, -0.2, 1.0];
            match &shape {
                Shape::Curve(curve) => curve.project(query, direction, &options, &mut memory),
                Shape::Surface(surface) => surface.project(query, direction, &options, &mut memory),
            };
        };
        points.iter().for_each(|query| ask(*query));
        let count = allocations(|| points.iter().for_each(|query| ask(*query)));
        assert_eq!(count, 0, "{name}");
    }
}

#[test]
fn a_local_query_allocates_nothing() {
    let local = QueryOptions { scope: Scope::Local, ..QueryOptions::default() };
    for (name, shape) in shapes() {
        let (queries, [u0, u1, v0, v1]) = (queries(&shape, 10), shape.domain());
        let (hint, mut workspace) = ([0.3 * u0 + 0.7 * u1, 0.5 * (v0 + v1)], Workspace::default());
        let mut ask = || {
            for query in &queries {
                shape.ask_with(*query, None, &local, &mut workspace);
                shape.ask_with(*query, Some(hint), &local, &mut workspace);
            }
        };
        ask();
        assert_eq!(allocations(ask), 0, "{name}");
    }
}

/// A batch keeps a list of its tiles, which doubles now and then; nothing else may grow with the queries.
#[test]
fn a_batch_allocates_as_often_for_many_queries_as_for_few() {
    for (name, shape) in shapes() {
        let queries = queries(&shape, 50);
        let options = QueryOptions::default();
        let run = |count: usize| {
            let mut out = vec![FootPoint::unreached(); count];
            let work = |i: usize, workspace: &mut Workspace| {
                shape.ask_with(queries[i % queries.len()], None, &options, workspace)
            };
            allocations(|| batch::run(&mut out, 1, None, &work, &mut |_| false).expect("a batch"))
        };
        run(1);
        let (few, many) = (run(100), run(1000));
        assert!(many <= few + 3, "{name}: {few} allocations for 100 queries, {many} for 1000");
    }
}

/// What goes with feet: everything that is made once is made before.
#[test]
fn normals_tangents_uncertainties_and_paths_allocate_nothing_per_foot() {
    for (name, shape) in shapes() {
        let (queries, options) = (queries(&shape, 60), QueryOptions::default());
        let feet: Vec<FootPoint> = queries.iter().map(|q| shape.ask(*q, None, &options)).collect();
        let query = |i: usize| queries[i % queries.len()];
        let joined = |count: usize| {
            let mut feet = feet[..count].to_vec();
            allocations(|| match &shape {
                Shape::Curve(curve) => curve
                    .join(&query, &mut feet, &options, PathOutput::default(), &mut || false)
                    .expect("a path"),
                Shape::Surface(surface) => surface
                    .join(&query, &mut feet, &options, PathOutput::default(), &mut || false)
                    .expect("a path"),
            })
        };
        assert_eq!(joined(60), joined(1), "{name}");
        let count = match &shape {
            Shape::Curve(curve) => {
                let (curve, tangents) = (curve.curve(), Tangents::new(curve.curve()));
                allocations(|| {
                    for foot in &feet {
                        let (tangent, flags) = tangents.at(foot.u);
                        let extent = of_curve(curve, false, foot, 1e-6);
                        assert!(
                            extent > 0.0
                                && (flags & flag::UNDEFINED != 0 || tangent[0].is_finite())
                        );
                    }
                })
            }
            Shape::Surface(surface) => {
                let (surface, normals) = (surface.surface(), Normals::new(surface.surface()));
                allocations(|| {
                    for (foot, query) in feet.iter().zip(&queries) {
                        let facing = normals.at(foot, Some(*query));
                        let extents = of_surface(surface, [false; 2], foot, 1e-6);
                        let none = facing.flags & flag::UNDEFINED != 0;
                        assert!(none || facing.normal[0].is_finite(), "{name}: {facing:?}");
                        assert!(extents[0] > 0.0 && extents[1] > 0.0, "{name}: {extents:?}");
                    }
                })
            }
        };
        assert_eq!(count, 0, "{name}");
    }
}

/// Rays from around a surface to points near it.
fn rays(shape: &IndexedSurface, count: usize) -> Vec<Ray> {
    let (low, high) = shape.surface().bounding_box();
    let r = &mut Random(5);
    let mut point = |by: f64| {
        [0, 1, 2].map(|k| {
            let (middle, half) = (0.5 * (low[k] + high[k]), 0.5 * (high[k] - low[k]) + 1e-3);
            middle + by * half * r.between(-1.0, 1.0)
        })
    };
    let all = [f64::NEG_INFINITY, f64::INFINITY];
    (0..count)
        .map(|_| {
            let (origin, to) = (point(3.0), point(0.9));
            Ray { origin, direction: [0, 1, 2].map(|k| to[k] - origin[k]), reach: all }
        })
        .collect()
}

/// A ray that touches the surface, or runs in it, is looked for with a tolerance, and its set of answers is new: these are left out.
#[test]
fn a_ray_allocates_nothing_with_a_memory_that_has_seen_the_surface() {
    let mut crossings = 0;
    for (name, shape) in shapes() {
        let Shape::Surface(surface) = shape else { continue };
        let knots = [surface.surface().knots_u(), surface.surface().knots_v()];
        // Few where evaluation is slow.
        let is_high = knots.iter().map(|k| k.degree() + 1).product::<usize>() > 500;
        let rays = rays(&surface, if is_high { 5 } else { 200 });
        let caster = Caster::new(Arc::new(surface), &mut || false).expect("a caster");
        let mut memory = CastMemory::default();
        let crossing: Vec<Ray> = rays
            .into_iter()
            .filter(|ray| {
                let before = memory.by_line();
                caster.cast(ray, &mut memory);
                caster.nearest(ray, &mut memory);
                memory.by_line() == before
            })
            .collect();
        let count = allocations(|| {
            for ray in &crossing {
                caster.cast(ray, &mut memory);
                crossings += memory.hits.len();
                caster.nearest(ray, &mut memory);
            }
        });
        assert_eq!(count, 0, "{name}: {} rays", crossing.len());
        let run = |count: usize| {
            let mut out = vec![Hit::none(0); count];
            let ray = |k: usize| crossing[k % crossing.len()];
            allocations(|| {
                caster.first_hits(&ray, &mut out, 1, &mut |_| false).expect("hits");
                caster.nearest_hits(&ray, &mut out, 1, &mut |_| false).expect("hits");
            })
        };
        if !crossing.is_empty() {
            let (few, many) = (run(200), run(2000));
            assert!(many <= few, "{name}: {few} allocations for 200 rays, {many} for 2000");
        }
    }
    assert!(crossings > 1000, "{crossings}");
}

#[test]
fn a_caster_tells_the_bytes_that_it_holds() {
    for (name, shape) in shapes() {
        let Shape::Surface(surface) = shape else { continue };
        let surface = Arc::new(surface);
        surface.prepare(&mut || false).expect("an index");
        let (caster, held) =
            bytes(|| Caster::new(surface.clone(), &mut || false).expect("a caster"));
        assert_told(caster.memory() - size_of::<Caster>(), held, &name);
    }
}

/// All shapes as members, each twice: where it stands and turned.
fn scene() -> Scene {
    let turned = [[0.6, -0.8, 0., 1.], [0.8, 0.6, 0., -2.], [0., 0., 1., 0.5]];
    let places = [Placement::IDENTITY, Placement::new(turned).expect("a placement")];
    let members = shapes().into_iter().flat_map(|(_, shape)| {
        let shape = match shape {
            Shape::Curve(curve) => footpoint::scene::Shape::Curve(Arc::new(curve)),
            Shape::Surface(surface) => footpoint::scene::Shape::Surface(Arc::new(surface)),
        };
        places.map(|placement| Member { shape: shape.clone(), placement })
    });
    Scene::new(members.collect()).expect("a scene")
}

#[test]
fn a_query_of_a_scene_allocates_nothing_with_a_workspace_that_has_seen_the_scene() {
    let scene = scene();
    scene.prepare(1, &mut || false).expect("indexes");
    let (mut workspace, options) = (SceneWorkspace::default(), QueryOptions::default());
    let bounds = scene.bounding_box();
    let r = &mut Random(9);
    let queries: Vec<(Vector, Option<Hint>)> = (0..60)
        .map(|k| {
            let member = (k * 7 % scene.members().len()) as u32;
            let near = |k: usize| r.between(bounds.low[k], bounds.high[k]) * 0.01;
            ([0, 1, 2].map(near), (k % 3 == 0).then_some(Hint { member, at: None }))
        })
        .collect();
    let mut ask = || {
        for (query, hint) in &queries {
            scene.closest(*query, *hint, &options, &mut workspace);
        }
    };
    ask();
    assert_eq!(allocations(ask), 0);
}

/// Two percent, and what an empty allocation costs.
fn assert_told(told: usize, held: f64, name: &str) {
    let apart = (told as f64 - held).abs();
    assert!(apart <= 0.02 * held + 64.0, "{name}: {told} bytes told, {held} held");
}

#[test]
fn shapes_and_scenes_tell_the_bytes_that_they_hold() {
    for ready in [false, true] {
        for (name, shape) in shapes() {
            let (told, inline) = match &shape {
                Shape::Curve(curve) => {
                    assert!(!ready || curve.prepare(&mut || false).is_ok());
                    (curve.memory(), size_of_val(curve))
                }
                Shape::Surface(surface) => {
                    assert!(!ready || surface.prepare(&mut || false).is_ok());
                    (surface.memory(), size_of_val(surface))
                }
            };
            let ((), left) = bytes(|| drop(shape));
            assert_told(told - inline, -left, &format!("{name}, ready {ready}"));
        }
        let scene = scene();
        assert!(!ready || scene.prepare(1, &mut || false).is_ok());
        let told = scene.memory() - size_of::<Scene>();
        let ((), left) = bytes(|| drop(scene));
        assert_told(told, -left, &format!("a scene, ready {ready}"));
    }
}
