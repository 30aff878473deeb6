// Faces of solids as trimmed surfaces: points, normals, loops, and the way to NURBS and back.
// SPDX-License-Identifier: MIT OR Apache-2.0
#include "check.hxx"

#include <footpoint_occt_faces.hxx>

#include <BRepAdaptor_Surface.hxx>
#include <BRepAlgoAPI_Cut.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepBuilderAPI_Transform.hxx>
#include <BRepExtrema_DistShapeShape.hxx>
#include <BRepFilletAPI_MakeFillet.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <BRepPrimAPI_MakeRevol.hxx>
#include <BRepTopAdaptor_FClass2d.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCone.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepPrimAPI_MakeTorus.hxx>

#include <GeomAPI_PointsToBSpline.hxx>
#include <TColgp_Array1OfPnt.hxx>

#include <cstdlib>
#include <ctime>
#include <fstream>
#include <random>

namespace {

TopoDS_Shape placed(const TopoDS_Shape &shape) {
    gp_Trsf turn;
    turn.SetRotation(gp_Ax1(gp_Pnt(1, 2, 3), gp_Dir(1, -2, 0.5)), 0.7);
    return BRepBuilderAPI_Transform(shape, turn, true).Shape();
}

struct Asked {
    int faces = 0, kinds[12] = {}, sides = 0, queries = 0, unproven = 0, nearer = 0;
    double ours = 0, theirs = 0, gap = 0;
} asked;

/** Sides of places and nearest points in OCCT's own parameters, beside BRepTopAdaptor_FClass2d and BRepExtrema_DistShapeShape. */
void ask(const std::string &about, const footpoint::trimmed_surface &trim, const TopoDS_Face &occt, std::mt19937 &random) {
    const footpoint::face face = trim.prepared();
    const std::array<double, 4> domain = trim.support().domain();
    const auto between = [&](double a, double b) { return std::uniform_real_distribution<double>(a, b)(random); };
    const TopoDS_Face forward = TopoDS::Face(occt.Oriented(TopAbs_FORWARD));
    BRepTopAdaptor_FClass2d theirs(forward, 1e-7);
    footpoint::query_options options;
    options.tolerance = 2e-5;
    options.threads = 1;
    std::vector<double> uv;
    for (int i = 0; i < 60; i++) uv.insert(uv.end(), {between(domain[0], domain[1]), between(domain[2], domain[3])});
    const std::vector<fpt_face_place> places = face.classify(uv, options);
    for (std::size_t i = 0; i < places.size(); i++) {
        if (places[i].standing == FPT_FACE_ON_EDGE) continue;
        const TopAbs_State state = theirs.Perform(gp_Pnt2d(uv[2 * i], uv[2 * i + 1]), false);
        if (state == TopAbs_ON) continue;
        asked.sides++;
        expect(places[i].standing == (state == TopAbs_IN ? FPT_FACE_INSIDE : FPT_FACE_OUTSIDE), about, "side", uv[2 * i], uv[2 * i + 1]);
    }
    double edge_gap = 2e-7 + BRep_Tool::Tolerance(occt);
    for (TopExp_Explorer edges(occt, TopAbs_EDGE); edges.More(); edges.Next())
        edge_gap = std::max(edge_gap, BRep_Tool::Tolerance(TopoDS::Edge(edges.Current())));
    for (int i = 0; i < 8; i++) {
        const std::vector<double> near = {between(domain[0], domain[1]), between(domain[2], domain[3])};
        const footpoint::point base = trim.support().evaluate({near[0], near[1]});
        const std::vector<double> query = {base[0] + between(-2, 2), base[1] + between(-2, 2), base[2] + between(-2, 2)};
        std::clock_t start = std::clock();
        const footpoint::face_feet found = face.closest(query, options);
        asked.ours += double(std::clock() - start) / CLOCKS_PER_SEC;
        const TopoDS_Shape vertex = BRepBuilderAPI_MakeVertex(gp_Pnt(query[0], query[1], query[2])).Shape();
        start = std::clock();
        const BRepExtrema_DistShapeShape distance(vertex, occt);
        asked.theirs += double(std::clock() - start) / CLOCKS_PER_SEC;
        asked.queries++;
        if (found.feet[0].flags & FPT_FOOT_NOT_PROVEN) asked.unproven++;
        if (!distance.IsDone() || distance.NbSolution() == 0) continue;
        expect(found.feet[0].distance <= distance.Value() + edge_gap, about, "not farther than OCCT", found.feet[0].distance, distance.Value());
        expect(found.feet[0].lower_bound <= distance.Value() + edge_gap, about, "bound", found.feet[0].lower_bound, distance.Value());
        if (distance.Value() > found.feet[0].distance + 1e-6 + edge_gap) asked.nearer++;
    }
}

/** Every face of a shape: the report is clean, points agree with OCCT's, and elementary ones go to NURBS and back. */
int look_at(const std::string &name, const TopoDS_Shape &shape) {
    int count = 0;
    std::mt19937 random(7);
    for (TopExp_Explorer faces(shape, TopAbs_FACE); faces.More(); faces.Next(), count++) {
        const TopoDS_Face face = TopoDS::Face(faces.Current());
        const std::string about = name + ", face " + std::to_string(count);
        const footpoint::trimmed_surface trim = footpoint::occt::trimmed(face);
        const auto report = trim.report(1e-6);
        for (const fpt_trim_finding &finding : report.findings)
            expect(false, about, "finding of kind and by", finding.kind, finding.numbers[0]);
        expect(report.summary.largest_gap < 1e-6, about, "gap", report.summary.largest_gap);
        // Proven between the samples.
        expect(report.summary.gap_bound < 1e-5, about, "bound of the gap", report.summary.gap_bound);
        asked.faces++;
        asked.gap = std::max(asked.gap, report.summary.gap_bound);
        ask(about, trim, face, random);
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
        asked.kinds[std::min(surface.GetType(), GeomAbs_OtherSurface)]++;
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

TopoDS_Edge wave() {
    TColgp_Array1OfPnt points(1, 6);
    for (int i = 1; i <= 6; i++) points(i) = gp_Pnt(2 + 0.4 * std::sin(1.7 * i), 0, i);
    return BRepBuilderAPI_MakeEdge(GeomAPI_PointsToBSpline(points).Curve()).Edge();
}

void sweeps() {
    const gp_Ax1 axis(gp_Pnt(0, 0, 0), gp::DZ());
    const TopoDS_Edge ellipse = BRepBuilderAPI_MakeEdge(gp_Elips(gp_Ax2(gp_Pnt(4, 0, 0), gp::DY()), 1.5, 0.7)).Edge();
    const TopoDS_Face disc = BRepBuilderAPI_MakeFace(BRepBuilderAPI_MakeWire(ellipse).Wire());
    look_at("revolved spline", placed(BRepPrimAPI_MakeRevol(wave(), axis).Shape()));
    look_at("part of a revolved spline", placed(BRepPrimAPI_MakeRevol(wave(), axis, 2.5).Shape()));
    look_at("revolved ellipse", placed(BRepPrimAPI_MakeRevol(disc, axis, 4.0).Shape()));
    look_at("extruded spline", placed(BRepPrimAPI_MakePrism(wave(), gp_Vec(0.3, 2, 0)).Shape()));
    look_at("extruded ellipse", placed(BRepPrimAPI_MakePrism(disc, gp_Vec(1, 3, 0.5)).Shape()));
    look_at("bored ellipse", BRepAlgoAPI_Cut(BRepPrimAPI_MakePrism(disc, gp_Vec(0, 5, 0)).Shape(),
                                             BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(4, 2.5, -5), gp::DZ()), 0.4, 10).Shape()));
    // They are what they are called, not functions.
    for (const TopoDS_Shape &shape : {BRepPrimAPI_MakeRevol(wave(), axis).Shape(), BRepPrimAPI_MakePrism(wave(), gp_Vec(0.3, 2, 0)).Shape()}) {
        const footpoint::trimmed_surface trim = footpoint::occt::trimmed(TopoDS::Face(TopExp_Explorer(shape, TopAbs_FACE).Current()));
        const std::string text = trim.json();
        expect(text.find("revolution") != std::string::npos || text.find("extrusion") != std::string::npos, text.substr(0, 80), "kind");
    }
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
    const int status = run(pair{"primitives", primitives}, pair{"solids", solids}, pair{"sweeps", sweeps}, pair{"what is not valid", what_is_not_valid});
    std::printf("%d faces (planes %d, cylinders %d, cones %d, spheres %d, tori %d, splines %d, revolutions %d, extrusions %d), gaps proven to be below %.1e\n",
                asked.faces, asked.kinds[GeomAbs_Plane], asked.kinds[GeomAbs_Cylinder], asked.kinds[GeomAbs_Cone], asked.kinds[GeomAbs_Sphere],
                asked.kinds[GeomAbs_Torus], asked.kinds[GeomAbs_BSplineSurface] + asked.kinds[GeomAbs_BezierSurface],
                asked.kinds[GeomAbs_SurfaceOfRevolution], asked.kinds[GeomAbs_SurfaceOfExtrusion], asked.gap);
    std::printf("%d sides agree; %d nearest points, none farther than OCCT's, %d of OCCT's farther, %d not proven; %.1f us against %.1f us of OCCT\n",
                asked.sides, asked.queries, asked.nearer, asked.unproven, 1e6 * asked.ours / asked.queries, 1e6 * asked.theirs / asked.queries);
    return status;
}
