//! The net of a box: cut out of a piece, seen from the query.

use crate::bezier::Bidegree;
use crate::bounds::{HALF_ULP, Vector};
use crate::jet::Lane;
use crate::knots::MAX_DEGREE;
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

/// Most poles of a strand.
const MOST: usize = MAX_DEGREE + 1;

/// [`crate::bezier::cut`] of poles that stand `stride` apart from `first` on.
#[inline(always)]
fn cut<S: Simd>(lanes: &mut [Lane], degree: usize, strand: [usize; 2], ends: [f64; 2]) {
    if ends == [0.0, 1.0] {
        return;
    }
    match degree {
        0..4 => cut_short::<S, 4>(lanes, degree, strand, ends),
        4..8 => cut_short::<S, 8>(lanes, degree, strand, ends),
        _ => cut_short::<S, MOST>(lanes, degree, strand, ends),
    }
}

/// As [`cut`], of at most `M` poles.
#[inline(always)]
fn cut_short<S: Simd, const M: usize>(
    lanes: &mut [Lane],
    degree: usize,
    [first, stride]: [usize; 2],
    [a, b]: [f64; 2],
) {
    let mut strand = [S::F4::splat(0.0); M];
    for k in 0..=degree {
        strand[k] = S::F4::load(&lanes[first + k * stride]);
    }
    if b < 1.0 {
        triangle::<S>(&mut strand[..=degree], [S::F4::splat(1.0 - b), S::F4::splat(b)]);
    }
    if a > 0.0 {
        strand[..=degree].reverse();
        triangle::<S>(&mut strand[..=degree], [S::F4::splat(a / b), S::F4::splat((b - a) / b)]);
        strand[..=degree].reverse();
    }
    for k in 0..=degree {
        strand[k].store(&mut lanes[first + k * stride]);
    }
}

/// The algorithm of de Casteljau, each pole becoming `before` times the one before it and `own` times itself; four levels
/// in one pass.
#[inline(always)]
fn triangle<S: Simd>(poles: &mut [S::F4], [before, own]: [S::F4; 2]) {
    let count = poles.len();
    let mut level = 0;
    while count - level > 4 {
        // The pole before at each of four levels.
        let mut c0 = poles[level];
        let x = poles[level + 1];
        let mut c1 = c0 * before + x * own;
        (c0, poles[level + 1]) = (x, c1);
        let x = poles[level + 2];
        let y = c0 * before + x * own;
        let mut c2 = c1 * before + y * own;
        (c0, c1, poles[level + 2]) = (x, y, c2);
        let x = poles[level + 3];
        let y = c0 * before + x * own;
        let z = c1 * before + y * own;
        let mut c3 = c2 * before + z * own;
        (c0, c1, c2, poles[level + 3]) = (x, y, z, c3);
        for pole in &mut poles[level + 4..] {
            let x = *pole;
            let y = c0 * before + x * own;
            let z = c1 * before + y * own;
            let w = c2 * before + z * own;
            *pole = c3 * before + w * own;
            (c0, c1, c2, c3) = (x, y, z, w);
        }
        level += 4;
    }
    while level + 1 < count {
        let mut last = poles[level];
        for pole in &mut poles[level + 1..] {
            let x = *pole;
            *pole = last * before + x * own;
            last = x;
        }
        level += 1;
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
        for j in 0..width {
            cut::<S>(lanes, p, [j, width], s);
        }
        for i in 0..=p {
            cut::<S>(lanes, q, [i * width, 1], t);
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
