//! What is proven of two parts: they do not meet, or they meet in one arc, or nothing yet.
//!
//! With `z = (u, v, s, t)` in the parts' own parameters, `F(z) = A(u, v) - B(s, t)`. Take the parameter k along which the curve
//! runs fastest, and `M` = inverse of the three other columns of the derivative in the middle:
//!
//! ```text
//!   M F(z) = g + m x + y + (E x + D y)     x = z_k, y = the others, |m| <= 1, D and E bounded over the reach by hulls
//!
//!   |g_i| > 1 + |m_i| + D_i + E_i          no solution in the part
//!   D < 1/2 and r = (5/4 (D + E)) / (1 - D) <= 1/4
//!        for each x one y within r of -g - m x (Krawczyk), and no other one in the reach: the solutions are one arc
//! ```
//!
//! Every solution of two parts that are left is on such an arc, so no closed loop can hide; the tangent of an arc never vanishes, so
//! it is transversal throughout. References: Krawczyk 1969; Sinha, Klassen, Wang, *Exploiting topological and geometric properties
//! for selective subdivision*, 1985 (no loop where the normals keep apart).

use super::pieces::{Part, Pieces, Slopes};
use crate::bounds::{HALF_ULP, Vector, cross, dot, norm, scaled, sub};

/// How far beyond the part an arc is followed, in half widths.
const OVERLAP: f64 = 1.25;

/// An arc of the intersection of two patches: the graph of three parameters over the fourth.
#[derive(Clone, Debug)]
pub struct Arc {
    /// Patch of A, patch of B.
    pub patches: [u32; 2],
    /// Middle of the part in the unit parameters of the patches.
    pub middle: [f64; 4],
    /// Half widths.
    pub half: [f64; 4],
    /// The parameter over which it is a graph.
    pub k: usize,
    g: [f64; 3],
    m: [f64; 3],
    /// The others lie within this of `-g - m x`.
    pub radius: f64,
    /// Bound of the slopes' difference from `-m`.
    spread: f64,
    /// Its interval, in half widths.
    pub x: [f64; 2],
    /// Whether x grows along n_A x n_B.
    pub forward: bool,
}

/// What is known of two parts.
pub enum Verdict {
    /// They do not meet.
    Empty,
    /// They meet at most in this arc.
    Arc(Box<Arc>),
    /// Not known; halve the first part (true) or the second.
    Halve(bool),
}

/// The three parameters that are not `k`.
pub fn others(k: usize) -> [usize; 3] {
    match k {
        0 => [1, 2, 3],
        1 => [0, 2, 3],
        2 => [0, 1, 3],
        _ => [0, 1, 2],
    }
}

fn det(a: Vector, b: Vector, c: Vector) -> f64 {
    dot(a, cross(b, c))
}

/// The null vector of three equations in four unknowns, by minors: the direction of the curve.
pub fn tangent(columns: &[Vector; 4]) -> [f64; 4] {
    let [a, b, c, d] = *columns;
    [det(b, c, d), -det(a, c, d), det(a, b, d), -det(a, b, c)]
}

/// Rows of the inverse of the matrix with these columns.
pub fn inverse([a, b, c]: [Vector; 3]) -> Option<[Vector; 3]> {
    let rows = [cross(b, c), cross(c, a), cross(a, b)];
    let d = dot(a, rows[0]);
    let size = norm(a) * norm(b) * norm(c);
    (d.abs() > 1e-15 * size).then(|| rows.map(|r| scaled(r, 1.0 / d)))
}

/// Range of `row . slope` over the reach, along parameter k.
fn range(row: Vector, slopes: &Slopes, k: usize, sign: f64) -> [f64; 2] {
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    for &v in &slopes.hull[k] {
        let x = sign * dot(row, v);
        low = low.min(x);
        high = high.max(x);
    }
    let [w0, w1] = slopes.weight;
    let low = if low < 0.0 { low / w0 } else { low / w1 };
    let high = if high > 0.0 { high / w0 } else { high / w1 };
    let added = (0..3).map(|c| row[c].abs() * (slopes.added[k][c] + slopes.error)).sum::<f64>();
    [low - added, high + added]
}

fn apart(n: Vector, a: &Part, b: &Part, error: f64) -> bool {
    let reach = |part: &Part| {
        part.hull.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), &p| {
            let x = dot(n, sub(p, a.at));
            (low.min(x), high.max(x))
        })
    };
    if n == [0.0; 3] {
        return false;
    }
    let (ours, theirs) = (reach(a), reach(b));
    ours.0 > theirs.1 + error || theirs.0 > ours.1 + error
}

/// Judges two parts; `error` bounds the rounding of positions.
pub fn judge(a: &Part, b: &Part, error: f64) -> Verdict {
    let gap = |k: usize| (a.aabb.low[k] - b.aabb.high[k]).max(b.aabb.low[k] - a.aabb.high[k]);
    if (0..3).any(|k| gap(k) > error)
        || apart(a.normal, a, b, error)
        || apart(b.normal, a, b, error)
    {
        return Verdict::Empty;
    }
    let first = a.bend() > b.bend() || (a.bend() == b.bend() && size(a) >= size(b));
    let halve = Verdict::Halve(first);
    let (Some(sa), Some(sb)) = (a.slopes(), b.slopes()) else {
        return Verdict::Halve(a.slopes().is_none());
    };
    let minus = |v: Vector| scaled(v, -1.0);
    let columns = [a.slope[0], a.slope[1], minus(b.slope[0]), minus(b.slope[1])];
    let t = tangent(&columns);
    let k = (0..4).fold(0, |best, k| if t[k].abs() > t[best].abs() { k } else { best });
    let o = others(k);
    let Some(rows) = inverse(o.map(|c| columns[c])) else { return halve };
    let f = sub(a.at, b.at);
    let (g, m) = (rows.map(|r| dot(r, f)), rows.map(|r| dot(r, columns[k])));
    let slope_range = |row: Vector, c: usize| {
        if c < 2 { range(row, sa, c, 1.0) } else { range(row, sb, c - 2, -1.0) }
    };
    let (mut worst_d, mut spread, mut worst) = (0.0f64, 0.0f64, 0.0f64);
    let far = |[low, high]: [f64; 2], x: f64| (low - x).abs().max((high - x).abs());
    let mut bends = [0.0f64; 2];
    for i in 0..3 {
        let noise: f64 = rows[i].iter().map(|x| x.abs() * (error + 8.0 * HALF_ULP * norm(f))).sum();
        let mut d = 0.0;
        for (j, &c) in o.iter().enumerate() {
            let x = far(slope_range(rows[i], c), if i == j { 1.0 } else { 0.0 });
            bends[c / 2] = bends[c / 2].max(x);
            d += x;
        }
        let e = far(slope_range(rows[i], k), m[i]);
        bends[k / 2] = bends[k / 2].max(e);
        if g[i].abs() > 1.0 + m[i].abs() + d + e + noise {
            return Verdict::Empty;
        }
        worst_d = worst_d.max(d);
        spread = spread.max(e + d * (1.0 + m[0].abs().max(m[1].abs()).max(m[2].abs())));
        worst = worst.max(OVERLAP * (d + e) + noise);
    }
    let halve = Verdict::Halve(bends[0] > bends[1] || (bends[0] == bends[1] && first));
    if worst_d.is_nan() || worst_d >= 0.5 {
        return halve;
    }
    let radius = worst / (1.0 - worst_d);
    if radius > 0.25 {
        return halve;
    }
    let within = |most: f64| {
        let mut x = [-most, most];
        for i in 0..3 {
            let ends = [(-most - g[i]) / m[i], (most - g[i]) / m[i]];
            if m[i] == 0.0 {
                if g[i].abs() > most {
                    return [1.0, -1.0];
                }
                continue;
            }
            x = [x[0].max(ends[0].min(ends[1])), x[1].min(ends[0].max(ends[1]))];
        }
        x
    };
    let inside = within(1.0 + radius);
    if inside[0] > inside[1] {
        return Verdict::Empty;
    }
    let middle =
        [a.low[0] + a.high[0], a.low[1] + a.high[1], b.low[0] + b.high[0], b.low[1] + b.high[1]]
            .map(|x| 0.5 * x);
    let half =
        [a.high[0] - a.low[0], a.high[1] - a.low[1], b.high[0] - b.low[0], b.high[1] - b.low[1]]
            .map(|x| 0.5 * x);
    Verdict::Arc(Box::new(Arc {
        patches: [a.patch, b.patch],
        middle,
        half,
        k,
        g,
        m,
        radius,
        spread: spread / (1.0 - worst_d),
        x: within(OVERLAP),
        forward: t[k] > 0.0,
    }))
}

fn size(part: &Part) -> f64 {
    norm(part.slope[0]) + norm(part.slope[1])
}

/// What the ends of the patches do to an arc.
pub enum Clip {
    /// It lies outside.
    Outside,
    /// It stays, or what is left of it; the patch side at its low and high end, if it ends there.
    Kept([Option<usize>; 2]),
    /// It runs along a side and cannot be told from it: halve.
    Unclear,
}

impl Arc {
    /// The predicted place at `x`, in half widths.
    fn predicted(&self, x: f64) -> [f64; 3] {
        [0, 1, 2].map(|i| -self.g[i] - self.m[i] * x)
    }

    fn unit(&self, x: f64, y: [f64; 3]) -> [f64; 4] {
        let o = others(self.k);
        let mut z = self.middle;
        z[self.k] += x * self.half[self.k];
        for i in 0..3 {
            z[o[i]] += y[i] * self.half[o[i]];
        }
        z
    }

    /// The solution at `x`, in the unit parameters of the patches: Newton with `k` held.
    pub fn solve(&self, a: &Pieces, b: &Pieces, x: f64) -> [f64; 4] {
        self.solve_from(a, b, x, self.predicted(x))
    }

    /// The same between two known solutions.
    pub fn between(&self, a: &Pieces, b: &Pieces, x: f64, ends: [[f64; 4]; 2]) -> [f64; 4] {
        let of = |z: [f64; 4], c: usize| (z[c] - self.middle[c]) / self.half[c];
        let (first, last) = (of(ends[0], self.k), of(ends[1], self.k));
        let share = if first == last { 0.0 } else { (x - first) / (last - first) };
        let y = others(self.k).map(|c| (1.0 - share) * of(ends[0], c) + share * of(ends[1], c));
        self.solve_from(a, b, x, y)
    }

    fn solve_from(&self, a: &Pieces, b: &Pieces, x: f64, mut y: [f64; 3]) -> [f64; 4] {
        let first = self.predicted(x);
        let o = others(self.k);
        for _ in 0..12 {
            let z = self.unit(x, y);
            let (f, columns) = system(a, b, self.patches, z);
            let Some(rows) = inverse(o.map(|c| scaled(columns[c], self.half[c]))) else { break };
            let step = rows.map(|r| dot(r, f));
            let mut moved = 0.0f64;
            for i in 0..3 {
                // The solution is known to lie in this interval.
                let limit = self.radius + 1e-9;
                y[i] = (y[i] - step[i]).clamp(first[i] - limit, first[i] + limit);
                moved = moved.max(step[i].abs());
            }
            // Quadratic from here: the next step would be below the last digit.
            if moved < 1e-8 {
                break;
            }
        }
        self.unit(x, y)
    }

    /// Where a place in unit parameters stands on the arc, if it is there.
    pub fn position(&self, z: [f64; 4], slack: f64) -> Option<f64> {
        let x = (z[self.k] - self.middle[self.k]) / self.half[self.k];
        if !(self.x[0] - slack..=self.x[1] + slack).contains(&x) {
            return None;
        }
        let (y, o) = (self.predicted(x), others(self.k));
        let on = |i: usize| {
            let at = (z[o[i]] - self.middle[o[i]]) / self.half[o[i]];
            (at - y[i]).abs() <= self.radius + slack
        };
        (on(0) && on(1) && on(2)).then_some(x)
    }

    /// Cuts the arc where it leaves the patches by more than `slack` (unit parameters).
    pub fn clip(&mut self, a: &Pieces, b: &Pieces, slack: [f64; 4]) -> Clip {
        let mut ends = [None; 2];
        for q in 0..4 {
            for high in [false, true] {
                let limit = if high { 1.0 } else { 0.0 };
                let reach = 1.5 * self.half[q];
                let far =
                    if high { self.middle[q] + reach < 1.0 } else { self.middle[q] - reach > 0.0 };
                if far {
                    continue;
                }
                match self.clip_side(a, b, q, limit, slack[q], &mut ends) {
                    Clip::Kept(_) => {}
                    other => return other,
                }
            }
        }
        Clip::Kept(ends)
    }

    fn clip_side(
        &mut self,
        a: &Pieces,
        b: &Pieces,
        q: usize,
        limit: f64,
        slack: f64,
        ends: &mut [Option<usize>; 2],
    ) -> Clip {
        let sign = if limit > 0.5 { 1.0 } else { -1.0 };
        let side = 2 * q + usize::from(limit > 0.5);
        if q == self.k {
            let end = (limit - self.middle[q]) / self.half[q];
            if sign > 0.0 && self.x[1] > end {
                self.x[1] = end;
                ends[1] = Some(side);
            }
            if sign < 0.0 && self.x[0] < end {
                self.x[0] = end;
                ends[0] = Some(side);
            }
            return if self.x[0] > self.x[1] { Clip::Outside } else { Clip::Kept(*ends) };
        }
        let i = others(self.k).iter().position(|&c| c == q).unwrap_or(0);
        let outside = |arc: &Self, x: f64| sign * (arc.solve(a, b, x)[q] - limit);
        let (low, high) = (self.x[0], self.x[1]);
        // The line of the prediction tells most sides without a solution.
        let edge = sign * (limit - self.middle[q]) / self.half[q];
        let most = [low, high].map(|x| sign * self.predicted(x)[i]);
        if most[0].max(most[1]) + self.radius < edge {
            return Clip::Kept(*ends);
        }
        if most[0].min(most[1]) - self.radius > edge + slack / self.half[q] {
            return Clip::Outside;
        }
        let monotone = self.m[i].abs() > self.spread;
        let at = [0.0, 0.25, 0.5, 0.75, 1.0].map(|s| outside(self, low + s * (high - low)));
        let (least, greatest) =
            at.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), &x| (l.min(x), h.max(x)));
        if !monotone {
            // Between two samples it moves at most by its slope times an eighth of the interval.
            let bulge = 0.25 * self.spread * (high - low) * self.half[q];
            let along = greatest <= slack && least >= -4.0 * slack;
            return match (greatest < -bulge, least > slack + bulge) {
                (true, _) => Clip::Kept(*ends),
                (_, true) => Clip::Outside,
                // It lies on the side, as far as rounding can tell.
                _ if along => Clip::Kept(*ends),
                _ => Clip::Unclear,
            };
        }
        if greatest <= slack {
            return Clip::Kept(*ends);
        }
        if least > slack {
            return Clip::Outside;
        }
        let rising = at[4] > at[0];
        let cut = crossing(|x| outside(self, x), low, high);
        let high_end = usize::from(rising);
        self.x[high_end] = cut;
        ends[high_end] = Some(side);
        if self.x[0] > self.x[1] { Clip::Outside } else { Clip::Kept(*ends) }
    }
}

/// Zero of a monotone function between `low` and `high`: regula falsi in the Illinois form, ended by the last digits.
fn crossing(f: impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    let (mut fl, mut fh) = (f(low), f(high));
    if fl.signum() == fh.signum() {
        return if fl.abs() < fh.abs() { low } else { high };
    }
    for _ in 0..60 {
        let x = high - fh * (high - low) / (fh - fl);
        let fx = f(x);
        if fx == 0.0 || (high - low).abs() < 1e-15 {
            return x;
        }
        if fx.signum() == fh.signum() {
            fl *= 0.5;
        } else {
            (low, fl) = (high, fh);
        }
        if (x - high).abs() < 1e-15 {
            return x;
        }
        (high, fh) = (x, fx);
    }
    high
}

/// `A - B` and its four columns at unit parameters of two patches.
pub fn system(a: &Pieces, b: &Pieces, patches: [u32; 2], z: [f64; 4]) -> (Vector, [Vector; 4]) {
    let [p, pu, pv] = a.jet(patches[0], [z[0], z[1]]);
    let [q, qs, qt] = b.jet(patches[1], [z[2], z[3]]);
    (sub(p, q), [pu, pv, scaled(qs, -1.0), scaled(qt, -1.0)])
}

/// The point of A of a solution.
pub fn meeting(a: &Pieces, patches: [u32; 2], z: [f64; 4]) -> Vector {
    a.jet(patches[0], [z[0], z[1]])[0]
}
