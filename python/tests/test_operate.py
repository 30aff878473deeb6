"""Operations on shapes: exact ones stay, approximate ones keep their error, wrong use is named."""

import numpy as np
import pytest
from shapes import circle, cylinder

import footpoint
from footpoint import operate


def test_a_circle_is_what_it_was():
    ring = circle()
    radius = float(np.linalg.norm(ring.evaluate(0.0)[:2]))
    value, error = operate.ArcLength(ring).total
    assert abs(value - 2 * np.pi * radius) <= error < 1e-11
    for other in (operate.elevate(ring, 3), operate.clamp(ring), operate.bezier_form(ring), operate.periodic(ring, 1e-9)[0]):
        assert operate.difference(ring, other).bound < 1e-12
    frame = operate.frame(ring, 0.4)
    assert abs(frame.curvature - 1 / radius) < 1e-13 and abs(frame.torsion) < 1e-13
    assert all(joint.order >= 1 for joint in operate.continuity(ring))


def test_lengths_and_places_are_inverse():
    arch = footpoint.Curve.from_poles(3, [[0, 0], [1, 2], [3, 2], [4, 0], [5, 1]])
    length = operate.ArcLength(arch)
    places = np.linspace(0, 1, 7)
    there = length.at(places)
    back = length.parameters(there["value"].clip(0, length.total[0]))
    assert np.all(np.abs(back["value"] - places) < 1e-11) and np.all(back["error"] < 1e-10)


def test_errors_are_proven():
    rng = np.random.default_rng(7)
    curve = footpoint.Curve.from_poles(3, rng.normal(size=(30, 3)))
    thin, error = operate.simplify(curve, 0.2)
    u = np.linspace(0, 1, 2000)
    apart = np.linalg.norm(curve.evaluate(u) - thin.evaluate(u), axis=1).max()
    assert apart <= error <= 0.2 and len(thin.poles) < 30


def test_surfaces_need_a_direction_and_curves_have_none():
    with pytest.raises(ValueError, match="direction"):
        operate.elevate(cylinder())
    with pytest.raises(ValueError, match="direction"):
        operate.elevate(circle(), 1, "u")
    with pytest.raises(TypeError, match="Curve or a Surface"):
        operate.clamp(3)
    with pytest.raises(ValueError, match="tolerance"):
        operate.simplify(circle(), -1)
    with pytest.raises(ValueError, match="none given"):
        operate.join([], 0)
    with pytest.raises(TypeError, match="one kind"):
        operate.join([circle(), cylinder()], 0)


def test_power_form_is_the_curve():
    arch = footpoint.Curve.from_poles(3, [[0, 0, 1], [1, 2, 0], [3, 2, 0], [4, 0, 2]])
    (coefficients,) = operate.power(arch)
    t = 0.3
    h = sum(a * t**k for k, a in enumerate(coefficients))
    assert np.allclose(h[:3] / h[3], arch.evaluate(t), atol=1e-14)
    assert operate.difference(arch, operate.from_power(coefficients, [0, 1])).bound < 1e-13


def test_a_patch_goes_through_the_power_form_and_knot_lines_are_told():
    rng = np.random.default_rng(3)
    sheet = footpoint.Surface.from_poles(2, 3, rng.normal(size=(5, 6, 3)))
    powers = operate.power(sheet)
    assert powers.shape == (3, 3, 3, 4, 4)
    corners = [np.unique(knots) for knots in sheet.knots]
    for i in range(3):
        for j in range(3):
            domain = [*corners[0][i:i + 2], *corners[1][j:j + 2]]
            patch = operate.part(sheet, domain)
            assert operate.difference(patch, operate.from_power(powers[i, j], domain)).bound < 1e-12
    lines = operate.continuity(sheet, direction="u")
    assert [line.value for line in lines] == list(corners[0][1:-1]) and all(line.order == 1 and line.multiplicity == 1 for line in lines)
    broken = operate.refine(sheet, [corners[1][1]] * 2, "v")
    assert operate.continuity(broken, direction="v")[0].multiplicity == 3 and operate.continuity(broken, direction="v")[0].order == 2
    with pytest.raises(ValueError, match="direction"):
        operate.continuity(sheet)
    with pytest.raises(ValueError, match="degree_u"):
        operate.from_power(np.zeros((1, 2, 4)), [0, 1, 0, 1])
