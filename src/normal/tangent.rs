//! Unit tangents of curves: one-sided where they break, limits where the derivative vanishes.

use super::fan::{differ, unit};
use super::{SNAP, break_near, flag};
use crate::bounds::{Vector, norm, scaled, sub};
use crate::curve::{Curve, binomial};
use crate::knots::Side;

/// Derivatives looked at.
const ORDER: usize = 8;

/// A derivative shorter than this share of the local poles' extent vanishes (times the growth of its rounding).
const LEAST_SPEED: f64 = 1e-11;

/// The tangents of one curve: what is the same for all feet, computed once.
#[derive(Clone, Debug)]
pub struct Tangents<'a> {
    curve: &'a Curve,
    closed: bool,
}

impl<'a> Tangents<'a> {
    /// Looks at the ends of the curve.
    pub fn new(curve: &'a Curve) -> Self {
        Self { curve, closed: curve.is_closed() }
    }

    /// The unit tangent at `u` in the domain and bits of [`flag`]: that of the piece above, at the domain's end of the
    /// one below; where that piece is a point, of the other one. NaN has none.
    pub fn at(&self, u: f64) -> (Vector, u32) {
        if u.is_nan() {
            return ([f64::NAN; 3], flag::UNDEFINED);
        }
        let (first, last) = self.curve.domain();
        let snap = SNAP * first.abs().max(last.abs());
        let (at_first, at_last) = (u - first <= snap, last - u <= snap);
        let knot = break_near(self.curve.knots(), u, snap);
        let at = if at_first {
            first
        } else if at_last {
            last
        } else {
            knot.unwrap_or(u)
        };
        let above = if !at_last {
            self.on(at, Side::Above)
        } else if self.closed {
            self.on(first, Side::Above)
        } else {
            None
        };
        let looks_back = at_first || at_last || knot.is_some() || above.is_none_or(|t| t.1);
        let below = if !looks_back || at_first && !self.closed {
            None
        } else {
            self.on(if at_first { last } else { at }, Side::Below)
        };
        let (one, other) = if at_last { (below, above) } else { (above, below) };
        let Some((tangent, limit)) = one.or(other) else {
            return ([f64::NAN; 3], flag::UNDEFINED);
        };
        let breaks = matches!((above, below), (Some((a, _)), Some((b, _))) if differ(a, b));
        let limit = limit || one.is_none();
        let bits = [(breaks, flag::CREASE), (limit, flag::LIMIT)];
        (tangent, bits.iter().filter(|bit| bit.0).map(|bit| bit.1).sum())
    }

    /// The unit tangent on one side in the direction of travel, and whether it is a limit.
    fn on(&self, u: f64, side: Side) -> Option<(Vector, bool)> {
        let (knots, degree) = (self.curve.knots(), self.curve.degree());
        let span = knots.span_on(u, side);
        let length = knots.values()[span + 1] - knots.values()[span];
        let poles = &self.curve.poles()[span - degree..=span];
        let size = poles.iter().fold(0.0, |most: f64, pole| most.max(norm(sub(*pole, poles[0]))));
        let mut out = [[0.0; 3]; ORDER + 1];
        self.curve.derivatives_on(u, side, ORDER, &mut out);
        let mut factor = 1.0;
        for k in 1..=ORDER.min(degree) {
            factor *= length / k as f64;
            let growth = binomial(degree, k) * (1u64 << k) as f64;
            let term = scaled(out[k], factor);
            if norm(term) > LEAST_SPEED * size * growth {
                // From below an even power looks back.
                let sign = if side == Side::Below && k % 2 == 0 { -1.0 } else { 1.0 };
                return unit(term).map(|tangent| (scaled(tangent, sign), k > 1));
            }
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cusp_has_a_tangent_that_leads_on_and_says_that_it_breaks() {
        // (t^2, t^3) on -1 .. 1.
        let poles = [[1., -1., 0.], [-1. / 3., 1., 0.], [-1. / 3., -1., 0.], [1., 1., 0.]];
        let knots = [-1., -1., -1., -1., 1., 1., 1., 1.];
        let curve = Curve::new(&knots, 3, &poles, None).unwrap();
        let tangents = Tangents::new(&curve);
        let (tangent, flags) = tangents.at(0.0);
        assert!((tangent[0] - 1.0).abs() < 1e-12, "{tangent:?}");
        assert_eq!(flags, flag::CREASE | flag::LIMIT);
        assert_eq!(tangents.at(0.5).1, 0);
        assert_eq!(tangents.at(f64::NAN).1, flag::UNDEFINED);
    }

    #[test]
    fn a_corner_leads_on_and_a_doubled_end_pole_is_no_break() {
        let poles = [[0., 0., 0.], [1., 0., 0.], [1., 1., 0.]];
        let corner = Curve::new(&[0., 0., 1., 2., 2.], 1, &poles, None).unwrap();
        assert_eq!(Tangents::new(&corner).at(1.0), ([0., 1., 0.], flag::CREASE));
        assert_eq!(Tangents::new(&corner).at(2.0), ([0., 1., 0.], 0));
        let poles = [[0., 0., 0.], [0., 0., 0.], [1., 0., 0.]];
        let slow = Curve::new(&[0., 0., 0., 1., 1., 1.], 2, &poles, None).unwrap();
        assert_eq!(Tangents::new(&slow).at(0.0), ([1., 0., 0.], flag::LIMIT));
        let point = Curve::new(&[0., 0., 1., 1.], 1, &[[1.0; 3]; 2], None).unwrap();
        assert_eq!(Tangents::new(&point).at(0.5).1, flag::UNDEFINED);
    }
}
