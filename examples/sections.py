"""Contour lines of a propeller blade: sections by a stack of planes, drawn from above and in the parameter domain.

    python examples/sections.py docs/pictures/sections.svg
"""

import math
import sys

import numpy as np

import footpoint
from footpoint.intersect import Quadric, sections

SECTION = [(0.50, 0.00), (0.42, 0.20), (0.27, 0.40), (0.08, 0.52), (-0.14, 0.56), (-0.33, 0.49), (-0.46, 0.33), (-0.50, 0.13)]
SECTION += [(x, -y) for x, y in reversed(SECTION)]
ROWS = [(20, 47, 15.0), (23.5, 45, 13.5), (25.5, 42, 8.6), (30, 43, 7.0), (40, 51, 6.2), (53, 61, 5.4), (67, 70, 4.6), (81, 74, 3.9),
        (94, 71, 3.2), (106, 61, 2.7), (115, 44, 2.3), (120, 23, 1.9), (120, 0, 0)]


def blade(start: float) -> footpoint.Surface:
    """The blade of the measuring job in examples/propeller."""
    net = np.zeros((len(SECTION), len(ROWS), 3))
    for i, (x, y) in enumerate(SECTION):
        for j, (radius, chord, thickness) in enumerate(ROWS):
            across, up = x * chord, 0.045 * chord * (1 - 4 * x * x) + y * thickness
            pitch, height = math.atan(190 / (2 * math.pi * radius)), (radius - 20) / 100
            angle = start + (across * math.cos(pitch) - up * math.sin(pitch)) / radius + 0.55 * height * height
            net[i, j] = radius * math.cos(angle), radius * math.sin(angle), -across * math.sin(pitch) - up * math.cos(pitch)
    return footpoint.Surface.from_poles(3, 3, net)


def colour(share: float) -> str:
    stops = [(31, 61, 120), (38, 132, 152), (94, 178, 120), (224, 180, 60), (196, 74, 48)]
    x = share * (len(stops) - 1)
    k = min(int(x), len(stops) - 2)
    return "#%02x%02x%02x" % tuple(round(a + (x - k) * (b - a)) for a, b in zip(stops[k], stops[k + 1]))


def path(points: np.ndarray, closed: bool) -> str:
    steps = " ".join(f"{x:.2f},{y:.2f}" for x, y in points)
    return f"M{steps}{'Z' if closed else ''}"


def main(file: str) -> None:
    shapes = [blade(2 * math.pi * k / 3) for k in range(3)]
    heights = np.linspace(-21, 21, 29)
    planes = [Quadric.plane([0, 0, z], [0, 0, 1]) for z in heights]
    lines, domain, count = [], [], 0
    for number, shape in enumerate(shapes):
        for share, section in zip(np.linspace(0, 1, len(heights)), sections(shape, planes, chord=0.02)):
            assert section.is_complete
            for branch in section.branches:
                count += 1
                xy = branch.points[:, :2] * [1.35, -1.35] + [180, 190]
                lines.append(f'<path d="{path(xy, branch.is_closed)}" stroke="{colour(share)}"/>')
                # In the domain a branch that crosses a seam comes in pieces.
                uv = branch.parameters
                cuts = np.flatnonzero(np.abs(np.diff(uv[:, 0])) > 0.5) + 1
                for part in np.split(uv, cuts) if number == 0 else []:
                    domain.append(f'<path d="{path(part * [260, -260] + [400, 320], False)}" stroke="{colour(share)}"/>')
    text = f"Contour lines of three blades in {len(planes)} planes: {count} branches, none missing"
    with open(file, "w", encoding="utf-8") as out:
        out.write('<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 680 380" font-family="sans-serif" font-size="13" fill="none" '
                  'stroke-width="0.9"><rect width="680" height="380" fill="#ffffff" stroke="none"/>\n' + "\n".join(lines) +
                  '\n<rect x="400" y="60" width="260" height="260" stroke="#888888"/>\n' + "\n".join(domain) +
                  f'\n<g fill="#333333" stroke="none"><text x="20" y="372">{text}</text><text x="400" y="50">one blade: u to the right, v up'
                  '</text></g>\n</svg>\n')
    print(text)


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else "sections.svg")
