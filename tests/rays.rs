//! Rays against closed forms: all hits, at any angle, on any surface; the same bits for any number of threads.

#[allow(dead_code, reason = "one surface of the cases only")]
#[path = "cases/mod.rs"]
mod cases;
mod known_shapes;

use footpoint::index::IndexedSurface;
use footpoint::intersect::{CastMemory, Caster, Hit, Ray, RayHits, ray_flag};
use known_shapes::{Random, Vector, cylinder, dot, norm, sphere, sub, torus};
use std::sync::Arc;

const ALL: [f64; 2] = [f64::NEG_INFINITY, f64::INFINITY];

fn caster(shape: IndexedSurface) -> Caster {
    Caster::new(Arc::new(shape), &mut || false).unwrap()
}

fn hits(caster: &Caster, ray: &Ray) -> Vec<Hit> {
    let mut memory = CastMemory::default();
    let flags = caster.cast(ray, &mut memory);
    assert_eq!(flags, 0, "{ray:?}");
    memory.hits
}

fn unit(v: Vector) -> Vector {
    v.map(|x| x / norm(v))
}

#[test]
fn lines_meet_a_sphere_twice_or_not_at_all() {
    let caster = caster(sphere([0.0, 1.0]));
    let mut random = Random(3);
    for k in 0..20_000 {
        let (origin, direction) = (random.point(2.0), unit(random.point(1.0)));
        let found = hits(&caster, &Ray { origin, direction, reach: ALL });
        let middle = -dot(origin, direction);
        let square = 1.0 - dot(origin, origin) + middle * middle;
        if square.abs() < 1e-12 {
            continue;
        }
        if square < 0.0 {
            assert!(found.is_empty(), "{k}: {found:?}");
            continue;
        }
        assert_eq!(found.len(), 2, "{k}: {square} {found:?}");
        for (hit, sign) in found.iter().zip([-1.0, 1.0]) {
            let t = middle + sign * square.sqrt();
            assert!((hit.t - t).abs() < 1e-14 / square.sqrt() + 2e-15, "{} {t} {square:e}", hit.t);
            assert!((norm(hit.point) - 1.0).abs() < 4e-16 * 4.0);
        }
    }
}

#[test]
fn special_lines_meet_a_sphere_as_they_should() {
    let caster = caster(sphere([0.0, 1.0]));
    let ask = |origin, direction| hits(&caster, &Ray { origin, direction, reach: ALL });
    // Through the poles, through knot lines and corners, through the seam.
    for direction in
        [[0., 0., 1.], [1., 0., 0.], [0., 1., 0.], [1., 1., 0.], [-1., 0., 1.], [0., 2., 2.]]
    {
        let found = ask([0.0; 3], direction);
        assert_eq!(found.len(), 2, "{direction:?} {found:?}");
        assert!((found[0].t + 1.0).abs() < 1e-14 && (found[1].t - 1.0).abs() < 1e-14);
    }
    // Touching.
    for (origin, direction) in [
        ([1.0, 0.0, -3.0], [0.0, 0.0, 1.0]),
        ([0.0, 0.0, 1.0], [1.0, 0.3, 0.0]),
        ([0.6, 0.8, 0.2], [0.0, 0.0, 1.0]),
    ] {
        let found = ask(origin, direction);
        assert_eq!(found.len(), 1, "{origin:?} {found:?}");
        assert!(found[0].flags & ray_flag::TANGENTIAL != 0, "{found:?}");
    }
    // Half lines count from where they begin.
    let ray = Ray { origin: [0.0; 3], direction: [0.3, 0.1, 0.2], reach: [0.0, f64::INFINITY] };
    assert_eq!(hits(&caster, &ray).len(), 1);
    let ray = Ray { reach: [0.0, 0.9], ..ray };
    assert!(hits(&caster, &ray).is_empty());
}

#[test]
fn lines_meet_a_torus_as_often_as_the_quartic_has_zeros() {
    let caster = caster(torus());
    let mut random = Random(5);
    let off = |x: Vector| (x[0].hypot(x[1]) - 2.0).hypot(x[2]) - 0.5;
    let mut by_count = [0; 5];
    for _ in 0..5_000 {
        let (origin, direction) = (random.point(2.0), unit(random.point(1.0)));
        let found = hits(&caster, &Ray { origin, direction, reach: ALL });
        // Signs along the line, dense.
        let at = |t: f64| off([0, 1, 2].map(|c| origin[c] + t * direction[c]));
        let steps = 4_000;
        let sign = |k: usize| at(-6.0 + 12.0 * k as f64 / steps as f64) > 0.0;
        let changes = (1..=steps).filter(|&k| sign(k) != sign(k - 1)).count();
        assert!(found.len() >= changes, "{} {changes}", found.len());
        assert!((found.len() - changes).is_multiple_of(2) && found.len() <= 4);
        assert!(found.iter().all(|hit| off(hit.point).abs() < 1e-15 * 8.0));
        by_count[found.len()] += 1;
    }
    assert!(by_count[2] > 500 && by_count[4] > 100, "{by_count:?}");
}

#[test]
fn a_line_in_the_surface_is_an_overlap() {
    let caster = caster(cylinder([0.0, 1.0]));
    let ray = Ray { origin: [0.6, 0.8, -7.0], direction: [0.0, 0.0, 3.0], reach: ALL };
    let found = hits(&caster, &ray);
    assert_eq!(found.len(), 1, "{found:?}");
    assert!(found[0].flags & ray_flag::OVERLAP != 0);
    assert!((found[0].t - 6.0).abs() < 1e-9, "{found:?}");
}

#[test]
fn bad_rays_are_marked() {
    let caster = caster(cylinder([0.0, 1.0]));
    let good = Ray { origin: [0.0; 3], direction: [1.0, 0.0, 0.0], reach: ALL };
    let mut memory = CastMemory::default();
    for ray in [
        Ray { origin: [f64::NAN, 0.0, 0.0], ..good },
        Ray { direction: [0.0; 3], ..good },
        Ray { direction: [f64::INFINITY, 0.0, 0.0], ..good },
        Ray { reach: [f64::NAN, 1.0], ..good },
    ] {
        assert!(caster.cast(&ray, &mut memory) & ray_flag::BAD_RAY != 0);
        assert!(memory.hits.is_empty());
    }
}

/// Points of the surface with a line through each: the line must hit there.
#[test]
fn a_line_through_a_point_of_any_surface_hits_it() {
    let committed = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data");
    for entry in std::fs::read_dir(committed).unwrap() {
        let folder = entry.unwrap().path();
        if !folder.is_dir() {
            continue;
        }
        let case = cases::read(&folder);
        let cases::Shape::Surface(shape) = case.shape else { continue };
        let caster = caster(shape);
        let surface = caster.shape().surface();
        let [u0, u1, v0, v1] = surface.domain();
        let mut random = Random(11);
        let mut memory = CastMemory::default();
        for k in 0..60 {
            let at = [random.between(0.02, 0.98), random.between(0.02, 0.98)];
            let (u, v) = (u0 + at[0] * (u1 - u0), v0 + at[1] * (v1 - v0));
            let point = surface.evaluate(u, v);
            let direction = unit(random.point(1.0));
            let origin = [0, 1, 2].map(|c| point[c] - direction[c] * case.diagonal);
            let flags = caster.cast(&Ray { origin, direction, reach: ALL }, &mut memory);
            if flags & ray_flag::NOT_PROVEN != 0 {
                continue;
            }
            let near = 1e-9 * case.diagonal + 1e-13 * case.magnitude;
            let is_hit = memory.hits.iter().any(|hit| {
                norm(sub(hit.point, point)) < near || hit.flags & ray_flag::OVERLAP != 0
            });
            assert!(is_hit, "{} {k}: ({u}, {v}) {point:?} {:?}", case.name, memory.hits);
        }
    }
}

#[test]
fn batches_have_the_same_bits_for_any_number_of_threads() {
    let caster = caster(torus());
    let mut random = Random(17);
    let rays: Vec<Ray> = (0..3_000)
        .map(|_| Ray { origin: random.point(3.0), direction: random.point(1.0), reach: ALL })
        .collect();
    let cast = |threads: usize| {
        let mut out = vec![Hit::none(0); rays.len()];
        caster.first_hits(&|k| rays[k], &mut out, threads, &mut |_| false).unwrap();
        out
    };
    let one = cast(1);
    let bits = |list: &[Hit]| {
        list.iter().map(|h| (h.t.to_bits(), h.u.to_bits(), h.count)).collect::<Vec<_>>()
    };
    assert_eq!(bits(&one), bits(&cast(4)));
    let all = caster.all_hits(&|k| rays[k], rays.len(), 3, &mut |_| false).unwrap();
    for (k, hit) in one.iter().enumerate() {
        let own = &all.hits[all.starts[k]..all.starts[k + 1]];
        assert_eq!(own.len(), hit.count as usize);
        assert!(own.is_empty() || own[0].t == hit.t);
        assert!(own.windows(2).all(|pair| pair[0].t <= pair[1].t));
    }
    let stopped =
        caster.first_hits(&|k| rays[k], &mut vec![Hit::none(0); 3_000], 1, &mut |done| done > 500);
    assert!(stopped.is_err());
    // What a stop leaves: hits of the rays that were cast, the others are not proven. Also between the two casts of a ray.
    for after in [0, 500, 2_999, 3_000] {
        let part = caster.all_hits(&|k| rays[k], rays.len(), 1, &mut |done| done >= after).unwrap();
        assert!(part.stopped && part.starts.len() == rays.len() + 1);
        let mut missing = 0;
        for k in 0..rays.len() {
            let of = |list: &RayHits| list.hits[list.starts[k]..list.starts[k + 1]].to_vec();
            let (got, want) = (of(&part), of(&all));
            let is_whole = part.flags[k] & ray_flag::NOT_PROVEN == 0;
            assert!(if is_whole { got == want } else { got.len() <= 1 && got.len() <= want.len() });
            missing += usize::from(!is_whole);
        }
        assert!(missing > 0 && (after == 0 || missing < rays.len()), "{after}: {missing}");
    }
}

#[test]
fn the_first_hit_alone_is_the_first_of_all() {
    let mut random = Random(23);
    for shape in [torus(), sphere([0.0, 1.0]), cylinder([0.0, 1.0])] {
        let caster = caster(shape);
        let (mut memory, mut several) = (CastMemory::default(), 0);
        for k in 0..4_000 {
            let reach = if k % 2 == 0 { ALL } else { [0.0, f64::INFINITY] };
            let ray = Ray { origin: random.point(2.5), direction: random.point(1.0), reach };
            let (first, alone) =
                (caster.first(&ray, &mut memory), caster.nearest(&ray, &mut memory));
            assert_eq!(alone.count, first.count.min(1), "{ray:?} {first:?} {alone:?}");
            several += usize::from(first.count > 1);
            if first.count > 0 {
                assert_eq!(alone, Hit { count: 1, ..first }, "{ray:?}");
            }
        }
        assert!(several > 150, "{several}");
    }
    let bad = Ray { origin: [0.0; 3], direction: [0.0; 3], reach: ALL };
    let hit = caster(torus()).nearest(&bad, &mut CastMemory::default());
    assert!(hit.flags & ray_flag::BAD_RAY != 0 && hit.count == 0);
}
