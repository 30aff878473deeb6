//! Bezier pieces: the shape cut at all its knots.

use super::map::Map;
use super::{Direction, Surface};
use crate::curve::Curve;
use crate::curve::insertion::{Weighted, checked, room};
use crate::error::Error;
use crate::knots::Knots;

/// What the pieces of a knot vector are: the map to them, and the ends of each.
pub(super) struct Cut {
    pub map: Map,
    pub breaks: Vec<f64>,
}

/// The knots of the domain, each once, its ends included.
pub(super) fn breaks(knots: &Knots) -> Result<Vec<f64>, Error> {
    let (start, end) = knots.domain();
    let mut out = room(knots.values().len())?;
    out.extend(knots.values().iter().copied().filter(|&u| start <= u && u <= end));
    out.dedup();
    Ok(out)
}

impl Cut {
    /// Cut at `breaks`, which hold all knots of the domain.
    pub fn new(knots: &Knots, breaks: Vec<f64>) -> Result<Self, Error> {
        let p = knots.degree();
        let mut values = room(breaks.len().saturating_mul(p) + 2)?;
        values.push(breaks[0]);
        values.extend(breaks.iter().flat_map(|&u| std::iter::repeat_n(u, p)));
        values.extend(breaks.last());
        Ok(Self { map: Map::to(knots, &values)?, breaks })
    }

    pub fn count(&self) -> usize {
        self.breaks.len() - 1
    }

    /// The Bezier knots of piece `i`.
    fn knots(&self, i: usize) -> Result<Knots, Error> {
        let order = self.map.knots.degree() + 1;
        let ends = [self.breaks[i], self.breaks[i + 1]];
        let values: Vec<f64> = ends.iter().flat_map(|&u| std::iter::repeat_n(u, order)).collect();
        checked(&values, order - 1)
    }
}

impl Curve {
    /// The same curve with knots of full multiplicity: piece i has the poles `i * degree ..= i * degree + degree`. Exact.
    ///
    /// # Errors
    /// Memory that could not be had.
    pub fn bezier_form(&self) -> Result<Self, Error> {
        self.mapped(&Cut::new(self.knots(), breaks(self.knots())?)?.map)
    }

    /// The Bezier pieces, one a span of the domain in order, each with its parameters: clamped curves of the same degree
    /// with `degree + 1` poles. Exact.
    ///
    /// # Errors
    /// Memory that could not be had.
    pub fn bezier_pieces(&self) -> Result<Vec<Self>, Error> {
        let cut = Cut::new(self.knots(), breaks(self.knots())?)?;
        let (p, net) = (self.degree(), cut.map.apply(&self.strand()?)?);
        let piece = |i: usize| self.like(cut.knots(i)?, &net[i * p..=i * p + p]);
        (0..cut.count()).map(piece).collect()
    }
}

impl Surface {
    /// The same surface with knots of full multiplicity in both directions, as [`Curve::bezier_form`]. Exact.
    ///
    /// # Errors
    /// Memory that could not be had.
    pub fn bezier_form(&self) -> Result<Self, Error> {
        let mut form = self.clone();
        for direction in [Direction::U, Direction::V] {
            let knots = form.knots(direction);
            form = form.mapped(direction, &Cut::new(knots, breaks(knots)?)?.map)?;
        }
        Ok(form)
    }

    /// The Bezier patches with their parameters, piece (i, j) at `i * count_v + j`, and the numbers of pieces in both
    /// directions. Exact.
    ///
    /// # Errors
    /// Memory that could not be had.
    pub fn bezier_pieces(&self) -> Result<(Vec<Self>, [usize; 2]), Error> {
        let cut = |knots: &Knots| Cut::new(knots, breaks(knots)?);
        let (cut_u, cut_v) = (cut(self.knots_u())?, cut(self.knots_v())?);
        let net = patch_net(self, &cut_u, &cut_v)?;
        let mut out = Vec::new();
        for (i, j) in (0..cut_u.count()).flat_map(|i| (0..cut_v.count()).map(move |j| (i, j))) {
            let patch = patch(&net, &cut_u, &cut_v, i, j);
            out.push(self.like(cut_u.knots(i)?, cut_v.knots(j)?, &patch)?);
        }
        Ok((out, [cut_u.count(), cut_v.count()]))
    }
}

/// The net over both cuts, v running fastest.
pub(super) fn patch_net(surface: &Surface, u: &Cut, v: &Cut) -> Result<Vec<Weighted>, Error> {
    let half = surface.mapped(Direction::U, &u.map)?;
    v.map.apply(&half.strands(Direction::V)?)
}

/// The poles of patch (i, j), v running fastest.
pub(super) fn patch(net: &[Weighted], u: &Cut, v: &Cut, i: usize, j: usize) -> Vec<Weighted> {
    let ((p, q), width) = ((u.map.knots.degree(), v.map.knots.degree()), v.map.knots.pole_count());
    (i * p..=i * p + p)
        .flat_map(|row| &net[row * width + j * q..=row * width + j * q + q])
        .copied()
        .collect()
}
