//! Surfaces with collapsed edges, and those of revolution.

use std::f64::consts::{PI, TAU};

use super::curves::{HALF, circle, scattered};
use super::design::Design;
use super::shapes::{Random, along};
use super::sheets::Frame;

/// A meridian of (radius, height, weight) turned about the z axis.
fn turned(knots_v: Vec<f64>, degree_v: usize, meridian: &[[f64; 3]]) -> Design {
    let (knots, ring, ring_weights) = circle();
    let (mut poles, mut weights) = (Vec::new(), Vec::new());
    for ([x, y], w) in ring.iter().zip(ring_weights) {
        for [radius, z, weight] in meridian {
            poles.push([radius * x, radius * y, *z]);
            weights.push(w * weight);
        }
    }
    let design = Design::surface([2, degree_v], [knots, knots_v], poles);
    Design { weights: Some(weights), special: vec![[0.0; 3]], ..design }
}

/// Sphere, cylinder, cone, torus or a bowl; turned and moved now and then.
pub fn primitive(r: &mut Random) -> Design {
    let (ring_knots, ring, ring_weights) = circle();
    let line = || vec![0., 0., 1., 1.];
    let mut design = match r.whole(0, 4) {
        0 => {
            let half = [[0., -1., 1.], [1., -1., HALF], [1., 0., 1.], [1., 1., HALF], [0., 1., 1.]];
            turned(vec![0., 0., 0., 1., 1., 2., 2., 2.], 2, &half)
        }
        1 => turned(line(), 1, &[[1., -1., 1.], [1., 1., 1.]]),
        2 => turned(line(), 1, &[[0., 0., 1.], [r.scale(-2.0, 1.0), 1., 1.]]),
        3 => {
            let a = r.between(0.1, 1.3);
            let meridian: Vec<[f64; 3]> =
                ring.iter().zip(ring_weights).map(|([x, z], w)| [1.0 + a * x, a * z, w]).collect();
            turned(ring_knots, 2, &meridian)
        }
        _ => {
            let bowl = [
                [0., -1., 1.],
                [r.between(0.1, 2.0), -1., r.scale(-1.0, 1.0)],
                [1., r.between(-1.0, 1.0), 1.],
            ];
            turned(vec![0., 0., 0., 1., 1., 1.], 2, &bowl)
        }
    };
    design.special.extend((0..4).map(|_| [0., 0., r.between(-1.5, 1.5)]));
    if r.unit() < 0.4 {
        let tilt = |[x, y, z]: [f64; 3]| [0.6 * x - 0.8 * z, y, 0.8 * x + 0.6 * z];
        design.poles.iter_mut().chain(&mut design.special).for_each(|p| *p = tilt(*p));
        design = design.moved(r.scale(-1.0, 1.0), r.vector());
    }
    design
}

/// The same with poles, or radii only, off by a little.
pub fn almost_primitive(r: &mut Random) -> Design {
    let (mut design, off) = (primitive(r), r.scale(-14.0, -1.5));
    let (size, even) = (design.extent().0, r.unit() < 0.4);
    for pole in &mut design.poles {
        let away = if even { [0.0, 0.0, pole[0]] } else { r.vector().map(|x| x * size) };
        *pole = along(*pole, away, off);
    }
    design
}

/// The poles of a side: 0 and 1 first and last row, 2 and 3 first and last column.
fn side(counts: [usize; 2], which: usize) -> Vec<usize> {
    let [m, n] = counts;
    let is_there =
        |k: &usize| [k / n == 0, k / n == m - 1, k.is_multiple_of(n), k % n == n - 1][which];
    (0..m * n).filter(is_there).collect()
}

/// One or two sides of a sheet drawn to a point, within `spread`.
fn drawn_together(r: &mut Random, spread: f64) -> Design {
    let mut design = Frame::random(r, 3).sheet(r);
    for _ in 0..r.whole(1, 2) {
        let poles = side(design.counts, r.whole(0, 3));
        let tip = design.poles[poles[0]];
        for k in poles {
            design.poles[k] = along(tip, r.vector(), spread);
        }
    }
    if r.unit() < 0.4 {
        design.weights = Some(scattered(r, design.poles.len(), 1.0));
    }
    design
}

pub fn collapsed(r: &mut Random) -> Design {
    drawn_together(r, 0.0)
}

pub fn almost_collapsed(r: &mut Random) -> Design {
    let spread = r.scale(-13.5, -7.0);
    drawn_together(r, spread)
}

/// Cones, domes, octants and caps with tips at one or both ends, of all degrees and weights.
pub fn cone_or_dome(r: &mut Random) -> Design {
    let (kind, turn, height) = (r.whole(0, 3), r.between(0.2, 1.2) * TAU, r.scale(-1.0, 0.5));
    let jitter = if r.unit() < 0.6 { 0.0 } else { r.scale(-4.0, -1.0) };
    let (both, across) = (kind == 3, r.unit() < 0.5);
    let frame = Frame::random(r, 3);
    let mut design = frame.net(r, |u, v, r| {
        let (x, y) = if across { (u, v) } else { (v, u) };
        let radius = match kind {
            _ if x == 0.0 || (both && x == 1.0) => 0.0,
            0 => x,
            1 => (0.5 * PI * x).sin(),
            2 => x * x,
            _ => (PI * x).sin(),
        };
        let z = if kind == 0 { height * x } else { height * (0.5 * PI * x).cos() };
        let (angle, noise) = (turn * y, r.vector());
        let around = [radius * angle.cos(), radius * angle.sin(), z];
        along(around, noise, jitter * radius)
    });
    if r.unit() < 0.5 {
        let e = r.between(0.0, 3.0);
        design.weights = Some(scattered(r, design.poles.len(), e));
    }
    design.special = vec![[0.0, 0.0, r.between(-1.0, 1.0)]];
    design
}
