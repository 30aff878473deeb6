"""Weights from distances: the curve over the poles of a spline edge or over a polygon that comes as near to them as is wished."""

from __future__ import annotations

from typing import Any

import numpy as np
import Part

from .settings import library


def polygon_of(shape: Any) -> Any:
    """The wire of a shape that is one polygon of straight edges, else None."""
    if len(shape.Wires) != 1 or not 2 <= len(shape.Edges) == len(shape.Wires[0].Edges):
        return None
    straight = all(type(edge.Curve).__name__ in ("Line", "LineSegment") for edge in shape.Edges)
    return shape.Wires[0] if straight else None


def control(shape: Any, degree: int = 0) -> Any:
    """The footpoint curve whose weights are sought: that of a spline edge, or the one over the vertices of a polygon.

    degree  over a polygon, at most its vertices less one; 0: 3, or less where there are too few vertices

    A trimmed edge has the poles of its piece. A periodic curve is opened at its start; a closed polygon starts and ends at its first vertex.
    """
    footpoint = library()
    wire = polygon_of(shape)
    if wire is not None:
        points = [tuple(vertex.Point) for vertex in wire.OrderedVertexes]
        points += points[:1] if wire.isClosed() else []
        return footpoint.Curve.from_poles(degree or min(3, len(points) - 1), points)
    edges = shape.Edges
    kind = type(edges[0].Curve).__name__ if len(edges) == 1 else ""
    if kind not in ("BSplineCurve", "BezierCurve"):
        raise ValueError("a B-spline or Bezier edge is needed, or a polygon of straight edges")
    curve = edges[0].Curve.copy()
    periodic = kind == "BSplineCurve" and curve.isPeriodic()
    first, last = edges[0].ParameterRange
    if periodic:
        curve.setNotPeriodic()
    if periodic or (first, last) != (curve.FirstParameter, curve.LastParameter):
        curve.segment(first, last)  # its ends are clamped
    return footpoint.from_freecad(curve)


def refine(curve: Any, distances: Any, **options: Any) -> Any:
    """The report of `footpoint.weights.refine` for one distance a pole, in mm; negative: no wish."""
    wished = np.asarray(distances, float).reshape(-1)
    if len(wished) != curve.pole_count:
        raise ValueError(f"Distances: {len(wished)} numbers, and there are {curve.pole_count} poles (negative: no wish)")
    return library().weights.refine(curve, {pole: wish for pole, wish in enumerate(wished.tolist()) if not wish < 0}, **options)


def to_freecad(curve: Any) -> Any:
    """A footpoint curve as Part.BSplineCurve."""
    import FreeCAD

    knots, repeats = np.unique(curve.knots, return_counts=True)
    found = Part.BSplineCurve()
    found.buildFromPolesMultsKnots([FreeCAD.Vector(*pole) for pole in curve.poles.tolist()], repeats.tolist(), knots.tolist(), False,
                                   curve.degree, curve.weights.tolist())
    return found


def lines(report: Any) -> list[str]:
    """The report as text, one line a pole with a wish."""
    said = {library().weights.State.MET: "met", library().weights.State.NOT_MET: "not met", library().weights.State.IMPOSSIBLE: "impossible"}
    return [f"pole {number + 1}: wish {row['wish']:.9g} mm, distance {row['distance']:.9g} mm (proven: at least {row['lower_bound']:.9g}), "
            f"weight {row['weight']:.9g}: {said[state]}"
            for number, (row, state) in enumerate(zip(report.poles, report.states)) if state in said] or ["no wishes"]
