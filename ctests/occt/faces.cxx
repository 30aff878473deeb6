// Faces of real solids: pcurves pulled back beside those of OCCT, nearest points beside BRepExtrema_DistShapeShape.
// SPDX-License-Identifier: MIT OR Apache-2.0
//
// The solids are brought into B-splines by OCCT first (BRepBuilderAPI_NurbsConvert): surfaces, edges and pcurves then are OCCT's own, in
// one parametrisation, and its deviations are measured by the same proof as ours.
#include "check.hxx"
#include "shapes.hxx"

#include <footpoint.hpp>

#include <BRepAdaptor_Surface.hxx>
#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepBuilderAPI_NurbsConvert.hxx>
#include <BRepExtrema_DistShapeShape.hxx>
#include <BRepTools.hxx>
#include <BRepTools_WireExplorer.hxx>
#include <BRep_Tool.hxx>
#include <Geom2dConvert.hxx>
#include <Geom2d_BSplineCurve.hxx>
#include <Geom2d_TrimmedCurve.hxx>
#include <GeomConvert.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_TrimmedCurve.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <map>
#include <random>

namespace {

template <class Spline>
std::vector<double> written_out(const Spline &spline) {
    std::vector<double> out;
    for (int i = 1; i <= spline->NbKnots(); i++) out.insert(out.end(), std::size_t(spline->Multiplicity(i)), spline->Knot(i));
    return out;
}

footpoint::curve curve_of(Handle(Geom_BSplineCurve) spline) {
    if (spline->IsPeriodic()) spline->SetNotPeriodic();
    std::vector<double> poles, weights;
    for (int i = 1; i <= spline->NbPoles(); i++) {
        const gp_Pnt p = spline->Pole(i);
        poles.insert(poles.end(), {p.X(), p.Y(), p.Z()});
        if (spline->IsRational()) weights.push_back(spline->Weight(i));
    }
    return footpoint::curve(std::size_t(spline->Degree()), written_out(spline), poles, weights);
}

footpoint::curve pcurve_of(Handle(Geom2d_BSplineCurve) spline) {
    if (spline->IsPeriodic()) spline->SetNotPeriodic();
    std::vector<double> poles, weights;
    for (int i = 1; i <= spline->NbPoles(); i++) {
        const gp_Pnt2d p = spline->Pole(i);
        poles.insert(poles.end(), {p.X(), p.Y(), 0});
        if (spline->IsRational()) weights.push_back(spline->Weight(i));
    }
    return footpoint::curve(std::size_t(spline->Degree()), written_out(spline), poles, weights);
}

footpoint::surface surface_of(Handle(Geom_BSplineSurface) spline) {
    if (spline->IsUPeriodic()) spline->SetUNotPeriodic();
    if (spline->IsVPeriodic()) spline->SetVNotPeriodic();
    std::vector<double> u, v, poles, weights;
    for (int i = 1; i <= spline->NbUKnots(); i++) u.insert(u.end(), std::size_t(spline->UMultiplicity(i)), spline->UKnot(i));
    for (int i = 1; i <= spline->NbVKnots(); i++) v.insert(v.end(), std::size_t(spline->VMultiplicity(i)), spline->VKnot(i));
    const bool is_rational = spline->IsURational() || spline->IsVRational();
    for (int i = 1; i <= spline->NbUPoles(); i++)
        for (int j = 1; j <= spline->NbVPoles(); j++) {
            const gp_Pnt p = spline->Pole(i, j);
            poles.insert(poles.end(), {p.X(), p.Y(), p.Z()});
            if (is_rational) weights.push_back(spline->Weight(i, j));
        }
    return footpoint::surface(std::size_t(spline->UDegree()), std::size_t(spline->VDegree()), u, v, poles, weights);
}

/** An edge of a face as OCCT has it. */
struct Side {
    footpoint::curve edge, pcurve;
    bool is_degenerated, is_reversed, is_seam;
};

struct Row {
    int edges = 0, faces = 0, lines = 0, not_proven = 0, not_above = 0, worse = 0, refused = 0, tangled = 0;
    double ours = 0, bound = 0, theirs = 0, seconds = 0;
    int queries = 0, unproven = 0, farther = 0, theirs_farther = 0, none = 0, inside = 0;
    double our_seconds = 0, their_seconds = 0;
};
std::map<std::string, Row> table;

double span_of(const footpoint::surface &surface) {
    const std::array<double, 6> box = surface.box();
    return std::hypot(box[3] - box[0], box[4] - box[1], box[5] - box[2]);
}

/** The pcurve of a side pulled back, and OCCT's deviation measured like ours. */
void compare_pcurve(const std::string &about, Row &row, const footpoint::surface &surface, const Side &side) {
    if (side.is_degenerated) return;
    const double size = span_of(surface);
    row.edges++;
    double theirs = HUGE_VAL;
    try {
        theirs = footpoint::deviation(surface, side.pcurve, side.edge).reached;
    } catch (const footpoint::error &) {
        row.tangled++; // it leaves the domain
    }
    footpoint::pull_options options;
    options.tolerance = 1e-10 * size;
    const std::clock_t start = std::clock();
    std::vector<footpoint::proven_curve> ours;
    try {
        ours = footpoint::pull(surface, side.edge, options);
    } catch (const footpoint::error &refused) {
        row.refused++;
        expect(false, about, refused.what());
        return;
    }
    row.seconds += double(std::clock() - start) / CLOCKS_PER_SEC;
    double most = 0, bound = 0;
    const std::array<double, 4> domain = surface.domain();
    for (const footpoint::proven_curve &piece : ours) {
        most = std::max(most, piece.deviation.reached);
        bound = std::max(bound, piece.deviation.bound);
        if (piece.deviation.flags & FPT_DEVIATION_NOT_PROVEN) row.not_proven++;
        if (piece.shape.degree() == 1) row.lines++;
        const std::array<double, 2> range = piece.shape.domain();
        for (int i = 0; i <= 20; i++) {
            const double t = std::min(range[1], range[0] + (range[1] - range[0]) * i / 20);
            const std::vector<double> at = piece.shape.evaluate(t);
            const double rounding = 1e-12 * (1 + std::abs(domain[1]) + std::abs(domain[3]));
            expect(at[0] >= domain[0] - rounding && at[0] <= domain[1] + rounding, about, "u in the domain", at[0]);
            expect(at[1] >= domain[2] - rounding && at[1] <= domain[3] + rounding, about, "v in the domain", at[1]);
        }
    }
    row.ours = std::max(row.ours, most);
    if (std::isfinite(theirs)) row.theirs = std::max(row.theirs, theirs);
    row.bound = std::max(row.bound, bound);
    // Both found in the same way; the tolerance that was asked for is as good as any.
    const double rounding = 1e-14 * size;
    if (most <= theirs + rounding) row.not_above++;
    const bool holds = most <= std::max(theirs + rounding, options.tolerance);
    if (!holds) row.worse++;
    expect(holds, about, "deviation not above OCCT's", most, theirs);
}

/** Nearest points of a face beside OCCT's. */
void compare_nearest(const std::string &about, Row &row, const TopoDS_Face &occt, const footpoint::surface &surface,
                     const footpoint::face &face, std::mt19937 &random, int count) {
    const std::array<double, 6> box = surface.box();
    const double size = span_of(surface);
    std::uniform_real_distribution<double> unit(-0.3, 1.3);
    std::vector<double> points;
    for (int i = 0; i < count; i++)
        for (std::size_t k = 0; k < 3; k++) points.push_back(box[k] + (box[k + 3] - box[k]) * unit(random) + 0.2 * size * (unit(random) - 0.5));
    footpoint::query_options options;
    options.threads = 1;
    std::clock_t start = std::clock();
    const footpoint::face_feet ours = face.closest(points, options);
    row.our_seconds += double(std::clock() - start) / CLOCKS_PER_SEC;
    for (int i = 0; i < count; i++) {
        const gp_Pnt query(points[std::size_t(3 * i)], points[std::size_t(3 * i + 1)], points[std::size_t(3 * i + 2)]);
        const TopoDS_Shape vertex = BRepBuilderAPI_MakeVertex(query).Shape();
        start = std::clock();
        const BRepExtrema_DistShapeShape theirs(vertex, occt);
        row.their_seconds += double(std::clock() - start) / CLOCKS_PER_SEC;
        const fpt_foot_point &foot = ours.feet[std::size_t(i)];
        row.queries++;
        if (foot.flags & FPT_FOOT_NOT_PROVEN) row.unproven++;
        if (ours.places[std::size_t(i)].standing == FPT_FACE_INSIDE) row.inside++;
        if (!theirs.IsDone() || theirs.NbSolution() == 0) {
            row.none++;
            continue;
        }
        // OCCT's edges are curves of their own, within a tolerance of 1e-7 of the surface or what the shape says.
        const double gap = 2e-7 + BRep_Tool::Tolerance(occt), slack = 1e-9 * size;
        double edge_gap = gap;
        for (TopExp_Explorer edges(occt, TopAbs_EDGE); edges.More(); edges.Next())
            edge_gap = std::max(edge_gap, BRep_Tool::Tolerance(TopoDS::Edge(edges.Current())));
        const bool on_edge = theirs.SupportTypeShape2(1) != BRepExtrema_IsInFace;
        if (foot.distance > theirs.Value() + (on_edge ? edge_gap : slack)) row.farther++;
        expect(foot.distance <= theirs.Value() + (on_edge ? edge_gap : slack), about, "not farther than OCCT", foot.distance, theirs.Value());
        expect(foot.lower_bound <= foot.distance, about, "bound");
        if (theirs.Value() > foot.distance + 1e-6 * size + edge_gap) row.theirs_farther++;
    }
}

void compare_face(const std::string &about, Row &row, const TopoDS_Face &occt, std::mt19937 &random, int count) {
    TopLoc_Location place;
    const Handle(Geom_Surface) given = BRep_Tool::Surface(occt, place);
    const Handle(Geom_BSplineSurface) spline =
        GeomConvert::SurfaceToBSplineSurface(Handle(Geom_Surface)::DownCast(given->Transformed(place.Transformation())));
    const footpoint::surface surface = surface_of(Handle(Geom_BSplineSurface)::DownCast(spline->Copy()));
    row.faces++;
    std::vector<std::vector<Side>> loops;
    for (TopExp_Explorer wires(occt.Oriented(TopAbs_FORWARD), TopAbs_WIRE); wires.More(); wires.Next()) {
        loops.emplace_back();
        for (BRepTools_WireExplorer edges(TopoDS::Wire(wires.Current()), TopoDS::Face(occt.Oriented(TopAbs_FORWARD))); edges.More(); edges.Next()) {
            const TopoDS_Edge edge = edges.Current();
            double first = 0, last = 0, from = 0, to = 0;
            const Handle(Geom2d_Curve) flat = BRep_Tool::CurveOnSurface(edge, TopoDS::Face(occt.Oriented(TopAbs_FORWARD)), first, last);
            const Handle(Geom_Curve) curve = BRep_Tool::Curve(edge, from, to);
            const bool is_reversed = edge.Orientation() == TopAbs_REVERSED;
            Handle(Geom2d_BSplineCurve) image = Geom2dConvert::CurveToBSplineCurve(new Geom2d_TrimmedCurve(flat, first, last));
            footpoint::curve pcurve = pcurve_of(image);
            const bool is_degenerated = curve.IsNull() || BRep_Tool::Degenerated(edge);
            footpoint::curve in_space =
                is_degenerated ? footpoint::curve(nullptr)
                               : curve_of(GeomConvert::CurveToBSplineCurve(new Geom_TrimmedCurve(curve, from, to)));
            loops.back().push_back({std::move(in_space), std::move(pcurve), is_degenerated, is_reversed,
                                    BRep_Tool::IsClosed(edge, TopoDS::Face(occt))});
        }
    }
    // The chain in the direction of the loop; a pcurve that runs against it is turned round.
    std::vector<std::vector<footpoint::curve>> turned;
    for (const std::vector<Side> &loop : loops) {
        turned.emplace_back();
        for (const Side &side : loop) {
            compare_pcurve(about, row, surface, side);
            const std::size_t degree = side.pcurve.degree();
            std::vector<double> knots = side.pcurve.knots(), poles = side.pcurve.poles(), weights;
            if (side.pcurve.is_rational()) weights = side.pcurve.weights();
            if (side.is_reversed) {
                std::reverse(knots.begin(), knots.end());
                for (double &x : knots) x = -x;
                std::reverse(weights.begin(), weights.end());
                std::vector<double> back;
                for (std::size_t i = poles.size() / 3; i-- > 0;) back.insert(back.end(), {poles[3 * i], poles[3 * i + 1], 0});
                poles = back;
            }
            // OCCT's pcurves may leave the domain by rounding.
            const std::array<double, 4> domain = surface.domain();
            for (std::size_t i = 0; i < poles.size() / 3; i++)
                for (std::size_t k = 0; k < 2; k++) {
                    const double moved = std::clamp(poles[3 * i + k], domain[2 * k], domain[2 * k + 1]);
                    if (std::abs(moved - poles[3 * i + k]) < 1e-6 * (domain[2 * k + 1] - domain[2 * k])) poles[3 * i + k] = moved;
                }
            turned.back().emplace_back(degree, knots, poles, weights);
        }
    }
    std::vector<std::vector<const footpoint::curve *>> chains;
    for (const std::vector<footpoint::curve> &loop : turned) {
        chains.emplace_back();
        for (const footpoint::curve &curve : loop) chains.back().push_back(&curve);
    }
    if (chains.empty()) return;
    try {
        const footpoint::face face(surface, chains);
        compare_nearest(about, row, occt, surface, face, random, count);
    } catch (const footpoint::error &refused) {
        row.refused++;
        expect(false, about, refused.what());
    }
}

int queries = 12;

void solids() {
    std::mt19937 random(5);
    for (const auto &[name, given] : real_shapes()) {
        BRepBuilderAPI_NurbsConvert converted(given, true);
        int number = 0;
        for (TopExp_Explorer faces(converted.Shape(), TopAbs_FACE); faces.More(); faces.Next(), number++)
            compare_face(name + ", face " + std::to_string(number), table[name], TopoDS::Face(faces.Current()), random, queries);
    }
    std::printf("%-24s %5s %5s %5s %9s %9s %9s %6s %5s %5s %8s | %7s %6s %8s %8s %7s %9s %9s\n", "solid", "faces", "edges", "lines", "ours", "bound", "OCCT", "<=", "unprv",
                "worse", "ms/edge", "queries", "inside", "unproven", "farther", "OCCT's", "us ours", "us OCCT");
    for (const auto &[name, row] : table)
        std::printf("%-24s %5d %5d %5d %9.2g %9.2g %9.2g %6d %5d %5d %8.3f | %7d %6d %8d %8d %7d %9.1f %9.1f\n", name.c_str(), row.faces, row.edges, row.lines,
                    row.ours, row.bound, row.theirs, row.not_above, row.not_proven, row.worse, 1e3 * row.seconds / std::max(row.edges, 1), row.queries, row.inside, row.unproven,
                    row.farther, row.theirs_farther + row.none, 1e6 * row.our_seconds / std::max(row.queries, 1),
                    1e6 * row.their_seconds / std::max(row.queries, 1));
}

} // namespace

int main(int count, char **words) {
    if (count > 1) queries = std::atoi(words[1]);
    return run(Part{"solids", solids});
}
