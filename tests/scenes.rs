//! Laws of scenes: the answer is the nearest of the members' own answers, its bound holds for all of them.

mod shapes;

use std::sync::Arc;

use footpoint::batch;
use footpoint::closest::{FootPoint, QueryOptions, Scope, Workspace, flag};
use footpoint::curve::Curve;
use footpoint::index::{IndexedCurve, IndexedSurface};
use footpoint::scene::{
    Hint, Member, NO_MEMBER, Placement, Scene, SceneFoot, SceneWorkspace, Shape,
};
use footpoint::surface::Surface;
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use shapes::asked::bits;
use shapes::{EPS, FAMILIES, Random, Vector, curve, extent, norm, sub, surface};

fn config(cases: u32) -> ProptestConfig {
    ProptestConfig {
        failure_persistence: None,
        rng_seed: RngSeed::Fixed(0x666f_6f74),
        max_shrink_iters: 0,
        ..ProptestConfig::with_cases(cases)
    }
}

fn shape(family: usize, seed: u64) -> Shape {
    let family = &FAMILIES[family];
    if seed.is_multiple_of(3) {
        Shape::Curve(Arc::new(IndexedCurve::new(curve(family, seed))))
    } else {
        Shape::Surface(Arc::new(IndexedSurface::new(surface(family, seed))))
    }
}

fn bounding_box(shape: &Shape) -> (Vector, Vector) {
    match shape {
        Shape::Curve(curve) => curve.curve().bounding_box(),
        Shape::Surface(surface) => surface.surface().bounding_box(),
    }
}

fn evaluate(shape: &Shape, [u, v]: [f64; 2]) -> Vector {
    match shape {
        Shape::Curve(curve) => curve.curve().evaluate(u),
        Shape::Surface(surface) => surface.surface().evaluate(u, v),
    }
}

fn pick(shape: &Shape, r: &mut Random) -> [f64; 2] {
    let [u0, u1, v0, v1] = shape.domain();
    [r.between(u0, u1).clamp(u0, u1), r.between(v0, v1).clamp(v0, v1)]
}

/// A rotation about the middle of the shape and a move by up to `spread`; one in four stays where it is.
fn placement(shape: &Shape, spread: f64, r: &mut Random) -> Placement {
    let kind = r.whole(0, 3);
    if kind == 0 {
        return Placement::IDENTITY;
    }
    let x = if kind == 1 { [1.0, 0.0, 0.0] } else { r.direction() };
    let side = if kind == 1 { [0.0, 1.0, 0.0] } else { r.direction() };
    let z = shapes::cross(x, side);
    let z = z.map(|c| c / norm(z));
    let y = shapes::cross(z, x);
    let (low, high) = bounding_box(shape);
    let middle = [0, 1, 2].map(|k| 0.5 * (low[k] + high[k]));
    let rows = [x, y, z];
    let place = |k: usize| {
        let (a, move_) = (rows[k], r.between(-spread, spread));
        [a[0], a[1], a[2], middle[k] + move_ - shapes::dot(a, middle)]
    };
    let mut place = place;
    Placement::new([place(0), place(1), place(2)]).expect("a rigid placement")
}

/// Up to 24 members of up to five shapes, near one another.
fn scene(family: usize, seed: u64) -> Scene {
    let r = &mut Random(seed);
    let shapes: Vec<Shape> = (0..r.whole(1, 5))
        .map(|_| {
            let other = if r.whole(0, 3) == 0 { r.whole(0, FAMILIES.len() - 1) } else { family };
            shape(other, r.bits())
        })
        .collect();
    let members = (0..r.whole(1, 24)).map(|_| {
        let shape = &shapes[r.whole(0, shapes.len() - 1)];
        let spread = extent(bounding_box(shape)).0 * r.between(0.0, 2.0);
        Member { shape: shape.clone(), placement: placement(shape, spread, r) }
    });
    Scene::new(members.collect()).expect("a scene")
}

fn query(scene: &Scene, r: &mut Random) -> Vector {
    let Member { shape, placement } = &scene.members()[r.whole(0, scene.members().len() - 1)];
    let on = evaluate(shape, pick(shape, r));
    placement.place(shapes::query(bounding_box(shape), on, r))
}

fn accuracy(scene: &Scene) -> f64 {
    1e-10 * scene.bounding_box().diagonal()
}

/// What points and distances may be off by: coordinates of the scene, and of the shapes in their own frames.
fn rounding(scene: &Scene, member: &Member, query: Vector) -> f64 {
    let bounds = scene.bounding_box();
    let (diagonal, own) = extent(bounding_box(&member.shape));
    let shift = member.placement.matrix().iter().fold(0.0, |m: f64, row| m.max(row[3].abs()));
    let all = bounds.low.iter().chain(&bounds.high).chain(&query);
    let largest = all.fold(own.max(shift), |m: f64, x| m.max(x.abs()));
    EPS * (60.0 * diagonal + 32.0 * largest)
}

fn own_answer(member: &Member, query: Vector, options: &QueryOptions) -> FootPoint {
    let (entered, workspace) = (member.placement.enter(query), &mut Workspace::default());
    let mut foot = match &member.shape {
        Shape::Curve(curve) => curve.closest(entered, None, options, workspace, None),
        Shape::Surface(surface) => surface.closest(entered, None, options, workspace, None),
    };
    foot.point = member.placement.place(foot.point);
    foot.distance = norm(sub(foot.point, query));
    foot
}

fn ask(scene: &Scene, query: Vector) -> SceneFoot {
    scene.closest(query, None, &QueryOptions::default(), &mut SceneWorkspace::default())
}

/// The record with the member in it.
fn marked(SceneFoot { foot, member }: SceneFoot) -> FootPoint {
    FootPoint { iterations: foot.iterations ^ (member << 16), ..foot }
}

proptest! {
    #![proptest_config(config(300))]

    #[test]
    fn the_answer_is_the_nearest_of_the_members_and_its_bound_holds_for_each(
        family in 0..FAMILIES.len(), seed in any::<u64>(),
    ) {
        let (scene, r) = (scene(family, seed), &mut Random(!seed));
        let accuracy = accuracy(&scene);
        let options = QueryOptions { accuracy, ..QueryOptions::default() };
        for _ in 0..8 {
            let query = query(&scene, r);
            // Parts that a small budget leaves undecided must be in the bound, whoever has the foot.
            let budget = [0, 0, 1, 6][r.whole(0, 3)];
            let asked = QueryOptions { budget, ..QueryOptions::default() };
            let SceneFoot { foot, member } =
                scene.closest(query, None, &asked, &mut SceneWorkspace::default());
            let named = &scene.members()[member as usize];
            let there = named.placement.place(evaluate(&named.shape, [foot.u, foot.v]));
            prop_assert_eq!(foot.point, there);
            prop_assert!(foot.lower_bound >= 0.0 && foot.lower_bound <= foot.distance);
            let open = foot.flags & flag::NOT_PROVEN != 0;
            for (k, member) in scene.members().iter().enumerate() {
                let slack = rounding(&scene, member, query) + rounding(&scene, named, query);
                let own = own_answer(member, query, &options);
                prop_assert!(foot.lower_bound <= own.distance + slack, "{k}: {foot:?} {own:?}");
                let most = match (open, budget) {
                    (false, _) => 1.001 * accuracy,
                    (true, 0) => 1e-9 * scene.bounding_box().diagonal(),
                    _ => f64::INFINITY,
                };
                let most = own.distance + most + 40.0 * slack;
                prop_assert!(foot.distance <= most, "{k}: {foot:?} {own:?}");
                for _ in 0..40 {
                    let there = evaluate(&member.shape, pick(&member.shape, r));
                    let there = norm(sub(member.placement.place(there), query));
                    prop_assert!(foot.lower_bound <= there + slack, "{k}: {foot:?} {there:e}");
                }
            }
        }
    }
}

proptest! {
    #![proptest_config(config(100))]

    #[test]
    fn threads_order_and_workspaces_leave_the_bits(
        family in 0..FAMILIES.len(), seed in any::<u64>(),
    ) {
        let (scene, r) = (scene(family, seed), &mut Random(!seed));
        let queries: Vec<Vector> = (0..150).map(|_| query(&scene, r)).collect();
        scene.prepare(2, &mut || false).unwrap();
        let options = QueryOptions::default();
        let run = |threads: usize, order: &[usize]| {
            let mut out = vec![FootPoint::unreached(); order.len()];
            let work = |i: usize, workspace: &mut SceneWorkspace| {
                marked(scene.closest(queries[order[i]], None, &options, workspace))
            };
            batch::run(&mut out, threads, None, &work, &mut |_| false).unwrap();
            out
        };
        let forward: Vec<usize> = (0..queries.len()).collect();
        let backward: Vec<usize> = forward.iter().rev().copied().collect();
        let (one, three, back) = (run(1, &forward), run(3, &forward), run(1, &backward));
        for i in 0..queries.len() {
            prop_assert_eq!(bits(&one[i]), bits(&three[i]));
            prop_assert_eq!(bits(&one[i]), bits(&back[queries.len() - 1 - i]));
            prop_assert_eq!(bits(&one[i]), bits(&marked(ask(&scene, queries[i]))));
        }
    }

    #[test]
    fn a_hint_of_any_member_changes_the_distance_by_the_accuracy_at_most(
        family in 0..FAMILIES.len(), seed in any::<u64>(),
    ) {
        let (scene, r) = (scene(family, seed), &mut Random(!seed));
        let (accuracy, options) = (accuracy(&scene), QueryOptions::default());
        let workspace = &mut SceneWorkspace::default();
        for _ in 0..10 {
            let query = query(&scene, r);
            let plain = scene.closest(query, None, &options, workspace);
            let member = r.whole(0, scene.members().len() - 1);
            let shape = &scene.members()[member].shape;
            let at = (r.whole(0, 3) > 0).then(|| pick(shape, r));
            let hint = Hint { member: member as u32, at };
            let hinted = scene.closest(query, Some(hint), &options, workspace);
            prop_assert!(hinted.foot.flags & flag::HINT_USED != 0);
            let slack = 100.0 * rounding(&scene, &scene.members()[member], query);
            let open = (plain.foot.flags | hinted.foot.flags) & flag::NOT_PROVEN != 0;
            let diagonal = scene.bounding_box().diagonal();
            let most = if open { 1e-9 * diagonal } else { 1.001 * accuracy };
            let apart = (plain.foot.distance - hinted.foot.distance).abs();
            prop_assert!(apart <= most + slack, "{plain:?} {hinted:?}");
        }
    }
}

/// The bilinear square [0, 1]^2 at height 0.
fn square() -> Shape {
    let (knots, poles) =
        ([0., 0., 1., 1.], [[0., 0., 0.], [0., 1., 0.], [1., 0., 0.], [1., 1., 0.]]);
    let surface = Surface::new(&knots, &knots, 1, 1, &poles, 2, 2, None).unwrap();
    Shape::Surface(Arc::new(IndexedSurface::new(surface)))
}

fn moved(shift: Vector) -> Placement {
    let [x, y, z] = shift;
    Placement::new([[1., 0., 0., x], [0., 1., 0., y], [0., 0., 1., z]]).unwrap()
}

fn squares(shifts: &[Vector]) -> Scene {
    let shape = square();
    let members = shifts.iter().map(|s| Member { shape: shape.clone(), placement: moved(*s) });
    Scene::new(members.collect()).unwrap()
}

#[test]
fn members_at_the_same_distance_tie_and_the_lowest_number_is_named() {
    let scene = squares(&[[0., 0., 5.], [0., 0., 1.], [0., 0., -1.]]);
    let accuracy = accuracy(&scene);
    let is_tie = |height: f64| {
        let found = ask(&scene, [0.3, 0.6, height]);
        assert_eq!(found.foot.flags & flag::NOT_PROVEN, 0);
        (found.member, found.foot.flags & flag::TIE != 0)
    };
    assert_eq!(is_tie(0.0), (1, true));
    assert_eq!(is_tie(-0.25 * accuracy), (2, true));
    assert_eq!(is_tie(-0.45 * accuracy), (2, true));
    assert_eq!(is_tie(-2.0 * accuracy), (2, false));
    assert_eq!(is_tie(0.45 * accuracy), (1, true));
    assert_eq!(is_tie(2.0 * accuracy), (1, false));
    assert_eq!(is_tie(1.0), (1, false));
}

#[test]
fn one_point_of_several_members_is_one_foot() {
    // Two squares that share an edge, one of them twice.
    let scene = squares(&[[1., 0., 0.], [0., 0., 0.], [0., 0., 0.]]);
    for (query, member) in [([1.0, 0.5, 0.7], 0), ([0.5, 0.5, 0.7], 1), ([1.0, 0.25, 0.0], 0)] {
        let found = ask(&scene, query);
        assert_eq!((found.member, found.foot.flags & flag::TIE), (member, 0), "{query:?}");
        assert_eq!(found.foot.flags & flag::NOT_PROVEN, 0);
    }
}

#[test]
fn a_foot_of_an_unmoved_member_has_the_bits_of_its_shape() {
    let FootPoint { point, .. } = ask(&squares(&[[0.; 3], [9., 9., 9.]]), [0.1, 0.7, 3.0]).foot;
    let Shape::Surface(surface) = square() else { unreachable!() };
    let own = surface.closest(
        [0.1, 0.7, 3.0],
        None,
        &QueryOptions::default(),
        &mut Workspace::default(),
        None,
    );
    assert_eq!(point.map(f64::to_bits), own.point.map(f64::to_bits));
}

#[test]
fn derivatives_turn_with_the_member_and_points_move() {
    let shape = square();
    let quarter = Placement::new([[0., -1., 0., 2.], [1., 0., 0., 3.], [0., 0., 1., 4.]]).unwrap();
    let scene = Scene::new(vec![Member { shape, placement: quarter }]).unwrap();
    let mut out = [[0.0; 3]; 3];
    scene.derivatives(0, [0.25, 0.5], 1, &mut out);
    assert_eq!(out, [[1.5, 3.25, 4.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]]);
}

#[test]
fn normals_and_sides_turn_with_the_members() {
    let line = Curve::new(&[0., 0., 1., 1.], 1, &[[8., 0., 0.], [9., 0., 0.]], None).unwrap();
    let on_its_side =
        Placement::new([[1., 0., 0., 4.], [0., 0., -1., 0.], [0., 1., 0., 0.]]).unwrap();
    let scene = Scene::new(vec![
        Member { shape: square(), placement: Placement::IDENTITY },
        Member { shape: square(), placement: on_its_side },
        Member {
            shape: Shape::Curve(Arc::new(IndexedCurve::new(line))),
            placement: Placement::IDENTITY,
        },
    ])
    .unwrap();
    let queries =
        [[0.5, 0.5, 2.0], [4.5, 1.0, 0.5], [4.5, -1.0, 0.5], [8.5, 1.0, 0.0], [f64::NAN; 3]];
    let feet: Vec<SceneFoot> = queries.iter().map(|q| ask(&scene, *q)).collect();
    assert_eq!(feet.iter().map(|f| f.member).collect::<Vec<u32>>(), [0, 1, 1, 2, NO_MEMBER]);
    let mut facings = vec![None; queries.len()];
    let query = |i: usize| Some(queries[i]);
    scene.facings(&|i| feet[i], feet.len(), &query, &mut |i, f| facings[i] = Some(f)).unwrap();
    let told = |i: usize| (facings[i].unwrap().normal, facings[i].unwrap().signed);
    assert_eq!(told(0), ([0., 0., 1.], 2.0));
    assert_eq!(told(1), ([0., -1., 0.], -1.0));
    assert_eq!(told(2), ([0., -1., 0.], 1.0));
    assert!(told(3).0[0].is_nan() && told(3).1 == 1.0);
    assert!(told(4).0[0].is_nan() && told(4).1.is_nan());
}

#[test]
fn bad_and_far_queries_have_their_records() {
    let scene = squares(&[[0.; 3], [3., 0., 0.]]);
    for bad in [f64::NAN, f64::INFINITY, 1.1e100] {
        let found = ask(&scene, [0.0, bad, 0.0]);
        assert_eq!(found.member, NO_MEMBER);
        assert!(found.foot.flags & flag::BAD_QUERY != 0);
    }
    for far in [1e8, 1e30, 1e99] {
        let found = ask(&scene, [0.0, far, 0.0]);
        let gap = found.foot.distance - found.foot.lower_bound;
        assert!((found.foot.distance - far).abs() < 2.0 + 1e-15 * far && gap < 16.0 + 1e-14 * far);
    }
    let shape = Curve::new(&[0., 0., 1., 1.], 1, &[[0.; 3], [1e-60, 0., 0.]], None).unwrap();
    let shape = Shape::Curve(Arc::new(IndexedCurve::new(shape)));
    let members =
        [1e-60, 3e-60].map(|x| Member { shape: shape.clone(), placement: moved([0., x, 0.]) });
    let tiny = Scene::new(members.into()).unwrap();
    let found = ask(&tiny, [0., 1e99, 0.]);
    assert!(found.foot.distance == 1e99 && found.foot.lower_bound > 0.9e99, "{found:?}");
    assert_eq!(ask(&tiny, [0.5e-60, 4e-60, 0.]).member, 1);
}

#[test]
fn inversion_marks_by_the_scene_and_local_scope_stays_with_its_member() {
    let (scene, workspace) = (squares(&[[0.; 3], [10., 0., 0.]]), &mut SceneWorkspace::default());
    let options = QueryOptions::default();
    let near = 0.9e-7 * scene.bounding_box().diagonal();
    let mut flags = |height| scene.invert([0.5, 0.5, height], None, &options, workspace).foot.flags;
    assert_eq!(flags(near) & flag::NOT_ON_SHAPE, 0);
    assert_ne!(flags(1.3 * near) & flag::NOT_ON_SHAPE, 0);
    let local = QueryOptions { scope: Scope::Local, ..options };
    let hint = Hint { member: 1, at: Some([0.1, 0.2]) };
    let found = scene.closest([0.5, 0.5, 1.0], Some(hint), &local, workspace);
    assert_eq!((found.member, found.foot.lower_bound, found.foot.u), (1, 0.0, 0.0));
    assert!(found.foot.flags & flag::NOT_PROVEN != 0 && found.foot.point == [10., 0.5, 0.]);
    assert_eq!(scene.closest([0.5, 0.5, 1.0], None, &local, workspace).member, 0);
}

#[test]
fn members_share_a_shape_that_outlives_all_who_let_go() {
    let shape = square();
    let Shape::Surface(surface) = &shape else { unreachable!() };
    let surface = surface.clone();
    let member = |x: f64| Member { shape: shape.clone(), placement: moved([x, 0., 0.]) };
    let (first, second) = (
        Scene::new(vec![member(0.0), member(2.0)]).unwrap(),
        Scene::new(vec![member(4.0)]).unwrap(),
    );
    first.prepare(1, &mut || false).unwrap();
    drop((first, shape.clone()));
    assert_eq!(ask(&second, [4.5, 0.5, 1.0]).foot.distance, 1.0);
    drop((second, shape));
    assert_eq!(Arc::strong_count(&surface), 1);
}

#[test]
fn many_threads_may_be_the_first_at_once() {
    let scene = scene(1, 77);
    let queries: Vec<Vector> = (0..20).map(|k| query(&scene, &mut Random(k))).collect();
    let answers = || -> Vec<[u64; 9]> {
        scene.prepare(2, &mut || false).unwrap();
        queries.iter().map(|q| bits(&ask(&scene, *q).foot)).collect()
    };
    std::thread::scope(|scope| {
        let threads: Vec<_> = (0..4).map(|_| scope.spawn(answers)).collect();
        let all: Vec<_> = threads.into_iter().map(|thread| thread.join().unwrap()).collect();
        assert!(all.iter().all(|one| *one == all[0]));
    });
}

#[test]
fn a_cancelled_preparation_says_so_and_can_be_taken_up_again() {
    let scene = squares(&[[0.; 3], [2., 0., 0.]]);
    assert!(scene.prepare(2, &mut || true).is_err());
    let _ = scene.prepare(2, &mut || false);
    assert_eq!(ask(&scene, [0.5, 0.5, 1.0]).foot.distance, 1.0);
    assert!(Scene::new(Vec::new()).unwrap_err().to_string().starts_with("members: "));
}

/// Exact sums of doubles, rounded once at the end more or less: enough digits to judge bounds.
mod double {
    fn two_sum(a: f64, b: f64) -> (f64, f64) {
        let s = a + b;
        let t = s - a;
        (s, (a - (s - t)) + (b - t))
    }

    /// High and low part of a number.
    pub type Double = (f64, f64);

    pub fn add(a: Double, b: Double) -> Double {
        let (s, e) = two_sum(a.0, b.0);
        two_sum(s, e + (a.1 + b.1))
    }

    pub fn product(a: f64, b: f64) -> Double {
        let p = a * b;
        (p, a.mul_add(b, -p))
    }

    pub fn square(a: Double) -> Double {
        let (p, e) = product(a.0, a.0);
        two_sum(p, e + 2.0 * a.0 * a.1)
    }
}

/// The distance of the query to the placed point, to 30 digits, as a square.
fn exact_squared(placement: &Placement, point: Vector, query: Vector) -> double::Double {
    placement.matrix().iter().zip(query).fold((0.0, 0.0), |sum, (row, q)| {
        let mut d = double::add((row[3], 0.0), (-q, 0.0));
        for k in 0..3 {
            d = double::add(d, double::product(row[k], point[k]));
        }
        double::add(sum, double::square(d))
    })
}

#[test]
fn bounds_allow_for_the_rounding_of_placements() {
    // The nearest point is an end of a segment: a pole, known exactly. Shapes far from their own origin show most.
    let r = &mut Random(5);
    let mut least = f64::INFINITY;
    for k in 0..4000 {
        let far = r.scale(0.0, 7.0);
        let (start, along) = (r.direction().map(|x| far * x), r.direction());
        let end = [0, 1, 2].map(|k| start[k] + 3.0 * along[k]);
        let curve = Curve::new(&[0., 0., 1., 1.], 1, &[start, end], None).unwrap();
        let shape = Shape::Curve(Arc::new(IndexedCurve::new(curve)));
        let placement = placement(&shape, far, r);
        let away = r.scale(-6.0, 2.0);
        let beyond = [0, 1, 2].map(|k| start[k] - away * along[k]);
        let query = placement.place(beyond);
        let scene = Scene::new(vec![Member { shape, placement }]).unwrap();
        let options = QueryOptions { accuracy: 1e-300, ..QueryOptions::default() };
        let found = scene.closest(query, None, &options, &mut SceneWorkspace::default());
        let exact = exact_squared(&placement, start, query);
        let bound = double::square((found.foot.lower_bound, 0.0));
        let over = double::add(bound, (-exact.0, -exact.1));
        assert!(over.0 <= 0.0, "{k}: {found:?} over by {:e}", over.0);
        assert_eq!(found.foot.flags & flag::NOT_PROVEN, 0, "{k}: {found:?}");
        least = least.min(exact.0.sqrt() - found.foot.lower_bound);
    }
    assert!(least >= 0.0);
}
