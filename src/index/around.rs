//! The pieces around a place: one inside a piece, up to four where knot lines cross, across seams too.

use super::{CurveIndex, Span, SurfaceIndex};

/// Indices of the spans of one direction that hold `x` and go on inside `range`, with the local parameter of `x`.
///
/// On the seam of a closed direction, when the range has both ends, the span at the other end belongs to them.
fn spans_at(
    count: usize,
    span: impl Fn(usize) -> Span,
    x: f64,
    range: [f64; 2],
    closed: bool,
) -> Vec<(usize, f64)> {
    let (mut low, mut high) = (0, count);
    while low < high {
        let middle = (low + high) / 2;
        if span(middle).ends[1] < x { low = middle + 1 } else { high = middle }
    }
    let mut found = Vec::with_capacity(2);
    for k in [low, low + 1].into_iter().filter(|&k| k < count) {
        let [a, b] = span(k).ends;
        let goes_on = (x > a && x > range[0]) || (x < b && x < range[1]);
        let beyond = (x == b && x == range[0]) || (x == a && x == range[1]);
        if (a..=b).contains(&x) && goes_on && !beyond {
            found.push((k, span(k).local(x)));
        }
    }
    let (first, last) = (span(0).ends[0], span(count - 1).ends[1]);
    if closed && range == [first, last] {
        if x == first {
            found.push((count - 1, 1.0));
        } else if x == last {
            found.push((0, 0.0));
        }
    }
    found
}

impl SurfaceIndex {
    /// The patches around a place of `range` (u0, u1, v0, v1), each with the local parameters of the place.
    pub fn around(&self, at: [f64; 2], range: [f64; 4]) -> Vec<(usize, [f64; 2])> {
        let rows = self.patches.len() / self.columns;
        let of_u = |k: usize| self.patches[k * self.columns].u;
        let of_v = |k: usize| self.patches[k].v;
        let rows = spans_at(rows, of_u, at[0], [range[0], range[1]], self.closed[0]);
        let columns = spans_at(self.columns, of_v, at[1], [range[2], range[3]], self.closed[1]);
        let mut found = Vec::with_capacity(4);
        for &(a, s) in &rows {
            for &(b, t) in &columns {
                let piece = a * self.columns + b;
                // Inside a span each patch has its own balance of the parameters.
                let inside = |x: f64, own: f64| if x == 0.0 || x == 1.0 { x } else { own };
                let patch = &self.patches[piece];
                let local = [inside(s, patch.u.local(at[0])), inside(t, patch.v.local(at[1]))];
                found.push((piece, local));
            }
        }
        found
    }
}

impl CurveIndex {
    /// The segments around a parameter of `range`, each with the local parameter.
    pub fn around(&self, u: f64, range: [f64; 2]) -> Vec<(usize, f64)> {
        spans_at(self.segments.len(), |k| self.segments[k].u, u, range, self.closed)
    }
}
