//! Elementary surfaces as NURBS, moved by exact rotations, and the sheets with bumps.
#![allow(dead_code)]

use footpoint::index::IndexedSurface;
use footpoint::surface::Surface;

pub type P = [f64; 3];

/// A motion: rotation by rows, factor, translation.
#[derive(Clone, Copy)]
pub struct Motion {
    pub rows: [P; 3],
    pub factor: f64,
    pub shift: P,
}

impl Motion {
    pub const NONE: Self = Self {
        rows: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        factor: 1.0,
        shift: [0.0; 3],
    };

    /// Rotation from a quaternion.
    pub fn new([w, x, y, z]: [f64; 4], factor: f64, shift: P) -> Self {
        let n = (w * w + x * x + y * y + z * z).sqrt();
        let [w, x, y, z] = [w / n, x / n, y / n, z / n];
        let rows = [
            [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)],
            [2.0 * (x * y + w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x)],
            [2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y)],
        ];
        Self { rows, factor, shift }
    }

    pub fn apply(&self, p: P) -> P {
        std::array::from_fn(|i| {
            self.factor * (0..3).map(|k| self.rows[i][k] * p[k]).sum::<f64>() + self.shift[i]
        })
    }

    pub fn back(&self, p: P) -> P {
        let q: P = std::array::from_fn(|k| (p[k] - self.shift[k]) / self.factor);
        std::array::from_fn(|i| (0..3).map(|k| self.rows[k][i] * q[k]).sum())
    }

    pub fn surface(&self, s: &Surface) -> IndexedSurface {
        let poles: Vec<P> = s.poles().iter().map(|&p| self.apply(p)).collect();
        let (u, v) = (s.knots_u(), s.knots_v());
        let made = Surface::new(
            u.values(),
            v.values(),
            u.degree(),
            v.degree(),
            &poles,
            u.pole_count(),
            v.pole_count(),
            s.weights(),
        );
        IndexedSurface::new(made.unwrap())
    }
}

/// The parallelogram `o + u x + v y`, 0 <= u, v <= 1.
pub fn plane(o: P, x: P, y: P) -> Surface {
    let at = |u: f64, v: f64| std::array::from_fn(|k| o[k] + u * x[k] + v * y[k]);
    let poles = [at(0.0, 0.0), at(0.0, 1.0), at(1.0, 0.0), at(1.0, 1.0)];
    let k = [0.0, 0.0, 1.0, 1.0];
    Surface::new(&k, &k, 1, 1, &poles, 2, 2, None).unwrap()
}

/// Revolution about the z axis of a profile (r, z, weight) of the given degree and knots; u turns, v runs along the profile.
pub fn revolved(profile: &[[f64; 3]], degree: usize, knots: &[f64]) -> Surface {
    let h = 0.5f64.sqrt();
    let corner = [[1, 0], [1, 1], [0, 1], [-1, 1], [-1, 0], [-1, -1], [0, -1], [1, -1], [1, 0]];
    let (mut poles, mut weights) = (Vec::new(), Vec::new());
    for (i, c) in corner.iter().enumerate() {
        for p in profile {
            poles.push([p[0] * f64::from(c[0]), p[0] * f64::from(c[1]), p[1]]);
            weights.push(p[2] * if i % 2 == 1 { h } else { 1.0 });
        }
    }
    let ku = [0.0, 0.0, 0.0, 0.25, 0.25, 0.5, 0.5, 0.75, 0.75, 1.0, 1.0, 1.0];
    Surface::new(&ku, knots, 2, degree, &poles, 9, profile.len(), Some(&weights)).unwrap()
}

const QUARTERS: [f64; 8] = [0.0, 0.0, 0.0, 0.5, 0.5, 1.0, 1.0, 1.0];

pub fn sphere(r: f64) -> Surface {
    let h = 0.5f64.sqrt();
    let profile = [[0.0, -r, 1.0], [r, -r, h], [r, 0.0, 1.0], [r, r, h], [0.0, r, 1.0]];
    revolved(&profile, 2, &QUARTERS)
}

pub fn torus(big: f64, r: f64) -> Surface {
    let h = 0.5f64.sqrt();
    let corner = [[1, 0], [1, 1], [0, 1], [-1, 1], [-1, 0], [-1, -1], [0, -1], [1, -1], [1, 0]];
    let profile: Vec<[f64; 3]> = corner
        .iter()
        .enumerate()
        .map(|(i, c)| {
            [big + r * f64::from(c[0]), r * f64::from(c[1]), if i % 2 == 1 { h } else { 1.0 }]
        })
        .collect();
    let knots = [0.0, 0.0, 0.0, 0.25, 0.25, 0.5, 0.5, 0.75, 0.75, 1.0, 1.0, 1.0];
    revolved(&profile, 2, &knots)
}

/// About z, from z0 with radius r0 to z1 with radius r1.
pub fn cone(z0: f64, r0: f64, z1: f64, r1: f64) -> Surface {
    revolved(&[[r0, z0, 1.0], [r1, z1, 1.0]], 1, &[0.0, 0.0, 1.0, 1.0])
}

pub fn cylinder(r: f64, half: f64) -> Surface {
    cone(-half, r, half, r)
}

/// The same surface turned by a rotation of its own.
pub fn moved(s: &Surface, motion: &Motion) -> Surface {
    motion.surface(s).surface().clone()
}

/// A motion that carries z to x.
pub fn z_to_x(shift: P) -> Motion {
    Motion { rows: [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], factor: 1.0, shift }
}

fn unit_knots(count: usize) -> Vec<f64> {
    (0..count + 4).map(|i| i as f64 - 3.0).collect()
}

/// The sheet of the small-loop benchmark: `n` bumps of height 4/9, five poles apart, in a square; bicubic, unit spans. `lift`
/// maps (x, y, z) to space.
pub fn bumps(n: usize, lift: impl Fn(P) -> P) -> Surface {
    let side = (n as f64).sqrt().ceil() as usize;
    let count = 5 * side + 4;
    let mut poles = Vec::new();
    for i in 0..count {
        for j in 0..count {
            let on = i % 5 == 4 && j % 5 == 4;
            let number = (i / 5) * side + j / 5;
            let is_bump = on && i / 5 < side && j / 5 < side && number < n;
            poles.push(lift([i as f64 - 1.0, j as f64 - 1.0, if is_bump { 1.0 } else { 0.0 }]));
        }
    }
    let k = unit_knots(count);
    Surface::new(&k, &k, 3, 3, &poles, count, count, None).unwrap()
}

/// The plane z = `z` over the sheet of `n` bumps, bicubic.
pub fn lid(n: usize, z: f64, lift: impl Fn(P) -> P) -> Surface {
    let side = (n as f64).sqrt().ceil() as usize;
    let size = (5 * side + 2) as f64;
    let at = |k: usize| -0.5 + k as f64 / 3.0 * (size + 0.5);
    let poles: Vec<P> = (0..16).map(|k| lift([at(k / 4), at(k % 4), z])).collect();
    let k = [0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0];
    Surface::new(&k, &k, 3, 3, &poles, 4, 4, None).unwrap()
}

/// A bicubic sheet of `count` x `count` poles over [-3, 3]^2 with waves of height about one.
pub fn wave(count: usize, phase: f64) -> Surface {
    let at = |k: usize| -3.0 + 6.0 * k as f64 / (count - 1) as f64;
    let height = |x: f64, y: f64| 0.9 * (1.3 * x + phase).sin() * (1.1 * y - 0.7 * phase).cos();
    let poles: Vec<P> = (0..count * count)
        .map(|k| (at(k / count), at(k % count)))
        .map(|(x, y)| [x, y, height(x, y)])
        .collect();
    let inner = count - 4;
    let mut k = vec![0.0; 4];
    k.extend((1..=inner).map(|i| i as f64 / (inner + 1) as f64));
    k.extend([1.0; 4]);
    Surface::new(&k, &k, 3, 3, &poles, count, count, None).unwrap()
}
