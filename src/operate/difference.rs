//! How far two shapes are apart at equal parameters, with a proof.
//!
//! On a common Bezier piece the difference of two rational forms of degree p is
//!
//! ```text
//!   A/w - B/v = sum_k c_k D_k / sum_k c_k,   c_k D_k = sum_{i+j=k} s_ij w_i v_j (P_i - Q_j),   all c_k > 0
//! ```
//!
//! a mean of the vectors D_k, so that no difference is longer than the longest of them: the hull of the difference, in Euclidean
//! form. With weights that agree up to a factor and a share e, it also is at most
//!
//! ```text
//!   max |P_i - Q_i| + 2 e / (1 - e) max |Q_i - Q_0|
//! ```
//!
//! which is what polynomials have with e = 0. Pieces whose bound is the greatest are halved until the bound is met by a
//! point within [`GAP`]. Both numbers are loosened by what rounding may do, derived at [`Rounding`].
//!
//! Limit: it is a distance at equal parameters; the Hausdorff distance is at most that, and may be far less.

use super::pieces::{Cut, breaks, patch, patch_net};
use super::{Direction, Surface};
use crate::bezier::binomial;
use crate::bounds::{Aabb, HALF_ULP, Vector, norm, sub};
use crate::curve::Curve;
use crate::curve::insertion::{Weighted, mix, spare};
use crate::error::Error;
use crate::knots::Knots;
use std::collections::BinaryHeap;

/// The search ends when the bound exceeds a difference that was found by no more than this share.
pub const GAP: f64 = 1e-3;

/// Most halvings; the bound then is proven all the same, only less tight.
const MOST_HALVINGS: usize = 2000;

/// The greatest distance of two shapes at equal parameters, between two numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Difference {
    /// No points at equal parameters are farther apart. Proven.
    pub bound: f64,
    /// The points at `at` are at least so far apart.
    pub reached: f64,
    /// Parameters u, v of a difference nearly the greatest; v = 0 for curves.
    pub at: [f64; 2],
}

impl Curve {
    /// How far this curve and another over the same domain are apart at equal parameters. Degrees and knots may differ.
    ///
    /// # Errors
    /// Domains that differ; memory that could not be had.
    pub fn difference(&self, other: &Self) -> Result<Difference, Error> {
        same_domain("domain", self.knots(), other.knots())?;
        let degree = self.degree().max(other.degree());
        let common = common_breaks(self.knots(), other.knots())?;
        check_room(common.len(), degree + 1)?;
        let net = |curve: &Self| -> Result<_, Error> {
            let raised = curve.elevate(degree - curve.degree())?;
            let cut = Cut::new(raised.knots(), common.clone())?;
            cut.map.apply(&raised.strand()?)
        };
        let (ours, theirs) = (net(self)?, net(other)?);
        let steps = 1 + degree - self.degree().min(other.degree());
        let poles = [self.poles(), other.poles()];
        let rounding = Rounding::new(poles, [degree, 0], steps);
        let mut search = Search::new([degree, 0], rounding);
        for (i, ends) in common.windows(2).enumerate() {
            let range = i * degree..=i * degree + degree;
            let nets = [ours[range.clone()].to_vec(), theirs[range].to_vec()];
            search.include(nets, [ends[0], ends[1], 0.0, 0.0]);
        }
        Ok(search.finish())
    }
}

impl Surface {
    /// How far this surface and another over the same domain are apart at equal parameters. Degrees and knots may differ.
    ///
    /// # Errors
    /// Domains that differ; memory that could not be had.
    pub fn difference(&self, other: &Self) -> Result<Difference, Error> {
        let (mut degree, mut common, mut steps) = ([0; 2], [Vec::new(), Vec::new()], 2);
        for direction in [Direction::U, Direction::V] {
            let knots = [self.knots(direction), other.knots(direction)];
            same_domain(&format!("domain{}", direction.suffix()), knots[0], knots[1])?;
            let degrees = knots.map(Knots::degree);
            degree[direction.index()] = degrees[0].max(degrees[1]);
            common[direction.index()] = common_breaks(knots[0], knots[1])?;
            steps += degrees[0].abs_diff(degrees[1]);
        }
        check_room(common[0].len() * common[1].len(), (degree[0] + 1) * (degree[1] + 1))?;
        let cut = |surface: &Self| -> Result<_, Error> {
            let mut raised = surface.clone();
            for direction in [Direction::U, Direction::V] {
                let by = degree[direction.index()] - raised.knots(direction).degree();
                raised = raised.elevate(direction, by)?;
            }
            let u = Cut::new(raised.knots_u(), common[0].clone())?;
            let v = Cut::new(raised.knots_v(), common[1].clone())?;
            Ok((patch_net(&raised, &u, &v)?, u, v))
        };
        let ((ours, u, v), (theirs, ..)) = (cut(self)?, cut(other)?);
        let poles = [self.poles(), other.poles()];
        let mut search = Search::new(degree, Rounding::new(poles, degree, steps));
        for (i, along_u) in common[0].windows(2).enumerate() {
            for (j, along_v) in common[1].windows(2).enumerate() {
                let nets = [&ours, &theirs].map(|net| patch(net, &u, &v, i, j));
                search.include(nets, [along_u[0], along_u[1], along_v[0], along_v[1]]);
            }
        }
        Ok(search.finish())
    }
}

fn same_domain(name: &str, a: &Knots, b: &Knots) -> Result<(), Error> {
    if a.domain() == b.domain() {
        return Ok(());
    }
    let (a, b) = (a.domain(), b.domain());
    let text = format!("{name}: [{}, {}] and [{}, {}] differ", a.0, a.1, b.0, b.1);
    Err(Error::InvalidArgument(text))
}

fn common_breaks(a: &Knots, b: &Knots) -> Result<Vec<f64>, Error> {
    let mut all = super::refinement::merged(&breaks(a)?, &breaks(b)?)?;
    all.dedup();
    Ok(all)
}

/// Refuses what the pieces of both shapes would not fit into.
fn check_room(pieces: usize, poles: usize) -> Result<(), Error> {
    // The queue grows by doubling; nets are lists of their own.
    spare(pieces, 3 * size_of::<Part>() + 2 * (poles * size_of::<Weighted>() + 32))
}

/// What rounding may add to a length that is computed from the pieces.
///
/// With d the diagonal of both nets and m their largest coordinate, in half ulps: one map of poles of degree p moves a pole by
/// at most `(18 p + 25) d + 2 m` (shares within 8 (p + 1), their sum, the mean, the last addition), one level of a halving
/// by `8 d + 2 m`, and the products of the hull by `(n + 10) d` with n coefficients.
struct Rounding {
    fixed: f64,
    halving: f64,
}

impl Rounding {
    fn new(poles: [&[Vector]; 2], degree: [usize; 2], steps: usize) -> Self {
        let mut bounds = Aabb::EMPTY;
        poles.into_iter().flatten().for_each(|pole| bounds.include(*pole));
        let far = bounds.low.iter().chain(&bounds.high).fold(0.0, |far: f64, x| far.max(x.abs()));
        let (d, p) = (bounds.diagonal(), degree[0].max(degree[1]) as f64);
        let count = ((degree[0] + 1) * (degree[1] + 1)) as f64;
        let map = (18.0 * p + 25.0) * d + 2.0 * far;
        let fixed = HALF_ULP * (2.0 * steps as f64 * map + (count + 10.0) * d);
        Self { fixed, halving: HALF_ULP * 2.0 * p * (8.0 * d + 2.0 * far) }
    }

    fn after(&self, halvings: usize) -> f64 {
        self.fixed + halvings as f64 * self.halving
    }
}

/// A part of the domain with the nets of both shapes there.
struct Part {
    nets: [Vec<Weighted>; 2],
    domain: [f64; 4],
    halvings: [usize; 2],
    bound: f64,
}

impl PartialEq for Part {
    fn eq(&self, other: &Self) -> bool {
        self.bound == other.bound
    }
}

impl Eq for Part {}

impl PartialOrd for Part {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Part {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        self.bound.total_cmp(&other.bound)
    }
}

/// The search for the greatest difference, the part with the greatest bound first.
struct Search {
    degree: [usize; 2],
    rounding: Rounding,
    parts: BinaryHeap<Part>,
    reached: f64,
    at: [f64; 2],
}

impl Search {
    fn new(degree: [usize; 2], rounding: Rounding) -> Self {
        Self { degree, rounding, parts: BinaryHeap::new(), reached: -1.0, at: [0.0; 2] }
    }

    fn include(&mut self, nets: [Vec<Weighted>; 2], domain: [f64; 4]) {
        self.add(nets, domain, [0; 2]);
    }

    fn add(&mut self, nets: [Vec<Weighted>; 2], domain: [f64; 4], halvings: [usize; 2]) {
        let slack = self.rounding.after(halvings[0] + halvings[1]);
        let (width, last) = (self.degree[1] + 1, nets[0].len() - 1);
        let corners =
            [(0, [0, 2]), (width - 1, [0, 3]), (last + 1 - width, [1, 2]), (last, [1, 3])];
        for (k, ends) in corners {
            let found = norm(sub(nets[0][k].pole, nets[1][k].pole)) - slack;
            if found > self.reached {
                (self.reached, self.at) = (found, ends.map(|end| domain[end]));
            }
        }
        let bound = self.hull(&nets) * (1.0 + 8.0 * HALF_ULP) + slack;
        self.parts.push(Part { nets, domain, halvings, bound });
    }

    /// The least of the bounds of the head of this file.
    fn hull(&self, nets: &[Vec<Weighted>; 2]) -> f64 {
        let direct = direct(nets);
        let weights = nets.iter().flatten().map(|point| point.weight);
        let rational = weights.clone().any(|w| w != nets[0][0].weight);
        if rational { direct.min(product(nets, self.degree)) } else { direct }
    }

    fn finish(mut self) -> Difference {
        let mut bound = 0.0;
        for round in 0.. {
            let Some(part) = self.parts.pop() else { break };
            bound = part.bound;
            let slack = self.rounding.after(part.halvings[0] + part.halvings[1]);
            let is_met = bound <= self.reached * (1.0 + GAP) + 3.0 * slack;
            if is_met || round >= MOST_HALVINGS || part.halvings[0] + part.halvings[1] > 60 {
                break;
            }
            self.halve(part);
        }
        Difference { bound, reached: self.reached.max(0.0), at: self.at }
    }

    fn halve(&mut self, part: Part) {
        let [p, q] = self.degree;
        let first = q == 0 || (p > 0 && part.halvings[0] <= part.halvings[1]);
        let (axis, mut halvings) = (usize::from(!first), part.halvings);
        halvings[axis] += 1;
        let (mut low, mut high) = (part.domain, part.domain);
        let middle = 0.5 * part.domain[2 * axis] + 0.5 * part.domain[2 * axis + 1];
        (low[2 * axis + 1], high[2 * axis]) = (middle, middle);
        let mut behind = part.nets.clone();
        let mut before = part.nets;
        for (before, behind) in before.iter_mut().zip(&mut behind) {
            halve(before, behind, self.degree, axis);
        }
        self.add(before, low, halvings);
        self.add(behind, high, halvings);
    }
}

/// Splits a net at the middle of direction `axis`: `before` becomes the first half.
pub(super) fn halve(
    before: &mut [Weighted],
    behind: &mut [Weighted],
    degree: [usize; 2],
    axis: usize,
) {
    let width = degree[1] + 1;
    let (step, strands, p) =
        if axis == 0 { (width, 0..width, degree[0]) } else { (1, 0..degree[0] + 1, degree[1]) };
    for strand in strands {
        let at = |k: usize| if axis == 0 { strand + k * step } else { strand * width + k };
        for level in 1..=p {
            behind[at(p + 1 - level)] = before[at(p)];
            for k in (level..=p).rev() {
                before[at(k)] = mix(&before[at(k - 1)], &before[at(k)], [0.5, 0.5]);
            }
        }
        behind[at(0)] = before[at(p)];
    }
}

/// The longest difference of poles, and what weights that are not proportional may add.
pub(super) fn direct(nets: &[Vec<Weighted>; 2]) -> f64 {
    let (mut longest, mut spread) = (0.0_f64, 0.0_f64);
    let (mut low, mut high) = (f64::INFINITY, 0.0_f64);
    for (a, b) in nets[0].iter().zip(&nets[1]) {
        longest = longest.max(norm(sub(a.pole, b.pole)));
        spread = spread.max(norm(sub(b.pole, nets[1][0].pole)));
        let ratio = a.weight / b.weight;
        (low, high) = (low.min(ratio), high.max(ratio));
    }
    if low == high {
        return longest;
    }
    let e = (high - low) / (high + low) + 4.0 * HALF_ULP;
    if e < 1.0 { longest + 2.0 * e / (1.0 - e) * spread } else { f64::INFINITY }
}

/// The longest of the vectors `D_k` of the head of this file.
fn product(nets: &[Vec<Weighted>; 2], [p, q]: [usize; 2]) -> f64 {
    let (width, wide) = (q + 1, 2 * q + 1);
    let mut sums = vec![([0.0; 3], 0.0); (2 * p + 1) * wide];
    let scale = |k: usize| binomial(p, k / width) * binomial(q, k % width);
    for (k, a) in nets[0].iter().enumerate() {
        let w = a.weight / nets[0][0].weight * scale(k);
        for (l, b) in nets[1].iter().enumerate() {
            let share = w * (b.weight / nets[1][0].weight * scale(l));
            let place = (k / width + l / width) * wide + k % width + l % width;
            let apart: Vector = sub(a.pole, b.pole);
            let (sum, total) = &mut sums[place];
            *sum = [0, 1, 2].map(|axis| sum[axis] + share * apart[axis]);
            *total += share;
        }
    }
    sums.iter().fold(0.0, |longest: f64, (sum, total)| longest.max(norm(*sum) / total))
}
