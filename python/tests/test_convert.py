"""Shapes of other packages: the same points at the same parameters."""

import numpy as np
import pytest

import footpoint
from footpoint import _native


def test_angles_and_their_inverse():
    for low, high in ((0, 2 * np.pi), (1, 1.2), (-np.pi / 2, np.pi / 2), (3.5, 8.1)):
        axis = _native.angle(low, high)
        ring = _native.sampled_curve(axis, lambda t: (3 * np.cos(t), 2 * np.sin(t), 1))
        t = np.linspace(low, high, 500)
        ours = axis.from_native(t)
        assert abs(axis.to_native(ours) - t).max() < 1e-14 * 10
        assert abs(ring.shape.evaluate(ours) - np.stack([3 * np.cos(t), 2 * np.sin(t), 1 + 0 * t], 1)).max() < 1e-14


def test_geomdl():
    geomdl = pytest.importorskip("geomdl")
    from geomdl import BSpline, NURBS, utilities

    rng = np.random.default_rng(2)
    for kind, rational in ((BSpline, False), (NURBS, True)):
        curve = kind.Curve()
        curve.degree = 3
        points = rng.normal(size=(7, 2))
        weights = rng.uniform(0.5, 2, 7)
        if rational:
            curve.ctrlptsw = np.column_stack([points * weights[:, None], weights]).tolist()
        else:
            curve.ctrlpts = points.tolist()
        curve.knotvector = utilities.generate_knot_vector(3, 7)
        ours = footpoint.from_geomdl(curve)
        assert abs(ours.evaluate(0.37)[:2] - curve.evaluate_single(0.37)).max() < 1e-13 and ours.is_rational == rational
        surface = kind.Surface()
        surface.degree_u, surface.degree_v = 3, 2
        grid = rng.normal(size=(5, 4, 3))
        heavy = rng.uniform(0.5, 2, (5, 4, 1)) if rational else np.ones((5, 4, 1))
        rows = (np.concatenate([grid * heavy, heavy], -1) if rational else grid).reshape(20, -1).tolist()
        surface.set_ctrlpts(rows, 5, 4)
        surface.knotvector_u, surface.knotvector_v = utilities.generate_knot_vector(3, 5), utilities.generate_knot_vector(2, 4)
        assert abs(footpoint.from_geomdl(surface).evaluate([0.3, 0.8]) - surface.evaluate_single((0.3, 0.8))).max() < 1e-13
    assert geomdl


def test_splinepy():
    splinepy = pytest.importorskip("splinepy")
    rng = np.random.default_rng(4)
    knots = [[0, 0, 0, 0, 0.4, 1, 1, 1, 1], [0, 0, 0, 0.5, 1, 1, 1]]
    points, weights = rng.normal(size=(20, 3)), rng.uniform(0.5, 2, (20, 1))
    at = [[0.3, 0.8], [0.6, 0.1]]
    for spline in (splinepy.BSpline([3, 2], knots, points), splinepy.NURBS([3, 2], knots, points, weights),
                   splinepy.Bezier([4, 3], points), splinepy.RationalBezier([3, 4], points, weights)):
        assert abs(footpoint.from_splinepy(spline).evaluate(at) - spline.evaluate(at)).max() < 1e-12
    line = splinepy.BSpline([2], [[0, 0, 0, 0.3, 1, 1, 1]], rng.normal(size=(4, 2)))
    assert abs(footpoint.from_splinepy(line).evaluate([0.2])[:, :2] - line.evaluate([[0.2]])).max() < 1e-12


def test_occ():
    pytest.importorskip("OCP")
    from OCP.BRepPrimAPI import BRepPrimAPI_MakeBox, BRepPrimAPI_MakeTorus
    from OCP.Geom import Geom_Circle, Geom_OffsetSurface, Geom_SphericalSurface
    from OCP.gp import gp_Ax2, gp_Ax3, gp_Dir, gp_Pnt, gp_Trsf, gp_Vec
    from OCP.TopAbs import TopAbs_ShapeEnum
    from OCP.TopExp import TopExp_Explorer
    from OCP.TopLoc import TopLoc_Location

    axes = gp_Ax2(gp_Pnt(1, 2, 3), gp_Dir(1, 1, 0))
    ring = footpoint.convert.native_occ(Geom_Circle(axes, 3))
    assert abs(ring.shape.evaluate(ring.from_native(5.0)) - xyz(Geom_Circle(axes, 3).Value(5.0))).max() < 1e-14 * 10
    ball = Geom_SphericalSurface(gp_Ax3(gp_Pnt(1, 2, 3), gp_Dir(0, 0, 1)), 3)
    native = footpoint.convert.native_occ(ball)
    foot = native.shape.closest(xyz(ball.Value(1.1, 0.4)))
    assert np.allclose(native.to_native(foot.uv), [1.1, 0.4], atol=1e-12)
    assert "function" in repr(footpoint.from_occ(Geom_OffsetSurface(ball, 1.0)))
    moved = gp_Trsf()
    moved.SetTranslation(gp_Vec(100, 0, 0))
    for solid in (BRepPrimAPI_MakeBox(1, 2, 3).Shape(), BRepPrimAPI_MakeTorus(5, 1).Shape()):
        placed = solid.Moved(TopLoc_Location(moved))
        for kind in (TopAbs_ShapeEnum.TopAbs_FACE, TopAbs_ShapeEnum.TopAbs_EDGE):
            explorer = TopExp_Explorer(placed, kind)
            while explorer.More():
                assert footpoint.from_occ(explorer.Current()).box[0, 0] > 90
                explorer.Next()
    with pytest.raises(TypeError, match="shape"):
        footpoint.from_occ(3)


def xyz(point):
    return [point.X(), point.Y(), point.Z()]
