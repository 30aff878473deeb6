//! Elementary curves and surfaces in many NURBS forms: arcs of any number of pieces, degrees raised, pieces cut,
//! parameters mapped, turned and moved in space.
#![allow(dead_code, reason = "each test takes what it needs")]

use footpoint::curve::Curve;
use footpoint::surface::Surface;

pub type Vector = [f64; 3];

/// Homogeneous point of a plane: x w, y w, w.
type Pole = [f64; 3];

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

    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * ((self.bits() >> 11) as f64 / (1u64 << 53) as f64)
    }

    pub fn whole(&mut self, low: usize, high: usize) -> usize {
        low + (self.bits() % (high - low + 1) as u64) as usize
    }

    pub fn point(&mut self, reach: f64) -> Vector {
        [0, 1, 2].map(|_| self.between(-reach, reach))
    }
}

pub fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub fn norm(a: Vector) -> f64 {
    dot(a, a).sqrt()
}

pub fn sub(a: Vector, b: Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// A plane curve of Bezier pieces of one degree.
#[derive(Clone, Debug)]
pub struct Profile {
    pub degree: usize,
    pub knots: Vec<f64>,
    pub poles: Vec<Pole>,
}

fn mixed(a: Pole, b: Pole, t: f64) -> Pole {
    [0, 1, 2].map(|c| (1.0 - t) * a[c] + t * b[c])
}

fn raised(piece: &[Pole]) -> Vec<Pole> {
    let n = piece.len();
    let at = |i: usize| mixed(piece[i.min(n - 1)], piece[i.max(1) - 1], i as f64 / n as f64);
    (0..=n).map(at).collect()
}

fn cut(piece: &[Pole], t: f64) -> [Vec<Pole>; 2] {
    let (mut work, mut low, mut high) = (piece.to_vec(), Vec::new(), Vec::new());
    while let (Some(first), Some(last)) = (work.first(), work.last()) {
        low.push(*first);
        high.push(*last);
        work = work.windows(2).map(|pair| mixed(pair[0], pair[1], t)).collect();
    }
    high.reverse();
    [low, high]
}

/// The pieces with degrees raised, cut, and their parameters mapped by linear fractional maps, on uneven knots.
fn dressed(mut pieces: Vec<Vec<Pole>>, random: &mut Random, plain: bool) -> Profile {
    if !plain {
        for _ in 0..random.whole(0, 2) {
            pieces = pieces.iter().map(|piece| raised(piece)).collect();
        }
        for _ in 0..random.whole(0, 2) {
            let k = random.whole(0, pieces.len() - 1);
            let parts = cut(&pieces[k], random.between(0.2, 0.8));
            pieces.splice(k..=k, parts);
        }
        let mut scale = 1.0;
        for piece in &mut pieces {
            let growth = random.between(0.6, 1.6);
            for pole in piece.iter_mut() {
                *pole = pole.map(|x| x * scale);
                scale *= growth;
            }
            scale /= growth;
        }
    }
    let degree = pieces[0].len() - 1;
    let (mut at, mut knots) = (random.between(-3.0, 3.0), Vec::new());
    knots.push(at);
    for _ in 0..pieces.len() {
        knots.extend(std::iter::repeat_n(at, degree));
        at += if plain { 1.0 } else { random.between(0.3, 2.0) };
    }
    knots.extend(std::iter::repeat_n(at, degree + 1));
    let mut poles = vec![pieces[0][0]];
    pieces.iter().for_each(|piece| poles.extend(&piece[1..]));
    Profile { degree, knots, poles }
}

/// The arc about the origin between two angles.
pub fn arc(from: f64, to: f64, random: &mut Random, plain: bool) -> Profile {
    let least = ((to - from).abs() / 2.4).ceil() as usize;
    let count = least.max(1) + if plain { 0 } else { random.whole(0, 2) };
    let step = (to - from) / count as f64;
    let cos = (step / 2.0).cos();
    let piece = |k: usize| {
        let a = from + step * k as f64;
        let (middle, b) = (a + step / 2.0, if k + 1 == count { to } else { a + step });
        vec![[a.cos(), a.sin(), 1.0], [middle.cos(), middle.sin(), cos], [b.cos(), b.sin(), 1.0]]
    };
    let mut pieces: Vec<Vec<Pole>> = (0..count).map(piece).collect();
    if ((to - from).abs() - std::f64::consts::TAU).abs() < 1e-12 {
        pieces[count - 1][2] = pieces[0][0];
    }
    dressed(pieces, random, plain)
}

/// The full circle of seven poles, or the half circle of four, whose knots are single or double.
pub fn book_circle(full: bool) -> Profile {
    if full {
        let ring = [(1., 0.), (1., 1.), (-1., 1.), (-1., 0.), (-1., -1.), (1., -1.), (1., 0.)];
        let weights = [1.0, 0.5, 0.5, 1.0, 0.5, 0.5, 1.0];
        let poles = ring.iter().zip(weights).map(|((x, y), w)| [x * w, y * w, w]).collect();
        let knots = vec![0., 0., 0., 0.25, 0.5, 0.5, 0.75, 1., 1., 1.];
        return Profile { degree: 2, knots, poles };
    }
    let poles = vec![[1., 0., 1.], [0.5, 0.5, 0.5], [-0.5, 0.5, 0.5], [-1., 0., 1.]];
    Profile { degree: 2, knots: vec![0., 0., 0., 0.5, 1., 1., 1.], poles }
}

pub fn segment(a: [f64; 2], b: [f64; 2], random: &mut Random, plain: bool) -> Profile {
    dressed(vec![vec![[a[0], a[1], 1.0], [b[0], b[1], 1.0]]], random, plain)
}

impl Profile {
    /// Scaled, then moved along x.
    pub fn placed(mut self, scale: f64, x: f64) -> Self {
        for [px, py, w] in &mut self.poles {
            *px = scale * *px + x * *w;
            *py *= scale;
        }
        self
    }
}

/// A motion with a scale.
#[derive(Clone, Copy, Debug)]
pub struct Motion {
    axes: [Vector; 3],
    move_: Vector,
    pub scale: f64,
}

impl Motion {
    pub fn random(random: &mut Random, scale: f64, offset: f64) -> Self {
        let unit = |a: Vector| a.map(|x| x / norm(a));
        let a = unit(random.point(1.0));
        let b = random.point(1.0);
        let b = unit([0, 1, 2].map(|c| b[c] - dot(a, b) * a[c]));
        let c = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
        Self { axes: [a, b, c], move_: random.point(offset), scale }
    }

    pub fn of(&self, p: Vector) -> Vector {
        let turned = |c: usize| (0..3).map(|k| self.axes[k][c] * p[k]).sum::<f64>();
        [0, 1, 2].map(|c| self.scale * turned(c) + self.move_[c])
    }
}

pub fn curve(profile: &Profile, motion: &Motion) -> Curve {
    let weights: Vec<f64> = profile.poles.iter().map(|p| p[2]).collect();
    let poles: Vec<Vector> =
        profile.poles.iter().map(|p| motion.of([p[0] / p[2], p[1] / p[2], 0.0])).collect();
    Curve::new(&profile.knots, profile.degree, &poles, Some(&weights)).unwrap()
}

/// A surface from its homogeneous poles (x w, y w, z w, w), as a net over two profiles' knots.
pub fn surface(
    u: &Profile,
    v: &Profile,
    swapped: bool,
    motion: &Motion,
    pole: impl Fn(Pole, Pole) -> [f64; 4],
) -> Surface {
    let (mut poles, mut weights) = (Vec::new(), Vec::new());
    let (first, second) = if swapped { (v, u) } else { (u, v) };
    for a in &first.poles {
        for b in &second.poles {
            let [x, y, z, w] = if swapped { pole(*b, *a) } else { pole(*a, *b) };
            poles.push(motion.of([x / w, y / w, z / w]));
            weights.push(w);
        }
    }
    Surface::new(
        &first.knots,
        &second.knots,
        first.degree,
        second.degree,
        &poles,
        first.poles.len(),
        second.poles.len(),
        Some(&weights),
    )
    .unwrap()
}

/// A meridian (radius, height) turned along a circle profile.
pub fn turned(circle: &Profile, meridian: &Profile, swapped: bool, motion: &Motion) -> Surface {
    surface(circle, meridian, swapped, motion, |c, m| {
        [c[0] * m[0], c[1] * m[0], c[2] * m[1], c[2] * m[2]]
    })
}

/// A rectangle of the plane z = 0, spanned by the first coordinates of two profiles.
pub fn rectangle(u: &Profile, v: &Profile, motion: &Motion) -> Surface {
    surface(u, v, false, motion, |a, b| [a[0] * b[2], a[2] * b[0], 0.0, a[2] * b[2]])
}
