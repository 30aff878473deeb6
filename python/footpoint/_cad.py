"""What `convert` asks of a CAD program: the same questions to FreeCAD and to OpenCASCADE."""

from __future__ import annotations

import sys
from typing import Any

import numpy as np


class FreeCad:
    """FreeCAD's Part."""

    KINDS = {
        "Line": "line", "LineSegment": "line", "Circle": "circle", "ArcOfCircle": "circle", "Ellipse": "ellipse", "ArcOfEllipse": "ellipse",
        "BSplineCurve": "bspline curve", "BezierCurve": "bezier curve", "OffsetCurve": "offset curve", "Parabola": "other curve",
        "ArcOfParabola": "other curve", "Hyperbola": "other curve", "ArcOfHyperbola": "other curve", "Plane": "plane",
        "Cylinder": "cylinder", "Cone": "cone", "Sphere": "sphere", "Toroid": "torus", "BSplineSurface": "bspline surface",
        "BezierSurface": "bezier surface", "SurfaceOfRevolution": "revolution", "SurfaceOfExtrusion": "extrusion",
        "OffsetSurface": "offset surface", "PlateSurface": "other surface",
    }

    def geometry(self, shape: Any) -> tuple[Any, Any]:
        """The geometry of an edge or face with its bounds, or what it is."""
        name = type(shape).__name__
        if name == "Face":
            return shape.Surface, np.array(shape.ParameterRange)
        if name == "Edge":
            return shape.Curve, np.array(shape.ParameterRange)
        return shape, None

    def kind(self, geometry: Any) -> str:
        name = type(geometry).__name__
        if name == "RectangularTrimmedSurface":
            return "trimmed surface"
        return self.KINDS.get(name, name)

    def value(self, geometry: Any, *at: float) -> tuple[float, ...]:
        return tuple(geometry.value(*(float(t) for t in at)))

    def range(self, geometry: Any) -> tuple[float, ...]:
        if hasattr(geometry, "bounds"):
            return tuple(geometry.bounds())
        return geometry.FirstParameter, geometry.LastParameter

    def basis(self, geometry: Any) -> Any:
        return geometry.BasisSurface if hasattr(geometry, "BasisSurface") else geometry.BasisCurve

    def axis(self, geometry: Any) -> tuple[Any, Any]:
        return tuple(getattr(geometry, "Location", (0, 0, 0))), tuple(geometry.Direction)

    def spline_curve(self, curve: Any, kind: str) -> tuple:
        poles = np.array([tuple(pole) for pole in curve.getPoles()])
        weights = np.array(curve.getWeights())
        if kind == "bezier curve":
            return curve.Degree, [0, 1], [curve.Degree + 1] * 2, poles, weights, False
        return curve.Degree, curve.getKnots(), curve.getMultiplicities(), poles, weights, curve.isPeriodic()

    def spline_surface(self, surface: Any, kind: str) -> tuple:
        poles = np.array([[tuple(pole) for pole in row] for row in surface.getPoles()])
        weights = np.array(surface.getWeights())
        if kind == "bezier surface":
            both = [(degree, [0, 1], [degree + 1] * 2, False) for degree in (surface.UDegree, surface.VDegree)]
        else:
            both = [(surface.UDegree, surface.getUKnots(), surface.getUMultiplicities(), surface.isUPeriodic()),
                    (surface.VDegree, surface.getVKnots(), surface.getVMultiplicities(), surface.isVPeriodic())]
        return both, poles, weights


class Occ:
    """OpenCASCADE by cadquery-ocp (package OCP) or pythonocc (package OCC.Core); which one the object tells."""

    KINDS = {
        "Geom_Line": "line", "Geom_Circle": "circle", "Geom_Ellipse": "ellipse", "Geom_BSplineCurve": "bspline curve",
        "Geom_BezierCurve": "bezier curve", "Geom_TrimmedCurve": "trimmed curve", "Geom_OffsetCurve": "offset curve",
        "Geom_Parabola": "other curve", "Geom_Hyperbola": "other curve", "Geom_Plane": "plane", "Geom_CylindricalSurface": "cylinder",
        "Geom_ConicalSurface": "cone", "Geom_SphericalSurface": "sphere", "Geom_ToroidalSurface": "torus",
        "Geom_BSplineSurface": "bspline surface", "Geom_BezierSurface": "bezier surface", "Geom_SurfaceOfRevolution": "revolution",
        "Geom_SurfaceOfLinearExtrusion": "extrusion", "Geom_RectangularTrimmedSurface": "trimmed surface",
        "Geom_OffsetSurface": "offset surface",
    }

    def __init__(self, shape: Any):
        self.ocp = type(shape).__module__.startswith("OCP")
        if not self.ocp and not type(shape).__module__.startswith("OCC."):
            raise TypeError(f"shape: an object of OCP or OCC.Core is needed, not {type(shape).__name__} (cadquery: use .wrapped)")

    def _module(self, name: str) -> Any:
        full = f"{'OCP' if self.ocp else 'OCC.Core'}.{name}"
        __import__(full)
        return sys.modules[full]

    def _static(self, module: str, owner: str, name: str) -> Any:
        loaded = self._module(module)
        for place, called in ((getattr(loaded, owner, None), f"{name}_s"), (getattr(loaded, owner, None), name), (loaded, f"{owner}_{name}")):
            if hasattr(place, called):
                return getattr(place, called)
        raise NotImplementedError(f"{loaded.__name__} has no {owner}::{name}: this version is not known")

    def geometry(self, shape: Any) -> tuple[Any, Any]:
        if not hasattr(shape, "ShapeType"):
            return self._cast(shape), None
        def cast(name: str) -> Any:
            return self._static("TopoDS", "TopoDS" if self.ocp else "topods", name)

        kind = shape.ShapeType()
        types = self._module("TopAbs")
        enum = types.TopAbs_ShapeEnum
        if kind == enum.TopAbs_FACE:
            face = cast("Face")(shape)
            adaptor = self._module("BRepAdaptor").BRepAdaptor_Surface(face)
            bounds = (adaptor.FirstUParameter(), adaptor.LastUParameter(), adaptor.FirstVParameter(), adaptor.LastVParameter())
            return self._cast(self._static("BRep", "BRep_Tool", "Surface")(face)), np.array(bounds)
        if kind == enum.TopAbs_EDGE:
            edge = cast("Edge")(shape)
            adaptor = self._module("BRepAdaptor").BRepAdaptor_Curve(edge)
            curve = adaptor.Curve().Curve()
            if curve is None:
                raise ValueError("shape: this edge has no curve in space")
            placed = curve.Transformed(adaptor.Trsf())
            return self._cast(placed), np.array([adaptor.FirstParameter(), adaptor.LastParameter()])
        raise TypeError("shape: a curve, surface, edge or face is needed")

    def _cast(self, geometry: Any) -> Any:
        """The object as its own class: some calls return the base class."""
        name = geometry.DynamicType().Name() if hasattr(geometry, "DynamicType") else ""
        if name and name != type(geometry).__name__:
            kind = getattr(self._module("Geom"), name)
            return kind.DownCast(geometry) if hasattr(kind, "DownCast") else kind.DownCast_s(geometry)
        return geometry

    def kind(self, geometry: Any) -> str:
        name = type(geometry).__name__
        return self.KINDS.get(name, name)

    def value(self, geometry: Any, *at: float) -> tuple[float, ...]:
        point = geometry.Value(*(float(t) for t in at))
        return point.X(), point.Y(), point.Z()

    def range(self, geometry: Any) -> tuple[float, ...]:
        if not hasattr(geometry, "Bounds"):
            return geometry.FirstParameter(), geometry.LastParameter()
        return tuple(geometry.Bounds())

    def basis(self, geometry: Any) -> Any:
        return self._cast(geometry.BasisSurface() if hasattr(geometry, "BasisSurface") else geometry.BasisCurve())

    def axis(self, geometry: Any) -> tuple[Any, Any]:
        direction = geometry.Direction()
        location = geometry.Location() if hasattr(geometry, "Location") else None
        return (location.X(), location.Y(), location.Z()) if location is not None else (0, 0, 0), (direction.X(), direction.Y(), direction.Z())

    def spline_curve(self, curve: Any, kind: str) -> tuple:
        numbers = range(1, curve.NbPoles() + 1)
        poles = np.array([[point.X(), point.Y(), point.Z()] for point in map(curve.Pole, numbers)])
        weights = np.array([curve.Weight(i) for i in numbers])
        if kind == "bezier curve":
            return curve.Degree(), [0, 1], [curve.Degree() + 1] * 2, poles, weights, False
        knots = range(1, curve.NbKnots() + 1)
        return (curve.Degree(), [curve.Knot(i) for i in knots], [curve.Multiplicity(i) for i in knots], poles, weights, curve.IsPeriodic())

    def spline_surface(self, surface: Any, kind: str) -> tuple:
        rows, columns = range(1, surface.NbUPoles() + 1), range(1, surface.NbVPoles() + 1)
        poles = np.array([[[p.X(), p.Y(), p.Z()] for p in (surface.Pole(i, j) for j in columns)] for i in rows])
        weights = np.array([[surface.Weight(i, j) for j in columns] for i in rows])
        if kind == "bezier surface":
            return [(degree, [0, 1], [degree + 1] * 2, False) for degree in (surface.UDegree(), surface.VDegree())], poles, weights
        u, v = range(1, surface.NbUKnots() + 1), range(1, surface.NbVKnots() + 1)
        both = [(surface.UDegree(), [surface.UKnot(i) for i in u], [surface.UMultiplicity(i) for i in u], surface.IsUPeriodic()),
                (surface.VDegree(), [surface.VKnot(i) for i in v], [surface.VMultiplicity(i) for i in v], surface.IsVPeriodic())]
        return both, poles, weights
