//! The loops of a face as Bezier pieces in its domain: whether a border may run through a box.

use crate::bounds::HALF_ULP;
use crate::curve::Curve;
use crate::pcurve::compose::arc;

/// Most halvings of a piece.
const MOST_HALVINGS: u32 = 60;

/// A pole: weight times u, weight times v, weight.
type Pole = [f64; 3];

/// All borders of a face.
#[derive(Default)]
pub struct Border {
    pieces: Vec<Vec<Pole>>,
    error: f64,
}

/// The box around the places of a net.
fn bounds(net: &[Pole]) -> [f64; 4] {
    let empty = [f64::INFINITY, f64::NEG_INFINITY, f64::INFINITY, f64::NEG_INFINITY];
    net.iter().fold(empty, |[u0, u1, v0, v1], p| {
        let (u, v) = (p[0] / p[2], p[1] / p[2]);
        [u0.min(u), u1.max(u), v0.min(v), v1.max(v)]
    })
}

impl Border {
    /// Takes the curves (u, v, 0) of a loop; gaps between them are closed by lines.
    pub fn push(&mut self, curves: &[Curve]) {
        for (k, curve) in curves.iter().enumerate() {
            for span in curve.knots().spans() {
                let ends = [curve.knots().values()[span], curve.knots().values()[span + 1]];
                let piece = arc(curve, span, ends, [0.0; 3]);
                let pole = |(n, &w): (&[f64; 3], &f64)| [n[0], n[1], w];
                self.pieces.push(piece.numerator.iter().zip(&piece.weights).map(pole).collect());
            }
            let next = &curves[(k + 1) % curves.len()];
            let (from, to) = (curve.evaluate(curve.domain().1), next.evaluate(next.domain().0));
            if from != to {
                self.pieces.push(vec![[from[0], from[1], 1.0], [to[0], to[1], 1.0]]);
            }
        }
        let most =
            self.pieces.iter().flat_map(|net| bounds(net)).fold(0.0f64, |m, x| m.max(x.abs()));
        let degree = self.pieces.iter().map(Vec::len).max().unwrap_or(1);
        // Extraction, and halvings, which round each pole once a level.
        self.error = (64 * degree + 4 * MOST_HALVINGS as usize) as f64 * HALF_ULP * most;
    }

    /// Whether a border may run through a box u0, u1, v0, v1; false is certain.
    pub fn may_cross(&self, area: &[f64; 4]) -> bool {
        let area = [
            area[0] - self.error,
            area[1] + self.error,
            area[2] - self.error,
            area[3] + self.error,
        ];
        self.pieces.iter().any(|net| crosses(net, &area, MOST_HALVINGS))
    }
}

fn crosses(net: &[Pole], area: &[f64; 4], halvings: u32) -> bool {
    let [u0, u1, v0, v1] = bounds(net);
    if u0 > area[1] || u1 < area[0] || v0 > area[3] || v1 < area[2] {
        return false;
    }
    let inside = area[0] <= u0 && u1 <= area[1] && area[2] <= v0 && v1 <= area[3];
    let small = u1 - u0 <= 0.25 * (area[1] - area[0]) && v1 - v0 <= 0.25 * (area[3] - area[2]);
    if inside || small || halvings == 0 {
        return true;
    }
    let (mut low, mut high) = (net.to_vec(), net.to_vec());
    let n = net.len() - 1;
    for level in 0..n {
        high[n - level] = low[n];
        for k in (level + 1..=n).rev() {
            low[k] = [0, 1, 2].map(|c| 0.5 * (low[k][c] + low[k - 1][c]));
        }
    }
    high[0] = low[n];
    crosses(&low, area, halvings - 1) || crosses(&high, area, halvings - 1)
}
