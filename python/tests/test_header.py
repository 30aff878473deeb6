"""The declarations are those of the header, and every function of the header is reached by ordinary use of the package."""

import ctypes
import re
from enum import Enum

import numpy as np
import pytest
from shapes import ROOT, circle, cloud, cylinder, hill

import footpoint
from footpoint import _face, _feet, _library, construct, fair, inspect, intersect, operate, pcurve, trims, weights

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
                                          (weights.WeightFlag, "FPT_WEIGHT_"),
                                          (weights.ConstraintKind, "FPT_CONSTRAINT_"), (weights.Unit, "FPT_UNIT_"),
                                          (construct.Spacing, "FPT_SPACING_"), (construct.Condition, "FPT_FIT_"),
                                          (construct.ArcForm, "FPT_ARC_"), (construct.QuadricKind, "FPT_PATCH_"),
                                          (trims.ElementaryKind, "FPT_ELEMENTARY_"), (trims.PcurveKind, "FPT_PCURVE_"),
                                          (trims.CoedgeFlag, "FPT_COEDGE_"), (trims.Replacement, "FPT_REPLACEMENT_"),
                                          (trims.FindingKind, "FPT_FINDING_"), (pcurve.PcurveFlag, "FPT_DEVIATION_"),
                                          (footpoint.Standing, "FPT_FACE_"), (footpoint.StandingFlag, "FPT_STANDING_"), (footpoint.BranchEnd, "FPT_BRANCH_END_"),
                                          (footpoint.ContactKind, "FPT_CONTACT_"), (footpoint.Corrector, "FPT_CORRECTOR_"),
                                          (footpoint.IntersectMethod, "FPT_INTERSECT_"), (fair.Method, "FPT_FAIR_"),
                                          (inspect.Quantity, "FPT_QUANTITY_"), (inspect.Pattern, "FPT_PATTERN_"),
                                          (inspect.Kind, "FPT_PLACE_"), (operate.Direction, "FPT_DIRECTION_"),
                                          (intersect.HitNature, "FPT_HIT_"), (intersect.End, "FPT_SECTION_END_"),
                                          (intersect.RayFlag, "FPT_RAY_"), (intersect.QuadricKind, "FPT_QUADRIC_"),
                                          (intersect.ConicKind, "FPT_CONIC_")])
def test_enums(enum: type[Enum], prefix):
    listed = {name: int(value) for name, value in re.findall(rf"^\s*{prefix}(\w+) = (\d+),", HEADER, re.M)}
    assert listed == {name: int(member) for name, member in enum.__members__.items()}


def test_records():
    for struct, dtype in ((_library.FootPoint, _feet.FOOT), (_library.FootMember, _feet.MEMBER),
                          (_library.WeightsPole, weights.POLE), (_library.WeightsOutcome, weights.OUTCOME),
                          (_library.FacePlace, _face.PLACE), (_library.InspectTooth, inspect.TOOTH),
                          (_library.InspectCurvatures, inspect.CURVATURES), (_library.InspectPlace, inspect.PLACE),
                          (_library.CurveHit, intersect.HIT), (_library.RayHit, intersect.RAY_HIT),
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
    trims.arc_by_angle([0, 0, 0], [1, 0, 0], [0, 1, 0], 0, 1)
    nurbs = face.to_nurbs([0, 2], 1e-4, trims.Replacement.SPLINE).face
    nurbs.loops, face.to_nurbs([0, 2], 1e-3).face.loops, nurbs.to_elementary(sphere, [0, 2], 1e-3)
    face.change(exact, form, 1e-3), face.follow(form, 1e-2)
    nurbs.reparametrise(trims.Transform(trims.Relation.linear([0, 1], [1, 0]), trims.Relation.linear([0, 1], [0, 1])))
    trims.TrimmedSurface.from_json(face.to_json()), trims.arc_by_angle([0, 0, 0], [1, 0, 0], [0, 1, 0], 0, 1)
    open_loop = trims.TrimmedSurface(sphere, [trims.Loop([trims.Coedge.polyline([[0, 0], [1, 0], [1, 1]])])])
    assert open_loop.report().findings[0].kind == trims.FindingKind.OPEN
    parts = [trims.Support.elementary(3, [*ends, -1, 1], first=2.0) for ends in ([0, 2], [2, 5], [0, 5])]
    left, right = (trims.TrimmedSurface.whole(part) for part in parts[:2])
    left.merge(right, "u", parts[2])


def reach_operate(curve, surface):
    matrix, middle = np.eye(4), {curve: 0.5, surface: 0.5}
    for shape, where in ((curve, ()), (surface, ("v",))):
        finer = operate.refine(shape, [0.25], *where)
        operate.remove_knot(finer, 0.25, 1, *where), operate.simplify(shape, 1e-9), operate.clamp(shape), operate.unclamp(shape, *where)
        operate.elevate(shape, 1, *where), operate.reduce(operate.elevate(shape, 1, *where), *where), operate.reverse(shape, *where)
        ends = np.ravel(shape.domain)
        operate.with_domain(shape, ends), operate.part(shape, ends), operate.reparametrise(shape, 2, *where)
        operate.affine(shape, matrix[:3]), operate.projective(shape, matrix), operate.derivative(shape, *where)
        halves = operate.split(shape, middle[shape], *where)
        whole, error = operate.join(halves, 1e-9, *where)
        assert operate.difference(shape, whole).bound < 1e-12 and error < 1e-12
        assert operate.difference(shape, operate.bezier_form(shape)).bound < 1e-12
        operate.make_compatible([shape, finer])
    operate.periodic(curve, 1e-9), operate.periodic(surface, 1e-9, "u"), operate.swap(surface), operate.isocurve(surface, 0.5, "v")
    operate.frame(curve, 0.5), operate.continuity(curve), operate.from_power(operate.power(curve)[0], [0, 1])
    operate.continuity(surface, direction="u"), operate.from_power(operate.power(surface)[0, 0], [0, 1, 0, 1])
    length = operate.ArcLength(curve)
    length.total, length.at([0.5]), length.parameters([0.5])


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
    reach_operate(curve, surface)
    reach_constructions()
    line = footpoint.Curve.from_poles(1, [[0, 0], [1, 1]])
    (pulled, _), = pcurve.pull(hill(), pcurve.lift(hill(), line)[0])
    pcurve.deviation(hill(), pulled, pcurve.lift(hill(), line)[0])
    outline = footpoint.Curve(1, [0, 0, 1, 2, 3, 3], [[0, 0], [1, 0], [0, 1], [0, 0]])
    face = footpoint.Face(hill(), [[outline]])
    footpoint.Face.of_trim(trims.TrimmedSurface.whole(trims.Support(hill())))
    face.classify([0.2, 0.3]), face.closest(points), face.preimage(hill().evaluate([0.2, 0.3]))
    fair.curve(arch, 0.1), fair.surface(hill(), 0.1), inspect.curvature_range(arch), inspect.curvature_range(hill(), budget=10)
    inspect.curvature_range_places(hill(), budget=10)
    inspect.comb(arch), inspect.curvatures(hill(), [[0.5, 0.5]]), inspect.monotone_pieces(arch), inspect.inflections(arch)
    inspect.umbilics(hill(), budget=10), inspect.hausdorff(arch, curve), inspect.border(hill(), 0, hill(), 0)
    inspect.picture(hill(), size=(8, 8))
    flat = footpoint.Surface.from_poles(1, 1, [[[-9, -9, 0.5], [-9, 9, 0.5]], [[9, -9, 0.5], [9, 9, 0.5]]])
    met = footpoint.intersect_surfaces(surface, flat)
    assert len(met.branches) == 1 and met.is_proven and len(met.curves(0, 1e-4)) >= 1
    assert len(footpoint.intersect_surfaces(flat, flat).overlaps)
    ball = footpoint.Surface.from_poles(2, 2, [[[i - 1, j - 1, 0.5 - (i - 1) ** 2 - (j - 1) ** 2 + (i % 2 + j % 2)] for j in range(3)] for i in range(3)])
    assert repr(footpoint.intersect_surfaces(ball, flat))
    with pytest.raises(Exception):
        met._contact(99)
    whole = [trims.TrimmedSurface.whole(trims.Support(shape)) for shape in (ball, flat)]
    cut = footpoint.intersect_trims(*whole)
    assert len(cut.split(0, 1e-6)) >= 1 and len(cut.branches) == len(footpoint.intersect_surfaces(ball, flat).branches)
    with pytest.raises(TypeError):
        cut.curves(0, 1e-4)
    with pytest.raises(TypeError):
        met.split(0, 1e-6)
    assert len(footpoint.intersect_surfaces(surface, flat, budget=2).undecided)
    start = met.branches[0].points[3]
    uvst = np.hstack([start["uv"], start["st"]])
    walk = footpoint.intersect_march(surface, flat, uvst).branches[0].points
    footpoint.intersect_correct(surface, flat, uvst), footpoint.intersect_bisect(surface, flat, np.hstack([walk["uv"], walk["st"]]))
    line, plane = footpoint.Curve.from_poles(1, [[-5, 0, 1], [5, 0, 1]]), intersect.Quadric.plane([0, 0, 1], [0, 0, 1])
    intersect.curves(curve, curve, budget=50), intersect.surface_curve(surface, line), intersect.curve_quadric(line, plane)
    intersect.sections(surface, [plane, intersect.Quadric.plane(surface.evaluate([1, 0.5]), [1, 0, 0])])
    intersect.sections(hill(), [intersect.Quadric.plane([0, 0, 0], [0, 0, 1])] * 2)
    intersect.sections(footpoint.Surface.from_poles(1, 1, [[[0, 0, 0], [0, 2, 0]], [[2, 0, 0], [2, 2, 0]]]),
                       [intersect.Quadric.plane([0, 0, 0], [0, 0, 1]), intersect.Quadric.sphere([1, 1, 1], 1)])
    intersect.conics(plane, intersect.Quadric.sphere([0, 0, 0], 2), 1e-9)
    caster = intersect.Caster(surface)
    caster.first(points, [1, 0, 0]), caster.first(points, [1, 0, 0], alone=True), caster.all(points, [1, 0, 0])
    del caster
    footpoint.version(), footpoint.abi_version()
    with pytest.raises(RuntimeError, match="FPT_INTERNAL"):
        raise _library.failure(_library.INTERNAL)
    del curve, surface, shape, scene, query, face, met, walk
    assert set(_library.PROTOTYPES) - reached == set()


def reach_constructions():
    c = construct
    grid = np.stack([*np.meshgrid(np.arange(6.0), np.arange(7.0), indexing="ij"), np.zeros((6, 7))], -1)
    row = grid[0]
    at = c.parameters(row)
    c.interpolate(row), c.least_squares(1, [0, 0, 1, 1], at, row), c.fit_curve(row, 1e-3)
    c.interpolate_grid(grid), c.fit_grid(grid, 1e-3), c.fit_surface(grid.reshape(-1, 3), 1e-3)
    low, high = c.line([0, 0, 0], [1, 0, 0]), c.line([0, 1, 0], [1, 1, 0])
    left, right = c.line([0, 0, 0], [0, 1, 0]), c.line([1, 0, 0], [1, 1, 0])
    c.arc_through([[1, 0, 0], [0, 1, 0], [-1, 0, 0]]), c.conic([[0, 0, 0], [1, 1, 0], [2, 0, 0]], 0.5)
    c.parabola(1, 0, 1), c.hyperbola(1, 1, 0, 1), c.saddle(1, 1, [0, 1, 0, 1]), c.plane([0, 1, 0, 1]), c.torus(3, 1)
    ball, ring = c.quadric(c.QuadricKind.ELLIPSOID, [1, 1, 1], [0, 1], [-0.5, 0.5]), c.arc(2)
    c.ruled(low, high), c.extruded(low, [0, 0, 1]), c.revolved(low, [0, -1, 0], [1, 0, 0]), c.translational(low, left)
    along_u, along_v = footpoint.Curve.from_poles(1, [[1, 0], [1, 0]]), footpoint.Curve.from_poles(1, [[0, 1], [0, 1]])
    c.coons([left, right, low, high]), c.coons([left, right, low, high], [along_u, along_u, along_v, along_v])
    corners = [[[0, 0, 0], [0, 1, 0]], [[1, 0, 0], [1, 1, 0]]]
    c.ferguson(corners, np.zeros((2, 2, 3)), np.zeros((2, 2, 3)))
    c.gordon([low, high], [0, 1], [left, right], [0, 1]), c.skinned([low, high], 1), c.swept(c.line([2, 0, 0], [3, 0, 0]), ring, 1e-3)
    c.offset(ring, 1), c.offset(ball, 1), c.fit_offset(ring, 1, 1e-3), c.fit_offset(ball, 1, 1e-3)
