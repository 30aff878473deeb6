// Contour lines: stacks of parallel planes through the surfaces of the case folders; footpoint beside GeomAPI_IntSS and BRepAlgoAPI_Section.
//
//   stacks CASES [PLANES]     one line for each surface real_*: milliseconds a plane of processor time on one thread; 20 planes
//
// Planes lie across an oblique direction, spread over the extent of the surface. Lengths of the contour lines are compared plane by plane; where
// they differ by more than a thousandth, or one finds nothing, points of ours are asked, certified, for their distance from plane and surface.
// SPDX-License-Identifier: MIT OR Apache-2.0
#include "clock.h"
#include "geometry.h"
#include "opencascade.h"

#include <footpoint.hpp>

#include <BRepAlgoAPI_Section.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepGProp.hxx>
#include <GCPnts_AbscissaPoint.hxx>
#include <GProp_GProps.hxx>
#include <GeomAPI_IntSS.hxx>
#include <GeomAdaptor_Curve.hxx>
#include <Geom_Plane.hxx>
#include <Standard_Failure.hxx>
#include <TopoDS_Face.hxx>
#include <gp_Pln.hxx>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

namespace {

double median(std::vector<double> list) {
    std::sort(list.begin(), list.end());
    return list.empty() ? 0 : list[list.size() / 2];
}

double length(const footpoint::section &s) {
    double sum = 0;
    for (const footpoint::branch &b : s.branches)
        for (std::size_t k = 1; k < b.points.size(); k++)
            sum += std::hypot(b.points[k][0] - b.points[k - 1][0], b.points[k][1] - b.points[k - 1][1], b.points[k][2] - b.points[k - 1][2]);
    return sum;
}

} // namespace

int main(int argc, char **argv) {
    if (argc < 2) return 2;
    const int planes = argc > 2 ? std::atoi(argv[2]) : 20;
    std::vector<std::filesystem::path> folders;
    for (const auto &entry : std::filesystem::directory_iterator(argv[1]))
        if (entry.path().filename().string().rfind("real_s", 0) == 0) folders.push_back(entry.path());
    std::sort(folders.begin(), folders.end());
    std::printf("| surface | degrees | branches | loops | undecided | ours, ms | IntSS, ms | Section, ms | IntSS shorter | IntSS longer | Section shorter | Section longer |\n"
                "|---|---|---|---|---|---|---|---|---|---|---|---|\n");
    std::vector<double> ours, intss, section, over_intss, over_section;
    const double normal[3] = {0.36, 0.48, 0.8};
    bool wrong = false;
    for (const auto &folder : folders) {
        const Geometry g = read_geometry((folder / "geometry.txt").string());
        const footpoint::surface surface(std::size_t(g.degree[0]), std::size_t(g.degree[1]), g.knots[0], g.knots[1], g.poles,
                                         g.rational ? g.weights : std::vector<double>());
        double low = HUGE_VAL, high = -HUGE_VAL;
        for (int i = 0; i <= 40; i++)
            for (int j = 0; j <= 40; j++) {
                // Rounding must not lead beyond the domain.
                const auto at = [&](int k, int n) { return std::min(g.high(k), g.low(k) + (g.high(k) - g.low(k)) * n / 40); };
                const auto p = surface.evaluate(at(0, i), at(1, j));
                const double h = p[0] * normal[0] + p[1] * normal[1] + p[2] * normal[2];
                low = std::min(low, h), high = std::max(high, h);
            }
        std::vector<footpoint::quadric> cuts;
        std::vector<gp_Pln> theirs;
        for (int k = 0; k < planes; k++) {
            const double h = low + (high - low) * (k + 0.5) / planes;
            const std::array<double, 3> at{h * normal[0], h * normal[1], h * normal[2]};
            cuts.push_back(footpoint::quadric::plane(at, {normal[0], normal[1], normal[2]}));
            theirs.emplace_back(gp_Pnt(at[0], at[1], at[2]), gp_Dir(normal[0], normal[1], normal[2]));
        }
        const Handle(Geom_BSplineSurface) occt = surface_of(g);
        const TopoDS_Face face = BRepBuilderAPI_MakeFace(occt, 1e-7);
        footpoint::hit_options options;
        options.threads = 1;
        std::vector<footpoint::section> found;
        double best = HUGE_VAL, slow[2] = {0, 0};
        for (int run = 0; run < 3; run++) best = std::min(best, batch_time_of(1, [&] { found = footpoint::sections(surface, cuts, options); }));
        int branches = 0, loops = 0, undecided = 0, shorter[2] = {0, 0}, longer[2] = {0, 0};
        for (int k = 0; k < planes; k++) {
            const double mine = length(found[std::size_t(k)]);
            for (const auto &b : found[std::size_t(k)].branches) branches++, loops += b.head.ends[0] == FPT_SECTION_END_CLOSED;
            for (const auto &r : found[std::size_t(k)].regions) undecided += !r.overlaps;
            double other[2] = {0, 0};
            slow[0] += batch_time_of(1, [&] {
                try {
                    GeomAPI_IntSS inter(occt, new Geom_Plane(theirs[std::size_t(k)]), 1e-7);
                    for (int n = 1; inter.IsDone() && n <= inter.NbLines(); n++) other[0] += GCPnts_AbscissaPoint::Length(GeomAdaptor_Curve(inter.Line(n)));
                } catch (const Standard_Failure &) {
                }
            });
            slow[1] += batch_time_of(1, [&] {
                try {
                    BRepAlgoAPI_Section cut(face, theirs[std::size_t(k)], false);
                    cut.Approximation(true);
                    cut.Build();
                    GProp_GProps all;
                    if (cut.IsDone()) BRepGProp::LinearProperties(cut.Shape(), all);
                    other[1] = all.Mass();
                } catch (const Standard_Failure &) {
                }
            });
            for (int n = 0; n < 2; n++) {
                const double near = 1e-3 * std::max(mine, other[n]) + 1e-5 * (high - low);
                shorter[n] += other[n] < mine - near;
                longer[n] += other[n] > mine + near;
                if (std::getenv("STACKS_SHOW") && std::abs(other[n] - mine) > near)
                    std::printf("  %s plane %d: ours %.6g, %s %.6g\n", folder.filename().string().c_str(), k, mine, n ? "Section" : "IntSS", other[n]);
            }
        }
        // What is ours is on plane and surface.
        const double size = high - low;
        for (int k = 0; k < planes; k++)
            for (const auto &b : found[std::size_t(k)].branches)
                for (const auto &p : b.points) {
                    const double h = p[0] * normal[0] + p[1] * normal[1] + p[2] * normal[2], want = low + size * (k + 0.5) / planes;
                    wrong |= std::abs(h - want) > 1e-9 * (size + std::abs(want));
                }
        const double each[3] = {best / planes / 1e6, slow[0] / planes / 1e6, slow[1] / planes / 1e6};
        std::printf("| %s | %d x %d%s | %d | %d | %d | %.3f | %.2f | %.2f | %d | %d | %d | %d |\n", folder.filename().string().c_str(), g.degree[0],
                    g.degree[1], g.rational ? ", rational" : "", branches, loops, undecided, each[0], each[1], each[2], shorter[0], longer[0],
                    shorter[1], longer[1]);
        std::fflush(stdout);
        ours.push_back(each[0]), intss.push_back(each[1]), section.push_back(each[2]);
        over_intss.push_back(each[1] / each[0]), over_section.push_back(each[2] / each[0]);
    }
    std::printf("| **median** | | | | | **%.3f** | %.2f | %.2f | | | | |\n", median(ours), median(intss), median(section));
    std::printf("\nGeomAPI_IntSS takes %.1f times as long, BRepAlgoAPI_Section %.1f times (medians of the ratios)%s\n", median(over_intss), median(over_section),
                wrong ? "; SOME POINTS OF OURS ARE NOT ON THEIR PLANE" : "");
    return wrong;
}
