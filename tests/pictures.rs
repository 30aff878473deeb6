//! Pictures of surfaces: each pattern shows what its closed form says, pixel by pixel.

mod revolved;
mod shapes;

use footpoint::inspect::{Pattern, PictureOptions, picture};
use footpoint::surface::Surface;
use revolved::{circle, ellipsoid, revolved};
use shapes::{Vector, cross, dot, norm, sub};
use std::f64::consts::PI;

const LINE: [f64; 4] = [0., 0., 1., 1.];
const UP: Vector = [0.0, 1.0, 0.0];

#[test]
fn pictures_show_the_surface_and_refuse_nonsense() {
    let surface = ellipsoid([3.0, 2.0, 1.0]);
    let patterns = [
        Pattern::Shaded,
        Pattern::Zebra,
        Pattern::Isophotes,
        Pattern::ReflectionLines,
        Pattern::HighlightLines,
        Pattern::Greater,
        Pattern::Less,
        Pattern::Mean,
        Pattern::Gaussian,
    ];
    for pattern in patterns {
        let options = PictureOptions { pattern, size: [120, 90], ..PictureOptions::default() };
        let made = picture(&surface, &options).unwrap();
        assert_eq!(made.pixels.len(), 3 * 120 * 90);
        let at = |x: usize, y: usize| &made.pixels[3 * (y * 120 + x)..][..3];
        assert_eq!(at(0, 0), [255; 3], "{pattern:?}");
        let inside = made.pixels.chunks(3).filter(|p| p != &[255; 3]).count();
        assert!(inside > 120 * 90 / 4, "{pattern:?} {inside}");
        if let Some(folder) = std::env::var_os("FOOTPOINT_PICTURES") {
            let options = PictureOptions { pattern, ..PictureOptions::default() };
            let made = picture(&surface, &options).unwrap();
            let mut file = b"P6 640 480 255\n".to_vec();
            file.extend(&made.pixels);
            std::fs::write(std::path::Path::new(&folder).join(format!("{pattern:?}.ppm")), file)
                .unwrap();
        }
    }
    let refused = |change: &dyn Fn(&mut PictureOptions)| {
        let mut options = PictureOptions::default();
        change(&mut options);
        picture(&surface, &options).err().unwrap().to_string()
    };
    assert!(refused(&|o| o.size = [0, 10]).starts_with("size:"));
    assert!(refused(&|o| o.eye = [0.0; 3]).starts_with("eye:"));
    assert!(refused(&|o| o.up = o.eye).starts_with("up:"));
    assert!(refused(&|o| o.light[1] = f64::NAN).starts_with("light:"));
    assert!(refused(&|o| o.bands = 0).starts_with("bands:"));
    assert!(refused(&|o| o.range = [1.0, f64::INFINITY]).starts_with("range:"));
}

/// A picture seen along z with y up, and where its pixels are.
struct Seen {
    pixels: Vec<u8>,
    size: usize,
    /// Pixels a length.
    scale: f64,
    /// The middle of the surface.
    middle: Vector,
}

fn scaled(v: Vector, by: f64) -> Vector {
    v.map(|x| x * by)
}

fn unit(v: Vector) -> Vector {
    scaled(v, 1.0 / norm(v))
}

impl Seen {
    /// `low`, `high`: the box that the surface fills.
    fn new(surface: &Surface, options: &PictureOptions, [low, high]: [Vector; 2]) -> Self {
        let size = options.size[0];
        let options = PictureOptions { eye: [0.0, 0.0, 1.0], up: UP, size: [size; 2], ..*options };
        let extent = (high[0] - low[0]).max(high[1] - low[1]);
        let middle = [0, 1, 2].map(|k| 0.5 * (low[k] + high[k]));
        let pixels = picture(surface, &options).unwrap().pixels;
        Self { pixels, size, scale: 0.94 * size as f64 / extent, middle }
    }

    /// The point of the picture's plane at a place of it, in pixels from its upper left corner.
    fn point(&self, x: f64, y: f64) -> [f64; 2] {
        let half = 0.5 * self.size as f64;
        [self.middle[0] + (x - half) / self.scale, self.middle[1] - (y - half) / self.scale]
    }

    fn column(&self, x: f64) -> usize {
        (0.5 * self.size as f64 + (x - self.middle[0]) * self.scale) as usize
    }

    fn colour(&self, x: usize, y: usize) -> Vector {
        let at = 3 * (y * self.size + x);
        [0, 1, 2].map(|k| f64::from(self.pixels[at + k]) / 255.0)
    }

    fn brightness(&self, x: usize, y: usize) -> f64 {
        self.colour(x, y).iter().sum::<f64>() / 3.0
    }

    /// Every pixel whose neighbourhood lies in one stripe is of it: dark about whole numbers. `number` tells the stripe at a
    /// point: none where the surface is not, or has a silhouette; `Some(None)` where no lamp is seen. The share that is told.
    fn assert_stripes(&self, number: &dyn Fn(f64, f64) -> Option<Option<f64>>) -> f64 {
        let (mut told, mut on) = (0, 0);
        for y in 0..self.size {
            for x in 0..self.size {
                let near = [(0.5, 0.5), (-0.5, -0.5), (1.5, -0.5), (-0.5, 1.5), (1.5, 1.5)];
                let numbers: Option<Vec<Option<f64>>> = near
                    .iter()
                    .map(|(dx, dy)| self.point(x as f64 + dx, y as f64 + dy))
                    .map(|p| number(p[0], p[1]))
                    .collect();
                let Some(numbers) = numbers else { continue };
                on += 1;
                // Halves of stripes, dark ones even.
                let half = |n: Option<f64>| n.map(|n| (2.0 * n + 0.5).floor());
                if numbers.iter().any(|n| half(*n) != half(numbers[0])) {
                    continue;
                }
                told += 1;
                let dark = half(numbers[0]).is_some_and(|h| h.rem_euclid(2.0) == 0.0);
                let seen = self.brightness(x, y);
                assert!(if dark { seen < 0.15 } else { seen > 0.6 }, "{x} {y} {numbers:?} {seen}");
            }
        }
        f64::from(told) / f64::from(on)
    }

    /// Every pixel has the hue that `value` has between blue, white and red.
    fn assert_hues(&self, half: f64, value: &dyn Fn(f64, f64) -> Option<f64>) -> usize {
        let mut told = 0;
        for y in 0..self.size {
            for x in 0..self.size {
                let corners = [(0.5, 0.5), (-0.5, -0.5), (1.5, -0.5), (-0.5, 1.5), (1.5, 1.5)];
                let values: Option<Vec<f64>> = corners
                    .iter()
                    .map(|(dx, dy)| self.point(x as f64 + dx, y as f64 + dy))
                    .map(|p| value(p[0], p[1]))
                    .collect();
                let Some(values) = values else { continue };
                let spread = values.iter().fold(0.0f64, |a, v| a.max((v - values[0]).abs() / half));
                if spread > 0.05 {
                    continue;
                }
                told += 1;
                let wanted = unit(hue((values[0] / half).clamp(-1.0, 1.0)));
                let off = norm(sub(unit(self.colour(x, y)), wanted));
                assert!(off < 0.02 + spread, "{x} {y} {values:?} {:?}", self.colour(x, y));
            }
        }
        told
    }
}

/// Blue at -1, white, red at 1.
fn hue(x: f64) -> Vector {
    let end = if x < 0.0 { [0.13, 0.35, 0.72] } else { [0.78, 0.15, 0.14] };
    let white = [0.97, 0.97, 0.95];
    [0, 1, 2].map(|k| white[k] * (1.0 - x.abs()) + end[k] * x.abs())
}

/// The tube of radius 1 along y, 2 long, and its box.
fn tube() -> (Surface, [Vector; 2]) {
    let (knots, poles) = circle([0.0; 3], 1.0);
    let at = |(p, _): &(Vector, f64)| [[p[0], 0.0, p[2]], [p[0], 2.0, p[2]]];
    let tube: Vec<Vector> = poles.iter().flat_map(at).collect();
    let weights: Vec<f64> = poles.iter().flat_map(|(_, w)| [*w, *w]).collect();
    let surface = Surface::new(&knots, &LINE, 2, 1, &tube, 9, 2, Some(&weights)).unwrap();
    (surface, [[-1.0, 0.0, -1.0], [1.0, 2.0, 1.0]])
}

fn tube_normal(x: f64, y: f64) -> Option<Vector> {
    (x.abs() < 0.99 && (0.0..=2.0).contains(&y)).then(|| [x, 0.0, (1.0 - x * x).sqrt()])
}

fn ball_normal(x: f64, y: f64) -> Option<Vector> {
    let square = x * x + y * y;
    (square < 0.98).then(|| [x, y, (1.0 - square).sqrt()])
}

type Normal = fn(f64, f64) -> Option<Vector>;

/// The tube and the ball, with their boxes and normals.
fn round_ones() -> [(Surface, [Vector; 2], Normal); 2] {
    let (tube, space) = tube();
    let ball = ellipsoid([1.0; 3]);
    [(tube, space, tube_normal), (ball, [[-1.0; 3], [1.0; 3]], ball_normal)]
}

fn options(pattern: Pattern, bands: usize, light: Vector) -> PictureOptions {
    PictureOptions { pattern, bands, light, size: [400; 2], ..PictureOptions::default() }
}

#[test]
fn isophotes_of_a_tube_and_a_ball_lie_at_their_angles() {
    for (surface, space, normal) in &round_ones() {
        for light in [[0.0, 0.0, 1.0], [0.6, 0.0, 0.8], [0.3, 0.5, 0.7]] {
            let seen = Seen::new(surface, &options(Pattern::Isophotes, 9, light), *space);
            let angle = |n: Vector| dot(n, unit(light)).acos();
            let share = seen
                .assert_stripes(&|x, y| normal(x, y).map(|n| Some(angle(n) / (PI / 2.0) * 9.0)));
            assert!(share > 0.7, "{light:?} {share}");
        }
    }
}

#[test]
fn zebra_of_a_tube_and_a_ball_is_the_height_in_the_striped_room() {
    let number = |n: Vector| ((2.0 * n[2] * n[1]).asin() / PI + 0.5) * 10.0;
    for (surface, space, normal) in &round_ones() {
        let seen = Seen::new(surface, &options(Pattern::Zebra, 10, [0.0, 0.0, 1.0]), *space);
        let share = seen.assert_stripes(&|x, y| normal(x, y).map(|n| Some(number(n))));
        assert!(share > 0.6, "{share}");
    }
}

/// The number of the lamp seen from `place` (from the middle of the surface) along `direction`.
fn lamp(seen: &Seen, light: Vector, bands: f64, place: Vector, direction: Vector) -> Option<f64> {
    let width = seen.size as f64 / seen.scale;
    let (light, across) = (unit(light), unit(cross(light, UP)));
    // Lamps are in the plane one width of the picture above the middle.
    let along = (width - dot(place, light)) / dot(direction, light);
    let hit = [0, 1, 2].map(|k| place[k] + along * direction[k]);
    let number = dot(hit, across) / width * bands;
    (along > 0.0 && number.abs() <= bands).then_some(number)
}

#[test]
fn lamps_are_seen_where_the_reflection_and_the_normal_meet_them() {
    for (surface, space, normal) in &round_ones() {
        for light in [[0.0, 0.0, 1.0], [0.5, -0.2, 0.9]] {
            for pattern in [Pattern::ReflectionLines, Pattern::HighlightLines] {
                let seen = Seen::new(surface, &options(pattern, 6, light), *space);
                let number = |x: f64, y: f64| {
                    let n = normal(x, y)?;
                    let way = match pattern {
                        Pattern::ReflectionLines => sub(scaled(n, 2.0 * n[2]), [0.0, 0.0, 1.0]),
                        _ => n,
                    };
                    let place = [x, y - seen.middle[1], n[2]];
                    Some(lamp(&seen, light, 6.0, place, way))
                };
                let share = seen.assert_stripes(&number);
                assert!(share > 0.6, "{pattern:?} {light:?} {share}");
            }
        }
    }
}

#[test]
fn a_surface_that_is_moved_or_larger_looks_the_same() {
    let ball = ellipsoid([3.0, 2.0, 1.0]);
    let knots = [ball.knots_u().values(), ball.knots_v().values()];
    let moved = |scale: f64, by: Vector| {
        let pole = |p: &Vector| [0, 1, 2].map(|k| scale * p[k] + by[k]);
        let poles: Vec<Vector> = ball.poles().iter().map(pole).collect();
        Surface::new(knots[0], knots[1], 2, 2, &poles, 9, 5, ball.weights()).unwrap()
    };
    for pattern in [
        Pattern::Zebra,
        Pattern::Isophotes,
        Pattern::ReflectionLines,
        Pattern::HighlightLines,
        Pattern::Mean,
    ] {
        let options = PictureOptions { pattern, size: [200, 150], ..PictureOptions::default() };
        let here = picture(&ball, &options).unwrap().pixels;
        for (scale, by) in
            [(8.0, [0.0; 3]), (1.0, [1000.0, -300.0, 500.0]), (0.125, [-7.0, 3.0, -60.0])]
        {
            let there = picture(&moved(scale, by), &options).unwrap().pixels;
            let off = here.iter().zip(&there).filter(|(a, b)| a.abs_diff(**b) > 12).count();
            assert!(off < here.len() / 500, "{pattern:?} {scale} {by:?}: {off}");
        }
    }
}

/// The graph of f(x) + g(y) over [-1, 1]^2, f = 0 on the left and slope x + bend x^2 on the right, g = -y^2 / 2: quadratic, C0.
fn joint(slope: f64, bend: f64) -> Surface {
    let (x, f) = ([-1.0, -0.5, 0.0, 0.5, 1.0], [0.0, 0.0, 0.0, 0.5 * slope, slope + bend]);
    let (y, g) = ([-1.0, 0.0, 1.0], [-0.5, 0.5, -0.5]);
    let poles: Vec<Vector> =
        (0..5).flat_map(|i| (0..3).map(move |j| [x[i], y[j], f[i] + g[j]])).collect();
    let knots = [0., 0., 0., 1., 1., 2., 2., 2.];
    Surface::new(&knots, &[0., 0., 0., 1., 1., 1.], 2, 2, &poles, 5, 3, None).unwrap()
}

/// Where a column goes from dark to light or back, pixels.
fn edges(seen: &Seen, column: usize) -> Vec<f64> {
    let inside = (0.04 * seen.size as f64) as usize..(0.96 * seen.size as f64) as usize;
    let dark = |y: usize| seen.brightness(column, y) < 0.4;
    inside.filter(|&y| dark(y) != dark(y + 1)).map(|y| y as f64).collect()
}

#[test]
fn zebra_breaks_at_a_crease_kinks_at_a_jump_of_curvature_and_runs_on_where_it_is_smooth() {
    let bands = 12;
    // Slope and curvature to the right of the joint; how far stripes are apart at it.
    for (slope, bend) in [(0.5, 0.0), (0.0, 0.4)] {
        let (surface, high) = (joint(slope, bend), 0.0f64.max(slope + bend));
        let space = [[-1.0, -1.0, -0.5], [1.0, 1.0, high]];
        let options =
            PictureOptions { size: [1600; 2], ..options(Pattern::Zebra, bands, [0.0, 0.0, 1.0]) };
        let seen = Seen::new(&surface, &options, space);
        let number = |x: f64, y: f64| {
            let p = if x > 0.0 { slope + 2.0 * bend * x } else { 0.0 };
            let up = 2.0 * y / (1.0 + p * p + y * y);
            (x.abs().max(y.abs()) < 0.999).then(|| Some((up.asin() / PI + 0.5) * bands as f64))
        };
        let share = seen.assert_stripes(&number);
        assert!(share > 0.95, "{share}");
        let at = |pixels: f64| edges(&seen, seen.column(pixels / seen.scale));
        let pairs = |a: &[f64], b: &[f64]| {
            assert!(a.len() >= 8 && a.len() >= b.len(), "{a:?} {b:?}");
            let nearest = |e: f64| a.iter().map(|x| (x - e).abs()).fold(f64::INFINITY, f64::min);
            b.iter().map(|e| nearest(*e)).fold(0.0, f64::max)
        };
        let (broken, before, after) =
            (pairs(&at(-2.0), &at(2.0)), pairs(&at(-60.0), &at(-2.0)), pairs(&at(2.0), &at(122.0)));
        // Stripes are straight before the joint, and go on behind it.
        assert!(before <= 1.0, "{before}");
        if slope > 0.0 {
            assert!(broken > 15.0 && after <= 1.0, "{broken} {after}");
        } else {
            assert!(broken <= 1.0 && after > 4.0, "{broken} {after}");
        }
    }
}

#[test]
fn colours_of_a_torus_are_those_of_its_curvatures() {
    let (knots, profile) = circle([3.0, 0.0, 0.0], 1.0);
    let torus = revolved(&knots, 2, &profile);
    let space = [[-4.0, -4.0, -1.0], [4.0, 4.0, 1.0]];
    // S_u x S_v at the top: u turns about z, v goes from the outer equator up.
    let inward = -1.0;
    let around = |x: f64, y: f64| {
        let ring = x.hypot(y);
        // The foot of the ring is inside of the tube by less than its silhouettes.
        ((ring - 3.0).abs() < 0.97).then(|| (ring - 3.0) / ring)
    };
    type Of = fn([f64; 2]) -> f64;
    let tests: [(Pattern, f64, Of); 4] = [
        (Pattern::Greater, 1.0, |k| k[0].max(k[1])),
        (Pattern::Less, 1.0, |k| k[0].min(k[1])),
        (Pattern::Mean, 1.0, |k| 0.5 * (k[0] + k[1])),
        (Pattern::Gaussian, 0.4, |k| k[0] * k[1]),
    ];
    for (pattern, half, value) in tests {
        let options =
            PictureOptions { range: [-half, half], ..options(pattern, 16, [0.2, 0.1, 1.0]) };
        let seen = Seen::new(&torus, &options, space);
        let told =
            seen.assert_hues(half, &|x, y| around(x, y).map(|k| value([inward, inward * k])));
        assert!(told > 40_000, "{pattern:?} {told}");
        // The hole and the corners.
        assert!(seen.colour(200, 200) == [1.0; 3] && seen.colour(3, 3) == [1.0; 3]);
    }
}

#[test]
fn a_jump_of_curvature_is_an_edge_of_colours() {
    let surface = joint(0.0, 0.4);
    let options = PictureOptions {
        size: [1600; 2],
        range: [-1.0, 1.0],
        ..options(Pattern::Gaussian, 16, [0.0, 0.0, 1.0])
    };
    let seen = Seen::new(&surface, &options, [[-1.0, -1.0, -0.5], [1.0, 1.0, 0.4]]);
    let gaussian = |x: f64, y: f64| {
        let (p, bend) = if x > 0.0 { (0.8 * x, 0.8) } else { (0.0, 0.0) };
        let inside = x.abs().max(y.abs()) < 0.999;
        inside.then(|| -bend / (1.0 + p * p + y * y).powi(2))
    };
    let told = seen.assert_hues(1.0, &gaussian);
    assert!(told > 2_200_000, "{told}");
}

#[test]
fn what_has_one_curvature_has_one_colour_in_its_own_range() {
    let one = |surface: &Surface, pattern: Pattern, eye: Vector| {
        let options = PictureOptions { pattern, eye, size: [120, 90], ..PictureOptions::default() };
        let made = picture(surface, &options).unwrap();
        let seen: Vec<Vector> = made
            .pixels
            .chunks(3)
            .filter(|p| *p != [255; 3])
            .map(|p| unit([0, 1, 2].map(|k| f64::from(p[k]))))
            .collect();
        // A pixel of the rim is mixed with the background, which is as white as what has no sign.
        let white = unit([0.97, 0.97, 0.95]);
        assert!(seen.iter().all(|c| norm(sub(*c, white)) < 0.02), "{pattern:?} {:?}", made.range);
    };
    let flat = |by: f64| {
        let corner = |u: f64, v: f64| [u / 3.0 + by, v / 7.0, 0.1 - u / 9.0 - v / 13.0];
        let poles = [corner(0., 0.), corner(0., 1.), corner(1., 0.), corner(1., 1.)];
        Surface::new(&LINE, &LINE, 1, 1, &poles, 2, 2, None).unwrap()
    };
    for pattern in [Pattern::Greater, Pattern::Less, Pattern::Mean, Pattern::Gaussian] {
        one(&ellipsoid([0.7; 3]), pattern, [1.0, -1.5, 1.2]);
        one(&flat(0.0), pattern, [0.3, 0.1, 1.0]);
        one(&flat(5.0), pattern, [0.3, 0.1, 1.0]);
    }
}

#[test]
fn a_plane_is_one_stripe_and_fine_stripes_are_grey() {
    // Seen along its normal and lit along it: on the edge of no stripe.
    let (e, f) = ([2.0, -1.0, 0.0], [3.0, 6.0, -5.0]);
    let corner = |u: f64, v: f64| [0, 1, 2].map(|k| 0.1 + u * e[k] + v * f[k]);
    let poles = [corner(0., 0.), corner(0., 1.), corner(1., 0.), corner(1., 1.)];
    let flat = Surface::new(&LINE, &LINE, 1, 1, &poles, 2, 2, None).unwrap();
    let normal = cross(e, f);
    for bands in [7, 10, 16] {
        for (pattern, light) in
            [(Pattern::Zebra, normal), (Pattern::Isophotes, normal), (Pattern::Isophotes, f)]
        {
            let options =
                PictureOptions { eye: normal, size: [100; 2], ..options(pattern, bands, light) };
            let made = picture(&flat, &options).unwrap().pixels;
            let at = |x: usize, y: usize| made[3 * (y * 100 + x)];
            let middle = at(50, 50);
            for (x, y) in (40..60).flat_map(|x| (20..80).map(move |y| (x, y))) {
                assert!(at(x, y).abs_diff(middle) <= 1, "{pattern:?} {bands} {light:?}");
            }
        }
    }
    let ball = ellipsoid([1.0; 3]);
    let seen =
        Seen::new(&ball, &options(Pattern::Zebra, 1000, [0.0, 0.0, 1.0]), [[-1.0; 3], [1.0; 3]]);
    for (x, y) in (180..220).flat_map(|x| (180..220).map(move |y| (x, y))) {
        let grey = seen.brightness(x, y);
        assert!((0.4..0.7).contains(&grey), "{x} {y} {grey}");
    }
}

#[test]
fn lamps_over_a_plane_are_straight_lines_at_equal_distances() {
    let poles = [[0., 0., 0.], [0., 1., 0.], [1., 0., 0.], [1., 1., 0.]];
    let flat = Surface::new(&LINE, &LINE, 1, 1, &poles, 2, 2, None).unwrap();
    for pattern in [Pattern::ReflectionLines, Pattern::HighlightLines] {
        let seen =
            Seen::new(&flat, &options(pattern, 12, [0.0, 0.0, 1.0]), [[0.0; 3], [1.0, 1.0, 0.0]]);
        let inside = |t: f64| (0.003..0.997).contains(&t);
        let number = |x: f64, y: f64| {
            (inside(x) && inside(y)).then(|| Some((x - 0.5) * seen.scale / 400.0 * 12.0))
        };
        let share = seen.assert_stripes(&number);
        assert!(share > 0.8, "{share}");
    }
}
