//! Surface-surface intersection: all branches, with a proof that none is missing, or with what could not be decided.
//!
//! ```text
//!   A, B -> pairs of parts -> empty | one arc, proven | halve | touch here          `pieces`, `arc`, `pair`, `search`
//!        -> arcs walked over knot lines and seams -> branches, refined to the chord  `join`
//!        -> touching curves traced, points and areas classified                      `contact`, `cluster`
//! ```
//!
//! Topology is decided by inequalities over whole boxes of (u, v, s, t), never by samples: a pair of parts is closed when it provably
//! holds no solution, or exactly one arc on which n_A x n_B does not vanish. What is tangential cannot be proven in floating
//! arithmetic; it is found, classified, measured, and said to be not proven ([`Intersection::is_proven`]).
//!
//! References: Sinha, Klassen, Wang 1985 and Sederberg, Meyers 1988 (loops and normals); Krawczyk 1969 (the test of an arc); Ye,
//! Maekawa 1999 (contact).
//! Faces, elementary surfaces and surfaces given by functions: [`faces`]. Limits: two arcs that run on both sides of a knot line at a distance below
//! the rounding are one.

mod watch;

mod bends;

mod pieces;

mod system;

mod arc;

mod pair;

pub mod shape;

mod contact;

mod search;

mod join;

mod tangent;

mod cluster;

mod overlap;

mod assemble;

pub mod correct;

pub mod follow;

pub mod bisect;

pub mod triangles;

mod corners;

pub mod curves;

mod functions;

pub mod named;

mod border;

pub mod faces;

pub mod split;

use crate::bounds::{HALF_ULP, Vector, add, norm, scaled, sub};
use crate::error::Error;
use crate::index::IndexedSurface;
use crate::surface::Surface;
use assemble::{Maker, at_point};
use cluster::clusters;
use join::Joiner;
pub use join::distance_to_chord;
use overlap::rims;
use search::Search;
use tangent::ridges;
use watch::Watch;

/// Pairs of parts that are judged at most, when the caller does not say.
pub const DEFAULT_BUDGET: u64 = 2_000_000;

/// What an intersection asks for.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MarchOptions {
    /// How far a branch may be from the chord between two points, finite, >= 0. 0: 1e-3 of the size of the smaller surface (the power
    /// of two above the diagonal of its box). Points themselves are as exact as the arithmetic: see [`Branch::gap`].
    pub chord: f64,
    /// Most pairs of parts; 0: [`DEFAULT_BUDGET`].
    pub budget: u64,
    /// Length, finite, >= 0: surfaces that are nearer than this touch where they are parallel, and are not told apart further; points of
    /// branches are within it of both surfaces, rounding included, or the result is not proven. 0: what the arithmetic can tell.
    pub tolerance: f64,
}

impl MarchOptions {
    /// # Errors
    /// [`Error::InvalidArgument`] for a length that is negative or not finite.
    fn checked(self) -> Result<Self, Error> {
        for (name, length) in [("chord", self.chord), ("tolerance", self.tolerance)] {
            if !length.is_finite() || length < 0.0 {
                let text = format!("{name}: {length} is not a length");
                return Err(Error::InvalidArgument(text));
            }
        }
        Ok(self)
    }

    /// The chord tolerance for surfaces of which the smaller has this size.
    fn chord_or(self, size: f64) -> f64 {
        if self.chord > 0.0 { self.chord } else { 1e-3 * size }
    }
}

/// A point of both surfaces.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct MarchPoint {
    /// Middle of the two surface points.
    pub point: Vector,
    /// Parameters of A.
    pub uv: [f64; 2],
    /// Parameters of B.
    pub st: [f64; 2],
}

/// What the end of a branch is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// The branch is closed and has no end.
    Closed,
    /// A border of A or B: side 0 to 7 (u low, u high, v low, v high, s low, s high, t low, t high).
    Border(u8),
    /// A contact of this number in [`Intersection::contacts`]: a branch point, a cusp, a collapsed edge.
    Contact(usize),
    /// An undecided box is there.
    Undecided,
    /// A trim of A (0) or B (1): see [`faces`].
    Trim(u8),
}

/// A curve of the intersection.
#[derive(Clone, Debug)]
pub struct Branch {
    /// Points in order, along n_A x n_B when transversal. A closed branch ends with its first point; at a seam of a closed surface
    /// the same point comes twice, with the parameters of either side.
    pub points: Vec<MarchPoint>,
    /// What its ends are.
    pub ends: [End; 2],
    /// Whether the surfaces touch along it.
    pub is_tangential: bool,
    /// Whether it bounds an area in which the surfaces coincide; then it is tangential too.
    pub bounds_overlap: bool,
    /// Greatest distance between the two surface points of one of its points.
    pub gap: f64,
    /// Proven: between two points the branch stays within this of their chord, a length. Infinite for a tangential branch; the last
    /// piece beside a contact is not counted, it is about as long as the contact's radius.
    pub chord: f64,
    /// Proven: between two points u, v, s, t stay within these of their straight line. Infinite where `chord` is.
    pub bulge: [f64; 4],
    /// For each chord the parameter over which it is a graph ([`Branch::ANY`]: not known, [`Branch::JUMP`]: it passes a seam).
    held: Vec<u8>,
}

impl Branch {
    const ANY: u8 = 4;
    const JUMP: u8 = 5;

    /// Whether point `i` is the one before it, seen from the other side of a seam.
    fn passes_seam(&self, i: usize) -> bool {
        i > 0 && self.held.get(i - 1) == Some(&Self::JUMP)
    }

    /// Whether it is a loop.
    pub fn is_closed(&self) -> bool {
        self.ends[0] == End::Closed
    }
}

/// What an isolated contact is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ContactKind {
    /// The surfaces touch from one side.
    Touching,
    /// Two curves cross: four arms.
    Crossing,
    /// The surfaces agree to a higher order than the second, or have no tangent plane.
    Degenerate,
    /// A border of one surface just meets the other one.
    Border,
    /// A collapsed edge of one surface, a point, lies on the other one.
    Tip,
}

/// A point that belongs to no branch, or in which branches meet.
#[derive(Clone, Copy, Debug)]
pub struct Contact {
    /// Where.
    pub place: MarchPoint,
    /// What.
    pub kind: ContactKind,
    /// Distance between the surfaces there.
    pub gap: f64,
    /// Nothing else of the intersection is farther from it than this and still not on a branch.
    pub radius: f64,
    /// The box of parameters that was not told apart further.
    pub area: Region,
}

/// A part in which the surfaces coincide to the last digits.
#[derive(Clone, Copy, Debug)]
pub struct Region {
    /// u0, u1, v0, v1 of A, s0, s1, t0, t1 of B.
    pub range: [f64; 8],
}

/// All that two surfaces have in common.
#[derive(Clone, Debug, Default)]
pub struct Intersection {
    /// Curves.
    pub branches: Vec<Branch>,
    /// Points.
    pub contacts: Vec<Contact>,
    /// Boxes in which the surfaces coincide.
    pub overlaps: Vec<Region>,
    /// Boxes about which nothing is known.
    pub undecided: Vec<Region>,
    /// Whether all is proven: every branch transversal, nothing undecided, no contact.
    pub is_proven: bool,
    /// Whether the budget ran out.
    pub exhausted: bool,
    /// Whether the caller said stop: what was not looked at by then is undecided, chords may be longer than asked ([`Branch::chord`]),
    /// and borders of overlaps are left out.
    pub stopped: bool,
    /// Pairs of parts judged.
    pub judged: u64,
    /// How far evaluating a point of both surfaces may be off together, a length: a point of a branch is within [`Branch::gap`] and this of
    /// each surface.
    pub rounding: f64,
}

impl Intersection {
    /// Whether the points of all branches are within `tolerance` of both surfaces; 0: nothing is asked.
    fn holds(&self, tolerance: f64) -> bool {
        let is_within = |branch: &Branch| branch.gap + self.rounding <= tolerance;
        tolerance == 0.0 || self.branches.iter().all(is_within)
    }
}

/// Both surfaces in one frame: around the middle of the smaller one, scaled by a power of two to its size.
struct Frames {
    surfaces: [Surface; 2],
    scale: f64,
    noise: f64,
}

impl Frames {
    fn new(a: &Surface, b: &Surface) -> Result<Self, Error> {
        let boxes = [a, b].map(|s| s.bounding_box());
        let sizes = boxes.map(|(low, high)| norm(sub(high, low)));
        let smaller = usize::from(sizes[1] < sizes[0]);
        let (low, high) = boxes[smaller];
        let origin = scaled(add(low, high), 0.5);
        if sizes[smaller] < 1e-150 {
            return Err(Error::Unsupported("surfaces: one of them is a point".into()));
        }
        let mut scale = 1.0;
        while scale * sizes[smaller] > 1.0 {
            scale *= 0.5;
        }
        while scale * sizes[smaller] <= 0.5 {
            scale *= 2.0;
        }
        let largest =
            boxes.iter().flat_map(|(l, h)| l.iter().chain(h)).fold(0.0f64, |m, x| m.max(x.abs()));
        let moved = |s: &Surface| {
            let poles: Vec<Vector> =
                s.poles().iter().map(|&p| scaled(sub(p, origin), scale)).collect();
            let (ku, kv) = (s.knots_u(), s.knots_v());
            let counts = [ku.pole_count(), kv.pole_count()];
            Surface::new(
                ku.values(),
                kv.values(),
                ku.degree(),
                kv.degree(),
                &poles,
                counts[0],
                counts[1],
                s.weights(),
            )
        };
        Ok(Self {
            surfaces: [moved(a)?, moved(b)?],
            scale,
            noise: 2.0 * HALF_ULP * largest * scale,
        })
    }
}

/// All that two surfaces have in common. `poll(judged, waiting)` is asked now and then whether to stop, while pairs are judged and in
/// every phase after that. A stop gives what was found so far and lists what was not looked at, as a budget does
/// ([`Intersection::stopped`]); it takes effect after what joining the arcs found so far takes.
///
/// # Errors
/// [`Error::InvalidArgument`] for a length that is negative or not finite; [`Error::Unsupported`] for a surface that is a point.
pub fn intersect(
    a: &IndexedSurface,
    b: &IndexedSurface,
    options: &MarchOptions,
    poll: &mut dyn FnMut(u64, u64) -> bool,
) -> Result<Intersection, Error> {
    let options = options.checked()?;
    let frames = Frames::new(a.surface(), b.surface())?;
    let [sa, sb] = &frames.surfaces;
    let chord = if options.chord > 0.0 { options.chord * frames.scale } else { 1e-3 };
    let tolerance = options.tolerance * frames.scale;
    let mut search = Search::new([sa, sb], frames.noise, tolerance);
    let budget = if options.budget > 0 { options.budget } else { DEFAULT_BUDGET };
    let watch = Watch::new(poll);
    search.run(budget, &watch);
    let (chains, points) = Joiner::new(&search, chord, &watch).chains();
    watch.phase();
    let ridges = ridges(&search, chord, &watch);
    watch.phase();
    let mut made =
        Maker { a: a.surface(), b: b.surface(), search: &search, out: Intersection::default() };
    (made.out.judged, made.out.exhausted) = (search.judged, search.exhausted);
    for &tip in &search.tips {
        if watch.stops(0) {
            made.unseen_tip(tip);
        } else {
            made.tip(tip, [a, b]);
        }
    }
    match clusters(&search, &watch) {
        Some(groups) => made.classify(&groups, &ridges, &watch),
        None => made.list(),
    }
    watch.phase();
    for place in points {
        let place = made.point(place);
        made.out.contacts.push(Contact {
            place,
            kind: ContactKind::Border,
            gap: made.gap(&place),
            radius: 0.0,
            area: at_point(&place),
        });
    }
    for chain in chains {
        watch.stops(0);
        let bounds = (chain.chord / frames.scale, chain.bulge, chain.held);
        made.push(chain.places.into_iter(), chain.stops, Some(bounds));
    }
    for ridge in ridges {
        made.push(ridge.places.iter().map(|place| place.at), ridge.stops, None);
    }
    made.join_at_tips();
    made.swallow();
    watch.phase();
    let rims = if watch.stopped() { Vec::new() } else { rims(&search, chord, &watch) };
    // Borders of areas that were followed in part say nothing: the areas are listed.
    for rim in rims.into_iter().filter(|_| !watch.stopped()) {
        made.push(rim.places.iter().map(|place| place.at), [rim.stop; 2], None);
        if let Some(branch) = made.out.branches.last_mut() {
            branch.bounds_overlap = true;
        }
    }
    watch.phase();
    made.out.stopped = watch.stopped();
    made.out.rounding = search.error / frames.scale;
    made.out.is_proven = settled(&made.out) && made.out.holds(options.tolerance);
    Ok(made.out)
}

/// Whether every branch is transversal, and nothing touches, coincides, or is undecided.
fn settled(out: &Intersection) -> bool {
    let transversal =
        |branch: &Branch| !branch.is_tangential && !branch.ends.contains(&End::Undecided);
    out.branches.iter().all(transversal)
        && out.contacts.is_empty()
        && out.overlaps.is_empty()
        && out.undecided.is_empty()
}
