// footpoint alone on all queries of the cases: the time of each call, without a hint and with good ones, and of batches.
//   bench_latency FILE [--queries N] CASE_DIR...
// FILE: case,NAME,CURVE OR SURFACE,PIECES,SET-UP s,MEMORY bytes,BATCH ns,BATCH OF TWO THREADS ns,BATCH WITH HINTS ns,
//       NOT PROVEN
//       class,CLASS,BATCH ns (one call for the queries of the class)
//       query,CLASS,PLAIN ns,HINT 1% ns,HINT 0.1% ns,EXCESS in diagonals
// SPDX-License-Identifier: MIT OR Apache-2.0
#include "clock.h"
#include "ours.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <map>

namespace {

// So many queries in turn, five times each; the least time counts.
constexpr size_t TURN = 32;
constexpr int REPEATS = 5;
constexpr double HINTS[3] = {0.0, 0.01, 0.001};

struct Row {
    double time[3];
    double excess;
};

struct Batch {
    std::vector<double> points, hints;
    void add(const Query &query, const Pair &hint) {
        points.insert(points.end(), query.point.begin(), query.point.end());
        hints.insert(hints.end(), hint.begin(), hint.end());
    }
    // Answers that say that they are not proven.
    long unproven(const Shape &shape) const {
        std::vector<fpt_foot_point> feet(points.size() / 3);
        const fpt_query_options options = plain_options();
        shape.closest(points.data(), feet.size(), &options, feet.data());
        const auto weak = [](const fpt_foot_point &foot) { return (foot.flags & FPT_FOOT_NOT_PROVEN) != 0; };
        return std::count_if(feet.begin(), feet.end(), weak);
    }
    // Nanoseconds per query, the least of the repeats.
    double time(const Shape &shape, uint32_t threads, bool hinted) const {
        std::vector<fpt_foot_point> feet(points.size() / 3);
        fpt_query_options options = plain_options(threads);
        options.hints = hinted ? hints.data() : nullptr;
        options.hint_stride = sizeof(Pair);
        double least = std::numeric_limits<double>::infinity();
        for (int repeat = 0; repeat < REPEATS; repeat++) {
            const auto ask = [&] { shape.closest(points.data(), feet.size(), &options, feet.data()); };
            least = std::min(least, batch_time_of(threads, ask));
        }
        return least / double(feet.size());
    }
};

int pieces_of(const Geometry &g) {
    int pieces = 1;
    for (int k = 0; k < g.dimensions(); k++) {
        int spans = 0;
        for (size_t i = 1; i < g.knots[k].size(); i++) {
            spans += g.knots[k][i] > g.knots[k][i - 1] && g.knots[k][i] > g.low(k) && g.knots[k][i - 1] < g.high(k);
        }
        pieces *= spans;
    }
    return pieces;
}

std::vector<Row> times_of(const Geometry &g, const Shape &shape, const std::vector<Query> &queries) {
    std::vector<Row> rows(queries.size());
    const double cost = clock_cost(), endless = std::numeric_limits<double>::infinity();
    for (size_t kind = 0; kind < 3; kind++) {
        Ours ours(shape, kind > 0);
        for (size_t first = 0; first < queries.size(); first += TURN) {
            const size_t end = std::min(first + TURN, queries.size());
            for (int repeat = 0; repeat < REPEATS; repeat++) {
                for (size_t i = first; i < end; i++) {
                    const Pair hint = hint_beside(g, queries[i], HINTS[kind]);
                    Answer answer;
                    double &least = rows[i].time[kind];
                    least = repeat == 0 ? endless : least;
                    const auto call = [&] { answer = ours.ask(queries[i].point, hint); };
                    least = std::min(least, call_time_of(cost, least, call));
                    const double excess = answer.found ? shape.excess(answer, queries[i]) : endless;
                    rows[i].excess = std::max(rows[i].excess, excess);
                }
            }
        }
    }
    return rows;
}

void measure(std::FILE *file, const std::string &folder, size_t most) {
    const std::string name = folder.substr(folder.find_last_of('/') + 1);
    const Geometry g = read_geometry(folder + "/geometry.txt");
    const std::vector<Query> queries = sample(read_queries(folder + "/queries.csv"), most);
    const Shape shape(g);
    Batch all;
    std::map<std::string, Batch> classes;
    for (const Query &query : queries) {
        const Pair hint = hint_beside(g, query, HINTS[1]);
        all.add(query, hint);
        classes[query.kind].add(query, hint);
    }
    const std::vector<Row> rows = times_of(g, shape, queries);
    std::fprintf(file, "case,%s,%s,%d,%.4g,%.0f,%.1f,%.1f,%.1f,%ld\n", name.c_str(), g.is_curve ? "curve" : "surface",
                 pieces_of(g), shape.set_up_seconds(), shape.memory(), all.time(shape, 1, false),
                 all.time(shape, 2, false), all.time(shape, 1, true), all.unproven(shape));
    for (const auto &[kind, batch] : classes) {
        std::fprintf(file, "class,%s,%.1f\n", kind.c_str(), batch.time(shape, 1, false));
    }
    for (size_t i = 0; i < rows.size(); i++) {
        const Row &row = rows[i];
        std::fprintf(file, "query,%s,%.0f,%.0f,%.0f,%.3g\n", queries[i].kind.c_str(), row.time[0], row.time[1],
                     row.time[2], row.excess);
    }
}

} // namespace

int main(int argc, char **argv) {
    std::FILE *file = argc > 2 ? std::fopen(argv[1], "w") : nullptr;
    if (file == nullptr) {
        std::fprintf(stderr, "usage: bench_latency FILE [--queries N] CASE_DIR...\n");
        return 2;
    }
    size_t most = size_t(-1);
    for (int k = 2; k < argc; k++) {
        const std::string word = argv[k];
        if (word == "--queries" && k + 1 < argc) {
            most = size_t(std::atol(argv[++k]));
        } else {
            measure(file, word, most);
        }
    }
    std::fclose(file);
    return 0;
}
