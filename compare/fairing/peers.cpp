// What OpenMesh's smoother and OpenCASCADE's plate make of a grid of noisy points: peers N DEVIATION <points >points
// Input: N x N points, x y z each, v fastest. Output: a line "NAME MILLISECONDS", then as many points; for each peer.
// What OpenCASCADE's battens make of two ends and their angles with the chord: peers X1 Y1 X2 Y2 A1 A2 >points, 401 points each.
// OpenMesh first: OpenCASCADE makes a macro of the name Handle.
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Smoother/JacobiLaplaceSmootherT.hh>

#include <FairCurve_Batten.hxx>
#include <FairCurve_MinimalVariation.hxx>
#include <Geom2d_BSplineCurve.hxx>
#include <GeomPlate_BuildPlateSurface.hxx>
#include <GeomPlate_MakeApprox.hxx>
#include <GeomPlate_PointConstraint.hxx>
#include <GeomPlate_Surface.hxx>
#include <Geom_BSplineSurface.hxx>
#include <GeomAPI_IntCS.hxx>
#include <Geom_Line.hxx>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <vector>

namespace {

struct traits : OpenMesh::DefaultTraits {
    typedef OpenMesh::Vec3d Point;
    typedef OpenMesh::Vec3d Normal;
};
typedef OpenMesh::TriMesh_ArrayKernelT<traits> mesh;

double now() {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void print(const char *name, double time, const std::vector<OpenMesh::Vec3d> &points) {
    std::printf("%s %.3f\n", name, time);
    for (const auto &p : points) std::printf("%.17g %.17g %.17g\n", p[0], p[1], p[2]);
}

// The smoother for C1, borders fixed, no vertex farther from where it was than the deviation.
void open_mesh(const std::vector<OpenMesh::Vec3d> &points, int n, double deviation) {
    mesh grid;
    std::vector<mesh::VertexHandle> handles;
    for (const auto &p : points) handles.push_back(grid.add_vertex(p));
    for (int i = 0; i + 1 < n; i++) {
        for (int j = 0; j + 1 < n; j++) {
            const auto a = handles[i * n + j], b = handles[i * n + j + 1], c = handles[(i + 1) * n + j], d = handles[(i + 1) * n + j + 1];
            grid.add_face(a, c, d);
            grid.add_face(a, d, b);
        }
    }
    grid.request_vertex_normals();
    grid.request_face_normals();
    grid.update_normals();
    const double start = now();
    OpenMesh::Smoother::JacobiLaplaceSmootherT<mesh> smoother(grid);
    smoother.initialize(OpenMesh::Smoother::SmootherT<mesh>::Tangential_and_Normal, OpenMesh::Smoother::SmootherT<mesh>::C1);
    smoother.set_absolute_local_error(static_cast<float>(deviation));
    smoother.smooth(200);
    const double time = now() - start;
    std::vector<OpenMesh::Vec3d> out;
    for (const auto &handle : handles) out.push_back(grid.point(handle));
    print("OpenMesh", time, out);
}

// A plate near the points, approximated by a spline, then met by the vertical lines through the points.
void plate(const std::vector<OpenMesh::Vec3d> &points, double deviation) {
    const double start = now();
    GeomPlate_BuildPlateSurface builder(3, 15, 2, 1e-5, deviation, 0.01, 0.1, Standard_False);
    for (const auto &p : points) builder.Add(new GeomPlate_PointConstraint(gp_Pnt(p[0], p[1], p[2]), 0, deviation));
    builder.Perform();
    if (!builder.IsDone()) {
        std::fprintf(stderr, "the plate was not built\n");
        return;
    }
    GeomPlate_MakeApprox approximated(builder.Surface(), deviation, 60, 5, deviation, 0);
    const Handle(Geom_BSplineSurface) surface = approximated.Surface();
    const double time = now() - start;
    std::vector<OpenMesh::Vec3d> out;
    for (const auto &p : points) {
        GeomAPI_IntCS hit(new Geom_Line(gp_Pnt(p[0], p[1], p[2]), gp_Dir(0, 0, 1)), surface);
        double best = p[2];
        double apart = 1e300;
        for (int k = 1; k <= hit.NbPoints(); k++) {
            const double z = hit.Point(k).Z();
            if (std::abs(z - p[2]) < apart) apart = std::abs(z - p[2]), best = z;
        }
        out.push_back(OpenMesh::Vec3d(p[0], p[1], best));
    }
    print("GeomPlate", time, out);
}

// A batten of OpenCASCADE: its length is free.
void batten(const char *name, FairCurve_Batten &curve, double a1, double a2) {
    curve.SetAngle1(a1);
    curve.SetAngle2(a2);
    curve.SetFreeSliding(Standard_True);
    FairCurve_AnalysisCode code;
    const double start = now();
    const bool done = curve.Compute(code, 500, 1e-8);
    const double time = now() - start;
    if (!done) std::fprintf(stderr, "%s: not computed, code %d\n", name, static_cast<int>(code));
    const Handle(Geom2d_BSplineCurve) spline = curve.Curve();
    std::vector<OpenMesh::Vec3d> out;
    for (int k = 0; k <= 400; k++) {
        const double u = spline->FirstParameter() + (spline->LastParameter() - spline->FirstParameter()) * k / 400;
        const gp_Pnt2d p = spline->Value(u);
        out.push_back(OpenMesh::Vec3d(p.X(), p.Y(), 0));
    }
    print(name, time, out);
}

} // namespace

int main(int argc, char **argv) {
    if (argc == 7) {
        const gp_Pnt2d a(std::atof(argv[1]), std::atof(argv[2])), b(std::atof(argv[3]), std::atof(argv[4]));
        FairCurve_Batten plain(a, b, 1.0);
        batten("Batten", plain, std::atof(argv[5]), std::atof(argv[6]));
        FairCurve_MinimalVariation least(a, b, 1.0);
        batten("MinimalVariation", least, std::atof(argv[5]), std::atof(argv[6]));
        return 0;
    }
    if (argc != 3) return std::fprintf(stderr, "usage: peers N DEVIATION <points, or peers X1 Y1 X2 Y2 A1 A2\n"), 2;
    const int n = std::atoi(argv[1]);
    const double deviation = std::atof(argv[2]);
    std::vector<OpenMesh::Vec3d> points;
    double x, y, z;
    while (std::scanf("%lf %lf %lf", &x, &y, &z) == 3) points.push_back(OpenMesh::Vec3d(x, y, z));
    if (n < 2 || points.size() != static_cast<std::size_t>(n) * n) return std::fprintf(stderr, "points: %zu\n", points.size()), 2;
    open_mesh(points, n, deviation);
    plate(points, deviation);
    return 0;
}
