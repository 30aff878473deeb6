"""Results as document objects: they know their source, are computed again when it changes, and are saved with the document."""

import FreeCAD
import Part

from . import fairing, intersections, measure, weights

GROUP = "Footpoint"


class _Result:
    """What the results have in common: a link to the face or edge, and how to compute."""

    def __init__(self, obj, source, sub):
        obj.addProperty("App::PropertyLinkSub", "Source", "Footpoint", "The face, edge or part")
        obj.Source = (source, [sub] if sub else [])
        self.properties(obj)
        obj.Proxy = self

    def shape(self, obj):
        """The selected face or edge, or the whole shape."""
        source, subs = obj.Source
        return source.Shape.getElement(subs[0]) if subs and subs[0] else source.Shape

    def dumps(self):
        return None

    def loads(self, state):
        return None

    __getstate__, __setstate__ = dumps, loads


def _add(obj, kind, name, text):
    obj.addProperty(f"App::Property{kind}", name, "Footpoint", text)
    obj.setEditorMode(name, 1)


def _proof(obj):
    _add(obj, "Float", "Distance", "From the query to the nearest point, in mm")
    _add(obj, "Float", "LowerBound", "Proven: nothing is nearer than this, in mm")
    _add(obj, "Bool", "Proven", "Whether the distance is proven to be the least")


class InvertResult(_Result):
    """Parameters of a point on a face or edge, and all preimages."""

    def properties(self, obj):
        obj.addProperty("App::PropertyVector", "Query", "Footpoint", "The point, in mm")
        _proof(obj)
        _add(obj, "FloatList", "Parameters", "u, v on a surface, u on a curve")
        _add(obj, "Bool", "OnShape", "Whether the point is on the shape within the tolerance")
        _add(obj, "VectorList", "Preimages", "All parameters of the point: u, v, 0")
        _add(obj, "Bool", "Complete", "Whether no preimage can be missing")

    def execute(self, obj):
        found = measure.invert(self.shape(obj), obj.Query)
        obj.Distance, obj.LowerBound, obj.Proven = found.distance, found.lower_bound, found.proven
        obj.Parameters, obj.OnShape, obj.Complete = found.parameters, found.on_shape, found.complete
        obj.Preimages = [FreeCAD.Vector(*(list(value) + [0.0] * (3 - len(value)))) for value in found.preimages]
        obj.Shape = Part.Vertex(FreeCAD.Vector(*found.point))
        numbers = ", ".join(f"{name} = {value:.9g}" for name, value in zip("uv", found.parameters))
        obj.Label = f"Invert: {numbers}; {len(found.preimages)} preimage{'s' if len(found.preimages) != 1 else ''}"


class ClosestResult(_Result):
    """The nearest point of a face, edge or part, with the connecting line."""

    def properties(self, obj):
        obj.addProperty("App::PropertyVector", "Query", "Footpoint", "The point, in mm")
        _proof(obj)
        _add(obj, "Vector", "Foot", "The nearest point, in mm")

    def execute(self, obj):
        found = measure.closest(self.shape(obj), obj.Query)
        obj.Distance, obj.LowerBound, obj.Proven = float(found.distance[0]), float(found.lower_bound[0]), bool(found.proven[0])
        obj.Foot = FreeCAD.Vector(*found.point[0].tolist())
        apart = (obj.Foot - obj.Query).Length > 1e-9
        obj.Shape = Part.makeLine(obj.Query, obj.Foot) if apart else Part.Vertex(obj.Foot)
        obj.Label = f"Closest: {obj.Distance:.9g} mm, {'proven' if obj.Proven else 'not proven'}"


class SeamsResult(_Result):
    """Seams and poles of the surface of a face."""

    def properties(self, obj):
        _add(obj, "Bool", "ClosedU", "Whether the surface closes in u")
        _add(obj, "Bool", "ClosedV", "Whether the surface closes in v")
        _add(obj, "StringList", "Collapsed", "Edges that are one point")
        _add(obj, "StringList", "Report", "What was found")

    def execute(self, obj):
        found = measure.seams_and_poles(self.shape(obj))
        obj.ClosedU, obj.ClosedV, obj.Collapsed, obj.Report = found.closed_u, found.closed_v, found.collapsed, found.text
        pieces = [Part.makePolygon([FreeCAD.Vector(*point) for point in seam.tolist()]) for seam in found.seams]
        pieces += [Part.Vertex(FreeCAD.Vector(*pole)) for pole in found.poles]
        obj.Shape = Part.makeCompound(pieces)
        obj.Label = f"Seams: {len(found.seams)}, poles: {len(found.poles)}"


class WeightsResult(_Result):
    """The rational curve over the poles of a spline edge or a polygon that has the wished distances from them."""

    def properties(self, obj):
        for kind, name, text in (
                ("FloatList", "Distances", "Wished distance of the curve from each pole, in mm; negative: no wish"),
                ("Integer", "Degree", "Degree over a polygon; 0: 3 or the number of its vertices less one"),
                ("Float", "WeightMin", "Least weight; 0: 0.01"), ("Float", "WeightMax", "Greatest weight; 0: 100"),
                ("Bool", "Symmetric", "Whether weights of opposite poles are equal"),
                ("Integer", "Starts", "Most searches: what cannot be met takes as many")):
            obj.addProperty(f"App::Property{kind}", name, "Footpoint", text)
        obj.Starts = 200
        _add(obj, "FloatList", "Weights", "The weights found")
        _add(obj, "FloatList", "Achieved", "Distance of the curve from each pole, in mm")
        _add(obj, "FloatList", "LowerBounds", "Proven: nothing of the curve is nearer to the pole than this, in mm")
        _add(obj, "Bool", "Met", "Whether every wish is met, with proof")
        _add(obj, "StringList", "Report", "What came of each wish")

    def execute(self, obj):
        curve = weights.control(self.shape(obj), obj.Degree)
        found = weights.refine(curve, obj.Distances or [-1.0] * curve.pole_count, weight_min=obj.WeightMin, weight_max=obj.WeightMax,
                               symmetric=obj.Symmetric, starts=obj.Starts)
        obj.Distances = obj.Distances or [-1.0] * curve.pole_count
        obj.Weights, obj.Achieved, obj.LowerBounds = (found.poles[name].tolist() for name in ("weight", "distance", "lower_bound"))
        obj.Met, obj.Report = found.is_met, weights.lines(found)
        obj.Shape = weights.to_freecad(found.shape).toShape()
        obj.Label = f"Weights: {found.met} of {found.met + found.not_met + found.impossible} wishes met"


class FairResult(_Result):
    """A fairer curve or surface, no point of which is farther than the deviation from where it was."""

    def properties(self, obj):
        for kind, name, text in (("Float", "Deviation", "How far a point may move, in mm"),
                                 ("Float", "Jerk", "Weight of third derivatives beside the strain"),
                                 ("Integer", "Keep", "At ends and borders: 0 nothing, 1 points, 2 tangents, 3 curvatures too")):
            obj.addProperty(f"App::Property{kind}", name, "Footpoint", text)
        obj.Keep = 2
        _add(obj, "Float", "Proven", "No point has moved farther than this, in mm, proven")
        _add(obj, "FloatList", "Energies", "The energy before the first step and after each")

    def execute(self, obj):
        found = fairing.faired(self.shape(obj), obj.Deviation, obj.Jerk, obj.Keep)
        obj.Proven, obj.Energies = found.deviation, found.energies.tolist()
        obj.Shape = fairing.to_freecad(found.shape).toShape()
        before, after = found.energies[0], found.energies[-1]
        obj.Label = f"Faired: energy {before:.4g} to {after:.4g}, moved at most {found.deviation:.4g} mm"


class InspectResult(_Result):
    """How an edge or a face bends: ranges that are proven, a comb or marks."""

    def properties(self, obj):
        _add(obj, "StringList", "Report", "What was found")

    def execute(self, obj):
        obj.Report, obj.Shape = fairing.inspected(self.shape(obj))
        obj.Label = f"Inspect: {obj.Report[0]}"


class IntersectResult(_Result):
    """The curves and points that two faces have in common."""

    def properties(self, obj):
        obj.addProperty("App::PropertyLinkSub", "Second", "Footpoint", "The other face")
        obj.addProperty("App::PropertyFloat", "Tolerance", "Footpoint", "How far a curve may be from the intersection, in mm; 0: 1e-6 of the size")
        for kind, name, text in (("Integer", "Curves", "Number of curves"), ("Integer", "Points", "Number of single points"),
                                 ("Float", "Error", "Greatest distance of a curve from the intersection, as measured, in mm"),
                                 ("Bool", "Proven", "Whether no branch can be missing"), ("StringList", "Report", "What was found")):
            _add(obj, kind, name, text)

    def execute(self, obj):
        source, subs = obj.Second
        found = intersections.of_faces(self.shape(obj), source.Shape.getElement(subs[0]), obj.Tolerance)
        obj.Curves, obj.Points, obj.Error, obj.Proven, obj.Report = found.curves, found.points, found.error, found.proven, found.text
        obj.Shape = Part.makeCompound(found.shapes)
        obj.Label = f"Intersection: {found.text[0]}"


def group(document):
    """The folder of the results in the tree."""
    found = document.getObject(GROUP)
    return found if found is not None else document.addObject("App::DocumentObjectGroup", GROUP)


def make(kind, name, source, sub="", query=None, **values):
    """Adds a result for a face or edge ("Face1") of an object, computed; `values` are properties to set before that."""
    document = source.Document
    obj = document.addObject("Part::FeaturePython", name)
    kind(obj, source, sub)
    if query is not None:
        obj.Query = FreeCAD.Vector(*query)
    for key, value in values.items():
        setattr(obj, key, value)
    if FreeCAD.GuiUp:
        from . import views

        views.show(obj)
    try:
        kind.execute(obj.Proxy, obj)
    except Exception:
        document.removeObject(obj.Name)
        raise
    obj.purgeTouched()
    group(document).addObject(obj)
    return obj


def make_deviation(source, sub, found, cloud=None):
    """Adds a deviation map: coloured points, statistics. `cloud` has the same points for FreeCAD; None: it is made."""
    import Points

    document = source.Document
    if cloud is None:
        cloud = Points.Points()
        cloud.addPoints([FreeCAD.Vector(*row) for row in found.points.tolist()])
    obj = document.addObject("Points::FeatureCustom", "Deviation")
    obj.Points = cloud
    obj.addProperty("App::PropertyColorList", "Color", "Footpoint", "Colours of the points")
    obj.Color = [tuple(row) for row in found.colours().tolist()]
    obj.addProperty("App::PropertyLinkSub", "Source", "Footpoint", "The face or part")
    obj.Source = (source, [sub] if sub else [])
    texts = {"count": "Points", "proven": "Points whose distance is proven", "least": "Least deviation, mm", "greatest": "Greatest deviation, mm",
             "mean": "Mean deviation, mm", "rms": "Root of the mean square, mm", "p95": "95 % of the magnitudes are below, mm"}
    for name, value in found.statistics().items():
        _add(obj, "Integer" if isinstance(value, int) else "Float", name.capitalize(), texts[name])
        setattr(obj, name.capitalize(), value)
    obj.Label = f"Deviation: {len(found.points)} points, rms {found.statistics().get('rms', 0):.4g} mm"
    group(document).addObject(obj)
    if FreeCAD.GuiUp:
        obj.ViewObject.DisplayMode = "Color"
        obj.ViewObject.PointSize = 2
    return obj
