//! What a shape is asked: the query points, with the places they were made from, and the hints.

use footpoint::refine::Method;

use super::design::Design;
use super::pieces::{Jet, Pieces, Place};
use super::search::{Scratch, Search, square};
use super::shapes::{Random, Vector, along, cross, dot, sub};

/// A query. Its `places` are where it was made from: often feet.
#[derive(Clone, Debug)]
pub struct Ask {
    pub kind: &'static str,
    pub query: Vector,
    pub places: Vec<Place>,
    pub hint: Option<[f64; 2]>,
    pub method: Method,
    /// Not the default: share of the diagonal.
    pub accuracy: Option<f64>,
    pub budget: Option<u64>,
}

impl Ask {
    /// Asked for less, or more, than the default promises.
    pub fn is_special(&self) -> bool {
        self.accuracy.is_some() || self.budget.is_some()
    }
}

/// What queries are made from.
pub struct Asker<'a> {
    pub design: &'a Design,
    pub pieces: &'a Pieces,
    pub search: &'a Search<'a>,
    /// u0, u1, v0, v1
    pub area: [f64; 4],
    pub diagonal: f64,
}

fn unit(a: Vector) -> Option<Vector> {
    let length = square(a).sqrt();
    (length > 0.0 && length.is_finite()).then(|| a.map(|x| x / length))
}

fn middle(a: Vector, b: Vector) -> Vector {
    [0, 1, 2].map(|k| 0.5 * (a[k] + b[k]))
}

impl Asker<'_> {
    pub fn ask(&self, r: &mut Random, scratch: &mut Scratch) -> Ask {
        let (kind, query, places) = loop {
            let made = self.made(r, scratch);
            if made.1.iter().all(|x| x.abs() < 1e90) {
                break made;
            }
        };
        let hint = (r.unit() < 0.25).then(|| self.hint(&places, r));
        let methods = [Method::Maf, Method::Newton, Method::Osculating];
        let method = if r.unit() < 0.1 { methods[r.whole(0, 2)] } else { Method::Auto };
        let accuracy = (r.unit() < 0.03).then(|| r.scale(-14.0, -2.0));
        let budget = (r.unit() < 0.03).then(|| r.whole(1, 300) as u64);
        Ask { kind, query, places, hint, method, accuracy, budget }
    }

    /// The place it was made from, a place of the other parameters, or no parameters at all.
    fn hint(&self, places: &[Place], r: &mut Random) -> [f64; 2] {
        let [u0, u1, v0, v1] = self.area;
        match r.whole(0, 5) {
            0 => [f64::NAN, 1e300],
            1 => [u0, v1],
            2 => [u1, v0],
            3 if !places.is_empty() => self.pieces.parameters(&places[0]),
            _ => [r.between(u0, u1), r.between(v0, v1)],
        }
    }

    fn made(&self, r: &mut Random, scratch: &mut Scratch) -> (&'static str, Vector, Vec<Place>) {
        let place = self.place(r);
        let (point, diagonal) = (self.point(&place), self.diagonal.max(1e-300));
        let near = |p: Vector, low: f64, high: f64, r: &mut Random| {
            along(p, r.direction(), diagonal * r.scale(low, high))
        };
        match r.whole(0, 15) {
            0 | 1 => ("on", point, vec![place]),
            2 => ("almost on", near(point, -15.0, -5.0, r), vec![place]),
            3 | 4 => {
                let side = if r.unit() < 0.5 { -1.0 } else { 1.0 };
                let n = self.normal(&place, r);
                ("normal", along(point, n, side * diagonal * r.scale(-12.0, 0.0)), vec![place])
            }
            5 => self.beside_a_pole(r),
            6 => ("box", self.in_the_box(r), vec![]),
            7 => {
                let place = self.on_a_border(r);
                let point = self.point(&place);
                let is_on = r.unit() < 0.4;
                ("border", if is_on { point } else { near(point, -12.0, 0.0, r) }, vec![place])
            }
            8 | 9 => self.medial(place, r, scratch).unwrap_or(("on", point, vec![place])),
            10 => self.focal(place, r).unwrap_or(("on", point, vec![place])),
            11 => ("far", near(point, 0.5, 4.0, r), vec![]),
            12 => {
                let place = self.search.sample_place(r.whole(0, self.search.count() - 1));
                let point = self.point(&place);
                (
                    "knot",
                    if r.unit() < 0.5 { point } else { near(point, -13.0, -1.0, r) },
                    vec![place],
                )
            }
            13 => {
                let other = self.place(r);
                ("between", middle(point, self.point(&other)), vec![place, other])
            }
            14 => self.special(r),
            _ => ("around", near(point, -3.0, 0.3, r), vec![place]),
        }
    }

    fn point(&self, place: &Place) -> Vector {
        self.pieces.point(place, [0.0; 3])
    }

    /// Anywhere: evenly in the parameters, or among the samples, which are even in space.
    fn place(&self, r: &mut Random) -> Place {
        if r.unit() < 0.3 {
            return self.search.sample_place(r.whole(0, self.search.count() - 1));
        }
        let [u0, u1, v0, v1] = self.area;
        self.pieces.place([r.between(u0, u1).min(u1), r.between(v0, v1).min(v1)])
    }

    fn on_a_border(&self, r: &mut Random) -> Place {
        let mut at = [r.between(self.area[0], self.area[1]), r.between(self.area[2], self.area[3])];
        let corner = r.unit() < 0.4;
        let first = if self.design.is_curve() { 0 } else { r.whole(0, 1) };
        for k in 0..2 {
            if k == first || corner {
                at[k] = self.area[2 * k + r.whole(0, 1)];
            }
        }
        self.pieces.place(at)
    }

    fn jet(&self, place: &Place) -> Jet {
        self.pieces.jet(place, [0.0; 3])
    }

    /// A unit normal; of a curve one of the many.
    fn normal(&self, place: &Place, r: &mut Random) -> Vector {
        let jet = self.jet(place);
        let other = if self.design.is_curve() { r.direction() } else { jet.t };
        unit(cross(jet.s, other)).unwrap_or_else(|| r.direction())
    }

    fn beside_a_pole(&self, r: &mut Random) -> (&'static str, Vector, Vec<Place>) {
        let pole = self.design.poles[r.whole(0, self.design.poles.len() - 1)];
        let away = if r.unit() < 0.3 { 0.0 } else { self.diagonal * r.scale(-3.0, 0.3) };
        ("pole", along(pole, r.direction(), away), vec![])
    }

    fn in_the_box(&self, r: &mut Random) -> Vector {
        let (low, high) = self.design.bounding_box();
        [0, 1, 2].map(|k| {
            let margin = 0.3 * (high[k] - low[k]) + 0.05 * self.diagonal;
            r.between(low[k] - margin, high[k] + margin)
        })
    }

    /// Centres, axes, the middle of the box; exactly or almost.
    fn special(&self, r: &mut Random) -> (&'static str, Vector, Vec<Place>) {
        let special = &self.design.special;
        let (low, high) = self.design.bounding_box();
        let point = match special.len() {
            0 => middle(low, high),
            n => special[r.whole(0, n - 1)],
        };
        let away = if r.unit() < 0.5 { 0.0 } else { self.diagonal * r.scale(-15.0, -1.0) };
        ("centre", along(point, r.direction(), away), vec![])
    }

    /// The centre of a ball that touches the shape in two places: one chosen, the other found by shrinking the ball.
    fn medial(
        &self,
        place: Place,
        r: &mut Random,
        scratch: &mut Scratch,
    ) -> Option<(&'static str, Vector, Vec<Place>)> {
        let (point, n) = (self.point(&place), self.normal(&place, r));
        let (mut radius, mut other) = (2.0 * self.diagonal, place);
        for _ in 0..8 {
            let found = self.search.nearest(along(point, n, radius), &[place], scratch);
            let chord = sub(self.point(&found.place), point);
            let (length, height) = (square(chord), dot(chord, n));
            if height <= 0.0 || length <= 1e-24 * self.diagonal * self.diagonal {
                break;
            }
            let smaller = length / (2.0 * height);
            if smaller > radius * (1.0 - 1e-14) {
                break;
            }
            (radius, other) = (smaller, found.place);
        }
        let away = if r.unit() < 0.6 { 0.0 } else { self.diagonal * r.scale(-14.0, -3.0) };
        let query = along(along(point, n, radius), r.direction(), away);
        (other != place).then_some(("medial", query, vec![place, other]))
    }

    /// A centre of curvature.
    fn focal(&self, place: Place, r: &mut Random) -> Option<(&'static str, Vector, Vec<Place>)> {
        let (jet, point) = (self.jet(&place), self.point(&place));
        let (e, f, g) = (dot(jet.s, jet.s), dot(jet.s, jet.t), dot(jet.t, jet.t));
        let (n, curvature) = if self.design.is_curve() {
            let bend = along(jet.ss, jet.s, -dot(jet.ss, jet.s) / e);
            (unit(bend)?, square(bend).sqrt() / e)
        } else {
            let n = unit(cross(jet.s, jet.t))?;
            let [l, m, k] = [dot(jet.ss, n), dot(jet.st, n), dot(jet.tt, n)];
            let det = e * g - f * f;
            let (mean, gauss) = (0.5 * (e * k - 2.0 * f * m + g * l) / det, (l * k - m * m) / det);
            let root = (mean * mean - gauss).max(0.0).sqrt();
            (n, if r.unit() < 0.5 { mean + root } else { mean - root })
        };
        let radius = 1.0 / curvature;
        let away = if r.unit() < 0.5 { 0.0 } else { self.diagonal * r.scale(-14.0, -3.0) };
        let query = along(along(point, n, radius), r.direction(), away);
        (radius.abs() < 1e4 * self.diagonal).then_some(("focal", query, vec![place]))
    }
}
