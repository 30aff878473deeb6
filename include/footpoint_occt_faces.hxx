/*
 * OpenCASCADE's faces as trimmed surfaces of footpoint. SPDX-License-Identifier: MIT OR Apache-2.0
 *
 *     const footpoint::trimmed_surface face = footpoint::occt::trimmed(topods_face);
 *     for (const fpt_trim_finding &finding : face.report().findings) use(finding);
 *
 * Parameters are OCCT's: planes, cylinders, cones, spheres and tori stay what they are, on the rectangle that the face's curves take; so do
 * surfaces of revolution and extrusion of lines, circles, ellipses, parabolas and splines; Bezier and B-spline surfaces are splines; every
 * other surface (offsets, revolutions and extrusions of other curves) is a function of its parameters. Curves in the
 * domain: lines along a parameter are isolines, other lines polylines of two points, circles and ellipses arcs, everything else splines.
 * Edges: lines, circles, ellipses, parabolas and splines keep OCCT's parameters (arcs as polynomials of their angle, off by roundings), other
 * curves become splines with parameters of their own.
 * Loops run with the face on their left; the face is flipped when OCCT's is reversed.
 * Placements with scale are refused, as OCCT's own tools do. Throws Standard_ConstructionError and footpoint::error.
 */
#ifndef FOOTPOINT_OCCT_FACES_HXX
#define FOOTPOINT_OCCT_FACES_HXX

#include "footpoint_occt_shapes.hxx"

#include <BRepTools.hxx>
#include <BRepTools_WireExplorer.hxx>
#include <BRep_Tool.hxx>
#include <Geom2dConvert.hxx>
#include <Geom2d_BSplineCurve.hxx>
#include <Geom2d_Circle.hxx>
#include <Geom2d_Ellipse.hxx>
#include <Geom2d_Line.hxx>
#include <Geom2d_TrimmedCurve.hxx>
#include <GeomConvert.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Wire.hxx>

#include <list>
#include <optional>

namespace footpoint::occt {
namespace detail {

/** A spline of OCCT, in the plane or in space. */
template <class Spline, class Point>
footpoint::curve spline_of(const Spline &spline, Point point) {
    std::vector<double> poles, knots, weights;
    for (int i = 1; i <= spline->NbPoles(); i++) {
        point(spline->Pole(i), poles);
        weights.push_back(spline->Weight(i));
    }
    for (int i = 1; i <= spline->NbKnots(); i++)
        for (int k = 0; k < spline->Multiplicity(i); k++) knots.push_back(spline->Knot(i));
    if (!spline->IsRational()) weights.clear();
    return footpoint::curve(std::size_t(spline->Degree()), knots, poles, weights);
}

inline footpoint::curve spline_in_plane(Handle(Geom2d_BSplineCurve) spline) {
    if (spline->IsPeriodic()) spline->SetNotPeriodic();
    return spline_of(spline, [](const gp_Pnt2d &p, std::vector<double> &poles) {
        poles.insert(poles.end(), {p.X(), p.Y(), 0.0});
    });
}

inline footpoint::curve spline_in_space(Handle(Geom_BSplineCurve) spline) {
    if (spline->IsPeriodic()) spline->SetNotPeriodic();
    return spline_of(spline, [](const gp_Pnt &p, std::vector<double> &poles) {
        poles.insert(poles.end(), {p.X(), p.Y(), p.Z()});
    });
}

/** A curve in the domain with what fpt_coedge_data points to. */
struct pcurve_data {
    fpt_coedge_data data{};
    std::vector<double> points, parameters;
    std::vector<footpoint::curve> curves;
};

/** The part [first, last] of a curve in the domain, run through backwards when `turned`. */
inline void pcurve_of(const Handle(Geom2d_Curve) &given, double first, double last, bool turned, pcurve_data &out) {
    Handle(Geom2d_Curve) shape = given;
    while (const auto trimmed = Handle(Geom2d_TrimmedCurve)::DownCast(shape)) shape = trimmed->BasisCurve();
    const gp_Pnt2d a = shape->Value(turned ? last : first), b = shape->Value(turned ? first : last);
    if (!Handle(Geom2d_Line)::DownCast(shape).IsNull()) {
        const bool fixed_u = a.X() == b.X(), fixed_v = a.Y() == b.Y();
        if (fixed_u != fixed_v) {
            out.data.kind = FPT_PCURVE_ISOLINE;
            const double values[] = {fixed_u ? 0.0 : 1.0, fixed_u ? a.X() : a.Y(), fixed_u ? a.Y() : a.X(),
                                     fixed_u ? b.Y() : b.X()};
            std::copy(values, values + 4, out.data.values);
            return;
        }
        out.data.kind = FPT_PCURVE_POLYLINE;
        out.points = {a.X(), a.Y(), b.X(), b.Y()};
        out.parameters = {turned ? -last : first, turned ? -first : last};
        return;
    }
    const auto arc = [&](const gp_Ax22d &axes, double major, double minor) {
        const gp_XY c = axes.Location().XY(), x = axes.XDirection().XY() * major;
        const gp_XY y = axes.YDirection().XY() * (turned ? -minor : minor);
        out.data.kind = FPT_PCURVE_ARC;
        const double values[] = {c.X(), c.Y(), x.X(), x.Y(), y.X(), y.Y(), turned ? -last : first, turned ? -first : last};
        std::copy(values, values + 8, out.data.values);
    };
    if (const auto circle = Handle(Geom2d_Circle)::DownCast(shape)) {
        arc(circle->Position(), circle->Radius(), circle->Radius());
        return;
    }
    if (const auto ellipse = Handle(Geom2d_Ellipse)::DownCast(shape)) {
        arc(ellipse->Position(), ellipse->MajorRadius(), ellipse->MinorRadius());
        return;
    }
    Handle(Geom2d_Curve) part = new Geom2d_TrimmedCurve(shape, first, last);
    Handle(Geom2d_BSplineCurve) spline = Geom2dConvert::CurveToBSplineCurve(part);
    if (turned) spline->Reverse();
    out.data.kind = FPT_PCURVE_SPLINE;
    out.curves.push_back(spline_in_plane(spline));
}

inline void put(double *out, const gp_XYZ &v) { out[0] = v.X(), out[1] = v.Y(), out[2] = v.Z(); }

/** An elementary surface on the rectangle that the curves of a face take; angles at most a turn, latitudes within the poles. */
inline footpoint::support elementary_of(fpt_elementary_kind kind, const gp_Ax3 &axes, double first, double second,
                                        std::array<double, 4> domain) {
    const double turn = 2 * std::acos(-1.0), slack = Precision::PConfusion();
    const auto angle = [&](int k) {
        if (domain[k + 1] - domain[k] > turn - slack) domain[k + 1] = domain[k] + turn;
    };
    if (kind != FPT_ELEMENTARY_PLANE) angle(0);
    if (kind == FPT_ELEMENTARY_TORUS) angle(2);
    if (kind == FPT_ELEMENTARY_SPHERE) {
        if (domain[2] < -turn / 4 + slack) domain[2] = -turn / 4;
        if (domain[3] > turn / 4 - slack) domain[3] = turn / 4;
    }
    if (kind == FPT_ELEMENTARY_CONE) {
        const double apex = -first / std::sin(second);
        if (std::abs(domain[2] - apex) < slack) domain[2] = apex;
        if (std::abs(domain[3] - apex) < slack) domain[3] = apex;
    }
    elementary_data data(kind, domain);
    data.first = first;
    data.second = second;
    put(data.origin, axes.Location().XYZ());
    put(data.x, axes.XDirection().XYZ());
    put(data.y, axes.YDirection().XYZ());
    put(data.z, axes.Direction().XYZ());
    return footpoint::support(data);
}

/** The part [first, last] of a curve with OCCT's parameters; nothing when it would need others. */
inline std::optional<footpoint::curve> curve_in_parameter(const Handle(Geom_Curve) &given, double first, double last) {
    Handle(Geom_Curve) shape = given;
    while (const auto trimmed = Handle(Geom_TrimmedCurve)::DownCast(shape)) shape = trimmed->BasisCurve();
    const auto arc = [&](const gp_Ax2 &axes, double major, double minor) -> std::optional<footpoint::curve> {
        if (last - first > 2 * std::acos(-1.0) * (1 + 1e-12)) return std::nullopt;
        const gp_XYZ c = axes.Location().XYZ(), x = axes.XDirection().XYZ() * major, y = axes.YDirection().XYZ() * minor;
        return footpoint::arc_by_angle({c.X(), c.Y(), c.Z()}, {x.X(), x.Y(), x.Z()}, {y.X(), y.Y(), y.Z()}, {first, last});
    };
    if (!Handle(Geom_Line)::DownCast(shape).IsNull()) {
        const gp_Pnt a = shape->Value(first), b = shape->Value(last);
        return footpoint::curve(1, {first, first, last, last}, {a.X(), a.Y(), a.Z(), b.X(), b.Y(), b.Z()});
    }
    if (const auto circle = Handle(Geom_Circle)::DownCast(shape)) return arc(circle->Position(), circle->Radius(), circle->Radius());
    if (const auto ellipse = Handle(Geom_Ellipse)::DownCast(shape))
        return arc(ellipse->Position(), ellipse->MajorRadius(), ellipse->MinorRadius());
    const bool is_polynomial = !Handle(Geom_BSplineCurve)::DownCast(shape).IsNull() ||
                               !Handle(Geom_BezierCurve)::DownCast(shape).IsNull() || !Handle(Geom_Parabola)::DownCast(shape).IsNull();
    if (!is_polynomial || first < shape->FirstParameter() || last > shape->LastParameter()) return std::nullopt;
    const Handle(Geom_BSplineCurve) spline = GeomConvert::CurveToBSplineCurve(new Geom_TrimmedCurve(shape, first, last));
    if (spline->IsPeriodic()) spline->SetNotPeriodic();
    // A part of a Bezier curve comes with the parameters 0 to 1.
    const double from = spline->FirstParameter(), to = spline->LastParameter();
    if (from != first || to != last) {
        TColStd_Array1OfReal knots(1, spline->NbKnots());
        spline->Knots(knots);
        for (int i = knots.Lower(); i <= knots.Upper(); i++) knots(i) = first + (knots(i) - from) * ((last - first) / (to - from));
        knots(knots.Lower()) = first, knots(knots.Upper()) = last;
        spline->SetKnots(knots);
    }
    return spline_in_space(spline);
}

/** A surface of revolution or extrusion on the rectangle that the curves of a face take; nothing when its curve needs other parameters. */
inline std::optional<footpoint::support> swept_of(const Handle(Geom_Surface) &surface, std::array<double, 4> domain) {
    const double turn = 2 * std::acos(-1.0);
    try {
        if (const auto turned = Handle(Geom_SurfaceOfRevolution)::DownCast(surface)) {
            std::optional<footpoint::curve> meridian = curve_in_parameter(turned->BasisCurve(), domain[2], domain[3]);
            if (!meridian) return std::nullopt;
            if (domain[1] - domain[0] > turn - Precision::PConfusion()) domain[1] = domain[0] + turn;
            elementary_data data(FPT_ELEMENTARY_REVOLUTION, domain);
            put(data.origin, turned->Axis().Location().XYZ());
            put(data.z, turned->Axis().Direction().XYZ());
            data.curve = meridian->get();
            return footpoint::support(data);
        }
        if (const auto moved = Handle(Geom_SurfaceOfLinearExtrusion)::DownCast(surface)) {
            std::optional<footpoint::curve> base = curve_in_parameter(moved->BasisCurve(), domain[0], domain[1]);
            if (!base) return std::nullopt;
            elementary_data data(FPT_ELEMENTARY_EXTRUSION, domain);
            put(data.z, moved->Direction().XYZ());
            data.curve = base->get();
            return footpoint::support(data);
        }
    } catch (const footpoint::error &) {
        // What is no curve or no elementary surface here still is a function.
    }
    return std::nullopt;
}

/** The surface of a face, its placement applied. */
inline footpoint::support support_of(const TopoDS_Face &face) {
    Handle(Geom_Surface) surface = BRep_Tool::Surface(face);
    if (surface.IsNull()) refuse("footpoint: the face has no surface");
    while (const auto trimmed = Handle(Geom_RectangularTrimmedSurface)::DownCast(surface)) surface = trimmed->BasisSurface();
    std::array<double, 4> uv{};
    BRepTools::UVBounds(face, uv[0], uv[1], uv[2], uv[3]);
    if (const auto plane = Handle(Geom_Plane)::DownCast(surface))
        return elementary_of(FPT_ELEMENTARY_PLANE, plane->Position(), 0, 0, uv);
    if (const auto cylinder = Handle(Geom_CylindricalSurface)::DownCast(surface))
        return elementary_of(FPT_ELEMENTARY_CYLINDER, cylinder->Position(), cylinder->Radius(), 0, uv);
    if (const auto cone = Handle(Geom_ConicalSurface)::DownCast(surface))
        return elementary_of(FPT_ELEMENTARY_CONE, cone->Position(), cone->RefRadius(), cone->SemiAngle(), uv);
    if (const auto sphere = Handle(Geom_SphericalSurface)::DownCast(surface))
        return elementary_of(FPT_ELEMENTARY_SPHERE, sphere->Position(), sphere->Radius(), 0, uv);
    if (const auto torus = Handle(Geom_ToroidalSurface)::DownCast(surface))
        return elementary_of(FPT_ELEMENTARY_TORUS, torus->Position(), torus->MajorRadius(), torus->MinorRadius(), uv);
    Handle(Geom_BSplineSurface) spline = Handle(Geom_BSplineSurface)::DownCast(surface);
    if (const auto bezier = Handle(Geom_BezierSurface)::DownCast(surface)) spline = GeomConvert::SurfaceToBSplineSurface(bezier);
    if (!spline.IsNull() && !spline->IsUPeriodic() && !spline->IsVPeriodic()) {
        std::vector<double> knots_u, knots_v, poles, weights;
        const auto knots = [](int count, auto knot, auto times, std::vector<double> &out) {
            for (int i = 1; i <= count; i++) out.insert(out.end(), std::size_t(times(i)), knot(i));
        };
        knots(spline->NbUKnots(), [&](int i) { return spline->UKnot(i); }, [&](int i) { return spline->UMultiplicity(i); }, knots_u);
        knots(spline->NbVKnots(), [&](int i) { return spline->VKnot(i); }, [&](int i) { return spline->VMultiplicity(i); }, knots_v);
        for (int i = 1; i <= spline->NbUPoles(); i++)
            for (int j = 1; j <= spline->NbVPoles(); j++) {
                const gp_Pnt p = spline->Pole(i, j);
                poles.insert(poles.end(), {p.X(), p.Y(), p.Z()});
                weights.push_back(spline->Weight(i, j));
            }
        if (!spline->IsURational() && !spline->IsVRational()) weights.clear();
        return footpoint::support(footpoint::surface(std::size_t(spline->UDegree()), std::size_t(spline->VDegree()), knots_u,
                                                     knots_v, poles, weights));
    }
    if (auto swept = swept_of(surface, uv)) return std::move(*swept);
    return footpoint::support(called(surface, {uv[0], uv[1]}, {uv[2], uv[3]}, gp_Trsf()));
}

/** The curve of an edge in space; whether it has OCCT's parameters. */
inline footpoint::curve edge_curve(const Handle(Geom_Curve) &given, double first, double last, bool &same) {
    auto found = curve_in_parameter(given, first, last);
    same = found.has_value();
    if (same) return std::move(*found);
    return spline_in_space(GeomConvert::CurveToBSplineCurve(new Geom_TrimmedCurve(given, first, last)));
}

} // namespace detail

/** A face of OCCT as a trimmed surface; see the head of this file. */
inline trimmed_surface trimmed(const TopoDS_Face &given) {
    const TopoDS_Face face = TopoDS::Face(given.Oriented(TopAbs_FORWARD));
    const footpoint::support shape = detail::support_of(face);
    TopTools_IndexedMapOfShape map;
    TopExp::MapShapes(face, TopAbs_EDGE, map);
    std::vector<footpoint::curve> curves;
    std::vector<int> curve_of(std::size_t(map.Extent()), -1);
    std::vector<char> same(curve_of.size(), 0), used(curve_of.size(), 0);
    std::vector<fpt_edge_data> edges;
    std::vector<std::size_t> number(curve_of.size(), 0);
    std::list<detail::pcurve_data> kept;
    std::vector<std::vector<fpt_coedge_data>> chains;
    std::vector<char> inner;
    const TopoDS_Wire outer = BRepTools::OuterWire(face);
    for (TopExp_Explorer wires(face, TopAbs_WIRE); wires.More(); wires.Next()) {
        const TopoDS_Wire wire = TopoDS::Wire(wires.Current());
        std::vector<fpt_coedge_data> chain;
        for (BRepTools_WireExplorer walk(wire, face); walk.More(); walk.Next()) {
            const TopoDS_Edge &edge = walk.Current();
            const bool turned = edge.Orientation() == TopAbs_REVERSED;
            double first = 0, last = 0;
            const Handle(Geom2d_Curve) pcurve = BRep_Tool::CurveOnSurface(edge, face, first, last);
            if (pcurve.IsNull()) detail::refuse("footpoint: an edge of the face has no curve in its domain");
            if (!(first < last)) detail::refuse("footpoint: the range of an edge is empty or backwards: BRepCheck_Analyzer refuses it too");
            detail::pcurve_data &data = kept.emplace_back();
            detail::pcurve_of(pcurve, first, last, turned, data);
            const std::size_t k = std::size_t(map.FindIndex(edge)) - 1;
            if (!used[k]) {
                used[k] = 1;
                number[k] = edges.size();
                fpt_edge_data row{};
                double from = 0, to = 0;
                const Handle(Geom_Curve) curve = BRep_Tool::Curve(edge, from, to);
                if (BRep_Tool::Degenerated(edge) || curve.IsNull()) {
                    detail::put(row.point, BRep_Tool::Pnt(TopExp::FirstVertex(edge)).XYZ());
                    same[k] = 1;
                } else {
                    bool keeps = false;
                    curve_of[k] = int(curves.size());
                    curves.push_back(detail::edge_curve(curve, from, to, keeps));
                    same[k] = keeps && BRep_Tool::SameParameter(edge);
                }
                edges.push_back(row);
            }
            data.data.edge = number[k];
            data.data.flags = (turned ? std::uint32_t(FPT_COEDGE_REVERSED) : 0u) |
                              (same[k] ? std::uint32_t(FPT_COEDGE_SAME_PARAMETER) : 0u);
            data.data.points = data.points.data();
            data.data.parameters = data.parameters.data();
            data.data.point_count = data.points.size() / 2;
            data.data.curve = data.curves.empty() ? nullptr : data.curves[0].get();
            chain.push_back(data.data);
        }
        if (chain.empty()) continue;
        chains.push_back(std::move(chain));
        inner.push_back(!wire.IsSame(outer));
    }
    for (std::size_t k = 0; k < curve_of.size(); k++)
        if (used[k] && curve_of[k] >= 0) edges[number[k]].curve = curves[std::size_t(curve_of[k])].get();
    std::vector<fpt_loop_data> loops;
    for (std::size_t k = 0; k < chains.size(); k++) {
        fpt_loop_data row{};
        row.is_inner = inner[k] ? 1 : 0;
        row.coedges = chains[k].data();
        row.coedge_count = chains[k].size();
        loops.push_back(row);
    }
    fpt_trim_data data{};
    data.struct_size = sizeof data;
    data.support = shape.get();
    data.edges = edges.data();
    data.edge_count = edges.size();
    data.loops = loops.data();
    data.loop_count = loops.size();
    data.flipped = given.Orientation() == TopAbs_REVERSED ? 1 : 0;
    return trimmed_surface(data);
}

} // namespace footpoint::occt

#endif
