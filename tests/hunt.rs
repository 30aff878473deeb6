//! A hunt for counterexamples: every family of shapes against an independent search.
//!
//! A long one: `FOOTPOINT_HUNT=400 cargo test --release --test hunt -- --nocapture`.

mod shapes;

use std::time::Instant;

use footpoint::closest::{FootPoint, QueryOptions, Workspace, flag};
use shapes::asked::Shape;
use shapes::search::{Found, dense, search};
use shapes::{FAMILIES, Random, Vector};

/// Families so extreme that an answer which is marked as not proven may be far by more than a billionth: weights of
/// neighbours that differ by 1e12, spans so short that the doubles in them are too coarse for the foot, derivatives
/// that vanish at random.
const EXTREME: [&str; 4] = ["weights 1e-6..1e6", "zero spans", "wild knots", "equal poles"];

/// What was found against the library, and how many answers were not proven.
#[derive(Default)]
struct Bag {
    /// Farther than the search, but marked.
    wrong: Vec<String>,
    /// A bound that is above the search, or an answer that is farther than it though proven.
    unsound: Vec<String>,
    /// Not proven.
    open: Vec<String>,
    queries: usize,
    /// Slowest query in microseconds, least of three tries.
    slowest: f64,
}

fn hunt(family: usize, seed: u64, bag: &mut Bag) {
    let (shape, r) = (Shape::new(family, seed), &mut Random(!seed));
    let (samples, mut workspace) = (dense(&shape), Workspace::default());
    for _ in 0..20 {
        let query = shape.query(r);
        let mut ask = || {
            let start = Instant::now();
            let foot = shape.ask_with(query, None, &QueryOptions::default(), &mut workspace);
            (foot, start.elapsed().as_secs_f64() * 1e6)
        };
        let (foot, mut time) = ask();
        if time > bag.slowest {
            time = time.min(ask().1).min(ask().1);
        }
        bag.slowest = bag.slowest.max(time);
        judge(&shape, query, &foot, search(&shape, &samples, query), bag, (family, seed));
    }
}

fn judge(
    shape: &Shape,
    query: Vector,
    foot: &FootPoint,
    found: Found,
    bag: &mut Bag,
    origin: (usize, u64),
) {
    let slack = shape.rounding(query, foot.distance);
    let text = || {
        let (excess, diagonal) = (foot.distance - found.distance, shape.diagonal());
        format!(
            "{origin:?} {query:?}: {:?} is nearer by {excess:e} of {diagonal:e}, {foot:?}",
            found.at
        )
    };
    let is_open = foot.flags & flag::NOT_PROVEN != 0;
    bag.queries += 1;
    if is_open {
        bag.open.push(text());
    }
    let is_wrong = foot.distance > found.distance + 1e-9 * shape.diagonal() + slack;
    if foot.lower_bound > found.distance + slack || (is_wrong && !is_open) {
        bag.unsound.push(text());
    } else if is_wrong {
        bag.wrong.push(text());
    }
}

fn hunt_all(seeds: std::ops::Range<u64>) -> Vec<Bag> {
    let threads = std::thread::available_parallelism().map_or(2, usize::from);
    let next = std::sync::atomic::AtomicUsize::new(0);
    let work = || {
        let mut bags: Vec<Bag> = FAMILIES.iter().map(|_| Bag::default()).collect();
        loop {
            let job = next.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
            let (family, seed) =
                (job % FAMILIES.len(), seeds.start + (job / FAMILIES.len()) as u64);
            if seed >= seeds.end {
                return bags;
            }
            hunt(family, seed, &mut bags[family]);
        }
    };
    let mut total: Vec<Bag> = FAMILIES.iter().map(|_| Bag::default()).collect();
    std::thread::scope(|scope| {
        let handles: Vec<_> = (0..threads).map(|_| scope.spawn(work)).collect();
        for bags in handles.into_iter().map(|handle| handle.join().expect("a hunter")) {
            for (all, bag) in total.iter_mut().zip(bags) {
                all.wrong.extend(bag.wrong);
                all.unsound.extend(bag.unsound);
                all.open.extend(bag.open);
                all.queries += bag.queries;
                all.slowest = all.slowest.max(bag.slowest);
            }
        }
    });
    total
}

fn nothing_is_found(seeds: std::ops::Range<u64>) {
    let bags = hunt_all(seeds);
    let mut found: Vec<&String> = Vec::new();
    for (family, bag) in FAMILIES.iter().zip(&bags) {
        let (name, open, queries) = (family.name, bag.open.len(), bag.queries);
        let [wrong, unsound] = [&bag.wrong, &bag.unsound].map(Vec::len);
        println!(
            "{name:<24} {queries:6} queries, {open} not proven, {wrong} wrong, {unsound} unsound, slowest {:.0} us",
            bag.slowest
        );
        bag.open.iter().take(6).for_each(|text| println!("  {text}"));
        found.extend(&bag.unsound);
        if !EXTREME.contains(&name) {
            found.extend(&bag.wrong);
        }
    }
    assert!(
        found.is_empty(),
        "{} found, of them\n{:#?}",
        found.len(),
        &found[..found.len().min(20)]
    );
}

/// How many shapes of each family: a few here, `FOOTPOINT_HUNT=400` for a long hunt.
fn shapes_a_family() -> u64 {
    std::env::var("FOOTPOINT_HUNT").ok().and_then(|n| n.parse().ok()).unwrap_or(12)
}

#[test]
fn no_search_finds_a_nearer_place_nor_one_below_the_bound() {
    nothing_is_found(0..shapes_a_family());
}
