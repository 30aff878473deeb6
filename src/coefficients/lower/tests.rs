//! Lowered polynomials against those that they stand for.

use super::*;

const FACTORS: [Bidegree; 5] = [
    Bidegree { s: 3, t: 6 },
    Bidegree { s: 7, t: 2 },
    Bidegree { s: 1, t: 8 },
    Bidegree { s: 9, t: 8 },
    Bidegree { s: 14, t: 13 },
];

/// A slot with the Bernstein coefficients of a function that hardly bends, of that of its squared weight when rational.
fn gentle(grid: &Grid, bend: f64) -> Vec<f64> {
    let mut slot = vec![0.25; grid.slot()];
    let width = grid.width();
    for k in 0..grid.count {
        let s = (k / width) as f64 / grid.degree.s.max(1) as f64;
        let t = (k % width) as f64 / grid.degree.t.max(1) as f64;
        slot[LANES + k] = (bend * (s + 0.7 * t)).sin() + 2.0 + s * t;
        if grid.rational {
            slot[grid.stride + LANES + k] = 1.0 + 0.3 * (bend * s - t).cos();
        }
    }
    slot
}

fn ladders() -> impl Iterator<Item = Ladder> {
    let all = |rational| FACTORS.map(|factor| Ladder::new(factor, rational, Level::detect()));
    [false, true].into_iter().flat_map(all)
}

fn values(grid: &Grid, slot: &[f64], at: [f64; 2]) -> [f64; 2] {
    let n = Grid { rational: false, ..grid.clone() };
    let value = n.ratio_at(slot, at);
    if !grid.rational {
        return [value, 1.0];
    }
    [value, n.ratio_at(&slot[grid.stride..], at)]
}

#[test]
fn a_lowered_polynomial_is_off_by_what_is_told() {
    for ladder in ladders() {
        for k in 0..2 {
            for to in 1..ladder.rungs[k].degrees.len() {
                let (before, mut slot) = (ladder.whole(), gentle(ladder.whole(), 1.5));
                let whole = slot.clone();
                let off = ladder.lower([0; 2], k, to as u8, &mut slot);
                let mut rung = [0; 2];
                rung[k] = to as u8;
                let grid = ladder.grid(rung);
                assert!(grid.count < before.count && off[0] < 0.02, "{off:?}");
                let mut most = [0.0_f64; 2];
                for place in 0..400 {
                    let at = [(place / 20) as f64 / 19.0, (place % 20) as f64 / 19.0];
                    let (old, new) = (values(before, &whole, at), values(grid, &slot, at));
                    for c in 0..2 {
                        most[c] = most[c].max((old[c] - new[c]).abs());
                    }
                }
                for c in 0..2 {
                    let rounding = 1e-13;
                    assert!(most[c] <= off[c] + rounding, "{:?} {rung:?}", before.degree);
                    // And not by far less: the error is that of coefficients.
                    assert!(off[c] <= 300.0 * most[c] + 1e3 * rounding, "{off:?} {most:?}");
                }
            }
        }
    }
}

#[test]
fn differences_are_off_by_what_grows() {
    for ladder in ladders() {
        let grid = ladder.whole();
        for k in (0..2).filter(|k| ladder.has_lower([0; 2], *k)) {
            let (whole, mut slot) = (gentle(grid, 1.0), gentle(grid, 1.0));
            let mut h = vec![0.0; grid.stride];
            let off = ladder.lower([0; 2], k, 1, &mut slot)[0];
            let mut rung = [0; 2];
            rung[k] = 1;
            let lower = ladder.grid(rung);
            let error = off * ladder.growth([0; 2], k, 1) + 1e-12;
            let mu = 0.5;
            let [old, new] = [(grid, &whole), (lower, &slot)].map(|(grid, slot)| {
                let found = grid.differences(slot, mu, &mut h);
                let (n, m) = (grid.degree.s as f64, grid.degree.t as f64);
                [n * found.s[0], m * found.t[0], n * (n - 1.0) * found.ss, m * (m - 1.0) * found.tt]
            });
            // Coefficients of higher degrees lie nearer to the values: their least is not below that of lower ones.
            let (n, m) = (lower.degree.s as f64, lower.degree.t as f64);
            let times = [2.0 * n, 2.0 * m, 4.0 * n * (n - 1.0), 4.0 * m * (m - 1.0)];
            for c in 0..4 {
                let allowance = times[c] * error;
                assert!(new[c] <= old[c] + allowance, "{:?} {c} {new:?} {old:?}", grid.degree);
            }
        }
    }
}

#[test]
fn a_polynomial_of_low_degree_is_lowered_to_it() {
    for ladder in ladders() {
        let grid = ladder.whole();
        let mut slot = vec![0.0; grid.slot()];
        let width = grid.width();
        for k in 0..grid.count {
            let s = (k / width) as f64 / grid.degree.s.max(1) as f64;
            let t = (k % width) as f64 / grid.degree.t.max(1) as f64;
            slot[LANES + k] = 1.0 + 2.0 * s - 3.0 * t + s * t;
            if grid.rational {
                slot[grid.stride + LANES + k] = 1.0 + 0.5 * s;
            }
        }
        let mut rung = [0; 2];
        for k in (0..2).filter(|k| ladder.has_lower([0; 2], *k)) {
            let to = ladder.step(rung, k, &slot, 1.0, 1e-10).to;
            assert_eq!(ladder.rungs[k].degrees[to as usize], 8);
            let off = ladder.lower(rung, k, to, &mut slot);
            assert!(off[0] < 1e-10 && off[1] < 1e-10, "{off:?}");
            rung[k] = to;
        }
        let [n, _] = values(ladder.grid(rung), &slot, [0.25, 0.5]);
        assert!((n - (1.0 + 0.5 - 1.5 + 0.125)).abs() < 1e-10);
    }
}

#[test]
fn what_bends_is_kept_until_it_has_been_halved() {
    let ladder = Ladder::new(Bidegree { s: 9, t: 8 }, false, Level::detect());
    let mut slot = gentle(ladder.whole(), 6.0);
    let mut high = slot.clone();
    let mut halvings = 0;
    while let Step { to: 0, later } = ladder.step([0; 2], 0, &slot, 1.0, 1e-10) {
        assert!(later >= 1);
        ladder.whole().halve(0, &mut slot, &mut high);
        halvings += 1;
    }
    assert!((1..8).contains(&halvings), "{halvings}");
}

#[test]
fn levels_have_the_same_bits() {
    for rational in [false, true] {
        let of = |level: Level| {
            let ladder = Ladder::new(Bidegree { s: 9, t: 8 }, rational, level);
            let mut slot = gentle(ladder.whole(), 1.5);
            let first = ladder.lower([0; 2], 1, 1, &mut slot);
            let second = ladder.lower([0, 1], 0, 2, &mut slot);
            let grid = ladder.grid([2, 1]);
            (first, second, grid.n(&slot).to_vec(), grid.c(&slot).to_vec())
        };
        for level in Level::available() {
            assert_eq!(of(level), of(Level::detect()));
        }
    }
}
