"""All that two surfaces have in common, with proof: branches, contacts, overlaps, and what could not be decided."""

from __future__ import annotations

import ctypes
from dataclasses import dataclass
from enum import IntEnum
from typing import TYPE_CHECKING, Any, Callable

import numpy as np

from . import _library as lib
from ._query import Call, address, array, integer, real, vector
from ._shapes import Curve, Surface
from .trims import TrimmedSurface, _owner

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from numpy.typing import ArrayLike

    from ._query import IntersectSurfacesOptions, Listening

POINT = np.dtype([("point", "f8", 3), ("uv", "f8", 2), ("st", "f8", 2)])


class BranchEnd(IntEnum):
    """What an end of a branch is."""

    CLOSED = 0
    BORDER = 1
    CONTACT = 2
    UNDECIDED = 3
    TRIM = 4


class ContactKind(IntEnum):
    """What a contact is; see fpt_contact_kind."""

    TOUCHING = 0
    CROSSING = 1
    DEGENERATE = 2
    BORDER = 3
    TIP = 4


class IntersectMethod(IntEnum):
    """How `intersect_surfaces` finds an intersection: by the search that proves, or by a discrete method, of which nothing is proven."""

    AUTO = 0
    SUBDIVISION = 1
    MESH = 2


class Corrector(IntEnum):
    """How a place near two surfaces becomes one on both; see fpt_corrector."""

    AUTO = 0
    NEWTON_HOLDS_U = 1
    NEWTON_HOLDS_V = 2
    NEWTON_HOLDS_S = 3
    NEWTON_HOLDS_T = 4
    NEWTON_FOUR = 5
    MAF = 6


@dataclass(frozen=True)
class Branch:
    """A curve of the intersection.

    points         records of `POINT` in order; at a seam the same point comes twice, with the parameters of either side
    is_closed      its first point comes again as the last
    is_tangential  the surfaces touch along it
    ends           (kind, index) of both ends; index: the side 0 to 7 (u low, u high, v low, v high of A, then of B), the contact, or
                   0 for a trim of A, 1 for one of B
    gap            greatest distance between the two surface points of a point
    chord          proven: between two points the branch stays within this of their chord; infinite where nothing is proven
    bounds_overlap it bounds an area in which the surfaces coincide
    """

    points: np.ndarray
    is_closed: bool
    is_tangential: bool
    ends: tuple[tuple[BranchEnd, int], tuple[BranchEnd, int]]
    gap: float
    chord: float
    bounds_overlap: bool


@dataclass(frozen=True)
class Contact:
    """An isolated contact: a record of `POINT`, what it is, the gap, and within which radius it was not told apart further."""

    place: np.void
    kind: ContactKind
    gap: float
    radius: float


@dataclass(frozen=True)
class BranchCurves:
    """A branch, or its part between two seams, as curves with one parameter; `error` is proven."""

    space: Curve
    uv: Curve
    st: Curve
    error: float


class Intersection:
    """What `intersect_surfaces` or `intersect_trims` found.

    branches, contacts   lists
    overlaps, undecided  arrays (n, 8): ends of u, v of A, of u, v of B
    is_proven            nothing is missing and every branch is transversal
    is_exhausted         the budget ran out
    is_stopped           should_stop said so: what was not looked at is undecided, chords may be longer than asked
    pairs                pairs of parts judged
    """

    def __init__(self, handle: ctypes.c_void_p, a: Surface | TrimmedSurface, b: Surface | TrimmedSurface):
        self._handle, self._shapes = handle, (a, b)
        summary = lib.IntersectionSummary()
        lib.call("surface_intersection_summary", handle, ctypes.addressof(summary))
        self.is_proven, self.is_exhausted, self.pairs = bool(summary.is_proven), bool(summary.is_exhausted), int(summary.pairs)
        self.is_stopped = bool(summary.is_stopped)
        self.branches = [self._branch(k) for k in range(summary.branch_count)]
        self.contacts = [self._contact(k) for k in range(summary.contact_count)]
        self.overlaps = self._boxes("overlap", summary.overlap_count)
        self.undecided = self._boxes("undecided", summary.undecided_count)

    def __del__(self) -> None:
        free = lib.functions.get("surface_intersection_free") if lib.functions else None
        if free is not None and getattr(self, "_handle", None):
            free(self._handle)

    def _branch(self, index: int) -> Branch:
        record = lib.IntersectionBranch()
        lib.call("surface_intersection_branch", self._handle, index, ctypes.addressof(record))
        points = np.zeros(record.point_count, POINT)
        lib.call("surface_intersection_points", self._handle, index, len(points), address(points))
        first, last = ((BranchEnd(kind), int(at)) for kind, at in zip(record.end_kind, record.end_index))
        return Branch(points, bool(record.is_closed), bool(record.is_tangential), (first, last), record.gap, record.chord,
                      bool(record.bounds_overlap))

    def _contact(self, index: int) -> Contact:
        record = lib.IntersectionContact()
        lib.call("surface_intersection_contact", self._handle, index, ctypes.addressof(record))
        place = np.frombuffer(bytes(record.place), POINT)[0]
        return Contact(place, ContactKind(record.kind), record.gap, record.radius)

    def _boxes(self, name: str, count: int) -> np.ndarray:
        boxes = np.zeros((count, 8))
        for index in range(count):
            lib.call(f"surface_intersection_{name}", self._handle, index, address(boxes) + 64 * index)
        return boxes

    def curves(self, branch: int, tolerance: float, **listening: Unpack[Listening]) -> list[BranchCurves]:
        """A branch as cubic B-splines in space and in both domains (z = 0): one set for each part between two seams or corners. Of surfaces only.

        Smoother by energy: `footpoint.fair.curve(part.space, deviation)`; the deviation that it proves adds to `error`.

        tolerance  length, > 0: what the fit aims at
        listening  should_stop and progress; a stop ends the call with `Cancelled`, without curves
        """
        a, b = self._shapes
        if not (isinstance(a, Surface) and isinstance(b, Surface)):
            raise TypeError("curves: the branches are those of faces; ask for their surfaces, or split the faces")
        parts: list[BranchCurves] = []
        count, error = ctypes.c_size_t(1), ctypes.c_double()
        while len(parts) < count.value:
            out, call = (ctypes.c_void_p * 3)(), _listening(listening)
            call.finish(lib.call("surface_intersection_curves", self._handle, a._handle, b._handle, branch, real("tolerance", tolerance),
                                 len(parts), call.pointer, ctypes.byref(count), ctypes.addressof(out), ctypes.byref(error)))
            parts.append(BranchCurves(*(_owned(handle) for handle in out), error.value))
        return parts

    def split(self, which: int, tolerance: float, **listening: Unpack[Listening]) -> list[TrimmedSurface]:
        """The faces into which the branches cut the first (0) or the second (1) face. Of faces only.

        tolerance  length, > 0: within it ends of branches meet loops and one another
        listening  should_stop and progress; a stop ends the call with `Cancelled`, without faces
        """
        face = self._shapes[integer("which", which, most=1)]
        if not isinstance(face, TrimmedSurface):
            raise TypeError("split: the intersection is one of surfaces; make faces of them with TrimmedSurface.whole")
        room = 2 + sum(len(loop.coedges) for loop in face.loops) + 4 * sum(len(branch.points) for branch in self.branches)
        out, count, call = (ctypes.c_void_p * room)(), ctypes.c_size_t(), _listening(listening)
        call.finish(lib.call("surface_intersection_split", self._handle, face._handle, which, real("tolerance", tolerance), call.pointer,
                             room, ctypes.addressof(out), ctypes.byref(count)))
        return [_owner(TrimmedSurface, out[k]) for k in range(count.value)]

    def __repr__(self) -> str:
        state = ("proven" if self.is_proven else "not proven") + (", stopped" if self.is_stopped else "")
        left = f", {len(self.undecided)} boxes undecided" if len(self.undecided) else ""
        return f"Intersection({len(self.branches)} branches, {len(self.contacts)} contacts, {len(self.overlaps)} overlaps, {state}{left})"


def _owned(handle: Any) -> Curve:
    curve = Curve.__new__(Curve)
    curve._own(handle)
    return curve


def intersect_surfaces(a: Surface, b: Surface, **options: Unpack[IntersectSurfacesOptions]) -> Intersection:
    """All branches and points that two surfaces have in common, with proof that none is missing, or with what could not be decided.

    a, b     surfaces of knots and poles
    options  see `IntersectSurfacesOptions`
    """
    return _met("intersect_surfaces", Surface, a, b, dict(options))


def intersect_trims(a: TrimmedSurface, b: TrimmedSurface, **options: Unpack[IntersectSurfacesOptions]) -> Intersection:
    """All that two faces have in common: as `intersect_surfaces` of their supports, cut off at their trims. Supports may be elementary,
    parameters are theirs; with one given by a function nothing is proven.

    options  see `IntersectSurfacesOptions`
    """
    return _met("intersect_trims", TrimmedSurface, a, b, dict(options))


def _met(name: str, kind: type, a: Any, b: Any, options: dict[str, Any]) -> Intersection:
    for role, shape in (("a", a), ("b", b)):
        if not isinstance(shape, kind):
            raise TypeError(f"{role}: a {kind.__name__} is needed, not {type(shape).__name__}")
    call = Call(options, struct_type=lib.IntersectSurfacesOptions)
    out = ctypes.c_void_p()
    status = lib.call(name, a._handle, b._handle, call.pointer, ctypes.byref(out))
    return _finished(call, status, out, a, b)


def _finished(call: Call, status: int, out: ctypes.c_void_p, a: Any, b: Any) -> Intersection:
    found = Intersection(out, a, b) if out.value else None
    call.finish(status, found=found)
    if found is None:
        raise lib.failure(status)
    return found


def _listening(options: dict[str, Any]) -> Call:
    for name in options:
        if name not in ("should_stop", "progress"):
            raise TypeError(f"'{name}' is not an option; there are should_stop, progress")
    return Call(dict(options), struct_type=lib.IntersectSurfacesOptions)


@dataclass(frozen=True)
class Corrected:
    """A place on two surfaces (a record of `POINT`), the distance of its two surface points, and the steps that it took."""

    place: np.void
    gap: float
    steps: int


def intersect_correct(a: Surface, b: Surface, uvst: ArrayLike, *, corrector: int = Corrector.AUTO, tolerance: float = 0,
                      trace: Callable[[int, np.ndarray, float], object] | None = None) -> Corrected:
    """A place near two surfaces moved onto both by one corrector alone, without proof. RuntimeError when it does not get there.

    a, b       surfaces, also given by functions
    uvst       u, v of A, u, v of B
    corrector  a `Corrector`
    tolerance  length: distance of the two surface points at which it ends; 0: 1e-12 x the size of the smaller surface
    trace      called with each step, its u, v, u, v, and the distance; step 0 is the start
    """
    _both(a, b)
    start, call = vector("uvst", uvst, 4), Call({"corrector": corrector, "tolerance": tolerance}, struct_type=lib.IntersectSurfacesOptions)
    point, gap, steps = lib.IntersectionPoint(), ctypes.c_double(), ctypes.c_uint32()
    if trace is not None:

        def told(_user: int, step: int, at: Any, apart: float) -> None:
            try:
                if call._heard.error is None:
                    trace(step, np.array(at[:4]), apart)
            except BaseException as error:  # raised after the call
                call._heard.error = error

        call.struct.trace = lib.CorrectionFunction(told)
    status = lib.call("intersect_correct", a._handle, b._handle, address(start), call.pointer, ctypes.addressof(point), ctypes.byref(gap),
                      ctypes.byref(steps))
    call.finish(status)
    if status != lib.OK:
        raise lib.failure(status)
    return Corrected(np.frombuffer(bytes(point), POINT)[0], gap.value, steps.value)


def intersect_march(a: Surface, b: Surface, uvst: ArrayLike, step: float = 0, **options: Unpack[IntersectSurfacesOptions]) -> Intersection:
    """The branch through a place near two surfaces, walked both ways by marching alone, without proof; it ends at seams. RuntimeError when the
    place leads to none.

    uvst     u, v of A, u, v of B
    step     length: the first step; 0: a 256th of the size of the smaller surface
    options  chord, corrector, should_stop, progress: see `IntersectSurfacesOptions`
    """
    _both(a, b)
    start, call, out = vector("uvst", uvst, 4), Call(dict(options), struct_type=lib.IntersectSurfacesOptions), ctypes.c_void_p()
    status = lib.call("intersect_march", a._handle, b._handle, address(start), real("step", step), call.pointer, ctypes.byref(out))
    return _finished(call, status, out, a, b)


def intersect_bisect(a: Surface, b: Surface, uvst: ArrayLike, **options: Unpack[IntersectSurfacesOptions]) -> Intersection:
    """The branch through given places in order, with as many between them as the chord tolerance asks for, by bisection alone, without proof.
    RuntimeError when a midpoint cannot be corrected, or lands elsewhere than between its two places.

    uvst     shape (n, 4): u, v of A, u, v of B
    options  chord, corrector, should_stop, progress: see `IntersectSurfacesOptions`
    """
    _both(a, b)
    places = np.ascontiguousarray(array("uvst", uvst))
    if places.ndim != 2 or places.shape[1] != 4:
        raise ValueError(f"uvst: the shape is {places.shape}, and must be (n, 4)")
    call, out = Call(dict(options), struct_type=lib.IntersectSurfacesOptions), ctypes.c_void_p()
    status = lib.call("intersect_bisect", a._handle, b._handle, address(places), len(places), call.pointer, ctypes.byref(out))
    return _finished(call, status, out, a, b)


def _both(a: Any, b: Any) -> None:
    for role, shape in (("a", a), ("b", b)):
        if not isinstance(shape, Surface):
            raise TypeError(f"{role}: a Surface is needed, not {type(shape).__name__}")
