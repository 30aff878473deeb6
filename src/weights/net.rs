//! The net of a curve or a surface without regard to its weights, and shapes over it with other weights.

use super::COINCIDENT;
use crate::basis;
use crate::bounds::{Vector, norm, sub};
use crate::closest::{FootPoint, QueryOptions, Workspace};
use crate::curve::{Curve, box_of};
use crate::error::Error;
use crate::index::{IndexedCurve, IndexedSurface};
use crate::knots::Knots;
use crate::surface::Surface;

/// Whose weights are looked for.
#[derive(Clone, Copy, Debug)]
pub enum Net<'a> {
    /// Those of a curve.
    Curve(&'a Curve),
    /// Those of a surface.
    Surface(&'a Surface),
}

/// A shape over the net with weights of its own, ready for queries.
#[derive(Debug)]
pub enum Fitted {
    Curve(IndexedCurve),
    Surface(IndexedSurface),
}

/// A pole and the value of its basis function somewhere.
pub type Share = (usize, f64);

impl<'a> Net<'a> {
    /// The poles; of a surface v runs fastest.
    pub fn poles(&self) -> &'a [Vector] {
        match self {
            Self::Curve(curve) => curve.poles(),
            Self::Surface(surface) => surface.poles(),
        }
    }

    /// The weights as they were given.
    pub fn weights(&self) -> Option<&'a [f64]> {
        match self {
            Self::Curve(curve) => curve.weights(),
            Self::Surface(surface) => surface.weights(),
        }
    }

    /// Knot vectors of u and, on a surface, v.
    pub fn knots(&self) -> [Option<&'a Knots>; 2] {
        match self {
            Self::Curve(curve) => [Some(curve.knots()), None],
            Self::Surface(surface) => [Some(surface.knots_u()), Some(surface.knots_v())],
        }
    }

    /// Poles along v, 1 for a curve: pole (i, j) is number `i * width + j`.
    pub fn width(&self) -> usize {
        self.knots()[1].map_or(1, Knots::pole_count)
    }

    /// A pole's number as errors write it.
    pub fn name(&self, pole: usize) -> String {
        match self {
            Self::Curve(_) => pole.to_string(),
            Self::Surface(_) => format!("({}, {})", pole / self.width(), pole % self.width()),
        }
    }

    /// Diagonal of the box of all poles: what tolerances are relative to.
    pub fn diagonal(&self) -> f64 {
        let (low, high) = box_of(self.poles());
        norm(sub(high, low))
    }

    /// The parameter pair as it is used: inside the domain, or refused.
    pub fn contains(&self, at: [f64; 2]) -> bool {
        self.knots().iter().zip(at).all(|(knots, x)| knots.is_none_or(|knots| knots.contains(x)))
    }

    /// The neighbours of a pole in the net.
    fn neighbours(&self, pole: usize) -> impl Iterator<Item = usize> {
        let (width, count) = (self.width(), self.poles().len());
        let (i, j) = (pole / width, pole % width);
        let steps = [
            (i > 0).then(|| pole - width),
            (pole + width < count).then_some(pole + width),
            (j > 0).then(|| pole - 1),
            (j + 1 < width).then_some(pole + 1),
        ];
        steps.into_iter().flatten()
    }

    /// A neighbour in the same place.
    pub fn coincident(&self, pole: usize) -> Option<usize> {
        let (poles, limit) = (self.poles(), COINCIDENT * self.diagonal());
        self.neighbours(pole).find(|&other| norm(sub(poles[pole], poles[other])) <= limit)
    }

    /// The pole that stands for all poles opposite to this one, in each direction.
    pub fn representative(&self, pole: usize) -> usize {
        let (width, rows) = (self.width(), self.poles().len() / self.width());
        let (i, j) = (pole / width, pole % width);
        i.min(rows - 1 - i) * width + j.min(width - 1 - j)
    }

    /// The shape with these weights.
    pub fn with(&self, weights: &[f64]) -> Result<Fitted, Error> {
        Ok(match self {
            Self::Curve(_) => Fitted::Curve(IndexedCurve::for_few(self.curve_with(weights)?)),
            Self::Surface(_) => {
                Fitted::Surface(IndexedSurface::for_few(self.surface_with(weights)?))
            }
        })
    }

    /// The curve with these weights; a surface is no curve.
    pub fn curve_with(&self, weights: &[f64]) -> Result<Curve, Error> {
        match self {
            Self::Curve(curve) => {
                Curve::new(curve.knots().values(), curve.degree(), curve.poles(), Some(weights))
            }
            Self::Surface(_) => Err(Error::Unsupported("report: is that of a surface".into())),
        }
    }

    /// The surface with these weights; a curve is no surface.
    pub fn surface_with(&self, weights: &[f64]) -> Result<Surface, Error> {
        let Self::Surface(surface) = self else {
            return Err(Error::Unsupported("report: is that of a curve".into()));
        };
        let (u, v) = (surface.knots_u(), surface.knots_v());
        Surface::new(
            u.values(),
            v.values(),
            u.degree(),
            v.degree(),
            surface.poles(),
            u.pole_count(),
            v.pole_count(),
            Some(weights),
        )
    }

    /// The poles whose basis functions do not vanish on the span of a place, with the functions' values.
    pub fn shares(&self, at: [f64; 2], out: &mut Vec<Share>) {
        out.clear();
        match self.knots() {
            [Some(u), Some(v)] => {
                let ((first_u, in_u), (first_v, in_v)) = (values(u, at[0]), values(v, at[1]));
                for (i, a) in in_u.iter().enumerate() {
                    let row = (first_u + i) * self.width() + first_v;
                    out.extend(in_v.iter().enumerate().map(|(j, b)| (row + j, a * b)));
                }
            }
            [u, _] => {
                let Some(u) = u else { return };
                let (first, values) = values(u, at[0]);
                out.extend(values.into_iter().enumerate().map(|(i, n)| (first + i, n)));
            }
        }
    }
}

/// The first pole of the span of `u`, and the basis functions there.
fn values(knots: &Knots, u: f64) -> (usize, Vec<f64>) {
    let span = knots.span(u);
    let mut values = vec![0.0; knots.degree() + 1];
    basis::values(knots, span, u, &mut values);
    (span - knots.degree(), values)
}

impl Fitted {
    /// The nearest point; `accuracy` as in [`QueryOptions`].
    pub fn closest(&self, query: Vector, accuracy: f64, workspace: &mut Workspace) -> FootPoint {
        let options = QueryOptions { accuracy, ..QueryOptions::default() };
        match self {
            Self::Curve(curve) => curve.closest(query, None, &options, workspace, None),
            Self::Surface(surface) => surface.closest(query, None, &options, workspace, None),
        }
    }

    pub fn point(&self, at: [f64; 2]) -> Vector {
        match self {
            Self::Curve(curve) => curve.curve().evaluate(at[0]),
            Self::Surface(surface) => surface.surface().evaluate(at[0], at[1]),
        }
    }

    /// The first derivatives at a place: one, or two on a surface.
    pub fn tangents(&self, at: [f64; 2]) -> Vec<Vector> {
        let mut out = [[0.0; 3]; 3];
        match self {
            Self::Curve(curve) => {
                curve.curve().derivatives(at[0], 1, &mut out[..2]);
                vec![out[1]]
            }
            Self::Surface(surface) => {
                surface.surface().partials(at[0], at[1], 1, &mut out);
                vec![out[1], out[2]]
            }
        }
    }
}
