/*
 * footpoint for OpenCASCADE 7.6 and newer, C++17, header only. SPDX-License-Identifier: MIT OR Apache-2.0
 *
 *   footpoint::occt::curve, surface      a Geom_Curve, Geom_Surface, TopoDS_Edge or TopoDS_Face, asked through footpoint; answers
 *                                        in OCCT's own parameters and types
 *   footpoint::occt::GeomAPI_ProjectPointOnCurve, GeomAPI_ProjectPointOnSurf, ShapeAnalysis_Surface
 *                                        the classes of these names with the same methods; a caller changes its include and
 *                                        writes `using footpoint::occt::GeomAPI_ProjectPointOnSurf;` in its namespace or function
 *
 * What comes how:
 *   exact   B-splines and Beziers (pole by pole; periodic ones unrolled), lines, conics, planes, cylinders, cones, spheres, tori,
 *           surfaces of revolution and extrusion of all these, trimmed ones; offsets of elementary surfaces. Angles are rational
 *           arcs in footpoint and come back as angles. Answers are proven.
 *   by      offset curves and surfaces, plates and what else derives from Geom_Curve and Geom_Surface: OCCT evaluates. Answers
 *   call    are found and carry FPT_FOOT_NOT_PROVEN. They must be bounded.
 * Unbounded directions (planes, cylinders, lines, ...) are converted where a query needs them, and again when one lies farther out.
 * Revolutions of unbounded lines and conics work too; an extrusion of an unbounded conic must be given a range.
 *
 * Failures are OCCT's exceptions with footpoint's text: Standard_NullObject (no shape), Standard_ConstructionError (a bad shape
 * or range), Standard_OutOfRange (an index), StdFail_NotDone (no answer: a query that is not finite), Standard_OutOfMemory.
 * An object belongs to one thread at a time; several threads take a copy each.
 *
 * What the drop-in classes do otherwise than OCCT's own:
 *   - borders count: the nearest point exists for each query, on an edge or corner too. OCCT lists orthogonal projections only and
 *     has none where the nearest point is on a border;
 *   - the lists are complete or IsComplete() is false; nearest first; with borders, saddles, and the apex of a cone. An arc or
 *     region of equally near points is one entry;
 *   - tolerances, precisions and Extrema_ExtAlgo change nothing: every answer is refined to the limit of the arithmetic;
 *   - Extrema() is missing: there is no Extrema_ExtPC or Extrema_ExtPS behind. IsProven(), LowerBound(), IsComplete() are new.
 */
#ifndef FOOTPOINT_OCCT_HXX
#define FOOTPOINT_OCCT_HXX

#include "footpoint.hpp"

#include <BRepTools.hxx>
#include <BRep_Tool.hxx>
#include <ElCLib.hxx>
#include <Extrema_ExtAlgo.hxx>
#include <Extrema_ExtFlag.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_BezierCurve.hxx>
#include <Geom_BezierSurface.hxx>
#include <Geom_Circle.hxx>
#include <Geom_ConicalSurface.hxx>
#include <Geom_CylindricalSurface.hxx>
#include <Geom_Ellipse.hxx>
#include <Geom_Hyperbola.hxx>
#include <Geom_Line.hxx>
#include <Geom_OffsetSurface.hxx>
#include <Geom_Parabola.hxx>
#include <Geom_Plane.hxx>
#include <Geom_RectangularTrimmedSurface.hxx>
#include <Geom_SphericalSurface.hxx>
#include <Geom_SurfaceOfLinearExtrusion.hxx>
#include <Geom_SurfaceOfRevolution.hxx>
#include <Geom_ToroidalSurface.hxx>
#include <Geom_TrimmedCurve.hxx>
#include <Precision.hxx>
#include <ShapeAnalysis_Surface.hxx>
#include <Standard_ConstructionError.hxx>
#include <Standard_NullObject.hxx>
#include <Standard_OutOfMemory.hxx>
#include <Standard_OutOfRange.hxx>
#include <StdFail_NotDone.hxx>
#include <TopLoc_Location.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <gp_Pnt.hxx>
#include <gp_Pnt2d.hxx>
#include <gp_Trsf.hxx>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace footpoint::occt {

/** A foot in OCCT's parameters. */
struct foot {
    /** On a curve V is 0. */
    Standard_Real U = 0, V = 0;
    /** The shape there, as footpoint evaluates it. */
    gp_Pnt Point;
    Standard_Real Distance = 0;
    /** Nothing on the shape is nearer; 0 without proof. */
    Standard_Real LowerBound = 0;
    /** Sum of fpt_foot_flag values. EDGE and CORNER are those of the shape and range that were given, as far as it is bounded. */
    std::uint32_t Flags = 0;

    bool IsProven() const noexcept { return (Flags & (FPT_FOOT_NOT_PROVEN | FPT_FOOT_BAD_QUERY)) == 0; }
};

/** A member of a set: its foot, and the parameters that belong to it. */
struct member : foot {
    std::array<Standard_Real, 2> URange{}, VRange{};
    /** A value of fpt_member_kind. */
    std::uint32_t Kind = FPT_MEMBER_POINT;
    /** A value of fpt_member_nature. */
    std::uint32_t Nature = FPT_NATURE_MINIMUM;
};

/** A set: complete, or what was found of it. */
struct members {
    std::vector<member> List;
    bool IsComplete = true;
};

/** Conversion; not for callers. */
namespace detail {

struct range {
    double low, high;
};

inline bool open(double x) { return Precision::IsInfinite(x); }
inline range everything() { return {-Precision::Infinite(), Precision::Infinite()}; }

[[noreturn]] inline void refuse(const std::string &text) { throw Standard_ConstructionError(text.c_str()); }

/** Calls footpoint; its failures become OCCT's. */
template <class Call>
auto asked(Call call) {
    try {
        return call();
    } catch (const error &failure) {
        const std::string text = std::string("footpoint: ") + failure.what();
        if (failure.status() == FPT_OUT_OF_MEMORY) throw Standard_OutOfMemory(text.c_str());
        refuse(text);
    }
}

/** The part of a range that is asked for; a direction with a period takes any range, at most a period long. */
inline range common(const range &whole, const range &part, double period, const char *name) {
    if (!(part.low < part.high)) refuse(std::string(name) + ": the range is empty");
    if (period > 0 && !open(part.low) && !open(part.high)) return {part.low, std::min(part.high, part.low + period)};
    const range out{std::max(whole.low, part.low), std::min(whole.high, part.high)};
    if (!(out.low < out.high)) refuse(std::string(name) + ": the range lies outside of the shape");
    return out;
}

/** One direction of a shape: its relation between OCCT's parameter and footpoint's. */
struct direction {
    enum class relation { same, arcs, exponential } kind = relation::same;
    /** OCCT's parameters that are looked at. */
    range used{0, 1};
    /** Footpoint's domain. */
    range whole{0, 1};
    /** OCCT's parameters at the joints of arcs. */
    std::vector<double> joints;

    /**
     * An arc of angle 2a, ((1-s) + s exp(ia))^2 in the plane of complex numbers with the weight 1 - 2s(1-s)(1 - cos a), has
     * the angle 2 atan2(s sin a, 1 - s + s cos a) at s.
     */
    double to_occt(double t) const {
        if (kind == relation::exponential) return std::clamp(std::log(t), used.low, used.high);
        if (kind == relation::same) return std::clamp(t, used.low, used.high);
        const std::size_t k = arc(t);
        const double low = joints[k], high = joints[k + 1], s = (t - low) / (high - low), a = (high - low) / 2;
        return std::clamp(low + 2 * std::atan2(s * std::sin(a), 1 - s + s * std::cos(a)), low, high);
    }
    double from_occt(double u) const {
        const double x = std::clamp(u, used.low, used.high);
        if (kind == relation::same) return x;
        if (kind == relation::exponential) return std::clamp(std::exp(x), whole.low, whole.high);
        const std::size_t k = arc(x);
        const double low = joints[k], high = joints[k + 1], a = (high - low) / 2, t = (x - low) / 2;
        const double s = std::sin(t) / (std::sin(t) + std::sin(a - t));
        return x == high ? high : std::clamp(low + s * (high - low), low, high);
    }

private:
    std::size_t arc(double x) const {
        const auto above = std::upper_bound(joints.begin() + 1, joints.end() - 1, x);
        return std::size_t(above - joints.begin()) - 1;
    }
};

/** A rational curve, and a direction that goes along it. */
struct profile {
    std::size_t degree = 1;
    std::vector<double> knots;
    std::vector<gp_XYZ> poles;
    std::vector<double> weights;
    direction along;
};

/** A rational surface: pole (i,j) is number i*(poles in v) + j. */
struct net {
    std::size_t degree[2] = {1, 1};
    std::vector<double> knots[2];
    std::vector<gp_XYZ> poles;
    std::vector<double> weights;
    direction along[2];
};

inline profile segment(const gp_XYZ &origin, const gp_XYZ &step, const range &used) {
    profile out;
    out.knots = {used.low, used.low, used.high, used.high};
    out.poles = {origin + step * used.low, origin + step * used.high};
    out.weights = {1, 1};
    out.along.used = out.along.whole = used;
    return out;
}

/** centre + cos(u) x + sin(u) y. */
inline profile arcs(const gp_XYZ &centre, const gp_XYZ &x, const gp_XYZ &y, const range &used) {
    const double turn = used.high - used.low;
    const int count = std::max(1, int(std::ceil(turn / M_PI_2 - 1e-9)));
    const double half = turn / count / 2;
    profile out;
    out.degree = 2;
    out.along.kind = direction::relation::arcs;
    out.along.used = out.along.whole = used;
    const auto at = [&](double angle, double far) { return centre + (x * std::cos(angle) + y * std::sin(angle)) * far; };
    for (int k = 0; k <= count; k++) {
        const double joint = k == count ? used.high : used.low + 2 * half * k;
        out.along.joints.push_back(joint);
        out.knots.insert(out.knots.end(), k == 0 || k == count ? 3 : 2, joint);
        out.poles.push_back(at(joint, 1));
        out.weights.push_back(1);
        if (k < count) {
            out.poles.push_back(at(used.low + half * (2 * k + 1), 1 / std::cos(half)));
            out.weights.push_back(std::cos(half));
        }
    }
    if (std::abs(turn - 2 * M_PI) < 1e-14) out.poles.back() = out.poles.front();
    return out;
}

/** vertex + u^2/(4 focal) x + u y, with knots that are closer where the curve is smaller, so that far ends do not cost accuracy. */
inline profile parabola(const gp_XYZ &vertex, const gp_XYZ &x, const gp_XYZ &y, double focal, const range &used) {
    std::vector<double> joints{used.low, used.high};
    const auto add = [&](double u) {
        if (u > used.low && u < used.high) joints.push_back(u);
    };
    add(0);
    for (double u = focal; u < std::max(-used.low, used.high); u *= 4) add(u), add(-u);
    std::sort(joints.begin(), joints.end());
    profile out;
    out.degree = 2;
    out.knots.assign(2, used.low);
    out.knots.insert(out.knots.end(), joints.begin(), joints.end());
    out.knots.insert(out.knots.end(), 2, used.high);
    for (std::size_t i = 0; i + 3 < out.knots.size(); i++) {
        const double p = out.knots[i + 1], q = out.knots[i + 2];
        out.poles.push_back(vertex + x * (p * q / (4 * focal)) + y * ((p + q) / 2));
        out.weights.push_back(1);
    }
    out.along.used = out.along.whole = used;
    return out;
}

/** centre + cosh(u) x + sinh(u) y: with t = exp(u) a rational curve of t with the weight 2t. */
inline profile hyperbola(const gp_XYZ &centre, const gp_XYZ &x, const gp_XYZ &y, const range &used) {
    const int count = std::max(1, int(std::ceil(used.high - used.low)));
    profile out;
    out.degree = 2;
    out.along.kind = direction::relation::exponential;
    out.along.used = used;
    const auto add = [&](double p, double q) {
        out.poles.push_back(centre + x * ((p * q + 1) / (p + q)) + y * ((p * q - 1) / (p + q)));
        out.weights.push_back(p + q);
    };
    double before = 0;
    for (int k = 0; k <= count; k++) {
        const double t = std::exp(k == count ? used.high : used.low + (used.high - used.low) * k / count);
        if (k > 0) add(before, t);
        add(t, t);
        out.knots.insert(out.knots.end(), k == 0 || k == count ? 3 : 2, t);
        before = t;
    }
    out.along.whole = {out.knots.front(), out.knots.back()};
    return out;
}

/** Written-out knots and the numbers of the poles that go with them (from 1), for a part of a direction of a B-spline. */
struct unrolled {
    std::vector<double> knots;
    std::vector<int> poles;
    direction along;

    unrolled(const TColStd_Array1OfReal &values, const TColStd_Array1OfInteger &repeats, int degree, bool periodic,
             const range &part) {
        std::vector<double> flat;
        const int last = periodic ? values.Upper() - 1 : values.Upper();
        for (int i = values.Lower(); i <= last; i++) flat.insert(flat.end(), std::size_t(repeats(i)), values(i));
        const int size = int(flat.size());
        if (!periodic) {
            const int count = size - degree - 1;
            knots = flat;
            for (int i = 1; i <= count; i++) poles.push_back(i);
            along.whole = {flat[std::size_t(degree)], flat[std::size_t(count)]};
            along.used = {std::max(part.low, along.whole.low), std::min(part.high, along.whole.high)};
            return;
        }
        // The knots of all turns: number i of turn q is number q*size + i. The domain begins at the last repeat of the first knot,
        // and pole j belongs to the knots from number j - degree + first - 1 on.
        const int first = repeats(repeats.Lower());
        const double begin = values(values.Lower()), end = values(values.Upper()), period = end - begin;
        const auto knot = [&](int i) {
            const int turn = int(std::floor(double(i) / size)), k = i - turn * size;
            return k < first && turn > 0 ? end + (turn - 1) * period : flat[std::size_t(k)] + turn * period;
        };
        int low = int(std::floor((part.low - begin) / period)) * size - size;
        while (knot(low + 1) <= part.low) low++;
        int high = low;
        while (knot(high + 1) < part.high) high++;
        const int shift = degree - first + 1;
        for (int i = low - degree; i <= high + degree + 1; i++) knots.push_back(knot(i));
        for (int i = low + shift - degree; i <= high + shift; i++) poles.push_back(((i % size) + size) % size + 1);
        along.whole = {knot(low), knot(high + 1)};
        along.used = part;
    }
};

inline Handle(Geom_Curve) basis(Handle(Geom_Curve) shape) {
    while (auto trimmed = Handle(Geom_TrimmedCurve)::DownCast(shape)) shape = trimmed->BasisCurve();
    return shape;
}
inline Handle(Geom_Surface) basis(Handle(Geom_Surface) shape) {
    while (auto trimmed = Handle(Geom_RectangularTrimmedSurface)::DownCast(shape)) shape = trimmed->BasisSurface();
    return shape;
}

/** The profile of a curve between finite parameters; none: OCCT has to evaluate. */
inline std::optional<profile> profile_of(const Handle(Geom_Curve) &shape, const range &used) {
    const Handle(Geom_Curve) curve = basis(shape);
    if (auto c = Handle(Geom_Line)::DownCast(curve))
        return segment(c->Position().Location().XYZ(), c->Position().Direction().XYZ(), used);
    if (auto c = Handle(Geom_Conic)::DownCast(curve)) {
        const gp_Ax2 &place = c->Position();
        const gp_XYZ at = place.Location().XYZ(), x = place.XDirection().XYZ(), y = place.YDirection().XYZ();
        if (auto k = Handle(Geom_Circle)::DownCast(c)) return arcs(at, x * k->Radius(), y * k->Radius(), used);
        if (auto k = Handle(Geom_Ellipse)::DownCast(c)) return arcs(at, x * k->MajorRadius(), y * k->MinorRadius(), used);
        if (auto k = Handle(Geom_Parabola)::DownCast(c)) return parabola(at, x, y, k->Focal(), used);
        if (auto k = Handle(Geom_Hyperbola)::DownCast(c))
            return hyperbola(at, x * k->MajorRadius(), y * k->MinorRadius(), used);
    }
    profile out;
    if (auto c = Handle(Geom_BezierCurve)::DownCast(curve)) {
        out.degree = std::size_t(c->Degree());
        out.knots.assign(out.degree + 1, 0);
        out.knots.insert(out.knots.end(), out.degree + 1, 1);
        for (int i = 1; i <= c->NbPoles(); i++) {
            out.poles.push_back(c->Pole(i).XYZ());
            out.weights.push_back(c->Weight(i));
        }
        out.along.used = used;
        return out;
    }
    if (auto c = Handle(Geom_BSplineCurve)::DownCast(curve)) {
        out.degree = std::size_t(c->Degree());
        unrolled part(c->Knots(), c->Multiplicities(), c->Degree(), c->IsPeriodic(), used);
        out.knots = part.knots;
        out.along = part.along;
        for (int i : part.poles) {
            out.poles.push_back(c->Pole(i).XYZ());
            out.weights.push_back(c->Weight(i));
        }
        return out;
    }
    return std::nullopt;
}

/** The curve turned about an axis: u is the angle, v goes along it. */
inline net revolved(const profile &meridian, const gp_Ax1 &axis, const range &angles) {
    const gp_XYZ origin = axis.Location().XYZ(), z = axis.Direction().XYZ();
    double size = 0;
    for (const gp_XYZ &pole : meridian.poles) size = std::max(size, (pole - origin).Modulus());
    net out;
    std::vector<profile> circles;
    for (const gp_XYZ &pole : meridian.poles) {
        const gp_XYZ arm = pole - origin;
        const gp_XYZ centre = origin + z * arm.Dot(z);
        gp_XYZ x = arm - z * arm.Dot(z);
        // What is left of a pole on the axis after rounding.
        if (x.Modulus() <= 4e-16 * size) x = gp_XYZ(0, 0, 0);
        circles.push_back(arcs(centre, x, z.Crossed(x), angles));
    }
    out.degree[0] = 2;
    out.degree[1] = meridian.degree;
    out.knots[0] = circles[0].knots;
    out.knots[1] = meridian.knots;
    out.along[0] = circles[0].along;
    out.along[1] = meridian.along;
    for (std::size_t i = 0; i < circles[0].poles.size(); i++) {
        for (std::size_t j = 0; j < circles.size(); j++) {
            out.poles.push_back(circles[j].poles[i]);
            out.weights.push_back(circles[0].weights[i] * meridian.weights[j]);
        }
    }
    return out;
}

/** The curve moved along a direction: u goes along the curve, v is the length of the way. */
inline net extruded(const profile &curve, const gp_XYZ &way, const range &lengths) {
    const profile line = segment(gp_XYZ(0, 0, 0), way, lengths);
    net out;
    out.degree[0] = curve.degree;
    out.knots[0] = curve.knots;
    out.knots[1] = line.knots;
    out.along[0] = curve.along;
    out.along[1] = line.along;
    for (std::size_t i = 0; i < curve.poles.size(); i++) {
        for (const gp_XYZ &step : line.poles) {
            out.poles.push_back(curve.poles[i] + step);
            out.weights.push_back(curve.weights[i]);
        }
    }
    return out;
}

/** An elementary surface of revolution in the words of the general one: its meridian at u = 0 and its axis. */
struct turned {
    Handle(Geom_Curve) meridian;
    gp_Ax1 axis;
};
inline std::optional<turned> turned_of(const Handle(Geom_Surface) &surface) {
    if (auto s = Handle(Geom_SurfaceOfRevolution)::DownCast(surface)) return turned{s->BasisCurve(), s->Axis()};
    const auto s = Handle(Geom_ElementarySurface)::DownCast(surface);
    if (s.IsNull() || s->IsKind(STANDARD_TYPE(Geom_Plane))) return std::nullopt;
    const gp_Ax3 &place = s->Position();
    // Left-handed places turn the other way round.
    const gp_Dir z = place.Direct() ? place.Direction() : place.Direction().Reversed();
    const gp_XYZ at = place.Location().XYZ(), x = place.XDirection().XYZ(), up = place.Direction().XYZ();
    const auto line = [&](double radius, const gp_XYZ &way) -> Handle(Geom_Curve) {
        return new Geom_Line(gp_Pnt(at + x * radius), gp_Dir(way));
    };
    const auto circle = [&](double from_axis, double radius) -> Handle(Geom_Curve) {
        const gp_Dir normal(gp_Vec(x).Crossed(gp_Vec(up)));
        return new Geom_Circle(gp_Ax2(gp_Pnt(at + x * from_axis), normal, gp_Dir(x)), radius);
    };
    turned out{nullptr, gp_Ax1(place.Location(), z)};
    if (auto k = Handle(Geom_CylindricalSurface)::DownCast(s)) out.meridian = line(k->Radius(), up);
    if (auto k = Handle(Geom_ConicalSurface)::DownCast(s))
        out.meridian = line(k->RefRadius(), x * std::sin(k->SemiAngle()) + up * std::cos(k->SemiAngle()));
    if (auto k = Handle(Geom_SphericalSurface)::DownCast(s)) out.meridian = circle(0, k->Radius());
    if (auto k = Handle(Geom_ToroidalSurface)::DownCast(s)) out.meridian = circle(k->MajorRadius(), k->MinorRadius());
    if (out.meridian.IsNull()) return std::nullopt;
    return out;
}

/** The elementary surface that an offset is, when it has the same parameters: looked at in nine places. */
inline Handle(Geom_Surface) plain(const Handle(Geom_Surface) &surface) {
    const auto offset = Handle(Geom_OffsetSurface)::DownCast(surface);
    if (offset.IsNull() || !basis(offset->BasisSurface())->IsKind(STANDARD_TYPE(Geom_ElementarySurface))) return surface;
    const Handle(Geom_Surface) same = offset->Surface();
    if (same.IsNull()) return surface;
    range box[2];
    offset->Bounds(box[0].low, box[0].high, box[1].low, box[1].high);
    for (range &r : box) r = {open(r.low) ? -1 : r.low, open(r.high) ? 1 : r.high};
    for (int i = 0; i < 9; i++) {
        const double u = box[0].low + (box[0].high - box[0].low) * (0.1 + 0.4 * (i / 3));
        const double v = box[1].low + (box[1].high - box[1].low) * (0.1 + 0.4 * (i % 3));
        const gp_Pnt a = offset->Value(u, v), b = same->Value(u, v);
        if (a.Distance(b) > 1e-13 * (1 + a.XYZ().Modulus())) return surface;
    }
    return same;
}

/** The net of a surface between finite parameters; none: OCCT has to evaluate. */
inline std::optional<net> net_of(const Handle(Geom_Surface) &surface, const range &u, const range &v) {
    if (auto s = Handle(Geom_Plane)::DownCast(surface)) {
        const gp_Ax3 &place = s->Position();
        return extruded(segment(place.Location().XYZ(), place.XDirection().XYZ(), u), place.YDirection().XYZ(), v);
    }
    if (auto s = Handle(Geom_SurfaceOfLinearExtrusion)::DownCast(surface)) {
        const auto curve = profile_of(s->BasisCurve(), u);
        if (!curve) return std::nullopt;
        return extruded(*curve, s->Direction().XYZ(), v);
    }
    if (const auto s = turned_of(surface)) {
        const auto meridian = profile_of(s->meridian, v);
        if (!meridian) return std::nullopt;
        return revolved(*meridian, s->axis, u);
    }
    net out;
    if (auto s = Handle(Geom_BezierSurface)::DownCast(surface)) {
        out.degree[0] = std::size_t(s->UDegree());
        out.degree[1] = std::size_t(s->VDegree());
        for (int k = 0; k < 2; k++) {
            out.knots[k].assign(out.degree[k] + 1, 0);
            out.knots[k].insert(out.knots[k].end(), out.degree[k] + 1, 1);
        }
        out.along[0].used = u;
        out.along[1].used = v;
        for (int i = 1; i <= s->NbUPoles(); i++) {
            for (int j = 1; j <= s->NbVPoles(); j++) {
                out.poles.push_back(s->Pole(i, j).XYZ());
                out.weights.push_back(s->Weight(i, j));
            }
        }
        return out;
    }
    if (auto s = Handle(Geom_BSplineSurface)::DownCast(surface)) {
        const unrolled in_u(s->UKnots(), s->UMultiplicities(), s->UDegree(), s->IsUPeriodic(), u);
        const unrolled in_v(s->VKnots(), s->VMultiplicities(), s->VDegree(), s->IsVPeriodic(), v);
        out.degree[0] = std::size_t(s->UDegree());
        out.degree[1] = std::size_t(s->VDegree());
        out.knots[0] = in_u.knots;
        out.knots[1] = in_v.knots;
        out.along[0] = in_u.along;
        out.along[1] = in_v.along;
        for (int i : in_u.poles) {
            for (int j : in_v.poles) {
                out.poles.push_back(s->Pole(i, j).XYZ());
                out.weights.push_back(s->Weight(i, j));
            }
        }
        return out;
    }
    return std::nullopt;
}

/**
 * The parameters of an unbounded curve that can be feet of a point, turned about an axis by any angle where there is one.
 * Lines: (q - origin).direction. Conics: the roots of the condition of stationarity, bounded for all points as far from
 * the vertex (Fujiwara's bound of the cubic for the parabola), and some room.
 */
inline range feet_on(const Handle(Geom_Curve) &shape, const gp_Pnt &query, const gp_Ax1 *axis) {
    const Handle(Geom_Curve) curve = basis(shape);
    gp_XYZ q = query.XYZ();
    double arm = 0;
    gp_XYZ z;
    if (axis != nullptr) {
        z = axis->Direction().XYZ();
        const gp_XYZ origin = axis->Location().XYZ(), way = q - origin;
        q = origin + z * way.Dot(z);
        arm = (way - z * way.Dot(z)).Modulus();
    }
    if (auto c = Handle(Geom_Line)::DownCast(curve)) {
        const gp_XYZ d = c->Position().Direction().XYZ();
        const double middle = (q - c->Position().Location().XYZ()).Dot(d);
        const double reach = axis == nullptr ? 0 : arm * (d - z * d.Dot(z)).Modulus();
        return {middle - reach, middle + reach};
    }
    const auto conic = Handle(Geom_Conic)::DownCast(curve);
    if (conic.IsNull()) refuse("a curve of this kind must be given a range");
    const double far = (q - conic->Position().Location().XYZ()).Modulus() + arm;
    double reach = 0;
    if (auto c = Handle(Geom_Parabola)::DownCast(conic)) {
        const double f = c->Focal(), linear = 8 * f * f + 4 * f * far, constant = 8 * f * f * far;
        reach = 2 * std::max(std::sqrt(linear), std::cbrt(constant)) + f;
    } else if (auto h = Handle(Geom_Hyperbola)::DownCast(conic)) {
        const double a = h->MajorRadius(), b = h->MinorRadius();
        reach = std::asinh(far * (a + b) / (a * a + b * b)) + 0.5;
    } else {
        refuse("a curve of this kind must be given a range");
    }
    return {-reach, reach};
}

/** The same for both directions of a surface; bounded directions keep their range. */
inline void feet_on(const Handle(Geom_Surface) &surface, const gp_Pnt &q, range &u, range &v) {
    const bool open_u = open(u.low) || open(u.high), open_v = open(v.low) || open(v.high);
    Handle(Geom_Curve) curve;
    gp_XYZ way;
    if (auto s = Handle(Geom_Plane)::DownCast(surface)) {
        curve = new Geom_Line(s->Location(), s->Position().XDirection());
        way = s->Position().YDirection().XYZ();
    } else if (auto e = Handle(Geom_SurfaceOfLinearExtrusion)::DownCast(surface)) {
        curve = basis(e->BasisCurve());
        way = e->Direction().XYZ();
    } else if (const auto t = turned_of(surface)) {
        if (open_v) v = feet_on(t->meridian, q, &t->axis);
        return;
    } else {
        refuse("a surface of this kind must be given a range");
    }
    if (open_u) {
        const auto line = Handle(Geom_Line)::DownCast(curve);
        if (line.IsNull()) refuse("an extrusion of this curve must be given a range");
        // The line without its part along the way, and the foot of the query on that.
        const gp_XYZ d = line->Position().Direction().XYZ(), across = d - way * d.Dot(way);
        const double foot = (q.XYZ() - line->Position().Location().XYZ()).Dot(across) / across.SquareModulus();
        if (!std::isfinite(foot)) refuse("the line is extruded along itself");
        const bool below = !open(u.low) && foot < u.low, above = !open(u.high) && foot > u.high;
        u = below ? range{u.low, u.low} : above ? range{u.high, u.high} : range{foot, foot};
    }
    if (open_v) {
        const auto part = profile_of(curve, u.low < u.high ? u : range{u.low, u.low + 1});
        if (!part) refuse("an extrusion of this curve must be given a range");
        range out{Precision::Infinite(), -Precision::Infinite()};
        const std::size_t count = u.low < u.high ? part->poles.size() : 1;
        for (std::size_t i = 0; i < count; i++) {
            const double length = (q.XYZ() - part->poles[i]).Dot(way);
            out = {std::min(out.low, length), std::max(out.high, length)};
        }
        v = out;
    }
}

/** A finite range that covers the feet of an unbounded one and what was covered before, with room around. */
inline range window(const range &bounds, const range &feet, const range *before, double room) {
    const bool low_open = open(bounds.low), high_open = open(bounds.high);
    range out{low_open ? feet.low - room : bounds.low, high_open ? feet.high + room : bounds.high};
    if (before != nullptr) out = {std::min(out.low, before->low), std::max(out.high, before->high)};
    if (low_open && out.low > out.high - room) out.low = out.high - room;
    if (high_open && out.high < out.low + room) out.high = out.low + room;
    return out;
}

inline bool covers(const range &bounds, const range &used, const range &feet) {
    const double slack = 0.01 * (used.high - used.low);
    return (!open(bounds.low) || feet.low >= used.low + slack || feet.low > used.high)
        && (!open(bounds.high) || feet.high <= used.high - slack || feet.high < used.low);
}

inline std::vector<double> numbers(const std::vector<gp_XYZ> &poles, const gp_Trsf &place) {
    std::vector<double> out;
    for (gp_XYZ pole : poles) {
        if (place.Form() != gp_Identity) place.Transforms(pole);
        out.insert(out.end(), {pole.X(), pole.Y(), pole.Z()});
    }
    return out;
}

inline std::vector<double> weights_of(const std::vector<double> &weights) {
    const bool polynomial = std::all_of(weights.begin(), weights.end(), [&](double w) { return w == weights[0]; });
    return polynomial ? std::vector<double>() : weights;
}

inline footpoint::curve made(const profile &p, const gp_Trsf &place) {
    return footpoint::curve(p.degree, p.knots, numbers(p.poles, place), weights_of(p.weights));
}
inline footpoint::surface made(const net &n, const gp_Trsf &place) {
    return footpoint::surface(n.degree[0], n.degree[1], n.knots[0], n.knots[1], numbers(n.poles, place),
                              weights_of(n.weights));
}

template <class... Vectors>
void write(double *out, const gp_Trsf &place, gp_Pnt point, Vectors... vectors) {
    point.Transform(place);
    out[0] = point.X(), out[1] = point.Y(), out[2] = point.Z();
    std::size_t k = 3;
    [[maybe_unused]] const auto add = [&](gp_Vec vector) {
        vector.Transform(place);
        out[k] = vector.X(), out[k + 1] = vector.Y(), out[k + 2] = vector.Z();
        k += 3;
    };
    (add(vectors), ...);
}

inline footpoint::curve called(const Handle(Geom_Curve) &curve, const range &u, const gp_Trsf &place) {
    const auto evaluate = [curve, place](double t, std::uint32_t order, double *out) {
        gp_Pnt p;
        gp_Vec d1, d2;
        if (order == 0) curve->D0(t, p), write(out, place, p);
        else if (order == 1) curve->D1(t, p, d1), write(out, place, p, d1);
        else curve->D2(t, p, d1, d2), write(out, place, p, d1, d2);
        return int(std::min<std::uint32_t>(order, 2));
    };
    return footpoint::curve::from_function(evaluate, {u.low, u.high});
}

inline footpoint::surface called(const Handle(Geom_Surface) &surface, const range &u, const range &v,
                                 const gp_Trsf &place) {
    const auto evaluate = [surface, place](double s, double t, std::uint32_t order, double *out) {
        gp_Pnt p;
        gp_Vec du, dv, duu, dvv, duv;
        if (order == 0) surface->D0(s, t, p), write(out, place, p);
        else if (order == 1) surface->D1(s, t, p, du, dv), write(out, place, p, du, dv);
        else surface->D2(s, t, p, du, dv, duu, dvv, duv), write(out, place, p, du, dv, duu, duv, dvv);
        return int(std::min<std::uint32_t>(order, 2));
    };
    return footpoint::surface::from_function(evaluate, {u.low, u.high, v.low, v.high});
}

inline bool finite(const gp_Pnt &p) {
    return std::abs(p.X()) <= 1e100 && std::abs(p.Y()) <= 1e100 && std::abs(p.Z()) <= 1e100;
}

} // namespace detail

/** What curve and surface share. */
template <class Shape, int Directions>
class asked_shape {
public:
    /** The nearest point; proven unless Flags says otherwise. A query that is not finite has FPT_FOOT_BAD_QUERY. */
    foot closest(const gp_Pnt &query, const fpt_query_options &options = single()) {
        return closest_many({query}, options)[0];
    }

    /** The same for many points, on all cores by default; the order is kept. Hints are not passed on. */
    std::vector<foot> closest_many(const std::vector<gp_Pnt> &queries,
                                   const fpt_query_options &options = query_options()) {
        cover(queries);
        std::vector<double> points;
        for (const gp_Pnt &q : queries) points.insert(points.end(), {q.X(), q.Y(), q.Z()});
        fpt_query_options used = restricted(options);
        used.hints = nullptr;
        used.point_stride = 0;
        std::vector<foot> out;
        for (const fpt_foot_point &found : detail::asked([&] { return shape_->closest(points, used); }))
            out.push_back(foot_of(found));
        return out;
    }

    /** The nearest point, found faster from parameters that are near. */
    foot closest_from(const gp_Pnt &query, Standard_Real u, Standard_Real v = 0) {
        cover({query});
        fpt_query_options used = restricted(single());
        const double hint[2] = {along_[0].from_occt(u), Directions == 2 ? along_[Directions - 1].from_occt(v) : 0};
        used.hints = hint;
        const std::vector<double> point{query.X(), query.Y(), query.Z()};
        return foot_of(detail::asked([&] { return shape_->closest(point, used); })[0]);
    }

    /** Every parameter whose point lies within the tolerance (0: 1e-7 x the diagonal of the box). */
    members preimage(const gp_Pnt &query, Standard_Real tolerance = 0) {
        cover({query});
        const point where{query.X(), query.Y(), query.Z()};
        return members_of(detail::asked([&] { return shape_->preimage(where, tolerance, restricted(single())); }));
    }

    /** Every point where the distance is stationary, borders included; nearest first. */
    members extrema(const gp_Pnt &query, const fpt_extrema_options &options = extrema_options()) {
        cover({query});
        fpt_extrema_options used = options;
        restrict(used.domain);
        const point where{query.X(), query.Y(), query.Z()};
        return members_of(detail::asked([&] { return shape_->extrema(where, used); }));
    }

    /** Footpoint's shape as it is now, in its own parameters; a shape with unbounded directions: what the queries needed. */
    const Shape &shape() {
        cover({});
        return *shape_;
    }

protected:
    /** Defaults on the calling thread. */
    static query_options single() {
        query_options out;
        out.threads = 1;
        return out;
    }

    virtual ~asked_shape() = default;
    asked_shape() = default;
    asked_shape(const asked_shape &) = default;
    asked_shape(asked_shape &&) = default;
    asked_shape &operator=(const asked_shape &) = default;
    asked_shape &operator=(asked_shape &&) = default;

    /** The finite part that is to be converted for a query; the ranges come as the bounds and are open where they are open. */
    virtual void needed(const gp_Pnt &query, detail::range *ranges) const = 0;
    /** Converts between finite parameters. */
    virtual void convert(const detail::range *ranges) = 0;

    bool is_open() const {
        for (int k = 0; k < Directions; k++)
            if (detail::open(bounds_[k].low) || detail::open(bounds_[k].high)) return true;
        return false;
    }

    void cover(const std::vector<gp_Pnt> &queries) {
        if (!is_open()) {
            if (!shape_) detail::asked([&] { convert(bounds_); return 0; });
            return;
        }
        for (gp_Pnt query : queries) {
            query.Transform(place_.Inverted());
            if (!detail::finite(query)) query = centre_;
            const double away = query.Distance(centre_);
            detail::range ranges[Directions], old[Directions];
            for (int k = 0; k < Directions; k++) ranges[k] = bounds_[k];
            needed(query, ranges);
            bool covered = shape_ != nullptr;
            for (int k = 0; k < Directions; k++) {
                old[k] = along_[k].used;
                const bool is_open = detail::open(bounds_[k].low) || detail::open(bounds_[k].high);
                if (covered && is_open) covered = detail::covers(bounds_[k], old[k], ranges[k]);
            }
            if (covered) continue;
            for (int k = 0; k < Directions; k++) {
                if (detail::open(bounds_[k].low) || detail::open(bounds_[k].high))
                    ranges[k] = detail::window(bounds_[k], ranges[k], shape_ ? &old[k] : nullptr,
                                               curved_ ? 0.25 * (ranges[k].high - ranges[k].low) : away > 0 ? away : 1);
                else
                    ranges[k] = bounds_[k];
            }
            detail::asked([&] { convert(ranges); return 0; });
        }
        if (!shape_) cover({centre_.Transformed(place_)});
    }

    /** Whether a parameter of footpoint is an end that only the conversion has. */
    bool is_cut(int k, double t) const {
        return (detail::open(bounds_[k].low) && t <= along_[k].whole.low)
            || (detail::open(bounds_[k].high) && t >= along_[k].whole.high);
    }

    void restrict(double *domain) const {
        bool whole = true;
        for (int k = 0; k < Directions; k++) {
            domain[2 * k] = along_[k].from_occt(along_[k].used.low);
            domain[2 * k + 1] = along_[k].from_occt(along_[k].used.high);
            whole = whole && domain[2 * k] <= along_[k].whole.low && domain[2 * k + 1] >= along_[k].whole.high;
        }
        if (whole) std::fill(domain, domain + 2 * Directions, 0.0);
    }
    fpt_query_options restricted(const fpt_query_options &options) const {
        fpt_query_options out = options;
        restrict(out.domain);
        return out;
    }

    foot foot_of(const fpt_foot_point &found) const {
        foot out;
        const bool good = (found.flags & FPT_FOOT_BAD_QUERY) == 0 && !std::isnan(found.u);
        out.U = good ? along_[0].to_occt(found.u) : found.u;
        out.V = Directions == 1 ? 0 : good ? along_[Directions - 1].to_occt(found.v) : found.v;
        out.Point = gp_Pnt(found.point[0], found.point[1], found.point[2]);
        out.Distance = found.distance;
        out.LowerBound = found.lower_bound;
        out.Flags = found.flags;
        return out;
    }

    /** The members but for those that only lie where an unbounded direction was cut. */
    members members_of(const foot_set &set) const {
        members out;
        out.IsComplete = set.is_complete();
        for (const fpt_foot_member &found : set) {
            if (is_cut(0, found.foot.u) || (Directions == 2 && is_cut(1, found.foot.v))) continue;
            member next;
            static_cast<foot &>(next) = foot_of(found.foot);
            for (int k = 0; k < 2; k++) {
                next.URange[std::size_t(k)] = along_[0].to_occt(found.u[k]);
                next.VRange[std::size_t(k)] = Directions == 1 ? 0 : along_[Directions - 1].to_occt(found.v[k]);
            }
            next.Kind = found.kind;
            next.Nature = found.nature;
            out.List.push_back(next);
        }
        return out;
    }

    /** OCCT's parameters that were given, perhaps without end. */
    detail::range bounds_[2] = {{0, 1}, {0, 1}};
    gp_Trsf place_;
    /** A point of the shape before it is placed, from which windows are measured. */
    gp_Pnt centre_;
    /** The open direction goes along a conic: its parameter is no length. */
    bool curved_ = false;
    std::shared_ptr<const Shape> shape_;
    detail::direction along_[2];
};

/** A Geom_Curve, or an edge where it lies. */
class curve : public asked_shape<footpoint::curve, 1> {
public:
    explicit curve(const Handle(Geom_Curve) &shape) : curve(shape, detail::everything(), gp_Trsf()) {}
    /** The part between two parameters; on a periodic curve any two, at most a period apart. */
    curve(const Handle(Geom_Curve) &shape, Standard_Real Umin, Standard_Real Usup)
        : curve(shape, detail::range{Umin, Usup}, gp_Trsf()) {}
    /** The edge's curve between its ends, where its location puts it. An edge without a curve in space is refused. */
    explicit curve(const TopoDS_Edge &edge) {
        if (edge.IsNull()) throw Standard_NullObject("edge: null");
        TopLoc_Location place;
        detail::range part{};
        const Handle(Geom_Curve) shape = BRep_Tool::Curve(edge, place, part.low, part.high);
        if (shape.IsNull()) detail::refuse("edge: it has no curve in space");
        *this = curve(shape, part, place.Transformation());
    }

private:
    curve(const Handle(Geom_Curve) &shape, const detail::range &part, const gp_Trsf &place) {
        if (shape.IsNull()) throw Standard_NullObject("curve: null");
        base_ = detail::basis(shape);
        place_ = place;
        const bool is_periodic = base_ == shape && shape->IsPeriodic();
        bounds_[0] = detail::common({shape->FirstParameter(), shape->LastParameter()}, part,
                                    is_periodic ? shape->Period() : 0, "U");
        if (is_open()) {
            curved_ = base_->IsKind(STANDARD_TYPE(Geom_Conic));
            const detail::range &u = bounds_[0];
            centre_ = base_->Value(!detail::open(u.low) ? u.low : !detail::open(u.high) ? u.high : 0);
        }
        cover({});
    }

    void needed(const gp_Pnt &query, detail::range *ranges) const override {
        ranges[0] = detail::feet_on(base_, query, nullptr);
    }
    void convert(const detail::range *ranges) override {
        if (const auto found = detail::profile_of(base_, ranges[0])) {
            shape_ = std::make_shared<const footpoint::curve>(detail::made(*found, place_));
            along_[0] = found->along;
            return;
        }
        shape_ = std::make_shared<const footpoint::curve>(detail::called(base_, ranges[0], place_));
        along_[0].used = along_[0].whole = ranges[0];
    }

    Handle(Geom_Curve) base_;
};

/** A Geom_Surface, or a face where it lies. */
class surface : public asked_shape<footpoint::surface, 2> {
public:
    explicit surface(const Handle(Geom_Surface) &shape)
        : surface(shape, detail::everything(), detail::everything(), gp_Trsf()) {}
    /** The part between parameters; in a periodic direction any two, at most a period apart. */
    surface(const Handle(Geom_Surface) &shape, Standard_Real Umin, Standard_Real Usup, Standard_Real Vmin,
            Standard_Real Vsup)
        : surface(shape, detail::range{Umin, Usup}, detail::range{Vmin, Vsup}, gp_Trsf()) {}
    /** The face's surface where its location puts it, in the rectangle of parameters that holds the face; what the wires cut
     *  off is there. */
    explicit surface(const TopoDS_Face &face) {
        if (face.IsNull()) throw Standard_NullObject("face: null");
        TopLoc_Location place;
        const Handle(Geom_Surface) shape = BRep_Tool::Surface(face, place);
        detail::range u{}, v{};
        BRepTools::UVBounds(face, u.low, u.high, v.low, v.high);
        *this = surface(shape, u, v, place.Transformation());
    }

    /** As closest_from, and the parameters go on from the ones before: past the ends of a period, to the nearer side of a seam,
     *  and on a collapsed edge the parameter along it stays. */
    foot next(const gp_Pnt2d &before, const gp_Pnt &query) {
        const double old[2] = {before.X(), before.Y()};
        double hint[2];
        for (int k = 0; k < 2; k++)
            hint[k] = period_[k] > 0 && std::isfinite(old[k])
                ? old[k] - std::floor((old[k] - bounds_[k].low) / period_[k]) * period_[k] : old[k];
        foot out = closest_from(query, hint[0], hint[1]);
        if ((out.Flags & FPT_FOOT_BAD_QUERY) != 0) return out;
        Standard_Real *found[2] = {&out.U, &out.V};
        for (int k = 0; k < 2; k++) {
            const bool is_finite = std::isfinite(old[k]), at_ends = out.Flags & (FPT_FOOT_EDGE | FPT_FOOT_CORNER);
            const detail::range &ends = bounds_[k];
            if (is_finite && period_[k] > 0)
                *found[k] += std::round((old[k] - *found[k]) / period_[k]) * period_[k];
            else if (is_finite && at_ends && closed_[k] && (*found[k] == ends.low || *found[k] == ends.high))
                *found[k] = std::abs(old[k] - ends.low) <= std::abs(old[k] - ends.high) ? ends.low : ends.high;
        }
        if ((out.Flags & FPT_FOOT_COLLAPSED) != 0) {
            const auto on = [&](int k, int edge) {
                return collapsed_[std::size_t(2 * k + edge)] && *found[k] == (edge == 0 ? bounds_[k].low : bounds_[k].high);
            };
            for (int k = 0; k < 2; k++) {
                const int other = 1 - k;
                if ((on(k, 0) || on(k, 1)) && std::isfinite(old[other]))
                    *found[other] = period_[other] > 0 ? old[other]
                                                       : std::clamp(old[other], bounds_[other].low, bounds_[other].high);
            }
        }
        return out;
    }

private:
    surface(const Handle(Geom_Surface) &shape, const detail::range &u, const detail::range &v, const gp_Trsf &place) {
        if (shape.IsNull()) throw Standard_NullObject("surface: null");
        base_ = detail::plain(detail::basis(shape));
        place_ = place;
        const bool is_whole = detail::basis(shape) == shape;
        detail::range whole[2];
        shape->Bounds(whole[0].low, whole[0].high, whole[1].low, whole[1].high);
        const double turn[2] = {is_whole && shape->IsUPeriodic() ? shape->UPeriod() : 0,
                                is_whole && shape->IsVPeriodic() ? shape->VPeriod() : 0};
        bounds_[0] = detail::common(whole[0], u, turn[0], "U");
        bounds_[1] = detail::common(whole[1], v, turn[1], "V");
        for (int k = 0; k < 2; k++) {
            const bool all = turn[k] > 0 && bounds_[k].high - bounds_[k].low >= turn[k] * (1 - 1e-15);
            period_[k] = all ? turn[k] : 0;
        }
        if (is_open()) {
            const auto turned = detail::turned_of(base_);
            curved_ = turned && detail::basis(turned->meridian)->IsKind(STANDARD_TYPE(Geom_Conic));
            const auto some = [](const detail::range &r) { return !detail::open(r.low) ? r.low : !detail::open(r.high) ? r.high : 0; };
            centre_ = base_->Value(some(bounds_[0]), some(bounds_[1]));
        }
        cover({});
    }

    void needed(const gp_Pnt &query, detail::range *ranges) const override {
        detail::feet_on(base_, query, ranges[0], ranges[1]);
    }
    void convert(const detail::range *ranges) override {
        if (const auto found = detail::net_of(base_, ranges[0], ranges[1])) {
            shape_ = std::make_shared<const footpoint::surface>(detail::made(*found, place_));
            along_[0] = found->along[0];
            along_[1] = found->along[1];
        } else {
            shape_ = std::make_shared<const footpoint::surface>(detail::called(base_, ranges[0], ranges[1], place_));
            for (int k = 0; k < 2; k++) along_[k].used = along_[k].whole = ranges[k];
        }
        closed_ = {shape_->is_closed_u(), shape_->is_closed_v()};
        collapsed_ = shape_->collapsed_edges();
    }

    Handle(Geom_Surface) base_;
    double period_[2] = {0, 0};
    std::array<bool, 2> closed_{};
    std::array<bool, 4> collapsed_{};
};

/** What both projecting classes share. */
template <class Shape>
class projection {
public:
    void Perform(const gp_Pnt &P) {
        if (!shape_) throw StdFail_NotDone("Perform: Init was not called");
        query_ = P;
        nearest_ = shape_->closest(P);
        listed_.reset();
    }

    Standard_Integer NbPoints() const { return is_done() ? Standard_Integer(list().size()) : 0; }
    operator Standard_Integer() const { return NbPoints(); }
    gp_Pnt Point(const Standard_Integer Index) const { return at(Index).Point; }
    Standard_Real Distance(const Standard_Integer Index) const { return at(Index).Distance; }
    gp_Pnt NearestPoint() const { return lowest().Point; }
    operator gp_Pnt() const { return NearestPoint(); }
    Standard_Real LowerDistance() const { return lowest().Distance; }
    operator Standard_Real() const { return LowerDistance(); }

    /** Nothing on the shape is nearer than this. */
    Standard_Real LowerBound() const { return nearest().LowerBound; }
    /** Whether the nearest point is proven. */
    Standard_Boolean IsProven() const { return nearest().IsProven(); }
    /** Whether NbPoints counts all. */
    Standard_Boolean IsComplete() const {
        list();
        return listed_->IsComplete;
    }

protected:
    projection() = default;

    void load(Shape &&shape) {
        shape_.emplace(std::move(shape));
        nearest_.reset();
        listed_.reset();
    }
    bool is_done() const { return nearest_ && (nearest_->Flags & FPT_FOOT_BAD_QUERY) == 0; }
    const foot &nearest() const {
        if (!is_done()) throw StdFail_NotDone("no answer: nothing was asked, or the point is not finite");
        return *nearest_;
    }
    /** The nearest point; when only maxima are wanted, the nearest of those. */
    const foot &lowest() const { return wanted_ == Extrema_ExtFlag_MAX ? at(1) : nearest(); }

    /** All extrema, asked for when somebody wants them. */
    const std::vector<member> &list() const {
        const foot &first = nearest();
        if (!listed_) {
            extrema_options options;
            options.minima_only = wanted_ == Extrema_ExtFlag_MIN ? 1 : 0;
            listed_ = shape_->extrema(query_, options);
            std::vector<member> &all = listed_->List;
            // A list that is not complete may miss the nearest point.
            if (!listed_->IsComplete && (all.empty() || all.front().Distance > first.Distance)) {
                member added;
                static_cast<foot &>(added) = first;
                added.URange = {first.U, first.U};
                added.VRange = {first.V, first.V};
                all.insert(all.begin(), added);
            }
            if (wanted_ == Extrema_ExtFlag_MAX)
                all.erase(std::remove_if(all.begin(), all.end(), [](const member &m) { return m.Nature != FPT_NATURE_MAXIMUM; }),
                          all.end());
        }
        return listed_->List;
    }
    const foot &at(Standard_Integer index) const {
        const std::vector<member> &all = list();
        if (index < 1 || index > Standard_Integer(all.size())) throw Standard_OutOfRange("Index: less than 1 or more than NbPoints()");
        return all[std::size_t(index - 1)];
    }

    Extrema_ExtFlag wanted_ = Extrema_ExtFlag_MINMAX;
    mutable std::optional<Shape> shape_;
    gp_Pnt query_;
    std::optional<foot> nearest_;
    mutable std::optional<members> listed_;
};

/** The class of this name, see the head of this file. */
class GeomAPI_ProjectPointOnCurve : public projection<curve> {
public:
    GeomAPI_ProjectPointOnCurve() = default;
    GeomAPI_ProjectPointOnCurve(const gp_Pnt &P, const Handle(Geom_Curve) &Curve) { Init(P, Curve); }
    GeomAPI_ProjectPointOnCurve(const gp_Pnt &P, const Handle(Geom_Curve) &Curve, const Standard_Real Umin,
                                const Standard_Real Usup) {
        Init(P, Curve, Umin, Usup);
    }

    void Init(const gp_Pnt &P, const Handle(Geom_Curve) &Curve) {
        load(curve(Curve));
        Perform(P);
    }
    void Init(const gp_Pnt &P, const Handle(Geom_Curve) &Curve, const Standard_Real Umin, const Standard_Real Usup) {
        Init(Curve, Umin, Usup);
        Perform(P);
    }
    void Init(const Handle(Geom_Curve) &Curve, const Standard_Real Umin, const Standard_Real Usup) {
        load(curve(Curve, Umin, Usup));
    }

    Standard_Real Parameter(const Standard_Integer Index) const { return at(Index).U; }
    void Parameter(const Standard_Integer Index, Standard_Real &U) const { U = at(Index).U; }
    Standard_Real LowerDistanceParameter() const { return lowest().U; }
};

/** The class of this name, see the head of this file. */
class GeomAPI_ProjectPointOnSurf : public projection<surface> {
public:
    GeomAPI_ProjectPointOnSurf() = default;
    GeomAPI_ProjectPointOnSurf(const gp_Pnt &P, const Handle(Geom_Surface) &Surface,
                               const Extrema_ExtAlgo = Extrema_ExtAlgo_Grad) {
        Init(P, Surface);
    }
    GeomAPI_ProjectPointOnSurf(const gp_Pnt &P, const Handle(Geom_Surface) &Surface, const Standard_Real,
                               const Extrema_ExtAlgo = Extrema_ExtAlgo_Grad) {
        Init(P, Surface);
    }
    GeomAPI_ProjectPointOnSurf(const gp_Pnt &P, const Handle(Geom_Surface) &Surface, const Standard_Real Umin,
                               const Standard_Real Usup, const Standard_Real Vmin, const Standard_Real Vsup,
                               const Standard_Real, const Extrema_ExtAlgo = Extrema_ExtAlgo_Grad) {
        Init(P, Surface, Umin, Usup, Vmin, Vsup);
    }
    GeomAPI_ProjectPointOnSurf(const gp_Pnt &P, const Handle(Geom_Surface) &Surface, const Standard_Real Umin,
                               const Standard_Real Usup, const Standard_Real Vmin, const Standard_Real Vsup,
                               const Extrema_ExtAlgo = Extrema_ExtAlgo_Grad) {
        Init(P, Surface, Umin, Usup, Vmin, Vsup);
    }

    void Init(const gp_Pnt &P, const Handle(Geom_Surface) &Surface, const Standard_Real,
              const Extrema_ExtAlgo = Extrema_ExtAlgo_Grad) {
        Init(P, Surface);
    }
    void Init(const gp_Pnt &P, const Handle(Geom_Surface) &Surface, const Extrema_ExtAlgo = Extrema_ExtAlgo_Grad) {
        load(surface(Surface));
        Perform(P);
    }
    void Init(const gp_Pnt &P, const Handle(Geom_Surface) &Surface, const Standard_Real Umin, const Standard_Real Usup,
              const Standard_Real Vmin, const Standard_Real Vsup, const Standard_Real,
              const Extrema_ExtAlgo = Extrema_ExtAlgo_Grad) {
        Init(P, Surface, Umin, Usup, Vmin, Vsup);
    }
    void Init(const gp_Pnt &P, const Handle(Geom_Surface) &Surface, const Standard_Real Umin, const Standard_Real Usup,
              const Standard_Real Vmin, const Standard_Real Vsup, const Extrema_ExtAlgo = Extrema_ExtAlgo_Grad) {
        Init(Surface, Umin, Usup, Vmin, Vsup);
        Perform(P);
    }
    void Init(const Handle(Geom_Surface) &Surface, const Standard_Real Umin, const Standard_Real Usup,
              const Standard_Real Vmin, const Standard_Real Vsup, const Standard_Real,
              const Extrema_ExtAlgo = Extrema_ExtAlgo_Grad) {
        Init(Surface, Umin, Usup, Vmin, Vsup);
    }
    void Init(const Handle(Geom_Surface) &Surface, const Standard_Real Umin, const Standard_Real Usup,
              const Standard_Real Vmin, const Standard_Real Vsup, const Extrema_ExtAlgo = Extrema_ExtAlgo_Grad) {
        load(surface(Surface, Umin, Usup, Vmin, Vsup));
    }

    void SetExtremaAlgo(const Extrema_ExtAlgo) {}
    void SetExtremaFlag(const Extrema_ExtFlag theExtFlag) {
        wanted_ = theExtFlag;
        listed_.reset();
    }
    Standard_Boolean IsDone() const { return is_done(); }
    void Parameters(const Standard_Integer Index, Standard_Real &U, Standard_Real &V) const {
        const foot &found = at(Index);
        U = found.U, V = found.V;
    }
    void LowerDistanceParameters(Standard_Real &U, Standard_Real &V) const {
        const foot &found = lowest();
        U = found.U, V = found.V;
    }
};

/** The class of this name: everything of OCCT's, with projections by footpoint. See the head of this file. */
class ShapeAnalysis_Surface : public ::ShapeAnalysis_Surface {
public:
    explicit ShapeAnalysis_Surface(const Handle(Geom_Surface) &S) : ::ShapeAnalysis_Surface(S), shape_(S) {}

    void Init(const Handle(Geom_Surface) &S) {
        shape_ = surface(S);
        ::ShapeAnalysis_Surface::Init(S);
    }
    void Init(const Handle(::ShapeAnalysis_Surface) &other) {
        if (other.IsNull()) throw Standard_NullObject("other: null");
        shape_ = surface(other->Surface());
        ::ShapeAnalysis_Surface::Init(other);
    }
    void SetDomain(const Standard_Real U1, const Standard_Real U2, const Standard_Real V1, const Standard_Real V2) {
        shape_ = surface(Surface(), U1, U2, V1, V2);
        ::ShapeAnalysis_Surface::SetDomain(U1, U2, V1, V2);
    }

    /** The parameters of the nearest point. */
    gp_Pnt2d ValueOfUV(const gp_Pnt &P3D, const Standard_Real) { return taken(shape_.closest(P3D)); }
    /** The same, going on from the parameters before, as surface::next. */
    gp_Pnt2d NextValueOfUV(const gp_Pnt2d &p2dPrev, const gp_Pnt &P3D, const Standard_Real, const Standard_Real = -1.0) {
        return taken(shape_.next(p2dPrev, P3D));
    }

    /** Nothing on the surface is nearer to the point asked last than this. */
    Standard_Real LowerBound() const { return last_.LowerBound; }
    /** Whether the last answer is proven. */
    Standard_Boolean IsProven() const { return last_.IsProven(); }

private:
    gp_Pnt2d taken(const foot &found) {
        if ((found.Flags & FPT_FOOT_BAD_QUERY) != 0) throw StdFail_NotDone("P3D: not finite");
        last_ = found;
        myGap = found.Distance;
        return gp_Pnt2d(found.U, found.V);
    }

    surface shape_;
    foot last_;
};

} // namespace footpoint::occt

#endif
