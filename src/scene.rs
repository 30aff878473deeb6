//! Many curves and surfaces searched together: the faces of a CAD model, the parts of an assembly.
//!
//! ```text
//!   scene tree over the members' boxes, nearest first
//!      -> member: query moved into its frame -> the member's own tree and search, within the best distance so far
//!      -> contest: least distance, least bound of all, ties between members
//! ```
//!
//! A member is a shape and a [`Placement`]; members may share a shape, whose index is built once. A foot of one member
//! closes the others: their search begins with its distance and with the plane through it, so that most of them are left
//! at the root of their tree.
//!
//! Guarantee: nothing on any placed shape is nearer than `lower_bound`, rounding of the placements included
//! (`docs/rounding.md`, section 17). The answer depends on the scene and the query alone; of members at the same distance
//! the one with the lowest number is named.
//! Limits: shapes given by functions have no proven box and cannot be members.

mod placement;

mod order;

mod build;

mod contest;

mod search;

mod facing;

pub use placement::{Placement, RIGID_TOLERANCE};
pub use search::{Hint, SceneFoot, SceneWorkspace};

use std::collections::HashMap;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use crate::bounds::{Aabb, HALF_ULP, Vector};
use crate::closest::{FootPoint, Found, QueryOptions, Within, Workspace};
use crate::curve::Curve;
use crate::error::Error;
use crate::index::{Frame, IndexedCurve, IndexedSurface, Poll};
use crate::simd::Level;
use crate::surface::Surface;
use crate::tree::Tree;

/// The member of a foot that has none: a bad query, or one that was not reached.
pub const NO_MEMBER: u32 = u32::MAX;

/// Members at most: their numbers share 32 bits with a mark of the tree.
pub const MAX_MEMBERS: usize = i32::MAX as usize;

/// A curve or a surface, shared.
#[derive(Clone, Debug)]
pub enum Shape {
    /// A curve.
    Curve(Arc<IndexedCurve>),
    /// A surface.
    Surface(Arc<IndexedSurface>),
}

impl Shape {
    /// Builds the index if it was not there.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`]; [`Error::Cancelled`] when `poll` said so.
    pub fn prepare(&self, poll: Poll) -> Result<(), Error> {
        match self {
            Self::Curve(curve) => curve.prepare(poll),
            Self::Surface(surface) => surface.prepare(poll),
        }
    }

    /// Bytes held, as far as the index is built.
    pub fn memory(&self) -> usize {
        match self {
            Self::Curve(curve) => curve.memory(),
            Self::Surface(surface) => surface.memory(),
        }
    }

    /// Start and end of u and v; curves: v = 0.
    pub fn domain(&self) -> [f64; 4] {
        match self {
            Self::Curve(curve) => [curve.curve().domain().0, curve.curve().domain().1, 0.0, 0.0],
            Self::Surface(surface) => surface.surface().domain(),
        }
    }

    /// The address, the same for all that share the shape.
    fn address(&self) -> usize {
        match self {
            Self::Curve(curve) => Arc::as_ptr(curve) as usize,
            Self::Surface(surface) => Arc::as_ptr(surface) as usize,
        }
    }

    /// The box of the placed shape: of its placed poles, when it is turned.
    fn placed_box(&self, placement: &Placement) -> Aabb {
        let (low, high) = match self {
            Self::Curve(curve) => curve.curve().bounding_box(),
            Self::Surface(surface) => surface.surface().bounding_box(),
        };
        if placement.is_identity() {
            return Aabb { low, high };
        }
        let greatest = low.iter().chain(&high).fold(0.0, |m: f64, x| m.max(x.abs()));
        let mut aabb = Aabb::EMPTY;
        match self {
            Self::Curve(curve) => {
                active_poles(curve.curve()).for_each(|pole| aabb.include(placement.place(*pole)));
            }
            Self::Surface(surface) => {
                active_net(surface.surface()).for_each(|pole| aabb.include(placement.place(*pole)))
            }
        }
        aabb.grown(placement.rounding(greatest))
    }

    fn closest_within(
        &self,
        query: Vector,
        hint: Option<[f64; 2]>,
        within: Option<Within>,
        options: &QueryOptions,
        workspace: &mut Workspace,
    ) -> Found {
        match self {
            Self::Curve(curve) => {
                curve.closest_within(query, hint.map(|at| at[0]), within, options, workspace)
            }
            Self::Surface(surface) => {
                surface.closest_within(query, hint, within, options, workspace)
            }
        }
    }

    fn local(
        &self,
        query: Vector,
        hint: Option<[f64; 2]>,
        options: &QueryOptions,
        workspace: &mut Workspace,
    ) -> FootPoint {
        match self {
            Self::Curve(curve) => {
                curve.closest(query, hint.map(|at| at[0]), options, workspace, None)
            }
            Self::Surface(surface) => surface.closest(query, hint, options, workspace, None),
        }
    }

    /// At most the distance to a place in the frame of the index, by boxes around the cells of a surface, or around many of them
    /// each (`roughly`); `None` where there are none.
    fn cells_distance(&self, place: Vector, roughly: bool) -> Option<f64> {
        let Self::Surface(surface) = self else { return None };
        let index = surface.index(&mut || false).ok()?;
        let (reach, level) = (index.reach.as_ref()?, index.tree.level());
        if roughly {
            Some(reach.rough_distance(place, level))
        } else {
            reach.distance(place, level)
        }
    }

    /// Tree and frame of the index, as the walk to its nearest piece needs them.
    fn tree(&self) -> Option<(&Tree, &Frame)> {
        match self {
            Self::Curve(curve) => {
                curve.index(&mut || false).ok().map(|index| (&index.tree, &index.frame))
            }
            Self::Surface(surface) => {
                surface.index(&mut || false).ok().map(|index| (&index.tree, &index.frame))
            }
        }
    }
}

fn active_poles(curve: &Curve) -> impl Iterator<Item = &Vector> {
    curve.poles()[curve.knots().active_poles()].iter()
}

fn active_net(surface: &Surface) -> impl Iterator<Item = &Vector> {
    let columns = surface.knots_v().pole_count();
    let along = surface.knots_v().active_poles();
    surface.knots_u().active_poles().flat_map(move |i| {
        surface.poles()[i * columns + along.start..i * columns + along.end].iter()
    })
}

/// A shape and where it stands.
#[derive(Clone, Debug)]
pub struct Member {
    /// The shape.
    pub shape: Shape,
    /// Its place.
    pub placement: Placement,
}

/// Members that are searched together. Immutable.
#[derive(Debug)]
pub struct Scene {
    members: Vec<Member>,
    /// Each shape once.
    shapes: Vec<Shape>,
    bounds: Aabb,
    frame: Frame,
    /// The member of each leaf of the tree.
    order: Vec<u32>,
    tree: Tree,
    /// Whether all indexes are built; a mark only, the indexes themselves are published by their shapes.
    is_ready: AtomicBool,
}

impl Scene {
    /// A scene of at least one member; members are numbered as they come.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for no members or too many, [`Error::OutOfMemory`].
    pub fn new(members: Vec<Member>) -> Result<Self, Error> {
        if members.is_empty() {
            return Err(Error::InvalidArgument("members: a scene needs at least one".into()));
        }
        if members.len() > MAX_MEMBERS {
            let text = format!("members: {} are more than {MAX_MEMBERS}", members.len());
            return Err(Error::InvalidArgument(text));
        }
        let mut boxes = reserved(members.len())?;
        boxes.extend(members.iter().map(|member| member.shape.placed_box(&member.placement)));
        let bounds = boxes.iter().fold(Aabb::EMPTY, |all, one| all.union(*one));
        let frame = Frame::new(&[], (bounds.low, bounds.high));
        let mut order: Vec<u32> = reserved(members.len())?;
        order.extend(0..members.len() as u32);
        order::by_halves(&boxes, &mut order);
        let mut leaves = reserved(members.len())?;
        leaves.extend(order.iter().map(|&member| {
            let Aabb { low, high } = boxes[member as usize];
            Aabb { low: frame.enter(low), high: frame.enter(high) }.grown(8.0 * HALF_ULP)
        }));
        let tree = Tree::new(&leaves, leaves.len(), 1, Level::detect());
        let shapes = distinct(&members)?;
        let is_ready = AtomicBool::new(false);
        Ok(Self { members, shapes, bounds, frame, order, tree, is_ready })
    }

    /// The members, as they came.
    pub fn members(&self) -> &[Member] {
        &self.members
    }

    /// The box in which all members lie.
    pub fn bounding_box(&self) -> Aabb {
        self.bounds
    }

    /// Bytes held, shapes and what is built of their indexes included, each once.
    pub fn memory(&self) -> usize {
        size_of::<Self>()
            + self.members.capacity() * size_of::<Member>()
            + self.shapes.capacity() * size_of::<Shape>()
            + self.order.capacity() * size_of::<u32>()
            + self.tree.memory()
            + self.shapes.iter().map(Shape::memory).sum::<usize>()
    }

    /// Builds the indexes that are not there on `threads` threads (0: all cores), the calling one included.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`]; [`Error::Cancelled`] when `poll` said so.
    pub fn prepare(&self, threads: usize, poll: Poll) -> Result<(), Error> {
        if self.is_ready.load(Ordering::Relaxed) {
            return Ok(());
        }
        build::prepare(&self.shapes, threads, poll)?;
        self.is_ready.store(true, Ordering::Relaxed);
        Ok(())
    }

    /// The placed member's point and derivatives at a parameter pair inside its domain, to total order `count`, into
    /// `out`: of a curve `count + 1` vectors, of a surface `(count + 1) (count + 2) / 2`.
    ///
    /// `out[0]` has the bits of a foot's `point` there.
    pub fn derivatives(&self, member: usize, at: [f64; 2], count: usize, out: &mut [Vector]) {
        let Member { shape, placement } = &self.members[member];
        match shape {
            Shape::Curve(curve) => curve.curve().derivatives(at[0], count, out),
            Shape::Surface(surface) => surface.surface().partials(at[0], at[1], count, out),
        }
        out[0] = placement.place(out[0]);
        for value in &mut out[1..] {
            *value = placement.turn(*value);
        }
    }
}

/// Each shape of the members once, in the order in which they come.
fn distinct(members: &[Member]) -> Result<Vec<Shape>, Error> {
    let mut known = HashMap::new();
    known.try_reserve(members.len()).map_err(|_| Error::OutOfMemory)?;
    let mut shapes = reserved(members.len())?;
    for member in members {
        if known.insert(member.shape.address(), ()).is_none() {
            shapes.push(member.shape.clone());
        }
    }
    shapes.shrink_to_fit();
    Ok(shapes)
}

/// An empty list with room for `count` values.
fn reserved<T>(count: usize) -> Result<Vec<T>, Error> {
    let mut list = Vec::new();
    list.try_reserve_exact(count).map_err(|_| Error::OutOfMemory)?;
    Ok(list)
}
