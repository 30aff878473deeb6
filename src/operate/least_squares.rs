//! Poles over coarser knots or of a lower degree whose finer form is nearest to given poles: a banded least-squares problem.
//!
//! The map E from the wanted poles to the finer ones has rows of a few neighbouring shares. Rows are rotated one after the other
//! into a banded triangle (Givens), so that no digits are lost by squaring the condition:
//!
//! ```text
//!   x x x . .          x x x . .
//!   . x x x .    ->    . x x x .      each new row meets the triangle at its first share
//!   . x x . .          . . x x .      and is turned away into the rows below
//! ```
//!
//! Reference: Golub, Van Loan, *Matrix Computations*, section 5.2 (Givens); Dierckx, *Curve and Surface Fitting with Splines*, 1993, chapter 4.

use super::map::Map;
use crate::curve::insertion::{Weighted, room};
use crate::error::Error;
use crate::knots::MAX_MAGNITUDE;
use crate::portable::SameDigits;

/// Homogeneous coordinates around a centre.
type Raised = [f64; 4];

/// The strands over the coarse knots whose image under `map` is nearest to `strands`, the first and the last pole kept; none where a
/// weight would not be positive.
pub(super) fn nearest(map: &Map, strands: &[Weighted]) -> Result<Option<Vec<Weighted>>, Error> {
    let fine = map.knots.pole_count();
    let mut out = room(strands.len() / fine * map.from)?;
    for strand in strands.chunks_exact(fine) {
        let centre = strand[fine / 2].pole;
        let targets = strand.iter().map(|point| raised(point, centre)).collect();
        let fixed = [raised(&strand[0], centre), raised(&strand[fine - 1], centre)];
        for h in solve(map, targets, fixed) {
            if !(h[3] > 1.0 / MAX_MAGNITUDE && h[3] < MAX_MAGNITUDE) {
                return Ok(None);
            }
            let pole = [0, 1, 2].map(|axis| centre[axis] + h[axis] / h[3]);
            out.push(Weighted { pole, weight: h[3] });
        }
        let ends = [out.len() - map.from, out.len() - 1];
        (out[ends[0]], out[ends[1]]) = (strand[0], strand[fine - 1]);
    }
    Ok(Some(out))
}

fn raised(point: &Weighted, centre: [f64; 3]) -> Raised {
    let [x, y, z] = [0, 1, 2].map(|axis| point.weight * (point.pole[axis] - centre[axis]));
    [x, y, z, point.weight]
}

/// A row of the triangle: shares from its diagonal on, and the right side.
#[derive(Clone, Default)]
struct Row {
    shares: Vec<f64>,
    target: Raised,
}

fn solve(map: &Map, targets: Vec<Raised>, fixed: [Raised; 2]) -> Vec<Raised> {
    let last = map.from - 1;
    let mut triangle: Vec<Row> = vec![Row::default(); map.from];
    for ((first, shares), mut target) in map.rows().zip(targets) {
        let mut shares = shares.to_vec();
        for (known, value) in [(0, fixed[0]), (last, fixed[1])] {
            if let Some(share) = known.checked_sub(first).and_then(|k| shares.get_mut(k)) {
                target = std::array::from_fn(|x| target[x] - *share * value[x]);
                *share = 0.0;
            }
        }
        rotate(&mut triangle, first, shares, target);
    }
    let mut found = vec![[0.0; 4]; map.from];
    (found[0], found[last]) = (fixed[0], fixed[1]);
    for i in (1..last).rev() {
        let Row { shares, target } = &triangle[i];
        let known = |x: usize| {
            let terms = shares.iter().enumerate().skip(1);
            terms
                .filter(|(k, _)| i + k < last)
                .map(|(k, share)| share * found[i + k][x])
                .sum::<f64>()
        };
        let value = std::array::from_fn(|x| (target[x] - known(x)) / shares[0]);
        found[i] = value;
    }
    found
}

/// Turns a row into the triangle.
fn rotate(triangle: &mut [Row], first: usize, mut shares: Vec<f64>, mut target: Raised) {
    for k in 0..shares.len() {
        let pivot = shares[k];
        if pivot == 0.0 {
            continue;
        }
        let row = &mut triangle[first + k];
        if row.shares.is_empty() {
            (row.shares, row.target) = (shares.split_off(k), target);
            return;
        }
        row.shares.resize(row.shares.len().max(shares.len() - k), 0.0);
        let length = row.shares[0].hypotenuse(pivot);
        let (c, s) = (row.shares[0] / length, pivot / length);
        shares.resize(shares.len().max(k + row.shares.len()), 0.0);
        for (a, b) in row.shares.iter_mut().zip(&mut shares[k..]) {
            (*a, *b) = (c * *a + s * *b, c * *b - s * *a);
        }
        for x in 0..4 {
            let (a, b) = (row.target[x], target[x]);
            (row.target[x], target[x]) = (c * a + s * b, c * b - s * a);
        }
        shares[k] = 0.0;
    }
}
