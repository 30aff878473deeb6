// Every kind of Geom_Curve and Geom_Surface through footpoint_occt.hxx: points of known parameters come back to these parameters,
// OCCT's evaluation agrees with the answer, no sample is nearer than the bound, and the lists of the quadrics are OCCT's.
// SPDX-License-Identifier: MIT OR Apache-2.0
#include "check.hxx"

#include <footpoint_occt.hxx>

#include <GeomAPI_ProjectPointOnSurf.hxx>
#include <GeomConvert.hxx>
#include <Geom_OffsetCurve.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <TColgp_Array2OfPnt.hxx>

#include <cmath>
#include <functional>
#include <random>
#include <vector>

namespace fo = footpoint::occt;

namespace {

std::mt19937 random_numbers(5);
double unit() { return std::uniform_real_distribution<double>(0, 1)(random_numbers); }
double between(double a, double b) { return a + (b - a) * unit(); }
gp_Pnt somewhere(double size) { return gp_Pnt(between(-size, size), between(-size, size), between(-size, size)); }

const gp_Ax2 tilted(gp_Pnt(1, -2, 3), gp_Dir(0.3, -0.5, 0.8), gp_Dir(0.9, 0.1, 0.2));

/** How far apart two parameters are in a direction that may be periodic. */
double apart(double a, double b, double period) {
    return period > 0 ? std::abs(std::remainder(a - b, period)) : std::abs(a - b);
}

struct Kind {
    std::string name;
    double u1, u2, v1, v2;
    bool proven = true;
};

void curve_kind(const Kind &kind, const Handle(Geom_Curve) & shape) {
    fo::curve asked(shape);
    const double period = shape->IsPeriodic() ? shape->Period() : 0;
    for (int i = 0; i < 60; i++) {
        const double u = between(kind.u1, kind.u2);
        const gp_Pnt on = shape->Value(u);
        const fo::foot back = asked.closest(on);
        expect(back.Distance < 1e-12, kind.name, "distance of a point of the curve", back.Distance);
        expect(apart(back.U, u, period) < 1e-6 || shape->Value(back.U).Distance(on) < 1e-12, kind.name, "parameter", back.U, u);

        const gp_Pnt q = on.Translated(gp_Vec(gp_Pnt(0, 0, 0), somewhere(i % 3 == 0 ? 0.01 : 3)));
        const fo::foot foot = asked.closest(q);
        expect(shape->Value(foot.U).Distance(foot.Point) < 2e-13 * (1 + foot.Point.XYZ().Modulus()), kind.name, "OCCT's point there",
               shape->Value(foot.U).Distance(foot.Point));
        expect(foot.IsProven() == kind.proven, kind.name, "proven", foot.Flags);
        expect(foot.Distance <= q.Distance(on) * (1 + 1e-14), kind.name, "nearer was known", foot.Distance, q.Distance(on));
        for (int k = 0; k <= 300; k++) {
            const double d = q.Distance(shape->Value(kind.u1 + (kind.u2 - kind.u1) * k / 300));
            expect(d >= foot.LowerBound * (1 - 1e-14) && d >= foot.Distance * (1 - 1e-9), kind.name, "a sample is nearer", d, foot.Distance);
        }
    }
}

void surface_kind(const Kind &kind, const Handle(Geom_Surface) & shape) {
    fo::surface asked(shape);
    const double period[2] = {shape->IsUPeriodic() ? shape->UPeriod() : 0, shape->IsVPeriodic() ? shape->VPeriod() : 0};
    for (int i = 0; i < 40; i++) {
        const double u = between(kind.u1, kind.u2), v = between(kind.v1, kind.v2);
        const gp_Pnt on = shape->Value(u, v);
        const fo::foot back = asked.closest(on);
        expect(back.Distance < 1e-12, kind.name, "distance of a point of the surface", back.Distance);
        const bool same = apart(back.U, u, period[0]) < 1e-6 && apart(back.V, v, period[1]) < 1e-6;
        expect(same || shape->Value(back.U, back.V).Distance(on) < 1e-12, kind.name, "parameters", back.U, back.V);

        const gp_Pnt q = on.Translated(gp_Vec(gp_Pnt(0, 0, 0), somewhere(i % 3 == 0 ? 0.01 : 3)));
        const fo::foot foot = asked.closest(q);
        const double off = shape->Value(foot.U, foot.V).Distance(foot.Point);
        expect(off < 2e-13 * (1 + foot.Point.XYZ().Modulus()), kind.name, "OCCT's point there", off);
        expect(foot.IsProven() == kind.proven, kind.name, "proven", foot.Flags);
        expect(foot.Distance <= q.Distance(on) * (1 + 1e-14), kind.name, "nearer was known", foot.Distance, q.Distance(on));
        for (int k = 0; k <= 40; k++)
            for (int j = 0; j <= 40; j++) {
                const double d = q.Distance(shape->Value(kind.u1 + (kind.u2 - kind.u1) * k / 40, kind.v1 + (kind.v2 - kind.v1) * j / 40));
                expect(d >= foot.LowerBound * (1 - 1e-14) && d >= foot.Distance * (1 - 1e-9), kind.name, "a sample is nearer", d,
                       foot.Distance);
            }
        const gp_Pnt2d near(foot.U + 0.01, foot.V - 0.01);
        const fo::foot next = asked.next(near, q);
        expect(std::abs(next.Distance - foot.Distance) <= 1e-9, kind.name, "from a hint", next.Distance, foot.Distance);
    }
}

Handle(Geom_BSplineCurve) spline(bool is_periodic, bool is_rational, int degree) {
    const int spans = 7;
    TColStd_Array1OfReal knots(1, spans + 1);
    TColStd_Array1OfInteger repeats(1, spans + 1);
    for (int i = 0; i <= spans; i++) {
        knots(i + 1) = 2 + i + 0.3 * (i % 2);
        repeats(i + 1) = i == 3 ? 2 : 1;
    }
    if (!is_periodic) repeats(1) = repeats(spans + 1) = degree + 1;
    int count = is_periodic ? -repeats(1) : -degree - 1;
    for (int i = 1; i <= spans + 1; i++) count += repeats(i);
    TColgp_Array1OfPnt poles(1, count);
    TColStd_Array1OfReal weights(1, count);
    for (int i = 1; i <= count; i++) {
        const double angle = 2 * M_PI * i / count;
        poles(i) = gp_Pnt(5 * std::cos(angle) + unit(), 4 * std::sin(angle) + unit(), unit());
        weights(i) = is_rational ? between(0.5, 2) : 1;
    }
    return new Geom_BSplineCurve(poles, weights, knots, repeats, degree, is_periodic);
}

Handle(Geom_BSplineSurface) spline_surface(bool u_periodic, bool v_periodic) {
    const Handle(Geom_BSplineCurve) u = spline(u_periodic, false, 3), v = spline(v_periodic, false, 2);
    TColgp_Array2OfPnt poles(1, u->NbPoles(), 1, v->NbPoles());
    TColStd_Array2OfReal weights(1, u->NbPoles(), 1, v->NbPoles());
    for (int i = 1; i <= u->NbPoles(); i++) {
        for (int j = 1; j <= v->NbPoles(); j++) {
            const double a = 2 * M_PI * i / u->NbPoles(), b = 2 * M_PI * j / v->NbPoles();
            const double r = 6 + 2 * std::cos(b) + 0.3 * unit();
            poles(i, j) = gp_Pnt(r * std::cos(a), r * std::sin(a), 2 * std::sin(b));
            weights(i, j) = between(0.7, 1.4);
        }
    }
    return new Geom_BSplineSurface(poles, weights, u->Knots(), v->Knots(), u->Multiplicities(), v->Multiplicities(), 3, 2, u_periodic,
                                   v_periodic);
}

void curves() {
    const Handle(Geom_Curve) circle = new Geom_Circle(tilted, 3), ellipse = new Geom_Ellipse(tilted, 5, 2);
    const Handle(Geom_Curve) parabola = new Geom_Parabola(tilted, 0.7), hyperbola = new Geom_Hyperbola(tilted, 2, 1.5);
    const Handle(Geom_Curve) line = new Geom_Line(gp_Pnt(1, 2, 3), gp_Dir(1, 1, -0.3));
    curve_kind({"circle", 0, 2 * M_PI, 0, 0}, circle);
    curve_kind({"ellipse", 0, 2 * M_PI, 0, 0}, ellipse);
    curve_kind({"parabola", -30, 30, 0, 0}, parabola);
    curve_kind({"hyperbola", -3, 3, 0, 0}, hyperbola);
    curve_kind({"line", -1000, 1000, 0, 0}, line);
    curve_kind({"arc over the seam", 5, 8, 0, 0}, new Geom_TrimmedCurve(circle, 5, 8));
    curve_kind({"arc of an ellipse", 1, 1.3, 0, 0}, new Geom_TrimmedCurve(ellipse, 1, 1.3));
    curve_kind({"part of a parabola", -2, 5, 0, 0}, new Geom_TrimmedCurve(parabola, -2, 5));
    curve_kind({"part of a hyperbola", -1, 2.5, 0, 0}, new Geom_TrimmedCurve(hyperbola, -1, 2.5));
    curve_kind({"ray", 2, 500, 0, 0}, new Geom_TrimmedCurve(line, 2, Precision::Infinite()));
    for (int degree = 2; degree <= 4; degree++) {
        const Handle(Geom_BSplineCurve) open = spline(false, degree == 3, degree), closed = spline(true, degree == 3, degree);
        const double a = closed->FirstParameter(), b = closed->LastParameter();
        curve_kind({"spline", open->FirstParameter(), open->LastParameter(), 0, 0}, open);
        curve_kind({"periodic spline", a, b, 0, 0}, closed);
        curve_kind({"part of a spline", 3.1, 6.2, 0, 0}, new Geom_TrimmedCurve(open, 3.1, 6.2));
        curve_kind({"part over the seam of a periodic spline", b - 1.5, b + 2.2, 0, 0}, new Geom_TrimmedCurve(closed, b - 1.5, b + 2.2));
    }
    // What OCCT's own conversion makes of closed conics: periodic, with knots as often as the degree at the seam too.
    for (const auto &[name, conic] : {std::pair{"circle", circle}, std::pair{"ellipse", ellipse}}) {
        const Handle(Geom_BSplineCurve) converted = GeomConvert::CurveToBSplineCurve(conic);
        expect(converted->IsPeriodic() && converted->Multiplicity(1) == 2, name, "not what this part is for");
        const double a = converted->FirstParameter(), b = converted->LastParameter();
        curve_kind({std::string("converted ") + name, a, b, 0, 0}, converted);
        curve_kind({std::string("part of a converted ") + name, b - 1, b + 1.5, 0, 0}, new Geom_TrimmedCurve(converted, b - 1, b + 1.5));
        // The seam elsewhere: at a knot that is not the first.
        const Handle(Geom_BSplineCurve) moved = Handle(Geom_BSplineCurve)::DownCast(converted->Copy());
        moved->SetOrigin(2);
        curve_kind({std::string("converted, moved ") + name, moved->FirstParameter(), moved->LastParameter(), 0, 0}, moved);
    }
    TColgp_Array1OfPnt poles(1, 6);
    for (int i = 1; i <= 6; i++) poles(i) = gp_Pnt(i, unit() * 3, unit() * 3);
    const Handle(Geom_Curve) bezier = new Geom_BezierCurve(poles);
    curve_kind({"Bezier", 0, 1, 0, 0}, bezier);
    curve_kind({"part of a Bezier", 0.2, 0.7, 0, 0}, new Geom_TrimmedCurve(bezier, 0.2, 0.7));
    curve_kind({"offset curve", 0, 1, 0, 0, false}, new Geom_OffsetCurve(bezier, 0.2, gp_Dir(0, 0, 1)));
}

void surfaces() {
    const double turn = 2 * M_PI, far = 40;
    const gp_Ax3 right(tilted);
    gp_Ax3 left = right;
    left.YReverse();
    for (const gp_Ax3 &place : {right, left}) {
        const std::string hand = place.Direct() ? "" : ", left-handed";
        surface_kind({"plane" + hand, -far, far, -far, far}, new Geom_Plane(place));
        surface_kind({"cylinder" + hand, 0, turn, -far, far}, new Geom_CylindricalSurface(place, 2));
        surface_kind({"cone" + hand, 0, turn, -far, far}, new Geom_ConicalSurface(place, 0.4, 2));
        surface_kind({"narrowing cone" + hand, 0, turn, -far, far}, new Geom_ConicalSurface(place, -0.7, 2));
        surface_kind({"sphere" + hand, 0, turn, -M_PI_2, M_PI_2}, new Geom_SphericalSurface(place, 2));
        surface_kind({"torus" + hand, 0, turn, 0, turn}, new Geom_ToroidalSurface(place, 5, 1));
        surface_kind({"spindle torus" + hand, 0, turn, 0, turn}, new Geom_ToroidalSurface(place, 1, 1.5));
    }
    const Handle(Geom_Surface) cylinder = new Geom_CylindricalSurface(right, 2);
    const Handle(Geom_Surface) part = new Geom_RectangularTrimmedSurface(cylinder, 5., 8., -1., 4.);
    surface_kind({"part of a cylinder over the seam", 5, 8, -1, 4}, part);
    surface_kind({"half cylinder without end", 0, turn, 1, far}, new Geom_RectangularTrimmedSurface(cylinder, 1., Precision::Infinite(), Standard_False));
    for (int k = 0; k < 4; k++) {
        const Handle(Geom_BSplineSurface) s = spline_surface(k & 1, k & 2);
        double u1, u2, v1, v2;
        s->Bounds(u1, u2, v1, v2);
        surface_kind({"spline, periodic " + std::to_string(k), u1, u2, v1, v2}, s);
        surface_kind({"part of a spline, periodic " + std::to_string(k), u1 + 1.2, u2 - 0.6, v1 + 0.7, v2 - 1.1},
                     new Geom_RectangularTrimmedSurface(s, u1 + 1.2, u2 - 0.6, v1 + 0.7, v2 - 1.1));
        if (k == 3)
            surface_kind({"part over both seams", u2 - 1, u2 + 2, v2 - 1.4, v2 + 0.3},
                         new Geom_RectangularTrimmedSurface(s, u2 - 1, u2 + 2, v2 - 1.4, v2 + 0.3));
    }
    const std::pair<std::string, Handle(Geom_Surface)> closed_surfaces[] = {
        {"converted sphere", new Geom_SphericalSurface(right, 2)}, {"converted torus", new Geom_ToroidalSurface(right, 5, 1)},
        {"converted cylinder", new Geom_RectangularTrimmedSurface(cylinder, -2., 3., Standard_False)}};
    for (const auto &[name, shape] : closed_surfaces) {
        const Handle(Geom_BSplineSurface) s = GeomConvert::SurfaceToBSplineSurface(shape);
        expect(s->IsUPeriodic() && s->UMultiplicity(1) == 2, name, "not what this part is for");
        double u1, u2, v1, v2;
        s->Bounds(u1, u2, v1, v2);
        surface_kind({name, u1, u2, v1, v2}, s);
        surface_kind({"part of a " + name, u2 - 1, u2 + 0.5, v1, v2}, new Geom_RectangularTrimmedSurface(s, u2 - 1, u2 + 0.5, v1, v2));
    }
    TColgp_Array2OfPnt poles(1, 4, 1, 5);
    for (int i = 1; i <= 4; i++)
        for (int j = 1; j <= 5; j++) poles(i, j) = gp_Pnt(2 * i, 2 * j, 3 * unit());
    const Handle(Geom_Surface) bezier = new Geom_BezierSurface(poles);
    surface_kind({"Bezier", 0, 1, 0, 1}, bezier);

    const gp_Ax1 axis(gp_Pnt(-3, 0, 0), gp_Dir(0.1, 1, 0.2));
    const Handle(Geom_Curve) open = spline(false, true, 3), closed = spline(true, false, 3);
    surface_kind({"revolution of a spline", 0, turn, open->FirstParameter(), open->LastParameter()}, new Geom_SurfaceOfRevolution(open, axis));
    surface_kind({"revolution of a closed spline", 0, turn, closed->FirstParameter(), closed->LastParameter()},
                 new Geom_SurfaceOfRevolution(closed, axis));
    surface_kind({"revolution of a skew line", 0, turn, -far, far},
                 new Geom_SurfaceOfRevolution(new Geom_Line(gp_Pnt(1, 2, 3), gp_Dir(1, 1, -0.3)), axis));
    surface_kind({"revolution of a parabola", 0, turn, -8, 8}, new Geom_SurfaceOfRevolution(new Geom_Parabola(tilted, 0.7), axis));
    surface_kind({"extrusion of an ellipse", 0, turn, -far, far},
                 new Geom_SurfaceOfLinearExtrusion(new Geom_Ellipse(tilted, 5, 2), gp_Dir(0.3, 1, 1)));
    surface_kind({"extrusion of a spline", open->FirstParameter(), open->LastParameter(), -far, far},
                 new Geom_SurfaceOfLinearExtrusion(open, gp_Dir(0.3, 0.2, 1)));
    surface_kind({"extrusion of a line", -far, far, -far, far},
                 new Geom_SurfaceOfLinearExtrusion(new Geom_Line(gp_Pnt(1, 2, 3), gp_Dir(1, 1, -0.3)), gp_Dir(1, 0.5, 0)));
    surface_kind({"offset of a Bezier", 0, 1, 0, 1, false}, new Geom_OffsetSurface(bezier, 0.1));
    surface_kind({"offset of a cylinder", 0, turn, -far, far}, new Geom_OffsetSurface(cylinder, 0.5));
    surface_kind({"offset of a plane", -far, far, -far, far}, new Geom_OffsetSurface(new Geom_Plane(right), 0.5));
    surface_kind({"offset of a sphere", 0, turn, -M_PI_2, M_PI_2}, new Geom_OffsetSurface(new Geom_SphericalSurface(right, 2), -0.5));
}

/** OCCT has closed forms for the quadrics and the torus: their lists must be ours, distance by distance. The apex of a cone, where
 *  all parameters in u are one point, is stationary too: ours may have it, OCCT's leave it out. */
void lists() {
    const gp_Ax3 place(tilted);
    const std::pair<std::string, Handle(Geom_Surface)> shapes[] = {{"plane", new Geom_Plane(place)},
                                                                   {"cylinder", new Geom_CylindricalSurface(place, 2)},
                                                                   {"cone", new Geom_ConicalSurface(place, 0.4, 2)},
                                                                   {"sphere", new Geom_SphericalSurface(place, 2)},
                                                                   {"torus", new Geom_ToroidalSurface(place, 5, 1)}};
    for (const auto &[name, shape] : shapes) {
        for (int i = 0; i < 25; i++) {
            const gp_Pnt q = somewhere(7);
            const ::GeomAPI_ProjectPointOnSurf theirs(q, shape);
            const fo::GeomAPI_ProjectPointOnSurf ours(q, shape);
            std::vector<double> distances;
            for (int k = 1; k <= theirs.NbPoints(); k++) distances.push_back(theirs.Distance(k));
            std::sort(distances.begin(), distances.end());
            expect(ours.IsComplete(), name, "list complete");
            const auto cone = Handle(Geom_ConicalSurface)::DownCast(shape);
            std::size_t next = 0;
            for (int k = 1; k <= ours.NbPoints(); k++) {
                double u, v;
                ours.Parameters(k, u, v);
                expect(shape->Value(u, v).Distance(ours.Point(k)) < 1e-11, name, "parameters of the list", u, v);
                if (!cone.IsNull() && ours.Point(k).Distance(cone->Apex()) < 1e-12) continue;
                expect(next < distances.size(), name, "longer than OCCT's list", ours.Distance(k));
                if (next < distances.size())
                    expect(std::abs(ours.Distance(k) - distances[next]) < 1e-10, name, "distance of the list", ours.Distance(k), distances[next]);
                next++;
            }
            expect(next == distances.size(), name, "length of the list", double(next), double(distances.size()));
        }
    }
}

} // namespace

int main() {
    return run(Part("curves", curves), Part("surfaces", surfaces), Part("lists", lists));
}
