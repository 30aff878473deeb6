"""footpoint: from a point back to the parameters of a NURBS curve or surface, with a proof.

Lengths, tolerances and distances are in the unit of the poles, parameters in the unit of the knots. Arrays come in and go out as
numpy arrays. Wrong use raises ValueError or TypeError with the library's text, what the library cannot do NotImplementedError; a
weak answer is no error but a record whose flags say so.

Every call releases the GIL and uses all cores unless `threads` says otherwise; Ctrl-C ends a query.
"""

from . import construct, convert, draw, fair, inspect, intersect, operate, pcurve, trims, weights
from ._face import Face, Standing, StandingFlag
from ._feet import Feet, Flag, FootSet, Kind, Method, Nature, NormalFlag, PathChange, Scope
from ._library import Cancelled, abi_version, version
from ._scene import NO_MEMBER, Scene
from ._shapes import Curve, Surface
from .convert import from_freecad, from_geomdl, from_occ, from_splinepy
from .intersection import (BranchEnd, ContactKind, Corrector, IntersectMethod, Intersection, intersect_bisect, intersect_correct, intersect_march,
                           intersect_surfaces, intersect_trims)

__version__ = version()
__all__ = ["BranchEnd", "Cancelled", "ContactKind", "Corrector", "Curve", "Face", "Feet", "Flag", "FootSet", "IntersectMethod", "Intersection", "Kind",
           "Method", "NO_MEMBER", "Nature", "NormalFlag", "PathChange", "Scene", "Scope", "Standing", "StandingFlag", "Surface",
           "abi_version", "construct", "convert", "draw", "fair", "from_freecad", "from_geomdl", "from_occ", "from_splinepy",
           "inspect", "intersect", "intersect_bisect", "intersect_correct", "intersect_march", "intersect_surfaces", "intersect_trims", "operate", "pcurve", "trims", "version", "weights"]
