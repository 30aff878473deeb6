// GeomAPI_IntCS beside OCCT's own: the same points where OCCT has them, and those that it has not are on both.
// SPDX-License-Identifier: MIT OR Apache-2.0
#include "check.hxx"

#include <footpoint_occt.hxx>

#include <Geom_BezierSurface.hxx>
#include <Geom_Circle.hxx>
#include <Geom_ConicalSurface.hxx>
#include <Geom_CylindricalSurface.hxx>
#include <Geom_Ellipse.hxx>
#include <Geom_Plane.hxx>
#include <Geom_RectangularTrimmedSurface.hxx>
#include <Geom_SphericalSurface.hxx>
#include <Geom_ToroidalSurface.hxx>
#include <TColgp_Array2OfPnt.hxx>

#include <cmath>
#include <random>

namespace fo = footpoint::occt;

namespace {

std::mt19937 random_numbers(11);
double between(double a, double b) { return std::uniform_real_distribution<double>(a, b)(random_numbers); }
gp_Pnt point(double reach) { return gp_Pnt(between(-reach, reach), between(-reach, reach), between(-reach, reach)); }
gp_Ax2 place(double reach) { return gp_Ax2(point(reach), gp_Dir(between(-1, 1), between(-1, 1), between(0.1, 1))); }

Handle(Geom_Surface) waves() {
    TColgp_Array2OfPnt points(1, 9, 1, 9);
    for (int i = 1; i <= 9; i++)
        for (int j = 1; j <= 9; j++) points(i, j) = gp_Pnt(i - 5, j - 5, std::sin(1.7 * i) + std::cos(1.3 * j));
    return new Geom_BezierSurface(points);
}

void compare(const char *about, const Handle(Geom_Curve) &curve, const Handle(Geom_Surface) &surface, bool proven) {
    const ::GeomAPI_IntCS theirs(curve, surface);
    const fo::GeomAPI_IntCS ours(curve, surface);
    expect(ours.IsDone(), about, "not done");
    expect(ours.IsProven() == proven, about, proven ? "not proven" : "proven without need");
    for (int k = 1; k <= ours.NbPoints(); k++) {
        double u, v, w;
        ours.Parameters(k, u, v, w);
        expect(ours.Point(k).Distance(surface->Value(u, v)) < 1e-6, about, "a point is not on the surface at its parameters");
        expect(ours.Point(k).Distance(curve->Value(w)) < 1e-6, about, "a point is not on the curve at its parameter");
    }
    for (int k = 1; theirs.IsDone() && k <= theirs.NbPoints(); k++) {
        double u, v, w;
        theirs.Parameters(k, u, v, w);
        if (theirs.Point(k).Distance(surface->Value(u, v)) > 1e-6 || theirs.Point(k).Distance(curve->Value(w)) > 1e-6) continue;
        bool found = false;
        for (int m = 1; m <= ours.NbPoints(); m++) found |= ours.Point(m).Distance(theirs.Point(k)) < 1e-4;
        for (int m = 1; m <= ours.NbSegments(); m++) {
            const Handle(Geom_Curve) part = ours.Segment(m);
            found |= w > part->FirstParameter() - 1e-4 && w < part->LastParameter() + 1e-4;
        }
        expect(found, about, "a point of OCCT is missing");
    }
}

void random_pairs() {
    const Handle(Geom_Surface) sheet = waves();
    for (int k = 0; k < 60; k++) {
        const Handle(Geom_Curve) curves[] = {
            new Geom_Line(point(2), gp_Dir(between(-1, 1), between(-1, 1), between(-1, 1))),
            new Geom_TrimmedCurve(new Geom_Line(point(2), gp_Dir(between(-1, 1), between(-1, 1), 0.3)), -3, 3),
            new Geom_Circle(place(1), between(0.5, 3)), new Geom_Ellipse(place(1), 3, between(0.5, 2))};
        const Handle(Geom_Surface) surfaces[] = {
            new Geom_SphericalSurface(gp_Ax3(place(1)), between(1, 3)), new Geom_ToroidalSurface(gp_Ax3(place(1)), 2, between(0.3, 1)),
            new Geom_RectangularTrimmedSurface(new Geom_CylindricalSurface(gp_Ax3(place(1)), 1.5), -2.0, 2.0, false),
            new Geom_Plane(gp_Ax3(place(1))), new Geom_CylindricalSurface(gp_Ax3(place(1)), 1.5), sheet};
        for (int c = 0; c < 4; c++)
            for (int s = 0; s < 6; s++) {
                const bool both_open = c == 0 && (s == 3 || s == 4);
                char about[40];
                std::snprintf(about, sizeof about, "curve %d, surface %d, round %d", c, s, k);
                compare(about, curves[c], surfaces[s], !both_open);
            }
    }
}

void special_cases() {
    const Handle(Geom_Surface) ball = new Geom_SphericalSurface(gp_Ax3(), 2);
    // A tangent; a great circle; a line beside.
    const fo::GeomAPI_IntCS tangent(new Geom_Line(gp_Pnt(2, 0, 0), gp_Dir(0, 1, 0)), ball);
    expect(tangent.NbPoints() == 1 && tangent.Multiplicity(1) == 2, "tangent", "not one double point");
    const fo::GeomAPI_IntCS circle(new Geom_Circle(gp_Ax2(), 2), ball);
    expect(circle.NbPoints() == 0 && circle.NbSegments() >= 1, "great circle", "no segment");
    const fo::GeomAPI_IntCS beside(new Geom_Line(gp_Pnt(2.1, 0, 0), gp_Dir(0, 1, 0)), ball);
    expect(beside.NbPoints() == 0 && beside.IsProven(), "beside", "found or not proven");
    try {
        beside.Point(1);
        expect(false, "index", "nothing was thrown");
    } catch (const Standard_OutOfRange &) {
    }
    try {
        fo::GeomAPI_IntCS().NbPoints();
        expect(false, "not performed", "nothing was thrown");
    } catch (const StdFail_NotDone &) {
    }
    try {
        fo::GeomAPI_IntCS(Handle(Geom_Curve)(), ball);
        expect(false, "null", "nothing was thrown");
    } catch (const Standard_NullObject &) {
    }
}

} // namespace

int main() { return run(Part("random_pairs", random_pairs), Part("special_cases", special_cases)); }
