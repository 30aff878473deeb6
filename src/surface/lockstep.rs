//! Points of a surface at many parameters, lane by lane: the bits of [`Surface::evaluate`].

use super::Surface;
use crate::curve::{add_lanes, lane_basis, lane_points, lane_poles};
use crate::simd::{Kernel, Lanes, Level, MOST_DEGREE, Row, Simd, WIDTH};

impl Surface {
    /// The points at [`WIDTH`] pairs of parameters in the domain, coordinate by coordinate; of degrees up to
    /// [`MOST_DEGREE`].
    pub(crate) fn evaluate_together(&self, at: &[Row; 2], level: Level) -> [Row; 3] {
        let spans = [at[0].map(|u| self.knots_u.span(u)), at[1].map(|v| self.knots_v.span(v))];
        level.run(Evaluate { surface: self, spans: &spans, at })
    }
}

struct Evaluate<'a> {
    surface: &'a Surface,
    spans: &'a [[usize; WIDTH]; 2],
    at: &'a [Row; 2],
}

impl Kernel for Evaluate<'_> {
    type Out = [Row; 3];

    #[inline(always)]
    fn run<S: Simd>(self, _: S) -> [Row; 3] {
        let Surface { knots_u, knots_v, poles, weights, rational } = self.surface;
        let (p, q, columns) = (knots_u.degree(), knots_v.degree(), knots_v.pole_count());
        let mut basis_u = [S::F8::splat(0.0); MOST_DEGREE + 1];
        let mut basis_v = [S::F8::splat(0.0); MOST_DEGREE + 1];
        let [spans_u, spans_v] = self.spans;
        let largest_u = lane_basis(knots_u, spans_u, &self.at[0], &mut basis_u);
        let largest_v = lane_basis(knots_v, spans_v, &self.at[1], &mut basis_v);
        let (mut first, mut largest) = ([0; WIDTH], [0; WIDTH]);
        for k in 0..WIDTH {
            first[k] = (spans_u[k] - p) * columns + spans_v[k] - q;
            largest[k] = largest_u[k] * columns + largest_v[k];
        }
        let reference = lane_poles::<S::F8>(poles, &first, &largest);
        let weights = weights.as_deref().filter(|_| *rational);
        let zero = [S::F8::splat(0.0); 4];
        let mut sum = zero;
        for i in 0..=p {
            let mut row = zero;
            for j in 0..=q {
                let offset = i * columns + j;
                add_lanes(&mut row, basis_v[j], (poles, weights), &first, offset, reference);
            }
            for axis in 0..4 {
                sum[axis] = sum[axis] + basis_u[i] * row[axis];
            }
        }
        lane_points(reference, sum, *rational)
    }
}
