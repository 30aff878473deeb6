"""Weights from wishes: values worked out by hand, bits, constraints, surfaces, edits, forms, misuse."""

import pickle
import signal
import threading
import time

import numpy as np
import pytest
from shapes import circle, hill

import footpoint
from footpoint import Curve, Surface, weights
from footpoint.weights import Constraint, State, Unit, WeightFlag

HALF = 0.5**0.5


def arch():
    """Poles 4, 6 and 5 above a chord of length 12."""
    return Curve.from_poles(4, [[0, 0], [3, 4], [6, 6], [9, 5], [12, 0]])


def corner():
    return Curve.from_poles(2, [[1, 0], [1, 1], [0, 1]])


def tent():
    return Surface.from_poles(2, 2, [[[0, 0, 0], [0, 1, 0], [0, 2, 0]], [[1, 0, 1], [1, 1, 3], [1, 2, 1]], [[2, 0, 0], [2, 1, 1], [2, 2, 0]]])


def test_formulas_give_tables_made_by_hand():
    found = weights.general(arch(), [0.9, 0.25, 0.5, 0.8, 0.1])
    assert np.allclose(found.weights, [1, 3, 1, 0.25, 1], rtol=0, atol=1e-14)  # 1/lambda - 1, ends on the chord
    assert np.allclose(found.poles["chord_distance"], [0, 4, 6, 5, 0], rtol=0, atol=1e-14)
    assert np.allclose(found.poles["wish"][1:4], [1, 3, 4], rtol=0, atol=1e-14) and np.isnan(found.poles["wish"][[0, 4]]).all()
    assert (found.poles["flags"][[0, 4]] & WeightFlag.ON_CHORD).all() and found.states[0] is State.NONE
    assert np.allclose(weights.interpolated(arch(), 1, 3).weights, [1, 5 / 3, 2, 1, 1], rtol=0, atol=1e-14)
    limited = weights.interpolated(arch(), 5, 5, weight_min=0.2, weight_max=30)
    assert limited.weights[1] == 0.2 and limited.poles["flags"][1] & WeightFlag.LIMITED and found.iterations == 0


def test_network_has_the_same_bits():
    one, two = (weights.network(arch(), {2: 1.5}, 1, 2, seed=42) for _ in range(2))
    assert one.weights.tobytes() == two.weights.tobytes() and one.poles.tobytes() == two.poles.tobytes()
    assert abs(one.weights[2] - 3) < 1e-12 and 1 <= one.weights[1] <= 3 and 1.5 <= one.weights[3] <= 4 and 0 < one.iterations < 100
    assert weights.network(arch(), {}, 1, 2, seed=1).weights.tobytes() != weights.network(arch(), {}, 1, 2, seed=2).weights.tobytes()


def test_quarter_circle():
    found = weights.refine(corner(), {1: np.sqrt(2) - 1})
    assert abs(found.weights[1] - HALF) < 1e-12 and abs(found.poles["distance"][1] - (np.sqrt(2) - 1)) < 1e-14
    assert found.is_met and (found.met, found.not_met, found.impossible, found.starts) == (1, 0, 0, 1)
    assert found.states.tolist() == [State.NONE, State.MET, State.NONE] and abs(found.poles["u"][1] - 0.5) < 1e-7
    assert (found.poles["lower_bound"] <= found.poles["distance"]).all() and found.weights.tobytes() == found.shape.weights.tobytes()
    at = found.shape.evaluate(np.linspace(0, 1, 50))
    assert abs(np.hypot(at[:, 0], at[:, 1]) - 1).max() < 1e-12
    assert "1 wishes met" in repr(found)
    again = pickle.loads(pickle.dumps(found))
    assert again.poles.tobytes() == found.poles.tobytes() and again.shape.weights.tobytes() == found.weights.tobytes()


def test_wishes_of_known_curves_are_met_as_our_own_engine_measures():
    rng = np.random.default_rng(5)
    for _ in range(50):
        count = int(rng.integers(4, 11))
        poles = np.stack([np.arange(count) + rng.uniform(-0.3, 0.3, count), rng.normal(size=count), rng.normal(size=count)], 1)
        known = Curve.from_poles(3, poles, np.exp(rng.uniform(-1, 1, count)))
        wished = range(1, count - 1, 2)
        wishes = dict(zip(wished, known.closest(poles[list(wished)]).distance))
        found = weights.refine(Curve.from_poles(3, poles), wishes)
        measured = found.shape.closest(poles[list(wished)])
        assert found.is_met and abs(measured.distance - list(wishes.values())).max() < 1e-9 * np.linalg.norm(np.ptp(poles, axis=0))
        assert found.poles.tobytes() == weights.refine(Curve.from_poles(3, poles), wishes).poles.tobytes()


def test_constraints_and_impossible_wishes():
    found = weights.refine(arch(), {}, [Constraint.point_at(0.5, [6.1, 4.6, 0]), Constraint.tangent_kept(0.5)])
    assert found.is_met and abs(found.shape.evaluate(0.5) - [6.1, 4.6, 0]).max() < 1e-8
    before, after = (curve.evaluate(0.5, 1)[1] for curve in (arch(), found.shape))
    assert np.linalg.norm(np.cross(before, after)) < 1e-8 * np.linalg.norm(before) * np.linalg.norm(after)
    assert found.constraints["met"].tolist() == [1, 1] and found.constraints["u"][0] == 0.5
    turned = weights.refine(arch(), {}, [Constraint.through([6, 5, 0]), Constraint.tangent_at(0.5, [7, 1, 0])])
    tangent = turned.shape.evaluate(0.5, 1)[1]
    assert turned.is_met and turned.shape.closest([6, 5, 0]).distance < 1e-8 and abs(tangent[1] / tangent[0] - 1 / 7) < 1e-8
    leaning = weights.refine(arch(), {2: 1.5}, symmetric=True)
    assert leaning.is_met and leaning.weights[1] == pytest.approx(leaning.weights[3], rel=1e-12)
    far = weights.refine(arch(), {1: 5.1})
    assert not far.is_met and far.impossible == 1 and far.states[1] is State.IMPOSSIBLE
    narrow = weights.refine(arch(), {1: 0.5, 2: 2.5}, weight_min=0.5, weight_max=2, ratio_limit=1.5, starts=20)
    assert narrow.weights.max() <= 1.5 * narrow.weights.min() * (1 + 1e-12) and narrow.met + narrow.not_met + narrow.impossible == 2


def test_surface():
    found = weights.refine(tent(), {(1, 1): 1.0}, symmetric=True)
    assert found.weights.shape == found.poles.shape == found.states.shape == (3, 3) and found.states[1, 1] is State.MET
    assert isinstance(found.shape, Surface) and abs(found.shape.closest(tent().poles[1, 1]).distance - 1) < 1e-9
    assert np.array_equal(found.weights, found.shape.weights)
    uv = [0.4, 0.6]
    point = tent().evaluate(uv) + [0, 0, 0.05]
    through = weights.refine(tent(), {}, [Constraint.through(point)])
    assert through.is_met and through.shape.closest(point).distance < 1e-8


def test_single_weights():
    curve = arch()
    start, pole = curve.evaluate(0.5), curve.poles[2]
    moved = Curve(4, curve.knots, curve.poles, [1, 1, weights.move_point(curve, 0.5, 2, 0.25), 1, 1]).evaluate(0.5)
    assert abs(moved - (start + 0.25 * (pole - start) / np.linalg.norm(pole - start))).max() < 1e-13
    weight, foot = weights.through_point(curve, 2, [6, 5, 0])
    assert weight > 1 and foot.distance < 1e-9 and bool(foot.proven) and isinstance(foot, footpoint.Feet)
    assert Curve(4, curve.knots, curve.poles, [1, 1, weight, 1, 1]).closest([6, 5, 0]).distance < 1e-9
    with pytest.raises(ValueError, match="weight"):
        weights.through_point(curve, 2, [6, 7, 0])


def test_conics_and_weights_as_a_whole():
    legs = corner().poles
    found = weights.conic(legs, [2, 2 * HALF, 2])
    assert abs(found.weight - HALF) < 1e-15 and abs(found.rho - HALF / (1 + HALF)) < 1e-15 and found.eccentricity < 1e-7
    assert weights.conic(legs[:, :2], [1, 1, 1]).eccentricity == pytest.approx(1, abs=1e-12)
    assert weights.of_rho(0.75) == 3.0 and np.allclose(weights.of_eccentricity(legs, 0), HALF, rtol=0, atol=1e-12)
    assert np.allclose(weights.of_eccentricity(legs, 1.0)[-1], 1, rtol=0, atol=1e-12)
    assert weights.of_eccentricity([[0, 0], [1, 1], [5, 0]], 0).shape == (0,)
    grid = np.array([[2.0, 4], [8, 1]])
    assert weights.normalise(grid).tolist() == [[1, 2], [4, 0.5]] and weights.normalise(grid, Unit.GREATEST).max() == 1
    assert weights.normalise([1, 4], Unit.MIDDLE).tolist() == [0.5, 2]
    near = weights.bound([1, 100, 10], 4)
    assert near.max() <= 4 * near.min() * (1 + 1e-15) and near[2] == 10


def test_forms():
    curve = Curve(2, [0, 0, 0, 0.4, 1, 1, 1], [[0, 0], [1, 2], [3, 2], [4, 0]], [2, 3, 5, 7])
    same = weights.standard_form(curve)
    assert abs(same.weights[[0, -1]] - 1).max() < 1e-14 and np.array_equal(same.poles, curve.poles)
    assert same.closest(curve.evaluate(np.linspace(0, 1, 40))).distance.max() < 1e-13
    with pytest.raises(NotImplementedError, match="clamped"):
        weights.standard_form(Curve(2, [0, 1, 2, 3, 4, 5, 6], curve.poles, [2, 3, 5, 7]))
    raw = np.array([[1, 0, 0, 1], [-0.1, 1, 0, -0.2], [0, 1, 0, 1]])
    positive = weights.positive_form(2, [0, 0, 0, 1, 1, 1], raw)
    assert (positive.weights > 0).all()
    for u in np.linspace(0, 1, 20):
        row = np.array([(1 - u) ** 2, 2 * u * (1 - u), u * u]) @ raw
        assert abs(positive.evaluate(u) - row[:3] / row[3]).max() < 1e-12
    with pytest.raises(NotImplementedError, match="denominator.* u = 0.5"):
        weights.positive_form(2, [0, 0, 0, 1, 1, 1], [[1, 0, 0, 1], [0, 1, 0, -2], [0, 1, 0, 1]])


def test_stopping():
    hard = {1: 1.5, 2: 4.0, 3: 1.5}  # neither met nor proven impossible
    assert weights.refine(arch(), hard, starts=50).not_met == 3
    with pytest.raises(footpoint.Cancelled):
        weights.refine(arch(), hard, should_stop=lambda: True)
    with pytest.raises(ZeroDivisionError):
        weights.refine(arch(), hard, should_stop=lambda: 1 / 0)
    threading.Timer(0.3, lambda: signal.raise_signal(signal.SIGINT)).start()
    start = time.perf_counter()
    with pytest.raises(KeyboardInterrupt):
        weights.refine(arch(), hard, starts=10_000_000)
    assert time.perf_counter() - start < 10


FUNCTION = Curve.from_function(lambda u, order: [u, 0, 0], [0, 1])


@pytest.mark.parametrize("error, text, call", [
    (TypeError, "curve: a Curve is needed, not Surface", lambda: weights.general(hill(), [0.5])),
    (TypeError, "shape", lambda: weights.refine(3, {})),
    (ValueError, "lambdas: lambda 2 = 1", lambda: weights.general(arch(), [0.5, 0.5, 1.0, 0.5, 0.5])),
    (ValueError, "lambdas: 1 given, 5", lambda: weights.general(arch(), [0.5])),
    (ValueError, "first_distance", lambda: weights.interpolated(arch(), -1, 2)),
    (TypeError, "last_distance", lambda: weights.interpolated(arch(), 1, "x")),
    (TypeError, "wishes: a mapping", lambda: weights.refine(arch(), [1, 2])),
    (ValueError, "wish_poles: wish 0 names pole 9", lambda: weights.refine(arch(), {9: 1.0})),
    (ValueError, "wish_distances: wish 1: -1", lambda: weights.refine(arch(), {1: 1.0, 2: -1.0})),
    (ValueError, "wish_distances: wish 0", lambda: weights.refine(arch(), {1: np.nan})),
    (ValueError, "pole -1", lambda: weights.refine(arch(), {-1: 1.0})),
    (TypeError, "pole 1.5", lambda: weights.refine(arch(), {1.5: 1.0})),
    (TypeError, "pole 1", lambda: weights.refine(arch(), {1: None})),
    (TypeError, r"a pair \(i, j\)", lambda: weights.refine(tent(), {4: 1.0})),
    (ValueError, r"pole \(0, 3\)", lambda: weights.refine(tent(), {(0, 3): 1.0})),
    (ValueError, "max_distance", lambda: weights.network(arch(), {}, 2, 1)),
    (TypeError, "constraint 1 is a int", lambda: weights.refine(arch(), {}, [Constraint.tangent_kept(0.5), 3])),
    (TypeError, "constraints", lambda: weights.refine(arch(), {}, 3)),
    (ValueError, "constraint 0", lambda: weights.refine(tent(), {}, [Constraint.point_at(0.5, [1, 1, 1])])),
    (ValueError, "constraint", lambda: weights.refine(arch(), {}, [Constraint.point_at(1.5, [1, 1, 1])])),
    (ValueError, "constraint", lambda: weights.refine(arch(), {}, [Constraint(77, 0.5, [1, 1, 1])])),
    (NotImplementedError, "constraint", lambda: weights.refine(tent(), {}, [Constraint(3, [0.5, 0.5])])),
    (ValueError, "weight_min", lambda: weights.refine(arch(), {}, weight_min=-1)),
    (ValueError, "seed", lambda: weights.network(arch(), {}, 1, 2, seed=2**64)),
    (TypeError, "'budget' is not an option", lambda: weights.refine(arch(), {}, budget=1)),
    (ValueError, "pole", lambda: weights.move_point(arch(), 0.5, 5, 0.1)),
    (ValueError, "distance", lambda: weights.move_point(arch(), 0.5, 2, 100)),
    (ValueError, "poles: there are 2", lambda: weights.conic([[0, 0], [1, 1]], [1, 1, 1])),
    (ValueError, "weights", lambda: weights.conic(corner().poles, [1, 0, 1])),
    (ValueError, "rho", lambda: weights.of_rho(1)),
    (ValueError, "weights: .*1", lambda: weights.normalise([1, 0])),
    (ValueError, "weights", lambda: weights.normalise([])),
    (ValueError, "unit", lambda: weights.normalise([1, 2], 7)),
    (ValueError, "ratio", lambda: weights.bound([1, 2], 0.5)),
    (ValueError, "knots: 3 numbers", lambda: weights.positive_form(1, [0, 0, 1], [[0, 0, 0, 1], [1, 0, 0, 1]])),
    (ValueError, r"poles: the shape is \(2, 3\)", lambda: weights.positive_form(1, [0, 0, 1, 1], [[0, 0, 0], [1, 0, 0]])),
    (NotImplementedError, "curve: is given by a function", lambda: weights.refine(FUNCTION, {0: 1.0})),
    (NotImplementedError, "curve: is given by a function", lambda: weights.interpolated(FUNCTION, 1, 1)),
    (NotImplementedError, "curve: is given by a function", lambda: weights.standard_form(FUNCTION)),
])
def test_errors(error, text, call):
    with pytest.raises(error, match=text) as told:
        call()
    assert str(told.value)


def test_closed_curve():
    ring = circle()
    wish = 1.2 * np.sqrt(2) - 1
    found = weights.refine(ring, {1: wish})
    assert found.states[1] is State.MET and abs(found.shape.closest(ring.poles[1]).distance - wish) < 1e-9
