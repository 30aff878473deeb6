//! Difficult curves.

use std::f64::consts::TAU;

use super::design::Design;
use super::shapes::{Knotting, Random, Vector, along, knots};

pub const HALF: f64 = std::f64::consts::FRAC_1_SQRT_2;

/// Mostly cubic.
pub fn degree(r: &mut Random) -> usize {
    [1, 2, 2, 3, 3, 3, 3, 4, 5, r.whole(6, 9)][r.whole(0, 9)]
}

/// Weights that run smoothly from 10^-e to 10^e, or up and down between them.
pub fn running(r: &mut Random, count: usize, e: f64) -> Vec<f64> {
    let (turns, phase) = (r.between(0.2, 1.5), r.between(0.0, TAU));
    let at = |i: usize| (phase + turns * TAU * i as f64 / count as f64).sin();
    (0..count).map(|i| 10f64.powf(e * at(i))).collect()
}

pub fn scattered(r: &mut Random, count: usize, e: f64) -> Vec<f64> {
    (0..count).map(|_| r.scale(-e, e)).collect()
}

/// A curve over random knots; `place` gives the pole at a share of the way.
fn curve(
    r: &mut Random,
    knotting: Knotting,
    degree: usize,
    spans: usize,
    mut place: impl FnMut(f64, &mut Random) -> Vector,
) -> Design {
    let knots = knots(knotting, degree, spans, r);
    let count = knots.len() - degree - 1;
    let poles = (0..count).map(|i| place(i as f64 / (count - 1) as f64, r)).collect();
    Design::curve(degree, knots, poles)
}

/// A wave, or a walk through a cube.
fn walk(x: f64, r: &mut Random, wild: bool) -> Vector {
    let noise = r.vector();
    if wild { noise } else { [2.0 * x, 0.3 * noise[1], 0.2 * noise[2]] }
}

fn plain(r: &mut Random, knotting: Knotting, degree: usize, spans: usize) -> Design {
    let wild = r.unit() < 0.4;
    curve(r, knotting, degree, spans, |x, r| walk(x, r, wild))
}

pub fn smooth(r: &mut Random) -> Design {
    let (degree, spans) = (degree(r), r.whole(1, 12));
    plain(r, Knotting::Clamped, degree, spans)
}

fn weighted(r: &mut Random, mut design: Design, e: f64) -> Design {
    design.weights = Some(scattered(r, design.poles.len(), e));
    design
}

pub fn rational(r: &mut Random) -> Design {
    let design = smooth(r);
    weighted(r, design, 1.0)
}

pub fn smooth_weights(r: &mut Random) -> Design {
    let mut design = smooth(r);
    design.weights = Some(running(r, design.poles.len(), 6.0));
    design
}

pub fn random_weights(r: &mut Random) -> Design {
    let design = smooth(r);
    weighted(r, design, 6.0)
}

/// Turns close to each other.
pub fn thread(r: &mut Random) -> Design {
    let (turns, pitch) = (r.whole(2, 12), r.scale(-7.0, -0.5));
    let jitter = if r.unit() < 0.5 { 0.0 } else { pitch * r.scale(-2.0, 0.0) };
    let degree = r.whole(2, 4);
    curve(r, Knotting::Clamped, degree, 12 * turns, |x, r| {
        let angle = x * turns as f64 * TAU;
        along([angle.cos(), angle.sin(), pitch * x * turns as f64], r.vector(), jitter)
    })
}

pub fn spiral(r: &mut Random) -> Design {
    let (turns, gap) = (r.whole(2, 10), r.scale(-6.0, -0.7));
    let degree = r.whole(2, 4);
    curve(r, Knotting::Clamped, degree, 12 * turns, |x, _| {
        let (angle, radius) = (x * turns as f64 * TAU, 1.0 + gap * x * turns as f64);
        [radius * angle.cos(), radius * angle.sin(), 0.0]
    })
}

/// On a torus, around which it winds; turns pass each other closely where the torus is thin.
pub fn knot_at(x: f64, winds: [usize; 2], thickness: f64) -> Vector {
    let [a, b] = winds.map(|w| x * TAU * w as f64);
    let radius = 1.0 + thickness * b.cos();
    [radius * a.cos(), radius * a.sin(), thickness * b.sin()]
}

pub fn knotted(r: &mut Random) -> Design {
    let (winds, thickness) = ([r.whole(2, 5), r.whole(3, 7)], r.scale(-3.0, -0.4));
    let degree = r.whole(2, 4);
    curve(r, Knotting::Clamped, degree, 12 * winds[1], |x, _| knot_at(x, winds, thickness))
}

pub fn high_degree(r: &mut Random) -> Design {
    let (degree, spans) = (r.whole(7, 31), r.whole(1, 4));
    let design = plain(r, Knotting::Clamped, degree, spans);
    if r.unit() < 0.5 { design } else { weighted(r, design, 0.7) }
}

pub fn creases(r: &mut Random) -> Design {
    let (degree, spans) = (degree(r), r.whole(2, 9));
    let design = plain(r, Knotting::Corners, degree, spans);
    if r.unit() < 0.6 { design } else { weighted(r, design, 1.0) }
}

/// Some poles are one pole.
pub fn cusps(r: &mut Random) -> Design {
    let mut design = smooth(r);
    let last = design.poles.len() - 1;
    for _ in 0..r.whole(1, 3) {
        let (i, j) = (r.whole(0, last), r.whole(0, last));
        design.poles[i] = design.poles[j];
        let i = r.whole(0, last - 1);
        design.poles[i + 1] = design.poles[i];
    }
    if r.unit() < 0.6 { design } else { weighted(r, design, 1.0) }
}

/// Spans over which nothing moves, and spans of almost no parameters.
pub fn zero_spans(r: &mut Random) -> Design {
    let (degree, spans) = (degree(r), r.whole(3, 9));
    let mut design = plain(r, Knotting::ZeroSpans, degree, spans);
    let count = design.poles.len();
    for _ in 0..r.whole(1, 2) {
        let first = r.whole(0, count - 1);
        let one = design.poles[first];
        design.poles[first..(first + degree + 1).min(count)].fill(one);
    }
    design
}

/// Points, lines, and lines run to and fro.
pub fn degenerate(r: &mut Random) -> Design {
    let (degree, spans, kind) = (degree(r), r.whole(1, 6), r.whole(0, 3));
    let (a, b) = (r.vector(), r.vector());
    let design = curve(r, Knotting::Clamped, degree, spans, |x, r| match kind {
        0 => a,
        1 => along(a, b, r.between(-1.0, 1.0)),
        2 => along(a, b, x),
        _ => along(along(a, b, x), r.vector(), 1e-13),
    });
    if r.unit() < 0.7 { design } else { weighted(r, design, 2.0) }
}

/// The full circle of quadrants: knots, poles, weights.
pub fn circle() -> (Vec<f64>, [[f64; 2]; 9], [f64; 9]) {
    let ring = [
        [1., 0.],
        [1., 1.],
        [0., 1.],
        [-1., 1.],
        [-1., 0.],
        [-1., -1.],
        [0., -1.],
        [1., -1.],
        [1., 0.],
    ];
    let knots = vec![0., 0., 0., 0.25, 0.25, 0.5, 0.5, 0.75, 0.75, 1., 1., 1.];
    (knots, ring, [1., HALF, 1., HALF, 1., HALF, 1., HALF, 1.])
}

/// A circle run twice, or a curve run to its end and back.
pub fn double_covered(r: &mut Random) -> Design {
    if r.unit() < 0.4 {
        let (knots, ring, weights) = circle();
        let twice = knots[..11].iter().copied().chain(knots[3..].iter().map(|u| u + 1.0));
        let poles = ring.iter().chain(&ring[1..]).map(|[x, y]| [*x, *y, 0.0]).collect();
        let mut design = Design::curve(2, twice.collect(), poles);
        design.weights = Some(weights.iter().chain(&weights[1..]).copied().collect());
        design.special = vec![[0.0; 3], [0.0, 0.0, r.between(-2.0, 2.0)]];
        return design;
    }
    let mut design = smooth(r);
    let (degree, count) = (design.degrees[0], design.poles.len());
    let back = (0..count - 1).rev().map(|i| design.poles[i]).collect::<Vec<_>>();
    design.poles.extend(back);
    let end = design.knots[0][count];
    let forth = design.knots[0][..count + degree].to_vec();
    let mirrored = (0..count).rev().map(|i| 2.0 * end - design.knots[0][i]);
    Design::curve(degree, forth.into_iter().chain(mirrored).collect(), design.poles)
}

pub fn conic(r: &mut Random) -> Design {
    let (knots, ring, weights) = circle();
    let (a, b) = (r.scale(-2.0, 2.0), if r.unit() < 0.5 { 1.0 } else { r.scale(-3.0, 0.0) });
    let tilt = r.direction();
    let poles = ring.iter().map(|[x, y]| [a * x, a * b * y, a * b * y * tilt[2]]).collect();
    let mut design = Design::curve(2, knots, poles);
    design.weights = Some(weights.to_vec());
    design.special = vec![[0.0; 3], [0.0, -a * b * tilt[2], a * b]];
    design
}

/// A circle whose poles are off by a little: almost a continuum of feet at its centre.
pub fn almost_circle(r: &mut Random) -> Design {
    let (mut design, off) = (conic(r), r.scale(-14.0, -1.5));
    let size = design.extent().0;
    design.poles.iter_mut().for_each(|pole| *pole = along(*pole, r.vector(), off * size));
    if r.unit() < 0.5 {
        let end = design.poles.len() - 1;
        design.poles[end] = design.poles[0];
    }
    design
}

pub fn unclamped(r: &mut Random) -> Design {
    let (degree, spans) = (degree(r), r.whole(1, 9));
    let design = plain(r, Knotting::Unclamped, degree, spans);
    if r.unit() < 0.6 { design } else { weighted(r, design, 1.0) }
}

/// Closed, with knots that go on beyond the domain; the poles repeat.
pub fn periodic(r: &mut Random) -> Design {
    let (degree, spans) = (degree(r), r.whole(3, 12));
    let mut design = plain(r, Knotting::Periodic, degree, spans);
    for i in spans..design.poles.len() {
        design.poles[i] = design.poles[i % spans];
    }
    if r.unit() < 0.4 {
        let weights = scattered(r, spans, 1.0);
        design.weights = Some((0..design.poles.len()).map(|i| weights[i % spans]).collect());
    }
    design
}

pub fn wild_knots(r: &mut Random) -> Design {
    let knotting = [Knotting::Wild, Knotting::Narrow, Knotting::Short][r.whole(0, 2)];
    let (degree, spans) = (degree(r), r.whole(1, 9));
    let design = plain(r, knotting, degree, spans);
    if r.unit() < 0.6 { design } else { weighted(r, design, 0.5) }
}

const TAME: [fn(&mut Random) -> Design; 5] = [smooth, rational, creases, cusps, conic];

pub fn sized(r: &mut Random) -> Design {
    let size = r.scale(-9.0, 9.0);
    TAME[r.whole(0, TAME.len() - 1)](r).moved(size, [0.0; 3])
}

pub fn offset(r: &mut Random) -> Design {
    let size = r.scale(-3.0, 3.0);
    let center = r.direction().map(|x| x * size * r.scale(5.0, 8.0));
    TAME[r.whole(0, TAME.len() - 1)](r).moved(size, center)
}

pub fn flat(r: &mut Random) -> Design {
    let mut design = if r.unit() < 0.5 { smooth(r) } else { rational(r) };
    design.poles.iter_mut().for_each(|pole| pole[2] = 0.0);
    design
}
