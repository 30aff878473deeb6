"""Draws two surfaces with their branches, and both parameter domains.   picture.py out.svg   SPDX-License-Identifier: MIT OR Apache-2.0"""

import math
import sys

import numpy as np

import footpoint

SIZE = 360


def torus(big: float, small: float) -> footpoint.Surface:
    h = math.sqrt(0.5)
    corners = [(1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1), (1, 0)]
    poles, weights = np.zeros((9, 9, 3)), np.zeros((9, 9))
    for i, (x, y) in enumerate(corners):
        for j, (r, z) in enumerate(corners):
            poles[i, j] = (big + small * r) * x, (big + small * r) * y, small * z
            weights[i, j] = (h if i % 2 else 1) * (h if j % 2 else 1)
    knots = [0, 0, 0, 0.25, 0.25, 0.5, 0.5, 0.75, 0.75, 1, 1, 1]
    return footpoint.Surface(2, 2, knots, knots, poles, weights)


def wave() -> footpoint.Surface:
    poles = [[[x, y, 0.9 * math.sin(1.3 * x) * math.cos(1.1 * y)] for y in np.linspace(-3, 3, 9)] for x in np.linspace(-3, 3, 9)]
    return footpoint.Surface.from_poles(3, 3, poles)


def seen(p: np.ndarray) -> np.ndarray:
    """Parallel projection from above and the side."""
    x, y, z = np.moveaxis(np.asarray(p, float), -1, 0)
    return np.stack([0.866 * (x - y), 0.42 * (x + y) - 0.9 * z], -1)


def polyline(points: np.ndarray, style: str) -> str:
    return f'<polyline points="{" ".join(f"{x:.1f},{y:.1f}" for x, y in points)}" fill="none" {style}/>'


def space(surfaces, branches) -> list[str]:
    lines, out = [], []
    for surface, colour in zip(surfaces, ("#7a8fb0", "#b08f6a")):
        (u0, u1), (v0, v1) = surface.domain
        for k in range(17):
            u, v = u0 + (u1 - u0) * k / 16, v0 + (v1 - v0) * k / 16
            t = np.linspace(0, 1, 48)
            for at in (np.stack([np.full(48, u), v0 + (v1 - v0) * t], -1), np.stack([u0 + (u1 - u0) * t, np.full(48, v)], -1)):
                lines.append((seen(surface.evaluate(at).reshape(-1, 3)), f'stroke="{colour}" stroke-width="0.5" opacity="0.6"'))
    for branch, colour in branches:
        lines.append((seen(branch.points["point"]), f'stroke="{colour}" stroke-width="2.5"'))
    every = np.concatenate([points for points, _ in lines])
    low, high = every.min(0), every.max(0)
    scale = (SIZE - 20) / (high - low).max()
    out += [polyline((points - low) * scale + 10, style) for points, style in lines]
    return out


def domain(surface, branches, field: str, shift: float, name: str) -> list[str]:
    (u0, u1), (v0, v1) = surface.domain
    out = [f'<g transform="translate({shift},0)"><rect x="10" y="10" width="{SIZE - 60}" height="{SIZE - 60}" fill="#fafafa" stroke="#888"/>',
           f'<text x="{(SIZE - 40) / 2}" y="{SIZE - 30}" font-size="14" text-anchor="middle">{name}</text>']
    for branch, colour in branches:
        at = branch.points[field]
        share = np.stack([(at[:, 0] - u0) / (u1 - u0), 1 - (at[:, 1] - v0) / (v1 - v0)], -1)
        # A seam is a jump: the line begins anew.
        breaks = np.flatnonzero(np.abs(np.diff(share, axis=0)).max(1) > 0.5) + 1
        for part in np.split(share, breaks):
            out.append(polyline(10 + part * (SIZE - 60), f'stroke="{colour}" stroke-width="2"'))
    return [*out, "</g>"]


def main(path: str) -> None:
    a, b = torus(2.0, 0.6), wave()
    found = footpoint.intersect_surfaces(a, b)
    print(found)
    colours = ("#c02020", "#1060c0", "#108030", "#a040a0", "#d08000", "#008080", "#604020", "#404040")
    branches = [(branch, colours[k % len(colours)]) for k, branch in enumerate(found.branches)]
    rows = space((a, b), branches) + domain(a, branches, "uv", SIZE, "torus: u, v") + domain(b, branches, "st", 2 * SIZE - 40, "wave: s, t")
    head = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {3 * SIZE - 70} {SIZE}" font-family="sans-serif">'
    with open(path, "w", encoding="utf-8") as file:
        file.write("\n".join([head, '<rect width="100%" height="100%" fill="white"/>', *rows, "</svg>"]) + "\n")


if __name__ == "__main__":
    main(sys.argv[1])
