//! The walk over the boxes of one piece.

use crate::bezier::{Bidegree, convolve_square, cut_2d, scale_down_2d, scale_up_2d};
use crate::bounds::{HALF_ULP, Vector, dot, extent, norm, scaled, sub};
use crate::closest::{convexity, free_slope, slope_error, squared_error};
use crate::index::product_steps;
use crate::jet::{BezierPatch, BezierSegment, Jet1, Jet2, Lane};
use crate::refine::{CurveJets, Method, SurfaceJets, foot_on_curve, foot_on_surface};
use crate::simd::Level;

/// Boxes narrower than this are not halved any more.
const LEAST_WIDTH: f64 = 1e-14;

/// A box whose image is smaller than this share of the tolerance is kept as a whole when its middle is within the
/// tolerance (the first), or in any case (the second).
const SMALL_IMAGE: [f64; 2] = [0.5, 1.0 / 64.0];

/// A part of the answer: an area in the caller's parameters, its best place and the distance there.
#[derive(Clone, Copy, Debug)]
pub struct Part {
    /// u0, u1, v0, v1.
    pub area: [f64; 4],
    /// Best place found in it.
    pub at: [f64; 2],
    /// Distance there.
    pub distance: f64,
    /// Least and greatest length along the line, from the base point, of a box that holds the part.
    pub along: [f64; 2],
}

/// A piece as the target sees it.
#[derive(Clone, Copy)]
pub struct Sheet<'a> {
    /// Poles, component by component.
    pub poles: &'a [f64],
    /// The same, pole by pole.
    pub lanes: &'a [Lane],
    /// Vector instructions.
    pub level: Level,
    /// Degrees; a curve has degree 0 in s.
    pub degree: Bidegree,
    /// Whether weights are there.
    pub rational: bool,
    /// The target's base point in the piece's coordinates.
    pub base: Vector,
    /// The direction of a line.
    pub direction: Option<Vector>,
    /// Part of the line that counts, from the base point on.
    pub reach: [f64; 2],
    /// Searched part in local parameters.
    pub range: [f64; 4],
    /// How far `r / W` may be off.
    pub position: f64,
    /// The tolerance.
    pub tolerance: f64,
}

/// What a walk works with and leaves, areas in local parameters. Reused: nothing is allocated once it has grown.
#[derive(Clone, Debug, Default)]
pub struct Memory {
    /// Parts of the answer.
    pub parts: Vec<Part>,
    /// Areas that were not decided.
    pub undecided: Vec<[f64; 4]>,
    waiting: Vec<[f64; 4]>,
    net: Net,
}

/// Searches a piece; what it finds replaces what the memory held.
pub fn search(sheet: &Sheet, memory: &mut Memory, budget: &mut u64) {
    let Memory { parts, undecided, waiting, net } = memory;
    parts.clear();
    undecided.clear();
    waiting.clear();
    waiting.push(sheet.range);
    while let Some(area) = waiting.pop() {
        net.load(sheet, area);
        match judge(sheet, net, area) {
            Verdict::Closed => {}
            Verdict::Part(mut part) => {
                if sheet.direction.is_some() {
                    net.load(sheet, part.area);
                    part.along = net.along;
                }
                parts.push(part);
            }
            Verdict::Again(smaller) => waiting.push(smaller),
            Verdict::Halve(k) => {
                let middle = 0.5 * (area[2 * k] + area[2 * k + 1]);
                let stuck = middle <= area[2 * k] || middle >= area[2 * k + 1];
                if *budget == 0 || stuck || area[2 * k + 1] - area[2 * k] < LEAST_WIDTH {
                    undecided.push(area);
                    continue;
                }
                *budget -= 1;
                let mut halves = [area; 2];
                halves[0][2 * k + 1] = middle;
                halves[1][2 * k] = middle;
                waiting.extend([halves[1], halves[0]]);
            }
        }
    }
}

enum Verdict {
    Closed,
    Part(Part),
    Again([f64; 4]),
    Halve(usize),
}

/// The net of a box, seen from the target: r (three components) and W.
#[derive(Clone, Debug, Default)]
struct Net {
    values: Vec<f64>,
    count: usize,
    /// r / W of each pole.
    places: Vec<Vector>,
    /// Greatest |r| / W.
    radius: f64,
    /// Least and greatest length along the line.
    along: [f64; 2],
    squares: Vec<f64>,
    scratch: Vec<f64>,
}

impl Net {
    fn load(&mut self, sheet: &Sheet, area: [f64; 4]) {
        let count = sheet.degree.count();
        self.count = count;
        self.values.clear();
        self.values.extend_from_slice(sheet.poles);
        let components = if sheet.rational { 4 } else { 3 };
        for component in self.values.chunks_exact_mut(count).take(components) {
            cut_2d(component, sheet.degree, [area[0], area[1]], [area[2], area[3]]);
        }
        self.values.resize(4 * count, 1.0);
        let (xyz, w) = self.values.split_at_mut(3 * count);
        self.places.clear();
        let mut greatest: f64 = 0.0;
        self.along = [f64::INFINITY, f64::NEG_INFINITY];
        for k in 0..count {
            let x = [xyz[k], xyz[count + k], xyz[2 * count + k]];
            let r = sub(x, scaled(sheet.base, w[k]));
            let along = sheet.direction.map_or(0.0, |d| dot(r, d) / w[k]);
            self.along = [self.along[0].min(along), self.along[1].max(along)];
            let r = sheet.seen(r);
            (0..3).for_each(|c| xyz[c * count + k] = r[c]);
            let place = scaled(r, 1.0 / w[k]);
            greatest = greatest.max(dot(place, place));
            self.places.push(place);
        }
        self.radius = greatest.sqrt() * (1.0 + 8.0 * HALF_ULP);
    }

    /// Whether a plane at `least` from the target has all of the net beyond it.
    fn is_beyond(&self, n: Vector, least: f64) -> bool {
        self.places.iter().all(|&r| dot(n, r) > least)
    }

    /// Coefficients of |r|^2 and W^2.
    fn square(&mut self, degree: Bidegree) {
        let twice = degree.times(degree);
        self.squares.clear();
        self.squares.resize(2 * twice.count(), 0.0);
        self.scratch.clear();
        self.scratch.extend_from_slice(&self.values);
        for component in self.scratch.chunks_exact_mut(self.count) {
            scale_up_2d(component, degree);
        }
        let (n, c) = self.squares.split_at_mut(twice.count());
        for component in self.scratch[..3 * self.count].chunks_exact(self.count) {
            convolve_square(component, degree, 1.0, n);
        }
        convolve_square(&self.scratch[3 * self.count..], degree, 1.0, c);
        scale_down_2d(n, twice);
        scale_down_2d(c, twice);
    }

    /// Greatest step between neighbouring poles along s and along t.
    fn steps(&self, degree: Bidegree) -> [f64; 2] {
        let width = degree.t + 1;
        let step = |a: Vector, b: Vector| {
            let d = sub(a, b);
            dot(d, d)
        };
        let along_s = self.places.iter().zip(&self.places[width..]).map(|(a, b)| step(*a, *b));
        let rows = self.places.chunks_exact(width);
        let along_t = rows.flat_map(|row| row.windows(2).map(|pair| step(pair[0], pair[1])));
        [
            degree.s as f64 * along_s.fold(0.0, f64::max).sqrt(),
            degree.t as f64 * along_t.fold(0.0, f64::max).sqrt(),
        ]
    }

    /// Greatest distance of a pole from the first one: the image is no larger than twice that.
    fn size(&self) -> f64 {
        self.places.iter().map(|r| norm(sub(*r, self.places[0]))).fold(0.0, f64::max)
    }
}

impl Sheet<'_> {
    /// The part of a vector across the line.
    fn seen(&self, r: Vector) -> Vector {
        self.direction.map_or(r, |d| sub(r, scaled(d, dot(r, d))))
    }

    fn is_curve(&self) -> bool {
        self.degree.s == 0
    }

    /// The best place in an area by local iteration, with the distance there.
    fn foot(&self, start: [f64; 2], area: [f64; 4]) -> ([f64; 2], Jet2) {
        if self.is_curve() {
            let range = [area[2], area[3]];
            let (t, jet, _) = foot_on_curve(self, start[1], range, Method::Auto, None);
            let jet = Jet2 {
                d: jet.d,
                t: jet.s,
                tt: jet.ss,
                w: [jet.w[0], 0.0, jet.w[1]],
                ..Jet2::default()
            };
            return ([0.0, t], jet);
        }
        let (at, jet, _) = foot_on_surface(self, start, area, Method::Auto, None);
        (at, jet)
    }

    /// The best place in an area, from a start.
    pub fn best(&self, start: [f64; 2], area: [f64; 4]) -> ([f64; 2], f64) {
        let (at, jet) = self.foot(start, area);
        (at, norm(jet.d))
    }
}

impl CurveJets for Sheet<'_> {
    fn jet(&self, t: f64) -> Jet1 {
        let Self { poles, lanes, level, rational, .. } = *self;
        let net = BezierSegment { degree: self.degree.t, rational, poles, lanes, level };
        let jet = net.jet(t, self.base);
        Jet1 { d: self.seen(jet.d), s: self.seen(jet.s), ss: self.seen(jet.ss), w: jet.w }
    }

    fn global(&self, t: f64) -> [f64; 2] {
        [t, 0.0]
    }
}

impl SurfaceJets for Sheet<'_> {
    fn jet(&self, s: f64, t: f64) -> Jet2 {
        let Self { poles, lanes, level, rational, degree, .. } = *self;
        let net = BezierPatch { degree, rational, poles, lanes, level };
        let jet = net.jet(s, t, self.base);
        let [d, s, t, ss, st, tt] =
            [jet.d, jet.s, jet.t, jet.ss, jet.st, jet.tt].map(|x| self.seen(x));
        Jet2 { d, s, t, ss, st, tt, w: jet.w }
    }

    fn global(&self, s: f64, t: f64) -> [f64; 2] {
        [s, t]
    }
}

fn judge(sheet: &Sheet, net: &mut Net, area: [f64; 4]) -> Verdict {
    let reach = sheet.tolerance + 2.0 * sheet.position;
    let mean = net.places.iter().fold([0.0; 3], |sum, r| [0, 1, 2].map(|c| sum[c] + r[c]));
    let size = norm(mean);
    if size > 0.0 && net.is_beyond(scaled(mean, 1.0 / size), reach * (1.0 + 32.0 * HALF_ULP)) {
        return Verdict::Closed;
    }
    if net.along[1] < sheet.reach[0] - reach || net.along[0] > sheet.reach[1] + reach {
        return Verdict::Closed;
    }
    if net.radius + 2.0 * sheet.position <= sheet.tolerance {
        return Verdict::Part(middle(sheet, area, net.along));
    }
    net.square(sheet.degree);
    let half = net.squares.len() / 2;
    let (n, c) = net.squares.split_at(half);
    let terms = product_steps(3 * net.count);
    let error = squared_error(sheet.position, net.radius, terms);
    let mu = reach * reach + error;
    if n.iter().zip(c).all(|(n, c)| *n > mu * c) {
        return Verdict::Closed;
    }
    if c.iter().all(|&c| c > 1e-270)
        && let Some(verdict) = convex(sheet, net, area, error)
    {
        return verdict;
    }
    let image = 2.0 * net.size();
    if image <= SMALL_IMAGE[0] * sheet.tolerance {
        let part = middle(sheet, area, net.along);
        if part.distance <= sheet.tolerance || image <= SMALL_IMAGE[1] * sheet.tolerance {
            return Verdict::Part(part);
        }
    }
    let [s, t] = net.steps(sheet.degree);
    Verdict::Halve(usize::from(sheet.is_curve() || t >= s))
}

/// The whole area as a part of the answer, seen from its middle.
fn middle(sheet: &Sheet, area: [f64; 4], along: [f64; 2]) -> Part {
    let at = [0.5 * (area[0] + area[1]), 0.5 * (area[2] + area[3])];
    let jet = if sheet.is_curve() {
        CurveJets::jet(sheet, at[1]).d
    } else {
        SurfaceJets::jet(sheet, at[0], at[1]).d
    };
    Part { area, at, distance: norm(jet), along }
}

/// Where `h = N - tolerance^2 C` is convex its negative part is one connected set around the foot, inside an ellipse
/// from the least curvature; or it is nowhere negative.
fn convex(sheet: &Sheet, net: &mut Net, area: [f64; 4], error: f64) -> Option<Verdict> {
    let half = net.squares.len() / 2;
    let (n, c) = net.squares.split_at_mut(half);
    let mu = (sheet.tolerance + sheet.position) * (sheet.tolerance + sheet.position);
    let heaviest = extent(c).1;
    for (n, c) in n.iter_mut().zip(&*c) {
        *n -= mu * c;
    }
    let allowance = 4.0 * (error + 8.0 * HALF_ULP * mu) * heaviest;
    let twice = sheet.degree.times(sheet.degree);
    let bends = if sheet.is_curve() {
        let m = twice.t as f64;
        let second =
            n.windows(3).map(|w| (w[2] - w[1]) - (w[1] - w[0])).fold(f64::INFINITY, f64::min);
        let least = m * (m - 1.0) * (second - allowance);
        (least > 0.0).then_some([1.0, 0.0, least])
    } else {
        convexity(n, twice, allowance)
    }?;
    let middle = [0.5 * (area[0] + area[1]), 0.5 * (area[2] + area[3])];
    let (at, jet) = sheet.foot(middle, area);
    let (slope, value) = at_foot(sheet, &jet, at, area, mu);
    let [a, b, c] = bends;
    let det = a * c - b * b;
    let inverse = [c / det, b / det, a / det];
    let [x, y] = slope;
    let loss = inverse[0] * x * x + 2.0 * inverse[1] * x * y + inverse[2] * y * y;
    // h >= value - slope.y + y.M.y / 2: negative only where y lies in an ellipse around M^-1 slope.
    let room = loss - 2.0 * value;
    if room < 0.0 {
        return Some(Verdict::Closed);
    }
    if norm(jet.d) > sheet.tolerance + 2.0 * sheet.position {
        // Not shown to be beyond, and no place found within: look closer, until the image is small.
        return None;
    }
    let room = room * (1.0 + 1e-9) + 4.0 * allowance;
    let extents = [
        inverse[0] * x + inverse[1] * y + (room * inverse[0]).sqrt(),
        inverse[1] * x + inverse[2] * y + (room * inverse[2]).sqrt(),
    ];
    Some(enclosed(sheet, area, at, extents, (norm(jet.d), net.along)))
}

/// The slope that can lower `h` at the foot and a lower bound of `h` there, in the area's unit parameters.
fn at_foot(sheet: &Sheet, jet: &Jet2, at: [f64; 2], area: [f64; 4], mu: f64) -> ([f64; 2], f64) {
    let (d, w) = (norm(jet.d), jet.w[0]);
    let excess = dot(jet.d, jet.d) - mu;
    let gradient = jet.gradient();
    let degrees = [sheet.degree.s.max(1), sheet.degree.t];
    let speeds = [norm(jet.s), norm(jet.t)];
    let slope = [0, 1].map(|k| {
        let [low, high] = [area[2 * k], area[2 * k + 1]];
        if k == 0 && sheet.is_curve() {
            return 0.0;
        }
        let width = high - low;
        let g = 2.0 * w * (jet.w[k + 1] * excess + w * gradient[k]) * width;
        let slack = slope_error(d, speeds[k], w, sheet.position, degrees[k]) * width;
        free_slope(g, slack, at[k] <= low, at[k] >= high)
    });
    let near = (d - sheet.position).max(0.0);
    (slope, w * w * (near * near - mu) * if near * near < mu { 1.0 + 1e-12 } else { 1.0 - 1e-12 })
}

/// The part around a foot, or the smaller area to look at again when the enclosure shrinks it much.
fn enclosed(
    sheet: &Sheet,
    area: [f64; 4],
    at: [f64; 2],
    extents: [f64; 2],
    (distance, along): (f64, [f64; 2]),
) -> Verdict {
    let mut smaller = area;
    let mut shrinks = false;
    for k in 0..2 {
        let [low, high] = [area[2 * k], area[2 * k + 1]];
        if k == 0 && sheet.is_curve() {
            continue;
        }
        let reach = extents[k] * (high - low) * (1.0 + 1e-9) + 4.0 * HALF_ULP;
        smaller[2 * k] = (at[k] - reach).max(low);
        smaller[2 * k + 1] = (at[k] + reach).min(high);
        shrinks |= smaller[2 * k + 1] - smaller[2 * k] < 0.5 * (high - low);
    }
    let wide = (0..2)
        .any(|k| (k == 1 || !sheet.is_curve()) && smaller[2 * k + 1] - smaller[2 * k] > 1e-12);
    if shrinks && wide {
        return Verdict::Again(smaller);
    }
    Verdict::Part(Part { area: smaller, at, distance, along })
}
