//! All stationary points of the distance: inside, along borders, at corners.
//!
//! ```text
//!   strata   the inside, the borders (but smooth seams and collapsed edges), the corners
//!   box      a slope keeps its sign?                  dropped
//!            convex?                                  cut to the surroundings of its only foot, or dropped
//!            else                                     halved down to [`RESOLUTION`]
//!   small boxes that touch                            a cluster; Newton's iteration in it finds the member
//! ```
//!
//! Boxes are halved level by level, so that the budget is shared fairly; what it leaves is clustered as it is. A wide
//! cluster whose places all have the same distance is a continuum; any other wide cluster is undecided, and the places
//! found in it are told all the same. Collapsed edges count when the distance rises, or falls, on all sides of them.
//!
//! With bounds of the second derivatives every stationary point lies in the intervals of a member or in an undecided
//! box. That it is the only one there is proven where the squared distance is convex (minima near the shape); elsewhere
//! it is what Newton's iteration finds: bounds of third derivatives would be needed for more.
//! Limits: two stationary points nearer than a few [`RESOLUTION`] can come out as one; that there is none within
//! [`NEAR_COLLAPSED`] boxes of a collapsed edge rests on the iteration from there.

use super::DEFAULT_BUDGET;
use super::cell::{Probe, View, halves};
use super::cluster::{Cluster, clusters, hull};
use super::foot::{Place, is_bad};
use super::nature::{LEAST_COSINE, LEAST_CURVATURE, verdict};
use super::preimage::{POLLED, kind};
use super::search::budget;
use super::source::Shape;
use crate::bounds::{Vector, dot, norm, sub};
use crate::closest::flag;
use crate::error::Error;
use crate::extrema::ExtremaOptions;
use crate::index::Poll;
use crate::refine::Method;
use crate::set::{FootSet, Member};

/// Boxes of this share of the domain are not halved any more.
pub const RESOLUTION: f64 = 1.0 / 4096.0;

/// Clusters in which nothing is found are halved on to this share of the resolution, so often.
const RESOLUTION_STEP: f64 = 1.0 / 16.0;
const ROUNDS: usize = 3;

/// A cluster wider than this share of the domain is no single place.
const WIDE: f64 = 1.0 / 64.0;

/// What reaches no farther from a collapsed edge than so many boxes, and holds no stationary place, is taken for the edge.
const NEAR_COLLAPSED: f64 = 32.0;

/// Places of a cluster from which the iteration starts.
const STARTS: usize = 24;

/// Samples along a collapsed edge or a seam.
const EDGE_SAMPLES: usize = 24;

/// One request.
struct Request<'a> {
    probe: &'a Probe<'a>,
    options: &'a ExtremaOptions,
    range: [f64; 4],
    boxes: u64,
    budget: u64,
    members: Vec<Member>,
    undecided: Vec<[f64; 4]>,
}

/// All stationary points, nearest first.
pub fn extrema(
    shape: &Shape,
    query: Vector,
    options: &ExtremaOptions,
    poll: Poll,
) -> Result<FootSet, Error> {
    if is_bad(query) {
        return Ok(FootSet::default());
    }
    let probe = Probe::curved(shape, query);
    let range = shape.range(options.domain);
    let mut request = Request {
        probe: &probe,
        options,
        range,
        boxes: 0,
        budget: budget(options.budget, probe.trusted, DEFAULT_BUDGET),
        members: Vec::new(),
        undecided: Vec::new(),
    };
    let dims = shape.source.dims;
    let borders: Vec<usize> = (0..2 * dims).filter(|&side| request.is_border(side)).collect();
    let (points, plain): (Vec<usize>, Vec<usize>) =
        borders.into_iter().partition(|&side| request.is_collapsed(side));
    points.into_iter().for_each(|side| request.collapsed(side));
    if dims == 2 {
        request.corners(&plain);
    }
    for side in plain {
        let mut face = range;
        let k = side / 2;
        (face[2 * k], face[2 * k + 1]) = (range[side], range[side]);
        if dims == 1 {
            request.corner([range[side], 0.0]);
        } else {
            request.stratum(face, [k == 1, k == 0], poll)?;
        }
    }
    request.stratum(range, [true, dims == 2], poll)?;
    Ok(request.finish())
}

impl Request<'_> {
    /// Whether a side of the range is a border: not a smooth seam.
    fn is_border(&self, side: usize) -> bool {
        let (source, survey) = (&self.probe.shape.source, &self.probe.shape.survey);
        let k = side / 2;
        let [first, last] = [source.domain[2 * k], source.domain[2 * k + 1]];
        let whole = self.range[2 * k] == first && self.range[2 * k + 1] == last;
        let smooth = || {
            (0..EDGE_SAMPLES).all(|i| {
                let tangent = |x: f64| {
                    let (values, _) = self.probe.values(self.on_edge(k, x, i), 1)?;
                    Some(values[1 + k])
                };
                match (tangent(first), tangent(last)) {
                    (Some(a), Some(b)) => norm(sub(a, b)) <= 1e-5 * (norm(a) + norm(b)),
                    _ => false,
                }
            })
        };
        !(survey.closed[k] && whole && smooth())
    }

    /// Sample i on the line where parameter k is `x`.
    fn on_edge(&self, k: usize, x: f64, i: usize) -> [f64; 2] {
        let other = 1 - k;
        let [low, high] = [self.range[2 * other], self.range[2 * other + 1]];
        let share = i as f64 / (EDGE_SAMPLES - 1) as f64;
        let mut at = [x; 2];
        at[other] = (low + share * (high - low)).clamp(low, high);
        at
    }

    fn is_collapsed(&self, side: usize) -> bool {
        let (source, survey) = (&self.probe.shape.source, &self.probe.shape.survey);
        survey.collapsed[side] && self.range[side] == source.domain[side]
    }

    /// A collapsed edge: one point, stationary when the distance rises, falls or stands still on all sides.
    fn collapsed(&mut self, side: usize) {
        let k = side / 2;
        let inward = if side.is_multiple_of(2) { 1.0 } else { -1.0 };
        let mut signs = Vec::new();
        for i in 0..EDGE_SAMPLES {
            let Some(jet) = self.probe.jet_at(self.on_edge(k, self.range[side], i)) else { return };
            let one = jet.along(k);
            let cosine = inward * one.gradient() / (norm(one.s) * norm(one.d) + f64::MIN_POSITIVE);
            let curvature = one.hessian() / (dot(one.s, one.s) + f64::MIN_POSITIVE);
            let flat = curvature.abs() <= LEAST_CURVATURE;
            signs.push(if cosine.abs() > LEAST_COSINE {
                cosine
            } else if flat {
                0.0
            } else {
                curvature
            });
        }
        let (up, down) = (signs.iter().any(|&x| x > 0.0), signs.iter().any(|&x| x < 0.0));
        let Some(place) = self.probe.place(self.on_edge(k, self.range[side], 0)) else { return };
        if up && down {
            return;
        }
        let mut area = self.range;
        (area[2 * k], area[2 * k + 1]) = (self.range[side], self.range[side]);
        let mut member = self.member_at(place, area, [k == 1, k == 0]);
        member.nature = verdict(&signs);
        self.members.push(member);
    }

    fn corners(&mut self, borders: &[usize]) {
        for &a in borders.iter().filter(|&&side| side < 2) {
            for &b in borders.iter().filter(|&&side| side >= 2) {
                self.corner([self.range[a], self.range[b]]);
            }
        }
    }

    fn corner(&mut self, at: [f64; 2]) {
        if let Some(place) = self.probe.place(at) {
            let member = self.member_at(place, [at[0], at[0], at[1], at[1]], [false; 2]);
            self.members.push(member);
        }
    }

    /// The stationary points of one stratum, over its free parameters. Clusters in which the iteration finds nothing are
    /// halved on: mostly they hold nothing.
    fn stratum(&mut self, range: [f64; 4], free: [bool; 2], poll: Poll) -> Result<(), Error> {
        let (mut boxes, mut resolution) = (vec![range], RESOLUTION);
        for _ in 0..ROUNDS {
            let (small, complete) = self.subdivide(boxes, free, resolution, poll)?;
            boxes = Vec::new();
            for cluster in clusters(&small) {
                if !self.resolve(&small, &cluster, free) {
                    boxes.extend(cluster.members.iter().map(|&i| small[i]));
                }
            }
            if !complete || boxes.is_empty() {
                break;
            }
            resolution *= RESOLUTION_STEP;
        }
        self.undecided.append(&mut boxes);
        Ok(())
    }

    /// Halves down to the resolution, level by level. False when the budget has cut it short: then large boxes are left.
    fn subdivide(
        &mut self,
        mut boxes: Vec<[f64; 4]>,
        free: [bool; 2],
        resolution: f64,
        poll: Poll,
    ) -> Result<(Vec<[f64; 4]>, bool), Error> {
        let mut small = Vec::new();
        while !boxes.is_empty() {
            if self.boxes + boxes.len() as u64 > self.budget {
                small.append(&mut boxes);
                return Ok((small, false));
            }
            let mut next = Vec::new();
            for area in boxes {
                if self.boxes.is_multiple_of(POLLED) && poll() {
                    return Err(Error::Cancelled);
                }
                self.examine(area, free, resolution, &mut small, &mut next);
            }
            boxes = next;
        }
        Ok((small, true))
    }

    fn examine(
        &mut self,
        range: [f64; 4],
        free: [bool; 2],
        resolution: f64,
        small: &mut Vec<[f64; 4]>,
        next: &mut Vec<[f64; 4]>,
    ) {
        self.boxes += 1;
        let Some(view) = View::new(self.probe, range) else {
            match self.probe.coarse_halves(range) {
                Some(parts) => next.extend(parts),
                None => self.undecided.push(range),
            }
            return;
        };
        if is_sloped(&view, free) {
            return;
        }
        if let Some(curvature) = view.convexity()
            && let Some(outcome) = self.only_foot(&view, range, free, curvature)
        {
            small.extend(outcome);
            return;
        }
        let widths = [0, 1].map(|k| {
            let width = self.probe.shape.source.width(k);
            if free[k] && width > 0.0 { (range[2 * k + 1] - range[2 * k]) / width } else { 0.0 }
        });
        let wanted = view.blurring(free);
        let k = if widths[wanted] > resolution { wanted } else { 1 - wanted };
        match if widths[k] > resolution { halves(range, k) } else { None } {
            Some(parts) => next.extend(parts),
            None => small.push(range),
        }
    }

    /// On a box where f is convex: what holds its only foot, or nothing; `None` when this cannot be told yet.
    fn only_foot(
        &self,
        view: &View,
        range: [f64; 4],
        free: [bool; 2],
        curvature: f64,
    ) -> Option<Option<[f64; 4]>> {
        let place = self.probe.refined(view.centre, range, Method::Auto, None)?;
        let there = View::new(self.probe, [place.at[0], place.at[0], place.at[1], place.at[1]])?;
        let mut squares = 0.0;
        for k in (0..2).filter(|&k| free[k] && view.half[k] > 0.0) {
            let (slope, error) = there.slope(k)?;
            let held = (place.at[k] == range[2 * k] && slope >= error)
                || (place.at[k] == range[2 * k + 1] && -slope >= error);
            squares += if held { 0.0 } else { (slope.abs() + error) * (slope.abs() + error) };
        }
        let radius = squares.sqrt() / curvature * (1.0 + 32.0 * f64::EPSILON);
        let mut less = range;
        for k in (0..2).filter(|&k| free[k]) {
            less[2 * k] = less[2 * k].max((place.at[k] - radius).next_down());
            less[2 * k + 1] = less[2 * k + 1].min((place.at[k] + radius).next_up());
        }
        if is_sloped(&View::new(self.probe, less)?, free) {
            return Some(None);
        }
        let is_tight = (0..2).all(|k| {
            less[2 * k + 1] - less[2 * k] <= RESOLUTION * self.probe.shape.source.width(k)
        });
        is_tight.then_some(Some(less))
    }

    /// Takes what a cluster of small boxes holds; false when the iteration finds nothing in it.
    fn resolve(&mut self, small: &[[f64; 4]], cluster: &Cluster, free: [bool; 2]) -> bool {
        let places = self.places(small, cluster, free);
        if let Some(width) = self.at_collapsed(cluster.hull) {
            // The edge itself has been judged as a whole; near it first derivatives vanish, and no bound tells more.
            let beside = places.iter().any(|place| !self.is_on_collapsed(*place));
            if beside || width > NEAR_COLLAPSED * RESOLUTION {
                self.undecided.push(cluster.hull);
                self.tell(places, free);
            }
            return true;
        }
        let Some(&first) = places.first() else { return false };
        let widths = [0, 1].map(|k| cluster.hull[2 * k + 1] - cluster.hull[2 * k]);
        let wide = [0, 1].map(|k| free[k] && widths[k] > WIDE * self.probe.shape.source.width(k));
        let even = places.iter().all(|place| self.is_even(place.distance, first.distance));
        if wide == [false; 2] || (even && self.is_continuum(&places, wide)) {
            let member = self.member_at(first, cluster.hull, wide);
            self.members.push(member);
            return true;
        }
        self.undecided.push(cluster.hull);
        self.tell(places, free);
        true
    }

    /// Members from places of an undecided cluster: those at one distance that spread far are a continuum.
    fn tell(&mut self, mut places: Vec<Place>, free: [bool; 2]) {
        places.retain(|place| !self.is_on_collapsed(*place));
        while let Some(&first) = places.first() {
            let (group, rest): (Vec<Place>, Vec<Place>) =
                places.into_iter().partition(|place| self.is_even(place.distance, first.distance));
            places = rest;
            let point = |at: [f64; 2]| [at[0], at[0], at[1], at[1]];
            let area =
                group.iter().fold(point(first.at), |area, place| hull(area, point(place.at)));
            let wide = [0, 1].map(|k| {
                let width = area[2 * k + 1] - area[2 * k];
                free[k] && width > WIDE * self.probe.shape.source.width(k)
            });
            if wide != [false; 2] && self.is_continuum(&group, wide) {
                let member = self.member_at(first, area, wide);
                self.members.push(member);
                continue;
            }
            for place in group {
                if !self.members.iter().any(|member| self.is_same(member, place)) {
                    let member = self.member_at(place, point(place.at), [false; 2]);
                    self.members.push(member);
                }
            }
        }
    }

    /// Places in a cluster to which the iteration leads, from boxes spread over it.
    fn places(&self, small: &[[f64; 4]], cluster: &Cluster, free: [bool; 2]) -> Vec<Place> {
        let count = cluster.members.len();
        let step = count.div_ceil(STARTS).max(1);
        let mut found: Vec<Place> = Vec::new();
        // The middle of the list is the middle of the cluster.
        let order = (0..count).step_by(step).map(|i| (i + count / 2) % count);
        for i in order {
            let area = small[cluster.members[i]];
            let start = [0, 1].map(|k| 0.5 * area[2 * k] + 0.5 * area[2 * k + 1]);
            found.extend(self.probe.stationary(start, cluster.hull, free));
        }
        found
    }

    fn is_even(&self, a: f64, b: f64) -> bool {
        let slack = self.probe.shape.accuracy(self.options.accuracy) + 1e-12 * a.max(b);
        (a - b).abs() <= slack
    }

    /// Whether places spread over the wide parameters of a cluster, instead of meeting in a few points.
    fn is_continuum(&self, places: &[Place], wide: [bool; 2]) -> bool {
        (0..2).filter(|&k| wide[k]).all(|k| {
            let mut values: Vec<f64> = places.iter().map(|place| place.at[k]).collect();
            values.sort_by(f64::total_cmp);
            values.dedup_by(|a, b| (*a - *b).abs() <= 1e-6 * self.probe.shape.source.width(k));
            values.len() > STARTS / 4
        })
    }

    fn is_on_collapsed(&self, place: Place) -> bool {
        self.probe.record(place, self.range, false).flags & flag::COLLAPSED != 0
    }

    /// How far a cluster that touches a collapsed edge reaches away from it, as a share of the domain.
    fn at_collapsed(&self, hull: [f64; 4]) -> Option<f64> {
        let touches = |side: &usize| self.is_collapsed(*side) && hull[*side] == self.range[*side];
        let k = (0..2 * self.probe.shape.source.dims).find(touches)? / 2;
        Some((hull[2 * k + 1] - hull[2 * k]) / self.probe.shape.source.width(k))
    }

    fn member_at(&self, place: Place, area: [f64; 4], varies: [bool; 2]) -> Member {
        let mut foot = self.probe.record(place, self.range, false);
        if varies != [false; 2] && foot.flags & flag::COLLAPSED == 0 {
            foot.flags |= flag::CONTINUUM | flag::TIE;
        }
        Member {
            foot,
            u: [area[0].min(place.at[0]), area[1].max(place.at[0])],
            v: [area[2].min(place.at[1]), area[3].max(place.at[1])],
            kind: kind(varies),
            nature: self.probe.nature(place, self.range),
        }
    }

    /// Whether a member and a place are one: the same point, and parameters as near as the resolution.
    fn is_same(&self, member: &Member, place: Place) -> bool {
        let (source, survey) = (&self.probe.shape.source, &self.probe.shape.survey);
        let at = [member.foot.u, member.foot.v];
        let near = (0..source.dims).all(|k| {
            let (width, gap) = (source.width(k), (at[k] - place.at[k]).abs());
            let around = if survey.closed[k] { (width - gap).abs() } else { gap };
            gap.min(around) <= 8.0 * RESOLUTION * width
        });
        near && norm(sub(member.foot.point, place.point))
            <= 1e-6 * survey.diagonal + 4.0 * self.probe.shape.rounding(place.point)
    }

    fn finish(self) -> FootSet {
        let proven = self.probe.trusted && !self.probe.has_failed();
        let mut members: Vec<Member> = Vec::new();
        // The last found is the inside, which knows most; members on both sides of a seam keep the canonical one.
        for member in self.members.iter().rev() {
            let foot = member.foot;
            let place = Place { at: [foot.u, foot.v], point: foot.point, distance: foot.distance };
            match members.iter_mut().find(|known| self.is_same(known, place)) {
                Some(known) if self.is_across(known, member) && before(member, known) => {
                    *known = *member
                }
                Some(known) if !self.is_across(known, member) => join(known, member),
                Some(_) => {}
                None => members.push(*member),
            }
        }
        for member in &mut members {
            member.foot.iterations = self.probe.taken();
            member.foot.flags |= if proven { 0 } else { flag::NOT_PROVEN };
        }
        let undecided = if self.probe.trusted {
            clusters(&self.undecided).into_iter().map(|cluster| cluster.hull).collect()
        } else {
            vec![self.range]
        };
        self.options.finish(members, undecided)
    }

    /// Whether two members that are the same point lie on the two sides of a seam.
    fn is_across(&self, a: &Member, b: &Member) -> bool {
        let gaps = [(a.foot.u - b.foot.u).abs(), (a.foot.v - b.foot.v).abs()];
        (0..self.probe.shape.source.dims).any(|k| gaps[k] > 0.5 * self.probe.shape.source.width(k))
    }
}

/// The canonical one of two members that are the same point comes first: by u, then by v.
fn before(a: &Member, b: &Member) -> bool {
    (a.foot.u, a.foot.v) < (b.foot.u, b.foot.v)
}

/// Widens a member to hold the intervals of another.
fn join(known: &mut Member, other: &Member) {
    for (mine, its) in [(&mut known.u, other.u), (&mut known.v, other.v)] {
        *mine = [mine[0].min(its[0]), mine[1].max(its[1])];
    }
}

/// Whether a slope of a free parameter keeps its sign on a box.
fn is_sloped(view: &View, free: [bool; 2]) -> bool {
    (0..2).any(|k| free[k] && view.slope(k).is_some_and(|(slope, vary)| slope.abs() > vary))
}
