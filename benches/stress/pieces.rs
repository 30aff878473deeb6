//! The Bezier pieces of a design, computed on their own: by polar forms in doubled precision, recentred, rounded.
//!
//! Nothing here is taken from the library. Points and derivatives come in the local parameters of a piece, each
//! from 0 to 1, relative to a query; a curve is a surface of degree 0 in v.
//!
//! Reference: Ramshaw, *Blossoms are polar forms*, 1989.

use super::design::Design;
use super::double::Double;
use super::shapes::Vector;

/// Three weighted coordinates and the weight.
pub type Homogeneous = [Double; 4];

const ORDER: usize = 32;

/// A piece by its place among the spans, and local parameters in it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    pub piece: [usize; 2],
    pub at: [f64; 2],
}

/// Vector from the query to the point, and its derivatives in the local parameters.
#[derive(Clone, Copy, Debug)]
pub struct Jet {
    pub d: Vector,
    pub s: Vector,
    pub t: Vector,
    pub ss: Vector,
    pub st: Vector,
    pub tt: Vector,
}

struct Net {
    center: Vector,
    /// Weighted poles relative to the centre; t runs fastest.
    poles: Vec<[f64; 4]>,
}

/// All pieces of a design.
pub struct Pieces {
    pub degrees: [usize; 2],
    /// The spans by the index of the knot before them.
    pub spans: [Vec<usize>; 2],
    /// Where the spans begin, and the last one's end.
    pub breaks: [Vec<f64>; 2],
    nets: Vec<Net>,
}

/// The weighted pole, relative to the first one.
pub fn homogeneous(design: &Design, k: usize) -> Homogeneous {
    let weight = design.weight(k);
    let part = |axis: usize| {
        Double::sum(design.poles[k][axis], -design.poles[0][axis]).times(Double::of(weight))
    };
    [part(0), part(1), part(2), Double::of(weight)]
}

/// `(1 - x) a + x b`
pub fn mix(a: &Homogeneous, b: &Homogeneous, x: Double) -> Homogeneous {
    let rest = Double::of(1.0).minus(x);
    [0, 1, 2, 3].map(|k| a[k].times(rest).plus(b[k].times(x)))
}

/// The Bezier poles of a span from its local poles.
fn bezier(knots: &[f64], degree: usize, span: usize, local: &[Homogeneous]) -> Vec<Homogeneous> {
    let (a, b) = (knots[span], knots[span + 1]);
    let is_clamped = knots[span + 1 - degree..=span].iter().all(|u| *u == a)
        && knots[span + 1..=span + degree].iter().all(|u| *u == b);
    if is_clamped {
        return local.to_vec();
    }
    let polar = |j: usize| {
        let mut row = local.to_vec();
        for level in 1..=degree {
            let argument = if level <= j { b } else { a };
            for k in (level..=degree).rev() {
                let i = span + k - degree;
                let (low, high) = (knots[i], knots[i + degree + 1 - level]);
                let x = Double::sum(argument, -low).over(Double::sum(high, -low));
                row[k] = mix(&row[k - 1], &row[k], x);
            }
        }
        row[degree]
    };
    (0..=degree).map(polar).collect()
}

fn spans(knots: &[f64], degree: usize, count: usize) -> Vec<usize> {
    (degree..count).filter(|i| knots[*i] < knots[i + 1]).collect()
}

impl Pieces {
    pub fn new(design: &Design) -> Self {
        let ([p, q], [ku, kv]) = (design.degrees, &design.knots);
        let spans = [0, 1].map(|k| spans(&design.knots[k], design.degrees[k], design.counts[k]));
        let breaks = [0, 1].map(|k| {
            let starts = spans[k].iter().map(|i| design.knots[k][*i]);
            starts.chain([design.knots[k][design.counts[k]]]).collect()
        });
        let columns = design.counts[1];
        let mut nets = Vec::new();
        for i in &spans[0] {
            // Rows of Bezier poles in u, for every column of the design.
            let mut strip = vec![Vec::new(); p + 1];
            for column in 0..columns {
                let local: Vec<Homogeneous> =
                    (i - p..=*i).map(|row| homogeneous(design, row * columns + column)).collect();
                for (row, pole) in strip.iter_mut().zip(bezier(ku, p, *i, &local)) {
                    row.push(pole);
                }
            }
            for j in &spans[1] {
                let rows = strip.iter().flat_map(|row| bezier(kv, q, *j, &row[j - q..=*j]));
                nets.push(Net::new(&rows.collect::<Vec<_>>(), design.poles[0]));
            }
        }
        Self { degrees: design.degrees, spans, breaks, nets }
    }

    fn net(&self, piece: [usize; 2]) -> &Net {
        &self.nets[piece[0] * self.spans[1].len() + piece[1]]
    }

    /// First parameter and length of a span.
    pub fn interval(&self, direction: usize, piece: usize) -> [f64; 2] {
        let breaks = &self.breaks[direction];
        [breaks[piece], breaks[piece + 1] - breaks[piece]]
    }

    /// Where a pair of the caller's parameters is: in the later piece at a knot.
    pub fn place(&self, parameters: [f64; 2]) -> Place {
        let found = [0, 1].map(|k| {
            let last = self.spans[k].len() - 1;
            let after = self.breaks[k].partition_point(|b| *b <= parameters[k]);
            let piece = after.saturating_sub(1).min(last);
            let [start, length] = self.interval(k, piece);
            (piece, ((parameters[k] - start) / length).clamp(0.0, 1.0))
        });
        Place { piece: found.map(|f| f.0), at: found.map(|f| f.1) }
    }

    /// The caller's parameters of a place, rounded.
    pub fn parameters(&self, place: &Place) -> [f64; 2] {
        [0, 1].map(|k| {
            let [start, length] = self.interval(k, place.piece[k]);
            (start + place.at[k] * length).clamp(start, self.breaks[k][place.piece[k] + 1])
        })
    }

    /// The point, relative to the query.
    pub fn point(&self, place: &Place, query: Vector) -> Vector {
        let (net, [p, q]) = (self.net(place.piece), self.degrees);
        let (bs, bt) = (values(p, place.at[0]), values(q, place.at[1]));
        let mut sum = [0.0; 4];
        for (i, row) in net.poles.chunks_exact(q + 1).enumerate() {
            let mut part = [0.0; 4];
            for (b, pole) in bt.iter().zip(row) {
                add(&mut part, *b, pole);
            }
            add(&mut sum, bs[i], &part);
        }
        [0, 1, 2].map(|k| sum[k] / sum[3] - (query[k] - net.center[k]))
    }

    /// The point relative to the query, with its first and second derivatives.
    pub fn jet(&self, place: &Place, query: Vector) -> Jet {
        let (net, [p, q]) = (self.net(place.piece), self.degrees);
        let (bs, bt) = (with_derivatives(p, place.at[0]), with_derivatives(q, place.at[1]));
        let mut sums = [[0.0; 4]; 6];
        for (i, row) in net.poles.chunks_exact(q + 1).enumerate() {
            let mut parts = [[0.0; 4]; 3];
            for (j, pole) in row.iter().enumerate() {
                for (part, b) in parts.iter_mut().zip(&bt) {
                    add(part, b[j], pole);
                }
            }
            let orders = [(0, 0), (1, 0), (0, 1), (2, 0), (1, 1), (0, 2)];
            for (sum, (a, b)) in sums.iter_mut().zip(orders) {
                add(sum, bs[a][i], &parts[b]);
            }
        }
        divide(&sums, [0, 1, 2].map(|k| query[k] - net.center[k]))
    }
}

impl Net {
    fn new(poles: &[Homogeneous], reference: Vector) -> Self {
        let middle = poles[poles.len() / 2];
        let center = [0, 1, 2].map(|k| middle[k].over(middle[3]).plus(Double::of(reference[k])).0);
        let moved = |pole: &Homogeneous| {
            let part = |k: usize| {
                pole[k].minus(Double::sum(center[k], -reference[k]).times(pole[3])).value()
            };
            [part(0), part(1), part(2), pole[3].value()]
        };
        Self { center, poles: poles.iter().map(moved).collect() }
    }
}

fn add(sum: &mut [f64; 4], factor: f64, pole: &[f64; 4]) {
    for k in 0..4 {
        sum[k] += factor * pole[k];
    }
}

/// Derivatives of the quotient, from those of the weighted sums in the order 1, s, t, ss, st, tt.
fn divide(sums: &[[f64; 4]; 6], query: Vector) -> Jet {
    let weight = [0, 1, 2, 3, 4, 5].map(|k| sums[k][3] / sums[0][3]);
    let raw = |order: usize, k: usize| sums[order][k] / sums[0][3];
    let point = [0, 1, 2].map(|k| raw(0, k));
    let first = |order: usize| [0, 1, 2].map(|k| raw(order, k) - weight[order] * point[k]);
    let (s, t) = (first(1), first(2));
    let second = |order: usize, a: usize, ds: Vector, b: usize, dt: Vector| {
        [0, 1, 2].map(|k| {
            raw(order, k) - weight[a] * dt[k] - weight[b] * ds[k] - weight[order] * point[k]
        })
    };
    Jet {
        d: [0, 1, 2].map(|k| point[k] - query[k]),
        s,
        t,
        ss: second(3, 1, s, 1, s),
        st: second(4, 1, s, 2, t),
        tt: second(5, 2, t, 2, t),
    }
}

/// The Bernstein polynomials of a degree.
fn values(degree: usize, x: f64) -> [f64; ORDER] {
    let mut row = [0.0; ORDER];
    row[0] = 1.0;
    for n in 1..=degree {
        raise(&mut row, n, x);
    }
    row
}

/// From degree n - 1 to n.
fn raise(row: &mut [f64; ORDER], n: usize, x: f64) {
    let mut carried = 0.0;
    for b in &mut row[..=n] {
        let next = x * *b;
        *b = (1.0 - x) * *b + carried;
        carried = next;
    }
}

/// The Bernstein polynomials, their first and their second derivatives.
fn with_derivatives(degree: usize, x: f64) -> [[f64; ORDER]; 3] {
    let mut rows = [[0.0; ORDER]; 3];
    let mut row = [0.0; ORDER];
    row[0] = 1.0;
    for n in 0..=degree {
        if n > 0 {
            raise(&mut row, n, x);
        }
        let factor = degree as f64;
        if n + 2 == degree {
            let factor = factor * (factor - 1.0);
            for i in 0..=n {
                let b = factor * row[i];
                rows[2][i] += b;
                rows[2][i + 1] -= 2.0 * b;
                rows[2][i + 2] += b;
            }
        } else if n + 1 == degree {
            for i in 0..=n {
                rows[1][i] -= factor * row[i];
                rows[1][i + 1] += factor * row[i];
            }
        }
    }
    rows[0] = row;
    rows
}
