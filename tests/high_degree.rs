//! Degrees 15 to 31, unclamped and periodic knots, against an independent search (`benches/stress`).
//!
//! Times are printed, not asserted: `cargo test --release --test high_degree -- --nocapture`.

#[path = "../benches/stress/mod.rs"]
mod stress;

use std::time::Instant;

use footpoint::closest::{FootPoint, QueryOptions, Workspace, flag};
use footpoint::index::{IndexedCurve, IndexedSurface};
use stress::design::Design;
use stress::pieces::Pieces;
use stress::search::{Scratch, Search};
use stress::shapes::asked::Shape;
use stress::shapes::{self, FAMILIES, Family, Knotting, Random, Vector, norm, sub};

const CLAMPED: Family = FAMILIES[0];

/// Shapes of one kind, and how they did.
struct Report {
    name: String,
    queries: usize,
    open: usize,
    worst: f64,
    total: f64,
}

/// Asks the shape 30 queries, checks them against the search, and adds to the report.
fn examine(shape: &Shape, r: &mut Random, report: &mut Report) {
    let design = match shape {
        Shape::Curve(curve) => Design::of_curve(curve.curve()),
        Shape::Surface(surface) => Design::of_surface(surface.surface()),
    };
    let (pieces, scratch) = (Pieces::new(&design), &mut Scratch::default());
    let search = Search::new(&pieces, design.domain(), design.extent().0);
    let (options, workspace) = (QueryOptions::default(), &mut Workspace::default());
    shape.ask_with(design.poles[0], None, &options, workspace);
    for _ in 0..30 {
        let query = shape.query(r);
        let mut least = f64::INFINITY;
        let mut foot = FootPoint::unreached();
        for _ in 0..3 {
            let start = Instant::now();
            foot = shape.ask_with(query, None, &options, workspace);
            least = least.min(start.elapsed().as_secs_f64() * 1e6);
        }
        report.queries += 1;
        report.open += usize::from(foot.flags & flag::NOT_PROVEN != 0);
        report.worst = report.worst.max(least);
        report.total += least;
        let found = search.nearest(query, &[], scratch);
        let nearest = found.square.sqrt();
        let slack = shape.rounding(query, foot.distance);
        let what =
            || format!("{}: {query:?} {:?} {:e} {foot:?}", report.name, found.place, nearest);
        assert!(foot.distance <= nearest + 1e-9 * shape.diagonal() + slack, "{}", what());
        assert!(foot.lower_bound <= nearest + slack, "{}", what());
        assert!(norm(sub(shape.evaluate([foot.u, foot.v]), foot.point)) == 0.0, "{}", what());
    }
}

fn examine_all(name: &str, seeds: u64, make: impl Fn(&mut Random) -> Shape) -> Report {
    let mut report = Report { name: name.into(), queries: 0, open: 0, worst: 0.0, total: 0.0 };
    for seed in 0..seeds {
        let r = &mut Random(seed);
        examine(&make(r), r, &mut report);
    }
    let mean = report.total / report.queries as f64;
    println!(
        "{name:<34} {:5} queries, {:3} not proven, mean {mean:8.1} us, worst {:8.1} us",
        report.queries, report.open, report.worst
    );
    report
}

fn family(knotting: Knotting, weights: f64) -> Family {
    Family { knotting, weights, ..CLAMPED }
}

fn is_mostly_proven(report: &Report) {
    assert!(report.open <= report.queries.div_ceil(100), "{}: {} open", report.name, report.open);
}

#[test]
fn curves_of_degree_15_to_31_are_answered_as_the_independent_search_does() {
    for degree in [15, 18, 22, 25, 28, 31] {
        for (weights, spans) in [(0.0, 1), (0.0, 5), (0.5, 1), (0.5, 4)] {
            let name = format!("curve {degree}, {spans} spans, weights 10^{weights}");
            is_mostly_proven(&examine_all(&name, 2, |r| {
                let family = family(Knotting::Clamped, weights);
                Shape::Curve(IndexedCurve::new(shapes::curve_of(&family, degree, spans, r)))
            }));
        }
    }
}

#[test]
fn surfaces_of_degree_15_to_31_are_answered_as_the_independent_search_does() {
    let degrees = [[15, 15], [20, 7], [7, 20], [25, 25], [31, 2], [31, 31], [15, 1], [16, 3]];
    for degrees in degrees {
        for weights in [0.0, 0.5] {
            let name = format!("surface {degrees:?}, weights 10^{weights}");
            is_mostly_proven(&examine_all(&name, 2, |r| {
                let family = family(Knotting::Clamped, weights);
                let surface = shapes::surface_of(&family, degrees, [1, 1], r);
                Shape::Surface(IndexedSurface::new(surface))
            }));
        }
    }
}

#[test]
fn unclamped_and_periodic_curves_are_answered_as_the_independent_search_does() {
    for knotting in [Knotting::Unclamped, Knotting::Periodic] {
        for degree in [1, 2, 3, 5, 9, 15, 25] {
            for weights in [0.0, 0.5] {
                let name = format!("curve {degree} {knotting:?}, weights 10^{weights}");
                is_mostly_proven(&examine_all(&name, 2, |r| {
                    let family = family(knotting, weights);
                    Shape::Curve(IndexedCurve::new(shapes::curve_of(&family, degree, 7, r)))
                }));
            }
        }
    }
}

#[test]
fn unclamped_and_periodic_surfaces_are_answered_as_the_independent_search_does() {
    for knotting in [Knotting::Unclamped, Knotting::Periodic] {
        for degrees in [[1, 1], [2, 3], [3, 3], [5, 4], [9, 2], [15, 3]] {
            for weights in [0.0, 0.5] {
                let name = format!("surface {degrees:?} {knotting:?}, weights 10^{weights}");
                is_mostly_proven(&examine_all(&name, 2, |r| {
                    let family = family(knotting, weights);
                    let surface = shapes::surface_of(&family, degrees, [4, 3], r);
                    Shape::Surface(IndexedSurface::new(surface))
                }));
            }
        }
    }
}

/// Bernstein coefficients of the Chebyshev polynomial T_k on [0, 1], raised to `degree`: k waves of height 1 from
/// coefficients of up to 2^k with alternating signs, the worst that a degree can do.
fn wave(k: usize, degree: usize) -> Vec<f64> {
    let choose = |n: usize, j: usize| (0..j).fold(1.0, |c, i| c * (n - i) as f64 / (i + 1) as f64);
    let sign = |j: usize| if j.is_multiple_of(2) { 1.0 } else { -1.0 };
    let mut c: Vec<f64> =
        (0..=k).map(|j| sign(k - j) * choose(2 * k, 2 * j) / choose(k, j)).collect();
    for n in k..degree {
        let share = |j: usize| j as f64 / (n + 1) as f64;
        let at = |j: usize| if j <= n { c[j] } else { 0.0 };
        c = (0..=n + 1)
            .map(|j| if j > 0 { share(j) * at(j - 1) } else { 0.0 } + (1.0 - share(j)) * at(j))
            .collect();
    }
    c
}

fn bezier_knots(degree: usize) -> Vec<f64> {
    let mut knots = vec![0.0; degree + 1];
    knots.resize(2 * degree + 2, 1.0);
    knots
}

#[test]
fn curves_with_as_many_waves_as_their_degree_allows_are_answered_as_the_independent_search_does() {
    for (waves, degree) in [(5, 15), (10, 15), (15, 15), (10, 25), (20, 20), (25, 25), (31, 31)] {
        let name = format!("curve {degree}, {waves} waves");
        is_mostly_proven(&examine_all(&name, 2, |r| {
            let height = r.scale(-2.0, 0.0);
            let poles: Vec<Vector> = (wave(waves, degree).iter().enumerate())
                .map(|(i, y)| [i as f64 / degree as f64, height * y, r.between(0.0, 0.1)])
                .collect();
            let curve = footpoint::curve::Curve::new(&bezier_knots(degree), degree, &poles, None);
            Shape::Curve(IndexedCurve::new(curve.expect("a curve")))
        }));
    }
}

#[test]
fn surfaces_with_many_waves_are_answered_as_the_independent_search_does() {
    for [(k, p), (l, q)] in [
        [(15, 15), (1, 1)],
        [(5, 15), (5, 15)],
        [(8, 8), (8, 8)],
        [(12, 15), (5, 7)],
        [(12, 12), (12, 12)],
        [(10, 25), (10, 25)],
    ] {
        let name = format!("surface [{p}, {q}], {k} x {l} waves");
        is_mostly_proven(&examine_all(&name, 2, |r| {
            let (height, zu, zv) = (r.scale(-2.0, -0.5), wave(k, p), wave(l, q));
            let cells = (0..=p).flat_map(|i| (0..=q).map(move |j| (i, j)));
            let poles: Vec<Vector> = cells
                .map(|(i, j)| [i as f64 / p as f64, j as f64 / q as f64, height * zu[i] * zv[j]])
                .collect();
            let (ku, kv) = (bezier_knots(p), bezier_knots(q));
            let surface =
                footpoint::surface::Surface::new(&ku, &kv, p, q, &poles, p + 1, q + 1, None);
            Shape::Surface(IndexedSurface::new(surface.expect("a surface")))
        }));
    }
}
