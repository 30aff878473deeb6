"""The commands of the workbench."""

import FreeCAD
import FreeCADGui as Gui
from PySide import QtCore, QtGui

from . import fairing, measure, objects, weights
from .settings import resource

translate = FreeCAD.Qt.translate if hasattr(FreeCAD, "Qt") else lambda context, text, *_: text
CONTEXT = "Footpoint"


def QT_TRANSLATE_NOOP(context, text):
    """Marks a text for the translators."""
    return text


def say(text):
    """A message box, and the report view."""
    FreeCAD.Console.PrintWarning(f"Footpoint: {text}\n")
    QtGui.QMessageBox.warning(Gui.getMainWindow(), "Footpoint", text)


def selected(kinds):
    """The selected object, its face or edge ("" for the whole), the picked point, and the point of a selected vertex."""
    target = query = picked = None
    for one in Gui.Selection.getSelectionEx("", 0):
        names = one.SubElementNames or [""]
        for number, name in enumerate(names):
            short = name.split(".")[-1]
            if not hasattr(one.Object, "Shape"):
                continue
            if short.startswith("Vertex"):
                query = one.Object.Shape.getElement(short).Point
            elif target is None and (any(short.startswith(kind) for kind in kinds if kind) or (not short and "" in kinds)):
                target = (one.Object, short)
                picked = one.PickedPoints[number] if number < len(one.PickedPoints) else None
    return target, query if query is not None else picked


def ask_point(start):
    """A point that is typed, or None."""
    dialog = QtGui.QDialog(Gui.getMainWindow())
    dialog.setObjectName("FootpointPoint")
    dialog.setWindowTitle(translate(CONTEXT, "Point"))
    form = QtGui.QFormLayout(dialog)
    boxes = []
    for name, value in zip("xyz", start or (0, 0, 0)):
        box = QtGui.QDoubleSpinBox()
        box.setDecimals(9)
        box.setRange(-1e9, 1e9)
        box.setValue(value)
        box.setSuffix(" mm")
        form.addRow(name, box)
        boxes.append(box)
    buttons = QtGui.QDialogButtonBox(QtGui.QDialogButtonBox.Ok | QtGui.QDialogButtonBox.Cancel)
    buttons.accepted.connect(dialog.accept)
    buttons.rejected.connect(dialog.reject)
    form.addRow(buttons)
    return FreeCAD.Vector(*(box.value() for box in boxes)) if dialog.exec_() else None


def ask_distances(curve):
    """A wished distance for each pole of a curve, negative: none; None when the dialog was cancelled."""
    dialog = QtGui.QDialog(Gui.getMainWindow())
    dialog.setObjectName("FootpointDistances")
    dialog.setWindowTitle(translate(CONTEXT, "Distances of the curve from its poles"))
    dialog.resize(560, 340)
    table = QtGui.QTableWidget(curve.pole_count, 3, dialog)
    table.setHorizontalHeaderLabels([translate(CONTEXT, "Pole"), translate(CONTEXT, "Now"), translate(CONTEXT, "Wish")])
    table.horizontalHeader().setSectionResizeMode(QtGui.QHeaderView.Stretch)
    table.setEditTriggers(QtGui.QAbstractItemView.NoEditTriggers)
    boxes = []
    for row, (pole, now) in enumerate(zip(curve.poles.tolist(), curve.closest(curve.poles).distance.tolist())):
        table.setItem(row, 0, QtGui.QTableWidgetItem(", ".join(f"{value:.6g}" for value in pole)))
        table.setItem(row, 1, QtGui.QTableWidgetItem(f"{now:.6g} mm"))
        box = QtGui.QDoubleSpinBox()
        box.setDecimals(9)
        box.setRange(-1, 1e9)
        box.setSpecialValueText(translate(CONTEXT, "none"))
        box.setValue(-1)
        box.setSuffix(" mm")
        table.setCellWidget(row, 2, box)
        boxes.append(box)
    buttons = QtGui.QDialogButtonBox(QtGui.QDialogButtonBox.Ok | QtGui.QDialogButtonBox.Cancel)
    buttons.accepted.connect(dialog.accept)
    buttons.rejected.connect(dialog.reject)
    layout = QtGui.QVBoxLayout(dialog)
    layout.addWidget(table)
    layout.addWidget(buttons)
    return [box.value() for box in boxes] if dialog.exec_() else None


class _Command:
    """What the commands have in common."""

    icon = menu = tip = ""
    kinds = ()
    wanted = ""

    def GetResources(self):
        return {"Pixmap": resource("icons", self.icon), "MenuText": translate(CONTEXT, self.menu), "ToolTip": translate(CONTEXT, self.tip)}

    def IsActive(self):
        return FreeCAD.ActiveDocument is not None

    def Activated(self):
        target, point = selected(self.kinds)
        if target is None:
            say(translate(CONTEXT, self.wanted))
            return
        self.guarded(lambda: self.run(target, point))

    @staticmethod
    def guarded(work):
        """Errors are told, and what was begun is undone."""
        try:
            work()
        except (ImportError, ValueError, TypeError, NotImplementedError, RuntimeError, OSError) as error:
            if FreeCAD.ActiveDocument is not None:
                FreeCAD.ActiveDocument.abortTransaction()
            say(str(error))

    def result(self, kind, name, target, query=None, **values):
        """Adds a result in one step that can be undone."""
        document = target[0].Document
        document.openTransaction(name)
        made = objects.make(kind, name, *target, query=query, **values)
        document.commitTransaction()
        return made


class Invert(_Command):
    """Parameters of a point."""

    icon = "Footpoint_Invert.svg"
    menu = QT_TRANSLATE_NOOP("Footpoint", "Invert point")
    tip = QT_TRANSLATE_NOOP("Footpoint", "Parameters of a point on the selected face or edge, and all its preimages")
    kinds = ("Face", "Edge")
    wanted = QT_TRANSLATE_NOOP("Footpoint", "Select a face or an edge, by a click at the point; or with it a vertex.")

    def run(self, target, point):
        point = point if point is not None else ask_point(None)
        if point is not None:
            self.result(objects.InvertResult, "Invert", target, point)


class Closest(_Command):
    """The nearest point."""

    icon = "Footpoint_Closest.svg"
    menu = QT_TRANSLATE_NOOP("Footpoint", "Closest point")
    tip = QT_TRANSLATE_NOOP("Footpoint", "Nearest point of the selected face, edge or part to a point, with the connecting line and its proof")
    kinds = ("Face", "Edge", "")
    wanted = QT_TRANSLATE_NOOP("Footpoint", "Select a face, an edge or a part, and a vertex or type a point.")

    def run(self, target, point):
        vertex = any(name.split(".")[-1].startswith("Vertex") for one in Gui.Selection.getSelectionEx("", 0) for name in one.SubElementNames)
        query = point if vertex else ask_point(tuple(point) if point is not None else None)
        if query is not None:
            self.result(objects.ClosestResult, "Closest", target, query)


class Check(_Command):
    """Seams and poles."""

    icon = "Footpoint_Check.svg"
    menu = QT_TRANSLATE_NOOP("Footpoint", "Check seams and poles")
    tip = QT_TRANSLATE_NOOP("Footpoint", "Closed directions and collapsed edges of the selected face, by geometry")
    kinds = ("Face",)
    wanted = QT_TRANSLATE_NOOP("Footpoint", "Select a face.")

    def run(self, target, point):
        found = self.result(objects.SeamsResult, "Seams", target)
        for line in found.Report:
            FreeCAD.Console.PrintMessage(f"Footpoint: {line}\n")


class Weights(_Command):
    """Weights from distances."""

    icon = "Footpoint_Weights.svg"
    menu = QT_TRANSLATE_NOOP("Footpoint", "Weights from distances")
    tip = QT_TRANSLATE_NOOP("Footpoint", "The rational curve over the poles of the selected spline or polygon that has wished distances from them")
    kinds = ("Edge", "")
    wanted = QT_TRANSLATE_NOOP("Footpoint", "Select a B-spline or Bezier edge, or a polygon.")

    def run(self, target, point):
        source, sub = target
        if weights.polygon_of(source.Shape) is not None:
            sub = ""  # a click selects one side of the polygon
        curve = weights.control(source.Shape.getElement(sub) if sub else source.Shape)
        distances = ask_distances(curve)
        if distances is None:
            return
        for line in self.result(objects.WeightsResult, "Weights", (source, sub), Distances=distances).Report:
            FreeCAD.Console.PrintMessage(f"Footpoint: {line}\n")


class FairCurve(_Command):
    """A fairer curve."""

    icon = "Footpoint_FairCurve.svg"
    menu = QT_TRANSLATE_NOOP("Footpoint", "Fair curve")
    tip = QT_TRANSLATE_NOOP("Footpoint", "A curve with less bending and fewer inflections beside the selected edge, within a deviation that is proven")
    kinds = ("Edge",)
    wanted = QT_TRANSLATE_NOOP("Footpoint", "Select an edge.")

    def run(self, target, point):
        shape = target[0].Shape.getElement(target[1]) if target[1] else target[0].Shape
        deviation = ask_deviation(shape.BoundBox.DiagonalLength)
        if deviation is not None:
            made = self.result(objects.FairResult, "Fair", target, Deviation=deviation)
            FreeCAD.Console.PrintMessage(f"Footpoint: {made.Label}\n")


class FairSurface(FairCurve):
    """A fairer surface."""

    icon = "Footpoint_FairSurface.svg"
    menu = QT_TRANSLATE_NOOP("Footpoint", "Fair surface")
    tip = QT_TRANSLATE_NOOP("Footpoint", "A surface with less bending beside that of the selected face, within a deviation that is proven; borders and tangents stay")
    kinds = ("Face",)
    wanted = QT_TRANSLATE_NOOP("Footpoint", "Select a face.")


class Inspect(_Command):
    """Curvature."""

    icon = "Footpoint_Inspect.svg"
    menu = QT_TRANSLATE_NOOP("Footpoint", "Inspect")
    tip = QT_TRANSLATE_NOOP("Footpoint", "Least radius of curvature with a proof; comb and inflections of an edge; zebra, isophotes and colours of curvature of a face")
    kinds = ("Edge", "Face")
    wanted = QT_TRANSLATE_NOOP("Footpoint", "Select an edge or a face.")

    def run(self, target, point):
        found = self.result(objects.InspectResult, "Inspect", target)
        for line in found.Report:
            FreeCAD.Console.PrintMessage(f"Footpoint: {line}\n")
        shape = target[0].Shape.getElement(target[1]) if target[1] else target[0].Shape
        if shape.Faces:
            Reflections.show_for(shape, found.Label)


class Intersect(_Command):
    """Curves of two faces."""

    icon = "Footpoint_Intersect.svg"
    menu = QT_TRANSLATE_NOOP("Footpoint", "Intersect faces")
    tip = QT_TRANSLATE_NOOP("Footpoint", "All curves and points that two selected faces have in common, with a proof that none is missing")
    wanted = QT_TRANSLATE_NOOP("Footpoint", "Select two faces.")

    def Activated(self):
        faces = [(one.Object, name.split(".")[-1]) for one in Gui.Selection.getSelectionEx("", 0) for name in one.SubElementNames]
        faces = [(obj, name) for obj, name in faces if name.startswith("Face") and hasattr(obj, "Shape")]
        if len(faces) != 2:
            say(translate(CONTEXT, self.wanted))
            return
        self.guarded(lambda: self.run(*faces))

    def run(self, first, second):
        found = self.result(objects.IntersectResult, "Intersection", first, Second=(second[0], [second[1]]))
        for line in found.Report:
            FreeCAD.Console.PrintMessage(f"Footpoint: {line}\n")


def ask_deviation(size):
    """A length that is typed, beginning with a thousandth of the size; None when the dialog was cancelled."""
    dialog = QtGui.QDialog(Gui.getMainWindow())
    dialog.setObjectName("FootpointFairing")
    dialog.setWindowTitle(translate(CONTEXT, "Fairing"))
    form = QtGui.QFormLayout(dialog)
    box = QtGui.QDoubleSpinBox()
    box.setDecimals(9)
    box.setRange(1e-9, 1e9)
    box.setValue(1e-3 * size)
    box.setSuffix(" mm")
    form.addRow(translate(CONTEXT, "Greatest deviation"), box)
    buttons = QtGui.QDialogButtonBox(QtGui.QDialogButtonBox.Ok | QtGui.QDialogButtonBox.Cancel)
    buttons.accepted.connect(dialog.accept)
    buttons.rejected.connect(dialog.reject)
    form.addRow(buttons)
    return box.value() if dialog.exec_() else None


class Reflections(QtGui.QDockWidget):
    """Pictures of a face: the pattern is chosen, the view is that of the window."""

    def __init__(self, shape, title):
        super().__init__(title, Gui.getMainWindow())
        self.setObjectName("FootpointReflections")
        self.shape = shape
        inner = QtGui.QWidget()
        layout = QtGui.QVBoxLayout(inner)
        self.box = QtGui.QComboBox()
        self.box.addItems(["Shaded", "Zebra", "Isophotes", "Reflection lines", "Highlight lines", "Greater curvature", "Less curvature",
                           "Mean curvature", "Gaussian curvature"])
        self.label = QtGui.QLabel()
        self.box.setCurrentIndex(1)
        self.box.currentIndexChanged.connect(lambda _=0: self.draw())
        layout.addWidget(self.box)
        layout.addWidget(self.label, 1)
        self.setWidget(inner)
        self.draw()

    def draw(self):
        """Makes the picture that is chosen."""
        options = {}
        view = getattr(Gui.ActiveDocument, "ActiveView", None)
        if hasattr(view, "getViewDirection"):
            turned = view.getCameraOrientation()
            options = {"eye": tuple(-view.getViewDirection()), "up": tuple(turned.multVec(FreeCAD.Vector(0, 1, 0)))}
        made = fairing.picture(self.shape, self.box.currentIndex(), (480, 360), **options)
        picture = QtGui.QPixmap()
        picture.loadFromData(made.png(), "PNG")
        self.label.setPixmap(picture)

    @staticmethod
    def show_for(shape, title):
        """Shows the pictures of a face, in place of those before."""
        window = Gui.getMainWindow()
        for old in window.findChildren(QtGui.QDockWidget, "FootpointReflections"):
            window.removeDockWidget(old)
            old.deleteLater()
        dock = Reflections(shape, title)
        window.addDockWidget(QtCore.Qt.RightDockWidgetArea, dock)
        return dock


class Deviation(_Command):
    """Deviation map."""

    icon = "Footpoint_Deviation.svg"
    menu = QT_TRANSLATE_NOOP("Footpoint", "Deviation map")
    tip = QT_TRANSLATE_NOOP("Footpoint", "Signed distances of a point cloud, a mesh or a file from the selected face or part, as coloured points")
    kinds = ("Face", "")
    wanted = QT_TRANSLATE_NOOP("Footpoint", "Select a face or a part, and with it a point cloud or a mesh; without one you are asked for a file.")

    def run(self, target, point):
        clouds = [one.Object for one in Gui.Selection.getSelectionEx("", 0) if hasattr(one.Object, "Points") or hasattr(one.Object, "Mesh")]
        source = clouds[0] if clouds else QtGui.QFileDialog.getOpenFileName(
            Gui.getMainWindow(), translate(CONTEXT, "Points"), "", "*.csv *.xyz *.asc *.txt *.npy *.ply *.stl")[0]
        if not source:
            return
        shape = target[0].Shape.getElement(target[1]) if target[1] else target[0].Shape
        found = with_dialog(shape, measure.points_of(source))
        if found is None:
            return
        target[0].Document.openTransaction("Deviation")
        made = objects.make_deviation(*target, found, getattr(source, "Points", None))
        target[0].Document.commitTransaction()
        Legend.show_for(found, made.Label)


def with_dialog(shape, points):
    """The deviation under a progress dialog; None when it was cancelled."""
    from footpoint import Cancelled

    dialog = QtGui.QProgressDialog(translate(CONTEXT, "Nearest points"), translate(CONTEXT, "Cancel"), 0, max(len(points), 1), Gui.getMainWindow())
    dialog.setObjectName("FootpointProgress")
    dialog.setWindowModality(QtCore.Qt.WindowModal)
    dialog.setMinimumDuration(300)

    def progress(done, total):
        dialog.setValue(min(done, dialog.maximum() - 1))
        QtGui.QApplication.processEvents()

    try:
        return measure.deviation(shape, points, progress, dialog.wasCanceled)
    except Cancelled:
        return None
    finally:
        dialog.close()


class Bar(QtGui.QWidget):
    """The colours with their numbers."""

    def __init__(self, limit):
        super().__init__()
        self.limit = limit
        self.setMinimumSize(150, 230)

    def paintEvent(self, event):
        painter = QtGui.QPainter(self)
        top, height = 12, self.height() - 24
        for row in range(height):
            painter.setPen(QtGui.QColor.fromRgbF(*(float(part) for part in measure.colours(1 - 2 * row / max(height - 1, 1)))))
            painter.drawLine(10, top + row, 34, top + row)
        painter.setPen(self.palette().color(QtGui.QPalette.WindowText))
        for part in (1, 0.5, 0, -0.5, -1):
            painter.drawText(42, int(top + (1 - part) / 2 * height) + 4, f"{part * self.limit:+.4g} mm")
        painter.end()


class Legend(QtGui.QDockWidget):
    """Colour bar, statistics, export of a deviation map."""

    def __init__(self, found, title):
        super().__init__(translate(CONTEXT, "Deviation map"), Gui.getMainWindow())
        self.setObjectName("FootpointLegend")
        self.found = found
        inner = QtGui.QWidget()
        layout = QtGui.QVBoxLayout(inner)
        layout.addWidget(Bar(found.limit()), 1)
        numbers = {"time": f"{found.seconds:.2f} s", **found.statistics()}
        text = "\n".join(f"{name}: {value if isinstance(value, str) else format(value, ',d' if isinstance(value, int) else '.4g')}" for name, value in numbers.items())
        label = QtGui.QLabel(text)
        label.setTextInteractionFlags(QtCore.Qt.TextSelectableByMouse)
        layout.addWidget(label)
        for name, function in ((QT_TRANSLATE_NOOP("Footpoint", "Save as CSV"), self.save_csv), (QT_TRANSLATE_NOOP("Footpoint", "Save picture"), self.save_picture)):
            button = QtGui.QPushButton(translate(CONTEXT, name))
            button.clicked.connect(lambda _=False, function=function: function())
            layout.addWidget(button)
        self.setWidget(inner)

    @staticmethod
    def show_for(found, title):
        """Shows the legend of a map, in place of the one before."""
        window = Gui.getMainWindow()
        for old in window.findChildren(QtGui.QDockWidget, "FootpointLegend"):
            window.removeDockWidget(old)
            old.deleteLater()
        legend = Legend(found, title)
        window.addDockWidget(QtCore.Qt.RightDockWidgetArea, legend)
        return legend

    def save_csv(self, path=""):
        """Asks for a file when none is given."""
        path = path or QtGui.QFileDialog.getSaveFileName(self, "CSV", "deviation.csv", "*.csv")[0]
        if path:
            self.found.save_csv(path)

    def save_picture(self, path=""):
        """The view with the colour bar beside it."""
        path = path or QtGui.QFileDialog.getSaveFileName(self, "PNG", "deviation.png", "*.png")[0]
        if not path:
            return
        view = Gui.ActiveDocument.ActiveView
        view.saveImage(path, 1400, 1000, "White")
        picture = QtGui.QPixmap(path)
        side = self.widget().grab()
        both = QtGui.QPixmap(picture.width() + side.width(), max(picture.height(), side.height()))
        both.fill(QtGui.QColor("white"))
        painter = QtGui.QPainter(both)
        painter.drawPixmap(0, 0, picture)
        painter.drawPixmap(picture.width(), 0, side)
        painter.end()
        both.save(path)


COMMANDS = {"Footpoint_Invert": Invert, "Footpoint_Closest": Closest, "Footpoint_Deviation": Deviation, "Footpoint_Check": Check,
            "Footpoint_Weights": Weights, "Footpoint_FairCurve": FairCurve, "Footpoint_FairSurface": FairSurface, "Footpoint_Inspect": Inspect,
            "Footpoint_Intersect": Intersect}


def register():
    """Tells FreeCAD the commands; returns their names."""
    for name, kind in COMMANDS.items():
        Gui.addCommand(name, kind())
    return list(COMMANDS)
