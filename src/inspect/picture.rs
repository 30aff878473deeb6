//! Pictures of surfaces: zebra, isophotes, reflection and highlight lines, colours of curvature.
//!
//! ```text
//!   grid over the spans -> triangles -> depth buffer, each pixel with its own point, normal and value -> colour
//! ```
//!
//! The view is orthographic and holds the whole surface. Pixels are the means of 2 x 2 samples. The result is plain pixels
//! (red, green, blue); files are written by the caller's language.
//!
//! References: Beier, Chen, *Highlight-line algorithm for realtime surface-quality assessment*, 1994; Poeschl, *Detecting
//! surface irregularities using isophotes*, 1984; Klass, *Correction of local surface irregularities using reflection lines*,
//! 1980.

use super::umbilic::curvatures;
use crate::bounds::{Vector, add, cross, dot, norm, scaled, sub};
use crate::error::Error;
use crate::knots::{Knots, Side};
use crate::portable::SameDigits;
use crate::surface::Surface;

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

/// How a picture is made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PictureOptions {
    /// What is drawn.
    pub pattern: Pattern,
    /// Pixels, 1 to 8192 each.
    pub size: [usize; 2],
    /// Direction from the surface towards the eye.
    pub eye: Vector,
    /// What is up in the picture.
    pub up: Vector,
    /// Direction from the surface towards the light, and towards the plane of the lamps.
    pub light: Vector,
    /// Bands over the range of what they show.
    pub bands: usize,
    /// Values of the ends of the colours of curvature; both 0: the range of what is seen, but for a hundredth at either end.
    pub range: [f64; 2],
}

impl Default for PictureOptions {
    fn default() -> Self {
        Self {
            pattern: Pattern::Shaded,
            size: [640, 480],
            eye: [1.0, -1.5, 1.2],
            up: [0.0, 0.0, 1.0],
            light: [0.3, -0.5, 1.0],
            bands: 16,
            range: [0.0; 2],
        }
    }
}

/// Pixels, row by row from above, and the ends of the colours.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// Pixels in a row, rows.
    pub size: [usize; 2],
    /// Red, green, blue of each pixel.
    pub pixels: Vec<u8>,
    /// Values of the ends of the colours of curvature; 0 otherwise.
    pub range: [f64; 2],
}

/// Grid lines in either direction at most.
const MOST_LINES: usize = 1200;

/// Grid lines in either direction at least.
const LEAST_LINES: usize = 240;

/// Between two lamps.
const NO_LAMP: f64 = 0.75;

const BACKGROUND: [f64; 3] = [1.0; 3];

#[derive(Clone, Copy)]
struct Vertex {
    /// In the picture: right, up, towards the eye.
    place: Vector,
    normal: Vector,
    value: f64,
}

struct Camera {
    axes: [Vector; 3],
    middle: [f64; 2],
    scale: f64,
    size: [usize; 2],
}

fn unit(name: &str, v: Vector) -> Result<Vector, Error> {
    let length = norm(v);
    if length > 0.0 && length.is_finite() {
        return Ok(scaled(v, 1.0 / length));
    }
    Err(Error::InvalidArgument(format!("{name}: is zero or not finite")))
}

/// The parameters of the grid: every span cut alike.
fn lines(knots: &Knots) -> Vec<f64> {
    let spans: Vec<usize> = knots.spans().collect();
    let each = (LEAST_LINES.div_ceil(spans.len())).min((MOST_LINES / spans.len()).max(1));
    let t = knots.values();
    let cut = |i: usize| (0..each).map(move |k| t[i] + (t[i + 1] - t[i]) * k as f64 / each as f64);
    let mut all: Vec<f64> = spans.iter().flat_map(|&i| cut(i)).collect();
    all.push(knots.domain().1);
    all
}

fn value(pattern: Pattern, surface: &Surface, at: [f64; 2]) -> (Vector, Vector, f64) {
    match curvatures(surface, at, [Side::Above; 2]) {
        Some(c) => {
            let value = match pattern {
                Pattern::Greater => c.principal[0],
                Pattern::Less => c.principal[1],
                Pattern::Mean => c.mean,
                Pattern::Gaussian => c.gaussian,
                _ => 0.0,
            };
            (c.point, c.normal, value)
        }
        None => (surface.evaluate(at[0], at[1]), [0.0; 3], f64::NAN),
    }
}

fn is_coloured(pattern: Pattern) -> bool {
    matches!(pattern, Pattern::Greater | Pattern::Less | Pattern::Mean | Pattern::Gaussian)
}

/// The surface as it looks.
///
/// Cost: an evaluation for each of up to a million grid points, then a few nanoseconds a sample.
///
/// # Errors
/// A size, a direction or a range that is none, by name; memory that could not be had.
pub fn picture(surface: &Surface, options: &PictureOptions) -> Result<Picture, Error> {
    let [width, height] = options.size;
    if width == 0 || height == 0 || width > 8192 || height > 8192 {
        return Err(Error::InvalidArgument("size: 1 to 8192 pixels each accepted".into()));
    }
    if options.bands == 0 || options.bands > 1000 {
        return Err(Error::InvalidArgument(format!(
            "bands: {} given, 1 to 1000 accepted",
            options.bands
        )));
    }
    let [low, high] = options.range;
    if !(low.is_finite() && high.is_finite() && low <= high) {
        return Err(Error::InvalidArgument("range: is not increasing or not finite".into()));
    }
    let (eye, light) = (unit("eye", options.eye)?, unit("light", options.light)?);
    let right = cross(unit("up", options.up)?, eye);
    if norm(right) < 1e-6 {
        return Err(Error::InvalidArgument("up: is the direction of the eye".into()));
    }
    let right = unit("up", right)?;
    let axes = [right, cross(eye, right), eye];
    let (us, vs) = (lines(surface.knots_u()), lines(surface.knots_v()));
    let vertex = |u: f64, v: f64| {
        let (point, normal, value) = value(options.pattern, surface, [u, v]);
        let place = axes.map(|axis| dot(axis, point));
        Vertex { place, normal: axes.map(|axis| dot(axis, normal)), value }
    };
    let mut grid: Vec<Vertex> = us
        .iter()
        .flat_map(|&u| vs.iter().map(move |&v| (u, v)))
        .map(|(u, v)| vertex(u, v))
        .collect();
    mend(&mut grid, vs.len());
    let camera = Camera::new(axes, &grid, [2 * width, 2 * height]);
    let mut buffer = Buffer::new(camera.size)?;
    for i in 0..us.len() - 1 {
        for j in 0..vs.len() - 1 {
            let at = |a: usize, b: usize| grid[(i + a) * vs.len() + j + b];
            buffer.triangle(&camera, [at(0, 0), at(1, 0), at(1, 1)]);
            buffer.triangle(&camera, [at(0, 0), at(1, 1), at(0, 1)]);
        }
    }
    let coloured = is_coloured(options.pattern);
    let range = match options.range {
        [0.0, 0.0] if coloured => seen_range(&buffer.values),
        range if coloured => range,
        _ => [0.0; 2],
    };
    let light = camera.axes.map(|axis| dot(axis, light));
    let paint = Paint {
        pattern: options.pattern,
        light,
        bands: options.bands as f64,
        range,
        reach: camera.reach(),
    };
    let pixels = buffer.pixels([width, height], &paint)?;
    Ok(Picture { size: options.size, pixels, range })
}

/// Vertices without a normal (collapsed edges) take those of their neighbours.
fn mend(grid: &mut [Vertex], width: usize) {
    let known = |v: &Vertex| v.value.is_finite() && v.normal != [0.0; 3];
    for n in 0..grid.len() {
        if known(&grid[n]) {
            continue;
        }
        let (i, j) = (n / width, n % width);
        let rows = grid.len() / width;
        let near = [
            (i + 1 < rows).then(|| n + width),
            (i > 0).then(|| n - width),
            (j + 1 < width).then(|| n + 1),
            (j > 0).then(|| n - 1),
        ];
        if let Some(other) = near.into_iter().flatten().find(|&m| known(&grid[m])) {
            (grid[n].normal, grid[n].value) = (grid[other].normal, grid[other].value);
        } else {
            (grid[n].normal, grid[n].value) = ([0.0, 0.0, 1.0], 0.0);
        }
    }
}

/// The values that are seen, but for a hundredth at either end.
fn seen_range(values: &[f64]) -> [f64; 2] {
    let mut seen: Vec<f64> = values.iter().copied().filter(|x| x.is_finite()).collect();
    if seen.is_empty() {
        return [0.0; 2];
    }
    seen.sort_by(f64::total_cmp);
    let last = seen.len() - 1;
    [seen[last / 100], seen[last - last / 100]]
}

impl Camera {
    fn new(axes: [Vector; 3], grid: &[Vertex], size: [usize; 2]) -> Self {
        let mut low = [f64::INFINITY; 2];
        let mut high = [f64::NEG_INFINITY; 2];
        for vertex in grid {
            for k in 0..2 {
                low[k] = low[k].min(vertex.place[k]);
                high[k] = high[k].max(vertex.place[k]);
            }
        }
        let fit = |k: usize| 0.94 * size[k] as f64 / (high[k] - low[k]).max(f64::MIN_POSITIVE);
        let scale = fit(0).min(fit(1)).min(1e300);
        Self { axes, middle: [0, 1].map(|k| 0.5 * (low[k] + high[k])), scale, size }
    }

    /// Where a vertex is, in samples from the upper left corner.
    fn sample(&self, vertex: &Vertex) -> [f64; 2] {
        let x = (vertex.place[0] - self.middle[0]) * self.scale + 0.5 * self.size[0] as f64;
        let y = 0.5 * self.size[1] as f64 - (vertex.place[1] - self.middle[1]) * self.scale;
        [x, y]
    }

    /// Half the greater extent of the picture, in lengths.
    fn reach(&self) -> f64 {
        0.5 * self.size[0].max(self.size[1]) as f64 / self.scale
    }
}

/// What is nearest to the eye in each sample.
struct Buffer {
    size: [usize; 2],
    depth: Vec<f64>,
    places: Vec<Vector>,
    normals: Vec<Vector>,
    values: Vec<f64>,
}

fn filled<T: Copy>(count: usize, x: T) -> Result<Vec<T>, Error> {
    let mut list = Vec::new();
    list.try_reserve_exact(count).map_err(|_| Error::OutOfMemory)?;
    list.resize(count, x);
    Ok(list)
}

impl Buffer {
    fn new(size: [usize; 2]) -> Result<Self, Error> {
        let count = size[0] * size[1];
        Ok(Self {
            size,
            depth: filled(count, f64::NEG_INFINITY)?,
            places: filled(count, [0.0; 3])?,
            normals: filled(count, [0.0; 3])?,
            values: filled(count, f64::NAN)?,
        })
    }

    fn triangle(&mut self, camera: &Camera, corners: [Vertex; 3]) {
        let [a, b, c] = corners.map(|v| camera.sample(&v));
        let area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        if area == 0.0 || !area.is_finite() {
            return;
        }
        let bound = |k: usize| {
            let low = a[k].min(b[k]).min(c[k]).floor().max(0.0) as usize;
            let high = a[k].max(b[k]).max(c[k]).ceil().clamp(0.0, self.size[k] as f64) as usize;
            low..high
        };
        for y in bound(1) {
            for x in bound(0) {
                let p = [x as f64 + 0.5, y as f64 + 0.5];
                let part = |q: [f64; 2], r: [f64; 2]| {
                    ((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])) / area
                };
                let shares = [part(b, c), part(c, a), part(a, b)];
                if shares.iter().any(|share| *share < -1e-9) {
                    continue;
                }
                let mix = |f: fn(&Vertex) -> Vector| {
                    let sum =
                        add(scaled(f(&corners[0]), shares[0]), scaled(f(&corners[1]), shares[1]));
                    add(sum, scaled(f(&corners[2]), shares[2]))
                };
                let place = mix(|v| v.place);
                let at = y * self.size[0] + x;
                if place[2] > self.depth[at] {
                    self.depth[at] = place[2];
                    self.places[at] = place;
                    self.normals[at] = mix(|v| v.normal);
                    self.values[at] = (0..3).map(|k| shares[k] * corners[k].value).sum();
                }
            }
        }
    }

    fn pixels(&self, [width, height]: [usize; 2], paint: &Paint) -> Result<Vec<u8>, Error> {
        let mut pixels = filled(3 * width * height, 0u8)?;
        for (n, pixel) in pixels.chunks_exact_mut(3).enumerate() {
            let (x, y) = (2 * (n % width), 2 * (n / width));
            let mut sum = [0.0; 3];
            for at in [0, 1, self.size[0], self.size[0] + 1].map(|d| y * self.size[0] + x + d) {
                let seen = self.depth[at] > f64::NEG_INFINITY;
                let colour = if seen {
                    paint.colour(self.places[at], self.normals[at], self.values[at])
                } else {
                    BACKGROUND
                };
                sum = add(sum, colour);
            }
            for (out, c) in pixel.iter_mut().zip(sum) {
                *out = (255.0 * (0.25 * c).clamp(0.0, 1.0)).round() as u8;
            }
        }
        Ok(pixels)
    }
}

/// How a sample gets its colour; everything in the axes of the picture.
struct Paint {
    pattern: Pattern,
    light: Vector,
    bands: f64,
    range: [f64; 2],
    reach: f64,
}

impl Paint {
    fn colour(&self, place: Vector, normal: Vector, value: f64) -> Vector {
        let size = norm(normal);
        let mut n = if size > 0.0 { scaled(normal, 1.0 / size) } else { [0.0, 0.0, 1.0] };
        if n[2] < 0.0 {
            n = scaled(n, -1.0);
        }
        let lit = 0.35 + 0.65 * dot(n, self.light).max(0.0);
        let stripe = |x: f64| if x.rem_euclid(1.0) < 0.5 { 0.12 } else { 1.0 };
        let shaded = |x: f64| scaled([0.96, 0.97, 1.0], x * (0.55 + 0.45 * lit));
        // The eye looks along (0, 0, -1): its reflection is 2 n_z n - eye.
        let seen = sub(scaled(n, 2.0 * n[2]), [0.0, 0.0, 1.0]);
        let across = self.lamp_direction();
        match self.pattern {
            Pattern::Shaded => scaled([0.62, 0.72, 0.86], lit),
            Pattern::Zebra => {
                let angle = seen[1].clamp(-1.0, 1.0).arcsine() / std::f64::consts::PI + 0.5;
                shaded(stripe(angle * self.bands))
            }
            Pattern::Isophotes => {
                let angle = dot(n, self.light).clamp(-1.0, 1.0).arccosine() / std::f64::consts::PI;
                shaded(stripe(2.0 * angle * self.bands))
            }
            Pattern::ReflectionLines => shaded(stripe(self.passes(place, seen, across))),
            Pattern::HighlightLines => shaded(stripe(self.passes(place, n, across))),
            _ => scaled(self.scale_colour(value), 0.45 + 0.55 * lit),
        }
    }

    /// Direction across the lamps, in their plane.
    fn lamp_direction(&self) -> Vector {
        let across = cross(self.light, [0.0, 1.0, 0.0]);
        let size = norm(across);
        if size > 1e-6 { scaled(across, 1.0 / size) } else { [1.0, 0.0, 0.0] }
    }

    /// Number of the lamp that the line from `place` along `direction` meets in the plane of the lamps; there are no lamps
    /// beyond the width of the picture and below.
    fn passes(&self, place: Vector, direction: Vector, across: Vector) -> f64 {
        let height = 2.0 * self.reach - dot(place, self.light);
        let rise = dot(direction, self.light);
        if rise < 1e-3 {
            return NO_LAMP;
        }
        let hit = add(place, scaled(direction, height / rise));
        let lamp = dot(hit, across) / (2.0 * self.reach) * self.bands;
        if lamp.abs() > self.bands { NO_LAMP } else { lamp }
    }

    /// Blue, white, red; white is zero when the range holds it.
    fn scale_colour(&self, value: f64) -> Vector {
        let [low, high] = self.range;
        let middle = if low < 0.0 && high > 0.0 { 0.0 } else { 0.5 * (low + high) };
        let half = (high - middle).max(middle - low);
        let x = if half > 0.0 { ((value - middle) / half).clamp(-1.0, 1.0) } else { 0.0 };
        let x = if x.is_nan() { 0.0 } else { x };
        let end = if x < 0.0 { [0.13, 0.35, 0.72] } else { [0.78, 0.15, 0.14] };
        let white = [0.97, 0.97, 0.95];
        add(scaled(white, 1.0 - x.abs()), scaled(end, x.abs()))
    }
}
