"""The declarations are those of the header, and every function of the header is reached by ordinary use of the package."""

import ctypes
import re
from enum import Enum

import numpy as np
import pytest
from shapes import ROOT, circle, cloud, cylinder, hill

import footpoint
from footpoint import _feet, _library, intersect, trims, weights

HEADER = re.sub(r"/\*.*?\*/", "", (ROOT / "include" / "footpoint.h").read_text(encoding="utf-8"), flags=re.S)
SCALARS = {"size_t": ctypes.c_size_t, "double": ctypes.c_double, "uint32_t": ctypes.c_uint32, "int32_t": ctypes.c_int32,
           "uint64_t": ctypes.c_uint64, "fpt_status": ctypes.c_int32, "void": None}


def c_type(text):
    text = re.sub(r"\b(const|struct)\b", "", text)
    if "*" in text:
        return ctypes.c_void_p
    return SCALARS[text.strip()]


def test_prototypes():
    found = {}
    for result, name, arguments in re.findall(r"^(?:FPT_MUST_USE\s+)?([a-z][\w ]*?[ *]+)fpt_(\w+)\(([^;{]*?)\);", HEADER, re.M):
        listed = [a.strip() for a in arguments.split(",")]
        types = [] if listed == ["void"] else [c_type(re.sub(r"\w+$", "", a)) for a in listed]
        found[name] = (types, ctypes.c_char_p if result.split() == ["const", "char", "*"] else c_type(result))
    assert len(found) > 80
    assert set(found) == set(_library.PROTOTYPES)
    for name, (types, result) in found.items():
        function = _library.functions[name]
        assert (function.argtypes, function.restype) == (types, result), name


def test_structs():
    found = dict((name, body) for body, name in re.findall(r"typedef struct fpt_\w+ \{(.*?)\} (fpt_\w+);", HEADER, re.S))
    assert set(found) == set(_library.STRUCTS)
    for name, body in found.items():
        fields = []
        for line in (part.strip() for part in body.split(";") if part.strip()):
            pointer = re.match(r"[\w ]+\(\*(\w+)\)\(", line)
            if pointer:
                fields.append((pointer[1], "function"))
                continue
            match = re.match(r"(.*?)(\w+)(?:\[(\d+)\])?$", line, re.S)
            kind = _library.STRUCTS[match[1].split()[-1]] if "*" not in match[1] and "fpt_" in match[1] else c_type(match[1])
            fields.append((match[2], kind * int(match[3]) if match[3] else kind))
        ours = [(field, "function" if hasattr(kind, "_restype_") else kind) for field, kind in _library.STRUCTS[name]._fields_]
        assert ours == fields, name


@pytest.mark.parametrize("enum, prefix", [(footpoint.Flag, "FPT_FOOT_"), (footpoint.NormalFlag, "FPT_NORMAL_"),
                                          (footpoint.PathChange, "FPT_PATH_"), (footpoint.Method, "FPT_METHOD_"),
                                          (footpoint.Scope, "FPT_SCOPE_"), (footpoint.Kind, "FPT_MEMBER_"),
                                          (footpoint.Nature, "FPT_NATURE_"), (weights.State, "FPT_WISH_"),
                                          (weights.WeightFlag, "FPT_WEIGHT_"), (weights.ConstraintKind, "FPT_CONSTRAINT_"),
                                          (weights.Unit, "FPT_UNIT_"), (trims.ElementaryKind, "FPT_ELEMENTARY_"),
                                          (trims.PcurveKind, "FPT_PCURVE_"), (trims.CoedgeFlag, "FPT_COEDGE_"),
                                          (trims.Replacement, "FPT_REPLACEMENT_"), (trims.FindingKind, "FPT_FINDING_"),
                                          (intersect.HitNature, "FPT_HIT_"), (intersect.End, "FPT_END_"),
                                          (intersect.RayFlag, "FPT_RAY_"), (intersect.QuadricKind, "FPT_QUADRIC_"),
                                          (intersect.ConicKind, "FPT_CONIC_")])
def test_enums(enum: type[Enum], prefix):
    listed = {name: int(value) for name, value in re.findall(rf"^\s*{prefix}(\w+) = (\d+),", HEADER, re.M)}
    assert listed == {name: int(member) for name, member in enum.__members__.items()}


def test_records():
    for struct, dtype in ((_library.FootPoint, _feet.FOOT), (_library.FootMember, _feet.MEMBER), (_library.WeightsPole, weights.POLE),
                          (_library.WeightsOutcome, weights.OUTCOME), (_library.CurveHit, intersect.HIT), (_library.RayHit, intersect.RAY_HIT),
                          (_library.SectionPoint, intersect.SECTION_POINT), (_library.Conic, intersect.CONIC)):
        assert dtype.itemsize == ctypes.sizeof(struct)
        assert {name: dtype.fields[name][1] for name in dtype.names} == {name: getattr(struct, name).offset for name, _ in struct._fields_}
    assert _library.ABI_VERSION == int(re.search(r"#define FPT_ABI_VERSION (\d+)", HEADER)[1])


def reach_trims():
    turn = 2 * np.pi
    sphere = trims.Support.elementary("sphere", [0, turn, -turn / 4, turn / 4], first=2.0)
    half = trims.Relation.linear([0, 1], [0, 0.5])
    circle, steps = trims.Relation.circle(0, turn), trims.Relation.through([0, 0.5, 1], [1, 0.2, 0])
    function = trims.Relation.function(lambda x: x * x, np.sqrt, [1, 2])
    function.domain, trims.Relation.piecewise([half]).values_at_ends, circle.then(steps).inverse()([0.25])
    transform = trims.Transform(circle, steps)
    transform.then(transform.inverse())([0.1, 0.2]), transform.domain, transform.image, transform.keeps_direction
    form = trims.Support(sphere.spline([0, 2]))
    exact, found = sphere.spline_transform([0, 2]), sphere.match(form)
    sphere.match_many(form, [[1, 0.5]]), sphere.evaluate([1, 0.5]), sphere.domain, found([1, 0.5])
    hole = trims.Loop([trims.Coedge.arc([3, 0], [0.5, 0], [0, -0.5], 0, turn)], True)
    whole = trims.TrimmedSurface.whole(sphere)
    face = trims.TrimmedSurface(sphere, [*whole.loops, hole], whole.edges)
    face.support, face.is_flipped, face.evaluate(0, 0, [0.5]), face.report(), trims.picture([face])
    nurbs = face.to_nurbs([0, 2], 1e-4, trims.Replacement.SPLINE).face
    nurbs.loops, face.to_nurbs([0, 2], 1e-3).face.loops, nurbs.to_elementary(sphere, [0, 2], 1e-3)
    face.change(exact, form, 1e-3), face.follow(form, 1e-2)
    nurbs.reparametrise(trims.Transform(trims.Relation.linear([0, 1], [1, 0]), trims.Relation.linear([0, 1], [0, 1])))
    trims.TrimmedSurface.from_json(face.to_json())
    open_loop = trims.TrimmedSurface(sphere, [trims.Loop([trims.Coedge.polyline([[0, 0], [1, 0], [1, 1]])])])
    assert open_loop.report().findings[0].kind == trims.FindingKind.OPEN
    parts = [trims.Support.elementary(3, [*ends, -1, 1], first=2.0) for ends in ([0, 2], [2, 5], [0, 5])]
    left, right = (trims.TrimmedSurface.whole(part) for part in parts[:2])
    left.merge(right, "u", parts[2])


def test_every_function_is_reached(monkeypatch):
    reached = set()

    def counting(name, function):
        def call(*arguments):
            reached.add(name)
            return function(*arguments)
        return call

    for name, function in list(_library.functions.items()):
        monkeypatch.setitem(_library.functions, name, counting(name, function))
    points = cloud(5)
    curve, surface = circle(), cylinder()
    for shape in (curve, surface):
        for attribute in ("domain", "poles", "weights", "knots", "box", "memory", "is_rational", "is_closed"):
            getattr(shape, attribute)
        repr(shape.prepare())
        for query in (shape.closest, shape.invert):
            query(points), query(points.astype(np.float32))
        feet = shape.path(points)[0]
        shape.project(points, [1, 0, 0]), shape.uncertainty(feet)
        shape.preimage([2, 0, 0]), shape.extrema([0.3, 0.2, 0.1]), shape.on_line([-5, 0, 1], [1, 0, 0])
    assert len(footpoint.Surface.from_function(lambda u, v, order: [u, v, 0], [0, 1, 0, 1]).preimage([0.5, 0.5, 0]).undecided)
    footpoint.Curve.from_function(lambda u, order: [u, 0, 0], [0, 1])
    curve.evaluate(1.0), curve.evaluate([1.0]), curve.evaluate(1.0, 1, side=-1), curve.tangents(curve.closest(points)), curve.unwrap(3.9, 0.1)
    surface.evaluate([1, 0.5]), surface.evaluate([[1, 0.5]]), surface.evaluate([1, 0.5], 1, sides=(-1, 1))
    surface.collapsed_edges, surface.normals(surface.closest(points), points), surface.unwrap([3.9, 0], [0.1, 0])
    scene = footpoint.Scene([curve, surface], [None, np.eye(4)])
    len(scene), scene.shape(0), scene.placement(1), scene.box, scene.memory, scene.prepare(), scene.evaluate(1, [1, 0.5], 1)
    for query in (scene.closest, scene.invert):
        feet, members = query(points)
        query(points.astype(np.float32))
    scene.normals(feet, members, points)
    arch = footpoint.Curve.from_poles(2, [[0, 0], [1, 2], [2, 0]])
    weights.general(arch, [0.5] * 3), weights.interpolated(arch, 1, 1), weights.network(arch, {}, 0.5, 1)
    weights.refine(arch, {1: 1.0}, [weights.Constraint.through([1, 1, 0])]), weights.refine(hill(), {})
    weights.move_point(arch, 0.5, 1, 0.1), weights.through_point(arch, 1, [1, 1.5, 0]), weights.conic(arch.poles, [1, 1, 1])
    weights.of_rho(0.5), weights.of_eccentricity(arch.poles, 1), weights.normalise([1, 2]), weights.bound([1, 2], 1.5)
    weights.standard_form(arch), weights.positive_form(1, [0, 0, 1, 1], [[0, 0, 0, 1], [1, 0, 0, 1]])
    reach_trims()
    line, plane = footpoint.Curve.from_poles(1, [[-5, 0, 1], [5, 0, 1]]), intersect.Quadric.plane([0, 0, 1], [0, 0, 1])
    intersect.curves(curve, curve, budget=50), intersect.surface_curve(surface, line), intersect.curve_quadric(line, plane)
    intersect.sections(surface, [plane, intersect.Quadric.plane(surface.evaluate([1, 0.5]), [1, 0, 0])])
    intersect.sections(hill(), [intersect.Quadric.plane([0, 0, 0], [0, 0, 1])] * 2)
    intersect.sections(footpoint.Surface.from_poles(1, 1, [[[0, 0, 0], [0, 2, 0]], [[2, 0, 0], [2, 2, 0]]]),
                       [intersect.Quadric.plane([0, 0, 0], [0, 0, 1]), intersect.Quadric.sphere([1, 1, 1], 1)])
    intersect.conics(plane, intersect.Quadric.sphere([0, 0, 0], 2), 1e-9)
    caster = intersect.Caster(surface)
    caster.first(points, [1, 0, 0]), caster.all(points, [1, 0, 0])
    del caster
    footpoint.version(), footpoint.abi_version()
    with pytest.raises(RuntimeError, match="FPT_INTERNAL"):
        raise _library.failure(_library.INTERNAL)
    del curve, surface, shape, scene, query
    assert set(_library.PROTOTYPES) - reached == set()
