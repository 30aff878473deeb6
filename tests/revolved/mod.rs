//! Surfaces of revolution about the z axis as exact NURBS, for the tests.
#![allow(dead_code, reason = "each test program uses a part")]

use crate::shapes::Vector;
use footpoint::surface::Surface;
use std::f64::consts::FRAC_1_SQRT_2 as HALF;

/// Knots of the full circle in four quadratic quarters.
pub const QUARTERS: [f64; 12] = [0., 0., 0., 1., 1., 2., 2., 3., 3., 4., 4., 4.];

const TURN: [[f64; 2]; 9] = [
    [1., 0.],
    [1., 1.],
    [0., 1.],
    [-1., 1.],
    [-1., 0.],
    [-1., -1.],
    [0., -1.],
    [1., -1.],
    [1., 0.],
];

fn weight(i: usize) -> f64 {
    if i.is_multiple_of(2) { 1.0 } else { HALF }
}

/// The circle in the plane y = 0: knots, poles with weights.
pub fn circle(centre: Vector, radius: f64) -> (Vec<f64>, Vec<(Vector, f64)>) {
    let pole = |i: usize| {
        let [x, z] = TURN[i];
        ([centre[0] + radius * x, centre[1], centre[2] + radius * z], weight(i))
    };
    (QUARTERS.to_vec(), (0..9).map(pole).collect())
}

/// A profile in the plane y = 0, x >= 0, turned about the z axis: u turns, v runs along the profile.
pub fn revolved(knots: &[f64], degree: usize, profile: &[(Vector, f64)]) -> Surface {
    let (mut poles, mut weights) = (Vec::new(), Vec::new());
    for (i, [c, s]) in TURN.into_iter().enumerate() {
        for (pole, w) in profile {
            poles.push([pole[0] * c, pole[0] * s, pole[2]]);
            weights.push(w * weight(i));
        }
    }
    let n = profile.len();
    Surface::new(&QUARTERS, knots, 2, degree, &poles, 9, n, Some(&weights)).unwrap()
}

/// The ellipsoid with these semi-axes; the ends of the z axis are collapsed edges.
pub fn ellipsoid([a, b, c]: [f64; 3]) -> Surface {
    let meridian = [[0., -1.], [1., -1.], [1., 0.], [1., 1.], [0., 1.]];
    let profile: Vec<(Vector, f64)> =
        meridian.iter().enumerate().map(|(i, p)| ([p[0], 0.0, p[1]], weight(i))).collect();
    let round = revolved(&[0., 0., 0., 1., 1., 2., 2., 2.], 2, &profile);
    let poles: Vec<Vector> = round.poles().iter().map(|p| [a * p[0], b * p[1], c * p[2]]).collect();
    let knots = [round.knots_u().values(), round.knots_v().values()];
    Surface::new(knots[0], knots[1], 2, 2, &poles, 9, 5, round.weights()).unwrap()
}
