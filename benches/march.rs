//! Surface-surface intersection: time and pairs of parts of the small-loop test and of closed forms as NURBS, in one thread.
//!
//! `cargo bench --bench march [-- name]`: lines of name, branches, points, pairs judged, mean time on the processor in ms (Linux).

#[path = "../tests/march_shapes/mod.rs"]
mod march_shapes;

use footpoint::index::IndexedSurface;
use footpoint::march::{MarchOptions, intersect};
use footpoint::surface::Surface;
use march_shapes::{Motion, bumps, cone, cylinder, lid, moved, plane, sphere, torus, wave, z_to_x};
use std::time::Instant;

/// Seconds that this thread was on a processor: other work on the machine does not count.
fn on_processor() -> f64 {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap_or_default();
    let first = text.split(' ').next().and_then(|x| x.parse::<f64>().ok());
    first.map_or_else(|| 0.0, |nanoseconds| 1e-9 * nanoseconds)
}

fn main() {
    // Few runs, to count instructions.
    let once = std::env::args().any(|a| a == "--once");
    let only = std::env::args().skip(1).find(|a| !a.starts_with('-')).unwrap_or_default();
    let mut cases: Vec<(String, Surface, Surface)> = Vec::new();
    for n in [1usize, 16, 100] {
        for gap in [1e-2, 1e-4, 1e-6, 1e-8] {
            cases.push((
                format!("loops {n} {gap:.0e}"),
                bumps(n, |p| p),
                lid(n, 4.0 / 9.0 - gap, |p| p),
            ));
        }
    }
    let level = |z: f64| plane([-3.1, -3.0, z], [6.0, 0.0, 0.0], [0.0, 6.2, 0.0]);
    let turned = |s: &Surface| moved(s, &Motion::new([0.3, -0.5, 0.7, 0.2], 1.0, [0.3, -0.2, 0.5]));
    let mut add = |name: &str, a: Surface, b: Surface| cases.push((name.into(), a, b));
    add("sphere, plane", sphere(1.0), level(0.3));
    add("sphere, sphere", sphere(1.0), turned(&sphere(1.0)));
    add("cylinder, cylinder", cylinder(1.0, 2.0), moved(&cylinder(0.6, 2.0), &z_to_x([0.0; 3])));
    add("cylinder, turned plane", cylinder(1.0, 2.0), turned(&level(0.2)));
    add("torus, plane", torus(2.0, 0.5), level(0.1));
    add("torus, turned torus", torus(2.0, 0.5), turned(&torus(2.0, 0.5)));
    add("torus, sphere", torus(2.0, 0.5), turned(&sphere(1.5)));
    add("cone, sphere", cone(-2.0, 0.2, 2.0, 1.0), sphere(1.2));
    add("wave, wave", wave(12, 0.0), wave(12, 1.0));
    add("wave, sphere", wave(12, 0.0), sphere(2.0));
    for (name, a, b) in &cases {
        if !name.contains(&only) {
            continue;
        }
        let (a, b) = (IndexedSurface::new(a.clone()), IndexedSurface::new(b.clone()));
        let (mut told, mut runs) = ((0, 0, 0, false), 0);
        let (begin, start) = (Instant::now(), on_processor());
        while runs < 3 || (!once && begin.elapsed().as_secs_f64() < 0.5) {
            let found = intersect(&a, &b, &MarchOptions::default(), &mut |_, _| false).unwrap();
            runs += 1;
            let points = found.branches.iter().map(|b| b.points.len()).sum::<usize>();
            told = (found.branches.len(), points, found.judged, found.is_proven);
        }
        let each = (on_processor() - start) / f64::from(runs);
        let (branches, points, judged, proven) = told;
        println!(
            "{name:24} {branches:4} branches {points:6} points {judged:7} pairs {:10.3} ms{}",
            1e3 * each,
            if proven { "" } else { "  not proven" }
        );
    }
}
