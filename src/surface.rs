//! Stub of the agreed interface; the shapes branch has the real module.
#![allow(missing_docs, clippy::pedantic)]
use crate::error::Error;
use crate::knots::Knots;

#[derive(Clone, Debug)]
pub struct Surface {
    knots_u: Knots,
    knots_v: Knots,
    poles: Vec<[f64; 3]>,
    weights: Option<Vec<f64>>,
}

impl Surface {
    pub fn new(
        knots_u: &[f64],
        knots_v: &[f64],
        degree_u: usize,
        degree_v: usize,
        poles: &[[f64; 3]],
        pole_count_u: usize,
        pole_count_v: usize,
        weights: Option<&[f64]>,
    ) -> Result<Self, Error> {
        let refused = |e| Error::InvalidArgument(format!("knots: {e:?}"));
        let knots_u = Knots::new(knots_u, degree_u, pole_count_u).map_err(refused)?;
        let knots_v = Knots::new(knots_v, degree_v, pole_count_v).map_err(refused)?;
        if let Some(i) = poles.iter().position(|p| p.iter().any(|x| !x.is_finite())) {
            return Err(Error::InvalidArgument(format!("poles: pole {i} is not finite")));
        }
        let weights = weights.map(<[f64]>::to_vec);
        Ok(Self { knots_u, knots_v, poles: poles.to_vec(), weights })
    }
    pub fn knots_u(&self) -> &Knots {
        &self.knots_u
    }
    pub fn knots_v(&self) -> &Knots {
        &self.knots_v
    }
    pub fn poles(&self) -> &[[f64; 3]] {
        &self.poles
    }
    pub fn weights(&self) -> Option<&[f64]> {
        self.weights.as_deref()
    }
    pub fn domain(&self) -> [f64; 4] {
        let ((a, b), (c, d)) = (self.knots_u.domain(), self.knots_v.domain());
        [a, b, c, d]
    }
    pub fn is_rational(&self) -> bool {
        self.weights.is_some()
    }
    pub fn is_closed_u(&self) -> bool {
        false
    }
    pub fn is_closed_v(&self) -> bool {
        false
    }
    pub fn collapsed_edges(&self) -> [bool; 4] {
        [false; 4]
    }
    pub fn evaluate(&self, u: f64, v: f64) -> [f64; 3] {
        [u, v, 0.0]
    }
    pub fn partials(&self, u: f64, v: f64, count: usize, out: &mut [[f64; 3]]) {
        out[..(count + 1) * (count + 2) / 2].fill([0.0; 3]);
        out[0] = self.evaluate(u, v);
    }
    pub fn bounding_box(&self) -> ([f64; 3], [f64; 3]) {
        ([0.0; 3], [1.0; 3])
    }
}
