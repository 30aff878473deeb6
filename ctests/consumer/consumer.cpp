// A program of somebody else, in C++17: the same parabola, and an error that names its cause.
// SPDX-License-Identifier: MIT OR Apache-2.0
#include <footpoint.hpp>

#include <cmath>
#include <iostream>
#include <string>

int main() try {
    const footpoint::curve parabola(2, {0, 0, 0, 1, 1, 1}, {-1, 1, 0, 0, -1, 0, 1, 1, 0});
    const fpt_foot_point foot = parabola.closest({0, -2, 0}).at(0);
    if (std::abs(foot.u - 0.5) > 1e-12 || std::abs(foot.distance - 2) > 1e-14 || (foot.flags & FPT_FOOT_NOT_PROVEN)) {
        std::cerr << "u " << foot.u << ", distance " << foot.distance << ", flags " << foot.flags << "\n";
        return 1;
    }
    try {
        footpoint::curve(1, {0, 0, 1, 1}, {0, 0, 0, NAN, 0, 0});
    } catch (const footpoint::error &failure) {
        if (failure.status() == FPT_INVALID_ARGUMENT && std::string(failure.what()).find("pole 1") != std::string::npos) {
            return 0;
        }
        std::cerr << failure.what() << "\n";
    }
    return 1;
} catch (const std::exception &failure) {
    std::cerr << failure.what() << "\n";
    return 1;
}
