// Time in nanoseconds, and what asking for it costs. SPDX-License-Identifier: MIT OR Apache-2.0
#ifndef BENCH_CLOCK_H
#define BENCH_CLOCK_H

#include <algorithm>
#include <ctime>
#include <vector>

inline double read_clock(clockid_t clock) {
    timespec t;
    clock_gettime(clock, &t);
    return 1e9 * double(t.tv_sec) + double(t.tv_nsec);
}

inline double now() { return read_clock(CLOCK_MONOTONIC); }

// The median of two calls without anything between: subtracted from each time of a single query.
inline double clock_cost() {
    std::vector<double> costs(2001);
    for (double &cost : costs) {
        const double start = now();
        cost = now() - start;
    }
    std::nth_element(costs.begin(), costs.begin() + 1000, costs.end());
    return costs[1000];
}

// Of a batch: the processor time of the calling thread, when that does all the work, so that a busy machine is no part
// of it; else the time that passes.
template <class Work>
double batch_time_of(unsigned threads, Work work) {
    const clockid_t clock = threads == 1 ? CLOCK_THREAD_CPUTIME_ID : CLOCK_MONOTONIC;
    const double start = read_clock(clock);
    work();
    return read_clock(clock) - start;
}

// The time of `work` alone.
template <class Work>
double time_of(double cost, Work work) {
    const double start = now();
    work();
    return std::max(now() - start - cost, 1.0);
}

// Of a single call of which `least` is the least time so far, infinite at first. A busy machine interrupts calls that are
// long (50 us and more); of those the processor time counts. It is not asked for around short
// calls, apart from the first time: that costs more than they do.
template <class Work>
double call_time_of(double cost, double least, Work work) {
    constexpr double LONG = 5e4;
    if (least <= LONG) {
        return time_of(cost, work);
    }
    const double start = read_clock(CLOCK_THREAD_CPUTIME_ID);
    const double passed = time_of(cost, work);
    const double processor = read_clock(CLOCK_THREAD_CPUTIME_ID) - start;
    return passed > LONG ? std::min(passed, processor) : passed;
}

#endif
