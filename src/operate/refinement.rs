//! Finer knots, parts and clamped ends: other poles over other knots, the same spline.
//!
//! ```text
//!   refine   u0 .. a   b   c .. u1   ->   u0 .. a x b b c .. u1
//!   part                                          b b b c d d d         knots of full multiplicity at both ends
//!   clamp    -2 -1 0   1   2   3 4   ->        0 0 0 1 2 2 2            the part that is the whole domain
//! ```

use super::map::Map;
use super::{Direction, Surface};
use crate::curve::Curve;
use crate::curve::insertion::{copy_of, room, spare};
use crate::error::Error;
use crate::knots::Knots;

impl Curve {
    /// The same curve with more knots, in any order, each as often as it stands in `values`. The ends of the domain may be
    /// repeated `degree + 1` times, other knots `degree` times. Exact. Cost: O(n p^2), whatever the number of new knots.
    ///
    /// # Errors
    /// A knot outside the domain or repeated too often, by index; memory that could not be had.
    pub fn refine(&self, values: &[f64]) -> Result<Self, Error> {
        self.mapped(&refinement(self.knots(), "values", values)?)
    }

    /// The part of the curve over `[start, end]`, clamped, with its parameters. Exact.
    ///
    /// # Errors
    /// `start < end` does not hold or leaves the domain; memory that could not be had.
    pub fn part(&self, start: f64, end: f64) -> Result<Self, Error> {
        self.mapped(&part(self.knots(), "", start, end)?)
    }

    /// The same curve with clamped ends: its first and last poles are its end points. Exact.
    ///
    /// # Errors
    /// Memory that could not be had.
    pub fn clamp(&self) -> Result<Self, Error> {
        let (start, end) = self.domain();
        self.part(start, end)
    }
}

impl Surface {
    /// The same surface with more knots in a direction, as [`Curve::refine`]. Exact.
    ///
    /// # Errors
    /// As for curves.
    pub fn refine(&self, direction: Direction, values: &[f64]) -> Result<Self, Error> {
        self.mapped(direction, &refinement(self.knots(direction), "values", values)?)
    }

    /// The part of the surface over `[u0, u1] x [v0, v1]`, clamped, with its parameters. Exact.
    ///
    /// # Errors
    /// An interval that is empty or leaves the domain; memory that could not be had.
    pub fn part(&self, [u0, u1, v0, v1]: [f64; 4]) -> Result<Self, Error> {
        self.part_along(Direction::U, u0, u1)?.part_along(Direction::V, v0, v1)
    }

    /// The part of the surface between two isocurves, clamped in this direction, with its parameters. Exact.
    ///
    /// # Errors
    /// `start < end` does not hold or leaves the domain; memory that could not be had.
    pub fn part_along(&self, direction: Direction, start: f64, end: f64) -> Result<Self, Error> {
        let map = part(self.knots(direction), direction.suffix(), start, end)?;
        self.mapped(direction, &map)
    }

    /// The same surface with clamped ends in both directions: its borders are rows and columns of poles. Exact.
    ///
    /// # Errors
    /// Memory that could not be had.
    pub fn clamp(&self) -> Result<Self, Error> {
        self.part(self.domain())
    }
}

/// The map to a vector with `added` knots more; `name` is the list's name in an error.
pub(super) fn refinement(knots: &Knots, name: &str, added: &[f64]) -> Result<Map, Error> {
    if let Some(i) = added.iter().position(|&u| !knots.contains(u)) {
        let text = format!("{name}: {name}[{i}] = {} is outside the domain", added[i]);
        return Err(Error::InvalidArgument(text));
    }
    let mut sorted: Vec<f64> = copy_of(added)?;
    sorted.sort_by(f64::total_cmp);
    let (degree, (start, end)) = (knots.degree(), knots.domain());
    for &u in &sorted {
        let most = if u == start || u == end { degree + 1 } else { degree };
        let copies = sorted.partition_point(|&x| x <= u) - sorted.partition_point(|&x| x < u);
        if knots.multiplicity(u) + copies > most {
            let text = format!("{name}: more than {most} equal knots at {u}");
            return Err(Error::InvalidArgument(text));
        }
    }
    Map::to(knots, &merged(knots.values(), &sorted)?)
}

/// Two ordered lists in one.
pub(super) fn merged(a: &[f64], b: &[f64]) -> Result<Vec<f64>, Error> {
    let mut all = room(a.len() + b.len())?;
    all.extend_from_slice(a);
    all.extend_from_slice(b);
    // A stable sort has a list of its own.
    spare(all.len(), size_of::<f64>())?;
    // -0 and 0 are one knot; a stable sort by value keeps the order of a.
    all.sort_by(|x, y| x.partial_cmp(y).unwrap_or(std::cmp::Ordering::Equal));
    Ok(all)
}

/// The map to the clamped vector over a part of the domain; the parameters are named start and end.
pub(super) fn part(knots: &Knots, suffix: &str, start: f64, end: f64) -> Result<Map, Error> {
    for (name, value) in [("start", start), ("end", end)] {
        if !knots.contains(value) {
            let text = format!("{name}{suffix}: {value} is outside the domain");
            return Err(Error::InvalidArgument(text));
        }
    }
    if start >= end {
        let text = format!("end{suffix}: {end} is not beyond start{suffix} = {start}");
        return Err(Error::InvalidArgument(text));
    }
    let inside = knots.values().iter().copied().filter(|&u| start < u && u < end);
    let order = knots.degree() + 1;
    let mut values = room(knots.values().len() + 2 * order)?;
    values.extend(std::iter::repeat_n(start, order));
    values.extend(inside);
    values.extend(std::iter::repeat_n(end, order));
    Map::to(knots, &values)
}
