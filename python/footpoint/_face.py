"""Faces: surfaces bounded by loops of pcurves."""

from __future__ import annotations

import ctypes
from enum import IntEnum, IntFlag
from typing import TYPE_CHECKING, Any, Callable, Iterable

import numpy as np

from . import _library as lib
from ._feet import Feet, FootSet, take_set
from ._handle import Owner
from ._query import Call, Points, address, array, integer, real, vector
from ._shapes import Curve, Surface
from .trims import TrimmedSurface

if TYPE_CHECKING:
    from numpy.typing import ArrayLike
    from typing_extensions import Unpack

    from ._query import QueryOptions


class Standing(IntEnum):
    """Where a place of a face lies."""

    INSIDE = 0
    OUTSIDE = 1
    ON_EDGE = 2
    UNKNOWN = 3


class StandingFlag(IntFlag):
    """What is to be said of a standing; see the `flags` of `PLACE`."""

    NOT_PROVEN = 1


#: Where on a face a place lies: `standing`, and on an edge the number of its loop, of its pcurve in the loop, and its parameter. `flags` are
#: `StandingFlag`: NOT_PROVEN where the surface is a function without a bound of its speed; whether an edge is within the tolerance is
#: not proven then.
PLACE = np.dtype([("standing", np.uint32), ("loop_index", np.uint32), ("coedge_index", np.uint32), ("flags", np.uint32),
                  ("parameter", np.float64)])


class _Making:
    """What is told and asked while a face is made. An exception in a function ends the making and is raised again."""

    def __init__(self, budget: int, should_stop: Callable[[], object] | None, progress: Callable[[int, int], object] | None):
        self.failure: BaseException | None = None
        self.options = lib.FaceOptions()
        lib.functions["face_options_init"](ctypes.byref(self.options), ctypes.sizeof(self.options))
        self.options.budget = integer("budget", budget)

        def guarded(function: Callable[..., object]) -> Any:
            def call(_user: Any, *arguments: int) -> int:
                try:
                    return int(bool(self.failure) or bool(function(*arguments)))
                except BaseException as failure:
                    self.failure = failure
                    return 1
            return call

        # Told without a should_stop, a failure of progress must end the call all the same.
        self.options.should_stop = lib.StopFunction(guarded(should_stop or (lambda: False)))
        if progress is not None:
            self.options.progress = lib.ProgressFunction(guarded(progress))

    def call(self, name: str, *arguments: Any) -> int:
        out = ctypes.c_void_p()
        status = lib.call(name, *arguments, ctypes.byref(self.options), ctypes.byref(out))
        if status == lib.CANCELLED:
            raise self.failure or lib.Cancelled("making a face was cancelled by should_stop")
        assert out.value is not None
        return out.value


class Face(Owner):
    """A surface bounded by loops of pcurves, curves (u, v, 0) in its domain that follow each other. What two loops hold both is a hole.

    surface      a Surface
    loops        for each loop its pcurves, in order
    budget       most spans of the images of all pcurves; 0: 10,000,000
    should_stop  called without arguments between pcurves; a true result ends the making with `Cancelled`
    progress     called with how many pcurves are done, of how many

    >>> import footpoint
    >>> square = footpoint.Surface.from_poles(1, 1, [[[0, 0, 0], [0, 4, 0]], [[4, 0, 0], [4, 4, 0]]])
    >>> triangle = footpoint.Curve(1, [0, 0, 1, 2, 3, 3], [[0, 0], [1, 0], [0, 1], [0, 0]])
    >>> face = footpoint.Face(square, [[triangle]])
    >>> feet, places = face.closest([[1, 1, 2], [4, 4, 0]])
    >>> feet.point.round(9).tolist(), [footpoint.Standing(s).name for s in places["standing"]]
    ([[1.0, 1.0, 0.0], [2.0, 2.0, 0.0]], ['INSIDE', 'ON_EDGE'])
    """

    _kind = "face"

    def __init__(self, surface: Surface, loops: Iterable[Iterable[Curve]], *, budget: int = 0,
                 should_stop: Callable[[], object] | None = None, progress: Callable[[int, int], object] | None = None):
        if not isinstance(surface, Surface):
            raise TypeError(f"surface: a Surface is needed, not {type(surface).__name__}")
        chains = [list(loop) for loop in loops]
        for k, chain in enumerate(chains):
            for i, curve in enumerate(chain):
                if not isinstance(curve, Curve):
                    raise TypeError(f"loops: pcurve {i} of loop {k} is a {type(curve).__name__}, not a Curve")
        self._new(surface, chains, _Making(budget, should_stop, progress))

    def _new(self, surface: Surface, chains: list[list[Curve]], making: _Making | None = None) -> None:
        counts = np.array([len(chain) for chain in chains], np.uintp)
        handles = np.array([curve._handle for chain in chains for curve in chain], np.uintp)
        data = lib.FaceData(ctypes.sizeof(lib.FaceData), surface._handle, len(chains), address(counts), address(handles))
        handle = (making or _Making(0, None, None)).call("face_new", ctypes.addressof(data))
        self._made = Face, (surface, chains)
        self._own(handle)

    @classmethod
    def of_trim(cls, trim: TrimmedSurface, *, budget: int = 0, should_stop: Callable[[], object] | None = None,
                progress: Callable[[int, int], object] | None = None) -> "Face":
        """The face of a trimmed surface over any support, in whose parameters it answers; `budget`, `should_stop` and `progress` as for a
        new face."""
        face = cls.__new__(cls)
        face._of(trim, _Making(budget, should_stop, progress))
        return face

    def _of(self, trim: TrimmedSurface, making: _Making | None = None) -> None:
        if not isinstance(trim, TrimmedSurface):
            raise TypeError(f"trim: a TrimmedSurface is needed, not {type(trim).__name__}")
        handle = (making or _Making(0, None, None)).call("face_of_trim", trim._handle)
        self._made = Face.of_trim, (trim,)
        self._own(handle)

    def _renew(self) -> None:
        make, arguments = self._made
        (self._new if make is Face else self._of)(*arguments)

    def __reduce__(self) -> tuple:
        return self._made

    def classify(self, uv: ArrayLike, **options: Unpack[QueryOptions]) -> np.ndarray:
        """On which side of the edges places of the domain lie: within `tolerance` of an edge, in space, they are on it.

        uv       shape (..., 2)
        options  tolerance, budget, threads, should_stop and progress count
        returns  records `PLACE`, shape (...); compare their `standing` with `Standing`
        """
        given = array("uv", uv)
        if given.ndim == 0 or given.shape[-1] != 2:
            raise ValueError(f"uv: the shape is {given.shape} and must be (..., 2)")
        call = Call(dict(options), "surface")
        places = np.zeros(given.shape[:-1], PLACE)
        call.finish(self._call("classify", address(given), places.size, call.pointer, address(places)))
        return places

    def closest(self, points: ArrayLike, **options: Unpack[QueryOptions]) -> tuple[Feet, np.ndarray]:
        """The nearest point of the face for each query point, with a proven lower bound of the distance.

        points   shape (..., 3)
        options  see `QueryOptions`; domain, scope and trace are not supported
        returns  Feet (...) and records `PLACE` (...): where on the face they lie
        """
        asked = Points(points, floats=False)
        call = Call(dict(options), "surface", asked)
        feet, places = Feet(asked.count), np.zeros(asked.count, PLACE)
        status = self._call("closest", address(asked.rows), asked.count, call.pointer, address(feet), address(places))
        call.finish(status, feet.reshape(asked.shape))
        self._indexed = True
        return feet.reshape(asked.shape), places.reshape(asked.shape)

    def preimage(self, point: ArrayLike, tolerance: float = 0.0, **options: Unpack[QueryOptions]) -> FootSet:
        """All parameters of the face whose point lies within a tolerance of a point: as `Surface.preimage`."""
        at = vector("point", point)
        call = Call(dict(options), "surface")
        out = ctypes.c_void_p()
        status = self._call("preimage", address(at), real("tolerance", tolerance), call.pointer, ctypes.byref(out))
        found = take_set(out) if out.value else None
        call.finish(status)
        assert found is not None
        return found
