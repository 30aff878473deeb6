//! How a sample of a picture gets its colour: stripes, lamps, colours of curvature.
//!
//! A striped pattern is a number that grows by one from stripe to stripe. A sample shows the mean of the stripes over its
//! own width, so that stripes finer than pixels become grey and not a pattern of their own.

use crate::bounds::{Vector, add, cross, dot, norm, scaled, sub};
use crate::portable::SameDigits;

/// What is drawn on the surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Pattern {
    /// Plain shading.
    Shaded,
    /// Stripes of a surrounding striped room, seen in the surface.
    Zebra,
    /// Bands of equal angle between normal and light.
    Isophotes,
    /// Bands where the reflection of the view meets parallel lamps overhead.
    ReflectionLines,
    /// Bands where the normal line passes parallel lamps overhead.
    HighlightLines,
    /// Greater principal curvature.
    Greater,
    /// Less principal curvature.
    Less,
    /// Mean curvature.
    Mean,
    /// Gaussian curvature.
    Gaussian,
}

/// Brightness of a dark stripe beside a light one.
const DARK: f64 = 0.12;

/// A range of curvatures narrower than this share of them, or of the curvature of a ball as wide as the picture, is rounding:
/// one colour.
const ONE_COLOUR: f64 = 1e-9;

impl Pattern {
    /// Whether it shows a curvature.
    pub(crate) fn is_coloured(self) -> bool {
        matches!(self, Self::Greater | Self::Less | Self::Mean | Self::Gaussian)
    }
}

/// What is seen in a sample, in the axes of the picture (right, up, towards the eye), lengths from the middle of the surface.
#[derive(Clone, Copy)]
pub(crate) struct Sample {
    pub(crate) place: Vector,
    pub(crate) normal: Vector,
    pub(crate) value: f64,
}

/// How a sample gets its colour; everything in the axes of the picture.
pub(crate) struct Paint {
    pub(crate) pattern: Pattern,
    pub(crate) light: Vector,
    pub(crate) bands: f64,
    pub(crate) range: [f64; 2],
    pub(crate) reach: f64,
}

/// The part of `[a, b]` that lies in light stripes; dark ones reach a quarter to either side of a whole number, so that what
/// is even in the picture, and often has a whole number, is not cut by an edge.
fn light_part(a: f64, b: f64) -> f64 {
    let up_to = |x: f64| {
        let x = x + 0.25;
        0.5 * x.floor() + (x - x.floor() - 0.5).max(0.0)
    };
    if b - a < 1e-6 {
        let x = 0.5 * (a + b) + 0.25;
        return f64::from(u8::from(x - x.floor() >= 0.5));
    }
    ((up_to(b) - up_to(a)) / (b - a)).clamp(0.0, 1.0)
}

impl Paint {
    /// The mean colour of the samples of a pixel; none: the background is seen.
    pub(crate) fn pixel(&self, samples: [Option<Sample>; 4], background: Vector) -> Vector {
        let numbers = samples.map(|sample| sample.and_then(|sample| self.number(&sample)));
        let known = || numbers.iter().flatten();
        let (low, high) =
            known().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(*x), b.max(*x)));
        let width = if known().count() == 4 { high - low } else { 0.0 };
        let mut sum = [0.0; 3];
        for (sample, number) in samples.iter().zip(numbers) {
            let colour = match sample {
                Some(sample) => self.colour(sample, number, width),
                None => background,
            };
            sum = add(sum, scaled(colour, 0.25));
        }
        sum
    }

    /// The normal on the side of the eye.
    fn facing(normal: Vector) -> Vector {
        let size = norm(normal);
        let n = if size > 0.0 { scaled(normal, 1.0 / size) } else { [0.0, 0.0, 1.0] };
        if n[2] < 0.0 { scaled(n, -1.0) } else { n }
    }

    /// The number of the stripe, whole in the middle of a dark one; none beside the lamps.
    fn number(&self, sample: &Sample) -> Option<f64> {
        let n = Self::facing(sample.normal);
        // The eye looks along (0, 0, -1): its reflection is 2 n_z n - eye.
        let seen = sub(scaled(n, 2.0 * n[2]), [0.0, 0.0, 1.0]);
        let half_turns = |angle: f64| angle / std::f64::consts::PI;
        match self.pattern {
            Pattern::Zebra => {
                Some((half_turns(seen[1].clamp(-1.0, 1.0).arcsine()) + 0.5) * self.bands)
            }
            Pattern::Isophotes => {
                let angle = dot(n, self.light).clamp(-1.0, 1.0).arccosine();
                Some(2.0 * half_turns(angle) * self.bands)
            }
            Pattern::ReflectionLines => self.lamp(sample.place, seen),
            Pattern::HighlightLines => self.lamp(sample.place, n),
            _ => None,
        }
    }

    fn colour(&self, sample: &Sample, number: Option<f64>, width: f64) -> Vector {
        let lit = 0.35 + 0.65 * dot(Self::facing(sample.normal), self.light).max(0.0);
        if self.pattern == Pattern::Shaded {
            return scaled([0.62, 0.72, 0.86], lit);
        }
        if self.pattern.is_coloured() {
            return scaled(self.scale_colour(sample.value), 0.45 + 0.55 * lit);
        }
        let light = number.map_or(1.0, |x| light_part(x - 0.5 * width, x + 0.5 * width));
        let brightness = DARK + (1.0 - DARK) * light;
        scaled([0.96, 0.97, 1.0], brightness * (0.55 + 0.45 * lit))
    }

    /// Direction across the lamps, in their plane.
    fn lamp_direction(&self) -> Vector {
        let across = cross(self.light, [0.0, 1.0, 0.0]);
        let size = norm(across);
        if size > 1e-6 { scaled(across, 1.0 / size) } else { [1.0, 0.0, 0.0] }
    }

    /// Number of the lamp that the line from `place` along `direction` meets in the plane of the lamps; there are no lamps
    /// beyond the width of the picture and below.
    fn lamp(&self, place: Vector, direction: Vector) -> Option<f64> {
        let height = 2.0 * self.reach - dot(place, self.light);
        let rise = dot(direction, self.light);
        if rise < 1e-3 {
            return None;
        }
        let hit = add(place, scaled(direction, height / rise));
        let lamp = dot(hit, self.lamp_direction()) / (2.0 * self.reach) * self.bands;
        (lamp.abs() <= self.bands).then_some(lamp)
    }

    /// Blue, white, red; white is zero when the range holds it, and a surface whose curvature is one number.
    fn scale_colour(&self, value: f64) -> Vector {
        let [low, high] = self.range;
        let middle = if low < 0.0 && high > 0.0 { 0.0 } else { 0.5 * (low + high) };
        let ball = if self.pattern == Pattern::Gaussian {
            1.0 / (self.reach * self.reach)
        } else {
            1.0 / self.reach
        };
        let noise = ONE_COLOUR * low.abs().max(high.abs()).max(ball);
        let half = (high - middle).max(middle - low).max(noise);
        let x = ((value - middle) / half).clamp(-1.0, 1.0);
        let x = if x.is_nan() { 0.0 } else { x };
        let end = if x < 0.0 { [0.13, 0.35, 0.72] } else { [0.78, 0.15, 0.14] };
        let white = [0.97, 0.97, 0.95];
        add(scaled(white, 1.0 - x.abs()), scaled(end, x.abs()))
    }
}
