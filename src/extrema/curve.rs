//! Stationary points on a curve.

use super::gradient::View;
use super::nature::{Signs, end_of, from_samples};
use super::{
    BESIDE, Candidate, ExtremaOptions, LONGEST_POLISH, POLISH_STEPS, Source, Taken, flat_limit,
    is_reachable, kind,
};
use crate::bezier::Bidegree;
use crate::bounds::{Vector, norm, sub};
use crate::closest::{FootPoint, flag, rounding_floor};
use crate::error::Error;
use crate::index::{CurveIndex, IndexedCurve, position_error, position_steps};
use crate::jet::{BezierSegment, Jet1};
use crate::refine::{Method, foot_on_curve};
use crate::roots::{Found, Zero, zeros_of};
use crate::set::{FootSet, Kind, Member, Nature, is_wide, joined};

/// Two stationary points nearer than this share of a segment are one.
const SAME: f64 = 1e-9;

/// A zero this close to the end of a segment lies on it.
const ON_END: f64 = 1e-13;

/// Flat intervals whose distances differ by more than this many accuracies are a chain, not a continuum.
const CHAIN: f64 = 8.0;
const CHAIN_SAMPLES: usize = 8;

/// How far around a flat member the distance is compared with its own, as a share of the range.
const AROUND: f64 = 0.02;

impl IndexedCurve {
    /// All stationary points of the distance from `query`, nearest first; see the module's head.
    ///
    /// `poll` is asked now and then whether to stop. A set that is not complete names the intervals that are undecided.
    /// Cost: a few microseconds a segment.
    ///
    /// # Errors
    /// [`Error::Cancelled`] when `poll` said so, [`Error::OutOfMemory`].
    pub fn extrema(
        &self,
        query: Vector,
        options: &ExtremaOptions,
        poll: &mut dyn FnMut() -> bool,
    ) -> Result<FootSet, Error> {
        let index = self.index(poll)?;
        if poll() {
            return Err(Error::Cancelled);
        }
        let range = self.restricted(options.domain);
        let q = index.frame.enter(query);
        if !is_reachable(q) {
            let undecided = vec![[range[0], range[1], 0.0, 0.0]];
            return Ok(FootSet { members: Vec::new(), undecided });
        }
        let steps = position_steps(index.degree());
        let worst = position_error(steps, index.is_rational(), 2.0, norm(q) + 2.0, norm(q));
        let floor = rounding_floor(&index.frame, query, worst);
        let asked =
            if options.accuracy > 0.0 { options.accuracy } else { 1e-10 * index.frame.diagonal };
        let accuracy = asked.max(floor);
        let mut search = Search {
            shape: self,
            index,
            query,
            q,
            range,
            steps,
            accuracy,
            budget: options.budget(),
            candidates: Vec::new(),
            undecided: Vec::new(),
        };
        for k in 0..index.segments.len() {
            if k % 256 == 255 && poll() {
                return Err(Error::Cancelled);
            }
            search.segment(k);
        }
        let members = search.members();
        Ok(options.finish(members, search.undecided))
    }
}

struct Search<'a> {
    shape: &'a IndexedCurve,
    index: &'a CurveIndex,
    query: Vector,
    /// In the index's coordinates.
    q: Vector,
    range: [f64; 2],
    steps: f64,
    /// In the caller's lengths.
    accuracy: f64,
    budget: u64,
    candidates: Vec<Candidate>,
    undecided: Vec<[f64; 4]>,
}

/// One segment in the search.
struct Line<'a> {
    piece: usize,
    net: BezierSegment<'a>,
    query: Vector,
    range: [f64; 2],
    position: f64,
    reach: f64,
}

impl Line<'_> {
    fn local(&self, x: f64) -> f64 {
        let [low, high] = self.range;
        if x == 1.0 { high } else { low + x * (high - low) }
    }

    fn jet(&self, s: f64) -> Jet1 {
        self.net.jet(s, self.query)
    }

    /// Newton for the derivative from a zero of the polynomial, whose digits the subdivision has worn; `None` when the two
    /// do not agree.
    fn polish(&self, s: f64) -> Option<f64> {
        let mut s = s;
        for _ in 0..POLISH_STEPS {
            let jet = self.jet(s);
            let step = -jet.gradient() / jet.hessian();
            if step.is_nan() || step.abs() > LONGEST_POLISH {
                return None;
            }
            s = (s + step).clamp(self.range[0], self.range[1]);
            if step.abs() < 1e-15 {
                break;
            }
        }
        let low = if s < ON_END { 0.0 } else { s };
        Some(if s > 1.0 - ON_END { 1.0 } else { low })
    }
}

impl<'a> Search<'a> {
    fn line(&self, k: usize) -> Option<Line<'a>> {
        let segment = &self.index.segments[k];
        let range = segment.u.cover(self.range);
        let query = sub(self.q, segment.center);
        let size = norm(query);
        let rational = self.index.is_rational();
        let position = position_error(self.steps, rational, segment.radius, size, norm(self.q));
        let reach = size + segment.radius;
        let net = self.index.net(k);
        (range[0] < range[1]).then_some(Line { piece: k, net, query, range, position, reach })
    }

    fn segment(&mut self, k: usize) {
        let Some(line) = self.line(k) else { return };
        let segment = &self.index.segments[k];
        let degree = Bidegree { s: 0, t: line.net.degree };
        let range = [0.0, 1.0, line.range[0], line.range[1]];
        let sizes = [segment.radius, line.position, 0.0];
        let view = View::new(line.net.poles, degree, line.net.rational, range, line.query, sizes);
        let slope = view.slope(1);
        let whole = [self.global(&line, 0.0), self.global(&line, 1.0), 0.0, 0.0];
        if !slope.error.is_finite() {
            self.undecided.push(whole);
            return;
        }
        let accuracy = self.accuracy * self.index.frame.scale;
        let cube = view.least_weight().powi(3);
        let is_flat = |low: f64, high: f64, size: f64, is_noise: bool| {
            let width = if is_noise { high - low } else { 1.0 };
            let variation = 2.0 * size * width / cube;
            let middle = line.local(0.5 * (low + high));
            variation <= flat_limit(line.reach, accuracy)
                && variation <= flat_limit(norm(line.jet(middle).d), accuracy)
        };
        let mut zeros = Vec::new();
        zeros_of(&slope.coefficients, slope.error, &is_flat, &mut self.budget, &mut zeros);
        for zero in zeros {
            self.take(&line, &zero);
        }
        for (x, end) in [(0.0, 0), (1.0, 1)] {
            let u = self.global(&line, x);
            if segment.border[end] || u == self.range[end] {
                self.push(&line, line.local(x), [x, x], Source::Border);
            }
        }
    }

    fn take(&mut self, line: &Line, zero: &Zero<1>) {
        let ends = [zero.low[0], zero.high[0]];
        let at = line.local(zero.at[0]);
        match (zero.found, line.polish(at)) {
            (Found::Flat, _) => self.push(line, at, ends, Source::Flat),
            (Found::Root, Some(at)) => {
                let source = if end_of(at) == 0.0 { Source::Inside } else { Source::OnEnd };
                self.push(line, at, ends, source);
            }
            _ => {
                let [a, b] = ends.map(|x| self.global(line, x));
                self.undecided.push([a, b, 0.0, 0.0]);
            }
        }
    }

    /// The caller's parameter of `x` in the unit interval of the searched part.
    fn global(&self, line: &Line, x: f64) -> f64 {
        self.parameter(line, line.local(x))
    }

    fn parameter(&self, line: &Line, s: f64) -> f64 {
        self.index.segments[line.piece].u.global(s).clamp(self.range[0], self.range[1])
    }

    fn push(&mut self, line: &Line, s: f64, ends: [f64; 2], source: Source) {
        let u = self.parameter(line, s);
        let span = self.index.segments[line.piece].u.ends;
        let share = if source == Source::Flat { 0.0 } else { SAME };
        let grain = share * (span[1] - span[0]);
        let low = self.global(line, ends[0]).min(u - grain).max(self.range[0]);
        let high = self.global(line, ends[1]).max(u + grain).min(self.range[1]);
        let own = (source == Source::Inside).then(|| {
            let mut own = Signs::default();
            own.segment(&line.jet(s), 0.5, line.position);
            own
        });
        let area = [low, high, 0.0, 0.0];
        self.candidates.push(Candidate { at: [u, 0.0], area, source, own });
    }

    fn is_turning(&self) -> bool {
        let (first, last) = self.shape.curve().domain();
        self.index.closed && self.range == [first, last]
    }

    fn members(&self) -> Vec<Member> {
        let of = |flat: bool| {
            self.candidates.iter().filter(move |c| (c.source == Source::Flat) == flat).copied()
        };
        let (mut members, mut taken) = (Vec::new(), Vec::new());
        for area in joined(of(true).map(|c| c.area).collect()) {
            let (u, is_chain) = self.flat_place(area);
            let at = [u, 0.0];
            let member = self.flat_member(area, u, is_chain);
            let candidate = Candidate { at, area, source: Source::Flat, own: None };
            if !self.goes_on_across(&taken, &area) {
                taken.push(Taken::new(&member, candidate));
                members.push(member);
            }
        }
        let mut points: Vec<Candidate> = of(false).collect();
        points.sort_by_key(|c| c.source);
        for candidate in points {
            let foot = self.foot(candidate.at[0]);
            if self.is_taken(&taken, &candidate, &foot) {
                continue;
            }
            if let Some(member) = self.point_member(&candidate, foot) {
                taken.push(Taken::new(&member, candidate));
                members.push(member);
            }
        }
        members
    }

    fn is_taken(&self, taken: &[Taken], candidate: &Candidate, foot: &FootPoint) -> bool {
        let sizes = (self.index.frame.diagonal, self.accuracy);
        let turn = if self.is_turning() { self.range[1] - self.range[0] } else { 0.0 };
        let holds = |area: &[f64; 4], at: [f64; 2]| {
            [-turn, 0.0, turn].iter().any(|turn| (area[0]..=area[1]).contains(&(at[0] + turn)))
        };
        let step = BESIDE * (self.range[1] - self.range[0]);
        let beside = |at: [f64; 2]| holds(&[at[0] - step, at[0] + step, 0.0, 0.0], candidate.at);
        taken.iter().any(|known| known.is_same(candidate, foot, sizes, holds, beside))
    }

    /// Whether an interval goes on in a known flat one on the other side of the seam; then it is part of that, unless it goes
    /// all the way round.
    fn goes_on_across(&self, taken: &[Taken], area: &[f64; 4]) -> bool {
        let [first, last] = self.range;
        let begins = |known: &Taken| {
            known.candidate.source == Source::Flat && known.candidate.area[0] == first
        };
        self.is_turning() && area[0] > first && area[1] == last && taken.iter().any(begins)
    }

    fn foot(&self, u: f64) -> FootPoint {
        self.shape.foot_at(self.index, self.query, u, self.range)
    }

    fn distance(&self, u: f64) -> f64 {
        norm(sub(self.shape.curve().evaluate(u), self.query))
    }

    /// The signs that the segments around a place tell.
    fn signs(&self, u: f64) -> Signs {
        let mut signs = Signs::default();
        for (piece, s) in self.index.around(u, self.range) {
            let Some(line) = self.line(piece) else { continue };
            let end = if end_of(s) != 0.0 {
                s
            } else if u == self.range[0] {
                0.0
            } else if u == self.range[1] {
                1.0
            } else {
                s
            };
            signs.segment(&line.jet(s), end, line.position);
        }
        signs
    }

    fn point_member(&self, candidate: &Candidate, foot: FootPoint) -> Option<Member> {
        let u = candidate.at[0];
        let signs = candidate.own.unwrap_or_else(|| self.signs(u));
        if candidate.own.is_none() && signs.passes() {
            // A zero beyond the end of its piece, moved onto it: the neighbour has it, or nobody.
            return None;
        }
        let mut nature = signs.nature();
        if nature == Nature::Flat {
            nature = self.sampled_nature(u, candidate.area);
        }
        Some(Member { foot, u: [foot.u; 2], v: [0.0; 2], kind: Kind::Point, nature })
    }

    /// The best place in a flat interval: nearest of the flat pieces' middles. Intervals that are flat one by one may form a
    /// chain that is not; then the nearest place by local iteration, and true.
    fn flat_place(&self, area: [f64; 4]) -> (f64, bool) {
        let inside = |c: &&Candidate| {
            c.source == Source::Flat && c.area[0] <= area[1] && area[0] <= c.area[1]
        };
        let (mut least, mut most, mut u) = (f64::INFINITY, 0.0_f64, area[0]);
        let middles = self.candidates.iter().filter(inside).map(|c| c.at[0]);
        let share = |k: usize| area[0] + (area[1] - area[0]) * k as f64 / CHAIN_SAMPLES as f64;
        for place in middles.chain((0..=CHAIN_SAMPLES).map(share)) {
            let distance = self.distance(place);
            most = most.max(distance);
            if distance < least {
                (least, u) = (distance, place);
            }
        }
        let is_chain = most - least > CHAIN * self.accuracy;
        if let (true, Some(&(k, s))) = (is_chain, self.index.around(u, self.range).first()) {
            let span = self.index.segments[k].u;
            if let Some(line) = self.line(k) {
                let low = span.local(area[0]).max(line.range[0]);
                let high = span.local(area[1]).min(line.range[1]);
                let curve = (line.net, line.query);
                let (s, _, _) = foot_on_curve(&curve, s, [low, high], Method::Auto, None);
                u = self.parameter(&line, s);
            }
        }
        (u, is_chain)
    }

    fn flat_member(&self, area: [f64; 4], middle: f64, is_chain: bool) -> Member {
        let flat = !is_chain
            && is_wide(
                [area[0], area[1]],
                self.range,
                self.index.segments.iter().map(|s| s.u.ends),
            );
        // Along a continuum every place is as good: its start is the canonical one.
        let is_near = self.distance(area[0]) <= self.distance(middle) + self.accuracy;
        let mut foot = self.foot(if flat && is_near { area[0] } else { middle });
        if flat {
            foot.flags |= flag::CONTINUUM | flag::TIE;
        }
        if is_chain {
            foot.flags |= flag::NOT_PROVEN;
        }
        let u = [area[0].min(foot.u), area[1].max(foot.u)];
        let nature = self.sampled_nature(middle, area);
        Member { foot, u, v: [0.0; 2], kind: kind([flat, false]), nature }
    }

    fn sampled_nature(&self, u: f64, area: [f64; 4]) -> Nature {
        let here = self.distance(u);
        let [low, high] = self.range;
        let step = AROUND * (high - low);
        let place = |x: f64| {
            if (low..=high).contains(&x) {
                Some(x)
            } else if self.is_turning() {
                Some(if x < low { x + (high - low) } else { x - (high - low) })
            } else {
                None
            }
        };
        let around = [place(area[0] - step), place(area[1] + step)];
        let outside = |x: &f64| !(area[0]..=area[1]).contains(x);
        let values = around.into_iter().flatten().filter(outside).map(|x| self.distance(x).powi(2));
        from_samples(here * here, values, 4.0 * flat_limit(here, self.accuracy))
    }
}
