"""Drawings: lines and marks are where closed forms say."""

import re

import numpy as np
import pytest
from shapes import circle, cylinder

import footpoint
from footpoint import draw, inspect

H = 0.5**0.5


def ellipse(a, b):
    return footpoint.Curve(2, circle().knots, circle(1.0).poles * [a, b, 1], circle().weights)


def flat(corners):
    return footpoint.Surface(1, 1, [0, 0, 1, 1], [0, 0, 1, 1], corners)


def pairs(text):
    return np.array([[float(x) for x in one.split(",")] for one in text.split()])


def lines(text, colour):
    return [pairs(points) for points in re.findall(rf'points="([^"]*)" fill="none" stroke="{colour}"', text)]


def marks(text, pattern):
    return np.array([[float(x) for x in found] for found in re.findall(pattern, text)]).reshape(-1, 2)


def dots(text):
    return marks(text, r'<circle cx="([\d.-]+)" cy="([\d.-]+)"')


def extrema(text):
    return marks(text, r'class="extremum" x="([\d.-]+)" y="([\d.-]+)"') + 3


def plane_of(text, curve):
    """From points of the plane to pixels, told by the line of the curve."""
    drawn = pairs(re.search(r'<polyline points="([^"]*)" stroke="black"', text)[1])
    points = np.asarray(curve.evaluate(np.linspace(*curve.domain, len(drawn))))[:, :2]
    scale = (drawn[:, 0].max() - drawn[:, 0].min()) / (points[:, 0].max() - points[:, 0].min())
    at = lambda p: drawn[0] + (np.asarray(p, float) - points[0]) * [scale, -scale]  # noqa: E731
    assert np.abs(at(points) - drawn).max() < 0.05  # nothing is stretched, y points up
    return at, scale


def teeth(text):
    return np.array([[[float(x) for x in end.split(",")] for end in one.split("L")] for one in re.search(r'<path d="M([^"]*)"', text)[1].split("M")])


@pytest.mark.parametrize("radius", [0.5, 3.0])
def test_the_comb_of_a_circle_has_equal_teeth_that_point_outward(radius):
    curve = circle(radius)
    text = inspect.comb_svg(curve, scale=0.4)
    at, scale = plane_of(text, curve)
    spines = teeth(text)
    assert len(spines) == len(inspect.comb(curve)) >= 60
    foot, tip = (spines[:, k] - at([0, 0]) for k in (0, 1))
    assert np.allclose(np.linalg.norm(foot, axis=1), radius * scale, atol=0.05)
    assert np.allclose(tip, foot * (1 + 0.4 / radius**2), atol=0.1)
    assert not len(extrema(text)) and not len(dots(text))


def test_extrema_of_an_ellipse_are_at_the_ends_of_its_axes():
    a, b = 3.0, 1.5
    curve = ellipse(a, b)
    text = inspect.comb_svg(curve, scale=0.2)
    at, scale = plane_of(text, curve)
    # Curvatures a / b^2 and b / a^2, teeth of a fifth of them.
    long, short = a + 0.2 * a / b**2, b + 0.2 * b / a**2
    wanted = at([[long, 0], [-long, 0], [0, short], [0, -short]])
    off = np.linalg.norm(extrema(text)[:, None] - wanted, axis=2)
    assert off.min(1).max() < 0.1  # each square is at one of them
    assert (off[:, 1:].min(0) < 0.1).all()  # and at each but where the curve begins there is one


def test_the_inflection_of_a_cubic_is_in_its_middle():
    curve = footpoint.Curve.from_poles(3, [[-1, -1], [-1 / 3, 1], [1 / 3, -1], [1, 1]])  # y = x^3
    text = inspect.comb_svg(curve, scale=0.05)
    at, _ = plane_of(text, curve)
    assert np.allclose(dots(text), at([[0, 0]]), atol=0.02)
    # The curvature 6 x / (1 + 9 x^4)^(3/2) is greatest where 45 x^4 = 1.
    x = (1 / 45) ** 0.25
    bend = 6 * x / (1 + 9 * x**4) ** 1.5 * np.array([-3 * x * x, 1]) / np.hypot(1, 3 * x * x)
    tip = np.array([x, x**3]) - 0.05 * bend
    assert np.allclose(sorted(extrema(text).tolist()), sorted(at([tip, -tip]).tolist()), atol=0.1)


def rows(text, size):
    """Gap, angle, jump of curvature along the border, as shares of their proven bounds, and the bounds."""
    width, height = size
    shares = []
    for k, (line,) in enumerate(lines(text, colour) for colour in ("#1b8a5a", "#2468b0", "#c0392b")):
        base, top = height / 3 * (k + 1) - 8, height / 3 * k + 24
        assert np.allclose(line[:, 0], np.linspace(10, width - 10, len(line)), atol=0.06)
        shares.append((base - line[:, 1]) / (base - top))
    bounds = [[float(x) for x in found] for found in re.findall(r"at least ([\d.e+-]+), at most ([\d.e+-]+)", text)]
    return shares, bounds


def test_a_border_shows_gap_angle_and_jump_of_curvature():
    size, ramp = (480, 320), np.linspace(0, 1, 400)
    left = flat([[[0, 0, 0], [0, 1, 0]], [[1, 0, 0], [1, 1, 0]]])
    # A crease of 0.3, and a gap that grows from nothing to 0.01 (lifted).
    c, s = np.cos(0.3), np.sin(0.3)
    crease = flat([[[1, 0, 0], [1, 1, 0]], [[1 + c, 0, s], [1 + c, 1, s]]])
    (_, angle, _), (_, bounds, _) = rows(draw.border(left, 1, crease, 0, size=size), size)
    assert np.allclose(angle, 1, atol=0.01) and np.allclose(bounds, 0.3, rtol=3e-3) and bounds[0] <= 0.3 * (1 + 1e-3)
    lifted = flat([[[1, 0, 0], [1, 1, 0.01]], [[2, 0, 0], [2, 1, 0.01]]])
    (gap, _, _), (bounds, _, _) = rows(draw.border(left, 1, lifted, 0, size=size), size)
    assert np.allclose(gap, ramp * np.cos(np.arctan(0.01)) * 0.01 / bounds[1], atol=0.01) and np.allclose(bounds, 0.01, rtol=3e-3)
    # A quarter of a tube of radius 2 that begins tangent to the plane: the curvature jumps by a half.
    arc = np.array([[1, 0], [3, 0], [3, 2.0]])
    poles = [[[x, y, z] for y in (0, 1)] for x, z in arc]
    tube = footpoint.Surface(2, 1, [0, 0, 0, 1, 1, 1], [0, 0, 1, 1], poles, [[1, 1], [H, H], [1, 1]])
    (gap, angle, jump), (gaps, angles, bounds) = rows(draw.border(left, 1, tube, 0, size=size), size)
    assert np.allclose(jump, 1, atol=0.01) and np.allclose(bounds, 0.5, rtol=3e-3)
    assert gaps[1] < 1e-5 and angles[1] < 1e-3


def test_the_greatest_distance_of_an_ellipse_from_a_circle_is_at_its_end():
    text = draw.distance(ellipse(1.3, 1.0), ellipse(1.0, 1.0), eye=(0, 0, 1), size=500)
    scale, margin = 0.92 * 500 / 2.6, 0.04 * 500
    at = lambda x, y: np.array([(x + 1.3) * scale, (1.0 - y) * scale]) + margin  # noqa: E731
    red, blue = dots(text)
    assert min(np.abs(red - at(x, 0)).max() for x in (1.3, -1.3)) < 2  # 0.3 away, either end
    wide = [line for line in lines(text, "#c0392b") if len(line) == 2][0]
    assert abs(np.linalg.norm(wide[1] - wide[0]) - 0.3 * scale) < 1
    # From the circle: its end on the x axis is 0.3 * ... away from the ellipse by less; the text has proven bounds of both.
    bounds = [[float(x) for x in found] for found in re.findall(r"at least ([\d.e+-]+), at most ([\d.e+-]+)", text)]
    assert bounds[0][0] <= 0.3 <= bounds[0][1] and len(bounds) == 2


def test_principal_directions_of_a_tube_run_along_and_around_it():
    text = draw.directions(cylinder(2.0, 5.0), count=12, eye=(1, 0, 0))
    found = {name: [line for line in lines(text, colour) if len(line) == 2] for name, colour in (("greater", "#c0392b"), ("less", "#2468b0"))}
    assert len(found["greater"]) == len(found["less"]) == 144
    flat_ones = [name for name, each in found.items() if all(abs(b[1] - a[1]) < 0.11 for a, b in each)]
    upright = [name for name, each in found.items() if all(abs(b[0] - a[0]) < 0.11 and abs(b[1] - a[1]) > 5 for a, b in each)]
    assert len(flat_ones) == len(upright) == 1 and flat_ones != upright and not len(dots(text))


def test_umbilics_of_an_ellipsoid_are_where_monge_found_them():
    a, b, c = 3.0, 2.0, 1.0
    turn = np.array([[1, 0, 1], [1, 1, H], [0, 1, 1], [-1, 1, H], [-1, 0, 1]])
    rise = np.array([[H, -H, 1], [1 / H, 0, H], [H, H, 1]])
    poles = [[(a * x * r, -b * y * r, c * z) for r, z, _ in rise] for x, y, _ in turn]
    weights = [[p * q for _, _, q in rise] for _, _, p in turn]
    # Half of a belt, y <= 0, its ends on the plane of the umbilics: they are inside of the belt turned a little.
    half = footpoint.Surface(2, 2, [0, 0, 0, 1, 1, 2, 2, 2], [0, 0, 0, 1, 1, 1], poles, weights)
    x = a * np.sqrt((a * a - b * b) / (a * a - c * c))
    z = c * np.sqrt((b * b - c * c) / (a * a - c * c))
    text = draw.directions(half, eye=(0, -1, 0), size=600)
    scale = 0.92 * 600 / (2 * a)
    low = half.evaluate((0.5, 0.0))[2]
    at = lambda x, z: [(x + a) * scale + 24, (-low - z) * scale + 24]  # noqa: E731
    seen = dots(text)
    wanted = np.array([at(i * x, k * z) for i in (-1, 1) for k in (-1, 1)])
    off = np.linalg.norm(seen[:, None] - wanted, axis=2)
    inside = np.abs(z) <= -low
    assert inside and off.min(1).max() < 4 and off.min(0).max() < 4
