//! From candidates to members: the same place seen twice is one, continua are joined, and each is told what it is.

use super::{Candidate, Search, Signs, Source};
use crate::bounds::{norm, sub};
use crate::closest::{FootPoint, flag};
use crate::extrema::nature::from_samples;
use crate::extrema::{flat_limit, kind};
use crate::set::{Kind, Member, Nature, is_wide, joined, touch};

/// How far around a flat member the distance is compared with its own, as a share of the range.
const AROUND: f64 = 0.02;
/// Samples on each side of the rectangle around it.
const SIDE_SAMPLES: usize = 4;

impl Search<'_> {
    /// The members that the candidates make, in no order.
    pub(super) fn members(&self) -> Vec<Member> {
        let areas = |flat: bool| {
            let wanted = self.candidates.iter().filter(move |c| (c.source == Source::Flat) == flat);
            wanted.copied()
        };
        let mut flats: Vec<[f64; 4]> = Vec::new();
        for area in joined(areas(true).map(|c| c.area).collect()) {
            if !flats.iter().any(|known| self.is_same(known, &area)) {
                flats.push(area);
            }
        }
        let mut members: Vec<Member> = flats.iter().map(|area| self.flat_member(*area)).collect();
        let mut points: Vec<Candidate> = areas(false).collect();
        points.sort_by_key(|c| c.source);
        let mut taken = flats;
        for candidate in points {
            if taken.iter().any(|area| self.is_same(area, &candidate.area)) {
                continue;
            }
            if let Some(member) = self.point_member(&candidate) {
                members.push(member);
                taken.push(candidate.area);
            }
        }
        members
    }

    /// Whether two areas touch, across the seam too.
    fn is_same(&self, a: &[f64; 4], b: &[f64; 4]) -> bool {
        let [u0, u1, v0, v1] = self.range;
        let domain = self.shape.surface().domain();
        let period = |k: usize, length: f64| {
            let whole = self.range[2 * k..2 * k + 2] == domain[2 * k..2 * k + 2];
            if self.index.closed[k] && whole { length } else { 0.0 }
        };
        let (du, dv) = (period(0, u1 - u0), period(1, v1 - v0));
        let moved = |i: f64, j: f64| [b[0] + i * du, b[1] + i * du, b[2] + j * dv, b[3] + j * dv];
        let turns = [-1.0, 0.0, 1.0];
        turns.iter().any(|&i| turns.iter().any(|&j| touch(a, &moved(i, j))))
    }

    fn point_member(&self, candidate: &Candidate) -> Option<Member> {
        let foot = self.foot(candidate.at);
        if candidate.source == Source::Collapsed {
            let [u0, u1, v0, v1] = candidate.area;
            let kind = kind([u0 < u1, v0 < v1]);
            let nature = self.collapsed_nature(candidate)?;
            return Some(Member { foot, u: [u0, u1], v: [v0, v1], kind, nature });
        }
        let signs: Signs = self.signs(candidate.at);
        if candidate.source == Source::Border && signs.passes() {
            return None;
        }
        let mut nature = signs.nature();
        if nature == Nature::Flat {
            nature = self.sampled_nature(candidate.at, candidate.area);
        }
        let (u, v) = ([foot.u; 2], [foot.v; 2]);
        Some(Member { foot, u, v, kind: Kind::Point, nature })
    }

    fn foot(&self, at: [f64; 2]) -> FootPoint {
        self.shape.foot_at(self.index, self.query, at, self.range)
    }

    fn distance(&self, at: [f64; 2]) -> f64 {
        norm(sub(self.shape.surface().evaluate(at[0], at[1]), self.query))
    }

    /// A continuum, or a zero of higher order in a small area.
    fn flat_member(&self, area: [f64; 4]) -> Member {
        let of_u = self.index.patches.iter().step_by(self.index.columns).map(|p| p.u.ends);
        let of_v = self.index.patches[..self.index.columns].iter().map(|p| p.v.ends);
        let [u0, u1, v0, v1] = self.range;
        let flat = [
            is_wide([area[0], area[1]], [u0, u1], of_u),
            is_wide([area[2], area[3]], [v0, v1], of_v),
        ];
        // Along a continuum every place is as good: its start is the canonical one.
        let found = self.flat_place(area);
        let at = [0, 1].map(|k| if flat[k] { area[2 * k] } else { found[k] });
        let mut foot = self.foot(at);
        if flat != [false; 2] {
            foot.flags |= flag::CONTINUUM | flag::TIE;
        }
        let interval = |k: usize, x: f64| [area[2 * k].min(x), area[2 * k + 1].max(x)];
        let (u, v) = (interval(0, foot.u), interval(1, foot.v));
        let nature = self.sampled_nature(at, area);
        Member { foot, u, v, kind: kind(flat), nature }
    }

    /// The place in a flat area where the gradient is least: Newton where the second derivatives allow it.
    fn flat_place(&self, area: [f64; 4]) -> [f64; 2] {
        let middle = [0.5 * (area[0] + area[1]), 0.5 * (area[2] + area[3])];
        let mut at = middle;
        let pieces = self.index.around(middle, self.range);
        if let Some((sheet, mut local)) =
            pieces.first().and_then(|&(k, x)| Some((self.sheet(k)?, x)))
        {
            for _ in 0..4 {
                let jet = sheet.jet(local);
                let step = least_norm_step(jet.hessian(), jet.metric(), jet.gradient());
                if step.iter().any(|x| !x.is_finite()) {
                    break;
                }
                local = [0, 1].map(|k| {
                    (local[k] + step[k]).clamp(sheet.range[2 * k], sheet.range[2 * k + 1])
                });
            }
            let found = self.global(&sheet, local);
            at = [0, 1].map(|k| found[k].clamp(area[2 * k], area[2 * k + 1]));
        }
        for k in 0..4 {
            let edge = self.shape.surface().domain()[k];
            if self.index.collapsed[k] && area[k] == edge {
                at[k / 2] = edge;
            }
        }
        at
    }

    /// Compares squared distances on a rectangle around an area with that at a place in it.
    fn sampled_nature(&self, at: [f64; 2], area: [f64; 4]) -> Nature {
        let here = self.distance(at);
        let width = [self.range[1] - self.range[0], self.range[3] - self.range[2]];
        let around = [0, 1, 2, 3].map(|k| {
            let sign = if k % 2 == 0 { -1.0 } else { 1.0 };
            let moved = area[k] + sign * AROUND * width[k / 2];
            self.inside_or_wrapped(moved, k / 2)
        });
        let mut values = Vec::new();
        for k in 0..4 {
            let Some(x) = around[k] else { continue };
            let other = 1 - k / 2;
            for j in 0..=SIDE_SAMPLES {
                let share = j as f64 / SIDE_SAMPLES as f64;
                let mut place = [x; 2];
                let (low, high) = (area[2 * other], area[2 * other + 1]);
                place[other] = low + share * (high - low);
                values.push(self.distance(place).powi(2));
            }
        }
        let tolerance = 4.0 * flat_limit(here, self.accuracy);
        from_samples(here * here, values.into_iter(), tolerance)
    }

    /// A parameter inside the range, on the other side of the seam, or nowhere.
    fn inside_or_wrapped(&self, x: f64, k: usize) -> Option<f64> {
        let [low, high] = [self.range[2 * k], self.range[2 * k + 1]];
        if (low..=high).contains(&x) {
            return Some(x);
        }
        let domain = self.shape.surface().domain();
        let whole = [low, high] == [domain[2 * k], domain[2 * k + 1]];
        if !(self.index.closed[k] && whole) {
            return None;
        }
        let wrapped = if x < low { x + (high - low) } else { x - (high - low) };
        (low..=high).contains(&wrapped).then_some(wrapped)
    }

    /// Collapsed edges: a minimum when the distance grows along every line that leaves, a maximum when it falls, part of a
    /// continuum of no length when it does neither.
    pub(super) fn collapsed_points(&mut self) {
        let domain = self.shape.surface().domain();
        for k in 0..4 {
            let Some((low, high, error)) = self.leaving[k] else { continue };
            let rises = low > -error;
            let falls = high < error;
            if !rises && !falls {
                continue;
            }
            let other = 2 * (1 - k / 2);
            let mut area = [self.range[0], self.range[1], self.range[2], self.range[3]];
            (area[2 * (k / 2)], area[2 * (k / 2) + 1]) = (domain[k], domain[k]);
            let mut at = [area[0], area[2]];
            at[k / 2] = domain[k];
            at[other / 2] = self.range[other];
            let source = if rises && falls { Source::Flat } else { Source::Collapsed };
            self.candidates.push(Candidate { at, area, source });
        }
    }

    /// Whether a member is a collapsed point, and then what it is: told by the lines that leave it.
    pub(super) fn collapsed_nature(&self, candidate: &Candidate) -> Option<Nature> {
        let domain = self.shape.surface().domain();
        let edge = (0..4).find(|&k| {
            self.leaving[k].is_some()
                && candidate.area[2 * (k / 2)] == domain[k]
                && candidate.area[2 * (k / 2) + 1] == domain[k]
        })?;
        let (low, _, error) = self.leaving[edge]?;
        Some(if low > -error { Nature::Minimum } else { Nature::Maximum })
    }
}

/// The shortest step to where the second-order model is stationary; directions in which it does not bend are left.
fn least_norm_step([a, b, c]: [f64; 3], [e, _, g]: [f64; 3], [x, y]: [f64; 2]) -> [f64; 2] {
    // Scaled to unit speeds, so that "does not bend" has a meaning.
    let (p, q) = (e.sqrt().max(1e-300), g.sqrt().max(1e-300));
    let (a, b, c) = (a / (p * p), b / (p * q), c / (q * q));
    let (x, y) = (x / p, y / q);
    let (middle, half) = (0.5 * (a + c), 0.5 * (a - c));
    let spread = (half * half + b * b).sqrt();
    let mut step = [0.0; 2];
    for value in [middle - spread, middle + spread] {
        if value.abs() < 1e-6 {
            continue;
        }
        // An eigenvector of [[a, b], [b, c]].
        let (r, s) =
            if (a - value).abs() > (c - value).abs() { (-b, a - value) } else { (c - value, -b) };
        let size = (r * r + s * s).sqrt();
        if size == 0.0 {
            return [-x / a / p, -y / c / q];
        }
        let along = (r * x + s * y) / (size * size * value);
        step = [step[0] - along * r / p, step[1] - along * s / q];
    }
    step
}
