// The drop-in classes method by method, placed faces and edges, answers of ShapeAnalysis_Surface at seams and poles, misuse.
// SPDX-License-Identifier: MIT OR Apache-2.0
#include "check.hxx"
#include "shapes.hxx"

#include <footpoint_occt.hxx>

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <GeomAPI_ProjectPointOnCurve.hxx>
#include <GeomAPI_ProjectPointOnSurf.hxx>
#include <Geom_OffsetCurve.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <TopExp_Explorer.hxx>
#include <TopLoc_Location.hxx>
#include <TopoDS.hxx>

#include <cmath>
#include <random>

namespace fo = footpoint::occt;

namespace {

std::mt19937 random_numbers(7);
double between(double a, double b) { return std::uniform_real_distribution<double>(a, b)(random_numbers); }

/** That a call throws this kind of exception, with this in its text. */
template <class Exception, class Call>
void refused(const char *about, const std::string &text, Call call) {
    try {
        call();
        expect(false, about, "nothing was thrown");
    } catch (const Exception &failure) {
        const bool named = std::string(failure.GetMessageString()).find(text) != std::string::npos;
        if (!named) std::fprintf(stderr, "%s\n", failure.GetMessageString());
        expect(named, about, "the text does not name it");
    } catch (const Standard_Failure &failure) {
        std::fprintf(stderr, "%s: %s\n", failure.DynamicType()->Name(), failure.GetMessageString());
        expect(false, about, "another exception");
    }
}

Handle(Geom_BezierSurface) patch() {
    TColgp_Array2OfPnt poles(1, 3, 1, 3);
    for (int i = 1; i <= 3; i++)
        for (int j = 1; j <= 3; j++) poles(i, j) = gp_Pnt(10 * i, 10 * j, i == 2 && j == 2 ? 8 : 0);
    return new Geom_BezierSurface(poles);
}

/** Named cases where OCCT has no answer or a wrong one, and footpoint has the right one. */
void named_cases() {
    const Handle(Geom_Surface) surface = patch();
    const gp_Pnt beside(5, 20, 1);
    const ::GeomAPI_ProjectPointOnSurf theirs(beside, surface);
    fo::GeomAPI_ProjectPointOnSurf ours(beside, surface);
    double u, v;
    ours.LowerDistanceParameters(u, v);
    // The edge u = 0 is the straight line x = 10, z = 0.
    expect(u == 0 && std::abs(v - 0.5) < 1e-12, "beside an edge", "parameters", u, v);
    expect(std::abs(ours.LowerDistance() - std::sqrt(26.0)) < 1e-13, "beside an edge", "distance", ours.LowerDistance());
    expect(theirs.NbPoints() == 0 || theirs.LowerDistance() > ours.LowerDistance() * (1 - 1e-12), "beside an edge", "OCCT is nearer");
    expect(ours.IsProven() && ours.LowerBound() <= ours.LowerDistance(), "beside an edge", "proof");

    const Handle(Geom_Curve) arc = new Geom_TrimmedCurve(new Geom_Circle(gp_Ax2(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1)), 5), 0.5, 2.0);
    const gp_Pnt past(6, -2, 0);
    const ::GeomAPI_ProjectPointOnCurve none(past, arc);
    const fo::GeomAPI_ProjectPointOnCurve end(past, arc);
    expect(none.NbPoints() == 0, "past the end of an arc", "OCCT has an answer now", none.NbPoints());
    expect(end.LowerDistanceParameter() == 0.5, "past the end of an arc", "parameter", end.LowerDistanceParameter());

    // Above the middle of a cylinder of the plane: its axis. Every angle is as near.
    const Handle(Geom_Surface) cylinder = new Geom_CylindricalSurface(gp_Ax3(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1)), 3);
    fo::surface asked(cylinder);
    const fo::foot on_axis = asked.closest(gp_Pnt(0, 0, 7));
    expect((on_axis.Flags & FPT_FOOT_CONTINUUM) != 0 && std::abs(on_axis.V - 7) < 1e-12, "axis of a cylinder", "continuum", on_axis.V);
}

void methods() {
    const Handle(Geom_Surface) surface = patch();
    const gp_Pnt q(18, 23, 9);
    fo::GeomAPI_ProjectPointOnSurf empty, whole(q, surface), loose(q, surface, 1e-3), part(q, surface, 0.1, 0.4, 0.2, 0.9),
        exact(q, surface, 0.1, 0.4, 0.2, 0.9, 1e-9, Extrema_ExtAlgo_Tree);
    expect(whole.IsDone() && loose.IsDone() && part.IsDone() && exact.IsDone(), "methods", "done");
    expect(!empty.IsDone() && empty.NbPoints() == 0, "methods", "an empty one is done");
    expect(double(whole) == whole.LowerDistance() && int(whole) == whole.NbPoints(), "methods", "operators");
    expect(gp_Pnt(whole).Distance(whole.NearestPoint()) == 0 && whole.Point(1).Distance(whole.NearestPoint()) < 1e-12, "methods", "points");
    expect(loose.LowerDistance() == whole.LowerDistance() && exact.LowerDistance() == part.LowerDistance(), "methods", "tolerance");
    double u, v;
    part.LowerDistanceParameters(u, v);
    expect(u >= 0.1 && u <= 0.4 && v >= 0.2 && v <= 0.9 && part.LowerDistance() >= whole.LowerDistance(), "methods", "range", u, v);
    for (int k = 1; k < whole.NbPoints(); k++) expect(whole.Distance(k) <= whole.Distance(k + 1), "methods", "order");
    const int all = whole.NbPoints();
    whole.SetExtremaFlag(Extrema_ExtFlag_MIN);
    const int minima = whole.NbPoints();
    whole.SetExtremaFlag(Extrema_ExtFlag_MAX);
    const int maxima = whole.NbPoints();
    expect(minima >= 1 && maxima >= 1 && minima + maxima <= all, "methods", "flags", minima, maxima);
    expect(whole.LowerDistance() == whole.Distance(1), "methods", "the nearest maximum");
    whole.Init(gp_Pnt(20, 20, 100), surface);
    whole.SetExtremaFlag(Extrema_ExtFlag_MINMAX);
    expect(whole.IsDone() && std::abs(whole.LowerDistance() - 98) < 1e-9, "methods", "initialised again", whole.LowerDistance());

    const Handle(Geom_Curve) circle = new Geom_Circle(gp_Ax2(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1)), 5);
    fo::GeomAPI_ProjectPointOnCurve on_circle(gp_Pnt(8, 0, 0), circle);
    expect(on_circle.NbPoints() == 2 && on_circle.LowerDistance() == 3 && on_circle.Distance(2) == 13, "methods", "circle", on_circle.NbPoints());
    double second = 0;
    on_circle.Parameter(2, second);
    expect(std::abs(second - M_PI) < 1e-12 && on_circle.Parameter(2) == second, "methods", "parameter", second);
    on_circle.Init(circle, 1, 2);
    on_circle.Perform(gp_Pnt(8, 0, 0));
    expect(on_circle.LowerDistanceParameter() == 1 && int(on_circle) >= 1 && double(on_circle) > 3, "methods", "part of the circle");
    expect(gp_Pnt(on_circle).Distance(circle->Value(1)) < 1e-14, "methods", "point");
    fo::GeomAPI_ProjectPointOnCurve part_of_it(gp_Pnt(8, 0, 0), circle, 1, 2);
    expect(part_of_it.LowerDistance() == on_circle.LowerDistance(), "methods", "constructor with a range");
}

/** Placed faces and edges: the answer is that of the shape where it lies, in the parameters of what lies beneath. */
void placed() {
    gp_Trsf turn, move, mirror;
    turn.SetRotation(gp_Ax1(gp_Pnt(1, 2, 3), gp_Dir(1, 1, 0)), 0.7);
    move.SetTranslation(gp_Vec(100, -50, 20));
    mirror.SetMirror(gp_Ax2(gp_Pnt(0, 0, 1), gp_Dir(0, 0.2, 1)));
    for (const auto &[name, shape] : real_shapes()) {
        for (const gp_Trsf &place : {gp_Trsf(), move * turn}) {
            const TopoDS_Shape there = shape.Moved(TopLoc_Location(place));
            int count = 0;
            for (TopExp_Explorer faces(there, TopAbs_FACE); faces.More() && count < 12; faces.Next(), count++) {
                const TopoDS_Face face = TopoDS::Face(faces.Current());
                const Handle(Geom_Surface) surface = BRep_Tool::Surface(face);
                double u1, u2, v1, v2;
                BRepTools::UVBounds(face, u1, u2, v1, v2);
                fo::surface asked(face);
                for (int i = 0; i < 10; i++) {
                    const double u = between(u1, u2), v = between(v1, v2);
                    const gp_Pnt on = surface->Value(u, v);
                    const fo::foot back = asked.closest(on);
                    expect(back.Distance < 1e-11, name, "distance of a point of the face", back.Distance);
                    expect(surface->Value(back.U, back.V).Distance(on) < 1e-9, name, "parameters of the face", back.U, back.V);
                    expect(back.U >= u1 - 1e-9 && back.U <= u2 + 1e-9 && back.V >= v1 - 1e-9 && back.V <= v2 + 1e-9, name, "range of the face",
                           back.U, back.V);
                }
            }
            count = 0;
            for (TopExp_Explorer edges(there, TopAbs_EDGE); edges.More() && count < 12; edges.Next(), count++) {
                const TopoDS_Edge edge = TopoDS::Edge(edges.Current());
                double first, last;
                const Handle(Geom_Curve) curve = BRep_Tool::Curve(edge, first, last);
                if (curve.IsNull()) continue;
                fo::curve asked(edge);
                for (int i = 0; i < 10; i++) {
                    const gp_Pnt on = curve->Value(between(first, last));
                    const fo::foot back = asked.closest(on);
                    expect(back.Distance < 1e-11 && curve->Value(back.U).Distance(on) < 1e-9, name, "edge", back.Distance);
                    expect(back.U >= first - 1e-9 && back.U <= last + 1e-9, name, "range of the edge", back.U);
                }
            }
        }
    }
    // A mirrored infinite plane and cylinder: the location turns parameters and windows.
    const TopoDS_Face plane = BRepBuilderAPI_MakeFace(gp_Pln(gp_Pnt(0, 0, 2), gp_Dir(0, 0, 1)), -1000, 1000, -1000, 1000);
    const TopoDS_Face there = TopoDS::Face(plane.Moved(TopLoc_Location(mirror), Standard_False));
    fo::surface asked(there);
    const gp_Pnt at = gp_Pnt(40, -7, 2).Transformed(mirror);
    const fo::foot back = asked.closest(at);
    expect(back.Distance < 1e-12 && BRep_Tool::Surface(plane)->Value(back.U, back.V).Distance(gp_Pnt(40, -7, 2)) < 1e-11, "mirrored plane",
           "parameters", back.U, back.V);
}

void analysis() {
    using footpoint::occt::ShapeAnalysis_Surface;
    const Handle(Geom_Surface) sphere = new Geom_SphericalSurface(gp_Ax3(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1)), 2);
    Handle(ShapeAnalysis_Surface) tool = new ShapeAnalysis_Surface(sphere);
    gp_Pnt2d at = tool->ValueOfUV(sphere->Value(1, 0.5), 1e-7);
    expect(at.Distance(gp_Pnt2d(1, 0.5)) < 1e-12 && tool->Gap() < 1e-14 && tool->IsProven(), "sphere", "value", at.X(), at.Y());
    expect(tool->HasSingularities(1e-7) && tool->NbSingularities(1e-7) == 2 && tool->IsUClosed(), "sphere", "what OCCT knows is still there");
    // Round the equator twice: the parameter goes on.
    at = gp_Pnt2d(0, 0);
    for (int i = 1; i <= 80; i++) {
        const double angle = 4 * M_PI * i / 80;
        at = tool->NextValueOfUV(at, gp_Pnt(3 * std::cos(angle), 3 * std::sin(angle), 0), 1e-7);
        expect(std::abs(at.X() - angle) < 1e-12 && std::abs(tool->Gap() - 1) < 1e-14, "sphere", "round the seam", at.X(), angle);
    }
    // At the pole the longitude stays.
    at = tool->NextValueOfUV(gp_Pnt2d(1.25, 1.5), gp_Pnt(0, 0, 2), 1e-7);
    expect(at.X() == 1.25 && at.Y() == M_PI_2, "sphere", "pole", at.X(), at.Y());
    // A closed, not periodic spline: the end that is nearer to the parameters before.
    TColgp_Array2OfPnt poles(1, 5, 1, 2);
    for (int i = 1; i <= 5; i++)
        for (int j = 1; j <= 2; j++) poles(i, j) = gp_Pnt(i == 2 || i == 3 ? 4 : -0.5, i == 3 || i == 4 ? 4 : 0, 5 * j);
    poles(1, 1) = poles(5, 1) = gp_Pnt(0, 0, 5), poles(1, 2) = poles(5, 2) = gp_Pnt(0, 0, 10);
    tool = new ShapeAnalysis_Surface(new Geom_BezierSurface(poles));
    const gp_Pnt on_seam(0, 0, 7.5);
    at = tool->NextValueOfUV(gp_Pnt2d(0.98, 0.4), on_seam, 1e-7);
    expect(at.X() == 1, "seam", "from the end", at.X());
    at = tool->NextValueOfUV(gp_Pnt2d(0.02, 0.4), on_seam, 1e-7);
    expect(at.X() == 0, "seam", "from the start", at.X());
    tool->SetDomain(0.2, 0.6, 0, 1);
    at = tool->ValueOfUV(on_seam, 1e-7);
    expect(at.X() >= 0.2 && at.X() <= 0.6, "domain", "restricted", at.X());
    tool->Init(sphere);
    expect(std::abs(tool->ValueOfUV(gp_Pnt(0, 5, 0), 1e-7).X() - M_PI_2) < 1e-12, "sphere", "initialised again");
    tool->Init(Handle(::ShapeAnalysis_Surface)(new ::ShapeAnalysis_Surface(sphere)));
    expect(std::abs(tool->ValueOfUV(gp_Pnt(0, -5, 0), 1e-7).X() - 1.5 * M_PI) < 1e-12, "sphere", "initialised from another");
}

void sets_and_batches() {
    const Handle(Geom_Surface) torus = new Geom_ToroidalSurface(gp_Ax3(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1)), 5, 1);
    fo::surface asked(torus);
    const fo::members corners = asked.preimage(torus->Value(0, 0));
    expect(corners.IsComplete && corners.List.size() == 4, "torus", "both seams: four parameters", double(corners.List.size()));
    const fo::members poles = fo::surface(Handle(Geom_Surface)(new Geom_SphericalSurface(gp_Ax3(), 2))).preimage(gp_Pnt(0, 0, 2));
    expect(poles.List.size() == 1 && poles.List[0].Kind == FPT_MEMBER_ARC_U && poles.List[0].URange[0] == 0
               && std::abs(poles.List[0].URange[1] - 2 * M_PI) < 1e-15, "sphere", "the pole is an arc of all longitudes", double(poles.List.size()));
    std::vector<gp_Pnt> points;
    for (int i = 0; i < 3000; i++) points.emplace_back(between(-8, 8), between(-8, 8), between(-3, 3));
    points[17] = gp_Pnt(NAN, 0, 0);
    const std::vector<fo::foot> all = asked.closest_many(points);
    fo::surface copy = asked;
    for (std::size_t i = 0; i < points.size(); i++) {
        if (i == 17) {
            expect((all[i].Flags & FPT_FOOT_BAD_QUERY) != 0 && std::isnan(all[i].U), "batch", "bad query");
            continue;
        }
        const fo::foot one = copy.closest(points[i]);
        expect(one.U == all[i].U && one.V == all[i].V && one.Distance == all[i].Distance, "batch", "one by one", one.U, all[i].U);
        const double rim = std::hypot(std::hypot(points[i].X(), points[i].Y()) - 5, points[i].Z());
        expect(std::abs(one.Distance - std::abs(rim - 1)) < 1e-12, "torus", "closed form", one.Distance, std::abs(rim - 1));
    }
    expect(asked.closest_many({}).empty(), "batch", "of nothing");
    // Near and very far queries of unbounded shapes in one batch, and one after the other: the near ones do not suffer.
    const Handle(Geom_Surface) tube = new Geom_CylindricalSurface(gp_Ax3(), 2);
    fo::surface long_tube(tube), floor(Handle(Geom_Surface)(new Geom_Plane(gp_Ax3())));
    std::vector<gp_Pnt> mixed;
    for (int i = 0; i < 400; i++) {
        const double far = std::pow(10, between(-2, 9));
        mixed.emplace_back(between(-far, far), between(-far, far), between(-far, far));
    }
    mixed[5] = gp_Pnt(0, NAN, 0);
    mixed[6] = gp_Pnt(0, 0, 0);
    const std::vector<fo::foot> on_tube = long_tube.closest_many(mixed), on_floor = floor.closest_many(mixed);
    for (std::size_t i = 0; i < mixed.size(); i++) {
        if (i == 5) continue;
        const gp_Pnt &q = mixed[i];
        const double grain = 4e-14 * std::max(1.0, q.XYZ().Modulus());
        for (const fo::foot &foot : {on_tube[i], long_tube.closest(q)})
            expect(std::abs(foot.V - q.Z()) <= grain && std::abs(foot.Distance - std::abs(std::hypot(q.X(), q.Y()) - 2)) <= grain && foot.IsProven(),
                   "cylinder", "near and far", foot.V, q.Z());
        for (const fo::foot &foot : {on_floor[i], floor.closest(q)})
            expect(std::abs(foot.U - q.X()) <= grain && std::abs(foot.V - q.Y()) <= grain && std::abs(foot.Distance - std::abs(q.Z())) <= grain
                       && foot.IsProven(), "plane", "near and far", foot.U, q.X());
    }
    // An infinite plane, asked farther and farther out.
    fo::surface plane(Handle(Geom_Surface)(new Geom_Plane(gp_Ax3())));
    for (double x = 1e-6; x < 1e12; x *= 100) {
        const fo::foot foot = plane.closest(gp_Pnt(x, -3 * x, x / 2));
        // The first window reaches one unit around the place of the plane: no query is answered with a smaller grain than that gives.
        const double grain = 1e-14 * std::max(x, 0.1);
        expect(std::abs(foot.U - x) <= grain && std::abs(foot.V + 3 * x) <= grain && std::abs(foot.Distance - x / 2) <= grain, "plane", "far out",
               foot.U, x);
        expect((foot.Flags & (FPT_FOOT_EDGE | FPT_FOOT_CORNER)) == 0 && plane.extrema(gp_Pnt(x, x, x)).List.size() == 1, "plane", "borders of the window");
    }
}

void misuse() {
    const Handle(Geom_Surface) surface = patch();
    const Handle(Geom_Curve) line = new Geom_Line(gp_Pnt(0, 0, 0), gp_Dir(1, 0, 0));
    refused<Standard_NullObject>("null surface", "surface", [] { fo::GeomAPI_ProjectPointOnSurf(gp_Pnt(), Handle(Geom_Surface)()); });
    refused<Standard_NullObject>("null curve", "curve", [] { fo::GeomAPI_ProjectPointOnCurve(gp_Pnt(), Handle(Geom_Curve)()); });
    refused<Standard_NullObject>("null face", "face", [] { fo::surface{TopoDS_Face()}; });
    refused<Standard_NullObject>("null edge", "edge", [] { fo::curve{TopoDS_Edge()}; });
    refused<Standard_ConstructionError>("turned range", "U: the range is empty", [&] { fo::surface(surface, 0.5, 0.1, 0, 1); });
    refused<Standard_ConstructionError>("NaN range", "V: the range is empty", [&] { fo::surface(surface, 0, 1, NAN, 1); });
    refused<Standard_ConstructionError>("range beside", "V: the range lies outside", [&] { fo::surface(surface, 0, 1, 3, 4); });
    refused<Standard_ConstructionError>("unbounded parabola", "must be given a range", [] {
        fo::surface(Handle(Geom_Surface)(new Geom_SurfaceOfLinearExtrusion(new Geom_Parabola(gp_Ax2(), 1), gp_Dir(0, 0, 1))));
    });
    refused<Standard_ConstructionError>("unbounded offset", "must be given a range",
                                        [&] { fo::curve(Handle(Geom_Curve)(new Geom_OffsetCurve(line, 1, gp_Dir(0, 0, 1)))); });
    refused<Standard_OutOfRange>("index 0", "Index", [&] { fo::GeomAPI_ProjectPointOnSurf(gp_Pnt(), surface).Point(0); });
    refused<Standard_OutOfRange>("index too high", "Index", [&] { fo::GeomAPI_ProjectPointOnSurf(gp_Pnt(), surface).Distance(1000); });
    refused<StdFail_NotDone>("nothing asked", "nothing was asked", [] { fo::GeomAPI_ProjectPointOnSurf().LowerDistance(); });
    refused<StdFail_NotDone>("no Init", "Init", [] { fo::GeomAPI_ProjectPointOnSurf().Perform(gp_Pnt()); });
    refused<StdFail_NotDone>("NaN query", "not finite", [&] { fo::GeomAPI_ProjectPointOnSurf(gp_Pnt(NAN, 0, 0), surface).LowerDistance(); });
    refused<StdFail_NotDone>("infinite query of a plane", "not finite", [] {
        fo::GeomAPI_ProjectPointOnSurf(gp_Pnt(HUGE_VAL, 0, 0), Handle(Geom_Surface)(new Geom_Plane(gp_Ax3()))).LowerDistance();
    });
    refused<StdFail_NotDone>("NaN in ValueOfUV", "P3D", [&] { fo::ShapeAnalysis_Surface(surface).ValueOfUV(gp_Pnt(0, NAN, 0), 1e-7); });
    refused<Standard_ConstructionError>("infinite point in a set", "point", [&] { fo::surface(surface).preimage(gp_Pnt(HUGE_VAL, 0, 0)); });
    refused<Standard_ConstructionError>("negative tolerance", "tolerance", [&] { fo::surface(surface).preimage(gp_Pnt(), -1); });
    // Ten thousand calls with any numbers at all: an exception of OCCT or an answer.
    const double odd[] = {0, -0.0, 1, -1, 1e-300, 1e300, -1e300, NAN, HUGE_VAL, -HUGE_VAL, 0.5, 2e100, 1e100};
    const auto some = [&] { return odd[std::size_t(between(0, 12.999))]; };
    const Handle(Geom_Surface) kinds[] = {surface, new Geom_Plane(gp_Ax3()), new Geom_SphericalSurface(gp_Ax3(), 1),
                                          new Geom_ConicalSurface(gp_Ax3(), 0.5, 1)};
    int answers = 0, refusals = 0;
    for (int i = 0; i < 10000; i++) {
        try {
            const Handle(Geom_Surface) &kind = kinds[i % 4];
            fo::surface asked = i % 3 == 0 ? fo::surface(kind, some(), some(), some(), some()) : fo::surface(kind);
            const gp_Pnt q(some(), some(), some());
            const fo::foot foot = i % 2 == 0 ? asked.next(gp_Pnt2d(some(), some()), q) : asked.closest(q);
            answers++;
            expect((foot.Flags & FPT_FOOT_BAD_QUERY) != 0 || foot.Distance >= foot.LowerBound, "misuse", "answer", foot.Distance, foot.LowerBound);
        } catch (const Standard_Failure &) {
            refusals++;
        }
    }
    expect(answers > 1000 && refusals > 1000, "misuse", "both happen", answers, refusals);
}

} // namespace

int main() {
    return run(Part("named_cases", named_cases), Part("methods", methods), Part("placed", placed), Part("analysis", analysis), Part("sets_and_batches", sets_and_batches), Part("misuse", misuse));
}
