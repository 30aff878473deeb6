//! Random polygons against the weights module: how many wishes that exist are met, how many impossible ones are told, how long
//! it takes. `cargo bench --bench weights -- count=10000 seed=1`; the exit code says whether anything was wrong.

#[path = "../tests/polygons/mod.rs"]
mod polygons;

use std::time::Instant;

fn argument(name: &str, default: u64) -> u64 {
    let given = std::env::args().find_map(|a| a.strip_prefix(&format!("{name}="))?.parse().ok());
    given.unwrap_or(default)
}

fn main() {
    let (count, seed) = (argument("count", 10_000), argument("seed", 1));
    let start = Instant::now();
    let tally = polygons::refine_many(seed, count);
    println!("feasible wishes, {count} polygons, seed {seed}: {tally:?}");
    println!("{:.1} s", start.elapsed().as_secs_f64());
}
