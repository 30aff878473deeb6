"""Pcurves: curves (u, v, 0) in the domain of a surface whose images are curves in space.

>>> import numpy as np, footpoint
>>> from footpoint import pcurve
>>> dome = footpoint.Surface.from_poles(2, 2, [[[i, j, 1.0 if i == j == 1 else 0.0] for j in range(3)] for i in range(3)])
>>> edge, told = pcurve.lift(dome, footpoint.Curve.from_poles(1, [[0.1, 0.2], [0.9, 0.7]]))
>>> told.exact, edge.degree
(True, 4)
>>> [(piece, told)] = pcurve.pull(dome, edge, tolerance=1e-9)
>>> bool(told.bound <= 1e-9), piece.degree, np.round(piece.poles[-1], 6).tolist()
(True, 1, [0.9, 0.7, 0.0])
"""

from __future__ import annotations

import ctypes
from enum import IntFlag
from typing import TYPE_CHECKING, NamedTuple

from . import _library as lib
from ._query import Call, PullOptions, address, integer, real, vector
from ._shapes import Curve, Surface

if TYPE_CHECKING:
    from typing_extensions import Unpack

__all__ = ["Deviation", "PcurveFlag", "deviation", "lift", "pull"]


class PcurveFlag(IntFlag):
    """What is special about a pcurve or an image."""

    NOT_PROVEN = 1
    NOT_ON_SURFACE = 2
    ALONG_SEAM_U = 4
    ALONG_SEAM_V = 8
    FROM_SEAM = 16
    TO_SEAM = 32
    FROM_COLLAPSED = 64
    TO_COLLAPSED = 128
    EXACT = 256


class Deviation(NamedTuple):
    """The greatest distance between a curve in space and the image of a pcurve, at equal parameters."""

    #: Proven: nowhere more than this.
    bound: float
    #: The greatest distance found, up to rounding.
    reached: float
    #: The parameter where it was found.
    at: float
    flags: PcurveFlag

    @property
    def exact(self) -> bool:
        """True for an image that was not fitted."""
        return bool(self.flags & PcurveFlag.EXACT)

    @property
    def proven(self) -> bool:
        """True when the bound is within the tolerance that was asked for."""
        return not self.flags & PcurveFlag.NOT_PROVEN


def pull(surface: Surface, edge: Curve, **options: Unpack[PullOptions]) -> list[tuple[Curve, Deviation]]:
    """The pcurves of an edge, a curve in space that lies on the surface, in its order and with its parameter.

    More than one where the edge crosses a seam or meets a collapsed edge: they end and begin on the border of the domain. An edge that is
    not on the surface gets the pcurves of its feet, and `PcurveFlag.NOT_ON_SURFACE`.

    options  see `PullOptions`
    """
    _checked(surface, edge)
    given = dict(options)
    hint = given.pop("hint", None)
    call = Call(given, "surface", struct_type=lib.PullOptions)
    place = None if hint is None else vector("hint", hint, 2)
    call.struct.hint = address(place)
    out = ctypes.c_void_p()
    call.finish(lib.call("pcurve_pull", surface._handle, edge._handle, call.pointer, ctypes.byref(out)))
    try:
        count = ctypes.c_size_t()
        lib.call("pcurve_set_count", out, ctypes.byref(count))
        return [_taken("pcurve_set_get", out, index) for index in range(count.value)]
    finally:
        lib.functions["pcurve_set_free"](out)


def lift(surface: Surface, pcurve: Curve, tolerance: float = 0.0, exact_degree: int = 0) -> tuple[Curve, Deviation]:
    """The image of a pcurve in space, with its parameter: the isocurve of an isoline, exact where degrees allow, else fitted.

    tolerance     length: greatest deviation of a fitted image; 0: 1e-7 x the diagonal of the surface's box
    exact_degree  exact images may have at most this degree; 0: 6
    """
    _checked(surface, pcurve)
    options = lib.LiftOptions()
    lib.functions["lift_options_init"](ctypes.addressof(options), ctypes.sizeof(options))
    options.tolerance, options.exact_degree = real("tolerance", tolerance), integer("exact_degree", exact_degree, 0, 31)
    return _taken("pcurve_lift", surface._handle, pcurve._handle, ctypes.addressof(options))


def deviation(surface: Surface, pcurve: Curve, curve: Curve) -> Deviation:
    """How far a curve in space is from the image of a pcurve at equal parameters, with proof."""
    _checked(surface, pcurve, curve)
    told = lib.Deviation()
    lib.call("pcurve_deviation", surface._handle, pcurve._handle, curve._handle, ctypes.addressof(told))
    return _read(told)


def _checked(surface: Surface, *curves: Curve) -> None:
    if not isinstance(surface, Surface):
        raise TypeError(f"surface: a Surface is needed, not {type(surface).__name__}")
    for curve in curves:
        if not isinstance(curve, Curve):
            raise TypeError(f"a Curve is needed, not {type(curve).__name__}")


def _read(told: lib.Deviation) -> Deviation:
    return Deviation(told.bound, told.reached, told.at, PcurveFlag(told.flags))


def _taken(name: str, *arguments) -> tuple[Curve, Deviation]:
    out, told = ctypes.c_void_p(), lib.Deviation()
    lib.call(name, *arguments, ctypes.byref(out), ctypes.addressof(told))
    curve = Curve.__new__(Curve)
    curve._own(out.value)
    return curve, _read(told)
