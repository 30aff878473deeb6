//! A surface as Bezier patches that are halved on demand, each part with what the tests of a pair ask of it.
//!
//! ```text
//!   patch ── halved along the direction that bends more ── part ── part ...        kept, so that partners share them
//!   part: box and poles on [0, 1]^2        bends on [-1/4, 5/4]^2, the reach of a graph that is proven (`pair`)
//! ```
//!
//! A part's own parameters run over [-1, 1]: slopes are lengths per half width. Rounding is counted beforehand: positions are off by
//! at most [`Pieces::error`], second derivatives by what [`Bends::spread`] holds.

use super::bends::{Bends, Pole, REACH, bends};
use crate::bezier::extraction;
use crate::bounds::{Aabb, HALF_ULP, Vector, add, cross, norm, scaled, sub};
use crate::knots::Knots;
use crate::surface::Surface;
use std::cell::OnceCell;

/// One Bezier patch.
pub struct Patch {
    /// Parameters of u.
    pub u: [f64; 2],
    /// Parameters of v.
    pub v: [f64; 2],
    /// Homogeneous poles around `center`.
    poles: Box<[Pole]>,
    center: Vector,
    /// Its first corner and its slopes, when it is an affine map up to rounding.
    affine: Option<[Vector; 3]>,
    /// Its whole as a part.
    pub root: u32,
    /// Which of its sides u low, u high, v low, v high are one point.
    pub collapsed: [bool; 4],
}

/// A part of a patch.
pub struct Part {
    /// The patch.
    pub patch: u32,
    /// Its box in the unit parameters of the patch.
    pub low: [f64; 2],
    /// The other end.
    pub high: [f64; 2],
    /// Homogeneous poles around `center`.
    poles: Box<[Pole]>,
    center: Vector,
    /// Poles in space: their hull holds the part.
    pub hull: Box<[Vector]>,
    /// Box of `hull`.
    pub aabb: Aabb,
    /// The point in the middle.
    pub at: Vector,
    /// Slopes in the middle.
    pub slope: [Vector; 2],
    /// Unit normal in the middle, or zero.
    pub normal: Vector,
    bounds: OnceCell<Bounds>,
    /// The collapsed side of the patch that it touches: 0 to 3.
    pub pole: Option<usize>,
    degree: [usize; 2],
    rational: bool,
    radius: f64,
    /// In the middle.
    weight: f64,
    halves: Option<[u32; 2]>,
}

/// How a part bends, found when a test asks for it: most parts are told apart by their hulls.
struct Bounds {
    bends: Option<Bends>,
    bend: f64,
}

/// A surface in pieces.
pub struct Pieces {
    degree: [usize; 2],
    rational: bool,
    /// The patches; (a, b) at `a * columns + b`.
    pub patches: Vec<Patch>,
    /// Patches in v.
    pub columns: usize,
    /// Parts made so far.
    pub parts: Vec<Part>,
    /// How far a position may be off.
    pub error: f64,
}

/// How far a pole of a part may be off, of patches whose poles are at most `radius` from their centres and `size` from the origin;
/// `extracted`: degrees of the directions whose nets are not Bezier nets from the start; `most`: the greater degree: docs/rounding.md, section 23.
fn rounding((extracted, most): (usize, usize), rational: bool, radius: f64, size: f64) -> f64 {
    let (net, halving) = (6 * extracted + 4, most + 2);
    // A weight has as much, and is divided by.
    let (net, halving) = if rational { (2 * net + 1, 2 * halving + 2) } else { (net, halving) };
    HALF_ULP * ((net + 10 * halving) as f64 * radius + 4.0 * size)
}

/// A span, its ends, and the matrix that takes its poles to Bezier poles.
type Extracted = (usize, [f64; 2], Vec<f64>);

fn extracted(knots: &Knots) -> Vec<Extracted> {
    let size = knots.degree() + 1;
    let make = |span: usize| {
        let ends = [knots.values()[span], knots.values()[span + 1]];
        let mut matrix = vec![0.0; size * size];
        extraction(knots, span, ends, &mut matrix);
        (span, ends, matrix)
    };
    knots.spans().map(make).collect()
}

impl Pieces {
    /// Cuts a surface at its knots.
    pub fn new(surface: &Surface) -> Self {
        let (ku, kv) = (surface.knots_u(), surface.knots_v());
        let (us, vs) = (extracted(ku), extracted(kv));
        let degree = [ku.degree(), kv.degree()];
        let columns = vs.len();
        let mut pieces = Self {
            degree,
            rational: surface.is_rational(),
            patches: Vec::with_capacity(us.len() * columns),
            columns,
            parts: Vec::new(),
            error: 0.0,
        };
        let size = surface.poles().iter().fold(0.0f64, |m, &p| m.max(norm(p)));
        let mut nets = Vec::with_capacity(us.len() * columns);
        for (span_u, _, mu) in &us {
            for (span_v, _, mv) in &vs {
                nets.push(local_poles(surface, [*span_u, *span_v], mu, mv));
            }
        }
        let radius = nets.iter().map(|(_, _, radius)| *radius).fold(0.0, f64::max);
        // The extraction of a Bezier net is the unit matrix, which rounds nothing.
        let identity = |(_, _, matrix): &Extracted, p: usize| {
            matrix.iter().enumerate().all(|(k, x)| *x == f64::from(u8::from(k % (p + 2) == 0)))
        };
        let rounds = |spans: &[Extracted], p: usize| {
            if spans.iter().all(|span| identity(span, p)) { 0 } else { p }
        };
        let degrees = (rounds(&us, degree[0]) + rounds(&vs, degree[1]), degree[0].max(degree[1]));
        pieces.error = rounding(degrees, pieces.rational, radius, size);
        let edges = [0, 1, 2, 3].map(|k| surface.collapsed_spread(k) <= 4.0 * pieces.error);
        for (i, (_, u, _)) in us.iter().enumerate() {
            for (j, (_, v, _)) in vs.iter().enumerate() {
                let (poles, center, _) = std::mem::take(&mut nets[i * columns + j]);
                let root = pieces.parts.len() as u32;
                let patch = pieces.patches.len() as u32;
                let at = [i == 0, i + 1 == us.len(), j == 0, j + 1 == columns];
                let collapsed = [0, 1, 2, 3].map(|k| at[k] && edges[k]);
                pieces.patches.push(Patch {
                    u: *u,
                    v: *v,
                    affine: affine(&poles, degree, pieces.rational, 0.25 * pieces.error),
                    poles: poles.clone(),
                    center,
                    root,
                    collapsed,
                });
                let part = pieces.part(patch, [0.0; 2], [1.0; 2], poles, center);
                pieces.parts.push(part);
            }
        }
        pieces
    }

    fn part(
        &self,
        patch: u32,
        low: [f64; 2],
        high: [f64; 2],
        poles: Box<[Pole]>,
        c: Vector,
    ) -> Part {
        let hull: Box<[Vector]> = if self.rational {
            poles.iter().map(|p| add(c, [p[0] / p[3], p[1] / p[3], p[2] / p[3]])).collect()
        } else {
            poles.iter().map(|p| add(c, [p[0], p[1], p[2]])).collect()
        };
        let mut aabb = Aabb::EMPTY;
        hull.iter().for_each(|&p| aabb.include(p));
        let [p, pu, pv] = homogeneous(&poles, self.degree, [0.5; 2]);
        let middle = [0, 1, 2].map(|k| p[k] / p[3]);
        let slope = [pu, pv].map(|d| [0, 1, 2].map(|k| 0.5 * (d[k] - middle[k] * d[3]) / p[3]));
        let normal = cross(slope[0], slope[1]);
        let length = norm(normal);
        let flat = length <= 1e-14 * norm(slope[0]) * norm(slope[1]) || length == 0.0;
        let radius = norm([0, 1, 2].map(|k| (aabb.high[k] - c[k]).max(c[k] - aabb.low[k])));
        let on = [low[0] == 0.0, high[0] == 1.0, low[1] == 0.0, high[1] == 1.0];
        let pole = (0..4).find(|&k| on[k] && self.patches[patch as usize].collapsed[k]);
        Part {
            pole,
            patch,
            low,
            high,
            hull,
            aabb,
            at: add(c, middle),
            slope,
            normal: if flat { [0.0; 3] } else { scaled(normal, 1.0 / length) },
            bounds: OnceCell::new(),
            degree: self.degree,
            rational: self.rational,
            radius,
            weight: p[3],
            halves: None,
            center: c,
            poles,
        }
    }

    /// The halves of a part, made now if they were not there.
    pub fn halves(&mut self, k: u32) -> [u32; 2] {
        let part = &self.parts[k as usize];
        if let Some(halves) = part.halves {
            return halves;
        }
        let (patch, d) = (part.patch, part.direction() as usize);
        let (mut low, mut high) = (part.poles.clone(), part.poles.clone());
        halve(&mut low, &mut high, self.degree, d);
        let middle = 0.5 * (part.low[d] + part.high[d]);
        let (mut end, mut start) = (part.high, part.low);
        end[d] = middle;
        start[d] = middle;
        let (first, last) = (part.low, part.high);
        let center = part.center;
        // Around a pole of its own, so that rounding is relative to the part and not to the patch.
        let recentred = |mut net: Box<[Pole]>| {
            let p = net[net.len() / 2];
            let moved = [0, 1, 2].map(|k| center[k] + p[k] / p[3]);
            // What the centre moves by, as it was rounded: exact where that is less than the centre is from the origin.
            let by = sub(moved, center);
            for q in &mut net {
                for k in 0..3 {
                    q[k] -= by[k] * q[3];
                }
            }
            (net, moved)
        };
        let (low, c0) = recentred(low);
        let (high, c1) = recentred(high);
        let halves =
            [self.part(patch, first, end, low, c0), self.part(patch, start, last, high, c1)];
        let at = self.parts.len() as u32;
        self.parts.extend(halves);
        self.parts[k as usize].halves = Some([at, at + 1]);
        [at, at + 1]
    }

    /// Point and slopes of a patch at unit parameters, a little outside too.
    pub fn jet(&self, patch: u32, at: [f64; 2]) -> [Vector; 3] {
        let patch = &self.patches[patch as usize];
        if let Some([o, du, dv]) = patch.affine {
            let x = add(scaled(du, at[0]), scaled(dv, at[1]));
            return [add(patch.center, add(o, x)), du, dv];
        }
        let [p, pu, pv] = homogeneous(&patch.poles, self.degree, at);
        let x = [0, 1, 2].map(|k| p[k] / p[3]);
        let slope = |d: Pole| [0, 1, 2].map(|k| (d[k] - x[k] * d[3]) / p[3]);
        [add(patch.center, x), slope(pu), slope(pv)]
    }

    /// The point of a patch at unit parameters.
    pub fn position(&self, patch: u32, at: [f64; 2]) -> Vector {
        let patch = &self.patches[patch as usize];
        if let Some([o, du, dv]) = patch.affine {
            return add(patch.center, add(o, add(scaled(du, at[0]), scaled(dv, at[1]))));
        }
        let p = match self.degree {
            [3, 3] => point_of::<4, 4>(&patch.poles, at),
            [2, 2] => point_of::<3, 3>(&patch.poles, at),
            [2, 1] => point_of::<3, 2>(&patch.poles, at),
            degree => homogeneous(&patch.poles, degree, at)[0],
        };
        add(patch.center, [0, 1, 2].map(|k| p[k] / p[3]))
    }

    /// Widths of a patch in the caller's parameters.
    pub fn width(&self, patch: u32) -> [f64; 2] {
        let patch = &self.patches[patch as usize];
        [patch.u[1] - patch.u[0], patch.v[1] - patch.v[0]]
    }

    /// The caller's parameters of a place in a patch.
    pub fn global(&self, patch: u32, at: [f64; 2]) -> [f64; 2] {
        let patch = &self.patches[patch as usize];
        let on = |[a, b]: [f64; 2], s: f64| {
            if s <= 0.5 { a + s * (b - a) } else { b - (1.0 - s) * (b - a) }
        };
        [on(patch.u, at[0]), on(patch.v, at[1])].map(|x| x)
    }

    /// The unit parameters in a patch of the caller's parameters.
    pub fn local(&self, patch: u32, at: [f64; 2]) -> [f64; 2] {
        let patch = &self.patches[patch as usize];
        let on = |[a, b]: [f64; 2], u: f64| {
            if u - a <= b - u { (u - a) / (b - a) } else { 1.0 - (b - u) / (b - a) }
        };
        [on(patch.u, at[0]), on(patch.v, at[1])]
    }

    /// The patches that hold a place, those beside a knot line both; `room`: how near that is, as shares of a patch.
    pub fn patches_at(&self, at: [f64; 2], room: [f64; 2]) -> Vec<u32> {
        let near = |[a, b]: [f64; 2], u: f64, room: f64| {
            let slack = room * (b - a);
            a - slack <= u && u <= b + slack
        };
        let mut found = Vec::new();
        let beside = |k: usize| {
            (k..k + self.columns)
                .filter(|&k| near(self.patches[k].v, at[1], room[1]))
                .map(|k| k as u32)
        };
        for row in (0..self.patches.len()).step_by(self.columns) {
            if near(self.patches[row].u, at[0], room[0]) {
                found.extend(beside(row));
            }
        }
        found
    }
}

impl Part {
    /// Which parameter to halve: the one along which it bends more; the longer one where nothing bends.
    fn direction(&self) -> u8 {
        // Toward a collapsed edge parts get shorter, not narrower.
        if let Some(side) = self.pole {
            return side as u8 / 2;
        }
        let (low, high, slope) = (self.low, self.high, self.slope.map(norm));
        let second = match self.bends() {
            Some(bends) => [bends.size[0], bends.size[2]],
            None => slope,
        };
        let length = slope[0] + slope[1];
        let share = [0, 1].map(|k| high[k] - low[k]);
        // A part that is much longer one way than the other in its patch serves no test.
        if share[0] > 64.0 * share[1] && slope[0] > 0.0 {
            return 0;
        }
        if share[1] > 64.0 * share[0] && slope[1] > 0.0 {
            return 1;
        }
        if second[0].max(second[1]) <= 1e-3 * length {
            u8::from(slope[1] > slope[0])
        } else {
            u8::from(second[1] > second[0])
        }
    }

    /// Second derivatives over the reach; `None` where a weight is not positive there.
    pub fn bends(&self) -> Option<&Bends> {
        self.bounds().bends.as_ref()
    }

    /// How far slopes over the reach may differ from those in the middle, in length.
    pub fn bend(&self) -> f64 {
        self.bounds().bend
    }

    /// Sine of the angle by which normals may turn from that in the middle; 1 and more: any.
    pub fn tilt(&self) -> f64 {
        let Some(bends) = self.bends() else { return f64::INFINITY };
        let slopes = self.slope.map(norm);
        let change = [bends.size[0] + bends.size[1], bends.size[1] + bends.size[2]];
        let turned = change[0] * slopes[1] + slopes[0] * change[1] + change[0] * change[1];
        // Of a length that is none: not a number, or infinite.
        let tilt = turned / norm(cross(self.slope[0], self.slope[1]));
        if tilt.is_nan() { f64::INFINITY } else { tilt }
    }

    fn bounds(&self) -> &Bounds {
        self.bounds.get_or_init(|| {
            let bends = self.bounded();
            let bend = bends.as_ref().map_or(f64::INFINITY, |bends| {
                REACH * (bends.size[0] + 2.0 * bends.size[1] + bends.size[2])
            });
            Bounds { bends, bend }
        })
    }

    fn bounded(&self) -> Option<Bends> {
        let mut few = [[0.0; 4]; 16];
        let mut many = Vec::new();
        let count = self.poles.len();
        let net: &mut [Pole] = if count <= few.len() {
            &mut few[..count]
        } else {
            many.resize(count, [0.0; 4]);
            &mut many
        };
        // Around the point in the middle, where the weight is made one.
        let (middle, over) = (sub(self.at, self.center), 1.0 / self.weight);
        for (to, q) in net.iter_mut().zip(&self.poles) {
            for k in 0..3 {
                to[k] = (q[k] - middle[k] * q[3]) * over;
            }
            to[3] = q[3] * over;
        }
        bends(net, self.degree, self.rational, self.radius)
    }
}

/// The Bezier net of a pair of spans around the middle of the poles that act there, that middle, and how far these are from it.
fn local_poles(
    surface: &Surface,
    spans: [usize; 2],
    mu: &[f64],
    mv: &[f64],
) -> (Box<[Pole]>, Vector, f64) {
    let (p, q) = (surface.knots_u().degree(), surface.knots_v().degree());
    let columns = surface.knots_v().pole_count();
    let at = |i: usize, j: usize| (spans[0] - p + i) * columns + spans[1] - q + j;
    let mut around = Aabb::EMPTY;
    for i in 0..=p {
        (0..=q).for_each(|j| around.include(surface.poles()[at(i, j)]));
    }
    let center = scaled(add(around.low, around.high), 0.5);
    let weights = surface.weights().filter(|_| surface.is_rational());
    let (mut half, mut radius) = (vec![[0.0; 4]; (p + 1) * (q + 1)], 0.0f64);
    for i in 0..=p {
        for j in 0..=q {
            for l in 0..=q {
                let k = at(i, l);
                let w = weights.map_or(1.0, |w| w[k]) * mv[j * (q + 1) + l];
                let x = sub(surface.poles()[k], center);
                radius = radius.max(norm(x));
                let sum = &mut half[i * (q + 1) + j];
                for c in 0..3 {
                    sum[c] += w * x[c];
                }
                sum[3] += w;
            }
        }
    }
    let mut poles = vec![[0.0; 4]; half.len()];
    for i in 0..=p {
        for j in 0..=q {
            for l in 0..=p {
                for c in 0..4 {
                    poles[i * (q + 1) + j][c] += mu[i * (p + 1) + l] * half[l * (q + 1) + j][c];
                }
            }
            if weights.is_none() {
                poles[i * (q + 1) + j][3] = 1.0;
            }
        }
    }
    (poles.into(), center, radius)
}

/// First corner and slopes of a net that is an affine map but for `error`.
fn affine(poles: &[Pole], [p, q]: [usize; 2], rational: bool, error: f64) -> Option<[Vector; 3]> {
    let of = |k: usize| [poles[k][0], poles[k][1], poles[k][2]];
    let (o, u, v) = (of(0), of(p * (q + 1)), of(q));
    let (du, dv) = (sub(u, o), sub(v, o));
    let fits = |k: usize| {
        let (i, j) = ((k / (q + 1)) as f64 / p as f64, (k % (q + 1)) as f64 / q as f64);
        let off = sub(of(k), add(o, add(scaled(du, i), scaled(dv, j))));
        off.iter().all(|x| x.abs() <= error)
    };
    (!rational && (0..poles.len()).all(fits)).then_some([o, du, dv])
}

/// Homogeneous point and derivatives by the unit parameters. The usual degrees are literals, so that loops have fixed lengths.
fn homogeneous(poles: &[Pole], degree: [usize; 2], at: [f64; 2]) -> [Pole; 3] {
    match degree {
        [3, 3] => fixed::<4, 4>(poles, at),
        [2, 2] => fixed::<3, 3>(poles, at),
        [2, 1] => fixed::<3, 2>(poles, at),
        [1, 1] => fixed::<2, 2>(poles, at),
        [0..=3, 0..=3] => summed::<4>(poles, degree, at),
        _ => summed::<32>(poles, degree, at),
    }
}

/// The same for N x M poles.
fn fixed<const N: usize, const M: usize>(poles: &[Pole], at: [f64; 2]) -> [Pole; 3] {
    let ([b, db], [c, dc]) = (bernstein_of::<N>(at[0]), bernstein_of::<M>(at[1]));
    let mut sum = [[0.0; 4]; 3];
    let (rows, _) = poles.as_chunks::<M>();
    for (row, (b, db)) in rows.iter().zip(b.into_iter().zip(db)) {
        let (mut x, mut dx) = ([0.0; 4], [0.0; 4]);
        for j in 0..M {
            for k in 0..4 {
                x[k] += c[j] * row[j][k];
                dx[k] += dc[j] * row[j][k];
            }
        }
        for k in 0..4 {
            sum[0][k] += b * x[k];
            sum[1][k] += db * x[k];
            sum[2][k] += b * dx[k];
        }
    }
    sum
}

/// The homogeneous point alone, of N x M poles.
fn point_of<const N: usize, const M: usize>(poles: &[Pole], at: [f64; 2]) -> Pole {
    let ([b, _], [c, _]) = (bernstein_of::<N>(at[0]), bernstein_of::<M>(at[1]));
    let mut sum = [0.0; 4];
    for (row, b) in poles.as_chunks::<M>().0.iter().zip(b) {
        for (pole, c) in row.iter().zip(c) {
            (0..4).for_each(|k| sum[k] += b * c * pole[k]);
        }
    }
    sum
}

fn summed<const LEN: usize>(poles: &[Pole], degree: [usize; 2], at: [f64; 2]) -> [Pole; 3] {
    let [b, db] = bernstein::<LEN>(degree[0], at[0]);
    let [c, dc] = bernstein::<LEN>(degree[1], at[1]);
    let mut sum = [[0.0; 4]; 3];
    for (i, row) in poles.chunks_exact(degree[1] + 1).enumerate() {
        let (mut x, mut dx) = ([0.0; 4], [0.0; 4]);
        for (j, pole) in row.iter().enumerate() {
            for k in 0..4 {
                x[k] += c[j] * pole[k];
                dx[k] += dc[j] * pole[k];
            }
        }
        for k in 0..4 {
            sum[0][k] += b[i] * x[k];
            sum[1][k] += db[i] * x[k];
            sum[2][k] += b[i] * dx[k];
        }
    }
    sum
}

/// Bernstein basis of degree N - 1 and its derivative.
#[inline(always)]
fn bernstein_of<const N: usize>(s: f64) -> [[f64; N]; 2] {
    if N != 4 {
        return bernstein::<N>(N - 1, s);
    }
    let (mut values, mut slopes, r) = ([0.0; N], [0.0; N], 1.0 - s);
    let (rr, rs, ss) = (r * r, r * s, s * s);
    values.copy_from_slice(&[r * rr, 3.0 * s * rr, 3.0 * r * ss, s * ss]);
    slopes.copy_from_slice(&[-3.0 * rr, 3.0 * rr - 6.0 * rs, 6.0 * rs - 3.0 * ss, 3.0 * ss]);
    [values, slopes]
}

/// Bernstein basis of degree `n` and its derivative.
#[inline(always)]
fn bernstein<const LEN: usize>(n: usize, s: f64) -> [[f64; LEN]; 2] {
    let (mut values, mut slopes) = ([0.0; LEN], [0.0; LEN]);
    values[0] = 1.0;
    for level in 1..=n {
        if level == n {
            slopes[0] = -(n as f64) * values[0];
            for i in 1..n {
                slopes[i] = n as f64 * (values[i - 1] - values[i]);
            }
            slopes[n] = n as f64 * values[n - 1];
        }
        values[level] = s * values[level - 1];
        for i in (1..level).rev() {
            values[i] = (1.0 - s) * values[i] + s * values[i - 1];
        }
        values[0] *= 1.0 - s;
    }
    [values, slopes]
}

/// Splits a net at the middle of a direction.
fn halve(low: &mut [Pole], high: &mut [Pole], degree: [usize; 2], direction: usize) {
    match (degree, direction) {
        ([3, 3], 0) => halve_along(low, high, [3, 3], 0),
        ([3, 3], _) => halve_along(low, high, [3, 3], 1),
        _ => halve_along(low, high, degree, direction),
    }
}

#[inline(always)]
fn halve_along(low: &mut [Pole], high: &mut [Pole], degree: [usize; 2], direction: usize) {
    let width = degree[1] + 1;
    let (n, step, lines) =
        if direction == 0 { (degree[0], width, width) } else { (degree[1], 1, degree[0] + 1) };
    for line in 0..lines {
        let at = |k: usize| if direction == 0 { line + k * step } else { line * width + k };
        for level in 0..n {
            high[at(n - level)] = low[at(n)];
            for k in (level + 1..=n).rev() {
                for c in 0..4 {
                    low[at(k)][c] = 0.5 * (low[at(k)][c] + low[at(k - 1)][c]);
                }
            }
        }
        high[at(0)] = low[at(n)];
    }
}
