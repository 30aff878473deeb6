"""Drop-ins for Surface.parameter and Curve.parameter of FreeCAD, for macros.

    from footpoint_freecad import parameters
    u, v = parameters.parameter(face, point)            # instead of face.Surface.parameter(point)

    surface = parameters.Surface(face)                  # many points: made once
    u, v = surface.parameter(point)
    uv = surface.parameters(points)                     # (n, 3) to (n, 2), a million in seconds

Parameters are FreeCAD's. They belong to the nearest point of the whole surface (within its range), ends and borders included, or the
answer is not proven: `feet` tells. On infinite surfaces as much counts as the points need.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from .settings import library


class _Drop:
    """A curve or surface of FreeCAD, an edge or a face, with footpoint's form of it."""

    def __init__(self, shape: Any, bounds: Any = None):
        self._shape, self._bounds = shape, bounds
        self._native: Any = None
        self._reach = 0.0
        if bounds is not None or not self._infinite():
            self._native = library().convert.native_freecad(shape, bounds)

    def _range(self) -> np.ndarray:
        shape = self._shape
        if hasattr(shape, "ParameterRange"):
            return np.array(shape.ParameterRange)
        return np.array(shape.bounds() if hasattr(shape, "bounds") else (shape.FirstParameter, shape.LastParameter))

    def _infinite(self) -> bool:
        return bool(np.abs(self._range()).max() >= 1e99)

    def _for(self, points: np.ndarray) -> Any:
        """The form; of an infinite plane, cylinder, cone or line the part that the nearest points need."""
        if self._native is not None and not self._reach:
            return self._native
        start = np.array(tuple(self._shape.value(*([0.0] * (len(self._range()) // 2)))))
        good = points[np.isfinite(points).all(-1)]
        need = 2 * float(np.linalg.norm(good - start, axis=-1).max(initial=0.0)) + 1
        if need > self._reach:
            self._reach = 2 * need
            ends = self._range()
            infinite = np.abs(ends) >= 1e99
            ends[infinite] = np.where(ends[infinite] < 0, -self._reach, self._reach)
            self._native = library().convert.native_freecad(self._shape, ends)
        return self._native

    def feet(self, points: Any, **options: Any) -> Any:
        """footpoint's records (see footpoint.Feet), shape (...); their parameters are those of the NURBS form."""
        asked = np.asarray(points, float)
        return self._for(asked).shape.closest(asked, **options)

    def parameters(self, points: Any, **options: Any) -> np.ndarray:
        """FreeCAD's parameters of the nearest points: (..., 3) to (..., 2), of curves (...)."""
        asked = np.asarray(points, float)
        feet = self.feet(asked, **options)
        return self._native.to_native(feet.uv if len(self._native.directions) == 2 else feet.u)


class Surface(_Drop):
    """A surface or face; see the module."""

    def parameter(self, point: Any) -> tuple[float, float]:
        """u, v of the nearest point."""
        u, v = self.parameters(tuple(point))
        return float(u), float(v)


class Curve(_Drop):
    """A curve or edge; see the module."""

    def parameter(self, point: Any) -> float:
        """u of the nearest point."""
        return float(self.parameters(tuple(point)))


def parameter(shape: Any, point: Any) -> Any:
    """The parameter of the nearest point: a pair on a surface or face, a number on a curve or edge. For many points make a `Surface` or
    `Curve` once."""
    is_curve = hasattr(shape, "FirstParameter") or type(shape).__name__ == "Edge"
    return Curve(shape).parameter(point) if is_curve else Surface(shape).parameter(point)
