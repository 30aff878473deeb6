// SPDX-License-Identifier: MIT OR Apache-2.0
#include "newton.h"

#include <algorithm>
#include <cmath>

namespace {

constexpr int MOST = 20;
// Cosine that counts as perpendicular; distance and move, as shares of the diagonal, that count as none.
constexpr double COSINE = 1e-12, NOTHING = 1e-14;

double kept_inside(const Spline &shape, int k, double t) {
    const double low = shape.low(k), high = shape.high(k);
    if (shape.closed(k)) {
        t = t < low ? high - (low - t) : t > high ? low + (t - high) : t;
    }
    return std::clamp(t, low, high);
}

// The step, with parameters that are `held` left where they are. Where the distance is not convex, or the step would be
// endless, the second derivatives are left out (Gauss and Newton).
Pair step(const Derivatives &s, const Vec &r, const bool held[2]) {
    const double f = dot(r, s[1]), g = dot(r, s[2]);
    const double e = dot(s[1], s[1]), m = dot(s[1], s[2]), n = dot(s[2], s[2]);
    double a = e + dot(r, s[3]), b = m + dot(r, s[4]), c = n + dot(r, s[5]);
    if (held[0] || held[1]) {
        a = a > 0.0 ? a : e;
        c = c > 0.0 ? c : n;
        return {held[0] || a == 0.0 ? 0.0 : -f / a, held[1] || c == 0.0 ? 0.0 : -g / c};
    }
    if (a <= 0.0 || a * c - b * b <= 0.0) {
        a = e;
        b = m;
        c = n;
    }
    const double determinant = a * c - b * b;
    if (determinant <= 0.0) {
        return {a > 0.0 ? -f / a : 0.0, c > 0.0 ? -g / c : 0.0};
    }
    return {-(c * f - b * g) / determinant, -(a * g - b * f) / determinant};
}

} // namespace

Pair newton(const Spline &shape, Pair at, const Vec &query) {
    Pair best = at;
    double least = HUGE_VAL;
    for (int turn = 0; turn < MOST; turn++) {
        const Derivatives s = shape.derivatives(at, 2);
        const Vec r = minus(s[0], query);
        const double distance = norm(r);
        if (distance < least) {
            least = distance;
            best = at;
        }
        const double slope[2] = {dot(r, s[1]), dot(r, s[2])};
        bool held[2] = {false, shape.is_curve()}, done = distance <= NOTHING * shape.diagonal();
        bool flat = true;
        for (size_t k = 0; k < (shape.is_curve() ? 1u : 2u); k++) {
            const bool outwards = (at[k] == shape.low(int(k)) && slope[k] > 0.0) || (at[k] == shape.high(int(k)) && slope[k] < 0.0);
            held[k] = outwards && !shape.closed(int(k));
            flat = flat && (held[k] || std::fabs(slope[k]) <= COSINE * distance * norm(s[1 + k]));
        }
        if (done || flat) {
            break;
        }
        const Pair move = step(s, r, held);
        const Pair next = {kept_inside(shape, 0, at[0] + move[0]), kept_inside(shape, 1, at[1] + move[1])};
        const double moved = std::fabs(next[0] - at[0]) * norm(s[1]) + std::fabs(next[1] - at[1]) * norm(s[2]);
        at = next;
        if (moved <= NOTHING * shape.diagonal()) {
            break;
        }
    }
    return best;
}
