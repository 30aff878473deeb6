//! The function behind a shape: derivatives that it does not give, and what samples say about the shape.
//!
//! Finite differences use the neighbours at a fixed share of the domain, one-sided where a neighbour would leave it:
//!
//! ```text
//!   f' inside   (f(x+h) - f(x-h)) / 2h                at an end  (-3 f(x) + 4 f(x+h) - f(x+2h)) / 2h
//!   f'' inside  (f(x+h) - 2 f(x) + f(x-h)) / h^2      at an end  (2 f(x) - 5 f(x+h) + 4 f(x+2h) - f(x+3h)) / h^2
//! ```
//!
//! A curve is a surface here whose second parameter has no width. Limit: three orders, 0 to 2.

use super::SurfaceBounds;
use crate::bounds::{Aabb, Vector, add, norm, scaled, sub};
use crate::closest::GREATEST_COORDINATE;
use crate::curve::CLOSED_TOLERANCE;
use crate::error::Error;
use crate::surface::COLLAPSED_TOLERANCE;

/// Ulps of the largest coordinate to which a function's points must be accurate.
pub const POINT_ULPS: f64 = 64.0;

/// Step of differences of first order, as a share of the domain: near the cube root of an ulp.
pub const STEP_FIRST: f64 = 1.0 / 131_072.0;

/// Step of second differences of points, as a share of the domain: near the fourth root of an ulp.
pub const STEP_SECOND: f64 = 1.0 / 8_192.0;

/// Samples of a curve.
pub const CURVE_SAMPLES: usize = 129;

/// Samples of a surface in either direction.
pub const SURFACE_SAMPLES: usize = 25;

/// Vectors in an evaluation of total order 0, 1, 2.
pub const VALUES: [usize; 3] = [1, 3, 6];

/// What estimated bounds are multiplied with, because samples miss the extremes.
const ESTIMATE_MARGIN: f64 = 2.0;

/// The function with both parameters and the layout S; Su, Sv; Suu, Suv, Svv.
pub type Function = dyn Fn([f64; 2], usize, &mut [Vector; 6]) -> Option<usize> + Send + Sync;

/// A function and its domain.
pub struct Source {
    function: Box<Function>,
    /// Parameters: 1 or 2.
    pub dims: usize,
    /// u0, u1, v0, v1; curves: v0 = v1 = 0.
    pub domain: [f64; 4],
}

/// Values at one place.
#[derive(Clone, Copy, Debug)]
pub struct Sample {
    /// S; Su, Sv; Suu, Suv, Svv up to the order asked for.
    pub values: [Vector; 6],
    /// Orders that came from the function; the others are differences.
    pub delivered: usize,
    /// Calls of the function.
    pub calls: u32,
}

/// Weights of the neighbours, by their distance in steps.
type Stencil = &'static [(f64, f64)];

const HERE: Stencil = &[(0.0, 1.0)];
const FIRST: [Stencil; 3] = [
    &[(-1.0, -0.5), (1.0, 0.5)],
    &[(0.0, -1.5), (1.0, 2.0), (2.0, -0.5)],
    &[(0.0, 1.5), (-1.0, -2.0), (-2.0, 0.5)],
];
const SECOND: [Stencil; 3] = [
    &[(-1.0, 1.0), (0.0, -2.0), (1.0, 1.0)],
    &[(0.0, 2.0), (1.0, -5.0), (2.0, 4.0), (3.0, -1.0)],
    &[(0.0, 2.0), (-1.0, -5.0), (-2.0, 4.0), (-3.0, -1.0)],
];

impl std::fmt::Debug for Source {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Source").field("dims", &self.dims).field("domain", &self.domain).finish()
    }
}

impl Source {
    /// A function of `dims` parameters on a domain.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] naming the entry of the domain.
    pub fn new(dims: usize, domain: [f64; 4], function: Box<Function>) -> Result<Self, Error> {
        let refuse = |text: String| Err(Error::InvalidArgument(text));
        for (i, x) in domain[..2 * dims].iter().enumerate() {
            if !x.is_finite() || x.abs() > GREATEST_COORDINATE {
                return refuse(format!("domain: entry {i} = {x} is not finite or too large"));
            }
        }
        for k in 0..dims {
            let width = domain[2 * k + 1] - domain[2 * k];
            let grain = f64::EPSILON * domain[2 * k].abs().max(domain[2 * k + 1].abs());
            // Differences need neighbours that differ.
            if width.is_nan() || width <= 0.0 || width * STEP_FIRST < 16.0 * grain {
                let text = format!(
                    "domain: {} to {} is empty, or too narrow for its doubles",
                    domain[2 * k],
                    domain[2 * k + 1]
                );
                return refuse(text);
            }
        }
        Ok(Self { function, dims, domain })
    }

    /// Width of the domain in parameter k.
    pub fn width(&self, k: usize) -> f64 {
        self.domain[2 * k + 1] - self.domain[2 * k]
    }

    /// The function's own values, if they are finite.
    fn call(&self, at: [f64; 2], order: usize) -> Option<([Vector; 6], usize)> {
        // What a function forgets to write is a failure too.
        let mut values = [[f64::NAN; 3]; 6];
        let delivered = (self.function)(at, order, &mut values)?.min(order);
        let (good, rest) = values.split_at_mut(VALUES[delivered]);
        rest.fill([0.0; 3]);
        let is_fine = |x: &f64| x.abs() <= GREATEST_COORDINATE;
        good.iter().flatten().all(is_fine).then_some((values, delivered))
    }

    /// Values up to `order` (at most 2), with differences for what the function does not give.
    pub fn sample(&self, at: [f64; 2], order: usize) -> Option<Sample> {
        self.sample_by(at, order, [STEP_FIRST; 2])
    }

    /// The same with given steps, as shares of the domain, for first derivatives.
    pub fn sample_by(&self, at: [f64; 2], order: usize, steps: [f64; 2]) -> Option<Sample> {
        let (values, delivered) = self.call(at, order)?;
        let mut sample = Sample { values, delivered, calls: 1 };
        if delivered == 0 && order > 0 {
            for k in 0..self.dims {
                sample.values[1 + k] = self.difference(at, [k], 0, steps[k], &mut sample.calls)?;
            }
        }
        if delivered < 2 && order == 2 {
            for (place, pair) in [(3, [0, 0]), (4, [0, 1]), (5, [1, 1])] {
                if pair[1] < self.dims {
                    sample.values[place] = self.second(at, pair, delivered, &mut sample.calls)?;
                }
            }
        }
        Some(sample)
    }

    /// A second derivative: differences of a first derivative, or of points.
    fn second(
        &self,
        at: [f64; 2],
        pair: [usize; 2],
        delivered: usize,
        calls: &mut u32,
    ) -> Option<Vector> {
        if delivered == 1 {
            self.difference(at, [pair[1]], 1 + pair[0], STEP_FIRST, calls)
        } else {
            self.difference(at, pair, 0, STEP_SECOND, calls)
        }
    }

    /// Difference of value number `place` in each of `directions`; the same direction twice is a second difference.
    fn difference<const N: usize>(
        &self,
        at: [f64; 2],
        directions: [usize; N],
        place: usize,
        step: f64,
        calls: &mut u32,
    ) -> Option<Vector> {
        let (mut stencils, mut steps, mut divisor) = ([HERE; 2], [0.0; 2], 1.0);
        for k in directions {
            let (h, side) = self.step(at[k], k, step);
            stencils[k] = if steps[k] == 0.0 { FIRST[side] } else { SECOND[side] };
            steps[k] = h;
            divisor *= h;
        }
        let mut sum = [0.0; 3];
        for (i, a) in stencils[0] {
            for (j, b) in stencils[1] {
                let near =
                    [self.inside(at[0] + i * steps[0], 0), self.inside(at[1] + j * steps[1], 1)];
                let (values, delivered) = self.call(near, usize::from(place > 0))?;
                *calls += 1;
                if place >= VALUES[delivered] {
                    return None;
                }
                sum = add(sum, scaled(values[place], a * b));
            }
        }
        let result = scaled(sum, 1.0 / divisor);
        result.iter().all(|x| x.abs() <= GREATEST_COORDINATE).then_some(result)
    }

    fn inside(&self, x: f64, k: usize) -> f64 {
        x.clamp(self.domain[2 * k], self.domain[2 * k + 1])
    }

    /// Step length, exact in the doubles around `x`, and which of the three stencils fits: both sides, forward, backward.
    fn step(&self, x: f64, k: usize, share: f64) -> (f64, usize) {
        let wanted = share * self.width(k);
        let side = if x - wanted < self.domain[2 * k] {
            1
        } else if x + wanted > self.domain[2 * k + 1] {
            2
        } else {
            0
        };
        let h = if side == 2 { x - (x - wanted) } else { (x + wanted) - x };
        (h, side)
    }
}

/// What samples say about a shape.
#[derive(Debug)]
pub struct Survey {
    /// Box of the samples.
    pub aabb: Aabb,
    /// Its diagonal.
    pub diagonal: f64,
    /// Largest coordinate.
    pub magnitude: f64,
    /// Directions whose edges agree.
    pub closed: [bool; 2],
    /// Edges u0, u1, v0, v1 that are a point.
    pub collapsed: [bool; 4],
    /// Bounds that the samples suggest; nothing is proven with them.
    pub estimate: SurfaceBounds,
    /// Parameters and points, row by row in u; failed samples are left out.
    pub seeds: Vec<([f64; 2], Vector)>,
}

impl Survey {
    /// Bytes of the samples.
    pub fn memory(&self) -> usize {
        self.seeds.capacity() * size_of::<([f64; 2], Vector)>()
    }
}

/// A function, what it is known to obey, and what samples say.
#[derive(Debug)]
pub struct Shape {
    /// The function.
    pub source: Source,
    /// What the caller vouches for.
    pub bounds: SurfaceBounds,
    /// What samples say.
    pub survey: Survey,
}

impl Shape {
    /// Checks the bounds and takes the samples.
    pub fn new(source: Source, bounds: SurfaceBounds) -> Result<Self, Error> {
        check_bounds("speed bound", bounds.speed.as_ref().map(|b| &b[..]))?;
        check_bounds("second bound", bounds.second.as_ref().map(|b| &b[..]))?;
        let survey = survey(&source, bounds.second.is_none())?;
        Ok(Self { source, bounds, survey })
    }

    /// Whether a restriction lies in the domain.
    pub fn check_restriction(&self, range: [f64; 4]) -> Result<(), Error> {
        let refuse = |text: String| Err(Error::InvalidArgument(text));
        for k in 0..self.source.dims {
            let [low, high] = [self.source.domain[2 * k], self.source.domain[2 * k + 1]];
            for i in 2 * k..2 * k + 2 {
                if !(low..=high).contains(&range[i]) {
                    let x = range[i];
                    return refuse(format!("domain: entry {i} = {x} is outside [{low}, {high}]"));
                }
            }
            if range[2 * k] >= range[2 * k + 1] {
                let text = format!("domain: entry {} is not less than entry {}", 2 * k, 2 * k + 1);
                return refuse(text);
            }
        }
        Ok(())
    }

    /// The box of parameters that a query is about.
    pub fn range(&self, asked: Option<[f64; 4]>) -> [f64; 4] {
        let all = self.source.domain;
        let Some(asked) = asked else { return all };
        let mut range = all;
        for k in 0..self.source.dims {
            range[2 * k] = asked[2 * k].clamp(all[2 * k], all[2 * k + 1]);
            range[2 * k + 1] = asked[2 * k + 1].clamp(range[2 * k], all[2 * k + 1]);
        }
        range
    }

    /// Rounding of a point of the shape, as far as the function is trusted.
    pub fn rounding(&self, point: Vector) -> f64 {
        let largest = point.iter().fold(self.survey.magnitude, |m, x| m.max(x.abs()));
        POINT_ULPS * f64::EPSILON * largest
    }

    /// Asked-for gap between distance and bound.
    pub fn accuracy(&self, asked: f64) -> f64 {
        if asked > 0.0 { asked } else { 1e-10 * self.survey.diagonal }
    }

    /// What counts as on the shape.
    pub fn tolerance(&self, asked: f64) -> f64 {
        if asked > 0.0 { asked } else { 1e-7 * self.survey.diagonal }
    }
}

fn check_bounds(name: &str, bounds: Option<&[f64]>) -> Result<(), Error> {
    let wrong = |x: &&f64| !(0.0..=GREATEST_COORDINATE).contains(*x);
    match bounds.and_then(|bounds| bounds.iter().find(wrong)) {
        Some(x) => {
            Err(Error::InvalidArgument(format!("{name}: {x} is not a finite number of at least 0")))
        }
        None => Ok(()),
    }
}

/// Takes the samples; `estimates`: with second derivatives.
fn survey(source: &Source, estimates: bool) -> Result<Survey, Error> {
    let [rows, columns] =
        if source.dims == 1 { [CURVE_SAMPLES, 1] } else { [SURFACE_SAMPLES, SURFACE_SAMPLES] };
    let mut samples = Vec::with_capacity(rows * columns);
    for i in 0..rows {
        for j in 0..columns {
            let at = [place(source, 0, i, rows), place(source, 1, j, columns)];
            let sample = source.sample(at, if estimates { 2 } else { 0 });
            samples.push((at, sample.or_else(|| source.sample(at, 0))));
        }
    }
    let mut aabb = Aabb::EMPTY;
    let seeds: Vec<_> =
        samples.iter().filter_map(|(at, sample)| Some((*at, sample.as_ref()?.values[0]))).collect();
    seeds.iter().for_each(|(_, point)| aabb.include(*point));
    if seeds.is_empty() {
        let text = "evaluate: no sample in the domain gave a finite point".to_string();
        return Err(Error::InvalidArgument(text));
    }
    let (diagonal, magnitude) = (aabb.diagonal(), largest(&aabb));
    let point = |i: usize, j: usize| samples[i * columns + j].1.as_ref().map(|s| s.values[0]);
    let rounding = 2.0 * POINT_ULPS * f64::EPSILON * magnitude;
    let equal = |a: Option<Vector>, b: Option<Vector>, share: f64| {
        a.zip(b).is_some_and(|(a, b)| norm(sub(a, b)) <= share * diagonal + rounding)
    };
    let same = |a, b| equal(a, b, CLOSED_TOLERANCE);
    let mut closed = [(0..columns).all(|j| same(point(0, j), point(rows - 1, j))), false];
    let mut collapsed = [false; 4];
    if source.dims == 2 {
        closed[1] = (0..rows).all(|i| same(point(i, 0), point(i, columns - 1)));
        let one = |a, b| equal(a, b, COLLAPSED_TOLERANCE);
        for (edge, i) in [(0, 0), (1, rows - 1)] {
            collapsed[edge] = (0..columns).all(|j| one(point(i, 0), point(i, j)));
            collapsed[2 + edge] = (0..rows).all(|k| one(point(0, i), point(k, i)));
        }
    }
    let estimate = if estimates { estimated(&samples) } else { SurfaceBounds::default() };
    Ok(Survey { aabb, diagonal, magnitude, closed, collapsed, estimate, seeds })
}

fn place(source: &Source, k: usize, i: usize, count: usize) -> f64 {
    if count == 1 || i == 0 {
        return source.domain[2 * k];
    }
    if i == count - 1 {
        return source.domain[2 * k + 1];
    }
    source.inside(source.domain[2 * k] + source.width(k) * (i as f64 / (count - 1) as f64), k)
}

fn largest(aabb: &Aabb) -> f64 {
    aabb.low.iter().chain(&aabb.high).fold(0.0, |m, x| m.max(x.abs()))
}

fn estimated(samples: &[([f64; 2], Option<Sample>)]) -> SurfaceBounds {
    let greatest = |place: usize| {
        let sizes = samples.iter().filter_map(|(_, s)| Some(norm(s.as_ref()?.values[place])));
        ESTIMATE_MARGIN * sizes.fold(0.0, f64::max)
    };
    let second = [3, 4, 5].map(greatest);
    SurfaceBounds { speed: None, second: Some(second) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// (u^3, u^2 v, sin-free v^3 - u v) with as many orders as `orders` says.
    fn cubic(orders: usize) -> Source {
        let function = move |[u, v]: [f64; 2], order: usize, out: &mut [Vector; 6]| {
            out[0] = [u * u * u, u * u * v, v * v * v - u * v];
            if order >= 1 && orders >= 1 {
                out[1] = [3.0 * u * u, 2.0 * u * v, -v];
                out[2] = [0.0, u * u, 3.0 * v * v - u];
            }
            if order >= 2 && orders >= 2 {
                out[3] = [6.0 * u, 2.0 * v, 0.0];
                out[4] = [0.0, 2.0 * u, -1.0];
                out[5] = [0.0, 0.0, 6.0 * v];
            }
            Some(orders)
        };
        Source::new(2, [-1.0, 2.0, 0.0, 3.0], Box::new(function)).unwrap()
    }

    #[test]
    fn differences_agree_with_derivatives_inside_and_at_the_ends() {
        let exact = cubic(2);
        for orders in [0, 1] {
            for at in [[0.3, 0.7], [-1.0, 0.0], [2.0, 3.0], [-1.0, 3.0], [1.2, 0.0]] {
                let found = cubic(orders).sample(at, 2).unwrap();
                let truth = exact.sample(at, 2).unwrap();
                assert_eq!((found.delivered, truth.calls), (orders, 1));
                for k in 0..6 {
                    let gap = norm(sub(found.values[k], truth.values[k]));
                    let limit = if k < 3 { 2e-8 } else { 2e-5 };
                    assert!(gap < limit, "{orders} orders, value {k} at {at:?}: {gap}");
                }
            }
        }
    }

    #[test]
    fn values_that_are_not_finite_are_failures() {
        let function = |[u, _]: [f64; 2], _: usize, out: &mut [Vector; 6]| {
            out[0] = [1.0 / u, 0.0, 0.0];
            Some(0)
        };
        let source = Source::new(1, [0.0, 1.0, 0.0, 0.0], Box::new(function)).unwrap();
        assert!(source.sample([0.0, 0.0], 0).is_none());
        assert!(source.sample([0.5, 0.0], 1).is_some());
    }

    #[test]
    fn domains_that_are_none_are_refused() {
        for domain in
            [[0.0, 0.0], [1.0, 0.0], [f64::NAN, 1.0], [0.0, f64::INFINITY], [1e9, 1e9 + 1e-7]]
        {
            let [a, b] = domain;
            let made = Source::new(1, [a, b, 0.0, 0.0], Box::new(|_, _, _| Some(0)));
            assert!(made.is_err(), "{domain:?}");
        }
    }
}
