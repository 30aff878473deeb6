//! Sets of feet: the answer to a request that can have more than one.
//!
//! A member is a foot with the parameter intervals that belong to it:
//!
//! ```text
//!   point     one place; the intervals enclose what the tolerance leaves open
//!   arc       an interval of one parameter with the other one fixed: a collapsed edge, a strip without width
//!   region    intervals in both parameters: the centre of a sphere, a surface that is a single point
//! ```
//!
//! A set is complete when nothing is undecided: every answer then lies in the intervals of a member.

use crate::closest::FootPoint;

/// What the parameters of a member form.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// One place.
    Point = 0,
    /// An interval of u, with v fixed.
    ArcU = 1,
    /// An interval of v, with u fixed.
    ArcV = 2,
    /// Both parameters vary.
    Region = 3,
}

/// What the distance does at a member, among the points of the domain around it.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Nature {
    /// Nothing around is nearer.
    Minimum = 0,
    /// Nothing around is farther.
    Maximum = 1,
    /// Nearer in some directions, farther in others.
    Saddle = 2,
    /// Second derivatives do not tell.
    Flat = 3,
}

/// A foot and the parameters that belong to it.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Member {
    /// The representative: the place in the intervals that was found best.
    pub foot: FootPoint,
    /// Interval of u.
    pub u: [f64; 2],
    /// Interval of v; 0, 0 for curves.
    pub v: [f64; 2],
    /// What the parameters form.
    pub kind: Kind,
    /// What the distance does there.
    pub nature: Nature,
}

/// An answer of many feet.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FootSet {
    /// The feet, in the order that the request defines.
    pub members: Vec<Member>,
    /// Boxes u0, u1, v0, v1 in which nothing could be decided before the budget ran out.
    pub undecided: Vec<[f64; 4]>,
}

impl FootSet {
    /// Whether nothing is missing.
    pub fn is_complete(&self) -> bool {
        self.undecided.is_empty()
    }
}

/// Joins boxes u0, u1, v0, v1 that touch into hulls, and hulls that touch again, in order of their least u, then v.
pub fn joined(mut boxes: Vec<[f64; 4]>) -> Vec<[f64; 4]> {
    let order = |a: &[f64; 4], b: &[f64; 4]| a[0].total_cmp(&b[0]).then(a[2].total_cmp(&b[2]));
    loop {
        boxes.sort_by(order);
        let before = boxes.len();
        let mut hulls: Vec<[f64; 4]> = Vec::new();
        for area in boxes {
            let mut grown = area;
            hulls.retain(|known| {
                let apart = !touch(known, &grown);
                if !apart {
                    grown = hull(known, &grown);
                }
                apart
            });
            hulls.push(grown);
        }
        if hulls.len() == before {
            return hulls;
        }
        boxes = hulls;
    }
}

/// Whether two closed boxes have a point in common.
pub fn touch(a: &[f64; 4], b: &[f64; 4]) -> bool {
    a[0] <= b[1] && b[0] <= a[1] && a[2] <= b[3] && b[2] <= a[3]
}

fn hull(a: &[f64; 4], b: &[f64; 4]) -> [f64; 4] {
    [a[0].min(b[0]), a[1].max(b[1]), a[2].min(b[2]), a[3].max(b[3])]
}

/// Share of a span from which on an interval is more than the surroundings of a point.
const WIDE: f64 = 0.05;

/// Whether an interval is more than the surroundings of a point: a good part of one of the `spans` (as far as that lies in
/// `range`). Pieces are analytic, so that what is constant along a part of a span is constant along all of it.
pub fn is_wide(
    [low, high]: [f64; 2],
    range: [f64; 2],
    mut spans: impl Iterator<Item = [f64; 2]>,
) -> bool {
    spans.any(|[a, b]| {
        let (a, b) = (a.max(range[0]), b.min(range[1]));
        a < b && high.min(b) - low.max(a) > WIDE * (b - a)
    })
}

/// Samples in the middle half of an interval that decide whether it is an arc.
const ARC_SAMPLES: usize = 9;

/// Whether nothing changes along an interval but for its ends: on its middle half `change` stays below a 64th of
/// `tolerance`. Around a simple or multiple zero the middle half changes by more, around a continuum by rounding only.
pub fn is_arc([low, high]: [f64; 2], tolerance: f64, change: impl Fn(f64) -> f64) -> bool {
    let share = |k: usize| 0.25 + 0.5 * k as f64 / (ARC_SAMPLES - 1) as f64;
    let still = |k: usize| change(low + share(k) * (high - low)) <= tolerance / 64.0;
    low < high && (0..ARC_SAMPLES).all(still)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn boxes_that_touch_become_one_and_others_do_not() {
        let boxes = vec![
            [2.0, 3.0, 0.0, 1.0],
            [0.0, 1.0, 0.0, 1.0],
            [1.0, 2.0, 1.0, 2.0],
            [5.0, 6.0, 0.0, 1.0],
        ];
        assert_eq!(joined(boxes), [[0.0, 3.0, 0.0, 2.0], [5.0, 6.0, 0.0, 1.0]]);
    }

    #[test]
    fn an_interval_without_change_is_an_arc_and_a_triple_zero_is_none() {
        assert!(is_arc([0.0, 1.0], 1e-6, |_| 1e-12));
        assert!(!is_arc([-0.01, 0.01], 1e-6, |x| x * x * x.abs()));
    }
}
