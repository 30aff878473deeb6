"""How results look."""

from .settings import resource

ICONS = {"InvertResult": "Footpoint_Invert.svg", "ClosestResult": "Footpoint_Closest.svg", "SeamsResult": "Footpoint_Check.svg",
         "WeightsResult": "Footpoint_Weights.svg",
         "IntersectResult": "Footpoint_Intersect.svg"}


class ViewProvider:
    """Icon of a result; all else is that of Part."""

    def __init__(self, view):
        view.Proxy = self

    def attach(self, view):
        self.object = view.Object

    def getIcon(self):
        return resource("icons", ICONS.get(type(self.object.Proxy).__name__, "Footpoint.svg"))

    def dumps(self):
        return None

    def loads(self, state):
        return None

    __getstate__, __setstate__ = dumps, loads


def show(obj):
    """Red, thick, with its icon."""
    ViewProvider(obj.ViewObject)
    obj.ViewObject.LineColor = obj.ViewObject.PointColor = (0.75, 0.19, 0.16)
    obj.ViewObject.LineWidth, obj.ViewObject.PointSize = 3, 8
