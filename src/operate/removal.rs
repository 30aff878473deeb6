//! Knot removal: fewer poles, another shape nearby, and how near is proven.
//!
//! Taking out one of the s copies of x asks for poles Q with `b_i Q_{i-1} + a_i Q_i = P_i` for p - s + 1 neighbouring i: one equation
//! more than unknowns. One combination y of the equations holds no unknown, so what cannot be met is `c = sum y_i P_i - ..`, whatever Q
//! is. It is shared out so that the greatest residual is least:
//!
//! ```text
//!   r_i = c sign(y_i) / sum |y_i|,     all |r_i| equal
//! ```
//!
//! The rest is solved from both ends towards the middle, each step dividing by the greater of `a_i`, `b_i`, so that nothing grows.
//! Rational shapes are treated in homogeneous coordinates around a local pole; the error is Euclidean all the same, from the poles after the
//! knot has been put back (see [`Difference`](super::Difference)).
//!
//! Reference: Tiller, *Knot-removal algorithms for NURBS curves and surfaces*, 1992; Eck, Hadenfeld, *Knot removal for B-spline
//! curves*, 1995 (the least greatest residual).

use super::difference::direct;
use super::{Bounded, Direction, Surface, check_tolerance};
use crate::curve::Curve;
use crate::curve::insertion::{Weighted, checked, copy_of, mix, room};
use crate::error::Error;
use crate::knots::{Knots, MAX_MAGNITUDE};
use std::ops::Range;

impl Curve {
    /// The curve without `times` copies of the knot `u`, and the proven error.
    ///
    /// # Errors
    /// `u` is not a knot inside the domain, or not so often; weights that would not stay positive; memory that could not be had.
    pub fn remove_knot(&self, u: f64, times: usize) -> Result<Bounded<Self>, Error> {
        let (knots, strands) = removed(self.knots(), "u", u, times, self.strand()?)?;
        let shape = self.like(knots, &strands)?;
        let error = self.difference(&shape)?.bound;
        Ok(Bounded { shape, error })
    }

    /// The curve without the knots that are not needed to stay within `tolerance`: at each step the one whose removal changes least. The error is
    /// proven and at most the tolerance. Cost: O(n^2) at worst, with a small factor.
    ///
    /// # Errors
    /// A tolerance that is negative or not finite; memory that could not be had.
    pub fn simplify(&self, tolerance: f64) -> Result<Bounded<Self>, Error> {
        check_tolerance(tolerance)?;
        let mut allowed = tolerance;
        for _ in 0..MOST_TRIALS {
            let (knots, strands) = thinned(self.knots(), self.strand()?, allowed)?;
            let shape = self.like(knots, &strands)?;
            let error = self.difference(&shape)?.bound;
            if error <= tolerance {
                return Ok(Bounded { shape, error });
            }
            allowed *= 0.5;
        }
        Ok(Bounded { shape: self.clone(), error: 0.0 })
    }
}

impl Surface {
    /// The surface without `times` copies of a knot in a direction, and the proven error.
    ///
    /// # Errors
    /// As for curves.
    pub fn remove_knot(
        &self,
        direction: Direction,
        value: f64,
        times: usize,
    ) -> Result<Bounded<Self>, Error> {
        let (knots, strands) = (self.knots(direction), self.strands(direction)?);
        let (knots, strands) = removed(knots, "value", value, times, strands)?;
        let shape = self.with_strands(direction, knots, &strands)?;
        let error = self.difference(&shape)?.bound;
        Ok(Bounded { shape, error })
    }

    /// The surface without the knots that are not needed to stay within `tolerance`, first along u, then along v. The error is proven and at
    /// most the tolerance.
    ///
    /// # Errors
    /// A tolerance that is negative or not finite; memory that could not be had.
    pub fn simplify(&self, tolerance: f64) -> Result<Bounded<Self>, Error> {
        check_tolerance(tolerance)?;
        let mut allowed = tolerance;
        for _ in 0..MOST_TRIALS {
            let mut shape = self.clone();
            for direction in [Direction::U, Direction::V] {
                let (knots, strands) = (shape.knots(direction), shape.strands(direction)?);
                let (knots, strands) = thinned(knots, strands, 0.5 * allowed)?;
                shape = shape.with_strands(direction, knots, &strands)?;
            }
            let error = self.difference(&shape)?.bound;
            if error <= tolerance {
                return Ok(Bounded { shape, error });
            }
            allowed *= 0.5;
        }
        Ok(Bounded { shape: self.clone(), error: 0.0 })
    }
}

/// The sum of the errors of the steps bounds the error of all but for rounding, so that the first trial holds unless the tolerance is near rounding.
const MOST_TRIALS: usize = 4;

/// The knots and strands without `times` copies of `u`; `name` is the parameter's name in an error.
fn removed(
    knots: &Knots,
    name: &str,
    u: f64,
    times: usize,
    mut strands: Vec<Weighted>,
) -> Result<(Knots, Vec<Weighted>), Error> {
    let ((start, end), copies) = (knots.domain(), knots.multiplicity(u));
    if !(start < u && u < end) || copies == 0 {
        return Err(Error::InvalidArgument(format!("{name}: {u} is not a knot inside the domain")));
    }
    if times > copies {
        let text = format!("times: {times} given, {name} = {u} is a knot {copies} times");
        return Err(Error::InvalidArgument(text));
    }
    let (p, mut values) = (knots.degree(), copy_of(knots.values())?);
    for _ in 0..times {
        let gap = Gap::new(&values, p, u);
        let Some((without, _)) = gap.close(&strands, values.len() - p - 1)? else {
            return Err(Error::Unsupported(format!(
                "{name}: without {u} a weight is not positive"
            )));
        };
        strands = without;
        values.remove(gap.last);
    }
    Ok((checked(&values, p)?, strands))
}

/// One copy of a knot that is to go: the equations around it.
struct Gap {
    /// Index of its last copy.
    last: usize,
    /// The first of the poles that have an equation.
    first: usize,
    /// The shares `b_i` and `a_i` of each equation.
    shares: Vec<[f64; 2]>,
    degree: usize,
}

impl Gap {
    fn new(values: &[f64], degree: usize, x: f64) -> Self {
        let above = values.partition_point(|&u| u <= x);
        let copies = above - values.partition_point(|&u| u < x);
        let last = above - 1;
        let first = last - degree;
        // The knot i + p of the coarse vector stands one further in the fine one.
        let share = |i: usize| {
            let (low, high) = (values[i], values[i + degree + 1]);
            [(high - x) / (high - low), (x - low) / (high - low)]
        };
        Self { last, first, shares: (first..=last - copies).map(share).collect(), degree }
    }

    /// The strands without the knot and a bound of the change; none when a weight would not be positive.
    fn close(
        &self,
        strands: &[Weighted],
        count: usize,
    ) -> Result<Option<(Vec<Weighted>, f64)>, Error> {
        let mut out = room(strands.len() / count * (count - 1))?;
        let mut most = 0.0_f64;
        for strand in strands.chunks_exact(count) {
            let Some((poles, error)) = self.solve(strand) else { return Ok(None) };
            most = most.max(error);
            out.extend_from_slice(&strand[..self.first]);
            out.extend(poles);
            out.extend_from_slice(&strand[self.first + self.shares.len()..]);
        }
        Ok(Some((out, most)))
    }

    /// A bound of the change; infinite when the knot cannot go.
    fn error(&self, strands: &[Weighted], count: usize) -> f64 {
        let of = |strand: &[Weighted]| self.solve(strand).map_or(f64::INFINITY, |(_, error)| error);
        strands.chunks_exact(count).map(of).fold(0.0, f64::max)
    }

    /// The poles that replace those of the equations, one fewer, and a bound of the change.
    fn solve(&self, strand: &[Weighted]) -> Option<(Vec<Weighted>, f64)> {
        let (count, centre) = (self.shares.len(), strand[self.first + self.shares.len() / 2].pole);
        let raised = |point: &Weighted| -> [f64; 4] {
            let w = point.weight;
            let [x, y, z] = [0, 1, 2].map(|axis| w * (point.pole[axis] - centre[axis]));
            [x, y, z, w]
        };
        let mut target: Vec<[f64; 4]> =
            strand[self.first..self.first + count].iter().map(raised).collect();
        let ends = [&strand[self.first - 1], &strand[self.first + count]].map(raised);
        self.share_out(&mut target, ends);
        let mut found = vec![[0.0; 4]; count - 1];
        let [mut before, mut behind] = ends;
        let turn = self.shares.iter().take(count - 1).take_while(|[b, a]| a >= b).count();
        for i in 0..turn {
            let [b, a] = self.shares[i];
            before = std::array::from_fn(|x| (target[i][x] - b * before[x]) / a);
            found[i] = before;
        }
        for i in (turn + 1..count).rev() {
            let [b, a] = self.shares[i];
            behind = std::array::from_fn(|x| (target[i][x] - a * behind[x]) / b);
            found[i - 1] = behind;
        }
        if found.iter().any(|h| !(h[3] > 0.0 && h[3] < MAX_MAGNITUDE && h[3] > 1.0 / MAX_MAGNITUDE))
        {
            return None;
        }
        let lowered = |h: [f64; 4]| Weighted {
            pole: [0, 1, 2].map(|axis| centre[axis] + h[axis] / h[3]),
            weight: h[3],
        };
        let poles: Vec<Weighted> = found.into_iter().map(lowered).collect();
        let error = self.change(strand, &poles);
        Some((poles, error))
    }

    /// Moves the right sides to where all equations can be met.
    fn share_out(&self, target: &mut [[f64; 4]], [before, behind]: [[f64; 4]; 2]) {
        let count = self.shares.len();
        let mut y = vec![1.0; count];
        for i in 1..count {
            y[i] = -y[i - 1] * self.shares[i - 1][1] / self.shares[i][0];
        }
        let total: f64 = y.iter().map(|y| y.abs()).sum();
        for x in 0..4 {
            let sum: f64 = y.iter().zip(target.iter()).map(|(y, h)| y * h[x]).sum();
            let known = y[0] * self.shares[0][0] * before[x]
                + y[count - 1] * self.shares[count - 1][1] * behind[x];
            let each = (sum - known) / total;
            for (h, y) in target.iter_mut().zip(&y) {
                h[x] -= each * y.signum();
            }
        }
    }

    /// A bound of the change: the knot is put back, and poles are compared.
    fn change(&self, strand: &[Weighted], poles: &[Weighted]) -> f64 {
        let count = self.shares.len();
        let reach = self.first.saturating_sub(self.degree)
            ..(self.first + count + self.degree).min(strand.len());
        let mut nets = [strand[reach.clone()].to_vec(), strand[reach.clone()].to_vec()];
        for (i, [b, a]) in self.shares.iter().enumerate() {
            let low = if i == 0 { &strand[self.first - 1] } else { &poles[i - 1] };
            let high = poles.get(i).unwrap_or(&strand[self.first + count]);
            nets[1][self.first - reach.start + i] = mix(low, high, [*b, *a]);
        }
        direct(&nets)
    }
}

/// The strands without the knots whose removal keeps every span within `tolerance`.
fn thinned(
    knots: &Knots,
    strands: Vec<Weighted>,
    tolerance: f64,
) -> Result<(Knots, Vec<Weighted>), Error> {
    let mut state = Thinning::new(knots, strands);
    while let Some(place) = state.cheapest(tolerance) {
        state.remove(place)?;
    }
    Ok((checked(&state.values, state.degree)?, state.strands))
}

/// What is left, what each removal would change, and what has been changed on each span so far.
struct Thinning {
    degree: usize,
    values: Vec<f64>,
    strands: Vec<Weighted>,
    /// By knot index, for the last copies of inner knots; infinite elsewhere.
    costs: Vec<f64>,
    /// By knot index i, the error on the span from knot i to the next.
    spent: Vec<f64>,
    domain: (f64, f64),
}

impl Thinning {
    fn new(knots: &Knots, strands: Vec<Weighted>) -> Self {
        let (values, degree) = (knots.values().to_vec(), knots.degree());
        let blank = vec![0.0; values.len()];
        let mut state = Self {
            degree,
            strands,
            costs: blank.clone(),
            spent: blank,
            domain: knots.domain(),
            values,
        };
        state.price(0..state.values.len());
        state
    }

    fn price(&mut self, range: Range<usize>) {
        let count = self.values.len() - self.degree - 1;
        for i in range {
            let u = self.values[i];
            let inner = self.domain.0 < u && u < self.domain.1;
            let is_last = self.values.get(i + 1).is_some_and(|next| *next > u);
            self.costs[i] = if inner && is_last {
                Gap::new(&self.values, self.degree, u).error(&self.strands, count)
            } else {
                f64::INFINITY
            };
        }
    }

    /// The spans, as knot indices, that removing the knot at `last` changes.
    fn touched(&self, last: usize) -> Range<usize> {
        last - self.degree..(last + self.degree + 1).min(self.values.len())
    }

    fn cheapest(&self, tolerance: f64) -> Option<usize> {
        let fits = |&i: &usize| {
            let most = self.spent[self.touched(i)].iter().fold(0.0, |most: f64, x| most.max(*x));
            most + self.costs[i] <= tolerance
        };
        let all = self.degree..self.values.len() - self.degree;
        all.filter(|&i| self.costs[i].is_finite())
            .filter(fits)
            .min_by(|&i, &k| self.costs[i].total_cmp(&self.costs[k]))
    }

    fn remove(&mut self, last: usize) -> Result<(), Error> {
        let count = self.values.len() - self.degree - 1;
        let gap = Gap::new(&self.values, self.degree, self.values[last]);
        match gap.close(&self.strands, count)? {
            Some((strands, error)) => {
                self.strands = strands;
                for span in self.touched(last) {
                    self.spent[span] += error;
                }
                let both = self.spent[last].max(self.spent[last - 1]);
                self.spent[last - 1] = both;
                for list in [&mut self.values, &mut self.costs, &mut self.spent] {
                    list.remove(last);
                }
                let reach = 2 * self.degree + 1;
                self.price(last.saturating_sub(reach)..(last + reach).min(self.values.len()));
            }
            None => self.costs[last] = f64::INFINITY,
        }
        Ok(())
    }
}
