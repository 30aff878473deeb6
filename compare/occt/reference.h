// OpenCASCADE in a process of its own, because single calls can hang or crash. SPDX-License-Identifier: MIT OR Apache-2.0
#ifndef COMPARE_REFERENCE_H
#define COMPARE_REFERENCE_H

#include "shape.h"

#include <vector>

// TREE gives the least and the greatest distance only, GRAD what grows from a grid of samples; curves have one algorithm.
enum class Algorithm { CURVE, TREE, GRAD };

struct ReferenceAnswer {
    enum State { DONE, FAILED, CRASHED, HUNG, SKIPPED } state = SKIPPED;
    double seconds = 0;
    std::vector<Pair> solutions;
};

// All answers for a case. A call may take `query_seconds`, all of them `case_seconds`; then the rest is SKIPPED.
std::vector<ReferenceAnswer> reference_answers(const Geometry &geometry, Algorithm algorithm,
                                               const std::vector<Query> &queries, double query_seconds,
                                               double case_seconds);

#endif
