"""Run by freecadcmd: the computations against FreeCAD's own, results as document objects, the macro module.

Prints a table of Surface.parameter beside ours, then "N passed, M failed"; the exit code says whether all passed.
"""

import json
import os
import sys
import tempfile
import time
import traceback

import FreeCAD
import numpy as np
import Part

sys.path.insert(0, os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__)))))
from footpoint_freecad import fairing, intersections, measure, objects, parameters, toolkit, weights  # noqa: E402

V = FreeCAD.Vector
HERE = os.path.dirname(os.path.abspath(__file__))
PLACE = FreeCAD.Placement(V(3, -4, 5), FreeCAD.Rotation(V(1, 2, 3), 40))


def profile(closed=False):
    curve = Part.BSplineCurve()
    curve.interpolate([V(10, 0, 0), V(14, 0, 6), V(8, 0, 12), V(12, 0, 20)] if not closed else [V(0, 0, 0), V(10, 5, 0), V(20, -2, 0), V(8, -9, 0)], PeriodicFlag=closed)
    return curve


def bumpy():
    rng = np.random.default_rng(4)
    surface = Part.BSplineSurface()
    surface.interpolate([[V(8 * i, 8 * j, float(rng.normal(0, 5))) for j in range(7)] for i in range(8)])
    return surface


def loft():
    return Part.makeLoft([Part.Wire([Part.makeCircle(r, V(0, 0, z))]) for r, z in ((10, 0), (6, 8), (9, 20))], True)


def ten_faces():
    weights = Part.BSplineSurface()
    weights.buildFromPolesMultsKnots([[V(x, y, x * y / 9 + (x - 5) ** 2 / 6) for y in (0, 4, 9, 12)] for x in (0, 3, 8, 11)], [4, 4], [4, 4], [0, 1], [0, 2],
                                     False, False, 3, 3, [[1, 2, 1, 0.5], [1, 1, 3, 1], [0.4, 1, 1, 2], [1, 1, 1, 1]])
    faces = {"plane": Part.makeBox(20, 30, 5).Faces[0], "cylinder": Part.makeCylinder(5, 20).Faces[0], "cone": Part.makeCone(2, 8, 12).Faces[0],
             "sphere": Part.makeSphere(7).Faces[0], "torus": Part.makeTorus(12, 4).Faces[0],
             "revolution": Part.SurfaceOfRevolution(profile(), V(0, 0, 0), V(0, 0, 1)).toShape(),
             "extrusion": Part.Wire([Part.Edge(profile(True))]).extrude(V(2, 4, 18)).Faces[0],
             "loft": loft().Faces[0], "bumpy": bumpy().toShape(), "rational": weights.toShape()}
    return {name: face.transformed(PLACE.toMatrix()) for name, face in faces.items()}


def around(shape, count, seed=3):
    box = shape.BoundBox
    rng = np.random.default_rng(seed)
    low, high = np.array([box.XMin, box.YMin, box.ZMin]), np.array([box.XMax, box.YMax, box.ZMax])
    edge = 0.2 * np.linalg.norm(high - low)
    return rng.uniform(low - edge, high + edge, (count, 3))


def test_parameters_beside_freecad():
    """Ours is never farther than FreeCAD's; where FreeCAD's is farther or fails, the table counts it."""
    print(f"{'face':12} {'farther':>8} {'failed':>7} {'outside':>8} {'by a hair':>10} {'ours farther':>13} {'not proven':>11} {'FreeCAD us':>11} {'ours, one by one':>17} {'ours, batch':>12}")
    for name, face in ten_faces().items():
        surface, points = face.Surface, around(face, 1000)
        size = face.BoundBox.DiagonalLength
        ours = parameters.Surface(face)
        start = time.perf_counter()
        uv = ours.parameters(points)
        batch = time.perf_counter() - start
        feet = ours.feet(points)
        start = time.perf_counter()
        [ours.parameter(point) for point in points]
        single = time.perf_counter() - start
        vectors = [V(*point) for point in points.tolist()]
        theirs, failed = [], 0
        start = time.perf_counter()
        for point in vectors:
            try:
                theirs.append(surface.parameter(point))
            except Exception:
                theirs.append(None)
                failed += 1
        freecad = time.perf_counter() - start
        bounds = face.ParameterRange
        distance = np.array([(surface.value(*map(float, pair)) - point).Length for pair, point in zip(uv, vectors)])
        low, high = np.array(bounds[0::2]), np.array(bounds[1::2])
        given = np.array([pair if pair else (np.nan, np.nan) for pair in theirs])
        beyond = (np.maximum(low - given, given - high) / (high - low)).max(1)
        within, hair = beyond <= 1e-7, (beyond > 0) & (beyond <= 1e-7)
        moved = np.where(within[:, None], np.clip(given, low, high), given)  # a hair outside the face is no point of it
        other = np.array([(surface.value(*map(float, pair)) - point).Length if pair[0] == pair[0] else np.inf for pair, point in zip(moved, vectors)])
        farther = np.isfinite(other) & (other > distance + 1e-6 * size)
        worse = within & (distance > other + 1e-9 * size)
        print(f"{name:12} {farther.sum():8} {failed:7} {(~within).sum() - failed:8} {hair.sum():10} {worse.sum():13} {(~feet.proven).sum():11} {freecad * 1e3:11.1f} {single * 1e3:17.1f} {batch * 1e3:12.2f}")
        assert not worse.any() and feet.proven.all()
        assert np.abs(distance - feet.distance).max() < 1e-9 * size
        mine = parameters.parameter(face, vectors[0])
        assert np.allclose(mine, uv[0]) and isinstance(mine, tuple)


def test_curves():
    for edge in [*Part.makeCone(2, 8, 12).Edges, Part.Edge(profile(True)), Part.Ellipse(V(0, 0, 0), 5, 2).toShape()]:
        curve = parameters.Curve(edge)
        for t in np.linspace(*edge.ParameterRange, 7)[1:-1]:
            at = edge.Curve.value(float(t))
            assert abs(curve.parameter(at) - edge.Curve.parameter(at)) < 1e-7 * max(1, abs(t))
    assert np.allclose(parameters.parameter(Part.Plane(), V(3, 4, 5)), (3, 4))
    u, v = parameters.parameter(Part.Cylinder(), V(3, 4, 5))
    assert abs(u - Part.Cylinder().parameter(V(3, 4, 5))[0]) < 1e-12 and abs(v - 5) < 1e-9


def parts():
    plate = Part.makeBox(30, 20, 10).cut(Part.makeCylinder(5, 20, V(15, 10, -5)))
    bent = Part.makeBox(30, 30, 10).cut(Part.makeBox(20, 20, 20, V(10, 10, -5)))
    outline = Part.Wire([profile().toShape(), Part.makeLine(V(12, 0, 20), V(0, 0, 20)), Part.makeLine(V(0, 0, 20), V(0, 0, 0)), Part.makeLine(V(0, 0, 0), V(10, 0, 0))])
    vase = Part.Face(outline).revolve(V(0, 0, 0), V(0, 0, 1), 360).cut(Part.makeCylinder(4, 60, V(-30, 0, 10), V(1, 0, 0)))
    return {"plate": plate.makeFillet(2, [plate.Edges[0]]), "bent": bent.makeFillet(3, [edge for edge in bent.Edges if edge.Length == 10][:3]),
            "vase": vase, "loft": loft().cut(Part.makeBox(9, 9, 30, V(3, 3, -2))), "torus": Part.makeTorus(12, 4), "cone": Part.makeCone(0, 8, 12)}


def test_parts_against_distToShape():
    """Nearest points of trimmed parts beside FreeCAD's distance to the shell, signs beside its classification of the solid."""
    for name, solid in parts().items():
        solid = solid.transformed(PLACE.toMatrix())
        points = around(solid, 400, 8)
        found = measure.deviation(solid, points).nearest
        shell = Part.Shell(solid.Faces)
        truth = np.array([shell.distToShape(Part.Vertex(V(*point)))[0] for point in points])
        inside = np.array([solid.isInside(V(*point), 1e-9, True) for point in points])
        size = solid.BoundBox.DiagonalLength
        on = max(shell.distToShape(Part.Vertex(V(*point)))[0] for point in found.point[:50])
        print(f"{name:8} ours - FreeCAD's: {(found.distance - truth).min():.1e} to {(found.distance - truth).max():.1e}; {(~found.proven).sum()} not proven")
        assert (found.distance <= truth + 1e-7 * size).all() and on < 1e-7 * size, name
        assert (found.lower_bound <= truth + 1e-9 * size).all(), name
        clear = found.distance > 1e-6 * size
        assert ((found.signed < 0) == inside)[clear].all(), name


def test_objects():
    document = FreeCAD.newDocument("Test")
    ball = document.addObject("Part::Feature", "Ball")
    ball.Shape = Part.makeSphere(4)
    made = objects.make(objects.InvertResult, "Invert", ball, "Face1", (4, 0, 0))
    assert made.Proven and made.OnShape and made.Complete and len(made.Preimages) == 2
    pole = objects.make(objects.InvertResult, "Invert", ball, "Face1", (0, 0, 4))
    assert pole.OnShape and len(pole.Preimages) >= 1
    seams = objects.make(objects.SeamsResult, "Seams", ball, "Face1")
    assert seams.ClosedU and not seams.ClosedV and len(seams.Collapsed) == 2 and not seams.Shape.isNull()
    near = objects.make(objects.ClosestResult, "Closest", ball, "", (0, 9, 0))
    assert near.Proven and abs(near.Distance - 5) < 1e-12 and abs(near.Shape.Length - 5) < 1e-12
    count = len(document.Objects)
    try:
        objects.make(objects.InvertResult, "Invert", ball, "Vertex1", (1, 1, 1))
        raise AssertionError("no error")
    except TypeError as error:
        assert "face" in str(error) and len(document.Objects) == count
    edge = objects.make(objects.InvertResult, "Invert", ball, "Edge2", (1, 1, 1))
    assert not edge.OnShape and len(edge.Parameters) == 1
    ball.Placement.Base = V(0, 2, 0)
    document.recompute()
    assert abs(near.Distance - 3) < 1e-12
    found = measure.deviation(ball.Shape, around(ball.Shape, 500))
    drawn = objects.make_deviation(ball, "", found)
    assert drawn.Count == 500 and drawn.Proven == 500 and len(drawn.Color) == 500
    with tempfile.TemporaryDirectory() as folder:
        found.save_csv(os.path.join(folder, "d.csv"))
        back = measure.points_of(os.path.join(folder, "d.csv"))
        assert np.allclose(back, found.points, rtol=1e-8)
        file = os.path.join(folder, "t.FCStd")
        document.saveAs(file)
        FreeCAD.closeDocument(document.Name)
        again = FreeCAD.openDocument(file)
        assert abs(again.getObject("Closest").Distance - 3) < 1e-12 and type(again.getObject("Closest").Proxy).__name__ == "ClosestResult"
        again.getObject("Closest").Query = V(0, 11, 0)
        again.recompute()
        assert abs(again.getObject("Closest").Distance - 5) < 1e-12
        FreeCAD.closeDocument(again.Name)


def test_weights():
    """Weights from distances: a quarter circle, a polygon, a placed, a trimmed, a periodic curve; changed, saved, refused."""
    document = FreeCAD.newDocument("Weights")
    corner = document.addObject("Part::Feature", "Corner")
    corner.Shape = Part.makePolygon([V(5, 0, 0), V(5, 5, 0), V(0, 5, 0)])
    made = objects.make(objects.WeightsResult, "Quarter", corner, "", Distances=[-1, 5 * (2**0.5 - 1), -1])
    assert made.Met and abs(made.Weights[1] - 0.5**0.5) < 1e-12 and "pole 2" in made.Report[0] and made.Report[0].endswith(": met")
    at = made.Shape.Edges[0]
    assert max(abs(at.valueAt(float(u)).Length - 5) for u in np.linspace(*at.ParameterRange, 30)) < 1e-11
    assert all(low <= found for low, found in zip(made.LowerBounds, made.Achieved)) and made.Label == "Weights: 1 of 1 wishes met"
    made.Distances = [-1, 1, -1]
    document.recompute()
    assert made.Met and abs(made.Shape.distToShape(Part.Vertex(V(5, 5, 0)))[0] - 1) < 1e-7
    corner.Placement.Base = V(0, 0, 3)
    document.recompute()
    assert made.Met and abs(made.Shape.distToShape(Part.Vertex(V(5, 5, 3)))[0] - 1) < 1e-7
    spline = document.addObject("Part::Feature", "Spline")
    spline.Shape, spline.Placement = profile().toShape(), PLACE
    document.recompute()
    curve = weights.control(spline.Shape)
    assert curve.degree == 3 and max((spline.Shape.Edges[0].valueAt(u) - V(*curve.evaluate(u))).Length for u in (0.1, 0.5, 0.9)) < 1e-12
    now = curve.closest(curve.poles).distance
    wish = [-1, float(now[1]) * 0.7, -1, -1, -1, -1][: len(now)]
    bent = objects.make(objects.WeightsResult, "Bent", spline, "Edge1", Distances=wish)
    assert bent.Met and abs(bent.Shape.distToShape(Part.Vertex(V(*curve.poles[1])))[0] - wish[1]) < 1e-7
    far = objects.make(objects.WeightsResult, "Far", spline, "", Distances=[-1, 1e3] + [-1] * (len(now) - 2))
    assert not far.Met and far.Report[0].endswith("impossible") and far.Label == "Weights: 0 of 1 wishes met"
    for name, shape in {"Trimmed": profile().toShape(0.2, 0.7), "Periodic": profile(True).toShape(), "Square": Part.makePolygon([V(0, 0, 0), V(4, 0, 0), V(4, 4, 0), V(0, 4, 0), V(0, 0, 0)])}.items():
        source = document.addObject("Part::Feature", name)
        source.Shape = shape
        curve = weights.control(shape)
        ends = curve.evaluate(curve.domain)
        on = [V(*point) for point in (curve.poles[[0, -1]] if name == "Square" else curve.evaluate(np.linspace(*curve.domain, 20)))]
        assert max(shape.distToShape(Part.Vertex(point))[0] for point in on) < 1e-9 and np.abs(ends - curve.poles[[0, -1]]).max() < 1e-9, name
        wishes = [-1, float(curve.closest(curve.poles[1]).distance) * 0.8] + [-1] * (curve.pole_count - 2)
        one = objects.make(objects.WeightsResult, name + "Weights", source, Distances=wishes)
        assert one.Met and abs(one.Shape.distToShape(Part.Vertex(V(*curve.poles[1])))[0] - wishes[1]) < 1e-7 and one.Shape.isClosed() == shape.isClosed(), name
    free = objects.make(objects.WeightsResult, "Free", corner, Degree=1)
    assert list(free.Distances) == [-1, -1, -1] and list(free.Weights) == [1, 1, 1] and list(free.Report) == ["no wishes"]
    count = len(document.Objects)
    box = document.addObject("Part::Feature", "Box")
    box.Shape = Part.makeBox(1, 2, 3)
    for source, sub, values, text in ((box, "", {}, "polygon"), (box, "Edge1", {}, "polygon"), (corner, "", {"Distances": [1.0, 2.0]}, "3 poles"),
                                      (corner, "", {"Degree": 7}, "degree"), (corner, "", {"WeightMin": -1.0}, "weight_min"),
                                      (corner, "", {"Distances": [-1, float("nan"), -1]}, "wish 0")):
        try:
            objects.make(objects.WeightsResult, "Wrong", source, sub, **values)
            raise AssertionError("no error")
        except ValueError as error:
            assert text in str(error), error
    assert len(document.Objects) == count + 1
    with tempfile.TemporaryDirectory() as folder:
        document.saveAs(os.path.join(folder, "w.FCStd"))
        FreeCAD.closeDocument(document.Name)
        again = FreeCAD.openDocument(os.path.join(folder, "w.FCStd"))
        again.getObject("Quarter").Distances = [-1, 2, -1]
        again.recompute()
        assert again.getObject("Quarter").Met and abs(again.getObject("Quarter").Achieved[1] - 2) < 1e-8
        FreeCAD.closeDocument(again.Name)


def test_faces_as_trimmed_surfaces():
    """Points, normals and loops are FreeCAD's; elementary faces go to NURBS with a proof."""
    import footpoint
    from footpoint import trims

    box = Part.makeBox(8, 8, 8, V(-4, -4, -4))
    solids = [Part.makeSphere(3), Part.makeCylinder(2, 5), Part.makeCone(2, 0, 5), Part.makeCone(1, 2, 5), Part.makeTorus(5, 2),
              Part.makeCylinder(3, 10, V(0, 0, -5)).cut(Part.makeCylinder(1.5, 10, V(-5, 0, 0.3), V(1, 0, 0))),
              box.cut(Part.makeSphere(3, V(4, 4, 4))), Part.makeSphere(3).cut(Part.makeCylinder(1, 10, V(0.4, 0.3, -5))),
              box.makeFillet(0.8, box.Edges), loft()]
    wave = Part.BSplineCurve()
    wave.interpolate([V(2 + 0.4 * np.sin(1.7 * k), 0, k) for k in range(6)])
    ellipse = Part.Ellipse(V(4, 0, 0), 1.5, 0.7).toShape()
    solids += [wave.toShape().revolve(V(0, 0, 0), V(0, 0, 1), 360), wave.toShape().revolve(V(0, 0, 0), V(0, 0, 1), 140),
               wave.toShape().extrude(V(0.3, 2, 0)), ellipse.extrude(V(1, 3, 0.5)), ellipse.revolve(V(0, 0, 0), V(0, 1, 0), 200)]
    count, kinds = 0, set()
    for number, solid in enumerate(solids):
        placed = solid.copy()
        placed.rotate(V(1, 2, 3), V(1, -2, 0.5), 40)
        for face in placed.Faces:
            count += 1
            trim = trims.from_freecad(face)
            assert trim.is_flipped == (face.Orientation == "Reversed"), number
            report = trim.report(1e-6)
            assert report.findings == [] and report.gap_bound < 1e-5, (number, report)
            kinds.add(json.loads(trim.to_json())["support"]["kind"])
            for k, loop in enumerate(trim.loops):
                for i in range(len(loop.coedges)):
                    uv, points, _ = trim.evaluate(k, i, [0, 0.4, 1])
                    off = [np.linalg.norm(np.array(face.Surface.value(*at)) - point) for at, point in zip(uv, points)]
                    assert max(off) < 1e-9, (number, off)
            if type(face.Surface).__name__ in ("Sphere", "Cylinder", "Cone", "Toroid"):
                changed = trim.to_nurbs(tolerance=1e-5)
                assert changed.proven and changed.face.report(3e-5).findings == [], number
            # Sides and nearest points in FreeCAD's parameters.
            prepared = footpoint.Face.of_trim(trim)
            u0, u1, v0, v1 = face.ParameterRange
            for x, y in ((0.31, 0.47), (0.71, 0.13), (0.07, 0.93)):
                u, v = u0 + x * (u1 - u0), v0 + y * (v1 - v0)
                standing = prepared.classify([u, v], tolerance=1e-5)["standing"]
                if standing != footpoint.Standing.ON_EDGE:
                    assert (standing == footpoint.Standing.INSIDE) == face.isPartOfDomain(u, v), (number, u, v)
                query = face.valueAt(u, v) + V(0.3, -0.4, 0.2)
                feet, _ = prepared.closest([tuple(query)])
                assert feet.distance[0] <= Part.Vertex(query).distToShape(face)[0] + 1e-6, (number, u, v)
    assert count > 50, count
    assert {"plane", "cylinder", "cone", "sphere", "torus", "spline", "revolution", "extrusion"} <= kinds, kinds


def test_fairing_and_inspection():
    """A wavy edge and a bumpy face are faired within the deviation and follow their source; edges and faces are inspected."""
    document = FreeCAD.newDocument("Fairing")
    wavy = document.addObject("Part::Feature", "Wavy")
    curve = Part.BSplineCurve()
    curve.buildFromPolesMultsKnots([V(k, 0.1 * k * (20 - k) + 0.08 * (-1) ** k, 0) for k in range(21)], [4] + [1] * 17 + [4], list(range(19)), False, 3)
    wavy.Shape = curve.toShape()
    made = objects.make(objects.FairResult, "Fair", wavy, "Edge1", Deviation=0.2, Keep=1)
    assert 0 < made.Proven <= 0.2 and made.Energies[-1] < 0.9 * made.Energies[0] and list(made.Energies) == sorted(made.Energies, reverse=True)
    before, after = wavy.Shape.Edges[0], made.Shape.Edges[0]
    assert max((before.valueAt(u) - after.valueAt(u)).Length for u in np.linspace(0, 18, 200)) <= made.Proven
    reports = [objects.make(objects.InspectResult, "Inspect", source, "Edge1") for source in (wavy, made)]
    turns = [int(report.Report[1].split()[-1]) for report in reports]
    assert turns[0] == 18 and turns[1] == 0 and "proven" in reports[0].Report[0] and len(reports[0].Shape.Edges) > 100, turns
    made.Deviation = 0.01
    document.recompute()
    assert made.Proven <= 0.01
    bump = document.addObject("Part::Feature", "Bump")
    surface = Part.BSplineSurface()
    at = [0, 1 / 3, 1, 2, 3, 4, 5, 17 / 3, 6]  # where parameters are lengths
    surface.buildFromPolesMultsKnots([[V(at[i], at[j], 0.02 * ((i + j) % 2) * (2 <= i <= 6 and 2 <= j <= 6)) for j in range(9)] for i in range(9)],
                                     [4] + [1] * 5 + [4], [4] + [1] * 5 + [4], list(range(7)), list(range(7)), False, False, 3, 3)
    bump.Shape = surface.toShape()
    flat = objects.make(objects.FairResult, "Flat", bump, "Face1", Deviation=0.05)
    assert flat.Proven <= 0.05 and flat.Energies[-1] < flat.Energies[0] / 50 and flat.Shape.Faces
    tube = document.addObject("Part::Feature", "Tube")
    tube.Shape = Part.makeCylinder(2, 5)
    found = objects.make(objects.InspectResult, "Inspect", tube, "Face1")
    low, high = (float(word) for word in found.Report[0].split(": ")[1].split(" mm")[0].split(" to "))
    assert low <= 2 <= high and high - low < 0.003 and found.Report[0].endswith("proven"), found.Report
    ring = objects.make(objects.InspectResult, "Inspect", tube, "Edge1")
    assert ring.Report[1:] == ["inflections: 0", "pieces of monotone curvature: 1"], ring.Report
    pixels = fairing.picture(tube.Shape.Faces[0], 1, (80, 60)).pixels
    assert pixels.shape == (60, 80, 3) and len(np.unique(pixels.reshape(-1, 3), axis=0)) > 20
    for kind, sub, values, text in ((objects.FairResult, "Edge1", {"Deviation": 0.0}, "deviation"), (objects.FairResult, "", {"Deviation": 1.0}, "one edge or one face")):
        try:
            objects.make(kind, "Wrong", tube, sub, **values)
            raise AssertionError("no error")
        except ValueError as error:
            assert text in str(error), error
    FreeCAD.closeDocument(document.Name)


def test_operations_and_constructions():
    """Those of footpoint on geometry of Part, beside FreeCAD's own where it has one."""
    curve = profile()
    edge = curve.toShape()
    def apart(one, other, count=200):
        ends = one.FirstParameter, one.LastParameter
        return max((one.value(u) - other.value(u)).Length for u in np.linspace(*ends, count))

    finer = curve.copy()
    middles = [0.5 * (a + b) for a, b in zip(curve.getKnots(), curve.getKnots()[1:])]
    for u in middles:
        finer.insertKnot(u, 1, 1e-12)
    ours = toolkit.call("operate.refine", edge, middles)
    assert ours.NbPoles == finer.NbPoles and apart(finer, ours) < 1e-12
    thin, error = toolkit.call("operate.simplify", ours, 1e-9)
    assert thin.NbPoles <= curve.NbPoles and error <= 1e-9 and apart(curve, thin) <= error + 1e-12
    wide = toolkit.call("operate.refine", bumpy(), [0.5 * sum(bumpy().getUKnots()[:2])], direction="u")
    slim, error = toolkit.call("operate.simplify", wide, 1e-6)
    assert wide.NbUPoles == bumpy().NbUPoles + 1 and slim.NbUPoles <= bumpy().NbUPoles and error <= 1e-6
    raised = curve.copy()
    raised.increaseDegree(5)
    assert apart(raised, toolkit.call("operate.elevate", edge, 2)) < 1e-12
    part = curve.copy()
    low, high = curve.FirstParameter + 0.2, curve.LastParameter - 0.3
    part.segment(low, high)
    assert apart(part, toolkit.call("operate.part", edge, (low, high))) < 1e-10
    ring = profile(True)
    closed = ring.copy()
    closed.setNotPeriodic()
    periodic, error = toolkit.call("operate.periodic", closed, 1e-9)
    assert error <= 1e-9 and apart(closed, periodic) <= error + 1e-10
    total = toolkit.call("operate.ArcLength", edge).total
    assert abs(total[0] - edge.Length) <= 1e-6 * edge.Length
    other = Part.makeCircle(6, V(0, 0, 30), V(0, 0, 1), 0, 90)
    ruled = toolkit.call("construct.ruled", edge, other)
    shape = ruled.toShape()
    for u in np.linspace(0, 1, 9):
        on = edge.valueAt(edge.FirstParameter + u * (edge.LastParameter - edge.FirstParameter))
        assert shape.distToShape(Part.Vertex(on))[0] < 1e-9
    near = toolkit.call("construct.fit_curve", [tuple(edge.valueAt(u)) for u in np.linspace(edge.FirstParameter, edge.LastParameter, 300)], 1e-3)
    assert near[1].worst <= 1e-3
    level = Part.BSplineSurface()
    level.buildFromPolesMultsKnots([[V(-5, -5, 0.3), V(-5, 60, 0.3)], [V(70, -5, 0.3), V(70, 60, 0.3)]], [2, 2], [2, 2], [0, 1], [0, 1], False, False, 1, 1)
    meeting = toolkit.call("intersect_surfaces", bumpy(), level)
    assert meeting.is_proven and len(meeting.branches) > 0
    try:
        toolkit.call("operate.simplify", edge, -1.0)
    except ValueError as refused:
        assert "tolerance" in str(refused)
    else:
        raise AssertionError("a tolerance of -1 was taken")


def test_refusals():
    for call, text in ((lambda: measure.PartTarget(Part.Vertex(1, 2, 3)), "no faces"), (lambda: measure.invert(Part.Vertex(1, 2, 3), (0, 0, 0)), "curve"),
                       (lambda: parameters.parameter(3, (0, 0, 0)), ""), (lambda: measure.points_of(3), "point cloud")):
        try:
            call()
        except (ValueError, TypeError, AttributeError) as error:
            assert text in str(error)
        else:
            raise AssertionError("no error")


def test_guide():
    """The programs of the guide for FreeCAD users, as they stand there."""
    with open(os.path.join(HERE, "..", "..", "..", "docs", "guide.md"), encoding="utf-8") as stream:
        section = stream.read().split("## FreeCAD users")[1].split("\n## ")[0]
    programs = [part.split("```")[0] for part in section.split("```python\n")[1:]]
    assert len(programs) == 2
    for program in programs:
        exec(compile(program, "guide", "exec"), {})


def test_intersections_beside_section():
    """Curves of two faces: as long as FreeCAD's section of the same faces, and on both."""
    ball, pole = Part.makeSphere(10), Part.makeCylinder(4, 40, V(3, 0, -20))
    torus, loft_ = Part.makeTorus(12, 4), loft()
    box = Part.makeBox(30, 30, 10, V(-9, -8, 3))
    pairs = {"sphere, cylinder": (ball.Faces[0], pole.Faces[0], 2), "torus, plane": (torus.Faces[0], box.Faces[4], None),
             "torus, cylinder": (torus.Faces[0], Part.makeCylinder(3, 40, V(10, 2, -20)).Faces[0], None),
             "loft, plane": (loft_.Faces[0], Part.makeBox(30, 30, 10, V(-2, -8, 3)).Faces[0], None), "trimmed, trimmed": (box.cut(pole).Faces[-1], ball.Faces[0], None)}
    for name, (first, second, loops) in pairs.items():
        first, second = (face.transformed(PLACE.toMatrix()) for face in (first, second))
        found = intersections.of_faces(first, second)
        ours = sum(shape.Length for shape in found.shapes)
        theirs = first.section(second).Length
        print(f"{name:18} {found.curves} curves, {found.loops} loops, length {ours:.6f}, FreeCAD's {theirs:.6f}")
        assert abs(ours - theirs) <= 1e-4 * max(theirs, 1), name
        assert found.proven and found.curves and loops in (None, found.loops), name
        for shape in found.shapes:
            for t in np.linspace(*shape.ParameterRange, 23):
                point = Part.Vertex(shape.valueAt(float(t)))
                assert max(face.distToShape(point)[0] for face in (first, second)) < 1e-4, name
    touching = intersections.of_faces(ball.Faces[0], Part.makeSphere(5, V(15, 0, 0)).Faces[0])
    assert touching.points == 1 and touching.curves == 0 and not touching.proven
    apart = intersections.of_faces(ball.Faces[0], Part.makeSphere(5, V(16, 0, 0)).Faces[0])
    assert apart.proven and not apart.shapes
    # Within the wires only: the other half of the sphere's section is cut away.
    half = ball.cut(Part.makeBox(30, 30, 30, V(-15, -15, 0)))
    whole, cut = (intersections.of_faces(shape.Faces[0], pole.Faces[0]) for shape in (ball, half))
    assert whole.loops == 2 and cut.loops == 1 and cut.curves < whole.curves
    document = FreeCAD.newDocument("Intersections")
    one, two = document.addObject("Part::Feature", "One"), document.addObject("Part::Feature", "Two")
    one.Shape, two.Shape = ball, pole
    made = objects.make(objects.IntersectResult, "Intersection", one, "Face1", Second=(two, ["Face1"]))
    assert made.Curves == whole.curves and made.Proven and len(made.Shape.Edges) == whole.curves and "nothing is missing" in made.Report[0]
    two.Placement.Base = V(30, 0, 0)
    document.recompute()
    assert made.Curves == 0 and made.Proven
    FreeCAD.closeDocument("Intersections")


failed = passed = 0
only = os.environ.get("FOOTPOINT_ONLY", "")
for name, test in [(name, test) for name, test in list(globals().items()) if name.startswith("test_") and only in name]:
    try:
        test()
        passed += 1
        print("ok", name)
    except BaseException:
        failed += 1
        print("FAILED", name)
        traceback.print_exc(file=sys.stdout)
print(f"{passed} passed, {failed} failed")
sys.stdout.flush()
os._exit(1 if failed or not passed else 0)
