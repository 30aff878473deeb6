//! Maps from poles to poles: every new pole is a mean of neighbouring old ones.
//!
//! A pole of a spline of degree p is its blossom at p knots in a row, `P_i = f(u_{i+1}, .., u_{i+p})`. The blossom at other
//! arguments `a_1 <= .. <= a_p` is a pole of every finer knot vector in which these stand in a row. Inserting the missing knots
//! one at a time mixes neighbours with positive shares; run backwards, from the one wanted pole to the old ones, that gives
//! the row of shares of this pole in O(p^2):
//!
//! ```text
//!   wanted pole      1
//!   without x_2      (1-a) a            a row of shares grows by at most one
//!   without x_1      ..  ..  ..         each time a knot is taken out
//! ```
//!
//! A finer or clamped vector takes one blossom a pole. Raising the degree takes the mean of blossoms:
//! `Q_i = 1/(p+1) sum_j f(v_{i+1}, .. without v_{i+j} .., v_{i+p+1})` over the knots v with all multiplicities raised by one.
//!
//! References: Ramshaw, *Blossoms are polar forms*, 1989; Prautzsch, *Degree elevation of B-spline curves*, 1984.
//! Rounding: every share carries at most `8 (p + 1)` half ulps of itself, since nothing is subtracted but knots.

use crate::curve::insertion::{Weighted, checked, room, spare};
use crate::error::Error;
use crate::knots::Knots;

/// The shares of the old poles `first ..` in a new one; they are not negative and sum to 1 up to rounding.
struct Row {
    first: usize,
    shares: Vec<f64>,
}

/// A linear map of strands of poles to strands over other knots, of the same splines.
pub(crate) struct Map {
    /// The knots of the new strands.
    pub knots: Knots,
    rows: Vec<Row>,
    /// Poles in an old strand.
    pub from: usize,
}

impl Map {
    /// To the vector `values` of the same degree, which between the first and the last `degree` of its knots has
    /// all knots of `from` that lie there.
    pub fn to(from: &Knots, values: &[f64]) -> Result<Self, Error> {
        let (p, knots) = (from.degree(), checked(values, from.degree())?);
        let mut rows = rows_for(knots.pole_count(), p)?;
        for i in 0..knots.pole_count() {
            rows.push(blossom(from, &values[i + 1..=i + p], values[i] < values[i + 1]));
        }
        Ok(Self { knots, rows, from: from.pole_count() })
    }

    /// To the next degree.
    pub fn elevation(from: &Knots) -> Result<Self, Error> {
        let (p, values) = (from.degree(), raised_knots(from)?);
        let knots = checked(&values, p + 1)?;
        let mut rows = rows_for(knots.pole_count(), p)?;
        for i in 0..knots.pole_count() {
            rows.push(mean_blossom(from, &values[i + 1..=i + p + 1], values[i] < values[i + 1]));
        }
        Ok(Self { knots, rows, from: from.pole_count() })
    }

    /// The new strands.
    pub fn apply(&self, strands: &[Weighted]) -> Result<Vec<Weighted>, Error> {
        let mut out = room(strands.len() / self.from * self.rows.len())?;
        for strand in strands.chunks_exact(self.from) {
            out.extend(self.rows.iter().map(|row| row.mean(strand)));
        }
        Ok(out)
    }

    /// The rows as `(first, shares)`, one a new pole.
    pub fn rows(&self) -> impl Iterator<Item = (usize, &[f64])> {
        self.rows.iter().map(|row| (row.first, &row.shares[..]))
    }
}

/// Room for rows whose shares are lists of their own.
fn rows_for(count: usize, degree: usize) -> Result<Vec<Row>, Error> {
    let rows = room(count)?;
    spare(count, 16 * (degree + 1) + 48)?;
    Ok(rows)
}

/// All knots once more, without those that no basis function on the domain reaches.
pub(crate) fn raised_knots(from: &Knots) -> Result<Vec<f64>, Error> {
    let mut all = room(2 * from.values().len())?;
    for (i, &u) in from.values().iter().enumerate() {
        all.push(u);
        if from.values().get(i + 1) != Some(&u) {
            all.push(u);
        }
    }
    let ((start, end), order) = (from.domain(), from.degree() + 2);
    let first = all.partition_point(|&u| u <= start) - order;
    let last = all.partition_point(|&u| u < end) + order;
    all.truncate(last);
    all.drain(..first);
    Ok(all)
}

impl Row {
    /// The mean in homogeneous coordinates, from the pole with the most influence.
    fn mean(&self, strand: &[Weighted]) -> Weighted {
        let local = &strand[self.first..self.first + self.shares.len()];
        if let [one] = local {
            return *one;
        }
        let parts = || self.shares.iter().zip(local).map(|(share, point)| share * point.weight);
        let weight: f64 = parts().sum();
        let (mut most, mut near) = (0.0, local[0].pole);
        for (part, point) in parts().zip(local) {
            if part > most {
                (most, near) = (part, point.pole);
            }
        }
        let mut pole = [0.0; 3];
        for (part, point) in parts().zip(local) {
            for axis in 0..3 {
                pole[axis] += part / weight * (point.pole[axis] - near[axis]);
            }
        }
        Weighted { pole: [0, 1, 2].map(|axis| near[axis] + pole[axis]), weight }
    }
}

/// The mean of the blossoms at the arguments without one of them.
fn mean_blossom(knots: &Knots, arguments: &[f64], is_first_run: bool) -> Row {
    let count = arguments.len();
    let (mut low, mut shares) = (usize::MAX, Vec::new());
    let mut start = 0;
    while start < count {
        let x = arguments[start];
        let copies = arguments[start..].iter().take_while(|&&u| u == x).count();
        let others = [&arguments[..start], &arguments[start + 1..]].concat();
        // Copies of one knot are the end of what comes before the left-out argument, or the start of what comes after it.
        let is_end = if arguments[0] < arguments[count - 1] { start == 0 } else { is_first_run };
        let row = blossom(knots, &others, is_end);
        if row.first < low {
            let more = if low == usize::MAX { 0 } else { low - row.first };
            shares.splice(0..0, std::iter::repeat_n(0.0, more));
            low = row.first;
        }
        let reach = row.first - low + row.shares.len();
        shares.resize(reach.max(shares.len()), 0.0);
        for (sum, share) in shares[row.first - low..].iter_mut().zip(&row.shares) {
            *sum += copies as f64 / count as f64 * share;
        }
        start += copies;
    }
    Row { first: low, shares }
}

/// The shares of the poles in the blossom at `arguments`, `degree` of them in order. Every knot between the first and the last
/// argument is among them, as often as it is a knot. Where all are one knot that tears the spline, `is_first_run` says
/// whether the piece before it is meant.
fn blossom(knots: &Knots, arguments: &[f64], is_first_run: bool) -> Row {
    let (p, t) = (knots.degree(), knots.values());
    let (low, high) = (arguments[0], arguments[p - 1]);
    let begin = t.partition_point(|&u| u < low).saturating_sub(p + 1);
    let end = (t.partition_point(|&u| u <= high) + p + 1).min(t.len());
    let missing = missing(&t[begin..end], arguments);
    let mut finest = [&t[begin..end], &missing].concat();
    finest.sort_by(f64::total_cmp);
    let at = place(&finest, arguments, is_first_run);
    let mut row = Row { first: at, shares: vec![1.0] };
    for &x in missing.iter().rev() {
        let last = finest.partition_point(|&u| u <= x) - 1;
        finest.remove(last);
        row = without(&finest, p, x, &row);
    }
    row.first += begin;
    row
}

/// The arguments that are not knots yet, each as often as it is missing, in order.
fn missing(t: &[f64], arguments: &[f64]) -> Vec<f64> {
    let copies =
        |list: &[f64], x: f64| list.partition_point(|&u| u <= x) - list.partition_point(|&u| u < x);
    let mut out = Vec::new();
    for (i, &x) in arguments.iter().enumerate() {
        let used = arguments[..i].iter().rev().take_while(|&&u| u == x).count();
        if used >= copies(t, x) {
            out.push(x);
        }
    }
    out
}

/// The pole whose arguments these are.
fn place(finest: &[f64], arguments: &[f64], is_first_run: bool) -> usize {
    let (low, high) = (arguments[0], arguments[arguments.len() - 1]);
    if low == high && is_first_run {
        return finest.partition_point(|&u| u < low) - 1;
    }
    let copies = arguments.partition_point(|&u| u <= low);
    finest.partition_point(|&u| u <= low) - copies - 1
}

/// The shares before the knot `x` is inserted into `knots`, from those after it.
fn without(knots: &[f64], p: usize, x: f64, row: &Row) -> Row {
    let above = knots.partition_point(|&u| u <= x);
    let copies = above - knots.partition_point(|&u| u < x);
    let last = above - 1;
    let begin = row.first.saturating_sub(1);
    let mut shares = vec![0.0; row.first - begin + row.shares.len()];
    for (k, share) in row.shares.iter().enumerate() {
        let i = row.first + k;
        if i + p <= last {
            shares[i - begin] += share;
        } else if i + copies <= last {
            let length = knots[i + p] - knots[i];
            shares[i - begin] += share * ((x - knots[i]) / length);
            shares[i - 1 - begin] += share * ((knots[i + p] - x) / length);
        } else {
            shares[i - 1 - begin] += share;
        }
    }
    let leading = shares.iter().take_while(|share| **share == 0.0).count();
    let trailing = shares.iter().rev().take_while(|share| **share == 0.0).count();
    let kept = leading..shares.len() - trailing;
    Row { first: begin + leading, shares: shares[kept].to_vec() }
}
