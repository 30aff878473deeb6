//! The net of a box: cut out of a piece, with as few poles as it needs there, seen from the query.

use crate::bezier::Bidegree;
use crate::bounds::{HALF_ULP, Vector};
use crate::coefficients::{Ladder, NetFalls, Rung};
use crate::jet::Lane;
use crate::knots::MAX_DEGREE;
use crate::simd::{Kernel, Lanes, Simd};

/// Cuts a piece to a box, into `lanes` as `r = X - W q` and `W`, and into `net` the same component by component. Rounding as
/// of [`crate::bezier::cut`].
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
    /// To how low degrees it may be lowered, and how far that may likely move its points.
    pub lower: Option<(&'a Ladder, f64)>,
    /// As many as poles.
    pub lanes: &'a mut [Lane],
    /// Four times as many.
    pub net: &'a mut [f64],
}

/// What has been cut out.
#[derive(Clone, Copy, Debug, Default)]
pub struct Cut {
    /// The greatest `|r| / W`.
    pub radius: f64,
    /// Of the product of the net with itself.
    pub rung: Rung,
    /// Number of poles.
    pub count: usize,
    /// Degree in t.
    pub columns: usize,
    /// How far `r / W` is off since the degrees are lower, as poles of the degrees of the piece.
    pub off: f64,
    /// The same of W, as a share.
    pub off_weight: f64,
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
    type Out = Cut;

    #[inline(always)]
    fn run<S: Simd>(self, _: S) -> Cut {
        let Self { poles, degree, rational, s, t, query, lower, lanes, net } = self;
        let Bidegree { s: mut p, t: mut q } = degree;
        lanes.copy_from_slice(poles);
        for j in 0..=q {
            cut::<S>(lanes, p, [j, q + 1], s);
        }
        let mut rung = [0; 2];
        let mut off = [0.0; 4];
        if let Some((ladder, tolerance)) = lower {
            let strands = [q + 1, 1, q + 1];
            let falls = ladder.net(0);
            rung[0] = pick::<S>(falls, lanes, strands, query, rational, tolerance);
            if rung[0] > 0 {
                off = falls.lower::<S>(rung[0], lanes, strands, [1, q + 1]);
                p = falls.degree(rung[0]);
            }
        }
        for i in 0..=p {
            cut::<S>(lanes, q, [i * (q + 1), 1], t);
        }
        if let Some((ladder, tolerance)) = lower {
            let strands = [p + 1, q + 1, 1];
            let falls = ladder.net(1);
            let part = &lanes[..(p + 1) * (q + 1)];
            rung[1] = pick::<S>(falls, part, strands, query, rational, tolerance);
            if rung[1] > 0 {
                let columns = falls.degree(rung[1]) + 1;
                let more = falls.lower::<S>(rung[1], lanes, strands, [columns, 1]);
                for (off, more) in off.iter_mut().zip(more) {
                    *off += more;
                }
                q = columns - 1;
            }
        }
        let (size, count) = (length(query), (p + 1) * (q + 1));
        let query = S::F4::load(&[query[0], query[1], query[2], 0.0]);
        let mut greatest: f64 = 0.0;
        let mut least_weight: f64 = 1.0;
        for (k, lane) in lanes[..count].iter_mut().enumerate() {
            // Cutting ones rounds; the weights of a polynomial are exact.
            let w = if rational { lane[3] } else { 1.0 };
            least_weight = if w < least_weight { w } else { least_weight };
            let [x, y, z, _] = (S::F4::load(lane) - S::F4::splat(w) * query).array();
            *lane = [x, y, z, w];
            (net[k], net[count + k]) = (x, y);
            (net[2 * count + k], net[3 * count + k]) = (z, w);
            let squared = x * x + y * y + z * z;
            let ratio = if rational { squared / (w * w) } else { squared };
            greatest = if ratio > greatest { ratio } else { greatest };
        }
        let radius = greatest.sqrt() * (1.0 + 8.0 * HALF_ULP);
        let mut cut = Cut { radius, rung, count, columns: q, off: 0.0, off_weight: 0.0 };
        if rung != [0; 2] {
            let off_weight = if rational { off[3] } else { 0.0 };
            let room = least_weight - off_weight;
            let moved = length([off[0], off[1], off[2]]) + (size + radius) * off_weight;
            let is_sound = room > 0.5 * least_weight;
            cut.off = if is_sound { moved / room * (1.0 + 1e-6) } else { f64::INFINITY };
            cut.off_weight = off_weight / room * (1.0 + 1e-6);
        }
        cut
    }
}

#[inline(always)]
fn length([x, y, z]: Vector) -> f64 {
    (x * x + y * y + z * z).sqrt()
}

/// The rung to which strands (count, pole between starts, between poles) may be lowered.
#[inline(always)]
fn pick<S: Simd>(
    falls: NetFalls,
    lanes: &[Lane],
    strands: [usize; 3],
    query: Vector,
    rational: bool,
    tolerance: f64,
) -> u8 {
    let (mut least_weight, mut scale): (f64, f64) = (1.0, 0.0);
    if rational {
        for [x, y, z, w] in lanes {
            least_weight = if *w < least_weight { *w } else { least_weight };
            let size = length([*x, *y, *z]) / *w;
            scale = if size > scale { size } else { scale };
        }
        scale += 2.0 * length(query);
    }
    falls.choose::<S>(lanes, strands, scale, tolerance * least_weight)
}
