//! Scattered points in the order of a space-filling curve through their parameters, and some of them, drawn evenly.
//!
//! Neighbours in the order share basis functions. The curve (Z order) halves the domain as knots do, so that the points of a cell of the
//! knots stand together. Groups of a power of two neighbours have one point drawn by lot each: it is one of the two that smaller groups
//! drew, so that whoever was drawn is drawn again when more are wanted.

use crate::curve::insertion::collect;
use crate::error::Error;

/// Halvings of the domain in each direction.
const BITS: u32 = 12;

/// Numbers of the parameters in Z order.
pub(super) fn ordered(parameters: &[[f64; 2]]) -> Result<Vec<usize>, Error> {
    let [low, high] = [f64::min, f64::max].map(|end: fn(f64, f64) -> f64| {
        parameters.iter().fold(parameters[0], |a, b| [0, 1].map(|k| end(a[k], b[k])))
    });
    let cells = f64::from(1u32 << BITS);
    // Where all are alike: 0 / 0, which is no number and cell 0.
    let cell = |x: f64, k: usize| ((x - low[k]) / (high[k] - low[k]) * cells) as u32;
    let key = |at: &[f64; 2]| {
        let [a, b] = [0, 1].map(|k| cell(at[k], k).min((1 << BITS) - 1));
        (0..BITS).fold(0u32, |key, bit| {
            key | (a >> bit & 1) << (2 * bit + 1) | (b >> bit & 1) << (2 * bit)
        })
    };
    let mut list = collect(parameters.len(), parameters.iter().map(key).zip(0usize..))?;
    list.sort_unstable();
    collect(list.len(), list.iter().map(|&(_, i)| i))
}

/// At least `wanted` of `count` numbers, in order; none when that is hardly less work than all.
pub(super) fn drawn(count: usize, wanted: usize) -> Option<impl Iterator<Item = usize>> {
    let size = count.checked_div(wanted).unwrap_or(count).checked_ilog2()?;
    let pick = move |group: usize| {
        (0..size).rev().fold(group, |group, level| 2 * group + lot(group, level))
    };
    (size > 0).then(|| (0..count.div_ceil(1 << size)).map(pick).filter(move |&i| i < count))
}

/// 0 or 1.
fn lot(group: usize, level: u32) -> usize {
    // The finaliser of splitmix64 (Steele, Lea, Flood, 2014).
    let x = ((group as u64) << 6 | u64::from(level)).wrapping_add(1);
    let x = x.wrapping_mul(0x9e37_79b9_7f4a_7c15);
    let x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    (x >> 63) as usize
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbours_stand_together() {
        // A grid of 4 by 4, shuffled: quarters of the domain stand together.
        let at = |k: usize| {
            let k = 5 * k % 16;
            [(k / 4) as f64 * 7.0 - 3.0, (k % 4) as f64 * 1e-3]
        };
        let list: Vec<[f64; 2]> = (0..16).map(at).collect();
        let order = ordered(&list).unwrap();
        let quarter = |i: usize| (list[i][0] > 7.5, list[i][1] > 1.5e-3);
        assert!(order.chunks(4).all(|four| four.iter().all(|&i| quarter(i) == quarter(four[0]))));
        let mut sorted = order.clone();
        sorted.sort_unstable();
        assert!(sorted.into_iter().eq(0..16));
        assert_eq!(ordered(&[[2.0, 1.0]; 3]).unwrap(), [0, 1, 2]);
    }

    #[test]
    fn one_of_each_group_is_drawn_and_drawn_again() {
        let list = |wanted: usize| drawn(1000, wanted).unwrap().collect::<Vec<usize>>();
        let mut fewer = Vec::new();
        for wanted in [3, 30, 200, 500] {
            let more = list(wanted);
            let size = 1usize << (1000 / wanted).ilog2();
            assert!(more.len() + 1 >= 1000usize.div_ceil(size) && more.len() >= wanted);
            let mut groups = more.iter().map(|i| i / size);
            assert!(groups.by_ref().is_sorted_by(|a, b| a < b));
            assert!(fewer.iter().all(|i| more.contains(i)));
            // By lot: not always the same place of the group.
            let odd = more.iter().filter(|&i| i % 2 == 1).count() as f64 / more.len() as f64;
            assert!(wanted < 200 || (odd - 0.5).abs() < 0.1, "{wanted} {odd}");
            fewer = more;
        }
        assert!(drawn(1000, 501).is_none() && drawn(0, 7).is_none());
    }
}
