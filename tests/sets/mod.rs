//! What every set of feet must obey, and the comparison with a set that is known.

#![allow(dead_code, reason = "each test file uses its own part")]

pub mod known;

use footpoint::closest::{QueryOptions, flag};
use footpoint::extrema::ExtremaOptions;
use footpoint::preimage::Line;
use footpoint::set::{FootSet, Kind, Member, Nature};

use crate::shapes::asked::Shape;
use crate::shapes::{Vector, along, dot, norm, sub};

/// Queries of each test against closed forms; with debug assertions, where each takes longer, fewer.
pub const QUERIES: usize = if cfg!(debug_assertions) { 2_000 } else { 10_000 };

pub fn extrema(shape: &Shape, query: Vector, options: &ExtremaOptions) -> FootSet {
    let never = &mut || false;
    match shape {
        Shape::Curve(curve) => curve.extrema(query, options, never),
        Shape::Surface(surface) => surface.extrema(query, options, never),
    }
    .expect("a set")
}

pub fn preimage(shape: &Shape, query: Vector, tolerance: f64, options: &QueryOptions) -> FootSet {
    let never = &mut || false;
    match shape {
        Shape::Curve(curve) => curve.preimage(query, tolerance, options, never),
        Shape::Surface(surface) => surface.preimage(query, tolerance, options, never),
    }
    .expect("a set")
}

pub fn on_line(shape: &Shape, line: &Line, tolerance: f64, options: &QueryOptions) -> FootSet {
    let never = &mut || false;
    match shape {
        Shape::Curve(curve) => curve.on_line(line, tolerance, options, never),
        Shape::Surface(surface) => surface.on_line(line, tolerance, options, never),
    }
    .expect("a set")
}

/// What was asked, as far as the laws differ.
#[derive(Clone, Copy)]
pub enum Asked {
    Extrema(Vector),
    Preimage(Vector),
    OnLine(Line),
}

impl Asked {
    /// Distance of a point of the shape.
    fn distance(&self, point: Vector) -> f64 {
        match self {
            Self::Extrema(query) | Self::Preimage(query) => norm(sub(point, *query)),
            Self::OnLine(line) => norm(sub(point, self.on(line, point))),
        }
    }

    fn unit(line: &Line) -> Vector {
        line.direction.map(|x| x / norm(line.direction))
    }

    fn on(&self, line: &Line, point: Vector) -> Vector {
        along(line.origin, Self::unit(line), self.place(point))
    }

    /// Place along the line.
    fn place(&self, point: Vector) -> f64 {
        match self {
            Self::OnLine(line) => dot(sub(point, line.origin), Self::unit(line)),
            _ => 0.0,
        }
    }

    fn magnitude(&self) -> f64 {
        let origin = match self {
            Self::Extrema(p) | Self::Preimage(p) => p,
            Self::OnLine(line) => &line.origin,
        };
        origin.iter().fold(0.0, |m: f64, x| m.max(x.abs()))
    }
}

/// Which directions of a shape are closed, and which edges collapsed.
pub fn topology(shape: &Shape) -> ([bool; 2], [bool; 4]) {
    match shape {
        Shape::Curve(curve) => ([curve.curve().is_closed(), false], [false; 4]),
        Shape::Surface(surface) => {
            let surface = surface.surface();
            ([surface.is_closed_u(), surface.is_closed_v()], surface.collapsed_edges())
        }
    }
}

/// The first law that a set breaks.
pub fn complaint(shape: &Shape, set: &FootSet, asked: &Asked) -> Option<String> {
    let member = set.members.iter().find_map(|m| member_complaint(shape, m, asked));
    member.or_else(|| order_complaint(set, asked))
}

fn member_complaint(shape: &Shape, m: &Member, asked: &Asked) -> Option<String> {
    let [u0, u1, v0, v1] = shape.domain();
    let is_curve = matches!(shape, Shape::Curve(_));
    let foot = &m.foot;
    let laws = [
        (
            shape.evaluate([foot.u, foot.v]).map(f64::to_bits) == foot.point.map(f64::to_bits),
            "point",
        ),
        (distance_agrees(shape, m, asked), "distance"),
        (foot.lower_bound == 0.0, "lower bound"),
        (u0 <= m.u[0] && m.u[0] <= foot.u && foot.u <= m.u[1] && m.u[1] <= u1, "interval of u"),
        (v0 <= m.v[0] && m.v[0] <= foot.v && foot.v <= m.v[1] && m.v[1] <= v1, "interval of v"),
        (!is_curve || (m.v == [0.0; 2] && matches!(m.kind, Kind::Point | Kind::ArcU)), "curve"),
        (foot.flags == wanted_flags(shape, m, foot.flags), "flags"),
    ];
    let broken = laws.iter().find(|law| !law.0)?;
    Some(format!("{}: {m:?}", broken.1))
}

fn distance_agrees(shape: &Shape, m: &Member, asked: &Asked) -> bool {
    let rounding = 1e-15 * (asked.magnitude() + shape.diagonal() + m.foot.distance);
    let more = if matches!(asked, Asked::OnLine(_)) { 8.0 } else { 2.0 };
    (m.foot.distance - asked.distance(m.foot.point)).abs() <= more * rounding
}

/// The flags that follow from the place and the kind; those that do not are taken from `found`.
fn wanted_flags(shape: &Shape, m: &Member, found: u32) -> u32 {
    let ([u0, u1, v0, v1], (closed, collapsed)) = (shape.domain(), topology(shape));
    let is_surface = matches!(shape, Shape::Surface(_));
    let (u, v) = (m.foot.u, m.foot.v);
    let on = [u == u0, u == u1, is_surface && v == v0, is_surface && v == v1];
    let (in_u, in_v) = (on[0] || on[1], on[2] || on[3]);
    // A place that stands for an area whose distances differ says so.
    let is_area = m.u[0] < m.u[1] || m.v[0] < m.v[1];
    let open = flag::CREASE | flag::TIE | if is_area { flag::NOT_PROVEN } else { 0 };
    let mut flags = found & open;
    let put = |flags: &mut u32, holds: bool, bit: u32| *flags |= if holds { bit } else { 0 };
    put(&mut flags, in_u || in_v, flag::EDGE);
    put(&mut flags, in_u && in_v, flag::CORNER);
    put(&mut flags, (in_u && closed[0]) || (in_v && closed[1]), flag::SEAM);
    put(&mut flags, (0..4).any(|k| on[k] && collapsed[k]), flag::COLLAPSED);
    // A collapsed edge is an arc of parameters and one point: both views are fine.
    let is_edge = flags & flag::COLLAPSED != 0 && matches!(m.kind, Kind::ArcU | Kind::ArcV);
    let is_continuum = if is_edge { found & flag::CONTINUUM != 0 } else { m.kind != Kind::Point };
    put(&mut flags, is_continuum, flag::CONTINUUM);
    flags
}

fn order_complaint(set: &FootSet, asked: &Asked) -> Option<String> {
    let key = |m: &Member| match asked {
        Asked::Extrema(_) => m.foot.distance,
        Asked::Preimage(_) => 0.0,
        Asked::OnLine(_) => asked.place(m.foot.point),
    };
    let slack =
        if matches!(asked, Asked::OnLine(_)) { 1e-14 * asked.magnitude() + 1e-14 } else { 0.0 };
    let in_order = |pair: &[Member]| {
        let (a, b) = (key(&pair[0]), key(&pair[1]));
        let places = (pair[0].foot.u, pair[0].foot.v) <= (pair[1].foot.u, pair[1].foot.v);
        a < b + slack || (a == b && places)
    };
    let pair = set.members.windows(2).find(|pair| !in_order(pair))?;
    Some(format!("order: {pair:?}"))
}

/// A member that must be there.
#[derive(Clone, Copy, Debug)]
pub struct Wanted {
    pub at: [f64; 2],
    pub kind: Kind,
    /// `None`: any.
    pub nature: Option<Nature>,
    pub distance: f64,
}

impl Wanted {
    pub fn point(at: [f64; 2], nature: Nature, distance: f64) -> Self {
        Self { at, kind: Kind::Point, nature: Some(nature), distance }
    }

    pub fn of(kind: Kind, at: [f64; 2], nature: Nature, distance: f64) -> Self {
        Self { at, kind, nature: Some(nature), distance }
    }

    /// A parameter of a preimage.
    pub fn at(at: [f64; 2]) -> Self {
        Self { at, kind: Kind::Point, nature: None, distance: 0.0 }
    }
}

/// How far found and wanted may differ.
#[derive(Clone, Copy)]
pub struct Limits {
    pub parameters: f64,
    pub distance: f64,
}

pub const CLOSE: Limits = Limits { parameters: 1e-8, distance: 1e-11 };

/// The first difference between a set and the one that is wanted, as sets.
pub fn difference(
    shape: &Shape,
    set: &FootSet,
    wanted: &[Wanted],
    limits: Limits,
) -> Option<String> {
    let all =
        || format!("found {:#?}, undecided {:?}, wanted {wanted:#?}", set.members, set.undecided);
    if !set.is_complete() {
        return Some(format!("incomplete: {}", all()));
    }
    if set.members.len() != wanted.len() {
        return Some(format!(
            "{} members instead of {}: {}",
            set.members.len(),
            wanted.len(),
            all()
        ));
    }
    let mut left: Vec<&Member> = set.members.iter().collect();
    for want in wanted {
        let Some(k) = left.iter().position(|m| agrees(shape, m, want, limits)) else {
            return Some(format!("no {want:?}: {}", all()));
        };
        left.remove(k);
    }
    None
}

fn agrees(shape: &Shape, m: &Member, want: &Wanted, limits: Limits) -> bool {
    let ([u0, u1, v0, v1], (closed, _)) = (shape.domain(), topology(shape));
    let near = |k: usize, found: f64, interval: [f64; 2], length: f64, is_arc: bool| {
        let x = want.at[k];
        let turns = if closed[k] { [0.0, length, -length] } else { [0.0; 3] };
        let whole = interval[1] - interval[0] >= length * (1.0 - 1e-12);
        if is_arc {
            whole
        } else {
            turns.iter().any(|t| (found + t - x).abs() <= limits.parameters * length)
        }
    };
    let (arc_u, arc_v) =
        (matches!(m.kind, Kind::ArcU | Kind::Region), matches!(m.kind, Kind::ArcV | Kind::Region));
    m.kind == want.kind
        && m.foot.flags & flag::NOT_PROVEN == 0
        && want.nature.is_none_or(|nature| nature == m.nature)
        && (m.foot.distance - want.distance).abs() <= limits.distance
        && near(0, m.foot.u, m.u, u1 - u0, arc_u)
        && (v0 == v1 || near(1, m.foot.v, m.v, v1 - v0, arc_v))
}

/// Collects what goes wrong and fails in the end with the number and the first few.
#[derive(Default)]
pub struct Log {
    asked: usize,
    left_out: usize,
    wrong: Vec<String>,
}

impl Log {
    pub fn put(&mut self, query: impl std::fmt::Debug, complaint: Option<String>) {
        self.asked += 1;
        if let Some(text) = complaint {
            self.wrong.push(format!("{query:?}: {text}"));
        }
    }

    pub fn leave_out(&mut self) {
        self.left_out += 1;
    }

    /// Fails when something was wrong, or more than this share was left out.
    pub fn close(self, name: &str, most_left_out: f64) {
        let (wrong, asked) = (self.wrong.len(), self.asked);
        println!("{name}: {asked} asked, {wrong} wrong, {} left out", self.left_out);
        let first = self.wrong.iter().take(3).cloned().collect::<Vec<_>>().join("\n");
        assert!(wrong == 0, "{name}: {wrong} of {asked} wrong, the first are\n{first}");
        let share = self.left_out as f64 / (self.left_out + asked).max(1) as f64;
        assert!(share <= most_left_out, "{name}: {share} left out");
    }
}

/// Extrema against a known set, laws included.
pub fn check_extrema(
    log: &mut Log,
    shape: &Shape,
    query: Vector,
    options: &ExtremaOptions,
    wanted: &[Wanted],
    limits: Limits,
) {
    let set = extrema(shape, query, options);
    let broken = difference(shape, &set, wanted, limits);
    log.put(query, broken.or_else(|| complaint(shape, &set, &Asked::Extrema(query))));
}

/// Preimages against a known set, laws included; `wanted` in any order.
pub fn check_preimage(
    log: &mut Log,
    shape: &Shape,
    query: Vector,
    wanted: &[Wanted],
    limits: Limits,
) {
    let set = preimage(shape, query, 0.0, &QueryOptions::default());
    let broken = difference(shape, &set, wanted, limits)
        .or_else(|| complaint(shape, &set, &Asked::Preimage(query)))
        .or_else(|| unenclosed(&set, wanted));
    log.put(query, broken);
}

/// A wanted place that lies in no interval of its kind.
fn unenclosed(set: &FootSet, wanted: &[Wanted]) -> Option<String> {
    let holds = |m: &Member, w: &Wanted| {
        let slack = |i: [f64; 2], x: f64| i[0] - 1e-15 <= x && x <= i[1] + 1e-15;
        (slack(m.u, w.at[0]) || w.kind == Kind::ArcU)
            && (slack(m.v, w.at[1]) || w.kind == Kind::ArcV)
    };
    let missing = wanted.iter().find(|w| !set.members.iter().any(|m| holds(m, w)))?;
    Some(format!("not enclosed: {missing:?} in {set:?}"))
}
