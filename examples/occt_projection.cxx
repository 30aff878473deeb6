// OpenCASCADE's projection and footpoint's in one program: the same calls, two namespaces.
//
//   c++ -std=c++17 -O2 -I/usr/include/opencascade occt_projection.cxx -o occt_projection -lfootpoint -lTKShHealing -lTKGeomAlgo
//       -lTKBRep -lTKGeomBase -lTKG3d -lTKMath -lTKernel
#include <footpoint_occt.hxx>

#include <GeomAPI_ProjectPointOnSurf.hxx>
#include <Geom_BezierSurface.hxx>
#include <Geom_SphericalSurface.hxx>
#include <TColgp_Array2OfPnt.hxx>

#include <cmath>
#include <cstdio>

namespace before {

void project(const Handle(Geom_Surface) & surface, const gp_Pnt &point) {
    const GeomAPI_ProjectPointOnSurf projection(point, surface);
    if (projection.NbPoints() == 0) {
        std::printf("  OCCT:      no point\n");
        return;
    }
    double u, v;
    projection.LowerDistanceParameters(u, v);
    std::printf("  OCCT:      (%.6f, %.6f), %.6f mm\n", u, v, projection.LowerDistance());
}

} // namespace before

namespace after {

using footpoint::occt::GeomAPI_ProjectPointOnSurf; // the one line

void project(const Handle(Geom_Surface) & surface, const gp_Pnt &point) {
    const GeomAPI_ProjectPointOnSurf projection(point, surface);
    if (projection.NbPoints() == 0) {
        std::printf("  footpoint: no point\n");
        return;
    }
    double u, v;
    projection.LowerDistanceParameters(u, v);
    std::printf("  footpoint: (%.6f, %.6f), %.6f mm%s\n", u, v, projection.LowerDistance(), projection.IsProven() ? ", proven" : "");
}

} // namespace after

int main() {
    TColgp_Array2OfPnt poles(1, 4, 1, 4);
    for (int i = 1; i <= 4; i++)
        for (int j = 1; j <= 4; j++) poles(i, j) = gp_Pnt(10 * (i - 1), 10 * (j - 1), (i == 2 || i == 3) && (j == 2 || j == 3) ? 12 : 0);
    const Handle(Geom_Surface) hill = new Geom_BezierSurface(poles);
    const Handle(Geom_Surface) sphere = new Geom_SphericalSurface(gp_Ax3(), 10);

    std::printf("above the hill\n");
    before::project(hill, gp_Pnt(12, 17, 9));
    after::project(hill, gp_Pnt(12, 17, 9));
    std::printf("beyond an edge\n");
    before::project(hill, gp_Pnt(-3, 14, 1));
    after::project(hill, gp_Pnt(-3, 14, 1));

    // Round the seam of the sphere: NextValueOfUV goes on past 2 pi.
    const Handle(footpoint::occt::ShapeAnalysis_Surface) analysis = new footpoint::occt::ShapeAnalysis_Surface(sphere);
    gp_Pnt2d at(6.0, 0.0);
    std::printf("round the seam:");
    for (int tenths = 61; tenths <= 65; tenths++) {
        const double angle = tenths / 10.0;
        at = analysis->NextValueOfUV(at, gp_Pnt(10 * std::cos(angle), 10 * std::sin(angle), 0), 1e-7);
        std::printf(" %.4f", at.X());
    }
    std::printf("\n");

    // Every parameter of the north pole: an arc of longitudes.
    const footpoint::occt::members pole = footpoint::occt::surface(sphere).preimage(gp_Pnt(0, 0, 10));
    for (const footpoint::occt::member &m : pole.List)
        std::printf("the pole: U from %.4f to %.4f, V = %.4f\n", m.URange[0], m.URange[1], m.V);
    return pole.List.size() == 1 && std::abs(at.X() - 6.5) < 1e-9 ? 0 : 1;
}
