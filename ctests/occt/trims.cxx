// Faces of solids as trimmed surfaces: points, normals, loops, and the way to NURBS and back.
// SPDX-License-Identifier: MIT OR Apache-2.0
#include "check.hxx"

#include <footpoint_occt_faces.hxx>

#include <BRepAdaptor_Surface.hxx>
#include <BRepAlgoAPI_Cut.hxx>
#include <BRepBuilderAPI_Transform.hxx>
#include <BRepFilletAPI_MakeFillet.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCone.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepPrimAPI_MakeTorus.hxx>

#include <cstdlib>
#include <fstream>

namespace {

TopoDS_Shape placed(const TopoDS_Shape &shape) {
    gp_Trsf turn;
    turn.SetRotation(gp_Ax1(gp_Pnt(1, 2, 3), gp_Dir(1, -2, 0.5)), 0.7);
    return BRepBuilderAPI_Transform(shape, turn, true).Shape();
}

/** Every face of a shape: the report is clean, points agree with OCCT's, and elementary ones go to NURBS and back. */
int look_at(const std::string &name, const TopoDS_Shape &shape) {
    int count = 0;
    for (TopExp_Explorer faces(shape, TopAbs_FACE); faces.More(); faces.Next(), count++) {
        const TopoDS_Face face = TopoDS::Face(faces.Current());
        const std::string about = name + ", face " + std::to_string(count);
        const footpoint::trimmed_surface trim = footpoint::occt::trimmed(face);
        const auto report = trim.report(1e-6);
        for (const fpt_trim_finding &finding : report.findings)
            expect(false, about, "finding of kind and by", finding.kind, finding.numbers[0]);
        expect(report.summary.largest_gap < 1e-6, about, "gap", report.summary.largest_gap);
        const BRepAdaptor_Surface surface(TopoDS::Face(face.Oriented(TopAbs_FORWARD)));
        for (std::size_t k = 0; k < trim.loop_count(); k++)
            for (std::size_t i = 0; i < trim.coedge_count(k); i++)
                for (double share : {0.0, 0.3, 1.0}) {
                    footpoint::parameters uv{};
                    footpoint::point p{};
                    footpoint::check(fpt_trim_coedge_evaluate(trim.get(), k, i, &share, 1, uv.data(), p.data(), nullptr));
                    const gp_Pnt q = surface.Value(uv[0], uv[1]);
                    expect(q.Distance(gp_Pnt(p[0], p[1], p[2])) < 1e-9, about, "point", q.Distance(gp_Pnt(p[0], p[1], p[2])));
                }
        expect(trim.is_flipped() == (face.Orientation() == TopAbs_REVERSED), about, "flip");
        if (surface.GetType() > GeomAbs_Torus) continue;
        footpoint::change_options options;
        options.tolerance = 1e-6;
        options.replacement = FPT_REPLACEMENT_SPLINE;
        fpt_change_summary summary{};
        fpt_trim *handle = nullptr;
        footpoint::check(fpt_trim_to_nurbs(trim.get(), nullptr, &options, &handle, &summary));
        const footpoint::trimmed_surface nurbs(handle);
        expect(summary.proven == 1 && summary.deviation <= 1e-6, about, "deviation", summary.deviation);
        for (const fpt_trim_finding &finding : nurbs.report(3e-6).findings)
            expect(false, about, "finding as NURBS of kind and by", finding.kind, finding.numbers[0]);
        const auto back = footpoint::trimmed_surface::from_json(trim.json());
        expect(back.json() == trim.json(), about, "text");
        if (const char *folder = std::getenv("FOOTPOINT_PICTURES"))
            std::ofstream(std::string(folder) + "/" + name + std::to_string(count) + ".svg") << trim.picture(about);
    }
    return count;
}

void primitives() {
    expect(look_at("sphere", BRepPrimAPI_MakeSphere(3).Shape()) == 1, "sphere", "faces");
    look_at("part of a sphere", BRepPrimAPI_MakeSphere(3, -0.5, 1.0, 4.0).Shape());
    look_at("cylinder", placed(BRepPrimAPI_MakeCylinder(2, 5).Shape()));
    look_at("270 degrees", placed(BRepPrimAPI_MakeCylinder(2, 5, 4.712).Shape()));
    look_at("cone", placed(BRepPrimAPI_MakeCone(2, 0, 5).Shape()));
    look_at("blunt cone", placed(BRepPrimAPI_MakeCone(1, 2, 5).Shape()));
    look_at("torus", placed(BRepPrimAPI_MakeTorus(5, 2).Shape()));
    look_at("part of a torus", placed(BRepPrimAPI_MakeTorus(5, 2, 4.0).Shape()));
}

/** OCCT 7.6 makes this solid with an edge whose range runs backwards; it is refused with a text. */
void what_is_not_valid() {
    bool refused = false;
    for (TopExp_Explorer faces(BRepPrimAPI_MakeTorus(5, 2, 0.3, 2.9, 5.0).Shape(), TopAbs_FACE); faces.More(); faces.Next()) {
        try {
            footpoint::occt::trimmed(TopoDS::Face(faces.Current()));
        } catch (const Standard_ConstructionError &failure) {
            refused = std::string(failure.GetMessageString()).find("backwards") != std::string::npos;
        }
    }
    expect(refused, "backwards", "refused");
}

void solids() {
    const TopoDS_Shape box = BRepPrimAPI_MakeBox(gp_Pnt(-4, -4, -4), 8.0, 8.0, 8.0).Shape();
    look_at("box with a bore", placed(BRepAlgoAPI_Cut(box, BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(0, 0, -5), gp::DZ()), 2, 10).Shape())));
    look_at("box without a ball", BRepAlgoAPI_Cut(box, BRepPrimAPI_MakeSphere(gp_Pnt(4, 4, 4), 3).Shape()));
    look_at("ball without a bore", BRepAlgoAPI_Cut(BRepPrimAPI_MakeSphere(3).Shape(),
                                                   BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(0.4, 0.3, -5), gp::DZ()), 1, 10).Shape()));
    look_at("crossed bores", BRepAlgoAPI_Cut(BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(0, 0, -5), gp::DZ()), 3, 10).Shape(),
                                             BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(-5, 0, 0.3), gp::DX()), 1.5, 10).Shape()));
    BRepFilletAPI_MakeFillet fillet(box);
    for (TopExp_Explorer edges(box, TopAbs_EDGE); edges.More(); edges.Next()) fillet.Add(0.8, TopoDS::Edge(edges.Current()));
    look_at("fillets", fillet.Shape());
}

} // namespace

int main() {
    using std::pair;
    return run(pair{"primitives", primitives}, pair{"solids", solids}, pair{"what is not valid", what_is_not_valid});
}
