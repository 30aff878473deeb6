//! Pictures of faces as SVG: the domain with its loops above, the face in space below, one column a face.
//!
//! ```text
//!   domain   grey: what is trimmed away; blue: outer loops, orange: inner ones, with the way they run; purple: closed sides
//!            (seams), red dots: collapsed ones
//!   space    isolines inside the face and the loops, seen along a direction without perspective; what looks away is pale
//! ```

use std::fmt::Write;

use super::flat::{Flat, Scale};
use super::{LoopKind, TrimmedSurface, invalid};
use crate::bounds::{Vector, cross, dot, norm, scaled};
use crate::error::Error;
use crate::pcurve::Parameters;
use crate::portable::SameDigits;
use crate::transform::between;

/// Side of a panel and the room around it.
const SIDE: f64 = 320.0;
const MARGIN: f64 = 30.0;

/// Isolines in each direction, and segments of each.
const ISOLINES: usize = 12;
const SEGMENTS: usize = 96;

/// Colours of outer and inner loops, seams and collapsed sides.
const OUTER: &str = "#1f5fbf";
const INNER: &str = "#d9700f";
const SEAM: &str = "#8a3fb0";
const COLLAPSED: &str = "#c62828";

/// Most columns of a picture.
pub const MOST_COLUMNS: usize = 16;

/// A picture of faces, each under its title. `view`: the direction in which one looks; (0, 0, 0) for the usual one.
///
/// # Errors
/// No faces or more than [`MOST_COLUMNS`]; a view that is not finite; memory that could not be had.
pub fn picture(faces: &[(&str, &TrimmedSurface)], view: Vector) -> Result<String, Error> {
    if faces.is_empty() || faces.len() > MOST_COLUMNS {
        return invalid(format!("faces: {} given, 1 to {MOST_COLUMNS} accepted", faces.len()));
    }
    if view.iter().any(|x| !x.is_finite() || x.abs() > 1e100) {
        return invalid("view: is not finite or beyond 1e100".into());
    }
    let view =
        if norm(view) > 0.0 { scaled(view, 1.0 / norm(view)) } else { unit([-0.8, 0.9, -0.6]) };
    let step = SIDE + 2.0 * MARGIN;
    let (width, height) = (step * faces.len() as f64, 2.0 * step);
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"{width}\" height=\"{height}\" \
         font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"{width}\" height=\"{height}\" fill=\"white\"/>\n"
    );
    for (k, (title, face)) in faces.iter().enumerate() {
        let left = step * k as f64 + MARGIN;
        let title = title.replace('&', "&amp;").replace('<', "&lt;");
        let _ = writeln!(out, "<text x=\"{left}\" y=\"18\" font-weight=\"bold\">{title}</text>");
        let scale = Scale::of(face.support())?;
        let drawing = Drawing::new(face, &scale);
        drawing.domain([left, MARGIN], &mut out);
        drawing.space([left, step + MARGIN], view, &mut out);
    }
    out.push_str("</svg>\n");
    Ok(out)
}

struct Drawing<'a> {
    face: &'a TrimmedSurface,
    /// The loops as places of the domain.
    loops: Vec<Vec<Parameters>>,
    /// Where each coedge begins in them.
    starts: Vec<Vec<usize>>,
}

impl<'a> Drawing<'a> {
    fn new(face: &'a TrimmedSurface, scale: &Scale) -> Self {
        let [u0, u1, v0, v1] = face.support().domain();
        let [width, height] = scale.point([u1 - u0, v1 - v0]);
        let error = 1e-4 * width.max(height);
        let (mut loops, mut starts) = (Vec::new(), Vec::new());
        for chain in face.loops() {
            let (mut places, mut begins) = (Vec::new(), Vec::new());
            for coedge in &chain.coedges {
                begins.push(places.len());
                let flat = Flat::new(&coedge.pcurve, scale, error);
                // Long lines of the domain may be bent in space.
                for pair in flat.parameters.windows(2) {
                    let length = flat.parameters[flat.segments()] - flat.parameters[0];
                    let count = ((pair[1] - pair[0]) / length * SEGMENTS as f64).ceil().max(1.0);
                    for k in 0..count as usize {
                        let t = between(pair[0], pair[1], k as f64 / count);
                        places.push(coedge.pcurve.evaluate(t));
                    }
                }
                places.push(coedge.end());
            }
            loops.push(places);
            starts.push(begins);
        }
        Self { face, loops, starts }
    }

    fn color(&self, chain: usize) -> &'static str {
        match self.face.loops()[chain].kind {
            LoopKind::Outer => OUTER,
            LoopKind::Inner => INNER,
        }
    }

    /// Whether a place is inside the face.
    fn holds(&self, at: Parameters) -> bool {
        let turns = |polygon: &Vec<Parameters>| super::report::winding(polygon, at);
        self.loops.iter().map(turns).sum::<i32>() == 1
    }

    fn domain(&self, [left, top]: [f64; 2], out: &mut String) {
        let [u0, u1, v0, v1] = self.face.support().domain();
        let place = |p: Parameters| {
            [left + SIDE * (p[0] - u0) / (u1 - u0), top + SIDE * (v1 - p[1]) / (v1 - v0)]
        };
        let _ = writeln!(
            out,
            "<rect x=\"{left}\" y=\"{top}\" width=\"{SIDE}\" height=\"{SIDE}\" fill=\"#ececec\"/>"
        );
        let mut region = String::new();
        for chain in &self.loops {
            region.push_str(&path(chain.iter().map(|&p| place(p))));
            region.push_str("Z ");
        }
        let _ = writeln!(
            out,
            "<path d=\"{region}\" fill=\"#dbe8fb\" fill-rule=\"evenodd\" stroke=\"none\"/>"
        );
        let (closed, collapsed) =
            (self.face.support().closed(), self.face.support().collapsed_edges());
        let corners = [[u0, v0], [u1, v0], [u1, v1], [u0, v1]];
        let sides = [[0, 3], [1, 2], [0, 1], [3, 2]];
        for (side, [a, b]) in sides.into_iter().enumerate() {
            let color = if collapsed[side] {
                COLLAPSED
            } else if closed[side / 2] {
                SEAM
            } else {
                "#999999"
            };
            let dash = if collapsed[side] { "2 4" } else { "none" };
            let line = path([place(corners[a]), place(corners[b])].into_iter());
            let _ = writeln!(
                out,
                "<path d=\"{line}\" fill=\"none\" stroke=\"{color}\" stroke-width=\"5\" stroke-opacity=\"0.45\" \
                 stroke-dasharray=\"{dash}\"/>"
            );
        }
        for (k, chain) in self.loops.iter().enumerate() {
            let (color, line) = (self.color(k), path(chain.iter().map(|&p| place(p))));
            let _ = writeln!(
                out,
                "<path d=\"{line}\" fill=\"none\" stroke=\"{color}\" stroke-width=\"1.6\"/>"
            );
            for (i, &start) in self.starts[k].iter().enumerate() {
                let end = self.starts[k].get(i + 1).copied().unwrap_or(chain.len());
                let [x, y] = place(chain[start]);
                let _ = writeln!(
                    out,
                    "<circle cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"2.6\" fill=\"{color}\"/>"
                );
                arrow(chain[start..end].iter().map(|&p| place(p)).collect(), color, out);
            }
        }
        let low = top + SIDE + 14.0;
        let text = format!("u {u0:.4} .. {u1:.4}   v {v0:.4} .. {v1:.4}");
        let _ = writeln!(out, "<text x=\"{left}\" y=\"{low}\" fill=\"#555555\">{text}</text>");
    }

    fn space(&self, [left, top]: [f64; 2], view: Vector, out: &mut String) {
        let up = if view[2].abs() < 0.99 { [0.0, 0.0, 1.0] } else { [0.0, 1.0, 0.0] };
        let right = unit(cross(view, up));
        let up = cross(right, view);
        let support = self.face.support();
        let project = |p: Vector| [dot(p, right), dot(p, up)];
        // Lines in space with whether each piece looks away; what is pale goes below.
        let mut lines: Vec<(Vec<[f64; 2]>, bool, &str, f64)> = Vec::new();
        let mut add = |places: &[Parameters], color: &'static str, width: f64| {
            let mut run: Vec<[f64; 2]> = Vec::new();
            let mut pale = false;
            for pair in places.windows(2) {
                let middle = [0, 1].map(|k| 0.5 * (pair[0][k] + pair[1][k]));
                let mut out = [[0.0; 3]; 3];
                let known = support.partials(middle, 1, &mut out);
                let mut normal = cross(out[1], out[2]);
                if self.face.is_flipped() {
                    normal = scaled(normal, -1.0);
                }
                let away = known && dot(normal, view) > 0.0;
                let [p, q] = [pair[0], pair[1]].map(|place| project(support.evaluate(place)));
                if !(p.iter().chain(&q).all(|x| x.is_finite())) {
                    continue;
                }
                if run.last() != Some(&p) || away != pale {
                    if run.len() > 1 {
                        lines.push((std::mem::take(&mut run), pale, color, width));
                    }
                    (run, pale) = (vec![p], away);
                }
                run.push(q);
            }
            if run.len() > 1 {
                lines.push((run, pale, color, width));
            }
        };
        let [u0, u1, v0, v1] = support.domain();
        for k in 0..=ISOLINES {
            let share = k as f64 / ISOLINES as f64;
            for across in [false, true] {
                let at = |s: f64| {
                    let (a, b) = if across { (s, share) } else { (share, s) };
                    [between(u0, u1, a), between(v0, v1, b)]
                };
                let mut chain: Vec<Parameters> = Vec::new();
                for i in 0..SEGMENTS {
                    let [p, m, q] = [0.0, 0.5, 1.0].map(|x| at((i as f64 + x) / SEGMENTS as f64));
                    if self.holds(m) {
                        if chain.is_empty() {
                            chain.push(p);
                        }
                        chain.push(q);
                    } else {
                        add(&std::mem::take(&mut chain), "#8fa8c8", 0.8);
                    }
                }
                add(&chain, "#8fa8c8", 0.8);
            }
        }
        for (k, chain) in self.loops.iter().enumerate() {
            add(chain, self.color(k), 1.8);
        }
        let mut bounds = [f64::INFINITY, f64::NEG_INFINITY, f64::INFINITY, f64::NEG_INFINITY];
        for [x, y] in lines.iter().flat_map(|line| line.0.iter()) {
            bounds = [bounds[0].min(*x), bounds[1].max(*x), bounds[2].min(*y), bounds[3].max(*y)];
        }
        let size = (bounds[1] - bounds[0]).max(bounds[3] - bounds[2]).max(f64::MIN_POSITIVE);
        let place = |[x, y]: [f64; 2]| {
            [
                left + SIDE * (0.5 + (x - 0.5 * (bounds[0] + bounds[1])) / size),
                top + SIDE * (0.5 - (y - 0.5 * (bounds[2] + bounds[3])) / size),
            ]
        };
        lines.sort_by_key(|line| (!line.1, (line.3 * 10.0) as i64));
        for (points, away, color, width) in lines {
            let line = path(points.into_iter().map(place));
            let opacity = if away { 0.25 } else { 1.0 };
            let _ = writeln!(
                out,
                "<path d=\"{line}\" fill=\"none\" stroke=\"{color}\" stroke-width=\"{width}\" stroke-opacity=\"{opacity}\" \
                 stroke-linecap=\"round\"/>"
            );
        }
    }
}

fn path(points: impl Iterator<Item = [f64; 2]>) -> String {
    let mut out = String::new();
    for (k, [x, y]) in points.enumerate() {
        let _ = write!(out, "{}{x:.2} {y:.2} ", if k == 0 { "M" } else { "L" });
    }
    out
}

/// The way a chain runs, in its middle.
fn arrow(chain: Vec<[f64; 2]>, color: &str, out: &mut String) {
    let length = |p: [f64; 2], q: [f64; 2]| (q[0] - p[0]).hypotenuse(q[1] - p[1]);
    let total: f64 = chain.windows(2).map(|w| length(w[0], w[1])).sum();
    let mut left = 0.5 * total;
    for pair in chain.windows(2) {
        let step = length(pair[0], pair[1]);
        if step < left || step == 0.0 {
            left -= step;
            continue;
        }
        let way = [0, 1].map(|k| (pair[1][k] - pair[0][k]) / step);
        let at = [0, 1].map(|k| pair[0][k] + left * way[k]);
        let tip = [0, 1].map(|k| at[k] + 6.0 * way[k]);
        let side = |s: f64| [at[0] - 3.0 * way[0] - s * way[1], at[1] - 3.0 * way[1] + s * way[0]];
        let shape = path([tip, side(4.0), side(-4.0)].into_iter());
        let _ = writeln!(out, "<path d=\"{shape}Z\" fill=\"{color}\"/>");
        return;
    }
}

fn unit(v: Vector) -> Vector {
    scaled(v, 1.0 / norm(v))
}
