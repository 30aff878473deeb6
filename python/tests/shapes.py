"""Shapes and points that several tests use."""

from pathlib import Path

import numpy as np

import footpoint

ROOT = Path(__file__).resolve().parents[2]


def hill() -> footpoint.Surface:
    poles = [[[10 * i, 10 * j, 12 if i in (1, 2) and j in (1, 2) else 0] for j in range(4)] for i in range(4)]
    return footpoint.Surface.from_poles(3, 3, poles)


def wavy(seed: int = 3) -> footpoint.Surface:
    rng = np.random.default_rng(seed)
    poles = np.stack([*np.meshgrid(np.arange(8.0), np.arange(9.0), indexing="ij"), rng.normal(size=(8, 9))], -1)
    return footpoint.Surface.from_poles(3, 2, poles, rng.uniform(0.5, 2, (8, 9)))


def circle(radius: float = 2.0) -> footpoint.Curve:
    h = 0.5**0.5
    corners = np.array([[1, 0], [1, 1], [0, 1], [-1, 1], [-1, 0], [-1, -1], [0, -1], [1, -1], [1, 0]]) * radius
    return footpoint.Curve(2, [0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4], corners, [1, h, 1, h, 1, h, 1, h, 1])


def cylinder(radius: float = 2.0, height: float = 5.0) -> footpoint.Surface:
    ring = circle(radius)
    poles = np.stack([ring.poles, ring.poles + [0, 0, height]], 1)
    return footpoint.Surface(2, 1, ring.knots, [0, 0, 1, 1], poles, np.stack([ring.weights] * 2, 1))


def cloud(count: int, seed: int = 1, size: float = 8.0) -> np.ndarray:
    return np.random.default_rng(seed).uniform(-1, size, (count, 3))
