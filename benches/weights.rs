//! Random polygons against the weights module: how many wishes that exist are met, whether those that do not are told, how long it
//! takes. `make weights-stress`, or `cargo bench --bench weights -- count=10000 seed=1`; the exit code says whether anything was wrong.

#[path = "../tests/polygons/mod.rs"]
mod polygons;

fn argument(name: &str, default: u64) -> u64 {
    let given = std::env::args().find_map(|a| a.strip_prefix(&format!("{name}="))?.parse().ok());
    given.unwrap_or(default)
}

fn main() {
    let (count, seed) = (argument("count", 10_000), argument("seed", 1));
    let mut feasible = polygons::feasible(seed, count);
    feasible.show("wishes that exist");
    let mut infeasible = polygons::infeasible(seed, count / 10);
    infeasible.show("wishes that do not exist");
    let mut wild = polygons::wild(seed, count / 100);
    wild.show("wishes that may exist");
    for network in 0..count {
        polygons::check_network(seed.wrapping_mul(1 << 32) + network);
    }
    println!("networks: {count} trained, all within their ranges, the same bits twice");
    let enough = 1000 * feasible.met >= 999 * feasible.curves;
    if !enough || feasible.wrong + infeasible.wrong + wild.wrong > 0 || infeasible.met > 0 {
        println!("NOT GOOD");
        std::process::exit(1);
    }
}
