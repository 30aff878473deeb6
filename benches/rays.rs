//! Rays per second on the surfaces of the case folders, beside the share that is proven: `cargo bench --bench rays`.
//!
//! Rays go from a sphere around the box of the poles to points of the surface, moved by up to a twentieth of the
//! diagonal: many hit, some touch, some miss. One thread; time on the processor.

#[path = "../tests/cases/mod.rs"]
#[allow(dead_code)]
mod cases;

use footpoint::intersect::{CastMemory, Caster, Ray, ray_flag};
use std::sync::Arc;

const RAYS: usize = 10_000;

/// Least time of a measurement, s: the clock of a thread moves in steps of some milliseconds.
const LEAST: f64 = 0.15;

struct Random(u64);

impl Random {
    fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        low + (high - low) * ((self.0 >> 11) as f64 / 9007199254740992.0)
    }
}

/// Seconds that this thread has been on a processor; on a loaded machine the clock says little.
fn seconds() -> f64 {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap_or_default();
    let first = text.split_whitespace().next().and_then(|word| word.parse::<f64>().ok());
    first.map_or_else(
        || std::time::UNIX_EPOCH.elapsed().map_or(0.0, |d| d.as_secs_f64()),
        |nanoseconds| nanoseconds * 1e-9,
    )
}

fn main() {
    let wanted: Vec<String> = std::env::args().skip(1).filter(|a| !a.starts_with("--")).collect();
    println!("case,patches,cells,build_ms,hits_per_ray,not_proven,by_line,rays_per_s");
    let (mut rates, mut builds) = (Vec::new(), Vec::new());
    for folder in cases::folders() {
        let case = cases::read(&folder);
        let cases::Shape::Surface(shape) = case.shape else { continue };
        if !wanted.is_empty() && !wanted.iter().any(|w| case.name.contains(w)) {
            continue;
        }
        let index = shape.index(&mut || false).expect("an index");
        let (diagonal, patches) = (index.frame.diagonal, index.patches.len());
        let shape = Arc::new(shape);
        let begin = seconds();
        let mut caster = Caster::new(shape.clone(), &mut || false).expect("a caster");
        let mut times = 1;
        while seconds() - begin < LEAST {
            caster = Caster::new(shape.clone(), &mut || false).expect("a caster");
            times += 1;
        }
        let build = (seconds() - begin) / f64::from(times) * 1e3;
        let surface = caster.shape().surface();
        let (low, high) = surface.bounding_box();
        let middle: [f64; 3] = std::array::from_fn(|k| 0.5 * (low[k] + high[k]));
        let [u0, u1, v0, v1] = surface.domain();
        let mut random = Random(42);
        let rays: Vec<Ray> = (0..RAYS)
            .map(|_| {
                let target = surface.evaluate(random.between(u0, u1), random.between(v0, v1));
                let d: [f64; 3] = std::array::from_fn(|_| random.between(-1.0, 1.0));
                let origin: [f64; 3] = std::array::from_fn(|k| middle[k] + diagonal * d[k]);
                let shift: [f64; 3] =
                    std::array::from_fn(|_| 0.05 * diagonal * random.between(-1.0, 1.0));
                let direction = std::array::from_fn(|k| target[k] + shift[k] - origin[k]);
                Ray { origin, direction, reach: [0.0, f64::INFINITY] }
            })
            .collect();
        let mut memory = CastMemory::default();
        let (mut hits, mut open, mut runs) = (0, 0, 0u32);
        let begin = seconds();
        while runs == 0 || seconds() - begin < LEAST {
            (hits, open) = (0, 0);
            for ray in &rays {
                let flags = caster.cast(ray, &mut memory);
                open += usize::from(flags & ray_flag::NOT_PROVEN != 0);
                hits += memory.hits.len();
            }
            runs += 1;
        }
        let time = (seconds() - begin) / f64::from(runs);
        builds.push(build);
        let rate = RAYS as f64 / time;
        if case.name.starts_with("real") {
            rates.push(rate);
        }
        let (cells, per) = (caster.cell_count(), hits as f64 / RAYS as f64);
        println!(
            "{},{patches},{cells},{build:.2},{per:.3},{open},{},{rate:.0}",
            case.name,
            memory.by_line() / u64::from(runs)
        );
    }
    rates.sort_by(f64::total_cmp);
    builds.sort_by(f64::total_cmp);
    if let (Some(slowest), Some(longest)) = (rates.first(), builds.last()) {
        let at = |list: &[f64], share: f64| list[(share * (list.len() - 1) as f64) as usize];
        let [ten, quarter, half] = [0.1, 0.25, 0.5].map(|share| at(&rates, share));
        println!(
            "{} real ones, one thread, rays/s: least {slowest:.0}, a tenth below {ten:.0}, a quarter below {quarter:.0}, median {half:.0}",
            rates.len()
        );
        println!(
            "building, ms, all: median {:.1}, a tenth above {:.1}, most {longest:.0}",
            at(&builds, 0.5),
            at(&builds, 0.9)
        );
    }
}
