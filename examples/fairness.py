"""Fairing and inspection on one page: fairness.py FILE.svg writes every kind of picture of footpoint.inspect and footpoint.draw."""

import base64
import re
import sys

import numpy as np

import footpoint
from footpoint import draw, fair, inspect


def knots(count):
    return np.concatenate([[0.0] * 4, np.arange(1, count - 3) / (count - 3), [1.0] * 4])


def section(count=41):
    """The section of a bumper, points off by up to 1.5 mm a metre, as a cubic spline."""
    x = np.linspace(0, 1, count)
    y = 0.3 - 0.9 * (x - 0.5) ** 2 - 3 * (x - 0.5) ** 4
    y[1:-1] += 1.5e-3 * np.random.default_rng(3).uniform(-1, 1, count - 2)
    return footpoint.Curve(3, knots(count), np.column_stack([x, y]))


def panel(count=16, noise=1e-3):
    """A bumper, its inner poles off by up to `noise`."""
    at = np.convolve(knots(count)[1:-1], np.ones(3) / 3, "valid")
    u, v = np.meshgrid(at, at, indexing="ij")
    height = -0.4 * (u - 0.5) ** 4 - 0.3 * (v - 0.4) ** 2 - 0.25 * (u - 0.5) ** 2
    height[2:-2, 2:-2] += noise * np.random.default_rng(5).uniform(-1, 1, (count - 4, count - 4))
    return footpoint.Surface(3, 3, knots(count), knots(count), np.stack([u, v, height], -1))


def ellipsoid(a, b, c):
    """Half an ellipsoid as a rational biquadratic surface, away from its poles."""
    w = np.sqrt(0.5)
    turn = np.array([[1, 0, 1], [1, 1, w], [0, 1, 1], [-1, 1, w], [-1, 0, 1]])
    rise = np.array([[w, -w, 1], [1 / w, 0, w], [w, w, 1]])
    poles = np.array([[(a * x * r, b * y * r, c * z) for r, z, _ in rise] for x, y, _ in turn])
    weights = np.array([[p * q for _, _, q in rise] for _, _, p in turn])
    return footpoint.Surface(2, 2, [0, 0, 0, 1, 1, 2, 2, 2], [0, 0, 0, 1, 1, 1], poles, weights)


def image(picture):
    """A picture as an image of SVG."""
    height, width, _ = picture.pixels.shape
    data = base64.b64encode(picture.png()).decode()
    return f'<image width="{width}" height="{height}" href="data:image/png;base64,{data}"/>'


def drawing(text):
    """The inside of an SVG file, and its size."""
    width, height = (float(re.search(rf'{name}="([\d.]+)"', text)[1]) for name in ("width", "height"))
    return text, width, height


def main(path):
    wavy, rough, egg = section(), panel(), ellipsoid(2, 3, 1)
    smooth = fair.curve(wavy, 8e-4, strain=0.0, slope=1.0).shape
    faired = fair.surface(rough, 2e-3).shape
    bounds = inspect.curvature_range(faired, side=inspect.Side.GREATEST)
    low, high = bounds.radius
    print(f"least radius of curvature: between {low:.6g} and {high:.6g}" + (", proven" if bounds.proven else ""))
    print(f"inflections: {len(inspect.inflections(wavy))} before, {len(inspect.inflections(smooth))} after")
    size, view = (300, 225), {"eye": (0.4, -0.9, 1.1)}
    names = {"zebra before": (rough, inspect.Pattern.ZEBRA), "zebra after": (faired, inspect.Pattern.ZEBRA), "isophotes": (faired, inspect.Pattern.ISOPHOTES),
             "reflection lines": (faired, inspect.Pattern.REFLECTION_LINES), "highlight lines": (faired, inspect.Pattern.HIGHLIGHT_LINES),
             "shaded": (egg, inspect.Pattern.SHADED), "greater curvature": (egg, inspect.Pattern.GREATER), "less curvature": (egg, inspect.Pattern.LESS),
             "mean curvature": (egg, inspect.Pattern.MEAN), "Gaussian curvature": (egg, inspect.Pattern.GAUSSIAN)}
    cells = [(name, image(inspect.picture(shape, pattern, size=size, bands=24, **view)), *size) for name, (shape, pattern) in names.items()]
    cells.append(("principal directions and umbilics", *drawing(draw.directions(egg, size=300))))
    cells.append(("comb before", *drawing(inspect.comb_svg(wavy, scale=0.03, size=300))))
    cells.append(("comb after", *drawing(inspect.comb_svg(smooth, scale=0.03, size=300))))
    low_part, high_part = footpoint.operate.split(rough, 0.5, "u")
    cells.append(("border of two halves, one faired alone", *drawing(draw.border(fair.surface(low_part, 2e-3, borders=(1, 1, 1, 1)).shape, 1, high_part, 0, size=size))))
    parabola = footpoint.Curve.from_poles(2, [[0, -0.1125], [0.5, 0.7125], [1, -0.1125]])
    cells.append(("Hausdorff distance from a parabola", *drawing(draw.distance(smooth, parabola, eye=(0, 0, 1), size=300))))
    parts = []
    for k, (name, text, width, height) in enumerate(cells):
        x, y = 320 * (k % 5), 275 * (k // 5)
        scale = min(1.0, 300 / width, 240 / height)
        parts.append(f'<text x="{x + 8}" y="{y + 20}" font-family="sans-serif" font-size="14">{name}</text>'
                     f'<g transform="translate({x + 8},{y + 28}) scale({scale:.4f})">{text}</g>')
    rows = (len(cells) + 4) // 5
    with open(path, "w", encoding="utf-8") as file:
        file.write(f'<svg xmlns="http://www.w3.org/2000/svg" width="1600" height="{275 * rows}"><rect width="100%" height="100%" fill="white"/>{"".join(parts)}</svg>\n')


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else "fairness.svg")
