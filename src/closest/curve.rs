//! Nearest point of a curve.

mod elementary;
mod lockstep;
mod record;
mod ties;

pub use ties::{neighbour, shortest, wrapped};

use super::certificate::{LEAST_C, squared_error};
use super::line::{Given, Line, LineMemory, Source, search_line};
use super::local::{LOCAL_FLAGS, WholeCurve, curve_start};
use super::lockstep::{Begin, Left};
use super::proof::{Proof, Site, Watch, note_loose};
use super::settle::settled_on_curve;
use super::sought::{Outcome, Sought};
use super::within::{Within, nothing_within};
use super::{
    CONTINUUM_STEPS, FootPoint, QueryOptions, Scope, Workspace, default_budget, far_foot,
    first_limit, flag, is_bad, is_coarse, mark_inversion, rounding_floor, search_floor, tree_limit,
    tree_slack,
};
use crate::bounds::{Vector, dot, norm, sub};
use crate::error::Error;
use crate::index::{
    CurveIndex, CurveReach, IndexedCurve, position_error, position_steps, product_steps,
};
use crate::jet::{Jet1, place};
use crate::refine::{Approach, Landing, Method, Trace, foot_on_curve, land_on_curve};

/// A tangent break smaller than this angle (radians) is rounding of the poles, not a crease.
pub const LEAST_CREASE: f64 = 1e-6;

impl IndexedCurve {
    /// The nearest point of the curve to `query`, with proof.
    ///
    /// `hint` is a parameter near the foot, if the caller knows one; it changes the time, not the distance.
    /// A query that is not finite gives [`FootPoint::bad_query`]. Cost: about a microsecond.
    ///
    /// # Panics
    /// Never on its own; memory that cannot be had for the index gives [`FootPoint::unreached`].
    pub fn closest(
        &self,
        query: Vector,
        hint: Option<f64>,
        options: &QueryOptions,
        workspace: &mut Workspace,
        trace: Option<Trace>,
    ) -> FootPoint {
        if is_bad(query) {
            return FootPoint::bad_query();
        }
        let Ok(index) = self.index(&mut || false) else { return FootPoint::unreached() };
        let hint = hint.filter(|u| u.is_finite());
        match options.scope {
            Scope::Local => self.local(index, query, hint, options, workspace, trace),
            Scope::Global => {
                let begin = Begin::at(hint);
                self.global(index, query, begin, None, options, workspace, trace)
            }
        }
    }

    /// As [`Self::closest`], for a query that should lie on the curve: beyond the tolerance the foot is marked
    /// [`flag::NOT_ON_SHAPE`].
    pub fn invert(
        &self,
        query: Vector,
        hint: Option<f64>,
        options: &QueryOptions,
        workspace: &mut Workspace,
        trace: Option<Trace>,
    ) -> FootPoint {
        let mut foot = self.closest(query, hint, options, workspace, trace);
        if let (Ok(index), true) = (self.index(&mut || false), foot.distance.is_finite()) {
            mark_inversion(&mut foot, options.tolerance(&index.frame));
        }
        foot
    }

    /// Whether a restriction lies in the domain: `[u0, u1, _, _]` with u0 < u1.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] naming the entry.
    pub fn check_domain(&self, domain: [f64; 4]) -> Result<(), Error> {
        super::check_range("domain", 0, [domain[0], domain[1]], self.curve().domain())
    }

    fn range(&self, options: &QueryOptions) -> [f64; 2] {
        self.restricted(options.domain)
    }

    /// The part of the domain that a restriction leaves.
    pub(crate) fn restricted(&self, domain: Option<[f64; 4]>) -> [f64; 2] {
        let (first, last) = self.curve().domain();
        domain.map_or([first, last], |d| [d[0].max(first), d[1].min(last)])
    }

    /// The gap that rounding leaves to a search.
    pub(super) fn floor(index: &CurveIndex, query: Vector) -> f64 {
        search_floor(&index.frame, query, position_steps(index.degree()), index.is_rational())
    }

    /// The shape as an iteration across pieces sees it.
    fn whole(&self, index: &CurveIndex, query: Vector, floor: f64) -> WholeCurve<'_> {
        let coarse = is_coarse(&index.frame, query, floor);
        WholeCurve { curve: self.curve(), query, scale: index.frame.scale, coarse }
    }

    fn local(
        &self,
        index: &CurveIndex,
        query: Vector,
        hint: Option<f64>,
        options: &QueryOptions,
        workspace: &mut Workspace,
        trace: Option<Trace>,
    ) -> FootPoint {
        let start = hint
            .unwrap_or_else(|| curve_start(index, index.frame.enter(query), &mut workspace.start));
        let curve = self.whole(index, query, Self::floor(index, query));
        let (u, _, taken) =
            foot_on_curve(&curve, start, self.range(options), options.method, trace);
        let mut foot = self.foot_at(index, query, u, self.range(options));
        foot.flags |= LOCAL_FLAGS | if hint.is_some() { flag::HINT_USED } else { 0 };
        foot.iterations = taken;
        foot
    }

    /// The global search of a query; `floor`: the gap that rounding leaves to it.
    fn search<'a>(
        &'a self,
        index: &'a CurveIndex,
        query: Vector,
        options: &'a QueryOptions,
        floor: f64,
    ) -> CurveSearch<'a> {
        CurveSearch {
            index,
            reach: index.reach.as_ref(),
            whole: self.whole(index, query, floor),
            query: index.frame.enter(query),
            range: self.range(options),
            options,
            steps: position_steps(index.degree()),
        }
    }

    /// The global search; `within`: only what is nearer than that counts, see [`nothing_within`].
    pub(super) fn global(
        &self,
        index: &CurveIndex,
        query: Vector,
        begin: Begin<f64>,
        within: Option<Within>,
        options: &QueryOptions,
        workspace: &mut Workspace,
        trace: Option<Trace>,
    ) -> FootPoint {
        match self.seek(index, query, begin, within, options, workspace, trace) {
            Outcome::Record(foot) => foot,
            Outcome::Place(sought) => {
                let foot = self.foot_at(index, query, sought.at, self.range(options));
                self.record(index, query, options, &sought, foot)
            }
        }
    }

    /// As [`Self::global`], but the record of the place is still to be made.
    fn seek(
        &self,
        index: &CurveIndex,
        query: Vector,
        begin: Begin<f64>,
        within: Option<Within>,
        options: &QueryOptions,
        workspace: &mut Workspace,
        mut trace: Option<Trace>,
    ) -> Outcome<f64> {
        let traced = trace.is_some();
        let floor = Self::floor(index, query);
        let gap = options.accuracy(&index.frame).max(floor);
        let allowed = gap.max(floor + rounding_floor(&index.frame, query, 0.0));
        let budget = if options.budget > 0 {
            options.budget
        } else {
            default_budget(2 * index.degree() + 1)
        };
        let mut search = self.search(index, query, options, floor);
        if within.is_some() {
            // Where only what is nearer than another shape counts, a foot of this one settles nothing.
            search.reach = None;
        }
        let hinted = if begin.is_hinted() { flag::HINT_USED } else { 0 };
        if !traced && let Some(mut foot) = self.elementary(index, query, &search, (gap, allowed)) {
            foot.flags |= hinted;
            return Outcome::Record(foot);
        }
        let mut tell = |step: u32, site: Site, d: f64| {
            if let Some(trace) = &mut trace {
                trace(step, search.parameter(site), 0.0, d / index.frame.scale);
            }
        };
        let watch: Option<Watch> = if traced { Some(&mut tell) } else { None };
        let mut proof = Proof::new(0.5 * gap * index.frame.scale, budget, watch);
        if let Some(within) = within {
            proof.begin_within(within.distance * index.frame.scale, within.direction);
        }
        match begin {
            Begin::Hint(u) => search.start_at(u, &mut proof),
            Begin::On(left) => search.resume(left, &mut proof),
            Begin::Anywhere if within.is_none() => search.start_near(&mut proof),
            Begin::Anywhere => {}
        }
        search.walk(workspace, &mut proof);
        search.polish(&mut proof);
        let Some(site) = proof.site else {
            if within.is_some() {
                return Outcome::Record(nothing_within(&proof, &index.frame));
            }
            let foot = self.foot_at(index, query, search.range[0], search.range);
            return Outcome::Record(far_foot(foot, &index.frame, allowed));
        };
        let certificate = proof.certificate();
        let mut flags = hinted;
        if proof.settled.is_none() {
            if proof.flat.is_some() && search.is_continuum(site, &proof) {
                flags |= flag::CONTINUUM | flag::TIE;
            } else {
                flags |= search.ties(workspace, &mut proof);
            }
        }
        let evaluations = proof.evaluations;
        let at = search.parameter(site);
        Outcome::Place(Sought { at, certificate, flags, evaluations, allowed })
    }
}

/// One global search on a curve.
struct CurveSearch<'a> {
    index: &'a CurveIndex,
    /// Where a foot of the curve may settle the search.
    reach: Option<&'a CurveReach>,
    /// The curve and the query as the caller has them.
    whole: WholeCurve<'a>,
    query: Vector,
    range: [f64; 2],
    options: &'a QueryOptions,
    steps: f64,
}

impl CurveSearch<'_> {
    /// The part of segment `k` inside the restriction, in local parameters.
    fn local_range(&self, k: usize) -> Option<[f64; 2]> {
        if self.options.domain.is_none() {
            return Some([0.0, 1.0]);
        }
        let range = self.index.segments[k].u.cover(self.range);
        (range[0] < range[1]).then_some(range)
    }

    /// The caller's parameter of a place; ends of segments and of the restriction come out exactly.
    fn parameter(&self, site: Site) -> f64 {
        self.index.segments[site.piece].u.global(site.at[0]).clamp(self.range[0], self.range[1])
    }

    /// Whether the distance stays within the window along the flat direction of the best foot.
    fn is_continuum(&self, site: Site, proof: &Proof) -> bool {
        let Some(range) = self.local_range(site.piece) else { return false };
        let view =
            (self.index.net(site.piece), sub(self.query, self.index.segments[site.piece].center));
        let home = view.0.jet(site.at[0], view.1).d;
        proof.best > proof.window()
            && [-1.0, 1.0].into_iter().any(|side| {
                CONTINUUM_STEPS.into_iter().all(|step| {
                    let s = site.at[0] + side * step;
                    let there = view.0.jet(s.clamp(0.0, 1.0), view.1).d;
                    // A part that is a single point is one foot.
                    let other = norm(sub(there, home)) > proof.window();
                    (range[0]..=range[1]).contains(&s) && other && norm(there) <= proof.level()
                })
            })
    }

    fn start_at(&self, u: f64, proof: &mut Proof) {
        let (k, start) = self.hinted(u);
        let Some(range) = self.local_range(k) else { return };
        self.iterate_from(k, start, range, proof);
        self.go_on(proof);
    }

    /// A place that is likely near, in the cell of a hint.
    fn hinted(&self, u: f64) -> (usize, f64) {
        let (k, start) = self.place_of(u);
        let is_free = self.options.method == Method::Auto && self.options.domain.is_none();
        let reach = self.reach.filter(|_| is_free);
        (k, reach.map_or(start, |reach| reach.better(k, start, self.query)))
    }

    /// The segment of a parameter, and its local parameter.
    fn place_of(&self, u: f64) -> (usize, f64) {
        let u = u.clamp(self.range[0], self.range[1]);
        let segments = &self.index.segments;
        let k = segments.partition_point(|s| s.u.ends[1] <= u).min(segments.len() - 1);
        (k, segments[k].u.local(u))
    }

    /// Begins at a place that is likely near, where a foot may settle the search.
    fn start_near(&self, proof: &mut Proof) {
        if self.options.method != Method::Auto {
            return;
        }
        let Some((k, start)) = self.near() else { return };
        let Some(range) = self.local_range(k) else { return };
        self.iterate_from(k, start, range, proof);
        self.go_on(proof);
    }

    /// Goes on in the neighbours from a foot at the end of a segment that does not settle the query.
    fn go_on(&self, proof: &mut Proof) {
        if proof.settled.is_none() {
            self.polish(proof);
        }
    }

    /// Goes on where lanes have left off, as the search of one query does.
    fn resume(&self, Left { piece, approach, .. }: Left<f64>, proof: &mut Proof) {
        self.iterate_on(piece, approach, [0.0, 1.0], proof);
        self.go_on(proof);
    }

    /// A place that is likely near.
    fn near(&self) -> Option<(usize, f64)> {
        let near = self.reach.map(|reach| reach.start(self.query, &self.index.tree));
        near.or_else(|| self.guess())
    }

    /// The place on the chord of a near segment.
    fn guess(&self) -> Option<(usize, f64)> {
        let k = self.index.tree.glance(self.query)?;
        let (lanes, q) = (self.index.net(k).lanes, sub(self.query, self.index.segments[k].center));
        let [first, last] = [lanes[0], lanes[lanes.len() - 1]].map(place);
        let chord = sub(last, first);
        let share = dot(sub(q, first), chord) / dot(chord, chord);
        Some((k, if share.is_nan() { 0.5 } else { share.clamp(0.0, 1.0) }))
    }

    fn iterate_from(&self, k: usize, start: f64, range: [f64; 2], proof: &mut Proof) {
        self.iterate_on(k, Approach::new(start), range, proof);
    }

    fn iterate_on(&self, k: usize, from: Approach<f64>, range: [f64; 2], proof: &mut Proof) {
        let view = (self.index.net(k), sub(self.query, self.index.segments[k].center));
        let method = self.options.method;
        let Landing { at, mut seen, mut jet, taken } = match &mut proof.trace {
            None => land_on_curve(&view, from, range, method),
            Some(watch) => {
                let mut tell = |step: u32, s: f64, _: f64, d: f64| {
                    watch(step, Site { piece: k, at: [s, 0.0] }, d);
                };
                let (at, jet, taken) =
                    foot_on_curve(&view, from.at, range, method, Some(&mut tell));
                Landing { at, seen: at, jet, taken }
            }
        };
        proof.iterated(taken);
        let (rational, radius) = (self.index.is_rational(), self.index.segments[k].radius);
        let position = position_error(self.steps, rational, radius, norm(view.1), norm(self.query));
        let (degree, gap) = (self.index.degree(), proof.gap);
        let site = |s: f64| Site { piece: k, at: [s, 0.0] };
        let settled =
            |s, jet: &Jet1| settled_on_curve(self.reach, site(s), jet, position, degree, gap);
        let mut bound = settled(seen, &jet);
        if bound.is_none() && seen != at {
            (seen, jet) = (at, view.0.jet(at, view.1));
            proof.evaluations += 1;
            bound = settled(seen, &jet);
        }
        let flat = || jet.is_flat().then_some([1.0, 0.0]);
        proof.offer(site(at), jet.d, flat);
        if seen == at {
            proof.keep(site(at), &jet.into());
        }
        proof.settle(site(at), || bound);
    }

    /// Goes on in the neighbour when the best foot lies on the knot between two segments: the search leaves out what
    /// is nearer by less than the accuracy, the foot should not.
    fn polish(&self, proof: &mut Proof) {
        if let (Some(site), true) = (proof.site, proof.is_cut_off)
            && let Some(range) = self.local_range(site.piece)
        {
            self.iterate_from(site.piece, site.at[0], range, proof);
        }
        let Some(site) = proof.site else { return };
        let (piece, start) = match site.at[0] {
            0.0 => (site.piece.wrapping_sub(1), 1.0),
            1.0 => (site.piece + 1, 0.0),
            _ => return,
        };
        if piece < self.index.segments.len()
            && let Some(range) = self.local_range(piece)
        {
            self.iterate_from(piece, start, range, proof);
        }
    }

    fn walk(&self, workspace: &mut Workspace, proof: &mut Proof) {
        let slack = tree_slack(self.query);
        let first = self.first_limit(proof, slack);
        self.index.tree.start(&mut workspace.queue);
        workspace.loose.clear();
        while let Some(next) = workspace.queue.pop() {
            let limit = tree_limit(proof, slack).min(first);
            if proof.is_trivial() || next.key > limit {
                return;
            }
            match next.piece() {
                None => self.index.tree.open(next, self.query, limit, &mut workspace.queue),
                Some(k) => {
                    self.search(k, &mut workspace.line, proof);
                    note_loose(k, &mut workspace.loose, proof);
                }
            }
        }
    }

    /// How far the walk needs to look before it has found anything: an end of a near segment tells.
    fn first_limit(&self, proof: &Proof, slack: f64) -> f64 {
        if proof.best.is_finite() || self.options.domain.is_some() {
            return f64::INFINITY;
        }
        let near = self.index.tree.glance(self.query);
        near.map_or(f64::INFINITY, |k| {
            first_limit(self.index.end_distance(k, self.query), proof, slack)
        })
    }

    fn search(&self, k: usize, memory: &mut LineMemory, proof: &mut Proof) {
        let Some(range) = self.local_range(k) else { return };
        let segment = &self.index.segments[k];
        let p = sub(self.query, segment.center);
        let size = norm(p);
        let position = position_error(
            self.steps,
            self.index.is_rational(),
            segment.radius,
            size,
            norm(self.query),
        );
        let radius = segment.radius + size;
        let error = squared_error(position, radius, product_steps(self.index.degree() + 1));
        let source = match self.index.tensors(k) {
            Some(tensors) if range == [0.0, 1.0] => {
                // Most segments go here, and leave no trace.
                let mu = proof.level_squared().max(proof.tie_squared()) + error;
                let (grid, square) = (&self.index.grid, dot(p, p));
                if mu.is_finite() && grid.product_beyond(tensors, p, square, mu, LEAST_C) {
                    return;
                }
                Source::Tensors(tensors)
            }
            _ => Source::Poles,
        };
        let site = |s: f64| Site { piece: k, at: [s, 0.0] };
        let line = Line {
            segment: self.index.net(k),
            query: p,
            position,
            range,
            // The caller's range decides: its local image may end on a piece's end without being one's own.
            border: [
                segment.border[0] || self.range[0] >= segment.u.ends[0],
                segment.border[1] || self.range[1] <= segment.u.ends[1],
            ],
            site: &site,
            grid: &self.index.grid,
            method: self.options.method,
            reach: self.reach,
        };
        let here = proof.site.filter(|site| site.piece == k);
        let foot = here.and_then(|site| Some((site.at[0], proof.jet_at(site)?.along(0))));
        search_line(&line, &Given { source, error, radius, foot }, memory, proof);
    }
}
