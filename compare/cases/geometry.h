// The case folders as numbers: geometry.txt and queries.csv (format: tests/data/README.md).
// Curves are treated as surfaces without v. SPDX-License-Identifier: MIT OR Apache-2.0
#ifndef COMPARE_GEOMETRY_H
#define COMPARE_GEOMETRY_H

#include <array>
#include <cstddef>
#include <string>
#include <vector>

using Vec = std::array<double, 3>;
using Pair = std::array<double, 2>;

inline double dot(const Vec &a, const Vec &b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Vec minus(const Vec &a, const Vec &b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double norm(const Vec &a);

struct Query {
    Vec point;
    // The class: on, near, off, far, edge, seam, pole, sing, medial.
    std::string kind;
    // The proven least distance, and one place where it is attained (curves: v = 0).
    double distance;
    Pair at;
    int row;
};

// The numbers of a geometry.txt.
struct Geometry {
    bool is_curve = false;
    int degree[2] = {0, 0};
    int count[2] = {1, 1};
    bool rational = false;
    std::vector<double> knots[2];
    std::vector<double> poles;
    std::vector<double> weights;

    int dimensions() const { return is_curve ? 1 : 2; }
    double low(int k) const { return knots[k][size_t(degree[k])]; }
    double high(int k) const { return knots[k][size_t(count[k])]; }
};

Geometry read_geometry(const std::string &path);
std::vector<Query> read_queries(const std::string &path);
// At most `most` queries, spread evenly over the classes and within each.
std::vector<Query> spread(const std::vector<Query> &all, size_t most);
// At most `most` queries, each class with its share of all, in a fixed mixed order.
std::vector<Query> sample(std::vector<Query> all, size_t most);

#endif
