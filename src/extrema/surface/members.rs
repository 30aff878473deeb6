//! From candidates to members: the same place seen twice is one, continua are joined, and each is told what it is.

use super::{Candidate, Search, Sheet, Signs, Source};
use crate::bounds::{norm, sub};
use crate::closest::{FootPoint, flag};
use crate::extrema::nature::from_samples;
use crate::extrema::{BESIDE, NEAR, Taken};
use crate::extrema::{flat_limit, kind};
use crate::refine::{Method, foot_on_surface};
use crate::set::{Kind, Member, Nature, is_wide, joined, touch};

/// Cosine between distance and tangent above which a place is not stationary.
const SLOPE: f64 = 1e-7;

/// How far around a flat member the distance is compared with its own, as a share of the range.
const AROUND: f64 = 0.02;
/// Flat boxes whose distances differ by more than this many accuracies are a chain, not a continuum.
const CHAIN: f64 = 8.0;
/// Samples on each side of the rectangle around it, and of its own.
const SIDE_SAMPLES: usize = 4;

impl Search<'_> {
    /// The members that the candidates make, in no order.
    pub(super) fn members(&self) -> Vec<Member> {
        let areas = |flat: bool| {
            let wanted = self.candidates.iter().filter(move |c| (c.source == Source::Flat) == flat);
            wanted.copied()
        };
        let mut members: Vec<Member> = Vec::new();
        let mut taken: Vec<Taken> = Vec::new();
        for area in joined(areas(true).map(|c| c.area).collect()) {
            let (at, is_chain) = self.flat_place(area);
            let member = self.flat_member(area, at, is_chain);
            let candidate = Candidate { at, area, source: Source::Flat, own: None };
            if !self.goes_on_across(&taken, &area) {
                taken.push(Taken::new(&member, candidate));
                members.push(member);
            }
        }
        let mut points: Vec<(bool, Candidate)> =
            areas(false).map(|c| (self.keeps_a_slope(&c), c)).collect();
        points.sort_by_key(|&(keeps_a_slope, c)| (keeps_a_slope, c.source));
        for (keeps_a_slope, candidate) in points {
            let mut foot = self.foot(candidate.at);
            let is_vague = keeps_a_slope || self.is_vague(&candidate);
            let is_twin = is_vague && taken.iter().any(|known| self.is_level(known, &foot));
            if is_twin || self.is_taken(&taken, &candidate, &foot) {
                continue;
            }
            if keeps_a_slope {
                foot.flags |= flag::NOT_PROVEN;
            }
            if let Some(mut member) = self.point_member(&candidate, foot) {
                if keeps_a_slope {
                    // The zero is somewhere in its box.
                    let [u0, u1, v0, v1] = candidate.area;
                    (member.u, member.v) =
                        ([u0.min(foot.u), u1.max(foot.u)], [v0.min(foot.v), v1.max(foot.v)]);
                }
                taken.push(Taken::new(&member, candidate));
                members.push(member);
            }
        }
        members
    }

    /// Whether the distance is not stationary at a zero that was moved onto the end of its piece, or lies where a collapsed edge
    /// is not quite one point.
    fn keeps_a_slope(&self, candidate: &Candidate) -> bool {
        if !matches!(candidate.source, Source::OnEnd | Source::Inside) {
            return false;
        }
        let around = self.index.around(candidate.at, self.range);
        !around.iter().any(|&(piece, local)| {
            let sharp = self.slopes_beside(piece, candidate.at, local);
            if candidate.source == Source::Inside && sharp.iter().all(|along| along.is_none()) {
                return true;
            }
            let Some(sheet) = self.sheet(piece) else { return false };
            let jet = sheet.jet(local);
            let limit = SLOPE * norm(jet.d) + 32.0 * sheet.position;
            (0..2).all(|k| match sharp[k] {
                Some(along) => along.slope.abs() <= limit + along.noise,
                None => jet.gradient()[k].abs() <= limit * norm(if k == 0 { jet.s } else { jet.t }),
            })
        })
    }

    /// Whether a candidate on a knot line may be a zero beside it: neither side tells whether the distance rises or falls.
    fn is_vague(&self, candidate: &Candidate) -> bool {
        matches!(candidate.source, Source::Border | Source::OnEnd)
            && self.signs(candidate.at).is_unclear()
    }

    /// Whether a foot is a known one within rounding: as near to the query, and beside it in space.
    fn is_level(&self, known: &Taken, foot: &FootPoint) -> bool {
        let near = NEAR * self.index.frame.diagonal + self.accuracy;
        (foot.distance - known.distance).abs() <= 2.0 * self.accuracy
            && norm(sub(foot.point, known.point)) <= near
    }

    fn is_taken(&self, taken: &[Taken], candidate: &Candidate, foot: &FootPoint) -> bool {
        let sizes = (self.index.frame.diagonal, self.accuracy);
        let holds = |area: &[f64; 4], at: [f64; 2]| self.holds(area, at);
        let r = self.range;
        let beside = |at: [f64; 2]| {
            let [du, dv] = [BESIDE * (r[1] - r[0]), BESIDE * (r[3] - r[2])];
            self.holds(&[at[0] - du, at[0] + du, at[1] - dv, at[1] + dv], candidate.at)
        };
        taken.iter().any(|known| known.is_same(candidate, foot, sizes, holds, beside))
    }

    /// Whether an area goes on in a known flat one on the other side of a seam; then it is part of that, unless it goes all
    /// the way round.
    fn goes_on_across(&self, taken: &[Taken], area: &[f64; 4]) -> bool {
        let (r, domain) = (self.range, self.shape.surface().domain());
        (0..2).any(|k| {
            let ends = [r[2 * k], r[2 * k + 1]];
            let is_seam = self.index.closed[k] && ends == [domain[2 * k], domain[2 * k + 1]];
            is_seam
                && area[2 * k] > ends[0]
                && area[2 * k + 1] == ends[1]
                && taken.iter().any(|known| {
                    let mut moved = known.candidate.area;
                    moved[2 * k] += ends[1] - ends[0];
                    moved[2 * k + 1] += ends[1] - ends[0];
                    touch(&moved, area)
                })
        })
    }

    /// Whether a place lies in an area, across the seam too.
    fn holds(&self, area: &[f64; 4], at: [f64; 2]) -> bool {
        let domain = self.shape.surface().domain();
        let r = self.range;
        (0..2).all(|k| {
            let (low, high) = (area[2 * k], area[2 * k + 1]);
            let whole = r[2 * k..2 * k + 2] == domain[2 * k..2 * k + 2];
            let period = if self.index.closed[k] && whole { r[2 * k + 1] - r[2 * k] } else { 0.0 };
            [-period, 0.0, period].iter().any(|turn| (low..=high).contains(&(at[k] + turn)))
        })
    }

    fn point_member(&self, candidate: &Candidate, foot: FootPoint) -> Option<Member> {
        if candidate.source == Source::Collapsed {
            let [u0, u1, v0, v1] = candidate.area;
            let kind = kind([u0 < u1, v0 < v1]);
            let nature = self.collapsed_nature(candidate);
            return Some(Member { foot, u: [u0, u1], v: [v0, v1], kind, nature });
        }
        let signs: Signs = candidate.own.unwrap_or_else(|| self.signs(candidate.at));
        if signs.passes() {
            // A zero beyond the end of its piece, moved onto it: the neighbour has it, or nobody.
            return None;
        }
        let mut nature = signs.nature();
        if nature == Nature::Flat && !signs.is_singular() {
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
    fn flat_member(&self, area: [f64; 4], found: [f64; 2], is_chain: bool) -> Member {
        let of_u = self.index.patches.iter().step_by(self.index.columns).map(|p| p.u.ends);
        let of_v = self.index.patches[..self.index.columns].iter().map(|p| p.v.ends);
        let [u0, u1, v0, v1] = self.range;
        let flat = [
            !is_chain && is_wide([area[0], area[1]], [u0, u1], of_u),
            !is_chain && is_wide([area[2], area[3]], [v0, v1], of_v),
        ];
        // Along a continuum every place is as good: its start is the canonical one.
        let start = [0, 1].map(|k| if flat[k] { area[2 * k] } else { found[k] });
        let is_near = (self.distance(start) - self.distance(found)).abs() <= self.accuracy;
        let at = if is_near { start } else { found };
        let mut foot = self.foot(at);
        let is_collapsed = foot.flags & flag::COLLAPSED != 0;
        // A collapsed edge is an arc of parameters and one point; a region is a continuum even if it begins there.
        if flat == [true; 2] || (flat != [false; 2] && !is_collapsed) {
            foot.flags |= flag::CONTINUUM | flag::TIE;
        }
        let interval = |k: usize, x: f64| [area[2 * k].min(x), area[2 * k + 1].max(x)];
        let (u, v) = (interval(0, foot.u), interval(1, foot.v));
        let is_cut = self.undecided.iter().any(|open| touch(open, &area));
        if is_chain || is_cut || !self.stays_level(foot.distance, u, v) {
            foot.flags |= flag::NOT_PROVEN;
        }
        // Where a parameter does not move the point, the signs are rounding.
        let across = match flat {
            [true, false] if !is_collapsed => self.signs_across(at, 1).nature_across(),
            [false, true] if !is_collapsed => self.signs_across(at, 0).nature_across(),
            _ => None,
        };
        // Part of what goes on in an undecided box: what is around it is not known.
        let around = || if is_cut { Nature::Flat } else { self.sampled_nature(at, area) };
        let nature = across.unwrap_or_else(around);
        Member { foot, u, v, kind: kind(flat), nature }
    }

    /// Whether the distance stays within the accuracy on intervals. Those around a continuum that runs obliquely hold places
    /// beside it, where it may not.
    fn stays_level(&self, here: f64, u: [f64; 2], v: [f64; 2]) -> bool {
        let place = |[low, high]: [f64; 2], j: usize| {
            if j == SIDE_SAMPLES {
                high
            } else {
                low + j as f64 / SIDE_SAMPLES as f64 * (high - low)
            }
        };
        let steps = |[low, high]: [f64; 2]| if low < high { SIDE_SAMPLES } else { 0 };
        (0..=steps(u)).all(|i| {
            (0..=steps(v)).all(|j| {
                let there = self.distance([place(u, i), place(v, j)]);
                (there - here).abs() <= 2.0 * self.accuracy
            })
        })
    }

    /// The best place in a flat area: nearest of the flat boxes' middles, then Newton where the second derivatives allow it.
    /// Boxes that are flat one by one may form a chain that is not; then the nearest place, and true.
    fn flat_place(&self, area: [f64; 4]) -> ([f64; 2], bool) {
        let inside = |c: &&Candidate| c.source == Source::Flat && touch(&c.area, &area);
        let (mut least, mut most, mut middle) = (f64::INFINITY, 0.0_f64, [area[0], area[2]]);
        for candidate in self.candidates.iter().filter(inside) {
            let distance = self.distance(candidate.at);
            most = most.max(distance);
            if distance < least {
                (least, middle) = (distance, candidate.at);
            }
        }
        let is_chain = most - least > CHAIN * self.accuracy;
        let mut at = middle;
        let pieces = self.index.around(middle, self.range);
        if let Some((sheet, mut local)) =
            pieces.first().and_then(|&(k, x)| Some((self.sheet(k)?, x)))
        {
            if is_chain {
                local = self.nearest_in(&sheet, local, area);
            }
            for _ in 0..if is_chain { 0 } else { 4 } {
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
            let mut end = at;
            end[k / 2] = edge;
            let is_near = (self.distance(end) - self.distance(at)).abs() <= self.accuracy;
            if self.index.collapsed[k] && area[k] == edge && is_near {
                at = end;
            }
        }
        (at, is_chain)
    }

    /// The nearest place of a patch inside an area by local iteration.
    fn nearest_in(&self, sheet: &Sheet, start: [f64; 2], area: [f64; 4]) -> [f64; 2] {
        let patch = &self.index.patches[sheet.piece];
        let range = [
            patch.u.local(area[0]).max(sheet.range[0]),
            patch.u.local(area[1]).min(sheet.range[1]),
            patch.v.local(area[2]).max(sheet.range[2]),
            patch.v.local(area[3]).min(sheet.range[3]),
        ];
        foot_on_surface(&(sheet.net, sheet.query), start, range, Method::Auto, None).0
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
            if low < -error && high > error {
                continue;
            }
            let other = 2 * (1 - k / 2);
            let mut area = [self.range[0], self.range[1], self.range[2], self.range[3]];
            (area[2 * (k / 2)], area[2 * (k / 2) + 1]) = (domain[k], domain[k]);
            let mut at = [area[0], area[2]];
            at[k / 2] = domain[k];
            at[other / 2] = self.range[other];
            let is_flat = low >= -error && high <= error;
            let source = if is_flat { Source::Flat } else { Source::Collapsed };
            self.candidates.push(Candidate { at, area, source, own: None });
        }
    }

    /// What a collapsed point is: told by the lines that leave it, and by samples where some of them leave level.
    fn collapsed_nature(&self, candidate: &Candidate) -> Nature {
        let domain = self.shape.surface().domain();
        let is_edge = |k: &usize| {
            candidate.area[2 * (k / 2)] == domain[*k]
                && candidate.area[2 * (k / 2) + 1] == domain[*k]
        };
        let slopes = (0..4).filter(is_edge).find_map(|k| self.leaving[k]);
        match slopes {
            Some((low, _, error)) if low > error => Nature::Minimum,
            Some((_, high, error)) if high < -error => Nature::Maximum,
            _ => self.sampled_nature(candidate.at, candidate.area),
        }
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
