//! Nearest point of a surface.

mod elementary;
mod lockstep;
mod record;
mod rescue;
mod ties;

use super::curve::neighbour;
use super::local::{LOCAL_FLAGS, WholeSurface, surface_start};
use super::lockstep::{Begin, Left};
use super::patch::{Far, PatchMemory, Sheet, search_patch};
use super::proof::{Proof, Site, Watch, note_loose};
use super::settle::settled;
use super::sought::{Outcome, Sought};
use super::within::{Within, nothing_within};
use super::{
    FootPoint, QueryOptions, Scope, Workspace, default_budget, far_foot, first_limit, flag, is_bad,
    is_coarse, mark_inversion, rounding_floor, search_floor, tree_limit, tree_slack,
};
use crate::bounds::{HALF_ULP, Vector, add, dot, norm, scaled, sub};
use crate::error::Error;
use crate::index::{IndexedSurface, Reach, Span, SurfaceIndex, position_error, position_steps};
use crate::jet::{BezierPatch, Jet2, place};
use crate::refine::{Approach, Landing, Method, Trace, foot_on_surface, land_on_surface};

/// Boxes that one patch may take before the others have had their turn: a difficult patch that does not even
/// hold the foot must not use up the budget. One query in a thousand gets here.
const PATIENCE: u64 = 64;

/// Most lines between patches that a descent crosses at a time: along an almost-continuum it could go on for long.
const MOST_CROSSED: usize = 8;

impl IndexedSurface {
    /// The nearest point of the surface to `query`, with proof.
    ///
    /// `hint` is a parameter pair near the foot, if the caller knows one; it changes the time, not the distance.
    /// A query that is not finite gives [`FootPoint::bad_query`]; memory that cannot be had for the index gives
    /// [`FootPoint::unreached`]. Cost: a few microseconds.
    pub fn closest(
        &self,
        query: Vector,
        hint: Option<[f64; 2]>,
        options: &QueryOptions,
        workspace: &mut Workspace,
        trace: Option<Trace>,
    ) -> FootPoint {
        if is_bad(query) {
            return FootPoint::bad_query();
        }
        let Ok(index) = self.index(&mut || false) else { return FootPoint::unreached() };
        let hint = hint.filter(|at| at.iter().all(|x| x.is_finite()));
        match options.scope {
            Scope::Local => self.local(index, query, hint, options, workspace, trace),
            Scope::Global => {
                let begin = Begin::at(hint);
                self.global(index, query, begin, None, options, workspace, trace)
            }
        }
    }

    /// As [`Self::closest`], for a query that should lie on the surface: beyond the tolerance the foot is marked
    /// [`flag::NOT_ON_SHAPE`].
    pub fn invert(
        &self,
        query: Vector,
        hint: Option<[f64; 2]>,
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

    /// Whether a restriction u0, u1, v0, v1 lies in the domain, with u0 < u1 and v0 < v1.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] naming the entry.
    pub fn check_domain(&self, domain: [f64; 4]) -> Result<(), Error> {
        let [u0, u1, v0, v1] = self.surface().domain();
        super::check_range("domain", 0, [domain[0], domain[1]], (u0, u1))?;
        super::check_range("domain", 2, [domain[2], domain[3]], (v0, v1))
    }

    fn range(&self, options: &QueryOptions) -> [f64; 4] {
        self.restricted(options.domain)
    }

    /// The part of the domain that a restriction leaves.
    pub(crate) fn restricted(&self, domain: Option<[f64; 4]>) -> [f64; 4] {
        let [u0, u1, v0, v1] = self.surface().domain();
        domain
            .map_or([u0, u1, v0, v1], |d| [d[0].max(u0), d[1].min(u1), d[2].max(v0), d[3].min(v1)])
    }

    /// The gap that rounding leaves to a search.
    pub(super) fn floor(index: &SurfaceIndex, query: Vector) -> f64 {
        search_floor(
            &index.frame,
            query,
            position_steps(index.degree.s + index.degree.t),
            index.rational,
        )
    }

    /// The shape as an iteration across pieces sees it.
    fn whole(&self, index: &SurfaceIndex, query: Vector, floor: f64) -> WholeSurface<'_> {
        let coarse = is_coarse(&index.frame, query, floor);
        WholeSurface { surface: self.surface(), query, scale: index.frame.scale, coarse }
    }

    fn local(
        &self,
        index: &SurfaceIndex,
        query: Vector,
        hint: Option<[f64; 2]>,
        options: &QueryOptions,
        workspace: &mut Workspace,
        trace: Option<Trace>,
    ) -> FootPoint {
        let start = hint.unwrap_or_else(|| {
            surface_start(index, index.frame.enter(query), &mut workspace.start)
        });
        let surface = self.whole(index, query, Self::floor(index, query));
        let (at, _, taken) =
            foot_on_surface(&surface, start, self.range(options), options.method, trace);
        let mut foot = self.foot_at(index, query, at, self.range(options));
        foot.flags |= LOCAL_FLAGS | if hint.is_some() { flag::HINT_USED } else { 0 };
        foot.iterations = taken;
        foot
    }

    /// The global search of a query; `floor`: the gap that rounding leaves to it.
    fn search<'a>(
        &'a self,
        index: &'a SurfaceIndex,
        query: Vector,
        options: &'a QueryOptions,
        floor: f64,
    ) -> SurfaceSearch<'a> {
        SurfaceSearch {
            index,
            reach: index.reach.as_ref(),
            whole: self.whole(index, query, floor),
            query: index.frame.enter(query),
            range: self.range(options),
            options,
            steps: position_steps(index.degree.s + index.degree.t),
        }
    }

    /// The global search; `within`: only what is nearer than that counts, see [`nothing_within`].
    pub(super) fn global(
        &self,
        index: &SurfaceIndex,
        query: Vector,
        begin: Begin<[f64; 2]>,
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
        index: &SurfaceIndex,
        query: Vector,
        begin: Begin<[f64; 2]>,
        within: Option<Within>,
        options: &QueryOptions,
        workspace: &mut Workspace,
        mut trace: Option<Trace>,
    ) -> Outcome<[f64; 2]> {
        let traced = trace.is_some();
        let floor = Self::floor(index, query);
        let gap = options.accuracy(&index.frame).max(floor);
        let allowed = gap.max(floor + rounding_floor(&index.frame, query, 0.0));
        let coefficients = index.degree.times(index.degree).count();
        let budget = if options.budget > 0 { options.budget } else { default_budget(coefficients) };
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
                let [u, v] = search.parameters(site);
                trace(step, u, v, d / index.frame.scale);
            }
        };
        let watch: Option<Watch> = if traced { Some(&mut tell) } else { None };
        let mut proof = Proof::new(0.5 * gap * index.frame.scale, budget, watch);
        if let Some(within) = within {
            proof.begin_within(within.distance * index.frame.scale, within.direction);
        }
        match begin {
            Begin::Hint(at) => search.start_at(at, &mut proof),
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
            let corner = [search.range[0], search.range[2]];
            let foot = self.foot_at(index, query, corner, search.range);
            return Outcome::Record(far_foot(foot, &index.frame, allowed));
        };
        let certificate = proof.certificate();
        let mut flags = hinted;
        if proof.settled.is_none() {
            let flat = proof.flat.or_else(|| search.flat_at_border(site));
            if flat.is_some_and(|v| search.is_continuum(site, v, &proof)) {
                flags |= flag::CONTINUUM | flag::TIE;
            } else {
                flags |= search.ties(workspace, &mut proof);
            }
        }
        let evaluations = proof.evaluations;
        Outcome::Place(Sought {
            at: search.parameters(site),
            certificate,
            flags,
            evaluations,
            allowed,
        })
    }
}

/// One global search on a surface.
struct SurfaceSearch<'a> {
    index: &'a SurfaceIndex,
    reach: Option<&'a Reach>,
    /// The surface and the query as the caller has them.
    whole: WholeSurface<'a>,
    query: Vector,
    range: [f64; 4],
    options: &'a QueryOptions,
    steps: f64,
}

/// The part of a piece that a restriction leaves, in local parameters; `None` when it leaves nothing.
pub(crate) fn local_interval(span: Span, range: [f64; 2]) -> Option<[f64; 2]> {
    let range = span.cover(range);
    (range[0] < range[1]).then_some(range)
}

impl SurfaceSearch<'_> {
    fn local_range(&self, k: usize) -> Option<[f64; 4]> {
        if self.options.domain.is_none() {
            return Some([0.0, 1.0, 0.0, 1.0]);
        }
        let patch = &self.index.patches[k];
        let s = local_interval(patch.u, [self.range[0], self.range[1]])?;
        let t = local_interval(patch.v, [self.range[2], self.range[3]])?;
        Some([s[0], s[1], t[0], t[1]])
    }

    /// The caller's parameters of a place; ends of patches come out exactly, and nothing leaves the restriction.
    fn parameters(&self, site: Site) -> [f64; 2] {
        let patch = &self.index.patches[site.piece];
        [
            patch.u.global(site.at[0]).clamp(self.range[0], self.range[1]),
            patch.v.global(site.at[1]).clamp(self.range[2], self.range[3]),
        ]
    }

    fn start_at(&self, at: [f64; 2], proof: &mut Proof) {
        let (k, start) = self.place_of(at);
        let Some(range) = self.local_range(k) else { return };
        self.iterate_from(k, start, range, self.options.method, proof);
        self.go_on(proof);
    }

    /// The patch of a parameter pair, and its local parameters.
    fn place_of(&self, at: [f64; 2]) -> (usize, [f64; 2]) {
        let at =
            [at[0].clamp(self.range[0], self.range[1]), at[1].clamp(self.range[2], self.range[3])];
        let [row, column] = [0, 1].map(|k| self.index.strip(k, at[k]));
        let k = row * self.index.columns + column;
        let patch = &self.index.patches[k];
        (k, [patch.u.local(at[0]), patch.v.local(at[1])])
    }

    /// Begins at a place that is likely near, where a foot may settle the search.
    fn start_near(&self, proof: &mut Proof) {
        if self.options.method != Method::Auto {
            return;
        }
        let Some((k, start)) = self.near() else { return };
        let Some(range) = self.local_range(k) else { return };
        self.iterate_from(k, start, range, Method::Auto, proof);
        self.go_on(proof);
    }

    /// Goes on in the neighbours from a foot on a line that does not settle the query.
    fn go_on(&self, proof: &mut Proof) {
        if proof.settled.is_none() {
            self.cross(proof);
        }
    }

    /// Goes on where lanes have left off, as the search of one query does.
    fn resume(&self, Left { piece, approach, .. }: Left<[f64; 2]>, proof: &mut Proof) {
        self.iterate_on(piece, approach, [0.0, 1.0, 0.0, 1.0], Method::Auto, proof);
        self.go_on(proof);
    }

    /// The net of a patch, and the query in its coordinates.
    fn view(&self, k: usize) -> (BezierPatch<'_>, Vector) {
        (self.index.net(k), sub(self.query, self.index.patches[k].center))
    }

    /// How far a point computed of a patch may be off.
    fn position(&self, k: usize, query: Vector) -> f64 {
        let (rational, size) = (self.index.rational, norm(self.query));
        let radius = self.index.patches[k].radius;
        position_error(self.steps, rational, radius, norm(query), size)
    }

    /// A place that is likely near.
    fn near(&self) -> Option<(usize, [f64; 2])> {
        let near = self.reach.map(|reach| reach.start(self.query, &self.index.tree));
        near.or_else(|| self.guess())
    }

    /// The place on the plane through the corners of a near patch.
    fn guess(&self) -> Option<(usize, [f64; 2])> {
        let k = self.index.tree.glance(self.query)?;
        let (lanes, columns) = (self.index.net(k).lanes, self.index.degree.t + 1);
        let q = sub(self.query, self.index.patches[k].center);
        let corners = [0, columns - 1, lanes.len() - columns, lanes.len() - 1];
        let [a, b, c, d] = corners.map(|at| place(lanes[at]));
        // Twice the sides of the parallelogram, and four times the vector from its middle.
        let (s, t) = (sub(add(c, d), add(a, b)), sub(add(b, d), add(a, c)));
        let from = sub(scaled(q, 4.0), add(add(a, b), add(c, d)));
        let (e, f, g) = (dot(s, s), dot(s, t), dot(t, t));
        let (x, y) = (dot(from, s), dot(from, t));
        let area = 2.0 * (e * g - f * f);
        let share = |x: f64| if x.is_nan() { 0.5 } else { (0.5 + x / area).clamp(0.0, 1.0) };
        Some((k, [share(x * g - y * f), share(y * e - x * f)]))
    }

    /// The search; when the budget runs out, the foot is looked for by plain iterations from many starts, and if that
    /// finds a nearer one, the search is tried once more with it.
    fn walk(&self, workspace: &mut Workspace, proof: &mut Proof) {
        self.walk_once(workspace, proof);
        if proof.exhausted {
            let before = proof.best;
            self.rescue(workspace, proof);
            if proof.best < before - proof.window() {
                proof.restart();
                self.walk_once(workspace, proof);
            }
        }
    }

    /// Goes on where an iteration was cut off, and in the neighbours when the best foot lies on the line between two patches:
    /// the search leaves out what is nearer by less than the accuracy, the foot should not.
    fn polish(&self, proof: &mut Proof) {
        if let (Some(site), true) = (proof.site, proof.is_cut_off)
            && let Some(range) = self.local_range(site.piece)
        {
            self.iterate_from(site.piece, site.at, range, Method::Auto, proof);
        }
        self.cross(proof);
    }

    /// Goes on in the neighbours when the best foot lies on the line between two patches, or on a seam.
    fn cross(&self, proof: &mut Proof) {
        let Some(site) = proof.site else { return };
        let (columns, rows) = (self.index.columns, self.index.patches.len() / self.index.columns);
        let place = [site.piece / columns, site.piece % columns];
        for k in 0..2 {
            let forward = match site.at[k] {
                0.0 => false,
                1.0 => true,
                _ => continue,
            };
            let round = self.period(k).is_some();
            let mut next = place;
            let Some(number) = neighbour(place[k], forward, [rows, columns][k], round) else {
                continue;
            };
            next[k] = number;
            let piece = next[0] * columns + next[1];
            let Some(range) = self.local_range(piece) else { continue };
            let at = self.parameters(site);
            let patch = &self.index.patches[piece];
            let mut start = [patch.u.local(at[0]), patch.v.local(at[1])];
            start[k] = if forward { 0.0 } else { 1.0 };
            self.iterate_from(piece, start, range, self.options.method, proof);
        }
    }

    /// Goes on from patch to patch as long as that leads nearer: what is far above the least distance closes nothing.
    fn descend(&self, before: f64, proof: &mut Proof) {
        let mut before = before;
        for _ in 0..MOST_CROSSED {
            if proof.best >= before - proof.window() || proof.tying {
                return;
            }
            before = proof.best;
            self.cross(proof);
        }
    }

    fn iterate_from(
        &self,
        k: usize,
        start: [f64; 2],
        range: [f64; 4],
        method: Method,
        proof: &mut Proof,
    ) {
        self.iterate_on(k, Approach::new(start), range, method, proof);
    }

    fn iterate_on(
        &self,
        k: usize,
        from: Approach<[f64; 2]>,
        range: [f64; 4],
        method: Method,
        proof: &mut Proof,
    ) {
        let view = self.view(k);
        let Landing { at, mut seen, mut jet, mut taken } = match &mut proof.trace {
            None => land_on_surface(&view, from, range, method),
            Some(watch) => {
                let mut tell = |step: u32, s: f64, t: f64, d: f64| {
                    watch(step, Site { piece: k, at: [s, t] }, d);
                };
                let (at, jet, taken) =
                    foot_on_surface(&view, from.at, range, method, Some(&mut tell));
                Landing { at, seen: at, jet, taken }
            }
        };
        let position = self.position(k, view.1);
        let (degree, gap) = (self.index.degree, proof.gap);
        let site = |at| Site { piece: k, at };
        let look_at = |here, jet: &Jet2| {
            // What is on the surface is known to be nearest.
            let distance = norm(jet.d);
            let around = (here == at && distance > gap)
                .then(|| (self.query, distance + proof.window(), self.index.tree.level()));
            settled(self.reach?, site(here), jet, [position, gap], degree, around)
        };
        let mut bound = look_at(seen, &jet);
        if bound.is_none() && seen != at {
            (seen, jet) = (at, view.0.jet(at[0], at[1], view.1));
            taken += 1;
            bound = look_at(seen, &jet);
        }
        proof.iterated(taken);
        proof.offer(site(at), jet.d, || jet.flat_direction());
        if seen == at {
            proof.keep(site(at), &jet);
        }
        proof.settle(site(at), || bound);
    }

    fn walk_once(&self, workspace: &mut Workspace, proof: &mut Proof) {
        let slack = tree_slack(self.query);
        let first = self.first_limit(proof, slack);
        self.index.tree.start(&mut workspace.queue);
        workspace.deferred.clear();
        workspace.loose.clear();
        while let Some(next) = workspace.queue.pop() {
            let limit = tree_limit(proof, slack).min(first);
            if proof.is_trivial() || next.key > limit {
                break;
            }
            if proof.exhausted {
                proof.give_up(next.key.sqrt() * (1.0 - 8.0 * HALF_ULP) - slack);
                break;
            }
            match next.piece() {
                None => self.index.tree.open(next, self.query, limit, &mut workspace.queue),
                Some(k) => {
                    let before = proof.best;
                    let closed = self.search(k, PATIENCE, &mut workspace.patch, proof);
                    self.descend(before, proof);
                    if closed {
                        note_loose(k, &mut workspace.loose, proof);
                    } else {
                        workspace.deferred.push((next.key, k));
                    }
                }
            }
        }
        for &(key, k) in &workspace.deferred {
            if proof.exhausted {
                proof.give_up(key.sqrt() * (1.0 - 8.0 * HALF_ULP) - slack);
            } else if !proof.is_trivial() {
                self.search(k, u64::MAX, &mut workspace.patch, proof);
                note_loose(k, &mut workspace.loose, proof);
            }
        }
    }

    /// How far the walk needs to look before it has found anything: a corner of a near patch tells.
    fn first_limit(&self, proof: &Proof, slack: f64) -> f64 {
        if proof.best.is_finite() || self.options.domain.is_some() {
            return f64::INFINITY;
        }
        let near = self.index.tree.glance(self.query);
        near.map_or(f64::INFINITY, |k| {
            first_limit(self.index.corner_distance(k, self.query), proof, slack)
        })
    }

    /// False when patience ran out before the patch was closed.
    fn search(&self, k: usize, patience: u64, memory: &mut PatchMemory, proof: &mut Proof) -> bool {
        let Some(range) = self.local_range(k) else { return true };
        let (patch, ladder) = (&self.index.patches[k], &self.index.ladder);
        let (net, query) = self.view(k);
        let position = self.position(k, query);
        let is_whole = range == [0.0, 1.0, 0.0, 1.0];
        let tensors = self.index.tensors(k).filter(|_| is_whole);
        let grid = ladder.whole();
        let far = Far { net, tensors, radius: patch.radius, query, position, grid };
        if !patch.has_collapsed() && far.decides(proof) {
            return true;
        }
        // The caller's range decides: its local image may end on a piece's side without being one's own.
        let [u0, u1, v0, v1] = self.range;
        let (u, v) = (patch.u.ends, patch.v.ends);
        let cut = [u0 >= u[0], u1 <= u[1], v0 >= v[0], v1 <= v[1]];
        let sheet = Sheet {
            net,
            patch,
            piece: k,
            tensors,
            query,
            position,
            range,
            border: [0, 1, 2, 3].map(|e| patch.border[e] || cut[e]),
            ladder,
            edge_grids: &self.index.edge_grids,
            method: self.options.method,
            reach: self.reach,
            patience,
        };
        search_patch(&sheet, memory, proof)
    }
}
