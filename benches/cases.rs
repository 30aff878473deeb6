//! Time and certificates on all cases: one line per case, medians at the end. Arguments: parts of case names.
//!
//! `cargo bench --bench cases -- real_s` ; figures are microseconds on one thread.

#[path = "../tests/cases/mod.rs"]
mod cases;

use std::time::Instant;

use cases::{Case, Shape};
use footpoint::closest::{FootPoint, QueryOptions, Workspace, flag};

struct Figures {
    median: f64,
    worst: f64,
}

fn ask(case: &Case, i: usize, options: &QueryOptions, workspace: &mut Workspace) -> FootPoint {
    match &case.shape {
        Shape::Curve(curve) => curve.closest(case.rows[i].query, None, options, workspace, None),
        Shape::Surface(surface) => {
            surface.closest(case.rows[i].query, None, options, workspace, None)
        }
    }
}

fn main() {
    let wanted: Vec<String> = std::env::args().skip(1).filter(|a| !a.starts_with("--")).collect();
    let (mut curves, mut surfaces) = (Vec::new(), Vec::new());
    for folder in cases::folders() {
        let name = folder.file_name().unwrap().to_string_lossy().into_owned();
        if !wanted.is_empty() && !wanted.iter().any(|w| name.contains(w.as_str())) {
            continue;
        }
        let case = cases::read(&folder);
        let figures = measure(&case);
        if name.starts_with("real_c") {
            curves.push(figures.median);
        } else if name.starts_with("real_s") {
            surfaces.push(figures.median);
        }
    }
    println!("real curves: median of medians {:.2} us", middle(&mut curves));
    println!("real surfaces: median of medians {:.2} us", middle(&mut surfaces));
}

fn middle(values: &mut [f64]) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}

fn measure(case: &Case) -> Figures {
    let options = QueryOptions { accuracy: 1e-9 * case.diagonal, ..QueryOptions::default() };
    let mut workspace = Workspace::default();
    let start = Instant::now();
    match &case.shape {
        Shape::Curve(c) => c.prepare(&mut || false).unwrap(),
        Shape::Surface(s) => s.prepare(&mut || false).unwrap(),
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
    report(case, &feet, &times, set_up)
}

fn report(case: &Case, feet: &[FootPoint], times: &[f64], set_up: f64) -> Figures {
    let (mut wrong, mut unsound) = (0, 0);
    let mut unproven = std::collections::BTreeMap::new();
    for (foot, row) in feet.iter().zip(&case.rows) {
        let largest = row.query.iter().fold(case.magnitude, |m, x| m.max(x.abs()));
        let rounding = 4e-15 * (largest + row.distance);
        wrong += usize::from(!(foot.distance <= row.distance + 1e-9 * case.diagonal + rounding));
        unsound +=
            usize::from(!(foot.lower_bound <= row.distance + 1e-12 * case.diagonal + rounding));
        if foot.flags & flag::NOT_PROVEN != 0 {
            *unproven.entry(row.class.clone()).or_insert(0) += 1;
        }
    }
    let mut sorted = times.to_vec();
    let median = middle(&mut sorted);
    let worst = sorted.last().copied().unwrap_or(0.0);
    let evaluations = feet.iter().map(|f| f64::from(f.iterations)).sum::<f64>() / feet.len() as f64;
    let mean = times.iter().sum::<f64>() / times.len() as f64;
    println!(
        "{:<32} median {median:8.2} mean {mean:8.2} worst {worst:9.1} us, {evaluations:6.1} evaluations, set-up {set_up:8.0} us{}{}{}",
        case.name,
        if wrong > 0 { format!(", WRONG {wrong}") } else { String::new() },
        if unsound > 0 { format!(", UNSOUND {unsound}") } else { String::new() },
        if unproven.is_empty() { String::new() } else { format!(", not proven {unproven:?}") },
    );
    Figures { median, worst }
}
