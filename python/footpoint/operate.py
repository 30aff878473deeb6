"""Operations on curves and surfaces: each makes a new shape and leaves the old one as it is.

Exact ones return the shape; those that approximate return (shape, error) with an error that is proven: no point of the new shape is farther
from the point of the old one at the same parameters. Surfaces need a `direction`, "u" or "v", where one parameter is meant.

>>> import footpoint
>>> from footpoint import operate
>>> arch = footpoint.Curve.from_poles(3, [[0, 0], [1, 2], [3, 2], [4, 0]])
>>> finer = operate.refine(arch, [0.25, 0.5])
>>> back, error = operate.simplify(finer, 1e-9)
>>> len(finer.poles), len(back.poles), error < 1e-12
(6, 4, True)
>>> length = operate.ArcLength(arch)
>>> value, error = length.total
>>> round(value, 6), error < 1e-11
(5.268366, True)
"""

from __future__ import annotations

import ctypes
from enum import IntEnum
from typing import TYPE_CHECKING, Any, NamedTuple, Sequence, TypeVar

import numpy as np

from . import _library as lib
from ._query import address, array, integer, real, vector
from ._shapes import Curve, Surface

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

__all__ = ["ArcLength", "Difference", "Direction", "Frame", "Joint", "KnotLine", "affine", "bezier_form", "clamp", "continuity", "derivative", "difference",
           "elevate", "frame", "from_power", "isocurve", "join", "make_compatible", "part", "periodic", "power", "projective", "reduce", "refine",
           "remove_knot", "reparametrise", "reverse", "simplify", "split", "swap", "unclamp", "with_domain"]

Shape = TypeVar("Shape", Curve, Surface)

ESTIMATE = np.dtype([("value", float), ("error", float)])


class Direction(IntEnum):
    """A parameter direction of a surface."""

    U = 0
    V = 1


class Difference(NamedTuple):
    """The greatest distance at equal parameters is at most `bound` (proven) and at least `reached`, nearly at (u, v); curves: v = 0."""

    bound: float
    reached: float
    u: float
    v: float


class Frame(NamedTuple):
    """The moving frame of a curve; NaN marks what is not defined. Curvature and torsion in 1 / length."""

    point: np.ndarray
    tangent: np.ndarray
    normal: np.ndarray
    binormal: np.ndarray
    speed: float
    curvature: float
    torsion: float


class Joint(NamedTuple):
    """How the pieces of a curve meet at a knot; the angle in radians, NaN beside a cusp."""

    u: float
    multiplicity: int
    order: int
    gap: float
    first_jump: float
    tangent_angle: float
    curvature_jump: float


class KnotLine(NamedTuple):
    """How the pieces of a surface meet along a knot line; `gap` and `first_jump` are bounds on the whole line."""

    value: float
    multiplicity: int
    order: int
    gap: float
    first_jump: float


def refine(shape: Shape, values: ArrayLike, direction: str | None = None) -> Shape:
    """The same shape with more knots, each as often as it stands in `values`."""
    knots = array("values", values, (None,))
    return _made(shape, "refine", *_along(shape, direction), address(knots), len(knots), kept=knots)


def remove_knot(shape: Shape, value: float, times: int = 1, direction: str | None = None) -> tuple[Shape, float]:
    """The shape without some copies of a knot, and the error."""
    return _bounded(shape, "remove_knot", *_along(shape, direction), real("value", value), integer("times", times))


def simplify(shape: Shape, tolerance: float) -> tuple[Shape, float]:
    """The shape without the knots that are not needed to stay within a tolerance, and the error."""
    return _bounded(shape, "simplify", real("tolerance", tolerance))


def part(shape: Shape, domain: ArrayLike) -> Shape:
    """The part of a curve over [u0, u1], or of a surface over [u0, u1, v0, v1], clamped, with its parameters."""
    if isinstance(shape, Curve):
        return _made(shape, "part", *vector("domain", domain, 2).tolist())
    ends = vector("domain", domain, 4)
    return _made(shape, "part", address(ends), kept=ends)


def split(shape: Shape, at: float, direction: str | None = None) -> tuple[Shape, Shape]:
    """The parts before and behind a parameter."""
    outs = ctypes.c_void_p(), ctypes.c_void_p()
    _call(shape, "split", *_along(shape, direction), real("at", at), *map(ctypes.byref, outs))
    return _own(type(shape), outs[0]), _own(type(shape), outs[1])


def join(shapes: Sequence[Shape], tolerance: float, direction: str | None = None) -> tuple[Shape, float]:
    """The shapes as one, each beginning where the one before ends, within a tolerance; and how far points move by that."""
    kind, handles = _all(shapes)
    out, error = ctypes.c_void_p(), ctypes.c_double()
    where = _along(shapes[0], direction)
    lib.call(f"{kind._kind}_join", handles, len(shapes), *where, real("tolerance", tolerance), ctypes.byref(error), ctypes.byref(out))
    return _own(kind, out), error.value


def make_compatible(shapes: Sequence[Shape]) -> list[Shape]:
    """The same shapes with common degrees, knots and the domain of the first; all with weights if one is rational."""
    kind, handles = _all(shapes)
    outs = (ctypes.c_void_p * len(shapes))()
    lib.call(f"{kind._kind}_make_compatible", handles, len(shapes), outs)
    return [_own(kind, ctypes.c_void_p(out)) for out in outs]


def difference(shape: Shape, other: Shape) -> Difference:
    """How far two shapes over the same domain are apart at equal parameters."""
    found = lib.Difference()
    if type(shape) is not type(other):
        raise TypeError("other: the shapes must be of one kind")
    _call(shape, "difference", other._handle, ctypes.byref(found))
    return Difference(found.bound, found.reached, found.u, found.v)


def clamp(shape: Shape) -> Shape:
    """The same shape with clamped ends."""
    return _made(shape, "clamp")


def unclamp(shape: Shape, direction: str | None = None) -> tuple[Shape, float]:
    """The same shape with unclamped ends, knots mirrored at the ends; and the error."""
    return _bounded(shape, "unclamp", *_along(shape, direction))


def periodic(shape: Shape, tolerance: float, direction: str | None = None) -> tuple[Shape, float]:
    """The periodic form of a closed shape, unrolled, with the smoothest seam within the tolerance; and the error."""
    return _bounded(shape, "periodic", *_along(shape, direction), real("tolerance", tolerance))


def elevate(shape: Shape, by: int = 1, direction: str | None = None) -> Shape:
    """The same shape with a higher degree."""
    return _made(shape, "elevate", *_along(shape, direction), integer("by", by))


def reduce(shape: Shape, direction: str | None = None) -> tuple[Shape, float]:
    """The nearest shape of a degree lower by one, and the error."""
    return _bounded(shape, "reduce", *_along(shape, direction))


def reverse(shape: Shape, direction: str | None = None) -> Shape:
    """The same shape run through backwards."""
    return _made(shape, "reverse", *_along(shape, direction))


def swap(surface: Surface) -> Surface:
    """The same surface with its directions exchanged."""
    return _made(_surface(surface), "swap")


def with_domain(shape: Shape, domain: ArrayLike) -> Shape:
    """The same shape over another domain: [u0, u1], or [u0, u1, v0, v1]."""
    if isinstance(shape, Curve):
        return _made(shape, "with_domain", *vector("domain", domain, 2).tolist())
    ends = vector("domain", domain, 4)
    return _made(shape, "with_domain", address(ends), kept=ends)


def reparametrise(shape: Shape, speed: float, direction: str | None = None) -> Shape:
    """The same shape in a Moebius function of the parameter, over the same domain; `speed` is its derivative at the start."""
    return _made(shape, "reparametrise", *_along(shape, direction), real("speed", speed))


def affine(shape: Shape, matrix: ArrayLike) -> Shape:
    """The shape of the points A (x, y, z, 1); `matrix` is 3 x 4."""
    entries = array("matrix", matrix, (3, 4))
    return _made(shape, "affine", address(entries), kept=entries)


def projective(shape: Shape, matrix: ArrayLike) -> Shape:
    """The shape of the points (x', y', z') / w' of A (x, y, z, 1); `matrix` is 4 x 4."""
    entries = array("matrix", matrix, (4, 4))
    return _made(shape, "projective", address(entries), kept=entries)


def derivative(shape: Shape, direction: str | None = None) -> Shape:
    """The derivative as a shape; NotImplementedError where it jumps."""
    return _made(shape, "derivative", *_along(shape, direction))


def bezier_form(shape: Shape) -> Shape:
    """The same shape with knots of full multiplicity."""
    return _made(shape, "bezier_form")


def isocurve(surface: Surface, at: float, direction: str) -> Curve:
    """The curve on a surface with the parameter of `direction` fixed."""
    out = ctypes.c_void_p()
    _call(_surface(surface), "isocurve", *_along(surface, direction), real("at", at), ctypes.byref(out))
    return _own(Curve, out)


def frame(curve: Curve, u: float, side: int = 1) -> Frame:
    """Tangent, normals, curvature and torsion; side -1: of the piece that ends at u."""
    found = lib.CurveFrame()
    _call(_curve(curve), "frame", real("u", u), int(side), ctypes.byref(found))
    vectors = (np.array(getattr(found, name)) for name in Frame._fields[:4])
    return Frame(*vectors, found.speed, found.curvature, found.torsion)


def continuity(shape: Curve | Surface, tolerance: float = 1e-9, direction: str | None = None) -> list[Joint] | list[KnotLine]:
    """How the pieces meet at the knots inside the domain and, if the shape is closed, at the seam (reported at the end); of a surface at the
    knot lines of a direction, with bounds along each whole line.
    """
    where, curved = _along(shape, direction), isinstance(shape, Curve)
    room = len(shape.knots if curved else shape.knots[where[0]])
    record, kind = (lib.Joint, Joint) if curved else (lib.KnotLine, KnotLine)
    records, count = (record * room)(), ctypes.c_size_t()
    _call(shape, "continuity", *where, real("tolerance", tolerance), room, records, ctypes.byref(count))
    return [kind(*(getattr(each, name) for name in kind._fields)) for each in records[:count.value]]


def power(shape: Curve | Surface) -> np.ndarray:
    """Powers of local parameters, 0 to 1 on each span, as w x, w y, w z, w: (spans, degree + 1, 4), of a surface (patches_u, patches_v,
    degree_u + 1, degree_v + 1, 4).
    """
    form = bezier_form(shape)
    knots = (form.knots,) if isinstance(form, Curve) else form.knots
    orders = [len(t) - count for t, count in zip(knots, form.poles.shape)]
    pieces = [(count - 1) // (order - 1) for count, order in zip(form.poles.shape, orders)]
    out, count = np.empty((*pieces, *orders, 4)), ctypes.c_size_t()
    _call(shape, "power", out.size, address(out), ctypes.byref(count))
    return out


def from_power(coefficients: ArrayLike, domain: ArrayLike) -> Curve | Surface:
    """The Bezier curve of powers of a local parameter, (degree + 1, 4) with w x, w y, w z, w; or the Bezier patch of (degree_u + 1,
    degree_v + 1, 4) over u0, u1, v0, v1.
    """
    out = ctypes.c_void_p()
    if np.ndim(coefficients) == 3:
        net, ends = array("coefficients", coefficients, (None, None, 4)), vector("domain", domain, 4)
        degrees = (max(count - 1, 0) for count in net.shape[:2])
        lib.call("surface_from_power", *degrees, address(ends), address(net), ctypes.byref(out))
        return _own(Surface, out)
    rows, ends = array("coefficients", coefficients, (None, 4)), vector("domain", domain, 2)
    lib.call("curve_from_power", max(len(rows) - 1, 0), *ends.tolist(), address(rows), ctypes.byref(out))
    return _own(Curve, out)


class ArcLength:
    """The arc length of a curve to a proven error of at most `tolerance`, or what rounding allows; 0: 1e-12 of the length."""

    def __init__(self, curve: Curve, tolerance: float = 0.0):
        out = ctypes.c_void_p()
        lib.call("arc_length_new", _curve(curve)._handle, real("tolerance", tolerance), ctypes.byref(out))
        self._handle = out.value

    def __del__(self) -> None:
        if getattr(self, "_handle", None):
            lib.functions["arc_length_free"](self._handle)

    @property
    def total(self) -> tuple[float, float]:
        """The length of the whole curve and its error."""
        found = lib.Estimate()
        lib.call("arc_length_total", self._handle, ctypes.byref(found))
        return found.value, found.error

    def at(self, parameters: ArrayLike) -> np.ndarray:
        """Records (value, error): lengths from the start to parameters."""
        return self._each("arc_length_at", array("parameters", parameters, (None,)))

    def parameters(self, lengths: ArrayLike) -> np.ndarray:
        """Records (value, error): parameters of lengths from the start; the error is a length."""
        return self._each("arc_length_parameters", array("lengths", lengths, (None,)))

    def _each(self, name: str, numbers: np.ndarray) -> np.ndarray:
        out = np.empty(len(numbers), ESTIMATE)
        lib.call(name, self._handle, address(numbers), len(numbers), address(out))
        return out


def _curve(shape: Any) -> Curve:
    if not isinstance(shape, Curve):
        raise TypeError(f"curve: a Curve is needed, not {type(shape).__name__}")
    return shape


def _surface(shape: Any) -> Surface:
    if not isinstance(shape, Surface):
        raise TypeError(f"surface: a Surface is needed, not {type(shape).__name__}")
    return shape


def _along(shape: Any, direction: str | None) -> tuple[int, ...]:
    """The direction as C wants it: nothing for curves."""
    if isinstance(shape, Curve):
        if direction is not None:
            raise ValueError("direction: a curve has none")
        return ()
    if not isinstance(shape, Surface):
        raise TypeError(f"shape: a Curve or a Surface is needed, not {type(shape).__name__}")
    names = {"u": 0, "v": 1, Direction.U: 0, Direction.V: 1}
    if direction not in names:
        raise ValueError(f'direction: "u" or "v" is needed for a surface, not {direction!r}')
    return (names[direction],)


def _call(shape: Any, name: str, *arguments: Any) -> None:
    if not isinstance(shape, (Curve, Surface)):
        raise TypeError(f"shape: a Curve or a Surface is needed, not {type(shape).__name__}")
    lib.call(f"{shape._kind}_{name}", shape._handle, *arguments)


def _own(kind: type[Shape], out: ctypes.c_void_p) -> Shape:
    shape = kind.__new__(kind)
    shape._own(out.value)
    return shape


def _made(shape: Shape, name: str, *arguments: Any, kept: Any = None) -> Shape:
    """The shape that a function makes; `kept` are arrays that live until it returns."""
    out = ctypes.c_void_p()
    _call(shape, name, *arguments, ctypes.byref(out))
    del kept
    return _own(type(shape), out)


def _bounded(shape: Shape, name: str, *arguments: Any) -> tuple[Shape, float]:
    out, error = ctypes.c_void_p(), ctypes.c_double()
    _call(shape, name, *arguments, ctypes.byref(error), ctypes.byref(out))
    return _own(type(shape), out), error.value


def _all(shapes: Sequence[Shape]) -> tuple[type[Shape], Any]:
    """The kind of some shapes, at least one, and their handles."""
    if not len(shapes):
        raise ValueError("shapes: none given")
    kind = type(shapes[0])
    if kind not in (Curve, Surface) or any(type(shape) is not kind for shape in shapes):
        raise TypeError("shapes: curves or surfaces are needed, all of one kind")
    return kind, (ctypes.c_void_p * len(shapes))(*(shape._handle for shape in shapes))
