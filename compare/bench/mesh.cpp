// SPDX-License-Identifier: MIT OR Apache-2.0
#include "mesh.h"

#include <algorithm>

namespace {

// Pieces per knot span at most, and points of the mesh at most: more would be no mesh that a tool makes.
constexpr int MOST_PIECES = 64;
constexpr size_t MOST_POINTS = 2000000;

// Ends of the spans that have a length.
std::vector<double> spans_of(const Spline &shape, int k) {
    std::vector<double> list = shape.geometry().knots[k];
    list.erase(std::unique(list.begin(), list.end()), list.end());
    const auto outside = [&](double x) { return x < shape.low(k) || x > shape.high(k); };
    list.erase(std::remove_if(list.begin(), list.end(), outside), list.end());
    return list;
}

std::vector<double> divided(const std::vector<double> &spans, int pieces) {
    std::vector<double> list;
    for (size_t i = 0; i + 1 < spans.size(); i++) {
        for (int k = 0; k < pieces; k++) {
            list.push_back(spans[i] + (spans[i + 1] - spans[i]) * k / pieces);
        }
    }
    list.push_back(spans.back());
    return list;
}

// How far chords along direction k leave the shape in their middle, on lines of the other direction.
double sag(const Spline &shape, int k, const std::vector<double> &along, const std::vector<double> &across) {
    double worst = 0.0;
    const size_t step = std::max<size_t>(1, across.size() / 200);
    for (size_t j = 0; j < across.size(); j += step) {
        const auto at = [&](double t) { return shape.point(k == 0 ? Pair{t, across[j]} : Pair{across[j], t}); };
        Vec last = at(along[0]);
        for (size_t i = 1; i < along.size(); i++) {
            const Vec next = at(along[i]), middle = at(0.5 * (along[i - 1] + along[i]));
            Vec off;
            for (size_t c = 0; c < 3; c++) {
                off[c] = middle[c] - 0.5 * (last[c] + next[c]);
            }
            worst = std::max(worst, norm(off));
            last = next;
        }
    }
    return worst;
}

// The parameters along direction k: spans halved until the sag is half of the deflection (the other direction has the rest).
std::vector<double> grid_of(const Spline &shape, int k, double deflection) {
    const std::vector<double> spans = spans_of(shape, k);
    std::vector<double> across = {0.0};
    if (!shape.is_curve()) {
        across = divided(spans_of(shape, 1 - k), 4);
        deflection *= 0.5;
    }
    int pieces = 1;
    while (pieces < MOST_PIECES && sag(shape, k, divided(spans, pieces), across) > deflection) {
        pieces *= 2;
    }
    return divided(spans, pieces);
}

bool has_area(const Mesh &mesh, const std::array<int, 3> &face) {
    const Vec a = minus(mesh.points[size_t(face[1])], mesh.points[size_t(face[0])]);
    const Vec b = minus(mesh.points[size_t(face[2])], mesh.points[size_t(face[0])]);
    const double square = dot(a, a) * dot(b, b) - dot(a, b) * dot(a, b);
    return square > 1e-24 * dot(a, a) * dot(b, b);
}

} // namespace

Mesh mesh_of(const Spline &shape, double deflection) {
    Mesh mesh;
    const std::vector<double> us = grid_of(shape, 0, deflection);
    std::vector<double> vs = shape.is_curve() ? std::vector<double>{0.0} : grid_of(shape, 1, deflection);
    if (us.size() * vs.size() > MOST_POINTS) {
        return mesh;
    }
    for (double u : us) {
        for (double v : vs) {
            mesh.places.push_back({u, v});
            mesh.points.push_back(shape.point({u, v}));
        }
    }
    const int columns = int(vs.size());
    for (int i = 0; i + 1 < int(us.size()); i++) {
        for (int j = 0; j + 1 < columns; j++) {
            const int at = i * columns + j;
            for (const std::array<int, 3> &face : {std::array<int, 3>{at, at + columns, at + columns + 1},
                                                   std::array<int, 3>{at, at + columns + 1, at + 1}}) {
                if (has_area(mesh, face)) {
                    mesh.faces.push_back(face);
                }
            }
        }
        if (shape.is_curve() && mesh.points[size_t(i)] != mesh.points[size_t(i + 1)]) {
            mesh.faces.push_back({i, i + 1, i + 1});
        }
    }
    return mesh;
}
