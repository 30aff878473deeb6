//! Foot points on curves.

use super::{Approach, Landing, Method, NO_STEP, Trace, arc_ratio, is_last};
use crate::bounds::{Vector, dot, scaled, sub};
use crate::jet::{BezierSegment, Jet1};

/// What the iteration asks of a curve.
pub trait CurveJets {
    /// Jet at a parameter.
    fn jet(&self, s: f64) -> Jet1;
    /// The parameter as the caller knows it, for traces.
    fn global(&self, s: f64) -> [f64; 2];
    /// What the caller's lengths are multiplied by.
    fn scale(&self) -> f64 {
        1.0
    }
}

impl CurveJets for (BezierSegment<'_>, Vector) {
    fn jet(&self, s: f64) -> Jet1 {
        self.0.jet(s, self.1)
    }

    fn global(&self, s: f64) -> [f64; 2] {
        [s, 0.0]
    }
}

/// Iterates from `start` inside `[low, high]` to a local minimum of the distance.
///
/// Returns the parameter, the jet there and the number of jets taken.
pub fn foot_on_curve(
    curve: &impl CurveJets,
    start: f64,
    range: [f64; 2],
    method: Method,
    trace: Option<Trace>,
) -> (f64, Jet1, u32) {
    let from = Approach::new(start);
    let Landing { at, jet, taken, .. } = iterate(curve, from, range, method, trace, true);
    (at, jet, taken)
}

/// As [`foot_on_curve`], but the foot need not have been looked at: a jet less. An iteration that goes on takes the same steps as
/// the whole one.
pub fn land_on_curve(
    curve: &impl CurveJets,
    from: Approach<f64>,
    range: [f64; 2],
    method: Method,
) -> Landing<f64, Jet1> {
    iterate(curve, from, range, method, None, false)
}

fn iterate(
    curve: &impl CurveJets,
    from: Approach<f64>,
    range: [f64; 2],
    method: Method,
    mut trace: Option<Trace>,
    look: bool,
) -> Landing<f64, Jet1> {
    let [low, high] = range;
    let width = high - low;
    let mut before = from.step;
    let mut s = from.at.clamp(low, high);
    let mut jet = curve.jet(s);
    let mut taken = from.taken + 1;
    tell(&mut trace, curve, 0, s, &jet);
    let steps = if from.is_foot { 0 } else { method.steps() };
    let first = taken;
    for step in first..=steps {
        let g = jet.gradient();
        if g == 0.0 || (s <= low && g > 0.0) || (s >= high && g < 0.0) {
            break;
        }
        let (raw, second_order) = raw_step(&jet, method);
        let mut next = (s + raw).clamp(low, high);
        if (next - s).abs() <= NO_STEP * next.abs() {
            break;
        }
        let size = (next - s).abs() / width;
        let last = second_order && is_last(size, before);
        if last && !look && low < next && next < high {
            return Landing { at: next, seen: s, jet, taken };
        }
        let whole = next;
        let mut candidate = curve.jet(next);
        taken += 1;
        for _ in 0..12 {
            if last || is_better(worth(&candidate), worth(&jet)) {
                break;
            }
            next = s + 0.5 * (next - s);
            candidate = curve.jet(next);
            taken += 1;
        }
        if !last && candidate.squared() >= jet.squared() && candidate.gradient().abs() >= g.abs() {
            break;
        }
        before = (second_order && next == whole).then_some(size);
        (s, jet) = (next, candidate);
        tell(&mut trace, curve, step, s, &jet);
        if last {
            break;
        }
    }
    Landing { at: s, seen: s, jet, taken }
}

/// Squared distance and gradient.
fn worth(jet: &Jet1) -> [f64; 2] {
    [jet.squared(), jet.gradient()]
}

/// Whether a place, by its squared distance and gradient, is better than the one before: nearer, or as near but for rounding
/// with a gradient less than half as steep.
pub(super) fn is_better([a, new]: [f64; 2], [b, old]: [f64; 2]) -> bool {
    let is_near = || (a - b).abs() <= 1e-13 * b + 1e-28;
    a < b || new.abs() < 0.5 * old.abs() && is_near()
}

fn tell(trace: &mut Option<Trace>, curve: &impl CurveJets, step: u32, s: f64, jet: &Jet1) {
    if let Some(trace) = trace {
        let [u, v] = curve.global(s);
        trace(step, u, v, jet.squared().sqrt() / curve.scale());
    }
}

/// The step of a method and whether it is of second order here.
fn raw_step(jet: &Jet1, method: Method) -> (f64, bool) {
    let g = jet.gradient();
    let speed = dot(jet.s, jet.s);
    let hessian = jet.hessian();
    let newton = hessian > 0.0;
    match method {
        Method::Auto if newton => (-g / hessian, true),
        Method::Newton if newton => (-g / hessian, true),
        _ if speed == 0.0 => (if g < 0.0 { 0.25 } else { -0.25 }, false),
        Method::Maf | Method::Newton => (-g / speed, jet.squared() < 1e-14 * speed),
        Method::Auto | Method::Osculating => (osculating(jet, g, speed), newton),
    }
}

fn osculating(jet: &Jet1, g: f64, speed: f64) -> f64 {
    // Curvature vector k n = (C'' - (C''.C') C' / |C'|^2) / |C'|^2; the height of the query is -d . n.
    let normal = sub(jet.ss, scaled(jet.s, dot(jet.ss, jet.s) / speed));
    let size = dot(normal, normal).sqrt();
    let fall = -g / speed;
    if size == 0.0 {
        return fall;
    }
    let height = -dot(jet.d, normal) / size;
    fall * arc_ratio(fall * speed.sqrt(), height, size / speed)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::jet::{Lane, lanes};
    use crate::simd::Level;

    fn cubic() -> [f64; 12] {
        [0.0, 1.0, 2.0, 3.0, 0.0, 2.0, -1.0, 1.0, 0.0, 0.0, 1.0, 0.5]
    }

    #[test]
    fn every_method_finds_a_planted_foot() {
        let poles = cubic();
        let lanes: Vec<Lane> = lanes(&poles, false).collect();
        let segment = BezierSegment {
            degree: 3,
            rational: false,
            poles: &poles,
            lanes: &lanes,
            level: Level::detect(),
        };
        for s in [0.1, 0.37, 0.8] {
            let jet = segment.jet(s, [0.0; 3]);
            let side = crate::bounds::cross(jet.s, [0.3, 0.2, 1.0]);
            let query = crate::bounds::add(jet.d, scaled(side, 0.05 / dot(side, side).sqrt()));
            for method in [Method::Auto, Method::Maf, Method::Newton, Method::Osculating] {
                let (found, jet, _) =
                    foot_on_curve(&(segment, query), s + 0.05, [0.0, 1.0], method, None);
                assert!((found - s).abs() < 1e-9, "{method:?} {s} {found}");
                assert!((jet.squared().sqrt() - 0.05).abs() < 1e-14);
            }
        }
    }

    #[test]
    fn ends_hold_a_foot_that_wants_to_leave() {
        let poles = cubic();
        let lanes: Vec<Lane> = lanes(&poles, false).collect();
        let segment = BezierSegment {
            degree: 3,
            rational: false,
            poles: &poles,
            lanes: &lanes,
            level: Level::detect(),
        };
        let (s, _, _) =
            foot_on_curve(&(segment, [-2.0, -1.0, 0.0]), 0.3, [0.0, 1.0], Method::Auto, None);
        assert_eq!(s, 0.0);
    }
}
