//! The index of a curve: its Bezier segments.

use super::piece::{
    Frame, LocalNet, MAX_TENSOR_BYTES, Span, balance_for, parts_for, position_steps,
    power_of_two_over, push_tensors, reserved, tensor_len,
};
use super::reach::{Chain, CurveReach};
use super::segment::Segment;
use crate::analytic::Analytic;
use crate::bezier::{Bidegree, extraction};
use crate::bounds::{Aabb, HALF_ULP, Vector, add, extent, sub};
use crate::coefficients::Grid;
use crate::curve::Curve;
use crate::error::Error;
use crate::jet::{BezierSegment, Lane, lanes, pole_distance};
use crate::knots::Knots;
use crate::simd::Level;
use crate::tree::Tree;

/// Search structure of a curve.
#[derive(Debug)]
pub struct CurveIndex {
    /// Map from the caller's coordinates.
    pub frame: Frame,
    /// The segments in order.
    pub segments: Vec<Segment>,
    /// Boxes of the segments.
    pub tree: Tree,
    /// Whether the curve is closed.
    pub closed: bool,
    /// The line or circle that the curve is, if it is one.
    pub analytic: Option<Box<Analytic>>,
    /// How far vectors across the curve may be followed; none for elementary shapes.
    pub reach: Option<CurveReach>,
    degree: usize,
    rational: bool,
    nets: Vec<f64>,
    lanes: Vec<Lane>,
    tensors: Vec<f64>,
    /// The coefficient arrays of its segments.
    pub grid: Grid,
}

impl CurveIndex {
    /// Builds the index; `poll` is asked now and then whether to stop.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`], [`Error::Cancelled`].
    pub fn new(curve: &Curve, level: Level, poll: &mut dyn FnMut() -> bool) -> Result<Self, Error> {
        let (p, rational) = (curve.degree(), curve.is_rational());
        let knots = curve.knots();
        let spans = pieces(knots, parts_for(if rational { weight_ratio(curve) } else { 1.0 }));
        let width = (p + 1) * if rational { 4 } else { 3 };
        let degree = Bidegree { s: 0, t: p };
        let tensor_width = tensor_len(degree, rational);
        let keep_tensors = spans.len() * tensor_width * 8 <= MAX_TENSOR_BYTES;
        let mut index = Self {
            frame: Frame::new(curve.poles(), curve.bounding_box()),
            segments: reserved(spans.len())?,
            tree: Tree::new(&[], 0, 0, level),
            closed: curve.is_closed(),
            analytic: None,
            reach: None,
            degree: p,
            rational,
            nets: reserved(spans.len() * width)?,
            lanes: reserved(spans.len() * (p + 1))?,
            grid: Grid::new(degree, rational, level),
            tensors: reserved(if keep_tensors { spans.len() * tensor_width } else { 0 })?,
        };
        let mut boxes = reserved(spans.len())?;
        for (k, &span) in spans.iter().enumerate() {
            if k % 1024 == 1023 && poll() {
                return Err(Error::Cancelled);
            }
            boxes.push(index.push_segment(curve, span));
            let net = &index.nets[k * width..];
            index.lanes.extend(lanes(net, rational));
            if keep_tensors {
                push_tensors(net, degree, rational, &mut index.tensors);
            }
        }
        index.tree = Tree::new(&boxes, boxes.len(), 1, level);
        Ok(index)
    }

    /// Makes [`Self::reach`], once.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`], [`Error::Cancelled`].
    pub fn measure_reach(&mut self, poll: &mut dyn FnMut() -> bool) -> Result<(), Error> {
        if self.analytic.is_none() {
            let net = |k: usize| self.net(k);
            let (degree, rational) = (self.degree, self.rational);
            let chain = Chain { segments: &self.segments, degree, rational, net: &net };
            self.reach = Some(CurveReach::new(&chain, poll)?);
        }
        Ok(())
    }

    fn push_segment(&mut self, curve: &Curve, (span, ends): (usize, [f64; 2])) -> Aabb {
        let (p, knots) = (self.degree, curve.knots());
        // Equal weights are no weights: the curve says so, and then they must not scale the poles.
        let weights = curve.weights().filter(|_| self.rational);
        let weight = |i: usize| weights.map_or(1.0, |w| w[i]);
        let local: Vec<_> =
            (span - p..=span).map(|i| (self.frame.enter(curve.poles()[i]), weight(i))).collect();
        let net = LocalNet::new(&local);
        let mut matrix = vec![0.0; (p + 1) * (p + 1)];
        extraction(knots, span, ends, &mut matrix);
        let mut aabb = Aabb::EMPTY;
        let start = self.nets.len();
        let components = if self.rational { 4 } else { 3 };
        for component in &net.components[..components] {
            for row in matrix.chunks_exact(p + 1) {
                self.nets.push(row.iter().zip(component).map(|(m, x)| m * x).sum());
            }
        }
        let balance = self.balance(start);
        let poles = &self.nets[start..];
        for i in 0..=p {
            let w = if self.rational { poles[3 * (p + 1) + i] } else { 1.0 };
            let at = |c: usize| poles[c * (p + 1) + i] / w;
            aabb.include(add(net.center, [at(0), at(1), at(2)]));
        }
        let (first, last) = knots.domain();
        let border = ends.map(|u| u == first || u == last || knots.breaks_at(u));
        let u = Span { ends, balance };
        self.segments.push(Segment { u, center: net.center, radius: net.radius, border });
        aabb.grown(position_steps(p) * net.radius + 8.0 * HALF_ULP)
    }

    /// Balances the weights of the net that starts at `start`; returns the factor.
    fn balance(&mut self, start: usize) -> f64 {
        let p = self.degree;
        if !self.rational {
            return 1.0;
        }
        let w = &self.nets[start + 3 * (p + 1)..];
        let balance = balance_for(w[p] / w[0], p);
        if balance != 1.0 {
            let grown = |i: usize| balance.powi(i as i32);
            let largest = (0..=p).fold(0.0, |m: f64, i| m.max(w[i] * grown(i)));
            let factor = power_of_two_over(largest);
            for component in self.nets[start..].chunks_exact_mut(p + 1) {
                (0..=p).for_each(|i| component[i] *= grown(i) * factor);
            }
        }
        balance
    }

    /// Degree of the segments.
    pub fn degree(&self) -> usize {
        self.degree
    }

    /// Whether weights are there.
    pub fn is_rational(&self) -> bool {
        self.rational
    }

    /// Segment `k`'s poles.
    pub fn net(&self, k: usize) -> BezierSegment<'_> {
        let width = (self.degree + 1) * if self.rational { 4 } else { 3 };
        let poles = &self.nets[k * width..(k + 1) * width];
        let lanes = &self.lanes[k * (self.degree + 1)..(k + 1) * (self.degree + 1)];
        let (degree, rational, level) = (self.degree, self.rational, self.grid.level);
        BezierSegment { degree, rational, poles, lanes, level }
    }

    /// Segment `k`'s tensors A, -2 B, C, when they are kept.
    pub fn tensors(&self, k: usize) -> Option<&[f64]> {
        let width = tensor_len(Bidegree { s: 0, t: self.degree }, self.rational);
        self.tensors.get(k * width..(k + 1) * width)
    }

    /// Distance from `query` to the nearer end of segment `k`, in the index's coordinates and but for rounding.
    pub fn end_distance(&self, k: usize, query: Vector) -> f64 {
        let (lanes, q) = (self.net(k).lanes, sub(query, self.segments[k].center));
        pole_distance(&lanes[0], q).min(pole_distance(&lanes[lanes.len() - 1], q))
    }

    /// Bytes held.
    pub fn memory(&self) -> usize {
        size_of::<Self>()
            + (self.nets.capacity() + self.tensors.capacity() + 4 * self.lanes.capacity()) * 8
            + self.segments.capacity() * size_of::<Segment>()
            + self.tree.memory()
            + self.grid.memory()
            + self.analytic.as_ref().map_or(0, |analytic| analytic.memory())
            + self.reach.as_ref().map_or(0, CurveReach::memory)
    }
}

/// The spans of a knot vector, each cut into `parts`, with their ends.
pub fn pieces(knots: &Knots, parts: usize) -> Vec<(usize, [f64; 2])> {
    let mut list = Vec::new();
    for span in knots.spans() {
        let (a, b) = (knots.values()[span], knots.values()[span + 1]);
        let cut = |k: usize| match k {
            0 => a,
            k if k == parts => b,
            k => a + (b - a) * (k as f64 / parts as f64),
        };
        // Spans of a few ulps cannot be cut: their parts would be empty.
        let list_of = |n: usize| (0..n).map(|k| (span, [cut(k), cut(k + 1)]));
        if list_of(parts).all(|(_, [a, b])| a < b) {
            list.extend(list_of(parts));
        } else {
            list.push((span, [a, b]));
        }
    }
    list
}

/// Greatest ratio of two weights that shape one span.
fn weight_ratio(curve: &Curve) -> f64 {
    let weights = curve.weights().unwrap_or(&[]);
    let ratio = |w: &[f64]| {
        let (low, high) = extent(w);
        high / low
    };
    weights.windows(curve.degree() + 1).map(ratio).fold(1.0, f64::max)
}
