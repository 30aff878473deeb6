//! Random faces on spheres: loops through the seam, around a pole, inner holes, full belts.
#![allow(dead_code, reason = "each test takes what it needs")]

use std::f64::consts::{FRAC_PI_2, TAU};

use footpoint::curve::Curve;
use footpoint::elementary::{Axes, CircleForm, Elementary, ElementarySurface};
use footpoint::pcurve::{Direction, Pcurve};
use footpoint::trim::{Coedge, Edge, Loop, Support, TrimmedSurface, form_transform};

/// Random numbers that are the same everywhere.
pub struct Random(pub u64);

impl Random {
    pub fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    pub fn below(&mut self, count: usize) -> usize {
        ((self.unit() * count as f64) as usize).min(count - 1)
    }

    pub fn vector(&mut self) -> [f64; 3] {
        [0; 3].map(|_| self.between(-1.0, 1.0))
    }
}

/// Names of the kinds of faces.
pub const KINDS: [&str; 5] = ["holes", "belt", "cap", "across the seam", "patch"];

pub fn sphere(random: &mut Random) -> ElementarySurface {
    let (origin, axis, towards) = (random.vector(), random.vector(), random.vector());
    let axes = Axes::around(origin, axis, towards).expect("random directions differ");
    let radius = 10f64.powf(random.between(-2.0, 2.0));
    let domain = [0.0, TAU, -FRAC_PI_2, FRAC_PI_2];
    ElementarySurface::new(Elementary::Sphere { axes, radius }, domain).expect("a sphere")
}

/// The seam from latitude `low` to `high`.
fn seam(surface: &ElementarySurface, [low, high]: [f64; 2]) -> Edge {
    let forms = surface.usual_forms();
    let (form, to_form) = (surface.nurbs(forms).unwrap(), form_transform(surface, forms).unwrap());
    let mut curve = form.isocurve_u(0.0);
    let ends = [low, high].map(|v| to_form.apply([0.0, v])[1]);
    if ends[1] < 1.0 {
        curve = curve.split(ends[1]).unwrap().0;
    }
    if ends[0] > 0.0 {
        curve = curve.split(ends[0]).unwrap().1;
    }
    Edge::along(curve)
}

fn iso_v(at: f64, from: f64, to: f64) -> Pcurve {
    Pcurve::isoline(Direction::V, at, from, to).unwrap()
}

fn iso_u(at: f64, from: f64, to: f64) -> Pcurve {
    Pcurve::isoline(Direction::U, at, from, to).unwrap()
}

/// A wave from (u0, v) to (u1, v) that stays within `height` of v: a polyline or a spline.
fn wave(random: &mut Random, [u0, u1]: [f64; 2], v: f64, height: f64) -> Pcurve {
    let count = 5 + random.below(4);
    let mut points = Vec::new();
    for k in 0..count {
        let inside = k > 0 && k + 1 < count;
        let swing = if inside { random.between(-height, height) } else { 0.0 };
        let share = k as f64 / (count - 1) as f64;
        let u = if k + 1 == count { u1 } else { u0 + share * (u1 - u0) };
        points.push([u, v + swing]);
    }
    if random.unit() < 0.5 {
        return Pcurve::polyline(&points).unwrap();
    }
    let poles: Vec<[f64; 3]> = points.iter().map(|p| [p[0], p[1], 0.0]).collect();
    let mut knots = vec![0.0; 3];
    knots.extend((1..=count - 3).map(|k| k as f64));
    knots.extend([(count - 2) as f64; 3]);
    let weights: Vec<f64> = (0..count).map(|_| random.between(0.5, 2.0)).collect();
    let curve = Curve::new(&knots, 2, &poles, Some(&weights));
    Pcurve::spline(curve.expect("a clamped spline")).unwrap()
}

/// A clockwise hole around a centre: an arc of an ellipse or a polygon.
fn hole(random: &mut Random, [u, v]: [f64; 2], radius: f64) -> Loop {
    if random.unit() < 0.5 {
        let tilt = random.between(0.0, 1.0);
        let (a, b) = (radius, radius * random.between(0.4, 1.0));
        let first = [a * tilt.cos(), a * tilt.sin()];
        let second = [b * tilt.sin(), -b * tilt.cos()];
        let from = random.between(0.0, 6.0);
        let half =
            |start: f64| Pcurve::arc([u, v], first, second, [start, start + TAU / 2.0]).unwrap();
        // Two half turns, the second one with ends that round differently.
        return Loop::inner(vec![Coedge::alone(half(from)), Coedge::alone(half(from + TAU / 2.0))]);
    }
    let count = 3 + random.below(6);
    let corner = |k: usize| {
        let angle = -TAU * (k % count) as f64 / count as f64;
        [u + radius * angle.cos(), v + radius * angle.sin()]
    };
    let sides =
        (0..count).map(|k| Coedge::alone(Pcurve::polyline(&[corner(k), corner(k + 1)]).unwrap()));
    Loop::inner(sides.collect())
}

/// A random face of a kind, and its sphere.
pub fn face(kind: usize, random: &mut Random) -> (ElementarySurface, TrimmedSurface) {
    let surface = sphere(random);
    let support = || Support::from(surface.clone());
    let pole = |v: f64| Edge::collapsed(surface.evaluate(0.0, v));
    let holes = |random: &mut Random, [v0, v1]: [f64; 2]| -> Vec<Loop> {
        let count = random.below(4);
        (0..count)
            .map(|k| {
                let u = TAU * (k as f64 + 0.5) / count as f64;
                let radius = 0.3 * (v1 - v0).min(TAU / count as f64);
                hole(random, [u, 0.5 * (v0 + v1)], radius)
            })
            .collect()
    };
    let (edges, loops) = match KINDS[kind] {
        "holes" => {
            let whole = TrimmedSurface::whole(support()).unwrap();
            let mut loops = whole.loops().to_vec();
            loops.extend(holes(random, [-1.2, 1.2]));
            (whole.edges().to_vec(), loops)
        }
        "belt" => {
            let (low, high) = (random.between(-1.4, -0.2), random.between(0.2, 1.4));
            let outer = Loop::outer(vec![
                Coedge::alone(iso_v(low, 0.0, TAU)),
                Coedge { same_parameter: false, ..Coedge::along(iso_u(TAU, low, high), 0) },
                Coedge::alone(iso_v(high, TAU, 0.0)),
                Coedge { same_parameter: false, ..Coedge::against(iso_u(0.0, high, low), 0) },
            ]);
            let mut loops = vec![outer];
            loops.extend(holes(random, [low, high]));
            (vec![seam(&surface, [low, high])], loops)
        }
        "cap" => {
            let low = random.between(-1.0, 1.0);
            let outer = Loop::outer(vec![
                Coedge::alone(wave(random, [0.0, TAU], low, 0.2)),
                Coedge { same_parameter: false, ..Coedge::along(iso_u(TAU, low, FRAC_PI_2), 0) },
                Coedge::along(iso_v(FRAC_PI_2, TAU, 0.0), 1),
                Coedge { same_parameter: false, ..Coedge::against(iso_u(0.0, FRAC_PI_2, low), 0) },
            ]);
            (vec![seam(&surface, [low, FRAC_PI_2]), pole(FRAC_PI_2)], vec![outer])
        }
        "across the seam" => {
            let (low, high) = (random.between(-1.4, -0.4), random.between(0.4, 1.4));
            let (left, right) = (random.between(0.2, 2.0), random.between(3.0, 6.0));
            let first = Loop::outer(vec![
                Coedge::alone(wave(random, [0.0, left], low, 0.1)),
                Coedge::alone(iso_u(left, low, high)),
                Coedge::alone(wave(random, [left, 0.0], high, 0.1)),
                Coedge { same_parameter: false, ..Coedge::against(iso_u(0.0, high, low), 0) },
            ]);
            let second = Loop::outer(vec![
                Coedge::alone(wave(random, [right, TAU], low, 0.1)),
                Coedge { same_parameter: false, ..Coedge::along(iso_u(TAU, low, high), 0) },
                Coedge::alone(wave(random, [TAU, right], high, 0.1)),
                Coedge::alone(iso_u(right, high, low)),
            ]);
            (vec![seam(&surface, [low, high])], vec![first, second])
        }
        _ => {
            let (low, high) = (random.between(-1.4, -0.4), random.between(0.4, 1.4));
            let (left, right) = (random.between(0.1, 2.0), random.between(3.0, 6.0));
            let outer = Loop::outer(vec![
                Coedge::alone(wave(random, [left, right], low, 0.1)),
                Coedge::alone(iso_u(right, low, high)),
                Coedge::alone(wave(random, [right, left], high, 0.1)),
                Coedge::alone(iso_u(left, high, low)),
            ]);
            (Vec::new(), vec![outer])
        }
    };
    let face = TrimmedSurface::new(support(), edges, loops, random.unit() < 0.5);
    (surface, face.expect("references are right"))
}

/// Forms that a sphere may take: longitude, latitude.
pub const FORMS: [[CircleForm; 2]; 4] = [
    [CircleForm::Halves, CircleForm::Arcs(2)],
    [CircleForm::Halves, CircleForm::Halves],
    [CircleForm::Arcs(4), CircleForm::Arcs(2)],
    [CircleForm::Arcs(3), CircleForm::Arcs(5)],
];
