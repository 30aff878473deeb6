"""Wrong use raises ordinary exceptions that name the parameter, and never crashes."""

import random

import numpy as np
import pytest
from shapes import circle, cloud, cylinder, hill

import footpoint

KNOTS = [0, 0, 0, 1, 1, 1]
POLES = [[0, 0, 0], [1, 2, 0], [2, 0, 0]]


@pytest.mark.parametrize("error, text, call", [
    (ValueError, "poles: pole 1 is not finite", lambda: footpoint.Curve(2, KNOTS, [[0, 0, 0], [1, np.nan, 0], [2, 0, 0]])),
    (ValueError, "knots", lambda: footpoint.Curve(2, [0, 0, 0, 1, 1, 0.5], POLES)),
    (ValueError, "knots: 4 numbers", lambda: footpoint.Curve(2, [0, 0, 1, 1], POLES)),
    (ValueError, "weight", lambda: footpoint.Curve(2, KNOTS, POLES, [1, -1, 1])),
    (ValueError, "degree", lambda: footpoint.Curve(0, [0, 1, 2, 3], POLES)),
    (TypeError, "degree", lambda: footpoint.Curve(2.5, KNOTS, POLES)),
    (TypeError, "poles", lambda: footpoint.Curve(2, KNOTS, [["a", "b", "c"]] * 3)),
    (ValueError, "poles", lambda: footpoint.Curve(2, KNOTS, [1, 2, 3])),
    (ValueError, r"points: the shape is \(2,\)", lambda: hill().closest([1, 2])),
    (TypeError, "points", lambda: hill().closest([[1, 2, 3j]])),
    (TypeError, "points", lambda: hill().closest(None)),
    (ValueError, "tolerance", lambda: hill().closest([1, 2, 3], tolerance=-1)),
    (TypeError, "tolerance", lambda: hill().closest([1, 2, 3], tolerance="x")),
    (TypeError, "'tolerence' is not an option", lambda: hill().closest([1, 2, 3], tolerence=1)),
    (ValueError, "hints", lambda: hill().closest(cloud(3), hints=[[0, 0]])),
    (ValueError, "hints", lambda: hill().closest([1, 2, 3], hints=[np.inf, 0])),
    (ValueError, "method", lambda: hill().closest([1, 2, 3], method=77)),
    (ValueError, "threads", lambda: hill().closest([1, 2, 3], threads=-1)),
    (ValueError, "threads", lambda: hill().closest([1, 2, 3], threads=2**32)),
    (ValueError, "domain", lambda: hill().closest([1, 2, 3], domain=[0.5, 0.2, 0, 1])),
    (ValueError, "u", lambda: circle().evaluate(17.0)),
    (ValueError, "derivatives", lambda: circle().evaluate(1.0, derivatives=2**32)),
    (ValueError, "point", lambda: hill().preimage([np.nan, 0, 0])),
    (ValueError, "direction", lambda: hill().on_line([0, 0, 0], [0, 0, 0])),
    (TypeError, "feet", lambda: hill().normals(np.zeros(3))),
    (ValueError, "points", lambda: hill().normals(hill().closest(cloud(3)), cloud(2))),
    (TypeError, "should_stop", lambda: hill().closest([1, 2, 3], should_stop=3)),
    (ValueError, "member", lambda: footpoint.Scene([])),
    (TypeError, "member 1", lambda: footpoint.Scene([hill(), 3])),
    (ValueError, "member 0: placement", lambda: footpoint.Scene([hill()], [np.diag([2.0, 1, 1, 1])])),
    (ValueError, "member", lambda: footpoint.Scene([hill()]).placement(4)),
    (ValueError, "hint_members", lambda: footpoint.Scene([hill()]).closest([1, 2, 3], hint_members=[-1])),
    (NotImplementedError, "domain", lambda: footpoint.Scene([hill()]).closest([1, 2, 3], domain=[0, 0.5, 0, 0.5])),
    (NotImplementedError, "callback|function", lambda: footpoint.Scene([footpoint.Curve.from_function(lambda u, k: [u, 0, 0], [0, 1])])),
    (ValueError, "never made", lambda: footpoint.Curve.__new__(footpoint.Curve).domain),
])
def test_errors(error, text, call):
    with pytest.raises(error, match=text):
        call()


def odd(rng):
    """A value that an argument may wrongly be."""
    choices = [None, 0, 1, -1, 2**31, 2**32, 2**64, 2**70, 0.5, -0.0, float("nan"), float("inf"), -1e300, True, "text", b"bytes", [], [1], [1, 2, 3],
               [[1, 2, 3]], [[1, 2], [3]], {}, object(), 1j, np.zeros(0), np.zeros((0, 3)), np.zeros((2, 3)), np.full((3, 3), np.nan),
               np.ones((4, 2)), np.ones((2, 2, 3)), np.arange(6), np.zeros((2, 3), np.float32), np.zeros((2, 3), "U3"), np.zeros((2, 3), object),
               np.array(5.0), np.broadcast_to(np.ones(3), (4, 3)), np.ones((3, 4))[:, ::-1], hill, footpoint.Feet(2), footpoint.Feet((2, 2)),
               footpoint.Feet(0), lambda *_: 1, lambda *_: [1, 2, 3], [np.inf, 1, 2], np.int8(-3), slice(1)]
    return rng.choice(choices)


def answers(function, arguments, named):
    """Whether a call answered; else it raised an ordinary exception with a text."""
    try:
        function(*arguments, **named)
        return True
    except (TypeError, ValueError, NotImplementedError, footpoint.Cancelled, AttributeError, OverflowError, IndexError) as error:
        assert str(error)
        return False


def test_ten_thousand_random_misuses():
    rng = random.Random(11)
    surface, curve = cylinder(), circle()
    scene = footpoint.Scene([surface, curve])
    calls = [(owner, name) for owner in (surface, curve, scene) for name in dir(owner)
             if not name.startswith("_") and callable(getattr(owner, name))]
    calls += [(footpoint, name) for name in ("Curve", "Surface", "Scene", "from_geomdl", "from_splinepy", "from_freecad", "from_occ")]
    options = ["tolerance", "accuracy", "method", "scope", "hints", "domain", "threads", "budget", "should_stop", "trace", "radius", "nearest",
               "minima_only", "hint_members", "side", "sides", "derivatives", "reach", "nonsense"]
    answered = 0
    for _ in range(10_000):
        owner, name = rng.choice(calls)
        right = [np.ones((5, 3)), [1, 2, 3], 0.5, [0.5, 0.5], 1, surface.closest(np.ones((5, 3)))]
        arguments = [rng.choice(right) if rng.random() < 0.5 else odd(rng) for _ in range(rng.choice([0, 1, 1, 2, 3, 4]))]
        named = {rng.choice(options): odd(rng) for _ in range(rng.choice([0, 0, 0, 1]))}
        answered += answers(getattr(owner, name), arguments, named)
    assert 300 < answered < 5000
    assert surface.closest([3, 0, 1]).distance == pytest.approx(1)


def test_ten_thousand_random_misuses_of_weights():
    """Right calls with up to two arguments replaced, and an option."""
    rng = random.Random(12)
    weights, arch = footpoint.weights, footpoint.Curve(2, KNOTS, POLES)
    through = [weights.Constraint.through([1, 1.2, 0])]
    calls = {"general": (arch, [0.5] * 3), "interpolated": (arch, 1, 1), "network": (arch, {1: 0.7}, 0.5, 1), "refine": (arch, {1: 1.0}, through),
             "move_point": (arch, 0.5, 1, 0.1), "through_point": (arch, 1, [1, 1.5, 0]), "conic": (POLES, [1, 1, 1]), "of_rho": (0.5,),
             "of_eccentricity": (POLES, 1), "normalise": ([1, 2],), "bound": ([1, 2], 1.5), "standard_form": (arch,),
             "positive_form": (1, [0, 0, 1, 1], [[0, 0, 0, 1], [1, 0, 0, 1]])}
    assert set(calls) == {name for name in weights.__all__ if name[0].islower()}
    options = ["weight_min", "weight_max", "ratio_limit", "tolerance", "symmetric", "steps", "starts", "seed", "should_stop", "constraints", "nonsense"]
    answered = 0
    for _ in range(10_000):
        name = rng.choice(list(calls))
        arguments = list(calls[name])
        for _ in range(rng.choice([0, 1, 1, 2])):
            value = odd(rng)
            wishes = isinstance(arguments[(place := rng.randrange(len(arguments)))], dict) and rng.random() < 0.7
            arguments[place] = {rng.choice([0, 1, 2, "x", (0, 1), -1]): value} if wishes else value
        named = {rng.choice(options): odd(rng)} if rng.random() < 0.2 else {}
        answered += answers(getattr(weights, name), arguments, named)
    assert 1000 < answered < 7000
    assert weights.refine(arch, {1: 1.0}, through).is_met is False and weights.refine(arch, {1: 1.0}).is_met
