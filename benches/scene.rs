//! A scene of a thousand real surfaces against one surface, on the same queries.
//!
//! `cargo bench --bench scene`, and part of `make bench`; arguments: `members=1000 queries=2000 csv=FILE`, a line an arrangement:
//! `scene,NAME,SCENE us,ALONE us,HINTED us,WORST us,WRONG,NOT PROVEN`. The surfaces are the cases real_s_* (or those of
//! tests/data), scaled to a diagonal of 1, turned at random and placed on a grid: apart, like the faces of a part, and with
//! boxes that overlap many times. Each query is one of the cases' own, moved with a member. The same queries are then asked
//! of the nearest member alone; the first 200 are checked against every member alone. Times are microseconds on one thread, each query alone, the least of three repeats.

#[path = "../tests/cases/mod.rs"]
#[allow(dead_code, reason = "surfaces and queries only, without their proven distances")]
mod cases;

use std::sync::Arc;
use std::time::Instant;

use cases::Shape as CaseShape;
use footpoint::closest::{QueryOptions, Workspace, flag};
use footpoint::index::IndexedSurface;
use footpoint::scene::{Hint, Member, Placement, Scene, SceneFoot, SceneWorkspace, Shape};
use footpoint::surface::Surface;

type Vector = [f64; 3];

/// A case's surface with diagonal 1 and its queries.
struct Model {
    surface: Arc<IndexedSurface>,
    queries: Vec<Vector>,
}

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    let number = |name: &str, default: usize| {
        let found = arguments.iter().find_map(|a| a.strip_prefix(name)?.strip_prefix('='));
        found.map_or(default, |n| n.parse().expect("a number"))
    };
    let (members, queries) = (number("members", 1000), number("queries", 2000));
    let models = models();
    let only = arguments.iter().find_map(|a| a.strip_prefix("only=")).unwrap_or("").to_string();
    let mut csv = String::new();
    println!("{members} members from {} surfaces, {queries} queries", models.len());
    for (name, spacing) in [("apart", 1.3), ("part", 0.7), ("overlapping", 0.4), ("heap", 0.25)] {
        if name.contains(&only) {
            csv += &measure(name, &models, members, spacing, queries);
        }
    }
    if let Some(file) = arguments.iter().find_map(|a| a.strip_prefix("csv=")) {
        std::fs::write(file, csv).expect("a file for the figures");
    }
}

fn models() -> Vec<Model> {
    let is_wanted = |name: &str| name.starts_with("real_s") || name.starts_with("syn_s");
    let mut folders = cases::folders();
    if folders.iter().any(|folder| folder.to_string_lossy().contains("real_s")) {
        folders.retain(|folder| folder.to_string_lossy().contains("real_s"));
    }
    let read =
        folders.iter().map(|folder| cases::read(folder)).filter(|case| is_wanted(&case.name));
    read.filter_map(|case| {
        let CaseShape::Surface(surface) = &case.shape else { return None };
        let scale = 1.0 / case.diagonal;
        let queries = case.rows.iter().map(|row| row.query.map(|x| x * scale)).collect();
        Some(Model { surface: Arc::new(scaled(surface.surface(), scale)), queries })
    })
    .collect()
}

fn scaled(surface: &Surface, scale: f64) -> IndexedSurface {
    let poles: Vec<Vector> = surface.poles().iter().map(|p| p.map(|x| x * scale)).collect();
    let (u, v) = (surface.knots_u(), surface.knots_v());
    let (p, q, m, n) = (u.degree(), v.degree(), u.pole_count(), v.pole_count());
    let weights = surface.weights();
    IndexedSurface::new(
        Surface::new(u.values(), v.values(), p, q, &poles, m, n, weights).expect("a surface"),
    )
}

/// Numbers in [0, 1) of a fixed sequence.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / 9_007_199_254_740_992.0
    }
}

/// A random turn of the shape's middle into the middle of grid place `k`.
fn placement(model: &Model, k: usize, side: usize, spacing: f64, random: &mut Random) -> Placement {
    let (mut q, mut size) = ([0.0; 4], 2.0);
    while !(0.01..1.0).contains(&size) {
        q = [0; 4].map(|_| 2.0 * random.next() - 1.0);
        size = q.iter().map(|x| x * x).sum::<f64>();
    }
    let [a, b, c, d] = q.map(|x| x / size.sqrt());
    let rows = [
        [a * a + b * b - c * c - d * d, 2.0 * (b * c - a * d), 2.0 * (b * d + a * c)],
        [2.0 * (b * c + a * d), a * a - b * b + c * c - d * d, 2.0 * (c * d - a * b)],
        [2.0 * (b * d - a * c), 2.0 * (c * d + a * b), a * a - b * b - c * c + d * d],
    ];
    let (low, high) = model.surface.surface().bounding_box();
    let middle = [0, 1, 2].map(|i| 0.5 * (low[i] + high[i]));
    let cell = [k % side, k / side % side, k / side / side].map(|i| i as f64 * spacing);
    Placement::new([0, 1, 2].map(|i| {
        let [x, y, z] = rows[i];
        [x, y, z, cell[i] - (x * middle[0] + y * middle[1] + z * middle[2])]
    }))
    .expect("a placement")
}

fn median(times: &mut [f64]) -> f64 {
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}

fn least<T>(mut work: impl FnMut() -> T) -> (f64, T) {
    let mut best = f64::INFINITY;
    let mut answer = None;
    for _ in 0..3 {
        let start = Instant::now();
        answer = Some(work());
        best = best.min(start.elapsed().as_secs_f64() * 1e6);
    }
    (best, answer.expect("an answer"))
}

/// Whether a member alone has a nearer foot than the scene, or one below the scene's bound.
fn is_wrong(
    scene: &Scene,
    query: Vector,
    found: &SceneFoot,
    options: &QueryOptions,
    workspace: &mut Workspace,
) -> bool {
    scene.members().iter().any(|Member { shape, placement }| {
        let Shape::Surface(surface) = shape else { return true };
        let own = surface.closest(placement.enter(query), None, options, workspace, None).distance;
        found.foot.distance > own + 1.001 * options.accuracy + 1e-13
            || found.foot.lower_bound > own + 1e-13
    })
}

/// Prints an arrangement's figures and returns its line for the file.
fn measure(name: &str, models: &[Model], count: usize, spacing: f64, queries: usize) -> String {
    let random = &mut Random(7);
    let side = (count as f64).cbrt().ceil() as usize;
    let members: Vec<Member> = (0..count)
        .map(|k| {
            let model = &models[k % models.len()];
            let placement = placement(model, k, side, spacing, random);
            Member { shape: Shape::Surface(model.surface.clone()), placement }
        })
        .collect();
    let start = Instant::now();
    let scene = Scene::new(members).expect("a scene");
    let made = start.elapsed().as_secs_f64() * 1e3;
    scene.prepare(0, &mut || false).expect("indexes");
    let prepared = start.elapsed().as_secs_f64() * 1e3;
    let options = QueryOptions::default();
    let accuracy = 1e-10 * scene.bounding_box().diagonal();
    let single = QueryOptions { accuracy, ..options };
    let (mut workspace, mut own_workspace) = (SceneWorkspace::default(), Workspace::default());
    let (mut together, mut alone, mut hinted) = (Vec::new(), Vec::new(), Vec::new());
    let (mut unproven, mut ties, mut wrong) = (0, 0, 0);
    for i in 0..queries {
        let k = (random.next() * count as f64) as usize;
        let from = &models[k % models.len()].queries;
        let query = from[(random.next() * from.len() as f64) as usize];
        let query = scene.members()[k].placement.place(query);
        let (time, found) = least(|| scene.closest(query, None, &options, &mut workspace));
        together.push(time);
        if i < 200 {
            wrong += usize::from(is_wrong(&scene, query, &found, &single, &mut own_workspace));
        }
        unproven += usize::from(found.foot.flags & flag::NOT_PROVEN != 0);
        ties += usize::from(found.foot.flags & flag::TIE != 0);
        let member = &scene.members()[found.member as usize];
        let Shape::Surface(surface) = &member.shape else { continue };
        let entered = member.placement.enter(query);
        alone.push(least(|| surface.closest(entered, None, &single, &mut own_workspace, None)).0);
        let hint = Hint { member: found.member, at: Some([found.foot.u, found.foot.v]) };
        hinted.push(least(|| scene.closest(query, Some(hint), &options, &mut workspace)).0);
    }
    let worst = together.iter().fold(0.0, |m: f64, x| m.max(*x));
    let (scene, own, hinted) = (median(&mut together), median(&mut alone), median(&mut hinted));
    println!(
        "{name:<12} scene {scene:6.2} us, nearest member alone {own:6.2} us, ratio {:5.2}; with a hint {hinted:5.2} us; \
         worst {worst:.0} us; {wrong} wrong, {unproven} not proven, {ties} ties; made in {made:.1} ms, prepared in {prepared:.0} ms",
        scene / own
    );
    format!("scene,{name},{scene},{own},{hinted},{worst},{wrong},{unproven}\n")
}
