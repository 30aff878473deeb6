//! Foot points on surfaces.

use super::{Approach, Landing, Method, NO_STEP, Trace, arc_ratio, is_last};
use crate::bounds::{Vector, cross, dot};
use crate::jet::{BezierPatch, Jet2};
use crate::simd::Lanes;

/// What the iteration asks of a surface.
pub trait SurfaceJets {
    /// Jet at a pair of parameters.
    fn jet(&self, s: f64, t: f64) -> Jet2;
    /// The parameters as the caller knows them, for traces.
    fn global(&self, s: f64, t: f64) -> [f64; 2];
    /// What the caller's lengths are multiplied by.
    fn scale(&self) -> f64 {
        1.0
    }
}

impl SurfaceJets for (BezierPatch<'_>, Vector) {
    fn jet(&self, s: f64, t: f64) -> Jet2 {
        self.0.jet(s, t, self.1)
    }

    fn global(&self, s: f64, t: f64) -> [f64; 2] {
        [s, t]
    }
}

/// Dampings that are tried one after the other when the second-order step fails.
const DAMPING: [f64; 6] = [0.0, 1e-3, 0.1, 1.0, 30.0, 1e3];

/// Share of the squared distance that a step must promise to be tried at less than a tenth of its length.
const LEAST_PROMISE: f64 = 1e-11;

/// A parameter pair, its box and which of the two is held at a border.
pub(super) struct State {
    pub at: [f64; 2],
    pub range: [f64; 4],
}

impl State {
    fn low(&self, k: usize) -> f64 {
        self.range[2 * k]
    }

    fn high(&self, k: usize) -> f64 {
        self.range[2 * k + 1]
    }

    fn width(&self, k: usize) -> f64 {
        self.high(k) - self.low(k)
    }

    /// Parameters that the gradient presses against their border.
    fn held(&self, g: [f64; 2]) -> [bool; 2] {
        [0, 1].map(|k| {
            (self.at[k] <= self.low(k) && g[k] >= 0.0)
                || (self.at[k] >= self.high(k) && g[k] <= 0.0)
        })
    }

    /// The point `share` of the way along `step`, inside the box.
    pub fn moved(&self, step: [f64; 2], share: f64) -> [f64; 2] {
        [0, 1].map(|k| (self.at[k] + share * step[k]).clamp(self.low(k), self.high(k)))
    }

    /// Whether a move reaches no other side of the box, and leaves none.
    fn keeps_sides(&self, to: [f64; 2]) -> bool {
        let inside = |k: usize| self.low(k) < to[k] && to[k] < self.high(k);
        (0..2).all(|k| {
            to[k] == self.at[k]
                || inside(k) && self.low(k) < self.at[k] && self.at[k] < self.high(k)
        })
    }

    /// Greatest move, as a share of the box.
    pub fn size(&self, to: [f64; 2]) -> f64 {
        let share = |k: usize| {
            if self.width(k) > 0.0 { (to[k] - self.at[k]).abs() / self.width(k) } else { 0.0 }
        };
        share(0).max(share(1))
    }
}

/// Iterates from `start` inside `range` (s low, s high, t low, t high) to a local minimum of the distance.
///
/// Returns the parameters, the jet there and the number of jets taken.
pub fn foot_on_surface(
    surface: &impl SurfaceJets,
    start: [f64; 2],
    range: [f64; 4],
    method: Method,
    trace: Option<Trace>,
) -> ([f64; 2], Jet2, u32) {
    let from = Approach::new(start);
    let Landing { at, jet, taken, .. } = iterate(surface, from, range, method, trace, true);
    (at, jet, taken)
}

/// As [`foot_on_surface`], but the foot need not have been looked at: a jet less. An iteration that goes on takes the same steps as
/// the whole one.
pub fn land_on_surface(
    surface: &impl SurfaceJets,
    from: Approach<[f64; 2]>,
    range: [f64; 4],
    method: Method,
) -> Landing<[f64; 2], Jet2> {
    iterate(surface, from, range, method, None, false)
}

fn iterate(
    surface: &impl SurfaceJets,
    from: Approach<[f64; 2]>,
    range: [f64; 4],
    method: Method,
    mut trace: Option<Trace>,
    look: bool,
) -> Landing<[f64; 2], Jet2> {
    let mut before = from.step;
    let mut state = State { at: from.at, range };
    state.at = state.moved([0.0; 2], 0.0);
    let mut place = Place::new(surface.jet(state.at[0], state.at[1]));
    let mut taken = from.taken + 1;
    tell(&mut trace, surface, 0, state.at, &place);
    let steps = if from.is_foot { 0 } else { method.steps() };
    let first = taken;
    for count in first..=steps {
        let held = state.held(place.g);
        let Some((step, second_order)) = bounded_step(&state, &place, method) else { break };
        let whole = state.moved(step, 1.0);
        let size = state.size(whole);
        if size <= NO_STEP {
            break;
        }
        let last = second_order && is_last(size, before);
        if last && !look && state.keeps_sides(whole) {
            return Landing { at: whole, seen: state.at, jet: place.jet, taken };
        }
        let accept = |candidate: &Place| last || improved(candidate, &place, held);
        let patience = if method == Method::Auto { 0.2 } else { 1e-4 };
        let mut found = advance(surface, &state, step, patience, &accept, &mut taken);
        if method == Method::Auto && held == [false; 2] {
            // A second-order model that is wrong so far out: damped falls on the tangent plane, ever shorter.
            for damping in DAMPING {
                if found.is_none() {
                    let step = damped_fall(&place, damping);
                    found = advance(surface, &state, step, 0.6, &accept, &mut taken);
                }
            }
        }
        if found.is_none() && method == Method::Auto {
            // Where the sides of the box cut a step off, what is left of it may point anywhere: one by one, then.
            let alone = [0, 1].map(|k| single(&place.jet, k, method).0);
            for step in [step, alone[0], alone[1]] {
                if found.is_none() {
                    found = creep(surface, &state, &place, step, &accept, &mut taken);
                }
            }
        }
        let Some((next, candidate)) = found else { break };
        before = (second_order && next == whole).then_some(size);
        (state.at, place) = (next, candidate);
        tell(&mut trace, surface, count, state.at, &place);
        // A step with other parameters held than those that are held now proves nothing about the next one.
        if last && state.held(place.g) == held {
            break;
        }
    }
    Landing { at: state.at, seen: state.at, jet: place.jet, taken }
}

/// A jet with the products that every step needs, formed once.
struct Place {
    jet: Jet2,
    squared: f64,
    g: [f64; 2],
    metric: [f64; 3],
    hessian: [f64; 3],
}

impl Place {
    fn new(jet: Jet2) -> Self {
        let Products { squared, g, metric, hessian } =
            Products::new([jet.d, jet.s, jet.t, jet.ss, jet.st, jet.tt]);
        Self { jet, squared, g, metric, hessian }
    }
}

/// The products of one jet or, lane by lane, of many.
pub(super) struct Products<V> {
    pub squared: V,
    pub g: [V; 2],
    pub metric: [V; 3],
    pub hessian: [V; 3],
}

impl<V> Products<V> {
    /// From d, s, t, ss, st, tt.
    #[inline(always)]
    pub fn new<const N: usize>([d, s, t, ss, st, tt]: [[V; 3]; 6]) -> Self
    where
        V: Lanes<N>,
    {
        let metric = [dot(s, s), dot(s, t), dot(t, t)];
        let [e, f, h] = metric;
        let hessian = [e + dot(d, ss), f + dot(d, st), h + dot(d, tt)];
        Self { squared: dot(d, d), g: [dot(d, s), dot(d, t)], metric, hessian }
    }
}

/// What the gradient is worth beside the metric: tells which of two places as near as the other is the better one.
#[inline(always)]
pub(super) fn steepness<V: Lanes<N>, const N: usize>(g: V, size: V) -> V {
    g * g / (size + V::splat(1e-300))
}

/// The determinant of a Hessian, and the least one that counts as positive.
#[inline(always)]
pub(super) fn determinant<V: Lanes<N>, const N: usize>([a, b, c]: [V; 3]) -> [V; 2] {
    [a * c - b * b, V::splat(1e-14) * a * c]
}

/// The squared length of a step on the tangent plane, and the greatest that is plausible: on a plane the foot is one
/// distance away at most, so a step of many distances comes from a Hessian that is nearly singular.
#[inline(always)]
pub(super) fn stride<V: Lanes<N>, const N: usize>(
    [e, f, g]: [V; 3],
    [x, y]: [V; 2],
    squared: V,
) -> [V; 2] {
    [e * x * x + V::splat(2.0) * f * x * y + g * y * y, V::splat(64.0) * squared]
}

/// A much shorter step, where the gradient promises something: models fail where derivatives nearly vanish.
fn creep(
    surface: &impl SurfaceJets,
    state: &State,
    place: &Place,
    step: [f64; 2],
    accept: &impl Fn(&Place) -> bool,
    taken: &mut u32,
) -> Option<([f64; 2], Place)> {
    let (g, to) = (place.g, state.moved(step, 1.0));
    let way = [to[0] - state.at[0], to[1] - state.at[1]];
    let promise = -(g[0] * way[0] + g[1] * way[1]);
    if promise > LEAST_PROMISE * place.squared {
        advance(surface, state, way.map(|x| 0.125 * x), 1e-4, accept, taken)
    } else {
        None
    }
}

/// The first of the step, its half, its quarter ... down to `least` that is accepted.
fn advance(
    surface: &impl SurfaceJets,
    state: &State,
    step: [f64; 2],
    least: f64,
    accept: &impl Fn(&Place) -> bool,
    taken: &mut u32,
) -> Option<([f64; 2], Place)> {
    let mut share = 1.0;
    while share > least {
        let next = state.moved(step, share);
        let candidate = Place::new(surface.jet(next[0], next[1]));
        *taken += 1;
        if accept(&candidate) {
            return Some((next, candidate));
        }
        share *= 0.5;
    }
    None
}

/// Nearer, or as near as rounding can tell and with a smaller gradient in the parameters that are free.
fn improved(new: &Place, old: &Place, held: [bool; 2]) -> bool {
    let steepness = |place: &Place| {
        let share =
            |k: usize| if held[k] { 0.0 } else { steepness(place.g[k], place.metric[2 * k]) };
        share(0) + share(1)
    };
    is_better([new.squared, old.squared], || [steepness(new), steepness(old)])
}

/// The same from the squared distances and the steepness of the new and the old place.
pub(super) fn is_better([a, b]: [f64; 2], steepness: impl FnOnce() -> [f64; 2]) -> bool {
    let flatter = || {
        let [new, old] = steepness();
        new < old
    };
    a < b - 1e-13 * b || a <= b + 1e-13 * b + 1e-28 && flatter()
}

fn tell(
    trace: &mut Option<Trace>,
    surface: &impl SurfaceJets,
    step: u32,
    at: [f64; 2],
    place: &Place,
) {
    if let Some(trace) = trace {
        let [u, v] = surface.global(at[0], at[1]);
        trace(step, u, v, place.squared.sqrt() / surface.scale());
    }
}

/// A descent step over the parameters that are free; `None` at a point where nothing can move.
///
/// A parameter at its border may be free by its gradient and still be pushed outward by a coupled step; it is
/// then held for this step, and if the other one does not want to move either, it takes its own step.
fn bounded_step(state: &State, place: &Place, method: Method) -> Option<([f64; 2], bool)> {
    let (g, jet) = (place.g, &place.jet);
    let held = state.held(g);
    match held {
        [true, true] => return None,
        [true, false] => return Some(single(jet, 1, method)),
        [false, true] => return Some(single(jet, 0, method)),
        [false, false] => {}
    }
    let (step, second_order) = free_step(place, method);
    for k in 0..2 {
        let outward = (state.at[k] <= state.low(k) && step[k] < 0.0)
            || (state.at[k] >= state.high(k) && step[k] > 0.0);
        if outward {
            // Taken one by one, coupled parameters converge at first order only.
            let (other, _) = single(jet, 1 - k, method);
            if state.size(state.moved(other, 1.0)) > NO_STEP {
                return Some((other, false));
            }
            return Some((single(jet, k, method).0, false));
        }
    }
    (g != [0.0; 2]).then_some((step, second_order))
}

/// The step of one parameter alone.
fn single(jet: &Jet2, k: usize, method: Method) -> ([f64; 2], bool) {
    let one = jet.along(k);
    let (g, hessian, speed) = (one.gradient(), one.hessian(), dot(one.s, one.s));
    let (step, order) = if hessian > 0.0 && method != Method::Maf {
        (-g / hessian, true)
    } else if speed > 0.0 {
        (-g / speed, false)
    } else {
        (0.0, false)
    };
    let mut both = [0.0; 2];
    both[k] = step;
    (both, order)
}

/// The step of a method with both parameters free, and whether it is of second order here.
fn free_step(place: &Place, method: Method) -> ([f64; 2], bool) {
    let (g, jet) = (place.g, &place.jet);
    let [a, _, c] = place.hessian;
    let [determinant, least] = determinant(place.hessian);
    let newton = a > 0.0 && c > 0.0 && determinant > least;
    let step = solved(place.hessian, g);
    match method {
        Method::Auto if newton && is_plausible(place, step) => (step, true),
        Method::Newton if newton => (step, true),
        Method::Maf | Method::Newton => (fall(jet, g), place.squared < 1e-14 * (a + c)),
        Method::Auto | Method::Osculating => (osculating(jet, g), newton),
    }
}

fn is_plausible(place: &Place, step: [f64; 2]) -> bool {
    let [square, most] = stride(place.metric, step, place.squared);
    square <= most
}

/// `-M^-1 g` for a symmetric positive definite 2 x 2 matrix.
#[inline(always)]
pub(super) fn solved<V: Lanes<N>, const N: usize>([a, b, c]: [V; 3], g: [V; 2]) -> [V; 2] {
    let det = a * c - b * b;
    [(b * g[1] - c * g[0]) / det, (b * g[0] - a * g[1]) / det]
}

/// The fall on the tangent plane with the metric's diagonal enlarged: Levenberg's and Marquardt's step, which bends
/// towards the steepest descent in a valley.
fn damped_fall(place: &Place, damping: f64) -> [f64; 2] {
    let ([e, f, h], g) = (place.metric, place.g);
    let step = solved([e * (1.0 + damping), f, h * (1.0 + damping)], g);
    if step.iter().all(|x| x.is_finite()) { step } else { [0.0; 2] }
}

/// The moving-affine-frame step: the fall on the tangent plane. Where the plane is degenerate the two
/// directions are taken one by one.
fn fall(jet: &Jet2, g: [f64; 2]) -> [f64; 2] {
    let [e, f, h] = jet.metric();
    if e * h - f * f > 1e-12 * e * h {
        return solved([e, f, h], g);
    }
    let along = |g: f64, m: f64| if m > 0.0 { -0.5 * g / m } else { 0.0 };
    [along(g[0], e), along(g[1], h)]
}

/// The fall, bent along the osculating circles of the two principal directions (a torus has the same two).
///
/// In an orthonormal frame of the tangent plane the second fundamental form is diagonalised; each component of
/// the fall is lengthened to the arc that leads to the foot on that circle.
fn osculating(jet: &Jet2, g: [f64; 2]) -> [f64; 2] {
    let [e, f, h] = jet.metric();
    let normal = cross(jet.s, jet.t);
    let area = dot(normal, normal).sqrt();
    if area * area <= 1e-12 * e * h {
        return fall(jet, g);
    }
    let n = normal.map(|x| x / area);
    // x = r1 a, y = r2 a + r3 b: parameters (a, b) to an orthonormal frame, (x, y) with the first axis on S_s.
    let (r1, r2, r3) = (e.sqrt(), f / e.sqrt(), area / e.sqrt());
    let (l, m, k) = (dot(jet.ss, n), dot(jet.st, n), dot(jet.tt, n));
    let l11 = l / (r1 * r1);
    let l12 = (m - l * r2 / r1) / (r1 * r3);
    let l22 = (k - 2.0 * m * r2 / r1 + l * (r2 / r1) * (r2 / r1)) / (r3 * r3);
    let step = solved([e, f, h], g);
    let (x, y) = (r1 * step[0] + r2 * step[1], r3 * step[1]);
    let (cos, sin) = principal(l11, l12, l22);
    let height = -dot(jet.d, n);
    let k1 = l11 * cos * cos + 2.0 * l12 * cos * sin + l22 * sin * sin;
    let k2 = l11 * sin * sin - 2.0 * l12 * cos * sin + l22 * cos * cos;
    let (p, q) = (cos * x + sin * y, cos * y - sin * x);
    let (p, q) = (p * arc_ratio(p, height, k1), q * arc_ratio(q, height, k2));
    let (x, y) = (cos * p - sin * q, sin * p + cos * q);
    let b = y / r3;
    [(x - r2 * b) / r1, b]
}

/// Cosine and sine of the first principal direction of a symmetric 2 x 2 form.
fn principal(a: f64, b: f64, c: f64) -> (f64, f64) {
    if b == 0.0 {
        return (1.0, 0.0);
    }
    // Jacobi rotation: tan of the angle from cot 2 phi, without trigonometry.
    let cot = (a - c) / (2.0 * b);
    let tan = 1.0 / (cot.abs() + (1.0 + cot * cot).sqrt());
    let tan = if cot < 0.0 { -tan } else { tan };
    let cos = 1.0 / (1.0 + tan * tan).sqrt();
    (cos, tan * cos)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bezier::Bidegree;
    use crate::bounds::{add, scaled};
    use crate::jet::{Lane, lanes};
    use crate::simd::Level;

    fn patch_poles() -> Vec<f64> {
        let (mut x, mut y, mut z) = (vec![], vec![], vec![]);
        for i in 0..4 {
            for j in 0..4 {
                x.push(i as f64);
                y.push(j as f64);
                z.push(((i * 5 + j * 3) % 4) as f64 * 0.4);
            }
        }
        [x, y, z].concat()
    }

    #[test]
    fn every_method_finds_a_planted_foot() {
        let poles = patch_poles();
        let lanes: Vec<Lane> = lanes(&poles, false).collect();
        let patch = BezierPatch {
            degree: Bidegree { s: 3, t: 3 },
            rational: false,
            poles: &poles,
            lanes: &lanes,
            level: Level::detect(),
        };
        for (s, t) in [(0.2, 0.7), (0.5, 0.5), (0.9, 0.1)] {
            let jet = patch.jet(s, t, [0.0; 3]);
            let n = cross(jet.s, jet.t);
            let query = add(jet.d, scaled(n, 0.2 / dot(n, n).sqrt()));
            for method in [Method::Auto, Method::Maf, Method::Newton, Method::Osculating] {
                let (at, jet, _) = foot_on_surface(
                    &(patch, query),
                    [s + 0.04, t - 0.03],
                    [0.0, 1.0, 0.0, 1.0],
                    method,
                    None,
                );
                assert!((at[0] - s).abs() + (at[1] - t).abs() < 1e-8, "{method:?} {at:?} {s} {t}");
                assert!((jet.squared().sqrt() - 0.2).abs() < 1e-13);
            }
        }
    }

    #[test]
    fn the_osculating_step_is_of_second_order_off_the_surface() {
        let poles = patch_poles();
        let lanes: Vec<Lane> = lanes(&poles, false).collect();
        let patch = BezierPatch {
            degree: Bidegree { s: 3, t: 3 },
            rational: false,
            poles: &poles,
            lanes: &lanes,
            level: Level::detect(),
        };
        let jet = patch.jet(0.4, 0.6, [0.0; 3]);
        let n = cross(jet.s, jet.t);
        let query = add(jet.d, scaled(n, 0.4 / dot(n, n).sqrt()));
        let (_, _, taken) = foot_on_surface(
            &(patch, query),
            [0.42, 0.58],
            [0.0, 1.0, 0.0, 1.0],
            Method::Osculating,
            None,
        );
        assert!(taken <= 6, "{taken}");
    }

    #[test]
    fn corners_and_edges_hold_a_foot_that_wants_to_leave() {
        let poles = patch_poles();
        let lanes: Vec<Lane> = lanes(&poles, false).collect();
        let patch = BezierPatch {
            degree: Bidegree { s: 3, t: 3 },
            rational: false,
            poles: &poles,
            lanes: &lanes,
            level: Level::detect(),
        };
        let all = [0.0, 1.0, 0.0, 1.0];
        let (at, _, _) =
            foot_on_surface(&(patch, [-3.0, -3.0, 0.0]), [0.5, 0.5], all, Method::Auto, None);
        assert_eq!(at, [0.0, 0.0]);
        let (at, _, _) =
            foot_on_surface(&(patch, [1.4, 9.0, 0.5]), [0.5, 0.5], all, Method::Auto, None);
        assert_eq!(at[1], 1.0);
        assert!(at[0] > 0.0 && at[0] < 1.0);
    }
}
