//! What is proven of two parts: they do not meet, or they meet in one arc, or nothing yet.
//!
//! With `z = (u, v, s, t)` in the parts' own parameters, `F(z) = A(u, v) - B(s, t)`. Take the parameter k along which the curve
//! runs fastest, and `M` = inverse of the three other columns of the derivative in the middle:
//!
//! ```text
//!   M F(z) = g + m x + y + z^T H z / 2     x = z_k, y = the others, |m| <= 1, H bounded over the reach
//!
//!   |g_i| > 1 + |m_i| + sum |H| / 2        no solution in the part
//!   D = sum over y of 3/2 |H| < 9/10       M dF/dy is near the unit matrix in the reach: one y at most for each x
//! ```
//!
//! and the solution is followed over all x for which the part may hold one (`arc`). Every solution of two parts that are left is on such
//! an arc, so no closed loop can hide; the tangent of an arc never vanishes, so it is transversal throughout. References: Krawczyk
//! 1969; Sinha, Klassen, Wang, *Exploiting topological and geometric properties for selective subdivision*, 1985 (no loop where the
//! normals keep apart).

use super::arc::{Arc, Frame, bent, change, form};
use super::bends::REACH;
use super::pieces::{Part, Pieces};
use super::system::{inverse, others, tangent};
use crate::bounds::{HALF_ULP, Vector, dot, norm, scaled, sub};

/// How far beyond the part an arc is followed, in half widths.
const OVERLAP: f64 = 1.05;

/// Most change of the matrix for which an arc is tried.
const MOST_CHANGE: f64 = 0.9;

/// What is known of two parts.
pub enum Verdict {
    /// They do not meet.
    Empty,
    /// They meet at most in this arc.
    Arc(Box<Arc>),
    /// Not known; halve the first part (true) or the second.
    Halve(bool),
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

/// Whether two parts are told apart by their boxes, or by a plane along one of them; `error` bounds the rounding of positions.
pub fn misses(a: &Part, b: &Part, error: f64) -> bool {
    let gap = |k: usize| (a.aabb.low[k] - b.aabb.high[k]).max(b.aabb.low[k] - a.aabb.high[k]);
    (0..3).any(|k| gap(k) > error) || apart(a.normal, a, b, error) || apart(b.normal, a, b, error)
}

/// Judges two parts; `error` bounds the rounding of positions.
pub fn judge(pieces: [&Pieces; 2], [a, b]: [&Part; 2], error: f64) -> Verdict {
    if misses(a, b, error) {
        return Verdict::Empty;
    }
    let first = a.bend() > b.bend() || (a.bend() == b.bend() && size(a) >= size(b));
    let halve = Verdict::Halve(first);
    let (Some(ba), Some(bb)) = (a.bends(), b.bends()) else {
        return Verdict::Halve(a.bends().is_none());
    };
    let minus = |v: Vector| scaled(v, -1.0);
    let columns = [a.slope[0], a.slope[1], minus(b.slope[0]), minus(b.slope[1])];
    let t = tangent(&columns);
    let k = (0..4).fold(0, |best, k| if t[k].abs() > t[best].abs() { k } else { best });
    let o = others(k);
    let Some(rows) = inverse(o.map(|c| columns[c])) else { return halve };
    let f = sub(a.at, b.at);
    let (g, m) = (rows.map(|r| dot(r, f)), rows.map(|r| dot(r, columns[k])));
    let (mut worst, mut bends, mut most) = (0.0f64, [0.0f64; 2], [0.0f64; 3]);
    for i in 0..3 {
        let noise: f64 = rows[i].iter().map(|x| x.abs() * (error + 8.0 * HALF_ULP * norm(f))).sum();
        let h = bent(rows[i], [ba, bb]);
        most[i] = 1.0 + 0.5 * (form(h[0], [1.0; 2]) + form(h[1], [1.0; 2])) + noise;
        if g[i].abs() > m[i].abs() + most[i] {
            return Verdict::Empty;
        }
        let c = [change(h[0], [REACH; 2]), change(h[1], [REACH; 2])];
        worst = worst.max(o.iter().map(|&q| c[q / 2][q % 2]).sum());
        bends = [0, 1].map(|side| bends[side].max(c[side][0] + c[side][1]));
    }
    let halve = Verdict::Halve(bends[0] > bends[1] || (bends[0] == bends[1] && first));
    if worst.is_nan() || worst > MOST_CHANGE {
        return halve;
    }
    // Where |g + m x| is at most `most`, for all three.
    let within = |end: f64, most: [f64; 3]| {
        let mut x = [-end, end];
        for i in 0..3 {
            let ends = [(-most[i] - g[i]) / m[i], (most[i] - g[i]) / m[i]];
            if m[i] == 0.0 {
                if g[i].abs() > most[i] {
                    return [1.0, -1.0];
                }
                continue;
            }
            x = [x[0].max(ends[0].min(ends[1])), x[1].min(ends[0].max(ends[1]))];
        }
        x
    };
    let inside = within(1.0, most);
    if inside[0] > inside[1] {
        return Verdict::Empty;
    }
    let x = within(OVERLAP, most.map(|most| most.max(OVERLAP)));
    let ends = |f: fn(f64, f64) -> f64| {
        let of = |p: &Part, q: usize| 0.5 * f(p.high[q], p.low[q]);
        [of(a, 0), of(a, 1), of(b, 0), of(b, 1)]
    };
    let frame = Frame {
        pieces,
        bends: [ba, bb],
        patches: [a.patch, b.patch],
        middle: ends(|high, low| high + low),
        half: ends(|high, low| high - low),
        k,
    };
    match frame.arc(x, t[k] > 0.0, |x| [0, 1, 2].map(|i| -g[i] - m[i] * x)) {
        Some(arc) => Verdict::Arc(Box::new(arc)),
        None => halve,
    }
}

fn size(part: &Part) -> f64 {
    norm(part.slope[0]) + norm(part.slope[1])
}
