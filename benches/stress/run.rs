//! Cases over threads: a case is a shape with its queries, made from the seed and its number alone.

use std::collections::BTreeMap;
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};

use footpoint::closest::{QueryOptions, Workspace};

use super::asks::Asker;
use super::design::Design;
use super::exact::Exact;
use super::families::FAMILIES;
use super::judge::{Fault, Judge, Judged, Tally};
use super::pieces::Pieces;
use super::search::{Scratch, Search};
use super::shapes::Random;

/// Lines written of a family: grave ones, marked ones, ties not seen, answers not proven.
const WRITTEN: [usize; 4] = [40, 20, 20, 20];

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
}

/// What came out, by family, and what was written about it.
pub struct Outcome {
    pub tallies: Vec<Tally>,
    /// By the kind of the query.
    pub kinds: BTreeMap<&'static str, Tally>,
    pub report: String,
    written: Vec<[usize; 4]>,
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
        let outcome = Mutex::new(Outcome {
            tallies: vec![Tally::default(); FAMILIES.len()],
            kinds: BTreeMap::new(),
            written: vec![[0; 4]; FAMILIES.len()],
            report: format!("{self:?}\n"),
        });
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
            let examine = (case * self.queries_a_case + number) % self.examine_every == 0;
            let judged = judge.judge(&ask, examine, tally.worst, (&mut *memory.0, &mut *memory.1));
            tally.enter(&judged);
            report.kinds.entry(ask.kind).or_default().enter(&judged);
            let text = || format!("case={case} query={number} {ask:?} area {area:?}");
            report.enter(&judged, text);
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

/// What is worth telling of a case.
#[derive(Default)]
struct Report {
    /// Grave ones, marked ones, ties not seen, answers not proven.
    lines: [Vec<String>; 4],
    design: String,
    kinds: BTreeMap<&'static str, Tally>,
}

impl Report {
    fn enter(&mut self, judged: &Judged, text: impl Fn() -> String) {
        let Judged { foot, found, faults, .. } = judged;
        let line = || {
            let excess = (foot.distance - found.1, foot.lower_bound - found.1);
            let untied = if judged.is_untied { " untied" } else { "" };
            format!(
                "{faults:?}{untied} {}\n    {foot:?}\n    found {found:?}, excess {excess:?}\n",
                text()
            )
        };
        let ranks = [judged.is_grave(), !faults.is_empty(), judged.is_untied, judged.is_open()];
        if let Some(rank) = ranks.into_iter().position(|is_so| is_so) {
            self.lines[rank].push(line());
        }
    }
}

impl Outcome {
    fn enter(&mut self, family: usize, tally: &Tally, report: &Report) {
        self.tallies[family].add(tally);
        let mut design = Some(&report.design);
        for (rank, lines) in report.lines.iter().enumerate() {
            let most = WRITTEN[rank].saturating_sub(self.written[family][rank]).min(10);
            for line in lines.iter().take(most) {
                // Once a case, before its first line.
                if let Some(design) = design.take() {
                    self.report += design;
                }
                self.report += &format!("{} {line}", FAMILIES[family].name);
                self.written[family][rank] += 1;
            }
        }
        for (kind, tally) in &report.kinds {
            self.kinds.entry(kind).or_default().add(tally);
        }
    }

    pub fn total(&self) -> Tally {
        let mut total = Tally::default();
        self.tallies.iter().for_each(|tally| total.add(tally));
        total
    }

    /// A line a family, the sums below.
    pub fn table(&self) -> String {
        let head = [
            "queries",
            "wrong",
            "unsound",
            "mismatch",
            "worse",
            "grain",
            "open",
            "open %",
            "untied",
            "examined",
            "missed",
            "median ns",
            "worst ns",
            "evals",
        ];
        let mut text = format!("{:<25}", "family, query");
        head.iter().for_each(|name| text += &format!("{name:>10}"));
        let total = self.total();
        let families = FAMILIES.iter().map(|f| f.name).zip(&self.tallies);
        let kinds = self.kinds.iter().map(|(kind, tally)| (*kind, tally));
        for (name, tally) in
            families.chain(kinds).chain([("all", &total)]).filter(|(_, t)| t.queries > 0)
        {
            text += &format!("\n{name:<25}{:>10}", tally.queries);
            for fault in
                [Fault::Wrong, Fault::Unsound, Fault::Mismatch, Fault::MarkedWorse, Fault::Grain]
            {
                text += &format!("{:>10}", tally.of(fault));
            }
            let share = 100.0 * tally.open as f64 / tally.queries as f64;
            text += &format!(
                "{:>10}{share:>10.4}{:>10}{:>10}{:>10}",
                tally.open, tally.untied, tally.examined, tally.missed
            );
            text +=
                &format!("{:>10.0}{:>10.0}{:>10}", tally.median(), tally.worst, tally.evaluations);
        }
        text + "\n"
    }
}
