"""Drawings of what `footpoint.inspect` finds, as the text of SVG files: principal directions, borders that meet, greatest distances.

>>> import footpoint
>>> bowl = footpoint.Surface.from_poles(2, 2, [[[i, j, i * i / 4 + j * j / 3] for j in range(3)] for i in range(3)])
>>> footpoint.draw.directions(bowl).startswith("<svg")
True
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from . import inspect
from ._shapes import Curve, Surface

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

__all__ = ["border", "directions", "distance"]

_GREY, _RED, _BLUE, _BLACK = "#b8c0c8", "#c0392b", "#2468b0", "#202428"


class _View:
    """An orthographic view of points in space, fitted to a picture."""

    def __init__(self, points: np.ndarray, eye: ArrayLike, size: int) -> None:
        towards = np.asarray(eye, float) / np.linalg.norm(eye)
        up = np.array([0.0, 0.0, 1.0]) if abs(towards[2]) < 0.99 else np.array([0.0, 1.0, 0.0])
        right = np.cross(up, towards)
        right /= np.linalg.norm(right)
        self.axes = np.stack([right, -np.cross(towards, right)])
        flat = points.reshape(-1, 3) @ self.axes.T
        self.low, high = flat.min(0), flat.max(0)
        extent = np.maximum(high - self.low, 1e-300)
        self.scale = 0.92 * size / float(extent.max())
        self.width, self.height = (max(1, round(float(part))) for part in extent * self.scale + 0.08 * size)
        self.margin = 0.04 * size
        self.parts: list[str] = []

    def place(self, points: ArrayLike) -> np.ndarray:
        """Points of the picture, pixels."""
        return (np.asarray(points, float).reshape(-1, 3) @ self.axes.T - self.low) * self.scale + self.margin

    def line(self, points: ArrayLike, colour: str, width: float = 1.0) -> None:
        text = " ".join(f"{x:.1f},{y:.1f}" for x, y in self.place(points))
        self.parts.append(f'<polyline points="{text}" fill="none" stroke="{colour}" stroke-width="{width}"/>')

    def dot(self, point: ArrayLike, colour: str, radius: float = 4.0) -> None:
        x, y = self.place(point)[0]
        self.parts.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{radius}" fill="{colour}"/>')

    def net(self, shape: Curve | Surface, colour: str, count: int = 12) -> None:
        for row in _lines(shape, count):
            self.line(row, colour)

    def svg(self) -> str:
        return _svg(self.width, self.height, self.parts)


def _svg(width: int, height: int, parts: list[str]) -> str:
    return (f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" viewBox="0 0 {width} {height}">'
            f'<rect width="100%" height="100%" fill="white"/>{"".join(parts)}</svg>\n')


def _lines(shape: Curve | Surface, count: int) -> list[np.ndarray]:
    """The curve, or isocurves of the surface, as polylines."""
    if isinstance(shape, Curve):
        return [np.asarray(shape.evaluate(np.linspace(*shape.domain, 400)))]
    (u0, u1), (v0, v1) = shape.domain
    rows = []
    for x in np.linspace(0, 1, count + 1):
        fine = np.linspace(0, 1, 120)
        across = np.column_stack([np.full(120, u0 + (u1 - u0) * x), v0 + (v1 - v0) * fine])
        along = np.column_stack([u0 + (u1 - u0) * fine, np.full(120, v0 + (v1 - v0) * x)])
        rows += [np.asarray(shape.evaluate(across)), np.asarray(shape.evaluate(along))]
    return rows


def directions(surface: Surface, *, count: int = 16, eye: ArrayLike = (0.6, -1.0, 0.9), size: int = 480) -> str:
    """The principal directions on a grid of `count` x `count` places, the greater curvature red, the less blue, and umbilics as dots.

    eye   direction towards the eye; the view is orthographic, hidden lines are drawn too
    size  pixels of the longer side
    """
    (u0, u1), (v0, v1) = surface.domain
    at = (np.arange(count) + 0.5) / count
    places = np.stack(np.meshgrid(u0 + (u1 - u0) * at, v0 + (v1 - v0) * at, indexing="ij"), -1).reshape(-1, 2)
    found = inspect.curvatures(surface, places)
    found = found[found["is_singular"] == 0]
    view = _View(np.concatenate(_lines(surface, 8)), eye, size)
    view.net(surface, _GREY, 8)
    length = 0.35 * size / count / view.scale
    for colour, part in ((_RED, slice(0, 3)), (_BLUE, slice(3, 6))):
        for one in found[found["is_umbilic"] == 0]:
            way = length * one["directions"][part]
            view.line([one["point"] - way, one["point"] + way], colour, 1.4)
    for place in inspect.umbilics(surface, budget=20_000):
        if place["kind"] == inspect.Kind.UMBILIC:
            view.dot(surface.evaluate((float(place["u"].mean()), float(place["v"].mean()))), _BLACK)
    return view.svg()


def distance(first: Curve | Surface, second: Curve | Surface, *, eye: ArrayLike = (0.6, -1.0, 0.9), size: int = 480) -> str:
    """Two shapes and their greatest distances from each other: from the first (red) and from the second (blue) to the nearest point, with proven bounds."""
    pair = inspect.hausdorff(first, second)
    view = _View(np.concatenate(_lines(first, 8) + _lines(second, 8)), eye, size)
    view.net(first, _GREY, 8)
    view.net(second, "#d9b98a", 8)
    for found, one, other, colour in ((pair[0], first, second, _RED), (pair[1], second, first, _BLUE)):
        start = one.evaluate(found.at[0] if isinstance(one, Curve) else found.at)
        near = other.closest(start)
        view.line([start, near["point"]], colour, 2.5)
        view.dot(start, colour)
    for k, (found, colour) in enumerate(((pair[0], _RED), (pair[1], _BLUE))):
        view.parts.append(f'<text x="8" y="{view.height + 14 + 16 * k}" font-family="sans-serif" font-size="12" fill="{colour}">'
                          f'at least {found.lower:.4g}, at most {found.upper:.4g}</text>')
    view.height += 40
    return view.svg()


def border(first: Surface, first_side: int, second: Surface, second_side: int, *, size: tuple[int, int] = (480, 320)) -> str:
    """Gap, angle and jump of curvature along the border of the first surface, each as a share of its proven bound (drawn as a line).

    Sides are 0 u = u0, 1 u = u1, 2 v = v0, 3 v = v1.
    """
    bounds = inspect.border(first, first_side, second, second_side)
    ends = first.domain
    free, level = 1 - first_side // 2, ends[first_side // 2][first_side % 2]
    along = np.linspace(*ends[free], 400)
    places = np.full((len(along), 2), level)
    places[:, free] = along
    derivatives = np.asarray(first.evaluate(places, 1))
    tangents = derivatives[:, 1 + free]
    feet = second.closest(derivatives[:, 0])
    there = np.column_stack([feet["u"], feet["v"]])
    bends = []
    for surface, at in ((first, places), (second, there)):
        found = inspect.curvatures(surface, at)
        across = np.cross(found["normal"], tangents)
        across /= np.linalg.norm(across, axis=1)[:, None]
        cosine = np.einsum("ij,ij->i", across, found["directions"][:, :3])
        bends.append((found["normal"], found["principal"][:, 0] * cosine**2 + found["principal"][:, 1] * (1 - cosine**2)))
    (normal_a, bend_a), (normal_b, bend_b) = bends
    turned = np.einsum("ij,ij->i", normal_a, normal_b)
    rows = (("gap", feet["distance"], bounds.gap, "#1b8a5a"), ("angle", np.arccos(np.clip(np.abs(turned), 0, 1)), bounds.angle, _BLUE),
            ("curvature", np.abs(bend_a - np.sign(turned) * bend_b), bounds.curvature, _RED))
    width, height = size
    panel, parts = height / 3, []
    for k, (name, values, bound, colour) in enumerate(rows):
        base, top = panel * (k + 1) - 8, panel * k + 24
        x = 10 + (along - along[0]) / (along[-1] - along[0]) * (width - 20)
        y = base - np.clip(values / bound.upper if bound.upper > 0 else 0 * values, 0, 1.05) * (base - top)
        text = " ".join(f"{a:.1f},{b:.1f}" for a, b in zip(x, y))
        parts.append(f'<line x1="10" x2="{width - 10}" y1="{top}" y2="{top}" stroke="{_GREY}"/><line x1="10" x2="{width - 10}" y1="{base}" y2="{base}" '
                     f'stroke="{_BLACK}" stroke-width="0.6"/><polyline points="{text}" fill="none" stroke="{colour}" stroke-width="1.5"/>'
                     f'<text x="10" y="{top - 6}" font-family="sans-serif" font-size="12" fill="{colour}">{name}: at least {bound.lower:.3g}, '
                     f'at most {bound.upper:.3g}</text>')
    return _svg(width, height, parts)
