//! The nearest point of a face.

use super::border::{Nearest, box_distance};
use super::{Face, FaceWorkspace, NOT_PROVEN, Place, Standing};
use crate::bounds::{Vector, norm, sub};
use crate::closest::{FootPoint, QueryOptions, Scope, flag, is_bad};
use crate::extrema::ExtremaOptions;

/// Flags that tell of the place in the surface's domain.
const PLACE: u32 = flag::EDGE | flag::CORNER | flag::SEAM | flag::COLLAPSED;

/// Two feet nearer to each other than this many times the root of distance times accuracy are one (as `flag::TIE` says).
const SAME: f64 = 8.0;

/// What the search over the borders has found.
struct OnBorder {
    border: usize,
    found: Nearest,
    /// Nothing on any border is nearer.
    lower_bound: f64,
    flags: u32,
    iterations: u32,
}

impl Face {
    /// The nearest point of the face to `query`, with proof, and where on the face it lies (within `options.tolerance` of an edge, as
    /// [`Face::classify`]).
    ///
    /// `hint` is a parameter pair near the foot of the surface; of the options accuracy, tolerance, method and budget count. Cost: that of
    /// the surface where its foot is inside; else that of the edges and, when they do not decide, of all stationary points.
    pub fn closest(
        &self,
        query: Vector,
        hint: Option<[f64; 2]>,
        options: &QueryOptions,
        workspace: &mut FaceWorkspace,
    ) -> (FootPoint, Place) {
        let nowhere = Place::off(Standing::Unknown);
        if is_bad(query) {
            return (FootPoint::bad_query(), nowhere);
        }
        let asked = QueryOptions { domain: None, scope: Scope::Global, ..*options };
        let whole = self.ground.closest(query, hint, &asked, &mut workspace.shape);
        if whole.distance.is_nan() {
            return (whole, nowhere);
        }
        let (mut foot, mut place) = self.nearest(query, &whole, options, workspace);
        if !self.ground.is_proven() {
            // Estimates are no bounds.
            (foot.lower_bound, foot.flags) = (0.0, foot.flags | flag::NOT_PROVEN);
            place.flags = NOT_PROVEN;
        }
        (foot, place)
    }

    /// The answer when the foot on the whole surface is known.
    fn nearest(
        &self,
        query: Vector,
        whole: &FootPoint,
        options: &QueryOptions,
        workspace: &mut FaceWorkspace,
    ) -> (FootPoint, Place) {
        if let Some(at) = self.held(whole, workspace) {
            let foot = self.moved(query, whole, at);
            let place = self.classify(at, options, workspace);
            let place = if place.standing == Standing::Outside {
                // The other end of a closed direction holds it, this one only by rounding.
                Place::off(Standing::Inside)
            } else {
                place
            };
            return (foot, place);
        }
        let Some(best) = self.on_borders(query, options, workspace) else {
            return (FootPoint::unreached(), Place::off(Standing::Unknown));
        };
        self.settled(query, whole, &best, options, workspace)
    }

    /// A foot at other parameters of the same point.
    fn moved(&self, query: Vector, foot: &FootPoint, at: [f64; 2]) -> FootPoint {
        if at == [foot.u, foot.v] {
            return *foot;
        }
        let point = self.support.evaluate(at);
        let distance = norm(sub(query, point));
        let lower_bound = foot.lower_bound.min(distance);
        FootPoint { u: at[0], v: at[1], point, distance, lower_bound, ..*foot }
    }

    fn on_borders(
        &self,
        query: Vector,
        options: &QueryOptions,
        workspace: &mut FaceWorkspace,
    ) -> Option<OnBorder> {
        let keyed = self.borders.iter().enumerate();
        let mut order: Vec<(f64, usize)> =
            keyed.map(|(k, border)| (box_distance(&border.bounds(), query), k)).collect();
        order.sort_by(|a, b| a.0.total_cmp(&b.0));
        let accuracy = self.accuracy(options);
        let mut best: Option<OnBorder> = None;
        let (mut lower_bound, mut iterations) = (f64::INFINITY, 0u32);
        for (key, k) in order {
            let limit = best.as_ref().map_or(f64::INFINITY, |best| best.found.distance);
            if key > limit + accuracy {
                lower_bound = lower_bound.min(key);
                break;
            }
            let Some(found) = self.borders[k].nearest(self, query, limit, options, workspace)
            else {
                lower_bound = lower_bound.min(key);
                continue;
            };
            iterations = iterations.saturating_add(found.iterations);
            lower_bound = lower_bound.min(found.lower_bound);
            let is_better = found.distance < limit;
            let tied = (found.distance - limit).abs() <= accuracy
                && best
                    .as_ref()
                    .is_some_and(|best| self.are_apart(query, best, k, &found, accuracy));
            let mut flags = if tied { flag::TIE } else { 0 };
            if !is_better {
                if let Some(best) = &mut best {
                    best.flags |= flags | found.flags & flag::BUDGET;
                }
                continue;
            }
            flags |= found.flags;
            best = Some(OnBorder { border: k, found, lower_bound, flags, iterations });
        }
        best.map(|best| OnBorder { lower_bound, iterations, ..best })
    }

    /// Whether two feet on borders are more than one place.
    fn are_apart(
        &self,
        query: Vector,
        best: &OnBorder,
        border: usize,
        found: &Nearest,
        accuracy: f64,
    ) -> bool {
        let domain = self.support.domain();
        let point = |k: usize, t: f64| self.support.evaluate(self.borders[k].at(t, domain));
        let (a, b) = (point(best.border, best.found.t), point(border, found.t));
        let distance = norm(sub(query, a));
        norm(sub(a, b)) > SAME * (distance * accuracy).sqrt().max(accuracy)
    }

    /// The answer when the foot of the surface is outside.
    fn settled(
        &self,
        query: Vector,
        whole: &FootPoint,
        best: &OnBorder,
        options: &QueryOptions,
        workspace: &mut FaceWorkspace,
    ) -> (FootPoint, Place) {
        let domain = self.support.domain();
        let border = &self.borders[best.border];
        let mut foot = self.record(query, border.at(best.found.t, domain), domain);
        foot.flags |= best.flags | whole.flags & flag::HINT_USED;
        foot.iterations = whole.iterations.saturating_add(best.iterations);
        let mut place = border.place(best.found.t);
        let allowed = self.accuracy(options) + 2.0 * border.error() + best.found.allowed;
        let mut lower_bound = best.lower_bound;
        if whole.lower_bound < foot.distance - allowed {
            let inside = self.stationary(query, foot.distance, options, workspace);
            lower_bound = lower_bound.min(inside.lower_bound);
            if !self.ground.has_all_extrema() {
                lower_bound = 0.0;
            }
            if let Some(nearer) = inside.foot.filter(|inside| inside.distance < foot.distance) {
                let (flags, iterations) = (foot.flags & flag::HINT_USED, foot.iterations);
                foot = self.record(query, [nearer.u, nearer.v], domain);
                foot.flags |= flags | nearer.flags & (flag::CONTINUUM | flag::TIE | flag::CREASE);
                foot.iterations = iterations.saturating_add(nearer.iterations);
                place = self.classify([foot.u, foot.v], options, workspace);
                if place.standing == Standing::Outside {
                    place = Place::off(Standing::Inside);
                }
            }
            if inside.exhausted {
                foot.flags |= flag::BUDGET;
            }
        }
        foot.lower_bound = lower_bound.max(whole.lower_bound).clamp(0.0, foot.distance);
        let gap = foot.distance - foot.lower_bound;
        if gap.is_nan() || gap > allowed {
            foot.flags |= flag::NOT_PROVEN;
        }
        (foot, place)
    }

    /// The record of a place, without its certificate.
    fn record(&self, query: Vector, [u, v]: [f64; 2], domain: [f64; 4]) -> FootPoint {
        let point = self.support.evaluate([u, v]);
        let on = [u == domain[0], u == domain[1], v == domain[2], v == domain[3]];
        let mut flags = 0;
        let seam = self.closed[0] && (on[0] || on[1]) || self.closed[1] && (on[2] || on[3]);
        let collapsed = (0..4).any(|k| on[k] && self.collapsed[k]);
        let corner = (on[0] || on[1]) && (on[2] || on[3]);
        for (is, bit) in [
            (on.contains(&true), flag::EDGE),
            (corner, flag::CORNER),
            (seam, flag::SEAM),
            (collapsed, flag::COLLAPSED),
        ] {
            flags |= if is { bit } else { 0 };
        }
        debug_assert_eq!(flags & !PLACE, 0);
        let distance = norm(sub(query, point));
        FootPoint { u, v, point, distance, lower_bound: 0.0, flags, iterations: 0 }
    }

    /// The nearest stationary point of the surface inside the face that is nearer than `radius`.
    fn stationary(
        &self,
        query: Vector,
        radius: f64,
        options: &QueryOptions,
        workspace: &mut FaceWorkspace,
    ) -> Stationary {
        let accuracy = self.accuracy(options);
        let range = self.range();
        let asked = ExtremaOptions {
            accuracy,
            radius: radius + accuracy,
            domain: range,
            budget: options.budget,
            ..ExtremaOptions::default()
        };
        let mut found = Stationary { foot: None, lower_bound: f64::INFINITY, exhausted: false };
        let Ok(set) = self.ground.extrema(query, &asked, &mut || false) else {
            return Stationary { lower_bound: 0.0, ..found };
        };
        for member in &set.members {
            // Not proven is what lies at the end of a budget; what is nearer counts all the same.
            let Some(at) = self.held(&member.foot, workspace) else { continue };
            let foot = self.moved(query, &member.foot, at);
            found.lower_bound = found.lower_bound.min(foot.distance - accuracy);
            found.offer(foot);
        }
        for area in &set.undecided {
            let middle = [0.5 * (area[0] + area[1]), 0.5 * (area[2] + area[3])];
            if !self.region.may_cross(area) && !self.holds(middle, workspace) {
                continue;
            }
            found.exhausted = true;
            let restricted = QueryOptions { domain: Some(*area), ..*options };
            if self.ground.check_domain(*area).is_err() {
                found.lower_bound = 0.0;
                continue;
            }
            let foot = self.ground.closest(query, None, &restricted, &mut workspace.shape);
            found.lower_bound = found.lower_bound.min(foot.lower_bound);
            if let Some(at) = self.held(&foot, workspace) {
                let foot = self.moved(query, &foot, at);
                found.offer(foot);
            }
        }
        found
    }

    /// The part of the domain around the region, when it is not all of it.
    pub(super) fn range(&self) -> Option<[f64; 4]> {
        let (d, r) = (self.support.domain(), self.region.bounds());
        let cut = [r[0].max(d[0]), r[1].min(d[1]), r[2].max(d[2]), r[3].min(d[3])];
        (cut != d && self.ground.check_domain(cut).is_ok()).then_some(cut)
    }
}

/// What is known of the inside of a face.
struct Stationary {
    foot: Option<FootPoint>,
    /// No stationary point inside is nearer.
    lower_bound: f64,
    exhausted: bool,
}

impl Stationary {
    fn offer(&mut self, foot: FootPoint) {
        if self.foot.is_none_or(|best| foot.distance < best.distance) {
            self.foot = Some(foot);
        }
    }
}
