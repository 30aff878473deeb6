// A fixed set of queries for callgrind: what runs inside of counted() is counted, see instructions.py.
//   bench_instructions KIND CASE_DIR...     prints the number of queries of each case that it asks
// SPDX-License-Identifier: MIT OR Apache-2.0
#include "ours.h"

#include <cstdio>
#include <cstring>

namespace {

struct Kind {
    const char *name;
    bool curves, batch;
    // 0: no hint.
    double hint;
};

constexpr Kind KINDS[] = {
    {"curves single", true, false, 0.0},         {"curves batch", true, true, 0.0},
    {"curves hint 1%", true, false, 0.01},       {"curves hint 0.1%", true, false, 0.001},
    {"surfaces single", false, false, 0.0},      {"surfaces batch", false, true, 0.0},
    {"surfaces hint 1%", false, false, 0.01},    {"surfaces hint 0.1%", false, false, 0.001},
};

} // namespace

// Called once for a case. Named for callgrind's --toggle-collect and --dump-after.
extern "C" __attribute__((noinline)) void counted(const Shape &shape, const double *points, size_t count, size_t each,
                                                  fpt_query_options *options, fpt_foot_point *feet) {
    const double *hints = options->hints;
    for (size_t i = 0; i < count; i += each) {
        options->hints = hints ? hints + 2 * i : nullptr;
        shape.closest(points + 3 * i, each, options, feet + i);
    }
}

int main(int argc, char **argv) {
    const Kind *kind = nullptr;
    for (const Kind &k : KINDS) {
        kind = argc > 2 && std::strcmp(argv[1], k.name) == 0 ? &k : kind;
    }
    if (kind == nullptr) {
        for (const Kind &k : KINDS) {
            std::printf("%s\n", k.name);
        }
        return argc == 1 ? 0 : 2;
    }
    for (int a = 2; a < argc; a++) {
        const std::string folder = argv[a];
        const Geometry g = read_geometry(folder + "/geometry.txt");
        if (g.is_curve != kind->curves) {
            continue;
        }
        const Shape shape(g);
        std::vector<double> points, hints;
        for (const Query &query : read_queries(folder + "/queries.csv")) {
            const Pair hint = hint_beside(g, query, kind->hint);
            points.insert(points.end(), query.point.begin(), query.point.end());
            hints.insert(hints.end(), hint.begin(), hint.end());
        }
        const size_t count = points.size() / 3;
        std::vector<fpt_foot_point> feet(count);
        fpt_query_options options = plain_options();
        options.hints = kind->hint > 0.0 ? hints.data() : nullptr;
        options.hint_stride = sizeof(Pair);
        counted(shape, points.data(), count, kind->batch ? count : 1, &options, feet.data());
        std::printf("%zu\n", count);
    }
    return 0;
}
