//! Knot insertion and splitting: more poles, the same shape.
//!
//! A strand is the pole list of a curve, or one row of the poles of a surface; the strands of a surface
//! stand one after the other. Inserting `u` behind the last knot `u_k <= u`, which is repeated `s`
//! times, replaces `p - s - 1` poles by `p - s` means of neighbours:
//!
//! ```text
//!   Q_i = (1 - a_i) P_{i-1} + a_i P_i,   a_i = (u - u_i) / (u_{i+p} - u_i),   k-p < i <= k-s
//! ```
//!
//! in homogeneous coordinates. Poles are mixed as pole + share * (other - pole), so that the error
//! scales with their distance.
//!
//! Reference: Piegl, Tiller, *The NURBS Book*, 2nd ed., section 5.2, equation (5.15).

use super::Curve;
use crate::error::Error;
use crate::knots::Knots;

/// A pole, not multiplied by its weight.
#[derive(Clone, Copy)]
pub(crate) struct Weighted {
    pub pole: [f64; 3],
    pub weight: f64,
}

/// The knots and strands of a refined shape or of a piece of it.
pub(crate) type Strands = (Knots, Vec<Weighted>);

/// A net as `Curve` and `Surface` keep it: poles and, if there are any, weights.
pub(crate) type Net = (Box<[[f64; 3]]>, Option<Box<[f64]>>);

impl Curve {
    /// The same curve with `u` as a knot `times` more times. The ends of the domain may be inserted
    /// too, up to `degree + 1` of them; other knots up to `degree`.
    ///
    /// # Errors
    /// `u` is outside the domain, or repeated too often; memory that could not be had.
    pub fn insert_knot(&self, u: f64, times: usize) -> Result<Self, Error> {
        let (knots, points) = insert(&self.knots, "u", u, times, self.strand()?)?;
        self.like(knots, &points)
    }

    /// The parts of the curve before and behind `u`, each on its part of the domain.
    ///
    /// # Errors
    /// `u` is not inside the domain; memory that could not be had.
    pub fn split(&self, u: f64) -> Result<(Self, Self), Error> {
        let [(left, before), (right, behind)] = split(&self.knots, "u", u, self.strand()?)?;
        Ok((self.like(left, &before)?, self.like(right, &behind)?))
    }

    /// Poles and weights in one list.
    pub(crate) fn strand(&self) -> Result<Vec<Weighted>, Error> {
        weighted(&self.poles, self.weights.as_deref())
    }

    /// A curve with other knots and poles; weights only if this one has them.
    pub(crate) fn like(&self, knots: Knots, points: &[Weighted]) -> Result<Self, Error> {
        let (poles, weights) = unweighted(points, self.weights.as_deref(), self.rational)?;
        Ok(Self::from_parts(knots, poles, weights))
    }
}

/// Poles and weights in one list; missing weights are 1.
pub(crate) fn weighted(
    poles: &[[f64; 3]],
    weights: Option<&[f64]>,
) -> Result<Vec<Weighted>, Error> {
    let weight = |i: usize| weights.map_or(1.0, |weights| weights[i]);
    let pairs = poles.iter().enumerate();
    collect(poles.len(), pairs.map(|(i, &pole)| Weighted { pole, weight: weight(i) }))
}

/// The reverse of [`weighted`]. Equal weights stay the same equal weights.
pub(crate) fn unweighted(
    points: &[Weighted],
    weights: Option<&[f64]>,
    rational: bool,
) -> Result<Net, Error> {
    let poles = collect(points.len(), points.iter().map(|point| point.pole))?;
    let weight = |point: &Weighted, given: &[f64]| if rational { point.weight } else { given[0] };
    let weights = weights
        .map(|given| collect(points.len(), points.iter().map(|point| weight(point, given))))
        .transpose()?;
    Ok((poles.into(), weights.map(Vec::into)))
}

/// Inserts `u` into every strand `times` times. `name` is the parameter's name in an error.
pub(crate) fn insert(
    knots: &Knots,
    name: &str,
    u: f64,
    times: usize,
    strands: Vec<Weighted>,
) -> Result<Strands, Error> {
    if !knots.contains(u) {
        return Err(Error::InvalidArgument(format!("{name}: {u} is outside the domain")));
    }
    let (degree, (start, end)) = (knots.degree(), knots.domain());
    let most = if u == start || u == end { degree + 1 } else { degree };
    if knots.multiplicity(u).checked_add(times).is_none_or(|total| total > most) {
        let text = format!("times: more than {most} equal knots at {name} = {u}");
        return Err(Error::InvalidArgument(text));
    }
    let (mut values, mut strands) = (knots.values().to_vec(), strands);
    for _ in 0..times {
        let last = values.partition_point(|&knot| knot <= u) - 1;
        strands = insert_once(&values, degree, u, last, &strands)?;
        values.insert(last + 1, u);
    }
    Ok((checked(&values, degree)?, strands))
}

/// One more `u` behind the knot with index `last`, in every strand.
fn insert_once(
    knots: &[f64],
    degree: usize,
    u: f64,
    last: usize,
    strands: &[Weighted],
) -> Result<Vec<Weighted>, Error> {
    let pole_count = knots.len() - degree - 1;
    let repeats = knots[..=last].iter().rev().take_while(|&&knot| knot == u).count();
    let mut out = room(strands.len() / pole_count * (pole_count + 1))?;
    for strand in strands.chunks_exact(pole_count) {
        out.extend_from_slice(&strand[..=last - degree]);
        for i in last - degree + 1..=last - repeats {
            let length = knots[i + degree] - knots[i];
            let shares = [(knots[i + degree] - u) / length, (u - knots[i]) / length];
            out.push(mix(&strand[i - 1], &strand[i], shares));
        }
        out.extend_from_slice(&strand[last - repeats..]);
    }
    Ok(out)
}

/// The mean of two poles in homogeneous coordinates, from the one with more influence.
pub(crate) fn mix(a: &Weighted, b: &Weighted, shares: [f64; 2]) -> Weighted {
    let (part_a, part_b) = (shares[0] * a.weight, shares[1] * b.weight);
    let weight = part_a + part_b;
    let (near, far, share) =
        if part_a >= part_b { (a, b, part_b / weight) } else { (b, a, part_a / weight) };
    let pole = std::array::from_fn(|x| near.pole[x] + share * (far.pole[x] - near.pole[x]));
    Weighted { pole, weight }
}

/// Cuts every strand at `u`. `name` is the parameter's name in an error.
pub(crate) fn split(
    knots: &Knots,
    name: &str,
    u: f64,
    strands: Vec<Weighted>,
) -> Result<[Strands; 2], Error> {
    let (degree, (start, end)) = (knots.degree(), knots.domain());
    if !(start < u && u < end) {
        return Err(Error::InvalidArgument(format!("{name}: {u} is not inside the domain")));
    }
    let missing = degree - knots.multiplicity(u);
    let (knots, strands) = insert(knots, name, u, missing, strands)?;
    let (values, last) = (knots.values(), knots.span(u));
    let left = [&values[..=last], &[u]].concat();
    let right = [&[u], &values[last - degree + 1..]].concat();
    let (count, shared) = (knots.pole_count(), last - degree);
    Ok([
        (checked(&left, degree)?, columns(&strands, count, 0..shared + 1)?),
        (checked(&right, degree)?, columns(&strands, count, shared..count)?),
    ])
}

/// The same range of every strand.
fn columns(
    strands: &[Weighted],
    pole_count: usize,
    range: std::ops::Range<usize>,
) -> Result<Vec<Weighted>, Error> {
    let mut out = room(strands.len() / pole_count * range.len())?;
    for strand in strands.chunks_exact(pole_count) {
        out.extend_from_slice(&strand[range.clone()]);
    }
    Ok(out)
}

/// Swaps rows and columns of a grid with `width` entries in a row.
pub(crate) fn transposed(grid: &[Weighted], width: usize) -> Result<Vec<Weighted>, Error> {
    let height = grid.len() / width;
    let entries = (0..grid.len()).map(|i| grid[i % height * width + i / height]);
    collect(grid.len(), entries)
}

/// The knot vector of a degree, as long as it says.
pub(crate) fn checked(values: &[f64], degree: usize) -> Result<Knots, Error> {
    Knots::new(values, degree, values.len() - degree - 1).map_err(|error| error.named(""))
}

pub(crate) fn room<T>(count: usize) -> Result<Vec<T>, Error> {
    let mut list = Vec::new();
    list.try_reserve_exact(count).map_err(|_| Error::OutOfMemory)?;
    Ok(list)
}

/// Appends to a list that may have to grow.
pub(crate) fn append<T>(list: &mut Vec<T>, x: T) -> Result<(), Error> {
    list.try_reserve(1).map_err(|_| Error::OutOfMemory)?;
    list.push(x);
    Ok(())
}

/// Appends many.
pub(crate) fn append_all<T: Copy>(list: &mut Vec<T>, more: &[T]) -> Result<(), Error> {
    list.try_reserve(more.len()).map_err(|_| Error::OutOfMemory)?;
    list.extend_from_slice(more);
    Ok(())
}

/// A list of one value.
pub(crate) fn filled<T: Copy>(count: usize, value: T) -> Result<Vec<T>, Error> {
    let mut list = room(count)?;
    list.resize(count, value);
    Ok(list)
}

/// Refuses what memory does not hold: `count` times `bytes` are reserved and given back. For work that then allocates piece by piece.
pub(crate) fn spare(count: usize, bytes: usize) -> Result<(), Error> {
    room::<u8>(count.checked_mul(bytes).ok_or(Error::OutOfMemory)?).map(drop)
}

/// A copy of a list.
pub(crate) fn copy_of<T: Copy>(list: &[T]) -> Result<Vec<T>, Error> {
    collect(list.len(), list.iter().copied())
}

/// A list of the first `count` entries.
pub(crate) fn collect<T>(count: usize, entries: impl Iterator<Item = T>) -> Result<Vec<T>, Error> {
    let mut list = room(count)?;
    list.extend(entries);
    Ok(list)
}
