//! The order of members in which the tree halves them: neighbours in space become neighbours in the list.
//!
//! The tree halves ranges of a list. Here the list is sorted so that each half is one side of a median plane, across the
//! longest extent of the box centres: a kd-tree without nodes of its own. O(n log n).

use crate::bounds::Aabb;

/// The numbers of the boxes in that order.
pub fn by_halves(boxes: &[Aabb], order: &mut [u32]) {
    if order.len() <= 2 {
        order.sort_unstable();
        return;
    }
    let middle = |i: u32, k: usize| {
        let aabb = &boxes[i as usize];
        0.5 * aabb.low[k] + 0.5 * aabb.high[k]
    };
    let extent = |k: usize| {
        let (low, high) =
            order.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), &i| {
                (low.min(middle(i, k)), high.max(middle(i, k)))
            });
        high - low
    };
    let sizes = [0, 1, 2].map(extent);
    let axis = (1..3).fold(0, |best, k| if sizes[k] > sizes[best] { k } else { best });
    let half = order.len() / 2;
    order.select_nth_unstable_by(half, |&i, &j| {
        middle(i, axis).total_cmp(&middle(j, axis)).then(i.cmp(&j))
    });
    let (first, second) = order.split_at_mut(half);
    by_halves(boxes, first);
    by_halves(boxes, second);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_number_stays_and_halves_are_apart() {
        let boxes: Vec<Aabb> = (0..100)
            .map(|i| {
                let x = f64::from(i * 37 % 100);
                Aabb { low: [x, 0.0, 0.0], high: [x + 1.0, 1.0, 1.0] }
            })
            .collect();
        let mut order: Vec<u32> = (0..100).collect();
        by_halves(&boxes, &mut order);
        let x = |i: &u32| boxes[*i as usize].low[0];
        assert!(order[..50].iter().map(x).fold(0.0, f64::max) < 50.0);
        assert!(order[75..].iter().map(x).fold(100.0, f64::min) >= 75.0);
        order.sort_unstable();
        assert!(order.iter().enumerate().all(|(k, &i)| k == i as usize));
    }
}
