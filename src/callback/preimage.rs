//! All parameters whose point lies within a tolerance of the query.
//!
//! ```text
//!   box: bound beyond the tolerance?         dropped
//!        all of it within, or small?         kept
//!        convex there?                       cut to what can lie within, around its foot
//!        else                                halved
//!   kept boxes that touch                    a member: their hull, and the best foot in it
//! ```
//!
//! With f = |S - q|^2 / 2 convex of curvature l on a box, a foot x0 in it with slope g (but for slopes that press
//! against a side) and d0 its distance: `|x - x0| <= (|g| + sqrt(g^2 + l max(0, tol^2 - d0^2))) / l` where f is within.
//!
//! A cluster without a place within the tolerance is searched once more with smaller boxes, and is undecided after that.
//! Limit: an arc takes as many boxes as it has lengths of the tolerance, or of the square root of the tolerance where
//! only second derivatives blur it.

use super::DEFAULT_BUDGET_PREIMAGE;
use super::cell::{Probe, View, halves, meet};
use super::cluster::{Cluster, clusters};
use super::foot::{Place, is_bad};
use super::search::budget;
use super::source::Shape;
use crate::bounds::Vector;
use crate::closest::{QueryOptions, flag};
use crate::error::Error;
use crate::index::Poll;
use crate::set::{FootSet, Kind, Member};

/// Boxes whose points lie within this share of the tolerance of each other are kept whole; first, and for clusters
/// where nothing was found.
const SHARES: [f64; 2] = [0.5, 1.0 / 32.0];

/// Boxes between two questions whether to stop.
pub const POLLED: u64 = 256;

/// A parameter varies in a member that is wider than the one share of the domain although that carries the point only
/// the other share of the tolerance.
const WIDE: f64 = 0.01;
const CARRIED: f64 = 0.25;

/// One request.
struct Request<'a> {
    probe: &'a Probe<'a>,
    options: &'a QueryOptions,
    range: [f64; 4],
    tolerance: f64,
    boxes: u64,
    budget: u64,
    undecided: Vec<[f64; 4]>,
}

/// All parameters within the tolerance, ordered by u, then v.
pub fn preimage(
    shape: &Shape,
    query: Vector,
    tolerance: f64,
    options: &QueryOptions,
    poll: Poll,
) -> Result<FootSet, Error> {
    if is_bad(query) {
        return Ok(FootSet::default());
    }
    let probe = Probe::new(shape, query);
    let mut request = Request {
        probe: &probe,
        options,
        range: shape.range(options.domain),
        tolerance: shape.tolerance(tolerance),
        boxes: 0,
        budget: budget(options.budget, probe.trusted, DEFAULT_BUDGET_PREIMAGE),
        undecided: Vec::new(),
    };
    let mut members = Vec::new();
    let mut boxes = vec![request.range];
    for (round, share) in SHARES.into_iter().enumerate() {
        let kept = request.subdivide(boxes, share, poll)?;
        boxes = Vec::new();
        for cluster in clusters(&kept) {
            match request.member(&kept, &cluster) {
                Some(member) => members.push(member),
                None if round == 0 => boxes.extend(cluster.members.iter().map(|&i| kept[i])),
                None => request.undecided.push(cluster.hull),
            }
        }
    }
    Ok(request.finish(members))
}

impl Request<'_> {
    /// Halves until every box is dropped or kept; what the budget leaves is undecided.
    fn subdivide(
        &mut self,
        mut boxes: Vec<[f64; 4]>,
        share: f64,
        poll: Poll,
    ) -> Result<Vec<[f64; 4]>, Error> {
        let mut kept = Vec::new();
        while !boxes.is_empty() {
            let mut next = Vec::new();
            for range in boxes {
                if self.boxes >= self.budget {
                    self.undecided.push(range);
                    continue;
                }
                if self.boxes.is_multiple_of(POLLED) && poll() {
                    return Err(Error::Cancelled);
                }
                self.examine(range, share, &mut kept, &mut next);
            }
            boxes = next;
        }
        Ok(kept)
    }

    fn examine(
        &mut self,
        range: [f64; 4],
        share: f64,
        kept: &mut Vec<[f64; 4]>,
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
        if view.lower() > self.tolerance {
            return;
        }
        let spread = view.upper() - view.distance - view.error;
        if view.upper() <= self.tolerance || spread <= share * self.tolerance {
            kept.push(range);
            return;
        }
        let Some(less) = self.cut(&view, range) else { return };
        let shrunk = |k: usize| {
            let width = range[2 * k + 1] - range[2 * k];
            width > 0.0 && less[2 * k + 1] - less[2 * k] < 0.25 * width
        };
        if shrunk(0) || shrunk(1) {
            next.push(less);
            return;
        }
        match halves(less, view.longer()) {
            Some(parts) => next.extend(parts),
            None => kept.push(less),
        }
    }

    /// What of a box can lie within the tolerance, where f is convex; `None`: nothing.
    fn cut(&self, view: &View, range: [f64; 4]) -> Option<[f64; 4]> {
        let Some(curvature) = view.convexity() else { return Some(range) };
        let place = self.probe.refined(view.centre, range, self.options.method, None);
        let Some(place) = place else { return Some(range) };
        let at = [place.at[0], place.at[0], place.at[1], place.at[1]];
        let Some(there) = View::new(self.probe, at) else { return Some(range) };
        let mut slopes = 0.0;
        for k in (0..2).filter(|&k| view.half[k] > 0.0) {
            let Some((slope, error)) = there.slope(k) else { return Some(range) };
            let held = (place.at[k] == range[2 * k] && slope >= error)
                || (place.at[k] == range[2 * k + 1] && -slope >= error);
            slopes += if held { 0.0 } else { (slope.abs() + error) * (slope.abs() + error) };
        }
        let least = (there.distance - there.error).max(0.0);
        let room = self.tolerance * self.tolerance - least * least;
        if room < 0.0 && slopes < -curvature * room {
            return None;
        }
        let reach = slopes.sqrt() + (slopes + curvature * room.max(0.0)).sqrt();
        let radius = reach / curvature * (1.0 + 32.0 * f64::EPSILON);
        let mut less = range;
        for k in (0..2).filter(|&k| view.half[k] > 0.0) {
            less[2 * k] = less[2 * k].max((place.at[k] - radius).next_down());
            less[2 * k + 1] = less[2 * k + 1].min((place.at[k] + radius).next_up());
        }
        Some(less)
    }

    /// The member that a cluster is, if a place in it is within the tolerance.
    fn member(&self, kept: &[[f64; 4]], cluster: &Cluster) -> Option<Member> {
        let centre = |range: [f64; 4]| [0, 1].map(|k| 0.5 * range[2 * k] + 0.5 * range[2 * k + 1]);
        let places = cluster.members.iter().filter_map(|&i| self.probe.place(centre(kept[i])));
        let start = places.min_by(|a, b| a.distance.total_cmp(&b.distance))?;
        let place = self.probe.refined(start.at, cluster.hull, self.options.method, None)?;
        if place.distance > self.tolerance {
            return None;
        }
        let hull = cluster.hull;
        let varies = self.varies(place, hull);
        Some(Member {
            foot: self.probe.record(place, self.range, false),
            u: [hull[0], hull[1]],
            v: [hull[2], hull[3]],
            kind: kind(varies),
            nature: self.probe.nature(place, self.range),
        })
    }

    /// Which parameters vary without carrying the point away.
    fn varies(&self, place: Place, hull: [f64; 4]) -> [bool; 2] {
        let source = &self.probe.shape.source;
        let tangents = self.probe.values(place.at, 1).map_or([[0.0; 3]; 2], |(v, _)| [v[1], v[2]]);
        [0, 1].map(|k| {
            let width = hull[2 * k + 1] - hull[2 * k];
            let carried = crate::bounds::norm(tangents[k]) * width;
            k < source.dims && width > WIDE * source.width(k) && carried <= CARRIED * self.tolerance
        })
    }

    /// A place within the tolerance in an undecided cluster that no member has.
    fn found(&self, hull: [f64; 4], members: &[Member]) -> Option<Member> {
        let start = [0, 1].map(|k| 0.5 * hull[2 * k] + 0.5 * hull[2 * k + 1]);
        let place = self.probe.refined(start, hull, self.options.method, None)?;
        let at = place.at;
        let known = members.iter().any(|m| meet(m.u, [at[0], at[0]]) && meet(m.v, [at[1], at[1]]));
        (!known && place.distance <= self.tolerance).then(|| Member {
            foot: self.probe.record(place, self.range, false),
            u: [at[0]; 2],
            v: [at[1]; 2],
            kind: Kind::Point,
            nature: self.probe.nature(place, self.range),
        })
    }

    fn finish(self, mut members: Vec<Member>) -> FootSet {
        let open = clusters(&self.undecided);
        for cluster in &open {
            members.extend(self.found(cluster.hull, &members));
        }
        members.sort_by(|a, b| a.foot.u.total_cmp(&b.foot.u).then(a.foot.v.total_cmp(&b.foot.v)));
        let proven = self.probe.trusted && !self.probe.has_failed();
        let undecided = if self.probe.trusted {
            open.into_iter().map(|cluster| cluster.hull).collect()
        } else {
            vec![self.range]
        };
        for member in &mut members {
            member.foot.iterations = self.probe.taken();
            member.foot.flags |= if proven { 0 } else { flag::NOT_PROVEN };
        }
        FootSet { members, undecided }
    }
}

/// The kind of a member from the parameters that vary in it.
pub fn kind(varies: [bool; 2]) -> Kind {
    match varies {
        [false, false] => Kind::Point,
        [true, false] => Kind::ArcU,
        [false, true] => Kind::ArcV,
        [true, true] => Kind::Region,
    }
}
