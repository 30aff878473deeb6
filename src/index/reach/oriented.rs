//! Boxes along any axes.

use super::MARGIN;
use crate::bounds::{Vector, add, dot, norm, scaled, sub};

/// A box in space: half its widths along its axes, which are perpendicular.
#[derive(Clone, Copy, Debug)]
pub struct Oriented {
    pub center: Vector,
    pub axes: [Vector; 3],
    pub half: [f64; 3],
    /// Of the ball around it.
    pub radius: f64,
}

impl Oriented {
    /// Around points, widened by `margin` to each side.
    pub fn around(
        points: impl Iterator<Item = Vector> + Clone,
        axes: [Vector; 3],
        margin: f64,
    ) -> Self {
        let ends = axes.map(|axis| extent(points.clone().map(|x| dot(x, axis))));
        let middle = ends.map(|[low, high]| 0.5 * (low + high));
        let center = (0..3).fold([0.0; 3], |sum, k| add(sum, scaled(axes[k], middle[k])));
        let half = ends.map(|[low, high]| 0.5 * (high - low) * MARGIN + margin);
        Self { center, axes, half, radius: norm(half) * MARGIN }
    }

    /// Half its width along a unit vector.
    pub fn reach(&self, along: Vector) -> f64 {
        (0..3).fold(0.0, |sum, k| sum + self.half[k] * dot(self.axes[k], along).abs())
    }

    /// A box with the axes of this one around both.
    pub fn joined(&self, other: &Self) -> Self {
        let move_ = sub(other.center, self.center);
        let mut center = self.center;
        let half = [0, 1, 2].map(|k| {
            let (at, reach) = (dot(move_, self.axes[k]), other.reach(self.axes[k]));
            let [low, high] = [(at - reach).min(-self.half[k]), (at + reach).max(self.half[k])];
            center = add(center, scaled(self.axes[k], 0.5 * (low + high)));
            0.5 * (high - low) * MARGIN
        });
        Self { center, half, radius: norm(half) * MARGIN, ..*self }
    }

    /// At most the distance to another box.
    pub fn distance(&self, other: &Self) -> f64 {
        let move_ = sub(other.center, self.center);
        // The cosines between the axes serve both ways.
        let turn = self.axes.map(|mine| other.axes.map(|axis| dot(mine, axis).abs()));
        let gaps = |from: &Self, to: &Self, cosine: &dyn Fn(usize, usize) -> f64| {
            (0..3).fold(0.0, |sum, k| {
                let reach = (0..3).fold(0.0, |sum, n| sum + to.half[n] * cosine(k, n));
                let reach = from.half[k] + reach;
                let gap = (dot(move_, from.axes[k]).abs() - reach * MARGIN).max(0.0);
                sum + gap * gap
            })
        };
        let there = gaps(self, other, &|k, n| turn[k][n]);
        let back = gaps(other, self, &|k, n| turn[n][k]);
        there.max(back).sqrt() / MARGIN
    }
}

/// Least and greatest of a list; zeros of none.
pub fn extent(list: impl Iterator<Item = f64>) -> [f64; 2] {
    list.fold(None, |ends: Option<[f64; 2]>, x| {
        Some(ends.map_or([x; 2], |[low, high]| [low.min(x), high.max(x)]))
    })
    .unwrap_or_default()
}
