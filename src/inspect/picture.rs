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

use super::paint::{Paint, Pattern, Sample};
use super::umbilic::curvatures;
use crate::bounds::{Vector, add, cross, dot, norm, scaled, sub};
use crate::error::Error;
use crate::knots::{Knots, Side};
use crate::surface::Surface;

const BACKGROUND: Vector = [1.0; 3];

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

struct Camera {
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

/// A line of the grid: its parameter, and the piece that it belongs to.
type Line = (f64, Side);

/// The lines of the grid: every span cut alike. Knots at which the tangent plane or the curvature may jump have two, one of
/// either piece.
fn lines(knots: &Knots) -> Vec<Line> {
    let spans: Vec<usize> = knots.spans().collect();
    let each = (LEAST_LINES.div_ceil(spans.len())).min((MOST_LINES / spans.len()).max(1));
    let t = knots.values();
    let mut all: Vec<Line> = Vec::new();
    for &i in &spans {
        let jumps = knots.multiplicity(t[i]) + 1 >= knots.degree();
        if jumps && !all.is_empty() {
            all.push((t[i], Side::Below));
        }
        let cut = |k: usize| t[i] + (t[i + 1] - t[i]) * k as f64 / each as f64;
        all.extend((0..each).map(|k| (cut(k), Side::Above)));
    }
    all.push((knots.domain().1, Side::Below));
    all
}

fn sample(pattern: Pattern, surface: &Surface, u: Line, v: Line) -> Sample {
    match curvatures(surface, [u.0, v.0], [u.1, v.1]) {
        Some(c) => {
            let value = match pattern {
                Pattern::Greater => c.principal[0],
                Pattern::Less => c.principal[1],
                Pattern::Mean => c.mean,
                Pattern::Gaussian => c.gaussian,
                _ => 0.0,
            };
            Sample { place: c.point, normal: c.normal, value }
        }
        None => {
            let place = surface.evaluate(u.0, v.0);
            Sample { place, normal: [0.0; 3], value: f64::NAN }
        }
    }
}

/// The surface as it looks.
///
/// Cost: an evaluation for each of up to a million grid points, then a few nanoseconds a sample.
///
/// # Errors
/// A size, a direction or a range that is none, by name; memory that could not be had.
pub fn picture(surface: &Surface, options: &PictureOptions) -> Result<Picture, Error> {
    let axes = checked(options)?;
    let mut grid = Grid::new(surface, options.pattern, axes)?;
    grid.mend();
    let [width, height] = options.size;
    let camera = Camera::around(&mut grid.samples, [2 * width, 2 * height]);
    let mut buffer = Buffer::new(camera.size)?;
    grid.draw(&camera, &mut buffer);
    let coloured = options.pattern.is_coloured();
    let range = match options.range {
        [0.0, 0.0] if coloured => seen_range(&buffer.samples),
        range if coloured => range,
        _ => [0.0; 2],
    };
    let light = unit("light", options.light)?;
    let paint = Paint {
        pattern: options.pattern,
        light: axes.map(|axis| dot(axis, light)),
        bands: options.bands as f64,
        range,
        reach: camera.reach(),
    };
    let pixels = buffer.pixels(options.size, &paint)?;
    Ok(Picture { size: options.size, pixels, range })
}

/// The axes of the picture: right, up, towards the eye.
fn checked(options: &PictureOptions) -> Result<[Vector; 3], Error> {
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
    unit("light", options.light)?;
    let eye = unit("eye", options.eye)?;
    let right = cross(unit("up", options.up)?, eye);
    if norm(right) < 1e-6 {
        return Err(Error::InvalidArgument("up: is the direction of the eye".into()));
    }
    let right = unit("up", right)?;
    Ok([right, cross(eye, right), eye])
}

/// Samples of the surface, row by row of equal u.
struct Grid {
    lines: [Vec<Line>; 2],
    samples: Vec<Sample>,
}

impl Grid {
    fn new(surface: &Surface, pattern: Pattern, axes: [Vector; 3]) -> Result<Self, Error> {
        let [us, vs] = [lines(surface.knots_u()), lines(surface.knots_v())];
        let count = us.len().saturating_mul(vs.len());
        let mut samples = Vec::new();
        samples.try_reserve_exact(count).map_err(|_| Error::OutOfMemory)?;
        let turned = |x: Vector| axes.map(|axis| dot(axis, x));
        for u in &us {
            samples.extend(vs.iter().map(|v| {
                let found = sample(pattern, surface, *u, *v);
                Sample { place: turned(found.place), normal: turned(found.normal), ..found }
            }));
        }
        Ok(Self { lines: [us, vs], samples })
    }

    /// Samples without a normal (collapsed edges) take those of their neighbours.
    fn mend(&mut self) {
        let (rows, width) = (self.lines[0].len(), self.lines[1].len());
        let known = |v: &Sample| v.value.is_finite() && v.normal != [0.0; 3];
        for n in 0..self.samples.len() {
            if known(&self.samples[n]) {
                continue;
            }
            let (i, j) = (n / width, n % width);
            let near = [
                (i + 1 < rows).then(|| n + width),
                (i > 0).then(|| n - width),
                (j + 1 < width).then(|| n + 1),
                (j > 0).then(|| n - 1),
            ];
            let other = near.into_iter().flatten().map(|m| self.samples[m]).find(known);
            let (normal, value) = other.map_or(([0.0, 0.0, 1.0], 0.0), |o| (o.normal, o.value));
            self.samples[n] = Sample { normal, value, ..self.samples[n] };
        }
    }

    /// Two triangles for each cell; between the two lines of a knot there is none.
    fn draw(&self, camera: &Camera, buffer: &mut Buffer) {
        let [us, vs] = &self.lines;
        let is_cell = |lines: &[Line], i: usize| lines[i].0 < lines[i + 1].0;
        for i in (0..us.len() - 1).filter(|&i| is_cell(us, i)) {
            for j in (0..vs.len() - 1).filter(|&j| is_cell(vs, j)) {
                let at = |a: usize, b: usize| self.samples[(i + a) * vs.len() + j + b];
                buffer.triangle(camera, [at(0, 0), at(1, 0), at(1, 1)]);
                buffer.triangle(camera, [at(0, 0), at(1, 1), at(0, 1)]);
            }
        }
    }
}

/// The values that are seen, but for a hundredth at either end.
fn seen_range(samples: &[Sample]) -> [f64; 2] {
    let mut seen: Vec<f64> =
        samples.iter().map(|sample| sample.value).filter(|x| x.is_finite()).collect();
    if seen.is_empty() {
        return [0.0; 2];
    }
    seen.sort_by(f64::total_cmp);
    let last = seen.len() - 1;
    [seen[last / 100], seen[last - last / 100]]
}

impl Camera {
    /// Sees all of the grid, whose places become lengths from its middle.
    fn around(grid: &mut [Sample], size: [usize; 2]) -> Self {
        let mut low = [f64::INFINITY; 3];
        let mut high = [f64::NEG_INFINITY; 3];
        for Sample { place, .. } in grid.iter() {
            low = [0, 1, 2].map(|k| low[k].min(place[k]));
            high = [0, 1, 2].map(|k| high[k].max(place[k]));
        }
        let middle = [0, 1, 2].map(|k| 0.5 * (low[k] + high[k]));
        for sample in grid.iter_mut() {
            sample.place = sub(sample.place, middle);
        }
        let fit = |k: usize| 0.94 * size[k] as f64 / (high[k] - low[k]).max(f64::MIN_POSITIVE);
        let scale = fit(0).min(fit(1)).min(1e300);
        Self { scale, size }
    }

    /// Where a sample is, in samples from the upper left corner.
    fn sample(&self, sample: &Sample) -> [f64; 2] {
        let x = 0.5 * self.size[0] as f64 + sample.place[0] * self.scale;
        let y = 0.5 * self.size[1] as f64 - sample.place[1] * self.scale;
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
    samples: Vec<Sample>,
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
        let nothing = [0.0, 0.0, f64::NEG_INFINITY];
        let empty = Sample { place: nothing, normal: [0.0; 3], value: f64::NAN };
        Ok(Self { size, samples: filled(count, empty)? })
    }

    fn triangle(&mut self, camera: &Camera, corners: [Sample; 3]) {
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
                let mix = |f: fn(&Sample) -> Vector| {
                    let sum =
                        add(scaled(f(&corners[0]), shares[0]), scaled(f(&corners[1]), shares[1]));
                    add(sum, scaled(f(&corners[2]), shares[2]))
                };
                let place = mix(|v| v.place);
                let at = y * self.size[0] + x;
                if place[2] > self.samples[at].place[2] {
                    let value = (0..3).map(|k| shares[k] * corners[k].value).sum();
                    self.samples[at] = Sample { place, normal: mix(|v| v.normal), value };
                }
            }
        }
    }

    fn pixels(&self, [width, height]: [usize; 2], paint: &Paint) -> Result<Vec<u8>, Error> {
        let mut pixels = filled(3 * width * height, 0u8)?;
        for (n, pixel) in pixels.chunks_exact_mut(3).enumerate() {
            let (x, y) = (2 * (n % width), 2 * (n / width));
            let samples = [0, 1, self.size[0], self.size[0] + 1].map(|d| {
                let sample = self.samples[y * self.size[0] + x + d];
                (sample.place[2] > f64::NEG_INFINITY).then_some(sample)
            });
            let colour = paint.pixel(samples, BACKGROUND);
            for (out, c) in pixel.iter_mut().zip(colour) {
                *out = (255.0 * c.clamp(0.0, 1.0)).round() as u8;
            }
        }
        Ok(pixels)
    }
}
