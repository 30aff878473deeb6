// How footpoint's times grow: with patches, degree, threads and the size of a batch, on sheets made here.
//   bench_growth FILE [quick]
// FILE: a line per figure, `EXPERIMENT,curve or surface,X,...`; the lines are described where they are written.
// SPDX-License-Identifier: MIT OR Apache-2.0
#include "clock.h"
#include "ours.h"
#include "sheet.h"

#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <sched.h>

namespace {

constexpr double ENDLESS = std::numeric_limits<double>::infinity();

struct Subject {
    double x;
    Geometry geometry;
    std::vector<double> points;
    std::unique_ptr<Shape> shape;
    double set_up = ENDLESS, parallel_set_up = ENDLESS;
    // Least of the rounds, per query.
    std::vector<double> times;
    double batch = ENDLESS;

    Subject(double x, Geometry g, size_t queries) : x(x), geometry(std::move(g)), points(points_near(geometry, queries)) {}
    size_t count() const { return points.size() / 3; }
};

void pin_to_one_core(bool pinned) {
    static cpu_set_t all = [] {
        cpu_set_t set;
        sched_getaffinity(0, sizeof set, &set);
        return set;
    }();
    cpu_set_t one;
    CPU_ZERO(&one);
    CPU_SET(sched_getcpu(), &one);
    sched_setaffinity(0, sizeof all, pinned ? &one : &all);
}

// On one core (what the library sees of the machine as well) and on all; the shape of the last build stays.
void build(Subject &s, int repeats) {
    for (bool pinned : {true, false}) {
        pin_to_one_core(pinned);
        double &least = pinned ? s.set_up : s.parallel_set_up;
        for (int repeat = 0; repeat < repeats; repeat++) {
            s.shape.reset();
            s.shape = std::make_unique<Shape>(s.geometry);
            least = std::min(least, s.shape->set_up_seconds());
        }
    }
    pin_to_one_core(false);
}

// Each query once, alone: the next one lies elsewhere, as with scattered points. Then all in one call.
void round_of(Subject &s, double cost) {
    s.times.resize(s.count(), ENDLESS);
    Ours ours(*s.shape, false);
    for (size_t i = 0; i < s.count(); i++) {
        const Vec point = {s.points[3 * i], s.points[3 * i + 1], s.points[3 * i + 2]};
        s.times[i] = std::min(s.times[i], call_time_of(cost, s.times[i], [&] { ours.ask(point, {0, 0}); }));
    }
    const fpt_query_options options = plain_options();
    std::vector<fpt_foot_point> feet(s.count());
    const auto ask = [&] { s.shape->closest(s.points.data(), feet.size(), &options, feet.data()); };
    s.batch = std::min(s.batch, batch_time_of(1, ask) / double(feet.size()));
}

double share_of(std::vector<double> values, double share) {
    const size_t k = std::min(values.size() - 1, size_t(share * double(values.size())));
    std::nth_element(values.begin(), values.begin() + long(k), values.end());
    return values[k];
}

// EXPERIMENT,KIND,X,MEDIAN ns,P99 ns,BATCH ns,SET-UP s,SET-UP ON ALL CORES s,MEMORY bytes
void grow(std::FILE *file, const char *experiment, std::vector<Subject> &subjects, int rounds) {
    for (Subject &s : subjects) {
        build(s, s.x * s.geometry.degree[0] > 20000 ? 2 : 5);
    }
    const double cost = clock_cost();
    for (int round = 0; round < rounds; round++) {
        for (Subject &s : subjects) {
            round_of(s, cost);
        }
    }
    for (const Subject &s : subjects) {
        std::fprintf(file, "%s,%s,%g,%.1f,%.1f,%.1f,%.4g,%.4g,%.0f\n", experiment,
                     s.geometry.is_curve ? "curve" : "surface", s.x, share_of(s.times, 0.5), share_of(s.times, 0.99),
                     s.batch, s.set_up, s.parallel_set_up, s.shape->memory());
        std::fflush(file);
    }
}

// Of degree 1 every line between pieces is a crease.
void grow_patches(std::FILE *file, const char *experiment, int degree, bool quick) {
    constexpr int GRIDS[6][2] = {{1, 1}, {2, 5}, {10, 10}, {25, 40}, {100, 100}, {250, 400}};
    for (bool curve : {false, true}) {
        std::vector<Subject> subjects;
        for (const auto &grid : GRIDS) {
            const int pieces = grid[0] * grid[1];
            const Geometry g = curve ? bumpy_sheet(degree, 0, pieces) : bumpy_sheet(degree, grid[0], grid[1]);
            subjects.emplace_back(pieces, g, quick ? 4000 : 20000);
        }
        grow(file, experiment, subjects, quick ? 2 : 4);
    }
}

void grow_degree(std::FILE *file, bool quick) {
    for (bool curve : {false, true}) {
        std::vector<Subject> subjects;
        for (int degree = 1; degree <= 9; degree++) {
            const Geometry g = curve ? bumpy_sheet(degree, 0, 64) : bumpy_sheet(degree, 8, 8);
            subjects.emplace_back(degree, g, quick ? 1000 : 4000);
        }
        grow(file, "degree", subjects, quick ? 2 : 4);
    }
}

// batch,KIND,QUERIES PER CALL,THREADS,ns per query
void grow_batch(std::FILE *file, bool quick) {
    const size_t total = quick ? 8192 : 32768;
    for (bool curve : {false, true}) {
        Subject s(100, curve ? bumpy_sheet(3, 0, 100) : bumpy_sheet(3, 10, 10), total);
        build(s, 1);
        std::vector<fpt_foot_point> feet(total);
        const std::vector<size_t> sizes = {1, 8, 64, 512, 4096, total};
        std::vector<double> least(2 * sizes.size(), ENDLESS);
        for (int round = 0; round < 5; round++) {
            for (size_t k = 0; k < least.size(); k++) {
                const size_t size = sizes[k / 2];
                const fpt_query_options options = plain_options(uint32_t(1 + k % 2));
                // The time that passes, with one thread too: the two are compared.
                const double time = time_of(0, [&] {
                    for (size_t i = 0; i < total; i += size) {
                        s.shape->closest(&s.points[3 * i], size, &options, &feet[i]);
                    }
                });
                least[k] = std::min(least[k], time / double(total));
            }
        }
        for (size_t k = 0; k < least.size(); k++) {
            std::fprintf(file, "batch,%s,%zu,%zu,%.1f\n", curve ? "curve" : "surface", sizes[k / 2], 1 + k % 2, least[k]);
        }
    }
}

// threads,KIND,THREADS,ns per query,ns of the processors per query
void grow_threads(std::FILE *file, bool quick) {
    const long cores = CPU_COUNT([] {
        static cpu_set_t set;
        sched_getaffinity(0, sizeof set, &set);
        return &set;
    }());
    for (bool curve : {false, true}) {
        Subject s(100, curve ? bumpy_sheet(3, 0, 100) : bumpy_sheet(3, 10, 10), quick ? 50000 : 200000);
        build(s, 1);
        std::vector<fpt_foot_point> feet(s.count());
        std::vector<double> least(size_t(std::max(cores, 2L)) + 1, ENDLESS), processors = least;
        for (int round = 0; round < 7; round++) {
            for (size_t threads = 1; threads < least.size(); threads++) {
                const fpt_query_options options = plain_options(uint32_t(threads));
                const double start = read_clock(CLOCK_PROCESS_CPUTIME_ID);
                const auto ask = [&] { s.shape->closest(s.points.data(), feet.size(), &options, feet.data()); };
                least[threads] = std::min(least[threads], time_of(0, ask));
                processors[threads] = std::min(processors[threads], read_clock(CLOCK_PROCESS_CPUTIME_ID) - start);
            }
        }
        for (size_t threads = 1; threads < least.size(); threads++) {
            std::fprintf(file, "threads,%s,%zu,%.1f,%.1f\n", curve ? "curve" : "surface", threads,
                         least[threads] / double(feet.size()), processors[threads] / double(feet.size()));
        }
    }
}

} // namespace

int main(int argc, char **argv) {
    std::FILE *file = argc > 1 ? std::fopen(argv[1], "w") : nullptr;
    if (file == nullptr) {
        std::fprintf(stderr, "usage: bench_growth FILE [quick]\n");
        return 2;
    }
    const bool quick = argc > 2 && std::strcmp(argv[2], "quick") == 0;
    grow_threads(file, quick);
    grow_batch(file, quick);
    grow_degree(file, quick);
    grow_patches(file, "pieces", 3, quick);
    grow_patches(file, "creased", 1, quick);
    std::fclose(file);
    return 0;
}
