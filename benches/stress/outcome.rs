//! What came out of a run: tallies by family and kind of query, tables of them, and lines about single answers.

use std::collections::BTreeMap;

use super::families::FAMILIES;
use super::judge::{Fault, Judged, Tally};

/// Lines written of a family: grave ones, marked ones, ties not seen, answers not proven.
const WRITTEN: [usize; 4] = [40, 20, 20, 20];

/// The requests for sets.
const SETS: [&str; 2] = ["preimage", "extrema"];

/// What came out, by family, and what was written about it.
pub struct Outcome {
    pub tallies: Vec<Tally>,
    /// Preimages and extrema, by family.
    pub sets: [Vec<Tally>; 2],
    /// By the kind of the query.
    pub kinds: BTreeMap<&'static str, Tally>,
    pub report: String,
    written: Vec<[usize; 4]>,
}

/// What is worth telling of a case.
#[derive(Default)]
pub struct Report {
    /// Grave ones, marked ones, ties not seen, answers not proven.
    lines: [Vec<String>; 4],
    pub design: String,
    pub kinds: BTreeMap<&'static str, Tally>,
    sets: [Tally; 2],
}

impl Report {
    pub fn enter(&mut self, judged: &Judged, text: impl Fn() -> String) {
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

    /// A preimage or extrema; what they could not decide is counted, not told.
    pub fn enter_set(&mut self, which: usize, judged: &Judged, text: impl Fn() -> String) {
        self.sets[which].enter(judged);
        if judged.is_grave() {
            self.enter(judged, text);
        }
    }
}

impl Outcome {
    pub fn new(head: &str) -> Self {
        let none = || vec![Tally::default(); FAMILIES.len()];
        Self {
            tallies: none(),
            sets: [none(), none()],
            kinds: BTreeMap::new(),
            report: head.into(),
            written: vec![[0; 4]; FAMILIES.len()],
        }
    }

    pub fn enter(&mut self, family: usize, tally: &Tally, report: &Report) {
        self.tallies[family].add(tally);
        for (all, set) in self.sets.iter_mut().zip(&report.sets) {
            all[family].add(set);
        }
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
        sum(&self.tallies)
    }

    /// Nothing grave, neither in the answers nor in the sets.
    pub fn is_clean(&self) -> bool {
        self.total().is_clean() && self.sets.iter().all(|set| sum(set).is_clean())
    }

    /// A line a family, and one a kind of query; then the sets.
    pub fn table(&self) -> String {
        let mut rows = named(&self.tallies);
        rows.extend(self.kinds.iter().map(|(kind, tally)| (*kind, tally)));
        let mut text = table("family, query", &rows, &self.total());
        for (name, set) in SETS.iter().zip(&self.sets) {
            text += &table(name, &named(set), &sum(set));
        }
        text
    }
}

fn named(tallies: &[Tally]) -> Vec<(&str, &Tally)> {
    FAMILIES.iter().map(|f| f.name).zip(tallies).collect()
}

fn sum(tallies: &[Tally]) -> Tally {
    let mut total = Tally::default();
    tallies.iter().for_each(|tally| total.add(tally));
    total
}

const COLUMNS: [&str; 15] = [
    "queries",
    "wrong",
    "unsound",
    "mismatch",
    "lost",
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

fn table(title: &str, rows: &[(&str, &Tally)], total: &Tally) -> String {
    let mut text = format!("{title:<25}");
    COLUMNS.iter().for_each(|name| text += &format!("{name:>10}"));
    let last = ("all", total);
    for (name, tally) in rows.iter().chain([&last]).filter(|(_, tally)| tally.queries > 0) {
        text += &format!("\n{name:<25}{:>10}", tally.queries);
        let faults = [
            Fault::Wrong,
            Fault::Unsound,
            Fault::Mismatch,
            Fault::Lost,
            Fault::MarkedWorse,
            Fault::Grain,
        ];
        faults.iter().for_each(|fault| text += &format!("{:>10}", tally.of(*fault)));
        let share = 100.0 * tally.open as f64 / tally.queries as f64;
        text += &format!("{:>10}{share:>10.4}{:>10}", tally.open, tally.untied);
        text += &format!("{:>10}{:>10}{:>10.0}", tally.examined, tally.missed, tally.median());
        text += &format!("{:>10.0}{:>10}", tally.worst, tally.evaluations);
    }
    text + "\n\n"
}
