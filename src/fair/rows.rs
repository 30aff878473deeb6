//! Rows of derivatives, jumps and refinements, and the energies made of them.

use super::cells::{Cell, Functional, condense};
use crate::basis;
use crate::bounds::{HALF_ULP, Vector, dot, scaled, sub};
use crate::curve::insertion::{copy_of, filled};
use crate::curve::{Curve, binomial};
use crate::error::Error;
use crate::knots::{Knots, Side};
use crate::portable::SameDigits;
use crate::surface::Surface;

/// Derivatives 0 to `count` of the rational basis functions at `u`: first pole, and `degree + 1` numbers an order.
pub fn curve_rows(curve: &Curve, u: f64, side: Side, count: usize) -> (usize, Vec<f64>) {
    let (knots, p) = (curve.knots(), curve.degree());
    let span = knots.span_on(u, side);
    let mut rows = vec![0.0; (count + 1) * (p + 1)];
    basis::derivatives(knots, span, u, count.min(p), &mut rows);
    let first = span - p;
    if let Some(weights) = curve.weights().filter(|_| curve.is_rational()) {
        for row in rows.chunks_exact_mut(p + 1) {
            row.iter_mut().zip(&weights[first..]).for_each(|(x, w)| *x *= w);
        }
        let sums: Vec<f64> = rows.chunks_exact(p + 1).map(|row| row.iter().sum()).collect();
        for k in 0..=count {
            for i in 0..=p {
                let lower: f64 =
                    (1..=k).map(|j| binomial(k, j) * sums[j] * rows[(k - j) * (p + 1) + i]).sum();
                rows[k * (p + 1) + i] = (rows[k * (p + 1) + i] - lower) / sums[0];
            }
        }
    }
    (first, rows)
}

/// Partial derivatives up to total order `count` of the rational basis functions at (u, v): pole indices, and a row for
/// each derivative in the order S; Su, Sv; Suu, Suv, Svv; ...
pub fn surface_rows(surface: &Surface, [u, v]: [f64; 2], count: usize) -> (Vec<usize>, Vec<f64>) {
    let (ku, kv) = (surface.knots_u(), surface.knots_v());
    let (p, q) = (ku.degree(), kv.degree());
    let spans = [ku.span(u), kv.span(v)];
    let (mut bu, mut bv) = (vec![0.0; (count + 1) * (p + 1)], vec![0.0; (count + 1) * (q + 1)]);
    basis::derivatives(ku, spans[0], u, count.min(p), &mut bu);
    basis::derivatives(kv, spans[1], v, count.min(q), &mut bv);
    let stride = kv.pole_count();
    let place = |i: usize, j: usize| (spans[0] - p + i) * stride + spans[1] - q + j;
    let poles: Vec<usize> =
        (0..(p + 1) * (q + 1)).map(|n| place(n / (q + 1), n % (q + 1))).collect();
    let width = poles.len();
    let at = |k: usize, l: usize| ((k + l) * (k + l + 1) / 2 + l) * width;
    let mut rows = vec![0.0; (count + 1) * (count + 2) / 2 * width];
    let weights = surface.weights().filter(|_| surface.is_rational());
    for order in 0..=count {
        for l in 0..=order {
            let k = order - l;
            let row = &mut rows[at(k, l)..][..width];
            for (n, x) in row.iter_mut().enumerate() {
                let (i, j) = (n / (q + 1), n % (q + 1));
                let weight = weights.map_or(1.0, |w| w[poles[n]]);
                *x = bu[k * (p + 1) + i] * bv[l * (q + 1) + j] * weight;
            }
        }
    }
    if weights.is_some() {
        divide(&mut rows, count, width, at);
    }
    (poles, rows)
}

/// Leibniz' rule, solved for the quotient by the sum of the functions.
fn divide(rows: &mut [f64], count: usize, width: usize, at: impl Fn(usize, usize) -> usize) {
    let sums: Vec<f64> = rows.chunks_exact(width).map(|row| row.iter().sum()).collect();
    for order in 0..=count {
        for l in 0..=order {
            let k = order - l;
            for n in 0..width {
                let mut value = rows[at(k, l) + n];
                for i in 0..=k {
                    for j in usize::from(i == 0)..=l {
                        let factor = binomial(k, i) * binomial(l, j) * sums[at(i, j) / width];
                        value -= factor * rows[at(k - i, l - j) + n];
                    }
                }
                rows[at(k, l) + n] = value / sums[0];
            }
        }
    }
}

/// Places and weights of Gauss' rule with `n` points on [0, 1].
///
/// Newton's iteration on Legendre's polynomials; exact up to degree `2 n - 1`.
pub fn gauss(n: usize) -> Vec<[f64; 2]> {
    let legendre = |x: f64| {
        let (mut before, mut here) = (1.0, x);
        for k in 2..=n {
            let k = k as f64;
            (before, here) = (here, ((2.0 * k - 1.0) * x * here - (k - 1.0) * before) / k);
        }
        (here, n as f64 * (x * here - before) / (x * x - 1.0))
    };
    let node = |i: usize| {
        let mut x = (std::f64::consts::PI * (i as f64 + 0.75) / (n as f64 + 0.5)).cosine();
        for _ in 0..50 {
            let (value, slope) = legendre(x);
            x -= value / slope;
            if (value / slope).abs() <= 4.0 * HALF_ULP {
                break;
            }
        }
        let slope = legendre(x).1;
        [0.5 * (1.0 - x), 1.0 / ((1.0 - x * x) * slope * slope)]
    };
    if n == 1 { vec![[0.5, 1.0]] } else { (0..n).map(node).collect() }
}

/// Quadrature of a shape in one direction: for each span, parameters and weights.
pub fn quadrature(knots: &Knots, rational: bool) -> impl Iterator<Item = Vec<[f64; 2]>> + '_ {
    let p = knots.degree();
    let rule = gauss(if rational { 2 * p + 2 } else { p + 1 });
    let t = knots.values();
    let span = move |i: usize| {
        let length = t[i + 1] - t[i];
        rule.iter().map(|[x, w]| [t[i] + x * length, w * length]).collect()
    };
    knots.spans().map(span)
}

/// The energy of a curve: `weights[k]` times the integral of the squared derivative of order k.
///
/// `by_length`: derivatives and integral by the arc length of the curve as it is now, not by the parameter.
///
/// # Errors
/// [`Error::OutOfMemory`].
pub fn curve_energy(
    curve: &Curve,
    weights: [f64; 4],
    by_length: bool,
) -> Result<Functional, Error> {
    let p = curve.degree();
    let mut energy = Functional::default();
    for span in quadrature(curve.knots(), curve.is_rational()) {
        let (mut poles, mut scaled) = (0..0, Vec::new());
        for [u, weight] in span {
            let (first, mut rows) = curve_rows(curve, u, Side::Above, 3);
            poles = first..first + p + 1;
            let mut measure = weight;
            if by_length {
                let own: Vec<usize> = poles.clone().collect();
                let cell = Cell { poles: &own, rows: &[] };
                let Some(speed) = to_arc_length(cell, &mut rows, curve.poles()) else { continue };
                measure *= speed;
            }
            for (row, w) in rows.chunks_exact(p + 1).zip(weights) {
                if w > 0.0 {
                    let root = (w * measure).sqrt();
                    scaled.extend(row.iter().map(|x| root * x));
                }
            }
        }
        energy.push(poles, &scaled)?;
    }
    Ok(energy)
}

/// Turns rows of derivatives by the parameter into those by the arc length that the poles give; gives the speed, or nothing
/// where it vanishes.
pub fn to_arc_length(cell: Cell, rows: &mut [f64], poles: &[Vector]) -> Option<f64> {
    let n = cell.poles.len();
    let [d1, d2, d3] = [1, 2, 3].map(|k| cell.apply(&rows[k * n..(k + 1) * n], poles));
    let v = dot(d1, d1).sqrt();
    if v <= 0.0 || !v.is_finite() {
        return None;
    }
    let v1 = dot(d1, d2) / v;
    let v2 = (dot(d2, d2) + dot(d1, d3) - v1 * v1) / v;
    for i in 0..n {
        let [a, b, c] = [1, 2, 3].map(|k| rows[k * n + i]);
        rows[n + i] = a / v;
        rows[2 * n + i] = b / (v * v) - v1 * a / (v * v * v);
        let bent = (3.0 * v1 * v1 / v - v2) / v.powi(4);
        rows[3 * n + i] = c / v.powi(3) - 3.0 * v1 * b / v.powi(4) + bent * a;
    }
    Some(v)
}

/// The energy of a surface: the squared derivatives of orders 0, 2 and 3, with the weights of the thin plate (1, 2, 1) and of
/// its like of order 3 (1, 3, 3, 1).
///
/// # Errors
/// [`Error::OutOfMemory`].
pub fn surface_energy(surface: &Surface, weights: [f64; 4]) -> Result<Functional, Error> {
    let rational = surface.is_rational();
    let mut energy = Functional::default();
    for us in quadrature(surface.knots_u(), rational) {
        for vs in quadrature(surface.knots_v(), rational) {
            let (mut own, mut scaled) = (Vec::new(), Vec::new());
            for [u, wu] in &us {
                for [v, wv] in &vs {
                    let (poles, rows) = surface_rows(surface, [*u, *v], 3);
                    let width = poles.len();
                    own = poles;
                    for (order, weight) in weights.into_iter().enumerate() {
                        for l in 0..=order {
                            let factor = weight * binomial(order, l) * wu * wv;
                            let at = (order * (order + 1) / 2 + l) * width;
                            if factor > 0.0 {
                                let root = factor.sqrt();
                                scaled.extend(rows[at..at + width].iter().map(|x| root * x));
                            }
                        }
                    }
                }
            }
            let left = condense(&mut scaled, own.len());
            energy.push(own.into_iter(), &scaled[..left])?;
        }
    }
    Ok(energy)
}

/// The jump of the first derivative that is not continuous, at each inner knot: the knots, and for each a cell with the row.
///
/// # Errors
/// [`Error::OutOfMemory`].
pub fn jumps(curve: &Curve) -> Result<(Vec<f64>, Functional), Error> {
    let (knots, p) = (curve.knots(), curve.degree());
    let (start, end) = knots.domain();
    let mut inner = copy_of(knots.values())?;
    inner.retain(|u| start < *u && *u < end);
    inner.dedup();
    let mut jumps = Functional::default();
    for &u in &inner {
        let order = (p + 1).saturating_sub(knots.multiplicity(u)).max(1);
        let (low, below) = curve_rows(curve, u, Side::Below, order);
        let (high, above) = curve_rows(curve, u, Side::Above, order);
        let mut row = vec![0.0; high + p + 1 - low];
        for i in 0..=p {
            row[high - low + i] += above[order * (p + 1) + i];
            row[i] -= below[order * (p + 1) + i];
        }
        jumps.push(low..high + p + 1, &row)?;
    }
    Ok((inner, jumps))
}

/// Rows of the jumps of a polynomial spline with these knots and one pole a knot, as [`jumps`]: for knot lines.
///
/// # Errors
/// [`Error::OutOfMemory`].
pub fn knot_jumps(knots: &Knots) -> Result<Functional, Error> {
    let zero = filled(knots.pole_count(), [0.0; 3])?;
    let line = Curve::from_parts(knots.clone(), zero.into(), None);
    Ok(jumps(&line)?.1)
}

/// The poles over more knots as combinations of those over the given ones: for each the first pole and `degree + 1` numbers. None for
/// knots that are not clamped.
///
/// Reference: Cohen, Lyche, Riesenfeld, *Discrete B-splines and subdivision techniques in computer-aided geometric design and
/// computer graphics*, 1980.
pub fn refinement(knots: &Knots, inserted: &[f64]) -> Option<Vec<(usize, Vec<f64>)>> {
    let (t, p, n) = (knots.values(), knots.degree(), knots.pole_count());
    let (start, end) = knots.domain();
    if knots.multiplicity(start) <= p || knots.multiplicity(end) <= p {
        return None;
    }
    let mut fine: Vec<f64> = t.iter().chain(inserted).copied().collect();
    fine.sort_by(f64::total_cmp);
    let mut span = p;
    let row = |k: usize| {
        while span + 1 < n && t[span + 1] <= fine[k] {
            span += 1;
        }
        let mut row = vec![0.0; p + 1];
        row[p] = 1.0;
        for r in 1..=p {
            let x = fine[k + r];
            // Entry j stands for pole span - p + j; those from p - r on are there.
            for j in p - r..=p {
                let i = span + j - p;
                let rising = if j > p - r { row[j] * (x - t[i]) / (t[i + r] - t[i]) } else { 0.0 };
                let falling = if j < p {
                    row[j + 1] * (t[i + r + 1] - x) / (t[i + r + 1] - t[i + 1])
                } else {
                    0.0
                };
                row[j] = rising + falling;
            }
        }
        (span - p, row)
    };
    Some((0..fine.len() - p - 1).map(row).collect())
}

/// Greatest length of `new - old`: with the same knots and weights no point moves farther. Rounded up.
pub fn hull_deviation(new: &[Vector], old: &[Vector]) -> f64 {
    let length = |a: &Vector, b: &Vector| {
        let d = sub(*a, *b);
        let size = d.iter().fold(0.0f64, |m, x| m.max(x.abs()));
        if d == [0.0; 3] {
            0.0
        } else {
            size * dot(scaled(d, 1.0 / size), scaled(d, 1.0 / size)).sqrt()
        }
    };
    // What is no number may be anywhere.
    let greater = |m: f64, x: f64| if x.is_nan() { f64::INFINITY } else { m.max(x) };
    let most = new.iter().zip(old).map(|(a, b)| length(a, b)).fold(0.0, greater);
    most * (1.0 + 16.0 * HALF_ULP)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gauss_integrates_polynomials_exactly() {
        for n in 1..=20 {
            let rule = gauss(n);
            for degree in 0..2 * n {
                let sum: f64 = rule.iter().map(|[x, w]| w * x.powi(degree as i32)).sum();
                assert!((sum - 1.0 / (degree + 1) as f64).abs() < 1e-14, "{n} {degree} {sum}");
            }
        }
    }

    #[test]
    fn refined_poles_are_those_of_inserted_knots() {
        let knots = [0., 0., 0., 0., 1., 2., 2., 4., 4., 4., 4.];
        let poles: Vec<Vector> = (0..7).map(|i| [i as f64, (i * i % 5) as f64, 1.0]).collect();
        let curve = Curve::new(&knots, 3, &poles, None).unwrap();
        let inserted = [0.25, 0.5, 0.75, 1.5, 3.0, 3.5];
        let fine = curve.refine(&inserted).unwrap();
        let rows = refinement(curve.knots(), &inserted).unwrap();
        assert_eq!(rows.len(), fine.poles().len());
        for ((first, row), pole) in rows.iter().zip(fine.poles()) {
            let own: Vec<usize> = (*first..first + 4).collect();
            let cell = Cell { poles: &own, rows: &[] };
            let gap = sub(cell.apply(row, &poles), *pole);
            assert!(dot(gap, gap).sqrt() < 1e-14, "{first} {row:?} {pole:?}");
        }
    }

    #[test]
    fn rows_applied_to_the_poles_are_the_derivatives() {
        let knots = [0., 0., 0., 0., 1., 2., 2., 4., 4., 4., 4.];
        let poles: Vec<Vector> = (0..7).map(|i| [i as f64, (i * i % 5) as f64, 1.0]).collect();
        let weights = [1.0, 2.0, 0.5, 1.5, 1.0, 3.0, 1.0];
        let curve = Curve::new(&knots, 3, &poles, Some(&weights)).unwrap();
        for u in [0.0, 0.7, 2.5, 4.0] {
            let (first, rows) = curve_rows(&curve, u, Side::Above, 3);
            let mut out = [[0.0; 3]; 4];
            curve.derivatives(u, 3, &mut out);
            let own: Vec<usize> = (first..first + 4).collect();
            let cell = Cell { poles: &own, rows: &[] };
            for k in 0..4 {
                let d = sub(cell.apply(&rows[4 * k..4 * k + 4], &poles), out[k]);
                assert!(dot(d, d).sqrt() < 1e-10, "{u} {k} {d:?}");
            }
        }
    }

    #[test]
    fn a_knot_that_was_inserted_has_no_jump() {
        let knots = [0., 0., 0., 0., 1., 3., 3., 3., 3.];
        let poles: Vec<Vector> = (0..5).map(|i| [i as f64, (i * i % 3) as f64, 0.5]).collect();
        let curve = Curve::new(&knots, 3, &poles, None).unwrap().insert_knot(2.0, 1).unwrap();
        let (knots, jumps) = jumps(&curve).unwrap();
        for (u, cell) in knots.into_iter().zip(jumps.cells()) {
            let jump = cell.apply(cell.rows, curve.poles());
            let size = dot(jump, jump).sqrt();
            assert!(if u == 2.0 { size < 1e-12 } else { size > 0.1 }, "{u} {size}");
        }
    }
}
