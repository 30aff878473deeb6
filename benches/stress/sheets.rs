//! Difficult surfaces.

use std::f64::consts::TAU;

use super::curves::{degree, knot_at, running, scattered};
use super::design::Design;
use super::shapes::{Knotting, Random, Vector, along, cross, knots, norm, sub};

/// Degrees, knots and numbers of spans of both directions.
pub struct Frame {
    pub knotting: [Knotting; 2],
    pub degrees: [usize; 2],
    pub spans: [usize; 2],
}

impl Frame {
    pub fn random(r: &mut Random, most: usize) -> Self {
        let degrees = [degree(r), degree(r)];
        Self {
            knotting: [Knotting::Clamped; 2],
            degrees,
            spans: [r.whole(1, most), r.whole(1, most)],
        }
    }

    /// `place` gives the pole at shares of the way in u and v.
    pub fn net(
        &self,
        r: &mut Random,
        mut place: impl FnMut(f64, f64, &mut Random) -> Vector,
    ) -> Design {
        let knots = [0, 1].map(|k| knots(self.knotting[k], self.degrees[k], self.spans[k], r));
        let [m, n] = [0, 1].map(|k| knots[k].len() - self.degrees[k] - 1);
        let mut poles = Vec::with_capacity(m * n);
        for i in 0..m {
            for j in 0..n {
                let share = |k: usize, count: usize| k as f64 / (count - 1) as f64;
                poles.push(place(share(i, m), share(j, n), r));
            }
        }
        Design::surface(self.degrees, knots, poles)
    }

    /// A wavy sheet, or now and then random poles in a cube.
    pub fn sheet(&self, r: &mut Random) -> Design {
        let (wild, height, jitter) = (r.unit() < 0.15, r.scale(-1.5, 0.0), 0.15 * r.unit());
        self.net(r, |x, y, r| {
            let noise = r.vector();
            if wild {
                noise
            } else {
                [x + jitter * noise[0], y + jitter * noise[1], height * noise[2]]
            }
        })
    }
}

fn weighted(r: &mut Random, mut design: Design, e: f64) -> Design {
    design.weights = Some(scattered(r, design.poles.len(), e));
    design
}

fn sometimes_weighted(r: &mut Random, design: Design) -> Design {
    if r.unit() < 0.6 { design } else { weighted(r, design, 0.7) }
}

pub fn smooth(r: &mut Random) -> Design {
    Frame::random(r, 4).sheet(r)
}

pub fn rational(r: &mut Random) -> Design {
    let design = smooth(r);
    weighted(r, design, 1.0)
}

/// A band wound round a cylinder, its turns close to each other or overlapping.
pub fn ribbon(r: &mut Random) -> Design {
    let (turns, pitch, width) = (r.whole(2, 5), r.scale(-6.0, -0.7), r.scale(-1.0, 0.0));
    let jitter = if r.unit() < 0.5 { 0.0 } else { pitch * r.scale(-2.0, 0.0) };
    let overlap = r.between(0.2, 1.2);
    let frame = Frame {
        knotting: [Knotting::Clamped; 2],
        degrees: [r.whole(2, 3), r.whole(1, 3)],
        spans: [8 * turns, 1],
    };
    frame.net(r, |x, y, r| {
        let (angle, radius) = (x * turns as f64 * TAU, 1.0 + pitch * x);
        let height = width * (overlap * x * turns as f64 + y);
        along([radius * angle.cos(), radius * angle.sin(), height], r.vector(), jitter)
    })
}

/// The flank of a screw thread.
pub fn helicoid(r: &mut Random) -> Design {
    let (turns, pitch, inner) = (r.whole(2, 5), r.scale(-5.0, -0.5), r.between(0.0, 0.9));
    let frame = Frame {
        knotting: [Knotting::Clamped; 2],
        degrees: [r.whole(2, 3), r.whole(1, 2)],
        spans: [8 * turns, 1],
    };
    frame.net(r, |x, y, _| {
        let (angle, radius) = (x * turns as f64 * TAU, inner + (1.0 - inner) * y);
        [radius * angle.cos(), radius * angle.sin(), pitch * x * turns as f64]
    })
}

/// Rolled up like a carpet.
pub fn rolled(r: &mut Random) -> Design {
    let (turns, gap) = (r.whole(2, 6), r.scale(-5.0, -0.7));
    let frame = Frame {
        knotting: [Knotting::Clamped; 2],
        degrees: [r.whole(2, 3), r.whole(1, 3)],
        spans: [8 * turns, 1],
    };
    let design = frame.net(r, |x, y, _| {
        let (angle, radius) = (x * turns as f64 * TAU, 0.3 + gap * x * turns as f64);
        [radius * angle.cos(), radius * angle.sin(), 2.0 * y]
    });
    sometimes_weighted(r, design)
}

/// To and fro, the sheets close to each other.
pub fn folded(r: &mut Random) -> Design {
    let (turns, gap) = (r.between(1.5, 6.0), r.scale(-6.0, -1.0));
    let jitter = if r.unit() < 0.5 { 0.0 } else { gap * r.unit() };
    let frame = Frame { spans: [r.whole(4, 10), r.whole(1, 2)], ..Frame::random(r, 1) };
    let design = frame.net(r, |x, y, r| {
        let (fold, share) = ((x * turns).floor(), (x * turns).fract());
        let to = if fold % 2.0 == 0.0 { share } else { 1.0 - share };
        along([to, y, fold * gap], r.vector(), jitter)
    });
    sometimes_weighted(r, design)
}

/// A tube round a torus knot, thick enough that it may pass through itself.
pub fn knotted(r: &mut Random) -> Design {
    let winds = [[2, 3], [3, 2], [2, 5], [1, 4]][r.whole(0, 3)];
    let (thickness, radius) = (r.between(0.2, 0.6), r.scale(-1.5, -0.3));
    let frame = Frame {
        knotting: [Knotting::Clamped; 2],
        degrees: [3, 2],
        spans: [8 * winds[0] * winds[1], 5],
    };
    frame.net(r, |x, y, _| {
        let at = knot_at(x, winds, thickness);
        let ahead = sub(knot_at(x + 1e-4, winds, thickness), at);
        let side = cross(ahead, [0.1, 0.2, 1.0]);
        let up = cross(side, ahead);
        let (side, up) = (side.map(|c| c / norm(side)), up.map(|c| c / norm(up)));
        along(along(at, side, radius * (y * TAU).cos()), up, radius * (y * TAU).sin())
    })
}

pub fn smooth_weights(r: &mut Random) -> Design {
    let mut design = Frame::random(r, 3).sheet(r);
    let e = r.between(1.0, 3.0);
    let [a, b] = [running(r, design.counts[0], e), running(r, design.counts[1], e)];
    design.weights = Some(a.iter().flat_map(|x| b.iter().map(move |y| x * y)).collect());
    design
}

pub fn weights_of_three(r: &mut Random) -> Design {
    let design = smooth(r);
    weighted(r, design, 3.0)
}

/// All weights random, or a few far from the others.
pub fn weights_of_six(r: &mut Random) -> Design {
    let design = Frame::random(r, 3).sheet(r);
    if r.unit() < 0.6 {
        return weighted(r, design, 6.0);
    }
    let (odd, count) = (r.scale(-6.0, 6.0), design.poles.len());
    let weights = (0..count).map(|_| if r.unit() < 0.3 { odd } else { 1.0 }).collect();
    Design { weights: Some(weights), ..design }
}

/// Poles inside weigh much more than those of the border.
pub fn heavy_middle(r: &mut Random) -> Design {
    let frame = Frame { degrees: [r.whole(2, 5), r.whole(2, 4)], ..Frame::random(r, 2) };
    let mut design = frame.sheet(r);
    let (e, [m, n]) = (r.between(0.0, 6.0), design.counts);
    let inside = |i: usize, count: usize| f64::from(i > 0 && i + 1 < count);
    let exponent = |k: usize| 0.5 * e * (inside(k / n, m) + inside(k % n, n));
    design.weights =
        Some((0..m * n).map(|k| 10f64.powf(exponent(k) + r.between(-0.3, 0.3))).collect());
    design
}

pub fn high_degree(r: &mut Random) -> Design {
    let degrees = [r.whole(7, 31), r.whole(2, 12)];
    let spans = [if degrees[0] < 16 { r.whole(1, 2) } else { 1 }, 1];
    let design = Frame { knotting: [Knotting::Clamped; 2], degrees, spans }.sheet(r);
    sometimes_weighted(r, design)
}

pub fn high_degree_one_way(r: &mut Random) -> Design {
    let degrees = [1, r.whole(7, 31)];
    let design =
        Frame { knotting: [Knotting::Clamped; 2], degrees, spans: [r.whole(1, 2), 1] }.sheet(r);
    sometimes_weighted(r, design)
}

pub fn creases(r: &mut Random) -> Design {
    let both = r.unit() < 0.5;
    let second = if both { Knotting::Corners } else { Knotting::Clamped };
    let frame = Frame { knotting: [Knotting::Corners, second], ..Frame::random(r, 4) };
    let design = frame.sheet(r);
    sometimes_weighted(r, design)
}

/// Poles and rows of poles that are their neighbours.
pub fn cusps(r: &mut Random) -> Design {
    let mut design = smooth(r);
    let [m, n] = design.counts;
    for _ in 0..r.whole(1, 4) {
        let (a, b) = (r.whole(0, m * n - 1), r.whole(0, m * n - 1));
        design.poles[a] = design.poles[b];
        if r.unit() < 0.4 {
            let i = r.whole(0, m - 2);
            design.poles.copy_within(i * n..(i + 1) * n, (i + 1) * n);
        }
    }
    sometimes_weighted(r, design)
}

pub fn zero_spans(r: &mut Random) -> Design {
    let frame = Frame { knotting: [Knotting::ZeroSpans, Knotting::Clamped], ..Frame::random(r, 3) };
    let mut design = Frame { spans: [r.whole(2, 4), frame.spans[1]], ..frame }.sheet(r);
    let ([m, n], degree) = (design.counts, design.degrees[0]);
    // Rows that are one row: a span over which nothing moves in u.
    let first = r.whole(0, m - 1);
    for row in first + 1..(first + degree + 1).min(m) {
        design.poles.copy_within(first * n..(first + 1) * n, row * n);
    }
    design
}

/// Surfaces that are a point, a line, or have no width in one direction; and flat parallelograms.
pub fn strips(r: &mut Random) -> Design {
    let (kind, [a, b, c]) = (r.whole(0, 5), [r.vector(), r.vector(), r.vector()]);
    let frame = Frame::random(r, 3);
    let design = frame.net(r, |x, y, r| match kind {
        0 => a,
        1 => along(a, b, r.between(-1.0, 1.0)),
        2 => along(along(a, b, x), c, x * x),
        3 => along(along(a, b, x), r.vector(), 1e-13),
        4 => along(along(a, b, x), c, y),
        _ => along(a, b, x + y),
    });
    sometimes_weighted(r, design)
}

/// Long and thin, down to 1 : 1e-9 : 1e-12.
pub fn slivers(r: &mut Random) -> Design {
    let mut design = smooth(r);
    let scale = [1.0, r.scale(-9.0, 0.0), r.scale(-12.0, 0.0)];
    for pole in &mut design.poles {
        *pole = [0, 1, 2].map(|k| pole[k] * scale[k]);
    }
    design
}

/// Twisted a little, or much.
pub fn bilinear(r: &mut Random) -> Design {
    let frame = Frame { degrees: [1, 1], ..Frame::random(r, 3) };
    let twist = r.scale(-15.0, 0.0);
    let design = frame.net(r, |x, y, r| [x, y, twist * r.between(-1.0, 1.0)]);
    sometimes_weighted(r, design)
}

pub fn many_pieces(r: &mut Random) -> Design {
    let frame = Frame {
        knotting: [Knotting::Clamped; 2],
        degrees: [r.whole(1, 4), r.whole(1, 3)],
        spans: [r.whole(8, 18), r.whole(8, 18)],
    };
    let design = frame.sheet(r);
    sometimes_weighted(r, design)
}

pub fn unclamped(r: &mut Random) -> Design {
    let frame = Frame { knotting: [Knotting::Unclamped; 2], ..Frame::random(r, 4) };
    let design = frame.sheet(r);
    sometimes_weighted(r, design)
}

/// A closed tube, sometimes closed the other way too.
pub fn periodic(r: &mut Random) -> Design {
    let second = if r.unit() < 0.5 { Knotting::Periodic } else { Knotting::Clamped };
    let frame = Frame { knotting: [Knotting::Periodic, second], ..Frame::random(r, 1) };
    let frame = Frame { spans: [r.whole(3, 6), r.whole(3, 5)], ..frame };
    let mut design = frame.sheet(r);
    let [m, n] = design.counts;
    let own = [frame.spans[0], if second == Knotting::Periodic { frame.spans[1] } else { n }];
    let (height, phase) = (r.scale(-1.0, 0.3), r.between(0.0, TAU));
    for k in 0..m * n {
        let (i, j) = (k / n % own[0], k % n % own[1]);
        let angle = phase + TAU * i as f64 / own[0] as f64;
        let rise =
            if own[1] == n { j as f64 / n as f64 } else { (TAU * j as f64 / own[1] as f64).sin() };
        let radius = 1.0 + 0.4 * (TAU * j as f64 / own[1] as f64).cos();
        design.poles[k] = [radius * angle.cos(), radius * angle.sin(), height * rise];
    }
    design
}

pub fn wild_knots(r: &mut Random) -> Design {
    let knotting = [Knotting::Wild, Knotting::Narrow, Knotting::Short][r.whole(0, 2)];
    let frame = Frame { knotting: [knotting, Knotting::Clamped], ..Frame::random(r, 3) };
    let design = frame.sheet(r);
    sometimes_weighted(r, design)
}

pub fn flat(r: &mut Random) -> Design {
    let mut design = if r.unit() < 0.5 { smooth(r) } else { rational(r) };
    design.poles.iter_mut().for_each(|pole| pole[2] = 0.0);
    design
}
