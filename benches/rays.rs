//! Rays per second on the surfaces of the case folders, beside the share that is proven: `cargo bench --bench rays`.
//!
//! Rays go from a sphere around the box of the poles to points of the surface, moved by up to a twentieth of the
//! diagonal: many hit, some touch, some miss. One thread; time on the processor.

#[path = "../tests/cases/mod.rs"]
#[allow(dead_code)]
mod cases;

use footpoint::intersect::{CastMemory, Caster, Ray, ray_flag};
use std::sync::Arc;
use std::time::Instant;

const RAYS: usize = 10_000;

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
    let mut rates = Vec::new();
    for folder in cases::folders() {
        let case = cases::read(&folder);
        let cases::Shape::Surface(shape) = case.shape else { continue };
        if !wanted.is_empty() && !wanted.iter().any(|w| case.name.contains(w)) {
            continue;
        }
        let index = shape.index(&mut || false).expect("an index");
        let (diagonal, patches) = (index.frame.diagonal, index.patches.len());
        let shape = Arc::new(shape);
        let begin = Instant::now();
        let caster = Caster::new(shape, &mut || false).expect("a caster");
        let build = begin.elapsed().as_secs_f64() * 1e3;
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
        let mut best = f64::INFINITY;
        let (mut hits, mut open) = (0, 0);
        for _ in 0..3 {
            (hits, open) = (0, 0);
            let begin = seconds();
            for ray in &rays {
                let flags = caster.cast(ray, &mut memory);
                open += usize::from(flags & ray_flag::NOT_PROVEN != 0);
                hits += memory.hits.len();
            }
            best = best.min(seconds() - begin);
        }
        let rate = RAYS as f64 / best;
        if case.name.starts_with("real") {
            rates.push(rate);
        }
        let (cells, per) = (caster.cell_count(), hits as f64 / RAYS as f64);
        println!(
            "{},{patches},{cells},{build:.2},{per:.3},{open},{},{rate:.0}",
            case.name,
            memory.by_line()
        );
    }
    rates.sort_by(f64::total_cmp);
    if !rates.is_empty() {
        println!("median of the real ones: {:.0} rays/s on one thread", rates[rates.len() / 2]);
    }
}
