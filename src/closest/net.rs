//! The net of a box: cut out of a piece, seen from the query.

use crate::bezier::Bidegree;
use crate::bounds::{HALF_ULP, Vector};
use crate::jet::Lane;
use crate::simd::{Kernel, Lanes, Simd};

/// Cuts a piece to a box, into `lanes` as `r = X - W q` and `W`, and into `net` the same component by component.
/// Returns the greatest `|r| / W`. Rounding as of [`crate::bezier::cut`].
pub struct CutFree<'a> {
    /// Poles of the piece.
    pub poles: &'a [Lane],
    /// Its degrees; a segment has degree 0 in s.
    pub degree: Bidegree,
    /// Whether its weights count.
    pub rational: bool,
    /// The box.
    pub s: [f64; 2],
    /// See `s`.
    pub t: [f64; 2],
    /// The query in the coordinates of the piece.
    pub query: Vector,
    /// As many as poles.
    pub lanes: &'a mut [Lane],
    /// Four times as many.
    pub net: &'a mut [f64],
}

/// [`crate::bezier::cut`] of poles that stand `stride` apart, each with its `stride` neighbours.
#[inline(always)]
fn cut<S: Simd>(lanes: &mut [Lane], degree: usize, stride: usize, [a, b]: [f64; 2]) {
    if b < 1.0 {
        let (y, x) = (S::F4::splat(1.0 - b), S::F4::splat(b));
        for level in 1..=degree {
            for k in (level..=degree).rev() {
                blend::<S>(lanes, [k - 1, k], stride, [y, x]);
            }
        }
    }
    if a > 0.0 {
        let (y, x) = (S::F4::splat((b - a) / b), S::F4::splat(a / b));
        for level in 1..=degree {
            for k in 0..=degree - level {
                blend::<S>(lanes, [k, k], stride, [y, x]);
            }
        }
    }
}

/// Pole `to` becomes `y` times pole `from` and `x` times the next.
#[inline(always)]
fn blend<S: Simd>(lanes: &mut [Lane], [from, to]: [usize; 2], stride: usize, [y, x]: [S::F4; 2]) {
    let pair = &mut lanes[from * stride..(from + 2) * stride];
    let (low, high) = pair.split_at_mut(stride);
    for (a, b) in low.iter_mut().zip(high) {
        let blend = S::F4::load(a) * y + S::F4::load(b) * x;
        blend.store(if to == from { a } else { b });
    }
}

impl Kernel for CutFree<'_> {
    type Out = f64;

    #[inline(always)]
    fn run<S: Simd>(self, _: S) -> f64 {
        let Self { poles, degree, rational, s, t, query, lanes, net } = self;
        let Bidegree { s: p, t: q } = degree;
        let (width, count) = (q + 1, lanes.len());
        lanes.copy_from_slice(poles);
        cut::<S>(lanes, p, width, s);
        for row in lanes.chunks_exact_mut(width) {
            cut::<S>(row, q, 1, t);
        }
        let query = S::F4::load(&[query[0], query[1], query[2], 0.0]);
        let mut greatest: f64 = 0.0;
        for (k, lane) in lanes.iter_mut().enumerate() {
            // Cutting ones rounds; the weights of a polynomial are exact.
            let w = if rational { lane[3] } else { 1.0 };
            let [x, y, z, _] = (S::F4::load(lane) - S::F4::splat(w) * query).array();
            *lane = [x, y, z, w];
            (net[k], net[count + k]) = (x, y);
            (net[2 * count + k], net[3 * count + k]) = (z, w);
            let squared = x * x + y * y + z * z;
            let ratio = if rational { squared / (w * w) } else { squared };
            greatest = if ratio > greatest { ratio } else { greatest };
        }
        greatest.sqrt() * (1.0 + 8.0 * HALF_ULP)
    }
}
