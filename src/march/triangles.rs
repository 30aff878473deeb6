//! Two discrete methods by name, both without proof: subdivision into flat pieces, and tessellation.
//!
//! ```text
//!   subdivision   pairs of Bezier pieces whose hulls meet, halved to a depth or until flat -> two triangles each
//!   mesh          two grids of triangles, pairs by a tree of boxes
//!   both          triangle against triangle -> segments -> joined end to end -> polylines
//! ```
//!
//! Points are as good as the triangles; `correct` makes points of the surfaces of them. What is smaller than a triangle is lost: that is
//! what the certified search is for. Reference: Moeller, *A fast triangle-triangle intersection test*, 1997 (intervals on the line).

use super::pair::misses;
use super::pieces::{Part, Pieces};
use super::search::MOST_PARTS;
use super::shape::Shape;
use crate::bounds::{Aabb, Vector, add, cross, dot, norm, scaled, sub};
use crate::error::Error;
use crate::surface::Surface;
use std::collections::HashMap;

/// Pairs between two looks at whether to stop.
const GROUP: u64 = 1024;

/// A triangle in space with the parameters of its corners.
#[derive(Clone, Copy)]
struct Triangle {
    at: [[f64; 2]; 3],
    x: [Vector; 3],
}

/// A place on a segment: position, parameters on A and on B.
#[derive(Clone, Copy, Debug)]
pub struct Node {
    /// Position on the triangles.
    pub x: Vector,
    /// u, v, s, t.
    pub at: [f64; 4],
}

/// A polyline of nodes; closed when the first comes last again.
pub type Polyline = Vec<Node>;

fn triangles(corner: impl Fn(f64, f64) -> ([f64; 2], Vector)) -> [Triangle; 2] {
    let c = [corner(0.0, 0.0), corner(1.0, 0.0), corner(1.0, 1.0), corner(0.0, 1.0)];
    let of = |k: [usize; 3]| Triangle { at: k.map(|i| c[i].0), x: k.map(|i| c[i].1) };
    [of([0, 1, 2]), of([0, 2, 3])]
}

/// Where edges of one triangle cross the plane of the other: (position, own parameters), two of them.
fn crossings(t: &Triangle, n: Vector, o: Vector) -> Option<[(Vector, [f64; 2]); 2]> {
    let d = t.x.map(|x| dot(n, sub(x, o)));
    let mut found = [(t.x[0], t.at[0]); 2];
    let mut count = 0;
    for (i, j) in [(0, 1), (1, 2), (2, 0)] {
        // A corner on the plane belongs to the upper side, so that shared edges are cut alike.
        if (d[i] >= 0.0) != (d[j] >= 0.0) {
            // The same order of ends in both triangles that share the edge: equal bits.
            let (i, j) = if d[i] < d[j] { (i, j) } else { (j, i) };
            let share = d[i] / (d[i] - d[j]);
            let x = add(t.x[i], scaled(sub(t.x[j], t.x[i]), share));
            let at = [0, 1].map(|k| t.at[i][k] + share * (t.at[j][k] - t.at[i][k]));
            if count < 2 {
                found[count] = (x, at);
            }
            count += 1;
        }
    }
    (count == 2).then_some(found)
}

fn meet(a: &Triangle, b: &Triangle) -> Option<[Node; 2]> {
    let normal = |t: &Triangle| cross(sub(t.x[1], t.x[0]), sub(t.x[2], t.x[0]));
    let (n, m) = (normal(a), normal(b));
    let line = cross(n, m);
    let ours = crossings(a, m, b.x[0])?;
    let theirs = crossings(b, n, a.x[0])?;
    let on = |x: Vector| dot(line, x);
    let order = |[p, q]: [(Vector, [f64; 2]); 2]| if on(p.0) <= on(q.0) { [p, q] } else { [q, p] };
    let (ours, theirs) = (order(ours), order(theirs));
    let (low, high) = (on(ours[0].0).max(on(theirs[0].0)), on(ours[1].0).min(on(theirs[1].0)));
    if low >= high {
        return None;
    }
    let along = |[p, q]: [(Vector, [f64; 2]); 2], x: f64| {
        let (from, to) = (on(p.0), on(q.0));
        let share = if to > from { ((x - from) / (to - from)).clamp(0.0, 1.0) } else { 0.0 };
        (add(p.0, scaled(sub(q.0, p.0), share)), [0, 1].map(|k| p.1[k] + share * (q.1[k] - p.1[k])))
    };
    let node = |x: f64| {
        let ((p, uv), (_, st)) = (along(ours, x), along(theirs, x));
        Node { x: p, at: [uv[0], uv[1], st[0], st[1]] }
    };
    Some([node(low), node(high)])
}

/// Segments joined end to end; ends nearer than `near` are one.
fn joined(segments: Vec<[Node; 2]>, near: f64) -> Vec<Polyline> {
    let cell =
        |x: Vector, by: [i64; 3]| [0, 1, 2].map(|k| (x[k] / (4.0 * near)).floor() as i64 + by[k]);
    let mut grid: HashMap<[i64; 3], Vec<(usize, usize)>> = HashMap::new();
    for (k, segment) in segments.iter().enumerate() {
        for end in 0..2 {
            grid.entry(cell(segment[end].x, [0; 3])).or_default().push((k, end));
        }
    }
    let mut used = vec![false; segments.len()];
    let next = |x: Vector, used: &[bool]| {
        let mut best: Option<(f64, usize, usize)> = None;
        for n in 0..27 {
            let by = [n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1].map(|i: i64| i);
            for &(k, end) in grid.get(&cell(x, by)).into_iter().flatten() {
                let far = norm(sub(segments[k][end].x, x));
                if !used[k] && far <= near && best.is_none_or(|b| far < b.0) {
                    best = Some((far, k, end));
                }
            }
        }
        best
    };
    let mut lines = Vec::new();
    for k in 0..segments.len() {
        if used[k] {
            continue;
        }
        used[k] = true;
        let mut line = vec![segments[k][0], segments[k][1]];
        for _ in 0..2 {
            while let Some((_, j, end)) = next(line[line.len() - 1].x, &used) {
                used[j] = true;
                line.push(segments[j][1 - end]);
            }
            line.reverse();
        }
        lines.push(line);
    }
    lines
}

fn node_gap(a: &Pieces, b: &Pieces) -> f64 {
    let size =
        |p: &Pieces| p.parts.iter().fold(Aabb::EMPTY, |all, part| all.union(part.aabb)).diagonal();
    1e-9 * size(a).min(size(b))
}

/// What a discrete method sees.
#[derive(Default)]
pub struct Discrete {
    /// Polylines.
    pub lines: Vec<Polyline>,
    /// Pairs of parts, or rows of cells, looked at.
    pub looked: u64,
    /// Whether the budget ran out: what was left then was taken as flat.
    pub exhausted: bool,
    /// Whether the caller said stop: what was left then is not in the lines.
    pub stopped: bool,
}

/// Subdivision by hulls: to `depth` halvings of each surface, or, when `flat` is a length, until every piece is as flat as that.
/// At most `budget` pairs; what is left then is taken as it is. `poll(looked, waiting)` is asked now and then whether to stop.
pub fn subdivided(
    a: &Surface,
    b: &Surface,
    depth: u32,
    flat: Option<f64>,
    budget: u64,
    poll: &mut dyn FnMut(u64, u64) -> bool,
) -> Discrete {
    let (mut p, mut q) = (Pieces::new(a), Pieces::new(b));
    let near = node_gap(&p, &q);
    let error = p.error + q.error;
    let roots = |x: &Pieces| x.patches.iter().map(|patch| patch.root).collect::<Vec<_>>();
    let mut waiting: Vec<(u32, u32, u32, u32)> = roots(&p)
        .into_iter()
        .flat_map(|i| roots(&q).into_iter().map(move |j| (i, j, 0, 0)))
        .collect();
    let (mut segments, mut found) = (Vec::new(), Discrete::default());
    while let Some((i, j, di, dj)) = waiting.pop() {
        if found.looked.is_multiple_of(GROUP) && poll(found.looked, waiting.len() as u64 + 1) {
            found.stopped = true;
            break;
        }
        found.looked += 1;
        found.exhausted |= found.looked > budget || p.parts.len() + q.parts.len() > MOST_PARTS;
        let (x, y) = (&p.parts[i as usize], &q.parts[j as usize]);
        if misses(x, y, error) {
            continue;
        }
        let done = |part: &Part, d: u32| match flat {
            Some(flat) => part.bend() <= flat || d >= 40,
            None => d >= depth,
        };
        let ends = [done(x, di), done(y, dj)];
        if ends == [true; 2] || found.exhausted {
            for s in flat_part(&p, x) {
                segments.extend(flat_part(&q, y).iter().filter_map(|t| meet(&s, t)));
            }
        } else if !ends[0] && (ends[1] || di <= dj) {
            waiting.extend(p.halves(i).map(|i| (i, j, di + 1, dj)));
        } else {
            waiting.extend(q.halves(j).map(|j| (i, j, di, dj + 1)));
        }
    }
    found.lines = joined(segments, near);
    found
}

fn flat_part(pieces: &Pieces, part: &Part) -> [Triangle; 2] {
    triangles(|s, t| {
        let at = [
            part.low[0] + s * (part.high[0] - part.low[0]),
            part.low[1] + t * (part.high[1] - part.low[1]),
        ];
        (pieces.global(part.patch, at), pieces.jet(part.patch, at)[0])
    })
}

/// Tessellation of both surfaces by grids of `cells` x `cells` cells over their domains. `poll(rows, rows left)` is asked whether to stop.
///
/// # Errors
/// [`Error::OutOfMemory`].
pub fn meshed(
    a: &dyn Shape,
    b: &dyn Shape,
    cells: usize,
    poll: &mut dyn FnMut(u64, u64) -> bool,
) -> Result<Discrete, Error> {
    let grid = |surface: &dyn Shape| {
        let [u0, u1, v0, v1] = surface.domain();
        let at = |i: usize, j: usize| {
            let share = |k: usize, [x, y]: [f64; 2]| {
                if k == cells { y } else { x + (y - x) * k as f64 / cells as f64 }
            };
            let at = [share(i, [u0, u1]), share(j, [v0, v1])];
            (at, surface.evaluate(at[0], at[1]))
        };
        let mut all = Vec::new();
        all.try_reserve_exact(cells * cells).map_err(|_| Error::OutOfMemory)?;
        for k in 0..cells * cells {
            let (i, j) = (k / cells, k % cells);
            let pair = triangles(|s, t| at(i + s as usize, j + t as usize));
            let mut aabb = Aabb::EMPTY;
            pair.iter().flat_map(|t| t.x).for_each(|x| aabb.include(x));
            all.push((aabb, pair));
        }
        Ok(all)
    };
    let (p, q) = (grid(a)?, grid(b)?);
    let mut found = Discrete::default();
    let (mut segments, meets) = (Vec::new(), |x: &Aabb, y: &Aabb| {
        (0..3).all(|k| x.low[k] <= y.high[k] && y.low[k] <= x.high[k])
    });
    let mut size = Aabb::EMPTY;
    for row in q.chunks_exact(cells.max(1)) {
        if poll(found.looked, cells as u64 - found.looked) {
            found.stopped = true;
            break;
        }
        found.looked += 1;
        let block = row.iter().fold(Aabb::EMPTY, |all, cell| all.union(cell.0));
        size = size.union(block);
        for x in p.iter().filter(|x| meets(&x.0, &block)) {
            for y in row.iter().filter(|y| meets(&x.0, &y.0)) {
                for s in &x.1 {
                    segments.extend(y.1.iter().filter_map(|t| meet(s, t)));
                }
            }
        }
    }
    found.lines = joined(segments, 1e-9 * size.diagonal());
    Ok(found)
}
