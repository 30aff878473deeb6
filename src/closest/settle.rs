//! The proof at once: the foot's normal is short enough that nothing else on the surface can be as near.

use super::certificate::slope_error;
use super::proof::Site;
use crate::bezier::Bidegree;
use crate::bounds::{HALF_ULP, Vector, cross, dot, norm, scaled, sub};
use crate::index::{Across, CurveReach, Edge, RINGS, Reach};
use crate::jet::{Jet1, Jet2};
use crate::simd::{Kernel, Lanes, Level, Row, Simd, WIDTH};

/// What must be left of `1 - 2 a K`: less says too little of feet that tie.
const LEAST_ROOM: f64 = 0.0625;

/// Where the cells of the surface are looked for: the query, how far feet may be that matter, the level.
pub type Around = (Vector, f64, Level);

/// A lower bound of the distance to the whole surface within `gap` of that of a place with this jet, where there is one (see
/// [`Reach`]): then nothing else is as near. `position`: how far the point may be off. With `around`, bounds of what is near the
/// place may do, where boxes show everything else to be farther than what matters.
pub fn settled(
    reach: &Reach,
    site: Site,
    jet: &Jet2,
    [position, gap]: [f64; 2],
    degree: Bidegree,
    around: Option<Around>,
) -> Option<f64> {
    let Site { piece: k, at } = site;
    let ends = ends(reach, site);
    let side = (0..4).find(|side| ends[side / 2] == Some(side % 2 == 1));
    let is_corner = ends.iter().all(Option::is_some);
    let rim = side.map_or(0.0, |side| reach.rim(k, at, side));
    let all = Ask { bends: reach.bend(k, at), rim };
    let near = |ring: usize| reach.near(k, at, ring).map(|bends| Ask { bends, rim: 0.0 });
    let distance = norm(jet.d);
    let is_hopeless = |ask: &Ask| ask.is_hopeless(distance + position, side);
    let around = around.filter(|_| match side {
        None => near(0).is_some_and(|ask| !is_hopeless(&ask)),
        Some(side) => reach.edge(k, at, side, 0).is_some(),
    });
    if around.is_none() && (is_corner || is_hopeless(&all)) {
        return None;
    }
    let look = Look::new([jet.d, jet.s, jet.t], jet.w[0], position, [degree.s, degree.t]);
    let seams = [reach.kink, reach.gap];
    // Not where the iteration has left more than the gap.
    let enough = |bound: &f64| *bound >= distance - gap;
    let bound = |ask: Ask| bound_by(&look, jet, position, side, ask, seams).filter(enough);
    let of_all = if is_corner { None } else { bound(all) };
    of_all.or_else(|| {
        let (query, far, level) = around?;
        let in_ring = |ring: usize| match side {
            None => near(ring).and_then(bound),
            Some(side) => {
                let (edge, widths) = reach.edge(k, at, side, ring)?;
                let bound = bound_by_edge(&look, jet, position, ends, (edge, widths), seams);
                bound.filter(enough)
            }
        };
        // The widest ring that settles leaves least to the boxes.
        let mut rings = (0..RINGS).rev().map(|ring| (ring, in_ring(ring)));
        let (ring, bound) = rings.find(|(_, bound)| bound.is_some())?;
        bound.filter(|_| reach.holds((k, at), ring, query, far, level))
    })
}

/// On which ends of the surface's parameters a place lies: the last ones or not.
fn ends(reach: &Reach, Site { piece, at }: Site) -> [Option<bool>; 2] {
    let sides = reach.sides(piece, at);
    [0, 1].map(|k| if sides[2 * k] { Some(false) } else { sides[2 * k + 1].then_some(true) })
}

/// Bounds K of the cell of a place: for queries on the side of the normal and on the other, and for the conormal where it lies on a
/// side of the surface.
struct Ask {
    bends: [f64; 2],
    rim: f64,
}

impl Ask {
    /// Whether a query so far off is not settled: most of those are known by what their side of the surface asks at least.
    fn is_hopeless(&self, distance: f64, side: Option<usize>) -> bool {
        let least = self.bends[0].min(self.bends[1]);
        match side {
            None => room(distance * least) < LEAST_ROOM,
            Some(_) => least == f64::INFINITY || self.rim == f64::INFINITY,
        }
    }
}

/// The bound that K gives.
///
/// With `q - f = a N + b o + e` (o the outward conormal, where the place is on a side of the surface, b >= 0):
/// `|x - q|^2 >= |q - f|^2 + r^2 room - 2 |e| r` for `r = |x - f|` and `room = 1 - 2 (|a| K + b K_o)`, so the square is less
/// than that of the foot by `|e|^2 / room` at most. A kink adds what it is worth for both parts to `|e|`, and so does a gap.
fn bound_by(
    look: &Look<f64>,
    jet: &Jet2,
    position: f64,
    side: Option<usize>,
    ask: Ask,
    seams: [f64; 2],
) -> Option<f64> {
    let &Look { d, slacks, speeds, off, height, .. } = look;
    let Some(side) = side else {
        let (asked, lost) = (look.asked(ask.bends, position), look.lost());
        return closed(closing([d, asked, lost, position], seams));
    };
    let tangents = [jet.s, jet.t];
    let (across, along) = (tangents[side / 2], tangents[1 - side / 2]);
    let rest = sub(across, scaled(along, dot(across, along) / dot(along, along)));
    let out = dot(jet.d, rest) / norm(rest) * if side % 2 == 0 { 1.0 } else { -1.0 };
    if out.is_nan() || out < 0.0 {
        return None;
    }
    // How far along the side the query is; an outward part that may be none may also be an inward one.
    let other = 1 - side / 2;
    let aside = dot(jet.d, along).abs() / speeds[other] + slacks[other];
    let aside = aside + if out < off { 2.0 * off } else { 0.0 };
    let asked = (height.abs() + off) * look.bend(ask.bends) + (out + off) * ask.rim;
    closed(closing([d, asked, aside, position], seams))
}

/// The bound that what is around a place on a side or in a corner gives, for the one query; see [`Edge`].
///
/// On a side `q - f = w + e`, e along it and `w.S_k = 0` for the parameter along it. In a corner there is no e.
fn bound_by_edge(
    look: &Look<f64>,
    jet: &Jet2,
    position: f64,
    ends: [Option<bool>; 2],
    (edge, widths): (&Edge, [f64; 2]),
    seams: [f64; 2],
) -> Option<f64> {
    let &Look { d, slacks, speeds, off, .. } = look;
    let tangents = [jet.s, jet.t];
    // The jet looks from the query to the foot: inward the distance grows.
    let inward = |last: bool| if last { -1.0 } else { 1.0 };
    let (mut fall, mut lost, mut corner) = ([0.0; 2], 0.0, None);
    match ends {
        [Some(a), Some(b)] => {
            for (k, last) in [a, b].into_iter().enumerate() {
                let slack = (slacks[k] + position) * speeds[k];
                fall[k] = inward(last) * dot(jet.d, tangents[k]) - slack;
            }
            corner = Some(inward(a) * inward(b));
        }
        [Some(last), None] | [None, Some(last)] => {
            let k = usize::from(ends[0].is_none());
            let (across, along) = (tangents[k], tangents[1 - k]);
            let rest = sub(across, scaled(along, dot(across, along) / dot(along, along)));
            let out = inward(last) * dot(jet.d, rest) / norm(rest);
            lost = dot(jet.d, along).abs() / speeds[1 - k] + slacks[1 - k];
            if out < off {
                // An outward part that may be none may also be an inward one.
                lost += 2.0 * off;
            }
            fall[k] = (out - off).max(0.0) * norm(rest);
            if out.is_nan() || out < 0.0 {
                return None;
            }
        }
        [None, None] => return None,
    }
    if !fall.iter().all(|fall| *fall >= 0.0) {
        return None;
    }
    let fall = [0, 1].map(|k| fall[k] * widths[k] * (1.0 - 1e-9));
    let asked = edge.asked(scaled(jet.d, -1.0), position + lost, fall, corner);
    closed(closing([d, asked, lost, position], seams))
}

/// What the jet of a place, or lane by lane of many, says about the query.
struct Look<V> {
    /// Distance.
    d: V,
    speeds: [V; 2],
    /// How far the query is aside of the normal, along the tangents, but for rounding.
    asides: [V; 2],
    /// The rounding.
    slacks: [V; 2],
    /// How far the height may be off.
    off: V,
    /// Of the query over the tangent plane, on the side of the normal.
    height: V,
    /// One less the cosine of the tangents.
    angle: V,
}

impl<V> Look<V> {
    #[inline(always)]
    fn new<const N: usize>([d, s, t]: [[V; 3]; 3], w: V, position: V, degrees: [usize; 2]) -> Self
    where
        V: Lanes<N>,
    {
        let (distance, normal) = (norm(d), cross(s, t));
        let (area, speeds) = (norm(normal), [norm(s), norm(t)]);
        // `slope_error` bounds more than the rounding of the product of d with a derivative, times w^2.
        let slack_s = slope_error(distance, speeds[0], w, position, degrees[0]);
        let slack_t = slope_error(distance, speeds[1], w, position, degrees[1]);
        let slacks = [slack_s / (w * w * speeds[0]), slack_t / (w * w * speeds[1])];
        let (across, along) = (area / speeds[1], area / speeds[0]);
        let turned = slacks[0] * speeds[0] / across + slacks[1] * speeds[1] / along;
        let off = position + V::splat(1e-9) * distance + V::splat(4.0) * turned;
        Self {
            d: distance,
            speeds,
            asides: [dot(d, s).abs() / speeds[0], dot(d, t).abs() / speeds[1]],
            slacks,
            off,
            // The jet looks from the query to the foot.
            height: V::splat(0.0) - dot(d, normal) / area,
            angle: V::splat(1.0) - dot(s, t).abs() / (speeds[0] * speeds[1]),
        }
    }

    /// The bound K of the side on which the query is; the greater one where that may be either.
    #[inline(always)]
    fn bend<const N: usize>(&self, [above, below]: [V; 2]) -> V
    where
        V: Lanes<N>,
    {
        let either = below.where_less(self.height, V::splat(0.0) - self.off, above.max(below));
        above.where_less(self.off, self.height, either)
    }

    /// `|a| K`, for a foot inside.
    #[inline(always)]
    fn asked<const N: usize>(&self, bends: [V; 2], position: V) -> V
    where
        V: Lanes<N>,
    {
        (self.d + position) * self.bend(bends)
    }

    /// `|e|`, for a foot inside.
    #[inline(always)]
    fn lost<const N: usize>(&self) -> V
    where
        V: Lanes<N>,
    {
        let (a, b) = (self.asides[0] + self.slacks[0], self.asides[1] + self.slacks[1]);
        ((a * a + b * b) / (self.angle * V::splat(1.0 - 1e-9))).sqrt()
    }
}

/// What `|a| K + b K_o` leaves.
#[inline(always)]
fn room<V: Lanes<N>, const N: usize>(asked: V) -> V {
    V::splat(1.0) - V::splat(2.0) * asked * V::splat(1.0 + 1e-12)
}

/// The bound from d, `|a| K + b K_o`, `|e|` and how far the point may be off; then the room, and all of `|e|`. A kink is counted
/// twice.
#[inline(always)]
fn closing<V: Lanes<N>, const N: usize>(
    [d, asked, lost, position]: [V; 4],
    [kink, gap]: [f64; 2],
) -> [V; 3] {
    let (zero, room) = (V::splat(0.0), room(asked));
    let lost = lost + V::splat(2.0 * kink) * d + V::splat(gap);
    let less = lost * lost / room + V::splat(4.0 * gap) * d;
    let square = (d - position).max(zero) * V::splat(1.0 - 8.0 * HALF_ULP);
    let bound = (square * square - less).max(zero).sqrt() * V::splat(1.0 - 4.0 * HALF_ULP);
    [bound, room, lost]
}

/// The bound, if there is one.
fn closed([bound, room, lost]: [f64; 3]) -> Option<f64> {
    // Not where the tangents vanish or agree.
    (room >= LEAST_ROOM && lost.is_finite()).then_some(bound)
}

/// Places inside of patches whose jets are to settle their queries: lanes of [`settled`].
#[derive(Clone, Copy, Debug, Default)]
pub struct Landed {
    /// d, s, t.
    pub jets: [[Row; 3]; 3],
    /// The weight.
    pub w: Row,
    /// How far the point may be off.
    pub position: Row,
    /// K for queries on the side of the normal, and on the other.
    pub bends: [Row; 2],
}

/// As [`settled`] for each lane: the bounds, and those distances. The places are inside of their patches.
pub fn settled_together(
    reach: &Reach,
    landed: &Landed,
    degree: Bidegree,
    level: Level,
) -> [Option<[f64; 2]>; WIDTH] {
    let settle = Settle { landed, degrees: [degree.s, degree.t], kink: reach.kink, gap: reach.gap };
    let [bound, room, lost, d] = level.run(settle);
    std::array::from_fn(|q| closed([bound[q], room[q], lost[q]]).map(|bound| [bound, d[q]]))
}

struct Settle<'a> {
    landed: &'a Landed,
    degrees: [usize; 2],
    kink: f64,
    gap: f64,
}

impl Kernel for Settle<'_> {
    type Out = [Row; 4];

    #[inline(always)]
    fn run<S: Simd>(self, _: S) -> [Row; 4] {
        let Landed { jets, w, position, bends } = self.landed;
        let mut vectors = [[S::F8::splat(0.0); 3]; 3];
        for k in 0..3 {
            for c in 0..3 {
                vectors[k][c] = S::F8::load(&jets[k][c]);
            }
        }
        let position = S::F8::load(position);
        let look = Look::new(vectors, S::F8::load(w), position, self.degrees);
        let asked = look.asked([S::F8::load(&bends[0]), S::F8::load(&bends[1])], position);
        let lost = look.lost();
        let [bound, room, lost] = closing([look.d, asked, lost, position], [self.kink, self.gap]);
        [bound.array(), room.array(), lost.array(), look.d.array()]
    }
}

/// As [`settled`], for a curve.
pub fn settled_on_curve(
    reach: Option<&CurveReach>,
    site: Site,
    jet: &Jet1,
    position: f64,
    degree: usize,
    gap: f64,
) -> Option<f64> {
    let bound = bound_on_curve(reach?, site, jet, position, degree);
    bound.filter(|b| *b >= norm(jet.d) - gap)
}

/// A lower bound of the distance to the whole curve, if the place of the jet gives one.
///
/// With `q - f = n + b o + e` (n across, o the outward tangent at an end, b >= 0, e along the curve) as for a surface;
/// a tangent that breaks by `kink` adds to `|e|` what it is worth for both parts of n, and so does a gap between ends.
fn bound_on_curve(
    reach: &CurveReach,
    Site { piece: k, at }: Site,
    jet: &Jet1,
    position: f64,
    degree: usize,
) -> Option<f64> {
    let aim = Aim::new([jet.d, jet.s], jet.w[0], position, degree);
    let mut asked = reach.across(k, at[0]).asked(aim.tangent, aim.across, aim.off);
    let mut lost = aim.lost();
    if let Some((side, bend)) = reach.end(k, at[0]) {
        let out = if side == 0 { -aim.along } else { aim.along };
        if out >= 0.0 {
            asked += (out + aim.off) * bend;
            // An outward part that may be none may also be an inward one.
            lost = aim.slack + if out < aim.off { 2.0 * aim.off } else { 0.0 };
        }
    }
    closed(closing([aim.d, asked, lost, position], [KINKS * reach.kink, reach.gap]))
}

/// How often a kink of a curve counts, of twice.
const KINKS: f64 = 0.75;

/// What the jet of a place of a curve, or lane by lane of many, says about the query.
struct Aim<V> {
    /// Distance.
    d: V,
    /// Unit vector.
    tangent: [V; 3],
    /// The rounding of what is along it.
    slack: V,
    /// Of the query along the tangent.
    along: V,
    /// Of the query across, and how far that may be off.
    across: [V; 3],
    off: V,
}

impl<V> Aim<V> {
    #[inline(always)]
    fn new<const N: usize>([d, s]: [[V; 3]; 2], w: V, position: V, degree: usize) -> Self
    where
        V: Lanes<N>,
    {
        let (distance, speed, zero) = (norm(d), norm(s), V::splat(0.0));
        let slack = slope_error(distance, speed, w, position, degree) / (w * w * speed);
        let inverse = V::splat(1.0) / speed;
        let tangent = [s[0] * inverse, s[1] * inverse, s[2] * inverse];
        let along = zero - dot(d, tangent);
        // The jet looks from the query to the foot.
        let across = [
            zero - (d[0] + tangent[0] * along),
            zero - (d[1] + tangent[1] * along),
            zero - (d[2] + tangent[2] * along),
        ];
        let off = position + V::splat(1e-9) * distance + V::splat(4.0) * slack;
        Self { d: distance, tangent, slack, along, across, off }
    }

    /// `|e|`, for a foot inside.
    #[inline(always)]
    fn lost<const N: usize>(&self) -> V
    where
        V: Lanes<N>,
    {
        self.along.abs() + self.slack
    }
}

/// Places inside of segments whose jets are to settle their queries: lanes of [`settled_on_curve`].
#[derive(Clone, Copy, Debug, Default)]
pub struct LandedOnCurve {
    /// d, s.
    pub jets: [[Row; 3]; 2],
    /// The weight.
    pub w: Row,
    /// How far the point may be off.
    pub position: Row,
    /// What the cells say.
    pub across: Across<Row>,
}

/// As [`settled_on_curve`] for each lane: the bounds, and those distances. The places are inside of their segments.
pub fn settled_on_curve_together(
    reach: &CurveReach,
    landed: &LandedOnCurve,
    degree: usize,
    level: Level,
) -> [Option<[f64; 2]>; WIDTH] {
    let settle = SettleOnCurve { landed, degree, kink: KINKS * reach.kink, gap: reach.gap };
    let [bound, room, lost, d] = level.run(settle);
    std::array::from_fn(|q| closed([bound[q], room[q], lost[q]]).map(|bound| [bound, d[q]]))
}

struct SettleOnCurve<'a> {
    landed: &'a LandedOnCurve,
    degree: usize,
    kink: f64,
    gap: f64,
}

impl Kernel for SettleOnCurve<'_> {
    type Out = [Row; 4];

    #[inline(always)]
    fn run<S: Simd>(self, _: S) -> [Row; 4] {
        let LandedOnCurve { jets, w, position, across } = self.landed;
        let (mut vectors, mut axis) = ([[S::F8::splat(0.0); 3]; 2], [S::F8::splat(0.0); 3]);
        for c in 0..3 {
            vectors[0][c] = S::F8::load(&jets[0][c]);
            vectors[1][c] = S::F8::load(&jets[1][c]);
            axis[c] = S::F8::load(&across.axis[c]);
        }
        let mut bends = [S::F8::splat(0.0); 4];
        for k in 0..4 {
            bends[k] = S::F8::load(&across.bends[k]);
        }
        let position = S::F8::load(position);
        let aim = Aim::new(vectors, S::F8::load(w), position, self.degree);
        let asked = Across { axis, bends }.asked(aim.tangent, aim.across, aim.off);
        let [bound, room, lost] =
            closing([aim.d, asked, aim.lost(), position], [self.kink, self.gap]);
        [bound.array(), room.array(), lost.array(), aim.d.array()]
    }
}
