"""What two faces have in common, within their wires."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
import Part

from . import measure, weights
from .settings import library
from .trims import Trims

#: Places of a curve that are asked whether they lie within the wires, before the crossings are narrowed.
SAMPLES = 257


@dataclass
class Found:
    """What *Intersect faces* finds: edges and vertices for drawing; counts; lines of text.

    curves  edges: a branch that passes a seam is one on each side; loops: closed branches that lie in both faces as a whole
    error   greatest distance of an edge from the intersection, as measured, in mm
    proven  no branch of the two surfaces is missing
    """

    shapes: list[Any] = field(default_factory=list)
    curves: int = 0
    points: int = 0
    loops: int = 0
    overlaps: int = 0
    undecided: int = 0
    error: float = 0.0
    proven: bool = False
    text: list[str] = field(default_factory=list)


class _Within:
    """Whether parameters of both surfaces belong to both faces."""

    def __init__(self, first: Any, second: Any):
        self.sides = [(measure.native_of_face(face), Trims(face)) for face in (first, second)]

    def __call__(self, *places: np.ndarray) -> np.ndarray:
        inside = [trim.inside(np.array(native.to_native(at[:, :2]), float)) for (native, trim), at in zip(self.sides, places)]
        return inside[0] & inside[1]


def _pieces(within: _Within, curves: Any) -> list[tuple[float, float]]:
    """Intervals of the curves' parameter whose places belong to both faces; ends by bisection."""
    low, high = (float(end) for end in curves.space.domain)

    def at(t: np.ndarray) -> np.ndarray:
        return within(curves.uv.evaluate(t), curves.st.evaluate(t))

    steps = np.linspace(low, high, SAMPLES)
    inside = at(steps)
    ends = []
    for k in np.flatnonzero(inside[1:] != inside[:-1]):
        a, b = steps[k], steps[k + 1]
        for _ in range(40):
            middle = 0.5 * (a + b)
            a, b = (middle, b) if bool(at(np.array([middle]))[0]) == bool(inside[k]) else (a, middle)
        ends.append(0.5 * (a + b))
    ends = ([low] if inside[0] else []) + ends + ([high] if inside[-1] else [])
    return [(a, b) for a, b in zip(ends[0::2], ends[1::2]) if b - a > 1e-9 * (high - low)]


def of_faces(first: Any, second: Any, tolerance: float = 0.0) -> Found:
    """The curves and points that two faces have in common.

    tolerance  length: how far an edge may be from the intersection; 0: 1e-6 of the size of the smaller face
    """
    size = min(face.BoundBox.DiagonalLength for face in (first, second))
    tolerance = tolerance or 1e-6 * size
    within = _Within(first, second)
    (a, _), (b, _) = within.sides
    whole = library().intersect_surfaces(a.shape, b.shape)
    found = Found(overlaps=len(whole.overlaps), undecided=len(whole.undecided), proven=whole.is_proven)
    for number, branch in enumerate(whole.branches):
        is_whole = branch.is_closed
        for curves in whole.curves(number, tolerance):
            ends = tuple(float(end) for end in curves.space.domain)
            found.error = max(found.error, float(curves.error))
            spline = weights.to_freecad(curves.space)
            pieces = _pieces(within, curves)
            found.shapes += [spline.toShape(*piece) for piece in pieces]
            found.curves += len(pieces)
            is_whole &= pieces == [ends]
        found.loops += is_whole
    for contact in whole.contacts:
        if within(np.array([contact.place["uv"]]), np.array([contact.place["st"]]))[0]:
            found.shapes.append(Part.Vertex(*(float(x) for x in contact.place["point"])))
            found.points += 1
    state = "proven: nothing is missing" if found.proven else "not proven"
    found.text = [f"{found.curves} curves, {found.loops} closed loops, {found.points} points; {state}",
                  f"curves within {found.error:.3g} mm, as measured"]
    if found.overlaps:
        found.text.append(f"the surfaces coincide in {found.overlaps} areas of their parameters")
    if found.undecided:
        found.text.append(f"{found.undecided} areas of parameters are undecided: more may lie there")
    return found
