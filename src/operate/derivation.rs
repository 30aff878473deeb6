//! Derivatives as shapes.
//!
//! A polynomial spline has a derivative of one degree less. The derivative of a rational one is a quotient over the square of the
//! denominator, and so a rational spline of twice the degree. On a Bezier piece, from differences of poles only:
//!
//! ```text
//!   C' = sum_ij w_i w_j (P_i - P_j) B_i' B_j / w^2
//! ```
//!
//! It is written with full multiplicity at the knots. Where the derivative jumps there is no such shape.
//!
//! Limits: rational shapes of degree up to 15; their differences of Bezier poles are exact to the rounding of the poles, so that the error
//! is some ulps of the size of the shape over the shortest span.

use super::pieces::{Cut, breaks, patch, patch_net};
use super::reparametrisation::{rational, rational_surface};
use super::{Direction, Surface};
use crate::bezier::binomial;
use crate::bounds::{Vector, add, norm, scaled, sub};
use crate::curve::Curve;
use crate::curve::insertion::{Weighted, checked, room, spare, transposed};
use crate::error::Error;
use crate::knots::{Knots, MAX_DEGREE};

/// One-sided derivatives that differ by no more than this share of the greatest derivative are one: rounding.
const SAME_DERIVATIVE: f64 = 1e-12;

impl Curve {
    /// The curve `u -> C'(u)`. Polynomial: of one degree less, at least 1; rational: of twice the degree. Exact.
    ///
    /// # Errors
    /// A knot at which the derivative jumps; a rational curve of a degree above 15; memory that could not be had.
    pub fn derivative(&self) -> Result<Self, Error> {
        if self.is_rational() {
            return rational_curve(self);
        }
        let raised = self.elevate(usize::from(self.degree() == 1))?;
        let (knots, vectors) = lowered(raised.knots(), raised.poles(), "u")?;
        Self::new(knots.values(), knots.degree(), &vectors, None)
    }
}

impl Surface {
    /// The surface `(u, v) -> dS/du` or `dS/dv`. Polynomial: of one degree less in this direction, at least 1; rational: of twice the degree
    /// in both. Exact.
    ///
    /// # Errors
    /// A knot line at which the derivative jumps; a rational surface of a degree above 15; memory that could not be had.
    pub fn derivative(&self, direction: Direction) -> Result<Self, Error> {
        let name = ["u", "v"][direction.index()];
        if self.is_rational() {
            return rational_sheet(self, direction);
        }
        spare(self.poles().len(), 2 * size_of::<Weighted>() + size_of::<Vector>())?;
        let low = self.knots(direction).degree() == 1;
        let raised = self.elevate(direction, usize::from(low))?;
        let poles: Vec<Vector> =
            raised.strands(direction)?.iter().map(|point| point.pole).collect();
        let (knots, vectors) = lowered(raised.knots(direction), &poles, name)?;
        let [mut u, mut v] = [raised.knots_u().clone(), raised.knots_v().clone()];
        let mut net: Vec<Weighted> =
            vectors.iter().map(|&pole| Weighted { pole, weight: 1.0 }).collect();
        match direction {
            Direction::U => {
                net = transposed(&net, knots.pole_count())?;
                u = knots;
            }
            Direction::V => v = knots,
        }
        let poles: Vec<Vector> = net.iter().map(|point| point.pole).collect();
        let (m, n) = (u.pole_count(), v.pole_count());
        Self::new(u.values(), v.values(), u.degree(), v.degree(), &poles, m, n, None)
    }
}

fn jumps(name: &str, u: f64) -> Error {
    Error::Unsupported(format!("knots: the derivative jumps at {name} = {u}"))
}

/// The derivative of polynomial strands.
fn lowered(knots: &Knots, poles: &[Vector], name: &str) -> Result<(Knots, Vec<Vector>), Error> {
    // Without the poles that act nowhere, which degree - 1 may have no room for.
    let (p, active) = (knots.degree(), knots.active_poles());
    let (t, count) = (&knots.values()[active.start..active.end + p + 1], active.len());
    // Strands, all of them in one, and knots.
    spare(poles.len() + t.len(), 2 * size_of::<Vector>() + size_of::<f64>())?;
    let mut strands: Vec<Vec<Vector>> = Vec::new();
    for strand in poles.chunks_exact(knots.pole_count()) {
        let strand = &strand[active.clone()];
        let slope =
            |i: usize| scaled(sub(strand[i + 1], strand[i]), p as f64 / (t[i + p + 1] - t[i + 1]));
        strands.push((0..count - 1).map(slope).collect());
    }
    let longest = strands.iter().flatten().fold(0.0, |longest: f64, x| longest.max(norm(*x)));
    let mut values = t[1..t.len() - 1].to_vec();
    let torn: Vec<f64> = breaks(knots)?
        .into_iter()
        .filter(|&u| knots.contains(u) && u > t[p] && u < t[count] && knots.multiplicity(u) == p)
        .collect();
    for u in torn {
        let last = values.partition_point(|&x| x <= u) - 1;
        // Of the two poles at the knot the second goes.
        let right = last + 1 - p;
        for strand in &mut strands {
            if norm(sub(strand[right], strand[right - 1])) > SAME_DERIVATIVE * longest {
                return Err(jumps(name, u));
            }
            strand.remove(right);
        }
        values.remove(last);
    }
    Ok((checked(&values, p - 1)?, strands.concat()))
}

/// The cuts of a rational shape; its degrees are at most half of what is accepted.
fn cut(knots: &Knots) -> Result<Cut, Error> {
    if 2 * knots.degree() > MAX_DEGREE {
        let text = format!("degree: {} of a rational shape, at most 15", knots.degree());
        return Err(Error::Unsupported(text));
    }
    // Squares of the pieces.
    spare(knots.values().len(), 4 * (knots.degree() + 1) * size_of::<Option<Weighted>>())?;
    Cut::new(knots, breaks(knots)?)
}

/// The vector of twice the degree with full multiplicity at the cuts.
fn doubled(cut: &Cut) -> Result<Knots, Error> {
    let degree = 2 * cut.map.knots.degree();
    let mut values = vec![cut.breaks[0]];
    values.extend(cut.breaks.iter().flat_map(|&u| std::iter::repeat_n(u, degree)));
    values.extend(cut.breaks.last());
    checked(&values, degree)
}

/// The poles of a shape in Bezier form that is put together from its pieces.
struct Sheet {
    points: Vec<Option<Weighted>>,
    width: usize,
    /// The direction of the derivative, its degree, and at which cuts the derivative may jump.
    axis: usize,
    degree: usize,
    open: Vec<bool>,
    /// Where pieces disagree: how far, and the row and column.
    torn: (f64, [usize; 2]),
    longest: f64,
}

impl Sheet {
    fn new(
        [height, width]: [usize; 2],
        axis: usize,
        cut: &Cut,
        knots: &Knots,
    ) -> Result<Self, Error> {
        let count = height.checked_mul(width).ok_or(Error::OutOfMemory)?;
        let (mut points, degree) = (room(count)?, 2 * knots.degree());
        points.resize(count, None);
        let open = cut.breaks.iter().map(|&u| knots.breaks_at(u)).collect();
        Ok(Self { points, width, axis, degree, open, torn: (0.0, [0; 2]), longest: 0.0 })
    }

    fn place(&mut self, piece: &[Weighted], piece_width: usize, [row, column]: [usize; 2]) {
        for (k, point) in piece.iter().enumerate() {
            let at = [row + k / piece_width, column + k % piece_width];
            let there = &mut self.points[at[0] * self.width + at[1]];
            self.longest = self.longest.max(norm(point.pole));
            let apart = there.map_or(0.0, |there| norm(sub(there.pole, point.pole)));
            let is_open =
                at[self.axis].is_multiple_of(self.degree) && self.open[at[self.axis] / self.degree];
            if is_open && apart > self.torn.0 {
                self.torn = (apart, at);
            }
            there.get_or_insert(*point);
        }
    }

    /// The poles; or where the pieces do not fit.
    fn finish(self) -> Result<Vec<Weighted>, [usize; 2]> {
        if self.torn.0 > SAME_DERIVATIVE * self.longest {
            return Err(self.torn.1);
        }
        Ok(self.points.into_iter().flatten().collect())
    }
}

fn rational_curve(curve: &Curve) -> Result<Curve, Error> {
    let (cut, p) = (cut(curve.knots())?, curve.degree());
    let net = cut.map.apply(&curve.strand()?)?;
    let mut sheet = Sheet::new([2 * p * cut.count() + 1, 1], 0, &cut, curve.knots())?;
    for i in 0..cut.count() {
        let length = cut.breaks[i + 1] - cut.breaks[i];
        let piece = quotient(&net[i * p..=i * p + p], [p, 0], 0, length);
        sheet.place(&piece, 1, [2 * p * i, 0]);
    }
    let torn = |at: [usize; 2]| jumps("u", cut.breaks[at[0] / (2 * p)]);
    rational(doubled(&cut)?, &sheet.finish().map_err(torn)?)
}

fn rational_sheet(surface: &Surface, direction: Direction) -> Result<Surface, Error> {
    let [u, v] = [cut(surface.knots_u())?, cut(surface.knots_v())?];
    let (p, q) = (u.map.knots.degree(), v.map.knots.degree());
    let net = patch_net(surface, &u, &v)?;
    let (axis, sizes) = (direction.index(), [2 * p * u.count() + 1, 2 * q * v.count() + 1]);
    let mut sheet = Sheet::new(sizes, axis, [&u, &v][axis], surface.knots(direction))?;
    for (i, j) in (0..u.count()).flat_map(|i| (0..v.count()).map(move |j| (i, j))) {
        let (ends, k) = [(&u.breaks, i), (&v.breaks, j)][axis];
        let piece = quotient(&patch(&net, &u, &v, i, j), [p, q], axis, ends[k + 1] - ends[k]);
        sheet.place(&piece, 2 * q + 1, [2 * p * i, 2 * q * j]);
    }
    let torn = |at: [usize; 2]| match direction {
        Direction::U => jumps("u", u.breaks[at[0] / (2 * p)]),
        Direction::V => jumps("v", v.breaks[at[1] / (2 * q)]),
    };
    rational_surface(&doubled(&u)?, &doubled(&v)?, &sheet.finish().map_err(torn)?)
}

/// The derivative of a Bezier piece of bidegree [p, q] along `axis`, of twice the degrees; the domain has `length` along it.
fn quotient(net: &[Weighted], [p, q]: [usize; 2], axis: usize, length: f64) -> Vec<Weighted> {
    let (width, wide) = (q + 1, 2 * q + 1);
    let degree = [p, q][axis];
    let step = [width, 1][axis];
    let mut out = vec![([0.0; 3], 0.0); (2 * p + 1) * wide];
    let all = |i: usize, j: usize| binomial(p, i) * binomial(q, j);
    for (l, b) in net.iter().enumerate() {
        let (k, m) = (l / width, l % width);
        for (h, a) in net.iter().enumerate() {
            let (i, j) = (h / width, h % width);
            let share = all(i, j) * all(k, m) * a.weight * b.weight;
            out[(i + k) * wide + j + m].1 += share;
            if [i, j][axis] == degree {
                continue;
            }
            let next = &net[h + step];
            let vector: Vector = [0, 1, 2].map(|x| {
                next.weight * (next.pole[x] - b.pole[x]) - a.weight * (a.pole[x] - b.pole[x])
            });
            // One degree less along the axis, and raised again: what is at n goes to n and n + 1.
            let lower = if axis == 0 {
                binomial(p - 1, i) * binomial(q, j)
            } else {
                binomial(p, i) * binomial(q - 1, j)
            };
            let term = scaled(vector, degree as f64 / length * lower * all(k, m) * b.weight);
            let stride = [wide, 1][axis];
            let at = (i + k) * wide + j + m;
            out[at].0 = add(out[at].0, term);
            out[at + stride].0 = add(out[at + stride].0, term);
        }
    }
    let scale = |k: usize| binomial(2 * p, k / wide) * binomial(2 * q, k % wide);
    out.into_iter()
        .enumerate()
        .map(|(k, (vector, weight))| Weighted {
            pole: scaled(vector, 1.0 / weight),
            weight: weight / scale(k),
        })
        .collect()
}
