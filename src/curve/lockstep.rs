//! Points of a curve at many parameters, lane by lane: the bits of [`Curve::evaluate`].

use super::Curve;
use crate::basis::values_around;
use crate::knots::Knots;
use crate::simd::{Kernel, Lanes, Level, MOST_DEGREE, Row, Simd, WIDTH};

impl Curve {
    /// The points at [`WIDTH`] parameters in the domain, coordinate by coordinate; of degrees up to [`MOST_DEGREE`].
    pub(crate) fn evaluate_together(&self, at: &Row, level: Level) -> [Row; 3] {
        let spans = at.map(|u| self.knots.span(u));
        level.run(Evaluate { curve: self, spans: &spans, at })
    }
}

struct Evaluate<'a> {
    curve: &'a Curve,
    spans: &'a [usize; WIDTH],
    at: &'a Row,
}

impl Kernel for Evaluate<'_> {
    type Out = [Row; 3];

    #[inline(always)]
    fn run<S: Simd>(self, _: S) -> [Row; 3] {
        let Curve { knots, poles, weights, rational } = self.curve;
        let degree = knots.degree();
        let mut basis = [S::F8::splat(0.0); MOST_DEGREE + 1];
        let largest = lane_basis(knots, self.spans, self.at, &mut basis);
        let mut first = [0; WIDTH];
        for q in 0..WIDTH {
            first[q] = self.spans[q] - degree;
        }
        let reference = lane_poles::<S::F8>(poles, &first, &largest);
        let weights = weights.as_deref().filter(|_| *rational);
        let mut sum = [S::F8::splat(0.0); 4];
        for j in 0..=degree {
            add_lanes(&mut sum, basis[j], (poles, weights), &first, j, reference);
        }
        lane_points(reference, sum, *rational)
    }
}

/// The basis functions of each lane at its parameter, and which of them is the largest, the first of equals.
#[inline(always)]
pub(crate) fn lane_basis<V: Lanes<WIDTH>>(
    knots: &Knots,
    spans: &[usize; WIDTH],
    at: &Row,
    out: &mut [V; MOST_DEGREE + 1],
) -> [usize; WIDTH] {
    let (degree, values) = (knots.degree(), knots.values());
    let mut around = [V::splat(0.0); 2 * MOST_DEGREE];
    for r in 0..2 * degree {
        let mut row = [0.0; WIDTH];
        for q in 0..WIDTH {
            row[q] = values[spans[q] + 1 - degree + r];
        }
        around[r] = V::load(&row);
    }
    values_around(&around[..2 * degree], degree, V::load(at), &mut out[..=degree]);
    let (mut greatest, mut place) = (out[0], V::splat(0.0));
    for i in 1..=degree {
        place = V::splat(i as f64).where_less(greatest, out[i], place);
        greatest = out[i].where_less(greatest, out[i], greatest);
    }
    let (place, mut largest) = (place.array(), [0; WIDTH]);
    for q in 0..WIDTH {
        largest[q] = place[q] as usize;
    }
    largest
}

/// The pole `offset` after `first` of each lane.
#[inline(always)]
pub(crate) fn lane_poles<V: Lanes<WIDTH>>(
    poles: &[[f64; 3]],
    first: &[usize; WIDTH],
    offset: &[usize; WIDTH],
) -> [V; 3] {
    let mut rows = [[0.0; WIDTH]; 3];
    for q in 0..WIDTH {
        let pole = poles[first[q] + offset[q]];
        for axis in 0..3 {
            rows[axis][q] = pole[axis];
        }
    }
    [V::load(&rows[0]), V::load(&rows[1]), V::load(&rows[2])]
}

/// As [`add_scaled`](super::add_scaled), for the pole `offset` after `first` of each lane.
#[inline(always)]
pub(crate) fn add_lanes<V: Lanes<WIDTH>>(
    sum: &mut [V; 4],
    factor: V,
    (poles, weights): (&[[f64; 3]], Option<&[f64]>),
    first: &[usize; WIDTH],
    offset: usize,
    reference: [V; 3],
) {
    let mut factor = factor;
    if let Some(weights) = weights {
        let mut row = [0.0; WIDTH];
        for q in 0..WIDTH {
            row[q] = weights[first[q] + offset];
        }
        factor = factor * V::load(&row);
    }
    let pole = lane_poles::<V>(poles, first, &[offset; WIDTH]);
    for axis in 0..3 {
        sum[axis] = sum[axis] + factor * (pole[axis] - reference[axis]);
    }
    sum[3] = sum[3] + factor;
}

/// The points of the lanes from their sums.
#[inline(always)]
pub(crate) fn lane_points<V: Lanes<WIDTH>>(
    reference: [V; 3],
    sum: [V; 4],
    rational: bool,
) -> [Row; 3] {
    let divisor = if rational { sum[3] } else { V::splat(1.0) };
    let mut points = [[0.0; WIDTH]; 3];
    for axis in 0..3 {
        (sum[axis] / divisor + reference[axis]).store(&mut points[axis]);
    }
    points
}
