"""Weights from wishes: how near a rational curve or surface should come to its poles, and other edits of weights.

A wish is a distance of the shape from a pole, in the unit of the poles. Wishes come as a mapping: ``{pole: distance}``, on surfaces
``{(i, j): distance}``, poles counted from 0. `refine` finds weights whose shape really has the wished distances and proves it; `general`,
`interpolated` and `network` are the published formulas (Wang and Li, 2001), which do so approximately. Shapes never change: each gives
a `Report` with a new shape. Curves and surfaces from functions have no weights: NotImplementedError.

>>> import footpoint
>>> corner = footpoint.Curve.from_poles(2, [[1, 0], [1, 1], [0, 1]])
>>> report = footpoint.weights.refine(corner, {1: 2**0.5 - 1})
>>> report.is_met, bool(abs(report.weights[1] - 0.5**0.5) < 1e-12)
(True, True)
"""

from __future__ import annotations

import ctypes
from dataclasses import dataclass
from enum import IntEnum, IntFlag
from typing import TYPE_CHECKING, Any, Iterable, Mapping, NamedTuple

import numpy as np

from . import _library as lib
from ._feet import Feet
from ._query import Call, address, array, integer, real, vector
from ._shapes import Curve, Surface, three_coordinates

if TYPE_CHECKING:
    from numpy.typing import ArrayLike
    from typing_extensions import Unpack

    from ._query import WeightsOptions

__all__ = ["Conic", "Constraint", "ConstraintKind", "Report", "State", "Unit", "WeightFlag", "bound", "conic", "general", "interpolated",
           "move_point", "network", "normalise", "of_eccentricity", "of_rho", "positive_form", "refine", "standard_form", "through_point"]


class State(IntEnum):
    """What came of a wish."""

    NONE = 0
    MET = 1
    NOT_MET = 2
    IMPOSSIBLE = 3


class WeightFlag(IntFlag):
    """The bits of a pole's flags: on its chord (weight 1), first guess limited by the range, weight at an end of the range, network not
    trained to the end."""

    ON_CHORD = 1
    LIMITED = 2
    AT_LIMIT = 4
    UNTRAINED = 8


class ConstraintKind(IntEnum):
    """What a constraint asks."""

    POINT_AT = 0
    POINT = 1
    TANGENT_AT = 2
    TANGENT_KEPT = 3


class Unit(IntEnum):
    """What is 1 after `normalise`: the first weight, the greatest, the product of least and greatest."""

    FIRST = 0
    GREATEST = 1
    MIDDLE = 2


POLE = np.dtype([("wish", "f8"), ("chord_distance", "f8"), ("first_guess", "f8"), ("weight", "f8"), ("distance", "f8"), ("lower_bound", "f8"),
                 ("u", "f8"), ("v", "f8"), ("state", "u4"), ("flags", "u4")])
OUTCOME = np.dtype([("error", "f8"), ("u", "f8"), ("v", "f8"), ("met", "u4"), ("reserved", "u4")])
assert POLE.itemsize == ctypes.sizeof(lib.WeightsPole) and OUTCOME.itemsize == ctypes.sizeof(lib.WeightsOutcome)


class Constraint(NamedTuple):
    """What a shape must do besides, for `refine`. Made by its class methods."""

    kind: int
    at: Any = (0.0, 0.0)
    vector: Any = (0.0, 0.0, 0.0)

    @classmethod
    def point_at(cls, at: ArrayLike, point: ArrayLike) -> "Constraint":
        """The point at u, on surfaces at (u, v), is this one, shape (3,)."""
        return cls(ConstraintKind.POINT_AT, at, point)

    @classmethod
    def through(cls, point: ArrayLike) -> "Constraint":
        """Some point of the shape is this one, shape (3,)."""
        return cls(ConstraintKind.POINT, vector=point)

    @classmethod
    def tangent_at(cls, u: float, direction: ArrayLike) -> "Constraint":
        """The tangent of the curve at u has this direction, shape (3,), of any length but 0. Curves only."""
        return cls(ConstraintKind.TANGENT_AT, u, direction)

    @classmethod
    def tangent_kept(cls, u: float) -> "Constraint":
        """The tangent of the curve at u keeps its direction. Curves only."""
        return cls(ConstraintKind.TANGENT_KEPT, u)


@dataclass(frozen=True, eq=False)
class Report:
    """What a method found.

    shape        the curve or surface with the weights found
    weights      those, shape (n,), on surfaces (nu, nv)
    poles        records, one a pole, shape (n,), on surfaces (nu, nv): wish (NaN: none), chord_distance (of the pole from its chord),
                 first_guess (weight of the published formula), weight, distance (of the pole from the shape), lower_bound (proven:
                 nothing of the shape is nearer), u, v (of the nearest point), state (a `State`), flags (sum of `WeightFlag`)
    constraints  records, one a constraint: error (a length, or the sine of the angle; 2: opposite), u, v, met
    tolerance    the length within which a distance is the wished one
    iterations   training steps of a network, shapes measured by `refine`; 0 for a formula
    starts       searches that `refine` began
    is_met       whether every wish and every constraint is met
    met, not_met, impossible
                 how many wishes are proven met; not met, or not proven so; proven impossible within the range of weights
    """

    shape: Curve | Surface
    weights: np.ndarray
    poles: np.ndarray
    constraints: np.ndarray
    tolerance: float
    iterations: int
    starts: int
    is_met: bool
    met: int
    not_met: int
    impossible: int

    @property
    def states(self) -> np.ndarray:
        """What came of each pole's wish, an array of `State`, shape as `poles`."""
        found = np.array([State(state) for state in self.poles["state"].flat] + [None], object)
        return found[:-1].reshape(self.poles.shape)

    def __repr__(self) -> str:
        return f"Report({self.shape!r}, {self.met} wishes met, {self.not_met} not met, {self.impossible} impossible)"


class Conic(NamedTuple):
    """The shape of a conic over three poles.

    weight        the middle weight when both end weights are 1
    rho           how far the curve goes from the middle of the chord to the middle pole, 0 to 1: weight / (1 + weight)
    eccentricity  0 circle, less than 1 ellipse, 1 parabola, more hyperbola; near 0 good to about 1e-8
    """

    weight: float
    rho: float
    eccentricity: float


def general(curve: Curve, lambdas: ArrayLike, **options: Unpack[WeightsOptions]) -> Report:
    """The general formula: each pole's weight is 1/lambda - 1 for the relative distance lambda of the curve from it (distance over the
    pole's distance from its chord). Poles on their chord, as clamped ends, have weight 1.

    lambdas  shape (n,), each between 0 and 1, both excluded
    options  see `WeightsOptions`; weight_min, weight_max and tolerance count
    """
    given = array("lambdas", lambdas, (None,))
    return _report("general", _is_curve(curve), (address(given), len(given)), options)


def interpolated(curve: Curve, first_distance: float, last_distance: float, **options: Unpack[WeightsOptions]) -> Report:
    """Linear interpolation: distances run evenly, in the order of the poles; weights as in `general`. What no weight of the range gives
    takes the nearest one (`WeightFlag.LIMITED`).

    first_distance, last_distance  of the first and the last pole, lengths >= 0; the run may rise, fall or stay
    options                        see `WeightsOptions`; weight_min, weight_max and tolerance count
    """
    ends = real("first_distance", first_distance), real("last_distance", last_distance)
    return _report("interpolated", _is_curve(curve), ends, options)


def network(curve: Curve, wishes: Mapping[int, float], min_distance: float, max_distance: float, **options: Unpack[WeightsOptions]) -> Report:
    """The embedded network: wished distances for some poles; the distances of all others, by the formula, stay within a range. The
    same inputs and seed give the same bits.

    wishes        {pole: distance}, distances within the range; {}: all weights are random within it
    min_distance, max_distance
                  the range, lengths >= 0
    options       see `WeightsOptions`; weight_min, weight_max, tolerance, seed and steps count
    """
    numbers, distances = _wishes(wishes, _is_curve(curve))
    arguments = address(numbers), address(distances), len(numbers), real("min_distance", min_distance), real("max_distance", max_distance)
    return _report("network", curve, arguments, options)


def refine(shape: Curve | Surface, wishes: Mapping[Any, float], constraints: Iterable[Constraint] = (), **options: Unpack[WeightsOptions]) -> Report:
    """Weights whose shape really has the wished distances from its poles and meets the constraints; other weights are as near 1 as they
    can be. A wish that is not met or proven impossible is reported, with the best weights found. About a millisecond for a curve of
    10 poles; what cannot be met takes up to `starts` searches.

    wishes       {pole: distance}, on surfaces {(i, j): distance}, lengths >= 0; {}: constraints only
    constraints  see `Constraint`; those of tangents on curves only
    options      see `WeightsOptions`; all but steps count
    """
    if not isinstance(shape, (Curve, Surface)):
        raise TypeError(f"shape: a Curve or Surface is needed, not {type(shape).__name__}")
    numbers, distances = _wishes(wishes, shape)
    asked = _constraints(constraints, shape._width)
    arguments = address(numbers), address(distances), len(numbers), ctypes.addressof(asked), len(asked)
    return _report(f"refine_{shape._kind}", shape, arguments, options, len(asked))


def move_point(curve: Curve, u: float, pole: int, distance: float) -> float:
    """The weight of a pole that moves the point at u towards it by a distance (negative: away from it); the other weights stay.

    distance  a length less than that from the point to the pole
    """
    out = ctypes.c_double()
    lib.call("weights_move_point", _is_curve(curve)._handle, real("u", u), _number("pole", pole), real("distance", distance), ctypes.byref(out))
    return out.value


def through_point(curve: Curve, pole: int, point: ArrayLike, tolerance: float = 0.0) -> tuple[float, Feet]:
    """The weight of a pole with which the curve passes through a point, and the nearest point of that curve; the other weights stay. Of
    several weights the one that changes least. ValueError when no weight of that pole takes the curve there.

    point      shape (3,)
    tolerance  length: how far the curve may pass; 0: 1e-7 x the diagonal of the poles' box
    """
    at, out, foot = vector("point", point), ctypes.c_double(), Feet()
    lib.call("weights_through_point", _is_curve(curve)._handle, _number("pole", pole), address(at), real("tolerance", tolerance),
             ctypes.byref(out), address(foot))
    return out.value, foot


def conic(poles: ArrayLike, weights: ArrayLike) -> Conic:
    """The shape of the conic over three poles.

    poles    shape (3, 3) or (3, 2), not in one line
    weights  shape (3,), positive
    """
    corners, given, out = _three(poles), vector("weights", weights), lib.WeightsConicShape()
    lib.call("weights_conic", address(corners), address(given), ctypes.addressof(out))
    return Conic(out.weight, out.rho, out.eccentricity)


def of_rho(rho: float) -> float:
    """The middle weight of a conic with end weights 1 for a shape factor between 0 and 1: rho / (1 - rho)."""
    out = ctypes.c_double()
    lib.call("weights_of_rho", real("rho", rho), ctypes.byref(out))
    return out.value


def of_eccentricity(poles: ArrayLike, eccentricity: float) -> np.ndarray:
    """The middle weights with which the conic over three poles, end weights 1, has an eccentricity: none, one or two, rising.

    poles         shape (3, 3) or (3, 2), not in one line
    eccentricity  >= 0; a circle (0) needs legs of equal length
    returns       shape (k,), k = 0, 1 or 2
    """
    corners, out, count = _three(poles), np.zeros(2), ctypes.c_size_t()
    lib.call("weights_of_eccentricity", address(corners), real("eccentricity", eccentricity), address(out), ctypes.byref(count))
    return out[: count.value]


def normalise(weights: ArrayLike, unit: int = Unit.FIRST) -> np.ndarray:
    """Weights divided by one number: the same shape.

    weights  shape (...), 1e-100 to 1e100
    unit     a `Unit`
    """
    given = array("weights", weights)
    out = np.zeros(given.shape)
    lib.call("weights_normalise", address(given), given.size, integer("unit", unit), address(out))
    return out


def bound(weights: ArrayLike, ratio: float) -> np.ndarray:
    """Weights whose greatest is at most `ratio` (>= 1) times the least; those outside move to the ends of a range in the middle. The shape
    changes; `standard_form` may lessen the spread without that.

    weights  shape (...), 1e-100 to 1e100
    """
    given = array("weights", weights)
    out = np.zeros(given.shape)
    lib.call("weights_bound", address(given), given.size, real("ratio", ratio), address(out))
    return out


def standard_form(curve: Curve) -> Curve:
    """The same curve with both end weights 1: a rational change of the parameter, same poles and domain, other weights and inner knots.
    NotImplementedError when its ends are not clamped."""
    return _made(Curve, "weights_standard_form", _is_curve(curve)._handle)


def positive_form(degree: int, knots: ArrayLike, poles: ArrayLike) -> Curve:
    """A curve with positive weights from homogeneous data whose weights may be zero or negative: the same curve, with more poles where
    that is needed. NotImplementedError, with the parameter, when the denominator vanishes or comes too near to 0 to tell.

    degree  1 to 31
    knots   shape (n + degree + 1,), repeats written out
    poles   shape (n, 4): wx, wy, wz, w, the coordinates multiplied by the weight
    """
    order, places, rows = integer("degree", degree), array("knots", knots, (None,)), array("poles", poles, (None, 4))
    if len(places) != len(rows) + order + 1:
        raise ValueError(f"knots: {len(places)} numbers, and {len(rows)} poles of degree {order} need {len(rows) + order + 1}")
    return _made(Curve, "weights_positive_form", order, len(rows), address(places), address(rows))


def _is_curve(curve: Any) -> Curve:
    if not isinstance(curve, Curve):
        raise TypeError(f"curve: a Curve is needed, not {type(curve).__name__}")
    return curve


def _number(name: str, value: Any) -> int:
    return integer(name, value, 0, 2**63 - 1)


def _three(poles: Any) -> np.ndarray:
    corners = three_coordinates(poles, 2)
    if len(corners) != 3:
        raise ValueError(f"poles: there are {len(corners)}, and must be 3")
    return corners


def _wishes(wishes: Any, shape: Curve | Surface) -> tuple[np.ndarray, np.ndarray]:
    """Numbers of poles and distances."""
    if not isinstance(wishes, Mapping):
        raise TypeError(f"wishes: a mapping from poles to distances is needed, not {type(wishes).__name__}")
    numbers = np.zeros(len(wishes), np.uintp)
    counts = shape.pole_counts if isinstance(shape, Surface) else None
    for index, pole in enumerate(wishes):
        if counts is None:
            numbers[index] = _number(f"wishes: pole {pole!r:.40}", pole)
            continue
        if not isinstance(pole, tuple) or len(pole) != 2:
            raise TypeError(f"wishes: a pole of a surface is a pair (i, j), not {pole!r:.40}")
        i, j = (integer(f"wishes: pole {pole!r:.40}", part, 0, count - 1) for part, count in zip(pole, counts))
        numbers[index] = i * counts[1] + j
    distances = np.array([real(f"wishes: pole {pole!r:.40}", distance) for pole, distance in wishes.items()], np.float64)
    return numbers, distances


def _constraints(constraints: Any, width: int) -> ctypes.Array:
    try:
        given = list(constraints)
    except TypeError:
        raise TypeError(f"constraints: an iterable of Constraint is needed, not {type(constraints).__name__}") from None
    rows = (lib.WeightsConstraint * len(given))()
    for index, (row, one) in enumerate(zip(rows, given)):
        name = f"constraints: constraint {index}"
        if not isinstance(one, Constraint):
            raise TypeError(f"{name} is a {type(one).__name__}, not a Constraint")
        row.kind = integer(name, one.kind)
        if row.kind != ConstraintKind.POINT:
            at = array(name, one.at).reshape(-1)
            if len(at) != width:
                raise ValueError(f"{name}: {len(at)} parameters, and must be {width}")
            row.u, row.v = (*at.tolist(), 0.0)[:2]
        if row.kind != ConstraintKind.TANGENT_KEPT:
            row.vector[:] = vector(name, one.vector).tolist()
    return rows


def _made(kind: type, name: str, *arguments: Any) -> Any:
    """A curve or surface that the library made."""
    out = ctypes.c_void_p()
    lib.call(name, *arguments, ctypes.byref(out))
    shape = kind.__new__(kind)
    shape._own(out.value)
    return shape


def _report(name: str, shape: Curve | Surface, arguments: tuple, options: Any, constraints: int = 0) -> Report:
    call = Call(options, shape._kind, struct_type=lib.WeightsOptions)
    out = ctypes.c_void_p()
    status = lib.call(f"weights_{name}", shape._handle, *arguments, call.pointer, ctypes.byref(out))
    try:
        call.finish(status)
        return _taken(out, Curve if isinstance(shape, Curve) else Surface, constraints)
    finally:
        lib.functions["weights_report_free"](out)


def _taken(handle: ctypes.c_void_p, kind: Any, constraint_count: int) -> Report:
    """Copies a report out of its handle."""
    count, summary = ctypes.c_size_t(), lib.WeightsSummary()
    lib.call("weights_report_pole_count", handle, ctypes.byref(count))
    lib.call("weights_report_summary", handle, ctypes.addressof(summary))
    weights, poles, outcomes = np.zeros(count.value), np.zeros(count.value, POLE), np.zeros(constraint_count, OUTCOME)
    lib.call("weights_report_weights", handle, len(weights), address(weights))
    for name, rows in (("pole", poles), ("constraint", outcomes)):
        for index in range(len(rows)):
            lib.call(f"weights_report_{name}", handle, index, address(rows) + index * rows.itemsize)
    shape = _made(kind, f"weights_report_{kind._kind}", handle)
    if kind is Surface:
        weights, poles = weights.reshape(shape.pole_counts), poles.reshape(shape.pole_counts)
    return Report(shape, weights, poles, outcomes, summary.tolerance, summary.iterations, summary.starts, bool(summary.is_met), summary.met,
                  summary.not_met, summary.impossible)
