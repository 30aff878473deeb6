"""Trimmed surfaces and changes of their parameters.

A face is a `Support` (a surface: spline, function, or elementary by its geometric parameters), loops of curves in its domain, and
edges in space. Outer loops run counter-clockwise, inner ones clockwise. Nothing changes: each method gives a new face.

>>> import math
>>> import footpoint.trims as trims
>>> sphere = trims.Support.elementary("sphere", [0, 2 * math.pi, -math.pi / 2, math.pi / 2], first=2)
>>> face = trims.TrimmedSurface.whole(sphere)
>>> nurbs = face.to_nurbs((0, 2))
>>> nurbs.face.report().findings, nurbs.deviation, nurbs.proven
([], 0.0, True)
"""

from __future__ import annotations

import ctypes
from dataclasses import dataclass, field
from enum import IntEnum, IntFlag
from typing import Any, Callable, NamedTuple, Sequence

import numpy as np

from . import _library as lib
from ._feet import Feet
from ._handle import Handle
from ._query import address, array, integer, real, vector
from ._shapes import Curve, Surface

__all__ = ["Change", "Coedge", "CoedgeFlag", "Edge", "ElementaryKind", "Finding", "FindingKind", "Loop", "PcurveKind", "Relation",
           "Replacement", "Report", "Support", "Transform", "TrimmedSurface", "arc_by_angle", "from_freecad", "picture"]

NO_EDGE = ctypes.c_size_t(-1).value


class ElementaryKind(IntEnum):
    """Elementary surfaces; angles in radians."""

    PLANE = 0
    CYLINDER = 1
    CONE = 2
    SPHERE = 3
    TORUS = 4
    REVOLUTION = 5
    EXTRUSION = 6


class PcurveKind(IntEnum):
    """Curves in the domain."""

    ISOLINE = 0
    POLYLINE = 1
    SPLINE = 2
    ARC = 3


class CoedgeFlag(IntFlag):
    """The coedge runs against its edge; equal shares of pcurve and edge belong together."""

    REVERSED = 1
    SAME_PARAMETER = 2


class Replacement(IntEnum):
    """What becomes of splines and arcs under changes that are not linear; with VERTICES polylines stand for their vertices alone."""

    POLYLINE = 0
    SPLINE = 1
    VERTICES = 2


class FindingKind(IntEnum):
    """What can be wrong with a face; see fpt_finding_kind in footpoint.h for the numbers of each."""

    OPEN = 0
    DIRECTION = 1
    NO_DIRECTION = 2
    CROSSING = 3
    TOUCHING = 4
    EDGE_GAP = 5
    OUTSIDE = 6
    CONTAINMENT = 7
    SENSE = 8
    FAILING = 9
    UNDECIDED = 10


def _made(name: str, *arguments: Any) -> int:
    out = ctypes.c_void_p()
    lib.call(name, *arguments, ctypes.byref(out))
    assert out.value is not None
    return out.value


def _owner(cls: Any, pointer: int) -> Any:
    made = cls.__new__(cls)
    made._own(pointer)
    made._indexed = True
    return made


def _arcs(arcs: Sequence[int] | None) -> Any:
    return None if arcs is None else (ctypes.c_uint32 * 2)(*(integer(f"arcs: entry {k}", n) for k, n in enumerate(arcs)))


def _places(name: str, uv: Any) -> np.ndarray:
    places = array(name, uv)
    if places.ndim == 0 or places.shape[-1] != 2:
        raise ValueError(f"{name}: the shape is {places.shape} and must be (..., 2)")
    return places


class _Owner(Handle):
    """Handles without a search index of their own: a process that was forked uses them as they are."""

    def _renew(self) -> None:
        self._keep()

    def _child(self, name: str, *arguments: Any) -> int:
        return _made(f"{self._kind}_{name}", self._handle, *arguments)


class Relation(_Owner):
    """A monotone function of one parameter with its inverse."""

    _kind = "relation"

    @classmethod
    def linear(cls, first: Any, last: Any) -> "Relation":
        """The linear function from the interval `first` to `last`; falling when `last` falls."""
        start, end = vector("first", first, 2), vector("last", last, 2)
        return _owner(cls, _made("relation_linear", address(start), address(end)))

    @classmethod
    def circle(cls, arcs: int, sweep: float, first: Any = (0, 1), last: Any = (0, 1)) -> "Relation":
        """From the parameter of a circular arc to its angle; arcs 0: half turns of 4 poles, n: n equal arcs; sweep in radians."""
        start, end = vector("first", first, 2), vector("last", last, 2)
        return _owner(cls, _made("relation_circle", integer("arcs", arcs), real("sweep", sweep), address(start), address(end)))

    @classmethod
    def through(cls, places: Any, values: Any) -> "Relation":
        """The piecewise linear function through values at increasing places."""
        places = array("places", places, (None,))
        values = array("values", values, (len(places),))
        return _owner(cls, _made("relation_through", address(places), address(values), len(places)))

    @classmethod
    def piecewise(cls, pieces: Sequence["Relation"]) -> "Relation":
        """Functions one after the other along the domain."""
        handles = (ctypes.c_void_p * len(pieces))(*(piece._handle for piece in pieces))
        return _owner(cls, _made("relation_piecewise", handles, len(pieces)))

    @classmethod
    def function(cls, forward: Callable[[float], float], backward: Callable[[float], float], domain: Any) -> "Relation":
        """A Python function with its inverse. An exception in it is a value that is no number."""

        def guarded(function: Callable[[float], float]) -> Any:
            def call(_user: Any, x: float) -> float:
                try:
                    return float(function(x))
                except Exception:
                    return float("nan")
            return lib.RelationFunction(call)

        data = lib.RelationCallback(forward=guarded(forward), backward=guarded(backward))
        data.struct_size = ctypes.sizeof(data)
        data.domain[:] = vector("domain", domain, 2).tolist()
        made = _owner(cls, _made("relation_from_callback", ctypes.addressof(data)))
        # Transforms and faces made of it call the functions after it is gone: they stay as long as the process.
        _KEPT.append(data)
        return made

    def inverse(self) -> "Relation":
        """The inverse function."""
        return _owner(type(self), self._child("inverse"))

    def then(self, following: "Relation") -> "Relation":
        """This function and then another one."""
        return _owner(type(self), self._child("then", following._handle))

    @property
    def domain(self) -> np.ndarray:
        """First and last place, shape (2,)."""
        return self._ends()[0]

    @property
    def values_at_ends(self) -> np.ndarray:
        """The values there, shape (2,)."""
        return self._ends()[1]

    def _ends(self) -> tuple[np.ndarray, np.ndarray]:
        first, last = np.empty(2), np.empty(2)
        self._call("domain", address(first), address(last))
        return first, last

    def __call__(self, places: Any) -> Any:
        places = array("places", places)
        out = np.empty(places.shape)
        self._call("apply", address(places), places.size, address(out))
        return out if out.ndim else float(out)


_KEPT: list[Any] = []


class Transform(_Owner):
    """The change (u, v) -> (f(u), g(v)), or (g(v), f(u)) with `swap`."""

    _kind = "transform"

    def __init__(self, u: Relation, v: Relation, swap: bool = False):
        self._own(_made("transform_new", u._handle, v._handle, int(bool(swap))))
        self._indexed = True

    def inverse(self) -> "Transform":
        """The inverse change."""
        return _owner(type(self), self._child("inverse"))

    def then(self, following: "Transform") -> "Transform":
        """This change and then another one."""
        return _owner(type(self), self._child("then", following._handle))

    def _bounds(self) -> tuple[np.ndarray, np.ndarray, bool]:
        domain, image, keeps = np.empty(4), np.empty(4), ctypes.c_int32()
        self._call("domain", address(domain), address(image), ctypes.byref(keeps))
        return domain, image, bool(keeps.value)

    @property
    def domain(self) -> np.ndarray:
        """u0, u1, v0, v1."""
        return self._bounds()[0]

    @property
    def image(self) -> np.ndarray:
        """The same of the image."""
        return self._bounds()[1]

    @property
    def keeps_direction(self) -> bool:
        """Whether loops keep their direction."""
        return self._bounds()[2]

    def __call__(self, uv: Any) -> np.ndarray:
        places = _places("uv", uv)
        out = np.empty(places.shape)
        self._call("apply", address(places), places.size // 2, address(out))
        return out


class Support(_Owner):
    """The surface under a face."""

    _kind = "support"

    def __init__(self, surface: Surface):
        self._surface = surface
        self._own(_made("support_new", surface._handle))
        self._indexed = True

    @classmethod
    def elementary(cls, kind: str | int, domain: Any, *, origin: Any = (0, 0, 0), x: Any = (1, 0, 0), y: Any = (0, 1, 0), z: Any = (0, 0, 1),
                   first: float = 0.0, second: float = 0.0, curve: Curve | None = None) -> "Support":
        """An elementary surface on a rectangle of its parameters.

        kind    an `ElementaryKind` or its name
        domain  u0, u1, v0, v1; angles in radians
        first   radius; of a torus the major one
        second  half angle of a cone, minor radius of a torus
        curve   meridian of a revolution, curve of an extrusion (along z)
        """
        number = ElementaryKind[kind.upper()] if isinstance(kind, str) else kind
        data = lib.ElementaryData(kind=integer("kind", number), first=real("first", first), second=real("second", second))
        data.struct_size = ctypes.sizeof(data)
        data.domain[:] = vector("domain", domain, 4).tolist()
        for name, value in (("origin", origin), ("x", x), ("y", y), ("z", z)):
            getattr(data, name)[:] = vector(name, value).tolist()
        data.curve = None if curve is None else curve._handle
        return _owner(cls, _made("support_elementary", ctypes.addressof(data)))

    @property
    def domain(self) -> np.ndarray:
        """u0, u1, v0, v1."""
        return self._get("domain", 4)

    def evaluate(self, uv: Any) -> np.ndarray:
        """Points at places, shape (..., 2) -> (..., 3)."""
        places = _places("uv", uv)
        out = np.empty((*places.shape[:-1], 3))
        self._call("evaluate", address(places), places.size // 2, address(out))
        return out

    def spline(self, arcs: Sequence[int] | None = None) -> Surface:
        """The NURBS form; arcs: circle forms of u and v as in `Relation.circle`, None: arcs of at most a quarter turn."""
        made = Surface.__new__(Surface)
        made._own(self._child("spline", _arcs(arcs)))
        return made

    def spline_transform(self, arcs: Sequence[int] | None = None) -> Transform:
        """From the parameters of an elementary surface to those of its NURBS form."""
        return _owner(Transform, self._child("spline_transform", _arcs(arcs)))

    def match(self, to: "Support", tolerance: float = 0.0) -> Transform:
        """The transform to another parametrisation of the same surface, found by proven inversions."""
        return _owner(Transform, _made("support_match", self._handle, to._handle, real("tolerance", tolerance)))

    def match_many(self, to: "Support", uv: Any, tolerance: float = 0.0, threads: int = 0) -> Feet:
        """The images of places on another parametrisation, shape (..., 2)."""
        places = _places("uv", uv)
        feet = Feet(places.size // 2)
        lib.call("support_match_many", self._handle, to._handle, real("tolerance", tolerance), address(places), places.size // 2,
                 integer("threads", threads), address(feet))
        return feet.reshape(places.shape[:-1])


@dataclass(eq=False)
class Coedge:
    """A curve of a loop. Made by its class methods.

    edge            number of its edge, None: known as the image of the pcurve only
    reversed        whether it runs against its edge
    same_parameter  whether equal shares of pcurve and edge (mirrored when reversed) belong together
    """

    kind: PcurveKind
    values: Sequence[float] = ()
    points: Any = None
    parameters: Any = None
    curve: Curve | None = None
    edge: int | None = None
    reversed: bool = False
    same_parameter: bool = False
    domain: tuple[float, float] = (0.0, 0.0)

    @classmethod
    def isoline(cls, fixed: str, at: float, start: float, end: float, **more: Any) -> "Coedge":
        """`fixed` ("u" or "v") at a value, the other parameter from `start` to `end`."""
        return cls(PcurveKind.ISOLINE, [{"u": 0.0, "v": 1.0}[fixed], at, start, end], **more)

    @classmethod
    def polyline(cls, points: Any, parameters: Any = None, **more: Any) -> "Coedge":
        """Points (n, 2) joined by lines."""
        return cls(PcurveKind.POLYLINE, points=points, parameters=parameters, **more)

    @classmethod
    def spline(cls, curve: Curve, **more: Any) -> "Coedge":
        """A spline with z = 0."""
        return cls(PcurveKind.SPLINE, curve=curve, **more)

    @classmethod
    def arc(cls, center: Any, first: Any, second: Any, start: float, end: float, **more: Any) -> "Coedge":
        """center + cos t first + sin t second, t from `start` to `end`."""
        return cls(PcurveKind.ARC, [*center, *first, *second, start, end], **more)


@dataclass(eq=False)
class Loop:
    """A closed chain of coedges."""

    coedges: list[Coedge]
    is_inner: bool = False


@dataclass(eq=False)
class Edge:
    """A curve in space, or the point of a collapsed side."""

    curve: Curve | None = None
    point: Any = (0.0, 0.0, 0.0)
    reversed: bool = False


class Finding(NamedTuple):
    """Something that is wrong: loop, coedge and parameter, those of the other curve of a contact, and what the kind says."""

    kind: FindingKind
    loop: int | None
    coedge: int | None
    parameter: float
    other_loop: int | None
    other_coedge: int | None
    other_parameter: float
    numbers: tuple[float, float, float]


@dataclass(frozen=True)
class Report:
    """What was found; `proven`: coedges without a finding are proven to be disjoint. `largest_gap` between curves and edges is what was
    found, `gap_bound` a proven bound of it, infinite where none can be had. Lengths in the unit of the poles."""

    tolerance: float
    largest_opening: float
    largest_gap: float
    gap_bound: float
    segment_error: float
    proven: bool
    findings: list[Finding] = field(default_factory=list)


class Change(NamedTuple):
    """A changed face, the largest deviation of its curves in space, whether that is proven, and the same of the surfaces."""

    face: "TrimmedSurface"
    deviation: float
    proven: bool
    surface_deviation: float
    surface_proven: bool


class TrimmedSurface(_Owner):
    """A face. Immutable."""

    _kind = "trim"

    def __init__(self, support: Support, loops: Sequence[Loop], edges: Sequence[Edge] = (), flipped: bool = False):
        kept: list[Any] = []

        def coedge(item: Coedge) -> Any:
            data = lib.CoedgeData(kind=item.kind, flags=int(item.reversed) + 2 * int(item.same_parameter))
            data.edge = NO_EDGE if item.edge is None else integer("edge", item.edge, most=NO_EDGE - 1)
            data.values[: len(item.values)] = [real("values", x) for x in item.values]
            if item.points is not None:
                points = array("points", item.points, (None, 2))
                kept.append(points)
                data.points, data.point_count = address(points), len(points)
                if item.parameters is not None:
                    parameters = array("parameters", item.parameters, (len(points),))
                    kept.append(parameters)
                    data.parameters = address(parameters)
            data.curve = None if item.curve is None else item.curve._handle
            return data

        chains = []
        for loop in loops:
            items = (lib.CoedgeData * len(loop.coedges))(*map(coedge, loop.coedges))
            kept.append(items)
            chains.append(lib.LoopData(is_inner=int(loop.is_inner), coedges=ctypes.addressof(items), coedge_count=len(items)))
        rows = []
        for edge in edges:
            row = lib.EdgeData(curve=None if edge.curve is None else edge.curve._handle, reversed=int(edge.reversed))
            row.point[:] = vector("point", edge.point).tolist()
            rows.append(row)
        chain_array, edge_array = (lib.LoopData * len(chains))(*chains), (lib.EdgeData * len(rows))(*rows)
        data = lib.TrimData(support=support._handle, edges=ctypes.addressof(edge_array), edge_count=len(rows),
                            loops=ctypes.addressof(chain_array), loop_count=len(chains), flipped=int(bool(flipped)))
        data.struct_size = ctypes.sizeof(data)
        self._own(_made("trim_new", ctypes.addressof(data)))
        self._indexed = True

    @classmethod
    def whole(cls, support: Support) -> "TrimmedSurface":
        """The whole surface: one outer loop around its domain."""
        return _owner(cls, _made("trim_whole", support._handle))

    @classmethod
    def from_json(cls, text: str) -> "TrimmedSurface":
        """The face of a text that `to_json` has written."""
        data = text.encode()
        return _owner(cls, _made("trim_from_json", ctypes.cast(ctypes.c_char_p(data), ctypes.c_void_p), len(data)))

    def to_json(self) -> str:
        """The face as text; every number comes back with the same bits."""
        return _text(lambda *room: self._call("to_json", *room))

    @property
    def support(self) -> Support:
        """The surface."""
        return _owner(Support, self._child("support"))

    def _counts(self) -> tuple[int, int, bool]:
        edges, loops, flipped = ctypes.c_size_t(), ctypes.c_size_t(), ctypes.c_uint32()
        self._call("counts", ctypes.byref(edges), ctypes.byref(loops), ctypes.byref(flipped))
        return edges.value, loops.value, bool(flipped.value)

    @property
    def is_flipped(self) -> bool:
        """Whether its normal is opposite to Su x Sv."""
        return self._counts()[2]

    @property
    def edges(self) -> list[Edge]:
        """The edges in space."""
        return [self._edge(k) for k in range(self._counts()[0])]

    def _edge(self, index: int) -> Edge:
        handle, point, turned = ctypes.c_void_p(), np.empty(3), ctypes.c_uint32()
        self._call("edge", index, ctypes.byref(handle), address(point), ctypes.byref(turned))
        return Edge(None if handle.value is None else _curve(handle.value), point, bool(turned.value))

    @property
    def loops(self) -> list[Loop]:
        """The loops with their curves."""
        found = []
        for k in range(self._counts()[1]):
            inner, count = ctypes.c_uint32(), ctypes.c_size_t()
            self._call("loop", k, ctypes.byref(inner), ctypes.byref(count))
            found.append(Loop([self._coedge(k, i) for i in range(count.value)], bool(inner.value)))
        return found

    def _coedge(self, loop: int, index: int) -> Coedge:
        data, domain = lib.CoedgeData(), np.empty(2)
        self._call("coedge", loop, index, ctypes.byref(data), address(domain))
        kind = PcurveKind(data.kind)
        made = Coedge(kind, edge=None if data.edge == NO_EDGE else data.edge, reversed=bool(data.flags & 1),
                      same_parameter=bool(data.flags & 2), domain=(float(domain[0]), float(domain[1])))
        if kind in (PcurveKind.ISOLINE, PcurveKind.ARC):
            made.values = list(data.values)[: 4 if kind == PcurveKind.ISOLINE else 8]
        elif kind == PcurveKind.SPLINE:
            made.curve = _curve(self._child("coedge_curve", loop, index))
        else:
            made.points, made.parameters = np.empty((data.point_count, 2)), np.empty(data.point_count)
            self._call("coedge_points", loop, index, data.point_count, address(made.points), address(made.parameters))
        return made

    def evaluate(self, loop: int, coedge: int, shares: Any) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Places (n, 2), points (n, 3) and points of the edge (n, 3; NaN without one) at shares, 0 to 1, of a coedge."""
        shares = array("shares", shares, (None,))
        uv, points, edge = (np.empty((len(shares), k)) for k in (2, 3, 3))
        self._call("coedge_evaluate", integer("loop", loop), integer("coedge", coedge), address(shares), len(shares), address(uv),
                   address(points), address(edge))
        return uv, points, edge

    def _changed(self, name: str, *arguments: Any, tolerance: float, replacement: int) -> Change:
        options, summary, out = _options(tolerance, replacement), lib.ChangeSummary(), ctypes.c_void_p()
        self._call(name, *arguments, ctypes.byref(options), ctypes.byref(out), ctypes.byref(summary))
        assert out.value is not None
        return Change(_owner(TrimmedSurface, out.value), summary.deviation, bool(summary.proven), summary.surface_deviation,
                      bool(summary.surface_proven))

    def change(self, transform: Transform, support: Support, tolerance: float = 0.0, replacement: int = Replacement.POLYLINE) -> Change:
        """The face on another surface, which is its surface in the parameters of a transform.

        tolerance    length: largest deviation of a curve in space; 0: 1e-7 x the diagonal of the surface's box
        replacement  a `Replacement`
        """
        return self._changed("change", transform._handle, support._handle, tolerance=tolerance, replacement=replacement)

    def reparametrise(self, transform: Transform, tolerance: float = 0.0, replacement: int = Replacement.POLYLINE) -> Change:
        """The face with its surface in the parameters of a transform; linear on splines: exact."""
        return self._changed("reparametrise", transform._handle, tolerance=tolerance, replacement=replacement)

    def to_nurbs(self, arcs: Sequence[int] | None = None, tolerance: float = 0.0, replacement: int = Replacement.POLYLINE) -> Change:
        """The face of an elementary surface on its exact NURBS form; arcs as in `Support.spline`."""
        return self._changed("to_nurbs", _arcs(arcs), tolerance=tolerance, replacement=replacement)

    def to_elementary(self, support: Support, arcs: Sequence[int] | None = None, tolerance: float = 0.0,
                      replacement: int = Replacement.POLYLINE) -> Change:
        """The face of a NURBS form on the elementary surface that it is the form of."""
        return self._changed("to_elementary", support._handle, _arcs(arcs), tolerance=tolerance, replacement=replacement)

    def follow(self, support: Support, tolerance: float = 0.0) -> Change:
        """The face on the same surface in any other parameters, found by inversions along its curves."""
        return self._changed("follow", support._handle, tolerance=tolerance, replacement=Replacement.POLYLINE)

    def merge(self, other: "TrimmedSurface", direction: str, support: Support, tolerance: float = 0.0) -> "TrimmedSurface":
        """This face and one whose domain follows in `direction` ("u" or "v"), on the surface of both."""
        options = _options(tolerance, Replacement.POLYLINE)
        number = {"u": 0, "v": 1}[direction]
        return _owner(TrimmedSurface, self._child("merge", other._handle, number, support._handle, ctypes.byref(options)))

    def report(self, tolerance: float = 0.0) -> Report:
        """Whether the face is valid; tolerance: a length, 0: 1e-7 x the diagonal of the surface's box."""
        report, summary, found = self._child("report_new", real("tolerance", tolerance)), lib.TrimSummary(), []
        try:
            lib.call("trim_report_summary", report, ctypes.byref(summary))
            for k in range(summary.finding_count):
                row = lib.TrimFinding()
                lib.call("trim_report_get", report, k, ctypes.byref(row))
                numbers = [None if n == NO_EDGE else n for n in (row.loop_index, row.coedge, row.other_loop, row.other_coedge)]
                found.append(Finding(FindingKind(row.kind), numbers[0], numbers[1], row.parameter, numbers[2], numbers[3],
                                     row.other_parameter, tuple(row.numbers)))
        finally:
            lib.functions["trim_report_free"](report)
        return Report(summary.tolerance, summary.largest_opening, summary.largest_gap, summary.gap_bound, summary.segment_error,
                      bool(summary.proven), found)

    def _repr_svg_(self) -> str:
        return picture([self])


def _curve(pointer: int) -> Curve:
    made = Curve.__new__(Curve)
    made._own(pointer)
    return made


def _options(tolerance: float, replacement: int) -> Any:
    options = lib.ChangeOptions()
    lib.functions["change_options_init"](ctypes.byref(options), ctypes.sizeof(options))
    options.tolerance, options.replacement = real("tolerance", tolerance), integer("replacement", replacement)
    return options


def _text(call: Callable[..., Any]) -> str:
    length = ctypes.c_size_t()
    call(0, None, ctypes.byref(length))
    room = ctypes.create_string_buffer(length.value + 1)
    call(len(room), room, ctypes.byref(length))
    return room.value.decode()


def picture(faces: Sequence[TrimmedSurface], titles: Sequence[str] | None = None, view: Any = None) -> str:
    """Faces as SVG text, one column each: the domain with its loops, and the face in space seen along `view`."""
    names = [""] * len(faces) if titles is None else list(titles)
    if len(names) != len(faces):
        raise ValueError(f"titles: {len(names)} given, {len(faces)} needed")
    handles = (ctypes.c_void_p * len(faces))(*(face._handle for face in faces))
    texts = (ctypes.c_char_p * len(faces))(*(name.encode() for name in names))
    direction = None if view is None else vector("view", view)
    return _text(lambda *room: lib.call("trim_picture", handles, texts, len(faces), address(direction), *room))


def arc_by_angle(center: Any, first: Any, second: Any, start: float, end: float) -> Curve:
    """The arc center + cos t first + sin t second in space with its angle t as parameter: a polynomial spline, off by some roundings."""
    middle, x, y = vector("center", center), vector("first", first), vector("second", second)
    angles = np.array([real("start", start), real("end", end)])
    return _curve(_made("curve_arc_by_angle", address(middle), address(x), address(y), address(angles)))


def from_freecad(face: Any) -> TrimmedSurface:
    """A face of FreeCAD in its own parameters: planes, cylinders, cones, spheres and tori by their geometric parameters, surfaces of
    revolution and extrusion by their curve where it is a line, circle, ellipse or spline, splines as splines, other surfaces as
    functions. Its normal stays: a reversed face is flipped."""
    flipped = face.Orientation == "Reversed"
    forward = face.copy()
    forward.Orientation = "Forward"
    edges: list[Edge] = []
    numbers: list[tuple[Any, int, bool]] = []

    def number_of(edge: Any) -> tuple[int, bool]:
        for known, number, same in numbers:
            if edge.isSame(known):
                return number, same
        made, same = _freecad_edge(edge)
        edges.append(made)
        numbers.append((edge, len(edges) - 1, same))
        return len(edges) - 1, same

    loops = []
    for wire in forward.Wires:
        left: list[Any] = []
        for edge in wire.OrderedEdges:
            turned = edge.Orientation == "Reversed"
            curve, first, last = forward.curveOnSurface(edge)
            number, same = number_of(edge)
            ends = [_two(curve.value(t)) for t in ((last, first) if turned else (first, last))]
            coedge = _freecad_pcurve(curve, first, last, turned, ends)
            coedge.edge, coedge.reversed, coedge.same_parameter = number, turned, same
            way = np.linspace(last, first, 17) if turned else np.linspace(first, last, 17)
            left.append((ends, coedge, [_two(curve.value(t)) for t in way]))
        # Head to tail in the domain: a seam comes twice, and the order in space does not tell which time is meant.
        chain = [left.pop(0)]
        while left:
            end = np.array(chain[-1][0][1])
            nearest = min(range(len(left)), key=lambda k: float(np.abs(np.array(left[k][0][0]) - end).sum()))
            chain.append(left.pop(nearest))
        # Outer loops run counter-clockwise; Face.OuterWire is not right for every face with a seam.
        u, v = np.concatenate([places for _, _, places in chain]).T
        loops.append(Loop([coedge for _, coedge, _ in chain], float(np.dot(u, np.roll(v, -1)) - np.dot(v, np.roll(u, -1))) < 0))
    return TrimmedSurface(_freecad_support(forward), loops, edges, flipped)


def _two(place: Any) -> tuple[float, float]:
    return place.x, place.y


def _freecad_spline(curve: Any, turned: bool) -> Curve:
    plane = type(curve).__name__.endswith("2d")
    if curve.isPeriodic():
        curve.setNotPeriodic()
    knots, poles = np.array(curve.KnotSequence), np.array([_two(pole) if plane else tuple(pole) for pole in curve.getPoles()])
    weights = np.array(curve.getWeights())
    if turned:
        knots, poles, weights = -knots[::-1], poles[::-1], weights[::-1]
    return Curve(curve.Degree, knots, poles, weights if curve.isRational() else None)


def _freecad_pcurve(curve: Any, first: float, last: float, turned: bool, ends: list[tuple[float, float]]) -> Coedge:
    if type(curve).__name__ == "Line2d":
        (u, v), (s, t) = ends
        if (u == s) != (v == t):
            return Coedge.isoline("u", u, v, t) if u == s else Coedge.isoline("v", v, u, s)
        return Coedge.polyline(ends, [-last, -first] if turned else [first, last])
    return Coedge.spline(_freecad_spline(curve.toBSpline(first, last), turned))


def _freecad_edge(edge: Any) -> tuple[Edge, bool]:
    """An edge, and whether it has FreeCAD's parameters."""
    if edge.Degenerated:
        return Edge(point=tuple(edge.Vertexes[0].Point)), True
    first, last = edge.ParameterRange
    found = _freecad_curve(edge.Curve, first, last)
    return (Edge(_freecad_spline(edge.Curve.toBSpline(first, last), False)), False) if found is None else (Edge(found), True)


def _freecad_curve(curve: Any, first: float, last: float) -> Curve | None:
    """The part of a curve in space with FreeCAD's parameters; None when it would need others."""
    kind = type(curve).__name__
    if kind in ("Line", "LineSegment"):
        return Curve(1, [first, first, last, last], [tuple(curve.value(t)) for t in (first, last)])
    if kind in ("Circle", "ArcOfCircle", "Ellipse", "ArcOfEllipse") and last - first <= 2 * np.pi * (1 + 1e-12):
        center = np.array(curve.Center)
        return arc_by_angle(center, np.array(curve.value(0)) - center, np.array(curve.value(np.pi / 2)) - center, first, last)
    if kind not in ("BSplineCurve", "BezierCurve") or first < curve.FirstParameter or last > curve.LastParameter:
        return None
    spline = curve.toBSpline(first, last)
    if spline.isPeriodic():
        spline.setNotPeriodic()
    knots, poles = np.array(spline.KnotSequence), np.array([tuple(pole) for pole in spline.getPoles()])
    # A part of a Bezier curve comes with the parameters 0 to 1.
    start, end = spline.FirstParameter, spline.LastParameter
    if (start, end) != (first, last):
        knots = np.clip(first + (knots - start) * ((last - first) / (end - start)), first, last)
    return Curve(spline.Degree, knots, poles, np.array(spline.getWeights()) if spline.isRational() else None)


def _freecad_support(face: Any) -> Support:
    surface, domain = face.Surface, np.array(face.ParameterRange)
    kind = type(surface).__name__
    turn = 2 * np.pi
    if kind == "Plane":
        origin, x, y = (np.array(surface.value(*at)) for at in ((0, 0), (1, 0), (0, 1)))
        return _freecad_elementary("plane", domain, origin, x - origin, y - origin)
    if kind in ("Cylinder", "Cone", "Sphere", "Toroid"):
        for k in (0, 2) if kind == "Toroid" else (0,):
            if domain[k + 1] - domain[k] > turn - 1e-9:
                domain[k + 1] = domain[k] + turn
        center, axis = np.array(surface.Center), np.array(surface.Axis)
        # The direction of the angle 0 from the point there, that of a quarter turn from the tangent.
        v = 0.0 if kind != "Cone" else domain[2] + 0.7 * (domain[3] - domain[2])
        out = np.array(surface.value(0, v)) - center
        out -= out.dot(axis) * axis
        y = np.array(surface.tangent(0, v)[0])
        if kind == "Cylinder":
            return _freecad_elementary("cylinder", domain, center, out, y, surface.Radius, axis=axis)
        if kind == "Sphere":
            domain[2:] = np.clip(domain[2:], -turn / 4, turn / 4)
            return _freecad_elementary("sphere", domain, center, out, y, surface.Radius, axis=axis)
        if kind == "Toroid":
            return _freecad_elementary("torus", domain, center, out, y, surface.MajorRadius, surface.MinorRadius, axis)
        apex = -surface.Radius / np.sin(surface.SemiAngle)
        domain[2:] = [apex if abs(v - apex) < 1e-9 else v for v in domain[2:]]
        return _freecad_elementary("cone", domain, center, out, y, surface.Radius, surface.SemiAngle, axis)
    if kind in ("BSplineSurface", "BezierSurface"):
        from .convert import from_freecad as whole

        return Support(whole(surface))
    swept = _freecad_swept(surface, kind, domain)
    return swept or Support(Surface.from_function(lambda u, v, order: tuple(surface.value(u, v)), domain))


def _freecad_swept(surface: Any, kind: str, domain: np.ndarray) -> Support | None:
    """A surface of revolution or extrusion by its curve; None when that needs other parameters."""
    if kind == "SurfaceOfRevolution":
        meridian = _freecad_curve(surface.BasisCurve, domain[2], domain[3])
        if meridian is None:
            return None
        if domain[1] - domain[0] > 2 * np.pi - 1e-9:
            domain[1] = domain[0] + 2 * np.pi
        axis = np.array(surface.Direction)
        return Support.elementary("revolution", domain, origin=np.array(surface.Location), z=axis / np.linalg.norm(axis), curve=meridian)
    if kind == "SurfaceOfExtrusion":
        base = _freecad_curve(surface.BasisCurve, domain[0], domain[1])
        return None if base is None else Support.elementary("extrusion", domain, z=np.array(surface.Direction), curve=base)
    return None


def _freecad_elementary(kind: str, domain: np.ndarray, origin: np.ndarray, x: np.ndarray, y: np.ndarray, first: float = 0.0,
                        second: float = 0.0, axis: np.ndarray | None = None) -> Support:
    """Orthonormal axes from rounded directions; the third one by the right hand, or along `axis` when it is given."""
    x = x / np.linalg.norm(x)
    y = y - y.dot(x) * x
    y = y / np.linalg.norm(y)
    z = np.cross(x, y)
    if axis is not None and z.dot(axis) < 0:
        z = -z
    return Support.elementary(kind, domain, origin=origin, x=x, y=y, z=z, first=first, second=second)
