"""Fairing and inspection of edges and faces."""

from __future__ import annotations

from typing import Any

import numpy as np
import Part

from . import weights
from .settings import library


def of(shape: Any) -> Any:
    """The footpoint curve of an edge, or the surface of a face: the whole of it, whatever the face is trimmed to."""
    kind, parts = ("face", shape.Faces) if shape.Faces else ("edge", shape.Edges)
    if len(parts) != 1:
        raise ValueError(f"one edge or one face is needed, and there are {len(parts)} {kind}s")
    return library().from_freecad(parts[0])


def to_freecad(shape: Any) -> Any:
    """A footpoint curve or surface as geometry of Part."""
    import FreeCAD

    if not isinstance(shape, library().Surface):
        return weights.to_freecad(shape)
    (ku, mu), (kv, mv) = (np.unique(knots, return_counts=True) for knots in shape.knots)
    found = Part.BSplineSurface()
    poles = [[FreeCAD.Vector(*pole) for pole in row] for row in shape.poles.tolist()]
    found.buildFromPolesMultsKnots(poles, mu.tolist(), mv.tolist(), ku.tolist(), kv.tolist(), False, False, *shape.degrees, shape.weights.tolist())
    return found


def faired(shape: Any, deviation: float, jerk: float, keep: int) -> Any:
    """The report of `footpoint.fair` for an edge or a face: strain and `jerk`, `keep` derivatives kept at ends and borders."""
    one = of(shape)
    fair = library().fair
    if isinstance(one, library().Surface):
        return fair.surface(one, deviation, jerk=jerk, borders=[keep] * 4)
    return fair.curve(one, deviation, jerk=jerk, ends=[keep] * 2)


def _between(low: float, high: float) -> str:
    return f"{low:.6g} to {high:.6g}"


def _standing(found: Any) -> str:
    if found.proven:
        return ", proven"
    if found.unbounded[1] and found.rest_proven:
        return f", proven but for {found.excluded:.2%} beside tips or cusps, where it is 0"
    return f", not proven to 0.1 % ({found.excluded:.2%} left out)"


def inspected(shape: Any) -> tuple[list[str], Any]:
    """What there is to say about the bending of an edge or a face, and marks: a comb, or the place of the least radius and the umbilics."""
    import FreeCAD

    one, inspect = of(shape), library().inspect
    found = inspect.curvature_range(one, side=inspect.Side.GREATEST)
    radius = found.radius
    text = [f"least radius of curvature: {_between(*radius)} mm" + _standing(found)]
    if isinstance(one, library().Surface):
        for name, quantity in (("Gaussian", inspect.Quantity.GAUSSIAN), ("mean", inspect.Quantity.MEAN)):
            part = inspect.curvature_range(one, quantity, budget=20_000)
            text.append(f"{name} curvature: {_between(part.least[0], part.greatest[1])}")
        places = inspect.umbilics(one, budget=20_000)
        points = [one.evaluate(((place["u"][0] + place["u"][1]) / 2, (place["v"][0] + place["v"][1]) / 2)) for place in places
                  if place["kind"] == inspect.Kind.UMBILIC]
        areas = len(places) - len(points)
        text.append(f"umbilics: {len(points)}" + (f", areas of them: {areas}" if areas else ""))
        points.append(one.evaluate(found.at_greatest))
        return text, Part.makeCompound([Part.Vertex(FreeCAD.Vector(*point)) for point in points])
    pieces, turns = inspect.monotone_pieces(one), inspect.inflections(one)
    text.append(f"inflections: {int((turns['kind'] == inspect.Kind.INFLECTION).sum())}")
    text.append(f"pieces of monotone curvature: {len(pieces)}")
    teeth = inspect.comb(one)
    low, high = teeth["point"].min(0), teeth["point"].max(0)
    longest = float(teeth["curvature"].max())
    scale = 0.2 * float(np.linalg.norm(high - low)) / longest if longest > 0 else 0.0
    tips = teeth["point"] - scale * teeth["bend"]
    lines = [Part.makeLine(FreeCAD.Vector(*a), FreeCAD.Vector(*b)) for a, b in zip(teeth["point"].tolist(), tips.tolist())
             if np.linalg.norm(np.subtract(a, b)) > 1e-7]
    apart = [tips[0]] + [b for a, b in zip(tips, tips[1:]) if np.linalg.norm(b - a) > 1e-7]
    if len(apart) > 1:
        lines.append(Part.makePolygon([FreeCAD.Vector(*tip) for tip in np.array(apart).tolist()]))
    return text, Part.makeCompound(lines)


def picture(shape: Any, pattern: int, size: tuple[int, int] = (640, 480), **options: Any) -> Any:
    """The picture of a face: see `footpoint.inspect.picture`."""
    return library().inspect.picture(of(shape), pattern, size=size, **options)
