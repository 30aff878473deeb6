"""Fairing: curves and surfaces with less energy and fewer inflections, within a deviation that is proven.

Knots and weights stay, poles move. Shapes never change: each function gives a `Report` with a new shape.

>>> import footpoint, numpy as np
>>> x = np.linspace(0, 1, 30)
>>> wavy = footpoint.Curve.from_poles(3, np.column_stack([x, x * (1 - x) + 2e-3 * (-1) ** np.arange(30)]))
>>> report = footpoint.fair.curve(wavy, 5e-3, jerk=1.0, strain=0.0)
>>> bool(report.deviation <= 5e-3), bool(report.energies[-1] < report.energies[0])
(True, True)
"""

from __future__ import annotations

import ctypes
from dataclasses import dataclass
from enum import IntEnum
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _library as lib
from ._query import Call, address, array, real, vector
from ._shapes import Curve, Surface

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ._query import FairOptions

__all__ = ["Method", "Report", "curve", "surface"]


class Method(IntEnum):
    """How poles are moved: all at once, one at a time (Eck, Hadenfeld), or as the removal of a knot would (Farin, Sapidis)."""

    ENERGY = 0
    LOCAL = 1
    KNOT_REMOVAL = 2


@dataclass(frozen=True, eq=False)
class Report:
    """A faired shape.

    shape      the new curve or surface
    energies   the energy before the first step and after each, shape (steps + 1,), never rising
    deviation  no point has moved farther from the point of the same parameters, proven
    converged  whether the last steps changed the energy by less than a millionth
    """

    shape: Curve | Surface
    energies: np.ndarray
    deviation: float
    converged: bool

    def __repr__(self) -> str:
        return f"Report({self.shape!r}, energy {self.energies[0]:.6g} to {self.energies[-1]:.6g}, deviation {self.deviation:.6g})"


def curve(curve: Curve, deviation: float, **options: Unpack[FairOptions]) -> Report:
    """A fairer curve, no point of which is farther than `deviation` (a length) from where it was at the same parameter.

    options  see `FairOptions`
    """
    return _report(Curve, "curve", curve, deviation, options)


def surface(surface: Surface, deviation: float, **options: Unpack[FairOptions]) -> Report:
    """A fairer surface, no point of which is farther than `deviation` (a length) from where it was at the same parameters.

    options  see `FairOptions`
    """
    return _report(Surface, "surface", surface, deviation, options)


def _report(kind: type, name: str, shape: Any, deviation: float, options: dict[str, Any]) -> Report:
    if not isinstance(shape, kind):
        raise TypeError(f"{name}: a {kind.__name__} is needed, not {type(shape).__name__}")
    call = Call({**options, "deviation": real("deviation", deviation)}, name, struct_type=lib.FairOptions)
    kept = []
    for key, length in (("length", 2), ("region", 4)):
        if options.get(key) is not None:
            getattr(call.struct, key)[:] = vector(key, options[key], length).tolist()
    for key, length in (("ends", 2), ("borders", 4)):
        if options.get(key) is not None:
            getattr(call.struct, key)[:] = array(key, options[key], (length,), np.uint32).tolist()
    for key, count, dtype in (("fixed", "fixed_count", np.uintp), ("through", "through_count", np.float64), ("knots", "knot_count", np.float64)):
        if options.get(key) is not None:
            kept.append(array(key, options[key], (None,), dtype))
            setattr(call.struct, key, address(kept[-1]))
            setattr(call.struct, count, len(kept[-1]))
    out = ctypes.c_void_p()
    status = lib.call(f"fair_{name}", shape._handle, call.pointer, ctypes.byref(out))
    try:
        call.finish(status)
        summary, made = lib.FairSummary(), ctypes.c_void_p()
        lib.call("fair_report_summary", out, ctypes.addressof(summary))
        energies = np.zeros(summary.steps + 1)
        lib.call("fair_report_energies", out, len(energies), address(energies))
        lib.call(f"fair_report_{name}", out, ctypes.byref(made))
        new = kind.__new__(kind)
        new._own(made.value)
        return Report(new, energies, summary.deviation, bool(summary.converged))
    finally:
        lib.functions["fair_report_free"](out)
