//! What is known about a box of parameters from one evaluation at its centre and the bounds.
//!
//! The inequalities are those of the head of `callback`. Rounding is allowed for as follows, with `e` the accuracy of
//! a point ([`Shape::rounding`]) and `t` that of a first derivative:
//!
//! ```text
//!   distance of the centre   e + 8 ulps of |r|
//!   first derivative, given  64 ulps of itself and of the largest coordinate over the width of the domain
//!   by differences           2 M s + 4 (e + grain) / s for the step s, which is chosen near the best, sqrt(2 (e + grain) / M);
//!                            the grain is what an ulp of the parameter moves the point
//!   slope r.S_u              |r| t + e |S_u| + 8 ulps of |r| |S_u|
//! ```
//!
//! Limit: half widths are below the square root of the largest double, as domains are.

use std::cell::Cell as Counter;

use super::SurfaceBounds;
use super::source::{POINT_ULPS, STEP_FIRST, Sample, Shape, Source};
use crate::bounds::{Vector, add, dot, norm, scaled, sub};
use crate::jet::{Jet1, Jet2};
use crate::refine::{CurveJets, SurfaceJets};

const ULP: f64 = f64::EPSILON;

/// A coordinate that no iteration takes for a nearer point.
const NOWHERE: f64 = 1e120;

/// Boxes on which the function fails are halved down to this share of the domain.
const LEAST_FAILED: f64 = 1.0 / 32.0;

/// A shape as one query sees it; counts calls and remembers failures.
pub struct Probe<'a> {
    /// The shape.
    pub shape: &'a Shape,
    /// The query.
    pub query: Vector,
    /// The bounds in use.
    pub bounds: SurfaceBounds,
    /// Whether the caller vouches for them.
    pub trusted: bool,
    /// Steps of differences that bounds are made of, as shares of the domain.
    steps: [f64; 2],
    taken: Counter<u32>,
    failed: Counter<bool>,
}

impl<'a> Probe<'a> {
    /// For a query that can use any bounds.
    pub fn new(shape: &'a Shape, query: Vector) -> Self {
        let given = shape.bounds;
        let trusted = given.speed.is_some() || given.second.is_some();
        let bounds = if trusted { given } else { shape.survey.estimate };
        let (taken, failed) = (Counter::new(0), Counter::new(false));
        let steps = [0, 1].map(|k| step(shape, k, bounds.second));
        Self { shape, query, bounds, trusted, steps, taken, failed }
    }

    /// For a query that needs bounds of second derivatives.
    pub fn curved(shape: &'a Shape, query: Vector) -> Self {
        let given = shape.bounds;
        let second = given.second.or(shape.survey.estimate.second);
        let bounds = SurfaceBounds { speed: given.speed, second };
        let probe = Self::new(shape, query);
        let steps = [0, 1].map(|k| step(shape, k, second));
        Self { bounds, trusted: given.second.is_some(), steps, ..probe }
    }

    /// Evaluations so far.
    pub fn taken(&self) -> u32 {
        self.taken.get()
    }

    /// Whether an evaluation has failed.
    pub fn has_failed(&self) -> bool {
        self.failed.get()
    }

    /// Values at a place; a failure is remembered. The second number tells how many orders are the function's own.
    pub fn values(&self, at: [f64; 2], order: usize) -> Option<([Vector; 6], usize)> {
        self.counted(self.shape.source.sample(at, order))
    }

    /// As [`Self::values`] up to order 1, with differences whose errors are small and known.
    fn tangents(&self, at: [f64; 2], order: usize) -> Option<([Vector; 6], usize)> {
        self.counted(self.shape.source.sample_by(at, order, self.steps))
    }

    fn counted(&self, sample: Option<Sample>) -> Option<([Vector; 6], usize)> {
        self.taken.set(self.taken.get().saturating_add(sample.as_ref().map_or(1, |s| s.calls)));
        if sample.is_none() {
            self.failed.set(true);
        }
        sample.map(|s| (s.values, s.delivered))
    }

    /// Halves of a box on which the function fails, as long as it is not small.
    pub fn coarse_halves(&self, range: [f64; 4]) -> Option<[[f64; 4]; 2]> {
        let share = [0, 1].map(|k| {
            let width = self.shape.source.width(k);
            if width > 0.0 { (range[2 * k + 1] - range[2 * k]) / width } else { 0.0 }
        });
        let k = usize::from(share[1] > share[0]);
        if share[k] > LEAST_FAILED { halves(range, k) } else { None }
    }

    /// Point and distance at a place.
    pub fn reach(&self, at: [f64; 2]) -> Option<(Vector, f64)> {
        let (values, _) = self.values(at, 0)?;
        Some((values[0], norm(sub(self.query, values[0]))))
    }

    /// The jet at a place, with differences where needed.
    pub fn jet_at(&self, at: [f64; 2]) -> Option<Jet2> {
        let ([point, s, t, ss, st, tt], _) = self.values(at, 2)?;
        Some(Jet2 { d: sub(point, self.query), s, t, ss, st, tt, w: [1.0, 0.0, 0.0] })
    }

    /// Error of a first derivative at a place.
    fn tangent_error(&self, k: usize, tangent: Vector, point: f64, delivered: usize) -> f64 {
        let source = &self.shape.source;
        let width = source.width(k);
        if delivered > 0 {
            return POINT_ULPS * ULP * norm(tangent) + point / width;
        }
        let step = self.steps[k] * width;
        let second = self.bounds.second.map_or(f64::INFINITY, |m| m[2 * k]);
        // The step itself is rounded to the doubles of the parameter.
        2.0 * second * step * 1.01 + 4.0 * (point + grain(source, k) * norm(tangent)) / step * 1.01
    }
}

/// Distance between doubles of parameter k.
fn grain(source: &Source, k: usize) -> f64 {
    ULP * source.domain[2 * k].abs().max(source.domain[2 * k + 1].abs())
}

/// The step of differences, as a share of the domain, that makes the bound of their error least.
fn step(shape: &Shape, k: usize, second: Option<[f64; 3]>) -> f64 {
    let (source, width) = (&shape.source, shape.source.width(k));
    let Some(bound) = second.map(|m| m[2 * k]).filter(|&m| m > 0.0 && width > 0.0) else {
        return STEP_FIRST;
    };
    let moved = grain(source, k) * shape.survey.diagonal / width;
    let best = (2.0 * (shape.rounding([0.0; 3]) + moved) / bound).sqrt() / width;
    best.clamp((256.0 * grain(source, k) / width).min(STEP_FIRST), STEP_FIRST)
}

impl CurveJets for Probe<'_> {
    fn jet(&self, s: f64) -> Jet1 {
        SurfaceJets::jet(self, s, 0.0).along(0)
    }

    fn global(&self, s: f64) -> [f64; 2] {
        [s, 0.0]
    }
}

impl SurfaceJets for Probe<'_> {
    fn jet(&self, s: f64, t: f64) -> Jet2 {
        // Where the function fails, the iteration sees a far place with a steep slope and turns back.
        let away = [NOWHERE, 0.0, 0.0];
        self.jet_at([s, t]).unwrap_or(Jet2 {
            d: away,
            s: away,
            t: away,
            w: [1.0, 0.0, 0.0],
            ..Jet2::default()
        })
    }

    fn global(&self, s: f64, t: f64) -> [f64; 2] {
        [s, t]
    }
}

/// A box of parameters, seen from its centre.
#[derive(Clone, Copy, Debug)]
pub struct View {
    /// The centre.
    pub centre: [f64; 2],
    /// Half widths, rounded up; 0 where the box has no width.
    pub half: [f64; 2],
    /// Vector from the query to the point of the centre, its length and the error of both.
    pub r: Vector,
    /// See `r`.
    pub distance: f64,
    /// See `r`.
    pub error: f64,
    /// First derivatives at the centre and their errors; zero without bounds of second derivatives.
    pub tangents: [Vector; 2],
    tangent_errors: [f64; 2],
    /// Bounds of the first derivatives on the box.
    pub speeds: [f64; 2],
    slowest: [f64; 2],
    /// Bounds of how far the first derivatives on the box are from those given at the centre.
    changes: [f64; 2],
    remainder: f64,
    second: Option<[f64; 3]>,
    lipschitz: Option<[f64; 2]>,
}

/// Centre and half width of an interval.
fn middle(low: f64, high: f64) -> (f64, f64) {
    let centre = (0.5 * low + 0.5 * high).clamp(low, high);
    (centre, (centre - low).max(high - centre) * (1.0 + 2.0 * ULP))
}

impl View {
    /// Evaluates at the centre of `range`; `None` where the function fails.
    pub fn new(probe: &Probe, range: [f64; 4]) -> Option<Self> {
        let ((u, hu), (v, hv)) = (middle(range[0], range[1]), middle(range[2], range[3]));
        let (centre, half) = ([u, v], [hu, hv]);
        let second = probe.bounds.second;
        let (values, delivered) = probe.tangents(centre, usize::from(second.is_some()))?;
        let r = sub(values[0], probe.query);
        let distance = norm(r);
        let point_error = probe.shape.rounding(values[0]);
        let mut view = Self {
            centre,
            half,
            r,
            distance,
            error: point_error + 8.0 * ULP * distance,
            tangents: [[0.0; 3]; 2],
            tangent_errors: [0.0; 2],
            speeds: probe.bounds.speed.unwrap_or([f64::INFINITY; 2]),
            slowest: [0.0; 2],
            changes: [f64::INFINITY; 2],
            remainder: f64::INFINITY,
            second,
            lipschitz: probe.bounds.speed,
        };
        if let Some(second) = second {
            view.tangents = [values[1], values[2]];
            for k in 0..probe.shape.source.dims {
                view.tangent_errors[k] =
                    probe.tangent_error(k, values[1 + k], point_error, delivered);
            }
            view.spread(second);
        }
        Some(view)
    }

    /// Remainder and speeds from the bounds of the second derivatives.
    fn spread(&mut self, [uu, uv, vv]: [f64; 3]) {
        let [h, k] = self.half;
        let remainder = 0.5 * (uu * h * h + 2.0 * uv * h * k + vv * k * k);
        let drift = self.tangent_errors[0] * h + self.tangent_errors[1] * k;
        self.remainder = (remainder + drift) * (1.0 + 8.0 * ULP);
        let change = [uu * h + uv * k, uv * h + vv * k];
        for i in 0..2 {
            let (size, vary) = (norm(self.tangents[i]), change[i] + self.tangent_errors[i]);
            let slack = 8.0 * ULP * (size + vary);
            self.changes[i] = vary + slack;
            self.speeds[i] = self.speeds[i].min(size + vary + slack);
            self.slowest[i] = (size - vary - slack).max(0.0);
        }
    }

    /// The shape on the box is no nearer to the query than this.
    pub fn lower(&self) -> f64 {
        let mut bound = 0.0f64;
        if let Some([u, v]) = self.lipschitz {
            let spread = (u * self.half[0] + v * self.half[1]) * (1.0 + 4.0 * ULP);
            bound = bound.max(self.distance - spread - self.error);
        }
        if self.second.is_some() && self.remainder < self.distance {
            bound = bound.max(self.beyond_plane());
        }
        bound
    }

    /// Least distance to the tangent parallelogram along the direction of its nearest point, less the remainder.
    fn beyond_plane(&self) -> f64 {
        let nearest = self.nearest_on_parallelogram();
        let size = norm(nearest);
        if size <= 0.0 {
            return 0.0;
        }
        let n = scaled(nearest, 1.0 / size);
        let shadow = [0, 1].map(|k| dot(n, self.tangents[k]).abs() * self.half[k]);
        let spread = [0, 1].map(|k| norm(self.tangents[k]) * self.half[k]);
        let rounding = 8.0 * ULP * (self.distance + spread[0] + spread[1]);
        dot(n, self.r) - shadow[0] - shadow[1] - self.remainder - self.error - rounding
    }

    /// The nearest point to the query of `r + a S_u + b S_v`, as a vector from the query; rounding makes it less sharp.
    fn nearest_on_parallelogram(&self) -> Vector {
        let ([s, t], [h, k]) = (self.tangents, self.half);
        let place = |a: f64, b: f64| add(self.r, add(scaled(s, a), scaled(t, b)));
        let (e, f, g) = (dot(s, s), dot(s, t), dot(t, t));
        let (x, y) = (dot(self.r, s), dot(self.r, t));
        let area = e * g - f * f;
        if area > 1e-12 * e * g {
            let (a, b) = ((f * y - g * x) / area, (f * x - e * y) / area);
            if a.abs() <= h && b.abs() <= k {
                return place(a, b);
            }
        }
        let slide = |top: f64, size: f64, half: f64| {
            if size > 0.0 { (-top / size).clamp(-half, half) } else { 0.0 }
        };
        let mut best = (f64::INFINITY, self.r);
        for sign in [-1.0, 1.0] {
            let (a, b) = (sign * h, sign * k);
            for p in [place(a, slide(y + f * a, g, k)), place(slide(x + f * b, e, h), b)] {
                if dot(p, p) < best.0 {
                    best = (dot(p, p), p);
                }
            }
        }
        best.1
    }

    /// No point of the shape on the box is farther from the query than this.
    pub fn upper(&self) -> f64 {
        let mut spread = f64::INFINITY;
        if self.second.is_some() {
            let along = [0, 1].map(|k| norm(self.tangents[k]) * self.half[k]);
            spread = (along[0] + along[1]) * (1.0 + 8.0 * ULP) + self.remainder;
        }
        if let Some([u, v]) = self.lipschitz {
            spread = spread.min((u * self.half[0] + v * self.half[1]) * (1.0 + 4.0 * ULP));
        }
        self.distance + self.error + spread
    }

    /// Bounds on the box of |f_uu|, |f_uv|, |f_vv| without their sign: how fast the slopes may vary.
    fn curvatures(&self, [uu, uv, vv]: [f64; 3]) -> [f64; 3] {
        let reach = self.upper();
        let [a, b] = self.speeds;
        [a * a + reach * uu, self.mixed() + reach * uv, b * b + reach * vv]
    }

    /// Bound of |S_u . S_v| on the box.
    fn mixed(&self) -> f64 {
        let [s, t] = self.tangents;
        let vary = self.changes;
        let moved = norm(s) * vary[1] + norm(t) * vary[0] + vary[0] * vary[1];
        (dot(s, t).abs() + moved + 8.0 * ULP * norm(s) * norm(t))
            .min(self.speeds[0] * self.speeds[1])
    }

    /// The slope f_u or f_v at the centre and by how much it may differ on the box.
    pub fn slope(&self, k: usize) -> Option<(f64, f64)> {
        let [uu, uv, vv] = self.curvatures(self.second?);
        let [h, l] = self.half;
        let vary = if k == 0 { uu * h + uv * l } else { uv * h + vv * l };
        Some((dot(self.r, self.tangents[k]), (vary + self.slope_error(k)) * (1.0 + 8.0 * ULP)))
    }

    /// Error of the slope at the centre.
    pub fn slope_error(&self, k: usize) -> f64 {
        let size = norm(self.tangents[k]);
        self.distance * (self.tangent_errors[k] + 8.0 * ULP * size) + self.error * size
    }

    /// Least curvature of f on the box when f is proven convex there, over the parameters that have width.
    pub fn convexity(&self) -> Option<f64> {
        let [uu, uv, vv] = self.second?;
        let reach = self.upper();
        let least = |k: usize, m: f64| {
            let square = self.slowest[k] * self.slowest[k];
            square - reach * m - 8.0 * ULP * (square + reach * m)
        };
        let (a, c) = (least(0, uu), least(1, vv));
        let curvature = match self.half.map(|h| h > 0.0) {
            [true, true] => {
                let b = (self.mixed() + reach * uv) * (1.0 + 8.0 * ULP);
                let det = a * c - b * b - 8.0 * ULP * (a * c).abs();
                if a > 0.0 && c > 0.0 { det / (a + c) * (1.0 - 4.0 * ULP) } else { 0.0 }
            }
            [true, false] => a,
            [false, true] => c,
            [false, false] => f64::INFINITY,
        };
        (curvature > 0.0).then_some(curvature)
    }

    /// The parameter to halve so that a slope keeps its sign sooner: of the slope that is nearest to that, the one that
    /// contributes more to how much it varies.
    pub fn blurring(&self, free: [bool; 2]) -> usize {
        let Some(second) = self.second else { return self.longer() };
        let [uu, uv, vv] = self.curvatures(second);
        let ([h, l], [s, t]) = (self.half, self.tangents);
        let vary = [[uu * h, uv * l], [uv * h, vv * l]];
        let sharp = [0, 1].map(|k| {
            let slope = dot(self.r, if k == 0 { s } else { t }).abs();
            if free[k] { slope / (vary[k][0] + vary[k][1]) } else { -1.0 }
        });
        let nearest = usize::from(sharp[1] > sharp[0]);
        usize::from(vary[nearest][1] > vary[nearest][0])
    }

    /// The parameter to halve: the one that contributes more to the uncertainty.
    pub fn longer(&self) -> usize {
        let [h, k] = self.half;
        let shares = match (self.second, self.lipschitz) {
            (Some([uu, uv, vv]), _) => {
                let mixed = uv * h * k;
                [0, 1].map(|i| {
                    let x = self.half[i];
                    let own = if i == 0 { uu } else { vv };
                    norm(self.tangents[i]) * x + own * x * x + mixed
                })
            }
            (None, Some([u, v])) => [u * h, v * k],
            (None, None) => [h, k],
        };
        usize::from(k > 0.0 && (shares[1] > shares[0] || h == 0.0))
    }
}

/// Whether two intervals have a common point.
pub fn meet(a: [f64; 2], b: [f64; 2]) -> bool {
    a[0] <= b[1] && b[0] <= a[1]
}

/// The two halves of a box along parameter k; `None` when no double lies between its ends.
pub fn halves(range: [f64; 4], k: usize) -> Option<[[f64; 4]; 2]> {
    let (centre, _) = middle(range[2 * k], range[2 * k + 1]);
    if centre <= range[2 * k] || centre >= range[2 * k + 1] {
        return None;
    }
    let (mut low, mut high) = (range, range);
    (low[2 * k + 1], high[2 * k]) = (centre, centre);
    Some([low, high])
}

#[cfg(test)]
mod tests {
    use super::super::source::Source;
    use super::*;

    /// A wave over the plane, with first derivatives or without; |S_uu| <= 0.36 and so on.
    fn wave(orders: usize, kinds: [bool; 2]) -> Shape {
        let function = move |at: [f64; 2], order: usize, out: &mut [Vector; 6]| {
            *out = wave_values(at);
            Some(orders.min(order))
        };
        let source = Source::new(2, [-1.0, 2.0, 0.0, 3.0], Box::new(function)).unwrap();
        let bounds = SurfaceBounds {
            speed: kinds[0].then_some([1.36, 1.24]),
            second: kinds[1].then_some([0.432, 0.288, 0.192]),
        };
        Shape::new(source, bounds).unwrap()
    }

    /// (u, v, 0.3 sin(1.2 u + 0.8 v)).
    fn wave_values([u, v]: [f64; 2]) -> [Vector; 6] {
        let (s, c) = (1.2 * u + 0.8 * v).sin_cos();
        let z = [0.3 * s, 0.36 * c, 0.24 * c, -0.432 * s, -0.288 * s, -0.192 * s];
        let flat = [[u, v], [1.0, 0.0], [0.0, 1.0], [0.0; 2], [0.0; 2], [0.0; 2]];
        [0, 1, 2, 3, 4, 5].map(|k| [flat[k][0], flat[k][1], z[k]])
    }

    #[test]
    fn bounds_of_a_box_hold_for_its_samples() {
        for (orders, kinds) in
            [(2, [true, true]), (0, [false, true]), (1, [false, true]), (2, [true, false])]
        {
            let shape = wave(orders, kinds);
            for (i, query) in
                [[0.3, 1.0, 0.7], [0.1, 1.5, -0.2], [4.0, -2.0, 3.0]].into_iter().enumerate()
            {
                let probe = Probe::new(&shape, query);
                for size in [1.0, 0.2, 1e-3] {
                    let range =
                        [0.1, 0.1 + size, 0.4 + 0.3 * i as f64, 0.4 + 0.3 * i as f64 + 0.7 * size];
                    check_box(&probe, range);
                }
            }
        }
    }

    fn check_box(probe: &Probe, range: [f64; 4]) {
        let view = View::new(probe, range).unwrap();
        let convex = view.convexity();
        for k in 0..=8 * 9 {
            let share = |i: usize| i as f64 / 8.0;
            let at = [
                range[0] + share(k % 9) * (range[1] - range[0]),
                range[2] + share(k / 9) * (range[3] - range[2]),
            ];
            let [point, s, t, ss, st, tt] = wave_values(at);
            let d = sub(point, probe.query);
            assert!(view.lower() <= norm(d) + 1e-15 && norm(d) <= view.upper() + 1e-15);
            for (i, tangent) in [s, t].into_iter().enumerate() {
                assert!(norm(tangent) <= view.speeds[i] + 1e-15);
                let Some((slope, vary)) = view.slope(i) else { continue };
                assert!((dot(d, tangent) - slope).abs() <= vary + 1e-15, "{at:?} in {range:?}");
            }
            if let Some(curvature) = convex {
                let (a, c) = (dot(s, s) + dot(d, ss), dot(t, t) + dot(d, tt));
                let b = dot(s, t) + dot(d, st);
                let half = (0.25 * (a - c) * (a - c) + b * b).sqrt();
                assert!(0.5 * (a + c) - half >= curvature, "{at:?} in {range:?}");
            }
        }
    }

    #[test]
    fn boxes_beyond_the_centre_of_curvature_are_not_called_convex() {
        let shape = wave(2, [false, true]);
        // A trough of the wave, seen from above.
        for z in [1.0, 1.8, 2.2, 3.0, 4.0, 20.0] {
            let probe = Probe::new(&shape, [1.75, 2.9, z]);
            check_box(&probe, [1.7, 1.8, 2.8, 2.95]);
        }
    }

    #[test]
    fn near_the_shape_small_boxes_are_convex_and_far_from_it_they_are_not() {
        let shape = wave(1, [false, true]);
        let convex = |z: f64| {
            let probe = Probe::new(&shape, [0.3, 1.0, z]);
            View::new(&probe, [0.2, 0.4, 0.9, 1.1]).unwrap().convexity().is_some()
        };
        assert!(convex(0.5) && !convex(9.0));
    }

    #[test]
    fn halves_meet_in_the_middle_and_end_at_neighbours() {
        let [low, high] = halves([0.0, 1.0, 3.0, 3.0], 0).unwrap();
        assert_eq!([low, high], [[0.0, 0.5, 3.0, 3.0], [0.5, 1.0, 3.0, 3.0]]);
        assert!(halves([1.0, 1.0f64.next_up(), 0.0, 1.0], 0).is_none());
        assert!(halves([0.0, 1.0, 3.0, 3.0], 1).is_none());
    }
}
