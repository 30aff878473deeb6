"""All that two surfaces have in common, with proof: branches, contacts, overlaps, and what could not be decided."""

from __future__ import annotations

import ctypes
from dataclasses import dataclass
from enum import IntEnum
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _library as lib
from ._query import Call, address, real
from ._shapes import Curve, Surface

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ._query import IntersectSurfacesOptions

POINT = np.dtype([("point", "f8", 3), ("uv", "f8", 2), ("st", "f8", 2)])


class BranchEnd(IntEnum):
    """What an end of a branch is."""

    CLOSED = 0
    BORDER = 1
    CONTACT = 2
    UNDECIDED = 3


class ContactKind(IntEnum):
    """What a contact is; see fpt_contact_kind."""

    TOUCHING = 0
    CROSSING = 1
    DEGENERATE = 2
    BORDER = 3
    TIP = 4


@dataclass(frozen=True)
class Branch:
    """A curve of the intersection.

    points         records of `POINT` in order; at a seam the same point comes twice, with the parameters of either side
    is_closed      its first point comes again as the last
    is_tangential  the surfaces touch along it
    ends           (kind, index) of both ends; index: the side 0 to 7 (u low, u high, v low, v high of A, then of B), or the contact
    gap            greatest distance between the two surface points of a point
    """

    points: np.ndarray
    is_closed: bool
    is_tangential: bool
    ends: tuple[tuple[BranchEnd, int], tuple[BranchEnd, int]]
    gap: float


@dataclass(frozen=True)
class Contact:
    """An isolated contact: a record of `POINT`, what it is, the gap, and within which radius it was not told apart further."""

    place: np.void
    kind: ContactKind
    gap: float
    radius: float


@dataclass(frozen=True)
class BranchCurves:
    """A branch, or its part between two seams, as curves with one parameter; `error` was measured at 16 places a span."""

    space: Curve
    uv: Curve
    st: Curve
    error: float


class Intersection:
    """What `intersect_surfaces` found.

    branches, contacts   lists
    overlaps, undecided  arrays (n, 8): ends of u, v of A, of u, v of B
    is_proven            nothing is missing and every branch is transversal
    is_exhausted         the budget ran out
    pairs                pairs of parts judged
    """

    def __init__(self, handle: ctypes.c_void_p, a: Surface, b: Surface):
        self._handle, self._surfaces = handle, (a, b)
        summary = lib.IntersectionSummary()
        lib.call("surface_intersection_summary", handle, ctypes.addressof(summary))
        self.is_proven, self.is_exhausted, self.pairs = bool(summary.is_proven), bool(summary.is_exhausted), int(summary.pairs)
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
        return Branch(points, bool(record.is_closed), bool(record.is_tangential), (first, last), record.gap)

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

    def curves(self, branch: int, tolerance: float) -> list[BranchCurves]:
        """A branch as cubic B-splines in space and in both domains (z = 0): one set for each part between two seams.

        tolerance  length, > 0: what the fit aims at
        """
        a, b = self._surfaces
        parts: list[BranchCurves] = []
        count, error = ctypes.c_size_t(1), ctypes.c_double()
        while len(parts) < count.value:
            out = (ctypes.c_void_p * 3)()
            lib.call("surface_intersection_curves", self._handle, a._handle, b._handle, branch, real("tolerance", tolerance), len(parts),
                     ctypes.byref(count), ctypes.addressof(out), ctypes.byref(error))
            parts.append(BranchCurves(*(_owned(handle) for handle in out), error.value))
        return parts

    def __repr__(self) -> str:
        state = "proven" if self.is_proven else "not proven"
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
    for name, surface in (("a", a), ("b", b)):
        if not isinstance(surface, Surface):
            raise TypeError(f"{name}: a Surface is needed, not {type(surface).__name__}")
    call = Call(dict(options), struct_type=lib.IntersectSurfacesOptions)
    out = ctypes.c_void_p()
    status = lib.call("intersect_surfaces", a._handle, b._handle, call.pointer, ctypes.byref(out))
    found = Intersection(out, a, b) if out.value else None
    call.finish(status)
    assert found is not None
    return found
