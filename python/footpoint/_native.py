"""CAD geometry as NURBS, with the relation between the parameters of both.

OpenCASCADE measures circles, cylinders, cones, spheres and tori by angle; as NURBS their parameter is no angle. The NURBS made here
have knots at angles, at most a right angle apart; between knots ``tan(t/2) = s sin(d/2) / (1 - s + s cos(d/2))``, with s in 0..1 along the
span, d its angle, t the angle from its start: both sides are the same linear fraction of the homogeneous coordinates.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import ceil, pi
from typing import Any, Callable

import numpy as np

from ._shapes import Curve, Surface

TURN = 2 * pi


@dataclass
class Direction:
    """One parameter of a shape: knots, the control numbers of its samples, weights, and its relation to the native parameter."""

    degree: int
    knots: np.ndarray
    #: Native parameters at which the geometry is sampled, and the matrix from samples to poles.
    samples: np.ndarray
    matrix: np.ndarray
    weights: np.ndarray
    #: Angle of a span, 0 where the native parameter is that of the NURBS.
    step: float = 0.0
    period: float = 0.0

    def to_native(self, t: Any) -> np.ndarray:
        """From the parameter of the NURBS."""
        t = np.asarray(t, float)
        if not self.step:
            return t
        start, local = self._span(t)
        return start + 2 * np.arctan2(local * np.sin(self.step / 2), 1 - local + local * np.cos(self.step / 2))

    def from_native(self, t: Any) -> np.ndarray:
        """To the parameter of the NURBS."""
        t = np.asarray(t, float)
        if self.period:
            low = self.knots[self.degree]
            t = np.where((t >= low) & (t <= low + self.period), t, low + np.mod(t - low, self.period))
        if self.step:
            start, local = self._span(t)
            angle = local * self.step
            near, far = np.sin(angle / 2), np.sin((self.step - angle) / 2)
            t = start + self.step * near / (near + far)
        return np.clip(t, self.knots[self.degree], self.knots[-self.degree - 1])

    def _span(self, t: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        starts = self.knots[1:-2:2]
        index = np.clip(np.searchsorted(starts, t, side="right") - 1, 0, len(starts) - 1)
        return starts[index], (t - starts[index]) / self.step


def line(low: float, high: float) -> Direction:
    """A parameter in which the geometry is linear."""
    return Direction(1, np.array([low, low, high, high]), np.array([low, high]), np.eye(2), np.ones(2))


def angle(low: float, high: float, periodic: bool = False) -> Direction:
    """A parameter in which the geometry is 1, cos, sin."""
    spans = max(1, ceil((high - low) / (pi / 2) - 1e-9))
    step = (high - low) / spans
    ends = low + step * np.arange(spans + 1)
    ends[-1] = high
    at = low + step / 2 * np.arange(2 * spans + 1)
    weights = np.where(np.arange(2 * spans + 1) % 2, np.cos(step / 2), 1.0)
    control = np.stack([np.ones(len(at)), np.cos(at) / weights, np.sin(at) / weights], 1)
    from_samples = np.array([[0.5, 0, 0.5], [0.5, 0, -0.5], [-0.5, 1, -0.5]])
    knots = np.concatenate([[low], np.repeat(ends, 2), [high]])
    return Direction(2, knots, np.array([0, pi / 2, pi]), control @ from_samples, weights, step, TURN if periodic else 0.0)


def spline(degree: int, knots: Any, multiplicities: Any, count: int, periodic: bool) -> tuple[Direction, np.ndarray]:
    """A parameter of a B-spline, periodic ones unrolled; and the number of the pole that each pole is."""
    knots, multiplicities = np.asarray(knots, float), np.asarray(multiplicities, int)
    if not periodic:
        flat, order = np.repeat(knots, multiplicities), np.arange(count)
    else:
        once = np.repeat(knots[:-1], multiplicities[:-1])
        turn, index = np.divmod(np.arange(count + 2 * degree + 1) - degree + int(multiplicities[0]) - 1, count)
        flat, order = once[index] + turn * (knots[-1] - knots[0]), np.arange(count + degree) % count
    period = float(knots[-1] - knots[0]) if periodic else 0.0
    return Direction(degree, flat, np.zeros(0), np.zeros((0, 0)), np.ones(len(order)), period=period), order


@dataclass
class Native:
    """A shape and its relation to the geometry that it was made from.

    shape        Curve or Surface
    directions   one or two: `to_native` and `from_native` of each parameter
    """

    shape: Any
    directions: tuple[Any, ...]

    def to_native(self, parameters: Any) -> np.ndarray:
        """Parameters of the CAD program for those of the shape: shape (..., 2), of curves (...)."""
        return self._map(parameters, "to_native")

    def from_native(self, parameters: Any) -> np.ndarray:
        """Parameters of the shape for those of the CAD program: shape (..., 2), of curves (...)."""
        return self._map(parameters, "from_native")

    def _map(self, parameters: Any, name: str) -> np.ndarray:
        values = np.asarray(parameters, float)
        if len(self.directions) == 1:
            return getattr(self.directions[0], name)(values)
        return np.stack([getattr(axis, name)(values[..., k]) for k, axis in enumerate(self.directions)], -1)


def of_curve(axis: Direction, poles: Any, weights: Any = None) -> Native:
    """A curve of poles."""
    both = axis.weights * (1 if weights is None else np.asarray(weights))
    return Native(Curve(axis.degree, axis.knots, poles, None if np.all(both == both.flat[0]) else both), (axis,))


def of_surface(axes: tuple[Direction, Direction], poles: Any, weights: Any = None) -> Native:
    """A surface of poles."""
    both = np.outer(axes[0].weights, axes[1].weights) * (1 if weights is None else np.asarray(weights))
    u, v = axes
    shape = Surface(u.degree, v.degree, u.knots, v.knots, poles, None if np.all(both == both.flat[0]) else both)
    return Native(shape, axes)


def sampled_curve(axis: Direction, at: Callable[[float], Any]) -> Native:
    """A line, circle or ellipse, from its points."""
    return of_curve(axis, axis.matrix @ np.array([at(t) for t in axis.samples]))


def sampled_surface(axes: tuple[Direction, Direction], at: Callable[[float, float], Any]) -> Native:
    """A plane, cylinder, cone, sphere or torus, from its points."""
    u, v = axes
    values = np.array([[at(s, t) for t in v.samples] for s in u.samples])
    return of_surface(axes, np.einsum("ia,jb,abk->ijk", u.matrix, v.matrix, values))


def extruded(basis: Native, direction: Any, low: float, high: float) -> Native:
    """C(u) + v D."""
    curve, along = basis.shape, line(low, high)
    poles = curve.poles[:, None, :] + along.samples[None, :, None] * np.asarray(direction, float)
    return Native(of_surface((_shape_of(basis), along), poles, np.outer(curve.weights, np.ones(2))).shape, (*basis.directions, along))


def revolved(basis: Native, location: Any, direction: Any, low: float, high: float, periodic: bool) -> Native:
    """The curve C(v) turned by u about an axis."""
    curve, turn = basis.shape, angle(low, high, periodic)
    origin, axis = np.asarray(location, float), np.asarray(direction, float)
    axis = axis / np.linalg.norm(axis)
    arm = curve.poles - origin
    along = np.outer(arm @ axis, axis)
    out, side = arm - along, np.cross(axis, arm)
    samples = np.stack([origin + along + out, origin + along + side, origin + along - out])
    poles = np.einsum("ia,ajk->ijk", turn.matrix, samples)
    surface = of_surface((turn, _shape_of(basis)), poles, np.outer(np.ones(len(turn.weights)), curve.weights))
    return Native(surface.shape, (turn, *basis.directions))


def _shape_of(basis: Native) -> Direction:
    curve = basis.shape
    return Direction(curve.degree, curve.knots, np.zeros(0), np.zeros((0, 0)), np.ones(curve.pole_count))


class Same:
    """A parameter that is the native one."""

    to_native = from_native = staticmethod(lambda t: np.asarray(t, float))


def of_function(kind: str, function: Callable, domain: Any) -> Native:
    """Geometry that is no NURBS, as a function without bounds: its answers are never proven."""
    if kind == "curve":
        return Native(Curve.from_function(function, domain), (Same(),))
    return Native(Surface.from_function(function, domain), (Same(), Same()))


def checked(native: Native, at: Callable[..., Any], bounds: Any) -> Native:
    """Compares the NURBS with the geometry at 16 places: a form that is read wrongly must not answer."""
    ranges = np.asarray(bounds, float).reshape(-1, 2)
    fractions = np.array([0.03, 0.31, 0.62, 0.96])
    places = [low + fractions * (high - low) for low, high in ranges]
    grid = np.stack(np.meshgrid(*places, indexing="ij"), -1).reshape(-1, len(ranges))
    ours = native.shape.evaluate(native.from_native(grid[:, 0] if len(ranges) == 1 else grid))
    theirs = np.array([at(*place) for place in grid])
    size = np.linalg.norm(np.diff(native.shape.box, axis=0)) + 1e-5 * np.abs(theirs).max()
    worst = np.abs(ours - theirs).max()
    if not worst <= 1e-9 * size:
        raise ValueError(f"the NURBS form differs from the geometry by {worst:.3g}")
    return native
