//! Surface-surface intersection: all branches, with a proof that none is missing, or with what could not be decided.
//!
//! ```text
//!   A, B -> pairs of parts -> empty | one arc, proven | halve | touch here          `pieces`, `arc`, `pair`, `search`
//!        -> arcs walked over knot lines and seams -> branches, refined to the chord  `join`
//!        -> touching curves traced, points and areas classified                      `contact`, `cluster`
//! ```
//!
//! Topology is decided by inequalities over whole boxes of (u, v, s, t), never by samples: a pair of parts is closed when it provably
//! holds no solution, or exactly one arc on which n_A x n_B does not vanish. What is tangential cannot be proven in floating
//! arithmetic; it is found, classified, measured, and said to be not proven ([`Intersection::is_proven`]).
//!
//! References: Sinha, Klassen, Wang 1985 and Sederberg, Meyers 1988 (loops and normals); Krawczyk 1969 (the test of an arc); Ye,
//! Maekawa 1999 (contact).
//! Faces, elementary surfaces and surfaces given by functions: [`faces`]. Limits: two arcs that run on both sides of a knot line at a distance below
//! the rounding are one.

mod bends;

mod pieces;

mod system;

mod arc;

mod pair;

pub mod shape;

mod contact;

mod search;

mod join;

mod tangent;

mod cluster;

pub mod correct;

pub mod follow;

pub mod triangles;

pub mod curves;

mod functions;

pub mod faces;

pub mod split;

use crate::bounds::{HALF_ULP, Vector, add, norm, scaled, sub};
use crate::closest::{QueryOptions, Workspace};
use crate::error::Error;
use crate::index::IndexedSurface;
use crate::surface::Surface;
use cluster::{Cluster, clusters, see};
use join::{Joiner, Place, Stop};
use search::{Open, Search};
use tangent::{is_near, ridges};

/// Pairs of parts that are judged at most, when the caller does not say.
pub const DEFAULT_BUDGET: u64 = 2_000_000;

/// What an intersection asks for.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MarchOptions {
    /// How far a branch may be from the chord between two points, finite, >= 0. 0: 1e-3 of the size of the smaller surface (the power
    /// of two above the diagonal of its box). Points themselves are as exact as the arithmetic: see [`Branch::gap`].
    pub chord: f64,
    /// Most pairs of parts; 0: [`DEFAULT_BUDGET`].
    pub budget: u64,
}

impl MarchOptions {
    /// # Errors
    /// [`Error::InvalidArgument`] for a length that is negative or not finite.
    fn checked(self) -> Result<Self, Error> {
        if !self.chord.is_finite() || self.chord < 0.0 {
            let text = format!("chord: {} is not a length", self.chord);
            return Err(Error::InvalidArgument(text));
        }
        Ok(self)
    }
}

/// A point of both surfaces.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct MarchPoint {
    /// Middle of the two surface points.
    pub point: Vector,
    /// Parameters of A.
    pub uv: [f64; 2],
    /// Parameters of B.
    pub st: [f64; 2],
}

/// What the end of a branch is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// The branch is closed and has no end.
    Closed,
    /// A border of A or B: side 0 to 7 (u low, u high, v low, v high, s low, s high, t low, t high).
    Border(u8),
    /// A contact of this number in [`Intersection::contacts`]: a branch point, a cusp, a collapsed edge.
    Contact(usize),
    /// An undecided box is there.
    Undecided,
    /// A trim of A (0) or B (1): see [`faces`].
    Trim(u8),
}

/// A curve of the intersection.
#[derive(Clone, Debug)]
pub struct Branch {
    /// Points in order, along n_A x n_B when transversal. A closed branch ends with its first point; at a seam of a closed surface
    /// the same point comes twice, with the parameters of either side.
    pub points: Vec<MarchPoint>,
    /// What its ends are.
    pub ends: [End; 2],
    /// Whether the surfaces touch along it.
    pub is_tangential: bool,
    /// Greatest distance between the two surface points of one of its points.
    pub gap: f64,
    /// Proven: between two points the branch stays within this of their chord, a length. Infinite for a tangential branch; the last
    /// piece beside a contact is not counted, it is about as long as the contact's radius.
    pub chord: f64,
    /// Proven: between two points u, v, s, t stay within these of their straight line. Infinite where `chord` is.
    pub bulge: [f64; 4],
    /// For each chord the parameter over which it is a graph ([`Branch::ANY`]: not known, [`Branch::JUMP`]: it passes a seam).
    held: Vec<u8>,
}

impl Branch {
    const ANY: u8 = 4;
    const JUMP: u8 = 5;

    /// Whether it is a loop.
    pub fn is_closed(&self) -> bool {
        self.ends[0] == End::Closed
    }
}

/// What an isolated contact is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ContactKind {
    /// The surfaces touch from one side.
    Touching,
    /// Two curves cross: four arms.
    Crossing,
    /// The surfaces agree to a higher order than the second, or have no tangent plane.
    Degenerate,
    /// A border of one surface just meets the other one.
    Border,
    /// A collapsed edge of one surface, a point, lies on the other one.
    Tip,
}

/// A point that belongs to no branch, or in which branches meet.
#[derive(Clone, Copy, Debug)]
pub struct Contact {
    /// Where.
    pub place: MarchPoint,
    /// What.
    pub kind: ContactKind,
    /// Distance between the surfaces there.
    pub gap: f64,
    /// Nothing else of the intersection is farther from it than this and still not on a branch.
    pub radius: f64,
}

/// A part in which the surfaces coincide to the last digits.
#[derive(Clone, Copy, Debug)]
pub struct Region {
    /// u0, u1, v0, v1 of A, s0, s1, t0, t1 of B.
    pub range: [f64; 8],
}

/// All that two surfaces have in common.
#[derive(Clone, Debug, Default)]
pub struct Intersection {
    /// Curves.
    pub branches: Vec<Branch>,
    /// Points.
    pub contacts: Vec<Contact>,
    /// Boxes in which the surfaces coincide.
    pub overlaps: Vec<Region>,
    /// Boxes about which nothing is known.
    pub undecided: Vec<Region>,
    /// Whether all is proven: every branch transversal, nothing undecided, no contact.
    pub is_proven: bool,
    /// Whether the budget ran out.
    pub exhausted: bool,
    /// Pairs of parts judged.
    pub judged: u64,
}

/// Both surfaces in one frame: around the middle of the smaller one, scaled by a power of two to its size.
struct Frames {
    surfaces: [Surface; 2],
    scale: f64,
    noise: f64,
}

impl Frames {
    fn new(a: &Surface, b: &Surface) -> Result<Self, Error> {
        let boxes = [a, b].map(|s| s.bounding_box());
        let sizes = boxes.map(|(low, high)| norm(sub(high, low)));
        let smaller = usize::from(sizes[1] < sizes[0]);
        let (low, high) = boxes[smaller];
        let origin = scaled(add(low, high), 0.5);
        if sizes[smaller] < 1e-150 {
            return Err(Error::Unsupported("surfaces: one of them is a point".into()));
        }
        let mut scale = 1.0;
        while scale * sizes[smaller] > 1.0 {
            scale *= 0.5;
        }
        while scale * sizes[smaller] <= 0.5 {
            scale *= 2.0;
        }
        let largest =
            boxes.iter().flat_map(|(l, h)| l.iter().chain(h)).fold(0.0f64, |m, x| m.max(x.abs()));
        let moved = |s: &Surface| {
            let poles: Vec<Vector> =
                s.poles().iter().map(|&p| scaled(sub(p, origin), scale)).collect();
            let (ku, kv) = (s.knots_u(), s.knots_v());
            let counts = [ku.pole_count(), kv.pole_count()];
            Surface::new(
                ku.values(),
                kv.values(),
                ku.degree(),
                kv.degree(),
                &poles,
                counts[0],
                counts[1],
                s.weights(),
            )
        };
        Ok(Self {
            surfaces: [moved(a)?, moved(b)?],
            scale,
            noise: 2.0 * HALF_ULP * largest * scale,
        })
    }
}

/// All that two surfaces have in common. `poll(judged, waiting)` is asked now and then whether to stop.
///
/// # Errors
/// [`Error::InvalidArgument`] for a length that is negative or not finite; [`Error::Unsupported`] for a surface that is a point;
/// [`Error::Cancelled`].
pub fn intersect(
    a: &IndexedSurface,
    b: &IndexedSurface,
    options: &MarchOptions,
    poll: &mut dyn FnMut(u64, u64) -> bool,
) -> Result<Intersection, Error> {
    let options = options.checked()?;
    let frames = Frames::new(a.surface(), b.surface())?;
    let [sa, sb] = &frames.surfaces;
    let chord = if options.chord > 0.0 { options.chord * frames.scale } else { 1e-3 };
    let mut search = Search::new([sa, sb], frames.noise);
    let budget = if options.budget > 0 { options.budget } else { DEFAULT_BUDGET };
    search.run(budget, poll)?;
    let (chains, points) = Joiner::new(&search, chord).chains();
    let ridges = ridges(&search, chord);
    let mut made =
        Maker { a: a.surface(), b: b.surface(), search: &search, out: Intersection::default() };
    made.out.judged = search.judged;
    made.out.exhausted = search.open.iter().any(|pair| pair.why == Open::Budget);
    for &tip in &search.tips {
        made.tip(tip, [a, b]);
    }
    let groups = clusters(&search);
    match &groups {
        Some(groups) => made.classify(groups, &ridges),
        None => {
            made.out.undecided =
                search.open.iter().map(|pair| region(pair.low, pair.high)).collect()
        }
    }
    for place in points {
        let place = made.point(&place);
        made.out.contacts.push(Contact {
            place,
            kind: ContactKind::Border,
            gap: made.gap(&place),
            radius: 0.0,
        });
    }
    for chain in chains {
        let bounds = (chain.chord / frames.scale, chain.bulge, chain.held);
        made.push(chain.places, chain.stops, Some(bounds));
    }
    for ridge in ridges {
        made.push(ridge.places, ridge.stops, None);
    }
    made.join_at_tips();
    made.out.is_proven = settled(&made.out);
    Ok(made.out)
}

/// Whether every branch is transversal, and nothing touches, coincides, or is undecided.
fn settled(out: &Intersection) -> bool {
    let transversal =
        |branch: &Branch| !branch.is_tangential && !branch.ends.contains(&End::Undecided);
    out.branches.iter().all(transversal)
        && out.contacts.is_empty()
        && out.overlaps.is_empty()
        && out.undecided.is_empty()
}

fn region(low: [f64; 4], high: [f64; 4]) -> Region {
    Region { range: [low[0], high[0], low[1], high[1], low[2], high[2], low[3], high[3]] }
}

struct Maker<'a, 'b> {
    a: &'a Surface,
    b: &'a Surface,
    search: &'a Search<'b>,
    out: Intersection,
}

impl Maker<'_, '_> {
    fn point(&self, place: &Place) -> MarchPoint {
        let [u, v, s, t] = place.at;
        let (x, y) = (self.a.evaluate(u, v), self.b.evaluate(s, t));
        MarchPoint {
            point: std::array::from_fn(|k| x[k] + 0.5 * (y[k] - x[k])),
            uv: [u, v],
            st: [s, t],
        }
    }

    fn gap(&self, point: &MarchPoint) -> f64 {
        let ([u, v], [s, t]) = (point.uv, point.st);
        norm(sub(self.a.evaluate(u, v), self.b.evaluate(s, t)))
    }

    /// What is in the groups of boxes that were not divided further.
    fn classify(&mut self, groups: &[Cluster], ridges: &[tangent::Ridge]) {
        for pair in self.search.open.iter().filter(|pair| pair.why == Open::Area) {
            self.out.overlaps.push(region(pair.low, pair.high));
        }
        for group in groups {
            let [area, curve, flat, budget] = group.has;
            if area || (curve && !flat && !budget) {
                continue;
            }
            let seen = if budget { None } else { see(self.search, group) };
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
                    let place = self.point(&seen.place);
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
                    self.out.contacts.push(Contact { place, kind, gap: self.gap(&place), radius });
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

    /// A collapsed edge that came near the other surface: a contact, if it lies on it.
    fn tip(&mut self, (whose, side): (usize, usize), surfaces: [&IndexedSurface; 2]) {
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
        if foot.lower_bound > 2.0 * size {
            return;
        }
        let other = [foot.u, foot.v];
        let (uv, st) = if whose == 0 { (at, other) } else { (other, at) };
        let place = self.point(&Place { x: [0.0; 3], at: [uv[0], uv[1], st[0], st[1]] });
        let known =
            self.out.contacts.iter().any(|c| norm(sub(c.place.point, place.point)) <= 2.0 * size);
        if !known {
            let gap = self.gap(&place);
            self.out.contacts.push(Contact { place, kind: ContactKind::Tip, gap, radius: size });
        }
    }

    /// Branches that meet two by two in a collapsed edge are one; the contact between them is left out.
    fn join_at_tips(&mut self) {
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
            self.out.contacts.remove(k);
            for branch in &mut self.out.branches {
                for end in &mut branch.ends {
                    if let End::Contact(n) = end {
                        *n -= usize::from(*n > k);
                    }
                }
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
    fn push(
        &mut self,
        places: Vec<Place>,
        stops: [Stop; 2],
        bounds: Option<(f64, [f64; 4], Vec<u8>)>,
    ) {
        let is_tangential = bounds.is_none();
        let (chord, bulge, mut held) =
            bounds.unwrap_or((f64::INFINITY, [f64::INFINITY; 4], Vec::new()));
        let mut points: Vec<MarchPoint> = places.iter().map(|place| self.point(place)).collect();
        let mut ends = [End::Undecided; 2];
        for k in 0..2 {
            ends[k] = match stops[k] {
                Stop::Closed => End::Closed,
                Stop::Border(side) => End::Border(side as u8),
                Stop::Open => {
                    let at = if k == 0 { points[0] } else { points[points.len() - 1] };
                    match self.contact_near(&at) {
                        Some(contact) => {
                            let place = self.out.contacts[contact].place;
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
        let gap = points.iter().fold(0.0f64, |m, p| m.max(self.gap(p)));
        self.out.branches.push(Branch { points, ends, is_tangential, gap, chord, bulge, held });
    }
}
