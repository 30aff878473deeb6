//! Time and certificates on all cases: a line per case, sums at the end. Arguments: parts of case names.
//!
//! `cargo bench --bench cases -- real_s`. Times are microseconds on one thread, each query alone, the least of five
//! repeats (of two when it is fast); accuracy 1e-9 of the diagonal, or the default with `default-accuracy`.

#[path = "../tests/cases/mod.rs"]
mod cases;

use std::collections::BTreeMap;
use std::time::Instant;

use cases::{Case, Shape};
use footpoint::closest::{FootPoint, QueryOptions, Workspace, flag};

/// What one case showed.
#[derive(Default)]
struct Figures {
    median: f64,
    worst: f64,
    wrong: usize,
    unsound: usize,
    unproven: BTreeMap<String, usize>,
    classes: BTreeMap<String, usize>,
}

fn main() {
    let arguments: Vec<String> =
        std::env::args().skip(1).filter(|a| !a.starts_with("--")).collect();
    let by_default = arguments.iter().any(|a| a == "default-accuracy");
    let wanted: Vec<&String> = arguments.iter().filter(|a| *a != "default-accuracy").collect();
    let mut all: BTreeMap<String, Figures> = BTreeMap::new();
    for folder in cases::folders() {
        let name = folder.file_name().unwrap().to_string_lossy().into_owned();
        if wanted.is_empty() || wanted.iter().any(|w| name.contains(w.as_str())) {
            all.insert(name, measure(&cases::read(&folder), by_default));
        }
    }
    sum_up(&all);
}

fn sum_up(all: &BTreeMap<String, Figures>) {
    for kind in ["real_c", "real_s", "syn_c", "syn_s"] {
        let of_kind = || all.iter().filter(|(name, _)| name.starts_with(kind)).map(|(_, f)| f);
        let median = middle(&mut of_kind().map(|f| f.median).collect::<Vec<f64>>());
        let worst = of_kind().map(|f| f.worst).fold(0.0, f64::max);
        println!("{kind}: median of medians {median:.2} us, worst query {worst:.0} us");
    }
    let (mut classes, mut unproven) = (BTreeMap::new(), BTreeMap::new());
    for figures in all.values() {
        for (class, n) in &figures.classes {
            *classes.entry(class).or_insert(0) += n;
        }
        for (class, n) in &figures.unproven {
            *unproven.entry(class).or_insert(0) += n;
        }
    }
    let wrong: usize = all.values().map(|f| f.wrong).sum();
    let unsound: usize = all.values().map(|f| f.unsound).sum();
    println!("queries {classes:?}\nwrong {wrong}, unsound {unsound}, not proven {unproven:?}");
}

fn ask(case: &Case, i: usize, options: &QueryOptions, workspace: &mut Workspace) -> FootPoint {
    let query = case.rows[i].query;
    match &case.shape {
        Shape::Curve(curve) => curve.closest(query, None, options, workspace, None),
        Shape::Surface(surface) => surface.closest(query, None, options, workspace, None),
    }
}

fn middle(values: &mut [f64]) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}

fn measure(case: &Case, by_default: bool) -> Figures {
    let accuracy = if by_default { 0.0 } else { 1e-9 * case.diagonal };
    let options = QueryOptions { accuracy, ..QueryOptions::default() };
    let mut workspace = Workspace::default();
    let start = Instant::now();
    match &case.shape {
        Shape::Curve(curve) => curve.prepare(&mut || false).unwrap(),
        Shape::Surface(surface) => surface.prepare(&mut || false).unwrap(),
    }
    let set_up = start.elapsed().as_secs_f64() * 1e6;
    let mut feet = Vec::new();
    let mut times = Vec::new();
    for i in 0..case.rows.len() {
        let mut least = f64::INFINITY;
        for repeat in 0..5 {
            let start = Instant::now();
            let foot = ask(case, i, &options, &mut workspace);
            let time = start.elapsed().as_secs_f64() * 1e6;
            least = least.min(time);
            if repeat == 0 {
                feet.push(foot);
            }
            if repeat == 1 && time < 100.0 {
                break;
            }
        }
        times.push(least);
    }
    report(case, &feet, &mut times, set_up)
}

fn report(case: &Case, feet: &[FootPoint], times: &mut [f64], set_up: f64) -> Figures {
    let mut figures = Figures::default();
    for (foot, row) in feet.iter().zip(&case.rows) {
        let largest = row.query.iter().fold(case.magnitude, |m, x| m.max(x.abs()));
        let rounding = 4e-15 * (largest + row.distance);
        let most = row.distance + 1e-9 * case.diagonal + rounding;
        let bound = row.distance + 1e-12 * case.diagonal + rounding;
        figures.wrong += usize::from(foot.distance > most || foot.distance.is_nan());
        figures.unsound += usize::from(foot.lower_bound > bound || foot.lower_bound.is_nan());
        *figures.classes.entry(row.class.clone()).or_insert(0) += 1;
        if foot.flags & flag::NOT_PROVEN != 0 {
            *figures.unproven.entry(row.class.clone()).or_insert(0) += 1;
        }
    }
    let mean = times.iter().sum::<f64>() / times.len() as f64;
    let spent: f64 = feet.iter().map(|f| f64::from(f.iterations)).sum();
    figures.median = middle(times);
    figures.worst = times.last().copied().unwrap_or(0.0);
    println!(
        "{:<32} median {:8.2} mean {mean:8.2} worst {:9.1} us, {:6.1} evaluations, set-up {set_up:8.0} us{}",
        case.name,
        figures.median,
        figures.worst,
        spent / feet.len() as f64,
        shortfalls(&figures),
    );
    figures
}

fn shortfalls(figures: &Figures) -> String {
    let mut text = String::new();
    if figures.wrong + figures.unsound > 0 {
        text += &format!(", WRONG {} UNSOUND {}", figures.wrong, figures.unsound);
    }
    if !figures.unproven.is_empty() {
        text += &format!(", not proven {:?}", figures.unproven);
    }
    text
}
