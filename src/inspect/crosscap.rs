//! Cross-caps: places where the partials of a patch become parallel, proven to be there and to have no bound of curvature.
//!
//! ```text
//!   X_s + l X_t + a X = 0   in homogeneous coordinates: four equations for s, t, l, a
//! ```
//!
//! (or with s and t exchanged) says that one direction of the parameters does not move the point. Krawczyk's operator proves that there is such a place in a
//! box, and that the matrix of derivatives is regular there. Its determinant is, up to powers of the weight, that of S_y, S_xy and
//! S_xx, for x the direction that does not move and y another one. When these three span space the patch is a cross-cap:
//! with n = S_x x S_y and steps h along y
//!
//! ```text
//!   S_x ~ h S_xy     n ~ h S_xy x S_y     n . S_xx ~ h det     normal curvature along x  ~  det / (h |h|)
//! ```
//!
//! which passes every bound on both sides, as do the mean curvature and, downwards, the Gaussian one: n . S_xy = O(h^2) there, and
//! along x it is of the order h while n . S_xx is not.
//!
//! A collapsed edge that has a length of 1e-11 after all has such places beside it, where the edge turns back.
//!
//! References: Whitney, *The general type of singularity of a set of 2n - 1 smooth functions of n variables*, 1943;
//! Neumaier, *Interval Methods for Systems of Equations*, 1990, section 5.1.
//! Limit: places in the inside of a patch; at sides and corners see [`super::growth`].

use super::interval::Interval;
use super::local::{Form, Homogeneous, Room};
use super::request::Quantity;

/// Starts along each direction of a box.
const STARTS: usize = 3;

/// Starts along a side.
const ALONG: usize = 32;

const STEPS: usize = 24;

/// Sizes of the boxes that are tried, as shares of the distance from the border of the area.
const SHARES: [f64; 5] = [0.1, 1e-2, 1e-3, 1e-5, 1e-8];

type Vector4 = [f64; 4];

/// Below and above every number, as a quantity passes them beside a cross-cap.
pub(super) fn passes(quantity: Quantity) -> [bool; 2] {
    match quantity {
        Quantity::Greater | Quantity::Sharpest => [false, true],
        Quantity::Less | Quantity::Gaussian => [true, false],
        Quantity::Mean => [true, true],
    }
}

/// A cross-cap inside an area, if one is found and proven. `side` is the direction along a side that the area covers, when that
/// is why it is singular.
pub(super) fn crosscap(
    form: &Form,
    area: [[f64; 2]; 2],
    side: Option<usize>,
    room: &mut Room,
) -> Option<[f64; 2]> {
    let on =
        |[a, b]: [f64; 2], i: usize, count: usize| a + (b - a) * (i as f64 + 0.5) / count as f64;
    let mut starts = Vec::new();
    match side {
        Some(along) => {
            for i in 0..ALONG {
                let mut place = [0, 1].map(|k| area[k][0]);
                place[along] = on(area[along], i, ALONG);
                if area[1 - along][0] > 0.0 {
                    place[1 - along] = area[1 - along][1];
                }
                starts.push(place);
            }
        }
        None => {
            for i in 0..STARTS * STARTS {
                starts.push([on(area[0], i / STARTS, STARTS), on(area[1], i % STARTS, STARTS)]);
            }
        }
    }
    let mut tried: Vec<[f64; 2]> = Vec::new();
    for start in starts {
        let Some(place) = approached(form, area, start, side) else { continue };
        // The same one again.
        let is_near = |a: &[f64; 2]| (0..2).all(|k| (a[k] - place[k]).abs() <= 1e-6 * a[k].abs());
        if tried.iter().any(is_near) {
            continue;
        }
        tried.push(place);
        if let Some(at) = proven(form, area, place, room) {
            return Some(at);
        }
    }
    None
}

/// With s and t exchanged, if they are.
fn seen<T: Copy>(x: Homogeneous<T>, is_turned: bool) -> Homogeneous<T> {
    if !is_turned {
        return x;
    }
    std::array::from_fn(|c| {
        let [f, s, t, ss, st, tt] = x[c];
        [f, t, s, tt, st, ss]
    })
}

/// Whether t moves the point less than s does.
fn is_turned(x: &Homogeneous<f64>) -> bool {
    let speed = |k: usize| (0..3).map(move |c| (x[c][k] * x[3][0] - x[c][0] * x[3][k]).powi(2));
    speed(2).sum::<f64>() < speed(1).sum::<f64>()
}

/// The equations and their derivatives by s, t, l and a.
fn equations(x: &Homogeneous<f64>, l: f64, a: f64) -> (Vector4, [Vector4; 4]) {
    let value = std::array::from_fn(|c| x[c][1] + l * x[c][2] + a * x[c][0]);
    let rows = std::array::from_fn(|c| {
        let [f, s, t, ss, st, tt] = x[c];
        [ss + l * st + a * s, st + l * tt + a * t, t, f]
    });
    (value, rows)
}

/// l and a for which the equations hold best: of unit columns, by least squares.
fn multipliers(x: &Homogeneous<f64>) -> [f64; 2] {
    let dot = |i: usize, j: usize| (0..4).map(|c| x[c][i] * x[c][j]).sum::<f64>();
    let (tt, tf, ff, st, sf) = (dot(2, 2), dot(2, 0), dot(0, 0), dot(1, 2), dot(1, 0));
    let determinant = tt * ff - tf * tf;
    [(tf * sf - ff * st) / determinant, (tf * st - tt * sf) / determinant]
}

/// Newton's method from a start; none when it leaves the area or does not come to rest.
fn approached(
    form: &Form,
    area: [[f64; 2]; 2],
    start: [f64; 2],
    side: Option<usize>,
) -> Option<[f64; 2]> {
    let mut at = start;
    let is_turned = is_turned(&form.homogeneous_at(at));
    let [mut l, mut a] = multipliers(&seen(form.homogeneous_at(at), is_turned));
    for step in 0..STEPS {
        let (value, rows) = equations(&seen(form.homogeneous_at(at), is_turned), l, a);
        let inverse = inverted(rows)?;
        let moved: Vector4 =
            std::array::from_fn(|i| (0..4).map(|c| inverse[i][c] * value[c]).sum::<f64>());
        // Along a side not farther than to the next start: waves of the edge are that long.
        let most = |k: usize| {
            let width = area[k][1] - area[k][0];
            if side == Some(k) { width / ALONG as f64 } else { width }
        };
        let mut next = at;
        for k in 0..2 {
            let step = moved[if is_turned { 1 - k } else { k }];
            next[k] = (at[k] - step.clamp(-most(k), most(k))).clamp(area[k][0], area[k][1]);
        }
        let is_at_rest = (0..2).all(|k| {
            let room = (next[k] - area[k][0]).min(area[k][1] - next[k]);
            (next[k] - at[k]).abs() <= 1e-9 * room
        });
        at = next;
        (l, a) = (l - moved[2], a - moved[3]);
        if !(l.is_finite() && a.is_finite()) {
            return None;
        }
        if is_at_rest && step > 0 {
            return Some(at);
        }
    }
    None
}

/// The inverse of a matrix; none when a pivot is zero.
fn inverted(rows: [Vector4; 4]) -> Option<[Vector4; 4]> {
    let mut left = rows;
    let mut right: [Vector4; 4] =
        std::array::from_fn(|i| std::array::from_fn(|j| f64::from(u8::from(i == j))));
    for k in 0..4 {
        let pivot = (k..4).max_by(|&i, &j| left[i][k].abs().total_cmp(&left[j][k].abs()))?;
        left.swap(k, pivot);
        right.swap(k, pivot);
        let inverse = 1.0 / left[k][k];
        if !inverse.is_finite() {
            return None;
        }
        left[k] = left[k].map(|x| x * inverse);
        right[k] = right[k].map(|x| x * inverse);
        for i in (0..4).filter(|&i| i != k) {
            let factor = left[i][k];
            for j in 0..4 {
                left[i][j] -= factor * left[k][j];
                right[i][j] -= factor * right[k][j];
            }
        }
    }
    Some(right)
}

/// Whether there is a cross-cap near a place inside an area: where, then.
fn proven(form: &Form, area: [[f64; 2]; 2], at: [f64; 2], room: &mut Room) -> Option<[f64; 2]> {
    let point = form.homogeneous_on(at.map(|x| [x; 2]), room);
    let is_turned = is_turned(&point.map(|row| row.map(Interval::middle)));
    let point = seen(point, is_turned);
    let middle = point.map(|row| row.map(Interval::middle));
    let turned = |[a, b]: [f64; 2]| if is_turned { [b, a] } else { [a, b] };
    let [l, a] = multipliers(&middle);
    let (_, rows) = equations(&middle, l, a);
    let inverse = inverted(rows)?;
    let [l_, a_] = [l, a].map(Interval::point);
    let value: [Interval; 4] =
        std::array::from_fn(|c| point[c][1] + l_ * point[c][2] + a_ * point[c][0]);
    let zero = Interval::point(0.0);
    // How far the solution is from the place, at least about.
    let moved: [Interval; 4] =
        std::array::from_fn(|i| (0..4).fold(zero, |sum, c| sum + value[c].times(inverse[i][c])));
    let size = |column: usize| (0..4).map(|c| rows[c][column].abs()).sum::<f64>();
    SHARES.iter().find_map(|share| {
        let [r, q] = turned([0, 1].map(|k| share * (at[k] - area[k][0]).min(area[k][1] - at[k])));
        let change = 4.0 * (size(0) * r + size(1) * q);
        let radii = [r, q, change / size(2), change / size(3)];
        let radii = [0, 1, 2, 3].map(|k| radii[k].max(4.0 * moved[k].magnitude()));
        let around = turned([radii[0], radii[1]]);
        let ends = [0, 1].map(|k| [at[k] - around[k], at[k] + around[k]]);
        let is_inside = (0..2).all(|k| area[k][0] < ends[k][0] && ends[k][1] < area[k][1]);
        if !is_inside {
            return None;
        }
        let x = seen(form.homogeneous_on(ends, room), is_turned);
        let (l, a) = (Interval::around(l, radii[2]), Interval::around(a, radii[3]));
        let matrix: [[Interval; 4]; 4] = std::array::from_fn(|c| {
            let [f, s, t, ss, st, tt] = x[c];
            [ss + l * st + a * s, st + l * tt + a * t, t, f]
        });
        let is_held = (0..4).all(|i| {
            let row: [Interval; 4] = std::array::from_fn(|j| {
                let product = (0..4).fold(zero, |sum, c| sum + matrix[c][j].times(inverse[i][c]));
                Interval::point(f64::from(u8::from(i == j))) - product
            });
            let spread = (0..4).fold(zero, |sum, j| sum + row[j] * Interval::around(0.0, radii[j]));
            (spread - moved[i]).magnitude() < radii[i]
        });
        is_held.then_some(at)
    })
}
