"""Curves and surfaces."""

from __future__ import annotations

import ctypes
import threading
from typing import TYPE_CHECKING, Any, Callable

import numpy as np

from . import _library as lib
from ._feet import FOOT, Feet, FootSet, take_set
from ._handle import Handle, OfFunction
from ._query import Call, Points, address, array, integer, real, vector

if TYPE_CHECKING:
    from numpy.typing import ArrayLike
    from typing_extensions import Unpack

    from ._query import ExtremaOptions, QueryOptions

class Shape(Handle):
    """What curves and surfaces have in common."""

    _width = 1
    _function: OfFunction | None = None

    def _inputs(self) -> tuple:
        """What the constructor takes."""
        raise NotImplementedError

    def _inputs_of_parent(self) -> tuple:
        """The inputs, read from a handle that is about to be renewed."""
        self._keep()
        return self._inputs()

    def _make_from(self, function: OfFunction) -> None:
        out = ctypes.c_void_p()
        data = function.data()
        name = f"{self._kind}_from_callback"
        try:
            function.run(lambda: lib.call(name, ctypes.addressof(data), ctypes.byref(out)), lambda: None)
        except ValueError as error:
            raise error from function.error
        self._function = function
        self._own(out.value)

    def _call(self, name: str, *arguments: Any) -> int:
        if self._function is None:
            return super()._call(name, *arguments)
        function, handle = self._function, self._handle
        function.error = None
        try:
            return function.run(lambda: lib.call(f"{self._kind}_{name}", handle, *arguments), lambda: None)
        except ValueError as error:
            raise error from function.error

    def _query(self, name: str, points: ArrayLike, options: dict, *middle: Any, extra: tuple = (), floats: bool = True) -> tuple[Feet, Points]:
        """A batch of feet: _closest, _invert, _project, _path."""
        asked = Points(points, floats=floats)
        options, stopped = self._stoppable(options)
        call = Call(options, self._kind, asked)
        feet = Feet(asked.count)
        arrays = [make(asked.count) for make in extra]
        full = name + (asked.suffix if floats else "")
        arguments = (address(asked.rows), asked.count, *middle, call.pointer, address(feet), *map(address, arrays))
        if self._function is None:
            status = self._call(full, *arguments)
        else:
            handle = self._handle
            status = self._function.run(lambda: lib.call(f"{self._kind}_{full}", handle, *arguments), stopped)
        call.finish(status, feet.reshape(asked.shape))
        self._indexed = True
        asked.extra = arrays
        return feet.reshape(asked.shape), asked

    def _stoppable(self, options: dict) -> tuple[dict, Callable[[], None]]:
        """Options whose should_stop also hears the main thread's interrupt, which waits for a shape from a function."""
        if self._function is None:
            return options, lambda: None
        stop = threading.Event()
        given = options.get("should_stop")
        if given is not None and not callable(given):
            raise TypeError(f"should_stop: a function is needed, not {type(given).__name__}")
        return {**options, "should_stop": lambda: stop.is_set() or (given is not None and given())}, stop.set

    def _set(self, name: str, before: tuple, options: dict, struct_type: Any = lib.QueryOptions) -> FootSet:
        """A set: _preimage, _extrema, _on_line."""
        options, stopped = self._stoppable(options)
        call = Call(options, self._kind, struct_type=struct_type)
        out = ctypes.c_void_p()
        arguments = (*before, call.pointer, ctypes.byref(out))
        if self._function is None:
            status = self._call(name, *arguments)
        else:
            handle = self._handle
            status = self._function.run(lambda: lib.call(f"{self._kind}_{name}", handle, *arguments), stopped)
        found = take_set(out) if out.value else None
        call.finish(status)
        assert found is not None
        self._indexed = True
        return found

    def closest(self, points: ArrayLike, **options: Unpack[QueryOptions]) -> Feet:
        """The nearest point for each query point, with a proven lower bound of the distance.

        points   shape (..., 3), float64 or float32, in the unit of the poles; not copied when x, y, z of a point are adjacent.
                 Do not change them during the call. A point with a NaN marks its own record (`Flag.BAD_QUERY`)
        options  see `QueryOptions`
        returns  Feet of shape (...)
        """
        return self._query("closest", points, options)[0]

    def invert(self, points: ArrayLike, **options: Unpack[QueryOptions]) -> Feet:
        """The parameters of points that lie on the shape: as `closest`, and points proven to be farther away than `tolerance` have
        `Flag.NOT_ON_SHAPE`. Floats are off by up to 6e-8 of their coordinates: the tolerance has to allow for that."""
        return self._query("invert", points, options)[0]

    def preimage(self, point: ArrayLike, tolerance: float = 0.0, **options: Unpack[QueryOptions]) -> FootSet:
        """All parameters whose point lies within a tolerance of a point, with proof that none is missing.

        point      shape (3,)
        tolerance  length; 0: 1e-7 x the diagonal of the shape's box
        options    domain, budget and should_stop count
        """
        at = vector("point", point)
        return self._set("preimage", (address(at), real("tolerance", tolerance)), options)

    def extrema(self, point: ArrayLike, **options: Unpack[ExtremaOptions]) -> FootSet:
        """All points where the distance from a point is stationary, nearest first, with proof that none is missing.

        point    shape (3,)
        options  see `ExtremaOptions`
        """
        at = vector("point", point)
        return self._set("extrema", (address(at),), options, lib.ExtremaOptions)

    def on_line(self, origin: ArrayLike, direction: ArrayLike, reach: ArrayLike | None = None, tolerance: float = 0.0,
                **options: Unpack[QueryOptions]) -> FootSet:
        """All parameters whose point lies within a tolerance of a line, in the order along it, with proof that none is missing.

        origin, direction  shape (3,) each; the length of the direction does not matter
        reach              least and greatest length from the origin, infinities allowed (a ray: 0, inf); None: the whole line
        """
        start, along = vector("origin", origin), vector("direction", direction)
        ends = None if reach is None else vector("reach", reach, 2)
        return self._set("on_line", (address(start), address(along), address(ends), real("tolerance", tolerance)), options)

    def project(self, points: ArrayLike, direction: ArrayLike, **options: Unpack[QueryOptions]) -> Feet:
        """The point on the line through each query point along a direction, to either side, that is nearest to the query point.
        Where the line misses the shape, the record has `Flag.NOT_ON_SHAPE` and an infinite distance.

        points     shape (..., 3)
        direction  shape (3,)
        """
        along = vector("direction", direction)
        return self._query("project", points, options, address(along), floats=False)[0]

    def path(self, points: ArrayLike, **options: Unpack[QueryOptions]) -> tuple[Feet, np.ndarray, np.ndarray]:
        """The parameters of a polyline, as a path: as `invert`, and of feet that tie the one that continues the path is taken.

        points   shape (n, 3), in the order of the path
        returns  Feet (n,); parameters with whole turns of closed directions, (n, 2), on a curve (n,); sums of `PathChange`, (n,)
        """
        if np.ndim(points) != 2:
            raise ValueError(f"points: the shape is {np.shape(points)} and must be (n, 3)")
        feet, asked = self._query("path", points, options, floats=False,
                                  extra=(lambda n: np.zeros(n * self._width), lambda n: np.zeros(n, np.uint32)))
        unwrapped, changes = asked.extra
        return feet, unwrapped if self._width == 1 else unwrapped.reshape(-1, 2), changes

    def uncertainty(self, feet: Feet, accuracy: float = 0.0) -> np.ndarray:
        """How far the parameters of each foot may move while the point moves by at most the accuracy (a length).

        feet     Feet of shape (...), of this shape
        returns  shape (..., 2), on a curve (...)
        """
        records = records_of(feet)
        out = np.zeros(records.size * self._width)
        self._call("uncertainty", address(records), records.size, real("accuracy", accuracy), address(out))
        return out.reshape(records.shape if self._width == 1 else (*records.shape, 2))

    @property
    def is_rational(self) -> bool:
        """Whether it has weights that differ."""
        return bool(self._number("is_rational", ctypes.c_int32))

    def _knots(self, name: str, count: int) -> np.ndarray:
        out = np.zeros(count)
        self._call(name, count, address(out))
        return out


def records_of(feet: Any) -> np.ndarray:
    """Feet as a packed array of records."""
    records = np.asarray(feet)
    if records.dtype != FOOT:
        raise TypeError(f"feet: records of feet are needed (as closest gives them), not {records.dtype}")
    return np.ascontiguousarray(records).reshape(records.shape)


def three_coordinates(poles: ArrayLike, dimensions: int) -> np.ndarray:
    """Poles with three coordinates: z = 0 where there are two."""
    given = array("poles", poles)
    if given.ndim != dimensions or given.shape[-1] not in (2, 3):
        grid = "n" if dimensions == 2 else "nu, nv"
        raise ValueError(f"poles: the shape is {given.shape} and must be ({grid}, 3), or ({grid}, 2) for z = 0")
    if given.shape[-1] == 2:
        given = np.concatenate([given, np.zeros((*given.shape[:-1], 1))], -1)
    return np.ascontiguousarray(given)


def _uniform(degree: int, count: int) -> np.ndarray:
    inside = np.arange(1, count - degree) / max(count - degree, 1)
    return np.concatenate([np.zeros(degree + 1), inside, np.ones(degree + 1)])


class Curve(Shape):
    """A NURBS curve.

    degree   1 to 31
    knots    shape (n + degree + 1,), repeats written out; periodic curves come unrolled
    poles    shape (n, 3), or (n, 2) for z = 0; not multiplied by the weights; in any unit of length
    weights  shape (n,), positive; None: polynomial

    Everything is copied. Curves never change, may be shared by threads, and travel by pickle.

    >>> import numpy as np, footpoint
    >>> parabola = footpoint.Curve(2, [0, 0, 0, 1, 1, 1], [[0, 0, 0], [1, 2, 0], [2, 0, 0]])
    >>> foot = parabola.closest([1, 3, 0])
    >>> float(foot.u), float(foot.distance)
    (0.5, 2.0)
    """

    _kind = "curve"

    def __init__(self, degree: int, knots: ArrayLike, poles: ArrayLike, weights: ArrayLike | None = None):
        order = integer("degree", degree)
        self._new(order, array("knots", knots, (None,)), three_coordinates(poles, 2), None if weights is None else array("weights", weights))

    def _new(self, degree: int, knots: np.ndarray, poles: np.ndarray, weights: np.ndarray | None) -> None:
        if len(knots) != len(poles) + degree + 1:
            raise ValueError(f"knots: {len(knots)} numbers, and {len(poles)} poles of degree {degree} need {len(poles) + degree + 1}")
        if weights is not None and weights.shape != (len(poles),):
            raise ValueError(f"weights: the shape is {weights.shape} and must be ({len(poles)},)")
        data = lib.CurveData(ctypes.sizeof(lib.CurveData), degree, len(poles), address(knots), address(poles), address(weights))
        out = ctypes.c_void_p()
        lib.call("curve_new", ctypes.addressof(data), ctypes.byref(out))
        self._own(out.value)

    @classmethod
    def from_poles(cls, degree: int, poles: ArrayLike, weights: ArrayLike | None = None) -> "Curve":
        """A clamped curve on [0, 1] with uniform inner knots; a Bezier curve when there are degree + 1 poles."""
        points = three_coordinates(poles, 2)
        order = integer("degree", degree, 1, 31)
        if len(points) <= order:
            raise ValueError(f"poles: {len(points)} poles, and degree {order} needs at least {order + 1}")
        return cls(order, _uniform(order, len(points)), points, weights)

    @classmethod
    def from_function(cls, function: Callable, domain: ArrayLike, speed_bound: float = 0.0, second_bound: float = 0.0) -> "Curve":
        """A curve given by a Python function.

        function       called with (u, order), order 0 to 2, on any thread; returns C, C', C'' as rows of x, y, z: at least the point;
                       orders that are missing are taken from finite differences
        domain         u0, u1
        speed_bound    |C'| is at most this; 0: unknown
        second_bound   |C''| is at most this; 0: unknown. With neither bound no answer is proven; a bound too small makes proofs wrong

        >>> import math, footpoint
        >>> helix = footpoint.Curve.from_function(lambda u, order: [math.cos(u), math.sin(u), u], [0, 6], second_bound=1)
        >>> foot = helix.closest([2, 0, 0.1])
        >>> bool(foot.proven), round(float(foot.distance), 3)
        (True, 1.003)
        """
        curve = cls.__new__(cls)
        curve._make_from(OfFunction("curve", function, domain, real("speed_bound", speed_bound), real("second_bound", second_bound)))
        return curve

    def _renew(self) -> None:
        if self._function is not None:
            self._make_from(self._function)
        else:
            self._new(*self._inputs_of_parent())

    def __reduce__(self) -> tuple:
        if self._function is not None:
            function = self._function
            return Curve.from_function, (function.function, function.domain, function.first[0], function.second[0])
        return Curve, self._inputs()

    def _inputs(self) -> tuple:
        return self.degree, self.knots, self.poles, self.weights if self.is_rational else None

    def __repr__(self) -> str:
        if self._function is not None:
            return f"Curve.from_function({self._function.function!r})"
        return f"Curve(degree {self.degree}, {self.pole_count} poles{', rational' if self.is_rational else ''})"

    @property
    def domain(self) -> np.ndarray:
        """Start and end of u, shape (2,)."""
        return self._get("domain", 2)

    @property
    def degree(self) -> int:
        """1 to 31."""
        return self._number("degree", ctypes.c_size_t)

    @property
    def pole_count(self) -> int:
        """The number of poles n."""
        return self._number("pole_count", ctypes.c_size_t)

    @property
    def knots(self) -> np.ndarray:
        """A copy, shape (n + degree + 1,)."""
        return self._knots("knots", self.pole_count + self.degree + 1)

    @property
    def poles(self) -> np.ndarray:
        """A copy, shape (n, 3)."""
        return self._knots("poles", 3 * self.pole_count).reshape(-1, 3)

    @property
    def weights(self) -> np.ndarray:
        """A copy, shape (n,); all 1 for a polynomial curve."""
        return self._knots("weights", self.pole_count)

    @property
    def is_closed(self) -> bool:
        """Whether it ends where it starts, as geometry."""
        return bool(self._number("is_closed", ctypes.c_int32))

    def evaluate(self, u: ArrayLike, derivatives: int = 0, side: int | None = None) -> np.ndarray:
        """The curve and its derivatives.

        u            shape (...), in the domain
        derivatives  highest order d, at most 31
        side         -1: the piece below a knot, +1: the one above; None: the piece above, at the end of the domain the one below
        returns      shape (..., 3) for d = 0, else (..., d + 1, 3)
        """
        order = integer("derivatives", derivatives, 0, 31)
        at = array("u", u)
        out = np.zeros((at.size, order + 1, 3))
        if side is None:
            self._call("evaluate_many", address(at), at.size, order, address(out)) if at.ndim else self._call(
                "evaluate", float(at.item()), order, address(out))
        else:
            which = integer("side", side, -(2**31), 2**31 - 1)
            for index, value in enumerate(at.reshape(-1).tolist()):
                self._call("evaluate_sided", value, which, order, address(out) + index * 24 * (order + 1))
        shape = np.shape(u)
        return out.reshape((*shape, 3) if order == 0 else (*shape, order + 1, 3))

    def tangents(self, feet: Feet) -> tuple[np.ndarray, np.ndarray]:
        """The unit tangent at each foot, in the direction of growing u.

        returns  tangents (..., 3), NaN where there is none; sums of `NormalFlag`, (...)
        """
        records = records_of(feet)
        tangents, flags = np.zeros((*records.shape, 3)), np.zeros(records.shape, np.uint32)
        self._call("tangents", address(records), records.size, address(tangents), address(flags))
        return tangents, flags

    def unwrap(self, previous: float, u: float) -> float:
        """u plus the whole turns of a closed curve that bring it nearest to the previous, unwrapped parameter."""
        out = ctypes.c_double()
        self._call("unwrap", real("previous", previous), real("u", u), ctypes.byref(out))
        return out.value


class Surface(Shape):
    """A NURBS surface.

    degree_u, degree_v  1 to 31
    knots_u, knots_v    shapes (nu + degree_u + 1,) and (nv + degree_v + 1,), repeats written out; periodic ones unrolled
    poles               shape (nu, nv, 3), not multiplied by the weights; in any unit of length
    weights             shape (nu, nv), positive; None: polynomial

    Everything is copied. Surfaces never change, may be shared by threads, and travel by pickle.

    >>> import footpoint
    >>> square = footpoint.Surface.from_poles(1, 1, [[[0, 0, 0], [0, 2, 0]], [[2, 0, 0], [2, 2, 0]]])
    >>> feet = square.closest([[0.5, 1, 3], [-1, 1, 0]])
    >>> feet.uv.round(12).tolist(), feet.distance.tolist()
    ([[0.25, 0.5], [0.0, 0.5]], [3.0, 1.0])
    >>> bool(feet.has(footpoint.Flag.EDGE)[1])
    True
    """

    _kind = "surface"
    _width = 2

    def __init__(self, degree_u: int, degree_v: int, knots_u: ArrayLike, knots_v: ArrayLike, poles: ArrayLike, weights: ArrayLike | None = None):
        self._new(integer("degree_u", degree_u), integer("degree_v", degree_v), array("knots_u", knots_u, (None,)),
                  array("knots_v", knots_v, (None,)), three_coordinates(poles, 3), None if weights is None else array("weights", weights))

    def _new(self, degree_u: int, degree_v: int, knots_u: np.ndarray, knots_v: np.ndarray, poles: np.ndarray, weights: np.ndarray | None) -> None:
        for name, knots, count, degree in (("knots_u", knots_u, poles.shape[0], degree_u), ("knots_v", knots_v, poles.shape[1], degree_v)):
            if len(knots) != count + degree + 1:
                raise ValueError(f"{name}: {len(knots)} numbers, and {count} poles of degree {degree} need {count + degree + 1}")
        if weights is not None and weights.shape != poles.shape[:2]:
            raise ValueError(f"weights: the shape is {weights.shape} and must be {poles.shape[:2]}")
        data = lib.SurfaceData(ctypes.sizeof(lib.SurfaceData), degree_u, degree_v, *poles.shape[:2], address(knots_u), address(knots_v),
                               address(poles), address(weights))
        out = ctypes.c_void_p()
        lib.call("surface_new", ctypes.addressof(data), ctypes.byref(out))
        self._own(out.value)

    @classmethod
    def from_poles(cls, degree_u: int, degree_v: int, poles: ArrayLike, weights: ArrayLike | None = None) -> "Surface":
        """A clamped surface on [0, 1] x [0, 1] with uniform inner knots; a Bezier patch when there are degree + 1 poles."""
        points = three_coordinates(poles, 3)
        orders = integer("degree_u", degree_u, 1, 31), integer("degree_v", degree_v, 1, 31)
        for name, order, count in zip("uv", orders, points.shape):
            if count <= order:
                raise ValueError(f"poles: {count} poles in {name}, and degree {order} needs at least {order + 1}")
        return cls(*orders, _uniform(orders[0], points.shape[0]), _uniform(orders[1], points.shape[1]), points, weights)

    @classmethod
    def from_function(cls, function: Callable, domain: ArrayLike, speed_bounds: ArrayLike = (0, 0), second_bounds: ArrayLike = (0, 0, 0)) -> "Surface":
        """A surface given by a Python function.

        function        called with (u, v, order), order 0 to 2, on any thread; returns S; Su, Sv; Suu, Suv, Svv as rows of x, y, z: at
                        least the point; orders that are missing are taken from finite differences
        domain          u0, u1, v0, v1
        speed_bounds    |Su| and |Sv| are at most these; both 0: unknown
        second_bounds   |Suu|, |Suv| and |Svv| are at most these; all 0: unknown. With neither kind of bound no answer is proven; a
                        bound too small makes proofs wrong
        """
        surface = cls.__new__(cls)
        surface._make_from(OfFunction("surface", function, domain, speed_bounds, second_bounds))
        return surface

    def _renew(self) -> None:
        if self._function is not None:
            self._make_from(self._function)
        else:
            self._new(*self._inputs_of_parent())

    def __reduce__(self) -> tuple:
        if self._function is not None:
            function = self._function
            return Surface.from_function, (function.function, function.domain, function.first, function.second)
        return Surface, self._inputs()

    def _inputs(self) -> tuple:
        return (*self.degrees, *self.knots, self.poles, self.weights if self.is_rational else None)

    def __repr__(self) -> str:
        if self._function is not None:
            return f"Surface.from_function({self._function.function!r})"
        (du, dv), (nu, nv) = self.degrees, self.pole_counts
        return f"Surface(degrees {du} x {dv}, {nu} x {nv} poles{', rational' if self.is_rational else ''})"

    @property
    def domain(self) -> np.ndarray:
        """Start and end of u, start and end of v, shape (2, 2)."""
        return self._get("domain", 4).reshape(2, 2)

    @property
    def degrees(self) -> tuple[int, int]:
        """In u and v."""
        return self._number("degree_u", ctypes.c_size_t), self._number("degree_v", ctypes.c_size_t)

    @property
    def pole_counts(self) -> tuple[int, int]:
        """In u and v."""
        return self._number("pole_count_u", ctypes.c_size_t), self._number("pole_count_v", ctypes.c_size_t)

    @property
    def knots(self) -> tuple[np.ndarray, np.ndarray]:
        """Copies of the knots in u and v."""
        (du, dv), (nu, nv) = self.degrees, self.pole_counts
        return self._knots("knots_u", nu + du + 1), self._knots("knots_v", nv + dv + 1)

    @property
    def poles(self) -> np.ndarray:
        """A copy, shape (nu, nv, 3)."""
        nu, nv = self.pole_counts
        return self._knots("poles", 3 * nu * nv).reshape(nu, nv, 3)

    @property
    def weights(self) -> np.ndarray:
        """A copy, shape (nu, nv); all 1 for a polynomial surface."""
        nu, nv = self.pole_counts
        return self._knots("weights", nu * nv).reshape(nu, nv)

    @property
    def is_closed(self) -> tuple[bool, bool]:
        """Whether it is closed in u and in v, as geometry."""
        return bool(self._number("is_closed_u", ctypes.c_int32)), bool(self._number("is_closed_v", ctypes.c_int32))

    @property
    def collapsed_edges(self) -> np.ndarray:
        """Which edges are a single point: at the start of u, the end of u, the start of v, the end of v; shape (4,), bool."""
        return self._get("collapsed_edges", 4, np.int32).astype(bool)

    def evaluate(self, uv: ArrayLike, derivatives: int = 0, sides: tuple[int, int] | None = None) -> np.ndarray:
        """The surface and its partial derivatives.

        uv           shape (..., 2), in the domain
        derivatives  highest total order d, at most 31
        sides        for u and for v: -1 the piece below a knot, +1 the one above; None: as `Curve.evaluate`
        returns      shape (..., 3) for d = 0, else (..., (d + 1)*(d + 2)/2, 3): S; Su, Sv; Suu, Suv, Svv; ...
        """
        order = integer("derivatives", derivatives, 0, 31)
        at = array("uv", uv)
        if at.ndim == 0 or at.shape[-1] != 2:
            raise ValueError(f"uv: the shape is {at.shape} and must be (..., 2)")
        terms = (order + 1) * (order + 2) // 2
        out = np.zeros((at.size // 2, terms, 3))
        if sides is not None:
            both = [integer("sides", side, -(2**31), 2**31 - 1) for side in sides]
            if len(both) != 2:
                raise ValueError(f"sides: {len(both)} numbers, and must be 2")
            for index, pair in enumerate(at.reshape(-1, 2).tolist()):
                self._call("evaluate_sided", *pair, *both, order, address(out) + index * 24 * terms)
        elif at.ndim == 1:
            self._call("evaluate", float(at[0]), float(at[1]), order, address(out))
        else:
            self._call("evaluate_many", address(at), at.size // 2, order, address(out))
        return out.reshape((*at.shape[:-1], 3) if order == 0 else (*at.shape[:-1], terms, 3))

    def normals(self, feet: Feet, points: ArrayLike | None = None) -> tuple[np.ndarray, np.ndarray | None, np.ndarray]:
        """The unit normal at each foot, in the direction of Su x Sv, and on which side the query lies.

        feet     Feet of shape (...), of this surface
        points   their queries, shape (..., 3); None: normals only
        returns  normals (..., 3), NaN where there is none; signed distances (...), positive on the normal's side, or None;
                 sums of `NormalFlag`, (...)
        """
        records = records_of(feet)
        asked = asked_of(records, points)
        normals, flags = np.zeros((*records.shape, 3)), np.zeros(records.shape, np.uint32)
        signed = None if asked is None else np.zeros(records.shape)
        self._call("normals", address(asked), address(records), records.size, address(normals), address(signed), address(flags))
        return normals, signed, flags

    def unwrap(self, previous: ArrayLike, uv: ArrayLike) -> np.ndarray:
        """The parameters plus the whole turns in closed directions that bring them nearest to the previous, unwrapped ones.

        previous, uv  shape (2,) each
        returns       shape (2,)
        """
        before, at, out = vector("previous", previous, 2), vector("uv", uv, 2), np.zeros(2)
        self._call("unwrap", address(before), address(at), address(out))
        return out


def asked_of(records: np.ndarray, points: Any) -> np.ndarray | None:
    """The queries of feet, packed doubles, one each."""
    if points is None:
        return None
    asked = Points(points, packed=True, floats=False)
    if asked.shape != records.shape:
        raise ValueError(f"points: the shape is {(*asked.shape, 3)}, and feet of shape {records.shape} need {(*records.shape, 3)}")
    return asked.rows
