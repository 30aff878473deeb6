//! Reads the case folders (format: ../shared/cases/README.md) and makes shapes of them.

use std::path::{Path, PathBuf};

use footpoint::curve::Curve;
use footpoint::index::{IndexedCurve, IndexedSurface};
use footpoint::surface::Surface;

/// A query with its proven distance.
#[derive(Debug)]
pub struct Row {
    pub query: [f64; 3],
    pub class: String,
    /// One place that has the distance; curves have no second parameter.
    #[allow(dead_code, reason = "the bench looks at distances only")]
    pub place: [Option<f64>; 2],
    pub distance: f64,
}

pub enum Shape {
    Curve(IndexedCurve),
    Surface(IndexedSurface),
}

pub struct Case {
    pub name: String,
    pub shape: Shape,
    pub rows: Vec<Row>,
    /// Diagonal of the pole box.
    pub diagonal: f64,
    /// Greatest absolute pole coordinate.
    pub magnitude: f64,
}

/// Case folders: the shared ones when they are there, the committed ones otherwise.
pub fn folders() -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let shared = root.join("../shared/cases");
    let place = if shared.is_dir() { shared } else { root.join("tests/data") };
    let mut found: Vec<PathBuf> = std::fs::read_dir(&place)
        .expect("a folder of cases")
        .map(|entry| entry.expect("a readable entry").path())
        .filter(|path| path.join("geometry.txt").is_file())
        .collect();
    found.sort();
    found
}

pub fn read(folder: &Path) -> Case {
    let text = std::fs::read_to_string(folder.join("geometry.txt")).expect("geometry.txt");
    let mut words = text.split_whitespace();
    let is_surface = words.next() == Some("surface");
    let mut numbers = words.map(|w| w.parse::<f64>().expect("a number"));
    let mut next = || numbers.next().expect("enough numbers");
    let mut poles = Vec::new();
    let mut weights = Vec::new();
    let mut read_poles = |count: usize, next: &mut dyn FnMut() -> f64| {
        for _ in 0..count {
            poles.push([next(), next(), next()]);
            weights.push(next());
        }
    };
    let shape = if is_surface {
        let [pu, pv, nu, nv, rational] = [(); 5].map(|()| next() as usize);
        let knots_u: Vec<f64> = (0..=nu + pu).map(|_| next()).collect();
        let knots_v: Vec<f64> = (0..=nv + pv).map(|_| next()).collect();
        read_poles(nu * nv, &mut next);
        let weights = (rational == 1).then_some(&weights[..]);
        let surface = Surface::new(&knots_u, &knots_v, pu, pv, &poles, nu, nv, weights);
        Shape::Surface(IndexedSurface::new(surface.expect("a surface")))
    } else {
        let [p, n, rational, _dimension] = [(); 4].map(|()| next() as usize);
        let knots: Vec<f64> = (0..=n + p).map(|_| next()).collect();
        read_poles(n, &mut next);
        let weights = (rational == 1).then_some(&weights[..]);
        Shape::Curve(IndexedCurve::new(Curve::new(&knots, p, &poles, weights).expect("a curve")))
    };
    let extreme = |pick: fn(f64, f64) -> f64, start: f64| {
        [0, 1, 2].map(|k| poles.iter().fold(start, |m, p| pick(m, p[k])))
    };
    let (low, high) = (extreme(f64::min, f64::INFINITY), extreme(f64::max, f64::NEG_INFINITY));
    let diagonal = (0..3).map(|k| (high[k] - low[k]).powi(2)).sum::<f64>().sqrt();
    let magnitude = low.iter().chain(&high).fold(0.0, |m: f64, x| m.max(x.abs()));
    let name = folder.file_name().expect("a name").to_string_lossy().into_owned();
    Case { name, shape, rows: read_rows(folder), diagonal, magnitude }
}

fn read_rows(folder: &Path) -> Vec<Row> {
    let text = std::fs::read_to_string(folder.join("queries.csv")).expect("queries.csv");
    text.lines()
        .skip(1)
        .map(|line| {
            let f: Vec<&str> = line.split(',').collect();
            let number = |k: usize| f[k].parse().expect("a number");
            Row {
                query: [number(0), number(1), number(2)],
                class: f[3].into(),
                place: [4, 5].map(|k: usize| f[k].parse().ok()),
                distance: number(6),
            }
        })
        .collect()
}
