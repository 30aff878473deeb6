"""The calls that the bench compares: driver, name in the driver, label, and how pictures show them."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Call:
    driver: str
    name: str
    label: str
    short: str
    kinds: str  # "surface", "curve" or both
    hint: float = 0.0
    gives_place: bool = True

    @property
    def key(self):
        return self.name + (f"_{self.hint:g}" if self.hint else "")


BOTH = "surface curve"
NEAR, WALK = 0.01, 0.001

CALLS = [
    Call("occt", "occt_value", "OCCT ShapeAnalysis_Surface::ValueOfUV", "OCCT ValueOfUV", "surface"),
    Call("occt", "occt_project", "OCCT GeomAPI_ProjectPointOnSurf (Tree, reused) / OnCurve", "OCCT GeomAPI", BOTH),
    Call("occt", "occt_edges", "OCCT Tree, reused, and the four boundary curves", "OCCT Tree + edges", "surface"),
    Call("occt", "occt_extpc", "OCCT Extrema_ExtPC and both ends", "OCCT ExtPC + ends", "curve"),
    Call("sisl", "sisl", "SISL s1954 / s1953", "SISL global", BOTH),
    Call("cgal", "mesh", "CGAL AABB tree on a mesh at 1e-3", "mesh lookup", BOTH, gives_place=False),
    Call("cgal", "mesh_newton", "CGAL AABB tree on a mesh at 1e-3, then Newton", "mesh + Newton", BOTH),
    Call("occt", "occt_next", "OCCT NextValueOfUV", "OCCT NextValueOfUV", "surface", NEAR),
    Call("occt", "occt_next", "OCCT NextValueOfUV", "OCCT NextValueOfUV", "surface", WALK),
    Call("sisl", "sisl_hint", "SISL s1775 / s1774", "SISL with hint", BOTH, NEAR),
    Call("sisl", "sisl_hint", "SISL s1775 / s1774", "SISL with hint", BOTH, WALK),
]

# What has to be there for a driver to be built, for the list of what was left out.
PACKAGES = {"occt": "libocct-modeling-algorithms-dev", "sisl": "libsisl-dev", "cgal": "libcgal-dev"}

# Groups of cases: a title and the beginning of their names.
GROUPS = [
    ("real surfaces (from public CAD files)", "real_s"),
    ("real curves (from public CAD files)", "real_c"),
    ("synthetic surfaces", "syn_s"),
    ("synthetic curves", "syn_c"),
]
CLASSES = ["on", "near", "off", "far", "edge", "seam", "pole", "sing", "medial"]
