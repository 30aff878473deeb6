"""Run inside FreeCAD's window: presses the buttons, checks the results, keeps screenshots. FOOTPOINT_OUT is the folder for them.

Writes gui.txt there: one line a check, the last "done".
"""

import os
import time
import traceback

import FreeCAD
import FreeCADGui as Gui
import numpy as np
import Part
from PySide import QtCore, QtGui

OUT = os.environ["FOOTPOINT_OUT"]
COUNT = int(os.environ.get("FOOTPOINT_POINTS", "20000"))
from footpoint_freecad import commands, settings

V = FreeCAD.Vector
log = open(os.path.join(OUT, "gui.txt"), "w")


def check(what, true):
    log.write(f"{'ok' if true else 'WRONG'} {what}\n")
    log.flush()


def press(name):
    """Presses the button of the tool bar as a user does."""
    text = Gui.Command.get(name).getInfo()["menuText"]
    for bar in Gui.getMainWindow().findChildren(QtGui.QToolBar, "Footpoint"):
        for action in bar.actions():
            button = bar.widgetForAction(action)
            if action.text().replace("&", "") == text and button is not None:
                check(f"{name}: button can be pressed", button.isEnabled())
                button.click()
                return
    check(f"{name}: has a button", False)


def shot(name):
    for _ in range(5):
        QtGui.QApplication.processEvents()
        time.sleep(0.1)
    QtGui.QApplication.primaryScreen().grabWindow(0).save(os.path.join(OUT, name))  # the view too, which a widget grab leaves out


def answer_dialog(values):
    """Types a point into the dialog that the next button opens."""
    def fill():
        dialog = QtGui.QApplication.activeModalWidget()
        check("a point is asked for", dialog is not None and dialog.objectName() == "FootpointPoint")
        for box, value in zip(dialog.findChildren(QtGui.QDoubleSpinBox), values):
            box.setValue(value)
        dialog.accept()
    QtCore.QTimer.singleShot(800, fill)


def answer_distances(values):
    """Types wishes into the dialog that the next button opens, None: no wish; without values it is cancelled."""
    def fill():
        dialog = QtGui.QApplication.activeModalWidget()
        check("distances are asked for", dialog is not None and dialog.objectName() == "FootpointDistances")
        if values is None:
            dialog.reject()
            return
        table = dialog.findChild(QtGui.QTableWidget)
        check("the dialog has a row for each pole", table.rowCount() == len(values))
        for row, value in enumerate(values):
            if value is not None:
                table.cellWidget(row, 2).setValue(value)
        shot("freecad_distances.png")
        dialog.accept()
    QtCore.QTimer.singleShot(800, fill)


def answer_deviation(value, name):
    """Types the greatest deviation into the dialog that the next button opens and keeps a picture of it; None: it is cancelled."""
    def fill():
        dialog = QtGui.QApplication.activeModalWidget()
        check("a deviation is asked for", dialog is not None and dialog.objectName() == "FootpointFairing")
        if value is None:
            dialog.reject()
            return
        dialog.findChild(QtGui.QDoubleSpinBox).setValue(value)
        shot(name)
        dialog.accept()
    QtCore.QTimer.singleShot(800, fill)


def wavy_edge():
    """A spline through an arch with waves of 0.15 mm."""
    curve = Part.BSplineCurve()
    x = np.linspace(0, 100, 41)
    curve.interpolate([V(t, t * (100 - t) / 60 + 0.15 * (-1) ** k * (0 < k < 40), 0) for k, t in enumerate(x)])
    return curve.toShape()


def wavy_face():
    """A shallow dome over 100 mm x 80 mm whose inner poles are off by up to 0.2 mm."""
    count, rng = 16, np.random.default_rng(5)
    knots = np.concatenate([[0.0] * 4, np.arange(1, count - 3) / (count - 3), [1.0] * 4])
    at = np.convolve(knots[1:-1], np.ones(3) / 3, "valid")
    noise = np.zeros((count, count))
    noise[2:-2, 2:-2] = rng.uniform(-0.2, 0.2, (count - 4, count - 4))
    poles = [[V(100 * u, 80 * v, 60 * u * (1 - u) + 30 * v * (1 - v) + noise[i, j]) for j, v in enumerate(at)] for i, u in enumerate(at)]
    single = np.unique(knots)
    many = [4] + [1] * (len(single) - 2) + [4]
    surface = Part.BSplineSurface()
    surface.buildFromPolesMultsKnots(poles, many, many, single.tolist(), single.tolist(), False, False, 3, 3)
    return surface.toShape()


def part():
    """A bracket: a lofted horn on a bored plate with rounded corners."""
    plate = Part.makeBox(80, 60, 12)
    plate = plate.makeFillet(10, [edge for edge in plate.Edges if edge.Length == 12])
    rings = [Part.Wire([Part.makeCircle(radius, V(x, 30, z), V(tilt, 0, 1))]) for radius, x, z, tilt in ((18, 40, 6, 0), (11, 42, 30, 0.2), (13, 50, 52, 0.4), (20, 62, 70, 0.7))]
    horn = Part.makeLoft(rings, True)
    bores = [Part.makeCylinder(4, 40, V(x, y, -10)) for x in (12, 68) for y in (12, 48)]
    whole = plate.fuse(horn)
    for bore in bores:
        whole = whole.cut(bore)
    return whole.removeSplitter()


def scan(shape, count):
    """Noisy points near the surface, as a scanner gives them."""
    rng = np.random.default_rng(7)
    points, triangles = shape.tessellate(0.05)
    points = np.array([tuple(point) for point in points])
    corners = points[np.array(triangles)]
    across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    area = np.linalg.norm(across, axis=1)
    pick = rng.choice(len(area), count, p=area / area.sum())
    a, b = rng.random((2, count))
    a, b = np.where(a + b > 1, 1 - a, a), np.where(a + b > 1, 1 - b, b)
    one = corners[pick]
    at = one[:, 0] + a[:, None] * (one[:, 1] - one[:, 0]) + b[:, None] * (one[:, 2] - one[:, 0])
    bulge = 0.25 * np.sin(at[:, 0] / 9) * np.cos(at[:, 2] / 11) + rng.normal(0, 0.03, count)
    return at + across[pick] / area[pick, None] * bulge[:, None]


def steps():
    document = FreeCAD.newDocument("Demo")
    Gui.activateWorkbench("FootpointWorkbench")
    page = Gui.PySideUic.loadUi(settings.resource("ui", "preferences.ui"))
    check("the preferences page loads", page.findChild(QtGui.QDoubleSpinBox, "tolerance") is not None)
    yield
    source = document.addObject("Part::Feature", "Bracket")
    source.Shape = part()
    ball = document.addObject("Part::Feature", "Ball")
    ball.Shape = Part.makeSphere(10, V(-30, 30, 10))
    document.recompute()
    Gui.ActiveDocument.ActiveView.viewIsometric()
    Gui.SendMsgToActiveView("ViewFit")
    yield
    Gui.Selection.clearSelection()
    Gui.Selection.addSelection(document.Name, "Ball", "Face1", -20, 30, 10)
    press("Footpoint_Invert")
    found = document.getObject("Invert")
    check("invert: on the shape, proven", found is not None and found.OnShape and found.Proven)
    check("invert: both sides of the seam", len(found.Preimages) == 2 and abs(found.Preimages[1].x - 2 * np.pi) < 1e-9)
    check("invert: in the tree", found in document.getObject("Footpoint").Group)
    yield
    Gui.Selection.clearSelection()
    told = []
    plain, commands.say = commands.say, told.append
    press("Footpoint_Check")
    check("seams: says what to select", told == ["Select a face."])
    commands.say = plain
    Gui.Selection.addSelection(document.Name, "Ball", "Face1")
    press("Footpoint_Check")
    found = document.getObject("Seams")
    check("seams: one seam, two poles", found.ClosedU and not found.ClosedV and len(found.Collapsed) == 2)
    yield
    Gui.Selection.clearSelection()
    Gui.Selection.addSelection(document.Name, "Bracket")
    answer_dialog((100, 90, 50))
    press("Footpoint_Closest")
    found = document.getObject("Closest")
    expected = source.Shape.distToShape(Part.Vertex(V(100, 90, 50)))[0]
    check(f"closest: {found.Distance:.9f} as FreeCAD's distance {expected:.9f}, proven", abs(found.Distance - expected) < 1e-6 and found.Proven)
    ball.Placement.Base = V(0, 0, 5)
    document.recompute()
    check("invert: computed again when the source moves", abs(document.getObject("Invert").Distance - 5) > 1e-3 or not document.getObject("Invert").OnShape)
    Gui.SendMsgToActiveView("ViewFit")
    shot("freecad_results.png")
    yield
    ring = document.addObject("Part::Feature", "Ring")
    ring.Shape = Part.makeTorus(14, 5, V(62, 30, 64), V(0.5, 0.2, 1))
    document.recompute()
    horn = max(range(len(source.Shape.Faces)), key=lambda k: source.Shape.Faces[k].BoundBox.ZMax + source.Shape.Faces[k].BoundBox.ZLength)
    Gui.Selection.clearSelection()
    told = []
    plain, commands.say = commands.say, told.append
    Gui.Selection.addSelection(document.Name, "Ring", "Face1")
    press("Footpoint_Intersect")
    commands.say = plain
    check(f"intersection: one face is not enough: {told}", told == ["Select two faces."])
    Gui.Selection.addSelection(document.Name, "Bracket", f"Face{horn + 1}")
    press("Footpoint_Intersect")
    found = document.getObject("Intersection")
    expected = ring.Shape.Faces[0].section(source.Shape.Faces[horn]).Length
    check(f"intersection: {found.Label}; length {found.Shape.Length:.6f}, FreeCAD's section {expected:.6f}",
          found.Proven and found.Curves > 0 and abs(found.Shape.Length - expected) < 1e-3 * expected)
    check("intersection: in the tree", found in document.getObject("Footpoint").Group)
    source.ViewObject.Transparency = ring.ViewObject.Transparency = 60
    for name in ("Ball", "Invert", "Seams", "Closest"):
        document.getObject(name).ViewObject.Visibility = False
    Gui.Selection.clearSelection()
    Gui.SendMsgToActiveView("ViewFit")
    shot("freecad_intersection.png")
    source.ViewObject.Transparency = 0
    for name in ("Ring", "Intersection"):
        document.getObject(name).ViewObject.Visibility = False
    yield
    for name in ("Bracket", "Ball", "Invert", "Seams", "Closest"):
        document.getObject(name).ViewObject.Visibility = False
    drawn = document.addObject("Part::Feature", "Polygon")
    drawn.Shape = Part.makePolygon([V(0, 0, 0), V(15, 30, 0), V(40, 38, 0), V(70, 30, 0), V(80, 0, 0)])
    document.recompute()
    Gui.ActiveDocument.ActiveView.viewTop()
    Gui.SendMsgToActiveView("ViewFit")
    yield
    Gui.Selection.clearSelection()
    told = []
    plain, commands.say = commands.say, told.append
    Gui.Selection.addSelection(document.Name, "Bracket")
    press("Footpoint_Weights")
    commands.say = plain
    check(f"weights: a part is refused: {told}", len(told) == 1 and "polygon" in told[0])
    Gui.Selection.clearSelection()
    Gui.Selection.addSelection(document.Name, "Polygon", "Edge2", 30, 35, 0)
    answer_distances(None)
    press("Footpoint_Weights")
    check("weights: nothing comes of a cancelled dialog", document.getObject("Weights") is None)
    answer_distances((None, 6, None, 9, None))
    press("Footpoint_Weights")
    found = document.getObject("Weights")
    apart = [found.Shape.distToShape(Part.Vertex(pole))[0] for pole in (V(15, 30, 0), V(70, 30, 0))]
    check(f"weights: distances {apart[0]:.9f} and {apart[1]:.9f} by FreeCAD, met: {found.Label}", found.Met and abs(apart[0] - 6) < 1e-6 and abs(apart[1] - 9) < 1e-6)
    check("weights: a report line for each wish, in the tree", len(found.Report) == 2 and found in document.getObject("Footpoint").Group)
    Gui.Selection.clearSelection()
    Gui.Selection.addSelection(document.Name, "Weights")
    shot("freecad_weights.png")
    Gui.Selection.clearSelection()
    found.ViewObject.Visibility = drawn.ViewObject.Visibility = False
    yield from fairing(document)
    source.ViewObject.Visibility = True
    Gui.ActiveDocument.ActiveView.viewIsometric()
    yield
    import Points

    at = scan(source.Shape, COUNT)
    cloud = Points.Points()
    cloud.addPoints([V(*row) for row in at.tolist()])
    scanned = document.addObject("Points::Feature", "Scan")
    scanned.Points = cloud
    scanned.ViewObject.Visibility = False
    for name in ("Ball", "Invert", "Seams", "Closest"):
        document.getObject(name).ViewObject.Visibility = False
    yield
    Gui.Selection.clearSelection()
    Gui.Selection.addSelection(document.Name, "Bracket")
    Gui.Selection.addSelection(document.Name, "Scan")
    start, busy = time.perf_counter(), time.process_time()
    press("Footpoint_Deviation")
    QtGui.QApplication.processEvents()
    whole, busy = time.perf_counter() - start, time.process_time() - busy
    found = document.getObject("Deviation")
    legend = Gui.getMainWindow().findChild(QtGui.QDockWidget, "FootpointLegend")
    check(f"deviation: {found.Count} points, {found.Proven} proven, rms {found.Rms:.6f}", found.Count == COUNT and 0.05 < found.Rms < 0.3 and found.Proven > 0.999 * COUNT)
    check(f"deviation: {legend.found.seconds:.2f} s of computing, {whole:.2f} s from the button to the coloured points, {busy:.2f} s of processor time", True)
    source.ViewObject.Visibility = False
    Gui.Selection.clearSelection()
    Gui.SendMsgToActiveView("ViewFit")
    shot("freecad_deviation.png")
    legend.save_csv(os.path.join(OUT, "deviation.csv"))
    legend.save_picture(os.path.join(OUT, "deviation.png"))
    check("deviation: CSV and picture are written", os.path.getsize(os.path.join(OUT, "deviation.csv")) > COUNT * 40 and os.path.getsize(os.path.join(OUT, "deviation.png")) > 10000)
    yield
    def cancel():
        dialog = QtGui.QApplication.activeModalWidget()
        if isinstance(dialog, QtGui.QProgressDialog):
            dialog.findChild(QtGui.QPushButton).click()
        else:
            QtCore.QTimer.singleShot(20, cancel)

    QtCore.QTimer.singleShot(20, cancel)
    many = np.tile(at, (max(1, 1_500_000 // COUNT), 1)) + 5.0
    check("deviation: cancelled by its dialog", commands.with_dialog(source.Shape, many) is None)
    document.saveAs(os.path.join(OUT, "demo.FCStd"))
    check("the document is saved", os.path.getsize(os.path.join(OUT, "demo.FCStd")) > 1000)


def fairing(document):
    """Fair curve, Fair surface and Inspect, with their dialogs."""
    edge = document.addObject("Part::Feature", "WavyEdge")
    edge.Shape = wavy_edge()
    face = document.addObject("Part::Feature", "WavyFace")
    face.Shape = wavy_face()
    face.ViewObject.Visibility = False
    document.recompute()
    Gui.ActiveDocument.ActiveView.viewTop()
    Gui.SendMsgToActiveView("ViewFit")
    yield
    Gui.Selection.clearSelection()
    Gui.Selection.addSelection(document.Name, "WavyEdge", "Edge1")
    answer_deviation(None, "")
    press("Footpoint_FairCurve")
    check("fair curve: nothing comes of a cancelled dialog", document.getObject("Fair") is None)
    answer_deviation(0.4, "freecad_fair_curve.png")
    press("Footpoint_FairCurve")
    found = document.getObject("Fair")
    check(f"fair curve: {found.Label}", found in document.getObject("Footpoint").Group)
    apart = max(found.Shape.distToShape(Part.Vertex(p))[0] for p in edge.Shape.Edges[0].discretize(400))
    check(f"fair curve: {apart:.6f} mm apart by FreeCAD, 0.4 allowed", 0.01 < apart <= 0.4 * (1 + 1e-9))
    yield
    for name in ("WavyEdge", found.Name):
        Gui.Selection.clearSelection()
        Gui.Selection.addSelection(document.Name, name, "Edge1")
        press("Footpoint_Inspect")
    before, after = document.getObject("Inspect"), document.getObject("Inspect001")
    turns = [int(next(line for line in one.Report if line.startswith("inflections")).split()[-1]) for one in (before, after)]
    check(f"inspect: inflections {turns[0]} before, {turns[1]} after", turns[0] > 20 and turns[1] <= 2)
    Gui.SendMsgToActiveView("ViewFit")
    shot("freecad_inspect_curve.png")
    for one in (edge, found, before, after):
        one.ViewObject.Visibility = False
    face.ViewObject.Visibility = True
    Gui.ActiveDocument.ActiveView.viewIsometric()
    Gui.SendMsgToActiveView("ViewFit")
    yield
    Gui.Selection.clearSelection()
    Gui.Selection.addSelection(document.Name, "WavyFace", "Face1")
    press("Footpoint_Inspect")
    dock = Gui.getMainWindow().findChild(QtGui.QDockWidget, "FootpointReflections")
    check("inspect: pictures of the face are shown", dock is not None and dock.label.pixmap().width() == 480)
    seen = set()
    for pattern in range(dock.box.count()):
        dock.box.setCurrentIndex(pattern)
        seen.add(dock.label.pixmap().toImage().cacheKey())
    check(f"inspect: {len(seen)} patterns", len(seen) == 9)
    dock.box.setCurrentIndex(1)
    shot("freecad_inspect_before.png")
    yield
    Gui.Selection.clearSelection()
    Gui.Selection.addSelection(document.Name, "WavyFace", "Face1")
    answer_deviation(0.5, "freecad_fair_surface.png")
    press("Footpoint_FairSurface")
    found = document.getObject("Fair001")
    check(f"fair surface: {found.Label}", found is not None and found in document.getObject("Footpoint").Group)
    face.ViewObject.Visibility = False
    Gui.Selection.clearSelection()
    Gui.Selection.addSelection(document.Name, found.Name, "Face1")
    press("Footpoint_Inspect")
    Gui.Selection.clearSelection()
    shot("freecad_inspect_after.png")
    dock = Gui.getMainWindow().findChild(QtGui.QDockWidget, "FootpointReflections")
    Gui.getMainWindow().removeDockWidget(dock)
    dock.deleteLater()
    for one in document.Objects:
        if one.Name.startswith(("Fair", "Inspect", "Wavy")):
            one.ViewObject.Visibility = False


running = steps()


def go():
    try:
        next(running)
        QtCore.QTimer.singleShot(400, go)
        return
    except StopIteration:
        log.write("done\n")
    except BaseException:
        log.write("WRONG " + traceback.format_exc())
    log.close()
    os._exit(0)


QtCore.QTimer.singleShot(2500, go)
