//! Random curves and surfaces of every difficult family, reproducible from a seed.

#![allow(dead_code, reason = "each test file uses its own part")]

pub mod asked;

use footpoint::curve::Curve;
use footpoint::surface::Surface;

pub const EPS: f64 = f64::EPSILON;

pub type Vector = [f64; 3];

pub fn sub(a: Vector, b: Vector) -> Vector {
    [0, 1, 2].map(|k| a[k] - b[k])
}

pub fn along(a: Vector, b: Vector, t: f64) -> Vector {
    [0, 1, 2].map(|k| a[k] + t * b[k])
}

pub fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

pub fn norm(a: Vector) -> f64 {
    a.iter().fold(0.0, |norm: f64, x| norm.hypot(*x))
}

/// Steele, Lea, Flood, *Fast splittable pseudorandom number generators*, 2014.
pub struct Random(pub u64);

impl Random {
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// In [0, 1).
    pub fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1u64 << 53) as f64
    }

    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// `low..=high`
    pub fn whole(&mut self, low: usize, high: usize) -> usize {
        low + (self.bits() % (high - low + 1) as u64) as usize
    }

    /// 10 to a uniform power.
    pub fn scale(&mut self, low: f64, high: f64) -> f64 {
        10f64.powf(self.between(low, high))
    }

    /// In the cube [-1, 1]^3.
    pub fn vector(&mut self) -> Vector {
        [0; 3].map(|_| self.between(-1.0, 1.0))
    }

    pub fn direction(&mut self) -> Vector {
        loop {
            let v = self.vector();
            let length = norm(v);
            if (0.1..=1.0).contains(&length) {
                return v.map(|x| x / length);
            }
        }
    }
}

/// How the knots lie.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Knotting {
    /// Clamped, random steps.
    Clamped,
    /// No repeats, not even at the ends.
    Unclamped,
    /// Unclamped and closed: steps and poles repeat.
    Periodic,
    /// Every inner knot as often as the degree.
    Corners,
    /// Inner knots of any multiplicity, and a span of 1e-10.
    ZeroSpans,
    /// Steps from 1e-12 to 1.
    Wild,
    /// The domain [1000, 1000.001].
    Narrow,
    /// The domain [0, 1e-9].
    Short,
}

/// A kind of shapes, all with the same difficulty.
#[derive(Clone, Copy, Debug)]
pub struct Family {
    pub name: &'static str,
    pub knotting: Knotting,
    pub degrees: [usize; 2],
    /// Weights are 10^-x to 10^x.
    pub weights: f64,
    /// Sizes are 10^-x to 10^x.
    pub sizes: f64,
    /// Distance from the origin.
    pub offset: f64,
    /// Share of poles that are copies of their neighbours: collapsed edges, vanishing derivatives.
    pub copies: f64,
    /// All poles in a plane, so that most queries in it have distance zero or a foot on a fold.
    pub is_flat: bool,
}

const PLAIN: Family = Family {
    name: "plain",
    knotting: Knotting::Clamped,
    degrees: [1, 5],
    weights: 0.0,
    sizes: 0.0,
    offset: 0.0,
    copies: 0.0,
    is_flat: false,
};

pub const FAMILIES: [Family; 18] = [
    PLAIN,
    Family { name: "rational", weights: 1.0, ..PLAIN },
    Family { name: "weights 1e-3..1e3", weights: 3.0, ..PLAIN },
    Family { name: "weights 1e-6..1e6", weights: 6.0, ..PLAIN },
    Family { name: "unclamped", knotting: Knotting::Unclamped, ..PLAIN },
    Family { name: "unclamped rational", knotting: Knotting::Unclamped, weights: 1.0, ..PLAIN },
    Family { name: "periodic", knotting: Knotting::Periodic, ..PLAIN },
    Family { name: "periodic rational", knotting: Knotting::Periodic, weights: 1.0, ..PLAIN },
    Family { name: "C0 knots", knotting: Knotting::Corners, ..PLAIN },
    Family { name: "zero spans", knotting: Knotting::ZeroSpans, ..PLAIN },
    Family { name: "wild knots", knotting: Knotting::Wild, ..PLAIN },
    Family { name: "domain 1000..1000.001", knotting: Knotting::Narrow, weights: 0.5, ..PLAIN },
    Family { name: "domain 0..1e-9", knotting: Knotting::Short, weights: 0.5, ..PLAIN },
    Family { name: "offset 1e7..1e8", offset: 1e8, weights: 0.5, ..PLAIN },
    Family { name: "sizes 1e-9..1e9", sizes: 9.0, weights: 0.5, ..PLAIN },
    Family { name: "high degree", degrees: [15, 31], weights: 0.5, ..PLAIN },
    Family { name: "equal poles", copies: 0.25, weights: 0.5, ..PLAIN },
    Family { name: "flat", is_flat: true, weights: 0.5, ..PLAIN },
];

fn cumulated(start: f64, steps: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut knots = vec![start];
    for step in steps {
        knots.push(knots[knots.len() - 1] + step);
    }
    knots
}

fn repeated(breaks: &[f64], degree: usize, mut times: impl FnMut(usize) -> usize) -> Vec<f64> {
    let last = breaks.len() - 1;
    let times = |i: usize| if i == 0 || i == last { degree + 1 } else { times(i) };
    let mut counts: Vec<usize> = Vec::new();
    let mut times = times;
    counts.extend((0..=last).map(&mut times));
    breaks.iter().zip(counts).flat_map(|(u, count)| std::iter::repeat_n(*u, count)).collect()
}

/// A knot vector in full.
pub fn knots(knotting: Knotting, degree: usize, spans: usize, r: &mut Random) -> Vec<f64> {
    let steps: Vec<f64> = (0..spans).map(|_| r.between(0.2, 1.0)).collect();
    match knotting {
        Knotting::Unclamped => {
            let start = r.between(-3.0, 3.0);
            cumulated(start, (0..spans + 2 * degree).map(|_| r.between(0.2, 1.0)))
        }
        Knotting::Periodic => {
            let start = r.between(-3.0, 3.0);
            cumulated(start, (0..spans + 2 * degree).map(|i| steps[i % spans]))
        }
        Knotting::Wild => {
            let wild: Vec<f64> = (0..spans).map(|_| r.scale(-12.0, 0.0)).collect();
            repeated(&cumulated(0.0, wild.into_iter()), degree, |_| 1)
        }
        Knotting::Corners => repeated(&cumulated(0.0, steps.into_iter()), degree, |_| degree),
        Knotting::ZeroSpans => {
            let tiny = r.whole(0, spans - 1);
            let steps = steps.into_iter().enumerate();
            let breaks =
                cumulated(-1.0, steps.map(|(i, s)| if i == tiny && i > 0 { 1e-10 } else { s }));
            repeated(&breaks, degree, |_| r.whole(1, degree))
        }
        Knotting::Clamped | Knotting::Narrow | Knotting::Short => {
            let (start, length) = match knotting {
                Knotting::Narrow => (1000.0, 0.001),
                Knotting::Short => (0.0, 1e-9),
                _ => (0.0, steps.iter().sum()),
            };
            let total: f64 = steps.iter().sum();
            let breaks = cumulated(0.0, steps.into_iter());
            let mapped: Vec<f64> = breaks.iter().map(|u| start + u / total * length).collect();
            repeated(&mapped, degree, |_| 1)
        }
    }
}

/// Number of different poles of a direction; beyond them they repeat.
fn own_poles(knotting: Knotting, spans: usize, count: usize) -> usize {
    if knotting == Knotting::Periodic { spans } else { count }
}

struct Net {
    poles: Vec<Vector>,
    weights: Option<Vec<f64>>,
}

/// A net of `own[0]` x `own[1]` random poles, repeated to `counts`.
fn net(family: &Family, counts: [usize; 2], own: [usize; 2], r: &mut Random) -> Net {
    let size = r.scale(-family.sizes, family.sizes);
    let offset = family.offset * r.between(0.1, 1.0);
    let center = r.direction().map(|x| x * offset);
    let scatter: Vec<(Vector, f64)> = (0..own[0] * own[1])
        .map(|_| (r.vector(), r.scale(-family.weights, family.weights)))
        .collect();
    let pick = |i: usize, j: usize| scatter[i % own[0] * own[1] + j % own[1]];
    // A surface is a sheet: its poles stand near a grid, so that patches do not all fill the same cube.
    let place = |i: usize, j: usize| {
        let (noise, sheet) = (pick(i, j).0, counts[1] > 1);
        let at = |k: usize, count: usize| 2.0 * (k % count) as f64 / count as f64 - 1.0;
        let grid = if sheet { [at(i, own[0]), at(j, own[1]), 0.0] } else { [0.0; 3] };
        along(along(center, grid, size), noise, if sheet { 0.5 * size } else { size })
    };
    let cells = || (0..counts[0]).flat_map(|i| (0..counts[1]).map(move |j| (i, j)));
    let mut poles: Vec<Vector> = cells().map(|(i, j)| place(i, j)).collect();
    if family.copies > 0.0 {
        copy_some(&mut poles, counts[1], family.copies, r);
    }
    if family.is_flat {
        poles.iter_mut().for_each(|pole| pole[2] = 0.0);
    }
    Net {
        poles,
        weights: (family.weights > 0.0).then(|| cells().map(|(i, j)| pick(i, j).1).collect()),
    }
}

/// Makes some poles equal to the one before them, and sometimes the first or last row one point.
fn copy_some(poles: &mut [Vector], row: usize, share: f64, r: &mut Random) {
    for k in 1..poles.len() {
        if r.unit() < share {
            poles[k] = poles[k - 1];
        }
    }
    let rows = poles.len() / row;
    if row > 1 && rows > 2 {
        for first in [0, (rows - 1) * row] {
            if r.unit() < 0.4 {
                let tip = poles[first];
                poles[first..first + row].fill(tip);
            }
        }
    }
}

/// A random curve of the family.
pub fn curve(family: &Family, seed: u64) -> Curve {
    let r = &mut Random(seed);
    let degree = r.whole(family.degrees[0], family.degrees[1]);
    let spans = if family.knotting == Knotting::Periodic { r.whole(3, 9) } else { r.whole(1, 8) };
    curve_of(family, degree, spans, r)
}

/// A random curve of the family with this degree and number of spans.
pub fn curve_of(family: &Family, degree: usize, spans: usize, r: &mut Random) -> Curve {
    let knots = knots(family.knotting, degree, spans, r);
    let count = knots.len() - degree - 1;
    let own = [own_poles(family.knotting, spans, count), 1];
    let net = net(family, [count, 1], own, r);
    Curve::new(&knots, degree, &net.poles, net.weights.as_deref()).expect("a curve")
}

/// A random surface of the family; high degrees in one direction only.
pub fn surface(family: &Family, seed: u64) -> Surface {
    let r = &mut Random(seed);
    let degree = r.whole(family.degrees[0], family.degrees[1]);
    let other = r.whole(1, 4);
    let least = if family.knotting == Knotting::Periodic { 3 } else { 1 };
    let spans = if degree > 9 { [least, 1] } else { [r.whole(least, 4), r.whole(least, 3)] };
    surface_of(family, [degree, other], spans, r)
}

/// A random surface of the family with these degrees and numbers of spans. Every other one has the family's
/// knots in v too.
pub fn surface_of(
    family: &Family,
    degrees: [usize; 2],
    spans: [usize; 2],
    r: &mut Random,
) -> Surface {
    let other = if r.unit() < 0.5 { family.knotting } else { Knotting::Clamped };
    let ku = knots(family.knotting, degrees[0], spans[0], r);
    let kv = knots(other, degrees[1], spans[1], r);
    let counts = [ku.len() - degrees[0] - 1, kv.len() - degrees[1] - 1];
    let own =
        [own_poles(family.knotting, spans[0], counts[0]), own_poles(other, spans[1], counts[1])];
    let net = net(family, counts, own, r);
    let weights = net.weights.as_deref();
    Surface::new(&ku, &kv, degrees[0], degrees[1], &net.poles, counts[0], counts[1], weights)
        .expect("a surface")
}

/// Diagonal of the box and its largest absolute coordinate.
pub fn extent(bounding_box: (Vector, Vector)) -> (f64, f64) {
    let (low, high) = bounding_box;
    (norm(sub(high, low)), low.iter().chain(&high).fold(0.0, |m: f64, x| m.max(x.abs())))
}

/// A query of a random kind: on the shape, near it, in and around its box, far away.
pub fn query(bounding_box: (Vector, Vector), on: Vector, r: &mut Random) -> Vector {
    let (diagonal, _) = extent(bounding_box);
    match r.whole(0, 5) {
        0 => on,
        1 => along(on, r.direction(), diagonal * r.scale(-9.0, -3.0)),
        2 => along(on, r.direction(), diagonal * r.scale(1.0, 3.0)),
        _ => [0, 1, 2].map(|k| {
            let (low, high) = (bounding_box.0[k], bounding_box.1[k]);
            let margin = 0.3 * (high - low) + 0.05 * diagonal;
            r.between(low - margin, high + margin)
        }),
    }
}

/// Parameters of the domain: all knots, and `per_span` places in each span.
pub fn samples(knots: &footpoint::knots::Knots, per_span: usize) -> Vec<f64> {
    let mut places = Vec::new();
    for i in knots.spans() {
        let (a, b) = (knots.values()[i], knots.values()[i + 1]);
        places.extend((0..per_span).map(|k| {
            // Denser at both ends, where feet like to hide.
            let x = k as f64 / per_span as f64;
            (a + (b - a) * x * x * (3.0 - 2.0 * x)).clamp(a, b)
        }));
    }
    places.push(knots.domain().1);
    places
}
