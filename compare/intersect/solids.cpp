// SPDX-License-Identifier: MIT OR Apache-2.0
#include "solids.h"

#include <BRepAlgoAPI_Common.hxx>
#include <BRepAlgoAPI_Cut.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepFilletAPI_MakeFillet.hxx>
#include <BRepOffsetAPI_MakePipe.hxx>
#include <BRepOffsetAPI_ThruSections.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCone.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <BRepPrimAPI_MakeRevol.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepPrimAPI_MakeTorus.hxx>
#include <GC_MakeArcOfCircle.hxx>
#include <GeomAPI_PointsToBSpline.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_TrimmedCurve.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <gp_Circ.hxx>

#include <cmath>

namespace {

TopoDS_Edge line(const gp_Pnt &a, const gp_Pnt &b) { return BRepBuilderAPI_MakeEdge(a, b); }

Handle(Geom_BSplineCurve) through(const std::vector<gp_Pnt> &list) {
    TColgp_Array1OfPnt points(1, int(list.size()));
    for (std::size_t i = 0; i < list.size(); i++) points(int(i) + 1) = list[i];
    return GeomAPI_PointsToBSpline(points).Curve();
}

TopoDS_Wire ring(const gp_Pnt &at, const gp_Dir &normal, double radius) {
    return BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(gp_Circ(gp_Ax2(at, normal), radius)));
}

// Every edge rounded, or those that are parallel to z.
TopoDS_Shape rounded(const TopoDS_Shape &shape, double radius) {
    BRepFilletAPI_MakeFillet fillet(shape);
    for (TopExp_Explorer edges(shape, TopAbs_EDGE); edges.More(); edges.Next()) fillet.Add(radius, TopoDS::Edge(edges.Current()));
    return fillet.Shape();
}

// The bottle of OpenCASCADE's tutorial: lines and an arc, mirrored, drawn up, rounded, with a neck.
TopoDS_Shape bottle() {
    const double width = 50, height = 70, thickness = 30;
    const gp_Pnt a(-width / 2, 0, 0), b(-width / 2, -thickness / 4, 0), c(0, -thickness / 2, 0), d(width / 2, -thickness / 4, 0),
        e(width / 2, 0, 0);
    const TopoDS_Edge arc = BRepBuilderAPI_MakeEdge(GC_MakeArcOfCircle(b, c, d).Value());
    const gp_Pnt c2(0, thickness / 2, 0), b2(-width / 2, thickness / 4, 0), d2(width / 2, thickness / 4, 0);
    const TopoDS_Edge back = BRepBuilderAPI_MakeEdge(GC_MakeArcOfCircle(d2, c2, b2).Value());
    BRepBuilderAPI_MakeWire outline;
    outline.Add(line(a, b));
    outline.Add(arc);
    outline.Add(line(d, e));
    outline.Add(line(e, d2));
    outline.Add(back);
    outline.Add(line(b2, a));
    const TopoDS_Shape body = BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(outline.Wire()), gp_Vec(0, 0, height));
    const TopoDS_Shape neck = BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(0, 0, height), gp_Dir(0, 0, 1)), thickness / 4, height / 10);
    return BRepAlgoAPI_Fuse(rounded(body, thickness / 12), neck);
}

TopoDS_Shape vase() {
    const auto profile = through({{8, 0, 0}, {14, 0, 8}, {9, 0, 20}, {6, 0, 30}, {11, 0, 40}});
    BRepBuilderAPI_MakeWire outline;
    outline.Add(BRepBuilderAPI_MakeEdge(profile));
    outline.Add(line({11, 0, 40}, {0, 0, 40}));
    outline.Add(line({0, 0, 40}, {0, 0, 0}));
    outline.Add(line({0, 0, 0}, {8, 0, 0}));
    return BRepPrimAPI_MakeRevol(BRepBuilderAPI_MakeFace(outline.Wire()), gp_Ax1(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1)));
}

TopoDS_Shape loft(bool ruled) {
    BRepOffsetAPI_ThruSections sections(true, ruled);
    const double rings[4][3] = {{0, 12, 0}, {12, 7, 0.2}, {24, 9, 0.4}, {36, 14, 0.1}};
    for (const auto &[z, r, lean] : rings)
        sections.AddWire(ring(gp_Pnt(10 * lean, 0, z), gp_Dir(lean, 0, 1), r));
    return sections.Shape();
}

// From a square with an offset to a wavy closed spline: free-form sides.
TopoDS_Shape horn() {
    BRepOffsetAPI_ThruSections sections(true, false);
    for (int k = 0; k < 4; k++) {
        std::vector<gp_Pnt> points;
        for (int i = 0; i <= 16; i++) {
            const double a = 2 * M_PI * i / 16, r = 10 + (1 + k) * 0.8 * std::sin(3 * a + k) - 1.5 * k;
            points.emplace_back(r * std::cos(a) + 3 * k, 0.8 * r * std::sin(a), 9 * k);
        }
        sections.AddWire(BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(through(points))));
    }
    return sections.Shape();
}

TopoDS_Shape pipe() {
    const auto spine = through({{0, 0, 0}, {6, 2, 10}, {16, -4, 18}, {26, 0, 30}});
    gp_Pnt at;
    gp_Vec along;
    spine->D1(spine->FirstParameter(), at, along);
    return BRepOffsetAPI_MakePipe(BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(spine)),
                                  BRepBuilderAPI_MakeFace(ring(at, gp_Dir(along), 4)));
}

// A plate under a wavy spline, drawn along.
TopoDS_Shape wave_plate() {
    BRepBuilderAPI_MakeWire outline;
    outline.Add(BRepBuilderAPI_MakeEdge(through({{0, 0, 4}, {10, 0, 8}, {20, 0, 3}, {30, 0, 9}, {40, 0, 5}})));
    outline.Add(line({40, 0, 5}, {40, 0, 0}));
    outline.Add(line({40, 0, 0}, {0, 0, 0}));
    outline.Add(line({0, 0, 0}, {0, 0, 4}));
    return BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(outline.Wire()), gp_Vec(4, 30, 0));
}

TopoDS_Shape bracket() {
    const TopoDS_Shape corner = BRepAlgoAPI_Fuse(BRepPrimAPI_MakeBox(40, 30, 8), BRepPrimAPI_MakeBox(8, 30, 35));
    const TopoDS_Shape bored = BRepAlgoAPI_Cut(corner, BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(26, 15, -1), gp_Dir(0, 0, 1)), 6, 20));
    return BRepAlgoAPI_Cut(bored, BRepPrimAPI_MakeCone(gp_Ax2(gp_Pnt(-1, 15, 22), gp_Dir(1, 0, 0)), 7, 3, 12));
}

} // namespace

std::vector<Solid> solids() {
    const gp_Ax2 tilted(gp_Pnt(0, 0, 10), gp_Dir(1, 0.3, 0.2));
    return {
        {"bottle", bottle()},
        {"rounded box", rounded(BRepPrimAPI_MakeBox(30, 20, 15), 3)},
        {"vase", vase()},
        {"loft", loft(false)},
        {"ruled loft", loft(true)},
        {"horn", horn()},
        {"pipe", pipe()},
        {"wavy plate", wave_plate()},
        {"bracket", bracket()},
        {"ball in a box", BRepAlgoAPI_Common(BRepPrimAPI_MakeBox(gp_Pnt(-10, -10, -10), gp_Pnt(10, 10, 10)), BRepPrimAPI_MakeSphere(12))},
        {"crossed cylinders", BRepAlgoAPI_Fuse(BRepPrimAPI_MakeCylinder(7, 40), BRepPrimAPI_MakeCylinder(tilted, 5, 25))},
        {"cone and torus", BRepAlgoAPI_Fuse(BRepPrimAPI_MakeCone(15, 6, 20), BRepPrimAPI_MakeTorus(gp_Ax2(gp_Pnt(0, 0, 6), gp_Dir(0, 0, 1)), 13, 3))},
    };
}
