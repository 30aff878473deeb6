"""Answers and arrays: shapes, strides, types, options."""

import pickle
import threading

import numpy as np
import pytest
from shapes import ROOT, circle, cloud, cylinder, hill, wavy

import footpoint
from footpoint import Flag, Kind, Nature
from footpoint._query import Points
from footpoint.cli import load_shape


def test_known_answer():
    foot = hill().closest([12, 17, 9])
    assert abs(foot.uv - [0.413079771308, 0.558075636117]).max() < 1e-11
    assert abs(foot.distance - 2.585284146451313) < 1e-12 and foot.lower_bound <= foot.distance and foot.proven
    assert foot.shape == () and foot.point.shape == (3,)


def test_layouts_give_the_same_bits_and_no_copy():
    surface, points = wavy(), cloud(300)
    plain = surface.closest(points).view(np.ndarray)
    wide = np.zeros((300, 5))
    wide[:, 1:4] = points
    aside = wide[:, 1:4]
    assert Points(aside).rows.base is not None and np.shares_memory(Points(aside).rows, wide)
    assert np.shares_memory(Points(points[::3]).rows, points)
    unaligned = np.frombuffer(b"x" + points.tobytes(), np.uint8)[1:].view(np.float64).reshape(-1, 3)
    reversed_ = np.ascontiguousarray(points[::-1])[::-1]
    for other in (aside, unaligned, reversed_, np.asfortranarray(points), points.astype(">f8"), points.tolist(), points.reshape(3, 100, 3)):
        assert surface.closest(other).view(np.ndarray).reshape(-1).tobytes() == plain.tobytes()
    assert surface.closest(points[::3]).tobytes() == surface.closest(points)[::3].tobytes()
    floats = points.astype(np.float32)
    assert surface.closest(floats).tobytes() == surface.closest(floats.astype(np.float64)).tobytes()
    assert surface.closest(points, threads=1).tobytes() == plain.tobytes()


def test_feet():
    feet = hill().closest(cloud(20))
    assert np.shares_memory(feet.uv, feet) and np.array_equal(feet.uv[:, 1], feet.v)
    assert isinstance(feet[3], footpoint.Feet) and feet[3].u == feet.u[3] and type(feet["flags"]) is np.ndarray
    again = pickle.loads(pickle.dumps(feet))
    assert isinstance(again, footpoint.Feet) and again.tobytes() == feet.tobytes()
    assert hill().closest(np.zeros((0, 3))).uv.shape == (0, 2)
    bad = hill().closest([[np.nan, 0, 0], [1, 1, 1]])
    assert bad.has(Flag.BAD_QUERY).tolist() == [True, False] and bad.proven.tolist() == [False, True]


def test_options():
    surface, points = wavy(), cloud(50)
    plain = surface.closest(points)
    hinted = surface.closest(points, hints=plain.uv)
    assert hinted.has(Flag.HINT_USED).all() and np.allclose(hinted.distance, plain.distance)
    part = surface.closest(points, domain=[0.1, 0.3, 0.2, 0.6])
    assert part.u.min() >= 0.1 and part.u.max() <= 0.3 and (part.distance >= plain.lower_bound).all()
    assert surface.closest(points, scope=footpoint.Scope.LOCAL).has(Flag.NOT_PROVEN).all()
    steps = []
    surface.closest(points[:2], trace=lambda *step: steps.append(step))
    assert {step[0] for step in steps} == {0, 1}
    inverted = surface.invert([surface.evaluate([0.3, 0.4]), [0, 0, 50]])
    assert inverted.on_shape.tolist() == [True, False] and np.allclose(inverted.uv[0], [0.3, 0.4])


def test_sets_and_paths():
    cyl = cylinder()
    seam = cyl.preimage([2, 0, 1])
    assert seam.complete and seam.uv[:, 0].tolist() == [0, 4] and seam.kinds == [Kind.POINT] * 2
    ends = circle().extrema([1, 0, 0])
    assert ends.natures == [Nature.MINIMUM, Nature.MAXIMUM] and np.allclose(ends.feet.distance, [1, 3])
    assert len(cyl.on_line([-9, 0.3, 1], [1, 0, 0])) == 2 and len(cyl.on_line([0, 0.3, 1], [1, 0, 0], [0, np.inf])) == 1
    assert np.allclose(cyl.project([[9, 0, 1]], [1, 0, 0]).distance, 7)
    t = np.linspace(0, 4 * np.pi, 90)
    turns = cyl.path(np.stack([3 * np.cos(t), 3 * np.sin(t), t / 9 + 1], 1))
    assert abs(turns[1][-1, 0] - 8) < 1e-9 and (turns[2] & footpoint.PathChange.SEAM_CROSSED).any()
    points = np.array([[3, 0, 1], [1, 0, 1.0]])
    normals, signed, flags = cyl.normals(cyl.closest(points), points)
    assert np.allclose(signed, [1, -1]) and np.allclose(normals, [[1, 0, 0]] * 2) and flags.shape == (2,)
    assert np.allclose(circle().tangents(circle().closest([3, 0, 0]))[0], [0, 1, 0])


def test_scene():
    moved = np.eye(4)
    moved[:3, 3] = [0, 0, 20]
    scene = footpoint.Scene([cylinder(), circle(), cylinder()], [None, None, moved])
    feet, members = scene.closest([[3, 0, 1], [3, 0, 21], [0, 0, 1e301]])
    assert members.tolist() == [0, 2, footpoint.NO_MEMBER] and np.allclose(feet.distance[:2], 1)
    assert np.allclose(scene.evaluate(2, feet.uv[1]), feet.point[1]) and scene.evaluate(1, 0.5).shape == (3,)
    hinted, again = scene.closest([[3, 0, 1]], hint_members=[0], hints=feet.uv[:1])
    assert again.tolist() == [0] and hinted.has(Flag.HINT_USED).all()
    normals, signed, _ = scene.normals(feet[:2], members[:2], [[3, 0, 1], [3, 0, 21]])
    assert np.allclose(signed, 1)
    copy = pickle.loads(pickle.dumps(scene))
    assert copy.closest(cloud(40))[0].tobytes() == scene.closest(cloud(40))[0].tobytes()
    assert isinstance(scene.shape(1), footpoint.Curve) and np.array_equal(scene.placement(2), moved[:3])


def test_functions():
    def saddle(u, v, order):
        return [[u, v, u * v], [1, 0, v], [0, 1, u], [0, 0, 0], [0, 0, 1], [0, 0, 0]]

    function = footpoint.Surface.from_function(saddle, [-1, 1, -1, 1], second_bounds=[0, 1, 0])
    spline = footpoint.Surface(1, 1, [-1, -1, 1, 1], [-1, -1, 1, 1], [[[-1, -1, 1], [-1, 1, -1]], [[1, -1, -1], [1, 1, 1]]])
    points = cloud(30, size=1)
    ours, theirs = function.closest(points), spline.closest(points)
    assert np.allclose(ours.distance, theirs.distance) and ours.proven.all()
    with pytest.raises(NotImplementedError, match="callback|function"):
        function.poles

    def broken(u, order):
        raise RuntimeError("no such point")

    with pytest.raises(ValueError) as caught:
        footpoint.Curve.from_function(broken, [0, 1])
    assert isinstance(caught.value.__cause__, RuntimeError)


@pytest.mark.parametrize("folder", sorted(path.name for path in (ROOT / "tests" / "data").glob("syn_*")))
def test_cases(folder):
    """The committed cases: nothing farther than the truth, no bound above it, as the C tests ask."""
    case = ROOT / "tests" / "data" / folder
    shape = load_shape(case / "geometry.txt")
    rows = np.genfromtxt(case / "queries.csv", delimiter=",", names=True, dtype=None, encoding="utf-8")
    points, truth = np.stack([rows["x"], rows["y"], rows["z"]], 1), rows["dist"]
    feet = shape.closest(points)
    size = np.linalg.norm(np.diff(shape.box, axis=0))
    grain = 4e-15 * (np.abs(points).max(1) + truth)
    assert (feet.distance <= truth + 1e-9 * size + grain).all() and (feet.lower_bound <= truth + 1e-12 * size + grain).all()


def test_pickle_and_threads():
    for shape in (hill(), wavy(), circle()):
        again = pickle.loads(pickle.dumps(shape))
        assert again.closest(cloud(30)).tobytes() == shape.closest(cloud(30)).tobytes()
    surface, points, answers = wavy(), cloud(2000), []
    workers = [threading.Thread(target=lambda: answers.append(surface.closest(points).tobytes())) for _ in range(4)]
    [worker.start() for worker in workers], [worker.join() for worker in workers]
    assert len(set(answers)) == 1
