//! Intersection of faces: that of their supports, cut off where a trim ends it.
//!
//! ```text
//!   face -> support as a spline (an elementary one by its exact form) -> all branches of the two supports
//!        -> each chord of a branch: a box in either domain that holds it, proven
//!           no trim runs through the box: all of it is in, or out        a trim may: halved, down to the last digits
//!        -> parameters in the faces' own terms
//! ```
//!
//! A face holds its border. What runs along a trim, or touches one, cannot be told in doubles: it is kept and listed as undecided.

use super::border::Border;
use super::correct::{Corrector, correct};
use super::functions::walked;
use super::shape::Shape;
use super::watch::Watch;
use super::{Branch, Contact, End, Intersection, MarchOptions, MarchPoint, Region as Area};
use super::{intersect, settled};
use crate::bounds::{add, norm, scaled, sub};
use crate::error::Error;
use crate::face::{Halving, Region, Side};
use crate::index::IndexedSurface;
use crate::pcurve::Pcurve;
use crate::transform::Transform;
use crate::trim::{Support, TrimmedSurface};

/// Pieces of a branch that are looked at, at most.
const MOST_PIECES: usize = 20_000;

/// Share of the smaller surface's size at which a piece counts as a point.
const POINT: f64 = 4e-13;

/// One of the two faces.
struct Half<'a> {
    shape: &'a dyn Shape,
    /// Its support as a spline; `None` for a function.
    form: Option<&'a IndexedSurface>,
    /// From the parameters of the form to those of the support.
    map: Option<Transform>,
    /// What the loops enclose, in the parameters of the support, and they themselves; `None`: the whole domain.
    region: Option<(Region, Border)>,
}

/// Whether a face is all of its support: one loop along the sides of the domain.
fn is_whole(face: &TrimmedSurface) -> bool {
    let [u0, u1, v0, v1] = face.support().domain();
    let [chain] = face.loops() else { return false };
    let mut area = 0.0;
    let along = chain.coedges.iter().all(|coedge| {
        let Pcurve::Isoline(_) = &coedge.pcurve else { return false };
        let (p, q) = (coedge.start(), coedge.end());
        area += 0.5 * (p[0] * q[1] - p[1] * q[0]);
        let on = |k: usize, ends: [f64; 2]| p[k] == q[k] && ends.contains(&p[k]);
        on(0, [u0, u1]) || on(1, [v0, v1])
    });
    let all = (u1 - u0) * (v1 - v0);
    along && (area.abs() - all).abs() <= 1e-9 * all
}

impl<'a> Half<'a> {
    fn new(face: &'a TrimmedSurface) -> Result<Self, Error> {
        let (form, map) = match face.support() {
            Support::Spline(spline) => (Some(spline.as_ref()), None),
            Support::Elementary(elementary) => {
                (Some(elementary.form()?), Some(elementary.to_form()?.inverse()))
            }
            Support::Callback(_) => (None, None),
        };
        let shape: &dyn Shape = match form {
            Some(form) => form.surface(),
            None => face.support(),
        };
        let region = if is_whole(face) {
            None
        } else {
            let (mut chains, mut border) = (Vec::new(), Border::default());
            for chain in face.loops() {
                let curves: Result<Vec<_>, _> =
                    chain.coedges.iter().map(|coedge| coedge.pcurve.as_spline()).collect();
                let curves = curves?;
                border.push(&curves);
                chains.push(curves);
            }
            Some((Region::new(chains.iter().map(|chain| chain.iter()))?, border))
        };
        Ok(Self { shape, form, map, region })
    }

    fn own(&self, at: [f64; 2]) -> [f64; 2] {
        self.map.as_ref().map_or(at, |map| map.apply(at))
    }

    /// The box in own parameters of a box of the form: each parameter is mapped by itself, and grows with the other.
    fn area(&self, low: [f64; 2], high: [f64; 2]) -> [f64; 4] {
        let [u0, u1, v0, v1] = self.shape.domain();
        let inside = |[u, v]: [f64; 2]| [u.clamp(u0, u1), v.clamp(v0, v1)];
        let (p, q) = (self.own(inside(low)), self.own(inside(high)));
        let order = |a: f64, b: f64| {
            let by = 4.0 * f64::EPSILON * (a.abs() + b.abs());
            (a.min(b) - by, a.max(b) + by)
        };
        let ((a, b), (c, d)) = (order(p[0], q[0]), order(p[1], q[1]));
        [a, b, c, d]
    }

    fn side(&self, at: [f64; 2], memory: &mut Halving) -> Side {
        self.region.as_ref().map_or(Side::Inside, |(region, _)| region.side(self.own(at), memory))
    }

    fn may_cross(&self, area: &[f64; 4]) -> bool {
        self.region.as_ref().is_some_and(|(_, border)| border.may_cross(area))
    }
}

/// What is known of a piece of a branch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Label {
    In,
    Out,
    /// A trim is there; and whether it is one of A (0) or B (1).
    Unknown(u8),
}

/// A piece of a branch; `jump`: it begins at the other side of a seam.
struct Piece {
    from: MarchPoint,
    to: MarchPoint,
    /// How far its parameters may leave their straight line.
    bulge: [f64; 4],
    label: Label,
    jump: bool,
}

struct Cutter<'a, 'w> {
    halves: [Half<'a>; 2],
    memory: Halving,
    point: f64,
    pieces: Vec<Piece>,
    undecided: Vec<Area>,
    unproven: bool,
    watch: &'a Watch<'w>,
}

fn parameters(p: &MarchPoint) -> [f64; 4] {
    [p.uv[0], p.uv[1], p.st[0], p.st[1]]
}

impl Cutter<'_, '_> {
    /// A place of both surfaces between two points, at the middle of parameter `k`.
    fn between(&self, from: &MarchPoint, to: &MarchPoint, k: usize) -> Option<MarchPoint> {
        let (p, q) = (parameters(from), parameters(to));
        let middle = [0, 1, 2, 3].map(|c| 0.5 * (p[c] + q[c]));
        let [a, b] = [0, 1].map(|k| self.halves[k].shape);
        let at =
            correct(a, b, middle, Corrector::NewtonThree(k), self.point, None).map(|f| f.at)?;
        let (x, y) = (a.evaluate(at[0], at[1]), b.evaluate(at[2], at[3]));
        Some(MarchPoint { point: scaled(add(x, y), 0.5), uv: [at[0], at[1]], st: [at[2], at[3]] })
    }

    fn label(&mut self, from: MarchPoint, to: MarchPoint, bulge: [f64; 4], k: usize, jump: bool) {
        let (p, q) = (parameters(&from), parameters(&to));
        let low = [0, 1, 2, 3].map(|c| p[c].min(q[c]) - bulge[c]);
        let high = [0, 1, 2, 3].map(|c| p[c].max(q[c]) + bulge[c]);
        let mut unknown = None;
        let mut is_out = false;
        for half in 0..2 {
            let c = 2 * half;
            let area = self.halves[half].area([low[c], low[c + 1]], [high[c], high[c + 1]]);
            if self.halves[half].may_cross(&area) {
                unknown = Some(half as u8);
                continue;
            }
            let side = self.halves[half].side([p[c], p[c + 1]], &mut self.memory);
            is_out |= side == Side::Outside;
        }
        let label = match unknown {
            _ if is_out => Label::Out,
            None => Label::In,
            Some(half) => Label::Unknown(half),
        };
        let known = !matches!(label, Label::Unknown(_));
        let small = norm(sub(to.point, from.point)) <= self.point;
        if known || small || self.pieces.len() >= MOST_PIECES || self.watch.stops(0) {
            self.pieces.push(Piece { from, to, bulge, label, jump });
            return;
        }
        // As far as rounding lets it be said.
        let inside = |m: &MarchPoint| {
            let at = parameters(m);
            (0..4).all(|c| {
                let slack = 256.0 * f64::EPSILON * (low[c].abs() + high[c].abs());
                low[c] - slack <= at[c] && at[c] <= high[c] + slack
            })
        };
        match self.between(&from, &to, k).filter(inside) {
            Some(middle) => {
                let less = bulge.map(|b| 0.25 * b);
                self.label(from, middle, less, k, jump);
                self.label(middle, to, less, k, false);
            }
            None => self.pieces.push(Piece { from, to, bulge, label, jump }),
        }
    }

    /// The parts of a branch that both faces hold.
    fn cut(&mut self, branch: &Branch, out: &mut Vec<Branch>) {
        self.pieces.clear();
        let mut jump = false;
        for (i, pair) in branch.points.windows(2).enumerate() {
            self.watch.stops(branch.points.len() - i);
            let (from, to) = (pair[0], pair[1]);
            let k = branch.held.get(i).copied();
            if k == Some(Branch::JUMP) {
                jump = true;
                continue;
            }
            let moved = {
                let (p, q) = (parameters(&from), parameters(&to));
                [0, 1, 2, 3].map(|c| (q[c] - p[c]).abs())
            };
            // Beside a contact, and along a touching curve, nothing is proven: a guess with room.
            let (k, bulge) = match k {
                Some(k) if k < 4 && branch.chord.is_finite() => (k as usize, branch.bulge),
                _ => {
                    let k = (0..4).fold(0, |best, c| if moved[c] > moved[best] { c } else { best });
                    (k, moved.map(|m| 0.25 * m))
                }
            };
            self.label(from, to, bulge, k, jump);
            jump = false;
        }
        let pieces = std::mem::take(&mut self.pieces);
        self.gather(&pieces, branch, out);
        self.pieces = pieces;
    }

    fn doubt(&mut self, piece: &Piece) {
        let (p, q) = (parameters(&piece.from), parameters(&piece.to));
        let range = std::array::from_fn(|n| {
            let (a, b, by) = (p[n / 2], q[n / 2], piece.bulge[n / 2]);
            if n % 2 == 0 { a.min(b) - by } else { a.max(b) + by }
        });
        self.undecided.push(Area { range });
        self.unproven = true;
    }

    fn gather(&mut self, pieces: &[Piece], branch: &Branch, out: &mut Vec<Branch>) {
        let n = pieces.len();
        let is_out = |piece: &Piece| piece.label == Label::Out;
        if !pieces.iter().any(is_out) {
            for piece in pieces {
                let long = norm(sub(piece.to.point, piece.from.point)) > self.point;
                if matches!(piece.label, Label::Unknown(_)) && long {
                    self.doubt(piece);
                }
            }
            out.push(branch.clone());
            return;
        }
        // A loop is begun where it is outside.
        let first =
            if branch.is_closed() { pieces.iter().position(is_out).unwrap_or(0) } else { 0 };
        let order: Vec<&Piece> = (0..n).map(|i| &pieces[(first + i) % n]).collect();
        let mut at = 0;
        while at < n {
            // A run without pieces that are out.
            let mut end = at;
            while end < n && !is_out(order[end]) {
                end += 1;
            }
            let run = &order[at..end];
            let is_in = |piece: &&Piece| piece.label == Label::In;
            let (head, tail) = (run.iter().position(is_in), run.iter().rposition(is_in));
            let (Some(head), Some(tail)) = (head, tail) else {
                // Unknown between what is out: a trim is touched, or something small is lost; not where the branch ends, unless it is
                // long: then it was not looked at further.
                let inner = at > 0 && end < n;
                let long = |piece: &Piece| norm(sub(piece.to.point, piece.from.point)) > self.point;
                let doubtful: Vec<_> = run.iter().filter(|piece| inner || long(piece)).collect();
                doubtful.into_iter().for_each(|piece| self.doubt(piece));
                at = end.max(at) + 1;
                continue;
            };
            let (mut points, mut held) = (vec![run[head].from], Vec::new());
            for piece in &run[head..=tail] {
                let long = norm(sub(piece.to.point, piece.from.point)) > self.point;
                if matches!(piece.label, Label::Unknown(_)) && long {
                    self.doubt(piece);
                }
                if piece.jump && points.last() != Some(&piece.from) {
                    points.push(piece.from);
                    held.push(Branch::JUMP);
                }
                points.push(piece.to);
                held.push(Branch::ANY);
            }
            for piece in run[..head].iter().chain(&run[tail + 1..]) {
                if norm(sub(piece.to.point, piece.from.point)) > self.point {
                    self.doubt(piece);
                }
            }
            // Where a trim ends it, or what the branch ends with; a long piece beside it was not looked at further.
            let whose = |piece: Option<&&Piece>| match piece {
                Some(piece) if norm(sub(piece.to.point, piece.from.point)) > self.point => {
                    End::Undecided
                }
                Some(Piece { label: Label::Unknown(half), .. }) => End::Trim(*half),
                _ => End::Trim(0),
            };
            let starts = at == 0 && !branch.is_closed();
            let ends = end == n && !branch.is_closed();
            out.push(Branch {
                points,
                held,
                ends: [
                    if starts { branch.ends[0] } else { whose(run[..head].last()) },
                    if ends { branch.ends[1] } else { whose(run[tail + 1..].first()) },
                ],
                ..branch.clone()
            });
            at = end + 1;
        }
    }

    /// Whether a box of both domains is certainly outside of a face.
    fn is_outside(&mut self, range: &[f64; 8]) -> bool {
        (0..2).any(|half| {
            let c = 4 * half;
            let (low, high) = ([range[c], range[c + 2]], [range[c + 1], range[c + 3]]);
            let area = self.halves[half].area(low, high);
            !self.halves[half].may_cross(&area)
                && self.halves[half].side(low, &mut self.memory) == Side::Outside
        })
    }

    fn holds(&mut self, place: &MarchPoint) -> bool {
        self.halves[0].side(place.uv, &mut self.memory) != Side::Outside
            && self.halves[1].side(place.st, &mut self.memory) != Side::Outside
    }

    fn mapped(&self, place: &mut MarchPoint) {
        place.uv = self.halves[0].own(place.uv);
        place.st = self.halves[1].own(place.st);
    }
}

/// All that two faces have in common: as [`intersect`] of their supports, cut off at their trims ([`End::Trim`]). Parameters are those
/// of the supports.
///
/// A surface given by a function is meshed and walked along: nothing is proven then, and one undecided box is all of both domains.
///
/// # Errors
/// What [`intersect`] refuses; memory that could not be had.
pub fn intersect_faces(
    a: &TrimmedSurface,
    b: &TrimmedSurface,
    options: &MarchOptions,
    poll: &mut dyn FnMut(u64, u64) -> bool,
) -> Result<Intersection, Error> {
    let halves = [Half::new(a)?, Half::new(b)?];
    let found = match (halves[0].form, halves[1].form) {
        (Some(a), Some(b)) => intersect(a, b, options, poll)?,
        _ => walked(halves[0].shape, halves[1].shape, options.checked()?.chord, poll)?,
    };
    let watch = Watch::after(found.stopped, poll);
    let size = |face: &TrimmedSurface| face.support().bounding_box().map(|b| b.diagonal());
    let point = POINT * size(a)?.min(size(b)?);
    let mut cutter = Cutter {
        halves,
        memory: Halving::default(),
        point,
        pieces: Vec::new(),
        undecided: Vec::new(),
        unproven: false,
        watch: &watch,
    };
    let mut branches = Vec::new();
    for branch in &found.branches {
        cutter.cut(branch, &mut branches);
    }
    // Contacts that both faces hold, and those in which a branch ends.
    let mut number = vec![None; found.contacts.len()];
    let mut contacts: Vec<Contact> = Vec::new();
    for (k, contact) in found.contacts.iter().enumerate() {
        watch.stops(found.contacts.len() - k);
        let ends = |branch: &Branch| branch.ends.contains(&End::Contact(k));
        if branches.iter().any(ends) || cutter.holds(&contact.place) {
            number[k] = Some(contacts.len());
            contacts.push(*contact);
        }
    }
    for branch in &mut branches {
        for end in &mut branch.ends {
            if let End::Contact(k) = *end {
                *end = number[k].map_or(End::Undecided, End::Contact);
            }
        }
        branch.points.iter_mut().for_each(|point| cutter.mapped(point));
        if cutter.halves.iter().any(|half| half.map.is_some()) {
            branch.bulge = [f64::INFINITY; 4];
        }
        // Cutting made new points.
        if cutter.halves.iter().any(|half| half.region.is_some()) {
            let apart =
                |p: &MarchPoint| norm(sub(a.support().evaluate(p.uv), b.support().evaluate(p.st)));
            branch.gap = branch.points.iter().map(apart).fold(0.0, f64::max);
        }
    }
    contacts.iter_mut().for_each(|contact| cutter.mapped(&mut contact.place));
    let mut out = Intersection { branches, contacts, ..found.clone() };
    let (mut overlaps, mut undecided) = (found.overlaps, found.undecided);
    overlaps.retain(|area| watch.stops(0) || !cutter.is_outside(&area.range));
    undecided.retain(|area| watch.stops(0) || !cutter.is_outside(&area.range));
    undecided.append(&mut cutter.undecided);
    for area in overlaps.iter_mut().chain(&mut undecided) {
        let r = area.range;
        let uv = cutter.halves[0].area([r[0], r[2]], [r[1], r[3]]);
        let st = cutter.halves[1].area([r[4], r[6]], [r[5], r[7]]);
        area.range = std::array::from_fn(|k| if k < 4 { uv[k] } else { st[k - 4] });
    }
    (out.overlaps, out.undecided) = (overlaps, undecided);
    out.stopped = watch.stopped();
    out.is_proven = settled(&out) && !cutter.unproven && out.holds(options.tolerance);
    Ok(out)
}
