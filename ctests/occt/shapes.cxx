// SPDX-License-Identifier: MIT OR Apache-2.0
#include "shapes.hxx"

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepBuilderAPI_Transform.hxx>
#include <BRepFilletAPI_MakeFillet.hxx>
#include <BRepOffsetAPI_MakePipe.hxx>
#include <BRepOffsetAPI_ThruSections.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <GC_MakeArcOfCircle.hxx>
#include <GC_MakeSegment.hxx>
#include <GeomAPI_Interpolate.hxx>
#include <GeomAPI_PointsToBSpline.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <TColgp_HArray1OfPnt.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <gp_Circ.hxx>
#include <gp_Elips.hxx>

#ifdef WITH_STEP
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Message_Printer.hxx>
#include <STEPControl_Reader.hxx>
#include <STEPControl_Writer.hxx>

#include <unistd.h>
#endif

#include <cmath>
#include <filesystem>
#include <sstream>

TopoDS_Shape bottle() {
    const double width = 50, thickness = 30, height = 70;
    const gp_Pnt p1(-width / 2, 0, 0), p2(-width / 2, -thickness / 4, 0), p3(0, -thickness / 2, 0), p4(width / 2, -thickness / 4, 0),
        p5(width / 2, 0, 0);
    BRepBuilderAPI_MakeWire half(BRepBuilderAPI_MakeEdge(GC_MakeSegment(p1, p2).Value()),
                                 BRepBuilderAPI_MakeEdge(GC_MakeArcOfCircle(p2, p3, p4).Value()),
                                 BRepBuilderAPI_MakeEdge(GC_MakeSegment(p4, p5).Value()));
    gp_Trsf mirror;
    mirror.SetMirror(gp_Ax1(gp_Pnt(0, 0, 0), gp_Dir(1, 0, 0)));
    BRepBuilderAPI_MakeWire profile;
    profile.Add(half.Wire());
    profile.Add(TopoDS::Wire(BRepBuilderAPI_Transform(half.Wire(), mirror).Shape()));
    const TopoDS_Shape body = BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(profile.Wire()), gp_Vec(0, 0, height)).Shape();
    BRepFilletAPI_MakeFillet rounded(body);
    for (TopExp_Explorer edges(body, TopAbs_EDGE); edges.More(); edges.Next())
        rounded.Add(thickness / 12, TopoDS::Edge(edges.Current()));
    const TopoDS_Shape neck = BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(0, 0, height), gp_Dir(0, 0, 1)), thickness / 4, height / 10).Shape();
    return BRepAlgoAPI_Fuse(rounded.Shape(), neck).Shape();
}

TopoDS_Shape filleted_block() {
    const TopoDS_Shape box = BRepPrimAPI_MakeBox(40, 30, 20).Shape();
    BRepFilletAPI_MakeFillet fillet(box);
    double radius = 2;
    for (TopExp_Explorer edges(box, TopAbs_EDGE); edges.More(); edges.Next(), radius += 0.08)
        fillet.Add(radius, radius + 1, TopoDS::Edge(edges.Current()));
    const TopoDS_Shape hole = BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(20, 15, -5), gp_Dir(0.1, 0, 1)), 6, 40).Shape();
    return BRepAlgoAPI_Cut(fillet.Shape(), hole).Shape();
}

namespace {

// A closed wire of one spline through the points r(angle) at a height.
template <class Radius>
TopoDS_Wire ring(Radius radius, double height) {
    const int count = 24;
    const Handle(TColgp_HArray1OfPnt) points = new TColgp_HArray1OfPnt(1, count);
    for (int i = 0; i < count; i++) {
        const double angle = 2 * M_PI * i / count, r = radius(angle);
        points->SetValue(i + 1, gp_Pnt(r * std::cos(angle), r * std::sin(angle), height));
    }
    GeomAPI_Interpolate through(points, Standard_True, 1e-9);
    through.Perform();
    return BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(through.Curve()));
}

} // namespace

TopoDS_Shape loft() {
    BRepOffsetAPI_ThruSections skin(Standard_False, Standard_False, 1e-6);
    skin.AddWire(ring([](double) { return 20.0; }, 0));
    skin.AddWire(ring([](double a) { return 14 + 5 * std::cos(3 * a); }, 25));
    skin.AddWire(ring([](double a) { return 10 / std::pow(std::pow(std::cos(a), 4) + std::pow(std::sin(a), 4), 0.25); }, 45));
    skin.AddWire(ring([](double a) { return 18 + 2 * std::sin(5 * a); }, 60));
    return skin.Shape();
}

TopoDS_Shape sweep() {
    TColgp_Array1OfPnt points(1, 20);
    for (int i = 0; i < 20; i++) {
        const double angle = 0.6 * i;
        points(i + 1) = gp_Pnt((20 - 0.5 * i) * std::cos(angle), (20 - 0.5 * i) * std::sin(angle), 3.0 * i);
    }
    const Handle(Geom_BSplineCurve) spine = GeomAPI_PointsToBSpline(points).Curve();
    gp_Pnt start;
    gp_Vec along;
    spine->D1(spine->FirstParameter(), start, along);
    const TopoDS_Wire circle = BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(gp_Circ(gp_Ax2(start, gp_Dir(along)), 2.5)));
    return BRepOffsetAPI_MakePipe(BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(spine)), circle).Shape();
}

TopoDS_Shape blade() {
    BRepOffsetAPI_ThruSections skin(Standard_False, Standard_False, 1e-6);
    for (int k = 0; k < 5; k++) {
        const double chord = 20 - 3 * k, turn = 0.25 * k;
        const int count = 30;
        const Handle(TColgp_HArray1OfPnt) points = new TColgp_HArray1OfPnt(1, count);
        for (int i = 0; i < count; i++) {
            const double angle = 2 * M_PI * i / count, x = chord * std::cos(angle), y = 0.08 * chord * std::sin(angle) * (1.2 + std::cos(angle));
            points->SetValue(i + 1, gp_Pnt(x * std::cos(turn) - y * std::sin(turn), x * std::sin(turn) + y * std::cos(turn), 15 * k));
        }
        GeomAPI_Interpolate through(points, Standard_True, 1e-9);
        through.Perform();
        skin.AddWire(BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(through.Curve())));
    }
    return skin.Shape();
}

namespace {

TopoDS_Shape through_brep(const TopoDS_Shape &shape) {
    std::stringstream file;
    BRepTools::Write(shape, file);
    TopoDS_Shape out;
    BRepTools::Read(out, file, BRep_Builder());
    return out;
}

#ifdef WITH_STEP
TopoDS_Shape through_step(const TopoDS_Shape &shape) {
    const std::string path = std::filesystem::temp_directory_path() / ("footpoint_test_" + std::to_string(getpid()) + ".step");
    STEPControl_Writer writer;
    writer.Transfer(shape, STEPControl_AsIs);
    writer.Write(path.c_str());
    STEPControl_Reader reader;
    const bool read = reader.ReadFile(path.c_str()) == IFSelect_RetDone && reader.TransferRoots() > 0;
    std::filesystem::remove(path);
    if (!read) throw Standard_Failure("STEP: not read");
    return reader.OneShape();
}
#endif

} // namespace

std::vector<std::pair<std::string, TopoDS_Shape>> real_shapes() {
    const TopoDS_Shape made = bottle();
    std::vector<std::pair<std::string, TopoDS_Shape>> out = {
        {"bottle", made}, {"filleted block", filleted_block()}, {"loft", loft()}, {"sweep", sweep()}, {"blade", blade()}};
    for (auto &[name, shape] : out) shape = through_brep(shape);
#ifdef WITH_STEP
    // OCCT tells about its translation on the standard output.
    Message::DefaultMessenger()->RemovePrinters(STANDARD_TYPE(Message_Printer));
    out.emplace_back("bottle (STEP)", through_step(made));
    out.emplace_back("sweep (STEP)", through_step(sweep()));
#endif
    return out;
}
