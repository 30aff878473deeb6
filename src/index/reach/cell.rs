//! A cell of a patch: where it lies, its tangents, its second derivatives.

use super::MARGIN;
use super::oriented::{Oriented, extent};
use crate::bezier::{Bidegree, convolve, cut, derivative, scale_down_2d, scale_up_2d};
use crate::bounds::{Vector, add, cross, dot, norm, scaled, sub};
use crate::index::patch::Patch;
use crate::index::piece::{position_error, position_steps};

/// Sizes of tangents whose squares keep their digits.
const PLAIN: std::ops::Range<f64> = 1e-100..1e100;

/// Second derivatives in a cell: least and greatest part along the cell's normal, greatest size; a ball around them.
#[derive(Clone, Copy, Debug, Default)]
pub struct Bend {
    pub along: [f64; 2],
    pub size: f64,
    pub mean: Vector,
    pub apart: f64,
}

impl Bend {
    fn shrunk(self, by: f64) -> Self {
        let [low, high] = self.along.map(|x| x / by);
        let slack = 1e-12 * self.size / by;
        Self {
            along: [low - slack, high + slack],
            size: self.size / by * MARGIN,
            mean: scaled(self.mean, 1.0 / by),
            apart: self.apart / by * MARGIN + slack,
        }
    }
}

/// What is kept of a cell until all are there: a box around it, and its shape.
#[derive(Clone, Copy, Debug)]
pub struct Cell {
    pub bounds: Oriented,
    /// `None` where the tangents say nothing.
    pub shape: Option<Shape>,
}

impl Cell {
    /// The same cell with its parameters stretched.
    pub fn stretched(&self, by: [f64; 2]) -> Self {
        if by == [1.0; 2] {
            return *self;
        }
        let shape = self.shape.map(|shape| {
            let [uu, uv, vv] = shape.bends;
            let [a, b] = by;
            Shape {
                tangents: [0, 1].map(|k| scaled(shape.tangents[k], 1.0 / by[k])),
                off: [0, 1].map(|k| shape.off[k] / by[k] * MARGIN),
                bends: [uu.shrunk(a * a), uv.shrunk(a * b), vv.shrunk(b * b)],
                width: [0, 1].map(|k| shape.width[k] * by[k] * MARGIN),
                ..shape
            }
        });
        Self { shape, ..*self }
    }
}

/// The shape of a cell.
#[derive(Clone, Copy, Debug)]
pub struct Shape {
    /// First derivatives by the surface's parameters in the middle, and how far they may be off.
    pub tangents: [Vector; 2],
    pub off: [f64; 2],
    pub normal: Vector,
    /// Greatest distance of a unit normal from `normal`.
    pub cone: f64,
    /// Second derivatives: uu, uv, vv.
    pub bends: [Bend; 3],
    /// Widths in the surface's parameters.
    pub width: [f64; 2],
    /// Least height of the sides (as in `index::side`) along their outward conormals, over the middle of the box.
    pub rims: [f64; 4],
}

impl Shape {
    /// By which vectors to multiply a vector to get how far it leads along each parameter, in widths of the cell.
    pub fn steps(&self) -> [Vector; 2] {
        let [a, b] = self.tangents;
        [(a, b, 0), (b, a, 1)].map(|(along, other, k)| {
            let rest = sub(along, scaled(other, dot(along, other) / dot(other, other)));
            scaled(rest, 1.0 / (dot(rest, rest) * self.width[k]))
        })
    }

    /// The outward conormal of a side, for the tangents in the middle, and the derivative across along it.
    pub fn conormal(&self, side: usize) -> (Vector, f64) {
        let (across, along) = (self.tangents[side / 2], self.tangents[1 - side / 2]);
        let rest = sub(across, scaled(along, dot(across, along) / dot(along, along)));
        let speed = norm(rest);
        (scaled(rest, if side.is_multiple_of(2) { -1.0 } else { 1.0 } / speed), speed)
    }
}
/// Appends the cells of a patch (`poles`: component by component).
pub fn push_cells(
    poles: &[f64],
    degree: Bidegree,
    rational: bool,
    patch: &Patch,
    split: [usize; 2],
    out: &mut Vec<Cell>,
) {
    let part = |k: usize, d: usize| [0, 1].map(|n| (k + n) as f64 / split[d] as f64);
    let width = [patch.u, patch.v].map(|span| span.ends[1] - span.ends[0]);
    let width = [0, 1].map(|d| width[d] / split[d] as f64);
    if split == [1, 1] {
        out.push(cell(poles, degree, rational, patch, width));
        return;
    }
    let columns = degree.t + 1;
    for i in 0..split[0] {
        let mut strip = poles.to_vec();
        let [low, high] = part(i, 0);
        for component in strip.chunks_exact_mut(degree.count()) {
            cut(component, degree.s, columns, columns, low, high);
        }
        for j in 0..split[1] {
            let mut piece = strip.clone();
            let [low, high] = part(j, 1);
            piece.chunks_exact_mut(columns).for_each(|row| cut(row, degree.t, 1, 1, low, high));
            out.push(cell(&piece, degree, rational, patch, width));
        }
    }
}

fn cell(poles: &[f64], degree: Bidegree, rational: bool, patch: &Patch, width: [f64; 2]) -> Cell {
    let count = degree.count();
    let weight = |k: usize| if rational { poles[3 * count + k] } else { 1.0 };
    let points: Vec<Vector> =
        (0..count).map(|k| [0, 1, 2].map(|c| poles[c * count + k] / weight(k))).collect();
    let steps = position_steps(degree.s + degree.t);
    let error = position_error(steps, rational, patch.radius, patch.radius, 2.0) + patch.spread;
    // With a balance the parameters of the patch are not those of the surface.
    let plain = patch.u.balance == 1.0 && patch.v.balance == 1.0;
    let mut shape =
        if plain { shape(&Slopes::new(poles, degree, rational), width, error) } else { None };
    let axes =
        shape.as_ref().map_or([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], |shape| {
            let along = scaled(shape.tangents[0], 1.0 / norm(shape.tangents[0]));
            [along, cross(shape.normal, along), shape.normal]
        });
    let mut bounds = Oriented::around(points.iter().copied(), axes, error);
    if let Some(shape) = &mut shape {
        let on = |side: usize, k: usize| {
            let (i, j) = (k / (degree.t + 1), k % (degree.t + 1));
            [i == 0, i == degree.s, j == 0, j == degree.t][side]
        };
        shape.rims = [0, 1, 2, 3].map(|side| {
            let (out, _) = shape.conormal(side);
            let height = |k: usize| dot(sub(points[k], bounds.center), out);
            let least = (0..count).filter(|&k| on(side, k)).map(height);
            extent(least)[0] - error - 1e-12 * patch.radius
        });
    }
    bounds.center = add(patch.center, bounds.center);
    Cell { bounds, shape }
}

/// First derivatives of a net by its local parameters: `r_k = Q_k / W^2` with `Q_k = X_k W - W_k X`, so that
/// `r_kl = (Q_k)_l / W^2 - 2 (W_l / W) r_k`.
struct Slopes {
    degrees: [usize; 2],
    /// Coefficients of Q_u, of Q_v, and their bidegrees.
    nets: [Vec<Vector>; 2],
    orders: [Bidegree; 2],
    /// Least and greatest change of the weight by u, by v.
    rates: [[f64; 2]; 2],
    /// Least and greatest weight.
    weights: [f64; 2],
}

impl Slopes {
    fn new(poles: &[f64], degree: Bidegree, rational: bool) -> Self {
        let count = degree.count();
        let (xyz, w) = poles.split_at(3 * count);
        let degrees = [degree.s, degree.t];
        let point = |list: &[f64], n: usize, k: usize| [0, 1, 2].map(|c| list[c * n + k]);
        let mut out = Self {
            degrees,
            nets: Default::default(),
            orders: [degree.lowered(0), degree.lowered(1)],
            rates: [[0.0; 2]; 2],
            weights: [1.0; 2],
        };
        for k in 0..2 {
            let order = degree.lowered(k);
            let mut slopes = Vec::new();
            for component in xyz.chunks_exact(count) {
                derivative(component, degree, k, &mut slopes);
            }
            if rational {
                let mut slope = Vec::new();
                derivative(w, degree, k, &mut slope);
                out.rates[k] = extent(slope.iter().copied());
                slopes = quotient(xyz, w, degree, slopes, slope, order);
                out.orders[k] = order.times(degree);
            }
            let n = out.orders[k].count();
            out.nets[k] = (0..n).map(|at| point(&slopes, n, at)).collect();
        }
        if rational {
            out.weights = extent(w.iter().copied());
        }
        out
    }
}

/// Coefficients of `X_k W - W_k X`, component by component, from those of X, W, X_k and W_k.
pub fn quotient(
    x: &[f64],
    w: &[f64],
    degree: Bidegree,
    mut slopes: Vec<f64>,
    mut slope: Vec<f64>,
    order: Bidegree,
) -> Vec<f64> {
    let up = |list: &mut [f64], degree: Bidegree| {
        list.chunks_exact_mut(degree.count()).for_each(|part| scale_up_2d(part, degree));
    };
    let (mut x, mut w) = (x.to_vec(), w.to_vec());
    up(&mut x, degree);
    up(&mut w, degree);
    up(&mut slopes, order);
    up(&mut slope, order);
    let product = order.times(degree);
    let mut out = vec![0.0; 3 * product.count()];
    for (c, part) in out.chunks_exact_mut(product.count()).enumerate() {
        let (n, m) = (order.count(), degree.count());
        convolve(&slopes[c * n..(c + 1) * n], order, &w, degree, 1.0, part);
        convolve(&slope, order, &x[c * m..(c + 1) * m], degree, -1.0, part);
        scale_down_2d(part, product);
    }
    out
}

/// The shape of a cell as wide as `width` in the surface's parameters, its poles rounded by `error`.
fn shape(slopes: &Slopes, width: [f64; 2], error: f64) -> Option<Shape> {
    let [least, most] = slopes.weights.map(|w| w * w);
    let (middle, uneven) = (0.5 * (least + most), 0.5 * (most - least) * MARGIN);
    let share = most / least;
    // Rounding of the coefficients: of the poles, by the factors of the differences.
    let blur = [0, 1].map(|k| 8.0 * slopes.degrees[k] as f64 / width[k] * error * share);
    let means = [0, 1].map(|k| mean(&slopes.nets[k]));
    let tangents = [0, 1].map(|k| scaled(means[k], 1.0 / (middle * width[k])));
    let off = [0, 1].map(|k| {
        let spread = greatest(&slopes.nets[k], |x| norm(sub(x, means[k]))) / width[k];
        ((spread + norm(tangents[k]) * uneven) / least + blur[k]) * MARGIN
    });
    let normal = cross(tangents[0], tangents[1]);
    let normal = scaled(normal, 1.0 / norm(normal));
    let sine = relative(&tangents, &off) / angle_factor(&tangents);
    // Squares of the tangents are divided by.
    let is_plain = tangents.iter().all(|x| PLAIN.contains(&norm(*x)));
    if !is_plain || sine.is_nan() || sine >= 0.7 || !normal.iter().all(|x| x.is_finite()) {
        return None;
    }
    // The chord of an angle with that sine.
    let cone = (2.0 - 2.0 * (1.0 - sine * sine).sqrt()).sqrt() * MARGIN + 1e-12;
    // Changes of the weight, relative to it: the middle, and how far they are off it.
    let rates = [0, 1].map(|k| {
        let [low, high] = slopes.rates[k];
        let [light, heavy] = slopes.weights;
        let low = if low < 0.0 { low / light } else { low / heavy };
        let high = if high < 0.0 { high / heavy } else { high / light };
        [0.5 * (low + high), 0.5 * (high - low) * MARGIN].map(|x| x / width[k])
    });
    let bends = [(0, 0), (0, 1), (1, 1)].map(|(k, l)| {
        let order = slopes.orders[k];
        let step = if l == 0 { order.t + 1 } else { 1 };
        let factor = [order.s, order.t][l] as f64 / (width[k] * width[l]);
        let net = &slopes.nets[k];
        let second: Vec<Vector> = (0..net.len() - step)
            .filter(|at| l == 0 || (at + 1) % (order.t + 1) != 0)
            .map(|at| scaled(sub(net[at + step], net[at]), factor))
            .collect();
        let blur = 4.0 * blur[k] * [order.s, order.t][l] as f64 / width[l];
        let [low, high] = extent(second.iter().map(|x| dot(*x, normal)));
        let by = |x: f64, up: bool| if (x > 0.0) == up { x / least } else { x / most };
        let [rate, uneven_rate] = rates[l];
        let (turned, speed) = (2.0 * (rate.abs() + uneven_rate), norm(tangents[k]));
        let size = greatest(&second, norm) / least + turned * (speed + off[k]);
        let slack = turned * off[k] + 1e-9 * size + blur;
        let along = [by(low, false) - slack, by(high, true) + slack];
        // Of degree 1 there are none.
        let center = if second.is_empty() { [0.0; 3] } else { mean(&second) };
        let apart = greatest(&second, |x| norm(sub(x, center))) + norm(center) / middle * uneven;
        let apart = apart / least + turned * off[k] + 2.0 * uneven_rate * speed + 1e-9 * size;
        Bend {
            along,
            size: size * MARGIN + blur,
            mean: sub(scaled(center, 1.0 / middle), scaled(tangents[k], 2.0 * rate)),
            apart: apart * MARGIN + blur,
        }
    });
    Some(Shape { tangents, off, normal, cone, bends, width, rims: [0.0; 4] })
}

fn greatest(list: &[Vector], f: impl Fn(Vector) -> f64) -> f64 {
    list.iter().fold(0.0, |most: f64, x| most.max(f(*x)))
}

fn mean(list: &[Vector]) -> Vector {
    scaled(list.iter().fold([0.0; 3], |sum, x| add(sum, *x)), 1.0 / list.len() as f64)
}

/// Square root of the least eigenvalue of the Gram matrix of the two unit tangents.
pub fn angle_factor(tangents: &[Vector; 2]) -> f64 {
    let [a, b] = tangents;
    (1.0 - dot(*a, *b).abs() / (norm(*a) * norm(*b))).max(0.0).sqrt() / MARGIN
}

/// How far the tangents are off, relative to their lengths.
pub fn relative(tangents: &[Vector; 2], off: &[f64; 2]) -> f64 {
    let [a, b] = [0, 1].map(|k| off[k] / norm(tangents[k]));
    (a * a + b * b).sqrt()
}
