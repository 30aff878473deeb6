//! The short form of `make stress`, and tests of the tester: own pieces, recursion and verdict.
//!
//! A longer one: `FOOTPOINT_STRESS=200000 cargo test --release --test stress -- --nocapture`.

#[path = "../benches/stress/mod.rs"]
mod stress;

use footpoint::closest::{FootPoint, QueryOptions, Workspace, flag};
use stress::asks::Asker;
use stress::design::Design;
use stress::exact::Exact;
use stress::families::FAMILIES;
use stress::judge::{Fault, Judge};
use stress::outcome::Outcome;
use stress::pieces::Pieces;
use stress::run::Plan;
use stress::search::{Scratch, Search, square};
use stress::shapes::Random;
use stress::shapes::asked::Shape;
use stress::shapes::sub;

fn queries() -> u64 {
    std::env::var("FOOTPOINT_STRESS").ok().and_then(|n| n.parse().ok()).unwrap_or(27_000)
}

fn plan(queries: u64, sets_every: u64) -> Plan {
    Plan {
        seed: 20,
        queries,
        threads: std::thread::available_parallelism().map_or(2, usize::from),
        family: String::new(),
        examine_every: 7,
        case: None,
        queries_a_case: 25,
        sets_every,
    }
}

/// The lines about grave faults, with what was found.
fn grave(outcome: &Outcome) -> String {
    let faults = ["Wrong", "Unsound", "Mismatch", "Lost"];
    let lines: Vec<&str> = outcome.report.lines().collect();
    let is_grave = |line: &&str| faults.iter().any(|fault| line.contains(fault));
    let first = (0..lines.len()).filter(|k| is_grave(&lines[*k])).take(10);
    first.map(|k| lines[k..(k + 3).min(lines.len())].join("\n") + "\n").collect()
}

#[test]
fn nothing_is_wrong_or_unsound() {
    let outcome = plan(queries(), u64::MAX).run();
    println!("{}", outcome.table());
    assert!(outcome.is_clean(), "{}\n{}", outcome.table(), grave(&outcome));
    assert!(outcome.total().queries >= queries());
}

#[test]
fn preimages_and_extrema_hold_what_is_known_of_them() {
    let outcome = plan(1_400, 10).run();
    println!("{}", outcome.table());
    assert!(outcome.is_clean(), "{}\n{}", outcome.table(), grave(&outcome));
}

#[test]
fn a_case_depends_on_its_seed_and_number_only() {
    let plan = Plan {
        seed: 5,
        queries: 800,
        threads: 1,
        family: "c ".into(),
        examine_every: 10,
        case: None,
        queries_a_case: 10,
        sets_every: u64::MAX,
    };
    let (alone, together) = (plan.run(), Plan { threads: 3, ..plan }.run());
    for (a, b) in alone.tallies.iter().zip(&together.tallies) {
        assert_eq!(
            (a.queries, a.faults, a.open, a.missed),
            (b.queries, b.faults, b.open, b.missed)
        );
    }
}

fn made(family: usize, seed: u64) -> (Design, Shape) {
    let r = &mut Random(seed);
    loop {
        let design = (FAMILIES[family].make)(r);
        if let Some(shape) = design.shape() {
            return (design, shape);
        }
    }
}

#[test]
fn own_pieces_and_recursion_give_the_points_of_the_shape() {
    for (k, family) in FAMILIES.iter().enumerate() {
        let (design, shape) = made(k, 7 + k as u64);
        let (pieces, area, (diagonal, largest)) =
            (Pieces::new(&design), design.domain(), design.extent());
        let exact = Exact { design: &design, pieces: &pieces, area };
        let limit = 1e-12 * diagonal + 4e-15 * largest;
        for at in shape.samples_of(3) {
            let point = shape.evaluate(at);
            let [own, recursion] = [pieces.point(&pieces.place(at), point), exact.point(at, point)]
                .map(|d| square(d).sqrt());
            assert!(recursion <= limit, "{}: {at:?} {recursion:e}", family.name);
            // Own local parameters are rounded: where the shape is steep there, they are worth less.
            let steep =
                shape.grain(&FootPoint { u: at[0], v: at[1], point, ..FootPoint::unreached() });
            assert!(own <= limit + 4.0 * steep, "{}: {at:?} {own:e} {steep:e}", family.name);
        }
    }
}

/// A sheet, queries, and their judged answers after `change`.
fn judged(change: impl Fn(&Shape, &mut FootPoint)) -> Vec<Vec<Fault>> {
    let sheet = FAMILIES.iter().position(|family| family.name == "s smooth").expect("a family");
    let (design, shape) = made(sheet, 3);
    let (pieces, area, extent) = (Pieces::new(&design), design.domain(), design.extent());
    let search = Search::new(&pieces, area, extent.0);
    let exact = Exact { design: &design, pieces: &pieces, area };
    let asker =
        Asker { design: &design, pieces: &pieces, search: &search, area, diagonal: extent.0 };
    let options = QueryOptions::default();
    let judge = Judge { shape: &shape, pieces: &pieces, search: &search, exact, options, extent };
    let (r, scratch, workspace) =
        (&mut Random(9), &mut Scratch::default(), &mut Workspace::default());
    let mut verdict = || {
        let ask = asker.ask(r, scratch);
        let mut foot = shape.ask_with(ask.query, None, &options, workspace);
        change(&shape, &mut foot);
        foot.distance = square(sub(ask.query, foot.point)).sqrt();
        foot.lower_bound = foot.lower_bound.min(foot.distance);
        judge.verdict(&ask, foot, false, scratch).faults
    };
    (0..200).map(|_| verdict()).collect()
}

#[test]
fn the_judge_convicts_what_is_wrong_and_nothing_else() {
    assert!(judged(|_, _| ()).iter().all(Vec::is_empty));
    let elsewhere = |shape: &Shape, foot: &mut FootPoint| {
        let [u0, u1, ..] = shape.domain();
        foot.u = if foot.u < 0.5 * (u0 + u1) { foot.u + 1e-3 } else { foot.u - 1e-3 };
        foot.point = shape.evaluate([foot.u, foot.v]);
        foot.lower_bound = f64::INFINITY;
    };
    let count =
        |all: &[Vec<Fault>], fault| all.iter().filter(|faults| faults.contains(&fault)).count();
    let far_off = judged(elsewhere);
    assert!(
        count(&far_off, Fault::Wrong) > 150 && count(&far_off, Fault::Unsound) > 150,
        "{far_off:?}"
    );
    let marked = judged(|shape, foot| {
        elsewhere(shape, foot);
        foot.flags |= flag::NOT_PROVEN;
    });
    assert!(count(&marked, Fault::Wrong) == 0 && count(&marked, Fault::MarkedWorse) > 150);
    let loose = judged(|_, foot| foot.lower_bound = -1e-3);
    assert_eq!(count(&loose, Fault::Mismatch), 200);
    let outside = judged(|shape, foot| foot.u = shape.domain()[1].next_up());
    assert_eq!(count(&outside, Fault::Mismatch), 200);
    let moved = judged(|_, foot| foot.point[2] = foot.point[2].next_up());
    assert_eq!(count(&moved, Fault::Mismatch), 200);
}
