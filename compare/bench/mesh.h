// Triangles (of a curve: segments) within a deflection of a shape. SPDX-License-Identifier: MIT OR Apache-2.0
#ifndef BENCH_MESH_H
#define BENCH_MESH_H

#include "spline.h"

struct Mesh {
    std::vector<Vec> points;
    // Parameters of each point.
    std::vector<Pair> places;
    // Three points each; of a segment the first two count. Those without extent are left out.
    std::vector<std::array<int, 3>> faces;
};

// `deflection` in the unit of length.
Mesh mesh_of(const Spline &shape, double deflection);

#endif
