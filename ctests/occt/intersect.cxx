// The drop-in GeomAPI_IntSS beside OpenCASCADE's on pairs of elementary surfaces: as many lines, and lines on both surfaces.
#include "check.hxx"

#include <footpoint_occt.hxx>

#include <GeomAPI_IntSS.hxx>
#include <GeomAPI_ProjectPointOnSurf.hxx>
#include <Geom_CylindricalSurface.hxx>
#include <Geom_Plane.hxx>
#include <Geom_RectangularTrimmedSurface.hxx>
#include <Geom_SphericalSurface.hxx>
#include <Geom_ToroidalSurface.hxx>

namespace {

Handle(Geom_Surface) plane(double z, double slope) {
    const gp_Ax3 place(gp_Pnt(0, 0, z), gp_Dir(slope, 0, 1));
    return new Geom_RectangularTrimmedSurface(new Geom_Plane(place), -20.0, 20.0, -20.0, 20.0);
}

Handle(Geom_Surface) cylinder(double radius, const gp_Dir &axis) {
    return new Geom_RectangularTrimmedSurface(new Geom_CylindricalSurface(gp_Ax3(gp_Pnt(0, 0, 0), axis), radius), -15.0, 15.0, Standard_False);
}

double length(const Handle(Geom_Curve) &line) {
    double sum = 0;
    const double a = line->FirstParameter(), b = line->LastParameter();
    for (int i = 0; i < 400; i++) sum += line->Value(a + (b - a) * i / 400).Distance(line->Value(a + (b - a) * (i + 1) / 400));
    return sum;
}

template <class Lines>
double total(const Lines &found) {
    double sum = 0;
    for (int i = 1; i <= found.NbLines(); i++) sum += length(found.Line(i));
    return sum;
}

void compare(const char *name, const Handle(Geom_Surface) &a, const Handle(Geom_Surface) &b) {
    const footpoint::occt::GeomAPI_IntSS ours(a, b, 1e-6);
    const ::GeomAPI_IntSS theirs(a, b, 1e-6);
    expect(ours.IsDone() && theirs.IsDone(), name, "ours.IsDone() && theirs.IsDone()");
    expect(ours.NbLines() > 0, name, "ours.NbLines() > 0");
    const double x = total(ours), y = total(theirs);
    if (std::abs(x - y) > 2e-3 * y) std::printf("%s: lengths %.6f and %.6f\n", name, x, y);
    expect(std::abs(x - y) <= 2e-3 * y, name, "std::abs(x - y) <= 2e-3 * y");
    for (int i = 1; i <= ours.NbLines(); i++) {
        const Handle(Geom_Curve) &line = ours.Line(i);
        for (int k = 0; k <= 20; k++) {
            const double t = line->FirstParameter() + (line->LastParameter() - line->FirstParameter()) * k / 20;
            for (const Handle(Geom_Surface) & s : {a, b}) {
                const footpoint::occt::GeomAPI_ProjectPointOnSurf foot(line->Value(t), s);
                expect(foot.LowerDistance() <= 1e-6, name, "foot.LowerDistance() <= 1e-6");
            }
        }
    }
}

void pairs() {
    const Handle(Geom_Surface) ball = new Geom_SphericalSurface(gp_Ax3(), 5);
    const Handle(Geom_Surface) ring = new Geom_ToroidalSurface(gp_Ax3(), 8, 3);
    compare("sphere, plane", ball, plane(1, 0.3));
    compare("torus, plane", ring, plane(0.5, 0.2));
    compare("cylinder, cylinder", cylinder(4, gp_Dir(0, 0, 1)), cylinder(2.5, gp_Dir(1, 0.1, 0)));
    compare("torus, sphere", ring, new Geom_SphericalSurface(gp_Ax3(gp_Pnt(7, 1, 0.5), gp_Dir(0, 1, 2)), 4));
}

void refusals() {
    bool refused = false;
    try {
        footpoint::occt::GeomAPI_IntSS(new Geom_Plane(gp_Ax3()), new Geom_SphericalSurface(gp_Ax3(), 5), 1e-6);
    } catch (const Standard_ConstructionError &) {
        refused = true;
    }
    expect(refused, "an unbounded plane", "refused");
}

} // namespace

int main() {
    return run(Part("pairs", pairs), Part("refusals", refusals));
}
