//! Partial derivatives of a surface, of any order.
//!
//! The derivative `d^(k+l) / du^k dv^l` stands at `n (n + 1) / 2 + l` with `n = k + l`:
//! S; Su, Sv; Suu, Suv, Svv; and so on. Rational surfaces are differentiated as numerator and weight,
//! and divided afterwards.
//!
//! Reference: Piegl, Tiller, *The NURBS Book*, 2nd ed., algorithms A3.6 and A4.4.

use super::{ORDER, Surface};
use crate::basis;
use crate::curve::binomial;
use crate::knots::Side;

/// Where the derivative `k` times by u and `l` times by v stands.
fn place(k: usize, l: usize) -> usize {
    (k + l) * (k + l + 1) / 2 + l
}

/// Room for the basis functions and the derivatives of the weight, in doubles each. The small one
/// holds the second derivatives of a bicubic patch and is cheap to clear.
struct Room<const SIZE: usize> {
    basis_u: [f64; SIZE],
    basis_v: [f64; SIZE],
    weights: [f64; SIZE],
}

impl<const SIZE: usize> Room<SIZE> {
    fn new() -> Self {
        Self { basis_u: [0.0; SIZE], basis_v: [0.0; SIZE], weights: [0.0; SIZE] }
    }
}

impl Surface {
    /// The partial derivatives at (u, v) to total order `count`, sided like [`Surface::evaluate`], into
    /// `out`: S; Su, Sv; Suu, Suv, Svv; ..., `(count + 1) (count + 2) / 2` vectors.
    ///
    /// `out[0]` has the same bits as `evaluate(u, v)`, whatever `count` is; `count` is at most 31.
    pub fn partials(&self, u: f64, v: f64, count: usize, out: &mut [[f64; 3]]) {
        self.partials_on([u, v], [Side::Above; 2], count, out);
    }

    /// As [`Surface::partials`], of the piece on one side of a knot line in either direction. Below a knot the point may
    /// differ from that of [`Surface::evaluate`] by rounding.
    pub fn partials_on(
        &self,
        [u, v]: [f64; 2],
        sides: [Side; 2],
        count: usize,
        out: &mut [[f64; 3]],
    ) {
        debug_assert!(self.knots_u.contains(u), "u = {u} is outside the domain");
        debug_assert!(self.knots_v.contains(v), "v = {v} is outside the domain");
        let out = &mut out[..(count + 1) * (count + 2) / 2];
        out.fill([0.0; 3]);
        let spans = [self.knots_u.span_on(u, sides[0]), self.knots_v.span_on(v, sides[1])];
        let widest = self.knots_u.degree().max(self.knots_v.degree()) + 1;
        if (count.min(widest - 1) + 1) * widest <= 24 {
            self.fill_partials(spans, [u, v], count, &mut Room::<24>::new(), out);
        } else {
            let room = &mut Room::<{ ORDER * ORDER }>::new();
            self.fill_partials(spans, [u, v], count, room, out);
        }
    }

    fn fill_partials<const SIZE: usize>(
        &self,
        spans: [usize; 2],
        [u, v]: [f64; 2],
        count: usize,
        room: &mut Room<SIZE>,
        out: &mut [[f64; 3]],
    ) {
        let (degree_u, degree_v) = (self.knots_u.degree(), self.knots_v.degree());
        let (most_u, most_v) = (count.min(degree_u), count.min(degree_v));
        basis::derivatives(&self.knots_u, spans[0], u, most_u, &mut room.basis_u);
        basis::derivatives(&self.knots_v, spans[1], v, most_v, &mut room.basis_v);
        let (basis_u, basis_v) = (&room.basis_u, &room.basis_v);
        let reference = self.reference(spans, &basis_u[..=degree_u], &basis_v[..=degree_v]);
        for i in 0..=degree_u {
            let start = self.row_start(spans, i);
            for (l, along) in basis_v.chunks_exact(degree_v + 1).take(most_v + 1).enumerate() {
                let row = self.row_sum(start, along, reference);
                for k in 0..=most_u.min(count - l) {
                    let n = basis_u[k * (degree_u + 1) + i];
                    let sum = &mut out[place(k, l)];
                    for axis in 0..3 {
                        sum[axis] += n * row[axis];
                    }
                    room.weights[k * (most_v + 1) + l] += n * row[3];
                }
            }
        }
        let [x, y, z] = out[0];
        if self.rational {
            divide_out(&room.weights, [most_u, most_v], count, out);
        }
        out[0] = self.position(reference, [x, y, z, room.weights[0]]);
    }
}

/// Turns derivatives of the numerator into derivatives of the quotient, in place.
///
/// Leibniz' rule for `A = w S`, solved for the derivative of S of the highest order. `weights` holds
/// the derivatives of `w` that can differ from zero, `most[1] + 1` in a row.
fn divide_out(weights: &[f64], most: [usize; 2], count: usize, out: &mut [[f64; 3]]) {
    for order in 0..=count {
        for l in 0..=order {
            let k = order - l;
            let mut value = out[place(k, l)];
            for i in 0..=k.min(most[0]) {
                for j in usize::from(i == 0)..=l.min(most[1]) {
                    let factor = binomial(k, i) * binomial(l, j) * weights[i * (most[1] + 1) + j];
                    let lower = out[place(k - i, l - j)];
                    for axis in 0..3 {
                        value[axis] -= factor * lower[axis];
                    }
                }
            }
            out[place(k, l)] = value.map(|x| x / weights[0]);
        }
    }
}
