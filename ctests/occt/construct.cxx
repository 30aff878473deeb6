// Constructions of footpoint beside those of OCCT: GeomConvert of conics, quadrics, tori, revolved and extruded surfaces, GeomFill's ruled,
// Coons and swept surfaces, GeomAPI_Interpolate, Geom_OffsetCurve and Geom_OffsetSurface. Where the parameters are the same, points at
// equal parameters are compared; where each chose its own, every sample of one is asked for on the other, with proof, both ways.
// SPDX-License-Identifier: MIT OR Apache-2.0
#include "check.hxx"

#include <footpoint.hpp>

#include <GeomAPI_Interpolate.hxx>
#include <GeomConvert.hxx>
#include <GeomFill.hxx>
#include <GeomFill_BSplineCurves.hxx>
#include <GeomFill_Pipe.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_Circle.hxx>
#include <Geom_ConicalSurface.hxx>
#include <Geom_CylindricalSurface.hxx>
#include <Geom_Ellipse.hxx>
#include <Geom_Hyperbola.hxx>
#include <Geom_OffsetCurve.hxx>
#include <Geom_OffsetSurface.hxx>
#include <Geom_Parabola.hxx>
#include <Geom_RectangularTrimmedSurface.hxx>
#include <Geom_SphericalSurface.hxx>
#include <Geom_SurfaceOfLinearExtrusion.hxx>
#include <Geom_SurfaceOfRevolution.hxx>
#include <Geom_ToroidalSurface.hxx>
#include <Geom_TrimmedCurve.hxx>
#include <TColStd_HArray1OfReal.hxx>
#include <TColgp_HArray1OfPnt.hxx>

#include <algorithm>
#include <cmath>
#include <random>

namespace {

constexpr double PI = 3.14159265358979323846;
std::mt19937 random_numbers(5);
double between(double a, double b) { return std::uniform_real_distribution<double>(a, b)(random_numbers); }

/** A tilted place, for both. */
struct Place {
    gp_Ax3 axes;
    footpoint::axes numbers;

    Place() {
        const gp_Dir z(between(-1, 1), between(-1, 1), between(0.5, 1)), guess(between(-1, 1), 1, between(-1, 1));
        axes = gp_Ax3(gp_Pnt(between(-5, 5), between(-5, 5), between(-5, 5)), z, guess);
        const gp_Pnt o = axes.Location();
        const gp_Dir x = axes.XDirection();
        numbers = {o.X(), o.Y(), o.Z(), z.X(), z.Y(), z.Z(), x.X(), x.Y(), x.Z()};
    }
    gp_Ax2 right() const { return axes.Ax2(); }
};

std::vector<double> samples(const Handle(Geom_Curve) & c, double a, double b) {
    std::vector<double> out;
    for (int i = 0; i <= 50; i++) {
        const gp_Pnt p = c->Value(i == 50 ? b : a + (b - a) * i / 50);
        out.insert(out.end(), {p.X(), p.Y(), p.Z()});
    }
    return out;
}

std::vector<double> samples(const Handle(Geom_Surface) & s) {
    double d[4];
    s->Bounds(d[0], d[1], d[2], d[3]);
    std::vector<double> out;
    for (int i = 0; i <= 16; i++) {
        for (int j = 0; j <= 16; j++) {
            const gp_Pnt p = s->Value(i == 16 ? d[1] : d[0] + (d[1] - d[0]) * i / 16, j == 16 ? d[3] : d[2] + (d[3] - d[2]) * j / 16);
            out.insert(out.end(), {p.X(), p.Y(), p.Z()});
        }
    }
    return out;
}

footpoint::curve ours_of(const Handle(Geom_BSplineCurve) & given) {
    const Handle(Geom_BSplineCurve) c = Handle(Geom_BSplineCurve)::DownCast(given->Copy());
    if (c->IsPeriodic()) c->SetNotPeriodic();
    std::vector<double> knots, poles, weights;
    for (int i = 1; i <= c->NbKnots(); i++) knots.insert(knots.end(), size_t(c->Multiplicity(i)), c->Knot(i));
    for (int i = 1; i <= c->NbPoles(); i++) {
        const gp_Pnt p = c->Pole(i);
        poles.insert(poles.end(), {p.X(), p.Y(), p.Z()});
        weights.push_back(c->Weight(i));
    }
    return footpoint::curve(size_t(c->Degree()), knots, poles, c->IsRational() ? weights : std::vector<double>());
}

footpoint::surface ours_of(const Handle(Geom_BSplineSurface) & given) {
    const Handle(Geom_BSplineSurface) s = Handle(Geom_BSplineSurface)::DownCast(given->Copy());
    if (s->IsUPeriodic()) s->SetUNotPeriodic();
    if (s->IsVPeriodic()) s->SetVNotPeriodic();
    std::vector<double> u, v, poles, weights;
    for (int i = 1; i <= s->NbUKnots(); i++) u.insert(u.end(), size_t(s->UMultiplicity(i)), s->UKnot(i));
    for (int i = 1; i <= s->NbVKnots(); i++) v.insert(v.end(), size_t(s->VMultiplicity(i)), s->VKnot(i));
    for (int i = 1; i <= s->NbUPoles(); i++) {
        for (int j = 1; j <= s->NbVPoles(); j++) {
            const gp_Pnt p = s->Pole(i, j);
            poles.insert(poles.end(), {p.X(), p.Y(), p.Z()});
            weights.push_back(s->Weight(i, j));
        }
    }
    const bool is_rational = s->IsURational() || s->IsVRational();
    return footpoint::surface(size_t(s->UDegree()), size_t(s->VDegree()), u, v, poles, is_rational ? weights : std::vector<double>());
}

template <class Shape>
double greatest(const Shape &shape, const std::vector<double> &points) {
    double most = 0;
    for (const fpt_foot_point &foot : shape.closest(points)) most = std::max(most, foot.distance);
    return most;
}

std::vector<double> own_samples(const footpoint::curve &c) {
    std::vector<double> out;
    const auto d = c.domain();
    for (int i = 0; i <= 50; i++) {
        const auto p = c.evaluate(i == 50 ? d[1] : d[0] + (d[1] - d[0]) * i / 50);
        out.insert(out.end(), p.begin(), p.end());
    }
    return out;
}
std::vector<double> own_samples(const footpoint::surface &s) {
    std::vector<double> out;
    const auto d = s.domain();
    for (int i = 0; i <= 16; i++) {
        for (int j = 0; j <= 16; j++) {
            const auto p = s.evaluate(i == 16 ? d[1] : d[0] + (d[1] - d[0]) * i / 16, j == 16 ? d[3] : d[2] + (d[3] - d[2]) * j / 16);
            out.insert(out.end(), p.begin(), p.end());
        }
    }
    return out;
}

/** The same sets of points: samples of each on the other. */
template <class Shape, class Theirs>
void same_set(const char *what, const Shape &ours, const Theirs &theirs, double tolerance, bool contained = false) {
    const Shape other = ours_of(theirs);
    const double there = greatest(other, own_samples(ours)), here = contained ? 0 : greatest(ours, own_samples(other));
    expect(there <= tolerance && here <= tolerance, what, "the same set", there, here);
}

void conics() {
    for (int i = 0; i < 12; i++) {
        const Place at;
        const double a = between(1, 4), b = between(0.4, 0.9) * a, start = between(-3, 3), sweep = between(0.4, 2 * PI);
        const double tolerance = 1e-13 * 20;
        const Handle(Geom_Circle) round = new Geom_Circle(at.right(), a);
        const Handle(Geom_TrimmedCurve) arc = new Geom_TrimmedCurve(round, start, start + sweep);
        const Handle(Geom_Ellipse) oval = new Geom_Ellipse(at.right(), a, b);
        const Handle(Geom_TrimmedCurve) part = new Geom_TrimmedCurve(oval, start, start + sweep);
        for (const Convert_ParameterisationType kind : {Convert_TgtThetaOver2, Convert_TgtThetaOver2_3, Convert_QuasiAngular, Convert_RationalC1}) {
            const Handle(Geom_BSplineCurve) converted = GeomConvert::CurveToBSplineCurve(arc, kind);
            for (const uint32_t form : {FPT_ARC_QUARTERS, FPT_ARC_THIRDS, FPT_ARC_CUBIC}) {
                if (form == FPT_ARC_CUBIC && sweep > 3.9) continue;
                same_set("circle", footpoint::circle_arc(at.numbers, a, start, start + sweep, form), converted, tolerance);
                same_set("ellipse", footpoint::ellipse_arc(at.numbers, a, b, start, start + sweep, form),
                         GeomConvert::CurveToBSplineCurve(part, kind), tolerance);
            }
        }
        // The usual form of a full turn: the same nine poles.
        const Handle(Geom_BSplineCurve) turn = GeomConvert::CurveToBSplineCurve(new Geom_TrimmedCurve(round, 0, 2 * PI), Convert_TgtThetaOver2_4);
        const footpoint::curve full = footpoint::circle_arc(at.numbers, a, 0, 2 * PI);
        const footpoint::curve other = ours_of(turn);
        expect(other.pole_count() == full.pole_count(), "circle", "nine poles", double(other.pole_count()), double(full.pole_count()));
        if (other.pole_count() == full.pole_count()) {
            double most = 0;
            const auto p = other.poles(), q = full.poles();
            for (size_t k = 0; k < p.size(); k++) most = std::max(most, std::fabs(p[k] - q[k]));
            expect(most <= tolerance, "circle", "the same poles", most);
        }
        same_set("circle, halves", footpoint::circle_arc(at.numbers, a, start, start + 2 * PI, FPT_ARC_HALVES), turn, tolerance);
        same_set("circle, quintic", footpoint::circle_arc(at.numbers, a, start, start + 2 * PI, FPT_ARC_QUINTIC), turn, tolerance);

        const double from = between(-2, 0), to = from + between(0.5, 2);
        const Handle(Geom_Parabola) parabola = new Geom_Parabola(at.right(), a);
        const footpoint::curve own = footpoint::parabola(at.numbers, a, from, to);
        same_set("parabola", own, GeomConvert::CurveToBSplineCurve(new Geom_TrimmedCurve(parabola, from, to)), tolerance);
        const Handle(Geom_Hyperbola) hyperbola = new Geom_Hyperbola(at.right(), a, b);
        same_set("hyperbola", footpoint::hyperbola(at.numbers, a, b, from, to),
                 GeomConvert::CurveToBSplineCurve(new Geom_TrimmedCurve(hyperbola, from, to)), tolerance * 10);
    }
}

void quadrics() {
    for (int i = 0; i < 8; i++) {
        const Place at;
        const double r = between(1, 3), low = between(-2, 0), high = between(0.5, 3), start = between(-3, 3), sweep = between(0.5, 6);
        const double tolerance = 1e-13 * 30;
        const auto converted = [](const Handle(Geom_Surface) & s) { return GeomConvert::SurfaceToBSplineSurface(s); };
        const auto cut = [&](const Handle(Geom_Surface) & s, double v0, double v1) {
            return converted(new Geom_RectangularTrimmedSurface(s, start, start + sweep, v0, v1));
        };
        const std::array<double, 2> angles = {start, start + sweep};
        for (const uint32_t form : {FPT_ARC_QUARTERS, FPT_ARC_THIRDS}) {
            same_set("cylinder", footpoint::quadric_patch(FPT_PATCH_CYLINDER, at.numbers, {r, r, 1}, angles, {low, high}, form),
                     cut(new Geom_CylindricalSurface(at.axes, r), low, high), tolerance);
            // At the height z the cone has the radius z tan a: v of OCCT runs along the ruling, from the radius 0 here.
            const double half = 0.5, top = between(1, 3);
            same_set("cone", footpoint::quadric_patch(FPT_PATCH_CONE, at.numbers, {std::tan(half), std::tan(half), 1}, angles, {0.25, top}, form),
                     cut(new Geom_ConicalSurface(at.axes, half, 0), 0.25 / std::cos(half), top / std::cos(half)), tolerance);
            const double south = between(-PI / 2, 0), north = between(0.3, PI / 2);
            same_set("sphere", footpoint::quadric_patch(FPT_PATCH_ELLIPSOID, at.numbers, {r, r, r}, angles, {south, north}, form),
                     cut(new Geom_SphericalSurface(at.axes, r), south, north), tolerance);
            const double inner = between(0.2, 0.9) * r, around = between(-3, 3);
            same_set("torus", footpoint::torus(at.numbers, r, inner, angles, {around, around + 2}, form),
                     cut(new Geom_ToroidalSurface(at.axes, r, inner), around, around + 2), tolerance);
        }
    }
}

/** A clamped spline, for both. */
struct Line {
    std::vector<double> knots, poles, weights;
    size_t degree;

    Line(size_t p, size_t count, double z, bool is_rational, double far = 1) : degree(p) {
        knots.assign(p + 1, 0);
        for (size_t i = 1; i + p < count; i++) knots.push_back(double(i) / double(count - p));
        knots.insert(knots.end(), p + 1, 1);
        for (size_t i = 0; i < count; i++) {
            poles.insert(poles.end(), {double(i) * 2 + 1, far + between(0, 2), z + between(-0.5, 0.5)});
            weights.push_back(is_rational ? between(0.5, 2) : 1);
        }
        if (!is_rational) weights.clear();
    }
    footpoint::curve ours() const { return footpoint::curve(degree, knots, poles, weights); }
    Handle(Geom_BSplineCurve) theirs() const {
        const int count = int(poles.size() / 3);
        TColgp_Array1OfPnt list(1, count);
        TColStd_Array1OfReal w(1, count);
        for (int i = 0; i < count; i++) {
            list(i + 1) = gp_Pnt(poles[3 * size_t(i)], poles[3 * size_t(i) + 1], poles[3 * size_t(i) + 2]);
            w(i + 1) = weights.empty() ? 1 : weights[size_t(i)];
        }
        std::vector<double> values;
        std::vector<int> times;
        for (const double u : knots) {
            if (values.empty() || u > values.back()) values.push_back(u), times.push_back(0);
            times.back()++;
        }
        TColStd_Array1OfReal k(1, int(values.size()));
        TColStd_Array1OfInteger m(1, int(values.size()));
        for (int i = 0; i < int(values.size()); i++) k(i + 1) = values[size_t(i)], m(i + 1) = times[size_t(i)];
        return weights.empty() ? new Geom_BSplineCurve(list, k, m, int(degree)) : new Geom_BSplineCurve(list, w, k, m, int(degree));
    }
};

/** Points at shares of both domains. */
double at_shares(const Handle(Geom_Surface) & theirs, const footpoint::surface &ours, bool exchanged = false) {
    double d[4], most = 0;
    theirs->Bounds(d[0], d[1], d[2], d[3]);
    const auto e = ours.domain();
    for (int i = 0; i <= 20; i++) {
        for (int j = 0; j <= 20; j++) {
            const gp_Pnt p = theirs->Value(i == 20 ? d[1] : d[0] + (d[1] - d[0]) * i / 20, j == 20 ? d[3] : d[2] + (d[3] - d[2]) * j / 20);
            const int k = exchanged ? j : i, l = exchanged ? i : j;
            const auto q = ours.evaluate(k == 20 ? e[1] : e[0] + (e[1] - e[0]) * k / 20, l == 20 ? e[3] : e[2] + (e[3] - e[2]) * l / 20);
            most = std::max(most, p.Distance(gp_Pnt(q[0], q[1], q[2])));
        }
    }
    return most;
}

void moved_curves() {
    for (int i = 0; i < 12; i++) {
        const size_t p = size_t(1 + i % 5);
        const bool is_rational = i % 2 == 1;
        const Line a(p, p + 3, 0, is_rational), b(size_t(2 + i % 3), 6, 3, false), c(p, p + 4, 3, is_rational);
        const double tolerance = 1e-13 * 30;
        const gp_Dir along(between(-1, 1), between(-1, 1), 1);
        const Handle(Geom_Surface) drawn = new Geom_RectangularTrimmedSurface(new Geom_SurfaceOfLinearExtrusion(a.theirs(), along), 0, 2.5, Standard_False);
        expect(at_shares(drawn, footpoint::extruded(a.ours(), {2.5 * along.X(), 2.5 * along.Y(), 2.5 * along.Z()})) <= tolerance, "extruded", "points",
               at_shares(drawn, footpoint::extruded(a.ours(), {2.5 * along.X(), 2.5 * along.Y(), 2.5 * along.Z()})));
        // Ruled: OCCT's first direction runs along the curves, ours too, whatever both degrees are. Along the rulings of rational curves
        // each has its own speed.
        if (!is_rational) expect(at_shares(GeomFill::Surface(a.theirs(), c.theirs()), footpoint::ruled(a.ours(), c.ours())) <= tolerance, "ruled",
               "points", at_shares(GeomFill::Surface(a.theirs(), c.theirs()), footpoint::ruled(a.ours(), c.ours())));
        const Handle(Geom_BSplineSurface) sheet = Handle(Geom_BSplineSurface)::DownCast(GeomFill::Surface(a.theirs(), c.theirs()));
        same_set("ruled", footpoint::ruled(a.ours(), c.ours()), sheet, tolerance);
        const gp_Ax1 axis(gp_Pnt(0, -1, 0), gp_Dir(1, 0, 0.1));
        const double turn = between(0.5, 2 * PI);
        const Handle(Geom_Surface) round = new Geom_RectangularTrimmedSurface(new Geom_SurfaceOfRevolution(b.theirs(), axis), 0, turn, Standard_True);
        const footpoint::surface own = footpoint::revolved(b.ours(), {0, -1, 0}, {1, 0, 0.1}, {0, turn});
        expect(greatest(own, samples(round)) <= tolerance, "revolved", "OCCT's points on ours", greatest(own, samples(round)));
        same_set("revolved", own, GeomConvert::SurfaceToBSplineSurface(round), tolerance);
    }
}

/** Four borders with common corners. */
void coons_patches() {
    for (int i = 0; i < 10; i++) {
        // u = 0, u = 1 run in v; v = 0, v = 1 run in u.
        Line left(3, 6, 0, false), right(2, 5, 0, false), low(3, 5, 0, false), high(2, 4, 0, false);
        const gp_Pnt corner[2][2] = {{gp_Pnt(0, 0, between(-1, 1)), gp_Pnt(0, 8, between(-1, 1))}, {gp_Pnt(9, 0, between(-1, 1)), gp_Pnt(9, 8, between(-1, 1))}};
        const auto ends = [](Line &line, const gp_Pnt &a, const gp_Pnt &b) {
            const size_t count = line.poles.size() / 3;
            for (size_t k = 0; k < count; k++) {
                const double s = double(k) / double(count - 1);
                const double out = k == 0 || k + 1 == count ? 0 : 1;
                const double p[3] = {a.X() + (b.X() - a.X()) * s, a.Y() + (b.Y() - a.Y()) * s, a.Z() + (b.Z() - a.Z()) * s};
                for (size_t x = 0; x < 3; x++) line.poles[3 * k + x] = p[x] + out * between(-0.6, 0.6);
            }
        };
        ends(left, corner[0][0], corner[0][1]);
        ends(right, corner[1][0], corner[1][1]);
        ends(low, corner[0][0], corner[1][0]);
        ends(high, corner[0][1], corner[1][1]);
        const footpoint::curve l = left.ours(), r = right.ours(), b = low.ours(), t = high.ours();
        const footpoint::surface own = footpoint::coons({&l, &r, &b, &t});
        const GeomFill_BSplineCurves filled(low.theirs(), right.theirs(), high.theirs(), left.theirs(), GeomFill_CoonsStyle);
        // Borders are the same; inside OCCT blends poles, which is another surface where knots or degrees differ.
        const Handle(Geom_BSplineSurface) theirs = filled.Surface();
        double d[4];
        theirs->Bounds(d[0], d[1], d[2], d[3]);
        double border = 0;
        for (const int side : {0, 1, 2, 3}) {
            const Handle(Geom_Curve) iso = side < 2 ? theirs->UIso(d[side]) : theirs->VIso(d[side]);
            border = std::max(border, greatest(own, samples(iso, iso->FirstParameter(), iso->LastParameter())));
        }
        expect(border <= 1e-12, "Coons", "borders", border);
        // Bezier borders: GeomFill's stretch style is the bilinear blend, too.
        Line one[4] = {Line(3, 4, 0, false), Line(3, 4, 0, false), Line(3, 4, 0, false), Line(3, 4, 0, false)};
        ends(one[0], corner[0][0], corner[0][1]);
        ends(one[1], corner[1][0], corner[1][1]);
        ends(one[2], corner[0][0], corner[1][0]);
        ends(one[3], corner[0][1], corner[1][1]);
        const footpoint::curve c[4] = {one[0].ours(), one[1].ours(), one[2].ours(), one[3].ours()};
        const footpoint::surface patch = footpoint::coons({&c[0], &c[1], &c[2], &c[3]});
        const GeomFill_BSplineCurves plain(one[2].theirs(), one[1].theirs(), one[3].theirs(), one[0].theirs(), GeomFill_StretchStyle);
        const footpoint::surface other = ours_of(plain.Surface());
        const double apart = std::max(greatest(other, own_samples(patch)), greatest(patch, own_samples(other)));
        expect(apart <= 1e-12, "Coons", "Bezier borders", apart);
    }
}

void sweeps() {
    // A quarter of a circle as spine: in the plane the rotation minimising frame is Frenet's, and the sweep of a circle is a torus.
    const gp_Ax2 flat(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1), gp_Dir(1, 0, 0)), across(gp_Pnt(5, 0, 0), gp_Dir(0, 1, 0), gp_Dir(1, 0, 0));
    const Handle(Geom_BSplineCurve) spine = GeomConvert::CurveToBSplineCurve(new Geom_TrimmedCurve(new Geom_Circle(flat, 5), 0, PI / 2));
    const Handle(Geom_BSplineCurve) profile = GeomConvert::CurveToBSplineCurve(new Geom_TrimmedCurve(new Geom_Circle(across, 1), 0, 2 * PI));
    const footpoint::swept_surface own = footpoint::swept(ours_of(profile), ours_of(spine), footpoint::sweep_options(1e-7));
    const Handle(Geom_Surface) ring = new Geom_RectangularTrimmedSurface(new Geom_ToroidalSurface(gp_Ax3(flat), 5, 1), 0, PI / 2, 0, 2 * PI);
    const double off = greatest(own.shape, samples(ring));
    expect(off <= own.error + 1e-12 && own.error <= 1e-7, "swept", "torus", off, own.error);
    GeomFill_Pipe pipe(spine, profile, GeomFill_IsCorrectedFrenet);
    pipe.Perform(1e-4, Standard_False, GeomAbs_C2);
    expect(pipe.IsDone(), "swept", "OCCT's pipe");
    if (pipe.IsDone()) {
        const double theirs = greatest(own.shape, samples(pipe.Surface()));
        expect(theirs <= 1e-4 + own.error, "swept", "OCCT's pipe on ours", theirs);
    }
    // In space: OCCT corrects Frenet's frame by its torsion, an approximation of the same frame.
    TColgp_Array1OfPnt poles(1, 6);
    for (int i = 0; i < 6; i++) poles(i + 1) = gp_Pnt(4.0 * i, 3 * std::sin(1.1 * i), 3 * std::cos(1.3 * i));
    TColStd_Array1OfReal knots(1, 3);
    TColStd_Array1OfInteger times(1, 3);
    knots(1) = 0, knots(2) = 0.5, knots(3) = 1;
    times(1) = 5, times(2) = 1, times(3) = 5;
    const Handle(Geom_BSplineCurve) path = new Geom_BSplineCurve(poles, knots, times, 4);
    gp_Pnt start;
    gp_Vec tangent;
    path->D1(0, start, tangent);
    const gp_Ax2 there(start, gp_Dir(tangent));
    const Handle(Geom_BSplineCurve) section = GeomConvert::CurveToBSplineCurve(new Geom_TrimmedCurve(new Geom_Circle(there, 0.7), 0, 2 * PI));
    const footpoint::swept_surface tube = footpoint::swept(ours_of(section), ours_of(path), footpoint::sweep_options(1e-6));
    GeomFill_Pipe other(path, section, GeomFill_IsCorrectedFrenet);
    other.Perform(1e-4, Standard_False, GeomAbs_C2);
    expect(other.IsDone(), "swept", "OCCT's pipe in space");
    if (other.IsDone()) {
        const double theirs = greatest(tube.shape, samples(other.Surface()));
        expect(theirs <= 2e-4, "swept", "OCCT's pipe in space on ours", theirs);
    }
}

void interpolation() {
    for (int i = 0; i < 12; i++) {
        const int count = 5 + i;
        const Handle(TColgp_HArray1OfPnt) points = new TColgp_HArray1OfPnt(1, count);
        std::vector<double> list;
        for (int k = 0; k < count; k++) {
            const gp_Pnt p(k + between(-0.3, 0.3), 3 * std::sin(0.8 * k), between(-1, 1));
            points->SetValue(k + 1, p);
            list.insert(list.end(), {p.X(), p.Y(), p.Z()});
        }
        for (const uint32_t spacing : {FPT_SPACING_CHORDAL, FPT_SPACING_CENTRIPETAL, FPT_SPACING_UNIFORM}) {
            const std::vector<double> at = footpoint::fit_parameters(list, spacing);
            const Handle(TColStd_HArray1OfReal) parameters = new TColStd_HArray1OfReal(1, count);
            for (int k = 0; k < count; k++) parameters->SetValue(k + 1, at[size_t(k)]);
            const double slopes[6] = {between(2, 9), between(-9, 9), between(-9, 9), between(2, 9), between(-9, 9), between(-9, 9)};
            GeomAPI_Interpolate theirs(points, parameters, Standard_False, 1e-9);
            theirs.Load(gp_Vec(slopes[0], slopes[1], slopes[2]), gp_Vec(slopes[3], slopes[4], slopes[5]), Standard_False);
            theirs.Perform();
            expect(theirs.IsDone(), "interpolation", "OCCT's");
            footpoint::fit_options options;
            options.condition = FPT_FIT_TANGENTS;
            options.spacing = spacing;
            options.tangents = slopes;
            const footpoint::curve ours = footpoint::interpolate(list, {}, options);
            double most = 0;
            for (int k = 0; theirs.IsDone() && k <= 100; k++) {
                const auto p = ours.evaluate(k / 100.0);
                most = std::max(most, theirs.Curve()->Value(k / 100.0).Distance(gp_Pnt(p[0], p[1], p[2])));
            }
            expect(most <= 1e-11, "interpolation", "with tangents at the ends: the same cubic", most, double(spacing));
        }
        // Closed: OCCT's has a double knot at the seam and guesses the tangent there; ours is C2 all around. Both pass through the points.
        const Handle(TColStd_HArray1OfReal) turn = new TColStd_HArray1OfReal(1, count + 1);
        std::vector<double> closed(list), at;
        closed.insert(closed.end(), {list[0], list[1], list[2]});
        at = footpoint::fit_parameters(closed);
        for (int k = 0; k <= count; k++) turn->SetValue(k + 1, at[size_t(k)]);
        GeomAPI_Interpolate theirs(points, turn, Standard_True, 1e-9);
        theirs.Perform();
        expect(theirs.IsDone(), "interpolation", "OCCT's periodic");
        footpoint::fit_options options;
        options.condition = FPT_FIT_PERIODIC;
        const footpoint::curve ours = footpoint::interpolate(list, at, options);
        double most = 0;
        for (int k = 0; theirs.IsDone() && k < count; k++) {
            const double u = at[size_t(k)];
            const auto p = ours.evaluate(u);
            most = std::max(most, theirs.Curve()->Value(u).Distance(gp_Pnt(p[0], p[1], p[2])));
        }
        expect(most <= 1e-11, "interpolation", "periodic: the same points", most);
        const auto start = ours.evaluate(ours.domain()[0], 2), end = ours.evaluate(ours.domain()[1], 2);
        for (size_t k = 0; k < 9; k++) expect(std::fabs(start[k] - end[k]) <= 1e-13 * std::pow(40.0 * count, double(k / 3)), "interpolation", "C2 at the seam", start[k], end[k]);
    }
}

void offsets() {
    for (int i = 0; i < 8; i++) {
        Line flat(size_t(2 + i % 3), 7, 0, i % 2 == 1);
        for (size_t k = 2; k < flat.poles.size(); k += 3) flat.poles[k] = 0;
        // OCCT offsets to the other side of the plane's normal.
        const Handle(Geom_OffsetCurve) theirs = new Geom_OffsetCurve(flat.theirs(), 0.3, gp_Dir(0, 0, 1));
        const footpoint::curve left = footpoint::offset(flat.ours(), 0.3, {0, 0, 1}), right = footpoint::offset(flat.ours(), -0.3, {0, 0, 1});
        double most[2] = {0, 0};
        for (int k = 0; k <= 60; k++) {
            const double u = k / 60.0;
            for (int side = 0; side < 2; side++) {
                const auto p = (side == 0 ? left : right).evaluate(u);
                most[side] = std::max(most[side], theirs->Value(u).Distance(gp_Pnt(p[0], p[1], p[2])));
            }
        }
        expect(std::min(most[0], most[1]) <= 1e-12, "offset curve", "points", most[0], most[1]);
        const auto fitted = footpoint::fit_offset(flat.ours(), 0.3, {0, 0, 1}, 3, 1e-6);
        double away = 0;
        for (int k = 0; k <= 60; k++) {
            const double u = k / 60.0;
            const auto p = left.evaluate(u), q = fitted.shape.evaluate(u);
            away = std::max(away, std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]));
        }
        expect(away <= fitted.proven && fitted.proven <= 2e-6, "offset curve", "fit within its proof", away, fitted.proven);

        const Line a(3, 5, 0, false), b(2, 4, 4, false);
        const Handle(Geom_BSplineSurface) base = Handle(Geom_BSplineSurface)::DownCast(GeomFill::Surface(a.theirs(), b.theirs()));
        const footpoint::surface own = ours_of(base);
        const Handle(Geom_OffsetSurface) sheet = new Geom_OffsetSurface(base, 0.25);
        const footpoint::surface function = footpoint::offset(own, 0.25);
        expect(at_shares(sheet, function) <= 1e-12, "offset surface", "points", at_shares(sheet, function));
        const auto spline = footpoint::fit_offset(own, 0.25, 3, 3, 1e-5);
        expect(at_shares(sheet, spline.shape) <= spline.proven + 1e-12 && spline.proven <= 2e-5, "offset surface", "fit within its proof",
               at_shares(sheet, spline.shape), spline.proven);
    }
}

} // namespace

int main() {
    return run(std::pair{"conics", conics}, std::pair{"quadrics", quadrics}, std::pair{"moved curves", moved_curves},
               std::pair{"Coons", coons_patches}, std::pair{"sweeps", sweeps}, std::pair{"interpolation", interpolation},
               std::pair{"offsets", offsets});
}
