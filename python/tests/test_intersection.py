"""Surfaces that meet, from Python: branches against signs on a grid, curves of branches and smoother ones, partial results."""

import numpy as np
import pytest

import footpoint
from footpoint import construct, fair, operate

TURN = np.linalg.qr(np.random.default_rng(3).normal(size=(3, 3)))[0]


def sheet(seed, count=7, height=0.6, turn=None):
    """A bicubic graph over [-1, 1]^2, u = x and v = y, or that turned."""
    rng = np.random.default_rng(seed)
    knots = np.r_[[-1.0] * 4, np.linspace(-1, 1, count - 2)[1:-1], [1.0] * 4]
    x = np.array([knots[i + 1:i + 4].mean() for i in range(count)])
    poles = np.stack([*np.meshgrid(x, x, indexing="ij"), height * rng.uniform(-1, 1, (count, count))], -1)
    return footpoint.Surface(3, 3, knots, knots, poles if turn is None else poles @ turn)


def to_chords(points, branch):
    p = branch.points["point"]
    a, d = p[:-1], np.diff(p, axis=0)
    length = np.maximum((d * d).sum(1), 1e-300)
    t = np.clip(((points[:, None] - a) * d).sum(2) / length, 0, 1)
    return np.linalg.norm(points[:, None] - a - t[..., None] * d, axis=2).min(1)


@pytest.mark.parametrize("seed", range(12))
def test_every_sign_change_is_on_a_branch(seed):
    a, b = sheet(seed), sheet(seed + 100)
    found = footpoint.intersect_surfaces(sheet(seed, turn=TURN), sheet(seed + 100, turn=TURN), chord=1e-3)
    assert found.is_proven
    x = np.linspace(-1, 1, 201)
    height = a.evaluate(np.stack(np.meshgrid(x, x, indexing="ij"), -1).reshape(-1, 2))[:, 2] - b.evaluate(np.stack(np.meshgrid(x, x, indexing="ij"), -1).reshape(-1, 2))[:, 2]
    height = height.reshape(201, 201)
    i, j = np.nonzero(np.sign(height[1:]) != np.sign(height[:-1]))
    share = height[i, j] / (height[i, j] - height[i + 1, j])
    places = np.stack([x[i] + share * (x[1] - x[0]), x[j]], -1)
    points = a.evaluate(places) @ TURN
    assert len(points) > 20
    near = np.min([to_chords(points, branch) for branch in found.branches], axis=0)
    assert near.max() < 5e-3, places[near.argmax()]
    for branch in found.branches:
        on = a.evaluate(branch.points["uv"])
        assert np.abs(on @ TURN - branch.points["point"]).max() < 1e-12
        assert np.abs(b.evaluate(branch.points["st"]) - on).max() < 1e-12


def test_curves_of_a_branch_and_smoother_ones():
    a, b = construct.torus(2, 0.5), sheet(5, height=0.2)
    big = operate.affine(b, [[3, 0, 0, 0], [0, 3, 0, 0], [0, 0, 1, 0]])
    found = footpoint.intersect_surfaces(a, big)
    assert found.is_proven and found.branches
    for number in range(len(found.branches)):
        for part in found.curves(number, 1e-5):
            assert part.error <= 1e-5
            low, high = part.space.domain
            t = np.linspace(low, high, 200)
            p = part.space.evaluate(t)
            for surface, plane in ((a, part.uv), (big, part.st)):
                on = surface.evaluate(plane.evaluate(t)[:, :2])
                assert np.linalg.norm(on - p, axis=1).max() <= part.error * (1 + 1e-9) + 1e-14
            # Smooth by energy: what it moves is proven, and adds to the error.
            report = fair.curve(part.space, 1e-4)
            off = np.linalg.norm(report.shape.evaluate(t) - p, axis=1).max()
            assert off <= report.deviation <= 1e-4
            assert report.energies[-1] <= report.energies[0]


def test_a_short_budget_and_a_stop():
    a, b = sheet(1), sheet(101)
    part = footpoint.intersect_surfaces(a, b, budget=20)
    assert part.is_exhausted and not part.is_proven and len(part.undecided)
    whole = footpoint.intersect_surfaces(a, b)
    # What the short one does not have lies in its undecided boxes.
    for branch in whole.branches:
        at = np.hstack([branch.points["uv"], branch.points["st"]])
        low, high = part.undecided[:, 0::2], part.undecided[:, 1::2]
        inside = ((at[:, None] >= low - 1e-9) & (at[:, None] <= high + 1e-9)).all(2).any(1)
        near = np.min([to_chords(branch.points["point"], one) for one in part.branches] or [np.full(len(at), np.inf)], axis=0)
        assert (inside | (near < 0.05)).all()
    with pytest.raises(footpoint.Cancelled) as stopped:
        footpoint.intersect_surfaces(a, b, should_stop=lambda: True)
    part = stopped.value.found
    assert part.is_stopped and not part.is_proven and not part.branches and len(part.undecided) and "stopped" in repr(part)
    # A stop at any question: what was found is given, the rest is undecided.
    asked = []
    footpoint.intersect_surfaces(a, b, should_stop=lambda: asked.append(0))
    some = 0
    for end in range(len(asked)):
        left = [end]
        with pytest.raises(footpoint.Cancelled) as stopped:
            footpoint.intersect_surfaces(a, b, should_stop=lambda: left.append(left.pop() - 1) or left[0] < 0)
        part = stopped.value.found
        some += bool(part.branches and len(part.undecided))
        for branch in whole.branches:
            at = np.hstack([branch.points["uv"], branch.points["st"]])
            low, high = part.undecided[:, 0::2], part.undecided[:, 1::2]
            inside = ((at[:, None] >= low - 1e-9) & (at[:, None] <= high + 1e-9)).all(2).any(1)
            near = np.min([to_chords(branch.points["point"], one) for one in part.branches] or [np.full(len(at), np.inf)], axis=0)
            assert (inside | (near < 0.05)).all(), end
    assert some


def test_curves_and_splits_ask_and_tell():
    a, b = sheet(1), sheet(101)
    found, told = footpoint.intersect_surfaces(a, b), []
    [part, *_] = found.curves(0, 1e-6, should_stop=lambda: False, progress=lambda done, total: told.append((done, total)))
    assert part.error <= 1e-6 and told and all(done <= total for done, total in told)
    with pytest.raises(footpoint.Cancelled):
        found.curves(0, 1e-9, should_stop=lambda: True)
    faces = [footpoint.trims.TrimmedSurface.whole(footpoint.trims.Support(shape)) for shape in (a, b)]
    cut = footpoint.intersect_trims(*faces)
    assert len(cut.split(0, 1e-6, progress=lambda done, total: None)) >= 1
    with pytest.raises(footpoint.Cancelled):
        cut.split(0, 1e-6, should_stop=lambda: True)
    with pytest.raises(TypeError, match="chord"):
        cut.split(0, 1e-6, chord=1)


def test_each_method_by_name():
    ring, plane = construct.torus(0.6, 0.25), sheet(5, height=0.2)
    proven = footpoint.intersect_surfaces(ring, plane, chord=1e-4)
    assert proven.is_proven and proven.branches
    branch = max(proven.branches, key=lambda branch: len(branch.points))
    place = branch.points[len(branch.points) // 3]
    at = np.hstack([place["uv"], place["st"]])
    start = at + [2e-3, -3e-3, 4e-3, -2e-3]
    for corrector in footpoint.Corrector:
        seen = []
        try:
            found = footpoint.intersect_correct(ring, plane, start, corrector=corrector, tolerance=1e-11, trace=lambda *step: seen.append(step))
        except RuntimeError as error:
            # An isoline that is held may miss the curve.
            assert "HOLDS" in corrector.name and "corrector" in str(error)
            continue
        assert found.gap <= 1e-11 and [step for step, _, _ in seen] == list(range(found.steps + 1))
        assert np.allclose(seen[0][1], start) and seen[-1][2] == found.gap
        assert np.abs(ring.evaluate(found.place["uv"]) - plane.evaluate(found.place["st"])).max() <= 1e-11
        assert to_chords(found.place["point"][None], branch).max() < 0.05
        if "HOLDS" in corrector.name:
            held = "UVST".index(corrector.name[-1])
            assert np.hstack([found.place["uv"], found.place["st"]])[held] == start[held]
    with pytest.raises(ZeroDivisionError):
        footpoint.intersect_correct(ring, plane, start, trace=lambda *step: 1 / 0)
    for corrector in ("AUTO", "MAF", "NEWTON_FOUR"):
        walk = footpoint.intersect_march(ring, plane, start, chord=1e-4, corrector=footpoint.Corrector[corrector])
        assert not walk.is_proven and len(walk.undecided) == 1 and len(walk.branches) == 1
        points = walk.branches[0].points
        assert len(points) > 5 and walk.branches[0].gap <= 1e-6
        assert np.min([to_chords(points["point"], one) for one in proven.branches], axis=0).max() < 1e-3
    coarse = np.hstack([points["uv"], points["st"]])[:: max(1, len(points) // 6)]
    fine = footpoint.intersect_bisect(ring, plane, coarse, chord=1e-5)
    assert len(fine.branches[0].points) > len(coarse)
    assert to_chords(fine.branches[0].points["point"], branch).max() < 1e-3
    for method, levels in (("SUBDIVISION", 4), ("SUBDIVISION", 0), ("MESH", 80)):
        found = footpoint.intersect_surfaces(ring, plane, method=footpoint.IntersectMethod[method], levels=levels, chord=1e-3)
        assert not found.is_proven and len(found.undecided) == 1 and found.branches
        for one in found.branches:
            assert 0 < one.gap < 0.1
            assert np.min([to_chords(one.points["point"], other) for other in proven.branches], axis=0).max() < 0.1
    with pytest.raises(ValueError, match="levels"):
        footpoint.intersect_surfaces(ring, plane, method=2, levels=5000)
    with pytest.raises(ValueError, match="method"):
        footpoint.intersect_surfaces(ring, plane, method=9)
    with pytest.raises(ValueError, match="corrector"):
        footpoint.intersect_march(ring, plane, start, corrector=9)
    with pytest.raises(ValueError, match="uvst"):
        footpoint.intersect_correct(ring, plane, [0, 0, np.nan, 0])
    with pytest.raises(ValueError, match="places"):
        footpoint.intersect_bisect(ring, plane, coarse[:1])
    with pytest.raises(footpoint.Cancelled) as stopped:
        footpoint.intersect_march(ring, plane, start, should_stop=lambda: True)
    assert stopped.value.found.is_stopped


def test_a_point_tolerance():
    a, b = sheet(1), sheet(101)
    for tolerance, holds in ((1e-9, True), (1e-18, False)):
        found = footpoint.intersect_surfaces(a, b, tolerance=tolerance)
        assert found.is_proven == holds and found.branches
    lifted = operate.affine(a, [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 1e-9]])
    same = footpoint.intersect_surfaces(a, lifted, tolerance=1e-7)
    assert len(same.overlaps) and not same.is_proven
    with pytest.raises(ValueError, match="tolerance"):
        footpoint.intersect_surfaces(a, b, tolerance=-1)


def test_refusals():
    a = sheet(1)
    for options, name in (({"chord": -1.0}, "chord"), ({"chord": np.nan}, "chord"), ({"budget": -1}, "budget")):
        with pytest.raises((ValueError, OverflowError), match=name):
            footpoint.intersect_surfaces(a, a, **options)
    with pytest.raises(TypeError, match="b:"):
        footpoint.intersect_surfaces(a, construct.line([0, 0, 0], [1, 0, 0]))
    with pytest.raises((IndexError, ValueError), match="index|branch"):
        footpoint.intersect_surfaces(a, sheet(101)).curves(10**6, 1e-3)
