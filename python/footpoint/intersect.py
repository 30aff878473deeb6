"""Intersections of curves, surfaces, planes, quadrics and rays: all of them, with proof.

`curves`, `surface_curve` and `curve_quadric` give hits; `sections` gives the branches of a surface in planes or quadrics; `conics`
gives conics in closed form; a `Caster` takes millions of rays. What could not be decided is listed, never left out.

>>> import footpoint
>>> from footpoint import intersect
>>> bow = footpoint.Curve.from_poles(2, [[0, 0], [1, 2], [2, 0]])
>>> line = footpoint.Curve.from_poles(1, [[0, 0.5], [2, 0.5]])
>>> intersect.curves(bow, line).hits["w"].round(6).tolist()
[0.146447, 0.853553]
"""

from __future__ import annotations

import ctypes
from dataclasses import dataclass
from enum import IntEnum, IntFlag
from typing import TYPE_CHECKING, Any, Callable, Iterable, Sequence

import numpy as np

from . import _library as lib
from ._query import address, array, integer, real, vector
from ._shapes import Curve, Surface

if TYPE_CHECKING:
    from numpy.typing import ArrayLike


class HitNature(IntEnum):
    """How two shapes meet."""

    TRANSVERSAL, TANGENTIAL, OVERLAP = range(3)


class End(IntEnum):
    """What an end of a branch is."""

    CLOSED, BORDER, SINGULAR, COLLAPSED, UNDECIDED = range(5)


class RayFlag(IntFlag):
    """Bits of a ray's hit."""

    TANGENTIAL, EDGE, OVERLAP, NOT_PROVEN, BAD_RAY = 1, 2, 4, 8, 16


class QuadricKind(IntEnum):
    """What a `Quadric` is."""

    PLANE, SPHERE, CYLINDER, CONE, GENERAL = range(5)


class ConicKind(IntEnum):
    """What a conic is: see `conics`."""

    LINE, ELLIPSE, HYPERBOLA, PARABOLA, POINT = range(5)


HIT = np.dtype([("u", "f8"), ("v", "f8"), ("w", "f8"), ("point", "f8", 3), ("distance", "f8"), ("u_range", "f8", 2), ("v_range", "f8", 2),
                ("w_range", "f8", 2), ("nature", "u4"), ("multiplicity", "u4")])
RAY_HIT = np.dtype([("t", "f8"), ("u", "f8"), ("v", "f8"), ("point", "f8", 3), ("flags", "u4"), ("count", "u4")])
SECTION_POINT = np.dtype([("u", "f8"), ("v", "f8"), ("point", "f8", 3), ("distance", "f8"), ("arms", "u4"), ("reserved", "u4")])
CONIC = np.dtype([("kind", "u4"), ("reserved", "u4"), ("center", "f8", 3), ("axes", "f8", (2, 3)), ("lengths", "f8", 2)])


@dataclass(frozen=True)
class Quadric:
    """A plane or quadric in implicit form; make it with one of the class methods."""

    kind: QuadricKind
    origin: tuple
    axis: tuple = (0.0, 0.0, 0.0)
    size: float = 0.0
    matrix: tuple = (0.0,) * 6
    linear: tuple = (0.0, 0.0, 0.0)
    constant: float = 0.0

    @classmethod
    def plane(cls, origin: ArrayLike, normal: ArrayLike) -> "Quadric":
        """The plane through a point with a normal of any length."""
        return cls(QuadricKind.PLANE, _three("origin", origin), _three("normal", normal))

    @classmethod
    def sphere(cls, center: ArrayLike, radius: float) -> "Quadric":
        """The sphere about a point."""
        return cls(QuadricKind.SPHERE, _three("center", center), size=real("radius", radius))

    @classmethod
    def cylinder(cls, origin: ArrayLike, axis: ArrayLike, radius: float) -> "Quadric":
        """The infinite cylinder about an axis."""
        return cls(QuadricKind.CYLINDER, _three("origin", origin), _three("axis", axis), real("radius", radius))

    @classmethod
    def cone(cls, apex: ArrayLike, axis: ArrayLike, slope: float) -> "Quadric":
        """The infinite double cone; slope: radius per unit of height."""
        return cls(QuadricKind.CONE, _three("apex", apex), _three("axis", axis), real("slope", slope))

    @classmethod
    def general(cls, origin: ArrayLike, matrix: ArrayLike, linear: ArrayLike, constant: float) -> "Quadric":
        """y.A y + 2 b.y + c = 0 with y = x - origin; the matrix A as 3 x 3, symmetric."""
        a = array("matrix", matrix, (3, 3))
        entries = tuple(float(a[i, j]) for i, j in ((0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)))
        return cls(QuadricKind.GENERAL, _three("origin", origin), matrix=entries, linear=_three("linear", linear), constant=real("constant", constant))


def _three(name: str, values: Any) -> tuple:
    return tuple(vector(name, values).tolist())


def _quadrics(quadrics: Sequence[Quadric]) -> Any:
    data = (lib.Quadric * max(len(quadrics), 1))()
    for entry, q in zip(data, quadrics):
        if not isinstance(q, Quadric):
            raise TypeError(f"quadrics: a Quadric is needed, not {type(q).__name__}")
        entry.kind, entry.size, entry.constant = int(q.kind), q.size, q.constant
        entry.origin[:], entry.axis[:], entry.matrix[:], entry.linear[:] = q.origin, q.axis, q.matrix, q.linear
    return data


def _options(tolerance: float, chord: float, budget: int, threads: int, should_stop: Callable[[], object] | None,
             progress: Callable[[int, int], object] | None) -> Any:
    options = lib.HitOptions()
    lib.functions["hit_options_init"](ctypes.addressof(options), ctypes.sizeof(options))
    options.tolerance, options.chord = real("tolerance", tolerance), real("chord", chord)
    options.budget, options.threads = integer("budget", budget, most=2**64 - 1), integer("threads", threads)
    if should_stop is not None:
        options.should_stop = lib.StopFunction(lambda _user: int(bool(should_stop())))
    if progress is not None:
        options.progress = lib.ProgressFunction(lambda _user, done, total: progress(done, total) and None)
    return options


def _shape(name: str, shape: Any, kind: type) -> int:
    if not isinstance(shape, kind):
        raise TypeError(f"{name}: a {kind.__name__} is needed, not {type(shape).__name__}")
    return shape._handle


def _kept(status: int, found: Any = None) -> Any:
    """What was found; after a stop it is in the `Cancelled` that is raised."""
    if status == lib.CANCELLED:
        cancelled = lib.failure(status)
        cancelled.found = found  # type: ignore[attr-defined]
        raise cancelled
    return found


@dataclass(frozen=True)
class Hits:
    """hits: records (`HIT`: u, v, w, point, distance, intervals, nature, multiplicity); undecided: boxes u0, u1, v0, v1, w0, w1."""

    hits: np.ndarray
    undecided: np.ndarray

    @property
    def is_complete(self) -> bool:
        """Whether nothing is missing."""
        return len(self.undecided) == 0


def _hits(name: str, first: int, second: Any, options: Any) -> Hits:
    out, count = ctypes.c_void_p(), ctypes.c_size_t()
    status = lib.call(name, first, second, ctypes.addressof(options), ctypes.byref(out))
    try:
        lib.call("curve_hits_count", out, ctypes.byref(count))
        hits = np.zeros(count.value, HIT)
        for k in range(len(hits)):
            lib.call("curve_hits_get", out, k, address(hits[k:]))
        lib.call("curve_hits_undecided_count", out, ctypes.byref(count))
        undecided = np.zeros((count.value, 6))
        for k in range(len(undecided)):
            lib.call("curve_hits_undecided_get", out, k, address(undecided[k:]))
    finally:
        lib.functions["curve_hits_free"](out)
    return _kept(status, Hits(hits, undecided))


def curves(first: Curve, second: Curve, *, tolerance: float = 0, budget: int = 0, should_stop: Callable[[], object] | None = None) -> Hits:
    """Where two curves meet: crossings, contacts, overlaps. u is the parameter of the first, w that of the second.

    tolerance  length: places farther apart do not meet; 0: 1e-7 x the diagonal of the larger box
    """
    options = _options(tolerance, 0, budget, 0, should_stop, None)
    return _hits("intersect_curves", _shape("first", first, Curve), _shape("second", second, Curve), options)


def surface_curve(surface: Surface, curve: Curve, *, tolerance: float = 0, budget: int = 0, should_stop: Callable[[], object] | None = None) -> Hits:
    """Where a surface (u, v) and a curve (w) meet: as `curves`."""
    options = _options(tolerance, 0, budget, 0, should_stop, None)
    return _hits("intersect_surface_curve", _shape("surface", surface, Surface), _shape("curve", curve, Curve), options)


def curve_quadric(curve: Curve, quadric: Quadric, *, tolerance: float = 0, budget: int = 0, should_stop: Callable[[], object] | None = None) -> Hits:
    """Where a curve (w) meets a plane or a quadric: as `curves`."""
    data, options = _quadrics([quadric]), _options(tolerance, 0, budget, 0, should_stop, None)
    return _hits("intersect_curve_quadric", _shape("curve", curve, Curve), ctypes.addressof(data), options)


@dataclass(frozen=True)
class Branch:
    """points: shape (n, 3); parameters: shape (n, 2); ends: two `End`; tangential: whether the surfaces touch all along it."""

    points: np.ndarray
    parameters: np.ndarray
    ends: tuple
    tangential: bool

    @property
    def is_closed(self) -> bool:
        """Whether it is a loop."""
        return self.ends[0] == End.CLOSED


@dataclass(frozen=True)
class Section:
    """branches; points: records (`SECTION_POINT`), contacts with 0 arms, then where branches meet; overlaps and undecided: u0, u1, v0, v1."""

    branches: list
    points: np.ndarray
    overlaps: np.ndarray
    undecided: np.ndarray

    @property
    def is_complete(self) -> bool:
        """Whether nothing is missing."""
        return len(self.undecided) == 0


def sections(surface: Surface, quadrics: Iterable[Quadric], *, tolerance: float = 0, chord: float = 0, budget: int = 0, threads: int = 0,
             should_stop: Callable[[], object] | None = None, progress: Callable[[int, int], object] | None = None) -> list:
    """The sections of a surface by planes or quadrics, one `Section` each.

    chord  length: most distance of a branch from its polyline; 0: 1e-4 x the diagonal of the box
    """
    given = list(quadrics)
    data, options = _quadrics(given), _options(tolerance, chord, budget, threads, should_stop, progress)
    out = ctypes.c_void_p()
    status = lib.call("intersect_surface_quadrics", _shape("surface", surface, Surface), ctypes.addressof(data), len(given),
                      ctypes.addressof(options), ctypes.byref(out))
    try:
        found = [_section(out, k) for k in range(len(given))]
    finally:
        lib.functions["sections_free"](out)
    return _kept(status, found)


def _section(sections: Any, number: int) -> Section:
    counts = np.zeros(3, np.uintp)
    lib.call("sections_counts", sections, number, address(counts))
    branches = []
    for k in range(int(counts[0])):
        head = lib.Branch()
        lib.call("sections_branch_get", sections, number, k, ctypes.addressof(head))
        rows = np.zeros((head.point_count, 5))
        lib.call("sections_branch_points", sections, number, k, rows.size, address(rows))
        branches.append(Branch(rows[:, :3], rows[:, 3:], tuple(End(e) for e in head.ends), bool(head.tangential)))
    points = np.zeros(int(counts[1]), SECTION_POINT)
    for k in range(len(points)):
        lib.call("sections_point_get", sections, number, k, address(points[k:]))
    regions: tuple[list, list] = ([], [])
    for k in range(int(counts[2])):
        region = lib.SectionRegion()
        lib.call("sections_region_get", sections, number, k, ctypes.addressof(region))
        regions[region.overlaps].append(list(region.domain))
    undecided, overlaps = (np.array(boxes, np.float64).reshape(-1, 4) for boxes in regions)
    return Section(branches, points, overlaps, undecided)


def conics(first: Quadric, second: Quadric, tolerance: float) -> np.ndarray:
    """Where two planes or quadrics meet, as records (`CONIC`: kind, center, axes, lengths) in closed form; none: they do not meet.

    NotImplementedError when they are the same or meet in a curve that is not made of conics.

    >>> from footpoint.intersect import Quadric, conics
    >>> conics(Quadric.sphere([0, 0, 0], 1), Quadric.plane([0, 0, 0.6], [0, 0, 1]), 1e-9)["lengths"].round(12).tolist()
    [[0.8, 0.8]]
    """
    a, b, out, count = _quadrics([first]), _quadrics([second]), np.zeros(4, CONIC), ctypes.c_size_t()
    lib.call("intersect_quadrics", ctypes.addressof(a), ctypes.addressof(b), real("tolerance", tolerance), address(out), ctypes.byref(count))
    return out[: count.value]


class Caster:
    """A surface prepared for rays. Immutable; threads may share it. Not for use across a fork: make one in each process.

    >>> import footpoint
    >>> from footpoint.intersect import Caster
    >>> square = footpoint.Surface.from_poles(1, 1, [[[0, 0, 0], [0, 2, 0]], [[2, 0, 0], [2, 2, 0]]])
    >>> Caster(square).first([[1, 1, 5], [5, 5, 5]], [0, 0, -1])["t"].tolist()
    [5.0, inf]
    """

    def __init__(self, surface: Surface, should_stop: Callable[[], object] | None = None):
        options, out = _options(0, 0, 0, 0, should_stop, None), ctypes.c_void_p()
        _kept(lib.call("caster_new", _shape("surface", surface, Surface), ctypes.addressof(options), ctypes.byref(out)))
        self._pointer = out.value

    def __del__(self, functions: dict = lib.functions) -> None:
        if getattr(self, "_pointer", None) is not None:
            functions["caster_free"](self._pointer)

    def _rays(self, origins: ArrayLike, directions: ArrayLike, reach: ArrayLike | None) -> tuple:
        o, d = array("origins", origins), array("directions", directions)
        if o.ndim not in (1, 2) or o.shape[-1] != 3 or d.ndim not in (1, 2) or d.shape[-1] != 3:
            raise ValueError(f"origins: the shapes are {o.shape} and {d.shape}; each must be (n, 3) or (3,)")
        o, d = (np.ascontiguousarray(x) for x in np.broadcast_arrays(np.atleast_2d(o), np.atleast_2d(d)))
        return o, d, None if reach is None else vector("reach", reach, 2)

    def first(self, origins: ArrayLike, directions: ArrayLike, reach: ArrayLike | None = None, *, alone: bool = False, threads: int = 0,
              should_stop: Callable[[], object] | None = None, progress: Callable[[int, int], object] | None = None) -> np.ndarray:
        """The first hit of each ray, as records (`RAY_HIT`); count is the number of all hits of the ray.

        reach  least and greatest length along each ray that counts; None: from the origin on
        alone  what lies behind the first hit is not looked at, and count is 1, or 0 for none: less work
        """
        o, d, ends = self._rays(origins, directions, reach)
        out, options = np.zeros(len(o), RAY_HIT), _options(0, 0, 0, threads, should_stop, progress)
        name = "caster_nearest" if alone else "caster_first"
        return _kept(lib.call(name, self._pointer, address(o), address(d), len(o), address(ends), ctypes.addressof(options), address(out)), out)

    def all(self, origins: ArrayLike, directions: ArrayLike, reach: ArrayLike | None = None, *, threads: int = 0,
            should_stop: Callable[[], object] | None = None, progress: Callable[[int, int], object] | None = None) -> tuple:
        """All hits of each ray: records (`RAY_HIT`), where those of each ray begin (one more than rays), and flags of each ray."""
        o, d, ends = self._rays(origins, directions, reach)
        out, count, options = ctypes.c_void_p(), ctypes.c_size_t(), _options(0, 0, 0, threads, should_stop, progress)
        status = lib.call("caster_all", self._pointer, address(o), address(d), len(o), address(ends), ctypes.addressof(options), ctypes.byref(out))
        try:
            lib.call("ray_hits_count", out, ctypes.byref(count))
            hits, starts, flags = np.zeros(count.value, RAY_HIT), np.zeros(len(o) + 1, np.uintp), np.zeros(len(o), np.uint32)
            lib.call("ray_hits_get", out, len(hits), address(hits))
            lib.call("ray_hits_starts", out, len(starts), address(starts))
            lib.call("ray_hits_flags", out, len(flags), address(flags))
        finally:
            lib.functions["ray_hits_free"](out)
        return _kept(status, (hits, starts.astype(np.int64), flags))
