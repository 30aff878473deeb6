//! Stub of the agreed interface; the shapes branch has the real module.
#![allow(missing_docs, clippy::pedantic)]
use crate::error::Error;
use crate::knots::Knots;

#[derive(Clone, Debug)]
pub struct Curve {
    knots: Knots,
    poles: Vec<[f64; 3]>,
    weights: Option<Vec<f64>>,
}

impl Curve {
    pub fn new(
        knots: &[f64],
        degree: usize,
        poles: &[[f64; 3]],
        weights: Option<&[f64]>,
    ) -> Result<Self, Error> {
        let knots = Knots::new(knots, degree, poles.len())
            .map_err(|e| Error::InvalidArgument(format!("knots: {e:?}")))?;
        if let Some(i) = poles.iter().position(|p| p.iter().any(|x| !x.is_finite())) {
            return Err(Error::InvalidArgument(format!("poles: pole {i} is not finite")));
        }
        Ok(Self { knots, poles: poles.to_vec(), weights: weights.map(<[f64]>::to_vec) })
    }
    pub fn knots(&self) -> &Knots {
        &self.knots
    }
    pub fn poles(&self) -> &[[f64; 3]] {
        &self.poles
    }
    pub fn weights(&self) -> Option<&[f64]> {
        self.weights.as_deref()
    }
    pub fn degree(&self) -> usize {
        self.knots.degree()
    }
    pub fn domain(&self) -> (f64, f64) {
        self.knots.domain()
    }
    pub fn is_rational(&self) -> bool {
        self.weights.is_some()
    }
    pub fn is_closed(&self) -> bool {
        false
    }
    pub fn evaluate(&self, u: f64) -> [f64; 3] {
        [u, 0.0, 0.0]
    }
    pub fn derivatives(&self, u: f64, count: usize, out: &mut [[f64; 3]]) {
        out[..=count].fill([0.0; 3]);
        out[0] = self.evaluate(u);
    }
    pub fn bounding_box(&self) -> ([f64; 3], [f64; 3]) {
        ([0.0; 3], [1.0; 3])
    }
}
