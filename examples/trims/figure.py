"""Faces on a sphere by angles, and the same faces as NURBS: writes trims.svg, the picture of README. Needs the package `footpoint`."""

import math

import numpy as np
from footpoint import Curve, trims

TURN = 2 * math.pi
SPHERE = trims.Support.elementary("sphere", [0, TURN, -TURN / 4, TURN / 4], first=20)
Coedge = trims.Coedge


def belt():
    """A full belt with two round holes and a triangular one."""
    outer = trims.Loop([Coedge.isoline("v", -0.8, 0, TURN), Coedge.isoline("u", TURN, -0.8, 0.9), Coedge.isoline("v", 0.9, TURN, 0),
                        Coedge.isoline("u", 0, 0.9, -0.8)])
    holes = [trims.Loop([Coedge.arc([u, 0.1], [0.55, 0.1], [0.1, -0.45], 0, TURN)], True) for u in (1.0, 2.6)]
    triangle = trims.Loop([Coedge.polyline([[4, -0.4], [4.4, 0.5], [5.2, -0.1], [4, -0.4]])], True)
    return trims.TrimmedSurface(SPHERE, [outer, *holes, triangle])


def cap():
    """A cap around a pole with a wavy rim: the top of the domain is one point."""
    rim = [[u, 0.4 + (0.35 if k % 2 == 0 else -0.2) * (0 < k < 11)] for k, u in enumerate(np.linspace(0, TURN, 12))]
    outer = trims.Loop([Coedge.spline(Curve.from_poles(3, rim)), Coedge.isoline("u", TURN, 0.4, TURN / 4),
                        Coedge.isoline("v", TURN / 4, TURN, 0), Coedge.isoline("u", 0, TURN / 4, 0.4)])
    return trims.TrimmedSurface(SPHERE, [outer])


faces, titles = [], []
for name, face in (("belt with holes", belt()), ("cap around a pole", cap())):
    nurbs = face.to_nurbs((0, 2), tolerance=1e-3, replacement=trims.Replacement.SPLINE)
    print(f"{name}: {len(face.report().findings)} defects; as NURBS off by at most {nurbs.deviation:.1e}, proven: {nurbs.proven}")
    faces += [face, nurbs.face]
    titles += [f"{name}: angles", f"{name}: NURBS"]
with open("trims.svg", "w", encoding="utf-8") as file:
    file.write(trims.picture(faces, titles, [-1, 0.55, -0.5]))
