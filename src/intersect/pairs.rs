//! A curve against a curve or a surface: boxes of both at once, halved until each holds one crossing, none, or a contact.
//!
//! ```text
//!   D(x) = A - B on a pair of boxes = D0 + sum x_i V_i + E          x in [-1, 1]^n, n = 2 or 3
//!   a plane separates the two by the tolerance?                     none
//!   |Y| slope < 1 (Y undoes V):                                     at most one near-zero: Newton, then in or out
//!   both straight to a fraction of the tolerance?                   kept: they touch or run together here
//!   otherwise                                                       halve the longer
//! ```
//!
//! Everything outside of what is found is farther apart than the tolerance.
//!
//! References: Krawczyk 1969; Sederberg, Meyers, *Loop detection in surface patch intersections*, 1988 (cones for curves).
//! Limit: pieces that run together take about length / sqrt(tolerance * radius) boxes.

use super::cell::Cell;
use crate::bezier::{Bidegree, cut_2d};
use crate::bounds::{Aabb, HALF_ULP, Vector, add, cross, dot, norm, scaled, sub};
use crate::index::{CurveIndex, Frame, IndexedCurve, IndexedSurface, SurfaceIndex};

/// The greatest `|Y| slope` of a box with at most one near-zero.
const MOST_DEVIATION: f64 = 0.7;

/// Share of the tolerance to which both must be straight to be kept as they are.
const STRAIGHT: f64 = 0.25;

/// Parameters closer than this, in a piece's unit interval, are on the rim of a box.
const RIM: f64 = 1e-11;

/// Narrowest boxes.
const LEAST_WIDTH: f64 = 1e-13;

/// One of the two shapes, in common coordinates.
pub struct Body<'a> {
    of: Of<'a>,
    shift: Vector,
    ratio: f64,
}

enum Of<'a> {
    Curve(&'a IndexedCurve, &'a CurveIndex),
    Surface(&'a IndexedSurface, &'a SurfaceIndex),
}

impl<'a> Body<'a> {
    /// A curve seen from a frame.
    pub fn curve(shape: &'a IndexedCurve, index: &'a CurveIndex, frame: &Frame) -> Self {
        Self::seen(Of::Curve(shape, index), &index.frame, frame)
    }

    /// A surface seen from a frame.
    pub fn surface(shape: &'a IndexedSurface, index: &'a SurfaceIndex, frame: &Frame) -> Self {
        Self::seen(Of::Surface(shape, index), &index.frame, frame)
    }

    fn seen(of: Of<'a>, own: &Frame, frame: &Frame) -> Self {
        Self { of, shift: frame.enter(own.center), ratio: frame.scale / own.scale }
    }

    /// Number of Bezier pieces.
    pub fn count(&self) -> usize {
        match &self.of {
            Of::Curve(_, index) => index.segments.len(),
            Of::Surface(_, index) => index.patches.len(),
        }
    }

    fn is_curve(&self) -> bool {
        matches!(self.of, Of::Curve(..))
    }

    /// The whole of a piece: s0, s1, t0, t1; a curve has t only.
    fn whole(&self) -> [f64; 4] {
        if self.is_curve() { [0.0, 0.0, 0.0, 1.0] } else { [0.0, 1.0, 0.0, 1.0] }
    }

    fn enter(&self, local: Vector, center: Vector) -> Vector {
        add(self.shift, scaled(add(local, center), self.ratio))
    }

    /// The model of a part of a piece with its box.
    fn half(&self, piece: usize, area: [f64; 4], net: &mut Vec<f64>) -> (Half, Aabb) {
        let (poles, degree, rational, center, radius, spread) = match &self.of {
            Of::Curve(_, index) => {
                let (segment, degree) =
                    (&index.segments[piece], Bidegree { s: 0, t: index.degree() });
                (
                    index.net(piece).poles,
                    degree,
                    index.is_rational(),
                    segment.center,
                    segment.radius,
                    0.0,
                )
            }
            Of::Surface(_, index) => {
                let patch = &index.patches[piece];
                (
                    index.net(piece).poles,
                    index.degree,
                    index.rational,
                    patch.center,
                    patch.radius,
                    patch.spread,
                )
            }
        };
        let count = degree.count();
        net.clear();
        net.extend_from_slice(poles);
        let s = if degree.s == 0 { [0.0, 1.0] } else { [area[0], area[1]] };
        for component in net.chunks_exact_mut(count) {
            cut_2d(component, degree, s, [area[2], area[3]]);
        }
        let mut cell = Cell::new(net, degree, rational, radius);
        let mut aabb = Aabb::EMPTY;
        for k in 0..count {
            let w = if rational { net[3 * count + k] } else { 1.0 };
            let x = [net[k] / w, net[count + k] / w, net[2 * count + k] / w];
            aabb.include(self.enter(x, center));
        }
        let rounding = 16.0 * HALF_ULP * (norm(self.shift) + 4.0 * self.ratio);
        cell.middle = self.enter(cell.middle, center);
        cell.edges = cell.edges.map(|v| scaled(v, self.ratio));
        cell.off = (cell.off + 2.0 * spread) * self.ratio + rounding;
        cell.slopes = cell.slopes.map(|x| x * self.ratio);
        let half = Half { cell, piece: piece as u32, area };
        (half, aabb.grown(cell.off.min(1e-12 * self.ratio) + 4.0 * rounding))
    }

    /// Point and slopes along s and t, in common coordinates.
    fn jet(&self, piece: usize, at: [f64; 2]) -> [Vector; 3] {
        let (d, s, t, center) = match &self.of {
            Of::Curve(_, index) => {
                let jet = index.net(piece).jet(at[1], [0.0; 3]);
                (jet.d, [0.0; 3], jet.s, index.segments[piece].center)
            }
            Of::Surface(_, index) => {
                let jet = index.net(piece).jet(at[0], at[1], [0.0; 3]);
                (jet.d, jet.s, jet.t, index.patches[piece].center)
            }
        };
        [self.enter(d, center), scaled(s, self.ratio), scaled(t, self.ratio)]
    }

    /// Parameters of the caller; a curve's is the second.
    pub fn global(&self, piece: usize, at: [f64; 2]) -> [f64; 2] {
        match &self.of {
            Of::Curve(_, index) => [0.0, index.segments[piece].u.global(at[1])],
            Of::Surface(_, index) => {
                let patch = &index.patches[piece];
                [patch.u.global(at[0]), patch.v.global(at[1])]
            }
        }
    }

    /// The caller's point.
    pub fn point(&self, at: [f64; 2]) -> Vector {
        match &self.of {
            Of::Curve(shape, _) => shape.curve().evaluate(at[1]),
            Of::Surface(shape, _) => shape.surface().evaluate(at[0], at[1]),
        }
    }
}

/// A part of a piece.
#[derive(Clone, Copy)]
struct Half {
    cell: Cell,
    piece: u32,
    area: [f64; 4],
}

/// Something found: a crossing, or a box in which both run together, in the caller's parameters.
#[derive(Clone, Copy, Debug)]
pub struct Found {
    /// Best place known: of the first shape (s, t), then of the second (its t).
    pub at: [f64; 3],
    /// Least parameters of the box.
    pub low: [f64; 3],
    /// Greatest ones.
    pub high: [f64; 3],
    /// What is known.
    pub kind: FoundKind,
    /// The pair of boxes.
    pub places: [Place; 2],
}

/// A part of a piece: its number and local box.
pub type Place = (u32, [f64; 4]);

/// What is known of something found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FoundKind {
    /// One crossing at an angle, and no other place within the tolerance in its box.
    Crossing,
    /// Both run together within the tolerance, or touch.
    Together,
    /// Not decided.
    Undecided,
}

/// The search: two bodies, the second one a curve; the tolerance in common coordinates.
pub struct Pairs<'a> {
    pub first: Body<'a>,
    pub second: Body<'a>,
    pub tolerance: f64,
}

enum Verdict {
    None,
    Found(Found),
    Halve,
}

impl Pairs<'_> {
    /// Searches all pairs of pieces; false when `poll` stopped it: what was not searched is undecided then.
    pub fn search(
        &self,
        budget: &mut u64,
        out: &mut Vec<Found>,
        poll: &mut dyn FnMut() -> bool,
    ) -> bool {
        let mut net = Vec::new();
        let all = |body: &Body, net: &mut Vec<f64>| -> Vec<(Half, Aabb)> {
            (0..body.count()).map(|k| body.half(k, body.whole(), net)).collect()
        };
        let (firsts, seconds) = (all(&self.first, &mut net), all(&self.second, &mut net));
        let whole = seconds.iter().fold(Aabb::EMPTY, |whole, (_, aabb)| whole.union(*aabb));
        let mut goes_on = true;
        for (a, box_a) in &firsts {
            goes_on = goes_on && !poll();
            if self.are_apart(box_a, &whole) {
                continue;
            }
            if !goes_on {
                out.push(self.unseen(a));
                continue;
            }
            for (b, box_b) in &seconds {
                if self.are_apart(box_a, box_b) {
                    continue;
                }
                if goes_on {
                    goes_on = self.take_apart((*a, *b), &mut net, budget, out, poll);
                } else {
                    out.push(self.found(a, b, self.middle(a, b), FoundKind::Undecided));
                }
            }
        }
        goes_on
    }

    /// A piece of the first that was not searched, with all of the second.
    fn unseen(&self, a: &Half) -> Found {
        let first = |k: usize| self.first.global(a.piece as usize, [a.area[k], a.area[2 + k]]);
        let ends = [
            self.second.global(0, [0.0, 0.0])[1],
            self.second.global(self.second.count() - 1, [0.0, 1.0])[1],
        ];
        let corner = |k: usize| [first(k)[0], first(k)[1], ends[k]];
        let (low, high) = (corner(0), corner(1));
        let places = [(a.piece, a.area), (0, self.second.whole())];
        Found { at: low, low, high, kind: FoundKind::Undecided, places }
    }

    /// Searches pairs of parts; false when `poll` stopped it: what was not searched is undecided then.
    pub fn search_in(
        &self,
        places: impl Iterator<Item = [Place; 2]>,
        budget: &mut u64,
        out: &mut Vec<Found>,
        poll: &mut dyn FnMut() -> bool,
    ) -> bool {
        let mut net = Vec::new();
        let mut goes_on = true;
        for [a, b] in places {
            let (a, _) = self.first.half(a.0 as usize, a.1, &mut net);
            let (b, _) = self.second.half(b.0 as usize, b.1, &mut net);
            if goes_on {
                goes_on = self.take_apart((a, b), &mut net, budget, out, poll);
            } else {
                out.push(self.found(&a, &b, self.middle(&a, &b), FoundKind::Undecided));
            }
        }
        goes_on
    }

    fn take_apart(
        &self,
        pair: (Half, Half),
        net: &mut Vec<f64>,
        budget: &mut u64,
        out: &mut Vec<Found>,
        poll: &mut dyn FnMut() -> bool,
    ) -> bool {
        let mut waiting = vec![pair];
        while let Some((a, b)) = waiting.pop() {
            match self.judge(&a, &b) {
                Verdict::None => {}
                Verdict::Found(found) => out.push(found),
                Verdict::Halve => self.halve(a, b, net, &mut waiting, budget, out),
            }
            if *budget % 1024 == 1023 && poll() {
                let left = |(a, b): &(Half, Half)| {
                    self.found(a, b, self.middle(a, b), FoundKind::Undecided)
                };
                out.extend(waiting.iter().map(left));
                return false;
            }
        }
        true
    }

    fn are_apart(&self, a: &Aabb, b: &Aabb) -> bool {
        (0..3)
            .any(|k| a.low[k] > b.high[k] + self.tolerance || b.low[k] > a.high[k] + self.tolerance)
    }

    fn halve(
        &self,
        a: Half,
        b: Half,
        net: &mut Vec<f64>,
        waiting: &mut Vec<(Half, Half)>,
        budget: &mut u64,
        out: &mut Vec<Found>,
    ) {
        let lengths = [norm(a.cell.edges[0]), norm(a.cell.edges[1]), norm(b.cell.edges[1])];
        let longest = (0..3).max_by(|&i, &j| lengths[i].total_cmp(&lengths[j])).unwrap_or(2);
        let (body, half, k) = match longest {
            2 => (&self.second, &b, 1),
            k => (&self.first, &a, k),
        };
        let [low, high] = [half.area[2 * k], half.area[2 * k + 1]];
        if *budget == 0 || high - low < LEAST_WIDTH {
            out.push(self.found(&a, &b, self.middle(&a, &b), FoundKind::Undecided));
            return;
        }
        *budget -= 1;
        let middle = 0.5 * (low + high);
        for part in [[middle, high], [low, middle]] {
            let mut area = half.area;
            (area[2 * k], area[2 * k + 1]) = (part[0], part[1]);
            let (smaller, _) = body.half(half.piece as usize, area, net);
            waiting.push(if longest == 2 { (a, smaller) } else { (smaller, b) });
        }
    }

    fn middle(&self, a: &Half, b: &Half) -> [f64; 3] {
        let of = |area: &[f64; 4], k: usize| 0.5 * (area[2 * k] + area[2 * k + 1]);
        [of(&a.area, 0), of(&a.area, 1), of(&b.area, 1)]
    }

    /// Something in a pair of boxes, from local parameters.
    fn found(&self, a: &Half, b: &Half, at: [f64; 3], kind: FoundKind) -> Found {
        let to = |s: f64, t: f64, x: f64| {
            let first = self.first.global(a.piece as usize, [s, t]);
            [first[0], first[1], self.second.global(b.piece as usize, [0.0, x])[1]]
        };
        Found {
            at: to(at[0], at[1], at[2]),
            low: to(a.area[0], a.area[2], b.area[2]),
            high: to(a.area[1], a.area[3], b.area[3]),
            kind,
            places: [(a.piece, a.area), (b.piece, b.area)],
        }
    }

    fn judge(&self, a: &Half, b: &Half) -> Verdict {
        let d0 = sub(a.cell.middle, b.cell.middle);
        let v = [a.cell.edges[0], a.cell.edges[1], scaled(b.cell.edges[1], -1.0)];
        let off = a.cell.off + b.cell.off;
        if separated(d0, &v, off + self.tolerance) {
            return Verdict::None;
        }
        let first = usize::from(self.first.is_curve());
        if let Some(y) = undo(&v[first..]) {
            let lengths = y.map(|row| norm(row) * (1.0 + 1e-6));
            let slope = a.cell.slope() + b.cell.slope();
            let worst = lengths.iter().fold(0.0f64, |m, &x| m.max(x));
            if worst * slope <= MOST_DEVIATION
                && let Some(verdict) = self.regular(a, b, d0, &y, &lengths, first)
            {
                return verdict;
            }
        }
        if off <= STRAIGHT * self.tolerance {
            return self.together(a, b, d0, &v[first..2], off);
        }
        Verdict::Halve
    }

    /// Two straight parts: the curve's piece beside the other one, by the other one's own parameters.
    fn together(&self, a: &Half, b: &Half, d0: Vector, v: &[Vector], off: f64) -> Verdict {
        let rows = match *v {
            [t] => [scaled(t, 1.0 / dot(t, t)), [0.0; 3]],
            _ => match undo(v) {
                Some([s, t, _]) => [s, t],
                None => return Verdict::Halve,
            },
        };
        let rows = &rows[..v.len()];
        let along = b.cell.edges[1];
        let (mut low, mut high) = (-1.0f64, 1.0f64);
        // Parameter k of the first where the curve's is w: -row.d0 + w row.along, up to the margin.
        let margins: Vec<f64> = rows.iter().map(|r| norm(*r) * (off + self.tolerance)).collect();
        for (row, margin) in rows.iter().zip(&margins) {
            let (at, slope) = (-dot(*row, d0), dot(*row, along));
            let reach = 1.0 + margin;
            if slope.abs() * 1e3 < *margin {
                if at.abs() - slope.abs() > reach {
                    return Verdict::None;
                }
                continue;
            }
            let (x, y) = ((-reach - at) / slope, (reach - at) / slope);
            (low, high) = (low.max(x.min(y)), high.min(x.max(y)));
        }
        if low > high {
            return Verdict::None;
        }
        let inner = |area: &[f64; 4], k: usize, x: f64| {
            let (p, q) = (area[2 * k], area[2 * k + 1]);
            (p + 0.5 * (x.clamp(-1.0, 1.0) + 1.0) * (q - p)).clamp(p, q)
        };
        let (mut first, mut second) = (*a, *b);
        second.area[2] = inner(&b.area, 1, low - off / norm(along));
        second.area[3] = inner(&b.area, 1, high + off / norm(along));
        for (k, row) in rows.iter().enumerate() {
            let k_of = k + 2 - rows.len();
            let ends = [low, high].map(|w| -dot(*row, d0) + w * dot(*row, along));
            first.area[2 * k_of] = inner(&a.area, k_of, ends[0].min(ends[1]) - margins[k]);
            first.area[2 * k_of + 1] = inner(&a.area, k_of, ends[0].max(ends[1]) + margins[k]);
        }
        Verdict::Found(self.found(
            &first,
            &second,
            self.middle(&first, &second),
            FoundKind::Together,
        ))
    }

    /// A pair of boxes with at most one near-zero; `None` when it must be halved.
    fn regular(
        &self,
        a: &Half,
        b: &Half,
        d0: Vector,
        y: &[Vector; 3],
        lengths: &[f64; 3],
        first: usize,
    ) -> Option<Verdict> {
        let off = a.cell.off + b.cell.off;
        let n = 3 - first;
        let centre: [f64; 3] = std::array::from_fn(|k| if k < n { -dot(y[k], d0) } else { 0.0 });
        if (0..n).any(|k| centre[k].abs() - lengths[k] * (off + self.tolerance) > 1.0) {
            return Some(Verdict::None);
        }
        let areas = [[a.area[0], a.area[1]], [a.area[2], a.area[3]], [b.area[2], b.area[3]]];
        let areas = &areas[first..];
        let local = |x: &[f64; 3]| -> [f64; 3] {
            let mut out = [0.0; 3];
            for k in 0..n {
                let [low, high] = areas[k];
                out[first + k] = 0.5 * (low + high) + 0.5 * (high - low) * x[k];
            }
            out
        };
        // Newton in the boxes' own units, until steps are rounding.
        let mut x = centre;
        let (mut d, mut before) = (d0, f64::INFINITY);
        for step in 0.. {
            let (value, v) = self.difference(a, b, local(&x), areas, first);
            d = value;
            let y = undo(&v[first..])?;
            let dx: [f64; 3] = std::array::from_fn(|k| if k < n { -dot(y[k], value) } else { 0.0 });
            let size = dx.iter().fold(0.0f64, |m, x| m.max(x.abs()));
            x = std::array::from_fn(|k| x[k] + dx[k]);
            if size.is_nan() || size >= 8.0 || x.iter().any(|x| x.abs() > 4.0) || step == 20 {
                return None;
            }
            if size < 1e-11 || (size < 1e-5 && size > 0.5 * before) {
                break;
            }
            before = size;
        }
        let slope = a.cell.slope() + b.cell.slope();
        let worst = lengths.iter().fold(0.0f64, |m, &x| m.max(x));
        let deviation = worst * slope;
        let reach = worst * self.tolerance / (1.0 - deviation);
        let rim: Vec<f64> = (0..n)
            .map(|k| {
                let width = areas[k][1] - areas[k][0];
                1.0 + (RIM / width).min(1e-3) + lengths[k] * self.tolerance
            })
            .collect();
        if (0..n).all(|k| x[k].abs() <= rim[k]) {
            let inside: [f64; 3] = std::array::from_fn(|k| x[k].clamp(-1.0, 1.0));
            let (here, _) = self.difference(a, b, local(&inside), areas, first);
            if norm(here) <= self.tolerance {
                let rim = |k: usize| (RIM / (areas[k][1] - areas[k][0])).min(1e-3);
                if (0..n).all(|k| x[k].abs() <= 1.0 + rim(k)) {
                    let found = self.found(a, b, local(&inside), FoundKind::Crossing);
                    return Some(Verdict::Found(found));
                }
                // Beyond the rim but near enough: an end that falls short, or a neighbour's crossing. All near places
                // are within reach of it.
                let ends = [-1.0, 1.0].map(|sign| {
                    local(&std::array::from_fn(|k| (x[k] + sign * reach).clamp(-1.0, 1.0)))
                });
                let (mut p, mut q) = (*a, *b);
                for k in first..2 {
                    (p.area[2 * k], p.area[2 * k + 1]) = (ends[0][k], ends[1][k]);
                }
                (q.area[2], q.area[3]) = (ends[0][2], ends[1][2]);
                let found = self.found(&p, &q, local(&inside), FoundKind::Together);
                return Some(Verdict::Found(found));
            }
            // Skew: nearer than this nothing comes.
            let apart = norm(d) - slope * reach - off * 1e-9;
            return (first == 1 && apart > self.tolerance).then_some(Verdict::None);
        }
        // Outside: Krawczyk's interval from the nearest place of the box.
        let edge: [f64; 3] = std::array::from_fn(|k| x[k].clamp(-1.0, 1.0));
        let (here, _) = self.difference(a, b, local(&edge), areas, first);
        let r: [f64; 3] = std::array::from_fn(|k| if k < n { dot(y[k], here) } else { 0.0 });
        let most = r.iter().fold(0.0f64, |m, x| m.max(x.abs())) + worst * self.tolerance;
        let spread = deviation * most / (1.0 - deviation) + worst * self.tolerance;
        let out = (0..n).any(|k| (edge[k] - r[k]).abs() - spread > 1.0);
        out.then_some(Verdict::None)
    }

    /// D and its slopes in the boxes' units, at local parameters.
    fn difference(
        &self,
        a: &Half,
        b: &Half,
        at: [f64; 3],
        areas: &[[f64; 2]],
        first: usize,
    ) -> (Vector, [Vector; 3]) {
        let [x, s, t] = self.first.jet(a.piece as usize, [at[0], at[1]]);
        let [z, _, w] = self.second.jet(b.piece as usize, [0.0, at[2]]);
        let half = |k: usize| {
            if k < first { 0.0 } else { 0.5 * (areas[k - first][1] - areas[k - first][0]) }
        };
        (sub(x, z), [scaled(s, half(0)), scaled(t, half(1)), scaled(w, -half(2))])
    }
}

/// Whether the parallelepiped about `d0` with half edges `v` stays away from the origin by more than `reach`.
fn separated(d0: Vector, v: &[Vector; 3], reach: f64) -> bool {
    let beyond = |n: Vector| {
        let length = norm(n);
        let spread: f64 = v.iter().map(|e| dot(n, *e).abs()).sum();
        length > 0.0 && dot(n, d0).abs() > (spread + length * reach) * (1.0 + 32.0 * HALF_ULP)
    };
    if beyond(d0) {
        return true;
    }
    // Across each of the edges: all that parallel ones leave.
    if v.iter().any(|e| beyond(cross(cross(*e, d0), *e))) {
        return true;
    }
    for (i, j) in [(0, 1), (1, 2), (0, 2)] {
        let n = cross(v[i], v[j]);
        if beyond(n) || beyond(cross(n, v[j])) || beyond(cross(n, v[i])) {
            return true;
        }
    }
    false
}

/// Rows that undo the columns `v`: the inverse of three, the pseudo-inverse of two.
fn undo(v: &[Vector]) -> Option<[Vector; 3]> {
    if let [a, b] = v {
        let [e, f, g] = [dot(*a, *a), dot(*a, *b), dot(*b, *b)];
        let det = e * g - f * f;
        if det.is_nan() || det <= 1e-14 * e * g {
            return None;
        }
        let row = |p: f64, q: f64| add(scaled(*a, p / det), scaled(*b, q / det));
        return Some([row(g, -f), row(-f, e), [0.0; 3]]);
    }
    let [a, b, c] = v else { return None };
    let n = [cross(*b, *c), cross(*c, *a), cross(*a, *b)];
    let det = dot(*a, n[0]);
    if det.is_nan() || det.abs() <= 1e-9 * norm(*a) * norm(*b) * norm(*c) {
        return None;
    }
    Some(n.map(|n| scaled(n, 1.0 / det)))
}
