//! The result in the caller's frame: chains become branches, what was left open becomes contacts, areas and undecided boxes.

use super::cluster::{Cluster, see};
use super::join::{Stop, distance_to_chord};
use super::search::{Open, OpenPair, Search, Tip};
use super::tangent::{Ridge, is_near, unfollowed};
use super::watch::Watch;
use super::{Branch, Contact, ContactKind, End, Intersection, MarchPoint, Region};
use crate::bounds::{norm, sub};
use crate::closest::{QueryOptions, Workspace};
use crate::index::IndexedSurface;
use crate::surface::Surface;

/// A box of u, v, s, t as a region.
pub fn region(low: [f64; 4], high: [f64; 4]) -> Region {
    Region { range: [low[0], high[0], low[1], high[1], low[2], high[2], low[3], high[3]] }
}

/// The box that is one place.
pub fn at_point(place: &MarchPoint) -> Region {
    let at = [place.uv[0], place.uv[1], place.st[0], place.st[1]];
    region(at, at)
}

/// The result as it grows.
pub struct Maker<'a, 'b> {
    /// A as the caller has it.
    pub a: &'a Surface,
    /// B as the caller has it.
    pub b: &'a Surface,
    /// The search, in its own frame.
    pub search: &'a Search<'b>,
    /// What is known so far.
    pub out: Intersection,
}

impl<'a, 'b> Maker<'a, 'b> {
    /// A place u, v, s, t in the frame of the caller, and the distance of its two surface points.
    fn measured(&self, [u, v, s, t]: [f64; 4]) -> (MarchPoint, f64) {
        let (x, y) = (self.a.evaluate(u, v), self.b.evaluate(s, t));
        let point = std::array::from_fn(|k| x[k] + 0.5 * (y[k] - x[k]));
        (MarchPoint { point, uv: [u, v], st: [s, t] }, norm(sub(x, y)))
    }

    /// A place u, v, s, t in the frame of the caller.
    pub fn point(&self, at: [f64; 4]) -> MarchPoint {
        self.measured(at).0
    }

    /// Distance of its two surface points.
    pub fn gap(&self, point: &MarchPoint) -> f64 {
        let ([u, v], [s, t]) = (point.uv, point.st);
        norm(sub(self.a.evaluate(u, v), self.b.evaluate(s, t)))
    }

    /// Boxes in which the surfaces coincide.
    fn areas(&mut self) {
        let areas = self.search.open.iter().filter(|pair| pair.why == Open::Area);
        self.out.overlaps.extend(areas.map(|pair| region(pair.low, pair.high)));
    }

    /// Lists boxes that were not divided further, as too many to look at, or after a stop.
    pub fn list(&mut self) {
        self.areas();
        let others = self.search.open.iter().filter(|pair| pair.why != Open::Area);
        self.out.undecided.extend(others.map(|pair| region(pair.low, pair.high)));
    }

    /// Lists the boxes of a group that were not reached.
    fn left_in(&mut self, group: &Cluster) {
        let is_in = |pair: &&OpenPair| {
            let inside = |q| group.low[q] <= pair.low[q] && pair.high[q] <= group.high[q];
            pair.why == Open::Left && (0..4).all(inside)
        };
        let left = self.search.open.iter().filter(is_in);
        self.out.undecided.extend(left.map(|pair| region(pair.low, pair.high)));
    }

    /// What is in the groups of boxes that were not divided further.
    pub fn classify(&mut self, groups: &[Cluster], ridges: &[Ridge], watch: &Watch) {
        self.areas();
        let beside = unfollowed(self.search, ridges);
        for (k, group) in groups.iter().enumerate() {
            let [area, curve, flat, left] = group.has;
            let is_followed = !beside.iter().any(|&at| group.holds(at));
            if area && left {
                // Beside a coincidence everything is its rim, but not what was never looked at.
                self.left_in(group);
            }
            if area || (curve && !flat && !left && is_followed) {
                continue;
            }
            // One is a search for a place of least gap.
            let looked_at = !left && !watch.stops(groups.len() - k);
            let seen = if looked_at { see(self.search, group) } else { None };
            match seen {
                Some(seen) if group.size <= 0.05 => {
                    if ridges.iter().any(|ridge| {
                        is_near(
                            seen.place.x,
                            &ridge.places,
                            group.size.max(16.0 * self.search.floor),
                        )
                    }) {
                        continue;
                    }
                    let place = self.point(seen.place.at);
                    let kind = match seen.sign {
                        1 => ContactKind::Touching,
                        -1 => ContactKind::Crossing,
                        _ => ContactKind::Degenerate,
                    };
                    let radius = group.size / self.scale();
                    // At a seam the same point is seen from both sides.
                    let same = |c: &&mut Contact| {
                        norm(sub(c.place.point, place.point)) <= 2.0 * (c.radius + radius)
                    };
                    if let Some(known) = self.out.contacts.iter_mut().find(same) {
                        known.radius = known.radius.max(radius);
                        continue;
                    }
                    let area = region(group.low, group.high);
                    let gap = self.gap(&place);
                    self.out.contacts.push(Contact { place, kind, gap, radius, area });
                }
                _ => self.out.undecided.push(region(group.low, group.high)),
            }
        }
    }

    /// What lengths of the caller were multiplied by.
    fn scale(&self) -> f64 {
        let (low, high) = self.a.bounding_box();
        let (l, h) = self.search.surfaces[0].bounding_box();
        norm(sub(h, l)) / norm(sub(high, low))
    }

    /// A collapsed edge that came near the other surface, and was not looked at.
    pub fn unseen_tip(&mut self, Tip { whose, side, inner }: Tip) {
        let [a, b] = [self.a, self.b].map(Surface::domain);
        let mut range = std::array::from_fn(|k| [a, b][k / 4][k % 4]);
        // From the edge as far as the surface was taken for a point.
        range[4 * whose + (side ^ 1)] = inner;
        self.out.undecided.push(Region { range });
    }

    /// A collapsed edge that came near the other surface: a contact, if it lies on it.
    pub fn tip(&mut self, Tip { whose, side, .. }: Tip, surfaces: [&IndexedSurface; 2]) {
        let own = surfaces[whose].surface();
        let [u0, u1, v0, v1] = own.domain();
        let at = [[u0, v0], [u1, v0], [u0, v0], [u0, v1]][side];
        let point = own.evaluate(at[0], at[1]);
        let foot = surfaces[1 - whose].closest(
            point,
            None,
            &QueryOptions::default(),
            &mut Workspace::default(),
            None,
        );
        let size = self.search.tip_size() / self.scale();
        if foot.lower_bound > (2.0 * size).max(self.search.touching_gap(0.0) / self.scale()) {
            return;
        }
        let other = [foot.u, foot.v];
        let (uv, st) = if whose == 0 { (at, other) } else { (other, at) };
        let place = self.point([uv[0], uv[1], st[0], st[1]]);
        let known =
            self.out.contacts.iter().any(|c| norm(sub(c.place.point, place.point)) <= 2.0 * size);
        if !known {
            let gap = self.gap(&place);
            let area = at_point(&place);
            let kind = ContactKind::Tip;
            self.out.contacts.push(Contact { place, kind, gap, radius: size, area });
        }
    }

    /// Branches that meet two by two in a collapsed edge are one; the contact between them is left out.
    pub fn join_at_tips(&mut self) {
        for k in (0..self.out.contacts.len()).rev() {
            if self.out.contacts[k].kind != ContactKind::Tip {
                continue;
            }
            let ends: Vec<(usize, usize)> = (0..self.out.branches.len())
                .flat_map(|i| [(i, 0), (i, 1)])
                .filter(|&(i, end)| self.out.branches[i].ends[end] == End::Contact(k))
                .collect();
            let [(i, first), (j, second)] = ends[..] else { continue };
            let tidy = |points: &mut Vec<MarchPoint>, end: usize| {
                // The tip with the parameter along the edge of the side from which the branch comes.
                let n = points.len();
                let (tip, beside) = if end == 0 { (0, 1) } else { (n - 1, n - 2) };
                let near = points[beside];
                let keep = |own: [f64; 2], near: [f64; 2], edges: [bool; 4]| {
                    [
                        if edges[2] || edges[3] { near[0] } else { own[0] },
                        if edges[0] || edges[1] { near[1] } else { own[1] },
                    ]
                };
                let at_edge = |s: &Surface, at: [f64; 2]| {
                    let ([u0, u1, v0, v1], c) = (s.domain(), s.collapsed_edges());
                    [
                        c[0] && at[0] == u0,
                        c[1] && at[0] == u1,
                        c[2] && at[1] == v0,
                        c[3] && at[1] == v1,
                    ]
                };
                let point = points[tip];
                points[tip].uv = keep(point.uv, near.uv, at_edge(self.a, point.uv));
                points[tip].st = keep(point.st, near.st, at_edge(self.b, point.st));
            };
            // Of joined branches it is not known over which parameter each chord is a graph.
            self.out.branches[i].held.clear();
            let mut one = std::mem::take(&mut self.out.branches[i].points);
            tidy(&mut one, first);
            if i == j {
                tidy(&mut one, second);
                self.out.branches[i].points = one;
                self.out.branches[i].ends = [End::Closed; 2];
            } else {
                let mut two = std::mem::take(&mut self.out.branches[j].points);
                tidy(&mut two, second);
                if first == 0 {
                    one.reverse();
                }
                if second == 1 {
                    two.reverse();
                }
                one.extend(two);
                let ends =
                    [self.out.branches[i].ends[1 - first], self.out.branches[j].ends[1 - second]];
                let other = self.out.branches[j].clone();
                let branch = &mut self.out.branches[i];
                (branch.points, branch.ends) = (one, ends);
                branch.gap = branch.gap.max(other.gap);
                branch.chord = branch.chord.max(other.chord);
                branch.bulge = [0, 1, 2, 3].map(|q| branch.bulge[q].max(other.bulge[q]));
                self.out.branches.remove(j);
            }
            self.remove_contact(k);
        }
    }

    /// Leaves out a contact in which no branch ends.
    fn remove_contact(&mut self, k: usize) -> Contact {
        for branch in &mut self.out.branches {
            for end in &mut branch.ends {
                if let End::Contact(n) = end {
                    *n -= usize::from(*n > k);
                }
            }
        }
        self.out.contacts.remove(k)
    }

    /// Branches that begin and end in one contact and do not leave its surroundings are what rounding makes of it: the contact counts
    /// for them.
    pub fn swallow(&mut self) {
        let reach = 64.0 * self.search.floor / self.scale();
        let contacts = &mut self.out.contacts;
        self.out.branches.retain(|branch| {
            let [End::Contact(k), End::Contact(j)] = branch.ends else { return true };
            let far = |p: &MarchPoint| norm(sub(p.point, contacts[k].place.point));
            let size = branch.points.iter().map(far).fold(0.0, f64::max);
            if k != j || branch.is_tangential || size > 4.0 * contacts[k].radius + reach {
                return true;
            }
            contacts[k].radius = contacts[k].radius.max(size);
            false
        });
        // What lies on a branch that goes on is no isolated contact: the surfaces were not told apart beside the branch.
        for k in (0..self.out.contacts.len()).rev() {
            let Contact { place, radius, kind, .. } = self.out.contacts[k];
            let near = |w: &[MarchPoint]| {
                distance_to_chord(place.point, w[0].point, w[1].point) <= 4.0 * radius + reach
            };
            let branches = &self.out.branches;
            let ends = branches.iter().any(|branch| branch.ends.contains(&End::Contact(k)));
            let judged = matches!(kind, ContactKind::Touching | ContactKind::Degenerate);
            if judged && !ends && branches.iter().any(|b| b.points.windows(2).any(near)) {
                let contact = self.remove_contact(k);
                self.out.undecided.push(contact.area);
            }
        }
    }

    /// The contact at which a chain ends, if any.
    fn contact_near(&self, point: &MarchPoint) -> Option<usize> {
        let far = |k: usize| norm(sub(self.out.contacts[k].place.point, point.point));
        let best = (0..self.out.contacts.len()).min_by(|&i, &j| far(i).total_cmp(&far(j)))?;
        let reach = 8.0 * self.out.contacts[best].radius + 64.0 * self.search.floor / self.scale();
        (far(best) <= reach).then_some(best)
    }

    /// `bounds`: chord, bulge and held parameters of a transversal branch.
    pub fn push(
        &mut self,
        places: impl Iterator<Item = [f64; 4]>,
        stops: [Stop; 2],
        bounds: Option<(f64, [f64; 4], Vec<u8>)>,
    ) {
        let is_tangential = bounds.is_none();
        let (chord, bulge, mut held) =
            bounds.unwrap_or((f64::INFINITY, [f64::INFINITY; 4], Vec::new()));
        let mut gap = 0.0f64;
        let of = |at: [f64; 4]| {
            let (point, apart) = self.measured(at);
            gap = gap.max(apart);
            point
        };
        let mut points: Vec<MarchPoint> = places.map(of).collect();
        let mut ends = [End::Undecided; 2];
        for k in 0..2 {
            ends[k] = match stops[k] {
                Stop::Closed => End::Closed,
                Stop::Border(side) => End::Border(side as u8),
                Stop::Open => {
                    let at = if k == 0 { points[0] } else { points[points.len() - 1] };
                    match self.contact_near(&at) {
                        Some(contact) => {
                            let Contact { place, gap: apart, .. } = self.out.contacts[contact];
                            gap = gap.max(apart);
                            if k == 0 {
                                points.insert(0, place);
                                held.insert(0, Branch::ANY);
                            } else {
                                points.push(place);
                                held.push(Branch::ANY);
                            }
                            End::Contact(contact)
                        }
                        None => End::Undecided,
                    }
                }
            };
        }
        if is_tangential && stops.iter().all(|stop| matches!(stop, Stop::Border(_))) {
            let (first, last) = (points[0].point, points[points.len() - 1].point);
            let length = points.windows(2).map(|w| norm(sub(w[1].point, w[0].point))).sum::<f64>();
            if norm(sub(first, last)) <= 64.0 * self.search.floor / self.scale() && length > 0.0 {
                ends = [End::Closed; 2];
            }
        }
        self.out.branches.push(Branch {
            points,
            ends,
            is_tangential,
            bounds_overlap: false,
            gap,
            chord,
            bulge,
            held,
        });
    }
}
