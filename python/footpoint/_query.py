"""Arguments on their way to C: numbers and arrays checked, options filled, callbacks guarded.

Arrays are handed over where they lie whenever their layout allows it. ctypes cuts integers silently, so their range is checked
here; all other checks are those of the library.
"""

from __future__ import annotations

import ctypes
import operator
import struct
import threading
import time
from functools import partial
from typing import TYPE_CHECKING, Any, Callable, TypedDict

import numpy as np

from . import _library as lib

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from ._feet import Feet


class QueryOptions(TypedDict, total=False):
    """The keywords that every query takes.

    tolerance    length: how far a point may be from the shape to count as on it; 0: 1e-7 x the diagonal of the shape's box
    accuracy     length: the asked-for distance - lower_bound; 0: 1e-10 x the diagonal
    method       a `Method`: the local iteration
    scope        a `Scope`: proven over the whole shape, or one local iteration
    hints        start parameters, shape (n, 2), on curves (n,); NaN: none for this query
    domain       u0, u1, v0, v1 (curves: u0, u1): only answers inside
    threads      0: all cores
    budget       most nodes and subdivisions per query; 0: the default
    should_stop  called without arguments now and then; a true result ends the call with `Cancelled`
    progress     True: a tqdm bar; or a function of (done, total), called at most fifty times a second and at the end
    trace        a function of (query, step, u, v, residual), told each iteration; forces one thread
    """

    tolerance: float
    accuracy: float
    method: int
    scope: int
    hints: "ArrayLike | None"
    domain: "ArrayLike | None"
    threads: int
    budget: int
    should_stop: "Callable[[], object] | None"
    progress: "bool | Callable[[int, int], object] | None"
    trace: "Callable[[int, int, float, float, float], object] | None"


def integer(name: str, value: Any, least: int = 0, most: int = 2**32 - 1) -> int:
    """An integer in range."""
    try:
        number = operator.index(value)
    except TypeError:
        raise TypeError(f"{name}: an integer is needed, not {type(value).__name__}") from None
    if not least <= number <= most:
        raise ValueError(f"{name}: {number} is not between {least} and {most}")
    return number


def real(name: str, value: Any) -> float:
    """A float."""
    try:
        return float(value)
    except (TypeError, ValueError, OverflowError):
        raise TypeError(f"{name}: a number is needed, not {value!r:.60}") from None


def array(name: str, values: Any, shape: tuple[int | None, ...] | None = None, dtype: Any = np.float64) -> np.ndarray:
    """A packed array of numbers; None in `shape` is any length."""
    result = np.asarray(values)
    allowed = "fiu" if np.dtype(dtype).kind == "f" else "iu"
    if result.size and result.dtype.kind not in allowed:
        raise TypeError(f"{name}: numbers are needed, not {result.dtype}")
    if shape is not None and (result.ndim != len(shape) or any(k not in (None, n) for k, n in zip(shape, result.shape))):
        wanted = ", ".join("n" if k is None else str(k) for k in shape) + ("," if len(shape) == 1 else "")
        raise ValueError(f"{name}: the shape is {result.shape} and must be ({wanted})")
    if np.dtype(dtype).kind == "u" and result.size and result.dtype != dtype:
        if result.min() < 0 or result.max() > np.iinfo(dtype).max:
            raise ValueError(f"{name}: a number is not between 0 and {np.iinfo(dtype).max}")
    return np.ascontiguousarray(result, dtype).reshape(result.shape)


def vector(name: str, values: Any, length: int = 3) -> np.ndarray:
    """A packed array of a few numbers."""
    return array(name, values, (length,))


def address(values: np.ndarray | None) -> int | None:
    """Where an array lies."""
    return None if values is None else values.__array_interface__["data"][0]


class Points:
    """Query points as C wants them: doubles or floats, a stride, no copy when the coordinates of a point are adjacent."""

    def __init__(self, points: Any, packed: bool = False, floats: bool = True):
        given = np.asarray(points)
        if given.dtype.kind not in "fiu":
            raise TypeError(f"points: numbers are needed, not {given.dtype}")
        if given.ndim == 0 or given.shape[-1] != 3:
            raise ValueError(f"points: the shape is {given.shape} and must be (..., 3)")
        self.is_float = floats and given.dtype == np.float32
        rows = given.reshape(-1, 3)
        if not self.is_float:
            rows = rows.astype(np.float64, copy=False)
        rows = rows.astype(rows.dtype.newbyteorder("="), copy=False)
        size, step = rows.itemsize, rows.strides[0]
        aside = rows.strides[1] == size and (len(rows) < 2 or (step >= 3 * size and step % size == 0))
        if not aside or (packed and step != 3 * size):
            rows = np.ascontiguousarray(rows)
        self.rows = rows
        self.shape = given.shape[:-1]
        self.count = len(rows)
        self.stride = rows.strides[0] if self.count > 1 else 0
        self.suffix = "_f32" if self.is_float else ""


class _Heard:
    """What the callbacks of one call have to say to it."""

    def __init__(self) -> None:
        self.error: BaseException | None = None
        self.counts = bytearray(24)

    def done(self) -> tuple[int, int]:
        _, done, total = struct.unpack("=QQQ", self.counts)
        return done, total


def _polling(heard: _Heard, should_stop: Callable[[], object] | None, progress: Callable[[int, int], object] | None):
    """Answers should_stop. A generator, since Python raises KeyboardInterrupt where it resumes: here that is inside `try`, at the
    start of a function it would be before."""
    stop, told = 0, 0.0
    while True:
        try:
            while True:
                yield stop
                if should_stop is not None and should_stop():
                    stop = 1
                if progress is not None and time.monotonic() - told > 0.02:
                    told = time.monotonic()
                    done, total = heard.done()
                    if total:
                        progress(done, total)
        except GeneratorExit:
            return
        except BaseException as error:  # kept and raised after the call
            heard.error = heard.error or error
            stop = 1


class Bar:
    """A tqdm bar as a function of (done, total)."""

    def __init__(self) -> None:
        try:
            from tqdm.auto import tqdm
        except ImportError:
            raise ImportError("progress=True needs tqdm: pip install tqdm") from None
        self._make = tqdm
        self._bar: Any = None

    def __call__(self, done: int, total: int) -> None:
        if self._bar is None:
            self._bar = self._make(total=total, unit="point", unit_scale=True)
        self._bar.update(done - self._bar.n)

    def close(self) -> None:
        if self._bar is not None:
            self._bar.close()


class Call:
    """The options struct of one call and what must outlive it."""

    def __init__(self, options: dict[str, Any], kind: str = "surface", points: Points | None = None, *, struct_type: Any = lib.QueryOptions):
        init, keywords = _OPTIONS[struct_type]
        known = keywords.__annotations__
        for name in options:
            if name not in known:
                raise TypeError(f"'{name}' is not an option; there are {', '.join(known)}")
        self.struct = struct_type()
        lib.functions[init](ctypes.addressof(self.struct), ctypes.sizeof(self.struct))
        self._hints: np.ndarray | None = None
        for name in ("tolerance", "accuracy", "radius", "weight_min", "weight_max", "ratio_limit", "chord", "relative", "deviation", "strain",
                     "jerk", "distance", "slope"):
            if name in options:
                setattr(self.struct, name, real(name, options[name]))
        for name, most in _INTEGERS.items():
            if name in options:
                setattr(self.struct, name, integer(name, options[name], 0, most))
        for name in ("minima_only", "symmetric", "by_length", "calm"):
            if name in options:
                setattr(self.struct, name, 1 if options[name] else 0)
        if options.get("domain") is not None:
            ends = array("domain", options["domain"]).reshape(-1)
            if len(ends) != (2 if kind == "curve" else 4):
                raise ValueError(f"domain: {len(ends)} numbers, and must be {'u0, u1' if kind == 'curve' else 'u0, u1, v0, v1'}")
            self.struct.domain[: len(ends)] = ends.tolist()
        if points is not None:
            self.struct.point_stride = points.stride
            if options.get("hints") is not None:
                width = 1 if kind == "curve" else 2
                hints = array("hints", options["hints"])
                if hints.size != points.count * width:
                    raise ValueError(f"hints: the shape is {hints.shape}, and {points.count} queries need {width} numbers each")
                self._hints = hints
                self.struct.hints = address(hints)
        elif options.get("hints") is not None:
            raise ValueError("hints: this call takes none")
        self._listen(options)

    def _listen(self, options: dict[str, Any]) -> None:
        should_stop, progress, trace = options.get("should_stop"), options.get("progress"), options.get("trace")
        self._bar = Bar() if progress is True else None
        tell = self._bar or (progress or None)
        for name, function in (("should_stop", should_stop), ("progress", tell), ("trace", trace)):
            if function is not None and not callable(function):
                raise TypeError(f"{name}: a function is needed, not {type(function).__name__}")
        self._tell = tell
        self._heard = heard = _Heard()
        if should_stop is not None or tell is not None or threading.current_thread() is threading.main_thread():
            polling = _polling(heard, should_stop, tell)
            next(polling)
            self.struct.should_stop = lib.StopFunction(polling.send)
        self.struct.user = 1
        if tell is not None:
            # No Python code runs here, so that nothing can be raised here: the counts are read by _polling.
            self.struct.progress = lib.ProgressFunction(partial(struct.Struct("=QQQ").pack_into, heard.counts, 0))
        if trace is not None:

            def told(_user: int, query: int, step: int, u: float, v: float, residual: float) -> None:
                try:
                    if heard.error is None:
                        trace(query, step, u, v, residual)
                except BaseException as error:  # raised after the call
                    heard.error = error

            self.struct.trace = lib.TraceFunction(told)

    @property
    def pointer(self) -> int:
        return ctypes.addressof(self.struct)

    def finish(self, status: int, feet: Feet | None = None, found: Any = None) -> None:
        """Raises what a callback raised, or `Cancelled`; tells the last progress."""
        try:
            if self._heard.error is not None:
                raise self._heard.error
            if status == lib.CANCELLED:
                cancelled = lib.Cancelled("should_stop ended the call")
                cancelled.feet, cancelled.found = feet, found
                raise cancelled
            if self._tell is not None and self._heard.done()[1]:
                self._tell(*self._heard.done())
        finally:
            if self._bar is not None:
                self._bar.close()


class ExtremaOptions(TypedDict, total=False):
    """The keywords of `extrema`.

    accuracy     length: places whose distances differ by less may come out as one member; 0: 1e-10 x the diagonal
    radius       length: only points at most this far; 0: all
    nearest      at most this many, the nearest; 0: all
    minima_only  only minima (and flat members)
    domain       u0, u1, v0, v1 (curves: u0, u1): only answers inside
    budget       most boxes; 0: 20,000
    should_stop  called without arguments now and then; a true result ends the call with `Cancelled`
    """

    accuracy: float
    radius: float
    nearest: int
    minima_only: bool
    domain: "ArrayLike | None"
    budget: int
    should_stop: "Callable[[], object] | None"


class PullOptions(TypedDict, total=False):
    """The keywords of `pcurve.pull`.

    tolerance    length: greatest distance between the edge and the image, at equal parameters; 0: 1e-7 x the diagonal of the surface's box
    degree       of fitted pcurves, 1 to 9; 0: 3, or 5 for small tolerances
    pole_limit   most poles of a pcurve; 0: 2000
    hint         u, v near the edge's start, where more than one place of the surface is as near
    should_stop  called without arguments now and then; a true result ends the call with `Cancelled`
    """

    tolerance: float
    degree: int
    pole_limit: int
    hint: "ArrayLike | None"
    should_stop: "Callable[[], object] | None"


class WeightsOptions(TypedDict, total=False):
    """The keywords of the functions in `weights` that give a report.

    weight_min, weight_max  the range of the weights, 1e-12 to 1e12; 0: 0.01 and 100
    ratio_limit             greatest weight over least weight, >= 1; 0: no limit but the range
    tolerance               length: how far a distance may be from its wish; 0: 1e-9 x the diagonal of the poles' box
    symmetric               True: weights of opposite poles are equal
    steps                   most training steps of a network; 0: 1,000
    starts                  most searches of a refinement; 0: 2,000
    seed                    of the random numbers; the same inputs and seed give the same bits
    should_stop             called without arguments before each search of a refinement; a true result ends the call with `Cancelled`
    """

    weight_min: float
    weight_max: float
    ratio_limit: float
    tolerance: float
    symmetric: bool
    steps: int
    starts: int
    seed: int
    should_stop: "Callable[[], object] | None"


class IntersectSurfacesOptions(TypedDict, total=False):
    """The keywords of `intersect_surfaces`.

    chord        length: how far a branch may be from the chord between two of its points; 0: 1e-3 x the size of the smaller surface
    tolerance    length: surfaces that are nearer touch where they are parallel; points of branches are within it of both surfaces, or the
                 result is not proven; 0: what the arithmetic can tell
    method       an `IntersectMethod`; the default proves
    levels       of the methods that do not: how often both surfaces are quartered, 0: until flat; cells of the mesh along a direction, 0: 64
    budget       most pairs of parts; 0: 2,000,000
    should_stop  called without arguments now and then; a true result ends the call with `Cancelled`, whose `found` has what was found
    progress     called with (judged, judged or waiting); True: a bar
    """

    chord: float
    tolerance: float
    method: int
    levels: int
    corrector: int
    budget: int
    should_stop: "Callable[[], object] | None"
    progress: "Callable[[int, int], object] | bool | None"


class Listening(TypedDict, total=False):
    """The keywords of calls that only ask and tell.

    should_stop  called without arguments now and then; a true result ends the call with `Cancelled`
    progress     called with (done, all that is known); True: a bar
    """

    should_stop: "Callable[[], object] | None"
    progress: "Callable[[int, int], object] | bool | None"


class FairOptions(TypedDict, total=False):
    """The keywords of `fair.curve` and `fair.surface`.

    method       a `fair.Method`; default ENERGY
    strain       weight of the squared second derivatives (surfaces: of the thin plate); default 1
    jerk         weight of the squared third derivatives; default 0
    slope        curves: weight of the squared change of the curvature along the arc length; default 0
    distance     weight of the squared distance from the shape as it was; default 0
    calm         planar curves: no more inflections than the calmest curve that is allowed; default True
    by_length    curves: derivatives and integrals by the arc length, not by the parameter
    ends         curves: what is kept at start and end, a pair of 0 nothing, 1 point, 2 first derivative, 3 second; default (2, 2)
    borders      surfaces: what is kept along u0, u1, v0, v1: 0 nothing, 1 G0, 2 G1, 3 G2; default (2, 2, 2, 2)
    fixed        curves: numbers of poles that stay
    through      curves: parameters whose points stay
    knots        curves: the knots that KNOT_REMOVAL may fair; default all inner ones
    length       curves: least and greatest arc length allowed
    region       surfaces: u0, u1, v0, v1: only this part changes
    steps        solutions of the equations at most, five a step; 0: the default
    should_stop  called without arguments between steps; a true result ends the call with `Cancelled`
    """

    method: int
    strain: float
    jerk: float
    slope: float
    distance: float
    deviation: float
    calm: bool
    by_length: bool
    ends: "ArrayLike"
    borders: "ArrayLike"
    fixed: "ArrayLike"
    through: "ArrayLike"
    knots: "ArrayLike"
    length: "ArrayLike"
    region: "ArrayLike"
    steps: int
    should_stop: "Callable[[], object] | None"


class InspectOptions(TypedDict, total=False):
    """The keywords of the functions in `inspect` that prove bounds.

    domain       u0, u1, v0, v1 (curves: u0, u1): only this part (ranges, umbilics)
    relative     allowed gap of a range, as a share of its size; default 1e-3
    accuracy     length: allowed gap of a distance; 0: 1e-3 of the diagonal of the first shape
    budget       most boxes; 0: the default
    side         a `Side`: which extremes of a range must have the gap
    should_stop  called without arguments now and then; a true result ends the call with `Cancelled`
    """

    domain: "ArrayLike | None"
    relative: float
    accuracy: float
    budget: int
    side: int
    should_stop: "Callable[[], object] | None"


_OPTIONS: dict[Any, tuple[str, Any]] = {
    lib.QueryOptions: ("query_options_init", QueryOptions), lib.ExtremaOptions: ("extrema_options_init", ExtremaOptions),
    lib.WeightsOptions: ("weights_options_init", WeightsOptions),
    lib.IntersectSurfacesOptions: ("intersect_surfaces_options_init", IntersectSurfacesOptions), lib.PullOptions: ("pull_options_init", PullOptions),
    lib.FairOptions: ("fair_options_init", FairOptions), lib.InspectOptions: ("inspect_options_init", InspectOptions)}
_INTEGERS = {"method": 2**32 - 1, "corrector": 2**32 - 1, "levels": 2**32 - 1, "scope": 2**32 - 1, "threads": 2**32 - 1, "budget": 2**64 - 1, "nearest": 2**63 - 1, "degree": 31,
             "pole_limit": 2**63 - 1, "steps": 2**32 - 1, "side": 2**32 - 1, "starts": 2**32 - 1, "seed": 2**64 - 1}
