//! From a place of the carrier to the piece and local parameters that give it.
//!
//! ```text
//!   isoline in s -> one coordinate of the carrier: a plane curve P(s), seen from the origin
//!   angle        P = (x, y)        length x    P = (X, W), direction (x, 1)
//!   find         which piece's directions hold the one asked for, then  cross(P(s), direction) = 0
//! ```
//!
//! Directions are compared by a number that grows with the angle and needs no trigonometry. Up to degree 2 the equation is
//! solved in closed form, so that a Newton step on the surface moves by rounding only.
//! Limit: each of the carrier's coordinates must be constant along one of the two kinds of isolines.

use super::fit::{PLACES, Samples};
use super::linear::{frame, unit};
use super::{Carrier, Direction, Kind, Pieces, length};
use crate::bezier::isocurve;
use crate::bounds::{Vector, add, cross, dot, norm, scaled, sub};
use crate::knots::MAX_DEGREE;

/// How well a coordinate must be constant along an isoline. Loose: the iteration corrects what is left, the proof judges.
const CONSTANT: f64 = 1e-8;
/// Places looked at in a piece to see that it turns one way.
const CHECKS: usize = 8;
/// Newton steps in a piece of degree 3 and more.
const STEPS: usize = 8;
/// A step of the local parameter below which the next one is rounding.
const LAST_STEP: f64 = 1e-9;

/// `|a| |b|` times the sine of the angle from a to b.
pub fn turn(a: Direction, b: Direction) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

/// Grows from 0 to 4 with the angle of (x, y) from the first axis; opposite directions differ by 2.
pub fn pseudo_angle(x: f64, y: f64) -> f64 {
    let share = y / (x.abs() + y.abs());
    if x < 0.0 {
        2.0 - share
    } else if y < 0.0 {
        4.0 + share
    } else {
        share
    }
}

/// One coordinate of the carrier along one kind of isolines.
#[derive(Clone, Debug)]
pub struct Table {
    start: Direction,
    /// 1 when directions turn from the first axis to the second, else -1.
    sense: f64,
    /// Pseudo-angles from the start at which pieces end.
    ends: Vec<f64>,
    degree: usize,
    /// Plane Bezier curves, one after the other.
    poles: Vec<Direction>,
}

impl Table {
    /// The table of plane curves; none when they do not turn one way, once round at most.
    fn new(poles: Vec<Direction>, degree: usize) -> Option<Self> {
        let first = |k: usize| poles[k * (degree + 1)];
        let size = length(first(0));
        let start = first(0).map(|x| x / size);
        let count = poles.len() / (degree + 1);
        let mut table = Self { start, sense: 1.0, ends: Vec::with_capacity(count), degree, poles };
        let quarter = table.value(0, 1.0 / CHECKS as f64);
        if turn(start, quarter) < 0.0 {
            table.sense = -1.0;
        }
        let mut last = 0.0;
        for k in 0..count {
            for check in 1..=CHECKS {
                let mut angle = table.angle(table.value(k, check as f64 / CHECKS as f64));
                let closes = k + 1 == count && check == CHECKS && last > 2.0;
                if closes && !(1e-9..4.0 - 1e-9).contains(&angle) {
                    angle = 4.0;
                }
                let way = angle - last;
                if way.is_nan() || way <= 0.0 || way > 2.0 {
                    return None;
                }
                last = angle;
            }
            table.ends.push(last);
        }
        Some(table)
    }

    fn value(&self, piece: usize, s: f64) -> Direction {
        let n = self.degree;
        let poles = &self.poles[piece * (n + 1)..(piece + 1) * (n + 1)];
        let mut out = [0.0; 2];
        for c in 0..2 {
            let mut work = [0.0; MAX_DEGREE + 1];
            poles.iter().zip(&mut work).for_each(|(pole, x)| *x = pole[c]);
            out[c] = bernstein(&mut work, n, s).0;
        }
        out
    }

    /// Pseudo-angle from the start, in the sense of the table.
    fn angle(&self, direction: Direction) -> f64 {
        let [x, y] = self.start;
        let ahead = x * direction[0] + y * direction[1];
        pseudo_angle(ahead, self.sense * turn(self.start, direction))
    }

    /// The piece and the parameter in it that has a direction; the nearest end when none has it.
    pub fn find(&self, direction: Direction) -> (usize, f64) {
        let angle = self.angle(direction);
        let last = self.ends[self.ends.len() - 1];
        if angle.is_nan() || angle > last {
            let beyond = angle - last < 0.5 * (4.0 - last);
            return if beyond { (self.ends.len() - 1, 1.0) } else { (0, 0.0) };
        }
        let piece = self.ends.partition_point(|end| *end < angle);
        (piece, self.solve(piece, direction))
    }

    fn solve(&self, piece: usize, direction: Direction) -> f64 {
        let n = self.degree;
        let poles = &self.poles[piece * (n + 1)..(piece + 1) * (n + 1)];
        let side = |k: usize| self.sense * turn(poles[k], direction);
        let (a, c) = (side(0), side(n));
        // What has the direction of an end, but for rounding, is that end.
        if a <= 0.0 {
            return 0.0;
        }
        if c >= 0.0 {
            return 1.0;
        }
        match n {
            1 => a / (a - c),
            2 => {
                let b = side(1);
                let root = (b * b - a * c).sqrt();
                if b > 0.0 { (b + root) / (b + root - c) } else { a / (a + root - b) }
            }
            _ => self.iterated(poles, direction, a / (a - c)),
        }
    }

    /// The zero between a positive and a negative end, by Newton steps inside the bracket.
    fn iterated(&self, poles: &[Direction], direction: Direction, start: f64) -> f64 {
        let mut sides = [0.0; MAX_DEGREE + 1];
        for (x, pole) in sides.iter_mut().zip(poles) {
            *x = self.sense * turn(*pole, direction);
        }
        let (mut low, mut high, mut s) = (0.0, 1.0, start);
        for _ in 0..STEPS {
            let mut work = sides;
            let (value, slope) = bernstein(&mut work, self.degree, s);
            if value > 0.0 {
                low = s
            } else {
                high = s
            }
            let mut next = s - value / slope;
            if !(next > low && next < high) {
                next = 0.5 * (low + high);
            }
            let step = (next - s).abs();
            s = next;
            if step < LAST_STEP {
                break;
            }
        }
        s
    }

    /// The directions of its first and last end, counterclockwise.
    pub fn ends(&self) -> [Direction; 2] {
        let last = self.poles[self.poles.len() - 1];
        let last = last.map(|x| x / length(last));
        if self.sense > 0.0 { [self.start, last] } else { [last, self.start] }
    }

    /// Bytes held.
    pub fn memory(&self) -> usize {
        self.ends.capacity() * 8 + self.poles.capacity() * 16
    }
}

/// Value and derivative of a Bernstein form of degree `n >= 1`; the coefficients are used up.
fn bernstein(work: &mut [f64], n: usize, s: f64) -> (f64, f64) {
    for level in (2..=n).rev() {
        for k in 0..level {
            work[k] = (1.0 - s) * work[k] + s * work[k + 1];
        }
    }
    let slope = n as f64 * (work[1] - work[0]);
    ((1.0 - s) * work[0] + s * work[1], slope)
}

impl Carrier {
    /// The two coordinates of a homogeneous point in the carrier's frame, `out` being the direction from the axis in
    /// whose half plane it lies.
    fn coordinates(&self, [x, y, z]: Vector, w: f64, out: Direction) -> [Direction; 2] {
        let rho = x * out[0] + y * out[1];
        match self.kind {
            Kind::Line => [[z, w]; 2],
            Kind::Circle { .. } => [[x, y]; 2],
            Kind::Plane => [[x, w], [y, w]],
            Kind::Cylinder { .. } => [[x, y], [z, w]],
            // Along the cone, so that it has the scale of the bounds.
            Kind::Cone { cos, .. } => [[x, y], [z / cos, w]],
            Kind::Sphere { .. } => [[x, y], [rho, z]],
            Kind::Torus { major, .. } => [[x, y], [rho - major * w, z]],
        }
    }

    fn coordinates_of(&self, point: Vector) -> [Direction; 2] {
        let p = self.local(point);
        let rho = length([p[0], p[1]]);
        self.coordinates(p, 1.0, [p[0] / rho, p[1] / rho])
    }
}

/// Whether coordinate `own` of a carrier is constant where the share of direction `k` is.
fn is_constant(carrier: &Carrier, pieces: &Pieces, own: usize, k: usize) -> bool {
    PLACES.into_iter().all(|x| {
        let at = |y: f64| {
            let share = if k == 0 { [x, y] } else { [y, x] };
            carrier.coordinates_of(Samples::point(pieces, share))[own]
        };
        let first = at(PLACES[0]);
        PLACES.into_iter().skip(1).all(|y| {
            let other = at(y);
            let same = first[0] * other[0] + first[1] * other[1];
            turn(first, other).abs() <= CONSTANT * same
        })
    })
}

/// The plane curves of coordinate `own` along the isoline in the middle, in direction `k`.
fn table(carrier: &Carrier, pieces: &Pieces, own: usize, k: usize) -> Option<Table> {
    let (count, other) =
        if k == 0 { (pieces.rows, pieces.columns / 2) } else { (pieces.columns, pieces.rows / 2) };
    let middle = if pieces.is_curve { 0.0 } else { 0.5 };
    let mut poles = Vec::new();
    let mut degree = 0;
    for at in 0..count {
        let number = if k == 0 { at * pieces.columns + other } else { other * pieces.columns + at };
        let piece = (pieces.piece)(number);
        let net = piece.net;
        degree = if k == 0 { net.degree.s } else { net.degree.t };
        let mut lines: [Vec<f64>; 4] = std::array::from_fn(|_| vec![1.0; degree + 1]);
        for (component, line) in net.poles.chunks_exact(net.degree.count()).zip(&mut lines) {
            isocurve(&mut component.to_vec(), net.degree, k == 1, middle, line);
        }
        let shift = sub(piece.center, carrier.origin);
        let local = |i: usize| {
            let (w, pole) = (lines[3][i], [lines[0][i], lines[1][i], lines[2][i]]);
            let pole = add(pole, scaled(shift, w));
            (carrier.axes.map(|axis| dot(axis, pole)), w)
        };
        // Any pole off the axis says in which half plane the line lies.
        let far = |i: &usize| length([local(*i).0[0], local(*i).0[1]]) / local(*i).1;
        let widest = (0..=degree).max_by(|a, b| far(a).total_cmp(&far(b)))?;
        let ([x, y, _], _) = local(widest);
        let out = [x, y].map(|c| c / length([x, y]));
        poles.extend((0..=degree).map(|i| {
            let (pole, w) = local(i);
            carrier.coordinates(pole, w, out)[own]
        }));
    }
    Table::new(poles, degree)
}

/// The frames that suit a carrier whose own frame is not settled by its shape: a sphere's axis may be perpendicular to the
/// isolines of either kind, a plane's axes along them.
fn frames(carrier: &Carrier, pieces: &Pieces) -> Vec<[Vector; 3]> {
    let line = |k: usize| {
        [0, 1, 3].map(|i| {
            let share = if k == 0 { [PLACES[i], 0.5] } else { [0.5, PLACES[i]] };
            Samples::point(pieces, share)
        })
    };
    match carrier.kind {
        Kind::Sphere { .. } => [0, 1]
            .map(line)
            .map(|[a, b, c]| cross(unit(sub(b, a)), unit(sub(c, a))))
            .into_iter()
            .filter(|axis| norm(*axis) > 1e-3)
            .map(super::linear::any_frame)
            .collect(),
        Kind::Plane => {
            let [a, _, c] = line(0);
            vec![frame(carrier.axes[2], sub(c, a))]
        }
        _ => vec![carrier.axes],
    }
}

/// The tables of rows and columns, and whether rows have the carrier's first coordinate; with the carrier in the frame
/// in which they hold.
pub fn tables(carrier: Carrier, pieces: &Pieces) -> Option<(Carrier, [Table; 2], bool)> {
    if pieces.is_curve {
        let own = table(&carrier, pieces, 0, 0)?;
        let none = Table { ends: vec![4.0], poles: vec![[1.0, 0.0]; 2], degree: 1, ..own.clone() };
        // A line's coordinate is its second one.
        return Some((carrier, [own, none], carrier.kind != Kind::Line));
    }
    for axes in frames(&carrier, pieces) {
        let turned = Carrier { axes, ..carrier };
        // Another frame is another carrier, with another rounding and other bounds.
        let turned = if axes == carrier.axes {
            carrier
        } else if let Some(proven) = super::deviation::proven(turned, pieces) {
            proven
        } else {
            continue;
        };
        for rows_first in [true, false] {
            let own = usize::from(!rows_first);
            if is_constant(&turned, pieces, own, 0) && is_constant(&turned, pieces, 1 - own, 1) {
                let rows = table(&turned, pieces, own, 0)?;
                let columns = table(&turned, pieces, 1 - own, 1)?;
                return Some((turned, [rows, columns], rows_first));
            }
        }
    }
    None
}
