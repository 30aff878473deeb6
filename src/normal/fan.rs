//! Fans of sectors: their normals, weighted by their angles.

use super::LEAST_BREAK;
use crate::bounds::{Vector, add, cross, dot, norm, scaled, sub};

/// A mean of unit normals shorter than this says nothing: the sectors are folded onto each other.
const LEAST_MEAN: f64 = 1e-6;

/// The sectors around a place, summed.
#[derive(Clone, Copy, Debug, Default)]
pub struct Fan {
    /// Sum of angle times unit normal.
    sum: Vector,
    /// Sum of the angles.
    total: f64,
    /// Sum of the unit normals, for sectors that have no angle.
    plain: Vector,
    first: Option<Vector>,
    count: usize,
    /// Whether the normals differ.
    pub bent: bool,
    /// Whether limits were taken.
    pub limit: bool,
    /// Whether the fan ends at a border.
    pub open: bool,
    /// Whether a sector has no normal.
    pub undefined: bool,
}

impl Fan {
    /// A fan of limits, still without sectors.
    pub fn of_limits(open: bool) -> Self {
        Self { limit: true, open, ..Self::default() }
    }

    /// Takes one sector more.
    pub fn add(&mut self, normal: Vector, angle: f64) {
        let first = *self.first.get_or_insert(normal);
        self.bent |= differ(first, normal);
        self.sum = add(self.sum, scaled(normal, angle));
        self.total += angle;
        self.plain = add(self.plain, normal);
        self.count += 1;
    }

    /// Takes the sectors of another fan.
    pub fn merge(&mut self, other: &Self) {
        if let (Some(a), Some(b)) = (self.first, other.first) {
            self.bent |= differ(a, b);
        }
        self.first = self.first.or(other.first);
        self.sum = add(self.sum, other.sum);
        self.total += other.total;
        self.plain = add(self.plain, other.plain);
        self.count += other.count;
        self.bent |= other.bent;
        self.limit |= other.limit;
        self.open |= other.open;
        self.undefined |= other.undefined;
    }

    /// The unit mean normal, and whether it is only that of the first sector because the sectors are folded onto each
    /// other; `None` when there is no normal.
    pub fn direction(&self) -> Option<(Vector, bool)> {
        if self.undefined {
            return None;
        }
        let first = self.first?;
        if !self.bent {
            return Some((first, false));
        }
        let angles = self.total > LEAST_MEAN;
        let (sum, total) =
            if angles { (self.sum, self.total) } else { (self.plain, self.count as f64) };
        let size = norm(sum);
        if size <= LEAST_MEAN * total {
            return Some((first, true));
        }
        Some((scaled(sum, 1.0 / size), false))
    }
}

/// Whether two unit vectors differ by more than [`LEAST_BREAK`].
pub fn differ(a: Vector, b: Vector) -> bool {
    norm(cross(a, b)) > LEAST_BREAK || dot(a, b) < 0.0
}

/// The vector of length one; `None` for zero, infinity and NaN.
pub fn unit(a: Vector) -> Option<Vector> {
    let largest = a.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
    if !(largest > 0.0 && largest.is_finite()) || a.iter().any(|x| x.is_nan()) {
        return None;
    }
    // Two steps: the square of a small vector may vanish.
    let a = a.map(|x| x / largest);
    Some(scaled(a, 1.0 / norm(a)))
}

/// The angle between two unit vectors, 0 to pi, with the same bits on every machine.
pub fn angle(a: Vector, b: Vector) -> f64 {
    let (far, near) = (norm(sub(a, b)), norm(add(a, b)));
    let half = if far <= near {
        arc_tangent(far / near)
    } else {
        std::f64::consts::FRAC_PI_2 - arc_tangent(near / far)
    };
    2.0 * half
}

/// Arc tangent of 0 to 1: halved three times, then its series.
fn arc_tangent(x: f64) -> f64 {
    let halved = |x: f64| x / (1.0 + (1.0 + x * x).sqrt());
    let x = halved(halved(halved(x)));
    let square = x * x;
    let series = (0..8).rev().fold(0.0, |sum, k| 1.0 / f64::from(2 * k + 1) - square * sum);
    8.0 * x * series
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_are_those_of_the_arc_cosine() {
        for degrees in 0..=180 {
            let x = f64::from(degrees).to_radians();
            let found = angle([1.0, 0.0, 0.0], [x.cos(), x.sin(), 0.0]);
            assert!((found - x).abs() < 1e-14, "{degrees}: {found}");
        }
    }

    #[test]
    fn a_fold_gives_its_first_normal_and_says_so() {
        let mut fan = Fan::default();
        fan.add([0.0, 0.0, 1.0], 1.0);
        assert_eq!(fan.direction(), Some(([0.0, 0.0, 1.0], false)));
        fan.add([0.0, 0.0, -1.0], 1.0);
        assert_eq!((fan.direction(), fan.bent), (Some(([0.0, 0.0, 1.0], true)), true));
    }
}
