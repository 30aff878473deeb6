//! The chord of a pole: what formula (3) takes for the curve without that pole.
//!
//! The published text has one segment and the chord from its first to its last point. A spline of several spans has a chord for
//! each pole: between the two points of the curve where the pole's basis function begins and ends, which do not move with
//! its weight. With one span that is the published chord. It is a segment: a foot beyond its end is its end. On a
//! closed curve of one span both ends coincide, and the chord is that point.

use super::net::Net;
use crate::bounds::{Vector, add, dot, norm, scaled, sub};
use crate::curve::Curve;

/// The distance of each pole from its chord.
pub fn distances(curve: &Curve) -> Vec<f64> {
    let (poles, knots, degree) = (curve.poles(), curve.knots().values(), curve.degree());
    let (first, last) = curve.domain();
    let place = |u: f64| curve.evaluate(u.clamp(first, last));
    let chord = |k: usize| [place(knots[k]), place(knots[k + degree + 1])];
    (0..poles.len()).map(|k| from_segment(poles[k], chord(k))).collect()
}

/// The least distance of a point from a segment.
fn from_segment(point: Vector, [a, b]: [Vector; 2]) -> f64 {
    let (along, from_a) = (sub(b, a), sub(point, a));
    let square = dot(along, along);
    let share = if square > 0.0 { (dot(from_a, along) / square).clamp(0.0, 1.0) } else { 0.0 };
    norm(sub(point, add(a, scaled(along, share))))
}

/// As [`distances`] for either kind of net. A pole of a surface is measured along the line of formula (1): from the place, for
/// weight 0, of the point in the middle of its support.
pub fn lengths(net: &Net) -> Vec<f64> {
    let Net::Surface(surface) = net else {
        return if let Net::Curve(curve) = net { distances(curve) } else { Vec::new() };
    };
    let mut shares = Vec::new();
    let middle = |knots: &crate::knots::Knots, i: usize| {
        let (first, last) = knots.domain();
        let inside = &knots.values()[i + 1..=i + knots.degree()];
        (inside.iter().sum::<f64>() / inside.len() as f64).clamp(first, last)
    };
    let poles = surface.poles();
    (0..poles.len())
        .map(|k| {
            let (i, j) = (k / net.width(), k % net.width());
            let at = [middle(surface.knots_u(), i), middle(surface.knots_v(), j)];
            net.shares(at, &mut shares);
            let rest: f64 = shares.iter().filter(|(other, _)| *other != k).map(|(_, n)| n).sum();
            if rest <= 0.0 {
                return 0.0;
            }
            let others = shares.iter().filter(|(other, _)| *other != k);
            let away = others.fold([0.0; 3], |sum, (other, n)| {
                add(sum, scaled(sub(poles[*other], poles[k]), n / rest))
            });
            norm(away)
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_chord_is_a_segment_and_of_a_closed_curve_a_point() {
        let chord = [[0.0; 3], [4.0, 0.0, 0.0]];
        assert_eq!(from_segment([1.0, 2.0, 0.0], chord), 2.0);
        assert_eq!(from_segment([7.0, 4.0, 0.0], chord), 5.0);
        assert_eq!(from_segment([3.0, 4.0, 0.0], [[0.0; 3]; 2]), 5.0);
    }
}
