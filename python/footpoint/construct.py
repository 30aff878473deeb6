"""Curves and surfaces made from numbers, points and other curves: interpolants, fits, conics, quadrics, swept, blended and skinned
surfaces, offsets.

Fits say how far the data points are from the result, with proof (`Distances`). Angles are in radians. `axes` are an origin, an axis Z and a
direction whose part across Z is X, shape (3, 3); None: the coordinate axes.

>>> import footpoint, numpy as np
>>> t = np.linspace(0, 6, 100)
>>> curve, distances = footpoint.construct.fit_curve(np.stack([np.cos(t), np.sin(t), t], -1), 1e-4)
>>> distances.worst <= 1e-4, distances.unproven
(True, 0)
"""

from __future__ import annotations

import ctypes
from enum import IntEnum
from typing import TYPE_CHECKING, Any, Callable, NamedTuple, Sequence

import numpy as np

from . import _library as lib
from ._query import address, array, integer, real, vector
from ._shapes import Curve, Surface, three_coordinates

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

__all__ = ["ArcForm", "Condition", "Distances", "QuadricKind", "Spacing", "Swept", "arc", "arc_through", "conic", "coons", "extruded",
           "ferguson", "fit_curve", "fit_grid", "fit_offset", "fit_surface", "gordon", "hyperbola", "interpolate", "interpolate_grid",
           "least_squares", "line", "offset", "parabola", "parameters", "plane", "quadric", "revolved", "ruled", "saddle", "skinned", "swept",
           "torus", "translational"]


class Spacing(IntEnum):
    """Parameters for points in order: steps as distances, as their square roots, or equal."""

    CHORDAL = 0
    CENTRIPETAL = 1
    UNIFORM = 2


class Condition(IntEnum):
    """The ends of an interpolant: as many poles as points, derivatives given, the natural spline, a closed curve."""

    FREE = 0
    TANGENTS = 1
    NATURAL = 2
    PERIODIC = 3


class ArcForm(IntEnum):
    """How arcs are written: degree 2 in pieces of at most a quarter turn, in half turns of 4 poles, in thirds; degree 3 in one piece of up to
    4 radians; degree 5 for a full turn in one piece."""

    QUARTERS = 0
    HALVES = 1
    THIRDS = 2
    CUBIC = 3
    QUINTIC = 4


class QuadricKind(IntEnum):
    """Distance from the axis and height along the parameter t of the profile: (cos, sin), (cosh, sinh), (sinh, cosh), (t, t^2), (t, t),
    (1, t)."""

    ELLIPSOID = 0
    ONE_SHEET = 1
    TWO_SHEETS = 2
    PARABOLOID = 3
    CONE = 4
    CYLINDER = 5


class Distances(NamedTuple):
    """How far the data points are from a shape, in the unit of the poles.

    worst        no data point is farther away
    at_least     proven: some data point is at least that far away, `worst` up to the accuracy of queries; 0 when feet were not asked for
    rms          root of the mean of the squares, to the places that were found
    worst_index  the data point with the distance `worst`
    unproven     data points that may be farther away than at_least: no nearer place was found, and none excluded
    """

    worst: float
    at_least: float
    rms: float
    worst_index: int
    unproven: int


class Swept(NamedTuple):
    """A swept surface, its proven error (no point is farther from the exact one), and the turn of the frame around a closed spine."""

    surface: Surface
    error: float
    holonomy: float


def _owned(kind: type, call: str, *arguments: Any) -> Any:
    """The shape whose handle a call writes to where `_OUT` stands."""
    out = ctypes.c_void_p()
    given = [ctypes.byref(out) if argument is _OUT else argument for argument in arguments]
    status = lib.call(call, *given)
    if status == lib.CANCELLED:
        raise lib.Cancelled("the fit was stopped")
    shape = kind.__new__(kind)
    shape._own(out.value)
    return shape


_OUT: Any = object()


def _points(points: ArrayLike, dimensions: int = 2) -> np.ndarray:
    return np.ascontiguousarray(three_coordinates(points, dimensions))


def _axes(axes: ArrayLike | None) -> np.ndarray | None:
    return None if axes is None else array("axes", axes, (3, 3))


def _optional(name: str, values: ArrayLike | None, shape: tuple[int, ...]) -> np.ndarray | None:
    return None if values is None else array(name, values, shape)


def _options(tolerance: float = 0.0, degrees: Sequence[int] = (3, 3), **others: Any) -> tuple[Any, list]:
    """fpt_fit_options, and what must live as long."""
    options = lib.FitOptions()
    lib.functions["fit_options_init"](ctypes.addressof(options), ctypes.sizeof(options))
    options.tolerance = real("tolerance", tolerance)
    options.degree_u, options.degree_v = integer("degree", degrees[0], 1, 31), integer("degree", degrees[1], 1, 31)
    kept: list = []
    stop: Callable[[], object] | None = others.pop("should_stop", None)
    if stop is not None:
        if not callable(stop):
            raise TypeError(f"should_stop: a function is needed, not {type(stop).__name__}")
        function = lib.StopFunction(lambda _user: int(bool(stop())))
        options.should_stop = function
        kept.append(function)
    for name, value in others.items():
        setattr(options, name, value)
    return options, kept


def _distances(result: Any) -> Distances:
    return Distances(result.worst, result.at_least, result.rms, result.worst_index, result.unproven)


def _fit(kind: type, call: str, options: Any, *before: Any) -> tuple[Any, Distances]:
    result = lib.FitResult()
    shape = _owned(kind, call, *before, ctypes.addressof(options), _OUT, ctypes.byref(result))
    return shape, _distances(result)


def parameters(points: ArrayLike, spacing: Spacing = Spacing.CHORDAL) -> np.ndarray:
    """Parameters from 0 to 1, shape (n,), for points in order, shape (n, 3) or (n, 2)."""
    rows = _points(points)
    out = np.zeros(len(rows))
    lib.call("fit_parameters", address(rows), len(rows), integer("spacing", spacing), address(out))
    return out


def interpolate(points: ArrayLike, degree: int = 3, parameters: ArrayLike | None = None, spacing: Spacing = Spacing.CHORDAL,
                tangents: tuple[ArrayLike | None, ArrayLike | None] | None = None, natural: bool = False, periodic: bool = False) -> Curve:
    """The curve through points in order.

    points      shape (n, 3) or (n, 2), n > degree (fewer with conditions)
    parameters  shape (n,), strictly increasing; (n + 1,) when periodic: the end of the turn. None: from the spacing
    tangents    derivatives at the first and the last point, shape (3,) each, None where free
    natural     the natural spline, for odd degrees
    periodic    a closed curve; the first point is not repeated
    """
    if (tangents is not None) + bool(natural) + bool(periodic) > 1:
        raise ValueError("tangents, natural and periodic exclude one another")
    rows = _points(points)
    condition = Condition.TANGENTS if tangents is not None else Condition.NATURAL if natural else Condition.PERIODIC if periodic else Condition.FREE
    given = np.full((2, 3), np.nan)
    for row, tangent in zip(given, tangents or ()):
        if tangent is not None:
            row[:] = vector("tangents", tangent)
    at = _optional("parameters", parameters, (len(rows) + bool(periodic),))
    options, _ = _options(degrees=(degree, 3), condition=condition, spacing=integer("spacing", spacing), tangents=address(given))
    return _owned(Curve, "curve_interpolate", address(rows), len(rows), address(at), ctypes.addressof(options), _OUT)


def least_squares(degree: int, knots: ArrayLike, parameters: ArrayLike, points: ArrayLike, free_ends: bool = False) -> tuple[Curve, Distances]:
    """The curve on given knots (repeats written out) that is nearest to points at parameters, in the sense of least squares; ends are
    interpolated unless free. Distances are those at the parameters."""
    rows = _points(points)
    at, values = array("parameters", parameters, (len(rows),)), array("knots", knots, (None,))
    result = lib.FitResult()
    curve = _owned(Curve, "curve_least_squares", address(rows), len(rows), address(at), integer("degree", degree), address(values), len(values),
                   int(bool(free_ends)), _OUT, ctypes.byref(result))
    return curve, _distances(result)


def fit_curve(points: ArrayLike, tolerance: float, degree: int = 3, parameters: ArrayLike | None = None, spacing: Spacing = Spacing.CHORDAL,
              max_poles: int = 0, keep_parameters: bool = False, threads: int = 0,
              should_stop: Callable[[], object] | None = None) -> tuple[Curve, Distances]:
    """A curve near points in order, from the first to the last: knots are added until no point is farther away than the tolerance, each point
    fitted at its foot. Where that is not reached `Distances.worst` is above the tolerance."""
    rows = _points(points)
    at = _optional("parameters", parameters, (len(rows),))
    options, _kept = _options(tolerance, (degree, 3), spacing=integer("spacing", spacing), max_poles=integer("max_poles", max_poles),
                              keep_parameters=int(bool(keep_parameters)), threads=integer("threads", threads), should_stop=should_stop)
    return _fit(Curve, "curve_fit", options, address(rows), len(rows), address(at))


def interpolate_grid(points: ArrayLike, degrees: Sequence[int] = (3, 3), spacing: Spacing = Spacing.CHORDAL) -> Surface:
    """The surface through a grid of points, shape (nu, nv, 3)."""
    rows = _points(points, 3)
    options, _ = _options(degrees=degrees, spacing=integer("spacing", spacing))
    return _owned(Surface, "surface_interpolate", address(rows), *rows.shape[:2], ctypes.addressof(options), _OUT)


def fit_grid(points: ArrayLike, tolerance: float, degrees: Sequence[int] = (3, 3), spacing: Spacing = Spacing.CHORDAL, max_poles: int = 0,
             certify: bool = True, threads: int = 0, should_stop: Callable[[], object] | None = None) -> tuple[Surface, Distances]:
    """A surface near a grid of points, shape (nu, nv, 3): knots are added until no point is farther away than the tolerance at its parameters.

    certify  find how far the points are from their feet, and prove how far the worst is; False: distances are those at the parameters
    """
    rows = _points(points, 3)
    options, _kept = _options(tolerance, degrees, spacing=integer("spacing", spacing), max_poles=integer("max_poles", max_poles),
                              certify=int(bool(certify)), threads=integer("threads", threads), should_stop=should_stop)
    return _fit(Surface, "surface_fit_grid", options, address(rows), *rows.shape[:2])


def fit_surface(points: ArrayLike, tolerance: float, degrees: Sequence[int] = (3, 3), parameters: ArrayLike | None = None, max_poles: int = 0,
                keep_parameters: bool = False, threads: int = 0,
                should_stop: Callable[[], object] | None = None) -> tuple[Surface, Distances]:
    """A surface near points in any order, shape (n, 3): knots are added until no point is farther away than the tolerance, each point fitted at
    its foot.

    parameters  shape (n, 2), where the search begins; their box is the domain. None: in the plane nearest to the points
    """
    rows = _points(points)
    at = _optional("parameters", parameters, (len(rows), 2))
    options, _kept = _options(tolerance, degrees, max_poles=integer("max_poles", max_poles), keep_parameters=int(bool(keep_parameters)),
                              threads=integer("threads", threads), should_stop=should_stop)
    return _fit(Surface, "surface_fit", options, address(rows), len(rows), address(at))


def line(start: ArrayLike, end: ArrayLike) -> Curve:
    """The segment between two points, by its length from 0 on."""
    a, b = vector("start", start), vector("end", end)
    return _owned(Curve, "curve_line", address(a), address(b), _OUT)


def arc(radius: float, start: float = 0.0, end: float = 2 * np.pi, axes: ArrayLike | None = None, form: ArcForm = ArcForm.QUARTERS,
        radius_y: float | None = None) -> Curve:
    """The arc of a circle, or with `radius_y` of an ellipse, between two angles from X."""
    place, other = _axes(axes), radius if radius_y is None else radius_y
    return _owned(Curve, "curve_arc", address(place), real("radius", radius), real("radius_y", other), real("start", start), real("end", end),
                  integer("form", form), _OUT)


def arc_through(points: ArrayLike) -> Curve:
    """The arc of a circle through three points, shape (3, 3), in their order."""
    rows = array("points", points, (3, 3))
    return _owned(Curve, "curve_arc_through", address(rows), _OUT)


def conic(poles: ArrayLike, rho: float) -> Curve:
    """The conic over three poles, shape (3, 3), with a shape factor between 0 and 1: ellipse below 1/2, parabola, hyperbola above."""
    rows = array("poles", poles, (3, 3))
    return _owned(Curve, "curve_conic", address(rows), real("rho", rho), _OUT)


def parabola(focal: float, start: float, end: float, axes: ArrayLike | None = None) -> Curve:
    """The arc of origin + t^2 / (4 focal) X + t Y between two t, its parameters."""
    place = _axes(axes)
    return _owned(Curve, "curve_parabola", address(place), real("focal", focal), real("start", start), real("end", end), _OUT)


def hyperbola(radius_x: float, radius_y: float, start: float, end: float, axes: ArrayLike | None = None) -> Curve:
    """The arc of origin + radius_x cosh t X + radius_y sinh t Y between two t."""
    place = _axes(axes)
    return _owned(Curve, "curve_hyperbola", address(place), real("radius_x", radius_x), real("radius_y", radius_y), real("start", start),
                  real("end", end), _OUT)


def quadric(kind: QuadricKind, semi_axes: ArrayLike, angles: ArrayLike, profile: ArrayLike, axes: ArrayLike | None = None,
            form: ArcForm = ArcForm.QUARTERS) -> Surface:
    """The part of a quadric between two angles about its axis (u) and two t of its profile (v).

    semi_axes  across along X, across along Y, along the axis
    """
    place, half, turn, way = _axes(axes), vector("semi_axes", semi_axes), vector("angles", angles, 2), vector("profile", profile, 2)
    return _owned(Surface, "surface_quadric", integer("kind", kind), address(place), address(half), address(turn), address(way),
                  integer("form", form), _OUT)


def saddle(radius_x: float, radius_y: float, domain: ArrayLike, axes: ArrayLike | None = None) -> Surface:
    """The hyperbolic paraboloid z = x^2 / radius_x^2 - y^2 / radius_y^2 over x0, x1, y0, y1."""
    place, box = _axes(axes), vector("domain", domain, 4)
    return _owned(Surface, "surface_saddle", address(place), real("radius_x", radius_x), real("radius_y", radius_y), address(box), _OUT)


def plane(domain: ArrayLike, axes: ArrayLike | None = None) -> Surface:
    """The rectangle origin + u X + v Y over u0, u1, v0, v1."""
    place, box = _axes(axes), vector("domain", domain, 4)
    return _owned(Surface, "surface_plane", address(place), address(box), _OUT)


def torus(major: float, minor: float, angles_u: ArrayLike = (0, 2 * np.pi), angles_v: ArrayLike = (0, 2 * np.pi),
          axes: ArrayLike | None = None, form: ArcForm = ArcForm.QUARTERS) -> Surface:
    """A torus or a part of it: u about the axis, v about the tube."""
    place, u, v = _axes(axes), vector("angles_u", angles_u, 2), vector("angles_v", angles_v, 2)
    return _owned(Surface, "surface_torus", address(place), real("major", major), real("minor", minor), address(u), address(v),
                  integer("form", form), _OUT)


def _spline(name: str, curve: Curve) -> int:
    if not isinstance(curve, Curve):
        raise TypeError(f"{name}: a Curve is needed, not {type(curve).__name__}")
    return curve._handle


def _handles(name: str, curves: Sequence[Curve]) -> tuple[Any, list]:
    """An array of handles; the curves live as long as the list."""
    kept = list(curves)
    return (ctypes.c_void_p * max(len(kept), 1))(*[_spline(name, curve) for curve in kept]), kept


def ruled(first: Curve, second: Curve) -> Surface:
    """The lines between points of two curves at equal parameters: v from 0 on the first to 1 on the second."""
    return _owned(Surface, "surface_ruled", _spline("first", first), _spline("second", second), _OUT)


def extruded(curve: Curve, direction: ArrayLike) -> Surface:
    """C(u) + v direction, v from 0 to 1."""
    way = vector("direction", direction)
    return _owned(Surface, "surface_extruded", _spline("curve", curve), address(way), _OUT)


def revolved(curve: Curve, origin: ArrayLike, axis: ArrayLike, angles: ArrayLike = (0, 2 * np.pi), form: ArcForm = ArcForm.QUARTERS) -> Surface:
    """A curve turned about an axis: u the angle over [0, 1], v the curve's parameter."""
    place, way, turn = vector("origin", origin), vector("axis", axis), vector("angles", angles, 2)
    return _owned(Surface, "surface_revolved", _spline("curve", curve), address(place), address(way), address(turn), integer("form", form), _OUT)


def translational(curve: Curve, spine: Curve) -> Surface:
    """A curve carried along another without turning."""
    return _owned(Surface, "surface_translational", _spline("curve", curve), _spline("spine", spine), _OUT)


def coons(borders: Sequence[Curve], slopes: Sequence[Curve] | None = None) -> Surface:
    """The Coons patch of four borders, at u0, u1 (curves in v), v0, v1 (curves in u).

    slopes  None: bilinearly blended; four curves whose points are the derivatives across the borders: bicubically blended
    """
    if len(borders) != 4 or (slopes is not None and len(slopes) != 4):
        raise ValueError("borders: four curves are needed, and four slopes or none")
    four, _borders = _handles("borders", borders)
    if slopes is None:
        return _owned(Surface, "surface_coons", ctypes.addressof(four), _OUT)
    across, _slopes = _handles("slopes", slopes)
    return _owned(Surface, "surface_coons_bicubic", ctypes.addressof(four), ctypes.addressof(across), _OUT)


def ferguson(points: ArrayLike, slopes_u: ArrayLike, slopes_v: ArrayLike, twists: ArrayLike | None = None) -> Surface:
    """The bicubic patch of corners, slopes and twists, shape (2, 2, 3) each: entry (i, j) at u = i, v = j."""
    given = [array(name, values, (2, 2, 3)) for name, values in (("points", points), ("slopes_u", slopes_u), ("slopes_v", slopes_v))]
    twist = None if twists is None else array("twists", twists, (2, 2, 3))
    return _owned(Surface, "surface_ferguson", *map(address, given), address(twist), _OUT)


def gordon(curves_u: Sequence[Curve], parameters_v: ArrayLike, curves_v: Sequence[Curve], parameters_u: ArrayLike) -> Surface:
    """The surface through a network: curves_u[l] at v = parameters_v[l], curves_v[k] at u = parameters_u[k]."""
    in_u, _u = _handles("curves_u", curves_u)
    in_v, _v = _handles("curves_v", curves_v)
    at_v, at_u = array("parameters_v", parameters_v, (len(_u),)), array("parameters_u", parameters_u, (len(_v),))
    return _owned(Surface, "surface_gordon", ctypes.addressof(in_u), address(at_v), len(_u), ctypes.addressof(in_v), address(at_u), len(_v), _OUT)


def skinned(sections: Sequence[Curve], degree: int = 3, parameters: ArrayLike | None = None) -> Surface:
    """The surface through sections: u along them, v across, of a degree less than their number."""
    handles, kept = _handles("sections", sections)
    at = _optional("parameters", parameters, (len(kept),))
    return _owned(Surface, "surface_skinned", ctypes.addressof(handles), len(kept), integer("degree", degree), address(at), _OUT)


def swept(profile: Curve, spine: Curve, tolerance: float, degree: int = 3, twist: float = 0.0, close: bool = False, max_poles: int = 0) -> Swept:
    """A profile carried along a spine in a rotation minimising frame, from where it is relative to the spine's begin.

    twist  turn about the tangent in all, in radians
    close  on a closed spine: turn besides so that the end meets the begin
    """
    options = lib.SweepOptions()
    lib.functions["sweep_options_init"](ctypes.addressof(options), ctypes.sizeof(options))
    options.tolerance, options.twist = real("tolerance", tolerance), real("twist", twist)
    options.degree, options.close, options.max_poles = integer("degree", degree, 1, 31), int(bool(close)), integer("max_poles", max_poles)
    error, holonomy = ctypes.c_double(), ctypes.c_double()
    surface = _owned(Surface, "surface_swept", _spline("profile", profile), _spline("spine", spine), ctypes.addressof(options), _OUT,
                     ctypes.byref(error), ctypes.byref(holonomy))
    return Swept(surface, error.value, holonomy.value)


def offset(shape: Curve | Surface, distance: float, plane_normal: ArrayLike | None = None) -> Any:
    """The exact offset: of a surface along its normal, of a plane curve to the right of its direction seen from the tip of `plane_normal`. It
    has no poles: what needs them raises NotImplementedError."""
    if isinstance(shape, Surface):
        made = _owned(Surface, "surface_offset", shape._handle, real("distance", distance), _OUT)
    else:
        up = vector("plane_normal", (0, 0, 1) if plane_normal is None else plane_normal)
        made = _owned(Curve, "curve_offset", _spline("shape", shape), real("distance", distance), address(up), _OUT)
    made._indexed = True  # a function has no index: a fork can use the handle as it is
    return made


def fit_offset(shape: Curve | Surface, distance: float, tolerance: float, degree: int | Sequence[int] = 3,
               plane_normal: ArrayLike | None = None) -> tuple[Any, float, float]:
    """The offset as a spline, its greatest distance from the exact one at samples, and the proven one (infinite when not proven)."""
    measured, proven = ctypes.c_double(), ctypes.c_double()
    errors = ctypes.byref(measured), ctypes.byref(proven)
    if isinstance(shape, Surface):
        orders = [degree, degree] if isinstance(degree, int) else list(degree)
        made = _owned(Surface, "surface_offset_fit", shape._handle, real("distance", distance), *(integer("degree", d) for d in orders),
                      real("tolerance", tolerance), _OUT, *errors)
    else:
        up = vector("plane_normal", (0, 0, 1) if plane_normal is None else plane_normal)
        made = _owned(Curve, "curve_offset_fit", _spline("shape", shape), real("distance", distance), address(up), integer("degree", degree),
                      real("tolerance", tolerance), _OUT, *errors)
    return made, measured.value, proven.value
