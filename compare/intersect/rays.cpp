// Rays against the surfaces of the case folders: footpoint, CGAL's tree on a mesh, IntCurvesFace_Intersector, in turns.
//
//   rays CASES [RAYS]     one line for each surface real_*: rays per second of processor time on one thread; 20000 rays
//
// Rays go from around the surface to random points of it, moved by up to a twentieth of the diagonal: many hit, some touch, some miss;
// no two follow each other. The mesh is within 1e-3 of the diagonal of the surface and proves nothing.
// SPDX-License-Identifier: MIT OR Apache-2.0
#include "clock.h"
#include "geometry.h"
#include "mesh.h"
#include "opencascade.h"

#include <footpoint.hpp>

#include <BRepBuilderAPI_MakeFace.hxx>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>
#include <IntCurvesFace_Intersector.hxx>
#include <TopoDS_Face.hxx>
#include <gp_Lin.hxx>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <random>

namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Triangle = Kernel::Triangle_3;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, CGAL::AABB_triangle_primitive<Kernel, std::vector<Triangle>::const_iterator>>>;

constexpr int RUNS = 3;

struct Rays {
    std::vector<double> origins, directions;
    std::size_t count() const { return origins.size() / 3; }
};

Rays rays_at(const Spline &shape, std::size_t count) {
    std::mt19937_64 random(42);
    const auto between = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
    Vec low{HUGE_VAL, HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    const std::vector<double> &poles = shape.geometry().poles;
    for (std::size_t i = 0; i < poles.size(); i++) {
        low[i % 3] = std::min(low[i % 3], poles[i]);
        high[i % 3] = std::max(high[i % 3], poles[i]);
    }
    Rays out;
    for (std::size_t k = 0; k < count; k++) {
        const Vec target = shape.point({between(shape.low(0), shape.high(0)), between(shape.low(1), shape.high(1))});
        Vec d{};
        for (double &x : d) x = between(-1, 1);
        for (std::size_t c = 0; c < 3; c++) {
            const double origin = 0.5 * (low[c] + high[c]) + shape.diagonal() * d[c];
            out.origins.push_back(origin);
            out.directions.push_back(target[c] + 0.05 * shape.diagonal() * between(-1, 1) - origin);
        }
    }
    return out;
}

template <class Work> void keep_best(double &best, Work work) { best = std::min(best, batch_time_of(1, work)); }

double median(std::vector<double> list) {
    std::sort(list.begin(), list.end());
    return list.empty() ? 0 : list[list.size() / 2];
}

} // namespace

int main(int argc, char **argv) {
    if (argc < 2) return 2;
    const std::size_t wanted = argc > 2 ? std::size_t(std::atol(argv[2])) : 20000;
    std::vector<std::filesystem::path> folders;
    for (const auto &entry : std::filesystem::directory_iterator(argv[1]))
        if (entry.path().filename().string().rfind("real_s", 0) == 0) folders.push_back(entry.path());
    std::sort(folders.begin(), folders.end());
    std::printf("| surface | degrees | patches | triangles | hits a ray | not proven | ours, all | ours, first | mesh, all | mesh, first | OCCT |\n"
                "|---|---|---|---|---|---|---|---|---|---|---|\n");
    std::vector<double> all, first, mesh_all, mesh_first, occt, over_mesh, over_occt;
    for (const auto &folder : folders) {
        const Geometry g = read_geometry((folder / "geometry.txt").string());
        const Spline shape(g);
        const Rays rays = rays_at(shape, wanted);
        const std::size_t n = rays.count(), few = std::min<std::size_t>(n, 200);
        const footpoint::surface surface(std::size_t(g.degree[0]), std::size_t(g.degree[1]), g.knots[0], g.knots[1], g.poles,
                                         g.rational ? g.weights : std::vector<double>());
        const footpoint::caster caster(surface);
        footpoint::hit_options options;
        options.threads = 1;
        const Mesh mesh = mesh_of(shape, 1e-3 * shape.diagonal());
        std::vector<Triangle> triangles;
        const auto point = [](const Vec &p) { return Kernel::Point_3(p[0], p[1], p[2]); };
        for (const auto &f : mesh.faces)
            triangles.emplace_back(point(mesh.points[std::size_t(f[0])]), point(mesh.points[std::size_t(f[1])]), point(mesh.points[std::size_t(f[2])]));
        Tree tree(triangles.cbegin(), triangles.cend());
        tree.build();
        const TopoDS_Face face = BRepBuilderAPI_MakeFace(surface_of(g), 1e-7);
        IntCurvesFace_Intersector intersector(face, 1e-7);
        std::vector<Kernel::Ray_3> lines;
        for (std::size_t k = 0; k < n; k++)
            lines.emplace_back(Kernel::Point_3(rays.origins[3 * k], rays.origins[3 * k + 1], rays.origins[3 * k + 2]),
                               Kernel::Vector_3(rays.directions[3 * k], rays.directions[3 * k + 1], rays.directions[3 * k + 2]));
        std::vector<fpt_ray_hit> hits(n), nearest(n);
        std::size_t mesh_hits = 0, occt_hits = 0, some = 0;
        double best[5] = {HUGE_VAL, HUGE_VAL, HUGE_VAL, HUGE_VAL, HUGE_VAL};
        const fpt_hit_options &o = options;
        for (int run = 0; run < RUNS; run++) {
            keep_best(best[0], [&] {
                footpoint::check(fpt_caster_first(caster.get(), rays.origins.data(), rays.directions.data(), n, nullptr, &o, hits.data()));
            });
            keep_best(best[2], [&] {
                mesh_hits = 0;
                std::vector<Tree::Primitive_id> ids;
                for (const auto &line : lines) {
                    ids.clear();
                    tree.all_intersected_primitives(line, std::back_inserter(ids));
                    mesh_hits += ids.size();
                }
            });
            keep_best(best[1], [&] {
                footpoint::check(fpt_caster_nearest(caster.get(), rays.origins.data(), rays.directions.data(), n, nullptr, &o, nearest.data()));
            });
            keep_best(best[3], [&] {
                some = 0;
                for (const auto &line : lines) some += tree.first_intersected_primitive(line) ? 1 : 0;
            });
            keep_best(best[4], [&] {
                occt_hits = 0;
                for (std::size_t k = 0; k < few; k++) {
                    const double *p = rays.origins.data() + 3 * k, *d = rays.directions.data() + 3 * k;
                    intersector.Perform(gp_Lin(gp_Pnt(p[0], p[1], p[2]), gp_Dir(d[0], d[1], d[2])), 0, HUGE_VAL);
                    occt_hits += intersector.IsDone() ? std::size_t(intersector.NbPnt()) : 0;
                }
            });
        }
        std::size_t total = 0, open = 0, differ = 0;
        for (std::size_t k = 0; k < n; k++) {
            total += hits[k].count;
            open += (hits[k].flags & FPT_RAY_NOT_PROVEN) != 0;
            differ += hits[k].count > 0 ? hits[k].t != nearest[k].t : nearest[k].count != 0;
        }
        double rate[5];
        for (int k = 0; k < 5; k++) rate[k] = 1e9 * double(k < 4 ? n : few) / best[k];
        std::printf("| %s | %d x %d%s | %zu | %zu | %.2f | %zu | %.0f k | %.0f k | %.0f k | %.0f k | %.1f k |%s\n", folder.filename().string().c_str(),
                    g.degree[0], g.degree[1], g.rational ? ", rational" : "",
                    std::size_t(g.count[0] - g.degree[0]) * std::size_t(g.count[1] - g.degree[1]), triangles.size(), double(total) / double(n), open,
                    rate[0] / 1e3, rate[1] / 1e3, rate[2] / 1e3, rate[3] / 1e3, rate[4] / 1e3, differ ? "  FIRST HITS DIFFER" : "");
        std::fflush(stdout);
        all.push_back(rate[0]), first.push_back(rate[1]), mesh_all.push_back(rate[2]), mesh_first.push_back(rate[3]), occt.push_back(rate[4]);
        over_mesh.push_back(rate[0] / rate[2]), over_occt.push_back(rate[0] / rate[4]);
    }
    std::printf("| **median** | | | | | | **%.0f k** | **%.0f k** | %.0f k | %.0f k | %.1f k |\n", median(all) / 1e3, median(first) / 1e3, median(mesh_all) / 1e3,
                median(mesh_first) / 1e3, median(occt) / 1e3);
    std::printf("\nall hits: %.2f times the mesh, %.0f times OCCT (medians of the ratios)\n", median(over_mesh), median(over_occt));
}
