//! How two surfaces meet along a border: gap, angle of the normals, jump of the curvature across, each between two bounds.
//!
//! ```text
//!   a point of the border of the one, and its foot on the border of the other
//!     G0  their distance
//!     G1  the angle of the normals there, at most a right one: orientations do not count
//!     G2  the difference of the normal curvatures across the border, in the orientation in which the normals agree
//! ```
//!
//! Upper bounds: the border in intervals; for each, the part of the other border that may hold feet (the rest is proven to be
//! farther away); normals and curvatures of both as intervals.
//!
//! Limit: where feet are not unique (a border that comes back near to itself), all of them count.

use super::cell::Forms;
use super::hausdorff::{Directed, HausdorffOptions, Shape, hausdorff};
use super::interval::Interval;
use super::request::patch_piece;
use crate::bounds::{Vector, cross, dot, norm, scaled, sub};
use crate::closest::{QueryOptions, Workspace};
use crate::curve::Curve;
use crate::error::Error;
use crate::index::{IndexedCurve, IndexedSurface, Span, SurfaceIndex};
use crate::knots::Side;
use crate::portable::SameDigits;
use crate::surface::Surface;
use std::collections::VecDeque;

/// A greatest value along a border.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measured {
    /// Evaluated somewhere.
    pub lower: f64,
    /// Nowhere more, proven.
    pub upper: f64,
    /// Parameter of the first border where the lower one is.
    pub at: f64,
}

/// How two surfaces meet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Continuity {
    /// Greatest distance of a point of the first border from the second, length.
    pub gap: Measured,
    /// Greatest angle of the normals, radians, 0 to pi / 2.
    pub angle: Measured,
    /// Greatest difference of the normal curvatures across the border, 1 / length.
    pub curvature: Measured,
    /// Intervals looked at.
    pub intervals: u64,
}

/// Intervals at most.
const BUDGET: u64 = 4_000;

/// Intervals narrower than this share of a patch are not halved.
const NARROWEST: f64 = 5e-4;

/// Gap of the angle below which an interval is good enough, radians; that of the curvature as a share of what it is.
const ACCURACY: f64 = 1e-3;

/// One border of a surface: 0 u = u0, 1 u = u1, 2 v = v0, 3 v = v1.
struct Border<'a> {
    surface: &'a Surface,
    index: &'a SurfaceIndex,
    curve: IndexedCurve,
    side: usize,
}

/// The two values at one place.
struct Values {
    angle: f64,
    curvature: f64,
    /// The greater of the two curvatures.
    size: f64,
}

impl<'a> Border<'a> {
    fn new(
        surface: &'a IndexedSurface,
        side: usize,
        poll: &mut dyn FnMut() -> bool,
    ) -> Result<Self, Error> {
        let index = surface.index(poll)?;
        super::cell::check_degree(index.degree, index.rational)?;
        let surface = surface.surface();
        let [u0, u1, v0, v1] = surface.domain();
        let curve = match side {
            0 => surface.isocurve_u(u0),
            1 => surface.isocurve_u(u1),
            2 => surface.isocurve_v(v0),
            _ => surface.isocurve_v(v1),
        };
        Ok(Self { surface, index, curve: IndexedCurve::new(curve), side })
    }

    fn curve(&self) -> &Curve {
        self.curve.curve()
    }

    /// The patches along the border, in order, with their spans along it.
    fn patches(&self) -> Vec<(usize, Span)> {
        let (count, columns) = (self.index.patches.len(), self.index.columns);
        let rows = count / columns;
        let along_v = |a: usize| (0..columns).map(move |b| a * columns + b);
        let along_u = |b: usize| (0..rows).map(move |a| a * columns + b);
        let list: Vec<usize> = match self.side {
            0 => along_v(0).collect(),
            1 => along_v(rows - 1).collect(),
            2 => along_u(0).collect(),
            _ => along_u(columns - 1).collect(),
        };
        let span = |k: usize| {
            if self.side < 2 { self.index.patches[k].v } else { self.index.patches[k].u }
        };
        list.into_iter().map(|k| (k, span(k))).collect()
    }

    /// A local interval along the border as a box of the patch.
    fn cell(&self, x: [f64; 2]) -> [[f64; 2]; 2] {
        let end = if self.side.is_multiple_of(2) { [0.0; 2] } else { [1.0; 2] };
        if self.side < 2 { [end, x] } else { [x, end] }
    }

    fn place(&self, x: f64) -> [f64; 2] {
        let [u0, u1, v0, v1] = self.surface.domain();
        [[u0, x], [u1, x], [x, v0], [x, v1]][self.side]
    }

    /// Unit normal and normal curvature across the border, of the surface as it is oriented.
    fn values(&self, x: f64) -> Option<(Vector, f64)> {
        let mut d = [[0.0; 3]; 6];
        self.surface.partials_on(self.place(x), [Side::Above; 2], 2, &mut d);
        let normal = cross(d[1], d[2]);
        let size = norm(normal);
        if size == 0.0 || !size.is_finite() {
            return None;
        }
        let n = scaled(normal, 1.0 / size);
        let [l, m, q] = [3, 4, 5].map(|k| dot(n, d[k]));
        let (e, f, g) = (dot(d[1], d[1]), dot(d[1], d[2]), dot(d[2], d[2]));
        let (e, l, q) = if self.side < 2 { (g, q, l) } else { (e, l, q) };
        let ratio = f / e;
        Some((n, e * (q - ratio * (2.0 * m - ratio * l)) / (size * size)))
    }
}

fn angle(sine: f64) -> f64 {
    if sine >= 1.0 { std::f64::consts::FRAC_PI_2 } else { sine.max(0.0).arcsine() }
}

/// Bounds of the angle and of the difference of the curvatures for one interval of the first border.
struct Pair<'a, 'b> {
    first: &'b Border<'a>,
    second: &'b Border<'a>,
    forms: [Vec<Option<Forms>>; 2],
    work: Vec<f64>,
    workspace: Workspace,
    gap: f64,
}

impl Pair<'_, '_> {
    fn ask(&mut self, q: Vector, domain: Option<[f64; 2]>) -> crate::closest::FootPoint {
        let domain = domain.map(|[a, b]| [a, b, 0.0, 0.0]);
        let options = QueryOptions { domain, ..QueryOptions::default() };
        self.second.curve.closest(q, None, &options, &mut self.workspace, None)
    }

    /// Measures at one parameter of the first border.
    fn measure(&mut self, x: f64) -> Option<Values> {
        let point = self.first.curve().evaluate(x);
        let foot = self.ask(point, None);
        let ((n, a), (m, b)) = (self.first.values(x)?, self.second.values(foot.u)?);
        let flip = if dot(n, m) < 0.0 { -1.0 } else { 1.0 };
        let sine = norm(cross(n, m));
        Some(Values {
            angle: angle(sine),
            curvature: (a - flip * b).abs(),
            size: a.abs().max(b.abs()),
        })
    }

    /// The parameters of the second border that may be feet of the interval [x0, x1] of the first.
    fn feet(&mut self, x: [f64; 2]) -> [f64; 2] {
        let (start, end) = self.second.curve().domain();
        let middle = self.first.curve().evaluate(0.5 * (x[0] + x[1]));
        // The middle is nearer than this to every point of the interval.
        let reach = self.first.reach(x, middle) + self.gap;
        let ends = x.map(|x| {
            let point = self.first.curve().evaluate(x);
            self.ask(point, None).u
        });
        let mut feet = [ends[0].min(ends[1]), ends[0].max(ends[1])];
        let mut margin = (0.05 * (feet[1] - feet[0])).max(1e-6 * (end - start));
        for _ in 0..40 {
            let wide = [(feet[0] - margin).max(start), (feet[1] + margin).min(end)];
            let is_far = |pair: &mut Self, a: f64, b: f64| {
                b <= a || pair.ask(middle, Some([a, b])).lower_bound > reach * (1.0 + 1e-9)
            };
            let (low, high) = (is_far(self, start, wide[0]), is_far(self, wide[1], end));
            if low && high {
                return wide;
            }
            feet = [if low { feet[0] } else { wide[0] }, if high { feet[1] } else { wide[1] }];
            margin *= 2.0;
        }
        [start, end]
    }

    /// Upper bounds for an interval of a patch of the first border.
    fn bound(&mut self, k: usize, local: [f64; 2], x: [f64; 2]) -> Values {
        let (n, a) = self.known(0, k, local);
        let feet = self.feet(x);
        let mut worst = Values { angle: 0.0, curvature: 0.0, size: 0.0 };
        for (j, span) in self.second.patches() {
            let [low, high] = span.cover(feet);
            if high <= low {
                continue;
            }
            let (m, b) = self.known(1, j, [low, high]);
            let turned = product(&n, &m);
            let sizes = length(&n).low * length(&m).low;
            let sine = if sizes > 0.0 { length(&turned).high / sizes } else { f64::INFINITY };
            let along = n[0] * m[0] + n[1] * m[1] + n[2] * m[2];
            let differences = if along.low > 0.0 {
                (a - b).magnitude()
            } else if along.high < 0.0 {
                (a + b).magnitude()
            } else {
                (a - b).magnitude().max((a + b).magnitude())
            };
            let sharp = if along.holds_zero() { f64::INFINITY } else { sine };
            worst.angle = worst.angle.max(angle(sharp));
            worst.curvature = worst.curvature.max(differences);
        }
        worst
    }

    /// Normal and curvature of a part of border 0 or 1.
    fn known(&mut self, border: usize, k: usize, x: [f64; 2]) -> ([Interval; 3], Interval) {
        let of = if border == 0 { self.first } else { self.second };
        let forms = &mut self.forms[border][k];
        let forms = forms.get_or_insert_with(|| Forms::new(&patch_piece(of.index, k)));
        let [s, t] = of.cell(x);
        let normal = forms.normal_on(s, t, &mut self.work);
        let direction = if of.side < 2 { 0 } else { 1 };
        let across = forms.across(direction, s, t, &mut self.work);
        (normal, across.times(of.index.frame.scale))
    }
}

impl Border<'_> {
    /// No point of the interval is farther than this from a point.
    fn reach(&self, x: [f64; 2], from: Vector) -> f64 {
        let Ok(index) = self.curve.index(&mut || false) else { return f64::INFINITY };
        let mut most = 0.0f64;
        for k in 0..index.segments.len() {
            let [a, b] = index.segments[k].u.cover(x);
            if a >= b {
                continue;
            }
            let piece = super::request::segment_piece(index, k);
            let scale = index.frame.scale;
            let q = sub(index.frame.enter(from), index.segments[k].center);
            let (poles, _) = piece.cut([0.0, 1.0], [a, b]);
            let far = poles.iter().map(|p| norm(sub(*p, q))).fold(0.0, f64::max);
            most = most.max((far + 4.0 * piece.error) / scale);
        }
        most
    }
}

fn product(a: &[Interval; 3], b: &[Interval; 3]) -> [Interval; 3] {
    [0, 1, 2].map(|k| {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        a[i] * b[j] - a[j] * b[i]
    })
}

fn length(a: &[Interval; 3]) -> Interval {
    (a[0].squared() + a[1].squared() + a[2].squared()).sqrt()
}

fn largest(best: &mut Measured, value: f64, at: f64) {
    if value > best.lower {
        (best.lower, best.at) = (value, at);
    }
}

/// How the border `side_a` of `a` meets the border `side_b` of `b`; sides 0 to 3 are u = u0, u = u1, v = v0, v = v1.
///
/// Cost: some ten microseconds an interval, at most 4000 of them; fewer when the normals turn little.
///
/// # Errors
/// A side above 3; degrees whose products are too long; memory that could not be had; [`Error::Cancelled`].
pub fn continuity(
    a: &IndexedSurface,
    side_a: usize,
    b: &IndexedSurface,
    side_b: usize,
    poll: &mut dyn FnMut() -> bool,
) -> Result<Continuity, Error> {
    for (name, side) in [("side_a", side_a), ("side_b", side_b)] {
        if side > 3 {
            return Err(Error::InvalidArgument(format!("{name}: {side} given, 0 to 3 accepted")));
        }
    }
    let (first, second) = (Border::new(a, side_a, poll)?, Border::new(b, side_b, poll)?);
    let options = HausdorffOptions { accuracy: 1e-6 * first.index.frame.diagonal, budget: 20_000 };
    let shapes = (Shape::Curve(&first.curve), Shape::Curve(&second.curve));
    let distance: Directed = hausdorff(shapes.0, shapes.1, &options, poll)?.forward;
    let gap = Measured { lower: distance.lower, upper: distance.upper, at: distance.at[0] };
    let empty = |border: &Border| (0..border.index.patches.len()).map(|_| None).collect();
    let forms = [empty(&first), empty(&second)];
    let mut pair = Pair {
        first: &first,
        second: &second,
        forms,
        work: Vec::new(),
        workspace: Workspace::default(),
        gap: distance.upper,
    };
    let mut waiting: VecDeque<(usize, Span, [f64; 2])> =
        first.patches().into_iter().map(|(k, span)| (k, span, [0.0, 1.0])).collect();
    let none = Measured { lower: 0.0, upper: 0.0, at: first.curve().domain().0 };
    let (mut angles, mut curvatures, mut intervals) = (none, none, 0);
    let mut size = 1.0 / first.index.frame.diagonal;
    while let Some((k, span, local)) = waiting.pop_front() {
        if intervals % 64 == 63 && poll() {
            return Err(Error::Cancelled);
        }
        intervals += 1;
        let x = local.map(|x| span.global(x));
        let at = span.global(0.5 * (local[0] + local[1]));
        for x in [x[0], at, x[1]] {
            if let Some(values) = pair.measure(x) {
                largest(&mut angles, values.angle, x);
                largest(&mut curvatures, values.curvature, x);
                size = size.max(values.size);
            }
        }
        let bound = pair.bound(k, local, x);
        let is_good = bound.angle <= angles.lower + ACCURACY
            && bound.curvature <= curvatures.lower + 10.0 * ACCURACY * size;
        let is_last = intervals >= BUDGET || local[1] - local[0] < NARROWEST;
        if is_good || is_last {
            angles.upper = angles.upper.max(bound.angle);
            curvatures.upper = curvatures.upper.max(bound.curvature);
            continue;
        }
        let middle = 0.5 * (local[0] + local[1]);
        waiting.push_back((k, span, [middle, local[1]]));
        waiting.push_back((k, span, [local[0], middle]));
    }
    angles.upper = angles.upper.max(angles.lower);
    curvatures.upper = curvatures.upper.max(curvatures.lower);
    Ok(Continuity { gap, angle: angles, curvature: curvatures, intervals })
}
