/*
 * Part of footpoint_occt.hxx, not for callers: OpenCASCADE's geometry as NURBS, or as a function, and the relations between OCCT's
 * parameters and footpoint's. SPDX-License-Identifier: MIT OR Apache-2.0
 *
 * A curve is a profile: a rational curve and a direction. A surface is a net: two profiles multiplied (a profile turned about
 * an axis, a profile moved along a line) or the net of a spline. A direction knows which part of it is looked at (`used`, in OCCT's parameter) and
 * the domain that footpoint has (`whole`); spline directions may have more than is used, the query is restricted then.
 */
#ifndef FOOTPOINT_OCCT_SHAPES_HXX
#define FOOTPOINT_OCCT_SHAPES_HXX

#include "footpoint.hpp"

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
#include <Standard_ConstructionError.hxx>
#include <Standard_OutOfMemory.hxx>
#include <gp_Ax1.hxx>
#include <gp_Pnt.hxx>
#include <gp_Trsf.hxx>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

namespace footpoint::occt::detail {

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

} // namespace footpoint::occt::detail

#endif
