//! One sector: the corner between two parameter directions, its normal and its angle, also where derivatives vanish.
//!
//! In local parameters (a, b), both growing into the sector and 1 at the far side of the span,
//!
//! ```text
//!   S = sum c_kl a^k b^l        Sa x Sb along (a t, b t) = N0 + N1 t + N2 t^2 + ...
//! ```
//!
//! The first N that is not rounding gives the direction of the normal's limit along (a, b).

use super::fan::{Fan, angle, differ, unit};
use crate::bounds::{Vector, add, cross, norm, scaled, sub};
use crate::knots::{Knots, Side};
use crate::surface::Surface;

/// Derivatives looked at.
const ORDER: usize = 5;
const COUNT: usize = (ORDER + 1) * (ORDER + 2) / 2;

/// Derivatives shorter than this share of the local net vanish.
const LEAST_SPEED: f64 = 1e-10;

/// A sine of the angle between two derivatives below this: they are parallel.
const LEAST_SINE: f64 = 1e-9;

/// Directions into the sector that must agree about the limit.
const DIRECTIONS: [[f64; 2]; 3] = [[1.0, 1.0], [1.0, 0.25], [0.25, 1.0]];

/// Steps over the directions of a sector without a normal, and the least angle between two that counts.
const CONE: u32 = 16;
const LEAST_CONE: f64 = 1e-9;

/// The step into the sector, in spans, where no derivative tells.
const STEP: f64 = 1.0 / 1024.0;

/// A sector of a surface at a place.
pub struct Corner<'a> {
    surface: &'a Surface,
    at: [f64; 2],
    sides: [Side; 2],
    /// Lengths of the span, negative where the sector lies below.
    steps: [f64; 2],
    /// Greatest distance between poles of the local net, from its first one.
    size: f64,
}

/// Length of the span at `x` on a side, negative below.
pub fn step(knots: &Knots, (x, side): (f64, Side)) -> f64 {
    let span = knots.span_on(x, side);
    let length = knots.values()[span + 1] - knots.values()[span];
    if side == Side::Below { -length } else { length }
}

impl<'a> Corner<'a> {
    /// The sector on the given side of each parameter.
    pub fn new(surface: &'a Surface, u: (f64, Side), v: (f64, Side)) -> Self {
        let (knots_u, knots_v) = (surface.knots_u(), surface.knots_v());
        let (last_u, last_v) = (knots_u.span_on(u.0, u.1), knots_v.span_on(v.0, v.1));
        let (first_u, first_v) = (last_u - knots_u.degree(), last_v - knots_v.degree());
        let stride = knots_v.pole_count();
        let first = surface.poles()[first_u * stride + first_v];
        let rows = (first_u..=last_u).map(|i| i * stride);
        let nets = rows.flat_map(|row| &surface.poles()[row + first_v..=row + last_v]);
        let size = nets.fold(0.0, |most: f64, pole| most.max(norm(sub(*pole, first))));
        Self {
            surface,
            at: [u.0, v.0],
            sides: [u.1, v.1],
            steps: [step(knots_u, u), step(knots_v, v)],
            size,
        }
    }

    /// Unit normal and angle from the first derivatives, when they give both.
    pub fn regular(&self) -> Option<(Vector, f64)> {
        let mut out = [[0.0; 3]; 3];
        self.surface.partials_on(self.at, self.sides, 1, &mut out);
        let (a, b) = (scaled(out[1], self.steps[0]), scaled(out[2], self.steps[1]));
        let (size_a, size_b, normal) = (norm(a), norm(b), cross(a, b));
        let area = norm(normal);
        let long = area > LEAST_SPEED * self.size * (size_a + size_b);
        if !(long && area > LEAST_SINE * size_a * size_b) {
            return None;
        }
        Some((self.outward(unit(normal)?), angle(unit(a)?, unit(b)?)))
    }

    /// A normal of the local parameters as one of the surface's.
    fn outward(&self, normal: Vector) -> Vector {
        if (self.steps[0] < 0.0) == (self.steps[1] < 0.0) { normal } else { scaled(normal, -1.0) }
    }

    /// The unit normal, as a limit from inside the sector when the derivatives do not give it.
    pub fn limit_normal(&self) -> Option<Vector> {
        if let Some((normal, _)) = self.regular() {
            return Some(normal);
        }
        let taylor = self.taylor();
        let along =
            |direction| self.first_term(&taylor, direction).or_else(|| self.step_inside(direction));
        let [a, b, c] = DIRECTIONS.map(along);
        let (a, b, c) = (a?, b?, c?);
        (!differ(a, b) && !differ(a, c)).then_some(a)
    }

    /// The angle of the sector; a right one when a side has no tangent.
    pub fn limit_angle(&self) -> f64 {
        let taylor = self.taylor();
        let tangents = [0, 1].map(|k| self.tangent_of(&taylor, k));
        match tangents {
            [Some(a), Some(b)] => angle(a, b),
            _ => std::f64::consts::FRAC_PI_2,
        }
    }

    /// The unit tangent into the sector along direction `k`: the first derivative that does not vanish.
    pub fn tangent(&self, k: usize) -> Option<Vector> {
        self.tangent_of(&self.taylor(), k)
    }

    fn tangent_of(&self, taylor: &[Vector; COUNT], k: usize) -> Option<Vector> {
        self.tangent_along(taylor, if k == 0 { [1.0, 0.0] } else { [0.0, 1.0] })
    }

    /// Adds the cone of the tangents that leave the place in all directions of the sector; false when there is none.
    ///
    /// Where every direction has another normal, this still is how the sector looks from very near.
    pub fn add_cone(&self, fan: &mut Fan) -> bool {
        let taylor = self.taylor();
        let (mut before, mut found): (Option<Vector>, bool) = (None, false);
        for k in 0..=CONE {
            let share = f64::from(k) / f64::from(CONE);
            let Some(tangent) = self.tangent_along(&taylor, [1.0 - share, share]) else { continue };
            if let Some((last, normal)) =
                before.and_then(|last| Some((last, unit(cross(last, tangent))?)))
            {
                let step = angle(last, tangent);
                if step > LEAST_CONE {
                    fan.add(self.outward(normal), step);
                    found = true;
                }
            }
            before = Some(tangent);
        }
        found
    }

    /// The unit tangent of the first term along `(a, b)` that is not rounding.
    fn tangent_along(&self, taylor: &[Vector; COUNT], [a, b]: [f64; 2]) -> Option<Vector> {
        let mut least = LEAST_SPEED * self.size;
        for order in 1..=ORDER {
            let term = (0..=order).fold([0.0; 3], |sum, l| {
                let share = power(a, order - l) * power(b, l);
                add(sum, scaled(taylor[place(order - l, l)], share))
            });
            if norm(term) > least {
                return unit(term);
            }
            least *= 4.0;
        }
        None
    }

    /// The Taylor coefficients in the local parameters.
    fn taylor(&self) -> [Vector; COUNT] {
        let mut out = [[0.0; 3]; COUNT];
        self.surface.partials_on(self.at, self.sides, ORDER, &mut out);
        let mut in_u = 1.0;
        for k in 0..=ORDER {
            let mut factor = in_u;
            for l in 0..=ORDER - k {
                out[place(k, l)] = scaled(out[place(k, l)], factor);
                factor *= self.steps[1] / (l + 1) as f64;
            }
            in_u *= self.steps[0] / (k + 1) as f64;
        }
        out
    }

    /// The unit vector of the first term of the normal along `(a, b)` that is not rounding.
    fn first_term(&self, taylor: &[Vector; COUNT], [a, b]: [f64; 2]) -> Option<Vector> {
        let (mut in_a, mut in_b) = ([[0.0; 3]; ORDER], [[0.0; 3]; ORDER]);
        for i in 0..ORDER {
            for l in 0..=i + 1 {
                let (k, term) = (i + 1 - l, taylor[place(i + 1 - l, l)]);
                if k > 0 {
                    let share = k as f64 * power(a, k - 1) * power(b, l);
                    in_a[i] = add(in_a[i], scaled(term, share));
                }
                if l > 0 {
                    let share = l as f64 * power(a, k) * power(b, l - 1);
                    in_b[i] = add(in_b[i], scaled(term, share));
                }
            }
        }
        let mut least = LEAST_SINE * self.size * self.size;
        for order in 0..ORDER {
            let term =
                (0..=order).fold([0.0; 3], |sum, i| add(sum, cross(in_a[i], in_b[order - i])));
            if norm(term) > least {
                return unit(term).map(|normal| self.outward(normal));
            }
            least *= 4.0;
        }
        None
    }

    /// The unit normal a small step inside the sector.
    fn step_inside(&self, direction: [f64; 2]) -> Option<Vector> {
        let at = [0, 1].map(|k| self.at[k] + STEP * direction[k] * self.steps[k]);
        let mut out = [[0.0; 3]; 3];
        self.surface.partials_on(at, self.sides, 1, &mut out);
        let (a, b) = (scaled(out[1], self.steps[0]), scaled(out[2], self.steps[1]));
        let normal = cross(a, b);
        let clear = norm(normal) > LEAST_SINE * norm(a) * norm(b) && norm(normal) > 0.0;
        if clear { unit(normal).map(|normal| self.outward(normal)) } else { None }
    }
}

/// Where the derivative `k` times by u and `l` times by v stands.
fn place(k: usize, l: usize) -> usize {
    (k + l) * (k + l + 1) / 2 + l
}

fn power(x: f64, n: usize) -> f64 {
    (0..n).fold(1.0, |product, _| product * x)
}

#[cfg(test)]
mod tests {
    use super::*;

    const LINE: [f64; 4] = [0.0, 0.0, 1.0, 1.0];
    const PARABOLA: [f64; 6] = [0.0, 0.0, 0.0, 1.0, 1.0, 1.0];

    #[test]
    fn an_edge_that_starts_slowly_has_the_normal_of_its_second_derivative() {
        // x = u^2, y = v.
        let poles =
            [[0., 0., 0.], [0., 1., 0.], [0., 0., 0.], [0., 1., 0.], [1., 0., 0.], [1., 1., 0.]];
        let surface = Surface::new(&PARABOLA, &LINE, 2, 1, &poles, 3, 2, None).unwrap();
        let corner = Corner::new(&surface, (0.0, Side::Above), (0.5, Side::Below));
        assert!(corner.regular().is_none());
        assert_eq!(corner.limit_normal(), Some([0.0, 0.0, 1.0]));
        assert!((corner.limit_angle() - std::f64::consts::FRAC_PI_2).abs() < 1e-15);
    }

    #[test]
    fn the_tip_of_an_umbrella_has_no_normal() {
        // (u v, u, v^2): parallel derivatives at the origin, from every direction another normal.
        let poles: Vec<Vector> = [0.0, 1.0]
            .into_iter()
            .flat_map(|u| [[0.0, u, 0.0], [0.5 * u, u, 0.0], [u, u, 1.0]])
            .collect();
        let surface = Surface::new(&LINE, &PARABOLA, 1, 2, &poles, 2, 3, None).unwrap();
        let corner = Corner::new(&surface, (0.0, Side::Above), (0.0, Side::Above));
        assert!(corner.regular().is_none() && corner.limit_normal().is_none());
        // Seen from very near it is the quarter plane between the axes of y and z.
        let mut fan = Fan::default();
        assert!(corner.add_cone(&mut fan));
        assert_eq!(fan.direction(), Some(([1.0, 0.0, 0.0], false)));
    }
}
