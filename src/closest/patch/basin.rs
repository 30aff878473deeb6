//! The least point of an area in which `h` is convex.
//!
//! An iteration that follows steps of Newton's method crawls where the valley leaves the area aslant: whatever part of a step is
//! cut off at a side, the rest does not lead down. Here each step goes to the least point that the quadratic model has in the
//! area, sides and corners included, and none is taken that promises less than a share of the gap.

use super::super::certificate::{free_slope, slope_error, value_at};
use super::{Area, Jet2, Method, Site, Walk, dot, norm};

/// Steps after which the usual iteration goes on.
const MOST_STEPS: u32 = 12;

/// Share of the gap that a step must promise.
const LEAST_GAIN: f64 = 1.0 / 64.0;

impl Walk<'_, '_, '_> {
    /// Goes to the least point of a range in which the distance has one, near enough to tell whether it is below the target.
    pub(super) fn descend(&mut self, range: [f64; 4], start: [f64; 2]) -> ([f64; 2], Jet2) {
        if self.sheet.method != Method::Auto {
            return self.iterate(range, start);
        }
        let (net, query) = (self.sheet.net, self.sheet.query);
        let mut at = [0, 1].map(|k| start[k].clamp(range[2 * k], range[2 * k + 1]));
        let mut jet = net.jet(at[0], at[1], query);
        let mut taken = 1;
        loop {
            if let Some(watch) = &mut self.proof.trace {
                watch(taken - 1, Site { piece: self.sheet.piece, at }, norm(jet.d));
            }
            let room = [0, 1].map(|k| [range[2 * k] - at[k], range[2 * k + 1] - at[k]]);
            let model = least_in_box(jet.gradient(), jet.hessian(), room);
            let Some((step, gain)) = model.filter(|_| taken < MOST_STEPS) else {
                self.proof.iterated(taken);
                return self.iterate(range, at);
            };
            // The model is that of half the squared distance.
            if gain <= LEAST_GAIN * self.proof.gap * norm(jet.d) {
                return self.note(range, (at, jet, taken), false);
            }
            let to = [0, 1].map(|k| {
                let [low, high] = [range[2 * k], range[2 * k + 1]];
                if step[k] == room[k][0] {
                    low
                } else if step[k] == room[k][1] {
                    high
                } else {
                    (at[k] + step[k]).clamp(low, high)
                }
            });
            let next = net.jet(to[0], to[1], query);
            taken += 1;
            if next.squared() < jet.squared() {
                (at, jet) = (to, next);
            } else {
                self.proof.iterated(taken);
                return self.iterate(range, at);
            }
        }
    }

    /// `h >= h(u) - g.M^-1.g / 2` on the area, with `M = [[a, -b], [-b, c]]` the worst Hessian for the slope's signs.
    pub(super) fn first_order(
        &self,
        area: &Area,
        at: [f64; 2],
        jet: &Jet2,
        [a, b, c]: [f64; 3],
    ) -> bool {
        let (d, w, position) = (norm(jet.d), jet.w[0], self.sheet.position);
        let value = value_at(d, w, position, self.proof);
        let excess = dot(jet.d, jet.d) - self.proof.target_squared;
        let gradient = jet.gradient();
        let degrees = [self.sheet.net.degree.s, self.sheet.net.degree.t];
        let slope = |k: usize, box_: [f64; 2], speed: f64| {
            let width = box_[1] - box_[0];
            let g = 2.0 * w * (jet.w[k + 1] * excess + w * gradient[k]) * width;
            let slack = slope_error(d, speed, w, position, degrees[k]) * width;
            free_slope(g, slack, at[k] <= box_[0], at[k] >= box_[1])
        };
        let x = slope(0, area.s, norm(jet.s));
        let y = slope(1, area.t, norm(jet.t));
        let loss = (c * x * x + 2.0 * b * x * y + a * y * y) / (a * c - b * b);
        value > 0.0 && loss <= 2.0 * value * (1.0 - 1e-10)
    }
}

/// Where in a box around the origin `g.x + x.H x / 2`, with `H = [[a, b], [b, c]]`, is least, and how far below zero; `None`
/// where it is not strictly convex.
fn least_in_box(g: [f64; 2], [a, b, c]: [f64; 3], room: [[f64; 2]; 2]) -> Option<([f64; 2], f64)> {
    let determinant = a * c - b * b;
    if !(a > 0.0 && c > 0.0 && determinant > 1e-14 * a * c) {
        return None;
    }
    let free = [(b * g[1] - c * g[0]) / determinant, (b * g[0] - a * g[1]) / determinant];
    if (0..2).all(|k| room[k][0] <= free[k] && free[k] <= room[k][1]) {
        return Some((free, -0.5 * (g[0] * free[0] + g[1] * free[1])));
    }
    // Then it is on a side.
    let mut least = ([0.0; 2], f64::INFINITY);
    for k in 0..2 {
        for end in room[k] {
            let (own, other) = if k == 0 { (a, c) } else { (c, a) };
            let [low, high] = room[1 - k];
            let along = (-(g[1 - k] + b * end) / other).clamp(low, high);
            let value = g[k] * end
                + g[1 - k] * along
                + 0.5 * (own * end * end + other * along * along)
                + b * end * along;
            if value < least.1 {
                least = (if k == 0 { [end, along] } else { [along, end] }, value);
            }
        }
    }
    least.1.is_finite().then_some((least.0, -least.1))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn value(g: [f64; 2], [a, b, c]: [f64; 3], [x, y]: [f64; 2]) -> f64 {
        g[0] * x + g[1] * y + 0.5 * (a * x * x + c * y * y) + b * x * y
    }

    #[test]
    fn no_place_of_the_box_is_lower() {
        let number = |n: usize| ((n * 7919) % 2003) as f64 / 1001.5 - 1.0;
        for n in 0..500 {
            let g = [number(7 * n), number(7 * n + 1)];
            let (a, c) = (number(7 * n + 2).abs() + 0.01, number(7 * n + 3).abs() + 0.01);
            let hessian = [a, 0.999 * number(7 * n + 4) * (a * c).sqrt(), c];
            let room = [[-number(7 * n + 5).abs(), 0.3], [-0.2, number(7 * n + 6).abs()]];
            let (at, gain) = least_in_box(g, hessian, room).unwrap();
            assert!((value(g, hessian, at) + gain).abs() < 1e-12 * (1.0 + gain));
            for k in 0..=20 {
                for l in 0..=20 {
                    let share =
                        |[low, high]: [f64; 2], k: usize| low + (high - low) * k as f64 / 20.0;
                    let there = [share(room[0], k), share(room[1], l)];
                    assert!(value(g, hessian, there) >= -gain - 1e-12, "{n}: {at:?} {there:?}");
                }
            }
        }
    }

    #[test]
    fn a_saddle_has_no_least_place() {
        assert!(least_in_box([1.0, 1.0], [1.0, 2.0, 1.0], [[-1.0, 1.0]; 2]).is_none());
    }
}
