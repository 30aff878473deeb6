//! A curve of the domain put into a surface: `S(p(t))` piece by piece as Bernstein polynomials of t.
//!
//! A Bezier piece of the curve whose poles lie in the box `[a, b]` of u has the local poles
//!
//! ```text
//!   x_k = w_k (u_k - a) / (b - a),    r_k = w_k (b - u_k) / (b - a)        both >= 0
//!   B_i(u(t)) w(t)^p = C(p, i) x(t)^i r(t)^(p-i)                           a product of polynomials
//!   S(p(t)) = sum N_ij B_i(u(t)) B_j(v(t)) / sum W_ij B_i(u(t)) B_j(v(t))  degree d (p + q)
//! ```
//!
//! with the net N, W of the surface cut to the box. Every term is a mean of the net, so that rounding is a count of
//! half ulps of the net's size, whatever the degrees. Where the curve crosses a knot line it is cut there.
//!
//! References: DeRose, Goldman, Hagen, Mann, *Functional composition algorithms via blossoming*, 1993; Farouki, Rajan,
//! *Algorithms for polynomials in Bernstein form*, 1988 (products).
//! Limit: beyond a crossing known to a few ulps of the parameter the polynomial of the neighbouring span is used; what
//! that may move is part of the error.

use std::collections::HashMap;

use crate::bezier::{self, Bidegree, convolve, extraction};
use crate::bounds::{HALF_ULP, Vector, norm, sub};
use crate::curve::Curve;
use crate::error::Error;
use crate::knots::Knots;
use crate::surface::Surface;

/// Half ulps of the largest parameter by which a piece may lie beyond a knot line and still count as inside.
const SLACK: f64 = 64.0;

/// Poles beyond the domain by no more than this share of it are rounding, or the tolerance of a file.
const BEYOND: f64 = 1e-6;

/// Most pieces of one curve; a curve that wriggles along a knot line is refused before it takes all memory.
const MOST_PIECES: usize = 100_000;

/// A piece of the image: `center + sum B_k numerator_k / sum B_k weights_k` over `range`.
#[derive(Clone, Debug)]
pub struct Piece {
    /// Parameters of the curve.
    pub range: [f64; 2],
    /// Origin of the numerator.
    pub center: Vector,
    /// Bernstein coefficients, weight times vector from the centre.
    pub numerator: Vec<Vector>,
    /// Bernstein coefficients of the weight, positive.
    pub weights: Vec<f64>,
    /// How far a point of the piece may be from the exact image, in space.
    pub error: f64,
    /// Greatest distance of the surface's local net from the centre.
    pub radius: f64,
}

/// Homogeneous Bezier poles of the part `range` of a curve inside one span, seen from `center`.
#[derive(Clone, Debug)]
pub struct Arc {
    /// Weight times vector from the centre.
    pub numerator: Vec<Vector>,
    /// Weights.
    pub weights: Vec<f64>,
    /// Greatest distance of a pole of the span from the centre.
    pub radius: f64,
}

/// The part `range` of `curve`, inside the span `span`.
pub fn arc(curve: &Curve, span: usize, range: [f64; 2], center: Vector) -> Arc {
    let p = curve.degree();
    let mut matrix = vec![0.0; (p + 1) * (p + 1)];
    extraction(curve.knots(), span, range, &mut matrix);
    let poles = &curve.poles()[span - p..=span];
    let weights = curve.weights().filter(|_| curve.is_rational());
    let weight = |j: usize| weights.map_or(1.0, |weights| weights[span - p + j]);
    let mut arc = Arc { numerator: Vec::new(), weights: Vec::new(), radius: 0.0 };
    for row in matrix.chunks_exact(p + 1) {
        let mut sum = [0.0; 4];
        for (j, m) in row.iter().enumerate() {
            crate::curve::add_scaled(&mut sum, m * weight(j), &poles[j], center);
        }
        arc.numerator.push([sum[0], sum[1], sum[2]]);
        arc.weights.push(sum[3]);
    }
    arc.radius = poles.iter().fold(0.0, |most: f64, pole| most.max(norm(sub(*pole, center))));
    arc
}

/// Binomials `C(n, k)` of one `n`; beyond the table of `bezier` by Pascal's rule, one rounding a row.
pub fn binomials(n: usize) -> Vec<f64> {
    let table = n.min(bezier::MAX_TRIPLE - 1);
    let mut row: Vec<f64> = (0..=table).map(|k| bezier::binomial(table, k)).collect();
    row.resize(n + 1, 0.0);
    for length in table + 1..=n {
        for k in (1..=length).rev() {
            row[k] += row[k - 1];
        }
    }
    row
}

/// Product of two polynomials whose coefficients carry their binomials.
pub fn product(f: &[f64], g: &[f64]) -> Vec<f64> {
    let mut out = vec![0.0; f.len() + g.len() - 1];
    let degree = |c: &[f64]| Bidegree { s: 0, t: c.len() - 1 };
    convolve(f, degree(f), g, degree(g), 1.0, &mut out);
    out
}

/// Multiplies coefficients by their binomials.
pub fn raised(mut coefficients: Vec<f64>) -> Vec<f64> {
    let row = binomials(coefficients.len() - 1);
    coefficients.iter_mut().zip(row).for_each(|(x, b)| *x *= b);
    coefficients
}

/// The inverse of [`raised`].
pub fn lowered(mut coefficients: Vec<f64>) -> Vec<f64> {
    let row = binomials(coefficients.len() - 1);
    coefficients.iter_mut().zip(row).for_each(|(x, b)| *x /= b);
    coefficients
}

/// A Bezier piece of a curve of the domain.
struct Part {
    range: [f64; 2],
    /// u, v of the poles.
    poles: Vec<[f64; 2]>,
    weights: Vec<f64>,
    /// How far rounding may have moved the poles.
    error: [f64; 2],
}

impl Part {
    fn new(pcurve: &Curve, span: usize, range: [f64; 2]) -> Self {
        let p = pcurve.degree();
        let center = pcurve.poles()[span - p / 2];
        let arc = arc(pcurve, span, range, center);
        let place = |(n, w): (&Vector, &f64)| [center[0] + n[0] / w, center[1] + n[1] / w];
        let poles: Vec<[f64; 2]> = arc.numerator.iter().zip(&arc.weights).map(place).collect();
        let steps = (14 * p + 16) as f64 * HALF_ULP;
        let error = [0, 1].map(|k| {
            let active = &pcurve.poles()[span - p..=span];
            let size = |of: &dyn Fn(&Vector) -> f64| active.iter().map(of).fold(0.0, f64::max);
            let spread = size(&|pole| (pole[k] - center[k]).abs());
            steps * spread + 4.0 * HALF_ULP * size(&|pole| pole[k].abs())
        });
        Self { range, poles, weights: arc.weights, error }
    }

    fn extent(&self, k: usize) -> [f64; 2] {
        let of = |start: f64, pick: fn(f64, f64) -> f64| {
            self.poles.iter().map(|pole| pole[k]).fold(start, pick)
        };
        [of(f64::INFINITY, f64::min), of(f64::NEG_INFINITY, f64::max)]
    }

    fn is_shortest(&self) -> bool {
        let [a, b] = self.range;
        b - a <= 8.0 * HALF_ULP * a.abs().max(b.abs())
    }

    /// Where to cut, so that the parts lie on one side of `knot` if that can be had.
    fn cut(&self, pcurve: &Curve, k: usize, knot: f64) -> f64 {
        let [a, b] = self.range;
        let middle = a + 0.5 * (b - a);
        let signs = |poles: &[[f64; 2]]| -> usize {
            let beside: Vec<bool> =
                poles.iter().filter(|p| p[k] != knot).map(|p| p[k] > knot).collect();
            beside.windows(2).filter(|pair| pair[0] != pair[1]).count()
        };
        let (first, last) = (self.poles[0][k] - knot, self.poles[self.poles.len() - 1][k] - knot);
        if signs(&self.poles) != 1 || first * last >= 0.0 {
            return middle;
        }
        let (mut low, mut high) = (a, b);
        loop {
            let t = low + 0.5 * (high - low);
            if t <= low || t >= high {
                break;
            }
            let beyond = pcurve.evaluate(t)[k] - knot;
            if (beyond > 0.0) == (last > 0.0) { high = t } else { low = t }
        }
        if low > a {
            low
        } else if high < b {
            high
        } else {
            middle
        }
    }
}

/// A surface into which curves of its domain are put.
pub struct Composer<'a> {
    surface: &'a Surface,
    /// Bounds of |S_u|, |S_v| by span.
    speeds: HashMap<(usize, usize), [f64; 2]>,
}

impl<'a> Composer<'a> {
    /// For this surface.
    pub fn new(surface: &'a Surface) -> Self {
        Self { surface, speeds: HashMap::new() }
    }

    /// The surface.
    pub fn surface(&self) -> &'a Surface {
        self.surface
    }

    /// The curve with poles that lie beyond the domain by no more than 1e-6 of it moved to its border, and how far u and v of
    /// it may have moved.
    ///
    /// # Errors
    /// Memory that could not be had.
    pub fn brought_inside(&self, pcurve: &Curve) -> Result<(Curve, [f64; 2]), Error> {
        let mut moved = [0.0f64; 2];
        let ends = self.knots().map(Knots::domain);
        let mut poles = pcurve.poles().to_vec();
        for pole in &mut poles {
            for (k, (low, high)) in ends.into_iter().enumerate() {
                let off = (low - pole[k]).max(pole[k] - high);
                if 0.0 < off && off <= BEYOND * (high - low) {
                    pole[k] = pole[k].clamp(low, high);
                    moved[k] = moved[k].max(off);
                }
            }
        }
        if moved == [0.0; 2] {
            return Ok((pcurve.clone(), moved));
        }
        let inside =
            Curve::new(pcurve.knots().values(), pcurve.degree(), &poles, pcurve.weights())?;
        Ok((inside, moved))
    }

    /// Bounds of |Su| and |Sv| over the domain.
    pub fn speeds(&mut self) -> [f64; 2] {
        let [us, vs] = self.knots().map(|knots| knots.spans().collect::<Vec<_>>());
        let mut most = [0.0f64; 2];
        for &u in &us {
            for &v in &vs {
                let speed = self.speed([u, v]);
                most = [most[0].max(speed[0]), most[1].max(speed[1])];
            }
        }
        most
    }

    /// Refuses a curve whose ends, or ends of spans, are outside of the domain.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] with the place.
    pub fn check_inside(&self, pcurve: &Curve) -> Result<(), Error> {
        for span in pcurve.knots().spans() {
            let [a, b] = [pcurve.knots().values()[span], pcurve.knots().values()[span + 1]];
            self.check_ends(&Part::new(pcurve, span, [a, b]))?;
        }
        Ok(())
    }

    fn check_ends(&self, part: &Part) -> Result<(), Error> {
        for (k, knots) in self.knots().into_iter().enumerate() {
            let ((start, end), slack) = (knots.domain(), self.slack(part, k));
            for (pole, t) in part
                .poles
                .iter()
                .zip([part.range[0]])
                .chain(part.poles.iter().rev().zip([part.range[1]]))
            {
                if !(start - slack..=end + slack).contains(&pole[k]) {
                    let name = ["u", "v"][k];
                    return Err(Error::InvalidArgument(format!(
                        "pcurve: at {t:?} it leaves the domain, {name} = {:?}",
                        pole[k]
                    )));
                }
            }
        }
        Ok(())
    }

    /// How far a part may lie beyond a knot line and still count as inside.
    fn slack(&self, part: &Part, k: usize) -> f64 {
        let (start, end) = self.knots()[k].domain();
        SLACK * HALF_ULP * start.abs().max(end.abs()) + 2.0 * part.error[k]
    }

    /// The image of the part `range` of a curve (u, v, 0), in order.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] where the curve leaves the domain; [`Error::Unsupported`] for more than 100,000 pieces.
    pub fn compose(&mut self, pcurve: &Curve, range: [f64; 2]) -> Result<Vec<Piece>, Error> {
        let mut pieces = Vec::new();
        for span in pcurve.knots().spans().collect::<Vec<_>>() {
            let ends = [pcurve.knots().values()[span], pcurve.knots().values()[span + 1]];
            let part = [ends[0].max(range[0]), ends[1].min(range[1])];
            if part[0] < part[1] {
                self.compose_span(pcurve, span, part, &mut pieces)?;
            }
        }
        Ok(pieces)
    }

    /// As [`Self::compose`], for a part inside one span.
    fn compose_span(
        &mut self,
        pcurve: &Curve,
        span: usize,
        range: [f64; 2],
        pieces: &mut Vec<Piece>,
    ) -> Result<(), Error> {
        let mut waiting = vec![range];
        while let Some(range) = waiting.pop() {
            let part = Part::new(pcurve, span, range);
            match self.place(&part, pcurve)? {
                Ok(spans) => pieces.push(self.piece(&part, spans)),
                Err(t) => waiting.extend([[t, range[1]], [range[0], t]]),
            }
            if pieces.len() + waiting.len() > MOST_PIECES {
                let text = "pcurve: it runs back and forth over knot lines more than 100,000 times";
                return Err(Error::Unsupported(text.into()));
            }
        }
        Ok(())
    }

    fn knots(&self) -> [&'a Knots; 2] {
        [self.surface.knots_u(), self.surface.knots_v()]
    }

    /// The spans that hold a part, or where to cut it.
    fn place(&self, part: &Part, pcurve: &Curve) -> Result<Result<[usize; 2], f64>, Error> {
        self.check_ends(part)?;
        let mut spans = [0; 2];
        for (k, knots) in self.knots().into_iter().enumerate() {
            let slack = self.slack(part, k);
            let [low, high] = part.extent(k);
            let span = knots.span(low + 0.5 * (high - low));
            let [a, b] = [knots.values()[span], knots.values()[span + 1]];
            let inside = a - slack <= low && high <= b + slack;
            if !inside && !part.is_shortest() {
                let knot = if high > b + slack { b } else { a };
                return Ok(Err(part.cut(pcurve, k, knot)));
            }
            spans[k] = span;
        }
        Ok(Ok(spans))
    }

    /// Bounds of |S_u| and |S_v| on a pair of spans.
    fn speed(&mut self, spans: [usize; 2]) -> [f64; 2] {
        if let Some(speed) = self.speeds.get(&(spans[0], spans[1])) {
            return *speed;
        }
        let knots = self.knots();
        let ends = [0, 1].map(|k| [knots[k].values()[spans[k]], knots[k].values()[spans[k] + 1]]);
        let net = self.net(spans, ends);
        let width = net.degree.t + 1;
        let least = net.poles.iter().fold(f64::INFINITY, |least, pole| least.min(pole[3]));
        let bound = |k: usize| {
            let (step, degree) = if k == 0 { (width, net.degree.s) } else { (1, net.degree.t) };
            let mut most: f64 = 0.0;
            for (i, a) in net.poles.iter().enumerate() {
                let inside = if k == 0 { i + step < net.poles.len() } else { (i + 1) % width != 0 };
                if inside {
                    let b = net.poles[i + step];
                    let moved = norm([b[0] - a[0], b[1] - a[1], b[2] - a[2]]);
                    most = most.max(moved + net.radius * (b[3] - a[3]).abs());
                }
            }
            1.001 * degree as f64 * most / (least * (ends[k][1] - ends[k][0]))
        };
        let speed = [bound(0), bound(1)];
        self.speeds.insert((spans[0], spans[1]), speed);
        speed
    }

    /// The greatest speeds on a pair of spans and those beside it.
    fn speed_around(&mut self, spans: [usize; 2]) -> [f64; 2] {
        let knots = self.knots();
        let beside = [0, 1].map(|k| {
            let values = knots[k].values();
            let (a, b) = (values[spans[k]], values[spans[k] + 1]);
            let mut all = vec![spans[k]];
            if a > knots[k].domain().0 {
                all.push(values.partition_point(|&x| x < a) - 1);
            }
            if b < knots[k].domain().1 {
                all.push(knots[k].span(b));
            }
            all
        });
        let mut most = [0.0f64; 2];
        for &i in &beside[0] {
            for &j in &beside[1] {
                let speed = self.speed([i, j]);
                most = [most[0].max(speed[0]), most[1].max(speed[1])];
            }
        }
        most
    }

    /// The homogeneous net of the surface on a box inside a pair of spans.
    fn net(&self, spans: [usize; 2], ends: [[f64; 2]; 2]) -> Net {
        let [ku, kv] = self.knots();
        let (p, q) = (ku.degree(), kv.degree());
        let (mut mu, mut mv) = (vec![0.0; (p + 1) * (p + 1)], vec![0.0; (q + 1) * (q + 1)]);
        extraction(ku, spans[0], ends[0], &mut mu);
        extraction(kv, spans[1], ends[1], &mut mv);
        let place = |i: usize, j: usize| (spans[0] - p + i) * kv.pole_count() + spans[1] - q + j;
        let poles = self.surface.poles();
        let weights = self.surface.weights().filter(|_| self.surface.is_rational());
        let center = poles[place(p / 2, q / 2)];
        let (mut rows, mut radius) = (vec![[0.0; 4]; (p + 1) * (q + 1)], 0.0f64);
        for i in 0..=p {
            let mut row = [[0.0; 4]; 32];
            for (j, entry) in row[..=q].iter_mut().enumerate() {
                let pole = &poles[place(i, j)];
                let weight = weights.map_or(1.0, |weights| weights[place(i, j)]);
                crate::curve::add_scaled(entry, weight, pole, center);
                radius = radius.max(norm(sub(*pole, center)));
            }
            for (l, out) in rows[i * (q + 1)..(i + 1) * (q + 1)].iter_mut().enumerate() {
                for (m, entry) in mv[l * (q + 1)..(l + 1) * (q + 1)].iter().zip(&row) {
                    (0..4).for_each(|c| out[c] += m * entry[c]);
                }
            }
        }
        let mut net = vec![[0.0; 4]; (p + 1) * (q + 1)];
        for (n, out) in net.iter_mut().enumerate() {
            let (k, l) = (n / (q + 1), n % (q + 1));
            for i in 0..=p {
                let (m, entry) = (mu[k * (p + 1) + i], rows[i * (q + 1) + l]);
                (0..4).for_each(|c| out[c] += m * entry[c]);
            }
        }
        Net { degree: Bidegree { s: p, t: q }, poles: net, center, radius }
    }

    fn piece(&mut self, part: &Part, spans: [usize; 2]) -> Piece {
        let (knots, speed) = (self.knots(), self.speed(spans));
        let mut moved = part.error[0] * speed[0] + part.error[1] * speed[1];
        let ends = [0, 1].map(|k| {
            let [low, high] = part.extent(k);
            let (a, b) = (knots[k].values()[spans[k]], knots[k].values()[spans[k] + 1]);
            let beyond = (a - low).max(high - b);
            if beyond > 0.0 {
                moved += 2.0 * beyond * self.speed_around(spans)[k];
            }
            [low.clamp(a, b), high.clamp(a, b)]
        });
        let net = self.net(spans, ends);
        let bases = [0, 1].map(|k| powers(part, k, ends[k], [net.degree.s, net.degree.t][k]));
        let degree = (part.poles.len() - 1) * (net.degree.s + net.degree.t);
        let mut sums = [0, 1, 2, 3].map(|_| vec![0.0; degree + 1]);
        for (i, across) in bases[0].iter().enumerate() {
            let row = &net.poles[i * (net.degree.t + 1)..(i + 1) * (net.degree.t + 1)];
            for (c, sum) in sums.iter_mut().enumerate() {
                let mut along = vec![0.0; bases[1][0].len()];
                for (pole, basis) in row.iter().zip(&bases[1]) {
                    along.iter_mut().zip(basis).for_each(|(x, b)| *x += pole[c] * b);
                }
                sum.iter_mut().zip(product(across, &along)).for_each(|(x, y)| *x += y);
            }
        }
        let [x, y, z, w] = sums.map(lowered);
        let d = part.poles.len() - 1;
        let steps = (net.degree.s + net.degree.t) * (2 * d + 15) + 2 * degree + 24;
        let error = steps as f64 * HALF_ULP * 2.0 * net.radius + moved;
        let numerator = x.into_iter().zip(y).zip(z).map(|((x, y), z)| [x, y, z]).collect();
        let (center, radius, range) = (net.center, net.radius, part.range);
        Piece { range, center, numerator, weights: w, error, radius }
    }
}

struct Net {
    degree: Bidegree,
    poles: Vec<[f64; 4]>,
    center: Vector,
    radius: f64,
}

/// The basis functions of degree `p` at the parameter k of a part, times `w^p`, with their binomials.
fn powers(part: &Part, k: usize, [a, b]: [f64; 2], p: usize) -> Vec<Vec<f64>> {
    let width = b - a;
    let share = |length: f64, whole: f64| {
        if width > 0.0 { (length / width).clamp(0.0, 1.0) } else { whole }
    };
    let of = |share: &dyn Fn(f64) -> f64| {
        let poles = part.poles.iter().zip(&part.weights);
        raised(poles.map(|(pole, w)| w * share(pole[k])).collect())
    };
    let x = of(&|u| share(u - a, 0.0));
    let r = of(&|u| share(b - u, 1.0));
    let mut up = vec![vec![1.0]];
    let mut down = vec![vec![1.0]];
    for n in 0..p {
        up.push(product(&up[n], &x));
        down.push(product(&down[n], &r));
    }
    let scaled = |i: usize| {
        let b = bezier::binomial(p, i);
        product(&up[i], &down[p - i]).into_iter().map(|x| b * x).collect()
    };
    (0..=p).map(scaled).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn binomials_beyond_the_table_follow_pascal() {
        let (row, next) = (binomials(120), binomials(121));
        for k in 1..=120 {
            let sum = row[k - 1] + row[k];
            assert!((next[k] - sum).abs() <= 1e-13 * sum);
        }
        assert_eq!(binomials(4), [1.0, 4.0, 6.0, 4.0, 1.0]);
    }

    #[test]
    fn a_square_through_a_bilinear_patch_is_its_image() {
        let knots = [0., 0., 1., 1.];
        let poles = [[0., 0., 0.], [0., 1., 0.], [1., 0., 0.], [1., 1., 3.]];
        let surface = Surface::new(&knots, &knots, 1, 1, &poles, 2, 2, None).unwrap();
        let diagonal = Curve::new(&knots, 1, &[[0.0; 3], [1.0, 1.0, 0.0]], None).unwrap();
        let pieces = Composer::new(&surface).compose(&diagonal, [0.0, 1.0]).unwrap();
        assert_eq!(pieces.len(), 1);
        // (t, t, 3 t^2)
        let z: Vec<f64> = pieces[0].numerator.iter().map(|n| n[2] + pieces[0].center[2]).collect();
        assert_eq!(z, [0.0, 0.0, 3.0]);
        assert!(pieces[0].error < 1e-13);
    }
}
