"""Shapes of other programs and packages as footpoint's.

Each converter takes the objects as they are; nothing is imported before it is needed. B-splines keep their parameters. Lines, circles,
ellipses, planes, cylinders, cones, spheres, tori, surfaces of extrusion and of revolution become exact NURBS; those that CAD programs measure
by angle have other parameters between their knots, and `native_freecad` and `native_occ` give the relation as well. Offsets and what
else is no NURBS become functions, whose answers are not proven.
"""

from __future__ import annotations

from math import pi
from typing import Any

import numpy as np

from . import _native as nurbs
from ._native import Native
from ._shapes import Curve, Surface

__all__ = ["Native", "from_freecad", "from_geomdl", "from_occ", "from_splinepy", "native_freecad", "native_occ"]


def from_geomdl(shape: Any) -> Curve | Surface:
    """A curve or surface of geomdl (NURBS-Python): BSpline or NURBS; plane ones get z = 0."""
    weights = list(shape.weights) if getattr(shape, "rational", False) else None
    points = np.asarray(shape.ctrlpts, float)
    if shape.pdimension == 1:
        return Curve(shape.degree, shape.knotvector, points, weights)
    if shape.pdimension != 2:
        raise TypeError(f"shape: a curve or surface is needed, not one with {shape.pdimension} parameters")
    counts = shape.ctrlpts_size_u, shape.ctrlpts_size_v
    grid = points.reshape(*counts, -1)
    return Surface(shape.degree_u, shape.degree_v, shape.knotvector_u, shape.knotvector_v, grid,
                   None if weights is None else np.reshape(weights, counts))


def from_splinepy(shape: Any) -> Curve | Surface:
    """A curve or surface of splinepy: Bezier, RationalBezier, BSpline or NURBS; plane ones get z = 0."""
    degrees = [int(degree) for degree in shape.degrees]
    points = np.asarray(shape.control_points, float)
    weights = np.asarray(shape.weights, float).reshape(-1) if shape.is_rational else None
    if shape.has_knot_vectors:
        knots = [np.asarray(vector, float) for vector in shape.knot_vectors]
    else:
        knots = [np.repeat([0.0, 1.0], degree + 1) for degree in degrees]
    if len(degrees) == 1:
        return Curve(degrees[0], knots[0], points, weights)
    if len(degrees) != 2:
        raise TypeError(f"shape: a curve or surface is needed, not one with {len(degrees)} parameters")
    nu, nv = (len(vector) - degree - 1 for vector, degree in zip(knots, degrees))
    grid = np.swapaxes(points.reshape(nv, nu, -1), 0, 1)  # the first parameter runs fastest there
    return Surface(*degrees, *knots, grid, None if weights is None else weights.reshape(nv, nu).T)


def from_freecad(shape: Any, bounds: Any = None) -> Curve | Surface:
    """A curve or surface of FreeCAD's Part: geometry (Part.BSplineSurface, Part.Circle, ...), an edge or a face; placed where it stands.

    bounds  u0, u1, v0, v1 (curves: u0, u1), for geometry that is infinite; an edge or a face has its own. A face gives its surface, of
            which it may be a part only
    """
    return native_freecad(shape, bounds).shape


def from_occ(shape: Any, bounds: Any = None) -> Curve | Surface:
    """A curve or surface of OpenCASCADE through cadquery-ocp (OCP) or pythonocc: Geom_Curve, Geom_Surface, TopoDS_Edge, TopoDS_Face;
    cadquery and build123d objects have it as `.wrapped`. Otherwise as `from_freecad`."""
    return native_occ(shape, bounds).shape


def native_freecad(shape: Any, bounds: Any = None) -> Native:
    """As `from_freecad`, with the relation of the parameters: `Native.shape`, `to_native`, `from_native`."""
    from ._cad import FreeCad

    return _read(FreeCad(), shape, bounds)


def native_occ(shape: Any, bounds: Any = None) -> Native:
    """As `from_occ`, with the relation of the parameters: `Native.shape`, `to_native`, `from_native`."""
    from ._cad import Occ

    return _read(Occ(shape), shape, bounds)


def _read(cad: Any, shape: Any, bounds: Any) -> Native:
    """The NURBS form of a piece of geometry, checked against it."""
    geometry, own = cad.geometry(shape)
    given = own if bounds is None else np.asarray(bounds, float).reshape(-1)
    kind = cad.kind(geometry)
    make = _curve if kind in _CURVES else _surface if kind in _SURFACES else None
    if make is None:
        raise TypeError(f"shape: a curve, surface, edge or face is needed, not {kind}")
    count = 2 if make is _curve else 4
    if given is not None and (len(given) != count or not np.all(np.isfinite(given)) or np.any(given[0::2] >= given[1::2])):
        raise ValueError(f"bounds: {count} finite numbers are needed, each start before its end, not {list(given)}")
    native = make(cad, geometry, kind, given)
    if kind in _FUNCTIONS:
        return native
    low_high = np.stack([np.asarray(axis.to_native(ends)) for axis, ends in zip(native.directions, np.atleast_2d(native.shape.domain))])
    return nurbs.checked(native, lambda *at: cad.value(geometry, *at), low_high)


_FUNCTIONS = {"offset curve", "offset surface", "other curve", "other surface"}
_CURVES = {"line", "circle", "ellipse", "bspline curve", "bezier curve", "trimmed curve", "offset curve", "other curve"}
_SURFACES = {"plane", "cylinder", "cone", "sphere", "torus", "bspline surface", "bezier surface", "revolution", "extrusion",
             "trimmed surface", "offset surface", "other surface"}


def _curve(cad: Any, geometry: Any, kind: str, bounds: Any) -> Native:
    if kind == "trimmed curve":
        basis = cad.basis(geometry)
        ends = cad.range(geometry) if bounds is None else bounds
        return _curve(cad, basis, cad.kind(basis), ends)
    if kind in ("bspline curve", "bezier curve"):
        degree, knots, multiplicities, poles, weights, periodic = cad.spline_curve(geometry, kind)
        axis, order = nurbs.spline(degree, knots, multiplicities, len(poles), periodic)
        return nurbs.of_curve(axis, poles[order], weights[order])
    low, high = _range(cad, geometry, bounds, 0)
    if kind == "line":
        axis = nurbs.line(low, high)
    elif kind in ("circle", "ellipse"):
        axis = nurbs.angle(low, min(high, low + 2 * pi), high - low >= 2 * pi - 1e-12)
    else:
        return nurbs.of_function("curve", lambda u, order: cad.value(geometry, u), (low, high))
    return nurbs.sampled_curve(axis, lambda t: cad.value(geometry, t))


def _surface(cad: Any, geometry: Any, kind: str, bounds: Any) -> Native:
    if kind == "trimmed surface":
        basis = cad.basis(geometry)
        ends = cad.range(geometry) if bounds is None else bounds
        return _surface(cad, basis, cad.kind(basis), ends)
    if kind in ("bspline surface", "bezier surface"):
        both, poles, weights = cad.spline_surface(geometry, kind)
        (u, rows), (v, columns) = (nurbs.spline(d, k, m, n, p) for (d, k, m, p), n in zip(both, poles.shape))
        pick = np.ix_(rows, columns)
        return nurbs.of_surface((u, v), poles[pick], weights[pick])

    def straight(index: int) -> nurbs.Direction:
        return nurbs.line(*_range(cad, geometry, bounds, index))

    def turned(index: int, closed: bool = True) -> nurbs.Direction:
        low, high = _range(cad, geometry, bounds, index)
        return nurbs.angle(low, min(high, low + 2 * pi), closed and high - low >= 2 * pi - 1e-12)

    if kind == "revolution":
        basis = cad.basis(geometry)
        low, high = _range(cad, geometry, bounds, 0)
        profile = _curve(cad, basis, cad.kind(basis), None if bounds is None else bounds[2:])
        return nurbs.revolved(profile, *cad.axis(geometry), low, min(high, low + 2 * pi), high - low >= 2 * pi - 1e-12)
    if kind == "extrusion":
        basis = cad.basis(geometry)
        profile = _curve(cad, basis, cad.kind(basis), None if bounds is None else bounds[:2])
        return nurbs.extruded(profile, cad.axis(geometry)[1], *_range(cad, geometry, bounds, 1))
    makers = {"plane": lambda: (straight(0), straight(1)), "cylinder": lambda: (turned(0), straight(1)),
              "cone": lambda: (turned(0), straight(1)), "sphere": lambda: (turned(0), turned(1, False)), "torus": lambda: (turned(0), turned(1))}
    if kind in makers:
        return nurbs.sampled_surface(makers[kind](), lambda u, v: cad.value(geometry, u, v))
    domain = [*_range(cad, geometry, bounds, 0), *_range(cad, geometry, bounds, 1)]
    return nurbs.of_function("surface", lambda u, v, order: cad.value(geometry, u, v), domain)


def _range(cad: Any, geometry: Any, bounds: Any, index: int) -> tuple[float, float]:
    ends = cad.range(geometry) if bounds is None else bounds
    low, high = float(ends[2 * index]), float(ends[2 * index + 1])
    if max(abs(low), abs(high)) >= 1e99:
        raise ValueError("bounds: this geometry is infinite; give u0, u1 and, of a surface, v0, v1")
    return low, high
