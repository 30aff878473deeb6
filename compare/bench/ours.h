// footpoint through its C interface. SPDX-License-Identifier: MIT OR Apache-2.0
#ifndef BENCH_OURS_H
#define BENCH_OURS_H

#include "peer.h"

#include <footpoint.h>

#include <vector>

// A curve or a surface with its index built.
class Shape {
public:
    explicit Shape(const Geometry &geometry);
    ~Shape();
    Shape(const Shape &) = delete;
    Shape &operator=(const Shape &) = delete;

    const fpt_curve *curve() const { return curve_; }
    const fpt_surface *surface() const { return surface_; }
    double diagonal() const { return diagonal_; }
    // Of the constructor and the index.
    double set_up_seconds() const { return set_up_seconds_; }
    // What the handle and its index hold, in bytes.
    double memory() const { return memory_; }

    // One call for all of them; packed points and hints (a pair each, on a curve too).
    void closest(const double *points, size_t count, const fpt_query_options *options, fpt_foot_point *out) const;
    // Parameters beyond an end count as the end; infinite for those that are not finite.
    double distance(const Pair &at, const Vec &point) const;
    // How far off an answer may be by the rounding of its numbers.
    double rounding(const Vec &point, double distance) const;
    // |found - truth| beyond rounding in diagonals, 0 within.
    double excess(const Answer &answer, const Query &query) const;

private:
    fpt_curve *curve_ = nullptr;
    fpt_surface *surface_ = nullptr;
    double domain_[4] = {0, 0, 0, 0};
    double diagonal_ = 0, largest_ = 0, set_up_seconds_ = 0, memory_ = 0;
};

// Options for one thread, or two; the rest are the defaults.
fpt_query_options plain_options(uint32_t threads = 1);

// One call per query, with or without the hint.
class Ours : public Peer {
public:
    Ours(const Shape &shape, bool hinted);
    Answer ask(const Vec &point, const Pair &hint) override;

private:
    const Shape &shape_;
    const bool hinted_;
    fpt_query_options options_;
};

// The place of the query moved by `share` of the domain in each parameter, inwards where it would leave it; which way
// is drawn from the row.
Pair hint_beside(const Geometry &geometry, const Query &query, double share);

#endif
