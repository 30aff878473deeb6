//! Where the domain demands a new pcurve: at seams that are crossed and at collapsed edges.

use super::feet::Sample;
use super::{Puller, SNAP, pulled};
use crate::closest::QueryOptions;
use crate::error::Error;
use crate::index::IndexedCurve;

/// Share of the tolerance within which an edge counts as touching the point of a collapsed edge.
const TOUCH: f64 = 0.1;

/// Share of a turn within which a foot may count as on a seam.
const BESIDE: f64 = 0.01;

/// What is fixed at an end of a stretch.
#[derive(Clone, Copy, Debug, Default)]
pub struct Fixed {
    /// On the seam of u, of v.
    pub seam: [bool; 2],
    /// On this collapsed edge: u0, u1, v0, v1.
    pub collapsed: Option<usize>,
}

/// A part of the edge whose pcurve is one.
#[derive(Clone, Debug)]
pub struct Stretch {
    /// Parameters of the edge.
    pub range: [f64; 2],
    /// Whole turns to take off.
    pub lap: [f64; 2],
    /// The side of the seam that it runs along.
    pub along: [Option<f64>; 2],
    /// Its two ends.
    pub ends: [Fixed; 2],
    /// Samples inside, those of the ends as far as they are not on a collapsed edge.
    pub samples: Vec<Sample>,
}

impl Stretch {
    /// The bits of [`pulled`] that follow from where the stretch lies.
    pub fn flags(&self) -> u32 {
        let of = |is: bool, bit: u32| if is { bit } else { 0 };
        let seam = |k: usize| self.ends[k].seam != [false; 2];
        of(self.along[0].is_some(), pulled::ALONG_SEAM_U)
            | of(self.along[1].is_some(), pulled::ALONG_SEAM_V)
            | of(seam(0), pulled::FROM_SEAM)
            | of(seam(1), pulled::TO_SEAM)
            | of(self.ends[0].collapsed.is_some(), pulled::FROM_COLLAPSED)
            | of(self.ends[1].collapsed.is_some(), pulled::TO_COLLAPSED)
    }
}

/// Where the edge meets the point of a collapsed edge.
struct Meeting {
    t: f64,
    /// What the tolerance leaves open.
    around: [f64; 2],
    edge: usize,
}

/// Where the edge goes over to the next turn.
#[derive(Clone, Copy)]
struct Crossing {
    t: f64,
    seam: [bool; 2],
}

impl Puller<'_> {
    /// The parts of the edge between meetings and crossings.
    pub fn stretches(&mut self, poll: &mut dyn FnMut() -> bool) -> Result<Vec<Stretch>, Error> {
        let (start, end) = self.edge.domain();
        let meetings = self.meetings(poll)?;
        let mut stretches = Vec::new();
        let all = std::mem::take(&mut self.samples);
        let mut bounds: Vec<(f64, Option<usize>)> =
            meetings.iter().map(|m| (m.t, Some(m.edge))).collect();
        if bounds.first().is_none_or(|first| first.0 > start) {
            bounds.insert(0, (start, None));
        }
        if bounds.last().is_none_or(|last| last.0 < end) {
            bounds.push((end, None));
        }
        for pair in bounds.windows(2) {
            let range = [pair[0].0, pair[1].0];
            let met = |t: f64| meetings.iter().any(|m| m.around[0] <= t && t <= m.around[1]);
            let inside = |s: &&Sample| range[0] <= s.t && s.t <= range[1] && !met(s.t);
            self.samples = all.iter().filter(inside).copied().collect();
            if self.samples.is_empty() {
                let middle = range[0] + 0.5 * (range[1] - range[0]);
                let nearest =
                    all.iter().min_by(|a, b| (a.t - middle).abs().total_cmp(&(b.t - middle).abs()));
                let Some(&nearest) = nearest else { continue };
                let sample = self.foot_between(&nearest, &nearest, middle);
                self.samples.push(sample);
            }
            let ends = [pair[0].1, pair[1].1];
            self.cut_at_seams(range, ends, &mut stretches);
        }
        Ok(stretches)
    }

    fn meetings(&self, poll: &mut dyn FnMut() -> bool) -> Result<Vec<Meeting>, Error> {
        let (start, end) = self.edge.domain();
        let mut meetings = Vec::new();
        let tips: Vec<_> = (0..4).filter_map(|edge| Some((edge, self.tip(edge)?))).collect();
        if tips.is_empty() {
            return Ok(meetings);
        }
        let curve = IndexedCurve::new(self.edge.clone());
        for (edge, tip) in tips {
            let options = QueryOptions::default();
            let set = curve.preimage(tip, TOUCH * self.tolerance, &options, poll)?;
            for member in set.members {
                let [low, high] = member.u;
                let t = if low <= start {
                    start
                } else if high >= end {
                    end
                } else {
                    member.foot.u
                };
                meetings.push(Meeting { t, around: [low, high], edge });
            }
        }
        meetings.sort_by(|a, b| a.t.total_cmp(&b.t));
        // Both edges of a surface may collapse to one point; the one that the feet lie on is told by the first sample.
        meetings.dedup_by(|b, a| b.t <= a.t);
        Ok(meetings)
    }

    /// Cuts what is in `self.samples` where it crosses seams.
    fn cut_at_seams(&mut self, range: [f64; 2], tips: [Option<usize>; 2], out: &mut Vec<Stretch>) {
        let mut crossings: Vec<Crossing> = Vec::new();
        for k in (0..2).filter(|&k| self.index.closed[k]) {
            crossings.extend(self.crossings(k));
        }
        crossings.sort_by(|a, b| a.t.total_cmp(&b.t));
        crossings.retain(|c| range[0] < c.t && c.t < range[1]);
        crossings.dedup_by(|b, a| {
            let same = b.seam != a.seam
                && self.apart(b.t, self.edge.evaluate(a.t)) <= SNAP * self.tolerance
                || b.t == a.t;
            if same {
                a.seam = [a.seam[0] || b.seam[0], a.seam[1] || b.seam[1]];
            }
            same
        });
        let tip = |collapsed: Option<usize>| Fixed { collapsed, seam: [false; 2] };
        let mut from = (range[0], tip(tips[0]));
        let mut lap: Option<[f64; 2]> = None;
        let ends = crossings.iter().map(|c| (c.t, Fixed { seam: c.seam, collapsed: None }));
        for to in ends.chain([(range[1], tip(tips[1]))]).collect::<Vec<_>>() {
            let stretch = self.stretch([from.0, to.0], [from.1, to.1], lap);
            lap = Some(stretch.lap);
            out.push(stretch);
            from = to;
        }
    }

    /// The whole turns of a sample; `None` on the seam.
    fn lap(&self, sample: &Sample, k: usize) -> Option<f64> {
        let share = (sample.at[k] - self.ends[k][0]) / self.period(k);
        let beside = (share - share.round()).abs();
        let on = beside == 0.0
            || beside < BESIDE
                && beside * self.period(k) * self.speeds(sample.at)[k] <= SNAP * self.tolerance;
        (!on).then(|| share.floor())
    }

    fn crossings(&mut self, k: usize) -> Vec<Crossing> {
        let samples = self.samples.clone();
        let mut seam = [false; 2];
        seam[k] = true;
        let mut found = Vec::new();
        let mut last: Option<(usize, f64)> = None;
        for (i, sample) in samples.iter().enumerate() {
            let Some(lap) = self.lap(sample, k) else { continue };
            if let Some((j, before)) = last
                && lap != before
            {
                let t = if i > j + 1 {
                    samples[j + 1].t
                } else {
                    let value = self.ends[k][0] + lap.max(before) * self.period(k);
                    self.crossing(samples[j], *sample, k, value)
                };
                found.push(Crossing { t, seam });
            }
            last = Some((i, lap));
        }
        found
    }

    /// Where the parameter k takes a value between two samples.
    fn crossing(&mut self, before: Sample, after: Sample, k: usize, value: f64) -> f64 {
        let (mut low, mut high) = (before, after);
        let rising = after.at[k] > value;
        loop {
            let t = low.t + 0.5 * (high.t - low.t);
            if t <= low.t || t >= high.t {
                return high.t;
            }
            let middle = self.foot_between(&low, &high, t);
            if middle.at[k] == value {
                return t;
            }
            if (middle.at[k] > value) == rising { high = middle } else { low = middle }
        }
    }

    fn stretch(&mut self, range: [f64; 2], ends: [Fixed; 2], before: Option<[f64; 2]>) -> Stretch {
        let inside = |s: &&Sample| range[0] <= s.t && s.t <= range[1];
        let mut samples: Vec<Sample> = self.samples.iter().filter(inside).copied().collect();
        let middle = self.sample_at(range[0] + 0.5 * (range[1] - range[0]));
        if samples.is_empty() {
            samples.push(middle);
        }
        let (mut lap, mut along) = ([0.0; 2], [None; 2]);
        for k in (0..2).filter(|&k| self.index.closed[k]) {
            let within = |s: &&Sample| range[0] < s.t && s.t < range[1];
            let known = samples.iter().filter(within).chain([&middle]).find_map(|s| self.lap(s, k));
            lap[k] = known.unwrap_or_else(|| {
                let seam = ((middle.at[k] - self.ends[k][0]) / self.period(k)).round();
                let kept = before.map(|lap| lap[k]).filter(|&l| l == seam || l == seam - 1.0);
                let lap = kept.unwrap_or(if self.high[k] { seam - 1.0 } else { seam });
                along[k] = Some(if lap == seam { self.ends[k][0] } else { self.ends[k][1] });
                lap
            });
        }
        Stretch { range, lap, along, ends, samples }
    }
}
