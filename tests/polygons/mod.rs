//! Random polygons with wishes, and what the weights module makes of them: for the tests and for `make weights-stress`.
#![allow(dead_code, reason = "each user takes a part")]

use footpoint::closest::{QueryOptions, Workspace};
use footpoint::curve::Curve;
use footpoint::index::IndexedCurve;
use footpoint::weights::refine::refine;
use footpoint::weights::{Net, Options, Report, State, Wish};
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
        .map(|i| if even { i as f64 / (inner + 1) as f64 } else { random.unit().clamp(0.01, 0.99) })
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
    pub reported: u64,
    /// Said to be impossible although they are not, or said to be met although they are not.
    pub wrong: u64,
    pub starts: u64,
    pub slowest_ms: f64,
    pub total_ms: f64,
    pub ten_poles_ms: f64,
    pub ten_poles: u64,
}

/// Whether a report tells the truth about a curve whose wishes exist: measured anew.
pub fn is_true(report: &Report, size: f64) -> bool {
    let curve = IndexedCurve::new(report.curve().unwrap().clone());
    report.poles.iter().enumerate().all(|(k, pole)| {
        let measured = distance(&curve, curve.curve().poles()[k]);
        let off = (measured - pole.wish).abs();
        let met = pole.state == State::Met as u32;
        pole.wish.is_nan()
            || (pole.state != State::Impossible as u32 && (!met || off <= 1.1e-9 * size))
    })
}

pub fn refine_many(seed: u64, count: u64) -> Tally {
    let mut tally = Tally::default();
    for i in 0..count {
        if let Ok(only) = std::env::var("ONLY")
            && !only.split(',').any(|x| x == i.to_string())
        {
            continue;
        }
        let mut random = Random(seed.wrapping_mul(1 << 40).wrapping_add(i << 8));
        let polygon = polygon(&mut random);
        let wishes = wishes(&mut random, &polygon);
        let curve = Curve::new(&polygon.0, polygon.1, &polygon.2, None).unwrap();
        let net = Net::Curve(&curve);
        let start = Instant::now();
        let report = refine(
            net,
            &wishes,
            &[],
            &Options {
                starts: std::env::var("STARTS").ok().and_then(|x| x.parse().ok()).unwrap_or(0),
                ..Options::default()
            },
            &mut || false,
        )
        .unwrap();
        let ms = 1e3 * start.elapsed().as_secs_f64();
        tally.curves += 1;
        tally.total_ms += ms;
        tally.slowest_ms = tally.slowest_ms.max(ms);
        tally.starts += u64::from(report.starts);
        if polygon.2.len() == 10 {
            tally.ten_poles += 1;
            tally.ten_poles_ms += ms;
        }
        if report.is_met() {
            tally.met += 1
        } else {
            tally.reported += 1
        }
        if !is_true(&report, net.diagonal()) {
            tally.wrong += 1;
        }
        if !report.is_met() && std::env::var_os("SHOW").is_some() {
            for (k, p) in report.poles.iter().enumerate() {
                if !p.wish.is_nan() {
                    println!(
                        "   {k} w {:.4} wish {:.6} got {:.9} off {:.1e} u {:.5} lb {:.1e}",
                        p.weight,
                        p.wish,
                        p.distance,
                        p.distance - p.wish,
                        p.u,
                        p.distance - p.lower_bound
                    );
                }
            }
            println!(
                "{i}: {} poles degree {} wishes {} starts {}",
                polygon.2.len(),
                polygon.1,
                wishes.len(),
                report.starts
            );
        }
    }
    tally
}
