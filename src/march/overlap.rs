//! What bounds the areas in which two surfaces coincide: the parts of the borders of each that lie on the other one.
//!
//! ```text
//!   side of A, over the boxes in which A and B coincide:   off . . on on on on . off      ends found by bisection
//!   sides of A that lie on B, sides of B that lie on A  -> joined end to end -> loops
//! ```
//!
//! Seams and collapsed edges bound nothing. On: gap, slope and relative curvatures are rounding, as in `search`; not proven.

use super::contact::look;
use super::join::{Place, Stop, distance_to_chord};
use super::search::{Open, Search};
use super::watch::Watch;
use crate::bounds::{Vector, add, norm, scaled, sub};

/// Looks along a side within one box.
const SAMPLES: usize = 16;

/// Boxes that are asked about one place of a side.
const MOST_BESIDE: usize = 256;

/// Ranges of the running parameter of a side, each with a place of the other surface.
type Ranges = Vec<([f64; 2], [f64; 2])>;

/// A curve around an area, or a part of it.
pub struct Rim {
    /// Places in order; the first comes last again when it is closed.
    pub places: Vec<Place>,
    /// Closed or open.
    pub stop: Stop,
}

struct Side<'a, 'b, 'w> {
    search: &'a Search<'b>,
    watch: &'a Watch<'w>,
    /// 0: a side of A; 1: of B.
    own: usize,
    /// The parameter that is fixed there, and its value.
    fixed: usize,
    value: f64,
}

impl Side<'_, '_, '_> {
    fn at(&self, t: f64) -> [f64; 2] {
        if self.fixed == 0 { [self.value, t] } else { [t, self.value] }
    }

    /// The place at `t`, when the surfaces coincide there.
    fn on(&self, t: f64, near: [f64; 2]) -> Option<Place> {
        let (own, other) = (self.search.surfaces[self.own], self.search.surfaces[1 - self.own]);
        let (touch, _) = look(own, other, self.at(t), near)?;
        let at = touch.at;
        let (x, y) = (own.evaluate(at[0], at[1]), other.evaluate(at[2], at[3]));
        let lies = touch.gap.abs() <= self.search.touching_gap(2.0)
            && touch.slope <= 1e-6
            && touch.rank() == 0
            && norm(sub(x, y)) <= self.search.touching_gap(8.0);
        let at = if self.own == 0 { at } else { [at[2], at[3], at[0], at[1]] };
        lies.then(|| Place { x: scaled(add(x, y), 0.5), at })
    }

    /// Parts of the side that lie on the other surface.
    fn rims(&self, chord: f64, out: &mut Vec<Vec<Place>>) {
        let ranges = self.ranges();
        let mut samples: Vec<f64> = Vec::new();
        for ([low, high], _) in &ranges {
            samples.extend((0..=SAMPLES).map(|k| low + (high - low) * k as f64 / SAMPLES as f64));
        }
        samples.sort_by(f64::total_cmp);
        samples.dedup();
        let (mut run, mut last): (Vec<Place>, Option<f64>) = (Vec::new(), None);
        let count = samples.len();
        for (k, t) in samples.into_iter().enumerate() {
            if self.watch.stops(count - k) {
                return;
            }
            match self.seen(t, &ranges) {
                Some(place) => {
                    // Where it began, between the last place that is off and this one.
                    if let Some(off) = last.filter(|_| run.is_empty()) {
                        run.extend(self.border(t, off, &ranges));
                    }
                    run.push(place);
                }
                None => {
                    if let Some(on) = last.filter(|_| !run.is_empty()) {
                        run.extend(self.border(on, t, &ranges));
                        out.extend(self.refined(std::mem::take(&mut run), chord, &ranges));
                    }
                }
            }
            last = Some(t);
        }
        out.extend(self.refined(run, chord, &ranges));
    }

    /// Ranges of the running parameter in the boxes along the side, each with a place of the other surface to begin at.
    fn ranges(&self) -> Ranges {
        let (f, r) = (2 * self.own + self.fixed, 2 * self.own + 1 - self.fixed);
        let o = 2 - 2 * self.own;
        let mut ranges: Ranges = Vec::new();
        for pair in self.search.open.iter().filter(|pair| pair.why == Open::Area) {
            if pair.low[f] <= self.value && self.value <= pair.high[f] {
                let near = [0, 1].map(|k| 0.5 * (pair.low[o + k] + pair.high[o + k]));
                ranges.push(([pair.low[r], pair.high[r]], near));
            }
        }
        ranges.sort_by(|a, b| a.0[0].total_cmp(&b.0[0]));
        ranges
    }

    /// The place at `t`, when the surfaces coincide there, seen from one of the boxes that hold it.
    fn seen(&self, t: f64, ranges: &Ranges) -> Option<Place> {
        let end = ranges.partition_point(|range| range.0[0] <= t);
        ranges[..end]
            .iter()
            .rev()
            .take(MOST_BESIDE)
            .filter(|range| t <= range.0[1])
            .find_map(|range| self.on(t, range.1))
    }

    /// The last place that is on, between one that is and one that is not.
    fn border(&self, mut on: f64, mut off: f64, ranges: &Ranges) -> Option<Place> {
        let mut best = None;
        for _ in 0..52 {
            let t = 0.5 * (on + off);
            match self.seen(t, ranges) {
                Some(place) => (on, best) = (t, Some(place)),
                None => off = t,
            }
        }
        best
    }

    /// With places between, until the chords hold.
    fn refined(&self, run: Vec<Place>, chord: f64, ranges: &Ranges) -> Option<Vec<Place>> {
        let r = 2 * self.own + 1 - self.fixed;
        let mut out = vec![*run.first()?];
        let mut waiting: Vec<Place> = run[1..].iter().rev().copied().collect();
        while let Some(to) = waiting.pop() {
            if self.watch.stops(waiting.len()) {
                return None;
            }
            let from = out[out.len() - 1];
            if let Some([before, behind]) = self.seam(from, to, ranges) {
                waiting.extend([to, behind, before]);
                continue;
            }
            let middle = self.seen(0.5 * (from.at[r] + to.at[r]), ranges);
            match middle {
                Some(m)
                    if distance_to_chord(m.x, from.x, to.x) > 0.5 * chord && out.len() < 10_000 =>
                {
                    waiting.extend([to, m]);
                }
                _ => out.push(to),
            }
        }
        (out.len() > 1).then_some(out)
    }

    /// The parameter of the other surface that goes over a seam between two places, which are not the two of that seam.
    fn jump(&self, from: &Place, to: &Place) -> Option<usize> {
        let (other, o) = (self.search.surfaces[1 - self.own], 2 - 2 * self.own);
        let (domain, closed) = (other.domain(), [other.is_closed_u(), other.is_closed_v()]);
        (0..2).filter(|_| norm(sub(from.x, to.x)) > self.search.touching_gap(64.0)).find(|&k| {
            let width = domain[2 * k + 1] - domain[2 * k];
            closed[k] && (from.at[o + k] - to.at[o + k]).abs() > 0.5 * width
        })
    }

    /// The place on a seam of the other surface between two places, seen from either side.
    fn seam(&self, mut from: Place, mut to: Place, ranges: &Ranges) -> Option<[Place; 2]> {
        let k = self.jump(&from, &to)?;
        let (r, o) = (2 * self.own + 1 - self.fixed, 2 - 2 * self.own);
        let domain = self.search.surfaces[1 - self.own].domain();
        let [low, high] = [domain[2 * k], domain[2 * k + 1]];
        let rises = from.at[o + k] > to.at[o + k];
        for _ in 0..60 {
            let t = 0.5 * (from.at[r] + to.at[r]);
            let Some(middle) = self.seen(t, ranges).filter(|_| t != from.at[r] && t != to.at[r])
            else {
                break;
            };
            let is_before = (middle.at[o + k] > 0.5 * (low + high)) == rises;
            *(if is_before { &mut from } else { &mut to }) = middle;
        }
        if norm(sub(from.x, to.x)) > self.search.touching_gap(64.0) {
            return None;
        }
        let mut both = [from, from];
        let ends = if rises { [high, low] } else { [low, high] };
        (both[0].at[o + k], both[1].at[o + k]) = (ends[0], ends[1]);
        Some(both)
    }
}

/// Curves around all areas in which the surfaces of a search coincide.
pub fn rims(search: &Search, chord: f64, watch: &Watch) -> Vec<Rim> {
    if !search.open.iter().any(|pair| pair.why == Open::Area) {
        return Vec::new();
    }
    let mut lines: Vec<Vec<Place>> = Vec::new();
    for own in 0..2 {
        let surface = search.surfaces[own];
        let (domain, collapsed) = (surface.domain(), surface.collapsed_edges());
        let closed = [surface.is_closed_u(), surface.is_closed_v()];
        for side in (0..4).filter(|&side| !closed[side / 2] && !collapsed[side]) {
            let one = Side { search, watch, own, fixed: side / 2, value: domain[side] };
            let mut found = Vec::new();
            one.rims(chord, &mut found);
            // Where borders of both run together the line is there already.
            let near = search.touching_gap(64.0);
            found.retain(|line| {
                let middle = line[line.len() / 2].x;
                !lines.iter().any(|l| {
                    l.windows(2).any(|w| distance_to_chord(middle, w[0].x, w[1].x) <= chord)
                        && meets(l, line, near + chord)
                })
            });
            lines.extend(found);
        }
    }
    joined(lines, search)
}

/// Whether both ends of a line are near another one.
fn meets(line: &[Place], other: &[Place], near: f64) -> bool {
    let close = |x: Vector| line.windows(2).any(|w| distance_to_chord(x, w[0].x, w[1].x) <= near);
    close(other[0].x) && close(other[other.len() - 1].x)
}

fn joined(mut lines: Vec<Vec<Place>>, search: &Search) -> Vec<Rim> {
    // Ends were found by what is rounding: they are as far apart as that lets them be.
    let near = 1e-6 + search.touching_gap(64.0);
    let mut rims = Vec::new();
    while let Some(mut line) = lines.pop() {
        loop {
            let (first, end) = (line[0].x, line[line.len() - 1].x);
            if line.len() > 2 && norm(sub(first, end)) <= near {
                let again = line[0];
                line.push(again);
                rims.push(Rim { places: line, stop: Stop::Closed });
                break;
            }
            let far = |l: &Vec<Place>| norm(sub(l[0].x, end)).min(norm(sub(l[l.len() - 1].x, end)));
            let best = (0..lines.len()).min_by(|&i, &j| far(&lines[i]).total_cmp(&far(&lines[j])));
            match best.filter(|&k| far(&lines[k]) <= near) {
                Some(k) => {
                    let mut next = lines.swap_remove(k);
                    if norm(sub(next[0].x, end)) > norm(sub(next[next.len() - 1].x, end)) {
                        next.reverse();
                    }
                    line.extend(next);
                }
                None => {
                    rims.push(Rim { places: line, stop: Stop::Open });
                    break;
                }
            }
        }
    }
    rims
}
