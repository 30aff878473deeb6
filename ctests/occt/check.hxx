// Checks of the OCCT tests. SPDX-License-Identifier: MIT OR Apache-2.0
#ifndef FOOTPOINT_TEST_CHECK_HXX
#define FOOTPOINT_TEST_CHECK_HXX

#include <Standard_Failure.hxx>
#include <Standard_Type.hxx>

#include <cstdio>
#include <string>
#include <utility>

inline int failed = 0;
inline int checked = 0;

/** Counts, and tells of failures with what they are about and the numbers that matter. */
inline void expect(bool holds, const std::string &about, const char *what, double a = 0, double b = 0) {
    checked++;
    if (holds) return;
    failed++;
    if (failed <= 40) std::fprintf(stderr, "%s: %s (%.17g, %.17g)\n", about.c_str(), what, a, b);
}

/** Runs the parts; what is thrown out of one is a failure. */
using Part = std::pair<const char *, void (*)()>;
template <class... Parts>
int run(Parts... parts) {
    const auto one = [](const char *name, void (*part)()) {
        try {
            part();
        } catch (const Standard_Failure &failure) {
            std::fprintf(stderr, "%s: %s: %s\n", name, failure.DynamicType()->Name(), failure.GetMessageString());
            failed++;
        }
    };
    (one(parts.first, parts.second), ...);
    std::printf("%d checks, %d failed\n", checked, failed);
    return failed == 0 && checked > 0 ? 0 : 1;
}
#endif
