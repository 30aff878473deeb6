"""Intersections from Python: closed forms, wrong arguments, cancelling."""

import numpy as np
import pytest
from shapes import circle, cylinder

import footpoint
from footpoint import intersect
from footpoint.intersect import Caster, End, HitNature, Quadric, RayFlag


def square():
    return footpoint.Surface.from_poles(1, 1, [[[0, 0, 0], [0, 2, 0]], [[2, 0, 0], [2, 2, 0]]])


def test_curves():
    a = footpoint.Curve.from_poles(1, [[0, 0], [2, 2]])
    found = intersect.curves(a, footpoint.Curve.from_poles(1, [[0, 2], [2, 0]]))
    assert found.is_complete and found.hits["multiplicity"].tolist() == [1]
    assert np.allclose(found.hits["point"], [[1, 1, 0]], atol=1e-15)
    assert intersect.curves(a, a).hits["nature"].tolist() == [HitNature.OVERLAP]
    assert not intersect.curves(circle(), circle(), budget=3).is_complete
    with pytest.raises(footpoint.Cancelled) as stopped:
        intersect.curves(a, a, should_stop=lambda: True)
    assert not stopped.value.found.is_complete and not len(stopped.value.found.hits)
    assert stopped.value.found.undecided.tolist() == [[0, 1, 0, 0, 0, 1]]
    with pytest.raises(footpoint.Cancelled) as stopped:
        intersect.sections(square(), [Quadric.plane([1, 0, 0], [1, 0.1, 0])] * 3, should_stop=lambda: True, threads=1)
    assert [one.is_complete for one in stopped.value.found] == [False] * 3
    with pytest.raises(TypeError, match="second"):
        intersect.curves(a, square())
    with pytest.raises(ValueError, match="tolerance"):
        intersect.curves(a, a, tolerance=-1)


def test_surface_and_quadric():
    rod = footpoint.Curve.from_poles(1, [[0.5, 1, -1], [0.5, 1, 3]])
    found = intersect.surface_curve(square(), rod)
    assert np.allclose([found.hits["u"], found.hits["v"], found.hits["w"]], [[0.25], [0.5], [0.25]])
    ball = Quadric.sphere([0.5, 1, 0], 1)
    assert np.allclose(intersect.curve_quadric(rod, ball).hits["point"][:, 2], [1] if len(intersect.curve_quadric(rod, ball).hits) == 1 else [-1, 1])
    with pytest.raises(ValueError, match="radius"):
        intersect.curve_quadric(rod, Quadric.sphere([0, 0, 0], -1))


def test_sections():
    done = []
    cuts = [Quadric.cylinder([1, 1, 5], [0, 0, 1], 0.5), Quadric.plane([0, 0, 0], [0, 0, 1]), Quadric.sphere([1, 1, 2], 2),
            Quadric.general([1, 1, 0], np.eye(3), [0, 0, 0], -0.25), Quadric.cone([1, 1, 1], [0, 0, 1], 0.5)]
    found = intersect.sections(square(), cuts, progress=lambda k, n: done.append((k, n)))
    assert done[-1] == (5, 5)
    for k in (0, 3, 4):
        [loop] = found[k].branches
        assert loop.is_closed and loop.ends == (End.CLOSED, End.CLOSED) and not loop.tangential
        assert np.allclose(np.hypot(*(loop.points[:, :2] - 1).T), 0.5, atol=1e-14)
        assert np.allclose(loop.points[:, :2], 2 * loop.parameters)
    assert found[1].overlaps.tolist() == [[0, 1, 0, 1]] and not found[1].branches
    assert found[2].points["arms"].tolist() == [0] and found[2].is_complete
    with pytest.raises(ValueError, match="count"):
        intersect.sections(square(), [])
    with pytest.raises(TypeError, match="Quadric"):
        intersect.sections(square(), [3])


def test_conics():
    [ring] = intersect.conics(Quadric.sphere([0, 0, 0], 1), Quadric.sphere([1, 0, 0], 1), 1e-9)
    assert np.allclose(ring["center"], [0.5, 0, 0]) and np.allclose(ring["lengths"], 0.75**0.5)
    with pytest.raises(NotImplementedError):
        intersect.conics(Quadric.sphere([0, 0, 0], 1), Quadric.cylinder([0.3, 0, 0], [0, 1, 1], 0.9), 1e-9)


def test_rays():
    tube = cylinder()
    caster = Caster(tube)
    box = tube.box
    centre = box.mean(axis=0)
    angles = np.linspace(0, 2 * np.pi, 200, endpoint=False)
    away = 3 * np.linalg.norm(box[1] - box[0])
    directions = np.stack([np.cos(angles), np.sin(angles), 0 * angles], axis=1)
    first = caster.first(centre - away * directions, directions)
    hits, starts, flags = caster.all(centre - away * directions, directions, threads=2)
    assert (first["count"] == np.diff(starts)).all() and not flags.any()
    assert (hits["t"][starts[:-1]] == first["t"]).all()
    assert caster.first([np.nan, 0, 0], [1, 0, 0])["flags"].tolist() == [RayFlag.BAD_RAY | RayFlag.NOT_PROVEN]
    with pytest.raises(ValueError, match="origins"):
        caster.first([[1, 2]], [1, 0, 0])
