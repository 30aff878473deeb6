//! Random polygons with wishes, and what the weights module makes of them: for the tests and for `make weights-stress`.
#![allow(dead_code, reason = "each user takes a part")]

use footpoint::closest::{QueryOptions, Workspace};
use footpoint::curve::Curve;
use footpoint::index::IndexedCurve;
use footpoint::weights::network::network;
use footpoint::weights::refine::refine;
use footpoint::weights::{Net, Options, PoleReport, Report, State, Wish, flag};
use std::time::Instant;

/// SplitMix64.
pub struct Random(pub u64);

impl Random {
    pub fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    pub fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 / 9_007_199_254_740_992.0
    }

    pub fn below(&mut self, n: usize) -> usize {
        (self.next() % n as u64) as usize
    }
}

/// A polygon of 3 to 12 poles and degree 2 to 5, in a plane or in space, clamped, with even or random knots.
pub fn polygon(random: &mut Random) -> (Vec<f64>, usize, Vec<[f64; 3]>) {
    let count = 3 + random.below(10);
    let degree = (2 + random.below(4)).min(count - 1);
    let (flat, walk) = (random.below(2) == 0, random.below(2) == 0);
    let mut poles: Vec<[f64; 3]> = Vec::new();
    for i in 0..count {
        let mut pole = [10.0 * random.unit(), 10.0 * random.unit(), 10.0 * random.unit()];
        if walk {
            // From left to right, as a designer draws.
            pole[0] = 3.0 * i as f64 + 2.0 * random.unit();
        }
        if flat {
            pole[2] = 0.0;
        }
        poles.push(pole);
    }
    let inner = count - degree - 1;
    let even = random.below(2) == 0;
    let mut knots: Vec<f64> = (1..=inner)
        .map(|i| if even { i as f64 / (inner + 1) as f64 } else { 0.01 + 0.98 * random.unit() })
        .collect();
    knots.sort_by(f64::total_cmp);
    let mut full = vec![0.0; degree + 1];
    full.extend(knots);
    full.extend(vec![1.0; degree + 1]);
    (full, degree, poles)
}

pub fn distance(curve: &IndexedCurve, pole: [f64; 3]) -> f64 {
    let options = QueryOptions::default();
    curve.closest(pole, None, &options, &mut Workspace::default(), None).distance
}

/// Wishes of some inner poles, taken from a curve over the polygon with weights 0.1 to 10.
pub fn wishes(
    random: &mut Random,
    (knots, degree, poles): &(Vec<f64>, usize, Vec<[f64; 3]>),
) -> Vec<Wish> {
    let weights: Vec<f64> = poles.iter().map(|_| 10_f64.powf(2.0 * random.unit() - 1.0)).collect();
    let curve = Curve::new(knots, *degree, poles, Some(&weights)).unwrap();
    let curve = IndexedCurve::new(curve);
    let all = random.below(2) == 0;
    let mut out: Vec<Wish> = (1..poles.len() - 1)
        .filter(|_| all || random.below(2) == 0)
        .map(|pole| Wish { pole, distance: distance(&curve, poles[pole]) })
        .collect();
    if out.is_empty() {
        out.push(Wish { pole: 1, distance: distance(&curve, poles[1]) });
    }
    out
}

/// What came of many refinements.
#[derive(Debug, Default)]
pub struct Tally {
    pub curves: u64,
    pub met: u64,
    /// Not met, and reported so.
    pub missed: u64,
    /// Of those, with a wish that was proven impossible.
    pub proven: u64,
    /// Said to be met or impossible although that is not true.
    pub wrong: u64,
    /// Milliseconds of each curve, and of those with ten poles.
    pub times: Vec<f64>,
    pub times_of_ten: Vec<f64>,
}

impl Tally {
    fn count(&mut self, poles: usize, report: &Report, milliseconds: f64, is_true: bool) {
        self.curves += 1;
        self.met += u64::from(report.is_met());
        self.missed += u64::from(!report.is_met());
        let impossible = |pole: &PoleReport| pole.state == State::Impossible as u32;
        self.proven += u64::from(report.poles.iter().any(impossible));
        self.wrong += u64::from(!is_true);
        self.times.push(milliseconds);
        if poles == 10 {
            self.times_of_ten.push(milliseconds);
        }
    }

    pub fn show(&mut self, name: &str) {
        let Self { curves, met, missed, proven, wrong, .. } = *self;
        println!(
            "{name}: {curves} curves, {met} met, {missed} reported as not met, {proven} with a proof, {wrong} wrong"
        );
        for (what, times) in [("all", &mut self.times), ("10 poles", &mut self.times_of_ten)] {
            times.sort_by(f64::total_cmp);
            let at =
                |share: f64| times.get((share * times.len() as f64) as usize).unwrap_or(&f64::NAN);
            let (half, most, last) = (at(0.5), at(0.99), times.last().unwrap_or(&f64::NAN));
            println!("  {what}: median {half:.2} ms, 99 % {most:.1} ms, slowest {last:.0} ms");
        }
    }
}

/// Whether a report tells the truth, by distances measured anew: what is met is met, and wishes that exist are not impossible.
fn is_true(report: &Report, size: f64, exist: bool) -> bool {
    let curve = IndexedCurve::new(report.curve().unwrap().clone());
    report.poles.iter().enumerate().all(|(k, pole)| {
        let off = (distance(&curve, curve.curve().poles()[k]) - pole.wish).abs();
        let met = pole.state == State::Met as u32;
        let impossible = pole.state == State::Impossible as u32;
        pole.wish.is_nan() || (!(exist && impossible) && (!met || off <= 1.1e-9 * size))
    })
}

/// Refines wishes that exist, each polygon from its own random numbers.
pub fn feasible(seed: u64, count: u64) -> Tally {
    run(seed, count, |random, polygon| (wishes(random, polygon), Some(true)))
}

/// Refines wishes that do not exist: farther from an inner pole than the ends of the curve are, or two that differ by more than
/// their poles are apart. The others are such as exist.
pub fn infeasible(seed: u64, count: u64) -> Tally {
    run(seed, count, |random, polygon| {
        let poles = &polygon.2;
        let gap = |a: usize, b: usize| {
            (0..3).map(|x| (poles[a][x] - poles[b][x]).powi(2)).sum::<f64>().sqrt()
        };
        let mut list = wishes(random, polygon);
        let i = random.below(list.len());
        let pole = list[i].pole;
        if list.len() > 1 && random.below(2) == 0 {
            let other = list[(i + 1) % list.len()];
            list[i].distance =
                other.distance + (1.001 + 0.1 * random.unit()) * gap(pole, other.pole);
        } else {
            let most = gap(pole, 0).min(gap(pole, poles.len() - 1));
            list[i].distance = (1.001 + 0.1 * random.unit()) * most;
        }
        (list, Some(false))
    })
}

/// Refines wishes that may or may not exist: those of a curve, each changed by up to a factor.
pub fn wild(seed: u64, count: u64) -> Tally {
    run(seed, count, |random, polygon| {
        let mut list = wishes(random, polygon);
        list.iter_mut().for_each(|wish| wish.distance *= 0.5 + random.unit());
        (list, None)
    })
}

type Polygon = (Vec<f64>, usize, Vec<[f64; 3]>);

fn run(
    seed: u64,
    count: u64,
    wish: impl Fn(&mut Random, &Polygon) -> (Vec<Wish>, Option<bool>),
) -> Tally {
    let mut tally = Tally::default();
    for i in 0..count {
        let mut random = Random(seed.wrapping_mul(1 << 40).wrapping_add(i << 8));
        let polygon = polygon(&mut random);
        let (wishes, exist) = wish(&mut random, &polygon);
        let curve = Curve::new(&polygon.0, polygon.1, &polygon.2, None).unwrap();
        let net = Net::Curve(&curve);
        let start = Instant::now();
        let report = refine(net, &wishes, &[], &Options::default(), &mut || false).unwrap();
        let milliseconds = 1e3 * start.elapsed().as_secs_f64();
        let is_true = is_true(&report, net.diagonal(), exist == Some(true))
            && (exist != Some(false) || !report.is_met());
        tally.count(polygon.2.len(), &report, milliseconds, is_true);
    }
    tally
}

/// A network over a random polygon: weights within the range by the formula, and the same bits again.
pub fn check_network(seed: u64) {
    let mut random = Random(seed << 20);
    let (knots, degree, poles) = polygon(&mut random);
    let curve = Curve::new(&knots, degree, &poles, None).unwrap();
    let least = 0.1 + random.unit();
    let range = [least, least + 0.1 + 3.0 * random.unit()];
    let within = |random: &mut Random| range[0] + (range[1] - range[0]) * random.unit();
    let mut wishes = Vec::new();
    for pole in 1..poles.len() - 1 {
        if random.below(3) == 0 {
            wishes.push(Wish { pole, distance: within(&mut random) });
        }
    }
    let options = Options { seed, ..Options::default() };
    let report = network(&curve, &wishes, range, &options).unwrap();
    let again = network(&curve, &wishes, range, &options).unwrap();
    assert_eq!(report.weights(), again.weights());
    assert!(report.iterations <= 100, "seed {seed}: {} steps", report.iterations);
    for (k, pole) in report.poles.iter().enumerate() {
        assert!((0.01..=100.0).contains(&pole.weight));
        assert_eq!(pole.flags & flag::UNTRAINED, 0, "seed {seed}: pole {k}");
        if pole.flags & (flag::LIMITED | flag::ON_CHORD) != 0 {
            continue;
        }
        let distance = pole.chord_distance / (1.0 + pole.weight);
        let slack = 1e-12 * pole.chord_distance;
        let low = if pole.wish.is_nan() { range[0] } else { pole.wish } - slack;
        let high = if pole.wish.is_nan() { range[1] } else { pole.wish } + slack;
        assert!((low..=high).contains(&distance), "seed {seed}: pole {k}: {pole:?}");
    }
}
