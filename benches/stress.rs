//! Ten million difficult queries, each checked: `make stress`, or with settings
//! `cargo bench --bench stress -- seed=7 queries=100000 threads=2 family=weights out=found.txt`.
//!
//! `case=N` runs one case of the same seed and family again. The exit code is 1 when an answer was wrong and not
//! marked, a bound unsound, or a record at odds with the shape.

#[path = "stress/mod.rs"]
mod stress;

use std::process::ExitCode;
use std::time::Instant;

use stress::run::Plan;

fn setting<T: std::str::FromStr>(name: &str, default: T) -> T {
    let prefix = format!("{name}=");
    let given = std::env::args().find_map(|a| a.strip_prefix(&prefix).map(str::to_owned));
    given.map_or(default, |text| text.parse().unwrap_or_else(|_| panic!("{prefix}{text}")))
}

fn main() -> ExitCode {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let queries = setting("queries", 10_000_000);
    let case = setting("case", u64::MAX);
    let plan = Plan {
        seed: setting("seed", 1),
        queries,
        threads: setting("threads", cores),
        family: setting("family", String::new()),
        examine_every: (queries / 100_000).max(1),
        case: (case != u64::MAX).then_some(case),
        queries_a_case: 200,
        sets_every: setting("sets", 1000),
    };
    println!("{plan:?}");
    let start = Instant::now();
    let outcome = plan.run();
    print!("{}", outcome.table());
    println!("{:.0} s", start.elapsed().as_secs_f64());
    let out = setting("out", "stress.txt".to_string());
    match std::fs::write(&out, &outcome.report) {
        Ok(()) => println!("disagreements and answers that are not proven: {out}"),
        Err(error) => println!("{out}: {error}\n{}", outcome.report),
    }
    if outcome.is_clean() { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}
