//! Lines between patches across which a surface is smooth though its knots do not say so, and seams that are none.
//!
//! On a line where two patches A and B meet, `S_k = Q / W^2` for both, with Q a polynomial along the line. They are smooth when
//! `Q_A = r Q_B` for one number r along the whole line: then S is C1 when the parameters beyond the line are stretched.
//! What the data leave of `Q_A - r Q_B` is a kink, which is allowed for (`docs/rounding.md`, section 21).

use super::MARGIN;
use super::cell::quotient;
use super::oriented::extent;
use crate::bezier::Bidegree;
use crate::bounds::{Vector, add, dot, norm, scaled, sub};
use crate::error::Error;
use crate::index::patch::{Patch, side};
use crate::index::piece::{position_error, position_steps, reserved};

/// Derivatives that differ by a smaller share are one, and so are sides that are nearer.
const KINK: f64 = 1e-9;
const GAP: f64 = 1e-12;

/// The patches of a surface.
pub struct Net<'a> {
    pub patches: &'a [Patch],
    /// Number of patches in v.
    pub columns: usize,
    pub degree: Bidegree,
    pub rational: bool,
    /// The poles of a patch; none for a surface so large that they are not looked at.
    pub poles: Option<&'a dyn Fn(usize) -> &'a [f64]>,
}

/// The lines of a surface.
#[derive(Debug, Default)]
pub struct Joints {
    /// Of each line between rows, between columns of patches, with the first and the last side of the surface: whether it is
    /// smooth. A smooth seam is so at both.
    pub smooth: [Vec<bool>; 2],
    /// By what the parameters of each row, of each column are stretched.
    pub stretch: [Vec<f64>; 2],
    /// Greatest share by which derivatives jump at a smooth line.
    pub kink: f64,
    /// Greatest distance between the sides of a smooth seam.
    pub gap: f64,
}

/// What two patches show: the derivative of the first over that of the second, and how much they differ.
struct Join {
    ratio: f64,
    kink: f64,
    gap: f64,
}

impl Joints {
    /// Of a surface; without poles its lines are smooth where their knots say so.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn new(net: &Net) -> Result<Self, Error> {
        let columns = net.columns;
        let counts = [net.patches.len() / columns, columns];
        let mut out = Self::default();
        for k in 0..2 {
            let (count, stride) = (counts[k], [columns, 1][k]);
            let mut smooth = reserved(count + 1)?;
            let mut stretch = reserved(count)?;
            smooth.push(false);
            stretch.push(1.0);
            for line in 1..count {
                let is_knot = !net.patches[line * stride].border[2 * k];
                let join = if is_knot { None } else { join(net, k, line - 1, line, counts[1 - k]) };
                smooth.push(is_knot || join.is_some());
                let before = stretch[line - 1];
                stretch.push(match join {
                    Some(join) => {
                        out.kink = out.kink.max(join.kink);
                        before / join.ratio
                    }
                    None => {
                        if is_knot {
                            before
                        } else {
                            1.0
                        }
                    }
                });
            }
            smooth.push(false);
            if let Some(join) = join(net, k, count - 1, 0, counts[1 - k]) {
                let turn = (join.ratio * stretch[0] / stretch[count - 1] - 1.0).abs();
                if turn + join.kink <= KINK && join.gap <= GAP {
                    out.kink = out.kink.max(turn + join.kink);
                    out.gap = out.gap.max(join.gap);
                    (smooth[0], smooth[count]) = (true, true);
                }
            }
            (out.smooth[k], out.stretch[k]) = (smooth, stretch);
        }
        Ok(out)
    }
}

/// The line between rows (k = 0) or columns of patches, the first before it; `None` where it is not smooth.
fn join(net: &Net, k: usize, before: usize, after: usize, count: usize) -> Option<Join> {
    let patch = |line: usize, n: usize| {
        if k == 0 { line * net.columns + n } else { n * net.columns + line }
    };
    // The ratio of a patch in the middle is that of all.
    let (mut ratio, mut kink, mut gap) = (None, 0.0f64, 0.0f64);
    for n in std::iter::once(count / 2).chain(0..count) {
        let a = Edge::new(net, patch(before, n), k, true)?;
        let b = Edge::new(net, patch(after, n), k, false)?;
        let join = a.join(&b, ratio)?;
        ratio = Some(join.ratio);
        (kink, gap) = (kink.max(join.kink), gap.max(join.gap));
    }
    Some(Join { ratio: ratio?, kink, gap })
}

/// A side of a patch: its poles, and Q along it.
struct Edge {
    weights: Vec<f64>,
    points: Vec<Vector>,
    slopes: Vec<Vector>,
    /// Width of the patch across the side, rounding of its poles and of Q.
    width: f64,
    error: f64,
    blur: f64,
}

impl Edge {
    fn new(net: &Net, at: usize, k: usize, at_end: bool) -> Option<Self> {
        let (patch, poles, degree) = (&net.patches[at], net.poles?(at), net.degree);
        let [p, q] = if k == 0 { [degree.s, degree.t] } else { [degree.t, degree.s] };
        let on = [[side::S0, side::S1], [side::T0, side::T1]][k][usize::from(at_end)];
        // Other parameters than the surface's, or none.
        if patch.u.balance != 1.0 || patch.v.balance != 1.0 || patch.collapsed[on] {
            return None;
        }
        let row = |component: &[f64], i: usize| -> Vec<f64> {
            let place = |j: usize| if k == 0 { i * (q + 1) + j } else { j * (p + 1) + i };
            (0..=q).map(|j| component[place(j)]).collect()
        };
        let along = Bidegree { s: 0, t: q };
        let (mut rows, mut steps) = (Vec::new(), Vec::new());
        for component in poles.chunks_exact(degree.count()) {
            let (i, j) = if at_end { (p, p - 1) } else { (0, 1) };
            let (here, inner) = (row(component, i), row(component, j));
            let sign = if at_end { p as f64 } else { -(p as f64) };
            steps.extend(here.iter().zip(&inner).map(|(x, y)| sign * (x - y)));
            rows.extend(here);
        }
        let n = q + 1;
        let weights = if net.rational { rows[3 * n..].to_vec() } else { vec![1.0; n] };
        let points = (0..n).map(|j| {
            let local = [0, 1, 2].map(|c| rows[c * n + j] / weights[j]);
            add(patch.center, local)
        });
        let points = points.collect();
        let mut order = along;
        let slopes = if net.rational {
            order = along.times(along);
            let (x, w) = rows.split_at(3 * n);
            let slope = steps.split_off(3 * n);
            quotient(x, w, along, steps, slope, along)
        } else {
            steps
        };
        let m = order.count();
        let slopes = (0..m).map(|j| [0, 1, 2].map(|c| slopes[c * m + j])).collect();
        let steps = position_steps(degree.s + degree.t);
        let error = position_error(steps, net.rational, patch.radius, patch.radius, 2.0);
        let error = error + patch.spread;
        let [least, most] = extent(weights.iter().map(|w| w * w));
        let blur = 16.0 * p as f64 * error * most * (most / least);
        let ends = [patch.u, patch.v][k].ends;
        Some(Self { weights, points, slopes, width: ends[1] - ends[0], error, blur })
    }

    /// With the side of the patch beyond, for a ratio that is known, or the best one.
    fn join(&self, other: &Self, ratio: Option<f64>) -> Option<Join> {
        // The same weights but for a factor.
        let factor = other.weights[0] / self.weights[0];
        let pairs = self.weights.iter().zip(&other.weights);
        let uneven = pairs.fold(0.0, |most: f64, (a, b)| most.max((b / factor - a).abs() / a));
        let uneven = uneven + self.error + other.error;
        // From Q of the other to S_k of this, and from a ratio of Q to that of S_k.
        let scale = factor * factor * other.width / self.width;
        let sums =
            [self, other].map(|edge| edge.slopes.iter().fold([0.0; 3], |sum, x| add(sum, *x)));
        let share = match ratio {
            Some(ratio) => ratio / scale,
            None => dot(sums[0], sums[1]) / dot(sums[1], sums[1]),
        };
        let pairs = self.slopes.iter().zip(&other.slopes);
        let off = pairs.fold(0.0, |most: f64, (a, b)| most.max(norm(sub(*a, scaled(*b, share)))));
        let mean = scaled(sums[0], 1.0 / self.slopes.len() as f64);
        let spread = self.slopes.iter().fold(0.0, |most: f64, x| most.max(norm(sub(*x, mean))));
        let least = norm(mean) - spread - self.blur;
        let kink = ((off + self.blur + share * other.blur) / least + 2.0 * uneven) * MARGIN;
        let pairs = self.points.iter().zip(&other.points);
        let apart = pairs.fold(0.0, |most: f64, (a, b)| most.max(norm(sub(*a, *b))));
        let gap = (apart + 4.0 * uneven + self.error + other.error) * MARGIN;
        let is_one = least > 0.0 && share > 0.0 && kink <= KINK;
        is_one.then_some(Join { ratio: share * scale, kink, gap })
    }
}
