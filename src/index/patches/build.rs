//! Building the patches of a surface: extraction, balance of weights, collapsed edges; by all cores when there are many.

use super::blocks::{Numbers, PART};
use crate::bezier::{Bidegree, extraction};
use crate::bounds::{Aabb, HALF_ULP, Vector, add, extent, norm, sub};
use crate::error::Error;
use crate::index::patch::{MOST_SPREAD, Patch};
use crate::index::piece::{
    Frame, LocalNet, MAX_TENSOR_BYTES, Span, balance_for, parts_for, position_steps,
    power_of_two_over, push_tensors, reserved, tensor_len,
};
use crate::index::reach::{Cell, Raster, push_cells};
use crate::index::segments::pieces;
use crate::jet::lanes;
use crate::knots::Knots;
use crate::surface::Surface;
use std::ops::Range;
use std::panic::resume_unwind;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

/// Parts from which on all cores build.
const MANY: usize = 4;

/// Patches between two looks at `poll`.
const GROUP: usize = 256;

/// One direction's spans with their extraction matrices.
#[derive(Debug)]
struct Direction {
    spans: Vec<(usize, [f64; 2])>,
    matrices: Vec<f64>,
    size: usize,
}

impl Direction {
    fn new(knots: &Knots, parts: usize) -> Self {
        let spans = pieces(knots, parts);
        let size = knots.degree() + 1;
        let mut matrices = vec![0.0; spans.len() * size * size];
        for (matrix, &(span, ends)) in matrices.chunks_exact_mut(size * size).zip(&spans) {
            extraction(knots, span, ends, matrix);
        }
        Self { spans, matrices, size }
    }

    fn memory(&self) -> usize {
        self.matrices.capacity() * 8 + self.spans.capacity() * size_of::<(usize, [f64; 2])>()
    }

    fn matrix(&self, k: usize) -> &[f64] {
        let n = self.size * self.size;
        &self.matrices[k * n..(k + 1) * n]
    }
}

/// What is known before the first patch is made.
#[derive(Debug)]
pub struct Plan {
    surface: Arc<Surface>,
    u: Direction,
    v: Direction,
    /// As of the index.
    pub frame: Frame,
    /// As of the index.
    pub degree: Bidegree,
    /// As of the index.
    pub rational: bool,
    /// As of the index.
    pub columns: usize,
    /// The cells of all patches.
    pub raster: Raster,
    keep_tensors: bool,
    /// Collapsed edges whose poles are made to coincide, and where.
    exact: [bool; 4],
    points: [Vector; 4],
}

/// Patches with their numbers, in order.
#[derive(Default)]
pub struct Made {
    /// As of the index.
    pub patches: Vec<Patch>,
    /// Their numbers, when they are wanted: of [`PART`] patches each.
    pub numbers: Vec<Numbers>,
    /// Their boxes.
    pub boxes: Vec<Aabb>,
    /// Their cells.
    pub cells: Vec<Cell>,
}

/// What is kept of the patches made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Keep {
    /// Everything.
    All,
    /// All but the numbers.
    Places,
    /// All but the cells.
    Numbers,
}

struct Builder<'a> {
    plan: &'a Plan,
    patches: Vec<Patch>,
    numbers: Numbers,
    boxes: Vec<Aabb>,
    cells: Vec<Cell>,
    keep: Keep,
}

impl Plan {
    pub fn new(surface: Arc<Surface>) -> Self {
        let rational = surface.is_rational();
        let [parts_u, parts_v] = if rational { parts(&surface) } else { [1, 1] };
        let u = Direction::new(surface.knots_u(), parts_u);
        let v = Direction::new(surface.knots_v(), parts_v);
        let degree = Bidegree { s: u.size - 1, t: v.size - 1 };
        let (count, columns) = (u.spans.len() * v.spans.len(), v.spans.len());
        let tensor_width = tensor_len(degree, rational);
        let keep_tensors = count * tensor_width * 8 <= MAX_TENSOR_BYTES || tensor_width <= 1125;
        let frame = Frame::new(surface.poles(), surface.bounding_box());
        let collapsed = surface.collapsed_edges();
        let is_exact = |k: usize| surface.collapsed_spread(k) <= MOST_SPREAD * frame.diagonal;
        let exact = [0, 1, 2, 3].map(|k| collapsed[k] && is_exact(k));
        let points = collapsed_points(&surface, exact).map(|point| frame.enter(point));
        let spans = [&u, &v].map(|way| way.spans.iter().map(|span| span.0).collect::<Vec<_>>());
        let raster = Raster::new(&surface, [&spans[0], &spans[1]]);
        Self {
            surface,
            u,
            v,
            frame,
            degree,
            rational,
            columns,
            raster,
            keep_tensors,
            exact,
            points,
        }
    }

    /// Number of patches.
    pub fn count(&self) -> usize {
        self.u.spans.len() * self.columns
    }

    /// Bytes held beside the surface.
    pub fn memory(&self) -> usize {
        self.u.memory() + self.v.memory()
    }

    /// Makes all patches, part by part. Errors as of the index.
    pub fn build(&self, keep: Keep, poll: &mut dyn FnMut() -> bool) -> Result<Made, Error> {
        let count = self.count();
        let parts = count.div_ceil(PART);
        let (next, stop) = (AtomicUsize::new(0), AtomicBool::new(false));
        let work = |poll: &mut dyn FnMut() -> bool| {
            let mut done: Vec<(usize, Result<Made, Error>)> = Vec::new();
            loop {
                let k = next.fetch_add(1, Ordering::Relaxed);
                if k >= parts || stop.load(Ordering::Relaxed) {
                    return done;
                }
                let part = self.part(k * PART..((k + 1) * PART).min(count), keep, poll);
                if part.is_err() {
                    stop.store(true, Ordering::Relaxed);
                }
                done.push((k, part));
            }
        };
        let cores = std::thread::available_parallelism().map_or(1, usize::from);
        let mut done = std::thread::scope(|scope| {
            let start = || {
                let mut poll = || stop.load(Ordering::Relaxed);
                std::thread::Builder::new().spawn_scoped(scope, move || work(&mut poll))
            };
            // A thread that could not be started leaves its share to the others.
            let others: Vec<_> =
                (1..if parts < MANY { 1 } else { cores }).filter_map(|_| start().ok()).collect();
            let mut done = work(poll);
            for thread in others {
                done.extend(thread.join().unwrap_or_else(|panic| resume_unwind(panic)));
            }
            done
        });
        done.sort_unstable_by_key(|(k, _)| *k);
        if let [(_, only)] = &mut done[..] {
            return std::mem::replace(only, Ok(Made::default()));
        }
        let cells = if keep == Keep::Numbers { 0 } else { self.raster.count() };
        let mut all = Made {
            patches: reserved(count)?,
            numbers: reserved(parts)?,
            boxes: reserved(count)?,
            cells: reserved(cells)?,
        };
        for (_, part) in done {
            all.append(part?);
        }
        Ok(all)
    }

    /// The patches of `range`.
    pub fn part(
        &self,
        range: Range<usize>,
        keep: Keep,
        poll: &mut dyn FnMut() -> bool,
    ) -> Result<Made, Error> {
        let (room, count) = (range.len(), self.degree.count());
        let width = count * if self.rational { 4 } else { 3 };
        let tensors = if self.keep_tensors { tensor_len(self.degree, self.rational) } else { 0 };
        // Without the numbers there is room for those of one patch.
        let nets = if keep == Keep::Places { 1 } else { room };
        let kept = if keep == Keep::Places { 0 } else { room };
        let split = |k: usize| self.raster.split([k / self.columns, k % self.columns]);
        let cells = match keep {
            Keep::Numbers => 0,
            _ => range.clone().map(|k| split(k)[0] * split(k)[1]).sum(),
        };
        let mut builder = Builder {
            plan: self,
            patches: reserved(room)?,
            numbers: Numbers {
                nets: reserved(nets * width)?,
                lanes: reserved(kept * count)?,
                tensors: reserved(kept * tensors)?,
            },
            boxes: reserved(room)?,
            cells: reserved(cells)?,
            keep,
        };
        for (done, k) in range.enumerate() {
            if done % GROUP == GROUP - 1 && poll() {
                return Err(Error::Cancelled);
            }
            builder.push_patch(k);
        }
        let Builder { patches, numbers, boxes, cells, .. } = builder;
        Ok(Made { patches, numbers: vec![numbers], boxes, cells })
    }

    fn local_net(&self, span_u: usize, span_v: usize) -> LocalNet {
        let surface = &*self.surface;
        let columns = surface.knots_v().pole_count();
        let mut local = Vec::with_capacity(self.degree.count());
        // Equal weights are no weights: the surface says so, and then they must not scale the poles.
        let weights = surface.weights().filter(|_| self.rational);
        for i in span_u - self.degree.s..=span_u {
            for j in span_v - self.degree.t..=span_v {
                let at = i * columns + j;
                let weight = weights.map_or(1.0, |w| w[at]);
                local.push((self.frame.enter(surface.poles()[at]), weight));
            }
        }
        LocalNet::new(&local)
    }
}

impl Made {
    fn append(&mut self, mut other: Self) {
        self.patches.append(&mut other.patches);
        self.numbers.append(&mut other.numbers);
        self.boxes.append(&mut other.boxes);
        self.cells.append(&mut other.cells);
    }
}

impl Builder<'_> {
    fn push_patch(&mut self, k: usize) {
        let plan = self.plan;
        let (u, v, surface) = (&plan.u, &plan.v, &*plan.surface);
        let (a, b) = (k / plan.columns, k % plan.columns);
        let at_side = [a == 0, a + 1 == u.spans.len(), b == 0, b + 1 == v.spans.len()];
        let net = plan.local_net(u.spans[a].0, v.spans[b].0);
        let start = self.numbers.nets.len();
        let components = if plan.rational { 4 } else { 3 };
        for component in &net.components[..components] {
            extract(component, u.matrix(a), u.size, v.matrix(b), v.size, &mut self.numbers.nets);
        }
        let balance = self.balance(start);
        let (border_u, border_v) =
            (border(surface.knots_u(), u.spans[a].1), border(surface.knots_v(), v.spans[b].1));
        let mut patch = Patch {
            u: Span { ends: u.spans[a].1, balance: balance[0] },
            v: Span { ends: v.spans[b].1, balance: balance[1] },
            center: net.center,
            radius: net.radius,
            border: [border_u[0], border_u[1], border_v[0], border_v[1]],
            collapsed: [0, 1, 2, 3].map(|k| at_side[k] && plan.exact[k]),
            spread: 0.0,
        };
        self.make_collapsed_exact(&mut patch, start);
        let mut aabb = Aabb::EMPTY;
        self.visit_poles(start, |_, _, pole, _| aabb.include(add(net.center, pole)));
        let margin = position_steps(plan.degree.s + plan.degree.t) * net.radius + 8.0 * HALF_ULP;
        let margin = margin + patch.spread;
        if self.keep != Keep::Numbers {
            let poles = &self.numbers.nets[start..];
            let (degree, rational) = (plan.degree, plan.rational);
            push_cells(poles, degree, rational, &patch, plan.raster.split([a, b]), &mut self.cells);
        }
        self.patches.push(patch);
        self.boxes.push(aabb.grown(margin));
        if self.keep == Keep::Places {
            self.numbers.nets.truncate(start);
            return;
        }
        let net = &self.numbers.nets[start..];
        self.numbers.lanes.extend(lanes(net, plan.rational));
        if plan.keep_tensors {
            push_tensors(net, plan.degree, plan.rational, &mut self.numbers.tensors);
        }
    }

    /// Balances the weights of the net that starts at `start`, by the product of the weights on opposite sides.
    fn balance(&mut self, start: usize) -> [f64; 2] {
        let (degree, count) = (self.plan.degree, self.plan.degree.count());
        if !self.plan.rational {
            return [1.0; 2];
        }
        let w = &self.numbers.nets[start + 3 * count..];
        let width = degree.t + 1;
        let ratio = |first: f64, last: f64| last / first;
        let corner = [w[0], w[degree.t], w[degree.s * width], w[count - 1]];
        let balance = [
            balance_for(ratio(corner[0] * corner[1], corner[2] * corner[3]).sqrt(), degree.s),
            balance_for(ratio(corner[0] * corner[2], corner[1] * corner[3]).sqrt(), degree.t),
        ];
        if balance != [1.0; 2] {
            let grown = |k: usize| {
                balance[0].powi((k / width) as i32) * balance[1].powi((k % width) as i32)
            };
            let largest = (0..count).fold(0.0, |m: f64, k| m.max(w[k] * grown(k)));
            let factor = power_of_two_over(largest);
            for component in self.numbers.nets[start..].chunks_exact_mut(count) {
                (0..count).for_each(|k| component[k] *= grown(k) * factor);
            }
        }
        balance
    }

    /// Calls `f(i, j, Euclidean pole, weight)` for the net that starts at `start`.
    fn visit_poles(&self, start: usize, mut f: impl FnMut(usize, usize, Vector, f64)) {
        let count = self.plan.degree.count();
        let net = &self.numbers.nets[start..];
        for k in 0..count {
            let w = if self.plan.rational { net[3 * count + k] } else { 1.0 };
            let at = |c: usize| net[c * count + k] / w;
            f(k / (self.plan.degree.t + 1), k % (self.plan.degree.t + 1), [at(0), at(1), at(2)], w);
        }
    }

    /// Moves the poles of collapsed sides onto their points, and records how far.
    fn make_collapsed_exact(&mut self, patch: &mut Patch, start: usize) {
        for k in (0..4).filter(|&k| patch.collapsed[k]) {
            let point = sub(self.plan.points[k], patch.center);
            let (last_i, last_j) = (self.plan.degree.s, self.plan.degree.t);
            let (mut moves, mut move_) = (Vec::new(), 0.0f64);
            self.visit_poles(start, |i, j, pole, weight| {
                if [i == 0, i == last_i, j == 0, j == last_j][k] {
                    moves.push((i * (last_j + 1) + j, weight));
                    move_ = move_.max(norm(sub(pole, point)));
                }
            });
            // The poles themselves are rounded, and so is the point.
            patch.spread += move_ + 2.0 * position_steps(last_i + last_j) * patch.radius;
            for (at, weight) in moves {
                for c in 0..3 {
                    self.numbers.nets[start + c * self.plan.degree.count() + at] =
                        weight * point[c];
                }
            }
        }
    }
}

/// Whether the ends of a piece are borders of the domain or C0 knots.
fn border(knots: &Knots, ends: [f64; 2]) -> [bool; 2] {
    let (first, last) = knots.domain();
    ends.map(|u| u == first || u == last || knots.breaks_at(u))
}

/// The points onto which collapsed edges are moved: a corner of the surface on each. Edges that meet share theirs.
fn collapsed_points(surface: &Surface, edges: [bool; 4]) -> [Vector; 4] {
    let [u0, u1, v0, v1] = surface.domain();
    let corner = [(u0, v0), (u1, v0), (u0, v0), (u0, v1)].map(|(u, v)| surface.evaluate(u, v));
    let linked = edges[0] && (edges[2] || edges[3]);
    let first = if edges[0] { Some(0) } else { edges[1].then_some(1) };
    let of_v = |k: usize| corner[first.unwrap_or(k)];
    [corner[0], corner[if linked { 0 } else { 1 }], of_v(2), of_v(3)]
}

/// Into how many parts the spans of u and v are cut: by the weights' growth along each direction.
fn parts(surface: &Surface) -> [usize; 2] {
    let weights = surface.weights().unwrap_or(&[]);
    let columns = surface.knots_v().pole_count();
    let window = |w: &[f64]| {
        let (low, high) = extent(w);
        high / low
    };
    let size = [surface.knots_u().degree() + 1, surface.knots_v().degree() + 1];
    let along_v = weights.chunks_exact(columns).flat_map(|row| row.windows(size[1]).map(window));
    let column = |j: usize| weights.iter().skip(j).step_by(columns).copied().collect::<Vec<f64>>();
    let along_u = (0..columns).map(|j| column(j).windows(size[0]).map(window).fold(1.0, f64::max));
    [along_u.fold(1.0, f64::max), along_v.fold(1.0, f64::max)].map(parts_for)
}

/// Applies the two extraction matrices to one component of a local net and appends the Bezier poles.
fn extract(
    local: &[f64],
    m_u: &[f64],
    rows: usize,
    m_v: &[f64],
    columns: usize,
    out: &mut Vec<f64>,
) {
    let mut half = vec![0.0; rows * columns];
    for i in 0..rows {
        for j in 0..columns {
            let row = &m_v[j * columns..(j + 1) * columns];
            half[i * columns + j] = row.iter().zip(&local[i * columns..]).map(|(m, x)| m * x).sum();
        }
    }
    for i in 0..rows {
        for j in 0..columns {
            out.push((0..rows).map(|k| m_u[i * rows + k] * half[k * columns + j]).sum());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::blocks::{Blocks, Store};
    use super::*;

    fn wavy(spans: usize) -> Surface {
        let count = spans + 2;
        let knots: Vec<f64> =
            (0..count + 3).map(|k| (k.clamp(2, count) - 2) as f64 / spans as f64).collect();
        let pole = |k: usize| {
            let (x, y) = ((k / count) as f64, (k % count) as f64);
            [x, y, (0.7 * x).sin() * (0.3 * y).cos()]
        };
        let poles: Vec<[f64; 3]> = (0..count * count).map(pole).collect();
        Surface::new(&knots, &knots, 2, 2, &poles, count, count, None).unwrap()
    }

    #[test]
    fn parts_joined_are_the_whole() {
        let surface = wavy(66);
        let (plan, count) = (Plan::new(Arc::new(surface)), 66 * 66);
        assert!(count >= MANY * PART);
        let whole = plan.part(0..count, Keep::All, &mut || false).unwrap();
        let built = plan.build(Keep::All, &mut || false).unwrap();
        let mut joined = plan.part(0..1000, Keep::All, &mut || false).unwrap();
        joined.append(plan.part(1000..count, Keep::All, &mut || false).unwrap());
        let nets =
            |made: &Made| made.numbers.iter().flat_map(|n| n.nets.clone()).collect::<Vec<_>>();
        let tensors =
            |made: &Made| made.numbers.iter().flat_map(|n| n.tensors.clone()).collect::<Vec<_>>();
        for other in [built, joined] {
            assert_eq!((nets(&whole), tensors(&whole)), (nets(&other), tensors(&other)));
            assert_eq!(whole.boxes, other.boxes);
            let centers = |made: &Made| -> Vec<_> {
                made.patches.iter().map(|p| (p.center, p.u, p.v, p.border)).collect()
            };
            assert_eq!(centers(&whole), centers(&other));
        }
    }

    #[test]
    fn blocks_hold_the_bits_of_the_whole() {
        let surface = Arc::new(wavy(66));
        let (plan, count) = (Plan::new(surface.clone()), 66 * 66);
        let whole = plan.part(0..count, Keep::All, &mut || false).unwrap();
        let bare = plan.build(Keep::Places, &mut || false).unwrap();
        assert_eq!(whole.boxes, bare.boxes);
        assert!(bare.numbers.iter().all(|n| n.nets.is_empty() && n.tensors.is_empty()));
        let numbers = &whole.numbers[0];
        let blocks = Store::Blocks(Box::new(Blocks::new(plan).unwrap()));
        let width = |all: usize| all / count;
        let (of_nets, of_tensors) = (width(numbers.nets.len()), width(numbers.tensors.len()));
        let empty = blocks.memory();
        for k in [0, 63, 64, 2000, count - 1] {
            let (block, at) = blocks.of(k);
            let part = |all: &[f64], each: usize, k: usize| all[k * each..(k + 1) * each].to_vec();
            assert_eq!(part(&block.nets, of_nets, at), part(&numbers.nets, of_nets, k), "{k}");
            let tensors = part(&block.tensors, of_tensors, at);
            assert_eq!(tensors, part(&numbers.tensors, of_tensors, k), "{k}");
        }
        assert!(blocks.memory() > empty && blocks.memory() < numbers.memory() / 4);
    }

    #[test]
    fn building_stops_when_asked_to() {
        let surface = wavy(66);
        let stopped = Plan::new(Arc::new(surface)).build(Keep::All, &mut || true);
        assert_eq!(stopped.err(), Some(Error::Cancelled));
    }
}
