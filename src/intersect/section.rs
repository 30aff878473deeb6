//! Sections of a surface by a plane or a quadric: all branches, with proof.

use super::branches::{Branch, BranchPoint, Drawing, branches};
use super::edges::{Cell, Edges, NodeKind};
use super::level::{Arc, Field, Level, Lump, Shape, value};
use super::quadric::{Form, Polynomial, Quadric};
use crate::bezier::derivative;
use crate::bounds::{extent, norm};
use crate::error::Error;
use crate::index::{IndexedSurface, Patch, SurfaceIndex};
use crate::set::{joined, touch};
use std::sync::Mutex;
use std::sync::PoisonError;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

/// Boxes that one section may take by default.
pub const DEFAULT_BUDGET: u64 = 200_000;

/// Share of the tolerance below which values count as none: edges that lie in the quadric, points of contact.
const NONE: f64 = 1e-6;

/// Boxes narrower than so many square roots of what counts as none are not taken apart: nearer to a crossing, which arm is
/// which does not mean anything.
const LEAST_ROOTS: f64 = 4.0;

/// What is asked of a section; zeros are the defaults.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SectionOptions {
    /// Length: boxes whose image is smaller are not taken apart; values within a millionth of it count as none (contacts, crossings, edges in the quadric).
    /// 0: 1e-7 of the diagonal of the surface's box.
    pub tolerance: f64,
    /// Length: most distance between a branch and its polyline. 0: 1e-4 of the diagonal.
    pub chord: f64,
    /// Most boxes of one section. 0: [`DEFAULT_BUDGET`].
    pub budget: u64,
}

/// A point where the surfaces touch without a branch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// Parameters and point.
    pub at: BranchPoint,
    /// About the distance from the quadric.
    pub distance: f64,
}

/// A point where branches meet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Junction {
    /// Parameters and point.
    pub at: BranchPoint,
    /// Number of arms.
    pub arms: usize,
}

/// Where a surface meets a plane or a quadric.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Section {
    /// Branches between special points, and loops.
    pub branches: Vec<Branch>,
    /// Isolated points of contact.
    pub contacts: Vec<Contact>,
    /// Points where branches meet.
    pub junctions: Vec<Junction>,
    /// Parameter boxes u0, u1, v0, v1 on which the surface lies in the quadric; their rims are branches.
    pub overlaps: Vec<[f64; 4]>,
    /// Parameter boxes in which nothing could be decided.
    pub undecided: Vec<[f64; 4]>,
    /// Whether the caller said stop: what was not looked at by then is undecided.
    pub stopped: bool,
}

impl Section {
    /// Whether nothing is missing.
    pub fn is_complete(&self) -> bool {
        self.undecided.is_empty()
    }
}

impl IndexedSurface {
    /// Where this surface meets a plane or a quadric: all branches with proof; what could not be decided is listed. When `poll` says stop
    /// that is what was not looked at ([`Section::stopped`]).
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn section(
        &self,
        quadric: &Quadric,
        options: &SectionOptions,
        poll: &mut dyn FnMut() -> bool,
    ) -> Result<Section, Error> {
        match self.index(poll) {
            Err(Error::Cancelled) => Ok(self.unreached()),
            index => Work::new(self, index?, quadric, options).run(poll),
        }
    }

    /// Sections by many planes or quadrics over `threads` threads (0: all cores); `poll` gets the number done. Results do not depend on the threads.
    ///
    /// # Errors
    /// As [`Self::section`].
    pub fn sections(
        &self,
        quadrics: &[Quadric],
        options: &SectionOptions,
        threads: usize,
        poll: &mut dyn FnMut(usize) -> bool,
    ) -> Result<Vec<Section>, Error> {
        let index = match self.index(&mut || poll(0)) {
            Err(Error::Cancelled) => {
                return Ok(quadrics.iter().map(|_| self.unreached()).collect());
            }
            index => index?,
        };
        let cores = std::thread::available_parallelism().map_or(1, usize::from);
        let threads = if threads == 0 { cores } else { threads }.min(quadrics.len()).max(1);
        let (next, done) = (AtomicUsize::new(0), AtomicUsize::new(0));
        let stop = AtomicBool::new(false);
        let results: Vec<Mutex<Option<Result<Section, Error>>>> =
            quadrics.iter().map(|_| Mutex::new(None)).collect();
        let work = |poll: &mut dyn FnMut() -> bool| {
            loop {
                let k = next.fetch_add(1, Ordering::Relaxed);
                let Some(quadric) = quadrics.get(k) else { break };
                let made = match stop.load(Ordering::Relaxed) {
                    true => Ok(self.unreached()),
                    false => Work::new(self, index, quadric, options).run(poll),
                };
                *results[k].lock().unwrap_or_else(PoisonError::into_inner) = Some(made);
                done.fetch_add(1, Ordering::Relaxed);
            }
        };
        std::thread::scope(|scope| {
            for _ in 1..threads {
                let work = &work;
                let stop = &stop;
                let task = move || work(&mut || stop.load(Ordering::Relaxed));
                let _ = std::thread::Builder::new().spawn_scoped(scope, task);
            }
            work(&mut || {
                let wants = stop.load(Ordering::Relaxed) || poll(done.load(Ordering::Relaxed));
                stop.fetch_or(wants, Ordering::Relaxed);
                wants
            });
        });
        let unwrap = |cell: Mutex<Option<Result<Section, Error>>>| {
            cell.into_inner()
                .unwrap_or_else(PoisonError::into_inner)
                .unwrap_or_else(|| Ok(self.unreached()))
        };
        results.into_iter().map(unwrap).collect()
    }

    /// A section of which nothing is known.
    fn unreached(&self) -> Section {
        let undecided = vec![self.surface().domain()];
        Section { undecided, stopped: true, ..Section::default() }
    }
}

struct Work<'a> {
    shape: &'a IndexedSurface,
    index: &'a SurfaceIndex,
    quadric: &'a Quadric,
    tolerance: f64,
    chord: f64,
    budget: u64,
}

impl<'a> Work<'a> {
    fn new(
        shape: &'a IndexedSurface,
        index: &'a SurfaceIndex,
        quadric: &'a Quadric,
        options: &SectionOptions,
    ) -> Self {
        let or = |asked: f64, share: f64| {
            let least = 1e-12 * index.frame.diagonal;
            if asked > 0.0 { asked.max(least) } else { share * index.frame.diagonal }
        };
        Self {
            shape,
            index,
            quadric,
            tolerance: or(options.tolerance, 1e-7),
            chord: or(options.chord, 1e-4),
            budget: if options.budget > 0 { options.budget } else { DEFAULT_BUDGET },
        }
    }

    fn run(&self, poll: &mut dyn FnMut() -> bool) -> Result<Section, Error> {
        let Some((mut cells, flat)) = self.cells(poll)? else {
            return Ok(self.shape.unreached());
        };
        let mut section = Section::default();
        if cells.iter().all(|cell| matches!(cell, Cell::Clear)) {
            return Ok(section);
        }
        let edges = Edges::new(self.index, &mut cells, flat);
        let mut level = Level { nodes: edges.kinds.clone(), ..Level::default() };
        let mut budget = self.budget;
        for (patch, cell) in cells.iter().enumerate() {
            match cell {
                Cell::Clear => {}
                Cell::Flat => level.flat.push(patch),
                Cell::Open(polynomial) => {
                    // After a stop nothing is left to spend: the patch is listed.
                    section.stopped = section.stopped || poll();
                    if section.stopped {
                        budget = 0;
                    }
                    let speeds = |s: f64, t: f64| self.speeds(patch, s, t);
                    let least = self.tolerance * self.index.frame.scale;
                    let least = least.max(LEAST_ROOTS * flat.sqrt());
                    Field { patch, polynomial, flat, speeds: &speeds, least }.search(
                        &edges,
                        &mut level,
                        &mut budget,
                    );
                }
            }
        }
        self.flat_edges(&edges, &cells, &mut level);
        let lumps = std::mem::take(&mut level.lumps);
        let mut undecided = vec![false; level.nodes.len()];
        self.resolve(lumps, &edges, &cells, flat, &mut level, &mut section, &mut undecided);
        undecided.resize(level.nodes.len(), false);
        let polynomial = |patch: usize| match &cells[patch] {
            Cell::Open(f) => Some(f),
            _ => None,
        };
        let drawing = Drawing {
            surface: self.shape.surface(),
            index: self.index,
            polynomial: &polynomial,
            chord: self.chord,
            undecided: &undecided,
        };
        section.branches = branches(&level, &drawing);
        section.overlaps =
            joined(level.flat.iter().map(|&patch| self.area(patch, [0., 1., 0., 1.])).collect());
        section.undecided = joined(std::mem::take(&mut section.undecided));
        Ok(section)
    }

    /// The polynomial on each patch, and what counts as none; `None` after a stop.
    fn cells(&self, poll: &mut dyn FnMut() -> bool) -> Result<Option<(Vec<Cell>, f64)>, Error> {
        let index = self.index;
        let mut cells = Vec::new();
        cells.try_reserve_exact(index.patches.len()).map_err(|_| Error::OutOfMemory)?;
        let mut flat = NONE * self.tolerance * index.frame.scale;
        for (k, patch) in index.patches.iter().enumerate() {
            if k.is_multiple_of(256) && poll() {
                return Ok(None);
            }
            let form = Form::new(self.quadric, &index.frame, patch.center);
            if form.is_clear_of(patch.radius) {
                cells.push(Cell::Clear);
                continue;
            }
            let mut f = form.put_in(index.net(k).poles, index.degree, index.rational, patch.radius);
            f.error += patch.spread * 4.0;
            let (low, high) = extent(&f.values);
            if low > f.error || high < -f.error {
                cells.push(Cell::Clear);
            } else {
                flat = flat.max(4.0 * f.error);
                cells.push(Cell::Open(f));
            }
        }
        for cell in &mut cells {
            if matches!(cell, Cell::Open(f) if super::edges::vanishes(&f.values, flat)) {
                *cell = Cell::Flat;
            }
        }
        Ok(Some((cells, flat)))
    }

    fn speeds(&self, patch: usize, s: f64, t: f64) -> [f64; 2] {
        let jet = self.index.net(patch).jet(s, t, [0.0; 3]);
        [norm(jet.s), norm(jet.t)]
    }

    /// A local area in global parameters.
    fn area(&self, patch: usize, [s0, s1, t0, t1]: [f64; 4]) -> [f64; 4] {
        let Patch { u, v, .. } = &self.index.patches[patch];
        [u.global(s0), u.global(s1), v.global(t0), v.global(t1)]
    }

    /// Edges on which the polynomial vanishes become arcs, in one of the patches beside them that is not flat.
    fn flat_edges(&self, edges: &Edges, cells: &[Cell], level: &mut Level) {
        for edge in &edges.flat {
            debug_assert!(matches!(cells[edge.patch], Cell::Open(_)));
            let place = |x: f64| match edge.side {
                0 => [0.0, x],
                1 => [1.0, x],
                2 => [x, 0.0],
                _ => [x, 1.0],
            };
            for pair in edge.stops.windows(2) {
                level.arcs.push(Arc {
                    nodes: [pair[0].1, pair[1].1],
                    ends: [place(pair[0].0), place(pair[1].0)],
                    patch: edge.patch,
                    shape: Shape::Straight,
                    tangential: edge.tangential,
                });
            }
        }
    }

    /// Lumps that touch are one place: a contact, a passage, a junction, or nothing that could be decided.
    fn resolve(
        &self,
        lumps: Vec<Lump>,
        edges: &Edges,
        cells: &[Cell],
        flat: f64,
        level: &mut Level,
        section: &mut Section,
        undecided: &mut Vec<bool>,
    ) {
        let mut small = Vec::new();
        for lump in lumps {
            if lump.is_small {
                small.push((self.area(lump.patch, lump.area), lump));
                continue;
            }
            section.undecided.push(self.area(lump.patch, lump.area));
            lump.nodes.iter().for_each(|(node, _)| undecided[*node] = true);
        }
        let clusters = joined(small.iter().map(|(area, _)| *area).collect());
        for cluster in clusters {
            let inside: Vec<&Lump> = small
                .iter()
                .filter(|(area, _)| touch(area, &cluster))
                .map(|(_, lump)| lump)
                .collect();
            self.cluster(cluster, &inside, cells, flat, level, section, undecided);
        }
        self.special_nodes(edges, cells, level, section, undecided);
    }

    fn cluster(
        &self,
        area: [f64; 4],
        lumps: &[&Lump],
        cells: &[Cell],
        flat: f64,
        level: &mut Level,
        section: &mut Section,
        undecided: &mut Vec<bool>,
    ) {
        let mut arms: Vec<(usize, [f64; 2], usize)> = Vec::new();
        let mut special: Option<usize> = None;
        // A double zero on a patch's border is where arms of both patches meet, also across a seam.
        let mut double: Option<usize> = None;
        let seen: Vec<usize> =
            lumps.iter().flat_map(|lump| lump.nodes.iter().map(|(node, _)| *node)).collect();
        for lump in lumps {
            for &(node, place) in &lump.nodes {
                match level.nodes[node] {
                    NodeKind::Corner | NodeKind::Collapsed => special = Some(node),
                    NodeKind::Double if place.iter().any(|&x| x == 0.0 || x == 1.0) => {
                        double = Some(node);
                    }
                    NodeKind::Double => {
                        // Arcs that touch the line here from its other side: this is where all arms meet. An arc of
                        // contact ends here.
                        let arc = level.arcs.iter().find(|arc| arc.nodes.contains(&node));
                        match arc.map(|arc| arc.tangential) {
                            Some(true) => arms.push((node, place, lump.patch)),
                            Some(false) => double = double.or(Some(node)),
                            None => {}
                        }
                    }
                    _ if seen.iter().filter(|&&other| other == node).count() == 1 => {
                        arms.push((node, place, lump.patch));
                    }
                    _ => {}
                }
            }
        }
        if special.is_none() && !arms.is_empty() {
            special = double;
        }
        let (patch, at, value) = self.centre(lumps, cells);
        let point = self.place(patch, at);
        let straight = |nodes, ends, patch, level: &mut Level| {
            let shape = Shape::Straight;
            level.arcs.push(Arc { nodes, ends, patch, shape, tangential: false });
        };
        match (arms.len(), special) {
            (0, Some(_)) => {}
            (0, None) if value <= flat => {
                let distance = self.quadric.distance(point.point);
                section.contacts.push(Contact { at: point, distance });
            }
            (0, None) => section.undecided.push(area),
            // Three arms and more meet where the polynomial vanishes: elsewhere they are parts of a loop that is too small.
            (3.., None) if value > flat => {
                section.undecided.push(area);
                arms.iter().for_each(|(node, ..)| undecided[*node] = true);
            }
            (2, None) if arms[0].2 == arms[1].2 => {
                straight([arms[0].0, arms[1].0], [arms[0].1, arms[1].1], arms[0].2, level);
            }
            (count, special) => {
                let node = special.unwrap_or_else(|| {
                    let kind = if count == 2 { NodeKind::Simple } else { NodeKind::Singular };
                    level.nodes.push(kind);
                    undecided.push(false);
                    level.nodes.len() - 1
                });
                for &(arm, place, patch) in &arms {
                    let Patch { u, v, .. } = &self.index.patches[patch];
                    let centre = [u.local(point.at[0]), v.local(point.at[1])];
                    straight([arm, node], [place, centre], patch, level);
                }
                if special.is_none() && count % 2 == 1 {
                    section.undecided.push(area);
                    undecided[node] = true;
                }
            }
        }
    }

    fn place(&self, patch: usize, at: [f64; 2]) -> BranchPoint {
        let Patch { u, v, .. } = &self.index.patches[patch];
        let at = [u.global(at[0]), v.global(at[1])];
        BranchPoint { at, point: self.shape.surface().evaluate(at[0], at[1]) }
    }

    /// The place where the polynomial is stationary in or near lumps, and the size of its value there.
    fn centre(&self, lumps: &[&Lump], cells: &[Cell]) -> (usize, [f64; 2], f64) {
        let mut best = (lumps[0].patch, [0.5; 2], f64::INFINITY);
        for lump in lumps {
            let Cell::Open(f) = &cells[lump.patch] else { continue };
            let [s0, s1, t0, t1] = lump.area;
            let middle = [0.5 * (s0 + s1), 0.5 * (t0 + t1)];
            // Where the slope vanishes the value tells whether they touch or a loop is too small to be taken apart.
            let at = stationary(f, middle, 64.0 * (s1 - s0).max(t1 - t0)).unwrap_or(middle);
            let size = value(&f.values, f.degree, at).abs();
            if size < best.2 {
                best = (lump.patch, at, size);
            }
        }
        best
    }

    /// Corners and collapsed edges without branches are contacts, unless branches may end there that were not looked for; nodes with
    /// more than two arms are junctions.
    fn special_nodes(
        &self,
        edges: &Edges,
        cells: &[Cell],
        level: &Level,
        section: &mut Section,
        undecided: &[bool],
    ) {
        let mut arms = vec![0; level.nodes.len()];
        let mut places = vec![None; level.nodes.len()];
        for arc in &level.arcs {
            for k in 0..2 {
                arms[arc.nodes[k]] += 1;
                places[arc.nodes[k]].get_or_insert((arc.patch, arc.ends[k]));
            }
        }
        let mut done = vec![false; level.nodes.len()];
        for (patch, cell) in cells.iter().enumerate() {
            if !matches!(cell, Cell::Open(_)) {
                continue;
            }
            for (k, corner) in edges.of_patch(patch).1.into_iter().enumerate() {
                let is_alone = |&node: &usize| arms[node] == 0 && !undecided[node];
                let Some(node) = corner.filter(is_alone) else { continue };
                if !std::mem::replace(&mut done[node], true) {
                    let at = [f64::from(u8::from(k >= 2)), f64::from(u8::from(k % 2 == 1))];
                    let at = self.place(patch, at);
                    section
                        .contacts
                        .push(Contact { at, distance: self.quadric.distance(at.point) });
                }
            }
        }
        for (node, place) in places.into_iter().enumerate() {
            if let Some((patch, at)) = place.filter(|_| arms[node] > 2) {
                section.junctions.push(Junction { at: self.place(patch, at), arms: arms[node] });
            }
        }
    }
}

/// The place near a start where the slope vanishes, if iteration stays within reach.
fn stationary(f: &Polynomial, start: [f64; 2], reach: f64) -> Option<[f64; 2]> {
    let d = f.degree;
    if d.s < 2 || d.t < 2 {
        return None;
    }
    let slope = |values: &[f64], degree, k| {
        let mut out = Vec::new();
        derivative(values, degree, k, &mut out);
        out
    };
    let first = [0, 1].map(|k| slope(&f.values, d, k));
    let second = [
        slope(&first[0], d.lowered(0), 0),
        slope(&first[0], d.lowered(0), 1),
        slope(&first[1], d.lowered(1), 1),
    ];
    let mut at = start;
    for _ in 0..20 {
        let g = [0, 1].map(|k| value(&first[k], d.lowered(k), at));
        let a = value(&second[0], d.lowered(0).lowered(0), at);
        let b = value(&second[1], d.lowered(0).lowered(1), at);
        let c = value(&second[2], d.lowered(1).lowered(1), at);
        let det = a * c - b * b;
        let step = [(b * g[1] - c * g[0]) / det, (b * g[0] - a * g[1]) / det];
        let next = [0, 1].map(|k| (at[k] + step[k]).clamp(0.0, 1.0));
        if next.iter().zip(start).any(|(x, y)| x.is_nan() || (x - y).abs() > reach) {
            return None;
        }
        let moved = (next[0] - at[0]).abs().max((next[1] - at[1]).abs());
        at = next;
        if moved < 1e-15 {
            break;
        }
    }
    Some(at)
}
