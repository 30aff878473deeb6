"""Fits, constructions and offsets: closed forms, proven distances, misuse."""

import numpy as np
import pytest

import footpoint
from footpoint import construct as c

T = np.linspace(0, 1, 400)
HELIX = np.stack([2 * np.cos(5 * T), 2 * np.sin(5 * T), T], -1)
U, V = np.meshgrid(np.linspace(0, 1, 60), np.linspace(0, 1, 50), indexing="ij")
SHEET = np.stack([4 * U, 3 * V, np.sin(3 * U) * np.cos(2 * V)], -1)


def test_interpolants():
    at = c.parameters(HELIX)
    assert np.allclose(c.interpolate(HELIX).evaluate(at), HELIX, atol=1e-12)
    tangents = ([0, 10, 1], None)
    curve = c.interpolate(HELIX, parameters=at, tangents=tangents)
    assert np.allclose(curve.evaluate(0.0, 1)[1], tangents[0], atol=1e-9)
    assert np.allclose(c.interpolate(HELIX, 5, at, natural=True).evaluate(at), HELIX, atol=1e-11)
    square = c.interpolate([[1, 0], [0, 1], [-1, 0], [0, -1]], periodic=True)
    assert square.is_closed and np.allclose(square.evaluate(0.5), [-1, 0, 0])
    grid = c.interpolate_grid(SHEET)
    assert np.allclose(grid.evaluate([1.0, 1.0]), SHEET[-1, -1])
    with pytest.raises(ValueError, match="exclude"):
        c.interpolate(HELIX, natural=True, periodic=True)
    with pytest.raises(ValueError, match="parameter 2"):
        c.interpolate(HELIX[:4], parameters=[0, 1, 1, 2])


def test_fits_keep_what_they_say():
    curve, d = c.fit_curve(HELIX, 1e-5)
    feet = curve.closest(HELIX)
    assert d.worst <= 1e-5 and d.unproven == 0
    # at_least and worst are closed to 1e-10 of the box; distances are rounded.
    assert feet.distance.max() <= d.worst + 1e-15 and d.at_least <= feet.lower_bound.max() + 1e-15 and d.worst - d.at_least < 1e-8
    for surface, d in (c.fit_grid(SHEET, 1e-4), c.fit_surface(SHEET.reshape(-1, 3), 1e-3)):
        feet = surface.closest(SHEET.reshape(-1, 3))
        assert d.unproven == 0 and feet.distance.max() <= d.worst + 1e-9 and d.worst <= 1e-3
        assert np.argmax(feet.distance) == d.worst_index
    _, plain = c.fit_grid(SHEET, 1e-4, certify=False)
    assert plain.unproven == U.size and plain.at_least == 0
    _, rough = c.fit_curve(HELIX, 1e-9, max_poles=8)
    assert rough.worst > 1e-9
    line, d = c.least_squares(1, [0, 0, 1, 1], T, HELIX, free_ends=True)
    assert line.degree == 1 and d.worst > 1
    with pytest.raises(ValueError, match="tolerance"):
        c.fit_curve(HELIX, 0)
    with pytest.raises(footpoint.Cancelled):
        c.fit_surface(SHEET.reshape(-1, 3), 1e-9, should_stop=lambda: True)


def test_conics_and_quadrics():
    for form in c.ArcForm:
        end = 3.0 if form is c.ArcForm.CUBIC else 2 * np.pi
        points = c.arc(2, 0, end, form=form).evaluate(T)
        assert np.allclose(np.hypot(points[:, 0], points[:, 1]), 2, atol=1e-13)
    axes = [[1, 2, 3], [0, 0, 2], [0, 1, 0]]
    assert np.allclose(c.arc(2, axes=axes).evaluate(0.0), [1, 4, 3])
    torus = c.torus(3, 1).evaluate(np.random.default_rng(1).uniform(0, 1, (100, 2)))
    assert np.allclose(np.hypot(np.hypot(torus[:, 0], torus[:, 1]) - 3, torus[:, 2]), 1, atol=1e-13)
    sheet = c.quadric(c.QuadricKind.ONE_SHEET, [1, 2, 3], [0, 6], [-1, 1]).evaluate(np.random.default_rng(2).uniform(0, 1, (100, 2)))
    assert np.allclose(sheet[:, 0] ** 2 + sheet[:, 1] ** 2 / 4 - sheet[:, 2] ** 2 / 9, 1, atol=1e-13)


def test_offsets_and_sweeps():
    ring = c.arc(2, 0, 3, form=c.ArcForm.CUBIC)
    exact = c.offset(ring, 0.5)
    assert np.allclose(np.linalg.norm(exact.evaluate(T), axis=1), 2.5, atol=1e-13)
    with pytest.raises(NotImplementedError):
        exact.poles
    fit, measured, proven = c.fit_offset(ring, 0.5, 1e-6)
    assert measured <= proven <= 1e-6
    assert abs(np.linalg.norm(fit.evaluate(T), axis=1) - 2.5).max() <= proven
    pipe = c.swept(c.arc(0.5, axes=[[2, 0, 0], [0, -1, 0], [1, 0, 0]]), c.arc(2), 1e-5)
    points = pipe.surface.evaluate(np.random.default_rng(3).uniform(0, 1, (100, 2)))
    assert pipe.error <= 1e-5 and abs(np.hypot(np.hypot(points[:, 0], points[:, 1]) - 2, points[:, 2]) - 0.5).max() < 1.1e-5
    with pytest.raises(TypeError, match="a Curve is needed"):
        c.ruled(ring, "line")
    with pytest.raises(ValueError, match="corner"):
        c.coons([c.line([0, 0, 0], [0, 1, 0])] * 4)
