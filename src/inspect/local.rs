//! The curvatures of a patch on a box, from models of its derivatives.
//!
//! ```text
//!   exact net -> derivatives, once a patch -> cut to the box -> cubic models -> shape operator [[a, b], [b, d]]
//! ```
//!
//! The formulas are those of [`super::cell`]. A rational patch X / W is divided first: with S = X / W,
//! `S_ss = (X_ss - 2 S_s W_s - S W_ss) / W` and so on.
//!
//! Smooth poles: a collapsed side t = 0 whose next row of poles is flat. With the pole in the origin and its tangent plane
//! z = 0 the patch is (t x, t y, t^2 z), and in the frame S_s / t, S_t nothing vanishes:
//!
//! ```text
//!   A = S_s / t = (x_s, y_s, t z_s)     B = S_t = (x + t x_t, y + t y_t, 2 t z + t^2 z_t)     A x B = (t n1, t n2, n3)
//!   l / t^3 = n1 x_ss + n2 y_ss + n3 z_ss      m / t^2 = n1 S_st.x + n2 S_st.y + n3 (2 z_s + t z_st)
//! ```

use super::cell::Known;
use super::chebyshev::{Nodes, Part, bernstein, expansion};
use super::doubled::{Doubled, UNIT};
use super::interval::Interval;
use super::model::Model;
use super::net::{Exact, ExactNet, Nets, Rounded};
use super::request::{Quantity, of_entries, sharper};
use crate::bezier::Bidegree;
use crate::bounds::{HALF_ULP, Vector, cross, dot, norm, scaled};
use crate::index::SurfaceIndex;
use crate::simd::Level;

/// Greatest distance of the poles next to a pole from a plane that counts as rounding, for a box diagonal of 1 to 2.
const ROUNDING: f64 = 2e-13;

/// The same as a share of the greatest coordinate: files have 15 digits, and a plane through three rounded points is off by
/// some times that.
const WRITTEN: f64 = 2e-14;

/// What counts as rounding, for a greatest coordinate.
pub(super) fn rounding(magnitude: f64) -> f64 {
    ROUNDING.max(WRITTEN * magnitude)
}

/// The point and its derivatives by s, t, ss, st and tt: x, y, z and the weight.
pub(super) type Homogeneous<T> = [[T; 6]; 4];

/// A polynomial and its derivatives by s, t, ss, st and tt.
struct Jet([Rounded; 6]);

impl Jet {
    fn new(f: &Exact) -> Self {
        let [s, t] = [f.derivative(0), f.derivative(1)];
        let second = [s.derivative(0), s.derivative(1), t.derivative(1)].map(|f| f.rounded());
        let [ss, st, tt] = second;
        Self([f.rounded(), s.rounded(), t.rounded(), ss, st, tt])
    }

    fn of(net: &ExactNet, c: usize) -> Self {
        let coefficients = net.component(c).to_vec();
        Self::new(&Exact { coefficients, degree: net.degree, error: net.error(c) })
    }
}

/// A patch in the coordinates in which its curvatures are formed.
pub(super) struct Form {
    position: [Jet; 3],
    weight: Option<Jet>,
    /// The side that is a smooth pole; its parameters are turned so that it is t = 0.
    pole: Option<usize>,
    is_mirrored: bool,
}

/// The forms of a patch: one, or one for each of its smooth poles.
pub(super) struct Local {
    forms: Vec<Form>,
    /// How far the patch was moved to be flat at its poles.
    pub moved: f64,
    /// For each side that is not exactly a point, the share of the patch from it on which the patch is no wider than the side is
    /// long; 1 for the others.
    pub short: [f64; 4],
}

/// What all boxes share, and the Bernstein polynomials on the present one.
#[derive(Default)]
pub(super) struct Room {
    nodes: Vec<Option<Nodes>>,
    ends: [[f64; 2]; 2],
    /// By direction and degree.
    parts: [Vec<Part>; 2],
    /// Which of them are those of the present box.
    made: [Vec<bool>; 2],
    work: Vec<f64>,
    level: Level,
}

/// The shape operator on a box.
struct Operator {
    a: Model,
    b: Model,
    d: Model,
}

/// First derivatives and second derivatives of a point, and what they are divided by being known.
struct Derivatives {
    first: [[Model; 3]; 2],
    second: [[Model; 3]; 3],
}

impl Room {
    /// Begins with a box.
    fn begin(&mut self, ends: [[f64; 2]; 2]) {
        for direction in 0..2 {
            if ends[direction] != self.ends[direction] {
                self.made[direction].fill(false);
            }
        }
        self.ends = ends;
    }

    /// Makes the polynomials of degree n on the box in one direction.
    fn make(&mut self, direction: usize, n: usize) {
        let (parts, made) = (&mut self.parts[direction], &mut self.made[direction]);
        if parts.len() <= n {
            parts.resize(n + 1, Part::default());
            made.resize(n + 1, false);
        }
        if made[n] {
            return;
        }
        if self.nodes.len() <= n {
            self.nodes.resize(n + 1, None);
        }
        let nodes = self.nodes[n].get_or_insert_with(|| Nodes::new(n));
        nodes.part(self.ends[direction], self.level, &mut self.work, &mut parts[n]);
        made[n] = true;
    }

    fn model(&mut self, f: &Rounded) -> Model {
        let Bidegree { s: m, t: n } = f.degree;
        self.make(0, m);
        self.make(1, n);
        let parts = [&self.parts[0][m], &self.parts[1][n]];
        Model::of(&expansion(f, parts, self.level, &mut self.work))
    }

    fn models(&mut self, jet: &Jet) -> [Model; 6] {
        std::array::from_fn(|k| self.model(&jet.0[k]))
    }
}

fn inner(a: &[Model; 3], b: &[Model; 3]) -> Model {
    a[0].times(&b[0]).plus(&a[1].times(&b[1])).plus(&a[2].times(&b[2]))
}

fn outer(a: &[Model; 3], b: &[Model; 3]) -> [Model; 3] {
    [0, 1, 2].map(|k| {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        a[i].times(&b[j]).minus(&a[j].times(&b[i]))
    })
}

/// f / w and its derivatives from those of f and w, with 1 / w.
fn quotient(f: &[Model; 6], w: &[Model; 6], inverse: &Model) -> [Model; 6] {
    let g = f[0].times(inverse);
    let gs = f[1].minus(&g.times(&w[1])).times(inverse);
    let gt = f[2].minus(&g.times(&w[2])).times(inverse);
    let twice = |a: &Model, b: &Model| a.times(b).scaled(2.0);
    let gss = f[3].minus(&twice(&gs, &w[1])).minus(&g.times(&w[3])).times(inverse);
    let mixed = gs.times(&w[2]).plus(&gt.times(&w[1]));
    let gst = f[4].minus(&mixed).minus(&g.times(&w[4])).times(inverse);
    let gtt = f[5].minus(&twice(&gt, &w[2])).minus(&g.times(&w[5])).times(inverse);
    [g, gs, gt, gss, gst, gtt]
}

impl Form {
    /// Of a net as it is.
    pub fn new(net: &ExactNet) -> Self {
        let of = |c: usize| Jet::of(net, c);
        let weight = net.rational.then(|| of(3));
        Self { position: [of(0), of(1), of(2)], weight, pole: None, is_mirrored: false }
    }

    /// The form about a smooth pole and how far the patch was moved for it; none when the pole is none.
    fn about_pole(nets: &mut Nets, k: usize, side: usize, more: f64) -> Option<(Self, f64)> {
        let corner = [[0.0, 0.0], [1.0, 0.0], [0.0, 0.0], [0.0, 1.0]][side];
        let exact = nets.net(k, corner);
        let Bidegree { s: p, t: q } = exact.degree;
        let first = [0, p * (q + 1), 0, q][side];
        let origin = exact.point(first);
        let (net, is_mirrored) = exact.about(origin).turned(side);
        let (degree, width) = (net.degree, net.degree.t + 1);
        let weight = |k: usize| if net.rational { net.component(3)[k].high } else { 1.0 };
        let at = |k: usize| [0, 1, 2].map(|c| net.component(c)[k].high / weight(k));
        let spread = (0..=degree.s).map(|i| norm(at(i * width))).fold(0.0, f64::max);
        let ways: Vec<Vector> = (0..=degree.s).map(|i| at(i * width + 1)).collect();
        let pairs = ways.iter().flat_map(|a| ways.iter().map(|b| cross(*a, *b)));
        let normal = pairs.max_by(|a, b| norm(*a).total_cmp(&norm(*b)))?;
        let longest = ways.iter().max_by(|a, b| norm(**a).total_cmp(&norm(**b)))?;
        let size = norm(normal);
        if size.is_nan() || size <= 1e-6 * dot(*longest, *longest) || size == 0.0 {
            return None;
        }
        let third = scaled(normal, 1.0 / size);
        let along = scaled(*longest, 1.0 / norm(*longest));
        let across = cross(third, along);
        let axes = [along, scaled(across, 1.0 / norm(across)), third];
        let gap = ways.iter().map(|way| dot(*way, third).abs()).fold(0.0, f64::max);
        if gap.is_nan() || gap > rounding(nets.magnitude()) {
            return None;
        }
        // The axes are unit vectors and normal to each other up to rounding: that much the patch is sheared.
        let radius = (0..degree.count()).map(|k| norm(at(k))).fold(0.0, f64::max);
        let moved = gap + spread + 16.0 * HALF_ULP * radius;
        let heavy = (0..degree.count()).map(weight).fold(0.0, f64::max);
        let errors = net.error(0) + net.error(1) + net.error(2);
        let error = 2.0 * errors + 16.0 * UNIT * radius * heavy + more * heavy;
        let component = |c: usize| {
            let flat = if c == 2 { 2 } else { 1 };
            if degree.t < flat {
                // Nothing but the flat rows.
                let degree = Bidegree { s: 0, t: 0 };
                return Jet::new(&Exact {
                    coefficients: vec![Doubled::default()],
                    degree,
                    error: 0.0,
                });
            }
            let coefficients = (0..degree.count())
                .map(|k| {
                    let terms = [0, 1, 2].map(|i| net.component(i)[k] * Doubled::new(axes[c][i]));
                    terms[0] + terms[1] + terms[2]
                })
                .collect();
            Jet::new(&Exact { coefficients, degree, error }.divided(flat))
        };
        let position = [component(0), component(1), component(2)];
        let weight = net.rational.then(|| Jet::of(&net, 3));
        Some((Self { position, weight, pole: Some(side), is_mirrored }, moved))
    }

    /// A box in the turned parameters.
    fn turned(&self, s: [f64; 2], t: [f64; 2]) -> [[f64; 2]; 2] {
        // Rounded outward where 1 - x is rounded; the ends 0 and 1 are kept.
        let back = |[a, b]: [f64; 2]| {
            let (low, high) = (1.0 - b, 1.0 - a);
            let is_exact = 1.0 - low == b && 1.0 - high == a;
            if is_exact { [low, high] } else { [low.next_down().max(0.0), high.next_up().min(1.0)] }
        };
        match self.pole {
            Some(0) => [t, s],
            Some(1) => [t, back(s)],
            Some(3) => [s, back(t)],
            _ => [s, t],
        }
    }

    /// The point and its derivatives in homogeneous coordinates over a box; of a form as its net is.
    pub fn homogeneous_on(&self, ends: [[f64; 2]; 2], room: &mut Room) -> Homogeneous<Interval> {
        room.begin(ends);
        let point = Interval::point;
        let [x, y, z] = [0, 1, 2].map(|c| room.models(&self.position[c]).map(|f| f.range()));
        let weight = match &self.weight {
            Some(weight) => room.models(weight).map(|f| f.range()),
            None => [1.0, 0.0, 0.0, 0.0, 0.0, 0.0].map(point),
        };
        [x, y, z, weight]
    }

    /// The same at a place, without bounds.
    pub fn homogeneous_at(&self, [s, t]: [f64; 2]) -> Homogeneous<f64> {
        let Bidegree { s: m, t: n } = self.position[0].0[0].degree;
        let bases = |n: usize, x: f64| (0..3).map(|k| bernstein(n.saturating_sub(k), x)).collect();
        let [by_s, by_t]: [Vec<Vec<f64>>; 2] = [bases(m, s), bases(n, t)];
        let value = |f: &Rounded| {
            let (by_s, by_t) = (&by_s[m - f.degree.s], &by_t[n - f.degree.t]);
            let row = |row: &[f64]| row.iter().zip(by_t).map(|(x, b)| x * b).sum::<f64>();
            let rows = f.coefficients.chunks_exact(f.degree.t + 1).zip(by_s);
            rows.map(|(values, b)| b * row(values)).sum::<f64>()
        };
        let of = |jet: &Jet| std::array::from_fn(|k| value(&jet.0[k]));
        let [x, y, z] = [0, 1, 2].map(|c| of(&self.position[c]));
        let weight = self.weight.as_ref().map_or([1.0, 0.0, 0.0, 0.0, 0.0, 0.0], of);
        [x, y, z, weight]
    }

    fn derivatives(&self, room: &mut Room) -> Option<Derivatives> {
        let Some(weight) = &self.weight else {
            let model =
                |k: usize, room: &mut Room| [0, 1, 2].map(|c| room.model(&self.position[c].0[k]));
            let first = [model(1, room), model(2, room)];
            return Some(Derivatives {
                first,
                second: [model(3, room), model(4, room), model(5, room)],
            });
        };
        let w = room.models(weight);
        let inverse = w[0].reciprocal()?;
        let parts = [0, 1, 2].map(|c| {
            let mut f = room.models(&self.position[c]);
            // About a point on the box: what is multiplied with the derivatives of the weight is small then.
            let centre = f[0].c[0] / w[0].c[0];
            for (f, w) in f.iter_mut().zip(&w) {
                *f = f.combined(-centre, w);
            }
            quotient(&f, &w, &inverse)
        });
        let of = |k: usize| [0, 1, 2].map(|c| parts[c][k]);
        Some(Derivatives { first: [of(1), of(2)], second: [of(3), of(4), of(5)] })
    }

    /// The shape operator on a box and how much the patch turns along s and t there.
    fn operator(&self, room: &mut Room) -> (Option<Operator>, [f64; 2]) {
        match self.pole {
            Some(_) => self.operator_at_pole(room),
            None => {
                let Some(d) = self.derivatives(room) else { return (None, [0.0; 2]) };
                let [s, t] = &d.first;
                let normal = outer(s, t);
                let metric = [inner(s, s), inner(s, t)];
                let second = [0, 1, 2].map(|k| inner(&normal, &d.second[k]));
                made(metric, inner(&normal, &normal), second, [s, t, &normal])
            }
        }
    }

    fn operator_at_pole(&self, room: &mut Room) -> (Option<Operator>, [f64; 2]) {
        let plain = [0, 1, 2].map(|c| room.models(&self.position[c]));
        let [x, y, z] = match &self.weight {
            None => plain,
            Some(weight) => {
                let w = room.models(weight);
                let Some(inverse) = w[0].reciprocal() else { return (None, [0.0; 2]) };
                plain.map(|f| quotient(&f, &w, &inverse))
            }
        };
        let t = Model::coordinate(1, room.ends[1]);
        let over = |f: &Model, more: &Model| f.plus(&t.times(more));
        let twice = |f: &Model| f.scaled(2.0);
        // S_tz / t and S_stz / t.
        let (rise, bend) = (over(&twice(&z[0]), &z[2]), over(&twice(&z[1]), &z[4]));
        let by_s = [x[1], y[1], t.times(&z[1])];
        let by_t = [over(&x[0], &x[2]), over(&y[0], &y[2]), t.times(&rise)];
        let n1 = y[1].times(&rise).minus(&z[1].times(&by_t[1]));
        let n2 = z[1].times(&by_t[0]).minus(&x[1].times(&rise));
        let n3 = x[1].times(&by_t[1]).minus(&y[1].times(&by_t[0]));
        let n = [n1, n2, n3];
        let normal = [t.times(&n1), t.times(&n2), n3];
        let l = inner(&n, &[x[3], y[3], z[3]]);
        let m = inner(&n, &[over(&x[1], &x[4]), over(&y[1], &y[4]), bend]);
        let by_tt = [
            over(&twice(&x[2]), &x[5]),
            over(&twice(&y[2]), &y[5]),
            twice(&z[0]).plus(&t.times(&over(&z[2].scaled(4.0), &z[5]))),
        ];
        let q = inner(&normal, &by_tt);
        let metric = [inner(&by_s, &by_s), inner(&by_s, &by_t)];
        made(metric, inner(&normal, &normal), [l, m, q], [&by_s, &by_t, &normal])
    }
}

/// The shape operator from the fundamental forms; and along which parameter a shorter box would tell more: as the operator varies
/// or, when its models are coarser than that, as the `frame` turns.
fn made(
    [e, f]: [Model; 2],
    area: Model,
    [l, m, q]: [Model; 3],
    frame: [&[Model; 3]; 3],
) -> (Option<Operator>, [f64; 2]) {
    let is_zero = |f: &Model| f.rest == 0.0 && f.c == [0.0; 10];
    let operator = (|| {
        if [&l, &m, &q].into_iter().all(is_zero) {
            // Exactly flat: there is nothing to divide.
            let zero = Model::constant(0.0);
            return Some(Operator { a: zero, b: zero, d: zero });
        }
        let (inverse, j) = (e.reciprocal()?, area.reciprocal_sqrt()?);
        let ratio = f.times(&inverse);
        let sheared = m.minus(&ratio.times(&l));
        let square = j.squared();
        let a = l.times(&inverse).times(&j);
        let b = sheared.times(&square);
        let d = e.times(&q.minus(&ratio.times(&m.plus(&sheared)))).times(&square.times(&j));
        Some(Operator { a, b, d })
    })();
    if let Some(Operator { a, b, d }) = &operator {
        let each = [a, b, d].map(Model::variation);
        let varies = [0, 1].map(|k| each[0][k] + each[1][k] + each[2][k]);
        if a.rest + b.rest + d.rest < 0.5 * (varies[0] + varies[1]) {
            return (operator, varies);
        }
    }
    let mut turn = [0.0; 2];
    for vector in frame {
        let size = norm(vector.map(|x| x.c[0])).max(f64::MIN_POSITIVE);
        for component in vector {
            let varies = component.variation();
            turn = [0, 1].map(|k| turn[k] + varies[k] / size);
        }
    }
    (operator, turn)
}

impl Operator {
    fn known(&self, quantity: Quantity, sign: f64) -> Known {
        let Self { a, b, d } = self;
        let (a, b, d) = (a.scaled(sign), b.scaled(sign), d.scaled(sign));
        let entries = [&a, &b, &d];
        let middle = of_entries(entries.map(Model::middle), quantity);
        let plain = of_entries(entries.map(Model::range), quantity);
        let gradient = [Interval::ENTIRE; 2];
        let better = |range: Interval| Known { middle, range: plain.and(range), gradient };
        let mean = a.plus(&d).scaled(0.5);
        if quantity == Quantity::Mean {
            return better(mean.range());
        }
        if quantity == Quantity::Gaussian {
            return better(a.times(&d).minus(&b.squared()).range());
        }
        let square = a.minus(&d).scaled(0.5).squared().plus(&b.squared());
        let (greater, less) = match square.sqrt() {
            Some(root) => (mean.plus(&root).range(), mean.minus(&root).range()),
            None => {
                let (mean, root) = (mean.range(), square.range().sqrt());
                (mean + root, mean - root)
            }
        };
        match quantity {
            Quantity::Greater => better(greater),
            Quantity::Less => better(less),
            _ => better(sharper(greater, less)),
        }
    }
}

impl Local {
    pub fn new(nets: &mut Nets, index: &SurfaceIndex, k: usize) -> Self {
        let collapsed = index.patches[k].collapsed;
        let sides: Vec<usize> = (0..4).filter(|&side| collapsed[side]).collect();
        // Two sides that meet in a corner leave no frame there.
        let is_apart = sides.iter().all(|side| side / 2 == sides[0] / 2);
        if !sides.is_empty() && is_apart {
            let poles = |nets: &mut Nets, more: f64| {
                sides.iter().map(|&side| Form::about_pole(nets, k, side, more)).collect()
            };
            let made: Option<Vec<(Form, f64)>> = poles(nets, 0.0);
            if let Some(made) = made {
                let moved = made.iter().map(|made| made.1).sum();
                // What was moved at one pole is off at the other.
                let made = if made.len() > 1 { poles(nets, moved) } else { Some(made) };
                let forms = made.into_iter().flatten().map(|made| made.0).collect();
                return Self { forms, moved, short: [1.0; 4] };
            }
        }
        let exact = nets.net(k, [0.5; 2]);
        let origin = exact.point(exact.degree.count() / 2);
        let exact = exact.about(origin);
        Self { forms: vec![Form::new(&exact)], moved: 0.0, short: exact.short_sides() }
    }

    /// Whether what is singular at its collapsed sides is divided out.
    pub fn is_smooth(&self) -> bool {
        self.forms.iter().any(|form| form.pole.is_some())
    }

    /// What is known of a quantity on a box of the patch.
    pub fn on(&self, s: [f64; 2], t: [f64; 2], quantity: Quantity, room: &mut Room) -> Known {
        // Of two poles the nearer one.
        let is_far = |form: &Form| match form.pole {
            Some(0) => s[0] + s[1] > 1.0,
            Some(1) => s[0] + s[1] < 1.0,
            Some(2) => t[0] + t[1] > 1.0,
            Some(3) => t[0] + t[1] < 1.0,
            _ => false,
        };
        let form = self.forms.iter().find(|form| !is_far(form)).unwrap_or(&self.forms[0]);
        room.begin(form.turned(s, t));
        let (operator, turn) = form.operator(room);
        let sign = if form.is_mirrored { -1.0 } else { 1.0 };
        let known = match operator {
            Some(operator) => operator.known(quantity, sign),
            None => Known::ENTIRE,
        };
        let turn = if form.pole.is_some_and(|side| side < 2) { [turn[1], turn[0]] } else { turn };
        let gradient = turn.map(|x| Interval { low: 0.0, high: if x.is_nan() { 0.0 } else { x } });
        Known { gradient, ..known }
    }
}
