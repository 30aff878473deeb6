//! Hits of a curve with a curve or a surface, from what the boxes left: crossings, contacts, overlaps.

use super::hits::{CurveHit, CurveHits, DEFAULT_BUDGET, HitOptions, Nature};
use super::pairs::{Body, Found, FoundKind, Pairs};
use crate::bounds::{Vector, cross, dot, norm, sub};
use crate::closest::{QueryOptions, Workspace};
use crate::error::Error;
use crate::index::{Frame, IndexedCurve, IndexedSurface};
use crate::knots::Side;

/// Sine of the angle below which a crossing counts as tangential.
const TANGENTIAL: f64 = 1e-5;

/// Samples along a piece that two shapes share, and their distance, as a share of the tolerance, up to which they coincide.
const SAMPLES: usize = 9;
pub const COINCIDENT: f64 = 1.0 / 64.0;

/// Share of the tolerance with which near places are searched again, so that two crossings there are two.
const FINE: f64 = 1e-4;

impl IndexedCurve {
    /// Where this curve (u) meets another one (w): everything else of the two is proven to be farther apart than the tolerance.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`]. When `poll` says stop the answer is what was found so far ([`CurveHits::stopped`]).
    pub fn meet_curve(
        &self,
        other: &IndexedCurve,
        options: &HitOptions,
        poll: &mut dyn FnMut() -> bool,
    ) -> Result<CurveHits, Error> {
        let (u, w) = (self.curve().domain(), other.curve().domain());
        let Some((a, b)) = unless_stopped(self.index(poll), || other.index(poll))? else {
            return Ok(CurveHits::unreached([u.0, u.1, 0.0, 0.0, w.0, w.1]));
        };
        let frame = joint(&a.frame, &b.frame);
        let first = Body::curve(self, a, &frame);
        let second = Body::curve(other, b, &frame);
        Work::new(first, second, Target::Curve(self), other, &frame, options).run(options, poll)
    }
}

impl IndexedSurface {
    /// Where this surface (u, v) meets a curve (w): as [`IndexedCurve::meet_curve`].
    ///
    /// # Errors
    /// As [`IndexedCurve::meet_curve`].
    pub fn meet_curve(
        &self,
        curve: &IndexedCurve,
        options: &HitOptions,
        poll: &mut dyn FnMut() -> bool,
    ) -> Result<CurveHits, Error> {
        let ([u0, u1, v0, v1], w) = (self.surface().domain(), curve.curve().domain());
        let Some((a, b)) = unless_stopped(self.index(poll), || curve.index(poll))? else {
            return Ok(CurveHits::unreached([u0, u1, v0, v1, w.0, w.1]));
        };
        let frame = joint(&a.frame, &b.frame);
        let first = Body::surface(self, a, &frame);
        let second = Body::curve(curve, b, &frame);
        Work::new(first, second, Target::Surface(self), curve, &frame, options).run(options, poll)
    }
}

/// Both indexes; `None` when one of them was stopped.
fn unless_stopped<A, B>(
    first: Result<A, Error>,
    second: impl FnOnce() -> Result<B, Error>,
) -> Result<Option<(A, B)>, Error> {
    match first.and_then(|first| Ok((first, second()?))) {
        Err(Error::Cancelled) => Ok(None),
        both => both.map(Some),
    }
}

/// The frame of the larger of two shapes.
fn joint(a: &Frame, b: &Frame) -> Frame {
    if a.diagonal >= b.diagonal { *a } else { *b }
}

enum Target<'a> {
    Curve(&'a IndexedCurve),
    Surface(&'a IndexedSurface),
}

struct Work<'a> {
    pairs: Pairs<'a>,
    target: Target<'a>,
    curve: &'a IndexedCurve,
    /// In the caller's unit.
    tolerance: f64,
    /// Where the two come near without running together they are searched again with this tolerance, in common coordinates.
    fine: f64,
}

impl<'a> Work<'a> {
    fn new(
        first: Body<'a>,
        second: Body<'a>,
        target: Target<'a>,
        curve: &'a IndexedCurve,
        frame: &Frame,
        options: &HitOptions,
    ) -> Self {
        let asked = if options.tolerance > 0.0 { options.tolerance } else { 1e-7 * frame.diagonal };
        // Points are as exact as the coordinates of the shapes.
        let floor = 1e-14 * frame.diagonal + 4.0 * f64::EPSILON * frame.magnitude;
        let tolerance = asked.max(floor);
        let pairs = Pairs { first, second, tolerance: tolerance * frame.scale };
        Self { pairs, target, curve, tolerance, fine: floor.max(FINE * tolerance) * frame.scale }
    }

    fn run(
        mut self,
        options: &HitOptions,
        poll: &mut dyn FnMut() -> bool,
    ) -> Result<CurveHits, Error> {
        let mut budget = if options.budget > 0 { options.budget } else { DEFAULT_BUDGET };
        let mut found = Vec::new();
        let mut stopped = !self.pairs.search(&mut budget, &mut found, poll);
        let of_curves = matches!(self.target, Target::Curve(_));
        let boxed = |item: &Found| boxed(item, of_curves);
        let mut out = CurveHits::default();
        let (mut crossings, mut together) = (Vec::new(), Vec::new());
        for item in found {
            match item.kind {
                FoundKind::Crossing => crossings.push(self.crossing(&item)),
                FoundKind::Together => together.push(item),
                FoundKind::Undecided => out.undecided.push(boxed(&item)),
            }
        }
        let coarse = self.pairs.tolerance;
        let mut outer = Vec::new();
        for group in groups(together) {
            stopped = stopped || poll();
            if stopped {
                out.undecided.extend(group.iter().map(boxed));
                continue;
            }
            if self.is_overlap(&group, &mut out) {
                continue;
            }
            self.pairs.tolerance = self.fine;
            let mut finer = Vec::new();
            let places = group.iter().map(|item| item.places);
            stopped = !self.pairs.search_in(places, &mut budget, &mut finer, poll);
            self.pairs.tolerance = coarse;
            if stopped {
                // What is near was not told apart.
                out.undecided.extend(group.iter().map(boxed));
                continue;
            }
            let is = |kind| move |item: &&Found| item.kind == kind;
            out.undecided.extend(finer.iter().filter(is(FoundKind::Undecided)).map(boxed));
            outer.push(hull(&group));
            let before = crossings.len();
            crossings
                .extend(finer.iter().filter(is(FoundKind::Crossing)).map(|f| self.crossing(f)));
            let left: Vec<Found> = finer.iter().filter(is(FoundKind::Together)).copied().collect();
            if left.is_empty() && crossings.len() == before {
                self.contact(&group, &mut crossings, &mut out);
            }
            for part in groups(left) {
                self.contact(&part, &mut crossings, &mut out);
            }
        }
        out.hits.append(&mut crossings);
        out.hits.sort_by(|a, b| {
            a.w.total_cmp(&b.w).then(a.u.total_cmp(&b.u)).then(a.v.total_cmp(&b.v))
        });
        self.join(&mut out.hits);
        for (low, high) in outer {
            self.widen(&mut out.hits, low, high);
        }
        out.stopped = stopped;
        Ok(out)
    }

    /// Intervals of the hits in a box of near places: together they hold all of it.
    fn widen(&self, hits: &mut [CurveHit], low: [f64; 3], high: [f64; 3]) {
        let order = if matches!(self.target, Target::Curve(_)) { [1, 0] } else { [0, 1] };
        let inside = |hit: &CurveHit| {
            let at = [hit.u, hit.v];
            hit.nature != Nature::Overlap
                && (low[2]..=high[2]).contains(&hit.w)
                && (0..2).all(|k| (low[order[k]]..=high[order[k]]).contains(&at[k]))
        };
        let first = hits.iter().position(inside);
        let last = hits.iter().rposition(inside);
        let (Some(first), Some(last)) = (first, last) else { return };
        hits[first].w_range[0] = hits[first].w_range[0].min(low[2]);
        hits[last].w_range[1] = hits[last].w_range[1].max(high[2]);
        for k in [first, last] {
            let hit = &mut hits[k];
            let grown = |range: [f64; 2], c: usize| [range[0].min(low[c]), range[1].max(high[c])];
            hit.u_range = grown(hit.u_range, order[0]);
            hit.v_range = grown(hit.v_range, order[1]);
        }
    }

    /// Slopes of the first shape (two for a surface) and of the curve.
    fn slopes(&self, at: [f64; 3]) -> ([Vector; 2], Vector) {
        let mut line = [[0.0; 3]; 2];
        let end =
            |u: f64, domain: (f64, f64)| if u >= domain.1 { Side::Below } else { Side::Above };
        let curve = self.curve.curve();
        curve.derivatives_on(at[2], end(at[2], curve.domain()), 1, &mut line);
        let first = match self.target {
            Target::Curve(shape) => {
                let mut own = [[0.0; 3]; 2];
                let curve = shape.curve();
                curve.derivatives_on(at[1], end(at[1], curve.domain()), 1, &mut own);
                [own[1], [0.0; 3]]
            }
            Target::Surface(shape) => {
                let mut partials = [[0.0; 3]; 3];
                shape.surface().partials(at[0], at[1], 1, &mut partials);
                [partials[1], partials[2]]
            }
        };
        (first, line[1])
    }

    /// Sine of the angle between the two; 0 when it is not known.
    fn sine(&self, at: [f64; 3]) -> f64 {
        let ([a, b], d) = self.slopes(at);
        let sine = match self.target {
            Target::Curve(_) => norm(cross(a, d)) / (norm(a) * norm(d)),
            Target::Surface(_) => {
                let n = cross(a, b);
                dot(n, d).abs() / (norm(n) * norm(d))
            }
        };
        if sine.is_nan() { 0.0 } else { sine }
    }

    fn hit(&self, at: [f64; 3], low: [f64; 3], high: [f64; 3], nature: Nature) -> CurveHit {
        let point = self.pairs.first.point([at[0], at[1]]);
        let other = self.pairs.second.point([0.0, at[2]]);
        let distance = norm(sub(point, other));
        // A curve's parameter is the second one of a body.
        let order = if matches!(self.target, Target::Curve(_)) { [1, 0] } else { [0, 1] };
        let [i, j] = order;
        let multiplicity = u32::from(nature == Nature::Transversal);
        CurveHit {
            u: at[i],
            v: at[j],
            w: at[2],
            point,
            distance,
            u_range: [low[i], high[i]],
            v_range: [low[j], high[j]],
            w_range: [low[2], high[2]],
            nature,
            multiplicity,
        }
    }

    /// A crossing with the interval in which the two stay within the tolerance.
    fn crossing(&self, item: &Found) -> CurveHit {
        let sine = self.sine(item.at);
        let mut hit = self.hit(item.at, item.at, item.at, Nature::Transversal);
        if sine < TANGENTIAL {
            hit.nature = Nature::Tangential;
            hit.multiplicity = 2;
        }
        let ([a, b], d) = self.slopes(item.at);
        let reach = 2.0 * self.tolerance / sine.max(TANGENTIAL);
        let spread = |v: Vector| if norm(v) > 0.0 { reach / norm(v) } else { 0.0 };
        let grow = |x: f64, r: f64| [x - r, x + r];
        let (u, v) = if matches!(self.target, Target::Curve(_)) { (a, [0.0; 3]) } else { (a, b) };
        hit.u_range = grow(hit.u, spread(u));
        hit.v_range = grow(hit.v, spread(v));
        hit.w_range = grow(hit.w, spread(d));
        hit
    }

    /// Distance of a place of the curve from the first shape, with the parameters there.
    fn foot(&self, w: f64) -> (f64, [f64; 2]) {
        let point = self.curve.curve().evaluate(w);
        let options = QueryOptions::default();
        let mut workspace = Workspace::default();
        match self.target {
            Target::Curve(shape) => {
                let foot = shape.closest(point, None, &options, &mut workspace, None);
                (foot.distance, [0.0, foot.u])
            }
            Target::Surface(shape) => {
                let foot = shape.closest(point, None, &options, &mut workspace, None);
                (foot.distance, [foot.u, foot.v])
            }
        }
    }

    /// Whether boxes that hang together are an overlap; then it is taken.
    fn is_overlap(&self, group: &[Found], out: &mut CurveHits) -> bool {
        let (low, high) = hull(group);
        let range = [low[2], high[2]];
        let at = |share: f64| range[0] + share * (range[1] - range[0]);
        let coincide = (0..SAMPLES).all(|k| {
            let share = 0.25 + 0.5 * k as f64 / (SAMPLES - 1) as f64;
            self.foot(at(share)).0 <= COINCIDENT * self.tolerance.max(self.rounding() * 64.0)
        });
        if !coincide || self.length(range) <= 64.0 * self.tolerance {
            return false;
        }
        let w = at(0.5);
        let foot = self.foot(w).1;
        out.hits.push(self.hit([foot[0], foot[1], w], low, high, Nature::Overlap));
        true
    }

    /// Boxes that hang together around a contact; a crossing inside takes them in.
    fn contact(&self, group: &[Found], crossings: &mut [CurveHit], out: &mut CurveHits) {
        let (low, high) = hull(group);
        let range = [low[2], high[2]];
        let inside = |hit: &&mut CurveHit| {
            let slack = hit.w_range[1] - hit.w_range[0];
            hit.w >= range[0] - slack && hit.w <= range[1] + slack && {
                let (u, k) =
                    if matches!(self.target, Target::Curve(_)) { (hit.u, 1) } else { (hit.u, 0) };
                let slack = hit.u_range[1] - hit.u_range[0];
                u >= low[k] - slack && u <= high[k] + slack
            }
        };
        if let Some(hit) = crossings.iter_mut().find(inside) {
            hit.w_range = [hit.w_range[0].min(range[0]), hit.w_range[1].max(range[1])];
            return;
        }
        let w = self.nearest(range);
        let (distance, foot) = self.foot(w);
        let mut hit = self.hit([foot[0], foot[1], w], low, high, Nature::Tangential);
        if distance > self.tolerance {
            // Not nearer anywhere that was looked at, and not shown to be farther.
            out.undecided.push([
                hit.u_range[0],
                hit.u_range[1],
                hit.v_range[0],
                hit.v_range[1],
                low[2],
                high[2],
            ]);
            return;
        }
        hit.multiplicity = if self.crosses(range) { 3 } else { 2 };
        if self.sine([foot[0], foot[1], w]) > 1e-2 {
            // Both end or turn here: they meet at an angle.
            hit.nature = Nature::Transversal;
            hit.multiplicity = 1;
        }
        out.hits.push(hit);
    }

    fn rounding(&self) -> f64 {
        let (low, high) = self.curve.curve().bounding_box();
        let size = low.iter().chain(&high).fold(0.0f64, |m, x| m.max(x.abs()));
        8.0 * f64::EPSILON * size
    }

    /// About the length of a piece of the curve.
    fn length(&self, [a, b]: [f64; 2]) -> f64 {
        let at = |k: usize| self.curve.curve().evaluate(a + (b - a) * k as f64 / 8.0);
        (0..8).map(|k| norm(sub(at(k + 1), at(k)))).sum()
    }

    /// Where the curve is nearest to the first shape in an interval: golden section.
    fn nearest(&self, [mut a, mut b]: [f64; 2]) -> f64 {
        let golden = 0.5 * (5.0f64.sqrt() - 1.0);
        let (mut x, mut y) = (b - golden * (b - a), a + golden * (b - a));
        let (mut fx, mut fy) = (self.foot(x).0, self.foot(y).0);
        let ends = [(a, self.foot(a).0), (b, self.foot(b).0)];
        for _ in 0..48 {
            if fx <= fy {
                (b, y, fy) = (y, x, fx);
                x = b - golden * (b - a);
                fx = self.foot(x).0;
            } else {
                (a, x, fx) = (x, y, fy);
                y = a + golden * (b - a);
                fy = self.foot(y).0;
            }
        }
        let best = [(x, fx), (y, fy)].into_iter().chain(ends);
        best.min_by(|p, q| p.1.total_cmp(&q.1)).map_or(x, |(w, _)| w)
    }

    /// Whether the curve is on different sides of the first shape at the two ends of an interval.
    fn crosses(&self, [a, b]: [f64; 2]) -> bool {
        let width = b - a;
        let (first, last) = self.curve.curve().domain();
        let mut normal: Option<Vector> = None;
        let mut side = |w: f64| {
            let w = w.clamp(first, last);
            let foot = self.foot(w).1;
            let ([s, t], d) = self.slopes([foot[0], foot[1], w]);
            let r = sub(self.pairs.second.point([0.0, w]), self.pairs.first.point(foot));
            match self.target {
                Target::Surface(_) => dot(r, cross(s, t)),
                Target::Curve(_) => {
                    // In the plane of the tangent and the offset of the first end.
                    let n = *normal.get_or_insert(cross(d, r));
                    dot(cross(s, r), n)
                }
            }
        };
        side(a - width) * side(b + width) < 0.0
    }

    /// Whether the parameters of two hits on the first shape are the same, also across a seam or along a collapsed edge.
    fn is_beside(&self, a: &CurveHit, b: &CurveHit) -> bool {
        let (domain, closed, collapsed) = match self.target {
            Target::Curve(shape) => {
                let (u0, u1) = shape.curve().domain();
                ([u0, u1, 0.0, 0.0], [shape.curve().is_closed(), false], [false; 4])
            }
            Target::Surface(shape) => {
                let surface = shape.surface();
                let closed = [surface.is_closed_u(), surface.is_closed_v()];
                (surface.domain(), closed, surface.collapsed_edges())
            }
        };
        let ranges = [[a.u_range, b.u_range], [a.v_range, b.v_range]];
        let near = |k: usize| {
            let [p, q] = ranges[k];
            let [low, high] = [domain[2 * k], domain[2 * k + 1]];
            let across = |p: [f64; 2], q: [f64; 2]| p[0] <= low && q[1] >= high;
            overlaps(p, q) || (closed[k] && (across(p, q) || across(q, p)))
        };
        // On a collapsed edge the parameter along it does not count.
        let at_edge = |k: usize, edge: usize| {
            let [p, q] = ranges[k];
            let end = domain[edge];
            collapsed[edge] && overlaps(p, [end; 2]) && overlaps(q, [end; 2])
        };
        let pole_u = at_edge(0, 0) || at_edge(0, 1);
        let pole_v = at_edge(1, 2) || at_edge(1, 3);
        (near(0) || pole_v) && (near(1) || pole_u)
    }

    /// Whether two intervals of the curve touch, also across its seam.
    fn is_beside_on_curve(&self, a: [f64; 2], b: [f64; 2]) -> bool {
        let curve = self.curve.curve();
        let (first, last) = curve.domain();
        let across = |p: [f64; 2], q: [f64; 2]| p[0] <= first && q[1] >= last;
        overlaps(a, b) || (curve.is_closed() && (across(a, b) || across(b, a)))
    }

    /// Crossings that two boxes saw both are one.
    fn join(&self, hits: &mut Vec<CurveHit>) {
        let mut kept: Vec<CurveHit> = Vec::with_capacity(hits.len());
        for hit in hits.drain(..) {
            let is_same = |other: &CurveHit| {
                let natures = [other.nature, hit.nature];
                let touches = natures.contains(&Nature::Tangential);
                let runs = natures.contains(&Nature::Overlap);
                self.is_beside_on_curve(other.w_range, hit.w_range)
                    && self.is_beside(other, &hit)
                    && (touches
                        || (!runs && norm(sub(other.point, hit.point)) <= 4.0 * self.tolerance))
            };
            // In the order of w: the last ones, and of a closed curve the first.
            let (count, near) = (kept.len(), 64);
            let candidate = |(k, other): (usize, &mut CurveHit)| {
                ((k < near || k + near >= count) && is_same(other)).then_some(k)
            };
            match kept.iter_mut().enumerate().find_map(candidate).map(|k| &mut kept[k]) {
                Some(other) if hit.nature == Nature::Overlap => *other = hit,
                Some(other) if other.nature == Nature::Overlap => {}
                Some(other) => {
                    if hit.distance < other.distance {
                        (other.u, other.v, other.w) = (hit.u, hit.v, hit.w);
                        (other.point, other.distance) = (hit.point, hit.distance);
                    }
                }
                None => kept.push(hit),
            }
        }
        *hits = kept;
        let (first, last) = self.curve.curve().domain();
        for hit in hits {
            hit.w_range = hit.w_range.map(|x| x.clamp(first, last));
            let (u, v) = match self.target {
                Target::Curve(shape) => (shape.curve().domain(), (0.0, 0.0)),
                Target::Surface(shape) => {
                    let [u0, u1, v0, v1] = shape.surface().domain();
                    ((u0, u1), (v0, v1))
                }
            };
            hit.u_range = hit.u_range.map(|x| x.clamp(u.0, u.1));
            hit.v_range = hit.v_range.map(|x| x.clamp(v.0, v.1));
        }
    }
}

/// The least box that holds all.
fn hull(group: &[Found]) -> ([f64; 3], [f64; 3]) {
    let (mut low, mut high) = (group[0].low, group[0].high);
    for item in group {
        for k in 0..3 {
            low[k] = low[k].min(item.low[k]);
            high[k] = high[k].max(item.high[k]);
        }
    }
    (low, high)
}

fn overlaps(a: [f64; 2], b: [f64; 2]) -> bool {
    a[0] <= b[1] && b[0] <= a[1]
}

/// u0, u1, v0, v1, w0, w1 of a box; a curve's u is the second parameter of a body.
fn boxed(item: &Found, of_curves: bool) -> [f64; 6] {
    let (low, high) = (item.low, item.high);
    let [u, v] = if of_curves { [1, 0] } else { [0, 1] };
    [low[u], high[u], low[v], high[v], low[2], high[2]]
}

/// Boxes that touch, directly or through others.
fn groups(mut items: Vec<Found>) -> Vec<Vec<Found>> {
    items.sort_by(|a, b| a.low[2].total_cmp(&b.low[2]));
    let mut parent: Vec<usize> = (0..items.len()).collect();
    fn root(parent: &mut [usize], mut k: usize) -> usize {
        while parent[k] != k {
            parent[k] = parent[parent[k]];
            k = parent[k];
        }
        k
    }
    let touch =
        |a: &Found, b: &Found| (0..3).all(|k| a.low[k] <= b.high[k] && b.low[k] <= a.high[k]);
    // Boxes are cut by halves: those that may touch the current one begin at most at its end.
    let widest = items.iter().fold(0.0f64, |m, f| m.max(f.high[2] - f.low[2]));
    for i in 0..items.len() {
        for j in i + 1..items.len() {
            if items[j].low[2] > items[i].low[2] + widest {
                break;
            }
            if touch(&items[i], &items[j]) {
                let (a, b) = (root(&mut parent, i), root(&mut parent, j));
                parent[b.max(a)] = a.min(b);
            }
        }
    }
    let mut out: Vec<Vec<Found>> = Vec::new();
    let mut number = vec![usize::MAX; items.len()];
    for (k, item) in items.iter().enumerate() {
        let r = root(&mut parent, k);
        if number[r] == usize::MAX {
            number[r] = out.len();
            out.push(Vec::new());
        }
        out[number[r]].push(*item);
    }
    out
}
