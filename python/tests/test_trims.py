"""Trimmed surfaces from Python: what goes in comes out, changes are proven, defects are found, nothing bad gets through."""

import ctypes
import gc
import math

import footpoint
import numpy as np
import pytest
from footpoint import Curve, Flag, trims

TURN = 2 * math.pi


def sphere(radius=2.0):
    return trims.Support.elementary("sphere", [0, TURN, -TURN / 4, TURN / 4], first=radius)


def holed(support):
    knots, poles = [0, 0, 0, 1, 1, 1], [[1, -1, 0], [2, -1.2, 0], [3, -1, 0]]
    lower = Curve(2, knots, poles)
    outer = trims.Loop([trims.Coedge.spline(lower), trims.Coedge.isoline("u", 3, -1, 1), trims.Coedge.isoline("v", 1, 3, 1),
                        trims.Coedge.isoline("u", 1, 1, -1)])
    arc = trims.Coedge.arc([1.5, 0], [0.2, 0], [0, -0.3], 0, TURN)
    polygon = trims.Coedge.polyline([[2.0, 0.0], [2.1, 0.3], [2.4, 0.2], [2.0, 0.0]])
    return trims.TrimmedSurface(support, [outer, trims.Loop([arc], True), trims.Loop([polygon], True)])


def test_what_goes_in_comes_out():
    face = holed(sphere())
    loops = face.loops
    assert [loop.is_inner for loop in loops] == [False, True, True]
    assert [c.kind.name for loop in loops for c in loop.coedges] == ["SPLINE", "ISOLINE", "ISOLINE", "ISOLINE", "ARC", "POLYLINE"]
    assert loops[1].coedges[0].values == [1.5, 0, 0.2, 0, 0, -0.3, 0, TURN]
    np.testing.assert_array_equal(loops[2].coedges[0].points, [[2.0, 0.0], [2.1, 0.3], [2.4, 0.2], [2.0, 0.0]])
    again = trims.TrimmedSurface(face.support, loops, face.edges)
    assert again.to_json() == face.to_json() == trims.TrimmedSurface.from_json(face.to_json()).to_json()
    assert face.report().findings == []


def test_a_whole_sphere_has_a_seam_and_two_points():
    face = trims.TrimmedSurface.whole(sphere())
    assert [edge.curve is None for edge in face.edges] == [True, False, True]
    uv, points, edge = face.evaluate(0, 3, [0, 0.5, 1])
    np.testing.assert_allclose(points, edge, atol=1e-14)
    assert (uv[:, 0] == 0).all()


def test_changes_are_proven_and_come_back():
    support, arcs = sphere(), (0, 2)
    face = holed(support)
    there = face.to_nurbs(arcs, tolerance=1e-5, replacement=trims.Replacement.SPLINE)
    assert there.proven and 0 < there.deviation <= 1e-5 and there.face.report().findings == []
    for loop, coedge in ((0, 0), (1, 0), (2, 0)):
        shares = np.linspace(0, 1, 101)
        off = face.evaluate(loop, coedge, shares)[1] - there.face.evaluate(loop, coedge, shares)[1]
        assert np.linalg.norm(off, axis=1).max() <= there.deviation + 1e-14
    back = there.face.to_elementary(support, arcs, tolerance=1e-3, replacement=trims.Replacement.VERTICES).face
    assert [len(loop.coedges) for loop in back.loops] == [4, 1, 1]
    turn = trims.Transform(trims.Relation.linear([0, 1], [1, 0]), trims.Relation.linear([0, 1], [0, 1]))
    turned = there.face.reparametrise(turn)
    assert turned.face.is_flipped and turned.deviation == 0 and not turn.keeps_direction


def test_matching_agrees_with_the_closed_form():
    support, arcs = sphere(), (0, 2)
    form = trims.Support(support.spline(arcs))
    rng = np.random.default_rng(1)
    uv = rng.uniform([0, -TURN / 4], [TURN, TURN / 4], (500, 2))
    uv[:4] = [[0, 0.3], [TURN, 0.3], [1, TURN / 4], [0, -TURN / 4]]
    feet = support.match_many(form, uv)
    expected = support.spline_transform(arcs)(uv)
    assert not feet["flags"].any()
    np.testing.assert_allclose(np.stack([feet["u"], feet["v"]], -1), expected, atol=1e-12)
    assert feet["u"][0] == 0 and feet["u"][1] == 1
    assert Flag(int(support.match_many(form, [7.0, 0.0])["flags"])) & Flag.BAD_QUERY


def test_relations_go_both_ways_and_of_functions_too():
    circle = trims.Relation.circle(0, math.pi)
    x = np.linspace(0, 1, 1001)
    np.testing.assert_allclose(circle.inverse()(circle(x)), x, atol=1e-15, rtol=0)
    np.testing.assert_allclose(circle(x), 2 / math.pi * np.arctan2(x, 1 - x), atol=5e-16, rtol=0)
    square = trims.Relation.function(lambda x: x * x, math.sqrt, [1, 3])
    both = trims.Transform(square, trims.Relation.linear([0, 1], [0, 1]))
    del square
    gc.collect()
    assert both([2, 0.5]).tolist() == [4, 0.5] and both.inverse()([4, 0.5]).tolist() == [2, 0.5]
    with pytest.raises(ValueError, match="function: value at the ends: entry 0 is not finite"):
        trims.Relation.function(lambda x: 1 / 0, math.sqrt, [1, 3])


def test_defects_are_found():
    support = sphere()
    crossing = [trims.Coedge.polyline([[1, -1], [2, 1], [2, -1], [1, 1], [1, -1]])]
    kinds = {finding.kind for finding in trims.TrimmedSurface(support, [trims.Loop(crossing)]).report().findings}
    assert trims.FindingKind.CROSSING in kinds
    clockwise = [trims.Coedge.polyline([[1, -1], [1, 1], [2, 1], [2, -1], [1, -1]])]
    report = trims.TrimmedSurface(support, [trims.Loop(clockwise)]).report()
    assert [finding.kind for finding in report.findings] == [trims.FindingKind.DIRECTION] and report.proven


@pytest.mark.parametrize("change, text", [
    (dict(first=-1.0), "radius: -1"), (dict(domain=[0, 7, 0, 1]), "more than a full turn"), (dict(x=[1, 1, 0]), "x: has the length"),
    (dict(kind=9), "kind: 9"), (dict(domain=[0, math.nan, 0, 1]), "domain: entry 1")])
def test_what_is_no_surface_is_refused(change, text):
    given = dict(kind="sphere", domain=[0, 1, 0, 1], first=1.0) | change
    with pytest.raises(ValueError, match=text):
        trims.Support.elementary(**given)


def test_misuse_is_refused():
    support = sphere()
    with pytest.raises(ValueError, match="loops: none"):
        trims.TrimmedSurface(support, [])
    with pytest.raises(ValueError, match="coedge 0: edge|uses edge 3"):
        trims.TrimmedSurface(support, [trims.Loop([trims.Coedge.isoline("u", 1, 0, 1, edge=3)])])
    with pytest.raises(ValueError, match="json: "):
        trims.TrimmedSurface.from_json("{")
    with pytest.raises(ValueError, match="faces: 0"):
        trims.picture([])
    with pytest.raises(ValueError, match="uv"):
        support.evaluate([1, 2, 3])
    face = holed(support)
    with pytest.raises(ValueError, match="replacement: 9"):
        face.to_nurbs(replacement=9)
    with pytest.raises(ValueError, match="not elementary"):
        face.to_nurbs((0, 2), 1e-3).face.to_nurbs()


def test_pictures_are_text():
    face = holed(sphere())
    svg = trims.picture([face, face], ["before", "after & <later>"], [0, 1, 0])
    assert svg.startswith("<svg") and "after &amp; &lt;later>" in svg and "NaN" not in svg
    assert face._repr_svg_().startswith("<svg") and ctypes.sizeof(ctypes.c_void_p) == 8


def test_making_a_face_can_be_stopped_watched_and_limited():
    """Also when what is called fails: its exception comes out."""
    face, told = trims.TrimmedSurface.whole(sphere()), []
    made = footpoint.Face.of_trim(face, progress=lambda done, total: told.append((done, total)))
    assert told[0] == (0, 4) and told[-1] == (4, 4)
    feet, places = made.closest([[0, 3, 0]])
    assert abs(feet.uv[0, 0] - math.pi / 2) < 1e-12 and places["flags"][0] == 0
    with pytest.raises(RuntimeError, match="cancelled by should_stop"):
        footpoint.Face.of_trim(face, should_stop=lambda: True)
    with pytest.raises(ZeroDivisionError):
        footpoint.Face.of_trim(face, should_stop=lambda: 1 / 0)
    with pytest.raises(NotImplementedError, match="budget: 1 spans"):
        footpoint.Face.of_trim(face, budget=1)


def test_a_face_on_a_function_says_that_distances_are_not_proven():
    surface = footpoint.Surface.from_function(lambda u, v, order: [u, v, u * v], [0, 1, 0, 1])
    face = footpoint.Face.of_trim(trims.TrimmedSurface.whole(trims.Support(surface)))
    places = face.classify([[0.5, 0.5], [2, 0.5]])
    assert list(places["standing"]) == [footpoint.Standing.INSIDE, footpoint.Standing.OUTSIDE]
    assert places["flags"][0] in (0, footpoint.StandingFlag.NOT_PROVEN)
    feet, places = face.closest([[0.5, 0.5, 1]])
    assert not feet.proven[0] and places["flags"][0] == footpoint.StandingFlag.NOT_PROVEN


def test_arcs_by_angle_and_bounds_of_gaps():
    arc = trims.arc_by_angle([1, 2, 3], [2, 0, 0], [0, 0, 1], 0, 2 * math.pi)
    assert np.allclose(arc.evaluate(1.3), [1 + 2 * math.cos(1.3), 2, 3 + math.sin(1.3)], atol=1e-14)
    report = trims.TrimmedSurface.whole(sphere()).report()
    assert report.findings == [] and report.largest_gap <= report.gap_bound < 1e-6
