//! Formula (3): the first guess of a weight, and random numbers for what it does not tell.

use super::report::{PoleReport, flag};

/// The weight for a distance `wish` from a pole that is `length` from its chord, within the range, and the flags of that.
pub fn guess(wish: f64, length: f64, on_chord: f64, [low, high]: [f64; 2]) -> (f64, u32) {
    if length <= on_chord {
        return (1.0_f64.clamp(low, high), flag::ON_CHORD);
    }
    let weight = length / wish - 1.0;
    if weight < low || weight > high {
        return (weight.clamp(low, high), flag::LIMITED);
    }
    (weight, 0)
}

/// The report of a pole before anything is measured.
pub fn first(wish: Option<f64>, length: f64, on_chord: f64, range: [f64; 2]) -> PoleReport {
    let without = (1.0_f64.clamp(range[0], range[1]), 0);
    let (weight, flags) = wish.map_or(without, |wish| guess(wish, length, on_chord, range));
    PoleReport::guessed(wish, length, flags, weight)
}

/// Random numbers that depend on the seed alone (SplitMix64, Steele, Lea, Flood, 2014).
pub struct Random(u64);

impl Random {
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Between -1 and 1, all multiples of 2^-52.
    pub fn signed(&mut self) -> f64 {
        let unit = (self.next() >> 11) as f64 / 9_007_199_254_740_992.0;
        2.0 * unit - 1.0
    }

    /// A number below `count`, which is small and not 0.
    pub fn below(&mut self, count: usize) -> usize {
        (self.next() % count as u64) as usize
    }
}
