"""Fairing and inspection, as a user calls them."""

import struct
import zlib

import numpy as np
import pytest
from shapes import circle, cylinder, hill

import footpoint
from footpoint import fair, inspect


def wavy(count=24, height=2e-3):
    knots = np.concatenate([[0] * 3, np.linspace(0, 1, count - 2), [1] * 3])
    x = np.convolve(knots[1:-1], np.ones(3) / 3, "valid")  # x is the parameter
    return footpoint.Curve.from_poles(3, np.column_stack([x, x * (1 - x) + height * (-1.0) ** np.arange(count)]))


def turns(curve):
    return int((inspect.inflections(curve, (0, 0, 1))["kind"] == inspect.Kind.INFLECTION).sum())


@pytest.mark.parametrize("method", list(fair.Method))
def test_a_curve_gets_fairer_within_the_deviation(method):
    curve = wavy()
    report = fair.curve(curve, 6e-3, method=method, strain=0, jerk=1, ends=[1, 1])
    assert np.all(np.diff(report.energies) <= 0) and report.energies[-1] < report.energies[0] / 5
    assert 0 < report.deviation <= 6e-3 and turns(report.shape) <= turns(curve) / 3
    u = np.linspace(0, 1, 500)
    assert np.linalg.norm(curve.evaluate(u) - report.shape.evaluate(u), axis=1).max() <= report.deviation
    assert np.array_equal(curve.knots, report.shape.knots) and "energy" in repr(report)
    distance = inspect.hausdorff(curve, report.shape, accuracy=1e-4)
    assert all(part.lower <= report.deviation and part.proven for part in distance)


def test_what_is_kept_is_kept():
    curve = wavy()
    report = fair.curve(curve, 5e-3, ends=[3, 1], fixed=[7], through=[0.5])
    assert np.array_equal(report.shape.poles[7], curve.poles[7]) and not np.array_equal(report.shape.poles[9], curve.poles[9])
    assert np.allclose(report.shape.evaluate(0.5), curve.evaluate(0.5), atol=1e-12, rtol=0)
    assert np.allclose(report.shape.evaluate(0.0, 2), curve.evaluate(0.0, 2), atol=1e-9, rtol=0)
    surface = fair.surface(hill(), 0.05, borders=[1, 1, 0, 3])
    assert np.array_equal(surface.shape.poles[:, -3:], hill().poles[:, -3:]) and surface.deviation <= 0.05
    with pytest.raises(ValueError, match="deviation"):
        fair.curve(curve, 0)
    with pytest.raises(ValueError, match="ends"):
        fair.curve(curve, 1, ends=[1, 2, 3])
    with pytest.raises(TypeError, match="not an option"):
        fair.curve(curve, 1, wrong=3)
    with pytest.raises(TypeError, match="a Surface is needed"):
        fair.surface(curve, 1)
    with pytest.raises(footpoint.Cancelled):
        fair.curve(curve, 1, should_stop=lambda: True)


def test_curvatures_have_their_closed_forms():
    radius = float(np.linalg.norm(circle().evaluate(circle().domain[0])))
    found = inspect.curvature_range(circle())
    assert found.proven and found.radius[0] <= radius <= found.radius[1] and found.radius[1] - found.radius[0] < 3e-3 * radius
    assert np.allclose(inspect.comb(circle())["curvature"], 1 / radius)
    assert inspect.monotone_pieces(circle())["kind"].tolist() == [inspect.Kind.CONSTANT]
    tube = inspect.curvature_range(cylinder())
    at = inspect.curvatures(cylinder(), [[1, 0.5]])[0]
    assert tube.proven and tube.greatest[0] <= np.abs(at["principal"]).max() * (1 + 1e-12) and np.abs(at["principal"]).max() <= tube.greatest[1] * (1 + 1e-12)
    flat = inspect.curvature_range(cylinder(), inspect.Quantity.GAUSSIAN)
    assert flat.least[0] <= 0 <= flat.greatest[1] and at["gaussian"] == pytest.approx(0, abs=1e-12)
    assert not len(inspect.umbilics(cylinder()))


def test_a_tip_has_no_bound_and_the_rest_has():
    # The graph of a cone over three lines of a bent fan: a quarter of a tent with a bent foot.
    foot = [[1, 0, -1], [1, 1, -1.3], [0, 1, -1]]
    tent = footpoint.Surface(2, 1, [0, 0, 0, 1, 1, 1], [0, 0, 1, 1], [[[0, 0, 0], pole] for pole in foot])
    found, places = inspect.curvature_range_places(tent, side=inspect.Side.GREATEST)
    assert found.unbounded == (False, True) and found.rest_proven and not found.proven and 0 < found.excluded < 0.01
    assert inspect.curvature_range(tent, side=inspect.Side.GREATEST) == found
    assert places["kind"].tolist() == [inspect.Kind.UNBOUNDED] and places["value"][0][1] == 0 and places["v"][0][0] == 0
    v = places["v"][0][1]
    rim = max(np.abs(inspect.curvatures(tent, [[u, v]])[0]["principal"]).max() for u in np.linspace(0, 1, 101))
    assert found.greatest[0] * (1 - 1e-3) <= rim <= found.greatest[1] * (1 + 1e-9) and found.greatest[1] < 1.01 * rim
    flat, places = inspect.curvature_range_places(cylinder())
    assert flat.proven and flat.unbounded == (False, False) and flat.rest_proven and not len(places)


def test_borders_and_distances():
    low = hill()
    gap = inspect.border(low, 0, low, 0)
    assert gap.gap.upper < 1e-3 and gap.angle.lower < 1e-6 and gap.curvature.lower < 1e-6
    lifted = footpoint.Surface(*low.degrees, *low.knots, low.poles + [0, 0, 0.5], low.weights)
    one, two = inspect.hausdorff(low, lifted, accuracy=0.05)
    assert one.lower <= 0.5 and one.proven and two.proven and one.upper >= one.lower > 0.1


def test_pictures_are_png_and_svg(tmp_path):
    for pattern in inspect.Pattern:
        made = inspect.picture(hill(), pattern, size=(60, 40))
        assert made.pixels.shape == (40, 60, 3) and (made.pixels != 255).any() and (made.pixels[0, 0] == 255).all()
    made.save(tmp_path / "hill.png")
    data = (tmp_path / "hill.png").read_bytes()
    assert data.startswith(b"\x89PNG\r\n\x1a\n") and struct.unpack(">II", data[16:24]) == (60, 40)
    start = data.index(b"IDAT")
    rows = np.frombuffer(zlib.decompress(data[start + 4 : start + 4 + struct.unpack(">I", data[start - 4 : start])[0]]), np.uint8)
    assert np.array_equal(rows.reshape(40, -1)[:, 1:].reshape(40, 60, 3), made.pixels)
    text = inspect.comb_svg(wavy())
    assert text.startswith("<svg") and text.count("<circle") == turns(wavy())
    with pytest.raises(ValueError, match="bands"):
        inspect.picture(hill(), bands=0)
    with pytest.raises(ValueError, match="size"):
        inspect.picture(hill(), size=(9000, 2))
