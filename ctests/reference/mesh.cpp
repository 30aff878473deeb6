// footpoint against a mesh of the surface in OpenMesh, searched by CGAL's AABB tree: the distances may differ by the chord error of the
// mesh at most, which the second derivatives bound; and the normals of footpoint against those of OpenMesh's vertices.
// SPDX-License-Identifier: MIT OR Apache-2.0
#include "check.hpp"

#include <footpoint.hpp>

// The system headers warn.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wall"
#pragma GCC diagnostic ignored "-Wextra"
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/boost/graph/graph_traits_TriMesh_ArrayKernelT.h>
#pragma GCC diagnostic pop

#include <cmath>
#include <random>
#include <string>

namespace {

struct Traits : OpenMesh::DefaultTraits {
    using Point = OpenMesh::Vec3d;
    using Normal = OpenMesh::Vec3d;
};
using Mesh = OpenMesh::TriMesh_ArrayKernelT<Traits>;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Points = boost::property_map<Mesh, CGAL::vertex_point_t>::type;
using Primitive = CGAL::AABB_face_graph_triangle_primitive<Mesh, Points>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

std::mt19937 random_numbers(3);
double between(double a, double b) { return std::uniform_real_distribution<double>(a, b)(random_numbers); }

/** A hilly patch of two spans in each direction. */
footpoint::surface hills(std::size_t degree, bool is_rational) {
    std::vector<double> knots(degree + 1, 0.0), poles, weights;
    knots.push_back(0.5);
    knots.insert(knots.end(), degree + 1, 1.0);
    const std::size_t count = degree + 2;
    for (std::size_t i = 0; i < count; i++) {
        for (std::size_t j = 0; j < count; j++) {
            poles.insert(poles.end(), {10.0 * double(i) / double(count - 1), 10.0 * double(j) / double(count - 1), between(-2, 2)});
            if (is_rational) weights.push_back(between(0.8, 1.25));
        }
    }
    return footpoint::surface(degree, degree, knots, knots, poles, weights);
}

struct Bounds {
    // The largest second derivatives: uu, uv, vv.
    double second[3] = {0, 0, 0};
};

/** The largest second derivatives on a fine grid, with a tenth more for what lies between its points. */
Bounds bounds_of(const footpoint::surface &s) {
    Bounds out;
    const int fine = 240;
    for (int i = 0; i <= fine; i++) {
        for (int j = 0; j <= fine; j++) {
            const std::vector<double> x = s.evaluate(double(i) / fine, double(j) / fine, 2);
            for (std::size_t k = 0; k < 3; k++)
                out.second[k] = std::max(out.second[k], 1.1 * std::hypot(x[9 + 3 * k], x[10 + 3 * k], x[11 + 3 * k]));
        }
    }
    return out;
}

void surface(const char *name, const footpoint::surface &s, int cells) {
    const Bounds bounds = bounds_of(s);
    const double h = 1.0 / cells;
    // Linear interpolation on a right triangle with legs h.
    const double chord = h * h / 8 * (bounds.second[0] + 2 * bounds.second[1] + bounds.second[2]);

    Mesh mesh;
    std::vector<Mesh::VertexHandle> vertices;
    std::vector<fpt_foot_point> feet;
    for (int i = 0; i <= cells; i++) {
        for (int j = 0; j <= cells; j++) {
            const std::vector<double> x = s.evaluate(i * h, j * h);
            vertices.push_back(mesh.add_vertex(Mesh::Point(x[0], x[1], x[2])));
            fpt_foot_point foot{};
            foot.u = i * h, foot.v = j * h;
            for (std::size_t k = 0; k < 3; k++) foot.point[k] = x[k];
            feet.push_back(foot);
        }
    }
    const auto vertex = [&](int i, int j) { return vertices[std::size_t(i * (cells + 1) + j)]; };
    for (int i = 0; i < cells; i++) {
        for (int j = 0; j < cells; j++) {
            mesh.add_face(vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1));
            mesh.add_face(vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1));
        }
    }
    Tree tree(faces(mesh).first, faces(mesh).second, mesh);
    tree.accelerate_distance_queries();

    std::vector<double> points;
    for (int i = 0; i < 2000; i++) points.insert(points.end(), {between(-3, 13), between(-3, 13), between(-6, 6)});
    const std::vector<fpt_foot_point> found = s.closest(points);
    double largest = 0;
    for (std::size_t i = 0; i < found.size(); i++) {
        const Kernel::Point_3 q(points[3 * i], points[3 * i + 1], points[3 * i + 2]);
        const double by_mesh = std::sqrt(tree.squared_distance(q));
        const double off = std::abs(by_mesh - found[i].distance);
        largest = std::max(largest, off / chord);
        expect(off <= chord, name, "distance of the mesh, of footpoint, chord error", by_mesh, found[i].distance, chord);
        expect(found[i].lower_bound <= by_mesh + chord, name, "bound", found[i].lower_bound, by_mesh);
    }

    // Normals: those of the faces around a vertex differ from the surface's by the turn of the tangents over a cell.
    mesh.request_face_normals();
    mesh.request_vertex_normals();
    mesh.update_normals();
    std::vector<double> where;
    for (const fpt_foot_point &foot : feet) where.insert(where.end(), {foot.point[0], foot.point[1], foot.point[2]});
    const footpoint::directions normals = s.normals(where, feet);
    double widest = 0;
    for (std::size_t i = 0; i < feet.size(); i++) {
        const std::vector<double> x = s.evaluate(feet[i].u, feet[i].v, 1);
        const OpenMesh::Vec3d u(x[3], x[4], x[5]), v(x[6], x[7], x[8]);
        // The least stretch of a step: the smaller singular value of (Su, Sv).
        const double a = dot(u, u), b = dot(u, v), c = dot(v, v);
        const double stretch = std::sqrt((a + c - std::sqrt((a - c) * (a - c) + 4 * b * b)) / 2);
        const double turn = 2 * h * (bounds.second[0] + 2 * bounds.second[1] + bounds.second[2]) / stretch;
        const OpenMesh::Vec3d theirs = mesh.normal(vertices[i]), ours(normals.vectors[3 * i], normals.vectors[3 * i + 1], normals.vectors[3 * i + 2]);
        const double off = (ours - theirs).norm();
        widest = std::max(widest, off);
        expect(off <= turn, name, "normal of OpenMesh", off, turn);
    }
    std::printf("%s: %d triangles, distances differ by %.2g of the chord error %.2g at most, normals by %.2g\n", name, 2 * cells * cells, largest, chord,
                widest);
}

} // namespace

int main() {
    for (std::size_t degree = 2; degree <= 5; degree++) {
        surface(("degree " + std::to_string(degree)).c_str(), hills(degree, false), 120);
        surface(("rational, degree " + std::to_string(degree)).c_str(), hills(degree, true), 120);
    }
    return verdict();
}
