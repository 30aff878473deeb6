//! The slope of the curvature: how fast the curvature vector of a curve changes along it, in its own normal plane.
//!
//! ```text
//!   r = N (C''' - 3 (C' . C'') / |C'|^2 C'') / |C'|^3      N: the part normal to C'
//!   energy = integral of |r|^2 over the arc length         = (dk/ds)^2 of planar curves, (dk/ds)^2 + k^2 tau^2 in space
//! ```
//!
//! Nothing is taken as constant: lengths are those of the curve as it is, not as it was. The energy is no square of linear forms;
//! its gradient is exact; its matrix is that of Gauss and Newton, which couples the coordinates. It does not see a curve sliding along
//! itself: a share of the third derivatives by the arc length that the curve has now holds it.
//!
//! Reference: Moreton, Séquin, *Functional optimization for fair surface design*, 1992: curves of least variation of curvature.

use super::cells::{Cell, Functional};
use super::rows::{curve_rows, quadrature, to_arc_length};
use crate::bounds::{Vector, add, cross, dot, scaled, sub};
use crate::curve::Curve;
use crate::curve::insertion::append;
use crate::error::Error;
use crate::knots::Side;

/// Cross products below this share of their factors have no side.
const NO_SIDE: f64 = 1e-9;

/// The integral as quadrature points.
pub struct Slope {
    /// Rows of the derivatives 0 to 3 at the places.
    places: Functional,
    /// What each place counts.
    shares: Vec<f64>,
    weight: f64,
    /// Squared speeds at the places, of the curve as it was.
    speeds: Vec<f64>,
}

/// Least share of its speed that a curve keeps at each place: sliding along itself would hide bends between two places.
const LEAST_SPEED: f64 = 0.3;

/// The integrand over the parameter and its gradient by the three derivatives.
fn integrand([d1, d2, d3]: [Vector; 3]) -> Option<(f64, [Vector; 3])> {
    let q = dot(d1, d1);
    if q <= 0.0 || !q.is_finite() {
        return None;
    }
    let bend = dot(d1, d2);
    let part = bend / q;
    let z = sub(d3, scaled(d2, 3.0 * part));
    let (y, zz) = (dot(d1, z), dot(z, z));
    let (root, square) = (q.sqrt(), q * q);
    let fifth = 1.0 / (square * root);
    // Not the difference of the squares, which leaves their rounding.
    let across = sub(z, scaled(d1, y / q));
    let value = dot(across, across) * fifth;
    let by_z = sub(scaled(z, 2.0 * fifth), scaled(d1, 2.0 * y * fifth / q));
    let through = -3.0 * dot(d2, by_z);
    let by_2 = add(scaled(by_z, -3.0 * part), scaled(d1, through / q));
    let own = (7.0 * y * y / q - 5.0 * zz) * fifth / q;
    let by_1 = add(scaled(z, -2.0 * y * fifth / q), scaled(d1, own));
    let by_1 = add(by_1, scaled(d2, through / q));
    let by_1 = sub(by_1, scaled(d1, 2.0 * through * bend / square));
    Some((value, [by_1, by_2, by_z]))
}

/// Derivatives of the vector whose square is the integrand, N (C''' - 3 part C'') / |C'|^(5/2), by the three derivatives: row i of
/// each is that of its component i.
fn residual_by([d1, d2, d3]: [Vector; 3]) -> Option<[[Vector; 3]; 3]> {
    let q = dot(d1, d1);
    if q <= 0.0 || !q.is_finite() {
        return None;
    }
    let scale = 1.0 / (q * q.sqrt().sqrt());
    let part = dot(d1, d2) / q;
    let z = sub(d3, scaled(d2, 3.0 * part));
    let y = dot(d1, z);
    let across = |x: Vector| sub(x, scaled(d1, dot(d1, x) / q));
    let (second, whole) = (across(d2), across(z));
    let part_by_1 = scaled(sub(d2, scaled(d1, 2.0 * part)), 1.0 / q);
    let mut by = [[[0.0; 3]; 3]; 3];
    for i in 0..3 {
        for j in 0..3 {
            let same = f64::from(u8::from(i == j));
            let normal = same - d1[i] * d1[j] / q;
            let turned = 2.0 * y * d1[i] * d1[j] / (q * q) - (same * y + d1[i] * z[j]) / q;
            let own = turned - 3.0 * second[i] * part_by_1[j] - 2.5 * whole[i] * d1[j] / q;
            by[0][i][j] = scale * own;
            by[1][i][j] = scale * (-3.0 * part * normal - 3.0 * second[i] * d1[j] / q);
            by[2][i][j] = scale * normal;
        }
    }
    Some(by)
}

fn derivatives(place: Cell, poles: &[Vector]) -> [Vector; 3] {
    [1, 2, 3].map(|k| place.apply(place.row(k), poles))
}

impl Slope {
    /// `weight` times the integral for the knots and weights of `curve`.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn new(curve: &Curve, weight: f64) -> Result<Self, Error> {
        let p = curve.degree();
        let t = curve.knots().values();
        let mut slope =
            Self { places: Functional::default(), shares: Vec::new(), weight, speeds: Vec::new() };
        for (span, i) in quadrature(curve.knots(), true).zip(curve.knots().spans()) {
            let (start, length) = (t[i], t[i + 1] - t[i]);
            // Twice, on both halves. Ends of spans have a say in where the curve bends to, but no share of the energy.
            let halved =
                |[u, w]: [f64; 2], from: f64| [start + from * length + 0.5 * (u - start), 0.5 * w];
            let mut dense = vec![[start + 0.002 * length, 0.0]];
            dense.extend(span.iter().map(|&place| halved(place, 0.0)));
            dense.extend(span.iter().map(|&place| halved(place, 0.5)));
            dense.push([start + 0.998 * length, 0.0]);
            dense.sort_by(|a, b| a[0].total_cmp(&b[0]));
            for [u, share] in dense {
                let (first, rows) = curve_rows(curve, u, Side::Above, 3);
                slope.places.push(first..first + p + 1, &rows)?;
                append(&mut slope.shares, share)?;
                let place = slope.places.cell(slope.places.len() - 1);
                let [d1, ..] = derivatives(place, curve.poles());
                append(&mut slope.speeds, dot(d1, d1))?;
            }
        }
        Ok(slope)
    }

    /// The places: their poles meet in the model.
    pub fn places(&self) -> &Functional {
        &self.places
    }

    fn counted(&self) -> impl Iterator<Item = (Cell<'_>, f64)> {
        self.places.cells().zip(self.shares.iter().copied()).filter(|place| place.1 > 0.0)
    }

    /// Whether the curve is nowhere much slower than it was.
    pub fn is_regular(&self, poles: &[Vector]) -> bool {
        self.places.cells().zip(&self.speeds).all(|(place, speed)| {
            let [d1, ..] = derivatives(place, poles);
            dot(d1, d1) >= LEAST_SPEED * LEAST_SPEED * speed
        })
    }

    /// The energy.
    pub fn value(&self, poles: &[Vector]) -> f64 {
        let value = |(place, share): (Cell, f64)| {
            let found = integrand(derivatives(place, poles));
            found.map_or(f64::INFINITY, |(value, _)| share * value)
        };
        self.weight * self.counted().map(value).sum::<f64>()
    }

    /// Adds half its gradient.
    pub fn add_gradient(&self, poles: &[Vector], gradient: &mut [Vector]) {
        for (place, share) in self.counted() {
            let Some((_, by)) = integrand(derivatives(place, poles)) else { continue };
            for (a, &i) in place.poles.iter().enumerate() {
                for (k, by) in by.iter().enumerate() {
                    let row = 0.5 * self.weight * share * place.row(k + 1)[a];
                    gradient[i] = add(gradient[i], scaled(*by, row));
                }
            }
        }
    }

    /// Squares that stand for the energy near these poles (Gauss, Newton), over coordinates: 3 i + k is coordinate k of pole i.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn near(&self, poles: &[Vector]) -> Result<Functional, Error> {
        let mut near = Functional::default();
        for (place, share) in self.counted() {
            let Some(by) = residual_by(derivatives(place, poles)) else { continue };
            let n = place.poles.len();
            let root = (self.weight * share).sqrt();
            let mut rows = vec![0.0; 9 * n];
            for (i, row) in rows.chunks_exact_mut(3 * n).enumerate() {
                for a in 0..n {
                    for j in 0..3 {
                        row[3 * a + j] =
                            (0..3).map(|k| root * by[k][i][j] * place.row(k + 1)[a]).sum();
                    }
                }
            }
            near.push(place.poles.iter().flat_map(|&i| [3 * i, 3 * i + 1, 3 * i + 2]), &rows)?;
        }
        Ok(near)
    }

    /// Squares of third derivatives by the arc length that the curve has with these poles, over the poles.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn model(&self, poles: &[Vector]) -> Result<Functional, Error> {
        let mut model = Functional::default();
        for (place, share) in self.counted() {
            let mut rows = place.rows.to_vec();
            if let Some(speed) = to_arc_length(place, &mut rows, poles) {
                let root = (self.weight * share * speed).sqrt();
                let third = &mut rows[3 * place.poles.len()..];
                third.iter_mut().for_each(|x| *x *= root);
                model.push(place.poles.iter().copied(), third)?;
            }
        }
        Ok(model)
    }

    /// How often the curve, seen along `normal`, changes the side to which it bends, as the quadrature points see it.
    pub fn turns(&self, poles: &[Vector], normal: Vector) -> usize {
        let (mut turns, mut before) = (0, 0.0);
        for place in self.places.cells() {
            let [d1, d2, _] = derivatives(place, poles);
            let side = dot(cross(d1, d2), normal);
            if side * side <= NO_SIDE * NO_SIDE * dot(d1, d1) * dot(d2, d2) {
                continue;
            }
            turns += usize::from(side * before < 0.0);
            before = side;
        }
        turns
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_gradient_is_that_of_the_energy() {
        let knots = [0., 0., 0., 0., 1., 2., 2., 4., 4., 4., 4.];
        let mut poles: Vec<Vector> =
            (0..7).map(|i| [i as f64, (i * i % 5) as f64, 0.3 * (i % 3) as f64]).collect();
        let weights = [1.0, 2.0, 0.5, 1.5, 1.0, 3.0, 1.0];
        let curve = Curve::new(&knots, 3, &poles, Some(&weights)).unwrap();
        let slope = Slope::new(&curve, 0.7).unwrap();
        let mut gradient = [[0.0; 3]; 7];
        slope.add_gradient(&poles, &mut gradient);
        for i in 0..7 {
            for k in 0..3 {
                let (here, step) = (poles[i][k], 1e-5);
                poles[i][k] = here + step;
                let above = slope.value(&poles);
                poles[i][k] = here - step;
                let below = slope.value(&poles);
                poles[i][k] = here;
                let wanted = (above - below) / (4.0 * step);
                let gap = (gradient[i][k] - wanted).abs();
                assert!(gap <= 1e-6 * (1.0 + wanted.abs()), "{i} {k} {} {wanted}", gradient[i][k]);
            }
        }
    }

    #[test]
    fn the_squares_near_a_circle_are_those_of_the_energy() {
        // Where the energy vanishes they are its second derivative.
        let half = 0.5f64.sqrt();
        let poles = [[1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
        let knots = [0., 0., 0., 1., 1., 1.];
        let curve = Curve::new(&knots, 2, &poles, Some(&[1.0, half, 1.0])).unwrap();
        let slope = Slope::new(&curve, 1.0).unwrap();
        let near = slope.near(&poles).unwrap();
        for way in [[0.3, -0.1, 0.2], [-0.7, 0.4, 0.1], [0.2, 0.9, -0.5]] {
            let step = 1e-4;
            let mut moved = poles;
            (0..3).for_each(|i| moved[i] = add(poles[i], scaled(way, step * (i * i) as f64)));
            let square = |cell: Cell| -> f64 {
                let at = |i: usize| (moved[i / 3][i % 3] - poles[i / 3][i % 3]) / step;
                cell.each()
                    .map(|row| row.iter().zip(cell.poles).map(|(x, &i)| x * at(i)).sum::<f64>())
                    .map(|x| x * x)
                    .sum()
            };
            let (wanted, found) =
                (slope.value(&moved) / (step * step), near.cells().map(square).sum::<f64>());
            assert!((wanted - found).abs() < 1e-2 * wanted, "{wanted} {found}");
        }
    }

    #[test]
    fn a_circle_has_none_whatever_its_parameters() {
        let half = 0.5f64.sqrt();
        let poles = [[1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
        let knots = [0., 0., 0., 1., 1., 1.];
        let curve = Curve::new(&knots, 2, &poles, Some(&[1.0, half, 1.0])).unwrap();
        let value = Slope::new(&curve, 1.0).unwrap().value(&poles);
        assert!(value < 1e-20, "{value}");
        let curve = Curve::new(&knots, 2, &poles, None).unwrap();
        assert!(Slope::new(&curve, 1.0).unwrap().value(&poles) > 1e-3);
    }
}
