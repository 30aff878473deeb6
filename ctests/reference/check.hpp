// SPDX-License-Identifier: MIT OR Apache-2.0
#ifndef FOOTPOINT_REFERENCE_CHECK_HPP
#define FOOTPOINT_REFERENCE_CHECK_HPP

#include <cstdio>

inline int failed = 0;
inline int checked = 0;

/** Counts, and tells of failures with the numbers that matter. */
inline void expect(bool holds, const char *about, const char *what, double a = 0, double b = 0, double c = 0) {
    checked++;
    if (holds) return;
    failed++;
    if (failed <= 30) std::fprintf(stderr, "%s: %s (%.17g, %.17g, %.17g)\n", about, what, a, b, c);
}

inline int verdict() {
    std::printf("%d checks, %d failed\n", checked, failed);
    return failed == 0 && checked > 0 ? 0 : 1;
}

#endif
