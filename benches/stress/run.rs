//! Cases over threads: a case is a shape with its queries, made from the seed and its number alone.

use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};

use footpoint::closest::{QueryOptions, Workspace};

use super::asks::Asker;
use super::design::Design;
use super::exact::Exact;
use super::families::FAMILIES;
use super::judge::{Judge, Tally};
use super::outcome::{Outcome, Report};
use super::pieces::Pieces;
use super::search::{Scratch, Search};
use super::sets;
use super::shapes::Random;

/// What to run.
#[derive(Clone, Debug)]
pub struct Plan {
    pub seed: u64,
    pub queries: u64,
    pub threads: usize,
    /// Part of the names of the families to run; empty: all.
    pub family: String,
    /// One in so many answers is examined in doubled precision, besides every suspect.
    pub examine_every: u64,
    /// One case only.
    pub case: Option<u64>,
    /// So many share a shape, its index and its samples.
    pub queries_a_case: u64,
    /// Preimage and extrema are asked for with one in so many queries.
    pub sets_every: u64,
}

impl Plan {
    fn families(&self) -> Vec<usize> {
        let is_wanted = |k: &usize| FAMILIES[*k].name.contains(&self.family);
        (0..FAMILIES.len()).filter(is_wanted).collect()
    }

    pub fn run(&self) -> Outcome {
        let families = self.families();
        let cases = match self.case {
            Some(case) => case..case + 1,
            None => 0..self.queries.div_ceil(self.queries_a_case),
        };
        let next = AtomicU64::new(cases.start);
        let outcome = Mutex::new(Outcome::new(&format!(
            "{self:?}
"
        )));
        let work = || {
            let (mut workspace, mut scratch) = (Workspace::default(), Scratch::default());
            loop {
                let case = next.fetch_add(1, Ordering::Relaxed);
                if case >= cases.end || families.is_empty() {
                    return;
                }
                let family = families[(case % families.len() as u64) as usize];
                let worst = outcome.lock().map_or(0.0, |all| all.tallies[family].worst);
                let (tally, report) =
                    self.run_case(family, case, worst, (&mut workspace, &mut scratch));
                if let Ok(mut all) = outcome.lock() {
                    all.enter(family, &tally, &report);
                }
            }
        };
        std::thread::scope(|scope| {
            for _ in 0..self.threads.max(1) {
                scope.spawn(work);
            }
        });
        outcome.into_inner().expect("a thread panicked")
    }

    /// All queries of a case. The random numbers depend on the seed, the family and the number of the case.
    fn run_case(
        &self,
        family: usize,
        case: u64,
        worst: f64,
        memory: (&mut Workspace, &mut Scratch),
    ) -> (Tally, Report) {
        let mut r = Random(Random(self.seed ^ case.wrapping_mul(0x9e37_79b9_7f4a_7c15)).bits());
        let (mut tally, mut report) = (Tally::beyond(worst), Report::default());
        let (design, shape) = loop {
            let design = (FAMILIES[family].make)(&mut r);
            if let Some(shape) = design.shape() {
                break (design, shape);
            }
        };
        let mut options = QueryOptions::default();
        let mut area = design.domain();
        if FAMILIES[family].restricted {
            area = restriction(&design, &mut r);
            options.domain = Some(area);
        }
        let (pieces, extent) = (Pieces::new(&design), design.extent());
        let search = Search::new(&pieces, area, extent.0);
        let exact = Exact { design: &design, pieces: &pieces, area };
        let asker =
            Asker { design: &design, pieces: &pieces, search: &search, area, diagonal: extent.0 };
        let judge =
            Judge { shape: &shape, pieces: &pieces, search: &search, exact, options, extent };
        // The first answer builds the index and counts for no time.
        shape.ask_with(design.poles[0], None, &options, memory.0);
        for number in 0..self.queries_a_case {
            let ask = asker.ask(&mut r, memory.1);
            let count = case * self.queries_a_case + number;
            let examine = count.is_multiple_of(self.examine_every);
            let judged = judge.judge(&ask, examine, tally.worst, (&mut *memory.0, &mut *memory.1));
            tally.enter(&judged);
            report.kinds.entry(ask.kind).or_default().enter(&judged);
            let text = || format!("case={case} query={number} {ask:?} area {area:?}");
            report.enter(&judged, text);
            if (count + 1).is_multiple_of(self.sets_every) {
                let preimage = sets::preimage(&judge, &ask, memory.1);
                report.enter_set(0, &preimage, || format!("preimage {}", text()));
                let extrema = sets::extrema(&judge, &ask, judged.foot.distance, memory.1);
                report.enter_set(1, &extrema, || format!("extrema {}", text()));
            }
        }
        report.design = format!("case {case}, {}: {}", FAMILIES[family].name, design.text());
        (tally, report)
    }
}

/// A box of the parameters: often on knots, beside them, or thin.
fn restriction(design: &Design, r: &mut Random) -> [f64; 4] {
    let domain = design.domain();
    let mut area = domain;
    for k in 0..if design.is_curve() { 1 } else { 2 } {
        let [low, high] = [domain[2 * k], domain[2 * k + 1]];
        let knots: Vec<f64> =
            design.knots[k].iter().copied().filter(|u| (low..=high).contains(u)).collect();
        let mut pick = || {
            let knot = knots[r.whole(0, knots.len() - 1)];
            match r.whole(0, 4) {
                0 | 1 => knot,
                2 => knot + (high - low) * r.between(-1.0, 1.0) * r.scale(-12.0, -3.0),
                _ => r.between(low, high),
            }
            .clamp(low, high)
        };
        let (a, b) = (pick(), pick());
        if (a - b).abs() > 1e-9 * (high - low) {
            area[2 * k..2 * k + 2].copy_from_slice(&[a.min(b), a.max(b)]);
        }
    }
    area
}
