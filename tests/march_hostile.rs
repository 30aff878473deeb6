//! Hostile pairs of surfaces: each sign change of one surface's height over the other, seen on a dense grid that shares nothing with the
//! search, lies on a branch, in a contact or in an undecided box; a lost one would be a wrong answer.

mod march_shapes;

use footpoint::march::{ContactKind, Intersection, MarchOptions, intersect};
use footpoint::surface::Surface;
use march_shapes::{Motion, P, moved, plane, revolved, sphere, torus};

struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }

    fn below(&mut self, n: usize) -> usize {
        ((self.next() * n as f64) as usize).min(n - 1)
    }

    fn motion(&mut self, factor: f64, far: f64) -> Motion {
        let q = std::array::from_fn(|_| self.within(-1.0, 1.0));
        Motion::new(q, factor, std::array::from_fn(|_| self.within(-far, far)))
    }

    /// A clamped knot vector with knots up to `most` times.
    fn knots(&mut self, degree: usize, spans: usize, most: usize) -> Vec<f64> {
        let mut k = vec![0.0; degree + 1];
        let mut x = 0.0;
        for _ in 1..spans {
            x += if self.below(5) == 0 { 1e-3 } else { self.within(0.2, 1.0) };
            let times = 1 + self.below(most.min(degree));
            k.extend(vec![x; times]);
        }
        k.extend(vec![x + self.within(0.2, 1.0); degree + 1]);
        k
    }
}

/// z = h(x, y) over the square [-1, 1]^2: x and y are the parameters.
fn graph(
    r: &mut Random,
    degree: [usize; 2],
    spans: [usize; 2],
    most: usize,
    height: f64,
) -> Surface {
    let [ku, kv] = [0, 1].map(|k| {
        let k = r.knots(degree[k], spans[k], most);
        let (a, b) = (k[0], k[k.len() - 1]);
        k.iter().map(|x| 2.0 * (x - a) / (b - a) - 1.0).collect::<Vec<f64>>()
    });
    let greville = |k: &[f64], p: usize| -> Vec<f64> {
        (0..k.len() - p - 1).map(|i| k[i + 1..=i + p].iter().sum::<f64>() / p as f64).collect()
    };
    let (gu, gv) = (greville(&ku, degree[0]), greville(&kv, degree[1]));
    let poles: Vec<P> = gu
        .iter()
        .flat_map(|&x| gv.iter().map(move |&y| (x, y)))
        .map(|(x, y)| [x, y, height * r.within(-1.0, 1.0)])
        .collect();
    Surface::new(&ku, &kv, degree[0], degree[1], &poles, gu.len(), gv.len(), None).unwrap()
}

/// Any sheet: wild knots, poles that meet, weights.
fn sheet(r: &mut Random, spread: f64, weights: f64) -> Surface {
    let (p, q) = (1 + r.below(4), 1 + r.below(4));
    let (a, b) = (1 + r.below(4), 1 + r.below(4));
    let (ku, kv) = (r.knots(p, a, p), r.knots(q, b, q));
    let (n, m) = (ku.len() - p - 1, kv.len() - q - 1);
    let mut poles: Vec<P> = Vec::new();
    for i in 0..n {
        for j in 0..m {
            let at = |k: usize, n: usize| 2.4 * k as f64 / (n - 1) as f64 - 1.2;
            let p = [
                at(i, n) + spread * r.within(-1.0, 1.0),
                at(j, m) + spread * r.within(-1.0, 1.0),
                r.within(-1.0, 1.0),
            ];
            let same = j > 0 && r.below(12) == 0;
            poles.push(if same { poles[poles.len() - 1] } else { p });
        }
    }
    let w: Vec<f64> = poles.iter().map(|_| weights.powf(r.within(-1.0, 1.0))).collect();
    Surface::new(&ku, &kv, p, q, &poles, n, m, (weights > 1.0).then_some(&w[..])).unwrap()
}

fn meet(a: &Surface, b: &Surface, motion: &Motion) -> Intersection {
    let options =
        MarchOptions { chord: 1e-3 * motion.factor, budget: 300_000, ..MarchOptions::default() };
    intersect(&motion.surface(a), &motion.surface(b), &options, &mut |_, _| false).unwrap()
}

fn distance(p: P, q: P) -> f64 {
    (0..3).map(|k| (p[k] - q[k]).powi(2)).sum::<f64>().sqrt()
}

fn to_chord(p: P, [a, b]: [P; 2]) -> f64 {
    let d: P = std::array::from_fn(|k| b[k] - a[k]);
    let n: f64 = d.iter().map(|x| x * x).sum();
    let t = if n > 0.0 {
        ((0..3).map(|k| (p[k] - a[k]) * d[k]).sum::<f64>() / n).clamp(0.0, 1.0)
    } else {
        0.0
    };
    distance(p, std::array::from_fn(|k| a[k] + t * d[k]))
}

/// Checks what was found of A and a surface on whose sides `f` has its signs (`None`: not over it): every sign change on a grid of A
/// is on a branch within 1e-3 of `unit`. How many there were.
fn audit(
    name: &str,
    a: &Surface,
    found: &Intersection,
    motion: &Motion,
    count: usize,
    unit: f64,
    f: impl Fn(P) -> Option<f64>,
) -> usize {
    let [u0, u1, v0, v1] = a.domain();
    let at = |i: f64, j: f64| {
        [
            (u0 + (u1 - u0) * i / count as f64).clamp(u0, u1),
            (v0 + (v1 - v0) * j / count as f64).clamp(v0, v1),
        ]
    };
    let value = |uv: [f64; 2]| f(a.evaluate(uv[0], uv[1]));
    let grid: Vec<Option<f64>> = (0..=count)
        .flat_map(|i| (0..=count).map(move |j| (i, j)))
        .map(|(i, j)| value(at(i as f64, j as f64)))
        .collect();
    let chords: Vec<[P; 2]> = found
        .branches
        .iter()
        .flat_map(|b| {
            b.points.windows(2).map(|w| [motion.back(w[0].point), motion.back(w[1].point)])
        })
        .collect();
    let mut seen = 0;
    for i in 0..=count {
        for j in 0..=count {
            for (di, dj) in [(1, 0), (0, 1)] {
                if i + di > count || j + dj > count {
                    continue;
                }
                let (x, y) = (grid[i * (count + 1) + j], grid[(i + di) * (count + 1) + j + dj]);
                let (Some(x), Some(y)) = (x, y) else { continue };
                if (x > 0.0) == (y > 0.0) || x.abs() < 1e-9 * unit || y.abs() < 1e-9 * unit {
                    continue;
                }
                let (mut low, mut high) = (0.0, 1.0);
                let on = |t: f64| at(i as f64 + t * di as f64, j as f64 + t * dj as f64);
                let mut is_over = true;
                for _ in 0..50 {
                    let t = 0.5 * (low + high);
                    match value(on(t)) {
                        Some(z) if (z > 0.0) == (x > 0.0) => low = t,
                        Some(_) => high = t,
                        None => is_over = false,
                    }
                }
                if !is_over {
                    continue;
                }
                let uv = on(low);
                let p = a.evaluate(uv[0], uv[1]);
                seen += 1;
                let on_branch = chords.iter().any(|&c| to_chord(p, c) <= 1.05e-3 * unit);
                let at_contact = found.contacts.iter().any(|c| {
                    distance(motion.back(c.place.point), p) <= c.radius / motion.factor + 1e-6
                });
                let is_open = found.undecided.iter().chain(&found.overlaps).any(|r| {
                    let s = 1e-9;
                    r.range[0] - s <= uv[0]
                        && uv[0] <= r.range[1] + s
                        && r.range[2] - s <= uv[1]
                        && uv[1] <= r.range[3] + s
                });
                assert!(
                    on_branch || at_contact || is_open,
                    "{name}: nothing at {uv:?}, {p:?}; proven {}, {} branches, {} contacts, {} undecided, exhausted {}",
                    found.is_proven,
                    found.branches.len(),
                    found.contacts.len(),
                    found.undecided.len(),
                    found.exhausted
                );
            }
        }
    }
    // Points are on both.
    for b in &found.branches {
        // An ulp of a parameter is worth that much on the wildest sheets.
        let size = motion.shift.iter().fold(motion.factor, |m, x| x.abs().max(m));
        assert!(b.gap <= 1e-9 * size, "{name}: gap {:e}", b.gap);
        for p in &b.points {
            let x = a.evaluate(p.uv[0].clamp(u0, u1), p.uv[1].clamp(v0, v1));
            if let Some(z) = f(x) {
                assert!(z.abs() < 1e-8, "{name}: {z:e} off");
            }
        }
    }
    seen
}

fn over(b: &Surface) -> impl Fn(P) -> Option<f64> + '_ {
    move |p: P| (p[0].abs() <= 1.0 && p[1].abs() <= 1.0).then(|| p[2] - b.evaluate(p[0], p[1])[2])
}

/// Pairs of each kind: 60, or as many as ROUNDS says.
fn rounds() -> usize {
    std::env::var("ROUNDS").map_or(60, |text| text.parse().unwrap())
}

#[test]
fn no_branch_of_random_sheets_is_lost() {
    let mut r = Random(77);
    let (mut proven, mut seen) = (0, 0);
    for round in 0..rounds() {
        let (p, q) = (1 + r.below(4), 1 + r.below(4));
        let (n, m) = (1 + r.below(5), 1 + r.below(5));
        let most = 1 + r.below(3);
        let b = graph(&mut r, [p, q], [n, m], most, 0.7);
        let (spread, weights) = (r.within(0.0, 1.2), [1.0, 3.0, 30.0][r.below(3)]);
        let a = sheet(&mut r, spread, weights);
        let far = [0.0, 10.0][r.below(2)];
        let factor = [1.0, 1e-6, 1e6][r.below(3)];
        let motion = r.motion(factor, far * factor);
        let found = meet(&a, &b, &motion);
        proven += usize::from(found.is_proven);
        seen += audit(&format!("round {round}"), &a, &found, &motion, 100, 1.0, over(&b));
    }
    println!("{proven} of {} proven, {seen} sign changes", rounds());
    assert!(100 * proven >= 98 * rounds() && seen > 100 * rounds());
}

#[test]
fn no_branch_of_closed_surfaces_with_seams_and_poles_is_lost() {
    let mut r = Random(78);
    let tip = revolved(&[[0.0, 0.5, 1.0], [0.6, -0.5, 1.0]], 1, &[0.0, 0.0, 1.0, 1.0]);
    // The last two tori meet themselves in a point and in a circle.
    let own = [sphere(0.6), tip, torus(0.6, 0.25), torus(0.3, 0.3), torus(0.3, 0.5)];
    let (mut proven, mut seen) = (0, 0);
    for round in 0..rounds() {
        let b = graph(&mut r, [3, 3], [4, 4], 2, 0.7);
        let pick = r.below(5);
        let a = moved(&own[pick], &r.motion(1.0, 0.3));
        let factor = [1.0, 1e-6, 1e6][r.below(3)];
        let motion = r.motion(factor, 0.0);
        let found = meet(&a, &b, &motion);
        proven += usize::from(found.is_proven);
        let name = format!("round {round}, shape {pick}");
        seen += audit(&name, &a, &found, &motion, 120, 1.0, over(&b));
    }
    println!("{proven} of {} proven, {seen} sign changes", rounds());
    assert!(100 * proven >= 98 * rounds() && seen > 100 * rounds());
}

/// A Bezier graph z = h(x, y), h a polynomial in monomials (i, j, c), over [-1, 1]^2; degree n both ways.
fn polynomial(n: usize, terms: &[(usize, usize, f64)]) -> Surface {
    // Blossom of x^i at n arguments, k of which are 1 and the others -1: mean over subsets of the products.
    let blossom = |i: usize, k: usize| -> f64 {
        // coefficient of y^i in (1 + y)^k (1 - y)^(n - k), over C(n, i)
        let choose =
            |n: usize, k: usize| (0..k).fold(1.0, |c, j| c * (n - j) as f64 / (j + 1) as f64);
        let mut sum = 0.0;
        for a in 0..=i {
            if a <= k && i - a <= n - k {
                let sign = if (i - a).is_multiple_of(2) { 1.0 } else { -1.0 };
                sum += sign * choose(k, a) * choose(n - k, i - a);
            }
        }
        sum / choose(n, i)
    };
    let mut poles = Vec::new();
    for k in 0..=n {
        for l in 0..=n {
            let z: f64 = terms.iter().map(|&(i, j, c)| c * blossom(i, k) * blossom(j, l)).sum();
            poles.push([blossom(1, k), blossom(1, l), z]);
        }
    }
    let knots: Vec<f64> = (0..2 * n + 2).map(|i| if i <= n { -1.0 } else { 1.0 }).collect();
    Surface::new(&knots, &knots, n, n, &poles, n + 1, n + 1, None).unwrap()
}

/// Exponents of x and y, and the factor.
type Terms = Vec<(usize, usize, f64)>;

/// Terms of a difference, the contacts, and how many branches are open, closed, tangential.
type Singular<'a> = (&'a str, Terms, &'a [ContactKind], [usize; 3]);

#[test]
fn bicubics_that_touch_and_branch_are_classified() {
    use ContactKind::{Crossing, Degenerate, Touching};
    let circle =
        vec![(4, 0, 1.0), (0, 4, 1.0), (2, 2, 2.0), (2, 0, -0.5), (0, 2, -0.5), (0, 0, 0.0625)];
    let cases: [Singular; 10] = [
        ("four arms", vec![(2, 0, 1.0), (0, 2, -1.0)], &[Crossing], [4, 0, 0]),
        ("four arms at a small angle", vec![(2, 0, 1.0), (0, 2, -0.01)], &[Crossing], [4, 0, 0]),
        ("cusp", vec![(3, 0, 1.0), (0, 2, -1.0)], &[Degenerate], [2, 0, 0]),
        ("touch", vec![(2, 0, 1.0), (0, 2, 1.0)], &[Touching], [0, 0, 0]),
        ("tangent line", vec![(2, 0, 1.0)], &[], [1, 0, 1]),
        ("tangent circle", circle, &[], [0, 1, 1]),
        ("node with a loop", vec![(3, 0, 1.0), (2, 0, 0.5), (0, 2, -1.0)], &[Crossing], [3, 0, 0]),
        (
            "touch beside a curve",
            vec![(3, 0, 1.0), (2, 0, -0.5), (0, 2, -1.0)],
            &[Touching],
            [1, 0, 0],
        ),
        ("thinner than rounding", vec![(2, 0, 1.0), (0, 0, -1e-14)], &[], [1, 0, 1]),
        ("nearly four arms", vec![(2, 0, 1.0), (0, 2, -1.0), (0, 0, 1e-9)], &[], [2, 0, 0]),
    ];
    for (name, terms, kinds, counts) in &cases {
        each_position(terms, 2_000_000, |found| {
            let seen: Vec<_> = found.contacts.iter().map(|c| c.kind).collect();
            let closed = found.branches.iter().filter(|b| b.is_closed()).count();
            let tangential = found.branches.iter().filter(|b| b.is_tangential).count();
            assert_eq!(&seen, kinds, "{name}");
            assert_eq!([found.branches.len() - closed, closed, tangential], *counts, "{name}");
            assert!(found.undecided.is_empty(), "{name}");
            assert_eq!(found.is_proven, *name == "nearly four arms", "{name}");
        });
    }
}

#[test]
fn contact_of_high_order_and_near_coincidence_are_honest() {
    let cases: [(&str, Terms); 12] = [
        ("touch of fourth order", vec![(4, 0, 1.0), (0, 4, 1.0)]),
        ("six arms", vec![(3, 0, 1.0), (1, 2, -3.0)]),
        ("eight arms", vec![(3, 1, 1.0), (1, 3, -1.0)]),
        ("tangent line of odd order", vec![(3, 0, 1.0)]),
        ("tangent line and a crossing line", vec![(2, 1, 1.0)]),
        ("tacnode", vec![(0, 2, 1.0), (4, 0, -1.0)]),
        ("rhamphoid cusp", vec![(0, 2, 1.0), (2, 1, -2.0), (4, 0, 1.0), (5, 0, -1.0)]),
        ("nearly a cusp", vec![(3, 0, 1.0), (0, 2, -1.0), (1, 0, -1e-6)]),
        ("two lines", vec![(2, 0, 1.0), (0, 0, -1e-10)]),
        ("apart by 1e-10", vec![(0, 0, 1e-10)]),
        ("differ by 1e-9", vec![(2, 0, 1e-9), (0, 2, -2e-9), (1, 1, 1e-9), (0, 0, 1e-10)]),
        ("differ by 1e-12", vec![(2, 0, 1e-12), (0, 2, 2e-12), (1, 1, 1e-12), (0, 0, -1e-12)]),
    ];
    for (name, terms) in &cases {
        // All that is not on a branch is in a contact or an undecided box, also when the budget is short: `audit`.
        each_position(terms, 20_000, |found| assert!(!found.is_proven, "{name}"));
    }
}

/// Two sheets that differ by a polynomial, with the singular place in a middle of halving and beside it, as they are and turned.
fn each_position(terms: &[(usize, usize, f64)], budget: u64, check: impl Fn(&Intersection)) {
    let base = [(1, 0, 0.3), (2, 0, 0.2), (1, 1, -0.1), (0, 3, 0.1)];
    let b = polynomial(6, &base);
    let whole = polynomial(6, &[&base[..], terms].concat());
    for (shift, motion) in [(0.0, Random(5).motion(1.0, 1.0)), (0.137, Motion::NONE)] {
        let a = if shift > 0.0 { part(&whole, shift) } else { whole.clone() };
        let options = MarchOptions { chord: 1e-3, budget, ..MarchOptions::default() };
        let (x, y) = (motion.surface(&a), motion.surface(&b));
        let found = intersect(&x, &y, &options, &mut |_, _| false).unwrap();
        let value = |p: P| {
            terms.iter().map(|&(i, j, c)| c * p[0].powi(i as i32) * p[1].powi(j as i32)).sum()
        };
        audit("polynomial", &a, &found, &motion, 100, 1.0, |p| Some(value(p)));
        check(&found);
    }
}

/// The part of a surface over [-1 + shift / 2, 1 - shift]^2.
fn part(s: &Surface, shift: f64) -> Surface {
    s.part([-1.0 + 0.5 * shift, 1.0 - shift, -1.0 + 0.3 * shift, 1.0 - 0.7 * shift]).unwrap()
}

#[test]
fn tiny_surfaces_beside_large_ones_lose_nothing() {
    let mut r = Random(9);
    for round in 0..20 {
        let b = graph(&mut r, [3, 3], [6, 6], 2, 0.3);
        let size = [1e-2, 1e-4, 1e-6, 1e-8][round % 4];
        let (x, y) = (r.within(-0.9, 0.9), r.within(-0.9, 0.9));
        let mut place = r.motion(size, 0.0);
        place.shift = b.evaluate(x, y);
        let level = plane([-1.0; 3], [2.0, 0.1, 0.0], [0.0, 2.0, 1.0]);
        let a = moved(&[sphere(1.0), torus(1.0, 0.4), level][r.below(3)], &place);
        let motion = r.motion(1.0, 0.0);
        let options =
            MarchOptions { chord: 1e-3 * size, budget: 300_000, ..MarchOptions::default() };
        let (p, q) = (motion.surface(&a), motion.surface(&b));
        let found = intersect(&p, &q, &options, &mut |_, _| false).unwrap();
        let seen = audit(&format!("round {round}"), &a, &found, &motion, 80, size, over(&b));
        assert!(seen > 0 && !found.branches.is_empty(), "round {round}");
        // Parameters of the large surface have an ulp of 1e-16: what it is worth beside 1e-8 is rounding too.
        assert!(found.is_proven || size < 1e-7, "round {round}");
    }
}
